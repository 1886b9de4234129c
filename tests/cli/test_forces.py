# SPDX-License-Identifier: MPL-2.0
""".forces.csv: the derivatives of area and volume by the places of atoms."""

import json
import math
import unittest

from tool import CRAMBIN, DATA, ToolTest

BALLS = [(0, 0, 0, 1.7), (2.25, 0.5, 0.25, 1.5), (1.0, 2.5, -0.5, 1.625), (-1.0, 1.5, 2.0, 1.25), (3.5, 2.0, 1.5, 1.75), (0.5, 4.5, 1.5, 1.5)]


def text(balls):
    return "".join("%.6f %.6f %.6f %g\n" % ball for ball in balls)


class Forces(ToolTest):
    def measure(self, balls, *words):
        (self.folder / "m.xyzr").write_text(text(balls))
        self.check(0, "m.xyzr", *words, "-o", "m.json", "--force", "-q")
        surface = json.loads((self.folder / "m.json").read_text())["surface"]
        return surface["area"], surface["volume"]

    def test_they_are_differences(self):
        (self.folder / "a.xyzr").write_text(text(BALLS))
        for kind in ("vdw", "sas", "ses"):
            with self.subTest(kind):
                self.check(0, "a.xyzr", "--surface", kind, "-o", "a.forces.csv", "--force")
                rows = self.table("a.forces.csv")
                self.assertEqual(len(rows), len(BALLS))
                for ball, axis in ((0, 0), (2, 1), (4, 2)):
                    sides = []
                    for step in (0.001, -0.001):
                        moved = [list(b) for b in BALLS]
                        moved[ball][axis] += step
                        sides.append(self.measure([tuple(b) for b in moved], "--surface", kind))
                    for k, column in enumerate(("dA_d%s_A", "dV_d%s_A2")):
                        difference = (sides[0][k] - sides[1][k]) / 0.002
                        self.assertAlmostEqual(float(rows[ball][column % "xyz"[axis]]), difference, delta=2e-3)
                    self.assertEqual((rows[ball]["surface"], rows[ball]["atom_id"]), (kind, str(ball)))

    def test_those_of_smooth_surfaces_are_differences(self):
        (self.folder / "a.xyzr").write_text(text(BALLS))
        words = ["--surface", "variational", "--voxel", 0.25]
        self.check(0, "a.xyzr", *words, "-o", "a.forces.csv", "-o", "a.ply")
        rows = self.table("a.forces.csv")
        for ball, axis in ((0, 0), (2, 1), (4, 2)):
            sides = []
            for step in (0.05, -0.05):
                moved = [list(b) for b in BALLS]
                moved[ball][axis] += step
                sides.append(self.measure([tuple(b) for b in moved], *words))
            for k, column in enumerate(("dA_d%s_A", "dV_d%s_A2")):
                difference = (sides[0][k] - sides[1][k]) / 0.1
                self.assertAlmostEqual(float(rows[ball][column % "xyz"[axis]]), difference, delta=0.03)

    def test_they_add_up_to_nothing(self):
        for name, words in ("sas", []), ("ses", ["--surface", "ses"]), ("variational", ["--surface", "variational", "--voxel", 1]):
            self.check(0, CRAMBIN, *words, "-o", "a.forces.csv", "-o", "a.json", "--areas", "forces", "--force")
            rows = self.table("a.forces.csv")
            self.assertEqual((len(rows), rows[0]["surface"], rows[0]["atom"], rows[0]["residue"]), (327, name, "N", "THR"))
            for columns in ("dA_dx_A", "dA_dy_A", "dA_dz_A"), ("dV_dx_A2", "dV_dy_A2", "dV_dz_A2"):
                vectors = [[float(row[c]) for c in columns] for row in rows]
                lengths = sum(math.hypot(*v) for v in vectors)
                self.assertGreater(lengths, 100)
                self.assertLess(math.hypot(*map(sum, zip(*vectors))), 1e-7 * lengths)
            table = json.loads((self.folder / "a.json").read_text())["areas"]["forces"]
            self.assertEqual([float(row["dA_dx_A"]) for row in rows], [row["dA_dx_A"] for row in table])

    def test_wrong_calls(self):
        for words in (["--surface", "gaussian"], ["--surface", "variational", "--lambda", 0.1], ["--surface", "variational", "--flow", "paper"],
                      ["--surface", "variational", "--steps", 3], ["--min-thickness", 2, "--print-scale", 0.5], ["--fill-cavities"],
                      ["--by-symmetry", "--assembly", 1, "--surface", "sas"], ["--split", "group", "--group-by", "chain"],
                      ["--coarse", "residue"]):
            with self.subTest(words):
                self.check(2, DATA / "1a8o.cif.gz", *words, "-o", "a.forces.csv", says="forces")
                self.check(2, DATA / "1a8o.cif.gz", *words, "-o", "a.json", "--areas", "forces", says="areas")
        self.check(2, CRAMBIN, "-o", "a.forces.json", says="-o FILE.forces.csv")
        self.assertEqual(self.names(), [])


if __name__ == "__main__":
    unittest.main()
