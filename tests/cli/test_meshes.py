# SPDX-License-Identifier: MPL-2.0
""".glb, .off and .3mf hold the mesh of the .ply."""

import json
import math
import pathlib
import re
import struct
import subprocess
import unittest
import xml.etree.ElementTree
import zipfile

from needs import NODE, NODE_ENVIRONMENT, needs
from tool import CRAMBIN, DATA, FAST, ToolTest, read_ply

VALIDATE = pathlib.Path(__file__).resolve().parent / "gltf_validate.js"


def read_glb(data):
    """(the JSON, the bytes)."""
    magic, version, size, length = struct.unpack("<4sIII", data[:16])
    assert (magic, version, size) == (b"glTF", 2, len(data))
    assert data[16:20] == b"JSON"
    header = json.loads(data[20:20 + length])
    rest = data[20 + length:]
    assert rest[4:8] == b"BIN\0"
    return header, rest[8:8 + struct.unpack("<I", rest[:4])[0]]


def accessor(document, body, number):
    """The elements of an accessor, as tuples."""
    entry = document["accessors"][number]
    view = document["bufferViews"][entry["bufferView"]]
    letter = {5126: "f", 5125: "I", 5123: "H"}[entry["componentType"]]
    size = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}[entry["type"]]
    part = body[view["byteOffset"]:view["byteOffset"] + view["byteLength"]]
    values = list(struct.iter_unpack(f"<{size}{letter}", part))
    assert len(values) == entry["count"]
    return values


def linear(value):
    s = value / 255
    return s / 12.92 if s <= 0.04045 else ((s + 0.055) / 1.055) ** 2.4


