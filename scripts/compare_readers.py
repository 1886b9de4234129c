#!/usr/bin/env python3
# SPDX-License-Identifier: MPL-2.0
"""Holds what vdb_molsurf reads of the files of a folder against gemmi, biotite and MDAnalysis:
    compare_readers.py PROGRAM FOLDER
For each file the atoms of the first model, their elements, chains and residues, and how many are of protein and of
water. Prints a line for each difference, and at the end how many files were read by whom. The three readers come from
PyPI; what is not installed is left out. docs/structures.md lists the differences that stay."""

import collections
import csv
import pathlib
import re
import subprocess
import sys
import tempfile
import typing
import warnings

ENDINGS = re.compile(r"\.(pdb|ent|cif|mmcif|bcif|gro|sdf|mol|mol2|pqr|pdbqt|xyz)(\.gz|\.bz2|\.xz)?$")
WATER = {"HOH", "WAT", "DOD", "TIP3", "TIP", "SOL", "SPC", "TIP3P", "T3P", "TP3", "H2O", "SOLV"}
NO_ELEMENTS = {"", "X", "EP", "VS"}


def counts(elements):
    """Elements and how many atoms have them; deuterium is hydrogen, and what is no element is left out."""
    named = (e.strip().capitalize() for e in elements)
    return dict(sorted(collections.Counter("H" if e == "D" else e for e in named if e.upper() not in NO_ELEMENTS).items()))


class Content(typing.NamedTuple):
    """What a reader finds in a file; None: it does not say."""
    atoms: int
    elements: dict
    residues: set  # (chain, name, number, insertion code)
    pieces: int  # residues, where one that comes again counts twice
    water: int
    protein: int
    first: str = ""  # the first line of vdb_molsurf


def content(elements, residues, protein=None):
    """Of one element and one residue an atom."""
    pieces = sum(1 for n, residue in enumerate(residues) if n == 0 or residue != residues[n - 1])
    water = sum(residue[1] in WATER for residue in residues)
    return Content(len(residues), counts(elements) if elements is not None else None, set(residues), pieces, water, protein)


def ours(program, path):
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder)
        done = subprocess.run([program, path, "--surface", "vdw", "--hetero", "--waters", "--altloc", "all", "-o", out / "x.atoms.csv",
                               "-o", out / "x.residues.csv", "-j", "1", "--no-progress"], capture_output=True, timeout=300)
        error = done.stderr.decode("utf8", "replace")
        if done.returncode != 0:
            return None, error.strip().splitlines()[-1] if error else f"status {done.returncode}"
        info = subprocess.run([program, "info", path], capture_output=True, timeout=300).stdout.decode("utf8", "replace")
        first = error.splitlines()[0]
        atoms = int(re.search(r", (\d+) atoms?[ ;]", first).group(1))
        rows = list(csv.DictReader(open(out / "x.atoms.csv", newline="")))
        residues = [(r["chain"].strip("_"), r["residue"], int(r["number"]), r["insertion_code"].strip()) for r in rows]
        pieces = sum(1 for _ in open(out / "x.residues.csv")) - 1
        protein = re.search(r"^    protein +(\d+) atom", info, re.M)
        made = content([row["element"] for row in rows], residues, int(protein.group(1)) if protein else 0)
        return made._replace(atoms=atoms, pieces=pieces, first=first), ""


def by_gemmi(path):
    import gemmi
    if not re.search(r"\.(pdb|ent|cif|mmcif)(\.gz)?$", path):
        return None
    structure = gemmi.read_structure(path)
    atoms = [cra for cra in structure[0].all()] if len(structure) else []
    return content([cra.atom.element.name for cra in atoms],
                   [(cra.chain.name, cra.residue.name, cra.residue.seqid.num, cra.residue.seqid.icode.strip())
                    for cra in atoms]) if atoms else None


def by_biotite(path):
    import biotite.structure as structure
    import biotite.structure.io as io
    if not re.search(r"\.(pdb|cif|bcif|gro|sdf|mol|pdbqt)$", path):
        return None
    options = {"altloc": "all"} if re.search(r"\.(pdb|cif|bcif)$", path) else {}
    if re.search(r"\.(pdb|cif|bcif|gro|pdbqt)$", path):
        options["model"] = 1
    atoms = io.load_structure(path, **options)
    if atoms.coord.ndim == 3:
        atoms = atoms[0]
    residues = list(zip(atoms.chain_id.tolist(), atoms.res_name.tolist(), atoms.res_id.tolist(), atoms.ins_code.tolist()))
    return content(atoms.element, residues, int(structure.filter_amino_acids(atoms).sum()))


def by_mdanalysis(path):
    import MDAnalysis
    if not re.search(r"\.(pdb|ent|gro|mol2|pqr|pdbqt|xyz)(\.gz|\.bz2)?$", path):
        return None
    atoms = MDAnalysis.Universe(path).atoms
    if not hasattr(atoms, "resnames"):
        return Content(len(atoms), counts(atoms.elements) if hasattr(atoms, "elements") else None, None, None, None, None)
    chains = atoms.chainIDs if hasattr(atoms, "chainIDs") else atoms.segids
    codes = atoms.icodes if hasattr(atoms, "icodes") else [""] * len(atoms)
    residues = list(zip(("" if c in ("SYSTEM", "X") else c for c in chains), atoms.resnames, map(int, atoms.resids), codes))
    return content(atoms.elements if hasattr(atoms, "elements") else None, residues, len(atoms.select_atoms("protein")))


def differences(mine, other):
    """What is different, but for atoms that we leave out and name on the first line: duplicates and particles. Elements
    count only if the other reader has those of all atoms."""
    aside = re.search(r"(\d+) particle", mine.first)
    aside = int(aside.group(1)) if aside else 0
    if mine.atoms != other.atoms:
        yield f"atoms: {mine.atoms} for {other.atoms}"
    whole = other.elements is not None and sum(other.elements.values()) + aside >= other.atoms and "duplicate" not in mine.first
    if whole and mine.elements != other.elements:
        yield f"elements: {mine.elements} for {other.elements}"
    if mine.atoms != other.atoms or aside or "duplicate" in mine.first or other.residues is None:
        return
    if mine.water != other.water:
        yield f"water: {mine.water} for {other.water}"
    chains = [sorted({residue[0] for residue in one.residues}) for one in (mine, other)]
    if chains[0] != chains[1]:
        yield f"chains: {chains[0][:9]} for {chains[1][:9]}"
    elif mine.residues != other.residues:
        yield f"residues: {sorted(mine.residues - other.residues)[:3]} for {sorted(other.residues - mine.residues)[:3]}"
    elif mine.pieces > other.pieces:
        yield f"pieces: {mine.pieces} for {other.pieces}"
    if other.protein is not None and mine.protein != other.protein:
        yield f"protein: {mine.protein} atoms for {other.protein}"


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
                print(f"{name} | {reader} | {line}" + (f" | {mine.first}" if mine and "atoms" in line else ""))
    print(f"{len(files)} files;", ", ".join(f"{reader} {n}" for reader, n in read.items()), "read;",
          ", ".join(f"{n} differ from {reader}" for reader, n in different.items()))


main()
