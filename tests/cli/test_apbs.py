# SPDX-License-Identifier: MPL-2.0
"""Maps, charges and input for APBS: --for apbs, --match ses."""

import math
import re
import subprocess
import unittest

from needs import needs
from tool import CRAMBIN, TOOL, ToolTest

NAMES = ["apbs.in", "ion.charges.pqr", "ion.dielx.dx", "ion.diely.dx", "ion.dielz.dx", "ion.kappa.dx"]


def pqr(atoms):
    """Lines of atoms (x, y, z, charge, radius)."""
    return "".join(f"ATOM  {n:5d}  C   ION  {n:4d}    {x:8.3f}{y:8.3f}{z:8.3f} {q:.3f} {r:.3f}\n"
                   for n, (x, y, z, q, r) in enumerate(atoms, 1))


class Map:
    """An OpenDX file along the axes."""

    def __init__(self, path):
        lines = path.read_text().splitlines()
        number = lambda line: [float(word) for word in line.split() if re.fullmatch(r"[-+.\de]+", word)]
        self.counts = [int(n) for n in next(l for l in lines if "gridpositions" in l).split()[-3:]]
        self.origin = number(next(l for l in lines if l.startswith("origin")))
        self.step = [max(number(l)) for l in lines if l.startswith("delta")]
        first = next(n for n, l in enumerate(lines) if "data follows" in l) + 1
        words = " ".join(lines[first:]).split("attribute")[0].split()
        self.values = [float(word) for word in words]

    def points(self):
        """Each place with its value."""
        n = 0
        for i in range(self.counts[0]):
            for j in range(self.counts[1]):
                for k in range(self.counts[2]):
                    yield [o + s * m for o, s, m in zip(self.origin, self.step, (i, j, k))], self.values[n]
                    n += 1


def inside(begin, end, centre, radius):
    """The share of a segment that lies in a ball."""
    d = [b - a for a, b in zip(begin, end)]
    m = [a - c for a, c in zip(begin, centre)]
    a = sum(x * x for x in d)
    b = sum(x * y for x, y in zip(d, m))
    root = b * b - a * (sum(x * x for x in m) - radius * radius)
    if root <= 0:
        return 0.0
    low, high = (-b - math.sqrt(root)) / a, (-b + math.sqrt(root)) / a
    return max(0.0, min(1.0, high) - max(0.0, low))


