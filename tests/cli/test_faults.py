# SPDX-License-Identifier: MPL-2.0
"""What a hostile surrounding does: kills and signals at any moment, full devices, little memory, odd names."""

import itertools
import os
import resource
import shutil
import signal
import struct
import subprocess
import time
import unittest

from kill import NAMING, killed_at, signalled_at, state
from needs import faulty, needs
from tool import CRAMBIN, DATA, FAST, TOOL, ToolTest

MEGABYTE = 1 << 20
FILES = ["a.json", "a.obj", "a.ply", "a.vdb"]
SEVERAL = [word for name in FILES for word in ("-o", name)]


def limited(what, size):
    """How a program is started that may take only so much."""
    return lambda: resource.setrlimit(what, (size, size))


class Faults(ToolTest):
    def test_a_signal_that_was_ignored_stays_ignored(self):
        # As with nohup, and as a shell does with SIGINT of jobs in the background.
        for number in (signal.SIGHUP, signal.SIGINT):
            with self.subTest(signal=number):
                process = subprocess.Popen([TOOL, CRAMBIN, "--voxel", "0.1", "-q", "--force", "-o", "a.json"],
                                           cwd=self.folder, preexec_fn=lambda: signal.signal(number, signal.SIG_IGN))
                time.sleep(0.2)
                self.assertIsNone(process.poll(), "the run ended before the signal came")
                process.send_signal(number)
                self.assertEqual(process.wait(60), 0)

    def test_little_memory_is_said(self):
        # From where libraries start their threads to where the run is through.
        statuses = []
        for megabytes in range(30, 500, 10):
            done = self.run_tool(CRAMBIN, "--voxel", "0.5", "-j", "1", "-q", "--force", *SEVERAL,
                                 preexec_fn=limited(resource.RLIMIT_AS, megabytes * MEGABYTE))
            error = done.stderr.decode()
            if "loading shared libraries" in error:
                continue  # the system's words
            statuses.append(done.returncode)
            if done.returncode != 0:
                self.assertEqual(done.returncode, 75, f"{megabytes} MB: {error}")
                self.assertRegex(error, "not enough memory|of memory, and there are")  # in the work, or before it
                self.assertEqual(error.count("\n"), 1, error)
                self.assertEqual(self.names(), [])
        self.assertEqual(statuses[-1], 0)
        self.assertIn(75, statuses)

    @needs("full")
    def test_texts_on_a_full_device(self):
        for words in (["--help"], ["--version"]):
            with self.subTest(words=words), open("/dev/full", "wb") as full:
                done = subprocess.run([TOOL, *words], stdout=full, stderr=subprocess.PIPE)
                self.assertEqual(done.returncode, 75)
                self.assertIn(b"No space left on device", done.stderr)

    def test_a_config_that_cannot_be_read(self):
        self.check(75, CRAMBIN, "--config", "/proc/self/mem", *FAST, "-o", "a.json", says="cannot be read")
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

    def expect_plain(self, text):
        self.assertTrue(all(c == "\n" or c >= " " and not "\x7f" <= c < "\xa0" for c in text), repr(text))

    def test_control_characters_in_files_are_not_obeyed(self):
        """Of chains, assemblies and metadata; the title and file of info, and what refuses them."""
        lines = [line[:21] + "\x1b" + line[22:] if line.startswith("ATOM") else line
                 for line in CRAMBIN.read_text().splitlines()]
        (self.folder / "a\x1b.pdb").write_text("\n".join(lines) + "\n")
        said = self.check(0, "info", "a\x1b.pdb").stdout.decode()
        self.assertIn("1 (\\x1b)", said)
        self.expect_plain(said)
        (self.folder / "t").write_text("B 1 0.5\n")
        error = self.check(1, "a\x1b.pdb", "--color", "table=t", *FAST, "-o", "a.ply", says="none of its atoms").stderr.decode()
        self.expect_plain(error)
        self.check(0, CRAMBIN, *FAST, "-o", "a.vdb", "-o", "b\x1b[1m.json")
        said = self.check(0, "info", "a.vdb").stdout.decode()
        self.assertIn("\\x1b[1m", said)
        self.expect_plain(said)

    def test_control_characters_in_names_are_not_obeyed(self):
        for name in ("a\x1b[31mb.pdb", "a\x07b.pdb", "a\u009b31mb.pdb"):
            shutil.copy(CRAMBIN, self.folder / name)
            error = self.check(0, name, *FAST, "--force", "-o", "a.json", says="a\\x").stderr.decode()
            self.expect_plain(error)
            self.check(1, name + "x", *FAST, "-o", "b.json", says="a\\x")

    def test_letters_that_turn_others_and_bytes_that_are_no_letters_are_escaped(self):
        for name, shown in (("a\u202ebdp.pdb", r"a\u202ebdp.pdb"), ("a\u2066b.pdb", r"a\u2066b.pdb"), ("a\udcffb.pdb", r"a\xffb.pdb"),
                            ("a\udce2\udc80.pdb", r"a\xe2\x80.pdb"), ("a\udced\udca0\udc80.pdb", r"a\xed\xa0\x80.pdb"),
                            ("\u00e5\u6c34\U0001f600.pdb", "\u00e5\u6c34\U0001f600.pdb")):
            error = self.check(1, name, "-o", "b.json", says=shown).stderr.decode()
            self.expect_plain(error)
            self.assertNotIn("\u202e", error)


