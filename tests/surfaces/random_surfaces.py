#!/usr/bin/python3
# SPDX-License-Identifier: MPL-2.0
"""Makes surfaces with options drawn at random, and holds each against what the program says of it.

    tests/surfaces/random_surfaces.py PROGRAM [--runs 200] [--seed 1] [--structures FOLDER | --molecules]

A run takes a structure (of tests/data, or of FOLDER), turned and shifted, or with --molecules 1 to 12 atoms at
random or on a lattice; a kind of surface, a voxel, a weight, and perhaps groups. With status 0 or 3 and a mesh, the
mesh has to be closed and a manifold, with the Euler number, the counts and the pieces that the report tells; with
any other status there is one line of error and no file. No run may take more than four times its estimated time
(a molecule: 5 s of processor time), nor 1.5 times its estimated memory or less than half of it. Prints a line for
each fault, and exits with 1 if there is one. The first line has the seed, the last but one the share of estimates of
memory that are 0.7 to 1.5 times the peak.
"""

import argparse
import collections
import gzip
import json
import math
import pathlib
import random
import resource
import subprocess
import sys
import tempfile

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
KINDS = ("variational", "variational", "variational", "ses", "sas", "vdw", "gaussian")
MOST_ATOMS = {0.25: 1500, 0.5: 12000}  # on so small voxels, for the time that it takes


def read_ply(path):
    """(positions, triangles) of a binary .ply with triangles alone."""
    header, body = path.read_bytes().split(b"end_header\n", 1)
    types = {"float": "<f4", "int": "<i4", "uchar": "u1"}
    counts, fields, element = {}, [], ""
    for line in header.decode().splitlines():
        words = line.split()
        if words[0] == "element":
            element = words[1]
            counts[element] = int(words[2])
        elif words[0] == "property" and element == "vertex":
            fields.append((words[2], types[words[1]]))
    vertices = np.frombuffer(body, np.dtype(fields), counts["vertex"])
    faces = np.frombuffer(body, np.dtype([("n", "u1"), ("v", "<i4", 3)]), counts["face"], vertices.nbytes)
    return np.stack([vertices[axis] for axis in "xyz"], 1).astype(float), faces["v"]


def faults_of_mesh(path, report):
    """What the mesh contradicts."""
    surface = report["surface"]
    x, t = read_ply(path)
    edges = np.sort(np.concatenate([t[:, [0, 1]], t[:, [1, 2]], t[:, [2, 0]]]), 1)
    ends, counts = np.unique(edges[:, 0].astype(np.int64) * len(x) + edges[:, 1], return_counts=True)
    if (counts != 2).any():
        yield f"{(counts != 2).sum()} edges have not two triangles"
    directed = np.concatenate([t[:, [0, 1]], t[:, [1, 2]], t[:, [2, 0]]])
    if len(np.unique(directed[:, 0].astype(np.int64) * len(x) + directed[:, 1])) != len(directed):
        yield "triangles are oriented differently"
    chi = len(x) - len(ends) + len(t)
    for said, found in (("mesh_euler_characteristic", chi), ("vertices", len(x)), ("triangles", len(t))):
        if surface[said] != found:
            yield f"{said}: the report says {surface[said]}, the mesh has {found}"
    if not (surface["closed"] and surface["manifold"]):
        yield "the report says that it is not closed, or no manifold"
    a, b, c = (x[t[:, k]] - x[0] for k in range(3))
    volume = np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6
    if abs(volume - surface["volume"]) > 0.4 * report["voxel"] * surface["area"]:
        yield f"volume: the report says {surface['volume']}, the triangles enclose {volume}"
    if surface["max_residual"] is not None and surface["max_residual"] > 1e-3 * report["voxel"]:
        yield f"a vertex lies {surface['max_residual']} beside the surface"
    if surface["kind"] in ("variational", "gaussian") and surface["euler_characteristic"] != chi:
        yield f"euler_characteristic: {surface['euler_characteristic']}, the mesh has {chi}"


def turned(text, rng):
    """The ATOM and HETATM records of a PDB file, turned and shifted."""
    q = np.array([rng.gauss(0, 1) for _ in range(4)])
    w, i, j, k = q / np.linalg.norm(q)
    rotation = np.array([[1 - 2 * (j * j + k * k), 2 * (i * j - k * w), 2 * (i * k + j * w)],
                         [2 * (i * j + k * w), 1 - 2 * (i * i + k * k), 2 * (j * k - i * w)],
                         [2 * (i * k - j * w), 2 * (j * k + i * w), 1 - 2 * (i * i + j * j)]])
    lines = [line for line in text.splitlines() if line[:6] in ("ATOM  ", "HETATM")]
    x = np.array([[float(line[b:b + 8]) for b in (30, 38, 46)] for line in lines])
    x = (x - x.mean(0)) @ rotation.T + np.array([rng.uniform(0, 3) for _ in range(3)])
    return "\n".join(f"{line[:30]}{p[0]:8.3f}{p[1]:8.3f}{p[2]:8.3f}{line[54:]}" for line, p in zip(lines, x)) + "\n"


def structures(folders):
    """name -> PDB text of the first model, of files that have one."""
    found = {}
    for folder in folders:
        for path in sorted(pathlib.Path(folder).glob("*")):
            if not path.name.endswith((".pdb", ".pdb.gz", ".ent", ".ent.gz")):
                continue
            data = gzip.decompress(path.read_bytes()) if path.suffix == ".gz" else path.read_bytes()
            text = data.decode(errors="replace").split("\nENDMDL")[0]
            if 10 < text.count("\nATOM") < 20000:
                found.setdefault(path.name, text)
    return found


