# SPDX-License-Identifier: MPL-2.0
"""Runs the add-on in Blender or bpy: prints what it made as JSON. Words: folder of the add-on, or the .zip of the extension,
which is installed; structures."""

import json
import os
import sys

import bpy

words = sys.argv[sys.argv.index("--") + 1:]
EXTENSION = "bl_ext.user_default.molsurf_addon" if words[0].endswith(".zip") else None
if EXTENSION:
    bpy.ops.extensions.package_install_files(filepath=words[0], repo="user_default", enable_on_install=True)
    bpy.context.preferences.addons[EXTENSION].preferences.program = os.environ["VDB_MOLSURF"]
else:
    sys.path.insert(0, words[0])
    import molsurf_addon
    molsurf_addon.register()
settings = bpy.context.scene.molsurf
result = {}


def build(**values):
    for name, value in {"show": "mesh", "color": "", "assembly": "", "trajectory": "", "frames": "", "scale": 0.1,
                        "atoms": None, **values}.items():
        setattr(settings, name, value)
    before = set(bpy.data.objects)
    try:
        bpy.ops.molsurf.build()
    except RuntimeError as error:
        return str(error)
    return sorted(set(bpy.data.objects) - before, key=lambda o: o.name)


def triangles(mesh):
    mesh.calc_loop_triangles()
    return sum(t.area for t in mesh.loop_triangles)


def from_colored(mesh):
    """The largest distance of a vertex from the point whose colour it has [Å]."""
    indices = [round(c.color[0] * len(lines)) for c in mesh.color_attributes["Cd"].data]
    return 100.0 * max((v.co - points.vertices[i].co).length for v, i in zip(mesh.vertices, indices))


bpy.ops.molsurf.options()
options = {option.name: option for option in settings.options}
result["options"] = sorted(options)
options["voxel"].value = "1"
options["surface"].value = "ses"
obj, = build(input=words[1], color="element")
mesh = obj.data
result["mesh"] = {"vertices": len(mesh.vertices), "faces": len(mesh.polygons), "area": triangles(mesh),
                  "attributes": [a.name for a in mesh.attributes], "material": mesh.materials[0].name,
                  "atoms": [v.value for v in mesh.attributes["atom_id"].data][:100],
                  "first": list(mesh.vertices[0].co)}
obj, = build(input=words[1], show="volume")
grid = obj.data.grids["surface"]
result["volume"] = {"grids": sorted(g.name for g in obj.data.grids), "material": obj.data.materials[0].name,
                    "origin": list(grid.matrix_object.translation)}
result["version"] = bpy.app.version[0]
copies = build(input=words[2], show="instances", assembly="1")
result["copies"] = {"count": len(copies), "meshes": len({o.data.name for o in copies if o.data}),
                    "matrices": [[list(row) for row in o.matrix_world] for o in copies if o.data]}
points = bpy.data.meshes.new("points")  # as Molecular Nodes has atoms
lines = [line for line in open(words[1]) if line.startswith(("ATOM", "HETATM"))]
places = [0.01 * float(line[begin:begin + 8]) for line in lines for begin in (30, 38, 46)]
points.vertices.add(len(lines))
points.vertices.foreach_set("co", places)
numbers = [{"C": 6, "N": 7, "O": 8, "S": 16}[line[76:78].strip()] for line in lines]
points.attributes.new("atomic_number", "INT", "POINT").data.foreach_set("value", numbers)
points.attributes.new("Color", "FLOAT_COLOR", "POINT").data.foreach_set(
    "color", [value for i in range(len(lines)) for value in (i / len(lines), 0.5, 0.25, 1.0)])
holder = bpy.data.objects.new("points", points)
holder.location = (1.0, 2.0, 3.0)
bpy.context.collection.objects.link(holder)
bpy.context.view_layer.update()
obj, = build(atoms=holder, color="atoms", scale=0.01)
result["points"] = {"vertices": len(obj.data.vertices), "location": list(obj.matrix_world.translation),
                    "first": list(obj.data.vertices[0].co), "farthest": from_colored(obj.data)}
solvent = points.attributes.new("is_solvent", "BOOLEAN", "POINT")
solvent.data.foreach_set("value", [i < 40 for i in range(len(lines))])
obj, = build(atoms=holder, color="atoms", scale=0.01)
result["dry"] = {"farthest": from_colored(obj.data), "least": min(c.color[0] for c in obj.data.color_attributes["Cd"].data) * len(lines)}
points.attributes.remove(points.attributes["atomic_number"])
result["no atoms"] = build(atoms=holder)
frames, = build(input=words[3], frames="1-5:2")
result["frames"] = []
for frame in (1, 2, 3, 9):
    bpy.context.scene.frame_set(frame)
    result["frames"].append((frames.data.name, triangles(frames.data)))
options["voxel"].value = "20"
result["error"] = build(input=words[1])
if EXTENSION:
    bpy.ops.preferences.addon_disable(module=EXTENSION)
else:
    molsurf_addon.unregister()
print("RESULT " + json.dumps(result))
