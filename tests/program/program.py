"""What the tests of the program share: two small cases, and a folder in which the program is called.

Usage of each: test_NAME.py PATH_TO_HYORYU [NAME...]; needs nothing but Python's standard library.
"""
import pathlib
import subprocess
import sys
import tempfile
import unittest

HYORYU = str(pathlib.Path(sys.argv.pop(1)).resolve())
DOCS = pathlib.Path(__file__).resolve().parents[2] / "docs"
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

# A dam break, pushed by a paddle, against two crates in 2-D: all kinds of output, walls that move and every
# kind of gauge, and many checkpoints in about a second.
DAM = """
dimensions = 2
[time]
end = 0.4
[particles]
spacing = 0.02
[fluid]
[[fluid.block]]
shape = "box"
min = [0.0, 0.0, 0.0]
max = [0.5, 0.0, 0.5]
[[wall]]
name = "basin"
shape = "basin"
min = [-0.3, 0.0, 0.0]
max = [1.4, 0.0, 0.8]
open = ["+z"]
[[wall]]
name = "paddle"
shape = "box"
min = [-0.1, 0.0, 0.0]
max = [0.0, 0.0, 0.7]
[wall.motion]
velocity = [0.2, 0.0, 0.0]
[[body]]
name = "crate"
shape = "box"
size = [0.12, 0.12, 0.12]
density = 400.0
position = [0.7, 0.0, 0.06]
[[body]]
name = "upper"
shape = "box"
size = [0.12, 0.12, 0.12]
density = 300.0
position = [0.72, 0.0, 0.18]
[[gauge]]
name = "level"
type = "elevation"
at = [0.3, 0.0]
[[gauge]]
name = "pressure"
type = "pressure"
at = [1.4, 0.0, 0.06]
normal = [-1.0, 0.0, 0.0]
area = 0.06
filter = "median"
window = 0.02
[[gauge]]
name = "speed"
type = "velocity"
at = [0.4, 0.0, 0.05]
[[gauge]]
name = "paddle_force"
type = "force"
on = "paddle"
[[gauge]]
name = "crate_force"
type = "force"
on = "crate"
[[gauge]]
name = "flux"
type = "flux"
at = [0.6, 0.0, 0.0]
normal = [1.0, 0.0, 0.0]
[[gauge]]
name = "front"
type = "front"
axis = "x"
filter = "mean"
window = 0.01
[output]
every = 0.01
checkpoint_every = 0.02
"""
HISTORIES = ("bodies.csv", "contacts.csv", "energy.csv", "gauges.csv")


class ProgramTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.dir = pathlib.Path(self.folder.name)
        self.program = HYORYU

    def tearDown(self):
        self.folder.cleanup()

    def call(self, *arguments, **options):
        return subprocess.run([self.program, *map(str, arguments)], cwd=self.dir,
                              capture_output=True, text=True, timeout=600, **options)

    def write(self, text, name="case.toml"):
        (self.dir / name).write_text(text)
        return name

    def files(self):
        return sorted(p.name for p in self.dir.iterdir())

    def read(self, folder, name):
        return (self.dir / folder / name).read_bytes()


def main():
    unittest.main(verbosity=2)
