# SPDX-License-Identifier: MPL-2.0
"""Many structures at once: rows of numbers, a process for each core, parts of tables that a second run finds."""

import collections
import concurrent.futures
import multiprocessing
import os
import tarfile
import threading
import typing

from . import _apart, _core, _digest, _options, _parts
from ._molecule import _read
from ._surface import _threads, surface

ENDINGS = tuple(_core.structure_endings())
LASTING = ("InputError", "OptionError", "NumericError", "ValueError")  # errors that the same input has again

UNLOADABLE = "function: memory and max_hours need one that another process can load [hint: a function of a module]"


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


def measure(shard, function=None, folder=None, *, format="parquet", memory=None, max_hours=None, **options):
    """Rows of a shard, a dict for each input in their order: input (its name), error (a line, or None), atoms, kind, area [Å²],
    volume [Å³], components, cavities; then where the row comes from: sha256 (of the file's bytes, or of the arrays),
    options (a SHA-256 of version, keywords and the files that they name), function (a SHA-256 of its code, or None),
    version, units. An input that fails is a row with its error, the numbers None.

    shard: one of shards(), or (number, inputs).
    function: is called with each Surface; what its dict holds is added to the row.
    folder: is made; the rows are written there as part-NNNNNNNN.parquet, by pyarrow, whole or not at all. Rows of a part
    that is there are taken if contents of the input and function are the same; others are made anew, as are damaged parts
    and errors that may pass (memory, time, a file that is missing; of the library "InputError, may pass: ..."). Other options, another version, and a part that has
    none of the inputs are refused. Workers may write parts of one table, or the same part, at the same time. Columns of a
    function have one type: bool, float64, or text.
    format: "parquet", or "csv", which needs no other package and has the same columns.
    memory: bytes that the process of an input may take, from 1M: a number or text such as "4G". None: what is free on the
    machine, in its control group or in the worker of Dask.
    max_hours: hours that an input may take by the clock, above 0; None: without end.
    options: keywords of read() and surface(); `threads` is 1 unless given.

    Another process measures the inputs, so that one that takes too much ends that process only; `function` leaves nothing
    but its dict behind. It is a function of a module, or any if cloudpickle is installed. Other functions, and runs with
    `progress`, stay in this process, which refuses memory and max_hours for them.

    Raises TypeError for unknown keywords; ValueError for values out of range, and for a part of other inputs or options.
    """
    shard, checked = Shard(*shard), _checked(options)
    memory, hours = _apart.bytes_of(memory), _apart.hours_of(max_hours)
    packed = None if options.get("progress") else _apart.packed(function)
    if packed is None and (memory or hours):
        raise ValueError(UNLOADABLE)

    def make(item, content):
        if packed is None:
            return row_of(item, content, function, checked)
        try:
            return process.row(item, content) or failed(item, _apart.DIED)
        except _apart.Unloadable:
            if memory or hours:
                raise ValueError(UNLOADABLE) from None
            return row_of(item, content, function, checked)

    with _apart.Apart(packed, checked, memory or _apart.free_memory(), hours) as process:
        return _rows(shard, function, folder, format, options, make)


def map(sources, function=None, workers=None, size=100, folder=None, *, format="parquet", memory=None, max_hours=None,
        **options):
    """Rows of all inputs as measure() makes them, in their order, as an iterator; processes with one thread each, one for each
    core unless given, take shards.

    sources: as shards() takes them.
    workers: processes; each may take `memory`.
    size: inputs of a shard, from 1.

    Other keywords are those of measure().

    With a folder a run that was ended goes on where it was; at its end it removes parts beyond the last shard. A process
    that dies takes no input with it but its own. Processes are started anew, so a script needs
    `if __name__ == "__main__":`, and `function` has to be one of a module.

    Raises what measure() raises, and ImportError without pyarrow if a folder is given for Parquet.
    """
    options = _checked(options)
    limits = (_apart.bytes_of(memory), _apart.hours_of(max_hours))
    workers = workers or len(os.sched_getaffinity(0))
    if folder is not None:
        if _format(format) == "parquet":
            import pyarrow.parquet  # noqa: F401: says at once what is missing
        os.makedirs(folder, exist_ok=True)
    return _mapped(shards(sources, size), workers, limits, (function, folder, format, options))


