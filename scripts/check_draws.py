#!/usr/bin/env python3
"""Checks that no call of the tests has two arguments that draw random numbers: the order in which the arguments of a call
are computed is up to the compiler, and with it the scene. Between braces it is the written one.

Usage: scripts/check_draws.py [ROOT]; exit 1 and one line per call.
"""
import pathlib
import re
import sys

DRAWS = re.compile(r"\bdice\b|\b(?:draw|random|between|below|chance)\(")
IGNORED = re.compile(r'//[^\n]*|"(?:\\.|[^"\\\n])*"')
CALLED = re.compile(r"([\w>\]]+)\s*$")
NO_CALLS = {"if", "while", "for", "switch", "return", "between", "below", "chance"}


def calls(text):
    """The name, the line and the arguments of each call; strings and comments are blanks."""
    text = IGNORED.sub(lambda m: " " * len(m[0]), text)
    opened = []
    for k, sign in enumerate(text):
        if sign in "([{":
            opened.append((sign, [k]))
        elif sign == "," and opened:
            opened[-1][1].append(k)
        elif sign in ")]}" and opened:
            bracket, marks = opened.pop()
            name = CALLED.search(text[max(0, marks[0] - 80) : marks[0]])
            if bracket == "(" and name:
                ends = marks[1:] + [k]
                yield name[1], text.count("\n", 0, marks[0]) + 1, [text[a + 1 : b] for a, b in zip(marks, ends)]


def drawn(argument):
    """Whether an argument draws; one that is only the name of the dice, or a function that will, does not."""
    draws = DRAWS.search(argument)
    return draws and "(" in argument and not re.match(r"\s*\[[&=\w, ]*\]", argument)


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")
    found = 0
    for file in sorted([*root.glob("tests/**/*.cpp"), *root.glob("tests/**/*.hpp")]):
        for name, line, arguments in calls(file.read_text()):
            if name not in NO_CALLS and sum(1 for a in arguments if drawn(a)) > 1:
                print(f"{file.relative_to(root)}:{line}: {name}() draws in several arguments: draw before, or use braces")
                found += 1
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
