# SPDX-License-Identifier: MPL-2.0
"""The surface of a whole assembly from one unit of it."""

import collections
import json
import math
import random
import struct
import unittest

from test_symmetry import biomt, icosahedron, ring
from tool import CRAMBIN, DATA, ToolTest, read_ply, read_png

DIMER = DATA / "1a8o.cif.gz"
ASSEMBLY = ["--assembly", "1", "--voxel", "1"]


def blob(count=120, middle=(14.0, 40.0, 52.0), radius=11.0):
    """ATOM records of carbons at random places in a ball."""
    chance = random.Random(4)
    text = ""
    for i in range(count):
        while True:
            x = [chance.uniform(-1, 1) for _ in range(3)]
            if sum(t * t for t in x) < 1:
                break
        place = "".join(f"{m + radius * t:8.3f}" for m, t in zip(middle, x))
        text += f"ATOM  {i + 1:5}  CA  ALA A{i + 1:4}    {place}  1.00  0.00           C  \n"
    return text


class BySymmetry(ToolTest):
    def write(self, name, content):
        (self.folder / name).write_text(content)

    def report(self, name):
        return json.loads((self.folder / name).read_text())

    def shell(self):
        self.write("shell.pdb", biomt([(m, (0, 0, 0)) for m in icosahedron()]) + blob())

    def ring(self, fold, *of_blob):
        self.write("ring.pdb", ring(fold).replace(ring(fold).splitlines(True)[-1], blob(*of_blob)))

    def closed_mesh(self, name):
        """The vertices and triangles of a .ply, which is closed and what its .json says."""
        surface = self.report(name + ".json")["surface"]
        self.assertTrue(surface["closed"])
        _, vertices, triangles = read_ply((self.folder / (name + ".ply")).read_bytes())
        self.assertEqual(len(vertices), surface["vertices"])
        self.assertEqual(len(triangles), surface["triangles"])
        edges = collections.Counter()
        for a, b, c in triangles:
            edges.update([(a, b), (b, c), (c, a)])
        self.assertEqual(set(edges.values()), {1})
        self.assertTrue(all((b, a) in edges for a, b in edges))
        return vertices, triangles

    def test_a_shell(self):
        self.shell()
        done = self.check(0, "shell.pdb", *ASSEMBLY, "--surface", "ses", "--by-symmetry", "-o",
                          "a.json", "-o", "a.glb", "-o", "a.png", "--color", "copy", "--size", "300",
                          says=["used 120 atoms (1 copy) in each of 60 units", "(I)", "ses by its mesh: area"])
        self.check(0, "shell.pdb", *ASSEMBLY, "--surface", "ses", "-o", "b.json", "-o", "b.ply")
        unit, whole = self.report("a.json"), self.report("b.json")
        symmetry = unit["symmetry"]
        self.assertEqual((symmetry["point_group"], symmetry["order"]), ("I", 60))
        self.assertLess(symmetry["deviation"], 1e-3)
        self.assertEqual(unit["atoms"], whole["atoms"])
        for name, within in (("area", 0.005), ("volume", 0.002)):
            # Of the unit there is a mesh alone.
            found, expected = unit["surface"][name], whole["surface"]["mesh_" + name]
            self.assertLess(abs(found - expected), within * expected, name)
        self.assertIsInstance(unit["surface"]["mesh_euler_characteristic"], int)
        for name in ("euler_characteristic", "components", "cavities", "outer_area"):
            self.assertIsNone(unit["surface"][name], name)
        self.assertEqual(len(unit["instances"]), 60)
        self.assertIsNone(whole["symmetry"])
        # The mesh of the unit once, and its copies.
        data = (self.folder / "a.glb").read_bytes()
        size, = struct.unpack("<I", data[12:16])
        scene = json.loads(data[20:20 + size])
        self.assertEqual(sum("mesh" in node for node in scene["nodes"]), 60)
        width, rows = read_png((self.folder / "a.png").read_bytes())
        self.assertGreater(len({bytes(row[3 * i:3 * i + 3]) for row in rows
                                for i in range(width)}), 100)

    def test_the_report_has_the_area_of_the_triangles_in_the_file(self):
        for words in (["--by-symmetry"], ["--by-symmetry", "--surface", "ses"], []):
            self.check(0, DIMER, "--assembly", "1", "--voxel", "1.5", *words, "-o", "a.ply", "-o", "a.json", "--force")
            _, vertices, triangles = read_ply((self.folder / "a.ply").read_bytes())
            area = 0.0
            for corners in triangles:
                a, b, c = (vertices[k][:3] for k in corners)
                one, other = ([x - y for x, y in zip(end, a)] for end in (b, c))
                area += 0.5 * math.hypot(*(one[k - 2] * other[k - 1] - one[k - 1] * other[k - 2] for k in range(3)))
            surface = self.report("a.json")["surface"]
            self.assertLess(abs(surface["triangle_area"] / area - 1), 1e-6, words)
            self.assertGreater(1 - area / surface["area"], 0.005, words)  # `area` is that of curved patches

    def test_welded_it_is_closed(self):
        self.shell()
        for name, words in (("a", ["--weld"]), ("b", [])):
            self.check(0, "shell.pdb", *ASSEMBLY, "--by-symmetry", *words, "-o", name + ".ply", "-o",
                       name + ".json")
        vertices, triangles = self.closed_mesh("a")
        _, apart, again = read_ply((self.folder / "b.ply").read_bytes())
        self.assertEqual(len(again), len(triangles))
        self.assertGreater(len(apart), len(vertices))

    def test_interlocking_units(self):
        """The border winds between atoms of all units, and differs by gaps and necks from theirs."""
        self.ring(5, 120, (14.0, 1.0, 0.0), 16.0)
        for surface in ("variational", "ses", "sas", "vdw"):
            words = [*ASSEMBLY, "--surface", surface, "--force"]
            self.check(0, "ring.pdb", *words, "--by-symmetry", "--weld", "-o", "a.ply", "-o",
                       "a.json")
            self.check(0, "ring.pdb", *words, "-o", "b.json")
            self.closed_mesh("a")
            unit, whole = self.report("a.json"), self.report("b.json")
            for name, within in (("area", 0.01), ("volume", 0.003)):
                found, expected = unit["surface"][name], whole["surface"][name]
                self.assertLess(abs(found - expected), within * expected, (surface, name))
            self.assertGreater(unit["symmetry"]["open_vertices"], 0, surface)

    def test_a_closed_form_needs_no_mesh(self):
        self.ring(5, 120, (14.0, 1.0, 0.0), 16.0)
        words = ["ring.pdb", *ASSEMBLY, "--by-symmetry", "--group-by", "chain", "--force"]
        for surface in ("sas", "vdw"):
            self.check(0, *words, "--surface", surface, "-o", "a.json")
            self.check(0, *words, "--surface", surface, "-o", "b.json", "-o", "b.ply")
            alone, meshed = self.report("a.json"), self.report("b.json")
            self.assertEqual(alone["surface"]["triangles"], 0)
            self.assertIsNone(alone["voxel"])
            self.assertEqual(alone["symmetry"]["order"], 5)
            for name in ("area", "volume", "euler_characteristic", "components", "cavities"):
                self.assertEqual(alone["surface"][name], meshed["surface"][name], name)
            (group,), (other,) = alone["groups"], meshed["groups"]
            self.assertEqual((group["name"], group["atoms"], group["area"]),
                             (other["name"], other["atoms"], other["area"]))
            self.assertIsNone(group["volume"])

    def test_a_ring_and_a_dimer(self):
        self.ring(7, 60, (12.0, 1.0, 0.0), 6.0)
        self.check(0, "ring.pdb", *ASSEMBLY, "--by-symmetry", "-o", "r.json", says="(C7)")
        self.check(0, DIMER, *ASSEMBLY, "--by-symmetry", "--weld", "-o", "d.json", "-o", "d.stl",
                   says="(C2)")
        self.assertTrue(self.report("d.json")["surface"]["closed"])

    def test_levels_of_detail(self):
        self.shell()
        self.check(0, "shell.pdb", "--assembly", "1", "--by-symmetry", "--lod", "1,2", "-o", "a.glb",
                   "-o", "a.html")
        data = (self.folder / "a.glb").read_bytes()
        size, = struct.unpack("<I", data[12:16])
        scene = json.loads(data[20:20 + size])
        self.assertEqual(sum("mesh" in node for node in scene["nodes"]), 120)
        self.check(2, "shell.pdb", *ASSEMBLY, "--by-symmetry", "--weld", "--sharp-colors", "-o", "a.ply",
                   says="--weld and --sharp-colors")

    def test_wrong_calls(self):
        self.shell()
        self.check(2, CRAMBIN, "--by-symmetry", "-o", "a.json", says="--assembly")
        self.check(2, "shell.pdb", *ASSEMBLY, "--weld", "-o", "a.ply", says="--by-symmetry")
        self.check(2, "shell.pdb", *ASSEMBLY, "--by-symmetry", "-o", "a.vdb", says="--memory")
        for words in (["--instances"], ["--copies", "1"], ["--memory", "1G"], ["--center"],
                      ["--fill-cavities"], ["--dry-run"],
                      ["--fields", "sas"]):
            self.check(2, "shell.pdb", *ASSEMBLY, "--by-symmetry", *words, "-o", "a.json",
                       says="--by-symmetry")
        self.assertEqual(self.names(), ["shell.pdb"])

    def test_operators_that_are_no_group(self):
        operators = [(m, (0, 0, 0)) for m in icosahedron()[:4]]
        operators.append((operators[1][0], (70, 0, 0)))
        self.write("some.pdb", biomt(operators) + blob())
        self.check(1, "some.pdb", *ASSEMBLY, "--by-symmetry", "-o", "a.json",
                   says=['assembly "1"', "by symmetry", "--by-symmetry"])
        identity = ((1, 0, 0), (0, 1, 0), (0, 0, 1))
        self.write("row.pdb", biomt([(identity, (30 * i, 0, 0)) for i in range(4)]) + blob())
        self.check(1, "row.pdb", *ASSEMBLY, "--by-symmetry", "-o", "a.json",
                   says="a helix with ends")
        self.assertEqual(self.names(), ["row.pdb", "some.pdb"])


if __name__ == "__main__":
    unittest.main()
