# SPDX-License-Identifier: MPL-2.0
"""The programs that the wheel brings along."""

import pickle
import re
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


def test_files_of_every_ending_are_those_of_the_command(crambin, tmp_path):
    """Byte for byte, but for the run that a report and a .vdb name."""
    apart = {".json", ".vdb", ".mp4", ".webm", ".gif"}
    made = crambin.surface(kind="ses", voxel=1.5, color="chain", atom_areas=True, pockets=True)
    told = [end for end in ms._core.surface_endings()
            if not re.match(r"\.(pore|tunnels|interfaces|patches|density|mask)|\.pockets\.(?!csv)", end)]
    assert len(told) > 25
    (tmp_path / "a").mkdir(), (tmp_path / "b").mkdir()
    words = [word for end in told if end not in {".mp4", ".webm", ".gif"} for word in ("-o", f"a/x{end}")]
    subprocess.run([command("vdb_molsurf"), DATA / "1crn.pdb", "--surface", "ses", "--voxel", "1.5", "--color", "chain", "--pockets", "-q",
                    *words], cwd=tmp_path, check=True)
    for end in told:
        if end not in {".mp4", ".webm", ".gif"}:
            made.save(tmp_path / "b" / f"x{end}")
        if end not in apart:
            assert (tmp_path / "a" / f"x{end}").read_bytes() == (tmp_path / "b" / f"x{end}").read_bytes(), end

    def told_of(path):
        lines = subprocess.run([command("vdb_molsurf"), "info", path], capture_output=True, text=True, check=True).stdout.splitlines()
        return {line for line in lines if not re.match(r"\S|    (command|commit|option\.(groups|lod|superpose)) ", line)}
    assert told_of(tmp_path / "a" / "x.vdb") == told_of(tmp_path / "b" / "x.vdb")


def test_save_takes_the_options_of_files(crambin, tmp_path):
    made = crambin.surface(kind="ses", voxel=1.5, atom_areas=True)
    made.save(tmp_path / "turn.png", turntable=3, width=64, background="#102030")
    assert sorted(path.name for path in tmp_path.iterdir()) == [f"turn.000{n}.png" for n in (1, 2, 3)]
    made.save(tmp_path / "a.contacts.csv", contacts="atom")
    assert len((tmp_path / "a.contacts.csv").read_text().splitlines()) == len(made.table("contacts", "atom")["area"]) + 1
    (tmp_path / "a.contacts.csv").unlink()
    with pytest.raises(ms.OptionError, match="expected a surface with atom_areas=True"):
        crambin.surface(kind="ses", voxel=1.5, atom_areas=False).save(tmp_path / "a.atoms.csv")
    with pytest.raises(ms.OptionError, match="`turntable`: .*a.ply does not show it"):
        made.save(tmp_path / "a.ply", turntable=3)
    with pytest.raises(TypeError, match="unexpected keyword argument 'sise'"):
        made.save(tmp_path / "a.png", sise=3)


def test_maps_for_tomograms_are_those_of_the_command(crambin, tmp_path):
    more = ["--resolution", "6", "--pixel-size", "2.5", "--box-size", "40", "--mask-extend", "1", "--mask-edge", "2", "--invert-density"]
    subprocess.run([command("vdb_molsurf"), DATA / "1crn.pdb", "--voxel", "1", *more, "-q", "-o", tmp_path / "c.density.mrc", "-o",
                    tmp_path / "c.mask.mrc"], check=True)
    made = ms.read(DATA / "1crn.pdb", resolution=6).surface(voxel=1)
    made.to_tomogram(tmp_path / "p.density.mrc", 2.5, box_size=40, invert_density=True)
    made.to_tomogram(tmp_path / "p.mask.mrc", 2.5, box_size=40, mask_extend=1, mask_edge=2)
    for name in ("density", "mask"):
        assert (tmp_path / f"p.{name}.mrc").read_bytes() == (tmp_path / f"c.{name}.mrc").read_bytes()
    with pytest.raises(ms.OptionError, match="ends in .density.mrc or .mask.mrc"):
        made.to_tomogram(tmp_path / "p.mrc", 2.5)
    with pytest.raises(ms.InputError, match="`box_size`: expected at least"):
        made.to_tomogram(tmp_path / "q.mask.mrc", 2.5, box_size=4)
    with pytest.raises(ms.OptionError, match="an even number"):
        made.to_tomogram(tmp_path / "q.mask.mrc", 2.5, box_size=41)
    with pytest.raises(ms.OptionError, match="pixel_size"):
        made.save(tmp_path / "q.mask.mrc")


