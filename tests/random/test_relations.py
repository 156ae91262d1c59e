#!/usr/bin/env python3
"""Relations between runs of shipped cases: what a shift, a turn, a mirror or a body more must not change.

Usage: test_relations.py PATH_TO_HYORYU [NAME...]"""
import csv
import pathlib
import subprocess
import sys
import tempfile
import unittest

HYORYU = str(pathlib.Path(sys.argv.pop(1)).resolve())
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from move import Frame, distance, move, read, to_toml  # noqa: E402
from pieces import Dice, about  # noqa: E402

CASES = pathlib.Path(__file__).resolve().parents[2] / "cases"
# Contact alone. Until when, and how far a body may then be from where it is in the shipped frame [m]:
# round-off of places about a metre, 1e-16, that impacts and rubbing carry on; a shift of frame changes
# which contact the solver takes first, and it leaves up to 1e-6 of the change of speed that is asked for
# where bodies rub.
DRY = {
    "bouncing_box": (0.6, 1e-11),
    "corner_drop": (0.375, 1e-11),
    "cradle": (0.5, 1e-11),
    "falling_timber": (0.6, 1e-11),
    "hard_heavy_on_light": (0.2, 1e-9),
    "hard_jamming_rod": (0.2, 1e-9),
    "proof_tilt": (0.6, 1e-11),
    "skid_to_roll": (0.5, 1e-9),
    "sliding_box": (0.5, 1e-9),
    "slope": (0.5, 1e-9),
    "stack": (0.3, 1e-10),
    "tilted_box": (0.35, 1e-11),
}
# With water: settings, and how far energies may then differ, over their sum.
WET = {
    "dam_break": (["particles.spacing=0.005715", "time.end=0.1"], 1e-4),
    "floating_box": (["particles.spacing=0.05", "time.end=0.2"], 1e-4),
    "hard_closing_boxes": (["time.end=0.02"], 1e-4),  # later a jet multiplies round-off
}


class Relations(unittest.TestCase):
    def setUp(self):
        self.place = tempfile.TemporaryDirectory()
        self.dir = pathlib.Path(self.place.name)

    def tearDown(self):
        self.place.cleanup()

    def run_case(self, case, *settings):
        out = self.dir / f"out{len(list(self.dir.iterdir()))}"
        words = [w for s in settings for w in ("--set", s)]
        done = subprocess.run([HYORYU, "run", case, "-o", out, "--threads", "1", "--quiet", *words],
                              capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, 0, done.stderr)
        return out

    def base(self, name, *settings):
        out = self.run_case(CASES / name / "case.toml", *settings)
        case = read(out / "case.toml")
        case.pop("gauge", None)
        return out, case

    def run_moved(self, case):
        path = self.dir / f"moved{len(list(self.dir.iterdir()))}.toml"
        path.write_text(to_toml(case))
        return self.run_case(path)

    def last(self, out, name):
        with open(out / name) as file:
            rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
        return [r for r in rows if r["time"] == rows[-1]["time"]]

    def places(self, out):
        return {r["body"]: tuple(float(r[k]) for k in "xyz") for r in self.last(out, "bodies.csv")}

    def expect_places(self, name, base, other, frame, bound):
        found = self.places(other)
        for body, x in self.places(base).items():
            self.assertLessEqual(distance(frame.place(x), found[body]), bound, f"{name}: {body}")

    def expect_frame(self, frame_of):
        for name, (end, bound) in DRY.items():
            with self.subTest(name):
                base, case = self.base(name, f"time.end={end}")
                frame = frame_of(Dice(sum(map(ord, name))), case)
                self.expect_places(name, base, self.run_moved(move(case, frame)), frame, bound)

    def test_contact_shifted(self):
        self.expect_frame(lambda d, case: Frame(shift=tuple(d.between(-1, 1) for _ in range(3))))

    def test_contact_turned(self):
        self.expect_frame(lambda d, case: Frame(turn=quarter(d) if has_basin(case) else d.turn()))

    def test_contact_mirrored(self):
        self.expect_frame(lambda d, case: Frame(mirror=True))

    def test_a_body_far_away_changes_nothing(self):
        far = {"name": "far", "shape": "sphere", "radius": 0.1, "density": 500.0, "position": [20.0, 20.0, 20.0]}
        for name, (end, bound) in DRY.items():
            with self.subTest(name):
                base, case = self.base(name, f"time.end={end}")
                case["body"].append(far)
                self.expect_places(name, base, self.run_moved(case), Frame(), bound)

    def test_a_cube_beside_changes_nothing(self):
        # It stands on the same ground, near enough for the broad phase and never touched; up to forty of them.
        for count in (1, 11, 40):
            with self.subTest(count):
                base, case = self.base("stack", "time.end=0.3")
                edge = 0.05
                for k in range(count):
                    at = [0.2 + (edge + 0.001) * (k % 10), 0.2 + (edge + 0.001) * (k // 10), edge / 2]
                    case["body"].append({"name": f"beside{k}", "shape": "box", "size": [edge] * 3, "density": 500.0,
                                         "position": at})
                self.expect_places("stack", base, self.run_moved(case), Frame(), 1e-10)

    def test_cubes_beside_a_falling_cube_change_nothing(self):
        # They fall flat beside it, 1 mm apart, each bouncing as it does.
        for count in (1, 4, 20):
            with self.subTest(count):
                base, case = self.base("bouncing_box", "time.end=0.6", "output.history_every=0")
                first = case["body"][0]
                for k in range(count):
                    x, y, z = first["position"]
                    at = [x + (k + 1) * (first["size"][0] + 0.001), y, z]
                    case["body"].append({**first, "name": f"beside{k}", "position": at})
                self.expect_places("bouncing_box", base, self.run_moved(case), Frame(), 1e-6)

    def expect_energies(self, frame_of):
        for name, (settings, bound) in WET.items():
            with self.subTest(name):
                base, case = self.base(name, *settings)
                frame = frame_of(Dice(len(name)), case)
                other = self.run_moved(move(case, frame))
                a, b = (self.last(out, "energy.csv")[0] for out in (base, other))
                kinds = ("fluid_kinetic", "fluid_internal", "body_kinetic")
                scale = sum(abs(float(a[k])) for k in kinds)
                for kind in kinds:  # potential energies depend on the origin
                    self.assertLessEqual(abs(float(a[kind]) - float(b[kind])), bound * scale, f"{name} {kind}")

    def test_water_shifted_by_a_part_of_a_spacing(self):
        self.expect_energies(lambda d, case: Frame(shift=tuple(
            d.between(0, 1) * case["particles"]["spacing"] * (k != 1) for k in range(3))))

    def test_water_mirrored(self):
        self.expect_energies(lambda d, case: Frame(mirror=True))


def has_basin(case):
    return any(w["shape"] in ("basin", "round_basin") for w in case.get("wall", []))


def quarter(dice):
    return about((0, 0, 1), 90 * (1 + dice.below(3)))


if __name__ == "__main__":
    unittest.main(verbosity=2)
