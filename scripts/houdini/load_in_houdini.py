#!/usr/bin/python3
# SPDX-License-Identifier: MPL-2.0
"""Loads a surface of vdb_molsurf in Houdini, from hython or a Python shell.

NOT TESTED: Houdini was not at hand. The names of nodes and parameters are those of nodes.json, which
says where each is documented.

    hython load_in_houdini.py surface.vdb scene.hipnc

Takes what `vdb_molsurf --for houdini` writes: `surface` (level set), `density` (fog) and `Cd`, in
OpenVDB's own convention, so the .ply of the same run lies on it. A sequence name.0001.vdb, ... is
loaded as name.$F4.vdb.

The nodes, /obj/molecular_surface:
    read      File           all grids of the .vdb
    keep      Blast          only the VDB named surface
    mesh      Convert VDB    to polygons at 0, the level set's own surface
    color     Attribute from Volume: Cd at the points, three floats, from the grid Cd
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


def make(geo, kind, label, /, *inputs, **parameters):
    """A node with these inputs and parameters."""
    node = geo.createNode(kind, label)
    for number, other in enumerate(inputs):
        node.setInput(number, other)
    for parameter, value in parameters.items():
        if node.parm(parameter) is None:
            raise SystemExit(f"{kind}: expected the parameter {parameter}, got none in this Houdini")
        node.parm(parameter).set(value)
    return node


def load(path):
    """Makes the nodes; returns the geometry object."""
    path = pathlib.Path(path).resolve()
    if not path.is_file():
        raise SystemExit(f"{path}: there is no such file")
    geo = hou.node("/obj").createNode("geo", "molecular_surface")
    read = make(geo, "file", "read", file=pattern_of(path))
    keep = make(geo, "blast", "keep", read, group="@name=surface", grouptype="prims", negate=True)
    mesh = make(geo, "convertvdb", "mesh", keep, conversion="poly")  # at 0, by default
    color = make(geo, "attribfromvolume", "color", mesh, read, field="Cd", name="Cd", type="float", size=3)
    normals = make(geo, "normal", "normals", color)
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
