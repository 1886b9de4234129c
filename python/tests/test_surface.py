# SPDX-License-Identifier: MPL-2.0
"""What surfaces, areas, contacts, distances and comparisons are, against closed forms and searches through all atoms."""

import gc
import html
import json
import math
import pickle
import re
import subprocess

import numpy as np
import pytest

import vdb_molsurf as ms
from conftest import DATA
from test_commands import command

ONE = np.array([[0.3, -0.2, 0.1]])


def spread(n):
    """Points spread evenly over the unit sphere (Fibonacci's lattice)."""
    k = np.arange(n)
    z, turn = 1 - (2 * k + 1) / n, k * math.pi * (3 - math.sqrt(5))
    return np.c_[np.sqrt(1 - z * z) * np.cos(turn), np.sqrt(1 - z * z) * np.sin(turn), z]


def test_a_ball_has_its_area_volume_and_curvature():
    s = ms.surface(ONE, 2.0, kind="vdw", voxel=0.25)
    assert s.area == pytest.approx(16 * math.pi, rel=1e-8) and s.volume == pytest.approx(32 / 3 * math.pi, rel=1e-8)
    assert np.allclose(np.linalg.norm(s.vertices - ONE, axis=1), 2.0, atol=1e-4)
    assert np.allclose(s.curvature, 0.5, atol=0.01) and np.allclose(s.gaussian_curvature, 0.25, atol=0.01)
    assert np.allclose(s.principal_curvatures, 0.5, atol=0.03) and np.median(s.shape_index) > 0.9
    assert np.allclose((s.normals * (s.vertices - ONE)).sum(axis=1), 2.0, atol=1e-3)
    corners = s.vertices[s.faces]
    assert np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])).sum() > 0
    assert s.closed and s.kind == "vdw" and len(s.cavities) == 0 and np.allclose(s.atom_areas, s.area)


def test_arrays_have_their_types(ses):
    n, m = len(ses.vertices), len(ses.faces)
    for name, shape, kind in [("vertices", (n, 3), "f4"), ("normals", (n, 3), "f4"), ("faces", (m, 3), "i4"),
                              ("curvature", (n,), "f4"), ("gaussian_curvature", (n,), "f4"), ("atom", (n,), "i4"),
                              ("atom_areas", (327,), "f8"), ("cavities", (1, 2), "f8"), ("colors", (0, 3), "u1")]:
        array = getattr(ses, name)
        assert array.dtype == np.dtype(kind), name
        assert array.shape == shape or name == "colors" and array.size == 0, name
    assert ses.faces.min() == 0 and ses.faces.max() == n - 1
    assert set(ses.vertex_data) >= {"mean_curvature", "gaussian_curvature", "atom_id", "chain_id"}


def test_views_are_writable_share_memory_and_outlive_their_owner(crambin):
    s = crambin.surface(kind="ses", voxel=1)
    first, again = s.vertices, s.vertices
    assert first.flags.writeable and not first.flags.owndata and np.shares_memory(first, again)
    before = first.copy()
    first += 1
    assert np.array_equal(again, before + 1)
    del s
    gc.collect()
    junk = [np.ones(1000) for _ in range(1000)]
    assert np.array_equal(first, before + 1) and junk
    assert np.array_equal(np.from_dlpack(first), first)


def test_the_atom_of_a_vertex_is_the_nearest(crambin, ses):
    some = slice(None, None, 7)
    gaps = np.linalg.norm(ses.vertices[some, None].astype(float) - crambin.positions, axis=2) - crambin.radii
    assert np.allclose(gaps[np.arange(len(gaps)), ses.atom[some]], gaps.min(axis=1), atol=1e-5)


def test_atoms_count_places_in_the_arrays_and_ids_those_in_the_file():
    from conftest import DATA
    part = ms.read(DATA / "1crn.pdb", select="A/10-20")
    s = part.surface(kind="vdw", voxel=1, fields="atom_id")
    assert s.atom.max() < len(part) < 327 and part.atom_id.min() > 20
    assert np.array_equal(s.vertex_data["atom_id"], part.atom_id[s.atom])


