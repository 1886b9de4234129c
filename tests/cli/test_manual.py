# SPDX-License-Identifier: MPL-2.0
"""The manual page and the completions of three shells have every option."""

import os
import pathlib
import re
import subprocess
import unittest

from needs import needs
from tool import ToolTest

VERBS = ["", "build", "batch", "compare", "bricks plan", "bricks run", "bricks merge", "convert"]
MANUAL = pathlib.Path(__file__).resolve().parents[2] / "docs/man"


class Manual(ToolTest):
    def options(self, verb):
        text = self.check(0, *verb.split(), "--help-all").stdout.decode()
        return re.findall(r"^  (?:-\w, |    )(--[a-z-]+)", text, re.MULTILINE)

    def complete(self, *words):
        """What bash offers for the last word."""
        script = ("source \"$0\"; COMP_WORDS=(\"$@\"); "
                  "COMP_CWORD=$(($# - 1)); _vdb_molsurf; printf '%s\\n' \"${COMPREPLY[@]}\"")
        done = subprocess.run(["bash", "-c", script, MANUAL / "vdb_molsurf.bash", "vdb_molsurf", *words],
                              cwd=self.folder, capture_output=True, text=True, timeout=60)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return done.stdout.split()

    def test_page_has_every_option(self):
        page = self.check(0, "--man").stdout.decode()
        self.assertEqual(page, (MANUAL / "vdb_molsurf.1").read_text())
        plain = page.replace("\\-", "-")
        for verb in VERBS:
            self.assertGreater(len(self.options(verb)), 0)
            for option in self.options(verb):
                self.assertIn(f"\\fB{option}\\fR", plain, f"{verb} {option}")

    @needs("groff")
    def test_page_is_clean(self):
        done = subprocess.run(["groff", "-man", "-ww", "-K", "utf8", "-T", "utf8", "-z",
                               MANUAL / "vdb_molsurf.1"], capture_output=True, text=True, timeout=60)
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_completion_has_every_option(self):
        script = self.check(0, "--bash-completion").stdout.decode()
        self.assertEqual(script, (MANUAL / "vdb_molsurf.bash").read_text())
        for verb in VERBS:
            offered = self.complete(*(verb.split() or ["a.pdb"]), "--")
            self.assertLessEqual(set(self.options(verb)), set(offered), verb)
            self.assertEqual(sorted(offered), sorted(self.options(verb)), verb)
            for option in offered:
                self.assertNotIn(b"unknown option", self.run_tool(*(verb.split() or ["a.pdb"]), option).stderr)

    def test_completion_of_words(self):
        self.assertEqual(self.complete("a.pdb", "--surface", "va"), ["variational"])
        self.assertEqual(self.complete("compare", "--color", "si"), ["signed-distance"])
        self.assertEqual(self.complete("inf"), ["info"])
        self.assertEqual(self.complete("bricks", "m"), ["merge"])
        (self.folder / "abc.pdb").write_text("")
        self.assertEqual(self.complete("ab"), ["abc.pdb"])
        for word in self.complete("a.pdb", "--surface", ""):
            self.check(2, "a.pdb", "--surface", word, says="-o FILE")
        for word in self.complete("a.pdb", "--fields", ""):
            self.check(1, "none.pdb", "-o", "a.vdb", "--fields", word, "--frames", "1", "--pockets", "--color",
                       "bfactor", says="none.pdb")

    def test_completions_are_those_of_the_program(self):
        for shell in ("zsh", "fish"):
            self.assertEqual(self.check(0, f"--{shell}-completion").stdout.decode(),
                             (MANUAL / f"vdb_molsurf.{shell}").read_text())

    @needs("fish")
    def test_fish(self):
        def offered(line):
            script = f"source '{MANUAL}/vdb_molsurf.fish'; complete -C '{line}'"
            done = subprocess.run(["fish", "--no-config", "-c", script], cwd=self.folder, capture_output=True,
                                  text=True, timeout=60, env={**os.environ, "HOME": str(self.folder)})
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            return [row.split("\t")[0] for row in done.stdout.splitlines()]
        for verb in VERBS:
            line = f"vdb_molsurf {verb or 'a.pdb'} --"
            self.assertEqual(sorted(offered(line)), sorted(self.options(verb)), verb)
        self.assertEqual(offered("vdb_molsurf a.pdb --surface va"), ["variational"])
        self.assertEqual(offered("vdb_molsurf bricks m"), ["merge"])

    @needs("zsh")
    def test_zsh(self):
        """compadd says what it is given: a zsh in a pseudo-terminal completes a line."""
        (self.folder / "_vdb_molsurf").write_text((MANUAL / "vdb_molsurf.zsh").read_text())
        (self.folder / "run").write_text(ZSH)

        def offered(line):
            subprocess.run(["zsh", "-f", "run", line], cwd=self.folder, capture_output=True, timeout=60)
            got = self.folder / "got"
            words = got.read_text().split()
            got.unlink()
            return words
        self.assertEqual(offered("vdb_molsurf a.pdb --surface va"), ["variational"])
        self.assertEqual(offered("vdb_molsurf bricks m"), ["merge"])
        self.assertLessEqual({"--voxel", "--surface"}, set(offered("vdb_molsurf compare a b --")))


# Prints what a zsh offers for a line. The rows of _describe are two arrays: options with and without their texts.
ZSH = r"""
zmodload zsh/zpty
zpty z zsh -f -i
zpty -w z "PS1=; fpath=($PWD \$fpath); autoload -Uz compinit; compinit -u -D; bindkey '^I' complete-word"
zpty -w z 'compadd() { local -a offered; builtin compadd -O offered "$@"; print -l -- $offered >> got }'
zpty -w z '_describe() { print -l -- ${${(P)2}%%:*} > got }'
zpty -w z 'touch ready'
for i in {1..100}; do [[ -e ready ]] && break; sleep 0.1; done
rm ready
zpty -w -n z "$1"$'\t'
for i in {1..100}; do [[ -s got ]] && break; sleep 0.1; done
sleep 0.1
zpty -d z
"""


if __name__ == "__main__":
    unittest.main()