def _mapped(more, workers, limits, job):
    waiting, count = collections.deque(), 0
    pool = _pool(workers, limits, job[3]["threads"])
    try:
        for shard in more:
            count += 1
            waiting.append((shard, _submitted(pool, shard, limits, job)))
            if len(waiting) >= 2 * workers:
                rows, pool = _finished(waiting, pool, workers, limits, job)
                yield from rows
        while waiting:
            rows, pool = _finished(waiting, pool, workers, limits, job)
            yield from rows
        _, folder, ending, _ = job
        if folder is not None:
            _parts.remove_left(folder, f"part-*.{ending}")
        while folder is not None and os.path.exists(_part(folder, count, ending)):
            os.remove(_part(folder, count, ending))
            count += 1
    finally:
        pool.shutdown(wait=False, cancel_futures=True)
        for process in list((getattr(pool, "_processes", None) or {}).values()):
            process.terminate()


def _name(item):
    return _parts.plain(str(item[0] if isinstance(item, tuple) else os.fspath(item)))


def _format(format):
    if format not in _parts.FORMATS:
        raise ValueError(f"format: expected {' or '.join(_parts.FORMATS)}, got {format!r:.40}")
    return format


def _part(folder, number, format):
    return os.path.join(os.fspath(folder), f"part-{number:08d}.{format}")


def failed(item, error):
    """The row of an input that failed."""
    return {**dict.fromkeys(_parts.COLUMNS), "input": _name(item), "error": error}


def line_of(error):
    """One line of an error, with its kind, and whether another try may go well."""
    passing = ", may pass" if getattr(error, "may_pass", False) else ""
    return f"{type(error).__name__}{passing}: {error}".split("\n")[0]


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
    """The keywords, which are known, with threads."""
    _settings(options)
    return {**options, "threads": _threads(options.get("threads", 1))}


def _settings(options):
    """What keywords say, in one way: settings with their values as texts, without what changes no number."""
    pairs = _options.given({name: value for name, value in options.items() if name not in _options.MORE}, "atoms",
                           _options.MORE)
    return pairs + [(name, [value]) for name, value in options.items()
                    if name in _options.MORE and name not in ("threads", "progress")]


def _surface_of(item, content, options):
    if isinstance(item, tuple):
        return surface(item[1], item[2], **options)
    of_surface = {name: options[name] for name in _options.MORE if name in options}
    of_atoms = {name: value for name, value in options.items() if name not in _options.MORE}
    groups = of_atoms.pop("groups", None)
    return _read(item if content is None else content, groups, None, 0, of_atoms).surface(**of_surface)


def _columns_of(found):
    """What a function has found, by names that no column has."""
    found = dict(found)
    for name in found:
        if not isinstance(name, str) or name in (*_parts.COLUMNS, *_parts.ORIGIN):
            raise ValueError(f"function: expected names of new columns, got {name!r:.40}")
    return found


def row_of(item, content, function, options, hours=None):
    """The row of an input, an error in it whatever happens."""
    row = failed(item, None)
    try:
        with _apart.timed(hours):
            made = _surface_of(item, content, options)
            report = made.report["surface"]
            row.update(atoms=made._core.atoms, kind=report["kind"], area=made.area, volume=made.volume,
                       components=report["components"], cavities=report["cavities"])
            row.update({} if function is None else _columns_of(function(made)))
    except (KeyboardInterrupt, SystemExit):
        raise
    except MemoryError:
        row = failed(item, "MemoryError: takes more than there is [hint: a larger voxel, or a larger memory]")
    except Exception as error:  # noqa: BLE001: whatever it is, the other inputs go on
        row = failed(item, line_of(error))
    return row


def _rows(shard, function, folder, format, options, make):
    """The rows of a shard, those of its part that are still true and those that `make` makes."""
    origin = {"options": _digest.of_options(_settings(options)),
              "function": function and _digest.of_value(function), "version": _core.__version__, "units": _parts.UNITS}
    path = None
    if folder is not None:
        path = _part(folder, shard.number, _format(format))
        os.makedirs(folder, exist_ok=True)
    found = path and os.path.exists(path) and _parts.read_rows(path) or []
    _refuse_others(path, found, shard, origin)
    kept = collections.defaultdict(list)
    for row in found:
        if row["error"] is None or row["error"].split(":")[0] in LASTING:
            kept[row["input"], row["sha256"], row["function"]].append(row)
    rows = []
    for item in shard.items:
        try:
            content = _member(item)
        except Exception as error:  # noqa: BLE001: an archive can be damaged in many ways
            rows.append({**failed(item, line_of(error)), "sha256": None, **origin})
            continue
        sha256 = _digest.of_input(item, content)
        same = kept.get((_name(item), sha256, origin["function"])) if sha256 else None
        row = same.pop(0) if same else {**make(item, content), "sha256": sha256, **origin}
        if not same and sha256 and content is None and sha256 != _digest.of_input(item):
            row = {**failed(item, "OSError: the file changed while it was read"), "sha256": None, **origin}
        rows.append(row)
    if path and (len(rows) != len(found) or any(a is not b for a, b in zip(rows, found))):
        rows = _parts.write_rows(path, rows)
    return rows


