# SPDX-License-Identifier: MPL-2.0
"""Runs that are killed, and what they leave."""

import json
import subprocess

from tool import TOOL

# The calls of the system by which names of files change.
NAMING = ("rename", "renameat", "renameat2", "unlink", "unlinkat")


def signalled_at(call, number, signal, words, folder):
    """Runs the tool, with a signal at such a call of the system, the first one being number 1."""
    return subprocess.run(["strace", "-f", "-qq", "-o", "/dev/null", "-e", f"trace={call}",
                           "-e", f"inject={call}:signal={signal}:when={number}", TOOL, *map(str, words)],
                          cwd=folder, capture_output=True, timeout=60)


def killed_at(call, number, words, folder):
    """Whether a run was killed (SIGKILL) there, and did not end before."""
    return signalled_at(call, number, "KILL", words, folder).returncode != 0


def without(names, entry):
    """JSON without what differs from run to run."""
    if isinstance(entry, dict):
        return {key: without(names, value) for key, value in entry.items() if key not in names}
    return [without(names, value) for value in entry] if isinstance(entry, list) else entry


def lasting(path):
    """The content of a file, but for times and memory."""
    data = path.read_bytes()
    if path.suffix == ".brick":
        return None  # times are all over it
    if path.suffix == ".json":
        return without(("seconds", "peak_memory_bytes"), json.loads(data))
    if path.suffix == ".csv":
        rows = [line.split(",") for line in data.decode().splitlines()]
        if "seconds" not in rows[0]:  # as in summary.csv
            return rows
        column = rows[0].index("seconds")
        return [row[:column] + row[column + 1:] for row in rows]
    return data


def state(folder):
    """All files of a folder, but the journal of a batch: it also has what was begun twice."""
    return {path.name: lasting(path) for path in folder.iterdir()
            if path.is_file() and path.name != "summary.jsonl"}
