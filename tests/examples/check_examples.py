#!/usr/bin/python3
# SPDX-License-Identifier: MPL-2.0
"""Examples of CONTRIBUTING.md, each a patch that adds something of a kind.

    tests/examples/check_examples.py                whether each patch fits the tree and touches few files
    tests/examples/check_examples.py --build FOLDER applies all to a copy of the tree, builds it and uses each
"""

import json
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(ROOT / "scripts"))

# Most files of code that an addition touches.
MOST = {"format": 2, "colour": 2, "kind": 3, "measure": 4, "grid": 3, "option": 4, "product": 2}


def hunks(patch):
    """For each hunk of a patch: its file, the lines before and the lines after."""
    file, before, after = None, [], []
    for line in patch.read_text().splitlines():
        if line.startswith(("@@", "diff ")):
            if before or after:
                yield file, before, after
            before, after = [], []
        elif line.startswith("+++ b/"):
            file = line[6:]
        elif line[:1] in (" ", "-", "+") and not line.startswith("---"):
            if line[0] != "+":
                before.append(line[1:])
            if line[0] != "-":
                after.append(line[1:])
    yield file, before, after


def faults(name):
    files = set()
    for file, before, _ in hunks(HERE / f"{name}.patch"):
        files.add(file)
        found = ("\n" + (ROOT / file).read_text()).count("\n" + "\n".join(before) + "\n")
        if found != 1:
            yield f"{name}.patch: {file}: expected the lines once, got them {found} times: {before[0]!r}"
    if len(files) > MOST[name]:
        yield f"{name}.patch: expected at most {MOST[name]} files, got {len(files)}"


def apply(folder, name):
    for file, before, after in hunks(HERE / f"{name}.patch"):
        path = folder / file
        text = path.read_text()
        if text.count("\n".join(before)) != 1:
            sys.exit(f"{name}.patch does not fit {file}")
        path.write_text(text.replace("\n".join(before), "\n".join(after)))


def same(what, expected, got):
    if expected != got:
        sys.exit(f"{what}: expected {expected}, got {got}")


def use(tool, folder):
    """Uses what the examples add."""
    def run(file, *options):
        subprocess.run([tool, file, "-q", "--force", *map(str, options)], check=True)

    def report(file, *options):
        run(file, *options, "-o", folder / "x.json")
        return json.loads((folder / "x.json").read_text())["surface"]

    crambin, ball = ROOT / "tests/data/1crn.pdb", folder / "ball.xyzr"
    ball.write_text("0 0 0 3\n")

    run(crambin, "--voxel", 1, "-o", folder / "x.pts", "-o", folder / "x.json")
    rows = [list(map(float, line.split())) for line in (folder / "x.pts").read_text().splitlines()]
    same("rows of .pts", json.loads((folder / "x.json").read_text())["surface"]["vertices"], len(rows))
    same("normals of .pts", True, all(abs(sum(n * n for n in row[3:]) - 1) < 1e-3 for row in rows))

    run(ROOT / "tests/data/selections.pdb", "--select", "nucleic", "--color", "purine", "-o", folder / "x.off")
    colors = {line.split()[3:6][0] for line in (folder / "x.off").read_text().splitlines()[2:] if len(line.split()) == 7}
    same("purines and pyrimidines have two colours", {"0", "230"}, colors)

    before, after = report(crambin), report(crambin, "--surface", "unrelaxed")
    same("kind", "unrelaxed", after["kind"])
    same("areas before and after the flow are near and differ", True, 1e-4 < abs(after["area"] / before["area"] - 1) < 0.05)

    same("sphericity of a ball", True, abs(report(ball, "--surface", "vdw")["sphericity"] - 1) < 1e-6)
    same("sphericity of crambin", True, 0.3 < before["sphericity"] < 0.9)

    run(ball, "--surface", "vdw", "--voxel", 0.25, "--measures", "girth", "-o", folder / "x.json")
    girth = json.loads((folder / "x.json").read_text())["measures"]["girth"]
    same("area of the section of a ball", True, abs(girth / (9 * 3.14159265) - 1) < 5e-3)  # of its triangles

    run(crambin, "--fields", "deviatoric_curvature", "-o", folder / "x.ply", "-o", folder / "x.vdb")
    same("attribute of .ply", True, b"property float deviatoric_curvature" in (folder / "x.ply").read_bytes()[:2000])

    run(crambin, "--vertex-step", 0.01, "-o", folder / "x.off")
    lines = (folder / "x.off").read_text().splitlines()
    vertices = [float(x) for line in lines[2:2 + int(lines[1].split()[0])] for x in line.split()[:3]]
    same("coordinates are rounded", True, max(abs(x / 0.01 - round(x / 0.01)) for x in vertices) < 2e-3)


def build(folder):
    import mutate  # its copy of the tree
    mutate.copy_tree(folder)
    for name in MOST:
        apply(folder, name)
    for command in (["cmake", "--preset", "release", "-DMOLSURF_BUILD_TESTS=OFF"],
                    ["cmake", "--build", "--preset", "release", "--target", "vdb_molsurf"]):
        subprocess.run(command, cwd=folder, check=True)
    use(folder / "build-release/tools/vdb_molsurf", folder)
    print(f"{len(MOST)} examples passed")


def main():
    if sys.argv[1:2] == ["--build"]:
        return build(pathlib.Path(sys.argv[2]).resolve())
    listed = set(re.findall(r"tests/examples/(\w+)\.patch", (ROOT / "CONTRIBUTING.md").read_text()))
    wrong = [fault for name in MOST for fault in faults(name)]
    if listed != set(MOST):
        wrong.append(f"CONTRIBUTING.md: expected the examples {sorted(MOST)}, got {sorted(listed)}")
    print(*wrong, sep="\n", file=sys.stderr)
    print(f"examples: {len(MOST)}, {len(wrong)} faults")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
