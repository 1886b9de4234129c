# SPDX-License-Identifier: MPL-2.0
"""vdb_molsurf compare: distances, areas and volumes of two surfaces."""

import json
import math
import random
import struct
import subprocess
import sys
import unittest

from needs import needs
from tool import CRAMBIN, ToolTest, read_ply, read_png

# One atom each. The surface of one atom is a sphere about it, a little larger than the atom.
LARGE, SMALL, SHIFTED = (0.13, 0.29, 0.41, 4.0), (0.53, -0.01, 0.91, 1.5), (0.83, 0.09, 0.71, 4.0)
FINE = ["--voxel", "0.25", "--tolerance", "0.001"]

CUBE = [(x, y, z) for x in (0.0, 2.0) for y in (0.0, 2.0) for z in (0.0, 2.0)]
QUADS = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]


def obj(points, faces, shift=(0, 0, 0)):
    lines = ["v " + " ".join(str(a + b) for a, b in zip(point, shift)) for point in points]
    lines += ["f " + " ".join(str(i + 1) for i in face) for face in faces]
    return "\n".join(lines) + "\n"


class CompareTest(ToolTest):
    def atom(self, name, values):
        (self.folder / name).write_text(" ".join(map(str, values)) + "\n")
        return name

    def cube(self, name, shift=(0, 0, 0), faces=QUADS):
        (self.folder / name).write_text(obj(CUBE, faces, shift))
        return name

    def compare(self, a, b, *words):
        """The report."""
        self.check(0, "compare", a, b, "-o", "r.json", "--force", "-q", *words)
        return json.loads((self.folder / "r.json").read_text())


def distance(a, b):
    return math.dist(a[:3], b[:3])


