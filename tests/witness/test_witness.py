#!/usr/bin/env python3
"""The witness against results folders made by hand, whose overlaps, energies and sums are known.

Usage: test_witness.py PATH_TO_WITNESS PATH_TO_HYORYU [NAME...]"""
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

WITNESS = str(pathlib.Path(sys.argv.pop(1)).resolve())
HYORYU = str(pathlib.Path(sys.argv.pop(1)).resolve())
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "random"))
from pieces import Mesh, about, plus, prism, turned  # noqa: E402

G = 9.81
UPRIGHT = (1.0, 0.0, 0.0, 0.0)
HEAD = "time,body,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz,fx,fy,fz,tx,ty,tz"


class Folder(unittest.TestCase):
    def setUp(self):
        self.place = tempfile.TemporaryDirectory()
        self.dir = pathlib.Path(self.place.name)
        self.case = "dimensions = 3\ngravity = [0.0, 0.0, -9.81]\n[particles]\nspacing = 0.02\n"
        self.names = []
        self.rows = []
        self.summary = {}

    def tearDown(self):
        self.place.cleanup()

    def wall(self, name, lines):
        self.case += f'[[wall]]\nname = "{name}"\n{lines}\n'

    def body(self, name, lines, density=500.0):
        self.names.append(name)
        self.case += f'[[body]]\nname = "{name}"\ndensity = {density}\n{lines}\n'

    def row(self, time, *states):
        """States are (position, turn), or (position, turn, velocity, angular velocity)."""
        for name, state in zip(self.names, states):
            x, q, v, w = (*state, (0, 0, 0), (0, 0, 0))[:4]
            numbers = ",".join(repr(float(n)) for n in (*x, *q, *v, *w, *[0] * 6))
            self.rows.append(f"{time},{name},{numbers}")

    def judge(self, *options, code=None):
        (self.dir / "case.toml").write_text(self.case)
        (self.dir / "summary.json").write_text(json.dumps(self.summary))
        (self.dir / "bodies.csv").write_text("# units\n" + "\n".join([HEAD, *self.rows]) + "\n")
        done = subprocess.run([WITNESS, self.dir, *map(str, options)], capture_output=True, text=True, timeout=60)
        self.assertIn(done.returncode, (0, 1), done.stderr)
        if code is not None:
            self.assertEqual(done.returncode, code, done.stdout)
        return json.loads(done.stdout)

    def expect_depth(self, depth, a=None, b=None, within=1e-9):
        found = self.judge()["overlap"]
        self.assertAlmostEqual(found["worst"], depth, delta=within)
        if a:
            self.assertEqual({found["a"], found["b"]}, {a, b})
        return found


BOX = 'shape = "box"\nsize = [0.4, 0.3, 0.2]'
BALL = 'shape = "sphere"\nradius = 0.1'
LOG = 'shape = "cylinder"\nradius = 0.1\nlength = 0.5'
PLANE = 'shape = "plane"\npoint = [0, 0, 0.05]\nnormal = [0, 0, 1]'
BASIN = 'shape = "basin"\nmin = [0, 0, 0]\nmax = [2, 2, 0.5]\nopen = ["+z"]'


