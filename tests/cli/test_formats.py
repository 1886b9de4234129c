# SPDX-License-Identifier: MPL-2.0
"""Files of other programs. Files of atoms give what the same atoms give as PDB, or what a closed form says; what is
written is read again after the descriptions of the formats."""

import gzip
import json
import math
import re
import struct
import sys
import types
import unittest

from needs import needs
from test_frames import dcd
from tool import CRAMBIN, DATA, FAST, ToolTest, read_ply

ATOMS = [(line[12:16].strip(), line[17:20].strip(), int(line[22:26]),
          tuple(float(line[i:i + 8]) for i in (30, 38, 46)), line[76:78].strip().title())
         for line in CRAMBIN.read_text().splitlines() if line.startswith("ATOM")]
MASS = {"C": 12.011, "N": 14.007, "O": 15.999, "S": 32.06}
PLAIN = ["--surface", "ses", "--voxel", "0.5"]


def gro(frames, digits=3):
    """A .gro file of crambin's atoms at some places [Å]."""
    text = ""
    for t, positions in enumerate(frames):
        text += f"crambin t= {t}\n{len(ATOMS):5d}\n"
        for i, ((name, residue, number, _, _), x) in enumerate(zip(ATOMS, positions), 1):
            width = digits + 5
            text += f"{number:5d}{residue:<5s}{name:>5s}{i:5d}"
            text += "".join(f"{v / 10:{width}.{digits}f}" for v in x) + "\n"
        text += "   5.00000   5.00000   5.00000\n"
    return text


def psf():
    text = f"PSF\n\n       1 !NTITLE\n REMARKS crambin\n\n{len(ATOMS):8d} !NATOM\n"
    for i, (name, residue, number, _, element) in enumerate(ATOMS, 1):
        text += f"{i:8d} A    {number:<4d} {residue:<4s} {name:<4s} X      0.000000  {MASS[element]:12.4f}  0\n"
    return text + "\n       0 !NBOND\n"


