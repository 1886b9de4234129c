# SPDX-License-Identifier: MPL-2.0
"""The commands of README.md and of all pages of docs/, and the C++, work as they stand.

What the pages say otherwise, of options, paths and names, is held against the code by test_docs.py."""

import json
import math
import os
import pathlib
import re
import shlex
import subprocess
import unittest

from needs import typable
from tool import ROOT, TOOL, ToolTest

README = ROOT / "README.md"
DOCS = ROOT / "docs"
INDEX = DOCS / "index.md"
PAGES = [README, *sorted(DOCS.rglob("*.md"))]
# The folder that the commands of each page write into; git ignores it. Every page with a block of shell is run.
FOLDERS = {"README": "start", "accuracy": "accuracy", "artists": "art", "colors": "colors", "compare": "compare",
           "complexes": "complexes", "formats": "formats", "gallery": "gallery", "other_programs": "viewers",
           "pipelines": "many", "pockets": "pockets", "pores": "pores", "selections": "selections", "settings": "settings", "stand_ins": "standins",
           "structural_biology": "bio", "structures": "atoms", "trajectories": "frames"}
# Those that one clone runs in every build; all of them do with MOLSURF_ALL_GUIDES (scripts/nightly.sh).
FEW = ("README", "settings", "other_programs", "compare")


def blocks(language, page):
    """The fenced blocks of a language."""
    return re.findall(rf"^```{language}\n(.*?)^```$", page.read_text(), re.MULTILINE | re.DOTALL)


def prose(page):
    """The page without its comments, which say where its numbers come from (scripts/figures.py)."""
    return re.sub(r"<!--.*?-->", "", page.read_text(), flags=re.DOTALL)


def promised(block):
    """The files that a block writes; of frames and of meshes of pockets the first."""
    words = shlex.split(block.replace("\\\n", " ").replace(";", " ;"), comments=True)
    files = [after for word, after in zip(words, words[1:]) if word in ("-o", ">", "2>")]
    files = [re.sub(r"\.pockets\.(ply|obj|stl|off|vtk|glb)$", r".pocket1.\1", name) for name in files]
    if "--frames" in words:
        first = int(words[words.index("--first-frame") + 1]) if "--first-frame" in words else 1
        files = [re.sub(r"(?<!\.pockets)\.(?!(?:csv|gif|mp4|webm)$)(\w+)$", rf".{first:04}.\1", name) for name in files]
    return [name for name in files if name != "-"]


