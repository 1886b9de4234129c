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


PICTURE = {"view": (0.2, -1, 0.5), "up": (1, 0, 0), "turn": 30, "background": "#102030", "plain_color": "#ffd700", "style": "outline",
           "opacity": 0.4, "all_walls": True, "clip": 2.5, "depth_cue": True, "legend": "on", "scale_bar": True, "dpi": 300}


def test_pictures_are_those_of_the_command(tmp_path):
    """Each option of pictures draws what the command draws, and differs from the picture without it."""
    for color in ("chain", "none"):
        made = ms.read(DATA / "1crn.pdb", voxel=1, color=color).surface()
        made.picture(tmp_path / "plain.png", 80)
        for name, value in PICTURE.items():
            if (name == "plain_color") == (color == "chain") or (name == "legend" and color == "none"):
                continue
            both = {name: value, **({"opacity": 0.4} if name == "all_walls" else {})}
            made.picture(tmp_path / "a.png", 80, **both)
            words = []
            for key, of in both.items():
                text = ",".join(map(str, of)) if isinstance(of, tuple) else str(of)
                words += ["--" + key.replace("_", "-")] + ([] if of is True else [text])
            subprocess.run([command("vdb_molsurf"), DATA / "1crn.pdb", "--voxel", "1", "--color", color, "--size", "80", "-q",
                            "--force", *words, "-o", tmp_path / "b.png"], check=True)
            assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes(), name
            assert (tmp_path / "a.png").read_bytes() != (tmp_path / "plain.png").read_bytes(), name


def test_wrong_options_of_pictures(tmp_path):
    made = ms.read(DATA / "1crn.pdb", voxel=1).surface()
    for given, said in (({"view": (0, 0, 0)}, "`view`: expected a direction X,Y,Z that is not 0"),
                        ({"view": "A/10"}, "`view`: expected auto, a direction X,Y,Z or a FILE.view"),
                        ({"opacity": 2}, "`opacity`: expected a number from 0.01 to 1"),
                        ({"style": "oil"}, "`style`: expected"), ({"background": "clear"}, "`background`: expected")):
        with pytest.raises(ms.OptionError, match=said):
            made.picture(tmp_path / "a.png", 80, **given)
        assert not (tmp_path / "a.png").exists()


def test_picture_is_drawn(tmp_path):
    subprocess.run([command("vdb_molsurf"), DATA / "1crn.pdb", "-o", tmp_path / "a.png", "--size", "60", "-q"],
                   check=True)
    assert (tmp_path / "a.png").read_bytes().startswith(b"\x89PNG")
