# SPDX-License-Identifier: MPL-2.0
"""Command line, keywords and type hints have one set of names, defaults and ranges."""

import ast
import inspect
import pathlib
import re
import runpy
import sys

import pytest
import vdb_molsurf as ms
from conftest import ROOT
from vdb_molsurf import _core, _options

# Options of files, terminals and machines, which a module has no use for.
OF_A_PROGRAM = {"output", "format", "force", "memory", "max-hours", "dry-run", "require", "skip-existing", "threads", "quiet", "verbose",
                "no-progress", "config", "help", "help-all", "version", "list-radii"}
# Options that Python has in another form: groups=, table(), Molecule.superpose(), save(scene=), picture(width), and for trajectories
# the molecules of MDAnalysis and MDTraj, one surface a frame. Its meshes have all copies: their borders are welded, and none is
# placed by a level of detail.
OTHERWISE = {"groups", "areas", "for", "size", "frames", "first-frame", "trajectory", "update-selections", "superpose", "weld", "lod"}
COMMAND_LINE = OF_A_PROGRAM | OTHERWISE
# Keywords of what files of atoms have, which the command line takes along by itself.
OF_PYTHON = {"charges"}


def options_of_build():
    """Name and default of the options that the page of the command line has."""
    page = (ROOT / "docs" / "options.md").read_text()
    rows = re.findall(r"^\| `--([a-z-]+)[^`]*`(?:, `-\w`)? \| (.*) \| (.*?) \| ([^|]*) \|$", page, re.MULTILINE)
    return {name: preset for name, _, preset, verbs in rows if re.search(r"\b(build|all)\b", verbs)}


def of_files():
    """Options that the methods have which write files."""
    methods = (ms.Surface.save, ms.Surface.to_vdb, ms.Surface.to_apbs, ms.Surface.to_tomogram, ms.Surface.picture)
    parameters = {name for method in methods for name in inspect.signature(method).parameters}
    return {name.replace("_", "-").replace("panels", "panel")
            for name in parameters - {"self", "path", "folder", "width", "replace", "scene", "look"}}


def test_command_line_and_keywords_have_the_same_names_and_defaults():
    """Whatever builds a surface on the command line is there in Python, too."""
    told = options_of_build()
    assert set(told) == (set(_options.SETTINGS) - OF_PYTHON) | COMMAND_LINE | of_files()
    assert not OF_PYTHON & set(told)
    for name, row in _options.SETTINGS.items():
        assert name in OF_PYTHON or told[name] == row["preset"] or name == "steps", name
        words = " ".join(row["text"].split())
        assert row["text"] and "--" not in words


def test_save_writes_the_endings_of_the_command_line():
    """All but the tables of frames, which are of several surfaces."""
    page = (ROOT / "docs" / "options.md").read_text()
    row = re.search(r"^\| `--output FILE`, `-o` \| (.*?) \| .*\bbuild\b", page, re.MULTILINE)[1]
    told = set(re.findall(r"\.[a-z0-9_]+(?:\.[a-z0-9_]+)*", row))
    assert {".vdb", ".ply", ".atoms.csv", ".legend.svg"} <= told
    assert told - set(_core.surface_endings()) == {".csv"}


def test_keywords_of_before_are_taken(crambin, tmp_path):
    """Of surfaces, of files and of pictures; both names at once are not."""
    assert _options.FORMER == {"walls": "pieces", "crisp": "sharp_colors", "all_walls": "show_behind", "min_wall": "min_thickness",
                               "outward": "potential_offset"}
    thick = [crambin.surface(voxel=2.0, **{name: 3}) for name in ("min_wall", "min_thickness")]
    assert thick[0].area == thick[1].area != crambin.surface(voxel=2.0).area
    with pytest.raises(TypeError, match="min_thickness: is given twice, also as min_wall"):
        crambin.surface(voxel=2.0, min_thickness=3, min_wall=4)
    with pytest.raises(TypeError, match="pieces: is given twice"):
        thick[0].save(tmp_path / "a.obj", walls="outer", pieces="all")
    for old, new, more in (("walls", "pieces", "outer"), ("all_walls", "show_behind", True)):
        for name in (old, new):
            thick[0].picture(tmp_path / f"{name}.png", 64, opacity=0.5, **{name: more})
        assert (tmp_path / f"{old}.png").read_bytes() == (tmp_path / f"{new}.png").read_bytes()


def test_keywords_are_names_of_python():
    assert all(name.isidentifier() for name in _options.KEYWORDS)
    assert len(_options.KEYWORDS) == len(_options.SETTINGS)
    assert not set(_options.KEYWORDS) & set(_options.MORE)