class Spheres(CompareTest):
    def setUp(self):
        super().setUp()
        for name, atom in (("large", LARGE), ("small", SMALL), ("shifted", SHIFTED)):
            self.atom(name + ".xyzr", atom)
            self.check(0, name + ".xyzr", "-o", name + ".vdb", "-o", name + ".ply", "-o",
                       name + ".json", *FINE)

    def radius(self, name):
        area = json.loads((self.folder / f"{name}.json").read_text())["surface"]["area"]
        return math.sqrt(area / (4 * math.pi))

    def test_surfaces_beside_each_other_are_named(self):
        """Spheres of 2 Å: half of the diagonal of their boxes is 3.46 Å."""
        for apart in (3.3, 3.6):
            self.atom("a.xyzr", (0, 0, 0, 2))
            self.atom("b.xyzr", (apart, 0, 0, 2))
            said = self.check(0, "compare", "a.xyzr", "b.xyzr", "--surface", "vdw", "--voxel", "0.3", "-o", "r.json", "--force").stderr.decode()
            warns = f"A and B lie {apart:.1f} Å apart, more than half of their size [hint: --superpose auto" in said
            self.assertEqual(warns, apart > 3.46, said)

    def test_every_vertex_of_a_shifted_sphere(self):
        self.check(0, "compare", "large.vdb", "shifted.vdb", "-o", "d.ply")
        names, vertices, _ = read_ply((self.folder / "d.ply").read_bytes())
        R = self.radius("shifted")
        at, sign = names.index("distance"), names.index("signed_distance")
        self.assertGreater(len(vertices), 1000)
        for vertex in vertices:
            exact = math.dist(vertex[:3], SHIFTED[:3]) - R
            self.assertLess(abs(vertex[at] - abs(exact)), 1e-3)
            self.assertLess(abs(vertex[sign] - exact), 1e-3)

    def test_a_small_sphere_inside(self):
        """Closed forms: the mean distance of a sphere from a point at e inside is R + e²/(3 R)."""
        report = self.compare("large.vdb", "small.vdb")
        R, r, e = self.radius("large"), self.radius("small"), distance(LARGE, SMALL)
        self.assertAlmostEqual(report["a_to_b"]["mean"], R + e * e / (3 * R) - r, delta=2e-3)
        self.assertAlmostEqual(report["b_to_a"]["mean"], R - r - e * e / (3 * r), delta=2e-3)
        self.assertAlmostEqual(report["b_to_a"]["mean_signed"], -report["b_to_a"]["mean"])
        self.assertAlmostEqual(report["a_to_b"]["max"], R - r + e, delta=3e-3)
        self.assertAlmostEqual(report["b_to_a"]["max"], R - r + e, delta=6e-3)
        self.assertEqual(report["hausdorff"],
                         max(report["a_to_b"]["max"], report["b_to_a"]["max"]))
        self.assertEqual(report["a_to_b"]["inside"], 0)
        self.assertAlmostEqual(report["b_to_a"]["inside"], 1)
        self.assertAlmostEqual(report["area_ratio"], R * R / (r * r), delta=1e-2)
        self.assertAlmostEqual(report["volume_ratio"], R ** 3 / r ** 3, delta=5e-2)
        self.assertEqual(report["a"]["kind"], "level set")
        self.assertEqual(report["a"]["voxel"], 0.25)

    def test_a_structure_its_grid_and_its_mesh_are_one_surface(self):
        for b, bound in (("large.xyzr", 1e-5), ("large.vdb", 1e-3), ("large.ply", 5e-3)):
            report = self.compare("large.xyzr", b, *FINE)
            self.assertLess(report["hausdorff"], bound, b)
            self.assertEqual(report["a"]["kind"], "structure")
            self.assertEqual(report["a"]["atoms"], 1)

    def test_itself(self):
        for name in ("large.vdb", "large.ply"):
            self.assertLess(self.compare(name, name)["hausdorff"], 1e-5)

    @needs("openvdb")
    def test_grids(self):
        for a in ("large.vdb", "large.ply"):
            self.check(0, "compare", a, "small.vdb", "-o", "d.vdb", "--force")
            script = """
import math, pyopenvdb
grids, _ = pyopenvdb.readAll("d.vdb")
byname = {g.name: g for g in grids}
assert sorted(byname) == ["distance", "signed_distance", "surface"], sorted(byname)
assert byname["surface"].gridClass == pyopenvdb.GridClass.LEVEL_SET
signed = byname["signed_distance"].getConstAccessor()
worst = count = 0
for item in byname["distance"].iterOnValues():
    x = byname["distance"].transform.indexToWorld(item.min)
    exact = math.dist(x, (%f, %f, %f)) - %f
    worst = max(worst, abs(item.value - abs(exact)), abs(signed.getValue(item.min) - exact))
    count += item.count
assert count > 10000 or "%s" != "large.vdb", count
assert worst < 2e-3, worst  # the surface of an atom is a sphere up to about 1e-3
""" % (*SMALL[:3], self.radius("small"), a)
            done = subprocess.run([sys.executable, "-c", script], cwd=self.folder,
                                  capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)

    def test_metadata(self):
        self.check(0, "compare", "large.vdb", "small.vdb", "-o", "d.vdb")
        text = self.check(0, "info", "d.vdb").stdout.decode()
        for word in ("a_to_b.mean", "hausdorff", "b_sha256", "command", "version"):
            self.assertIn(word, text)


