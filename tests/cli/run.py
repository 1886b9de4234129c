# SPDX-License-Identifier: MPL-2.0
"""Runs a file of tests, or a part of it:
    run.py TOPIC [--only NEED... | --without [NEED...]]
See needs.py. The status is 77 if tests were skipped and none failed. --without names every need of the file: a test of
another need would skip the whole where that is missing, and fails here."""

import argparse
import sys
import unittest

from needs import NEEDS, need_of

SKIPPED = 77


def each(tests):
    for test in tests:
        if isinstance(test, unittest.TestSuite):
            yield from each(test)
        else:
            yield test


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("topic")
    parser.add_argument("--only", nargs="+", choices=NEEDS)
    parser.add_argument("--without", nargs="*", choices=NEEDS, default=[])
    words = parser.parse_args()
    tests = [test for test in each(unittest.defaultTestLoader.loadTestsFromName(f"test_{words.topic}"))
             if (need_of(test) in words.only if words.only else need_of(test) not in words.without)]
    unnamed = {need_of(test) for test in tests} - {None} - set(words.only or [])
    if unnamed:
        sys.exit(f"CMakeLists.txt: cli_test({words.topic} ...): expected the needs {' '.join(sorted(unnamed))} too")
    if not tests:
        sys.exit("there are no such tests")
    result = unittest.TextTestRunner().run(unittest.TestSuite(tests))
    for reason in dict.fromkeys(reason for _, reason in result.skipped):
        print("Not tested:", reason)
    sys.exit(1 if not result.wasSuccessful() else SKIPPED if result.skipped else 0)


main()
