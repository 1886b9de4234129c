# SPDX-License-Identifier: MPL-2.0
"""Pipes from and to an object store: the block of docs/pipelines.md beside moto's stand-in for S3."""

import os
import re
import socket
import subprocess
import time
import unittest

from needs import needs
from tool import CRAMBIN, ROOT, TOOL, ToolTest


@needs("s3")
class Stores(ToolTest):
    def setUp(self):
        super().setUp()
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            port = free.getsockname()[1]
        server = subprocess.Popen(["moto_server", "-p", str(port)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.addCleanup(server.wait)
        self.addCleanup(server.kill)
        self.environment = {**os.environ, "AWS_ACCESS_KEY_ID": "x", "AWS_SECRET_ACCESS_KEY": "x", "AWS_DEFAULT_REGION": "us-east-1",
                            "AWS_ENDPOINT_URL": f"http://127.0.0.1:{port}",
                            "PATH": f"{os.path.dirname(os.path.realpath(TOOL))}:{os.environ['PATH']}"}
        for _ in range(100):
            if self.bash("aws s3 mb s3://bucket").returncode == 0:
                return
            time.sleep(0.2)
        self.fail("moto_server does not start")

    def bash(self, text):
        return subprocess.run(["bash", "-c", text], env=self.environment, cwd=self.folder, capture_output=True, timeout=200)

    def test_the_pipes_of_the_page(self):
        page = (ROOT / "docs" / "pipelines.md").read_text()
        block = re.search(r"test_stores.py -->\n\n```bash\n(.*?)```", page, re.DOTALL)[1]
        self.assertEqual(self.bash(f"aws s3 cp {CRAMBIN} s3://bucket/1crn.pdb").returncode, 0)
        done = self.bash(block)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.check(0, CRAMBIN, "-o", "1crn.glb")
        stored = self.bash("aws s3 cp s3://bucket/1crn.glb -").stdout
        name = lambda glb: glb.replace(b'"surface"', b'"1crn"')  # of the node: a stream has none of its own
        self.assertEqual(len(stored) // 100, (self.folder / "1crn.glb").stat().st_size // 100)
        self.assertEqual(name(stored)[-10000:], (self.folder / "1crn.glb").read_bytes()[-10000:])
        missing = self.bash(block.replace("1crn.pdb", "none.pdb"))
        self.assertNotEqual(missing.returncode, 0)
        self.assertIn(b"standard input: is empty", missing.stderr)


if __name__ == "__main__":
    unittest.main()
