# SPDX-License-Identifier: MPL-2.0
"""Arguments as arrays of the type that the module takes. Errors say type or shape, never the values."""

import itertools

import numpy as np


def _refuse_masked(values, name):
    """Refuses masked entries, in lists of arrays too: NumPy takes what lies under a mask for data."""
    parts = [values]
    while parts:
        kinds = set(map(type, parts))  # few, of many parts
        if any(issubclass(kind, np.ma.MaskedArray) for kind in kinds) and any(map(np.ma.is_masked, parts)):
            raise ValueError(f"{name}: expected no masked entries, got some")
        if not any(issubclass(kind, (list, tuple)) for kind in kinds):
            return
        parts = list(itertools.chain.from_iterable(part for part in parts if isinstance(part, (list, tuple))))


def numbers(values, name):
    """An array of float64, of whatever shape."""
    if isinstance(values, (str, bytes)):
        raise TypeError(f"{name}: expected numbers, got {type(values).__name__}")
    try:
        array = np.asarray(values)
    except ValueError:
        raise TypeError(f"{name}: expected numbers, got a ragged {type(values).__name__}") from None
    except TypeError:
        raise TypeError(f"{name}: expected numbers, got {type(values).__name__}") from None
    if array.dtype.kind not in "fiu" and array.size > 0:
        kind = "complex numbers" if array.dtype.kind == "c" else array.dtype.name
        raise TypeError(f"{name}: expected numbers, got " +
                        (f"an array of {kind}" if hasattr(values, "dtype") else f"a {type(values).__name__} of {kind}"))
    _refuse_masked(values, name)
    return np.asarray(array, dtype=np.float64, order="C")


def points(values, name):
    """An array of float64 of shape (n, 3)."""
    array = numbers(values, name)
    if array.size == 0 and array.ndim < 2:
        array = array.reshape(0, 3)
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError(f"{name}: expected shape (n, 3), got {array.shape}")
    return array


def faces(values, name):
    """Triangles as an array of int32 of shape (m, 3)."""
    array = np.asarray(values)
    if array.dtype.kind not in "iu" or array.ndim != 2 or array.shape[1] != 3:
        raise ValueError(f"{name}: expected faces of whole numbers, (m, 3), got {array.dtype} {array.shape}")
    _refuse_masked(values, name)
    if len(array) and not (0 <= int(array.min()) and int(array.max()) < 2**31):
        raise ValueError(f"{name}: expected faces from 0 to 2^31")
    return np.ascontiguousarray(array, dtype=np.int32)


def mesh(vertices, normals, triangles):
    """The arrays of a mesh that anybody may have written to, as float64, float64 and int32."""
    x, directions, corners = points(vertices, "vertices"), points(normals, "normals"), faces(triangles, "faces")
    if len(x) and not np.abs(x).max() < 1e6:
        raise ValueError("vertices: expected coordinates below 1e6 Å")
    if not np.isfinite(directions).all():
        raise ValueError("normals: expected finite vectors")
    if len(corners) and corners.max() >= min(len(x), len(directions)):
        raise ValueError(f"faces: expected vertices below {len(x)}, got {corners.max()}")
    return x, directions, corners


def words(values, name):
    """A list of texts; None: an empty one."""
    array = np.asarray([] if values is None else values)
    if array.ndim != 1 or (array.size and array.dtype.kind not in "UO"):
        raise TypeError(f"{name}: expected texts, got {array.dtype.name} of shape {array.shape}")
    _refuse_masked(values, name)
    return [str(value) for value in array]


def balls(positions, radii):
    """Positions (n, 3) and radii (n,) as float64; at least one ball, all of them finite."""
    x, r = points(positions, "positions"), numbers(radii, "radii")
    if len(x) == 0:
        raise ValueError("positions: expected at least one atom, got none")
    if r.ndim == 0:
        r = np.full(len(x), float(r))
    if r.shape != (len(x),):
        raise ValueError(f"radii: expected a number or shape ({len(x)},), got {r.shape}")
    bad = np.flatnonzero(~np.isfinite(x).all(axis=1))
    if len(bad):
        raise ValueError(f"positions: expected finite numbers, got {x[bad[0]].tolist()} at index {bad[0]}")
    bad = np.flatnonzero(~((r > 0) & np.isfinite(r)))
    if len(bad):
        raise ValueError(f"radii: expected finite numbers above 0, got {r[bad[0]]} at index {bad[0]}")
    return x, r


def texts(columns):
    """A table whose lists of texts are arrays."""
    return {name: np.array(values, dtype=str) if isinstance(values, list) else values
            for name, values in columns.items()}
