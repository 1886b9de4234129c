# SPDX-License-Identifier: MPL-2.0
"""Holds the numbers that README.md and docs/ have from runs against new runs: scripts/check_docs.py --figures.

A page says in a comment what has to be run, and behind a number what it is:

    <!-- run: vdb_molsurf tests/data/1crn.pdb -o crambin.json -->
    Crambin encloses 5451<!-- crambin:volume --> Å³.

A run is a script for bash. It begins on a line of its own and may have several lines. All runs of a page work one after
the other in one empty folder, in which tests, bench, scripts and paper lead to those of the project, and structures to
the folder of structures that are not part of it. A run that names a file of structures/ or paper/ which is not there is
left out. docs is a copy: a run may rewrite a part of its page, which then has to be what it was.

`crambin:volume` is a member of crambin.json or, if it is not there, of its "surface". Points lead further, into lists by
the number or the name of an item: `crambin:groups.A.area`; `crambin:groups.*.area` is the list of all. The rest of an
expression is Python, with the functions of its module math, mean(), spread() and off(). After `above` or `below` the
number is a bound: the expression rounded up or down. What would be long or is needed often gets a name, on its own line:

    <!-- names:
    areas = crambin:groups.*.area
    -->

A number that is rewritten keeps its form: its decimals, the commas of its thousands, a plus, an exponent.
"""

import json
import math
import os
import pathlib
import re
import shutil
import statistics
import subprocess
import tempfile

RUN = re.compile(r"^<!-- run:(.*?)-->", re.M | re.S)
NAMES = re.compile(r"^<!-- names:(.*?)-->", re.M | re.S)
NUMBER = r"[-+−]?\d+(?:,\d{3})*(?:\.\d+)?(?:e-?\d+)?"
FIGURE = re.compile(rf"({NUMBER})<!-- (above |below |)(\S.*?) -->", re.S)
REFERENCE = re.compile(r"\b([\w.]+):([a-z]\w*(?:\.(?:\w+|\*))*)")
LENT = ("tests", "bench", "scripts", "paper", "structures")
LENT_FILE = re.compile(r"\b(?:paper|structures)/[\w./-]*\w")


def pages(root):
    return [root / "README.md", *sorted((root / "docs").rglob("*.md"))]


def member(found, words):
    """What is reached from an object or a list of a report."""
    if not words:
        return found
    word, rest = words[0], words[1:]
    if word == "*":
        return [member(item, rest) for item in (found.values() if isinstance(found, dict) else found)]
    if isinstance(found, list):
        return member(found[int(word)] if word.isdigit() else next(i for i in found if i["name"] == word), rest)
    return member(found[word], rest)


def spread(values):
    """From the least to the largest."""
    return max(values) - min(values)


def off(values, true):
    """The largest error of values, in per cent."""
    return 100 * max(abs(value / true - 1) for value in values)


FUNCTIONS = {**vars(math), "mean": statistics.fmean, "spread": spread, "off": off}


def evaluate(expression, folder, names):
    def value(reference):
        report, words = json.loads((folder / f"{reference[1]}.json").read_text()), reference[2].split(".")
        return f"({member(report if words[0] in report else report['surface'], words)!r})"
    return eval(REFERENCE.sub(value, expression), {**FUNCTIONS, **names})


def written(value, said, bound=""):
    """The value in the form of the number that is said."""
    digits, _, exponent = said.partition("e")
    decimals = len(digits.partition(".")[2])
    if bound:
        step = 10.0 ** ((math.floor(math.log10(abs(value))) if exponent and value else 0) - decimals)
        # What is a multiple of the step but for rounding stays.
        value = step * (math.ceil(value / step - 1e-6) if bound == "above" else math.floor(value / step + 1e-6))
    commas = "," in said or not exponent and abs(value) >= 10000 and not re.match(r"\D?\d{5}", said)
    text = f"{value:{'+' if said[0] == '+' else ''}z{',' if commas else ''}.{decimals}{'e' if exponent else 'f'}}"
    text = re.sub(r"e([-+])0*(\d)", lambda found: "e" + found[1].strip("+") + found[2], text)
    return text.replace("-", "−") if "−" in said else text


