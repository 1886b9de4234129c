# SPDX-License-Identifier: MPL-2.0
"""The page of -o view.html: what it holds, and that a browser shows it."""

import base64
import json
import os
import re
import subprocess
import unittest
import zlib

from browser import Browser
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

    def test_zoom(self):
        """The page begins with the frame of pictures; its numbers are relative to the first level's middle."""
        header = json.loads(element(self.page(CRAMBIN, *FAST, "--zoom", "resid 10-14", "-o", "a.view"), "header"))
        view = json.loads((self.folder / "a.view").read_text())
        _, vertices, _ = read_ply((self.folder / "a.ply").read_bytes())
        middle = [(min(v[i] for v in vertices) + max(v[i] for v in vertices)) / 2 for i in range(3)]
        self.assertAlmostEqual(header["zoom"]["side"], view["width"], delta=1e-6)
        for given, center, origin in zip(header["zoom"]["center"], view["center"], middle):
            self.assertAlmostEqual(given, center - origin, delta=1e-3)
        self.assertIsNone(json.loads(element(self.page(CRAMBIN, *FAST), "header"))["zoom"])

    @needs("chromium")
    def test_zoom_in_a_browser(self):
        """Balls of atoms whose centres fill 0.8 of the pane's smaller side fill somewhat more."""
        self.page(CRAMBIN, *FAST, "--surface", "vdw", "--select", "resid 10-14", "--zoom", "resid 10-14", "--view", "z")
        with self.opened((700, 600)) as page:
            self.ready(page)
            (left, top, right, bottom), rows = self.shown(page)
        columns = [x for xs in rows.values() for x in xs]
        lines = [y for y, xs in rows.items() if xs]
        side = min(right - left, bottom - top)
        wide = max(max(columns) - min(columns), max(lines) - min(lines)) / side
        self.assertGreater(wide, 0.85)
        self.assertLess(wide, 1.25)

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
                query = f"?color={mode}" if mode else ""
                done = subprocess.run(
                    [CHROMIUM, "--headless=new", "--no-sandbox", "--disable-gpu-sandbox",
                     "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
                     "--enable-logging=stderr", "--window-size=800,600", "--hide-scrollbars",
                     f"--user-data-dir={self.folder / 'profile'}", "--virtual-time-budget=8000",
                     "--run-all-compositor-stages-before-draw",
                     f"--screenshot={self.folder / 'a.png'}", f"file://{self.folder}/a.html{query}"],
                    capture_output=True, text=True, timeout=120)
                self.assertEqual(done.returncode, 0, done.stderr)
                said = [line for line in done.stderr.splitlines() if ":CONSOLE" in line]
                self.assertEqual([line for line in said if "GPU stall" not in line], [])
                with self.opened((800, 600), query) as page:  # which waits, however busy the machine is
                    self.ready(page)
                    page.picture(self.folder / "a.png")
                width, rows = read_png((self.folder / "a.png").read_bytes())
                pixels = [tuple(row[3 * x:3 * x + 3]) for row in rows for x in range(240, width)]
                shown = sum(pixel != (255, 255, 255) for pixel in pixels) / len(pixels)
                self.assertGreater(shown, 0.15)
                for color in colors:  # shaded: the hue counts
                    self.assertGreater(sum(alike(pixel, color) for pixel in pixels), 500, color)

    def opened(self, size, query=""):
        return Browser(f"file://{self.folder}/a.html{query}", self.folder, size)

    def ready(self, page):
        page.wait("document.body.dataset.state === 'ready' && document.body.dataset.rests === 'true'")

    def shown(self, page):
        """The pixels of the surface, as columns of each row, in a picture of the page."""
        page.picture(self.folder / "p.png")
        width, rows = read_png((self.folder / "p.png").read_bytes())
        box = page.evaluate("(({left, top, right, bottom}) => [left, top, right, bottom])"
                            "(document.getElementById('stage').getBoundingClientRect())")
        left, top, right, bottom = map(int, box)
        return box, {y: [x for x in range(left, right) if tuple(rows[y][3 * x:3 * x + 3]) != (255, 255, 255)]
                     for y in range(top, bottom)}

    def pixels(self, page):
        page.picture(self.folder / "p.png")
        width, rows = read_png((self.folder / "p.png").read_bytes())
        return [[tuple(row[3 * x:3 * x + 3]) for x in range(width)] for row in rows]

    @needs("chromium")
    def test_the_mouse_learns_names(self):
        """At the left end of the surface stands the atom that has the vertex farthest to the left."""
        page = self.page(CRAMBIN, "--voxel", "0.7")
        header = json.loads(element(page, "header"))
        data = zlib.decompress(base64.b64decode(element(page, "data")))
        arrays = {table["name"]: unpacked(data, table) for table in header["arrays"]}
        right, _, toward = header["axes"]
        across = [sum(a * b for a, b in zip(right, v)) for v in arrays["position"]]
        farthest = min(range(len(across)), key=across.__getitem__)
        atoms, residues = header["names"]["atoms"], header["names"]["residues"]
        residue, atom = atoms[arrays["ball"][farthest][0]]
        chain, name, number = residues[residue]
        with self.opened((1000, 700)) as browser:
            self.ready(browser)
            _, rows = self.shown(browser)
            y = min((row for row in rows if rows[row]), key=lambda row: rows[row][0])
            x = rows[y][0] + 4
            browser.call("Input.dispatchMouseEvent", type="mouseMoved", x=x, y=y)
            browser.wait("!document.getElementById('tip').hidden")
            tip = browser.evaluate("document.getElementById('tip').textContent")
            self.assertTrue(tip.startswith(f"{chain} {name} {number} "), (tip, name, number, atom))
            for kind in ("mousePressed", "mouseReleased"):
                browser.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", clickCount=1)
            chosen = browser.evaluate("document.getElementById('chosen').textContent")
            self.assertTrue(chosen.startswith(f"{chain} {name} {number},"), chosen)
            # The areas of the list are parts of that of the surface.
            areas = browser.evaluate("[...document.getElementById('residues').options]"
                                     ".map((o) => Number(o.text.split(/ +/).pop()))")
            self.check(0, CRAMBIN, "--voxel", "0.7", "-o", "r.json")
            report = json.loads((self.folder / "r.json").read_text())
            self.assertLess(abs(sum(areas) / report["surface"]["area"] - 1), 0.02)
            self.assertEqual(browser.console, [])

    @needs("chromium")
    def test_a_label_is_that_of_its_pixel(self):
        """After keys the label under a mouse that rests is gone, or names what is there now."""
        self.page(CRAMBIN, "--voxel", "0.7")
        text = "document.getElementById('tip').hidden ? '' : document.getElementById('tip').textContent"
        with self.opened((1000, 700)) as browser:
            self.ready(browser)
            move = lambda x, y: browser.call("Input.dispatchMouseEvent", type="mouseMoved", x=x, y=y)
            move(612, 350)
            browser.wait("!document.getElementById('tip').hidden")
            before = browser.evaluate(text)
            for _ in range(6):
                browser.evaluate("document.getElementById('view').dispatchEvent(new KeyboardEvent('keydown', "
                                 "{key: 'ArrowLeft', bubbles: true})); 0")
            # The keys may not have been seen yet: until then all rests as it was.
            browser.wait(f"document.body.dataset.rests === 'true' && !['', {json.dumps(before)}].includes({text})")
            found = browser.evaluate(text)
            move(2, 2)
            browser.wait("document.getElementById('tip').hidden")
            move(612, 350)
            browser.wait("!document.getElementById('tip').hidden")
            self.assertEqual(found, browser.evaluate(text))
            self.assertNotEqual(found, before)

    @needs("chromium")
    def test_residues_are_found(self):
        self.page(DATA / "4at1.ent.gz", "--voxel", "2", "--surface", "ses")
        with self.opened((1000, 700)) as browser:
            self.ready(browser)
            self.assertIn("Surface ses, voxels of 2", browser.evaluate("document.getElementById('about').textContent"))
            search = lambda text: browser.evaluate(
                f"(() => {{ const e = document.getElementById('search'); e.value = '{text}'; "
                "e.dispatchEvent(new Event('input')); return [...document.getElementById('residues').options]"
                ".map((o) => o.text.split(' ').slice(0, 3).join(' ')); })()")
            for text, expected in (("A HIS 41", ["A HIS 41"]), ("his 41 a", ["A HIS 41"]), ("c/his/41", ["C HIS 41"]),
                                   ("HIS 41", ["A HIS 41", "C HIS 41"]), ("A 41 GLY", [])):
                self.assertEqual(search(text), expected, text)
            self.assertGreater(len(search("ARG")), 20)
            self.assertGreater(len(search("")), 400)
            search("A HIS 41")
            browser.evaluate("document.getElementById('search').dispatchEvent(new KeyboardEvent('keydown', {key: 'Enter'})); 0")
            self.assertTrue(browser.evaluate("document.getElementById('chosen').textContent").startswith("A HIS 41,"))
            # A key lists the keys.
            shown = "getComputedStyle(document.getElementById('keys')).display"
            self.assertEqual(browser.evaluate(shown), "none")
            browser.evaluate("document.getElementById('view').dispatchEvent(new KeyboardEvent('keydown', "
                             "{key: '?', bubbles: true})); 0")
            self.assertEqual(browser.evaluate(shown), "grid")
            self.assertIn("reset view", browser.evaluate("document.getElementById('keys').textContent"))
            self.assertEqual(browser.console, [])

    def test_a_large_page_is_named(self):
        """With voxels that make it lighter."""
        done = self.check(0, DATA / "4at1.ent.gz", "--voxel", 0.2, "-o", "a.html")
        hint = re.search(r"a\.html: the page has \d+ MB \[hint: --voxel ([\d.]+) makes it lighter\]", done.stderr.decode())
        self.assertTrue(hint, done.stderr)
        done = self.check(0, DATA / "4at1.ent.gz", "--voxel", hint[1], "-o", "a.html", "--force")
        self.assertLess((self.folder / "a.html").stat().st_size, 12e6)
        self.assertNotIn(b"lighter", done.stderr)

    def test_bodies_go_with_a_surface_that_is_centered(self):
        args = (DATA / "1grm.pdb.gz", "--tunnels-from", "0,-4,3", "--surface", "ses", "--voxel", 1)
        middles = [json.loads(element(self.page(*args, *more), "header"))["bodies"]["middle"] for more in ((), ("--center",))]
        for a, b in zip(*middles):
            self.assertAlmostEqual(a, b, delta=0.001)

    @needs("chromium")
    def test_tunnels_are_tubes(self):
        page = self.page(DATA / "1grm.pdb.gz", "--tunnels-from", "resid 1", "--surface", "ses", "--voxel", 1, "--color", "element")
        bodies = json.loads(element(page, "header"))["bodies"]
        self.assertEqual(len(bodies["parts"]), 2)
        self.assertEqual({entry["title"] for entry in bodies["entries"]}, {"Tunnels"})
        self.assertEqual([entry["name"] for entry in bodies["entries"]], ["1.15 to 2.3 Å"])
        with self.opened((1000, 700)) as browser:
            self.ready(browser)
            headings = browser.evaluate("[...document.querySelectorAll('#legend h2')].map((h) => h.textContent)")
            self.assertEqual(headings, ["Element", "Tunnels"])

    @needs("chromium")
    def test_a_residue_is_turned_into_sight(self):
        """Whatever side it is on: Enter turns to it, and its line is in the panel without scrolling."""
        self.page(DATA / "4at1.ent.gz", "--voxel", "1", "--color", "chain", "--show", "pockets")
        with self.opened((1000, 700)) as browser:
            self.ready(browser)
            headings = browser.evaluate("[...document.querySelectorAll('#legend h2')].map((h) => h.textContent)")
            self.assertEqual(headings, ["Chain", "Pockets"])
            # A key works before anything was clicked, but is a letter in the search.
            keys = "getComputedStyle(document.getElementById('keys')).display"
            for kind in ("keyDown", "keyUp"):
                browser.call("Input.dispatchKeyEvent", type=kind, key="?", text="?" if kind == "keyDown" else "")
            self.assertEqual(browser.evaluate(keys), "grid")
            for kind in ("keyDown", "keyUp"):
                browser.call("Input.dispatchKeyEvent", type=kind, key="?", text="?" if kind == "keyDown" else "")
            browser.evaluate("document.getElementById('search').focus(); 0")
            for kind in ("keyDown", "keyUp"):
                browser.call("Input.dispatchKeyEvent", type=kind, key="?", text="?" if kind == "keyDown" else "")
            self.assertEqual(browser.evaluate(f"[{keys}, document.getElementById('search').value]"), ["none", "?"])
            rows = [text.split() for text in browser.evaluate("(() => { const e = document.getElementById('search'); e.value = ''; "
                    "e.dispatchEvent(new Event('input')); return [...document.getElementById('residues').options].map((o) => o.text); })()")]
            exposed = [" ".join(row[:3]) for row in rows if float(row[3]) > 15]
            self.assertGreater(len(exposed), 300)
            for name in exposed[7::len(exposed) // 6]:
                browser.evaluate(f"(() => {{ const e = document.getElementById('search'); e.value = '{name}'; "
                                 "e.dispatchEvent(new Event('input')); delete document.body.dataset.rests; "
                                 "e.dispatchEvent(new KeyboardEvent('keydown', {key: 'Enter', bubbles: true})); })(); 0")
                self.ready(browser)
                self.assertTrue(browser.evaluate("document.getElementById('chosen').textContent").startswith(name))
                low = browser.evaluate("document.getElementById('chosen').getBoundingClientRect().bottom")
                self.assertLess(low, 700)
                # Marked vertices are yellow, which no chain's colour is in this light.
                marked = sum(r > 200 and g > 150 and b < 110 and r - b > 130 for row in self.pixels(browser)
                             for r, g, b in row[230:])
                self.assertGreater(marked, 60, name)
            self.assertEqual(browser.console, [])

    @needs("chromium")
    def test_one_surface_of_two_fills_the_stage(self):
        self.page(CRAMBIN, *FAST, "--panel", "ses")
        choose = "{{ delete document.body.dataset.rests; const c = document.getElementById('layer'); c.selectedIndex = {}; " \
                 "c.dispatchEvent(new Event('change')); }} 0"
        heights = []
        with self.opened((700, 700)) as browser:
            for n in (None, 1, 0, 2):
                if n is not None:
                    browser.evaluate(choose.format(n))
                self.ready(browser)
                _, rows = self.shown(browser)
                heights.append(sum(len(row) > 0 for row in rows.values()))
        both, one, again, other = heights
        self.assertGreater(one, 1.2 * both / 2 if both > 500 else 1.3 * both)
        self.assertAlmostEqual(again, both, delta=12)
        self.assertAlmostEqual(other, one, delta=40)

    def layers(self, page):
        """The headers of a page's surfaces, and the arrays of each."""
        header = json.loads(element(page, "header"))
        data = zlib.decompress(base64.b64decode(element(page, "data")))
        headers = [header, *header["others"]]
        return headers, [{t["name"]: unpacked(data, t) for t in header["arrays"] if t["layer"] == n}
                         for n in range(len(headers))]

    def test_kinds_are_layers(self):
        """Each is the mesh that a run of its own makes, where that is, with the scales of the first."""
        words = [CRAMBIN, "--voxel", "0.7", "--color", "mean-curvature"]
        (first, other), arrays = self.layers(self.page(*words, "--panel", "SES"))
        self.assertEqual([first["name"], other["name"]], ["variational", "ses"])
        self.assertIn("Surface ses, voxels of 0.7", other["about"])
        middle = first["levels"][0]["middle"]
        self.check(0, *words, "--surface", "ses", "-o", "s.ply", "-o", "v.ply")
        self.check(0, *words, "-o", "v.ply", "--force")
        boxes = {}
        for name in ("s", "v"):
            names, vertices, triangles = read_ply((self.folder / f"{name}.ply").read_bytes())
            boxes[name] = [(min(v[i] for v in vertices) + max(v[i] for v in vertices)) / 2 for i in range(3)]
            if name == "s":
                self.assertEqual(3 * len(triangles), len(arrays[1]["index"]))
        for i in range(3):
            self.assertAlmostEqual(other["levels"][0]["middle"][i] - middle[i], boxes["s"][i] - boxes["v"][i], delta=1e-3)
        self.assertGreater(max(map(abs, other["levels"][0]["middle"])), 0.01)
        scales = [[(m["low"], m["high"]) for m in h["modes"] if m["id"] == "mean-curvature"] for h in (first, other)]
        self.assertEqual(scales[0], scales[1])
        self.assertEqual(len(other["names"]["residues"]), len({tuple(r) for r in other["names"]["residues"]}))

    def test_structures_are_layers(self):
        """Each about its own middle; chains keep the colours that they have alone."""
        (first, other), _ = self.layers(self.page(CRAMBIN, *FAST, "--panel", DATA / "1ubq.pdb", "--color", "chain"))
        self.assertEqual([first["title"], first["name"], other["name"]], ["1crn, 1ubq", "1crn", "1ubq"])
        self.assertLess(max(map(abs, other["levels"][0]["middle"])), 1e-6)
        self.assertEqual(self.layers(self.page(CRAMBIN, *FAST, "--panel", "0,1,0"))[0][0]["others"], [])

    @needs("chromium")
    def test_surfaces_side_by_side(self):
        self.page(CRAMBIN, "--voxel", "0.7", "--panel", "ses", "--panel", DATA / "1ubq.pdb", "--color", "chain")
        areas = {}
        for kind in ("variational", "ses"):
            self.check(0, CRAMBIN, "--voxel", "0.7", "--surface", kind, "-o", "r.json", "--force")
            areas[kind] = json.loads((self.folder / "r.json").read_text())["surface"]["area"]
        self.assertGreater(abs(areas["ses"] / areas["variational"] - 1), 0.05)
        text = lambda name: f"document.getElementById('{name}').textContent"
        choose = lambda n: (f"{{ delete document.body.dataset.rests; const c = document.getElementById('layer'); c.selectedIndex = {n}; "
                            "c.dispatchEvent(new Event('change')); } 0")
        with self.opened((1200, 420)) as browser:
            self.ready(browser)
            captions = browser.evaluate("[...document.getElementById('captions').children].map((c) => c.textContent)")
            self.assertEqual(captions, ["1crn, variational", "ses", "1ubq"])

            def columns():
                """Which columns of the stage show something below the captions."""
                (left, top, right, bottom), rows = self.shown(browser)
                return int(left), int(right), {x for y in range(int(top) + 40, int(bottom)) for x in rows[y]}
            left, right, seen = columns()
            third = (right - left) / 3
            spans = [[x for x in seen if left + n * third <= x < left + (n + 1) * third] for n in range(3)]
            for n, span in enumerate(spans):
                self.assertGreater(len(span), 0.4 * third)
                self.assertGreater(min(span), left + n * third + 1)
                self.assertLess(max(span), left + (n + 1) * third - 2)
            self.assertAlmostEqual(min(spans[0]) + third, min(spans[1]), delta=8)  # one camera
            # One click chooses the residue of both surfaces.
            x, y = left + int(1.5 * third), 200
            for kind in ("mousePressed", "mouseReleased"):
                browser.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", clickCount=1)
            chosen = browser.evaluate(text("chosen"))
            self.assertRegex(chosen, r"^A [A-Z]{3} \d+, 1crn, variational [\d.]+ Å², ses [\d.]+ Å²")
            browser.call("Input.dispatchMouseEvent", type="mouseMoved", x=x + 1, y=y)
            browser.wait("!document.getElementById('tip').hidden")
            tip = browser.evaluate(text("tip"))
            self.assertIn(re.search(r"ses ([\d.]+) Å²", chosen)[1], tip)
            browser.call("Input.dispatchMouseEvent", type="mouseMoved", x=2, y=2)
            browser.wait("document.getElementById('tip').hidden")
            # One by one, by the list and by a key; the list of residues is that of the surface that is shown.
            for n, kind in ((1, "variational"), (2, "ses")):
                browser.evaluate(choose(n))
                self.ready(browser)
                listed = sum(browser.evaluate("[...document.getElementById('residues').options]"
                                              ".map((o) => Number(o.text.split(/ +/).pop()))"))
                self.assertLess(abs(listed / areas[kind] - 1), 0.02, kind)
                self.assertIn(f"Surface {kind}", browser.evaluate(text("about")))
                left, right, seen = columns()
                self.assertAlmostEqual((min(seen) + max(seen)) / 2, (left + right) / 2, delta=20)
            browser.evaluate("document.getElementById('view').dispatchEvent(new KeyboardEvent('keydown', "
                             "{key: 's', bubbles: true})); 0")
            self.assertEqual(browser.evaluate("document.getElementById('layer').selectedIndex"), 3)
            # A cut and a glass of all.
            browser.evaluate(choose(0))
            for name, value in (("clip", 0.5), ("clip", 0), ("opacity", 0.4)):
                browser.evaluate("delete document.body.dataset.rests")
                browser.evaluate(f"{{ {slid(name, value)} }} 0")
                self.ready(browser)
                left, right, seen = columns()
                self.assertGreater(min(sum(left + n * third <= x < left + (n + 1) * third for x in seen) for n in range(3)),
                                   0.3 * third, (name, value))
            self.assertEqual(browser.console, [])
        # In a square window they have two rows, and nothing stays where there is none.
        with self.opened((924, 700)) as browser:
            for n in (1, 0):
                self.ready(browser)
                browser.evaluate(choose(n))
            self.ready(browser)
            (left, top, right, bottom), rows = self.shown(browser)
            fourth = [x for y in range(int(top + bottom) // 2 + 40, int(bottom)) for x in rows[y] if x > (left + right) / 2]
            self.assertEqual(fourth, [])
            self.assertTrue(rows[int(0.75 * bottom)])

    @needs("chromium")
    def test_the_panel_covers_nothing(self):
        self.page(*DIMER, *FAST, "--color", "chain")
        for size in ((1000, 700), (420, 750)):
            with self.subTest(size), self.opened(size) as browser:
                self.ready(browser)
                (left, top, right, bottom), rows = self.shown(browser)
                places = [x for row in rows.values() for x in row]
                self.assertGreater(len(places), 0.15 * (right - left) * (bottom - top))
                self.assertGreater(min(places), left)
                self.assertLess(max(places), right - 1)
                self.assertEqual((rows[int(top)], rows[int(bottom) - 1]), ([], []))
                panel = browser.evaluate("(({left, top, right, bottom}) => [left, top, right, bottom])"
                                         "(document.getElementById('panel').getBoundingClientRect())")
                self.assertTrue(panel[2] <= left or panel[1] >= bottom, (panel, left, bottom))

    @needs("chromium")
    def test_light_goes_through_in_order(self):
        """In the middle light goes through four walls of two balls, one behind the other, the farthest first."""
        (self.folder / "a.pdb").write_text("".join(
            f"ATOM      {n}  CA  ALA {chain}   {n}       0.000   0.000{z:8.3f}  1.00  0.00           C\n"
            for n, chain, z in ((1, "A", 4.0), (2, "B", -4.0))))
        middles, opacity = [], 0.5
        for view in ("0,0,1", "0,0,-1"):
            self.page("a.pdb", "--surface", "vdw", "--voxel", "0.3", "--color", "chain", "--view", view)
            with self.opened((800, 600)) as browser:
                for value in (1, opacity):
                    browser.evaluate("delete document.body.dataset.rests")
                    browser.evaluate(f"{{ {slid('opacity', value)} }} 0")
                    self.ready(browser)
                    (left, top, right, bottom), _ = self.shown(browser)
                    _, rows = read_png((self.folder / "p.png").read_bytes())
                    x = int(left + right) // 2
                    middles.append(rows[int(top + bottom) // 2][3 * x:3 * x + 3])
                self.assertEqual(browser.console, [])
        front, through, back, other = middles
        self.assertGreater(front[2], back[2] + 100)  # blue and orange
        for walls, seen in (((front, front, back, back), through), ((back, back, front, front), other)):
            want = [255.0] * 3
            for wall in reversed(walls):
                want = [opacity * w + (1 - opacity) * c for w, c in zip(wall, want)]
            self.assertLess(max(abs(a - b) for a, b in zip(want, seen)), 4, (want, seen, middles))

    @needs("chromium")
    def test_turns_without_a_graphics_card(self):
        """Some 200,000 triangles, at rest; while they turn coarser ones, 30 times a second by the software renderer."""
        self.check(0, DATA / "4at1.ent.gz", "--voxel", "0.7", "--color", "chain", "-o", "a.html", "-o", "a.json")
        triangles = json.loads((self.folder / "a.json").read_text())["surface"]["triangles"]
        idle = os.getloadavg()[0] < os.cpu_count() / 2
        with self.opened((1000, 700)) as browser:
            for opacity in (1, 0.5):
                browser.evaluate(f"{{ {slid('opacity', opacity)} }} 0")
                rates = []
                while len(rates) < 5 and max(rates, default=0) < 30:
                    times = browser.turn(3)
                    rates.append(1000 * len(times) / max(1, sum(times)))
                turning = int(browser.evaluate("document.body.dataset.triangles"))
                self.ready(browser)
                self.assertGreaterEqual(int(browser.evaluate("document.body.dataset.triangles")), triangles)
                if max(rates) < 60:  # with a card it turns as it is
                    self.assertLess(turning, triangles)
                self.assertGreater(max(rates), 30 if idle else 1, (opacity, rates))  # beside other work: at all
            self.assertEqual(browser.console, [])

    @needs("chromium")
    def test_a_cut_has_the_colours_of_what_is_cut(self):
        """Exactly those of the legend, as pictures have them; of curvature it is grey."""
        self.check(0, DATA / "4at1.ent.gz", "--voxel", "1", "--color", "chain", "-o", "a.html")
        with self.opened((900, 600)) as browser:
            self.ready(browser)
            browser.evaluate(f"{{ {slid('clip', 0.5)} }} 0")
            self.ready(browser)
            rows = self.pixels(browser)
            for color in ((86, 180, 233), (230, 159, 0), (0, 158, 115), (204, 121, 167)):
                near = sum(max(abs(a - b) for a, b in zip(p, color)) < 3 for row in rows for p in row)
                self.assertGreater(near, 3000, color)
            browser.evaluate("{ const c = document.getElementById('mode'); c.value = 1; "
                             "c.dispatchEvent(new Event('change')); } 0")
            self.ready(browser)
            grey = sum(max(abs(a - b) for a, b in zip(p, (0xb9, 0xbe, 0xc6))) < 3 for row in self.pixels(browser) for p in row)
            self.assertGreater(grey, 12000)
            self.assertEqual(browser.console, [])

    @needs("chromium")
    def test_every_control(self):
        self.page(*DIMER, *FAST, "--color", "chain")
        with self.opened((900, 600)) as browser:
            self.ready(browser)

            def after(expression):
                drawn = browser.evaluate("document.body.dataset.drawn")
                browser.evaluate(f"{{ {expression} }} 0")
                browser.wait(f"document.body.dataset.drawn !== '{drawn}' && document.body.dataset.rests === 'true'")
                return self.shown(browser)[1]

            def slide(name, value):
                return after(slid(name, value))

            def key(name):
                return after("document.getElementById('view').dispatchEvent("
                             f"new KeyboardEvent('keydown', {{key: '{name}', bubbles: true}}));")
            count = lambda rows: sum(map(len, rows.values()))
            whole = self.shown(browser)[1]
            self.assertLess(count(slide("clip", 0.8)), 0.9 * count(whole))
            self.assertEqual(count(slide("clip", 0)), count(whole))
            slide("opacity", 0.4)
            self.assertEqual(browser.evaluate("document.getElementById('opacity').value"), "0.4")
            slide("opacity", 1)
            self.assertGreater(count(key("+")), 1.05 * count(whole))
            self.assertNotEqual(key("ArrowLeft"), whole)
            after("document.getElementById('reset').click();")
            self.assertEqual(count(self.shown(browser)[1]), count(whole))
            after("document.getElementById('mode').selectedIndex = 1;"
                  "document.getElementById('mode').dispatchEvent(new Event('change'));")
            browser.evaluate("document.getElementById('png').click(); 0")
            self.assertGreater(int(browser.evaluate("document.body.dataset.png")), 5000)
            dark = after("document.getElementById('dark').click();")
            self.assertEqual(count(dark), 676 * 600)  # all of the stage
            self.assertEqual(browser.console, [])


def slid(name, value):
    """Moves a slider of the page."""
    return (f"const e = document.getElementById('{name}'); e.value = {value}; "
            "e.dispatchEvent(new Event('input'));")


def alike(pixel, color):
    """Whether a pixel has the order and rough ratio of a colour's channels."""
    if max(pixel) < 60 or max(pixel) - min(pixel) < 40:
        return False
    scale = max(color) / max(pixel)
    return all(abs(scale * p - c) < 60 for p, c in zip(pixel, color))


if __name__ == "__main__":
    unittest.main()
