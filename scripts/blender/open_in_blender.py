#!/usr/bin/python3
# SPDX-License-Identifier: MPL-2.0
"""Opens a surface of vdb_molsurf in Blender: volume, mesh, colours, material, lights and camera.

In a window, or without one and with a picture (Cycles on the processor):

    blender --python open_in_blender.py -- surface.vdb
    blender -b --factory-startup --python open_in_blender.py -- surface.vdb --render surface.png

Takes a .vdb that was written with `--for blender[=SCALE]`, or the first frame of a sequence
name.0001.vdb, name.0002.vdb, ... --help lists the options. Tried in Blender 3.4.1 (Debian 12); what
differs in later versions is guarded, and marked.

Colours: Volume to Mesh makes a mesh without colours. With `--color` they are taken from the grid Cd,
for which Blender's Python needs OpenVDB's module (Debian: python3-openvdb; official builds from 4.4
on have it); else from the .ply of the same name beside the .vdb.
"""

import argparse
import math
import pathlib
import re
import sys

import bpy
from mathutils import Matrix, Vector
from mathutils.kdtree import KDTree

PLAIN = (0.26, 0.46, 0.73, 1.0)  # linear light


def arguments():
    words = sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else []
    parser = argparse.ArgumentParser(prog="open_in_blender.py", description=__doc__.splitlines()[0])
    parser.add_argument("vdb", help=".vdb file, or the first frame of a sequence")
    parser.add_argument("--show", choices=("mesh", "volume"), default="mesh",
                        help="the level set as a mesh, or the grid density as fog [mesh]")
    parser.add_argument("--grid", default="surface", help="level set to mesh [surface]")
    parser.add_argument("--color", action="store_true",
                        help="colours by the grid Cd; the mesh is then fixed, not a modifier")
    parser.add_argument("--render", metavar="PNG", help="render a picture")
    parser.add_argument("--frame", type=int, help="frame of a sequence to render [the first]")
    parser.add_argument("--size", type=int, default=800, help="width of the picture [800]")
    parser.add_argument("--samples", type=int, default=48, help="rays a pixel [48]")
    parser.add_argument("--turn", type=float, default=0.0, help="degrees about the upright [0]")
    parser.add_argument("--save", metavar="BLEND", help="save the scene")
    return parser.parse_args(words)


def frames_of(path):
    """The names of a sequence that starts with this frame; the name alone if it is none."""
    match = re.fullmatch(r"(.*?\.)(\d+)\.vdb", path.name)
    if not match:
        return [path.name]
    frames = {}
    for other in path.parent.iterdir():
        again = re.fullmatch(r"(.*?\.)(\d+)\.vdb", other.name)
        if again and again[1] == match[1] and int(again[2]) >= int(match[2]):
            frames[int(again[2])] = other.name
    numbers = sorted(frames)
    if numbers != list(range(numbers[0], numbers[0] + len(numbers))):
        sys.exit(f"{path}: frames are missing between {numbers[0]} and {numbers[-1]}")
    return [frames[n] for n in numbers]


def load_volume(path):
    """Imports the .vdb; a sequence becomes one object with all frames."""
    names = frames_of(path)
    bpy.ops.object.volume_import(filepath=str(path), directory=str(path.parent),
                                 files=[{"name": name} for name in names],
                                 use_sequence_detection=len(names) > 1)
    volume = bpy.context.object
    data = volume.data
    if len(names) > 1:
        first = int(re.search(r"(\d+)\.vdb$", names[0])[1])
        data.is_sequence = True
        data.frame_duration = len(names)
        data.frame_start, data.frame_offset = first, first - 1  # frame n shows name.n.vdb
        scene = bpy.context.scene
        scene.frame_start, scene.frame_end = first, first + len(names) - 1
        scene.frame_set(first)
    data.grids.load()
    if data.grids.error_message:
        sys.exit(f"{path}: {data.grids.error_message}")
    return volume


