# SPDX-License-Identifier: MPL-2.0
"""Meshes for programs that fill them with tetrahedra: .poly, .msh, .msh2."""

import math
import subprocess
import unittest

from needs import needs
from tool import CRAMBIN, DATA, ToolTest


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


class Poly:
    """A file of tetgen: vertices, triangles with markers, holes."""

    def __init__(self, path):
        rows = iter([line.split() for line in path.read_text().splitlines() if not line.startswith("#")])
        number = lambda row: [float(x) for x in row[1:]]
        self.vertices = [number(next(rows)) for _ in range(int(next(rows)[0]))]
        self.triangles, self.markers = [], []
        for _ in range(int(next(rows)[0])):
            self.markers.append(int(next(rows)[2]))
            self.triangles.append([int(x) - 1 for x in next(rows)[1:]])
        self.holes = [number(next(rows)) for _ in range(int(next(rows)[0]))]

    def corners(self, marker=None):
        for t, m in zip(self.triangles, self.markers):
            if marker in (None, m):
                yield [self.vertices[v] for v in t]

    def volume(self, marker=None):
        return sum(dot(a, cross(b, c)) for a, b, c in self.corners(marker)) / 6

    def winding(self, x, marker=None):
        """How often the triangles go around a point: 1 inside, 0 outside."""
        total = 0.0
        for corners in self.corners(marker):
            a, b, c = (minus(p, x) for p in corners)
            la, lb, lc = (math.sqrt(dot(p, p)) for p in (a, b, c))
            total += 2 * math.atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb)
        return total / (4 * math.pi)


class Gmsh:
    """A file of Gmsh, 2.2 or 4.1: groups, and vertices of the triangles of each."""

    def __init__(self, path):
        self.lines = path.read_text().splitlines()
        self.version = self.section("MeshFormat")[0].split()[0]
        self.groups = {int(n): name.strip('"') for _, n, name in (l.split(" ", 2) for l in self.section("PhysicalNames")[1:])}
        self.vertices, self.triangles = {}, {}
        (self.read2 if self.version == "2.2" else self.read4)()

    def section(self, name):
        return self.lines[self.lines.index("$" + name) + 1:self.lines.index("$End" + name)]

    def read2(self):
        for line in self.section("Nodes")[1:]:
            n, *x = line.split()
            self.vertices[n] = [float(v) for v in x]
        for line in self.section("Elements")[1:]:
            _, kind, tags, group, entity, *nodes = line.split()
            assert (kind, tags, group) == ("2", "2", entity)
            self.triangles.setdefault(int(group), []).append([self.vertices[n] for n in nodes])

    def read4(self):
        group_of = {}
        for line in self.section("Entities")[1:]:
            words = line.split()
            group_of[words[0]] = int(words[8])
        for name, store in (("Nodes", self.nodes), ("Elements", self.elements)):
            rows = iter(self.section(name)[1:])
            for header in rows:
                _, entity, _, count = header.split()
                store([next(rows) for _ in range(int(count) * (2 if name == "Nodes" else 1))], group_of[entity])

    def nodes(self, rows, _):
        half = len(rows) // 2
        self.vertices.update({n: [float(v) for v in x.split()] for n, x in zip(rows[:half], rows[half:])})

    def elements(self, rows, group):
        self.triangles.setdefault(group, []).extend([self.vertices[n] for n in row.split()[1:]] for row in rows)


def volume_of_tetrahedra(vertices, cells):
    return sum(abs(dot(minus(vertices[b], vertices[a]), cross(minus(vertices[c], vertices[a]), minus(vertices[d], vertices[a]))))
               for a, b, c, d in cells) / 6


class Fem(ToolTest):
    def make(self, path, *words):
        self.check(0, path, "--surface", "ses", *words, "-o", "a.poly", "-o", "a.msh", "-o", "a.msh2")
        return Poly(self.folder / "a.poly")

    def test_a_hole_lies_in_the_void_of_each_cavity(self):
        poly = self.make(DATA / "4at1.ent.gz", "--voxel", 1)
        cavities = max(poly.markers) - 1
        self.assertGreater(cavities, 5)
        self.assertEqual(len(poly.holes), cavities)
        volumes = [poly.volume(marker) for marker in range(2, cavities + 2)]
        self.assertLess(max(volumes), 0)
        for large, small in zip(volumes, volumes[1:]):  # the largest first, by the volume behind the triangles
            self.assertLess(large, 0.97 * small)
        for n, hole in enumerate(poly.holes[:6] + poly.holes[-2:]):
            marker = n + 2 if n < 6 else cavities - 6 + n
            self.assertAlmostEqual(poly.winding(hole, marker), -1, 6)
            self.assertAlmostEqual(poly.winding(hole), 0, 6)

    def test_groups_of_gmsh(self):
        poly = self.make(CRAMBIN)
        for name, version in (("a.msh", "4.1"), ("a.msh2", "2.2")):
            found = Gmsh(self.folder / name)
            self.assertEqual(found.version, version)
            self.assertEqual(found.groups, {1: "outer wall", 2: "cavity 1"})
            for marker in found.groups:
                self.assertEqual(found.triangles[marker], list(poly.corners(marker)))

    def test_a_molecule_without_cavities(self):
        (self.folder / "two.xyzr").write_text("0 0 0 1.7\n9 0 0 1.2\n")
        poly = self.make("two.xyzr")
        self.assertEqual(set(poly.markers), {1})
        self.assertEqual(poly.holes, [])

    @needs("tetgen")
    def test_tetgen_leaves_the_cavity_empty(self):
        poly = self.make(CRAMBIN)
        subprocess.run(["tetgen", "-pQ", "a.poly"], cwd=self.folder, check=True, capture_output=True)
        rows = lambda name: [l.split() for l in (self.folder / name).read_text().splitlines()[1:] if not l.startswith("#")]
        vertices = {n: [float(v) for v in x[:3]] for n, *x in rows("a.1.node")}
        volume = volume_of_tetrahedra(vertices, [row[1:5] for row in rows("a.1.ele")])
        self.assertAlmostEqual(volume / poly.volume(), 1, delta=1e-6)

    @needs("gmsh")
    def test_gmsh_fills_both_versions(self):
        poly = self.make(CRAMBIN, "--voxel", 1)
        loops = "Surface Loop(1) = {1};\n" + "".join(f"Surface Loop({n}) = {{{n}}};\n" for n in range(2, max(poly.markers) + 1))
        for name in ("a.msh", "a.msh2"):
            (self.folder / "a.geo").write_text(
                f'Merge "{name}";\n{loops}Volume(1) = {{{", ".join(map(str, range(1, max(poly.markers) + 1)))}}};\nPhysical Volume("inside") = {{1}};\n')
            subprocess.run(["gmsh", "-3", "a.geo", "-o", "filled.msh", "-format", "msh2", "-v", "1"], cwd=self.folder, check=True, capture_output=True)
            lines = (self.folder / "filled.msh").read_text().splitlines()
            section = lambda what: [l.split() for l in lines[lines.index("$" + what) + 2:lines.index("$End" + what)]]
            vertices = {n: [float(v) for v in x] for n, *x in section("Nodes")}
            volume = volume_of_tetrahedra(vertices, [row[-4:] for row in section("Elements") if row[1] == "4"])
            self.assertAlmostEqual(volume / poly.volume(), 1, delta=1e-6)


if __name__ == "__main__":
    unittest.main()
