#!/usr/bin/python3
# SPDX-License-Identifier: MPL-2.0
"""Compares what two builds of vdb_molsurf write, byte by byte.

    scripts/compare_builds.py OLD NEW

Both programs run the same commands on the six structures of tests/data: all kinds of surfaces, fields, groups,
colours, scenes, bricks, frames, comparisons and stored surfaces. Left aside are what no two runs share (times, memory,
the UUID of an OpenVDB file) and the command line, commit and digest of options that files hold. Prints one line for each file
that differs and exits with 1 if there is one.
"""

import concurrent.futures
import json
import pathlib
import struct
import subprocess
import sys
import tempfile

DATA = pathlib.Path(__file__).resolve().parents[1] / "tests" / "data"
STRUCTURES = ["1crn.pdb", "1ubq.pdb", "1a8o.cif.gz", "bpti.pdb.gz", "1d3z.pdb.gz", "4at1.ent.gz"]
KINDS = ["variational", "ses", "sas", "vdw", "gaussian"]
FILES = "-o {0}.vdb -o {0}.ply -o {0}.glb -o {0}.json"
ASIDE = {"seconds", "peak_memory_bytes", "command", "commit", "stages", "input_sha256"}


def cases():
    """Lists of commands that belong together, run in a folder of their own; `@` stands for the data."""
    for structure in STRUCTURES:
        voxel = 1 if structure.startswith("4at1") else 0.6
        for kind in KINDS:
            yield [f"@{structure} --surface {kind} --voxel {voxel} " + FILES.format(kind)]
    yield ["@1crn.pdb --fields all --color chain --curvature-totals " + FILES.format("a") +
           " -o a.obj -o a.stl -o a.off -o a.html -o a.png"]
    yield ["@1a8o.cif.gz --assembly 1 --group-by chain --color group --interfaces --fields all " + FILES.format("a")]
    yield ["@1a8o.cif.gz --assembly 1 --group-by chain --split group --fill-cavities " + FILES.format("a")]
    yield ["@4at1.ent.gz --voxel 1 --group-by chain --surface-of A=ses --color element " + FILES.format("a")]
    yield ["@4at1.ent.gz --voxel 1 --resolution 6 --match-volume --fill-cavities " + FILES.format("a")]
    yield ["@4at1.ent.gz --voxel 1 --coarse residue --surface sas --fields sas,density " + FILES.format("a")]
    yield ["@1ubq.pdb --for blender --center --color residue " + FILES.format("a")]
    yield ["@1ubq.pdb --print-scale 2 --min-thickness 3 --spline-level 1 -o a.stl -o a.obj " + FILES.format("a")]
    yield ["@1ubq.pdb --flow paper --max-steps 40 --regularizer area --lambda 0.2 " + FILES.format("a")]
    for kind in ["variational", "ses", "vdw"]:
        plan = f"@4at1.ent.gz --surface {kind} --voxel 1 --fields sas,chain_id,mean_curvature --bricks 3 -o p.json"
        yield ([("plan", plan)] + [("brick", f"p.json {k}") for k in (1, 2, 3)] +
               [("merge", "p.json -o m.vdb -o m.ply -o m.json")])
    yield ["@4at1.ent.gz --voxel 1 --memory 90M --color chain --fields Cd -o a.vdb -o a.ply -o a.json"]
    for more in ["", " --fields v"]:
        yield ["@1d3z.pdb.gz --voxel 1 --frames 1-3 -o f.vdb -o f.ply -o f.json -o f.csv" + more]
    yield ["@1d3z.pdb.gz --trajectory @1d3z.xtc --frames 1-3 --voxel 1 -o f.vdb -o f.glb"]
    dimer = "@1a8o.cif.gz --assembly 1 --voxel 1"
    for kind in KINDS:
        yield [f"{dimer} --by-symmetry --surface {kind} --color chain -o a.ply -o a.glb -o a.json -o a.obj"]
    yield [f"{dimer} --by-symmetry --weld --fields mean_curvature --color copy -o a.ply -o a.html -o a.stl"]
    yield [f"{dimer} --by-symmetry --surface sas -o a.json -o a.atoms.csv -o a.residues.pdb"]
    yield [f"{dimer} --instances --color element -o a.glb -o a.usda -o a.html -o a.png -o a.json"]
    for more in ["--surface vdw --group-by chain --interfaces -o a.json", "--color radius -o a.ply -o a.html -o a.json",
                 "--resolution 4 --color bfactor --group-by class -o a.ply -o a.obj -o a.json",
                 "--coarse residue --surface sas --color copy -o a.json -o a.stl -o a.png"]:
        yield [f"{dimer} --by-symmetry {more}", f"{dimer} {more}".replace("-o a.", "-o b.")]
    tables = "-o a.atoms.csv -o a.residues.csv -o a.contacts.csv -o a.interfaces.csv -o a.json"
    yield [f"{dimer} --surface ses --group-by copy --interfaces {tables}"]
    yield [f"{dimer} --copies 2 --group-by entity --color group --interfaces -o a.ply -o a.json"]
    yield ["@1a8o.cif.gz --assembly 1 --instances --lod 1.5,3 --surface vdw --color chain -o a.glb -o a.usda -o a.view"]
    for color, kind in (("chain", "ses"), ("residue", "vdw"), ("element", "sas"), ("element", "variational")):
        yield [f"@4at1.ent.gz --voxel 1 --surface {kind} --color {color} --sharp-colors -o a.ply -o a.obj -o a.3mf -o a.png"]
    for kind in KINDS:
        yield [f"@4at1.ent.gz --voxel 1 --surface {kind} -o a.atoms.csv -o a.contacts.csv -o a.interfaces.csv -o a.cif"]
    yield ["@1ubq.pdb --surface ses --color bfactor -o a.html -o a.wrl -o a.off --areas atoms,residues -o a.json"]
    yield ["compare @1crn.pdb @1ubq.pdb -o c.ply -o c.vdb -o c.json"]
    yield ["@1crn.pdb --fields spline,chain_id,Cd --color chain -o a.vdb",
           ("mesh", "a.vdb -o b.ply -o b.glb -o b.json -o b.obj"),
           ("color", "a.vdb --color mean-curvature -o c.vdb -o c.ply -o c.json")]


