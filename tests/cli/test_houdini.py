# SPDX-License-Identifier: MPL-2.0
"""The scripts for Houdini use the nodes and parameters of scripts/houdini/nodes.json and no others. Houdini itself is a
stand-in that notes what it is asked for."""

import json
import pathlib
import runpy
import sys
import tempfile
import types
import unittest
from unittest import mock

FOLDER = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "houdini"
NODES = json.loads((FOLDER / "nodes.json").read_text())


class Node:
    def __init__(self, kind, made):
        self.kind, self.made, self.inputs, self.values = kind, made, {}, {}
        made.append(self)

    def createNode(self, kind, name):  # as Houdini spells it
        assert kind in NODES, f"{kind} is not in nodes.json"
        return Node(kind, self.made)

    def setInput(self, number, node):
        self.inputs[number] = node.kind

    def parm(self, name):
        known = NODES[self.kind]["parameters"]
        assert name in known, f"{self.kind} has no {name} in nodes.json"

        def keep(value):
            assert known[name] == "any" or value in known[name], f"{self.kind}: {name} is none of {known[name]}"
            self.values[name] = value
        return types.SimpleNamespace(set=keep)

    def setDisplayFlag(self, on):
        assert on

    setRenderFlag = setDisplayFlag

    def layoutChildren(self):
        pass


class Houdini(unittest.TestCase):
    def run_script(self, file):
        made, saved = [], []
        hou = types.ModuleType("hou")
        hou.node = lambda path: Node(path, made)
        hou.hipFile = types.SimpleNamespace(save=saved.append)
        script = FOLDER / "load_in_houdini.py"
        with mock.patch.dict(sys.modules, hou=hou), mock.patch.object(sys, "argv", [str(script), file, "a.hip"]):
            runpy.run_path(str(script), run_name="__main__")
        self.assertEqual(saved, ["a.hip"])
        return {node.kind: node for node in made}

    def test_nodes(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder).resolve() / "a.0001.vdb"
            file.touch()
            nodes = self.run_script(str(file))
            self.assertEqual(nodes["file"].values, {"file": str(file).replace("0001", "$F4")})
        self.assertEqual(set(nodes), set(NODES) - {"about"} | {"/obj"})
        self.assertEqual(nodes["attribfromvolume"].inputs, {0: "convertvdb", 1: "file"})
        self.assertEqual(nodes["attribfromvolume"].values, {"field": "Cd", "name": "Cd", "type": "float", "size": 3})
        self.assertEqual(nodes["blast"].values, {"group": "@name=surface", "grouptype": "prims", "negate": True})

    def test_list(self):
        """Each node of the list has a source."""
        for name, node in NODES.items():
            if name != "about":
                self.assertTrue(all(source.startswith("https://") for source in node["sources"]) and node["sources"], name)

    def test_scripts(self):
        self.assertEqual([path.name for path in FOLDER.glob("*.py")], ["load_in_houdini.py"])


if __name__ == "__main__":
    unittest.main()
