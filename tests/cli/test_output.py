# SPDX-License-Identifier: MPL-2.0
"""Files appear whole or not at all, and nothing is replaced unasked."""

import os
import resource
import shlex
import shutil
import signal
import subprocess
import unittest

from needs import needs, other_user, small_address_space
from tool import CRAMBIN, DATA, FAST, TOOL, ToolTest, read_ply

ALL = ["-o", "a.vdb", "-o", "a.ply", "-o", "a.obj", "-o", "a.stl", "-o", "a.json", "-o", "a.png"]


class Files(ToolTest):
    def test_all_kinds_at_once(self):
        self.check(0, CRAMBIN, *ALL, *FAST)
        self.assertEqual(self.names(), ["a.json", "a.obj", "a.ply", "a.png", "a.stl", "a.vdb"])
        self.assertEqual((self.folder / "a.png").read_bytes()[:8], b"\x89PNG\r\n\x1a\n")

    def test_large_letters(self):
        self.check(0, CRAMBIN, "-o", "A.PLY", *FAST)
        self.assertEqual(self.names(), ["A.PLY"])

    def test_no_such_folder(self):
        self.check(1, CRAMBIN, "-o", "none/a.vdb", says=["none", "No such file"])
        self.assertEqual(self.names(), [])

    def test_a_folder_of_the_system_is_there(self):
        done = self.check(1, CRAMBIN, "-o", "/proc/a.json", says="/proc/a.json: ")
        self.assertNotIn(b"make the folder", done.stderr)

    def test_outputs_are_checked_before_the_input_is_read(self):
        self.check(1, "none.pdb", "-o", "none/a.vdb", says="none/a.vdb")

    def test_folder_of_that_name(self):
        (self.folder / "a.vdb").mkdir()
        self.check(1, CRAMBIN, "-o", "a.vdb", "--force", says="folder")

    def test_existing_file_stays(self):
        (self.folder / "a.ply").write_text("old")
        self.check(1, CRAMBIN, "-o", "a.vdb", "-o", "a.ply", says=["a.ply", "--force"])
        self.assertEqual((self.folder / "a.ply").read_text(), "old")
        self.assertEqual(self.names(), ["a.ply"])

    def test_force_replaces(self):
        (self.folder / "a.ply").write_text("old")
        self.check(0, CRAMBIN, "-o", "a.ply", "--force", *FAST)
        self.assertEqual((self.folder / "a.ply").read_bytes()[:4], b"ply\n")

    def test_failing_run_leaves_the_old_file_even_with_force(self):
        (self.folder / "a.ply").write_text("old")
        self.check(1, "none.pdb", "-o", "a.ply", "--force")
        self.assertEqual((self.folder / "a.ply").read_text(), "old")
        self.assertEqual(self.names(), ["a.ply"])

    def test_files_that_are_read_are_never_replaced(self):
        """Under no name: another path, a symbolic link, a hard link, standard input."""
        source = self.folder / "a.ply"
        shutil.copy(CRAMBIN, source)
        (self.folder / "hard.ply").hardlink_to(source)
        (self.folder / "g.ply").write_text("all /1/A\n")
        (self.folder / "c.ply").write_text("voxel = 1\n")
        (self.folder / "r.ply").write_text("C 1.7\n")
        (self.folder / "v.residues.csv").write_text("A 1 0.5\n")
        (self.folder / "hard.residues.csv").hardlink_to(self.folder / "v.residues.csv")
        (self.folder / "d.ply").write_text("no map, and nobody gets as far as that\n")
        shutil.copy(DATA / "1d3z.xtc", self.folder / "x.csv")
        before = {name: (self.folder / name).read_bytes() for name in self.names()}
        words = [*FAST, "--force"]
        read = "which is read"
        with open(source, "rb") as stream:
            self.check(1, "-", *words, "-o", "a.ply", stdin=stream, says=["standard input", read])
        for option, name in (("--groups", "g.ply"), ("--config", "c.ply"), ("--radii", "r.ply")):
            with self.subTest(name):
                self.check(1, CRAMBIN, *(words if option != "--config" else ["--force"]), option, name, "-o", name,
                           says=[name, read])
        (self.folder / "link.residues.csv").symlink_to("v.residues.csv")
        for name in ("v.residues.csv", "hard.residues.csv", "link.residues.csv"):
            self.check(1, CRAMBIN, *words, "--color", "TABLE=v.residues.csv", "-o", name, says=[name, read])
        (self.folder / "link.residues.csv").unlink()
        for value in ("potential=d.ply", "table=./d.ply"):
            self.check(1, CRAMBIN, *words, "--color", value, "-o", "d.ply", says=["d.ply", read])
        self.check(1, DATA / "1d3z.pdb.gz", *words, "--trajectory", "x.csv", "-o", "x.csv", says=["x.csv", read])
        # Names of meshes are refused as inputs; the content of a .vdb decides.
        source.rename(self.folder / "a.vdb")
        (self.folder / "link.vdb").symlink_to("a.vdb")
        (self.folder / "hard.ply").rename(self.folder / "hard.vdb")
        for name in ("a.vdb", "./a.vdb", self.folder / "a.vdb", "link.vdb", "hard.vdb"):
            with self.subTest(name):
                self.check(1, "a.vdb", *words, "-o", "x.json", "-o", name, says=[name, read])
        (self.folder / "link.vdb").unlink()
        self.assertEqual({name.replace(".vdb", ".ply"): (self.folder / name).read_bytes()
                          for name in self.names()}, before)

    def test_names_that_are_too_long(self):
        """They are refused before the input is read, which is not there."""
        for length in (245, 255, 256):
            self.check(1, "none.pdb", "-o", "a" * (length - 4) + ".ply", says="File name too long")
        self.check(0, CRAMBIN, *FAST, "-o", "a" * 220 + ".ply")
        self.check(1, CRAMBIN, *FAST, "--frames", "1", "-o", "a" * 240 + ".ply", says="File name too long")

    @needs("user")
    def test_folder_that_cannot_be_written(self):
        self.folder.chmod(0o555)
        try:
            self.check(1, CRAMBIN, "-o", "a.vdb", says="Permission denied", **other_user())
        finally:
            self.folder.chmod(0o755)
        self.assertEqual(self.names(), [])


