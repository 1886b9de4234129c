#!/usr/bin/python3
# SPDX-License-Identifier: MPL-2.0
"""Lists what the program warns of on real structures.

    bench/list_warnings.py PROGRAM DIR [--largest MB] [options of the program ...]

Every structure in a folder and its subfolders (.pdb .ent .cif .mmcif .pqr .xyzr, each also .gz) is built at 1 and
0.5 Å. One line for a run tells the exit status and the seconds, and its warnings and errors follow. The last lines
count the runs by status and by message, with numbers left out.
"""

import argparse
import collections
import pathlib
import re
import subprocess
import tempfile
import time

SUFFIXES = {".pdb", ".ent", ".cif", ".mmcif", ".pqr", ".xyzr"}


def structures(folder):
    """The structures below a folder, the smallest first."""
    def suffix(path):
        return pathlib.Path(path.stem).suffix if path.suffix == ".gz" else path.suffix

    return sorted((p for p in folder.rglob("*") if p.is_file() and suffix(p) in SUFFIXES),
                  key=lambda p: (p.stat().st_size, p.name))


def kind_of(line):
    """A warning without its numbers, so that equal ones count together."""
    return re.sub(r"-?\d[\d.,e+-]*", "#", line)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--largest", type=float, default=2.0, help="size of a file that is still tried [MB, 2]")
    args, words = parser.parse_known_args()
    statuses, kinds = collections.Counter(), collections.Counter()
    for path in structures(args.folder):
        if path.stat().st_size > args.largest * 1e6:
            print(f"{path.relative_to(args.folder)}: left out, since it is large (--largest)")
            continue
        for voxel in ("1", "0.5"):
            with tempfile.TemporaryDirectory() as folder:
                start = time.monotonic()
                done = subprocess.run([args.program, path, "--voxel", voxel, "-o", f"{folder}/report.json",
                                       "--no-progress", *words], check=False, stdout=subprocess.DEVNULL,
                                      stderr=subprocess.PIPE, text=True)
                seconds = time.monotonic() - start
            lines = [line for line in done.stderr.splitlines() if re.search(r"warning:|error:|\[hint:", line)]
            print(f"{path.relative_to(args.folder)} --voxel {voxel}: status {done.returncode}, {seconds:.1f} s",
                  flush=True)
            for line in lines:
                print(f"    {line}")
            statuses[done.returncode] += 1
            kinds.update({kind_of(line) for line in lines})
    print()
    for status, count in sorted(statuses.items()):
        print(f"{count:4} with status {status}")
    for kind, count in kinds.most_common():
        print(f"{count:4} {kind}")


if __name__ == "__main__":
    main()
