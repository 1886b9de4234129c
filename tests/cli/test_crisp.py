# SPDX-License-Identifier: MPL-2.0
"""Borders between colours: exact in pictures and pages, and with --sharp-colors in mesh files."""

import math
import unittest

from tool import DATA, ToolTest, read_ply, read_png

RADII = (2.0, 1.5)
PLACES = ((10.2, 20.1, 30.4), (12.6, 20.1, 30.4))
D = PLACES[1][0] - PLACES[0][0]
ALONG = (D * D + RADII[0] ** 2 - RADII[1] ** 2) / (2 * D)  # of the plane in which the spheres meet
CIRCLE = math.sqrt(RADII[0] ** 2 - ALONG ** 2)
TWO = ["two.pqr", "--surface", "vdw", "--voxel", "1", "--color", "chain"]


class Crisp(ToolTest):
    def setUp(self):
        super().setUp()
        (self.folder / "two.pqr").write_text("".join(
            f"ATOM {i} C ALA {chain} 1 {x} {y} {z} 0.0 {r}\n"
            for i, (chain, (x, y, z), r) in enumerate(zip("AB", PLACES, RADII), 1)))

    def vertices(self, name):
        names, vertices, triangles = read_ply((self.folder / name).read_bytes())
        first = names.index("red")
        return [(v[:3], v[first:first + 3]) for v in vertices], triangles

    def test_meshes_are_cut_along_the_circle(self):
        self.check(0, *TWO, "--sharp-colors", "-o", "a.ply")
        vertices, triangles = self.vertices("a.ply")
        self.assertEqual(len({color for _, color in vertices}), 2)
        for triangle in triangles:
            self.assertEqual(len({vertices[v][1] for v in triangle}), 1)
        colors = {}
        for place, color in vertices:
            colors.setdefault(place, set()).add(color)
        border = [place for place, both in colors.items() if len(both) == 2]
        self.assertGreater(len(border), 10)
        for x, y, z in border:
            across = math.hypot(y - PLACES[0][1], z - PLACES[0][2])
            self.assertLess(math.hypot(x - PLACES[0][0] - ALONG, across - CIRCLE), 0.05)

    def test_meshes_are_not_cut_unless_asked_for(self):
        self.check(0, *TWO, "-o", "a.ply", "-o", "b.png", "--size", "100")
        vertices, _ = self.vertices("a.ply")
        self.assertEqual(len(vertices), len({place for place, _ in vertices}))

    def test_pictures_change_colour_within_a_pixel(self):
        self.check(0, *TWO, "-o", "a.png", "-o", "a.ply", "--size", "1000", "--view", "0,0,1",
                   "--legend", "off")
        width, rows = read_png((self.folder / "a.png").read_bytes())
        row = rows[len(rows) // 2]
        pixels = [row[3 * i:3 * i + 3] for i in range(width)]

        def side(p):
            # The first two colours of the palette: sky blue and orange.
            return None if max(p) - min(p) < 40 else p[2] > p[0]  # neither white nor the line about it
        sides = [side(p) for p in pixels]
        inside = [i for i, s in enumerate(sides) if s is not None]
        change = next(i for i in inside if sides[i] != sides[inside[0]])
        self.assertEqual({sides[i] for i in inside if i > change}, {sides[change]})
        # The picture is 4 % wider than the mesh.
        across = [place[0] for place, _ in self.vertices("a.ply")[0]]
        pixel = 1.04 * (max(across) - min(across)) / width
        expected = (PLACES[0][0] + ALONG - 0.5 * (min(across) + max(across))) / pixel + width / 2
        self.assertLessEqual(abs(change - expected), 1.0)

    def test_one_colour_for_a_chain_and_its_copies(self):
        dimer = DATA / "1a8o.cif.gz"
        self.check(0, dimer, "--assembly", "1", "--voxel", "2", "--color", "class", "-o", "a.ply")
        self.check(0, dimer, "--assembly", "1", "--voxel", "2", "--color", "chain", "-o", "b.ply")
        self.assertEqual(len({color for _, color in self.vertices("a.ply")[0]}), 1)
        self.assertEqual(len({color for _, color in self.vertices("b.ply")[0]}), 2)

    def test_wrong_calls(self):
        self.check(2, *TWO[:-1], "class", "--group-by", "chain", "-o", "a.ply",
                   says="--group-by class --color group")
        done = self.check(0, "two.pqr", "--voxel", "1", "--sharp-colors", "-o", "a.ply", says="--sharp-colors")
        self.assertIn("warning", done.stderr.decode())


if __name__ == "__main__":
    unittest.main()
