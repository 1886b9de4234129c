# SPDX-License-Identifier: MPL-2.0
"""OpenUSD itself opens the .usda files, finds nothing wrong, and has in them what the other files of the run have."""

import json
import math
import pathlib
import subprocess
import unittest

from needs import USD_PYTHON, needs
from test_instances import ATOM, QUICK, UNIT, assembly, placed
from test_meshes import read_glb
from test_symmetry import biomt
from tool import CRAMBIN, DATA, FAST, ToolTest, read_ply

SCRIPT = pathlib.Path(__file__).resolve().parent / "usd_stage.py"
DIMER = [DATA / "1a8o.cif.gz", "--assembly", "1"]


class Usd(ToolTest):
    def stages(self, *names):
        """What OpenUSD reads: for each file {variant: scene}, "" being the file as it opens."""
        done = subprocess.run([USD_PYTHON, SCRIPT, *names], cwd=self.folder, capture_output=True, text=True,
                              timeout=300)
        lines = [line for line in done.stdout.splitlines() if line.startswith("RESULT ")]
        self.assertEqual(len(lines), 1, done.stdout + done.stderr)
        self.assertEqual(done.stderr, "")
        stages = json.loads(lines[0][len("RESULT "):])
        for scenes in stages:
            for variant, scene in scenes.items():
                self.assertEqual((scene["faults"], scene["up"]), ([], "Z"), variant)
        return stages

    def assert_near(self, a, b, delta):
        for p, q in zip(a, b, strict=True):
            self.assertAlmostEqual(p, q, delta=delta)

    def box_of(self, name, scale=1.0):
        _, vertices, _ = read_ply((self.folder / name).read_bytes())
        return [[scale * f(v[i] for v in vertices) for i in range(3)] for f in (min, max)]


@needs("usd")
class Copies(Usd):
    def check_copies(self, scene, scale=1.0):
        """The meshes are those of a.ply, one distinct copy, and lie where the matrices of a.json place them."""
        self.assertAlmostEqual(scene["meters"] * scale / 1e-10, 1)
        copies, entries = scene["copies"], json.loads((self.folder / "a.json").read_text())["instances"]
        _, vertices, triangles = read_ply((self.folder / "a.ply").read_bytes())
        self.assertEqual(len(copies["matrices"]), len(entries))
        self.assertEqual(len(copies["meshes"]), scene["meshes"])  # all meshes are prototypes
        self.assertEqual(copies["ids"], list(range(1, len(entries) + 1)))
        for mesh in copies["meshes"]:
            self.assertEqual(mesh["triangles"], [v for three in triangles for v in three])
            self.assertEqual((mesh["corners"], mesh["normals"]), ([3], len(vertices)))
            self.assertEqual(len(mesh["points"]), len(vertices))
        box = [[math.inf] * 3, [-math.inf] * 3]
        for number, matrix, entry in zip(copies["part"], copies["matrices"], entries):
            for p, v in list(zip(copies["meshes"][number]["points"], vertices))[::7]:
                seen, want = ([scale * x for x in placed(entry["matrix"], v[:3])], placed(matrix, p))
                self.assertLess(math.dist(seen, want), 2e-3 * scale)
            for v in vertices:
                where = placed(entry["matrix"], v[:3])
                box = [[f(a, scale * b) for a, b in zip(side, where)] for f, side in zip((min, max), box)]
        size = math.dist(*box)
        for side, limit, sign in zip(copies["box"], box, (1, -1)):  # OpenUSD's box is around turned boxes
            for a, b in zip(side, limit):
                self.assertTrue(-0.3 * size < sign * (a - b) < 1e-4 * size, (copies["box"], box))
        return copies

    def run_copies(self, *words):
        outputs = [word for end in ("json", "glb", "ply", "usda") for word in ("-o", f"a.{end}")]
        self.check(0, *words, *outputs, "--force")

    def test_assemblies(self):
        for kind in ("icosahedral", "cyclic", "dihedral", "helical"):
            with self.subTest(kind):
                text = "".join(ATOM.format(i, i, *x) for i, x in enumerate(UNIT, 1))
                (self.folder / "a.pdb").write_text(biomt(assembly(kind)) + text)
                self.run_copies("a.pdb", "--assembly", "1", "--instances", *QUICK, *FAST, "--color", "copy")
                copies = self.check_copies(self.stages("a.usda")[0][""])
                # A colour is shown the same by the material, by those that show no materials, and in the .glb.
                document, _ = read_glb((self.folder / "a.glb").read_bytes())
                for number, node in zip(copies["part"], document["nodes"][1:]):
                    mesh, primitive = copies["meshes"][number], document["meshes"][node["mesh"]]["primitives"][0]
                    color = document["materials"][primitive["material"]]["pbrMetallicRoughness"]["baseColorFactor"][:3]
                    self.assert_near(mesh["material"], color, 1e-3)
                    self.assertEqual(mesh["interpolation"], "constant")
                    self.assert_near(mesh["colors"][0], color, 1e-3)

    def test_colors_of_vertices(self):
        for color in ("chain", "mean-curvature"):
            self.run_copies(*DIMER, "--instances", *FAST, "--color", color, "--for", "usd=nm")
            copies = self.check_copies(self.stages("a.usda")[0][""], 0.1)
            for mesh in copies["meshes"]:
                self.assertEqual((mesh["material"], mesh["interpolation"]), ("displayColor", "vertex"))
                self.assertEqual(len(mesh["colors"]), len(mesh["points"]))

    def test_levels(self):
        self.run_copies(*DIMER, "--instances", "--lod", "1,2,4", "--color", "copy")
        scenes, = self.stages("a.usda")
        self.assertEqual(list(scenes), ["", "lod0", "lod1", "lod2"])
        self.assertEqual(scenes[""], scenes["lod0"])
        self.check_copies(scenes["lod0"])
        counts = [len(scenes[f"lod{n}"]["copies"]["meshes"][0]["triangles"]) for n in range(3)]
        self.assertTrue(counts[0] > 2 * counts[1] > 4 * counts[2], counts)
        self.assertEqual([scenes[f"lod{n}"]["meshes"] for n in range(3)], [2, 2, 2])
        for n in (1, 2):  # coarser ones are where the finest is
            for a, b in zip(scenes[f"lod{n}"]["copies"]["box"], scenes["lod0"]["copies"]["box"]):
                self.assert_near(a, b, 2.0 ** n)  # its voxel

    def test_units_of_a_whole(self):
        self.check(0, *DIMER, "--by-symmetry", *FAST, "--color", "copy", "-o", "a.usda")
        self.check(0, *DIMER, *FAST, "-o", "whole.ply", "-o", "whole.json")
        copies = self.stages("a.usda")[0][""]["copies"]
        points = [placed(matrix, p) for number, matrix in zip(copies["part"], copies["matrices"])
                  for p in copies["meshes"][number]["points"]]
        self.assertEqual(len(copies["matrices"]), 2)
        for f, side in zip((min, max), self.box_of("whole.ply")):
            self.assert_near([f(p[i] for p in points) for i in range(3)], side, 0.2)


