#!/usr/bin/python3
# SPDX-License-Identifier: MPL-2.0
"""Opens a surface of vdb_molsurf in Blender: volume, mesh, colours, material, lights and camera.

In a window, or without one and with a picture (Cycles on the processor):

    blender --python open_in_blender.py -- surface.vdb
    blender -b --factory-startup --python open_in_blender.py -- surface.vdb --render surface.png

Takes a .vdb that was written with `--for blender[=SCALE]` or `--for houdini[=SCALE]`, or the first frame of a sequence
name.0001.vdb, name.0002.vdb, ..., or a .usda of a mesh or of a film of meshes. --help lists the options. Tried in Blender 3.4.1 (Debian 12) and in the
module bpy 5.2.3, where `python open_in_blender.py -- ...` does; what differs in later versions is guarded, and marked.

Colours: Volume to Mesh makes a mesh without colours. With `--color` they are taken from the grid Cd,
for which Blender's Python needs OpenVDB's module (Debian: python3-openvdb; official builds from 4.4
on have it); else from the .ply of the same name beside the .vdb.
"""

import argparse
import math
import pathlib
import re
import struct
import sys

import bpy
from mathutils import Matrix, Vector
from mathutils.kdtree import KDTree

PLAIN = (0.26, 0.46, 0.73, 1.0)  # linear light
WHITE = (1.0, 1.0, 1.0, 1.0)
NIGHT = (0.008, 0.012, 0.022, 1.0)  # behind fog
# Voxels by which Blender shows every voxel too far along each axis; --for blender4 moves the grids back by 0.5.
FARTHER = 0.5 if bpy.app.version < (5, 0, 0) else 0.0


def arguments():
    words = sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else []
    parser = argparse.ArgumentParser(prog="open_in_blender.py", description=__doc__.splitlines()[0])
    parser.add_argument("vdb", help=".vdb file, or the first frame of a sequence; or a .usda with a mesh")
    parser.add_argument("--show", choices=("mesh", "volume"), default="mesh",
                        help="the level set as a mesh, or the grid density as fog [mesh]")
    parser.add_argument("--grid", default="surface", help="level set to mesh [surface]")
    parser.add_argument("--color", action="store_true",
                        help="colours by the grid Cd; the mesh is then fixed, not a modifier")
    parser.add_argument("--render", metavar="PNG", help="render a picture")
    parser.add_argument("--frame", type=int, help="frame of a sequence to render [the first]")
    parser.add_argument("--blur", action="store_true", help="motion blur, of a .usda of frames with --fields v")
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
    voxel = min(data.grids[0].matrix_object.to_scale())
    volume.location = 3 * [-voxel * (FARTHER + number_of(path, "scene.shift_in_voxels", 0.0))]
    bpy.context.view_layer.update()
    return volume


def load_film(path, frame):
    """Imports a .usda with a mesh, at a frame if it is a film."""
    if "usd_import" not in dir(bpy.ops.wm):
        sys.exit(f"{path}: this Blender has no importer of USD")
    before = set(bpy.data.objects)
    bpy.ops.wm.usd_import(filepath=str(path), apply_unit_conversion_scale=False)
    meshes = [obj for obj in set(bpy.data.objects) - before if obj.type == "MESH"]
    if not meshes:
        sys.exit(f"{path}: expected a mesh, got none")
    scene = bpy.context.scene
    scene.frame_set(scene.frame_start if frame is None else frame)
    return meshes[0]


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


def colors_of_grid(mesh, path, name):
    """Linear light of each vertex by the grid of that name, or None."""
    vdb = openvdb_module()
    if vdb is None:
        return None
    try:
        grid = vdb.read(str(path), name)
    except (KeyError, IOError):
        return None
    accessor = grid.getConstAccessor()
    farther = FARTHER * grid.transform.voxelSize()[0]
    out = []
    for vertex in mesh.vertices:
        x = [c - farther for c in vertex.co]
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


def colors_of_ply(mesh, path, offset):
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
    out = [of_vertex[tree.find((vertex.co + offset) / scale)[1]] for vertex in mesh.vertices]
    bpy.data.objects.remove(other)
    return out


def number_of(path, name, default):
    """A number that vdb_molsurf has put at the head of a .vdb: after its name, by the length before each, type and value."""
    with open(path, "rb") as file:
        _, found, rest = file.read(1 << 20).partition(name.encode())
    if not found:
        return default
    size, = struct.unpack_from("<i", rest)
    assert rest[4:4 + size] == b"double", rest[:20]
    return struct.unpack_from("<d", rest, 8 + size)[0]


def read_scale(path):
    """Scene units per Å that the file names; else 1."""
    return number_of(path, "scene.units_per_angstrom", 1.0)


