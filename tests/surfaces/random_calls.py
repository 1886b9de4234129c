#!/usr/bin/python3
# SPDX-License-Identifier: MPL-2.0
"""Calls the program with small files whose structure was mutated, and with options drawn at random.

    tests/surfaces/random_calls.py PROGRAM [--runs 1000] [--seed 1] [--keep FOLDER]

PROGRAM should be a build with sanitizers (scripts/sanitizers.sh program). A finding is a signal, a report of a
sanitizer, a status that is not documented, a failure without its one line of error or with a file left behind, and
more processor time than 10 s and eight times what --dry-run says, since sanitizers make runs slow. Prints each finding with its call, keeps its files in
FOLDER, and exits with 1 if there is one. The first line has the seed.
"""

import argparse
import collections
import gzip
import pathlib
import random
import re
import resource
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
STATUSES = {0, 1, 2, 3, 75}
SECONDS = 10
SLOWER = 8  # with sanitizers


def crambin(atoms):
    lines = (ROOT / "tests/data/1crn.pdb").read_text().splitlines()
    return [line for line in lines if line.startswith("ATOM")][:atoms]


def pdb(rng):
    lines = crambin(rng.choice((1, 2, 8, 40)))
    if rng.random() < 0.3:
        lines += ["HETATM 9001 NA    NA A 901      12.000  14.000  10.000  1.00  0.00          NA"]
    if rng.random() < 0.3:
        lines = ["MODEL        1", *lines, "ENDMDL", "MODEL        2", *lines, "ENDMDL"]
    return lines


def mmcif(rng):
    text = gzip.decompress((ROOT / "tests/data/1a8o.cif.gz").read_bytes()).decode()
    lines = text.splitlines()
    atoms = [i for i, line in enumerate(lines) if line.startswith(("ATOM", "HETATM"))]
    gone = set(atoms[rng.choice((1, 10, 40)):])
    return [line for i, line in enumerate(lines) if i not in gone]


def pqr(rng):
    return [f"ATOM {i + 1} CA ALA {i + 1} {3.8 * i:.3f} {rng.uniform(-1, 1):.3f} 0.000 {rng.uniform(-1, 1):.2f} 1.7"
            for i in range(rng.choice((1, 3, 12)))]


def xyzr(rng):
    lattice = rng.random() < 0.5
    return [" ".join(f"{rng.randrange(4) if lattice else rng.uniform(0, 6):g}" for _ in range(3)) +
            f" {rng.choice((1, 1.5, 1.7, 0.1, 5))}" for _ in range(rng.choice((1, 2, 7, 30)))]


def xyzrn(rng):
    return [f"{line} 1 CA_ALA_{i + 1}" for i, line in enumerate(xyzr(rng))]


def gro(rng):
    atoms = rng.choice((1, 5, 40))
    return ["from crambin", f"{atoms:5d}"] + [
        f"{i // 4 + 1:5d}{'ALA':5s}{name:>5s}{i + 1:5d}" + "".join(f"{rng.uniform(0, 0.8):8.3f}" for _ in range(3))
        for i, name in zip(range(atoms), ("N", "CA", "C", "O") * 10)] + ["   1.00000   1.00000   1.00000"]


def sdf(rng):
    atoms = rng.choice((1, 6, 20))
    return ["ligand", "  test", "", f"{atoms:3d}{atoms - 1:3d}  0  0  0  0  0  0  0  0999 V2000"] + [
        "".join(f"{value:10.4f}" for value in (1.4 * i, rng.uniform(-1, 1), 0)) + f" {rng.choice('CNO')}   0  0"
        for i in range(atoms)] + [f"{i + 1:3d}{i + 2:3d}  1  0" for i in range(atoms - 1)] + ["M  END", "$$$$"]


def mol2(rng):
    atoms = rng.choice((1, 6, 20))
    return ["@<TRIPOS>MOLECULE", "ligand", f"{atoms} 0 1", "SMALL", "NO_CHARGES", "@<TRIPOS>ATOM"] + [
        f"{i + 1} C{i + 1} {1.4 * i:.4f} {rng.uniform(-1, 1):.4f} 0.0 {rng.choice(('C.3', 'N.ar', 'O.2'))} 1 LIG 0.1"
        for i in range(atoms)]


