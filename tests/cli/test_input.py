# SPDX-License-Identifier: MPL-2.0
"""Inputs that cannot be used have status 1, say why in one line, and leave nothing behind."""

import gzip
import json
import os
import unittest

from tool import CRAMBIN, FAST, ToolTest

ATOM = "ATOM      1  CA  ALA A   1    {:>8}{:>8}{:>8}  1.00  0.00           C  \nEND\n"


class BadInput(ToolTest):
    def refuse(self, name, *words, says=()):
        before = self.names()
        self.check(1, name, "-o", "a.vdb", "-o", "a.json", *words, says=says)
        self.assertEqual(self.names(), before)

    def write(self, name, content):
        (self.folder / name).write_bytes(content.encode() if isinstance(content, str) else content)

    def test_no_such_file(self):
        self.refuse("none.pdb", says=["none.pdb", "No such file"])

    def test_folder(self):
        (self.folder / "folder.pdb").mkdir()
        self.refuse("folder.pdb", says="folder.pdb")

    def test_empty_file(self):
        for name in ("empty.pdb", "empty.cif", "empty.pqr", "empty.xyzr", "empty.xyzrn"):
            self.write(name, "")
            self.refuse(name, says=name)

    def test_text_that_is_no_structure(self):
        for name in ("letter.pdb", "letter.cif", "letter.pqr", "letter.xyzr", "letter.xyzrn"):
            self.write(name, "Dear all,\nthis is a letter.\n" * 20)
            self.refuse(name, says=name)

    def test_binary(self):
        self.write("noise.pdb", bytes(range(256)) * 40)
        self.refuse("noise.pdb", says="noise.pdb")

    def test_gz_cut_short(self):
        packed = gzip.compress(CRAMBIN.read_bytes())
        self.write("cut.pdb.gz", packed[: len(packed) // 2])
        self.refuse("cut.pdb.gz", says="cut.pdb.gz")

    def test_gz_that_is_none(self):
        self.write("false.pdb.gz", "no gzip here")
        self.refuse("false.pdb.gz", says="false.pdb.gz")

    def test_no_atoms(self):
        self.write("header.pdb", "HEADER    PLANT PROTEIN\nTITLE     NOTHING\nEND\n")
        self.refuse("header.pdb", says="header.pdb")

    def test_coordinates_that_are_none(self):
        for number in ("nan", "inf", "1e30", "99999999"):
            self.write("odd.pdb", ATOM.format(number, "1.000", "2.000"))
            self.refuse("odd.pdb", says="odd.pdb")

    def test_empty_selection(self):
        self.refuse(CRAMBIN, "--select", "//Z")

    def test_unknown_assembly(self):
        self.refuse(CRAMBIN, "--assembly", "99", says="99")

    def test_unknown_model(self):
        self.refuse(CRAMBIN, "--model", "99", says="99")

    def test_unknown_radii(self):
        self.refuse(CRAMBIN, "--radii", "none.radii", says="none.radii")

    def test_info(self):
        self.write("text.vdb", "no grid")
        self.check(1, "info", "none.vdb", says=["none.vdb", "No such file"])
        self.check(1, "info", "text.vdb", says="text.vdb")
        self.check(1, "info", ".", says="folder")
        self.check(0, CRAMBIN, "-o", "good.vdb", *FAST)
        good = (self.folder / "good.vdb").read_bytes()
        for share in (0.01, 0.1, 0.5, 0.99):
            self.write("cut.vdb", good[: int(share * len(good))])
            self.check(1, "info", "cut.vdb", says="cut.vdb")


class GoodInput(ToolTest):
    def test_standard_input(self):
        with CRAMBIN.open("rb") as file:
            self.check(0, "-", "-o", "stdin.ply", *FAST, stdin=file)
        self.check(0, CRAMBIN, "-o", "file.ply", *FAST)
        self.assertEqual((self.folder / "stdin.ply").read_bytes(),
                         (self.folder / "file.ply").read_bytes())

    def test_gz_is_the_same_as_plain(self):
        (self.folder / "a.pdb.gz").write_bytes(gzip.compress(CRAMBIN.read_bytes()))
        self.check(0, "a.pdb.gz", "-o", "packed.ply", *FAST)
        self.check(0, CRAMBIN, "-o", "plain.ply", *FAST)
        self.assertEqual((self.folder / "packed.ply").read_bytes(),
                         (self.folder / "plain.ply").read_bytes())


class Pipes(ToolTest):
    """What is read of a pipe is gone, so each is read once, and whole."""

    STDIN = "/dev/stdin"

    def setUp(self):
        super().setUp()
        self.balls = "".join(f"{4 * (n % 10)} {4 * (n // 10 % 10)} {4 * (n // 100)} 1.5000\n"
                             for n in range(800)).encode()  # more than a buffer of the system
        (self.folder / "a.xyzr").write_bytes(self.balls)

    def test_structures_are_whole(self):
        self.assertGreater(len(self.balls), 8192)
        for name in (self.STDIN, "-"):
            self.check(0, name, "--surface", "sas", *FAST, "-o", "a.json", "--force", input=self.balls, says="800 atoms")
            said = self.check(0, "info", name, input=self.balls).stdout.decode()
            self.assertIn("800", said)

    def test_compare(self):
        self.check(0, "compare", "a.xyzr", self.STDIN, "--surface", "sas", *FAST, "-o", "a.json", "-o", "a.vdb",
                   input=self.balls)
        report = json.loads((self.folder / "a.json").read_text())
        self.assertEqual([report[side]["atoms"] for side in "ab"], [800, 800])
        said = self.check(0, "info", "a.vdb").stdout
        self.assertIn(b"a_sha256", said)
        self.assertNotIn(b"b_sha256", said)

    def test_panels_and_lists(self):
        self.check(0, "a.xyzr", "--surface", "sas", *FAST, "-o", "a.png", "--size", "200", "--panel", self.STDIN,
                   input=self.balls)
        (self.folder / "a.list").write_text(self.STDIN + "\n")
        self.check(0, "batch", "a.list", "-O", "out", "--formats", "json", "--surface", "sas", *FAST, input=self.balls)
        self.assertEqual(json.loads((self.folder / "out" / "stdin.json").read_text())["atoms"], 800)

    def test_files_of_options(self):
        radii = b"* 1.5\n"
        self.check(0, CRAMBIN, "--radii", self.STDIN, "--surface", "sas", *FAST, "-o", "a.json", "-o", "a.vdb", input=radii)
        self.assertNotIn(b"radii.sha256", self.check(0, "info", "a.vdb").stdout)
        self.check(1, "batch", ".", "-O", "out", "--radii", self.STDIN, input=radii,
                   says=f"{self.STDIN}: is a pipe or a device, expected a file")

    def test_where_files_are_needed(self):
        """Those that are read again, and those that are read in any order."""
        os.mkfifo(self.folder / "a.pdb")
        for name in (self.STDIN, "a.pdb"):
            self.check(1, "bricks", "plan", name, "-o", "plan.json", "--bricks", "2", input=self.balls, timeout=20,
                       says=f"{name}: is a pipe or a device, expected a file")
            self.check(1, "convert", name, "-o", "a.ply", input=self.balls, timeout=20,
                       says=f"{name}: is a pipe or a device, expected a .vdb file")
            self.check(1, CRAMBIN, "--trajectory", name, "--frames", "1", "-o", "a.ply", input=self.balls, timeout=20, says=name)
        self.check(1, "info", self.STDIN, input=b" BDV" + bytes(100), says="OpenVDB file, which is not read from pipes")
        self.check(1, "compare", "a.xyzr", self.STDIN, "--surface", "sas", *FAST,
                   input=b"ply\nformat ascii 1.0\n", says="a mesh, which compare reads where its name ends in .ply")


if __name__ == "__main__":
    unittest.main()
