#!/usr/bin/env python3
"""Compares two results of `hyoryu bench --json`: rates now and before, and the same as shares of what
the machine could do in each run, which are what a busy or another machine leaves comparable.

Usage: compare_fluid.py NOW.json BEFORE.json
"""
import json
import pathlib
import sys


def rates(document):
    """Name of each rate: its value, and the limit of the same run that it is a share of."""
    limits = document["limits"]
    found = {}
    for loop in document["loops"]:
        peak = limits[f"fma_{loop['precision']}"]
        name = f"{loop['precision']}, h/dp {loop['smoothing_ratio']:g}, {loop['particles']}"
        for key, what in (("all_terms_pairs_per_second", "all terms"),
                          ("force_stage_pairs_per_second", "forces"),
                          ("rate_stage_pairs_per_second", "rates"),
                          ("lists_pairs_per_second", "lists")):
            found[f"{what}, {name} [pair/s]"] = (loop[key], peak)
    for group in ("steps", "sizes"):
        for row in document[group]:
            name = f"{row['scene']}, {row['fluid_particles']} fluid"
            found[f"steps, {name} [particle/s]"] = (row["particle_steps_per_second_one_thread"],
                                                    limits["fma_single"])
            found[f"bytes, {name} [B]"] = (row["bytes_per_particle"], None)
            found[f"efficiency, {name}"] = (row["efficiency"], None)
    return found


def main():
    now, before = (rates(json.loads(pathlib.Path(name).read_text())) for name in sys.argv[1:3])
    print(f"{'':<56}{'now':>12}{'before':>12}{'ratio':>8}{'of shares':>11}")
    for name, (value, limit) in now.items():
        if name in before:
            old, old_limit = before[name]
            of_shares = f"{value / limit * old_limit / old:>11.2f}" if limit else ""
            print(f"{name:<56}{value:>12.4g}{old:>12.4g}{value / old:>8.2f}{of_shares}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
