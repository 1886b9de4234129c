# SPDX-License-Identifier: MPL-2.0
"""The Snakemake workflow, on this machine; scripts/workflow/test_slurm.sh tests it on Slurm."""

import csv
import hashlib
import json
import os
import pathlib
import re
import resource
import shutil
import subprocess
import unittest

from needs import needs
from tool import CRAMBIN, DATA, ROOT, TOOL, ToolTest

WORKFLOW = ROOT / "scripts" / "workflow"


@needs("snakemake")
class Workflow(ToolTest):
    def setUp(self):
        super().setUp()
        (self.folder / "bin").mkdir()
        (self.folder / "bin" / "vdb_molsurf").symlink_to(pathlib.Path(TOOL).resolve())
        self.environment = {**os.environ, "PATH": f"{self.folder / 'bin'}:{os.environ['PATH']}",
                            "XDG_CACHE_HOME": str(self.folder / "cache")}

    def flow(self, status, *words, says=()):
        done = subprocess.run(["snakemake", *words[:1], "-s", WORKFLOW / "Snakefile", "--cores", "2", *words[1:]],
                              cwd=self.folder, env=self.environment, capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, status, done.stderr)
        for word in [says] if isinstance(says, str) else says:
            self.assertIn(word, done.stderr)

    def made(self):
        return {str(path.relative_to(self.folder)): path.stat().st_mtime_ns
                for kind in ("brick", "ply", "vdb", "json") for path in self.folder.glob(f"*/*.{kind}")
                if path.name != "summary.json"}

    def test_assembly(self):
        """A lost brick is done again, and no other; the result is the same."""
        words = ["assembly", "--config", f"input={DATA / '1a8o.cif.gz'}", "cut=--bricks 3",
                 "options=--assembly 1 --voxel 1 --steps 4"]
        self.flow(0, *words)
        self.assertEqual(sorted(self.made()),
                         ["assembly/1a8o.json", "assembly/1a8o.ply", "assembly/1a8o.vdb", "bricks/plan.1.brick",
                          "bricks/plan.2.brick", "bricks/plan.3.brick", "bricks/plan.json"])
        mesh = self.folder / "assembly" / "1a8o.ply"
        first, before = mesh.read_bytes(), self.made()
        (self.folder / "bricks" / "plan.2.brick").unlink()
        mesh.unlink()
        self.flow(0, *words)
        self.assertEqual(mesh.read_bytes(), first)
        again = {name for name, time in self.made().items() if before[name] != time}
        self.assertEqual({name for name in again if name.startswith("bricks")}, {"bricks/plan.2.brick"})

    def test_other_options_after_a_failure(self):
        """What was made with other options is never taken for the result."""
        for voxel, more, status in ((1.5, "", 0), (2, " --split chain", 1), (2, "", 0), (1.5, "", 0)):
            self.flow(status, "assembly", "--config", f"input={CRAMBIN}", "cut=--bricks 2",
                      f"options=--steps 2 --voxel {voxel}{more}")
            if status == 0:
                made = json.loads((self.folder / "assembly" / "1crn.json").read_text())
                self.assertEqual(made["voxel"], voxel)

    def batch(self, status, *words, says=()):
        self.flow(status, "batch", "--keep-going", "--config", "options=--voxel 1", "formats=[ply]", *words,
                  says=says)

    def table(self):
        with open(self.folder / "batch" / "summary.csv", newline="") as file:
            return {pathlib.Path(row["input"]).name: row for row in csv.DictReader(file)}

    def test_batch(self):
        """What fails is reported, stops nothing, and is what the next run does."""
        folder = self.folder / "structures"
        folder.mkdir()
        for name in ("1crn.pdb", "1a8o.pdb.gz", "README.md"):
            shutil.copy(DATA / name, folder)
        (folder / "a broken one.pdb").write_text("not a structure\n")
        self.batch(1, says="3 structures, 1 failed")
        table = self.table()
        self.assertEqual({name: row["status"] for name, row in table.items()},
                         {"1crn.pdb": "done", "1a8o.pdb.gz": "done", "a broken one.pdb": "failed"})
        self.assertEqual(table["1crn.pdb"]["atoms"], "327")
        self.assertEqual(table["1crn.pdb"]["sha256"], hashlib.sha256(CRAMBIN.read_bytes()).hexdigest())
        self.assertEqual([len(table["1crn.pdb"][name]) for name in ("options", "version")], [64, 5])
        self.assertIn("no atoms", table["a broken one.pdb"]["message"])
        before = self.made()
        self.assertEqual(sorted(before), sorted(f"batch/{name}.{kind}" for name in ("1crn", "1a8o")
                                                for kind in ("ply", "json")))

        (folder / "a broken one.pdb").write_bytes(CRAMBIN.read_bytes())
        self.batch(0, says="3 structures, 0 failed")
        self.assertEqual({row["status"] for row in self.table().values()}, {"done"})
        self.assertEqual({name: self.made()[name] for name in before}, before)

    def test_shards(self):
        """Several structures are one job; what is done stays when the job is run again, but not with other options."""
        folder = self.folder / "structures"
        folder.mkdir()
        for k in range(16):
            (folder / f"{k:02}.xyzr").write_text(f"{k} 0 0 1.7\n0 {k} 0 1.5\n")
        (folder / "03.xyzr").write_text("nothing\n")
        self.batch(1, "options=--surface sas --voxel 1", says=["16 structures, 1 failed", "status 1: batch/shard.1.log"])
        self.assertEqual(len(list((self.folder / "batch").glob("shard.*.done"))), 7)
        before = self.made()
        (folder / "03.xyzr").write_text("0 0 0 2\n")
        self.batch(0, "options=--surface sas --voxel 1", says="16 structures, 0 failed")
        self.assertEqual({name for name, time in self.made().items() if before.get(name) != time},
                         {"batch/03.ply", "batch/03.json"})
        self.batch(0, "options=--surface sas --voxel 1.5", says="16 structures, 0 failed")
        self.assertEqual({json.loads(path.read_text())["voxel"] for path in (self.folder / "batch").glob("[0-9]*.json")}, {1.5})

    def test_names_with_braces(self):
        folder = self.folder / "structures"
        folder.mkdir()
        shutil.copy(CRAMBIN, folder / "brace{x}.pdb")
        self.batch(0, says="1 structures, 0 failed")
        self.assertIn("batch/brace{x}.ply", self.made())
        before = self.made()
        self.batch(0)
        self.assertEqual(self.made(), before)
        shutil.copy(DATA / "1ubq.pdb", folder / "brace{x}.pdb")
        self.batch(0)
        self.assertNotEqual(self.made(), before)

    def test_many_structures_are_listed_once(self):
        folder = self.folder / "structures"
        folder.mkdir()
        for k in range(5000):
            (folder / f"{k}.xyzr").touch()
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        self.batch(0, "--dry-run", "--quiet")
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        self.assertLess(after.ru_utime - before.ru_utime, 30)  # 2 seconds; 100 if each lists the folder again

    def test_not_converged_is_no_failure(self):
        self.batch(0, f"structures={CRAMBIN}", "options=--voxel 1 --flow newton --max-steps 1")
        self.assertEqual(self.table()["1crn.pdb"]["status"], "not converged")

    def test_nothing_to_do_is_a_mistake(self):
        self.batch(1, "structures=none/*", says="no structure files match none/*")
        self.batch(1, f"structures={DATA}/1a8o*", says="would have files of one name")

    def test_verbs_of_the_test_on_slurm(self):
        """test_slurm.sh looks for processes by their words, and nightly.sh runs all of it."""
        script = (WORKFLOW / "test_slurm.sh").read_text()
        words = re.search(r'== \*" (.*) bricks/plan.json \$2 "\*', script)[1]
        self.assertIn(f"{{config[tool]}} {words} {{input.plan}} {{wildcards.number}}", (WORKFLOW / "Snakefile").read_text())
        self.assertIn(f'"$tool" {words} "$work/alone', script)
        for name in ("config.yaml", "config.v8+.yaml"):
            self.assertIn("status.sh", (WORKFLOW / "slurm" / name).read_text())

    def test_commands_of_the_guide(self):
        """Those of docs/pipelines.md, but for the ones that need Slurm."""
        page = (ROOT / "docs" / "pipelines.md").read_text()
        commands = re.findall(r"^```bash\n(.*?)^```$", page, re.MULTILINE | re.DOTALL)
        commands = [block for block in commands if "snakemake" in block and "slurm" not in block]
        self.assertEqual(len(commands), 1)
        for name in ("tests", "scripts"):
            (self.folder / name).symlink_to(ROOT / name)
        for block in commands:
            done = subprocess.run(["bash", "-e", "-c", block], cwd=self.folder, env=self.environment,
                                  capture_output=True, text=True, timeout=300)
            self.assertEqual(done.returncode, 0, done.stderr)
        for name in ("assembly/1a8o.vdb", "batch/summary.csv", "batch/1ubq.ply"):
            self.assertGreater((self.folder / name).stat().st_size, 0, name)


@needs("slurm")
class OnSlurm(ToolTest):
    def test_bricks(self):
        """The first half of the test that nightly.sh runs whole."""
        build = pathlib.Path(TOOL).resolve().parents[1]
        done = subprocess.run([WORKFLOW / "test_slurm.sh", "--first", DATA / "1a8o.cif.gz", "--voxel 0.5"], capture_output=True,
                              text=True, timeout=500, env={**os.environ, "BUILD": str(build), "XDG_CACHE_HOME": str(self.folder)})
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("8 bricks computed and merged; jobs: 10 JobState=COMPLETED", done.stdout)


if __name__ == "__main__":
    unittest.main()
