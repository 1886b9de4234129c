# SPDX-License-Identifier: MPL-2.0
"""Surfaces, and what is known of balls in closed form."""

import html
import json
import os
import tempfile
import warnings
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from . import _arrays, _core, _options


class Distances(NamedTuple):
    """Where points lie to a surface."""
    distance: np.ndarray
    closest: np.ndarray
    normal: np.ndarray
    atom: np.ndarray


class Contacts(NamedTuple):
    """Pairs of atoms that touch, with the area of each contact and the distance of their centres."""
    pairs: np.ndarray
    area: np.ndarray
    distance: np.ndarray


class Voxels(NamedTuple):
    """Active voxels; the centre of voxel ijk lies at origin + ijk * edge."""
    coordinates: np.ndarray
    values: np.ndarray
    edge: float
    origin: tuple


class Samples(NamedTuple):
    """Points on a surface, evenly by area."""
    points: np.ndarray
    normals: np.ndarray
    faces: np.ndarray


class Comparison(NamedTuple):
    """Distances of two surfaces, both ways; each way is a dict of numbers and arrays."""
    hausdorff: float
    a_to_b: dict
    b_to_a: dict

    def __repr__(self):
        return (f"<Comparison: Hausdorff {self.hausdorff:.4g} Å, mean {self.a_to_b['mean']:.4g} and "
                f"{self.b_to_a['mean']:.4g} Å>")


def _listener(progress):
    """What the module calls with stage and fraction, and what ends it."""
    if progress is None or progress is False:
        return None, lambda: None
    if progress is not True:
        if not callable(progress):
            raise TypeError(f"progress: expected a callable, True or None, got {type(progress).__name__}")
        return progress, lambda: None
    from tqdm.auto import tqdm
    bar = tqdm(total=1.0, bar_format="{desc}: {percentage:3.0f}% {bar} {elapsed}", leave=False)

    def show(stage, fraction):
        bar.set_description(stage, refresh=False)
        bar.n = fraction
        bar.refresh()
    return show, bar.close


def _threads(threads):
    if isinstance(threads, bool) or not isinstance(threads, (int, np.integer)) or not 0 <= threads <= 4096:
        raise ValueError("threads: expected a whole number from 0 to 4096")
    return int(threads)


def _called(function, *arguments, progress=None, threads=0):
    listener, end = _listener(progress)
    try:
        return function(*arguments, listener, _threads(threads))
    finally:
        end()


def _split(options):
    """Keywords without a row, and the others."""
    options = dict(options)
    more = {name: options.pop(name) for name in _options.MORE if name in options}
    extra = []
    for name, on in (("atom_areas", more.pop("atom_areas", True)), ("grid", more.pop("grid", True))):
        if not isinstance(on, (bool, np.bool_)):
            raise TypeError(f"{name}: expected bool, got {type(on).__name__}")
        if name == "atom_areas" and on:
            extra.append("atom_areas")
        if name == "grid" and not on:
            extra.append("no_grid")
    areas_of = more.pop("areas_of", None)
    areas_of = "" if areas_of is None else areas_of
    if not isinstance(areas_of, str):
        raise TypeError(f"areas_of: expected str, got {type(areas_of).__name__}")
    kinds = _options.KEYWORDS["kind"]["words"]
    if areas_of and areas_of not in kinds:
        raise ValueError(f"areas_of: expected {' or '.join(kinds)}")
    return options, extra, areas_of, more


def _made(pairs, extra, areas_of):
    """What the module takes; surfaces of parts have no areas of atoms."""
    parts = any(name in ("split", "surface-of") for name, _ in pairs)
    return pairs, [name for name in extra if not (parts and name == "atom_areas")], areas_of


def _word(name, value):
    """The value of an option as it is typed: a direction with commas, a number with all its digits."""
    if isinstance(value, (str, os.PathLike)):
        return os.fspath(value)
    if np.ndim(value) > 0:
        return ",".join(repr(float(x)) for x in _arrays.numbers(value, name).ravel())
    return str(value)


