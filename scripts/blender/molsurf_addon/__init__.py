# SPDX-License-Identifier: MPL-2.0
"""Add-on of Blender: surfaces of vdb_molsurf as meshes, volumes or copies, with attributes and materials.

View3D > Sidebar > Molecular Surface. scripts/blender/make_addon.sh packs it; Edit > Preferences > Add-ons > Install from
Disk takes the .zip, as an extension from Blender 4.2 on. The add-on calls the program vdb_molsurf, whose path stands in its preferences, and makes its options of the
program's own table. A trajectory becomes a mesh a frame, and the object shows that of the scene's frame.
Tried in Blender 3.4.1, 4.2.23, 4.5.15 and 5.0.1.
"""

import json
import math
import os
import pathlib
import re
import subprocess
import tempfile

import bpy
import numpy as np
from bpy.app.handlers import persistent
from mathutils import Matrix

bl_info = {
    "name": "Molecular Surface (vdb_molsurf)", "author": "vdb_molsurf", "version": (0, 1, 0), "blender": (3, 4, 0),
    "location": "View3D > Sidebar > Molecular Surface", "category": "Add Mesh",
    "description": "Smooth molecular surfaces as meshes, volumes and copies",
}

SECTIONS = ("Atoms", "Surface", "Resolution", "Groups", "Evolution", "Run")  # of the program's page of options
OURS = ("force", "quiet", "verbose", "no-progress", "config", "instances", "assembly", "color", "frames", "trajectory", "memory",
        "dry-run")  # set here, or of no use here
FRAMES = "molsurf_frames"
SYMBOLS = (  # by atomic number
    "X H He Li Be B C N O F Ne Na Mg Al Si P S Cl Ar K Ca Sc Ti V Cr Mn Fe Co Ni Cu Zn Ga Ge As Se Br Kr Rb Sr Y Zr Nb Mo Tc "
    "Ru Rh Pd Ag Cd In Sn Sb Te I Xe Cs Ba La Ce Pr Nd Pm Sm Eu Gd Tb Dy Ho Er Tm Yb Lu Hf Ta W Re Os Ir Pt Au Hg Tl Pb Bi "
    "Po At Rn Fr Ra Ac Th Pa U").split()


class Failed(Exception):
    """What the program said, in one line."""


def run_program(program, words, folder):
    try:
        done = subprocess.run([program, *map(str, words)], cwd=folder, capture_output=True, text=True)
    except OSError as error:
        raise Failed(f"{program} does not start: {error.strerror} [hint: its path stands in the add-on's preferences]") from None
    if done.returncode not in (0, 3):  # 3: not converged, files are there
        raise Failed((done.stderr.strip().splitlines() or [f"{program} ended with {done.returncode}"])[-1])
    return done.stdout, [line for line in done.stderr.splitlines() if "warning" in line]


def options_of(program):
    """[(section, name, value in capitals or "", help, default)] of the program's own table."""
    text, _ = run_program(program, ["--options-page"], None)
    rows, section = [], ""
    for line in text.splitlines():
        if line.startswith("## "):
            section = line[3:]
        match = re.match(r"\| `--([a-z-]+)( [^`]*)?` \| (.*?) \| (.*?) \| .*\bbuild\b.*\|$", line)
        if match and section in SECTIONS and match[1] not in OURS:
            name, value, text, default = match.groups()
            rows.append((section, name, (value or "").strip(), text.replace("\\|", "|"), default))
    return rows


def read_ply(path):
    """(names, vertices as a structured array, triangles) of a binary .ply."""
    header, body = pathlib.Path(path).read_bytes().split(b"end_header\n", 1)
    kinds, counts, element = [], {}, ""
    for line in header.decode().splitlines():
        words = line.split()
        if words[0] == "element":
            element = words[1]
            counts[element] = int(words[2])
        elif words[0] == "property" and element == "vertex":
            kinds.append((words[2], {"float": "<f4", "int": "<i4", "uchar": "u1"}[words[1]]))
    vertices = np.frombuffer(body, np.dtype(kinds), counts["vertex"])
    faces = np.frombuffer(body, np.dtype([("count", "u1"), ("corners", "<i4", 3)]), counts["face"], vertices.nbytes)
    return [name for name, _ in kinds], vertices, faces["corners"]