class Commit(ToolTest):
    """The files of a run are all old or all new, whatever happens to it."""

    WORDS = [CRAMBIN, "--voxel", "0.5", "-q", "--force", *SEVERAL]

    def setUp(self):
        super().setUp()
        start = time.monotonic()
        self.check(0, *self.WORDS)
        self.duration = time.monotonic() - start
        self.new = state(self.folder)
        self.assertEqual(sorted(self.new), FILES)

    def begin(self):
        """Old files."""
        for name in FILES:
            (self.folder / name).write_text("old")

    def result(self):
        """"old" or "new", after a check that the files agree and that nothing is left."""
        self.assertEqual(self.names(), FILES)
        contents = [(self.folder / name).read_bytes() for name in FILES]
        if contents == [b"old"] * len(FILES):
            return "old"
        self.assertTrue(state(self.folder) == self.new)
        return "new"

    def start_another(self):
        """A run in the same folder that ends at once."""
        self.check(1, "none.pdb", "-o", "b.json")

    def moments(self, count):
        """Seconds after the start, a half of them about the end."""
        half = count // 2
        return [self.duration * n / half for n in range(half)] + [
            self.duration * (0.7 + 0.4 * n / half) for n in range(count - half)]

    def signal_at(self, moment, number):
        """The status and what was said."""
        self.begin()
        process = subprocess.Popen([TOOL, *map(str, self.WORDS)], cwd=self.folder, stderr=subprocess.PIPE)
        time.sleep(moment)
        process.send_signal(number)
        error = process.communicate(timeout=60)[1].decode()
        return process.returncode, error

    def test_kill(self):
        results = []
        for moment in self.moments(50):
            self.signal_at(moment, signal.SIGKILL)
            self.start_another()
            results.append(self.result())
        self.assertIn("old", results)

    @needs("strace")
    def test_kill_at_every_change_of_a_name(self):
        results = []
        for call in NAMING:
            for number in itertools.count(1):
                self.begin()
                dead = killed_at(call, number, self.WORDS, self.folder)
                if dead:
                    self.start_another()
                results.append(self.result())
                if not dead:
                    break
        self.assertGreater(len(results), len(NAMING) + len(FILES))
        self.assertIn("old", results)
        self.assertIn("new", results)

    @needs("strace")
    def test_signals_wait_while_names_change(self):
        for name in FILES:
            (self.folder / name).unlink()
        done = signalled_at("renameat2", 1, "INT", self.WORDS[:-len(SEVERAL) - 1] + SEVERAL, self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.names(), FILES)
        # What follows is not begun.
        for name in "xy":
            shutil.copy(CRAMBIN, self.folder / f"{name}.pdb")
        (self.folder / "list").write_text("x.pdb\ny.pdb\n")
        done = signalled_at("rename", 1, "INT", ["batch", "list", "-O", "out", *FAST], self.folder)
        self.assertEqual(done.returncode, 130, done.stderr)
        self.assertEqual(sorted(path.name for path in (self.folder / "out").iterdir()),
                         ["summary.csv", "summary.json", "summary.jsonl", "x.json", "x.ply", "x.vdb"])

    @needs("preload")
    def test_kill_where_the_file_system_lacks_something(self):
        for lacking in ("flock", "flock renameat2", "flock link", "link renameat2"):
            results = []
            for number in itertools.count(1):
                self.begin()
                status = self.run_tool(*self.WORDS, env=faulty(without=lacking, kill=number)).returncode
                if status:
                    self.assertEqual(status, -signal.SIGKILL)
                    self.check(1, "none.pdb", "-o", "b.json", env=faulty(without=lacking))
                results.append(self.result())
                if status == 0:
                    break
            self.assertGreater(len(results), 3 * len(FILES), lacking)
            self.assertEqual(set(results), {"old", "new"}, lacking)
            self.assertEqual(results, sorted(results, reverse=True), "after the decision all are new")

    @needs("preload")
    def test_renamings_that_fail(self):
        """One that fails is taken back at once; where all fail from then on, the next run does what is missing."""
        for lacking in ("", "renameat2", "link", "flock renameat2 link"):
            for more in ("", "-"):
                results = []
                for number in itertools.count(1):
                    self.begin()
                    done = self.run_tool(*self.WORDS, env=faulty(without=lacking, eio=f"{number}{more}"))
                    if done.returncode:
                        self.assertEqual((done.returncode, done.stderr.count(b"\n")), (75, 1), done.stderr)
                        self.assertIn(b"Input/output error", done.stderr)
                    if more:
                        self.check(1, "none.pdb", "-o", "b.json")
                    results.append(self.result())
                    if done.returncode == 0:
                        break
                self.assertGreater(len(results), len(FILES), lacking)
                if not more:
                    self.assertEqual(results[:-1], ["old"] * (len(results) - 1), lacking)

    @needs("preload")
    def test_a_new_file_in_the_place_of_none_where_renames_cannot_refuse(self):
        words = [word for word in self.WORDS if word != "--force"]
        for name in FILES:
            (self.folder / name).unlink()
        self.check(0, *words, env=faulty(without="renameat2"))
        self.assertEqual(self.names(), FILES)
        self.check(1, *words, env=faulty(without="renameat2"), says="it exists already")

    @needs("preload")
    def test_a_disk_that_does_not_take_what_was_written(self):
        self.begin()
        self.check(75, *self.WORDS, env=faulty(without="fsync"), says=["cannot write a.", ": Input/output error"])
        self.assertEqual(self.result(), "old")

    @needs("preload")
    def test_files_of_a_process_at_work_stay(self):
        """Also where there are no locks to tell that it is."""
        process = subprocess.Popen([TOOL, CRAMBIN, "--voxel", "0.15", "-q", "--force", "-o", "a.json", "-o", "a.obj"],
                                   cwd=self.folder, env=faulty(without="flock"))
        while process.poll() is None and not any(name.endswith(".part") for name in self.names()):
            time.sleep(0.005)
        process.send_signal(signal.SIGSTOP)
        before = self.names()
        self.assertTrue(any(name.endswith(".part") for name in before), "it ended before it wrote")
        self.check(1, "none.pdb", "-o", "b.json", env=faulty(without="flock"))
        self.assertEqual(self.names(), before)
        process.send_signal(signal.SIGCONT)
        self.assertEqual(process.wait(60), 0)
        self.assertEqual(self.names(), FILES)

    @needs("preload")
    def test_a_process_that_nobody_waits_for_is_gone(self):
        process = subprocess.Popen([TOOL, CRAMBIN, "--voxel", "0.15", "-q", "--force", "-o", "a.json", "-o", "a.obj"],
                                   cwd=self.folder, env=faulty(without="flock"))
        while process.poll() is None and not any(name.endswith(".part") for name in self.names()):
            time.sleep(0.005)
        process.kill()
        os.waitid(os.P_PID, process.pid, os.WEXITED | os.WNOWAIT)  # it stays a zombie
        self.assertNotEqual(self.names(), FILES, "it ended before it wrote")
        self.check(1, "none.pdb", "-o", "b.json", env=faulty(without="flock"))
        self.assertEqual(self.names(), FILES)
        self.assertEqual(process.wait(), -signal.SIGKILL)

    @needs("preload")
    def test_files_of_other_machines_stay_where_there_are_no_locks(self):
        """Their processes may be at work; a lock that is free tells that they are not."""
        other = ".a.obj.12-0123456789abcdef.part"
        (self.folder / other).write_text("half")
        before = self.names()
        self.check(1, "none.pdb", "-o", "b.json", env=faulty(without="flock"))
        self.assertEqual(self.names(), before)
        self.check(0, CRAMBIN, *FAST, "--dry-run", "-o", "b.json")  # which changes nothing
        self.assertEqual(self.names(), before)
        self.check(1, "none.pdb", "-o", "b.json")
        self.assertEqual(self.names(), FILES)

    @needs("preload")
    def test_all_is_on_the_disk_before_the_first_name(self):
        self.begin()
        self.check(0, *self.WORDS, env=faulty(log=self.folder / "log"))
        lines = [line.split() for line in (self.folder / "log").read_text().splitlines()]
        (self.folder / "log").unlink()
        first = next(i for i, (what, _) in enumerate(lines) if what == "rename")
        files = [path.rsplit("/", 1)[1] for what, path in lines[:first] if what == "sync"
                 and path.endswith(".part") and "commit" not in path]
        self.assertEqual(sorted(name.split(".")[1] + "." + name.split(".")[2] for name in files), FILES,
                         "each file once, before the first name changes")
        record = next(i for i, (what, path) in enumerate(lines) if what == "sync" and "commit" in path)
        folder = [i for i, (what, path) in enumerate(lines) if what == "sync" and path == str(self.folder.resolve())]
        self.assertTrue(any(first - 2 <= i < record for i in folder), "the folder before the record")
        self.assertTrue(folder[-1] > max(i for i, (what, _) in enumerate(lines) if what == "rename"),
                        "the folder after the names")
        self.assertEqual(len(folder), 3, "the folder: before the record, with it, and after the names, for all files")

    def test_interrupt_and_terminate(self):
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            for moment in self.moments(8):
                status, error = self.signal_at(moment, number)
                # Before the program takes signals they end it at once.
                self.assertIn(status, (0, 130, -number), error)
                self.assertEqual(self.result(), "new" if status == 0 else "old")
                if status == 130:
                    self.assertTrue(error.endswith("vdb_molsurf: interrupted\n"), error)

    def full(self, status, **options):
        """A run that succeeds, or ends with a status and says in a line why it cannot."""
        done = self.run_tool(*self.WORDS, **options)
        error = done.stderr.decode()
        self.assertEqual((done.returncode, error.count("\n")), (status, 1) if done.returncode else (0, 0), error)
        return done.returncode

    def test_files_that_may_not_grow(self):
        statuses = []
        largest = max((self.folder / name).stat().st_size for name in FILES)
        for tenth in range(12):
            self.begin()
            statuses.append(self.full(1, preexec_fn=limited(resource.RLIMIT_FSIZE, largest * tenth // 10)))
            self.assertEqual(self.result(), "old" if statuses[-1] else "new")
        self.assertEqual(statuses, [1] * 10 + [0] * 2)

    @needs("mount")
    def test_small_file_systems(self):
        place = self.folder / "small"
        place.mkdir()
        needed = sum((self.folder / name).stat().st_size for name in FILES) // 1024
        statuses = []
        for tenth in range(1, 16):
            subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={needed * tenth // 10}k", "tmpfs", place], check=True)
            try:
                statuses.append(self.full(75, cwd=place))
                self.assertEqual(sorted(path.name for path in place.iterdir()), [] if statuses[-1] else FILES)
            finally:
                subprocess.run(["umount", place], check=True)
        self.assertEqual((statuses[0], statuses[-1]), (75, 0))

    @needs("mount")
    def test_a_file_system_to_read_only(self):
        place = self.folder / "still"
        place.mkdir()
        subprocess.run(["mount", "-t", "tmpfs", "-o", "ro", "tmpfs", place], check=True)
        try:
            self.check(1, "none.pdb", "-o", "a.ply", says="Read-only file system", cwd=place)
            self.check(1, "batch", "none", "-O", "new", cwd=place)
            (self.folder / "list").write_text(f"{CRAMBIN}\n")
            self.check(1, "batch", "list", "-O", "still", says="Read-only file system")
        finally:
            subprocess.run(["umount", place], check=True)


class Pipes(ToolTest):
    def test_nobody_reads(self):
        for words in (["--help"], ["info", str(CRAMBIN)], [str(CRAMBIN), "-q", "-o", "-", "--format", "ply", *FAST]):
            with self.subTest(words=words):
                reader, writer = os.pipe()
                os.close(reader)
                done = subprocess.run([TOOL, *words], cwd=self.folder, stdout=writer, stderr=subprocess.PIPE)
                os.close(writer)
                self.assertEqual((done.returncode, done.stderr), (-signal.SIGPIPE, b""))

    def test_a_closed_output(self):
        done = self.run_tool(CRAMBIN, "-q", "-o", "-", "--format", "ply", *FAST, "-o", "a.ply",
                             preexec_fn=lambda: os.close(1))
        self.assertEqual(done.returncode, 1)
        self.assertEqual(self.names(), [])


class Truncation(ToolTest):
    """Files that become shorter while they are read."""

    def shorten(self, name, *words):
        whole = (self.folder / name).read_bytes()
        start = time.monotonic()
        self.check(0, *words)
        duration = time.monotonic() - start
        for n in range(12):
            (self.folder / name).write_bytes(whole)
            process = subprocess.Popen([TOOL, *words], cwd=self.folder, stdout=subprocess.DEVNULL,
                                       stderr=subprocess.PIPE)
            time.sleep(duration * n / 12)
            os.truncate(self.folder / name, len(whole) * n // 24)
            error = process.communicate(timeout=60)[1].decode()
            self.assertIn(process.returncode, (0, 1), error)
            if process.returncode:
                self.assertEqual(error.count("error: "), 1, error)
        (self.folder / name).write_bytes(whole)

    def test_structure(self):
        text = CRAMBIN.read_bytes().split(b"CONECT")[0].replace(b"END\n", b"")
        with open(self.folder / "a.pdb", "wb") as file:
            for model in range(1, 100):
                file.write(b"MODEL     %4d\n%sENDMDL\n" % (model, text))
        self.shorten("a.pdb", "info", "a.pdb")

    def test_grids(self):
        self.check(0, CRAMBIN, "--voxel", "0.2", "-q", "-o", "a.vdb")
        self.shorten("a.vdb", "info", "a.vdb")
        self.shorten("a.vdb", "convert", "a.vdb", "-q", "--force", "-o", "a.stl")

    def test_trajectory(self):
        shutil.copy(DATA / "1d3z.xtc", self.folder / "a.xtc")
        self.shorten("a.xtc", str(DATA / "1d3z.pdb.gz"), *FAST, "-q", "--trajectory", "a.xtc", "--force", "-o", "a.stl")


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
                self.assertTrue(state(killed / outputs) == expected, f"killed at {call} {number}")
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

    def test_bricks(self):
        """Of a plan, its bricks and their merge any may be killed."""
        whole, killed = self.folder / "whole", self.folder / "killed"
        runs = [["bricks", "plan", CRAMBIN, "-o", "plan.json", "--bricks", "2", "--steps", "3", *FAST],
                ["bricks", "run", "plan.json", "1"], ["bricks", "run", "plan.json", "2"],
                ["bricks", "merge", "plan.json", "-o", "a.vdb", "-o", "a.ply"]]
        for folder in (whole, killed):
            folder.mkdir()
        for words in runs:
            self.assertIn(self.run_tool(*words, cwd=whole).returncode, (0, 3))
            for call in NAMING:
                if killed_at(call, 1, words, killed):
                    done = self.run_tool(*words, cwd=killed)
                    complete = done.returncode == 1 and b"it exists already" in done.stderr
                    self.assertTrue(complete or done.returncode in (0, 3), done.stderr)
            self.assertTrue(state(killed) == state(whole), words)


if __name__ == "__main__":
    unittest.main()