class Overlaps(Folder):
    def test_the_worst_row_and_pair_are_named(self):
        self.body("left", BOX)
        self.body("right", BOX)
        self.body("far", BALL)
        for k, gap in enumerate((1e-3, -2e-5, -1e-5)):
            self.row(0.1 * k, ((0, 0, 1), UPRIGHT), ((0.4 + gap, 0.05, 1.03), UPRIGHT), ((5, 5, 5), UPRIGHT))
        found = self.expect_depth(2e-5, "left", "right")
        self.assertEqual(found["time"], 0.1)
        self.assertEqual(found["at_the_start"], 0)
        self.judge("--overlap", 1e-4, code=0)
        self.judge("--overlap", 1e-5, code=1)

    def test_bodies_apart_do_not_overlap_whatever_their_turns(self):
        self.body("a", BOX)
        self.body("b", LOG)
        for k in range(200):
            q = about((math.cos(k), math.sin(k) * 0.6, math.sin(k) * 0.8), 37.0 * k)
            self.row(k, ((0, 0, 0), q), ((0.2692582403567252 + math.hypot(0.1, 0.25) + 1e-6, 0, 0), about((0, 1, 0), k)))
        self.expect_depth(0)

    def test_crossed_edges(self):
        # Two boxes on their long edges, one along x and the other along y: sqrt(a^2 + b^2)/2 from the axes.
        self.body("a", 'shape = "box"\nsize = [2, 0.1, 0.1]')
        self.body("b", 'shape = "box"\nsize = [0.1, 2, 0.1]')
        reach = 0.1 / math.sqrt(2)
        for depth in (1e-3, 1e-6, -1e-6):
            self.rows.clear()
            self.row(0, ((0, 0, 0), about((1, 0, 0), 45)), ((0, 0, 2 * reach - depth), about((0, 1, 0), 45)))
            self.expect_depth(max(depth, 0))

    def test_the_rim_of_a_cylinder_in_a_box(self):
        # Tilted by 30 degrees about y the lowest point of the rim lies L/2 sin + r cos below the centre.
        self.wall("table", 'shape = "box"\nsize = [3, 3, 1]\nposition = [0, 0, -0.5]')
        self.body("log", LOG)
        low = 0.25 * math.sin(math.radians(30)) + 0.1 * math.cos(math.radians(30))
        for depth in (1e-4, 1e-7):
            self.rows.clear()
            self.row(0, ((0.2, 0.1, low - depth), about((0, 1, 0), 30)))
            self.expect_depth(depth, "log", "table")

    def test_a_body_whose_centre_of_mass_lies_off_its_middle(self):
        # The rows tell where the centre of mass is: 0.3 from the upper end of a post that is 1 high.
        self.wall("floor", 'shape = "plane"')
        self.body("post", 'shape = "box"\nsize = [0.2, 0.2, 1]\ncenter_of_mass = [0, 0, 0.2]')
        for turn, above in ((0, 0.7), (180, 0.3), (90, 0.1)):
            self.rows.clear()
            self.row(0, ((0, 0, above - 1e-4), about((0, 1, 0), turn)))
            self.expect_depth(1e-4, "post", "floor")

    def test_a_cap_on_an_edge(self):
        # Edge along y at height h of a box turned by 45 degrees; the flat end of a log stands on it.
        self.body("box", 'shape = "box"\nsize = [0.2, 0.6, 0.2]')
        self.body("log", LOG)
        edge = 0.2 / math.sqrt(2)
        self.row(0, ((0, 0, 0), about((0, 1, 0), 45)), ((0.03, 0.02, edge + 0.25 - 5e-5), about((0, 1, 0), 90)))
        self.expect_depth(5e-5)

    def test_planes_that_move_along_a_path(self):
        # Half way between two points with level ends the cubic is half way up.
        self.wall("piston", PLANE + "\n[wall.motion]\ntimes = [0, 2]\nplaces = [[0, 0, 0], [0, 0, 0.2]]")
        self.body("ball", BALL)
        self.row(0.0, ((0, 0, 0.16), UPRIGHT))
        self.row(1.0, ((0, 0, 0.16), UPRIGHT))
        self.expect_depth(0.09, "ball", "piston")

    def test_a_basin_is_solid_below_and_beside(self):
        self.wall("basin", BASIN)
        self.body("ball", BALL)
        for at, depth in (((1, 1, 0.099), 1e-3), ((1, 1.902, 0.3), 2e-3), ((1, 1, -0.05), 0.11),
                          ((1, -0.02, 0.599), 1e-3), ((1, 0.5, 0.6), 0), ((1, 1, 3), 0)):
            self.rows.clear()
            self.row(0, (at, UPRIGHT))
            # Below the floor: out through its underside, three spacings thick, is the shorter way.
            self.expect_depth(depth)

    def test_meshes_that_are_convex_and_not(self):
        mesh = prism([(1, 1), (3, 1), (3, 0), (0, 0), (0, 3), (1, 3)], 0.0, 2.0)
        mesh.write(self.dir / "l.stl")
        self.wall("angle", f'shape = "mesh"\nfile = "{self.dir}/l.stl"\nposition = [0, 0, 0]')
        self.body("ball", BALL)
        for at, depth in (((2, 1, 1.1 - 1e-5), 1e-5), ((1.1 - 2e-5, 1, 2), 2e-5), ((2, 1, 1.11), 0),
                          ((2, 1, 0.4), 0.4)):  # the last: its centre is inside, 0.4 from the nearest face
            self.rows.clear()
            self.row(0, (at, UPRIGHT))
            self.expect_depth(depth, within=1e-6 if depth < 0.1 else 0.1)

    def test_a_terrain_with_level_areas(self):
        # A later area covers those before it, whichever way its corners run; beside them the ground is that of the grid.
        rows = "\n".join(" ".join(["0.05"] * 31) for _ in range(31))
        (self.dir / "flat.asc").write_text(f"ncols 31\nnrows 31\nxllcenter 7\nyllcenter 9\ncellsize 0.1\n{rows}\n")
        areas = ((0.4, "[[1, -1, 0], [4, -1, 0], [4, 4, 0], [1, 4, 0]]"),
                 (-0.2, "[[2, 1, 0], [2, 2, 0], [4, 2, 0], [4, 1, 0]]"))
        self.wall("ground", f'shape = "terrain"\nfile = "{self.dir}/flat.asc"\norigin = [7, 9]\nazimuth_deg = 90\n'
                  "datum = 0.1\nbottom = -3\nextent = [0, 0, 3, 3]\nresolution = 0.1\n"
                  + "\n".join(f"[[wall.level]]\nz = {z}\ncorners = {ring}" for z, ring in areas))
        self.body("ball", BALL)
        for x, y, z in ((0.5, 1.5, 0.15), (0.6, 2.5, 0.15), (1.05, 0.5, 0.4), (1.9, 1.5, 0.4), (2.5, 1.5, -0.2), (2.5, 2.05, 0.4)):
            for depth in (1e-4, -1e-4):
                self.rows.clear()
                self.row(0, ((x, y, z + 0.1 - depth), UPRIGHT))
                self.expect_depth(max(depth, 0), within=1e-8)

    def terrain(self, name, text, more=""):
        """A ball on ground of slope 0.2 along x, in a grid that begins at (7, 9)."""
        (self.dir / name).write_text(text)
        self.forget()
        self.wall("ground", f'shape = "terrain"\nfile = "{self.dir}/{name}"\norigin = [7, 9]\nazimuth_deg = 90\n'
                  f"datum = 0.1\nbottom = -3\nextent = [0.5, 0.5, 2.5, 2.5]\nresolution = 0.1\n{more}")
        self.body("ball", BALL)
        for depth in (1e-4, -1e-4):
            self.rows.clear()
            self.row(0, ((1.5, 1.5, 0.4 + 0.1 * math.hypot(1, 0.2) - depth * math.hypot(1, 0.2)), UPRIGHT))
            self.expect_depth(max(depth, 0), within=1e-8)

    def forget(self):
        self.case = self.case.split("[[wall]]")[0]
        self.names.clear()

    def test_terrains_of_points_and_of_grids_with_missing_cells(self):
        # Cells of 0.1 m in any order, with gaps beyond the extent: missing, nan or -9999.
        cells = [(i, j) for j in range(31) for i in range(31)]
        cells.sort(key=lambda c: (c[0] * 7 + c[1] * 11) % 31)
        def line(i, j, z):
            return f"{7 + 0.1 * i:.4f} {9 + 0.1 * j:.4f} {z}"
        rest = [line(i, j, 0.02 * i) for i, j in cells if (i, j) not in ((0, 0), (1, 0), (30, 30))]
        points = "\n".join([line(0, 0, "nan"), line(1, 0, -9999), *rest]) + "\n"
        self.terrain("p.xyz", points)
        self.terrain("p.csv", "X,Y,Z\n# places\n" + points.replace(" ", ","))
        for mark in ("nan", "NaN", "-9999"):
            rows = [[f"{0.02 * i}" for i in range(31)] for _ in range(31)]
            rows[0][0] = rows[30][30] = mark
            self.terrain("g.asc", "NCOLS 31\nNROWS 31\nXLLCENTER 7\nYLLCENTER 9\nCELLSIZE 0.1\n"
                         + "\n".join(map(" ".join, rows)) + "\n")

    def test_a_terrain_that_cannot_be_read_is_not_judged(self):
        good = "ncols 3\nnrows 2\nxllcenter 0\nyllcenter 0\ncellsize 1\n"
        for text in ("", "MM\0*raster", "12 ncols\n", good + "1 2 3\n4 5\n", good + "1 2 3 4 5 six\n", good + "1 2 3 4 5 6 7\n",
                     good + "1 2 3 4 5 inf\n", good.replace("cellsize", "sellsize") + "1 2 3 4 5 6\n", "1 2 3\n1 3\n",
                     "0 0 1\n1.3 0.2 1\n2 1.1 1\n0.4 2 1\n", "0 0 1\n1 0 1\n2 0 1\n"):
            with self.subTest(text), self.assertRaisesRegex(AssertionError, "cannot read this grid"):
                self.terrain("bad.asc", text)

    def test_bodies_of_meshes_stand_about_their_centroid(self):
        mesh = prism([(0, 0), (0.4, 0), (0.4, 0.2), (0, 0.2)], 0.0, 0.3, 1.0)
        mesh.write(self.dir / "box.stl")
        self.wall("floor", PLANE)
        self.body("piece", f'shape = "mesh"\nfile = "{self.dir}/box.stl"')
        self.row(0, ((0, 0, 0.05 + 0.1 - 3e-5), UPRIGHT))
        self.expect_depth(3e-5, within=1e-8)

    def test_bodies_of_particles(self):
        points = [(0, 0, 0), (0.1, 0, 0), (0.2, 0, 0), (0, 0, 0.1)]
        (self.dir / "p.txt").write_text("".join("%r %r %r\n" % p for p in points))
        self.wall("floor", PLANE)
        self.body("piece", f'shape = "particles"\nfile = "{self.dir}/p.txt"\nspacing = 0.1')
        self.row(0, ((0, 0, 0.05 + 0.025 + 0.05 - 1e-5), UPRIGHT))
        self.expect_depth(1e-5)

    def test_bodies_of_meshes_that_are_not_convex(self):
        # An L of cells of 0.1 m, upright: a ball in its notch is free, on its arm and post it is not.
        a = 0.1
        mesh = prism([(a, a), (4 * a, a), (4 * a, 0), (0, 0), (0, 3 * a), (a, 3 * a)], 0.0, 2 * a)
        mesh.write(self.dir / "l.stl")
        centre = [(4 * 2 * a + 2 * 0.5 * a) / 6, a, (4 * 0.5 * a + 2 * 2 * a) / 6]
        self.body("l", f'shape = "mesh"\nfile = "{self.dir}/l.stl"\nspacing = {a}', )
        self.body("ball", 'shape = "sphere"\nradius = 0.05')
        for at, depth in (((2 * a, a, 2 * a), 0), ((3 * a, a, 1.5 * a - 1e-5), 1e-5), ((1.5 * a - 2e-5, a, 2 * a), 2e-5)):
            self.rows.clear()
            self.row(0, (centre, UPRIGHT), (at, UPRIGHT))
            self.expect_depth(depth, within=1e-7)

    def test_two_dimensions(self):
        self.case = self.case.replace("dimensions = 3", "dimensions = 2")
        self.body("disc", BALL)
        self.body("square", 'shape = "box"\nsize = [0.2, 1, 0.2]')
        # A corner of the square points at the disc along x.
        reach = 0.1 * math.sqrt(2)
        self.row(0, ((0, 0, 0), UPRIGHT), ((reach + 0.1 - 4e-5, 0, 0), about((0, 1, 0), 45)))
        self.expect_depth(4e-5)

    def test_held_bodies_may_stand_in_walls(self):
        self.wall("floor", PLANE)
        self.body("post", BALL + "\nfixed = true")
        self.row(0, ((0, 0, 0), UPRIGHT))
        self.expect_depth(0)

    def test_a_program_that_hides_an_overlap_is_found_out(self):
        self.wall("floor", PLANE)
        self.body("ball", BALL)
        self.row(0, ((0, 0, 0.15 - 1e-3), UPRIGHT))
        self.summary = {"contact": {"worst_penetration": 1e-3}}
        self.judge("--agreement", 1e-6, code=0)
        self.summary = {"contact": {"worst_penetration": 1e-5}}
        self.judge("--agreement", 1e-6, code=1)

    def test_random_pairs_of_known_depth(self):
        done = subprocess.run([WITNESS, "--self-test"], capture_output=True, text=True, timeout=100)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(len(json.loads(done.stdout)["self_test"]), 40)


