# SPDX-License-Identifier: MPL-2.0
"""vdb_molsurf_nanoshaper reads the configurations of programs that call NanoShaper, and their parsers read its files.

The configurations and parsers are written after the documentation and behaviour of these programs."""

import math
import os
import pathlib
import re
import subprocess
import unittest

from tool import CRAMBIN, ROOT, TOOL, ToolTest, read_ply

NANOSHAPER = pathlib.Path(TOOL).with_name("vdb_molsurf_nanoshaper")
RADII = {"C": 1.7, "N": 1.55, "O": 1.52, "S": 1.8}
SPHERES = "".join(f"{line[30:38]} {line[38:46]} {line[46:54]} {RADII[line[13]]}\n"
                  for line in CRAMBIN.read_text().splitlines() if line.startswith("ATOM"))


def vmd_rows(text, numbers):
    """Rows as VMD scans them: after three lines, so many numbers at a time, whatever the lines."""
    words = text.split("\n", 3)[3].split()
    assert len(words) % numbers == 0
    return [words[i:i + numbers] for i in range(0, len(words), numbers)]


def tabi_rows(text):
    """Rows as TABI-PB reads them: the third line begins with their number."""
    lines = text.splitlines()
    count = int(lines[2].split()[0])
    rows = [line.split() for line in lines[3:]]
    assert len(rows) == count
    return rows