PICTURE = {"view": (0.2, -1, 0.5), "up": (1, 0, 0), "turn": 30, "background": "#102030", "plain_color": "#ffd700", "style": "outline",
           "opacity": 0.4, "show_behind": True, "clip": 2.5, "depth_cue": True, "legend": "on", "scale_bar": True, "dpi": 300}


def test_zoom_is_that_of_the_command(crambin, tmp_path):
    """To a selection, and to places."""
    made = crambin.surface(voxel=1)
    subprocess.run([command("vdb_molsurf"), DATA / "1crn.pdb", "--voxel", "1", "--size", "80", "-q", "--zoom", "resid 10-14", "-o",
                    tmp_path / "c.png"], check=True)
    chosen = crambin.select("resid 10-14").indices
    for n, zoom in enumerate(("resid 10-14", crambin.positions[chosen])):
        made.picture(tmp_path / f"{n}.png", 80, zoom=zoom)
        assert (tmp_path / f"{n}.png").read_bytes() == (tmp_path / "c.png").read_bytes()
    with pytest.raises(ValueError, match="zoom: expected a selection or places"):
        made.picture(tmp_path / "d.png", 80, zoom=[])
    with pytest.raises(ms.InputError, match="matches no atom"):
        made.picture(tmp_path / "d.png", 80, zoom="chain Z")


def test_pictures_are_those_of_the_command(tmp_path):
    """Each option of pictures draws what the command draws, and differs from the picture without it."""
    for color in ("chain", "none"):
        made = ms.read(DATA / "1crn.pdb", voxel=1, color=color).surface()
        made.picture(tmp_path / "plain.png", 80)
        for name, value in PICTURE.items():
            if (name == "plain_color") == (color == "chain") or (name == "legend" and color == "none"):
                continue
            both = {name: value, **({"opacity": 0.4} if name == "show_behind" else {})}
            made.picture(tmp_path / "a.png", 80, **both)
            words = []
            for key, of in both.items():
                text = ",".join(map(str, of)) if isinstance(of, tuple) else str(of)
                words += ["--" + key.replace("_", "-")] + ([] if of is True else [text])
            subprocess.run([command("vdb_molsurf"), DATA / "1crn.pdb", "--voxel", "1", "--color", color, "--size", "80", "-q",
                            "--force", *words, "-o", tmp_path / "b.png"], check=True)
            assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes(), name
            assert (tmp_path / "a.png").read_bytes() != (tmp_path / "plain.png").read_bytes(), name


def test_panels_and_notes_are_those_of_the_command(tmp_path):
    molecule = ms.read(DATA / "1crn.pdb", voxel=1, color="chain")
    made, ses = molecule.surface(), molecule.surface(kind="ses")
    subprocess.run([command("vdb_molsurf"), DATA / "1crn.pdb", "--voxel", "1", "--color", "chain", "-q", "--panel", "ses",
                    "--label", "9,10,11=x = here", "--ruler", "9,10,11..2,3,4.5", "--show", "A/5-9=sticks", "--size", "600",
                    "--opacity", "0.4",
                    "-o", tmp_path / "b.png"], check=True)
    made.picture(tmp_path / "a.png", 600, opacity=0.4, label=[((9, 10, 11), "x = here")], ruler=[((9, 10, 11), (2, 3, 4.5))], panels=[ses],
                 show={"sticks": ms.read(DATA / "1crn.pdb", select="A/5-9")})
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()
    made.picture(tmp_path / "c.png", 600, panels={"": "variational", "ses": ses})
    assert (tmp_path / "c.png").read_bytes() != (tmp_path / "a.png").read_bytes()


