#!/usr/bin/python3
# SPDX-License-Identifier: MPL-2.0
"""Measures what each constant of the level set, of the topology and of the flow does to the surface.

    bench/constants.py [NAME ...]           measures, and writes bench/constants.md
    bench/constants.py [NAME ...] --case CASE   by these cases alone, and those that no other case moves
    bench/constants.py --check              whether the table has all of them, with the values of the code

A copy of the tree in --folder gets each number behind a factor that the environment sets, and is built once. The
program then runs with each number 20 % smaller and larger (a count: at least one less and one more; a power of ten:
ten times), for the cases below. A number that decides cost alone is measured by instructions, with valgrind: see
COST. NAME is a part of the names of those to measure anew; the others keep their rows. A number that the compiler
has to know, of lanes or of a layout, is none of these: see STRUCTURE.
"""

import argparse
import array
import concurrent.futures
import contextlib
import csv
import hashlib
import json
import math
import os
import pathlib
import random
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "scripts"))
import mutate  # noqa: E402  (its copy of the tree)

TABLE = ROOT / "bench" / "constants.md"
SECONDS = 30  # that a run may take
FOLDERS = ("src/molsurf/kernel/levelset", "src/molsurf/kernel/topology", "src/molsurf/kernel/flow")

# Sizes of blocks, of registers and of fields of bits, and values that mark what is not known.
STRUCTURE = set("""lanes dim size count strides edge plane cubeEdge octants width padding padded shift first last unit
    whole footReach bandWidthVox outside known any none noSeed noExponent nothing nowhere farAway unknown rim
    smallestSum tiny ahead X Y UX UY steps[] ends neighbours alongX alongY cubeHalf leafHalf leafRadius blockSize
    few every""".split())


def cloud(count, edge, smallest, largest, seed):
    """Balls at random in a cube: gaps, walls and necks of all kinds."""
    numbers = random.Random(seed)
    return [(*(numbers.uniform(0.0, edge) for _ in range(3)), numbers.uniform(smallest, largest)) for _ in range(count)]


def cage(count, radius):
    """Balls about a point, along a spiral on a sphere."""
    heights = [1.0 - 2.0 * (i + 0.5) / count for i in range(count)]
    rings = [(radius * math.sqrt(1.0 - z * z), 2.399963 * i, radius * z) for i, z in enumerate(heights)]
    return [(r * math.cos(turn), r * math.sin(turn), z, 1.7) for r, turn, z in rings]


# Inputs that are made: balls.
MADE = {
    "ball": [(0.1, 0.2, 0.3, 1.7)],
    "cloud40": cloud(40, 20.0, 1.4, 1.9, 4),
    "cloud60": cloud(60, 16.0, 1.0, 1.9, 1),
    "cloud120": cloud(120, 16.0, 1.2, 1.9, 3),
    "cloud200": cloud(200, 24.0, 1.0, 1.9, 2),
    "cloud500": cloud(500, 36.0, 1.2, 1.9, 5),
    "cloud700": cloud(700, 36.0, 1.0, 2.4, 7),
    "cage90": cage(90, 3.2),
    "cage160": cage(160, 3.25),
}

