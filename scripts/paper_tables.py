#!/usr/bin/python3
# SPDX-License-Identifier: MPL-2.0
"""Tables 3.1 and 3.2 of Bajaj, Xu and Zhang (2009) for structure files, as Markdown and JSON.

Areas A and volumes V of three surfaces: 1 Gaussian, 2 solvent-excluded, 3 variational; beside them
the paper's numbers and the ratios; what the tolerance epsilon does to the ratios; and the two
regularisers, |grad g|^2 and 1, side by side (the paper's section 3.4). scripts/paper_tables.sh runs
this. Python's standard library is enough.
"""

import argparse
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
BEGIN, END = "<!-- paper_tables: begin -->", "<!-- paper_tables: end -->"

# A1 A2 A3 [Å^2] and V1 V2 V3 [Å^3] as the paper prints them.
PAPER = {
    "1FSS": (25638.6, 20233.6, 20335.6, 94653.5, 78017.2, 84453.0),
    "1MAH": (16920.2, 17061.0, 17121.8, 116586.9, 113528.9, 119776.8),
    "2GLS": (262196.6, 172746.3, 158346.8, 48724.5, 46250.6, 42617.0),
    "4AT1": (45059.5, 32608.0, 32300.5, 96081.7, 90061.6, 97158.3),
    "1A8O": (11294.4, 7015.9, 6334.3, 22997.3, 21801.2, 24718.3),
    "1AON": (404391.4, 283704.5, 204322.9, 43316.1, 38817.6, 30928.9),
    "2BBK": (63868.9, 25349.6, 21396.8, 130205.1, 133399.8, 144046.2),
    "2Z8A": (22827.4, 11228.7, 9997.8, 44518.0, 45002.0, 50330.7),
}
KEYS = ("A1", "A2", "A3", "V1", "V2", "V3")
ASSEMBLIES = {"1A8O": "1"}  # the paper's areas are those of the dimer; the others as in the file
EPSILON = 0.5  # the tool's default [Å]
KINDS = ("gaussian", "ses", "variational")

# The regularisers are compared where the flow rests, since their difference is small.
REST = ("--max-steps", "100")
NOT_CONVERGED = 3  # exit status of the tool; the files are written


class Failure(Exception):
    """One line that says what is wrong."""


class Parser(argparse.ArgumentParser):
    def error(self, message):
        self.exit(2, f"paper_tables: error: {message}\n")


def parse(words):
    parser = Parser(prog="paper_tables.sh", description=__doc__.splitlines()[0],
                    epilog="A FILE without NAME is called after the four characters of its PDB "
                    "code, if its name has one. A NAME may go on after the code: "
                    "'1A8O with hydrogens=1a8o.pqr'.")
    add = parser.add_argument
    add("structures", nargs="+", metavar="[NAME=]FILE")
    add("-o", "--output", action="append", default=[], metavar="FILE",
        help=".md or .json; repeats. In a .md that has the lines of comment 'paper_tables: begin' "
        "and '... end' what stands between them is replaced [Markdown to standard output]")
    add("--force", action="store_true", help="replace existing files")
    add("--assembly", action="append", default=[], metavar="NAME=ID",
        help="assembly to build, or none; repeats [1A8O: 1, the others none]")
    add("--voxel", type=float, default=0.5, metavar="H", help="edge of a voxel [Å] [0.5]")
    add("--epsilon", default="0.3,0.4,0.5", metavar="LIST",
        help="tolerances [Å] of the second pair of tables [0.3,0.4,0.5]")
    add("--lambda", dest="weights", default="0.01,0.1", metavar="LIST",
        help="weights at which the regularisers are compared [0.01,0.1]; '' leaves that out")
    add("--compared", action="append", default=[], metavar="NAME",
        help="compare the regularisers for this structure; repeats [all]")
    add("-j", "--threads", type=int, metavar="N", help="threads of the tool [all]")
    add("--tool", default=os.environ.get("VDB_MOLSURF", ROOT / "build-release/tools/vdb_molsurf"),
        metavar="FILE", help="vdb_molsurf [$VDB_MOLSURF, else build-release/tools/vdb_molsurf]")
    args = parser.parse_args(words)
    for name in ("epsilon", "weights"):
        try:
            setattr(args, name, [float(word) for word in getattr(args, name).split(",") if word])
        except ValueError:
            parser.error(f"--{'lambda' if name == 'weights' else name}: "
                         f"expected numbers, got '{getattr(args, name)}'")
    for path in args.output:
        if not path.endswith((".md", ".json")):
            parser.error(f"{path}: expected .md or .json")
    try:
        args.assembly = dict(word.rsplit("=", 1) for word in args.assembly)
    except ValueError:
        parser.error("--assembly: expected NAME=ID")
    return args


