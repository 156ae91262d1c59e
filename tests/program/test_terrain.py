#!/usr/bin/env python3
"""Terrain from height grids: one ground in maps drawn at random is the same ground, water rests on it, and mistakes are told."""
import json
import math
import os
import random
import struct
import subprocess
import zlib

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

    def test_no_water_is_lost_over_a_slope_and_a_step(self):
        """A dam breaks over a step of 0.2 m within one cell of the grid, and runs up a slope of 45 degrees."""
        dice = random.Random(int(os.environ.get("HYORYU_SEED", "1")) + 40)
        for spacing in (0.06, 0.045):
            step, toe = dice.uniform(0.45, 0.55), dice.uniform(0.75, 0.8)
            keys = self.grid((4e5, 4e6), dice.uniform(0, 360), 0.02,
                             lambda x, y: (-0.2 if x < step else 0.0) + min(max(x - toe, 0.0), 0.5), reach=2.0)
            text = CASE.format(keys=keys.replace("resolution = 0.08", "resolution = 0.04"), spacing=spacing, end=1.0)
            text = text.replace("max = [1.2, 1.0, 0.5]", "max = [0.35, 0.4, 0.6]").replace("1.2, 1.0,", "1.2, 0.4,")
            self.write(text.replace("min = [0.0, 0.0, -0.15]", "min = [0.0, 0.0, -0.3]"))
            done = self.call("run", "case.toml", "-o", "results", "--force", "--quiet", "--threads", 1)
            self.assertEqual(done.returncode, 0, done.stderr)
            summary = json.loads((self.dir / "results" / "summary.json").read_text())
            self.assertEqual(summary["particles_lost"], 0, (spacing, keys))
            self.assertEqual(summary["worst_particles_in_solids"], 0, (spacing, keys))
            self.assertGreater(summary["counts"]["fluid"], 300)

    def test_a_grid_of_four_million_cells_is_read_quickly(self):
        """5 s and 500 MB for all that `check` does with it, reading it twice; 0.3 s and 74 MB were measured."""
        dice = random.Random(1)
        rows = [" ".join(f"{dice.uniform(3, 5):.3f}" for _ in range(2000)) for _ in range(8)]
        with open(self.dir / "ground.asc", "w") as file:
            file.write("ncols 2000\nnrows 2000\nxllcorner 378450\nyllcorner 4072310\ncellsize 1\nNODATA_value -9999\n")
            for j in range(2000):
                file.write(rows[j * 7 % 8] + "\n")
        keys = "extent = [900.0, 900.0, 1000.0, 1000.0]\norigin = [378450.0, 4072310.0]"
        text = CASE.format(keys=keys, spacing=2.0, end=1.0)
        dry = text[:text.index("[fluid]")] + text[text.index("[[wall]]"):]
        self.write(dry + '[[body]]\nshape = "sphere"\nradius = 1\ndensity = 500\nposition = [950, 950, 90]\n')
        with open(self.dir / "told", "w") as told:
            process = subprocess.Popen([self.program, "check", "case.toml"], cwd=self.dir, stdout=told, stderr=told)
            _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        self.assertEqual(process.returncode, 0, (self.dir / "told").read_text())
        self.assertLess(used.ru_utime + used.ru_stime, 5)
        self.assertLess(used.ru_maxrss * 1024, 500e6)

    def test_a_resolved_case_holds_the_same_ground(self):
        keys = self.grid((4e5, 4e6), 33.0, 0.05)
        self.write(CASE.format(keys=keys, spacing=0.1, end=0.02))
        self.assertEqual(self.call("run", "case.toml", "-o", "one", "--quiet").returncode, 0)
        self.assertEqual(self.call("run", "one/case.toml", "-o", "two", "--quiet").returncode, 0)
        one, two = ((self.dir / d / "energy.csv").read_text() for d in ("one", "two"))
        self.assertEqual(one, two)
        self.assertEqual(*((self.dir / d / "case.toml").read_text() for d in ("one", "two")))

    def expect_noticed(self, *changes):
        """A run of case.toml goes on with none of the changes (file, old, new, key that is told; None: it goes on)."""
        done = self.call("run", "case.toml", "-o", "out", "--force", "--quiet", "--until", "0.01")
        self.assertEqual(done.returncode, 0, done.stderr)
        for name, old, new, key in (*changes, (changes[0][0], "", "", None)):
            text = (self.dir / name).read_text()
            self.assertIn(old, text)
            (self.dir / name).write_text(text.replace(old, new, 1))
            done = self.call("run", "case.toml", "-o", "out", "--quiet", "--resume", "--until", "0.02")
            self.assertEqual(done.returncode, 2 if key else 0, (name, new, done.stderr))
            if key:
                self.assertIn(f"`{key}`: the checkpoint was written with", done.stderr)
            (self.dir / name).write_text(text)

    def test_a_changed_file_is_noticed_on_resume(self):
        keys = self.grid((4e5, 4e6), 33.0, 0.05)
        a = math.radians(33.0)
        ring = [[4e5 + x * math.sin(a) - y * math.cos(a), 4e6 + x * math.cos(a) + y * math.sin(a)]
                for x, y in ((0.6, 0.3), (0.9, 0.3), (0.9, 0.6), (0.6, 0.6), (0.6, 0.3))]
        self.write(json.dumps({"type": "FeatureCollection", "features": [
            {"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates": [ring]}}]}), "town.geojson")
        self.write(CASE.format(keys=keys, spacing=0.1, end=0.05) + '[[buildings]]\nfile = "town.geojson"\nheight = 0.5\n')
        self.expect_noticed(("ground.asc", "-9999\n0.", "-9999\n1.", "wall[0].file"),
                            ("ground.asc", "\nNODATA", "\n NODATA", "wall[0].file"),
                            ("town.geojson", f"{ring[1][0]!r}", f"{ring[1][0] + 0.01!r}", "wall[2].corners"),
                            ("town.geojson", '"properties": {}', '"properties": {"id": 1}', None))

    def test_a_changed_series_is_noticed_on_resume(self):
        self.write("time,level,velocity\n0,0.5,0\n1,0.5,0.1\n", "gauge.csv")
        self.write("""
dimensions = 2
[time]
end = 0.05
[particles]
spacing = 0.1
[fluid]
[[fluid.block]]
shape = "box"
min = [0.0, 0.0, 0.0]
max = [1.0, 0.0, 0.5]
[[wall]]
shape = "basin"
min = [0.0, 0.0, 0.0]
max = [1.0, 0.0, 1.0]
open = ["-x", "+z"]
[[open]]
min = [0.0, 0.0, 0.0]
max = [0.0, 0.0, 1.0]
into = "+x"
kind = "inflow"
series = "gauge.csv"
""")
        self.expect_noticed(("gauge.csv", "1,0.5,0.1", "1,0.5,0.2", "open[0].station[0].velocities"))

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

    def test_a_body_is_above_the_ground_or_told_to_be_in_it_or_below_it(self):
        keys = self.grid((4e5, 4e6), 90.0, 0.05) + "bottom = -1.0"
        for size in (0.04, 0.1, 0.3):
            for z, said in ((-1.01 - size / 2, "below the underside"), (-0.99, "overlaps wall"), (-0.5, "overlaps wall"),
                            (2.0 + size, None)):
                body = f'[[body]]\nname = "crate"\nshape = "box"\nsize = [{size}, {size}, {size}]\ndensity = 500\n' \
                       f"position = [0.5, 0.5, {z}]\n"
                self.write(CASE.format(keys=keys, spacing=0.1, end=0.02) + body)
                told = self.call("check", "case.toml").stderr
                for words in ("below the underside", "overlaps wall"):
                    self.assertEqual(f'body "crate" {words}' in told.replace("lies ", ""), words == said, (size, z, told))

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

    TOWN = """
[time]
end = 0.1
[particles]
spacing = {spacing}
[domain]
min = [0.0, 0.0, -1.0]
max = [3.0, 2.0, 1.5]
[fluid]
[[fluid.block]]
shape = "still_water"
level = 0.25
seed = [0.3, 0.3]
[[wall]]
name = "ground"
shape = "terrain"
file = "ground.asc"
{keys}
manning = 0.03
[[wall.level]]
corners = [[2.3, -0.1, 0.0], [3.2, -0.1, 0.0], [3.2, 2.2, 0.0], [2.3, 2.2, 0.0]]
z = 0.4
[[buildings]]
file = "town.geojson"
height = "height"
name = "id"
material = "concrete"
[[wall]]
name = "sides"
shape = "basin"
min = [0.0, 0.0, -1.0]
max = [3.0, 2.0, 1.5]
open = ["+z", "-z"]
[[body]]
name = "crate"
shape = "box"
size = [0.3, 0.4, 0.3]
density = 500.0
position = [2.65, 1.0, 0.552]
[[gauge]]
name = "push"
type = "force"
on = "hall"
[output]
every = 0.05
"""

    def town(self, spacing=0.1, azimuth=25.0, origin=(4e5, 4e6)):
        """Hills with a quay and two buildings, one of them with a courtyard, in a map."""
        keys = self.grid(origin, azimuth, 0.1, lambda x, y: 0.1 * math.cos(2 * x) * math.cos(y), reach=4.5)
        keys = keys.replace("[-0.2, -0.2, 1.4, 1.2]", "[-0.2, -0.2, 3.2, 2.2]")
        a = math.radians(azimuth)

        def on_map(ring):
            return [[origin[0] + x * math.sin(a) - y * math.cos(a), origin[1] + x * math.cos(a) + y * math.sin(a)]
                    for x, y in ring + ring[:1]]

        hall = [[(0.8, 0.5), (1.9, 0.5), (1.9, 1.6), (0.8, 1.6)], [(1.15, 0.85), (1.15, 1.25), (1.55, 1.25), (1.55, 0.85)]]
        shed = [[(0.1, 1.6), (0.5, 1.6), (0.3, 1.9)]]
        features = [{"type": "Feature", "properties": {"id": name, "height": height},
                     "geometry": {"type": "Polygon", "coordinates": [on_map(ring) for ring in rings]}}
                    for name, height, rings in (("hall", 0.9, hall), ("shed", "0.5", shed))]
        self.write(json.dumps({"type": "FeatureCollection", "features": features}), "town.geojson")
        self.write(self.TOWN.format(spacing=spacing, keys=keys))

    def test_a_town_runs_and_its_resolved_case_gives_the_same_bits(self):
        self.town()
        done = self.call("run", "case.toml", "-o", "one", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        (self.dir / "town.geojson").unlink()
        done = self.call("run", "one/case.toml", "-o", "two", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        for name in ("energy.csv", "gauges.csv", "case.toml"):
            self.assertEqual(*((self.dir / d / name).read_text() for d in ("one", "two")))
        summary = json.loads((self.dir / "one" / "summary.json").read_text())
        self.assertEqual(summary["particles_lost"], 0)
        self.assertEqual(summary["particles_in_solids"], 0)
        plan = json.loads((self.dir / "one" / "plan.json").read_text())
        self.assertIn("bed_friction", [effect["name"] for effect in plan["on"]])
        header = (self.dir / "one" / "gauges.csv").read_text().splitlines()
        self.assertTrue(any("push" in line for line in header[:2]))

    def test_check_tells_of_the_ground_and_draws_the_plan(self):
        self.town()
        done = self.call("check", "case.toml", "--plan", "plan.png")
        self.assertEqual(done.returncode, 0, done.stderr)
        for text in ("ground \"ground\"", "window ", "grid minus surface", "rms", "steeper than 45 deg"):
            self.assertIn(text, done.stdout)
        colours = self.colours_of("plan.png")
        self.assertGreater(colours["solid"], 5000)
        self.assertGreater(colours["body"], 500)
        self.assertGreater(colours["blue"], 20000)
        self.assertEqual(self.call("check", "case.toml", "--plan", "none/plan.png").returncode, 4)
        self.write(CASE.format(keys=self.grid((0.0, 0.0), 90.0, 0.1), spacing=0.1, end=0.1)
                   .replace("dimensions = 3", "dimensions = 2"), "flat.toml")
        self.assertNotEqual(self.call("check", "flat.toml", "--plan", "flat.png").returncode, 0)
        self.assertFalse((self.dir / "flat.png").exists())

    def test_the_plan_points_north(self):
        seed = int(os.environ.get("HYORYU_SEED", "1"))
        dice = random.Random(seed)
        for azimuth in (90.0, dice.uniform(0, 360), dice.uniform(0, 360)):
            self.write(CASE.format(keys=self.grid((3e5, 4e6), azimuth, 0.1), spacing=0.1, end=0.1))
            self.assertEqual(self.call("check", "case.toml", "--plan", "plan.png").returncode, 0)
            red = [(i, -j) for j, row in enumerate(self.rows_of("plan.png")) for i in range(len(row) // 3)
                   if tuple(row[3 * i:3 * i + 3]) == (190, 20, 30)]
            self.assertGreater(len(red), 100, (seed, azimuth))
            middle = [sum(p[k] for p in red) / len(red) for k in (0, 1)]
            # The arrow is longer before its middle than behind it.
            tip = max(red, key=lambda p: math.dist(p, middle))
            found = math.degrees(math.atan2(tip[1] - middle[1], tip[0] - middle[0]))
            off = (found - azimuth + 180) % 360 - 180  # north is so far counter-clockwise from +x
            self.assertLess(abs(off), 6, (seed, azimuth, found))  # a pixel at 20 pixels is 3 degrees
        self.write(CASE.format(keys="", spacing=0.1, end=0.1).replace('shape = "terrain"', 'shape = "plane"')
                   .replace('file = "ground.asc"', "point = [0, 0, 0]\nnormal = [0, 0, 1]"), "plane.toml")
        done = self.call("check", "plane.toml", "--plan", "plan.png")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotIn(b"\xbe\x14\x1e", b"".join(self.rows_of("plan.png")))

    def test_a_body_below_the_ground_is_refused_with_its_depth(self):
        self.town()  # whose quay lies at 0.4 m: the crate of 0.3 m stands on it at 0.55 m
        for z, depth in (0.54, "0.01 m"), (0.4, "0.15 m"), (0.2, "0.35 m"), (0.0, ""):
            done = self.call("check", "case.toml", "--set", f"body[0].position=[2.65, 1.0, {z}]")
            self.assertEqual(done.returncode, 2, (z, done.stderr))
            self.assertIn(f'body "crate" overlaps wall "ground" by {depth}', done.stderr)

    def rows_of(self, name):
        """Rows of a PNG, three bytes a pixel, decoded here."""
        data = (self.dir / name).read_bytes()
        self.assertEqual(data[:8], b"\x89PNG\r\n\x1a\n")
        place, packed = 8, b""
        while place < len(data):
            size, kind = struct.unpack(">I4s", data[place:place + 8])
            body = data[place + 8:place + 8 + size]
            self.assertEqual(struct.unpack(">I", data[place + 8 + size:place + 12 + size])[0], zlib.crc32(kind + body))
            if kind == b"IHDR":
                width, height = struct.unpack(">II", body[:8])
            packed += body if kind == b"IDAT" else b""
            place += 12 + size
        rows = zlib.decompress(packed)
        self.assertEqual(len(rows), height * (3 * width + 1))
        return [rows[j * (3 * width + 1) + 1:(j + 1) * (3 * width + 1)] for j in range(height)]

    def colours_of(self, name):
        """Pixels of a PNG by what they are."""
        found = {"solid": 0, "body": 0, "blue": 0}
        for row in self.rows_of(name):
            for i in range(0, len(row), 3):
                red, green, blue = row[i:i + 3]
                found["solid"] += (red, green, blue) == (150, 146, 148)
                found["body"] += (red, green, blue) == (214, 96, 40)
                found["blue"] += blue > red + 40
        return found


if __name__ == "__main__":
    main()
