#!/usr/bin/env python3
"""Benchmarks held to their references."""
import json
import os
import signal
import subprocess
import time
import unittest.mock
import xml.etree.ElementTree

from program import HYORYU, ProgramTest, main


class Verify(ProgramTest):
    CASE = """
[time]
end = 0.1
step = 0.01
[particles]
spacing = 0.02
[[body]]
name = "stone"
shape = "box"
size = [0.06, 0.06, 0.06]
density = 2500.0
position = [0.0, 0.0, 1.0]
[output]
every = 0.1
"""
    BENCHMARK = """
title = "Stone in free fall"
group = "fall"
source = "exact: g t^2/2"
[[check]]
name = "way"
value = "1 - z"
measure = "last"
expected = "9.81*0.1^2/2"
tolerance = 1e-12
because = "round-off of a parabola"
"""

    def benchmark(self, text=BENCHMARK):
        (self.dir / "mine" / "free_fall").mkdir(parents=True, exist_ok=True)
        self.write(self.CASE, "mine/free_fall/case.toml")
        self.write(text, "mine/free_fall/verify.toml")

    def verify(self, *arguments):
        return self.call("verify", "--cases", "mine", "-o", "out", *arguments)

    def test_a_right_expectation_passes_and_is_reported(self):
        self.benchmark()
        done = self.verify("fall", "--json", "copy.json")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("1 passed, 0 failed", done.stdout)
        report = json.loads((self.dir / "copy.json").read_text())
        self.assertEqual(report["passed"], 1)
        run = report["cases"][0]["runs"][0]
        self.assertEqual(run["steps"], 10)
        self.assertAlmostEqual(run["checks"][0]["got"], 0.04905, 12)
        self.assertIn("| way |", (self.dir / "out" / "verify.md").read_text())
        self.assertTrue((self.dir / "out" / "free_fall" / "run" / "bodies.csv").exists())
        self.assertEqual(self.verify().returncode, 2, "a full folder was overwritten")
        self.assertEqual(self.verify("--force").returncode, 0)

    def test_a_figure_is_an_svg_whatever_its_name_says(self):
        figure = """
[[figure]]
file = "way.png"
title = "Fall & rise"
[[figure.panel]]
x_axis = "time [s]"
y_axis = "way [m]"
x_range = [0.0, 0.1]
y_range = [0.0, 0.05]
[[figure.panel.curve]]
label = "exact"
y = "9.81*t^2/2"
style = "theory"
[[figure.panel.curve]]
label = "run"
run = "run"
y = "1 - z"
style = "points"
"""
        self.benchmark(self.BENCHMARK + figure)
        done = self.verify()
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("drawn: out/way.svg", done.stdout)
        picture = xml.etree.ElementTree.parse(self.dir / "out" / "way.svg").getroot()
        dots = [path.get("d").count("h0") for path in picture.iter() if path.get("class") == "p"]
        self.assertEqual(sorted(dots), [1, 11], "the legend, and eleven rows of the run")
        self.assertIn("![way.svg](way.svg)", (self.dir / "out" / "verify.md").read_text())
        # A picture of an earlier version is replaced with the rest.
        (self.dir / "out" / "way.png").write_text("")
        self.assertEqual(self.verify("--force").returncode, 0)

    def test_a_wrong_expectation_fails(self):
        self.benchmark(self.BENCHMARK.replace("9.81*", "9.80*"))
        done = self.verify("free_fall")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("FAIL", done.stdout)

    def test_a_run_that_stops_fails(self):
        self.benchmark(self.BENCHMARK + '[[run]]\nname = "odd"\nset = ["body[0].density=-1"]\n')
        done = self.verify()
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("out of range", done.stdout)

    def test_parallel_runs_give_the_same_report(self):
        """Apart from costs: runs that pass, fail, stop with a mistake and become unstable, in the order of the file."""
        runs = "".join(f'[[run]]\nname = "{name}"\nset = ["{change}"]\n' for name, change in (
            ("long", "time.step=1e-5"), ("odd", "body[0].density=-1"), ("short", "time.step=0.02"),
            ("fast", "body[0].velocity=[0,0,-1e308]"), ("low", "body[0].position=[0,0,0.5]")))
        self.benchmark(self.BENCHMARK + runs)
        (self.dir / "tmp").mkdir()
        (self.dir / "out/free_fall").mkdir(parents=True)
        self.write("mine", "out/free_fall/long.messages.txt")
        reports, rows = [], []
        for jobs in ("1", "2", "4"):
            with unittest.mock.patch.dict(os.environ, TMPDIR=str(self.dir / "tmp")):
                done = self.verify("--force", "--jobs", jobs)
            self.assertEqual(done.returncode, 1, done.stderr)
            rows.append([line.split()[1] for line in done.stdout.splitlines() if line.startswith("free_fall")])
            report = json.loads((self.dir / "out/verify.json").read_text())
            self.assertEqual(report["jobs"], int(jobs))
            reports.append([{key: run.get(key) for key in ("name", "steps", "error", "checks")}
                            for run in report["cases"][0]["runs"]])
        self.assertEqual(rows[0], ["long", "odd", "short", "fast", "low"])
        self.assertEqual(rows[1:], rows[:1] * 2)
        self.assertEqual(reports[1:], reports[:1] * 2)
        self.assertIn("out of range", json.dumps(reports[0]))
        self.assertEqual(list((self.dir / "tmp").iterdir()), [], "files of messages are left")
        self.assertEqual(self.read("out/free_fall", "long.messages.txt"), b"mine")

    def test_a_request_to_stop_reaches_parallel_runs(self):
        self.benchmark(self.BENCHMARK + "".join(
            f'[[run]]\nname = "{k}"\nset = ["time.end=100", "time.step=1e-4", "output.every=10"]\n' for k in range(3)))
        (self.dir / "tmp").mkdir()
        process = subprocess.Popen([HYORYU, "verify", "--cases", "mine", "-o", "out", "--jobs", "2"], cwd=self.dir,
                                   env={**os.environ, "TMPDIR": str(self.dir / "tmp")}, stdout=subprocess.DEVNULL)
        self.addCleanup(process.kill)
        end = time.monotonic() + 60
        while not all((self.dir / f"out/free_fall/{k}/plan.json").exists() for k in (0, 1)):
            self.assertLess(time.monotonic(), end)
            time.sleep(0.01)
        process.send_signal(signal.SIGTERM)
        self.assertEqual(process.wait(60), 130)
        for k in (0, 1):
            self.assertTrue((self.dir / f"out/free_fall/{k}/checkpoint.h5").exists())
        self.assertFalse((self.dir / "out/free_fall/2").exists())
        self.assertEqual(list((self.dir / "tmp").iterdir()), [], "files of messages are left")

    def test_mistakes_are_the_users(self):
        self.benchmark()
        done = self.verify("free_fal")
        self.assertEqual(done.returncode, 2)
        self.assertIn('did you mean "free_fall"?', done.stderr)
        self.assertEqual(self.verify("--tier", "quik").returncode, 2)
        self.benchmark(self.BENCHMARK.replace("measure", "mesure"))
        done = self.verify()
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, r"verify.toml:8:1.*mesure")
        self.assertFalse((self.dir / "out").exists(), "something was written")

    def test_e1_no_file_of_the_users_is_lost(self):
        self.benchmark()
        (self.dir / "out").mkdir()
        (self.dir / "out" / "verify.md").write_text("mine")
        self.assertEqual(self.verify("--force").returncode, 2)
        self.assertEqual((self.dir / "out" / "verify.md").read_text(), "mine")
        (self.dir / "out" / "verify.md").unlink()
        (self.dir / "out" / "free_fall" / "run").mkdir(parents=True)
        thesis = self.dir / "out" / "free_fall" / "run" / "thesis.tex"
        thesis.write_text("mine")
        self.assertEqual(self.verify("--force").returncode, 2)
        self.assertEqual(thesis.read_text(), "mine")
        thesis.unlink()
        self.assertEqual(self.verify("--force").returncode, 0)
        self.assertEqual(self.verify("--force").returncode, 0)

    def test_the_shipped_benchmarks_are_found_and_one_passes(self):
        listed = self.call("verify", "--list")
        self.assertEqual(listed.returncode, 0, listed.stderr)
        self.assertIn("bouncing_box", listed.stdout)
        done = self.call("verify", "skid_to_roll")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertTrue((self.dir / "verify-results" / "verify.json").exists())


if __name__ == "__main__":
    main()
