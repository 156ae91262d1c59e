#!/usr/bin/env python3
"""Terrain from height grids: one ground in maps drawn at random is the same ground, water rests on it, and mistakes are told."""
import json
import math
import os
import random

from program import ProgramTest, main

CASE = """
dimensions = 3
[time]
end = {end}
[particles]
spacing = {spacing}
[fluid]
[[fluid.block]]
shape = "box"
min = [0.0, 0.0, -0.15]
max = [1.2, 1.0, 0.5]
[[wall]]
name = "ground"
shape = "terrain"
file = "ground.asc"
{keys}
[[wall]]
name = "sides"
shape = "basin"
min = [0.0, 0.0, -0.5]
max = [1.2, 1.0, 0.9]
open = ["+z", "-z"]
[output]
every = 0.1
"""


def hills(x, y):
    return 0.15 * math.sin(2.5 * x + 0.3) * math.cos(2 * y)


class Terrain(ProgramTest):
    def grid(self, origin, azimuth, cell, ground=hills, reach=2.5):
        """A grid about the origin, in the axes of a map, and the keys that place it."""
        a = math.radians(azimuth)
        count = int(2 * reach / cell) + 1
        first = [origin[0] - reach, origin[1] - reach]
        lines = [f"ncols {count}", f"nrows {count}", f"xllcenter {first[0]!r}", f"yllcenter {first[1]!r}",
                 f"cellsize {cell!r}", "NODATA_value -9999"]
        for j in range(count - 1, -1, -1):
            row = []
            for i in range(count):
                east, north = i * cell - reach, j * cell - reach
                x = math.sin(a) * east + math.cos(a) * north
                y = -math.cos(a) * east + math.sin(a) * north
                row.append(f"{ground(x, y):.6f}")
            lines.append(" ".join(row))
        self.write("\n".join(lines) + "\n", "ground.asc")
        return (f"origin = [{origin[0]!r}, {origin[1]!r}]\nazimuth_deg = {azimuth!r}\n"
                "extent = [-0.2, -0.2, 1.4, 1.2]\nresolution = 0.08\n")

    def ran(self, keys, spacing, end=0.4):
        self.write(CASE.format(keys=keys, spacing=spacing, end=end))
        done = self.call("run", "case.toml", "-o", "results", "--force", "--quiet", "--threads", 1)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads((self.dir / "results" / "summary.json").read_text())

    def test_water_rests_on_one_ground_in_any_map(self):
        seed = int(os.environ.get("HYORYU_SEED", "1"))
        dice = random.Random(seed)
        for spacing in (0.1, 0.07):
            found = []
            for _ in range(3):
                origin = (dice.uniform(2e5, 8e5), dice.uniform(1e6, 8e6))
                keys = self.grid(origin, dice.uniform(0, 360), dice.uniform(0.02, 0.03))
                summary = self.ran(keys, spacing, end=1.0)
                self.assertEqual(summary["particles_lost"], 0, seed)
                self.assertEqual(summary["particles_in_solids"], 0, seed)
                found.append((summary["counts"]["fluid"], summary["energy"]["end"]["fluid_kinetic"]))
                mass = found[-1][0] * 1000 * spacing ** 3
                # The settling of five to seven rows of particles, H = 0.5 m: 1 % of sqrt(g H) after a second.
                self.assertLess(2 * found[-1][1] / mass, 1e-4 * 9.81 * 0.5, (seed, keys))
            # The grids differ by their rounding and interpolation: the water hardly does.
            for what in zip(*found):
                self.assertLess(max(what) - min(what), 0.05 * max(what), (seed, found))

    def test_a_resolved_case_holds_the_same_ground(self):
        keys = self.grid((4e5, 4e6), 33.0, 0.05)
        self.write(CASE.format(keys=keys, spacing=0.1, end=0.02))
        self.assertEqual(self.call("run", "case.toml", "-o", "one", "--quiet").returncode, 0)
        self.assertEqual(self.call("run", "one/case.toml", "-o", "two", "--quiet").returncode, 0)
        one, two = ((self.dir / d / "energy.csv").read_text() for d in ("one", "two"))
        self.assertEqual(one, two)
        self.assertEqual(*((self.dir / d / "case.toml").read_text() for d in ("one", "two")))

    def refused(self, keys, *texts):
        self.write(CASE.format(keys=keys, spacing=0.1, end=0.02))
        done = self.call("check", "case.toml")
        self.assertEqual(done.returncode, 2, keys)
        for text in texts:
            self.assertIn(text, done.stderr)

    def test_mistakes_are_told_with_their_place(self):
        self.grid((0.0, 0.0), 90.0, 0.1)
        self.refused("extent = [0.0, 0.0, 40.0, 1.0]", "the grid has no height at", "wall[0].extent", "reduce `extent`")
        self.refused("azimuth_deg = 45.0", "`wall[0].extent`", "multiple of 90")
        self.refused("extent = [1.0, 0.0, 0.0, 1.0]", "x_min")
        self.refused("bottom = 3.0", "must be below the lowest ground")
        self.refused("resolution = 1e-6", "points of the surface")
        self.refused("position = [0.0, 0.0, 0.0]", "position")
        self.refused("radius = 1.0\nresolution = -1.0", "radius", "resolution")
        (self.dir / "ground.asc").write_text("ncols 2\nnrows 2\nxllcorner 0\n")
        self.refused("", "ground.asc:")
        (self.dir / "ground.asc").unlink()
        self.refused("", "does not exist")

    def test_water_below_the_ground_is_warned_of(self):
        keys = self.grid((4e5, 4e6), 90.0, 0.05)
        for bottom, warned in (-0.14, True), (-0.16, False):
            self.write(CASE.format(keys=keys + f"bottom = {bottom}", spacing=0.1, end=0.02))
            done = self.call("check", "case.toml")
            self.assertEqual("below the underside" in done.stderr, warned, done.stderr)

    def test_missing_heights_are_replaced_only_on_request(self):
        self.grid((0.0, 0.0), 90.0, 0.1, lambda x, y: -9999 if x > 1.1 else 0.0)
        keys = "origin = [0.0, 0.0]\nextent = [-0.2, -0.2, 1.4, 1.2]\n"
        self.refused(keys, "has no height at")
        self.grid((0.0, 0.0), 90.0, 0.1, lambda x, y: -9999)
        self.refused("", "has no height at")
        self.assertNotIn("nan", self.call("check", "case.toml").stderr)
        self.grid((0.0, 0.0), 90.0, 0.1, lambda x, y: -9999 if x > 1.1 else 0.0)
        self.write(CASE.format(keys=keys + "nodata = 0.0", spacing=0.1, end=0.02))
        done = self.call("check", "case.toml")
        self.assertEqual(done.returncode, 0, done.stderr)


if __name__ == "__main__":
    main()