def _place(keyword, place):
    """A place as it is typed."""
    numbers = _arrays.numbers(place, keyword)
    if numbers.shape != (3,) or not np.isfinite(numbers).all():
        raise ValueError(f"{keyword}: expected a place (x, y, z), got {numbers.tolist()!r:.40}")
    return _word(keyword, numbers)


def _pairs(keyword, what, pairs):
    """Notes of two parts each; a text alone is the first."""
    try:
        return [(first, second) for first, second in ((one, None) if isinstance(one, str) else one for one in pairs)]
    except (TypeError, ValueError):
        raise TypeError(f"{keyword}: expected a list of pairs of {what}, got {type(pairs).__name__}") from None


def _shown(show):
    """Words of styles, and the cores of molecules."""
    if show is None:
        return []
    if not isinstance(show, Mapping):
        raise TypeError(f"show: expected molecules by words of styles, a dict, got {type(show).__name__}")
    for one in show.values():
        if not isinstance(getattr(one, "_core", None), _core.Molecule):
            raise TypeError(f"show: expected molecules, got {type(one).__name__}")
    return [(str(style), one._core) for style, one in show.items()]


def _named(surface, panels):
    """The name of a surface, and the names and cores of its panels."""
    if panels is None:
        return "", []
    if not hasattr(panels, "__iter__"):
        raise TypeError(f"panels: expected a list or a dict of surfaces, got {type(panels).__name__}")
    names = dict(panels) if isinstance(panels, Mapping) else None
    others = list(panels) if names is None else [one for name, one in names.items() if name != ""]
    for one in others:
        if not isinstance(one, Surface):
            raise TypeError(f"panels: expected surfaces, got {type(one).__name__}")
    titles = [one.kind for one in others] if names is None else [str(name) for name in names if name != ""]
    own = surface.kind if names is None else names.get("", surface.kind)
    if not isinstance(own, str):
        raise TypeError(f"panels: expected the name of this surface as that of '', got {type(own).__name__}")
    return own, [(title, one._core) for title, one in zip(titles, others)]


# The options of pictures by their keywords.
LOOK = {"width": "size", **{name: name.replace("_", "-") for name in (
    "view", "up", "turn", "background", "plain_color", "style", "opacity", "show_behind", "clip", "depth_cue", "legend", "scale_bar",
    "dpi", "zoom", "pieces", "sharp_colors")}}


def _attributes(data):
    """vertex_data with vectors (n, 3) in the place of their components NAME_x, NAME_y and NAME_z."""
    out = {}
    for name, values in data.items():
        stem = name[:-2]
        if name.endswith("_x") and {f"{stem}_y", f"{stem}_z"} <= set(data):
            out[stem] = np.stack([data[f"{stem}_{axis}"] for axis in "xyz"], axis=1)
        elif not (name.endswith(("_y", "_z")) and stem in out):
            out[name] = np.array(values)
    return out


