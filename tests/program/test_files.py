#!/usr/bin/env python3
"""Commands that write or describe files: new, convert, info --json, completions and manual pages."""
import base64
import csv
import json
import os
import random
import re
import shutil
import struct
import subprocess
import unittest
import xml.etree.ElementTree as ElementTree

from program import CASES, DOCS, FLOOD, ProgramTest, main

TANK_3D = """
[time]
end = 1.0
[particles]
spacing = 0.1
[fluid]
[[fluid.block]]
shape = "box"
min = [0.0, 0.0, 0.0]
max = [0.5, 0.5, 0.3]
[[wall]]
shape = "basin"
min = [0.0, 0.0, 0.0]
max = [0.5, 0.5, 0.5]
open = ["+z"]
"""
TEMPLATES = ["bore_with_debris", "contact_alone", "dam_break", "floating_body",
             "street_with_buildings", "tank"]
COMMANDS = ["run", "check", "describe", "new", "info", "render", "report", "convert", "verify",
            "study", "bench", "completions", "man"]


class New(ProgramTest):
    def test_e14_every_template_is_checked_run_and_reported(self):
        for name in TEMPLATES:
            done = self.call("new", name)
            self.assertEqual(done.returncode, 0, done.stderr)
            case = f"{name}.toml"
            done = self.call("check", case)
            self.assertEqual((done.returncode, done.stderr), (0, ""), name)
            done = self.call("run", case, "--until", "0.05", "--quiet")
            self.assertEqual((done.returncode, done.stderr), (0, ""), name)
            self.assertEqual(self.call("report", f"{name}-results").returncode, 0, name)

    def test_every_template_explains_itself(self):
        for name in TEMPLATES:
            self.call("new", name)
            lines = (self.dir / f"{name}.toml").read_text().splitlines()
            self.assertTrue(lines[0].startswith("# "), name)
            keys = [line for line in lines if re.match(r"\w+ =", line)]
            comments = [line for line in lines if "#" in line]
            self.assertGreater(len(comments), len(keys) / 3, name)
            self.assertLess(max(map(len, lines)), 110, name)

    def test_the_help_lists_every_template(self):
        text = self.call("new", "--help").stdout
        self.assertEqual(sorted(re.findall(r"^  (\w+)  ", text.split("Templates:")[1], re.M)), TEMPLATES)

    def test_names_are_spelled_as_people_do(self):
        for spelling in ("dam-break", "Dam Break", "DAMBREAK", "dam_break"):
            done = self.call("new", spelling, f"{len(spelling)}{spelling[3]}.toml")
            self.assertEqual(done.returncode, 0, done.stderr)
        done = self.call("new", "dam_brake")
        self.assertEqual(done.returncode, 2)
        self.assertIn('did you mean "dam_break"?', done.stderr)
        done = self.call("new", "volcano")
        self.assertEqual(done.returncode, 2)
        for name in TEMPLATES:
            self.assertIn(name, done.stderr)

    def test_a_folder_gets_a_case(self):
        self.assertEqual(self.call("new", "tank", "one/two").returncode, 0)
        self.assertTrue((self.dir / "one/two/case.toml").exists())
        (self.dir / "there.toml").mkdir()
        self.assertEqual(self.call("new", "tank", "there.toml").returncode, 0)
        self.assertTrue((self.dir / "there.toml/case.toml").exists())

    def test_e1_nothing_is_overwritten(self):
        self.write("mine", "tank.toml")
        (self.dir / "folder").mkdir()
        self.write("mine", "folder/case.toml")
        os.symlink("nowhere", self.dir / "link.toml")
        self.write("a file", "file")
        for target in ([], ["folder"], ["link.toml"], ["file"], ["file/case.toml"]):
            done = self.call("new", "tank", *target)
            self.assertEqual(done.returncode, 2, (target, done.stderr))
        self.assertEqual(self.files(), ["file", "folder", "link.toml", "tank.toml"])
        self.assertEqual((self.dir / "tank.toml").read_text(), "mine")
        self.assertEqual((self.dir / "folder/case.toml").read_text(), "mine")
        self.assertFalse((self.dir / "nowhere").exists())