class Books(Folder):
    def energy(self, *rows):
        (self.dir / "energy.csv").write_text(
            "# units\ntime,body_kinetic,momentum_x,momentum_y,momentum_z,wall_impulse_x,wall_impulse_y,"
            "wall_impulse_z,gravity_impulse_x,gravity_impulse_y,gravity_impulse_z\n"
            + "".join(",".join(repr(float(n)) for n in row) + "\n" for row in rows))

    def test_masses_inertia_and_momentum(self):
        # Of a turned box, a log and a ball that move and spin, against numbers by hand.
        shapes = {"box": (BOX, 500 * 0.024, lambda m: (m * 0.13 / 12, m * 0.2 / 12, m * 0.25 / 12)),
                  "log": (LOG, 500 * math.pi * 0.005, lambda m: (m * 0.005, *[m * (0.03 + 0.25) / 12] * 2)),
                  "ball": (BALL, 500 * 4 / 3 * math.pi * 1e-3, lambda m: (0.4 * m * 0.01,) * 3)}
        for name, (lines, m, inertia) in shapes.items():
            with self.subTest(name):
                self.setUp()
                self.body(name, lines)
                q, own = about((0.6, 0, 0.8), 77), (1.0, -2.0, 3.0)
                kinetic = m * 4.5 + sum(i * w * w for i, w in zip(inertia(m), own)) / 2
                self.row(0, ((0, 0, 1), q, (2, 1, -2), turned(q, own)))
                self.energy((0, kinetic, 2 * m, m, -2 * m, *[0] * 6))
                books = self.judge("--momentum", 1e-12, code=0)["books"]
                self.assertLess(books["kinetic_energy_error"], 1e-12)
                self.energy((0, kinetic * 1.001, 2 * m, m, -2 * m, *[0] * 6))
                self.judge("--momentum", 1e-6, code=1)
                self.energy((0, kinetic, 2.001 * m, m, -2 * m, *[0] * 6))
                self.judge("--momentum", 1e-6, code=1)

    def test_a_body_that_is_not_convex(self):
        # An L of twelve cells against the cells themselves.
        a = 0.05
        mesh = prism([(a, a), (4 * a, a), (4 * a, 0), (0, 0), (0, 3 * a), (a, 3 * a)], 0.0, 2 * a)
        mesh.write(self.dir / "l.stl")
        cells = [(i, j, k) for i, k in [(0, 0), (1, 0), (2, 0), (3, 0), (0, 1), (0, 2)] for j in (0, 1)]
        centre = [sum(c[k] + 0.5 for c in cells) / len(cells) for k in range(3)]
        m = 500 * a ** 3
        about_y = sum(m * (a * a / 6 + a * a * sum((c[k] + 0.5 - centre[k]) ** 2 for k in (0, 2))) for c in cells)
        self.body("l", f'shape = "mesh"\nfile = "{self.dir}/l.stl"')
        self.row(0, ((0, 0, 1), UPRIGHT, (0, 0, 0), (0, 3.0, 0)))
        self.energy((0, about_y * 4.5, 0, 0, 0, *[0] * 6))
        self.judge("--momentum", 1e-6, code=0)

    def test_energy_from_nothing(self):
        # A ball falls from 1 m, loses energy, and gains some of it again, within what it had.
        self.body("ball", BALL)
        for t, z, v in ((0, 1.0, 0.0), (0.1, 0.8, math.sqrt(2 * G * 0.2)), (0.2, 0.2, 0.5), (0.3, 0.2, 0.6)):
            self.row(t, ((0, 0, z), UPRIGHT, (0, 0, v)))
        books = self.judge("--energy", 1e-6, "--rise", 0.008, code=0)["books"]
        self.assertAlmostEqual(books["energy_rise"], (0.18 - 0.125) / (G * 0.8), delta=1e-12)
        self.assertEqual(books["rise_time"], 0.3)
        self.judge("--energy", 1e-6, "--rise", 0.007, code=1)
        self.row(0.4, ((0, 0, 1.0), UPRIGHT, (0, 0, 0.1)))
        self.assertAlmostEqual(self.judge("--energy", 1e-6, code=1)["books"]["energy_growth"], 0.005 / (G * 0.8),
                               delta=1e-12)

    def test_what_is_driven_is_not_judged(self):
        self.wall("piston", PLANE + "\n[wall.motion]\nvelocity = [0, 0, 1]")
        self.body("ball", BALL)
        self.row(0, ((0, 0, 5), UPRIGHT))
        self.row(1, ((0, 0, 9), UPRIGHT))
        self.assertFalse(self.judge("--energy", 1e-6, code=0)["books"]["energy_judged"])


