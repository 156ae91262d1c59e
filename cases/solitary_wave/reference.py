#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The wave that a piston makes in water without viscosity, by an equation of its own.

Equations of Serre (1953) and of Green and Naghdi (1976) for a layer of depth h and mean velocity u, along the
particles, with the mass coordinate m, dm = h dx:

    a = -dP/dm,    P = g h^2/2 + h^2/3 d2h/dt2,    d2h/dt2 = 2 h^3 (du/dm)^2 - h^2 da/dm

so that the accelerations a solve a system with three diagonals. The piston gives the first column its place.
Method of Runge and Kutta of fourth order. Their solitary wave is that of Rayleigh (1876).
Needs numpy and scipy. Prints, for both paddles of `piston`, the crest at the gauges over the height that is
asked for, and the speed of the front between them over sqrt(g (d + H)).

usage: reference.py [COLUMNS_PER_DEPTH]"""
import sys

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.linalg import solve_banded

GRAVITY = 9.81       # [m/s2]
DEPTH = 0.3          # [m]
HEIGHT = 0.06        # [m]
FLUME = 25.0         # [m], so long that nothing comes back
GAUGES = [3.0, 7.0]  # [m]
END = 7.0            # [s]
LAST_PHASE = 3.8     # at which the paddle starts and stops, after Goring


def paddle(theory):
    """Place, velocity and acceleration of the paddle over time."""
    high = DEPTH + HEIGHT if theory == "rayleigh" else DEPTH
    k = np.sqrt(3 * HEIGHT / (4 * DEPTH**2 * high))
    c = np.sqrt(GRAVITY * (DEPTH + HEIGHT))
    phase = np.linspace(-LAST_PHASE, LAST_PHASE, 2001)
    times = (phase + HEIGHT / DEPTH * np.tanh(phase)) / (k * c)
    times -= times[0]
    path = CubicSpline(times, HEIGHT / (k * DEPTH) * (np.tanh(phase) - np.tanh(phase[0])), bc_type="clamped")

    def at(t):
        t = min(t, times[-1])
        moves = t < times[-1]
        return float(path(t)), moves * float(path(t, 1)), moves * float(path(t, 2))

    return at


def accelerations(x, v, masses, of_paddle):
    """Accelerations of the edges of the columns; the last one is a wall."""
    h = masses / np.diff(x)
    gradient = np.diff(v) / masses
    stiffness = h**4 / (3 * masses)
    pressure = GRAVITY * h**2 / 2 + 2 * h**5 * gradient**2 / 3
    edges = (masses[1:] + masses[:-1]) / 2
    right = -np.diff(pressure)
    right[0] += stiffness[0] * of_paddle
    bands = np.zeros((3, len(edges)))
    bands[0, 1:] = -stiffness[1:-1]
    bands[1] = edges + stiffness[1:] + stiffness[:-1]
    bands[2, :-1] = -stiffness[1:-1]
    return np.concatenate([[of_paddle], solve_banded((1, 1), bands, right), [0]])


def run(theory, columns_per_depth):
    """Times, and heights over the still water at the gauges."""
    path = paddle(theory)
    columns = int(round(FLUME / DEPTH * columns_per_depth))
    x = np.linspace(0, FLUME, columns + 1)
    v = np.zeros(columns + 1)
    masses = np.full(columns, DEPTH * FLUME / columns)

    def rates(t, x, v):
        place, velocity, acceleration = path(t)
        x = np.concatenate([[place], x[1:]])
        v = np.concatenate([[velocity], v[1:]])
        return v, accelerations(x, v, masses, acceleration)

    step = 0.3 * FLUME / columns / np.sqrt(GRAVITY * (DEPTH + HEIGHT))
    times, heights = [], []
    for n in range(int(END / step)):
        t = n * step
        v1, a1 = rates(t, x, v)
        v2, a2 = rates(t + step / 2, x + step / 2 * v1, v + step / 2 * a1)
        v3, a3 = rates(t + step / 2, x + step / 2 * v2, v + step / 2 * a2)
        v4, a4 = rates(t + step, x + step * v3, v + step * a3)
        x = x + step / 6 * (v1 + 2 * v2 + 2 * v3 + v4)
        v = v + step / 6 * (a1 + 2 * a2 + 2 * a3 + a4)
        x[0], v[0], _ = path(t + step)
        times.append(t + step)
        heights.append(np.interp(GAUGES, (x[1:] + x[:-1]) / 2, masses / np.diff(x)) - DEPTH)
    return np.array(times), np.array(heights)


def crossing(times, heights, level):
    """When the height first reaches a level."""
    k = int(np.argmax(heights > level))
    return np.interp(level, heights[k - 1:k + 1], times[k - 1:k + 1])


def main():
    columns_per_depth = int(sys.argv[1]) if len(sys.argv) > 1 else 10
    for theory in ("boussinesq", "rayleigh"):
        times, heights = run(theory, columns_per_depth)
        near, far = heights.T
        speed = (GAUGES[1] - GAUGES[0]) / (crossing(times, far, HEIGHT / 2) - crossing(times, near, HEIGHT / 2))
        print(f"{theory}: crest {near.max() / HEIGHT:.4f} and {far.max() / HEIGHT:.4f}, "
              f"speed {speed / np.sqrt(GRAVITY * (DEPTH + HEIGHT)):.4f}")


if __name__ == "__main__":
    main()
