# SPDX-License-Identifier: MPL-2.0
"""The content of the files, read by other programs."""

import collections
import hashlib
import json
import math
import os
import re
import shlex
import subprocess
import unittest

from needs import needs
from tool import CRAMBIN, DATA, FAST, TOOL, ToolTest, read_ply

try:
    import numpy
    import pyopenvdb
except ImportError:
    pyopenvdb = None


CURVATURES = ("mean_curvature", "gaussian_curvature", "principal_curvature_1",
              "principal_curvature_2", "shape_index", "curvedness", "principal_direction_1",
              "principal_direction_2")


class Report(ToolTest):
    def report(self, *words):
        self.check(0, CRAMBIN, "-o", "a.json", "--force", *words)
        return json.loads((self.folder / "a.json").read_text())

    def test_keys(self):
        report = self.report(*FAST)
        self.assertLessEqual(
            {"program", "version", "command", "input", "atoms", "voxel", "center", "surface", "evolution",
             "grid", "seconds", "peak_memory_bytes", "threads", "groups"}, set(report))
        self.assertLessEqual(
            {"kind", "area", "volume", "euler_characteristic", "components", "cavities",
             "outer_area", "outer_volume", "cavity_list", "vertices", "triangles", "closed",
             "manifold"}, set(report["surface"]))
        self.assertLessEqual(
            {"steps", "converged", "energy", "mean_displacement", "max_speed"},
            set(report["evolution"]))
        self.assertEqual(set(report["grid"]), {"active_voxels", "bytes"})
        self.assertLessEqual(
            {"read", "density", "evolve", "redistance", "spline", "mesh", "write",
             "total"}, set(report["seconds"]))

    def test_files_alone_have_what_they_have_together(self):
        """What nobody reads is left out: the mesh of a level set alone, distances where only the mesh is written."""
        for words in ["--voxel", 0.7], ["--voxel", 0.7, "--surface", "ses"]:
            self.check(0, CRAMBIN, *words, "-q", "-o", "b.ply", "-o", "b.vdb", "-o", "b.json", "--force")
            done = self.check(0, CRAMBIN, *words, "-o", "v.vdb", "--force").stderr.decode()
            self.assertRegex(done, r": (variational|ses): \d+ active voxels, \d")
            self.check(0, CRAMBIN, *words, "-q", "-o", "p.ply", "-o", "c.ply", "--force")
            self.assertEqual((self.folder / "p.ply").read_bytes(), (self.folder / "b.ply").read_bytes())
            self.check(0, CRAMBIN, *words, "-q", "-o", "j.json", "--force")
            both, alone = [json.loads((self.folder / name).read_text()) for name in ("b.json", "j.json")]
            for key in "surface", "evolution", "grid":
                if words[-1] != "ses":  # whose report alone needs no grid
                    self.assertEqual(alone[key], both[key])
            for name in "b", "v":
                self.check(0, "convert", name + ".vdb", "-q", "-o", name + "2.ply", "--force")
            self.assertEqual((self.folder / "b2.ply").read_bytes(), (self.folder / "v2.ply").read_bytes())
            known = [self.check(0, "info", name).stdout.decode() for name in ("b.vdb", "v.vdb")]
            self.assertEqual([re.search(r"^ *area +\d+\.\d+$", text, re.M) is not None for text in known], [True, False])

    def test_a_level_set_alone_is_measured_where_that_is_asked_for(self):
        self.check(0, CRAMBIN, *FAST, "-o", "a.vdb", "--require", "watertight", "--force", says="triangles")
        # Group by group, and on voxels that only a mesh can check.
        self.check(0, CRAMBIN, "--voxel", 1.5, "-o", "a.vdb", "--force", says="triangles")
        self.check(0, CRAMBIN, *FAST, "--color", "mean-curvature", "-o", "a.vdb", "--force", says="triangles")

    def test_values(self):
        report = self.report("-j", "1", *FAST)
        self.assertEqual(report["program"], "vdb_molsurf")
        self.assertEqual(report["input"], str(CRAMBIN))
        self.assertEqual(report["atoms"], 327)
        self.assertEqual(report["voxel"], 1.0)
        self.assertEqual(report["threads"], 1)
        self.assertEqual(report["surface"]["kind"], "variational")
        self.assertTrue(report["surface"]["closed"])
        self.assertTrue(report["surface"]["manifold"])
        self.assertGreater(report["surface"]["area"], 1000)
        self.assertGreater(report["surface"]["volume"], 2000)
        self.assertEqual(list(report["seconds"])[-1], "total")
        self.assertGreater(report["peak_memory_bytes"], 1e6)
        self.assertEqual(report["groups"], [])

    def test_command_can_be_pasted(self):
        report = self.report("--select", "*", *FAST)
        words = shlex.split(report["command"])
        self.assertEqual(words[0], TOOL)
        self.assertEqual(words[words.index("--select") + 1], "*")

    def test_curvature(self):
        surface = self.report(*FAST)["surface"]
        for name in ("mean_curvature", "gaussian_curvature"):
            spread = surface[name]
            middle = list(spread["percentiles"].values())
            self.assertEqual(middle, sorted(middle))
            self.assertTrue(spread["min"] <= middle[0] <= spread["mean"] <= middle[-1])
            self.assertLessEqual(middle[-1], spread["max"])
        self.assertIsNone(surface["total_gaussian_curvature"])
        surface = self.report("--curvature-totals", *FAST)["surface"]
        self.assertAlmostEqual(surface["integrated_area"] / surface["area"], 1, delta=0.02)
        self.assertAlmostEqual(surface["integrated_volume"] / surface["volume"], 1, delta=0.005)
        self.assertGreater(surface["total_mean_curvature"], 0)
        self.assertGreater(surface["willmore_energy"], 12)

    def test_averages_of_curvature_add_up(self):
        self.check(0, CRAMBIN, "--curvature-totals", "-o", "a.json", "-o", "a.ply")
        surface = json.loads((self.folder / "a.json").read_text())["surface"]
        names, vertices, triangles = read_ply((self.folder / "a.ply").read_bytes())
        area = [0.0] * len(vertices)
        for corners in triangles:
            p, q, r = (vertices[v][:3] for v in corners)
            e, f = ([b - a for a, b in zip(p, other)] for other in (q, r))
            normal = [e[i - 2] * f[i - 1] - e[i - 1] * f[i - 2] for i in range(3)]
            for v in corners:
                area[v] += math.hypot(*normal) / 6
        for name in ("mean", "gaussian"):
            column = names.index(f"{name}_curvature_average")
            total = sum(a * v[column] for a, v in zip(area, vertices))
            self.assertAlmostEqual(total / surface[f"total_{name}_curvature"], 1, delta=1e-4)
        self.assertAlmostEqual(total / (2 * math.pi * surface["euler_characteristic"]), 1, delta=0.01)

    def test_warnings_are_kept(self):
        report = self.report("--voxel", "1.5")
        self.assertTrue(any("--voxel" in warning for warning in report["warnings"]))


