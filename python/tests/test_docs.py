# SPDX-License-Identifier: MPL-2.0
"""The examples of docs/python.md run, one after the other, as they stand there."""

import importlib.util
import re
import runpy

import pytest

from conftest import ROOT

PAGE = (ROOT / "docs" / "python.md").read_text()


def test_the_page_of_names_is_that_which_the_script_makes(capsys):
    for needs in ("MDAnalysis", "mdtraj", "Bio"):
        pytest.importorskip(needs)
    runpy.run_path(str(ROOT / "python" / "api_page.py"), run_name="__main__")
    assert (ROOT / "docs" / "python_api.md").read_text() == capsys.readouterr().out


def test_the_examples_run(tmp_path, monkeypatch, capsys):
    (tmp_path / "tests").symlink_to(ROOT / "tests")
    monkeypatch.chdir(tmp_path)
    blocks = re.findall(r"(?:<!-- needs (\w+) -->\n)?```python\n(.*?)```", PAGE, re.DOTALL)
    assert len(blocks) >= 9
    names, left_out = {"__name__": "__main__"}, []
    for needs, block in blocks:
        if needs and importlib.util.find_spec(needs) is None:
            left_out.append(needs)
            continue
        exec(compile(block, "docs/python.md", "exec"), names)
        for printed in re.findall(r"print\(.*\) +# (<[^.>]*)", block):
            assert printed.rstrip("> ") in capsys.readouterr().out
    assert (tmp_path / "dimer.glb").exists() and (tmp_path / "dimer.png").exists()
    if left_out:
        pytest.skip(f"without {', '.join(left_out)}; the others run")
