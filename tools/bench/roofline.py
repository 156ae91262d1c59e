#!/usr/bin/env python3
"""Draws the roofline of one thread from a result of `hyoryu bench --json`: what the machine can do with
so many operations for each byte from memory, and where the pair loops stand.

Usage: roofline.py RESULTS.json PICTURE.svg
"""
import json
import math
import pathlib
import sys

WIDTH, HEIGHT = 720, 440
LEFT, RIGHT, TOP, BOTTOM = 70, 20, 30, 55
X_RANGE, Y_RANGE = (0.125, 128.0), (1.0, 256.0)  # flop/B, Gflop/s
COLOURS = {"single": "#1f5fa8", "double": "#b3541e"}


def x_of(value):
    low, high = map(math.log2, X_RANGE)
    return LEFT + (math.log2(value) - low) / (high - low) * (WIDTH - LEFT - RIGHT)


def y_of(value):
    low, high = map(math.log2, Y_RANGE)
    return HEIGHT - BOTTOM - (math.log2(value) - low) / (high - low) * (HEIGHT - TOP - BOTTOM)


def text(x, y, words, anchor="start", colour="#222", more=""):
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" fill="{colour}"{more}>{words}</text>'


def line(points, colour, more=""):
    path = " ".join(f"{x_of(x):.1f},{y_of(y):.1f}" for x, y in points)
    return f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="2"{more}/>'


def axes():
    parts = []
    for low_high, place in ((X_RANGE, "x"), (Y_RANGE, "y")):
        value = low_high[0]
        while value <= low_high[1]:
            label = f"{value:g}"
            if place == "x":
                x = x_of(value)
                parts.append(f'<path d="M{x:.1f} {TOP}V{HEIGHT - BOTTOM}" stroke="#ddd"/>')
                parts.append(text(x, HEIGHT - BOTTOM + 18, label, "middle"))
            else:
                y = y_of(value)
                parts.append(f'<path d="M{LEFT} {y:.1f}H{WIDTH - RIGHT}" stroke="#ddd"/>')
                parts.append(text(LEFT - 8, y + 4, label, "end"))
            value *= 2
    middle = (TOP + HEIGHT - BOTTOM) / 2
    parts.append(text((LEFT + WIDTH - RIGHT) / 2, HEIGHT - 12, "flop for each byte from memory", "middle"))
    parts.append(text(20, middle, "Gflop/s of one thread", "middle",
                      more=f' transform="rotate(-90 20 {middle:.1f})"'))
    return parts


def picture(document):
    limits = document["limits"]
    bandwidth = 1e-9 * limits["triad_bytes_per_second"]
    parts = axes()
    for precision, colour in COLOURS.items():
        peak = 1e-9 * limits[f"fma_{precision}"]
        parts.append(line([(X_RANGE[0], bandwidth * X_RANGE[0]), (peak / bandwidth, peak), (X_RANGE[1], peak)],
                          colour))
        parts.append(text(x_of(X_RANGE[1]) - 4, y_of(peak) - 6, f"{precision}: {peak:.0f} Gflop/s", "end", colour))
        for loop in document["loops"]:
            if loop["precision"] != precision:
                continue
            x = loop["flops_per_pair"] / loop["bytes_per_pair"]
            y = 1e-9 * loop["flops_per_pair"] * loop["all_terms_pairs_per_second"]
            filled = colour if loop["smoothing_ratio"] == 1.5 else "white"
            parts.append(f'<circle cx="{x_of(x):.1f}" cy="{y_of(y):.1f}" r="5" fill="{filled}"'
                         f' stroke="{colour}" stroke-width="2"/>')
    parts.append(text(x_of(1), y_of(bandwidth) - 6, f"memory: {bandwidth:.0f} GB/s", "end"))
    parts.append(text(LEFT, 18, "Pair loop over all terms (pressure, diffusion, continuity, viscosity): "
                                "filled h/dp 1.5, open h/dp 1.732"))
    body = "\n".join(parts)
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" '
            f'font-family="sans-serif" font-size="12">\n<rect width="100%" height="100%" fill="white"/>\n'
            f'{body}\n</svg>\n')


def main():
    document = json.loads(pathlib.Path(sys.argv[1]).read_text())
    pathlib.Path(sys.argv[2]).write_text(picture(document))
    return 0


if __name__ == "__main__":
    sys.exit(main())
