# SPDX-License-Identifier: MPL-2.0
"""Resolutions, groups, colours and parts, as a user asks for them."""

import json
import unittest

from tool import CRAMBIN, DATA, FAST, ToolTest, read_ply, read_png

DIMER = [DATA / "1a8o.cif.gz", "--assembly", "1"]


class Refused(ToolTest):
    def refuse(self, status, *words, says=()):
        before = self.names()
        self.check(status, CRAMBIN, "-o", "a.json", *words, says=says)
        self.assertEqual(self.names(), before)

    def write(self, text, name="groups"):
        (self.folder / name).write_text(text)
        return name

    def test_resolution(self):
        for value in ("0", "200", "-3", "nan", "x", "", "A=", "=5", "A=0.5"):
            self.refuse(2, "--resolution", value, says="--resolution")

    def test_resolution_of_nothing(self):
        self.refuse(1, "--resolution", "/1/Z=5", says="/1/Z")

    def test_no_such_file(self):
        self.refuse(1, "--groups", "none.json", says=["none.json", "No such file"])

    def test_folder(self):
        self.refuse(1, "--groups", ".", says="folder")

    def test_bad_files(self):
        for text, says in (("{", "valid JSON"), ("{}", '"groups"'), ("", "no group"),
                           ('{"groups": [{"name": "a"}]}', "select"),
                           ('{"groups": [{"name": "a", "select": "A", "colour": "#fff"}]}',
                            "colour"),
                           ("a A redd\n", "redd"), ("a\n", "line 1"),
                           ("a A\na A\n", "two groups")):
            self.refuse(1, "--groups", self.write(text), says=["groups", says])

    def test_unknown_chain(self):
        self.refuse(1, "--groups", self.write("a /1/Z\n"), says="/1/Z")

    def test_selection_that_does_not_parse(self):
        self.refuse(1, "--groups", self.write("a A;b<x\n"), says=["group a", "b<x"])

    def test_words(self):
        self.refuse(2, "--group-by", "domain", says=["chain", "domain"])
        self.refuse(2, "--group-by", "residues:0", says="residues:0")
        self.refuse(2, "--color", "blue", says="blue")
        self.refuse(2, "--color", "group", says="--groups")
        self.refuse(2, "--split", "chain", "--group-by", "chain", says="chain")
        self.refuse(2, "--split", "group", says="--groups")
        self.refuse(1, "--interfaces", says="--groups FILE names parts of a chain")
        self.refuse(2, "--surface-of", "a", "--group-by", "chain", says="GROUP=KIND")
        self.refuse(1, "--surface-of", "B=vdw", "--group-by", "chain", says=["'B'", "A"])
        self.refuse(2, "--groups", self.write("a A\n"), "--group-by", "chain", says="together")


    def test_picture(self):
        for option, value in (("--view", "0,0,0"), ("--size", "0"), ("--background", "whitish"),
                              ("--turn", "x")):
            self.refuse(2, option, value, says=option)
        for status, value in ((1, "up"), (2, "1,2"), (2, "1,2,3,4")):  # atoms, then: there are none, or it is no selection
            self.refuse(status, "--view", value, says=f'selection "{value}"')


