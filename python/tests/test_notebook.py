# SPDX-License-Identifier: MPL-2.0
"""docs/tutorial.ipynb runs, and says what stands in it."""

import json
import re

import pytest

from conftest import ROOT

NUMBER = re.compile(r"-?\d+\.?\d*")


def texts(notebook):
    """What the cells print or end with, as texts."""
    found = []
    for cell in notebook["cells"]:
        for output in cell.get("outputs", []):
            text = output.get("text") or output.get("data", {}).get("text/plain", "")
            found.append("".join(text))
    return found


def test_the_notebook_says_what_stands_in_it():
    nbformat, nbclient = pytest.importorskip("nbformat"), pytest.importorskip("nbclient")
    for needs in ("ipykernel", "matplotlib", "pandas"):
        pytest.importorskip(needs)
    path = ROOT / "docs" / "tutorial.ipynb"
    stored = json.loads(path.read_text())
    notebook = nbformat.read(path, 4)
    nbclient.NotebookClient(notebook, timeout=300, resources={"metadata": {"path": str(path.parent)}}).execute()
    before, after = texts(stored), texts(json.loads(nbformat.writes(notebook)))
    assert len(before) == len(after) >= 8
    for old, new in zip(before, after):
        assert NUMBER.sub("#", old) == NUMBER.sub("#", new)
        for a, b in zip(NUMBER.findall(old), NUMBER.findall(new)):
            assert float(a) == pytest.approx(float(b), rel=2e-3, abs=0.02)
