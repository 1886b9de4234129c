#!/usr/bin/python3
# SPDX-License-Identifier: MPL-2.0
"""Runs the same surfaces through vdb_molsurf and through other programs, in turn, and compares them.

    bench/peers.py --tool build-release/tools/vdb_molsurf --runs 5 --voxel 0.5 BALLS.xyzr ...
    bench/peers.py --equal-error BALLS.xyzr ...

Each program that is installed makes the solvent-excluded surface of the same balls with a probe of
1.4 Å (FreeSASA: the area of the solvent-accessible one). Programs take turns, run by run, so that
what else goes on on the machine hits all alike; times are medians of whole processes, ratios are
medians of the ratios within a turn. Every answer is checked: its area and volume against those of
the exact surface (vdb_molsurf --surface ses at a quarter of the voxel, or --reference), and whether
its mesh is closed. With --equal-error each program takes the coarsest of its grids whose mesh is within 1 % of
the exact area and 0.1 % of the exact volume, and that is timed; else its finest. Needs python3-numpy and time. Debian has EDTSurf (edtsurf), PyMOL (pymol) and FreeSASA
(freesasa); NanoShaper is used if it is on PATH, and Mol* if node is, and finds its package: `npm
install molstar` in a folder, and NODE_PATH=FOLDER/node_modules; RustSASA if RUST_SASA_PYTHON names a Python that
has rust-sasa-python.
"""
import argparse
import contextlib
import json
import os
import platform
import re
import shutil
import signal
import statistics
import subprocess
import sys
import tempfile
import time

import numpy as np

PROBE = 1.4
# Radii that programs give to elements by themselves are told by element names.
ELEMENT = {1.7: "C", 1.55: "N", 1.52: "O", 1.8: "S", 1.2: "H", 2.0: "P"}


def read_balls(path):
    balls = []
    for line in open(path):
        words = line.split("#")[0].split()
        if len(words) >= 4:
            balls.append(tuple(float(w) for w in words[-4:]))
    return np.array(balls)


