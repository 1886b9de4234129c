#!/usr/bin/python3
# SPDX-License-Identifier: MPL-2.0
"""Measures how true the curvature of a surface is, by the same surface on finer voxels.

    bench/specks.py PROGRAM STRUCTURE [--json FILE] [options of the program ...]

The surface is built at 0.5, 0.25 and 0.125 Å. For the first two it prints the share of vertices whose mean curvature
is off that of the nearest vertex at 0.125 Å by more than 0.1/Å and by more than 0.5/Å; for all of them the share of
the area where |H| exceeds 2/Å, the range of H, area, volume, and the integral of the vertices' Gaussian curvature over
2 pi times the Euler characteristic, which is 1 for a perfect one. FILE gets the shares that are off by 0.1/Å and that
exceed 2/Å, in per cent, as lists with the coarsest surface first. Needs numpy.
"""

import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

import numpy


def read(path):
    """Positions, H, K and the area of each vertex of a binary .ply of the program."""
    data = path.read_bytes()
    end = data.index(b"end_header\n") + 11
    kinds = {"float": "<f4", "int": "<i4", "uchar": "u1", "uint": "<u4"}
    counts, fields = {}, []
    for line in data[:end].decode().splitlines():
        words = line.split()
        if words[0] == "element":
            counts[words[1]] = int(words[2])
        elif words[0] == "property" and words[1] != "list":
            fields.append((words[2], kinds[words[1]]))
    vertices = numpy.frombuffer(data, numpy.dtype(fields), counts["vertex"], end)
    faces = numpy.frombuffer(data, numpy.dtype([("n", "u1"), ("v", "<i4", 3)]), counts["face"],
                             end + vertices.nbytes)["v"]
    x = numpy.stack([vertices[c] for c in "xyz"], 1).astype(float)
    twice = numpy.linalg.norm(numpy.cross(x[faces[:, 1]] - x[faces[:, 0]], x[faces[:, 2]] - x[faces[:, 0]]), axis=1)
    area = numpy.zeros(len(x))
    for k in range(3):
        numpy.add.at(area, faces[:, k], twice / 6.0)
    return x, vertices["mean_curvature"].astype(float), vertices["gaussian_curvature"].astype(float), area


def nearest(points, of):
    """For each of some points the nearest of others, which lie within an Å or so."""
    edge = 0.5
    shift = of.min(0) - 2.0

    def keys(x):
        cell = ((x - shift) / edge).astype(numpy.int64)
        return cell[:, 0] * 10**12 + cell[:, 1] * 10**6 + cell[:, 2]

    order = numpy.argsort(keys(of), kind="stable")
    sorted_keys = keys(of)[order]
    best = numpy.full(len(points), numpy.inf)
    index = numpy.zeros(len(points), int)
    steps = [(i, j, k) for i in (-1, 0, 1) for j in (-1, 0, 1) for k in (-1, 0, 1)]
    for step in steps:
        wanted = keys(points + edge * numpy.array(step))
        low, high = (numpy.searchsorted(sorted_keys, wanted, side) for side in ("left", "right"))
        for offset in range(int((high - low).max(initial=0))):
            has = numpy.nonzero(low + offset < high)[0]
            other = order[low[has] + offset]
            d = ((points[has] - of[other])**2).sum(1)
            nearer = d < best[has]
            best[has[nearer]] = d[nearer]
            index[has[nearer]] = other[nearer]
    return index


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("structure")
    parser.add_argument("--json", type=pathlib.Path, metavar="FILE", help="off and sharp: lists")
    args, words = parser.parse_known_args()
    rows, shares = {}, {"off": [], "sharp": []}
    with tempfile.TemporaryDirectory() as folder:
        for voxel in (0.125, 0.25, 0.5):
            ply, report = pathlib.Path(folder) / "a.ply", pathlib.Path(folder) / "a.json"
            done = subprocess.run([args.program, args.structure, "--voxel", str(voxel), "-o", ply, "-o", report, "--force", "-q",
                                   *words], check=False)
            if done.returncode not in (0, 3):
                sys.exit(f"{args.program}: status {done.returncode}")
            rows[voxel] = (*read(ply), json.loads(report.read_text())["surface"])
    fine = rows[0.125]
    print("voxel  off 0.1  off 0.5  |H| > 2  H from  to      area       volume     Euler  integral of K")
    for voxel, (x, H, K, area, surface) in sorted(rows.items(), reverse=True):
        off = abs(H - fine[1][nearest(x, fine[0])])
        euler = surface["euler_characteristic"]
        shares["off"].append(100 * (off > 0.1).mean())
        shares["sharp"].append(100 * area[abs(H) > 2].sum() / area.sum())
        print(f"{voxel:5}  {shares['off'][-1]:6.2f} %{100 * (off > 0.5).mean():8.2f} %"
              f"{shares['sharp'][-1]:8.3f} %{H.min():7.2f} {H.max():7.2f}"
              f"{surface['area']:11.1f}{surface['volume']:12.1f}{euler:7}"
              f"{(K * area).sum() / (2 * numpy.pi * euler):10.4f}")
    if args.json:
        args.json.write_text(json.dumps(shares))


if __name__ == "__main__":
    main()
