# SPDX-License-Identifier: MPL-2.0
"""--require: what a mesh has to be, or nothing is written."""

import math
import unittest

from tool import CRAMBIN, FAST, ToolTest


def ring(count=10, radius=8.0):
    """Balls about a hole."""
    return "".join(f"{radius * math.cos(2 * math.pi * n / count):.4f} {radius * math.sin(2 * math.pi * n / count):.4f} 0 3\n"
                   for n in range(count))


class Require(ToolTest):
    def test_what_a_mesh_has(self):
        (self.folder / "ring.xyzr").write_text(ring())
        (self.folder / "two.xyzr").write_text("0 0 0 1.7\n9 0 0 1.7\n")
        cases = (("ring.xyzr", "genus=1", "genus=0", "expected 0 handles of all pieces, got 1"),
                 ("ring.xyzr", "components=1", "components=2", "got 1"),
                 ("two.xyzr", "components=2,genus=0", "components=1", "expected 1 pieces that are no walls of cavities, got 2"),
                 ("ring.xyzr", "cavities=0", "cavities=1", "expected 1 cavities, got 0"),
                 ("ring.xyzr", "min-angle=0.1", "min-angle=59", "expected at least 59 degrees as the least angle, got"),
                 ("ring.xyzr", "Watertight,manifold", "watertight,min-angle=60", "--require min-angle=60"))
        for name, met, missed, says in cases:
            with self.subTest(name=name, missed=missed):
                words = [name, "--surface", "vdw", "-o", "a.ply", "-o", "a.json", "--force", "--require"]
                self.check(0, *words, met)
                (self.folder / "a.ply").unlink()
                (self.folder / "a.json").unlink()
                self.check(3, *words, missed, says=says)
                self.assertEqual(self.names(), ["ring.xyzr", "two.xyzr"])

    def test_a_cavity_is_no_component(self):
        self.check(0, CRAMBIN, "--surface", "ses", "-o", "a.ply", "--require", "components=1,cavities=1")

    def test_wrong_words(self):
        for wrong in ("closed", "genus", "genus=", "genus=x", "genus=-1", "watertight=1", ""):
            self.check(2, CRAMBIN, *FAST, "-o", "a.ply", "--require", wrong, says="--require")
        self.check(2, CRAMBIN, *FAST, "-o", "a.ply", "--require", "watertight", "--memory", "1G", says="together")
        self.assertEqual(self.names(), [])


if __name__ == "__main__":
    unittest.main()