def write_pdb(balls, path, radius_as_occupancy=False):
    """Atoms in residues of ten; elements by radius, radii as B-factors too, or as occupancies."""
    with open(path, "w") as out:
        for i, (x, y, z, r) in enumerate(balls):
            element = ELEMENT.get(round(r, 2), "C")
            chain = chr(ord("A") + i // 99999 % 26)
            out.write(f"ATOM  {i % 99999 + 1:5d}  {element:<3s} ALA {chain}{i // 10 % 9999 + 1:4d}    "
                      f"{x:8.3f}{y:8.3f}{z:8.3f}{r if radius_as_occupancy else 1.0:6.2f}{r:6.2f}"
                      f"          {element:>2s}\n")
        out.write("END\n")


def mesh_numbers(points, triangles):
    """Area, volume, and whether every edge has two triangles."""
    a, b, c = (points[triangles[:, k]] for k in range(3))
    area = 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1).sum()
    volume = abs(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6.0)
    edges = np.sort(np.vstack([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    key = edges[:, 0].astype(np.int64) * len(points) + edges[:, 1]
    _, count = np.unique(key, return_counts=True)
    return {"area": area, "volume": volume, "closed": bool((count == 2).all()), "triangles": len(triangles)}


def read_text_ply(path):
    with open(path) as file:
        vertices = faces = 0
        for line in file:
            words = line.split()
            if words[:2] == ["element", "vertex"]:
                vertices = int(words[2])
            if words[:2] == ["element", "face"]:
                faces = int(words[2])
            if words == ["end_header"]:
                break
        points = np.array([file.readline().split()[:3] for _ in range(vertices)], float)
        triangles = np.array([file.readline().split()[1:4] for _ in range(faces)], int)
    return points, triangles


def read_binary_ply(path):
    """Points and triangles of a little-endian file whose faces have a list of indices and nothing else."""
    kinds = {"float": "<f4", "double": "<f8", "int": "<i4", "uint": "<u4", "uchar": "u1", "char": "i1",
             "short": "<i2", "ushort": "<u2"}
    data = open(path, "rb").read()
    header, body = data.split(b"end_header\n", 1)
    counts, fields, element = {}, [], ""
    for words in (line.split() for line in header.decode().splitlines()):
        if words[0] == "element":
            element = words[1]
            counts[element] = int(words[2])
        elif words[0] == "property" and element == "vertex":
            fields.append((words[2], kinds[words[1]]))
    vertices = np.frombuffer(body, np.dtype(fields), counts["vertex"])
    faces = np.frombuffer(body, np.dtype([("n", "u1"), ("i", "<i4", 3)]), counts["face"], vertices.nbytes)
    return np.stack([vertices[k] for k in "xyz"], 1).astype(float), faces["i"].astype(np.int64)


def read_off(path):
    with open(path) as file:
        lines = (line for line in file if line.strip() and not line.startswith("#"))
        next(lines)
        vertices, faces = (int(w) for w in next(lines).split()[:2])
        points = np.array([next(lines).split()[:3] for _ in range(vertices)], float)
        triangles = np.array([next(lines).split()[1:4] for _ in range(faces)], int)
    return points, triangles


class Program:
    """One program: its name, what it is called with, and the numbers that it leaves behind."""

    surface = "SES"
    settings = (1.0, 0.7, 0.5, 0.35, 0.25, 0.18, 0.125)  # edges of cells, or what the program has instead

    def version(self):
        return ""

    def prepare(self, case, folder):
        pass


class Molsurf(Program):
    def __init__(self, tool, kind, threads, triangles=False):
        self.tool, self.kind, self.threads = tool, kind, threads
        self.triangles = triangles  # whether its numbers are those of the triangles, not of the report
        self.name = f"vdb_molsurf {kind}, {threads} thread{'s' if threads > 1 else ''}"
        self.name += ", by its triangles" if triangles else ""
        self.surface = {"ses": "SES", "sas": "SAS"}.get(kind, kind)

    def version(self):
        return subprocess.run([self.tool, "--version"], capture_output=True, text=True).stdout.strip()

    def command(self, case, folder):
        out = os.path.join(folder, "molsurf")
        return [self.tool, case.path, "--surface", self.kind, "--voxel", str(case.voxel), "-j",
                str(self.threads), "--force", "-q", "-o", out + ".vdb", "-o", out + ".ply", "-o", out + ".json"]

    def result(self, case, folder, output):
        if self.triangles:
            return mesh_numbers(*read_binary_ply(os.path.join(folder, "molsurf.ply")))
        surface = json.load(open(os.path.join(folder, "molsurf.json")))["surface"]
        return {key: surface[key] for key in ("area", "volume", "closed", "triangles")}


class EDTSurf(Program):
    """Its grid has at most 300 cells along an axis: coarser than asked, where the molecule is large."""

    name = "EDTSurf"

    def prepare(self, case, folder):
        write_pdb(case.balls, os.path.join(folder, "atoms.pdb"))

    def command(self, case, folder):
        return [shutil.which("EDTSurf"), "-i", os.path.join(folder, "atoms.pdb"), "-o",
                os.path.join(folder, "edtsurf"), "-s", "4", "-f", str(1.0 / case.voxel), "-p", str(PROBE)]

    def result(self, case, folder, output):
        return mesh_numbers(*read_text_ply(os.path.join(folder, "edtsurf.ply")))


class PyMOL(Program):
    name = "PyMOL"
    settings = (0, 1, 2, 3)  # surface_quality

    def __init__(self, by_voxel=True):
        self.by_voxel = by_voxel  # cases say voxels: the default quality

    def prepare(self, case, folder):
        write_pdb(case.balls, os.path.join(folder, "pymol.pdb"))
        with open(os.path.join(folder, "surface.py"), "w") as out:
            out.write(f"""from pymol import cmd
cmd.load({os.path.join(folder, 'pymol.pdb')!r}, "m")
cmd.alter("all", "vdw=b")
cmd.rebuild()
cmd.set("solvent_radius", {PROBE})
cmd.set("surface_quality", {0 if self.by_voxel else case.voxel})
cmd.hide("everything")
cmd.show("surface")
cmd.save({os.path.join(folder, 'pymol.obj')!r})
""")

    def version(self):
        text = subprocess.run(["pymol", "-cq", "-d", "print(cmd.get_version()[0])"], capture_output=True, text=True)
        return text.stdout.strip()

    def command(self, case, folder):
        return [shutil.which("pymol"), "-cq", os.path.join(folder, "surface.py")]

    def result(self, case, folder, output):
        points, triangles = [], []
        for line in open(os.path.join(folder, "pymol.obj")):
            words = line.split()
            if words[:1] == ["v"]:
                points.append(words[1:4])
            elif words[:1] == ["f"]:
                triangles.append([int(w.split("/")[0]) - 1 for w in words[1:4]])
        # Its triangles do not share vertices: those at one place are one.
        points, index = np.unique(np.array(points, float).round(4), axis=0, return_inverse=True)
        return mesh_numbers(points, index[np.array(triangles)])


class NanoShaper(Program):
    name = "NanoShaper, 2 threads"

    def prepare(self, case, folder):
        np.savetxt(os.path.join(folder, "atoms.xyzr"), case.balls, fmt="%.4f")
        with open(os.path.join(folder, "surface.prm"), "w") as out:
            out.write(f"""Grid_scale = {1.0 / case.voxel}
Grid_perfil = 80.0
XYZR_FileName = atoms.xyzr
Surface = ses
Probe_Radius = {PROBE}
Build_epsilon_maps = false
Build_status_map = true
Triangulation = true
Smooth_Mesh = false
Number_thread = 2
""")

    def command(self, case, folder):
        return [shutil.which("NanoShaper"), "surface.prm"]

    def result(self, case, folder, output):
        return mesh_numbers(*read_off(os.path.join(folder, "triangulatedSurf.off")))


class Molstar(Program):
    name = "Mol* (node)"
    script = os.path.join(os.path.dirname(os.path.abspath(__file__)), "molstar.cjs")

    @staticmethod
    def found():
        command = ["node", "-e", "require.resolve('molstar/package.json')"]
        return shutil.which("node") and subprocess.run(command, capture_output=True).returncode == 0

    def version(self):
        command = ["node", "-p", "require('molstar/package.json').version"]
        return subprocess.run(command, capture_output=True, text=True).stdout.strip()

    def command(self, case, folder):
        return [shutil.which("node"), "--max-old-space-size=16000", self.script, case.path, str(case.voxel),
                str(PROBE), os.path.join(folder, "points"), os.path.join(folder, "triangles")]

    def result(self, case, folder, output):
        points = np.fromfile(os.path.join(folder, "points"), np.float32).reshape(-1, 3)
        triangles = np.fromfile(os.path.join(folder, "triangles"), np.uint32).reshape(-1, 3)
        return mesh_numbers(points.astype(float), triangles.astype(np.int64))


class FreeSASA(Program):
    """The area of the solvent-accessible surface by a hundred points an atom; no mesh, no volume."""

    name, surface = "FreeSASA, 100 points an atom", "SAS"

    settings = ()

    def prepare(self, case, folder):
        write_pdb(case.balls, os.path.join(folder, "freesasa.pdb"), radius_as_occupancy=True)

    def version(self):
        return subprocess.run(["freesasa", "--version"], capture_output=True, text=True).stdout.split("\n")[0]

    def command(self, case, folder):
        return [shutil.which("freesasa"), "--shrake-rupley", "--n-threads=2", "--radius-from-occupancy", "--hydrogen",
                os.path.join(folder, "freesasa.pdb")]

    def result(self, case, folder, output):
        return {"area": float(re.search(r"^Total\s*:\s*([\d.]+)", output, re.M).group(1))}


class RustSASA(Program):
    """As FreeSASA, by the package rust-sasa-python of the Python that RUST_SASA_PYTHON names."""

    name, surface = "RustSASA, 100 points an atom", "SAS"
    settings = ()
    python = os.environ.get("RUST_SASA_PYTHON", "")
    script = """
import sys, numpy, rust_sasa_python
balls = numpy.loadtxt(sys.argv[1])
atoms = [((x, y, z), r, i) for i, (x, y, z, r) in enumerate(balls.tolist())]
print(sum(rust_sasa_python.calculate_sasa_internal(atoms, 1.4, 100, 2)))
"""

    def prepare(self, case, folder):
        np.savetxt(os.path.join(folder, "rust.xyzr"), case.balls, fmt="%.4f")

    def command(self, case, folder):
        return [self.python, "-c", self.script, os.path.join(folder, "rust.xyzr")]

    def result(self, case, folder, output):
        return {"area": float(output.split()[-1])}


class Case:
    def __init__(self, path, voxel):
        self.path, self.voxel, self.balls = os.path.abspath(path), voxel, read_balls(path)
        self.name = os.path.basename(path).rsplit(".", 1)[0]


def run_once(program, case, folder, limit):
    """Seconds by the clock and of the processor, peak memory [MB] and output of a whole process."""
    # What wait4() says counts the memory of this script, too; time(1) is small.
    used = os.path.join(folder, "memory.txt")
    with tempfile.TemporaryFile() as output:
        start = time.monotonic()
        process = subprocess.Popen([shutil.which("time"), "-f", "%U %S %M", "-o", used, *program.command(case, folder)],
                                   cwd=folder, stdout=output, stderr=subprocess.STDOUT, start_new_session=True)
        killed = False
        while True:
            pid, status = os.waitpid(process.pid, os.WNOHANG)
            if pid:
                break
            if time.monotonic() - start > limit and not killed:
                os.killpg(process.pid, signal.SIGKILL)
                killed = True
            time.sleep(0.002)
        seconds = time.monotonic() - start
        process.returncode = os.waitstatus_to_exitcode(status)
        output.seek(0)
        text = output.read().decode(errors="replace")
    if killed:
        raise RuntimeError(f"stopped after {limit} s")
    if process.returncode != 0:
        raise RuntimeError(f"status {process.returncode}: {text.strip().splitlines()[-1:]}")
    user, system, kilobytes = map(float, open(used).read().split()[-3:])
    return seconds, user + system, kilobytes / 1024.0, text


def reference(tool, case, kind, threads):
    """Area and volume at a quarter of the voxel."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "r.json")
        subprocess.run([tool, case.path, "--surface", kind, "--voxel", str(case.voxel / 4), "-j", str(threads), "-q",
                        "-o", path], check=True)
        surface = json.load(open(path))["surface"]
        return surface["area"], surface["volume"]


def measure(case, programs, runs, limit):
    """Rounds in which every program runs once; one that fails drops out, with the reason."""
    rows = {p.name: {"seconds": [], "cpu": [], "memory": 0.0} for p in programs}
    with tempfile.TemporaryDirectory() as folder:
        for program in programs:
            program.prepare(case, folder)
        for turn in range(runs + 1):  # the first warms the caches of files up
            for program in programs:
                row = rows[program.name]
                if "error" in row:
                    continue
                try:
                    seconds, cpu, memory, text = run_once(program, case, folder, limit)
                    if turn == 0:
                        row.update(program.result(case, folder, text))
                    else:
                        row["seconds"].append(seconds)
                        row["cpu"].append(cpu)
                        row["memory"] = max(row["memory"], memory)
                except (RuntimeError, OSError, ValueError, AttributeError, IndexError) as error:
                    row["error"] = str(error)[:80]
    return rows


MOST_AREA, MOST_VOLUME = 0.01, 0.001  # errors that --equal-error allows


def coarsest(program, path, exact, limit):
    """The first of a program's settings whose mesh is near enough to the exact surface, else the last that it can do;
    whether it is near enough, or why there is none."""
    case, why = None, ""
    for setting in program.settings:
        finer = Case(path, setting)
        row = measure(finer, [program], 0, limit)[program.name]
        if "error" in row:
            return case, case is None and row["error"]
        case = finer
        area, volume = (abs(row[k] / e - 1.0) for k, e in zip(("area", "volume"), exact))
        if area <= MOST_AREA and volume <= MOST_VOLUME:
            return case, True
    return case, False


def equal_error(paths, programs, tool, options):
    """A table for each molecule: what each program takes to be within the allowed errors."""
    for path in paths:
        exact = reference(tool, Case(path, options.voxel), "ses", 2)
        found = {p: coarsest(p, path, exact, options.limit) for p in programs}
        seconds = {p: [] for p in programs}
        memory = dict.fromkeys(programs, 0.0)
        rows = {}
        with contextlib.ExitStack() as stack:
            folders = {p: stack.enter_context(tempfile.TemporaryDirectory()) for p in programs}
            for p in programs:
                if found[p][0]:
                    p.prepare(found[p][0], folders[p])
            for turn in range(options.runs):
                for p in programs:
                    if not found[p][0]:
                        continue
                    try:
                        used, _, most, text = run_once(p, found[p][0], folders[p], options.limit)
                    except RuntimeError as error:  # near the limit
                        found[p] = None, str(error)
                        continue
                    seconds[p].append(used)
                    memory[p] = max(memory[p], most)
                    if turn == 0:
                        rows[p] = p.result(found[p][0], folders[p], text)
        print(f"### {Case(path, 1).name}: within {100 * MOST_AREA:g} % of the area, {100 * MOST_VOLUME:g} % of the volume\n")
        print("| program | grid or quality | reached | s | MB | area % | volume % | closed |")
        print("|---|---|---|---|---|---|---|---|")
        for p in programs:
            case, reached = found[p]
            if not case:
                print(f"| {p.name} | {reached} | | | | | | |")
                continue
            row = rows[p]
            print(f"| {p.name} | {case.voxel:g} | {'yes' if reached else 'no'} | {statistics.median(seconds[p]):.2f} | {memory[p]:.0f} | "
                  f"{per_cent(row['area'], exact[0])} | {per_cent(row['volume'], exact[1])} | {row['closed']} |")
        print(flush=True)


def per_cent(value, exact):
    return "" if value is None or not exact else f"{100.0 * (value / exact - 1.0):+.2f}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("balls", nargs="+", help=".xyzr files")
    parser.add_argument("--tool", default="build-release/tools/vdb_molsurf")
    parser.add_argument("--voxel", type=float, default=0.5, help="Å (0.5)")
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--limit", type=float, default=600.0, help="seconds a run may take (600)")
    parser.add_argument("--no-reference", action="store_true", help="skip the runs at a quarter of the voxel")
    parser.add_argument("--equal-error", action="store_true",
                        help="time the coarsest grids that reach an error, of solvent-excluded surfaces")
    parser.add_argument("--json", help="also write all figures here")
    options = parser.parse_args()
    tool = os.path.abspath(options.tool)

    programs = [Molsurf(tool, "ses", 2), Molsurf(tool, "ses", 1)]
    if options.equal_error:
        programs.append(Molsurf(tool, "ses", 2, triangles=True))
    else:
        programs += [Molsurf(tool, "variational", 2), Molsurf(tool, "variational", 1), Molsurf(tool, "sas", 2)]
    for name, found, peer in (("EDTSurf", shutil.which("EDTSurf"), EDTSurf()),
                              ("pymol", shutil.which("pymol"), PyMOL(not options.equal_error)),
                              ("NanoShaper", shutil.which("NanoShaper"), NanoShaper()),
                              ("molstar", Molstar.found(), Molstar()),
                              ("freesasa", shutil.which("freesasa"), FreeSASA()),
                              ("rust-sasa-python", RustSASA.python, RustSASA())):
        if options.equal_error and not peer.settings:
            continue
        if found:
            programs.append(peer)
        else:
            print(f"not found: {name}", file=sys.stderr)

    processor = next((line.split(":")[1].strip() for line in open("/proc/cpuinfo") if "model name" in line), "?")
    commit = subprocess.run(["git", "rev-parse", "--short", "HEAD"], capture_output=True, text=True,
                            cwd=os.path.dirname(os.path.abspath(__file__))).stdout.strip()
    print(f"{processor}, {os.cpu_count()} processors, load {os.getloadavg()[0]:.1f}; {platform.platform()}; "
          f"commit {commit}; medians of {options.runs} runs in turn\n")
    if options.equal_error:
        equal_error(options.balls, programs, tool, options)
        return
    everything = []
    for path in options.balls:
        case = Case(path, options.voxel)
        exact = {"SES": (None, None), "SAS": (None, None)}
        if not options.no_reference:
            exact = {k.upper(): reference(tool, case, k, 2) for k in ("ses", "sas")}
        rows = measure(case, programs, options.runs, options.limit)
        own = rows[programs[0].name]
        print(f"### {case.name}: {len(case.balls)} atoms, {options.voxel} Å\n")
        print("| program | surface | s | min-max | CPU s | ratio to the first | MB | area % | volume % | closed |")
        print("|---|---|---|---|---|---|---|---|---|---|")
        for program in programs:
            row = rows[program.name]
            if "error" in row or not row["seconds"]:
                print(f"| {program.name} | {program.surface} | {row.get('error', 'no run')} | | | | | | | |")
                continue
            ratios = [a / b for a, b in zip(row["seconds"], own["seconds"])]
            area, volume = exact.get(program.surface, (None, None))
            print(f"| {program.name} | {program.surface} | {statistics.median(row['seconds']):.2f} | "
                  f"{min(row['seconds']):.2f}-{max(row['seconds']):.2f} | {statistics.median(row['cpu']):.2f} | "
                  f"{statistics.median(ratios):.2f} "
                  f"({min(ratios):.2f}-{max(ratios):.2f}) | {row['memory']:.0f} | {per_cent(row.get('area'), area)} | "
                  f"{per_cent(row.get('volume'), volume)} | {row.get('closed', '')} |")
        print(flush=True)
        everything.append({"case": case.name, "atoms": len(case.balls), "voxel": options.voxel, "programs": rows,
                           "versions": {p.name: p.version() for p in programs if not isinstance(p, PyMOL)}})
    if options.json:
        json.dump(everything, open(options.json, "w"), indent=1)


if __name__ == "__main__":
    main()