class Tool:
    """Runs vdb_molsurf in a folder of its own."""

    def __init__(self, args, folder):
        self.path, self.folder = pathlib.Path(args.tool).resolve(), pathlib.Path(folder)
        self.threads = ["-j", str(args.threads)] if args.threads else []

    def run(self, *words):
        """The report of one run, with "converged" set."""
        target = self.folder / "report.json"
        call = [self.path, *words, *self.threads, "-q", "--force", "-o", target]
        try:
            done = subprocess.run([*map(str, call)], capture_output=True, text=True)
        except OSError as error:
            raise Failure(f"{self.path}: {error.strerror}") from error
        if done.returncode not in (0, NOT_CONVERGED):
            lines = done.stderr.strip().splitlines() or [f"status {done.returncode}"]
            raise Failure(lines[-1].replace("vdb_molsurf: error: ", ""))
        return json.loads(target.read_text()) | {"converged": done.returncode == 0}


def named(word):
    """(name, path) of a structure on the command line."""
    name, _, path = word.rpartition("=")
    if name:
        return name, path
    code = re.match(r"[1-9][A-Za-z0-9]{3}(?![A-Za-z0-9])", pathlib.Path(path).name)
    return (code.group().upper() if code else pathlib.Path(path).name.split(".")[0]), path


def size(report):
    surface = report["surface"]
    return {"area": surface["area"], "volume": surface["volume"],
            "euler_characteristic": surface["euler_characteristic"],
            "cavities": surface["cavities"], "converged": report["converged"]}


def ratios(sizes):
    second, third = sizes["ses"], sizes["variational"]
    return {"A3/A2": third["area"] / second["area"], "V3/V2": third["volume"] / second["volume"]}


def measure(tool, args, name, path):
    """Everything that is tabulated about one structure."""
    assembly = args.assembly.get(name, ASSEMBLIES.get(name))
    words = [path, "--voxel", args.voxel]
    if assembly and assembly != "none":
        words += ["--assembly", assembly]
    surfaces = {}
    for kind in KINDS:
        report = tool.run(*words, "--surface", kind)
        surfaces[kind] = size(report)
    result = {"name": name, "input": path, "assembly": assembly or "none",
              "atoms": report["atoms"], "surfaces": surfaces, "ratios": ratios(surfaces),
              "epsilon": []}
    code = name.split()[0]
    if code in PAPER:
        result["paper"] = dict(zip(KEYS, PAPER[code]))
    for epsilon in args.epsilon:
        third = size(tool.run(*words, "--epsilon", epsilon))
        result["epsilon"].append({"epsilon": epsilon, **third,
                                  "ratios": ratios(surfaces | {"variational": third})})
    weights = args.weights if not args.compared or name in args.compared else []
    result["regularizers"] = [regularizers(tool, words, weight) for weight in weights]
    return result