def hinted(name, of=None):
    """The keywords of a function, or of a method of a class, in the type hints, with their defaults."""
    tree = ast.parse((pathlib.Path(ms.__file__).parent / "__init__.pyi").read_text())
    if of:
        tree = next(node for node in tree.body if isinstance(node, ast.ClassDef) and node.name == of)
    function = next(node for node in tree.body if isinstance(node, ast.FunctionDef) and node.name == name)
    return {a.arg: ast.unparse(d) for a, d in zip(function.args.kwonlyargs, function.args.kw_defaults)}


def test_type_hints_have_the_same_keywords():
    everything = set(_options.KEYWORDS)
    of_surfaces = {name for name, row in _options.KEYWORDS.items() if row["of"] == "surface"}
    assert set(hinted("surface", "Molecule")) == {
        name for name, row in _options.KEYWORDS.items() if row["of"] != "balls"} | set(_options.MORE)
    assert set(hinted("surface")) == of_surfaces | set(_options.MORE)
    assert set(hinted("read")) == everything | {"groups", "threads", "progress"}
    assert hinted("read")["voxel"] == "0.5" and hinted("read")["kind"] == "'variational'"


def test_type_hints_are_those_that_the_script_makes(capsys, monkeypatch):
    monkeypatch.setattr(sys, "argv", ["stubs.py"])
    runpy.run_path(str(ROOT / "python" / "stubs.py"), run_name="__main__")
    assert capsys.readouterr().out == (ROOT / "python" / "vdb_molsurf" / "__init__.pyi").read_text()


def test_type_hints_name_what_there_is():
    tree = ast.parse((pathlib.Path(ms.__file__).parent / "__init__.pyi").read_text())
    for node in tree.body:
        if isinstance(node, (ast.ClassDef, ast.FunctionDef)):
            assert hasattr(ms, node.name), node.name
        if isinstance(node, ast.ClassDef):
            for member in node.body:
                if isinstance(member, ast.FunctionDef):
                    assert hasattr(getattr(ms, node.name), member.name), (node.name, member.name)
    assert {name for name in ms.__all__} <= {node.name for node in tree.body if hasattr(node, "name")}


def test_docstrings_tell_every_keyword():
    for name, row in _options.KEYWORDS.items():
        text = (ms.read if row["of"] != "surface" else ms.surface).__doc__
        assert f"\n    {name}: " in text, name
    assert "From 0.1 to 100." in ms.surface.__doc__ and "[Å], 0.05 to 10. Default" in ms.surface.__doc__


def test_every_keyword_is_taken(crambin):
    from conftest import DATA
    examples = {"kind": "ses", "fields": "density", "max_steps": 3, "steps": 2, "spline_level": 1, "regularizer": "area",
                "flow": "newton", "surface_of": ["A=vdw"], "split": "group", "color": "element", "group_by": "chain",
                "range": (0, 50), "resolution": 8, "coarse": "residue", "select": "A", "model": 1, "assembly": "none",
                "altloc": "all", "radii": "protor", "max_input": "1G", "copies": None, "lambda_": 0.02, "tolerance": 0.02,
                "voxel": 1.0, "probe": 1.2, "blobbiness": 2.0, "epsilon": 0.4, "match": "ses", "remesh": 0.7, "density": 1.5, "adapt": 0.05,
                "palette": "cividis", "value_of": "residue", "potential_offset": 2,
                "pocket_at": "resid 5", "probe_in": 1.2, "probe_out": 5, "pocket_cut": 1, "pocket_neck": 0.4,
                "pore": "resid 2 -> resid 30", "tunnels_from": "resid 30", "tunnel_probe": 1.2, "min_thickness": 1.5,
                "measures": ["sphericity", "gyration_radius"], "patches": "hydrophobicity>0", "smooth_colors": 3}
    for name, row in _options.KEYWORDS.items():
        value = True if row["type"] == "switch" else examples[name]
        if name in ("hetero", "no_hetero", "interfaces", "instances", "by_symmetry", "charges"):
            continue  # with others below
        made = ms.read(DATA / "1crn.pdb", **{"voxel": 0.5 if name == "match" else 1, "group_by": "chain", name: value,
                                                   **({"remesh": 0.7} if name == "adapt" else {})}).surface()
        assert made.area > 0, name
    assert ms.read(DATA / "1crn.pdb", no_hetero=True, group_by="residues:23", interfaces=True, voxel=1).surface().area > 0
    assert ms.read(DATA / "1crn.pdb", hetero=True, voxel=1).surface().area > 0
