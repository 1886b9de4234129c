# SPDX-License-Identifier: MPL-2.0
"""vdb_molsurf_msms, the stand-in for MSMS: its files, read as MSMS's manual describes them, hold the
surface in closed form, and callers of MSMS run with it unchanged."""

import csv
import gzip
import json
import math
import os
import pathlib
import re
import subprocess
import unittest
from unittest import mock

from needs import needs
from tool import CRAMBIN, DATA, ROOT, TOOL, ToolTest

MSMS = pathlib.Path(TOOL).resolve().parent / "vdb_molsurf_msms"
TORIC, SPHERICAL, CONTACT = 1, 2, 3
RADII = {"C": 1.88, "N": 1.64, "O": 1.42, "S": 1.77, "P": 1.8, "H": 1.2}


def xyzrn(path):
    """The atoms of a PDB file without water as pdb_to_xyzrn writes them."""
    text = gzip.open(path, "rt").read() if path.suffix == ".gz" else path.read_text()
    lines = []
    for line in text.split("\nENDMDL")[0].splitlines():
        if line[:6] not in ("ATOM  ", "HETATM") or line[17:20] == "HOH" or line[16] not in " A":
            continue
        atom, residue, number = (line[a:b].strip() for a, b in ((12, 16), (17, 20), (22, 26)))
        lines.append(f"{line[30:38]} {line[38:46]} {line[46:54]} {RADII.get(atom[0], 1.5):.6f} 1 "
                     f"{atom}_{residue}_{number}\n")
    return "".join(lines)


def minus(a, b):
    return tuple(x - y for x, y in zip(a, b))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


class Surface:
    """The files of a component, read after the manual: %9.3f six times, %7d %7d %2d, a name."""

    def __init__(self, base, header=True):
        vertex = re.compile(r"(?:[ -].{7}\d ){6}[ \d]{6}\d [ \d]{6}\d [ \d]\d( \S+)?$")
        face = re.compile(r"[ \d]{5}\d [ \d]{5}\d [ \d]{5}\d [ \d]\d [ \d]{5}\d$")
        self.headers = []
        lines = self.lines(base, ".vert", header)
        assert all(map(vertex.match, lines)), lines[:3]
        rows = [line.split() for line in lines]
        self.positions = [tuple(map(float, row[:3])) for row in rows]
        self.normals = [tuple(map(float, row[3:6])) for row in rows]
        self.faces, self.spheres, self.kinds = ([int(row[k]) for row in rows] for k in (6, 7, 8))
        self.names = [row[9] for row in rows if len(row) > 9]
        lines = self.lines(base, ".face", header)
        assert all(map(face.match, lines)), lines[:3]
        rows = [tuple(map(int, line.split())) for line in lines]
        self.triangles = [tuple(v - 1 for v in row[:3]) for row in rows]
        self.triangle_kinds = [row[3] for row in rows]

    def lines(self, base, ending, header):
        lines = base.with_name(base.name + ending).read_text().splitlines()
        if header:
            assert lines[0].startswith("# MSMS solvent excluded surface "), lines[0]
            assert lines[1].startswith("#"), lines[1]
            self.headers.append(lines[2])
            lines = lines[3:]
            assert int(self.headers[-1].split()[0]) == len(lines), self.headers
        return lines

    def closed(self):
        """Whether every edge has two triangles that run through it in opposite directions."""
        edges = [(t[k], t[(k + 1) % 3]) for t in self.triangles for k in range(3)]
        return len(set(edges)) == len(edges) and set(edges) == {(b, a) for a, b in edges}

    def area(self):
        at = self.positions
        return sum(math.sqrt(dot(n, n)) / 2 for n in (
            cross(minus(at[b], at[a]), minus(at[c], at[a])) for a, b, c in self.triangles))

    def volume(self):
        at = self.positions
        return sum(dot(at[a], cross(at[b], at[c])) / 6 for a, b, c in self.triangles)


