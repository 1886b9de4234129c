# SPDX-License-Identifier: MPL-2.0
"""Wrong calls have status 2, say why in one line, and leave nothing behind."""

import os
import re
import subprocess
import unittest
import zipfile

from needs import needs
from tool import CRAMBIN, FAST, ROOT, TOOL, ToolTest


class Program(unittest.TestCase):
    @needs("readelf")
    def test_loader_does_not_look_in_the_current_folder(self):
        dynamic = subprocess.run(["readelf", "-d", TOOL], capture_output=True, text=True, check=True)
        for line in dynamic.stdout.splitlines():
            if "RPATH" in line or "RUNPATH" in line:
                for entry in line[line.index("[") + 1:line.index("]")].split(":"):
                    self.assertTrue(entry.startswith(("/", "$ORIGIN")), line)

    @needs("readelf")
    def test_is_hardened(self):
        """Of a Release build, by cmake/hardening.cmake."""
        def elf(what, path):
            return subprocess.run(["readelf", "-W", what, path], capture_output=True, text=True, check=True).stdout

        if elf("-S", TOOL).count(".debug_info"):
            self.skipTest("a build with debug information")
        dynamic = elf("-d", TOOL)
        self.assertRegex(dynamic, r"\(FLAGS_1\).*NOW.*PIE")
        self.assertIn("GNU_RELRO", elf("-l", TOOL))
        self.assertNotIn("RWE", elf("-l", TOOL))
        # What the program is made of may be in a library beside it.
        loaded = subprocess.run(["ldd", TOOL], capture_output=True, text=True, check=True).stdout
        calls = "".join(elf("--dyn-syms", path) for path in [TOOL, *re.findall(r"=> (\S*/libvdb_molsurf\S*)", loaded)])
        for name in ("__stack_chk_fail", "__memcpy_chk"):
            self.assertIn(f" {name}@", calls)


class ShortWords(ToolTest):
    def test_help_and_version(self):
        for verb in ([], ["compare"], ["batch"], ["info"], ["convert"], ["bricks", "plan"], ["bricks", "merge"]):
            self.assertEqual(self.check(0, *verb, "-h").stdout,
                             self.check(0, *verb, "--help").stdout)
        self.assertEqual(self.check(0, "-V").stdout, self.check(0, "--version").stdout)

    def test_help_of_a_verb(self):
        for verb in (["compare"], ["bricks", "run"], ["BATCH"]):
            self.assertEqual(self.check(0, "help", *verb).stdout, self.check(0, *verb, "--help").stdout)
        self.assertEqual(self.check(0, "help", "options").stdout, self.check(0, "--help-all").stdout)
        overview = self.check(0, "help").stdout.decode()
        for verb in ("batch", "compare", "convert", "bricks plan", "bricks run", "bricks merge", "info"):
            self.assertIn(f"vdb_molsurf {verb} ", overview)

    def test_build_is_a_verb(self):
        self.check(0, "build", CRAMBIN, *FAST, "-o", "a.ply")
        self.check(0, CRAMBIN, *FAST, "-o", "b.ply")
        self.assertEqual(*((self.folder / name).read_bytes() for name in ("a.ply", "b.ply")))

    def test_words_in_any_case(self):
        self.check(0, CRAMBIN, *FAST, "--surface", "SES", "--color", "Element", "-o", "a.PLY")
        self.check(0, CRAMBIN, *FAST, "--surface", "ses", "--color", "element", "-o", "b.ply")
        self.assertEqual(*((self.folder / name).read_bytes() for name in ("a.PLY", "b.ply")))


