#!/usr/bin/env python3
# SPDX-License-Identifier: MPL-2.0
"""Prints docs/python_api.md, the page of all names of the package, made of its docstrings and of its table of keywords:

    python -P python/api_page.py > docs/python_api.md
"""

import inspect
import re

import vdb_molsurf as ms
from vdb_molsurf import _options, biopython, mdanalysis, mdtraj

HEAD = """\
# Python: all names

<!-- python/api_page.py makes this page. -->
[The guide](python.md) has examples. Lengths are in Å, areas in Å², volumes in Å³ unless another unit is named.
"""


def text_of(thing):
    """The docstring of something, its parameters as a list, without the keywords, which are a table."""
    text = re.split(r"\n\s*Keywords:", inspect.getdoc(thing))[0].strip()
    return re.sub(r"\n\n(?=\w+: )", "\n", re.sub(r"^(\w+): ", r"- `\1`: ", text, flags=re.MULTILINE))


def signature_of(name, function, keywords):
    """How a function is called; `**options` stands for a table."""
    parts = []
    for p in inspect.signature(function).parameters.values():
        if p.name == "self":
            continue
        if p.kind is p.KEYWORD_ONLY and not any("*" in part for part in parts):
            parts.append("*")
        if p.kind is p.VAR_KEYWORD:
            parts.append("**keywords" if keywords else "**options")
        else:
            parts.append(p.name + ("" if p.default is p.empty else f"={p.default!r}"))
    return f"`{name}({', '.join(parts)})`"


def keyword_table(where):
    """The keywords of read() or surface()."""
    rows = ["| keyword | type | default | what it does |", "|---|---|---|---|"]
    for name, *cells in _options.told(where):
        rows.append("| " + " | ".join([f"`{name}`", *(cell.replace("|", "\\|") for cell in cells)]) + " |")
    return "\n".join(rows)


def function(name, what, where=None):
    """A function with its keywords."""
    page = [f"### {signature_of(name, what, where)}", text_of(what)]
    if where:
        page.append(keyword_table(where))
    return "\n\n".join(page)


def described_class(name, what):
    """A class: its attributes as a table, then its methods."""
    page = [f"### `{name}`", text_of(what)]
    if hasattr(what, "_fields"):
        page[0] = f"### `{name}({', '.join(what._fields)})`"
    own = {key: value for key, value in vars(what).items() if not key.startswith("_")}
    attributes = [(key, value) for key, value in own.items() if isinstance(value, property)]
    if attributes:
        page.append("\n".join(["| attribute | what it is |", "|---|---|"] +
                              [f"| `{key}` | {inspect.getdoc(value)} |" for key, value in attributes]))
    for key, value in own.items():
        if inspect.isfunction(value):
            page += [f"#### {signature_of(f'{name}.{key}', value, False)}", text_of(value)]
    return "\n\n".join(page)


def main():
    page = [HEAD.rstrip()]
    things = {name: getattr(ms, name) for name in ms.__all__}
    page.append("## Functions")
    for name, thing in things.items():
        if inspect.isfunction(thing):
            page.append(function(name, thing, name if name in ("surface", "read") else None))
    page.append("## Classes")
    for name, thing in things.items():
        if inspect.isclass(thing) and not issubclass(thing, Exception):
            page.append(described_class(name, thing))
    page.append("## Errors\n\n| error | is a |\n|---|---|\n" + "\n".join(
        f"| {name} | {thing.__bases__[0].__name__} |" for name, thing in things.items()
        if inspect.isclass(thing) and issubclass(thing, Exception)))
    page.append("## In other packages")
    for module in (biopython, mdanalysis, mdtraj):
        page.append(inspect.getdoc(module))
        for name, thing in vars(module).items():
            if not name.startswith("_") and getattr(thing, "__module__", "") == module.__name__:
                where = f"{module.__name__.rpartition('.')[2]}.{name}"
                page.append(function(where, thing) if inspect.isfunction(thing) else described_class(where, thing))
    print("\n\n".join(page))


if __name__ == "__main__":
    main()
