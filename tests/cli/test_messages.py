# SPDX-License-Identifier: MPL-2.0
"""What people type first, and what the answer has to hold: one line, with what was meant."""

import re
import shlex
import subprocess
import unittest

from tool import CRAMBIN, DATA, TOOL, ToolTest

# A call, IN being a structure, and words of its answer.
ROWS = [
    ("IN -o x.pocket.csv", ["it would hold the whole surface", "-o FILE.pockets.csv"]),
    ("IN -o x.pockets.jpg", ["-o FILE.pockets.csv"]),
    ("IN -o x.pores.ply", ["-o FILE.pore.ply"]),
    ("IN -o x.residue.json", ["-o FILE.residues.csv"]),
    ("IN -o x.vdb.gz", ["a name without .gz"]),
    ("IN -o x.gltf", [".glb"]),
    ("IN --frames 1:3 -o x.ply", ["did you mean 1-3?"]),
    ("IN --frames 2,9 -o x.ply", ["did you mean 2-9?"]),
    ("IN --frames 2..9 -o x.ply", ["did you mean 2-9?"]),
    ("IN --show pocket -o x.png", ["did you mean pockets?"]),
    ("IN --show pockets=0 -o x.png", ["pockets=N with N from 1"]),
    ("IN --show cartoon -o x.png", ["did you mean tube?"]),
    ("IN --show 'resn ALA=licorice' -o x.png", ["did you mean sticks?"]),
    ("IN --show 'resn ALA' -o x.png", ['--show "resn ALA=sticks"']),
    ("IN --panel sess -o x.png", ["did you mean ses?"]),
    ("IN --panel connolly -o x.png", ["did you mean ses?", "vdb_molsurf help surface"]),
    ("IN --surface msms -o x.json", ["did you mean ses?"]),
    ("IN --surface SASA -o x.json", ["did you mean sas?"]),
    ("IN --surface vdw-surface -o x.json", ["did you mean vdw?"]),
    ("IN --surface sess -o x.json", ["did you mean ses?"]),
    ("IN --surface-of A=connolly --group-by chain -o x.json", ["did you mean ses?"]),
    ("batch . -o o", ["-o is for", "did you mean -O?"]),
    ("batch . --output o", ["did you mean -O?"]),
    ("batch IN IN -O o", ["vdb_molsurf batch - -O DIR"]),
    ("IN --probe_radius 1.4 -o x.json", ["did you mean --probe?"]),
    ("IN --Voxel 1 -o x.json", ["did you mean --voxel?"]),
    ("IN --grid 1 -o x.json", ["did you mean --voxel?"]),
    ("IN --voxel-size 1 -o x.json", ["did you mean --voxel?"]),
    ("IN --chain A -o x.json", ['did you mean --select "chain A"?']),
    ("IN --transparency 0.5 -o x.png", ["did you mean --opacity 0.5?"]),
    ("IN --align -o x.png", ["did you mean --superpose auto?"]),
    ("IN --nproc 4 -o x.json", ["did you mean -j N?"]),
    ("IN --color plddt -o x.ply", ["bfactor, with --palette plddt"]),
    ("IN --color b-factor -o x.ply", ["did you mean bfactor?"]),
    ("IN --color potential -o x.ply", ["did you mean potential=FILE.dx?"]),
    ("IN --color red -o x.ply", ["--color plain=red"]),
    ("IN --color bfactor --range 0-100 -o x.ply", ["did you mean 0,100?"]),
    ("IN --color bfactor --range 100,0 -o x.ply", ["did you mean 0,100?"]),
    ("IN --opacity 50% -o x.png", ["did you mean 0.5?"]),
    ("IN --size 800x600 -o x.png", ["did you mean 800?"]),
    ("IN --view front -o x.png", ["did you mean z?"]),
    ("IN --legend yes -o x.png", ["did you mean on?"]),
    ("IN --pieces inner -o x.ply", ["did you mean cavities?"]),
    ("IN --require closed -o x.ply", ["did you mean watertight?"]),
    ("IN --split chain -o x.ply", ["--group-by chain --split group"]),
    ("IN --group-by chains -o x.json", ["did you mean chain?"]),
    ("IN --radii bondie -o x.json", ["did you mean bondi?"]),
    ("IN --memory 4 -o x.ply", ["did you mean 4G?"]),
    ("IN -j 0 -o x.json", ["all cores are used without --threads"]),
    ("IN -j all -o x.json", ["all cores are used without --threads"]),
    ("IN --quiet=1 -o x.json", ["--quiet: it is a switch and takes no value"]),
    ("IN --interfaces -o x.json", ["got 1 group by --group-by chain"]),
    ("x.pqr --for apbs --ion-conc 150 -o run/", ["--ion-conc: expected 0 to 10 mol/L, got '150'"]),
    ("help pore-auto", ["expected a verb, a group of options or an option"]),
    ("help pockts", ["did you mean pockets?"]),
]