class Readme(ToolTest):
    def setUp(self):
        super().setUp()
        (self.folder / "tests").symlink_to(ROOT / "tests")
        (self.folder / "bin").mkdir()
        for name in ("vdb_molsurf", "vdb_molsurf_msms", "vdb_molsurf_nanoshaper"):
            (self.folder / "bin" / name).symlink_to(pathlib.Path(TOOL).resolve().parent / name)

    def test_numbers_of_the_biologists_guide(self):
        """Its table of areas and volumes, and what it says of cavities and of the interface."""
        text = prose(DOCS / "structural_biology.md")
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
        self.assertIn(f"in 4AT1 {len(holes)}, the largest {holes[0]['volume']:.0f} Å³", " ".join(text.split()))

    def test_numbers_of_the_accuracy_page(self):
        """Its rows for one atom and for 1A8O, at 1 and 0.5 Å."""
        text = prose(DOCS / "accuracy.md")
        for voxel, error in re.findall(r"^\| (1|0\.5) \| (-0\.\d+) \|", text, re.MULTILINE):
            (self.folder / "one.xyzr").write_text("0.13 0.29 0.41 1.7\n")
            report = self.surface(self.folder / "one.xyzr", "--voxel", voxel)
            radius = math.sqrt(report["area"] / (4 * math.pi))
            self.assertAlmostEqual(radius, 1.7208 + float(error), delta=2e-4, msg=voxel)
        rows = re.findall(r"^\| (1|0\.5) \| ([\d.]+) \| ([\d.]+) \| (\d+) \|", text, re.MULTILINE)
        self.assertEqual([row[0] for row in rows], ["1", "0.5"])
        for voxel, area, volume, euler in rows:
            report = self.surface(ROOT / "tests/data/1a8o.cif.gz", "--assembly", "1", "--voxel", voxel)
            self.assertAlmostEqual(report["area"] / float(area), 1, delta=3e-4)
            self.assertAlmostEqual(report["volume"] / float(volume), 1, delta=3e-4)
            self.assertEqual(report["euler_characteristic"], int(euler))

    def surface(self, *words):
        """What the report says of the surface."""
        self.check(0, *words, "--force", "-o", "report.json")
        return json.loads((self.folder / "report.json").read_text())["surface"]

    def test_every_page_is_here(self):
        """The readme leads to docs/index.md, that to every page of docs/, and the table of decisions to every decision."""
        self.assertIn("](docs/index.md)", README.read_text())
        for page in PAGES[1:]:
            start = INDEX if page.parent == DOCS else page.parent / "README.md"
            if page != start:
                name = page.relative_to(start.parent).as_posix()
                self.assertIn(f"]({name})", start.read_text())
        self.assertEqual({page.stem for page in PAGES if blocks("sh", page)}, set(FOLDERS))

    def test_pages_do_not_collide(self):
        """No file is written twice, and every page writes into its own folder, which git ignores."""
        ignored = (ROOT / ".gitignore").read_text().splitlines()
        written = set()
        for page in PAGES:
            for block in blocks("sh", page):
                for name in promised(block):
                    self.assertNotIn(name, written, page.name)
                    self.assertEqual(name.split("/")[0], FOLDERS[page.stem], name)
                    written.add(name)
        self.assertEqual([name for name in FOLDERS.values() if f"/{name}/" not in ignored], [])

    def test_readme_is_short(self):
        self.assertLess(len(prose(README).split()), 1300)

    def run_commands(self, page):
        """In the order of the page and in one folder, since later ones use files of earlier ones."""
        path = f"{self.folder / 'bin'}:{os.environ['PATH']}"
        for whole in blocks("sh", page):
            with self.subTest(whole):
                self.assertRegex(whole, r"\bvdb_molsurf(_msms|_nanoshaper)? ")
                block = typable(whole)
                if "vdb_molsurf" not in block:
                    continue
                done = subprocess.run(["bash", "-e", "-o", "pipefail", "-c", block],
                                      cwd=self.folder, env={**os.environ, "PATH": path},
                                      capture_output=True, text=True, timeout=300)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertTrue(promised(block) or done.stdout, "neither a file nor an answer")
                for name in promised(block):
                    self.assertGreater((self.folder / name).stat().st_size, 0, name)

    def test_pages_in_one_clone(self):
        """The commands of several pages, README first and then in the order of docs/index.md, leave only what git ignores."""
        order = [README, *(DOCS / name for name in re.findall(r"\]\((\w+\.md)\)", INDEX.read_text()))]
        before = set(self.names())
        for page in order:
            if page.stem in (FOLDERS if os.environ.get("MOLSURF_ALL_GUIDES") else FEW):
                self.run_commands(page)
        self.assertLessEqual(set(self.names()) - before, set(FOLDERS.values()))

    def test_cpp_is_compiled_elsewhere(self):
        """The lines of each example are lines of a program that the package test compiles."""
        examples = blocks("cpp", DOCS / "library.md")
        programs = ("consumer", "coloured")
        self.assertEqual(len(examples), len(programs))
        for example, program in zip(examples, programs):
            text = (ROOT / "tests" / "package" / f"{program}.cpp").read_text()
            for line in example.splitlines():
                self.assertIn(line.strip(), {compiled.strip() for compiled in text.splitlines()})


def add_tests():
    """A test for each page with commands."""
    for page in PAGES:
        if blocks("sh", page):
            name = f"test_commands_of_{page.stem.lower()}"
            setattr(Readme, name, lambda self, page=page: self.run_commands(page))


add_tests()

if __name__ == "__main__":
    unittest.main()
