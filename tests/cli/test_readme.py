# SPDX-License-Identifier: MPL-2.0
"""The commands of README.md and the guides, and the C++, work as they stand."""

import json
import os
import pathlib
import re
import shlex
import subprocess
import unittest

from tool import ROOT, TOOL, ToolTest

# Guides; the other pages of docs/ have no commands to run, which test_every_page_is_here checks.
GUIDES = {name: ROOT / "docs" / f"{name}.md" for name in
          ("complexes", "artists", "pipelines", "trajectories", "structural_biology")}
PAGES = [ROOT / "README.md", *GUIDES.values()]


def blocks(language, page=PAGES[0]):
    """The fenced blocks of a language."""
    return re.findall(rf"^```{language}\n(.*?)^```$", page.read_text(), re.MULTILINE | re.DOTALL)


def promised(block):
    """The files that a block writes; of frames the first."""
    words = shlex.split(block, comments=True)
    files = [after for word, after in zip(words, words[1:]) if word in ("-o", ">")]
    if "--frames" in words:
        files = [re.sub(r"\.(?!csv$)(\w+)$", r".0001.\1", name) for name in files]
    return [name for name in files if name != "-"]


class Readme(ToolTest):
    def setUp(self):
        super().setUp()
        (self.folder / "tests").symlink_to(ROOT / "tests")
        (self.folder / "bin").mkdir()
        (self.folder / "bin" / "vdb_molsurf").symlink_to(pathlib.Path(TOOL).resolve())

    def test_commands_of_the_readme(self):
        self.run_commands(PAGES[0])

    def test_commands_of_the_guide_to_complexes(self):
        self.run_commands(GUIDES["complexes"])

    def test_commands_of_the_artists_guide(self):
        self.run_commands(GUIDES["artists"])

    def test_commands_of_the_pipelines(self):
        self.run_commands(GUIDES["pipelines"])

    def test_commands_of_the_guide_to_frames(self):
        self.run_commands(GUIDES["trajectories"])

    def test_commands_of_the_biologists_guide(self):
        self.run_commands(GUIDES["structural_biology"])

    def test_numbers_of_the_biologists_guide(self):
        """Its table of areas and volumes, and what it says of cavities and of the interface."""
        text = GUIDES["structural_biology"].read_text()
        rows = re.findall(r"^\|.*?`(?:--surface )?(sas|ses|vdw|variational)`.*\| ([\d,]+), ([\d,]+) \|$",
                          text, re.MULTILINE)
        self.assertEqual(sorted(row[0] for row in rows), ["sas", "ses", "variational", "vdw"])
        for kind, area, volume in rows:
            self.check(0, ROOT / "tests/data/1ubq.pdb", "--surface", kind, "-o", f"{kind}.json")
            report = json.loads((self.folder / f"{kind}.json").read_text())["surface"]
            for found, said in ((report["area"], area), (report["volume"], volume)):
                self.assertAlmostEqual(found / int(said.replace(",", "")), 1, delta=3e-4, msg=kind)
        self.check(0, ROOT / "tests/data/1a8o.cif.gz", "--assembly", "1", "--group-by", "copy",
                   "--surface", "sas", "--interfaces", "-o", "buried.json")
        pair, = json.loads((self.folder / "buried.json").read_text())["interfaces"]
        self.assertIn(f"{pair['buried_area']:.0f} Å² for this dimer", text)
        self.check(0, ROOT / "tests/data/4at1.ent.gz", "--surface", "ses", "-o", "cavities.json")
        holes = json.loads((self.folder / "cavities.json").read_text())["surface"]["cavity_list"]
        self.assertIn(f"in 4AT1 {len(holes)}, the largest {holes[0]['volume']:.0f} Å³", text)

    def test_every_page_is_here(self):
        """A page with commands to run is one of those whose commands are run."""
        found = {*ROOT.glob("*.md"), *(ROOT / "docs").rglob("*.md")}
        self.assertLessEqual(set(PAGES), found)
        for page in found - set(PAGES):
            self.assertEqual(blocks("sh", page), [], page)
        self.assertEqual({page for page in GUIDES.values()
                          if f"docs/{page.name}" not in PAGES[0].read_text()}, set())

    def run_commands(self, page):
        """In the order of the page and in one folder, since later ones use files of earlier ones."""
        commands = blocks("sh", page)
        self.assertGreaterEqual(len(commands), 2)
        path = f"{self.folder / 'bin'}:{os.environ['PATH']}"
        for block in commands:
            with self.subTest(block):
                self.assertIn("vdb_molsurf ", block)
                done = subprocess.run(["bash", "-e", "-o", "pipefail", "-c", block],
                                      cwd=self.folder, env={**os.environ, "PATH": path},
                                      capture_output=True, text=True, timeout=300)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertTrue(promised(block) or done.stdout, "neither a file nor an answer")
                for name in promised(block):
                    self.assertGreater((self.folder / name).stat().st_size, 0, name)

    def test_options_are_in_the_help(self):
        """Every option that the pages name is one that --help or a verb's --help names."""
        text = b"".join(self.check(0, *words, "--help").stdout for words in
                        ([], ["batch"], ["compare"], ["plan"], ["brick"], ["merge"], ["mesh"], ["color"]))
        text = text.decode()
        known = set(re.findall(r"--[a-z][a-z-]*", text))
        spans = [span for page in PAGES
                 for span in re.findall(r"`(?:vdb_molsurf[^`]*|--[^`]*)`", page.read_text())]
        named = {option for span in spans for option in re.findall(r"--[a-z][a-z-]*", span)}
        self.assertGreater(len(named), 10)
        self.assertEqual(named - known, set())

    def test_cpp_is_compiled_elsewhere(self):
        """The lines of the example are lines of the project that the package test compiles."""
        compiled = {line.strip() for line in
                    (ROOT / "tests" / "package" / "consumer.cpp").read_text().splitlines()}
        examples = blocks("cpp")
        self.assertEqual(len(examples), 1)
        for line in examples[0].splitlines():
            self.assertIn(line.strip(), compiled)

    def test_links(self):
        for page in PAGES:
            for target in re.findall(r"\]\(([^)#]+)\)", page.read_text()):
                self.assertTrue((page.parent / target).exists(), target)


if __name__ == "__main__":
    unittest.main()
