# SPDX-License-Identifier: MPL-2.0
"""Every wrong argument is an error of the right type, in one short line without the data; every array of numbers is taken."""

import numpy as np
import pytest

import vdb_molsurf as ms
from conftest import DATA

NAN, INF = float("nan"), float("inf")
X = np.array([[0.0, 0.0, 0.0], [1.5, 0.0, 0.0], [0.0, 1.5, 0.0]])
R = np.array([1.7, 1.5, 1.6])


def changed(array, at, value):
    out = array.copy()
    out[at] = value
    return out


WRONG = [
    (changed(X, (1, 2), NAN), R, ValueError, "positions: expected finite numbers, got [1.5, 0.0, nan] at index 1"),
    (changed(X, (2, 0), -INF), R, ValueError, "positions: expected finite numbers, got [-inf, 1.5, 0.0] at index 2"),
    (changed(X, (2, 0), 2e6), R, ValueError, "ball 2: expected coordinates within 1e6 Å"),
    (X, changed(R, 1, NAN), ValueError, "radii: expected finite numbers above 0, got nan at index 1"),
    (X, changed(R, 2, INF), ValueError, "radii: expected finite numbers above 0, got inf at index 2"),
    (X, changed(R, 0, 0), ValueError, "radii: expected finite numbers above 0, got 0.0 at index 0"),
    (X, -R, ValueError, "radii: expected finite numbers above 0, got -1.7 at index 0"),
    (X, 0, ValueError, "radii: expected finite numbers above 0, got 0.0 at index 0"),
    (X, changed(R, 2, 1e7), ValueError, "ball 2: expected a radius above 0 and up to 1e6 Å, got 1e+07"),
    (X[:, :2], R, ValueError, "positions: expected shape (n, 3), got (3, 2)"),
    (X.ravel(), R, ValueError, "positions: expected shape (n, 3), got (9,)"),
    (X[None], R, ValueError, "positions: expected shape (n, 3), got (1, 3, 3)"),
    (1.0, R, ValueError, "positions: expected shape (n, 3), got ()"),
    (X, R[:2], ValueError, "radii: expected a number or shape (3,), got (2,)"),
    (X, R[:, None], ValueError, "radii: expected a number or shape (3,), got (3, 1)"),
    (X.astype(complex), R, TypeError, "positions: expected numbers, got an array of complex numbers"),
    (X, R.astype(complex), TypeError, "radii: expected numbers, got an array of complex numbers"),
    (X.astype(object), R, TypeError, "positions: expected numbers, got an array of object"),
    (X.astype(bool), R, TypeError, "positions: expected numbers, got an array of bool"),
    (X.astype(str), R, TypeError, "positions: expected numbers, got an array of str"),
    ("positions", R, TypeError, "positions: expected numbers, got str"),
    ([["a", "b", "c"]], 1.5, TypeError, "positions: expected numbers, got a list of str"),
    ([[0, 0, 0], [1, 1]], 1.5, TypeError, "positions: expected numbers, got a ragged list"),
    (None, R, TypeError, "positions: expected numbers, got a NoneType of object"),
    (X, None, TypeError, "radii: expected numbers, got a NoneType of object"),
    ({"x": 1}, R, TypeError, "positions: expected numbers, got a dict of object"),
    ([], [], ValueError, "positions: expected at least one atom, got none"),
    (np.zeros((0, 3)), 1.5, ValueError, "positions: expected at least one atom, got none"),
]


def message(call, kind):
    with pytest.raises(kind) as caught:
        call()
    text = str(caught.value)
    assert len(text) < 200 and "\n" not in text, text
    return text


@pytest.mark.parametrize("positions, radii, kind, said", WRONG)
@pytest.mark.parametrize("function", [ms.surface, ms.areas, ms.contacts])
def test_wrong_balls(function, positions, radii, kind, said):
    assert message(lambda: function(positions, radii), kind).startswith(said)


def masked(array):
    out = np.ma.array(array)
    out[1] = np.ma.masked
    return out