class Output(CompareTest):
    def setUp(self):
        super().setUp()
        self.cube("a.obj")
        self.cube("b.obj", (0.25, 0, 0))

    def test_numbers_are_printed_without_a_file(self):
        done = self.check(0, "compare", "a.obj", "b.obj")
        text = done.stdout.decode()
        self.assertRegex(text, r"max +0.25000 +0.25000\n")
        self.assertRegex(text, r"Hausdorff +0.25000\n")
        self.assertRegex(text, r"area \[Å\^2\] +24.00 +24.00 +1.00000\n")
        self.assertRegex(text, r"volume \[Å\^3\] +8.00 +8.00 +1.00000\n")
        self.assertEqual(done.stderr, b"")
        self.assertEqual(self.names(), ["a.obj", "b.obj"])

    def test_cubes(self):
        """Two faces of six lie 1/4 Å off; the others slide on themselves but for a strip."""
        report = self.compare("a.obj", "b.obj")
        self.assertAlmostEqual(report["a_to_b"]["max"], 0.25)
        self.assertAlmostEqual(report["a_to_b"]["mean"], report["b_to_a"]["mean"], delta=1e-3)
        # Of 24 Å²: 8 Å² near 1/4 off, except near the edges of one of the two faces, and a strip.
        self.assertGreater(report["a_to_b"]["mean"], 0.06)
        self.assertLess(report["a_to_b"]["mean"], 0.11)
        self.assertEqual(report["a"]["kind"], "mesh")
        self.assertIsNone(report["a"]["voxel"])
        self.assertGreater(report["a_to_b"]["samples"], 8)

    def test_the_same_bytes_for_any_number_of_threads(self):
        files = []
        for threads in ("1", "2"):
            self.check(0, "compare", CRAMBIN, "a.obj", "-j", threads, "--voxel", "1", "-o", "d.ply",
                       "-o", "d.json", "--force")
            report = json.loads((self.folder / "d.json").read_text())
            for key in ("seconds", "command", "threads", "peak_memory_bytes"):
                del report[key]
            files.append(((self.folder / "d.ply").read_bytes(), report))
        self.assertEqual(files[0], files[1])

    def test_colours(self):
        self.check(0, "compare", "a.obj", "b.obj", "-o", "d.ply", "--range", "0.25")
        data = (self.folder / "d.ply").read_bytes()
        self.assertIn(b"comment colors: distance in Angstrom, map OrRd from 0 to 0.25\n", data)
        self.assertIn(b"comment color 0.25 127 0 0\n", data)
        self.assertIn(b"comment color 0 255 247 236\n", data)  # light where they agree
        self.check(0, "compare", "a.obj", "b.obj", "-o", "e.ply", "--palette", "batlow")
        self.assertIn(b"map batlow from 0 to", (self.folder / "e.ply").read_bytes())
        self.check(2, "compare", "a.obj", "b.obj", "-o", "e.ply", "--palette", "pink", says=["--palette", "OrRd"])
        names, vertices, triangles = read_ply(data)
        self.assertEqual(names[-3:], ["red", "green", "blue"])
        self.assertEqual((len(vertices), len(triangles)), (8, 12))
        at = names.index("distance")
        for vertex in vertices:
            self.assertAlmostEqual(vertex[at], 0.25 if vertex[0] == 0 else 0)
            self.assertEqual(vertex[-3:], (127, 0, 0) if vertex[0] == 0 else (255, 247, 236))
        self.check(0, "compare", "a.obj", "b.obj", "-o", "s.ply", "-o", "s.json", "--color",
                   "signed-distance")
        names, vertices, _ = read_ply((self.folder / "s.ply").read_bytes())
        for vertex in vertices:
            red, _, blue = vertex[-3:]
            self.assertTrue(red > blue if vertex[0] == 0 else red == blue, vertex)
        color = json.loads((self.folder / "s.json").read_text())["color"]
        self.assertEqual((color["attribute"], color["map"]), ("signed_distance", "RdBu"))
        self.assertAlmostEqual(color["high"], 0.25)
        self.assertEqual(color["low"], -color["high"])
        self.assertEqual(len(color["bar"]), 9)

    def test_a_tangle_is_given_up(self):
        """Each distance takes many triangles there. The estimate is of one core, and there are said to be many."""
        number = random.Random(1)
        points = [[round(number.uniform(-99, 99), 3) for _ in range(3)] for _ in range(3000)]
        (self.folder / "tangle.obj").write_text(obj(points, [number.sample(range(3000), 3) for _ in points]))
        self.check(1, "compare", "tangle.obj", "tangle.obj", "-j", "64", "--max-hours", "1e-5", "-o", "a.json",
                   says="the comparison takes more than 1e-05 hours [hint: a larger --max-hours]")
        self.assertNotIn("a.json", self.names())

    def test_open_meshes_have_no_volume(self):
        self.cube("open.obj", faces=QUADS[:5])
        self.check(0, "compare", "a.obj", "open.obj", "-o", "d.ply", "-o", "d.json",
                   says=["warning: open.obj", "no volume"])
        names, _, _ = read_ply((self.folder / "d.ply").read_bytes())
        self.assertNotIn("signed_distance", names)
        report = json.loads((self.folder / "d.json").read_text())
        self.assertIsNone(report["b"]["volume"])
        self.assertIsNone(report["volume_ratio"])
        self.assertIsNone(report["a_to_b"]["mean_signed"])
        self.assertAlmostEqual(report["b"]["area"], 20)
        self.assertAlmostEqual(report["a_to_b"]["max"], 1.0, delta=0.15)  # the missing face's middle
        self.assertEqual(len(report["warnings"]), 1)
        self.check(1, "compare", "a.obj", "open.obj", "--color", "signed-distance",
                   says=["open.obj", "closed"])
        self.check(1, "compare", "open.obj", "a.obj", "-o", "e.vdb", says=["open.obj", "closed"])
        self.assertNotIn("e.vdb", self.names())

    def test_standard_output(self):
        done = self.check(0, "compare", "a.obj", "b.obj", "-o", "-", "--format", "json", "-q")
        self.assertAlmostEqual(json.loads(done.stdout)["hausdorff"], 0.25)

    def test_standard_input_is_a_structure(self):
        done = self.check(0, "compare", "a.obj", "-", "--voxel", "1", input=CRAMBIN.read_bytes())
        self.assertIn(b"Hausdorff", done.stdout)

    def test_options_without_effect_are_told(self):
        self.check(0, "compare", "a.obj", "b.obj", "--lambda", "1", "--waters",
                   says=["warning", "--lambda", "--waters", "without effect"])

    def test_a_structure_that_does_not_settle(self):
        self.check(3, "compare", CRAMBIN, "a.obj", "--voxel", "1", "--flow", "newton", "--max-steps", "1", "-o",
                   "d.json", says=["not converged", "1crn.pdb"])
        self.assertIn("d.json", self.names())

    def test_existing_files_stay(self):
        (self.folder / "d.ply").write_text("old")
        self.check(1, "compare", "a.obj", "b.obj", "-o", "d.ply", says="--force")
        self.assertEqual((self.folder / "d.ply").read_text(), "old")