class Msms(ToolTest):
    def run_msms(self, *words, **options):
        options = {"cwd": self.folder, "capture_output": True, "text": True, "timeout": 300, **options}
        return subprocess.run([MSMS, *map(str, words)], **options)

    def msms(self, *words, warnings=()):
        done = self.run_msms(*words)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), len(warnings), done.stderr)
        for line, warning in zip(done.stderr.splitlines(), warnings):
            self.assertIn(warning, line)
        self.assertTrue(done.stdout.endswith("\nMSMS terminated normally\n"), done.stdout)
        return done.stdout

    def refuse(self, status, *words, says=()):
        before = {name: (self.folder / name).stat().st_mtime_ns for name in self.names()}
        done = self.run_msms(*words)
        self.assertEqual(done.returncode, status, done.stderr)
        last = done.stderr.splitlines()[-1]
        self.assertTrue(last.startswith("vdb_molsurf_msms: error: "), done.stderr)
        self.assertEqual(done.stderr.count("error: "), 1)
        self.assertTrue(status == 1 or len(done.stderr.splitlines()) == 1, done.stderr)
        for word in [says] if isinstance(says, str) else says:
            self.assertIn(word, last)
        self.assertNotIn("terminated normally", done.stdout)
        self.assertEqual({name: (self.folder / name).stat().st_mtime_ns for name in self.names()}, before)

    def write(self, name, text):
        (self.folder / name).write_text(text)

    def surface(self, base="a", **options):
        return Surface(self.folder / base, **options)

    def totals(self, text):
        """Of each component (re-entrant, toric, contact, SES, SAS), and (volume, area) of each that has a mesh."""
        analytical = text.split("ANALYTICAL SURFACE AREA :\n")[1].splitlines()[1:]
        numerical = text.split("NUMERICAL VOLUMES AND AREA\n")[1].splitlines()[1:]
        rows = [line.split() for line in analytical]
        sums = [tuple(map(float, row[2:])) for row in rows[:[len(row) == 7 for row in rows].index(False)]]
        count = [line.startswith("    Total ") for line in numerical].index(True)
        parts = [tuple(map(float, line.split()[2:])) for line in numerical[:count]]
        total = re.search(r"^    Total ses_volume: +(\S+)$", text, re.MULTILINE)
        self.assertAlmostEqual(float(total[1]), sum(part[0] for part in parts), delta=0.01)
        return sums, parts

    def areas(self, name="a.area"):
        """(SES, SAS, name or None) of each sphere."""
        lines = (self.folder / name).read_text().splitlines()
        self.assertEqual(lines[0].split()[0], "Atom")
        rows = [line.split() for line in lines[1:]]
        self.assertEqual([int(row[0]) for row in rows], list(range(len(rows))))
        return [(float(row[1]), float(row[2]), row[3] if len(row) > 3 else None) for row in rows]