NEW_WORDS = {"plan": "bricks plan", "brick": "bricks run", "merge": "bricks merge", "mesh": "convert",
             "color": "convert"}


def run(program, commands, folder, new):
    for command in commands:
        verb, text = command if isinstance(command, tuple) else ("", command)
        words = (NEW_WORDS[verb] if verb and new else verb).split()
        # The command line is stored, and where grids begin depends on its length.
        words.insert(0, "vdb_molsurf" + "_" * (0 if new or not verb else len(NEW_WORDS[verb]) - len(verb)))
        words += [str(DATA / w[1:]) if w.startswith("@") else w for w in text.split()]
        done = subprocess.run(words, executable=program, cwd=folder, capture_output=True, text=True, check=False)
        if done.returncode not in (0, 3):
            return f"{' '.join(words)}: status {done.returncode}: {done.stderr.strip()}"
    return ""


def without(data, name):
    """An OpenVDB file without the value of one entry of its metadata, a string."""
    mark = struct.pack("<I", len(name)) + name + struct.pack("<I", 6) + b"string"
    at = data.find(mark)
    if at < 0:
        return data
    start = at + len(mark)
    return data[:start] + data[start + 4 + struct.unpack_from("<I", data, start)[0]:]


def plain(value):
    if isinstance(value, dict):
        return {k: plain(v) for k, v in value.items() if k not in ASIDE}
    return [plain(v) for v in value] if isinstance(value, list) else value


def content(path):
    data = path.read_bytes()
    if path.suffix == ".json":
        found = plain(json.loads(data))
        found.pop("options", None)  # of a plan: its form may change, its bricks may not
        found.pop("arguments", None)
        return found
    if path.suffix == ".vdb":
        data = data[:21] + data[57:]  # the UUID
        for name in (b"command", b"commit", b"frames.options"):
            data = without(data, name)
        return data
    if path.suffix == ".brick" or path.name == "f.csv":
        return None
    return data


def main():
    programs = [str(pathlib.Path(p).resolve()) for p in sys.argv[1:3]]
    if len(programs) != 2:
        sys.exit("expected two programs, OLD and NEW")
    new = [b"bricks plan" in subprocess.run([p, "--help"], capture_output=True, check=False).stdout for p in programs]
    faults = files = 0
    with tempfile.TemporaryDirectory() as top, concurrent.futures.ThreadPoolExecutor(2) as pool:
        def both(item):
            number, commands = item
            folders = [pathlib.Path(top) / str(number) / str(k) for k in (0, 1)]
            said = []
            for k in (0, 1):
                folders[k].mkdir(parents=True)
                said.append(run(programs[k], commands, folders[k], new[k]))
            names = sorted({p.name for f in folders for p in f.iterdir()})
            if any(said):
                return commands, 0, [f"{said}"]
            bad = []
            for name in names:
                a, b = folders[0] / name, folders[1] / name
                if not (a.exists() and b.exists()):
                    bad.append(f"{name} is written by one only")
                elif content(a) != content(b):
                    bad.append(f"{name} differs")
            return commands, len(names), bad

        for commands, count, bad in pool.map(both, enumerate(cases())):
            files += count
            faults += len(bad)
            for line in bad:
                print(f"{commands[0]}: {line}")
    print(f"{files} files of each build, {faults} differ")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
