# SPDX-License-Identifier: MPL-2.0
"""What all command-line tests share: running vdb_molsurf in a folder of its own."""

import csv
import os
import pathlib
import re
import struct
import subprocess
import tempfile
import unittest
import zlib

TOOL = os.environ["VDB_MOLSURF"]
ROOT = pathlib.Path(__file__).resolve().parents[2]
DATA = ROOT / "tests" / "data"
CRAMBIN = DATA / "1crn.pdb"
FAST = ["--voxel", "1"]  # coarse, for tests that look at anything but the surface


# What a program that loads libopenvdb.so takes more than one that does not [MiB]. The file is read in parts, since what
# this process takes counts for those that it starts.
with open(TOOL, "rb") as _program:
    LIBRARY = 27 if any(b"libopenvdb.so" in part for part in iter(lambda: _program.read(1 << 20), b"")) else 0
UNITS = {"MiB": 2**20, "GiB": 2**30}


def size_of(said):
    """The bytes of the first size in a text, such as "57.3 MiB"."""
    number, unit = re.search(r"([\d.e+]+) (MiB|GiB)", said).groups()
    return UNITS[unit] * float(number)


class ToolTest(unittest.TestCase):
    """Every test has an empty current folder, self.folder."""

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def run_tool(self, *words, **options):
        options = {"cwd": self.folder, "capture_output": True, "timeout": 300, **options}
        return subprocess.run([TOOL, *map(str, words)], **options)

    def check(self, status, *words, says=(), **options):
        """Runs the tool; expects the status, and all of `says` on standard error.

        A failing run ends with its one line of error, and a wrong call says nothing else.
        """
        done = self.run_tool(*words, **options)
        error = (done.stderr or b"").decode()
        self.assertEqual(done.returncode, status, error)
        if status in (1, 2, 75):
            lines = error.splitlines()
            self.assertEqual(error.count("vdb_molsurf: error: "), 1, error)
            self.assertTrue(lines[-1].startswith("vdb_molsurf: error: "), error)
            self.assertTrue(status != 2 or len(lines) == 1, error)
        for word in [says] if isinstance(says, str) else says:
            self.assertIn(str(word), error)
        return done

    def table(self, name):
        """The rows of a .csv file by the names of its columns."""
        with open(self.folder / name, newline="") as file:
            return list(csv.DictReader(file))

    def names(self):
        return sorted(path.name for path in self.folder.iterdir())


def read_ply(data):
    """(properties of a vertex, vertices as tuples, triangles) of a binary PLY."""
    header, body = data.split(b"end_header\n", 1)
    lines = header.decode("ascii").splitlines()
    assert lines[:2] == ["ply", "format binary_little_endian 1.0"], lines
    letters = {"float": "f", "int": "i", "uchar": "B"}
    names, form, counts, element = [], "<", {}, None
    for line in lines[2:]:
        words = line.split()
        if words[0] == "comment":
            continue
        if words[0] == "element":
            element = words[1]
            counts[element] = int(words[2])
        elif element == "vertex":
            assert words[0] == "property", line
            form += letters[words[1]]
            names.append(words[2])
        else:
            assert line == "property list uchar int vertex_indices", line
    assert list(counts) == ["vertex", "face"], counts
    end = counts["vertex"] * struct.calcsize(form)
    assert len(body) == end + 13 * counts["face"], "length of the file"
    vertices = list(struct.iter_unpack(form, body[:end]))
    triangles = []
    for three, a, b, c in struct.iter_unpack("<Biii", body[end:]):
        assert three == 3
        triangles.append((a, b, c))
    return names, vertices, triangles


def read_png(data, parts=3):
    """(width, rows of bytes, three or all four a pixel) of an 8-bit picture with or without alpha."""
    channels = {2: 3, 6: 4}[data[25]]
    width, at, body = struct.unpack(">I", data[16:20])[0], 8, b""
    while at < len(data):
        size, = struct.unpack(">I", data[at:at + 4])
        if data[at + 4:at + 8] == b"IDAT":
            body += data[at + 8:at + 8 + size]
        at += size + 12
    body, stride = zlib.decompress(body), channels * width
    rows, last = [], bytearray(stride)
    for start in range(0, len(body), stride + 1):
        kind, row = body[start], bytearray(body[start + 1:start + 1 + stride])
        for i in range(stride):
            a, c = (row[i - channels], last[i - channels]) if i >= channels else (0, 0)
            b = last[i]
            guess = a + b - c
            paeth = min((a, b, c), key=lambda x: abs(guess - x))
            row[i] = row[i] + (0, a, b, (a + b) // 2, paeth)[kind] & 255
        last = row
        rows.append(bytearray(v for i, v in enumerate(row) if i % channels < parts))
    return width, rows
