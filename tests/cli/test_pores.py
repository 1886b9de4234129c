# SPDX-License-Identifier: MPL-2.0
"""Pores: their table, profile, tube and report."""

import csv
import json
import math
import unittest
import xml.dom.minidom

from tool import DATA, ToolTest, read_ply, read_png

GRAMICIDIN = DATA / "1grm.pdb.gz"
ENDS = "0,-12.5,3 -> 0.06,12.5,3"


class Pores(ToolTest):
    def setUp(self):
        super().setUp()
        # HOLE's simple radii.
        (self.folder / "hole.radii").write_text("C 1.85\nN 1.75\nO 1.65\nS 2.0\nH 1.0\n")

    def table(self, name):
        """The rows: the first line has the names of the columns."""
        with open(self.folder / name, newline="") as file:
            return list(csv.DictReader(file))

    def test_gramicidin_is_as_wide_as_hole_says(self):
        self.check(0, GRAMICIDIN, "--radii", "hole.radii", "--pore", ENDS, "-o", "a.pore.csv", "-o", "a.json",
                      "-o", "a.pore.svg", "-o", "a.pore.png", "-o", "a.pore.ply", "-o", "a.pore.glb", "--surface", "ses",
                      says=["pore: narrowest 1.200 Å"])
        rows = self.table("a.pore.csv")
        self.assertEqual(list(rows[0])[:6], ["distance_A", "height_A", "x_A", "y_A", "z_A", "radius_A"])
        self.assertEqual(list(rows[0])[-4:], ["pore", "length_A", "conductance_pS", "resistivity_ohm_m"])
        self.assertEqual({row["pore"] for row in rows}, {"1"})
        radii = [float(row["radius_A"]) for row in rows]
        self.assertAlmostEqual(min(radii), 1.1996, delta=0.0005)
        narrowest = rows[radii.index(min(radii))]
        self.assertEqual(narrowest["bottleneck"], "1")
        self.assertIn("A/TRP13", narrowest["residues"].split())
        report = json.loads((self.folder / "a.json").read_text())["pore"]
        self.assertEqual(report["radius"], min(radii))
        self.assertEqual(report["profile"]["radius"], radii)
        # Ohm's rule, by the trapezoids of the table
        places = [float(row["distance_A"]) for row in rows]
        each = [1 / (math.pi * r * r) for r in radii]
        sum_ = sum((b - a) * (f + g) / 2 for a, b, f, g in zip(places, places[1:], each, each[1:]))
        self.assertAlmostEqual(report["conductance"], 1e12 / (0.0898 * sum_ * 1e10), places=6)
        self.assertAlmostEqual(float(rows[0]["conductance_pS"]), report["conductance"], places=6)
        self.assertEqual(float(rows[0]["length_A"]), places[-1])
        names, vertices, triangles = read_ply((self.folder / "a.pore.ply").read_bytes())
        self.assertIn("radius", names)
        edges = {(t[k], t[k - 1]) for t in triangles for k in range(3)}
        self.assertEqual(len(edges), 3 * len(triangles))
        self.assertEqual(edges, {(b, a) for a, b in edges})  # closed, and turned alike
        xml.dom.minidom.parse(str(self.folder / "a.pore.svg"))

    def test_it_is_found_by_itself_and_along_an_axis(self):
        for way in ((), ("--pore", "auto"), ("--pore", "y")):
            self.check(0, GRAMICIDIN, "--radii", "hole.radii", *way, "-o", "b.pore.csv", "--force")
            rows = self.table("b.pore.csv")
            self.assertAlmostEqual(min(float(row["radius_A"]) for row in rows), 1.1996, delta=0.0005)
        for row in rows:
            self.assertAlmostEqual(float(row["height_A"]), float(row["y_A"]), places=6)

    def test_all_pores_of_a_bundle_are_rows(self):
        """Three tubes side by side, one of them narrower: two pores and another way."""
        balls = []
        for x0, radius in ((-11, 4.3), (0, 4.3), (11, 3.9)):
            balls += [(x0 + radius * math.cos(k * math.pi / 6), radius * math.sin(k * math.pi / 6), z)
                      for z in range(-6, 7, 2) for k in range(12)]
        (self.folder / "three.xyzr").write_text("".join(f"{x} {y} {z} 2.35\n" for x, y, z in balls))
        self.check(0, "three.xyzr", "--pore", "z", "-o", "three.pore.csv", "-o", "three.json", "-o", "three.pore.ply",
                   says=["2 pores as wide within 5 %", "1 other way: 1.550 Å at (11.00", "along (0.000, 0.000, 1.000) it crosses"])
        rows = self.table("three.pore.csv")
        for number in ("1", "2"):
            own = [row for row in rows if row["pore"] == number]
            self.assertAlmostEqual(min(float(row["radius_A"]) for row in own), 1.95, places=6)
            self.assertEqual(float(own[0]["distance_A"]), 0)
        self.assertEqual({row["pore"] for row in rows}, {"1", "2"})
        report = json.loads((self.folder / "three.json").read_text())["pore"]
        self.assertEqual(len(report["bundle"]), 1)
        self.assertAlmostEqual(report["others"][0]["radius"], 1.55, places=5)
        self.assertGreater(report["crossed"], 0.6)
        _, _, triangles = read_ply((self.folder / "three.pore.ply").read_bytes())
        edges = {(t[k], t[k - 1]) for t in triangles for k in range(3)}
        self.assertEqual(edges, {(b, a) for a, b in edges})

    def test_threads_do_not_matter(self):
        for threads in (1, 2):
            self.check(0, GRAMICIDIN, "-j", threads, "-o", f"{threads}.pore.csv")
        self.assertEqual((self.folder / "1.pore.csv").read_bytes(), (self.folder / "2.pore.csv").read_bytes())

    def test_beads_and_frames(self):
        rings = [(4.3 * math.cos(k * math.pi / 6), 4.3 * math.sin(k * math.pi / 6), z) for z in range(-6, 7, 2) for k in range(12)]
        for name, plug in (("open", ()), ("closed", ((0, 0, 0),))):
            (self.folder / f"{name}.xyzr").write_text("".join(f"{x} {y} {z} 2.35\n" for x, y, z in [*rings, *plug]))
            self.check(0, f"{name}.xyzr", "--pore", "0,0,-7 -> 0,0,7", "-o", f"{name}.pore.csv")
        self.assertAlmostEqual(min(float(row["radius_A"]) for row in self.table("open.pore.csv")), 1.95, places=6)
        narrowest = min(self.table("closed.pore.csv"), key=lambda row: float(row["radius_A"]))
        self.assertLess(float(narrowest["radius_A"]), 0)
        self.assertAlmostEqual(float(narrowest["z_A"]), 0, delta=0.3)
        self.assertEqual({row["conductance_pS"] for row in self.table("closed.pore.csv")}, {""})
        self.check(0, "closed.xyzr", "--pore", "0,0,-7 -> 0,0,7", "-o", "closed.json", says=["no water passes below 1.15 Å"])
        self.assertIsNone(json.loads((self.folder / "closed.json").read_text())["pore"]["conductance"])
        self.check(0, DATA / "1d3z.pdb.gz", "--frames", "1-2", "--pore", "resid 30 -> resid 50", "-o", "f.pore.csv")
        lines = (self.folder / "f.pore.csv").read_text().splitlines()
        self.assertEqual({line.split(",")[0] for line in lines}, {"frame", "1", "2"})

    def test_ends_by_selections_are_of_the_model(self):
        line = "ATOM  %5d  C   ALA A%4d    %8.3f%8.3f%8.3f  1.00  0.00           C\n"
        text = ""
        for model, away in ((1, 0), (2, 100)):
            text += f"MODEL {model:8}\n"
            for n, z in enumerate(range(-6, 7, 2)):
                for k in range(12):
                    angle = k * math.pi / 6
                    text += line % (12 * n + k + 1, n + 1, away + 4.3 * math.cos(angle), 4.3 * math.sin(angle), z)
            text += "ENDMDL\n"
        (self.folder / "two.pdb").write_text(text)
        for model, away in ((1, 0), (2, 100)):
            self.check(0, "two.pdb", "--model", model, "--pore", "resid 1 -> resid 7", "-o", "m.pore.csv", "--force")
            for row in self.table("m.pore.csv"):
                self.assertAlmostEqual(float(row["x_A"]), away, delta=0.5)

    def test_frames_without_a_pore_have_no_rows(self):
        rings = [(4.3 * math.cos(k * math.pi / 6), 4.3 * math.sin(k * math.pi / 6), z) for z in range(-6, 7, 2) for k in range(12)]
        line = "HETATM%5d  C   LIG A   1    %8.3f%8.3f%8.3f  1.00  0.00           C\n"
        flat = [(x, y, 0.1 * z + 20) for x, y, z in rings]
        for first, name in (([rings, flat, rings], "2"), ([flat, rings], "1"), ([flat, flat], "")):
            (self.folder / "t.pdb").write_text("".join(
                f"MODEL {m:8}\n" + "".join(line % (i + 1, *at) for i, at in enumerate(frame)) + "ENDMDL\n" for m, frame in enumerate(first, 1)))
            args = ("t.pdb", "--frames", "all", "--surface", "sas", "--pore", "0,0,-7 -> 0,0,7", "-o", "t.pore.csv", "-o", "t.csv", "-o", "t.json",
                    "--force")
            if not name:
                (self.folder / "t.pore.csv").unlink()
                self.check(1, *args, says=["--pore: expected ends"])
                self.assertFalse((self.folder / "t.pore.csv").exists())
                continue
            self.check(0, *args, says=[f"no pore in frames {name} [--pore: expected ends"])
            title, *lines = (self.folder / "t.pore.csv").read_text().splitlines()
            self.assertTrue(title.startswith("frame,distance_A,"), title)
            self.assertEqual({int(line.split(",")[0]) for line in lines}, set(range(1, len(first) + 1)) - {int(name)})
            self.assertEqual(len((self.folder / "t.csv").read_text().splitlines()), len(first) + 1)
            self.assertIsNone(json.loads((self.folder / f"t.000{name}.json").read_text())["pore"])

    def test_what_is_wrong_is_said_in_a_line(self):
        for status, way, text in ((2, "0,0,0", "longer than 0"), (2, "q", "expected auto"), (2, "1,2,3 ->", "both sides of ->"),
                                  (2, "0.5,-9,3 -> 0.5,-9,3", "1 Å apart"), (1, "0,0,0 -> 0,12,3", "inside of atom_id"),
                                  (2, "resid 999 -> 0,12,3", "resid 999"), (1, "22,-12,3 -> 22,12,3", "found none that is not outside"),
                                  (1, "100,100,100 -> 105,100,100", "expected ends within 20 Å of the molecule"),
                                  (1, "0,500,3 -> 0,-500,3", "expected ends within 20 Å of the molecule"),
                                  (1, "16,20,20 -> 21,20,20", "found none that is not outside"),
                                  (2, "0,0,0 -> 1e9,0,0", "expected X,Y,Z"), (2, "nan,0,0 -> 0,12,3", "expected X,Y,Z"),
                                  (2, "0 0 -12 -> 0 0 12", "expected X,Y,Z"), (2, "1,2 -> 0,12,3", "or a selection, got"),
                                  (1, "x", "found none")):
            self.check(status, GRAMICIDIN, "--pore", way, "-o", "bad.pore.csv", says=["--pore", text])
            self.assertFalse((self.folder / "bad.pore.csv").exists())
        self.check(2, GRAMICIDIN, "-o", ".pore.csv", says=["expected a name in front of .pore.csv"])