INPUTS = {"pdb": pdb, "cif": mmcif, "pqr": pqr, "xyzr": xyzr, "xyzrn": xyzrn, "gro": gro, "sdf": sdf, "mol2": mol2}
NUMBERS = ("0", "-0", "-1", "1e9", "1e-9", "nan", "inf", "999999", "0.0005", "99999999999999999999", "", "?", "1e400")


def mutated(lines, rng):
    """Lines of a file with a few of them changed as a person or a bad program would."""
    lines = list(lines)
    for _ in range(rng.choice((0, 0, 1, 1, 2, 5))):
        i = rng.randrange(len(lines))
        kind = rng.randrange(8)
        if kind == 0:
            lines[i] = lines[i][:rng.randrange(len(lines[i]) + 1)]
        elif kind == 1:
            lines.insert(i, lines[rng.randrange(len(lines))])
        elif kind == 2 and len(lines) > 1:
            del lines[i]
        elif kind == 3:
            words = list(re.finditer(r"-?\d+\.?\d*", lines[i]))
            if words:
                word = rng.choice(words)
                new = rng.choice(NUMBERS)
                lines[i] = lines[i][:word.start()] + new.rjust(len(word[0])) + lines[i][word.end():]
        elif kind == 4 and lines[i]:
            at = rng.randrange(len(lines[i]))
            lines[i] = lines[i][:at] + chr(rng.choice((0, 9, 10, 27, 127, 200, 0x30, 0x2d))) + lines[i][at + 1:]
        elif kind == 5:
            rng.shuffle(lines)
        elif kind == 6:
            lines[i] = lines[i] * rng.choice((2, 40))
        else:
            lines = [line.lower() for line in lines]
    return "\n".join(lines) + rng.choice(("\n", "", "\n\n", "\r\n"))


def number(rng, *good):
    return rng.choice(NUMBERS) if rng.random() < 0.1 else rng.choice(good)


