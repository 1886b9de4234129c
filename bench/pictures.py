#!/usr/bin/python3
# SPDX-License-Identifier: MPL-2.0
"""Draws 4AT1 by vdb_molsurf and by PyMOL's ray from the same place, with the same colours, size and kind of surface.

    bench/pictures.py VDB_MOLSURF tests/data/4at1.ent.gz [SCENE ...] [--size 800] [--repeat 3] [-O FOLDER]

For each scene it leaves the pictures of both programs and one with both side by side (with ImageMagick) in FOLDER, and
prints a row each: the median of processor seconds and of wall time, from the file to the picture. PyMOL (Debian: pymol)
traces with shadows and 2 x 2 rays a pixel, as vdb_molsurf does; its ambient occlusion is a scene of its
own. Look at the pictures: bench/history.md lists what there is to see.
"""

import argparse
import json
import os
import pathlib
import shutil
import statistics
import subprocess
import sys
import time

# As vdb_molsurf gives them.
CHAINS = "\n".join(f"color 0x{color}, chain {chain}"
                   for chain, color in zip("ABCD", ("56b4e9", "e69f00", "009e73", "cc79a7")))
POCKET = ["--select", "B", "--no-hetero", "--view", "B/(ATP)"]
OCCLUSION = "set ambient_occlusion_mode, 1"

# Name, options of vdb_molsurf that the view depends on, its other options, commands of PyMOL.
SCENES = [
    ("plain", [], ["--plain-color", "#8cb5de", "--style", "glossy"], "color 0x8cb5de"),
    ("chains", [], ["--color", "chain"], CHAINS),
    ("occlusion", [], ["--color", "chain"], f"{CHAINS}\n{OCCLUSION}"),
    ("lines", [], ["--color", "chain", "--style", "outline"], f"{CHAINS}\nset ray_trace_mode, 1\nset ray_shadows, 0"),
    ("glass", [], ["--color", "chain", "--opacity", "0.5", "--show", "*;polymer=tube"],
     f"{CHAINS}\nset transparency, 0.5\nshow cartoon, polymer\ncartoon tube\nset cartoon_tube_radius, 0.6"),
    ("cut", [], ["--color", "chain", "--clip", "0"], f"{CHAINS}\nset ray_interior_color, grey80"),
    ("pocket", POCKET, ["--plain-color", "#8cb5de", "--show", "B/(ATP)=sticks", "--style", "glossy"],
     "remove not chain B\ncolor 0x8cb5de\nset surface_mode, 0\nshow sticks, resn ATP\n"
     "util.cbay('resn ATP')\nflag ignore, hetatm\nrebuild"),
]


def pymol_view(view, cut):
    """PyMOL's set_view of a view that vdb_molsurf has written; `cut` leaves out what is nearer than its middle."""
    def cross(a, b):
        return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    eye, up = view["to_eye"], view["up"]
    right = cross(up, eye)
    rotation = [axis[i] for i in range(3) for axis in (right, up, eye)]
    far = view["height"] / 2 / 0.17632698  # a field of view of 20 degrees; as a positive number it stands for parallel rays
    return [*rotation, 0, 0, -far, *view["center"], far if cut else far - view["height"], far + view["height"], 20]


def script_of(structure, view, cut, commands, size, picture):
    lines = [f"load {structure}, m", "remove solvent", "hide everything", "show surface", "bg_color white",
             "set ray_opaque_background, 1", "set ray_shadows, 1", "set antialias, 1", "set depth_cue, 0", "set ray_trace_fog, 0",
             commands, f"set_view {pymol_view(view, cut)}",
             f"ray {size}, {round(size * view['height'] / view['width'])}", f"png {picture}", ""]
    return "\n".join(lines)


def timed(command, repeat):
    cpu, wall = [], []
    for _ in range(repeat):
        before, start = os.times(), time.monotonic()
        done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
        after = os.times()
        if done.returncode:
            sys.exit(f"{command[0]}: {done.stderr or done.stdout}")
        wall.append(time.monotonic() - start)
        cpu.append(after.children_user + after.children_system - before.children_user - before.children_system)
    return statistics.median(cpu), statistics.median(wall)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("structure", type=pathlib.Path)
    parser.add_argument("scenes", nargs="*", help="names of scenes [all]")
    parser.add_argument("--size", type=int, default=800, help="width in pixels [800]")
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("-O", "--folder", type=pathlib.Path, default=pathlib.Path("pictures"))
    words = parser.parse_intermixed_args()
    if not shutil.which("pymol") or not shutil.which("montage"):
        sys.exit("pictures.py: expected PyMOL as pymol and ImageMagick's montage on the PATH")
    words.folder.mkdir(parents=True, exist_ok=True)
    print("| scene | program | CPU s | wall s |\n|---|---|---|---|")
    for name, placed, options, commands in SCENES:
        if words.scenes and name not in words.scenes:
            continue
        ours, theirs, script, view_file = (words.folder / f"{name}{end}"
                                           for end in (".png", "_pymol.png", ".pml", ".view"))
        base = [words.program, words.structure, *placed, "--surface", "ses", "--legend", "off", "--force", "-q",
                "--no-progress", "--size", str(words.size)]
        subprocess.run([str(word) for word in [*base, "-o", view_file]], check=True)
        view = json.loads(view_file.read_text())
        if "--view" in base:
            base[base.index("--view") + 1] = view_file
        else:
            base += ["--view", view_file]
        script.write_text(script_of(words.structure, view, "--clip" in options, commands, words.size, theirs))
        for program, command in (("vdb_molsurf", [*base, *options, "-o", ours]), ("PyMOL", ["pymol", "-cq", script])):
            cpu, wall = timed(command, words.repeat)
            print(f"| {name} | {program} | {cpu:.2f} | {wall:.2f} |", flush=True)
        subprocess.run(["montage", ours, theirs, "-tile", "2x1", "-geometry", f"{words.size}x+4+4",
                        words.folder / f"{name}_both.png"], check=True)


if __name__ == "__main__":
    main()
