#!/usr/bin/python3
# SPDX-License-Identifier: MPL-2.0
"""Breaks the code on purpose, one place after the other, and tells which tests notice.

    scripts/mutate.py [NAME ...] [--check] [--part K/N] [--folder build-mutate] [--parallel N]

tests/mutations.json lists the mutations: a name, a file, a text that is in it once, what replaces that text, the
targets to build, and a regular expression of the tests (as of ctest -R) of which at least one has to fail. NAME is
a part of the names of those to try; without one all are. --part 2/3 tries the second third of them: each part needs
a folder of its own. Everything happens in a copy of the tree in --folder, with a
build folder of its own, so that the tree itself is never touched; the copy stays there for the next time.

First all tests that are named have to pass without a mutation. Each mutation is then killed (a test fails, or does
not end in time), survives, or does not compile. Those of a file follow each other, since the file is compiled once
more when another one's turn comes. The last line names those that were not killed. The exit status is 0 if all are
killed, 1 if not, and 2 if the list is wrong: --check only looks whether every text is in its file, and once.
"""

import argparse
import json
import os
import pathlib
import re
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[1]
LIST = ROOT / "tests" / "mutations.json"
KEYS = {"name", "file", "text", "replacement", "target", "tests"}
SECONDS = 300  # that the tests of a mutation may take


def entry(pairs):
    """A mutation of the list, of which no key may come twice: JSON would take the last."""
    whole = dict(pairs)
    return whole if len(whole) == len(pairs) else {**whole, "twice": True}


def faults(mutations):
    """What is wrong with the list, a line each."""
    names = [mutation.get("name") for mutation in mutations]
    for mutation in mutations:
        name = mutation.get("name")
        if set(mutation) != KEYS:
            yield f"{name}: expected the keys {', '.join(sorted(KEYS))}, each once"
        elif names.count(name) > 1:
            yield f"{name}: more than one mutation has this name"
        elif not (ROOT / mutation["file"]).is_file():
            yield f"{name}: {mutation['file']}: no such file"
        elif (found := (ROOT / mutation["file"]).read_text().count(mutation["text"])) != 1:
            yield f"{name}: {mutation['file']}: expected the text once, got it {found} times: {mutation['text']!r}"
        elif mutation["text"] == mutation["replacement"]:
            yield f"{name}: the replacement is the text itself"


def copy_tree(folder):
    """Makes a folder hold the files of the tree; files that are the same keep their dates."""
    listed = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"], cwd=ROOT,
                            check=True, capture_output=True, text=True).stdout
    wanted = {path for path in listed.split("\0") if path and (ROOT / path).is_file()}
    for path in sorted(wanted):
        source, target = ROOT / path, folder / path
        data = source.read_bytes()
        if target.is_file() and target.read_bytes() == data:
            continue
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(data)
        target.chmod(source.stat().st_mode)
    for path in [p for p in folder.rglob("*") if p.is_file() or p.is_symlink()]:
        inner = path.relative_to(folder)
        if not inner.parts[0].startswith("build") and inner.as_posix() not in wanted:
            path.unlink()


