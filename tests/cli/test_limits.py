# SPDX-License-Identifier: MPL-2.0
"""What would take too much memory or time is refused before the work, and takes little itself."""

import gzip
import io
import json
import os
import pathlib
import random
import re
import subprocess
import tarfile
import time
import unittest

from tool import CRAMBIN, DATA, FAST, TOOL, ToolTest, size_of

LITTLE = 110e6  # bytes, of which the program itself takes 40 MB
ENDS = 20.0  # seconds of all processors: far more than a refusal takes, far less than what is refused


class Limits(ToolTest):
    def refuse(self, *words, says, tool=TOOL, most=LITTLE, expected=1):
        """Returns how many bytes were read; 0 where only root may know.

        @param most  bytes of memory that may be held"""
        before = self.names()
        child = subprocess.Popen([tool, *map(str, words)], cwd=self.folder, stdin=subprocess.DEVNULL,
                                 stderr=subprocess.PIPE, stdout=subprocess.DEVNULL)
        error = child.stderr.read().decode()
        child.stderr.close()
        os.waitid(os.P_PID, child.pid, os.WEXITED | os.WNOWAIT)
        try:
            with open(f"/proc/{child.pid}/io", encoding="ascii") as accounts:
                read = int(accounts.readline().split()[1])
        except PermissionError:
            read = 0
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
        self.assertEqual(child.returncode, expected, error)
        for word in says:
            self.assertIn(word, error.splitlines(keepends=True)[-1])
        if not any(name in TOOL for name in ("build-fuzz", "build-tsan", "build-coverage")):
            self.assertLess(usage.ru_maxrss * 1024, most)
            self.assertLess(usage.ru_utime + usage.ru_stime, ENDS)
        self.assertEqual(self.names(), before)
        return read

    def balls(self, name, lines):
        (self.folder / name).write_text("".join(lines))
        return name

    def test_gzip_bomb(self):
        member = gzip.compress(bytes(10 ** 8))
        (self.folder / "bomb.pdb.gz").write_bytes(member * 20)
        for words in (("bomb.pdb.gz", "-o", "a.json"), ("info", "bomb.pdb.gz")):
            self.refuse(*words, says=["bomb.pdb.gz", "200 times", "--max-input"])

    def test_input_above_its_limit(self):
        packed = gzip.compress(CRAMBIN.read_bytes())
        (self.folder / "a.pdb.gz").write_bytes(packed)
        for name in (CRAMBIN, "a.pdb.gz"):
            self.refuse(name, "-o", "a.json", "--max-input", "40K", says=["40960 bytes"])
            self.check(0, name, "-o", "a.json", "--max-input", "1M", "--force", *FAST)
            os.remove(self.folder / "a.json")
        self.check(2, CRAMBIN, "-o", "a.json", "--max-input", "much", says="--max-input")

    def test_files_without_an_end(self):
        """Wherever a file is named: no more is read, or held, than the limit and a block."""
        size, block, program = 100 << 20, 4 << 20, 110 << 20
        for name in ("endless.ply", "endless.pdb"):
            (self.folder / name).symlink_to("/dev/zero")
        zero, output = "/dev/zero", ["-o", "a.ply"]
        for words in (["endless.pdb", *output], ["info", zero], [CRAMBIN, "--radii", zero, *output],
                      [CRAMBIN, "--groups", zero, *output], [CRAMBIN, "--color", f"table={zero}", *output],
                      [CRAMBIN, "--color", f"potential={zero}", *output], [CRAMBIN, "--config", zero, *output],
                      ["batch", zero, "-O", "out"], ["compare", zero, CRAMBIN], ["compare", "endless.ply", CRAMBIN]):
            with self.subTest(words=words):
                read = self.refuse(*words, "--max-input", size, says=[f"{size} bytes", "--max-input"],
                                   most=program + size + block)
                self.assertLess(read, size + block)
        with open(zero, "rb") as stream:
            self.check(1, "-", *output, "--max-input", size, says=f"{size} bytes", stdin=stream)

    def test_a_view_without_an_end(self):
        """No option raises this limit, so there is no hint of one."""
        (self.folder / "endless.view").symlink_to("/dev/zero")
        self.refuse(CRAMBIN, "--view", "endless.view", *FAST, "-o", "a.png",
                    says=["endless.view: expected at most 1048576 bytes of text\n"])

    def test_a_lattice_without_an_end(self):
        (self.folder / "a.pqr").write_text("ATOM      1  C   ION     1       0.000   0.000   0.000 1.000 2.000\n")
        self.refuse("a.pqr", "--for", "apbs", "--apbs-grid", "/dev/zero", "-o", "run/",
                    says=["/dev/zero: expected at most 1048576 bytes of text\n"])

    def test_a_bomb_in_an_archive(self):
        with tarfile.open(self.folder / "bomb.tar.gz", "w:gz", compresslevel=6) as archive:
            member = tarfile.TarInfo("a.pdb")
            member.size = 40 << 20
            archive.addfile(member, io.BytesIO(bytes(member.size)))
        name = "bomb.tar.gz::a.pdb"
        self.refuse(name, "-o", "a.json", says=[f"{name}: expected at most 16777216 bytes", "--max-input"])
        self.check(1, name, "-o", "a.json", "--max-input", "50M", says="bomb.tar.gz::a.pdb: is ")

    def test_plans_without_an_end(self):
        for words in (["run", "/dev/zero", 1], ["merge", "/dev/zero", "-o", "a.ply"]):
            self.refuse("bricks", *words, says=["/dev/zero: is a pipe or a device"])

    def test_spheres_without_an_end(self):
        """The stand-ins have a limit, too."""
        (self.folder / "a.prm").write_text("XYZR_FileName = /dev/zero\nSurface = ses\n")
        (self.folder / "b.prm").symlink_to("/dev/zero")
        folder, most = pathlib.Path(TOOL).resolve().parent, 512 << 20
        for name, words, limit in (("msms", ["-if", "/dev/zero", "-of", "a"], most),
                                   ("nanoshaper", ["a.prm"], most), ("nanoshaper", ["b.prm"], 1 << 20)):
            with self.subTest(name=name, words=words):
                self.refuse(*words, tool=folder / f"vdb_molsurf_{name}", most=(130 << 20) + limit,
                            says=[f"{limit} bytes"])

    def seconds(self, status, *words, says=""):
        """Runs the tool. Returns the seconds that it took of all processors."""
        before = os.times()
        self.check(status, *words, says=says)
        after = os.times()
        return after.children_user + after.children_system - before.children_user - before.children_system

    def grows_as_its_input(self, write, *words, status=0, says=""):
        """Of four times as many names it takes four times as long, not sixteen times.

        @param write  writes the input of so many names"""
        spent = []
        for many in (30000, 120000):
            write(many)
            spent.append(min(self.seconds(status, *words, says=says) for _ in range(2)))
        self.assertLess(spent[1], 9 * spent[0] + 1, spent)

    def cif(self, name, rows, more=""):
        columns = ("id type_symbol label_atom_id label_comp_id label_asym_id label_entity_id Cartn_x Cartn_y Cartn_z "
                   "auth_seq_id pdbx_PDB_model_num")
        head = "data_x\nloop_\n" + "".join(f"_atom_site.{column}\n" for column in columns.split())
        lines = (f"{n} C CA ALA {chain} {entity} {n % 99} {n // 99 % 99} {n // 9801} 1 {model}\n"
                 for n, (chain, entity, model) in enumerate(rows, 1))
        (self.folder / name).write_text(head + "".join(lines) + more)

    def test_many_models(self):
        self.grows_as_its_input(lambda many: self.cif("a.cif", (("A", 1, n) for n in range(1, many + 1))),
                                "a.cif", "--dry-run", "--surface", "sas", "-o", "a.json")

    def test_many_entities(self):
        def write(many):
            types = "".join(f"{n} polymer\n" for n in range(many))
            self.cif("a.cif", ((f"C{n}", n, 1) for n in range(many)), f"loop_\n_entity.id\n_entity.type\n{types}")
        self.grows_as_its_input(write, "info", "a.cif")

    def test_many_assemblies(self):
        matrix = "".join(f"_pdbx_struct_oper_list.{name}\n" for name in (
            "id", *(f"matrix[{i}][{j}]" for i in (1, 2, 3) for j in (1, 2, 3)), *(f"vector[{i}]" for i in (1, 2, 3))))
        generated = "".join(f"_pdbx_struct_assembly_gen.{name}\n" for name in ("assembly_id", "oper_expression", "asym_id_list"))

        def write(many):
            assemblies = "".join(f"{n} 1 A\n" for n in range(many))
            self.cif("a.cif", [("A", 1, 1)],
                     f"loop_\n{generated}{assemblies}loop_\n{matrix}1 1 0 0 0 1 0 0 0 1 0 0 0\n")
        self.grows_as_its_input(write, "a.cif", "--dry-run", "--surface", "sas", "-o", "a.json")

    def test_many_keys_in_a_plan(self):
        def write(many):
            (self.folder / "keys.json").write_text("{" + ",".join(f'"k{n}":1' for n in range(many)) + "}")
        self.grows_as_its_input(write, "bricks", "run", "keys.json", 1, status=1, says="keys.json: is no plan")

    def test_json_that_takes_many_times_its_size(self):
        size = 20 << 20
        for name, begin, unit in (("deep", "", '{"a":'), ("array", '{"a":', "["), ("digits", '{"a":', "7"), ("text", '{"a":"', "7"),
                                  ("values", '{"a":[', "0,")):
            with open(self.folder / f"{name}.json", "w", encoding="ascii") as file:  # memory of this process is the child's, too
                file.write(begin)
                for _ in range(size // (len(unit) << 10)):
                    file.write(unit * 1024)
            with self.subTest(name=name):
                self.refuse("bricks", "run", f"{name}.json", 1, says=["is no plan"], most=(60 << 20) + 2 * size)
                self.refuse(CRAMBIN, "--groups", f"{name}.json", "-o", "a.ply", says=["is no JSON of groups"],
                            most=(60 << 20) + 2 * size)

    def test_a_line_without_an_end(self):
        """Fields of a line take no more memory than the line."""
        size = 40 << 20
        for name in ("line.xyzr", "line.xyzrn", "line.list"):
            (self.folder / name).write_text("1 " * (size // 2))
        for words in (["line.xyzr", "-o", "a.ply"], [CRAMBIN, "--radii", "line.xyzr", "-o", "a.ply"],
                      [CRAMBIN, "--groups", "line.xyzr", "-o", "a.ply"],
                      [CRAMBIN, "--color", "table=line.xyzr", "-o", "a.ply"],
                      [CRAMBIN, "--color", "potential=line.xyzr", "-o", "a.ply"],
                      [CRAMBIN, "--config", "line.xyzr", "-o", "a.ply"], ["info", "line.xyzrn"],
                      ["batch", "line.list", "-O", "out"]):
            with self.subTest(words=words):
                self.refuse(*words, says=["line."], most=(60 << 20) + 2 * size)

    def test_more_memory_than_there_is(self):
        grid = [f"{6 * i} {6 * j} {6 * k} 1.7\n"
                for i in range(40) for j in range(40) for k in range(40)]
        self.balls("grid.xyzr", grid)
        for kind in ("variational", "ses", "vdw"):
            self.refuse("grid.xyzr", "--surface", kind, "--voxel", "0.05", "-o", "a.vdb",
                        says=["GiB of memory, and there are", "--voxel"], expected=75)
        self.balls("huge.xyzr", [f"{i} 0 0 {20000 + i}\n" for i in range(1000)])
        self.refuse("huge.xyzr", "--voxel", "0.05", "-o", "a.vdb", says=["GiB"], expected=75)
        self.balls("giant.xyzr", ["0 0 0 1e6\n"])
        self.refuse("giant.xyzr", "-o", "a.vdb", says=["GiB"], expected=75)

    def test_many_atoms_far_from_each_other(self):
        places = random.Random(20)
        for name, sizes in (("alone", [1]), ("in_groups", [5, 20])):
            lines = []
            while len(lines) < 300000:
                middle = [places.uniform(-1e5, 1e5) for _ in range(3)]
                for _ in range(places.choice(sizes)):
                    x, y, z = (m + places.uniform(-20, 20) for m in middle)
                    lines.append(f"{x:.2f} {y:.2f} {z:.2f} 1.7\n")
            self.balls(name, lines)
            for voxel in (0.05, 0.5):
                self.refuse(name, "--voxel", voxel, "-o", "a.vdb", says=["iB of memory"], expected=75)

    def test_more_hours_than_allowed(self):
        for words in ((), ("--memory", "60M")):
            self.refuse(CRAMBIN, "--voxel", "0.2", "--max-hours", "1e-5", "-o", "a.vdb", *words,
                        says=["hours", "--max-hours"])

    def test_a_dry_run_knows_of_atoms_far_from_each_other(self):
        rng = random.Random(1)
        (self.folder / "far.xyzr").write_text(
            "".join(f"{rng.uniform(0, 9e5)} {rng.uniform(0, 9e5)} {rng.uniform(0, 9e5)} 1.7\n" for _ in range(300)))
        said = self.check(0, "far.xyzr", "--surface", "sas", "--dry-run").stderr.decode()
        estimate = size_of(said)
        self.check(0, "far.xyzr", "--surface", "sas", "-o", "a.ply", "-o", "a.json")
        peak = json.loads((self.folder / "a.json").read_text())["peak_memory_bytes"]
        self.assertTrue(0.7 < estimate / peak < 1.5, (estimate, peak))

    def test_convert_says_what_it_takes(self):
        for words in (("--fields", "spline"), ("--surface", "ses")):
            self.check(0, DATA / "4at1.ent.gz", *words, "-o", "a.vdb", "--force")
            said = self.check(0, "convert", "a.vdb", "--dry-run", "-o", "b.json").stderr.decode()
            self.assertNotIn("b.json", self.names())
            estimate = size_of(said)
            self.check(0, "convert", "a.vdb", "-o", "a.json", "--force")
            peak = json.loads((self.folder / "a.json").read_text())["peak_memory_bytes"]
            self.assertTrue(0.7 < estimate / peak < 2, (estimate, peak))
            self.refuse("convert", "a.vdb", "-o", "b.ply", "--max-hours", "1e-5", says=["hours", "--max-hours"])

    def test_convert_says_what_drawing_takes(self):
        self.check(0, DATA / "4at1.ent.gz", "--surface", "sas", "--voxel", "1", "-o", "a.vdb")
        for width in (600, 2400):
            words = ("convert", "a.vdb", "-o", "a.png", "-o", "a.json", "--size", width)
            said = self.check(0, *words, "--force", "--dry-run").stderr.decode()
            estimate = size_of(said)
            self.check(0, *words, "--force")
            peak = json.loads((self.folder / "a.json").read_text())["peak_memory_bytes"]
            self.assertTrue(0.7 < estimate / peak < 1.5, (width, estimate, peak))

    def test_a_dry_run_knows_of_pockets(self):
        for more in ([], ["--probe-out", "8"], ["--show", "pockets", "--opacity", "0.4", "-o", "a.png"]):
            words = (DATA / "4at1.ent.gz", "--voxel", "0.5", "--pockets", "-o", "a.json", *more)
            said = self.check(0, *words, "--force", "--dry-run").stderr.decode()
            self.check(0, *words, "--force")
            peak = json.loads((self.folder / "a.json").read_text())["peak_memory_bytes"]
            self.assertTrue(0.9 < size_of(said) / peak < 1.8, (more, size_of(said), peak))

    def test_a_dry_run_knows_of_products(self):
        """Each has a row with its cost, with a grid and without."""
        for words in (("--remesh", "0.4", "-o", "a.ply"), ("--print-scale", "1", "--min-thickness", "20", "-o", "a.stl"),
                      ("--surface", "sas", "--contacts", "atom", "-o", "a.contacts.csv"), ("--pockets", "--probe-out", "12", "-o", "a.pockets.csv")):
            words = (DATA / "4at1.ent.gz", "--voxel", "0.6", *words, "-o", "a.json")
            said = self.check(0, *words, "--force", "--dry-run").stderr.decode()
            self.check(0, *words, "--force")
            peak = json.loads((self.folder / "a.json").read_text())["peak_memory_bytes"]
            self.assertTrue(0.65 < size_of(said) / peak < 1.5, (words, size_of(said), peak))

    def test_lengths_that_buy_no_memory(self):
        """A product that needs the whole is refused with what it takes, and lengths have bounds."""
        self.refuse(DATA / "4at1.ent.gz", "--remesh", "0.05", "--memory", "1G", "-o", "a.ply", expected=2,
                    says=["--remesh needs the whole molecule at once, which takes about", "[hint: --memory "])
        self.refuse(CRAMBIN, "--print-scale", "0.1", "--min-thickness", "1000", "-o", "a.stl", expected=2,
                    says=["--min-thickness: expected at most 10 mm, which are 100 Å at --print-scale 0.1, got 1000"])

    def test_a_dry_run_knows_of_drawing(self):
        words = (CRAMBIN, *FAST, "-o", "a.png", "-o", "a.json", "--size", "1200")
        said = self.check(0, *words, "--dry-run").stderr.decode()
        self.check(0, *words)
        peak = json.loads((self.folder / "a.json").read_text())["peak_memory_bytes"]
        self.assertTrue(0.7 < size_of(said) / peak < 1.5, (said, peak))
        self.check(1, *words, "--force", "--max-hours", "1e-4", says="hours")

    def test_a_dry_run_knows_of_steps(self):
        """Those of the paper do not end before the last one that is allowed."""
        def seconds(*words):
            said = self.check(0, CRAMBIN, *words, "--dry-run").stderr.decode()
            return float(re.search(r"(\S+) s on one core", said)[1])
        paper = seconds("--flow", "paper")
        self.assertGreater(paper, 10 * seconds())
        self.assertGreater(paper, 5 * seconds("--flow", "paper", "--steps", "20"))

    def test_a_dry_run_knows_of_maps(self):
        """They have all points of the box: 1e9 of two atoms."""
        (self.folder / "far.xyzr").write_text("0 0 0 1.7\n1000 1000 1000 1.7\n")
        seconds = {}
        for name in ("a.vdb", "a.mrc"):
            said = self.check(0, "far.xyzr", "--voxel", "1", "-o", name, "--dry-run").stderr.decode()
            seconds[name] = float(re.search(r"(\S+) s on one core", said)[1])
        self.assertLess(seconds["a.vdb"], 1)
        self.assertTrue(50 < seconds["a.mrc"] < 100, seconds)
        self.refuse("far.xyzr", "--voxel", "1", "-o", "a.mrc", "--max-hours", "0.001", says=["hours", "--max-hours"])

    def test_compare_says_what_it_takes(self):
        """Of both surfaces at once."""
        large = DATA / "4at1.ent.gz"
        self.check(0, large, "--surface", "sas", *FAST, "-o", "a.vdb", "-o", "a.ply", "-o", "a.obj")
        for words in ((large, large, "--surface", "sas", *FAST), ("a.vdb", "a.vdb"), ("a.ply", "a.ply"), ("a.obj", "a.obj")):
            said = self.check(0, "compare", *words, "--dry-run", "-o", "b.json").stderr.decode()
            self.assertNotIn("b.json", self.names())
            self.check(0, "compare", *words, "-o", "a.json", "--force")
            peak = json.loads((self.folder / "a.json").read_text())["peak_memory_bytes"]
            self.assertTrue(0.7 < size_of(said) / peak < 1.5, (words, said, peak))
            self.refuse("compare", *words, "--max-hours", "1e-5", says=["hours", "--max-hours"])

    def test_compare_refuses_what_is_too_large(self):
        self.check(75, "compare", CRAMBIN, CRAMBIN, "--voxel", "0.05", "--epsilon", "10", "--probe", "90",
                   says=["iB of memory, and there are"])

    def test_a_run_ends_at_its_hours(self):
        """Its estimate is far below them, as it is of 64 cores."""
        before = time.monotonic()
        done = self.check(1, CRAMBIN, "--flow", "paper", "--max-steps", "4000", "-j", "64", "--max-hours", "0.0005",
                          "-o", "a.ply", says=["or more than it may", "[hint: "])
        self.assertLess(time.monotonic() - before, 30)
        self.assertNotIn(b"interrupted", done.stderr)
        self.assertEqual(self.names(), [])

    def test_a_dry_run_answers_in_any_case(self):
        self.balls("giant.xyzr", ["0 0 0 1000\n"])
        for words in (("--probe", "100", "--voxel", "0.05"), ("--max-hours", "1e-6")):
            self.check(0, CRAMBIN, "--dry-run", "-o", "a.vdb", *words, says="iB of memory")
        self.check(0, "giant.xyzr", "--dry-run", "-o", "a.vdb", "--voxel", "1", says="iB of memory")

    def test_many_copies_of_an_atom(self):
        lines = ["REMARK 350 BIOMOLECULE: 1\n", "REMARK 350 APPLY THE FOLLOWING TO CHAINS: A\n"]
        for n in range(100000):
            shift = (10.0 * (n % 50), 10.0 * (n // 50 % 50), 10.0 * (n // 2500))
            for row in range(3):
                unit = [float(row == column) for column in range(3)]
                lines.append("REMARK 350   BIOMT%d %3d %9.6f %9.6f %9.6f %14.5f\n"
                             % (row + 1, n + 1, *unit, shift[row]))
        lines.append("ATOM      1  CA  ALA A   1       0.000   0.000   0.000  1.00  0.00           C\n")
        self.balls("copies.pdb", lines)
        self.check(0, "copies.pdb", "--assembly", "1", "--voxel", "10", "--surface", "sas", "-o", "a.json",
                   says="100000 atoms")


if __name__ == "__main__":
    unittest.main()