# Inputs and options. Fronts and the flow of the paper have constants of their own.
CASES = {
    "default": ("4at1.ent.gz", ""),
    "fine": ("1a8o.cif.gz", "--voxel 0.25"),
    "coarse": ("1d3z.pdb.gz", "--voxel 0.7"),
    "fronts": ("1a8o.cif.gz", "--lambda 0.1"),
    "newton": ("1a8o.cif.gz", "--flow newton --voxel 0.7"),
    "paper": ("1crn.pdb", "--flow paper"),
    "ses": ("1a8o.cif.gz", "--surface ses"),
    "gaussian": ("1crn.pdb", "--surface gaussian"),
    "min-thickness": ("1crn.pdb", "--print-scale 1 --min-thickness 3"),
    "cloud": ("cloud60", ""),
    "crowd": ("cloud500", ""),
    "large-balls": ("cloud700", ""),
    "cage90": ("cage90", ""),
    "cage160": ("cage160", ""),
    "small-probe": ("1crn.pdb", "--probe 0.4"),
    "voxel-0.1": ("ball", "--voxel 0.1"),
    "creases": ("crease49.xyzr", "--voxel 0.2"),
    "voxel-1": ("cloud60", "--voxel 1"),
    "voxel-2": ("cloud200", "--voxel 2"),
    "voxel-3": ("cloud60", "--voxel 3"),
    "sharp": ("cloud60", "--epsilon 0.1 --voxel 0.2 --lambda 0.024"),
    "rest-tail": ("cloud700", "--lambda 0.02 --tolerance 0.0042"),
    "rest-coarse": ("cloud700", "--voxel 1.05 --lambda 0.02 --tolerance 0.0099"),
    "rest-cells": ("cloud700", "--voxel 0.88 --lambda 0.024"),
    "some-tension": ("cloud40", "--lambda 0.03"),
    "tension": ("cloud200", "--lambda 0.04"),
    "passages": ("cloud700", "--lambda 0.04 --steps 1"),
    "slow-fronts": ("cloud60", "--lambda 0.06 --tolerance 0.001"),
    "far-fronts": ("cloud60", "--lambda 0.1 --tolerance 1e-4"),
    "fine-fronts": ("cloud120", "--lambda 0.1 --voxel 0.25"),
    "paper-cloud": ("cloud60", "--flow paper"),
    "gaussian-cloud": ("cloud200", "--surface gaussian"),
    "forces": ("cloud60", "--surface smooth-sas -o f.forces.csv"),
}

# Numbers that decide cost alone, with the case whose instructions are counted.
COST = {"kernel/topology/closed_passages.cpp step": "small-probe"}

# What is measured: sizes, counts and what else a report has. Less than this share, or this way of a vertex, is
# nothing: the rounding of floats.
SIZES = {"area", "volume", "mesh_area", "mesh_volume", "final_energy"}
COUNTS = {"status": "status", "mesh_euler_characteristic": "Euler", "gaps.found": "gaps", "gaps.closed": "closed",
          "gaps.closed_by_field": "passages", "walls.found": "walls", "walls.closed": "closed walls", "steps": "steps"}
NOISE = {"max_residual", "gradient_share", "kink_share", "degenerate_triangles", "mean_curvature", "gaussian_curvature"}
LEAST, LEAST_OTHER, LEAST_WAY = 1e-6, 1e-4, 1e-6  # shares; [Å]

STATEMENT = re.compile(r"(?P<static>static )?constexpr (?P<type>float|double|int|std::size_t) (?P<names>[^;{]*?);", re.S)
ONE = re.compile(r"\s*(\w+) = (.+?)\s*$", re.S)
NUMBER = re.compile(r"\d+(?:\.\d*)?(?:e[-+]?\d+)?f?|-\d+(?:\.\d*)?(?:e[-+]?\d+)?f?")


class Constant:
    def __init__(self, file, name, text, kind):
        self.file, self.name, self.text, self.kind = file, name, text, kind
        self.value = text.rstrip("f")
        self.factors = (0.1, 10.0) if re.fullmatch(r"1e-\d+", self.value) else (0.8, 1.2)

    @property
    def key(self):
        return f"{self.file} {self.name}"


def constants_in(text, file, start):
    """The constants of a file, and its text with each behind its factor; they are numbered from `start`."""
    found, names, times = [], set(), {}

    def rewritten(match):
        parts = [ONE.match(part) for part in match["names"].split(",")]
        if not all(parts) or any(part[1] in STRUCTURE for part in parts):
            return match[0]
        values = []
        for part in parts:
            name, value = part[1], part[2]
            if NUMBER.fullmatch(value):
                times[name] = times.get(name, 0) + 1
                label = name + (f" ({times[name]})" if times[name] > 1 else "")
                found.append(Constant(file, label, value, match["type"]))
                number = start + len(found) - 1
                values.append(f"{name} = molsurf::tuned<{match['type']}>({value}, {number})")
            else:  # of others
                values.append(f"{name} = {value}")
            names.add(name)
        return ("static inline const " if match["static"] else "static const ") + match["type"] + " " + ", ".join(values) + ";"

    return found, STATEMENT.sub(rewritten, text)


