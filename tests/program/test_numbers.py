#!/usr/bin/env python3
"""Numbers that mean what they say: forecasts, memory, and what a timing on a busy machine tells."""
import json
import os
import pathlib
import re
import signal
import subprocess
import sys

from program import CASES, FLOOD, ProgramTest, main

ROOT = CASES.parent
LONGER = FLOOD.replace("end = 0.5", "end = 2.0")


class Numbers(ProgramTest):
    def plan(self, *arguments, **options):
        done = self.call("check", *arguments, "--json", **options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)

    def test_d6_without_timing_a_step_is_foretold_within_a_factor_of_what_was_measured(self):
        """Against the runs in docs/forecast.md (two threads, AVX-512). The old constant was 2.2 to 6 times too long."""
        measured = {}
        for line in (ROOT / "docs/forecast.md").read_text().splitlines():
            cells = [c.strip() for c in line.split("|")]
            if line.startswith("| `"):
                measured[cells[1].strip("`")] = float(cells[8]) / float(cells[6].replace(",", ""))
        factors = {}
        for case in ("dam_break", "dam_break_dry_bed", "hydrostatic_tank", "heave_cylinder", "lobovsky",
                     "jet_on_plate", "spheric_2", "debris_flood"):
            plan = self.plan(CASES / case / "case.toml", env={**os.environ, "OMP_NUM_THREADS": "2"})
            step = plan["forecast"]["wall_seconds"] / plan["time_step"]["steps"]
            # Machines with narrower registers are told 1.6 times as long.
            narrow = 1 if plan["instruction_set"] == "AVX-512" else 1.6
            factors[case] = step / measured[case] / narrow
        for case, factor in factors.items():
            self.assertGreater(factor, 0.6, factors)
            self.assertLess(factor, 1.6, factors)

    def test_d6_a_dam_break_of_8_5_mm_is_foretold_in_hours_and_not_in_days(self):
        """docs/how-it-is-fast.md: 43.3 ms a step of two threads, developed; 118 ms were told."""
        text = """dimensions = 3
[time]
end = 1.0
[particles]
spacing = 0.0085
[fluid]
[[fluid.block]]
shape = "box"
min = [0.0, 0.0, 0.0]
max = [0.4, 0.67, 0.3]
[[wall]]
name = "basin"
shape = "basin"
min = [0.0, 0.0, 0.0]
max = [1.6, 0.67, 0.4]
open = ["+z"]
"""
        plan = self.plan(self.write(text), env={**os.environ, "OMP_NUM_THREADS": "2"})
        self.assertAlmostEqual(plan["counts"]["fluid"], 130e3, delta=5e3)
        step = plan["forecast"]["wall_seconds"] / plan["time_step"]["steps"]
        narrow = 1 if plan["instruction_set"] == "AVX-512" else 1.6
        self.assertAlmostEqual(step / narrow, 43.3e-3, delta=0.25 * 43.3e-3)

    def test_d6_every_share_has_a_spread_and_none_is_below_zero(self):
        cost = self.plan(self.write(LONGER), "--time")["cost"]
        self.assertEqual(list(cost["effects"]), list(cost["effects_spread"]))
        self.assertGreater(len(cost["effects"]), 1)
        for effect, share in cost["effects"].items():
            self.assertGreaterEqual(share, 0, effect)
            self.assertGreaterEqual(cost["effects_spread"][effect], 0, effect)
        text = self.call("check", "case.toml", "--time").stdout
        lines = [line for line in text.splitlines() if "% of a step" in line]
        self.assertEqual(len(lines), len(cost["effects"]))
        for line in lines:
            self.assertRegex(line, r"[0-9]+ % of a step, \+- [0-9]+$|less than [0-9]+ % of a step")
            self.assertNotIn(" -", line.replace("+-", ""))

    def test_d6_a_busy_machine_is_told(self):
        if not pathlib.Path("/proc/self/schedstat").exists():
            self.skipTest("the kernel does not count what threads wait for")
        cores = len(os.sched_getaffinity(0))
        others = [subprocess.Popen([sys.executable, "-c", "while True: pass"])
                  for _ in range(2 * cores)]
        try:
            text = self.call("check", self.write(LONGER), "--time").stdout
            cost = self.plan("case.toml", "--time")["cost"]
        finally:
            for other in others:
                other.send_signal(signal.SIGKILL)
                other.wait()
        self.assertRegex(text, r"the machine was busy +threads waited for a core in [0-9]+ %")
        self.assertRegex(text, r"about .* on an idle machine")
        self.assertGreater(cost["waiting_for_a_core"], 0.1)

    def test_d4_memory_is_told_as_the_user_measures_it_beside_the_columns(self):
        text = self.call("check", self.write(FLOOD)).stdout
        told = re.search(r"memory +about ([0-9.]+) MB resident, ([0-9.]+) kB per fluid particle\n"
                         r" +of which columns [0-9.]+ [kM]B, ([0-9.]+) B per particle", text)
        self.assertTrue(told, text)
        plan = self.plan("case.toml")
        fluid = plan["counts"]["fluid"]
        forecast = plan["forecast"]
        self.assertAlmostEqual(forecast["memory_bytes_per_fluid_particle"] * fluid,
                               forecast["memory_bytes"], delta=1)
        self.assertEqual(forecast["column_bytes"], sum(f["bytes"] for f in plan["fields"]))
        self.assertAlmostEqual(float(told[3]), forecast["column_bytes"] / fluid, delta=0.51)
        self.call("run", "case.toml", "-o", "out", "--set", "time.end=0.1")
        summary = json.loads(self.read("out", "summary.json"))
        cost = summary["cost"]
        per = cost["memory_bytes_per_fluid_particle"]
        self.assertAlmostEqual(per["measured"] * fluid, summary["peak_memory_bytes"], delta=1)
        self.assertAlmostEqual(per["of_it_columns"] * fluid, forecast["column_bytes"], delta=1)
        self.assertGreater(per["measured"], per["of_it_columns"])
        for effect in cost["effects"]:
            if effect["measured"] is not None:
                self.assertGreaterEqual(effect["measured"], 0)
                self.assertIsNotNone(effect["measured_spread"])

    def test_e10_threads_that_cannot_start_are_a_message_of_ours(self):
        """Stacks of a terabyte within 8 GB of addresses: no second thread can be started."""
        def limit():
            import resource
            resource.setrlimit(resource.RLIMIT_STACK, (1 << 40, resource.RLIM_INFINITY))
            resource.setrlimit(resource.RLIMIT_AS, (8 << 30, resource.RLIM_INFINITY))
        self.write(FLOOD)
        for command in (("run", "case.toml", "-o", "out", "--threads", "2"), ("check", "case.toml")):
            done = self.call(*command, preexec_fn=limit, env={**os.environ, "OMP_NUM_THREADS": "2"})
            self.assertEqual(done.returncode, 4, done.stdout + done.stderr)
            self.assertIn("only 1 of 2 threads can be started", done.stderr)
            self.assertIn("--threads", done.stderr)
            self.assertNotIn("libgomp", done.stderr)
            self.assertEqual(self.files(), ["case.toml"])


if __name__ == "__main__":
    main()