def test_areas_are_those_of_the_surface_and_of_points(crambin):
    x, r = crambin.positions, crambin.radii
    areas = ms.areas(x, r)
    s = crambin.surface(kind="sas", grid=False)
    assert areas.sum() == pytest.approx(s.area, rel=1e-9) and np.allclose(areas, s.atom_areas, atol=1e-6)
    unit = spread(2000)
    for i in range(0, 327, 20):
        points = x[i] + (r[i] + 1.4) * unit
        others = np.delete(np.arange(327), i)
        covered = (np.linalg.norm(points[:, None] - x[others], axis=2) < r[others] + 1.4).any(axis=1)
        assert areas[i] == pytest.approx(4 * math.pi * (r[i] + 1.4)**2 * (1 - covered.mean()), abs=0.6)


def test_contacts_of_two_balls_are_their_disk():
    pairs, area, distance = ms.contacts([[0, 0, 0], [2, 0, 0], [50, 0, 0]], 1.5, probe=0.0)
    assert pairs.tolist() == [[0, 1]] and distance[0] == 2.0
    assert area[0] == pytest.approx(math.pi * (1.5**2 - 1.0))


def test_contacts_of_a_surface_are_those_of_its_probe(crambin, ses):
    of_surface = ses.contacts
    alone = ms.contacts(crambin.positions, crambin.radii, 1.4)
    assert np.array_equal(of_surface.pairs, alone.pairs) and np.allclose(of_surface.area, alone.area)


def brute_distance(points, x, r):
    """Signed distance outside of a union of balls; nan inside."""
    gaps = (np.linalg.norm(points[:, None] - x, axis=2) - r).min(axis=1)
    return np.where(gaps >= 0, gaps, np.nan)


def test_a_pore_is_a_table(crambin, ses):
    from conftest import DATA
    surface = ms.read(DATA / "1grm.pdb.gz").surface(kind="ses", voxel=1, pore="0,-12.5,3 -> 0,12.5,3")
    assert min(surface.pore["radius_A"]) == surface.report["pore"]["radius"]
    assert set(pickle.loads(pickle.dumps(surface)).pore) == set(surface.table("pore"))
    with pytest.raises(ValueError, match="pore"):
        ses.pore


def test_tunnels_are_a_table(ses):
    from conftest import DATA
    surface = ms.read(DATA / "1grm.pdb.gz", tunnels_from="resid 1").surface(kind="ses", voxel=1)
    assert set(surface.tunnels["tunnel"]) == {1, 2}  # both ends of the channel
    assert min(surface.tunnels["radius_A"]) == min(one["radius"] for one in surface.report["tunnels"]["list"])
    assert set(pickle.loads(pickle.dumps(surface)).tunnels) == set(surface.table("tunnels"))
    with pytest.raises(ValueError, match="tunnels_from"):
        ses.tunnels


def test_pockets_are_a_table(crambin, ses):
    surface = crambin.surface(kind="ses", voxel=0.7, pockets=True, pocket_cut=0)
    table = surface.pockets
    assert list(table["pocket"]) == list(range(1, len(table["volume"]) + 1))
    assert (np.diff(table["volume"]) <= 0).all() and table["volume"][0] > 5
    assert surface.report["pockets"]["cut"] == 0
    assert set(pickle.loads(pickle.dumps(surface)).pockets) == set(table)
    with pytest.raises(ValueError, match="pockets"):
        ses.pockets


def test_patches_are_a_table_and_colours(crambin, ses):
    surface = crambin.surface(voxel=0.7, patches="hydrophobicity>0", color="patch")
    table = surface.patches
    assert (np.diff(table["area"]) <= 0).all() and set(table["side"]) == {"above"}
    assert set(surface.vertex_data["patch"]) == set(range(len(table["area"]) + 1))
    low = crambin.surface(voxel=0.7, patches="hydrophobicity<0").patches
    corners = surface.vertices[surface.faces].astype(float)
    whole = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1).sum() / 2
    assert abs(table["area"].sum() + low["area"].sum() - whole) < 1e-6 * whole
    assert np.allclose(table["mean"] * table["area"], table["integral_A2"])
    assert (pickle.loads(pickle.dumps(surface)).patches["area"] == table["area"]).all()
    with pytest.raises(ValueError, match="patches"):
        ses.patches
    with pytest.raises(ms.OptionError, match="hydrophobicity"):
        crambin.surface(patches="hydrophob>0")


