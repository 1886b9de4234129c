# SPDX-License-Identifier: MPL-2.0
# python/stubs.py makes this file out of the table of settings.
from collections.abc import Callable, Iterator, Mapping, Sequence
from os import PathLike
from types import ModuleType
from typing import Any, BinaryIO, Literal, NamedTuple, TextIO, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

__version__: str
biopython: ModuleType
mdanalysis: ModuleType
mdtraj: ModuleType

Path = Union[str, PathLike[str]]
MeshLike = Union[Surface, Path, tuple[ArrayLike, ArrayLike]]
Pieces = Literal["all", "outer", "cavities", None]
Labels = Union[str, Sequence[Union[str, tuple[Union[str, ArrayLike], str]]]]
Rulers = Sequence[tuple[Union[str, ArrayLike], Union[str, ArrayLike]]]
Panels = Union[Sequence[Surface], Mapping[str, Union[Surface, str]], None]

class OptionError(ValueError):
    may_pass: bool
class InputError(ValueError):
    may_pass: bool
class NumericError(ArithmeticError):
    may_pass: bool
class OutputError(OSError):
    may_pass: bool
class CheckError(RuntimeError):
    may_pass: bool

class Distances(NamedTuple):
    distance: NDArray[np.float64]
    closest: NDArray[np.float64]
    normal: NDArray[np.float64]
    atom: NDArray[np.int32]

class Contacts(NamedTuple):
    pairs: NDArray[np.int32]
    area: NDArray[np.float64]
    distance: NDArray[np.float64]

class Voxels(NamedTuple):
    coordinates: NDArray[np.int32]
    values: NDArray[np.float32]
    edge: float
    origin: tuple[float, float, float]

class Samples(NamedTuple):
    points: NDArray[np.float64]
    normals: NDArray[np.float64]
    faces: NDArray[np.int32]

class Shard(NamedTuple):
    number: int
    items: list[Any]

class Comparison(NamedTuple):
    hausdorff: float
    a_to_b: dict[str, Any]
    b_to_a: dict[str, Any]

class Page:
    html: str

