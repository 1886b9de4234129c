# SPDX-License-Identifier: MPL-2.0
"""--for, --center, --print-scale and --min-thickness: the .vdb and the meshes of other programs."""

import json
import re
import struct
import unittest

from needs import needs
from tool import CRAMBIN, DATA, FAST, ToolTest, read_ply

try:
    import pyopenvdb as vdb
except ImportError:
    vdb = None

DIMER = [DATA / "1a8o.cif.gz", "--assembly", "1"]


class Refused(ToolTest):
    def refuse(self, *words, says=()):
        self.check(2, CRAMBIN, "-o", "a.vdb", *words, says=says)
        self.assertEqual(self.names(), [])

    def test_for(self):
        for word in ("maya", "blender=", "blender=0", "blender=-1", "blender=mn", "blender=1x",
                     "houdini=nan", "=1"):
            self.refuse("--for", word, says=["--for", word])

    def test_sidecar_of_standard_output(self):
        self.check(2, CRAMBIN, "--for", "usd", "-o", "-", "--format", "vdb", says="--for usd")

    def test_two_vdb_of_one_sidecar(self):
        self.refuse("-o", "a.0001.vdb", "--for", "usd", says="a.usda")

    def test_print(self):
        for value in ("0", "-1", "x", "1e9"):
            self.refuse("-o", "a.stl", "--print-scale", value, says="--print-scale")
        self.refuse("-o", "a.stl", "--min-thickness", "1", says="--print-scale")
        for value in ("0", "-1", "x"):
            self.refuse("-o", "a.stl", "--print-scale", "1", "--min-thickness", value, says="--min-thickness")

    def test_existing_sidecar_stays(self):
        (self.folder / "a.usda").write_text("mine")
        self.check(1, CRAMBIN, "-o", "a.vdb", "--for", "usd", says=["a.usda", "--force"])
        self.check(1, CRAMBIN, "-o", "a.0001.vdb", "--for", "usd", says=["a.usda", "--force"])
        self.assertEqual(self.names(), ["a.usda"])
        self.assertEqual((self.folder / "a.usda").read_text(), "mine")


class Copies(ToolTest):
    def test_without_a_vdb_no_grid_is_asked_for(self):
        """By symmetry there is none; the mesh and the stage have colours all the same."""
        self.check(0, DATA / "1a8o.cif.gz", "--assembly", "1", "--by-symmetry", *FAST, "--for", "usd=nm", "-o", "a.usda",
                   "-o", "a.ply")
        self.assertIn(b"property uchar red", (self.folder / "a.ply").read_bytes())