def mesh_of(volume, grid):
    """An object whose modifier meshes a level set at 0, in the voxels of the grid itself."""
    if grid not in [g.name for g in volume.data.grids]:
        names = ", ".join(g.name for g in volume.data.grids)
        sys.exit(f"{volume.name}: there is no grid {grid} [hint: --grid, one of {names}]")
    mesh = bpy.data.objects.new("surface", bpy.data.meshes.new("surface"))
    bpy.context.collection.objects.link(mesh)
    # The mesh moves with the volume. Turned apart, the modifier would be off by up to half a voxel,
    # since Blender adds it along the axes of the mesh.
    mesh.parent = volume
    modifier = mesh.modifiers.new("Volume to Mesh", "VOLUME_TO_MESH")
    modifier.object = volume
    modifier.grid_name = grid
    modifier.threshold = 0.0  # a level set's surface; the default 0.1 is for fog
    modifier.resolution_mode = "GRID"  # other modes lose the class and turn the normals
    modifier.adaptivity = 0.0
    modifier.use_smooth_shade = True
    volume.hide_render = True
    return mesh


def fixed(obj):
    """The object with its modifiers applied, as a mesh of its own."""
    evaluated = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = bpy.data.meshes.new_from_object(evaluated)
    obj.modifiers.clear()
    obj.data = mesh
    return mesh


def openvdb_module():
    for name in ("openvdb", "pyopenvdb"):  # the name from OpenVDB 11 on, and the one before
        try:
            return __import__(name)
        except ImportError:
            pass
    return None


def colors_of_grid(mesh, path):
    """Linear light of each vertex by the grid Cd, or None."""
    vdb = openvdb_module()
    if vdb is None:
        return None
    try:
        grid = vdb.read(str(path), "Cd")
    except (KeyError, IOError):
        return None
    accessor = grid.getConstAccessor()
    half = 0.5 * grid.transform.voxelSize()[0]  # Blender shows a voxel so much farther
    out = []
    for vertex in mesh.vertices:
        x = [c - half for c in vertex.co]
        i = [math.floor(c + 0.5) for c in grid.transform.worldToIndex(x)]
        out.append(accessor.getValue(tuple(i)))
    return out


def import_ply(path):
    """The object of a .ply file."""
    before = set(bpy.data.objects)
    if "ply_import" in dir(bpy.ops.wm):  # Blender 3.6 and later
        bpy.ops.wm.ply_import(filepath=str(path))
    else:
        bpy.ops.import_mesh.ply(filepath=str(path))
    return (set(bpy.data.objects) - before).pop()


def colors_of_ply(mesh, path):
    """The same by the nearest vertex of the .ply beside the .vdb, or None."""
    ply = path.with_suffix(".ply")
    if not ply.exists():
        return None
    other = import_ply(ply)
    colors = other.data.color_attributes
    if not colors:
        bpy.data.objects.remove(other)
        return None
    tree = KDTree(len(other.data.vertices))
    for i, vertex in enumerate(other.data.vertices):
        tree.insert(vertex.co, i)
    tree.balance()
    of_vertex = [None] * len(other.data.vertices)
    if colors[0].domain == "CORNER":
        for loop in other.data.loops:
            of_vertex[loop.vertex_index] = colors[0].data[loop.index].color[:3]
    else:
        of_vertex = [value.color[:3] for value in colors[0].data]
    scale = read_scale(path)
    out = [of_vertex[tree.find(vertex.co / scale)[1]] for vertex in mesh.vertices]
    bpy.data.objects.remove(other)
    return out


def read_scale(path):
    """Scene units per Å that the file names; 1 if it cannot be read."""
    vdb = openvdb_module()
    if vdb is None:
        return 1.0
    return vdb.readMetadata(str(path)).get("scene.units_per_angstrom", 1.0)