class Surface:
    @property
    def vertices(self) -> NDArray[np.float32]: ...
    @property
    def normals(self) -> NDArray[np.float32]: ...
    @property
    def faces(self) -> NDArray[np.int32]: ...
    @property
    def curvature(self) -> NDArray[np.float32]: ...
    @property
    def gaussian_curvature(self) -> NDArray[np.float32]: ...
    @property
    def shape_index(self) -> NDArray[np.float64]: ...
    @property
    def principal_curvatures(self) -> NDArray[np.float64]: ...
    @property
    def colors(self) -> NDArray[np.uint8]: ...
    @property
    def atom(self) -> NDArray[np.int32]: ...
    @property
    def atom_areas(self) -> NDArray[np.float64]: ...
    @property
    def cavities(self) -> NDArray[np.float64]: ...
    @property
    def vertex_data(self) -> dict[str, NDArray[Any]]: ...
    @property
    def contacts(self) -> Contacts: ...
    @property
    def pockets(self) -> dict[str, NDArray[Any]]: ...
    @property
    def patches(self) -> dict[str, NDArray[Any]]: ...
    @property
    def pore(self) -> dict[str, NDArray[Any]]: ...
    @property
    def tunnels(self) -> dict[str, NDArray[Any]]: ...
    @property
    def area(self) -> float: ...
    @property
    def volume(self) -> float: ...
    @property
    def closed(self) -> bool: ...
    @property
    def kind(self) -> str: ...
    @property
    def report(self) -> dict[str, Any]: ...
    def table(self, name: Literal["atoms", "residues", "contacts", "interfaces", "pockets", "patches", "pore", "tunnels"],
              level: Literal["atom", "residue", "chain"] = "residue") -> dict[str, NDArray[Any]]: ...
    def forces(self, gamma: float | None = None, pressure: float | None = None, *,
               progress: Callable[[str, float], object] | bool | None = None, threads: int = 0) -> NDArray[np.float64]: ...
    def sample(self, n: int, seed: int | None = None) -> Samples: ...
    def distance(self, points: ArrayLike, *, progress: Callable[[str, float], object] | bool | None = None,
                 threads: int = 0) -> Distances: ...
    def to_trimesh(self) -> Any: ...
    def to_pyvista(self) -> Any: ...
    def voxels(self) -> Voxels: ...
    def save(self, path: Path, *, replace: bool = True, panels: Panels = None, pieces: Pieces = None, sharp_colors: bool = False,
             center: bool = False, print_scale: float | None = None, label: Labels = (), ruler: Rulers = (),
             show: Mapping[str, Molecule] | None = None, scene: str | None = None, turntable: int | None = None,
             fps: float | None = None, contacts: Literal["atom", "residue", "chain"] | None = None, width: int | None = None,
             view: ArrayLike | Path | None = None, up: ArrayLike | None = None, turn: float | None = None,
             background: str | None = None, plain_color: str | None = None, style: str | None = None,
             opacity: float | None = None, show_behind: bool = False, clip: float | None = None, zoom: ArrayLike | str | None = None, depth_cue: bool = False,
             legend: Literal["auto", "on", "off"] | None = None, scale_bar: bool = False, dpi: float | None = None) -> None: ...
    def to_vdb(self, path: Path, scene: str | None = None, *, replace: bool = True, center: bool = False,
               fog_density: float | None = None, ids: Literal["int", "float"] | None = None, one_box: bool = False,
               mips: int | None = None) -> None: ...
    def to_apbs(self, folder: Path, *, apbs_grid: Path | None = None, pdie: float = 2.0, sdie: float = 78.54,
                ion_conc: float = 0.0, replace: bool = True) -> None: ...
    def to_tomogram(self, path: Path, pixel_size: float, *, box_size: int | None = None, mask_extend: float = 0.0,
                    mask_edge: float = 3.0, invert_density: bool = False, replace: bool = True) -> None: ...
    def view(self, height: int = 480, panels: Panels = None) -> Page: ...
    def picture(self, path: Path, width: int = 1200, *, replace: bool = True, view: ArrayLike | Path | None = None,
                up: ArrayLike | None = None, turn: float | None = None, background: str | None = None, plain_color: str | None = None,
                style: str | None = None, opacity: float | None = None, show_behind: bool = False, clip: float | None = None, zoom: ArrayLike | str | None = None,
                depth_cue: bool = False, legend: Literal["auto", "on", "off"] | None = None, scale_bar: bool = False,
                dpi: float | None = None, pieces: Pieces = None,
                label: Labels = (), ruler: Rulers = (),
                show: Mapping[str, Molecule] | None = None, panels: Panels = None) -> None: ...

