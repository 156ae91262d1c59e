#!/usr/bin/env python3
"""Studies: a case over values of its keys."""
import json
import pathlib
import signal
import subprocess
import time
import xml.etree.ElementTree

from program import FLOOD, HYORYU, ProgramTest, main


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

    def test_e12_a_page_names_its_case_and_says_which_run_is_the_finest_of_which(self):
        text = self.STUDY.replace("brick.toml", "case.toml").replace(
            'expected = "1/(2*0.5*9.81)"', 'against = "finest"') + """
[[sweep]]
name = "law"
[sweep.choices]
coupled = []
paper = ["contact.law=paper"]
"""
        folder = self.dir / "sliding"
        folder.mkdir()
        (folder / "case.toml").write_text(self.CASE)
        (folder / "slide.toml").write_text(text)
        done = subprocess.run([HYORYU, "study", "slide.toml"], cwd=folder, capture_output=True, text=True,
                              timeout=300)
        self.assertEqual(done.returncode, 0, done.stderr)
        page = (folder / "slide-results/study.md").read_text()
        self.assertIn("Case sliding.", page)
        notes = {row[0] + "," + row[1]: row[-1] for row in
                 ([cell.strip() for cell in line.strip("|").split("|")]
                  for line in page.split("## way")[1].splitlines() if line.startswith("| "))}
        self.assertEqual(sum("the finest run" in note for note in notes.values()), 1, notes)
        self.assertGreater(sum("no finer run" in note for note in notes.values()), 0, notes)

    def test_e12_no_blank_pictures(self):
        """Settings of text alone, held against the finest: there is none, no error and so no picture."""
        text = self.STUDY[:self.STUDY.index("[[sweep]]")] + """
[[sweep]]
name = "law"
[sweep.choices]
coupled = []
paper = ["contact.law=paper"]
""" + self.STUDY[self.STUDY.index("[[quantity]]"):].replace('expected = "1/(2*0.5*9.81)"', 'against = "finest"')
        done = self.study(text=text)
        if done.returncode == 0:
            self.assertEqual(list((self.dir / "slide-results").glob("*.svg")), [])
            self.assertIn("no run has an error above zero", done.stdout + done.stderr)
            self.assertNotIn("the finest run", (self.dir / "slide-results/study.md").read_text())
        else:
            self.assertEqual(done.returncode, 2)
            self.assertIn("finest", done.stderr)

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
        picture = xml.etree.ElementTree.fromstring(self.read("slide-results", "study_way.svg"))
        self.assertEqual(picture.tag.rpartition("}")[2], "svg")
        self.assertIn(b"![study_way.svg](study_way.svg)", self.read("slide-results", "study.md"))
        self.assertIn(self.read("slide-results", "study_way.svg"), self.read("slide-results", "study.html"))
        self.assertIn("| quantity |", self.read("slide-results", "study.md").decode())

    def test_what_is_done_is_not_run_again_and_gives_the_same_table(self):
        self.assertEqual(self.study().returncode, 0)
        table = self.rows()
        summary = self.dir / "slide-results" / "runs" / "step=0.01" / "summary.json"
        first = summary.stat().st_mtime_ns
        done = self.study()
        self.assertEqual(done.stdout.count("already done"), 3, done.stdout)
        self.assertEqual(self.rows(), table)
        self.assertEqual(summary.stat().st_mtime_ns, first)
        self.assertNotIn("already done", self.study("--force").stdout)
        self.assertEqual(self.rows(), table)

    def test_a_run_cut_short_and_a_changed_case_are_run_again(self):
        self.assertEqual(self.study().returncode, 0)
        table = self.rows()
        runs = self.dir / "slide-results" / "runs"
        (runs / "step=0.01" / "summary.json").unlink()
        self.assertEqual(self.study().stdout.count("already done"), 2)
        self.assertEqual(self.rows(), table)
        other = self.STUDY.replace("[[sweep]]", 'set = ["contact.friction=0.4"]\n[[sweep]]', 1)
        self.assertNotIn("already done", self.study(text=other).stdout)
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
        self.assertIn("already done", done.stdout)
        self.assertEqual(self.rows("parts"), self.rows("whole"))

    def children_of(self, process):
        listed = subprocess.run(["ps", "--ppid", str(process.pid), "-o", "pid="],
                                capture_output=True, text=True).stdout
        return [int(pid) for pid in listed.split()]

    def is_running(self, pid):
        try:
            state = pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0]
        except FileNotFoundError:
            return False
        return state != "Z"

    def test_e10_a_signal_to_a_study_alone_leaves_no_run_behind(self):
        # E10. A flood takes long enough to be in the midst of a run.
        self.write(FLOOD.replace("spacing = 0.05", "spacing = 0.03"), "flood.toml")
        text = self.STUDY.replace("brick", "flood").replace("time.step", "fluid.sound_speed")
        text = text.replace("[0.02, 0.01, 0.005]", "[30, 40]").replace("1/(2*0.5*9.81)", "0.8")
        self.write(text, "slide.toml")
        for number, code in ((signal.SIGTERM, 130), (signal.SIGUSR1, 130), (signal.SIGKILL, -9)):
            process = subprocess.Popen([HYORYU, "study", "slide.toml", "-o", "out", "--jobs", "2"],
                                       cwd=self.dir, stdout=subprocess.DEVNULL)
            while not (self.dir / "out/runs/sound_speed=40/frames/fluid_000000.hdf").exists():
                self.assertIsNone(process.poll(), "ended before it was asked to")
                time.sleep(0.01)
            children = self.children_of(process)
            self.assertEqual(len(children), 2)
            process.send_signal(number)
            self.assertEqual(process.wait(60), code)
            for _ in range(200):
                if not any(self.is_running(pid) for pid in children):
                    break
                time.sleep(0.01)
            self.assertEqual([pid for pid in children if self.is_running(pid)], [], number)
            (self.dir / "out/runs/sound_speed=40/frames/fluid_000000.hdf").unlink()

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

    def test_e1_no_file_of_the_users_is_lost(self):
        # E1: folders named as those of a study, and a file named as its page, but not made by one.
        self.write("my own notes", "study.md")
        done = self.study("-o", ".")
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
        self.assertIn("study.md", done.stderr)
        self.assertEqual(self.files(), ["brick.toml", "slide.toml", "study.md"])
        for place in ("runs/thesis", "repeats/thesis", "runs/step=0.01"):
            folder = self.dir / place.replace("/", "-") / place
            folder.mkdir(parents=True)
            (folder / "thesis.tex").write_text("mine")
            for force in ((), ("--force",)):
                done = self.study("-o", place.replace("/", "-"), *force)
                self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
                self.assertEqual((folder / "thesis.tex").read_text(), "mine")
        # In a study's own folder, too: what it did not make stays, whatever --force says.
        self.assertEqual(self.study().returncode, 0)
        runs = self.dir / "slide-results" / "runs"
        for place in ("mine", "step=0.01"):
            (runs / place).mkdir(exist_ok=True)
            (runs / place / "thesis.tex").write_text("mine")
        done = self.study("--force")
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
        self.assertIn("thesis.tex", done.stderr)
        (runs / "step=0.01" / "thesis.tex").unlink()
        self.assertEqual(self.study("--force").returncode, 0)
        self.assertEqual((runs / "mine" / "thesis.tex").read_text(), "mine")

    def test_repeats_of_a_changed_case_replace_those_before(self):
        text = self.STUDY.replace("[[sweep]]", "repeats = 2\n[[sweep]]", 1)
        self.assertEqual(self.study(text=text).returncode, 0)
        changed = text.replace("[[sweep]]", 'set = ["contact.friction=0.4"]\n[[sweep]]', 1)
        done = self.study(text=changed)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertNotIn("already done", done.stdout)

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
    main()
