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


if __name__ == "__main__":
    unittest.main()
