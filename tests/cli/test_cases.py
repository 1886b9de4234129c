# SPDX-License-Identifier: MPL-2.0
"""Small files of many programs, and what they hold: tests/data/cases/expected.json. Expected values are
those of FreeSASA, chemfiles, gemmi 0.7.5 and MDAnalysis, or of the same atoms in another format."""

import csv
import json
import unittest
from collections import Counter

from tool import DATA, ToolTest

FOLDER = DATA / "cases"
AREA = 0.15  # that two programs may differ by [Å²]


class Cases(ToolTest):
    def run_case(self, file, out, args):
        return self.run_tool(FOLDER / file, "--surface", "sas", "-o", out, "--force", "--no-progress", *args)

    def report(self, file, args):
        """(atoms, area), or the error."""
        done = self.run_case(file, "x.json", args)
        if done.returncode != 0:
            return done.stderr.decode()
        report = json.loads((self.folder / "x.json").read_text())
        return report["atoms"], report["surface"]["area"]

    def rows(self, file, kind, args):
        done = self.run_case(file, f"x.{kind}.csv", args)
        self.assertEqual(done.returncode, 0, done.stderr.decode())
        rows = self.table(f"x.{kind}.csv")
        return sorted(rows, key=lambda row: int(row["atom_id"])) if kind == "atoms" else rows

    def is_one_of(self, got, wanted):
        return any(got[0] == want[0] and (len(want) < 2 or abs(got[1] - want[1]) < AREA) for want in wanted
                   if not isinstance(got, str))

    def try_atoms(self, case, args):
        got = self.report(case["file"], args)
        self.assertTrue(self.is_one_of(got, [case["expect"]]), got)

    def try_one_of(self, case, args):
        got = self.report(case["file"], args)
        self.assertTrue(self.is_one_of(got, case["expect"]), got)

    def try_elements(self, case, args):
        rows = self.rows(case["file"], "atoms", args)
        self.assertEqual(" ".join(row["element"] for row in rows), case["expect"])

    def try_radii(self, case, args):
        rows = self.rows(case["file"], "atoms", args)
        self.assertEqual(" ".join(row["radius_A"] for row in rows), case["expect"])

    def try_residues(self, case, args):
        rows = self.rows(case["file"], "residues", args)
        names = ["/".join((row["chain"], row["residue"], row["number"])) for row in rows
                 if row["residue"] not in case.get("but", [])]
        self.assertEqual(" ".join(names), case["expect"])

    def try_frames(self, case, args):
        done = self.run_case(case["file"], "x.csv", [*args, "--frames", "all"])
        self.assertEqual(done.returncode, 0, done.stderr.decode())
        with open(self.folder / "x.csv", newline="") as file:
            self.assertEqual(len(list(csv.reader(file))) - 1, case["expect"])

    def try_says(self, case, args):
        error = self.run_case(case["file"], case.get("out", "y.json"), args).stderr.decode()
        error = error.replace(case["file"], "FILE").lower()
        self.assertTrue(any(word.lower() in error for word in case["expect"]), error)

    def try_says_or_atoms(self, case, args):
        got = self.report(case["file"], args)
        if not isinstance(got, str) and got[0] in case["expect"]["atoms"]:
            return
        self.try_says({**case, "expect": case["expect"]["says"]}, args)

    def try_colours(self, case, args):
        shares = []
        for file in (case["file"], case["expect"]):
            self.run_case(file, "x.off", ["--color", "bfactor", "--voxel", "0.7", *args])
            lines = [line.split() for line in (self.folder / "x.off").read_text().splitlines()]
            shares.append(Counter(tuple(words[3:6]) for words in lines if len(words) >= 6 and words[0] != "3"))
        self.assertEqual(*shares)
        self.assertGreater(len(shares[0]), 1)

    def test_cases(self):
        for case in json.loads((FOLDER / "expected.json").read_text()):
            args = [str(FOLDER / word) if (FOLDER / word).is_file() else word for word in case.get("args", [])]
            with self.subTest(case["file"], args=args):
                getattr(self, "try_" + case["kind"])(case, args)


if __name__ == "__main__":
    unittest.main()