def add_colors(mesh, path):
    colors = colors_of_grid(mesh, path) or colors_of_ply(mesh, path)
    if colors is None:
        print(f"{path}: no colours: neither OpenVDB's Python module with a grid Cd, nor a .ply "
              "with colours beside it", file=sys.stderr)
        return False
    attribute = mesh.color_attributes.new("Cd", "FLOAT_COLOR", "POINT")
    for value, color in zip(attribute.data, colors):
        value.color = (*color, 1.0)
    mesh.color_attributes.active_color = attribute  # what the viewport shows
    return True


def socket(node, *names):
    """The input of a node, by the first of its names over the versions that it has."""
    for name in names:
        if name in node.inputs:
            return node.inputs[name]
    return None


def new_material(name, kind, output):
    """A material of one shader node: (material, shader)."""
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.clear()
    shader, end = nodes.new(kind), nodes.new("ShaderNodeOutputMaterial")
    links.new(shader.outputs[0], end.inputs[output])
    return material, shader


def surface_material(colored):
    material, shader = new_material("surface", "ShaderNodeBsdfPrincipled", "Surface")
    shader.inputs["Base Color"].default_value = PLAIN
    shader.inputs["Roughness"].default_value = 0.45
    specular = socket(shader, "Specular", "Specular IOR Level")  # the second from Blender 4.0 on
    specular.default_value = 0.35
    subsurface = socket(shader, "Subsurface", "Subsurface Weight")
    subsurface.default_value = 0.0
    if colored:
        attribute = material.node_tree.nodes.new("ShaderNodeAttribute")
        attribute.attribute_name = "Cd"
        material.node_tree.links.new(attribute.outputs["Color"], shader.inputs["Base Color"])
    return material


def fog_material(colored, thickness):
    """Fog of so much density in a scene unit."""
    material, shader = new_material("fog", "ShaderNodeVolumePrincipled", "Volume")
    shader.inputs["Density Attribute"].default_value = "density"
    shader.inputs["Density"].default_value = thickness
    shader.inputs["Color"].default_value = (1.0, 1.0, 1.0, 1.0) if colored else PLAIN
    shader.inputs["Color Attribute"].default_value = "Cd" if colored else ""
    shader.inputs["Anisotropy"].default_value = 0.0
    return material


def box_of(obj):
    """Corners of the evaluated object's box in the scene: (low, high)."""
    evaluated = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
    corners = [evaluated.matrix_world @ Vector(corner) for corner in evaluated.bound_box]
    low = Vector([min(c[i] for c in corners) for i in range(3)])
    high = Vector([max(c[i] for c in corners) for i in range(3)])
    return low, high


