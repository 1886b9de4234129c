# SPDX-License-Identifier: MPL-2.0
"""Many structures in one call."""

import csv
import hashlib
import json
import shutil
import subprocess
import tarfile
import time
import unittest

from tool import CRAMBIN, DATA, FAST, TOOL, ToolTest

DIMER = DATA / "1a8o.cif.gz"


class Batch(ToolTest):
    def setUp(self):
        super().setUp()
        (self.folder / "broken.pdb").write_text("not a structure\n")
        (self.folder / "list").write_text(f"# three\n{CRAMBIN}\n\nbroken.pdb\n{DIMER}\n")

    def batch(self, status, *words, says=()):
        return self.check(status, "batch", "list", "-O", "out", *FAST, *words, says=says)

    def check(self, status, *words, says=(), **options):
        """As everywhere, but failures of structures are no errors of the call."""
        done = self.run_tool(*words, **options)
        error = done.stderr.decode()
        self.assertEqual(done.returncode, status, error)
        for word in [says] if isinstance(says, str) else says:
            self.assertIn(str(word), error)
        return done

    def files(self):
        return sorted(path.name for path in (self.folder / "out").iterdir())

    def table(self):
        with open(self.folder / "out" / "summary.csv", newline="") as file:
            return list(csv.DictReader(file))

    def test_failures_do_not_stop_the_rest(self):
        self.batch(1, says=["2/3 broken.pdb: failed", "3 structures, 1 failed"])
        self.assertEqual(self.files(),
                         sorted(f"{name}.{kind}" for name in ("1crn", "1a8o")
                                for kind in ("vdb", "ply", "json")) +
                         ["summary.csv", "summary.json", "summary.jsonl"])
        rows = self.table()
        self.assertEqual([row["status"] for row in rows], ["done", "failed", "done"])
        self.assertIn("no atoms", rows[1]["message"])
        summary = json.loads((self.folder / "out" / "summary.json").read_text())
        for row, entry in zip(rows, summary["structures"]):
            self.assertEqual(row["input"], entry["input"])
            if row["status"] == "done":
                self.assertEqual(float(row["area"]), entry["area"])
        report = json.loads((self.folder / "out" / "1crn.json").read_text())
        self.assertEqual(float(rows[0]["area"]), report["surface"]["area"])
        self.assertEqual(int(rows[0]["atoms"]), report["atoms"])
        for count in ("components", "cavities"):
            self.assertEqual(int(rows[0][count]), report["surface"][count], count)
        for row in rows:
            self.assertEqual((row["version"], row["options"], row["units"]),
                             (report["version"], report["options_sha256"], "area Å², volume Å³"))
        self.assertEqual(rows[0]["sha256"], report["input_sha256"])

    def test_again_does_what_was_not_done(self):
        self.batch(1)
        made = {name: (self.folder / "out" / name).stat().st_mtime_ns
                for name in self.files() if not name.startswith("summary")}
        (self.folder / "broken.pdb").write_bytes(CRAMBIN.read_bytes())
        (self.folder / "out" / "1a8o.ply").unlink()
        (self.folder / "out" / "1a8o.vdb").unlink()
        (self.folder / "out" / "1a8o.json").unlink()
        self.batch(0, "-j", "1", says=["2/3 broken.pdb: done", "1 done before", "0 failed"])
        for name, time in made.items():
            if name.startswith("1crn"):
                self.assertEqual((self.folder / "out" / name).stat().st_mtime_ns, time, name)
        self.assertEqual([row["status"] for row in self.table()], ["done"] * 3)

    def area(self, name):
        return next(float(row["area"]) for row in self.table() if row["input"].endswith(name))

    def test_an_input_that_has_changed_is_done_anew(self):
        source = self.folder / "x.pdb"
        (self.folder / "list").write_text("x.pdb\n")
        for content, says in ((CRAMBIN, "x.pdb: done"), (CRAMBIN, "1 done before"), (DATA / "1ubq.pdb", "x.pdb: done")):
            source.write_bytes(content.read_bytes())
            self.batch(0, "--formats", "json", says=says)
            report = json.loads((self.folder / "out" / "x.json").read_text())
            self.assertEqual(report["surface"]["area"], self.area("x.pdb"))
            self.assertEqual(self.table()[0]["sha256"], hashlib.sha256(content.read_bytes()).hexdigest())
        self.assertEqual(report["atoms"], 602)

    def test_lists_share_a_folder(self):
        for name in ("crambin", "ubiquitin"):
            (self.folder / name).write_text(f"{CRAMBIN if name == 'crambin' else DATA / '1ubq.pdb'}\n")
            self.check(0, "batch", name, "-O", "out", *FAST, "--formats", "json", says="0 failed")
        self.assertEqual([row["atoms"] for row in self.table()], ["327", "602"])
        self.check(0, "batch", "crambin", "-O", "out", *FAST, "--formats", "json", says="1 done before")
        self.assertEqual(len(self.table()), 2)
        # The name is taken by another content.
        (self.folder / "other").mkdir()
        (self.folder / "other" / "1ubq.pdb").write_bytes(CRAMBIN.read_bytes())
        (self.folder / "list").write_text("other/1ubq.pdb\n")
        self.batch(1, "--formats", "json", says=["1ubq.* are of", "another content", "--force"])
        self.assertEqual([row["atoms"] for row in self.table()], ["327", "602"])
        self.batch(0, "--formats", "json", "--force", says="0 failed")
        self.assertEqual([row["atoms"] for row in self.table()], ["327", "327"])

    def small(self, count):
        for i in range(count):
            (self.folder / f"t{i}.xyzr").write_text(f"{i} 0 0 1.7\n")
        return [f"t{i}.xyzr" for i in range(count)]

    def test_runs_at_once_share_a_folder(self):
        names = self.small(40)
        runs = []
        for part in range(2):
            (self.folder / f"list{part}").write_text("\n".join(names[part::2]))
            runs.append(subprocess.Popen([TOOL, "batch", f"list{part}", "-O", "out", "--voxel", "2", "--surface", "sas",
                                          "--formats", "json", "-q"], cwd=self.folder))
        self.assertEqual([run.wait() for run in runs], [0, 0])
        self.assertEqual(sorted(row["input"] for row in self.table()), sorted(names))
        self.assertEqual({row["status"] for row in self.table()}, {"done"})

    def test_killed_and_begun_again(self):
        names = self.small(60)
        (self.folder / "list").write_text("\n".join(names))
        call = ["batch", "list", "-O", "out", "--voxel", "2", "--surface", "sas", "--formats", "json"]
        path = self.folder / "out" / "summary.jsonl"
        for lines in (1, 2, 5, 40):
            run = subprocess.Popen([TOOL, *call, "-q"], cwd=self.folder)
            while run.poll() is None and not (path.exists() and path.read_bytes().count(b"\n") >= lines):
                time.sleep(0.005)
            run.kill()
            run.wait()
        with open(path, "a") as journal:
            journal.write('{"name":"t1","inp')  # as of a run that was killed while it wrote
        self.check(0, *call, says="60 structures")
        self.assertEqual([(row["input"], row["status"]) for row in self.table()], [(name, "done") for name in names])
        self.check(0, *call, says="60 done before")
        self.assertEqual(self.files(), sorted([name.replace("xyzr", "json") for name in names] +
                                              ["summary.csv", "summary.json", "summary.jsonl"]))

    def test_files_of_others_are_left(self):
        (self.folder / "out").mkdir()
        (self.folder / "out" / "t0.json").write_text("mine")
        self.small(1)
        (self.folder / "list").write_text("t0.xyzr\n")
        for _ in range(2):
            self.batch(1, "--formats", "json", says=["t0.json", "--force"])
        self.assertEqual((self.folder / "out" / "t0.json").read_text(), "mine")
        self.assertEqual(self.table()[0]["status"], "failed")

    def test_a_journal_that_was_cut_loses_no_row(self):
        """Wherever a crash of the machine cut it: the reports say that the files are of these inputs and options."""
        self.small(2)
        call = ("batch", "list", "-O", "out", *FAST, "--formats", "ply,json")
        (self.folder / "list").write_text("t0.xyzr\nt1.xyzr\n")
        self.check(0, *call)
        journal = self.folder / "out" / "summary.jsonl"
        whole = journal.read_bytes()
        lines = [len(line) for line in whole.splitlines(keepends=True)]
        for end in (0, lines[0] // 2, lines[0], lines[0] + 5, len(whole) - lines[-1], len(whole) - 1):
            journal.write_bytes(whole[:end])
            self.check(0, *call, says="2 structures")
            self.assertEqual([row["status"] for row in self.table()], ["done", "done"], end)
        journal.write_bytes(whole[:lines[0]])
        (self.folder / "t0.xyzr").write_text("0 0 0 1.9\n")
        self.check(1, *call, says=["t0.ply", "--force"])

    def test_a_line_that_was_cut_takes_no_other_along(self):
        """The first line behind that of a run that was killed while it wrote is of a failure, which no other follows."""
        self.small(1)
        (self.folder / "list").write_text("t0.xyzr\n")
        self.batch(0, "--formats", "json")
        (self.folder / "list").write_text("t1.xyzr\n")
        (self.folder / "t1.xyzr").write_text("1 0 0 1.7\n")
        (self.folder / "out" / "t1.json").write_text("mine")
        with open(self.folder / "out" / "summary.jsonl", "a") as journal:
            journal.write('{"name":"t2","inp')
        self.batch(1, "--formats", "json", says=["t1.json", "--force"])
        self.assertEqual([row["status"] for row in self.table()], ["done", "failed"])

    def test_folder_of_structures(self):
        (self.folder / "all").mkdir()
        (self.folder / "all" / "b.pdb").write_bytes(CRAMBIN.read_bytes())
        (self.folder / "all" / "a.xyzr").write_text("0 0 0 1.7\n")
        (self.folder / "all" / "notes.txt").write_text("not a structure\n")
        self.check(0, "batch", "all", "-O", "out", *FAST, "--formats", "json")
        self.assertEqual(self.files(), ["a.json", "b.json", "summary.csv", "summary.json", "summary.jsonl"])
        (self.folder / "none").mkdir()
        self.check(1, "batch", "none", "-O", "other", says="no structures")

    def archive(self, name, *members, format=tarfile.GNU_FORMAT):
        with tarfile.open(self.folder / name, "w:gz" if name.endswith("gz") else "w", format=format) as archive:
            for member, path in members:
                archive.add(path, member)

    def test_archives(self):
        """Members are what files are: packed or not, with long names, in formats of three decades."""
        long = "f" * 90 + "/" + "g" * 90
        members = [("1crn.pdb", CRAMBIN), (f"{long}/1ubq.pdb", DATA / "1ubq.pdb"), ("d/README.md", DATA / "README.md"),
                   ("d/1a8o.pdb.gz", DATA / "1a8o.pdb.gz")]
        (self.folder / "files").write_text("".join(f"{path}\n" for _, path in members if path.suffix != ".md"))
        words = ["--formats", "json", "--voxel", "1", "--surface", "sas"]
        self.check(0, "batch", "files", "-O", "plain", *words)
        expected = [row["sha256"] + row["area"] for row in csv.DictReader(open(self.folder / "plain" / "summary.csv"))]
        for name, form in (("a.tar", tarfile.GNU_FORMAT), ("b.tar.gz", tarfile.PAX_FORMAT), ("c.tgz", tarfile.USTAR_FORMAT)):
            with self.subTest(name):
                self.archive(name, *members, format=form)
                shutil.rmtree(self.folder / "out", ignore_errors=True)
                self.check(0, "batch", name, "-O", "out", *words)
                self.assertEqual([row["sha256"] + row["area"] for row in self.table()], expected)
                self.assertEqual(self.table()[0]["input"], f"{name}::1crn.pdb")
                self.check(0, "batch", name, "-O", "out", *words, says="3 done before")

    def test_archives_that_are_damaged(self):
        self.archive("a.tar", ("1crn.pdb", CRAMBIN), ("1ubq.pdb", DATA / "1ubq.pdb"))
        whole = (self.folder / "a.tar").read_bytes()
        (self.folder / "cut.tar").write_bytes(whole[:60000])
        self.check(1, "batch", "cut.tar", "-O", "out", "--formats", "json", "--voxel", "1",
                   says=["1/2 cut.tar::1crn.pdb: done", "cut.tar: is cut short"])
        (self.folder / "bad.tar").write_bytes(whole[:512] + whole[1024:])
        self.check(1, "batch", "bad.tar", "-O", "out", says=["bad.tar: is no .tar, or is damaged", "at byte"])
        (self.folder / "none.tar").write_bytes(bytes(1024))
        self.check(1, "batch", "none.tar", "-O", "out", says="no structures in this archive")
        self.check(1, "a.tar::2abc.pdb", "-o", "a.json", says="a.tar: has no member 2abc.pdb")

    def test_structure_in_place_of_a_list(self):
        self.check(1, "batch", CRAMBIN, "-O", "out", says=["it is a structure", "vdb_molsurf "])
        self.assertFalse((self.folder / "out" / "summary.csv").exists())

    def test_other_options_need_force_or_another_folder(self):
        self.batch(1)
        done = self.batch(1, "--probe", "1.5", says=["other options", "--force"])
        self.assertEqual(done.stderr.count(b"error: "), 1)
        self.batch(1, "--probe", "1.5", "--force", says="1 failed")
        self.assertNotEqual(json.loads((self.folder / "out" / "1crn.json").read_text())["command"]
                            .find("--probe"), -1)

    def test_quiet_tells_of_failures_alone(self):
        (self.folder / "list").write_text("none.pdb\nother.pdb\n")
        done = self.batch(1, "-q", "--formats", "json", says="2 of 2 structures failed; the table is out/summary.csv")
        self.assertEqual(done.stderr.count(b"\n"), 1)
        (self.folder / "list").write_text(f"{CRAMBIN}\n")
        self.assertEqual(self.batch(0, "-q", "--formats", "json").stderr, b"")

    def test_the_table_has_the_numbers_of_the_report(self):
        (self.folder / "list").write_text(f"{DATA / '4at1.ent.gz'}\n")
        self.check(0, "batch", "list", "-O", "out", "--surface", "ses", "--voxel", "2", "--formats", "json")
        report = json.loads((self.folder / "out" / "4at1.json").read_text())["surface"]
        row = json.loads((self.folder / "out" / "summary.json").read_text())["structures"][0]
        self.assertGreater(report["cavities"], report["components"])
        for name in ("area", "volume", "euler_characteristic", "components", "cavities"):
            self.assertEqual(row[name], report[name], name)

    def test_files_that_options_name_count_by_their_content(self):
        (self.folder / "list").write_text(f"{CRAMBIN}\n")
        for radius, status, says in ((1.7, 0, "0 failed"), (1.7, 0, "1 done before"), (1.8, 1, "other options")):
            (self.folder / "r").write_text(f"* {radius}\n")
            self.batch(status, "--radii", "r", "--formats", "json", says=says)

    def test_surfaces_of_another_version_are_not_mixed_in(self):
        (self.folder / "list").write_text(f"{CRAMBIN}\n")
        self.batch(0, "--formats", "json")
        journal = self.folder / "out" / "summary.jsonl"
        header, rest = journal.read_text().split("\n", 1)
        version = json.loads(header)["version"]
        journal.write_text(header.replace(f'"{version}"', '"0.0.1"') + "\n" + rest)
        self.batch(1, "--formats", "json", says=["holds surfaces with other options", "version 0.0.1"])

    def test_what_another_run_has_begun_is_in_no_table(self):
        (self.folder / "list").write_text(f"{CRAMBIN}\n")
        self.batch(0, "--formats", "json")
        journal = self.folder / "out" / "summary.jsonl"
        lines = journal.read_text().splitlines()
        begun = next(line for line in lines if '"begun"' in line)
        journal.write_text("\n".join([*lines, begun.replace("1crn", "2crn")]) + "\n")
        self.batch(0, "--formats", "json", says="1 done before")
        self.assertEqual([row["status"] for row in self.table()], ["done"])

    def test_not_converged(self):
        (self.folder / "list").write_text(f"{CRAMBIN}\n")
        self.batch(3, "--flow", "newton", "--max-steps", "1", "--formats", "json", says="1 not converged")
        self.assertEqual(self.files(), ["1crn.json", "summary.csv", "summary.json", "summary.jsonl"])

    def test_names_are_no_formulas(self):
        names = ["=1+1.pdb", "+a.pdb", "-a, b.pdb", "@c.pdb", "a=b.pdb"]
        for name in names:
            (self.folder / name).write_bytes(CRAMBIN.read_bytes())
        (self.folder / "list").write_text("\n".join([*names, "=none.pdb"]))
        self.batch(1, "--formats", "ply")
        self.assertEqual([row["input"] for row in self.table()],
                         ["'=1+1.pdb", "'+a.pdb", "'-a, b.pdb", "'@c.pdb", "a=b.pdb", "'=none.pdb"])
        self.batch(1, "--formats", "ply", says="5 done before")

    def test_a_structure_that_is_called_summary(self):
        (self.folder / "summary.pdb").write_bytes(CRAMBIN.read_bytes())
        (self.folder / "list").write_text("summary.pdb\n")
        self.batch(1, says=["summary.pdb and the summary would both be written to out/summary.json"])
        self.assertFalse((self.folder / "out").exists())
        self.batch(0, "--formats", "ply")
        self.assertEqual(self.files(), ["summary.csv", "summary.json", "summary.jsonl", "summary.ply"])

    def test_files_that_are_read_are_not_written(self):
        (self.folder / "out").mkdir()
        source = self.folder / "out" / "x.json"
        source.write_bytes(CRAMBIN.read_bytes())
        (self.folder / "list").write_text("out/x.json\n")
        self.batch(1, "--force", says=["out/x.json", "which is read"])
        (self.folder / "out" / "summary.csv").write_text(f"{CRAMBIN}\n")
        self.check(1, "batch", "out/summary.csv", "-O", "out", *FAST, "--force", says="which is read")
        self.assertEqual(source.read_bytes(), CRAMBIN.read_bytes())
        self.assertEqual(self.files(), ["summary.csv", "x.json"])

    def test_wrong_calls(self):
        self.check(2, "batch", says="one list")
        self.check(2, "batch", "list", says="-O DIR")
        self.check(2, "batch", "list", "-O", "out", "--formats", "vdb,gltf", says="gltf")
        self.check(2, "batch", "list", "-O", "out", "-o", "a.vdb", says="-o")
        self.check(1, "batch", "none", "-O", "out", says="none")
        (self.folder / "list").write_text("a/x.pdb\nb/x.cif.gz\n")
        self.check(1, "batch", "list", "-O", "out", says=["a/x.pdb", "b/x.cif.gz"])
        (self.folder / "list").write_text("# nothing\n")
        self.check(1, "batch", "list", "-O", "out", says="list")
        self.assertFalse((self.folder / "out").exists())
        (self.folder / "out").mkdir()
        (self.folder / "out" / "summary.jsonl").write_text("{}\n")
        (self.folder / "list").write_text(f"{CRAMBIN}\n")
        self.check(1, "batch", "list", "-O", "out", says="no journal of a batch")


if __name__ == "__main__":
    unittest.main()