def test_colours_are_smoothed(crambin):
    rough, smooth = (crambin.surface(voxel=0.7, color="mean-curvature", **more) for more in ({}, {"smooth_colors": 3}))
    assert (smooth.vertices == rough.vertices).all()
    assert smooth.curvature.std() < 0.6 * rough.curvature.std() and (smooth.colors != rough.colors).any()
    one = ms.surface(ONE, 2.0, kind="vdw", voxel=0.25, color="mean-curvature", smooth_colors=1)
    assert np.allclose(one.curvature, 0.5, atol=0.02)
    with pytest.raises(ms.OptionError, match="smooth_colors"):
        ms.surface(ONE, 2.0, smooth_colors=0.1)


def test_colours_by_groups_of_their_own(tmp_path):
    (tmp_path / "colors").write_text("first A/1-15 #ff0000\nsecond A/16-30 #00ff00\n")
    m = ms.read(DATA / "1crn.pdb", groups={"stem": "resid 1-23"})
    surface = m.surface(voxel=1, color=f"groups={tmp_path / 'colors'}", surface_of="stem=vdw")
    assert {(255, 0, 0), (0, 255, 0)} < set(map(tuple, surface.colors.tolist()))
    assert [part["name"] for part in surface.report["parts"]] == ["stem", "other"]
    a, b = (ms.read(DATA / "1crn.pdb", groups={"stem": "resid 1-23"}, resolution=f"{name}=6").surface(voxel=1) for name in ("stem", "resid 1-23"))
    assert (a.vertices == b.vertices).all()


@pytest.mark.parametrize("kind, probe", [("sas", 1.4), ("vdw", 0.0)])
def test_distances_from_unions_are_exact(crambin, kind, probe):
    x, r = crambin.positions, crambin.radii
    points = np.random.default_rng(1).uniform(x.min(0) - 6, x.max(0) + 6, (4000, 3))
    d = crambin.surface(kind=kind, grid=False).distance(points)
    outside = brute_distance(points, x, r + probe)
    known = ~np.isnan(outside)
    assert 500 < known.sum() < 3900
    assert np.abs(d.distance[known] - outside[known]).max() < 1e-5 and (d.distance[~known] < 0).all()
    assert np.allclose(np.linalg.norm(d.closest - points, axis=1), np.abs(d.distance), atol=1e-7)
    # The nearest point lies on the boundary: in no ball, and on a sphere.
    on = (np.linalg.norm(d.closest[:, None] - x, axis=2) - r - probe).min(axis=1)
    assert np.abs(on).max() < 1e-5
    gaps = np.linalg.norm(points[:, None] - x, axis=2) - r
    assert np.array_equal(d.atom, gaps.argmin(axis=1))


def test_no_point_of_the_boundary_is_nearer(crambin):
    """Inside, against many points of the spheres that no ball covers."""
    x, r = crambin.positions, crambin.radii + 1.4
    bare = []
    for i in range(327):
        points = x[i] + r[i] * spread(3000)
        near = np.flatnonzero((np.linalg.norm(x - x[i], axis=1) < r + r[i]) & (np.arange(327) != i))
        bare.append(points[(np.linalg.norm(points[:, None] - x[near], axis=2) >= r[near]).all(axis=1)])
    bare = np.concatenate(bare)
    inside = x[::5]
    d = crambin.surface(kind="sas", grid=False).distance(inside).distance
    sampled = np.array([np.linalg.norm(bare - point, axis=1).min() for point in inside])
    assert (d < 0).all() and (-d <= sampled + 1e-5).all() and (sampled + d).max() < 0.12


def test_distances_from_other_kinds_are_those_of_their_mesh(ses):
    rng = np.random.default_rng(2)
    far = rng.uniform(-30, 40, (300, 3))
    for points in (far, ses.vertices[::50] + rng.normal(0, 0.5, ses.vertices[::50].shape)):
        d = ses.distance(points)
        nearest = np.linalg.norm(points[:, None] - ses.vertices, axis=2).min(axis=1)
        assert (np.abs(d.distance) <= nearest + 0.05).all() and np.abs(np.abs(d.distance) - nearest).max() < 0.4
        assert np.allclose(np.linalg.norm(d.normal, axis=1), 1, atol=1e-6)
    at = ses.distance(ses.vertices[::20])
    assert np.median(np.abs(at.distance)) < 3e-3 and np.abs(at.distance).max() < 0.1
    for side in (-0.2, 0.2):
        moved = ses.distance(ses.vertices[::20] + side * ses.normals[::20]).distance
        assert np.median(moved) == pytest.approx(side, abs=0.01)


