# SPDX-License-Identifier: MPL-2.0
"""Runs inside Blender for test_instances.py: places copies by scripts/blender/place_copies.py and prints
how many objects share how much data, their box, and how many a cut hides, as JSON on a line that starts with RESULT."""

import json
import pathlib
import sys

import bpy  # before mathutils, which it brings
from mathutils import Vector

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts" / "blender"))

import place_copies


def main():
    report, surface, show = sys.argv[sys.argv.index("--") + 1:]
    _, copies = place_copies.place_copies(report, surface, show)
    if show == "mesh":
        points = [copy.matrix_world @ v.co for copy in copies for v in copy.data.vertices]
    else:
        points = [copy.matrix_world @ Vector(corner) for copy in copies for corner in copy.bound_box]
    box = [[f(p[i] for p in points) for i in range(3)] for f in (min, max)]
    place_copies.set_stage(copies, 0.0, show)
    hidden = []
    for depth in (1, 0, -1):
        place_copies.cut_away(copies, depth)
        hidden.append(sum(copy.hide_render for copy in copies))
    print("RESULT " + json.dumps({"objects": len(copies), "data": len({copy.data.name for copy in copies}),
                                  "box": box, "hidden": hidden}))


main()