def test_labels_and_rulers_take_selections(tmp_path):
    molecule = ms.read(DATA / "1crn.pdb", select="A/1-40", voxel=1)
    made = molecule.surface()
    subprocess.run([command("vdb_molsurf"), DATA / "1crn.pdb", "--select", "A/1-40", "--voxel", "1", "-q", "--label", "resid 5", "--label",
                    "resid 46=end", "--ruler", "resid 5..9,10,11", "-o", tmp_path / "b.png", "--size", "300"], check=True)
    notes = {"label": ["resid 5", ("resid 46", "end")], "ruler": [("resid 5", (9, 10, 11))]}
    made.picture(tmp_path / "a.png", 300, **notes)
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()
    made.save(tmp_path / "c.png", label="resid 5")
    made.save(tmp_path / "d.png")
    assert (tmp_path / "c.png").read_bytes() != (tmp_path / "d.png").read_bytes()
    molecule.positions[:] += (30, 0, 0)  # labels go with the atoms
    middle = molecule.positions[molecule.select("resid 5").indices].mean(axis=0)
    moved = molecule.surface()
    moved.picture(tmp_path / "a.png", 300, label="resid 5")
    moved.picture(tmp_path / "b.png", 300, label=[(middle, "A PRO 5")])
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()
    with pytest.raises(ms.OptionError, match="expected places"):
        ms.surface([(0, 0, 0)], 1.7).picture(tmp_path / "a.png", label="resid 5")


def both(tmp_path, name, made, words, **keywords):
    """The bytes of a file by the module and by the command."""
    made.save(tmp_path / f"a{name}", **keywords)
    subprocess.run([command("vdb_molsurf"), DATA / "1crn.pdb", "-q", *words, "-o", tmp_path / f"b{name}", "--force"], check=True)
    return [(tmp_path / f"{letter}{name}").read_bytes() for letter in "ab"]


def test_files_are_those_of_the_command(tmp_path):
    """Each option of files has the bytes of the command's file, other than those without it."""
    molecule = ms.read(DATA / "1crn.pdb", voxel=0.7, color="element")
    ses, words = molecule.surface(kind="ses"), ["--surface", "ses", "--voxel", "0.7", "--color", "element"]
    for name, keywords, more in [(".ply", {"sharp_colors": True}, ["--sharp-colors"]), (".obj", {"pieces": "outer"}, ["--pieces", "outer"]),
                                 (".ply", {"pieces": "cavities"}, ["--pieces", "cavities"]), (".off", {"center": True}, ["--center"]),
                                 (".stl", {"print_scale": 0.5}, ["--print-scale", "0.5"])]:
        plain, _ = both(tmp_path, name, ses, words)
        ours, theirs = both(tmp_path, name, ses, [*words, *more], **keywords)
        assert ours == theirs and ours != plain, keywords
    for name in ("walls.png", "plain.png"):
        ses.picture(tmp_path / name, 80, pieces="cavities" if name == "walls.png" else None)
    assert (tmp_path / "walls.png").read_bytes() != (tmp_path / "plain.png").read_bytes()
    thick = molecule.surface(min_thickness=4)
    ours, theirs = both(tmp_path, ".stl", thick, ["--voxel", "0.7", "--print-scale", "0.5", "--min-thickness", "2"], print_scale=0.5)
    assert ours == theirs and thick.volume > molecule.surface().volume + 1
    with pytest.raises(ms.OptionError, match="`sharp_colors`: .*does not show it"):
        ses.save(tmp_path / "c.stl", sharp_colors=True)
    with pytest.raises(ms.OptionError, match="`pieces`: expected all or outer or cavities"):
        ses.save(tmp_path / "c.stl", pieces="inner")
    assert not (tmp_path / "c.stl").exists()


