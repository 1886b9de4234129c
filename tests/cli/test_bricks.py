# SPDX-License-Identifier: MPL-2.0
"""bricks plan, run and merge; --memory and --dry-run."""

import collections
import hashlib
import json
import shutil
import signal
import subprocess
import time
import unittest

from tool import CRAMBIN, DATA, FAST, TOOL, ToolTest, read_ply

STEPS = ["--steps", "4"]


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
        for name in ("euler_characteristic", "components", "cavities", "vertices", "triangles",
                     "closed", "manifold", "degenerate_triangles", "kink_share", "gradient_share"):
            self.assertEqual(merged["surface"][name], whole["surface"][name], name)
        for name in ("area", "volume", "outer_area"):
            self.assertAlmostEqual(merged["surface"][name], whole["surface"][name], 5)
        self.assertEqual(merged["grid"]["active_voxels"], whole["grid"]["active_voxels"])
        self.assertEqual(merged["evolution"]["converged"], whole["evolution"]["converged"])
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
        self.assertIn({"path": "../t.csv", "sha256": hashlib.sha256(values.encode()).hexdigest()}, plan["files"])
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

    def test_a_missing_input_is_named(self):
        self.plan()
        self.input.unlink()
        self.check(1, "bricks", "run", "plan.json", 1, says="cannot find dimer.cif.gz")

    def test_fewer_bricks_than_asked_for_are_told(self):
        self.check(0, "bricks", "plan", "dimer.cif.gz", "-o", "plan.json", "--bricks", 500, *FAST, *STEPS,
                   says="fewer bricks than asked for")

    def test_a_changed_input_is_refused(self):
        self.plan(2)
        shutil.copy(DATA / "1a8o.pdb.gz", self.input)
        self.check(1, "bricks", "run", "plan.json", 1, says="has changed since the plan was made")

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
        """Bytes that the whole does not fit into, and bricks of it do."""
        said = self.check(0, *words, "--dry-run").stderr.decode()
        return int(0.9e9 * float(said.split(" GB")[0].split()[-1]))

    def test_dry_run(self):
        text = self.dry(*FAST)
        self.assertRegex(text, r"327 atoms, 1 brick, about \S+ voxels, \S+ GB of memory at most, "
                               r"\S+ s on one core")
        self.assertEqual(self.names(), [])

    def test_a_small_molecule_is_done_in_one_piece(self):
        done = self.check(0, CRAMBIN, *FAST, "--memory", "4G", "-o", "a.ply")
        self.assertEqual(done.stderr.count(b"atoms"), 1)
        self.check(0, CRAMBIN, *FAST, "-o", "b.ply")
        self.assertEqual(*((self.folder / name).read_bytes() for name in ("a.ply", "b.ply")))

    def test_standard_input_is_read_once(self):
        self.check(0, "-", *FAST, "--memory", "4G", "-o", "a.ply", input=CRAMBIN.read_bytes())

    def test_too_little(self):
        self.check(1, CRAMBIN, *FAST, "--memory", "20M", "-o", "a.ply", says="[hint: --memory")
        self.assertEqual(self.names(), [])

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
        self.assertLess(json.loads((self.folder / "s.json").read_text())["peak_memory_bytes"], limit)

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


if __name__ == "__main__":
    unittest.main()