class NotConverged(ToolTest):
    def test_status_3_and_files(self):
        done = self.check(3, CRAMBIN, "-o", "a.json", "-o", "a.ply", "-q", "--flow", "newton", "--max-steps", "1",
                          says="not converged")
        self.assertEqual(len(done.stderr.splitlines()), 1)
        self.assertEqual(self.names(), ["a.json", "a.ply"])
        report = json.loads((self.folder / "a.json").read_text())
        self.assertFalse(report["evolution"]["converged"])

    def test_tolerances_that_the_closed_form_does_not_hold_make_steps(self):
        for voxel, tolerance, steps in ((1, "0.001", True), (1, "0.009", False), (0.5, "0.002", True), (0.5, "0.003", False)):
            self.check(0, DATA / "1a8o.cif.gz", "--voxel", voxel, "--tolerance", tolerance, "-o", "a.json", "--force")
            evolution = json.loads((self.folder / "a.json").read_text())["evolution"]
            self.assertEqual((evolution["steps"] > 0, evolution["converged"]), (steps, True), (voxel, tolerance))


class Ply(ToolTest):
    def test_mesh_is_closed_and_the_report_counts_it(self):
        self.check(0, CRAMBIN, "-o", "a.ply", "-o", "a.json")
        names, vertices, triangles = read_ply((self.folder / "a.ply").read_bytes())
        surface = json.loads((self.folder / "a.json").read_text())["surface"]
        self.assertEqual(names[:6], ["x", "y", "z", "nx", "ny", "nz"])
        self.assertEqual(len(vertices), surface["vertices"])
        self.assertEqual(len(triangles), surface["triangles"])
        edges = collections.Counter()
        for a, b, c in triangles:
            edges.update([(a, b), (b, c), (c, a)])
        self.assertTrue(all(n == 1 and edges[b, a] == 1 for (a, b), n in edges.items()))
        euler = len(vertices) - len(edges) // 2 + len(triangles)
        self.assertEqual(euler, surface["euler_characteristic"])

    def test_attributes(self):
        usual = ["x", "y", "z", "nx", "ny", "nz", "mean_curvature", "gaussian_curvature"]
        axes = ["_x", "_y", "_z"]
        for fields, further in (("mean_curvature,spline", []), ("shape_index", ["shape_index"]),
                                ("principal_direction_1,principal_curvature_2",
                                 ["principal_curvature_2"] +
                                 ["principal_direction_1" + axis for axis in axes])):
            self.check(0, CRAMBIN, "-o", "a.ply", "--force", "--fields", fields, *FAST)
            names, vertices, _ = read_ply((self.folder / "a.ply").read_bytes())
            self.assertEqual(names, usual + further + ["atom_id"], fields)
            if "shape_index" in names:
                column = [vertex[names.index("shape_index")] for vertex in vertices]
                self.assertTrue(all(-1 <= x <= 1 for x in column))
                self.assertTrue(min(column) < -0.5 < 0.5 < max(column))

    def test_triangles_turn_outward(self):
        self.check(0, CRAMBIN, "-o", "a.ply")
        _, vertices, triangles = read_ply((self.folder / "a.ply").read_bytes())
        volume = 0.0
        for triangle in triangles:
            (ax, ay, az), (bx, by, bz), (cx, cy, cz) = (vertices[n][:3] for n in triangle)
            volume += ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx)
        self.assertGreater(volume, 0)


