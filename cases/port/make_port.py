#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes the data of the case: the heights of the ground on a grid of 1 m, footprints of buildings,
outlines of the quay and of two yards, and a gauge of a regional model, all in map coordinates.
Nothing here is taken from a real place.

The axes of the case: x from the sea to the land, y along the quay, the origin at a corner. On the map
+x points 105 degrees clockwise from north.
"""
import json
import math
from pathlib import Path

ORIGIN = (378450.0, 4072310.0)
AZIMUTH = math.radians(105.0)
EAST = (math.sin(AZIMUTH), -math.cos(AZIMUTH))  # eastward parts of +x and +y
NORTH = (math.cos(AZIMUTH), math.sin(AZIMUTH))
FOLDER = Path(__file__).parent
CELL = 1.0
EXTENT = (-8.0, -8.0, 122.0, 68.0)  # of the ground that is needed, in the axes of the case [m]

HARBOUR = -6.0  # bed [m]
QUAY = 1.8      # level of the quay [m]
STILL = 0.0     # level of the sea [m]


def on_map(x, y):
    return (ORIGIN[0] + x * EAST[0] + y * EAST[1], ORIGIN[1] + x * NORTH[0] + y * NORTH[1])


def in_case(easting, northing):
    e, n = easting - ORIGIN[0], northing - ORIGIN[1]
    return e * EAST[0] + n * NORTH[0], e * EAST[1] + n * NORTH[1]


def height(x, y):
    """The ground: a harbour, a quay wall that the grid smears over 3 m, a yard, and land that rises."""
    wall = min(max((x - 38.5) / 3.0, 0.0), 1.0)
    land = 0.02 * max(x - 70.0, 0.0) + 0.12 * math.sin(0.21 * x) * math.sin(0.17 * y) * (x > 70.0)
    return HARBOUR + (QUAY - HARBOUR) * wall + land


def write_grid():
    corners = [on_map(x, y) for x in (EXTENT[0], EXTENT[2]) for y in (EXTENT[1], EXTENT[3])]
    west = math.floor(min(e for e, _ in corners)) - 2
    south = math.floor(min(n for _, n in corners)) - 2
    columns = math.ceil(max(e for e, _ in corners)) + 3 - west
    rows = math.ceil(max(n for _, n in corners)) + 3 - south
    lines = [f"ncols {columns}", f"nrows {rows}", f"xllcenter {west:.1f}", f"yllcenter {south:.1f}",
             f"cellsize {CELL:g}", "NODATA_value -9999"]
    for row in reversed(range(rows)):
        heights = (height(*in_case(west + column, south + row)) for column in range(columns))
        lines.append(" ".join(f"{z:.2f}" for z in heights))
    (FOLDER / "dem.asc").write_text("\n".join(lines) + "\n")


def ring(corners):
    points = [[round(v, 3) for v in on_map(x, y)] for x, y in corners]
    return points + points[:1]


def box(x, y, length, width):
    return [(x, y), (x + length, y), (x + length, y + width), (x, y + width)]


def feature(outline, **properties):
    return {"type": "Feature", "properties": properties,
            "geometry": {"type": "Polygon", "coordinates": [ring(outline)]}}


def write_outlines(name, features):
    text = json.dumps({"type": "FeatureCollection", "features": features}, indent=1)
    (FOLDER / name).write_text(text + "\n")


def write_gauge():
    """Level +5 m within 12 s, held for 6 s, back at 40 s; the velocity of a wave into water at rest."""
    g, depth = 9.81, STILL - HARBOUR
    lines = ["# gauge_id=   12 location=( 0.3784500000E+06 0.4072310000E+07 ) num_eqn=  4",
             "# Stationary gauge", "# level, time, q[  1], q[  2], q[  3], eta, aux[]"]
    for k in range(0, 81):
        t = 0.5 * k
        part = math.sin(math.pi * t / 24) if t < 12 else 1 if t < 18 else \
            math.cos(math.pi * (min(t, 40) - 18) / 44)
        eta = 5.0 * part * part
        h = depth + eta - STILL
        u = 0.92 * 2 * (math.sqrt(g * h) - math.sqrt(g * depth))
        lines.append(f"{1:5d} {1320 + t:15.7e} {h:15.7e} {h * u * EAST[0]:15.7e} "
                     f"{h * u * NORTH[0]:15.7e} {eta:15.7e}")
    (FOLDER / "gauge00012.txt").write_text("\n".join(lines) + "\n")


def main():
    write_grid()
    write_outlines("quay.geojson", [feature(box(40.0, -20.0, 28.0, 100.0), name="quay")])
    write_outlines("footprints.geojson", [
        feature(box(71.0, 4.0, 10.0, 13.0), id="store", height=7.0),
        feature([(72.0, 24.0), (80.0, 24.0), (80.0, 30.0), (86.0, 30.0), (86.0, 36.0), (72.0, 36.0)],
                id="office", height=9.0),
        feature(box(71.0, 43.0, 9.0, 12.0), id="workshop", height=6.0),
        feature(box(88.0, 6.0, 8.0, 10.0), id="house_1", height=5.0),
        feature(box(90.0, 21.0, 6.0, 7.0), id="house_2", height=5.0),
        feature(box(87.0, 44.0, 8.0, 9.0), id="house_3", height=5.0)])
    write_outlines("timber_yard.geojson", [feature(box(45.0, 33.0, 14.0, 22.0), name="timber yard")])
    write_outlines("car_park.geojson", [feature(box(60.0, 26.0, 8.0, 24.0), name="car park")])
    write_gauge()


if __name__ == "__main__":
    main()
