# SPDX-License-Identifier: MPL-2.0
"""Exit statuses, by which engines know what to start again, and runs that find their files made."""

import os
import re
import resource
import shutil
import subprocess
import threading
import unittest

from needs import faulty, needs
from tool import CRAMBIN, DATA, FAST, LIBRARY, ROOT, TOOL, ToolTest

LATER = 75  # EX_TEMPFAIL of sysexits.h


def address_space(megabytes):
    return lambda: resource.setrlimit(resource.RLIMIT_AS, (megabytes << 20, megabytes << 20))


class Status(ToolTest):
    def test_what_never_passes(self):
        (self.folder / "bad.pdb").write_text("nothing\n")
        (self.folder / "there.ply").write_text("old")
        self.check(1, "none.pdb", "-o", "a.ply", says="No such file")
        self.check(1, "bad.pdb", "-o", "a.ply", says="no atoms")
        self.check(1, CRAMBIN, *FAST, "-o", "there.ply", says="exists already")
        self.check(1, CRAMBIN, *FAST, "-o", "none/a.ply", says="make the folder first")
        self.check(1, CRAMBIN, "--voxel", "0.05", "--max-hours", "1e-5", "-o", "a.ply", says="hours")
        self.check(2, CRAMBIN, "--voxel", "0", "-o", "a.ply", says="--voxel")
        self.check(3, CRAMBIN, *FAST, "--flow", "newton", "--max-steps", "1", "-o", "a.ply", says="not converged")

    def test_memory(self):
        """Both what is refused before the work and what fails in it."""
        self.check(LATER, DATA / "4at1.ent.gz", "--voxel", "0.1", "-o", "a.ply", says=["takes about", "of memory"],
                   preexec_fn=address_space(700))
        self.check(LATER, CRAMBIN, "--voxel", "0.35", "-j", 1, "-o", "a.ply", says="not enough memory",
                   preexec_fn=address_space(113 + 2 * LIBRARY))
        self.assertEqual(self.names(), [])

    @needs("full")
    def test_a_full_disk(self):
        with open("/dev/full", "wb") as full:
            self.check(LATER, CRAMBIN, *FAST, "-q", "-o", "-", "--format", "ply", says="No space left", capture_output=False,
                       stdout=full, stderr=subprocess.PIPE)

    @needs("preload")
    def test_a_disk_that_fails(self):
        self.check(LATER, CRAMBIN, *FAST, "-q", "-o", "a.ply", says="Input/output error", env=faulty(without="fsync"))

    def test_batch(self):
        """75 if there is something that may pass, so that another try helps; else 1."""
        (self.folder / "bad.pdb").write_text("nothing\n")
        (self.folder / "list").write_text(f"{CRAMBIN}\nbad.pdb\n")
        words = ["batch", "list", "-O", "out", "--formats", "json", *FAST]
        self.assertEqual(self.run_tool(*words, "--surface", "sas").returncode, 1)
        done = self.run_tool("batch", "list", "-O", "small", "--formats", "json", "--voxel", "0.05",
                             preexec_fn=address_space(700))
        self.assertEqual(done.returncode, LATER, done.stderr)
        self.assertIn(b"2 failed", done.stderr)

    def test_the_guide_has_all(self):
        said = self.check(0, "--help").stdout.decode().split("Exit status: ")[1]
        page = (ROOT / "docs" / "settings.md").read_text().split("## Exit status")[1].split("\n## ")[0]
        self.assertEqual(re.findall(r"(?:^|, )(\d+) ", said.replace("\n", " ")), re.findall(r"^\| (\d+) \|", page, re.MULTILINE))


