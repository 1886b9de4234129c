# SPDX-License-Identifier: MPL-2.0
"""What --for blender writes lies in Blender where the mesh of the same run lies, and importers find all of it; in
Blender and in the module bpy."""

import json
import os
import pathlib
import subprocess
import unittest

from needs import BPY_PYTHON, needs
from test_instances import placed
from tool import CRAMBIN, DATA, FAST, ROOT, ToolTest, read_ply, read_png

HERE = pathlib.Path(__file__).resolve().parent
SCRIPT = ROOT / "scripts" / "blender" / "open_in_blender.py"
DIMER = [DATA / "1a8o.cif.gz", "--assembly", "1"]
VOXEL = 0.5
SCALES = {"angstrom": ("", 1), "old": ("=mn-0.01", 0.01), "new": ("=mn-0.1", 0.1),
          "nm": ("=nm", 0.1), "number": ("=0.37", 0.37)}


def volume_and_centroid(path):
    _, vertices, triangles = read_ply(path.read_bytes())
    volume, moment = 0.0, [0.0] * 3
    for corners in triangles:
        (ax, ay, az), (bx, by, bz), (cx, cy, cz) = (vertices[i][:3] for i in corners)
        part = (ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx)) / 6
        volume += part
        for i, total in enumerate((ax + bx + cx, ay + by + cy, az + bz + cz)):
            moment[i] += part * total / 4
    return volume, [m / volume for m in moment]