@needs("openvdb")
class Grids(ToolTest):
    def grids(self, name):
        return {grid.name: grid for grid in
                (vdb.read(str(self.folder / name), g.name)
                 for g in vdb.readAllGridMetadata(str(self.folder / name)))}

    def origin(self, grid):
        return grid.transform.indexToWorld((0, 0, 0))

    def test_blender(self):
        self.check(0, CRAMBIN, *FAST, "-o", "plain.vdb")
        self.check(0, CRAMBIN, *FAST, "--for", "blender4=0.01", "-o", "a.vdb", "--fields",
                   "mean_curvature,gaussian_curvature,spline")
        plain, scaled = self.grids("plain.vdb"), self.grids("a.vdb")
        self.assertEqual(list(plain), ["surface"])
        self.assertEqual(set(scaled), {"surface", "density", "Cd", "mean_curvature",
                                       "gaussian_curvature", "spline"})
        self.assertEqual(self.origin(plain["surface"]), (0, 0, 0))
        for grid in scaled.values():
            self.assertAlmostEqual(grid.transform.voxelSize()[0], 0.01)
            for x in self.origin(grid):
                self.assertAlmostEqual(x, -0.005)
        a, b = plain["surface"], scaled["surface"]
        self.assertEqual(b.gridClass, vdb.GridClass.LEVEL_SET)
        self.assertAlmostEqual(b.background, 0.01 * a.background, places=6)
        self.assertEqual(a.activeVoxelCount(), b.activeVoxelCount())
        values = a.getConstAccessor()
        for item in b.citerOnValues():
            self.assertAlmostEqual(item.value, 0.01 * values.getValue(item.min), places=6)
        inside = [item for item in b.citerOffValues() if item.value < 0]
        self.assertTrue(inside)
        for item in inside:
            self.assertAlmostEqual(item.value, -b.background, places=7)

        fog = scaled["density"]
        self.assertEqual(fog.gridClass, vdb.GridClass.FOG_VOLUME)
        self.assertEqual(fog.background, 0)
        density = [item.value for item in fog.citerOnValues()]
        self.assertGreaterEqual(min(density), 0)
        self.assertEqual(max(density), 1)
        # Curvature is a number per length: a hundred times larger in units of 100 Å.
        self.check(0, CRAMBIN, *FAST, "-o", "b.vdb", "--fields",
                   "mean_curvature,gaussian_curvature,spline")
        for name, factor in (("mean_curvature", 1e2), ("gaussian_curvature", 1e4),
                             ("spline", 1e-2)):
            values = self.grids("b.vdb")[name].getConstAccessor()
            for item in scaled[name].citerOnValues():
                want = factor * values.getValue(item.min)
                self.assertAlmostEqual(item.value, want, delta=1e-5 * abs(want) + 1e-9)

    def test_houdini_is_openvdbs_convention(self):
        self.check(0, CRAMBIN, *FAST, "-o", "plain.vdb")
        self.check(0, CRAMBIN, *FAST, "--for", "houdini", "-o", "a.vdb")
        grids = self.grids("a.vdb")
        self.assertEqual(set(grids), {"surface", "density", "Cd"})
        for grid in grids.values():
            self.assertEqual(self.origin(grid), (0, 0, 0))
        self.assertEqual(grids["surface"].background, self.grids("plain.vdb")["surface"].background)

    def test_unreal_takes_fogs_in_one_box(self):
        """Of 0 to 1, with 16 bits and one transform; a unit is a centimetre."""
        self.check(0, CRAMBIN, *FAST, "--for", "unreal=2", "-o", "a.vdb")
        grids = self.grids("a.vdb")
        self.assertEqual(set(grids), {"density", "Cd"})
        boxes = {grid.evalActiveVoxelBoundingBox() for grid in grids.values()}
        self.assertEqual(len(boxes), 1)
        for grid in grids.values():
            self.assertEqual(grid.transform.voxelSize(), (2, 2, 2))
            self.assertTrue(grid.saveFloatAsHalf)
            self.assertEqual(self.origin(grid), (0, 0, 0))
        values = [item.value for item in grids["density"].citerOnValues()]
        self.assertEqual((min(values), max(values)), (0, 1))
        # The corners that make the box one are empty fog.
        self.check(0, CRAMBIN, *FAST, "--for", "houdini", "-o", "b.vdb")
        self.assertEqual(grids["density"].activeVoxelCount() - self.grids("b.vdb")["density"].activeVoxelCount(), 2)

    def test_levels_are_named_and_nested(self):
        self.check(0, CRAMBIN, *FAST, "--for", "arnold", "--mips", "2", "-o", "a.vdb")
        grids = self.grids("a.vdb")
        self.assertEqual(set(grids), {"surface"} | {f"{name}_level_{k}" for name in ("density", "Cd") for k in range(3)})
        sums = []
        for k in range(3):
            fog = grids[f"density_level_{k}"]
            self.assertEqual(fog.transform.voxelSize(), (2 ** k,) * 3)
            self.assertEqual(fog.gridClass, "fog volume")
            sums.append(8 ** k * sum(item.value * item.count for item in fog.citerOnValues()))
        for level in sums:
            self.assertAlmostEqual(level / sums[0], 1, delta=0.02)
        self.check(2, CRAMBIN, "--mips", "11", "-o", "b.vdb", says=["--mips", "0 to 10"])

    def test_labels_as_floats(self):
        """Old readers get the whole file, and convert the same surface."""
        words = [*DIMER, *FAST, "--fields", "atom_id,chain_id,density"]
        for kind in ("int", "float"):
            self.check(0, *words, "--ids", kind, "-o", f"{kind}.vdb")
            self.check(0, "convert", f"{kind}.vdb", "--color", "chain", "-o", f"{kind}.ply")
        self.assertEqual((self.folder / "int.ply").read_bytes(), (self.folder / "float.ply").read_bytes())
        grids, _ = vdb.readAll(str(self.folder / "float.vdb"))
        labels = {grid.name: grid for grid in grids}
        self.assertEqual(labels["chain_id"].valueTypeName, "float")
        self.assertEqual({item.value for item in labels["chain_id"].citerOnValues()}, {0, 1})
        box = labels["surface"].evalActiveVoxelBoundingBox()
        self.assertNotEqual(box, labels["density"].evalActiveVoxelBoundingBox())
        self.check(0, *words, "--ids", "float", "--one-box", "-o", "box.vdb")
        grids, _ = vdb.readAll(str(self.folder / "box.vdb"))
        self.assertEqual(len({grid.evalActiveVoxelBoundingBox() for grid in grids}), 1)

    def test_colors_fill_the_fog(self):
        self.check(0, *DIMER, *FAST, "--for", "blender", "-o", "a.vdb")
        grids = self.grids("a.vdb")
        colors = grids["Cd"].getConstAccessor()
        seen = set()
        for item in grids["density"].citerOnValues():
            self.assertTrue(colors.isValueOn(item.min))
            seen.add(tuple(round(c, 3) for c in colors.getValue(item.min)))
        self.assertEqual(len(seen), 2)

    def test_colors_by_curvature(self):
        self.check(0, CRAMBIN, *FAST, "--for", "blender", "--color", "mean-curvature", "-o", "a.vdb")
        grids = self.grids("a.vdb")
        self.assertEqual(set(grids), {"surface", "density", "Cd"})
        self.assertGreater(len({item.value for item in grids["Cd"].citerOnValues()}), 50)

    def test_center(self):
        self.check(0, CRAMBIN, *FAST, "-o", "a.ply", "-o", "a.vdb", "-o", "a.json")
        self.check(0, CRAMBIN, *FAST, "--center", "-o", "b.ply", "-o", "b.vdb", "-o", "b.json")
        self.assertIsNone(json.loads((self.folder / "a.json").read_text())["center"])
        center = json.loads((self.folder / "b.json").read_text())["center"]
        a, b = (read_ply((self.folder / f"{name}.ply").read_bytes())[1] for name in "ab")
        for p, q in zip(a, b):
            for i in range(3):
                self.assertAlmostEqual(p[i] - center[i], q[i], places=4)
        for i in range(3):
            self.assertAlmostEqual(min(q[i] for q in b), -max(q[i] for q in b), places=4)
            self.assertAlmostEqual(self.origin(self.grids("b.vdb")["surface"])[i], -center[i])

    def test_compare_refuses_what_was_moved(self):
        self.check(0, CRAMBIN, *FAST, "--for", "blender4", "-o", "a.vdb", "-o", "a.ply")
        self.check(1, "compare", "a.vdb", "a.ply", says=["a.vdb", "--for"])

    def test_metadata_tells_the_scene(self):
        self.check(0, CRAMBIN, *FAST, "--for", "blender=nm", "-o", "a.vdb")
        data = vdb.readMetadata(str(self.folder / "a.vdb"))
        self.assertEqual(data["option.for"], "blender")
        self.assertEqual(data["scene.units_per_angstrom"], 0.1)
        self.assertEqual(data["scene.shift_in_voxels"], 0)
        self.check(0, CRAMBIN, *FAST, "--for", "blender4=nm", "-o", "b.vdb")
        self.assertEqual(vdb.readMetadata(str(self.folder / "b.vdb"))["scene.shift_in_voxels"], -0.5)

    def test_fog_looks_the_same_in_every_unit(self):
        """The sum of density times the length of a voxel, along x, is that in Å."""
        depths = []
        for word, scale in (("usd", 1), ("houdini=nm", 0.1), ("blender=mn-0.01", 0.01)):
            self.check(0, CRAMBIN, *FAST, "--for", word, "--fog-density", "0.5", "-o", "a.vdb", "--force")
            fog = self.grids("a.vdb")["density"]
            self.assertAlmostEqual(max(item.value for item in fog.citerOnValues()) * scale, 0.5, places=5)
            depths.append(sum(item.value * item.count for item in fog.citerOnValues()) * fog.transform.voxelSize()[0])
        for depth in depths:
            self.assertAlmostEqual(depth / depths[0], 1, places=5)
        self.check(2, CRAMBIN, "--fog-density", "1", "-o", "a.vdb", says="--for")


