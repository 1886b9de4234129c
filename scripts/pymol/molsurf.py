# SPDX-License-Identifier: MPL-2.0
"""The command molsurf of PyMOL: a surface of vdb_molsurf as an object, and the areas of atoms as B factors.

    run molsurf.py
    molsurf chain A, surface=ses, voxel=0.5
    spectrum b, white_red

The first word is a selection, `name` the object that is made, `state` the state of the atoms (-1: the present one), and
`color=atom` (the default) gives each place the colour of its nearest atom in PyMOL. All others are options of vdb_molsurf
without their dashes, with "_" for "-" in between: `color=chain`, `radii=alvarez`, `fill_cavities=1`. The program is the
one that the environment variable VDB_MOLSURF names, or vdb_molsurf of the PATH. Tried in PyMOL 2.5 and 3.2.
"""

import csv
import os
import pathlib
import struct
import subprocess
import tempfile

from pymol import CmdException, cgo, cmd

PLAIN = (0.8, 0.8, 0.8)


def read_mesh(path):
    """(names of properties, vertices, triangles) of a binary .ply."""
    header, body = path.read_bytes().split(b"end_header\n", 1)
    names, form, counts = [], "<", {}
    for line in header.decode().splitlines():
        words = line.split()
        if words[0] == "element":
            counts[words[1]] = int(words[2])
        elif words[0] == "property" and words[1] != "list":
            form += {"float": "f", "int": "i", "uchar": "B"}[words[1]]
            names.append(words[2])
    end = counts["vertex"] * struct.calcsize(form)
    triangles = [corners for _, *corners in struct.iter_unpack("<B3i", body[end:end + 13 * counts["face"]])]
    return names, list(struct.iter_unpack(form, body[:end])), triangles


def shape_of(names, vertices, triangles, colors):
    """Compiled graphics of a mesh; `colors` has red, green and blue of each vertex, from 0 to 1."""
    x, n = names.index("x"), names.index("nx")
    corners = [[cgo.COLOR, *color, cgo.NORMAL, *vertex[n:n + 3], cgo.VERTEX, *vertex[x:x + 3]]
               for vertex, color in zip(vertices, colors)]
    shape = [cgo.BEGIN, cgo.TRIANGLES]
    for triangle in triangles:
        for corner in triangle:
            shape += corners[corner]
    return shape + [cgo.END]


def run_program(folder, options):
    words = [os.environ.get("VDB_MOLSURF", "vdb_molsurf"), "atoms.cif", "-o", "surface.ply", "-o", "surface.atoms.csv"]
    for name, value in options.items():
        switch = str(value).lower() in ("1", "true", "yes", "on") and name in (
            "fill_cavities", "waters", "ions", "no_hetero", "no_hydrogens", "sharp_colors",
            "crisp")  # its name of before
        words += ["--" + name.replace("_", "-")] + ([] if switch else [str(value)])
    try:
        done = subprocess.run(words, cwd=folder, capture_output=True, text=True)
    except OSError as error:
        raise CmdException(f"{words[0]} does not start: {error.strerror} "
                           "[hint: install vdb_molsurf, or set VDB_MOLSURF to its path]") from None
    if done.returncode not in (0, 3) or not (folder / "surface.ply").exists():
        raise CmdException((done.stderr.strip().splitlines() or ["vdb_molsurf failed"])[-1])
    return done.stderr


def set_areas(selection, rows, _self):
    """Areas into b; atoms that are not used have 0."""
    areas = {(row["chain"].strip("_"), row["number"] + row["insertion_code"].strip(), row["atom"]): float(row["area"])
             for row in rows}
    _self.alter(selection, "b = areas.get((chain, resi, name), 0.0)", space={"areas": areas})


def molsurf(selection="all", name="molsurf", state=-1, color="atom", quiet=0, _self=cmd, **options):
    """
DESCRIPTION

    Makes the surface of atoms by vdb_molsurf: an object of compiled graphics, and areas as B factors.

USAGE

    molsurf [ selection [, name [, state [, color [, option=value ...]]]]]

EXAMPLE

    molsurf polymer, surface=ses, voxel=0.5, color=chain
    """
    if not _self.count_atoms(selection):
        raise CmdException(f'"{selection}": expected atoms, got none')
    options = {word: value for word, value in options.items() if not word.startswith("_")}
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        _self.save(str(folder / "atoms.cif"), selection, int(state), quiet=1)
        if color != "atom":
            options["color"] = color
        log = run_program(folder, options)
        names, vertices, triangles = read_mesh(folder / "surface.ply")
        with open(folder / "surface.atoms.csv", newline="") as file:
            rows = list(csv.DictReader(file))
    if color == "atom":
        indices = []
        _self.iterate(selection, "indices.append(color)", space={"indices": indices})
        tuples = {index: _self.get_color_tuple(index) for index in set(indices)}
        atom = names.index("atom_id")
        colors = [tuples[indices[vertex[atom]]] for vertex in vertices]
    elif "red" in names:
        red = names.index("red")
        colors = [[c / 255 for c in vertex[red:red + 3]] for vertex in vertices]
    else:
        colors = [PLAIN] * len(vertices)
    _self.delete(name)
    _self.load_cgo(shape_of(names, vertices, triangles, colors), name)
    set_areas(selection, rows, _self)
    if not int(quiet):
        print(log.strip())
        print(f" molsurf: object {name} with {len(triangles)} triangles, "
              f"{sum(float(row['area']) for row in rows):.1f} A^2 in B factors")


cmd.extend("molsurf", molsurf)
cmd.auto_arg[0]["molsurf"] = cmd.auto_arg[0]["align"]