def _refuse_others(path, found, shard, origin):
    """Refuses to write over the rows of another table."""
    if any(row["options"] != origin["options"] for row in found):
        raise ValueError(f"folder: {path[-100:]} was made with other options or by another version [hint: another folder]")
    if found and not {row["input"] for row in found} & {_name(item) for item in shard.items}:
        raise ValueError(f"folder: {path[-100:]} has rows of other inputs [hint: another folder]")


class _Archive:
    """The places of an archive's members, read once."""

    def __init__(self, path, state):
        self.state, self.file, self.places, self.lock = state, tarfile.open(path), {}, threading.Lock()
        for member in self.file:
            if member.isreg():
                self.places[member.name] = (member.offset_data, member.size)
            self.file.members = []  # as much memory as one of them

    def read(self, name):
        if name not in self.places:
            raise FileNotFoundError(f"the archive has no {name[-100:]}")
        with self.lock:
            self.file.fileobj.seek(self.places[name][0])
            content = self.file.fileobj.read(self.places[name][1])
        if len(content) != self.places[name][1]:
            raise OSError("the archive is cut short")
        return content


_archives = {}
_archives_lock = threading.Lock()


def _member(item):
    """The bytes of a member of an archive; None for other inputs."""
    if isinstance(item, tuple) or "::" not in os.fspath(item):
        return None
    path, _, name = os.fspath(item).partition("::")
    status = os.stat(path)
    state = (status.st_dev, status.st_ino, status.st_size, status.st_mtime_ns)
    with _archives_lock:
        if path not in _archives or _archives[path].state != state:
            if len(_archives) >= 8:
                _archives.pop(next(iter(_archives)))
            _archives[path] = _Archive(path, state)
        archive = _archives[path]
    return archive.read(name)


def _pool(workers, limits, threads):
    memory, _ = limits
    return concurrent.futures.ProcessPoolExecutor(workers, multiprocessing.get_context("spawn"), _apart.limit_memory,
                                                  (memory or _apart.free_memory(), threads))


def _in_pool(shard, hours, function, folder, format, options):
    """The rows of a shard, in a process of the pool."""
    checked = _checked(options)
    return _rows(shard, function, folder, format, options,
                 lambda item, content: row_of(item, content, function, checked, hours))


def _submitted(pool, shard, limits, job):
    try:
        return pool.submit(_in_pool, shard, limits[1], *job)
    except concurrent.futures.process.BrokenProcessPool:
        return None


def _finished(waiting, pool, workers, limits, job):
    """The rows of the shard that waits the longest, and the pool, a new one if a process of it died."""
    shard, future = waiting[0]
    try:
        if future is None:
            raise concurrent.futures.process.BrokenProcessPool
        rows = future.result()
    except concurrent.futures.process.BrokenProcessPool:
        rows = _alone(shard, limits, job)
        pool.shutdown(wait=False, cancel_futures=True)
        pool = _pool(workers, limits, job[3]["threads"])
        waiting.popleft()
        again = [(other, _submitted(pool, other, limits, job)) for other, _ in waiting]
        waiting.clear()
        waiting.extend(again)
        return rows, pool
    waiting.popleft()
    return rows, pool


def _alone(shard, limits, job):
    """The rows of a shard during which a process died: each input has a process of its own."""
    function, _, _, options = job
    checked = _checked(options)

    def make(item, content):
        with _pool(1, limits, checked["threads"]) as pool:
            try:
                return pool.submit(row_of, item, content, function, checked, limits[1]).result()
            except concurrent.futures.process.BrokenProcessPool:
                return failed(item, _apart.DIED)
    return _rows(shard, *job, make)
