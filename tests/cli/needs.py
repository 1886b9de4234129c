# SPDX-License-Identifier: MPL-2.0
"""What some tests need and a machine may lack. @needs("chromium") before a test or a class of them
skips it there; tests/cli/CMakeLists.txt makes what has a need a test of its own, so that ctest tells
which ones were skipped."""

import functools
import importlib.util
import os
import pathlib
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
NODE = shutil.which("node")
BPY_PYTHON = os.environ.get("BPY_PYTHON", sys.executable)  # a Python that has the module bpy
MDANALYSIS_PYTHON = os.environ.get("MDANALYSIS_PYTHON", sys.executable)  # the same of MDAnalysis and prody
KVFINDER_PYTHON = os.environ.get("KVFINDER_PYTHON", sys.executable)  # the same of pyKVFinder
MODULE_PYTHON = os.environ.get("MOLSURF_MODULE") or str(ROOT / ".venv" / "bin" / "python")  # the same of vdb_molsurf
USD_PYTHON = os.environ.get("USD_PYTHON", sys.executable)  # the same of OpenUSD, pxr
# Where scripts/install_deps.sh puts packages of npm, and where npm does with --global.
NODE_ENVIRONMENT = {**os.environ, "NODE_PATH": os.pathsep.join(filter(None, [
    os.environ.get("NODE_PATH"), str(ROOT / "build-tools" / "node_modules"),
    "/usr/local/lib/node_modules", "/usr/lib/node_modules"]))}


def runs(*words, **options):
    try:
        return subprocess.run(words, capture_output=True, **options).returncode == 0
    except (OSError, subprocess.SubprocessError):
        return False


def small_address_space():
    resource.setrlimit(resource.RLIMIT_AS, (600 << 20, 600 << 20))


def other_user():
    """How subprocess runs a program that may not write everywhere."""
    return {"user": 65534, "group": 65534, "extra_groups": []} if os.geteuid() == 0 else {}


def faulty(**what):
    """The environment of a file system that lacks something: tests/support/faulty_system.cpp."""
    library = os.environ.get("FAULTY_SYSTEM", "none")  # a path with a space would be two
    return {**os.environ, "LD_PRELOAD": os.path.basename(library), "LD_LIBRARY_PATH": os.path.dirname(library),
            **{f"FAULTY_{name.upper()}": str(value) for name, value in what.items()}}


def can_mount():
    with tempfile.TemporaryDirectory() as folder:
        return runs("mount", "-t", "tmpfs", "tmpfs", folder) and runs("umount", folder)


def has_terminal():
    try:
        for end in os.openpty():
            os.close(end)
    except OSError:
        return False
    return True


def program(*names):
    return lambda: all(map(shutil.which, names))


