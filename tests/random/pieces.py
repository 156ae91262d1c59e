"""Numbers, turns and shapes of which scenes are drawn at random."""
import math
import struct


class Dice:
    """Numbers from a seed: the generator of Steele, Lea and Flood (2014)."""

    def __init__(self, seed):
        self.state = seed * 0x2545F4914F6CDD1D & (1 << 64) - 1

    def between(self, low, high):
        self.state = self.state + 0x9E3779B97F4A7C15 & (1 << 64) - 1
        z = self.state
        z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9 & (1 << 64) - 1
        z = (z ^ z >> 27) * 0x94D049BB133111EB & (1 << 64) - 1
        return low + (high - low) * ((z ^ z >> 31) >> 11) * 2.0 ** -53

    def chance(self, share):
        return self.between(0, 1) < share

    def below(self, count):
        return min(int(self.between(0, count)), count - 1)

    def one_of(self, things):
        return things[self.below(len(things))]

    def by_ratio(self, low, high):
        return low * (high / low) ** self.between(0, 1)

    def direction(self):
        z = self.between(-1, 1)
        angle = self.between(0, 2 * math.pi)
        r = math.sqrt(1 - z * z)
        return (r * math.cos(angle), r * math.sin(angle), z)

    def turn(self):
        return about(self.direction(), self.between(0, 360))


def about(axis, degrees):
    """The quaternion (w, x, y, z) of a turn about an axis of unit length."""
    half = math.radians(degrees) / 2
    return (math.cos(half), *(math.sin(half) * a for a in axis))


def after(p, q):
    """The turn q followed by the turn p."""
    a, b, c, d = p
    e, f, g, h = q
    return (a * e - b * f - c * g - d * h, a * f + b * e + c * h - d * g,
            a * g - b * h + c * e + d * f, a * h + b * g - c * f + d * e)


def turned(q, v):
    w, x, y, z = after(after(q, (0.0, *v)), (q[0], -q[1], -q[2], -q[3]))
    return (x, y, z)


def plus(a, b, scale=1.0):
    return tuple(i + scale * j for i, j in zip(a, b))


def single(x):
    """The number in single precision, as mesh files and their readers hold it."""
    return struct.unpack("f", struct.pack("f", x))[0]


def minus(a, b):
    return plus(a, b, -1.0)


def dot(a, b):
    return sum(i * j for i, j in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


class Mesh:
    """A closed surface of triangles that wind outwards."""

    def __init__(self, corners, triangles):
        self.corners = [tuple(single(x) for x in c) for c in corners]
        self.triangles = triangles
        if self.moments()[0] < 0:
            self.triangles = [t[::-1] for t in triangles]

    def moments(self):
        """Six times the volume, and the first moments with it."""
        volume, first = 0.0, (0.0, 0.0, 0.0)
        for t in self.triangles:
            a, b, c = (self.corners[k] for k in t)
            v = dot(a, cross(b, c))
            volume += v
            first = plus(first, plus(plus(a, b), c), v / 4)
        return volume, first

    def centroid(self):
        volume, first = self.moments()
        return tuple(x / volume for x in first)

    def write(self, path):
        with open(path, "wb") as file:
            file.write(b"drawn at random".ljust(80) + struct.pack("<I", len(self.triangles)))
            for t in self.triangles:
                file.write(struct.pack("<3f", 0, 0, 0))
                for k in t:
                    file.write(struct.pack("<3f", *self.corners[k]))
                file.write(struct.pack("<H", 0))


def prism(section, low, high, shrink=1.0):
    """Over a polygon in x and z from y = low to high, its far end shrunk about the origin. The caps are
    fans from the first corner, which must see all others."""
    n = len(section)
    corners = [(x, low, z) for x, z in section] + [(shrink * x, high, shrink * z) for x, z in section]
    triangles = []
    for k in range(n):
        m = (k + 1) % n
        triangles += [(k, k + n, m + n), (k, m + n, m)]
    for k in range(1, n - 1):
        triangles += [(0, k, k + 1), (n, n + k + 1, n + k)]
    return Mesh(corners, triangles)


def regular(count, radius, phase=0.0):
    return [(radius * math.cos(phase + 2 * math.pi * k / count), radius * math.sin(phase + 2 * math.pi * k / count))
            for k in range(count)]


def bumps(dice, cells, edge, height, depth):
    """Ground of random heights on a lattice of cells x cells squares about the origin, with a flat bottom."""
    n = cells + 1
    top = [[dice.between(0, height) for _ in range(n)] for _ in range(n)]
    at = [edge * (k / cells - 0.5) for k in range(n)]
    corners = [(at[i], at[j], top[i][j]) for i in range(n) for j in range(n)]
    corners += [(at[i], at[j], -depth) for i in range(n) for j in range(n)]
    return Mesh(corners, _closed_lattice(cells))


def _closed_lattice(cells):
    n = cells + 1
    below = n * n
    triangles = []
    for i in range(cells):
        for j in range(cells):
            a, b, c, d = i * n + j, (i + 1) * n + j, (i + 1) * n + j + 1, i * n + j + 1
            triangles += [(a, b, c), (a, c, d), (below + a, below + c, below + b), (below + a, below + d, below + c)]
    rim = [i * n for i in range(n)] + [cells * n + j for j in range(1, n)]
    rim += [i * n + cells for i in range(cells - 1, -1, -1)] + [j for j in range(cells - 1, 0, -1)]
    for k, a in enumerate(rim):
        b = rim[(k + 1) % len(rim)]
        triangles += [(a, below + a, b), (b, below + a, below + b)]
    return triangles
