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
                        **values}.items():
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