class ClosedForm(Msms):
    def test_one_ball(self):
        centre, radius = (0.5, -1.25, 2.0), 1.7
        self.write("one.xyzr", "# a comment\n\n0.5 -1.25 2.0 1.7\n")
        (sums,), ((volume, _),) = self.totals(
            self.msms("-if", "one.xyzr", "-of", "a", "-af", "a", "-density", 10))
        for found, exact in zip(sums, (0, 0, 1, 1, (3.2 / 1.7) ** 2)):
            self.assertAlmostEqual(found, exact * 4 * math.pi * radius ** 2, delta=1e-3)
        self.assertAlmostEqual(volume, 4 / 3 * math.pi * radius ** 3, delta=0.02)
        (ses, sas, name), = self.areas()
        self.assertEqual((round(ses - sums[3], 3), round(sas - sums[4], 3), name), (0, 0, None))
        a = self.surface()
        self.assertEqual(a.headers, [f"{len(a.positions):7}       1 10.00  1.50",
                                     f"{len(a.triangles):7}       1 10.00  1.50"])
        self.assertTrue(a.closed())
        self.assertEqual((set(a.kinds), set(a.spheres), set(a.faces), a.names),
                         ({CONTACT}, {1}, {1}, []))
        self.assertEqual(set(a.triangle_kinds), {CONTACT})
        for x, n in zip(a.positions, a.normals):
            self.assertAlmostEqual(math.dist(x, centre), radius, delta=1e-3)
            self.assertLess(math.dist(minus(x, centre), [radius * k for k in n]), 3e-3)
        self.assertGreater(a.volume(), 0)

    def two(self, distance, radii, probe, density):
        """A pair along x: the circle of probes, the half angles of its arc, and what is found."""
        self.write("two.xyzrn", f"0 0 0 {radii[0]} 1 A\n{distance} 0 0 {radii[1]} 1 B\n")
        text = self.msms("-if", "two.xyzrn", "-of", "a", "-af", "a", "-probe", probe, "-density", density,
                         "-hdensity", density, "-all")
        grown = [r + probe for r in radii]
        along = (distance ** 2 + grown[0] ** 2 - grown[1] ** 2) / (2 * distance)
        ring = math.sqrt(grown[0] ** 2 - along ** 2)
        angles = [math.atan2(along, ring), math.atan2(distance - along, ring)]
        contact = [2 * math.pi * r ** 2 * (1 + math.sin(angle)) for r, angle in zip(radii, angles)]
        # Where the ring is narrower than the probe, the two sides end in cusps on the axis.
        cusp = math.acos(min(1, ring / probe))
        toric = sum(2 * math.pi * probe * (ring * (angle - cusp) - probe * (math.sin(angle) - math.sin(cusp)))
                    for angle in angles)
        self.assertEqual(self.names(), ["a.area", "a.face", "a.vert", "two.xyzrn"])
        (sums,), _ = self.totals(text)
        a = self.surface()
        self.assertTrue(a.closed())
        self.assertEqual(set(a.kinds), {TORIC, CONTACT})
        for x, n, kind, sphere, name in zip(a.positions, a.normals, a.kinds, a.spheres, a.names):
            away = [math.dist(x, (0, 0, 0)) - radii[0], math.dist(x, (distance, 0, 0)) - radii[1]]
            self.assertEqual(sphere, 1 + (away[1] < away[0]) if abs(away[0] - away[1]) > 2e-3 else sphere)
            self.assertEqual(name, "AB"[sphere - 1])
            around = math.hypot(x[1], x[2])
            off_ring = math.hypot(x[0] - along, around - ring)
            if kind == CONTACT:
                self.assertAlmostEqual(away[sphere - 1], 0, delta=1.5e-3)
                self.assertGreaterEqual(off_ring, probe - 2e-3)
            elif ring > probe:
                self.assertAlmostEqual(off_ring, probe, delta=1.5e-3)
                to_ring = (along - x[0], (ring / around - 1) * x[1], (ring / around - 1) * x[2])
                self.assertLess(math.dist(to_ring, [probe * k for k in n]), 4e-3)
        for corners, kind in zip(a.triangles, a.triangle_kinds):
            kinds = {a.kinds[v] for v in corners}
            self.assertIn(kind, kinds)
        return sums, contact, toric

    def test_two_balls(self):
        sums, contact, toric = self.two(3.5, (1.7, 1.5), 1.5, 20)
        self.assertAlmostEqual(sums[0], 0)
        for found, exact in zip(sums[1:4], (toric, sum(contact), sum(contact) + toric)):
            self.assertAlmostEqual(found, exact, delta=2e-3)
        # The solvent-accessible area of each is that of its contact face, grown.
        for (ses, sas, _), own, radius in zip(self.areas(), contact, (1.7, 1.5)):
            self.assertAlmostEqual(sas, own * ((radius + 1.5) / radius) ** 2, delta=2e-3)
            self.assertTrue(own < ses < own + toric)

    def test_two_balls_that_only_the_probe_joins(self):
        sums, contact, toric = self.two(5.5, (1.5, 1.5), 1.5, 20)
        self.assertAlmostEqual(sums[3], sum(contact) + toric, delta=2e-3)

    def test_three_balls_hold_a_probe(self):
        centres = [(0, 0, 0), (4.0, 0, 0), (1.8, 3.6, 0)]
        self.write("three.xyzr", "".join(f"{x} {y} {z} 1.6\n" for x, y, z in centres))
        self.msms("-if", "three.xyzr", "-of", "a", "-density", 10, "-hdensity", 10)
        a = self.surface()
        # The two probes that touch all three.
        probe, grown = 1.5, 3.1
        x = 2.0
        y = (1.8 ** 2 + 3.6 ** 2 - 2 * 1.8 * x) / (2 * 3.6)
        z = math.sqrt(grown ** 2 - x * x - y * y)
        seen = 0
        for at, kind in zip(a.positions, a.kinds):
            near = min(math.dist(at, (x, y, z)), math.dist(at, (x, y, -z)))
            self.assertGreater(near, probe - 2e-3)
            if kind == SPHERICAL:
                self.assertAlmostEqual(near, probe, delta=1.5e-3)
                seen += 1
        self.assertGreater(seen, 10)
        self.assertIn(SPHERICAL, a.triangle_kinds)
        # Two faces of three balls each, three saddles, three contact faces.
        self.assertEqual(len(set(a.faces)), 8)


