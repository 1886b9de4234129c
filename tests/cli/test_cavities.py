# SPDX-License-Identifier: MPL-2.0
"""--fill-cavities where walls are thinner than a voxel."""

import json
import unittest

from tool import DATA, ToolTest


class Cavities(ToolTest):
    def surface(self, *words):
        self.check(0, *words, "-o", "a.json", "--force")
        return json.loads((self.folder / "a.json").read_text())["surface"]

    def test_thin_walls_do_not_let_the_filling_out(self):
        for kind, file in (("sas", "1crn.pdb"), ("vdw", "1ubq.pdb"), ("ses", "4at1.ent.gz")):
            call = [DATA / file, "--surface", kind]
            open_ = self.surface(*call)
            filled = self.surface(*call, "--fill-cavities")
            self.assertEqual(filled["cavities"], 0, kind)
            self.assertAlmostEqual(filled["volume"] / open_["outer_volume"], 1, delta=1e-3, msg=kind)

    def test_variational_surface_with_thin_walls(self):
        """Its thin walls are decided twice, and the filled one is the outer wall of the other, at rest and by the flow."""
        for words in ((), ("--flow", "newton"), ("--lambda", "0.05")):
            open_ = self.surface(DATA / "4at1.ent.gz", *words)
            filled = self.surface(DATA / "4at1.ent.gz", "--fill-cavities", *words)
            self.assertGreater(open_["cavities"], 0)
            self.assertEqual(filled["cavities"], 0, words)
            self.assertAlmostEqual(filled["volume"] / open_["outer_volume"], 1, delta=5e-4, msg=words)
            self.assertAlmostEqual(filled["area"] / open_["outer_area"], 1, delta=1e-3, msg=words)


if __name__ == "__main__":
    unittest.main()
