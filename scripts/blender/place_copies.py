#!/usr/bin/python3
# SPDX-License-Identifier: MPL-2.0
"""Places the copies of an assembly in Blender: objects that share one mesh or one volume.

    vdb_molsurf capsid.cif --assembly 1 --instances --for blender=nm -o unit.vdb -o copies.json
    blender --python place_copies.py -- copies.json unit.vdb
    blender -b --factory-startup --python place_copies.py -- copies.json unit.vdb --render capsid.png

The .json is the report of that run, whose matrices it takes; the .vdb, or a .ply, has each distinct copy
once. An assembly of several distinct copies needs the .vdb, which has a grid for each. --help lists the
options. Tried in Blender 3.4.1 (Debian 12).
"""

import argparse
import json
import pathlib
import sys

import bpy
from mathutils import Matrix, Vector

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

import open_in_blender as one

# Okabe and Ito's colours, in linear light.
COLORS = [(0.791, 0.347, 0.0), (0.093, 0.456, 0.815), (0.0, 0.342, 0.171), (0.871, 0.776, 0.054),
          (0.0, 0.168, 0.445), (0.665, 0.112, 0.0), (0.604, 0.191, 0.386), (0.319, 0.319, 0.319)]


def arguments():
    words = sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else []
    parser = argparse.ArgumentParser(prog="place_copies.py", description=__doc__.splitlines()[0])
    parser.add_argument("report", help=".json of a run with --instances")
    parser.add_argument("surface", help=".vdb or .ply of the same run")
    parser.add_argument("--show", choices=("mesh", "volume"), default="mesh",
                        help="the level set as a mesh, or the grid density as fog [mesh]")
    parser.add_argument("--scale", type=float, help="scene units per Å [as the .vdb says; else 1]")
    parser.add_argument("--render", metavar="PNG", help="render a picture")
    parser.add_argument("--size", type=int, default=800, help="width of the picture [800]")
    parser.add_argument("--samples", type=int, default=48, help="rays a pixel [48]")
    parser.add_argument("--turn", type=float, default=0.0, help="degrees about the upright [0]")
    parser.add_argument("--save", metavar="BLEND", help="save the scene")
    return parser.parse_args(words)


def prototypes(path, report, show):
    """The data of each distinct copy, in their order: meshes or volumes."""
    names = [part["name"] for part in report["parts"]] or [None]
    if len(names) > 1 and (path.suffix != ".vdb" or show == "volume"):
        sys.exit(f"{path}: expected a .vdb, to be shown as meshes: there are {len(names)} distinct copies")
    if path.suffix == ".ply":
        objects = [one.import_ply(path)]
    else:
        volume = one.load_volume(path)
        if show == "volume":
            objects = [volume]
        else:
            objects = [one.mesh_of(volume, f"surface_{name}" if name else "surface") for name in names]
            for obj in objects:
                one.fixed(obj)
            bpy.data.objects.remove(volume)
    data = [obj.data for obj in objects]
    for obj in objects:
        bpy.data.objects.remove(obj)
    return data


def material_of(show, data):
    """A surface in the colour of its object, or fog."""
    if show == "volume":
        voxel = min(data.grids["density"].matrix_object.to_scale())
        return one.fog_material("Cd" in [g.name for g in data.grids], 4.0 / voxel)
    material = one.surface_material(False)
    nodes, links = material.node_tree.nodes, material.node_tree.links
    shader = next(node for node in nodes if node.type == "BSDF_PRINCIPLED")
    links.new(nodes.new("ShaderNodeObjectInfo").outputs["Color"], shader.inputs["Base Color"])
    return material


def place_copies(report_path, surface, show="mesh", scale=None):
    """Makes an object for each copy, below an empty one; returns the empty one and the copies."""
    surface = pathlib.Path(surface).resolve()
    report = json.loads(pathlib.Path(report_path).read_text())
    if not report.get("instances"):
        sys.exit(f"{report_path}: it has no copies [hint: vdb_molsurf --assembly 1 --instances]")
    if not surface.is_file():
        sys.exit(f"{surface}: there is no such file")
    for name in ("Cube", "Light", "Camera"):  # of the scene that Blender starts with
        if name in bpy.data.objects:
            bpy.data.objects.remove(bpy.data.objects[name])
    if scale is None:
        scale = one.read_scale(surface) if surface.suffix == ".vdb" else 1.0
    data = prototypes(surface, report, show)
    material = material_of(show, data[0])
    for each in data:
        each.materials.clear()
        each.materials.append(material)
    assembly = bpy.data.objects.new("assembly", None)
    bpy.context.collection.objects.link(assembly)
    copies = []
    for number, instance in enumerate(report["instances"]):
        copy = bpy.data.objects.new(f"copy {instance['operator'] or number + 1}", data[instance["part"]])
        bpy.context.collection.objects.link(copy)
        matrix = Matrix(instance["matrix"])
        matrix.translation *= scale  # the surface is scaled itself
        copy.parent = assembly
        copy.matrix_world = matrix
        copy.color = (*COLORS[number % len(COLORS)], 1.0)
        copies.append(copy)
    bpy.context.view_layer.update()
    return assembly, copies


def set_stage(copies, turn):
    """Camera and lamps about all copies."""
    corners = [copy.matrix_world @ Vector(corner) for copy in copies for corner in copy.bound_box]
    mesh = bpy.data.meshes.new("outline")
    mesh.from_pydata(corners, [], [])
    outline = bpy.data.objects.new("outline", mesh)
    bpy.context.collection.objects.link(outline)
    bpy.context.view_layer.update()
    one.set_stage(outline, turn)
    bpy.data.objects.remove(outline)


def main():
    options = arguments()
    one.set_size(options.size)
    _, copies = place_copies(options.report, options.surface, options.show, options.scale)
    set_stage(copies, options.turn)
    if options.save:
        bpy.ops.wm.save_as_mainfile(filepath=str(pathlib.Path(options.save).resolve()))
    if options.render:
        one.render(options.render, options.samples)


if __name__ == "__main__":
    main()
