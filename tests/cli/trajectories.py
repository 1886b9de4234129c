# SPDX-License-Identifier: MPL-2.0
"""Trajectories as other programs write them."""

import struct


def dcd(frames, order="<", cell=False, fixed=(), promised=None, marker="i", fourth=False):
    """A DCD file as CHARMM writes it; with markers of 8 bytes, q, as some compilers have it."""
    def record(content):
        mark = struct.pack(order + marker, len(content))
        return mark + content + mark

    atoms = len(frames[0])
    control = [0] * 20
    control[0] = len(frames) if promised is None else promised
    control[8], control[10], control[11], control[19] = len(fixed), int(cell), int(fourth), 24
    data = record(b"CORD" + struct.pack(order + "20i", *control))
    data += record(struct.pack(order + "i", 1) + b"made by a test".ljust(80))
    data += record(struct.pack(order + "i", atoms))
    free = [i for i in range(atoms) if i not in fixed]
    if fixed:
        data += record(struct.pack(f"{order}{len(free)}i", *(i + 1 for i in free)))
    for n, frame in enumerate(frames):
        some = frame if n == 0 or not fixed else [frame[i] for i in free]
        if cell:
            data += record(struct.pack(order + "6d", 50, 90, 50, 90, 90, 50))
        for axis in range(3):
            data += record(struct.pack(f"{order}{len(some)}f", *(x[axis] for x in some)))
        if fourth:
            data += record(struct.pack(f"{order}{len(some)}f", *[7.5] * len(some)))
    return data


def trr(frames, width="f", velocities=False, extra=(), version=b"GMX_trn_file", cell=True):
    """A TRR file as GROMACS writes it, in nanometres; frames of velocities alone where `extra` says."""
    atoms, size = len(frames[0]), struct.calcsize(width)
    data = b""
    for n, frame in enumerate(frames):
        for has in ((False, True) if n in extra else (True,)):
            x = b"".join(struct.pack(f">3{width}", *(value / 10 for value in at)) for at in frame) if has else b""
            v = struct.pack(f">{3 * atoms}{width}", *[0.25] * 3 * atoms) if velocities or not has else b""
            box = struct.pack(f">9{width}", *[5] * 9) if cell else b""
            data += struct.pack(">3i", 1993, len(version) + 1, len(version)) + version.ljust((len(version) + 3) // 4 * 4, b"\0")
            data += struct.pack(">13i", 0, 0, len(box), 0, 0, 0, 0, len(x), len(v), 0, atoms, n, 0)
            data += struct.pack(f">2{width}", 0.0, 0.0) + box + x + v
    return data


def netcdf(frames, version=1, width="f", scale=None, promised=None, restart=False):
    """A NetCDF file as Amber writes it, with times before the coordinates and velocities behind them."""
    offset, count = ">i" if version == 1 else ">q", ">q" if version == 5 else ">i"
    atoms, size = len(frames[0]), struct.calcsize(width)

    def text(name):
        return struct.pack(count, len(name)) + name.encode().ljust((len(name) + 3) // 4 * 4, b"\0")

    def variable(name, dimensions, size, begin, attributes=b""):
        of = {"f": 5, "d": 6}[width]
        return (text(name) + struct.pack(count, len(dimensions)) + b"".join(struct.pack(count, d) for d in dimensions) +
                (attributes or struct.pack(">i", 0) + struct.pack(count, 0)) +
                struct.pack(">i", of) + struct.pack(count, size) + struct.pack(offset, begin))

    scaled = b""
    if scale is not None:
        scaled = (struct.pack(">i", 12) + struct.pack(count, 2) + text("units") + struct.pack(">i", 2) + text("angstrom") +
                  text("scale_factor") + struct.pack(">i", 5) + struct.pack(count, 1) + struct.pack(">f", scale))
    records = 0 if restart else len(frames) if promised is None else promised
    front = b"CDF" + bytes([version]) + struct.pack(count, records)
    front += struct.pack(">i", 10) + struct.pack(count, 3)
    for name, length in (("frame", 0), ("spatial", 3), ("atom", atoms)):
        front += text(name) + struct.pack(count, length)
    front += struct.pack(">i", 12) + struct.pack(count, 1) + text("Conventions") + struct.pack(">i", 2) + text("AMBER")
    axes = [2, 1] if restart else [0, 2, 1]
    body = 3 * atoms * size

    def variables(begin):
        return (struct.pack(">i", 11) + struct.pack(count, 3) + variable("time", [] if restart else [0], size, begin) +
                variable("coordinates", axes, body, begin + size, scaled) + variable("velocities", axes, body, begin + size + body))
    data = front + variables(len(front) + len(variables(0)))
    for frame in frames:
        data += struct.pack(f">{width}", 1.0)
        data += b"".join(struct.pack(f">3{width}", *(value / (scale or 1) for value in at)) for at in frame)
        data += struct.pack(f">{3 * atoms}{width}", *[0.5] * 3 * atoms)
    return data
