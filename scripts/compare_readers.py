#!/usr/bin/env python3
# SPDX-License-Identifier: MPL-2.0
"""Holds what vdb_molsurf reads of the files of a folder against gemmi, biotite and MDAnalysis:
    compare_readers.py PROGRAM FOLDER
For each file the atoms of the first model, their elements, and how many are of water. Prints a line for each
difference, and at the end how many files were read by whom. The three readers come from PyPI; what is not
installed is left out. docs/structures.md lists the differences that stay."""

import collections
import csv
import pathlib
import re
import subprocess
import sys
import tempfile
import warnings

ENDINGS = re.compile(r"\.(pdb|ent|cif|mmcif|bcif|gro|sdf|mol|mol2|pqr|pdbqt|xyz)(\.gz|\.bz2|\.xz)?$")
WATER = {"HOH", "WAT", "DOD", "TIP3", "TIP", "SOL", "SPC", "TIP3P", "T3P", "TP3", "H2O", "SOLV"}
NO_ELEMENTS = {"", "X", "EP", "VS"}


def counts(elements):
    """Elements and how many atoms have them; deuterium is hydrogen, and what is no element is left out."""
    named = (e.strip().capitalize() for e in elements)
    return dict(sorted(collections.Counter("H" if e == "D" else e for e in named if e.upper() not in NO_ELEMENTS).items()))


def ours(program, path):
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "x.atoms.csv"
        done = subprocess.run([program, path, "--surface", "vdw", "--hetero", "--waters", "--altloc", "all", "-o", out,
                               "-j", "1", "--no-progress"], capture_output=True, timeout=300)
        error = done.stderr.decode("utf8", "replace")
        if done.returncode != 0:
            return None, error.strip().splitlines()[-1] if error else f"status {done.returncode}"
        first = error.splitlines()[0]
        atoms = int(re.search(r", (\d+) atoms?[ ;]", first).group(1))
        rows = list(csv.DictReader(open(out, newline="")))
        water = sum(row["residue"] in WATER for row in rows)
        return (atoms, counts(row["element"] for row in rows), water, first), ""


def by_gemmi(path):
    import gemmi
    if not re.search(r"\.(pdb|ent|cif|mmcif)(\.gz)?$", path):
        return None
    structure = gemmi.read_structure(path)
    atoms = [cra for cra in structure[0].all()] if len(structure) else []
    return (len(atoms), counts(cra.atom.element.name for cra in atoms),
            sum(cra.residue.name in WATER for cra in atoms)) if atoms else None


def by_biotite(path):
    import biotite.structure.io as io
    if not re.search(r"\.(pdb|cif|bcif|gro|sdf|mol|pdbqt)$", path):
        return None
    options = {"altloc": "all"} if re.search(r"\.(pdb|cif|bcif)$", path) else {}
    if re.search(r"\.(pdb|cif|bcif|gro|pdbqt)$", path):
        options["model"] = 1
    atoms = io.load_structure(path, **options)
    if atoms.coord.ndim == 3:
        atoms = atoms[0]
    return atoms.array_length(), counts(atoms.element), sum(name in WATER for name in atoms.res_name)


def by_mdanalysis(path):
    import MDAnalysis
    if not re.search(r"\.(pdb|ent|gro|mol2|pqr|pdbqt|xyz)(\.gz|\.bz2)?$", path):
        return None
    atoms = MDAnalysis.Universe(path).atoms
    elements = counts(atoms.elements) if hasattr(atoms, "elements") else None
    return len(atoms), elements, sum(name in WATER for name in atoms.resnames) if hasattr(atoms, "resnames") else None


def differences(mine, other):
    """What is different, but for atoms that we leave out and name on the first line: duplicates and particles. Elements
    count only if the other reader has those of all atoms."""
    atoms, elements, water, first = mine
    aside = re.search(r"(\d+) particle", first)
    aside = int(aside.group(1)) if aside else 0
    if atoms != other[0]:
        yield f"atoms: {atoms} for {other[0]}"
    whole = other[1] is not None and sum(other[1].values()) + aside >= other[0] and "duplicate" not in first
    if whole and elements != other[1]:
        yield f"elements: {elements} for {other[1]}"
    if other[2] is not None and "duplicate" not in first and not water <= other[2] <= water + aside:
        yield f"water: {water} for {other[2]}"


READERS = {"gemmi": by_gemmi, "biotite": by_biotite, "MDAnalysis": by_mdanalysis}


def main():
    program, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    warnings.simplefilter("ignore")
    files = sorted(str(path) for path in folder.rglob("*") if path.is_file() and ENDINGS.search(path.name.lower()))
    read = collections.Counter()
    different = collections.Counter()
    for path in files:
        mine, why = ours(program, path)
        read["vdb_molsurf"] += mine is not None
        name = str(pathlib.Path(path).relative_to(folder))
        for reader, by in READERS.items():
            try:
                other = by(path)
            except Exception:  # what another reader refuses is no measure
                continue
            if other is None:
                continue
            read[reader] += 1
            told = []
            if mine is None:
                told.append(f"refused: {why}")
            else:
                told += differences(mine, other)
            different[reader] += bool(told)
            for line in told:
                print(f"{name} | {reader} | {line}" + (f" | {mine[3]}" if mine and "atoms" in line else ""))
    print(f"{len(files)} files;", ", ".join(f"{reader} {n}" for reader, n in read.items()), "read;",
          ", ".join(f"{n} differ from {reader}" for reader, n in different.items()))


main()
