# SPDX-License-Identifier: MPL-2.0
"""bricks plan, run and merge; --memory and --dry-run."""

import collections
import hashlib
import json
import os
import shutil
import signal
import struct
import subprocess
import time
import unittest
import zlib

from tool import CRAMBIN, DATA, FAST, TOOL, ToolTest, read_ply, size_of

STEPS = ["--steps", "4"]
HEAD = 32  # bytes of a brick before its sections
LEAF = struct.Struct("<3iIQQ8Q")


def edges(triangles):
    """How often each directed edge is run through."""
    count = collections.Counter()
    for a, b, c in triangles:
        count.update([(a, b), (b, c), (c, a)])
    return count


# All but the fog, which is that of the whole.
FIELDS = ("sas,spline,mean_curvature,gaussian_curvature,principal_curvature_1,principal_curvature_2,shape_index,"
          "curvedness,principal_direction_1,principal_direction_2,atom_id,chain_id,group_id,Cd")


class Bricks(ToolTest):
    def setUp(self):
        super().setUp()
        self.input = self.folder / "dimer.cif.gz"
        shutil.copy(DATA / "1a8o.cif.gz", self.input)

    def plan(self, count=3, *words):
        self.check(0, "bricks", "plan", "dimer.cif.gz", "-o", "plan.json", "--bricks", count, "--assembly",
                   "1", *FAST, *STEPS, *words)
        return json.loads((self.folder / "plan.json").read_text())

    def bricks(self, plan):
        for k in range(1, len(plan["bricks"]) + 1):
            self.check(0, "bricks", "run", "plan.json", k)

    def report(self, name):
        return json.loads((self.folder / name).read_text())

    def test_a_plan_of_one_atom(self):
        (self.folder / "one.xyzr").write_text("0 0 0 2\n")
        self.check(0, "bricks", "plan", "one.xyzr", "-o", "plan.json", "--bricks", "1", *FAST, *STEPS, says="1 atom, 1 brick, ")

    def test_plans_keep_switches(self):
        plan = self.plan(2, "--waters")
        self.assertEqual(plan["options"]["waters"], [])
        self.assertGreater(plan["atoms"], self.plan(2, "--force")["atoms"])

    def test_are_the_whole(self):
        plan = self.plan(4, "--fields", FIELDS, "--color", "chain", "--group-by", "chain")
        self.assertEqual(len(plan["bricks"]), 4)
        self.assertEqual(plan["steps"], 4)
        self.bricks(plan)
        self.assertEqual([name for name in self.names() if name.endswith(".brick")],
                         [f"plan.{k}.brick" for k in range(1, 5)])
        self.run_tool("bricks", "merge", "plan.json", "-o", "m.vdb", "-o", "m.ply", "-o", "m.json")
        self.run_tool("dimer.cif.gz", "--assembly", "1", *FAST, *STEPS, "--fields", FIELDS,
                      "--color", "chain", "--group-by", "chain", "-o", "w.vdb", "-o", "w.ply",
                      "-o", "w.json")
        merged, whole = self.report("m.json"), self.report("w.json")
        self.assertEqual(list(merged), list(whole))
        self.assertEqual(list(merged["surface"]), list(whole["surface"]))
        for name in ("euler_characteristic", "mesh_euler_characteristic", "components", "cavities", "vertices", "triangles",
                     "closed", "manifold", "degenerate_triangles", "kink_share", "gradient_share"):
            self.assertEqual(merged["surface"][name], whole["surface"][name], name)
        for name in ("area", "volume", "outer_area"):
            self.assertAlmostEqual(merged["surface"][name], whole["surface"][name], 5)
        self.assertEqual(merged["grid"]["active_voxels"], whole["grid"]["active_voxels"])
        self.assertEqual(merged["evolution"]["converged"], whole["evolution"]["converged"])
        self.assertAlmostEqual(merged["evolution"]["final_energy"], whole["evolution"]["final_energy"],
                               delta=1e-6 * whole["evolution"]["final_energy"])
        for a, b in zip(merged["evolution"]["energy"], whole["evolution"]["energy"]):
            self.assertAlmostEqual(a, b, 6)
        self.assertEqual([g["name"] for g in merged["groups"]], [g["name"] for g in whole["groups"]])
        for a, b in zip(merged["groups"], whole["groups"]):
            self.assertEqual(a["atoms"], b["atoms"])
            self.assertAlmostEqual(a["area"], b["area"], 3)

        names, vertices, triangles = read_ply((self.folder / "m.ply").read_bytes())
        other_names, other_vertices, _ = read_ply((self.folder / "w.ply").read_bytes())
        self.assertEqual(names, other_names)
        self.assertEqual(sorted(vertices), sorted(other_vertices), "the same vertices, bit by bit")
        run = edges(triangles)
        self.assertEqual(set(run.values()), {1})
        self.assertTrue(all((b, a) in run for a, b in run), "every edge is run through both ways")

    def test_assemblies_stay_folded(self):
        """Without labels a plan has each atom once, and its bricks are those of all atoms."""
        plan = self.plan(3)
        size = (self.folder / "plan.atoms").stat().st_size
        self.bricks(plan)
        self.run_tool("bricks", "merge", "plan.json", "-o", "m.vdb", "-o", "m.ply")
        self.run_tool("dimer.cif.gz", "--assembly", "1", *FAST, *STEPS, "-o", "w.vdb", "-o", "w.ply")
        whole, merged = (sorted(read_ply((self.folder / name).read_bytes())[1]) for name in ("w.ply", "m.ply"))
        self.assertEqual(merged, whole, "the same vertices, bit by bit")
        labelled = self.plan(3, "--force", "--color", "element")
        self.assertEqual(plan["atoms"], labelled["atoms"])
        for key in ("min", "max", "atoms", "voxels"):
            self.assertEqual([b[key] for b in plan["bricks"]], [b[key] for b in labelled["bricks"]])
        self.assertLess(size, 0.6 * (self.folder / "plan.atoms").stat().st_size)

    def test_groups_have_their_colours(self):
        words = ("--color", "group", "--group-by", "chain", "--surface", "vdw")
        self.bricks(self.plan(2, *words))
        self.run_tool("bricks", "merge", "plan.json", "-o", "m.json")
        self.run_tool("dimer.cif.gz", "--assembly", "1", *FAST, *words, "-o", "w.ply", "-o", "w.json")
        merged, whole = ([group["color"] for group in self.report(name)["groups"]] for name in ("m.json", "w.json"))
        self.assertEqual(merged, whole)
        self.assertEqual(len(set(merged)), 2)

    def test_a_finished_brick_is_kept(self):
        plan = self.plan(2)
        self.bricks(plan)
        first = self.folder / "plan.1.brick"
        before = first.stat().st_mtime_ns
        self.check(0, "bricks", "run", "plan.json", 1, says="done already")
        self.assertEqual(first.stat().st_mtime_ns, before)
        self.check(0, "bricks", "run", "plan.json", 1, "--force")
        self.assertNotEqual(first.stat().st_mtime_ns, before)

    def test_a_killed_brick_can_be_run_again(self):
        plan = self.plan(2)
        self.bricks(plan)
        self.run_tool("bricks", "merge", "plan.json", "-o", "a.vdb", "-o", "a.ply")
        (self.folder / "plan.2.brick").unlink()
        for wait in (0.0, 0.02, 0.05, 0.1, 0.2):
            process = subprocess.Popen([TOOL, "bricks", "run", "plan.json", "2", "-q"], cwd=self.folder)
            time.sleep(wait)
            process.send_signal(signal.SIGKILL)
            process.wait()
        if not (self.folder / "plan.2.brick").exists():
            self.check(1, "bricks", "merge", "plan.json", "-o", "b.ply", says="of 2 bricks 1 are missing: 2")
        self.check(0, "bricks", "run", "plan.json", 2)
        self.run_tool("bricks", "merge", "plan.json", "-o", "b.ply")
        self.assertEqual((self.folder / "a.ply").read_bytes(), (self.folder / "b.ply").read_bytes())

    def test_incomplete_and_foreign_sets_are_refused(self):
        plan = self.plan(3)
        self.bricks(plan)
        (self.folder / "plan.2.brick").rename(self.folder / "kept")
        self.check(1, "bricks", "merge", "plan.json", "-o", "m.ply", says="missing: 2")
        shutil.copy(self.folder / "plan.3.brick", self.folder / "plan.2.brick")
        self.check(1, "bricks", "merge", "plan.json", "-o", "m.ply", says="belongs to another plan")
        (self.folder / "plan.2.brick").write_text("nothing of the kind, but long enough\n")
        self.check(1, "bricks", "merge", "plan.json", "-o", "m.ply", says="is not the file of a brick")
        (self.folder / "kept").rename(self.folder / "plan.2.brick")
        self.plan(3, "--force", "--probe", "1.5")
        self.check(1, "bricks", "merge", "plan.json", "-o", "m.ply", says="belongs to another plan")
        self.check(1, "bricks", "run", "plan.json", 1, says="belongs to another plan")
        self.check(0, "bricks", "run", "plan.json", 1, "--force")
        shutil.copy(self.folder / "plan.1.brick", self.folder / "plan.2.brick")  # it has another number
        self.check(1, "bricks", "run", "plan.json", 2, says="plan.2.brick belongs to another plan")
        self.assertNotIn("m.ply", self.names())

    def test_from_any_folder(self):
        """A plan finds its files from its own folder, wherever it is used and wherever both are moved."""
        (self.folder / "g").write_text("first /1/A/151-180\n")
        (self.folder / "deep").mkdir()
        self.check(0, "bricks", "plan", "dimer.cif.gz", "-o", "deep/plan.json", "--bricks", 2, "--groups", "g",
                   "--color", "group", *FAST, *STEPS)
        moved = self.folder / "moved"
        moved.mkdir()
        for name in ("dimer.cif.gz", "g", "deep"):
            (self.folder / name).rename(moved / name)
        for k in (1, 2):
            self.check(0, "bricks", "run", "moved/deep/plan.json", k)
        self.run_tool("bricks", "merge", moved / "deep" / "plan.json", "-o", "m.ply")
        self.assertIn("m.ply", self.names())

    def test_the_files_of_options_are_part_of_a_plan(self):
        """They are found from it, and with other ones it is another plan."""
        table = self.folder / "t.csv"
        values = "".join(f"A {n} {n}\n" for n in range(151, 220))
        table.write_text(values)
        (self.folder / "bondi").write_text("no radii")
        (self.folder / "deep").mkdir()
        words = ["bricks", "plan", self.input, "-o", "deep/plan.json", "--bricks", 2, "--color", "table=t.csv",
                 "--radii", "bondi", *FAST, *STEPS]
        self.check(0, *words)
        plan = self.report("deep/plan.json")
        self.assertEqual(plan["options"]["color"], ["table=../t.csv"])
        self.assertEqual(plan["options"]["radii"], ["bondi"])
        self.assertIn({"path": "../t.csv", "sha256": hashlib.sha256(values.encode()).hexdigest(), "bytes": len(values)},
                      plan["files"])
        for k in (1, 2):
            self.check(0, "bricks", "run", "plan.json", k, cwd=self.folder / "deep")
        self.check(0, "bricks", "merge", "deep/plan.json", "-o", "m.vdb", "-o", "m.ply")
        self.assertIn(hashlib.sha256(values.encode()).hexdigest(), self.check(0, "info", "m.vdb").stdout.decode())
        table.write_text(values.replace("A 151 151", "A 151 15"))
        self.check(1, "bricks", "merge", "deep/plan.json", "-o", "n.ply", says="t.csv has changed")
        self.check(0, *words, "--force")
        self.check(1, "bricks", "merge", "deep/plan.json", "-o", "n.ply", says="belongs to another plan")

    def test_a_file_without_a_hash_is_refused(self):
        (self.folder / "t.csv").write_text("A 151 1\n")
        plan = self.plan(2, "--color", "table=t.csv")
        plan["files"] = [file for file in plan["files"] if file["path"] != "t.csv"]
        (self.folder / "plan.json").write_text(json.dumps(plan))
        self.check(1, "bricks", "run", "plan.json", 1, says="no hash of t.csv")

    def test_the_files_of_a_plan_are_never_replaced(self):
        (self.folder / "t.ply").write_text("A 151 1\n")
        plan = self.plan(2, "--color", "table=t.ply")
        self.bricks(plan)
        self.check(1, "bricks", "merge", "plan.json", "--force", "-o", "t.ply", says="which is read")
        (self.folder / "p.json").write_text("A 151 1\n")
        self.check(1, "bricks", "plan", "dimer.cif.gz", "--force", "-o", "p.json", "--bricks", 2, "--color",
                   "table=p.json", says="which is read")

    def test_bricks_need_the_plan_and_its_atoms_alone(self):
        self.bricks(self.plan(2))
        whole = {k: (self.folder / f"plan.{k}.brick").read_bytes() for k in (1, 2)}
        (self.folder / "node").mkdir()
        for name in ("plan.json", "plan.atoms"):
            shutil.copy(self.folder / name, self.folder / "node" / name)
        self.check(0, "bricks", "run", "node/plan.json", 2)
        self.assertEqual(self.facts(whole[2]), self.facts((self.folder / "node" / "plan.2.brick").read_bytes()))
        self.input.unlink()
        self.check(0, "bricks", "run", "plan.json", 1, "--force")
        self.check(1, "bricks", "merge", "plan.json", "-o", "m.ply", says="cannot find dimer.cif.gz")
        (self.folder / "plan.atoms").unlink()
        self.check(1, "bricks", "run", "plan.json", 1, "--force", says="it has to lie beside the plan")

    @staticmethod
    def facts(data):
        """What is in a brick but for the seconds that it took."""
        begin, size = struct.unpack_from("<QQ", data, 8)
        header = json.loads(data[begin:begin + size])
        header.pop("seconds", None)
        return data[HEAD:begin], {key: value for key, value in header.items() if key != "sums"}

    def test_atoms_of_another_plan_are_refused(self):
        self.plan(2)
        shutil.copy(self.folder / "plan.atoms", self.folder / "kept")
        self.plan(2, "--force", "--no-hydrogens", "--waters")
        shutil.copy(self.folder / "kept", self.folder / "plan.atoms")
        self.check(1, "bricks", "run", "plan.json", 1, says="plan.atoms belongs to another plan")
        data = bytearray((self.folder / "kept").read_bytes())
        data[100] ^= 1
        self.plan(2, "--force")
        (self.folder / "plan.atoms").write_bytes(data)
        self.check(1, "bricks", "run", "plan.json", 1, says="its checksum is another")

    def test_fewer_bricks_than_asked_for_are_told(self):
        self.check(0, "bricks", "plan", "dimer.cif.gz", "-o", "plan.json", "--bricks", 500, *FAST, *STEPS,
                   says="fewer bricks than asked for")

    def test_a_changed_input_is_refused(self):
        self.plan(2)
        shutil.copy(DATA / "1a8o.pdb.gz", self.input)
        self.check(1, "bricks", "run", "plan.json", 1, says="has changed since the plan was made")
        self.check(1, "bricks", "merge", "plan.json", "-o", "m.ply", says="has changed since the plan was made")

    def test_steps(self):
        self.run_tool(CRAMBIN, *FAST, "--steps", "3", "-o", "s.json")
        self.assertEqual(self.report("s.json")["evolution"]["steps"], 3)
        self.assertEqual(len(self.report("s.json")["evolution"]["energy"]), 4)
        self.check(2, CRAMBIN, "--steps", "3", "--max-steps", "4", "-o", "t.json",
                   says="--steps and --max-steps together")

    def test_wrong_calls(self):
        self.plan(2)
        self.check(2, "bricks", "run", "plan.json", 3, says="from 1 to 2, got 3")
        self.check(2, "bricks", "run", "plan.json", "x", says="got 'x'")
        self.check(2, "bricks", "run", "plan.json", says="expected a plan and the number")
        self.check(1, "bricks", "run", "dimer.cif.gz", 1, says="is no plan")
        self.check(2, "bricks", "plan", "dimer.cif.gz", "-o", "p.json", says="either --bricks N or --memory")
        self.check(2, "bricks", "plan", "dimer.cif.gz", "-o", "p.vdb", "--bricks", 2, says=".json")
        self.check(2, "bricks", "plan", "dimer.cif.gz", "-o", "p.json", "--bricks", 2, "--fill-cavities",
                   says="--fill-cavities is for build")
        self.check(1, "bricks", "merge", "plan.json", "-o", "plan.json", "--force", says="which is read")
        self.check(2, "bricks", "merge", "plan.json", "-o", "m.stl", says="merge writes .vdb, .ply or .json")
        self.check(2, "bricks", "merge", "plan.json", "--voxel", 1, "-o", "m.ply", says="--voxel is for build")
        self.check(2, CRAMBIN, "-o", "m.ply", "--memory", "lots", says="expected a size")