class Apbs(ToolTest):
    def test_names_write_no_lines(self):
        """Of a structure whose name holds ends of lines and comments."""
        run = self.folder_of([(0.0, 0.0, 0.0, 1.0, 2.0)], "--voxel", 1, name="x\nquit\ny #1 %.pqr")
        text = (run / "apbs.in").read_text()
        self.assertEqual(text.splitlines().count("quit"), 1)
        self.assertIn("mol pqr run/x_quit_y__1__.charges.pqr\n", text)
        for folder in ("a#b/", "a%b/", "a\nb/"):
            self.check(2, "x\nquit\ny #1 %.pqr", "--for", "apbs", "-o", folder, says="APBS reads no names with spaces, quotes, # or %")

    def folder_of(self, atoms, *words, name="ion.pqr"):
        (self.folder / name).write_text(pqr(atoms))
        self.check(0, name, "--for", "apbs", "-o", "run/", "--force", *words)
        return self.folder / "run"

    def grid(self, points, length, center="0 0 0"):
        (self.folder / "grid.in").write_text(f"# as of a user\ndime {points}\nglen {length}  # A\ngcent {center}\n")
        return "--apbs-grid", "grid.in"

    def test_maps_of_a_ball(self):
        """The dielectric of each edge is that of the share of it in the ball, kappa that of the ball and an ion."""
        centre, radius = [0.1, 0.2, -0.3], 3.0
        run = self.folder_of([(*centre, 1.0, radius)], "--pdie", 4, "--sdie", 60, *self.grid("33 41 33", "16 20 24"))
        self.assertEqual(sorted(p.name for p in run.iterdir()), NAMES)
        for axis, name in enumerate("xyz"):
            found = Map(run / f"ion.diel{name}.dx")
            self.assertEqual(found.counts, [33, 41, 33])
            self.assertEqual(found.step, [0.5, 0.5, 0.75])
            cut = 0
            for middle, value in found.points():
                begin, end = list(middle), list(middle)
                begin[axis] -= found.step[axis] / 2
                end[axis] += found.step[axis] / 2
                share = inside(begin, end, centre, radius)
                got = (1 / value - 1 / 60) / (1 / 4 - 1 / 60)
                self.assertAlmostEqual(got, share, delta=0.01, msg=(name, middle))
                cut += 0 < share < 1
            self.assertGreater(cut, 100)
        kappa = Map(run / "ion.kappa.dx")
        self.assertEqual(kappa.origin, [-8.0, -10.0, -12.0])
        for place, value in kappa.points():
            away = math.dist(place, centre) - radius - 2.0
            if abs(away) > 1e-9:
                self.assertEqual(value, float(away > 0), place)

    def test_an_edge_through_a_thin_part_is_cut(self):
        """Both ends of an edge lie outside of a ball that it passes through."""
        run = self.folder_of([(0.5, 0.0, 0.0, 1.0, 0.9), (9.0, 0.0, 0.0, 0.0, 2.0)], "--voxel", 0.1, "--pdie", 2, "--sdie", 80,
                             *self.grid("17 17 17", "48 48 48"))
        at = {tuple(round(x, 6) for x in place): value for place, value in Map(run / "ion.dielx.dx").points()}
        share = 1.8 / 3.0 - (0.4 / 3.0)  # of the edge from 0 to 3: the ball is cut off at 0
        self.assertAlmostEqual((1 / at[(1.5, 0.0, 0.0)] - 1 / 80) / (1 / 2 - 1 / 80), share, delta=0.01)

    def test_a_short_piece_of_an_edge_counts(self):
        """An edge of 3 A that a ball cuts over less than 0.4 A."""
        run = self.folder_of([(1.5, 0.88, 0.0, 1.0, 0.9), (9.0, 0.0, 0.0, 0.0, 2.0)], "--voxel", 0.1, "--pdie", 2, "--sdie", 80,
                             *self.grid("17 17 17", "48 48 48"))
        at = {tuple(round(x, 6) for x in place): value for place, value in Map(run / "ion.dielx.dx").points()}
        share = 2 * math.sqrt(0.9**2 - 0.88**2) / 3.0
        self.assertAlmostEqual((1 / at[(1.5, 0.0, 0.0)] - 1 / 80) / (1 / 2 - 1 / 80), share, delta=0.01)

    def test_the_middle_of_the_molecule_is_that_of_its_atoms(self):
        run = self.folder_of([(0, 0, 0, 1, 3), (10, 0, 0, 1, 1)], *self.grid("33 33 33", "48 48 48", "mol 1"))
        self.assertIn("gcent 5 0 0\n", (run / "apbs.in").read_text())

    def test_the_lattice_is_of_the_first_calculation_and_its_last_words(self):
        """As APBS takes them."""
        (self.folder / "two.in").write_text("elec\ndime 33 33 33\nglen 20 20 20\ngcent mol 1\ngcent 1 2 3\nend\n"
                                            "elec\ndime 65 65 65\nglen 40 40 40\ngcent mol 1\nend\n")
        run = self.folder_of([(0, 0, 0, 1, 3)], "--apbs-grid", "two.in")
        text = (run / "apbs.in").read_text()
        for line in ("dime 33 33 33\n", "glen 20 20 20\n", "gcent 1 2 3\n"):
            self.assertIn(line, text)

    def test_charges_without_a_radius_come_along(self):
        run = self.folder_of([(0, 0, 0, -0.5, 1.7), (1, 0, 0, 0.5, 0.0)])
        rows = [line.split() for line in (run / "ion.charges.pqr").read_text().splitlines() if line.startswith("ATOM")]
        self.assertEqual([row[-2:] for row in rows], [["-0.5", "1.7"], ["0.5", "0"]])
        self.assertEqual([float(x) for x in rows[1][5:8]], [1, 0, 0])

    def test_more_than_65_points_are_32_c_and_1(self):
        for points in (97, 129):
            run = self.folder_of([(0, 0, 0, 1.0, 3.0)], "--voxel", 2, *self.grid(f"{points} 33 9", "96 32 8"))
            self.assertIn(f"dime {points} 33 9\n", (run / "apbs.in").read_text())

    def test_the_lattice_by_psize(self):
        """pdb2pqr's rule: 1.7 times the box, or 20 A more; points 0.5 A apart, 32 c + 1 of them."""
        self.folder_of([(0, 0, 0, 1, 2), (36, 0, 0, 1, 2), (0, 12, 0, 1, 2)])
        text = (self.folder / "run" / "apbs.in").read_text()
        self.assertIn("dime 129 65 33\n", text)  # of 60, 27.2 and 6.8 A
        self.assertIn("glen 60 27.2 6.8\n", text)
        self.assertIn("gcent 18 6 0\n", text)
        self.assertIn("pdie 2\n", text)
        self.assertIn("sdie 78.54\n", text)
        self.assertNotIn("ion charge", text)
        self.folder_of([(0, 0, 0, 1, 2)], "--ion-conc", 0.15)
        text = (self.folder / "run" / "apbs.in").read_text()
        self.assertIn("ion charge -1 conc 0.15 radius 2\n", text)
        self.assertIn("usemap kappa 1\n", text)

    def test_a_large_lattice_is_as_fine_along_all_axes(self):
        """At most 400 MB of 200 bytes a point, and no axis far finer than another."""
        self.folder_of([(0, 0, 0, 1, 2), (90, 0, 0, 1, 2), (0, 60, 0, 1, 2), (0, 0, 50, 1, 2)], "--voxel", 2)
        text = (self.folder / "run" / "apbs.in").read_text()
        points = [int(n) for n in re.search(r"dime (.*)", text)[1].split()]
        lengths = [float(x) for x in re.search(r"glen (.*)", text)[1].split()]
        self.assertLess(200 * math.prod(points), 400 << 20)
        self.assertGreater(200 * math.prod(points), 200 << 20)
        steps = [x / (n - 1) for x, n in zip(lengths, points)]
        self.assertLess(max(steps) / min(steps), 1.4)

    def test_the_surface(self):
        """ses unless another one is asked for; others are warned of, but for the matched one."""
        atoms = [(0, 0, 0, 1, 2), (3, 0, 0, -1, 2)]
        (self.folder / "ion.pqr").write_text(pqr(atoms))
        words = ["ion.pqr", "--for", "apbs", "-o", "run/", "--force"]
        said = self.check(0, *words).stderr.decode()
        self.assertIn("ses", said)
        self.assertNotIn("warning", said)
        self.assertIn("to go on: apbs run/apbs.in", said)
        for kind in ("vdw", "variational", "gaussian"):
            self.assertIn("its energy is another one", self.check(0, *words, "--surface", kind).stderr.decode())
        said = self.check(0, *words, "--match", "ses").stderr.decode()
        self.assertIn("variational", said)
        self.assertNotIn("warning", said)

    def test_what_is_refused_leaves_nothing(self):
        (self.folder / "ion.pqr").write_text(pqr([(0, 0, 0, 1, 2)]))
        words = ["ion.pqr", "--for", "apbs", "-o", "run/"]
        self.check(1, CRAMBIN, *words[1:], says="it has no charges and radii, expected those of a .pqr file")
        self.check(1, *words, *self.grid("33 33 33", "3 16 16"), says="the grid is too small for the molecule")
        for points in (5, 34, 37, 69, 81):  # APBS changes them, or does not end
            self.check(1, *words, *self.grid(f"{points} 33 33", "16 16 16"), says="grid.in, line 2: expected dime 8c+1 up to 65")
        self.check(1, *words, *self.grid("33 33 33", "16 16"), says="line 3: expected three numbers behind glen")
        self.check(1, *words, *self.grid("33 33 33", "16 16 nan"), says="line 3: expected three numbers behind glen")
        (self.folder / "grid.in").write_text("dime 33 33 33\n")
        self.check(1, *words, "--apbs-grid", "grid.in", says="expected dime, glen and gcent, got no glen")
        self.check(1, *words, "--apbs-grid", "none.in", says="none.in: cannot be opened")
        for name in ("pdie", "sdie"):
            self.check(2, *words, f"--{name}", 0, says=f"--{name}")
        self.check(2, *words, "--ion-conc", -1, says="--ion-conc")
        self.check(2, *words[:3], "-o", "a.ply", says="expected a folder")
        for name in ("a.apbs.in", "a.dielx.dx", "a.charges.pqr"):
            self.check(2, "ion.pqr", "-o", name, says="expected a folder for the files of APBS")
        self.check(1, *words[:3], "-o", "deep/er/run/", *self.grid("33 33 33", "3 16 16"), says="too small")
        self.check(2, *words[:3], "-o", "my run/", says="names with spaces")
        self.check(2, *words, "--frames", "1", says="--frames")
        self.check(2, *words, "--match", "ses", "--epsilon", 0.5, says="--epsilon")
        self.check(2, *words, "--match", "ses", "--voxel", 0.6, says="at most 0.5")
        self.assertEqual(self.names(), ["grid.in", "ion.pqr"])

    def test_a_matched_surface_lies_further_inside(self):
        """The same as its three parameters, on voxels where the spline does not matter."""
        volumes = []
        for words in (["--match", "ses"], ["--epsilon", 0.1, "--lambda", 0.003]):
            said = self.check(0, CRAMBIN, *words, "--voxel", 0.5, "-o", "a.ply", "--force").stderr.decode()
            volumes.append([float(x) for x in re.search(r"area ([\d.]+).*volume ([\d.]+)", said).groups()])
        (area, volume), (wide, full) = volumes
        self.assertAlmostEqual((full - volume) / (0.5 * (area + wide)), 0.073, delta=0.003)

    @needs("apbs")
    def test_the_energy_of_an_ion(self):
        """Born's, -0.5 (1 - 1/80) 1389.35/3 kJ/mol for a radius of 3 A: within 0.35 % at 0.5 A."""
        for centre in ((0.0, 0.0, 0.0), (0.13, 0.41, 0.27)):
            self.folder_of([(*centre, 1.0, 3.0)], "--pdie", 1, "--sdie", 80, *self.grid("33 33 33", "16 16 16"))
            done = subprocess.run(["apbs", "run/apbs.in"], cwd=self.folder, capture_output=True, text=True, check=True)
            energy = float(re.search(r"Global net ELEC energy = (\S+)", done.stdout)[1])
            self.assertAlmostEqual(energy / -228.66, 1.0, delta=0.0035)

    @needs("apbs")
    def test_salt(self):
        """Debye and Hueckel: an ion of 3 A, others not nearer than 5 A: -0.5 (1/sdie) q^2 kappa/(1 + kappa 5)."""
        energies = []
        for words in ([], ["--ion-conc", 0.15]):
            self.folder_of([(0, 0, 0, 1.0, 3.0)], "--pdie", 1, "--sdie", 80, *words, *self.grid("65 65 65", "64 64 64"))
            done = subprocess.run(["apbs", "run/apbs.in"], cwd=self.folder, capture_output=True, text=True, check=True)
            energies.append(float(re.search(r"Global net ELEC energy = (\S+)", done.stdout)[1]))
        kappa = math.sqrt(8 * math.pi * 0.15 * 6.02214e-4 * 167100.8 / (80 * 298.15))  # e^2/(4 pi eps0 k) = 167100.8 A K
        expected = -0.5 * 1389.35 / 80 * kappa / (1 + 5 * kappa)
        self.assertAlmostEqual((energies[1] - energies[0]) / expected, 1.0, delta=0.05)


if __name__ == "__main__":
    unittest.main()
