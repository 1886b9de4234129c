#!/usr/bin/python3
# SPDX-License-Identifier: MPL-2.0
"""Measures how often tunnels of a site begin at its ligand.

    bench/tunnel_starts.py FOLDER [PROGRAM]

FOLDER has complexes as .pdb files, such as those of PLIP's tests (plip/test/pdb). Of each ligand of eight atoms or more
the residues within 4 Å are its site. Ten choices of one, two, three or all of these are given to --tunnels-from, without
the ligand. The start is right if it is within 2.5 Å of an atom of the ligand. A line for each number of residues; then
one for all.
"""

import collections
import json
import math
import pathlib
import random
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
NO_LIGANDS = ("HOH", "MSE")
CHOICES = (1, 1, 1, 2, 2, 2, 3, 3, 3, None)  # numbers of residues; None: all


def atoms_of(path):
    """(record, residue name, (chain, number), place) of the heavy atoms of the first model."""
    for line in path.read_text(errors="replace").splitlines():
        if line.startswith("ENDMDL"):
            return
        if line.startswith(("ATOM", "HETATM")) and line[16] in " A" and "H" not in (line[12], line[13]):
            yield (line[:6].strip(), line[17:20].strip(), (line[21], line[22:26].strip()),
                   tuple(float(line[i:i + 8]) for i in (30, 38, 46)))


def sites_of(path):
    """(atoms of a ligand, residues of its site) of each."""
    atoms, ligands = list(atoms_of(path)), collections.defaultdict(list)
    for record, name, residue, place in atoms:
        if record == "HETATM" and name not in NO_LIGANDS:
            ligands[(name, *residue)].append(place)
    for ligand in ligands.values():
        near = {residue for record, _, residue, place in atoms
                if record == "ATOM" and min(math.dist(place, other) for other in ligand) < 4}
        if len(ligand) >= 8 and len(near) >= 6:
            yield ligand, sorted(near)


def start_of(program, path, residues, folder):
    """The place where tunnels begin, or None."""
    select = " or ".join(f"(chain {chain} and resid {number})" for chain, number in residues)
    out = pathlib.Path(folder) / "start.json"
    done = subprocess.run([program, path, "--no-hetero", "--surface", "sas", "--tunnels-from", select, "-o", out, "--force", "-q"],
                          stderr=subprocess.DEVNULL)
    return json.loads(out.read_text())["tunnels"]["start"]["center"] if done.returncode == 0 else None


def main():
    folder, program = pathlib.Path(sys.argv[1]), (sys.argv[2:] or [ROOT / "build-release/tools/vdb_molsurf"])[0]
    chance, right = random.Random(1), collections.defaultdict(list)
    with tempfile.TemporaryDirectory() as scratch:
        for path in sorted(folder.glob("*.pdb")):
            for ligand, site in sites_of(path):
                for count in CHOICES:
                    chosen = chance.sample(site, min(count or len(site), len(site)))
                    start = start_of(program, path, chosen, scratch)
                    right[count].append(start is not None and min(math.dist(start, atom) for atom in ligand) < 2.5)
    right["any number of"] = [one for some in list(right.values()) for one in some]
    for count, some in right.items():
        print(f"{count or 'all'} residues: {100 * sum(some) / len(some):.0f} % of {len(some)}")


if __name__ == "__main__":
    main()
