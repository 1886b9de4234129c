# SPDX-License-Identifier: MPL-2.0
"""The page of -o view.html: what it holds, and that a browser shows it."""

import base64
import json
import re
import subprocess
import unittest
import zlib

from needs import CHROMIUM, needs
from tool import CRAMBIN, DATA, FAST, ToolTest, read_ply, read_png

DIMER = [DATA / "1a8o.cif.gz", "--assembly", "1"]


def element(page, name):
    return re.search(rf'<script [^>]*id="{name}">(.*?)</script>', page, re.DOTALL)[1]


def unpacked(data, table):
    count, parts, width = table["count"], table["components"], table["width"]
    columns = []
    for c in range(parts):
        at = table["offset"] + c * width * count
        last, column = 0, []
        for i in range(count):
            step = sum(data[at + w * count + i] << 8 * w for w in range(width))
            last = (last + step) % (1 << 8 * width)
            column.append(last)
        columns.append(column)
    return list(zip(*columns))


class Page(ToolTest):
    def page(self, *words):
        self.check(0, *words, "-o", "a.html", "-o", "a.ply", "--force")
        return (self.folder / "a.html").read_text()

    def test_holds_the_mesh(self):
        page = self.page(*DIMER, *FAST)
        header = json.loads(element(page, "header"))
        data = zlib.decompress(base64.b64decode(element(page, "data")))
        arrays = {table["name"]: unpacked(data, table) for table in header["arrays"]}
        names, vertices, triangles = read_ply((self.folder / "a.ply").read_bytes())
        corners = [i for i, in arrays["index"]]
        self.assertEqual([tuple(corners[i:i + 3]) for i in range(0, len(corners), 3)], triangles)
        low = [min(v[i] for v in vertices) for i in range(3)]
        high = [max(v[i] for v in vertices) for i in range(3)]
        step = header["levels"][0]["step"]
        self.assertLess(step, 0.002)
        for q, v in zip(arrays["position"], vertices):
            for i in range(3):
                x = (q[i] - 32767.5) * step + (low[i] + high[i]) / 2
                self.assertLess(abs(x - v[i]), step)
        self.assertEqual([m["id"] for m in header["modes"]],
                         ["chain", "mean-curvature", "gaussian-curvature", "none"])
        chain, mean = header["modes"][:2]
        self.assertEqual([e["name"] for e in chain["entries"]], ["A", "A-2"])
        self.assertEqual(arrays["chain_id"], [(v[names.index("chain_id")],) for v in vertices])
        self.assertEqual(mean["unit"], "1/Å")
        column = names.index("mean_curvature")
        for (place,), v in zip(arrays["mean_curvature"], vertices):
            want = (v[column] - mean["low"]) / (mean["high"] - mean["low"])
            self.assertLess(abs(place / 255 - min(max(want, 0), 1)), 0.003)

    def test_needs_nothing_else(self):
        page = self.page(CRAMBIN, *FAST)
        self.assertNotRegex(page, r"<(?:script|link|img)[^>]+(?:src|href)=")
        self.assertIn("The MIT License", page)

    def test_asked_colors_come_first(self):
        (self.folder / "g").write_text("<b>&</b> /1/A/1-20\nlast /1/A/21-46\n")
        header = json.loads(element(self.page(CRAMBIN, *FAST, "--groups", "g", "--color", "element"),
                                    "header"))
        self.assertEqual([m["id"] for m in header["modes"]],
                         ["element", "chain", "group", "mean-curvature", "gaussian-curvature",
                          "none"])
        self.assertEqual({e["name"] for e in header["modes"][0]["entries"]}, {"C", "N", "O", "S"})
        self.assertEqual([e["name"] for e in header["modes"][2]["entries"]], ["<b>&</b>", "last"])

    def test_size(self):
        self.page(*DIMER)
        viewer = 600_000
        mesh = (self.folder / "a.html").stat().st_size - viewer
        self.assertLess(mesh, 0.3 * (self.folder / "a.ply").stat().st_size)

    @needs("chromium")
    def test_in_a_browser(self):
        self.page(*DIMER, "--color", "chain")
        for mode, colors in (("", ((86, 180, 233), (230, 159, 0))),
                             ("mean-curvature", ((178, 24, 43), (33, 102, 172)))):
            with self.subTest(mode):
                url = f"file://{self.folder}/a.html" + (f"?color={mode}" if mode else "")
                done = subprocess.run(
                    [CHROMIUM, "--headless=new", "--no-sandbox", "--disable-gpu-sandbox",
                     "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
                     "--enable-logging=stderr", "--window-size=800,600", "--hide-scrollbars",
                     f"--user-data-dir={self.folder / 'profile'}", "--virtual-time-budget=8000",
                     "--run-all-compositor-stages-before-draw",
                     f"--screenshot={self.folder / 'a.png'}", url],
                    capture_output=True, text=True, timeout=120)
                self.assertEqual(done.returncode, 0, done.stderr)
                said = [line for line in done.stderr.splitlines() if ":CONSOLE" in line]
                self.assertEqual([line for line in said if "GPU stall" not in line], [])
                width, rows = read_png((self.folder / "a.png").read_bytes())
                pixels = [tuple(row[3 * x:3 * x + 3]) for row in rows for x in range(240, width)]
                shown = sum(pixel != (255, 255, 255) for pixel in pixels) / len(pixels)
                self.assertGreater(shown, 0.15)
                for color in colors:  # shaded: the hue counts
                    self.assertGreater(sum(alike(pixel, color) for pixel in pixels), 500, color)


def alike(pixel, color):
    """Whether a pixel has the order and rough ratio of a colour's channels."""
    if max(pixel) < 60 or max(pixel) - min(pixel) < 40:
        return False
    scale = max(color) / max(pixel)
    return all(abs(scale * p - c) < 60 for p, c in zip(pixel, color))


if __name__ == "__main__":
    unittest.main()