def regularizers(tool, words, weight):
    """Both at one lambda, and h = 1 at the tension that h = |grad g|^2 has on a flat surface.

    The solvent-excluded surface gives the scale of their distances.
    """
    slope = 2 * math.log(2) / EPSILON  # |grad psi| on a flat solvent-accessible surface [1/Å]
    q = weight * slope ** 2
    tension = q / (1 + q)
    first, other = tool.folder / "first.vdb", tool.folder / "other.vdb"
    rows = []
    for kind, value in (("gradient", weight), ("area", weight), ("area", tension), ("ses", None)):
        call = (("--surface", "ses") if kind == "ses" else
                ("--regularizer", kind, "--lambda", value, *REST))
        report = tool.run(*words, *call, "-o", other if rows else first,
                          "--fields", "surface,spline")
        row = {"regularizer": kind, "lambda": value,
               "tension": tension if kind == "gradient" else value, **size(report)}
        for field in ("mean_curvature", "gaussian_curvature"):
            row[field] = report["surface"][field]
        if rows:
            row["distance"] = distance(tool, other, first)
            row |= {f"{key}_change": row[key] / rows[0][key] - 1 for key in ("area", "volume")}
        rows.append(row)
    return {"lambda": weight, "rows": rows}


def distance(tool, a, b):
    """Of surface a from surface b [Å]."""
    way = tool.run("compare", a, b)["a_to_b"]
    return {key: way[key] for key in ("mean", "rms", "max")}


def table(head, rows):
    yield "| " + " | ".join(head) + " |"
    yield "|" + "---|" * len(head)
    for row in rows:
        yield "| " + " | ".join(row) + " |"
    yield ""


def unit(letter):
    return "Å²" if letter == "A" else "Å³"


def sizes_table(letter, title, structures):
    quantity = {"A": "area", "V": "volume"}[letter]
    yield f"**{title}** [{unit(letter)}], the paper's numbers in brackets\n"
    head = ["structure", "atoms", *(f"{letter}{i}" for i in (1, 2, 3)), f"{letter}3/{letter}2"]
    rows = []
    for one in structures:
        paper = one.get("paper")
        ours = [one["surfaces"][kind] for kind in KINDS]
        cells = [one["name"], str(one["atoms"])]
        for i, surface in enumerate(ours, 1):
            mark = "" if surface["converged"] else "*"
            cells.append(f"{surface[quantity]:.1f}{mark}" +
                         (f" ({paper[f'{letter}{i}']:.1f})" if paper else ""))
        ratio = f"{letter}3/{letter}2"
        cells.append(f"{one['ratios'][ratio]:.3f}" +
                     (f" ({paper[f'{letter}3'] / paper[f'{letter}2']:.3f})" if paper else ""))
        rows.append(cells)
    yield from table(head, rows)


def epsilon_table(structures, epsilons):
    yield "**Ratios against the tolerance** `--epsilon` [Å], each A3/A2, V3/V2\n"
    rows = []
    for one in structures:
        paper = one.get("paper")
        rows.append([one["name"],
                     *(f"{e['ratios']['A3/A2']:.3f}, {e['ratios']['V3/V2']:.3f}"
                       for e in one["epsilon"]),
                     f"{paper['A3'] / paper['A2']:.3f}, {paper['V3'] / paper['V2']:.3f}"
                     if paper else "-"])
    yield from table(["structure", *(f"{value:g}" for value in epsilons), "paper"], rows)


def regularizer_row(row):
    h, k, apart = row["mean_curvature"], row["gaussian_curvature"], row.get("distance")
    name = {"gradient": "\\|grad g\\|²", "area": "1", "ses": "(SES)"}[row["regularizer"]]
    weights = ("-" if row[key] is None else f"{row[key]:.3f}" for key in ("lambda", "tension"))
    return [name, *weights, f"{row['area']:.1f}" + ("" if row["converged"] else "*"),
            f"{row['volume']:.1f}", str(row["euler_characteristic"]), f"{h['mean']:.4f}",
            f"{h['percentiles']['5']:.2f}, {h['percentiles']['95']:.2f}",
            f"{k['percentiles']['5']:.3f}, {k['percentiles']['95']:.3f}",
            f"{apart['mean']:.3f}, {apart['max']:.2f}" if apart else "-"]


