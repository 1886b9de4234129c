#!/usr/bin/python3
# SPDX-License-Identifier: MPL-2.0
"""Draws the pictures of docs/gallery.md by the commands below them.

    scripts/gallery.py build-release/tools/vdb_molsurf [NAME ...]

Without names all of them. Look at them before you commit. scripts/check_docs.py --figures draws them elsewhere and
compares.
"""

import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
FOLDER = ROOT / "docs" / "pictures" / "gallery"


def commands(page):
    """The commands of each picture as words, by the name of its file; the last one draws it, others make what it takes.
    A file of groups is written by printf."""
    found = {}
    for name, block in re.findall(r"\(pictures/gallery/([\w.]+)\)\s*```sh\n(?:mkdir [^\n]*\n)?(.*?)\n```", page, re.DOTALL):
        calls = [shlex.split(line) for line in block.splitlines()]
        if any(words[0] not in ("vdb_molsurf", "printf") for words in calls) or calls[-1][-2:] != ["-o", f"gallery/{name}"]:
            sys.exit(f"gallery.py: expected vdb_molsurf ... -o gallery/{name}, got {block}")
        found[name] = calls
    return found


def draw(program, calls, path):
    (ROOT / "gallery").mkdir(exist_ok=True)  # git ignores it
    for name, *words in [*calls[:-1], [*calls[-1][:-1], path]]:
        if name == "printf":  # FORMAT > FILE
            with open(ROOT / words[-1], "w") as file:
                subprocess.run([name, *words[:-2]], stdout=file, check=True)
        else:
            subprocess.run([program, *words, "-q", "--force"], cwd=ROOT, check=True)


def faults(program):
    """A line for each picture of which more than 1 % of the pixels differ by more than 2 of 255 from a new one."""
    lines, page = [], ROOT / "docs" / "gallery.md"
    if not page.exists():
        return lines
    sys.path.insert(0, str(ROOT / "tests" / "cli"))
    os.environ["VDB_MOLSURF"] = str(program)
    from tool import read_png
    for name, calls in commands(page.read_text()).items():
        if not name.endswith(".png"):  # films depend on the version of ffmpeg
            continue
        with tempfile.TemporaryDirectory() as folder:
            new = pathlib.Path(folder) / "new.png"
            draw(program, calls, new)
            (width, rows), (old_width, old_rows) = (read_png(p.read_bytes()) for p in (new, FOLDER / name))
        if (width, len(rows)) != (old_width, len(old_rows)):
            lines.append(f"docs/pictures/gallery/{name}: {old_width} x {len(old_rows)} pixels, new ones {width} x {len(rows)}")
            continue
        far = sum(any(abs(row[x + i] - old[x + i]) > 2 for i in range(3))
                  for row, old in zip(rows, old_rows) for x in range(0, 3 * width, 3))
        if far > 0.01 * width * len(rows):
            lines.append(f"docs/pictures/gallery/{name}: {100 * far / width / len(rows):.1f} % of the pixels are not as drawn now")
    return lines


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
        draw(program, known[name], FOLDER / name)


if __name__ == "__main__":
    main()
