# SPDX-License-Identifier: MPL-2.0
"""What a hostile surrounding does: full devices, little memory, signals that a shell ignores, odd names."""

import itertools
import resource
import shutil
import signal
import struct
import subprocess
import time
import unittest

from kill import NAMING, killed_at, state
from needs import needs
from tool import CRAMBIN, DATA, FAST, TOOL, ToolTest

MEGABYTE = 1 << 20


class Faults(ToolTest):
    def test_a_signal_that_was_ignored_stays_ignored(self):
        # As with nohup, and as a shell does with SIGINT of jobs in the background.
        for number in (signal.SIGHUP, signal.SIGINT):
            with self.subTest(signal=number):
                process = subprocess.Popen([TOOL, CRAMBIN, "--voxel", "0.15", "-q", "--force", "-o", "a.json"],
                                           cwd=self.folder, preexec_fn=lambda: signal.signal(number, signal.SIG_IGN))
                time.sleep(0.3)
                self.assertIsNone(process.poll(), "the run ended before the signal came")
                process.send_signal(number)
                self.assertEqual(process.wait(60), 0)

    def test_little_memory_is_said(self):
        # From where libraries start their threads to where the run is through.
        statuses = []
        for megabytes in range(120, 400, 20):
            def limit():
                resource.setrlimit(resource.RLIMIT_AS, (megabytes * MEGABYTE, megabytes * MEGABYTE))

            done = self.run_tool(CRAMBIN, "--voxel", "0.5", "-j", "1", "-q", "--force", "-o", "a.json", preexec_fn=limit)
            error = done.stderr.decode()
            if "loading shared libraries" in error:
                continue  # the system's words
            statuses.append(done.returncode)
            if done.returncode != 0:
                self.assertEqual(done.returncode, 1, f"{megabytes} MB: {error}")
                self.assertIn("not enough memory", error)
                self.assertEqual(error.count("\n"), 1, error)
        self.assertEqual(statuses[-1], 0)
        self.assertIn(1, statuses)

    @needs("full")
    def test_texts_on_a_full_device(self):
        for words in (["--help"], ["--version"]):
            with self.subTest(words=words), open("/dev/full", "wb") as full:
                done = subprocess.run([TOOL, *words], stdout=full, stderr=subprocess.PIPE)
                self.assertEqual(done.returncode, 1)
                self.assertIn(b"No space left on device", done.stderr)

    def test_a_config_that_cannot_be_read(self):
        self.check(1, CRAMBIN, "--config", "/proc/self/mem", *FAST, "-o", "a.json", says="cannot be read")
        self.assertEqual(self.names(), [])

    def test_a_trajectory_that_promises_much_takes_little_memory(self):
        def record(content):
            return struct.pack("<i", len(content)) + content + struct.pack("<i", len(content))

        head = record(b"CORD" + struct.pack("<20i", 1, *[0] * 18, 24))
        (self.folder / "t.dcd").write_bytes(head + struct.pack("<i", 1 << 30) + b"x")
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss
        self.check(1, CRAMBIN, "--trajectory", "t.dcd", "-o", "a.json", says="cut short")
        after = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss
        self.assertLess(after, max(before, 300 * 1024))  # [KiB]

    def test_a_folder_is_no_plan(self):
        (self.folder / "plan").mkdir()
        self.check(1, "bricks", "run", "plan", "1", says="expected a plan")
        self.check(1, "bricks", "merge", "plan", "-o", "a.json", says="expected a plan")

    def test_control_characters_in_names_are_not_obeyed(self):
        for name in ("a\x1b[31mb.pdb", "a\x07b.pdb", "a\u009b31mb.pdb"):
            shutil.copy(CRAMBIN, self.folder / name)
            error = self.check(0, name, *FAST, "--force", "-o", "a.json", says="a\\x").stderr.decode()
            self.assertTrue(all(c == "\n" or c >= " " and not "\x7f" <= c < "\xa0" for c in error), error)
            self.check(1, name + "x", *FAST, "-o", "b.json", says="a\\x")


@needs("strace")
class Restart(ToolTest):
    """A run that is killed at any change of a name, and is started again, ends as an undisturbed one."""

    def compare(self, *words, outputs="out"):
        """The same words are run in two folders."""
        whole, killed = self.folder / "whole", self.folder / "killed"
        shutil.copytree(self.folder / "start", whole)
        self.check(0, *words, cwd=whole)
        expected = state(whole / outputs)
        kills = 0
        for call in NAMING:
            for number in itertools.count(1):
                shutil.copytree(self.folder / "start", killed)
                dead = killed_at(call, number, words, killed)
                if dead:
                    self.check(0, *words, cwd=killed)
                self.assertEqual(state(killed / outputs), expected, f"killed at {call} {number}")
                shutil.rmtree(killed)
                if not dead:
                    break
                kills += 1
        self.assertGreater(kills, 8)

    def test_batch(self):
        start = self.folder / "start"
        start.mkdir()
        for name in "ab":
            shutil.copy(CRAMBIN, start / f"{name}.pdb")
        (start / "list").write_text("a.pdb\nb.pdb\n")
        self.compare("batch", "list", "-O", "out", *FAST)

    def test_frames(self):
        (self.folder / "start").mkdir()
        self.compare(DATA / "1d3z.pdb.gz", *FAST, "--frames", "1-2", "-o", "a.vdb", "-o", "a.ply", "-o", "a.csv",
                     outputs=".")


if __name__ == "__main__":
    unittest.main()