def test_distances_are_those_of_the_spline_if_it_is_kept(crambin):
    s = crambin.surface(kind="ses", fields="spline")
    assert np.abs(s.distance(s.vertices[::20]).distance).max() < 1e-4


def test_voxels_are_the_level_set(ses):
    v = ses.voxels()
    assert v.coordinates.dtype == np.int32 and v.coordinates.shape == (len(v.values), 3) and v.edge == 0.5
    at = np.array(v.origin) + v.coordinates * v.edge
    near = np.flatnonzero(np.abs(v.values) < 0.4)[::40]
    assert np.abs(ses.distance(at[near]).distance - v.values[near]).max() < 0.05
    with pytest.raises(ValueError):
        ms.surface(ONE, 2.0, kind="sas", grid=False).voxels()


def test_samples_lie_on_the_surface_evenly(ses):
    a = ses.sample(4000, seed=3)
    assert np.abs(ses.distance(a.points).distance).max() < 0.1
    assert np.array_equal(a.points, ses.sample(4000, seed=3).points)
    assert not np.array_equal(a.points, ses.sample(4000, seed=4).points)
    assert np.allclose(np.linalg.norm(a.normals, axis=1), 1)
    corners = ses.vertices[ses.faces].astype(float)
    areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    low = corners.mean(axis=1)[:, 0] < np.median(corners.mean(axis=1)[:, 0])
    share = areas[low].sum() / areas.sum()
    assert low[a.faces].mean() == pytest.approx(share, abs=0.03)


def test_report_and_files(ses, tmp_path):
    report = ses.report
    assert report["surface"]["area"] == ses.area and report["voxel"] == 0.5 and report["atoms"] == 327
    for name in ("a.ply", "a.obj", "a.stl", "a.off", "a.wrl", "a.glb", "a.vdb", "a.json"):
        ses.save(tmp_path / name)
        assert (tmp_path / name).stat().st_size > 1000
    ses.save(tmp_path / "b.vdb")
    assert (tmp_path / "a.vdb").read_bytes() == (tmp_path / "b.vdb").read_bytes()
    assert json.loads((tmp_path / "a.json").read_text())["surface"] == report["surface"]
    ses.picture(tmp_path / "a.png", 200)
    assert (tmp_path / "a.png").read_bytes()[:4] == b"\x89PNG"
    assert ms.compare(ses, tmp_path / "a.ply").hausdorff < 1e-3


def test_a_vdb_is_placed_for_a_program(crambin, tmp_path):
    """The files are those of the command line, which has tests that open them in Blender."""
    for name, scene, given in [("plain", None, []), ("blender", "blender", ["--for", "blender"]),
                               ("houdini", "houdini=0.5", ["--for", "houdini=0.5"])]:
        crambin.surface(kind="ses", voxel=1).to_vdb(tmp_path / f"{name}.vdb", scene=scene)
        told = subprocess.run([command("vdb_molsurf"), "info", tmp_path / f"{name}.vdb"], capture_output=True, text=True,
                              check=True).stdout
        subprocess.run([command("vdb_molsurf"), DATA / "1crn.pdb", "--surface", "ses", "--voxel", "1", *given, "-o", tmp_path / "b.vdb",
                        "--force", "-q"], check=True)
        expected = subprocess.run([command("vdb_molsurf"), "info", tmp_path / "b.vdb"], capture_output=True, text=True,
                                  check=True).stdout
        surfaces = [re.search("  grid surface\n(?:    .*\n)*", text)[0] for text in (told, expected)]
        placed = [re.findall("scene.*", text) + re.findall("(?:transform|voxel size|background|active|bounding|area|volume) .*", own)
                  for text, own in zip((told, expected), surfaces)]
        assert len(placed[0]) == 13 and placed[0] == placed[1]


def test_a_page_has_the_colours_and_names_of_the_atoms(crambin, tmp_path):
    s = crambin.surface(kind="ses", voxel=1, color="chain")
    s.save(tmp_path / "crambin.html")
    page = (tmp_path / "crambin.html").read_text()
    assert page.startswith("<!DOCTYPE html>") and "<title>1crn" in page and "TYR" in page
    view = s.view(300)
    shown = view._repr_html_()
    assert "\n" not in repr(view)
    inside = html.unescape(re.search('srcdoc="([^"]*)"', shown).group(1))
    assert inside == view.html and "height: 300px" in shown and "allow-same-origin" not in shown
    table = s._repr_html_()
    assert f"{s.area:.2f}" in table and f"{len(s.faces)}" in table
    points = ms.surface(ONE, 2.0, kind="vdw", voxel=0.5)
    assert "TYR" not in points.view().html
    points.picture(tmp_path / "a.png", 100)


