#!/usr/bin/python3
# SPDX-License-Identifier: MPL-2.0
"""Lists what a run of the tests left out, and what to install for it:
    not_tested.py FILE
FILE is what `ctest --output-junit FILE` wrote."""

import re
import sys
import xml.etree.ElementTree


def reasons(output):
    """Those that tests/cli/run.py or GoogleTest printed."""
    found = re.findall(r"^Not tested: (.*)$|: Skipped\n(.+)$", output, re.MULTILINE)
    return list(dict.fromkeys(a or b for a, b in found)) or ["no reason given"]


def main():
    tests = xml.etree.ElementTree.parse(sys.argv[1]).getroot().iter("testcase")
    skipped = [test for test in tests if test.find("skipped") is not None]
    if not skipped:
        print("Nothing was left out.")
        return
    print(f"Not tested ({len(skipped)}):")
    for test in skipped:
        print(f"  {test.get('name')}: {'; '.join(reasons(test.findtext('system-out', '')))}")
    print("scripts/test.sh --all installs all programs that tests can use.")


main()
