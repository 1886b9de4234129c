# SPDX-License-Identifier: MPL-2.0
"""Many structures at once: rows of numbers, a process for each core, parts of tables that a second run finds."""

import collections
import concurrent.futures
import hashlib
import json
import multiprocessing
import os
import tarfile
import typing

from . import _core, _options
from ._molecule import read
from ._surface import surface

ENDINGS = tuple(_core.structure_endings())
COLUMNS = ("input", "error", "atoms", "kind", "area", "volume", "components", "cavities")
DIED = "the process ended: out of memory, or a fault"


class Shard(typing.NamedTuple):
    """Some of the inputs, in order: what one worker takes at a time, and one file of a table."""
    number: int
    items: list


def shards(sources, size=100):
    """Inputs in shards of `size`, as an iterator.

    sources: a folder of structures, a .tar archive of them, a path, or an iterable of these and of tuples (name, positions,
    radii) as frames of a trajectory give them. Files in folders are taken in the order of their names. A member of an
    archive is named "archive.tar::member".
    """
    if size < 1 or size != int(size):
        raise ValueError(f"size: expected a whole number from 1, got {size!r:.40}")
    number, items = 0, []
    for item in _items(sources):
        items.append(item)
        if len(items) == size:
            yield Shard(number, items)
            number, items = number + 1, []
    if items:
        yield Shard(number, items)


def measure(shard, function=None, folder=None, **options):
    """Rows of a shard, a dict for each input: input, error (None if there is none), atoms, kind, area [Å²], volume [Å³], components,
    cavities. An input that fails is a row with its error.

    function: is called with each Surface; what its dict holds is added to the row.
    folder: the rows are written there as part-NNNNNNNN.parquet, by pyarrow; they are read from it if it is there, made
    of the same inputs with the same options, and a ValueError says so if it was made of others. Workers may write parts
    of one table at the same time.
    options: keywords of read() and surface(); `threads` is 1 unless given.
    """
    shard = Shard(*shard)
    checked = _checked(options)
    path = folder and _part(folder, shard)
    made_of = _made_of(shard, function, options)
    if path and os.path.exists(path):
        return _read_part(path, made_of)
    rows = [_row(item, function, checked) for item in shard.items]
    if path:
        _write_part(path, rows, made_of)
    return rows


def map(sources, function=None, workers=None, size=100, folder=None, **options):
    """Rows of all inputs as measure() makes them, in their order, as an iterator; `workers` processes with one thread each, one
    for each core unless given, take shards of `size` inputs.

    With a folder a run that was ended goes on where it was. A process that dies takes no input with it but its own.
    Processes are started anew, so a script needs `if __name__ == "__main__":`, and `function` has to be one of a module.
    """
    _checked(options)
    workers = workers or len(os.sched_getaffinity(0))
    if folder is not None:
        import pyarrow.parquet  # noqa: F401: says at once what is missing
        os.makedirs(folder, exist_ok=True)
    waiting, more = collections.deque(), shards(sources, size)
    pool = _pool(workers)
    try:
        for shard in more:
            waiting.append((shard, _submitted(pool, shard, function, folder, options)))
            if len(waiting) >= 2 * workers:
                rows, pool = _finished(waiting, pool, workers, function, folder, options)
                yield from rows
        while waiting:
            rows, pool = _finished(waiting, pool, workers, function, folder, options)
            yield from rows
    finally:
        pool.shutdown(wait=False, cancel_futures=True)
        for process in list((getattr(pool, "_processes", None) or {}).values()):
            process.terminate()


def _name(item):
    return item[0] if isinstance(item, tuple) else item


def _part(folder, shard):
    return os.path.join(os.fspath(folder), f"part-{shard.number:08d}.parquet")


def _failed(item, error):
    return {**dict.fromkeys(COLUMNS), "input": _name(item), "error": error}


def _items(sources):
    if isinstance(sources, (str, os.PathLike)):
        path = os.fspath(sources)
        if os.path.isdir(path):
            yield from (os.path.join(path, name) for name in sorted(os.listdir(path)) if _is_structure(name))
        elif path.endswith((".tar", ".tar.gz", ".tgz")):
            with tarfile.open(path) as archive:
                yield from (f"{path}::{m.name}" for m in archive if m.isfile() and _is_structure(m.name))
        else:
            yield path
    elif isinstance(sources, tuple) and len(sources) == 3 and isinstance(sources[0], str):
        yield sources
    elif hasattr(sources, "__iter__"):
        for source in sources:
            yield from _items(source)
    else:
        raise TypeError(f"sources: expected paths or (name, positions, radii), got {type(sources).__name__}")


