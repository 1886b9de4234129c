#!/usr/bin/python3
# SPDX-License-Identifier: MPL-2.0
"""Places the copies of an assembly in Blender: objects that share one mesh or one volume.

    vdb_molsurf capsid.cif --assembly 1 --instances --for blender=nm -o unit.vdb -o copies.json
    blender --python place_copies.py -- copies.json unit.vdb
    blender -b --factory-startup --python place_copies.py -- copies.json unit.vdb --cut 0 --render capsid.png

The .json is the report of that run, whose matrices it takes; the .vdb, or a .ply, has each distinct copy
once. An assembly of several distinct copies needs the .vdb, which has a grid for each. --help lists the
options. Tried in Blender 3.4.1 (Debian 12) and in the module bpy 5.2.3.
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
    parser.add_argument("--color", action="store_true",
                        help="the unit's own colours, by Cd or the .ply, not one for each copy")
    parser.add_argument("--cut", metavar="DEPTH", type=float,
                        help="cut away: hide copies before a plane across the view, -1 far, 0 in the middle, 1 near")
    parser.add_argument("--scale", type=float, help="scene units per Å [as the .vdb says; else 1]")
    parser.add_argument("--render", metavar="PNG", help="render a picture")
    parser.add_argument("--size", type=int, default=800, help="width of the picture [800]")
    parser.add_argument("--samples", type=int, default=48, help="rays a pixel [48]")
    parser.add_argument("--turn", type=float, default=0.0, help="degrees about the upright [0]")
    parser.add_argument("--save", metavar="BLEND", help="save the scene")
    return parser.parse_args(words)


def prototypes(path, report, show, color):
    """The data of each distinct copy, in their order, meshes or volumes, and where they lie."""
    names = [part["name"] for part in report["parts"]] or [None]
    if len(names) > 1 and (path.suffix != ".vdb" or show == "volume"):
        sys.exit(f"{path}: expected a .vdb, to be shown as meshes: there are {len(names)} distinct copies")
    if path.suffix == ".ply":
        objects, place = [one.import_ply(path)], Vector()
        for attribute in objects[0].data.color_attributes[:1]:
            attribute.name = "Cd"
    else:
        volume = one.load_volume(path)
        place = volume.location.copy()
        if show == "volume":
            objects = [volume]
        else:
            objects = [one.mesh_of(volume, f"surface_{name}" if name else "surface") for name in names]
            for obj, name in zip(objects, names):
                mesh = one.fixed(obj)
                if color:
                    one.add_colors(mesh, path, volume, f"Cd_{name}" if name else "Cd")
            bpy.data.objects.remove(volume)
    data = [obj.data for obj in objects]
    for obj in objects:
        bpy.data.objects.remove(obj)
    return data, Matrix.Translation(place)


def material_of(show, unit, colored):
    """A surface in the unit's own colours, or in that of its object, or fog."""
    if show == "volume":
        return one.fog_material("Cd" in [g.name for g in unit.data.grids], one.size_of(unit))
    material = one.surface_material(colored, one.size_of(unit))
    if not colored:
        one.connect_color(material, material.node_tree.nodes.new("ShaderNodeObjectInfo"))
    return material


def cut_away(copies, depth):
    """Hides the copies whose middles lie before a plane across the view: -1 is the farthest, 1 the nearest."""
    camera = bpy.context.scene.camera
    middles = [copy.matrix_world @ (sum((Vector(c) for c in copy.bound_box), Vector()) / 8) for copy in copies]
    toward = [(camera.location - middle).dot(camera.matrix_world.col[2].xyz) for middle in middles]
    near, far = min(toward), max(toward)
    for copy, distance in zip(copies, toward):
        copy.hide_render = distance < near + (far - near) * (1 - depth) / 2
        copy.hide_set(copy.hide_render)


def place_copies(report_path, surface, show="mesh", scale=None, color=False):
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
    data, place = prototypes(surface, report, show, color)
    assembly = bpy.data.objects.new("assembly", None)
    bpy.context.collection.objects.link(assembly)
    copies = []
    for number, instance in enumerate(report["instances"]):
        copy = bpy.data.objects.new(f"copy {instance['operator'] or number + 1}", data[instance["part"]])
        bpy.context.collection.objects.link(copy)
        matrix = Matrix(instance["matrix"])
        matrix.translation *= scale  # the surface is scaled itself
        copy.parent = assembly
        copy.matrix_world = matrix @ place
        copy.color = (*COLORS[number % len(COLORS)], 1.0)
        copies.append(copy)
    bpy.context.view_layer.update()
    colored = color and show == "mesh" and all("Cd" in each.color_attributes for each in data)
    material = material_of(show, copies[0], colored)
    for each in data:
        each.materials.clear()
        each.materials.append(material)
    return assembly, copies


def set_stage(copies, turn, show):
    """Camera and lamps about all copies."""
    points = []
    for copy in copies:
        own = [Vector(corner) for corner in copy.bound_box]
        if show == "mesh":
            vertices = copy.data.vertices
            own = [vertices[i].co for i in range(0, len(vertices), max(1, len(vertices) // 50))]
        points += [copy.matrix_world @ p for p in own]
    mesh = bpy.data.meshes.new("outline")
    mesh.from_pydata(points, [], [])
    outline = bpy.data.objects.new("outline", mesh)
    bpy.context.collection.objects.link(outline)
    bpy.context.view_layer.update()
    one.set_stage(outline, turn, show == "volume")
    bpy.data.objects.remove(outline)


def main():
    options = arguments()
    one.set_size(options.size)
    _, copies = place_copies(options.report, options.surface, options.show, options.scale, options.color)
    set_stage(copies, options.turn, options.show)
    if options.cut is not None:
        cut_away(copies, options.cut)
    if options.save:
        bpy.ops.wm.save_as_mainfile(filepath=str(pathlib.Path(options.save).resolve()))
    if options.render:
        one.render(options.render, options.samples)


if __name__ == "__main__":
    main()