class Blender:
    def run_script(self, script, *words):
        path = f"/usr/bin:{os.environ['PATH']}"  # Debian's Blender has the modules of the first python3 there
        return subprocess.run([*self.program, str(script), "--", *map(str, words)], cwd=self.folder,
                              capture_output=True, text=True, timeout=500, env={**os.environ, "PATH": path})

    def blender(self, script, *words):
        done = self.run_script(script, *words)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout

    def result(self, script, *words):
        out = self.blender(HERE / script, *words)
        line, = [line for line in out.splitlines() if line.startswith("RESULT ")]
        return json.loads(line[len("RESULT "):])

    def assert_near(self, a, b, distance, what):
        for x, y in zip(a, b):
            self.assertLess(abs(x - y), distance, f"{what}: {a} and {b}")

    def test_surfaces_overlap(self):
        for name, (word, scale) in SCALES.items():
            more = ["-o", "a.ply"] if scale == 1 else []
            self.check(0, *DIMER, "--voxel", VOXEL, "--for", "blender" + word, "-o",
                       f"{name}.vdb", *more)
        volumes = []
        for frame in range(1, 11):
            name = f"frame.{frame:04}"
            self.check(0, CRAMBIN, "--voxel", 1, "--probe", 1 + frame / 20, "--for", "blender",
                       "-o", f"{name}.vdb", "-o", "frame.ply", "--force")
            volumes.append(volume_and_centroid(self.folder / "frame.ply")[0])
        result = self.result("blender_scenes.py", ",".join(f"{name}.vdb" for name in SCALES), "frame.0001.vdb")

        volume, centroid = volume_and_centroid(self.folder / "a.ply")
        for name, (_, scale) in SCALES.items():
            seen = result[f"{name}.vdb"]
            self.assertEqual(seen["grids"], {"surface": "FLOAT", "density": "FLOAT",
                                             "Cd": "VECTOR_FLOAT"}, name)
            self.assertEqual(seen["open_edges"], 0, name)
            # Positive: the faces look outward.
            self.assertLess(abs(seen["volume"] / scale ** 3 / volume - 1), 0.01, name)
            self.assert_near([c / scale for c in seen["centroid"]], centroid, 0.02 * VOXEL, name)

            placed = seen["placed"]
            self.assertEqual(placed["open_edges"], 0, name)
            self.assertLess(abs(placed["volume"] / (1.5 * scale) ** 3 / volume - 1), 0.01, name)
            where = [sum(m * scale * c for m, c in zip(row, centroid)) + row[3]
                     for row in placed["matrix"][:3]]
            # Turned, too. Blender samples such a grid anew: its centroids of level sets that agree to
            # 1e-5 Å are a third of this apart.
            self.assert_near([x / scale for x in placed["centroid"]], [x / scale for x in where],
                             3 ** 0.5 * 0.03 * 1.5 * VOXEL, f"{name} placed")

        # Two chains, their colours in linear light.
        if result["colored"]["colors"]:
            self.assertEqual(len(result["colored"]["colors"]), 2)

        sequence = result["sequence"]
        self.assertEqual((sequence["range"], sequence["duration"]), ([1, 10], 10))
        self.assertEqual([f["frame"] for f in sequence["frames"] if f["grids"] == 3],
                         list(range(1, 11)))
        for frame, expected in zip(sequence["frames"][1:], volumes):
            self.assertEqual(frame["open_edges"], 0)
            self.assertLess(abs(frame["volume"] / expected - 1), 0.01, frame)
        self.assertGreater(max(volumes) / min(volumes), 1.02, "frames that can be told apart")

    def test_picture(self):
        self.check(0, CRAMBIN, "--voxel", 1, "--for", "blender=mn-0.01", "-o", "a.vdb")
        for show in ("mesh", "volume"):
            self.blender(SCRIPT, "a.vdb", "--show", show, "--render", f"{show}.png", "--size", 64,
                         "--samples", 2)
            self.assertGreater((self.folder / f"{show}.png").stat().st_size, 2000, show)

    def test_picture_of_a_film(self):
        """Motion blur, and nothing else, changes what is rendered of a frame."""
        self.check(0, DATA / "1d3z.pdb.gz", *FAST, "--frames", "1-2", "--fields", "v", "--color", "element", "-o", "a.usda")
        seen = []
        for name, words in (("plain", ()), ("again", ()), ("blurred", ("--blur",))):
            done = self.run_script(SCRIPT, "a.usda", "--frame", 2, *words, "--render", f"{name}.png", "--size", 64, "--samples", 2)
            if "no importer of USD" in done.stdout + done.stderr:
                return
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            seen.append([v for row in read_png((self.folder / f"{name}.png").read_bytes())[1] for v in row])
        again, blurred = (sum(abs(a - b) for a, b in zip(seen[0], other)) / len(other) for other in seen[1:])
        self.assertLess(again, 0.2)  # of 255, since the denoiser's threads round in their own order
        self.assertGreater(blurred, 1.0)

    def test_missing_frame(self):
        for frame in (1, 2, 4):
            (self.folder / f"a.000{frame}.vdb").write_bytes(b"")
        done = self.run_script(SCRIPT, "a.0001.vdb")
        self.assertIn("frames are missing between 1 and 4", done.stdout + done.stderr)

    def test_importers(self):
        """Blender's importers, with all attributes where these have any place for them."""
        self.check(0, *DIMER, *FAST, "--color", "chain", "--for", "blender", "-o", "a.ply", "-o", "a.glb", "-o", "a.vdb")
        ply, glb, vdb = self.result("blender_import.py", "a.ply", "a.glb", "a.vdb")
        names, vertices, faces = read_ply((self.folder / "a.ply").read_bytes())
        for scene, prefix, upper in ((ply, "", False), (glb, "_", True)):
            mesh, = scene["meshes"]
            self.assertEqual((len(mesh["points"]), mesh["faces"]), (len(vertices), len(faces)))
            for p, v in zip(mesh["points"], vertices):
                self.assert_near(p, v[:3], 1e-4, "points")
            colors = [each for name, each in mesh["attributes"].items() if name.startswith("Col")]
            self.assertEqual(len({tuple(round(x, 2) for x in color) for color in colors[0]}), 2, "colours")
            for name in ("mean_curvature", "gaussian_curvature", "atom_id", "chain_id") if self.attributes else ():
                seen = mesh["attributes"][prefix + (name.upper() if upper else name)]
                for a, v in zip(seen, vertices, strict=True):
                    self.assertAlmostEqual(a, v[names.index(name)], delta=1e-4 + 1e-4 * abs(a))
        self.assertIn("VERTEX_COLOR", glb["meshes"][0]["nodes"])
        volume, = vdb["volumes"]
        self.assertEqual((volume["grids"], volume["error"]), ({"surface": "FLOAT", "density": "FLOAT", "Cd": "VECTOR_FLOAT"}, ""))

    def test_importers_of_copies(self):
        """Copies lie where the matrices place them, and nothing but copies is shown."""
        lod, voxel = ["--lod", "1,2"], FAST
        for color in ("copy", "mean-curvature"):
            self.check(0, *DIMER, "--instances", *voxel, "--color", color, "-o", "a.glb", "-o", "a.ply", "-o", "a.json",
                       "--force")
            self.check(0, *DIMER, "--instances", *lod, "--color", color, "-o", "a.usda", "--force")
            _, vertices, _ = read_ply((self.folder / "a.ply").read_bytes())
            entries = json.loads((self.folder / "a.json").read_text())["instances"]
            for scene in self.result("blender_import.py", "a.glb", "a.usda"):
                if scene is None:
                    continue  # this Blender has no USD
                self.assertEqual(len(scene["meshes"]), len(entries))
                boxes = [[[f(p[i] for p in points) for i in range(3)] for f in (min, max)] for points in (
                    *(mesh["points"] for mesh in scene["meshes"]),
                    *([placed(entry["matrix"], v[:3]) for v in vertices] for entry in entries))]
                for seen, want in zip(boxes, boxes[len(entries):]):
                    self.assert_near(seen[0], want[0], 0.03, "box")
                    self.assert_near(seen[1], want[1], 0.03, "box")
        self.check(0, *DIMER, *FAST, "--for", "usd", "-o", "b.vdb")
        scene, = self.result("blender_import.py", "b.usda")
        if scene:
            self.assertEqual([list(volume["grids"]) for volume in scene["volumes"]], [["Cd", "density", "surface"]])
        self.check(0, *DIMER, *FAST, "--instances", "--for", "usd", "-o", "c.vdb", "-o", "c.json")
        scene, = self.result("blender_import.py", "c.usda")
        if scene:  # volumes that share their data
            entries = json.loads((self.folder / "c.json").read_text())["instances"]
            for volume, entry in zip(scene["volumes"], entries, strict=True):
                for point in ((0, 0, 0), (30, 0, 0), (0, 30, 0), (0, 0, 30)):
                    self.assert_near(placed(volume["matrix"], point), placed(entry["matrix"], point), 0.03, "copy")

    def test_importer_of_films(self):
        """Frames of different topology arrive with the attribute that motion is blurred by, per second."""
        self.check(0, DATA / "1d3z.pdb.gz", *FAST, "--frames", "1-2", "--fps", "24", "--fields", "v", "--color", "element",
                   "-o", "a.usda", "-o", "a.ply")
        counts = set()
        for frame, scene in zip((1, 2), self.result("blender_import.py", "a.usda@1", "a.usda@2")):
            if scene is None:
                return  # this Blender has no USD
            (mesh,), (names, vertices, faces) = scene["meshes"], read_ply((self.folder / f"a.000{frame}.ply").read_bytes())
            counts.add(len(vertices))
            self.assertEqual((mesh["faces"], len(mesh["attributes"]["displayColor"])), (len(faces), len(vertices)))
            at = [names.index(f"v_{axis}") for axis in "xyz"]
            for p, way, v in zip(mesh["points"], mesh["attributes"]["velocity"], vertices, strict=True):
                self.assert_near(p, v[:3], 1e-3, "points")
                self.assert_near(way, [v[i] for i in at], 1e-3, "velocity")
        self.assertEqual(len(counts), 2)


@needs("blender")
class InBlender(Blender, ToolTest):
    program = ["blender", "-b", "--factory-startup", "--python-exit-code", "1", "--python"]
    attributes = False  # of Blender 3.4.1


@needs("bpy")
class InModule(Blender, ToolTest):
    program = [BPY_PYTHON]
    attributes = True


if __name__ == "__main__":
    unittest.main()
