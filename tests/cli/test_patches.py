# SPDX-License-Identifier: MPL-2.0
"""Patches: connected pieces of the surface where a value is beyond a level."""

import collections
import csv
import json
import math
import unittest

from tool import CRAMBIN, FAST, ToolTest, read_ply


def area_of(a, b, c):
    u, v = [y - x for x, y in zip(a, b)], [y - x for x, y in zip(a, c)]
    return 0.5 * math.hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])


def above(points, values, level):
    """The polygon of a triangle where the linear function is above a level, with the values there."""
    out = []
    for k in range(3):
        (a, x), (b, y) = (values[k], points[k]), (values[(k + 1) % 3], points[(k + 1) % 3])
        if a > level:
            out.append((x, a))
        if (a > level) != (b > level):
            t = (level - a) / (b - a)
            out.append(([p + t * (q - p) for p, q in zip(x, y)], level))
    return out


def patches_of(mesh, name, level):
    """Area and integral of each connected piece above a level, cut triangle by triangle, the largest first."""
    names, vertices, triangles = read_ply(mesh)
    column = names.index(name)
    leader = list(range(len(vertices)))

    def find(v):
        while leader[v] != v:
            leader[v] = v = leader[leader[v]]
        return v

    for t in triangles:
        high = [v for v in t if vertices[v][column] > level]
        for v in high[1:]:
            leader[find(v)] = find(high[0])
    sums = collections.defaultdict(lambda: [0.0, 0.0])
    for t in triangles:
        polygon = above([vertices[v][:3] for v in t], [vertices[v][column] for v in t], level)
        for k in range(1, len(polygon) - 1):
            (a, x), (b, y), (c, z) = polygon[0], polygon[k], polygon[k + 1]
            one = area_of(a, b, c)
            sums[find(next(v for v in t if vertices[v][column] > level))][0] += one
            sums[find(next(v for v in t if vertices[v][column] > level))][1] += one * (x + y + z) / 3
    return sorted(sums.values(), reverse=True)


