# SPDX-License-Identifier: MPL-2.0
"""Every printed block of README.md and the guides is typed by a test, or a comment above it gives the reason why not:

    <!-- typed -->                     by this file, after the blocks of shell of its page, with bash
    <!-- typed, needs apbs pdb2pqr --> the same where these programs are (needs.py)
    <!-- typed by FILE -->             elsewhere: by a test or script of the repository
    <!-- not typed: REASON -->         an exception, of which there are few
    <!-- text -->                      no command: the content of a file, a formula

Fenced blocks of sh are those of test_readme.py, Python of python.md that of python/tests/test_docs.py; other fenced Python
is typed here, by the Python of MOLSURF_MODULE that has the module. Formulas of math.md are text."""

import os
import pathlib
import re
import shutil
import subprocess
import unittest

from needs import MODULE_PYTHON, lacks, needs, runs, typable
from tool import CRAMBIN, ROOT, TOOL, ToolTest

MADE = ("options.md", "python_api.md")  # by programs
PAGES = [ROOT / "README.md", *(page for page in sorted((ROOT / "docs").glob("*.md")) if page.name not in MADE)]
MODULE = MODULE_PYTHON
MOST = 12  # exceptions


class Block:
    """A block of a page, with the language of its fence ("" of an indented one) and the comment above it."""

    def __init__(self, page, line, language, text, mark):
        self.page, self.line, self.language, self.text = page, line, language, text
        self.kind, self.more = mark

    def __repr__(self):
        return f"{self.page.name}:{self.line}"

    @property
    def needed(self):
        """Programs that it needs."""
        return self.more.split() if self.kind == "typed, needs" else []

    @property
    def isTyped(self):
        return self.kind in ("typed", "typed, needs")


def mark_of(line):
    found = re.fullmatch(r"<!-- (typed, needs|typed by|not typed:|typed|text|needs) ?(.*?) ?-->", line.strip())
    return (found[1], found[2]) if found else ("", "")


def blocks_of(page):
    """The blocks of a page, without those in comments of several lines."""
    text = re.sub(r"<!--(?:(?!-->).)*\n.*?-->", lambda m: "\n" * m[0].count("\n"), page.read_text(), flags=re.DOTALL)
    lines, out, last, at = text.split("\n"), [], "", 0
    while at < len(lines):
        line = lines[at]
        fence = re.match(r"```(\w*)$", line)
        if fence:
            end = lines.index("```", at + 1)
            out.append(Block(page, at + 1, fence[1] or "text", "\n".join(lines[at + 1:end]) + "\n", mark_of(last)))
            last, at = "", end + 1
            continue
        # Lines indented by four are a block where an empty line is above, outside of a list.
        if line.startswith("    ") and at > 0 and not lines[at - 1].strip():
            end = at
            while end < len(lines) and (lines[end].startswith("    ") or not lines[end].strip()):
                end += 1
            part = [one[4:] for one in lines[at:end]]
            out.append(Block(page, at + 1, "", "\n".join(part).rstrip() + "\n", mark_of(last)))
            last, at = "", end
            continue
        if line.strip():
            last = line
        at += 1
    return out


ALL = [block for page in PAGES if page.name != "math.md" for block in blocks_of(page)]