def test_comparisons_have_both_ways():
    a, b = ms.surface(ONE, 2.0, kind="vdw", voxel=0.2), ms.surface(ONE, 2.5, kind="vdw", voxel=0.2)
    both = ms.compare(a, (b.vertices, b.faces))
    assert both.hausdorff == pytest.approx(0.5, abs=0.01) and both.a_to_b["mean"] == pytest.approx(0.5, abs=0.01)
    assert both.a_to_b["inside"] == 1.0 and both.b_to_a["inside"] == 0.0
    assert len(both.a_to_b["distance"]) == len(a.vertices) and "0.5" in repr(both)


def test_options_change_the_surface(crambin):
    small = crambin.surface(kind="ses", voxel=1)
    assert len(small.vertices) < 5000
    assert crambin.surface(kind="ses", voxel=1, fill_cavities=True).cavities.shape == (0, 2)
    assert crambin.surface(voxel=1, lambda_=1.0).volume > 1.1 * crambin.surface(voxel=1).volume
    colored = crambin.surface(voxel=1, color="element")
    assert colored.colors.shape == (len(colored.vertices), 3) and len(np.unique(colored.colors, axis=0)) > 2
    assert crambin.surface(voxel=1, kind="ses", areas_of=None).area == crambin.surface(voxel=1, kind="ses").area
    assert crambin.surface(voxel=1, kind="ses", areas_of="sas").atom_areas.sum() == pytest.approx(
        ms.areas(crambin.positions, crambin.radii).sum(), rel=1e-9)
    with pytest.raises(AttributeError):
        crambin.surface(kind="ses", voxel=1, atom_areas=False).atom_areas


def test_repr_is_one_line(ses):
    assert repr(ses) == (f"<Surface ses: 327 atoms, {len(ses.vertices)} vertices, {len(ses.faces)} faces, "
                         f"area {ses.area:.1f} Å², volume {ses.volume:.1f} Å³>")


def test_triangles_of_an_even_size(crambin):
    plain, made = crambin.surface(kind="ses"), crambin.surface(kind="ses", remesh=0.7)
    assert (plain.area, plain.volume) == (made.area, made.volume) and len(made.faces) < 0.6 * len(plain.faces)
    assert np.array_equal(plain.atom_areas, made.atom_areas)
    assert plain.report["surface"]["mesh_shape"] is None
    shape = made.report["surface"]["mesh_shape"]
    corners = made.vertices.astype(float)[made.faces]
    edges = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2)
    assert shape["least_angle"] > 28 and shape["euler_characteristics"] == [2, 2]
    assert (shape["shortest_edge"], shape["longest_edge"]) == pytest.approx((edges.min(), edges.max()), rel=1e-6)
    assert len(made.curvature) == len(made.atom) == len(made.vertices)
    dense = crambin.surface(kind="ses", density=1.5)
    assert len(dense.vertices) / dense.area == pytest.approx(1.5, abs=0.3)  # more at creases
    bent = crambin.surface(kind="ses", remesh=1.5, adapt=0.05)
    assert len(bent.vertices) > 1.5 * len(crambin.surface(kind="ses", remesh=1.5).vertices)
    with pytest.raises(ms.OptionError, match="remesh"):
        crambin.surface(adapt=0.05)
    with pytest.raises(ms.OptionError, match="0.05 to 10"):
        crambin.surface(remesh=0)


@pytest.mark.parametrize("kind", ["vdw", "sas", "ses"])
def test_forces_are_derivatives(kind):
    random = np.random.default_rng(4)
    places, radii = random.uniform(-3, 3, (12, 3)), random.uniform(1.3, 1.9, 12)
    made = lambda x: ms.surface(x, radii, kind=kind, grid=False)
    tension, pressure = made(places).forces(gamma=1), made(places).forces(pressure=1)
    assert tension.shape == (12, 3) and tension.dtype == np.float64
    assert np.allclose(tension.sum(axis=0), 0, atol=1e-9) and np.allclose(pressure.sum(axis=0), 0, atol=1e-9)
    assert np.allclose(made(places).forces(0.3, -2), 0.3 * tension - 2 * pressure)
    for atom, axis in (0, 0), (5, 1), (9, 2):
        sides = []
        for step in (1e-3, -1e-3):
            moved = places.copy()
            moved[atom, axis] += step
            sides.append(made(moved))
        assert -tension[atom, axis] == pytest.approx((sides[0].area - sides[1].area) / 2e-3, abs=5e-3)
        assert -pressure[atom, axis] == pytest.approx((sides[0].volume - sides[1].volume) / 2e-3, abs=5e-3)