class Surface:
    """The surface of a molecule: what surface() and Molecule.surface() make.

    Arrays are views of its memory: they may be written to, and live on without it.
    """

    __slots__ = ("_core", "_made")

    def __init__(self, core, made):
        self._core, self._made = core, made

    def __repr__(self):
        return (f"<Surface {self.kind}: {self._core.atoms} atoms, {len(self._core.vertices)} vertices, "
                f"{len(self._core.faces)} faces, area {self.area:.1f} Å², volume {self.volume:.1f} Å³>")

    def __reduce__(self):
        return _unpickled, (self._core.state(), self._made)

    def _meshed(self, name):
        """What the mesh has by this name."""
        if len(self._core.vertices) == 0:
            raise AttributeError(f"{name}: a surface without a grid has no mesh [hint: grid=True]")
        return getattr(self._core, name)

    @property
    def vertices(self):
        """Positions of the vertices, (n, 3) float32 [Å]."""
        return self._meshed("vertices")

    @property
    def faces(self):
        """Vertices of the triangles, counter-clockwise from outside, (m, 3) int32."""
        return self._meshed("faces")

    @property
    def normals(self):
        """Unit normals of the vertices, outward, (n, 3) float32."""
        return self._meshed("normals")

    @property
    def vertex_data(self):
        """All that the vertices have, by name: curvatures, chain_id, values. atom_id counts atoms of the file."""
        return self._core.vertex_data

    @property
    def curvature(self):
        """Mean curvature of the vertices, positive where convex, (n,) float32 [1/Å]."""
        return self._core.vertex_data["mean_curvature"]

    @property
    def gaussian_curvature(self):
        """Gaussian curvature of the vertices, (n,) float32 [1/Å²]."""
        return self._core.vertex_data["gaussian_curvature"]

    @property
    def shape_index(self):
        """Koenderink's shape index of the vertices, 1 for a cap and -1 for a cup, (n,) float64."""
        mean, gauss = np.float64(self.curvature), np.float64(self.gaussian_curvature)
        half = np.sqrt(np.maximum(mean * mean - gauss, 0.0))
        return 2 / np.pi * np.arctan2(mean, half)

    @property
    def principal_curvatures(self):
        """The larger and the smaller principal curvature of the vertices, (n, 2) float64 [1/Å]."""
        mean, gauss = np.float64(self.curvature), np.float64(self.gaussian_curvature)
        half = np.sqrt(np.maximum(mean * mean - gauss, 0.0))
        return np.stack([mean + half, mean - half], axis=1)

    @property
    def colors(self):
        """Red, green, blue of the vertices, (n, 3) uint8; empty without `color`."""
        return self._core.colors

    @property
    def atom(self):
        """The atom of each vertex, a place in the arrays of atoms, (n,) int32."""
        return self._core.atom

    @property
    def atom_areas(self):
        """The area of each atom's part of the surface, (atoms,) float64 [Å²]."""
        areas = self._core.atom_areas
        if len(areas) == 0:
            raise AttributeError("atom_areas: the surface was made without them [hint: atom_areas=True]")
        return areas

    @property
    def area(self):
        """Area of all walls, those of cavities too [Å²]."""
        return self._core.area

    @property
    def volume(self):
        """Volume inside, without the cavities [Å³]."""
        return self._core.volume

    @property
    def cavities(self):
        """Area and volume of each closed cavity, (k, 2) float64."""
        return self._core.cavities

    @property
    def contacts(self):
        """Contacts of atoms, by the probe of the surface; see contacts()."""
        return Contacts(*self._core.contacts())

    @property
    def pockets(self):
        """Table of the pockets, the largest first, of a surface that was made with pockets=True."""
        return self.table("pockets")

    @property
    def patches(self):
        """Table of the patches, the largest first, of a surface that was made with patches="hydrophobicity>0"."""
        return self.table("patches")

    @property
    def pore(self):
        """Table of the pore, a row for each section, of atoms that were read with pore="auto" or its ends."""
        return self.table("pore")

    @property
    def tunnels(self):
        """Table of the tunnels, a row for each place along them, of atoms that were read with tunnels_from="resid 57"."""
        return self.table("tunnels")

    @property
    def closed(self):
        """Whether every edge of the mesh has two triangles."""
        return self._core.closed

    @property
    def kind(self):
        """The kind of surface: "ses"."""
        return self._core.kind

    @property
    def report(self):
        """Everything that was measured, as a dict with the keys of a .json file."""
        return json.loads(self._core.report_text())

    def table(self, name, level="residue"):
        """A table as a dict of arrays: "atoms", "residues", "contacts", "interfaces", "pockets", "patches", "pore" or "tunnels".

        level: of contacts: "atom", "residue" or "chain".
        """
        names = ("atoms", "residues", "contacts", "interfaces", "pockets", "patches", "pore", "tunnels")
        levels = ("atom", "residue", "chain")
        if name not in names:
            raise ValueError(f"table: expected {', '.join(names)}, got '{str(name)[:40]}'")
        if level not in levels:
            raise ValueError(f"level: expected {', '.join(levels)}, got '{str(level)[:40]}'")
        return _arrays.texts(self._core.table(name, level))

    def forces(self, gamma=None, pressure=None, *, progress=None, threads=0):
        """Computes the force on each atom, -(gamma dA/dx + pressure dV/dx), with the area A and the volume V.

        gamma: energy per area, in your unit of energy per Å².
        pressure: energy per volume, in that unit per Å³. At least one of the two has to be given.
        progress: a function of stage and fraction; True shows a bar of tqdm.
        threads: threads at most; 0: all.

        Forces of ses, sas and vdw are in closed form, those of variational and smooth-sas of the mesh, by the shape
        derivative.

        Returns an array (atoms, 3) float64, in your unit of energy per Å.

        Raises TypeError without gamma and pressure, ValueError for numbers that are not finite, and OptionError for the
        kind gaussian, which has no forces. A warning counts atoms of variational beside gaps that were decided or
        beside ridges that were rounded: their forces are uncertain.
        """
        if gamma is None and pressure is None:
            raise TypeError("forces: expected gamma, energy per Å², or pressure, energy per Å³ [hint: forces(gamma=1)]")
        gamma, pressure = (0.0 if value is None else value for value in (gamma, pressure))
        for name, value in (("gamma", gamma), ("pressure", pressure)):
            if not np.isfinite(float(value)):
                raise ValueError(f"{name}: expected a finite number")
        volume, area, gaps, ridges = _called(self._core.gradients, progress=progress, threads=threads)
        for count, where in ((gaps, "gaps that the surface closes or opens"), (ridges, "ridges that the surface rounds")):
            if count:
                warnings.warn(f"forces: {count} atoms lie beside {where}; their forces leave out how rounding changes there and "
                              "can be wrong by their own size [hint: kind=\"ses\" is in closed form]", stacklevel=2)
        return -(float(gamma) * area + float(pressure) * volume)

    def sample(self, n, seed=None):
        """n points spread over the surface evenly by area, at random; a seed makes them the same again."""
        if isinstance(n, bool) or not isinstance(n, (int, np.integer)) or n < 0:
            raise ValueError("n: expected a whole number from 0 up")
        random = np.random.default_rng(seed)
        vertices, directions, triangles = _arrays.mesh(self.vertices, self.normals, self.faces)
        corners = vertices[triangles]
        areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
        if n > 0 and not areas.sum() > 0:
            raise ValueError("sample: expected triangles with an area, got none")
        ends = np.cumsum(areas)
        faces = np.searchsorted(ends, random.random(n) * (ends[-1] if len(ends) else 0), side="right")
        faces = np.minimum(faces, max(len(areas) - 1, 0)).astype(np.int32)
        u, v = np.sqrt(random.random(n)), random.random(n)
        weights = np.stack([1 - u, u * (1 - v), u * v], axis=1)[:, :, None]
        normals = (directions[triangles[faces]] * weights).sum(axis=1)
        normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
        return Samples((corners[faces] * weights).sum(axis=1), normals, faces)

    def distance(self, points, *, progress=None, threads=0):
        """Where points lie to the surface: signed distance (negative inside), closest point, normal there, nearest atom.

        Exact for kind sas and vdw; of the others see docs/accuracy.md.
        """
        return Distances(*_called(self._core.distance, _arrays.points(points, "points"), progress=progress,
                                  threads=threads))

    def to_trimesh(self):
        """Makes a trimesh.Trimesh of a copy of the mesh, with vertex normals, and vertex colours if there are any.

        Its `vertex_attributes` hold vertex_data: curvatures, atom_id and others, an array of n rows each; directions have
        three columns.

        Raises ImportError without the package trimesh, AttributeError for a surface without a mesh.
        """
        import trimesh
        mesh = trimesh.Trimesh(self.vertices.copy(), self.faces.copy(), vertex_normals=self.normals.copy(), process=False,
                               vertex_colors=self.colors.copy() if len(self.colors) else None)
        mesh.vertex_attributes.update(_attributes(self.vertex_data))
        return mesh

    def to_pyvista(self):
        """Makes a pyvista.PolyData of a copy of the mesh, whose `point_data` holds vertex_data, Normals and RGB.

        Directions are vectors (n, 3), as for `mesh.glyph(orient="principal_direction_1", scale=False)`.

        Raises ImportError without the package pyvista, AttributeError for a surface without a mesh.
        """
        import pyvista
        faces = np.insert(self.faces, 0, 3, axis=1).ravel()
        mesh = pyvista.PolyData(self.vertices.copy(), faces)
        for name, values in _attributes(self.vertex_data).items():
            mesh.point_data[name] = values
        mesh.point_data["Normals"] = self.normals.copy()
        if len(self.colors):
            mesh.point_data["RGB"] = self.colors.copy()
        return mesh

    def voxels(self):
        """The voxels of the level set, about three on either side of the surface, and their signed distances."""
        return Voxels(*self._core.voxels())

    def save(self, path, *, replace=True, panels=None, pieces=None, sharp_colors=False, center=False, print_scale=None, label=(), ruler=(),
             show=None, scene=None, turntable=None, fps=None, contacts=None, **look):
        """Writes the file that the command writes under the same name; how the name ends says what.

        It is a mesh (.ply, .obj, .stl, .glb, .usda, ...), the grids (.vdb, .nvdb) or the level set in a box (.mrc, .dx), a report
        (.json), a picture (.png), film (.mp4, .webm, .gif), page (.html), legend (.legend.svg) or view (.view), a script for
        ChimeraX or PyMOL that opens the mesh of that name (.cxc: .glb, .pml: .ply), a table (.atoms.csv, .residues.csv, ...), or
        atoms with their areas (.pdb, .cif). Tables and areas need a surface that was made with them, as atom_areas=True.

        panels: further surfaces of pictures, films and pages, as of picture().
        pieces: closed pieces that meshes, pictures and pages have: "all", "outer" or "cavities".
        sharp_colors: cuts the triangles of a mesh file where colours meet.
        center: moves the middle of the surface to the origin, in meshes and .vdb.
        print_scale: .stl, .obj, .wrl and .3mf are in mm, at this many mm per Å.
        label: texts of a picture, as of picture().
        ruler: lines of a picture, as of picture().
        show: atoms of a picture, as of picture().
        scene: the program that a .vdb, .glb or .usda is for, as of to_vdb().
        turntable: number of pictures round the upright: name.0001.png, ..., or those of a film, 36 without it.
        fps: pictures of a film per second; None: 25.
        contacts: level of a .contacts.csv, "atom", "residue" or "chain"; None: "residue".
        look: further keywords of picture(): width, view, background and others.

        Raises OptionError if the name ends otherwise, or if the file does not show what was asked or needs what the surface
        was made without; OutputError if it cannot be written.
        """
        look = _options.today({"pieces": pieces, "sharp_colors": sharp_colors, **look})
        unknown = sorted(set(look) - set(LOOK))
        if unknown:
            raise TypeError(f"save() got an unexpected keyword argument '{unknown[0]}'")
        if look.get("zoom") is not None:
            look["zoom"] = self._places("zoom", look["zoom"])
        given = {"center": center, "print-scale": print_scale, "for": scene, "turntable": turntable,
                 "fps": fps, "contacts": contacts, **{LOOK[name]: value for name, value in look.items()}}
        self._save(path, replace, given, panels, show, self._notes(label, ruler))

    def _save(self, path, replace, options, panels=None, show=None, more=()):
        """Writes a file with options of the command line, those that are not None or False; messages name Python's keywords."""
        settings = [(name, _word(name, value)) for name, value in options.items() if value is not None and value is not False]
        name, others = _named(self, panels)
        try:
            self._core.save(os.fspath(path), bool(replace), [*settings, *more], (name, others, _shown(show)))
        except _core.OptionError as error:
            words = str(error)
            for ours, theirs in (("`size`", "width"), ("`for`", "scene"), ("`ball_areas`", "atom_areas=True")):
                words = words.replace(ours, theirs)
            raise type(error)(words) from None
        except _core.OutputError as error:
            raise type(error)(str(error).replace("`force` replaces it", "replace=True replaces it")) from None

    def to_vdb(self, path, scene=None, *, replace=True, center=False, fog_density=None, ids=None, one_box=False, mips=None):
        """Writes the grids as a .vdb for "blender", "blender4", "houdini", "usd", "unreal" or "arnold", perhaps with "=SCALE"; None: in Å, as they are.

        They are the level set and those of `fields`: Blender shows a fog, which is fields="density".

        center: moves the middle of the surface to the origin.
        fog_density: optical depth of an Å of fog at density 1 in the program; without it values of density are 0 to 1.
        ids: "float" for readers without int32: the type of atom_id, chain_id, group_id and pocket_id; None: "int".
        one_box: gives all grids one box of active voxels.
        mips: coarser levels of density and Cd, 0 to 10: density_level_0, density_level_1, ..., each with voxels twice as large.
        """
        path = os.fspath(path)
        if not path.endswith(".vdb"):
            raise ValueError("to_vdb: expected a name that ends in .vdb")
        self._save(path, replace, {"for": scene, "center": center, "fog-density": fog_density, "ids": ids,
                                    "one-box": one_box, "mips": mips})

    def to_apbs(self, folder, *, apbs_grid=None, pdie=2.0, sdie=78.54, ion_conc=0.0, replace=True):
        """Writes the files of a calculation of APBS with this surface into a folder, which is made: maps, charges, apbs.in.

        The atoms are of a file with charges and radii, such as a .pqr: read(path, charges=True). A surface of another
        kind than "ses", or one that matches it, has another energy, which a warning says.

        apbs_grid: an input of APBS whose dime, glen and gcent are used; without it the lattice is by pdb2pqr's rule psize.
        pdie, sdie: relative permittivity of the molecule and of the solvent.
        ion_conc: concentration of a 1:1 salt [mol/L].
        """
        self._save(folder, replace, {"for": "apbs", "apbs-grid": apbs_grid, "pdie": float(pdie), "sdie": float(sdie),
                                     "ion-conc": float(ion_conc)})
        if self.kind != "ses" and not any(name == "match" for name, _ in self._made[0]):
            warnings.warn(f"to_apbs: a surface of kind {self.kind} has another energy than the solvent-excluded one "
                          "[hint: kind=\"ses\", or match=\"ses\"]", stacklevel=2)

    def to_tomogram(self, path, pixel_size, *, box_size=None, mask_extend=0.0, mask_edge=3.0, invert_density=False,
                    replace=True):
        """Writes a template (.density.mrc) or a soft mask (.mask.mrc) for RELION, pytom-match-pick and cryoCAT.

        Both have the same pixels: those of a cube whose pixel N/2 is the centre of the atoms, weighted by their atomic
        numbers. The density is that of ChimeraX's molmap at the resolution of read() or surface(), or three pixels.

        pixel_size: edge of a pixel [Å], 0.1 to 100.
        box_size: pixels on an edge, even; None: the least that holds density and mask.
        mask_extend: pixels outside of the surface up to which the mask is 1.
        mask_edge: pixels over which it falls to 0, by a cosine.
        invert_density: makes the density negative, as matter is in tomograms.

        Raises OptionError for another ending, InputError if the box does not hold the molecule.
        """
        path = os.fspath(path)
        if not path.endswith((".density.mrc", ".mask.mrc")):
            raise _core.OptionError("to_tomogram: expected a name that ends in .density.mrc or .mask.mrc")
        given = {"pixel-size": float(pixel_size), "box-size": box_size}
        if path.endswith(".density.mrc"):
            given["invert-density"] = invert_density
        else:
            given.update({"mask-extend": float(mask_extend), "mask-edge": float(mask_edge)})
        self._save(path, replace, given)

    def view(self, height=480, panels=None):
        """The page of save("name.html") as what a notebook shows: a surface to turn, with its colours and atoms."""
        return Page(self, int(height), panels)

    def _repr_html_(self):
        rows = [("kind", self.kind), ("area", f"{self.area:.2f} Å²"), ("volume", f"{self.volume:.2f} Å³"),
                ("vertices", f"{len(self._core.vertices)}"), ("faces", f"{len(self._core.faces)}")]
        return "<table>" + "".join(f"<tr><th>{name}</th><td>{value}</td></tr>" for name, value in rows) + "</table>"

    def picture(self, path, width=1200, *, replace=True, view=None, up=None, turn=None, background=None, plain_color=None,
                style=None, opacity=None, show_behind=False, clip=None, zoom=None, depth_cue=False, legend=None, scale_bar=False, dpi=None,
                pieces=None, label=(), ruler=(), show=None, panels=None, **look):
        """Draws the surface into a .png of so many pixels.

        The keywords are the command line's options of pictures. `view` and `up` are directions (x, y, z), toward the
        eye and upward; `view` may be the path of a .view, too. `turn` is in degrees, `clip` in Å. None: the default.

        zoom: atoms that fill the frame, a selection as "resid 5-9", or their places (n, 3) [Å].
        label: texts at places in Å or at atoms, as [((x, y, z), "active site"), ("resid 5", "gate")]; a selection alone, as
        "resid 5", has the name of its first residue.
        ruler: lines between places or atoms with their length, as [((x, y, z), "resid 5")].
        show: atoms beside the surface, as {"sticks": molecule}, with the words of the command line. Bonds are those of
        dictionaries and distances. Panels of the same molecule show them, too.
        panels: further surfaces in the same scale of length: a list, or a dict by their names, in which "" may have the
        name of this one, as {"": "smooth", "SES": ses}. Colours of other values have a legend of their own.
        """
        path = os.fspath(path)
        if not path.endswith(".png"):
            raise ValueError("picture: expected a name that ends in .png")
        self.save(path, replace=replace, panels=panels, pieces=pieces, label=label, ruler=ruler, show=show, width=int(width), view=view,
                  up=up, turn=turn, background=background, plain_color=plain_color, style=style, opacity=opacity,
                  show_behind=show_behind, clip=clip, zoom=zoom, depth_cue=depth_cue, legend=legend, scale_bar=scale_bar, dpi=dpi, **look)

    def _at(self, keyword, place):
        """A place, or the middle of a selection, as it is typed, and what is there."""
        if not isinstance(place, str):
            return _place(keyword, place), ""
        middle, residue = self._core.place(place)
        return _place(keyword, middle), residue

    def _places(self, keyword, places):
        """Places, or those of a selection's atoms, as they are typed."""
        if isinstance(places, str):
            places = self._core.places(places)
        rows = _arrays.numbers(places, keyword)
        if rows.ndim not in (1, 2) or rows.shape[-1] != 3 or rows.size == 0:
            raise ValueError(f"{keyword}: expected a selection or places (n, 3), got an array {rows.shape}")
        return ";".join(_place(keyword, row) for row in rows.reshape(-1, 3))

    def _notes(self, label, ruler):
        """Labels and rulers as options."""
        notes = []
        for place, text in _pairs("label", "place and text", [label] if isinstance(label, str) else label):
            at, residue = self._at("label", place)
            notes.append(("label", f"{at}={residue if text is None else text}"))
        for ends in _pairs("ruler", "places", ruler):
            notes.append(("ruler", "..".join(self._at("ruler", end)[0] for end in ends)))
        return notes