class Vdb(ToolTest):
    def setUp(self):
        super().setUp()
        self.path = str(self.folder / "a.vdb")

    def build(self, *words):
        self.check(0, CRAMBIN, "-o", "a.vdb", "--force", *words)

    def test_vdb_print_reads_it(self):
        self.build(*FAST)
        done = subprocess.run(["vdb_print", "-l", self.path], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("Name: surface", done.stdout)
        self.assertIn("class: level set", done.stdout)
        self.build("--fields", "all", *FAST)
        done = subprocess.run(["vdb_print", "-l", self.path], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        for name in CURVATURES:
            self.assertIn("Name: " + name, done.stdout)

    def test_info_reads_it(self):
        self.build(*FAST)
        text = self.check(0, "info", "a.vdb").stdout.decode()
        self.assertIn("  grid surface\n", text)
        for line in (r"class +level set", r"voxel size +1 Å", r"area +[\d.]+ Å\^2",
                     r"volume +[\d.]+ Å\^3", r"active voxels +\d+", r"option.voxel +1"):
            self.assertRegex(text, rf"\n    {line}\n")

    @needs("openvdb")
    def test_surface(self):
        self.build()
        grid = pyopenvdb.read(self.path, "surface")
        self.assertEqual(grid.gridClass, "level set")
        self.assertEqual(grid.valueTypeName, "float")
        self.assertEqual(tuple(grid.transform.voxelSize()), (0.5, 0.5, 0.5))
        self.assertGreaterEqual(grid.background, 1.0)
        self.assertTrue(grid.creator.startswith("vdb_molsurf "))
        voxels = grid.getConstAccessor()
        inside = deep = atoms = 0
        for line in CRAMBIN.read_text().splitlines():
            if line.startswith("ATOM"):
                atom = [float(line[i : i + 8]) for i in (30, 38, 46)]
                ijk = tuple(int(x) for x in grid.transform.worldToIndexCellCentered(atom))
                value, active = voxels.probeValue(ijk)
                inside += value < 0
                deep += not active and value == -grid.background
                atoms += 1
        self.assertGreater(inside, 0.95 * atoms)
        self.assertGreater(deep, 0)
        self.assertEqual(voxels.probeValue((10000, 0, 0)), (grid.background, False))

    def test_half_floats(self):
        def build(*words):
            self.build("--fields", "Cd", "--color", "chain", *FAST, *words)
            self.check(0, "convert", "a.vdb", "-o", "a.json", "--force")
            report = json.loads((self.folder / "a.json").read_text())
            info = self.check(0, "info", "a.vdb").stdout.decode()
            return (self.folder / "a.vdb").stat().st_size, report["surface"]["area"], info

        size, area, info = build()
        half_size, half_area, half_info = build("--vdb-half")
        self.assertLess(half_size, size)
        self.assertAlmostEqual(half_area / area, 1.0, delta=1e-4)
        self.assertNotEqual(half_area, area)
        self.assertNotIn("half_float", info)
        self.assertEqual(len(re.findall(r"is_saved_as_half_float +true", half_info)), 2)
        self.assertRegex(half_info, r"option.vdb-half +true")

    @needs("openvdb")
    def test_metadata(self):
        self.build("--epsilon", "0.6", *FAST)
        self.assertNotIn("area", pyopenvdb.readMetadata(self.path))  # no mesh was made
        self.build("--epsilon", "0.6", *FAST, "-o", "a.ply")
        metadata = pyopenvdb.readMetadata(self.path)
        self.assertEqual(metadata["program"], "vdb_molsurf")
        self.assertEqual(metadata["input"], str(CRAMBIN))
        self.assertEqual(metadata["input_sha256"],
                         hashlib.sha256(CRAMBIN.read_bytes()).hexdigest())
        self.assertEqual(metadata["option.epsilon"], 0.6)
        self.assertEqual(metadata["option.voxel"], 1.0)
        self.assertIn("--epsilon 0.6", metadata["command"])
        self.assertGreater(metadata["area"], 0)
        self.assertGreater(metadata["volume"], 0)

    @needs("openvdb")
    def test_fields(self):
        # By name: pyopenvdb lacks int32 grids, and reading all would refuse atom_id.
        self.build("--fields", "all", *FAST)
        voxels = pyopenvdb.read(self.path, "surface").activeVoxelCount()
        for name in CURVATURES:
            self.assertEqual(pyopenvdb.read(self.path, name).activeVoxelCount(), voxels, name)
        for name in ("sas", "spline"):
            self.assertGreater(pyopenvdb.read(self.path, name).activeVoxelCount(), voxels, name)
        self.assertIn(b"grid atom_id", self.check(0, "info", self.path).stdout)
        low, high = pyopenvdb.read(self.path, "shape_index").evalMinMax()
        self.assertTrue(-1 <= low < high <= 1)
        self.build("--fields", "sas", *FAST)
        names = sorted(grid.name for grid in pyopenvdb.readAllGridMetadata(self.path))
        self.assertEqual(names, ["sas", "surface"])


class Threads(ToolTest):
    def setUp(self):
        super().setUp()
        for threads in ("1", "2"):
            self.check(0, CRAMBIN, "-j", threads, "-o", threads + ".ply", "-o", threads + ".vdb")

    def test_same_mesh(self):
        self.assertEqual((self.folder / "1.ply").read_bytes(), (self.folder / "2.ply").read_bytes())

    @needs("openvdb")
    def test_same_grid(self):
        arrays = []
        for threads in ("1", "2"):
            grid = pyopenvdb.read(str(self.folder / (threads + ".vdb")), "surface")
            low, high = grid.evalActiveVoxelBoundingBox()
            array = numpy.zeros([b - a + 1 for a, b in zip(low, high)], dtype=numpy.float32)
            grid.copyToArray(array, ijk=low)
            arrays.append((low, grid.activeVoxelCount(), array))
        self.assertEqual(arrays[0][:2], arrays[1][:2])
        self.assertEqual(arrays[0][2].tobytes(), arrays[1][2].tobytes())


class SameBytes(ToolTest):
    """A .vdb depends on its content alone: its identifier is made of that."""

    def vdb(self, *words, threads=2, name="a.vdb"):
        """What a run writes that has so many cores and, where it asks for threads, takes them."""
        def pin():
            os.sched_setaffinity(0, sorted(os.sched_getaffinity(0))[:threads])

        done = self.check(0, *words, "--force", preexec_fn=pin)
        return (self.folder / name).read_bytes() if name else done.stdout

    def expect_same(self, *words, name="a.vdb"):
        first = self.vdb(*words, name=name)
        self.assertEqual(first, self.vdb(*words, name=name))
        self.assertEqual(first, self.vdb(*words, threads=1, name=name))
        self.assertRegex(first[21:57], rb"^[0-9a-f]{8}-[0-9a-f]{4}-8[0-9a-f]{3}-[89ab][0-9a-f]{3}-[0-9a-f]{12}$")
        return first

    def test_of_a_surface(self):
        plain = self.expect_same(CRAMBIN, "-o", "a.vdb", *FAST)
        other = self.expect_same(CRAMBIN, "-o", "a.vdb", "--voxel", "1.01")
        self.assertNotEqual(plain[21:57], other[21:57])
        self.expect_same(CRAMBIN, "-o", "a.vdb", "--fields", "all", "--for", "blender", *FAST)

    def test_with_other_threads(self):
        """They are in the file's `command` alone, and so in its identifier."""
        def content(threads):
            call = f"-j {threads}".encode()
            data = self.vdb(CRAMBIN, "-j", threads, "-o", "a.vdb", *FAST)
            self.assertEqual(data.count(call), 1)
            return data[:21] + data[57:].replace(call, b"")

        self.assertEqual(content(1), content(2))

    def test_of_standard_output(self):
        data = self.expect_same(CRAMBIN, "-o", "-", "--format", "vdb", *FAST, name=None)
        (self.folder / "b.vdb").write_bytes(data)
        self.assertIn(b"surface", self.check(0, "info", "b.vdb").stdout)

    def test_of_frames_bricks_and_differences(self):
        self.expect_same(DATA / "1d3z.pdb.gz", "--frames", "1", "-o", "a.vdb", *FAST, name="a.0001.vdb")
        self.check(0, "bricks", "plan", CRAMBIN, "-o", "plan.json", "--bricks", 2, *FAST)
        for brick in (1, 2):
            self.check(0, "bricks", "run", "plan.json", brick)
        self.expect_same("bricks", "merge", "plan.json", "-o", "m.vdb", name="m.vdb")
        self.expect_same("bricks", "merge", "plan.json", "-o", "-", "--format", "vdb", name=None)
        self.check(0, CRAMBIN, "-o", "b.vdb", "--fields", "surface,spline,chain_id", *FAST)
        self.expect_same("compare", "m.vdb", "b.vdb", "-o", "d.vdb", name="d.vdb")
        self.expect_same("convert", "b.vdb", "--color", "chain", "-o", "c.vdb", name="c.vdb")

    @needs("openvdb")
    def test_openvdb_reads_them(self):
        self.vdb(CRAMBIN, "-o", "a.vdb", *FAST)
        grids, metadata = pyopenvdb.readAll(str(self.folder / "a.vdb"))
        self.assertEqual(([grid.name for grid in grids], metadata["program"]), (["surface"], "vdb_molsurf"))


if __name__ == "__main__":
    unittest.main()
