# SPDX-License-Identifier: MPL-2.0
""".glb and .off hold the mesh of the .ply."""

import json
import math
import os
import pathlib
import shutil
import struct
import subprocess
import unittest

from tool import CRAMBIN, DATA, FAST, ToolTest, read_ply

NODE = shutil.which("node")
VALIDATE = pathlib.Path(__file__).resolve().parent / "gltf_validate.js"


def has_validator():
    """Khronos' gltf-validator of npm, globally installed or on NODE_PATH."""
    if not NODE:
        return False
    return subprocess.run([NODE, "-e", "require('gltf-validator')"], capture_output=True,
                          env=node_environment()).returncode == 0


def node_environment():
    paths = [os.environ.get("NODE_PATH", ""), "/usr/local/lib/node_modules",
             "/usr/lib/node_modules"]
    return {**os.environ, "NODE_PATH": ":".join(p for p in paths if p)}


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

    @unittest.skipUnless(has_validator(), "no gltf-validator of npm")
    def test_khronos_validator(self):
        dimer = [DATA / "1a8o.cif.gz", "--assembly", "1", *FAST]
        for words in ([], ["--color", "chain"], ["--group-by", "copy", "--split", "group"],
                      ["--for", "blender=mn-0.01", "--fields", "shape_index"]):
            self.check(0, *dimer, *words, "-o", "a.glb", "--force")
            done = subprocess.run([NODE, str(VALIDATE), "a.glb"], cwd=self.folder, check=True,
                                  capture_output=True, text=True, env=node_environment())
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


if __name__ == "__main__":
    unittest.main()