class WrongCalls(ToolTest):
    def refuse(self, *words, says=()):
        self.check(2, *words, says=says)
        self.assertEqual(self.names(), [])

    def test_no_input(self):
        self.refuse("-o", "a.vdb", says="INPUT")

    def test_nothing_at_all(self):
        self.refuse(says=["INPUT", "vdb_molsurf --help"])

    def test_what_people_type_first(self):
        """One line each, with what to do instead."""
        self.check(1, "1crn", "-o", "a.ply", says=["1crn: cannot be opened", "download/1crn.cif.gz"])
        self.check(1, "pdb_00001crn", "-o", "a.ply", says="Protein Data Bank")
        self.check(1, "https://example.org/1crn.pdb", "-o", "a.ply", says="curl -LO https://example.org/1crn.pdb")
        self.assertNotIn(b"curl", self.check(1, "s3://bucket/1crn.cif", "-o", "a.ply", says="an address; aws s3 cp ADDRESS - | vdb_molsurf -").stderr)
        self.check(1, CRAMBIN, *FAST, "-o", "s3://bucket/a.ply", says="aws s3 cp - ADDRESS or the like takes standard output")
        self.assertNotIn(b"hint", self.check(1, "1crn.pdb", "-o", "a.ply").stderr)
        (self.folder / "some").mkdir()
        self.check(1, "some", "-o", "a.ply", says=["is a folder", "vdb_molsurf batch some -O DIR"])
        self.check(2, "a.pdb", "b.pdb", "c.pdb", "d.pdb", "-o", "a.ply",
                   says=["'a.pdb', 'b.pdb', 'c.pdb', ... (4)", "vdb_molsurf batch - -O DIR"])
        self.check(2, CRAMBIN, "-o", "x.pdf", says=[".pdf is no format", "[hint: .png"])
        self.check(2, CRAMBIN, "-o", "x.pny", says="did you mean ply?")
        self.check(2, CRAMBIN, "-o", "x", says="[hint: -o x.vdb")
        self.check(2, CRAMBIN, "-o", "some/", says=["is a folder", "-o some/surface.ply"])
        self.check(2, CRAMBIN, "-o", "some", says="is a folder")
        self.check(2, "-version", says="did you mean --version?")
        self.check(2, "-help", says="did you mean --help?")
        self.check(1, CRAMBIN, "--memory", "1M", "-o", "a.ply", says=["MiB of memory, --memory is 1 MiB", "[hint: --memory "])
        self.check(1, CRAMBIN, "--trajectory", "none.dcd", "-o", "a.csv", says="none.dcd: cannot be opened: No such file")
        self.check(1, "convert", CRAMBIN, "-o", "a.ply", says=["is neither a .vdb file nor a map", f"vdb_molsurf {CRAMBIN} -o FILE"])
        with zipfile.ZipFile(self.folder / "1crn.zip", "w") as archive:
            archive.write(CRAMBIN)
        self.check(1, "1crn.zip", "-o", "a.ply", says=["zip", "unzip"])
        self.assertEqual(self.names(), ["1crn.zip", "some"])

    def test_two_inputs(self):
        self.refuse(CRAMBIN, "b.pdb", "-o", "a.vdb", says="b.pdb")

    def test_no_output(self):
        self.refuse(CRAMBIN, says="-o FILE")

    def test_unknown_option(self):
        self.refuse(CRAMBIN, "-o", "a.vdb", "--voxle", "1", says="--voxle")

    def test_what_was_meant(self):
        for words, meant in ((("compar", "a.vdb", "b.vdb"), "compare"), (("brick", "plan"), "bricks"),
                             (("bricks", "rn", "p.json", "1"), "run"),
                             ((CRAMBIN, "-o", "a.vdb", "--voxle", "1"), "--voxel"),
                             ((CRAMBIN, "-o", "a.vdb", "--surface", "varational"), "variational"),
                             ((CRAMBIN, "-o", "a.vdb", "--fields", "mean_curvatur"), "mean_curvature"),
                             ((CRAMBIN, "-o", "a.png", "--background", "blak"), "black")):
            self.refuse(*words, says=f"did you mean {meant}?")
        self.refuse("bricks", says="plan, run, merge")

    def test_options_of_other_verbs(self):
        self.refuse("compare", CRAMBIN, CRAMBIN, "--show", "sticks", says="--show is for build, batch")
        self.refuse("convert", "a.vdb", "--color", "pocket", "-o", "a.ply", says="--color: expected none")
        self.assertNotIn(b"pocket", self.check(0, "convert", "--help").stdout)
        self.refuse("bricks", "plan", CRAMBIN, "-o", "p.json", "--bricks", 2, "--split", "group",
                    says="--split is for build, batch, not for bricks plan")
        self.refuse("info", "-q", CRAMBIN, says="-q")
        for verb, option in (("compare", "--show"), ("convert", "--probe"), ("batch", "--frames")):
            self.assertNotIn(option.encode(), self.check(0, verb, "--help").stdout)

    def test_a_surface_is_no_structure(self):
        self.check(0, CRAMBIN, *FAST, "-o", "a.vdb", "-o", "a.ply")
        self.check(1, "a.vdb", "-o", "b.ply", says="vdb_molsurf convert a.vdb")
        self.check(1, "a.ply", "-o", "b.vdb", says="it is a mesh")

    def test_order_of_options_does_not_decide(self):
        for words in (("--epsilon", "1", "--resolution", "5"), ("--resolution", "5", "--epsilon", "1")):
            self.refuse(CRAMBIN, "-o", "a.vdb", *words, says="--resolution together: a resolution for all atoms")

    def test_files_that_hold_no_colours_or_fields(self):
        self.check(0, CRAMBIN, *FAST, "--color", "chain", "-o", "a.stl", says="none of the files can hold colours")
        self.check(0, CRAMBIN, *FAST, "--fields", "sas,mean_curvature", "-o", "b.ply",
                   says="--fields sas: none of the files")

    def test_options_are_not_guessed(self):
        self.refuse(CRAMBIN, "-o", "a.vdb", "--vox", "1", says="--vox")

    def test_option_without_value(self):
        self.refuse(CRAMBIN, "-o", "a.vdb", "--voxel", says="--voxel")

    def test_option_twice(self):
        self.refuse(CRAMBIN, "-o", "a.vdb", "--voxel", "1", "--voxel", "2", says="--voxel")

    def test_output_without_extension(self):
        self.refuse(CRAMBIN, "-o", "a", says=["-o a", ".vdb"])

    def test_unknown_extension(self):
        self.refuse(CRAMBIN, "-o", "a.xyz", says=["a.xyz", ".xyz is no format", "--help"])

    def test_same_output_twice(self):
        self.refuse(CRAMBIN, "-o", "a.ply", "-o", "./a.ply", says="twice")

    def test_format_without_standard_output(self):
        self.refuse(CRAMBIN, "-o", "a.ply", "--format", "ply", says="-o -")

    def test_standard_output_without_format(self):
        self.refuse(CRAMBIN, "-o", "-", says="--format")

    def test_two_standard_outputs(self):
        self.refuse(CRAMBIN, "-o", "-", "-o", "-", "--format", "ply", says="twice")

    def test_unknown_format(self):
        self.refuse(CRAMBIN, "-o", "-", "--format", "gltf", says="gltf")

    def test_surface_kinds(self):
        self.refuse(CRAMBIN, "-o", "a.vdb", "--surface", "round", says="round")
        self.refuse(CRAMBIN, "-o", "a.vdb", "--surface", "gaussian", "--blobbiness", "0",
                    says="--blobbiness")

    def test_resolution(self):
        for value in ("0", "200", "nan", "5A", "=5", "A=", "A=0", ""):
            self.refuse(CRAMBIN, "-o", "a.vdb", "--resolution", value, says="--resolution")

    def test_unknown_field(self):
        self.refuse(CRAMBIN, "-o", "a.vdb", "--fields", "sas,color", says="color")

    def test_unknown_words(self):
        for option in ("--regularizer", "--flow"):
            self.refuse(CRAMBIN, "-o", "a.vdb", option, "none", says=[option, "none"])

    def test_quiet_and_verbose(self):
        self.refuse(CRAMBIN, "-o", "a.vdb", "-q", "-v", says="quiet")

    def test_voxel_out_of_range(self):
        for value in ("0", "-1", "1e-9", "0.049", "10.1", "1e30"):
            self.refuse(CRAMBIN, "-o", "a.vdb", "--voxel", value, says="--voxel")

    def test_numbers_out_of_range(self):
        for option, value in (
            ("--epsilon", "0"),
            ("--epsilon", "-1"),
            ("--probe", "-0.1"),
            ("--lambda", "-1"),
            ("--tolerance", "-1"),
            ("--spline-level", "3"),
            ("--spline-level", "-1"),
            ("--max-steps", "-1"),
            ("--threads", "0"),
            ("--model", "-1"),
        ):
            self.refuse(CRAMBIN, "-o", "a.vdb", option, value, says=option)

    def test_words_that_are_no_numbers(self):
        for option in ("--voxel", "--epsilon", "--probe", "--lambda", "--tolerance"):
            for value in ("nan", "inf", "-inf", "1e999", "1e-999", "0.5A", "0,5", "0x1", " 1", ""):
                self.refuse(CRAMBIN, "-o", "a.vdb", option, value, says=option)
        for option in ("--max-steps", "--threads", "--model", "--spline-level"):
            for value in ("1.5", "1e1", "99999999999999999999", "one", ""):
                self.refuse(CRAMBIN, "-o", "a.vdb", option, value, says=option)

    def test_info_without_file(self):
        self.refuse("info", says="expected a FILE")
        self.refuse("info", "--what", says="--what")


