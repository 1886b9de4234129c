# SPDX-License-Identifier: MPL-2.0
"""A process in which inputs are measured, so that one that needs too much ends it and nothing else."""

import contextlib
import ctypes
import multiprocessing
import multiprocessing.spawn
import os
import pickle
import resource
import signal
import subprocess
import sys

DIED = "the process ended: out of memory, or a fault"
START = ("import sys; from multiprocessing.connection import Connection; c = Connection(int(sys.argv[1])); "
         "sys.path[:] = c.recv(); from vdb_molsurf import _apart; _apart.serve(c)")
UNITS = {"K": 10, "M": 20, "G": 30, "T": 40}


def bytes_of(memory):
    """Bytes of a number or of a text such as "4G", or None."""
    if memory is None:
        return None
    text = str(memory).upper()
    try:
        number = float(text.rstrip("KMGT")) * 2 ** UNITS.get(text[-1:], 0)
    except ValueError:
        number = 0
    if isinstance(memory, bool) or not 2**20 <= number < 2**60:
        raise ValueError(f"memory: expected bytes from 1M up, such as \"4G\", got {memory!r:.40}")
    return int(number)


def hours_of(hours):
    """Hours as a number above 0, or None."""
    if hours is not None and (isinstance(hours, bool) or not isinstance(hours, (int, float)) or not 0 < hours < 1e6):
        raise ValueError(f"max_hours: expected a number above 0, got {hours!r:.40}")
    return hours


def free_memory():
    """Bytes that one more process may take: of the machine, of the control groups, of a worker of Dask."""
    amounts = []
    with contextlib.suppress(OSError, ValueError, IndexError):
        with open("/proc/meminfo") as file:
            amounts += [int(line.split()[1]) << 10 for line in file if line.startswith("MemAvailable")]
    amounts += _free_of_groups()
    distributed = sys.modules.get("distributed")
    if distributed is not None:
        with contextlib.suppress(Exception):  # no worker, or of a version that keeps it elsewhere
            limit = distributed.get_worker().memory_manager.memory_limit
            amounts += [int(0.95 * limit) - _sizes()[1]] if limit else []
    return max(min(amounts), 64 << 20) if amounts else None


def _free_of_groups():
    """What control groups leave, of version 1 and 2, that of this process and those above it."""
    amounts = []
    with contextlib.suppress(OSError):
        with open("/proc/self/cgroup") as file:
            lines = [line.rstrip("\n").split(":", 2) for line in file]
        for _, controllers, path in lines:
            if controllers not in ("", "memory") and "memory" not in controllers.split(","):
                continue
            root = "/sys/fs/cgroup" + ("/memory" if controllers else "")
            names = ("memory.limit_in_bytes", "memory.usage_in_bytes") if controllers else ("memory.max", "memory.current")
            while True:
                with contextlib.suppress(OSError, ValueError):
                    limit, taken = (int(open(f"{root}{path}/{name}").read()) for name in names)
                    with open(f"{root}{path}/memory.stat") as file:  # pages of files give way
                        taken -= sum(int(line.split()[1]) for line in file if line.startswith("inactive_file "))
                    amounts.append(limit - taken)
                if path in ("", "/"):
                    break
                path = os.path.dirname(path)
    return amounts


def _sizes():
    """Address space and memory of this process [byte]."""
    with open("/proc/self/statm") as file:
        return [int(word) * os.sysconf("SC_PAGE_SIZE") for word in file.read().split()[:2]]


def limit_memory(memory, threads):
    """Lets this process take so many bytes at most, and be the first that the system ends when there are none left."""
    with contextlib.suppress(OSError):
        with open("/proc/self/oom_score_adj", "w") as file:
            file.write("1000")
    if memory is not None:
        space, taken = _sizes()
        hard = resource.getrlimit(resource.RLIMIT_AS)[1]
        of_thread = 72 << 20  # address space that a thread takes and does not fill
        limit = max(space - taken, 0) + memory + of_thread * ((threads or os.cpu_count() or 1) - 1)
        resource.setrlimit(resource.RLIMIT_AS, (limit if hard == resource.RLIM_INFINITY else min(limit, hard), hard))


@contextlib.contextmanager
def timed(hours):
    """Raises TimeoutError in what takes longer. For the main thread of a process."""
    if hours is None:
        yield
        return

    def end(*_):
        raise TimeoutError(f"more than {hours:g} hours [hint: a larger voxel, or a larger max_hours]")
    before = signal.signal(signal.SIGALRM, end)
    signal.setitimer(signal.ITIMER_REAL, 3600 * hours)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


def packed(function):
    """A function as bytes for another process, or None if that cannot be."""
    try:
        if getattr(function, "__module__", "") != "__main__":
            return pickle.dumps(function)
    except Exception:  # noqa: BLE001: whatever pickle raises
        pass
    try:
        import cloudpickle
        return cloudpickle.dumps(function)
    except Exception:  # noqa: BLE001
        return None


class Unloadable(Exception):
    """The other process cannot load the function."""


class Apart:
    """A process that makes rows of inputs, one after the other. It starts when it is needed, and again when it has died."""

    def __init__(self, function, options, memory, hours):
        self._job = (function, options, memory, hours)
        self._process = self._pipe = None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def row(self, item, content):
        """The row of an input, or None if the process died of it. Raises Unloadable."""
        new = self._process is None
        row = self._row(item, content)
        if row is None or (row["error"] or "").startswith("MemoryError"):
            self.close()
            if not new:  # what others have left may be in the way
                row = self._row(item, content)
        return row

    def _row(self, item, content):
        try:
            if self._process is None:
                self._start()
            self._pipe.send((item, content))
            return self._pipe.recv()
        except (EOFError, OSError):
            self.close()
            return None

    def _start(self):
        self._pipe, other = multiprocessing.Pipe()
        with other:
            self._process = subprocess.Popen(
                [multiprocessing.spawn.get_executable(), "-I", "-c", START, str(other.fileno())],
                pass_fds=[other.fileno()], stdin=subprocess.DEVNULL)
        self._pipe.send(sys.path)
        self._pipe.send((os.getpid(), *self._job))
        if not self._pipe.recv():
            self.close()
            raise Unloadable

    def close(self):
        """Ends the process."""
        if self._process is not None:
            self._process.kill()
            self._process.wait()
            self._pipe.close()
            self._process = self._pipe = None


def serve(pipe):
    """What the process does: rows, until the other end is closed."""
    from . import _many
    with contextlib.suppress(OSError, AttributeError):
        ctypes.CDLL(None).prctl(1, signal.SIGKILL)  # PR_SET_PDEATHSIG: it ends with the thread that started it
    try:
        parent, function, options, memory, hours = pipe.recv()
        if os.getppid() != parent:
            return
        try:
            function = pickle.loads(function)
        except Exception:  # noqa: BLE001: whatever a module raises
            pipe.send(False)
            return
        limit_memory(memory, options["threads"])
        pipe.send(True)
        while True:
            item, content = pipe.recv()
            row = _many.row_of(item, content, function, options, hours)
            try:
                pipe.send(row)
            except Exception as error:  # noqa: BLE001: what cannot be sent is an error of this input
                pipe.send(_many.failed(item, _many.line_of(error)))
    except (EOFError, KeyboardInterrupt):
        pass
