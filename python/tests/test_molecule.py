# SPDX-License-Identifier: MPL-2.0
"""Atoms out of files, their tables, groups and colours."""

import gzip
import io
import pickle

import numpy as np
import pytest

import vdb_molsurf as ms
from conftest import DATA


def test_atoms_are_arrays(crambin):
    assert len(crambin) == 327 and repr(crambin) == "<Molecule 1crn.pdb: 327 atoms, 1 chains>"
    assert crambin.positions.shape == (327, 3) and crambin.positions.dtype == np.float64
    assert crambin.positions[0].tolist() == [17.047, 14.099, 3.625]
    assert crambin.name[:4].tolist() == ["N", "CA", "C", "O"] and crambin.residue[0] == "THR"
    assert crambin.residue_number[-1] == 46 and crambin.residue_index[-1] == 45 and crambin.element[0] == 7
    assert set(crambin.chain) == {"A"} and set(crambin.altloc) == {""} and set(crambin.insertion_code) == {""}
    assert np.array_equal(crambin.atom_id, np.arange(327)) and crambin.copies == 1
    assert crambin.radii[1] == 1.7


def test_every_source_gives_the_same_atoms(crambin, tmp_path):
    text = (DATA / "1crn.pdb").read_text()
    packed = gzip.compress(text.encode())
    (tmp_path / "a.gz").write_bytes(packed)
    for source in (str(DATA / "1crn.pdb"), text, text.encode(), packed, bytearray(packed), memoryview(packed),
                   tmp_path / "a.gz", io.StringIO(text), io.BytesIO(packed), open(DATA / "1crn.pdb")):
        assert np.array_equal(ms.read(source).positions, crambin.positions)


def test_selections_radii_and_assemblies():
    assert len(ms.read(DATA / "1crn.pdb", select="A/1-10")) < 100
    assert ms.read(DATA / "1crn.pdb", radii="protor").radii[1] == 1.88
    two = ms.read(DATA / "1a8o.cif.gz", assembly="1", group_by="copy")
    assert two.copies == 2 and len(two.groups) == 2 and len(set(two.chain)) == 2
    assert len(ms.read(DATA / "1ubq.pdb", waters=True)) > len(ms.read(DATA / "1ubq.pdb"))


def test_written_positions_are_those_of_the_surface():
    m = ms.read(DATA / "1crn.pdb")
    before = m.surface(kind="sas", grid=False).area
    m.positions[:] *= 10
    assert m.surface(kind="sas", grid=False).area == pytest.approx(
        (4 * np.pi * (m.radii + 1.4)**2).sum(), rel=1e-6) and before < 4000


def test_keywords_of_read_are_defaults(crambin):
    m = ms.read(DATA / "1crn.pdb", kind="sas", voxel=1, color="bfactor")
    s = m.surface()
    assert s.kind == "sas" and s.report["voxel"] == 1 and len(s.colors) == len(s.vertices)
    assert m.surface(kind="vdw", color="none").kind == "vdw"
    with pytest.raises(ValueError, match="expected groups"):
        crambin.surface(split="group")


def test_defaults_that_depend_are_those_of_the_command_line(crambin):
    """Interfaces are between chains, a grid of colours is by chain, and keywords without effect are warned of."""
    molecule = ms.read(DATA / "4at1.ent.gz", kind="sas")
    pairs = [molecule.surface(grid=False, interfaces=True, **more).report["interfaces"] for more in ({}, {"group_by": "chain"})]
    assert pairs[0] == pairs[1] and len(pairs[0]) == 3
    assert crambin.surface(kind="sas", grid=False, interfaces=True).report["interfaces"] == []  # one chain
    s = crambin.surface(voxel=1, fields="Cd")
    assert len(s.colors) == len(s.vertices)
    warned = crambin.surface(kind="ses", voxel=1, epsilon=0.3, blobbiness=2).report["warnings"]
    assert warned == ["`blobbiness` is for `kind` gaussian", "`epsilon` is for `kind` variational or smooth-sas"]
    balls = ms.surface(crambin.positions, crambin.radii, kind="ses", voxel=1, epsilon=0.3)
    assert balls.report["warnings"] == ["`epsilon` is for `kind` variational or smooth-sas"]
    assert crambin.surface(voxel=1, epsilon=0.3).report["warnings"] == ["`epsilon` 0.3: a tolerance below half a voxel is not resolved"]