def molecule(rng):
    """The ATOM records of 1 to 12 atoms in two chains, near one another or on a lattice."""
    pitch, side = rng.choice((0.7, 1.4, 2.0, 3.4)), rng.uniform(1, 12)
    lattice, shift = rng.random() < 0.4, rng.choice((0, 0, 0.37, 100, -900))
    lines = []
    for i in range(rng.randint(1, 12)):
        x, y, z = (shift + (pitch * rng.randrange(4) if lattice else rng.uniform(0, side)) for _ in range(3))
        chain = rng.choice("AAB")
        lines.append(f"ATOM  {i + 1:5d}  {rng.choice('CNOS')}   GLY {chain}{i + 1:4d}    {x:8.3f}{y:8.3f}{z:8.3f}  1.00")
    return "\n".join(lines) + "\n"


def draw_molecule(rng):
    """Words of a run of a molecule."""
    words = ["--surface", rng.choice(KINDS), "--voxel", f"{10 ** rng.uniform(-0.6, 1):.3g}"]
    if rng.random() < 0.3:
        words += ["--probe", rng.choice(("0", "0.1", "1", "3"))]
    if rng.random() < 0.4:
        words += ["--group-by", rng.choice(("chain", "residues:1", "residues:3"))]
    return words


def draw(rng, files):
    """(name, words) of a run."""
    while True:
        name = rng.choice(sorted(files))
        voxel = rng.choice((2.0, 1.0, 0.7, 0.5, 0.25))
        if files[name].count("\nATOM") <= MOST_ATOMS.get(voxel, 1e9):
            break
    kind = rng.choice(KINDS)
    words = ["--surface", kind, "--voxel", str(voxel)]
    if kind == "variational":
        words += ["--lambda", f"{10 ** rng.uniform(-3, 0):.4g}"]
    if rng.random() < 0.15:
        words += ["--probe", rng.choice(("0", "0.5", "1", "2", "3"))]
    if rng.random() < 0.2:
        words += ["--group-by", rng.choice(("chain", "residues:20"))]
    if rng.random() < 0.1:
        words += ["--fill-cavities"]
    return name, words


def estimate(program, words):
    """(bytes, processor seconds) by --dry-run."""
    said = subprocess.run([program, *words, "-o", "a.ply", "-o", "a.json", "--dry-run"], capture_output=True, text=True).stderr.split()
    for unit, bytes_ in (("MiB", 2**20), ("GiB", 2**30)):
        if unit in said:
            return float(said[said.index(unit) - 1]) * bytes_, float(said[-5])
    return math.inf, math.inf


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--runs", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--structures", action="append", default=[])
    parser.add_argument("--molecules", action="store_true")
    args = parser.parse_args()
    files = structures([ROOT / "tests/data", *args.structures])
    print(f"seed {args.seed}, {args.runs} runs, {'molecules' if args.molecules else f'{len(files)} structures'}")
    counts, faulty, slow, sizes = collections.Counter(), 0, [], []
    for number in range(args.runs):
        rng = random.Random(f"{args.seed} {number}")  # each run by itself
        name, words = ("molecule", draw_molecule(rng)) if args.molecules else draw(rng, files)
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            (folder / "a.pdb").write_text(molecule(rng) if args.molecules else turned(files[name], rng))
            words = [str(folder / "a.pdb"), *words]
            before = resource.getrusage(resource.RUSAGE_CHILDREN)
            done = subprocess.run([args.program, *words, "-j", "1", "-o", folder / "a.ply", "-o", folder / "a.json"],
                                  capture_output=True, text=True)
            after = resource.getrusage(resource.RUSAGE_CHILDREN)
            seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
            faults, made = [], sorted(p.name for p in folder.iterdir())
            counts[done.returncode] += 1
            if args.molecules and seconds > 5:
                faults.append(f"it took {seconds:.1f} s")
            if "a.ply" in made:
                report = json.loads((folder / "a.json").read_text())
                faults += faults_of_mesh(folder / "a.ply", report)
                size, time_of = estimate(args.program, words)
                slow.append(seconds / max(time_of, 1.0))
                sizes.append(size / report["peak_memory_bytes"])
                if seconds > 4 * time_of and seconds > 5:
                    faults.append(f"it took {seconds:.1f} s, estimated {time_of:.1f}")
                if not size / 2 <= report["peak_memory_bytes"] <= 1.5 * size:
                    faults.append(f"it took {report['peak_memory_bytes']} bytes, estimated {size:.0f}")
            if done.returncode == 0 and "a.ply" not in made:
                faults.append("status 0 and no mesh")
            if done.returncode in (1, 3) and "a.ply" not in made and done.stderr.count("error: ") != 1:
                faults.append("no line of error")
            if done.returncode not in (0, 1, 3):
                faults.append(f"status {done.returncode}: {done.stderr[-300:]}")
            if done.returncode == 1 and made != ["a.pdb"]:
                faults.append(f"status 1 and the files {made}")
        for fault in faults:
            print(f"run {number}: {name} {' '.join(words[1:])}: {fault}", flush=True)
        faulty += bool(faults)
    print(f"statuses {dict(counts)}; time over its estimate: {max(slow, default=0):.2f} at most; estimated memory over "
          f"its peak: {min(sizes, default=0):.2f} to {max(sizes, default=0):.2f}, "
          f"{sum(0.7 <= size <= 1.5 for size in sizes)} of {len(sizes)} within 0.7 to 1.5")
    print(f"surfaces: {args.runs} runs, {faulty} faults")
    return 1 if faulty else 0


if __name__ == "__main__":
    sys.exit(main())
