#!/usr/bin/python3
# SPDX-License-Identifier: MPL-2.0
"""Holds the functions of src and tools to 70 lines and 6 parameters, by Universal Ctags.

Those that were longer when the rule was made are listed below with their size. Prints one line for each function
that is above its bound, and for each bound that has become too high, so that the list only shrinks; exits with 1 if
there is one.
"""

import json
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
LINES, PARAMETERS = 70, 6

LONGER = {}
WIDER = {"candidates": 10, "computeBrick": 9, "mergeBricks": 8, "surfaceOf": 7,
         "ballValues": 7, "writeOutput": 7, "writeAll": 7, "evolve": 7,
         "addArc": 7,
         # kernels: rows of fields, and what a loop carries along
         "nearestInCube": 9, "nearestOf": 8, "curvatureRows": 9, "carry": 8, "coefficientRows": 9,
         "addVoxel": 9, "speedRows": 8, "metricAtFoot": 7, "intersectCircle": 7, "relateAll": 8,
         "findGaps": 7, "findCovers": 7}


def functions():
    """(name, place, lines, parameters) of each function with a body."""
    files = sorted(str(file.relative_to(ROOT)) for folder in ("src", "tools")
                   for file in (ROOT / folder).rglob("*") if file.suffix in (".cpp", ".h"))
    tags = subprocess.run(["ctags", "--output-format=json", "--fields=+neS", "--kinds-C++=f", "-f", "-", *files],
                          cwd=ROOT, check=True, capture_output=True, text=True).stdout
    for line in tags.splitlines():
        tag = json.loads(line)
        if "end" not in tag:
            continue
        inside, depth, commas = tag.get("signature", "()")[1:-1], 0, 0
        for letter in inside:
            depth += (letter in "(<[{") - (letter in ")>]}")
            commas += letter == "," and depth == 0
        yield (tag["name"], f"{tag['path']}:{tag['line']}", tag["end"] - tag["line"] + 1,
               commas + bool(inside.strip()))


def main():
    faults, longest, widest, count = [], {}, {}, 0
    for name, place, lines, parameters in functions():
        count += 1
        longest[name] = max(longest.get(name, 0), lines)
        widest[name] = max(widest.get(name, 0), parameters)
        for size, bounds, bound, what in ((lines, LONGER, LINES, "lines"), (parameters, WIDER, PARAMETERS, "parameters")):
            if size > bounds.get(name, bound):
                faults.append(f"{place}: {name}() has {size} {what}, expected at most {bounds.get(name, bound)}")
    for bounds, sizes, bound in ((LONGER, longest, LINES), (WIDER, widest, PARAMETERS)):
        for name, size in bounds.items():
            if sizes.get(name, 0) < size:
                faults.append(f"scripts/check_functions.py: {name} may be {size}, and is {sizes.get(name, 0)}: " +
                              ("lower it" if sizes.get(name, 0) > bound else "take it off the list"))
    print(*faults, f"functions: {count}, {len(faults)} faults", sep="\n")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