def constants_of(tree, write=False):
    """All constants; with `write` the files of the tree get their factors."""
    out = []
    for folder in FOLDERS:
        for path in sorted((tree / folder).iterdir()):
            if path.suffix not in (".h", ".cpp"):
                continue
            text = path.read_text()
            file = "/".join(path.relative_to(tree / "src" / "molsurf").parts)
            found, changed = constants_in(text, file, len(out))
            if write and changed != text:
                first = "#pragma once\n" if path.suffix == ".h" else "\n"
                path.write_text(changed.replace(first, first + '#include "molsurf/kernel/core/tuned.h"\n', 1))
            out += found
    return out


TUNED = """// A factor for each constant of bench/constants.py.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
namespace molsurf
{
struct Factor {
    int number = -1;
    double factor = 1.0;
    Factor()
    {
        const char* text = std::getenv("MOLSURF_CONSTANT");
        if (text) std::sscanf(text, "%d:%lf", &number, &factor);
    }
};
inline const Factor changedConstant;
template <class T> T tuned(T value, int number)
{
    if (number != changedConstant.number) return value;
    if (T(0.5) == T(0)) { // a count
        const double way = std::max(1.0, std::round(std::abs(changedConstant.factor - 1.0) * double(value)));
        return T(double(value) + (changedConstant.factor < 1.0 ? -way : way));
    }
    return T(double(value) * changedConstant.factor);
}
} // namespace molsurf
"""


def build(folder):
    """Makes the copy and builds it, unless it is that of this tree already."""
    digest = hashlib.sha256(b"".join(path.read_bytes() for part in ("src", "tools")
                                     for path in sorted((ROOT / part).rglob("*")) if path.is_file())).hexdigest()
    stamp = folder / "build-constants.sha256"
    if stamp.exists() and stamp.read_text() == digest:
        return constants_of(ROOT)
    mutate.copy_tree(folder)
    header = folder / "src" / "molsurf" / "kernel" / "core" / "tuned.h"
    header.write_text(TUNED)
    constants = constants_of(folder, write=True)
    for command in (["cmake", "--preset", "release", "-DMOLSURF_BUILD_TESTS=OFF"],
                    ["cmake", "--build", "--preset", "release", "--target", "vdb_molsurf", "--", "-k", "0"]):
        done = subprocess.run(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              check=False)
        if done.returncode:
            sys.exit("\n".join(line for line in done.stdout.splitlines() if "error" in line) or done.stdout)
    stamp.write_text(digest)
    return constants


def path_of(folder, file):
    """The file of an input: that of tests/data, or one that is made."""
    if file not in MADE:
        return ROOT / "tests" / "data" / file
    path = folder / f"{file}.xyzr"
    if not path.exists():
        path.write_text("".join("%.6f %.6f %.6f %.6f\n" % ball for ball in MADE[file]))
    return path


def numbers_in(value, name=""):
    """The numbers of a report by their names, those of lists and of the mesh's own noise left out."""
    if isinstance(value, dict):
        return {k: v for key, inner in value.items() if key not in NOISE
                for k, v in numbers_in(inner, f"{name}.{key}" if name else key).items()}
    return {name: value} if isinstance(value, (int, float)) else {}


def mesh_in(path):
    """Of a binary .ply, the coordinates of its vertices and a digest of its triangles."""
    head, data = path.read_bytes().split(b"end_header\n", 1)
    vertices = int(re.search(rb"element vertex (\d+)", head)[1])
    floats = head.count(b"property float") + head.count(b"property int")
    split = 4 * floats * vertices
    values = array.array("f", data[:split])
    return [values[a::floats] for a in range(3)], hashlib.sha256(data[split:]).hexdigest()


def run(folder, case, change=None):
    """What a case gives: its status, the numbers of the report and the mesh."""
    file, options = CASES[case]
    path = path_of(folder, file)
    environment = dict(os.environ, **({"MOLSURF_CONSTANT": "%d:%g" % change} if change else {}))
    with tempfile.TemporaryDirectory(dir=folder) as place:
        out = pathlib.Path(place)
        command = [folder / "build-release/tools/vdb_molsurf", path, "-q", "-j", "1", *options.split(), "-o", "o.json",
                   "-o", "o.ply"]
        try:
            done = subprocess.run(command, cwd=out, env=environment, capture_output=True, timeout=SECONDS, check=False)
        except subprocess.TimeoutExpired:
            return {"status": "no end in time"}, None
        found = {"status": done.returncode}
        if (out / "o.json").exists():
            report = json.loads((out / "o.json").read_text())
            found |= numbers_in(report["surface"]) | numbers_in(report["evolution"] or {})
        for table in out.glob("*.csv"):
            found |= columns_of(table)
        return found, mesh_in(out / "o.ply") if (out / "o.ply").exists() else None


