# SPDX-License-Identifier: MPL-2.0
"""Films by ffmpeg, in whose place most tests have a program that keeps the pictures as they come."""

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time
import unittest

from needs import can_mount, needs
from tool import CRAMBIN, DATA, FAST, TOOL, ToolTest, read_png

KEEPER = f"""#!{sys.executable}
import json, os, sys
words = sys.argv[1:]
data = sys.stdin.buffer.read(int(os.environ.get("TAKES", -1)))
if os.environ.get("SAYS"): print(os.environ["SAYS"], file=sys.stderr)
with open(words[-1].removeprefix("file:"), "wb") as out:
    out.write(json.dumps(words).encode() + b"\\n" + data)
sys.exit(int(os.environ.get("STATUS", 0)))
"""


def program(folder, text):
    """An environment where ffmpeg is a program of this text."""
    path = pathlib.Path(folder) / "ffmpeg"
    path.write_text(text)
    path.chmod(0o755)
    return {**os.environ, "PATH": f"{folder}:{os.environ['PATH']}"}


class Films(ToolTest):
    def setUp(self):
        super().setUp()
        self.programs = tempfile.TemporaryDirectory()
        self.addCleanup(self.programs.cleanup)
        self.env = program(self.programs.name, KEEPER)

    def film(self, name):
        """The words that ffmpeg was called with, the size, and the pictures as rows of pixels."""
        words, data = (self.folder / name).read_bytes().split(b"\n", 1)
        words = json.loads(words)
        width, height = map(int, words[words.index("-video_size") + 1].split("x"))
        self.assertEqual(len(data) % (3 * width * height), 0)
        pictures = [data[i:i + 3 * width * height] for i in range(0, len(data), 3 * width * height)]
        return words, width, [[p[3 * width * y:3 * width * (y + 1)] for y in range(height)] for p in pictures]

    def test_turntable(self):
        words = [CRAMBIN, *FAST, "--turntable", 4, "--size", 121, "-o", "a.mp4", "-o", "a.png", "-o", "a.ply"]
        self.check(0, *words, env=self.env)
        self.assertEqual(self.names(), ["a.0001.png", "a.0002.png", "a.0003.png", "a.0004.png", "a.mp4", "a.ply"])
        command, width, pictures = self.film("a.mp4")
        self.assertEqual((len(pictures), width), (4, 122))  # codecs want even numbers
        self.assertEqual(command[command.index("-framerate") + 1], "25")
        for n, rows in enumerate(pictures, 1):
            _, still = read_png((self.folder / f"a.000{n}.png").read_bytes())
            for row, other in zip(rows, still):
                shown = [row[3 * x] < 250 for x in range(121)]
                self.assertLess(sum(a != (other[3 * x] < 250) for x, a in enumerate(shown)), 4)

    def test_endings(self):
        for ending, codec in (("mp4", "libx264"), ("webm", "libvpx-vp9"), ("GIF", "split[a][b];[a]palettegen[p];[b][p]paletteuse")):
            said = self.check(0, CRAMBIN, *FAST, "--turntable", 2, "--size", 60, "--fps", 12.5, "-o", f"a.{ending}", env=self.env)
            self.assertNotIn(b"warning", said.stderr)
            command, _, pictures = self.film(f"a.{ending}")
            self.assertIn(codec, command)
            self.assertEqual(command[command.index("-framerate") + 1], "12.5")
            self.assertEqual(len(pictures), 2)

    def moving(self):
        """Two balls: the second goes 6 A along x in three models, with a B factor that grows."""
        atom = "HETATM    {0}  C   XXX A   {0}    {1:8.3f}   0.000   0.000  1.00{2:6.2f}           C\n"
        (self.folder / "m.pdb").write_text("".join(
            f"MODEL {n + 1}\n" + atom.format(1, 0, 10) + atom.format(2, 4 + 3 * n, 20 + 10 * n) + "ENDMDL\n" for n in range(3)))
        return ["m.pdb", "--surface", "vdw", "--voxel", "0.5", "--frames", "all", "--view", "0,0,1", "--style", "flat"]

    def test_frames_have_one_camera(self):
        """The ball that stays is in one place, and all that is seen is within the frame, in films and pictures."""
        words = [*self.moving(), "--size", 200, "-o", "a.webm", "-o", "a.png", "-o", "a.csv"]
        self.check(0, *words, env=self.env)
        _, width, pictures = self.film("a.webm")
        stills = [read_png((self.folder / f"a.000{n}.png").read_bytes())[1] for n in (1, 2, 3)]
        for shots in (pictures, stills):
            self.assertEqual(len(shots), 3)
            columns = [[x for x in range(width) if any(row[3 * x] != 255 for row in rows)] for rows in shots]
            self.assertEqual(len({c[0] for c in columns}), 1)
            self.assertGreater(columns[0][0], 0)
            self.assertGreater(columns[1][-1], columns[0][-1] + 30)
            self.assertGreater(columns[2][-1], columns[1][-1] + 30)
            self.assertLess(columns[2][-1], width - 1)
        # A second run makes the film anew; without --force it does nothing.
        self.check(1, *words, says="exists already", env=self.env)
        self.check(0, *words, "--force", env=self.env)

    def test_frames_show_all_atoms_of_show(self):
        line = "HETATM{:5}  C   XXX A{:4}    {:8.3f}   0.000   0.000  1.00  0.00           C\n"
        (self.folder / "m.pdb").write_text("".join(
            f"MODEL {n}\n" + line.format(1, 1, 0.0) + line.format(2, 2, 20.0 + n) + "ENDMDL\n" for n in (1, 2)))
        self.check(0, "m.pdb", *FAST, "--surface", "vdw", "--select", "A/1", "--show", "A/2=spheres", "--frames", "all",
                   "--view", "0,0,1", "--size", 200, "--legend", "off", "-o", "a.png", "-o", "a.csv")
        for n in (1, 2):
            width, rows = read_png((self.folder / f"a.000{n}.png").read_bytes())
            ink = [any(row[3 * x + k] < 250 for row in rows for k in range(3)) for x in range(width)]
            self.assertEqual(sum(b and not a for a, b in zip([False, *ink], ink)), 2)

    def test_frames_have_one_legend(self):
        for color in ("bfactor", "mean-curvature"):
            self.check(0, *self.moving(), "--color", color, "--size", 600, "-o", "a.mp4", "--force", env=self.env)
            _, width, pictures = self.film("a.mp4")
            legends = [[row[3 * 530:] for row in rows] for rows in pictures]
            self.assertEqual(legends[0], legends[1])
            self.assertEqual(legends[0], legends[2])
            self.assertTrue(any(byte < 100 for row in legends[0] for byte in row))

    def test_view_and_middle(self):
        """A view that is asked for is kept; --center moves camera and surface alike."""
        words = [*self.moving(), "--size", 100]
        self.check(0, *words, "-o", "a.mp4", "-o", "a.view", env=self.env)
        again = [word if word != "0,0,1" else "a.0003.view" for word in words]
        self.check(0, *again, "-o", "b.mp4", env=self.env)
        self.check(0, *words, "--center", "-o", "c.mp4", env=self.env)
        (_, _, a), (_, _, b), (_, _, c) = (self.film(name) for name in ("a.mp4", "b.mp4", "c.mp4"))
        self.assertEqual(a, b)
        for one, other in zip(a, c):
            far = sum(p != q for r, s in zip(one, other) for p, q in zip(r, s))
            self.assertLess(far, 0.03 * sum(map(len, one)))

    def test_one_structure_of_several(self):
        """batch turns each of them."""
        (self.folder / "list").write_text(f"{CRAMBIN}\n")
        self.check(0, "batch", "list", "-O", "out", "--formats", "gif,png", *FAST, "--turntable", 2, "--size", 60, env=self.env)
        self.assertEqual(len(self.film("out/1crn.gif")[2]), 2)
        one, other = ((self.folder / f"out/1crn.000{n}.png").read_bytes() for n in (1, 2))
        self.assertNotEqual(one, other)

    def test_refused(self):
        words = [CRAMBIN, *FAST, "--size", 60]
        for more, says in ((["-o", "a.mp4"], "expected --turntable or --frames"),
                           (["-o", "a.mp4", "--turntable", 2, "--background", "transparent"], "films are opaque"),
                           (["-o", "-", "--format", "mp4", "--turntable", 2], "--format"),
                           (["-o", "a.avi", "--turntable", 2], "[hint: .mp4")):
            self.check(2, *words, *more, says=says, env=self.env)
        os.mkfifo(self.folder / "pipe.mp4")
        self.check(1, *words, "--turntable", 2, "-o", "pipe.mp4", says="expected a file for a film", env=self.env)
        (self.folder / "pipe.mp4").unlink()
        nowhere = {**os.environ, "PATH": str(self.folder)}
        self.check(1, *words, "--turntable", 2, "-o", "a.mp4", "-o", "a.ply", says=["expected the program ffmpeg", "install ffmpeg"], env=nowhere)
        self.assertEqual(self.names(), [])

    def test_failures_leave_nothing(self):
        """Whether it fails at the end, early, or ends well and complains. What was there before stays."""
        words = [CRAMBIN, *FAST, "--size", 60, "--turntable", 3, "-o", "a.mp4", "-o", "a.ply", "--force"]
        for fault in ({"STATUS": "1", "SAYS": "no such codec"}, {"TAKES": "10", "STATUS": "1", "SAYS": "no such codec"},
                      {"SAYS": "no such codec"}):
            self.check(1, *words, says=["a.mp4: ffmpeg: no such codec", "[hint: a name that ends in .png"], env={**self.env, **fault})
            self.assertEqual(self.names(), [])
        (self.folder / "a.mp4").write_text("old")
        self.check(1, *self.moving(), "--size", 60, "-o", "a.mp4", "--force", says="ffmpeg", env={**self.env, "STATUS": "1"})
        self.assertEqual((self.folder / "a.mp4").read_text(), "old")
        self.assertEqual(self.names(), ["a.mp4", "m.pdb"])
        self.check(75, *words, says="No space left", env={**self.env, "SAYS": "av: No space left on device", "STATUS": "1"})

    def test_a_film_that_is_none(self):
        """A program that writes nothing, and one that puts a link in the place of its file: no film, and nothing outside is written."""
        words = [CRAMBIN, *FAST, "--size", 60, "--turntable", 2, "-o", "a.mp4"]
        other = self.folder / "other"
        other.write_text("mine")
        swap = f'for f in .??*; do rm "$f"; ln -s {other} "$f"; done\nfor w; do :; done\ncat > "${{w#file:}}"\n'
        for text in ("", swap):
            self.check(1, *words, says="a.mp4: ffmpeg: it has written nothing, or another file lies in its place",
                       env=program(self.programs.name, f"#!/bin/sh\n{text}cat > /dev/null\n"))
            self.assertEqual(other.read_text(), "mine")
            self.assertFalse((self.folder / "a.mp4").exists())

    def test_ffmpeg_ends_with_its_parent(self):
        pid = self.folder / "pid"
        env = program(self.programs.name, f"#!{sys.executable}\nimport os, sys, time\nopen({str(pid)!r}, 'w').write(str(os.getpid()))\n"
                                          "sys.stdin.buffer.read()\ntime.sleep(60)\n")
        child = subprocess.Popen([TOOL, str(CRAMBIN), *FAST, "--size", "60", "--turntable", "2", "-o", "a.mp4", "-q"], cwd=self.folder, env=env)
        end = time.monotonic() + 50
        while not (pid.exists() and pid.read_text()) and time.monotonic() < end:
            time.sleep(0.05)
        child.kill()
        child.wait()
        stat = pathlib.Path(f"/proc/{int(pid.read_text())}/stat")
        while stat.exists() and stat.read_text().rsplit(")", 1)[1].split()[0] != "Z":  # nobody waits for it where there is no init
            self.assertLess(time.monotonic(), end, "ffmpeg goes on")
            time.sleep(0.05)

    @needs("ffmpeg")
    def test_real_films(self):
        words = [CRAMBIN, *FAST, "--size", 121, "--turntable", 5]
        self.check(0, *words, "-o", "a.mp4", "-o", "a.webm", "-o", "a.gif")
        first = {name: (self.folder / name).read_bytes() for name in self.names()}
        self.check(0, *words, "-o", "a.mp4", "-o", "a.webm", "-o", "a.gif", "--force", "-j", 1)
        for name, data in first.items():
            self.assertEqual((self.folder / name).read_bytes(), data, name)  # whatever the threads
            raw = subprocess.run(["ffmpeg", "-loglevel", "error", "-i", name, "-f", "rawvideo", "-pix_fmt", "rgb24", "-"],
                                 cwd=self.folder, capture_output=True, check=True).stdout
            size = len(raw) // 5
            self.assertEqual(len(raw) % (3 * 122), 0)
            self.assertGreater(min(raw[:3]), 250)  # white
            middle = raw[size // 2 + 3 * 61:][:3]
            self.assertGreater(middle[2], middle[0] + 20)  # blue

    @needs("ffmpeg")
    def test_full_disk(self):
        if not can_mount():
            self.skipTest("needs mount: the right to mount a file system, as root has it")
        disk = self.folder / "disk"
        disk.mkdir()
        subprocess.run(["mount", "-t", "tmpfs", "-o", "size=12k", "tmpfs", disk], check=True)
        try:
            for name in ("a.mp4", "a.webm", "a.gif"):
                self.check(75, DATA / "1ubq.pdb", *FAST, "--size", 300, "--turntable", 30, "-o", disk / name, says="No space left")
                self.assertEqual(list(disk.iterdir()), [])
        finally:
            subprocess.run(["umount", disk], check=True)


if __name__ == "__main__":
    unittest.main()
