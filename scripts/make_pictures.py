#!/usr/bin/python3
# SPDX-License-Identifier: MPL-2.0
"""Draws docs/pictures/1a8o.png: atoms, initial surface, and relaxed surface coloured by mean curvature.

    scripts/make_pictures.py build-release/tools/vdb_molsurf docs/pictures/1a8o.png

Needs the Debian packages python3 and python3-numpy. The surfaces are the tool's own meshes.
"""

import gzip
import pathlib
import struct
import subprocess
import sys
import tempfile
import zlib

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[1]
DATA = ROOT / "tests" / "data"

SCALE = 8.0  # pixels per Å
FINE = 2  # samples per pixel and axis
MARGIN = 3.0  # [Å]

RADII = {"C": 1.70, "N": 1.55, "O": 1.52, "S": 1.80, "SE": 1.90}  # Bondi's [Å]
COLORS = {"C": (0.62, 0.66, 0.70), "N": (0.33, 0.48, 0.86), "O": (0.86, 0.33, 0.30),
          "S": (0.90, 0.77, 0.27), "SE": (0.90, 0.62, 0.27)}
PLAIN = (0.66, 0.74, 0.84)
LIGHT = np.array([-0.45, 0.55, 0.70]) / np.linalg.norm([-0.45, 0.55, 0.70])


def run(tool, output, *words, status=0):
    call = [tool, DATA / "1a8o.cif.gz", "--assembly", "1", "--voxel", "0.25", "-q", "-o", output]
    done = subprocess.run([*map(str, call), *words])
    if done.returncode != status:
        sys.exit(f"vdb_molsurf ended with {done.returncode}, expected {status}")


def read_ply(path):
    """Vertex attributes by name, and triangles, of a PLY that the tool wrote."""
    header, body = path.read_bytes().split(b"end_header\n", 1)
    types = {b"float": "<f4", b"int": "<i4"}
    fields, counts = [], {}
    for words in map(bytes.split, header.splitlines()):
        if words[0] == b"element":
            counts[words[1]] = int(words[2])
        elif words[0] == b"property" and words[1] != b"list":
            fields.append((words[2].decode(), types[words[1]]))
    vertices = np.frombuffer(body, np.dtype(fields), counts[b"vertex"])
    faces = np.frombuffer(body, np.dtype([("n", "u1"), ("v", "<i4", 3)]), counts[b"face"],
                          vertices.nbytes)
    return vertices, faces["v"]


def read_atoms():
    """Centres and elements of the dimer, without waters."""
    rows, atoms, elements = {}, [], []
    for line in gzip.open(DATA / "1a8o.pdb.gz", "rt"):
        if line.startswith("REMARK 350   BIOMT"):
            words = line.split()
            rows.setdefault(int(words[3]), []).append([float(word) for word in words[4:8]])
        elif line[:6] in ("ATOM  ", "HETATM") and line[17:20] != "HOH":
            atoms.append([float(line[i:i + 8]) for i in (30, 38, 46)])
            elements.append(line[76:78].strip())
    atoms = np.array(atoms)
    copies = [atoms @ np.array(m)[:, :3].T + np.array(m)[:, 3] for m in rows.values()]
    return np.concatenate(copies), elements * len(copies)


