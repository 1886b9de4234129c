# SPDX-License-Identifier: MPL-2.0
"""A hint helps whoever follows it: a call that gives it, and calls that follow it.

The hints are found in the sources, and each has a case in CASES or a reason in UNTRIED."""

import functools
import json
import math
import os
import pathlib
import re
import shutil
import subprocess
import unittest

from needs import needs
from tool import DATA, LIBRARY, ROOT, TOOL, ToolTest

# What is no text: comments, characters, space; and texts, which stand beside each other if one is cut in two.
TOKEN = re.compile(r"""//[^\n]*|/\*.*?\*/|'(?:\\.|[^'\\\n])'|\s+|("(?:\\.|[^"\\\n])*")|.""", re.DOTALL)
MEMBER = re.compile(r"`([a-z]+(?:[A-Z][a-z]*)*)`")  # of the library's options: the program names its own


def texts_of(code):
    """The string literals of a source file, those that the compiler joins in one."""
    text = ""
    for token in TOKEN.finditer(code):
        if token[1]:
            text += token[1][1:-1]
        elif text and not token[0].isspace() and not token[0].startswith(("//", "/*")):
            yield text
            text = ""


def expression_of(text):
    """A regular expression of what a literal says when it is printed."""
    text = MEMBER.sub(lambda m: "--" + re.sub("[A-Z]", lambda c: "-" + c[0].lower(), m[1]), text.replace('\\"', '"'))
    return ".*".join(map(re.escape, re.split(r"%[-+.\d]*l?[a-z%]", text)))


@functools.cache
def hints_of_sources():
    """{file: [literals with a hint]}"""
    hints = {}
    for folder in ("src/molsurf", "tools"):
        for path in sorted((ROOT / folder).rglob("*")):
            if path.suffix not in (".cpp", ".h"):
                continue
            found = dict.fromkeys(text for text in texts_of(path.read_text()) if "[hint: " in text)
            if found:
                hints[str(path.relative_to(ROOT)).removeprefix("src/molsurf/")] = list(found)
    return hints


def pdb(*atoms, head=""):
    """Atoms of (serial number of the residue, x, name, element, B factor)."""
    return head + "".join(f"ATOM  {i:5}  {name:<3} ALA A{residue:4}    {x:8.3f}   0.000   0.000  1.00{b:6.2f}{e:>12}\n"
                          for i, (residue, x, name, e, b) in enumerate(atoms, 1))


def biomt(*operators):
    """An assembly of rotations by 0 or 180 degrees about z, and shifts along x and z."""
    text = "REMARK 350 BIOMOLECULE: 1\nREMARK 350 APPLY THE FOLLOWING TO CHAINS: A\n"
    for i, (turned, x, z) in enumerate(operators, 1):
        s = -1 if turned else 1
        for row, (a, b, c, t) in enumerate(((s, 0, 0, x), (0, s, 0, 0), (0, 0, 1, z)), 1):
            text += f"REMARK 350   BIOMT{row} {i:3}{a:10.6f}{b:10.6f}{c:10.6f}     {t:10.5f}\n"
    return text


PLY = """ply
format ascii 1.0
element vertex 4
property float x
property float y
property float z
element face {}
property list uchar int vertex_indices
end_header
0 0 0
0 0 9
0 9 0
9 0 0
{}"""
FACES = ("3 0 1 2\n", "3 0 2 3\n", "3 0 3 1\n", "3 1 3 2\n")


def xyzr(points):
    return "".join(f"{x:.3f} {y:.3f} {z:.3f} 1.7\n" for x, y, z in points)


def tube(radii):
    """Rings of ten atoms."""
    return [(radius * math.cos(a), radius * math.sin(a), 1.2 * k) for k, radius in enumerate(radii)
            for a in (math.pi * (i + 0.5 * (k % 2)) / 5 for i in range(10))]


# Beside a probe a tube of 12 rings has 0.8 Å of room, and 60 atoms about a sphere have 0.5 Å.
TUBE = tube([3.9] * 12)
HEIGHTS = [(1 - (2 * i + 1) / 60, 2.399963 * i) for i in range(60)]
CAGE = [(3.6 * math.sqrt(1 - z * z) * math.cos(a), 3.6 * math.sqrt(1 - z * z) * math.sin(a), 3.6 * z) for z, a in HEIGHTS]