class Results(ProgramTest):
    """A small run, made once."""
    made = None

    @classmethod
    def setUpClass(cls):
        first = ProgramTest()
        first.setUp()
        cls.made = first
        done = first.call("run", first.write(FLOOD), "-o", "out", "--until", "0.2", "--quiet")
        assert done.returncode == 0, done.stderr

    @classmethod
    def tearDownClass(cls):
        cls.made.tearDown()

    def setUp(self):
        super().setUp()
        shutil.copytree(self.made.dir / "out", self.dir / "out")

    def tree(self, folder="out"):
        return {str(p.relative_to(self.dir)): p.read_bytes()
                for p in (self.dir / folder).rglob("*") if p.is_file()}


def array(xml, name):
    """Numbers of the inline array of that name."""
    formats = {"Float32": "f", "Float64": "d", "Int32": "i", "Int64": "q", "UInt8": "B"}
    node = next(node for node in xml.iter("DataArray") if node.get("Name") == name)
    data = base64.b64decode(node.text.strip())
    size, = struct.unpack_from("<Q", data)
    assert size == len(data) - 8
    letter = formats[node.get("type")]
    return list(struct.unpack(f"<{size // struct.calcsize(letter)}{letter}", data[8:]))


class Pages(Results):
    """Files that a command writes where it is told to: its own are replaced, those of the user stay."""

    def test_e1_only_own_files_are_replaced(self):
        self.write(TANK_3D, "case3.toml")
        own = [("report", "out", "-o", "page.html"), ("check", "case3.toml", "--plan", "plan.png")]
        for command in own:
            for _ in range(2):
                done = self.call(*command)
                self.assertEqual(done.returncode, 0, done.stderr)
        os.mkfifo(self.dir / "pipe")
        os.symlink("page.html", self.dir / "link")
        (self.dir / "empty").write_text("")
        before = self.tree(".")
        wrong = ["case3.toml", "out/plan.json", "pipe", "link", "out"]
        for command in own:
            for name in [*wrong, "plan.png" if command[0] == "report" else "page.html"]:
                done = self.call(*command[:-1], name)
                self.assertEqual(done.returncode, 2, (command, name, done.stderr))
                self.assertIn("exists and", done.stderr)
        self.assertEqual(self.tree("."), before)
        self.assertTrue((self.dir / "pipe").is_fifo() and (self.dir / "link").is_symlink())
        self.assertEqual(self.call("report", "out", "-o", "empty").returncode, 0)

    def test_e1_verify_tells_of_a_foreign_file_before_it_runs(self):
        self.write("mine", "mine.json")
        done = self.call("verify", "couette", "--cases", str(CASES), "--json", "mine.json")
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("was not written by `hyoryu verify --json`", done.stderr)
        self.assertEqual((self.dir / "mine.json").read_text(), "mine")
        self.assertFalse((self.dir / "verify-results").exists())


