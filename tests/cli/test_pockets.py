# SPDX-License-Identifier: MPL-2.0
"""Pockets: their table, report and grids."""

import csv
import json
import math
import re
import subprocess
import unittest

from needs import KVFINDER_PYTHON, needs
from tool import CRAMBIN, DATA, ToolTest, read_ply, read_png

DIMER = DATA / "1a8o.pdb.gz"
DETECT = """
import sys, numpy as np, pyKVFinder as k
balls = [line.split() for line in open(sys.argv[1])]
atoms = np.array([[str(i), "A", "ALA", "C", *ball] for i, ball in enumerate(balls)])
_, found = k.detect(atoms, k.get_vertices(atoms, 4.0, 0.6), 0.6, 1.4, 4.0, 2.4, 5.0, nthreads=1)
_, volumes, _ = k.spatial(found, 0.6, nthreads=1)
print(max(volumes.values(), default=0.0))
"""


class Pockets(ToolTest):
    def table(self, name):
        """The rows: the first line has the names of the columns."""
        with open(self.folder / name, newline="") as file:
            return list(csv.DictReader(file))

    def box(self, name, hole=lambda x: max(map(abs, x)) < 4):
        """Balls of 1.5 Å, an Å apart, with a hole."""
        places = range(-7, 8)
        balls = [(x, y, z) for x in places for y in places for z in places if not hole((x, y, z))]
        (self.folder / name).write_text("".join(f"{x} {y} {z} 1.5\n" for x, y, z in balls))

    def test_a_closed_cavity_has_the_volume_of_the_report(self):
        self.box("box.xyzr")
        self.check(0, "box.xyzr", "--surface", "ses", "-o", "box.pockets.csv", "-o", "box.json")
        rows = self.table("box.pockets.csv")
        asked = {"probe_in_A": "1.4", "probe_out_A": "4", "cut_A": "2.4", "neck": "0.55", "voxel_A": "0.5"}
        self.assertEqual(list(rows[0].items())[-5:], list(asked.items()))
        report = json.loads((self.folder / "box.json").read_text())
        self.assertEqual(len(rows), 1)
        self.assertEqual((rows[0]["open"], rows[0]["mouths"], rows[0]["residues"]), ("0", "0", ""))
        self.assertAlmostEqual(float(rows[0]["volume"]), report["surface"]["cavity_list"][0]["volume"], places=3)
        self.assertAlmostEqual(report["pockets"]["list"][0]["volume"], float(rows[0]["volume"]), places=3)
        self.assertEqual(report["pockets"]["probe_out"], 4)

    @needs("openvdb")
    def test_the_share_of_frames_in_which_it_is_open(self):
        import pyopenvdb as openvdb
        places = range(-6, 7)
        lines = []
        for model, hole in ((1, 4.5), (2, 3.5), (3, 0.5)):
            lines.append(f"MODEL     {model:4d}")
            for n, (x, y, z) in enumerate((x, y, z) for x in places for y in places for z in places):
                far = 40 if max(abs(x), abs(y), abs(z)) < hole else 0
                lines.append(f"HETATM{n % 99999 + 1:5d}  C   UNK A{n % 9999 + 1:4d}    {x + far:8.3f}{y + far:8.3f}{z + far:8.3f}  1.00  0.00           C")
            lines.append("ENDMDL")
        (self.folder / "three.pdb").write_text("\n".join(lines) + "\nEND\n")
        for more in ((), ("-o", "three.vdb", "--surface", "ses", "--fields", "pocket_depth")):
            self.check(0, "three.pdb", "--hetero", "--frames", "all", "--voxel", "0.7", "--pockets", *more, "--force",
                          "-o", "three.pockets.csv", "-o", "three.pockets.vdb")
            grid = openvdb.readAllGridMetadata(str(self.folder / "three.pockets.vdb"))[0]
            self.assertEqual(grid.name, "pocket_open")
            grid = openvdb.read(str(self.folder / "three.pockets.vdb"), "pocket_open")
            shares = {}
            for item in grid.citerOnValues():
                shares[round(item.value, 4)] = shares.get(round(item.value, 4), 0) + item.count
            self.assertEqual(set(shares), {0.3333, 0.6667})
            self.assertAlmostEqual(grid.getConstAccessor().getValue((0, 0, 0)), 2 / 3, places=5)
        self.check(2, "three.pdb", "--hetero", "-o", "one.pockets.vdb", says=["--frames"])

    def test_walls_of_pockets_have_colours(self):
        self.box("two.xyzr", lambda x: max(abs(abs(x[0]) - 3.5), abs(x[1]), abs(x[2])) < 2.6)
        self.check(0, "two.xyzr", "--surface", "ses", "--color", "pocket", "--voxel", "0.6", "-o", "two.ply", "-o", "two.png",
                      "-o", "two.html", "-o", "two.pockets.csv", "--opacity", "0.3", "--show-behind", "--size", "200")
        rows = self.table("two.pockets.csv")
        self.assertEqual(len(rows), 2)
        names, vertices, _ = read_ply((self.folder / "two.ply").read_bytes())
        at = names.index("pocket")
        for row in rows:
            own = [v for v in vertices if v[at] == int(row["pocket"])]
            x = sum(v[0] for v in own) / len(own)
            self.assertAlmostEqual(x, float(row["x_A"]), delta=0.1)
            self.assertEqual(len({v[-3:] for v in own}), 1)
        self.assertEqual(len({v[-3:] for v in vertices}), 3)  # and what is no pocket's
        outside = [v for v in vertices if max(map(abs, v[:3])) > 7]
        self.assertEqual({v[at] for v in outside}, {0})
        self.assertIn("1: ", (self.folder / "two.html").read_text())

    def test_pockets_that_the_surface_closes(self):
        words = ["--color", "pocket", "--voxel", "0.7", "-o", "a.ply", "-o", "a.pockets.csv", "--force"]
        self.check(0, CRAMBIN, *words, says="warning: --color pocket: 1 of 1 pocket has no wall on this surface [hint: --surface ses]")
        said = self.check(0, CRAMBIN, *words, "--surface", "ses")
        self.assertNotIn(b"no wall", said.stderr)

    def test_no_pocket_looks_like_what_is_none(self):
        self.check(0, DATA / "1ubq.pdb", "--surface", "ses", "--color", "pocket", "--pocket-cut", "0", "--voxel", "0.7", "-o", "a.ply")
        names, vertices, _ = read_ply((self.folder / "a.ply").read_bytes())
        at = names.index("pocket")
        colors = {v[at]: v[-3:] for v in vertices}
        self.assertGreater(max(colors), 8)
        for pocket, color in colors.items():
            (self.assertGreater if pocket else self.assertEqual)(max(color) - min(color), 30 if pocket else 0)

    def bodies(self, stem):
        """The volume of each mesh of a pocket, which has to be closed."""
        volumes = []
        while (path := self.folder / f"{stem}.pocket{len(volumes) + 1}.ply").exists():
            _, vertices, triangles = read_ply(path.read_bytes())
            edges = {(t[k], t[(k + 1) % 3]) for t in triangles for k in range(3)}
            self.assertEqual(len(edges), 3 * len(triangles))
            self.assertTrue(all((b, a) in edges for a, b in edges))
            six = 0.0
            for t in triangles:
                (a, b, c), (d, e, f), (g, h, i) = (vertices[v][:3] for v in t)
                six += a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)
            volumes.append(six / 6)
        return volumes

    def test_each_has_a_mesh(self):
        """Of the volume of the table, those that are split at a neck, too; other formats hold the same."""
        self.check(0, DATA / "bpti.pdb.gz", "--pocket-cut", "0.5", "-o", "b.pockets.ply", "-o", "b.pockets.csv")
        rows = self.table("b.pockets.csv")
        found = self.bodies("b")
        self.assertEqual(len(found), len(rows))
        self.assertTrue(any(row["neighbours"] for row in rows))
        for volume, row in zip(found, rows):
            exact = float(row["volume"])  # with the thin edge between wall and cut, which triangles cut off
            self.assertLess(volume, exact)
            self.assertGreater(volume, 0.94 * exact if exact > 100 else 0.5 * exact, row["pocket"])
        self.check(0, DATA / "bpti.pdb.gz", "--pocket-cut", "0.5", "--voxel", "0.5", "--surface", "ses", "-o", "c.pockets.ply", "-o", "c.vdb",
                   *(f"-oc.pockets.{word}" for word in ("obj", "stl", "off", "vtk", "glb")))
        self.assertEqual((self.folder / "c.pocket1.ply").read_bytes(), (self.folder / "b.pocket1.ply").read_bytes())
        self.assertNotIn("pocket_room", self.check(0, "info", "c.vdb").stdout.decode())
        self.assertEqual(len(list(self.folder.glob("c.pocket*"))), 6 * len(rows))

    def test_depths_do_not_depend_on_voxels(self):
        """Those of the same pockets; the deepest voxels lie up to 0.25 A higher."""
        words = [DIMER, "--assembly", "1", "--pocket-cut", "1.5"]
        depths = []
        for voxel in ("0.4", "0.55"):
            self.check(0, *words, "--voxel", voxel, "-o", "a.pockets.csv", "--force")
            depths.append([float(row["depth_A"]) for row in self.table("a.pockets.csv")[:2]])
        for a, b in zip(*depths):
            self.assertAlmostEqual(a, b, delta=0.01)

    def test_a_site_keeps_its_rank_and_neighbours(self):
        words = [DATA / "bpti.pdb.gz", "--pocket-cut", "0.5"]
        self.check(0, *words, "-o", "all.pockets.csv")
        rows = self.table("all.pockets.csv")
        self.assertTrue(all(row["rank"] == row["pocket"] for row in rows))
        row = next(row for row in rows[1:] if row["neighbours"])
        for other in row["neighbours"].split():
            self.assertIn(row["rank"], rows[int(other) - 1]["neighbours"].split())
        atom = row["atom_ids"].split()[0]
        self.check(0, *words, "--pocket-at", f"index {atom}", "-o", "one.pockets.csv", "-o", "one.json")
        one = self.table("one.pockets.csv")
        self.assertEqual(len(one), 1)
        same = rows[int(one[0]["rank"]) - 1]
        self.assertEqual({**same, "pocket": "1"}, one[0])
        listed = json.loads((self.folder / "one.json").read_bytes())["pockets"]["list"][0]
        self.assertEqual([listed["rank"], listed["neighbors"]], [int(same["rank"]), [int(n) for n in same["neighbours"].split()]])

    def test_the_mesh_of_a_site_and_of_none(self):
        self.check(0, DATA / "1ubq.pdb", "--pocket-at", "resid 60", "--pocket-cut", "0", "-o", "site.pockets.ply")
        self.assertEqual([n for n in self.names() if "pocket" in n], ["site.pocket1.ply"])
        self.check(0, CRAMBIN, "--pocket-cut", "9", "-o", "none.pockets.stl", says="pockets: 0")
        self.assertEqual([n for n in self.names() if n.startswith("none")], [])

    def test_meshes_are_refused_whole(self):
        words = [DATA / "bpti.pdb.gz", "--pocket-cut", "0.5", "-o", "a.pockets.ply"]
        (self.folder / "a.pocket2.ply").write_text("mine")
        self.check(1, *words, says=["a.pocket2.ply", "--force"])
        self.assertEqual(self.names(), ["a.pocket2.ply"])
        self.check(1, *words, "-o", "a.pocket1.ply", "--force", says=["a.pocket1.ply", "twice"])
        self.check(2, *words, "--frames", "all", says="together")
        self.check(2, words[0], "-o", "a.pockets.msh", says=".pockets.csv")
        self.check(2, words[0], "-o", "-", "--format", "pockets.ply", says="together")
        self.assertEqual(self.names(), ["a.pocket2.ply"])

    def test_bodies_are_seen_through_the_surface(self):
        """In the colour of the legend, in pictures and pages; the surface is in front of them."""
        self.box("box.xyzr")
        words = ["box.xyzr", "--surface", "ses", "--voxel", "0.7", "--opacity", "0.3", "--show", "pockets", "--pocket-cut", "1"]
        self.check(0, *words, "--size", "200", "--style", "flat", "-o", "a.png", "-o", "a.html", "-o", "a.pockets.csv")
        rows = self.table("a.pockets.csv")
        width, lines = read_png((self.folder / "a.png").read_bytes())
        pixels = [tuple(line[3 * x:3 * x + 3]) for line in lines for x in range(width)]
        blue = sum(p[2] > p[0] + 40 for p in pixels[:]) / len(pixels)
        self.assertGreater(blue, 0.02)
        header = json.loads(re.search(r'id="header">(.*?)</script>', (self.folder / "a.html").read_text(), re.DOTALL)[1])
        self.assertEqual(header["opacity"], 0.3)
        self.assertEqual([e["name"].split(":")[0] for e in header["bodies"]["entries"]], [row["pocket"] for row in rows])
        self.assertEqual(len(header["bodies"]["parts"]), len(rows))
        said = self.check(0, *words[:-4], "-o", "b.html", "--show", "spheres").stderr.decode()
        self.assertIn("--show: atoms are in", said)

    def test_legends_name_what_is_drawn(self):
        """A pocket that has no wall on the surface is in no legend."""
        self.check(0, DATA / "4at1.ent.gz", "--select", "B", "--voxel", "0.7", "--color", "pocket", "-o", "a.html", "-o", "a.legend.svg", "-o", "a.ply", says="no wall")
        names, vertices, _ = read_ply((self.folder / "a.ply").read_bytes())
        column = names.index("pocket")
        seen = {int(v[column]) for v in vertices}
        svg = (self.folder / "a.legend.svg").read_text()
        listed = {int(n) for n in re.findall(r">(\d+): \d+ Å³<", svg)}
        self.assertEqual(listed, seen - {0})
        header = json.loads(re.search(r'id="header">(.*?)</script>', (self.folder / "a.html").read_text(), re.DOTALL)[1])
        entries = header["modes"][0]["entries"]
        self.assertEqual({n for n, e in enumerate(entries) if e["seen"]}, seen)

    def test_a_table_without_pockets_is_empty(self):
        self.check(0, CRAMBIN, "--probe-in", 3, "--voxel", 1, "-o", "none.pockets.csv", says=["pockets: 0"])
        self.assertEqual(self.table("none.pockets.csv"), [])

    def test_lining_is_named(self):
        self.check(0, DATA / "4at1.ent.gz", "--select", "chain A", "--voxel", "0.7", "--pocket-cut", "0",
                      "-o", "a.pockets.csv")
        rows = self.table("a.pockets.csv")
        volumes = [float(row["volume"]) for row in rows]
        self.assertEqual(volumes, sorted(volumes, reverse=True))
        first = rows[0]
        self.assertEqual(len(first["atom_ids"].split()), int(first["atoms"]))
        self.assertRegex(first["residues"], r"^A/[A-Z]{3}\d+( A/[A-Z]{3}\d+)+$")
        names = first["residues"]
        charge = sum(names.count(f"/{name}") for name in ("LYS", "ARG")) - \
            sum(names.count(f"/{name}") for name in ("ASP", "GLU"))
        self.assertEqual(int(float(first["charge"])), charge)
        self.assertTrue(-4.5 <= float(first["hydrophobicity"]) <= 4.5)

    def test_threads_do_not_matter(self):
        for threads in (1, 2):
            self.check(0, DIMER, "-j", threads, "--pocket-cut", 0, "-o", f"{threads}.pockets.csv")
        self.assertEqual((self.folder / "1.pockets.csv").read_bytes(), (self.folder / "2.pockets.csv").read_bytes())

    def test_places(self):
        self.check(0, DIMER, "--pocket-cut", 0, "-o", "all.pockets.csv")
        row = self.table("all.pockets.csv")[1]
        residue = row["residues"].split()[0].split("/")[1][3:]
        self.check(0, DIMER, "--pocket-cut", 0, "--pocket-at", f"resid {residue}", "-o", "one.pockets.csv")
        rows = self.table("one.pockets.csv")
        self.assertEqual(len(rows), 1)
        self.assertIn(float(rows[0]["volume"]), [float(r["volume"]) for r in self.table("all.pockets.csv")])
        for places, status, text in (("resn XYZ", 2, "--pocket-at"), ("resid 5", 1, "no pocket is within 4 Å")):
            self.check(status, CRAMBIN, "--probe-in", 3, "--pocket-at", places, "-o", "bad.pockets.csv", says=[text])
            self.assertFalse((self.folder / "bad.pockets.csv").exists())

    def test_frames_have_a_row_where_it_is_closed(self):
        text = ""
        for model, wide in enumerate((True, False), 1):
            text += f"MODEL     {model:4}\n"
            places = range(-6, 7)
            balls = [(x, y, z) for x in places for y in places for z in places]
            for i, (x, y, z) in enumerate(balls):
                push = 40.0 if wide and max(abs(x), abs(y), abs(z)) < 4 else 0.0
                text += (f"ATOM  {i:5}  C   ALA A{i:4}    {x + push:8.3f}{y:8.3f}{z:8.3f}"
                         "  1.00  0.00           C  \n")
            text += "ENDMDL\n"
        (self.folder / "two.pdb").write_text(text + "END\n")
        self.check(0, "two.pdb", "--frames", "all", "--voxel", "0.7", "--pocket-at", f"resid {13 * 13 * 2 + 13 * 6 + 6}",
                      "-o", "two.pockets.csv")
        rows = self.table("two.pockets.csv")
        self.assertEqual([row["frame"] for row in rows], ["1", "2"])
        self.assertGreater(float(rows[0]["volume"]), 50.0)
        self.assertEqual(float(rows[1]["volume"]), 0.0)

    def test_mouths_have_a_place(self):
        """A ring in the tunnel from a chamber: its ball, whatever the voxels."""
        hole = lambda x: max(map(abs, x)) < 4.5 or (x[0] > 0 and x[1] ** 2 + x[2] ** 2 < 16)
        self.box("ring.xyzr", hole)
        with open(self.folder / "ring.xyzr", "a") as file:
            for k in range(12):
                file.write(f"5.13 {3.6 * math.cos(k * math.pi / 6)} {3.6 * math.sin(k * math.pi / 6)} 1.5\n")
        for voxel in (0.4, 0.6):
            self.check(0, "ring.xyzr", "--voxel", voxel, "--pocket-neck", "0", "--pocket-cut", 1, "-o", "ring.pockets.csv", "-o", "ring.json", "--force")
            row = self.table("ring.pockets.csv")[0]
            self.assertAlmostEqual(float(row["mouth_radius_A"]), 2.1, delta=1e-5)
            for axis, place in zip("xyz", (5.13, 0, 0)):
                self.assertAlmostEqual(float(row[f"mouth_{axis}_A"]), place, delta=1e-3)
            mouth = json.loads((self.folder / "ring.json").read_text())["pockets"]["list"][0]["mouths"][0]
            self.assertAlmostEqual(mouth["center"][0], 5.13, delta=1e-3)

    def test_bad_values(self):
        for words, text in ((("--probe-out", 1), "--probe-out: expected more than --probe-in"),
                            (("--pocket-neck", 2), "--pocket-neck: expected 0 to 1")):
            self.check(2, CRAMBIN, *words, "-o", "x.pockets.csv", says=[text])
        self.check(0, CRAMBIN, "--voxel", 1, "-o", "x.pockets.csv", says=["narrow are lost"])
        self.check(2, CRAMBIN, "--fields", "pocket_id", "-o", "x.vdb", says=["--pockets"])

    @needs("kvfinder")
    def test_a_void_is_nearer_to_the_closed_form_than_by_kvfinder(self):
        self.box("closed.xyzr")
        self.check(0, "closed.xyzr", "--surface", "ses", "-o", "closed.json")
        self.check(0, "closed.xyzr", "--voxel", "0.6", "-o", "own.pockets.csv")
        done = subprocess.run([KVFINDER_PYTHON, "-c", DETECT, str(self.folder / "closed.xyzr")], check=True,
                              capture_output=True, text=True)
        exact = json.loads((self.folder / "closed.json").read_text())["surface"]["cavity_list"][0]["volume"]
        own = sum(float(row["volume"]) for row in self.table("own.pockets.csv"))
        self.assertLess(abs(own - exact), abs(float(done.stdout.split()[-1]) - exact))


if __name__ == "__main__":
    unittest.main()
