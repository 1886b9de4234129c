# SPDX-License-Identifier: MPL-2.0
"""Runs with OpenUSD's Python module for test_usd.py: opens the .usda files that are named, validates them, and prints
what is in them as a JSON list, on a line that starts with RESULT. Every variant is opened by itself."""

import json
import sys

from pxr import Usd, UsdGeom, UsdShade, UsdValidation, UsdVol

NOW = Usd.TimeCode.Default()


def faults(stage):
    """What OpenUSD's validators say, and extents that are not what OpenUSD computes."""
    validators = UsdValidation.ValidationRegistry().GetOrLoadAllValidators()
    out = [error.GetErrorAsString() for error in UsdValidation.ValidationContext(validators).Validate(stage)]
    out = [line for line in out if "MissingShaderIdInRegistry" not in line or "'ND_" not in line]  # of MaterialX
    for prim in Usd.PrimRange(stage.GetPseudoRoot(), Usd.PrimAllPrimsPredicate):
        boundable = UsdGeom.Boundable(prim)
        if not boundable or UsdVol.Volume(prim):  # OpenUSD alone does not look into .vdb files
            continue
        for time in boundable.GetExtentAttr().GetTimeSamples() or [NOW]:
            seen = boundable.GetExtentAttr().Get(time)
            computed = UsdGeom.Boundable.ComputeExtentFromPlugins(boundable, time)
            size = max(abs(x) for p in computed for x in p)
            if not seen or any(abs(a - b) > 1e-3 + 1e-3 * size for p, q in zip(seen, computed) for a, b in zip(p, q)):
                out.append(f"{prim.GetPath()}: extent {seen}, computed {computed}")
    return out


def transposed(matrix):
    """OpenUSD multiplies rows by matrices; as lists, x ↦ Mx."""
    return [[matrix[column][row] for column in range(4)] for row in range(4)]


def mesh(prim):
    points, shown = UsdGeom.Mesh(prim), UsdGeom.PrimvarsAPI(prim).GetPrimvar("displayColor")
    material, _ = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()
    surface, _, _ = material.ComputeSurfaceSource()
    color = surface.GetInput("diffuseColor")
    source = color.GetConnectedSources()[0]
    if source:  # colours of vertices: the primvar that they are read from
        color = source[0].source.GetPrim().GetAttribute("inputs:varname")
    return {"points": [list(p) for p in points.GetPointsAttr().Get()],
            "triangles": list(points.GetFaceVertexIndicesAttr().Get()),
            "corners": sorted(set(points.GetFaceVertexCountsAttr().Get())),
            "normals": len(points.GetNormalsAttr().Get()),
            "colors": [list(c) for c in shown.Get()], "interpolation": shown.GetInterpolation(),
            "material": color.Get() if source else list(color.Get())}


def shapes(prim):
    """A mesh at each of its times, or at none."""
    points, shown = UsdGeom.Mesh(prim), UsdGeom.PrimvarsAPI(prim).GetPrimvar("displayColor")
    material, _ = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()
    surface, _, _ = material.ComputeSurfaceSource()
    world = UsdGeom.Xformable(prim).ComputeLocalToWorldTransform(NOW)
    times = points.GetPointsAttr().GetTimeSamples()
    out = []
    for time in times or [NOW]:
        triangles, corners, at = (attribute.Get(time) for attribute in (
            points.GetFaceVertexIndicesAttr(), points.GetFaceVertexCountsAttr(), points.GetPointsAttr()))
        late = [list(p) for p in points.ComputePointsAtTime(time + 0.5, time)] if times else None
        whole, why = UsdGeom.Mesh.ValidateTopology(triangles, corners, len(at))
        out.append({"time": time if times else None, "points": [list(world.Transform(p)) for p in at], "late": late,
                    "here": [list(p) for p in at], "triangles": list(triangles), "whole": whole and set(corners) == {3},
                    "normals": len(points.GetNormalsAttr().Get(time)), "shader": surface.GetIdAttr().Get(),
                    "velocities": [list(v) for v in points.GetVelocitiesAttr().Get(time) or []],
                    "colors": len(shown.Get(time) or []), "interpolation": shown.GetInterpolation()})
    return out


def copies(stage, prim):
    instancer = UsdGeom.PointInstancer(prim)
    world = UsdGeom.Xformable(prim).ComputeLocalToWorldTransform(NOW)
    bound = UsdGeom.BBoxCache(NOW, ["default"]).ComputeWorldBound(prim).ComputeAlignedRange()
    return {"ids": list(instancer.GetIdsAttr().Get()), "part": list(instancer.GetProtoIndicesAttr().Get()),
            "matrices": [transposed(m * world) for m in instancer.ComputeInstanceTransformsAtTime(NOW, NOW)],
            "meshes": [mesh(stage.GetPrimAtPath(path)) for path in instancer.GetPrototypesRel().GetTargets()
                       if UsdGeom.Mesh(stage.GetPrimAtPath(path))],
            "box": [list(bound.GetMin()), list(bound.GetMax())]}


def volume(stage, prim):
    extent = UsdVol.Volume(prim).GetExtentAttr()
    frames = [[time, [list(p) for p in extent.Get(time)]] for time in extent.GetTimeSamples()]
    fog, _ = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()
    shader = fog.ComputeVolumeSource("mtlx")[0] if fog else None
    out = {"scattering": fog.GetInput("scattering").Get() if fog else None,
           "shader": shader.GetIdAttr().Get() if shader else None,
           "extent": frames or [list(p) for p in extent.Get()], "fields": {}}
    for name, path in UsdVol.Volume(prim).GetFieldPaths().items():
        field = UsdVol.OpenVDBAsset(stage.GetPrimAtPath(path))
        files = field.GetFilePathAttr()
        out["fields"][name] = {
            "name": field.GetFieldNameAttr().Get(), "class": field.GetFieldClassAttr().Get(),
            "type": field.GetFieldDataTypeAttr().Get(),
            "files": [[time, files.Get(time).resolvedPath] for time in files.GetTimeSamples()] or
                     [[None, files.Get().resolvedPath]]}
    return out


def scene(stage):
    out = {"faults": faults(stage), "copies": None, "volume": None,
           "meshes": sum(prim.IsA(UsdGeom.Mesh) for prim in stage.Traverse()),
           "meters": UsdGeom.GetStageMetersPerUnit(stage), "up": UsdGeom.GetStageUpAxis(stage),
           "times": [stage.GetStartTimeCode(), stage.GetEndTimeCode()] if stage.HasAuthoredTimeCodeRange() else None}
    for prim in stage.Traverse():
        if UsdGeom.PointInstancer(prim):
            out["copies"] = copies(stage, prim)
        if UsdVol.Volume(prim):
            out["volume"] = volume(stage, prim)
    if not out["copies"]:
        out["shapes"] = [shapes(prim) for prim in stage.Traverse() if UsdGeom.Mesh(prim)]
        out["names"] = [prim.GetDisplayName() for prim in stage.Traverse() if UsdGeom.Mesh(prim)]
    return out


result = []
for path in sys.argv[1:]:
    stage = Usd.Stage.Open(path)
    sets = stage.GetDefaultPrim().GetVariantSets()
    variants = [(kind, name) for kind in sets.GetNames() for name in sets.GetVariantSet(kind).GetVariantNames()]
    scenes = {"": scene(stage)}
    for kind, name in variants:
        sets.GetVariantSet(kind).SetVariantSelection(name)
        scenes[name] = scene(stage)
    result.append(scenes)
print("RESULT " + json.dumps(result))
