# SPDX-License-Identifier: MPL-2.0
"""The command molsurf in PyMOL, and the scripts .pml."""

import json
import os
import shutil
import subprocess
import unittest

from needs import needs
from tool import CRAMBIN, DATA, FAST, ROOT, TOOL, ToolTest, read_ply

COMMAND = ROOT / "scripts" / "pymol" / "molsurf.py"
END = """
python
import json
rows = []
cmd.iterate("all", "rows.append((chain, resi, name, b))", space={"rows": rows})
print("RESULT " + json.dumps({"names": cmd.get_names(), "extent": cmd.get_extent(EXTENT), "b": rows}))
python end
"""


@needs("pymol")
class PyMOL(ToolTest):
    def pymol(self, script, shown):
        (self.folder / "script.pml").write_text(script + END.replace("EXTENT", repr(shown)))
        # PyMOL of Debian takes the first python3 that it finds.
        path = f"{os.path.dirname(shutil.which('pymol'))}:/usr/bin:{os.environ['PATH']}"
        done = subprocess.run(["pymol", "-cq", "script.pml"], cwd=self.folder, capture_output=True, text=True, timeout=300,
                              env={**os.environ, "PATH": path, "VDB_MOLSURF": TOOL})
        lines = [line for line in done.stdout.splitlines() if line.startswith("RESULT ")]
        self.assertEqual(len(lines), 1, done.stdout + done.stderr)
        return json.loads(lines[0][len("RESULT "):]), done.stdout

    def expect_place(self, extent, path, words):
        self.check(0, path, *words, "-o", "expected.ply", "--force")
        _, vertices, _ = read_ply((self.folder / "expected.ply").read_bytes())
        for a in range(3):
            self.assertAlmostEqual(extent[0][a], min(v[a] for v in vertices), delta=0.01)
            self.assertAlmostEqual(extent[1][a], max(v[a] for v in vertices), delta=0.01)

    def test_surface_and_areas(self):
        words = ["--surface", "ses", "--voxel", "1"]
        result, out = self.pymol(f"load {CRAMBIN}\nrun {COMMAND}\nmolsurf all, surface=ses, voxel=1\n", "molsurf")
        self.assertEqual(result["names"], ["1crn", "molsurf"])
        self.expect_place(result["extent"], CRAMBIN, words)
        self.check(0, CRAMBIN, *words, "-o", "a.atoms.csv")
        areas = {(row["chain"], row["number"], row["atom"]): float(row["area"]) for row in self.table("a.atoms.csv")}
        self.assertEqual(len(areas), len(result["b"]))
        for *atom, b in result["b"]:
            self.assertAlmostEqual(b, areas[tuple(atom)], delta=0.001)

    def test_part_with_colors_and_errors(self):
        script = (f"load {DATA / '1a8o.cif.gz'}\nrun {COMMAND}\n"
                  "molsurf resi 160-170, part, color=element, surface=sas, voxel=1\n")
        result, _ = self.pymol(script, "part")
        self.assertGreater(sum(b for *_, b in result["b"] if b), 0)
        inside = [b for _, resi, _, b in result["b"] if resi.isdigit() and 160 <= int(resi) <= 170]
        self.assertGreater(sum(inside), 500)
        result, out = self.pymol(f"load {CRAMBIN}\nrun {COMMAND}\nmolsurf all, voxel=20\n", "1crn")
        self.assertIn("--voxel: expected", out)
        self.assertNotIn("molsurf", result["names"])

    def test_script_beside_a_mesh(self):
        self.check(0, CRAMBIN, *FAST, "--color", "mean-curvature", "-o", "s.ply", "-o", "s.pml")
        result, _ = self.pymol("@s.pml\n", "s")
        self.assertEqual(result["names"], ["s", "s_legend"])
        self.expect_place(result["extent"], CRAMBIN, FAST)


if __name__ == "__main__":
    unittest.main()