class SkipExisting(ToolTest):
    WORDS = ["--surface", "sas", *FAST, "-o", "a.ply", "-o", "a.json", "--skip-existing"]

    def make(self, *words):
        """Whether the files were made."""
        said = self.check(0, *words).stderr.decode()
        return "done before" not in said

    def test_only_what_is_the_same_is_done(self):
        source = self.folder / "x.pdb"
        shutil.copy(CRAMBIN, source)
        self.assertTrue(self.make(source, *self.WORDS))
        self.assertFalse(self.make(source, *self.WORDS, "-j", 1, "-v", "--memory", "4G", "--max-hours", "9"))
        self.assertTrue(self.make(source, *self.WORDS, "--probe", "1.5"), "other options")
        self.assertTrue(self.make(source, *self.WORDS), "as before")
        shutil.copy(DATA / "1ubq.pdb", source)
        self.assertTrue(self.make(source, *self.WORDS), "another input")
        (self.folder / "a.ply").unlink()
        self.assertTrue(self.make(source, *self.WORDS), "a file is missing")
        self.make(source, "--surface", "vdw", *FAST, "--force", "-o", "a.ply")
        self.assertTrue(self.make(source, *self.WORDS), "a file is of another run")
        self.assertFalse(self.make(source, *self.WORDS))

    def test_files_that_options_name_count_by_their_content(self):
        words = [CRAMBIN, *FAST, "--groups", "groups.txt", "--color", "group", "-o", "a.ply", "-o", "a.json", "--skip-existing"]
        for atoms, makes in (("A/1-20", True), ("A/1-20", False), ("A/1-30", True)):
            (self.folder / "groups.txt").write_text(f"one {atoms}\n")
            self.assertEqual(self.make(*words), makes, atoms)
        words = [CRAMBIN, "--voxel", "1", "--patches", "table=values.csv>4", "--areas", "patches", "-o", "b.json", "--skip-existing"]
        for value, makes in ((5, True), (5, False), (6, True)):
            (self.folder / "values.csv").write_text("".join(f"A,{n},{value if n < 20 else 1}\n" for n in range(1, 47)))
            self.assertEqual(self.make(*words), makes, value)

    def test_a_run_that_did_not_converge_ends_as_before(self):
        words = [CRAMBIN, *FAST, "--flow", "newton", "--max-steps", "1", "-o", "a.ply", "-o", "a.json", "--skip-existing"]
        self.check(3, *words, says="not converged")
        self.check(3, *words, says="done before")

    def test_files_of_others_stay(self):
        (self.folder / "a.ply").write_text("mine")
        self.check(1, CRAMBIN, *self.WORDS, says="exists already")
        (self.folder / "a.json").write_text("{}")
        self.check(1, CRAMBIN, *self.WORDS, says="exists already")
        self.assertEqual((self.folder / "a.ply").read_text(), "mine")

    def test_it_needs_a_report(self):
        self.check(2, CRAMBIN, "-o", "a.ply", "--skip-existing", says="expected -o FILE.json too")
        self.check(2, CRAMBIN, *self.WORDS, "--force", says="together")


class Streams(ToolTest):
    def read_from(self, name, *words):
        """What a reader of a pipe with a name gets."""
        os.mkfifo(self.folder / name)
        got = []
        reader = threading.Thread(target=lambda: got.append((self.folder / name).read_bytes()))
        reader.start()
        self.check(0, CRAMBIN, *FAST, "-q", "-o", name, *words)
        reader.join(60)
        return got[0]

    def test_pipes_get_what_files_get(self):
        self.check(0, CRAMBIN, *FAST, "-q", "-o", "a.ply", "-o", "a.stl")
        self.assertEqual(self.read_from("b.ply"), (self.folder / "a.ply").read_bytes())
        self.assertEqual(self.read_from("p", "--format", "ply"), (self.folder / "a.ply").read_bytes())
        self.assertEqual(self.names(), ["a.ply", "a.stl", "b.ply", "p"])
        self.check(2, CRAMBIN, *FAST, "-o", "p", says="expected --format too")

    def test_names_of_standard_output(self):
        whole = self.check(0, CRAMBIN, *FAST, "-o", "-", "--format", "ply").stdout
        for name in ("/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"):
            self.assertEqual(self.check(0, CRAMBIN, *FAST, "-o", name, "--format", "ply").stdout, whole)
            with open(self.folder / "to.ply", "wb") as to:  # vdb_molsurf ... > to.ply
                self.check(0, CRAMBIN, *FAST, "-o", name, "--format", "ply", capture_output=False, stdout=to,
                           stderr=subprocess.PIPE)
            self.assertEqual((self.folder / "to.ply").read_bytes(), whole)
        self.check(2, CRAMBIN, *FAST, "-o", "/dev/stdout", says="--format")
        self.check(2, CRAMBIN, *FAST, "-o", "/dev/stdout", "-o", "-", "--format", "ply", says="twice")


if __name__ == "__main__":
    unittest.main()