class Blocks(ToolTest):
    def setUp(self):
        super().setUp()
        for name in ("tests", "scripts"):
            (self.folder / name).symlink_to(ROOT / name)
        (self.folder / "bin").mkdir()
        for name in ("vdb_molsurf", "vdb_molsurf_msms", "vdb_molsurf_nanoshaper"):
            (self.folder / "bin" / name).symlink_to(pathlib.Path(TOOL).resolve().parent / name)

    def type(self, block):
        path = f"{self.folder / 'bin'}:{os.environ['PATH']}"
        done = subprocess.run(["bash", "-e", "-o", "pipefail", "-c", typable(block.text)], cwd=self.folder, timeout=600,
                              env={**os.environ, "PATH": path, "HOME": str(self.folder)}, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, f"{block}: {done.stderr}")

    def test_every_block_is_typed(self):
        """Or marked; prints how many of each there are."""
        known = {"sh": "test_readme.py", "cpp": "test_readme.py"}
        counts = {}
        for block in ALL:
            by = known.get(block.language) or ("test_docs.py" if block.page.name == "python.md" else "")
            if block.language == "python":
                by = by or "this file"
            kind = by or block.kind
            self.assertTrue(kind, f"{block}: expected a comment above it such as <!-- typed -->, got none")
            if block.kind == "typed by":
                self.assertTrue((ROOT / block.more).exists(), f"{block}: there is no {block.more}")
            counts[kind] = counts.get(kind, 0) + 1
        exceptions = [block for block in ALL if block.kind == "not typed:"]
        print(f"{len(ALL)} blocks:", ", ".join(f"{count} {kind}" for kind, count in sorted(counts.items())), flush=True)
        for block in exceptions:
            self.assertTrue(block.more, f"{block}: expected a reason")
        self.assertLessEqual(len(exceptions), MOST, exceptions)

    def test_markers_are_found(self):
        """This file itself: a block without a comment is found, and one that fails."""
        page = self.folder / "page.md"
        page.write_text("Text:\n\n    true\n\n<!-- typed -->\n\n    false\n\n- an item:\n    not a block\n\n```sh\nls\n```\n")
        found = blocks_of(page)
        self.assertEqual([(b.language, b.text, b.kind) for b in found],
                         [("", "true\n", ""), ("", "false\n", "typed"), ("sh", "ls\n", "")])
        with self.assertRaises(AssertionError):
            self.type(found[1])

    def test_commands_without_films(self):
        """Where ffmpeg is not here, only the commands that make films are left out of a block."""
        block = "mkdir x\nvdb_molsurf a.pdb \\\n  -o x/a.png\nvdb_molsurf a.pdb --turntable 3 \\\n  -o x/a.gif\nls x\n"
        lost = block if not lacks("ffmpeg") else block.replace("vdb_molsurf a.pdb --turntable 3 \\\n  -o x/a.gif\n", "")
        self.assertEqual(typable(block), lost)

    def type_page(self, page):
        """The indented blocks, after the blocks of shell that stand above them."""
        blocks = [block for block in ALL if block.page == page]
        last = max(n for n, block in enumerate(blocks) if block.isTyped)
        for block in blocks[:last + 1]:
            if any(map(lacks, block.needed)) or not (block.isTyped or block.language == "sh"):
                continue
            with self.subTest(block):
                self.type(block)

    def test_coming_from(self):
        """Options of the page's tables are those of the program."""
        cells = re.findall(r"`((?:--[a-z]|-o )[^`]*)`", (ROOT / "docs" / "coming_from.md").read_text())
        self.assertGreater(len(cells), 30)
        for cell in cells:
            if "FILE" in cell or cell in ("--probe", "--voxel", "--superpose auto"):
                continue
            words = cell.replace("b.pdb", f"'{CRAMBIN}'")
            output = "" if "-o " in cell else " -o x.json"
            done = subprocess.run(f"'{TOOL}' '{CRAMBIN}' {words}{output} --voxel 1 -q --force" if "--voxel" not in cell else
                                  f"'{TOOL}' '{CRAMBIN}' {words}{output} -q --force",
                                  shell=True, cwd=self.folder, capture_output=True, text=True, timeout=120)
            self.assertNotEqual(done.returncode, 2, f"{cell}: {done.stderr}")


class Module(ToolTest):
    @needs("module")
    def test_python_of_the_guides(self):
        """Blocks of Python of each page, one after the other in one folder, where x.pdb and 1crn.pdb are."""
        for page in PAGES:
            blocks = [block for block in ALL if block.page == page and block.language == "python"]
            if page.name == "python.md" or not blocks:
                continue
            for name in ("x.pdb", "1crn.pdb"):
                shutil.copy(CRAMBIN, self.folder / name)
            code = ""
            for block in blocks:
                if block.kind == "needs" and not runs(MODULE, "-c", f"import {block.more}"):
                    continue
                with self.subTest(block):
                    done = subprocess.run([MODULE, "-c", code + block.text], cwd=self.folder, capture_output=True,
                                          text=True, timeout=300)
                    self.assertEqual(done.returncode, 0, f"{block}: {done.stderr}")
                code += block.text + "\n"


def add_tests():
    """A test for each page with typed blocks; it is skipped where none of their programs is there."""
    for page in PAGES:
        typed = [block for block in ALL if block.page == page and block.isTyped]
        if not typed:
            continue
        test = lambda self, page=page: self.type_page(page)  # noqa: E731
        if all(block.needed for block in typed):
            wanted = typed[0].needed[0]
            test = needs(wanted)(test)
        setattr(Blocks, f"test_blocks_of_{page.stem.lower()}", test)


add_tests()

if __name__ == "__main__":
    unittest.main()