# Name: (whether it is here, what to do if not).
NEEDS = {
    "pdb2pqr": (program("pdb2pqr"), "scripts/install_deps.sh pdb2pqr"),
    "parallel": (program("parallel"), "scripts/install_deps.sh parallel"),
    "biopython": (lambda: all(map(importlib.util.find_spec, ("numpy", "Bio"))),
                  "scripts/install_deps.sh python3-biopython"),
    "blender": (program("blender"), "scripts/install_deps.sh blender"),
    "bpy": (lambda: runs(BPY_PYTHON, "-c", "import bpy"), "pip install bpy, and BPY_PYTHON=<that Python>"),
    "apbs": (program("apbs"), "scripts/install_deps.sh apbs"),
    "chromium": (lambda: CHROMIUM, "scripts/install_deps.sh chromium"),
    "ffmpeg": (program("ffmpeg"), "scripts/install_deps.sh ffmpeg"),
    "fish": (program("fish"), "scripts/install_deps.sh fish"),
    "freesasa": (program("freesasa"), "scripts/install_deps.sh freesasa"),
    "gltf-validator": (
        lambda: NODE and runs(NODE, "-e", "require('gltf-validator')", env=NODE_ENVIRONMENT),
        "npm install --prefix build-tools gltf-validator"),
    "gmsh": (program("gmsh"), "scripts/install_deps.sh gmsh"),
    "groff": (program("groff", "preconv"), "scripts/install_deps.sh groff"),
    "kvfinder": (lambda: runs(KVFINDER_PYTHON, "-c", "import pyKVFinder"),
                 "pip install pyKVFinder==0.9.6, and KVFINDER_PYTHON=<that Python>"),
    "maps": (lambda: all(map(importlib.util.find_spec, ("mrcfile", "gridData", "skimage"))),
             "scripts/install_deps.sh python3-mrcfile python3-griddataformats python3-skimage"),
    "mdanalysis": (lambda: runs(MDANALYSIS_PYTHON, "-c", "import MDAnalysis, prody"),
                   "pip install MDAnalysis prody, and MDANALYSIS_PYTHON=<that Python>"),
    "module": (lambda: runs(MODULE_PYTHON, "-c", "import vdb_molsurf"),
               "pip install ., and MOLSURF_MODULE=<that Python>; .ci/checks runs it"),
    "openvdb": (lambda: all(map(importlib.util.find_spec, ("numpy", "pyopenvdb"))),
                "scripts/install_deps.sh python3-openvdb python3-numpy"),
    "preload": (lambda: runs(os.environ["VDB_MOLSURF"], "--version", env=faulty()),
                "the tests as ctest runs them, without sanitizers, which want to be loaded first"),
    "prusa-slicer": (program("prusa-slicer"), "scripts/install_deps.sh prusa-slicer"),
    "pymol": (program("pymol"), "scripts/install_deps.sh pymol"),
    "readelf": (program("readelf"), "scripts/install_deps.sh binutils"),
    "s3": (program("aws", "moto_server"), "pip install awscli moto[server], and their folder in PATH"),
    "slurm": (program("slurmctld", "munged", "snakemake"), "scripts/install_deps.sh slurm-wlm munge snakemake"),
    "snakemake": (program("snakemake"), "scripts/install_deps.sh snakemake"),
    "strace": (lambda: runs("strace", "-qq", "-o", "/dev/null", "-e", "inject=all:delay_exit=1:when=1", "true"),
               "scripts/install_deps.sh strace, and the right to trace"),
    "usd": (lambda: runs(USD_PYTHON, "-c", "from pxr import UsdValidation"),
            "pip install usd-core, and USD_PYTHON=<that Python>"),
    "zsh": (program("zsh"), "scripts/install_deps.sh zsh"),
    "full": (lambda: os.path.exists("/dev/full"), "a system with /dev/full"),
    "mount": (can_mount, "the right to mount a file system, as root has it"),
    "memory": (lambda: runs(os.environ["VDB_MOLSURF"], "--version", preexec_fn=small_address_space),
               "a build without sanitizers, which take memory of their own"),
    "terminal": (has_terminal, "a system with pseudo-terminals"),
    "user": (lambda: runs(os.environ["VDB_MOLSURF"], "--version", **other_user()),
             "a build folder that every user may read"),
    "tetgen": (program("tetgen"), "scripts/install_deps.sh tetgen"),
}


@functools.cache
def lacks(name):
    """None, or what to do."""
    here, remedy = NEEDS[name]
    return None if here() else f"needs {name}: {remedy}"


def typable(block):
    """The commands of a block of shell, without those that make films where ffmpeg is not here."""
    if not re.search(r"\.(gif|mp4|webm)\b", block) or not lacks("ffmpeg"):
        return block
    commands = re.findall(r"(?:.*\\\n)*.*\n", block)
    return "".join(one for one in commands if not re.search(r"\.(gif|mp4|webm)\b", one))


def needs(name):
    def mark(item):
        item.need = name
        return unittest.skipIf(lacks(name), lacks(name))(item)
    return mark


def need_of(test):
    """The need of a test, or of its class, or None."""
    return getattr(getattr(test, test.id().rsplit(".", 1)[1], None), "need", None) or getattr(
        test, "need", None)
