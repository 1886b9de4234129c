# SPDX-License-Identifier: MPL-2.0
"""--superpose: one structure laid on another, for compare, --panel and --frames."""

import gzip
import json
import re
import unittest

from needs import needs
from tool import CRAMBIN, DATA, FAST, ToolTest

TURN = ((0.36, 0.48, -0.8), (-0.8, 0.6, 0.0), (0.48, 0.64, 0.6))
SHIFT = (40.0, -25.0, 60.0)


def product(a, b):
    return [[sum(x * y for x, y in zip(row, column)) for column in zip(*b)] for row in a]


def rigid(turn, shift):
    """A rigid motion as four rows."""
    return [[*row, t] for row, t in zip(turn, shift)] + [[0, 0, 0, 1]]


def inverse(motion):
    back = [list(column) for column in zip(*(row[:3] for row in motion[:3]))]
    return rigid(back, [-sum(a * row[3] for a, row in zip(line, motion)) for line in back])


MOTION = rigid(TURN, SHIFT)


def moved(text):
    """A PDB file turned and shifted, assemblies too."""
    lines, rows = [], {}
    for line in text.splitlines():
        if line[:6] in ("ATOM  ", "HETATM"):
            x = product(MOTION, [[float(line[i:i + 8])] for i in (30, 38, 46)] + [[1]])
            line = line[:30] + "".join(f"{c:8.3f}" for c, in x[:3]) + line[54:]
        elif found := re.match(r"REMARK 350   BIOMT(\d) +(\d+) +(.*)", line):
            rows.setdefault(found[2], []).append((len(lines), [float(w) for w in found[3].split()]))
        lines.append(line)
    for number, one in rows.items():
        new = product(product(MOTION, [row for _, row in one] + [[0, 0, 0, 1]]), inverse(MOTION))
        for k, (at, _) in enumerate(one):
            lines[at] = f"REMARK 350   BIOMT{k + 1} {number:>3}" + "".join(f"{x:12.8f}" for x in new[k][:3]) + f"     {new[k][3]:12.6f}"
    return "\n".join(lines) + "\n"


def models(path):
    """The texts of the models of a PDB file."""
    text = gzip.open(path, "rt").read()
    return [part.split("ENDMDL")[0].split("\n", 1)[1] for part in re.split(r"^MODEL ", text, flags=re.M)[1:]]


