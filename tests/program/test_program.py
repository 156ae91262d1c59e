#!/usr/bin/env python3
"""Drives the program as a user does: commands, messages, exit codes, files, restart.

Usage: test_program.py PATH_TO_HYORYU [NAME...]; needs nothing but Python's standard library.
"""
import json
import pathlib
import resource
import signal
import subprocess
import sys
import tempfile
import time
import unittest
import xml.etree.ElementTree

HYORYU = None
CASES = pathlib.Path(__file__).resolve().parents[2] / "cases"

FLOOD = """
title = "small flood"
[time]
end = 0.5
[particles]
spacing = 0.05
[fluid]
[[fluid.block]]
shape = "box"
min = [0.0, 0.0, 0.0]
max = [0.5, 0.5, 0.6]
[[wall]]
name = "basin"
shape = "basin"
min = [0.0, 0.0, 0.0]
max = [1.6, 0.5, 1.0]
open = ["+z"]
[[body]]
name = "crate"
shape = "box"
size = [0.25, 0.25, 0.25]
density = 400.0
position = [0.8, 0.26, 0.125]
[output]
every = 0.05
"""


class ProgramTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.dir = pathlib.Path(self.folder.name)

    def tearDown(self):
        self.folder.cleanup()

    def call(self, *arguments, **options):
        return subprocess.run([HYORYU, *map(str, arguments)], cwd=self.dir, capture_output=True,
                              text=True, timeout=600, **options)

    def write(self, text, name="case.toml"):
        (self.dir / name).write_text(text)
        return name

    def files(self):
        return sorted(p.name for p in self.dir.iterdir())

    def read(self, folder, name):
        return (self.dir / folder / name).read_bytes()


class Commands(ProgramTest):
    def test_version_names_version_and_commit(self):
        done = self.call("--version")
        self.assertEqual(done.returncode, 0)
        self.assertRegex(done.stdout, r"hyoryu \d+\.\d+\.\d+ \(commit ")

    def test_the_program_does_not_link_vtk(self):
        # VTK's libraries take longer to load than a start may: they live in a module.
        linked = subprocess.run(["ldd", HYORYU], capture_output=True, text=True).stdout
        self.assertNotIn("libvtk", linked)

    def test_help_of_every_command(self):
        for command in ([], ["run"], ["check"], ["describe"], ["info"], ["render"],
                        ["report"], ["verify"], ["bench"]):
            self.assertEqual(self.call(*command, "--help").returncode, 0, command)

    def test_wrong_usage_is_the_users_mistake(self):
        for arguments in ([], ["fly"], ["run"], ["run", "x.toml", "--threads", "0"]):
            self.assertEqual(self.call(*arguments).returncode, 2, arguments)

    def test_describe(self):
        done = self.call("describe", "fluid.density")
        self.assertEqual(done.returncode, 0)
        self.assertIn("kg/m3", done.stdout)
        self.assertEqual(self.call("describe", "fluid.densty").returncode, 2)
        json.loads(self.call("describe", "--json-schema").stdout)

    def test_check_names_effects_on_and_off(self):
        done = self.call("check", CASES / "bouncing_box" / "case.toml", "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        plan = json.loads(done.stdout)
        on = {effect["name"] for effect in plan["on"]}
        off = {effect["name"] for effect in plan["off"]}
        self.assertTrue({"gravity", "contact"} <= on)
        self.assertTrue({"pressure", "artificial_viscosity", "density_diffusion", "body_load"} <= off)
        self.assertEqual(plan["counts"]["fluid"], 0)
        self.assertEqual(self.files(), [])

    def test_check_says_what_error_to_expect_where_it_is_asked_to(self):
        case = CASES / "hydrostatic_tank" / "case.toml"
        done = self.call("check", case, "--accuracy")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"pressure at rest: 0\.\d+ % \(c0 = 20 sqrt\(g H\)\)")
        self.assertIn("to halve it: ", done.stdout)
        self.assertNotIn("accuracy", self.call("check", case).stdout)
        self.assertEqual(self.call("check", case, "--accuracy", "--json").returncode, 2)

    def test_check_prints_the_mixing_rule_and_every_pair_of_materials(self):
        done = self.call("check", CASES / "bouncing_box" / "case.toml")
        self.assertIn("nothing is averaged", done.stdout)
        self.assertIn("(none) - (none)", done.stdout)
        done = self.call("check", CASES / "bouncing_box" / "case.toml", "--json")
        contact = json.loads(done.stdout)["contact"]
        self.assertIn("contact.pair", contact["mixing_rule"])
        self.assertEqual(contact["pairs"], [{"materials": [None, None], "restitution": 0.75,
                                             "friction": 0.0, "stiffness": None, "from": "contact"}])

    def test_every_case_passes_its_check(self):
        for case in sorted(CASES.glob("*/case.toml")):
            done = self.call("check", case)
            self.assertEqual(done.returncode, 0, f"{case}: {done.stderr}")
            self.assertTrue((case.parent / "README.md").exists(), case)