class WrongCalls(CompareTest):
    def refuse(self, *words, says=()):
        self.check(2, "compare", *words, says=says)
        self.assertEqual(self.names(), [])

    def test_operands(self):
        self.refuse(says="got 0")
        self.refuse(CRAMBIN, says=["two surfaces", "got 1"])
        self.refuse(CRAMBIN, CRAMBIN, CRAMBIN, says="got 3")
        self.refuse("-", "-", says="standard input")
        self.refuse("", "a.ply", says="empty word")

    def test_outputs(self):
        for name in ("a.obj", "a.stl", "a.usda", "a.glb"):
            self.refuse("a.ply", "b.ply", "-o", name, says=name)
        self.refuse("a.ply", "b.ply", "--format", "ply", says="-o -")

    def test_options(self):
        self.refuse("a.ply", "b.ply", "--fields", "sas", says="--fields")
        self.refuse("a.ply", "b.ply", "--color", "red", says=["--color", "red"])
        for value in ("0", "-1", "nan", "much"):
            self.refuse("a.ply", "b.ply", "--range", value, says="--range")
        self.refuse("a.ply", "b.ply", "--voxel", "0", says="--voxel")
        self.refuse("a.ply", "b.ply", "--what", says="--what")

    def test_options_of_compare_are_not_for_building(self):
        self.check(2, CRAMBIN, "-o", "a.ply", "--range", "1", says="--range")

    def test_help(self):
        text = self.check(0, "compare", "--help-all").stdout.decode()
        for word in ("compare A B", "--range", "--voxel", "3 not converged"):
            self.assertIn(word, text)
        self.assertNotIn("--fields", text)
        for line in text.splitlines():
            self.assertLessEqual(len(line), 100)