def test_a_molecule_answers_questions_about_its_atoms(crambin):
    s = crambin.surface(kind="ses", voxel=1, pore="auto", pockets=True, color="bfactor")
    assert len(s.colors) == len(s.vertices) and "pockets" in s.report and s.report["pore"] is not None
    read_with = ms.read(DATA / "1crn.pdb", color="bfactor").surface(kind="ses", voxel=1)
    assert (read_with.colors == s.colors).all()
    assert len(crambin.surface(voxel=1, color="entity").colors) and crambin.surface(voxel=1, pocket_at="resid 5").area > 0
    grouped = ms.read(DATA / "1a8o.cif.gz", assembly="1").surface(kind="sas", grid=False, interfaces=True, group_by="copy")
    assert len(grouped.report["interfaces"]) == 1
    with pytest.raises(TypeError, match="is for read"):
        crambin.surface(waters=True)
    with pytest.raises(ms.OptionError, match="nowhere"):
        crambin.surface(pore="nowhere")
    with pytest.warns(DeprecationWarning, match="pore, range"):
        ms.read(DATA / "1crn.pdb", pore="auto", range=(0, 1))


def test_questions_are_about_the_atoms_as_they_are(crambin):
    m = ms.read(DATA / "1crn.pdb")
    m.positions[:] += 30
    m.radii[:] = 2.0
    moved, here = m.surface(kind="sas", voxel=1, color="bfactor"), m.surface(kind="sas", voxel=1)
    assert moved.area == pytest.approx(here.area, rel=1e-12) and moved.vertices.min() > 15
    with pytest.raises(ms.OptionError, match="pickle"):
        pickle.loads(pickle.dumps(m)).surface(pore="auto")


def test_select_finds_atoms(crambin):
    found = crambin.select("resid 5-9")
    inside = (crambin.residue_number >= 5) & (crambin.residue_number <= 9)
    assert found.count == len(found) == inside.sum() and (found.mask == inside).all()
    assert (crambin.positions[found.indices] == found.positions).all() and "of 327 atoms" in repr(found)
    water = ms.read(DATA / "1ubq.pdb").select("water")
    assert water.count == 0
    with pytest.raises(ms.InputError):
        crambin.select("resname XYZ")
    with pytest.raises(ms.OptionError):
        crambin.select("resid 5 frobnicate")


def test_tables_are_dicts_of_arrays(crambin):
    s = crambin.surface(kind="sas", grid=False)
    atoms, residues = s.table("atoms"), s.table("residues")
    assert len(atoms["area"]) == 327 and atoms["atom"][1] == "CA" and atoms["element"][0] == "N"
    assert residues["area"].sum() == pytest.approx(s.area) and len(residues["residue"]) == 46
    index = crambin.residue_index
    assert np.allclose(residues["area"], np.bincount(index, weights=s.atom_areas))
    assert residues["relative_accessibility"][0] == pytest.approx(residues["area"][0] / 172)
    contacts = s.table("contacts", "residue")
    assert contacts["area"].min() > 0 and len(s.table("contacts", "atom")["area"]) > len(contacts["area"])
    assert {len(column) for column in contacts.values()} == {len(contacts["area"])}


def test_interfaces_add_up():
    m = ms.read(DATA / "1a8o.cif.gz", assembly="1", group_by="copy")
    s = m.surface(kind="sas", interfaces=True, grid=False)
    pair, = s.report["interfaces"]
    rows = s.table("interfaces")
    assert rows["area"].sum() == pytest.approx(pair["buried_area"], rel=1e-6) and pair["buried_area"] > 500
    named = ms.read(DATA / "1crn.pdb", groups={"first": "A/1-20", "rest": "A/21-46"})
    assert named.groups == ["first", "rest"]
    assert [group["name"] for group in named.surface(voxel=1).report["groups"]] == ["first", "rest"]


def test_parts_have_surfaces_of_their_own():
    m = ms.read(DATA / "1a8o.cif.gz", assembly="1", group_by="copy")
    s = m.surface(voxel=1, split="group")
    assert len(s.report["parts"]) == 2
    with pytest.raises(ValueError):
        s.voxels()