class Memory(ToolTest):
    def dry(self, *words):
        return self.check(0, CRAMBIN, "--dry-run", *words).stderr.decode()

    def too_little_for(self, *words):
        """Bytes that the whole does not fit into with its margin, and bricks of it do."""
        said = self.check(0, *words, "--dry-run").stderr.decode()
        return int(1.08 * size_of(said))

    def test_dry_run(self):
        text = self.dry(*FAST)
        self.assertRegex(text, r"327 atoms, 1 brick, about \S+ voxels, \S+ MiB of memory at most, "
                               r"\S+ s on one core")
        self.assertEqual(self.names(), [])

    def test_a_small_molecule_is_done_in_one_piece(self):
        done = self.check(0, CRAMBIN, *FAST, "--memory", "4G", "-o", "a.ply")
        self.assertEqual(done.stderr.count(b"used"), 1)
        self.check(0, CRAMBIN, *FAST, "-o", "b.ply")
        self.assertEqual(*((self.folder / name).read_bytes() for name in ("a.ply", "b.ply")))

    def test_standard_input_is_read_once(self):
        self.check(0, "-", *FAST, "--memory", "4G", "-o", "a.ply", input=CRAMBIN.read_bytes())

    def test_too_little(self):
        self.check(1, CRAMBIN, *FAST, "--memory", "20M", "-o", "a.ply", says="[hint: --memory")
        self.assertEqual(self.names(), [])

    def test_what_reading_takes_is_refused_before(self):
        """The text and the atoms of an assembly, by plan as by a build; a plan without labels does not unfold them."""
        (self.folder / "many.xyzr").write_text("".join(f"{n % 400} {n // 400} {n % 7} 1.7\n" for n in range(100000)))
        for words in (["many.xyzr"], ["bricks", "plan", "many.xyzr"]):
            self.check(1, *words, "--memory", "26M", "-o", "a.json", says="many.xyzr: reading it takes about")
            self.check(1, *words[:-1], DATA / "1a8o.cif.gz", "--assembly", 1, "--color", "element", "--memory", "15M",
                       "-o", "a.json", says=("its atoms take about", "[hint: --memory"))
        self.assertEqual(self.names(), ["many.xyzr"])

    def test_in_bricks(self):
        """A limit below the need of the whole: bricks, which are not left behind."""
        words = [DATA / "4at1.ent.gz", "--voxel", "0.5", *STEPS, "-q"]
        self.run_tool(*words, "-o", "w.ply")
        limit = self.too_little_for(*words[:-1])
        done = self.run_tool(*words, "--memory", limit, "-o", "m.ply", "-o", "m.vdb", "-o", "m.json")
        self.assertIn(done.returncode, (0, 3), done.stderr)
        self.assertEqual(self.names(), ["m.json", "m.ply", "m.vdb", "w.ply"])
        whole = read_ply((self.folder / "w.ply").read_bytes())
        merged = read_ply((self.folder / "m.ply").read_bytes())
        self.assertEqual(sorted(whole[1]), sorted(merged[1]))
        self.assertEqual(len(whole[2]), len(merged[2]))
        report = json.loads((self.folder / "m.json").read_text())
        self.assertLess(report["peak_memory_bytes"], limit)
        self.run_tool(*words, "--memory", limit, "-o", "n.json")  # keeps no mesh on disk
        self.assertEqual(json.loads((self.folder / "n.json").read_text())["surface"], report["surface"])

    def test_the_boundary_of_balls_keeps_to_the_limit(self):
        words = [DATA / "4at1.ent.gz", "--voxel", "0.5", "--surface", "ses"]
        limit = self.too_little_for(*words)
        self.check(0, *words, "-q", "--memory", limit, "-o", "s.json")
        report = json.loads((self.folder / "s.json").read_text())
        self.assertLess(report["peak_memory_bytes"], limit)
        # The mesh may bridge what is narrower than a voxel.
        self.assertIsInstance(report["surface"]["mesh_euler_characteristic"], int)
        for name in ("euler_characteristic", "components", "cavities"):
            self.assertIsNone(report["surface"][name], name)

    def test_an_interrupt_leaves_nothing(self):
        self.stop(signal.SIGINT, 130)
        self.assertEqual(self.names(), [])

    def test_the_bricks_of_a_killed_run_go_with_the_next(self):
        self.stop(signal.SIGKILL, -signal.SIGKILL)
        self.assertEqual(len(self.names()), 1)
        self.check(1, "none.pdb", "-o", "m.ply")
        self.assertEqual(self.names(), [])

    def stop(self, number, status):
        """Stops a run that has begun with its bricks."""
        words = [DATA / "4at1.ent.gz", "--voxel", "0.5"]
        words = [TOOL, *words, "--memory", str(self.too_little_for(*words)), "-o", "m.ply"]
        process = subprocess.Popen(words, cwd=self.folder, stderr=subprocess.DEVNULL)
        deadline = time.time() + 60
        while not any(name.startswith(".bricks.") for name in self.names()):
            self.assertIsNone(process.poll(), "it ended before there was a brick")
            self.assertLess(time.time(), deadline)
            time.sleep(0.02)
        process.send_signal(number)
        self.assertEqual(process.wait(timeout=60), status)