class BadFiles(CompareTest):
    def refuse(self, name, content, says):
        path = self.folder / name
        if content is not None:
            path.write_bytes(content if isinstance(content, bytes) else content.encode())
        self.cube("good.obj")
        for pair in ((name, "good.obj"), ("good.obj", name)):
            self.check(1, "compare", *pair, "-o", "d.ply", "-o", "d.json", says=[name, *says])
            self.assertNotIn("d.ply", self.names())
            self.assertNotIn("d.json", self.names())

    def test_meshes(self):
        self.refuse("none.ply", None, ["No such file"])
        self.refuse("empty.ply", "", ["expected 'ply' first"])
        self.refuse("empty.stl", "", ["84 bytes"])
        self.refuse("empty.obj", "", ["expected triangles"])
        self.refuse("nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", ["vertex 1", "finite"])
        self.refuse("index.obj", "v 0 0 0\nf 1 2 3\n", ["line 2", "1 to 1", "got 3"])
        self.refuse("word.obj", "v 0 O 0\n", ["line 1", "'O'"])
        self.refuse("short.stl", b"x" * 80 + struct.pack("<I", 2) + b"y" * 50, ["184 bytes"])
        self.refuse("head.ply", "ply\nformat ascii 1.0\nelement vertex 3\n", ["end_header"])

    def test_a_mesh_cut_short(self):
        self.cube("a.obj")
        self.check(0, "compare", "a.obj", "a.obj", "-o", "whole.ply")
        whole = (self.folder / "whole.ply").read_bytes()
        self.refuse("cut.ply", whole[:-10], ["cut short", "face 12"])

    def test_level_sets(self):
        self.refuse("none.vdb", None, ["No such file"])
        self.refuse("bad.vdb", "not a vdb file at all, but long enough to be read", ["not a .vdb"])
        self.cube("a.obj")
        self.check(0, "compare", "a.obj", "a.obj", "-o", "d.vdb", "--voxel", "0.25")
        data = (self.folder / "d.vdb").read_bytes()
        (self.folder / "d.vdb").unlink()
        self.refuse("cut.vdb", data[: len(data) // 2], ["cut short"])

    def test_structures(self):
        self.refuse("none.pdb", None, ["No such file"])
        self.refuse("bad.pdb", "what is this\n", [])

    def test_a_folder(self):
        (self.folder / "a.ply").mkdir()
        self.refuse("a.ply", None, ["folder"])


class Pictures(CompareTest):
    def test_distance_is_drawn(self):
        """A cube moved by 2 along x: red where it is outside of the other, in the picture and its legend."""
        self.cube("a.obj", (2, 0, 0))
        self.cube("b.obj")
        words = ["compare", "a.obj", "b.obj", "--color", "signed-distance", "--range", "2", "--style", "flat", "--size", "600"]
        red, white = (178, 24, 43), (255, 255, 255)
        for way, share in (("1,0,0", 0.3), ("-1,0,0", 0)):  # one side is 2 away, the other touches
            self.check(0, *words, "--view", way, "-o", "a.png", "-o", "a.legend.svg", "-o", "a.html", "--force")
            width, rows = read_png((self.folder / "a.png").read_bytes())
            pixels = [[tuple(row[3 * x:3 * x + 3]) for x in range(width)] for row in rows]
            shown = [p for row in pixels for p in row[:400] if p != white]
            self.assertGreaterEqual(sum(p == red for p in shown), share * len(shown), way)
            self.assertEqual(any(p == red for p in shown), share > 0)
            legend = {p for row in pixels for p in row[450:]}
            self.assertLess(min(math.dist(p, red) for p in legend), 4)
        page = (self.folder / "a.html").read_text()
        self.assertIn("Signed distance", page)
        self.assertIn("Distances from b", page)
        self.assertIn("Signed distance", (self.folder / "a.legend.svg").read_text())
        self.check(0, *words, "--turntable", "2", "--legend", "off", "-o", "t.png")
        self.assertTrue((self.folder / "t.0002.png").exists())
        self.check(0, "compare", "a.obj", "b.obj", "--size", "100", "-o", "c.ply", says="--size is for .png")
        self.check(2, "compare", "a.obj", "b.obj", "-o", "c.mp4", says="expected --turntable")


if __name__ == "__main__":
    unittest.main()