class Page:
    """A surface that a notebook shows and that can be turned there: what Surface.view() makes."""

    def __init__(self, surface, height, panels=None):
        self._height = height
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "surface.html")
            surface.save(path, panels=panels)
            with open(path, encoding="utf-8") as file:
                self.html = file.read()

    def __repr__(self):
        return f"<Page: {len(self.html)} letters of HTML>"

    def _repr_html_(self):
        return (f'<iframe srcdoc="{html.escape(self.html)}" sandbox="allow-scripts allow-downloads" '
                f'style="width: 100%; height: {self._height}px; border: 0"></iframe>')


def _unpickled(state, made):
    return Surface(_core.unpack_surface(state, *made), made)


def surface(positions, radii, **options):
    """Makes the surface of balls.

    positions: centres, (n, 3), of any numeric type [Å]. A warning names coordinates that look like nanometres.
    radii: (n,), or one number for all [Å].

    Returns a Surface: vertices (v, 3) and normals (v, 3) float32 [Å], faces (f, 3) int32, area [Å²], volume [Å³],
    curvatures of the vertices [1/Å] and atom_areas (n,) float64 [Å²].

    Raises TypeError for an unknown keyword or a wrong type, OptionError (a ValueError) for a value out of range, InputError
    for positions or radii that are not finite, NumericError if the time or memory of max_hours is exceeded, CheckError if
    the result fails its own checks. A result that is not at rest is a warning.

    Keywords:
    """
    options, extra, areas_of, how = _split(options)
    made = _made(_options.given(options, "surface", _options.MORE), extra, areas_of)
    for name, values in made[0]:
        if name == "color" and _options.of_file(values[0], ("none", "mean-curvature", "gaussian-curvature")):
            raise ValueError(f"color: '{values[0][:40]}' needs atoms of a file [hint: read()]")
    x, r = _arrays.balls(positions, radii)
    core = _called(_core.surface, x, r, *made, **how)
    for text in core.warnings:
        if "nanometres" in text: # the others are in report["warnings"]
            warnings.warn(f"surface: {text}", stacklevel=2)
    return Surface(core, made)