@needs("usd")
class Volumes(Usd):
    def test_fields(self):
        """Names with blanks and marks, scales, and every kind of grid."""
        fields = ["--fields", "mean_curvature,atom_id", "--color", "mean-curvature"]
        for name, word, scale in (("a b@", "usd", 1), ("1-é", "usd=nm", 0.1), ("c", "usd=0.37", 0.37)):
            self.check(0, CRAMBIN, *FAST, *fields, "--for", word, "-o", f"{name}.vdb", "-o", "a.ply", "--force")
            scene = self.stages(f"{name}.usda")[0][""]
            self.assertAlmostEqual(scene["meters"] * scale / 1e-10, 1)
            found = scene["volume"]["fields"]
            self.assertEqual({field: (data["name"], data["class"], data["type"]) for field, data in found.items()},
                             {"surface": ("surface", "levelSet", "float"), "density": ("density", "fogVolume", "float"),
                              "Cd": ("Cd", "unknown", "float3"), "mean_curvature": ("mean_curvature", "unknown", "float"),
                              "atom_id": ("atom_id", "unknown", "int")})
            for data in found.values():
                self.assertEqual(data["files"], [[None, str(self.folder.resolve() / f"{name}.vdb")]])
            for side, limit, sign in zip(scene["volume"]["extent"], self.box_of("a.ply", scale), (1, -1)):
                for a, b in zip(side, limit):
                    self.assertTrue(-5 * scale < sign * (a - b) < 0, (side, limit))

    def test_fog_has_a_material(self):
        for words, scattering in ((("--for", "usd"), 0.5), (("--for", "usd=nm"), 5), (("--for", "usd=nm", "--fog-density", "0.2"), 1)):
            self.check(0, CRAMBIN, *FAST, *words, "-o", "a.vdb", "--force")
            scenes, = self.stages("a.usda")
            self.assertEqual(list(scenes), ["", "materialx", "plain"])
            self.assertEqual([scenes[name]["volume"]["shader"] for name in scenes], [None, "ND_volume", None])
            self.assertAlmostEqual(scenes[""]["volume"]["scattering"], scattering, delta=1e-6)

    def test_copies(self):
        """A volume that all copies share lies where the matrices place them."""
        self.check(0, *DIMER, "--instances", *FAST, "--for", "usd=nm", "-o", "a.vdb", "-o", "a.json")
        scene = self.stages("a.usda")[0][""]
        entries = json.loads((self.folder / "a.json").read_text())["instances"]
        self.assertEqual((len(entries), scene["copies"]["ids"]), (2, [1, 2]))
        for matrix, entry in zip(scene["copies"]["matrices"], entries, strict=True):
            for point in ((0, 0, 0), (30, 0, 0), (0, 30, 0), (0, 0, 30)):
                self.assert_near(placed(matrix, [0.1 * x for x in point]), [0.1 * x for x in placed(entry["matrix"], point)], 2e-3)
        self.assertEqual(set(scene["volume"]["fields"]), {"surface", "density", "Cd"})

    def test_groups(self):
        self.check(0, *DIMER, *FAST, "--group-by", "chain", "--split", "group", "--for", "usd", "-o", "a.vdb")
        fields = self.stages("a.usda")[0][""]["volume"]["fields"]
        self.assertLessEqual({"surface_A", "density_A"}, set(fields))

    def test_frames(self):
        """Of a sequence each frame has its file and its extent, in whatever order they are made."""
        boxes = {}
        for frame, surface in ((10, "vdw"), (2, "vdw"), (1, "ses"), (2, "sas")):
            self.check(0, CRAMBIN, *FAST, "--surface", surface, "--for", "usd", "-o", f"a.{frame:04}.vdb", "--force")
            self.check(0, CRAMBIN, *FAST, "--surface", surface, "--for", "usd", "-o", "one.vdb", "--force")
            boxes[frame] = self.stages("one.usda")[0][""]["volume"]["extent"]
        scene = self.stages("a.usda")[0][""]
        self.assertNotEqual(boxes[1], boxes[2])
        self.assertEqual(scene["times"], [1, 10])
        for data in scene["volume"]["fields"].values():
            self.assertEqual(data["files"], [[n, str(self.folder.resolve() / f"a.{n:04}.vdb")] for n in (1, 2, 10)])
        self.assertEqual(scene["volume"]["extent"], [[n, boxes[n]] for n in (1, 2, 10)])