# Files that are there in every case, beside those of tests/data.
FILES = {
    "ion.pqr": "ATOM 1 C ION 1 0 0 0 1 2\n",
    "dot.xyzr": "0 0 0 0.1\n", "tiny.xyzr": "0.4 0.4 0.4 0.3\n", "one.xyzr": "0 0 0 1\n", "two.xyzr": "0 0 0 1.7\n3 0 0 1.7\n",
    "apart.xyzr": "2.524 -36.942 -21.611 1.19\n5.501 -40.386 -18.396 2.1\n",
    "far.xyzr": "2e4 0 0 1.7\n", "ball.xyzr": "0 0 0 100\n", "large.xyzr": "0 0 0 60\n130 0 0 60\n",
    "two.xyz": "2\n\nC 0 0 0\nO 1.2 0 0\n", "all.cif": "data_a\nloop_\n" + "".join(
        f"_atom_site.{name}\n" for name in ("group_PDB id type_symbol label_atom_id label_comp_id label_asym_id label_seq_id Cartn_x "
                                            "Cartn_y Cartn_z auth_asym_id").split()) + "".join(
        f"ATOM {i} C CA ALA {chain} 1 {9 * i} 0 0 {chain}\n" for i, chain in enumerate(("all", "B"), 1)),
    "solid.ply": PLY.format(4, "".join(FACES)), "open.ply": PLY.format(3, "".join(FACES[:3])),
    "strips.ply": PLY.format(4, "".join(FACES)).replace("face 4", "tristrips 4"),
    "residue.pdb": pdb((1, 0, "N", "N", 1), (1, 1.5, "CA", "C", 2)),
    "predicted.pdb": pdb(*((n // 2, 1.5 * n, "CA", "C", 60 + 5 * (n // 2)) for n in range(8))),
    "moved.pdb": pdb((1, 0, "CA", "C", 1), (2, 5, "CA", "C", 1), head=biomt((0, 0, 0), (0, 30, 0))),
    "bent.pdb": pdb((1, 9, "CA", "C", 1), (2, 12, "CA", "C", 1),
                    head=biomt((0, 0, 0), (1, 0, 0), (0, 400, 0), (1, -400, 1.5))),
    "nm.xyzr": "".join(f"{x / 10:.4f} {y / 10:.4f} {z / 10:.4f} 1.7\n" for x, y, z in TUBE),
    **{f"{name}.pdb": "".join(f"ATOM  {i:5}  CA  ALA A{i:4}    {x + shift:8.3f}{y:8.3f}{0:8.3f}  1.00{0:6.2f}           C\n"
                              for i, (x, y) in enumerate(((0, 0), (3.8, 0), (3.8, 3.8), (0, 3.8)), 1))
       for name, shift in (("here", 0), ("away", 90))},
    "groups.json": '{"groups": [{"name": "a", "select": "A", "colour": "#d55e00"}]}',
    "copies.json": '{"groups": [{"name": "a", "select": "A", "copies": "1"}]}',
    "own.prm": "XYZR_FileName = exposed.xyz\n", "fine.prm": "XYZR_FileName = ball.xyzr\nGrid_scale = 9\n",
    "coarse.prm": "XYZR_FileName = ball.xyzr\nGrid_scale = 1\n", "few.prm": "XYZR_FileName = two.xyzr\nGrid_scale = 9\n",
    "tube.xyzr": xyzr(TUBE), "cage.xyzr": xyzr(CAGE), "list.txt": "one.xyzr\n", "junk.csv": "junk\n",
}
FAST = "--voxel 1 --surface sas"
# A program in the place of ffmpeg, since a machine may have none.
FFMPEG = r"""printf '#!/bin/sh\nfor w; do f=$w; done; cat > "${f#file:}"\n' > ffmpeg; chmod +x ffmpeg; PATH=.:$PATH"""
PLAN = f"vdb_molsurf bricks plan 1crn.pdb --voxel 1 --bricks 2 -o plan.json -q"
RUN = "vdb_molsurf bricks run plan.json 1 -q; vdb_molsurf bricks run plan.json 2 -q"
MERGE = "vdb_molsurf bricks merge plan.json -o a.vdb"

# {source: [(hint, a call that gives it, calls that follow it...)]}; calls are lines of a shell, in one folder.
CASES = {
    "show/picture/atom_model.cpp": [
        ('--show "resid 1-9=sticks"', f"vdb_molsurf 1crn.pdb {FAST} --show 'resid 1-9' -o a.png",
         f"vdb_molsurf 1crn.pdb {FAST} --show 'resid 1-9=sticks' -o a.png")],
    "kernel/pipeline/check_balls.cpp": [
        ("multiply them by 10", f"vdb_molsurf nm.xyzr {FAST} -o a.ply", f"vdb_molsurf tube.xyzr {FAST} -o b.ply")],
    "tools/draw_result.cpp": [
        ("--show pockets=all", "vdb_molsurf 4at1.ent.gz --voxel 0.7 --surface ses --show pockets --size 60 -o a.png",
         "vdb_molsurf 4at1.ent.gz --voxel 0.7 --surface ses --show pockets=all --size 60 -o b.png")],
    "show/picture/view_file.cpp": [
        ("-o NAME.view writes one", f"printf '{{}}' > bad.view; vdb_molsurf 1crn.pdb {FAST} --view bad.view -o a.png",
         f"vdb_molsurf 1crn.pdb {FAST} -o NAME.view; vdb_molsurf 1crn.pdb {FAST} --view NAME.view -o a.png")],
    "tools/picture_atoms.cpp": [
        ("--view X,Y,Z is a direction", f"vdb_molsurf 1crn.pdb {FAST} --view '*' -o a.png",
         f"vdb_molsurf 1crn.pdb {FAST} --view 1,0,0 -o a.png")],
    "kernel/flow/evolve.cpp": [
        ("a smaller --lambda", "vdb_molsurf two.xyzr --lambda 1e4 --regularizer area -o a.vdb",
         "vdb_molsurf two.xyzr --lambda 1 --regularizer area -o a.vdb")],
    "kernel/core/strings.cpp": [
        ("did you mean --version?", "vdb_molsurf -version", "vdb_molsurf --version"),
        ("did you mean residue?", "vdb_molsurf 1crn.pdb --color resdiue -o a.ply",
         f"vdb_molsurf 1crn.pdb --color residue {FAST} -o a.ply")],
    "kernel/pipeline/check_mesh.cpp": [
        ("--voxel 0.3", "vdb_molsurf 1ubq.pdb --surface vdw -o a.ply", "vdb_molsurf 1ubq.pdb --surface vdw --voxel 0.38 -o b.ply")],
    "kernel/pipeline/remesh_run.cpp": [
        ("--remesh 0.36", "vdb_molsurf one.xyzr --surface vdw --remesh 1 -o a.ply", "vdb_molsurf one.xyzr --surface vdw --remesh 0.36 -o b.ply")],
    "kernel/pipeline/pose_error.cpp": [
        ("--lambda 0.04", "vdb_molsurf 1crn.pdb --lambda 0.1 --voxel 1 -o a.ply", "vdb_molsurf 1crn.pdb --lambda 0.04 --voxel 1 -o b.ply")],
    "surface/settings.cpp": [
        ("hydrophobicity>0", f"vdb_molsurf 1crn.pdb {FAST} --patches hydrophobicity -o a.patches.csv",
         f"vdb_molsurf 1crn.pdb {FAST} --patches 'hydrophobicity>0' -o a.patches.csv"),
        ("--group-by chain --split group", f"vdb_molsurf 1a8o.cif.gz --assembly 1 {FAST} --split chain -o a.ply",
         f"vdb_molsurf 1a8o.cif.gz --assembly 1 {FAST} --group-by chain --split group -o a.ply"),
        ("--color plain=red", f"vdb_molsurf one.xyzr {FAST} --color red -o a.ply",
         f"vdb_molsurf one.xyzr {FAST} --color plain=red -o a.ply"),
        ("all, or some of", "vdb_molsurf 1crn.pdb --fields qqqqqq -o a.vdb",
         "vdb_molsurf 1crn.pdb --fields all --voxel 1 -o a.vdb")],
    "molecule/structure/structure_list.cpp": [
        ("vdb_molsurf one.xyzr -o FILE", "vdb_molsurf batch one.xyzr -O out", f"vdb_molsurf one.xyzr {FAST} -o a.ply")],
    "molecule/selection/selection_phrase.cpp": [
        ("for example /1/A/53-132 or *;polymer", f"vdb_molsurf 1crn.pdb --select A/x {FAST} -o a.ply",
         f"vdb_molsurf 1crn.pdb --select /1/A/5-32 {FAST} -o a.ply",
         f"vdb_molsurf 1crn.pdb --select '*;polymer' {FAST} -o b.ply")],
    "molecule/selection/selection_tree.cpp": [
        ("in quotes * and ? are letters: name C*", f"vdb_molsurf 1crn.pdb --select 'protein and not name \"C*\"' {FAST} -o a.ply",
         f"vdb_molsurf 1crn.pdb --select 'protein and not name C*' {FAST} -o b.ply"),
        ("did you mean resname THR? Names have the case of the file", f"vdb_molsurf 1crn.pdb --select 'resname thr ALA' {FAST} -o a.ply",
         f"vdb_molsurf 1crn.pdb --select 'resname THR ALA' {FAST} -o b.ply")],
    "molecule/selection/parse_selection.cpp": [
        ("not known here; write within 2 of S", f"vdb_molsurf 1crn.pdb --select 'name SG extend 1' {FAST} -o a.ply",
         f"vdb_molsurf 1crn.pdb --select 'within 2 of name SG' {FAST} -o a.ply"),
        ("(all) is the word", f"vdb_molsurf all.cif --select all {FAST} -o a.ply",
         f"vdb_molsurf all.cif --select '(all)' {FAST} -o b.ply"),
        ("names follow it, as in chain A+B", f"vdb_molsurf 1crn.pdb --select 'chain = A' {FAST} -o a.ply",
         f"vdb_molsurf 1crn.pdb --select 'chain A+B' {FAST} -o a.ply"),
        ('a name that is also a word needs quotes, as in chain "all"', f"vdb_molsurf all.cif --select 'chain all' {FAST} -o a.ply",
         f"vdb_molsurf all.cif --select 'chain \"all\"' {FAST} -o a.ply"),
        ("brackets decide: (within 9 of S) and T", f"vdb_molsurf 1crn.pdb --select 'within 9 of resid 1 or resid 2' {FAST} -o a.ply",
         f"vdb_molsurf 1crn.pdb --select '(within 9 of resid 1) or resid 2' {FAST} -o c.ply",
         f"vdb_molsurf 1crn.pdb --select 'within 9 of (resid 1 or resid 2)' {FAST} -o b.ply"),
        ("resname THR", f"vdb_molsurf 1crn.pdb --select 'protein and THR' {FAST} -o a.ply",
         f"vdb_molsurf 1crn.pdb --select 'protein and resname THR' {FAST} -o a.ply"),
        ("name CA", f"vdb_molsurf 1crn.pdb --select 'protein and CA' {FAST} -o a.ply",
         f"vdb_molsurf 1crn.pdb --select 'protein and name CA' {FAST} -o a.ply")],
    "molecule/selection/match_atoms.cpp": [
        ("all, element C, name C1", f"vdb_molsurf two.xyz --select 'chain A' {FAST} -o a.ply",
         *(f"vdb_molsurf two.xyz --select '{phrase}' {FAST} --force -o a.ply"
           for phrase in ("all", "element C", "name C1", "index 0 to 9", "within 5 of index 0")))],
    "molecule/structure/detect_format.cpp": [
        ("give the structure, and this file with --trajectory", "vdb_molsurf 1d3z.xtc -o a.ply",
         f"vdb_molsurf 1d3z.pdb.gz --model 1 --trajectory 1d3z.xtc --frames 1 {FAST} -o a.ply")],
    "molecule/structure/load_text.cpp": [
        ("--max-input 10G", "vdb_molsurf 1crn.pdb -o a.ply --max-input 9K",
         f"vdb_molsurf 1crn.pdb {FAST} -o a.ply --max-input 10G"),
        ("--max-input 10G", "vdb_molsurf compare solid.ply solid.ply --max-input 100",
         "vdb_molsurf compare solid.ply solid.ply --max-input 10G")],
    "molecule/structure/archive.cpp": [
        ("a larger --max-input", "tar chf in.tar 1crn.pdb; vdb_molsurf in.tar::1crn.pdb -o a.ply --max-input 9K",
         f"vdb_molsurf in.tar::1crn.pdb {FAST} -o a.ply --max-input 1M")],
    "show/io/read_ply.cpp": [
        ("save it without strips", "vdb_molsurf compare strips.ply solid.ply",
         "vdb_molsurf compare solid.ply solid.ply")],
    "show/io/write_structure.cpp": [
        ("-o FILE.cif", "vdb_molsurf 1a8o.cif.gz --assembly 1 -o a.pdb",
         "vdb_molsurf 1a8o.cif.gz --assembly 1 -o a.cif"),
        ("-o FILE.atoms.csv", "vdb_molsurf one.xyzr -o a.pdb", "vdb_molsurf one.xyzr -o a.atoms.csv")],
    "show/io/output_file.cpp": [
        ("a shorter name", f"vdb_molsurf one.xyzr {FAST} -o $(printf %300s | tr ' ' a).ply",
         f"vdb_molsurf one.xyzr {FAST} -o $(printf %20s | tr ' ' a).ply"),
        ("--force", f"touch a.ply; vdb_molsurf one.xyzr {FAST} -o a.ply",
         f"vdb_molsurf one.xyzr {FAST} -o a.ply --force"),
        ("make the folder first", f"vdb_molsurf one.xyzr {FAST} -o new/a.ply",
         f"mkdir new && vdb_molsurf one.xyzr {FAST} -o new/a.ply")],
    "show/io/frame_table.cpp": [
        ("--force", f"vdb_molsurf 1d3z.pdb.gz --frames 1 {FAST} -o a.ply -o junk.csv",
         f"vdb_molsurf 1d3z.pdb.gz --frames 1 {FAST} -o a.ply -o junk.csv --force")],
    "scale/bricks/plan_bricks.cpp": [
        (f"--memory {66 if LIBRARY else 35}M, or a larger --voxel", f"vdb_molsurf 1crn.pdb --voxel 2 --memory {21 + LIBRARY}M -o a.ply",
         f"vdb_molsurf 1crn.pdb --voxel 2 --memory {66 if LIBRARY else 35}M -o a.ply"),
        ("or a larger --voxel", f"vdb_molsurf 1crn.pdb --memory {35 + LIBRARY}M --voxel 0.1 -o a.ply",
         f"vdb_molsurf 1crn.pdb --memory {35 + LIBRARY}M --voxel 2 -o a.ply")],
    "scale/bricks/plan_bricks.h": [
        ("a larger --voxel, or --max-hours 1", "vdb_molsurf 1crn.pdb --voxel 0.3 --max-hours 1e-5 -o a.ply",
         "vdb_molsurf 1crn.pdb --voxel 0.3 --max-hours 1 -o a.ply",
         "vdb_molsurf 1crn.pdb --voxel 4 --max-hours 1e-5 -o b.ply")],
    "scale/bricks/plan_file.cpp": [
        ("bricks plan writes one", "vdb_molsurf bricks run copies.json 1",
         f"{PLAN} && vdb_molsurf bricks run plan.json 1")],
    "kernel/core/memory.cpp": [
        ("--memory ", "vdb_molsurf 1a8o.cif.gz --memory 10M -o a.ply", "vdb_molsurf 1a8o.cif.gz --memory 200M -o a.ply")],
    "scale/bricks/atoms_file.cpp": [
        ("it has to lie beside the plan", f"{PLAN}; mkdir sub; mv plan.json sub; vdb_molsurf bricks run sub/plan.json 1",
         "mv plan.atoms sub; vdb_molsurf bricks run sub/plan.json 1"),
        ("bricks plan writes one", f"{PLAN}; echo junk > plan.atoms; vdb_molsurf bricks run plan.json 1",
         f"{PLAN} --force && vdb_molsurf bricks run plan.json 1")],
    "scale/bricks/brick_file.cpp": [
        ("run the brick again with --force", f"{PLAN}; {RUN}; echo junk >> plan.1.brick; {MERGE}",
         f"vdb_molsurf bricks run plan.json 1 --force && {MERGE}")],
    "surface/product_table.cpp": [
        ("in one piece", "vdb_molsurf bricks plan 1crn.pdb --bricks 2 --voxel 2 --color mean-curvature -o plan.json",
         "vdb_molsurf 1crn.pdb --voxel 2 --color mean-curvature -o a.ply"),
        ("without --by-symmetry", f"vdb_molsurf 1a8o.cif.gz --assembly 1 --by-symmetry --fill-cavities {FAST} -o a.ply",
         f"vdb_molsurf 1a8o.cif.gz --assembly 1 --fill-cavities {FAST} -o a.ply")],
    "surface/parts.cpp": [
        ("the groups are A", "vdb_molsurf 1crn.pdb --group-by chain --surface-of B=ses --voxel 2 -o a.ply",
         "vdb_molsurf 1crn.pdb --group-by chain --surface-of A=ses --voxel 2 -o a.ply")],
    "surface/frame_source.cpp": [
        ("the atoms of the trajectory", f"vdb_molsurf 1crn.pdb --trajectory 1d3z.xtc {FAST} -o a.ply",
         f"vdb_molsurf 1d3z.pdb.gz --trajectory 1d3z.xtc --frames 1 {FAST} -o a.ply"),
        ("--frames FIRST-", f"vdb_molsurf 1d3z.pdb.gz --frames 10-99 {FAST} -o a.ply",
         f"vdb_molsurf 1d3z.pdb.gz --frames 10- {FAST} -o a.ply")],
    "kernel/pipeline/surface_kind.cpp": [
        ("a --voxel of 0.15", "vdb_molsurf tiny.xyzr --probe 0.1 --voxel 1 -o a.ply",
         "vdb_molsurf tiny.xyzr --probe 0.1 --voxel 0.15 -o a.ply"),
        ("a --voxel of 0.05", "vdb_molsurf dot.xyzr --surface vdw --voxel 2 -o a.ply",
         "vdb_molsurf dot.xyzr --surface vdw --voxel 0.05 -o a.ply"),
        ("a --voxel of 1.1", "vdb_molsurf apart.xyzr --surface gaussian --voxel 2.25 -o a.ply",
         "vdb_molsurf apart.xyzr --surface gaussian --voxel 1.1 -o a.ply"),
        ("a smaller --voxel", f"vdb_molsurf bricks plan dot.xyzr --surface vdw --voxel 2 --bricks 1 -o plan.json; "
         f"vdb_molsurf bricks run plan.json 1 -q; {MERGE}",
         "vdb_molsurf bricks plan dot.xyzr --surface vdw --voxel 0.05 --bricks 1 -o plan.json --force; "
         f"vdb_molsurf bricks run plan.json 1 --force; {MERGE}"),
        ("a smaller --voxel, --lambda or --epsilon", "vdb_molsurf one.xyzr --lambda 1 --epsilon 2 -o a.ply",
         "vdb_molsurf one.xyzr --lambda 0.1 --epsilon 2 -o a.ply",
         "vdb_molsurf one.xyzr --lambda 1 --epsilon 1 -o b.ply"),
        ("a smaller --voxel, --lambda or --epsilon",
         f"vdb_molsurf bricks plan dot.xyzr --voxel 2 --bricks 1 -o plan.json; {RUN}; {MERGE}",
         "vdb_molsurf bricks plan dot.xyzr --voxel 0.05 --bricks 1 -o plan.json --force; "
         f"vdb_molsurf bricks run plan.json 1 --force; {MERGE}")],
    "surface/stored_surface.cpp": [
        ("--fields spline,chain_id", f"vdb_molsurf 1crn.pdb {FAST} -o a.vdb; "
         "vdb_molsurf convert a.vdb --color chain -o a.ply",
         f"vdb_molsurf 1crn.pdb {FAST} --fields spline,chain_id -o b.vdb && "
         "vdb_molsurf convert b.vdb --color chain -o a.ply"),
        ("--color element --fields spline,Cd", f"vdb_molsurf 1crn.pdb {FAST} -o a.vdb; "
         "vdb_molsurf convert a.vdb --color element -o a.ply",
         f"vdb_molsurf 1crn.pdb {FAST} --color element --fields spline,Cd -o b.vdb && "
         "vdb_molsurf convert b.vdb --color element -o a.ply"),
        ("both when it is built",
         f"vdb_molsurf 1crn.pdb {FAST} --color bfactor --fields spline,Cd -o a.vdb; vdb_molsurf convert a.vdb --palette turbo -o a.ply",
         f"vdb_molsurf 1crn.pdb {FAST} --color bfactor --palette turbo --fields spline,Cd -o b.vdb && vdb_molsurf convert b.vdb -o b.ply"),
        ("--fields spline when it is built", f"vdb_molsurf one.xyzr {FAST} -o a.vdb; vdb_molsurf convert a.vdb -o a.ply",
         f"vdb_molsurf one.xyzr {FAST} --fields spline -o b.vdb && vdb_molsurf convert b.vdb -o b.ply")],
    "analysis/measures/compare.cpp": [
        ("vdb_molsurf info FILE.vdb", f"vdb_molsurf one.xyzr {FAST} -o a.vdb && "
         "sed 's/level set/level sea/g; s/surface/surfeit/g' a.vdb > b.vdb; vdb_molsurf compare b.vdb one.xyzr",
         "vdb_molsurf info b.vdb | grep surfeit")],
    "molecule/selection/search_places.cpp": [
        ('--select "not resname ATP" leaves them out', f"vdb_molsurf 4at1.ent.gz --pocket-at 'resname ATP' {FAST} -o a.json",
         f"vdb_molsurf 4at1.ent.gz --pocket-at 'resname ATP' --select 'not resname ATP' {FAST} -o b.json")],
    "molecule/selection/select_balls.cpp": [
        ("--waters keeps it", f"vdb_molsurf 1a8o.cif.gz --select water {FAST} -o a.ply",
         f"vdb_molsurf 1a8o.cif.gz --select water --waters {FAST} -o a.ply"),
        ("--assembly 1", f"vdb_molsurf moved.pdb --instances {FAST} -o a.glb",
         f"vdb_molsurf moved.pdb --instances --assembly 1 {FAST} -o a.glb"),
        ("--assembly 1", f"vdb_molsurf 1a8o.cif.gz --by-symmetry {FAST} -o a.ply",
         f"vdb_molsurf 1a8o.cif.gz --by-symmetry --assembly 1 {FAST} -o a.ply"),
        ("move the molecule to the origin", f"vdb_molsurf far.xyzr {FAST} -o a.ply",
         f"vdb_molsurf one.xyzr {FAST} -o b.ply"),
        ("--assembly", f"vdb_molsurf moved.pdb --groups copies.json {FAST} -o a.ply",
         f"vdb_molsurf moved.pdb --groups copies.json --assembly 1 {FAST} -o a.ply"),
        ("--assembly 1", f"vdb_molsurf moved.pdb --copies 1 {FAST} -o a.ply",
         f"vdb_molsurf moved.pdb --copies 1 --assembly 1 {FAST} -o a.ply"),
        ("--assembly 1", f"vdb_molsurf moved.pdb {FAST} -o a.ply",
         f"vdb_molsurf moved.pdb --assembly 1 {FAST} -o b.ply")],
    "surface/field_table.cpp": [
        ("--color bfactor", f"vdb_molsurf 1crn.pdb {FAST} --fields value -o a.vdb",
         f"vdb_molsurf 1crn.pdb {FAST} --fields value --color bfactor -o a.vdb")],
    "show/color/palette.cpp": [
        ("--color entity", f"vdb_molsurf 1crn.pdb --group-by residues:1 --color group {FAST} -o a.ply",
         f"vdb_molsurf 1crn.pdb --color entity {FAST} -o b.ply")],
    "molecule/selection/ball_values.cpp": [
        ("--range", f"vdb_molsurf 1crn.pdb --color occupancy {FAST} -o a.ply",
         f"vdb_molsurf 1crn.pdb --color occupancy --range 0,1 {FAST} -o b.ply"),
        ("with --range they are B factors", f"vdb_molsurf predicted.pdb --color bfactor {FAST} -o a.ply",
         f"vdb_molsurf predicted.pdb --color bfactor --range 60,80 {FAST} -o b.ply")],
    "molecule/selection/symmetric_unit.cpp": [
        ("without --by-symmetry", f"vdb_molsurf moved.pdb --assembly 1 --by-symmetry {FAST} -o a.ply",
         f"vdb_molsurf moved.pdb --assembly 1 {FAST} -o a.ply"),
        ("without --by-symmetry", f"vdb_molsurf bent.pdb --assembly 1 --by-symmetry {FAST} -o a.ply",
         f"vdb_molsurf bent.pdb --assembly 1 {FAST} -o a.ply")],
    "molecule/selection/groups.cpp": [
        ("name, select, color, copies", f"vdb_molsurf 1crn.pdb --groups groups.json {FAST} -o a.ply",
         f"sed -i s/colour/color/ groups.json; vdb_molsurf 1crn.pdb --groups groups.json {FAST} -o a.ply")],
    "tools/input_files.cpp": [
        ("vdb_molsurf batch some -O DIR", "mkdir some; vdb_molsurf some -o a.ply",
         f"mkdir some; cp two.xyzr some; vdb_molsurf batch some -O dir {FAST}"),
        ("another name", "cp 1crn.pdb a.pdb; vdb_molsurf a.pdb -o a.pdb --force", "vdb_molsurf a.pdb -o b.pdb")],
    "tools/read_balls.cpp": [
        ("vdb_molsurf convert a.vdb -o FILE", f"vdb_molsurf one.xyzr {FAST} -o a.vdb; vdb_molsurf a.vdb -o a.ply",
         "vdb_molsurf convert a.vdb -o a.ply"),
        ("vdb_molsurf compare measures meshes", "vdb_molsurf solid.ply -o a.json",
         "vdb_molsurf compare solid.ply solid.ply -o a.json")],
    "tools/frames.cpp": [
        ("another name, or --force", f"for v in 2 1; do vdb_molsurf 1d3z.pdb.gz --frames 1 --surface sas --voxel $v "
         "-o a.ply -o a.csv; done", f"vdb_molsurf 1d3z.pdb.gz --frames 1 {FAST} -o b.ply -o b.csv",
         f"vdb_molsurf 1d3z.pdb.gz --frames 1 {FAST} -o a.ply -o a.csv --force"),
        ("a larger --tolerance or a smaller --voxel", "vdb_molsurf 1d3z.pdb.gz --frames 1 --max-steps 1 --lambda 0.1 --voxel 1 -o a.ply",
         "vdb_molsurf 1d3z.pdb.gz --frames 1 --max-steps 1 --lambda 0.1 --voxel 1 --tolerance 9 -o b.ply")],
    "tools/sidecar.cpp": [
        ("another name", f"vdb_molsurf moved.pdb --assembly 1 --instances --for usd {FAST} -o a.vdb -o a.usda",
         f"vdb_molsurf moved.pdb --assembly 1 --instances --for usd {FAST} -o a.vdb -o b.usda")],
    "tools/batch.cpp": [
        ("another name", "cp residue.pdb summary.pdb; echo summary.pdb > l; "
         f"vdb_molsurf batch l -O out --formats json {FAST}",
         f"mv summary.pdb other.pdb; echo other.pdb > l; vdb_molsurf batch l -O out --formats json {FAST}"),
        ("another folder, or --force", "mkdir a; cp two.xyzr a/one.xyzr; echo a/one.xyzr > l; "
         f"for i in list.txt l; do vdb_molsurf batch $i -O out {FAST}; done",
         f"vdb_molsurf batch l -O new {FAST}", f"vdb_molsurf batch l -O out {FAST} --force")],
    "tools/batch_journal.cpp": [
        ("another folder, or --force", "for v in 2 1; do vdb_molsurf batch list.txt -O out --voxel $v; done",
         "vdb_molsurf batch list.txt -O new --voxel 1", "vdb_molsurf batch list.txt -O out --voxel 1 --force")],
    "tools/brick.cpp": [
        ("it has to lie where it lay", f"{PLAN}; {RUN}; mkdir sub; mv plan.* sub; vdb_molsurf bricks merge sub/plan.json -o a.vdb",
         "cp 1crn.pdb sub; vdb_molsurf bricks merge sub/plan.json -o a.vdb"),
        ("make a new one", f"cp 1crn.pdb b.pdb; vdb_molsurf bricks plan b.pdb --voxel 2 --bricks 2 -o plan.json; "
         "echo END >> b.pdb; vdb_molsurf bricks run plan.json 1",
         "vdb_molsurf bricks plan b.pdb --voxel 2 --bricks 2 -o plan.json --force; vdb_molsurf bricks run plan.json 1"),
        ("another folder, or --force", f"{PLAN}; {RUN}; {PLAN} --force --radii bondi; vdb_molsurf bricks run plan.json 1",
         "vdb_molsurf bricks run plan.json 1 --force", "mkdir new; cp plan.json plan.atoms new; "
         "vdb_molsurf bricks run new/plan.json 1"),
        ("make a new one", f"{PLAN}; cp plan.atoms kept; {PLAN} --force --radii alvarez; cp kept plan.atoms; "
         "vdb_molsurf bricks run plan.json 1",
         f"{PLAN} --force; vdb_molsurf bricks run plan.json 1")],
    "analysis/pockets/find_pore.cpp": [
        ("its ends, as --pore 'X,Y,Z -> X,Y,Z'", "vdb_molsurf 1grm.pdb.gz --pore x -o a.pore.csv",
         "vdb_molsurf 1grm.pdb.gz --pore '0,-12.5,3 -> 0,12.5,3' -o a.pore.csv"),
        ("ends where atoms are on all sides, or in front of the mouths", "vdb_molsurf 1grm.pdb.gz --pore '22,-12,3 -> 22,12,3' -o a.pore.csv",
         "vdb_molsurf 1grm.pdb.gz --pore '0,-12.5,3 -> 0,12.5,3' -o a.pore.csv")],
    "analysis/pockets/find_tunnels.cpp": [
        ("atoms beside it, as resid 57, or a smaller --tunnel-probe", "vdb_molsurf 1grm.pdb.gz --tunnels-from 0,0,3 -o a.tunnels.csv",
         "vdb_molsurf 1grm.pdb.gz --tunnels-from 'resid 1' -o a.tunnels.csv"),
        ("a larger --probe-out", "vdb_molsurf 1grm.pdb.gz --tunnels-from 0,40,3 -o a.tunnels.csv",
         "vdb_molsurf 1grm.pdb.gz --tunnels-from 0,-4,3 --probe-out 5 -o a.tunnels.csv"),
        ("a smaller --tunnel-probe", "vdb_molsurf 1grm.pdb.gz --tunnels-from 0,0,3.9 --tunnel-probe 1.35 -o a.tunnels.csv",
         "vdb_molsurf 1grm.pdb.gz --tunnels-from 0,0,3.9 --tunnel-probe 1.2 -o a.tunnels.csv")],
    "surface/pockets.cpp": [
        ("--voxel 0.7", "vdb_molsurf 1crn.pdb --voxel 1 -o a.pockets.csv", "vdb_molsurf 1crn.pdb --voxel 0.7 -o b.pockets.csv"),
        ("--surface ses", "vdb_molsurf 1crn.pdb --color pocket --voxel 0.7 -o a.ply",
         "vdb_molsurf 1crn.pdb --color pocket --voxel 0.7 --surface ses -o b.ply")],
    "tools/build.cpp": [
        ("--groups FILE names parts of a chain", "vdb_molsurf 1crn.pdb --interfaces -o a.json",
         "printf 'a resid 1-20\\nb resid 21-46\\n' > FILE; vdb_molsurf 1crn.pdb --interfaces --groups FILE -o a.json"),
        ("--groups FILE names parts of them", "vdb_molsurf 1crn.pdb -o a.interfaces.csv",
         "printf 'a resid 1-20\\nb resid 21-46\\n' > FILE; vdb_molsurf 1crn.pdb --groups FILE -o b.interfaces.csv"),
        ("--pocket-cut 0 finds", "vdb_molsurf 1ubq.pdb --pocket-at 'resid 10' -o a.pockets.csv",
         "vdb_molsurf 1ubq.pdb --pocket-at 'resid 10' --pocket-cut 0 -o a.pockets.csv"),
        (" opens the widest", "vdb_molsurf tube.xyzr -v -o a.ply", "vdb_molsurf tube.xyzr -v --epsilon 0.25 -o a.ply --force",
         "vdb_molsurf tube.xyzr -v --surface ses -o a.ply --force"),
        (" --voxel ", "vdb_molsurf cage.xyzr -v -o a.ply", "vdb_molsurf cage.xyzr -v --epsilon 0.1 --voxel 0.2 -o a.ply --force"),
        ("--surface", f"vdb_molsurf 1crn.pdb --voxel 1 -o a.ply -o a.residues.csv",
         "vdb_molsurf 1crn.pdb --voxel 1 --surface ses -o b.ply -o b.residues.csv"),
        ("fewer atoms by --select, or --max-hours 1",
         "vdb_molsurf 1crn.pdb --group-by residues:1 -o a.interfaces.csv -j 1 --max-hours 7e-5",
         "vdb_molsurf 1crn.pdb --group-by residues:1 -o a.interfaces.csv -j 1 --max-hours 1",
         "vdb_molsurf 1crn.pdb --group-by residues:1 -o b.interfaces.csv -j 1 --max-hours 7e-5 --select 'resid 18-23'"),
        ("a plan of more bricks, or --max-hours 1", "vdb_molsurf bricks plan 1crn.pdb --voxel 0.15 --bricks 2 -o plan.json; "
         "vdb_molsurf bricks run plan.json 1 -j 1 --max-hours 2.2e-4",
         "vdb_molsurf bricks run plan.json 1 -j 1 --max-hours 1",
         "vdb_molsurf bricks plan 1crn.pdb --voxel 0.15 --bricks 12 -o plan.json --force; "
         "vdb_molsurf bricks run plan.json 1 -j 1 --max-hours 2.2e-4 --force"),
        ("a surface of a larger --voxel, or --max-hours 1", "vdb_molsurf 1crn.pdb --voxel 0.1 --surface sas -o a.vdb; "
         "vdb_molsurf convert a.vdb -j 1 -o a.ply --max-hours 3e-4",
         "vdb_molsurf convert a.vdb -j 1 -o a.ply --max-hours 1",
         "vdb_molsurf 1crn.pdb --voxel 1 --surface sas -o b.vdb; "
         "vdb_molsurf convert b.vdb -j 1 -o b.ply --max-hours 3e-4"),
        ("fewer --max-steps", "vdb_molsurf 1crn.pdb --flow paper --max-steps 2000 -j 64 --max-hours 0.0003 -o a.ply",
         "vdb_molsurf 1crn.pdb --flow paper --max-steps 5 -j 64 --max-hours 0.0003 -o a.ply || test $? = 3"),
        ("a larger --voxel or --max-hours", # its threads make the estimate of hours smaller than it is
         "vdb_molsurf 1crn.pdb --surface ses --voxel 0.1 -j 64 --max-hours 1e-5 -o a.ply",
         "vdb_molsurf 1crn.pdb --surface ses --voxel 2 -j 64 --max-hours 1e-5 -o a.ply",
         "vdb_molsurf 1crn.pdb --surface ses --voxel 0.1 -j 64 --max-hours 1 -o b.ply"),
        ("--contacts atom", "vdb_molsurf residue.pdb --contacts residue -o a.contacts.csv",
         "vdb_molsurf residue.pdb --contacts atom -o b.contacts.csv")],
    "surface/file_settings.cpp": [
        ("-o NAME.density.mrc and NAME.mask.mrc with --pixel-size are what it reads",
         f"vdb_molsurf 1crn.pdb {FAST} --for relion -o a.mrc",
         f"vdb_molsurf 1crn.pdb {FAST} --pixel-size 4 -o a.density.mrc -o a.mask.mrc")],
    "surface/tomogram_map.cpp": [
        ("42 hold its mask, too", f"vdb_molsurf 1crn.pdb {FAST} --pixel-size 1 --box-size 12 -o a.mask.mrc",
         f"vdb_molsurf 1crn.pdb {FAST} --pixel-size 1 --box-size 42 -o a.mask.mrc"),
        ("larger pixels", f"vdb_molsurf 1crn.pdb {FAST} --resolution 50 --pixel-size 0.1 -o a.density.mrc",
         f"vdb_molsurf 1crn.pdb {FAST} --resolution 50 --pixel-size 5 -o a.density.mrc")],
    "tools/convert.cpp": [
        ("--iso V -o FILE.vdb", f"vdb_molsurf 1crn.pdb {FAST} -o m.mrc; vdb_molsurf convert m.mrc -o a.ply",
         "vdb_molsurf convert m.mrc --iso -0.1 -o l.vdb", "vdb_molsurf convert l.vdb -o a.ply"),
        ("vdb_molsurf two.xyzr -o FILE makes a surface", "vdb_molsurf convert two.xyzr -o a.ply",
         f"vdb_molsurf two.xyzr {FAST} -o a.ply"),
        ("a surface of a larger --voxel, or a larger --max-hours",
         "vdb_molsurf 1crn.pdb --voxel 0.12 --surface sas -o a.vdb; "
         "vdb_molsurf convert a.vdb -j 64 -o a.ply --max-hours 1e-5",
         "vdb_molsurf convert a.vdb -j 64 -o a.ply --max-hours 1",
         "vdb_molsurf 1crn.pdb --voxel 2 --surface sas -o b.vdb; "
         "vdb_molsurf convert b.vdb -o b.ply --max-hours 1e-5")],
    "tools/build_in_bricks.cpp": [
        ("without --memory", f"vdb_molsurf 1crn.pdb --memory {50 + LIBRARY}M --voxel 0.15 --center -o a.ply",
         "vdb_molsurf 1crn.pdb --voxel 0.15 --center -o a.ply"),
        ("--memory ", f"vdb_molsurf 1crn.pdb --voxel 0.2 --memory {40 + LIBRARY}M --fill-cavities -o a.ply",
         f"vdb_molsurf 1crn.pdb --voxel 0.2 --memory {68 + LIBRARY}M --fill-cavities -o a.ply"),
        ("--memory ", "vdb_molsurf 1crn.pdb --voxel 2 --memory 10M -o a.ply", # and then the hint that follows
         f"vdb_molsurf 1crn.pdb --voxel 2 --memory {29 + LIBRARY}M -o a.ply || vdb_molsurf 1crn.pdb --voxel 2 --memory 0.1G -o a.ply")],
    "surface/solver_files.cpp": [
        ("--pdie 2 --sdie 80", "vdb_molsurf ion.pqr --for apbs --pdie 80 --sdie 2 -o near/",
         "vdb_molsurf ion.pqr --for apbs --pdie 2 --sdie 80 --force -o near/"),
        ("--surface ses, or --match ses", "vdb_molsurf ion.pqr --for apbs --surface vdw -o far/",
         "vdb_molsurf ion.pqr --for apbs --surface ses --force -o far/ && vdb_molsurf ion.pqr --for apbs --match ses --force -o far/")],
    "tools/cli/complete.cpp": [
        ("-o FILE.pockets.csv", "vdb_molsurf 1crn.pdb -o a.pocket.csv", "vdb_molsurf 1crn.pdb --surface ses -o a.pockets.csv"),
        ("a name without .gz", f"vdb_molsurf 1crn.pdb {FAST} -o a.vdb.gz", f"vdb_molsurf 1crn.pdb {FAST} -o a.vdb"),
        ("-o run/", "vdb_molsurf ion.pqr --for apbs -o a.ply",
         "vdb_molsurf ion.pqr --for apbs -o run/"),
        ("--for apbs -o run/", "vdb_molsurf ion.pqr -o a.apbs.in", "vdb_molsurf ion.pqr --for apbs -o run/ --force"),
        ("-o FILE.pore.csv", "vdb_molsurf 1grm.pdb.gz -o .pore.csv", "vdb_molsurf 1grm.pdb.gz -o a.pore.csv"),
        ("-o FILE.residues.csv, or -o FILE.json --areas residues", "vdb_molsurf 1crn.pdb -o a.residues.json",
         "vdb_molsurf 1crn.pdb -o a.residues.csv", "vdb_molsurf 1crn.pdb -o a.json --areas residues"),
        ("-o FILE, for example -o surface.vdb", f"vdb_molsurf one.xyzr {FAST}",
         f"vdb_molsurf one.xyzr {FAST} -o surface.vdb"),
        ("-o FILE, for example -o surface.vdb", f"{PLAN}; {RUN}; vdb_molsurf bricks merge plan.json",
         "vdb_molsurf bricks merge plan.json -o surface.vdb"),
        ("-o .ply, .glb, .png or .html", f"vdb_molsurf one.xyzr {FAST} --color chain -o a.stl",
         *(f"vdb_molsurf one.xyzr {FAST} --color chain -o a.{kind}" for kind in ("ply", "glb", "png", "html"))),
        ("-o .vdb", f"vdb_molsurf one.xyzr {FAST} --fields density -o a.ply",
         f"vdb_molsurf one.xyzr --voxel 0.5 --fields density -o a.vdb"),
        ("-o FILE.glb has all",
         f"vdb_molsurf moved.pdb --instances --assembly 1 {FAST} -o a.ply",
         *(f"vdb_molsurf moved.pdb --instances --assembly 1 {FAST} -o a.{kind}"
           for kind in ("glb", "usda", "html", "png", "json"))),
        ("vdb_molsurf molecule.pdb -o surface.vdb; vdb_molsurf --help lists the options", "vdb_molsurf -o surface.vdb",
         f"vdb_molsurf 1crn.pdb {FAST} -o surface.vdb", "vdb_molsurf --help"),
        ("vdb_molsurf batch - -O DIR", "vdb_molsurf 1crn.pdb two.xyzr -o surface.vdb",
         f"ls 1crn.pdb two.xyzr | vdb_molsurf batch - -O dir {FAST}"),
        ("-o a/surface.ply", "mkdir a; vdb_molsurf 1crn.pdb -o a/", f"mkdir -p a; vdb_molsurf 1crn.pdb {FAST} -o a/surface.ply"),
        ("-o x.vdb, -o x.json; --help lists the formats", "vdb_molsurf 1crn.pdb -o x",
         f"vdb_molsurf 1crn.pdb {FAST} -o x.vdb", f"vdb_molsurf 1crn.pdb {FAST} -o x.json", "vdb_molsurf --help | grep .ply"),
        (".png; --help lists the formats", "vdb_molsurf 1crn.pdb -o x.pdf", f"vdb_molsurf 1crn.pdb {FAST} -o x.png"),
        (".mp4; --help lists the formats", "vdb_molsurf 1crn.pdb -o x.avi --turntable 2",
         f"{FFMPEG} vdb_molsurf one.xyzr {FAST} -o x.mp4 --turntable 2"),
        ("--help lists the formats", "vdb_molsurf 1crn.pdb -o x.qqqqq", "vdb_molsurf --help | grep .ply"),
        ("vdb_molsurf batch list.txt -O surfaces", "vdb_molsurf batch", "vdb_molsurf batch list.txt -O surfaces"),
        ("-O DIR", "vdb_molsurf batch list.txt", "vdb_molsurf batch list.txt -O DIR"),
        ("vdb_molsurf compare a.vdb b.ply -o difference.ply", "vdb_molsurf compare solid.ply",
         f"vdb_molsurf two.xyzr {FAST} -o a.vdb -o b.ply && vdb_molsurf compare a.vdb b.ply -o difference.ply"),
        ("vdb_molsurf convert surface.vdb -o surface.ply", "vdb_molsurf convert",
         f"vdb_molsurf two.xyzr {FAST} --fields spline -o surface.vdb && "
         "vdb_molsurf convert surface.vdb -o surface.ply"),
        ("vdb_molsurf bricks plan molecule.cif -o plan.json --bricks 8", "vdb_molsurf bricks plan",
         "vdb_molsurf bricks plan 1a8o.cif.gz -o plan.json --bricks 8"),
        ("-o plan.json", "vdb_molsurf bricks plan 1crn.pdb --bricks 8",
         "vdb_molsurf bricks plan 1crn.pdb --bricks 8 -o plan.json"),
        ("vdb_molsurf bricks run plan.json 1", f"{PLAN}; vdb_molsurf bricks run plan.json",
         "vdb_molsurf bricks run plan.json 1"),
        ("vdb_molsurf bricks merge plan.json -o surface.vdb", f"{PLAN}; {RUN}; vdb_molsurf bricks merge",
         "vdb_molsurf bricks merge plan.json -o surface.vdb")],
    "show/picture/film.cpp": [
        ("a name that ends in .png writes the pictures one by one", f"PATH=/none \"$(command -v vdb_molsurf)\" one.xyzr {FAST} -o x.mp4 --turntable 2",
         f"vdb_molsurf one.xyzr {FAST} -o x.png --turntable 2"),
        ("a name that ends in .png writes the pictures one by one", f"ln -sf /bin/false ffmpeg; PATH=.:$PATH vdb_molsurf one.xyzr {FAST} -o x.mp4 --turntable 2",
         f"vdb_molsurf one.xyzr {FAST} --force -o x.png --turntable 2")],
    "show/picture/legend_svg.cpp": [
        ("--color chain", f"vdb_molsurf 1crn.pdb {FAST} -o a.legend.svg", f"vdb_molsurf 1crn.pdb {FAST} --color chain -o a.legend.svg")],
    "tools/cli/option_table.cpp": [
        ("all cores are used without --threads", f"vdb_molsurf one.xyzr {FAST} -j 0 -o a.ply", f"vdb_molsurf one.xyzr {FAST} -o a.ply")],
    "tools/cli/pair_table.cpp": [
        ("--patches 'hydrophobicity>0', for example", f"vdb_molsurf 1crn.pdb {FAST} -o a.patches.csv",
         f"vdb_molsurf 1crn.pdb {FAST} --patches 'hydrophobicity>0' -o a.patches.csv"),
        ('--tunnels-from "resid 57", for example', "vdb_molsurf 1grm.pdb.gz -o a.tunnels.csv",
         "vdb_molsurf 1grm.pdb.gz --tunnels-from 'resid 1' -o a.tunnels.csv"),
        ("-o FILE.tunnels.csv for one", "vdb_molsurf 1grm.pdb.gz --tunnels-from 'resid 1' -o a.tunnel_frames.csv",
         "vdb_molsurf 1grm.pdb.gz --tunnels-from 'resid 1' -o a.tunnels.csv"),
        ("vdb_molsurf compare A B --superpose auto", f"vdb_molsurf 1crn.pdb {FAST} --superpose auto -o a.ply",
         f"cp 1crn.pdb A; cp 1crn.pdb B; vdb_molsurf compare A B --superpose auto {FAST}"),
        ("another --color", f"vdb_molsurf 1d3z.pdb.gz {FAST} --frames 1 --superpose auto --color potential=x.dx -o a.ply",
         f"vdb_molsurf 1d3z.pdb.gz {FAST} --frames 1 --superpose auto --color chain -o a.ply"),
        ("--turntable 100", f"{FFMPEG} vdb_molsurf one.xyzr {FAST} -o y.mp4", f"{FFMPEG} vdb_molsurf one.xyzr {FAST} --size 60 -o y.mp4 --turntable 100"),
        ("without --instances", "vdb_molsurf 1a8o.cif.gz --assembly 1 --instances -o a.forces.csv",
         "vdb_molsurf 1a8o.cif.gz --assembly 1 -o a.forces.csv"),
        ("--surface smooth-sas", "vdb_molsurf 1crn.pdb --surface gaussian -o a.forces.csv",
         "vdb_molsurf 1crn.pdb --surface smooth-sas -o a.forces.csv"),
        ("--lambda 0.02, without --flow and --steps",
         "vdb_molsurf 1crn.pdb --surface variational --lambda 0.1 -o a.forces.csv",
         "vdb_molsurf 1crn.pdb --surface variational --lambda 0.02 -o a.forces.csv"),
        ("--fields surface,Cd in its place", f"vdb_molsurf 1crn.pdb {FAST} --memory 1G --for blender -o a.vdb",
         f"vdb_molsurf 1crn.pdb {FAST} --memory 1G --fields surface,Cd -o a.vdb"),
        ("--format ply", f"vdb_molsurf one.xyzr {FAST} -o - > a.ply",
         f"vdb_molsurf one.xyzr {FAST} -o - --format ply > a.ply"),
        ("--copies fold:5, for example", f"vdb_molsurf 2buk.pdb.gz --assembly 1 {FAST} --show spheres,others -o a.png",
         f"vdb_molsurf 2buk.pdb.gz --assembly 1 --copies fold:5 {FAST} --show spheres,others -o a.png"),
        ("-o FILE.residues.csv for areas", "vdb_molsurf 1crn.pdb -o a.csv", "vdb_molsurf 1crn.pdb -o a.residues.csv"),
        ("--trajectory", f"vdb_molsurf 1d3z.pdb.gz --model 2 --frames 1 {FAST} -o a.ply",
         f"vdb_molsurf 1d3z.pdb.gz --model 2 --frames 1 --trajectory 1d3z.xtc {FAST} -o a.ply"),
        ("a run without --coarse", "vdb_molsurf 1crn.pdb --coarse residue -o a.residues.csv",
         "vdb_molsurf 1crn.pdb -o a.residues.csv"),
        ("--interfaces has the areas of groups alone",
         "vdb_molsurf 1crn.pdb --group-by residues:23 --split group --voxel 2 -o a.residues.csv",
         "vdb_molsurf 1crn.pdb --group-by residues:23 --interfaces --voxel 2 -o a.json"),
        ("a run without --surface-of",
         "vdb_molsurf 1crn.pdb --group-by chain --surface-of A=ses --voxel 2 -o a.residues.csv",
         "vdb_molsurf 1crn.pdb --group-by chain --voxel 2 -o a.residues.csv"),
        ("--by-symmetry has those of a unit", "vdb_molsurf 1a8o.cif.gz --assembly 1 --instances -o a.residues.csv",
         "vdb_molsurf 1a8o.cif.gz --assembly 1 --by-symmetry -o a.residues.csv"),
        ("--surface sas needs no grid", "vdb_molsurf 1crn.pdb --surface gaussian --memory 80M -o a.residues.csv",
         "vdb_molsurf 1crn.pdb --surface sas --memory 80M -o a.residues.csv"),
        ("--surface sas or vdw", "vdb_molsurf 1a8o.cif.gz --assembly 1 --by-symmetry --surface ses -o a.residues.csv",
         "vdb_molsurf 1a8o.cif.gz --assembly 1 --by-symmetry --surface sas -o a.residues.csv",
         "vdb_molsurf 1a8o.cif.gz --assembly 1 --by-symmetry --surface vdw -o b.residues.csv"),
        ("without --by-symmetry", "vdb_molsurf 1a8o.cif.gz --assembly 1 --by-symmetry -o a.contacts.csv",
         "vdb_molsurf 1a8o.cif.gz --assembly 1 -o a.contacts.csv"),
        ("--group-by entity --color group", f"vdb_molsurf 1a8o.cif.gz --color entity --group-by chain {FAST} -o a.ply",
         f"vdb_molsurf 1a8o.cif.gz --group-by entity --color group {FAST} -o a.ply"),
        ("-o FILE.glb is a file for each frame",
         f"vdb_molsurf 1d3z.pdb.gz {FAST} --frames 1 --group-by residues:23 --split group -o a.usda",
         f"vdb_molsurf 1d3z.pdb.gz {FAST} --frames 1 --group-by residues:23 --split group -o a.glb"),
        ("--memory 8G in its place", f"vdb_molsurf 1a8o.cif.gz --by-symmetry --assembly 1 {FAST} -o a.vdb",
         f"vdb_molsurf 1a8o.cif.gz --memory 8G --assembly 1 {FAST} -o a.vdb"),
        ("--pixel-size 4, in Å", f"vdb_molsurf 1crn.pdb {FAST} -o a.density.mrc",
         f"vdb_molsurf 1crn.pdb {FAST} --pixel-size 4 -o a.density.mrc"),
        ("-o FILE.vdb holds all", "vdb_molsurf 1crn.pdb --group-by residues:23 --split group --voxel 2 -o a.mrc",
         "vdb_molsurf 1crn.pdb --group-by residues:23 --split group --voxel 2 -o a.vdb"),
        ("--group-by copy --color group", f"vdb_molsurf 1a8o.cif.gz --assembly 1 --color copy --group-by chain {FAST} -o a.ply",
         f"vdb_molsurf 1a8o.cif.gz --assembly 1 --group-by copy --color group {FAST} -o a.ply"),
        ("--group-by class --color group", f"vdb_molsurf 1a8o.cif.gz --assembly 1 --color class --group-by chain {FAST} -o a.ply",
         f"vdb_molsurf 1a8o.cif.gz --assembly 1 --group-by class --color group {FAST} -o a.ply")],
    "tools/cli/parse.cpp": [
        ("vdb_molsurf help", "vdb_molsurf bricks", "vdb_molsurf help | grep 'bricks plan'"),
        ("vdb_molsurf convert --help", "vdb_molsurf convert a.vdb --qqqqqq", "vdb_molsurf convert --help"),
        ("for example --output surface.vdb", "vdb_molsurf 1crn.pdb -o", f"vdb_molsurf 1crn.pdb {FAST} --output surface.vdb"),
        ("vdb_molsurf --help", "vdb_molsurf 1crn.pdb --qqqqqq", "vdb_molsurf --help | grep -e '-o,'")],
    "tools/compare.cpp": [
        ("--superpose auto lays B on A", f"vdb_molsurf compare here.pdb away.pdb {FAST}", f"vdb_molsurf compare here.pdb away.pdb {FAST} --superpose auto"),
        ("write a plain .vdb", f"vdb_molsurf two.xyzr {FAST} --for blender4 -o a.vdb; vdb_molsurf compare a.vdb two.xyzr",
         f"vdb_molsurf two.xyzr {FAST} -o b.vdb && vdb_molsurf compare b.vdb two.xyzr {FAST}"),
        ("a larger --max-hours", "vdb_molsurf 1crn.pdb --voxel 0.25 --surface sas -o a.ply; "
         "vdb_molsurf compare a.ply a.ply -j 64 --max-hours 1e-5",
         "vdb_molsurf compare a.ply a.ply -j 64 --max-hours 1"),
        ("-o .ply", "vdb_molsurf compare open.ply solid.ply -o a.vdb",
         "vdb_molsurf compare open.ply solid.ply -o a.ply"),
        ("a larger --tolerance or a smaller --voxel", "vdb_molsurf compare 1crn.pdb solid.ply --epsilon 0.1 --voxel 0.75",
         "vdb_molsurf compare 1crn.pdb solid.ply --epsilon 0.1 --voxel 0.75 --tolerance 0.03",
         "vdb_molsurf compare 1crn.pdb solid.ply --epsilon 0.1 --voxel 0.4")],
    "tools/outputs.cpp": [
        ("more --steps", "vdb_molsurf one.xyzr --voxel 1 --steps 0 -o a.ply", "vdb_molsurf one.xyzr --voxel 1 --steps 4 -o b.ply"),
        ("--steps 20 goes on", "vdb_molsurf 1a8o.cif.gz --assembly 1 --voxel 1 --regularizer area --lambda 0.5 --steps 5 -o a.ply",
         "vdb_molsurf 1a8o.cif.gz --assembly 1 --voxel 1 --regularizer area --lambda 0.5 --steps 20 --tolerance 0.1 -o b.ply"),
        (" goes on, ", "vdb_molsurf 1crn.pdb --epsilon 0.05 --voxel 0.8 --flow newton -o a.ply",
         "vdb_molsurf 1crn.pdb --epsilon 0.05 --voxel 0.8 --flow newton -o a.ply --force 2>&1 | sed -n 's/.*hint: \\(--max-steps [0-9]*\\).*/\\1/p' > t; "
         "vdb_molsurf 1crn.pdb --epsilon 0.05 --voxel 0.8 --flow newton $(cat t) -o b.ply",
         "vdb_molsurf 1crn.pdb --epsilon 0.05 --voxel 0.8 --flow newton -o a.ply --force 2>&1 | sed -n 's/.*\\(--tolerance [0-9.]*\\).*/\\1/p' > t; "
         "vdb_molsurf 1crn.pdb --epsilon 0.05 --voxel 0.8 --flow newton $(cat t) -o c.ply"),
        ("--flow newton makes steps", "vdb_molsurf 1crn.pdb --epsilon 0.1 --voxel 0.75 -o a.ply",
         "vdb_molsurf 1crn.pdb --epsilon 0.1 --voxel 0.75 --flow newton -o b.ply", "vdb_molsurf 1crn.pdb --epsilon 0.1 --voxel 0.4 -o c.ply",
         "vdb_molsurf 1crn.pdb --epsilon 0.1 --voxel 0.75 -o a.ply --force 2>&1 | sed -n 's/.*\\(--tolerance [0-9.]*\\).*/\\1/p' > t; "
         "vdb_molsurf 1crn.pdb --epsilon 0.1 --voxel 0.75 $(cat t) -o d.ply"),
        ("a smaller --voxel", "vdb_molsurf 1crn.pdb --epsilon 0.1 --voxel 0.8 -o e.ply", "vdb_molsurf 1crn.pdb --epsilon 0.1 --voxel 0.4 -o f.ply"),
        ("--flow newton", "vdb_molsurf 1crn.pdb --voxel 1 --flow paper --max-steps 5 -o a.ply",
         "vdb_molsurf 1crn.pdb --voxel 1 --flow newton -o b.ply")],
    "tools/msms/call.cpp": [
        ("-all_components", "vdb_molsurf_msms -if two.xyzr -of a -free_vertices",
         "vdb_molsurf_msms -if two.xyzr -of a -all_components"),
        ("-all_components writes each", "vdb_molsurf_msms -if two.xyzr -of a -one_cavity 1 2",
         "vdb_molsurf_msms -if two.xyzr -of a -all_components"),
        ("-h lists them", "vdb_molsurf_msms -if two.xyzr -qqq", "vdb_molsurf_msms -h | grep -e -density"),
        ("write more of it", "vdb_molsurf_msms -if two.xyzr -of a -no", "vdb_molsurf_msms -if two.xyzr -of a -noh"),
        ("the file of spheres follows -if", "vdb_molsurf_msms two.xyzr -of a", "vdb_molsurf_msms -if two.xyzr -of a"),
        ("-h lists the options", "vdb_molsurf_msms -of a", "vdb_molsurf_msms -h | grep -e '-if filename'")],
    "tools/msms/main.cpp": [
        ("another name after -of or -af", "cp two.xyzr a.area; vdb_molsurf_msms -if a.area -af a",
         "vdb_molsurf_msms -if a.area -af b")],
    "tools/nanoshaper/main.cpp": [
        ("another Root_FileName", "cp two.xyzr exposed.xyz; vdb_molsurf_nanoshaper own.prm",
         "cp two.xyzr exposed.xyz; echo 'Root_FileName = b' >> own.prm; vdb_molsurf_nanoshaper own.prm")],
}

# Hints that no case follows, by a part of their text, and why.
UNTRIED = {
    "kernel/balls/bead_radii.cpp": {"atoms more than once": "no atoms are known that give it"},
    "scale/bricks/merged_bricks.cpp": {"run the bricks again": "it takes bricks of two programs"},
    "show/io/commit.cpp": {"remove ": "cli.hints.preload follows it"},
    "show/io/output_file.cpp": {"it is an address": "cli.stores.s3 follows it", "free some space": "it takes a full disk, as cli.faults.mount has it",
                           "choose a folder": "cli.hints.user follows it"},
    "show/io/ply_layout.cpp": {"a larger `voxel`": "it takes a mesh of 2^31 vertices"},
    "show/io/scene.cpp": {"expected a fog": "the command adds fogs itself; test_commands.py of the module follows it"},
    "show/io/write_glb.cpp": {"write .ply": "it takes a mesh of 4 GiB"},
    "show/io/write_mesh.cpp": {"write .obj": "it takes a mesh of 2^32 triangles"},
    "show/io/write_volume.cpp": {"larger voxels": "it takes a box of 2^31 points"},
    "molecule/selection/point_charges.cpp": {"the program pdb2pqr makes one": "it takes pdb2pqr"},
    "molecule/selection/select_balls.cpp": {"`trajectory` FILE.dcd": "cli.formats follows it"},
    "molecule/structure/detect_format.cpp": {"take .bcif.gz": "it takes the Protein Data Bank", "in PyMOL": "it takes PyMOL",
                                    "gmx editconf": "it takes GROMACS", "cpptraj": "it takes AmberTools",
                                    "MDAnalysis turns": "it takes MDAnalysis", "ASE turns": "it takes ASE", "Open Babel": "it takes Open Babel",
                                    "git lfs": "it takes Git LFS", "download the file": "it takes the network",
                                    "take .cif.gz": "it takes the Protein Data Bank", "structconvert": "it takes RDKit",
                                    "the file of the coordinates": "it takes the Protein Data Bank",
                                    "unzip": "it takes unzip", "tar -xf": "it takes a tar archive", "unzstd": "it takes zstd", "uncompress": "it takes gzip"},
    "molecule/structure/trajectory.cpp": {"gmx trjconv": "it takes GROMACS", "MDAnalysis or": "it takes MDAnalysis"},
    "molecule/structure/read_trr.cpp": {"gmx trjconv": "it takes GROMACS"},
    "molecule/structure/read_netcdf.cpp": {"cpptraj writes": "it takes AmberTools"},
    "molecule/structure/read_ligand.cpp": {"Open Babel": "it takes Open Babel"},
    "molecule/selection/superpose.cpp": {"`select` takes one chain of each": "cli.superpose follows it"},
    "kernel/pipeline/check_balls.cpp": {"`voxel`": "cli.hints.memory follows it"},
    "kernel/pipeline/check_mesh.cpp": {"a smaller `voxel`": "no atoms are known that give it"},
    "analysis/measures/compare.cpp": {"write .ply instead": "the program refuses it before the library does"},
    "surface/options.cpp": {"`kind` ses": "the program never asks for it"},
    "surface/product_table.cpp": {"`surface` sas": "the program refuses it before the library does"},
    "surface/unit_mesh.cpp": {"a .glb file": "it takes a mesh of 2^32 vertices", "a larger `voxel`": "it takes copies of 2^32 vertices"},
    "surface/unit_run.cpp": {"a smaller `voxel`": "no unit is known that gives it",
                             "edges of": "no unit is known that gives it"},
    "tools/build.cpp": {"the page has": "cli.page follows it"},
    "tools/input_files.cpp": {"it is an address; aws": "cli.stores.s3 follows it", "it is an address; curl": "it takes the network", "Protein Data Bank": "it takes the network"},
    "tools/main.cpp": {"a larger --voxel": "what has memory by the estimate seldom ends so"},
    "tools/outputs.cpp": {" accepts that, a smaller --voxel resolves it": "no small molecule is known that gives it"},
    "tools/msms/main.cpp": {"error: not enough": "what has memory by the estimate seldom ends so",
                            " [hint: a smaller -density, or fewer spheres": "cli.hints.memory follows it"},
    "tools/nanoshaper/main.cpp": {"error: not enough": "what has memory by the estimate seldom ends so",
                                  " [hint: a smaller Grid_scale, or fewer spheres": "cli.hints.memory follows it"},
}


class Followed(ToolTest):
    ENVIRONMENT = {**os.environ, "PATH": f"{pathlib.Path(TOOL).resolve().parent}:{os.environ['PATH']}"}

    def fill(self):
        """The folder as each case finds it."""
        shutil.rmtree(self.folder)
        self.folder.mkdir()
        for path in DATA.iterdir():
            (self.folder / path.name).symlink_to(path)
        for name, text in FILES.items():
            (self.folder / name).write_text(text)

    def shell(self, line):
        return subprocess.run(["bash", "-c", line], cwd=self.folder, capture_output=True, text=True, timeout=100,
                              stdin=subprocess.DEVNULL, env=self.ENVIRONMENT)

    def follow(self, source, hint, wrong, *followed):
        """Returns the literals of the source that the wrong call printed."""
        self.fill()
        error = self.shell(wrong).stderr
        told = [part for part in re.findall(r"\[hint: (.*)\]", error) if hint in part]
        said = [text for text in hints_of_sources()[source] if re.search(expression_of(text), error)]
        self.assertTrue(told and said, f"{wrong}\n{error}")
        for line in followed:
            after = self.shell(line)
            self.assertEqual(after.returncode, 0, f"[hint: {told[0]}] {line}\n{after.stderr}")
            self.assertNotIn(told[0], after.stderr, line)
        return said


class Hints(Followed):
    def test_each_helps(self):
        followed = {}
        for source, cases in CASES.items():
            for case in cases:
                with self.subTest(source=source, hint=case[0]):
                    followed.setdefault(source, set()).update(self.follow(source, *case))
        options = set(re.findall("--[a-z][a-z-]*", self.check(0, "--options-page").stdout.decode()))
        for source, texts in hints_of_sources().items():
            for text in texts:
                with self.subTest(source=source, text=text):
                    self.assertFalse(text.endswith("[hint: "), "a hint begins in the literal that says so")
                    reasons = [part for part in UNTRIED.get(source, {}) if part in text]
                    self.assertNotEqual(text in followed.get(source, ()), bool(reasons), "a case, or a reason why not")
                    if not reasons:
                        words = set(re.findall("--[a-z-]+", expression_of(text).replace("\\", "")))
                        self.assertLessEqual(words, options | {"--help"})

    def test_what_opens_all_that_the_field_closes(self):
        """A tube with two necks: what opens its wide part makes it a cavity, and --surface ses a tunnel."""
        (self.folder / "necked.xyzr").write_text(xyzr(tube([3.9] * 3 + [3.3] * 2 + [3.9] * 5 + [3.3] * 2 + [3.9] * 3)))

        def euler(*words):
            done = self.check(0, "necked.xyzr", *words, "-v", "-o", "a.json", "--force")
            return json.loads((self.folder / "a.json").read_text())["surface"]["euler_characteristic"], done.stderr.decode()

        shut, said = euler()
        hint = re.search(r"\[hint: (--epsilon \S+(?: --voxel \S+)?) opens the widest, (--surface ses) all\]", said)
        self.assertTrue(hint, said)
        self.assertEqual(shut, 2)
        self.assertEqual(euler(*hint[1].split())[0], 4)
        self.assertEqual(euler(*hint[2].split())[0], 0)

    @needs("preload")
    def test_record_of_a_killed_run(self):
        call = f"vdb_molsurf one.xyzr {FAST} -q --force -o a.ply -o a.json"
        # A path with a space would be two.
        faulty = 'LD_LIBRARY_PATH="$(dirname "$FAULTY_SYSTEM")" LD_PRELOAD=$(basename "$FAULTY_SYSTEM")'
        self.follow("show/io/commit.cpp", "remove ./.vdb_molsurf.",
                    f"{faulty} FAULTY_KILL=2 {call}; {faulty} FAULTY_EIO=1- {call}",
                    f"rm .vdb_molsurf.*.commit; {faulty} {call}")

    @needs("user")
    def test_folder_of_another_user(self):
        user = "setpriv --reuid 65534 --regid 65534 --clear-groups " if os.geteuid() == 0 else ""
        call = f"chmod 777 .; {user}vdb_molsurf one.xyzr {FAST} -o"
        self.follow("show/io/output_file.cpp", "choose a folder you may write to", f"mkdir -m 555 shut; {call} shut/a.ply",
                    f"{call} a.ply")

    @needs("memory")
    def test_little_memory(self):
        large = "vdb_molsurf large.xyzr --surface vdw --voxel"
        self.follow("scale/bricks/plan_bricks.h", "which makes it in bricks", f"ulimit -v 460000; {large} 0.23 -o a.vdb",
                    f"ulimit -v 460000; {large} 0.4 -o b.vdb",
                    f"ulimit -v 460000; {large} 0.23 --$({large} 0.23 -o a.vdb 2>&1 | grep -o 'memory [0-9.]*G') -o c.vdb")
        self.follow("tools/build.cpp", "a surface of a larger --voxel",
                    "vdb_molsurf 1crn.pdb --surface sas --voxel 0.1 -o a.vdb; ulimit -v 250000; "
                    "vdb_molsurf convert a.vdb -o a.ply",
                    "vdb_molsurf 1crn.pdb --surface sas --voxel 0.3 -o b.vdb; ulimit -v 250000; "
                    "vdb_molsurf convert b.vdb -o a.ply")
        self.follow("tools/msms/main.cpp", "a smaller -density, or fewer spheres",
                    "ulimit -v 800000; vdb_molsurf_msms -if ball.xyzr -of a -density 100",
                    "ulimit -v 800000; vdb_molsurf_msms -if ball.xyzr -of a -density 0.3",
                    "ulimit -v 800000; vdb_molsurf_msms -if two.xyzr -of a -density 100")
        self.follow("tools/nanoshaper/main.cpp", "a smaller Grid_scale, or fewer spheres",
                    "ulimit -v 800000; vdb_molsurf_nanoshaper fine.prm",
                    "ulimit -v 800000; vdb_molsurf_nanoshaper coarse.prm",
                    "ulimit -v 800000; vdb_molsurf_nanoshaper few.prm")
        self.follow("kernel/pipeline/check_balls.cpp", "--voxel 0.5",
                    "ulimit -v 500000; vdb_molsurf ball.xyzr --surface sas --voxel 0.05 -o a.ply",
                    "ulimit -v 500000; vdb_molsurf ball.xyzr --surface sas --voxel 0.5 -o a.ply")


if __name__ == "__main__":
    unittest.main()
