# SPDX-License-Identifier: MPL-2.0
"""Inputs that cannot be used have status 1, say why in one line, and leave nothing behind."""

import gzip
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


if __name__ == "__main__":
    unittest.main()