class Usd(ToolTest):
    def test_one_file(self):
        self.check(0, CRAMBIN, *FAST, "--for", "usd=0.1", "-o", "a b.vdb")
        self.assertEqual(self.names(), ["a b.usda", "a b.vdb"])
        text = (self.folder / "a b.usda").read_text()
        self.assertTrue(text.startswith("#usda 1.0\n("))
        for mark in ("()", "{}", "[]"):
            self.assertEqual(text.count(mark[0]), text.count(mark[1]))
        self.assertIn('defaultPrim = "a_b"', text)
        self.assertRegex(text, r"metersPerUnit = 1e-0?9\n|metersPerUnit = 9\.99+\d*e-10|"
                               r"metersPerUnit = 1\.0+\d*e-0?9\n")
        self.assertEqual(text.count("asset filePath = @./a b.vdb@"), 3)
        self.assertNotIn("timeSamples", text)
        self.assertEqual(re.findall(r"float inputs:scattering = (\S+)", text), ["5"])  # 0.5 for an Å
        for name, kind in (("surface", "levelSet"), ("density", "fogVolume"), ("Cd", "unknown")):
            self.assertIn(f"rel field:{name} = </a_b/volume/{name}>", text)
            self.assertRegex(text, rf'def OpenVDBAsset "{name}"\s*{{\s*token fieldName = "{name}"\s*'
                                   rf'token fieldClass = "{kind}"')

    def test_sequence(self):
        for frame in (1, 2, 10):
            self.check(0, CRAMBIN, *FAST, "--for", "usd", "-o", f"a.{frame:04}.vdb")
        self.assertEqual(self.names(), ["a.0001.vdb", "a.0002.vdb", "a.0010.vdb", "a.usda"])
        text = (self.folder / "a.usda").read_text()
        self.assertIn("startTimeCode = 1\n", text)
        self.assertIn("endTimeCode = 10\n", text)
        samples = re.findall(r"(\d+): @\./(a\.\d+\.vdb)@,", text)
        self.assertEqual(samples, 3 * [("1", "a.0001.vdb"), ("2", "a.0002.vdb"),
                                       ("10", "a.0010.vdb")])