def test_radii_of_names(crambin):
    found = ms.radii(crambin.name, crambin.residue)
    assert np.array_equal(found, crambin.radii)
    assert np.isnan(ms.radii(["??"], elements=["Xx"])).all()
    assert ms.radii(["H"], ["ALA"], ["H"], set="protor").tolist() == [0.0]
    for wrong in (lambda: ms.radii([1, 2]), lambda: ms.radii(["C"], ["ALA", "ALA"]), lambda: ms.radii(["C"], set="no")):
        with pytest.raises((TypeError, ValueError)):
            wrong()


def test_a_whole_by_symmetry_has_the_atoms_of_its_unit(tmp_path):
    whole = ms.read(DATA / "1a8o.cif.gz", assembly="1")
    unit = ms.read(DATA / "1a8o.cif.gz", assembly="1", by_symmetry=True)
    assert (len(whole), len(unit), unit.copies) == (1112, 556, 2)
    assert len(unit.name) == 556 and np.allclose(unit.positions, whole.positions[:556])
    assert whole.positions.flags.writeable and not unit.positions.flags.writeable and not unit.radii.flags.writeable
    made = unit.surface(kind="sas", voxel=1)
    assert made.closed and made.area == pytest.approx(whole.surface(kind="sas", voxel=1).area, rel=1e-6)
    assert len(made.atom) == len(made.vertices) and made.atom.max() < 556
    images = np.stack([whole.positions[made.atom], whole.positions[made.atom + 556]])
    apart = np.linalg.norm(images - made.vertices, axis=2).min(axis=0) - unit.radii[made.atom] - 1.4
    assert np.abs(apart).max() < 0.6  # creases of a voxel of 1 Å
    made.save(tmp_path / "a.glb")
    made.picture(tmp_path / "a.png", 100)
    areas = unit.surface(kind="sas", voxel=1, atom_areas=True).atom_areas
    assert len(areas) == 556 and 2 * areas.sum() == pytest.approx(made.area, rel=1e-9)
    for use in (lambda: made.distance([[0, 0, 0]]), lambda: made.contacts, made.voxels, lambda: made.save(tmp_path / "a.vdb"),
                lambda: unit.surface(atom_areas=True)):
        with pytest.raises(ms.OptionError):
            use()
    assert not (tmp_path / "a.vdb").exists()
    again = pickle.loads(pickle.dumps(made))
    assert np.array_equal(again.atom, made.atom) and len(pickle.loads(pickle.dumps(unit))) == 556


def test_instances_repeat_the_surface_of_a_copy():
    one = ms.read(DATA / "1a8o.cif.gz").surface(voxel=1)
    many = ms.read(DATA / "1a8o.cif.gz", assembly="1", instances=True)
    made = many.surface(voxel=1)
    assert (len(many), many.copies) == (556, 2)
    assert made.area == pytest.approx(one.area) and len(made.faces) == 2 * len(one.faces)
    assert not many.positions.flags.writeable and made.atom.max() < 556


def test_superpose(tmp_path):
    """As the command does, by its rmsd; what comes back lies where it was."""
    a, b = (ms.read(DATA / "1d3z.pdb.gz", model=model) for model in (1, 2))
    turn = np.array([[0.36, 0.48, -0.8], [-0.8, 0.6, 0.0], [0.48, 0.64, 0.6]])
    start = a.positions.copy()
    a.positions[:] = start @ turn.T + [40, -25, 60]
    assert a.superpose(ms.read(DATA / "1d3z.pdb.gz", model=1)) < 1e-6
    assert np.allclose(a.positions, start, atol=1e-6)
    rmsd = b.superpose(a)
    own, other = b.positions[b.name == "CA"], a.positions[a.name == "CA"]
    assert rmsd == pytest.approx(np.sqrt(((own - other) ** 2).sum(axis=1).mean()), abs=1e-9) and 0.1 < rmsd < 2
    assert b.superpose(a) == pytest.approx(rmsd, abs=1e-9)
    mirrored = ms.read(DATA / "1crn.pdb")
    mirrored.positions[:, 0] *= -1
    assert mirrored.superpose(ms.read(DATA / "1crn.pdb")) > 3
    with pytest.raises(ValueError, match="at least three common atoms"):
        a.superpose(ms.read(DATA / "1crn.pdb", select="resid 1-2"))
    with pytest.raises(TypeError, match="onto: expected a Molecule"):
        a.superpose("1crn.pdb")
