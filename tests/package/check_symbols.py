#!/usr/bin/python3
# SPDX-License-Identifier: MPL-2.0
"""Checks what the shared library shows: the functions that the headers of the face declare, and nothing else.

    tests/package/check_symbols.py LIBRARY FOLDER_OF_HEADERS

The face has at most 13 headers, one of them the kernel's, and at most 107 names.
"""

import pathlib
import re
import subprocess
import sys

MOST_HEADERS, MOST_NAMES = 13, 107


def declared(text):
    """The types, functions and constants that a header declares in the namespace itself."""
    text = re.sub(r"//[^\n]*|/\*.*?\*/", " ", text, flags=re.DOTALL)
    body = text[text.index("namespace molsurf"):] if "namespace molsurf" in text else ""
    names, depth = set(), 0
    for part in re.split(r"([{};])", body[body.find("{") + 1:]):
        if depth == 0 and part not in "{};":
            found = re.search(r"\b(?:struct|class|enum class)\s+(\w+)", part) or re.search(r"(\w+)\s*\([^()]*", part)
            constants = re.findall(r"(\w+) = ", part) if "constexpr" in part else []
            names.update(constants or ([found[1]] if found else []))
        depth += {"{": 1, "}": -1}.get(part, 0)
        if depth < 0:
            break
    return names


def main():
    library, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    headers = sorted(folder.glob("*.h"))
    names = set().union(*(declared(header.read_text()) for header in headers))
    lines = subprocess.run(["nm", "-DC", "--defined-only", library], capture_output=True, text=True, check=True).stdout
    shown = [line.split(maxsplit=2)[2] for line in lines.splitlines() if len(line.split(maxsplit=2)) == 3]
    shown = [re.sub(r"\[abi:\w+\]", "", name) for name in shown]
    faults = []
    if len(headers) > MOST_HEADERS:
        faults.append(f"{len(headers)} headers, expected {MOST_HEADERS} at most")
    if len(names) > MOST_NAMES:
        faults.append(f"{len(names)} names, expected {MOST_NAMES} at most")
    for name in shown:
        found = re.match(r"(?:typeinfo (?:name )?for |vtable for )?molsurf::(\w+)", name)
        if not (found and found[1] in names):
            faults.append(f"{name} is shown, and no header of the face declares it")
        elif re.search(r"OutputFile|GridBase const>|Operand", name):
            faults.append(f"{name} is shown, and takes what is private")
    for name in ("makeSurface", "readAtoms", "writeMesh", "compare", "mergeBricks"):
        if not any(f"molsurf::{name}(" in symbol for symbol in shown):
            faults.append(f"{name}() is not shown")
    print(f"{len(headers)} headers, {len(names)} names, {len(shown)} symbols")
    print("\n".join(faults))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