def regularizer_table(one):
    yield (f"**Regularisers, {one['name']}**: area [Å²], volume [Å³], Euler characteristic, mean "
           "curvature H [1/Å], Gaussian curvature K [1/Å²] (mean, percentiles), and the distance "
           "from the surface with h = |grad g|² above [Å]\n")
    rows = [regularizer_row(row) for block in one["regularizers"] for row in block["rows"]]
    yield from table(["h", "lambda", "tension", "area", "volume", "chi", "H mean", "H 5 %, 95 %",
                      "K 5 %, 95 %", "distance mean, max"], rows)


def paper_table():
    """Which of the printed rows can be volumes and areas of molecules."""
    yield "**The paper's rows by themselves**\n"
    rows = [[code, f"{a3 / a2:.3f}", f"{v3 / v2:.3f}", f"{3 * v2 / a2:.2f}"]
            for code, (_, a2, a3, _, v2, v3) in PAPER.items()]
    yield from table(["structure", "A3/A2", "V3/V2", "3 V2/A2 [Å]"], rows)


def markdown(result):
    structures = result["structures"]
    starred = any(not surface["converged"] for one in structures
                  for surface in [*one["surfaces"].values(), *one["epsilon"],
                                  *(row for block in one["regularizers"]
                                    for row in block["rows"])])
    yield f"    {result['command']}\n"
    inputs = ", ".join(f"{one['name']}: `{pathlib.Path(one['input']).name}`" +
                       (f", assembly {one['assembly']}" if one["assembly"] != "none" else "")
                       for one in structures)
    yield f"{inputs}. Voxel {result['voxel']:g} Å.\n"
    yield from sizes_table("A", "Table 3.1, areas", structures)
    yield from sizes_table("V", "Table 3.2, volumes", structures)
    if result["epsilons"]:
        yield from epsilon_table(structures, result["epsilons"])
    for one in structures:
        if one["regularizers"]:
            yield from regularizer_table(one)
    if starred:
        yield "\\* the flow had not converged at its last step.\n"
    yield from paper_table()


def content(path, result):
    """What is to be in an output file."""
    if path.suffix == ".json":
        return json.dumps(result, indent=2, ensure_ascii=False) + "\n"
    text = "\n".join(markdown(result)).rstrip() + "\n"
    if path.exists():
        old = path.read_text()
        if BEGIN in old and END in old:
            return old[:old.index(BEGIN) + len(BEGIN)] + "\n" + text + old[old.index(END):]
    return text


def check_outputs(args):
    for path in map(pathlib.Path, args.output):
        if not path.exists() or args.force:
            continue
        if path.suffix != ".md" or BEGIN not in path.read_text():
            raise Failure(f"{path}: exists [hint: --force]")


def shown(words):
    """The command as one would type it."""
    return "scripts/paper_tables.sh " + " ".join(
        f"'{word}'" if re.search(r"[^\w./=,:+@-]", word) or not word else word for word in words)


def main(words):
    args = parse(words)
    try:
        check_outputs(args)
        with tempfile.TemporaryDirectory() as folder:
            tool = Tool(args, folder)
            result = {"command": shown(words), "voxel": args.voxel, "epsilons": args.epsilon,
                      "structures": [measure(tool, args, *named(word))
                                     for word in args.structures],
                      "paper": {code: dict(zip(KEYS, row)) for code, row in PAPER.items()}}
        if not args.output:
            print("\n".join(markdown(result)).rstrip())
        for path in map(pathlib.Path, args.output):
            text = content(path, result)
            beside = path.with_name(path.name + ".part")
            beside.write_text(text)
            beside.replace(path)
    except Failure as failure:
        print(f"paper_tables: error: {failure}", file=sys.stderr)
        return 1
    except OSError as error:
        print(f"paper_tables: error: {error.filename}: {error.strerror}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
