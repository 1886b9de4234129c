#!/usr/bin/python3
# SPDX-License-Identifier: MPL-2.0
"""Lists what runs of the tests left out, and what to install for it:
    not_tested.py [--allowed LIST] FILE...
FILE is what `ctest --output-junit FILE` or `pytest --junitxml FILE` wrote. With LIST, a file of names with a line each,
a test that was left out and has no line fails, and so does a line of which there is no test."""

import argparse
import pathlib
import re
import sys
import xml.etree.ElementTree


def reasons(test):
    """Those that tests/cli/run.py, GoogleTest or pytest gave."""
    found = re.findall(r"^Not tested: (.*)$|: Skipped\n(.+)$", test.findtext("system-out", ""), re.MULTILINE)
    texts = [a or b for a, b in found] or [test.find("skipped").get("message")]
    return list(dict.fromkeys(text for text in texts if text)) or ["no reason given"]


def name_of(test):
    """cli.areas.freesasa of ctest, python.tests.test_many.test_parquet of pytest."""
    folder = test.get("classname", "")
    return f"{folder}.{test.get('name')}" if folder.startswith("python") else test.get("name")


def listed(path):
    lines = (line.split("#")[0].strip() for line in pathlib.Path(path).read_text().splitlines())
    return {line for line in lines if line}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--allowed", metavar="LIST")
    parser.add_argument("files", nargs="+", metavar="FILE")
    args = parser.parse_args()
    tests = {name_of(test): test for file in args.files for test in xml.etree.ElementTree.parse(file).getroot().iter("testcase")}
    skipped = {name: test for name, test in tests.items() if test.find("skipped") is not None}
    print(f"Not tested ({len(skipped)}):" if skipped else "Nothing was left out.")
    for name, test in skipped.items():
        print(f"  {name}: {'; '.join(reasons(test))}")
    if skipped:
        print("scripts/test.sh --all installs all programs that tests can use.")
    if not args.allowed:
        return 0
    allowed = listed(args.allowed)
    wrong = [f"{name} was left out, and {args.allowed} has no line for it" for name in skipped if name not in allowed]
    wrong += [f"{name} is in {args.allowed}, and there is no such test" for name in sorted(allowed - tests.keys())]
    for line in wrong:
        print(f"not_tested.py: {line}", file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