def linear(color):
    """Linear light of sRGB from 0 to 1."""
    return np.where(color <= 0.04045, color / 12.92, ((color + 0.055) / 1.055) ** 2.4)


def mesh_of(path, name, scale):
    """A mesh with the attributes of a .ply, smooth, in scene units."""
    names, vertices, triangles = read_ply(path)
    mesh = bpy.data.meshes.new(name)
    count = len(triangles)
    mesh.vertices.add(len(vertices))
    mesh.loops.add(3 * count)
    mesh.polygons.add(count)
    places = np.stack([vertices[axis] for axis in "xyz"], axis=1).astype("f4") * scale
    mesh.vertices.foreach_set("co", places.ravel())
    mesh.loops.foreach_set("vertex_index", triangles.astype("i4").ravel())
    mesh.polygons.foreach_set("loop_start", np.arange(0, 3 * count, 3, dtype="i4"))
    if bpy.app.version < (4, 1, 0):
        mesh.polygons.foreach_set("loop_total", np.full(count, 3, dtype="i4"))
    mesh.polygons.foreach_set("use_smooth", np.ones(count, dtype=bool))
    for attribute in names:
        if attribute in ("x", "y", "z", "nx", "ny", "nz", "red", "green", "blue"):
            continue
        kind = "INT" if vertices[attribute].dtype.kind == "i" else "FLOAT"
        mesh.attributes.new(attribute, kind, "POINT").data.foreach_set("value", np.ascontiguousarray(vertices[attribute]))
    if "red" in names:
        rgb = np.stack([vertices[c] for c in ("red", "green", "blue")], axis=1) / 255.0
        rgba = np.concatenate([linear(rgb), np.ones((len(vertices), 1))], axis=1).astype("f4")
        colors = mesh.color_attributes.new("Cd", "FLOAT_COLOR", "POINT")
        colors.data.foreach_set("color", rgba.ravel())
        mesh.color_attributes.active_color = mesh.color_attributes["Cd"]
    mesh.update(calc_edges=True)
    mesh.validate()
    return mesh


def values_of(mesh, name, kind="value", width=1):
    """An attribute of the points of a mesh, or None."""
    if name not in mesh.attributes:
        return None
    data = mesh.attributes[name].data
    flat = np.zeros(width * len(data), dtype="f4")
    data.foreach_get(kind, flat)
    return flat.reshape(-1, width) if width > 1 else flat


def write_atoms(obj, scale, folder):
    """Writes the points of an object as atoms: by atomic_number, chain_id, res_id and b_factor, as Molecular Nodes has them,
    else by vdw_radii. Those that have is_solvent are left out. Returns the path, and the point of each atom."""
    mesh = obj.data
    radii, numbers = values_of(mesh, "vdw_radii"), values_of(mesh, "atomic_number")
    if numbers is None and radii is None:
        raise Failed(f"{obj.name}: expected points with atomic_number or vdw_radii, as of Molecular Nodes, got none")
    places = np.zeros(3 * len(mesh.vertices), dtype="f4")
    mesh.vertices.foreach_get("co", places)
    places = places.reshape(-1, 3) / scale
    solvent = values_of(mesh, "is_solvent")
    kept = np.arange(len(places)) if solvent is None else np.flatnonzero(solvent == 0)
    if numbers is None:
        path = folder / "atoms.xyzr"
        path.write_text("".join("%.4f %.4f %.4f %.4f\n" % (*places[i], radii[i] / scale) for i in kept))
        return path, kept
    nothing = np.zeros(len(places))
    chains, residues, factors = (found if found is not None else nothing
                                 for found in (values_of(mesh, name) for name in ("chain_id", "res_id", "b_factor")))
    rows = ["data_atoms\nloop_\n"] + [f"_atom_site.{name}\n" for name in (
        "group_PDB", "id", "type_symbol", "label_atom_id", "label_comp_id", "label_asym_id", "label_seq_id", "auth_seq_id",
        "Cartn_x", "Cartn_y", "Cartn_z", "B_iso_or_equiv")]
    for i in kept:
        number = int(numbers[i])
        element = SYMBOLS[number] if 0 < number < len(SYMBOLS) else "X"
        rows.append("ATOM %d %s %s UNK %d %d %d %.4f %.4f %.4f %.2f\n" % (
            i + 1, element, element, chains[i], residues[i], residues[i], *places[i], factors[i]))
    path = folder / "atoms.cif"
    path.write_text("".join(rows))
    return path, kept


