#!/usr/bin/python3
# SPDX-License-Identifier: MPL-2.0
"""Draws the pictures of README.md and docs/development/paper.md.

    scripts/make_pictures.py build-release/tools/vdb_molsurf docs/pictures [NAME ...]

Without names all of PICTURES. The surfaces and the colours are the tool's own; render.py draws
them. Needs the Debian packages python3-numpy, python3-pil and fonts-dejavu-core.
"""

import functools
import gzip
import json
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

import render

ROOT = pathlib.Path(__file__).resolve().parents[1]
DATA = ROOT / "tests" / "data"
DIMER = (DATA / "1a8o.cif.gz", "--assembly", "1")
BPTI = (DATA / "bpti.pdb.gz",)
FINE_VOXEL = ("--voxel", "0.25")
FINEST_VOXEL = ("--voxel", "0.125")

RADII = {"C": 1.70, "N": 1.55, "O": 1.52, "S": 1.80, "SE": 1.90}  # Bondi's [Å]
COLORS = {"C": (0.72, 0.75, 0.78), "N": (0.36, 0.52, 0.88), "O": (0.88, 0.36, 0.32),
          "S": (0.93, 0.79, 0.30), "SE": (0.93, 0.64, 0.28)}
PLAIN = (0.62, 0.74, 0.86)
# Blue where concave, nearly white, orange where convex.
DIVERGING = np.array([(16, 62, 122), (66, 124, 183), (158, 196, 222), (244, 243, 239),
                      (243, 190, 136), (217, 130, 55), (150, 72, 12)]) / 255


class Tool:
    def __init__(self, path, folder):
        self.path, self.folder = path, pathlib.Path(folder)

    def run(self, *words, status=0):
        call = [*map(str, [self.path, *words, "-q", "--force"])]
        done = subprocess.run(call, capture_output=True, text=True)
        if done.returncode != status:
            sys.exit(done.stderr + f"expected status {status}, got {done.returncode}")

    def mesh(self, *words, **options):
        target = self.folder / "mesh.ply"
        self.run(*words, "-o", target, **options)
        return Mesh(target)

    def difference(self, atoms, voxel, a, b, reach):
        """Surface a of the molecule, coloured by its distance from surface b, and the colours."""
        files = [self.folder / name for name in ("a.vdb", "b.vdb")]
        for path, words in zip(files, (a, b)):
            self.run(*atoms, *voxel, *words, "-o", path, "--fields", "surface,spline")
        report = self.folder / "difference.json"
        mesh = self.mesh("compare", *files, "--range", reach, "-o", report)
        stops = json.loads(report.read_text())["color"]["bar"]
        return mesh, render.ramp([np.array(stop["color"]) / 255 for stop in stops], 0, reach)


class Mesh:
    """A PLY that the tool wrote."""

    def __init__(self, path):
        header, body = path.read_bytes().split(b"end_header\n", 1)
        types = {b"float": "<f4", b"int": "<i4", b"uchar": "u1"}
        fields, counts = [], {}
        for words in map(bytes.split, header.splitlines()):
            if words[0] == b"element":
                counts[words[1]] = int(words[2])
            elif words[0] == b"property" and words[1] != b"list":
                fields.append((words[2].decode(), types[words[1]]))
        self.vertices = np.frombuffer(body, np.dtype(fields), counts[b"vertex"])
        faces = np.frombuffer(body, np.dtype([("n", "u1"), ("v", "<i4", 3)]), counts[b"face"],
                              self.vertices.nbytes)
        self.triangles = faces["v"]
        self.points, self.normals = (
            np.stack([self.vertices[name] for name in names], axis=1).astype(float)
            for names in (("x", "y", "z"), ("nx", "ny", "nz")))

    def drawn(self, view, colors):
        picture = render.Picture(view)
        if np.ndim(colors) == 1:
            colors = np.tile(colors, (len(self.points), 1))
        picture.mesh(self.points, self.normals, self.triangles, colors)
        return picture


def read_atoms(path):
    """Centres and elements in a PDB file, without waters; all copies if it has operators."""
    rows, atoms, elements = {}, [], []
    for line in gzip.open(path, "rt"):
        if line.startswith("REMARK 350   BIOMT"):
            words = line.split()
            rows.setdefault(int(words[3]), []).append([float(word) for word in words[4:8]])
        elif line[:6] in ("ATOM  ", "HETATM") and line[17:20] != "HOH":
            atoms.append([float(line[i:i + 8]) for i in (30, 38, 46)])
            elements.append(line[76:78].strip() or line[12:14].strip())
    atoms = np.array(atoms)
    copies = [atoms @ np.array(m)[:, :3].T + np.array(m)[:, 3] for m in rows.values()] or [atoms]
    return np.concatenate(copies), elements * len(copies)


def frame(path, scale, **options):
    """The view of a molecule, the same for all its surfaces."""
    centres, elements = read_atoms(path)
    return render.View(centres, scale, max(RADII.values()), **options)


def draw_atoms(view, path):
    centres, elements = read_atoms(path)
    picture = render.Picture(view)
    picture.balls(centres, [RADII[e] for e in elements], [COLORS[e] for e in elements])
    return picture


