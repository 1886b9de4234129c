#!/usr/bin/python3
# SPDX-License-Identifier: MPL-2.0
"""Times many small structures at once: structures a second and core, by vdb_molsurf and by other programs.

    bench/batch.py build-release/tools/vdb_molsurf FOLDER [--files 1000] [--others 100] [--python PYTHON] [--voxel 1.0 0.75 0.5]

The files are made of the structures in FOLDER: chains of 500 to 5,000 atoms, each turned at random until there are enough. All
programs run on one core (taskset) and take turns; processor seconds are those of all their processes together.
- vdb_molsurf batch: one process, --threads 1, a mesh (.ply) and a report a structure; and --surface sas with the report alone.
- The module, if PYTHON has it: vdb_molsurf.map() with one worker, and by the wall clock with two against one.
- EDTSurf (Debian: edtsurf), a process a structure: -s 3 makes the solvent-excluded surface as a .ply, on a grid of its own choice.
- FreeSASA (Debian: freesasa), 20 slices, its default: areas alone.
"""

import argparse
import gzip
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

import numpy as np


def chains_of(path):
    """The lines of each chain of the first model of a PDB file, without waters."""
    opened = gzip.open if path.suffix == ".gz" else open
    chains = {}
    for line in opened(path, "rt", errors="replace"):
        if line.startswith("ENDMDL"):
            break
        if line.startswith("ATOM") and line[16] in " A":
            chains.setdefault(line[21], []).append(line)
    return [lines for lines in chains.values() if 500 <= len(lines) <= 5000]


def turned(lines, random):
    """The same atoms in another pose."""
    q = random.normal(size=4)
    w, x, y, z = q / np.linalg.norm(q)
    turn = np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])
    places = np.array([[float(line[a:a + 8]) for a in (30, 38, 46)] for line in lines])
    places = (places - places.mean(axis=0)) @ turn.T + random.uniform(-1, 1, 3)
    return [line[:30] + "".join(f"{v:8.3f}" for v in place) + line[54:] for line, place in zip(lines, places)]


def make_files(source, count, folder):
    """Writes the files, and returns their paths and how many atoms they have."""
    chains = [lines for path in sorted(source.iterdir())
              if path.name.endswith((".pdb", ".pdb.gz", ".ent")) for lines in chains_of(path)]
    if not chains:
        sys.exit(f"{source}: expected PDB files with chains of 500 to 5,000 atoms")
    random, paths, atoms = np.random.default_rng(1), [], 0
    for i in range(count):
        lines = chains[i % len(chains)]
        paths.append(folder / f"s{i:04d}.pdb")
        paths[-1].write_text("".join(turned(lines, random)) + "END\n")
        atoms += len(lines)
    print(f"{count} files of {len(chains)} chains, {atoms / count:.0f} atoms on average\n")
    return paths, atoms


def timed(command, **how):
    """Processor and wall seconds of a command, and whether it succeeded."""
    before, start = os.times(), time.monotonic()
    done = subprocess.run([str(word) for word in command], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, **how)
    after, wall = os.times(), time.monotonic() - start
    return after.children_user + after.children_system - before.children_user - before.children_system, wall, done


def row(name, count, atoms, cpu):
    print(f"| {name} | {count / cpu:.1f} | {1000 * cpu / (atoms / 1000):.0f} |", flush=True)


MAP = """
import sys
import vdb_molsurf as ms
if __name__ == "__main__":
    rows = list(ms.map(sys.argv[1], workers=int(sys.argv[2]), size=25, kind="ses", voxel=float(sys.argv[3])))
    sys.exit(any(row["error"] for row in rows))
"""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("structures", type=pathlib.Path)
    parser.add_argument("--files", type=int, default=1000)
    parser.add_argument("--python", help="a Python that has the module")
    parser.add_argument("--voxel", type=float, nargs="+", default=[1.0, 0.75, 0.5])
    parser.add_argument("--others", type=int, default=100, help="files that EDTSurf and FreeSASA get [100]")
    words = parser.parse_args()
    one = ["taskset", "-c", "0"]
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        (folder / "in").mkdir()
        paths, atoms = make_files(words.structures, words.files, folder / "in")
        print("| program | structures a second and core | CPU ms a 1,000 atoms |\n|---|---|---|")

        def batch(name, *options):
            out = folder / "out"
            cpu, _, done = timed([*one, words.program, "batch", folder / "in", "-O", out, "--threads", "1", "-q", *options])
            if done.returncode not in (0, 3):
                sys.exit(f"{name}: {done.stderr.decode()}")
            row(name, words.files, atoms, cpu)
            shutil.rmtree(out)
        for voxel in words.voxel:
            batch(f"vdb_molsurf batch, ses, {voxel} Å", "--surface", "ses", "--voxel", voxel, "--formats", "ply,json")
        batch("vdb_molsurf batch, variational, 1 Å", "--voxel", 1, "--formats", "ply,json")
        batch("vdb_molsurf batch, sas in closed form", "--surface", "sas", "--formats", "json")
        if words.python:
            script = folder / "map.py"
            script.write_text(MAP)
            for voxel in words.voxel:
                cpu, _, done = timed([*one, words.python, script, folder / "in", 1, voxel])
                if done.returncode:
                    sys.exit(f"map: {done.stderr.decode()}")
                row(f"vdb_molsurf.map, ses, {voxel} Å", words.files, atoms, cpu)
            walls = {workers: timed([words.python, script, folder / "in", workers, words.voxel[0]])[1] for workers in (1, 2)}
            print(f"\nTwo workers are {walls[1] / walls[2]:.2f} times as fast as one.\n")
        some = paths[:words.others]
        share = sum(len(path.read_text().splitlines()) - 1 for path in some)
        if shutil.which("EDTSurf"):
            cpu = sum(timed([*one, "EDTSurf", "-i", path, "-o", folder / "edt", "-s", "3", "-h", "1"])[0] for path in some)
            row("EDTSurf -s 3", len(some), share, cpu)
        if shutil.which("freesasa"):
            cpu, _, done = timed([*one, "freesasa", *some])
            row("FreeSASA, 20 slices", len(some), share, cpu)


if __name__ == "__main__":
    main()
