#!/usr/bin/python3
# SPDX-License-Identifier: MPL-2.0
"""Measures how far an answer depends on where the molecule lies on the grid.

    bench/rotations.py PROGRAM STRUCTURE [--count N] [--seed N] [--json FILE] [--least N] [options of the program ...]

The structure is turned about its centre at random and shifted by less than an Å, ten times, always in the same way
for one seed, and the program runs on each. One row for a position tells area, volume, Euler number, cavities,
components and exit status; the last rows tell means and ranges of area and volume, and how many positions agree on
each count. FILE gets all areas as a list, all volumes and so on. With --least the exit status is 1 if fewer positions
have the commonest Euler number. STRUCTURE is a .pdb, .ent, .cif, .pqr or .xyzr file,
or one of them with .gz. Operators of assemblies (REMARK 350) are turned with the atoms in the PDB format only. Its
coordinates have three decimals, so they are rounded by up to 0.0005 Å. Of surfaces whose area and volume are known in
closed form those of the mesh are told. Needs numpy.
"""

import argparse
import collections
import gzip
import json
import pathlib
import subprocess
import sys
import tempfile

import numpy


def random_rotation(generator):
    """A rotation, all equally likely, from a unit quaternion."""
    w, x, y, z = (q := generator.normal(size=4)) / numpy.linalg.norm(q)
    return numpy.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


class Pdb:
    """Coordinates and assembly operators of a .pdb or .ent file."""

    def __init__(self, lines):
        self.lines = lines
        self.rows = [i for i, line in enumerate(lines) if line.startswith(("ATOM  ", "HETATM"))]
        self.positions = numpy.array([[float(lines[i][k:k + 8]) for k in (30, 38, 46)] for i in self.rows])
        biomt = [i for i, line in enumerate(lines) if line.startswith("REMARK 350   BIOMT")]
        self.operators = [biomt[i:i + 3] for i in range(0, len(biomt), 3)]

    def moved(self, R, t):
        lines = list(self.lines)
        for i, p in zip(self.rows, self.positions @ R.T + t):
            lines[i] = lines[i][:30] + "%8.3f%8.3f%8.3f" % tuple(p) + lines[i][54:]
        for rows in self.operators:
            numbers = numpy.array([[float(word) for word in lines[i][23:].split()[:4]] for i in rows])
            M = R @ numbers[:, :3] @ R.T
            v = R @ numbers[:, 3] + t - M @ t
            for i, row, shift in zip(rows, M, v):
                lines[i] = lines[i][:23] + "%10.6f%10.6f%10.6f     %10.5f" % (*row, shift) + "\n"
        return lines


class Columns:
    """Coordinates in columns between blanks: .cif, .pqr and .xyzr files."""

    def __init__(self, lines, suffix):
        self.lines = lines
        self.rows, positions = [], []
        names = [line.strip() for line in lines if line.startswith("_atom_site.")]
        for i, line in enumerate(lines):
            words = line.split()
            if suffix == ".xyzr" and len(words) >= 4 and not line.startswith("#"):
                columns = [0, 1, 2]
            elif suffix == ".pqr" and line.startswith(("ATOM", "HETATM")):
                columns = [len(words) - 5 + k for k in range(3)]
            elif suffix in (".cif", ".mmcif") and line.startswith(("ATOM ", "HETATM ")):
                columns = [names.index("_atom_site.Cartn_" + axis) for axis in "xyz"]
            else:
                continue
            self.rows.append((i, columns))
            positions.append([float(words[k]) for k in columns])
        self.positions = numpy.array(positions)

    def moved(self, R, t):
        lines = list(self.lines)
        for (i, columns), p in zip(self.rows, self.positions @ R.T + t):
            words = lines[i].split()
            for k, value in zip(columns, p):
                words[k] = f"{value:.7f}"
            lines[i] = " ".join(words) + "\n"
        return lines


def read(path):
    """The structure of a file and its suffix without .gz."""
    packed = path.suffix == ".gz"
    suffix = pathlib.Path(path.stem).suffix if packed else path.suffix
    text = (gzip.open if packed else open)(path, "rt").read()
    lines = text.splitlines(keepends=True)
    return (Pdb(lines) if suffix in (".pdb", ".ent") else Columns(lines, suffix)), suffix


def spread(values):
    """The range as a percentage of the mean."""
    return 100 * (max(values) - min(values)) / numpy.mean(values)


def agreement(values):
    """The most frequent value and how many have it."""
    value, count = collections.Counter(values).most_common(1)[0]
    return f"{value} in {count} of {len(values)}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("structure", type=pathlib.Path)
    parser.add_argument("--count", type=int, default=10, help="positions [10]")
    parser.add_argument("--seed", type=int, default=1, help="of the rotations and shifts [1]")
    parser.add_argument("--json", type=pathlib.Path, metavar="FILE", help="a list for each of the five")
    parser.add_argument("--least", type=int, default=0, metavar="N", help="positions of one Euler number")
    args, words = parser.parse_known_args()
    structure, suffix = read(args.structure)
    if "--assembly" in words and not getattr(structure, "operators", None):
        sys.exit(f"{args.structure}: operators of assemblies are turned in .pdb files only")
    centre = structure.positions.mean(0)
    generator = numpy.random.default_rng(args.seed)
    names = ("area", "volume", "euler_characteristic", "cavities", "components")
    rows = []
    print("position       area        volume  Euler  cavities  components  status")
    for k in range(args.count):
        R, shift = random_rotation(generator), generator.uniform(0.0, 1.0, 3)
        with tempfile.TemporaryDirectory() as folder:
            turned, report = pathlib.Path(folder) / f"turned{suffix}", pathlib.Path(folder) / "report.json"
            turned.write_text("".join(structure.moved(R, centre + shift - R @ centre)))
            mesh = pathlib.Path(folder) / "mesh.stl"
            done = subprocess.run([args.program, turned, "-o", report, "-o", mesh, "-q", *words], check=False,
                                  stderr=subprocess.PIPE, text=True)
            if not report.exists():
                sys.exit(f"{args.program}: position {k + 1}: status {done.returncode}: {done.stderr.strip()}")
            s = json.loads(report.read_text())["surface"]
        for name in "area", "volume":
            s[name] = s[name] if s.get(f"mesh_{name}") is None else s[f"mesh_{name}"]
        rows.append([s[name] for name in names])
        print("%8d%13.3f%14.3f%7d%10d%12d%8d" % (k + 1, *rows[-1], done.returncode), flush=True)
    areas, volumes, eulers, cavities, components = columns = list(zip(*rows))
    if args.json:
        args.json.write_text(json.dumps(dict(zip(names, columns))))
    print(f"mean:  area {numpy.mean(areas):.3f} Å^2, volume {numpy.mean(volumes):.3f} Å^3")
    print(f"range: area {spread(areas):.4f} %, volume {spread(volumes):.4f} %")
    print(f"most:  Euler number {agreement(eulers)}, cavities {agreement(cavities)}, components {agreement(components)}")
    return 0 if max(map(eulers.count, eulers)) >= args.least else 1


if __name__ == "__main__":
    sys.exit(main())
