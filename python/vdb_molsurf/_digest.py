# SPDX-License-Identifier: MPL-2.0
"""What rows are made of, as SHA-256: the contents of inputs, options with the files that they name, functions."""

import hashlib
import os
import pickle
import sys
import types

import numpy as np

from . import _core


def of_input(item, content=None):
    """The SHA-256 of what an input holds: the bytes of a file, or positions and radii; None if it cannot be read."""
    try:
        if content is not None:
            return hashlib.sha256(content).hexdigest()
        return of_value(tuple(item[1:])) if isinstance(item, tuple) else _core.input_sha256(os.fspath(item)) or None
    except (OSError, TypeError, ValueError):
        return None


def of_options(pairs):
    """The SHA-256 of the version and of settings with their values, and of files that these name ("table=FILE")."""
    return _core.options_sha256([(name, [text if isinstance(text, str) else repr(text) for text in texts])
                                 for name, texts in sorted(pairs, key=lambda pair: pair[0])])


def of_value(value):
    """The SHA-256 of a value: equal for what would do the same, a function with the code of its own package that it calls."""
    parts = _Parts()
    parts.add(value)
    return parts.digest.hexdigest()


class _Parts:
    """Adds values to a digest, each with its kind and length, so that other parts never give the same bytes."""

    def __init__(self):
        self.digest, self.seen, self.home = hashlib.sha256(), {}, None

    def put(self, kind, content):
        self.digest.update(f"{kind} {len(content)} ".encode() + content)

    def add(self, value):
        if isinstance(value, (np.ndarray, np.generic)) and value.dtype.kind != "O":
            array = np.ascontiguousarray(value)
            self.put("array", f"{array.dtype.str} {array.shape}".encode())
            self.put("bytes", array.tobytes())
            mask = np.ma.getmaskarray(value).tobytes() if isinstance(value, np.ma.MaskedArray) else b""
            if b"\1" in mask:
                self.put("mask", mask)
        elif value is None or isinstance(value, (bool, int, float, complex, str)):
            self.put(type(value).__name__, repr(value).encode(errors="backslashreplace"))
        elif isinstance(value, (bytes, bytearray)):
            self.put("bytes", bytes(value))
        elif isinstance(value, os.PathLike):
            self.put("path", os.fsencode(value))
        elif isinstance(value, (set, frozenset)):
            self.put("set", "".join(sorted(map(of_value, value))).encode())
        elif id(value) in self.seen and not isinstance(value, tuple):
            self.put("again", b"")
        else:
            self.seen[id(value)] = value  # kept, since another would get its id
            parts = self.parts_of(value)
            self.put(type(value).__name__, str(len(parts)).encode())
            for part in parts:
                self.add(part)

    def parts_of(self, value):
        if isinstance(value, (list, tuple)):
            return value
        if isinstance(value, dict):
            return [part for pair in value.items() for part in pair]
        if isinstance(value, types.ModuleType):
            return [value.__name__, str(getattr(value, "__version__", ""))]
        if isinstance(value, types.CodeType):
            return [value.co_code, value.co_consts, value.co_names, value.co_varnames, value.co_freevars]
        if isinstance(value, types.MethodType):
            return [value.__func__, value.__self__]
        if type(value).__module__ == "functools" and hasattr(value, "func"):
            return [value.func, value.args, value.keywords]
        named = isinstance(value, (types.FunctionType, types.BuiltinFunctionType, type))
        package = str(getattr(value if named else type(value), "__module__", "")).partition(".")[0]
        if self.home is None and package != "builtins":
            self.home = package
        if package != self.home:
            return self.parts_of_others(value, package, named)
        if isinstance(value, types.FunctionType):
            cells = [cell.cell_contents for cell in value.__closure__ or () if _is_filled(cell)]
            used = [(name, value.__globals__[name]) for name in _names(value.__code__) if name in value.__globals__]
            return [value.__code__, value.__defaults__, value.__kwdefaults__, cells, used]
        if isinstance(value, type):
            return [value.__module__, value.__qualname__, *value.__bases__,
                    *(pair for pair in sorted(vars(value).items()) if isinstance(pair[1], types.FunctionType))]
        return [type(value), getattr(value, "__dict__", None)]

    def parts_of_others(self, value, package, named):
        """What a value of another package is known by."""
        version = str(getattr(sys.modules.get(package), "__version__", ""))
        if named:
            return [package, version, value.__qualname__]
        try:
            return [package, version, pickle.dumps(value)]
        except Exception:  # noqa: BLE001: whatever pickle raises
            return [package, version, type(value).__qualname__]


def _names(code):
    """The names that code and the functions within it look up, in one order."""
    names = list(code.co_names)
    for constant in code.co_consts:
        if isinstance(constant, types.CodeType):
            names += _names(constant)
    return list(dict.fromkeys(names))


def _is_filled(cell):
    try:
        cell.cell_contents
    except ValueError:
        return False
    return True