class View:
    """Turns the molecule so that its long axis is level, and shades points into a picture."""

    def __init__(self, points):
        self.centre = points.mean(axis=0)
        axes = np.linalg.svd(points - self.centre, full_matrices=False)[2]
        axes[2] = np.cross(axes[0], axes[1])
        tilt = np.radians(-25)
        turn = np.array([[1, 0, 0], [0, np.cos(tilt), -np.sin(tilt)],
                         [0, np.sin(tilt), np.cos(tilt)]])
        self.axes = turn @ axes
        turned = (points - self.centre) @ self.axes.T
        self.low, self.high = turned.min(axis=0) - MARGIN, turned.max(axis=0) + MARGIN
        self.size = np.ceil((self.high - self.low)[:2] * SCALE).astype(int) * FINE

    def turn(self, vectors, shift=True):
        return (vectors - (self.centre if shift else 0)) @ self.axes.T

    def blank(self):
        width, height = self.size
        return {"depth": np.full(width * height, -np.inf), "color": np.ones((width * height, 3)),
                "normal": np.zeros((width * height, 3))}

    def draw(self, picture, points, normals, colors):
        """Adds turned points; each pixel keeps the one nearest to the eye."""
        x, y = ((points[:, :2] - self.low[:2]) * SCALE * FINE).astype(int).T
        pixel = (self.size[1] - 1 - y) * self.size[0] + x
        seen = points[:, 2] > picture["depth"][pixel]
        pixel, points, normals, colors = pixel[seen], points[seen], normals[seen], colors[seen]
        order = np.argsort(points[:, 2], kind="stable")  # of equal pixels the last one stays
        picture["depth"][pixel[order]] = points[order, 2]
        picture["normal"][pixel[order]] = normals[order]
        picture["color"][pixel[order]] = colors[order]

    def finish(self, picture):
        normal = picture["normal"]
        normal = normal / np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-9)
        lit = np.clip(normal @ LIGHT, 0, 1)
        half = (LIGHT + [0, 0, 1]) / np.linalg.norm(LIGHT + [0, 0, 1])
        shine = 0.25 * np.clip(normal @ half, 0, 1) ** 30
        near = np.clip((picture["depth"] - self.low[2]) / (self.high[2] - self.low[2]), 0, 1)
        shade = (0.42 + 0.68 * lit) * (0.55 + 0.45 * near)
        color = picture["color"] * shade[:, None] + shine[:, None]
        color[np.isinf(picture["depth"])] = 1.0
        width, height = self.size
        image = np.clip(color, 0, 1).reshape(height // FINE, FINE, width // FINE, FINE, 3)
        return image.mean(axis=(1, 3))


def draw_mesh(view, vertices, triangles, colors):
    """Every triangle that faces the eye, sampled more densely than the pixels."""
    points = view.turn(np.stack([vertices[k] for k in "xyz"], axis=1).astype(float))
    normals = view.turn(np.stack([vertices[k] for k in ("nx", "ny", "nz")], axis=1).astype(float),
                        shift=False)
    a, b, c = (points[triangles[:, k]] for k in range(3))
    facing = np.cross(b - a, c - a)[:, 2] > 0
    edges = np.stack([b - a, c - b, a - c])[:, :, :2]
    longest = np.sqrt((edges ** 2).sum(axis=2)).max(axis=0) * SCALE * FINE
    picture = view.blank()
    for n in np.unique(np.ceil(longest[facing] / 0.7).astype(int)):
        chosen = triangles[facing & (np.ceil(longest / 0.7).astype(int) == n)]
        for i in range(n + 1):
            for j in range(n + 1 - i):
                weight = np.array([i, j, n - i - j]) / n
                view.draw(picture, *((array[chosen] * weight[:, None]).sum(axis=1)
                                     for array in (points, normals, colors)))
    return view.finish(picture)


def draw_atoms(view, centres, elements):
    count = 20000
    z = 1 - (np.arange(count) + 0.5) / count  # a half sphere toward the eye, evenly covered
    angle = np.arange(count) * np.pi * (3 - np.sqrt(5))
    half = np.stack([np.sqrt(1 - z * z) * np.cos(angle), np.sqrt(1 - z * z) * np.sin(angle), z], 1)
    picture = view.blank()
    for centre, element in zip(view.turn(centres), elements):
        color = np.tile(COLORS[element], (count, 1))
        view.draw(picture, centre + RADII[element] * half, half, color)
    return view.finish(picture)


def curvature_colors(curvature, largest=0.5):
    """Blue where concave, white, orange where convex; full colour at 1/(2 Å)."""
    t = np.clip(curvature / largest, -1, 1)[:, None]
    convex, concave = np.array([0.93, 0.55, 0.20]), np.array([0.22, 0.42, 0.80])
    white = np.array([0.95, 0.95, 0.93])
    return white + np.abs(t) * (np.where(t > 0, convex, concave) - white)


def write_png(path, image):
    rows = np.rint(image * 255).astype(np.uint8)
    height, width = rows.shape[:2]
    rows[1:] -= rows[:-1].copy()  # filter 2: the difference to the row above packs well
    raw = b"".join(b"\2" + row.tobytes() for row in rows)

    def chunk(kind, data):
        return (struct.pack(">I", len(data)) + kind + data +
                struct.pack(">I", zlib.crc32(kind + data)))

    path.write_bytes(b"\x89PNG\r\n\x1a\n" +
                     chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) +
                     chunk(b"IDAT", zlib.compress(raw, 9)) + chunk(b"IEND", b""))


def main():
    if len(sys.argv) != 3:
        sys.exit("usage: make_pictures.py VDB_MOLSURF PICTURE.png")
    tool, target = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
    with tempfile.TemporaryDirectory() as folder:
        initial, relaxed = pathlib.Path(folder, "initial.ply"), pathlib.Path(folder, "relaxed.ply")
        run(tool, initial, "--max-steps", "0", status=3)
        run(tool, relaxed)
        before, after = read_ply(initial), read_ply(relaxed)
    centres, elements = read_atoms()
    view = View(centres)
    panels = [draw_atoms(view, centres, elements),
              draw_mesh(view, *before, np.tile(PLAIN, (len(before[0]), 1))),
              draw_mesh(view, *after, curvature_colors(after[0]["mean_curvature"]))]
    write_png(target, np.concatenate(panels, axis=1))


if __name__ == "__main__":
    main()