def test_masked_entries_are_no_data(ses, tmp_path):
    """Also in lists of arrays; an array that masks none of its entries is one like any other."""
    said = "expected no masked entries, got some"
    for function in (ms.surface, ms.areas, ms.contacts):
        for positions in (masked(X), list(masked(X)), tuple(map(np.ma.array, masked(X)))):
            assert message(lambda: function(positions, R), ValueError) == f"positions: {said}"
        assert message(lambda: function(X, masked(R)), ValueError) == f"radii: {said}"
    assert message(lambda: ses.distance(masked(X)), ValueError) == f"points: {said}"
    for mesh in ((masked(X), [[0, 1, 2]]), (X, masked([[0, 1, 2], [0, 2, 1]]))):
        assert message(lambda: ms.compare(ses, mesh), ValueError) == f"b: {said}"
    assert message(lambda: ms.radii(masked(["CA", "N"])), ValueError) == f"names: {said}"
    for given in ({"view": masked(R)}, {"label": [(masked(R), "here")]}):
        assert message(lambda: ses.picture(tmp_path / "a.png", **given), ValueError) == f"{[*given][0]}: {said}"
    inputs = [("a", masked(X), R), ("b", X, masked(R)), ("c", np.ma.array(X), R), ("d", X, R)]
    rows = list(ms.measure((0, inputs), kind="sas", grid=False))
    assert [row["error"] for row in rows] == [f"ValueError: positions: {said}", f"ValueError: radii: {said}", None, None]
    assert len({row["sha256"] for row in rows}) == 3 and rows[2]["area"] == rows[3]["area"]
    assert np.array_equal(ms.areas(np.ma.array(X, mask=False), R), ms.areas(X, R))


def test_a_million_atoms_in_a_list_are_not_printed():
    many = [["x"] * 3] * 1_000_000
    assert len(message(lambda: ms.surface(many, 1.0), TypeError)) < 100


SAME = [X.astype(np.float32), X.tolist(), tuple(map(tuple, X)), np.asfortranarray(X), X[::-1][::-1],
        np.repeat(X, 2, axis=0)[::2], X.astype(">f8"), np.array(X.T).T]


@pytest.mark.parametrize("positions", SAME)
def test_every_kind_of_array_is_taken(positions):
    assert np.array_equal(ms.areas(positions, R), ms.areas(X, R))
    assert np.array_equal(ms.surface(positions, R, voxel=1).vertices, ms.surface(X, R, voxel=1).vertices)


def test_whole_numbers_read_only_arrays_and_one_radius_are_taken():
    whole = np.array([[0, 0, 0], [2, 0, 0]], dtype=np.int16)
    fixed = np.array(whole, dtype=float)
    fixed.flags.writeable = False
    assert np.array_equal(ms.areas(whole, 2), ms.areas(fixed, np.array([2.0, 2.0])))
    assert np.array_equal(ms.areas(whole, np.uint8([2, 2])), ms.areas(fixed, [2, 2]))


KEYWORDS = [
    ({"voxl": 1}, TypeError, "unknown keyword 'voxl' [hint: did you mean voxel?]"),
    ({"fill_cavity": True}, TypeError, "unknown keyword 'fill_cavity' [hint: did you mean fill_cavities?]"),
    ({"thread": 1}, TypeError, "unknown keyword 'thread' [hint: did you mean threads?]"),
    ({"zzzzzz": 1}, TypeError, "unknown keyword 'zzzzzz'"),
    ({"voxel": 20}, ms.OptionError, "`voxel`: expected 0.05 to 10 Å, got 20"),
    ({"voxel": NAN}, ms.OptionError, "`voxel`: expected a number, got 'nan'"),
    ({"voxel": "fine"}, TypeError, "voxel: expected float, got str"),
    ({"voxel": True}, TypeError, "voxel: expected float, got bool"),
    ({"voxel": [1, 2]}, TypeError, "voxel: expected float, got list"),
    ({"voxel": 1j}, TypeError, "voxel: expected float, got complex"),
    ({"kind": "see"}, ms.OptionError, "`kind`: expected variational or ses or sas or vdw or gaussian or smooth-sas, got 'see' "
                                      "[hint: did you mean ses?]"),
    ({"kind": 3}, TypeError, "kind: expected str, got int"),
    ({"fill_cavities": 1}, TypeError, "fill_cavities: expected bool, got int"),
    ({"atom_areas": "no"}, TypeError, "atom_areas: expected bool, got str"),
    ({"max_steps": 1.5}, ms.OptionError, "`max_steps`: expected a whole number from 0 to 1000000, got '1.5'"),
    ({"lambda_": -1}, ms.OptionError, "`lambda_`: expected 0 to 1e6, got -1"),
    ({"fields": ["sas", "densty"]}, ms.OptionError, "`fields`: unknown field 'densty' [hint: did you mean density?]"),
    ({"fields": 3j}, TypeError, "fields: expected str | Sequence[object], got complex"),
    ({"select": "A"}, TypeError, "select: is for read(), which chooses the atoms"),
    ({"color": "chain"}, ValueError, "color: 'chain' needs atoms of a file"),
    ({"threads": -1}, ValueError, "threads: expected a whole number from 0 to 4096"),
    ({"threads": 1.5}, ValueError, "threads: expected a whole number from 0 to 4096"),
    ({"progress": 3}, TypeError, "progress: expected a callable, True or None, got int"),
    ({"areas_of": 3}, TypeError, "areas_of: expected str, got int"),
    ({"areas_of": "see"}, ValueError, "areas_of: expected variational or ses or sas or vdw or gaussian"),
    ({"grid": False, "kind": "gaussian"}, ms.OptionError, "`grid`: there is no closed form"),
    ({"interfaces": True}, ms.InputError, "there are no groups"),
]


