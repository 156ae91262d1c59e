#!/usr/bin/env python3
"""Runs: results, restart, interruption, recovery."""
import json
import os
import re
import resource
import shutil
import signal
import subprocess
import time

from program import CASES, FLOOD, HYORYU, ProgramTest, main


class Runs(ProgramTest):
    CONTRACT = {
        "bodies.csv": "time,body,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz,fx,fy,fz,tx,ty,tz",
        "contacts.csv": "time,a,b,x,y,z,nx,ny,nz,approach_speed,normal_impulse,"
                        "tangential_impulse_x,tangential_impulse_y,tangential_impulse_z,energy_lost",
        "energy.csv": "time,fluid_kinetic,fluid_potential,fluid_internal,body_kinetic,"
                      "body_potential,contact_loss,momentum_x,momentum_y,momentum_z",
    }

    def run_flood(self, out, *arguments, text=FLOOD):
        done = self.call("run", self.write(text), "-o", out, *arguments)
        self.assertEqual(done.returncode, 0, done.stderr)

    def expect_equal(self, one, other):
        for name in ("bodies.csv", "contacts.csv", "energy.csv"):
            self.assertEqual(self.read(one, name), self.read(other, name), name)
        frames = sorted(p.name for p in (self.dir / one / "frames").iterdir())
        self.assertEqual(frames, sorted(p.name for p in (self.dir / other / "frames").iterdir()))
        for frame in frames:
            self.assertEqual(self.read(one, f"frames/{frame}"), self.read(other, f"frames/{frame}"), frame)

    def test_a_run_tells_what_was_foretold_beside_what_it_cost(self):
        self.call("run", self.write(FLOOD), "-o", "out", "--set", "time.step=2e-4",
                  "--set", "time.end=0.25")
        cost = json.loads((self.dir / "out/summary.json").read_text())["cost"]
        plan = json.loads((self.dir / "out/plan.json").read_text())
        self.assertEqual([e["name"] for e in cost["effects"]], [e["name"] for e in plan["on"]])
        by_name = {e["name"]: e for e in cost["effects"]}
        for name in ("artificial_viscosity", "density_diffusion"):
            self.assertIsInstance(by_name[name]["predicted"], float)
            self.assertIsInstance(by_name[name]["measured"], float)
        self.assertIsNone(by_name["gravity"]["measured"])
        self.assertEqual(cost["steps"], {"predicted": 1250, "measured": 1250})
        self.assertGreater(cost["seconds_per_step"]["predicted"], 0)
        self.assertGreater(cost["memory_bytes"]["predicted"], 1e6)
        # All but contacts and the small texts is known beforehand, to the promised quarter.
        disk = cost["disk_bytes"]
        self.assertAlmostEqual(disk["predicted"] / disk["measured"], 1, delta=0.25)
        development = plan["cost"]["development"]
        self.assertIn(development["coarsening"], (2, 3, 4))
        self.assertAlmostEqual(plan["forecast"]["wall_seconds"],
                               plan["time_step"]["steps"] * plan["cost"]["seconds_per_step"], delta=1e-6)

    def test_memory_and_disk_are_foretold_to_a_quarter(self):
        # Of HDF5 around little, of shapes that are round, of what never changes, of fluid that leaves.
        for name in ("tilted_box", "skid_to_roll", "free_rotation", "cradle", "dam_break"):
            self.call("run", CASES / name / "case.toml", "-o", name, "--quiet")
            cost = json.loads((self.dir / name / "summary.json").read_text())["cost"]
            for what in ("memory_bytes", "disk_bytes"):
                ratio = cost[what]["predicted"] / cost[what]["measured"]
                self.assertAlmostEqual(ratio, 1, delta=0.25, msg=f"{name} {what}")

    def test_the_memory_of_a_ground_or_a_mesh_is_foretold_to_a_quarter(self):
        # VTK is loaded for the mesh alone. Water covers the ground, since memory is foretold as if it did.
        heights = "\n".join(" ".join(f"{0.1 * ((i * j) % 5):.1f}" for i in range(21)) for j in range(21))
        self.write(f"ncols 21\nnrows 21\nxllcorner 0\nyllcorner 0\ncellsize 0.5\n{heights}\n", "ground.asc")
        corner = [(0.0, 0.0, 0.0), (9.0, 0.0, 0.0), (0.0, 9.0, 0.0), (0.0, 0.0, 2.0)]
        faces = "".join("facet normal 0 0 0\nouter loop\n" + "".join("vertex %g %g %g\n" % corner[k] for k in face) +
                        "endloop\nendfacet\n" for face in ((0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)))
        self.write(f"solid s\n{faces}endsolid s\n", "slope.stl")
        ground = """[[wall]]
shape = "terrain"
file = "ground.asc"
"""
        prism = """[[wall]]
name = "house"
shape = "prism"
corners = [[3, 3, 0], [5, 3, 0], [5, 5, 0], [3, 5, 0]]
bottom = 0.0
top = 3.0
"""
        mesh = """[[wall]]
name = "slope"
shape = "mesh"
file = "slope.stl"
"""
        water = """dimensions = 3
[time]
end = 0.01
[particles]
spacing = {}
[domain]
min = [0.5, 0.5, -1.0]
max = [9.5, 9.5, 4.0]
[fluid]
[[fluid.block]]
shape = "still_water"
level = 1.0
seed = [7.0, 7.0]
"""
        for walls, spacing in ((ground, 0.25), (ground, 0.15), (ground + prism, 0.25), (ground + mesh, 0.25)):
            self.run_flood("out", "--quiet", "--force", text=water.format(spacing) + walls)
            memory = json.loads((self.dir / "out/summary.json").read_text())["cost"]["memory_bytes"]
            self.assertAlmostEqual(memory["predicted"] / memory["measured"], 1, delta=0.25, msg=walls)

    def test_the_disk_of_a_short_run_with_gauges_and_an_open_side_is_foretold_to_a_quarter(self):
        side = """[[open]]
name = "sea"
min = [0.0, 0.0, 0.0]
max = [0.0, 0.5, 1.0]
into = "+x"
kind = "absorb"
"""
        gauge = """[[gauge]]
name = "force_{}"
type = "force"
on = "{}"
filter = "exponential"
window = 0.05
"""
        text = FLOOD.replace('open = ["+z"]', 'open = ["+z", "-x"]').replace("[fluid]", '[fluid]\ngradient = "corrected"')
        text += side + gauge.format(0, "crate") + gauge.format(1, "basin") + gauge.format(2, "crate")
        self.run_flood("out", "--set", "time.end=0.05", "--set", "output.every=0.025", "--quiet", text=text)
        disk = json.loads((self.dir / "out/summary.json").read_text())["cost"]["disk_bytes"]
        self.assertAlmostEqual(disk["predicted"] / disk["measured"], 1, delta=0.25)

    def test_the_summary_of_a_resumed_run_counts_all_steps(self):
        settings = ("--set", "time.end=0.1", "--set", "output.every=0.02")
        self.run_flood("whole", *settings)
        self.run_flood("parts", *settings, "--until", "0.03")
        self.run_flood("parts", *settings, "--resume", "--until", "0.07")
        self.run_flood("parts", *settings, "--resume")
        whole, parts = (json.loads((self.dir / out / "summary.json").read_text()) for out in ("whole", "parts"))
        for key in ("steps", "steps_by_limit", "pair_interactions"):
            self.assertEqual(parts[key], whole[key], key)
        self.assertEqual(sum(parts["steps_by_limit"].values()), parts["steps"])

    def test_what_bodies_alone_cost_is_measured_before_the_run(self):
        self.call("run", CASES / "cradle" / "case.toml", "-o", "out", "--quiet")
        plan = json.loads((self.dir / "out/plan.json").read_text())
        self.assertIsNone(plan["cost"]["development"])
        self.assertGreater(plan["cost"]["seconds_per_step"], plan["cost"]["seconds_per_first_step"])
        done = self.call("check", CASES / "cradle" / "case.toml", "--time")
        self.assertIn("per step, measured now", done.stdout)
        self.assertNotIn("if all bodies touch", done.stdout)

    def test_a_damaged_plan_is_told_when_the_cost_would_be(self):
        self.call("run", self.write(FLOOD), "-o", "out", "--until", "0.01", "--set", "time.end=0.02")
        (self.dir / "out/plan.json").write_text("{")
        done = self.call("run", "case.toml", "-o", "out", "--resume", "--set", "time.end=0.02")
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertIn("plan.json is missing or damaged", done.stderr)
        self.assertEqual(json.loads((self.dir / "out/summary.json").read_text())["exit_reason"], "done")

    def test_a_short_run_is_not_timed(self):
        self.call("run", self.write(FLOOD), "-o", "out", "--set", "time.end=0.01")
        self.assertNotIn("cost", json.loads((self.dir / "out/plan.json").read_text()))
        cost = json.loads((self.dir / "out/summary.json").read_text())["cost"]
        self.assertTrue(all(e["measured"] is None for e in cost["effects"]))
        self.assertGreater(cost["seconds_per_step"]["measured"], 0)

    def test_results_are_complete(self):
        self.run_flood("out")
        out = self.dir / "out"
        for name in ("case.toml", "plan.json", "summary.json", "fluid.hdf.series", "bodies.hdf.series",
                     "surfaces.hdf.series", "walls.hdf", "results.h5", "checkpoint.h5", "run.log"):
            self.assertTrue((out / name).exists(), name)
        for name, header in self.CONTRACT.items():
            lines = (out / name).read_text().splitlines()
            self.assertTrue(lines[0].startswith("#"), name)
            self.assertTrue(lines[1].startswith(header), lines[1])
        series = json.loads((out / "fluid.hdf.series").read_text())
        self.assertEqual(len(series["files"]), 11)
        self.assertEqual(series["files"][-1]["time"], 0.5)
        summary = json.loads((out / "summary.json").read_text())
        self.assertEqual(summary["exit_reason"], "done")
        self.assertEqual(summary["particles_lost"], 0)
        # Round-off of the pair sums: half a unit of the last place of a float, a margin of 1e5 for doubles.
        round_off = {"single": 6e-8, "double": 1e-10}[summary["precision"]]
        self.assertLess(summary["momentum"]["worst_closure_of_a_step"], round_off)
        self.assertEqual(list(out.rglob("*.tmp")), [])
        self.assertEqual(self.call("info", "out").returncode, 0)

    def test_a_run_that_goes_wrong_recovers_where_the_case_allows(self):
        bold = FLOOD.replace("end = 0.5\n", "end = 0.5\ncfl = 3\n")
        self.write(bold)
        self.assertEqual(self.call("run", "case.toml", "-o", "lost").returncode, 3)
        self.write(bold.replace("cfl = 3\n", "cfl = 3\nrecover = true\n"))
        done = self.call("run", "case.toml", "-o", "out")
        self.assertEqual(done.returncode, 0, done.stderr)
        log = (self.dir / "out" / "run.log").read_text()
        self.assertRegex(log, "the simulation became unstable: step .*: probably `time.cfl` = 3 is too large")
        self.assertIn("recovery: the run continues from t = ", log)
        self.assertLess(json.loads((self.dir / "out" / "summary.json").read_text())["share_of_time_step"], 1)
        times = [float(line.split(",")[0]) for line in (self.dir / "out" / "energy.csv").read_text().splitlines()[2:]]
        self.assertTrue(all(a < b for a, b in zip(times, times[1:])), "no row of what was taken back is left")
        self.assertEqual(times[-1], 0.5)
        energies = [sum(map(float, line.split(",")[1:6]))
                    for line in (self.dir / "out" / "energy.csv").read_text().splitlines()[2:]]
        self.assertTrue(all(e < 1.1 * energies[0] for e in energies), "nothing that blew up is kept")

    def test_the_resolved_case_gives_the_same_bits(self):
        self.run_flood("out")
        done = self.call("run", "out/case.toml", "-o", "again")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.expect_equal("out", "again")

    def test_same_bits_for_one_two_and_three_threads(self):
        self.run_flood("one", "--threads", "1")
        for threads in (2, 3):
            self.run_flood(f"with{threads}", "--threads", threads)
            self.expect_equal("one", f"with{threads}")

    def test_stopping_and_resuming_gives_the_same_bits(self):
        self.run_flood("whole")
        self.run_flood("parts", "--until", "0.17")
        self.run_flood("parts", "--resume", "--until", "0.31")
        self.run_flood("parts", "--resume")
        self.expect_equal("whole", "parts")

    def test_contact_methods_and_laws_run_through(self):
        case = CASES / "bouncing_box" / "case.toml"
        speeds = {}
        for choice in ("contact.method=penalty", "contact.law=paper", "contact.law=simultaneous"):
            out = choice.replace("=", "-")
            done = self.call("run", case, "-o", out, "--set", choice, "--set", "time.end=0.2")
            self.assertEqual(done.returncode, 0, done.stderr)
            on = {e["name"] for e in json.loads((self.dir / out / "plan.json").read_text())["on"]}
            self.assertIn(choice.replace("contact.method=", "contact_").replace("contact.law=", "law_"), on)
            again = self.call("run", f"{out}/case.toml", "-o", out + "-again", "--until", "0.145")
            self.assertEqual(again.returncode, 0, again.stderr)
            self.call("run", f"{out}/case.toml", "-o", out + "-again", "--resume")
            for name in ("bodies.csv", "contacts.csv"):
                self.assertEqual(self.read(out, name), self.read(out + "-again", name), name)
            self.assertGreater(len(self.read(out, "contacts.csv").splitlines()), 2)
            row = self.read(out, "bodies.csv").splitlines()[-1].split(b",")
            speeds[choice] = float(row[11])
        # 57 ms after an impact at 1.4007 m/s: e = 0.75 exactly, and about that on a symmetric lattice
        self.assertAlmostEqual(speeds["contact.law=paper"], 0.48927, delta=1e-4)
        self.assertAlmostEqual(speeds["contact.law=simultaneous"], 0.48927, delta=1e-4)
        self.assertAlmostEqual(speeds["contact.method=penalty"], 0.52, delta=0.02)

    def test_ctrl_c_writes_a_checkpoint_and_resume_goes_on(self):
        text = FLOOD.replace("spacing = 0.05", "spacing = 0.04")
        case = self.write(text)
        process = subprocess.Popen([HYORYU, "run", case, "-o", "out"], cwd=self.dir,
                                   stderr=subprocess.DEVNULL)
        while not (self.dir / "out" / "frames" / "fluid_000003.hdf").exists():
            time.sleep(0.01)
            self.assertIsNone(process.poll(), "ended before it was interrupted")
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(60), 130)
        summary = json.loads((self.dir / "out" / "summary.json").read_text())
        self.assertEqual(summary["exit_reason"], "interrupted")
        self.assertLess(summary["simulated_seconds"], 0.5)
        self.run_flood("out", "--resume", text=text)
        self.run_flood("whole", text=text)
        self.expect_equal("whole", "out")

    def test_e10_a_batch_signal_writes_a_checkpoint_and_ends(self):
        # E10. It may come at any time: while the case is filled, in a step, and twice.
        case = self.write(FLOOD.replace("spacing = 0.05", "spacing = 0.03"))
        for begun in (False, True):
            process = subprocess.Popen([HYORYU, "run", case, "-o", "out", "--force"], cwd=self.dir,
                                       stderr=subprocess.DEVNULL)
            # From its first line on the program takes the signal; before, the system ends it.
            time.sleep(0.3)
            while begun and not (self.dir / "out" / "frames" / "fluid_000001.hdf").exists():
                time.sleep(0.01)
                self.assertIsNone(process.poll(), "ended before it was asked to")
            process.send_signal(signal.SIGUSR1)
            process.send_signal(signal.SIGUSR1)
            self.assertEqual(process.wait(120), 130)
            summary = json.loads(self.read("out", "summary.json"))
            self.assertEqual(summary["exit_reason"], "interrupted")
            self.assertTrue((self.dir / "out" / "checkpoint.h5").exists())
        done = self.call("run", case, "-o", "out", "--resume", "--until",
                         str(summary["simulated_seconds"] + 0.01))
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_stop_ends_a_run_with_a_checkpoint(self):
        case = self.write(FLOOD.replace("spacing = 0.05", "spacing = 0.03"))
        for begun in ("plan.json", "frames/fluid_000001.hdf"): # before the first step, and later
            process = subprocess.Popen([HYORYU, "run", case, "-o", "out", "--force"], cwd=self.dir,
                                       stderr=subprocess.DEVNULL)
            while not (self.dir / "out" / begun).exists():
                time.sleep(0.01)
                self.assertIsNone(process.poll(), "ended before it was asked to")
            self.assertEqual(self.call("stop", "out").returncode, 0)
            self.assertEqual(process.wait(60), 130)
            self.assertEqual(json.loads(self.read("out", "summary.json"))["exit_reason"], "interrupted")
            self.assertFalse((self.dir / "out" / "stop").exists(), "the request outlives the run")
            shutil.move(self.dir / "out", self.dir / f"out-{begun[:4]}")
        shutil.move(self.dir / "out-fram", self.dir / "out")
        again = self.call("stop", "out")
        self.assertEqual(again.returncode, 2)
        self.assertIn("no run is writing to", again.stderr)
        self.assertEqual(self.call("stop", ".").returncode, 2)
        (self.dir / "out" / "stop").write_text("left by another run")
        done = self.call("run", case, "-o", "out", "--resume", "--until", "0.3")
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_e11_threads_are_those_of_the_environment(self):
        for environment, arguments, threads in (("1", (), 1), ("2", (), 2), ("1", ("--threads", "2"), 2)):
            done = self.call("run", self.write(self.SMALL), "-o", "out", "--force", "--until", "0.01",
                             *arguments, env={**os.environ, "OMP_NUM_THREADS": environment})
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(json.loads(self.read("out", "summary.json"))["threads"], threads)

    def test_resuming_another_case_is_refused(self):
        self.run_flood("out", "--until", "0.1")
        done = self.call("run", self.write(FLOOD.replace("400.0", "500.0")), "-o", "out", "--resume")
        self.assertEqual(done.returncode, 2, done.stderr)

    SMALL = """
dimensions = 2
[time]
end = 0.2
[particles]
spacing = 0.05
[fluid]
[[fluid.block]]
shape = "box"
min = [0.0, 0.0, 0.0]
max = [0.4, 0.0, 0.6]
[[wall]]
name = "basin"
shape = "basin"
min = [0.0, 0.0, 0.0]
max = [1.4, 0.0, 1.0]
open = ["+z"]
[[body]]
name = "crate"
shape = "box"
size = [0.2, 0.2, 0.2]
density = 400.0
position = [0.7, 0.0, 0.1]
"""
    PROBE = '[[gauge]]\nname = "probe"\ntype = "pressure"\nat = [0.2, 0.0, 0.1]\n' \
            'filter = "mean"\nwindow = 0.02\n'
    CRATE = '[[gauge]]\nname = "crate"\ntype = "force"\non = "crate"\n'

    def go_on(self, text, out, *arguments):
        done = self.call("run", self.write(text), "-o", out, "--resume", *arguments)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_e4_a_finished_run_is_extended_with_the_bits_of_a_long_one(self):
        # Where output.every is left to its default, a later end moves no frame of the run.
        longer = self.SMALL.replace("end = 0.2", "end = 0.3")
        self.run_flood("out", text=self.SMALL)
        self.go_on(longer, "out")
        self.run_flood("whole", text=longer + "[output]\nevery = 0.002\n")
        self.expect_equal("whole", "out")
        self.assertIn(b"end = 0.3", self.read("out", "case.toml"))
        # And once more, with other settings of what is written.
        self.go_on(longer.replace("0.3", "0.4"), "out", "--threads", "1",
                   "--set", "output.checkpoint_every=5", "--set", "title=longer")

    def test_e4_intervals_of_output_change_on_the_way(self):
        # A row or frame is due at multiples of the new interval, numbered on.
        text = self.SMALL + "[output]\nevery = 0.05\nhistory_every = 0.05\n"
        self.run_flood("out", "--until", "0.12", text=text)
        other = text.replace("every = 0.05\nh", "every = 0.04\nh").replace("_every = 0.05",
                                                                         "_every = 0.02")
        self.go_on(other, "out", "--until", "0.17")
        self.go_on(other, "out")
        series = json.loads(self.read("out", "fluid.hdf.series"))["files"]
        for entry, time_of_it in zip(series, (0, 0.05, 0.1, 0.16, 0.2), strict=True):
            self.assertAlmostEqual(entry["time"], time_of_it, 9)
        self.assertEqual([f["name"][-8:-4] for f in series], ["0000", "0001", "0002", "0003", "0004"])
        rows = [float(line.split(b",")[0])
                for line in self.read("out", "energy.csv").splitlines()[2:]]
        due = (0, 0.05, 0.1, 0.14, 0.16, 0.18, 0.2)
        for row, time_of_it in zip(rows, due, strict=True):
            self.assertTrue(time_of_it - 1e-9 <= row < time_of_it + 0.01, (rows, due))

    def gauges(self, out, name="gauges.csv"):
        lines = self.read(out, name).decode().splitlines()
        return [line.split(",") for line in lines[1:]]

    def test_e4_gauges_come_and_go_on_the_way(self):
        text = self.SMALL + "[output]\nevery = 0.1\n"
        self.run_flood("whole", text=text + self.PROBE)
        self.run_flood("out", "--until", "0.1", text=text + self.PROBE)
        before = self.gauges("out")
        self.go_on(text + self.CRATE + self.PROBE, "out", "--until", "0.15")
        rows = self.gauges("out")
        head = rows[0]
        self.assertEqual(head[0], "time")
        self.assertEqual(rows[1][head.index("crate_x")], "nan")
        self.assertNotEqual(rows[-1][head.index("crate_x")], "nan")
        # The one that goes on has the readings, and the mean, of the run that was not touched.
        for row, alone in zip(rows, self.gauges("whole")):
            self.assertEqual([row[head.index(name)] for name in ("time", "probe", "probe_mean")],
                             alone)
        self.assertEqual(before, [[row[head.index(n)] for n in before[0]]
                                  for row in rows[:len(before)]])
        # What goes stays on disk.
        self.go_on(text + self.PROBE, "out", "--until", "0.17")
        self.assertEqual(self.gauges("out", "gauges_1.csv"), rows)
        self.assertEqual(self.gauges("out"), self.gauges("whole")[:len(self.gauges("out"))])
        self.go_on(text, "out")
        self.assertGreater(len(self.gauges("out", "gauges_2.csv")), len(rows))
        self.assertFalse((self.dir / "out" / "gauges.csv").exists())
        done = self.call("report", "out")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.run_flood("out", "--force", "--until", "0.01", text=text)

    def test_a_gauge_that_keeps_its_name_keeps_what_it_reads(self):
        self.run_flood("out", "--until", "0.1", text=self.SMALL + self.CRATE + self.PROBE)
        rows = self.gauges("out")
        for gauge, key in ((self.CRATE.replace('on = "crate"', 'on = "basin"'), "gauge[1].on"),
                           ('[[gauge]]\nname = "crate"\ntype = "front"\n', "gauge[1].type")):
            done = self.call("run", self.write(self.SMALL + self.PROBE + gauge), "-o", "out", "--resume")
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(f'`{key}`: "crate" read something else before the checkpoint', done.stderr)
            self.assertEqual(self.gauges("out"), rows)
        self.go_on(self.SMALL + self.PROBE + self.CRATE, "out")

    def test_e4_a_refusal_names_each_key_with_both_values(self):
        self.run_flood("out", "--until", "0.05", text=self.SMALL)
        before = self.snapshot("out")
        other = self.SMALL.replace("400.0", "500.0").replace("spacing = 0.05", "spacing = 0.04")
        done = self.call("run", self.write(other), "-o", "out", "--resume")
        self.assertEqual(done.returncode, 2, done.stderr)
        for key, old, new in (("body[0].density", 400, 500), ("particles.spacing", 0.05, 0.04)):
            self.assertRegex(done.stderr, rf"`{re.escape(key)}`: [^\n]*{old}[^\n]*{new}")
        self.assertNotIn("gauge", done.stderr)
        added = self.SMALL + '[[wall]]\nname = "plate"\nshape = "plane"\nnormal = [1, 0, 0]\n'
        done = self.call("run", self.write(added), "-o", "out", "--resume")
        self.assertRegex(done.stderr, r"`wall\[1\]\.name`: [^\n]*no such key[^\n]*\"plate\"")
        done = self.call("run", self.write(self.SMALL), "-o", "out", "--resume", "--set",
                         "time.end=0.01")
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertRegex(done.stderr, r"`time.end`: 0.01 s is before the checkpoint")
        self.assertEqual(self.snapshot("out"), before)

    def snapshot(self, folder):
        return {p: p.read_bytes() for p in (self.dir / folder).rglob("*") if p.is_file()}

    def test_e4_the_line_to_go_on_with_works_as_it_stands(self):
        (self.dir / "my case").mkdir()
        case = self.write(self.SMALL, "my case/it's.toml")
        arguments = ("--set", "body[0].density=450", "--set", 'title="a b"')
        done = self.call("run", case, "-o", "my case/out", "--until", "0.05", *arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        line = done.stderr.split("resume with: ")[1].splitlines()[0]
        done = subprocess.run(line, shell=True, cwd=self.dir, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        summary = json.loads(self.read("my case/out", "summary.json"))
        self.assertEqual(summary["exit_reason"], "done")

    def test_e6_a_history_that_was_cut_short_is_refused(self):
        for name in ("bodies.csv", "contacts.csv", "energy.csv", "gauges.csv"):
            text = self.SMALL + self.PROBE
            self.run_flood("out", "--force", "--until", "0.1", text=text)
            file = self.dir / "out" / name
            lines = file.read_bytes().splitlines(keepends=True)
            for left in (lines[:-1], lines[:4] + lines[5:], lines[:2], None):
                if left is None:
                    file.unlink()
                else:
                    file.write_bytes(b"".join(left))
                before = self.snapshot("out")
                done = self.call("run", "case.toml", "-o", "out", "--resume")
                self.assertEqual(done.returncode, 4, done.stderr)
                self.assertIn(name, done.stderr)
                after = self.snapshot("out")
                for path in (self.dir / "out" / "frames").iterdir():
                    self.assertEqual(before[path], after[path])
                self.assertEqual(before.get(file), after.get(file))

    def test_e6_a_plan_that_is_gone_is_made_again(self):
        self.run_flood("out", "--until", "0.05", text=self.SMALL)
        (self.dir / "out" / "plan.json").unlink()
        self.go_on(self.SMALL, "out")
        json.loads(self.read("out", "plan.json"))

    def test_resuming_nothing_or_garbage_is_told(self):
        (self.dir / "out").mkdir()
        self.write(FLOOD)
        self.assertEqual(self.call("run", "case.toml", "-o", "out", "--resume").returncode, 4)
        (self.dir / "out" / "checkpoint.h5").write_bytes(b"garbage" * 100)
        self.assertEqual(self.call("run", "case.toml", "-o", "out", "--resume").returncode, 4)

    def test_a_full_disk_keeps_what_was_written(self):
        # No file may grow beyond 200 kB: the checkpoint and later histories meet the wall.
        case = self.write(FLOOD.replace("spacing = 0.05", "spacing = 0.025"))

        def limit():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (200000, 200000))

        done = self.call("run", case, "-o", "out", preexec_fn=limit)
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertIn("error", done.stderr)
        self.assertEqual(list((self.dir / "out").rglob("*.tmp")), [])

    def test_force_replaces_an_earlier_run(self):
        self.run_flood("out", "--until", "0.1")
        self.assertEqual(self.call("run", "case.toml", "-o", "out").returncode, 2)
        self.run_flood("out", "--force")

    def test_e1_force_does_not_replace_the_case_that_is_run(self):
        # Beside its plan the folder of the case looks like that of a run.
        case = self.write(FLOOD)
        (self.dir / "plan.json").write_text(self.call("check", case, "--json").stdout)
        done = self.call("run", case, "-o", ".", "--force")
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("case.toml", done.stderr)
        self.assertEqual((self.dir / case).read_text(), FLOOD)
        # Its copy among its results is equal to what would take its place.
        self.run_flood("out", "--until", "0.1")
        done = self.call("run", "out/case.toml", "-o", "out", "--force", "--until", "0.1")
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_numbers_that_go_wrong_are_told_and_the_last_good_state_kept(self):
        # A sound speed far below the flow's own speed: the fluid collapses into itself.
        text = FLOOD.replace("[fluid]", "[fluid]\nsound_speed = 0.6")
        done = self.call("run", self.write(text), "-o", "out")
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertRegex(done.stderr, r"step \d+, t = .*fluid particle \d+.*sound_speed")
        self.assertTrue((self.dir / "out" / "checkpoint.h5").exists())
        summary = json.loads((self.dir / "out" / "summary.json").read_text())
        self.assertEqual(summary["exit_reason"], "numerical error")

    FILLING = """dimensions = 2
[time]
end = 1.2
[particles]
spacing = {spacing}
{most}
[fluid]
[[fluid.block]]
shape = "box"
min = [0.0, 0.0, 0.0]
max = [0.8, 0.0, 0.2]
[[wall]]
name = "basin"
shape = "basin"
min = [0.0, 0.0, 0.0]
max = [0.8, 0.0, 1.0]
open = ["-x", "+z"]
[[open]]
name = "in"
min = [0.0, 0.0, 0.0]
max = [0.0, 0.0, 1.0]
into = "+x"
kind = "inflow"
discharge = 0.2
[output]
every = 0.1
"""

    def test_open_sides_bring_no_more_than_is_allowed(self):
        # The first has room for the water of the start alone, not for that behind the window.
        for spacing, most in ((0.025, 290), (0.02, 700), (0.025, 500)):
            shutil.rmtree(self.dir / "out", ignore_errors=True)
            case = self.write(self.FILLING.format(spacing=spacing, most=f"most = {most}"))
            self.assertIn("would end early", self.call("check", case).stderr)
            done = self.call("run", case, "-o", "out")
            self.assertEqual(done.returncode, 3, done.stderr)
            told = re.search(r"the run holds (\d+) fluid particles, more than the (\d+) that `particles.most` allows",
                             done.stderr)
            self.assertTrue(told, done.stderr)
            self.assertNotIn("unstable", done.stderr)
            self.assertEqual(int(told[2]), most)
            self.assertLess(int(told[1]), 1.2 * most)
            summary = json.loads((self.dir / "out/summary.json").read_text())
            self.assertEqual(summary["exit_reason"], "too many particles")
            # The last good state goes on with more room, and ends as a run that had it from the start.
            done = self.call("run", case, "-o", "out", "--resume", "--set", "particles.most=0")
            self.assertEqual(done.returncode, 0, done.stderr)
            whole = self.write(self.FILLING.format(spacing=spacing, most=""), "whole.toml")
            shutil.rmtree(self.dir / "whole", ignore_errors=True)
            self.assertEqual(self.call("run", whole, "-o", "whole").returncode, 0)
            self.assertEqual((self.dir / "out/open.csv").read_bytes(), (self.dir / "whole/open.csv").read_bytes())
        closed = FLOOD.replace("spacing = 0.05", "spacing = 0.05\nmost = 5000")
        self.assertIn("`particles.most`: limits only runs with open sides", self.call("check", self.write(closed)).stderr)

    def test_the_forecast_holds_what_enters(self):
        for spacing in (0.025, 0.02):
            case = self.write(self.FILLING.format(spacing=spacing, most=""))
            for options in ((), ("--time",)):
                shown = self.call("check", case, *options).stdout
                told = re.search(r"open sides +from (\d+) to at most (\d+) fluid particles; "
                                 r"(mean number used|measured as they enter)", shown)
                self.assertTrue(told, shown)
                # The water of the start fills 0.8 x 0.2 m2, and 0.2 m2/s enter for 1.2 s.
                self.assertEqual(int(told[1]), round(0.16 / spacing**2))
                self.assertGreater(int(told[2]), 0.9 * (0.16 + 0.24) / spacing**2)
            closed = self.write(self.FILLING.format(spacing=spacing, most="").split("[[open]]")[0]
                                .replace('"-x", ', ""), "closed.toml")
            self.assertNotIn("open sides  ", self.call("check", closed).stdout)

    def test_bodies_outside_the_domain_are_named(self):
        for spacing, beside in ((0.05, 2.0), (0.04, -0.7)):
            case = self.write(FLOOD.replace("spacing = 0.05", f"spacing = {spacing}") +
                              f"""
[[body]]
name = "missed"
shape = "box"
size = [0.2, 0.2, 0.2]
density = 500
position = [{beside}, 0.0, 0.3]
[[body]]
name = "post"
shape = "box"
size = [0.2, 0.2, 0.2]
density = 500
position = [{2 * beside}, 0.0, 0.3]
fixed = true
""")
            shutil.rmtree(self.dir / "out", ignore_errors=True)
            done = self.call("run", case, "-o", "out")
            self.assertEqual(done.returncode, 0, done.stderr)
            summary = json.loads((self.dir / "out/summary.json").read_text())
            self.assertEqual(summary["bodies_outside"], ["missed"])
            self.assertIn('one body is completely below or beside the domain of the fluid at the end, first "missed"',
                          done.stderr)

    def test_render_makes_pictures(self):
        self.run_flood("out")
        done = self.call("render", "out", "--times", "0,0.5", "--width", "320", "--height", "240")
        if done.returncode == 4 and "VTK" in done.stderr:
            self.skipTest("built without VTK")
        self.assertEqual(done.returncode, 0, done.stderr)
        pictures = sorted((self.dir / "out" / "pictures").glob("*.png"))
        self.assertEqual(len(pictures), 2)
        for picture in pictures:
            self.assertGreater(picture.stat().st_size, 5000)
        for times, reason in (("0", "there is only one picture"),
                              ("0,0.5", "ffmpeg cannot be started (No such file or directory)")):
            done = self.call("render", "out", "--times", times, "--width", "320", "--height", "240",
                             env={**os.environ, "PATH": str(self.dir)})
            self.assertIn(f"no animation: {reason}", done.stdout.splitlines())
            self.assertIn("files of an earlier call", done.stdout)


if __name__ == "__main__":
    main()
