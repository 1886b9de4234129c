# SPDX-License-Identifier: MPL-2.0
"""--remesh, --density, --adapt: triangles of an even size and shape, and what they are promised to be."""

import json
import math
import unittest

from tool import CRAMBIN, DATA, ToolTest, read_ply


def angles_and_edges(data):
    """The least angle [degree], the shortest and the longest edge of a .ply."""
    _, vertices, triangles = read_ply(data)
    angle, edges = 180.0, []
    for t in triangles:
        corners = [vertices[v][:3] for v in t]
        a, b, c = (math.dist(corners[k - 1], corners[k]) for k in range(3))
        edges += [a, b, c]
        for x, y, z in ((a, b, c), (b, c, a), (c, a, b)):
            angle = min(angle, math.degrees(math.acos((y * y + z * z - x * x) / (2 * y * z))))
    return angle, min(edges), max(edges)


class Remesh(ToolTest):
    def report(self, name="a.json"):
        return json.loads((self.folder / name).read_text())["surface"]

    def test_angles_and_edges_are_as_reported(self):
        for kind in ("variational", "ses"):
            with self.subTest(kind):
                self.check(0, CRAMBIN, "--surface", kind, "--remesh", 0.6, "--require", "min-angle=28,watertight,manifold",
                           "-o", "a.ply", "-o", "a.json", "--force")
                angle, shortest, longest = angles_and_edges((self.folder / "a.ply").read_bytes())
                shape = self.report()["mesh_shape"]
                self.assertAlmostEqual(shape["least_angle"], angle, 3)
                self.assertAlmostEqual(shape["shortest_edge"], shortest, 5)
                self.assertAlmostEqual(shape["longest_edge"], longest, 5)
                self.assertTrue(0.4 * 0.6 < shortest and longest < 1.7 * 0.6, (shortest, longest))
                self.assertEqual((shape["share_below_20"], shape["share_below_28"], shape["kept_pieces"]), (0, 0, 0))
                self.assertEqual(shape["euler_characteristics"], [2] if kind == "variational" else [2, 2])

    def test_measures_of_the_surface_stay(self):
        self.check(0, CRAMBIN, "-o", "a.json", "-o", "a.ply", "-o", "a.residues.csv")
        self.check(0, CRAMBIN, "--remesh", 1, "-o", "b.json", "-o", "b.ply", "-o", "b.residues.csv")
        a, b = self.report(), self.report("b.json")
        self.assertIsNone(a["mesh_shape"])
        for key in ("area", "volume", "euler_characteristic", "mean_curvature"):
            self.assertEqual(a[key], b[key], key)
        self.assertLess(b["triangles"], 0.4 * a["triangles"])
        self.assertEqual((self.folder / "a.residues.csv").read_bytes(), (self.folder / "b.residues.csv").read_bytes())

    def test_threads_do_not_matter(self):
        for threads in (1, 2):
            self.check(0, CRAMBIN, "--surface", "ses", "--remesh", 0.7, "--adapt", 0.05, "--color", "chain", "-j", threads,
                       "-o", f"{threads}.ply")
        self.assertEqual((self.folder / "1.ply").read_bytes(), (self.folder / "2.ply").read_bytes())

    def test_density_is_of_vertices(self):
        self.check(0, CRAMBIN, "--density", 2, "-o", "a.json", "-o", "a.stl")
        surface = self.report()
        self.assertAlmostEqual(surface["vertices"] / surface["area"], 2, delta=0.15)

    def test_adapt_follows_the_surface(self):
        self.check(0, CRAMBIN, "--remesh", 1.5, "--adapt", 0.03, "-o", "a.ply")
        self.check(0, CRAMBIN, "--remesh", 1.5, "-o", "b.ply")
        self.check(0, CRAMBIN, "-o", "c.vdb")
        far = []
        for name in ("a.ply", "b.ply"):
            self.check(0, "compare", "c.vdb", name, "-o", "d.json", "--force")
            both = json.loads((self.folder / "d.json").read_text())
            far.append(max(both["a_to_b"]["max"], both["b_to_a"]["max"]))
        self.assertLess(far[0], 0.06)
        self.assertGreater(far[1], 2 * far[0])

    def test_a_stored_surface_gets_the_same_triangles(self):
        self.check(0, CRAMBIN, "--fields", "spline", "--remesh", 0.8, "-o", "a.vdb", "-o", "a.stl")
        self.check(0, "convert", "a.vdb", "--remesh", 0.8, "-o", "b.stl", "-o", "b.json")
        self.assertEqual((self.folder / "a.stl").read_bytes(), (self.folder / "b.stl").read_bytes())
        self.assertGreater(self.report("b.json")["mesh_shape"]["least_angle"], 28)

    def test_small_pieces_stay_and_one_line_says_so(self):
        (self.folder / "two.xyzr").write_text("0 0 0 4\n9 0 0 1.2\n")
        done = self.check(0, "two.xyzr", "--surface", "vdw", "--remesh", 0.9, "-o", "a.json", "-o", "a.ply",
                          says="--remesh 0.9 Å: 1 closed piece of 2 left as before")
        self.assertEqual(done.stderr.decode().count("--remesh"), 2)  # with the hint
        self.assertEqual(self.report()["mesh_shape"]["kept_pieces"], 1)

    def test_wrong_calls(self):
        for words, says in ((["--remesh", 0.01, "-o", "a.ply"], "0.05 to 10"),
                            (["--remesh", "nan", "-o", "a.ply"], "0.05 to 10"),
                            (["--remesh", 0, "-o", "a.ply"], "0.05 to 10"),
                            (["--density", 0, "-o", "a.ply"], "0.014 to 400"),
                            (["--adapt", 0.03, "-o", "a.ply"], "--remesh or --density"),
                            (["--remesh", 1, "--adapt", 2, "-o", "a.ply"], "0.001 to 1"),
                            (["--remesh", 1, "--density", 1, "-o", "a.ply"], "together"),
                            (["--remesh", 1, "-o", "a.vdb"], "expected -o FILE.ply too"),
                            (["--remesh", 1, "--sharp-colors", "--color", "chain", "-o", "a.ply"], "together")):
            with self.subTest(words):
                self.check(2, CRAMBIN, *words, says=says)
        for words in (["--by-symmetry", "--assembly", 1], ["--bricks", 2]):
            self.check(2, *([] if words[0] != "--bricks" else ["bricks", "plan"]), DATA / "1a8o.cif.gz", *words,
                       "--remesh", 1, "-o", "a.ply" if words[0] != "--bricks" else "a.json", says="--remesh")
        self.assertEqual(self.names(), [])


if __name__ == "__main__":
    unittest.main()