class Molecule:
    def __len__(self) -> int: ...
    @property
    def positions(self) -> NDArray[np.float64]: ...
    @property
    def radii(self) -> NDArray[np.float64]: ...
    @property
    def name(self) -> NDArray[np.str_]: ...
    @property
    def element(self) -> NDArray[np.int32]: ...
    @property
    def residue(self) -> NDArray[np.str_]: ...
    @property
    def residue_number(self) -> NDArray[np.int32]: ...
    @property
    def insertion_code(self) -> NDArray[np.str_]: ...
    @property
    def residue_index(self) -> NDArray[np.int32]: ...
    @property
    def chain(self) -> NDArray[np.str_]: ...
    @property
    def altloc(self) -> NDArray[np.str_]: ...
    @property
    def atom_id(self) -> NDArray[np.int32]: ...
    @property
    def copies(self) -> int: ...
    @property
    def groups(self) -> list[str]: ...
    @property
    def warnings(self) -> list[str]: ...
    def superpose(self, onto: Molecule, names: Sequence[str] = ...) -> float: ...
    def select(self, selection: str) -> Selection: ...
    def surface(self, *,
        charges: bool = False,
        kind: Literal["variational", "ses", "sas", "vdw", "gaussian", "smooth-sas"] = "variational",
        voxel: float = 0.5,
        probe: float = 1.4,
        blobbiness: float = 2.3,
        fill_cavities: bool = False,
        min_thickness: float = 0.0,
        fields: str | Sequence[object] = ...,
        vdb_half: bool = False,
        curvature_totals: bool = False,
        measures: str | Sequence[object] = ...,
        remesh: float = ...,
        density: float = ...,
        adapt: float = ...,
        epsilon: float = 0.5,
        match: Literal["none", "ses"] = "none",
        match_volume: bool = False,
        group_by: str = ...,
        split: Literal["group"] = ...,
        surface_of: str | float | Sequence[str | float] = ...,
        interfaces: bool = False,
        color: str = ...,
        patches: str = ...,
        range: str | Sequence[object] = ...,
        palette: Literal["viridis", "cividis", "batlow", "OrRd", "RdBu", "BuRd", "OrPu", "turbo", "plddt"] = ...,
        value_of: Literal["atom", "residue"] = "atom",
        flat_values: bool = False,
        potential_offset: float = ...,
        smooth_colors: float = ...,
        pocket_at: str = ...,
        pore: str = ...,
        tunnels_from: str = ...,
        tunnel_probe: float = 0.9,
        pockets: bool = False,
        probe_in: float = 1.4,
        probe_out: float = 4.0,
        pocket_cut: float = 2.4,
        pocket_neck: float = 0.55,
        lambda_: float = 0.01,
        regularizer: Literal["gradient", "area"] = "gradient",
        flow: Literal["rest", "newton", "paper"] = "rest",
        max_steps: int = ...,
        steps: int = ...,
        tolerance: float = 0.01,
        spline_level: int = ...,
        atom_areas: bool = True,
        areas_of: str = "",
        grid: bool = True,
        threads: int = 0,
        progress: Callable[[str, float], object] | bool | None = None,
    ) -> Surface: ...

class Selection:
    molecule: Molecule
    indices: NDArray[np.int32]
    count: int
    mask: NDArray[np.bool_]
    positions: NDArray[np.float64]
    def __len__(self) -> int: ...
def surface(positions: ArrayLike, radii: ArrayLike, *,
    kind: Literal["variational", "ses", "sas", "vdw", "gaussian", "smooth-sas"] = "variational",
    voxel: float = 0.5,
    probe: float = 1.4,
    blobbiness: float = 2.3,
    fill_cavities: bool = False,
    min_thickness: float = 0.0,
    fields: str | Sequence[object] = ...,
    vdb_half: bool = False,
    curvature_totals: bool = False,
    measures: str | Sequence[object] = ...,
    remesh: float = ...,
    density: float = ...,
    adapt: float = ...,
    epsilon: float = 0.5,
    match: Literal["none", "ses"] = "none",
    match_volume: bool = False,
    split: Literal["group"] = ...,
    surface_of: str | float | Sequence[str | float] = ...,
    interfaces: bool = False,
    color: str = ...,
    smooth_colors: float = ...,
    tunnel_probe: float = 0.9,
    pockets: bool = False,
    probe_in: float = 1.4,
    probe_out: float = 4.0,
    pocket_cut: float = 2.4,
    pocket_neck: float = 0.55,
    lambda_: float = 0.01,
    regularizer: Literal["gradient", "area"] = "gradient",
    flow: Literal["rest", "newton", "paper"] = "rest",
    max_steps: int = ...,
    steps: int = ...,
    tolerance: float = 0.01,
    spline_level: int = ...,
    atom_areas: bool = True,
    areas_of: str = "",
    grid: bool = True,
    threads: int = 0,
    progress: Callable[[str, float], object] | bool | None = None,
) -> Surface: ...

