#!/usr/bin/env python3
# SPDX-License-Identifier: MPL-2.0
"""Prints the type hints of the package, python/vdb_molsurf/__init__.pyi, whose keywords come from the module's table:

    python -P python/stubs.py > python/vdb_molsurf/__init__.pyi
"""

import textwrap

from vdb_molsurf import _options

HEAD = '''\
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
'''

ARRAYS = {"vertices": "float32", "normals": "float32", "faces": "int32", "curvature": "float32",
          "gaussian_curvature": "float32", "shape_index": "float64", "principal_curvatures": "float64",
          "colors": "uint8", "atom": "int32", "atom_areas": "float64", "cavities": "float64"}
PLAIN = {"vertex_data": "dict[str, NDArray[Any]]", "contacts": "Contacts",
         "pockets": "dict[str, NDArray[Any]]", "patches": "dict[str, NDArray[Any]]", "pore": "dict[str, NDArray[Any]]",
         "tunnels": "dict[str, NDArray[Any]]", "area": "float", "volume": "float",
         "closed": "bool", "kind": "str", "report": "dict[str, Any]"}
OF_ATOMS = {"positions": "float64", "radii": "float64", "name": "str_", "element": "int32", "residue": "str_",
            "residue_number": "int32", "insertion_code": "str_", "residue_index": "int32", "chain": "str_",
            "altloc": "str_", "atom_id": "int32"}
OF_MOLECULES = {"copies": "int", "groups": "list[str]", "warnings": "list[str]"}

METHODS = '''\
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
'''

FUNCTIONS = '''\
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
'''


def type_of(row):
    """The type of a keyword; words are spelt out."""
    if row["type"] == "word":
        return "Literal[" + ", ".join(f'"{word}"' for word in row["words"]) + "]"
    return _options.TYPES[row["type"]]


def default_of(row):
    """What a keyword is unless it is given, as far as one value says that."""
    value = row["default"]
    if row["type"] == "switch":
        return "False"
    if row["type"] == "number" and isinstance(value, float):
        return repr(value)
    if row["type"] == "word" and value in row["words"]:
        return f'"{value}"'
    return "..."


def keywords(where):
    """The keywords of a function, as lines."""
    lines = [f"{name}: {type_of(row)} = {default_of(row)}," for name, row in _options.KEYWORDS.items()
             if where == "read" or row["of"] in _options.TAKEN[where]]
    more = {"groups": _options.GROUPS, **{name: _options.MORE[name] for name in ("threads", "progress")}}
    lines += [f"{name}: {kind} = {preset}," for name, (kind, preset, _) in
              (more if where == "read" else _options.MORE).items()]
    return lines


def function(name, first, where, result):
    """A function with all keywords."""
    return f"def {name}({first}, *,\n" + textwrap.indent("\n".join(keywords(where)), "    ") + f"\n) -> {result}: ...\n"


def properties(types, shape="NDArray[np.{}]"):
    return "".join(f"    @property\n    def {name}(self) -> {shape.format(kind)}: ...\n" for name, kind in types.items())


def main():
    print(HEAD + properties(ARRAYS) + properties(PLAIN, "{}") + METHODS)
    print("class Molecule:\n    def __len__(self) -> int: ...\n" + properties(OF_ATOMS) + properties(OF_MOLECULES, "{}") +
          "    def superpose(self, onto: Molecule, names: Sequence[str] = ...) -> float: ...\n" +
          "    def select(self, selection: str) -> Selection: ...\n" +
          textwrap.indent(function("surface", "self", "molecule", "Surface"), "    "))
    print("class Selection:\n    molecule: Molecule\n    indices: NDArray[np.int32]\n    count: int\n"
          "    mask: NDArray[np.bool_]\n    positions: NDArray[np.float64]\n    def __len__(self) -> int: ...")
    print(function("surface", "positions: ArrayLike, radii: ArrayLike", "surface", "Surface"))
    print(function("read", "source: Path | bytes | bytearray | memoryview | TextIO | BinaryIO", "read", "Molecule"))
    print(FUNCTIONS, end="")


if __name__ == "__main__":
    main()