def surface_options(rng):
    """Options of a build; most of them go together."""
    choices = (
        lambda: ["--surface", rng.choice(("variational", "ses", "sas", "vdw", "gaussian"))],
        lambda: ["--voxel", number(rng, "0.7", "1", "2", "5", "10", "0.4")],
        lambda: ["--probe", number(rng, "0", "0.1", "1.4", "3", "10")],
        lambda: ["--lambda", number(rng, "0", "0.001", "0.1", "1", "100")],
        lambda: ["--epsilon", number(rng, "0.1", "0.5", "2")],
        lambda: ["--regularizer", rng.choice(("gradient", "area"))],
        lambda: rng.choice((["--flow", "newton"], ["--flow", "paper", "--max-steps", "20"])),  # of 200, all made
        lambda: ["--max-steps", rng.choice(("0", "1", "5"))],
        lambda: ["--group-by", rng.choice(("chain", "entity", "class", "copy", "residues:1", "residues:7", "residues:0"))],
        lambda: ["--color", rng.choice(("chain", "group", "element", "residue", "nucleotide", "bfactor", "charge",
                                        "rainbow", "radius", "depth", "plain=red", "mean-curvature", "hydrophobicity", "copy"))],
        lambda: ["--fields", rng.choice(("all", "sas,spline", "depth", "density", "Cd", "atom_id", "shape_index"))],
        lambda: ["--measures", rng.choice(("sphericity", "gyration_radius,sphericity", "girth", ""))],
        lambda: [rng.choice(("--fill-cavities", "--curvature-totals", "--interfaces", "--center", "--sharp-colors", "--vdb-half",
                             "--waters", "--ions", "--hetero", "--no-hetero", "--no-hydrogens", "--by-symmetry",
                             "--instances", "--weld", "--match-volume", "--depth-cue", "--dry-run"))],
        lambda: ["--assembly", rng.choice(("1", "2", "ncs", "none"))],
        lambda: ["--copies", rng.choice(("1", "1-2", "fold:2", "9"))],
        lambda: ["--resolution", rng.choice(("5", "A/1-3=8", "50", "0.5"))],
        lambda: ["--coarse", rng.choice(("residue", "4", "atom"))],
        lambda: ["--split", "group"],
        lambda: ["--select", rng.choice(("A", "A/1-3", "*", "(ALA)", "/2/A", "[", "B"))],
        lambda: ["--altloc", rng.choice(("A", "all"))],
        lambda: ["--radii", rng.choice(("bondi", "protor", "naccess", "gemmi", "alvarez"))],
        lambda: ["--areas", rng.choice(("atoms", "residues", "contacts,interfaces"))],
        lambda: ["--contacts", rng.choice(("atom", "residue", "chain"))],
        lambda: ["--frames", rng.choice(("all", "1", "1-2", "2-9:3", "1:3"))],
        lambda: ["--frames", "all", "--superpose", rng.choice(("auto", "A", "A/1-3", "["))],
        lambda: ["--pockets", "--show", rng.choice(("pockets=2", "pockets=all", "pockets=0", "pocket1,A"))],
        lambda: ["--patches", rng.choice(("hydrophobicity>0", "mean-curvature<-0.1", "charge>0", "radius>nan", "depth<", "<1")),
                 *rng.choice(([], ["--color", "patch"], ["-o", "out.patches.csv"]))],
        lambda: ["--smooth-colors", number(rng, "0.5", "2", "5", "20"), "--color", rng.choice(("mean-curvature", "bfactor", "plddt")),
                 *rng.choice(([], ["--patches", "mean-curvature>0"], ["--flat-values"], ["--fields", "Cd"]))],
        lambda: ["--tunnels-from", rng.choice(("A/1-3", "*", "1,2,0", "0,0", "[")), "--tunnel-probe", number(rng, "0.9", "0.3", "2"),
                 "-o", f"out.tunnels.{rng.choice(('csv', 'ply', 'glb', 'pdb', 'cif', 'cxc', 'pml'))}"],
        lambda: ["--frames", "all", "--tunnels-from", rng.choice(("A/1-3", "1,2,0")), "-o", "out.tunnel_frames.csv"],
        lambda: ["--memory", rng.choice(("50M", "100M", "4G"))],
        lambda: ["--for", rng.choice(("blender", "blender4", "houdini", "usd", "blender=nm", "unreal", "arnold=0.1"))],
        lambda: ["--ids", rng.choice(("int", "float", "double")), "--fields", "atom_id,density", *rng.choice(([], ["--one-box"]))],
        lambda: ["--mips", rng.choice(("0", "2", "10", "11", "x")), "--fields", "density,Cd"],
        lambda: ["--print-scale", "1", "--min-thickness", rng.choice(("1", "5", "60", "1e5"))],
        lambda: ["--pixel-size", rng.choice(("1", "4", "13.54", "0.2", "0")), "-o", f"out.{rng.choice(('density', 'mask'))}.mrc",
                 *rng.choice(([], ["--box-size", "32"], ["--box-size", "7"], ["--mask-edge", "0"], ["--mask-extend", "2"],
                              ["--invert-density"], ["--resolution", "12"]))],
        lambda: ["--spline-level", rng.choice(("1", "2"))],
        lambda: ["--view", rng.choice(("1,0,0", "auto", "0,0,0"))],
        lambda: ["--zoom", rng.choice(("1", "A/1-3", "all", "0,0,0", "1,2,3;4,5,6;", "within 5 of index 0"))],
        lambda: ["--size", rng.choice(("16", "60"))],
        lambda: ["--style", rng.choice(("soft", "glossy", "outline", "flat"))],
        lambda: ["--opacity", number(rng, "0.2", "0.7", "1")],
        lambda: ["--clip", number(rng, "0", "2", "-3")],
        lambda: ["--color", rng.choice(("bfactor", "hydrophobicity", "charge")),
                 "--value-of", rng.choice(("atom", "residue"))],
        lambda: ["--color", rng.choice(("bfactor", "gaussian-curvature")),
                 "--palette", rng.choice(("viridis", "cividis")), "--range", rng.choice(("0,10", "-1,1", "1,1", "nan,2"))],
        lambda: ["--color", "bfactor", "--flat-values"])
    words = []
    for choice in rng.sample(choices, rng.choice((1, 2, 3, 4, 6))):
        words += choice()
    if "--voxel" not in words:
        words += ["--voxel", rng.choice(("1", "2"))]
    return words