class Glb(ToolTest):
    def test_holds_the_mesh(self):
        self.check(0, CRAMBIN, *FAST, "--color", "element", "-o", "a.glb", "-o", "a.ply")
        document, body = read_glb((self.folder / "a.glb").read_bytes())
        names, vertices, triangles = read_ply((self.folder / "a.ply").read_bytes())
        primitive, = document["meshes"][0]["primitives"]
        attributes = primitive["attributes"]
        self.assertLessEqual({"POSITION", "NORMAL", "COLOR_0", "_MEAN_CURVATURE",
                              "_GAUSSIAN_CURVATURE", "_ATOM_ID", "_CHAIN_ID"}, set(attributes))

        def column(*which):
            return [tuple(v[names.index(w)] for w in which) for v in vertices]

        self.assertEqual(accessor(document, body, attributes["POSITION"]), column("x", "y", "z"))
        # A viewer places its camera by these.
        box = document["accessors"][attributes["POSITION"]]
        axes = list(zip(*column("x", "y", "z")))
        for ends, end in (("min", min), ("max", max)):
            for told, values in zip(box[ends], axes):
                self.assertAlmostEqual(told, end(values), places=4)
        self.assertEqual(accessor(document, body, attributes["_MEAN_CURVATURE"]),
                         column("mean_curvature"))
        self.assertEqual(accessor(document, body, attributes["_ATOM_ID"]), column("atom_id"))
        for n, m in zip(accessor(document, body, attributes["NORMAL"]), column("nx", "ny", "nz")):
            self.assertAlmostEqual(math.dist(n, m), 0, places=5)
        for c, d in zip(accessor(document, body, attributes["COLOR_0"]),
                        column("red", "green", "blue")):
            self.assertEqual(c[3], 65535)
            for x, y in zip(c, d):
                self.assertAlmostEqual(x / 65535, linear(y), places=4)
        flat = [i for i, in accessor(document, body, primitive["indices"])]
        self.assertEqual([tuple(flat[i:i + 3]) for i in range(0, len(flat), 3)], triangles)
        # z becomes y: a quarter turn about x.
        x, y, z, w = document["nodes"][0]["rotation"]
        self.assertAlmostEqual(x, -math.sqrt(0.5))
        self.assertEqual((y, z), (0, 0))
        self.assertAlmostEqual(w, math.sqrt(0.5))
        self.assertNotIn("scale", document["nodes"][0])

    def test_scale_is_in_the_node(self):
        self.check(0, CRAMBIN, *FAST, "--for", "blender=nm", "-o", "a.glb")
        document, _ = read_glb((self.folder / "a.glb").read_bytes())
        self.assertEqual(document["nodes"][0]["scale"], [0.1, 0.1, 0.1])

    def test_parts_are_nodes(self):
        self.check(0, DATA / "1a8o.cif.gz", "--assembly", "1", *FAST, "--group-by", "copy", "--split",
                   "group", "-o", "a.glb", "-o", "a.json")
        document, body = read_glb((self.folder / "a.glb").read_bytes())
        report = json.loads((self.folder / "a.json").read_text())
        self.assertEqual([node["name"] for node in document["nodes"]], ["a", "copy 1", "copy 2"])
        for mesh, part in zip(document["meshes"], report["parts"]):
            primitive, = mesh["primitives"]
            count = document["accessors"][primitive["attributes"]["POSITION"]]["count"]
            self.assertEqual(count, part["surface"]["vertices"])
            indices = accessor(document, body, primitive["indices"])
            self.assertEqual(len(indices), 3 * part["surface"]["triangles"])
            self.assertEqual(max(indices)[0], count - 1)

    def test_instances(self):
        """Two nodes share the numbers of one copy, and lie where the copies do."""
        dimer = [DATA / "1a8o.cif.gz", "--assembly", "1", *FAST]
        self.check(0, *dimer, "--instances", "--color", "copy", "-o", "a.glb", "-o", "a.json",
                   says="1 prototype for 2 copies")
        document, body = read_glb((self.folder / "a.glb").read_bytes())
        report = json.loads((self.folder / "a.json").read_text())
        self.check(0, *dimer, "--group-by", "copy", "--split", "group", "-o", "whole.glb")
        whole, _ = read_glb((self.folder / "whole.glb").read_bytes())
        first, second = (mesh["primitives"][0] for mesh in document["meshes"])
        self.assertEqual(first["attributes"], second["attributes"])
        self.assertEqual(first["indices"], second["indices"])
        colors = [material["pbrMetallicRoughness"]["baseColorFactor"]
                  for material in document["materials"]]
        self.assertNotEqual(*colors)
        points = accessor(document, body, first["attributes"]["POSITION"])
        copies = document["nodes"][1:]
        self.assertEqual(document["nodes"][0]["children"], [1, 2])
        self.assertEqual([node["mesh"] for node in copies], [0, 1])
        self.assertEqual([entry["part"] for entry in report["instances"]], [0, 0])
        for node, entry, mesh in zip(copies, report["instances"], whole["meshes"]):
            x, y, z, w = node["rotation"]
            turn = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                    [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                    [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
            box = whole["accessors"][mesh["primitives"][0]["attributes"]["POSITION"]]
            for row in range(3):
                matrix = entry["matrix"][row]
                for a, b in zip([*turn[row], node["translation"][row]], matrix):
                    self.assertAlmostEqual(a, b, places=4)
                moved = [sum(m * p for m, p in zip(matrix, point)) + matrix[3] for point in points]
                self.assertAlmostEqual(min(moved), box["min"][row], delta=0.5)
                self.assertAlmostEqual(max(moved), box["max"][row], delta=0.5)

    def test_instances_of_two_prototypes(self):
        lines = []
        for number, chain, shifts in ((1, "A", (0, 30)), (1, "B", (0, 30, 60))):
            lines.append(f"REMARK 350 APPLY THE FOLLOWING TO CHAINS: {chain}\n")
            for n, shift in enumerate(shifts):
                for row in range(3):
                    unit = [float(row == column) for column in range(3)]
                    lines.append("REMARK 350   BIOMT%d %3d %9.6f %9.6f %9.6f %14.5f\n"
                                 % (row + 1, n + 1, *unit, shift if row == 0 else 0.0))
        atom = "ATOM      1  CA  ALA {}   1    {:8.3f}   0.000   0.000  1.00  0.00           C\n"
        text = ["REMARK 350 BIOMOLECULE: 1\n", *lines, atom.format("A", 1), atom.format("B", 2), "END\n"]
        (self.folder / "two.pdb").write_text("".join(text))
        self.check(0, "two.pdb", "--assembly", "1", "--instances", "-o", "a.glb", "-o", "a.json")
        document, _ = read_glb((self.folder / "a.glb").read_bytes())
        report = json.loads((self.folder / "a.json").read_text())
        self.assertEqual([part["atoms"] for part in report["parts"]], [2, 1])
        self.assertEqual([node["mesh"] for node in document["nodes"][1:]], [0, 0, 1])
        self.assertEqual([node["translation"][0] for node in document["nodes"][1:]], [0, 30, 60])

    def test_instances_need_an_assembly(self):
        self.check(2, CRAMBIN, "--instances", "-o", "a.glb", says="--assembly")
        self.check(2, CRAMBIN, "--color", "copy", "-o", "a.glb", says="--assembly")
        for option in (["--memory", "1G"], ["--interfaces"], ["--center"]):
            self.check(2, DATA / "1a8o.cif.gz", "--assembly", "1", "--instances", *option, "-o",
                       "a.glb", says=[option[0], "together"])
        self.check(0, DATA / "1a8o.cif.gz", "-o", "a.json", *FAST,
                   says="assembly 1 has 2 copies [hint: --assembly 1]")

    @needs("gltf-validator")
    def test_khronos_validator(self):
        dimer = [DATA / "1a8o.cif.gz", "--assembly", "1"]
        for words in ([], ["--color", "chain"], ["--group-by", "copy", "--split", "group"],
                      ["--for", "blender=mn-0.01", "--fields", "shape_index"],
                      ["--instances", "--color", "copy"],
                      ["--instances", "--color", "copy", "--lod", "1,2,4"]):
            voxel = [] if "--lod" in words else FAST
            self.check(0, *dimer, *voxel, *words, "-o", "a.glb", "--force")
            done = subprocess.run([NODE, str(VALIDATE), "a.glb"], cwd=self.folder, check=True,
                                  capture_output=True, text=True, env=NODE_ENVIRONMENT)
            issues = json.loads(done.stdout)
            self.assertEqual((issues["numErrors"], issues["numWarnings"]), (0, 0), done.stdout)


class Off(ToolTest):
    def test_holds_the_mesh(self):
        for words, first in (([], "OFF"), (["--color", "chain"], "COFF")):
            self.check(0, CRAMBIN, *FAST, *words, "-o", "a.off", "-o", "a.ply", "--force")
            names, vertices, triangles = read_ply((self.folder / "a.ply").read_bytes())
            lines = (self.folder / "a.off").read_text().splitlines()
            self.assertEqual(lines[0], first)
            self.assertEqual(lines[1], f"{len(vertices)} {len(triangles)} 0")
            self.assertEqual(len(lines), 2 + len(vertices) + len(triangles))
            for line, vertex in zip(lines[2:], vertices):
                numbers = line.split()
                for text, value in zip(numbers[:3], vertex):
                    self.assertAlmostEqual(float(text), value, places=4)
                if first == "COFF":
                    red = names.index("red")
                    self.assertEqual(numbers[3:], [*map(str, vertex[red:red + 3]), "255"])
            for line, corners in zip(lines[2 + len(vertices):], triangles):
                self.assertEqual(line, "3 " + " ".join(map(str, corners)))


CORE = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"
MATERIAL = "{http://schemas.microsoft.com/3dmanufacturing/material/2015/02}"


def read_3mf(path):
    """(unit, objects in their order); an object has a name, vertices, triangles and colours, three
    a triangle, or none."""
    with zipfile.ZipFile(path) as archive:
        assert archive.testzip() is None
        assert {"[Content_Types].xml", "_rels/.rels"} <= set(archive.namelist())
        relations = xml.etree.ElementTree.fromstring(archive.read("_rels/.rels"))
        target, = (r.get("Target") for r in relations if r.get("Type").endswith("/3dmodel"))
        model = xml.etree.ElementTree.fromstring(archive.read(target.lstrip("/")))
    assert model.tag == CORE + "model"
    resources = model.find(CORE + "resources")
    palettes = {group.get("id"): [color.get("color") for color in group]
                for group in resources.iter(MATERIAL + "colorgroup")}
    objects = {}
    for item in resources.iter(CORE + "object"):
        mesh = item.find(CORE + "mesh")
        vertices = [tuple(float(v.get(axis)) for axis in "xyz") for v in mesh[0]]
        triangles = [tuple(int(t.get(f"v{k}")) for k in (1, 2, 3)) for t in mesh[1]]
        colors = [tuple(palettes[t.get("pid")][int(t.get(f"p{k}", t.get("p1")))] for k in (1, 2, 3))
                  for t in mesh[1] if t.get("pid")]
        assert all(0 <= corner < len(vertices) for t in triangles for corner in t)
        objects[item.get("id")] = (item.get("name"), vertices, triangles, colors)
    built = [item.get("objectid") for item in model.find(CORE + "build")]
    assert sorted(built) == sorted(objects)
    return model.get("unit"), [objects[name] for name in built]


def mesh_volume(vertices, triangles):
    """The determinant of the three corners of each triangle, summed over 6."""
    total = 0.0
    for a, b, c in ([vertices[corner] for corner in t] for t in triangles):
        total += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                  a[2] * (b[0] * c[1] - b[1] * c[0]))
    return total / 6


class ThreeMf(ToolTest):
    def test_holds_the_mesh(self):
        scale = 0.25
        for words, colored in (([], False), (["--color", "element"], True)):
            self.check(0, CRAMBIN, *FAST, "--print-scale", scale, *words, "-o", "a.3mf", "-o",
                       "a.ply", "--force")
            unit, ((name, vertices, triangles, colors),) = read_3mf(self.folder / "a.3mf")
            self.assertEqual((unit, name), ("millimeter", "a"))
            names, expected, corners = read_ply((self.folder / "a.ply").read_bytes())
            self.assertEqual(triangles, corners)
            self.assertEqual(len(vertices), len(expected))
            for x, y in zip(vertices, expected):
                self.assertLess(math.dist(x, [scale * t for t in y[:3]]), 2e-6)
            self.assertAlmostEqual(mesh_volume(vertices, triangles) /
                                   (scale ** 3 * mesh_volume(expected, corners)), 1, places=6)
            # Closed, manifold and the same way round: each edge once in either direction.
            edges = [(t[k], t[(k + 1) % 3]) for t in triangles for k in range(3)]
            self.assertEqual(len(set(edges)), len(edges))
            self.assertEqual({(b, a) for a, b in edges}, set(edges))
            self.assertEqual(len(colors), len(triangles) if colored else 0)
            if colored:
                red = names.index("red")
                wanted = ["#%02X%02X%02XFF" % v[red:red + 3] for v in expected]
                self.assertEqual(colors, [tuple(wanted[c] for c in t) for t in triangles])
                self.assertGreater(len(set(wanted)), 3)

    def test_without_a_scale(self):
        """An Å is a millimetre, as slicers take those of an .stl."""
        self.check(0, CRAMBIN, *FAST, "-o", "a.3mf", "-o", "a.ply")
        unit, ((_, vertices, _, _),) = read_3mf(self.folder / "a.3mf")
        _, expected, _ = read_ply((self.folder / "a.ply").read_bytes())
        self.assertEqual(unit, "millimeter")
        self.assertLess(math.dist(vertices[0], expected[0][:3]), 2e-6)

    def test_parts_are_volumes_of_one_object(self):
        """Slicers set objects on the bed one by one; volumes of an object stay where they are."""
        for color, extruders in (("group", ["1", "2"]), ("element", None), ("none", ["1", "2"])):
            self.check(0, DATA / "1a8o.cif.gz", "--assembly", "1", *FAST, "--group-by", "copy",
                       "--split", "group", "--color", color, "-o", "a.3mf", "-o", "a.json", "--force")
            _, ((name, vertices, triangles, colors),) = read_3mf(self.folder / "a.3mf")
            report = json.loads((self.folder / "a.json").read_text())
            sizes = [part["surface"] for part in report["parts"]]
            self.assertEqual((name, len(vertices)), ("a", sum(size["vertices"] for size in sizes)))
            with zipfile.ZipFile(self.folder / "a.3mf") as archive:
                config = xml.etree.ElementTree.fromstring(archive.read("Metadata/Slic3r_PE_model.config"))
            first, corners = 0, []
            volumes = list(config.iter("volume"))
            for volume, size, title in zip(volumes, sizes, ("copy 1", "copy 2"), strict=True):
                last = first + size["triangles"] - 1
                self.assertEqual((volume.get("firstid"), volume.get("lastid")), (str(first), str(last)))
                says = {data.get("key"): data.get("value") for data in volume}
                self.assertEqual(says["name"], title)
                self.assertTrue(1 <= int(says["extruder"]) <= 16)
                corners.append({corner for t in triangles[first:last + 1] for corner in t})
                first = last + 1
            self.assertEqual(first, len(triangles))
            self.assertFalse(corners[0] & corners[1])
            if extruders:
                found = [data.get("value") for data in config.iter("metadata") if data.get("key") == "extruder"]
                self.assertEqual(found, extruders)
        for key in ("mesh_euler_characteristic", "euler_characteristic"):
            self.assertEqual(report["surface"][key], sum(part["surface"][key] for part in report["parts"]))
            self.assertNotEqual(report["surface"][key], 0)

    def paint(self):
        with zipfile.ZipFile(self.folder / "a.3mf") as archive:
            return re.findall(r'<triangle [^>]*slic3rpe:mmu_segmentation="(\w+)"',
                              archive.read("3D/3dmodel.model").decode())

    def test_colors_are_painted(self):
        """Each triangle has the number of a colour that two of its corners have."""
        (self.folder / "g").write_text("".join(f"g{n} A/{n}-{n + 1}\n" for n in range(1, 44, 2)))
        self.check(0, CRAMBIN, *FAST, "--groups", "g", "--color", "group", "-o", "a.3mf", "--force",
                   says="colours: slicers paint with at most 16, got ")
        self.assertEqual(self.paint(), [])
        self.check(0, CRAMBIN, *FAST, "--color", "bfactor", "-o", "a.3mf", "--force", says="without paint")
        self.assertEqual(self.paint(), [])
        (self.folder / "g").write_text("".join(f"g{n} A/{3 * n + 1}-{3 * n + 3}\n" for n in range(14)))
        done = self.check(0, CRAMBIN, *FAST, "--groups", "g", "--color", "group", "-o", "a.3mf", "--force")
        self.assertNotIn(b"paint", done.stderr)
        _, ((_, _, triangles, colors),) = read_3mf(self.folder / "a.3mf")
        known = dict.fromkeys(color for three in colors for color in three)
        painted = self.paint()
        self.assertEqual(len(painted), len(triangles))
        # Of PrusaSlicer's TriangleSelector: the digits are bits from the last one on.
        number = {"4": 0, "8": 1} | {f"{n:X}C": n + 2 for n in range(14)}
        with zipfile.ZipFile(self.folder / "a.3mf") as archive:
            palette = re.findall(r'<m:color color="(#\w+)"', archive.read("3D/3dmodel.model").decode())
        for paint, three in zip(painted, colors):
            self.assertEqual(palette[number[paint]], max(three, key=three.count))
        self.assertEqual(set(palette), set(known))
        self.assertGreater(len(known), 10)

    @needs("prusa-slicer")
    def test_prusa_slicer_keeps_parts_and_paint(self):
        self.check(0, DATA / "1a8o.cif.gz", "--assembly", "1", *FAST, "--group-by", "copy", "--print-scale", "0.5",
                   "--split", "group", "--color", "group", "-o", "a.3mf", "-o", "a.ply")
        subprocess.run(["prusa-slicer", "--export-3mf", "a.3mf", "-o", "b.3mf"], cwd=self.folder, capture_output=True,
                       check=True, timeout=120)
        with zipfile.ZipFile(self.folder / "b.3mf") as archive:
            model = archive.read("3D/3dmodel.model").decode()
            config = archive.read("Metadata/Slic3r_PE_model.config").decode()
        self.assertEqual(model.count("<item "), 1)
        self.assertEqual(re.findall(r'type="volume" key="extruder" value="(\d+)"', config), ["1", "2"])
        self.assertEqual(re.findall(r'type="volume" key="name" value="([^"]*)"', config), ["copy 1", "copy 2"])
        _, vertices, triangles = read_ply((self.folder / "a.ply").read_bytes())
        self.assertEqual(model.count("slic3rpe:mmu_segmentation="), len(triangles))

    def test_same_mesh_same_bytes(self):
        """Also the identifiers; another mesh has others."""
        texts = []
        for name, words in (("a", ["-j", "1"]), ("b", ["-j", "2"]), ("c", ["--probe", "1.5"])):
            (self.folder / name).mkdir()
            self.check(0, CRAMBIN, *FAST, *words, "-o", f"{name}/a.3mf")
            texts.append((self.folder / name / "a.3mf").read_bytes())
        self.assertEqual(texts[0], texts[1])
        found = []
        for name in "ac":
            with zipfile.ZipFile(self.folder / name / "a.3mf") as archive:
                model = archive.read("3D/3dmodel.model").decode()
            found.append(re.findall(r'p:UUID="([^"]*)"', model))
        self.assertEqual(len(set(found[0] + found[1])), 6)
        for identifier in found[0]:
            self.assertRegex(identifier, r"^[0-9a-f]{8}-[0-9a-f]{4}-8[0-9a-f]{3}-[89ab][0-9a-f]{3}-"
                                         r"[0-9a-f]{12}$")
        done = self.check(0, CRAMBIN, *FAST, "-o", "-", "--format", "3mf")
        self.assertEqual(done.stdout[:4], texts[0][:4])


if __name__ == "__main__":
    unittest.main()
