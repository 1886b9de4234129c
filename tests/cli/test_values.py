# SPDX-License-Identifier: MPL-2.0
"""Colours by the values of atoms."""

import json
import math
import struct
import unittest

from needs import needs
from tool import CRAMBIN, DATA, FAST, ToolTest, read_ply, read_png

GREY = (190, 190, 190)  # of what is alike
NONE = (172, 204, 180)  # of what has no value


def atom(i, residue, x, b=0.0, name="CA", chain="A", occupancy=1.0, record="ATOM  "):
    return (f"{record}{i:5}  {name:<3} {residue} {chain}{i:4}    {x:8.3f}{0:8.3f}{0:8.3f}"
            f"{occupancy:6.2f}{b:6.2f}           C  \n")


class Values(ToolTest):
    def write(self, name, text):
        (self.folder / name).write_text(text)

    def vertices(self, name, attribute):
        """(place, value, colour) of each vertex."""
        names, vertices, _ = read_ply((self.folder / name).read_bytes())
        value, red = names.index(attribute), names.index("red")
        return [(v[:3], v[value], v[red:red + 3]) for v in vertices]

    def at(self, vertices, x):
        """The values and colours of the vertices nearest to the atom at x."""
        near = [v for v in vertices if abs(v[0][0] - x) < 1.0]
        self.assertTrue(near)
        return {v[1] for v in near}, {v[2] for v in near}

    def apart(self, residues, **more):
        self.write("a.pdb", "".join(
            atom(i + 1, residue, 10.0 * i, **{k: v[i] for k, v in more.items()})
            for i, residue in enumerate(residues)))

    def colored(self, word, *words):
        self.check(0, "a.pdb", *FAST, "--hetero", "--color", word, *words, "-o", "a.ply", "--force")

    def test_hydrophobicity(self):
        self.apart(["ILE", "ARG", "GLY", "HEM"])
        self.colored("hydrophobicity")
        found = self.vertices("a.ply", "hydrophobicity")
        self.assertEqual(self.at(found, 0.0), ({4.5}, {(178, 24, 43)}))
        self.assertEqual(self.at(found, 10.0), ({-4.5}, {(33, 102, 172)}))
        values, _ = self.at(found, 20.0)
        self.assertAlmostEqual(values.pop(), -0.4, 5)
        values, colors = self.at(found, 30.0)
        self.assertTrue(all(math.isnan(v) for v in values))
        self.assertEqual(colors, {NONE})

    def test_nucleotides(self):
        self.apart([" DA", "  C", "  G", "  U", "ALA", " DI"], name=["N1 "] * 6)
        self.colored("nucleotide", "-o", "a.html")
        names, vertices, _ = read_ply((self.folder / "a.ply").read_bytes())
        red = names.index("red")
        found = {round(v[0] / 10.0): v[red:red + 3] for v in vertices}
        self.assertEqual(found, {0: (213, 94, 0), 1: (240, 228, 66), 2: (0, 158, 115), 3: (0, 114, 178),
                                 4: GREY, 5: GREY})
        self.assertIn("Nucleotide", (self.folder / "a.html").read_text())
        # By kind all five are nucleic acids.
        self.colored("residue-type")
        names, vertices, _ = read_ply((self.folder / "a.ply").read_bytes())
        found = {round(v[0] / 10.0): v[red:red + 3] for v in vertices}
        self.assertEqual({found[i] for i in (0, 1, 2, 3, 5)}, {(86, 180, 233)})
        self.assertEqual(found[4], (153, 153, 153))

    def test_values_that_the_input_lacks(self):
        self.write("a.pqr", "ATOM 1 CA ALA A 1 0.0 0.0 0.0 0.1 1.5\n")
        for word, what in ("bfactor", "B factors"), ("occupancy", "occupancies"):
            self.check(1, "a.pqr", "--color", word, "-o", "a.ply", says=f"it has no {what}")
        self.check(2, "a.pqr", "--color", "table=", "-o", "a.ply", says="expected table=FILE")

    def test_a_range_takes_b_factors_for_what_they_are(self):
        text = "".join(atom(2 * i + k + 1, "ALA", 10.0 * i + 2.0 * k, 30.0 + i, name=name).replace(
            f"A{2 * i + k + 1:4}", f"A{i + 1:4}") for i in range(3) for k, name in enumerate(("CA", "CB")))
        self.write("a.pdb", text)
        self.colored("bfactor")
        self.assertIn("plddt", read_ply((self.folder / "a.ply").read_bytes())[0])
        self.colored("bfactor", "--range", "0,40")
        self.assertIn("bfactor", read_ply((self.folder / "a.ply").read_bytes())[0])

    def test_tables_that_do_not_fit(self):
        self.apart(["ALA", "GLY"])
        for text, says in (("A 1 1\nA 1 2\n", 't.txt:2: expected one value for each, got a second one for "A 1"'),
                           ("A 1 nan\n", "t.txt:1: expected"),
                           ("A 1 1e400\n", "t.txt:1: expected"),
                           ("B 7 1\n", 't.txt: none of its atoms is there: it has those of chain "B", 7')):
            self.write("t.txt", text)
            self.check(1, "a.pdb", "--color", "table=t.txt", "-o", "b.ply", says=says)

    @needs("openvdb")
    def test_the_number_as_a_grid(self):
        """`value` is what the vertices have, on the voxels of `Cd`; a file read again gives it back."""
        import pyopenvdb
        self.check(2, CRAMBIN, "--fields", "value", "-o", "a.vdb", says="--fields value: expected --color by a value or")
        self.check(2, CRAMBIN, "--fields", "value", "--color", "chain", "-o", "a.vdb", says="[hint: --color bfactor")
        self.check(0, CRAMBIN, *FAST, "--color", "bfactor", "--fields", "all,value", "-o", "a.vdb", "-o", "a.ply")
        value, colors = (pyopenvdb.read(str(self.folder / "a.vdb"), name) for name in ("value", "Cd"))
        self.assertEqual((value["attribute"], value["unit"]), ("bfactor", "Å²"))
        self.assertEqual(value.activeVoxelCount(), colors.activeVoxelCount())
        # On the vertices it is within what differs over a voxel; they are beside atoms of 1.7 to 10 Å².
        at = value.getConstAccessor()
        names, vertices, _ = read_ply((self.folder / "a.ply").read_bytes())
        column = names.index("bfactor")
        off = [abs(at.getValue(tuple(map(round, v[:3]))) - v[column]) for v in vertices]
        self.assertLess(sum(off) / len(off), 0.3)
        spread = [v[column] for v in vertices]
        self.assertGreater(max(spread) - min(spread), 5.0)
        self.check(0, "convert", "a.vdb", "-o", "b.ply")
        names, again, _ = read_ply((self.folder / "b.ply").read_bytes())
        column = names.index("bfactor")
        same = sum(v[column] == at.getValue(tuple(map(round, v[:3]))) for v in again)
        self.assertGreater(same, 0.99 * len(again))  # but for places half a voxel from two

    @needs("openvdb")
    def test_the_number_in_bricks(self):
        import pyopenvdb
        words = [CRAMBIN, *FAST, "--surface", "sas", "--color", "bfactor", "--flat-values",
                 "--fields", "value"]
        self.check(0, *words, "-o", "a.vdb")
        self.check(0, "bricks", "plan", *words, "--bricks", "2", "-o", "p.json")
        for k in (1, 2):
            self.check(0, "bricks", "run", "p.json", k)
        self.check(0, "bricks", "merge", "p.json", "-o", "b.vdb")
        whole, parts = (pyopenvdb.read(str(self.folder / name), "value") for name in ("a.vdb", "b.vdb"))
        values = {tuple(item.min): item.value for item in whole.citerOnValues()}
        found = {tuple(item.min): item.value for item in parts.citerOnValues()}
        self.assertEqual(len(values), len(found))
        self.assertTrue(values == found)  # without a list of all that differ

    def test_maps_that_do_not_fit(self):
        head = ("object 1 class gridpositions counts 2 2 2\norigin {0} {0} {0}\ndelta 40 0 0\ndelta 0 40 0\n"
                "delta 0 0 40\nobject 3 class array type double rank 0 items 8 data follows\n")
        self.apart(["ALA"])
        for values, says in (("1 2 3\n4 5 6\n7 8\n9\n", "expected no more than 8 values"),
                             ("1 2 3\n4 5 nan\n7 8\n", "expected numbers")):
            self.write("m.dx", head.format(-20) + values)
            self.check(1, "a.pdb", "--color", "potential=m.dx", "-o", "b.ply", says=says)
        self.write("m.dx", head.format(900) + "1 2 3\n4 5 6\n7 8\n")
        self.check(0, "a.pdb", *FAST, "--color", "potential=m.dx", "-o", "b.ply",
                   says="Potential: no point of the surface has one")

    def test_plain(self):
        self.check(0, CRAMBIN, *FAST, "--color", "plain=#ff8000", "-o", "a.ply", "-o", "a.png")
        names, vertices, _ = read_ply((self.folder / "a.ply").read_bytes())
        red = names.index("red")
        self.assertEqual({v[red:red + 3] for v in vertices}, {(255, 128, 0)})
        self.check(2, CRAMBIN, "--color", "plain=#ff80", "-o", "a.glb", says="got '#ff80'")

    def test_means_of_residues(self):
        self.check(0, CRAMBIN, *FAST, "--color", "hydrophobicity", "-o", "a.residues.csv", "-o", "a.ply")
        self.check(0, CRAMBIN, "--surface", "sas", "--color", "bfactor", "-o", "b.residues.csv", "-o", "b.atoms.csv")
        scale = {"THR": -0.7, "CYS": 2.5, "ARG": -4.5, "ILE": 4.5}
        rows = self.table("a.residues.csv")
        for row in rows:
            if row["residue"] in scale and float(row["area"]) > 1.0:
                self.assertAlmostEqual(float(row["mean_hydrophobicity"]), scale[row["residue"]], 5)
        # The mean by area of the atoms' B factors.
        b = [float(line[60:66]) for line in CRAMBIN.read_text().splitlines() if line.startswith("ATOM")]
        sums = {}
        for row in self.table("b.atoms.csv"):
            area, all_areas = sums.get(row["number"], (0.0, 0.0))
            sums[row["number"]] = (area + float(row["area"]) * b[int(row["atom_id"])],
                                   all_areas + float(row["area"]))
        for row in self.table("b.residues.csv"):
            weighted, area = sums[row["number"]]
            self.assertEqual(row["mean_bfactor"] == "", area == 0.0)
            if area > 0.0:
                self.assertAlmostEqual(float(row["mean_bfactor"]), weighted / area, 4)
            self.assertAlmostEqual(float(row["integral_bfactor_A2"]), weighted, delta=1e-5 * area + 1e-9)

    def test_b_factors_and_a_range(self):
        self.apart(["ALA", "ALA", "ALA"], b=[5.0, 20.0, 65.0])
        self.colored("bfactor", "--range", "0,40")
        found = self.vertices("a.ply", "bfactor")
        self.assertEqual(self.at(found, 20.0), ({65.0}, {(253, 231, 37)}))  # above the range
        self.colored("occupancy")
        self.assertEqual(self.at(self.vertices("a.ply", "occupancy"), 0.0)[0], {1.0})

    def test_a_predicted_model(self):
        steps = {95.0: (0, 83, 214), 80.0: (101, 203, 243), 60.0: (255, 219, 19),
                 30.0: (255, 125, 69)}
        text, i = "", 0
        for n, b in enumerate(steps):
            for k in range(4):
                i += 1
                text += (f"ATOM  {i:5}  C{k}  ALA A{n + 1:4}    {10.0 * n + k * 0.5:8.3f}"
                         f"{0:8.3f}{0:8.3f}{1:6.2f}{b:6.2f}           C  \n")
        self.write("a.pdb", text)
        self.check(0, "a.pdb", *FAST, "--color", "bfactor", "-o", "a.ply", "-o", "a.png",
                   says="pLDDT of a predicted model")
        found = self.vertices("a.ply", "plddt")
        for n, (b, color) in enumerate(steps.items()):
            self.assertEqual(self.at(found, 10.0 * n), ({b}, {color}))

    def test_steps_have_no_colours_between(self):
        """A value beside an edge, too: palettes of steps have only their colours."""
        steps = {89.99: (101, 203, 243), 90.0: (0, 83, 214), 69.7: (255, 219, 19), 49.3: (255, 125, 69), 50.0: (255, 219, 19)}
        self.apart(["ALA"] * len(steps), b=list(steps))
        self.colored("bfactor", "--palette", "plddt", "--range", "0,100")
        found = self.vertices("a.ply", "bfactor")
        for n, color in enumerate(steps.values()):
            self.assertEqual(self.at(found, 10.0 * n)[1], {color})

    def test_every_vertex_has_a_value_if_all_atoms_have(self):
        self.check(0, CRAMBIN, "--voxel", 0.7, "--surface", "sas", "--color", "bfactor", "-o", "a.ply")
        names, vertices, _ = read_ply((self.folder / "a.ply").read_bytes())
        self.assertFalse([v for v in vertices if v[names.index("bfactor")] != v[names.index("bfactor")]])

    def test_rainbow_and_radius(self):
        self.apart(["ALA"] * 5)
        self.colored("rainbow")
        found = self.vertices("a.ply", "rainbow")
        self.assertEqual(self.at(found, 0.0), ({0.0}, {(48, 18, 59)}))
        self.assertEqual(self.at(found, 20.0)[0], {0.5})
        self.assertEqual(self.at(found, 40.0), ({1.0}, {(122, 4, 3)}))
        self.colored("radius")
        for place, value, _ in self.vertices("a.ply", "radius"):
            self.assertAlmostEqual(value, math.dist(place, (20.0, 0.0, 0.0)), 3)

    def test_depth_is_that_of_the_table(self):
        self.check(0, CRAMBIN, *FAST, "--surface", "ses", "--color", "depth", "--flat-values", "--fields", "depth", "-o", "a.ply",
                   "-o", "a.atoms.csv", "-o", "a.residues.csv", "-o", "a.vdb")
        rows = self.table("a.atoms.csv")
        depths = [float(row["depth_A"]) for row in rows]
        self.assertGreater(min(depths), 1.3)
        self.assertTrue(4.0 < max(depths) < 7.0)
        known = {round(d, 3) for d in depths}
        for _, value, _ in self.vertices("a.ply", "depth")[::50]:
            self.assertTrue(any(abs(value - d) < 2e-3 for d in known), value)
        first = self.table("a.residues.csv")[0]
        own = [row for row in rows if row["number"] == first["number"]]
        self.assertAlmostEqual(float(first["depth_A"]), sum(float(r["depth_A"]) for r in own) / len(own), 9)
        self.assertEqual(first["ca_depth_A"], *(r["depth_A"] for r in own if r["atom"] == "CA"))
        self.assertIn(" depth", self.check(0, "info", "a.vdb").stdout.decode())

    def test_depth_is_made_where_it_is_asked_for(self):
        self.check(0, CRAMBIN, *FAST, "-o", "a.atoms.csv", "-o", "a.residues.csv")
        for name in ("a.atoms.csv", "a.residues.csv"):
            self.assertFalse({"depth_A", "ca_depth_A"} & set(self.table(name)[0]), name)
        self.check(0, CRAMBIN, *FAST, "--fields", "depth", "-o", "a.ply", "--force",
                   says="--fields depth: none of the files can hold that")

    def test_charges(self):
        self.write("a.pqr", "ATOM 1 N LYS 1 0.0 0.0 0.0 0.8 1.8\n"
                            "ATOM 2 O GLU 2 10.0 0.0 0.0 -0.8 1.6\n")
        self.check(0, "a.pqr", *FAST, "--color", "charge", "-o", "a.ply")
        found = self.vertices("a.ply", "charge")
        self.assertEqual(self.at(found, 0.0)[1], {(33, 102, 172)})   # blue is positive
        self.assertEqual(self.at(found, 10.0)[1], {(178, 24, 43)})
        self.check(1, CRAMBIN, "--color", "charge", "-o", "b.ply", says="no charges")

    def test_a_table(self):
        self.apart(["ALA", "GLY", "SER"])
        self.write("t.csv", "chain,residue,value\n# conservation\nA,1,0.25\nA,3,CA,1.0\nB,7,2\n")
        self.check(0, "a.pdb", *FAST, "--color", "table=t.csv", "--range", "0,1", "-o", "a.ply",
                   "-o", "a.glb", "-o", "a.html", says=["as of B 7", "atoms have none and are pale green"])
        found = self.vertices("a.ply", "value")
        self.assertEqual(self.at(found, 0.0)[0], {0.25})
        self.assertEqual(self.at(found, 20.0), ({1.0}, {(253, 231, 37)}))
        self.assertEqual(self.at(found, 10.0)[1], {NONE})
        data = (self.folder / "a.glb").read_bytes()  # glTF has no NaN
        size, = struct.unpack("<I", data[12:16])
        scene = json.loads(data[20:20 + size])
        self.assertIn("_VALUE", scene["meshes"][0]["primitives"][0]["attributes"])
        self.write("bad.csv", "A,1,0.25\nA,x,3\n")
        self.check(1, "a.pdb", "--color", "table=bad.csv", "-o", "b.ply", says=["bad.csv:2", "A,x,3"])
        self.check(1, "a.pdb", "--color", "table=none.csv", "-o", "b.ply", says="none.csv")

    def dx(self, name, of, low=-6.0, points=25, step=1.5):
        """A map of a function of x, y and z, as APBS writes it."""
        lines = ["# a potential", f"object 1 class gridpositions counts {points} {points} {points}",
                 f"origin {low:e} {low:e} {low:e}", f"delta {step:e} 0.0 0.0",
                 f"delta 0.0 {step:e} 0.0", f"delta 0.0 0.0 {step:e}",
                 f"object 2 class gridconnections counts {points} {points} {points}",
                 f"object 3 class array type double rank 0 items {points ** 3} data follows"]
        at = [low + step * i for i in range(points)]
        values = [of(x, y, z) for x in at for y in at for z in at]
        lines += [" ".join(f"{v:e}" for v in values[i:i + 3]) for i in range(0, len(values), 3)]
        lines += ['attribute "dep" string "positions"', 'object "regular" class field']
        self.write(name, "\n".join(lines) + "\n")

    def test_a_potential(self):
        self.apart(["ALA", "ALA"])
        self.dx("phi.dx", lambda x, y, z: 0.5 * x - 0.25 * y + z)
        self.colored("potential=phi.dx", "--potential-offset", "0")
        for (x, y, z), value, _ in self.vertices("a.ply", "potential"):
            self.assertAlmostEqual(value, 0.5 * x - 0.25 * y + z, 3)
        # The distance from the first atom, a probe radius out.
        self.dx("r.dx", lambda x, y, z: x)
        self.colored("potential=r.dx", "--probe", "2")
        for (x, _, _), value, _ in self.vertices("a.ply", "potential"):
            middle = 0.0 if x < 5 else 10.0
            self.assertAlmostEqual(value, x + 2 * (x - middle) / 1.7, 0)
        # Outside of the map there is no value.
        self.dx("small.dx", lambda x, y, z: x, points=6)
        self.colored("potential=small.dx", "--potential-offset", "0", "--range=-2,2", "-o", "a.vdb", "--fields", "Cd")
        found = self.vertices("a.ply", "potential")
        self.assertEqual(self.at(found, 10.0)[1], {NONE})
        self.assertNotIn(NONE, self.at(found, 0.0)[1])
        self.write("bad.dx", "object 1 class gridpositions counts 2 2 1\n")
        self.check(1, "a.pdb", "--color", "potential=bad.dx", "-o", "b.ply", says="bad.dx:1")
        text = (self.folder / "small.dx").read_text()
        self.write("short.dx", text[:len(text) // 2])
        self.check(1, "a.pdb", "--color", "potential=short.dx", "-o", "b.ply", says="216")
        self.check(1, "a.pdb", "--color", "potential=a.pdb", "-o", "b.ply", says="OpenDX")

    def test_values_run_smoothly_between_atoms(self):
        self.write("a.pdb", "".join(atom(i + 1, "ALA", 1.5 * i, b=10.0 * i) for i in range(5)))
        def jumps(*words):
            self.colored("bfactor", "--range", "0,40", *words)
            names, vertices, faces = read_ply((self.folder / "a.ply").read_bytes())
            red = names.index("red")
            return max(abs(vertices[a][red + k] - vertices[b][red + k]) / max(math.dist(vertices[a][:3], vertices[b][:3]), 0.1)
                       for f in faces for a, b in zip(f, f[1:] + f[:1]) for k in range(3))
        # Of 255, per Å.
        self.assertLess(jumps(), 100)
        self.assertGreater(jumps("--flat-values"), 150)

    def test_residues_palettes_and_constants(self):
        self.write("a.pdb", "".join(atom(i + 1, "ALA", 10.0 * i, b=20.0 * i).replace(f"A{i + 1:4}", f"A{i // 2 + 1:4}")
                                    for i in range(4)))
        self.colored("bfactor", "--value-of", "residue", "--range", "10,50", "--palette", "cividis")
        found = self.vertices("a.ply", "bfactor")
        self.assertEqual(self.at(found, 10.0), ({10.0}, {(0, 34, 78)}))
        self.assertEqual(self.at(found, 20.0), ({50.0}, {(254, 232, 56)}))
        self.check(2, "a.pdb", "--color", "bfactor", "--palette", "viridi", "-o", "b.ply", says="viridis")
        self.check(2, "a.pdb", "--color", "bfactor", "--value-of", "chain", "-o", "b.ply", says="atom or residue")
        self.apart(["ALA", "ALA"], b=[3.0, 3.0])
        self.check(0, "a.pdb", *FAST, "--color", "bfactor", "-o", "b.ply", "-o", "b.png", "-o", "b.html",
                   says="B factor: all atoms have 3, which is grey [hint: --range]")
        self.assertEqual(self.at(self.vertices("b.ply", "bfactor"), 0.0), ({3.0}, {GREY}))

    def test_a_range_of_curvatures(self):
        self.apart(["ALA"])
        for low, high, color in ((0.0, 1.0, (31, 158, 137)), (-5.0, 0.1, (253, 231, 37))):
            self.colored("mean-curvature", f"--range={low},{high}", "--palette", "viridis")
            _, curvature, seen = self.vertices("a.ply", "mean_curvature")[0]
            self.assertAlmostEqual(curvature, 1 / 1.7, 1)
            self.assertLessEqual(max(abs(a - b) for a, b in zip(seen, color)), 25)
        self.check(0, CRAMBIN, "--voxel", "0.7", "-o", "c.vdb", "--fields", "spline")
        self.check(0, "convert", "c.vdb", "--color", "mean-curvature", "--range=-9,-8", "--palette", "viridis", "-o", "c.ply")
        self.assertEqual({v[2] for v in self.vertices("c.ply", "mean_curvature")}, {(253, 231, 37)})

    def test_the_legend_has_the_colours_of_the_scale(self):
        self.check(0, DATA / "1ubq.pdb" if (DATA / "1ubq.pdb").exists() else CRAMBIN, *FAST,
                   "--color", "hydrophobicity", "--size", "700", "-o", "a.png")
        width, rows = read_png((self.folder / "a.png").read_bytes())
        seen = {tuple(row[3 * x:3 * x + 3]) for row in rows for x in range(560, width)}
        for color in ((178, 24, 43), (33, 102, 172), (247, 247, 247)):
            self.assertLessEqual(min(max(abs(a - b) for a, b in zip(p, color)) for p in seen), 3)

    def test_wrong_calls(self):
        self.check(2, CRAMBIN, "--color", "nonsense", "-o", "a.ply", says=["bfactor", "nonsense"])
        self.check(2, CRAMBIN, "--color", "bfactor", "--range", "3,1", "-o", "a.ply", says="--range")
        self.check(0, CRAMBIN, *FAST, "--range", "1,3", "-o", "a.ply", says="--range is for")
        self.check(2, DATA / "1a8o.cif.gz", "--assembly", "1", "--instances", "--color", "radius",
                   "-o", "a.glb", says="--color radius")


class Smooth(ToolTest):
    def test_means_over_a_radius(self):
        """Of every vertex by all others, in one piece of surface."""
        self.check(0, CRAMBIN, "--voxel", "1", "--color", "bfactor", "-o", "a.ply")
        self.check(0, CRAMBIN, "--voxel", "1", "--color", "bfactor", "--smooth-colors", "4", "-o", "b.ply")
        names, rough, triangles = read_ply((self.folder / "a.ply").read_bytes())
        smooth = read_ply((self.folder / "b.ply").read_bytes())[1]
        column, red = names.index("bfactor"), names.index("red")
        areas = [0.0] * len(rough)
        for t in triangles:
            a, b, c = (rough[v][:3] for v in t)
            u, v = [y - x for x, y in zip(a, b)], [y - x for x, y in zip(a, c)]
            area = math.hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
            for corner in t:
                areas[corner] += area / 6
        for k in range(0, len(rough), 97):
            weights = [a * min(max((4 - math.dist(v[:3], rough[k][:3])) / a ** 0.5 + 0.5, 0), 1) for a, v in zip(areas, rough)]
            mean = sum(w * v[column] for w, v in zip(weights, rough)) / sum(weights)
            self.assertAlmostEqual(smooth[k][column], mean, 4)
        self.assertNotEqual([v[red:red + 3] for v in rough], [v[red:red + 3] for v in smooth])

    def test_refused(self):
        for words, says in ((["0.4"], "0.5 to 20"), (["3", "--flat-values"], "means over the surface are at vertices"),
                            (["3", "--fields", "Cd", "-o", "a.vdb"], "means over the surface are at vertices"),
                            (["3", "--group-by", "chain", "--split", "group"], "they are of one mesh"),
                            (["3", "--memory", "1M"], "they are of one mesh")):
            self.check(2, CRAMBIN, "--voxel", "1", "--color", "bfactor", "--smooth-colors", *words, "-o", "a.ply", says=says)
        self.check(0, CRAMBIN, "--voxel", "1", "--smooth-colors", "3", "-o", "b.ply", says="--smooth-colors is for --color by a value or a curvature")


if __name__ == "__main__":
    unittest.main()
