#!/usr/bin/python3
# SPDX-License-Identifier: MPL-2.0
"""Measures what each constant of the level set and of the flow does to the surface.

    bench/constants.py [NAME ...]           measures, and writes bench/constants.md
    bench/constants.py --check              whether the table has all of them, with the values of the code

A copy of the tree in --folder gets each number behind a factor that the environment sets, and is built once. The
program then runs with each number 20 % smaller and larger (a count: at least one less and one more), for the cases
below. NAME is a part of the names of those to measure anew; the others keep their rows. A number that the compiler
has to know, of lanes or of a layout, is none of these: see STRUCTURE.
"""

import argparse
import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys

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

# Structures and options. Fronts and the flow of the paper have constants of their own.
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
}

STATEMENT = re.compile(r"(?P<static>static )?constexpr (?P<type>float|double|int|std::size_t) (?P<names>[^;{]*?);", re.S)
ONE = re.compile(r"\s*(\w+) = (.+?)\s*$", re.S)
NUMBER = re.compile(r"\d+(?:\.\d*)?(?:e[-+]?\d+)?f?|-\d+(?:\.\d*)?(?:e[-+]?\d+)?f?")


class Constant:
    def __init__(self, file, name, text, kind):
        self.file, self.name, self.text, self.kind = file, name, text, kind
        self.value = text.rstrip("f")

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
    header = folder / "src" / "molsurf" / "core" / "tuned.h"
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


def run(folder, case, change=None):
    """What a case gives: area, volume, energy, Euler number and status."""
    file, options = case
    out = folder / "constants.json"
    environment = dict(os.environ, **({"MOLSURF_CONSTANT": "%d:%g" % change} if change else {}))
    out.unlink(missing_ok=True)
    done = subprocess.run([folder / "build-release/tools/vdb_molsurf", ROOT / "tests/data" / file, "-q", *options.split(),
                           "-o", out, "-o", folder / "constants.ply", "--force"], env=environment, text=True,
                          capture_output=True, timeout=SECONDS, check=False)
    if not out.exists():
        return {"status": done.returncode}
    report = json.loads(out.read_text())
    surface, evolution = report["surface"], report.get("evolution") or {}
    gaps = evolution.get("gaps") or {}
    return {"area": surface.get("mesh_area") or surface["area"], "volume": surface.get("mesh_volume") or surface["volume"],
            "energy": evolution.get("final_energy"),
            "Euler": surface.get("mesh_euler_characteristic", surface["euler_characteristic"]),
            "gaps": gaps.get("closed"), "passages": gaps.get("closed_by_field"),
            "walls": (evolution.get("walls") or {}).get("closed"), "status": done.returncode}


def difference(base, changed):
    """The largest relative change of area, volume and energy, in %, and what is counted otherwise."""
    if "area" not in changed:
        return 100.0, [f"status {changed['status']}"]
    ways = [abs(changed[k] / base[k] - 1.0) for k in ("area", "volume", "energy") if base[k] and changed[k]]
    return 100.0 * max(ways), [f"{k} {base[k]} to {changed[k]}" for k in ("Euler", "gaps", "passages", "walls", "status")
                               if base[k] != changed[k]]


def cell(changes):
    """The largest change with its case, then what each case counts otherwise."""
    case = max(changes, key=lambda name: changes[name][0])
    worst = changes[case][0]
    number = "-" if worst < 1e-4 else "%.2g %s" % (worst, case)
    notes = [f"{name}: {', '.join(changes[name][1])}" for name in changes if changes[name][1]]
    return "; ".join([number] + notes)


def measured(folder, constants, names):
    """Each constant that is measured, with the cells of minus and plus 20 %."""
    bases = {name: run(folder, case) for name, case in CASES.items()}
    for number, constant in enumerate(constants):
        if names and not any(name in constant.key for name in names):
            continue
        cells = []
        for factor in (0.8, 1.2):
            changes = {}
            for name, case in CASES.items():
                try:
                    changes[name] = difference(bases[name], run(folder, case, (number, factor)))
                except subprocess.TimeoutExpired:
                    changes[name] = 100.0, ["no end in time"]
            cells.append(cell(changes))
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
    cases = ", ".join(f"{name}: `{file}{' ' + options if options else ''}`" for name, (file, options) in CASES.items())
    head = ["# Constants of the level set and of the flow", "",
            "Made by `bench/constants.py`: each number is made 20 % smaller and larger, a count by one at least. A cell has",
            "the largest change of an area, a volume or an energy in %, with its case, or - below 0.0001 %; then the cases",
            "whose Euler number, closed gaps, passages or walls, or exit status differ. `bench/constants.py --check` holds",
            "the values against the code.", "",
            f"Cases, of `tests/data`: {cases}.", "",
            "| file | constant | value | 20 % less | 20 % more |", "|---|---|---|---|---|"]
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
    parser.add_argument("--check", action="store_true", help="hold the table against the code")
    parser.add_argument("--folder", type=pathlib.Path, default=ROOT / "build-constants", help="of the copy [build-constants]")
    args = parser.parse_args()
    if args.check:
        sys.exit(check(constants_of(ROOT)))
    constants = build(args.folder.resolve())
    rows = table_rows()
    for constant, cells in measured(args.folder.resolve(), constants, args.names):
        rows[constant.key] = (constant.value, cells)
        write_table(constants, rows)


if __name__ == "__main__":
    main()