surface.__doc__ = surface.__doc__.rstrip() + "\n" + _options.documented("surface") + "\n"


def _probe(probe):
    if isinstance(probe, bool) or not isinstance(probe, (int, float, np.number)):
        raise TypeError(f"probe: expected float, got {type(probe).__name__}")
    if not 0 <= probe <= 100:
        raise ValueError(f"probe: expected 0 to 100 Å, got {float(probe):g}")
    return float(probe)


def areas(positions, radii, probe=1.4, *, progress=None, threads=0):
    """Measures the area of each ball of radius r + probe that no other ball covers, in closed form.

    positions: centres, (n, 3) [Å].
    radii: (n,), or one number for all [Å].
    probe: its radius, 0 to 100 [Å]; 0 gives the van der Waals area, else it is the solvent-accessible area.
    progress: a function of stage and fraction; True shows a bar of tqdm.
    threads: threads at most; 0: all.

    Returns an array (n,) float64 [Å²], whose sum is the area of the union.

    Raises TypeError or ValueError for wrong arguments, InputError for numbers that are not finite.
    """
    return _called(_core.areas, *_arrays.balls(positions, radii), _probe(probe), progress=progress, threads=threads)


def contacts(positions, radii, probe=1.4, *, progress=None, threads=0):
    """The contacts between balls of radius r + probe: facets of their power diagram, in closed form."""
    return Contacts(*_called(_core.contacts, *_arrays.balls(positions, radii), _probe(probe), progress=progress,
                             threads=threads))


def _mesh(of, name):
    """Vertices and faces of a surface, a file, or a pair of arrays."""
    if isinstance(of, (str, os.PathLike)):
        return _core.read_mesh(os.fspath(of))
    pair = (of.vertices, of.faces) if hasattr(of, "vertices") and hasattr(of, "faces") else of
    if not isinstance(pair, (tuple, list)) or len(pair) != 2:
        raise TypeError(f"{name}: expected a surface, a path or (vertices, faces), got {type(of).__name__}")
    faces = _arrays.faces(pair[1], name)
    return np.ascontiguousarray(_arrays.points(pair[0], name), dtype=np.float32), faces


def compare(a, b, *, progress=None, threads=0):
    """How far two surfaces are from each other: each a Surface, a file .ply .obj .stl, or (vertices, faces)."""
    return Comparison(*_called(_core.compare, *_mesh(a, "a"), *_mesh(b, "b"), progress=progress, threads=threads))