def color_by_atoms(mesh, points, point_of):
    """Gives each vertex the colour of the point of its atom, the attribute Color of another mesh."""
    colors = values_of(points, "Color", "color", 4)
    if colors is None:
        raise Failed("colour: expected points with the attribute Color, got none [hint: chain, element]")
    nearest = point_of[values_of(mesh, "atom_id").astype(int)]
    own = mesh.color_attributes.new("Cd", "FLOAT_COLOR", "POINT")
    own.data.foreach_set("color", colors[nearest].ravel())
    mesh.color_attributes.active_color = own


def material_of(kind):
    """The material of all surfaces, volumes or copies, made once: "Cd", "fog" or "copy"."""
    name = f"molsurf {kind}"
    if name in bpy.data.materials:
        return bpy.data.materials[name]
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    shader = next(node for node in nodes if node.type == "BSDF_PRINCIPLED")
    if kind == "fog":
        nodes.remove(shader)
        fog = nodes.new("ShaderNodeVolumePrincipled")
        fog.inputs["Color Attribute"].default_value = "Cd"
        fog.inputs["Density"].default_value = 5.0
        links.new(fog.outputs[0], next(n for n in nodes if n.type == "OUTPUT_MATERIAL").inputs["Volume"])
        return material
    shader.inputs["Roughness"].default_value = 0.5
    if kind == "copy":
        links.new(nodes.new("ShaderNodeObjectInfo").outputs["Color"], shader.inputs["Base Color"])
    else:
        color = nodes.new("ShaderNodeAttribute")
        color.attribute_name = "Cd"
        links.new(color.outputs["Color"], shader.inputs["Base Color"])
    return material


def link(name, data, collection):
    obj = bpy.data.objects.new(name, data)
    collection.objects.link(obj)
    return obj


