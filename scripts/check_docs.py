#!/usr/bin/env python3
# SPDX-License-Identifier: MPL-2.0
"""Holds what README.md, CONTRIBUTING.md, docs/ and the comments of src/ and tools/ say against the tree.

    scripts/check_docs.py [--program vdb_molsurf] [--renew]
    scripts/check_docs.py --installed FOLDER
    scripts/check_docs.py --figures [--structures FOLDER] [--program vdb_molsurf] [--renew] [PAGE...]

These have to exist: links and the headings they lead to; paths and file names in backticks, or written from a
folder of the root; numbered sections such as "docs/math.md, section 7", and ADRs; in backticks names such as
`Type::member`, `someFunction` and `function()` of the code, and the options of the program. Defaults beside options have to be
those of the help, and the files that a program prints (PRINTED) have to be what it prints; --renew writes these.
Prints one line for each fault, and exits with 1 if there is one.

The pages of the site (scripts/docs.sh) have to be in the menu of mkdocs.yml, and to link to what is copied into it.

With --installed the pages below a folder are checked instead (cmake/install_guide.cmake installs them): they link to
what is there, and name no other file of the project.

With --figures the numbers of all pages, or of some, have to be those of new runs instead, and the pictures of the gallery
what its commands draw (scripts/gallery.py). scripts/figures.py tells how a page says so; --renew then corrects numbers.
Some runs take structures of FOLDER, and are left out without it.
"""

import argparse
import os
import pathlib
import re
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[1]
SOURCES = ("src", "tools", "tests", "bench")
# Folders that a run, a build or a user makes; paths into them are not held against the tree.
MADE = re.compile(r"(build|example|install|paper|surfaces|assembly|batch|bricks|pdb|structures"
                  r"|accuracy|art|bio|colors|compare|complexes|formats|frames|gallery|many|settings|standins|start|viewers)\b")
# Namespaces of other people.
FOREIGN = {"std", "openvdb", "tbb", "gemmi", "boost", "CGAL", "molsurf"}
# Names in backticks that look like ours, and are another program's or a file's.
FOREIGN_NAMES = {"readAll", "metersPerUnit", "levelSet", "fogVolume"}
NUMBER = r"-?\d+(?:\.\d+)?(?:e-?\d+)?"

# Files of the programs' own words: which program, beside that of --program, prints them, and by which option.
PRINTED = {
    "docs/options.md": ("vdb_molsurf", "--options-page"),
    "docs/report.md": ("vdb_molsurf", "--report-page"),
    "docs/cli-help.txt": ("vdb_molsurf", "--help"),
    "docs/man/vdb_molsurf.1": ("vdb_molsurf", "--man"),
    "docs/man/vdb_molsurf.bash": ("vdb_molsurf", "--bash-completion"),
    "docs/man/vdb_molsurf.zsh": ("vdb_molsurf", "--zsh-completion"),
    "docs/man/vdb_molsurf.fish": ("vdb_molsurf", "--fish-completion"),
    "docs/man/vdb_molsurf_msms.1": ("vdb_molsurf_msms", "--man"),
    "docs/man/vdb_molsurf_nanoshaper.1": ("vdb_molsurf_nanoshaper", "--man"),
}


class Tree:
    """The files of the project, and what its code defines."""

    def __init__(self, root):
        self.root = root
        self.paths = []
        for folder, folders, files in os.walk(root):
            folders[:] = [f for f in folders if f == ".ci" or not (f.startswith((".", "__")) or (
                pathlib.Path(folder) == root and MADE.match(f)))]
            place = pathlib.Path(folder).relative_to(root)
            self.paths += [(place / name).as_posix() for name in folders + files]
        self.names = {pathlib.PurePosixPath(path).name for path in self.paths}
        # Every end of a path, with its extension and without: a name from inside a folder is enough.
        self.ends = {"/".join(parts[i:]) for path in self.paths
                     for parts in (path.split("/"), re.sub(r"\.\w+$", "", path).split("/"))
                     for i in range(len(parts))}
        self.words, self.bodies = set(), {}
        for path in self.paths:
            if path.endswith((".h", ".cpp")) and path.split("/")[0] in SOURCES:
                self.read_code((root / path).read_text())
            elif path.endswith(".py") and path.startswith("python/"):
                self.words.update(re.findall(r"\w+", (root / path).read_text()))

    def read_code(self, text):
        text = re.sub(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'\\?.\'', " ", text, flags=re.DOTALL)
        self.words.update(re.findall(r"\w+", text))
        for found in re.finditer(r"\b(?:struct|class|enum|union|namespace)\s+(\w+)[^;{}()]*\{", text):
            depth, end = 1, found.end()
            while depth and end < len(text):
                depth += {"{": 1, "}": -1}.get(text[end], 0)
                end += 1
            self.bodies.setdefault(found[1], set()).update(re.findall(r"\w+", text[found.end():end]))

    def has(self, path, page):
        path = path.rstrip("/")
        return (page.parent / path).exists() or path in self.ends