class Messages(ToolTest):
    def setUp(self):
        super().setUp()
        (self.folder / "x.pqr").write_text("ATOM 1 C ION 1 0 0 0 1 2\n")

    def words(self, line):
        return [str(CRAMBIN) if word == "IN" else word for word in shlex.split(line)]

    def test_what_was_meant(self):
        for line, holds in ROWS:
            with self.subTest(line):
                words = self.words(line)
                done = subprocess.run([TOOL, *words], cwd=self.folder, capture_output=True, text=True)
                self.assertIn(done.returncode, (1, 2), done.stderr)
                for word in holds:
                    self.assertIn(word, done.stderr)
        self.assertEqual(self.names(), ["x.pqr"])

    def test_a_missing_value_shows_one_that_is_taken(self):
        """Of every option of build that has a value."""
        page = subprocess.run([TOOL, "--options-page"], capture_output=True, text=True).stdout
        rows = re.findall(r"^\| `--([a-z-]+) [^|]*(?:\\\|[^|]*)*`.*\| ([a-z ,]+) \|$", page, re.M)
        names = sorted({name for name, verbs in rows if verbs == "all" or "build" in verbs.split(", ")})
        self.assertGreater(len(names), 70)
        for name in names:
            with self.subTest(name):
                error = self.check(2, CRAMBIN, f"--{name}").stderr.decode()
                found = re.search(rf"\[hint: for example (--{name} .*)\]", error)
                self.assertTrue(found, error)
                self.assertNotRegex(found[1], r"\b(SIZE|FILE|WORD|KIND|LIST|EXPR|SEL|COLOR)\b", "a name in the place of a value")
                done = self.run_tool(CRAMBIN, *shlex.split(found[1]), "--dry-run")
                self.assertNotRegex(done.stderr.decode(), rf"--{name}: expected (a |one |some |numbers|D |two )")

    def test_groups_of_options(self):
        text = self.check(0, "help", "pockets").stdout.decode()
        self.assertIn("--pocket-at SEL", text)
        self.assertEqual(text.count("\n  vdb_molsurf "), 2)
        for word in ("pocket", "POCKETS"):
            self.assertEqual(self.check(0, "help", word).stdout.decode(), text)
        self.assertEqual(self.check(0, "help", "colors").stdout, self.check(0, "help", "colours").stdout)
        self.assertIn("edge of a voxel", self.check(0, "help", "--voxel").stdout.decode())
        self.assertEqual(self.check(0, "help", "voxel").stdout, self.check(0, "help", "--voxel").stdout)
        groups = re.search(r"Groups of options: vdb_molsurf help GROUP, one of ([a-z,\s]+)\n\n", self.check(0, "--help").stdout.decode())
        for group in groups[1].replace("\n", " ").split(", "):
            with self.subTest(group):
                self.assertIn("\nExamples\n" if group != "information" else "--version",
                              self.check(0, "help", group).stdout.decode())

    def test_examples_of_groups_run(self):
        """As they are printed, but for files that are not here."""
        text = subprocess.run([TOOL, "--options-page"], capture_output=True, text=True).stdout
        titles = [title.lower() for title in re.findall(r"^## (\w+)", text, re.M)]
        for name in ("1crn.pdb", "1ubq.pdb", "1grm.pdb.gz", "1a8o.cif.gz", "1d3z.pdb.gz", "4at1.ent.gz"):
            (self.folder / name).symlink_to(DATA / name)
        (self.folder / "molecule.pqr").write_text("ATOM 1 C ION 1 0 0 0 1 2\n")
        ran = 0
        for title in titles:
            if title in ("verbs", "information"):
                continue
            for line in re.findall(r"^  (vdb_molsurf .*)$", self.check(0, "help", title).stdout.decode(), re.M):
                if re.search(r"4hhb|4v5a|top\.pdb|turn\.gif", line):
                    continue
                with self.subTest(line):
                    words = shlex.split(line.split(" > ")[0])[1:]
                    coarse = [] if "--voxel" in line or "--match" in line else ["--voxel", "1"]
                    done = self.run_tool(*words, "--force", *coarse)
                    self.assertEqual(done.returncode, 0, done.stderr)
                    ran += 1
        self.assertGreater(ran, 18)


