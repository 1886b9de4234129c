# SPDX-License-Identifier: MPL-2.0
"""The type hints of the module: mypy --strict takes the notebook and the examples of docs/python.md."""

import json
import re
import subprocess
import sys

import pytest

from conftest import ROOT

# Packages whose types are not looked for; Biopython has some, which are not strict.
CONFIG = """[mypy]
strict = True
untyped_calls_exclude = Bio
[mypy-Bio.*,IPython.*,MDAnalysis.*,distributed.*,matplotlib.*,mdtraj.*,pandas.*,pyvista.*,ray.*,trimesh.*]
ignore_missing_imports = True
implicit_reexport = True
"""


def faults(tmp_path, monkeypatch, text):
    """What mypy says of a program."""
    pytest.importorskip("mypy")
    (tmp_path / "program.py").write_text(text)
    (tmp_path / "mypy.ini").write_text(CONFIG)
    monkeypatch.setenv("MYPYPATH", str(ROOT / "python"))
    command = [sys.executable, "-m", "mypy", "--config-file", "mypy.ini", "program.py"]
    return subprocess.run(command, cwd=tmp_path, capture_output=True, text=True).stdout


def test_the_notebook_has_types(tmp_path, monkeypatch):
    cells = json.loads((ROOT / "docs" / "tutorial.ipynb").read_text())["cells"]
    text = "\n".join("".join(cell["source"]) for cell in cells if cell["cell_type"] == "code")
    assert faults(tmp_path, monkeypatch, text).startswith("Success")


def test_the_examples_of_the_page_have_types(tmp_path, monkeypatch):
    page = (ROOT / "docs" / "python.md").read_text()
    text = "\n".join(re.findall(r"```python\n(.*?)```", page, re.DOTALL))
    assert faults(tmp_path, monkeypatch, text).startswith("Success")


def test_wrong_types_are_found(tmp_path, monkeypatch):
    text = 'import vdb_molsurf as ms\nm = ms.read("a.pdb")\nm.surface(voxel="small")\nm.select(5)\nm.volume\n'
    told = faults(tmp_path, monkeypatch, text)
    for line, code in ((3, "arg-type"), (4, "arg-type"), (5, "attr-defined")):
        assert re.search(rf"program.py:{line}: error: .*\[{code}\]", told)