class FullDisk(ToolTest):
    # The larger of the files is the one that does not fit; the others must not appear either.
    def fill(self, status, names, words, **options):
        outputs = [word for name in names for word in ("-o", name)]
        self.check(status, CRAMBIN, *outputs, *FAST, says=words, **options)
        self.assertEqual(self.names(), [])

    def test_file_that_may_not_grow(self):
        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (20000, 20000))

        for name in ("a.vdb", "a.ply", "a.obj", "a.stl", "a.png"):
            with self.subTest(name):
                self.fill(1, ["a.json", name], [name, "File too large"], preexec_fn=limit)

    @needs("mount")
    def test_small_file_system(self):
        mount = ["mount", "-t", "tmpfs", "-o", "size=40k", "tmpfs", str(self.folder)]
        subprocess.run(mount, check=True)
        try:
            for name in ("a.vdb", "a.ply"):
                self.fill(75, ["a.json", name], [name, "No space left"], cwd=self.folder)
        finally:
            subprocess.run(["umount", str(self.folder)], check=True)


class Memory(ToolTest):
    @needs("memory")
    def test_too_little(self):
        # Who names more memory than there is gets as far as it goes.
        self.check(75, CRAMBIN, "-o", "a.vdb", "-o", "a.ply", "--voxel", "0.05", "--memory", "10G",
                   says=["not enough memory", "--voxel"], preexec_fn=small_address_space)
        self.assertEqual(self.names(), [])


class StandardOutput(ToolTest):
    def test_every_format(self):
        starts = {"ply": b"ply\n", "obj": b"v ", "stl": b"binary STL", "json": b"{\n",
                  "png": b"\x89PNG", "vdb": b" BDV", "3mf": b"PK\3\4"}
        for form, start in starts.items():
            done = self.check(0, CRAMBIN, "-o", "-", "--format", form, *FAST)
            self.assertEqual(done.stdout[: len(start)], start, form)
        self.assertEqual(self.names(), [])

    def test_ply_is_that_of_the_file(self):
        done = self.check(0, CRAMBIN, "-o", "-", "--format", "ply", "-o", "a.ply", *FAST)
        self.assertEqual(done.stdout, (self.folder / "a.ply").read_bytes())
        self.assertGreater(len(read_ply(done.stdout)[2]), 1000)

    @needs("full")
    def test_full(self):
        for form in ("ply", "obj", "stl", "json", "png", "vdb"):
            with open("/dev/full", "wb") as full:
                self.check(75, CRAMBIN, "-o", "-", "--format", form, "-o", "a.ply", "-q", *FAST,
                           says=["standard output", "No space left"],
                           capture_output=False, stdout=full, stderr=subprocess.PIPE)
            self.assertEqual(self.names(), [], form)

    def test_closed_pipe(self):
        reader, writer = os.pipe()
        os.close(reader)
        words = [CRAMBIN, "-o", "-", "--format", "ply", "-o", "a.ply", "-q", *FAST]
        streams = {"capture_output": False, "stdout": writer, "stderr": subprocess.PIPE}
        done = self.check(-signal.SIGPIPE, *words, **streams)
        self.assertEqual(done.stderr, b"")
        # Who ignores the signal, as `trap "" PIPE` does, wants words.
        self.check(1, *words, says="Broken pipe", restore_signals=False, **streams,
                   preexec_fn=lambda: signal.signal(signal.SIGPIPE, signal.SIG_IGN))
        os.close(writer)
        self.assertEqual(self.names(), [])

    def test_a_reader_that_has_enough(self):
        """As `head` does, in the middle of a file; of a pipe with a name, too."""
        words = f"{shlex.quote(str(TOOL))} {shlex.quote(str(CRAMBIN))} -q -o a.json --voxel 0.3"
        for call in (f"{words} -o - --format ply | head -c 10", f"{words} -o - --format vdb | head -c 10",
                     f"mkfifo p.ply; head -c 10 p.ply & {words} -o p.ply"):
            with self.subTest(call):
                done = subprocess.run(["bash", "-c", call + "; echo ${PIPESTATUS[0]} >&2"], cwd=self.folder,
                                      capture_output=True, check=True, timeout=60)
                self.assertEqual(done.stderr, b"141\n")
                self.assertNotIn("a.json", self.names())


if __name__ == "__main__":
    unittest.main()
