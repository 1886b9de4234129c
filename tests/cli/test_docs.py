# SPDX-License-Identifier: MPL-2.0
"""scripts/check_docs.py finds nothing in the tree as it is, and every fault that is planted in a small one."""

import importlib.util
import pathlib
import subprocess
import sys
import tempfile
import unittest

from tool import ROOT, TOOL

SPEC = importlib.util.spec_from_file_location("check_docs", ROOT / "scripts" / "check_docs.py")
check_docs = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(check_docs)

PROGRAM = check_docs.Program("vdb_molsurf INPUT\n\n      --voxel H           edge of a voxel [0.5]\n"
                             "      --memory SIZE       memory; the flow then takes --steps [12]\n"
                             "      --surface KIND      variational\n                          or ses [variational]\n")
TREE = {
    "README.md": "[Formulas](docs/math.md#1-symbols), [guides](docs)\n",
    "CONTRIBUTING.md": "Run `scripts/run.sh`.\n\n    scripts/run.sh --all\n",
    "scripts/run.sh": "",
    "scripts/docs.sh": "copied=(README.md CONTRIBUTING.md\n  docs)\n",
    "mkdocs.yml": "nav:\n  - README.md\n  - CONTRIBUTING.md\n  - docs/math.md\n  - Guide: docs/guide.md\n  - docs/adr/0001.md\n",
    "docs/math.md": "# Formulas\n\n## 1. Symbols\n\n`Options::voxel` is `h`, see section 2.\n\n## 2. Field\n",
    "docs/adr/0001.md": "`core/options.h`, `core/options`, `options.h`, `gatherLeaf()`, `Options`, (../math.md), section 1\n",
    "docs/guide.md": "`--voxel H` (0.5); `--surface` is `variational` by default\n\n"
                     "| option | default | text |\n|---|---|---|\n| `--voxel H` | 0.5 Å | edge |\n",
    "src/molsurf/core/options.h": "// docs/math.md,\n// section 2\nstruct Options {\n"
                                  "    double voxel = 0.5; // not: radius {\n};\nvoid gatherLeaf();\n",
}
# What is appended to which file, and what the checker says.
FAULTS = [
    ("README.md", "[x](docs/other.md)", "the link leads to nothing: docs/other.md"),
    ("README.md", "[x](docs/math.md#3-more)", "docs/math.md has no heading #3-more"),
    ("CONTRIBUTING.md", "    scripts/gone.sh", "there is no scripts/gone.sh"),
    ("docs/math.md", "sections 1 and 3", "math.md has no section 3"),
    ("docs/guide.md", "[math.md](math.md), section 7", "math.md has no section 7"),
    ("docs/guide.md", "docs old.md, section 7", "old.md has no section 7"),
    ("docs/adr/0001.md", "`Options::radius`", "the code has no Options::radius"),
    ("docs/adr/0001.md", "`Choice::voxel`", "the code has no Choice::voxel"),
    ("docs/adr/0001.md", "`scatterLeaf`", "the code has no scatterLeaf"),
    ("docs/adr/0001.md", "`scatter()`", "the code has no scatter"),
    ("docs/adr/0001.md", "`kernel/options.h`", "there is no kernel/options.h"),
    ("docs/adr/0001.md", "`kernel/options`", "there is no kernel/options"),
    ("docs/adr/0001.md", "`choice.h`", "there is no file choice.h"),
    ("docs/guide.md", "`vdb_molsurf a.pdb --voxels 1`", "the program has no --voxels"),
    ("docs/guide.md", "`--step`", "the program has no --step"),
    ("docs/guide.md", "`--voxel` (1)", "the default of --voxel is 0.5, not 1"),
    ("docs/guide.md", "`--voxel` has the default 0.25", "the default of --voxel is 0.5, not 0.25"),
    ("docs/guide.md", "`--steps` is 16 by default", "the default of --steps is 12, not 16"),
    ("docs/guide.md", "16 steps, or 16 unless `--steps` says", "the default of --steps is 12, not 16"),
    ("docs/guide.md", "See ADR 0002.", "there is no ADR 0002"),
    ("docs/guide.md", "| option | default |\n|---|---|\n| `--surface KIND` | ses |",
     "the default of --surface is variational, not ses"),
    ("docs/guide.md", "[x](../scripts/run.sh)", "scripts/docs.sh does not copy ../scripts/run.sh into the site"),
    ("mkdocs.yml", "  - docs/none.md", "the menu leads to nothing: docs/none.md"),
    ("src/molsurf/core/options.h", "// docs/math.md, section 4", "math.md has no section 4"),
    ("src/molsurf/core/options.h", "/// docs/adr/0002.md tells why.", "there is no docs/adr/0002.md"),
]


class Docs(unittest.TestCase):
    def faults(self, added=None, text=""):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for name, content in TREE.items():
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(content + (f"\n{text}\n" if name == added else ""))
            return check_docs.check(root, PROGRAM)

    def test_the_tree(self):
        done = subprocess.run([sys.executable, "-B", ROOT / "scripts" / "check_docs.py", "--program", TOOL],
                              capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_verbs_are_found(self):
        program = check_docs.Program.ask(TOOL)
        self.assertLess({"batch", "compare", "info"}, set(program.verbs))
        self.assertLess({"--voxel", "--range", "--bricks", "--folder"}, program.options)
        self.assertEqual(program.defaults["--voxel"], {"0.5"})

    def test_nothing_is_found_where_nothing_is_wrong(self):
        self.assertEqual(self.faults(), [])

    def test_planted_faults(self):
        for name, text, fault in FAULTS:
            with self.subTest(text):
                line = TREE[name].count("\n") + 2
                found = self.faults(name, text)
                self.assertEqual(len(found), 1, found)
                self.assertRegex(found[0], rf"^{name}:({line}|{line + 2}|1): ")
                self.assertTrue(found[0].endswith(": " + fault), found)

    def test_a_page_that_the_menu_lacks(self):
        TREE["docs/new.md"] = "New.\n"
        self.addCleanup(TREE.pop, "docs/new.md")
        self.assertEqual(self.faults(), ["docs/new.md:1: the menu of mkdocs.yml lacks this page"])

    def test_installed_pages(self):
        """They link to and name what is installed; the tree has more."""
        with tempfile.TemporaryDirectory() as folder:
            page = pathlib.Path(folder) / "README.md"
            page.write_text("CONTRIBUTING.md of the sources, `view.py`\n")
            self.assertEqual(check_docs.check_installed(page.parent), [])
            page.write_text("[a](docs/math.md),\nscripts/test.sh,\n`mutate.py`\n")
            self.assertEqual(check_docs.check_installed(page.parent),
                             ["README.md:1: the link leads to nothing: docs/math.md",
                              "README.md:2: there is no scripts/test.sh", "README.md:3: mutate.py is not there"])

    def test_moved_folder(self):
        """What is written with its folder is reported when the folder moves."""
        moved = dict(TREE)
        TREE["src/molsurf/base/options.h"] = TREE.pop("src/molsurf/core/options.h")
        self.addCleanup(lambda: (TREE.clear(), TREE.update(moved)))
        self.assertEqual({line.split(": ")[1] for line in self.faults()},
                         {"there is no core/options", "there is no core/options.h"})


if __name__ == "__main__":
    unittest.main()
