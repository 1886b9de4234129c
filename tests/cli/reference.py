#!/usr/bin/python3
# SPDX-License-Identifier: MPL-2.0
"""Summaries of all kinds of files that runs on small molecules write, and those that they have to have.

    VDB_MOLSURF=build-release/tools/vdb_molsurf tests/cli/reference.py [--renew REASON] [WORD...]

Runs the cases with one of the words in their commands, or all, and compares what they write with tests/reference.json.
--renew takes what is written now, of the cases that differ: it prints the differences and a paragraph for the commit,
which says why they are right.
"""

import argparse
import concurrent.futures
import json
import math
import pathlib
import re
import struct
import subprocess
import sys
import tempfile
import zipfile
import zlib

from tool import ROOT, TOOL, read_png

VALUES = ROOT / "tests" / "reference.json"
# Sums may differ by these shares of the sum of absolute values, the first that fits the name: processors and compilers round in
# other places. Measured with qemu-x86_64 -cpu Nehalem, Haswell: 3e-3 of shares at kinks, 1.2e-3 of curvatures, 6e-4 of labels.
TOLERANCES = (("kink_share", 1e-2), ("curvature", 4e-3), ("label|accessor", 2e-3), ("", 2e-5))
# What no two runs share, and residuals of the size of rounding.
ASIDE = {"seconds", "peak_memory_bytes", "command", "commit", "input_sha256", "threads", "version", "total_seconds", "max_residual",
         "gradient_share", "max_speed", "unsettled_share", "displacement_rms", "displacement_tail", "mean_displacement"}


def atoms(*rows):
    """Lines x y z radius. Each atom is a little aside, since ties of symmetric places are decided by rounding."""
    aside = lambda n, a: 0.02 * math.sin(12.9898 * n + 78.233 * a)
    return "".join(" ".join(f"{value + (aside(n, a) if a < 3 else 0):.6g}" for a, value in enumerate(row)) + "\n"
                   for n, row in enumerate(rows, 1))


def ring(count, edge, radius=1.7):
    turn = 2 * math.pi / count
    across = edge / 2 / math.sin(turn / 2)
    return [(across * math.cos(turn * k), across * math.sin(turn * k), 0, radius) for k in range(count)]


def windows(count, edge):
    """A plane net of squares whose films a probe nearly passes."""
    return [(edge * i / 2, edge * j / 2, 0, 1.7) for i in range(2 * count + 1) for j in range(2 * count + 1) if i % 2 == 0 or j % 2 == 0]


def shell(count, radius):
    """Atoms spread over a sphere, which keep a void."""
    golden = math.pi * (3 - math.sqrt(5))
    heights = [1 - (2 * k + 1) / count for k in range(count)]
    return [(radius * math.sqrt(1 - z * z) * math.cos(golden * k), radius * math.sqrt(1 - z * z) * math.sin(golden * k), radius * z, 1.7)
            for k, z in enumerate(heights)]


def tube(rings, across):
    return [(across * math.cos(math.pi * (k + i % 2 / 2) / 4), across * math.sin(math.pi * (k + i % 2 / 2) / 4), 1.5 * i, 1.6)
            for i in range(rings) for k in range(8)]


# Molecules that the commands read.
FILES = {
    "two.xyzr": atoms((0, 0, 0, 1.7), (2.9, 0.4, 0.1, 1.5)),
    "apart.xyzr": atoms((0, 0, 0, 1.7), (4.1, 0.2, 0, 1.7), (9, 0, 0.5, 1.2)),
    "ring4.xyzr": atoms(*ring(4, 4.6), (14, 1, 2, 1.5)),
    "ring6.xyzr": atoms(*ring(6, 3.9)),
    "windows.xyzr": atoms(*windows(2, 5.9)),
    "shell.xyzr": atoms(*shell(60, 5.5)),
    "tube.xyzr": atoms(*tube(8, 3.6)),
    "ion.pqr": "ATOM 1 C ION 1 0.0 0.0 0.0 1.0 2.0\nATOM 2 C ION 2 3.0 0.5 0.0 -0.5 1.0\nATOM 3 N ION 2 3.9 0.5 0.7 -0.1 0.0\n",
    "held.xyzr": atoms(*ring(4, 5.12), (14, 1, 2, 1.5)),
    "list.txt": "two.xyzr\napart.xyzr\nring6.xyzr\n",
    "groups.txt": "front resid 1-20 #ff8800\nback resid 21-46 teal\n",
}

