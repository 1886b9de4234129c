# SPDX-License-Identifier: MPL-2.0
"""What runs on small molecules write is what tests/reference.json has: see reference.py, which renews it."""

import argparse
import json
import unittest

import reference


class Reference(unittest.TestCase):
    def test_files_have_their_values(self):
        known = json.loads(reference.VALUES.read_text())
        self.assertEqual(set(known), {"; ".join(case) for case in reference.CASES})
        for case, got in reference.rounded(reference.all_runs(reference.CASES)).items():
            with self.subTest(case):
                self.assertEqual(list(reference.differ(known[case], got)), [])

    def test_differences_are_seen(self):
        told = lambda a, b, name="": list(reference.differ(a, b, name))
        count, total, size, weighted = reference.sums([1.0, 2.0, 3.0, -4.0])
        self.assertEqual((count, total, size), (4, 2, 10))
        self.assertEqual(told({"x": [4, 2.0, 10.0, weighted]}, {"x": [4, 2.0001, 10.0, weighted]}), [])
        self.assertEqual(len(told({"x": [4, 2.0, 10.0, weighted]}, {"x": [4, 2.001, 10.0, weighted]})), 1)
        self.assertEqual(told({"mean_curvature": 0.5}, {"mean_curvature": 0.501}), [])
        self.assertEqual(len(told({"mean_curvature": 0.5}, {"mean_curvature": 0.504})), 1)
        self.assertNotEqual(weighted, reference.sums([2.0, 1.0, 3.0, -4.0])[3])
        self.assertEqual(len(told({"x": 1}, {"y": 1})), 2)
        self.assertEqual(len(told({"words": 5}, {"words": 6}, "a.csv")), 1)
        self.assertEqual(told({"a": True, "b": "ses"}, {"a": True, "b": "ses"}), [])
        self.assertEqual(len(told({"a": True, "b": "ses"}, {"a": False, "b": "sas"})), 2)
        self.assertEqual(reference.text(b"A 1.5 x\nB -2 #1e5\n")["0"], reference.sums([1.5, -2.0]))

    def test_a_change_is_a_change_of_one_line(self):
        values = {"a": {"b.ply": {"0": [2, 1.5], "x": "y"}, "c": {}}, "d": 1}
        lines = reference.lines_of(values).splitlines()
        self.assertEqual(json.loads("\n".join(lines)), values)
        values["a"]["b.ply"]["0"][1] = 2.5
        self.assertEqual(sum(a != b for a, b in zip(lines, reference.lines_of(values).splitlines())), 1)

    def test_a_renewal_needs_a_reason(self):
        for text in ("", "new", "it is new"):
            with self.assertRaises(argparse.ArgumentTypeError):
                reference.reason(text)
        self.assertTrue(reference.reason("areas are in closed form"))


if __name__ == "__main__":
    unittest.main()