class Program:
    """The help of the program and of its verbs."""

    def __init__(self, main, verbs=None):
        self.main, self.verbs = main, verbs or {}
        texts = [main, *self.verbs.values()]
        self.options = {option for text in texts for option in re.findall(r"--[a-z][a-z-]*", text)}
        self.defaults = {}  # of "  --voxel H   edge of a voxel [0.5]", "... --steps [12]", "... [--steps 12]."
        for item in (item.rstrip() for text in texts for item in re.split(r"\n(?=  -\w, --|      --|\S|\n)", text)):
            option = re.match(r"  (?:-\w, |    )(--[a-z-]+)", item)
            last = re.search(r"(--[a-z-]+)? ?\[(--[a-z-]+)? ?([^][\s;A-Z]+)[^][]*\]\.?\Z", item)
            if last and (last[1] or last[2] or option):
                self.defaults.setdefault(last[1] or last[2] or option[1], set()).add(last[3])

    @classmethod
    def ask(cls, path):
        """Every word of the overview is tried as a verb, and every two as a verb of two words."""
        def text(*words):
            return subprocess.run([path, *words, "--help-all"], capture_output=True, text=True).stdout
        main, verbs = text(), {}
        overview = subprocess.run([path, "help"], capture_output=True, text=True).stdout
        for line in (line for line in overview.splitlines() if line.startswith("vdb_molsurf ")):
            words = [part.split("|") for part in re.split(r"[\s,]+", line)[1:]
                     if re.fullmatch(r"[a-z]+(\|[a-z]+)*", part)]
            for verb in [(w,) for part in words for w in part] + [
                    (a, b) for first, second in zip(words, words[1:]) for a in first for b in second]:
                answer = text(*verb)
                if answer not in ("", main) and (answer not in verbs.values() or len(verb) == 1):
                    verbs[" ".join(verb)] = answer
        return cls(main, verbs)


def plain(value):
    return str(float(value)) if re.fullmatch(NUMBER, value) else value


def slug(heading):
    return re.sub(r"[^\w\- ]", "", heading.lower()).strip().replace(" ", "-")


def headings(page):
    return re.findall(r"^#+ (.*)$", re.sub(r"^```.*?^```", "", page.read_text(), flags=re.M | re.S), re.M)


def path_faults(text, page, tree):
    for found in re.finditer(r"(?<![\w/.-])(?<!\]\()(?:src|tools|tests|docs|scripts|bench|cmake|\.ci)/[\w./-]*\w", text):
        if not tree.has(found[0], page):
            yield found.start(), f"there is no {found[0]}"


def link_faults(text, page):
    for found in re.finditer(r"\]\(([^)\s#]*)(?:#([^)\s]+))?\)", text):
        target = page.parent / found[1] if found[1] else page
        if re.match(r"\w+:", found[1]):
            continue
        if not target.exists():
            yield found.start(), f"the link leads to nothing: {found[1]}"
        elif found[2] and found[2] not in map(slug, headings(target)):
            yield found.start(), f"{found[1]} has no heading #{found[2]}"


def faults_of(text, page, tree, program):
    """(place, fault) of a page, or of the comments of a source file."""
    # "math.md, section 7"; "sections 5, 8 and 9" are those of the page itself, if its sections have numbers.
    for found in re.finditer(r"(?:(\w+\.md)\)?,?\s+)?\bsections?\s+(\d+(?:(?:,\s+|\s+and\s+)\d+)*)\b(?!\.\d)", text):
        name = found[1] or page.name
        titles = [title for p in tree.paths if p.endswith("/" + name) and name.endswith(".md")
                  for title in headings(tree.root / p)]
        numbers = {title.split(".")[0] for title in titles if re.match(r"\d+\.", title)}
        if numbers or found[1]:
            yield from ((found.start(), f"{name} has no section {number}")
                        for number in re.findall(r"\d+", found[2]) if number not in numbers)
    yield from path_faults(text, page, tree)
    for found in re.finditer(r"\bADR\s+(\d{4})", text):
        if not any(path.startswith(f"docs/adr/{found[1]}") for path in tree.paths):
            yield found.start(), f"there is no ADR {found[1]}"
    if page.suffix != ".md":
        return
    yield from link_faults(text, page)
    # A block that is indented or fenced has no spans.
    prose = re.sub(r"^```.*?^```|^(?:    |\t).*$", lambda m: re.sub(r"[^\n]", " ", m[0]), text, flags=re.M | re.S)
    for found in re.finditer(r"`([^`]+)`", prose):
        yield from ((found.start(), fault) for fault in span_faults(found[1], page, tree, program))
    yield from default_faults(prose, program)