C, D, A, S = "@1crn.pdb --voxel 1", "@1a8o.cif.gz --assembly 1 --voxel 1", "@1ubq.pdb --voxel 1", "@selections.pdb --voxel 0.7"
PICTURE = f"{C} --surface ses --size 160 -o a.png"
EVERY = "-o a.vdb -o a.ply -o a.json"

# Commands that belong together, in a folder of their own; @ names a file of tests/data.
CASES = [[f"{name} {more} {EVERY}"] for name, more in [
    ("two.xyzr", "--voxel 0.3"), ("apart.xyzr", "--voxel 0.4"), ("ring4.xyzr", "--voxel 0.5"), ("ring6.xyzr", "--voxel 0.4"),
    ("windows.xyzr", "--voxel 0.5"), ("shell.xyzr", "--voxel 0.6"), ("tube.xyzr", "--voxel 0.6"), ("tube.xyzr", "--voxel 0.5 --epsilon 0.25"),
    ("shell.xyzr", "--voxel 0.7 --fill-cavities"), ("ring4.xyzr", "--surface smooth-sas --voxel 0.5"),
    ("two.xyzr", "--surface gaussian --blobbiness 1.8 --voxel 0.4"), ("ring6.xyzr", "--match ses --voxel 0.5"),
    ("ring4.xyzr", "--lambda 0.03 --voxel 0.5"), ("ring4.xyzr", "--lambda 0.08 --voxel 0.5"), ("two.xyzr", "--flow newton --voxel 0.4"),
    ("two.xyzr", "--flow paper --max-steps 30 --voxel 0.5"), ("two.xyzr", "--regularizer area --lambda 0.2 --voxel 0.5"),
    ("apart.xyzr", "--spline-level 1 --fields all --curvature-totals --voxel 0.5"), ("shell.xyzr", "--surface ses --voxel 0.7"),
    ("shell.xyzr", "--surface sas --fields sas,density --voxel 0.7"), ("ring4.xyzr", "--surface vdw --voxel 0.5 --vdb-half"),
    ("ring6.xyzr", "--resolution 5 --match-volume --voxel 1"), ("two.xyzr", "--remesh 0.6 --adapt 0.05 --voxel 0.4"),
    ("two.xyzr", "--density 4 --surface ses --voxel 0.4"), ("windows.xyzr", "--surface ses --voxel 0.6 --probe 1.2"),
]] + [
    [f"{C} --fields all --color chain --curvature-totals {EVERY} -o a.obj -o a.stl -o a.off -o a.wrl -o a.vtk -o a.dx -o a.mrc"],
    [f"{C} --surface ses --pixel-size 2.3 --mask-edge 2 --mask-extend 1 -o a.mask.mrc -o a.density.mrc",
     f"{C} --surface ses --pixel-size 3 --box-size 20 --resolution 12 --center --invert-density -o b.density.mrc"],
    [f"{C} --surface ses -o a.vert -o a.face -o a.poly -o a.msh -o a.msh2 -o a.3mf -o a.usda -o a.cxc -o a.glb"],
    [f"{C} --surface ses --color element --sharp-colors -o a.ply -o a.obj -o a.legend.svg -o a.pml"],
    [f"{C} --surface sas --fields depth --areas atoms,residues,contacts -o a.json -o a.atoms.csv -o a.residues.csv -o a.contacts.csv -o a.cif"],
    ["@1crn.pdb --surface ses --pieces cavities --voxel 0.7 -o a.ply -o a.msh", f"{C} --pieces outer --center --print-scale 0.5 --min-thickness 2 -o b.stl"],
    [f"{C} --color bfactor --palette cividis --flat-values -o a.ply -o a.legend.svg", "@selections.pqr --color charge --range -1,1 --potential-offset 2 -o b.ply"],
    [f"{C} --color {color} --surface vdw -o {color}.ply" for color in ("residue", "element", "radius", "depth", "mean-curvature", "hydrophobicity")],
    [f"{C} --surface {kind} -o {kind}.forces.csv" for kind in ("ses", "sas", "vdw", "variational", "smooth-sas")],
    ["held.xyzr --surface smooth-sas --voxel 0.4 -o a.forces.csv -o a.json", "held.xyzr --voxel 0.4 -o b.forces.csv -o b.json"],
    [f"{C} --groups groups.txt --color group --split group --fields group_id {EVERY}"],
    [f"{D} --group-by copy --interfaces --surface sas -o a.json -o a.interfaces.csv", f"{D} --group-by chain --surface-of A=ses -o b.json -o b.ply"],
    [f"{D} --by-symmetry --surface ses --color chain -o a.ply -o a.glb -o a.json", f"{D} --by-symmetry --weld -o b.stl -o b.json"],
    [f"{D} --instances --lod 1.5,3 --surface vdw --color copy -o a.glb -o a.usda -o a.view".replace(" --voxel 1", "")],
    [f"{D} --coarse residue --surface sas -o a.json -o a.stl", f"{D} --copies 2 --resolution 6 -o b.json -o b.ply"],
    [f"{A} --pockets -o a.json -o a.pockets.csv -o a.pockets.ply --fields pocket_id,pocket_depth -o a.vdb"],
    ["@1grm.pdb.gz --pore auto --voxel 1 -o a.pore.csv -o a.json -o a.pore.svg -o a.pore.ply"],
    ["@1d3z.pdb.gz --frames 1-2 --tunnels-from A/44 -o a.tunnel_frames.csv"],
    ["@1grm.pdb.gz --tunnels-from 0,-4,3 --voxel 1 -o a.tunnels.csv -o a.json -o a.tunnels.ply -o a.tunnels.pdb -o a.tunnels.cif"],
    [f"{S} --altloc all --hetero --waters {EVERY}", f"{S} --no-hydrogens --radii protor --surface ses -o b.json -o b.atoms.csv"],
    ["@1d3z.pdb.gz --voxel 1.5 --frames 1-3 --fields v --fps 10 -o f.vdb -o f.csv -o f.json"],
    ["@1d3z.pdb.gz --trajectory @1d3z.xtc --frames 2-3 --voxel 1.5 -o f.csv -o f.glb"],
    ["ion.pqr --for apbs --pdie 3 --sdie 70 --ion-conc 0.1 --voxel 0.6 -o run/"],
    [f"{C} --for blender=0.1 --fog-density 0.2 --color chain -o a.vdb", f"{C} --for usd --center -o b.vdb -o b.glb"],
    ["compare @1crn.pdb @1ubq.pdb --voxel 1 -o c.ply -o c.json", f"{C} --surface ses --fields spline -o a.vdb",
     "convert a.vdb --fields mean_curvature -o b.ply -o b.json", "convert a.vdb --remesh 1.2 -o d.obj"],
    [f"bricks plan {C} --surface ses --bricks 2 -o p.json", "bricks run p.json 1", "bricks run p.json 2", "bricks merge p.json -o m.ply -o m.json"],
    [f"bricks plan {C} --bricks 2 --steps 2 -o p.json", "bricks run p.json 1", "bricks run p.json 2", "bricks merge p.json -o m.ply -o m.json"],
    ["batch list.txt --voxel 1 -O out --formats ply,json"],
    [PICTURE, f"{C} --color chain --style outline --depth-cue --clip 2 --legend on --scale-bar --size 200 -o b.png"],
    [f"{C} --color element --size 300 --panel ses --panel 1,0,0 --label A/10=here --ruler A/1..A/40 --show A/5-9=sticks --opacity 0.4 -o a.png"],
    [f"{C} --color bfactor --view A/20 --up 0,1,1 --turn 20 --background black --show spheres --opacity 0.5 --show-behind --size 200 -o a.png -o a.view"],
    [f"{C} --surface ses --color element --panel vdw -o a.html"],
]


