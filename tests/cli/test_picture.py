# SPDX-License-Identifier: MPL-2.0
"""Pictures: the legend, turntables, and that 4AT1 by chain is one."""

import json
import os
import struct
import unittest
import xml.etree.ElementTree

from tool import CRAMBIN, DATA, FAST, ToolTest, read_ply, read_png

WHITE = (255, 255, 255)


class Refused(ToolTest):
    def test_words(self):
        for option, value in (("--legend", "yes"), ("--turntable", "1"), ("--turntable", "x"),
                              ("--turntable", "10000")):
            self.check(2, CRAMBIN, "-o", "a.png", option, value, says=option)
        self.check(2, CRAMBIN, "-o", "-", "--format", "png", "--turntable", "3", says="--turntable")
        self.assertEqual(self.names(), [])


class Pictures(ToolTest):
    def picture(self, *words):
        self.check(0, *words, "-o", "a.png", "--force")
        width, rows = read_png((self.folder / "a.png").read_bytes())
        return width, [[tuple(row[3 * x:3 * x + 3]) for x in range(width)] for row in rows]

    def has(self, rows, color):
        return any(color in row for row in rows)

    def test_4at1_by_chain(self):
        start = os.times().children_user
        width, rows = self.picture(DATA / "4at1.ent.gz", "--color", "chain", "--no-progress")
        # 3 s of all threads; ten times that with sanitizers. Other work on the machine does not count.
        self.assertLess(os.times().children_user - start, 30)
        self.assertEqual(width, 1200)
        shown = sum(pixel != WHITE for row in rows for pixel in row) / (width * len(rows))
        self.assertGreater(shown, 0.3)
        self.assertLess(shown, 0.9)
        # The legend has the chains' colours as they are.
        for color in ((86, 180, 233), (230, 159, 0)):
            self.assertTrue(self.has(rows, color), color)

    def test_chains_keep_their_colours(self):
        """By their places in the file: whatever is selected or shown, in pictures, legends and vertices."""
        blue, orange, green, purple = (86, 180, 233), (230, 159, 0), (0, 158, 115), (204, 121, 167)
        file = DATA / "4at1.ent.gz"
        words = [file, "--surface", "ses", "--voxel", 2, "--size", 600]
        _, rows = self.picture(*words, "--select", "A|C", "--color", "chain", "-o", "a.ply")
        self.assertEqual([self.has(rows, c) for c in (blue, orange, green, purple)], [True, False, True, False])
        names, vertices, _ = read_ply((self.folder / "a.ply").read_bytes())
        red = names.index("red")
        self.assertEqual({v[red:red + 3] for v in vertices}, {blue, green})
        # Tubes are in the legend, beside those of the surface or in one of their own.
        shown = ["--select", "A|C", "--show", "B=tube", "--show", "chain D and resid 1 to 20=sticks,golden"]
        for color, expected in (("chain", [True, True, True, False]), ("hydrophobicity", [False, True, False, False])):
            _, rows = self.picture(*words, *shown, "--color", color)
            self.assertEqual([self.has(rows, c) for c in (blue, orange, green, purple)], expected, color)
            self.assertTrue(self.has(rows, (242, 184, 60)), "carbon")
        _, rows = self.picture(*words, *shown, "--color", "chain", "--legend", "off")
        self.assertFalse(self.has(rows, orange))

    def test_legend_of_groups(self):
        (self.folder / "g").write_text("first /1/A/1-20 #d00000\nlast /1/A/21-46 #0000d0\n")
        words = [CRAMBIN, *FAST, "--groups", "g", "--color", "group", "--size", "400"]
        sizes = {}
        for legend in ("on", "off", "auto"):
            width, rows = self.picture(*words, "--legend", legend)
            self.assertEqual(width, 400)
            column = [row[x] for row in rows for x in range(330, 400)]
            sizes[legend] = sum(pixel != WHITE for pixel in column)
            patches = [sum(pixel == color for pixel in column)
                       for color in ((0xD0, 0, 0), (0, 0, 0xD0))]
            self.assertEqual(min(patches) > 60, legend == "on", patches)
        self.assertEqual(sizes["off"], sizes["auto"])  # too small for one unasked

    def test_legend_of_curvature(self):
        _, rows = self.picture(CRAMBIN, *FAST, "--color", "mean-curvature", "--size", "700")
        bar = {pixel for row in rows for pixel in row}
        for color in ((178, 24, 43), (33, 102, 172), (247, 247, 247)):  # the ends and the middle
            near = min(max(abs(a - b) for a, b in zip(pixel, color)) for pixel in bar)
            self.assertLess(near, 4, color)

    def test_dark_background_has_light_letters(self):
        _, rows = self.picture(CRAMBIN, *FAST, "--color", "chain", "--legend", "on", "--size", "300",
                               "--background", "#000000")
        right = [pixel for row in rows for pixel in row[230:]]
        self.assertGreater(max(min(pixel) for pixel in right), 200)

    def test_backgrounds(self):
        """By other words for a colour, and none: the surface is opaque then, and what is about it is not there."""
        words = [CRAMBIN, *FAST, "--color", "chain", "--legend", "on", "--size", "300"]
        black = self.picture(*words, "--background", "#000000")
        for word in ("black", "#000", "BLACK"):
            self.assertEqual(self.picture(*words, "--background", word), black)
        self.check(0, *words, "--background", "transparent", "-o", "t.png")
        _, rows = read_png((self.folder / "t.png").read_bytes(), parts=4)
        alpha = [list(row[3::4]) for row in rows]
        self.assertEqual((alpha[0][0], alpha[-1][0]), (0, 0))
        # As much is opaque or partly so as is not white on white.
        _, white = self.picture(*words)
        shown = sum(a > 0 for row in alpha for a in row)
        self.assertLess(abs(shown - sum(p != WHITE for row in white for p in row)), 0.02 * shown)
        self.assertGreater(max(max(row[240:]) for row in alpha), 200)  # letters
        for y, row in enumerate(rows):  # where it is opaque it is as on white
            for x, a in enumerate(alpha[y]):
                if a == 255:
                    self.assertEqual(tuple(row[4 * x:4 * x + 3]), white[y][x])

    def test_plain_color(self):
        for color, share in (("red", 0), ("#00f", 2)):
            _, rows = self.picture(CRAMBIN, *FAST, "--plain-color", color, "--size", "200")
            shown = [pixel for row in rows for pixel in row if pixel != WHITE]
            for pixel in shown:
                self.assertEqual(max(pixel), pixel[share])
        self.check(2, CRAMBIN, "-o", "b.png", "--plain-color", "gren", says="did you mean green?")

    def test_styles(self):
        words = [CRAMBIN, *FAST, "--color", "chain", "--size", "300"]
        seen = {style: self.picture(*words, "--style", style) for style in ("soft", "glossy", "outline", "flat")}
        self.assertEqual(self.picture(*words), seen["soft"])
        for i, a in enumerate(seen):
            for b in list(seen)[:i]:
                self.assertNotEqual(seen[a], seen[b])
        flat = [pixel for row in seen["flat"][1] for pixel in row]
        self.assertGreater(flat.count((86, 180, 233)), 0.4 * len(flat))
        self.assertGreater(max(min(p) for row in seen["glossy"][1] for p in row if p != WHITE), 150)
        self.check(2, CRAMBIN, "-o", "b.png", "--style", "sof", says="did you mean soft?")

    def test_cut_and_opacity(self):
        words = [CRAMBIN, *FAST, "--color", "element", "--size", "200", "--legend", "off", "--style", "flat"]
        _, whole = self.picture(*words)
        _, cut = self.picture(*words, "--clip", "0")
        carbon = [sum(p == (144, 144, 144) for row in rows for p in row) for rows in (whole, cut)]
        self.assertGreater(carbon[1], 1000)  # the inside by its atoms
        self.assertNotEqual(whole, cut)
        _, faint = self.picture(*words, "--opacity", "0.2")
        mean = [sum(sum(p) for row in rows for p in row) / len(rows) for rows in (whole, faint)]
        self.assertGreater(mean[1], 1.05 * mean[0])
        _, walls = self.picture(*words, "--opacity", "0.2", "--show-behind")
        self.assertLess(sum(sum(p) for row in walls for p in row), sum(sum(p) for row in faint for p in row))
        self.check(0, CRAMBIN, *FAST, "-o", "b.png", "--show-behind", says="--show-behind is for --opacity")
        self.check(0, CRAMBIN, *FAST, "-o", "c.png", "--size", "60", "--clip", "-1000", says="--clip -1000: it cuts all of the surface away, expected more than -")
        said = self.check(0, CRAMBIN, *FAST, "-o", "d.png", "--size", "60", "--clip", "-6").stderr
        self.assertNotIn(b"warning", said)
        self.check(2, CRAMBIN, "-o", "b.png", "--opacity", "0", says="0.01 to 1")
        self.check(2, CRAMBIN, "-o", "b.png", "--clip", "near", says="a number of Å")

    def extents(self, atoms, view):
        """Widths of atoms as a .view sees them, and how far their middle is from its own [Å]."""
        right = [view["up"][i - 2] * view["to_eye"][i - 1] - view["up"][i - 1] * view["to_eye"][i - 2] for i in range(3)]
        spans = []
        for axis in (right, view["up"]):
            seen = [sum(a * (x - c) for a, x, c in zip(axis, atom, view["center"])) for atom in atoms]
            spans.append((max(seen) - min(seen), abs(max(seen) + min(seen)) / 2))
        return max(width for width, _ in spans), max(off for _, off in spans)

    def test_zoom_fills_the_frame(self):
        """With the atoms' own box, whatever the direction, also in panels and frames; an atom has a frame of 5 Å."""
        site = [tuple(float(line[k:k + 8]) for k in (30, 38, 46)) for line in CRAMBIN.read_text().splitlines()
                if line.startswith("ATOM") and 10 <= int(line[22:26]) <= 14]
        for more in ([], ["--view", "z"], ["--view", "A/12"], ["--view", "0.3,-0.2,1", "--up", "1,0,0"], ["--panel", "x"]):
            self.check(0, CRAMBIN, *FAST, "--zoom", "resid 10-14", *more, "-o", "a.view", "-o", "a.png", "--size", "100", "--force")
            view = json.loads((self.folder / "a.view").read_text())
            wide, off = self.extents(site, view)
            self.assertAlmostEqual(wide / view["width"], 0.8, delta=1e-6)
            self.assertEqual(view["width"], view["height"])
            self.assertLess(off, 1e-6)
        self.check(0, CRAMBIN, *FAST, "--zoom", "index 3", "-o", "b.view")
        self.assertAlmostEqual(json.loads((self.folder / "b.view").read_text())["width"], 5.0)
        self.check(0, CRAMBIN, *FAST, "--view", "b.view", "--zoom", "all", "-o", "c.view")  # and not the frame of b.view
        self.assertGreater(json.loads((self.folder / "c.view").read_text())["width"], 25)
        turned = [*FAST, "--zoom", "resid 10-14", "--turntable", "3", "-o", "t.png", "--size", "64", "--legend", "off"]
        self.check(0, CRAMBIN, *turned)
        self.assertEqual({struct.unpack(">II", (self.folder / f"t.000{n}.png").read_bytes()[16:24]) for n in (1, 2, 3)}, {(64, 64)})
        self.check(0, DATA / "1d3z.pdb.gz", "--voxel", "2", "--frames", "1-2", "--zoom", "resid 10-14", "-o", "f.view")
        views = [json.loads((self.folder / f"f.000{n}.view").read_text()) for n in (1, 2)]
        self.assertEqual(views[0], views[1])
        self.assertLess(views[0]["width"], 30)
        self.check(1, CRAMBIN, *FAST, "--zoom", "chain Z", "-o", "d.png", says="matches no atom")

    def test_zoom_cuts_away_what_hides_the_site(self):
        words = [CRAMBIN, *FAST, "--zoom", "resid 10-14", "--size", "100", "--legend", "off"]
        self.check(0, *words, "--view", "A/12", "-o", "a.view")
        eye = json.loads((self.folder / "a.view").read_text())["to_eye"]
        for sign, hidden in ((1, False), (-1, True)):
            look = ["--view=" + ",".join(str(sign * x) for x in eye)]
            (_, opened), (_, closed), (_, cut) = (self.picture(*words, *look, *more) for more in ([], ["--clip", "1000"], ["--clip", "0"]))
            self.assertEqual(opened != closed, hidden)
            self.assertEqual(opened == cut, hidden)

    def test_a_cut_of_copies_is_that_of_the_whole(self):
        """The colours inside of a copy are those of its own place."""
        words = [DATA / "1a8o.cif.gz", "--assembly", "1", *FAST, "--surface", "vdw", "--color", "element", "--clip", "0", "--view", "0,0,1",
                 "--size", "200", "--legend", "off", "--style", "flat"]
        (_, whole), (_, copies) = self.picture(*words), self.picture(*words, "--instances")
        self.assertEqual(len(whole), len(copies))
        apart = [abs(a - b) for rows in zip(whole, copies) for pair in zip(*rows) for a, b in zip(*pair)]
        self.assertLess(sum(apart) / len(apart), 3)

    def test_orders_of_molecules(self):
        """The orders of bonds in .sdf, old and new, and .mol2: of all molecules alike, or they are not known."""
        atoms = [("C", 0, 0), ("C", 1.5, 0), ("O", 2.1, 1.05), ("O", 2.2, -1.15)]

        def bonds(order, form):
            return "".join(form.format(n, i, j, order if n == 2 else 1) for n, (i, j) in enumerate(((1, 2), (2, 3), (2, 4)), 1))

        def old(order):
            return ("t\n     program        3D\n\n  4  3  0  0  0  0            999 V2000\n" +
                    "".join(f"{x:10.4f}{y:10.4f}{0.1 * x:10.4f} {e}   0  0\n" for e, x, y in atoms) +
                    bonds(order, "{1:3}{2:3}{3:3}  0\n") + "M  END\n$$$$\n")

        def new(order):
            return ("t\n     program        3D\n\n  0  0  0     0  0            999 V3000\nM  V30 BEGIN CTAB\nM  V30 BEGIN ATOM\n" +
                    "".join(f"M  V30 {i} {e} {x} {y} {0.1 * x} 0\n" for i, (e, x, y) in enumerate(atoms, 1)) +
                    "M  V30 END ATOM\nM  V30 BEGIN BOND\n" + bonds(order, "M  V30 {0} {3} {1} {2}\n") + "M  V30 END BOND\nM  END\n$$$$\n")

        def mol2(order):
            return ("@<TRIPOS>MOLECULE\nx\n 4 3 1\nSMALL\nUSER\n\n@<TRIPOS>ATOM\n" +
                    "".join(f"{i} {e}{i} {x} {y} {0.1 * x} {e}.2 1 ACT1 0\n" for i, (e, x, y) in enumerate(atoms, 1)) +
                    "@<TRIPOS>BOND\n" + bonds(order, "{0} {1} {2} {3}\n"))

        def drawn(name, text):
            (self.folder / name).write_text(text)
            return self.picture(name, *FAST, "--surface", "vdw", "--show", "orders", "--opacity", "0.05", "--view", "0,0,1",
                                "--size", "200", "--legend", "off")
        single = drawn("a.sdf", old(1))
        orders = [drawn("a.sdf", old(order)) for order in (2, 3, 4)]
        for n, picture in enumerate(orders):
            self.assertNotIn(picture, [single, *orders[:n]])
        self.assertEqual(drawn("a.sdf", new(2)), orders[0])
        self.assertEqual(drawn("a.mol2", mol2(2)), orders[0])
        self.assertEqual(drawn("a.mol2", mol2("ar")), orders[2])
        self.assertEqual(drawn("a.sdf", 2 * old(2)), orders[0])
        self.assertEqual(drawn("a.sdf", old(2) + old(3)), single)

    def test_what_shows_is_not_warned_of(self):
        words = [CRAMBIN, *FAST, "--surface", "ses"]
        for more in (["--pieces", "outer", "-o", "a.glb", "-o", "a.html"], ["--pieces", "outer", "-o", "a.usda"],
                     ["--show", "sticks", "--opacity", "0.3", "--legend", "on", "--size", "300", "-o", "a.png"],
                     ["--for", "blender", "--legend", "on", "--size", "300", "-o", "b.png", "-o", "b.vdb"]):
            self.assertNotIn(b"warning", self.check(0, *words, *more).stderr)
        self.check(0, *words, "--legend", "on", "--size", "100", "-o", "c.png", says="--legend is for --color or --show")
        self.check(0, *words, "--pieces", "outer", "-o", "c.json", says="--pieces is for .ply")

    def test_atoms_beside_the_surface(self):
        """Sulphur of the disulfides, that no surface shows, has its colour in a faint one and where it is cut."""
        words = [CRAMBIN, *FAST, "--size", "200", "--legend", "off", "--style", "flat"]
        sulphur = (255, 255, 48)
        _, rows = self.picture(*words, "--show", "A//SG=spheres")
        self.assertFalse(self.has(rows, sulphur))
        _, rows = self.picture(*words, "--show", "A//SG=spheres", "--clip", "-6")
        self.assertTrue(self.has(rows, sulphur))
        _, rows = self.picture(*words, "--select", "A/1-10", "--show", "A//SG=spheres")
        self.assertTrue(self.has(rows, sulphur))  # of atoms that the surface is not of
        _, faint = self.picture(*words, "--show", "tube", "--opacity", "0.1", "--color", "chain")
        blues = [pixel for row in faint for pixel in row if pixel[2] > 1.3 * pixel[0]]
        self.assertGreater(len(blues), 1500)  # the tube has the colour of its chain
        # A chain that the surface has not got has a colour that it has not got either.
        _, rows = self.picture(DATA / "4at1.ent.gz", *FAST, "--size", "200", "--legend", "off", "--style", "flat",
                               "--select", "A,C", "--color", "chain", "--show", "B=tube")
        seen = {color: sum(row.count(color) for row in rows)
                for color in ((86, 180, 233), (230, 159, 0), (0, 158, 115))}
        self.assertGreater(min(seen.values()), 40, seen)
        for value, says in (("stick", "did you mean sticks?"), ("A/1=", "expected sticks, balls"),
                            ("(XYZ)=sticks", "matches no atom"), ("A//CB=tube", "nothing to show")):
            self.check(1 if "XYZ" in value or "CB" in value else 2, CRAMBIN, "-o", "b.png", "--show", value, says=says)
        self.check(0, CRAMBIN, *FAST, "-o", "b.ply", "--show", "sticks", says="--show is for .html, .png")

    def test_other_copies(self):
        """The copies that the surface leaves out are balls beside it, in its colours or in one, and make the whole with it."""
        red, blue = (255, 0, 0), (0, 0, 255)
        words = [DATA / "2buk.pdb.gz", "--assembly", 1, *FAST, "--size", 200, "--legend", "off", "--style", "flat"]
        unit = [*words, "--copies", "fold:5", "--plain-color", "#ff0000", "--show"]
        def count(rows, color):
            return sum(row.count(color) for row in rows)
        _, rows = self.picture(*unit, "spheres,others,#0000ff")
        ink = sum(pixel not in (red, blue, WHITE) for row in rows for pixel in row)
        self.assertGreater(count(rows, red), 2000)  # the five face the eye
        self.assertGreater(count(rows, blue), count(rows, red))
        self.assertLess(ink, 0.3 * count(rows, blue))  # lines
        middle = len(rows) // 2
        self.assertIn(red, rows[middle][90:110])
        # As wide as the whole.
        _, whole = self.picture(*words, "--instances", "--surface", "vdw", "--view", "1,2,3")
        _, both = self.picture(*unit, "spheres,others", "--view", "1,2,3")
        for rows in (whole, both):
            self.assertFalse(self.has(rows, blue))
        outside = [sum(pixel == WHITE for row in rows for pixel in row) for rows in (whole, both)]
        self.assertLess(abs(outside[0] - outside[1]), 0.02 * outside[0])
        # By groups all have the colours of the file, at any place.
        (self.folder / "g").write_text("low */1-70 #d00000\nmiddle */71-130 #00d000\nhigh */131-200 #0000d0\n")
        _, rows = self.picture(*words, "--copies", 1, "--groups", "g", "--color", "group", "--show", "spheres,others")
        for color in ((0xD0, 0, 0), (0, 0xD0, 0), (0, 0, 0xD0)):
            self.assertGreater(sum(color in row for row in rows), 100, color)  # rows of pixels: not the unit's alone
        self.check(2, *words, "--show", "spheres,others", "-o", "b.png", says="expected --copies too")
        self.check(2, *words, "--copies", 1, "--show", "spheres,other", "-o", "b.png", says="did you mean others?")

    def test_a_ligand_in_its_pocket(self):
        """Bodies of pockets hide at most half of the pixels of ATP, and are in the picture."""
        (self.folder / "a.view").unlink(missing_ok=True)
        words = [DATA / "4at1.ent.gz", "--voxel", 1, "--select", "chain B or resn ATP", "--size", 400, "--legend", "off"]
        self.check(0, *words, "--view", "chain B and resn ATP", "-o", "a.view")
        words += ["--view", "a.view"]
        sticks, pockets = ["--show", "resn ATP=sticks"], ["--show", "pockets", "--pocket-at", "chain B and resn ATP"]
        empty, alone = self.picture(*words, "--opacity", 0.01)[1], self.picture(*words, "--opacity", 0.01, *sticks)[1]
        far = lambda a, b: sum(abs(x - y) for x, y in zip(a, b))  # noqa: E731
        mask = [(y, x) for y, row in enumerate(alone) for x, pixel in enumerate(row) if far(pixel, empty[y][x]) > 90]
        self.assertGreater(len(mask), 300)
        for opacity in (0.2, 0.4):
            shown = self.picture(*words, "--opacity", opacity, *sticks)[1]
            both = self.picture(*words, "--opacity", opacity, *sticks, *pockets)[1]
            kept = sum(far(both[y][x], shown[y][x]) < 120 for y, x in mask)
            self.assertGreater(kept, len(mask) / 2)
            changed = sum(far(a, b) > 20 for one, other in zip(both, shown) for a, b in zip(one, other))
            self.assertGreater(changed, 500)

    def test_few_pockets_in_colours_of_their_own(self):
        """The eight largest unless all are asked for; none has the colour of a chain."""
        words = [DATA / "4at1.ent.gz", "--voxel", 1, "--color", "chain", "--size", 700, "-o", "a.legend.svg", "-o", "a.png", "--force"]
        colors = {}
        for show, count in (("pockets", 8), ("pockets=3", 3), ("pockets=all", None)):
            done = self.check(0, *words, "--show", show)
            text = (self.folder / "a.legend.svg").read_text()
            tree = xml.etree.ElementTree.fromstring(text)
            fills = [e.get("fill") for e in tree.iter() if e.tag.endswith("rect") and (e.get("fill") or "").startswith("#")]
            colors[show] = fills
            if count:
                self.assertIn(f"pictures show the {count} largest of", done.stderr.decode())
            else:
                self.assertNotIn(b"pictures show", done.stderr)
        chains = 12
        self.assertEqual(len(colors["pockets"]) - len(colors["pockets=3"]), 5)
        names, bodies = colors["pockets"][-8 - chains:-8], colors["pockets"][-8:]
        self.assertEqual(len(set(bodies)), 8)
        self.assertFalse(set(bodies) & set(names))

    def test_carbon_has_the_colour_of_its_chain(self):
        """In an interface no stick of one chain looks like the patch of the other; golden by a word, or of one chain."""
        words = ["--voxel", 1, "--color", "chain", "--style", "flat", "--size", 300, "--legend", "off", "--view", "z"]
        both = [DATA / "4at1.ent.gz", *words, "--select", "chain B"]
        golden, show = (242, 184, 60), "chain A and within 8 of chain B"
        counts = {}
        for row in self.picture(*both)[1]:
            for pixel in row:
                counts[pixel] = counts.get(pixel, 0) + 1
        patch = max((count, pixel) for pixel, count in counts.items() if pixel != WHITE)[1]
        sticks = self.picture(*both, "--show", f"{show}=sticks", "--opacity", 0.01)[1]
        self.assertFalse(self.has(sticks, golden))
        drawn = [pixel for row in sticks for pixel in row if max(abs(a - b) for a, b in zip(pixel, WHITE)) > 60]
        self.assertGreater(len(drawn), 500)
        self.assertEqual([p for p in drawn if sum((a - b) ** 2 for a, b in zip(p, patch)) < 30 ** 2], [])
        self.assertTrue(self.has(self.picture(*both, "--show", f"{show}=sticks,golden")[1], golden))
        one = self.picture(CRAMBIN, *words, "--select", "resid 1-9", "--show", "resid 20-30=sticks")[1]
        self.assertTrue(self.has(one, golden))

    def test_atoms_of_frames_and_copies(self):
        self.check(0, DATA / "1d3z.pdb.gz", *FAST, "--frames", "1-2", "--show", "sticks", "--opacity", "0.3", "--size", "150",
                   "-o", "a.png")
        seen = [(self.folder / f"a.000{n}.png").read_bytes() for n in (1, 2)]
        self.assertNotEqual(*seen)
        words = [DATA / "1a8o.cif.gz", "--voxel", "1.5", "--assembly", "1", "--size", "200", "--opacity", "0.3", "--show", "tube",
                 "--view", "0,0,1"]
        whole, copies = self.picture(*words), self.picture(*words, "--instances")
        alike = sum(p == q for a, b in zip(whole[1], copies[1]) for p, q in zip(a, b))
        self.assertGreater(alike, 0.5 * whole[0] * len(whole[1]))

    def test_what_is_upright(self):
        (self.folder / "bar.xyzr").write_text("".join(f"{2 * n} {n} {4 * n} 1.7\n" for n in range(9)))

        def view(*words):
            self.check(0, "bar.xyzr", *FAST, *words, "-o", "a.view", "--force")
            found = json.loads((self.folder / "a.view").read_text())
            return found["up"], found["to_eye"]

        def near(a, b):
            for x, y in zip(a, b):
                self.assertAlmostEqual(x, y, 6)

        for way, up in (("1,0,0", (0, 0, 1)), ("0,-1,0", (0, 0, 1)), ("0,0,1", (0, 1, 0))):
            near(view("--view", way)[0], up)
        near(view("--view", "0,0,1", "--up", "3,0,0")[0], (1, 0, 0))
        up, eye = view("--view", "0,3,4", "--up", "0,0,2")  # the eye comes down to what is level
        near(up, (0, 0, 1))
        near(eye, (0, 1, 0))
        up, eye = view("--up", "0,0,1")  # the longest level extent, (2, 1, 0), lies across
        near(up, (0, 0, 1))
        self.assertAlmostEqual(abs(eye[0] * 2 + eye[1]), 0, 3)
        up, eye = view("--view", "1,0,0", "--up", "0,0,1", "--turn", "90")
        near(up, (0, 0, 1))
        self.assertAlmostEqual(abs(eye[1]), 1, 6)
        for wrong in ("0,0,0", "1,2", "up"):
            self.check(2, "bar.xyzr", "--up", wrong, "-o", "b.png", says="--up")
        self.check(2, "bar.xyzr", "--view", "0,0,1", "--up", "0,0,-2", "-o", "b.png", says="across that of --view")

    def test_labels_and_rulers(self):
        """Two atoms 20 A apart along x: the line joins them, with a text above its middle and one above an end."""
        line = "HETATM{:5}  C   XXX A{:4}    {:8.3f}   0.000   0.000  1.00  0.00           C\n"
        (self.folder / "two.pdb").write_text(line.format(1, 1, -10.0) + line.format(2, 2, 10.0))
        words = ["two.pdb", *FAST, "--view", "0,0,1", "--size", "400", "--legend", "off", "--style", "flat"]
        _, plain = self.picture(*words)
        _, rows = self.picture(*words, "--ruler", "A/1..resid 2", "--label", "A/1 = end")
        dark = lambda pixel: max(pixel) < 40
        height, ink = len(rows), [[dark(p) and not dark(q) for p, q in zip(row, old)] for row, old in zip(rows, plain)]
        # 23.4 A and a border are 400 pixels, so that 20 A are some 325.
        line = max(ink, key=sum)
        self.assertAlmostEqual(sum(line), 328, delta=12)
        self.assertAlmostEqual(ink.index(line), height / 2, delta=3)
        above = [[row[x] for row in ink[:height // 2 - 4]] for x in range(400)]
        drawn = [x for x, column in enumerate(above) if any(column)]
        self.assertTrue(any(abs(x - 200) < 12 for x in drawn), "the length")
        self.assertTrue(any(abs(x - 36) < 12 for x in drawn), "the label")
        self.assertFalse(any(300 < x for x in drawn))
        _, named = self.picture(*words, "--label", "A/2")
        self.assertNotEqual(named, plain)
        _, placed = self.picture(*words, "--ruler", "-10,0,0..resid 2", "--label", "-10,0,0=end")
        self.assertEqual(placed, rows, "places are those of the atoms")
        _, far = self.picture(*words, "--label", "0,90,0=far")
        self.assertGreater(len(far), 2 * height, "what lies outside of the surface is seen, too")
        for option, value, status, says in (("--label", "=x", 2, "expected SELECTION"), ("--label", "A/1=", 2, "SELECTION=TEXT"),
                                            ("--ruler", "A/1", 2, "WHERE..WHERE"), ("--ruler", "A/1..", 2, 'got "A/1.."'),
                                            ("--ruler", "A/1..A/1", 1, "expected two places, got one"),
                                            ("--ruler", "A/1..-10,0,0", 1, "expected two places, got one"),
                                            ("--label", "-10,0,0", 2, "X,Y,Z=TEXT"), ("--label", "-10,0,0=", 2, "X,Y,Z=TEXT"),
                                            ("--label", "nan,0,0=x", 1, "nan,0,0"), ("--label", "1e7,0,0=x", 2, "1e7,0,0"),
                                            ("--label", "A/9", 1, "matches no atom")):
            self.check(status, *words, option, value, "-o", "b.png", says=says)
        self.check(0, *words, "--label", "A/1", "-o", "b.ply", says="--label is for .png")
        self.assertFalse((self.folder / "b.png").exists())

    def test_labels_of_frames(self):
        """The ruler of each frame has its own length."""
        text = "MODEL {0}\nHETATM    1  C   XXX A   1       0.000   0.000   0.000  1.00  0.00           C\n" \
               "HETATM    2  C   XXX A   2    {1:8.3f}   0.000   0.000  1.00  0.00           C\nENDMDL\n"
        (self.folder / "m.pdb").write_text(text.format(1, 6.0) + text.format(2, 9.0))
        words = ["m.pdb", *FAST, "--frames", "all", "--size", "300", "--view", "0,0,1", "-o", "a.png", "--force"]
        pictures = []
        for more in ([], ["--ruler", "A/1..A/2"]):
            self.check(0, *words, *more)
            pictures.append([(self.folder / f"a.000{n}.png").read_bytes() for n in (1, 2)])
        for n in (0, 1):
            self.assertNotEqual(pictures[0][n], pictures[1][n])
        self.check(0, *words, "--label", "0,40,0=above")
        width, height = (int.from_bytes((self.folder / "a.0001.png").read_bytes()[at:at + 4], "big") for at in (16, 20))
        self.assertGreater(height, 2 * width, "the frame has the places of labels")

    def test_membranes_are_upright(self):
        """The dummies of OPM: from the plane of N to that of O is up, unless a view is asked for."""
        line = "HETATM{:5}  {:<3} {:>3} A{:4}    {:8.3f}{:8.3f}{:8.3f}  1.00  0.00           {}\n"
        rows = [("CA", "ALA", x, 0.0, 30.0 * x) for x in range(4)]
        rows += [("O" if side > 0 else "N", "DUM", 15 * side * 0.6 + 4 * i * 0.8, 4.0 * j, 15 * side * 0.8 - 4 * i * 0.6)
                 for side in (-1, 1) for i in range(-2, 3) for j in range(-2, 3)]
        (self.folder / "m.pdb").write_text("".join(line.format(n, name, residue, n, x, y, z, name[0])
                                                   for n, (name, residue, x, y, z) in enumerate(rows, 1)))
        for words, up in (([], (0.6, 0, 0.8)), (["--view", "0,0,1"], (0, 1, 0)), (["--up", "0,0,1"], (0, 0, 1))):
            self.check(0, "m.pdb", *FAST, *words, "-o", "a.view", "--force")
            found = json.loads((self.folder / "a.view").read_text())["up"]
            for x, y in zip(found, up):
                self.assertAlmostEqual(x, y, 3, msg=words)

    def test_view_of_atoms_and_from_a_file(self):
        words = [CRAMBIN, *FAST, "--size", "160"]
        self.check(0, *words, "--view", "A/46", "-o", "a.view", "-o", "b.png", "--turn", "30")
        view = json.loads((self.folder / "a.view").read_text())
        self.assertAlmostEqual(view["width"] / view["height"], 160 / len(read_png((self.folder / "b.png").read_bytes())[1]),
                               delta=0.02)
        again = self.picture(*words, "--view", "a.view")
        _, rows = read_png((self.folder / "b.png").read_bytes())
        flat = [tuple(row[3 * x:3 * x + 3]) for row in rows for x in range(160)]
        wrong = sum(p != q for p, q in zip(flat, (p for row in again[1] for p in row)))
        self.assertLess(wrong, 0.01 * len(flat))
        # A part of the molecule stays where it was, and so does its size.
        part = self.picture(CRAMBIN, *FAST, "--size", "160", "--view", "a.view", "--select", "A/1-20")
        self.assertEqual(len(part[1]), len(again[1]))
        shown = [sum(p != WHITE for row in rows for p in row) for rows in (again[1], part[1])]
        self.assertLess(shown[1], 0.8 * shown[0])
        outside = sum(p != WHITE and q == WHITE for a, b in zip(part[1], again[1]) for p, q in zip(a, b))
        self.assertLess(outside, 0.02 * shown[1])
        # It looks at these atoms: the carboxyl end is the nearest to the eye.
        ends = {line[22:26].strip(): [float(line[30 + 8 * i:38 + 8 * i]) for i in range(3)]
                for line in CRAMBIN.read_text().splitlines() if line.startswith("ATOM") and line[12:16] == " CA "}
        self.check(0, *words, "--view", "A/46", "-o", "c.view")
        eye = json.loads((self.folder / "c.view").read_text())["to_eye"]
        height = {name: sum(a * b for a, b in zip(eye, x)) for name, x in ends.items()}
        self.assertGreater(height["46"], sorted(height.values())[-8])
        (self.folder / "bad.view").write_text('{"to_eye": [0, 0, 1], "up": [0, 0, 2], "center": [0, 0, 0], "width": 1, "height": 1}')
        self.check(1, *words, "--view", "bad.view", "-o", "d.png", says="two directions that differ")
        (self.folder / "bad.view").write_text(json.dumps({**view, "height": 6 * view["width"]}))
        self.check(1, *words, "--view", "bad.view", "-o", "d.png", says="0.1 to 5 widths")  # or it takes any memory
        (self.folder / "bad.view").write_text("{}")
        self.check(1, *words, "--view", "bad.view", "-o", "d.png", says="-o NAME.view writes one")
        self.check(1, *words, "--view", "*", "-o", "d.png", says="lie about the middle")
        self.check(1, *words, "--view", "a.view", "-o", "a.view", "--force", says="a.view")

    def test_centred_is_the_same_picture(self):
        """Colours, the cut and shown atoms move with the mesh."""
        words = [DATA / "1a8o.cif.gz", "--assembly", "1", "--voxel", "1", "--size", "200", "--show", "A//CA=spheres",
                 "--ruler", "A/155/CA..A/200/CA", "--clip", "2", "--color"]
        for color in ("chain", "hydrophobicity"):
            there, centred = self.picture(*words, color), self.picture(*words, color, "--center")
            self.assertEqual(len(there[1]), len(centred[1]))
            far = sum(max(abs(a - b) for a, b in zip(p, q)) > 40
                      for one, other in zip(there[1], centred[1]) for p, q in zip(one, other))
            self.assertLess(far, 0.01 * 200 * len(there[1]))

    def test_legends_as_svg(self):
        """All names and colours, with text as text; of values a bar from low to high."""
        space = "{http://www.w3.org/2000/svg}"

        def drawing(*words):
            self.check(0, *words, "-o", "a.legend.svg", "--force")
            return xml.etree.ElementTree.fromstring((self.folder / "a.legend.svg").read_text())

        (self.folder / "g").write_text("A&B_<1> /1/A/1-20 #d00000\nlast /1/A/21-46 #0000d0\n")
        root = drawing(CRAMBIN, *FAST, "--groups", "g", "--color", "group", "--size", "100", "--show", "A//SG=spheres")
        self.assertEqual([e.text for e in root.iter(space + "text")], ["Group", "A&B_<1>", "last", "Element", "S"])
        self.assertEqual([e.get("fill") for e in root.iter(space + "rect")][:2], ["#d00000", "#0000d0"])
        root = drawing(CRAMBIN, *FAST, "--color", "mean-curvature", "--range=-0.5,0.5", "--background", "black", "--legend", "off")
        self.assertEqual([e.text for e in root.iter(space + "text")], ["Mean curvature", "[1/Å]", "0.50", "0", "−0.50"])
        self.assertGreater(int(root.get("fill")[1:3], 16), 200)
        stops = [(float(e.get("offset")), e.get("stop-color")) for e in root.iter(space + "stop")]
        self.assertEqual((stops[0], stops[-1]), ((0, "#2166ac"), (1, "#b2182b")))
        root = drawing(CRAMBIN, *FAST, "--color", "bfactor", "--palette", "plddt")  # steps
        offsets = [e.get("offset") for e in root.iter(space + "stop")]
        self.assertGreater(len(offsets), len(set(offsets)))
        self.check(1, CRAMBIN, *FAST, "-o", "b.legend.svg", says="expected colours for a legend")
        self.assertFalse((self.folder / "b.legend.svg").exists())

    def test_turntable(self):
        self.check(0, CRAMBIN, *FAST, "-o", "a.png", "-o", "a.ply", "--turntable", "4", "--size",
                   "120")
        self.assertEqual(self.names(), ["a.0001.png", "a.0002.png", "a.0003.png", "a.0004.png",
                                        "a.ply"])
        frames = [read_png((self.folder / f"a.000{n}.png").read_bytes()) for n in range(1, 5)]
        self.assertEqual(len({(width, len(rows)) for width, rows in frames}), 1)
        self.assertEqual(len({b"".join(map(bytes, rows)) for _, rows in frames}), 4)
        # The height of the molecule does not change, since it turns about the upright.
        heights = [sum(any(byte != 255 for byte in row) for row in rows) for _, rows in frames]
        self.assertLessEqual(max(heights) - min(heights), 2)
        # Half a turn later the outline is the mirror image.
        first, third = (rows for _, rows in (frames[0], frames[2]))
        outline = [[row[3 * x] != 255 for x in range(120)] for row in first]
        mirrored = [[row[3 * x] != 255 for x in reversed(range(120))] for row in third]
        wrong = sum(a != b for p, q in zip(outline, mirrored) for a, b in zip(p, q))
        self.assertLess(wrong, 0.03 * 120 * len(first))


if __name__ == "__main__":
    unittest.main()