class Molecules(Msms):
    def crambin(self, name="1crn.xyzrn"):
        self.write(name, xyzrn(CRAMBIN))
        return name

    def test_the_call_of_masif(self):
        self.crambin()
        text = self.msms("-density", "3.0", "-hdensity", "3.0", "-probe", "1.5", "-if", "1crn.xyzrn",
                         "-of", "out", "-af", "out")
        self.assertEqual(self.names(), ["1crn.xyzrn", "out.area", "out.face", "out.vert"])
        atoms = xyzrn(CRAMBIN).splitlines()
        (sums,), _ = self.totals(text)
        areas = self.areas("out.area")
        self.assertEqual([name for *_, name in areas], [line.split()[-1] for line in atoms])
        for k in (0, 1):
            self.assertAlmostEqual(sum(area[k] for area in areas), sums[3 + k], delta=0.1)
        self.assertAlmostEqual(sum(sums[:3]), sums[3], delta=0.01)
        out = self.surface("out")
        self.assertTrue(out.closed())
        self.assertEqual(set(out.kinds), {TORIC, SPHERICAL, CONTACT})
        self.assertTrue(all(atoms[i - 1].split()[-1] == name for i, name in zip(out.spheres, out.names)))
        self.assertAlmostEqual(out.area(), sums[3], delta=0.02 * sums[3])
        # Every vertex is as far from its sphere as from the nearest one.
        balls = [tuple(map(float, line.split()[:4])) for line in atoms]
        for v in range(0, len(out.positions), 97):
            away = [math.dist(out.positions[v], ball[:3]) - ball[3] for ball in balls]
            self.assertLess(away[out.spheres[v] - 1], min(away) + 2e-3)
            self.assertGreater(min(away), -2e-3)
            if out.kinds[v] == CONTACT:
                self.assertAlmostEqual(min(away), 0, delta=2e-3)

    def test_excluded_areas_are_those_of_the_closed_form(self):
        self.crambin()
        self.check(0, "1crn.xyzrn", "--surface", "ses", "--probe", 1.5, "-o", "a.json")
        exact = json.loads((self.folder / "a.json").read_text())["surface"]
        for words, key in (((), "outer_area"), (("-all",), "area")):
            with self.subTest(words=words):
                sums, parts = self.totals(self.msms("-if", "1crn.xyzrn", "-af", "a", *words))
                total = sum(row[3] for row in sums)
                self.assertAlmostEqual(total, exact[key], delta=0.01)
                self.assertAlmostEqual(sum(area[0] for area in self.areas()), total, delta=0.2)
                self.assertAlmostEqual(sum(part[1] for part in parts), total, delta=6e-3 * total)

    def test_voids_that_no_probe_from_outside_gets_into(self):
        """Of BPTI the mesh joins some to the outer surface. The areas without them are those that MSMS 2.6.1 prints."""
        self.write("m.xyzrn", xyzrn(DATA / "bpti.pdb.gz"))
        self.check(0, "m.xyzrn", "--surface", "sas", "--probe", 1.5, "-o", "a.json")
        accessible = json.loads((self.folder / "a.json").read_text())["surface"]["area"]
        for words in ((), ("-all",)):
            sums, parts = self.totals(self.msms("-if", "m.xyzrn", "-of", "a", "-af", "a", *words))
            for found, row in zip(sums[0], (682.347, 1208.379, 1117.906, 3008.632, 3915.677)):
                self.assertAlmostEqual(found, row, delta=0.01)
            for k in (0, 1):
                total = sum(row[3 + k] for row in sums)
                self.assertAlmostEqual(sum(area[k] for area in self.areas()), total, delta=0.2)
            self.assertEqual(len(parts), 1)
            self.assertGreater(parts[0][1], sums[0][3] + 50.0)
            self.assertTrue(self.surface().closed())
        self.assertGreater(len(sums), 1)
        self.assertAlmostEqual(total, accessible, delta=0.01)

    def test_accessible_areas_are_exact(self):
        self.crambin()
        self.msms("-if", "1crn.xyzrn", "-af", "a", "-probe_radius", 1.4, "-all_components")
        self.check(0, "1crn.xyzrn", "--surface", "sas", "--voxel", 1, "-o", "a.json")
        exact = json.loads((self.folder / "a.json").read_text())["surface"]["area"]
        areas = self.areas()
        self.assertAlmostEqual(sum(area[1] for area in areas), exact, delta=0.2)
        # Of some atoms by points all over their spheres.
        balls = [tuple(map(float, line.split()[:4])) for line in xyzrn(CRAMBIN).splitlines()]
        for i in range(0, len(balls), 29):
            grown, free, count = balls[i][3] + 1.4, 0, 2000
            near = [(b[:3], (b[3] + 1.4) ** 2) for k, b in enumerate(balls)
                    if k != i and math.dist(b[:3], balls[i][:3]) < grown + b[3] + 1.4]
            for n in range(count):
                z, turn = 1 - (2 * n + 1) / count, 2.399963 * n
                r = math.sqrt(1 - z * z)
                at = [c + grown * u for c, u in zip(balls[i], (r * math.cos(turn), r * math.sin(turn), z))]
                free += all(sum((p - q) ** 2 for p, q in zip(at, c)) > square for c, square in near)
            self.assertAlmostEqual(areas[i][1], 4 * math.pi * grown ** 2 * free / count, delta=1.0)

    def test_density(self):
        for path in (CRAMBIN, DATA / "1ubq.pdb", DATA / "1a8o.pdb.gz"):
            self.write("m.xyzrn", xyzrn(path))
            for density in (0.5, 1, 3, 10):
                with self.subTest(path=path.name, density=density):
                    text = self.msms("-if", "m.xyzrn", "-of", "a", "-density", density)
                    a = self.surface()
                    self.assertTrue(a.closed())
                    ratio = len(a.positions) / (density * self.totals(text)[0][0][3])
                    self.assertAlmostEqual(ratio, 1, delta=0.02)

    def test_dry_run_says_what_it_takes(self):
        self.write("a", xyzrn(CRAMBIN))
        estimates = []
        for density in (1, 100):
            done = self.run_msms("-if", "a", "-of", "b", "-density", density, "--dry-run")
            self.assertEqual((done.returncode, done.stdout), (0, ""), done.stderr)
            line = re.fullmatch(r"vdb_molsurf_msms: about \S+ voxels, (\S+) MiB of memory at most, (\S+) s on one core\n",
                                done.stderr)
            estimates.append(tuple(map(float, line.groups())))
        self.assertEqual(self.names(), ["a"])
        self.assertGreater(min(estimates[0]), 0.03)
        self.assertTrue(all(a < b for a, b in zip(*estimates)), estimates)

    def test_components(self):
        self.write("4at1.xyzrn", xyzrn(DATA / "4at1.ent.gz"))
        alone = self.totals(self.msms("-if", "4at1.xyzrn", "-of", "a", "-af", "a", "-density", 5))
        self.assertEqual(len(alone[0]), 1)
        self.assertEqual(len([name for name in self.names() if name.startswith("a")]), 3)
        text = self.msms("-if", "4at1.xyzrn", "-of", "b", "-af", "b", "-all", "-density", 5)
        sums, parts = self.totals(text)
        count = len(parts)
        self.assertGreater(count, 10)
        self.assertEqual(sums[0], alone[0][0])
        self.assertEqual((self.folder / "a.vert").read_bytes(), (self.folder / "b.vert").read_bytes())
        expected = {f"b{'' if n == 0 else f'_{n}'}.{end}" for n in range(count) for end in ("vert", "face")}
        self.assertEqual({name for name in self.names() if name[0] == "b"}, expected | {"b.area"})
        self.assertEqual(re.findall(r"RS component (\d+) identified", text), [str(n) for n in range(1, count)])
        for n in (0, 1, 2, count - 1):
            part = self.surface("b" if n == 0 else f"b_{n}")
            self.assertTrue(part.closed())
            self.assertAlmostEqual(part.volume(), parts[n][0], delta=0.12 * abs(parts[n][0]))
            self.assertEqual(parts[n][0] < 0, n > 0)
        for k in (0, 1):
            self.assertAlmostEqual(sum(area[k] for area in self.areas("b.area")),
                                   sum(row[3 + k] for row in sums), delta=1.0)

    def test_the_same_bytes_again(self):
        self.crambin()
        for base in ("a", "b"):
            self.msms("-if", "1crn.xyzrn", "-of", base, "-af", base)
        for ending in (".vert", ".face", ".area"):
            self.assertEqual(*((self.folder / (base + ending)).read_bytes() for base in ("a", "b")))

    def test_names_tell_residues_everywhere(self):
        self.crambin("named.txt")
        self.assertRegex(self.check(0, "info", "named.txt").stdout.decode(), r"format +xyzrn\n")
        self.check(0, "named.txt", "--voxel", 1, "--select", "(ALA)", "-o", "a.json")
        report = json.loads((self.folder / "a.json").read_text())
        self.assertEqual(report["atoms"], 25)

    def test_depths_of_residues_are_those_of_the_table(self):
        """Mean distances from the vertices, as Biopython takes them, of molecules whose voids are apart."""
        for path in (DATA / "bpti.pdb.gz", DATA / "1ubq.pdb", DATA / "1a8o.pdb.gz"):
            self.write("m.xyzrn", xyzrn(path))
            self.msms("-if", "m.xyzrn", "-of", "a")
            self.check(0, "m.xyzrn", "--surface", "ses", "--probe", "1.5", "--fields", "depth", "-o", "m.atoms.csv", "--force")
            lines = (self.folder / "m.atoms.csv").read_text().splitlines()
            rows = list(csv.DictReader(line for line in lines if line[0] != "#"))
            vertices = self.surface().positions
            places = [tuple(map(float, line.split()[:3])) for line in (self.folder / "m.xyzrn").read_text().splitlines()]
            residues = {}
            for row, place in zip(rows, places, strict=True):
                over = min(math.dist(place, v) for v in vertices) - float(row["depth_A"])
                residues.setdefault((row["chain"], row["number"], row["residue"]), []).append(over)
            means = [sum(over) / len(over) for over in residues.values()]
            self.assertLess(max(map(abs, means)), 0.2, path)
            self.assertGreater(sum(means), 0)

    @needs("biopython")
    def test_residue_depth_of_biopython(self):
        from Bio.PDB import PDBParser
        from Bio.PDB.ResidueDepth import ResidueDepth, get_surface
        (self.folder / "msms").symlink_to(MSMS)
        with mock.patch.dict(os.environ, PATH=f"{self.folder}:{os.environ['PATH']}"):
            model = PDBParser(QUIET=True).get_structure("1crn", CRAMBIN)[0]
            depth = ResidueDepth(model)
            vertices = [tuple(map(float, row)) for row in get_surface(model)]
        self.assertGreater(len(vertices), 2000)
        self.assertEqual(len(depth), 46)
        for residue, (mean, alpha) in list(depth)[::5]:
            away = {atom.get_name(): min(math.dist(atom.coord, v) for v in vertices) for atom in residue}
            self.assertAlmostEqual(mean, sum(away.values()) / len(away), delta=1e-3)
            self.assertAlmostEqual(alpha, away["CA"], delta=1e-3)
            self.assertTrue(1.3 < mean < 8)


