# SPDX-License-Identifier: MPL-2.0
"""Runs inside Blender for test_blender.py: opens files by scripts/blender/open_in_blender.py and
prints what their meshes are, as JSON on a line that starts with RESULT."""

import json
import math
import pathlib
import sys

import bpy
import bmesh  # once bpy is there
from mathutils import Euler, Matrix

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts" / "blender"))

import open_in_blender


def measured(obj):
    """Volume, centroid of the volume, edges that do not have two faces, range of the box."""
    evaluated = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = bmesh.new()
    mesh.from_mesh(evaluated.to_mesh())
    mesh.transform(evaluated.matrix_world)
    bmesh.ops.triangulate(mesh, faces=mesh.faces)
    mesh.verts.ensure_lookup_table()
    # Blender's vectors are floats: far from 0 these products would cancel.
    origin = mesh.verts[0].co.copy() if mesh.verts else None
    volume, moment = 0.0, [0.0] * 3
    for face in mesh.faces:
        a, b, c = (v.co - origin for v in face.verts)
        part = a.dot(b.cross(c)) / 6
        volume += part
        for i in range(3):
            moment[i] += part * (a[i] + b[i] + c[i]) / 4
    open_edges = sum(not edge.is_manifold or not edge.is_contiguous for edge in mesh.edges)
    faces = len(mesh.faces)
    mesh.free()
    return {"volume": volume, "faces": faces, "open_edges": open_edges,
            "centroid": [o + m / volume for o, m in zip(origin, moment)] if volume else None}


def fresh():
    bpy.ops.wm.read_factory_settings(use_empty=True)


def main():
    words = sys.argv[sys.argv.index("--") + 1:]
    result = {}
    for name in words[0].split(","):
        fresh()
        volume, mesh = open_in_blender.open_surface(name)
        result[name] = measured(mesh)
        result[name]["grids"] = {g.name: g.data_type for g in volume.data.grids}
        # Turned, moved and enlarged as an object.
        turn = Euler((math.radians(30), math.radians(-50), math.radians(110)))
        move = Matrix.LocRotScale((3, -1, 2), turn, (1.5, 1.5, 1.5))
        volume.matrix_world = move @ volume.matrix_world
        bpy.context.view_layer.update()
        result[name]["placed"] = {**measured(mesh), "matrix": [list(row) for row in move]}

    fresh()
    volume, mesh = open_in_blender.open_surface("angstrom.vdb", color=True)
    colors = mesh.data.color_attributes
    result["colored"] = {"vertices": len(mesh.data.vertices), "colors": sorted(
        {tuple(round(c, 3) for c in value.color) for value in colors["Cd"].data})
        if "Cd" in colors else []}

    fresh()
    volume, mesh = open_in_blender.open_surface(words[1])
    frames = []
    scene = bpy.context.scene
    for frame in range(scene.frame_start - 1, scene.frame_end + 2):
        scene.frame_set(frame)
        volume.data.grids.load()
        frames.append({"frame": frame, "grids": len(volume.data.grids), **measured(mesh)})
    result["sequence"] = {"range": [scene.frame_start, scene.frame_end],
                          "duration": volume.data.frame_duration, "frames": frames}
    print("RESULT " + json.dumps(result))


main()
