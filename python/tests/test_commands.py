# SPDX-License-Identifier: MPL-2.0
"""The programs that the wheel brings along."""

import shutil
import subprocess
import sysconfig

import pytest

import vdb_molsurf as ms
from conftest import DATA


def command(name):
    """The program of this name in the scripts of this Python; a module that was built by hand has none."""
    found = shutil.which(name, path=sysconfig.get_path("scripts"))
    return found or pytest.skip(f"{name} is not installed with the module")


@pytest.mark.parametrize("name", ["vdb_molsurf", "vdb_molsurf_msms", "vdb_molsurf_nanoshaper"])
def test_tells_the_version_of_the_module(name):
    done = subprocess.run([command(name), "--version"], capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (0, "")
    assert ms.__version__ in done.stdout


def test_mesh_is_that_of_the_module(tmp_path):
    subprocess.run([command("vdb_molsurf"), DATA / "1crn.pdb", "--surface", "ses", "-o", tmp_path / "a.stl", "-q"],
                   check=True)
    ms.read(DATA / "1crn.pdb").surface(kind="ses").save(tmp_path / "b.stl")
    assert (tmp_path / "a.stl").read_bytes() == (tmp_path / "b.stl").read_bytes()


def test_picture_is_drawn(tmp_path):
    subprocess.run([command("vdb_molsurf"), DATA / "1crn.pdb", "-o", tmp_path / "a.png", "--size", "60", "-q"],
                   check=True)
    assert (tmp_path / "a.png").read_bytes().startswith(b"\x89PNG")