class Formats(ToolTest):
    def write(self, name, content):
        (self.folder / name).write_bytes(content if isinstance(content, bytes) else content.encode())

    def measures(self, *words):
        self.check(0, *words, "-o", "measures.json", "--force")
        surface = json.loads((self.folder / "measures.json").read_text())["surface"]
        return surface["area"], surface["volume"]

    def ply(self, path, *words):
        self.check(0, path, *words, "-o", "a.ply", "--force")
        return (self.folder / "a.ply").read_bytes()

    def test_binary_cif_gives_the_bytes_of_mmcif(self):
        for words in ([], ["--assembly", "1"], ["--select", "A/160-180"], ["--group-by", "chain", "--color", "group"]):
            self.assertEqual(self.ply(DATA / "1a8o.bcif.gz", *FAST, *words),
                             self.ply(DATA / "1a8o.cif.gz", *FAST, *words), words)
        info = self.check(0, "info", DATA / "1a8o.bcif.gz").stdout.decode()
        self.assertRegex(info, r"format +BinaryCIF\n")
        self.assertIn("assembly 1", info)

    def test_gro_has_the_area_of_pdb(self):
        self.write("a.gro", gro([[x for *_, x, _ in ATOMS]]))
        area, volume = self.measures(CRAMBIN, *PLAIN)
        rounded = self.measures("a.gro", *PLAIN)  # up to 0.005 Å a coordinate
        self.assertAlmostEqual(rounded[0] / area, 1.0, delta=5e-4)
        self.assertAlmostEqual(rounded[1] / volume, 1.0, delta=2e-4)
        self.write("fine.gro", gro([[x for *_, x, _ in ATOMS]], digits=5))
        self.assertAlmostEqual(self.measures("fine.gro", *PLAIN)[0], area, delta=1e-5 * area)

    def test_frames_of_gro_and_of_trajectories_beside_gro_and_psf(self):
        frames = [[(x + n, y * (1.0 + 0.01 * n), z) for *_, (x, y, z), _ in ATOMS] for n in range(3)]
        self.write("a.gro", gro(frames, digits=6))
        self.write("a.psf", psf())
        self.write("a.dcd", dcd(frames))
        run = [*FAST, "--surface", "sas", "--frames", "all"]
        self.check(0, CRAMBIN, *run, "--trajectory", "a.dcd", "-o", "pdb.csv")
        areas = [float(row["area"]) for row in self.table("pdb.csv")]
        self.assertEqual(len(areas), 3)
        self.assertNotAlmostEqual(areas[0], areas[2], delta=1.0)
        for name, words in (("a.gro", []), ("a.gro", ["--trajectory", "a.dcd"]), ("a.psf", ["--trajectory", "a.dcd"])):
            self.check(0, name, *run, *words, "-o", "other.csv", "--force")
            for row, area in zip(self.table("other.csv"), areas, strict=True):
                self.assertAlmostEqual(float(row["area"]) / area, 1.0, delta=1e-5)
        self.check(1, "a.psf", "-o", "b.ply", says=["a.psf: has no coordinates", "--trajectory"])

    def test_ligands_have_the_surface_of_their_pdb(self):
        with gzip.open(DATA / "4at1.ent.gz", "rt") as file:
            lines = [line for line in file if line[17:20] == "ATP" and line[21] == "B"]
        self.assertGreater(len(lines), 20)
        self.write("a.pdb", "".join(lines))
        rows = [(line[12:16].strip(), [float(line[i:i + 8]) for i in (30, 38, 46)]) for line in lines]
        count = len(rows)
        v2000 = f"ATP\n  test\n\n{count:3d}  0  0  0  0  0            999 V2000\n"
        v2000 += "".join(f"{x:10.4f}{y:10.4f}{z:10.4f} {name[0]:<3s} 0  0\n" for name, (x, y, z) in rows) + "M  END\n"
        v3000 = "ATP\n  test\n\n  0  0  0     0  0            999 V3000\nM  V30 BEGIN CTAB\nM  V30 BEGIN ATOM\n"
        v3000 += "".join(f"M  V30 {i} {name[0]} {x} {y} {z} 0\n" for i, (name, (x, y, z)) in enumerate(rows, 1))
        v3000 += "M  V30 END ATOM\nM  V30 END CTAB\nM  END\n$$$$\n"
        mol2 = f"@<TRIPOS>MOLECULE\nATP\n {count} 0\nSMALL\nNO_CHARGES\n@<TRIPOS>ATOM\n"
        mol2 += "".join(f"{i} {name} {x} {y} {z} {name[0]}.3 1 ATP1 0.1\n" for i, (name, (x, y, z)) in enumerate(rows, 1))
        for name, text in (("a.sdf", v2000), ("b.mol", v3000), ("c.mol2", mol2)):
            self.write(name, text)
            self.assertEqual(self.ply(name, *PLAIN), self.ply("a.pdb", *PLAIN), name)
        self.check(0, "c.mol2", *FAST, "--color", "charge", "-o", "charged.ply")

    def spheres(self, rows, more=""):
        return ("data_x\n" + more + "loop_\n" + "".join(f"_ihm_sphere_obj_site.{c}\n" for c in (
            "id", "entity_id", "seq_id_begin", "seq_id_end", "asym_id", "Cartn_x", "Cartn_y", "Cartn_z",
            "object_radius", "rmsf", "model_id")) + "".join(row + "\n" for row in rows))

    def test_spheres_of_integrative_models(self):
        a, b, apart = 6.0, 5.0, 7.0  # two spheres that overlap, and one for itself in another model
        self.write("a.cif", self.spheres([f"1 1 1 1 A 1 2 3 {a} . 1", f"2 1 2 11 A 1 {2 + apart} 3 {b} . 1",
                                          "3 1 1 9 A 0 0 0 4.5 . 2"]))
        lens = math.pi * (a + b - apart) ** 2 * (apart ** 2 + 2 * apart * (a + b) - 3 * (a - b) ** 2) / (12 * apart)
        volume = 4 / 3 * math.pi * (a ** 3 + b ** 3) - lens
        exact = self.measures("a.cif", "--surface", "vdw", "--voxel", "0.25")[1]
        self.assertAlmostEqual(exact / volume, 1.0, delta=1e-4)
        single = self.measures("a.cif", "--surface", "vdw", "--voxel", "0.25", "--model", "2")[1]
        self.assertAlmostEqual(single / (4 / 3 * math.pi * 4.5 ** 3), 1.0, delta=1e-4)
        self.check(0, "a.cif", "--surface", "vdw", *FAST, "-o", "a.atoms.csv")
        self.assertEqual([(row["atom"], row["chain"]) for row in self.table("a.atoms.csv")], [("1", "A"), ("2-11", "A")])
        # Atoms beside spheres have the radii of their elements: carbon 1.7 Å.
        columns = ("group_PDB", "id", "type_symbol", "label_atom_id", "label_comp_id", "label_asym_id", "label_seq_id",
                   "Cartn_x", "Cartn_y", "Cartn_z", "pdbx_PDB_model_num")
        atoms = "loop_\n" + "".join(f"_atom_site.{c}\n" for c in columns) + "ATOM 1 C CA GLY B 1 100 0 0 1\n"
        self.write("b.cif", self.spheres(["1 1 1 1 A 1 2 3 6 . 1"], atoms))
        both = self.measures("b.cif", "--surface", "vdw", "--voxel", "0.25")[1]
        self.assertAlmostEqual(both / (4 / 3 * math.pi * (6 ** 3 + 1.7 ** 3)), 1.0, delta=1e-4)

    def test_spheres_that_are_none(self):
        self.write("a.cif", self.spheres(["1 1 1 1 A 1 2 3 6 . 1", "2 1 2 2 A 1 2 3 ? . 1"]))
        self.check(1, "a.cif", "-o", "a.ply", says=["a.cif: _ihm_sphere_obj_site, row 2: object_radius", '"?"'])
        self.write("b.cif", "data_x\nloop_\n_ihm_sphere_obj_site.Cartn_x\n1\n")
        self.check(1, "b.cif", "-o", "b.ply", says="has no column Cartn_y")

    def test_what_is_refused_says_what_to_do_instead(self):
        zeros = bytes(100)
        for name, content, says in (
                ("a.mmtf", b"\x8f\xabmmtfVersion\xa51.0.0" + zeros, ["MMTF", ".bcif.gz"]),
                ("a.pse", b"\x80\x02}q\x00" + zeros, ["session of PyMOL", "save FILE.cif"]),
                ("a.tpr", b"\x00\x00\x00\x15VERSION 2022" + zeros, ["run input of GROMACS", "editconf"]),
                ("a.prmtop", b"%VERSION  VERSION_STAMP = V0001.000\n", ["expected 12 fields of POINTERS, got 0"]),
                ("a.psf", b"data_cns_mtf\n\n_cns_mtf.title\n; none\n;\n", ["topology of CNS"]),
                ("a.bcif", (b"\x83\xa7encoder" + zeros), ["a.bcif: is damaged BinaryCIF"])):
            self.write(name, content)
            self.check(1, name, "-o", "a.ply", says=[name, *says])
        self.assertEqual(self.names(), ["a.bcif", "a.mmtf", "a.prmtop", "a.pse", "a.psf", "a.tpr"])

    def volume(self, name):
        """(origin, step, values[x][y][z]) of a map or a grid of APBS, read after the descriptions of the formats."""
        data = (self.folder / name).read_bytes()
        if name.endswith(".mrc"):
            words, floats = struct.unpack("<256i", data[:1024]), struct.unpack("<256f", data[:1024])
            nx, ny, nz = words[:3]
            self.assertEqual((words[3], words[7:10], words[16:19], words[27]), (2, (nx, ny, nz), (1, 2, 3), 20140))
            self.assertEqual(data[208:216], b"MAP DD\0\0")
            self.assertEqual(len(data), 1024 + 4 * nx * ny * nz)
            steps = [floats[10 + a] / words[7 + a] for a in range(3)]
            values = struct.unpack(f"<{nx * ny * nz}f", data[1024:])
            for start, origin, step in zip(words[4:7], floats[49:52], steps):  # for programs that read no ORIGIN
                self.assertLessEqual(abs(start - origin / step), 0.501)
            self.assertAlmostEqual(floats[19], min(values), places=5)
            self.assertAlmostEqual(floats[20], max(values), places=5)
            self.assertAlmostEqual(floats[21], sum(values) / len(values), places=4)
            grid = {(x, y, z): values[(z * ny + y) * nx + x] for z in range(nz) for y in range(ny) for x in range(nx)}
            return floats[49:52], steps, (nx, ny, nz), grid
        lines = [line for line in data.decode().splitlines() if not line.startswith("#")]
        counts = tuple(map(int, lines[0].split()[-3:]))
        origin = tuple(map(float, lines[1].split()[1:]))
        steps = [float(lines[2 + a].split()[1 + a]) for a in range(3)]
        count = int(re.match(r"object 3 class array type double rank 0 items (\d+) data follows", lines[6])[1])
        values = [float(v) for line in lines[7:7 + -(-count // 3)] for v in line.split()]
        self.assertEqual(len(values), count)
        nx, ny, nz = counts
        return origin, steps, counts, {(x, y, z): values[(x * ny + y) * nz + z]
                                       for x in range(nx) for y in range(ny) for z in range(nz)}

    def test_volumes_hold_the_distance(self):
        """A ball in general position: r - R near the surface, and the same values in both files."""
        self.write("ball.xyzr", "1.3 -2.1 0.7 3.0\n")
        volumes = ["-o", "a.mrc", "-o", "a.dx", "--force"]
        for more, center, stored in (([], (1.3, -2.1, 0.7), False), (["--center"], (0.0, 0.0, 0.0), False),
                                     (["--for", "blender=0.1"], (1.3, -2.1, 0.7), True)):
            build = ["ball.xyzr", "--surface", "vdw", "--voxel", "0.5", *more]
            if stored:
                self.check(0, *build, "-o", "a.vdb")
                self.check(0, "convert", "a.vdb", *volumes)
            else:
                self.check(0, *build, *volumes)
            for name in ("a.mrc", "a.dx"):
                origin, steps, counts, grid = self.volume(name)
                self.assertEqual(min(counts), max(counts))
                near = 0
                for place, value in grid.items():
                    x = [o + s * n for o, s, n in zip(origin, steps, place)]
                    distance = math.dist(x, center) - 3.0
                    if abs(distance) < 1.0:
                        near += 1
                        self.assertAlmostEqual(value, distance, delta=0.02)
                    else:
                        self.assertGreater(value * distance, 0.0)
                self.assertGreater(near, 1000)
        self.check(2, "ball.xyzr", *FAST, "--by-symmetry", "--assembly", "1", "-o", "b.mrc", says="b.mrc")

    def test_templates_for_tomograms(self):
        """A density and a mask have the same pixels, about the centre that programs turn maps about."""
        self.write("ball.xyz", "2\ntwo atoms\nC 1.3 -2.1 0.7\nO 2.5 -2.1 0.7\n")
        build = ["ball.xyz", "--voxel", "0.25", "--surface", "vdw", "--pixel-size", "0.7"]
        self.check(0, *build, "--box-size", "32", "-o", "a.density.mrc", "-o", "a.mask.mrc")
        origin, steps, counts, density = self.volume("a.density.mrc")
        self.assertEqual(list(counts), [32, 32, 32])
        for step in steps:
            self.assertAlmostEqual(step, 0.7, delta=1e-6)
        self.assertEqual(self.volume("a.mask.mrc")[:3], (origin, steps, counts))
        middle = [(6 * 1.3 + 8 * 2.5) / 14, -2.1, 0.7]
        for place, x in zip(origin, middle):
            self.assertAlmostEqual(place + 16 * 0.7, x, delta=1e-5)
        self.assertAlmostEqual(sum(density.values()) * 0.7 ** 3, 14.0, delta=0.05)
        mask = self.volume("a.mask.mrc")[3]
        for place, value in mask.items():
            x = [o + 0.7 * n for o, n in zip(origin, place)]
            away = min(math.dist(x, (1.3, -2.1, 0.7)) - 1.7, math.dist(x, (2.5, -2.1, 0.7)) - 1.52) / 0.7
            wanted = 1 if away < 0 else 0 if away > 3 else 0.5 + 0.5 * math.cos(math.pi * away / 3)
            if away > 0:  # Inside of the balls it is no distance from their surface.
                self.assertAlmostEqual(value, wanted, delta=0.15)
            else:
                self.assertGreater(value, 0.95)
        self.check(0, *build, "--box-size", "32", "--center", "--invert-density", "-o", "b.density.mrc")
        moved = self.volume("b.density.mrc")
        self.assertLess(min(moved[3].values()), -1e-3)
        self.assertLess(max(moved[3].values()), 1e-9)
        self.assertLess(max(abs(x) for x in (moved[0][1] + 16 * 0.7, moved[0][2] + 16 * 0.7)), 0.01)
        with open(self.folder / "a.density.mrc", "rb") as file:
            self.assertEqual(struct.unpack("<3i", file.read(28)[16:]), tuple(round(x / 0.7) for x in origin))
        self.check(2, "ball.xyz", *FAST, "-o", "c.density.mrc", says=["expected --pixel-size too"])
        self.check(2, *build, "--box-size", "31", "-o", "c.mask.mrc", says=["--box-size: expected an even number from 2 to 1290, got '31'"])
        self.check(1, *build, "--box-size", "8", "-o", "c.mask.mrc", says=["--box-size: expected at least 10 pixels", "got 8", "hint: 16"])
        self.check(2, *build, "--split", "group", "-o", "c.mask.mrc", says=["c.mask.mrc", "--split"])
        self.check(0, "ball.xyz", *FAST, "--pixel-size", "2", "-o", "c.mrc", says=["--pixel-size is for .density.mrc and .mask.mrc"])
        self.check(2, "ball.xyz", *FAST, "--for", "relion", "-o", "c.mrc", says=["NAME.density.mrc and NAME.mask.mrc with --pixel-size"])

    def test_maps_become_volumes(self):
        """The level set of a map of the distance is the surface that the map is of; the fog is where the map is."""
        self.check(0, CRAMBIN, "--surface", "ses", "-o", "a.mrc", "-o", "a.dx", "-o", "a.ply")
        (self.folder / "a.map.gz").write_bytes(gzip.compress((self.folder / "a.mrc").read_bytes()))
        for name in ("a.mrc", "a.dx", "a.map.gz"):
            self.check(0, "convert", name, "--iso", "-1e-4", "-o", "b.vdb", "-o", "b.nvdb", "--force", says=["points, from -1.5 to 1.5"])
            self.check(0, "compare", "b.vdb", "a.ply", "-o", "c.json", "--force")
            self.assertLess(json.loads((self.folder / "c.json").read_text())["hausdorff"], 0.1)
            self.assertEqual((self.folder / "b.nvdb").read_bytes()[:8], b"NanoVDB0")
            self.check(0, "convert", name, "-o", "fog.vdb", "--force")
            said = self.check(0, "info", "fog.vdb").stdout.decode()
            for word in ("grid density", "fog volume", f"map.least       -1.5"):
                self.assertIn(word, said)
        self.assertIn("MiB", self.check(0, "convert", "a.mrc", "--dry-run", "-o", "d.vdb").stderr.decode())
        self.check(1, "convert", "a.mrc", "--iso", "0.1", "-o", "d.vdb", "--max-hours", "1e-6", says=["hours"])
        self.check(2, "convert", "a.mrc", "--iso", "7", "-o", "d.vdb", says=["--iso: expected a value between those of the map, -1.5 and 1.5"])
        self.check(2, "convert", "a.mrc", "-o", "d.ply", says=["d.ply: a map becomes .vdb or .nvdb", "--iso"])
        self.check(2, "convert", "b.vdb", "--color", "chain", "--iso", "1", "-o", "d.vdb", says=["--iso: expected a map"])
        (self.folder / "cut.mrc").write_bytes((self.folder / "a.mrc").read_bytes()[:-1])
        self.check(1, "convert", "cut.mrc", "-o", "d.vdb", says=["cut.mrc: is cut short"])
        self.check(1, "convert", CRAMBIN, "-o", "d.vdb", "--color", "chain", says=["is neither a .vdb file nor a map"])
        self.assertNotIn("d.vdb", self.names())

    def test_nvdb_of_a_surface_and_of_a_stored_one(self):
        self.check(0, CRAMBIN, *FAST, "--fields", "mean_curvature,Cd", "--color", "chain", "-o", "a.nvdb", "-o", "a.vdb")
        self.check(0, "convert", "a.vdb", "-o", "b.nvdb")
        self.assertEqual((self.folder / "a.nvdb").read_bytes(), (self.folder / "b.nvdb").read_bytes())
        self.check(0, CRAMBIN, *FAST, "--for", "blender=nm", "-o", "c.nvdb")
        data = (self.folder / "c.nvdb").read_bytes()
        for name in (b"surface", b"density", b"Cd"):
            self.assertIn(name + b"\0", data)

    @needs("maps")
    def test_other_readers_find_the_surface_where_it_is(self):
        """mrcfile and GridDataFormats: the contour at 0 has the area of the surface, and its box."""
        import gridData
        import mrcfile
        import numpy
        from skimage.measure import marching_cubes, mesh_surface_area
        self.check(0, CRAMBIN, "--surface", "ses", "--voxel", "0.3", "-o", "a.mrc", "-o", "a.dx", "-o", "a.ply", "-o", "a.json")
        area = json.loads((self.folder / "a.json").read_text())["surface"]["area"]
        _, vertices, _ = read_ply((self.folder / "a.ply").read_bytes())
        places = numpy.array(vertices)[:, :3]
        self.assertTrue(mrcfile.validate(self.folder / "a.mrc"))
        with mrcfile.open(self.folder / "a.mrc") as file:
            size, origin = file.voxel_size, file.header.origin
            grids = {"mrcfile": (file.data.transpose(2, 1, 0), [float(size[a]) for a in "xyz"], [float(origin[a]) for a in "xyz"])}
        grid = gridData.Grid(str(self.folder / "a.dx"))  # of a .mrc it adds NSTART to ORIGIN
        grids["gridData"] = grid.grid, grid.delta, grid.origin
        for name, (values, step, first) in grids.items():
            corners, faces, _, _ = marching_cubes(numpy.ascontiguousarray(values), 0.0, spacing=tuple(step))
            self.assertAlmostEqual(mesh_surface_area(corners, faces) / area, 1.0, delta=0.01, msg=name)
            for low, high in ((corners.min(0), places.min(0)), (corners.max(0), places.max(0))):
                self.assertLess(numpy.abs(low + first - high).max(), 0.05, name)

    def test_msms_files(self):
        self.check(0, CRAMBIN, *PLAIN, "-o", "a.vert", "-o", "a.face", "-o", "a.ply")
        names, vertices, triangles = read_ply((self.folder / "a.ply").read_bytes())
        vert = (self.folder / "a.vert").read_text().splitlines()
        face = (self.folder / "a.face").read_text().splitlines()
        self.assertEqual((int(vert[2].split()[0]), int(face[2].split()[0])), (len(vertices), len(triangles)))
        atom = names.index("atom_id")
        for line, vertex in zip(vert[3:], vertices, strict=True):
            words = line.split()
            self.assertEqual(len(words), 9)
            for a in range(6):
                self.assertAlmostEqual(float(words[a]), vertex[a], delta=0.00051)
            self.assertEqual(words[6:], ["0", str(vertex[atom] + 1), "0"])
        self.assertEqual([tuple(int(w) - 1 for w in line.split()[:3]) for line in face[3:]], triangles)

    def test_scripts_list_colours_that_are_seen(self):
        """The key has what the legend has, as far as there is room; cavities that are left out are in neither."""
        seen = []
        for call in (["1ubq.pdb", "--voxel", 1, "--pocket-cut", 0.5], ["1crn.pdb", "--voxel", 0.7],
                     ["1crn.pdb", "--voxel", 0.7, "--pieces", "outer"]):
            self.check(0, DATA / call[0], *call[1:], "--surface", "ses", "--pockets", "--color", "pocket", "-o", "a.glb", "-o", "a.cxc",
                       "-o", "a.legend.svg", "--force")
            key, = (line for line in (self.folder / "a.cxc").read_text().splitlines() if line.startswith("key "))
            names = re.findall('"#[0-9a-f]{6}:([^"]*)"', key)
            drawn = re.findall(">([^<>]*)</text>", (self.folder / "a.legend.svg").read_text())[1:]
            self.assertEqual(names, drawn if len(drawn) <= 24 else [*drawn[:23], f"+{len(drawn) - 23}"])
            seen.append(len(drawn))
        self.assertGreater(seen[0], 24)
        self.assertLess(seen[2], seen[1])

    def test_scripts_open_the_mesh_of_the_run(self):
        self.check(0, CRAMBIN, *FAST, "--color", "element", "-o", "a.glb", "-o", "b.ply", "-o", "c.cxc", "-o", "d.pml")
        chimerax = (self.folder / "c.cxc").read_text().splitlines()
        self.assertIn('open "a.glb" id 900', chimerax)
        key, = (line for line in chimerax if line.startswith("key "))
        self.assertRegex(key, r'^key( "#[0-9a-f]{6}:[A-Z][a-z]?")+ pos ')
        self.assertIn(':S"', key)
        pymol = (self.folder / "d.pml").read_text()
        self.assertIn('mesh = "b.ply"', pymol)
        body = pymol.split("\npython\n")[1].split("python end")[0]
        shapes, printed = [], []
        fake = types.SimpleNamespace(COLOR=6.0, NORMAL=5.0, VERTEX=4.0, BEGIN=2.0, END=3.0, TRIANGLES=4.0)
        module = types.ModuleType("pymol")
        module.cgo, module.__script__ = fake, str(self.folder / "d.pml")
        module.cmd = types.SimpleNamespace(load_cgo=lambda shape, name: shapes.append((shape, name)))
        sys.modules["pymol"] = module
        self.addCleanup(sys.modules.pop, "pymol")
        exec(compile(body, "d.pml", "exec"), {"print": lambda *words: printed.append(words)})
        (shape, name), = shapes
        self.assertEqual(name, "b")
        _, vertices, triangles = read_ply((self.folder / "b.ply").read_bytes())
        self.assertEqual(len(shape), 3 + 36 * len(triangles))
        first = vertices[triangles[0][0]]
        self.assertEqual([round(v, 4) for v in shape[10:14]], [4.0, *(round(v, 4) for v in first[:3])])
        self.assertEqual(printed[0], ("Element",))
        self.check(2, CRAMBIN, *FAST, "-o", "x.ply", "-o", "e.cxc", says=["e.cxc", "-o FILE.glb too"])
        self.check(2, CRAMBIN, *FAST, "-o", "x.glb", "-o", "e.pml", says=["e.pml", "-o FILE.ply too"])
        self.check(0, CRAMBIN, *FAST, "--color", "mean-curvature", "-o", "v.ply", "-o", "v.pml")
        self.assertRegex((self.folder / "v.pml").read_text(), r"scale = \[-?[0-9.e-]+, ")


if __name__ == "__main__":
    unittest.main()
