# SPDX-License-Identifier: MPL-2.0
"""The add-on of Blender makes meshes, volumes, copies and frames, in Blender and in the module bpy."""

import json
import os
import subprocess
import unittest
import zipfile

from needs import BPY_PYTHON, needs
from tool import CRAMBIN, DATA, ROOT, TOOL, ToolTest, read_ply

ADDON = ROOT / "scripts" / "blender"
SCRIPT = ROOT / "tests" / "cli" / "blender_addon.py"
DIMER = DATA / "1a8o.cif.gz"
NMR = DATA / "1d3z.pdb.gz"


class Packed(ToolTest):
    def test_zip_has_the_folder(self):
        subprocess.run([ADDON / "make_addon.sh", self.folder / "a.zip"], check=True, capture_output=True)
        with zipfile.ZipFile(self.folder / "a.zip") as file:
            self.assertEqual(file.namelist(), ["molsurf_addon/__init__.py"])
            self.assertIn(b"bl_info", file.read("molsurf_addon/__init__.py"))


class Addon:
    def run_in(self, *words):
        done = subprocess.run([*map(str, words), "--", str(ADDON), str(CRAMBIN), str(DIMER), str(NMR)], cwd=self.folder,
                              capture_output=True, text=True, timeout=500, env={**os.environ, "VDB_MOLSURF": TOOL})
        lines = [line for line in done.stdout.splitlines() if line.startswith("RESULT ")]
        self.assertEqual(len(lines), 1, done.stdout + done.stderr)
        return json.loads(lines[0][len("RESULT "):])

    def test_all(self):
        result = self.run_in(*self.program)
        self.assertLessEqual({"voxel", "surface", "probe", "radii", "fill-cavities", "select"}, set(result["options"]))
        self.assertNotIn("output", result["options"])
        words = ["--surface", "ses", "--voxel", "1"]
        self.check(0, CRAMBIN, *words, "--color", "element", "-o", "a.ply", "-o", "a.json")
        names, vertices, faces = read_ply((self.folder / "a.ply").read_bytes())
        mesh = result["mesh"]
        self.assertEqual((mesh["vertices"], mesh["faces"]), (len(vertices), len(faces)))
        for a in range(3):  # a unit is a nanometre
            self.assertAlmostEqual(mesh["first"][a], 0.1 * vertices[0][a], places=5)
        self.assertEqual(mesh["atoms"], [v[names.index("atom_id")] for v in vertices[:100]])
        self.assertLessEqual({"mean_curvature", "gaussian_curvature", "atom_id", "Cd"}, set(mesh["attributes"]))
        area = json.loads((self.folder / "a.json").read_text())["surface"]["area"]
        self.assertAlmostEqual(100 * mesh["area"] / area, 1.0, delta=0.05)  # of flat triangles
        self.assertLessEqual({"surface", "density"}, set(result["volume"]["grids"]))
        for x in result["volume"]["origin"]:  # until Blender 5.0 a voxel is shown half a voxel farther
            self.assertAlmostEqual(x, -0.05 if result["version"] < 5 else 0.0)
        self.check(0, DIMER, *words, "--assembly", "1", "--instances", "-o", "c.json", "-o", "c.ply")
        instances = json.loads((self.folder / "c.json").read_text())["instances"]
        copies = result["copies"]
        self.assertEqual((copies["count"], copies["meshes"]), (len(instances) + 1, 1))
        for found, instance in zip(copies["matrices"], instances):
            for row, expected in zip(found[:3], instance["matrix"]):
                for a in range(4):
                    self.assertAlmostEqual(row[a], expected[a] * (0.1 if a == 3 else 1.0), places=4)
        frames = result["frames"]
        self.assertEqual(len({name for name, _ in frames[:3]}), 3)
        self.assertEqual(frames[3], frames[2])  # after the last frame
        self.check(0, NMR, *words, "--frames", "1-5:2", "-o", "f.csv")
        for (_, found), row in zip(frames, self.table("f.csv")):
            self.assertAlmostEqual(100 * found / float(row["area"]), 1.0, delta=0.05)
        self.assertIn("--voxel: expected 0.05 to 10", result["error"])


@needs("bpy")
class InModule(Addon, ToolTest):
    program = [BPY_PYTHON, SCRIPT]


@needs("blender")
class InBlender(Addon, ToolTest):
    program = ["blender", "-b", "--factory-startup", "--python-exit-code", "1", "--python", SCRIPT]


if __name__ == "__main__":
    unittest.main()