class Request:
    """What is asked for, apart from any panel: build() makes objects of it."""

    def __init__(self, program, input, show="mesh", color="chain", assembly="", trajectory="", frames="", scale=0.1,
                 options=None, atoms=None):
        self.program, self.input, self.show, self.color, self.atoms = program, str(input), show, color, atoms
        self.assembly, self.trajectory, self.frames, self.scale = assembly, str(trajectory or ""), frames, scale
        self.options = dict(options or {})

    def words(self):
        words = [os.path.abspath(self.input), "--force"]
        for name, value in self.options.items():
            words += [f"--{name}"] if value is True else [f"--{name}", value]
        if self.assembly:
            words += ["--assembly", self.assembly]
        if self.trajectory:
            words += ["--trajectory", os.path.abspath(self.trajectory)]
        if self.trajectory or self.frames:
            words += ["--frames", self.frames or "all"]
        return words

    def build(self, collection):
        """Returns the objects and the warnings."""
        make = {"mesh": self.meshes, "volume": self.volume, "instances": self.copies}[self.show]
        with tempfile.TemporaryDirectory() as temporary:
            folder = pathlib.Path(temporary)
            if not self.atoms:
                return make(pathlib.Path(self.input).name.split(".")[0], collection, folder)
            self.input, self.point_of = write_atoms(self.atoms, self.scale, folder)
            objects, warnings = make(re.sub(r"\W", "_", self.atoms.name), collection, folder)
            for obj in objects:
                obj.matrix_world = self.atoms.matrix_world @ obj.matrix_world
            return objects, warnings

    def meshes(self, name, collection, folder):
        by_atoms = self.atoms and self.color == "atoms"
        color = ["--color", self.color] if self.color and not by_atoms else []
        _, warnings = run_program(self.program, [*self.words(), *color, "-o", f"{name}.ply"], folder)
        paths = sorted(folder.glob(f"{name}*.ply"))
        meshes = [mesh_of(path, path.stem, self.scale) for path in paths]
        for mesh in meshes:
            if by_atoms:
                color_by_atoms(mesh, self.atoms.data, self.point_of)
            mesh.materials.append(material_of("Cd"))
        obj = link(name, meshes[0], collection)
        if self.trajectory or self.frames:
            obj[FRAMES] = json.dumps([mesh.name for mesh in meshes])
            for mesh in meshes:
                mesh.use_fake_user = True  # kept in the file while others are shown
            scene = bpy.context.scene
            scene.frame_start, scene.frame_end = 1, len(meshes)
            show_frame(scene)
        return [obj], warnings

    def volume(self, name, collection, folder):
        color = ["--color", self.color] if self.color else []
        kept = pathlib.Path(bpy.data.filepath).parent if bpy.data.filepath else pathlib.Path(tempfile.gettempdir())
        path = kept / f"{name}.molsurf.vdb"  # Blender reads it again whenever it shows the volume
        host = "blender4" if bpy.app.version < (5, 0, 0) else "blender"
        _, warnings = run_program(self.program, [*self.words(), *color, "--for", f"{host}={self.scale}", "-o", path], folder)
        data = bpy.data.volumes.new(name)
        data.filepath = str(path)
        data.grids.load()
        if data.grids.error_message:
            raise Failed(f"{path}: {data.grids.error_message}")
        data.materials.append(material_of("fog"))
        return [link(name, data, collection)], warnings

    def copies(self, name, collection, folder):
        if not self.assembly:
            raise Failed("copies: expected an assembly, got none [hint: 1, for example]")
        out = ["--instances", "-o", f"{name}.ply", "-o", f"{name}.json"]
        _, warnings = run_program(self.program, [*self.words(), *out], folder)
        report = json.loads((folder / f"{name}.json").read_text())
        if len(report["parts"]) > 1:
            raise Failed(f"the assembly has {len(report['parts'])} distinct copies, expected one [hint: show a mesh]")
        mesh = mesh_of(folder / f"{name}.ply", name, self.scale)
        mesh.materials.append(material_of("copy"))
        whole = link(f"{name} assembly", None, collection)
        objects = [whole]
        for number, instance in enumerate(report["instances"]):
            copy = link(f"{name} {number + 1}", mesh, collection)
            matrix = Matrix(instance["matrix"])
            matrix.translation *= self.scale
            copy.parent = whole
            copy.matrix_world = matrix
            hue = number * 0.618 % 1.0  # neighbours differ
            copy.color = (*(0.45 + 0.35 * math.cos(2 * math.pi * (hue + shift / 3)) for shift in range(3)), 1.0)
            objects.append(copy)
        return objects, [line for line in warnings if "each distinct copy once" not in line]


@persistent
def show_frame(scene, _=None):
    """Gives objects of trajectories the mesh of the scene's frame."""
    for obj in bpy.data.objects:
        if FRAMES in obj:
            names = json.loads(obj[FRAMES])
            mesh = bpy.data.meshes.get(names[min(max(scene.frame_current, 1), len(names)) - 1])
            if mesh:
                obj.data = mesh


class MOLSURF_Preferences(bpy.types.AddonPreferences):
    bl_idname = __name__
    program: bpy.props.StringProperty(name="Program", subtype="FILE_PATH", default="vdb_molsurf",
                                      description="vdb_molsurf, or its path")

    def draw(self, _):
        self.layout.prop(self, "program")


class MOLSURF_Option(bpy.types.PropertyGroup):
    section: bpy.props.StringProperty()
    word: bpy.props.StringProperty()  # of its value; empty: it is a switch
    help: bpy.props.StringProperty()
    default: bpy.props.StringProperty()
    value: bpy.props.StringProperty(name="Value", description="Empty: the default")
    on: bpy.props.BoolProperty(name="On")