@pytest.mark.parametrize("options, kind, said", KEYWORDS)
def test_wrong_keywords(options, kind, said):
    text = message(lambda: ms.surface(X, R, **options), kind)
    assert text.startswith(said), text


def test_wrong_probes_and_points(ses):
    assert message(lambda: ms.areas(X, R, -1), ValueError) == "probe: expected 0 to 100 Å, got -1"
    assert message(lambda: ms.areas(X, R, NAN), ValueError) == "probe: expected 0 to 100 Å, got nan"
    assert message(lambda: ms.areas(X, R, "1.4"), TypeError) == "probe: expected float, got str"
    assert message(lambda: ses.distance([1, 2]), ValueError) == "points: expected shape (n, 3), got (2,)"
    assert message(lambda: ses.distance([[1, 2, NAN]]), ValueError).startswith("point 0: expected coordinates")
    assert message(lambda: ses.sample(-1), ValueError) == "n: expected a whole number from 0 up"
    assert message(lambda: ses.sample(2.5), ValueError) == "n: expected a whole number from 0 up"
    assert message(lambda: ses.table("atom"), ValueError).startswith("table: expected atoms, residues")
    assert message(lambda: ses.table("contacts", "ball"), ValueError).startswith("level: expected atom")
    assert len(ses.distance(np.zeros((0, 3))).distance) == 0 and len(ses.sample(0).points) == 0


def test_wrong_sources(tmp_path):
    empty = tmp_path / "empty.pdb"
    empty.write_text("")
    for source, kind, said in [
            (tmp_path / "none.pdb", FileNotFoundError, "[Errno 2] No such file"),
            ("-", FileNotFoundError, "[Errno 2] No such file"),
            (tmp_path, IsADirectoryError, "[Errno 21] Is a directory"),
            (empty, ms.InputError, f"{empty}: is empty"),
            (b"", ms.InputError, "text: is empty"),
            ("not a\nstructure", ms.InputError, "text: is no structure"),
            (3, TypeError, "source: expected a path, text, bytes or a file, got int"),
            (None, TypeError, "source: expected a path, text, bytes or a file, got NoneType")]:
        assert message(lambda: ms.read(source), kind).startswith(said)
    crambin = DATA / "1crn.pdb"
    assert message(lambda: ms.read(crambin, select="Q"), ms.InputError)
    assert message(lambda: ms.read(crambin, selct="A"), TypeError).endswith("did you mean select?]")
    assert message(lambda: ms.read(crambin, radii="nobody"), ms.InputError).startswith("radii: expected bondi")
    assert message(lambda: ms.read(crambin, copies="1"), ms.OptionError).startswith("`copies` is for an assembly")
    assert message(lambda: ms.read(crambin, groups=["A"]), TypeError).startswith("groups: expected a dict")
    assert message(lambda: ms.read(crambin, max_input="1K"), ms.InputError).find("`max_input`") > 0


def test_wrong_files(ses, tmp_path):
    assert message(lambda: ses.save(tmp_path / "a.xyz"), ms.OptionError)
    assert message(lambda: ses.save(tmp_path / "none" / "a.ply"), OSError)
    assert message(lambda: ses.picture(tmp_path / "a.jpg"), ValueError).startswith("picture: expected")
    assert message(lambda: ses.picture(tmp_path / "a.png", 3), ms.OptionError).startswith("width: expected")
    ses.save(tmp_path / "a.ply")
    assert issubclass(ms.OutputError, OSError)
    with pytest.raises(ms.OutputError) as existing:
        ses.save(tmp_path / "a.ply", replace=False)
    assert not existing.value.may_pass


def test_wrong_meshes(ses):
    good = np.float32([[0, 0, 0], [1, 0, 0], [0, 1, 0]])
    for mesh, kind, said in [
            ((good, [[0, 1, 3]]), ms.InputError, "face 0: expected vertices below 3, got 3"),
            ((good, [[0, 1, -1]]), ValueError, "b: expected faces from 0 to 2^31"),
            ((good, [[0.0, 1.0, 2.0]]), ValueError, "b: expected faces of whole numbers"),
            ((good * NAN, [[0, 1, 2]]), ms.InputError, "vertex 0: expected a finite position"),
            ((good, np.zeros((0, 3), int)), ms.InputError, "compare: expected triangles"),
            (3, TypeError, "b: expected a surface, a path or (vertices, faces), got int")]:
        assert message(lambda: ms.compare(ses, mesh), kind).startswith(said)


