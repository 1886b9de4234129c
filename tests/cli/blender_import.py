# SPDX-License-Identifier: MPL-2.0
"""Runs in Blender or bpy for test_blender.py: opens files by Blender's own importers, and prints what arrives as JSON
on a line that starts with RESULT. Words: files, at a frame as a.usda@2; those of a kind that this Blender has no
importer for give null."""

import json
import pathlib
import sys

import bpy
import numpy

numpy.bool = bool  # Debian's importer of glTF takes a NumPy that has it


def import_file(path):
    kind = path.suffix[1:]
    if kind == "glb":
        bpy.ops.import_scene.gltf(filepath=str(path))
    elif kind == "vdb":
        bpy.ops.object.volume_import(filepath=str(path), files=[{"name": path.name}])
    elif kind == "usda" and "usd_import" in dir(bpy.ops.wm):
        bpy.ops.wm.usd_import(filepath=str(path), apply_unit_conversion_scale=False)
    elif kind == "ply" and "ply_import" in dir(bpy.ops.wm):  # Blender 3.6 and later
        bpy.ops.wm.ply_import(filepath=str(path))
    elif kind == "ply":
        bpy.ops.import_mesh.ply(filepath=str(path))
    else:
        return False
    return True


def values(attribute):
    kind = {"FLOAT": "value", "INT": "value", "FLOAT_COLOR": "color", "BYTE_COLOR": "color",
            "FLOAT_VECTOR": "vector"}.get(attribute.data_type)
    if attribute.domain not in ("POINT", "CORNER") or kind is None or attribute.name.startswith("."):
        return None
    found = [getattr(each, kind) for each in attribute.data]
    return [value if kind == "value" else list(value) for value in found]


def mesh(data, matrix):
    found = {attribute.name: values(attribute) for attribute in data.attributes}
    material = data.materials[0] if data.materials else None
    nodes = [node.type for node in material.node_tree.nodes] if material else []
    return {"points": [list(matrix @ v.co) for v in data.vertices], "faces": len(data.polygons), "nodes": nodes,
            "attributes": {name: each for name, each in found.items() if each is not None}}


def what_is_shown():
    bpy.context.view_layer.update()
    shown = {"meshes": [], "volumes": []}
    for instance in bpy.context.evaluated_depsgraph_get().object_instances:
        obj = instance.object
        if obj.type == "MESH":
            shown["meshes"].append(mesh(obj.data, instance.matrix_world))
        if obj.type == "VOLUME":
            obj.data.grids.load()
            shown["volumes"].append({"grids": {grid.name: grid.data_type for grid in obj.data.grids},
                                     "error": obj.data.grids.error_message,
                                     "matrix": [list(row) for row in instance.matrix_world]})
    return shown


result = []
for word in sys.argv[sys.argv.index("--") + 1:]:
    bpy.ops.wm.read_factory_settings(use_empty=True)
    name, _, frame = word.partition("@")
    known = import_file(pathlib.Path(name).resolve())
    if frame:
        bpy.context.scene.frame_set(int(frame))
    result.append(what_is_shown() if known else None)
print("RESULT " + json.dumps(result))