def add_colors(mesh, path, volume, grid="Cd"):
    """Gives a mesh made of a volume the colours of its file; says so and returns False if there are none."""
    colors = colors_of_grid(mesh, path, grid) or colors_of_ply(mesh, path, volume.location)
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


def surface_material(colored, size, attribute="Cd"):
    """Coated, and light enters it as far as a fiftieth of the object's size."""
    material, shader = new_material("surface", "ShaderNodeBsdfPrincipled", "Surface")
    for value, *names in ((0.5, "Roughness"), (0.4, "Specular", "Specular IOR Level"),  # the second from Blender 4.0 on
                          (0.25, "Subsurface", "Subsurface Weight"), (0.35, "Clearcoat", "Coat Weight"),
                          (0.25, "Clearcoat Roughness", "Coat Roughness")):
        socket(shader, *names).default_value = value
    shader.inputs["Subsurface Radius"].default_value = 3 * [size / 50]
    if "Subsurface Scale" in shader.inputs:  # Blender 4.0 on
        shader.inputs["Subsurface Scale"].default_value = 1.0
    nodes = material.node_tree.nodes
    if colored:
        color = nodes.new("ShaderNodeAttribute")
        color.attribute_name = attribute
    else:
        color = nodes.new("ShaderNodeRGB")
        color.outputs["Color"].default_value = PLAIN
    connect_color(material, color)
    return material


def connect_color(material, node):
    """A surface in the colour that comes out of a node."""
    shader = next(node for node in material.node_tree.nodes if node.type == "BSDF_PRINCIPLED")
    for name in ("Base Color", "Subsurface Color"):  # the second until Blender 3.6
        if name in shader.inputs:
            material.node_tree.links.new(node.outputs["Color"], shader.inputs[name])


def fog_material(colored, size):
    """Light goes through a 24th of the object's size before the fog scatters it, which happens many times. What is
    scattered each time is 1 - (1 - colour)^2, which is more than the colour, so that it does not become dark."""
    material, shader = new_material("fog", "ShaderNodeVolumePrincipled", "Volume")
    nodes, links = material.node_tree.nodes, material.node_tree.links
    shader.inputs["Density Attribute"].default_value = "density"
    shader.inputs["Density"].default_value = 24 / size
    color, *steps = [nodes.new(f"ShaderNode{kind}") for kind in ("Attribute", "Invert", "Gamma", "Invert")]
    color.attribute_name = "Cd"
    steps[1].inputs["Gamma"].default_value = 2.0
    steps[2].inputs[0].default_value = 0.98  # rounded, a colour of 0 would be less than that
    if colored:
        links.new(color.outputs["Color"], steps[0].inputs["Color"])
    else:
        steps[0].inputs["Color"].default_value = PLAIN
    for before, after in zip(steps, [*steps[1:], shader]):
        links.new(before.outputs["Color"], after.inputs["Color"])
    shader.inputs["Color Attribute"].default_value = ""
    shader.inputs["Anisotropy"].default_value = 0.3
    return material


def box_of(obj):
    """Corners of the evaluated object's box in the scene: (low, high)."""
    evaluated = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
    corners = [evaluated.matrix_world @ Vector(corner) for corner in evaluated.bound_box]
    low = Vector([min(c[i] for c in corners) for i in range(3)])
    high = Vector([max(c[i] for c in corners) for i in range(3)])
    return low, high


def size_of(obj):
    low, high = box_of(obj)
    return (high - low).length


