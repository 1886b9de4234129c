# SPDX-License-Identifier: MPL-2.0
"""Parts of tables: files of rows, whole or not there, in Parquet or CSV."""

import csv
import fcntl
import glob
import json
import numbers
import os
import secrets
import socket
import time

import numpy as np

TEXTS = ("input", "error", "kind", "sha256", "options", "function", "version", "units")
WHOLE = ("atoms", "components", "cavities")
COLUMNS = ("input", "error", "atoms", "kind", "area", "volume", "components", "cavities")
ORIGIN = ("sha256", "options", "function", "version", "units")
UNITS = "area Å², volume Å³"
FORMATS = ("parquet", "csv")


def read_rows(path):
    """The rows of a part, or None if the file is damaged, cut short or not there.

    Raises ValueError if it is whole, but holds another table.
    """
    try:
        rows = (_read_csv if path.endswith(".csv") else _read_parquet)(path)
    except (OSError, ValueError, KeyError, IndexError, csv.Error):  # pyarrow's errors are kinds of the first three
        return None
    if rows and not {*COLUMNS, *ORIGIN} <= rows[0].keys():
        raise ValueError(f"folder: {path[-100:]} is of another table [hint: another folder]")
    return rows


def write_rows(path, rows):
    """Writes a part, whole or not at all, and returns its rows as read_rows() would."""
    write = _csv if path.endswith(".csv") else _parquet
    folder, name = os.path.split(path)
    remove_left(folder, glob.escape(name))
    temporary = os.path.join(folder, f".{name}.{socket.gethostname()[:40]}.{secrets.token_hex(6)}")
    try:
        with open(temporary, "xb") as file:
            fcntl.flock(file, fcntl.LOCK_EX)
            write(file, rows)
            file.flush()
            os.fsync(file.fileno())
            os.replace(temporary, path)
    except BaseException:
        if os.path.exists(temporary):
            os.remove(temporary)
        raise
    return read_rows(path)


def remove_left(folder, pattern):
    """Removes what killed processes have left of parts: no one holds the lock."""
    for left in glob.glob(os.path.join(glob.escape(os.fspath(folder)), f".{pattern}.*")):
        try:
            with open(left, "rb") as file:
                if time.time() - os.fstat(file.fileno()).st_mtime > 1:
                    fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
                    os.remove(left)
        except OSError:
            pass


def _names(rows):
    return list(dict.fromkeys([*COLUMNS, *(name for row in rows for name in row if name not in ORIGIN), *ORIGIN]))


def _kind(values):
    """What a column of a function holds: bool, float, or None for anything else."""
    for kind, types in ((bool, (bool, np.bool_)), (float, (numbers.Real, np.floating, np.integer))):
        if all(value is None or isinstance(value, types) for value in values):
            return kind
    return None


def _text(value):
    """Text of a value that is no single number or text."""
    if value is None or isinstance(value, str):
        return value and plain(value)
    if isinstance(value, np.generic) or (isinstance(value, np.ndarray) and value.dtype.kind != "O"):
        value = value.tolist()
    try:
        return json.dumps(value)
    except (TypeError, ValueError):
        return plain(str(value))


def plain(text):
    """Text that can be encoded: names of files may hold any bytes."""
    return text.encode("utf-8", "backslashreplace").decode()


def _column(name, rows):
    """The values of a column, all of one type, and that type."""
    values = [row.get(name) for row in rows]
    kind = None if name in TEXTS else int if name in WHOLE else float if name in COLUMNS else _kind(values)
    try:
        if kind is not None:
            return [None if value is None else kind(value) for value in values], kind
    except (OverflowError, TypeError, ValueError):  # a whole number that is too large
        pass
    return [_text(value) for value in values], str


def _parquet(file, rows):
    import pyarrow
    import pyarrow.parquet
    types = {str: pyarrow.string(), int: pyarrow.int64(), float: pyarrow.float64(), bool: pyarrow.bool_()}
    arrays, fields = [], []
    for name in _names(rows):
        values, kind = _column(name, rows)
        if name not in (*COLUMNS, *ORIGIN) and all(value is None for value in values):
            kind = float
        unit = {"area": {"unit": "Å²"}, "volume": {"unit": "Å³"}}.get(name)
        arrays.append(pyarrow.array(values, types[kind]))
        fields.append(pyarrow.field(name, types[kind], metadata=unit))
    pyarrow.parquet.write_table(pyarrow.table(arrays, schema=pyarrow.schema(fields)), file)


def _read_parquet(path):
    import pyarrow.parquet
    with open(path, "rb") as file:
        return pyarrow.parquet.read_table(file).to_pylist()


def _csv(file, rows):
    names = _names(rows)
    columns = [_column(name, rows)[0] for name in names]
    lines = [names, *(["" if value is None else value for value in line] for line in zip(*columns))]

    class Encoded:
        def write(self, text):
            file.write(text.encode())
    csv.writer(Encoded(), lineterminator="\n").writerows(lines)


def _read_csv(path):
    with open(path, encoding="utf-8", newline="") as file:
        content = file.read()
    if not content.endswith("\n"):
        raise ValueError("cut short")
    names, *lines = csv.reader(content.splitlines(keepends=True), strict=True)
    if any(len(line) != len(names) for line in lines):
        raise ValueError("cut short")
    return [{name: _value(name, cell) for name, cell in zip(names, line)} for line in lines]


def _value(name, cell):
    """What a cell of a .csv stands for."""
    if cell == "":
        return None
    if name in TEXTS:
        return cell
    if name in WHOLE:
        return int(cell)
    if cell in ("True", "False"):
        return cell == "True"
    try:
        return float(cell)
    except ValueError:
        return cell
