#!/usr/bin/env python3
"""Checks that the objects of different instruction sets define no function twice.

Usage: scripts/check_dispatch.py NM OBJECT...; objects of one set have its name in their path, as in
`hyoryu_fluid_32`, all others are for any machine: those with packs of their own are given as well.
The linker keeps one of several weak definitions; were it that of a wider set, the program would stop
on machines without that set. Data are shared, and have to be: fields are known by their addresses.
"""
import collections
import re
import subprocess
import sys

FUNCTIONS = "WTi"  # weak, global and indirect ones, as nm marks them
SET = re.compile(r"hyoryu_\w+_(\d+)\.dir")


def shared_symbols(nm, objects):
    sets = collections.defaultdict(set)
    for path in objects:
        text = subprocess.run([nm, "--defined-only", path], check=True, capture_output=True,
                              text=True).stdout
        for line in text.splitlines():
            kind, name = line.split()[-2:]
            if kind in FUNCTIONS:
                found = SET.search(path)
                sets[name].add(found[1] if found else "any machine")
    return sorted(name for name, found in sets.items() if len(found) > 1)


def main():
    shared = shared_symbols(sys.argv[1], sys.argv[2:])
    for name in shared:
        print(f"{name} is defined for several instruction sets")
    if not shared:
        print(f"dispatch: {len(sys.argv) - 2} objects share no function")
    return 1 if shared else 0


if __name__ == "__main__":
    sys.exit(main())