class Tunnels(ToolTest):
    """A chamber from which square shafts lead out: along x as wide as a ball of 1.5 Å, along y of 2.5 Å."""

    def setUp(self):
        super().setUp()
        places = range(-9, 10)
        self.balls = [(x, y, z) for x in places for y in places for z in places
                      if not (max(abs(x), abs(y), abs(z)) < 4 or (x > 0 and max(abs(y), abs(z)) < 3)
                              or (y > 0 and max(abs(x), abs(z)) < 4))]
        (self.folder / "two.xyzr").write_text("".join(f"{x} {y} {z} 1.5\n" for x, y, z in self.balls))

    def table(self, name):
        with open(self.folder / name, newline="") as file:
            return list(csv.DictReader(file))

    def test_each_way_out_of_a_chamber_is_a_tunnel(self):
        names = [f"a.{end}" for end in ("tunnels.csv", "json", "tunnels.ply", "tunnels.obj", "tunnels.glb", "tunnels.pdb",
                                        "tunnels.cif", "tunnels.cxc", "tunnels.pml")]
        self.check(0, "two.xyzr", "--tunnels-from", "0,0,0", "--surface", "ses", "--voxel", 1,
                   *(word for name in names for word in ("-o", name)),
                   says=["tunnels: 2 from (", "the widest: 2.500 Å at (", "curvature 1."])
        rows = self.table("a.tunnels.csv")
        self.assertEqual(list(rows[0]), ["tunnel", "distance_A", "x_A", "y_A", "z_A", "radius_A", "bottleneck", "residues", "atom_ids",
                                         "bottleneck_A", "length_A", "curvature", "hydrophobicity", "charge", "probe_A", "probe_out_A"])
        self.assertEqual({row["tunnel"] for row in rows}, {"1", "2"})
        report = json.loads((self.folder / "a.json").read_text())["tunnels"]
        self.assertEqual((report["probe"], report["probe_out"]), (0.9, 4))
        for number, expected, along, across in (("1", 2.5, "y_A", "x_A"), ("2", 1.5, "x_A", "y_A")):
            own = [row for row in rows if row["tunnel"] == number]
            radii = [float(row["radius_A"]) for row in own]
            self.assertAlmostEqual(min(radii), expected, places=5)
            self.assertEqual({float(row["bottleneck_A"]) for row in own}, {min(radii)})
            self.assertEqual(own[radii.index(min(radii))]["bottleneck"], "1")
            self.assertGreater(float(own[-1][along]), 7)
            self.assertAlmostEqual(float(own[-1][across]), 0, delta=2)
            ends = [[float(row[key]) for key in ("x_A", "y_A", "z_A")] for row in (own[0], own[-1])]
            self.assertAlmostEqual(float(own[0]["curvature"]), float(own[-1]["distance_A"]) / math.dist(*ends), places=9)
            for row in own:
                place = [float(row[key]) for key in ("x_A", "y_A", "z_A")]
                self.assertAlmostEqual(float(row["radius_A"]), min(math.dist(place, ball) for ball in self.balls) - 1.5, places=6)
            of_report = report["list"][int(number) - 1]
            self.assertEqual(of_report["radius"], min(radii))
            self.assertEqual(of_report["profile"]["radius"], radii)
        # the other files have the same balls
        atoms = [line for line in (self.folder / "a.tunnels.pdb").read_text().splitlines() if line.startswith("HETATM")]
        self.assertEqual([int(line[22:26]) for line in atoms], [int(row["tunnel"]) for row in rows])
        for line, row in zip(atoms, rows):
            self.assertAlmostEqual(float(line[30:38]), float(row["x_A"]), delta=0.001)
            self.assertAlmostEqual(float(line[60:66]), float(row["radius_A"]), delta=0.006)
        cif = (self.folder / "a.tunnels.cif").read_text()
        profile = cif[cif.index("_sb_ncbr_channel_profile.charge"):].splitlines()[1:]
        self.assertEqual(len(profile), len(rows))
        self.assertEqual(float(profile[-1].split()[4]), 1)
        self.assertEqual([float(line.split()[1]) for line in profile], [round(float(row["radius_A"]), 4) for row in rows])
        self.assertEqual((self.folder / "a.tunnels.cxc").read_text().count("marker #1002 position "), len(own))
        self.assertEqual((self.folder / "a.tunnels.pml").read_text().count("pseudoatom tunnel_2,"), len(own))
        _, _, triangles = read_ply((self.folder / "a.tunnels.ply").read_bytes())
        edges = {(t[k], t[k - 1]) for t in triangles for k in range(3)}
        self.assertEqual(edges, {(b, a) for a, b in edges})
        self.assertIn("tunnel 2", (self.folder / "a.tunnels.glb").read_bytes().decode("latin-1"))

    def test_probes_say_what_is_a_tunnel(self):
        self.check(0, "two.xyzr", "--tunnels-from", "0,0,0", "--tunnel-probe", 2, "-o", "b.tunnels.csv", says="tunnels: 1 from")
        self.check(1, "two.xyzr", "--tunnels-from", "0,0,0", "--tunnel-probe", 2.6, "-o", "c.tunnels.csv", says="a smaller --tunnel-probe")
        self.check(1, "two.xyzr", "--tunnels-from", "0,0,0", "--probe-out", 2.4, "-o", "c.tunnels.csv", says="a larger --probe-out")
        self.check(2, "two.xyzr", "--tunnels-from", "0,0,0", "--tunnel-probe", 5, "-o", "c.tunnels.csv", says="less than --probe-out")

    def test_from_the_middle_of_a_channel_both_ends_are_ways_out(self):
        args = (GRAMICIDIN, "--tunnels-from", "resid 1")
        self.check(0, *args, "--surface", "ses", "--voxel", 1, "-o", "d.tunnels.csv", "-o", "d.json")
        rows = self.table("d.tunnels.csv")
        for number, end, residue in (("1", -12, "B/TRP13"), ("2", 12, "A/TRP13")):
            own = [row for row in rows if row["tunnel"] == number]
            self.assertAlmostEqual(float(own[0]["bottleneck_A"]), 1.337, delta=0.001)
            narrowest = min(own, key=lambda row: float(row["radius_A"]))
            self.assertIn(residue, narrowest["residues"].split())
            self.assertAlmostEqual(float(own[-1]["y_A"]), end, delta=1)
            self.assertEqual(float(own[0]["charge"]), 0)
            self.assertGreater(float(own[0]["hydrophobicity"]), 1)
            self.assertLess(float(own[0]["curvature"]), 1.1)
        for threads in (1, 2):
            self.check(0, *args, "-j", threads, "-o", f"{threads}.tunnels.csv")
        self.assertEqual((self.folder / "1.tunnels.csv").read_bytes(), (self.folder / "2.tunnels.csv").read_bytes())

    def test_a_tunnel_has_one_number_in_all_frames(self):
        """Plugs close the shafts of a chamber, in some of the frames, while the molecule turns."""
        places = range(-6, 7)
        walls = [(x, y, z) for x in places for y in places for z in places
                 if not (max(abs(x), abs(y), abs(z)) < 3 or (y > 0 and max(abs(x), abs(z)) < 3) or (x > 0 and abs(y) < 3 and -2 < z < 3))]
        plugs, parked = [(5, 0, 0.5), (0, 5, 0)], [(-4.9, -5, 0), (-5.1, -5, 1)]
        frames = (((), False), ((0,), True), ((), True), ((0, 1), False))
        text = ""
        for number, (closed, turned) in enumerate(frames, 1):
            text += f"MODEL {number:8}\n"
            for i, at in enumerate(walls + [plugs[k] if k in closed else parked[k] for k in (0, 1)]):
                x, y, z = (30 - at[1], at[0] - 7, at[2] + 1) if turned else at
                text += f"HETATM{i + 1:5}  C   UNK A{i + 1:4}    {x:8.3f}{y:8.3f}{z:8.3f}  1.00  0.00           C\n"
            text += "ENDMDL\n"
        (self.folder / "t.pdb").write_text(text)
        (self.folder / "own.radii").write_text("C 1.5\n")
        args = ("t.pdb", "--hetero", "--radii", "own.radii", "--frames", "all", "--tunnels-from", "resid 100+1700")
        names = [f"t.{end}" for end in ("tunnel_frames.csv", "tunnels.csv", "tunnels.pdb", "csv")]
        says = ["tunnels: 2 in all; the most often open: number 1, in 3 of 4 frames, 1.500 to 1.500 Å wide, mean 1.500 Å",
                "no tunnels in frames 4 [--tunnels-from: expected a way out of"]
        self.check(0, *args, *(word for name in names for word in ("-o", name)), says=says)
        rows = self.table("t.tunnel_frames.csv")
        self.assertEqual(list(rows[0]), ["tunnel", "frame", "open", "radius_A", "length_A", "curvature", "x_A", "y_A", "z_A", "residues",
                                         "open_share"])
        self.assertEqual([(row["tunnel"], row["frame"], row["open"]) for row in rows],
                         [(tunnel, str(n), "10"[k in closed]) for k, tunnel in ((1, "1"), (0, "2")) for n, (closed, _) in enumerate(frames, 1)])
        self.assertEqual({(row["tunnel"], row["open_share"]) for row in rows}, {("1", "0.75"), ("2", "0.5")})
        all_of = self.table("t.tunnels.csv")
        for row in rows:
            own = [other for other in all_of if (other["frame"], other["tunnel"]) == (row["frame"], row["tunnel"])]
            self.assertEqual({other["length_A"] for other in own}, {row["length_A"]} if row["open"] == "1" else set())
            if row["open"] == "0":
                self.assertEqual((row["radius_A"], row["residues"], row["x_A"]), ("", "", ""))
                continue
            self.assertAlmostEqual(float(row["radius_A"]), 1.5 if row["tunnel"] == "1" else 1.0495, places=4)
            narrowest = min(own, key=lambda other: float(other["radius_A"]))
            self.assertEqual([row[key] for key in ("x_A", "y_A", "z_A", "residues")], [narrowest[key] for key in ("x_A", "y_A", "z_A", "residues")])
        numbers = [{line[22:26].strip() for line in (self.folder / f"t.tunnels.000{n}.pdb").read_text().splitlines() if line.startswith("HETATM")}
                   for n in (1, 2, 3)]
        self.assertEqual(numbers, [{"1", "2"}, {"1"}, {"1", "2"}])
        self.assertFalse((self.folder / "t.tunnels.0004.pdb").exists())
        self.check(1, *args[:-1], "0,0,60", "-o", "bad.tunnel_frames.csv", says="reaches from outside")
        self.assertFalse((self.folder / "bad.tunnel_frames.csv").exists())
        self.check(2, *args[:4], *args[6:], "-o", "bad.tunnel_frames.csv", says=["--frames", "-o FILE.tunnels.csv for one"])
        self.check(2, *args[:6], "-o", "bad.tunnel_frames.csv", says="--tunnels-from")

    def test_pictures_show_tubes(self):
        args = (GRAMICIDIN, "--tunnels-from", "resid 1", "--surface", "ses", "--voxel", 1, "--color", "element")
        self.check(0, *args, "--opacity", 0.1, "--style", "flat", "--size", 80, "--legend", "auto", "-o", "t.png", "-o", "t.legend.svg")
        self.check(0, *args[:1], *args[3:], "--opacity", 0.1, "--style", "flat", "--size", 80, "-o", "none.png")

        def green(name):
            _, rows = read_png((self.folder / name).read_bytes())
            return sum(row[i + 1] > row[i] + 25 and row[i + 1] > row[i + 2] + 25 for row in rows for i in range(0, len(row), 3))
        self.assertGreater(green("t.png"), 60)
        self.assertEqual(green("none.png"), 0)
        legend = (self.folder / "t.legend.svg").read_text()
        self.assertLess(legend.index(">Tunnel<"), legend.index(">1.15 to 2.3 Å<"))
        self.assertNotIn("below 1.15", legend) # gramicidin is wider

    def test_what_is_wrong_is_said_in_a_line(self):
        for status, place, text in ((2, "1,2", "expected X,Y,Z"), (2, "resid 999", "resid 999"), (1, "0,0,60", "reaches from outside"),
                                    (1, "6,6,6", "a ball of 0.9 Å fits"), (2, "nan,0,0", "expected X,Y,Z")):
            self.check(status, "two.xyzr" if status == 1 else GRAMICIDIN, "--tunnels-from", place, "-o", "bad.tunnels.csv",
                       says=["--tunnels-from", text])
            self.assertFalse((self.folder / "bad.tunnels.csv").exists())
        self.check(2, "two.xyzr", "-o", "bad.tunnels.csv", says="--tunnels-from")


if __name__ == "__main__":
    unittest.main()