def span_faults(span, page, tree, program):
    for kind, member in re.findall(r"\b([A-Za-z]\w*)::(\w+)", span):
        if kind not in FOREIGN and member not in tree.bodies.get(kind, ()):
            yield f"the code has no {kind}::{member}"
    name = re.fullmatch(r"([a-z]+[A-Z]\w*|[A-Z][a-z]+[A-Z]\w*|\w+(?=\(\)))(?:\(\))?", span)
    if name and name[1] not in tree.words | FOREIGN_NAMES:
        yield f"the code has no {name[1]}"
    if re.match(r"vdb_molsurf\s|--[a-z]", span):
        for option in set(re.findall(r"--[a-z][a-z-]*", span)) - program.options:
            yield f"the program has no {option}"
    if re.fullmatch(r"[a-z][\w.-]+(/[A-Za-z][\w.-]*)+/?", span, re.A) and not MADE.match(span) and not tree.has(span, page):
        yield f"there is no {span}"
    elif re.fullmatch(r"[\w.-]+\.(h|cpp|py|sh|md|cjs)", span) and span not in tree.names:
        yield f"there is no file {span}"


def default_faults(text, program):
    """Of table columns called default, and of "`--voxel` (0.5)", "[0.5]", "is 0.5 by default" near an option."""
    quoted = []
    for table in re.finditer(r"^\| option \| default \|.*\n(?:\|.*\n?)*", text, re.M):
        quoted += [(table.start() + row.start(), row[1], row[2])
                   for row in re.finditer(r"^\| `(--[a-z-]+)[^|]*\| (\S+)", table[0], re.M) if row[2] != "|"]
    value = rf"`?({NUMBER}|[a-z]+)`?"
    for form in (rf"`(--[a-z-]+)[^`]*`\s+\(({NUMBER})\)", rf"`(--[a-z-]+)[^`]*`[^.`\n]*\[({NUMBER})\]",
                 rf"`(--[a-z-]+)[^`]*`[^.;`]*\b(?:is|stays)\s+{value}\s+by\s+default",
                 rf"`(--[a-z-]+)[^`]*`[^.;`]*,\s+(?:and|with)\s+{value}\s+(?:is|as)\s+the\s+default",
                 rf"`(--[a-z-]+)[^`]*`[^.;`]*\bdefault\s+(?:is\s+|of\s+)?({NUMBER})"):
        quoted += [(found.start(), found[1], found[2]) for found in re.finditer(form, text)]
    quoted += [(found.start(), found[2], found[1])
               for found in re.finditer(rf"({NUMBER})\s+unless\s+`(--[a-z-]+)", text)]
    for place, option, said in quoted:
        known = program.defaults.get(option, {"off"} if option in program.options else set())
        if known and plain(said) not in map(plain, known):
            yield place, f"the default of {option} is {' or '.join(sorted(known))}, not {said}"


def site_faults(root):
    """(page, place, fault) of the site: pages that the menu lacks, and links to files that scripts/docs.sh does not copy."""
    script, menu = root / "scripts" / "docs.sh", root / "mkdocs.yml"
    copied = re.search(r"^copied=\((.*?)\)", script.read_text(), re.M | re.S)[1].split()
    inside = {path.relative_to(root).as_posix() for name in copied
              for path in (root / name, *(root / name).rglob("*")) if path.is_file()}
    inside |= {parent.as_posix() for name in inside for parent in pathlib.PurePosixPath(name).parents}
    listed = re.findall(r"([\w./-]+\.md)$", menu.read_text(), re.M)
    for name in sorted(set(listed) - inside):
        yield menu, 0, f"the menu leads to nothing: {name}"
    for name in sorted(name for name in inside if name.endswith(".md")):
        page = root / name
        if name not in listed:
            yield page, 0, "the menu of mkdocs.yml lacks this page"
        for found in re.finditer(r"\]\(([^)\s#]+)(?:#[^)\s]*)?\)", page.read_text()):
            target = os.path.normpath(page.parent / found[1])
            if not re.match(r"\w+:", found[1]) and os.path.exists(target) and os.path.relpath(target, root) not in inside:
                yield page, found.start(), f"scripts/docs.sh does not copy {found[1]} into the site"