def read(source: Path | bytes | bytearray | memoryview | TextIO | BinaryIO, *,
    select: str = ...,
    model: int = ...,
    assembly: str = ...,
    instances: bool = False,
    by_symmetry: bool = False,
    copies: str = ...,
    altloc: str = ...,
    no_hydrogens: bool = False,
    ions: bool = False,
    hetero: bool = False,
    no_hetero: bool = False,
    waters: bool = False,
    charges: bool = False,
    radii: str = ...,
    max_input: str = ...,
    kind: Literal["variational", "ses", "sas", "vdw", "gaussian", "smooth-sas"] = "variational",
    voxel: float = 0.5,
    probe: float = 1.4,
    blobbiness: float = 2.3,
    fill_cavities: bool = False,
    min_thickness: float = 0.0,
    fields: str | Sequence[object] = ...,
    vdb_half: bool = False,
    curvature_totals: bool = False,
    measures: str | Sequence[object] = ...,
    remesh: float = ...,
    density: float = ...,
    adapt: float = ...,
    epsilon: float = 0.5,
    match: Literal["none", "ses"] = "none",
    resolution: str | float | Sequence[str | float] = ...,
    coarse: str | float | Sequence[str | float] = ...,
    match_volume: bool = False,
    group_by: str = ...,
    split: Literal["group"] = ...,
    surface_of: str | float | Sequence[str | float] = ...,
    interfaces: bool = False,
    color: str = ...,
    patches: str = ...,
    range: str | Sequence[object] = ...,
    palette: Literal["viridis", "cividis", "batlow", "OrRd", "RdBu", "BuRd", "OrPu", "turbo", "plddt"] = ...,
    value_of: Literal["atom", "residue"] = "atom",
    flat_values: bool = False,
    potential_offset: float = ...,
    smooth_colors: float = ...,
    pocket_at: str = ...,
    pore: str = ...,
    tunnels_from: str = ...,
    tunnel_probe: float = 0.9,
    pockets: bool = False,
    probe_in: float = 1.4,
    probe_out: float = 4.0,
    pocket_cut: float = 2.4,
    pocket_neck: float = 0.55,
    lambda_: float = 0.01,
    regularizer: Literal["gradient", "area"] = "gradient",
    flow: Literal["rest", "newton", "paper"] = "rest",
    max_steps: int = ...,
    steps: int = ...,
    tolerance: float = 0.01,
    spline_level: int = ...,
    groups: Mapping[str, str] | None = None,
    threads: int = 0,
    progress: Callable[[str, float], object] | bool | None = None,
) -> Molecule: ...

def areas(positions: ArrayLike, radii: ArrayLike, probe: float = 1.4, *,
          progress: Callable[[str, float], object] | bool | None = None, threads: int = 0) -> NDArray[np.float64]: ...
def contacts(positions: ArrayLike, radii: ArrayLike, probe: float = 1.4, *,
             progress: Callable[[str, float], object] | bool | None = None, threads: int = 0) -> Contacts: ...
def compare(a: MeshLike, b: MeshLike, *, progress: Callable[[str, float], object] | bool | None = None,
            threads: int = 0) -> Comparison: ...
def shards(sources: object, size: int = 100) -> Iterator[Shard]: ...
def measure(shard: Shard | tuple[int, list[Any]], function: Callable[[Surface], Mapping[str, Any]] | None = None,
            folder: Path | None = None, *, format: Literal["parquet", "csv"] = "parquet",
            memory: int | str | None = None, max_hours: float | None = None, **options: Any) -> list[dict[str, Any]]: ...
def map(sources: object, function: Callable[[Surface], Mapping[str, Any]] | None = None, workers: int | None = None,
        size: int = 100, folder: Path | None = None, *, format: Literal["parquet", "csv"] = "parquet",
        memory: int | str | None = None, max_hours: float | None = None, **options: Any) -> Iterator[dict[str, Any]]: ...
def radii(names: Sequence[str] | NDArray[Any], residues: Sequence[str] | NDArray[Any] | None = None,
          elements: Sequence[str] | NDArray[Any] | None = None, set: str = "bondi") -> NDArray[np.float64]: ...
