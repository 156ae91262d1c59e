"""What the tests of the program share: a small flood, and a folder in which the program is called.

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
