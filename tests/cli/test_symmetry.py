# SPDX-License-Identifier: MPL-2.0
"""Copies of an assembly, NCS, and PDB files that are named .vdb."""

import gzip
import json
import math
import unittest

from tool import CRAMBIN, DATA, FAST, ToolTest

DIMER = DATA / "1a8o.cif.gz"
QUICK = ["--surface", "vdw", "--voxel", "1"]
ATOM = "ATOM      1  CA  ALA A   1      20.000   0.000  10.000  1.00  0.00           C  \n"


def matrices(rotations, number):
    """BIOMT or MTRIX records of rotations about z [degrees]."""
    text = ""
    for i, angle in enumerate(rotations, 1):
        c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
        for row, three in enumerate(((c, -s, 0), (s, c, 0), (0, 0, 1)), 1):
            figures = "".join(f"{x:10.6f}" for x in three)
            text += number.format(row, i) + figures + f"     {0:10.5f}\n"
    return text


def ring(folds):
    return ("REMARK 350 BIOMOLECULE: 1\n"
            "REMARK 350 APPLY THE FOLLOWING TO CHAINS: A\n"
            + matrices([360 * i / folds for i in range(folds)], "REMARK 350   BIOMT{} {:3}")
            + ATOM)


def product(a, b):
    return tuple(tuple(sum(a[i][k] * b[k][j] for k in range(3)) for j in range(3))
                 for i in range(3))


def icosahedron():
    """The 60 rotations, from a five-fold axis (0, 1, golden) and a two-fold axis z."""
    golden = (1 + math.sqrt(5)) / 2
    five = tuple(tuple(x / 2 for x in row) for row in
                 ((golden - 1, -golden, 1), (golden, 1, golden - 1), (-1, golden - 1, golden)))
    two = ((-1, 0, 0), (0, -1, 0), (0, 0, 1))
    group = {}
    new = [((1, 0, 0), (0, 1, 0), (0, 0, 1))]
    while new:
        matrix = new.pop()
        key = tuple(round(x, 4) + 0.0 for row in matrix for x in row)
        if key not in group:
            group[key] = matrix
            new += [product(five, matrix), product(two, matrix)]
    return list(group.values())


def biomt(operators):
    """REMARK 350 of operators ((3x3), shift)."""
    text = ("REMARK 350 BIOMOLECULE: 1\n"
            "REMARK 350 APPLY THE FOLLOWING TO CHAINS: A\n")
    for i, (matrix, shift) in enumerate(operators, 1):
        for row, (three, t) in enumerate(zip(matrix, shift), 1):
            figures = "".join(f"{x:10.6f}" for x in three)
            text += f"REMARK 350   BIOMT{row} {i:3}{figures}     {t:10.5f}\n"
    return text