def word_faults(root):
    """Guides, without the pages that programs make, have at most so many words."""
    most = 40000
    count = sum(len(page.read_text().split()) for page in (root / "docs").glob("*.md")
                if page.name not in ("options.md", "python_api.md"))
    print(f"docs: {count} words in the guides, at most {most}")
    if count > most:
        yield f"docs: the guides have {count} words, expected at most {most}"


def check(root, program):
    """Lines that tell of the faults."""
    tree, lines = Tree(root), []
    pages = [root / "README.md", root / "CONTRIBUTING.md", *sorted((root / "docs").rglob("*.md"))]
    for path in pages + [root / p for p in tree.paths if re.match(r"(src|tools)/.*\.(h|cpp)$", p)]:
        text = path.read_text()
        if path.suffix != ".md":  # comments only, without their slashes, of the same length
            text = re.sub(r"^(.*?)(//[/<!]*|$)", lambda m: " " * len(m[0]), text, flags=re.M) \
                if "//" in text else ""
        lines += [f"{path.relative_to(root)}:{text.count(chr(10), 0, place) + 1}: {fault}"
                  for place, fault in sorted(set(faults_of(text, path, tree, program)))]
    lines += [f"{page.relative_to(root)}:{page.read_text().count(chr(10), 0, place) + 1}: {fault}"
              for page, place, fault in site_faults(root)]
    return lines


def check_installed(root):
    """Lines that tell of the faults of installed pages."""
    tree, own, lines = Tree(root), Tree(ROOT).names, []
    for page in sorted(root.rglob("*.md")):
        text = page.read_text()
        faults = {*path_faults(text, page, tree), *link_faults(text, page)}
        for found in re.finditer(r"(?<![\w/.*-])[\w-]+\.(?:md|py|sh|cpp|cmake|cjs)\b(?!\s+of\s+the\s+sources)", text):
            if found[0] in own - tree.names:
                faults.add((found.start(), f"{found[0]} is not there"))
        lines += [f"{page.relative_to(root)}:{text.count(chr(10), 0, place) + 1}: {fault}"
                  for place, fault in sorted(faults)]
    return lines


def check_figures(words):
    import figures
    import gallery
    start, held = time.monotonic(), figures.Figures(ROOT, words.program, words.structures)
    for page in [page.resolve() for page in words.pages] or figures.pages(ROOT):
        held.check(page, words.renew)
    if not words.pages:
        held.faults += gallery.faults(pathlib.Path(words.program).resolve())
    print(*held.left_out, *held.faults, sep="\n", end="\n" if held.left_out or held.faults else "")
    print(f"figures: {held.numbers} numbers of {held.runs} runs in {time.monotonic() - start:.0f} s, "
          f"{len(held.left_out)} runs left out and {held.unseen} numbers with them, {len(held.faults)} faults")
    return 1 if held.faults else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=ROOT / "build-release/tools/vdb_molsurf")
    parser.add_argument("--renew", action="store_true", help="write the files that the programs print")
    parser.add_argument("--installed", metavar="FOLDER", type=pathlib.Path, help="check the pages that were installed")
    parser.add_argument("--figures", action="store_true", help="hold the numbers of the pages against new runs")
    parser.add_argument("--structures", metavar="FOLDER", help="of structures that are not part of the project")
    parser.add_argument("pages", nargs="*", metavar="PAGE", type=pathlib.Path, help="with --figures; all without")
    words = parser.parse_args()
    if words.installed:
        lines = check_installed(words.installed.resolve())
        if not (words.installed / "README.md").exists():
            lines.append("README.md is not there")
        print(*lines, f"installed pages: {len(lines)} faults", sep="\n")
        return 1 if lines else 0
    if not pathlib.Path(words.program).is_file():
        sys.exit(f"{words.program}: there is no program; build it, or give --program")
    if words.figures:
        return check_figures(words)
    program = Program.ask(words.program)
    lines = []
    for name, (of, option) in PRINTED.items():
        text = subprocess.run([pathlib.Path(words.program).with_name(of), option], capture_output=True, text=True).stdout
        if words.renew:
            (ROOT / name).write_text(text)
        elif not (ROOT / name).exists() or (ROOT / name).read_text() != text:
            lines.append(f"{name}: not what the program prints; run scripts/check_docs.py --renew")
    lines += check(ROOT, program)
    lines += word_faults(ROOT)
    print(*lines, sep="\n", end="\n" if lines else "")
    print(f"docs: {len(program.options)} options, {len(lines)} faults")
    return 1 if lines else 0


if __name__ == "__main__":
    sys.exit(main())