def test_unreal_takes_a_fog(tmp_path):
    plain = ms.read(DATA / "1crn.pdb", voxel=1)
    with pytest.raises(ms.OptionError, match="unreal: expected a fog.*fields"):
        plain.surface().to_vdb(tmp_path / "a.vdb", "unreal")
    plain.surface(fields="density,Cd,atom_id", color="element").to_vdb(tmp_path / "a.vdb", "unreal", ids="float", mips=1)
    text = subprocess.run([command("vdb_molsurf"), "info", tmp_path / "a.vdb"], capture_output=True, text=True, check=True).stdout
    assert set(re.findall("  grid (.*)", text)) == {"density_level_0", "density_level_1", "Cd_level_0", "Cd_level_1", "atom_id"}
    assert text.count("is_saved_as_half_float true") == 5


def test_a_fog_is_that_of_the_command(tmp_path):
    made = ms.read(DATA / "1crn.pdb", voxel=1).surface(kind="ses", fields="density")
    made.to_vdb(tmp_path / "a.vdb", "houdini", center=True, fog_density=0.3)
    subprocess.run([command("vdb_molsurf"), DATA / "1crn.pdb", "--surface", "ses", "--voxel", "1", "--for", "houdini", "--fog-density",
                    "0.3", "--center", "-q", "-o", tmp_path / "b.vdb"], check=True)
    told = [subprocess.run([command("vdb_molsurf"), "info", tmp_path / name], capture_output=True, text=True, check=True).stdout
            for name in ("a.vdb", "b.vdb")]
    grids = [re.findall("  grid (?:surface|density)\n(?:    .*\n)*", text) for text in told]
    kept = [[re.sub("    (?:creator|file_).*\n", "", grid) for grid in some] for some in grids]
    assert len(kept[0]) == 2 and kept[0] == kept[1]
    with pytest.raises(ms.OptionError, match="scene: expected"):
        made.to_vdb(tmp_path / "c.vdb", "maya")


