# SPDX-License-Identifier: MPL-2.0
"""The keywords of read() and surface(), made from the library's table of settings."""

import difflib
import numbers
import os
import re

from . import _core

SETTINGS = {row["name"]: row for row in _core.settings()}

# A word of Python, and what people call the kind of a surface.
_RENAMED = {"surface": "kind", "lambda": "lambda_"}
KEYWORDS = {_RENAMED.get(name, name.replace("-", "_")): row for name, row in SETTINGS.items()}

# Keywords of before, which are taken as well.
FORMER = {old.replace("-", "_"): new.replace("-", "_") for old, new in _core.former_names().items()}


def today(options):
    """The keywords with their names of today. Those that are None or False count as not given."""
    out = {}
    for former, value in options.items():
        name = FORMER.get(former, former)
        if out.get(name) is None or out[name] is False:
            out[name] = value
        elif value is not None and value is not False:
            raise TypeError(f"{name}: is given twice, also as {former}")
    return out


# Keywords without a row: what stands for their values, the default, and what they do.
MORE = {
    "atom_areas": ("bool", "True", "the area of each atom's part of the surface, as `atom_areas`"),
    "areas_of": ("str", '""', "the kind of surface that areas, contacts and interfaces are of, if it is another"),
    "grid": ("bool", "True", "level set and mesh; without them `ses`, `sas` and `vdw` have what is known in closed form"),
    "threads": ("int", "0", "threads at most; 0: all"),
    "progress": ("Callable[[str, float], object] | bool | None", "None",
                 "is told stage and fraction; True shows a bar by tqdm"),
}
GROUPS = ("Mapping[str, str] | None", "None", "groups of atoms: selections by name")

SETS = "bondi, alvarez, gemmi, protor, naccess, martini2, martini3"

TYPES = {"switch": "bool", "whole": "int", "number": "float", "text": "str", "word": "str",
         "list": "str | Sequence[object]", "rules": "str | float | Sequence[str | float]"}


def unknown(word, known):
    """The error of a keyword that nobody knows."""
    options = {"surface": "kind", "lambda": "lambda_"}  # those of the command line that have another name here
    other = options.get(str(word).lower().lstrip("-"))
    near = [other] if other in known else difflib.get_close_matches(str(word).lower(), known, 1, 0.6)
    return TypeError(f"unknown keyword '{str(word)[:40]}'" + (f" [hint: did you mean {near[0]}?]" if near else ""))


def described(name, value):
    """What a value of a wrong type is, without the value."""
    return TypeError(f"{name}: expected {TYPES[KEYWORDS[name]['type']]}, got {type(value).__name__}")


def _texts(name, value):
    """The values of a keyword as people would type them; None: it is left as it is."""
    kind = KEYWORDS[name]["type"]
    if kind == "switch":
        if not isinstance(value, bool) and type(value).__name__ not in ("bool_", "bool"):
            raise described(name, value)
        return [] if value else None
    if value is None:
        return None
    if kind in ("number", "whole"):
        if isinstance(value, bool) or not isinstance(value, numbers.Real):
            raise described(name, value)
        return [str(int(value)) if float(value).is_integer() else repr(float(value))]
    if isinstance(value, (str, os.PathLike)):
        return [os.fspath(value)]
    if kind in ("list", "rules") or (name == "copies"):
        parts = [value] if isinstance(value, numbers.Real) else value
        if not isinstance(parts, (list, tuple)) or not all(isinstance(p, (str, numbers.Real)) for p in parts):
            raise described(name, value)
        texts = [p if isinstance(p, str) else str(int(p)) if float(p).is_integer() else repr(float(p)) for p in parts]
        return texts if kind == "rules" else [",".join(texts)]
    raise described(name, value)


# What the settings change that read(), surface() of balls and Molecule.surface() take.
TAKEN = {"read": {"balls", "molecule"}, "surface": {"surface"}, "molecule": {"molecule", "surface"}}


def given(options, where, more=()):
    """The pairs (setting, values) of keywords.

    where: "atoms": those of surface() are taken, too; "molecule": those that choose the balls are refused; "surface": all
    that atoms need are.
    """
    pairs = []
    for name, value in today(options).items():
        if name not in KEYWORDS:
            raise unknown(name, [*KEYWORDS, *more])
        row = KEYWORDS[name]
        if where != "atoms" and row["of"] not in TAKEN[where]:
            raise TypeError(f"{name}: is for read(), which chooses the atoms")
        texts = _texts(name, value)
        if texts is not None:
            pairs.append((row["name"], texts))
    return pairs


# Questions about the atoms, which Molecule.surface() takes and read() will not any more.
ASKED_LATER = {name for name, row in KEYWORDS.items() if row["of"] == "molecule"} - {"group_by", "charges"}


def of_file(color, known):
    """Whether a colour, if it is one, is other than those that are known, and needs what files have."""
    word = color.lower()
    return "=" in word or (word in KEYWORDS["color"]["words"] and word not in known)


def sentence(row):
    """What a setting does, the words it may be, and its range; a letter of the text, as L, is the value itself."""
    text = " ".join(row["text"].split()).replace("a name of `list_radii`", SETS)
    begins_with_word = text.partition(":")[0].partition(";")[0] in row["words"]  # "ses: variational with ..."
    if not begins_with_word:
        text = text[:1].upper() + text[1:]
    words = "" if row["type"] != "word" or not row["words"] else f" One of {', '.join(row['words'])}."
    bounds = f"{row['low']:.10g} to {row['high']:.10g}" if row["low"] == row["low"] else ""
    value = row.get("value", "")
    letter = f" {value} is the value." if len(value) == 1 and re.search(rf"\b{value}\b", text) else ""
    return f"{text}.{words}" + (f" From {bounds}." if bounds not in text else "") + letter


def told(where):
    """Name, type, default and text of each keyword of read() or surface()."""
    rows = [(name, TYPES[row["type"]], row["preset"] or "", sentence(row)) for name, row in KEYWORDS.items()
            if row["of"] in TAKEN[where] or name == "color"]
    extra = {"groups": GROUPS} if where == "read" else MORE
    return rows + [(name, kind, preset, f"{text[:1].upper()}{text[1:]}.") for name, (kind, preset, text) in extra.items()]


def documented(where):
    """The keywords as paragraphs of a docstring."""
    lines = []
    for name, kind, preset, text in told(where):
        lines.append(f"    {name}: {kind}\n        {text}" + (f" Default: {preset}." if preset else ""))
    return "\n".join(lines)
