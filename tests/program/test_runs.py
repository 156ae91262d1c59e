#!/usr/bin/env python3
"""Runs: results, restart, interruption, recovery."""
import json
import resource
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

    def test_what_bodies_alone_cost_is_measured_before_the_run(self):
        self.call("run", CASES / "cradle" / "case.toml", "-o", "out", "--quiet")
        plan = json.loads((self.dir / "out/plan.json").read_text())
        self.assertIsNone(plan["cost"]["development"])
        self.assertGreater(plan["cost"]["seconds_per_step"], plan["cost"]["seconds_per_first_step"])
        done = self.call("check", CASES / "cradle" / "case.toml", "--time")
        self.assertIn("a step timed now", done.stdout)
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
        self.assertRegex(log, "the numbers went wrong: step .*: probably `time.cfl` = 3 is too large")
        self.assertIn("recovery: back to t = ", log)
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

    def test_resuming_another_case_is_refused(self):
        self.run_flood("out", "--until", "0.1")
        done = self.call("run", self.write(FLOOD.replace("400.0", "500.0")), "-o", "out", "--resume")
        self.assertEqual(done.returncode, 2, done.stderr)

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

    def test_force_does_not_replace_the_case_that_is_run(self):
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


if __name__ == "__main__":
    main()