class Options(Msms):
    def setUp(self):
        super().setUp()
        self.write("two.xyzrn", "0 0 0 1.7 1 A\n3.5 0 0 1.5 1 B\n30 0 0 1.2 1 H_ALA_1\n")

    def test_defaults(self):
        text = self.msms("-if", "two.xyzrn", "-of", "a")
        self.assertIn("PARAM  Probe_radius  1.500 density  1.000 hdensity  3.000\n", text)
        self.assertIn("INPUT  two.xyzrn 3 spheres", text)
        self.assertTrue(text.startswith("MSMS 2.6"), text)
        self.assertTrue(self.surface().headers[0].endswith("       3  1.00  1.50"))

    def test_words_cut_short(self):
        for probe in ("-probe_radius", "-probe", "-p"):
            self.assertIn("Probe_radius  2.000", self.msms(probe, 2, "-i", "two.xyzrn", "-d", 2, "-al"))
        self.refuse(2, "-no_", "-if", "two.xyzrn", says=["-no_area", "-no_header", "write more"])
        self.refuse(2, "-a", "a", "-if", "two.xyzrn", says=["-af", "-all_components"])

    def test_no_header(self):
        self.msms("-if", "two.xyzrn", "-of", "a", "-no_header")
        a = self.surface(header=False)
        self.assertTrue(a.closed())

    def test_no_area(self):
        self.assertNotIn("ANALYTICAL", self.msms("-if", "two.xyzrn", "-no_area"))
        self.refuse(2, "-if", "two.xyzrn", "-no_area", "-af", "a", says="-no_area")

    def test_no_hydrogens(self):
        self.msms("-if", "two.xyzrn", "-af", "a", "-noh", "-all")
        self.assertEqual([area[0] > 0 for area in self.areas()], [True, True, False])

    def test_a_ball_apart_is_a_component(self):
        self.msms("-if", "two.xyzrn", "-of", "a", "-all")
        self.assertEqual(set(self.surface("a_1").spheres), {3})
        self.assertEqual(set(self.surface("a_1").names), {"H_ALA_1"})
        self.assertEqual(set(self.surface().spheres), {1, 2})

    def test_what_changes_nothing_is_said(self):
        self.msms("-if", "two.xyzrn", "-no_rest", "-no_rest_on_pbr", "-free_vertices", "-hdensity", 5,
                  "-surface", "tses",
                  warnings=["-no_rest ", "-no_rest_on_pbr ", "-free_vertices ", "-hdensity 5 "])
        self.msms("-if", "two.xyzrn", "-hdensity", 1)

    def test_wrong_calls(self):
        for words, says in (
                ([], "-if"), (["-if"], "-if: expected a value"), (["two.xyzrn"], '"two.xyzrn"'),
                (["-if", "two.xyzrn", "-bogus"], '"-bogus"'), (["-"], '"-"'),
                (["-if", "two.xyzrn", "-if", "two.xyzrn"], "again"),
                (["-if", "two.xyzrn", "-of", ""], "-of"),
                (["-if", "two.xyzrn", "-surface", "ases", "-of", "a"], ["tses", "ases"]),
                (["-if", "two.xyzrn", "-one_cavity", 1, 2], ["-one_cavity", "-all_components"]),
                (["-socketName", "x"], "-socketName"), (["-sinetd"], "-sinetd")):
            self.refuse(2, *words, says=says)
        for option, bad in (("-density", "x"), ("-density", "0"), ("-density", "0.05"), ("-density", "nan"),
                            ("-density", "401"), ("-probe_radius", "0.01"),
                            ("-hdensity", "-1"), ("-probe", "-0.1"), ("-probe", "1e3"), ("-probe", "1.5A")):
            self.refuse(2, "-if", "two.xyzrn", "-of", "a", option, bad, says=["expected a number", f'"{bad}"'])

    def test_files_that_cannot_be(self):
        self.refuse(1, "-if", "none.xyzr", "-of", "a", says=["none.xyzr", "No such file"])
        self.refuse(1, "-if", "two.xyzrn", "-of", "no/a", says=["no/a.vert", "No such file"])
        self.refuse(1, "-if", "two.xyzrn", "-of", "a", "-af", "no/a", says="no/a.area")
        (self.folder / "b.face").mkdir()
        self.refuse(1, "-if", "two.xyzrn", "-of", "b", says="b.face")
        self.write("bad.xyzr", "0 0 0 1.7\n1 2 x 1.5\n")
        self.refuse(1, "-if", "bad.xyzr", "-of", "a", says=["bad.xyzr", "line 2", "z: expected a number"])
        self.write("empty.xyzr", "# nothing\n")
        self.refuse(1, "-if", "empty.xyzr", "-of", "a", says="empty.xyzr")
        self.refuse(1, "-if", CRAMBIN, "-of", "a", says=["1crn.pdb", "line 1"])
        self.write("a.vert", "0 0 0 1.7\n")
        self.refuse(1, "-if", "a.vert", "-of", "a", says="a.vert")

    @needs("full")
    def test_full_standard_output(self):
        with open("/dev/full", "w") as full:
            done = self.run_msms("-if", "two.xyzrn", "-of", "a", capture_output=False, stdout=full,
                                 stderr=subprocess.PIPE)
        self.assertEqual(done.returncode, 75)
        self.assertIn("standard output", done.stderr)
        self.assertEqual(self.names(), ["two.xyzrn"])

    def test_files_are_replaced(self):
        for ending in (".vert", ".face", ".area"):
            self.write("a" + ending, "old")
        self.msms("-if", "two.xyzrn", "-of", "a", "-af", "a")
        self.assertTrue(self.surface().closed())
        self.assertEqual(len(self.areas()), 3)

    def test_spheres_after_msms(self):
        """Only the first four columns count, and the name, whatever the columns between are."""
        self.write("odd.xyzr", "0 0 0 1.7 7\n3.5 0 0 1.5 7 8\n")
        self.msms("-if", "odd.xyzr", "-of", "a")
        self.assertEqual(set(self.surface().spheres), {1, 2})

    def test_help(self):
        for word in ("-h", "-help", "--help"):
            done = self.run_msms(word)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertIn("-probe_radius", done.stdout)
        page = self.run_msms("--man").stdout
        self.assertEqual(page, (ROOT / "docs/man/vdb_molsurf_msms.1").read_text())
        self.assertIn("\\fB\\-all_components\\fR", page)
        self.assertRegex(self.run_msms("--version").stdout, r"^vdb_molsurf_msms \d")


if __name__ == "__main__":
    unittest.main()
