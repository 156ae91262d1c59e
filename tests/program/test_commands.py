#!/usr/bin/env python3
"""Commands that answer at once, and the benchmark."""
import json
import subprocess
from pathlib import Path

from program import CASES, FLOOD, HYORYU, ProgramTest, main


class Commands(ProgramTest):
    def test_version_names_version_and_commit(self):
        done = self.call("--version")
        self.assertEqual(done.returncode, 0)
        self.assertRegex(done.stdout, r"hyoryu \d+\.\d+\.\d+ \(commit ")

    def test_the_program_does_not_link_vtk(self):
        # VTK's libraries take longer to load than a start may: they live in a module.
        linked = subprocess.run(["ldd", HYORYU], capture_output=True, text=True).stdout
        self.assertNotIn("libvtk", linked)

    def test_the_program_loads_no_library_for_the_network(self):
        # The shared HDF5 of Debian brings thirty of them: 6 MB in each process, and half of the time to start.
        linked = subprocess.run(["ldd", HYORYU], capture_output=True, text=True, check=True).stdout
        chosen = (Path(HYORYU).parent / "CMakeCache.txt").read_text()
        if "HYORYU_STATIC_HDF5:BOOL=ON" not in chosen or "HYORYU_HDF5_ARCHIVE-NOTFOUND" in chosen:
            self.skipTest("HYORYU_STATIC_HDF5 is off, or there is no static HDF5")
        self.assertNotRegex(linked, "libcurl|libssl|libcrypto|libgnutls|libkrb5")

    def test_help_of_every_command(self):
        for command in ([], ["run"], ["check"], ["describe"], ["info"], ["render"],
                        ["report"], ["verify"], ["bench"]):
            self.assertEqual(self.call(*command, "--help").returncode, 0, command)

    def test_wrong_usage_is_the_users_mistake(self):
        for arguments in ([], ["fly"], ["run"], ["run", "x.toml", "--threads", "0"]):
            self.assertEqual(self.call(*arguments).returncode, 2, arguments)

    def test_e11_unknown_words_get_a_suggestion(self):
        for arguments, expected in ((("chek", "a.toml"), 'did you mean "check"?'),
                                    (("fly",), "known: run, check"),
                                    (("run", "a.toml", "--resum"), 'did you mean "--resume"?'),
                                    (("run", "a.toml", "--treads=2"), 'did you mean "--threads"?'),
                                    (("study", "a.toml", "--jbos", "2"), 'did you mean "--jobs"?')):
            done = self.call(*arguments)
            self.assertEqual(done.returncode, 2, arguments)
            self.assertIn(expected, done.stderr)

    def test_e11_numbers_and_names_that_are_none_are_refused(self):
        case = self.write(FLOOD)
        for arguments in (("--until", "nan"), ("--until", "inf"), ("--until", "-1"), ("-o", ""),
                          ("--threads", "1e9")):
            self.assertEqual(self.call("run", case, *arguments).returncode, 2, arguments)
        for command in ("run", "check", "study", "render", "report", "info"):
            self.assertEqual(self.call(command, "").returncode, 2, command)
        for value in ("nan", "inf", "-1", "soon"):
            done = self.call("run", case, "--until", value)
            self.assertIn(f'--until: "{value}" is not a finite number of at least 0\n', done.stderr)
        for arguments in (("--azimuth", "nan"), ("--times", "0,nan"), ("--elevation", "inf")):
            self.assertEqual(self.call("render", "out", *arguments).returncode, 2, arguments)
        self.assertEqual(self.files(), [case])

    def test_e11_a_folder_without_results_is_the_users_mistake(self):
        (self.dir / "empty").mkdir()
        for folder in ("empty", "none"):
            for command in ("render", "report", "info"):
                done = self.call(command, folder)
                if done.returncode == 4 and "VTK" in done.stderr:
                    continue  # built without it
                self.assertEqual(done.returncode, 2, (command, folder, done.stderr))

    def test_e9_control_characters_do_not_reach_the_terminal(self):
        for arguments in (("run", "a\x1b[31m.toml"), ("info", "a\x1b[31m"), ("describe", "a\x1b"),
                          ("\x1b[31m",), ("run", "a.toml", "--\x1b[31m")):
            done = self.call(*arguments)
            self.assertEqual(done.returncode, 2, arguments)
            self.assertNotIn("\x1b", done.stdout + done.stderr)

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

    def test_c8_check_says_what_error_to_expect_where_it_is_asked_to(self):
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

    def test_bodies_alone_have_a_forecast_of_time(self):
        case = CASES / "box_heap" / "case.toml"
        done = self.call("check", case, "--json")
        # 1,960 boxes, 2,000 steps, 35 us; it took 157 s
        forecast = json.loads(done.stdout)["forecast"]
        self.assertAlmostEqual(forecast["wall_seconds"], 137.2, delta=0.1)
        # It wrote 1,080 MB, most of it rows of impacts, and held 1,849 MB at its end.
        self.assertAlmostEqual(forecast["disk_bytes"], 1080e6, delta=0.25 * 1080e6)
        self.assertAlmostEqual(forecast["memory_bytes"], 1849e6, delta=0.25 * 1849e6)
        self.assertIn("if all bodies touch", self.call("check", case).stdout)

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


if __name__ == "__main__":
    main()
