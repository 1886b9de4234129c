# SPDX-License-Identifier: MPL-2.0
"""scripts/check_docs.py --figures finds every number of a page that is not what its run says, and corrects it."""

import importlib.util
import pathlib
import subprocess
import sys
import unittest

from tool import ROOT, TOOL, ToolTest

SPEC = importlib.util.spec_from_file_location("figures", ROOT / "scripts" / "figures.py")
figures = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(figures)

# One atom of radius 2 Å has an area and a volume that everybody can compute.
PAGE = """# A ball

<!-- run:
echo 0 0 0 2 > ball.xyzr
vdb_molsurf ball.xyzr --surface vdw -q -o ball.json
-->
The area is 50.27<!-- ball:area --> Å², the radius 2.0<!-- sqrt(ball:area/4/pi) -->, and a cube has
+91<!-- 100*(64/ball:volume - 1) --> % more than it, by
30.0<!-- 64 - ball:volume
  -1.51 + ball:atoms -->. It is above 33<!-- below ball:volume --> and below 34<!-- above ball:volume --> Å³.

| atoms | volume |
|---|---|
| 1<!-- ball:atoms --> | 33,510<!-- 1000*ball:volume --> |
"""
# What is changed in the page, and what the checker says.
CHANGED = [
    ("50.27<!--", "50.28<!--", "docs/ball.md:7: said 50.28, got 50.27 (ball:area)"),
    ("2.0<!--", "-2.0<!--", "docs/ball.md:7: said -2.0, got 2.0 (sqrt(ball:area/4/pi))"),
    ("34<!--", "35<!--", "docs/ball.md:10: said 35, got 34 (ball:volume)"),
    ("33,510<!--", "33,511<!--", "docs/ball.md:14: said 33,511, got 33,510 (1000*ball:volume)"),
    ("0 0 2 >", "0 0 2.001 >", "docs/ball.md:7: said 50.27, got 50.32 (ball:area)"),
    ("ball:area -->", "bell:area -->", "docs/ball.md:7: no run makes bell.json"),
    ("ball:area -->", "ball:areas -->", "docs/ball.md:7: ball:areas: KeyError 'areas'"),
    ("--surface vdw", "--surface dvw", "docs/ball.md:3: the run fails with status 2: vdb_molsurf: error: "),
    ("-q -o ball.json", "-q -o ball.json; sed -i '1s/A/The/' docs/ball.md", "docs/ball.md:1: said # A ball, got # The ball"),
]


class Form(unittest.TestCase):
    def test_numbers_keep_their_form(self):
        for value, said, text in ((2542240.4, "2,556,541", "2,542,240"), (9686.4, "9685", "9686"), (30209.0, "9,685", "30,209"),
                                  (30209.0, "30204", "30209"), (-0.004, "−0.03", "0.00"), (-0.044, "−0.03", "−0.04"),
                                  (0.2, "+0.14", "+0.20"), (-0.2, "+0.14", "-0.20"), (3.4e-6, "5e-5", "3e-6"),
                                  (12345.6, "9999.9", "12,345.6")):
            self.assertEqual(figures.written(value, said), text)

    def test_bounds(self):
        for value, said, bound, text in ((0.171, "0.3", "above", "0.2"), (0.2, "0.2", "above", "0.2"), (0.29, "0.3", "below", "0.2"),
                                         (3.1e-5, "3e-5", "above", "4e-5"), (-1.2, "-2", "below", "-2")):
            self.assertEqual(figures.written(value, said, bound), text)

    def test_members(self):
        report = {"groups": [{"name": "A", "area": 1}, {"name": "B", "area": 2}]}
        for path, value in (("groups.B.area", 2), ("groups.0.area", 1), ("groups.*.area", [1, 2])):
            self.assertEqual(figures.member(report, path.split(".")), value)


class Pages(ToolTest):
    def check_page(self, text, renew=False, structures=None):
        """Lines about a page of this text, and its text afterwards."""
        page = self.folder / "docs" / "ball.md"
        page.parent.mkdir(exist_ok=True)
        page.write_text(text)
        held = figures.Figures(self.folder, TOOL, structures)
        held.check(page, renew)
        self.held = held
        return held.faults, page.read_text()

    def test_a_right_page(self):
        self.assertEqual(self.check_page(PAGE, renew=True), ([], PAGE))
        self.assertEqual((self.held.numbers, self.held.runs, self.held.left_out), (8, 1, []))

    def test_changed_pages(self):
        for old, new, fault in CHANGED:
            with self.subTest(new):
                self.assertIn(old, PAGE)
                faults, _ = self.check_page(PAGE.replace(old, new, 1))
                self.assertTrue(faults and faults[0].startswith(fault), faults)

    def test_names(self):
        """A name stands for what would be long; one that is lacking is found."""
        text = PAGE.replace("The area is 50.27<!-- ball:area", "<!-- names:\narea = ball:area\nfour = area/area*4\n-->\n\n"
                            "The area is 50.27<!-- off([2, 2.02], 2)*0 + four*area/4")
        self.assertEqual(self.check_page(text), ([], text))
        self.assertEqual(self.check_page(text.replace("four =", "five ="))[0], ["docs/ball.md:12: no run makes four"])

    def test_corrected(self):
        for old, new, _ in CHANGED[:4]:
            self.assertEqual(self.check_page(PAGE.replace(old, new), renew=True)[1], PAGE)

    def test_structures(self):
        """A run is left out for want of its structure."""
        text = PAGE.replace("0 0 0 2 >", "$(cat structures/ball) >")
        self.assertEqual(self.check_page(text)[0], [])
        self.assertEqual(self.held.left_out, ["docs/ball.md:3: left out for want of structures/ball"])
        self.assertEqual((self.held.numbers, self.held.unseen), (0, 8))
        (self.folder / "mine").mkdir()
        (self.folder / "mine" / "ball").write_text("0 0 0 2")
        self.assertEqual(self.check_page(text, structures=self.folder / "mine"), ([], text))
        self.assertEqual((self.held.numbers, self.held.unseen), (8, 0))

    def test_the_command(self):
        """It ends with 1 if a number is wrong, and corrects it if it is told to."""
        script = self.folder / "scripts"
        script.mkdir()
        for name in ("check_docs.py", "figures.py", "gallery.py"):
            (script / name).write_text((ROOT / "scripts" / name).read_text())
        (self.folder / "README.md").write_text("# Nothing\n")
        self.check_page(PAGE.replace("50.27", "50.3"))

        def command(*words):
            done = subprocess.run([sys.executable, "-B", script / "check_docs.py", "--figures", "--program",
                                   pathlib.Path(TOOL).resolve(), *words], capture_output=True, text=True, timeout=60)
            return done.returncode, done.stdout
        status, text = command()
        self.assertEqual((status, text), (0, text))
        self.assertRegex(text, r"^figures: 8 numbers of 1 runs in \d+ s, .* 0 faults\n$")
        self.check_page(PAGE.replace("50.27", "50.28"))
        status, text = command()
        self.assertEqual(status, 1)
        self.assertIn("docs/ball.md:7: said 50.28, got 50.27 (ball:area)\n", text)
        command("--renew")
        self.assertEqual(command()[0], 0)
        self.assertEqual((self.folder / "docs" / "ball.md").read_text(), PAGE)


if __name__ == "__main__":
    unittest.main()
