#!/usr/bin/env python3
# SPDX-License-Identifier: MPL-2.0
"""Holds the sizes of Debian's packages that README.md and docs/install.md print against what apt loaded.

    scripts/check_sizes.py LOG

LOG is what .ci/run prints of a fresh machine. The pages say "loads N MB of Debian's packages" of scripts/example.sh, with
"M MB on disk", and "another N MB" of scripts/test.sh; each has to be within 5 % of apt's. Without a line of apt, as
where the packages were there before, nothing is compared.
"""

import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
UNITS = {"B": 1e-6, "kB": 1e-3, "MB": 1.0, "GB": 1e3}
# "Need to get 2 MB/156 MB": the second one is the whole, without what a cache has.
APT = re.compile(r"Need to get (?:[\d.,]+ (?:\wB|B)/)?([\d.,]+) (\wB|B) of archives\.\s+After this operation, ([\d.,]+) (\wB|B) of")


def loaded(log):
    """{command: [MB to load, MB on disk]} of the commands of a fresh machine."""
    found = {}
    for part in re.split(r"^== fresh machine: ", log, flags=re.M)[1:]:
        command = part.split("\n", 1)[0]
        for get, unit, disk, other in APT.findall(part):
            sums = found.setdefault(command, [0.0, 0.0])
            sums[0] += float(get.replace(",", "")) * UNITS[unit]
            sums[1] += float(disk.replace(",", "")) * UNITS[other]
    return found


def printed(text):
    """The sizes of a page in words: of the first command, on disk, of the second command."""
    text = " ".join(text.split())
    first = re.search(r"loads (\d+) MB of Debian's packages \((\d+) MB on disk\)", text)
    second = re.search(r"another (\d+) MB", text)
    return [int(first[1]), int(first[2]), int(second[1])] if first and second else None


def main():
    sizes = loaded(pathlib.Path(sys.argv[1]).read_text(errors="replace"))
    example, test = sizes.get("scripts/example.sh"), sizes.get("scripts/test.sh")
    if not example or not test:
        print("sizes: apt loaded nothing; the pages were not compared")
        return 0
    wrong = 0
    for name in ("README.md", "docs/install.md"):
        said = printed((ROOT / name).read_text())
        if not said:
            print(f"{name}: expected 'loads N MB of Debian's packages (M MB on disk)' and 'another N MB'")
            wrong += 1
            continue
        for what, own, apt in zip(("scripts/example.sh loads", "on disk", "scripts/test.sh loads"), said,
                                  (*example, test[0])):
            if abs(own - apt) > 0.05 * apt:
                print(f"{name}: {what} {own} MB, apt {apt:.0f} MB")
                wrong += 1
    print(f"sizes: {example[0]:.0f} MB loaded, {example[1]:.0f} MB on disk, another {test[0]:.0f} MB; {wrong} faults")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
