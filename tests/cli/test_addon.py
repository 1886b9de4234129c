# SPDX-License-Identifier: MPL-2.0
"""The add-on of Blender makes meshes, volumes, copies and frames, in Blender and in the module bpy."""

import json
import os
import pathlib
import re
import subprocess
import tomllib
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
            self.assertEqual(sorted(file.namelist()), ["molsurf_addon/__init__.py", "molsurf_addon/blender_manifest.toml"])
            self.assertIn(b"bl_info", file.read("molsurf_addon/__init__.py"))
            manifest = tomllib.loads(file.read("molsurf_addon/blender_manifest.toml").decode())
        self.assertEqual((manifest["schema_version"], manifest["id"], manifest["type"]), ("1.0.0", "molsurf_addon", "add-on"))
        self.assertRegex((ROOT / "CMakeLists.txt").read_text(), rf"VERSION {re.escape(manifest['version'])}\b")


class Addon:
    def addon(self):
        """What Blender gets of it: its folder, or a .zip."""
        return ADDON

    def run_in(self, *words):
        done = subprocess.run([*map(str, words), "--", str(self.addon()), str(CRAMBIN), str(DIMER), str(NMR)], cwd=self.folder,
                              capture_output=True, text=True, timeout=500, env={**os.environ, "VDB_MOLSURF": TOOL, "BLENDER_USER_RESOURCES": str(self.folder)})
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
        points = result["points"]
        self.assertEqual(points["vertices"], mesh["vertices"])
        self.assertEqual([round(x, 4) for x in points["location"]], [1.0, 2.0, 3.0])
        for a in range(3):
            self.assertAlmostEqual(points["first"][a], 0.01 * vertices[0][a], places=5)
        self.assertLess(points["farthest"], 3.5)  # ses: no farther than a radius and a probe
        self.assertLess(result["dry"]["farthest"], 3.5)
        self.assertGreaterEqual(round(result["dry"]["least"]), 40)
        self.assertIn("expected points with atomic_number or vdw_radii", result["no atoms"])
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


@needs("bpy")
class AsExtension(Addon, ToolTest):
    """Of Blender 4.2 and later: Blender's own command takes it, and an installed one works."""
    program = [BPY_PYTHON, SCRIPT]

    def setUp(self):
        super().setUp()
        done = subprocess.run([BPY_PYTHON, "-c", "import bpy; print(bpy.app.version >= (4, 2, 0), bpy.utils.resource_path('LOCAL'))"],
                              capture_output=True, text=True, check=True)
        modern, path = done.stdout.split()[-2:]
        if modern != "True":
            self.skipTest("Blender before 4.2 has no extensions")
        self.command = pathlib.Path(path) / "scripts" / "addons_core" / "bl_pkg" / "cli" / "blender_ext.py"

    def addon(self):
        to = self.folder / "a.zip"
        subprocess.run([ADDON / "make_addon.sh", to], check=True, capture_output=True)
        return to

    def test_blender_takes_it(self):
        source = ADDON / "molsurf_addon"
        built = self.folder / "built.zip"
        subprocess.run([BPY_PYTHON, self.command, "build", "--source-dir", source, "--output-filepath", built], check=True,
                       capture_output=True)
        for path in (source, built, self.addon()):
            done = subprocess.run([BPY_PYTHON, self.command, "validate", path], capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


@needs("blender")
class InBlender(Addon, ToolTest):
    program = ["blender", "-b", "--factory-startup", "--python-exit-code", "1", "--python", SCRIPT]


if __name__ == "__main__":
    unittest.main()