class Patches(ToolTest):
    def table(self, name):
        with open(self.folder / name, newline="") as file:
            return list(csv.DictReader(file))

    def test_areas_and_integrals_are_those_above_the_level(self):
        for value, attribute, level in (("hydrophobicity", "hydrophobicity", 0.5), ("bfactor", "bfactor", 8),
                                        ("mean-curvature", "mean_curvature", 0.15)):
            self.check(0, CRAMBIN, *FAST, "--color", value, "--patches", f"{value}>{level}", "-o", "a.ply", "-o", "a.patches.csv", "--force")
            rows = self.table("a.patches.csv")
            wanted = patches_of((self.folder / "a.ply").read_bytes(), attribute, level)
            self.assertEqual(len(rows), len(wanted), value)
            self.assertGreater(len(rows), 1, value)
            whole = sum(area for area, _ in wanted)
            for row, (area, integral) in zip(rows, wanted):
                self.assertAlmostEqual(float(row["area"]), area, delta=1e-6 * whole)
                self.assertAlmostEqual(float(row["integral_A2"]), integral, delta=1e-6 * whole * level)
                self.assertAlmostEqual(float(row["mean"]), integral / area, delta=1e-3)
                self.assertEqual((row["value"], row["side"], float(row["level"])), (attribute, "above", level))
                self.assertEqual(len(row["residues"].split()), int(row["residue_count"]))
                self.assertEqual(len(row["atom_ids"].split()), int(row["atoms"]))
            self.assertAlmostEqual(sum(float(row["area"]) for row in rows), whole, delta=1e-6 * whole)

    def test_both_sides_of_a_level_are_the_whole_mesh(self):
        sums = 0
        for side in "<>":
            self.check(0, CRAMBIN, *FAST, "--patches", f"radius{side}10", "-o", "b.json", "--areas", "patches", "--force")
            report = json.loads((self.folder / "b.json").read_text())
            rows = report["areas"]["patches"]
            self.assertEqual({row["side"] for row in rows}, {"below" if side == "<" else "above"})
            sums += sum(row["area"] for row in rows)
        self.assertAlmostEqual(sums, report["surface"]["triangle_area"], delta=1e-6 * sums)

    def test_a_turned_molecule_has_the_same_patches(self):
        lines = CRAMBIN.read_text().splitlines()
        areas = []
        for pose in range(5):
            c, s = math.cos(pose), math.sin(pose)
            turned = []
            for line in lines:
                if line.startswith("ATOM"):
                    x, y, z = (float(line[k:k + 8]) for k in (30, 38, 46))
                    x, y = c * x - s * y, s * x + c * y
                    y, z = c * y - s * z, s * y + c * z
                    line = f"{line[:30]}{x:8.3f}{y:8.3f}{z:8.3f}{line[54:]}"
                turned.append(line)
            (self.folder / "t.pdb").write_text("\n".join(turned) + "\n")
            self.check(0, "t.pdb", "--patches", "hydrophobicity>0", "-o", "t.patches.csv", "--force")
            rows = self.table("t.patches.csv")
            areas.append([float(row["area"]) for row in rows[:2]] + [sum(float(row["area"]) for row in rows)])
        for column in zip(*areas):
            self.assertLess(max(column) - min(column), 0.01 * max(column), column)

    def test_residues_have_their_areas_in_patches_as_b_factors(self):
        self.check(0, CRAMBIN, *FAST, "--patches", "hydrophobicity>0", "-o", "b.patches.csv", "-o", "b.patches.pdb", "-o", "b.patches.cif")
        of_residue = {}
        for line in (self.folder / "b.patches.pdb").read_text().splitlines():
            if line.startswith("ATOM"):
                of_residue.setdefault(line[21:27], set()).add(float(line[60:66]))
        self.assertTrue(all(len(areas) == 1 for areas in of_residue.values()))
        rows = self.table("b.patches.csv")
        whole = sum(float(row["area"]) for row in rows)
        self.assertAlmostEqual(sum(sum(areas) for areas in of_residue.values()), whole, delta=0.005 * len(of_residue))
        named = {name[1:] for row in rows for name in row["residues"].split()}
        bare = [place for place, areas in of_residue.items() if areas == {0.0}]
        self.assertFalse([place for place in bare if place[1:].strip() in named])
        self.assertIn("_atom_site.B_iso_or_equiv", (self.folder / "b.patches.cif").read_text())

    def test_colours_name_the_largest(self):
        self.check(0, CRAMBIN, *FAST, "--patches", "hydrophobicity>0", "--color", "patch", "-o", "c.ply", "-o", "c.legend.svg", "-o",
                   "c.patches.csv", says="patches: ")
        names, vertices, _ = read_ply((self.folder / "c.ply").read_bytes())
        rows = self.table("c.patches.csv")
        column, red = names.index("patch"), names.index("red")
        colors = {vertex[column]: vertex[red:red + 3] for vertex in vertices}
        self.assertEqual(set(colors), set(range(len(rows) + 1)))
        self.assertEqual(len({colors[k] for k in range(min(len(rows), 3) + 1)}), min(len(rows), 3) + 1)
        self.assertIn(f"1: {float(rows[0]['area']):.0f} Å²", (self.folder / "c.legend.svg").read_text())

    def test_refused(self):
        for words, says in ((["--patches", "hydrophobicity"], "hydrophobicity>0"), (["--patches", "hydrophob>0"], "did you mean hydrophobicity"),
                            (["--patches", "charge>nan"], "VALUE>NUMBER"), (["--color", "patch"], "--patches"),
                            (["--patches", "table=>1"], "--patches: expected table=FILE"),
                            (["--patches", "charge>0", "--group-by", "chain", "--split", "group"], "they are of one mesh")):
            self.check(2, CRAMBIN, *FAST, *words, "-o", "d.ply", says=says)
        self.check(2, CRAMBIN, *FAST, "-o", "d.patches.csv", says="--patches")
        self.check(1, CRAMBIN, *FAST, "--patches", "charge>0", "-o", "d.patches.csv", says="no charges")
        self.check(0, CRAMBIN, *FAST, "--patches", "hydrophobicity>0", "-o", "d.ply", says="--patches is for .patches.csv, .patches.pdb")


if __name__ == "__main__":
    unittest.main()