class Figures:
    """The figures of pages, of which each has runs and a folder of its own."""

    def __init__(self, root, program, structures=None):
        self.root, self.program, self.structures = root, pathlib.Path(program).resolve(), structures
        self.faults, self.left_out, self.runs, self.numbers, self.unseen = [], [], 0, 0, 0

    def check(self, page, renew=False):
        """Adds the page's faults and what was left out; renew corrects the page."""
        before = page.read_text()
        if not RUN.search(before) and not FIGURE.search(before):
            return
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            self.furnish(folder)
            complete = all([self.run(found, page, folder) for found in RUN.finditer(before)])
            copy = folder / page.relative_to(self.root)
            made = copy.read_text() if copy.exists() else before
            names = self.names(made, page, folder)
            after = FIGURE.sub(lambda found: self.figure(found, page, folder, names, complete), made)
        self.compare(page, before, made)
        if renew and after != before:
            page.write_text(after)

    def furnish(self, folder):
        places = {name: self.root / name for name in LENT}
        if self.structures:
            places["structures"] = pathlib.Path(self.structures).resolve()
        for name, place in places.items():
            if place.exists():
                (folder / name).symlink_to(place)
        shutil.copytree(self.root / "docs", folder / "docs", ignore=shutil.ignore_patterns("*.png"))
        (folder / "bin").mkdir()
        (folder / "bin" / "vdb_molsurf").symlink_to(self.program)

    def run(self, found, page, folder):
        """Whether the run has made its reports."""
        lacking = [name for name in LENT_FILE.findall(found[1]) if not (folder / name).exists()]
        if lacking:
            self.left_out.append(f"{self.place(page, found)}: left out for want of {', '.join(sorted(set(lacking)))}")
            return False
        self.runs += 1
        surroundings = {**os.environ, "PATH": f"{folder / 'bin'}:{os.environ['PATH']}",
                        "VDB_MOLSURF": str(self.program), "PYTHONDONTWRITEBYTECODE": "1"}
        done = subprocess.run(["bash", "-e", "-o", "pipefail", "-c", found[1]], cwd=folder, env=surroundings,
                              capture_output=True, text=True)
        if done.returncode:
            last = (done.stderr.strip() or done.stdout.strip() or "no word").splitlines()[-1]
            self.faults.append(f"{self.place(page, found)}: the run fails with status {done.returncode}: {last}")
        return done.returncode == 0

    def names(self, text, page, folder):
        """The values of the names of a page, as far as its reports are there."""
        values = {}
        for found in NAMES.finditer(text):
            for line in found[1].strip().splitlines():
                name, expression = line.split(" = ", 1)
                try:
                    values[name.strip()] = evaluate(expression, folder, values)
                except (FileNotFoundError, NameError):
                    pass  # a figure that needs it says so
                except Exception as error:
                    self.faults.append(f"{self.place(page, found)}: {line}: {type(error).__name__} {error}")
        return values

    def figure(self, found, page, folder, names, complete):
        """The figure as it has to be."""
        said, bound, expression = found[1], found[2].strip(), " ".join(found[3].split())
        try:
            text = written(evaluate(expression, folder, names), said, bound)
        except (FileNotFoundError, NameError) as error:
            if complete:
                what = pathlib.Path(error.filename).name if isinstance(error, OSError) else error.name
                self.faults.append(f"{self.place(page, found)}: no run makes {what}")
            self.unseen += 1
            return found[0]
        except Exception as error:
            self.faults.append(f"{self.place(page, found)}: {expression}: {type(error).__name__} {error}")
            return found[0]
        self.numbers += 1
        if text != said:
            self.faults.append(f"{self.place(page, found)}: said {said}, got {text} ({expression})")
        return text + found[0][len(said):]

    def compare(self, page, before, made):
        """Lines that a run has rewritten."""
        for number, (old, new) in enumerate(zip(before.splitlines(), made.splitlines()), 1):
            if old != new:
                self.faults.append(f"{page.relative_to(self.root)}:{number}: said {old.strip()}, got {new.strip()}")
        if before.count("\n") != made.count("\n"):
            self.faults.append(f"{page.relative_to(self.root)}: a run makes more lines of it, or fewer")

    def place(self, page, found):
        line = found.string.count("\n", 0, found.start()) + 1
        return f"{page.relative_to(self.root)}:{line}"