class Information(ToolTest):
    def test_help_of_what_is_no_verb(self):
        self.check(2, "help", "foo", says="help: expected a verb, a group of options or an option, got 'foo'")
        self.check(2, "help", "comper", says="did you mean compare?")
        self.check(2, "help", "build", "more", says="got 'more'")
        self.check(2, "help", "bricks", "plam", says="did you mean plan?")

    def test_options_that_change_nothing_say_so(self):
        for option, output, are in ((["--plain-color", "red"], "a.ply", ".glb, .usda, .html, .png, .mp4, .webm and .gif"),
                                    (["--depth-cue"], "a.html", ".png"), (["--vdb-half"], "a.ply", ".vdb"),
                                    (["--curvature-totals"], "a.ply", ".json"),
                                    (["--sharp-colors", "--color", "chain"], "a.vdb", ".ply, .obj, .vtk, "),
                                    (["--color", "chain"], "a.stl", "none of the files can hold colours"),
                                    (["--fields", "density"], "a.html", "none of the files can hold that")):
            self.check(0, CRAMBIN, "--voxel", "2", *option, "-o", output, "--force", says=[option[0], are])
        self.check(0, CRAMBIN, "--voxel", "2", "--vdb-half", "-o", "b.vdb")

    def test_names_of_before_are_taken(self):
        """Also in a file of options; messages have the names of today."""
        for words in (["--walls", "outer"], ["--min-wall", "2", "--print-scale", "1"], ["--color", "chain", "--crisp"]):
            new = [{"--walls": "--pieces", "--min-wall": "--min-thickness", "--crisp": "--sharp-colors"}.get(w, w) for w in words]
            for name, call in (("old.ply", words), ("new.ply", new)):
                self.check(0, CRAMBIN, "--voxel", "2", *call, "-o", name, "--force")
            self.assertEqual(*((self.folder / name).read_bytes() for name in ("old.ply", "new.ply")), words)
        (self.folder / "old.txt").write_text("walls = outer\n")
        self.check(0, CRAMBIN, "--voxel", "2", "--config", "old.txt", "-o", "a.json", says="--pieces is for .ply")
        self.check(2, CRAMBIN, "--walls", "outer", "--pieces", "all", "-o", "a.obj", says="--pieces is given twice")
        self.check(2, CRAMBIN, "--walls", "inner", "-o", "a.obj", says="--pieces: expected all or outer or cavities")
        self.assertNotIn(b"--walls", self.check(0, "--help-all").stdout)
        self.assertIn(b"--pieces", self.check(0, "help", "walls").stdout)

    def test_defaults_are_not_warned_of(self):
        done = self.check(0, CRAMBIN, "--voxel", "2", "-o", "a.ply")
        self.assertNotIn(b"--epsilon", done.stderr)

    def test_help_is_the_one_in_docs(self):
        done = self.check(0, "--help")
        self.assertEqual(done.stdout.decode(), (ROOT / "docs" / "cli-help.txt").read_text())
        self.assertEqual(done.stderr, b"")

    def test_help_tells_the_exit_status(self):
        self.assertIn(b"3 not converged", self.check(0, "--help").stdout)

    def test_help_fits_a_terminal(self):
        """Two screens of it: three examples, and the way to the rest."""
        text = self.check(0, "--help").stdout.decode()
        self.assertLessEqual(len(text.splitlines()), 84)
        self.assertEqual(text.split("\nVerbs")[0].count("\n  vdb_molsurf "), 3)
        self.assertIn("vdb_molsurf --help-all", text)
        for option in ("--frames", "--pockets", "--pore", "--show", "--opacity", "--for"):
            self.assertIn(f"\n      {option} ", text)
        for line in text.splitlines() + self.check(0, "--help-all").stdout.decode().splitlines():
            self.assertLessEqual(len(line), 100, line)

    def test_help_all_has_what_help_has(self):
        for verb in ([], ["batch"], ["compare"], ["convert"], ["bricks", "plan"]):
            few, all_ = (set(re.findall(r"^ {2,6}(?:-\w, )?(--[a-z-]+.*?)(?:  .*)?$", self.check(0, *verb, word).stdout.decode(), re.M))
                         for word in ("--help", "--help-all"))
            self.assertGreater(len(few), 5)
            self.assertLess(few, all_)

    def test_help_of_a_first_word(self):
        for words in (["bricks", "--help"], ["Bricks", "-h"], ["help", "bricks"]):
            said = self.check(0, *words).stdout.decode()
            self.assertEqual(said.count("\nvdb_molsurf bricks"), 2, said)
            self.assertTrue(said.startswith("vdb_molsurf bricks plan INPUT"), said)
        self.check(2, "bricks", "-o", says="plan, run, merge")

    def test_info_help(self):
        self.assertIn(b"info FILE", self.check(0, "info", "--help").stdout)

    def test_version(self):
        self.assertRegex(self.check(0, "--version").stdout, rb"^vdb_molsurf \d+\.\d+\.\d+\n$")

    def test_radii(self):
        self.assertIn(b"bondi", self.check(0, "--list-radii").stdout)

    @needs("full")
    def test_help_that_cannot_be_printed(self):
        with open("/dev/full", "wb") as full:
            self.check(75, "--help", capture_output=False, stdout=full, stderr=-1)


