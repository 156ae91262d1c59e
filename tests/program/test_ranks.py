#!/usr/bin/env python3
"""A run that several processes share by MPI: its files are those of one process, and it ends as the user or the case ends it.

Usage: test_ranks.py PATH_TO_HYORYU [NAME...]. No call may take long, since processes that wait for each other for ever are the
fault to find: HYORYU_LONGEST seconds (default 25), more on a machine that is busy with other work. HYORYU_KILLS (default 4; 20 nightly) is how
many processes are lost at random moments, drawn by HYORYU_SEED; HYORYU_DRAWS (default 3) how many scenes are drawn for a test.
"""
import contextlib
import csv
import json
import os
import pathlib
import random
import re
import resource
import shutil
import signal
import subprocess
import time

from program import CASES, DAM, FLOOD, HISTORIES, HYORYU, ProgramTest, main

LONGEST = float(os.environ.get("HYORYU_LONGEST", "25"))  # of a call [s]
MODULE = pathlib.Path(HYORYU).parent / "libhyoryu_mpi.so"
# MPI may start as root, more processes than cores, without reading the memory of another process.
ENVIRONMENT = {**os.environ, "OMP_NUM_THREADS": "1", "OMP_WAIT_POLICY": "passive",
               "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
               "OMPI_MCA_btl_vader_single_copy_mechanism": "none"}
SHORT_DAM = DAM.replace("end = 0.4", "end = 0.12")
PART = r"\.\d{4}\."  # in the name of a file with a part of a frame
LONG_DAM = DAM.replace("end = 0.4", "end = 60.0")


DRAWS = int(os.environ.get("HYORYU_DRAWS", "3"))


def drawn_tank_with_moving_wall(rng):
    """A tank in which walls that move and a body drag water along; forces on all of them."""
    model = rng.choice(('"laminar"\nkinematic = 1e-3', '"sps"\nkinematic = 1e-4'))
    u, w = rng.uniform(-1.5, 1.5), rng.uniform(-0.4, 0.4)
    shape = rng.choice(('"box"\nsize = [0.16, 0.0, 0.12]', '"sphere"\nradius = 0.08'))
    return f"""title = "walls that drag water along"
dimensions = 2
[time]
end = 0.06
[particles]
spacing = {rng.choice((0.02, 0.017))}
[fluid]
walls = "no_slip"
[fluid.viscosity]
model = {model}
[[fluid.block]]
shape = "box"
min = [0.0, 0.0, 0.0]
max = [0.8, 0.0, 0.4]
velocity = [{rng.uniform(-1, 1)}, 0.0, 0.0]
[[wall]]
name = "basin"
shape = "basin"
min = [0.0, 0.0, 0.0]
max = [1.6, 0.0, 0.6]
open = ["+z"]
[[wall]]
name = "first"
shape = {shape}
position = [{rng.uniform(0.3, 0.7)}, 0.0, {rng.uniform(0.15, 0.25)}]
[wall.motion]
velocity = [{u}, 0.0, {w}]
[[wall]]
name = "second"
shape = "box"
size = [0.1, 0.0, 0.1]
position = [1.2, 0.0, 0.05]
[wall.motion]
velocity = [-1.0, 0.0, 0.0]
[[body]]
name = "crate"
shape = "box"
size = [0.16, 0.0, 0.12]
density = 500.0
position = [0.4, 0.0, 0.47]
""" + "".join(f'[[gauge]]\nname = "on_{on}"\ntype = "force"\non = "{on}"\n'
              for on in ("basin", "first", "second", "crate"))


class RanksTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.case = self.write(SHORT_DAM)

    def start(self, ranks, *arguments):
        """A call by that number of processes, which does not outlive the test."""
        command = ["mpirun", "--oversubscribe", "-n", str(ranks)] if ranks > 1 else []
        process = subprocess.Popen([*command, self.program, *map(str, arguments)], cwd=self.dir,
                                   env=ENVIRONMENT, stdin=subprocess.DEVNULL,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(self.end, process)
        return process

    def end(self, process):
        if process.poll() is None:
            process.terminate()  # mpirun ends its processes
            with contextlib.suppress(subprocess.TimeoutExpired):
                process.wait(5)
        process.kill()
        process.communicate()

    def finish(self, process):
        """Exit code and messages."""
        try:
            message = process.communicate(timeout=LONGEST)[1]
        except subprocess.TimeoutExpired:
            self.end(process)
            self.fail(f"still runs after {LONGEST} s: {process.args}")
        return process.returncode, message

    def run_by(self, ranks, out, *arguments, code=0):
        """What the processes tell."""
        found, message = self.finish(self.start(ranks, "run", self.case, "-o", out, *arguments))
        self.assertEqual(found, code, message)
        return message

    def wait_for(self, process, file):
        end = time.monotonic() + LONGEST
        while not (self.dir / "out" / file).exists():
            self.assertLess(time.monotonic(), end, file)
            if process.poll() is not None:
                self.fail(f"ended too early: {self.finish(process)}")
            time.sleep(0.005)

    def expect_equal(self, one, other):
        """All that a run writes, except for what tells of the processes, of the machine and of times. Of frames in parts
        the numbers of all particles, in their order."""
        def names(folder):
            return sorted(str(p.relative_to(self.dir / folder)) for p in (self.dir / folder).rglob("*")
                          if p.suffix in (".hdf", ".csv", ".series") and p.name != "ranks.csv"
                          and p.parent.name != "csv" and not re.search(PART, p.name))
        self.assertEqual(names(one), names(other))
        self.assertIn("frames/fluid_000000.hdf", names(one))
        self.assertIn("energy.csv", names(one))
        split = {re.sub(PART, ".", name) for folder in (one, other) for name in self.parts(folder)}
        for name in set(names(one)) - split:
            self.assertEqual(self.read(one, name), self.read(other, name), name)
        if split:
            one_table, other_table = self.tables(one), self.tables(other)
            self.assertEqual(list(one_table), list(other_table))
            for name, text in one_table.items():
                self.assertEqual(text, other_table[name], name)

    def parts(self, folder):
        """Files with a part of a frame."""
        return sorted(str(p.relative_to(self.dir / folder)) for p in (self.dir / folder).rglob("*.hdf")
                      if re.search(PART, p.name))

    def tables(self, folder):
        """The particles of all frames."""
        done = self.call("convert", folder, "--to", "csv", "--force")
        self.assertEqual(done.returncode, 0, done.stderr)
        return {p.name: p.read_bytes() for p in sorted((self.dir / folder / "csv").glob("*.csv"))}

    def pairs(self, folder):
        """Pairs of particles that all processes have evaluated."""
        return json.loads((self.dir / folder / "summary.json").read_text())["pair_interactions"]

    def children(self, process):
        """The processes of a run by their rank."""
        found = {}
        text = pathlib.Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text()
        for child in text.split():
            with contextlib.suppress(OSError):
                variables = pathlib.Path(f"/proc/{child}/environ").read_bytes().decode()
                rank = re.search(r"(?:^|\0)OMPI_COMM_WORLD_RANK=(\d+)\0", variables)
                if rank:
                    found[int(rank[1])] = int(child)
        return found


class Bits(RanksTest):
    def test_results_of_a_dam_break_with_crates_and_gauges_do_not_depend_on_the_processes(self):
        self.run_by(1, "one")
        for name in HISTORIES:
            self.assertGreater(len(self.read("one", name).splitlines()), 2, name)
        for ranks in (2, 3):
            self.run_by(ranks, f"by{ranks}")
            self.expect_equal("one", f"by{ranks}")
            self.assertEqual(self.pairs("one"), self.pairs(f"by{ranks}"))

    def test_results_of_a_flood_in_three_dimensions_do_not_depend_on_the_processes(self):
        self.write(FLOOD)
        for ranks in (1, 2, 3):
            self.run_by(ranks, f"by{ranks}", "--set", "time.end=0.3")
            self.expect_equal("by1", f"by{ranks}")

    def test_results_of_shipped_cases_do_not_depend_on_the_processes(self):
        for name, changes in (("floating_box", ("time.end=0.2", "particles.spacing=0.04")),
                              ("open_rest", ("time.end=0.05",)),
                              ("open_channel", ("time.end=0.05",)),
                              ("taylor_green", ("time.end=0.02",)),
                              ("cradle", ("time.end=0.1",))):  # bodies alone
            with self.subTest(name):
                self.case = CASES / name / "case.toml"
                settings = [part for change in changes for part in ("--set", change)]
                self.run_by(1, f"{name}-one", *settings)
                for ranks in (2, 3):
                    self.run_by(ranks, f"{name}-by{ranks}", *settings)
                    if name == "cradle":
                        for table in ("bodies.csv", "contacts.csv", "energy.csv"):
                            self.assertEqual(self.read(f"{name}-one", table), self.read(f"{name}-by{ranks}", table))
                    else:
                        self.expect_equal(f"{name}-one", f"{name}-by{ranks}")

    def test_more_processes_than_tiles(self):
        self.write(FLOOD)
        settings = ("--set", "particles.spacing=0.125", "--set", "time.end=0.1")
        self.run_by(1, "one", *settings)
        self.run_by(6, "many", *settings)
        self.expect_equal("one", "many")

    def test_threads_of_the_processes_change_nothing(self):
        self.run_by(1, "one", "--threads", "2")
        self.run_by(2, "two", "--threads", "2")
        self.expect_equal("one", "two")

    def test_a_balance_that_moves_the_parts_changes_nothing(self):
        self.run_by(1, "one")
        for ranks, steps in ((2, 1), (3, 5), (3, 0)):
            out = f"by{ranks}-{steps}"
            self.run_by(ranks, out, "--rebalance", steps)
            self.expect_equal("one", out)
            told = json.loads((self.dir / out / "summary.json").read_text())["ranks"]
            self.assertEqual(told["count"], ranks)
            self.assertEqual(told["rebalances"] > 0, steps > 0, told)

    def test_a_recovery_is_that_of_one_process(self):
        self.write(FLOOD.replace("end = 0.5\n", "end = 0.5\ncfl = 3\nrecover = true\n"))
        self.run_by(1, "one")
        self.assertIn("recovery: the run continues from", (self.dir / "one/run.log").read_text())
        for ranks in (2, 3):
            self.run_by(ranks, f"by{ranks}")
            self.expect_equal("one", f"by{ranks}")

    def test_each_process_is_told_of_at_each_frame(self):
        self.run_by(3, "out")
        rows = list(csv.DictReader(line for line in (self.dir / "out/ranks.csv").read_text().splitlines()
                                   if not line.startswith("#")))
        frames = len(list((self.dir / "out/frames").glob("fluid_??????.hdf")))
        self.assertEqual([row["rank"] for row in rows], ["0", "1", "2"] * frames)
        fluid = json.loads((self.dir / "out/plan.json").read_text())["counts"]["fluid"]
        for frame in range(frames):
            self.assertEqual(sum(int(row["particles"]) for row in rows[3 * frame:3 * frame + 3]), fluid)
        for row in rows:
            self.assertGreater(float(row["memory"]), 1e6)
            self.assertGreaterEqual(float(row["busy"]), 0)

    def test_more_processes_are_foretold_to_take_less_time(self):
        """From recorded rates, with a part of each step that is the same for any number."""
        seconds = {}
        for count in (2, 4):
            self.run_by(count, "out", "--until", "0.001", "--force")
            forecast = json.loads((self.dir / "out/plan.json").read_text())["forecast"]
            self.assertEqual(forecast["processes"], count)
            seconds[count] = forecast["wall_seconds"]
        self.assertLess(seconds[4], seconds[2])
        self.assertGreater(seconds[4], seconds[2] / 2)

    def test_processes_hold_their_parts_and_not_the_whole_case(self):
        column = """title = "column"
[time]
end = 1.0
[particles]
spacing = 0.025
[output]
every = 0.001
[fluid]
[[fluid.block]]
shape = "box"
min = [0.0, 0.0, 0.0]
max = [2.0, 1.0, 1.4]
[[wall]]
name = "basin"
shape = "basin"
min = [0.0, 0.0, 0.0]
max = [4.0, 1.0, 2.0]
open = ["+z"]
"""

        def most_of_one(until):
            self.run_by(1, "out", "--force", "--until", until)
            return json.loads((self.dir / "out/summary.json").read_text())["peak_memory_bytes"]

        def most_of_four(*arguments):
            self.run_by(4, "out", *arguments)
            with open(self.dir / "out/ranks.csv") as file:
                rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
            return max(float(row["memory"]) for row in rows)

        self.write(SHORT_DAM)  # hardly any particles: the program, its libraries and MPI
        program_of_one, program_of_four = most_of_one("0.001"), most_of_four("--force", "--until", "0.02")
        self.write(column)
        one = most_of_one("0.001") - program_of_one
        for arguments in (("--force", "--until", "0.001"), ("--resume", "--until", "0.002")):
            most = most_of_four(*arguments) - program_of_four
            self.assertLess(most, 0.55 * one, (arguments, one, program_of_one, program_of_four))  # half are copies of others' particles

    def test_the_report_shows_what_each_process_had_and_did(self):
        self.run_by(1, "alone")
        self.call("report", "alone")
        self.assertNotIn("<h2>Processes</h2>", self.read("alone", "report.html").decode())
        self.run_by(3, "out")
        self.assertEqual(self.call("report", "out").returncode, 0)
        page = self.read("out", "report.html").decode().partition("<h2>Processes</h2>")[2]
        self.assertIn("3 processes shared the run", page)
        self.assertEqual(page.count("<svg"), 2)
        cells = [re.findall(r"<td[^>]*>([^<]*)</td>", row) for row in page.split("<tr>")]
        rows = [row for row in cells if len(row) == 9]
        self.assertEqual([row[0] for row in rows], ["0", "1", "2"])
        fluid = json.loads((self.dir / "out/plan.json").read_text())["counts"]["fluid"]
        self.assertEqual(sum(int(row[2]) for row in rows), fluid)
        (self.dir / "out/ranks.csv").unlink()
        self.assertEqual(self.call("report", "out").returncode, 4)

    def test_scaling_is_measured(self):
        root = pathlib.Path(__file__).resolve().parent.parent.parent
        done = subprocess.run([root / "scripts/scaling", str(self.case), "--ranks", "1,3", "--steps", "40", "--repeat", "1",
                               "--launcher", "mpirun --oversubscribe", "--program", HYORYU, "--set",
                               "output.every=5", "--json",
                               self.dir / "scaling.json"], capture_output=True, text=True, cwd=self.dir,
                              env=ENVIRONMENT, timeout=4 * LONGEST)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("the same bits", done.stdout)
        one, three = json.loads((self.dir / "scaling.json").read_text())["rows"]
        self.assertEqual((one["ranks"], three["ranks"], one["efficiency"], one["messages"]), (1, 3, 1, 0))
        # Places, pressures of solids and velocities to one or two others, and what new lists need.
        self.assertGreater(three["messages"], 3)
        self.assertLess(three["messages"], 30)

    def test_the_commands_around_a_run_read_its_results(self):
        self.run_by(2, "out")
        for arguments in (("info", "out", "--json"), ("report", "out"), ("convert", "out", "--to", "csv")):
            done = self.call(*arguments)
            self.assertEqual(done.returncode, 0, (arguments, done.stderr))


class Ends(RanksTest):
    def test_a_signal_stops_a_run_and_any_number_of_processes_goes_on(self):
        self.run_by(1, "whole")
        for ranks, next_ranks in ((2, 3), (3, 1), (1, 2)):
            process = self.start(ranks, "run", self.case, "-o", "out", "--force")
            self.wait_for(process, "frames/fluid_000003.hdf")
            process.send_signal(signal.SIGUSR1)
            code, message = self.finish(process)
            self.assertEqual(code, 130, message)
            self.assertEqual(message.count("interrupted; checkpoint written"), 1, message)
            self.assertIn("--resume", message)
            self.assertFalse((self.dir / "out/frames/fluid_000012.hdf").exists(), "ended before the signal")
            self.run_by(next_ranks, "out", "--resume")
            self.expect_equal("whole", "out")
            (self.dir / "out/frames/fluid_000003.hdf").unlink()

    def test_a_request_to_stop_reaches_a_run_that_mpirun_has_started(self):
        process = self.start(2, "run", self.write(LONG_DAM), "-o", "out")
        self.wait_for(process, "frames/fluid_000001.hdf")
        self.assertEqual(self.call("stop", "out").returncode, 0)
        code, message = self.finish(process)
        self.assertEqual(code, 130, message)
        self.assertTrue((self.dir / "out/checkpoint.h5").exists())

    def test_signals_before_the_first_step_and_more_than_one(self):
        process = self.start(2, "run", self.write(LONG_DAM), "-o", "out")
        self.wait_for(process, "plan.json")
        for _ in range(3):  # mpirun itself dies of one that comes when its processes have ended
            process.send_signal(signal.SIGUSR1)
            time.sleep(0.005)
        code, message = self.finish(process)
        self.assertEqual(code, 130, message)
        self.assertTrue((self.dir / "out/checkpoint.h5").exists())

    def test_until_and_resumption_by_other_numbers_of_processes(self):
        self.run_by(1, "whole")
        for ranks, until in ((3, "0.03"), (1, "0.05"), (2, "0.08"), (4, "1")):
            self.run_by(ranks, "out", *(["--resume"] if until != "0.03" else []), "--until", until)
        self.expect_equal("whole", "out")

    def test_forces_on_walls_that_move_go_on_with_other_numbers_of_processes(self):
        """The friction on walls that move is in the state: only the process in whose tiles a particle is counts it."""
        for draw in range(DRAWS):
            with self.subTest(draw=draw):
                rng = random.Random(f"friction {draw}")
                self.write(drawn_tank_with_moving_wall(rng))
                self.run_by(1, f"one{draw}")
                chain = sorted(rng.uniform(0.005, 0.055) for _ in range(3))
                for k, until in enumerate([*chain, 1]):
                    self.run_by(rng.choice((1, 2, 3, 5)), f"out{draw}", *(["--resume"] if k else []),
                                "--until", str(until), "--parts", str(rng.choice((1, 2, 64))))
                self.expect_equal(f"one{draw}", f"out{draw}")

    def test_files_in_one_part_have_the_bytes_of_those_of_one_process(self):
        self.run_by(1, "one", "--until", "0.06")
        for ranks in (2, 3):
            out = f"by{ranks}"
            self.run_by(ranks, out, "--until", "0.06", "--parts", "1")
            self.assertEqual(self.parts(out), [])
            self.assertEqual(self.read("one", "checkpoint.h5"), self.read(out, "checkpoint.h5"))
            self.expect_equal("one", out)

    def test_a_checkpoint_in_parts_is_continued_by_any_number_of_processes(self):
        self.run_by(1, "whole")
        for ranks, most, parts in ((2, 64, 2), (5, 2, 2), (4, 3, 3), (3, 64, 3)):
            self.run_by(ranks, "parts", "--force", "--until", "0.05", "--parts", most)
            self.assertEqual(len(list((self.dir / "parts/frames").glob("fluid_000000.*.hdf"))), parts)
            # Two generations, and nothing of those before.
            files = [p.name for p in (self.dir / "parts").glob("checkpoint.0*.h5")]
            self.assertEqual(sorted({name.split(".")[2] for name in files}), [f"{k:04}" for k in range(parts)])
            self.assertLessEqual(len(files), 2 * parts)
            for by in (1, 2, 5):
                shutil.copytree(self.dir / "parts", self.dir / "out")
                self.run_by(by, "out", "--resume")
                self.expect_equal("whole", "out")
                if by == 1:
                    shutil.copytree(self.dir / "out", self.dir / "again")
                    self.run_by(1, "again", "--resume", "--set", "time.end=0.13")
                    self.assertEqual(list((self.dir / "again").glob("checkpoint.0*.h5")), [])
                    shutil.rmtree(self.dir / "again")
                shutil.rmtree(self.dir / "out")

    def test_a_part_of_a_checkpoint_that_is_missing_or_wrong_is_named(self):
        """And the checkpoint before goes on; without one, nothing is changed."""
        self.run_by(1, "whole")
        self.run_by(3, "good", "--until", "0.05")
        self.run_by(3, "other", "--until", "0.06")
        newest = max((self.dir / "good").glob("checkpoint.0*.0001.h5")).name

        def cut(part):
            part.write_bytes(part.read_bytes()[:-1000])

        def flip(part):
            content = bytearray(part.read_bytes())
            content[len(content) // 2] ^= 1
            part.write_bytes(content)

        def of_another(part):
            shutil.copy(max((self.dir / "other").glob("checkpoint.0*.0001.h5")), part)
        for damage, told in ((lambda part: part.unlink(), "does not exist"), (cut, "damaged"), (flip, "damaged"),
                             (of_another, "another checkpoint")):
            for by in (1, 2):
                for with_previous in (True, False):
                    shutil.copytree(self.dir / "good", self.dir / "out")
                    damage(self.dir / "out" / newest)
                    if not with_previous:
                        (self.dir / "out/checkpoint.previous.h5").unlink()
                        message = self.run_by(by, "out", "--resume", code=4)
                        self.assertIn(newest, message)
                        self.assertIn(told, message)
                    else:
                        self.run_by(by, "out", "--resume")
                        self.assertIn(newest, self.read("out", "run.log").decode())
                        self.expect_equal("whole", "out")
                    shutil.rmtree(self.dir / "out")

    def test_a_folder_in_the_place_of_the_checkpoint_is_named(self):
        def usable():
            return json.loads(self.call("info", "out", "--json").stdout)["checkpoint"]
        self.run_by(1, "whole", "--until", "0.08")
        self.run_by(3, "out", "--until", "0.05")
        self.assertTrue(usable())
        newest = self.dir / "out/checkpoint.h5"
        newest.rename(self.dir / "kept.h5")
        newest.mkdir()
        for ranks in (1, 2):
            message = self.run_by(ranks, "out", "--resume", code=4)
            self.assertIn("checkpoint.h5` is a folder", message)
        newest.rmdir()
        self.assertTrue(usable(), "the previous one")
        (self.dir / "out/checkpoint.previous.h5").unlink()
        self.assertFalse(usable())
        (self.dir / "kept.h5").rename(newest)
        part = min((self.dir / "out").glob("checkpoint.0*.0001.h5"), key=lambda p: -p.stat().st_mtime)
        content = part.read_bytes()
        part.write_bytes(content[:-1])
        self.assertFalse(usable())
        part.write_bytes(content)
        self.assertTrue(usable())
        self.run_by(2, "out", "--resume", "--until", "0.08")
        self.expect_equal("whole", "out")

    def test_a_part_of_a_frame_that_is_missing_or_wrong_is_named(self):
        self.run_by(2, "out")
        frames = self.dir / "out/frames"
        part = frames / "fluid_000001.0001.hdf"
        good = part.read_bytes()
        same_size = [p for p in frames.glob("fluid_*.0001.hdf") if p != part and p.stat().st_size == len(good)]
        self.assertGreater(len(same_size), 0)
        for damage in (None, good[:-8], bytes(len(good)), same_size[0].read_bytes(),
                       (frames / "fluid_000001.0000.hdf").read_bytes()):
            part.unlink(missing_ok=True)
            if damage is not None:
                part.write_bytes(damage)
            for to in ("csv", "vtp", "vtkhdf"):
                done = self.call("convert", "out", "--to", to, "--force")
                self.assertEqual(done.returncode, 4, (to, done.stdout, done.stderr))
                self.assertIn("fluid_000001.0001.hdf", done.stderr)
        part.write_bytes(good)
        self.assertEqual(self.call("convert", "out", "--to", "csv", "--force").returncode, 0)

    def test_force_removes_parts_and_nothing_that_is_only_named_alike(self):
        self.run_by(3, "out", "--until", "0.03")
        self.assertGreater(len(self.parts("out")), 3)
        for mine in ("frames/foo_000012.0003.hdf", "frames/bodies_000001.0001.hdf", "fluid.0001.hdf", "walls.12345.hdf",
                     "checkpoint.000007.00003.h5", "frames/fluid_000012.00003.hdf", "frames/foo_000001.hdf"):
            (self.dir / "out" / mine).write_text("mine")
            for ranks in (1, 2):
                self.assertIn(mine, self.run_by(ranks, "out", "--force", code=2))
            (self.dir / "out" / mine).unlink()
        self.run_by(1, "out", "--force", "--until", "0.03")
        self.assertEqual(self.parts("out"), [])
        self.assertEqual(list((self.dir / "out").glob("checkpoint.0*")), [])

    def test_a_pipe_in_the_place_of_a_file_is_told(self):
        for ranks, name in ((1, "checkpoint.h5.tmp"), (2, "checkpoint.h5.tmp"), (2, "frames/fluid_000002.0001.hdf.tmp")):
            self.run_by(2, "out", "--force", "--until", "0.015")
            os.mkfifo(self.dir / "out" / name)
            self.assertIn(name, self.run_by(ranks, "out", "--resume", code=4))
            (self.dir / "out" / name).unlink()

    def test_parts_of_frames_that_were_not_finished_are_removed(self):
        self.run_by(1, "whole")
        self.run_by(3, "out", "--until", "0.05")
        frames = self.dir / "out/frames"
        # As a kill may leave them: parts of a next frame, from more processes than go on.
        last = max(frames.glob("fluid_*.0000.hdf")).name
        number = int(last[6:12])
        for k, part in ((number + 1, 0), (number + 1, 1), (number + 2, 7)):
            shutil.copy(frames / last, frames / f"fluid_{k:06}.{part:04}.hdf")
        self.run_by(2, "out", "--resume")
        self.expect_equal("whole", "out")
        self.assertEqual(list(frames.glob("*.0007.hdf")), [])

    def test_a_mistake_in_the_case_is_told_once(self):
        self.write(SHORT_DAM.replace("density = 400.0", "density = -400.0"))
        alone = self.run_by(1, "out", code=2)
        for ranks in (2, 3):
            message = self.run_by(ranks, "out", code=2)
            self.assertEqual(message.count(alone.splitlines()[0]), 1, message)
            self.assertEqual(message.count("body[0].density"), alone.count("body[0].density"), message)
        self.assertFalse((self.dir / "out").exists())

    def test_processes_that_were_started_differently_are_told(self):
        self.write(SHORT_DAM.replace("density = 300.0", "density = 310.0"), "other.toml")
        same = ["run", self.case, "-o", "out"]
        for what, other in (("case", ["run", "other.toml", "-o", "out"]),
                            ("case", [*same, "--set", "particles.spacing=0.021"]),
                            ("case", [*same, "--set", "time.end=0.05"]),
                            ("options", [*same, "--until", "0.03"]),
                            ("options", [*same, "--rebalance", "7"]),
                            ("options", ["run", self.case, "-o", "elsewhere"])):
            code, message = self.finish(subprocess.Popen(
                ["mpirun", "--oversubscribe", "-n", "2", self.program, *same, ":", "-n", "1", self.program, *other],
                cwd=self.dir, env=ENVIRONMENT, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                stderr=subprocess.PIPE, text=True))
            self.assertEqual(code, 2, (other, message))
            self.assertEqual(message.count("error: "), 1, (other, message))
            self.assertIn(f"the processes do not have the same {what}: ranks 0 and 2 differ", message)
            self.assertFalse((self.dir / "out").exists())

    def test_a_mistake_that_one_process_alone_meets_is_told_by_it(self):
        (self.dir / "broken.toml").write_text("title = \n")
        for case, told in (("missing.toml", "missing.toml"), ("broken.toml", "broken.toml:1")):
            code, message = self.finish(subprocess.Popen(
                ["mpirun", "--oversubscribe", "-n", "2", self.program, "run", self.case, "-o", "out", ":",
                 "-n", "1", self.program, "run", case, "-o", "out", ":",
                 "-n", "1", self.program, "run", self.case, "-o", "out"],
                cwd=self.dir, env=ENVIRONMENT, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                stderr=subprocess.PIPE, text=True))
            self.assertEqual(code, 2, message)
            self.assertEqual(message.count("error: "), 1, message)
            self.assertRegex(message, rf"rank 2 on \S+: .*{re.escape(told)}")
            self.assertFalse((self.dir / "out").exists())

    def test_memory_that_one_process_alone_lacks_ends_the_run(self):
        self.write(LONG_DAM.replace("spacing = 0.02", "spacing = 0.01"))
        for rank in (0, 2):
            process = self.start(3, "run", self.case, "-o", "out", "--force")
            self.wait_for(process, "frames/fluid_000000.hdf")
            pid = self.children(process)[rank]
            room = int(re.search(r"VmSize:\s+(\d+)", pathlib.Path(f"/proc/{pid}/status").read_text())[1]) * 1024
            resource.prlimit(pid, resource.RLIMIT_AS, (room, room))
            code, message = self.finish(process)
            self.assertEqual(code, 4, message)
            self.assertIn("memory", message)
            shutil.rmtree(self.dir / "out")

    def test_a_disk_that_is_full_for_some_processes_ends_the_run_with_one_message(self):
        """Their limit on the size of a file stands for the disk."""
        self.write(LONG_DAM.replace("spacing = 0.02", "spacing = 0.01"))
        for ranks in ((0,), (1,), (2,), (1, 2), (0, 1, 2)):
            process = self.start(3, "run", self.case, "-o", "out", "--force")
            self.wait_for(process, "checkpoint.previous.h5")
            for rank in ranks:
                resource.prlimit(self.children(process)[rank], resource.RLIMIT_FSIZE, (20000, 20000))
            code, message = self.finish(process)
            self.assertEqual(code, 4, message)
            self.assertEqual(message.count("error: "), 1, message)
            self.assertIn("File too large", message)
            self.run_by(2, "out", "--resume", "--set", f"time.end={self.time_of('out') + 0.004}")
            shutil.rmtree(self.dir / "out")

    def time_of(self, out):
        """The time of a checkpoint [s]: what a refusal says of it."""
        message = self.run_by(1, out, "--resume", "--set", "time.end=1e-9", code=2)
        return float(re.search(r"which is at (\S+) s", message)[1])

    def test_existing_results_are_told_once_and_stay(self):
        self.run_by(1, "out", "--until", "0.01")
        before = self.read("out", "energy.csv")
        alone = self.run_by(1, "out", code=2)
        message = self.run_by(2, "out", code=2)
        self.assertEqual(message.count(alone.splitlines()[0]), 1, message)
        self.assertEqual(self.read("out", "energy.csv"), before)

    def test_an_unstable_run_ends_with_one_message_and_its_last_good_state(self):
        told = re.compile("^error: the simulation became unstable: .*$", re.M)
        often = ("--set", "output.checkpoint_every=1000")  # by no clock
        long_step = ("--set", "time.cfl=3", *often)
        fast = ("--set", "fluid.block[0].velocity=[1e5,0,0]", "--set", "fluid.sound_speed=50", *often)
        for number, (text, settings) in enumerate(((DAM, long_step), (FLOOD, long_step), (FLOOD, fast))):
            self.write(text)
            one = f"one{number}"
            alone = told.findall(self.run_by(1, one, *settings, code=3))
            self.assertEqual(len(alone), 1)
            self.assertNotIn("nan", alone[0])
            for ranks in (2, 3):
                out = f"by{ranks}-{number}"
                message = self.run_by(ranks, out, *settings, "--parts", "1", code=3)
                self.assertEqual(told.findall(message), alone, message)
                self.expect_equal(one, out)
                self.assertEqual(self.read(one, "checkpoint.h5"), self.read(out, "checkpoint.h5"))
                self.assertIn("numerical error", (self.dir / out / "summary.json").read_text())

    def test_a_results_folder_that_cannot_be_written(self):
        self.write("", "file")
        message = self.run_by(3, "file/out", code=4)
        self.assertEqual(len(re.findall(r"error: ", message)), 1, message)

    def test_a_results_folder_that_is_taken_away(self):
        process = self.start(2, "run", self.write(LONG_DAM), "-o", "out")
        self.wait_for(process, "frames/fluid_000001.hdf")
        os.rename(self.dir / "out", self.dir / "elsewhere")
        code, message = self.finish(process)
        self.assertEqual(code, 4, message)
        self.assertIn("No such file", message)

    def test_the_loss_of_a_process_ends_the_run_and_resume_goes_on(self):
        self.run_by(1, "whole", "--set", "time.end=0.2")
        for lost in (0, 1, 2):
            process = self.start(3, "run", self.case, "-o", "out", "--force", "--set", "time.end=0.2")
            self.wait_for(process, "frames/fluid_000005.hdf")
            children = self.children(process)
            self.assertEqual(sorted(children), [0, 1, 2])
            os.kill(children[lost], signal.SIGKILL)
            begin = time.monotonic()
            code, message = self.finish(process)
            self.assertLess(time.monotonic() - begin, 20)
            self.assertEqual(code, 137, message)
            self.run_by(2, "out", "--resume", "--set", "time.end=0.2")
            self.expect_equal("whole", "out")
            (self.dir / "out/frames/fluid_000005.hdf").unlink()

    def test_processes_lost_at_any_moment_cost_what_came_after_the_last_checkpoint(self):
        """As often as HYORYU_KILLS says, with another number of processes and another loss each time."""
        dice = random.Random(int(os.environ.get("HYORYU_SEED", "1")))
        settings = ("--set", "time.end=0.2", "--set", "output.every=0.004", "--set", "output.checkpoint_every=0.004")
        begin = time.monotonic()
        self.run_by(1, "whole", *settings)
        alone = time.monotonic() - begin
        lost = 0
        for _ in range(int(os.environ.get("HYORYU_KILLS", "4"))):
            ranks = dice.randint(2, 4)
            resume = ("--resume",) if (self.dir / "out/checkpoint.h5").exists() else ("--force",)
            process = self.start(ranks, "run", self.case, "-o", "out", *resume, *settings)
            time.sleep(dice.uniform(0.5, 0.8 + alone))
            children = self.children(process)
            if len(children) == ranks:
                os.kill(children[dice.randrange(ranks)], signal.SIGKILL)
                lost += 1
            code, message = self.finish(process)
            self.assertIn(code, (0, 137), message)
        self.assertGreater(lost, 0, "every run had ended before it could lose a process")
        self.run_by(2, "out", "--resume", *settings)
        self.expect_equal("whole", "out")


class Module(RanksTest):
    def test_the_program_itself_needs_no_mpi(self):
        linked = subprocess.run(["ldd", HYORYU], capture_output=True, text=True, check=True, timeout=LONGEST).stdout
        self.assertIn("libc.so", linked)
        self.assertNotRegex(linked, "libmpi|libopen-rte|libpmix")
        linked = subprocess.run(["ldd", MODULE], capture_output=True, text=True, check=True, timeout=LONGEST).stdout
        self.assertIn("libmpi", linked)

    def test_without_the_module_several_processes_tell_once_where_it_is(self):
        self.program = shutil.copy(HYORYU, self.dir / "hyoryu")
        for ranks in (2, 3):
            for _ in range(5):
                begin = time.monotonic()
                message = self.run_by(ranks, "out", code=4)
                self.assertLess(time.monotonic() - begin, 10)
                self.assertEqual(message.count("error: "), 1, message)
                self.assertIn("hyoryu-mpi", message)
                self.assertIn("HYORYU_MPI=ON", message)
        self.assertFalse((self.dir / "out").exists())
        self.run_by(1, "out", "--until", "0.01")

    def test_a_module_of_another_kind_is_told(self):
        self.program = shutil.copy(HYORYU, self.dir / "hyoryu")
        self.write("no library", MODULE.name)
        message = self.run_by(2, "out", code=4)
        self.assertIn(f"cannot load {MODULE.name}", message)


if __name__ == "__main__":
    if shutil.which("mpirun") is None:
        raise SystemExit("mpirun is not in the path")
    main()