def curvature_bar(width, name, unit, colors, largest):
    return render.bar(width, f"{name} [{unit}]", colors, -largest, largest,
                      [(-largest, f"−{largest:g}"), (0, "0"), (largest, f"+{largest:g}")])


def dimer(tool, path):
    """Atoms, initial surface, and relaxed surface coloured by mean curvature."""
    before = tool.mesh(*DIMER, *FINEST_VOXEL, "--max-steps", "0", status=3)
    after = tool.mesh(*DIMER, *FINEST_VOXEL)
    view = frame(DATA / "1a8o.pdb.gz", 7.5)
    colors = render.ramp(DIVERGING, -0.6, 0.6)
    panels = [draw_atoms(view, DATA / "1a8o.pdb.gz"), before.drawn(view, PLAIN),
              after.drawn(view, colors(after.vertices["mean_curvature"]))]
    render.strip(path, [render.pixels(view, panel.light()) for panel in panels],
                 ["atoms", "initial surface", "relaxed surface"],
                 [None, None, curvature_bar(400, "mean curvature", "1/Å", colors, 0.6)])


def balls_and_surface(tool, path):
    """Van der Waals balls, the surface, and both."""
    mesh = tool.mesh(*BPTI, *FINE_VOXEL)
    view = frame(BPTI[0], 11.0, tilt=0)
    atoms, surface = draw_atoms(view, BPTI[0]), mesh.drawn(view, PLAIN)
    inside, outside = atoms.light(), surface.light()
    both = render.over(outside, surface.fresnel(), inside)
    render.strip(path, [render.pixels(view, image) for image in (inside, outside, both)],
                 ["van der Waals balls", "variational surface", "both"])


class Molecule:
    """A molecule of the paper, with the voxels of its pictures and their scale [pixel/Å]."""

    def __init__(self, words, atoms, scale, fine, finest):
        self.words, self.fine, self.finest = words, fine, finest
        self.view = lambda: frame(DATA / atoms, scale)


A8O = Molecule(DIMER, "1a8o.pdb.gz", 8.0, FINE_VOXEL, FINEST_VOXEL)
AT1 = Molecule((DATA / "4at1.ent.gz",), "4at1.ent.gz", 3.3, ("--voxel", "0.5"), FINE_VOXEL)


def differences(tool, path, molecule=A8O):
    """How far the solvent-excluded and the Gaussian surface are from the variational one."""
    reach, panels = 1.5, []
    view = molecule.view()
    for kind in ("ses", "gaussian"):
        mesh, colors = tool.difference(molecule.words, molecule.fine, ("--surface", kind), (), reach)
        panels.append(mesh.drawn(view, colors(mesh.vertices["distance"])))
    ticks = [(0, "0"), (0.5, "0.5"), (1, "1"), (1.5, "≥ 1.5")]
    render.strip(path, [render.pixels(view, panel.light(flat=0.35)) for panel in panels],
                 ["solvent-excluded surface", "Gaussian surface"],
                 [render.bar(500, "distance from the variational surface [Å]", colors, 0, reach,
                             ticks)])


def curvatures(tool, path, molecule=A8O):
    """Mean and Gaussian curvature of the variational surface."""
    mesh = tool.mesh(*molecule.words, *molecule.finest)
    view = molecule.view()
    panels, bars = [], []
    for name, unit, largest in (("mean", "1/Å", 0.6), ("Gaussian", "1/Å²", 0.4)):
        colors = render.ramp(DIVERGING, -largest, largest)
        panel = mesh.drawn(view, colors(mesh.vertices[f"{name.lower()}_curvature"]))
        panels.append(render.pixels(view, panel.light()))
        bars.append(curvature_bar(panels[-1].width, f"{name} curvature", unit, colors, largest))
    render.strip(path, panels, (), bars)


def ligand(tool, path):
    """ATP bound to ATCase, in a colour of its own: a picture of the tool's."""
    groups = tool.folder / "groups"
    groups.write_text("ATP (ATP) #d55e00\n")
    tool.run(*AT1.words, "--groups", groups, "--color", "group", "--view", "-0.74,0.62,-0.19",
             "--size", 500, "--legend", "off", "-o", path)


PICTURES = {"1a8o": dimer, "bpti": balls_and_surface, "difference": differences,
            "curvature": curvatures,
            "4at1_atp": ligand, "4at1_difference": functools.partial(differences, molecule=AT1),
            "4at1_curvature": functools.partial(curvatures, molecule=AT1)}


def main():
    names = sys.argv[3:] or list(PICTURES)
    if len(sys.argv) < 3 or not set(names) <= set(PICTURES):
        sys.exit("usage: make_pictures.py VDB_MOLSURF FOLDER [" + "] [".join(PICTURES) + "]")
    for name in names:
        with tempfile.TemporaryDirectory() as folder:
            tool = Tool(pathlib.Path(sys.argv[1]).resolve(), folder)
            PICTURES[name](tool, pathlib.Path(sys.argv[2], name + ".png"))


if __name__ == "__main__":
    main()
