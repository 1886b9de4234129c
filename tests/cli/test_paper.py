# SPDX-License-Identifier: MPL-2.0
"""scripts/paper_tables.sh: the tables of the paper for a structure."""

import json
import math
import os
import re
import subprocess
import unittest

from tool import CRAMBIN, DATA, ROOT, TOOL, ToolTest

SCRIPT = ROOT / "scripts" / "paper_tables.sh"
COARSE = ("--voxel", "1.5")


class PaperTables(ToolTest):
    def call(self, status, *words, says=""):
        done = subprocess.run([SCRIPT, *map(str, words)], cwd=self.folder, capture_output=True,
                              text=True, timeout=300,
                              env={**os.environ, "VDB_MOLSURF": str(TOOL)})
        self.assertEqual(done.returncode, status, done.stderr)
        if status:
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
            self.assertTrue(done.stderr.startswith("paper_tables: error: "), done.stderr)
            self.assertIn(says, done.stderr)
        else:
            self.assertEqual(done.stderr, "")
        return done.stdout

    def test_tables(self):
        """The dimer beside the paper, as Markdown and JSON, and the numbers are the tool's."""
        self.call(0, DATA / "1a8o.cif.gz", *COARSE, "--epsilon", "0.5", "--lambda", "",
                  "-o", "t.md", "-o", "t.json")
        result = json.loads((self.folder / "t.json").read_text())
        one, = result["structures"]
        self.assertEqual((one["name"], one["assembly"], one["atoms"]), ("1A8O", "1", 1112))
        for kind in ("gaussian", "ses", "variational"):
            self.check(0, DATA / "1a8o.cif.gz", "--assembly", "1", "--surface", kind, *COARSE,
                       "-o", f"{kind}.json")
            surface = json.loads((self.folder / f"{kind}.json").read_text())["surface"]
            for key in ("area", "volume"):
                self.assertEqual(one["surfaces"][kind][key], surface[key])
        third, second = (one["surfaces"][kind] for kind in ("variational", "ses"))
        self.assertEqual(one["ratios"], {"A3/A2": third["area"] / second["area"],
                                         "V3/V2": third["volume"] / second["volume"]})
        self.assertEqual(one["epsilon"][0]["area"], third["area"])
        self.assertEqual(one["paper"], {"A1": 11294.4, "A2": 7015.9, "A3": 6334.3, "V1": 22997.3,
                                        "V2": 21801.2, "V3": 24718.3})
        text = (self.folder / "t.md").read_text()
        self.assertIn(f"| {third['area']:.1f} (6334.3) | {one['ratios']['A3/A2']:.3f} (0.903) |",
                      text)
        self.assertIn(f"| {third['volume']:.1f} (24718.3) |", text)
        self.assertEqual(self.names(), ["gaussian.json", "ses.json", "t.json", "t.md",
                                        "variational.json"])

    def test_regularisers(self):
        self.call(0, CRAMBIN, *COARSE, "--epsilon", "", "--lambda", "0.02", "-o", "t.json")
        block, = json.loads((self.folder / "t.json").read_text())["structures"][0]["regularizers"]
        gradient, equal, tense, ses = block["rows"]
        q = 0.02 * (2 * math.log(2) / 0.5) ** 2
        self.assertEqual([row["lambda"] for row in block["rows"]], [0.02, 0.02, q / (1 + q), None])
        self.assertEqual(gradient["tension"], tense["tension"])
        self.assertEqual(equal["regularizer"], "area")
        self.assertLess(tense["area"], equal["area"])
        self.assertGreater(tense["distance"]["mean"], 0)
        self.assertGreater(ses["distance"]["mean"], tense["distance"]["mean"])

    def test_part_of_a_page(self):
        """Between the two comments the tables are renewed; the rest of the page stays."""
        page = self.folder / "page.md"
        page.write_text("before\n<!-- paper_tables: begin -->\nold\n"
                        "<!-- paper_tables: end -->\nafter\n")
        words = (f"X={CRAMBIN}", *COARSE, "--epsilon", "", "--lambda", "")
        self.call(0, *words, "-o", "page.md")
        text = page.read_text()
        self.assertTrue(text.startswith("before\n<!-- paper_tables: begin -->\n"))
        self.assertTrue(text.endswith("\n<!-- paper_tables: end -->\nafter\n"))
        self.assertNotIn("\nold\n", text)
        alone = self.call(0, *words)
        lines = alone.splitlines()
        self.assertIn("| X | 327 |", alone)
        self.assertEqual([line for line in lines[1:] if line not in text], [])  # but the command

    def test_documented_numbers(self):
        """Areas and volumes of 1A8O in docs/development/paper.md are those of today, within half a per cent."""
        text = (ROOT / "docs" / "development" / "paper.md").read_text()
        rows = re.findall(r"^\| 1A8O \| 1112 \|(.*)\|$", text, re.MULTILINE)
        documented = [[float(cell.split()[0]) for cell in row.split("|")[:3]] for row in rows]
        self.call(0, DATA / "1a8o.cif.gz", "--epsilon", "", "--lambda", "", "-o", "t.json")
        surfaces = json.loads((self.folder / "t.json").read_text())["structures"][0]["surfaces"]
        for key, row in zip(("area", "volume"), documented, strict=True):
            for surface, number in zip(surfaces.values(), row, strict=True):
                self.assertAlmostEqual(surface[key] / number, 1, delta=0.005)

    def test_errors(self):
        self.call(2, says="required")
        self.call(2, CRAMBIN, "-o", "t.txt", says="t.txt: expected .md or .json")
        self.call(2, CRAMBIN, "--epsilon", "a", says="--epsilon: expected numbers, got 'a'")
        self.call(1, "none.pdb", says="none.pdb: cannot be opened")
        (self.folder / "bad.pdb").write_text("no atoms\n")
        self.call(1, CRAMBIN, "bad.pdb", *COARSE, "--epsilon", "", "--lambda", "", "-o", "t.md",
                  says="bad.pdb")
        (self.folder / "t.json").write_text("kept")
        self.call(1, CRAMBIN, "-o", "t.json", says="t.json: exists [hint: --force]")
        self.assertEqual((self.folder / "t.json").read_text(), "kept")
        self.assertEqual(self.names(), ["bad.pdb", "t.json"])


if __name__ == "__main__":
    unittest.main()