def stl_volume(data):
    count, = struct.unpack("<I", data[80:84])
    volume = 0.0
    for at in range(84, 84 + 50 * count, 50):
        a, b, c = (struct.unpack("<3f", data[at + 12 * k:at + 12 * k + 12]) for k in (1, 2, 3))
        volume += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                   a[2] * (b[0] * c[1] - b[1] * c[0])) / 6
    return volume


class Print(ToolTest):
    def test_millimetres(self):
        self.check(0, CRAMBIN, *FAST, "-o", "a.stl", "-o", "a.obj")
        self.check(0, CRAMBIN, *FAST, "--print-scale", "0.5", "-o", "b.stl", "-o", "b.obj", "-o",
                   "b.ply")
        a, b = ((self.folder / f"{n}.stl").read_bytes() for n in "ab")
        self.assertTrue(a.startswith(b"binary STL, lengths in Angstrom\0"))
        self.assertTrue(b.startswith(b"binary STL, lengths in mm\0"))
        self.assertAlmostEqual(stl_volume(b) / stl_volume(a), 0.125, places=5)
        first = (self.folder / "a.obj").read_text().splitlines()
        second = (self.folder / "b.obj").read_text().splitlines()
        self.assertEqual(second[0], "# lengths in mm")
        for p, q in zip(first[:50], second[1:51]):
            for x, y in zip(p.split()[1:], q.split()[1:]):
                self.assertAlmostEqual(0.5 * float(x), float(y), places=5)
        _, vertices, _ = read_ply((self.folder / "b.ply").read_bytes())
        self.assertAlmostEqual(vertices[0][0], float(first[0].split()[1]), places=4)

    @needs("openvdb")
    def test_grids_say_what_their_vectors_are(self):
        """Directions turn with the object, and colours have a space, by whatever they are made."""
        self.check(0, CRAMBIN, *FAST, "--fields", "surface,spline,principal_direction_1,Cd,chain_id", "-o", "a.vdb")
        self.check(0, CRAMBIN, *FAST, "--fields", "surface,Cd", "--color", "mean-curvature", "-o", "b.vdb")
        self.check(0, "convert", "a.vdb", "--color", "chain", "-o", "c.vdb")
        self.assertEqual(vdb.read(str(self.folder / "a.vdb"), "principal_direction_1").vectorType,
                         "contravariant relative")
        for name in "abc":
            self.assertEqual(vdb.read(str(self.folder / f"{name}.vdb"), "Cd")["color_space"], "lin_rec709")

    def test_walls_are_millimetres_of_the_print(self):
        self.check(0, CRAMBIN, *FAST, "--print-scale", "2", "--min-thickness", "3", "-o", "wall.vdb", "-o", "wall.stl")
        self.assertRegex(self.check(0, "info", "wall.vdb").stdout.decode(), r"option\.min-thickness +1\.5\n")

    def test_a_thread_gets_the_wall(self):
        """Two large balls and a row of small ones between them."""
        balls = ["0 0 0 4", "20 0 0 4"] + [f"{x} 0 0 0.6" for x in range(4, 17)]
        (self.folder / "a.xyzr").write_text("\n".join(balls) + "\n")
        thread = {}
        for name, words in (("thin", []), ("thick", ["--min-thickness", "3"])):
            self.check(0, "a.xyzr", "--surface", "vdw", "--voxel", "0.25", "--print-scale", "1",
                       *words, "-o", f"{name}.ply", "-o", f"{name}.json")
            _, vertices, _ = read_ply((self.folder / f"{name}.ply").read_bytes())
            middle = [(v[1] ** 2 + v[2] ** 2) ** 0.5 for v in vertices if 8 < v[0] < 12]
            thread[name] = (min(middle), max(middle))
            report = json.loads((self.folder / f"{name}.json").read_text())["surface"]
            self.assertTrue(report["closed"] and report["manifold"])
            # What is thick stays as it is: the far poles of the balls.
            self.assertAlmostEqual(min(v[0] for v in vertices), -4, delta=0.03)
            self.assertAlmostEqual(max(abs(v[1]) for v in vertices), 4, delta=0.03)
        self.assertLess(thread["thin"][1], 0.7)
        self.assertGreater(thread["thick"][0], 1.5 - 0.1)
        self.assertLess(thread["thick"][1], 1.5 + 0.25)

    def test_no_triangle_of_a_wall_is_empty(self):
        """Walls of 4 Å are eight voxels wide: voxels lie at whole distances from those in their middle."""
        for kind in ("ses", "vdw", "gaussian"):
            self.check(0, CRAMBIN, "--surface", kind, "--print-scale", "0.5", "--min-thickness", "2", "-o", "a.stl", "--force")
            stl = (self.folder / "a.stl").read_bytes()
            corners = [{stl[at + 12 * k:at + 12 * (k + 1)] for k in (1, 2, 3)} for at in range(84, len(stl), 50)]
            self.assertGreater(len(corners), 10000)
            self.assertEqual([three for three in corners if len(three) < 3], [], kind)


if __name__ == "__main__":
    unittest.main()