def test_files_of_apbs_are_those_of_the_command(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with open("ion.pqr", "w") as file:
        for n, (x, q) in enumerate([(0, 1), (2.5, -0.4), (4, 0.4)], 1):
            file.write(f"ATOM  {n:5d}  C   ION  {n:4d}    {x:8.3f}   0.000   1.000 {q:.3f} 1.800\n")
    options = ["--pdie", "3", "--sdie", "80", "--ion-conc", "0.15"]
    subprocess.run([command("vdb_molsurf"), "ion.pqr", "--for", "apbs", *options, "-q", "-o", "run/"], check=True)
    ours = tmp_path / "run"
    expected = {path.name: path.read_bytes() for path in ours.iterdir()}
    molecule = ms.read("ion.pqr", charges=True)
    ses = pickle.loads(pickle.dumps(molecule)).surface(kind="ses")
    with pytest.raises(ms.OutputError, match="replace=True"):
        ses.to_apbs("run", replace=False)
    shutil.rmtree(ours)
    ses.to_apbs("run", pdie=3, sdie=80, ion_conc=0.15)
    assert {path.name: path.read_bytes() for path in ours.iterdir()} == expected and len(expected) == 6
    ses.to_apbs("again", apbs_grid="run/apbs.in", pdie=3, sdie=80, ion_conc=0.15)
    assert (tmp_path / "again" / "ion.dielx.dx").read_bytes() == expected["ion.dielx.dx"]
    with pytest.warns(UserWarning, match="another energy"):
        molecule.surface().to_apbs("other")
    with pytest.raises(ms.OptionError, match="charges"):
        ms.read("ion.pqr").surface(kind="ses").to_apbs("none")
    assert not (tmp_path / "none").exists()


def test_pages_have_layers(tmp_path):
    molecule = ms.read(DATA / "1crn.pdb", voxel=1)
    made, ses = molecule.surface(), molecule.surface(kind="ses")
    made.save(tmp_path / "a.html", panels={"": "smooth <one>", "SES": ses})
    page = (tmp_path / "a.html").read_text()
    assert made.view(panels={"": "smooth <one>", "SES": ses}).html == page and "<title>1crn</title>" in page
    layers = re.findall(r'"name":"([^"]*)"', page)
    assert "SES" in layers and any(name.startswith("smooth") for name in layers)
    assert "SES" not in made.view().html


def test_wrong_panels_and_notes(tmp_path):
    made = ms.read(DATA / "1crn.pdb", voxel=1).surface()
    for error, said, given in ((TypeError, "panels: expected surfaces, got str", {"panels": ["ses"]}),
                               (ValueError, r"label: expected a place \(x, y, z\)", {"label": [((1, 2), "here")]}),
                               (ValueError, r"ruler: expected a place \(x, y, z\)", {"ruler": [((1, 2, 3), (1, 2, float("nan")))]}),
                               (TypeError, "panels: expected the name of this surface", {"panels": {"": made}}),
                               (ms.OptionError, "`ruler`: expected two places", {"ruler": [((1, 2, 3), (1, 2, 3))]}),
                               (ms.OptionError, "`label`: expected X,Y,Z=TEXT within 1e6", {"label": [((1e7, 2, 3), "far")]}),
                               (TypeError, "panels: expected a list or a dict of surfaces, got Surface", {"panels": made}),
                               (TypeError, "label: expected a list of pairs of place and text, got int", {"label": 5}),
                               (ms.InputError, "selection .* matches no atom", {"label": "resid 500"}),
                               (TypeError, "ruler: expected a list of pairs of places, got tuple", {"ruler": ((1, 2, 3), (3, 2, 1))}),
                               (TypeError, "show: expected molecules by words of styles, a dict, got str", {"show": "sticks"}),
                               (TypeError, "show: expected molecules by words of styles, a dict, got list", {"show": ["sticks"]}),
                               (TypeError, "show: expected molecules, got Surface", {"show": {"sticks": made}}),
                               (ms.OptionError, "`show`: expected sticks", {"show": {"stick": ms.read(DATA / "1crn.pdb")}}),
                               (ms.OptionError, "`label`: expected SELECTION", {"label": [((1, 2, 3), "")]})):
        with pytest.raises(error, match=said):
            made.picture(tmp_path / "a.png", 80, **given)
    with pytest.raises(ValueError, match="expected one surface, got 2"):
        made.save(tmp_path / "a.ply", panels=[made])
    assert not list(tmp_path.iterdir())


def test_wrong_options_of_pictures(tmp_path):
    made = ms.read(DATA / "1crn.pdb", voxel=1).surface()
    for given, said in (({"view": (0, 0, 0)}, "`view`: expected a direction X,Y,Z that is not 0"),
                        ({"view": "A/10"}, "`view`: expected auto, a direction X,Y,Z, an axis as z or a FILE.view"),
                        ({"opacity": 2}, "`opacity`: expected a number from 0.01 to 1"),
                        ({"style": "oil"}, "`style`: expected"), ({"background": "clear"}, "`background`: expected")):
        with pytest.raises(ms.OptionError, match=said):
            made.picture(tmp_path / "a.png", 80, **given)
        assert not (tmp_path / "a.png").exists()


def test_picture_is_drawn(tmp_path):
    subprocess.run([command("vdb_molsurf"), DATA / "1crn.pdb", "-o", tmp_path / "a.png", "--size", "60", "-q"],
                   check=True)
    assert (tmp_path / "a.png").read_bytes().startswith(b"\x89PNG")
