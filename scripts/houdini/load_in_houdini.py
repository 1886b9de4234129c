#!/usr/bin/python3
# SPDX-License-Identifier: MPL-2.0
"""Loads a surface of vdb_molsurf in Houdini, from hython or a Python shell.

NOT TESTED: Houdini was not at hand. It uses the nodes file, blast, convertvdb, attribfromvolume and
normal as SideFX documents them.

    hython load_in_houdini.py surface.vdb scene.hipnc

Takes what `vdb_molsurf --for houdini` writes: `surface` (level set), `density` (fog) and `Cd`, in
OpenVDB's own convention, so the .ply of the same run lies on it. A sequence name.0001.vdb, ... is
loaded as name.$F4.vdb.

The nodes, /obj/molecular_surface:
    read      File           all grids of the .vdb
    keep      Blast          only the VDB named surface
    mesh      Convert VDB    to polygons at 0, the level set's own surface
    color     Attribute from Volume: Cd at the points, from the grid Cd
    normals   Normal
"""

import pathlib
import re
import sys

import hou  # Houdini's own


def pattern_of(path):
    """The file name with $F in the place of a frame's number."""
    match = re.fullmatch(r"(.*?\.)(\d+)(\.vdb)", path.name)
    if not match:
        return str(path)
    return str(path.parent / f"{match[1]}$F{len(match[2])}{match[3]}")


def load(path):
    """Makes the nodes; returns the geometry object."""
    path = pathlib.Path(path).resolve()
    if not path.is_file():
        raise SystemExit(f"{path}: there is no such file")
    geo = hou.node("/obj").createNode("geo", "molecular_surface")
    read = geo.createNode("file", "read")
    read.parm("file").set(pattern_of(path))

    keep = geo.createNode("blast", "keep")
    keep.setInput(0, read)
    keep.parm("group").set("@name=surface")
    keep.parm("negate").set(True)

    mesh = geo.createNode("convertvdb", "mesh")
    mesh.setInput(0, keep)
    mesh.parm("conversion").set("poly")
    mesh.parm("isoValue").set(0.0) if mesh.parm("isoValue") else mesh.parm("isovalue").set(0.0)

    color = geo.createNode("attribfromvolume", "color")
    color.setInput(0, mesh)
    color.setInput(1, read)
    for name, value in (("field", "Cd"), ("name", "Cd")):
        if color.parm(name):  # parameter names differ between versions
            color.parm(name).set(value)

    normals = geo.createNode("normal", "normals")
    normals.setInput(0, color)
    normals.setDisplayFlag(True)
    normals.setRenderFlag(True)
    geo.layoutChildren()
    return geo


def main():
    if len(sys.argv) not in (2, 3):
        raise SystemExit("hython load_in_houdini.py FILE.vdb [SCENE.hip]")
    load(sys.argv[1])
    if len(sys.argv) == 3:
        hou.hipFile.save(sys.argv[2])


if __name__ == "__main__":
    main()