class Convert(Results):
    def test_e14_vtp_and_csv_agree_with_each_other(self):
        before = self.tree()
        for form in ("vtp", "csv"):
            done = self.call("convert", "out", "--to", form)
            self.assertEqual(done.returncode, 0, done.stderr)
        frames = len(list((self.dir / "out/frames").glob("fluid_*.hdf")))
        self.assertEqual(len(list((self.dir / "out/vtp").glob("fluid_*.vtp"))), frames)
        times = [float(node.get("timestep")) for node in
                 ElementTree.parse(self.dir / "out/vtp/fluid.pvd").iter("DataSet")]
        series = json.loads(self.read("out", "fluid.hdf.series"))
        self.assertEqual(times, [entry["time"] for entry in series["files"]])
        for name, number in (("fluid", 0), ("fluid", frames - 1), ("bodies", 1), ("walls", 0)):
            xml = ElementTree.parse(self.dir / f"out/vtp/{name}_{number:06}.vtp")
            lines = (self.dir / f"out/csv/{name}_{number:06}.csv").read_text().splitlines()
            rows = list(csv.DictReader(lines[2:]))
            points = array(xml, "Points")
            velocity = array(xml, "Velocity")
            ids = array(xml, "Id")
            self.assertEqual(len(rows), len(points) // 3)
            for k, row in enumerate(rows):
                single = lambda text: struct.unpack("f", struct.pack("f", float(text)))[0]
                self.assertEqual([single(row[c]) for c in "xyz"], points[3 * k:3 * k + 3])
                self.assertEqual(single(row["Velocity_z"]), velocity[3 * k + 2])
                self.assertEqual(int(row["Id"]), ids[k])
        for path, content in before.items():
            self.assertEqual((self.dir / path).read_bytes(), content, path)

    def test_one_file_with_time(self):
        done = self.call("convert", "out", "--to", "vtkhdf")
        self.assertEqual(done.returncode, 0, done.stderr)
        frames = len(list((self.dir / "out/frames").glob("fluid_*.hdf")))
        self.assertIn(f"{frames} time steps: out/all.vtkhdf", done.stdout)
        content = self.read("out", "all.vtkhdf")
        self.assertLess(len(content), 100_000)  # it refers to frames, of 1.8 MB
        self.assertIn(b"frames/fluid_000001.hdf", content)
        self.assertNotIn(str(self.dir).encode(), content)  # the folder may be moved
        done = self.call("convert", "out", "--to", "vtkhdf", "-o", "elsewhere.vtkhdf")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(b"out/frames/fluid_000001.hdf", (self.dir / "elsewhere.vtkhdf").read_bytes())

    def test_a_choice_of_frames(self):
        done = self.call("convert", "out", "--to", "vtp", "--only", "surfaces,fluid",
                         "--times", "0.09,0.11,0", "-o", "some")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(sorted(p.name for p in (self.dir / "some").glob("*.*")),
                         [".hyoryu-convert", "fluid.pvd", "fluid_000000.vtp", "fluid_000002.vtp",
                          "surfaces.pvd", "surfaces_000000.vtp", "surfaces_000002.vtp"])
        for arguments, expected in ((("--only", "surface"), 'did you mean "surfaces"?'),
                                    (("--only", ""), "known: "),
                                    (("--times", "nan"), "finite")):
            done = self.call("convert", "out", "--to", "vtp", *arguments)
            self.assertEqual(done.returncode, 2, arguments)
            self.assertIn(expected, done.stderr)
        done = self.call("convert", "out", "--to", "csv", "--only", "surfaces")
        self.assertEqual(done.returncode, 2)
        self.assertIn("--to vtp", done.stderr)

    def test_mistakes_are_the_users_and_change_nothing(self):
        before = self.tree()
        (self.dir / "empty").mkdir()
        for arguments, expected in ((("out",), "--to is required"),
                                    (("out", "--to", "vtu"), 'did you mean "vtp"?'),
                                    (("out", "--to", "xyz"), '"vtp", "csv", "vtkhdf"'),
                                    (("empty", "--to", "vtp"), "no plan.json"),
                                    (("none", "--to", "vtp"), "does not exist")):
            done = self.call("convert", *arguments)
            self.assertEqual(done.returncode, 2, arguments)
            self.assertIn(expected, done.stderr)
        self.assertEqual(self.tree(), before)

    def test_e1_force_replaces_nothing_but_conversions(self):
        self.assertEqual(self.call("convert", "out", "--to", "vtp").returncode, 0)
        mine = self.dir / "out/vtp/notes.txt"
        mine.write_text("mine")
        extra = self.dir / "out/vtp/fluid_000099.vtp"  # of a longer run, converted before
        extra.write_text("old")
        done = self.call("convert", "out", "--to", "vtp")
        self.assertEqual(done.returncode, 2)
        self.assertIn("--force replaces it", done.stderr)
        self.assertEqual(self.call("convert", "out", "--to", "vtp", "--force").returncode, 0)
        self.assertEqual(mine.read_text(), "mine")
        self.assertFalse(extra.exists())

    def test_e1_files_that_no_conversion_wrote_stay(self):
        (self.dir / "mine").mkdir()
        self.write("mine", "mine/fluid_000001.vtp")
        self.write("mine", "mine.vtkhdf")
        os.symlink("nowhere", self.dir / "link.vtkhdf")
        for arguments in (("--to", "vtp", "-o", "mine"), ("--to", "vtkhdf", "-o", "mine.vtkhdf"),
                          ("--to", "vtkhdf", "-o", "link.vtkhdf"), ("--to", "vtp", "-o", "mine.vtkhdf"),
                          ("--to", "vtkhdf", "-o", "mine")):
            for force in ([], ["--force"]):
                done = self.call("convert", "out", *arguments, *force)
                self.assertEqual(done.returncode, 2, (arguments, done.stderr))
        self.assertEqual((self.dir / "mine/fluid_000001.vtp").read_text(), "mine")
        self.assertEqual((self.dir / "mine.vtkhdf").read_text(), "mine")
        self.assertEqual(sorted(p.name for p in (self.dir / "mine").iterdir()), ["fluid_000001.vtp"])

    def test_a_run_may_replace_results_that_were_converted(self):
        for form in ("vtp", "csv", "vtkhdf"):
            self.assertEqual(self.call("convert", "out", "--to", form).returncode, 0)
        done = self.call("run", self.write(FLOOD), "-o", "out", "--until", "0.01", "--force", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertFalse((self.dir / "out/vtp").exists())
        self.assertFalse((self.dir / "out/all.vtkhdf").exists())

    def test_a_run_may_replace_what_a_killed_one_left_behind(self):
        """Where a file system has no files without names, the state to return to had one for a moment."""
        left = self.dir / "out/.hyoryu-kept-aB3xY9"
        mine = self.dir / "out/.hyoryu-kept-list"
        left.write_text("")
        mine.write_text("mine")
        case = self.write(FLOOD)
        done = self.call("run", case, "-o", "out", "--until", "0.01", "--force", "--quiet")
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn(mine.name, done.stderr)
        self.assertNotIn(left.name, done.stderr)
        mine.unlink()
        done = self.call("run", case, "-o", "out", "--until", "0.01", "--force", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertFalse(left.exists())

    def test_damaged_frames_are_told_and_those_before_stay(self):
        frame = self.dir / "out/frames/fluid_000002.hdf"
        frame.write_bytes(frame.read_bytes()[:1000])
        for form in ("vtp", "csv"):
            done = self.call("convert", "out", "--to", form)
            self.assertEqual(done.returncode, 4, done.stderr)
            self.assertIn("fluid_000002.hdf", done.stderr)
            self.assertEqual(sorted(p.name for p in (self.dir / "out" / form).glob("fluid*")),
                             [f"fluid_000000.{form}", f"fluid_000001.{form}"])
        self.assertEqual(self.call("convert", "out", "--to", "vtkhdf").returncode, 4)
        self.assertFalse((self.dir / "out/all.vtkhdf").exists())

    def test_mutated_results_end_with_a_message(self):
        """Bytes of the files that convert and info read, changed at random."""
        dice = random.Random(4)
        names = ["fluid.hdf.series", "plan.json", "summary.json", "walls.hdf",
                 "frames/fluid_000001.hdf", "frames/surfaces_000001.hdf"]
        whole = {name: self.read("out", name) for name in names}
        for _ in range(60):
            name = dice.choice(names)
            content = bytearray(whole[name])
            for _ in range(dice.randint(1, 6)):
                content[dice.randrange(len(content))] = dice.randrange(256)
            if dice.random() < 0.2:
                del content[dice.randrange(len(content)):]
            (self.dir / "out" / name).write_bytes(content)
            for arguments in (("convert", "out", "--force", "--to", dice.choice(["vtp", "csv", "vtkhdf"])),
                              ("info", "out", "--json")):
                done = subprocess.run([self.program, *arguments], cwd=self.dir, capture_output=True,
                                      timeout=60)
                self.assertIn(done.returncode, (0, 2, 4), (name, arguments, done.stderr))
            (self.dir / "out" / name).write_bytes(whole[name])


def offences(value, schema, path="$"):
    """What of a JSON Schema (types, properties, required, items, enum) a value breaks."""
    types = {"object": dict, "array": list, "string": str, "boolean": bool, "null": type(None),
             "integer": int, "number": (int, float)}
    wanted = schema.get("type", [])
    wanted = [wanted] if isinstance(wanted, str) else wanted
    if wanted and not any(isinstance(value, types[t]) and not (isinstance(value, bool) and t != "boolean")
                          for t in wanted):
        yield f"{path}: {value!r} is none of {wanted}"
    if "enum" in schema and value not in schema["enum"]:
        yield f"{path}: {value!r} is none of {schema['enum']}"
    if isinstance(value, dict):
        properties = schema.get("properties", {})
        for key in schema.get("required", []):
            if key not in value:
                yield f"{path}: no {key}"
        for key, part in value.items():
            if key not in properties:
                yield f"{path}: {key} is not described"
            else:
                yield from offences(part, properties[key], f"{path}.{key}")
    if isinstance(value, list):
        for k, part in enumerate(value):
            yield from offences(part, schema.get("items", {}), f"{path}[{k}]")


class Info(Results):
    schema = json.loads((DOCS / "info.schema.json").read_text())

    def info(self):
        done = self.call("info", "out", "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)

    def test_it_is_as_the_schema_says(self):
        self.assertEqual(list(offences(self.info(), self.schema)), [])
        (self.dir / "out/summary.json").unlink()  # as long as the run goes on
        (self.dir / "out/walls.hdf").unlink()
        info = self.info()
        self.assertEqual(list(offences(info, self.schema)), [])
        self.assertIsNone(info["run"])

    def test_numbers_are_those_of_the_run(self):
        info = self.info()
        plan = json.loads(self.read("out", "plan.json"))
        summary = json.loads(self.read("out", "summary.json"))
        self.assertEqual(info["title"], "small flood")
        self.assertEqual(info["counts"]["fluid"], plan["counts"]["fluid"])
        for key in ("steps", "exit_reason", "simulated_seconds", "particles_lost"):
            self.assertEqual(info["run"][key], summary[key])
        fluid = next(one for one in info["frames"] if one["name"] == "fluid")
        self.assertEqual(fluid["frames"], len(list((self.dir / "out/frames").glob("fluid_*"))))
        self.assertEqual(fluid["first_time"], 0)
        self.assertTrue(info["checkpoint"])
        self.assertEqual(info["histories"], ["bodies.csv", "contacts.csv", "energy.csv"])

    def test_values_of_another_type_are_damage(self):
        for name, change in (("plan.json", {"title": 7}), ("plan.json", {"counts": []}),
                             ("plan.json", {"counts": {"fluid": "many"}}), ("summary.json", {"steps": 1.5}),
                             ("summary.json", {"exit_reason": None})):
            before = self.read("out", name)
            (self.dir / "out" / name).write_text(json.dumps({**json.loads(before), **change}))
            for arguments in ([], ["--json"]):
                done = self.call("info", "out", *arguments)
                self.assertEqual(done.returncode, 4, (change, done.stderr))
                self.assertIn("is damaged", done.stderr)
            (self.dir / "out" / name).write_bytes(before)


class Completions(ProgramTest):
    def script(self, shell):
        done = self.call("completions", shell)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        (self.dir / f"hyoryu.{shell}").write_text(done.stdout)
        return f"hyoryu.{shell}"

    def completed(self, *words):
        """What bash offers for the last word, as it would split the line at `=`."""
        split = [part for word in words for part in re.split("(=)", word) if part or word == ""]
        line = " ".join(map(json.dumps, split))
        code = (f"source {self.script('bash')}; COMP_WORDS=({line}); COMP_CWORD={len(split) - 1}; "
                "_hyoryu; printf '%s\\n' \"${COMPREPLY[@]}\"")
        done = subprocess.run(["bash", "-c", code], cwd=self.dir, capture_output=True, text=True, timeout=60)
        self.assertEqual((done.returncode, done.stderr), (0, ""), words)
        return sorted(filter(None, done.stdout.splitlines()))

    def test_e14_bash_completes_real_command_lines(self):
        self.write(FLOOD, "flood.toml")
        self.write("", "notes.txt")
        for folder in ("flood results", "sub"):
            (self.dir / folder).mkdir()
        for words, expected in (
                (("hyoryu", "re"), ["render", "report"]),
                (("hyoryu", "--v"), ["--version"]),
                (("hyoryu", "run", "fl"), ["flood results", "flood.toml"]),
                (("hyoryu", "run", "no"), []),
                (("hyoryu", "run", "flood.toml", "--re"), ["--rebalance", "--resume"]),
                (("hyoryu", "run", "--output", "s"), ["sub"]),
                (("hyoryu", "run", "--threads", ""), []),
                (("hyoryu", "convert", "--to", "vt"), ["vtkhdf", "vtp"]),
                (("hyoryu", "convert", "sub", "--to=c"), ["csv"]),
                (("hyoryu", "info", "fl"), ["flood results"]),
                (("hyoryu", "new", "s"), ["street_with_buildings"]),
                (("hyoryu", "new", "tank", "n"), ["notes.txt"]),
                (("hyoryu", "verify", "--tier", "n"), ["nightly"]),
                (("hyoryu", "describe", "fluid.vis"),
                 ["fluid.viscosity", "fluid.viscosity.alpha", "fluid.viscosity.beta", "fluid.viscosity.form",
                  "fluid.viscosity.kinematic", "fluid.viscosity.model", "fluid.viscosity.smagorinsky"]),
                (("hyoryu", "man", "com"), ["completions"]),
                (("hyoryu", "completions", ""), ["bash", "fish", "zsh"])):
            self.assertEqual(self.completed(*words), expected, words)

    def test_every_command_and_option_of_the_help_is_offered(self):
        for command in COMMANDS:
            self.assertIn(command, self.completed("hyoryu", ""))
            options = set(re.findall(r"^  (?:-\w,)?(--[\w-]+)", self.call(command, "--help").stdout, re.M))
            self.assertLessEqual({"--help"}, options)
            self.assertLessEqual(options, set(self.completed("hyoryu", command, "--")), command)
            for shell, form in (("zsh", "{}"), ("fish", "-l {}")):
                text = (self.dir / self.script(shell)).read_text()
                for option in options:
                    self.assertIn(form.format(option if shell == "zsh" else option[2:]), text)

    def test_shells_read_their_scripts(self):
        for shell in ("bash", "zsh", "fish"):
            script = self.script(shell)
            if shutil.which(shell):
                done = subprocess.run([shell, "-n", script], cwd=self.dir, capture_output=True, timeout=60)
                self.assertEqual((done.returncode, done.stderr), (0, b""), shell)
        if shutil.which("fish"):
            done = subprocess.run(["fish", "-c", "source hyoryu.fish; complete -C 'hyoryu convert --to vt'"],
                                  cwd=self.dir, capture_output=True, text=True, timeout=60)
            offered = [line.split("\t")[0] for line in done.stdout.splitlines()]
            self.assertEqual(offered, ["vtkhdf", "vtp"], done.stderr)
        self.assertEqual(self.call("completions", "tcsh").returncode, 2)
        self.assertIn('did you mean "bash"?', self.call("completions", "bsh").stderr)


class Manual(ProgramTest):
    @unittest.skipUnless(shutil.which("man"), "man is not installed")
    def test_pages_are_set_without_warnings(self):
        for command in ([], *([name] for name in COMMANDS)):
            done = self.call("man", *command)
            self.assertEqual(done.returncode, 0, done.stderr)
            page = self.write(done.stdout, "page.1")
            shown = subprocess.run(["man", "--warnings", "-l", page], cwd=self.dir, capture_output=True,
                                   text=True, timeout=60, env={**os.environ, "MANWIDTH": "90", "LC_ALL": "C"})
            self.assertEqual((shown.returncode, shown.stderr), (0, ""), command)
            self.assertIn("NAME", shown.stdout)

    def test_e14_pages_hold_what_the_help_says(self):
        for command in COMMANDS:
            page = self.call("man", command).stdout.replace("\\-", "-").replace("\\fB", "").replace("\\fR", "")
            for option in re.findall(r"^  (?:-\w,)?(--[\w-]+)", self.call(command, "--help").stdout, re.M):
                self.assertIn(option, page, command)
        page = self.call("man").stdout
        for command in COMMANDS:
            self.assertIn(f"hyoryu\\-{command}", page)
        for code in ("0 ", "1 ", "2 ", "3 ", "4 ", "130"):
            self.assertIn(f"\n  {code}", page)

    def test_an_unknown_command_has_no_page(self):
        done = self.call("man", "convrt")
        self.assertEqual(done.returncode, 2)
        self.assertIn('did you mean "convert"?', done.stderr)


if __name__ == "__main__":
    main()