def call(rng, folder):
    """The words of a call, for whose input a file is made."""
    kind = rng.choice(sorted(INPUTS))
    name = f"in.{kind}"
    (folder / name).write_text(mutated(INPUTS[kind](rng), rng))
    if rng.random() < 0.05:
        return ["info", name]
    if rng.random() < 0.05:
        other = rng.choice(sorted(INPUTS))
        (folder / f"in.2.{other}").write_text(mutated(INPUTS[other](rng), rng))
        words = ["compare", name, f"in.2.{other}", "--voxel", rng.choice(("1", "2")), "-o", "out.json"]
        return words + rng.choice(([], ["--superpose", rng.choice(("auto", "A", "A/1-3", "*", "["))]))
    endings = ("vdb", "ply", "obj", "stl", "off", "glb", "3mf", "html", "json", "png", "atoms.csv", "residues.csv",
               "contacts.csv", "interfaces.csv", "pdb", "cif", "usda", "mrc", "dx", "vert", "face", "cxc", "pml")
    outputs = [f"out.{ending}" for ending in rng.sample(endings, rng.choice((1, 1, 2, 3)))]
    words = [name, *surface_options(rng)]
    if "out.png" in outputs and "--size" not in words:
        words += ["--size", "100"]
    for output in outputs:
        words += ["-o", output]
    return words


def estimate(program, words, folder):
    """The seconds on one core that the program says a call takes, or one of its frames; 0 if it says nothing."""
    if "--frames" in words:
        at = words.index("--frames")
        words = words[:at] + words[at + 2:]
    done = subprocess.run([program, *words, "--dry-run", "--force"], cwd=folder, capture_output=True)
    said = re.search(rb"([0-9.e+]+) s on one core", done.stderr + done.stdout)
    return float(said[1]) if said else 0.0


def finding(done, made, words):
    """What is wrong with a call but for its time, or None."""
    error = done.stderr.decode(errors="replace")
    if done.returncode < 0:
        return f"signal {signal.Signals(-done.returncode).name}"
    if re.search(r"ERROR: \w+Sanitizer|runtime error:", error):
        return "a sanitizer: " + re.search(r".*(ERROR: \w+Sanitizer|runtime error:).*", error)[0]
    if done.returncode not in STATUSES:
        return f"status {done.returncode}"
    if done.returncode in (1, 2, 75) or (done.returncode == 3 and not made):
        if error.count("vdb_molsurf: error: ") != 1:
            return "no line of error, or several"
        if made and "--frames" not in words:  # frames before the one that failed stay
            return f"status {done.returncode} and the files {made}"
    return None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--runs", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--keep", type=pathlib.Path, default=pathlib.Path("findings"))
    args = parser.parse_args()
    print(f"seed {args.seed}, {args.runs} runs")
    statuses, found = collections.Counter(), 0
    for number in range(args.runs):
        rng = random.Random(f"{args.seed} {number}")  # each run by itself
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            words = call(rng, folder)
            before = resource.getrusage(resource.RUSAGE_CHILDREN)
            done = subprocess.run([args.program.resolve(), *words, "-j", "1"] if words[0] != "info" else
                                  [args.program.resolve(), *words], cwd=folder, capture_output=True)
            after = resource.getrusage(resource.RUSAGE_CHILDREN)
            made = sorted(p.name for p in folder.iterdir() if not p.name.startswith("in."))
            statuses[done.returncode] += 1
            what = finding(done, made, words)
            seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
            if not what and seconds > SECONDS and \
                    seconds > SLOWER * estimate(args.program.resolve(), words, folder):
                what = f"{seconds:.1f} s of processor time"
            if not what:
                continue
            found += 1
            print(f"run {number}: {what}: {shlex.join(words)}", flush=True)
            shutil.copytree(folder, args.keep / f"{args.seed}-{number}", dirs_exist_ok=True)
    print(f"statuses {dict(statuses)}")
    print(f"calls: {args.runs} runs, {found} faults")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