def _is_structure(name):
    name = name.lower()
    for packed in (".gz", ".bz2", ".xz"):
        name = name.removesuffix(packed)
    return name.endswith(ENDINGS)


def _checked(options):
    options = {"threads": 1, **options}
    known = {name: value for name, value in options.items() if name not in _options.MORE}
    _options.given(known, "atoms", _options.MORE)
    return options


def _surface_of(item, options):
    if isinstance(item, tuple):
        return surface(item[1], item[2], **options)
    of_surface = {name: options[name] for name in _options.MORE if name in options}
    of_atoms = {name: value for name, value in options.items() if name not in _options.MORE}
    archive, separator, member = item.partition("::")
    if not separator:
        return read(item, **of_atoms).surface(**of_surface)
    with tarfile.open(archive) as opened:
        content = opened.extractfile(member).read()
    return read(content, **of_atoms).surface(**of_surface)


def _row(item, function, options):
    row = _failed(item, None)
    try:
        made = _surface_of(item, options)
        report = made.report["surface"]
        row.update(atoms=len(made.atom_areas) if made.atom_areas is not None else None, kind=report["kind"], area=made.area,
                   volume=made.volume, components=report["components"], cavities=report["cavities"])
        if function is not None:
            row.update(function(made))
    except (KeyboardInterrupt, SystemExit):
        raise
    except Exception as error:  # noqa: BLE001: whatever it is, the other inputs go on
        row = _failed(item, f"{type(error).__name__}: {error}".split("\n")[0])
    return row


def _made_of(shard, function, options):
    names = [_name(item) for item in shard.items]
    called = function and f"{function.__module__}.{getattr(function, '__qualname__', type(function).__qualname__)}"
    text = json.dumps([_core.__version__, names, called, sorted((name, repr(value)) for name, value in options.items()
                                                                if name not in ("threads", "progress"))])
    return hashlib.sha256(text.encode()).hexdigest()


def _write_part(path, rows, made_of):
    import pyarrow
    import pyarrow.parquet
    types = {"input": pyarrow.string(), "error": pyarrow.string(), "kind": pyarrow.string(), "atoms": pyarrow.int64(),
             "components": pyarrow.int64(), "cavities": pyarrow.int64()}
    names = list(dict.fromkeys(name for row in rows for name in row))
    arrays = [pyarrow.array([row.get(name) for row in rows],
                            types.get(name, pyarrow.float64() if name in COLUMNS else None)) for name in names]
    table = pyarrow.table(arrays, names=names).replace_schema_metadata({"vdb_molsurf": made_of})
    temporary = f"{path}.{os.getpid()}"
    try:
        pyarrow.parquet.write_table(table, temporary)
        os.replace(temporary, path)
    finally:
        if os.path.exists(temporary):
            os.remove(temporary)


def _read_part(path, made_of):
    import pyarrow.parquet
    table = pyarrow.parquet.read_table(path)
    if (table.schema.metadata or {}).get(b"vdb_molsurf") != made_of.encode():
        raise ValueError(f"folder: {path[-100:]} was made of other inputs or with other options [hint: another folder]")
    return table.to_pylist()


def _pool(workers):
    return concurrent.futures.ProcessPoolExecutor(workers, mp_context=multiprocessing.get_context("spawn"))


def _submitted(pool, shard, function, folder, options):
    try:
        return pool.submit(measure, shard, function, folder, **options)
    except concurrent.futures.process.BrokenProcessPool:
        return None


def _finished(waiting, pool, workers, function, folder, options):
    """The rows of the shard that waits the longest, and the pool, a new one if a process of it died."""
    shard, future = waiting[0]
    try:
        if future is None:
            raise concurrent.futures.process.BrokenProcessPool
        rows = future.result()
    except concurrent.futures.process.BrokenProcessPool:
        rows = _alone(shard, function, folder, options)
        pool.shutdown(wait=False, cancel_futures=True)
        pool = _pool(workers)
        waiting.popleft()
        again = [(other, _submitted(pool, other, function, folder, options)) for other, _ in waiting]
        waiting.clear()
        waiting.extend(again)
        return rows, pool
    waiting.popleft()
    return rows, pool


def _alone(shard, function, folder, options):
    """The rows of a shard during which a process died: each input has a process of its own."""
    rows = []
    for item in shard.items:
        with _pool(1) as pool:
            try:
                rows += pool.submit(measure, Shard(0, [item]), function, None, **options).result()
            except concurrent.futures.process.BrokenProcessPool:
                rows.append(_failed(item, DIED))
    if folder is not None:
        _write_part(_part(folder, shard), rows, _made_of(shard, function, options))
    return rows
