# SPDX-License-Identifier: MPL-2.0
"""Areas by atom and by residue, contacts, interfaces: as tables, in the report, as B factors."""

import gzip
import json
import math
import re
import shutil
import subprocess
import unittest

from needs import needs
from tool import CRAMBIN, DATA, FAST, LIBRARY, ToolTest

ASPARTATE = DATA / "4at1.ent.gz"
SAS = ["--surface", "sas"]
RESIDUE = ("chain", "residue", "number", "insertion_code", "label_chain")


def atom(i, x, y=0.0, z=0.0, residue="ALA", number=1, chain="A", name="CB", element="C"):
    return (f"ATOM  {i:5}  {name:<3} {residue} {chain}{number:4}    {x:8.3f}{y:8.3f}{z:8.3f}"
            f"  1.00  0.00          {element:>2}\n")


class Areas(ToolTest):
    def report(self, name):
        return json.loads((self.folder / name).read_text())

    def write(self, name, text):
        (self.folder / name).write_text(text)

    def total(self, rows, column="area"):
        return sum(float(row[column]) for row in rows)

    def test_tables_add_up_to_the_surface(self):
        for kind in "sas", "vdw", "ses", "variational", "gaussian":
            self.check(0, CRAMBIN, *FAST, "--surface", kind, "-o", "a.atoms.csv", "-o", "a.residues.csv",
                       "-o", "a.json", "--areas", "atoms,residues", "--force")
            atoms, residues, report = self.table("a.atoms.csv"), self.table("a.residues.csv"), self.report("a.json")
            area = report["surface"]["area"]
            self.assertEqual((len(atoms), len(residues)), (327, 46))
            self.assertAlmostEqual(self.total(atoms) / area, 1.0, 9)
            self.assertAlmostEqual(self.total(residues) / area, 1.0, 9)
            sums = {}
            for row in atoms:
                key = tuple(row[c] for c in RESIDUE)
                sums[key] = sums.get(key, 0.0) + float(row["area"])
            for row in residues:
                self.assertAlmostEqual(sums[tuple(row[c] for c in RESIDUE)], float(row["area"]), 9)
            self.assertEqual("relative_accessibility" in residues[0], kind == "sas")
            # The report has the same rows.
            for name, rows in ("atoms", atoms), ("residues", residues):
                told = report["areas"][name]
                self.assertEqual([float(r["area"]) for r in rows], [r["area"] for r in told])
                self.assertEqual(list(rows[0]), list(told[0]))
            # Closed forms need no grid.
            closed = kind in ("ses", "sas", "vdw")
            self.assertEqual(report["voxel"] is None, closed)
            self.assertEqual(report["surface"]["manifold"] is None, closed)

    def test_closed_forms_are_computed_where_they_are_written(self):
        for kind in "ses", "sas", "vdw":
            call = [CRAMBIN, *FAST, "--surface", kind, "--force", "-o", "a.ply"]
            alone = self.check(0, *call).stderr.decode()
            exact = self.check(0, *call, "-o", "a.json").stderr.decode()
            surface = self.report("a.json")["surface"]
            self.assertIn(f"{kind}: area {surface['area']:.1f} ", exact)
            self.assertIn(f"ses by its mesh: area {surface['mesh_area']:.1f} " if kind == "ses" else
                          f"{kind}: area {surface['area']:.1f} ", alone)

    def test_names_and_relative_accessibility(self):
        # A lone alanine and an unknown residue; an insertion code; an alternate location.
        self.write("a.pdb", "ATOM      1  CA AALA B  52A     1.000   2.000   3.000  0.60  9.00           C  \n"
                   + atom(2, 30.0, residue="XYZ", number=-3, chain="C", name="Q1"))
        self.check(0, "a.pdb", *SAS, "--hetero", "-o", "a.residues.csv", "-o", "a.atoms.csv")
        first, second = self.table("a.residues.csv")
        self.assertEqual([first[c] for c in RESIDUE], ["B", "ALA", "52", "A", "B"])
        self.assertEqual([second[c] for c in RESIDUE], ["C", "XYZ", "-3", "", "C"])
        area = 4 * math.pi * (1.7 + 1.4) ** 2
        self.assertAlmostEqual(float(first["area"]), area, 4)
        self.assertAlmostEqual(float(first["relative_accessibility"]), area / 129.0, 6)
        self.assertEqual(second["relative_accessibility"], "")
        atoms = self.table("a.atoms.csv")
        self.assertEqual([atoms[0][c] for c in ("atom", "altloc", "element", "atom_id", "radius_A")],
                         ["CA", "A", "C", "0", "1.7"])

    def test_label_chains_and_copies(self):
        self.check(0, DATA / "1a8o.cif.gz", "--assembly", "1", *SAS, "-o", "a.residues.csv", "-o", "a.cif",
                   "-o", "b.cif", "--waters")
        rows = self.table("a.residues.csv")
        self.assertEqual({r["chain"] for r in rows}, {"A", "A-2"})
        self.assertEqual({r["label_chain"] for r in rows}, {"A", "A-2", "B", "B-2"})
        half = len(rows) // 2
        for one, two in zip(rows[:half], rows[half:]):
            self.assertEqual((one["residue"], one["number"]), (two["residue"], two["number"]))
            self.assertAlmostEqual(float(one["area"]), float(two["area"]), 2)
        # What is written can be read again, and is the same molecule.
        self.check(0, "a.cif", "--waters", *SAS, "-o", "again.residues.csv", "--no-hetero")
        again = self.table("again.residues.csv")
        self.assertAlmostEqual(self.total(again), self.total(rows), 0)
        self.check(1, DATA / "1a8o.cif.gz", "--assembly", "1", *SAS, "-o", "a.pdb",
                   says=["no room for the chain name A-2", "[hint: -o FILE.cif]"])
        self.assertNotIn("a.pdb", self.names())

    def test_values_as_b_factors(self):
        self.check(0, CRAMBIN, *SAS, "-o", "a.pdb", "-o", "a.residues.pdb", "-o", "a.atoms.csv",
                   "-o", "a.residues.csv", "-o", "a.residues.cif")
        atoms = self.table("a.atoms.csv")
        records = [line for line in (self.folder / "a.pdb").read_text().splitlines() if line[:4] == "ATOM"]
        original = [line for line in CRAMBIN.read_text().splitlines() if line[:4] == "ATOM"]
        self.assertEqual(len(records), len(atoms))
        for record, source, row in zip(records, original, atoms):
            self.assertEqual(record[:60], source[:60])
            self.assertAlmostEqual(float(record[60:66]), float(row["area"]), delta=0.0051)
        areas = {r["number"]: float(r["area"]) for r in self.table("a.residues.csv")}
        for line in (self.folder / "a.residues.pdb").read_text().splitlines():
            if line[:4] == "ATOM":
                self.assertAlmostEqual(float(line[60:66]), areas[line[22:26].strip()], delta=0.0051)
        cif = [line.split() for line in (self.folder / "a.residues.cif").read_text().splitlines()
               if line.startswith("ATOM")]
        for words in cif:
            self.assertAlmostEqual(float(words[14]), areas[words[16]], delta=1e-3)

    def test_centered_atoms_are_where_the_mesh_is(self):
        self.check(0, CRAMBIN, *FAST, "--center", "-o", "a.pdb", "-o", "a.ply", "-o", "a.json")
        center = self.report("a.json")["center"]
        for record, source in zip((self.folder / "a.pdb").read_text().splitlines(),
                                  (line for line in CRAMBIN.read_text().splitlines() if line[:4] == "ATOM")):
            for axis in range(3):
                column = slice(30 + 8 * axis, 38 + 8 * axis)
                self.assertAlmostEqual(float(record[column]), float(source[column]) - center[axis], delta=0.00051)

    def test_contacts(self):
        r, d = 1.7 + 1.4, 4.0
        self.write("a.pdb", atom(1, 0.0) + atom(2, d, number=2) + atom(3, 40.0, number=3, chain="B")
                   + atom(4, 40.0 + d, number=4, chain="A"))
        disk = math.pi * (r * r - d * d / 4)
        for level, rows in ("atom", 2), ("residue", 2), ("chain", 1):
            self.check(0, "a.pdb", *SAS, "-o", "a.contacts.csv", "--contacts", level, "--force")
            found = self.table("a.contacts.csv")
            self.assertEqual(len(found), rows)
            for row in found:
                self.assertAlmostEqual(float(row["area"]), disk, 4)
        self.assertEqual(list(found[0]), ["chain_1", "chain_2", "area", "surface", "probe_A", "radii"])
        self.check(0, CRAMBIN, *SAS, "-o", "c.contacts.csv", "-o", "c.json", "--areas", "contacts")
        residues = self.table("c.contacts.csv")
        self.check(0, CRAMBIN, *SAS, "-o", "c.contacts.csv", "--contacts", "atom", "--force")
        between = [r for r in self.table("c.contacts.csv") if r["number_1"] != r["number_2"]]
        self.assertAlmostEqual(self.total(between), self.total(residues), 6)
        self.assertEqual(len(self.report("c.json")["areas"]["contacts"]), len(residues))
        sulfurs = {frozenset((r["number_1"], r["number_2"])) for r in between
                   if r["atom_1"] == r["atom_2"] == "SG" and float(r["distance_A"]) < 2.2}
        self.assertEqual(sulfurs, {frozenset(p) for p in (("3", "40"), ("4", "32"), ("16", "26"))})

    def test_polar_and_apolar(self):
        """By element; a hydrogen is as its heavy atom."""
        self.write("h.pdb", "ATOM      1  N   GLY A   1       0.000   0.000   0.000  1.00  0.00           N\n"
                            "ATOM      2  H   GLY A   1      -1.000   0.000   0.000  1.00  0.00           H\n"
                            "ATOM      3  CA  GLY A   1       1.450   0.000   0.000  1.00  0.00           C\n"
                            "ATOM      4  HA2 GLY A   1       1.900   1.000   0.000  1.00  0.00           H\n"
                            "HETATM    5 ZN    ZN A   2       9.000   0.000   0.000  1.00  0.00          ZN\n")
        self.check(0, "h.pdb", *SAS, "--hetero", "-o", "h.atoms.csv", "-o", "h.residues.csv")
        atoms = self.table("h.atoms.csv")
        polar = {row["atom"] for row in atoms if row["polar_area"] == row["area"]}
        self.assertEqual(polar, {"N", "H", "ZN"})
        for row in [*atoms, *self.table("h.residues.csv")]:
            self.assertAlmostEqual(float(row["polar_area"]) + float(row["apolar_area"]), float(row["area"]), 9)
        self.assertAlmostEqual(self.total(atoms, "polar_area"), self.total(self.table("h.residues.csv"), "polar_area"), 9)
        self.check(0, "h.pdb", *SAS, "--hetero", "-o", "h.json", "--areas", "residues")
        report = self.report("h.json")
        for key in "polar_area", "apolar_area":
            self.assertAlmostEqual(report[key], self.total(atoms, key), 9)
        self.check(0, "h.pdb", *SAS, "--hetero", "-o", "bare.json")
        self.assertIsNone(self.report("bare.json")["polar_area"])
        self.check(0, ASPARTATE, *SAS, "--radii", "naccess", "-o", "a.interfaces.csv")
        for row in self.table("a.interfaces.csv"):
            self.assertAlmostEqual(float(row["buried_polar_area"]) + float(row["buried_apolar_area"]),
                                   float(row["buried_area"]), 8)

    def test_interfaces(self):
        def area(*words):
            self.check(0, ASPARTATE, *SAS, *words, "-o", "x.json", "--areas", "residues", "--force")
            return self.report("x.json")["surface"]["area"]

        self.check(0, ASPARTATE, *SAS, "-o", "a.interfaces.csv", "-o", "a.json", "--areas", "interfaces")
        rows = [r for r in self.table("a.interfaces.csv") if (r["group_1"], r["group_2"]) == ("A", "B")]
        interface = (area("--select", "A") + area("--select", "B") - area("--select", "A,B")) / 2
        self.assertGreater(interface, 500.0)
        self.assertAlmostEqual(self.total(rows), interface, 8)
        self.assertAlmostEqual(self.total(rows, "buried_area") / 2, interface, 8)
        for row in rows:
            self.assertEqual(row["group"], row["chain"])
            self.assertAlmostEqual(float(row["area_alone"]) - float(row["area_together"]),
                                   float(row["buried_area"]), 9)
        self.assertLess(len(rows), 150)
        told = {tuple(i["groups"]): i for i in self.report("a.json")["interfaces"]}
        self.assertAlmostEqual(told["A", "B"]["buried_area"], interface, 8)
        for key, column in (("shape_complementarity",) * 2, ("median_distance", "median_distance_A"),
                            ("gap_volume",) * 2, ("gap_index", "gap_index_A")):
            for row in rows:
                self.assertAlmostEqual(float(row[column]), told["A", "B"][key], 9)
        for k in (0, 1):
            for row in rows:
                self.assertAlmostEqual(float(row[f"contact_area_{k + 1}"]), told["A", "B"]["contact_areas"][k], 9)
        self.assertTrue(0.5 < told["A", "B"]["shape_complementarity"] < 0.7)

    def test_buried_polar_atoms_have_no_area_in_the_complex(self):
        self.check(0, ASPARTATE, *SAS, "--select", "A,B", "-o", "a.interfaces.csv", "-o", "both.atoms.csv")
        self.check(0, ASPARTATE, *SAS, "--select", "A", "-o", "one.atoms.csv")
        self.check(0, ASPARTATE, *SAS, "--select", "B", "-o", "two.atoms.csv")
        alone = {row["atom_id"]: row for name in ("one", "two") for row in self.table(f"{name}.atoms.csv")}
        covered = [row for row in self.table("both.atoms.csv")
                   if row["element"] in ("N", "O") and float(row["area"]) < 1e-9 < float(alone[row["atom_id"]]["area"])]
        self.assertGreater(len(covered), 3)
        self.assertEqual(sum(int(row["buried_polar_atoms"]) for row in self.table("a.interfaces.csv")), len(covered))

    def test_fit_of_what_hardly_touches_is_empty(self):
        self.write("a.pdb", atom(1, 0.0, chain="A") + atom(2, 5.0, chain="B") + atom(3, 40.0, chain="C"))
        self.check(0, "a.pdb", *SAS, "--hetero", "-o", "a.interfaces.csv", "-o", "a.json")
        rows = self.table("a.interfaces.csv")
        self.assertEqual({(r["group_1"], r["group_2"]) for r in rows}, {("A", "B")})
        pair, = self.report("a.json")["interfaces"]
        for key, column in ("shape_complementarity",) * 2, ("median_distance", "median_distance_A"):
            self.assertEqual({r[column] for r in rows}, {""})
            self.assertIsNone(pair[key])
        self.assertGreater(pair["gap_volume"], 0.0)

    def test_are_of_the_accessible_surface_unless_another_is_named(self):
        self.check(0, ASPARTATE, *SAS, "-o", "sas.interfaces.csv", "-o", "sas.residues.csv")
        self.check(0, ASPARTATE, "--voxel", "2", "-o", "a.interfaces.csv", "-o", "a.residues.csv", "-o", "a.ply",
                   "-o", "a.json", "--areas", "residues", says=["variational: area", "areas of atoms and groups: sas"])
        for name in "interfaces", "residues":
            self.assertEqual((self.folder / f"a.{name}.csv").read_bytes(), (self.folder / f"sas.{name}.csv").read_bytes())
        report = self.report("a.json")
        self.assertEqual((report["areas_of"], report["surface"]["kind"]), ("sas", "variational"))
        self.assertTrue(all(i["buried_area"] > 0 for i in report["interfaces"]))
        row = self.table("a.residues.csv")[0]
        self.assertEqual([row[c] for c in ("surface", "probe_A", "radii")], ["sas", "1.4", "bondi"])
        self.check(0, ASPARTATE, "--surface", "vdw", "--radii", "protor", "-o", "b.residues.csv")
        row = self.table("b.residues.csv")[0]
        self.assertEqual([row[c] for c in ("surface", "probe_A", "radii")], ["vdw", "0", "protor"])

    def test_names_that_readers_take_for_missing(self):
        self.write("a.pdb", atom(1, 0.0, chain=" ") + atom(2, 2.0, residue=" NA", name="NA", number=2, chain=" "))
        self.check(0, "a.pdb", "--ions", "-o", "a.atoms.csv")
        self.assertIn(',"NA",', (self.folder / "a.atoms.csv").read_text())
        self.assertEqual({row["chain"] for row in self.table("a.atoms.csv")}, {"_"})

    def test_frames(self):
        self.check(0, DATA / "1d3z.pdb.gz", *SAS, "--frames", "1-3", "-o", "a.residues.csv", "-o", "a.csv",
                   "-o", "a.pdb")
        rows, frames = self.table("a.residues.csv"), self.table("a.csv")
        self.assertEqual([r["frame"] for r in rows], [n for n in "123" for _ in range(76)])
        for frame in frames:
            own = [r for r in rows if r["frame"] == frame["frame"]]
            self.assertAlmostEqual(self.total(own), float(frame["area"]), 8)
        self.assertEqual(self.names(), ["a.0001.pdb", "a.0002.pdb", "a.0003.pdb", "a.csv", "a.residues.csv"])
        self.check(1, DATA / "1d3z.pdb.gz", *SAS, "--frames", "1-2", "-o", "a.residues.csv", says="--force")

    def test_of_a_whole_by_symmetry(self):
        source = gzip.decompress((DATA / "1a8o.pdb.gz").read_bytes()).decode()
        self.write("a.pdb", source)
        self.check(0, "a.pdb", "--assembly", "1", *SAS, *FAST, "-o", "a.atoms.csv", "-o", "a.json")
        self.check(0, "a.pdb", "--assembly", "1", "--by-symmetry", *SAS, *FAST, "-o", "b.atoms.csv", "-o", "b.json")
        whole, unit = self.table("a.atoms.csv"), self.table("b.atoms.csv")
        self.assertEqual(2 * len(unit), len(whole))
        for one, two in zip(whole, unit):
            self.assertEqual(one["atom"], two["atom"])
            self.assertAlmostEqual(float(one["area"]), float(two["area"]), 4)
        self.assertAlmostEqual(2 * self.total(unit), self.report("b.json")["surface"]["area"], 3)
        self.check(2, "a.pdb", "--assembly", "1", "--by-symmetry", *FAST, "--surface", "ses",
                   "-o", "c.atoms.csv", says="closed form")

    def test_batch(self):
        shutil.copy(CRAMBIN, self.folder)
        self.write("list", "1crn.pdb\n")
        self.check(0, "batch", "list", "-O", "out", *SAS, "--formats", "residues.csv,pdb")
        self.assertEqual(sorted(p.name for p in (self.folder / "out").iterdir()),
                         ["1crn.pdb", "1crn.residues.csv", "summary.csv", "summary.json", "summary.jsonl"])
        self.check(0, CRAMBIN, *SAS, "-o", "one.residues.csv", "-o", "one.pdb")
        for one, other in ("one.residues.csv", "out/1crn.residues.csv"), ("one.pdb", "out/1crn.pdb"):
            self.assertEqual((self.folder / one).read_bytes(), (self.folder / other).read_bytes())

    def test_names_of_formulas_are_harmless(self):
        self.write("a.pqr", "ATOM 1 =CMD ALA A 1 0.0 0.0 0.0 0.1 1.5\n")
        self.check(0, "a.pqr", *SAS, "-o", "a.atoms.csv")
        self.assertEqual(self.table("a.atoms.csv")[0]["atom"], "'=CMD")

    def test_what_a_pdb_has_no_room_for(self):
        def refused(text, says, name="a.pdb", options=()):
            self.write("in.pqr", text)
            self.check(1, "in.pqr", *SAS, *options, "-o", name, says=[name, says])
            self.assertNotIn(name, self.names())

        line = "ATOM 1 CA ALA A 1 0.0 0.0 0.0 0.1 1.5\n"
        self.write("in.pqr", line)
        self.check(0, "in.pqr", *SAS, "-o", "b.pdb", "-o", "b.residues.pdb")
        refused(line.replace(" A ", " AB "), "chain name AB")
        refused(line.replace(" 1 0.0", " 12345 0.0"), "residue number 12345")
        refused(line.replace("0.0 0.0 0.0", "0.0 -1000.0 0.0"), "coordinate -1000.000000")
        refused(line.replace("1.5\n", "8.0\n"), "area 1110")
        refused("".join(f"ATOM {i} C{i} ALA A 1 {4 * i}.0 0.0 0.0 0.1 2.0\n" for i in range(12)), "area",
                "a.residues.pdb")
        self.check(0, "in.pqr", *SAS, "-o", "b.residues.cif")
        self.write("in.xyzr", "0 0 0 1.5\n")
        for name in "a.pdb", "a.cif":
            self.check(1, "in.xyzr", *SAS, "-o", name, says="the atoms of the input have no names")
        self.write("in.pdb", atom(1, 0.0, residue="   "))
        self.check(1, "in.pdb", *SAS, "-o", "a.cif", says="a.cif: the residues of the input have no names")
        self.check(0, "in.xyzr", *SAS, "-o", "a.contacts.csv", says="[hint: --contacts atom]")

    def test_records_and_elements_stay(self):
        # A modified residue within a chain, deuterium, and a ligand.
        self.write("a.pdb", atom(1, 0.0, residue="ALA") + atom(2, 3.0, residue="MSE", number=2).replace("ATOM  ", "HETATM")
                   + atom(3, 6.0, name="D1", element="D", number=3)
                   + atom(4, 9.0, residue="LIG", number=4).replace("ATOM  ", "HETATM"))
        self.check(0, "a.pdb", *SAS, "-o", "b.pdb")
        records = [line for line in (self.folder / "b.pdb").read_text().splitlines()
                   if line[:6] in ("ATOM  ", "HETATM")]
        self.assertEqual([r[:6] for r in records], ["ATOM  ", "HETATM", "ATOM  ", "HETATM"])
        self.assertEqual([r[76:78] for r in records], [" C", " C", " D", " C"])
        self.assertEqual(records[2][12:16], " D1 ")

    def test_another_probe_has_no_maxima(self):
        self.check(0, CRAMBIN, *SAS, "--probe", "3", "-o", "a.residues.csv")
        self.assertNotIn("relative_accessibility", self.table("a.residues.csv")[0])

    def test_numbers_alone_need_no_mesh(self):
        words = [CRAMBIN, "--surface", "sas", "--voxel", "1"]
        self.check(0, *words, "-o", "a.json")
        self.check(0, *words, "-o", "b.json", "-o", "b.ply")
        numbers, meshed = self.report("a.json")["surface"], self.report("b.json")["surface"]
        self.assertIsNone(numbers["closed"])
        for key in ("area", "volume", "euler_characteristic", "components", "cavities"):
            self.assertAlmostEqual(numbers[key], meshed[key], delta=1e-9 * abs(meshed[key]))

    def test_what_is_of_grids_is_of_grids_with_a_report_alone(self):
        words = ["--surface", "sas", "--voxel", "1"]
        self.check(0, CRAMBIN, *words, "-o", "a.json", "--dry-run", says="MiB of memory")
        self.assertEqual(self.names(), [])
        self.check(0, ASPARTATE, "--surface", "sas", "--voxel", "0.7", "-o", "a.json", "--memory", f"{53 + LIBRARY}M",
                   says="in bricks")
        self.assertTrue(self.report("a.json")["surface"]["closed"])
        self.check(0, "compare", CRAMBIN, CRAMBIN, *words, "-o", "b.json")
        self.check(0, DATA / "1a8o.cif.gz", *words, "--assembly", "1", "--instances", "-o", "c.json")
        self.assertTrue(self.report("c.json")["surface"]["closed"])

    def test_a_dry_run_knows_of_tables(self):
        """They need no grid, but atoms."""
        said = {}
        for name in ("a.atoms.csv", "a.interfaces.csv"):
            said[name] = self.check(0, DATA / "4at1.ent.gz", "-o", name, "--dry-run").stderr.decode()
            self.assertIn("about 0 voxels", said[name])
        seconds = [float(re.search(r"(\S+) s on one core", text)[1]) for text in said.values()]
        self.assertGreater(seconds[1], 2 * seconds[0])
        self.assertEqual(self.names(), [])
        self.check(1, DATA / "4at1.ent.gz", "-o", "a.interfaces.csv", "--max-hours", "5e-5", says="hours on")

    def test_wrong_calls(self):
        for words, says in (
                (["--areas", "atom"], ["expected some of atoms, residues, contacts, interfaces", "did you mean atoms"]),
                (["--contacts", "model"], "expected atom or residue or chain"),
                (["-o", "a.atoms.csv", "--coarse", "residue"], "--coarse together"),
                (["-o", "a.atoms.csv", "--split", "group", "--group-by", "chain"], "--split together"),
                (["-o", "a.atoms.csv", "--memory", "1G", "--surface", "gaussian"], "--memory together"),
                (["-o", "a.atoms.csv", "--instances", "--assembly", "1"], "--instances together"),
                (["-o", "a.contacts.csv", "--by-symmetry", "--assembly", "1", *SAS], "--by-symmetry together"),
                (["-o", "a.residues.json"], ["no residues as .json", "[hint: -o FILE.residues.csv"]),
                (["-o", "a.table.csv"], ["-o a.table.csv: expected --frames", "[hint: -o FILE.residues.csv"])):
            self.check(2, CRAMBIN, *words, *([] if "-o" in words else ["-o", "a.json"]), says=says)
        self.check(0, CRAMBIN, *FAST, "-o", "a.vdb")
        self.check(2, "convert", "a.vdb", "-o", "a.atoms.csv", says="convert writes .vdb, .ply,")
        self.check(0, CRAMBIN, *FAST, "-o", "a.stl", "--areas", "atoms", says="--areas is for .json")

    @needs("freesasa")
    def test_against_freesasa(self):
        """Lee and Richards' slices, a thousand an atom, with the same radii."""
        self.check(0, ASPARTATE, *SAS, "-o", "a.atoms.csv", "-o", "a.pdb")
        rows = self.table("a.atoms.csv")
        records = [line for line in (self.folder / "a.pdb").read_text().splitlines()
                   if line[:6] in ("ATOM  ", "HETATM")]
        self.write("radii.pdb", "".join(f"ATOM  {line[6:54]}{float(row['radius_A']):6.2f}{line[60:]}\n"
                                        for line, row in zip(records, rows)))
        done = subprocess.run(
            ["freesasa", "--lee-richards", "--resolution=1000", "--radius-from-occupancy", "--hetatm", "--hydrogen",
             "--format=json", "--depth=atom", "radii.pdb"], cwd=self.folder, capture_output=True, check=True)
        chains = json.loads(done.stdout)["results"][0]["structure"][0]["chains"]
        theirs = [((c["label"], r["name"].strip(), r["number"].strip(), a["name"].strip()), a["area"])
                  for c in chains for r in c["residues"] for a in r["atoms"]]
        ours = {(r["chain"], r["residue"], r["number"] + r["insertion_code"], r["atom"]): float(r["area"])
                for r in rows}
        self.assertEqual(len(theirs), len(ours))
        for key, area in theirs:
            self.assertAlmostEqual(area, ours[key], delta=0.02)


if __name__ == "__main__":
    unittest.main()