class Bench(ProgramTest):
    def test_quick_results_are_whole(self):
        done = self.call("bench", "--quick", "--threads", "2", "--json", "bench.json")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("share of limit", done.stdout)
        bench = json.loads((self.dir / "bench.json").read_text())
        limits = bench["limits"]
        self.assertTrue(all(value > 1e8 for value in limits.values()), limits)
        self.assertEqual({(row["precision"], row["smoothing_ratio"]) for row in bench["loops"]},
                         {(p, h) for p in ("single", "double") for h in (1.5, 1.732)})
        for row in bench["loops"]:
            # No loop does better than the machine, and the lists hold more than the pairs.
            self.assertTrue(0 < row["share_of_limit"] < 1, row)
            self.assertTrue(0.5 < row["hit_share"] < 1, row)
        self.assertEqual([row["scene"] for row in bench["steps"]], ["start", "developed"])
        for row in bench["steps"] + bench["sizes"]:
            parts = sum(stage["one_thread_seconds"] for stage in row["stages"].values())
            # No stage is counted twice. Between stages another process may have had the core.
            self.assertLess(parts / row["one_thread_step_seconds"], 1.1)
            self.assertGreater(parts / row["one_thread_step_seconds"], 0.5)
            self.assertAlmostEqual(sum(row["bytes_per_particle_of"].values()) / row["bytes_per_particle"],
                                   1, delta=1e-6)
        self.assertEqual(self.files(), ["bench.json"])

    def test_extents_exclude_each_other(self):
        self.assertEqual(self.call("bench", "--quick", "--full").returncode, 2)


