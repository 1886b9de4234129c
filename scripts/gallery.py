#!/usr/bin/python3
# SPDX-License-Identifier: MPL-2.0
"""Draws the pictures of docs/gallery.md by the commands that stand under them.

    scripts/gallery.py build-release/tools/vdb_molsurf [NAME ...]

Without names all of them. Look at them before you commit.
"""

import pathlib
import re
import shlex
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
FOLDER = ROOT / "docs" / "pictures" / "gallery"


def commands(page):
    """The words of the command of each picture, by the picture's name."""
    found = {}
    for name, command in re.findall(r"\(pictures/gallery/(\w+)\.png\)\s*```sh\n(.*?)\n```", page, re.DOTALL):
        words = shlex.split(command)
        if words[0] != "vdb_molsurf" or words[-2:] != ["-o", f"{name}.png"]:
            sys.exit(f"gallery.py: expected vdb_molsurf ... -o {name}.png, got {command}")
        found[name] = words[1:-1]
    return found


def main():
    if len(sys.argv) < 2:
        sys.exit("usage: gallery.py VDB_MOLSURF [NAME ...]")
    program = pathlib.Path(sys.argv[1]).resolve()
    known = commands((ROOT / "docs" / "gallery.md").read_text())
    names = sys.argv[2:] or list(known)
    if not set(names) <= set(known):
        sys.exit("gallery.py: expected some of " + ", ".join(known))
    FOLDER.mkdir(parents=True, exist_ok=True)
    for name in names:
        subprocess.run([program, *known[name], FOLDER / f"{name}.png", "-q", "--force"], cwd=ROOT, check=True)


if __name__ == "__main__":
    main()
