# SPDX-License-Identifier: MPL-2.0
"""--fill-cavities where walls are thinner than a voxel."""

import json
import unittest

from tool import DATA, ToolTest, read_ply


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

    def volume(self, name):
        names, vertices, triangles = read_ply((self.folder / name).read_bytes())
        at = names.index("x")
        corners = ([vertices[v][at:at + 3] for v in t] for t in triangles)
        return sum((a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6
                   for a, b, c in corners), len(triangles)

    def test_walls_apart(self):
        call = [DATA / "4at1.ent.gz", "--surface", "ses", "--voxel", 0.7, "--color", "chain", "-q"]
        parts = []
        for walls in ("all", "outer", "cavities"):
            self.check(0, *call, "--pieces", walls, "-o", walls + ".ply", "-o", walls + ".glb", "-o", walls + ".json")
            parts.append(self.volume(walls + ".ply"))
        (all_, triangles), (outer, some), (cavities, others) = parts
        self.assertEqual(triangles, some + others)
        self.assertLess(cavities, -100)
        self.assertAlmostEqual(all_, outer + cavities, delta=0.01)
        surfaces = [json.loads((self.folder / f"{walls}.json").read_text())["surface"] for walls in ("all", "cavities")]
        self.assertEqual(surfaces[0], surfaces[1])
        self.assertAlmostEqual(outer / surfaces[0]["outer_volume"], 1, delta=0.01)

    def test_walls_in_other_files(self):
        call = [DATA / "1crn.pdb", "--surface", "ses", "--voxel", 0.7, "-q"]
        self.check(0, *call, "--pieces", "outer", "-o", "a.json")  # no mesh, and so nothing to leave out
        self.check(0, *call, "--pieces", "cavities", "-o", "a.msh", "-o", "a.poly")
        text = (self.folder / "a.msh").read_text()
        self.assertNotIn("outer wall", text)
        self.assertIn('$PhysicalNames\n1\n2 2 "cavity 1"\n', text)
        self.assertLess(max(map(abs, map(float, text.split("$Entities")[1].split("$End")[0].split()))), 1e3)
        self.assertIn("\n1\n1 ", (self.folder / "a.poly").read_text())  # one hole
        self.check(0, *call, "--pieces", "outer", "--require", "watertight,components=1,cavities=0", "-o", "a.ply")
        self.check(3, *call, "--require", "cavities=0", "-o", "b.ply", says="--require")

    def test_walls_that_are_not(self):
        (self.folder / "one.xyzr").write_text("0 0 0 1.7\n")
        self.check(1, "one.xyzr", "--pieces", "cavities", "-o", "a.ply", says="the surface has no cavity")
        self.check(0, "one.xyzr", "--pieces", "outer", "-o", "b.ply")
        self.check(2, "one.xyzr", "--pieces", "inner", "-o", "a.ply", says="--pieces: expected all or outer or cavities")
        self.check(2, DATA / "1a8o.cif.gz", "--by-symmetry", "--assembly", 1, "--pieces", "outer", "-o", "a.ply", says="--pieces")
        self.assertFalse((self.folder / "a.ply").exists())


if __name__ == "__main__":
    unittest.main()
