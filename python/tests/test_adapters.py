# SPDX-License-Identifier: MPL-2.0
"""The adapters, with the packages that they are for."""

import subprocess
import sys

import numpy as np
import pytest

import vdb_molsurf as ms
from conftest import DATA, ROOT


def lines_of_crambin(change):
    """The lines of the atoms of crambin, with a function of (number of the residue, name of the atom, line)."""
    lines = [line for line in (DATA / "1crn.pdb").read_text().splitlines() if line.startswith("ATOM")]
    return [change(int(line[22:26]), line[12:16].strip(), line) for line in lines]


@pytest.fixture
def pieces(tmp_path):
    """A file whose CA and CB stand at its end, as hydrogens of Open Babel do: 46 residues in 92 pieces."""
    marked = lines_of_crambin(lambda _, name, line: (name in ("CA", "CB"), line))
    path = tmp_path / "pieces.pdb"
    path.write_text("\n".join(line for late in (False, True) for end, line in marked if end == late) + "\nEND\n")
    return path


@pytest.fixture
def segments(tmp_path):
    """A file of HADDOCK's: blank chains, two segments whose residues have the numbers 1 to 23."""
    def moved(number, _, line):
        return f"{line[:21]} {(number - 1) % 23 + 1:4d}{line[26:72]:46}{'SA' if number <= 23 else 'SB':4}{line[76:]}"
    path = tmp_path / "segments.pdb"
    path.write_text("\n".join(lines_of_crambin(moved)) + "\nEND\n")
    return path


def areas_of_residues(path):
    m = ms.read(path)
    return np.bincount(m.residue_index, weights=ms.areas(m.positions, m.radii))


def test_mdanalysis_has_the_segments_of_the_file(segments):
    mda = pytest.importorskip("MDAnalysis")
    run = ms.mdanalysis.SurfaceAnalysis(mda.Universe(str(segments)).atoms).run()
    expected = areas_of_residues(segments)
    assert len(expected) == 46
    assert np.allclose(run.results.residue_area[0], expected, atol=0.01)
    largest = ms._adapters.largest_areas(mda.Universe(str(segments)).residues.resnames)
    assert np.allclose(run.results.relative[0], expected / largest, atol=1e-4)


def test_mdtraj_has_the_residues_of_the_file_or_their_pieces(pieces, segments):
    mdtraj = pytest.importorskip("mdtraj")
    made = 100 * ms.mdtraj.shrake_rupley(mdtraj.load(str(segments)), mode="residue")[0]
    assert np.allclose(made, areas_of_residues(segments), atol=0.01)
    traj = mdtraj.load(str(pieces))
    made = 100 * ms.mdtraj.shrake_rupley(traj, mode="residue")[0]
    assert len(made) == 92
    whole = np.bincount([residue.resSeq - 1 for residue in traj.topology.residues], weights=made)
    assert np.allclose(whole, areas_of_residues(pieces), atol=0.01)


def test_biopython_has_the_residues_of_the_file(pieces):
    pdb = pytest.importorskip("Bio.PDB")
    structure = pdb.PDBParser(QUIET=True).get_structure("pieces", str(pieces))
    ms.biopython.compute(structure, level="R")
    made = [residue.sasa for residue in structure.get_residues()]
    assert np.allclose(made, areas_of_residues(pieces), atol=0.01)
    assert len(ms.biopython.residue_depth(structure, voxel=1)) == 46


def test_no_package_is_imported_unless_it_is_used():
    code = ("import sys, vdb_molsurf; bad = {'MDAnalysis', 'mdtraj', 'Bio', 'tqdm'} & set(sys.modules); "
            "sys.exit(str(bad) if bad else 0)")
    assert subprocess.run([sys.executable, "-c", code]).returncode == 0
    with pytest.raises(AttributeError):
        ms.nothing


def universe():
    mda = pytest.importorskip("MDAnalysis")
    return mda.Universe(str(DATA / "1d3z.pdb.gz"))


