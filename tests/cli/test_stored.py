# SPDX-License-Identifier: MPL-2.0
"""mesh and color: a stored surface again, without the atoms."""

import json
import unittest

from tool import CRAMBIN, DATA, FAST, ToolTest, read_ply

DIMER = DATA / "1a8o.cif.gz"
STORED = ("--fields", "spline,atom_id,chain_id,group_id,Cd", "--group-by", "residues:20")


def columns(vertices, names, wanted):
    places = [names.index(name) for name in wanted]
    return [tuple(vertex[p] for p in places) for vertex in vertices]


SHAPE = ("x", "y", "z", "nx", "ny", "nz", "mean_curvature", "gaussian_curvature")


class Stored(ToolTest):
    def build(self, *words):
        self.check(0, DIMER, "--assembly", "1", *FAST, *STORED, "--color", "chain", "-o", "a.vdb",
                   "-o", "a.ply", "-o", "a.stl", "-o", "a.json", *words)

    def ply(self, name):
        return read_ply((self.folder / name).read_bytes())

    def same_shape(self, a, b):
        names_a, vertices_a, triangles_a = self.ply(a)
        names_b, vertices_b, triangles_b = self.ply(b)
        self.assertEqual(triangles_a, triangles_b)
        self.assertEqual(columns(vertices_a, names_a, SHAPE), columns(vertices_b, names_b, SHAPE))

    def test_mesh_is_that_of_the_run(self):
        """Bit for bit; identities and colours are those of the nearest voxel."""
        self.build()
        self.check(0, "convert", "a.vdb", "-o", "b.ply", "-o", "b.stl", "-o", "b.json")
        self.assertEqual((self.folder / "a.stl").read_bytes(), (self.folder / "b.stl").read_bytes())
        self.same_shape("a.ply", "b.ply")
        names, run, _ = self.ply("a.ply")
        again_names, again, _ = self.ply("b.ply")
        self.assertEqual(set(names), set(again_names))
        for label in ("atom_id", "chain_id", "group_id", "red"):
            pairs = zip(columns(run, names, [label]), columns(again, again_names, [label]))
            same = sum(a == b for a, b in pairs) / len(run)
            self.assertGreater(same, 0.8 if label == "atom_id" else 0.95, label)
        a, b = (json.loads((self.folder / name).read_text()) for name in ("a.json", "b.json"))
        for key in ("area", "volume", "euler_characteristic", "triangles", "kind"):
            self.assertEqual(a["surface"][key], b["surface"][key])
        self.assertEqual(a["atoms"], b["atoms"])

    def test_mesh_of_other_runs(self):
        for words in (["--center"], ["--spline-level", "1"], ["--surface", "ses"],
                      ["--fill-cavities"]):
            with self.subTest(words):
                self.build(*words, "--force")
                self.check(0, "convert", "a.vdb", "-o", "b.ply", "--force")
                self.same_shape("a.ply", "b.ply")

    def test_specks_are_in_neither(self):
        """Pieces of less than a tenth of a voxel, of which these have some dozens."""
        for words in (["sas", "--voxel", "0.8"], ["vdw", "--voxel", "0.5"], ["gaussian", "--voxel", "0.5"]):
            self.check(0, DIMER, "--assembly", "1", "--surface", *words, "--fields", "spline", "-o", "a.vdb", "-o", "a.ply",
                       "--force")
            self.check(0, "convert", "a.vdb", "-o", "b.ply", "--force")
            (names, a, triangles), (_, b, others) = self.ply("a.ply"), self.ply("b.ply")
            self.assertEqual(len(triangles), len(others))
            # Beside a speck that went vertices may come in another order.
            self.assertEqual(sorted(columns(a, names, SHAPE)), sorted(columns(b, names, SHAPE)))

    def test_values_keep_their_colours(self):
        self.check(0, CRAMBIN, *FAST, "--color", "bfactor", "--fields", "spline,Cd,value", "-o", "a.vdb")
        for words in (["--range", "0,5"], ["--palette", "turbo"]):
            self.check(0, "convert", "a.vdb", *words, "-o", "a.ply", "--force", says="colours are those of the file")

    def test_scene_is_undone(self):
        """Of a scaled .vdb the values are rounded twice."""
        self.build("--for", "blender=nm", "--center")
        self.check(0, "convert", "a.vdb", "-o", "b.ply")
        names, run, triangles = self.ply("a.ply")
        again_names, again, again_triangles = self.ply("b.ply")
        self.assertEqual(triangles, again_triangles)
        pairs = zip(columns(run, names, "xyz"), columns(again, again_names, "xyz"))
        worst = max(abs(p - q) for one, two in pairs for p, q in zip(one, two))
        self.assertLess(worst, 1e-3)

    def test_without_spline(self):
        self.check(0, CRAMBIN, *FAST, "-o", "a.vdb", "-o", "a.json")
        self.check(0, "convert", "a.vdb", "-o", "b.json", says="no grid spline")
        a, b = (json.loads((self.folder / name).read_text())["surface"]
                for name in ("a.json", "b.json"))
        self.assertAlmostEqual(b["volume"] / a["volume"], 1, delta=0.002)

    def test_every_kind_of_mesh_and_picture(self):
        self.check(0, CRAMBIN, *FAST, "-o", "a.vdb")
        for kind in ("ply", "obj", "stl", "off", "glb", "html", "png", "json"):
            self.check(0, "convert", "a.vdb", "-o", f"b.{kind}", "-q")

    def test_recoloured(self):
        self.build()
        for word in ("group", "mean-curvature", "chain"):
            self.check(0, "convert", "a.vdb", "--color", word, "-o", "b.vdb", "-o", "b.ply",
                       "-o", "b.png", "--size", "200", "--force")
            # What is stored is what was shown.
            self.check(0, "convert", "b.vdb", "-o", "c.ply", "--force")
            names, vertices, _ = self.ply("b.ply")
            again_names, again, _ = self.ply("c.ply")
            pairs = list(zip(columns(vertices, names, ("red", "green", "blue")),
                             columns(again, again_names, ("red", "green", "blue"))))
            far = sum(max(abs(p - q) for p, q in zip(*pair)) > 40 for pair in pairs)
            self.assertLess(far / len(pairs), 0.02, word)
            self.assertGreater(len({pair[0] for pair in pairs}), 1)
            self.same_shape("a.ply", "b.ply")

    def test_chains_keep_their_colours(self):
        self.check(0, DIMER, "--assembly", "1", *FAST, "--fields", "spline,chain_id", "-o", "a.vdb",
                   "--color", "chain", "-o", "a.ply")
        self.check(0, "convert", "a.vdb", "--color", "chain", "-o", "b.ply")
        colors = []
        for name in ("a.ply", "b.ply"):
            names, vertices, _ = self.ply(name)
            colors.append(set(columns(vertices, names, ("red", "green", "blue"))))
        self.assertEqual(*colors)
        self.assertEqual(len(colors[0]), 2)

    def test_colours_that_the_file_cannot_give(self):
        self.check(0, CRAMBIN, *FAST, "-o", "a.vdb")
        for word, hint in (("chain", "--fields spline,chain_id"),
                           ("element", "--color element --fields spline,Cd")):
            self.check(1, "convert", "a.vdb", "--color", word, "-o", "b.ply",
                       says=["a.vdb: --color " + word, hint])
        self.check(0, CRAMBIN, *FAST, "--color", "element", "--fields", "Cd", "-o", "a.vdb",
                   "--force")
        self.check(0, "convert", "a.vdb", "--color", "element", "-o", "b.ply")
        self.check(1, "convert", "a.vdb", "--color", "residue", "-o", "c.ply", says="residue")
        self.assertEqual(self.names(), ["a.vdb", "b.ply"])

    def test_options_of_bricks_are_unknown(self):
        self.build()
        before = self.names()
        for words in (["--bricks", "2"], ["--memory", "4G"]):
            self.check(2, "convert", "a.vdb", "-o", "b.ply", *words, says=words[0])
            self.assertEqual(self.names(), before)
            self.assertNotIn(words[0].encode(), self.check(0, "convert", "--help").stdout)

    def test_wrong_calls(self):
        self.check(2, "convert", says="one .vdb")
        self.check(2, "convert", "a.vdb", "b.vdb", "-o", "a.ply", says="got 'a.vdb', 'b.vdb'")
        self.check(2, "convert", "a.vdb", says="-o FILE")
        self.check(2, "convert", "a.vdb", "-o", "b.vdb", says="color")
        self.check(2, "convert", "a.vdb", "-o", "b.vdb", says="--color")
        self.check(2, "convert", "a.vdb", "-o", "b.ply", "--probe", "1", says="--probe")
        self.check(1, "convert", "a.vdb", "-o", "b.ply", says="a.vdb")
        (self.folder / "a.vdb").write_text("HEADER\n")
        self.check(1, "convert", "a.vdb", "-o", "b.ply", says="a.vdb")
        self.assertEqual(self.names(), ["a.vdb"])


if __name__ == "__main__":
    unittest.main()
