#!/usr/bin/env python3
"""Runs one short scene and checks that the results are whole, and that ours are right.

Usage: test_bench.py PATH-OF-bench_contact
"""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

PROGRAM = sys.argv.pop(1)
NUMBERS = ("dt_s", "steps", "repeats", "us_per_step", "us_per_step_early", "us_per_step_late", "contacts")


class Bench(unittest.TestCase):
    def run_scene(self, scene):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "results.json"
            subprocess.run([PROGRAM, "--scenes", scene, "--json", file], check=True, cwd=folder,
                           capture_output=True)
            return json.loads(file.read_text())

    def test_results_are_whole(self):
        document = self.run_scene("a30_mu3")
        self.assertEqual([s["name"] for s in document["scenes"]], ["a30_mu3"])
        names = [engine["name"] for engine in document["engines"]]
        self.assertEqual(names[0], "hyoryu")
        results = document["scenes"][0]["results"]
        self.assertEqual({r["engine"] for r in results}, set(names))
        for result in results:
            for key in NUMBERS:
                self.assertGreaterEqual(result[key], 0, key)
            self.assertEqual(len(result["metrics"]), 3)

    def test_our_impact_is_exact(self):
        ours = self.run_scene("a30_mu3")["scenes"][0]["results"][0]
        for metric in ours["metrics"]:
            # Located impacts leave rounding and the contact tolerance of 1e-7 m.
            self.assertLess(abs(metric["error"]), 1e-5, metric["name"])

    def test_unknown_scene_is_refused(self):
        done = subprocess.run([PROGRAM, "--scenes", "nonsense"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 2)
        self.assertIn("'nonsense'", done.stderr)


if __name__ == "__main__":
    unittest.main()
