#!/usr/bin/env python3
"""Ends runs in every unfriendly way and looks at what is left: nothing finished may be lost.

Usage: test_crash.py PATH_TO_HYORYU [NAME...]. HYORYU_KILLS sets the number of kills (default 20).
"""
import json
import os
import random
import shutil
import signal
import subprocess
import time

from program import DAM, HISTORIES, HYORYU, ProgramTest, main

KILLS = int(os.environ.get("HYORYU_KILLS", "20"))


class CrashTest(ProgramTest):
    def start(self, *arguments, **options):
        return subprocess.Popen(
            [HYORYU, "run", "case.toml", "-o", "out", "--threads", "1", *arguments],
            cwd=self.dir, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, **options)

    def run_whole(self, out, *arguments):
        done = self.call("run", "case.toml", "-o", out, "--threads", "1", *arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def wait_for(self, process, file):
        end = time.monotonic() + 60
        while not (self.dir / "out" / file).exists():
            self.assertLess(time.monotonic(), end, file)
            self.assertIsNone(process.poll(), "ended too early")
            time.sleep(0.005)

    def expect_equal(self, one, other):
        names = [f"frames/{p.name}" for p in sorted((self.dir / one / "frames").iterdir())]
        self.assertEqual(names, [f"frames/{p.name}"
                                 for p in sorted((self.dir / other / "frames").iterdir())])
        self.assertTrue([name for name in names if "structures" in name])  # the paddle moves
        series = [p.name for p in sorted((self.dir / one).glob("*.hdf.series"))]
        for name in [*HISTORIES, *series, *names]:
            self.assertEqual(self.read(one, name), self.read(other, name), name)


class Kills(CrashTest):
    def expect_nothing_lost(self):
        """What stands in `out` is a part of the uninterrupted run in `whole`."""
        out, whole = self.dir / "out", self.dir / "whole"
        for frame in out.glob("frames/*.hdf"):
            self.assertEqual(frame.read_bytes(), (whole / "frames" / frame.name).read_bytes(), frame)
        for series in out.glob("*.hdf.series"):
            for entry in json.loads(series.read_text())["files"]:
                self.assertTrue((out / entry["name"]).exists(), entry)
        for name in HISTORIES:
            if (out / name).exists():
                self.assertTrue(self.read("whole", name).startswith(self.read("out", name)), name)

    def test_a_kill_at_any_moment_loses_nothing_and_the_run_goes_on(self):
        self.write(DAM)
        begin = time.monotonic()
        self.run_whole("whole")
        duration = time.monotonic() - begin
        dice = random.Random(7)
        landed = 0
        for _ in range(KILLS):
            resuming = (self.dir / "out" / "checkpoint.h5").exists()
            process = self.start("--resume" if resuming else "--force")
            try:
                process.wait(dice.uniform(0, 0.7 * duration))
            except subprocess.TimeoutExpired:
                process.kill()
            message = process.communicate()[1]
            landed += process.returncode == -signal.SIGKILL
            self.assertIn(process.returncode, (0, -signal.SIGKILL), message)
            self.assertNotIn("damaged", message)
            if not (self.dir / "out").exists():
                continue
            self.expect_nothing_lost()
            if process.returncode == 0 or dice.random() < 0.3:
                if (self.dir / "out" / "checkpoint.h5").exists():
                    self.run_whole("out", "--resume")
                    self.expect_equal("whole", "out")
                self.call("run", "case.toml", "-o", "out", "--force", "--until", "0.001")
        self.assertGreater(landed, KILLS // 2)
        self.run_whole("out", "--resume")
        self.expect_equal("whole", "out")
        self.assertEqual(list((self.dir / "out").rglob("*.tmp")), [])

    def test_a_damaged_checkpoint_gives_way_to_the_one_before(self):
        self.write(DAM)
        self.run_whole("whole")
        self.run_whole("out", "--until", "0.2")
        newest = self.dir / "out" / "checkpoint.h5"
        good = newest.read_bytes()
        dice = random.Random(3)
        for number in range(4):
            place = dice.randrange(len(good))
            bad = good[:place] if number % 2 else \
                good[:place] + bytes([good[place] ^ 0x10]) + good[place + 1:]
            newest.write_bytes(bad)
            done = self.call("run", "case.toml", "-o", "out", "--resume", "--until", "0.2")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertRegex(done.stderr, "(damaged|not a checkpoint).*the previous")
            newest.write_bytes(good)
        newest.write_bytes(b"torn")
        self.run_whole("out", "--resume")
        self.expect_equal("whole", "out")
        for name in ("checkpoint.h5", "checkpoint.previous.h5"):
            (self.dir / "out" / name).write_bytes(b"torn")
        done = self.call("run", "case.toml", "-o", "out", "--resume")
        self.assertEqual(done.returncode, 4)
        self.assertIn("error of the older checkpoint", done.stderr)


class Ends(CrashTest):
    def setUp(self):
        super().setUp()
        self.write(DAM.replace("end = 0.4", "end = 60.0"))

    def test_signals_are_requests_to_stop(self):
        for number in (signal.SIGTERM, signal.SIGHUP, signal.SIGINT):
            process = self.start("--force")
            self.wait_for(process, "frames/fluid_000003.hdf")
            process.send_signal(number)
            message = process.communicate(timeout=60)[1]
            self.assertEqual(process.returncode, 130, message)
            self.assertIn("--resume", message)
            self.assertEqual(self.call("run", "case.toml", "-o", "out", "--resume", "--until",
                                       "0.01").returncode, 0)
            (self.dir / "out" / "frames" / "fluid_000003.hdf").unlink()

    def test_a_terminal_that_is_gone_does_not_end_a_run(self):
        read_end, write_end = os.pipe()
        os.close(read_end)
        with open("/dev/full", "w") as full, os.fdopen(write_end, "w") as broken:
            for stream in (full, broken):
                done = subprocess.run([HYORYU, "run", "case.toml", "-o", "out",
                                       "--force", "--until", "0.02"], cwd=self.dir, stderr=stream)
                self.assertEqual(done.returncode, 0)
            done = subprocess.run([HYORYU, "run", "nowhere.toml"], cwd=self.dir,
                                  stderr=full)
            self.assertEqual(done.returncode, 2)
            done = subprocess.run([HYORYU, "describe"], stdout=full,
                                  stderr=subprocess.PIPE, text=True)
            self.assertEqual(done.returncode, 4)
            self.assertIn("No space left", done.stderr)

    def test_two_runs_on_one_folder(self):
        process = self.start()
        self.wait_for(process, "frames/fluid_000001.hdf")
        for argument in ((), ("--force",)):
            done = self.call("run", "case.toml", "-o", "out", *argument)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn("another run is writing", done.stderr)
        self.wait_for(process, "checkpoint.h5")
        done = self.call("run", "case.toml", "-o", "out", "--resume")
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("another run is writing", done.stderr)
        process.kill()
        process.communicate()
        done = self.call("run", "case.toml", "-o", "out", "--resume", "--until", "0.01")
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_e2_what_is_no_file_of_a_run_ends_a_resumption_and_not_the_program(self):
        """A pipe as the log would be waited for, a frame of another name has no number."""
        self.call("run", "case.toml", "-o", "out", "--until", "0.01")
        out = self.dir / "out"
        whole = {name: (out / name).read_bytes() for name in ("run.log", "fluid.hdf.series")}
        (out / "run.log").unlink()
        os.mkfifo(out / "run.log")
        resume = ("run", "case.toml", "-o", "out", "--resume", "--until", "0.011")
        done = self.call(*resume)
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertIn("run.log", done.stderr)
        (out / "run.log").unlink()
        (out / "run.log").write_bytes(whole["run.log"])
        frame = "frames/fluid_000000.hdf"
        for names, told in ((["../../secret"], "secret"), ([frame, frame], "twice"), ([7], "expected JSON")):
            files = [{"name": name, "time": 0} for name in names]
            (out / "fluid.hdf.series").write_text(json.dumps({"files": files}))
            for command in (resume, ("report", "out", "-o", "page.html"), ("info", "out")):
                done = self.call(*command)
                self.assertEqual(done.returncode, 4, (names, command, done.stderr))
                self.assertIn(told, done.stderr)
        (out / "fluid.hdf.series").write_bytes(whole["fluid.hdf.series"])
        self.assertEqual(self.call(*resume).returncode, 0)

    def test_a_resumption_tells_of_frames_that_somebody_removed(self):
        self.call("run", "case.toml", "-o", "out", "--until", "0.01")
        for name in ("frames/fluid_000000.hdf", "frames/bodies_000000.hdf"):
            (self.dir / "out" / name).unlink()
        done = self.call("run", "case.toml", "-o", "out", "--resume", "--until", "0.011")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("frames of the earlier run are missing, 2 in all, first `frames/bodies_000000.hdf`",
                      done.stderr)

    def test_a_results_folder_that_is_taken_away(self):
        process = self.start()
        self.wait_for(process, "frames/fluid_000001.hdf")
        os.rename(self.dir / "out", self.dir / "elsewhere")
        message = process.communicate(timeout=60)[1]
        self.assertEqual(process.returncode, 4, message)
        self.assertIn("No such file", message)
        self.assertNotEqual(list((self.dir / "elsewhere" / "frames").glob("fluid_000001.hdf")), [])

    def test_a_results_folder_that_may_not_be_written(self):
        out = self.dir / "out"
        out.mkdir(mode=0o555)
        nobody = {"user": 65534} if os.geteuid() == 0 else {}  # root may write anywhere
        self.dir.chmod(0o755)
        # the build may lie where nobody but root can reach it
        self.program = shutil.copy(HYORYU, self.dir / "hyoryu")
        done = self.call("run", "case.toml", "-o", "out", **nobody)
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertIn("Permission denied", done.stderr)
        done = self.call("run", "case.toml", "-o", "out/below", **nobody)
        self.assertEqual(done.returncode, 4, done.stderr)
        out.chmod(0o000)
        done = self.call("run", "case.toml", "-o", "out/below", **nobody)
        self.assertEqual(done.returncode, 4, done.stderr)
        out.chmod(0o755)
        self.assertEqual(list(out.iterdir()), [])


if __name__ == "__main__":
    main()
