#!/usr/bin/python3
# SPDX-License-Identifier: MPL-2.0
"""Compares estimates with what runs take: bench/estimates.py PROGRAM [--structures FOLDER] [NAME ...]

Each product is made of a small and of a large molecule, and each kind of surface of three capsids on voxels of 0.5 to
3 A. A row has the time and the memory that --dry-run says and those of the run on one core. Taken over said has to be
0.4 to 2.5 of the seconds where a run takes more than 0.3 s, and 0.7 to 1.5 of the memory where it takes more than
60 MB. NAME is a part of the names of the rows to run; without FOLDER those of capsids are left out. The constants of
src/molsurf/scale/bricks/plan_bricks.cpp and src/molsurf/surface/product_cost.cpp are from this table.
"""

import argparse
import os
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
SECONDS, MEMORY = (0.4, 2.5), (0.7, 1.5)
LEAST_SECONDS, LEAST_MEMORY = 0.3, 60e6
LIMIT = 600  # CPU seconds of a run

SMALL, LARGE, LARGER = "1a8o.cif.gz", "4at1.ent.gz", "1aoi.pdb.gz"
SCALE = {"MiB": 2**20, "GiB": 2**30, "TiB": 2**40, "KiB": 2**10, "bytes": 1, "byte": 1}

# Options and outputs of each product.
PRODUCTS = {
    "pockets": ("--pockets", "a.pockets.csv"),
    "pockets wide": ("--pockets --probe-out 20", "a.pockets.csv"),
    "pockets fine": ("--pockets --voxel 0.35", "a.pockets.csv"),
    "pore": ("--pore auto", "a.pore.csv"),
    "tunnels": ("--tunnels-from chain_A_and_resid_164 --probe-out 8", "a.tunnels.csv"),
    "areas": ("--surface ses", "a.atoms.csv"),
    "areas sas": ("--surface sas", "a.residues.csv"),
    "interfaces": ("--surface sas --interfaces", "a.interfaces.csv"),
    "interfaces ses": ("--surface ses --interfaces", "a.interfaces.csv"),
    "contacts": ("--surface sas --contacts atom", "a.contacts.csv"),
    "depths": ("--fields depth", "a.atoms.csv"),
    "remesh": ("--remesh 1", "a.ply"),
    "remesh fine": ("--remesh 0.3", "a.ply"),
    "remesh adapt": ("--remesh 1 --adapt 0.01", "a.ply"),
    "wall": ("--print-scale 1 --min-thickness 3", "a.stl"),
    "wall thick": ("--print-scale 1 --min-thickness 20", "a.stl"),
    "fill": ("--fill-cavities", "a.ply"),
    "fields": ("--fields all", "a.vdb"),
    "curvature": ("--curvature-totals", "a.json"),
    "measures": ("--measures sphericity,gyration_radius", "a.json"),
    "split": ("--split group --group-by chain", "a.ply"),
    "paper": ("--flow paper", "a.ply"),
    "picture": ("--opacity 0.4 --show-behind", "a.png"),
}
# Molecules that have what a product needs, where not all do: several chains, a residue.
ONLY = {"interfaces": (LARGE, LARGER), "tunnels": (SMALL, LARGE)}
KINDS = ("variational", "smooth-sas", "gaussian", "ses", "sas", "vdw")
VOXELS = (0.5, 1, 2, 3)
CAPSIDS = ("2buk.pdb.gz", "1f2n.cif.gz", "1k4r.pdb.gz")


def said(run):
    """Seconds and bytes of a line of --dry-run."""
    result = subprocess.run([*run, "--dry-run", "--force"], capture_output=True, text=True)
    found = re.search(r"voxels, ([0-9.e+]+) (\w+) of memory at most, ([0-9.e+-]+) s on one core", result.stderr)
    if not found:
        raise SystemExit(f"{' '.join(run)}: {result.stderr}")
    return float(found[3]), float(found[1]) * SCALE[found[2]]


def taken(run, repeats):
    """CPU seconds, the median, and the largest peak [byte]."""
    seconds, peak = [], 0
    for _ in range(repeats):
        child = subprocess.Popen([*run, "-q", "--force", "-j", "1"], stderr=subprocess.DEVNULL)
        _, status, usage = os.wait4(child.pid, 0)
        if os.waitstatus_to_exitcode(status) not in (0, 3):
            return None
        seconds.append(usage.ru_utime + usage.ru_stime)
        peak = max(peak, usage.ru_maxrss * 1024)
    return statistics.median(seconds), peak


def cases(structures):
    files = [ROOT / "tests/data" / SMALL, ROOT / "tests/data" / LARGE] + ([structures / LARGER] if structures else [])
    for name, (options, output) in PRODUCTS.items():
        for file in files:
            if file.name in ONLY.get(name.split()[0], (file.name,)):
                yield f"{name}, {file.name.split('.')[0]}", file, options, output
    for kind in KINDS if structures else ():
        for voxel in VOXELS:
            for file in CAPSIDS:
                yield (f"{kind} {voxel}, {file.split('.')[0]}", structures / file,
                       f"--surface {kind} --voxel {voxel} --assembly 1", "a.ply")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("names", nargs="*")
    parser.add_argument("--structures", type=pathlib.Path)
    parser.add_argument("--repeats", type=int, default=1)
    parser.add_argument("--longest", type=float, default=LIMIT, help="seconds said of the longest row that is run")
    args = parser.parse_intermixed_args()
    program, wrong, rows = os.path.abspath(args.program), 0, 0
    with tempfile.TemporaryDirectory() as folder:
        for name, file, options, output in cases(args.structures):
            if args.names and not any(part in name for part in args.names):
                continue
            words = [word.replace("_", " ") if "chain_" in word else word for word in options.split()]
            run = [program, str(file), *words, "-o", f"{folder}/{output}"]
            said_s, said_b = said(run)
            if said_s > args.longest:
                print(f"{name:32s} {said_s:9.3g} s said: too long", flush=True)
                continue
            found = taken(run, args.repeats)
            rows += 1
            if not found:
                print(f"{name:32s} fails", flush=True)
                wrong += 1
                continue
            s, b = found
            bad = []
            if s > LEAST_SECONDS and not SECONDS[0] <= s / said_s <= SECONDS[1]:
                bad.append("seconds")
            if b > LEAST_MEMORY and not MEMORY[0] <= b / said_b <= MEMORY[1]:
                bad.append("memory")
            wrong += bool(bad)
            print(f"{name:32s} {s:9.3g} s of {said_s:9.3g} ({s / said_s:6.2f})  {b / 1e6:8.1f} MB of "
                  f"{said_b / 1e6:8.1f} ({b / said_b:5.2f})  {', '.join(bad)}", flush=True)
    print(f"{rows - wrong} of {rows} estimates passed in their bounds")
    return wrong > 0


if __name__ == "__main__":
    sys.exit(main())