class Costs(ProgramTest):
    def test_a_run_says_what_its_output_cost(self):
        done = self.call("run", self.write(FLOOD), "-o", "out", "--until", "0.1", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        summary = json.loads(self.read("out", "summary.json"))
        self.assertEqual(set(summary["output"]), {"histories", "frames", "good state", "checkpoints"})
        # Frames, and the walls, which are written once.
        files = [*(self.dir / "out" / "frames").iterdir(), *(self.dir / "out").glob("*.hdf")]
        self.assertEqual(summary["frame_writer"]["files"], len(files))
        self.assertGreater(summary["frame_writer"]["thread_seconds"], 0)
        outside = sum(summary["output"].values())
        self.assertLess(outside + sum(summary["stages"].values()), summary["wall_seconds"])


class Mistakes(ProgramTest):
    def refused(self, text, *expected, arguments=(), **options):
        before = set(self.files())
        name = self.write(text)
        done = self.call("run", name, "-o", "out", *arguments, **options)
        self.assertEqual(done.returncode, 2, done.stderr)
        for part in expected:
            self.assertIn(part, done.stderr)
        self.assertEqual(set(self.files()) - before, {"case.toml"} - before, "something was written")

    def test_unknown_key(self):
        self.refused(FLOOD.replace("[fluid]", "[fluid]\ndensty = 1000.0"),
                     "case.toml:8:1", "fluid.densty", "density", "^^^^^^")

    def test_wrong_unit(self):
        self.refused(FLOOD.replace("spacing = 0.05", 'spacing = "5 s"'), "case.toml:6:11",
                     "particles.spacing")

    def test_negative_density(self):
        self.refused(FLOOD.replace("density = 400.0", "density = -400.0"), "density", "-400")

    def test_all_mistakes_at_once(self):
        text = FLOOD.replace("spacing = 0.05", 'spacing = "5 s"').replace("density = 400.0",
                                                                          "density = -400.0")
        self.refused(text, "particles.spacing", "density", "-400")

    def test_overlapping_bodies(self):
        second = '[[body]]\nname = "second"\nshape = "box"\nsize = [0.2, 0.2, 0.2]\n' \
                 "density = 500.0\nposition = [0.9, 0.26, 0.15]\n"
        self.refused(FLOOD.replace("[output]", second + "[output]"), "overlaps", "crate", "second")

    def test_body_in_the_floor(self):
        self.refused(FLOOD.replace("0.26, 0.125]", "0.26, 0.1]"), "overlaps", "basin")

    def test_missing_case(self):
        done = self.call("run", "nowhere.toml")
        self.assertEqual(done.returncode, 2)
        self.assertIn("nowhere.toml", done.stderr)

    def test_unreadable_mesh(self):
        (self.dir / "bad.stl").write_text("this is no mesh")
        mesh = FLOOD.replace('shape = "box"\nsize = [0.25, 0.25, 0.25]',
                             'shape = "mesh"\nfile = "bad.stl"')
        self.refused(mesh, "bad.stl")
        self.refused(mesh.replace("bad.stl", "missing.stl"), "missing.stl")

    def test_non_empty_results_folder(self):
        (self.dir / "out").mkdir()
        (self.dir / "out" / "precious.txt").write_text("mine")
        for arguments in ((), ("--force",)):
            done = self.call("run", self.write(FLOOD), "-o", "out", *arguments)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertEqual([p.name for p in (self.dir / "out").iterdir()], ["precious.txt"])

    def test_a_fixed_step_beyond_stability(self):
        self.refused(FLOOD.replace("end = 0.5", "end = 0.5\nstep = 0.1"), "time.step")

    def test_an_absurd_spacing_is_refused_with_the_estimate(self):
        self.refused(FLOOD.replace("spacing = 0.05", "spacing = 1e-7"), "particles")
        self.refused(FLOOD.replace("spacing = 0.05", "spacing = 1e-5"), "1.7e+14", "particles")

    def test_a_case_beyond_the_memory_is_refused_with_the_estimate(self):
        def limit():
            resource.setrlimit(resource.RLIMIT_AS, (2 << 30, 2 << 30))

        for spacing, expected in (("0.001", "to place them alone takes"), ("0.0025", "the run needs")):
            self.refused(FLOOD.replace("spacing = 0.05", f"spacing = {spacing}"), expected, "2.",
                         preexec_fn=limit)

    def test_a_wall_far_beyond_the_domain_is_counted(self):
        domain = "[domain]\nmin = [0.0, 0.0, 0.0]\nmax = [1.6, 0.5, 1.0]\n[fluid]"
        self.refused(FLOOD.replace("[fluid]", domain).replace("max = [1.6, 0.5, 1.0]\nopen",
                                                              "max = [1e7, 1e7, 1.0]\nopen"),
                     "particles")

    def test_more_outputs_and_steps_than_can_be_are_refused_with_the_estimate(self):
        self.refused(FLOOD.replace("every = 0.05", "every = 1e-300"), "output.every", "5e+299 frames")
        self.refused(FLOOD.replace("end = 0.5", "end = 1e300"), "time.end", "at most 1e+15")
        self.refused(FLOOD.replace("end = 0.5", "end = 0.5\nstep = 1e-300"), "time.end", "5e+299")
        copies = "[body.copies]\ncount = [1000000000, 1, 1]\npitch = [1.0, 0.0, 0.0]\n[output]"
        self.refused(FLOOD.replace("[output]", copies), "body[0].copies.count", "1000000000")
        self.refused(FLOOD.replace("[output]", copies.replace("1000000000, 1, 1", "100000, 9, 9")),
                     "too many, at most 100000 bodies")

    def test_no_name_leads_out_of_the_results_folder(self):
        for name in ("../evil", "a/b", "/tmp/evil", "a\\\\b", "nul\\u0000", "line\\n"):
            self.refused(FLOOD.replace('"crate"', f'"{name}"'), "is no name")
            self.refused(FLOOD.replace('"basin"\nshape', f'"{name}"\nshape'), "is no name")


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
        self.assertRegex(log, "the numbers went wrong: step .* particle .* `time.cfl` = 3 is too large")
        self.assertIn("recovery: back to t = ", log)
        self.assertLess(json.loads((self.dir / "out" / "summary.json").read_text())["share_of_time_step"], 1)
        times = [float(line.split(",")[0]) for line in (self.dir / "out" / "energy.csv").read_text().splitlines()[2:]]
        self.assertTrue(all(a < b for a, b in zip(times, times[1:])), "no row of what was taken back is left")
        self.assertEqual(times[-1], 0.5)

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


class Report(ProgramTest):
    CASE = FLOOD.replace("small flood", "flood <&> crate").replace("end = 0.5", "end = 0.1") + """
[[gauge]]
name = "level"
type = "elevation"
at = [0.8, 0.25]
[[gauge]]
name = "load"
type = "force"
on = "basin"
"""
    # Dropped flat from 20 mm: hits the floor at sqrt(2 g h) = 0.6264 m/s with 8 kg on 4 corners.
    DROP = """
title = "drop"
[time]
end = 0.08
step = 0.001
[particles]
spacing = 0.05
[[wall]]
name = "floor"
shape = "plane"
point = [0.0, 0.0, 0.0]
normal = [0.0, 0.0, 1.0]
material = "concrete"
[[body]]
name = "cube"
shape = "box"
size = [0.2, 0.2, 0.2]
density = 1000.0
position = [0.0, 0.0, 0.12]
material = "pine"
"""

    def run_case(self, text, out="out"):
        done = self.call("run", self.write(text), "-o", out)
        self.assertEqual(done.returncode, 0, done.stderr)

    def page(self, *arguments):
        """The page, parsed as XML: raises if it is not well-formed."""
        done = self.call("report", "out", "-o", "page.html", *arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        text = (self.dir / "page.html").read_text()
        return text, xml.etree.ElementTree.fromstring(text)

    def rows(self, root, heading):
        """Cells of the first table after the heading."""
        body = root.find("{*}body")
        at = [k for k, e in enumerate(body) if (e.text or "") == heading][0]
        table = next(e for e in body[at:] if e.tag.endswith("}table"))
        return [["".join(cell.itertext()) for cell in row] for row in table.findall(".//{*}tr")]

    def refused(self, code, *expected):
        before = sorted(p.name for p in self.dir.rglob("*"))
        done = self.call("report", "out")
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        for text in expected:
            self.assertIn(text, done.stderr)
        self.assertEqual(sorted(p.name for p in self.dir.rglob("*")), before)

    def test_the_page_is_well_formed_and_needs_nothing_else(self):
        self.run_case(self.CASE)
        text, root = self.page()
        self.assertEqual(root.find(".//{*}h1").text, "flood <&> crate")
        for forbidden in ("<script", "src=", "href=", "url(", "@import", "nan", "inf "):
            self.assertNotIn(forbidden, text.replace("http://www.w3.org/", ""), forbidden)
        headings = [h.text for h in root.findall(".//{*}h2")]
        self.assertEqual(headings, ["Case", "Run", "Impacts", "Tracks of the bodies", "Gauges",
                                    "Energy and momentum", "Plan", "Cost by stage"])

    def test_the_page_says_what_the_files_of_the_run_say(self):
        self.run_case(self.CASE)
        _, root = self.page()
        summary = json.loads((self.dir / "out" / "summary.json").read_text())
        plan = json.loads((self.dir / "out" / "plan.json").read_text())
        run = dict(self.rows(root, "Run")[1:])
        self.assertEqual(int(run["steps"]), summary["steps"])
        self.assertEqual(int(run["threads"]), summary["threads"])
        self.assertAlmostEqual(float(run["worst density error"]), summary["worst_density_error"],
                               delta=1e-3 * summary["worst_density_error"])
        self.assertEqual(dict(self.rows(root, "Case")[1:])["particle spacing [m]"], "0.05")
        on = self.rows(root, "Effects that ran")[1:]
        self.assertEqual(on, [[e["name"], e["why"]] for e in plan["on"]])
        off = self.rows(root, "Effects that did not run")[1:]
        self.assertEqual(off, [[e["name"], e["why"]] for e in plan["off"]])
        stages = {row[0] for row in self.rows(root, "Cost by stage")}
        self.assertTrue(set(summary["stages"]) <= stages)

    def test_every_gauge_has_plots_with_its_unit(self):
        self.run_case(self.CASE)
        _, root = self.page()
        charts = {svg.get("aria-label"): "".join(svg.itertext()) for svg in root.findall(".//{*}svg")}
        self.assertIn("[m]", charts["level"])
        self.assertIn("[N]", charts["load"])
        self.assertIn("[N s]", charts["load_fluid_impulse"])
        for part in ("load_pressure", "load_viscous", "load_contact", "load_contact_impulse"):
            self.assertIn(part, charts)

    def test_impacts_have_the_numbers_of_the_drop(self):
        self.run_case(self.DROP)
        text, root = self.page()
        self.assertIn("--stiffness K", text)
        rows = self.rows(root, "On floor")
        self.assertEqual(len(rows[0]), 6)
        self.assertAlmostEqual(float(rows[1][0]), (2 * 0.02 / 9.81) ** 0.5, delta=1e-6)
        self.assertEqual(rows[1][1], "cube")
        self.assertAlmostEqual(float(rows[1][2]), (2 * 9.81 * 0.02) ** 0.5, delta=1e-4)
        self.assertIn("impulses together", text)
        _, root = self.page("--stiffness", "2.5e5")
        rows = self.rows(root, "On floor")
        self.assertEqual(rows[0][6], "u sqrt(k m) [N]")
        u, m = float(rows[1][2]), float(rows[1][4])
        self.assertAlmostEqual(float(rows[1][6]), u * (2.5e5 * m) ** 0.5, delta=1e-3 * u * (2.5e5 * m) ** 0.5)

    def test_the_stiffness_of_the_case_is_used(self):
        pair = "[[contact.pair]]\nmaterials = [\"pine\", \"concrete\"]\nrestitution = 0.4\n" \
               "friction = 0.3\nstiffness = 1.0e6\n"
        self.run_case(self.DROP + pair)
        _, root = self.page()
        rows = self.rows(root, "On floor")
        u, m = float(rows[1][2]), float(rows[1][4])
        self.assertAlmostEqual(float(rows[1][6]), u * (1e6 * m) ** 0.5, delta=u * m ** 0.5)

    def test_two_dimensions_are_per_metre_of_width(self):
        self.run_case("dimensions = 2\n" + self.DROP.strip())
        text, _ = self.page("--stiffness", "2.5e5")
        self.assertIn("u sqrt(k m) [N/m]", text)
        self.assertIn("normal impulse [N s/m]", text)
        self.assertIn(">z [m]<", text)

    def test_by_default_the_page_stands_in_the_folder_and_force_replaces_it(self):
        self.run_case(self.DROP)
        self.assertEqual(self.call("report", "out").returncode, 0)
        self.assertTrue((self.dir / "out" / "report.html").exists())
        self.assertEqual(self.call("run", "case.toml", "-o", "out", "--force").returncode, 0)
        self.assertFalse((self.dir / "out" / "report.html").exists())

    def test_what_is_no_ended_run_is_refused(self):
        self.refused(2, "not a results folder", "`hyoryu run`")
        self.run_case(self.DROP)
        (self.dir / "out" / "summary.json").unlink()
        self.refused(2, "summary.json", "--resume")

    def test_missing_and_damaged_files_are_told(self):
        self.run_case(self.CASE)
        for name, damage in (("energy.csv", "time,fluid_kinetic\n0,1,2\n"),
                             ("bodies.csv", "# m\ntime,body\n0,crate\n"),
                             ("contacts.csv", ""), ("gauges.csv", "time,level\n0,wet\n"),
                             ("case.toml", "title = \n"), ("plan.json", "{"),
                             ("summary.json", "{}"), ("structures.hdf", "no HDF5")):
            file = self.dir / "out" / name
            good = file.read_bytes()
            file.write_text(damage)
            self.refused(4, name)
            if name not in ("plan.json", "summary.json"):
                file.unlink()
                self.refused(4, name)
            file.write_bytes(good)

    def test_an_unusable_stiffness_or_place_is_told(self):
        self.run_case(self.DROP)
        self.assertEqual(self.call("report", "out", "--stiffness", "-1").returncode, 2)
        self.assertEqual(self.call("report", "out", "-o", "no/such/page.html").returncode, 4)


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

    def test_the_shipped_benchmarks_are_found_and_one_passes(self):
        listed = self.call("verify", "--list")
        self.assertEqual(listed.returncode, 0, listed.stderr)
        self.assertIn("bouncing_box", listed.stdout)
        done = self.call("verify", "skid_to_roll")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertTrue((self.dir / "verify-results" / "verify.json").exists())


class Study(ProgramTest):
    """A brick that slides on a floor until friction stops it, over the time step."""

    STUDY = """
title = "Sliding brick"
case = "brick.toml"
[[sweep]]
key = "time.step"
values = [0.02, 0.01, 0.005]
[[quantity]]
name = "way"
unit = "m"
value = "x"
measure = "last"
expected = "1/(2*0.5*9.81)"
"""
    CASE = """
[time]
end = 0.3
step = 0.01
[particles]
spacing = 0.05
[[wall]]
name = "floor"
shape = "plane"
point = [0.0, 0.0, 0.0]
normal = [0.0, 0.0, 1.0]
[[body]]
name = "brick"
shape = "box"
size = [0.2, 0.1, 0.1]
density = 2000.0
position = [0.0, 0.0, 0.05]
velocity = [1.0, 0.0, 0.0]
[contact]
restitution = 0.0
friction = 0.5
[output]
every = 0.3
"""

    def study(self, *arguments, text=STUDY):
        self.write(self.CASE, "brick.toml")
        self.write(text, "slide.toml")
        return self.call("study", "slide.toml", *arguments)

    def rows(self, folder="slide-results"):
        """The table without wall times."""
        table = [line.split(",") for line in self.read(folder, "study.csv").decode().splitlines()]
        head = table[1]
        walls = [k for k, name in enumerate(head) if name.startswith("wall")]
        return [[cell for k, cell in enumerate(row) if k not in walls] for row in table[1:]]

    def test_results_are_complete_and_agree(self):
        done = self.study()
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        for part in ("3/3", "Cheapest setting", "Orders", "time.step"):
            self.assertIn(part, done.stdout)
        report = json.loads(self.read("slide-results", "study.json"))
        self.assertEqual([run["name"] for run in report["runs"]],
                         ["step=0.02", "step=0.01", "step=0.005"])
        exact = 1/(2*0.5*9.81)
        for run, row in zip(report["runs"], self.rows()[1:]):
            value = run["values"][0]
            self.assertAlmostEqual(value["error"], abs(value["value"]/exact - 1), 12)
            self.assertAlmostEqual(float(row[5]), value["error"], 12)
            self.assertLess(value["error"], 0.01)
            self.assertEqual(run["steps"], run["work"])
        page = xml.etree.ElementTree.fromstring(self.read("slide-results", "study.html"))
        self.assertEqual(page.tag.rpartition("}")[2], "html")
        self.assertNotIn(b"src=\"http", self.read("slide-results", "study.html"))
        self.assertIn("| quantity |", self.read("slide-results", "study.md").decode())

    def test_what_is_done_is_not_run_again_and_gives_the_same_table(self):
        self.assertEqual(self.study().returncode, 0)
        table = self.rows()
        summary = self.dir / "slide-results" / "runs" / "step=0.01" / "summary.json"
        first = summary.stat().st_mtime_ns
        done = self.study()
        self.assertEqual(done.stdout.count("done before"), 3, done.stdout)
        self.assertEqual(self.rows(), table)
        self.assertEqual(summary.stat().st_mtime_ns, first)
        self.assertNotIn("done before", self.study("--force").stdout)
        self.assertEqual(self.rows(), table)

    def test_a_run_cut_short_and_a_changed_case_are_run_again(self):
        self.assertEqual(self.study().returncode, 0)
        table = self.rows()
        runs = self.dir / "slide-results" / "runs"
        (runs / "step=0.01" / "summary.json").unlink()
        self.assertEqual(self.study().stdout.count("done before"), 2)
        self.assertEqual(self.rows(), table)
        other = self.STUDY.replace("[[sweep]]", 'set = ["contact.friction=0.4"]\n[[sweep]]', 1)
        self.assertNotIn("done before", self.study(text=other).stdout)
        self.assertNotEqual(self.rows(), table)

    def test_stopping_and_resuming_gives_the_same_table(self):
        self.assertEqual(self.study("-o", "whole").returncode, 0)
        process = subprocess.Popen([HYORYU, "study", "slide.toml", "-o", "parts"], cwd=self.dir,
                                   stdout=subprocess.PIPE, text=True)
        self.assertIn("1/3", process.stdout.readline())
        process.send_signal(signal.SIGINT)
        rest = process.communicate(timeout=60)[0]
        # A machine that is quick may have come to its end first.
        self.assertIn(process.returncode, (130, 0), rest)
        done = self.study("-o", "parts")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("done before", done.stdout)
        self.assertEqual(self.rows("parts"), self.rows("whole"))

    def test_runs_side_by_side_give_the_same_table(self):
        self.assertEqual(self.study("-o", "one").returncode, 0)
        self.assertEqual(self.study("-o", "two", "--jobs", "2").returncode, 0)
        self.assertEqual(self.rows("one"), self.rows("two"))

    def test_repeats_are_timed_in_rounds(self):
        done = self.study(text=self.STUDY.replace("[[sweep]]", "repeats = 2\n[[sweep]]", 1))
        self.assertIn("6/6", done.stdout)
        self.assertLess(done.stdout.index("step=0.005: done"),
                        done.stdout.index("step=0.02 (repeat 2)"))
        report = json.loads(self.read("slide-results", "study.json"))
        self.assertEqual(len(report["runs"][0]["wall_seconds"]), 2)

    def test_mistakes_are_all_told_and_nothing_is_written(self):
        done = self.study(text=self.STUDY.replace("values", "value").replace("last", "lst"))
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, r"(?s)slide.toml:6:1.*value.*did you mean \"values\"")
        self.assertRegex(done.stderr, r"slide.toml:11:11.*measure")
        done = self.study(text=self.STUDY.replace("time.step", "time.stop"))
        self.assertEqual(done.returncode, 2)
        self.assertIn("time.stop", done.stderr)
        self.assertIn("in the run stop=0.02", done.stderr)
        self.assertFalse((self.dir / "slide-results").exists(), "something was written")
        self.assertEqual(self.call("study", "none.toml").returncode, 2)

    def test_a_run_that_stops_is_told_and_the_others_count(self):
        # The slower sound speed is far below the flow's own speed: the fluid collapses.
        self.write(FLOOD, "flood.toml")
        text = self.STUDY.replace("brick", "flood").replace("time.step", "fluid.sound_speed")
        text = text.replace("[0.02, 0.01, 0.005]", "[0.6, 40]").replace("1/(2*0.5*9.81)", "0.8")
        done = self.study(text=text)
        self.assertEqual(done.returncode, 3, done.stdout + done.stderr)
        self.assertRegex(done.stdout, r"sound_speed=0.6: stopped: .*fluid particle")
        report = json.loads(self.read("slide-results", "study.json"))
        self.assertNotEqual(report["runs"][0]["error"], "")
        self.assertEqual(report["runs"][1]["error"], "")
        self.assertIn("fluid particle", self.read("slide-results", "study.md").decode())


if __name__ == "__main__":
    HYORYU = str(pathlib.Path(sys.argv.pop(1)).resolve())
    unittest.main(verbosity=2)