def test_mdanalysis_has_the_areas_of_every_frame():
    u = universe()
    atoms = u.select_atoms("protein and not name H*")
    run = ms.mdanalysis.SurfaceAnalysis(atoms).run()
    frames, residues = len(u.trajectory), len(atoms.residues)
    assert run.results.residue_area.shape == run.results.relative.shape == (frames, residues)
    assert np.allclose(run.results.residue_area.sum(axis=1), run.results.total_area)
    u.trajectory[3]
    radii = ms.radii(atoms.names, atoms.resnames, atoms.elements)
    alone = ms.areas(atoms.positions, radii)
    assert np.allclose(run.results.atom_area[3], alone, rtol=1e-9)
    assert run.results.volume[3] == pytest.approx(ms.surface(atoms.positions, radii, kind="sas", grid=False).volume)
    part = ms.mdanalysis.SurfaceAnalysis(atoms).run(start=1, stop=6, step=2)
    assert np.array_equal(part.results.total_area, run.results.total_area[1:6:2])


def test_mdanalysis_agrees_with_the_file():
    u = universe()
    m = ms.read(DATA / "1d3z.pdb.gz", model=1)
    run = ms.mdanalysis.SurfaceAnalysis(u.atoms).run(stop=1)
    assert len(m) == len(u.atoms)
    assert run.results.total_area[0] == pytest.approx(m.surface(kind="sas", grid=False).area, rel=1e-5)
    table = m.surface(kind="sas", grid=False).table("residues")
    assert np.allclose(run.results.relative[0], table["relative_accessibility"], atol=1e-3)