class Hostile(ToolTest):
    """Bricks and plans of somebody who makes the checksums right: they are refused soon, and take little memory."""

    LITTLE, ENDS = 100e6, 20.0  # bytes; seconds of all processors

    def setUp(self):
        super().setUp()
        shutil.copy(CRAMBIN, self.folder / "a.pdb")
        self.check(0, "bricks", "plan", "a.pdb", "-o", "plan.json", "--bricks", 2, "--voxel", 0.5, *STEPS)
        for k in (1, 2):
            self.check(0, "bricks", "run", "plan.json", k, "-q")
        self.body, self.header = self.load(1)
        self.assertEqual(self.refuse(), "", "a good one is written as it was")

    def load(self, number):
        data = (self.folder / f"plan.{number}.brick").read_bytes()
        begin, size = struct.unpack_from("<QQ", data, 8)
        return data[HEAD:begin], json.loads(data[begin:begin + size])

    def store(self, number, body, header):
        text = json.dumps(header).encode()
        head = struct.pack("<QQQ", HEAD + len(body), len(text), zlib.crc32(body + text))
        (self.folder / f"plan.{number}.brick").write_bytes(b"MOLBRK05" + head + body + text)

    def refuse(self):
        """Writes the first brick as it is now, and merges. Returns the error."""
        self.store(1, self.body, self.header)
        child = subprocess.Popen([TOOL, "bricks", "merge", "plan.json", "--force", "-q", "-o", "m.vdb", "-o", "m.ply",
                                  "-o", "m.json"], cwd=self.folder, stderr=subprocess.PIPE)
        error = child.stderr.read().decode()
        child.stderr.close()
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
        self.assertEqual(child.returncode, 1 if error else 0, error)
        self.assertLessEqual(error.count("\n"), 1, error)
        if not any(name in TOOL for name in ("build-fuzz", "build-asan", "build-tsan", "build-coverage")):
            self.assertLess(usage.ru_maxrss * 1024, self.LITTLE)
            self.assertLess(usage.ru_utime + usage.ru_stime, self.ENDS)
        return error

    def insert(self, at, data):
        """Puts bytes into the body; what the header has behind them moves."""
        self.body = self.body[:at - HEAD] + data + self.body[at - HEAD:]

        def moved(entry):
            if isinstance(entry, dict):
                return {key: moved(value) for key, value in entry.items()}
            if isinstance(entry, list) and len(entry) == 2 and all(isinstance(x, int) for x in entry):
                return [entry[0] + len(data) if entry[0] >= at else entry[0], entry[1]]
            return [moved(value) for value in entry] if isinstance(entry, list) else entry

        self.header = moved(self.header)

    def leaves(self):
        """(offset of the leaves' records, their number, a record, its values)."""
        offset, count = self.header["grids"][0]["leaves"]
        record = self.body[offset - HEAD:offset - HEAD + LEAF.size]
        x, y, z, negative, at, size, *mask = LEAF.unpack(record)
        return offset, count, (negative, mask), self.body[at - HEAD:at - HEAD + size]

    def add_leaves(self, places):
        """Adds copies of the first leaf, as far as a plan of the whole space takes them."""
        offset, count, (negative, mask), values = self.leaves()
        self.insert(offset, values * len(places))
        records = b"".join(LEAF.pack(*place, negative, offset + i * len(values), len(values), *mask)
                           for i, place in enumerate(places))
        self.insert(offset + len(values) * len(places) + count * LEAF.size, records)
        self.header["grids"][0]["leaves"] = [offset + len(values) * len(places), count + len(places)]

    def widen(self):
        """Makes the first box of the plan that of the whole space, and both bricks those of this plan."""
        plan = json.loads((self.folder / "plan.json").read_text())
        plan["bricks"][0].update(min=[-(1 << 26)] * 3, max=[(1 << 26) - 1] * 3)
        (self.folder / "plan.json").write_text(json.dumps(plan))
        body, header = self.load(2)
        name = hashlib.sha256((self.folder / "plan.json").read_bytes()).hexdigest()
        self.header["plan"] = header["plan"] = name
        self.store(2, body, header)

    def test_leaves_far_from_each_other(self):
        self.add_leaves([(x << 13, y << 13, 0) for x in range(1, 31) for y in range(1, 31)])
        self.assertIn("has a leaf far away", self.refuse())
        self.widen()
        self.assertIn("too far from each other", self.refuse())

    def test_leaves_with_the_same_values(self):
        """A file of 0.4 MB, whose leaves all have the same megabyte."""
        offset, count, _, _ = self.leaves()
        for i in range(count):
            at = offset - HEAD + i * LEAF.size
            x, y, z, negative, _, _, *mask = LEAF.unpack(self.body[at:at + LEAF.size])
            record = LEAF.pack(x, y, z, negative, HEAD, offset - HEAD, *mask)
            self.body = self.body[:at] + record + self.body[at + LEAF.size:]
        self.assertIn("whose values lie elsewhere", self.refuse())

    def test_grids_with_the_same_leaves(self):
        grid = self.header["grids"][0]
        self.header["grids"] += [dict(grid, name=f"g{i}") for i in range(2000)]
        self.assertIn("leaves lie outside", self.refuse())

    def test_values_that_are_none(self):
        offset, *_ = self.leaves()
        self.body = b"\x07" * (offset - HEAD) + self.body[offset - HEAD:]
        self.assertIn("not those of their leaf", self.refuse())

    def test_a_residual_that_is_no_length(self):
        for residual in (1e300, -1.0):
            self.header["max_residual"] = residual
            self.assertIn("its residual is no length", self.refuse())

    def test_half_of_the_triangles(self):
        offset, count = self.header["triangles"]
        cut = 12 * (count // 2)
        self.body = self.body[:offset - HEAD + 12 * count - cut] + self.body[offset - HEAD + 12 * count:]
        self.header["triangles"][1] -= count // 2
        for name in ("areas", "curvatures", "border", "open_edges", "pieces"):
            self.header[name][0] -= cut
        self.assertRegex(self.refuse(), "pieces|holes|open edges|no triangle")

    def test_counts_that_are_none(self):
        for name, value in (("degenerate_triangles", 1e300), ("kink_vertices", -1), ("brick", 1.5),
                            ("triangles", [0, 1 << 60])):
            before, self.header[name] = self.header[name], value
            self.assertRegex(self.refuse(), "numbers are none|holds no mesh|lie elsewhere")
            self.header[name] = before
        self.header["displacements"]["bins"][3] = 1e300
        self.assertIn("numbers are none", self.refuse())

    def test_vertices_that_share_their_keys(self):
        """Tables by key stay fast whatever the keys are."""
        offset, count = self.header["border"]
        record = self.body[offset - HEAD:offset - HEAD + 24]
        many = 300000
        self.insert(offset + 24 * count, record * many)
        self.header["border"][1] += many
        self.refuse()

    def test_atoms_without_a_column(self):
        """Headers that leave out a column which the rest of them asks for, with the right SHA-256."""
        self.check(0, "bricks", "plan", "a.pdb", "-o", "c.json", "--bricks", 2, "--voxel", 1, "--color", "bfactor", "--group-by", "chain", *STEPS)
        plan, data = (self.folder / "c.json").read_text(), (self.folder / "c.atoms").read_bytes()
        _, cells, size = struct.unpack("<QQQ", data[-32:-8])
        begin = len(data) - 32 - size
        header = json.loads(data[begin:-32])
        for column in ("chain", "group", "element", "class", "value"):
            self.assertIn(column, header["columns"])
            rest = [name for name in header["columns"] if name != column]
            text = json.dumps({**header, "columns": rest}, separators=(",", ":"), ensure_ascii=False).encode()
            changed = data[:begin] + text + data[-32:-16] + struct.pack("<Q", len(text)) + data[-8:]
            (self.folder / "c.atoms").write_bytes(changed)
            (self.folder / "c.json").write_text(plan.replace(hashlib.sha256(data[begin - cells:]).hexdigest(),
                                                             hashlib.sha256(changed[begin - cells:]).hexdigest()))
            self.check(1, "bricks", "run", "c.json", 1, says=f"c.atoms: is no file of the atoms of a plan: its header lacks the column {column}")

    def test_plans(self):
        good = json.loads((self.folder / "plan.json").read_text())
        brick = good["bricks"][0]
        for change in ({"bricks": []}, {"bricks": [dict(brick, min=[1e300, 0, 0])]}, {"steps": 1e300},
                       {"bricks": [dict(brick, max=[(1 << 31) - 1] * 3)]}, {"atoms": -1},
                       {"files": good["files"] + [{"path": "/dev/zero", "sha256": ""}]},
                       {"input": "/dev/zero"}, {"anchor": [1 << 40, 0, 0]}):
            (self.folder / "plan.json").write_text(json.dumps({**good, **change}))
            self.assertNotEqual(self.refuse(), "", change)


if __name__ == "__main__":
    unittest.main()