def build(folder, target, jobs):
    """Builds targets; returns what the compiler said if that fails."""
    done = subprocess.run(["cmake", "--build", "--preset", "release", "--parallel", str(jobs), "--target",
                           *target.split()],
                          cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    return None if done.returncode == 0 else done.stdout


def without_tests(folder, mutations):
    """The names of mutations whose regular expression matches no test."""
    listed = subprocess.run(["ctest", "--preset", "release", "-N"], cwd=folder, check=True, capture_output=True,
                            text=True).stdout
    tests = re.findall(r"Test +#\d+: (\S+)", listed)
    return [m["name"] for m in mutations if not any(re.search(m["tests"], test) for test in tests)]


def failing(folder, tests, jobs, seconds=None):
    """The names of tests that fail, of those that a regular expression matches; at least one has to match.

    With a limit of seconds no test is started after one has failed, and no end in time is a failure as well.
    """
    hurry = ["--stop-on-failure", "--timeout", str(seconds // 2)] if seconds else []
    try:
        done = subprocess.run(["ctest", "--preset", "release", "-R", tests, "--no-tests=error", "--parallel", str(jobs),
                               *hurry],
                              cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False,
                              timeout=seconds)
    except subprocess.TimeoutExpired:
        return ["no end in time"]
    lines = done.stdout.splitlines()
    if done.returncode == 0:
        return []
    if not any("tests failed out of" in line for line in lines):
        sys.exit(f"ctest -R '{tests}': {lines[-1] if lines else 'no output'}")
    return [line.split()[2] for line in lines if line.rstrip().endswith(("(Failed)", "(Timeout)", "(SEGFAULT)"))
            or "(Subprocess aborted)" in line] or ["a test"]


def attempt(folder, mutation, jobs):
    """Applies a mutation to the copy, builds and tests it, and takes it back; returns verdict and detail."""
    path = folder / mutation["file"]
    whole = path.read_text()
    path.write_text(whole.replace(mutation["text"], mutation["replacement"]))
    try:
        if trouble := build(folder, mutation["target"], jobs):
            errors = [line for line in trouble.splitlines() if "error" in line]
            return "does not compile", (errors or [""])[0]
        killers = failing(folder, mutation["tests"], jobs, SECONDS)
        return ("killed", f"by {killers[0]}") if killers \
            else ("SURVIVED", f"{mutation['tests']} pass")
    finally:
        path.write_text(whole)


def part(text):
    """K/N as two numbers."""
    k, n = map(int, text.split("/"))
    if not 1 <= k <= n:
        raise ValueError
    return k, n


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("names", nargs="*", metavar="NAME", help="parts of the names of mutations [all]")
    parser.add_argument("--check", action="store_true", help="only look whether the texts are in their files")
    parser.add_argument("--part", type=part, default=(1, 1), metavar="K/N", help="the K-th of N parts of them [all]")
    parser.add_argument("--folder", type=pathlib.Path, default=ROOT / "build-mutate", help="of the copy [build-mutate]")
    parser.add_argument("--parallel", type=int, default=os.cpu_count(), help="jobs at a time [all cores]")
    args = parser.parse_args()

    mutations = json.loads(LIST.read_text(), object_pairs_hook=entry)
    if wrong := list(faults(mutations)):
        print(*wrong, sep="\n", file=sys.stderr)
        sys.exit(2)
    print(f"mutations: {len(mutations)}, 0 faults", flush=True)
    if args.check:
        return
    chosen = sorted((m for m in mutations if not args.names or any(name in m["name"] for name in args.names)),
                    key=lambda m: m["file"])
    k, n = args.part
    chosen = chosen[len(chosen) * (k - 1) // n:len(chosen) * k // n]
    if not chosen:
        sys.exit(f"no mutation has {' or '.join(args.names) or 'a text'} in its name")

    folder = args.folder.resolve()
    copy_tree(folder)
    done = subprocess.run(["cmake", "--preset", "release", "-DCMAKE_UNITY_BUILD=OFF"], cwd=folder,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    if done.returncode:
        sys.exit(done.stdout)
    for target in sorted({m["target"] for m in chosen}):
        print(f"building {target}", flush=True)
        if trouble := build(folder, target, args.parallel):
            sys.exit(trouble)
    if lost := without_tests(folder, chosen):
        sys.exit(f"no test for: {'; '.join(lost)}")
    if broken := failing(folder, "|".join(sorted({m["tests"] for m in chosen})), args.parallel):
        sys.exit(f"without a mutation fails: {', '.join(broken)}")

    alive = []
    for mutation in chosen:
        start = time.monotonic()
        verdict, detail = attempt(folder, mutation, args.parallel)
        if verdict != "killed":
            alive.append(mutation["name"])
        print(f"{verdict:9} {mutation['name']} ({time.monotonic() - start:.0f} s): {detail}", flush=True)
    print(f"{len(chosen) - len(alive)} of {len(chosen)} killed" + (f", not {'; '.join(alive)}" if alive else ""))
    sys.exit(1 if alive else 0)


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        sys.exit(130)