class Symmetry(ToolTest):
    def write(self, name, content):
        (self.folder / name).write_text(content)

    def atoms(self, *words):
        self.check(0, *words, "-o", "a.json", "--force", *QUICK)
        return json.loads((self.folder / "a.json").read_text())["atoms"]

    def test_copies(self):
        whole = self.atoms(DIMER, "--assembly", "1")
        self.assertEqual(self.atoms(DIMER, "--assembly", "1", "--copies", "2"), whole // 2)
        self.assertEqual(self.atoms(DIMER, "--assembly", "1", "--copies", "1-2"), whole)
        self.assertEqual(self.atoms(DIMER, "--assembly", "1", "--copies", "fold:2"), whole)

    def test_copies_are_told_in_the_vdb(self):
        self.check(0, DIMER, "--assembly", "1", "--copies", "2", "-o", "a.vdb", *QUICK)
        self.assertRegex(self.check(0, "info", "a.vdb").stdout.decode(), r"option.copies +2\n")

    def test_a_ring(self):
        self.write("ring.pdb", ring(6))
        self.assertEqual(self.atoms("ring.pdb", "--assembly", "1", "--copies", "fold:6"), 6)
        self.assertEqual(self.atoms("ring.pdb", "--assembly", "1", "--copies", "1,3,5-6"), 4)
        self.check(1, "ring.pdb", "--assembly", "1", "--copies", "fold:7", "-o", "b.vdb",
                   says=["fold:7", "1 six-fold axis"])
        self.check(1, "ring.pdb", "--assembly", "1", "--copies", "7", "-o", "b.vdb",
                   says="from 1 to 6, got 7")
        self.assertNotIn("b.vdb", self.names())

    def test_an_icosahedral_shell(self):
        self.write("shell.pdb", biomt([(m, (0, 0, 0)) for m in icosahedron()])
                   + ATOM.replace("20.000   0.000  10.000", " 6.000  50.000  70.000"))
        self.assertEqual(self.atoms("shell.pdb", "--assembly", "1"), 60)
        for fold in (2, 3, 5):
            self.assertEqual(
                self.atoms("shell.pdb", "--assembly", "1", "--copies", f"fold:{fold}"), fold)
        self.check(1, "shell.pdb", "--assembly", "1", "--copies", "fold:4", "-o", "b.vdb",
                   says=["fold:4", "6 five-fold, 10 three-fold, 15 two-fold axes"])
        text = self.check(0, "info", "shell.pdb").stdout.decode()
        self.assertRegex(text, r"point group +I\n")
        self.assertRegex(text, r"fold:5 +axis \(.*\), copies (\d+(-\d+)?(, )?){1,5}\n")

    def test_a_helix(self):
        screws = []
        for i in range(12):
            a = math.radians(27 * i)
            c, s = math.cos(a), math.sin(a)
            screws.append((((c, -s, 0), (s, c, 0), (0, 0, 1)), (0, 0, 1.41 * i)))
        self.write("helix.pdb", biomt(screws) + ATOM)
        self.assertEqual(self.atoms("helix.pdb", "--assembly", "1"), 12)
        self.assertEqual(self.atoms("helix.pdb", "--assembly", "1", "--copies", "3-5"), 3)
        self.check(1, "helix.pdb", "--assembly", "1", "--copies", "fold:5", "-o", "b.vdb",
                   says=["fold:5", "helical, rise 1.41 Å, twist 27.00 degrees"])

    def test_wrong_calls(self):
        for word in ("0", "x", "fold:1", "fold:", "3-1", "1,", "-2"):
            self.check(2, DIMER, "--assembly", "1", "--copies=" + word, "-o", "b.vdb",
                       says="--copies")
        self.check(2, DIMER, "--copies", "1", "-o", "b.vdb", says="--assembly")
        self.assertEqual(self.names(), [])

    def test_ncs(self):
        self.write("ncs.pdb", matrices([90, 180, 270], "MTRIX{} {:3}") + ATOM)
        self.assertEqual(self.atoms("ncs.pdb", "--assembly", "ncs"), 4)
        self.check(1, CRAMBIN, "--assembly", "ncs", "-o", "b.vdb", says="ncs")

    def test_info(self):
        text = self.check(0, "info", DIMER).stdout.decode()
        for line in (r"format +mmCIF", r"models +1", r"chains +1 \(A\)", r"atoms +644 \(0 hydrogen\)",
                     r"protein +524 atoms in 66 residues", r"modified +32 atoms in 4 residues \(MSE\)",
                     r"water +88 atoms in 88 residues \(HOH\)",
                     r"copies +2 of chains A", r"atoms +1288", r"point group +C2",
                     r"symmetry +1 two-fold axis", r"fold:2 +axis \(.*\), copies 1-2"):
            self.assertRegex(text, rf"\n    {line}\n")
        self.write("atom.pdb", ATOM)
        self.assertRegex(self.check(0, "info", "atom.pdb").stdout.decode(), r"assemblies +none\n")
        dummy = "HETATM    2  N   DUM  4325     -40.000   0.000  15.200                      \n"
        self.write("membrane.pdb", ATOM + dummy)
        self.assertRegex(self.check(0, "info", "membrane.pdb").stdout.decode(), r"atoms +2 \(0 hydrogen\)\n.*(.*\n)*? +dummy +1 atom in 1 residue")
        self.write("nameless.pdb", ATOM.replace(" A ", "   "))
        self.assertRegex(self.check(0, "info", "nameless.pdb").stdout.decode(), r"chains +1 \(_\)\n")
        self.check(1, "info", CRAMBIN, "none.pdb", says="none.pdb")
        with CRAMBIN.open("rb") as file:
            self.assertIn(b"327", self.check(0, "info", "-", stdin=file).stdout)

    def test_a_pdb_named_vdb(self):
        text = CRAMBIN.read_text()
        self.write("1crn_full.vdb", text)
        (self.folder / "packed.vdb").write_bytes(gzip.compress(text.encode()))
        for name in ("1crn_full.vdb", "packed.vdb"):
            self.assertRegex(self.check(0, "info", name).stdout.decode(), r"format +PDB\n")
            self.assertEqual(self.atoms(name), 327)
        done = self.check(0, "compare", "1crn_full.vdb", CRAMBIN, *QUICK)
        self.assertRegex(done.stdout.decode(), r"Hausdorff +0.000")

    def test_an_openvdb_file_of_another_name(self):
        self.check(0, CRAMBIN, "-o", "a.vdb", *FAST)
        (self.folder / "a.vdb").rename(self.folder / "a.pdb")
        self.assertIn(b"grid surface", self.check(0, "info", "a.pdb").stdout)
        self.check(1, "a.pdb", "-o", "b.vdb", says="is an OpenVDB file")


if __name__ == "__main__":
    unittest.main()