def columns_of(table):
    """The columns of numbers of a table."""
    with open(table) as lines:
        rows = list(csv.DictReader(lines))
    out = {}
    for key in rows[0] if rows else ():
        with contextlib.suppress(ValueError):
            out[key] = [float(row[key]) for row in rows]
    return out


def instructions(folder, case, change=None):
    """The instructions of a case, in thousands of millions, by valgrind."""
    file, options = CASES[case]
    environment = dict(os.environ, **({"MOLSURF_CONSTANT": "%d:%g" % change} if change else {}))
    done = subprocess.run(["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null",
                           folder / "build-release/tools/vdb_molsurf", path_of(folder, file), "-q", "-j", "1",
                           *options.split(), "-o", folder / "counted.json", "--force"], env=environment,
                          capture_output=True, text=True, check=True)
    return int(re.search(r"Collected : (\d+)", done.stderr)[1]) * 1e-9


def largest_share(column, changed):
    """The largest change in a column of a table, as a share of its root mean square."""
    if len(column) != len(changed):
        return 1.0
    size = math.sqrt(sum(x * x for x in column) / len(column))
    return max(abs(a - b) for a, b in zip(column, changed)) / size


def differences(base, changed):
    """What differs between two runs: how much with its unit and the name of the measure; sizes first."""
    (old, mesh), (new, moved) = base, changed
    out = []
    for key in sorted(set(old) | set(new)):
        a, b = old.get(key), new.get(key)
        if a == b:
            continue
        if key in COUNTS or a is None or b is None:
            out.append((0.0, f"{a} to {b}", key))
            continue
        change = largest_share(a, b) if isinstance(a, list) else abs(a - b) / max(abs(a), abs(b))
        if change > (LEAST if key in SIZES else LEAST_OTHER):
            out.append((100.0 * change, "%", key))
    if mesh and moved and mesh[1] == moved[1]:
        way = max(abs(a - b) for before, after in zip(mesh[0], moved[0]) for a, b in zip(before, after))
        if way > max(LEAST_WAY, max(max(map(abs, axis)) for axis in mesh[0]) * 2.0 ** -22):
            out.append((way, "Å", "vertices"))
    return out


def cell(changes):
    """The largest change of a size with its case, else of vertices, else of another number; then what is counted
    otherwise in two cases."""
    found = [(*change, case) for case, some in changes.items() for change in some]
    counts = [f for f in found if f[2] in COUNTS]
    other = [f for f in found if f[2] not in COUNTS and f[0] > 0.0]
    best = ([f for f in other if f[2] in SIZES] or [f for f in other if f[2] == "vertices"] or
            [f for f in other if not counts])
    cells = []
    if best:
        amount, unit, key, case = max(best)
        cells.append({"%": "%.2g %s", "Å": "%.2g Å %s"}[unit] % (amount, case) if key in SIZES or unit == "Å" else
                     "%s %.2g %s" % (key.split(".")[-1], amount, case))
    cells += [f"{case}: {COUNTS[key]} {change}" for _, change, key, case in counts[:2]]
    return "; ".join(cells) + ("; ..." if len(counts) > 2 else "") or "-"


def cost_of(folder, case, number):
    """The cells of a constant that decides cost alone."""
    base = instructions(folder, case)
    changes = [100.0 * (instructions(folder, case, (number, factor)) / base - 1.0) for factor in (0.8, 1.2)]
    return ["instructions %+.1f %% %s" % (change, case) if abs(change) >= 1.0 else "-" for change in changes]