def sums(values):
    """Count, sum, sum of absolute values and a sum with weights by place, which changes when values change places."""
    weights = (1 + k * 0.618034 % 1 for k in range(len(values)))
    return [len(values), math.fsum(values), math.fsum(map(abs, values)), math.fsum(w * v for w, v in zip(weights, values))]


NUMBER = re.compile(r"(?<![\w#.])[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d{1,2})?(?!\w)")


def text(data):
    """Numbers of each column of a table or of all of another text, and a hash of what is none."""
    found, words, lines = {}, [], data.decode().splitlines()
    if lines and "seconds" in lines[0].split(","):
        at = lines[0].split(",").index("seconds")
        lines = [",".join(line.split(",")[:at]) for line in lines]
    for line in lines:
        parts = NUMBER.split(line)
        words.append("#".join(parts))
        for column, number in enumerate(NUMBER.findall(line)):
            found.setdefault(min(column, 24), []).append(float(number))
    return {"words": zlib.crc32("\n".join(words).encode()), **{str(column): sums(values) for column, values in found.items()}}


def numbers(data, form):
    size = struct.calcsize(form)
    rows = list(struct.iter_unpack(form, data[:len(data) // size * size]))
    names = [f"{k} label" if letter == "i" else str(k) for k, letter in enumerate(form[1:])]
    return {name: sums([row[k] for row in rows]) for k, name in enumerate(names) if rows}


def ply(data):
    head, body = data.split(b"end_header\n", 1)
    lines = [line for line in head.decode().splitlines() if not line.startswith("comment")]
    form = "<" + "".join({"float": "f", "int": "i", "uchar": "B"}[line.split()[1]] for line in lines
                         if line.startswith("property") and "list" not in line)
    count = int(next(line for line in lines if line.startswith("element vertex")).split()[2])
    end = count * struct.calcsize(form)
    triangles = [row[1:] for row in struct.iter_unpack("<Biii", body[end:])]
    places = [row[:3] for row in struct.iter_unpack(form, body[:end])]
    volume = [sum(a[i] * (b[(i + 1) % 3] * c[(i + 2) % 3] - b[(i + 2) % 3] * c[(i + 1) % 3]) for i in range(3)) / 6
              for a, b, c in ([places[v] for v in t] for t in triangles)]
    return {"header": [line for line in lines if not line.startswith("element")], "volumes": sums(volume), **numbers(body[:end], form)}


def glb(data):
    size = struct.unpack("<I", data[12:16])[0]
    scene, body, out = json.loads(data[20:20 + size]), data[28 + size:], {}
    for n, accessor in enumerate(scene["accessors"]):
        view = scene["bufferViews"][accessor["bufferView"]]
        parts = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}[accessor["type"]]
        letter = {5121: "B", 5123: "H", 5125: "I", 5126: "f"}[accessor["componentType"]]
        start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        if "byteStride" in view or letter == "I":
            continue  # of triangles the vertices are enough
        out[f"accessor {n}"] = numbers(body[start:start + accessor["count"] * parts * struct.calcsize(letter)], "<" + parts * letter)
    return {"scene": flat({key: value for key, value in scene.items() if key not in ("bufferViews", "buffers")}), **out}


def flat(value, name=""):
    """Numbers and texts of a JSON value by their keys; long lists of numbers by their sums."""
    if isinstance(value, dict):
        return {k: v for key, inner in value.items() if key not in ASIDE for k, v in flat(inner, f"{name}.{key}").items()}
    if isinstance(value, list) and len(value) > 8 and all(isinstance(v, (int, float)) for v in value):
        return {name: sums(value)}
    if isinstance(value, list) and len(value) > 12:
        return {name: text(json.dumps(value).encode())}
    if isinstance(value, list):
        return {k: v for n, inner in enumerate(value) for k, v in flat(inner, f"{name}[{n}]").items()}
    return {name: value}


def png(data):
    """Means of blocks, red, green and blue."""
    width, rows = read_png(data)
    across, high = 12, max(1, round(12 * len(rows) / width))
    out = []
    for j in range(high):
        some = rows[j * len(rows) // high:(j + 1) * len(rows) // high]
        for i in range(across):
            low, end = 3 * (i * width // across), 3 * ((i + 1) * width // across)
            out += [round(sum(sum(row[low + c:end:3]) for row in some) / (len(some) * (end - low) / 3), 1) for c in range(3)]
    return {"size": [width, len(rows)], "blocks": out}


def html(data):
    page = data.decode()
    header = json.loads(re.search(r'<script[^>]*id="header"[^>]*>(.*?)</script>', page, re.S).group(1))
    return flat(header)


def vdb(path):
    told = subprocess.run([TOOL, "info", path], capture_output=True, check=True).stdout.decode()
    aside = r"(?m)^ *(?:file_|creator|command|commit|input_sha256|version|option\.output|.*bytes|.*MB|.*KB|.*uuid|frames\.options).*\n"
    return text(re.sub(aside, "", told.replace(str(path), "")).encode())


def triangles_of_stl(data):
    return numbers(data[84:], "<ffffffffffffH")


def summary(path):
    data, end = path.read_bytes(), path.suffix
    if end == ".vdb":
        return vdb(path)
    if end == ".json":
        return flat(json.loads(data))
    if end == ".jsonl":
        return {str(n): flat(json.loads(line)) for n, line in enumerate(data.splitlines())}
    by_ending = {".ply": ply, ".glb": glb, ".png": png, ".html": html, ".stl": triangles_of_stl,
                 ".mrc": lambda all_: numbers(all_[1024:], "<f")}
    if end in by_ending:
        return by_ending[end](data)
    if end == ".3mf":
        with zipfile.ZipFile(path) as file:
            plain = lambda name: re.sub(rb"[0-9a-f]{8}-[0-9a-f-]{27}", b"", file.read(name))  # digests of the mesh
            return {name: text(plain(name)) for name in file.namelist()}
    return text(data)


def run(commands):
    """The summaries of all files that commands write."""
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        for name, content in FILES.items():
            (folder / name).write_text(content)
        said = []
        for command in commands:
            for name in re.findall(r"@(\S+)", command):
                if not (folder / name).exists():
                    (folder / name).symlink_to(ROOT / "tests" / "data" / name)
            done = subprocess.run([TOOL, *command.replace("@", "").split(), "-j", "2", "--no-progress"], cwd=folder, capture_output=True, text=True)
            said.append([done.returncode, re.sub(r"\d+\.\d\d s|[\d.]+ [MGk]i?B\b", "", done.stderr)])
        files = sorted(path for path in folder.rglob("*") if path.is_file() and not path.is_symlink() and path.name not in FILES and not path.name.startswith("p.")
                       and not path.name.startswith("."))
        return {"says": text(json.dumps(said).encode()), **{str(path.relative_to(folder)): summary(path) for path in files}}


def tolerance(name):
    return next(share for word, share in TOLERANCES if re.search(word, name))


def differ(expected, got, name=""):
    """Lines that name what differs."""
    if isinstance(expected, dict) and isinstance(got, dict):
        for key in sorted(set(expected) | set(got)):
            if key not in expected or key not in got:
                yield f"{name} {key}: {'new' if key in got else 'gone'}"
            else:
                yield from differ(expected[key], got[key], f"{name} {key}")
    elif isinstance(expected, list) and isinstance(got, list) and len(expected) == len(got):
        number = [isinstance(v, (int, float)) and not isinstance(v, bool) for v in expected]
        scale = abs(expected[2]) if all(number) and len(expected) == 4 else 0.0
        for n, (a, b) in enumerate(zip(expected, got)):
            if number[n]:
                within = 2.5 if name.endswith("blocks") else tolerance(name) * max(scale, abs(a)) + 1e-6
                if not abs(a - b) <= within:
                    yield f"{name}[{n}]: {a} -> {b}"
            else:
                yield from differ(a, b, f"{name}[{n}]")
    elif isinstance(expected, float) or (isinstance(expected, int) and not isinstance(expected, bool) and not name.endswith("words")):
        if not isinstance(got, (int, float)) or not abs(expected - got) <= tolerance(name) * abs(expected) + 1e-6:
            yield f"{name}: {expected} -> {got}"
    elif expected != got:
        yield f"{name}: {expected} -> {got}"


def rounded(value):
    if isinstance(value, float):
        return float(f"{value:.8g}")
    if isinstance(value, dict):
        return {key: rounded(inner) for key, inner in value.items()}
    return [rounded(inner) for inner in value] if isinstance(value, list) else value


def all_runs(cases):
    with concurrent.futures.ThreadPoolExecutor(max_workers=2) as pool:
        return dict(zip(("; ".join(case) for case in cases), pool.map(run, cases)))


def lines_of(value, indent=""):
    """JSON with a key a line, so that a change of one number is a change of one line."""
    if not isinstance(value, dict) or not value:
        return json.dumps(value, separators=(",", ":"))
    inner = ",\n".join(f"{indent} {json.dumps(key)}: {lines_of(value[key], indent + ' ')}" for key in value)
    return "{\n" + inner + "\n" + indent + "}"


def reason(text):
    if len(text.split()) < 4:
        raise argparse.ArgumentTypeError("expected the reason why the new values are right, of four words at least")
    return text


def renew(known, got, differing, why):
    """Takes the new values of the cases that differ, and forgets cases that are no more."""
    names = {"; ".join(case) for case in CASES}
    kept = {name: (got if name in differing else known)[name] for name in names if name in known or name in got}
    VALUES.write_text(lines_of({name: kept[name] for name in sorted(kept)}) + "\n")
    if not differing:
        return
    print(f"\nFor the commit:\n\nReference values of {len(differing)} groups of commands are new: {why}")
    for name in sorted(differing):
        print(f"- {name}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--renew", metavar="REASON", type=reason)
    parser.add_argument("words", metavar="WORD", nargs="*")
    args = parser.parse_args()
    cases = [case for case in CASES if not args.words or any(word in "; ".join(case) for word in args.words)]
    got = rounded(all_runs(cases))
    known = json.loads(VALUES.read_text()) if VALUES.exists() else {}
    found = {case: list(differ(known[case], got[case])) if case in known else [" new"] for case in got}
    lines = [f"{case}:{line}" for case in got for line in found[case]]
    print("\n".join(lines))
    if args.renew:
        renew(known, got, {case for case in got if found[case]}, args.renew)
        return 0
    return 1 if lines else 0


if __name__ == "__main__":
    sys.exit(main())
