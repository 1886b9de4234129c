#!/usr/bin/python3
# SPDX-License-Identifier: MPL-2.0
"""scripts/not_tested.py: tests that were left out are those of a list."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
RESULTS = """<testsuites><testsuite>
<testcase name="cli.areas"/>
<testcase name="cli.films.ffmpeg"><skipped/><system-out>Not tested: needs ffmpeg</system-out></testcase>
<testcase classname="python.tests.test_many" name="test_dask"><skipped message="could not import 'distributed'"/></testcase>
</testsuite></testsuites>"""


class LeftOut(unittest.TestCase):
    def judged(self, *lines):
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            (folder / "a.xml").write_text(RESULTS)
            (folder / "list").write_text("".join(line + "\n" for line in lines))
            done = subprocess.run([sys.executable, ROOT / "scripts" / "not_tested.py", "--allowed", folder / "list", folder / "a.xml"],
                                  capture_output=True, text=True)
            return done.returncode, done.stdout, done.stderr

    def test_a_list_of_all_passes(self):
        status, said, wrong = self.judged("# why", "cli.films.ffmpeg", "python.tests.test_many.test_dask  # dask")
        self.assertEqual((status, wrong), (0, ""))
        self.assertIn("cli.films.ffmpeg: needs ffmpeg", said)
        self.assertIn("could not import 'distributed'", said)

    def test_a_test_that_is_missing_in_the_list_fails(self):
        status, _, wrong = self.judged("cli.films.ffmpeg")
        self.assertEqual(status, 1)
        self.assertIn("python.tests.test_many.test_dask was left out", wrong)

    def test_a_line_without_a_test_fails(self):
        status, _, wrong = self.judged("cli.films.ffmpeg", "python.tests.test_many.test_dask", "cli.gone")
        self.assertEqual(status, 1)
        self.assertIn("cli.gone is in ", wrong)

    def test_a_test_that_runs_may_have_a_line(self):
        self.assertEqual(self.judged("cli.films.ffmpeg", "python.tests.test_many.test_dask", "cli.areas")[0], 0)


if __name__ == "__main__":
    unittest.main()
