#!/usr/bin/python3
# SPDX-License-Identifier: MPL-2.0
"""Holds the #include lines against the table of docs/development/architecture.md.

Prints one line for each that breaks it, and exits with 1 if there is one.
"""

import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]

# The folders of src/molsurf, kernel/, molecule/, analysis/, show/ and scale/ in their order: each may include those
# before it, if it is not named here.
FOLDERS = ["core", "grid", "balls", "structure", "selection", "spline", "levelset", "topology", "pockets", "flow", "mesh", "pipeline",
           "proximity", "measures", "color", "io", "picture", "surface", "request", "bricks", "tools"]
# The headers of the face, src/molsurf/*.h, include each other alone; each is for its folder and those behind it. (The
# function compare() of mesh.h is in surface/compare.cpp: it is for callers of the library.)
FACE = {"error.h": "core", "progress.h": "core", "ball.h": "core", "kernel.h": "flow",
        "atoms.h": "selection",  "options.h": "pockets",
        "report.h": "levelset", "mesh.h": "flow", "surface.h": "measures", "files.h": "tools",
        "bricks.h": "bricks", "settings.h": "surface", "molsurf.h": "tools"}
# The kernel, a target of its own, includes nothing else: of the face these headers.
KERNEL = {"core", "grid", "balls", "spline", "levelset", "topology", "flow", "mesh", "pipeline"}
KERNEL_FACE = {"error.h", "progress.h", "ball.h", "report.h", "mesh.h", "kernel.h"}

# Folders that know less than their place allows.
ONLY = {
    "balls": {"core"},
    "structure": {"core"},
    "selection": {"core", "balls", "structure"},
    "spline": {"core", "grid"},
    "topology": {"core", "grid", "levelset", "spline"},
    "pockets": {"core", "grid", "balls", "levelset"},
    "flow": {"core", "grid", "balls", "levelset", "spline", "topology"},
    "mesh": {"core", "grid", "levelset", "spline"},
    "pipeline": {"core", "grid", "balls", "levelset", "spline", "topology", "flow", "mesh"},
    "proximity": {"core", "grid", "levelset", "spline", "mesh"},
    "measures": KERNEL | {"structure", "selection", "pockets", "proximity"},
}

# Where a library may be included: what is not named here may be included anywhere.
LIBRARIES = {
    "gemmi/": ["src/molsurf/molecule/structure/", "src/molsurf/show/io/write_structure.cpp"],
    "nlohmann/": ["src/molsurf/show/io/", "src/molsurf/show/picture/", "src/molsurf/scale/bricks/", "src/molsurf/molecule/selection/groups.cpp",
                  "src/molsurf/molecule/structure/binary_cif.cpp"],
    "ft2build.h": ["src/molsurf/show/picture/font.cpp"],
    "embree": ["src/molsurf/analysis/proximity/embree.h"],
    "sodium": ["src/molsurf/molecule/structure/sha256.cpp"],
    "boost/program_options": ["tools/cli/parse.cpp"],
}

OPTION = re.compile(r'"[^"]*--[a-z]')  # in a text
INCLUDE = re.compile(r'\s*#\s*include\s*([<"])([^>"]+)[>"]')


def stage_of(path):
    parts = path.relative_to(ROOT).parts
    return "tools" if parts[0] == "tools" else parts[-2] if len(parts) > 3 else "face"


def complaint(path, quote, name):
    """Why `path` may not include `name`, or None."""
    stage, place = stage_of(path), path.relative_to(ROOT).as_posix()
    for library, places in LIBRARIES.items():
        if name.startswith(library) and not any(place.startswith(start) for start in places):
            return f"{library.rstrip('/')} is for {' and '.join(places)}"
    if not name.startswith("molsurf/"):
        if quote == '"' and stage != "tools":
            return "write the path from src/, \"molsurf/<stage>/...\""
        return None
    if not (ROOT / "src" / name).is_file():
        return "there is no such file"
    other = name.split("/")[-2]
    if stage in KERNEL and other not in KERNEL and name.split("/")[1] not in KERNEL_FACE:
        return "the kernel includes nothing outside of it"
    if name.count("/") == 1:
        level = FACE.get(name.split("/")[1])
        if level and (stage == "face" or FOLDERS.index(stage) >= FOLDERS.index(level)):
            return None
        return f"{stage} may not include {name}"
    if stage == "face" and path.suffix == ".cpp":
        return None
    if stage == "face":
        return "the face may not include what is private"
    if other == stage or other in ONLY.get(stage, FOLDERS[:FOLDERS.index(stage)]):
        return None
    return f"{stage} may not include {other}"


def main():
    faults = edges = 0
    sources = [path for folder in ("src", "tools") for path in (ROOT / folder).rglob("*")
               if path.suffix in (".h", ".cpp")]
    for path in sorted(sources):
        if stage_of(path) not in FOLDERS + ["face"]:
            sys.exit(f"{path.relative_to(ROOT)}: a stage that the table does not know")
        lines = path.read_text().splitlines()
        own = path.with_suffix(".h")
        if path.suffix == ".cpp" and own.exists() and own.name not in next(filter(INCLUDE.match, lines), ""):
            faults += 1
            print(f"{path.relative_to(ROOT)}: its header is not its first include, which shows that it compiles alone")
        for number, line in enumerate(lines, 1):
            match = INCLUDE.match(line)
            if not match:
                if stage_of(path) != "tools" and OPTION.search(line):
                    faults += 1
                    print(f"{path.relative_to(ROOT)}:{number}: the library knows no options of the command line")
                continue
            edges += 1
            why = complaint(path, *match.groups())
            if why:
                faults += 1
                print(f"{path.relative_to(ROOT)}:{number}: {match.group(2)}: {why}")
    print(f"layers: {edges} includes in {len(sources)} files, {faults} against the table")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