def test_what_was_written_into_views_is_checked(crambin, tmp_path):
    for array, value, said in [("faces", 10**8, "face 0: expected vertices below"), ("faces", -1, "face 0: expected"),
                               ("vertices", NAN, "vertex 0: expected a finite position below 1e6 Å, got nan"),
                               ("vertices", 1e30, "vertex 0: expected a finite position"),
                               ("normals", NAN, "normal 0: expected a finite vector")]:
        s = crambin.surface(kind="ses", voxel=1)
        getattr(s, array)[0, 1] = value
        for call in (lambda: s.save(tmp_path / "a.ply"), lambda: s.picture(tmp_path / "a.png", 100),
                     lambda: s.save(tmp_path / "a.html"), lambda: s.distance([[0, 0, 0]])):
            assert message(call, ms.InputError).startswith(said)
        assert message(lambda: s.sample(3), ValueError).startswith(f"{array}: expected")
    s = crambin.surface(kind="ses", voxel=1)
    s.faces[0, 0] = -2**31
    assert message(lambda: s.sample(3), ValueError).startswith("faces: expected")
    s = crambin.surface(kind="ses", voxel=1)
    s.vertices[:] = 0
    assert message(lambda: s.sample(3), ValueError) == "sample: expected triangles with an area, got none"
    s.vertices[0] = 1e30
    assert message(lambda: ms.compare(s, crambin.surface(kind="ses", voxel=1)), ms.InputError).startswith("vertex 0")
    m = ms.read(DATA / "1crn.pdb")
    m.radii[3] = 0
    assert message(lambda: m.surface(), ms.InputError).startswith("ball 3: expected a radius above 0")


def test_forces_need_the_faces_that_they_were_made_with():
    def flat(s):
        s.faces[:] = 0

    def copied(s):
        s.faces[:, 1] = s.faces[:, 0]

    def mixed(s):
        s.faces[:] = np.random.default_rng(1).integers(0, len(s.vertices), s.faces.shape)

    def turned(s):
        s.faces[0] = s.faces[0, ::-1].copy()
    for kind in ("variational", "smooth-sas"):
        for change, said in ((flat, "face 0: expected three vertices"), (copied, "face 0: expected three vertices"),
                             (mixed, "face"), (turned, "faces: expected a closed, oriented manifold, got neighbours")):
            s = ms.surface(X, R, kind=kind, voxel=1)
            change(s)
            assert message(lambda: s.forces(1, 1), ms.InputError).startswith(said)
    s = ms.surface(X, R, voxel=1)
    assert np.isfinite(s.forces(1, 1)).all()


def test_what_people_write_first(tmp_path, crambin):
    """Messages say what to write instead."""
    with pytest.raises(TypeError, match=r"'surface' \[hint: did you mean kind\?\]"):
        crambin.surface(surface="ses")
    with pytest.raises(TypeError, match=r"'lambda' \[hint: did you mean lambda_\?\]"):
        ms.surface([[0.0, 0, 0]], 2.0, **{"lambda": 0.1})
    exact = crambin.surface(kind="sas", grid=False)
    for name in ("vertices", "faces", "normals"):
        with pytest.raises(AttributeError, match=r"no mesh \[hint: grid=True\]"):
            getattr(exact, name)
    assert "0 vertices" in repr(exact)
    made = crambin.surface(voxel=1)
    made.save(tmp_path / "a.ply")
    made.save(tmp_path / "a.ply")
    with pytest.raises(ms.OutputError, match="replace=True replaces it"):
        made.save(tmp_path / "a.ply", replace=False)
    with pytest.raises(ms.OutputError, match="replace=True replaces it"):
        made.to_vdb(tmp_path / "a.vdb") or made.to_vdb(tmp_path / "a.vdb", replace=False)


def test_adapters_are_given_a_path():
    mdtraj, mdanalysis = pytest.importorskip("mdtraj"), pytest.importorskip("MDAnalysis")
    from vdb_molsurf import biopython, mdanalysis as for_mdanalysis, mdtraj as for_mdtraj
    with pytest.raises(TypeError, match=r"got str \[hint: mdtraj.load"):
        for_mdtraj.shrake_rupley("a.pdb")
    with pytest.raises(TypeError, match=r"got str \[hint: MDAnalysis.Universe"):
        for_mdanalysis.SurfaceAnalysis("a.pdb")
    with pytest.raises(TypeError, match=r"got str \[hint: Bio.PDB"):
        biopython.compute("a.pdb")