class Groups(ToolTest):
    def report(self, *words, says=()):
        self.check(0, *words, *FAST, "-o", "a.json", "--force", says=says)
        return json.loads((self.folder / "a.json").read_text())

    def test_resolution_is_reported(self):
        report = self.report(CRAMBIN, "--resolution", "5", "--resolution", "/1/A/1-10=8")
        self.assertEqual([(r["selection"], r["resolution"]) for r in report["resolution"]],
                         [("all", 5), ("/1/A/1-10", 8)])
        self.assertEqual(sum(r["atoms"] for r in report["resolution"]), report["atoms"])

    def test_file(self):
        (self.folder / "g").write_text("# two parts\nfirst /1/A/1-20 #d55e00\nlast /1/A/21-46\n")
        report = self.report(CRAMBIN, "--groups", "g", "--color", "group", "-o", "a.ply")
        first, last = report["groups"]
        self.assertEqual(first["color"], "#d55e00")
        self.assertEqual(first["atoms"] + last["atoms"], report["atoms"])
        for key in ("area", "volume"):
            self.assertAlmostEqual(first[key] + last[key], report["surface"][key],
                                   delta=1e-6 * report["surface"][key])
        names, vertices, _ = read_ply((self.folder / "a.ply").read_bytes())
        group, red = names.index("group_id"), names.index("red")
        self.assertEqual({v[red:red + 3] for v in vertices if v[group] == 0}, {(0xD5, 0x5E, 0)})
        self.assertEqual({v[group] for v in vertices}, {0, 1})

    def test_overlapping_and_empty_groups_are_told(self):
        (self.folder / "g").write_text("all A\nhalf /1/A/1-20\n")
        self.report(CRAMBIN, "--groups", "g", says=["atoms of all belong to half"])
        (self.folder / "g").write_text("half /1/A/1-20\nall A\n")
        self.report(CRAMBIN, "--groups", "g", says=["no ball is left for half"])

    def test_split(self):
        report = self.report(*DIMER, "--group-by", "copy", "--split", "group", "-o", "a.obj",
                             "-o", "a.vdb")
        self.assertEqual([part["name"] for part in report["parts"]], ["copy 1", "copy 2"])
        for part in report["parts"]:
            self.assertTrue(part["surface"]["closed"] and part["surface"]["manifold"])
        lines = (self.folder / "a.obj").read_text().splitlines()
        self.assertEqual([line for line in lines if line[0] == "o"], ["o copy_1", "o copy_2"])
        info = self.check(0, "info", "a.vdb").stdout.decode()
        self.assertIn("grid surface_copy_1", info)
        self.assertIn("grid surface_copy_2", info)

    def test_copies_in_the_file(self):
        (self.folder / "g").write_text("one A copies=2 #d55e00\n")
        report = self.report(*DIMER, "--groups", "g", "--surface", "vdw")
        one, other = report["groups"]
        self.assertEqual((one["name"], other["name"]), ("one", "other"))
        self.assertEqual(one["atoms"], other["atoms"])
        self.assertAlmostEqual(one["area"], other["area"], delta=0.01 * one["area"])
        for text, says in (("one A copies=3\n", ["group one", "3"]),
                           ("one A copies=fold:7\n", ["group one", "7"]),
                           ("one A copies=x\n", ["group one", '"x"'])):
            (self.folder / "g").write_text(text)
            self.check(1, *DIMER, "--groups", "g", "-o", "b.json", says=says)
        (self.folder / "g").write_text("one A copies=1\n")
        self.check(1, CRAMBIN, "--groups", "g", "-o", "b.json", says="--assembly")

    def test_picture_has_the_colors(self):
        (self.folder / "g").write_text("first /1/A/1-20 #d00000\nlast /1/A/21-46 #0000d0\n")
        for view in ("auto", "0,1,0"):
            self.report(CRAMBIN, "--groups", "g", "--color", "group", "-o", "a.png", "--size",
                        "200", "--view", view, "--background", "#102030")
            width, rows = read_png((self.folder / "a.png").read_bytes())
            self.assertEqual(width, 200)
            pixels = [tuple(row[x:x + 3]) for row in rows for x in range(0, len(row), 3)]
            self.assertIn((0x10, 0x20, 0x30), pixels)
            red = sum(r > 2 * b and r > 80 for r, g, b in pixels)
            blue = sum(b > 2 * r and b > 80 for r, g, b in pixels)
            self.assertGreater(min(red, blue), len(pixels) / 50)
            self.assertGreater(red + blue, len(pixels) / 3)

    def test_surface_of(self):
        report = self.report(*DIMER, "--group-by", "copy", "--surface-of", "copy 2=ses")
        self.assertEqual([(p["name"], p["surface"]["kind"]) for p in report["parts"]],
                         [("copy 2", "ses"), ("other", "variational")])

    def test_colors_apart_from_groups(self):
        (self.folder / "parts").write_text("stem A/1-23\nrest A/24-46\n")
        (self.folder / "colors").write_text("first A/1-15 #ff0000\nsecond A/16-30 #00ff00\n")
        self.check(0, CRAMBIN, *FAST, "--groups", "parts", "--surface-of", "stem=vdw", "--color", "groups=colors", "-o", "a.ply", "-o", "a.json",
                   "-o", "a.legend.svg")
        names, vertices, _ = read_ply((self.folder / "a.ply").read_bytes())
        red, group = names.index("red"), names.index("group_id")
        pairs = {(vertex[group], vertex[red:red + 3]) for vertex in vertices}
        self.assertEqual(len({color for _, color in pairs}), 3)
        self.assertLessEqual({(0, (255, 0, 0)), (0, (0, 255, 0)), (1, (0, 255, 0))}, pairs)
        self.assertEqual([part["name"] for part in json.loads((self.folder / "a.json").read_text())["parts"]], ["stem", "other"])
        legend = (self.folder / "a.legend.svg").read_text()
        for name in ("first", "second", "other"):
            self.assertIn(name, legend)

    def test_names_of_groups_for_resolutions_and_parts(self):
        (self.folder / "colors").write_text("stem A/1-23\nrest A/24-46\n")
        for name, words in (("a", ["--resolution", "stem=5", "--resolution", "rest=3"]),
                            ("b", ["--resolution", "A/1-23=5", "--resolution", "A/24-46=3"])):
            self.check(0, CRAMBIN, *FAST, "--color", "groups=colors", *words, "-o", f"{name}.ply")
        vertices = [read_ply((self.folder / f"{name}.ply").read_bytes())[1] for name in "ab"]
        self.assertEqual(*vertices)
        self.check(0, CRAMBIN, *FAST, "--color", "groups=colors", "--interfaces", "-o", "c.json")
        pair, = json.loads((self.folder / "c.json").read_text())["interfaces"]
        self.assertEqual(pair["groups"], ["stem", "rest"])
        self.check(0, CRAMBIN, *FAST, "--color", "groups=colors", "--split", "group", "-o", "c.vdb")
        self.check(1, CRAMBIN, *FAST, "--color", "groups=none", "-o", "d.ply", says=["none", "No such file"])
        (self.folder / "some").write_text("stem A/1-23 copies=1\n")
        self.check(2, *DIMER, *FAST, "--color", "groups=some", "--resolution", "stem=5", "-o", "d.ply", says="--resolution: expected a group of all copies")

    def test_interfaces(self):
        report = self.report(*DIMER, "--group-by", "copy", "--interfaces", "--surface", "sas")
        buried, = report["interfaces"]
        self.assertEqual(buried["groups"], ["copy 1", "copy 2"])
        alone = sum(group["alone_area"] for group in report["groups"])
        self.assertAlmostEqual(buried["buried_area"], (alone - report["surface"]["area"]) / 2,
                               delta=1e-3)


    def test_one_atom_on_large_voxels(self):
        """Its mesh encloses next to nothing, and its groups are counted all the same."""
        for place in range(8):
            x = 0.37 * place
            (self.folder / "a.pdb").write_text(
                f"ATOM      1  CA  GLY A   1    {x:8.3f}{2 * x:8.3f}{3 * x:8.3f}  1.00  0.00           C\n")
            done = self.run_tool("a.pdb", "--voxel", "3", "--group-by", "chain", "-o", "a.json", "--force", timeout=10)
            self.assertIn(done.returncode, (0, 1), done.stderr)


if __name__ == "__main__":
    unittest.main()