class MOLSURF_Settings(bpy.types.PropertyGroup):
    input: bpy.props.StringProperty(name="Structure", subtype="FILE_PATH")
    atoms: bpy.props.PointerProperty(name="Atoms", type=bpy.types.Object,
                                     description="Object whose points are atoms, as of Molecular Nodes, instead of a file")
    show: bpy.props.EnumProperty(name="Show", items=[("mesh", "Mesh", "A mesh with attributes and colours"),
                                                     ("volume", "Volume", "Level set and fog"),
                                                     ("instances", "Copies", "One mesh, an object for each copy")])
    color: bpy.props.StringProperty(name="Colour", default="chain", description="chain, element, residue, mean-curvature, ...; atoms: Color of the points")
    assembly: bpy.props.StringProperty(name="Assembly", description="Name of a biological assembly, as 1")
    trajectory: bpy.props.StringProperty(name="Trajectory", subtype="FILE_PATH")
    frames: bpy.props.StringProperty(name="Frames", description="all, 1-100:5; models without a trajectory")
    scale: bpy.props.FloatProperty(name="Units per Å", default=0.1, min=1e-4)
    section: bpy.props.StringProperty(name="Options", default="Surface")
    options: bpy.props.CollectionProperty(type=MOLSURF_Option)


def program_of(context):
    addon = context.preferences.addons.get(__name__)
    return addon.preferences.program if addon else os.environ.get("VDB_MOLSURF", "vdb_molsurf")


class MOLSURF_OT_options(bpy.types.Operator):
    """Reads the options of the program"""
    bl_idname = "molsurf.options"
    bl_label = "Read Options"

    def execute(self, context):
        options = context.scene.molsurf.options
        try:
            rows = options_of(program_of(context))
        except Failed as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        options.clear()
        for section, name, word, text, default in rows:
            option = options.add()
            option.section, option.name, option.word, option.help, option.default = section, name, word, text, default
        return {"FINISHED"}


class MOLSURF_OT_build(bpy.types.Operator):
    """Makes the surface"""
    bl_idname = "molsurf.build"
    bl_label = "Make Surface"
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context):
        s = context.scene.molsurf
        options = {o.name: o.value if o.word else True for o in s.options if (o.value if o.word else o.on)}
        request = Request(program_of(context), bpy.path.abspath(s.input), s.show, s.color, s.assembly,
                          bpy.path.abspath(s.trajectory), s.frames, s.scale, options, s.atoms)
        try:
            objects, warnings = request.build(context.collection)
        except Failed as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        for warning in warnings:
            self.report({"WARNING"}, warning)
        self.report({"INFO"}, f"{objects[0].name}: {len(objects)} objects")
        return {"FINISHED"}


class MOLSURF_PT_panel(bpy.types.Panel):
    bl_label = "Molecular Surface"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Molecular Surface"

    def draw(self, context):
        s, layout = context.scene.molsurf, self.layout
        for name in ("input", "atoms", "show", "color", "assembly", "trajectory", "frames", "scale"):
            layout.prop(s, name)
        layout.operator("molsurf.build")
        if not len(s.options):
            layout.operator("molsurf.options")
            return
        for section in dict.fromkeys(option.section for option in s.options):
            box = layout.box()
            box.label(text=section)
            for option in s.options:
                if option.section == section:
                    label = f"{option.name} [{option.default}]" if option.default else option.name
                    box.prop(option, "value" if option.word else "on", text=label)


CLASSES = (MOLSURF_Preferences, MOLSURF_Option, MOLSURF_Settings, MOLSURF_OT_options, MOLSURF_OT_build, MOLSURF_PT_panel)


def register():
    for each in CLASSES:
        bpy.utils.register_class(each)
    bpy.types.Scene.molsurf = bpy.props.PointerProperty(type=MOLSURF_Settings)
    bpy.app.handlers.frame_change_post.append(show_frame)


def unregister():
    bpy.app.handlers.frame_change_post.remove(show_frame)
    del bpy.types.Scene.molsurf
    for each in reversed(CLASSES):
        bpy.utils.unregister_class(each)
