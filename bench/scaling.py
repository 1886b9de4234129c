#!/usr/bin/python3
# SPDX-License-Identifier: MPL-2.0
"""Time and memory against the number of atoms, from a few residues to the capsid of PBCV-1.

    bench/scaling.py --tool build-release/tools/vdb_molsurf --capsid 1m4x.cif.gz --voxel 1 \\
        --memory 6G -o docs/pictures/scaling.png --json scaling.json

The small molecules ship in tests/data; the large ones are the first copies of assembly 1 of PDB entry
1M4X, 9,693 atoms each (1,680 of them: 16 million). Whole processes that write a .vdb, 2 threads, medians
of --runs for what takes less than ten seconds. With --memory what does not fit is done in bricks. Needs
python3-matplotlib.
"""
import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile
import time

COPIES = [1, 3, 10, 30, 100, 300, 1680]


def cases(capsid):
    data = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "tests", "data")
    yield "12 residues of crambin", [os.path.join(data, "1crn.pdb"), "--select", "//A/1-12"]
    yield "crambin", [os.path.join(data, "1crn.pdb")]
    yield "ubiquitin", [os.path.join(data, "1ubq.pdb")]
    yield "ATCase", [os.path.join(data, "4at1.ent.gz")]
    for count in COPIES if capsid else ():
        yield f"{count} x 1M4X", [capsid, "--assembly", "1", *(["--copies", f"1-{count}"] if count < 1680 else [])]


def run(tool, words, folder):
    """Seconds, processor seconds, peak memory [MB] and report."""
    report = os.path.join(folder, "r.json")
    start = time.monotonic()
    process = subprocess.Popen([tool, *words, "-o", os.path.join(folder, "r.vdb"), "-o", report, "--force", "-q"],
                               stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    seconds = time.monotonic() - start
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode not in (0, 3):  # 3: the flow still creeps, the files are written
        raise RuntimeError(f"{' '.join(words)}: status {process.returncode}")
    return seconds, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024.0, json.load(open(report))


def plot(rows, voxel, path):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    atoms = [row["atoms"] for row in rows]
    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4), constrained_layout=True)
    large = [row for row in rows if row["atoms"] >= 1e5] or rows
    for axes, key, unit in ((left, "processor", "CPU s"), (right, "megabytes", "MB")):
        axes.loglog(atoms, [row[key] for row in rows], "o-", color="#1f6fb2")
        slope = statistics.median(row[key] / row["atoms"] for row in large)
        axes.loglog(atoms, [slope * n for n in atoms], "--", color="0.6", label=f"{slope * 1e6:,.4g} {unit} a million atoms")
        axes.set_xlabel("atoms")
        axes.set_ylabel(f"{key} ({unit})" if key == "megabytes" else "processor seconds")
        axes.set_ylim(min(row[key] for row in rows) / 2, max(row[key] for row in rows) * 2)
        axes.grid(True, which="major", alpha=0.3)
        axes.legend(loc="upper left", frameon=False)
    figure.suptitle(f"variational surface, {voxel:g} Å voxels, whole process, 2 threads")
    figure.savefig(path, dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tool", default="build-release/tools/vdb_molsurf")
    parser.add_argument("--capsid", help="1m4x.cif.gz")
    parser.add_argument("--voxel", type=float, default=1.0, help="Å (1)")
    parser.add_argument("--memory", help="as vdb_molsurf takes it")
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("-o", "--output", help="the plot, .png or .svg")
    parser.add_argument("--json", help="the figures")
    options = parser.parse_args()
    tool = os.path.abspath(options.tool)
    rows = []
    print("| molecule | atoms | s | CPU s | CPU s a million atoms | MB | bytes an active voxel | triangles |")
    print("|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for name, words in cases(options.capsid):
            words = [*words, "--voxel", str(options.voxel), "-j", "2"]
            if options.memory:
                words += ["--memory", options.memory]
            runs = [run(tool, words, folder)]
            while runs[0][0] < 10.0 and len(runs) < options.runs:
                runs.append(run(tool, words, folder))
            seconds, processor, megabytes = (statistics.median(r[k] for r in runs) for k in range(3))
            report = runs[0][3]
            row = {"name": name, "atoms": report["atoms"], "seconds": seconds, "processor": processor, "megabytes": megabytes,
                   "voxels": report["grid"]["active_voxels"], "steps": report["evolution"]["steps"],
                   "triangles": report["surface"]["triangles"], "all": [r[:3] for r in runs]}
            rows.append(row)
            print(f"| {name} | {row['atoms']:,} | {seconds:.2f} | {processor:.2f} | {processor / row['atoms'] * 1e6:.1f} | "
                  f"{megabytes:.0f} | {megabytes * 1024 * 1024 / row['voxels']:.0f} | {row['triangles']:,} |", flush=True)
            if options.json:
                json.dump(rows, open(options.json, "w"), indent=1)
    if options.output:
        plot(rows, options.voxel, options.output)


if __name__ == "__main__":
    sys.exit(main())