class SilentlyAnotherThing(ToolTest):
    def test_a_solvent_less_polar_than_the_molecule(self):
        (self.folder / "x.pqr").write_text("ATOM 1 C ION 1 0 0 0 1 2\n")
        self.check(0, "x.pqr", "--for", "apbs", "--pdie", 80, "--sdie", 2, "-o", "run/", says="[hint: --pdie 2 --sdie 80]")
        done = self.check(0, "x.pqr", "--for", "apbs", "--pdie", 2, "--sdie", 1, "-o", "vacuum/")
        self.assertNotIn(b"warning", done.stderr)

    def test_nanometres(self):
        lines = [line for line in CRAMBIN.read_text().splitlines() if line.startswith("ATOM")]
        places = [[float(line[i:i + 8]) for i in (30, 38, 46)] for line in lines]
        for scale, warned in ((0.1, True), (1.0, False)):
            (self.folder / "x.xyzr").write_text("".join(f"{scale * x} {scale * y} {scale * z} 1.7\n" for x, y, z in places))
            error = self.check(0, "x.xyzr", "--voxel", 1, "-o", "x.ply", "--force").stderr.decode()
            self.assertEqual("are the coordinates in nanometres?" in error, warned, error)

    def test_axes_by_their_letters(self):
        for letter, direction in (("z", "0,0,1"), ("-x", "-1,0,0"), ("Y", "0,1,0")):
            self.check(0, CRAMBIN, "--voxel", 1, f"--view={letter}", "--size", 100, "-o", "a.png", "--force")
            self.check(0, CRAMBIN, "--voxel", 1, f"--view={direction}", "--size", 100, "-o", "b.png", "--force")
            self.assertEqual(*((self.folder / name).read_bytes() for name in ("a.png", "b.png")))
        self.check(0, CRAMBIN, "--voxel", 1, "--view", "x", "--up", "z", "--panel", "y", "--size", 100, "-o", "a.png", "--force")


class FirstWords(ToolTest):
    def test_gaps_are_named_where_a_number_depends_on_them(self):
        words = [DATA / "4at1.ent.gz", "--voxel", 1, "--force"]
        self.assertNotIn(b"gaps:", self.check(0, *words, "-o", "a.ply", "-o", "a.json").stderr)
        self.check(0, *words, "-o", "a.json", "--require", "components=1", says="gaps: the field closes")
        self.check(0, *words, "-o", "a.residues.csv", "--surface", "variational", says="gaps: the field closes")


if __name__ == "__main__":
    unittest.main()