class Fluid(unittest.TestCase):
    """Runs of the program, whose case is then changed under the results."""

    CASE = """
title = "a block of water"
[time]
end = 0.02
[particles]
spacing = 0.1
[fluid]
[[fluid.block]]
shape = "box"
min = [0, 0, 0]
max = [1, 0.5, 0.5]
[[wall]]
name = "basin"
shape = "basin"
min = [0, 0, 0]
max = [1, 0.5, 1]
open = ["+z"]
"""
    BODY = '[[body]]\nname = "float"\nshape = "box"\nsize = [0.3, 0.3, 0.3]\ndensity = 500\nposition = [0.5, 0.25, 0.7]\n'

    def setUp(self):
        self.place = tempfile.TemporaryDirectory()
        self.dir = pathlib.Path(self.place.name)
        self.keep = ()  # of summary.json

    def tearDown(self):
        self.place.cleanup()

    def run_case(self, text):
        (self.dir / "case.toml").write_text(text)
        subprocess.run([HYORYU, "run", "case.toml", "-o", "out", "--threads", "1", "--quiet", "--force"],
                       cwd=self.dir, check=True, capture_output=True)

    def judge(self, *options, code):
        if "worst_particles_in_solids" not in self.keep:
            path = self.dir / "out/summary.json"
            summary = json.loads(path.read_text())
            summary.pop("worst_particles_in_solids", None)  # of the case as it was run
            path.write_text(json.dumps(summary))
        done = subprocess.run([WITNESS, self.dir / "out", *map(str, options)], capture_output=True, text=True)
        self.assertEqual(done.returncode, code, done.stderr)
        return json.loads(done.stdout)["fluid"]

    def add(self, lines):
        with open(self.dir / "out/case.toml", "a") as file:
            file.write(f'\n[[wall]]\nname = "added"\n{lines}\n')

    def test_a_sound_run_passes(self):
        self.run_case(self.CASE + self.BODY)
        found = self.judge("--inside", 0, "--lost", 0, "--momentum", 1e-6, code=0)
        self.assertGreater(found["frames"], 2)

    def test_particles_in_every_kind_of_solid_are_counted(self):
        # The particles of the first frame stand in the middle of cells of 0.1 m: deeper than a quarter of that.
        self.run_case(self.CASE.replace("end = 0.02", "end = 1e-4"))
        mesh = prism([(0.1, 0.1), (0.4, 0.1), (0.4, 0), (0, 0), (0, 0.4), (0.1, 0.4)], 0.0, 0.5)
        mesh.write(self.dir / "l.stl")
        placed = "position = [0.5, 0.25, 0.25]\nrotation = [1, 0, 0, 0]"
        for lines, count, deepest in (
                (f'shape = "box"\nsize = [0.4, 0.2, 0.3]\n{placed}', 4 * 1 * 3, 0.1),
                ('shape = "plane"\npoint = [0, 0, 0.09]\nnormal = [0, 0, 1]', 50, 0.04),
                ('shape = "plane"\npoint = [0, 0, 0.07]\nnormal = [0, 0, 1]', 0, 0.02),
                ('shape = "sphere"\nradius = 0.17\nposition = [0.55, 0.25, 0.25]', 19, 0.17),
                ('shape = "cylinder"\nradius = 0.13\nlength = 0.3\nposition = [0.5, 0.25, 0.25]', 2 * 5, 0.1),
                (f'shape = "mesh"\nfile = "{self.dir}/l.stl"\nposition = [0, 0, 0]', 7 * 5, 0.05)):
            with self.subTest(lines):
                before = (self.dir / "out/case.toml").read_text()
                self.add(lines)
                found = self.judge("--inside", count, code=0)
                self.assertEqual(found["in_solids_worst"], count)
                self.assertAlmostEqual(found["deepest"], deepest, delta=1e-5)
                if count > 0:
                    self.judge("--inside", count - 1, code=1)
                (self.dir / "out/case.toml").write_text(before)

    def test_water_in_a_pit_of_a_terrain(self):
        # The grid alone would bury the water of the pit, whose edges run through points of the surface or between them.
        rows = "\n".join(" ".join(["0.45"] * 15) for _ in range(15))
        (self.dir / "flat.asc").write_text(f"ncols 15\nnrows 15\nxllcenter 0\nyllcenter 0\ncellsize 0.1\n{rows}\n")
        for low, high in ((0.2, 0.8), (0.23, 0.78)):
            ring = f"[[{low}, {low}, 0], [{high}, {low}, 0], [{high}, {high}, 0], [{low}, {high}, 0]]"
            self.run_case(f"""
[time]
end = 0.02
[particles]
spacing = 0.05
[fluid]
[[fluid.block]]
shape = "box"
min = [0.1, 0.1, -0.2]
max = [0.9, 0.9, 0.3]
[[wall]]
shape = "terrain"
file = "flat.asc"
origin = [0.2, 0.2]
azimuth_deg = 90
extent = [0, 0, 1, 1]
resolution = 0.1
[[wall.level]]
z = 0.0
corners = {ring}
""")
            found = self.judge("--inside", 0, "--lost", 0, code=0)
            self.assertEqual(found["in_solids_worst"], 0)

    def test_a_program_that_counts_none_inside_is_found_out(self):
        self.run_case(self.CASE.replace("end = 0.02", "end = 1e-4"))
        self.add('shape = "box"\nsize = [0.4, 0.2, 0.3]\nposition = [0.5, 0.25, 0.25]')
        summary = json.loads((self.dir / "out/summary.json").read_text())
        for told, code in ((12, 0), (0, 1)):
            summary["worst_particles_in_solids"] = told
            self.keep = ("worst_particles_in_solids",)
            (self.dir / "out/summary.json").write_text(json.dumps(summary))
            self.judge("--inside", 12, code=code)

    def test_bodies_hold_no_fluid(self):
        self.run_case((self.CASE + self.BODY).replace("end = 0.02", "end = 1e-4"))
        text = (self.dir / "out/bodies.csv").read_text()
        (self.dir / "out/bodies.csv").write_text(text.replace(",0.25,0.7,", ",0.25,0.35,"))
        found = self.judge("--inside", 0, code=1)
        self.assertEqual(found["solid"], "float")
        self.assertEqual(found["in_solids_worst"], 2 * 3 * 3)

    def test_particles_that_leave_are_lost(self):
        # Water runs out of an open side and below the domain.
        text = self.CASE.replace('["+z"]', '["+z", "+x"]').replace("end = 0.02", "end = 1.2")
        self.run_case(text + "[domain]\nmin = [-0.5, 0, -0.5]\nmax = [1.3, 0.5, 2]\n")
        lost = json.loads((self.dir / "out/summary.json").read_text())["particles_lost"]
        self.assertGreater(lost, 0)
        self.assertEqual(self.judge("--lost", 0, code=1)["lost"], lost)

    def test_momentum_is_compared(self):
        self.run_case(self.CASE + self.BODY)
        lines = (self.dir / "out/energy.csv").read_text().splitlines()
        cells = lines[-1].split(",")
        column = lines[1].split(",").index("momentum_z")
        cells[column] = repr(float(cells[column]) * 1.01)
        (self.dir / "out/energy.csv").write_text("\n".join([*lines[:-1], ",".join(cells)]) + "\n")
        self.judge("--momentum", 1e-6, code=1)


if __name__ == "__main__":
    unittest.main(verbosity=2)
