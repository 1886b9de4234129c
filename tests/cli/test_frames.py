# SPDX-License-Identifier: MPL-2.0
"""Frames: models of a structure, or a trajectory beside it."""

import csv
import gzip
import json
import re
import unittest

from kill import killed_at
from needs import needs
from test_meshes import accessor, read_glb
from tool import CRAMBIN, DATA, FAST, ToolTest, read_ply
from trajectories import dcd, netcdf, trr

try:
    import pyopenvdb
except ImportError:
    pyopenvdb = None

NMR = DATA / "1d3z.pdb.gz"  # 10 models
XTC = DATA / "1d3z.xtc"  # the first 3 of them


def positions(path):
    """The coordinates of a PDB file's atoms."""
    return [tuple(float(line[i:i + 8]) for i in (30, 38, 46)) for line in
            path.read_text().splitlines() if line.startswith(("ATOM", "HETATM"))]


class Frames(ToolTest):
    def table(self, name="a.csv"):
        with open(self.folder / name, newline="") as file:
            return list(csv.DictReader(file))

    def moved(self, count, step=0.5):
        """Crambin that moves along x."""
        atoms = positions(CRAMBIN)
        return [[(x + step * n, y, z) for x, y, z in atoms] for n in range(count)]

    def times(self):
        return {path.name: path.stat().st_mtime_ns for path in self.folder.iterdir()
                if path.suffix != ".csv"}

    def test_models(self):
        self.check(0, NMR, *FAST, "--frames", "2-10:4", "-o", "a.vdb",
                   "-o", "a.ply", "-o", "a.csv", says=["3 frames", "frame 6: area"])
        self.assertEqual(self.names(), ["a.0001.ply", "a.0001.vdb", "a.0002.ply", "a.0002.vdb",
                                        "a.0003.ply", "a.0003.vdb", "a.csv"])
        rows = self.table()
        self.assertEqual([(row["file"], row["frame"]) for row in rows],
                         [("1", "2"), ("2", "6"), ("3", "10")])
        # Each is the surface of its model, as a run of its own makes it.
        for row in rows:
            self.check(0, NMR, *FAST, "--model", row["frame"], "-o", "b.json", "--force")
            self.check(0, "info", f"a.000{row['file']}.vdb")
            report = json.loads((self.folder / "b.json").read_text())["surface"]
            self.assertAlmostEqual(float(row["volume"]) / report["volume"], 1, delta=0.001)
            self.assertAlmostEqual(float(row["area"]) / report["area"], 1, delta=0.003)

    def test_changes_of_the_topology_are_named(self):
        """By the number that each frame's line and row tell, which for sas is exact and not that of the mesh."""
        said = self.check(0, NMR, "--surface", "sas", "--voxel", "2", "--frames", "all", "-o", "a.ply",
                          "-o", "a.csv").stderr.decode()
        numbers = [int(row["euler_characteristic"]) for row in self.table()]
        self.assertEqual([int(n) for n in re.findall(r"frame \d+: .* Euler (-?\d+)", said)], numbers)
        self.assertEqual(numbers[0], numbers[1])
        changed = [str(i + 1) for i in range(1, 10) if numbers[i] != numbers[i - 1]]
        self.assertIn(f"another than that before in frames {', '.join(changed)}\n", said)
        # Also after frames that are kept.
        (self.folder / f"a.{int(changed[0]):04}.ply").unlink()
        self.check(0, NMR, "--surface", "sas", "--voxel", "2", "--frames", "all", "-o", "a.ply", "-o", "a.csv",
                   says=["9 done before", f"another than that before in frames {changed[0]}\n"])

    def test_frames_are_the_runs(self):
        """Bit for bit, meshes and numbers."""
        self.check(0, NMR, *FAST, "--frames", "2-3", "-o", "a.ply")
        for file, model in ((1, 2), (2, 3)):
            self.check(0, NMR, *FAST, "--model", model, "-o", "b.ply", "--force")
            self.assertEqual((self.folder / f"a.000{file}.ply").read_bytes(),
                             (self.folder / "b.ply").read_bytes())

    def test_trajectory(self):
        """Of every kind the same surfaces, which move along."""
        frames = self.moved(3)
        fixed = [[frame[0]] + [p for p in frame[1:]] for frame in frames]
        for frame in fixed:
            frame[0] = frames[0][0]
        kinds = {"little": dcd(frames), "big": dcd(frames, ">"), "cell": dcd(frames, cell=True), "wide": dcd(frames, marker="q"),
                 "fourth": dcd(frames, fourth=True),
                 "wide big": dcd(frames, ">", cell=True, marker="q")}
        meshes = {}
        for kind, data in kinds.items():
            (self.folder / "t.dcd").write_bytes(data)
            self.check(0, CRAMBIN, *FAST, "--trajectory", "t.dcd", "-o", f"{kind}.stl",
                       says="3 frames")
            meshes[kind] = [(self.folder / f"{kind}.000{n}.stl").read_bytes() for n in (1, 2, 3)]
        for kind in kinds:
            self.assertEqual(meshes["little"], meshes[kind], kind)
        self.assertEqual(meshes["little"], meshes["cell"])
        self.assertEqual(len(set(meshes["little"])), 3)
        self.check(0, CRAMBIN, *FAST, "-o", "one.stl")
        (self.folder / "t.dcd").write_bytes(dcd(fixed, fixed=(0,)))
        self.check(0, CRAMBIN, *FAST, "--trajectory", "t.dcd", "--frames", "3", "-o", "a.json")
        (self.folder / "t.dcd").write_bytes(dcd(fixed))
        self.check(0, CRAMBIN, *FAST, "--trajectory", "t.dcd", "--frames", "3", "-o", "b.json")
        a, b = (json.loads((self.folder / f"{name}.0001.json").read_text())["surface"]
                for name in "ab")
        self.assertEqual((a["area"], a["volume"]), (b["area"], b["volume"]))

    def test_trr_and_netcdf(self):
        """Of every width and version they have the areas of a DCD of the same frames."""
        frames = self.moved(3)
        frames[1] = [(1.02 * x, y, z) for x, y, z in frames[1]]
        kinds = {"a.dcd": dcd(frames), "a.trr": trr(frames), "b.trr": trr(frames, "d", velocities=True), "c.trr": trr(frames, extra=(0, 2)),
                 "d.trr": trr(frames, version=b"GMX_trn_file_2", cell=False), "e.trr": trr(frames, "d", cell=False, velocities=True),
                 "a.nc": netcdf(frames), "b.nc": netcdf(frames, 2, "d"), "c.nc": netcdf(frames, 5, scale=0.5), "by another name": netcdf(frames)}
        areas = {}
        for name, content in kinds.items():
            (self.folder / name).write_bytes(content)
            self.check(0, CRAMBIN, "--surface", "sas", "--trajectory", name, "--frames", "all", "-o", "a.csv", "--force", says="3 frames")
            areas[name] = [float(row["area"]) for row in self.table()]
        self.assertGreater(areas["a.dcd"][1], areas["a.dcd"][0] + 10)
        for name, found in areas.items():
            for area, expected in zip(found, areas["a.dcd"], strict=True):
                self.assertAlmostEqual(area, expected, delta=0.01, msg=name)
        (self.folder / "a.rst7").write_bytes(netcdf(frames[1:2], restart=True, width="d"))
        self.check(0, CRAMBIN, "--surface", "sas", "--trajectory", "a.rst7", "-o", "a.csv", "--force", says="1 frame")
        self.assertAlmostEqual(float(self.table()[0]["area"]), areas["a.dcd"][1], delta=0.01)

    def test_damaged_trr_and_netcdf(self):
        frames = self.moved(2)
        whole = {"a.trr": trr(frames), "a.nc": netcdf(frames)}
        for name, content in whole.items():
            (self.folder / name).write_bytes(content[:-100 if name == "a.trr" else -5000])
            said = self.check(0, CRAMBIN, *FAST, "--trajectory", name, "--frames", "all", "-o", "a.stl", "--force", says="cut short").stderr
            self.assertIn(b"1 frame", said)
            for size in (3, 6, 20, 60, 150, 400, 600):
                (self.folder / name).write_bytes(content[:size])
                self.check(1, CRAMBIN, *FAST, "--trajectory", name, "-o", "b.stl", says=f"{name}: ")
        (self.folder / "a.nc").write_bytes(netcdf(frames).replace(b"coordinates", b"displacemen"))
        self.check(1, CRAMBIN, *FAST, "--trajectory", "a.nc", "-o", "b.stl", says='expected a variable "coordinates"')
        (self.folder / "a.trr").write_bytes(trr(frames) + trr([frame[:-1] for frame in frames]))
        self.check(1, CRAMBIN, *FAST, "--trajectory", "a.trr", "-o", "b.stl", says="frame 3 has 326 atoms, the first one 327")

    def test_other_trajectories(self):
        """Refused with the program that converts them."""
        for name, begin, kind, program in (("a.h5", b"\x89HDF\r\n\x1a\n", "HDF5", "mdconvert"), ("a.tng", b"\0" * 8, "TNG", "gmx trjconv")):
            (self.folder / name).write_bytes(begin + bytes(200))
            self.check(1, CRAMBIN, *FAST, "--trajectory", name, "-o", "a.ply",
                       says=[f"{name}: is a trajectory in {kind}, expected DCD, XTC, TRR or NetCDF", program])
        (self.folder / "a.nc").write_bytes(dcd(self.moved(2)))
        self.check(0, CRAMBIN, *FAST, "--trajectory", "a.nc", "-o", "a.stl", says="2 frames")

    def test_xtc(self):
        """Its frames, which GROMACS made of the models, have the surfaces of the models."""
        (self.folder / "by another name").write_bytes(XTC.read_bytes())
        self.check(0, NMR, *FAST, "--trajectory", "by another name", "--frames", "2-3",
                   "-o", "a.csv", says="2 frames")
        self.check(0, NMR, *FAST, "--frames", "2-3", "-o", "b.csv")
        for xtc, model in zip(self.table("a.csv"), self.table("b.csv")):
            self.assertEqual(xtc["atoms"], "1231")
            for what in ("area", "volume"):
                # The coordinates are rounded to 0.01 Å.
                self.assertAlmostEqual(float(xtc[what]) / float(model[what]), 1, delta=2e-4)
                self.assertNotEqual(xtc[what], model[what])
        self.assertNotAlmostEqual(float(self.table("a.csv")[0]["volume"]) /
                                  float(self.table("a.csv")[1]["volume"]), 1, delta=4e-4)

    @needs("openvdb")
    def test_one_transform_and_velocity(self):
        (self.folder / "t.dcd").write_bytes(dcd(self.moved(3)))
        self.check(0, CRAMBIN, *FAST, "--trajectory", "t.dcd", "--center", "--fields", "v,Cd",
                   "-o", "a.vdb")
        seen = set()
        for n in (1, 2, 3):
            name = str(self.folder / f"a.000{n}.vdb")
            surface, v = pyopenvdb.read(name, "surface"), pyopenvdb.read(name, "v")
            place = surface.transform
            seen.add((place.voxelSize(), place.indexToWorld((0, 0, 0)), surface.background))
            self.assertGreater(v.activeVoxelCount(), surface.activeVoxelCount())
            worst = max(max(abs(a - b) for a, b in zip(item.value, (0.5, 0, 0)))
                        for item in v.citerOnValues())
            self.assertLess(worst, 1e-4)
        self.assertEqual(len(seen), 1)

    def test_all_frames_have_one_centre(self):
        """That of the first: what moves does so in the files, too."""
        (self.folder / "t.dcd").write_bytes(dcd(self.moved(2, 6)))
        self.check(0, CRAMBIN, *FAST, "--trajectory", "t.dcd", "--center", "-o", "a.ply")
        middles = []
        for n in (1, 2):
            _, vertices, _ = read_ply((self.folder / f"a.000{n}.ply").read_bytes())
            middles.append([sum(v[axis] for v in vertices) / len(vertices) for axis in range(3)])
        for way, expected in zip((b - a for a, b in zip(*middles)), (6, 0, 0)):
            self.assertAlmostEqual(way, expected, delta=0.1)

    def moving(self, *words):
        """Crambin that moves by 6 Å a frame along x."""
        (self.folder / "t.dcd").write_bytes(dcd(self.moved(2, 6)))
        self.check(0, CRAMBIN, "--voxel", "0.5", "--trajectory", "t.dcd", "--fields", "v,density", *words, "--force")

    @needs("openvdb")
    def test_velocity_reaches_as_far_as_the_motion(self):
        """A renderer looks it up where a ray is: in the fog, and where the fog comes from or goes to."""
        for words, way, unit in (((), 6, "Å per frame"), (("--fps", "24"), 144, "Å per second"),
                                 (("--for", "houdini=nm"), 0.6, "scene units per frame"),
                                 (("--for", "usd=nm", "--fps", "24"), 14.4, "scene units per second")):
            self.moving(*words, "-o", "a.vdb")
            fog, v = (pyopenvdb.read(str(self.folder / "a.0001.vdb"), name) for name in ("density", "v"))
            there, size = v.getConstAccessor(), v.transform.voxelSize()[0]
            self.assertTrue(all(there.isValueOn(item.min) for item in fog.citerOnValues() if item.count == 1))
            for side, sign in ((0, 1), (1, -1)):
                for a, b in zip(fog.evalActiveVoxelBoundingBox()[side], v.evalActiveVoxelBoundingBox()[side]):
                    self.assertGreaterEqual(sign * (a - b) * size, 0.999 * (0.6 if "nm" in str(words) else 6))
            for item in v.citerOnValues():
                self.assertLess(max(abs(a - b) for a, b in zip(item.value, (way, 0, 0))), 1e-3 * way)
            self.assertEqual(v["unit"], unit)
        self.assertIn("timeCodesPerSecond = 24\n", (self.folder / "a.usda").read_text())
        # Deep in the fog, too, which a little motion does not reach from the surface.
        (self.folder / "t.dcd").write_bytes(dcd(self.moved(2, 0.25)))
        self.check(0, CRAMBIN, "--voxel", "0.5", "--trajectory", "t.dcd", "--fields", "v,density", "-o", "b.vdb")
        fog, v = (pyopenvdb.read(str(self.folder / "b.0001.vdb"), name) for name in ("density", "v"))
        there = v.getConstAccessor()
        self.assertTrue(all(there.isValueOn(item.min) for item in fog.citerOnValues()))

    @needs("openvdb")
    def test_velocity_reaches_by_the_own_atom_of_a_voxel(self):
        """One atom of a row jumps: the grid is wide about it, and not about the others."""
        with open(self.folder / "row.pdb", "w", encoding="ascii") as file:
            for model, jump in ((1, 0), (2, 20)):
                file.write(f"MODEL     {model:4d}\n")
                for k in range(20):
                    file.write(f"ATOM  {k + 1:5d}  CA  ALA A{k + 1:4d}    {3.8 * k:8.3f}{jump if k == 0 else 0.4 * (model - 1):8.3f}{0:8.3f}  1.00  0.00           C\n")
                file.write("ENDMDL\n")
        self.check(0, "row.pdb", "--voxel", "1", "--radii", "bondi", "--frames", "1-2", "--fields", "v", "-o", "a.vdb")
        surface, v = (pyopenvdb.read(str(self.folder / "a.0001.vdb"), name) for name in ("surface", "v"))
        (low, high), (wide_low, wide_high) = (grid.evalActiveVoxelBoundingBox() for grid in (surface, v))
        self.assertGreaterEqual(low[0] - wide_low[0], 20)
        self.assertLessEqual(wide_high[0] - high[0], 2)
        read = v.getConstAccessor()
        self.assertEqual([round(x) for x in read.getValue((0, 18, 0))], [0, 20, 0])  # far from all balls
        self.assertAlmostEqual(read.getValue((70, 2, 0))[1], 0.4, places=4)

    def test_first_frame(self):
        words = (NMR, *FAST, "--frames", "2-3", "--first-frame", "1001", "--for", "usd", "-o", "a.vdb", "-o", "a.csv")
        self.check(0, *words)
        self.assertEqual(self.names(), ["a.1001.vdb", "a.1002.vdb", "a.csv", "a.usda"])
        self.assertEqual([(row["file"], row["frame"]) for row in self.table()], [("1001", "2"), ("1002", "3")])
        scene = (self.folder / "a.usda").read_text()
        for line in ("startTimeCode = 1001\n", "endTimeCode = 1002\n", "1002: @./a.1002.vdb@"):
            self.assertIn(line, scene)
        extents = re.findall(r"^ *(\d+): \[\([^)]*\), \([^)]*\)\],$", scene, re.MULTILINE)
        self.assertEqual(extents, ["1001", "1002"])
        self.check(0, *words, says="2 done before")
        self.check(2, NMR, "--first-frame", "1001", "-o", "a.vdb", says="--frames")

    def test_a_sequence_is_of_one_input_and_of_the_same_options(self):
        """Frames of other runs that have its name are left out of the .usda, with a line."""
        words = (*FAST, "--for", "usd", "-o", "a.vdb", "--force")
        self.check(0, NMR, *words, "--frames", "1-3")
        self.assertEqual((self.folder / "a.usda").read_text().count("@./a.0003.vdb@"), 3)  # of three grids
        for more in ((DATA / "bpti.pdb.gz",), (NMR, "--probe", "1.6")):
            self.check(0, *more, *words, "--frames", "1", says="a.usda: without a.0002.vdb and 1 more, of another input")
            scene = (self.folder / "a.usda").read_text()
            self.assertIn("@./a.0001.vdb@", scene)
            self.assertNotIn("a.0002.vdb", scene)
            self.assertEqual(scene.count("[("), 1)  # extents
        self.check(0, NMR, *words[:-1], "--frames", "2-3", "--first-frame", "2", says="2 done before")
        self.check(0, NMR, *words, "--frames", "2-3", "--first-frame", "2", says="without a.0001.vdb, of")
        self.check(0, NMR, *FAST, "--for", "usd", "-o", "a.0009.vdb", says="without a.0001.vdb and 2 more, of")
        self.check(0, NMR, *FAST, "--for", "usd", "--probe", "1.6", "-o", "a.0010.vdb", says="without a.0001.vdb and 2 more, of")
        self.assertIn("9: @./a.0009.vdb@", (self.folder / "a.usda").read_text())

    def test_film_of_meshes(self):
        """A .usda of each frame, and one that plays those of one input and its options."""
        words = (NMR, *FAST, "-o", "a.usda")

        def clips():
            return re.findall(r"@\./(a\.\d+\.usda)@", (self.folder / "a.usda").read_text())[:-1]  # and one that tells what is in all

        self.check(0, *words, "--frames", "1-2")
        self.assertEqual(self.names(), ["a.0001.usda", "a.0002.usda", "a.usda"])
        self.assertEqual(clips(), ["a.0001.usda", "a.0002.usda"])
        self.assertNotIn("velocities", (self.folder / "a.usda").read_text())
        before = self.times()["a.0001.usda"]
        self.check(0, *words, "--frames", "1-3", says="2 done before")
        self.assertEqual((self.times()["a.0001.usda"], clips()), (before, [f"a.000{n}.usda" for n in (1, 2, 3)]))
        self.assertIn("double2[] active = [(1, 0), (2, 1), (3, 2)]", (self.folder / "a.usda").read_text())  # time and file
        self.check(1, *words, "--frames", "1-2", "--probe", "1.6", says=["a.0001.usda", "--force"])
        self.check(0, *words, "--frames", "1", "--probe", "1.6", "--force",
                   says="a.usda: without a.0002.usda and 1 more, of another input")
        self.assertEqual(clips(), ["a.0001.usda"])
        (self.folder / "a.usda").write_text("mine")
        self.check(1, *words, "--frames", "2", "--first-frame", "4", says=["a.usda", "--force"])
        self.assertEqual((self.folder / "a.usda").read_text(), "mine")
        self.check(2, *words, "--frames", "1", "--split", "group", "--group-by", "residues:30", says=["a.usda", "one mesh"])

    def test_a_stage_has_the_fields_that_are_asked_for(self):
        for words, fields in ([], []), (["--fields", "surface,mean_curvature"], ["mean_curvature"]):
            self.check(0, CRAMBIN, *FAST, "--color", "hydrophobicity", *words, "-o", "a.usda", "--force")
            text = (self.folder / "a.usda").read_text()
            self.assertEqual(re.findall(r"float\[\] primvars:(\w+)", text), fields)
        for scale, metres in ("blender", "1e-10"), ("blender=0.5", "2e-10"):
            self.check(0, CRAMBIN, *FAST, "--for", scale, "-o", "a.usda", "--force")
            self.assertIn(f"metersPerUnit = {metres}\n", (self.folder / "a.usda").read_text())

    def test_vertices_have_the_velocity(self):
        self.moving("--fps", "25", "-o", "a.ply", "-o", "a.glb")
        names, vertices, _ = read_ply((self.folder / "a.0001.ply").read_bytes())
        at = [names.index(f"v_{axis}") for axis in "xyz"]
        document, body = read_glb((self.folder / "a.0001.glb").read_bytes())
        attributes = document["meshes"][0]["primitives"][0]["attributes"]
        self.assertFalse([name for name in attributes if name.startswith("_V_")])
        for values in ([[v[i] for i in at] for v in vertices], accessor(document, body, attributes["_VELOCITY"])):
            self.assertEqual(len(values), len(vertices))
            for value in values:
                self.assertLess(max(abs(a - b) for a, b in zip(value, (150, 0, 0))), 0.01)
        done = self.check(0, NMR, *FAST, "--frames", "1", "--fields", "v", "-o", "b.ply")
        self.assertNotIn(b"--fields", done.stderr)
        for words, way in (((), 144), (("--fps", "25", "--for", "usd=nm"), 150)):  # in Å: the prim has the scale
            self.moving(*words, "-o", "c.usda")
            line, = re.findall(r"velocities.timeSamples = \{\s*1: \[(.*)\]", (self.folder / "c.0001.usda").read_text())
            for value in re.findall(r"\(([^,]*), ([^,]*), ([^,]*)\)", line):
                self.assertLess(max(abs(float(a) - b) for a, b in zip(value, (way, 0, 0))), 0.01)
        self.check(2, CRAMBIN, "--fps", "24", "-o", "a.vdb", says="--frames")

    def test_frames_of_another_trajectory_are_others(self):
        for name in ("t.dcd", "u.dcd"):
            (self.folder / name).write_bytes(dcd(self.moved(2)))
        call = [CRAMBIN, *FAST, "--surface", "vdw", "--frames", "1-2", "-o", "a.vdb", "--trajectory"]
        self.check(0, *call, "t.dcd")
        self.check(0, *call, "t.dcd")
        self.check(1, *call, "u.dcd", says="of another frame or with other options")

    def test_again_does_what_was_not_done(self):
        words = (NMR, *FAST, "-o", "a.vdb", "-o", "a.ply", "-o", "a.csv")
        self.check(0, *words, "--frames", "1-2")
        before, rows = self.times(), self.table()
        self.check(0, *words, "--frames", "1-3", says="2 done before")
        after = self.times()
        self.assertEqual({name: after[name] for name in before}, before)
        self.assertEqual(self.table()[:2], rows)
        self.assertEqual(len(self.table()), 3)
        for file in ("a.0002.vdb", "a.0002.ply"):
            (self.folder / file).unlink()
        self.check(0, *words, "--frames", "1-3", says="2 done before")
        self.assertEqual(self.times()["a.0003.vdb"], after["a.0003.vdb"])
        # As if it had been done at once.
        self.check(0, NMR, *FAST, "-o", "b.ply", "--frames", "1-3")
        for file in (1, 2, 3):
            self.assertEqual((self.folder / f"a.000{file}.ply").read_bytes(),
                             (self.folder / f"b.000{file}.ply").read_bytes())
        # A frame of which a file is missing is not done.
        (self.folder / "a.0003.ply").unlink()
        self.check(1, *words, "--frames", "1-3", says="a.0003.vdb: it exists already")
        # What is there is never taken for something else.
        self.check(1, *words, "--frames", "1-3", "--probe", "1.5", says=["a.0001.vdb", "--force"])
        self.check(1, *words, "--frames", "2-3", says=["a.0001.vdb", "--force"])
        data = (self.folder / "a.0001.vdb").read_bytes()
        (self.folder / "a.0001.vdb").write_bytes(data[:len(data) // 2])
        self.check(1, *words, "--frames", "1-3", says="a.0001.vdb")
        self.check(0, *words, "--frames", "1", "--force")
        self.check(0, "info", "a.0001.vdb")

    def test_the_lines_of_a_table_alone(self):
        """They come together, at the latest at the end, be that an error's."""
        frames = self.moved(3)
        words = (CRAMBIN, "--surface", "sas", "--trajectory", "t.dcd", "--frames", "all", "-o", "a.csv")
        (self.folder / "t.dcd").write_bytes(dcd(frames[:2] + [[(1e9, y, z) for x, y, z in frames[2]]]))
        self.check(1, *words, says="frame 3: atom 1")
        self.assertEqual([row["frame"] for row in self.table()], ["1", "2"])
        before = self.table()
        (self.folder / "t.dcd").write_bytes(dcd(frames))
        self.check(0, *words, says=["3 frames, 2 done before"])
        self.assertEqual([row["frame"] for row in self.table()], ["1", "2", "3"])
        self.assertEqual(self.table()[:2], before)

    @needs("strace")
    def test_a_table_alone_is_put_in_its_place_once(self):
        """By a run of less than five seconds; other files of a frame have their line with them."""
        (self.folder / "t.dcd").write_bytes(dcd(self.moved(4)))
        words = (CRAMBIN, "--surface", "sas", "--trajectory", "t.dcd", "--frames", "all", "-o", "a.csv", "--force")
        for more, renames in (((), 1), (("-o", "b.json"), 4 * 3)):
            for number, dies in ((renames + 1, False), (renames, True)):
                self.assertEqual(killed_at("rename", number, (*words, *more), self.folder), dies)
            self.check(0, *words)  # puts away what is left

    def test_files_that_options_name_count_by_their_content(self):
        table = self.folder / "t"
        table.write_text("A 1 0.5\n")
        words = (NMR, *FAST, "--frames", "1", "--color", "table=t", "-o", "a.vdb")
        self.check(0, *words)
        self.check(0, *words, says="1 done before")
        table.write_text("A 1 0.6\n")
        self.check(1, *words, says=["a.0001.vdb", "other options"])

    def test_only_meshes_are_not_replaced(self):
        self.check(0, NMR, *FAST, "-o", "a.ply", "--frames", "1")
        self.check(1, NMR, *FAST, "-o", "a.ply", "--frames", "1", says=["a.0001.ply", "--force"])
        (self.folder / "a.csv").write_text("mine\n")
        self.check(1, NMR, *FAST, "-o", "a.csv", "--frames", "1", says=["a.csv", "--force"])
        self.assertEqual((self.folder / "a.csv").read_text(), "mine\n")

    def test_not_converged(self):
        self.check(3, NMR, *FAST, "--frames", "1", "--flow", "newton", "--max-steps", "1", "-o", "a.csv",
                   says="not converged: 1 frame")
        self.assertEqual(self.table()[0]["converged"], "no")
        self.check(3, NMR, *FAST, "--frames", "1", "--flow", "newton", "--max-steps", "1", "-o", "a.csv",
                   says=["1 done before", "not converged: 1 frame"])

    def test_wrong_calls(self):
        out = ("-o", "a.vdb")
        for text in ("0", "5-2", "1-3:0", "a", "1-2-3", "1:", "-3", "1-3:x"):
            self.check(2, NMR, f"--frames={text}", *out, says=["--frames", text])
        self.check(2, NMR, "--frames", "1", "--model", "2", *out, says="--model")
        self.check(2, NMR, "--frames", "1", "--turntable", "4", "-o", "a.png", says="--turntable")
        self.check(2, NMR, "--frames", "1", "-o", "-", "--format", "ply", says="-")
        self.check(2, NMR, "-o", "a.csv", says="--frames")
        self.check(2, NMR, "--fields", "v", *out, says="--frames")
        self.check(2, "batch", "list", "-O", "o", "--formats", "csv", says="csv")
        self.check(1, NMR, "--frames", "1-11", *out, says=["has no frame 11", "1-10"])
        self.check(1, NMR, "--frames", "20-", *out, says="has no frame 20")
        text = gzip.decompress(NMR.read_bytes()).decode()
        (self.folder / "hole.pdb").write_text(text.replace("MODEL        4", "MODEL       40"))
        self.check(1, "hole.pdb", "--frames", "1-6", *out, says=["no frame 4", "1-3,40,5-10"])
        lines = text.splitlines(keepends=True)
        place = next(i for i, line in enumerate(lines) if line.startswith("MODEL        3"))
        (self.folder / "few.pdb").write_text("".join(lines[:place + 5] + lines[place + 6:]))
        self.check(1, "few.pdb", *FAST, "--frames", "3-4", *out, says="frame 4: expected 1230")
        self.assertLessEqual(set(self.names()), {"hole.pdb", "few.pdb", "a.0001.vdb"})

    def test_models_without_good_numbers_are_counted(self):
        text = gzip.decompress(NMR.read_bytes()).decode()
        for number in ("0", "2"):
            (self.folder / "a.pdb").write_text(text.replace("MODEL        1", f"MODEL        {number}"))
            self.check(0, "a.pdb", *FAST, "--surface", "sas", "--frames", "1-3:2", "-o", "a.csv", "--force",
                       says="are counted from 1 to 10")
            self.check(0, NMR, *FAST, "--surface", "sas", "--frames", "1-3:2", "-o", "b.csv", "--force")
            areas = [[row["area"] for row in self.table(name)] for name in ("a.csv", "b.csv")]
            self.assertEqual(*areas)

    def test_a_run_that_ended_early(self):
        (self.folder / "t.dcd").write_bytes(dcd(self.moved(3), promised=5))
        self.check(0, CRAMBIN, *FAST, "--trajectory", "t.dcd", "-o", "a.csv",
                   says="t.dcd: its header tells of 5 frames, 3 are there")
        self.assertEqual(len(self.table()), 3)

    def test_bad_trajectories(self):
        def refuse(data, says, *words):
            (self.folder / "t.dcd").write_bytes(data)
            self.check(1, CRAMBIN, "--trajectory", "t.dcd", "-o", "a.vdb", *words,
                       says=["t.dcd", says])

        whole = dcd(self.moved(3))
        refuse(whole[:-100], "cut short: its header tells of 3 frames, 2 are whole")
        refuse(dcd(self.moved(3), promised=5)[:-100], "cut short: its header tells of 5 frames, 2 are whole")
        refuse(whole[:50], "cut short")
        refuse(b"nothing", "DCD")
        refuse(b"", "DCD")
        refuse(whole, "no frame 4, only 1-3", "--frames", "2-4")
        refuse(dcd([frame[:-1] for frame in self.moved(2)]), "expected the 327 atoms")
        broken = [list(frame) for frame in self.moved(1)]
        broken[0][4] = (float("nan"), 0, 0)
        refuse(dcd(broken), "atom 5")
        frames = XTC.read_bytes()
        refuse(frames[:-100], "cut short within frame 3")
        refuse(frames, "expected the 327 atoms of")
        out = ("-o", "a.vdb")
        self.check(1, NMR, "--trajectory", XTC, "--frames", "2-4", *out,
                   says=["1d3z.xtc", "no frame 4, only 1-3"])
        self.check(1, NMR, "--trajectory", XTC, "--frames", "4-", *out, says="no frame 4")
        damaged = bytearray(frames)
        damaged[60:64] = b"\x7f\xff\xff\xff"  # the least x above the greatest
        (self.folder / "t.dcd").write_bytes(damaged)
        self.check(1, NMR, "--trajectory", "t.dcd", *out, says=["t.dcd", "frame 1: is damaged"])
        self.check(1, CRAMBIN, "--trajectory", "none.dcd", "-o", "a.vdb", says="none.dcd")
        self.check(1, CRAMBIN, "--trajectory", ".", "-o", "a.vdb", says="folder")
        self.assertEqual(self.names(), ["t.dcd"])


if __name__ == "__main__":
    unittest.main()