def test_pieces_of_a_residue_have_the_share_of_the_whole():
    mda = pytest.importorskip("MDAnalysis")
    path = DATA / "cases" / "hydrogens_at_the_end.pdb"
    run = ms.mdanalysis.SurfaceAnalysis(mda.Universe(str(path))).run()
    table = ms.read(path).surface(kind="sas", grid=False).table("residues")
    relative = run.results.relative[0]
    assert len(relative) == 2 * len(table["relative_accessibility"])
    assert np.allclose(relative[:len(relative) // 2], table["relative_accessibility"], atol=1e-3)
    assert np.array_equal(relative[:len(relative) // 2], relative[len(relative) // 2:])


def test_mdanalysis_in_parallel_and_with_meshes():
    atoms = universe().select_atoms("protein and not name H*")
    once = ms.mdanalysis.SurfaceAnalysis(atoms, radii="protor").run(stop=4)
    many = ms.mdanalysis.SurfaceAnalysis(atoms, radii="protor").run(stop=4, backend="multiprocessing", n_workers=2)
    assert np.array_equal(once.results.residue_area, many.results.residue_area)
    meshed = ms.mdanalysis.SurfaceAnalysis(atoms, kind="ses", voxel=1).run(stop=1)
    assert meshed.results.total_area[0] > 0 and "relative" not in meshed.results
    united = ms.mdanalysis.SurfaceAnalysis(universe().select_atoms("protein"), radii="protor").run(stop=1)
    assert united.results.total_area[0] == pytest.approx(once.results.total_area[0], rel=1e-6)
    with pytest.raises(ValueError, match="radii: expected"):
        ms.mdanalysis.SurfaceAnalysis(atoms, radii=np.ones(3))
    with pytest.raises(TypeError, match="did you mean voxel"):
        ms.mdanalysis.SurfaceAnalysis(atoms, voxl=1).run(stop=1)


def test_mdtraj_has_its_shapes_and_units():
    mdtraj = pytest.importorskip("mdtraj")
    traj = mdtraj.load(str(DATA / "1crn.pdb"))
    atoms = ms.mdtraj.shrake_rupley(traj)
    residues = ms.mdtraj.shrake_rupley(traj, mode="residue")
    assert atoms.shape == (1, 327) and residues.shape == (1, 46) and atoms.dtype == np.float32
    m = ms.read(DATA / "1crn.pdb")
    assert np.allclose(100 * atoms[0], ms.areas(m.positions, m.radii), atol=0.01)
    theirs = mdtraj.shrake_rupley(traj, n_sphere_points=4000, mode="residue")
    own = [mdtraj.geometry.sasa._ATOMIC_RADII[a.element.symbol] for a in traj.topology.atoms]
    ours = ms.mdtraj.shrake_rupley(traj, mode="residue", radii=own)
    assert theirs.shape == ours.shape and np.abs(theirs - ours).max() < 0.02
    with pytest.raises(ValueError, match="mode: expected atom or residue"):
        ms.mdtraj.shrake_rupley(traj, mode="chain")


@pytest.fixture
def structure():
    pdb = pytest.importorskip("Bio.PDB")
    return pdb.PDBParser(QUIET=True).get_structure("1crn", str(DATA / "1crn.pdb"))


def test_biopython_sets_areas_up_to_a_level(structure):
    ms.biopython.compute(structure, level="S")
    chain = structure[0]["A"]
    total = sum(atom.sasa for atom in structure.get_atoms())
    for part in (structure, structure[0], chain):
        assert part.sasa == pytest.approx(total)
    assert sum(residue.sasa for residue in chain) == pytest.approx(total)
    m = ms.read(DATA / "1crn.pdb")
    assert total == pytest.approx(ms.areas(m.positions, m.radii).sum(), rel=1e-6)


def test_biopython_is_as_its_own_with_its_radii(structure):
    from Bio.PDB.SASA import ATOMIC_RADII, ShrakeRupley
    ShrakeRupley(n_points=2000).compute(structure, level="R")
    theirs = [residue.sasa for residue in structure.get_residues()]
    ms.biopython.compute(structure, "R", radii=[ATOMIC_RADII[atom.element] for atom in structure.get_atoms()])
    ours = [residue.sasa for residue in structure.get_residues()]
    assert np.abs(np.subtract(theirs, ours)).max() < 2.0


def test_biopython_refuses_what_it_cannot(structure):
    chain = structure[0]["A"]
    for call, kind in [(lambda: ms.biopython.compute(structure, "X"), ValueError),
                       (lambda: ms.biopython.compute(chain, "S"), ValueError),
                       (lambda: ms.biopython.compute(3), TypeError)]:
        with pytest.raises(kind):
            call()
    ms.biopython.compute(chain, "C")
    assert chain.sasa > 0 and not hasattr(structure, "sasa")


def test_depth_of_one_atom_is_its_radius(structure):
    chain = structure[0]["A"].copy()
    for residue in list(chain)[1:]:
        chain.detach_child(residue.id)
    for atom in list(chain[1])[1:]:
        chain[1].detach_child(atom.id)
    [(residue, of_ca)] = ms.biopython.residue_depth(chain, radii=1.7).values()
    assert residue == pytest.approx(1.7, abs=0.002) and of_ca is None


def test_depths_are_those_of_biopython_with_msms(structure):
    from Bio.PDB.ResidueDepth import ResidueDepth, _get_atom_radius
    msms = next(ROOT.glob("build*/tools/vdb_molsurf_msms"), None)
    if msms is None:
        pytest.skip("without vdb_molsurf_msms in a build folder")
    theirs = ResidueDepth(structure[0], msms_exec=str(msms)).property_dict
    radii = [_get_atom_radius(atom) for atom in structure[0].get_atoms()]
    ours = ms.biopython.residue_depth(structure, probe_radius=1.5, radii=radii)
    assert {key[0:2] for key in theirs} == set(ours)
    # They take the nearest vertex, which is farther than the surface.
    over = np.array([[theirs[key][k] - ours[key][k] for k in (0, 1)] for key in ours])
    assert np.abs(over[:, 0]).max() < 0.2 and np.abs(over[:, 1]).max() < 0.3
    assert 0 < over.mean() < 0.1
