# SPDX-License-Identifier: MPL-2.0
"""Selections in words, in every option that takes one, and beside the programs whose words they are."""

import re
import subprocess
import unittest

from needs import MDANALYSIS_PYTHON, needs
from tool import DATA, ROOT, ToolTest

SMALL = DATA / "selections.pdb"
QUICK = ["--surface", "vdw", "--voxel", "1"]

# Asks MDAnalysis and ProDy for the numbers of atoms in tests/data/selections.tsv.
ASK = """
import gzip, pathlib, sys, tempfile, warnings
warnings.filterwarnings("ignore")
import MDAnalysis, prody
prody.confProDy(verbosity="none")
data, known, wrong = pathlib.Path(sys.argv[1]), {}, 0
with tempfile.TemporaryDirectory() as folder:
    for line in (data / "selections.tsv").read_text().splitlines()[1:]:
        name, phrase, atoms, program, theirs = line.split("\\t")
        if name not in known:
            path = data / name
            if name.endswith(".gz"):
                path = pathlib.Path(folder) / name.replace(".gz", "").replace(".ent", ".pdb")
                path.write_bytes(gzip.open(data / name).read())
            pdb = path.suffix == ".pdb"
            known[name] = (MDAnalysis.Universe(str(path)),
                           prody.parsePDB(str(path), altloc="all", model=1) if pdb else None)
        universe, atom_group = known[name]
        if program == "MDAnalysis":
            found = len(universe.select_atoms(theirs, periodic=False))
        else:
            found = len(atom_group.select(theirs) or ())
        if found != int(atoms):
            print(name, phrase, atoms, program, found)
"""


class Selections(ToolTest):
    def selected(self, path, phrase):
        """How many atoms a phrase selects."""
        error = self.check(0, path, "--select", phrase, "--hetero", "--waters", "--altloc", "all", *QUICK, "-o", "a.json",
                           "--force").stderr.decode()
        left = re.search(r"(\d+) not selected", error)
        total = int(re.search(r"model[s]?, (\d+) atoms", error)[1])
        return total - int(left[1] if left else 0)

    def test_atoms(self):
        for phrase, atoms in (("protein and name CA", 8), ("byres within 4 of resname ZN", 20), ("alt A or alt B", 2),
                              ("not (chain A or water)", 18), ("A | chain B and name P", 45)):
            with self.subTest(phrase):
                self.assertEqual(self.selected(SMALL, phrase), atoms)

    def test_every_option_takes_them(self):
        (self.folder / "groups").write_text("first chain A and protein\nsecond (nucleic) or resn ZN #d55e00\n")
        for words in (["--groups", "groups", "--color", "group", "-o", "a.ply"], ["--coarse", "chain A=residue", "-o", "a.ply"],
                      ["--resolution", "b <= 20=5", "-o", "a.ply"], ["--show", "nucleic and not name P=spheres", "-o", "a.png"],
                      ["--view", "resid 52 to 53", "-o", "a.png"]):
            with self.subTest(words[0]):
                self.check(0, SMALL, *words, "--surface", "gaussian", "--voxel", "1", "--force")

    def test_wrong_ones(self):
        for phrase, says in (("protien", "did you mean protein?"), ("within -1 of chain A", 'got "-1" at 8'),
                             ("(chain A", "expected ) for the bracket at 1"), ("chain all", 'chain "all"'),
                             ("chain and", 'chain "and"'), ("protein and", "got the end"), ("b < x", 'got "x" at 5'),
                             ("resid ten", "the number of a residue"), ("protein chain A", 'got "chain" at 9'),
                             ("within 5 water", "expected of behind the distance")):
            with self.subTest(phrase):
                self.check(2, SMALL, "--select", phrase, "-o", "a.ply", says=[f'selection "{phrase}"', says])
        self.assertEqual(self.names(), [])

    def test_words_of_the_page(self):
        """Each word in the first column of docs/selections.md is known."""
        page = (ROOT / "docs" / "selections.md").read_text()
        phrases = [phrase for line in page.splitlines() if line.startswith("| `") for phrase in re.findall("`([^`]+)`", line.split(" | ")[0])]
        self.assertGreater(len(phrases), 40)
        for phrase in phrases:
            with self.subTest(phrase):
                done = self.run_tool(SMALL, "--select", re.sub(r"\b[ST]\b", "protein", phrase.replace("\\|", "|")), "--hetero", "--waters", *QUICK, "-o", "a.json",
                                     "--force")
                self.assertIn(done.returncode, (0, 1), done.stderr.decode())

    @needs("mdanalysis")
    def test_beside_the_programs(self):
        done = subprocess.run([MDANALYSIS_PYTHON, "-c", ASK, DATA], capture_output=True, check=True, timeout=300)
        self.assertEqual(done.stdout.decode(), "")


if __name__ == "__main__":
    unittest.main()
