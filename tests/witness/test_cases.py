#!/usr/bin/env python3
"""What the witness says of every shipped case: contact alone in full, with water some steps.

Usage: test_cases.py PATH_TO_WITNESS PATH_TO_HYORYU [CASE...]; HYORYU_FULL=1 runs every case to its end."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

WITNESS, HYORYU = (str(pathlib.Path(a).resolve()) for a in sys.argv[1:3])
CASES = pathlib.Path(__file__).resolve().parents[2] / "cases"
STEPS = 10  # of a case with water
ROWS = 40000  # of bodies.csv, of a case without
# The witness looks at every particle and every triangle: two minutes for a terrain of 35,000 triangles.
COARSER = {"port": "particles.spacing=2"}
# Cases that are to go beyond a bound, and why.
EXPECTED = {
}


def call(*arguments):
    environment = {**os.environ, "OMP_WAIT_POLICY": "passive"}
    return subprocess.run([str(a) for a in arguments], capture_output=True, text=True, env=environment)


def bounds_of(plan):
    step = plan["time_step"]["first"]
    # Energy over an earlier row: see scripts/random_scenes.
    overlap = 1e-5 * max(1.0, step / 1e-3) ** 1.43  # 1e-5 m at 1 ms, 1e-4 m at 5 ms
    bounds = ["--overlap", overlap, "--inside", 0, "--energy", 1e-6, "--rise", 1e-5, "--agreement", 1e-6]
    # Through open sides fluid comes and goes, and frames lack the carpets, whose momentum energy.csv
    # has: `open_failures` looks at the counts and the closure in their place.
    return bounds if "open" in plan else bounds + ["--lost", 0, "--momentum", 1e-6]


def open_failures(folder):
    summary = json.loads((pathlib.Path(folder) / "summary.json").read_text())
    wrong = []
    if summary["open"]["unaccounted_particles"] != 0:
        wrong.append(f"{summary['open']['unaccounted_particles']} particles are not accounted for")
    if summary["momentum"]["worst_closure_of_a_step"] > 2e-7:  # as in tests/sim/test_cases.cpp
        wrong.append(f"momentum closes to {summary['momentum']['worst_closure_of_a_step']}")
    return wrong


def judge(name, folder):
    case = CASES / name / "case.toml"
    coarser = ["--set", COARSER[name]] if name in COARSER and not os.environ.get("HYORYU_FULL") else []
    plan = json.loads(call(HYORYU, "check", case, "--json", *coarser).stdout)
    step = plan["time_step"]["first"]
    settings = ["--set", "output.history_every=0", *coarser]
    wet = plan["counts"]["fluid"] > 0
    steps = STEPS if wet else ROWS // max(1, plan["counts"]["bodies"])
    if steps < plan["time_step"]["steps"] and not os.environ.get("HYORYU_FULL"):
        end = steps * step
        settings += ["--set", f"time.end={end:.17g}", "--set", f"output.every={end / 2 if wet else end:.17g}"]
    ran = call(HYORYU, "run", case, "-o", folder, "--quiet", "--threads", 1, *settings)
    failures = [] if ran.returncode == 0 else [f"run: exit {ran.returncode}: {ran.stderr.strip()[:200]}"]
    said = call(WITNESS, folder, *bounds_of(plan))
    if said.returncode == 2:
        return failures + [said.stderr.strip()]
    failures += open_failures(folder) if "open" in plan and not failures else []
    return failures + json.loads(said.stdout)["failures"]


def main():
    names = sys.argv[3:] or sorted(p.parent.name for p in CASES.glob("*/case.toml"))
    wrong = 0
    for name in names:
        began = time.time()
        with tempfile.TemporaryDirectory() as folder:
            failures = judge(name, folder)
        if name in EXPECTED:
            verdict = "as expected" if failures else "PASSES although it is expected to fail: " + EXPECTED[name]
        else:
            verdict = "FAILS: " + "; ".join(failures) if failures else "sound"
        wrong += verdict not in ("sound", "as expected")
        print(f"{name:<28} {time.time() - began:5.1f} s  {verdict}", flush=True)
    return int(wrong > 0)


if __name__ == "__main__":
    sys.exit(main())