def outline_of(obj):
    """Points of the evaluated object in the scene, as one list of coordinates."""
    evaluated = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
    points = [Vector(corner) for corner in evaluated.bound_box]
    if obj.type == "MESH" and evaluated.data.vertices:
        vertices = evaluated.data.vertices
        step = max(1, len(vertices) // 20000)
        points = [vertices[i].co for i in range(0, len(vertices), step)]
    return [c for p in points for c in evaluated.matrix_world @ p]


def set_world(world, backdrop, sky):
    """The backdrop to the camera, a white sky of so much light to everything else."""
    world.use_nodes = True
    nodes, links = world.node_tree.nodes, world.node_tree.links
    nodes.clear()
    output, mix = nodes.new("ShaderNodeOutputWorld"), nodes.new("ShaderNodeMixShader")
    path = nodes.new("ShaderNodeLightPath")
    links.new(path.outputs["Is Camera Ray"], mix.inputs[0])
    for number, color, strength in ((1, WHITE, sky), (2, backdrop, 1.0)):
        background = nodes.new("ShaderNodeBackground")
        background.inputs["Color"].default_value = color
        background.inputs["Strength"].default_value = strength
        links.new(background.outputs[0], mix.inputs[number])
    links.new(mix.outputs[0], output.inputs["Surface"])


def aim(obj, target):
    obj.rotation_euler = (target - obj.location).to_track_quat("-Z", "Y").to_euler()


def add_ground(center, size, height):
    """A plane that shows nothing but the shadow of what is above it."""
    mesh = bpy.data.meshes.new("ground")
    corners = [(center.x + a * size, center.y + b * size, height) for a, b in ((-9, -9), (9, -9), (9, 9), (-9, 9))]
    mesh.from_pydata(corners, [], [(0, 1, 2, 3)])
    ground = bpy.data.objects.new("ground", mesh)
    ground.is_shadow_catcher = True
    bpy.context.scene.collection.objects.link(ground)


def set_stage(obj, turn, fog=False):
    """Camera and three lamps about the object, all in proportion to its size: a solid one over a white ground that
    takes its shadow, fog before the night."""
    low, high = box_of(obj)
    center, size = (low + high) / 2, (high - low).length
    backdrop, sky, light = (NIGHT, 0.1, 2.4) if fog else (WHITE, 0.3, 0.85)
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
    camera.location = center + 1.1 * (place - center)
    data.shift_y = 0.0 if fog else -0.025  # room for the shadow

    # Power falls with the square of the distance, which is in proportion to the size.
    for name, place, power, width in (("key", (-0.9, -1.2, 1.3), 30.0, 0.8),
                                      ("fill", (1.5, -0.9, 0.2), 9.0, 1.2),
                                      ("rim", (0.4, 1.5, 1.0), 26.0, 0.8)):
        lamp = bpy.data.objects.new(name, bpy.data.lights.new(name, "AREA"))
        lamp.data.energy = light * power * size * size
        lamp.data.size = width * size
        lamp.location = center + turned @ Vector(place) * size
        aim(lamp, center)
        scene.collection.objects.link(lamp)

    if scene.world is None:
        scene.world = bpy.data.worlds.new("world")
    set_world(scene.world, backdrop, sky)
    if not fog:
        add_ground(center, size, low.z)


def set_size(width):
    """Of the picture, 4 to 3; before the camera is set, which fits it."""
    rendered = bpy.context.scene.render
    rendered.resolution_x, rendered.resolution_y = width, width * 3 // 4
    rendered.resolution_percentage = 100


def render(path, samples):
    import _cycles  # of Blender, which may be without Cycles

    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = samples
    scene.cycles.use_denoising = _cycles.with_openimagedenoise  # Debian's Blender has no denoiser
    scene.cycles.volume_bounces = 8
    scene.view_settings.view_transform = "Standard"  # colours as they are in Cd
    scene.render.film_transparent = False
    scene.render.image_settings.file_format = "PNG"
    scene.render.filepath = str(pathlib.Path(path).resolve())
    bpy.ops.render.render(write_still=True)


def open_surface(path, show="mesh", grid="surface", color=False, turn=0.0, frame=None):
    """Puts a surface and its stage into the scene; the volume, which a .usda has not, and what is shown."""
    path = pathlib.Path(path).resolve()
    if not path.is_file():
        sys.exit(f"{path}: there is no such file")
    for name in ("Cube", "Light", "Camera"):  # of the scene that Blender starts with
        if name in bpy.data.objects:
            bpy.data.objects.remove(bpy.data.objects[name])
    if path.suffix == ".usda":
        shown = load_film(path, frame)
        colored = "displayColor" in shown.data.attributes
        shown.data.materials.clear()
        shown.data.materials.append(surface_material(colored, size_of(shown), "displayColor"))
        set_stage(shown, turn)
        return None, shown
    volume = load_volume(path)
    names = [g.name for g in volume.data.grids]
    if show == "volume":
        if "density" not in names:
            sys.exit(f"{path}: there is no grid density [hint: vdb_molsurf --for blender]")
        shown = volume
        outline = mesh_of(volume, grid) if grid in names else volume
        volume.data.materials.append(fog_material("Cd" in names, size_of(outline)))
        set_stage(outline, turn, fog=True)
        if outline is not volume:
            bpy.data.objects.remove(outline)
        volume.hide_render = False
    else:
        shown = mesh_of(volume, grid)
        colored = color and add_colors(fixed(shown), path, volume)
        material = surface_material(colored, size_of(shown))
        shown.data.materials.clear()
        shown.data.materials.append(material)
        set_stage(shown, turn)
    return volume, shown


def main():
    options = arguments()
    set_size(options.size)
    open_surface(options.vdb, options.show, options.grid, options.color, options.turn, options.frame)
    bpy.context.scene.render.use_motion_blur = options.blur
    bpy.context.scene.render.motion_blur_shutter = 1.0  # of a frame
    if options.frame is not None:
        bpy.context.scene.frame_set(options.frame)
    if options.save:
        bpy.ops.wm.save_as_mainfile(filepath=str(pathlib.Path(options.save).resolve()))
    if options.render:
        render(options.render, options.samples)


if __name__ == "__main__":
    main()
