# SPDX-License-Identifier: MPL-2.0
"""--panel: several structures or views in one picture, with one camera, scale and legend."""

import unittest

from tool import DATA, ToolTest, read_png

ATOM = "HETATM{0:5}  C   XXX {1}{0:4}    {2:8.3f}{3:8.3f}   0.000  1.00{4:6.2f}           C\n"


class Panels(ToolTest):
    def rod(self, name, length, x=0.0, b=20.0, chain="A"):
        """Balls in a row along x, a few Å of it upright, with B factors from 10 on."""
        atoms = [(x + n, 0.0) for n in range(length + 1)] + [(x, 3.0)]
        (self.folder / name).write_text("".join(
            ATOM.format(i, chain, *place, 10.0 if i == 1 else b) for i, place in enumerate(atoms, 1)))

    def picture(self, *words, width=None):
        self.check(0, *words, "--surface", "vdw", "--voxel", "0.5", "--style", "flat", "-o", "a.png", "--force", "-q")
        found, rows = read_png((self.folder / "a.png").read_bytes())
        self.assertEqual(found, width or found)
        return [[tuple(row[3 * x:3 * x + 3]) for x in range(found)] for row in rows]

    def runs(self, rows):
        """Where columns are not white, as (first, last); letters are not so wide."""
        width = len(rows[0])
        filled = [any(row[x] != (255, 255, 255) for row in rows) for x in range(width)]
        runs, first = [], None
        for x, here in enumerate(filled + [False]):
            if here and first is None:
                first = x
            if not here and first is not None:
                runs.append((first, x - 1))
                first = None
        return runs

    def test_three_structures(self):
        """They have one scale and each the middle of its panel, wherever they are."""
        for name, length, x in (("a.pdb", 20, 0), ("b.pdb", 10, 500), ("c.pdb", 5, -80)):
            self.rod(name, length, x)
        rows = self.picture("a.pdb", "--panel", "b.pdb", "--panel", "c.pdb", "--view", "0,0,1", "--size", 600, "--legend", "off", width=600)
        runs = self.runs(rows)
        self.assertEqual(len(runs), 3)
        widths = [b - a + 1 for a, b in runs]
        scale = (widths[0] - widths[1]) / 10  # pixels an Å
        self.assertAlmostEqual((widths[1] - widths[2]) / 5, scale, delta=0.5)
        self.assertAlmostEqual(widths[0] / scale, 20 + 3.4, delta=0.7)
        for n, (a, b) in enumerate(runs):
            self.assertAlmostEqual((a + b) / 2, 100 + 200 * n, delta=3)
        # A view keeps the place: the two others are not in it.
        self.check(0, "a.pdb", "-o", "a.view", "--view", "0,0,1")
        rows = self.picture("a.pdb", "--panel", "b.pdb", "--panel", "c.pdb", "--view", "a.view", "--size", 600, "--legend", "off")
        self.assertEqual(len(self.runs(rows)), 1)

    def test_panels_turn_with_the_first(self):
        """On a turntable a rod of each panel is seen along after a quarter of a turn."""
        for name in ("a.pdb", "b.pdb"):
            self.rod(name, 16)
        self.check(0, "a.pdb", "--panel", "b.pdb", "--view", "0,0,1", "--surface", "vdw", "--voxel", "0.5", "--size", 400, "--legend", "off",
                   "--turntable", 4, "-o", "t.png", "-q")
        widths = []
        for number in (1, 2):
            found, rows = read_png((self.folder / f"t.{number:04}.png").read_bytes())
            runs = self.runs([[tuple(row[3 * x:3 * x + 3]) for x in range(found)] for row in rows])
            self.assertEqual(len(runs), 2)
            widths.append([b - a for a, b in runs])
        for n in (0, 1):
            self.assertLess(widths[1][n], 0.5 * widths[0][n])

    def test_one_legend(self):
        """Colours of values are those of the first; each name of a list is in it once."""
        self.rod("a.pdb", 8, b=20.0)
        self.rod("b.pdb", 8, b=60.0)
        rows = self.picture("a.pdb", "--panel", "b.pdb", "--view", "0,0,1", "--size", 700, "--color", "bfactor", "--flat-values", "--palette", "viridis")
        left, right = self.runs(rows)[:2]
        middle = max(range(len(rows)), key=lambda y: sum(p != (255, 255, 255) for p in rows[y][:left[1]]))
        self.assertEqual(rows[middle][left[1] - 12], rows[middle][right[1] - 12])  # 20 and more have the last colour
        self.rod("c.pdb", 8, chain="B")
        rows = self.picture("a.pdb", "--panel", "c.pdb", "--panel", "b.pdb", "--view", "0,0,1", "--size", 700, "--color", "chain")
        blue = [[row[x] == (86, 180, 233) for row in rows] for x in range(645, 700)]
        column = max(blue, key=sum)  # through the patches of A and B, each the first chain of its file
        self.assertEqual(sum(here and not before for here, before in zip(column, [False, *column])), 2)

    def test_chains_of_all(self):
        rows = self.picture(DATA / "4at1.ent.gz", "--select", "A|B", "--panel", DATA / "1crn.pdb", "--size", 600, "--color", "chain")
        legend = [pixel for row in rows for pixel in row[520:]]
        for color in ((86, 180, 233), (230, 159, 0)):
            self.assertIn(color, legend)

    def test_views_and_atoms(self):
        """Other sides of the same, and atoms that not all of them have."""
        self.rod("a.pdb", 16)
        rows = self.picture("a.pdb", "--panel", "1,0,0", "--panel", "0,1,0", "--view", "0,0,1", "--size", 600, "--legend", "off")
        widths = [b - a for a, b in self.runs(rows)]
        self.assertAlmostEqual(widths[0], widths[2], delta=3)
        self.assertLess(widths[1], 0.5 * widths[0])
        self.check(0, DATA / "4at1.ent.gz", "--panel", DATA / "1ubq.pdb", "--voxel", 2, "--show", "(ZN)=spheres", "--label", "B/(ZN)=zinc",
                   "--size", 300, "-o", "b.png", says="1ubq.pdb: PDB")
        self.check(0, DATA / "4at1.ent.gz", "--panel", DATA / "1ubq.pdb", "--voxel", 2, "--view", "B/(ZN)", "--size", 300, "-o", "c.png")

    def test_notes_are_of_the_atoms_of_each(self):
        self.rod("a.pdb", 16)
        self.rod("b.pdb", 16, chain="B")
        words = ["a.pdb", "--panel", "b.pdb", "--view", "0,0,1", "--size", 600, "--legend", "off"]
        plain, named = self.picture(*words), self.picture(*words, "--label", "A/1=here")
        halves = [[[row[side:side + 300] for row in rows] for rows in (plain, named)] for side in (0, 300)]
        self.assertNotEqual(*halves[0])
        self.assertEqual(*halves[1])

    def test_analyses_of_the_first_alone(self):
        """What the first structure is asked for beside its picture is no matter of the panel, which may not have it."""
        more = ["--panel", DATA / "1crn.pdb", "--size", 100, "-o", "a.png", "--force"]
        self.check(0, DATA / "1grm.pdb.gz", "--surface", "vdw", "--voxel", 1, "--pore", "auto", "-o", "a.pore.csv", *more)
        self.check(0, DATA / "1ubq.pdb", "--pocket-at", "resid 60", "--pocket-cut", 0, "--surface", "ses", "--voxel", 0.7,
                   "--color", "pocket", "-o", "a.pockets.csv", *more)
        self.check(0, DATA / "1d3z.pdb.gz", "--model", 2, "--surface", "vdw", "--voxel", 1, "--interfaces", "--group-by", "chain", "--pockets",
                   "--fields", "spline,pocket_depth", "-o", "a.vdb", *more, says="1crn.pdb: PDB")

    def test_kinds_of_surfaces(self):
        """The same atoms with another surface, in the same place and scale; options of either are no mistake."""
        self.rod("a.pdb", 16)
        words = ["a.pdb", "--panel", "vdw", "--view", "0,0,1", "--size", 600, "--legend", "off", "-q", "-o", "a.png", "--force"]
        self.check(0, *words, "--surface", "sas", "--voxel", "0.5", "--style", "flat")
        found, rows = read_png((self.folder / "a.png").read_bytes())
        left, right = self.runs([[tuple(row[3 * x:3 * x + 3]) for x in range(found)] for row in rows])
        scale = (left[1] - left[0] - right[1] + right[0]) / 2.8  # pixels an Å: the probe, on both sides
        self.assertAlmostEqual((right[1] - right[0]) / scale, 16 + 3.4, delta=0.7)
        self.assertAlmostEqual(sum(left) / 2 + 300, sum(right) / 2, delta=2)
        said = self.check(0, "a.pdb", "--panel", "variational", "--surface", "ses", "--lambda", "0.015", "--voxel", "0.7",
                          "-o", "a.png", "--force").stderr.decode()
        self.assertNotIn("--lambda is for", said)
        self.check(2, "a.pdb", "--panel", "variational", "--surface", "ses", "--lambda=-1", "-o", "b.png", says="lambda")
        (self.folder / "ses").write_bytes((self.folder / "a.pdb").read_bytes())  # a word, and no file
        self.check(0, "a.pdb", "--panel", "./ses", "--voxel", "1", "-o", "a.png", "--force", says="ses: PDB")

    def test_a_panel_that_is_not_at_rest(self):
        """Its picture is written, with the status that it has as a picture by itself."""
        self.rod("a.pdb", 6)
        self.rod("b.pdb", 6)
        words = ["--voxel", "0.7", "--flow", "newton", "--lambda", "0.03", "--max-steps", "1", "-o", "a.png", "--force"]
        self.check(3, "b.pdb", *words, says="not converged")
        said = self.check(3, "a.pdb", "--surface", "ses", "--panel", "variational", *words, says="variational: not converged")
        self.assertEqual(said.stderr.decode().count("not converged"), 1)
        self.assertIn("a.png", self.names())

    def test_refused(self):
        self.rod("a.pdb", 4)
        words = ["a.pdb", "--surface", "vdw", "--voxel", 1, "-o", "a.png"]
        for more, status, says in ((["--panel", "0,0,0"], 2, "a file or a direction"), (["--panel", "none.pdb"], 1, "none.pdb"),
                                   (["--panel", "a.pdb", "--center"], 2, "together"),
                                   (["--panel", "a.pdb", "--frames", "all"], 2, "together")):
            self.check(status, *words, *more, says=says)
        # A file that is not there is found before any work: nothing was read.
        said = self.check(1, *words, "--panel", "none.pdb").stderr.decode()
        self.assertNotIn("used 6 atoms", said)
        (self.folder / "far.pdb").write_text("HETATM    1  C   XXX A   1     nowhere\n")
        self.check(1, *words, "--panel", "far.pdb", says="far.pdb")
        self.rod("b.png", 4)
        self.check(1, *words[:-1], "b.png", "--panel", "b.png", "--force", says="which is read")
        self.assertEqual([n for n in self.names() if n == "a.png"], [])


if __name__ == "__main__":
    unittest.main()
