#!/usr/bin/python3
# SPDX-License-Identifier: MPL-2.0
"""Prints the ten slowest compilations and the ten slowest tests, in seconds, so that the next slow one is seen:
    slowest.py FOLDER
FOLDER is a build folder of Ninja; tests.xml in it is what `ctest --output-junit` wrote."""

import pathlib
import sys
import xml.etree.ElementTree


def compilations(log):
    """Of each object that Ninja's log has, its last time: begin and end [ms], date, output, hash."""
    rows = (line.split("\t") for line in log.read_text().splitlines() if not line.startswith("#"))
    return {row[3]: (int(row[1]) - int(row[0])) / 1000 for row in rows if row[3].endswith((".o", ".gch"))}


def tests(results):
    return {test.get("name"): float(test.get("time"))
            for test in xml.etree.ElementTree.parse(results).getroot().iter("testcase")}


def main():
    folder = pathlib.Path(sys.argv[1])
    for what, seconds in (("compilations", compilations(folder / ".ninja_log")), ("tests", tests(folder / "tests.xml"))):
        print(f"The slowest of {len(seconds)} {what}, which took {sum(seconds.values()):.0f} s one after the other:")
        for name in sorted(seconds, key=seconds.get, reverse=True)[:10]:
            print(f"{seconds[name]:7.1f} s  {name}")


main()