class Config(ToolTest):
    def write(self, text):
        (self.folder / "c.txt").write_text(text)

    def test_options_come_from_the_file_and_the_command_line_wins(self):
        self.write("\ufeffvoxel = 0.9\n# a comment\nwaters = true\nlambda = 0.02\n")
        self.check(0, CRAMBIN, "-o", "a.vdb", "--config", "c.txt", "--lambda", "0.03")
        text = self.check(0, "info", "a.vdb").stdout.decode()
        self.assertRegex(text, r"option.voxel +0.9\n")
        self.assertRegex(text, r"option.waters +true\n")
        self.assertRegex(text, r"option.lambda +0.03\n")

    def test_switches_have_values(self):
        for value, on in (("yes", True), ("OFF", False), ("0", False)):
            self.write(f"waters = {value}\n")
            self.check(0, CRAMBIN, *FAST, "-o", "a.vdb", "--config", "c.txt", "--force")
            found = b"option.waters   true" in self.check(0, "info", "a.vdb").stdout
            self.assertEqual(found, on, value)
        for line, says in (("waters = maybe", ["--waters", "'maybe'", "true or false"]), ("waters =", "--waters"),
                           ("config = d.txt", "'config'"), ("help = true", "'help'")):
            self.write(line + "\n")
            self.check(2, CRAMBIN, "-o", "b.vdb", "--config", "c.txt", says=says)

    def test_unknown_name(self):
        self.write("voxle = 1\n")
        self.check(2, CRAMBIN, "-o", "a.vdb", "--config", "c.txt", says=["c.txt", "voxle"])

    def test_bad_value(self):
        self.write("voxel = nan\n")
        self.check(2, CRAMBIN, "-o", "a.vdb", "--config", "c.txt", says="--voxel")

    def test_no_such_file(self):
        self.check(1, CRAMBIN, "-o", "a.vdb", "--config", "c.txt", says=["c.txt", "No such file"])

    def test_folder(self):
        self.check(1, CRAMBIN, "-o", "a.vdb", "--config", ".", says="folder")