def outline_of(obj):
    """Points of the evaluated object in the scene, as one list of coordinates."""
    evaluated = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
    points = [Vector(corner) for corner in evaluated.bound_box]
    if obj.type == "MESH" and evaluated.data.vertices:
        vertices = evaluated.data.vertices
        step = max(1, len(vertices) // 20000)
        points = [vertices[i].co for i in range(0, len(vertices), step)]
    return [c for p in points for c in evaluated.matrix_world @ p]


def set_world(world):
    """White to the camera, a dim sky to everything else."""
    world.use_nodes = True
    nodes, links = world.node_tree.nodes, world.node_tree.links
    nodes.clear()
    output, mix = nodes.new("ShaderNodeOutputWorld"), nodes.new("ShaderNodeMixShader")
    path = nodes.new("ShaderNodeLightPath")
    links.new(path.outputs["Is Camera Ray"], mix.inputs[0])
    for number, strength in ((1, 0.35), (2, 1.0)):
        sky = nodes.new("ShaderNodeBackground")
        sky.inputs["Color"].default_value = (1.0, 1.0, 1.0, 1.0)
        sky.inputs["Strength"].default_value = strength
        links.new(sky.outputs[0], mix.inputs[number])
    links.new(mix.outputs[0], output.inputs["Surface"])


def aim(obj, target):
    obj.rotation_euler = (target - obj.location).to_track_quat("-Z", "Y").to_euler()


def set_stage(obj, turn):
    """Camera and three lamps about the object, all in proportion to its size."""
    low, high = box_of(obj)
    center, size = (low + high) / 2, (high - low).length
    turned = Matrix.Rotation(math.radians(turn), 3, "Z")
    scene = bpy.context.scene

    data = bpy.data.cameras.new("camera")
    data.lens = 85
    camera = bpy.data.objects.new("camera", data)
    scene.collection.objects.link(camera)
    camera.location = center + turned @ Vector((0.30, -1.0, 0.28)).normalized() * 2 * size
    data.clip_start, data.clip_end = size / 100, size * 100
    aim(camera, center)
    scene.camera = camera
    bpy.context.view_layer.update()
    place, _ = camera.camera_fit_coords(bpy.context.evaluated_depsgraph_get(), outline_of(obj))
    camera.location = center + 1.06 * (place - center)

    # Power falls with the square of the distance, which is in proportion to the size.
    for name, place, power, width in (("key", (-0.9, -1.2, 1.3), 30.0, 0.8),
                                      ("fill", (1.5, -0.9, 0.2), 9.0, 1.2),
                                      ("rim", (0.4, 1.5, 1.0), 26.0, 0.8)):
        lamp = bpy.data.objects.new(name, bpy.data.lights.new(name, "AREA"))
        lamp.data.energy = power * size * size
        lamp.data.size = width * size
        lamp.location = center + turned @ Vector(place) * size
        aim(lamp, center)
        scene.collection.objects.link(lamp)

    if scene.world is None:
        scene.world = bpy.data.worlds.new("world")
    set_world(scene.world)


def set_size(width):
    """Of the picture, 4 to 3; before the camera is set, which fits it."""
    rendered = bpy.context.scene.render
    rendered.resolution_x, rendered.resolution_y = width, width * 3 // 4
    rendered.resolution_percentage = 100


def render(path, samples):
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = samples
    scene.cycles.use_denoising = False  # Debian's Blender has no denoiser
    scene.cycles.volume_bounces = 8
    scene.view_settings.view_transform = "Standard"  # colours as they are in Cd
    scene.render.film_transparent = False
    scene.render.image_settings.file_format = "PNG"
    scene.render.filepath = str(pathlib.Path(path).resolve())
    bpy.ops.render.render(write_still=True)


def open_surface(path, show="mesh", grid="surface", color=False, turn=0.0):
    """Puts a surface and its stage into the scene; the volume and what is shown."""
    path = pathlib.Path(path).resolve()
    if not path.is_file():
        sys.exit(f"{path}: there is no such file")
    for name in ("Cube", "Light", "Camera"):  # of the scene that Blender starts with
        if name in bpy.data.objects:
            bpy.data.objects.remove(bpy.data.objects[name])
    volume = load_volume(path)
    names = [g.name for g in volume.data.grids]
    if show == "volume":
        if "density" not in names:
            sys.exit(f"{path}: there is no grid density [hint: vdb_molsurf --for blender]")
        voxel = min(volume.data.grids["density"].matrix_object.to_scale())
        shown = volume
        volume.data.materials.append(fog_material("Cd" in names, 4.0 / voxel))
        outline = mesh_of(volume, grid) if grid in names else volume
        set_stage(outline, turn)
        if outline is not volume:
            bpy.data.objects.remove(outline)
        volume.hide_render = False
    else:
        shown = mesh_of(volume, grid)
        colored = color and add_colors(fixed(shown), path)
        material = surface_material(colored)
        shown.data.materials.clear()
        shown.data.materials.append(material)
        set_stage(shown, turn)
    return volume, shown


def main():
    options = arguments()
    set_size(options.size)
    open_surface(options.vdb, options.show, options.grid, options.color, options.turn)
    if options.frame is not None:
        bpy.context.scene.frame_set(options.frame)
    if options.save:
        bpy.ops.wm.save_as_mainfile(filepath=str(pathlib.Path(options.save).resolve()))
    if options.render:
        render(options.render, options.samples)


if __name__ == "__main__":
    main()
