# SPDX-License-Identifier: MPL-2.0
"""The commands of README.md and the guides, and the C++, work as they stand."""

import os
import pathlib
import re
import shlex
import subprocess
import unittest

from tool import ROOT, TOOL, ToolTest

PAGES = [ROOT / "README.md", *(ROOT / "docs" / f"{name}.md" for name in
                               ("complexes", "artists", "pipelines", "trajectories"))]


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

    def test_commands_of_the_guide(self):
        self.run_commands(PAGES[1])

    def test_commands_of_the_artists_guide(self):
        self.run_commands(PAGES[2])

    def test_commands_of_the_pipelines(self):
        self.run_commands(PAGES[3])

    def test_commands_of_the_guide_to_frames(self):
        self.run_commands(PAGES[4])

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