class NanoShaper(ToolTest):
    def write(self, name, text):
        (self.folder / name).write_text(text)

    def run_nano(self, *words, status=0, says=()):
        done = subprocess.run([NANOSHAPER, *words], cwd=self.folder, capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, status, done.stderr)
        for word in [says] if isinstance(says, str) else says:
            self.assertIn(word, done.stderr)
        return done

    def nano(self, config, *words, name="conf.prm", **options):
        self.write(name, config)
        return self.run_nano(*(words or [name]), **options)

    def reference(self, scale):
        """The mesh of the program itself."""
        self.write("s.xyzr", SPHERES)
        self.check(0, "s.xyzr", "--surface", "ses", "--probe", "1.4", "--voxel", 1 / scale, "-o", "r.ply", "--force")
        return read_ply((self.folder / "r.ply").read_bytes())

    def closed(self, triangles):
        edges = set()
        for a, b, c in triangles:
            for edge in ((a, b), (b, c), (c, a)):
                self.assertNotIn(edge, edges)
                edges.add(edge)
        self.assertTrue(all((b, a) in edges for a, b in edges))

    def test_vmd(self):
        """1.9.4: everything begins with Root_FileName; one word too many in a row stops it."""
        self.write("m.xyzr", SPHERES)
        root = self.folder / "vmdns.u0.1."
        self.nano(f"Operative_Mode = normal\nSurface = ses\nGrid_scale = 2.0\nXYZR_FileName = m.xyzr\n"
                  f"Probe_Radius = 1.4\nRoot_FileName = {root}\nSave_Mesh_MSMS_Format = true\n"
                  "Compute_Vertex_Normals = true\nVertex_Atom_Info = true\nGrid_perfill = 90.0\n")
        vertices = vmd_rows(pathlib.Path(f"{root}triangulatedSurf.vert").read_text(), 9)
        faces = vmd_rows(pathlib.Path(f"{root}triangulatedSurf.face").read_text(), 5)
        names, expected, triangles = self.reference(2.0)
        atom = names.index("atom_id")
        for row, vertex in zip(vertices, expected, strict=True):
            for a in range(6):
                self.assertAlmostEqual(float(row[a]), vertex[a], delta=0.00051)
            self.assertEqual(int(row[7]), vertex[atom] + 1)
        self.assertEqual([tuple(int(w) - 1 for w in row[:3]) for row in faces], triangles)
        self.closed(triangles)
        self.assertFalse((self.folder / "triangulatedSurf.vert").exists())

    def test_tabi_pb(self):
        """Called without a word: ./surfaceConfiguration.prm; the helper files are removed by name afterwards."""
        self.write("molecule.xyzr", SPHERES)
        self.write("surfaceConfiguration.prm",
                   "Grid_scale = 1.0\nGrid_perfil = 90.0\nXYZR_FileName = molecule.xyzr\nBuild_epsilon_maps = false\n"
                   "Build_status_map = false\nSave_Mesh_MSMS_Format = true\nCompute_Vertex_Normals = true\n"
                   "Surface = ses\nSmooth_Mesh = true\nSkin_Surface_Parameter = 0.45\nProbe_Radius = 1.4\n"
                   "Cavity_Detection_Filling = false\nAccurate_Triangulation = true\nTriangulation = true\n"
                   "Check_duplicated_vertices = true\nSave_Status_map = false\nSave_PovRay = false\n")
        self.run_nano()
        rows = tabi_rows((self.folder / "triangulatedSurf.vert").read_text())
        faces = tabi_rows((self.folder / "triangulatedSurf.face").read_text())
        self.assertTrue(all(len(row) >= 6 for row in rows))
        for row in rows:
            self.assertAlmostEqual(math.hypot(*map(float, row[3:6])), 1.0, delta=0.002)
        self.closed([tuple(int(w) - 1 for w in row[:3]) for row in faces])
        for name in ("stderror.txt", "triangleAreas.txt", "exposed.xyz", "exposedIndices.txt"):
            os.remove(self.folder / name)

    def test_bempp_callers(self):
        """PBJ cuts three lines off and takes three columns; Grid_scale has a leading zero."""
        self.write("m.xyzr", SPHERES)
        self.nano("Grid_scale = 01.5\nXYZR_FileName = ./m.xyzr\nSurface = ses\nProbe_Radius = 1.40\n"
                  "Save_Mesh_MSMS_Format = true\n", name="surfaceConfiguration.prm")
        for ending, kind in ((".vert", float), (".face", int)):
            lines = (self.folder / ("triangulatedSurf" + ending)).read_text().splitlines()[3:]
            self.assertGreater(len([tuple(map(kind, line.split()[:3])) for line in lines]), 1000)

    def test_off_callers(self):
        """lines[3] has the counts; vertices and faces follow, with what Vertex_Atom_Info and normals add."""
        self.write("m.xyzr", SPHERES)
        names, expected, triangles = self.reference(1.0)
        atom = names.index("atom_id")
        plain = "XYZR_FileName = m.xyzr\nGrid_scale = 1.0\nSurface = ses\n"
        for more, word, width in (("", "OFF", 3), ("Vertex_Atom_Info = true\n", "OFF+A", 4),
                                  ("Compute_Vertex_Normals = true\n", "OFF+N", 6),
                                  ("Compute_Vertex_Normals = true\nVertex_Atom_Info = true\n", "OFF+N+A", 7)):
            self.nano(plain + more)
            lines = (self.folder / "triangulatedSurf.off").read_text().splitlines()
            self.assertEqual(lines[0], word)
            self.assertTrue(lines[1].startswith("#") and lines[2].startswith("#"))
            self.assertEqual(list(map(int, lines[3].split())), [len(expected), len(triangles), 0])
            rows = [line.split() for line in lines[4:4 + len(expected)]]
            for row, vertex in zip(rows, expected):
                self.assertEqual(len(row), width)
                self.assertAlmostEqual(float(row[2]), vertex[2], delta=0.00051)
                if word.endswith("A"):
                    self.assertEqual(int(row[-1]), vertex[atom])
            faces = [tuple(map(int, line.split()))[1:] for line in lines[4 + len(expected):]]
            self.assertEqual(faces, triangles)

    def test_exposed_atoms_areas_and_totals(self):
        self.write("m.xyzr", "0 0 0 2.0\n0.1 0 0 1.0\n9 0 0 1.5\n")
        out = self.nano("XYZR_FileName = m.xyzr\nGrid_scale = 4.0\n").stdout
        self.assertEqual((self.folder / "exposedIndices.txt").read_text().split(), ["0", "2"])
        exposed = (self.folder / "exposed.xyz").read_text().splitlines()
        self.assertEqual((exposed[0], len(exposed), exposed[2].split()[:2]), ("2", 4, ["C", "0.000000"]))
        volume = 4 / 3 * math.pi * (8 + 1.5 ** 3)
        area = 4 * math.pi * (4 + 1.5 ** 2)
        self.assertAlmostEqual(float(re.search(r"Volume (\S+)", out)[1]) / volume, 1.0, delta=1e-3)
        self.assertAlmostEqual(float(re.search(r"Area (\S+)", out)[1]) / area, 1.0, delta=1e-3)
        flat = sum(map(float, (self.folder / "triangleAreas.txt").read_text().split()))
        self.assertAlmostEqual(flat / area, 1.0, delta=0.01)

    def test_small_cavities_are_left_out(self):
        shell = [(math.cos(t) * math.sin(p), math.sin(t) * math.sin(p), math.cos(p))
                 for p in (i * math.pi / 12 for i in range(13)) for t in (k * math.pi / 12 for k in range(24))]
        self.write("m.xyzr", "".join(f"{5 * x:.3f} {5 * y:.3f} {5 * z:.3f} 1.5\n" for x, y, z in shell))
        cavity = 4 / 3 * math.pi * 3.4 ** 3  # about

        def components(more):
            self.nano("XYZR_FileName = m.xyzr\nGrid_scale = 2.0\nSave_Mesh_PLY_Format = true\n" + more)
            _, vertices, triangles = read_ply((self.folder / "triangulatedSurf.ply").read_bytes())
            self.closed(triangles)
            return len(vertices) - len(triangles) // 2  # Euler's number: 2 for each sphere

        self.assertEqual(components(""), 4)
        filling = "Cavity_Detection_Filling = true\nConditional_Volume_Filling_Value = "
        self.assertEqual(components(filling + "11.4\n"), 4)
        self.assertEqual(components(filling + f"{2 * cavity:.1f}\n"), 2)

    def test_blobby(self):
        self.write("m.xyzr", SPHERES)
        self.nano("XYZR_FileName = m.xyzr\nSurface = blobby\nBlobbyness = -2.5\nGrid_scale = 2.0\n"
                  "Save_Mesh_PLY_Format = true\nOutput_Folder = .\n")
        self.check(0, "m.xyzr", "--surface", "gaussian", "--blobbiness", "2.5", "--voxel", "0.5", "-o", "r.ply")
        self.assertEqual(read_ply((self.folder / "triangulatedSurf.ply").read_bytes())[2],
                         read_ply((self.folder / "r.ply").read_bytes())[2])

    def test_refusals_leave_no_file(self):
        self.write("m.xyzr", SPHERES)
        plain = "XYZR_FileName = m.xyzr\n"
        for more, says in (("Surface = skin\n", ["line 2", "Surface", "skin"]),
                           ("Operative_Mode = pockets\n", ["Operative_Mode", "pockets"]),
                           ("Build_epsilon_maps = true\n", "Build_epsilon_maps"),
                           ("Grid_scale = fine\n", ["Grid_scale: expected a number from 0.1 to 20", '"fine"']),
                           ("Triangulation = maybe\n", "true or false"),
                           ("Surface\n", "line 2: expected Key = value")):
            before = self.names()
            self.nano(plain + more, status=1, says=["conf.prm", *([says] if isinstance(says, str) else says)])
            self.assertEqual(self.names(), sorted({*before, "conf.prm"}))
        self.nano("XYZR_FileName = none.xyzr\n", status=1, says=["none.xyzr", "No such file"])
        self.run_nano("none.prm", status=1, says="none.prm")
        self.run_nano("a", "b", status=2, says="expected one configuration file")
        self.assertEqual(self.names(), ["conf.prm", "m.xyzr"])

    def test_unknown_keys_pass(self):
        self.write("m.xyzr", SPHERES)
        done = self.nano("# comment\nXYZR_FileName = m.xyzr # here\nGrid_scale = 1.0\nBrightness = 3\n",
                         says='conf.prm: line 4: "Brightness" is no key')
        self.assertEqual(done.stderr.count("warning"), 1)
        self.assertIn("Brightness", (self.folder / "stderror.txt").read_text())

    def test_help(self):
        done = self.run_nano("--help")
        self.assertIn("Probe_Radius", done.stdout)
        self.assertEqual(self.run_nano("--man").stdout, (ROOT / "docs/man/vdb_molsurf_nanoshaper.1").read_text())
        self.assertRegex(self.run_nano("--version").stdout, r"^vdb_molsurf_nanoshaper \d")


if __name__ == "__main__":
    unittest.main()