def measured(folder, constants, isWanted, cases):
    """Each constant that is wanted, with the cells of less and more."""
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        bases = dict(zip(cases, pool.map(lambda case: run(folder, case), cases)))
        for number, constant in enumerate(constants):
            if not isWanted(constant):
                continue
            cells = cost_of(folder, COST[constant.key], number) if constant.key in COST else []
            for factor in () if cells else constant.factors:
                found = list(pool.map(lambda case, change=(number, factor): run(folder, case, change), cases))
                cells.append(cell({case: differences(bases[case], one) for case, one in zip(cases, found)}))
            yield constant, cells
            print(constant.key, constant.value, *cells, sep=" | ", flush=True)


def table_rows():
    """The rows of the page: by key, the value and the cells."""
    rows = {}
    if TABLE.exists():
        for line in TABLE.read_text().splitlines():
            cells = [c.strip() for c in line.strip("|").split("|")]
            if len(cells) == 5 and cells[0].endswith((".h", ".cpp")):
                rows[f"{cells[0]} {cells[1].strip('`')}"] = (cells[2], cells[3:])
    return rows


def write_table(constants, rows):
    cases = [f"| {name} | {file} | {f'`{options}`' if options else ''} |" for name, (file, options) in CASES.items()]
    head = ["# Constants of the level set, of the topology and of the flow", "",
            "Made by `bench/constants.py`: each number is made 20 % smaller and larger, a count by one at least, and one",
            "that is written as a power of ten (1e-5) ten times smaller and larger. A cell has the largest change of an",
            "area, a volume or an energy in % with its case, above 0.0001 %; where there is none, the longest way of a vertex",
            "of the same triangles in Å, above 0.000001 Å and the rounding of its coordinates; else the largest change of",
            "another number of the report or of a table in %, above 0.01 %, with its name. Then it has the first two cases",
            "whose exit status, Euler number, gaps, passages, walls or steps differ. Numbers that decide cost alone have the",
            "change of instructions, above 1 %. `bench/constants.py --check` holds the values against the code.", "",
            "A number that the first nine cases move has not been measured by the others. One moves nothing: `paperSpeed` is",
            "the rule of the paper, which its flow never meets (`tests/unit/flow/paper_test.cpp`).", "",
            "Inputs are of `tests/data`, or made by the script: balls at random, and on spheres.", "",
            "| case | input | options |", "|---|---|---|", *cases, "",
            "| file | constant | value | less | more |", "|---|---|---|---|---|"]
    lines = [f"| {c.file} | `{c.name}` | {c.value} | {' | '.join(rows[c.key][1])} |" for c in constants if c.key in rows]
    TABLE.write_text("\n".join(head + lines) + "\n")


def check(constants):
    rows = table_rows()
    faults = [f"{c.key}: bench/constants.md has no row" for c in constants if c.key not in rows]
    faults += [f"{c.key}: expected {rows[c.key][0]} as in bench/constants.md, got {c.value}" for c in constants
               if c.key in rows and rows[c.key][0] != c.value]
    known = {c.key for c in constants}
    faults += [f"{key}: bench/constants.md has a row, the code no such constant" for key in rows if key not in known]
    for fault in faults:
        print(f"{fault} [hint: bench/constants.py {fault.split()[1].strip(':')}]", file=sys.stderr)
    print(f"constants: {len(constants)}, {len(faults)} faults")
    return 1 if faults else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("names", nargs="*", metavar="NAME", help="parts of the names of those to measure anew")
    parser.add_argument("--case", action="append", choices=list(CASES),
                        help="measure by these alone, and the numbers alone that no other case moves")
    parser.add_argument("--check", action="store_true", help="hold the table against the code")
    parser.add_argument("--folder", type=pathlib.Path, default=ROOT / "build-constants", help="of the copy [build-constants]")
    args = parser.parse_args()
    if args.check:
        sys.exit(check(constants_of(ROOT)))
    constants = build(args.folder.resolve())
    rows = table_rows()
    def isWanted(constant):
        moves = rows.get(constant.key, (None, ["-"]))[1] != ["-", "-"] and constant.key in rows
        return not (args.case and moves) and (not args.names or any(name in constant.key for name in args.names))

    for constant, cells in measured(args.folder.resolve(), constants, isWanted, args.case or list(CASES)):
        rows[constant.key] = (constant.value, cells)
        write_table(constants, rows)


if __name__ == "__main__":
    main()
