# SPDX-License-Identifier: MPL-2.0
"""What --for blender writes lies in Blender where the mesh of the same run lies."""

import json
import pathlib
import subprocess
import unittest

from needs import needs
from tool import CRAMBIN, DATA, ROOT, ToolTest, read_ply

SCENES = pathlib.Path(__file__).resolve().parent / "blender_scenes.py"
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


@needs("blender")
class Blender(ToolTest):
    def blender(self, script, *words):
        done = subprocess.run(
            ["blender", "-b", "--factory-startup", "--python-exit-code", "1", "--python", str(script),
             "--", *map(str, words)],
            cwd=self.folder, capture_output=True, text=True, timeout=500)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout

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
        out = self.blender(SCENES, ",".join(f"{name}.vdb" for name in SCALES), "frame.0001.vdb")
        line, = [line for line in out.splitlines() if line.startswith("RESULT ")]
        result = json.loads(line[len("RESULT "):])

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

    def test_missing_frame(self):
        for frame in (1, 2, 4):
            (self.folder / f"a.000{frame}.vdb").write_bytes(b"")
        done = subprocess.run(["blender", "-b", "--factory-startup", "--python", str(SCRIPT), "--",
                               "a.0001.vdb"], cwd=self.folder, capture_output=True, text=True,
                              timeout=100)
        self.assertIn("frames are missing between 1 and 4", done.stdout + done.stderr)


if __name__ == "__main__":
    unittest.main()