@needs("usd")
class Meshes(Usd):
    def check_shape(self, shape, name, scale=1.0):
        """It is the mesh of a .ply. Returns names and values of the vertices there."""
        names, vertices, triangles = read_ply((self.folder / name).read_bytes())
        self.assertEqual(shape["triangles"], [v for three in triangles for v in three])
        self.assertEqual((shape["normals"], shape["whole"]), (len(vertices), True))
        for a, b in zip(shape["points"], vertices, strict=True):
            self.assert_near(a, [scale * x for x in b[:3]], 1e-3)
        return names, vertices

    def test_one(self):
        for words, scale, colors in (((), 1.0, 0), (("--for", "usd=nm", "--color", "element"), 0.1, 1)):
            self.check(0, CRAMBIN, *FAST, *words, "-o", "a.usda", "-o", "a.ply", "--force")
            scene = self.stages("a.usda")[0][""]
            self.assertAlmostEqual(scene["meters"] * scale / 1e-10, 1)
            (shape,), = scene["shapes"]
            _, vertices = self.check_shape(shape, "a.ply", scale)
            self.assertEqual((shape["time"], shape["shader"], shape["colors"]),
                             (None, "UsdPreviewSurface", colors * len(vertices)))
            self.assertEqual((scene["times"], shape["velocities"]), (None, []))

    def test_parts(self):
        self.check(0, *DIMER, *FAST, "--group-by", "chain", "--split", "group", "-o", "a.usda", "-o", "a.glb")
        scene = self.stages("a.usda")[0][""]
        document, _ = read_glb((self.folder / "a.glb").read_bytes())
        self.assertEqual(scene["names"], [mesh["name"] for mesh in document["meshes"]])
        self.assertEqual([len(shape["triangles"]) for shape, in scene["shapes"]],
                         [document["accessors"][mesh["primitives"][0]["indices"]]["count"] for mesh in document["meshes"]])

    def test_film(self):
        """Each frame is a mesh of its own, with other triangles; half a frame later points have moved by velocities."""
        words = [DATA / "1d3z.pdb.gz", *FAST, "--first-frame", "1001", "--fields", "v", "--color", "element",
                 "-o", "a.usda", "-o", "a.ply"]
        for more, rate in (((), 24), (("--fps", "25", "--for", "usd=nm"), 25)):
            self.check(0, *words, *more, "--frames", "1-3", "--force")
            film, frame = (scenes[""] for scenes in self.stages("a.usda", "a.1002.usda"))
            self.assertEqual(film["times"], [1001, 1003])
            shapes, = film["shapes"]
            self.assertEqual(frame["shapes"], [[shapes[1]]])
            self.assertEqual(len({len(shape["points"]) for shape in shapes}), 3)
            for time, shape in zip((1001, 1002, 1003), shapes, strict=True):
                names, vertices = self.check_shape(shape, f"a.{time}.ply", 0.1 if more else 1.0)
                self.assertEqual((shape["time"], shape["colors"], shape["interpolation"]), (time, len(vertices), "vertex"))
                at, factor = [names.index(f"v_{axis}") for axis in "xyz"], 1 if more else rate
                self.assertGreater(max(math.hypot(*v) for v in shape["velocities"]), rate)
                for here, late, way, v in zip(shape["here"], shape["late"], shape["velocities"], vertices, strict=True):
                    self.assert_near(way, [factor * v[i] for i in at], 1e-3)
                    self.assert_near(late, [x + 0.5 * w / rate for x, w in zip(here, way)], 1e-3)
        self.check(0, *words[:-4], "-o", "b.usda", "--frames", "1")
        self.assertEqual(len(self.stages("b.usda")[0][""]["shapes"][0]), 1)


if __name__ == "__main__":
    unittest.main()
