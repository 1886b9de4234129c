# SPDX-License-Identifier: MPL-2.0
"""Beads: --coarse, and files of them."""

import json
import unittest

from tool import CRAMBIN, DATA, ToolTest, read_ply

DIMER = DATA / "1a8o.cif.gz"
QUICK = ["--surface", "sas", "--voxel", "1"]


class Coarse(ToolTest):
    def report(self, *words):
        done = self.check(0, *words, "-o", "a.json", "--force", *QUICK)
        return json.loads((self.folder / "a.json").read_text()), done.stderr.decode()

    def test_residues(self):
        fine, _ = self.report(DIMER)
        self.assertIsNone(fine["coarse"])
        coarse, said = self.report(DIMER, "--coarse", "residue")
        self.assertEqual(coarse["coarse"], {"beads": 136, "atoms": 556})
        self.assertEqual(coarse["atoms"], 136)
        self.assertIn("used 136 balls, of them 136 beads for 556 atoms", said)
        ratio = coarse["surface"]["volume"] / fine["surface"]["volume"]
        self.assertAlmostEqual(ratio, 1, delta=1e-3)

    def test_copies(self):
        both, _ = self.report(DIMER, "--coarse", "4", "--assembly", "1")
        self.assertEqual(both["coarse"], {"beads": 278, "atoms": 1112})

    def test_later_rules_win(self):
        mixed, said = self.report(CRAMBIN, "--coarse", "10", "--coarse", "A/1-9=atom")
        atoms = mixed["atoms"] - mixed["coarse"]["beads"]
        self.assertEqual(mixed["coarse"]["atoms"] + atoms, 327)
        self.assertIn(f"beads for {mixed['coarse']['atoms']} atoms", said)
        alone, _ = self.report(CRAMBIN, "--coarse", "residue", "--coarse", "atom")
        self.assertIsNone(alone["coarse"])

    def test_groups_and_labels(self):
        self.check(0, CRAMBIN, "--coarse", "residue", "--group-by", "residues:23", "-o", "a.ply",
                   "-o", "a.json", *QUICK)
        groups = json.loads((self.folder / "a.json").read_text())["groups"]
        self.assertEqual(sum(group["atoms"] for group in groups), 88)
        names, vertices, _ = read_ply((self.folder / "a.ply").read_bytes())
        atoms = {vertex[names.index("atom_id")] for vertex in vertices}
        self.assertTrue(atoms <= set(range(327)) and 40 < len(atoms) <= 88, len(atoms))

    def test_told_in_the_vdb(self):
        self.check(0, CRAMBIN, "--coarse", "residue", "--coarse", "A/1-9=4", "-o", "a.vdb", *QUICK)
        text = self.check(0, "info", "a.vdb").stdout.decode()
        self.assertRegex(text, r"option.coarse +residue, A/1-9=4\n")

    def test_the_same_bits(self):
        for name, threads in (("a", 1), ("b", 2)):
            self.check(0, CRAMBIN, "--coarse", "residue", "-o", name + ".ply", "-j", threads,
                       *QUICK)
        a, b = ((self.folder / name).read_bytes() for name in ("a.ply", "b.ply"))
        self.assertEqual(a, b)

    def test_wrong_calls(self):
        for word in ("0", "-3", "1.5", "residues", "A/1-9=", "=4", "1000001"):
            self.check(2, CRAMBIN, "--coarse=" + word, "-o", "b.vdb",
                       says=["--coarse: expected atom, residue", f'"{word}"'])
        self.check(1, CRAMBIN, "--coarse", "B=residue", "-o", "b.vdb",
                   says=['"B"', "the chains are A"])
        self.assertEqual(self.names(), [])

class Martini(ToolTest):
    def write(self, residues):
        """Beads in a row, 3 Å apart: {"ALA": "BB SC1"}."""
        text = ""
        atoms = [(residue, i, bead) for i, (residue, beads) in enumerate(residues)
                 for bead in beads.split()]
        for n, (residue, i, bead) in enumerate(atoms, 1):
            text += (f"ATOM  {n:5}  {bead:3} {residue:4}A{i:4}    {3.0 * n:8.3f}{0:8.3f}{0:8.3f}"
                     "  1.00  0.00\n")
        (self.folder / "beads.pdb").write_text(text)

    def said(self, *words):
        return self.check(0, "beads.pdb", *words, "-o", "a.json", "--force",
                          *QUICK).stderr.decode()

    def test_radii_by_size(self):
        self.write([("ALA", "BB"), ("PHE", "BB SC1 SC2 SC3"), ("W", "W")])
        self.assertIn("beads of Martini 2, not atoms: radii martini2 were used: 2 of 2.64 Å, "
                      "3 of 2.41 Å\n", self.said())
        self.assertIn("dropped 1 water", self.said())
        self.assertIn("3 of 2.64 Å, 3 of 2.41 Å\n", self.said("--waters"))
        self.assertIn("radii martini3 were used: 1 of 2.64 Å, 2 of 2.30 Å, 2 of 1.91 Å",
                      self.said("--radii", "martini3"))
        self.assertRegex(self.check(0, "info", "beads.pdb").stdout.decode(), r"beads +Martini 2\n")

    def test_named_by_atoms(self):
        self.write([("MET", "CA CG"), ("ALA", "CA"), ("PHE", "CA CE1 CE2")])
        self.assertIn("beads, not atoms (one or a few a residue): radii martini2 were used: "
                      "6 of 2.64 Å\n", self.said())

    def test_radii_of_the_user(self):
        self.write([("ALA", "BB"), ("LEU", "BB SC1")])
        (self.folder / "my.radii").write_text("* 3.0\n")
        self.assertNotIn("martini", self.said("--radii", "my.radii"))

    def test_atoms_as_beads(self):
        self.check(0, CRAMBIN, "--radii", "martini", "-o", "a.json", *QUICK,
                   says="the file has atoms, not beads: radii martini2 were used: 327 of 2.64 Å")


if __name__ == "__main__":
    unittest.main()