class Superpose(ToolTest):
    def compare(self, *words):
        self.check(0, "compare", *words, *FAST, "-o", "r.json", "--force")
        return json.loads((self.folder / "r.json").read_text())

    def test_a_moved_copy_comes_back(self):
        (self.folder / "b.pdb").write_text(moved(CRAMBIN.read_text()))
        for select in ("auto", "name CA", "resid 3-9 and name N or name C"):
            report = self.compare(CRAMBIN, "b.pdb", "--superpose", select)
            self.assertLess(report["superposition"]["rmsd"], 1e-3)
            self.assertLess(report["hausdorff"], 0.2)
            self.assertLess(report["a_to_b"]["mean"], 0.01)
            for row, wanted in zip(report["superposition"]["matrix"], inverse(MOTION)):
                for a, b in zip(row, wanted):
                    self.assertAlmostEqual(a, b, delta=0.1 if b == wanted[3] else 1e-3)
        self.assertEqual(report["superposition"]["atoms"], 7 + 46)

    def test_without_it_a_warning(self):
        (self.folder / "b.pdb").write_text(moved(CRAMBIN.read_text()))
        done = self.check(0, "compare", CRAMBIN, "b.pdb", *FAST, says=["Å apart", "[hint: --superpose auto lays B on A]"])
        self.assertIn("distance", done.stdout.decode())
        done = self.check(0, "compare", CRAMBIN, CRAMBIN, *FAST)
        self.assertNotIn(b"apart", done.stderr)
        self.check(0, "b.pdb", *FAST, "-o", "b.ply")
        done = self.check(0, "compare", CRAMBIN, "b.ply", *FAST, says="Å apart")
        self.assertNotIn(b"superpose", done.stderr)

    @needs("biopython")
    def test_biopython_has_the_same_rmsd(self):
        """Two models of ubiquitin by NMR, on the CA of residues 1 to 70."""
        import Bio.PDB
        texts = models(DATA / "1d3z.pdb.gz")
        for name, text in zip("ab", texts):
            (self.folder / f"{name}.pdb").write_text(moved(text) if name == "b" else text)
        report = self.compare("a.pdb", "b.pdb", "--superpose", "name CA and resid 1-70")
        parser, chosen = Bio.PDB.PDBParser(QUIET=True), []
        for name in "ab":
            chain = parser.get_structure(name, self.folder / f"{name}.pdb")[0]["A"]
            chosen.append([residue["CA"] for residue in chain if residue.id[1] <= 70])
        other = Bio.PDB.Superimposer()
        other.set_atoms(*chosen)
        self.assertEqual(report["superposition"]["atoms"], 70)
        self.assertAlmostEqual(report["superposition"]["rmsd"], other.rms, delta=1e-4)
        self.assertLess(report["a_to_b"]["mean"], 0.5)

    def test_an_assembly_moves_as_a_whole(self):
        text = gzip.open(DATA / "1a8o.pdb.gz", "rt").read()
        (self.folder / "a.pdb").write_text(text)
        (self.folder / "b.pdb").write_text(moved(text))
        report = self.compare("a.pdb", "b.pdb", "--assembly", 1, "--superpose", "auto")
        self.assertLess(report["superposition"]["rmsd"], 1e-3)
        self.assertLess(report["a_to_b"]["mean"], 0.01)
        self.assertEqual(report["a"]["atoms"], report["b"]["atoms"])

    def test_chains_of_other_names(self):
        """Of one chain each the names do not count; of more they do."""
        text = CRAMBIN.read_text()
        renamed = "\n".join(line[:21] + "Q" + line[22:] if line[:4] == "ATOM" else line for line in text.splitlines()) + "\n"
        (self.folder / "b.pdb").write_text(moved(renamed))
        self.assertLess(self.compare(CRAMBIN, "b.pdb", "--superpose", "auto")["superposition"]["rmsd"], 1e-3)
        both = "\n".join(line for line in text.splitlines() if line[:4] == "ATOM") + "\nTER\n" + moved(renamed)
        (self.folder / "two.pdb").write_text(both)
        self.check(1, "compare", "two.pdb", CRAMBIN, "--superpose", "name ZN", *FAST, says="matches no atom")
        # Chains that have other names: what the error proposes helps.
        other = "\n".join(line[:21] + "Z" + line[22:] if line[:4] == "ATOM" else line for line in text.splitlines()) + "\n"
        (self.folder / "z.pdb").write_text(other)
        (self.folder / "pq.pdb").write_text(both.replace(" A ", " P "))
        self.check(1, "compare", "pq.pdb", "z.pdb", "--superpose", "auto", *FAST, says="[hint: --select takes one chain of each]")
        report = self.compare("pq.pdb", "z.pdb", "--superpose", "auto", "--select", "chain P or chain Z")
        self.assertLess(report["superposition"]["rmsd"], 1e-3)
        report = self.compare("two.pdb", CRAMBIN, "--superpose", "auto")
        self.assertEqual(report["superposition"]["atoms"], 46)

    def test_of_locations_the_most_occupied_counts(self):
        lines = CRAMBIN.read_text().splitlines()
        for at, line in enumerate(lines):
            if line[12:16] == " CA " and line[22:26] == "  10":
                far = f"{line[:16]}B{line[17:30]}{float(line[30:38]) + 4:8.3f}{line[38:56]}0.30{line[60:]}"
                lines[at:at + 1] = [far, f"{line[:16]}A{line[17:56]}0.70{line[60:]}"]
                break
        (self.folder / "b.pdb").write_text("\n".join(lines) + "\n")
        report = self.compare(CRAMBIN, "b.pdb", "--altloc", "all", "--superpose", "auto")
        self.assertEqual(report["superposition"]["atoms"], 46)
        self.assertLess(report["superposition"]["rmsd"], 1e-3)

    def test_what_cannot_be_superposed(self):
        (self.folder / "one.xyzr").write_text("0 0 0 1.7\n")
        self.check(0, CRAMBIN, *FAST, "-o", "a.ply")
        self.check(1, "compare", CRAMBIN, "a.ply", *FAST, "--superpose", "auto", says="expected two structures, got a mesh, a.ply")
        self.check(1, "compare", "one.xyzr", CRAMBIN, *FAST, "--superpose", "auto", says="there is no CA or C4'")
        self.check(1, "compare", CRAMBIN, DATA / "1ubq.pdb", *FAST, "--superpose", "name CA and resid 7-8",
                   says=["expected at least three atoms", "1ubq.pdb and 1crn.pdb, not on one line, got 2"])
        self.check(2, CRAMBIN, *FAST, "--superpose", "auto", "-o", "b.ply", says="expected --frames or --trajectory or --panel too")

    def test_frames_lie_on_the_first(self):
        """The middle model is turned and shifted; with --superpose its mesh lies where that of its first state lies."""
        texts = models(DATA / "1d3z.pdb.gz")[:2]
        parts = [texts[0], moved(texts[0]), moved(texts[1])]
        (self.folder / "m.pdb").write_text("".join(f"MODEL     {n}\n{text}ENDMDL\n" for n, text in enumerate(parts, 1)))
        done = self.check(0, "m.pdb", *FAST, "--frames", "all", "--superpose", "auto", "-o", "f.ply")
        lines = [line for line in done.stderr.decode().splitlines() if "rmsd" in line]
        self.assertEqual(len(lines), 2)
        self.assertRegex(lines[0], r"superposed by 76 atoms, rmsd 0\.00\d Å")
        for n, most in ((2, 0.01), (3, 0.6)):
            self.check(0, "compare", "f.0001.ply", f"f.{n:04}.ply", "-o", "r.json", "--force")
            report = json.loads((self.folder / "r.json").read_text())
            self.assertLess(report["a_to_b"]["mean"], most)

    def test_panels_lie_on_the_first(self):
        (self.folder / "b.pdb").write_text(moved(CRAMBIN.read_text()))
        done = self.check(0, CRAMBIN, *FAST, "--panel", "b.pdb", "--superpose", "auto", "--size", 300, "-o", "p.png")
        self.assertRegex(done.stderr.decode(), r"superposed by 46 atoms, rmsd 0\.00\d Å")


if __name__ == "__main__":
    unittest.main()
