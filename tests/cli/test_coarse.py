# SPDX-License-Identifier: MPL-2.0
"""Beads: --coarse."""

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
        self.assertRegex(text, r"option.coarse +residue A/1-9=4\n")

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


if __name__ == "__main__":
    unittest.main()