class Talk(ToolTest):
    def test_default_is_two_lines(self):
        lines = self.check(0, CRAMBIN, "-o", "a.ply", *FAST).stderr.decode().splitlines()
        self.assertEqual(len(lines), 2, lines)
        self.assertIn("327 atoms", lines[0])
        self.assertRegex(lines[1], r"area [\d.]+ Å\^2, volume [\d.]+ Å\^3, .* s$")

    def test_quiet(self):
        self.assertEqual(self.check(0, CRAMBIN, "-o", "a.ply", "-q", *FAST).stderr, b"")

    def test_verbose_has_the_stages(self):
        done = self.check(0, CRAMBIN, "-o", "a.ply", "-v", *FAST)
        for stage in ("read", "mesh", "write", "total"):
            self.assertRegex(done.stderr.decode(), rf"vdb_molsurf: {stage} +[\d.]+ s\n")

    def test_large_voxels_are_warned_of(self):
        self.check(0, CRAMBIN, "-o", "a.ply", "--voxel", "1.1", says=["warning", "--voxel 1.1"])

    def on_terminal(self, *words):
        """What a terminal gets as standard error."""
        ours, theirs = os.openpty()
        self.check(0, CRAMBIN, "-o", "a.ply", "--force", *FAST, *words,
                   capture_output=False, stderr=theirs)
        os.close(theirs)
        text = b""
        try:
            while part := os.read(ours, 4096):
                text += part
        except OSError:  # how Linux says that the other end is closed
            pass
        os.close(ours)
        return text.decode()

    @needs("terminal")
    def test_bar_on_a_terminal_is_erased(self):
        text = self.on_terminal()
        self.assertIn("[...", text)
        self.assertRegex(text, r" 9\d %  write")
        done = [int(share) for share in re.findall(r"(\d+) %  ", text)]
        self.assertEqual(done[1:], sorted(done[1:]))  # one bar for the run, behind "read"
        for line in text.split("\n"):  # what is still there after the last erasure
            self.assertNotIn("%", line.split("\x1b[K")[-1])

    @needs("terminal")
    def test_no_bar_if_not_wanted(self):
        self.assertNotIn("%", self.on_terminal("--no-progress"))
        self.assertEqual(self.on_terminal("-q"), "")

    def test_no_bar_without_a_terminal(self):
        self.assertNotIn(b"\r", self.check(0, CRAMBIN, "-o", "a.ply", *FAST).stderr)


if __name__ == "__main__":
    unittest.main()