@pytest.mark.parametrize("kind", ["variational", "smooth-sas"])
def test_forces_of_smooth_surfaces_are_derivatives(kind):
    random = np.random.default_rng(4)
    places, radii = random.uniform(-3, 3, (12, 3)), random.uniform(1.3, 1.9, 12)
    made = lambda x: ms.surface(x, radii, kind=kind, voxel=0.25)
    forces = made(places).forces(gamma=1, pressure=1)
    rms = np.sqrt((forces**2).mean())
    assert np.allclose(forces.sum(axis=0), 0, atol=1e-9)
    for atom, axis in (0, 0), (5, 1), (9, 2):
        sides = []
        for step in (0.03, -0.03):
            moved = places.copy()
            moved[atom, axis] += step
            sides.append(made(moved))
        difference = (sides[0].area + sides[0].volume - sides[1].area - sides[1].volume) / 0.06
        assert -forces[atom, axis] == pytest.approx(difference, abs=0.03 * rms)


def test_forces_where_fronts_move_are_refused(crambin):
    with pytest.raises(ms.OptionError, match="rests in closed form"):
        crambin.surface(voxel=1, lambda_=0.1).forces(1)
    with pytest.raises(ms.OptionError, match="smooth-sas"):
        crambin.surface(voxel=1, kind="gaussian").forces(1)
    with pytest.raises(ValueError, match="gamma"):
        crambin.surface(kind="sas", grid=False).forces(float("nan"))
    with pytest.raises(TypeError, match="expected gamma, energy per Å², or pressure"):
        crambin.surface(kind="sas", grid=False).forces()
    assert not crambin.surface(kind="sas", grid=False).forces(gamma=0).any()


def test_nanometres_are_named(crambin, recwarn):
    with pytest.warns(UserWarning, match="are the coordinates in nanometres"):
        ms.surface(crambin.positions / 10, 1.7, kind="sas", voxel=0.5)
    recwarn.clear()
    ms.surface(crambin.positions, 1.7, kind="sas", voxel=1)
    assert not recwarn.list


def test_a_mesh_for_trimesh(crambin):
    trimesh = pytest.importorskip("trimesh")
    s = crambin.surface(kind="ses", voxel=0.7, color="element")
    mesh = s.to_trimesh()
    assert isinstance(mesh, trimesh.Trimesh) and mesh.is_watertight
    assert mesh.area == pytest.approx(s.area, rel=0.05) and mesh.volume == pytest.approx(s.volume, rel=0.05)
    assert np.array_equal(mesh.vertices, s.vertices) and np.array_equal(mesh.faces, s.faces)
    assert np.allclose(mesh.vertex_attributes["mean_curvature"], s.curvature)
    assert np.array_equal(mesh.visual.vertex_colors[:, :3], s.colors)
    mesh.vertices[:] = 0
    assert np.abs(s.vertices).max() > 1


def test_a_mesh_for_pyvista(crambin):
    pytest.importorskip("pyvista")
    s = crambin.surface(kind="ses", voxel=0.7)
    mesh = s.to_pyvista()
    assert mesh.n_points == len(s.vertices) and mesh.n_cells == len(s.faces) and mesh.is_manifold
    assert np.allclose(mesh.point_data["mean_curvature"], s.curvature) and "RGB" not in mesh.point_data
    directed = crambin.surface(kind="ses", voxel=1, fields="principal_direction_1,shape_index")
    mesh = directed.to_pyvista()
    vectors = mesh.point_data["principal_direction_1"]
    assert vectors.shape == directed.vertices.shape and "principal_direction_1_x" not in mesh.point_data
    assert np.array_equal(vectors[:, 2], directed.vertex_data["principal_direction_1_z"])
    assert mesh.point_data["shape_index"].shape == (len(vectors),)
    assert mesh.glyph(orient="principal_direction_1", scale=False, tolerance=0.1).n_cells > 100
    mesh = s.to_pyvista()
    assert mesh.area == pytest.approx(s.area, rel=0.05)
