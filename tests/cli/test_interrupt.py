# SPDX-License-Identifier: MPL-2.0
"""A signal ends the run within a second, with status 130 and without leftovers."""

import signal
import subprocess
import time
import unittest

from tool import CRAMBIN, TOOL, ToolTest

# Long enough to be still at work at the last of the moments below.
LONG = ["--voxel", "0.06", "--tolerance", "1e-12", "--fields", "all"]
MOMENTS = (0.3, 1.0, 2.5)  # seconds after the start
GRACE = 10.0  # seconds to the end; a loaded machine takes more than the usual tenth


class Interrupt(ToolTest):
    def interrupt(self, number, after):
        (self.folder / "a.ply").write_text("old")
        command = [TOOL, CRAMBIN, "-o", "a.vdb", "-o", "a.ply", "--force", *LONG]
        process = subprocess.Popen(command, cwd=self.folder, stderr=subprocess.PIPE)
        try:
            time.sleep(after)
            self.assertIsNone(process.poll(), "the run ended before the signal came")
            start = time.monotonic()
            process.send_signal(number)
            error = process.communicate(timeout=30)[1].decode()
            elapsed = time.monotonic() - start
        finally:
            process.kill()
            process.communicate()
        self.assertEqual(process.returncode, 130, error)
        self.assertLess(elapsed, GRACE)
        self.assertIn("interrupted", error)
        self.assertEqual(self.names(), ["a.ply"])
        self.assertEqual((self.folder / "a.ply").read_text(), "old")

    def test_ctrl_c(self):
        for after in MOMENTS:
            with self.subTest(after=after):
                self.interrupt(signal.SIGINT, after)

    def test_terminate(self):
        self.interrupt(signal.SIGTERM, 0.5)


if __name__ == "__main__":
    unittest.main()
