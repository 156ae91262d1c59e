#!/usr/bin/env python3
"""A scene drawn at random: case.toml, and the files of its meshes, from a seed.

    draw.py SEED FOLDER

Grounds (planes, boxes, meshes, slopes, steps, basins with rims) at any offset and turn, bodies of every
shape (1 to 60) that stand, are stacked, are thrown, float; water at rest and in bores; walls that move;
steps of 0.5 to 5 ms, or adaptive with water."""
import pathlib
import sys

from bodies import any_body, box, cylinder, flat_box
from pieces import Dice, about, after, bumps, cross, plus, turned

DRY_KINDS = ["box", "box", "cylinder", "cylinder", "hull", "angle", "cubes", "ball"]


def vector(v):
    return "[" + ", ".join(repr(float(x)) for x in v) + "]"


class Pad:
    """A flat place: its middle, the turn of its axes (z up from it) and its half edges."""

    def __init__(self, middle, turn, a, b):
        self.middle, self.turn, self.a, self.b = middle, turn, a, b


class Scene:
    def __init__(self, seed, folder, dimensions=3):
        self.dice = Dice(seed)
        self.folder = folder
        self.head = f'title = "Drawn at random, seed {seed}"\ndimensions = {dimensions}\n'
        self.step = ""
        self.spacing = 0.02
        self.text = ""
        self.pads = []
        self.top = 0.0  # bodies above it are clear of the ground
        self.middle = (0.0, 0.0, 0.0)
        self.count = 0
        self.names = 0
        self.end = 0.3
        self.room, self.floor = 0.0, 0.0  # of a basin: its narrowest width, and where bodies may start in it
        self.tags = []

    def wall(self, shape, lines, motion=""):
        self.names += 1
        self.text += f'\n[[wall]]\nname = "{shape}{self.names}"\nshape = "{shape}"\n{lines}{motion}'

    def box_wall(self, size, position, turn=(1.0, 0.0, 0.0, 0.0), motion=""):
        self.wall("box", f"size = {vector(size)}\nposition = {vector(position)}\nrotation = {vector(turn)}\n", motion)

    def body(self, body, position, turn, density, velocity=(0, 0, 0), spin=(0, 0, 0), extra=""):
        self.count += 1
        self.text += (f'\n[[body]]\nname = "b{self.count}"\n{body.lines}density = {density!r}\n'
                      f"position = {vector(position)}\nrotation = {vector(turn)}\n"
                      f"velocity = {vector(velocity)}\nangular_velocity = {vector(spin)}\n{extra}")

    def write(self):
        d = self.dice
        time = f"[time]\nend = {self.end!r}\n{self.step}"
        contact = f"\n[contact]\nrestitution = {d.between(0, 0.8)!r}\nfriction = {d.between(0, 0.9)!r}\n"
        output = f"\n[output]\nevery = {self.end / 6!r}\n"
        (self.folder / "case.toml").write_text(
            f"# {' '.join(self.tags)}\n{self.head}\n{time}\n[particles]\nspacing = {self.spacing!r}\n{self.text}"
            f"{contact}{output}")


# ---- grounds of scenes without water: each leaves pads to stand on and the height that is clear


def plane_ground(s):
    d = s.dice
    tilt = d.between(0, 25) if d.chance(0.5) else 0.0
    turn = after(about((0, 0, 1), d.between(0, 360)), about((1, 0, 0), tilt))
    point = tuple(d.between(-1, 1) for _ in range(3))
    s.wall("plane", f"point = {vector(point)}\nnormal = {vector(turned(turn, (0, 0, 1)))}\n")
    s.pads.append(Pad(point, turn, 3.0, 3.0))
    s.middle, s.top = point, point[2] + (1.4 if tilt else 0.0)


def box_ground(s):
    d = s.dice
    turn = after(about((0, 0, 1), d.between(0, 360)), about((1, 0, 0), d.between(0, 20) if d.chance(0.5) else 0.0))
    a, b, c = d.between(0.8, 3), d.between(0.8, 3), d.between(0.1, 0.5)
    position = tuple(d.between(-1, 1) for _ in range(3))
    s.box_wall((a, b, c), position, turn)
    s.pads.append(Pad(plus(position, turned(turn, (0, 0, c / 2))), turn, a / 2, b / 2))
    s.middle, s.top = position, position[2] + c / 2 + 0.3 * b


def step_ground(s):
    d = s.dice
    turn = about((0, 0, 1), d.between(0, 360))
    position = tuple(d.between(-1, 1) for _ in range(3))
    for k in range(2 + d.below(2)):
        height = d.between(0.05, 0.3)
        s.box_wall((0.7, 1.6, height), plus(position, turned(turn, (0.7 * k - 0.7, 0, height / 2))), turn)
        s.pads.append(Pad(plus(position, turned(turn, (0.7 * k - 0.7, 0, height))), turn, 0.35, 0.8))
    s.middle, s.top = position, position[2] + 0.3


def mesh_ground(s):
    d = s.dice
    height = d.between(0.02, 0.3)
    bumps(d, 3 + d.below(5), d.between(1.5, 3), height, 0.3).write(s.folder / "ground.stl")
    turn = about((0, 0, 1), d.between(0, 360))
    position = tuple(d.between(-1, 1) for _ in range(3))
    s.wall("mesh", f'file = "ground.stl"\nposition = {vector(position)}\nrotation = {vector(turn)}\n')
    s.middle, s.top = position, position[2] + height


def basin_ground(s):
    d = s.dice
    low = tuple(d.between(-1, 0) for _ in range(3))
    size = (d.between(0.6, 1.5), d.between(0.6, 1.5), d.between(0.2, 0.6))
    high = plus(low, size)
    s.wall("basin", f'min = {vector(low)}\nmax = {vector(high)}\nopen = ["+z"]\n')
    middle = plus(low, (size[0] / 2, size[1] / 2, 0))
    s.pads.append(Pad(middle, (1.0, 0.0, 0.0, 0.0), size[0] / 2, size[1] / 2))
    s.middle, s.top, s.floor = middle, high[2], low[2]
    s.room = min(size[:2])


GROUNDS = [plane_ground, box_ground, box_ground, step_ground, mesh_ground, mesh_ground, basin_ground, basin_ground]


# ---- what bodies do


def some_density(d):
    return d.by_ratio(50, 5000)


def stand(s):
    """Bodies flat on the pads, at rest or sliding, some touching the next."""
    d = s.dice
    wanted = 1 + d.below(12)
    low, high = 0.1, 0.25
    for pad in s.pads:
        place = -pad.a
        for _ in range(wanted):
            body = any_body(d, DRY_KINDS[:-1], low, high, s.folder, s.count)
            gap = 0.001 if d.chance(0.3) else d.between(0.01, 0.1)
            place += body.foot + gap
            if place + body.foot > pad.a or body.foot > pad.b:
                break
            turn = after(pad.turn, after(about((0, 0, 1), d.between(0, 360)), body.flat))
            position = plus(pad.middle, turned(pad.turn, (place, 0, body.stands)))
            slide = turned(pad.turn, (0, d.between(-1, 1), 0)) if d.chance(0.3) else (0, 0, 0)
            s.body(body, position, turn, some_density(d), slide)
            place += body.foot


def stack(s):
    """Towers of boxes, each turned over the one below."""
    d = s.dice
    for pad in s.pads[:2]:
        height, levels = 0.0, 2 + d.below(11)
        ratio = d.by_ratio(0.2, 5) if d.chance(0.5) else 1.0
        density = some_density(d)
        for _ in range(levels):
            body = box(d, 0.15, 0.3)
            turn = after(pad.turn, about((0, 0, 1), d.between(0, 360) if d.chance(0.5) else 0.0))
            shift = (d.between(-0.02, 0.02), d.between(-0.02, 0.02), height + body.stands)
            s.body(body, plus(pad.middle, turned(pad.turn, shift)), turn, min(max(density, 20.0), 20000.0))
            height += 2 * body.stands
            density *= ratio


def row(s):
    """Equal cubes that fall flat side by side and never touch."""
    d = s.dice
    pad = s.pads[0]
    edge, gap, count = 0.1, 0.001, 2 + d.below(30)
    count = min(count, int(2 * pad.a / (edge + gap)))
    height = d.between(0.0, 0.05)
    for k in range(count):
        body = box(Dice(1), edge, edge)
        at = ((k - (count - 1) / 2) * (edge + gap), 0, edge / 2 + height)
        s.body(body, plus(pad.middle, turned(pad.turn, at)), pad.turn, 500.0)


def throw(s, kinds=None, count=None):
    """Bodies in any pose, with any velocity, on a lattice of places above the ground."""
    d = s.dice
    low, high = 0.08, 0.25
    count = count or (1 + d.below(60) if d.chance(0.3) else 1 + d.below(8))
    across = 1 + int(count ** (1 / 3))
    bodies = [any_body(d, kinds or DRY_KINDS, low, high, s.folder, 1000 + k) for k in range(count)]
    pitch = 2.05 * max(b.reach for b in bodies)
    top = s.floor if across * pitch < s.room and d.chance(0.5) else s.top
    for k, body in enumerate(bodies):
        i, j, m = k % across, k // across % across, k // across ** 2
        at = ((i - (across - 1) / 2) * pitch, (j - (across - 1) / 2) * pitch, (m + 0.55) * pitch)
        at = plus((s.middle[0], s.middle[1], top), at)
        velocity = (d.between(-1.5, 1.5), d.between(-1.5, 1.5), d.between(-4, -1))
        spin = tuple(d.between(-8, 8) for _ in range(3))
        s.body(body, at, d.turn(), some_density(d), velocity, spin)


def land(s):
    """A cylinder or box falls on an edge or corner of a box that is held."""
    d = s.dice
    held = box(d, 0.15, 0.3)
    centre = plus(s.middle, (0, 0, s.top - s.middle[2] + held.reach + 0.01))
    s.body(held, centre, d.turn(), 1000.0, extra="fixed = true\n")
    for k in range(1 + d.below(3)):
        body = any_body(d, ["cylinder", "cylinder", "box", "hull"], 0.1, 0.25, s.folder, k)
        centre = plus(centre, (d.between(-0.08, 0.08), d.between(-0.08, 0.08), 0))
        centre = plus(centre, (0, 0, (held.reach if k == 0 else before) + body.reach + 0.005))
        before = body.reach
        spin = tuple(d.between(-5, 5) for _ in range(3))
        s.body(body, centre, d.turn(), some_density(d), (0, 0, d.between(-2, 0)), spin)


def driven(s):
    """A box that moves as a wall and pushes what stands on the first pad."""
    stand(s)
    d = s.dice
    pad = s.pads[0]
    speed, size = d.between(0.2, 1.5), (0.1, 2 * pad.b, 0.3)
    at = plus(pad.middle, turned(pad.turn, (-pad.a - 0.06, 0, 0.16)))
    along = turned(pad.turn, (1, 0, 0))
    if d.chance(0.5):
        motion = f"[wall.motion]\nvelocity = {vector(speed * x for x in along)}\n"
    else:
        places = [tuple(0.2 * k * x for x in along) for k in (0, 1, 2, 1)]
        motion = ("[wall.motion]\ntimes = [0.0, 0.1, 0.25, 0.5]\nplaces = ["
                  + ", ".join(vector(p) for p in places) + "]\n")
    s.box_wall(size, at, pad.turn, motion)


def dry(s):
    d = s.dice
    ground = d.one_of(GROUNDS)
    ground(s)
    acts = [throw, throw, land]
    if s.pads:
        acts += [stand, stand, stack, stack, row]
    if ground in (plane_ground, box_ground):
        acts.append(driven)  # nothing stands behind, so that no body can be crushed
    act = d.one_of(acts)
    act(s)
    if s.count == 0:
        throw(s)
    step = d.one_of([0.0005, 0.001, 0.001, 0.002, 0.005])
    s.step = f"step = {step!r}\n"
    s.end = max(60 * step, d.between(0.15, 0.5))
    s.spacing = 0.02
    s.tags += ["dry", ground.__name__, act.__name__]


# ---- water


def bed(s, length, width, dp):
    """A tank, and a bed in it at any offset against the lattice. Returns where the bed is at each x."""
    d = s.dice
    kind = d.one_of(["floor", "box", "slope", "step", "mesh"] if width else ["floor", "box", "slope", "step"])
    s.tags.append(kind)
    w = width or 1.0
    s.wall("basin", f'min = {vector((0, 0, -0.3))}\nmax = {vector((length, width, 1.6))}\nopen = ["+z"]\n')
    if kind == "floor":
        return lambda x: -0.3
    top = d.between(-2 * dp, 2 * dp)
    y, wide = w / 2 if width else 0.0, 2 * w
    if kind == "slope":
        angle = d.between(-8, 8)
        turn = about((0, 1, 0), angle)
        s.box_wall((3 * length, wide, 1.0), plus((length / 2, y, top), turned(turn, (0, 0, -0.5))), turn)
        up = turned(turn, (1, 0, 0))
        return lambda x: top + (x - length / 2) * up[2] / up[0]
    s.box_wall((3 * length, wide, 1.0), (length / 2, y, top - 0.5))
    if kind == "step":
        high, edge = d.between(dp, 4 * dp), d.between(0.4, 0.7) * length
        s.box_wall((length, wide, 1.0), (edge + length / 2, y, top + high - 0.5))
        return lambda x: top + (high if x > edge else 0.0)
    if kind == "mesh":
        height = d.between(0.5, 2) * dp
        bumps(d, 3, 1.5 * length, height, 0.5).write(s.folder / "bed.stl")
        s.wall("mesh", f'file = "bed.stl"\nposition = {vector((length / 2, y, top))}\n')
        return lambda x: top + height
    return lambda x: top


def wet(s, flat):
    d = s.dice
    dp = d.one_of([0.03, 0.04, 0.05]) if flat else d.one_of([0.08, 0.1])
    s.spacing = dp
    length = d.between(1.0, 1.6)
    width = 0.0 if flat else d.between(5, 8) * dp
    ground = bed(s, length, width, dp)
    depth = d.between(4, 9) * dp if flat else d.between(3, 6) * dp
    still = d.chance(0.5)
    level = max(ground(0.0), ground(length)) + depth
    end = length if still else d.between(0.3, 0.6) * length
    velocity = (0, 0, 0) if still or d.chance(0.5) else (d.between(0, 1.5), 0, 0)
    low = min(ground(0.0), ground(length))
    start = d.one_of([low, low - d.between(0, 1) * dp, -0.3])
    s.text = ("\n[fluid]\n[fluid.viscosity]\nalpha = 0.05\n[[fluid.block]]\nshape = \"box\"\n"
              f"min = {vector((0, 0, max(start, -0.3)))}\nmax = {vector((end, width, level))}\n"
              f"velocity = {vector(velocity)}\n" + s.text)
    s.tags += ["still" if still else "bore", f"dp={dp}"]
    x, room = (0.1 * length if still else end + 0.5 * dp), length
    if d.chance(0.25):
        thick = d.between(0.3, 2) * dp
        at = d.between(0.75, 0.9) * length if still else end + d.between(0, 1) * dp
        plate(s, at, thick, width, ground(at), level)
        x, room = (x, at) if still else (at + thick, room)
    s.end = d.between(0.2, 0.4) if d.chance(0.85) else 1.5
    x = float_or_stand(s, flat, (x, room), width, dp, level if still else None, ground)
    free = length - (x if room == length else length)  # of bodies and plates, at the far end
    if d.chance(0.3) and free > 0.3 * length:
        paddle(s, length, width, dp, 0.6 * free)


def float_or_stand(s, flat, room, width, dp, level, ground):
    """Bodies afloat, standing or thrown into still water, or standing before a bore, within a room along x.
    Returns where the last ends."""
    d = s.dice
    low, high = 3 * dp, 5 * dp
    kinds = ["flat_box", "ball"] if flat else ["box", "ball", "cylinder", "hull"]
    x = last = room[0]
    while d.chance(0.8) and s.count < 4:
        body = any_body(d, kinds, low, min(high, 0.9 * width) if width else high, s.folder, s.count)
        x += body.reach + dp
        if x + body.reach + 0.5 * dp > room[1] or (width and 2 * body.reach > width):
            break
        floor = max(ground(x - body.reach), ground(x + body.reach))
        turn = after(about((0, 0, 1), d.between(0, 360)), body.flat) if width else body.flat
        velocity = (0, 0, 0)
        if level is None or d.chance(0.3):
            density, z = some_density(d), floor + body.stands  # stands, on slopes on one edge
        elif d.chance(0.3):
            density, z = some_density(d), level + body.reach + d.between(0.5, 3) * dp
            velocity = (d.between(-1, 1), 0, d.between(-4, 0))
            turn = about((0, 1, 0), d.between(0, 360)) if flat else d.turn()
        else:
            density = d.between(100, 900)
            z = max(level - 2 * body.stands * density / 1000 + body.stands, floor + body.stands)
        s.body(body, (x, width / 2, z), turn, density, velocity)
        x += body.reach
        last = x
    return last


def plate(s, x, thick, width, floor, level):
    """A plate across the tank, down into its bed, thinner than two spacings; it stands, or is pulled up as a gate."""
    d = s.dice
    size = (thick, 2 * width if width else 1.0, level - floor + 0.6)
    gate = d.chance(0.5)
    motion = f"[wall.motion]\nvelocity = {vector((0, 0, d.between(0.5, 3)))}\n" if gate else ""
    s.box_wall(size, (x + thick / 2, width / 2, (floor + level) / 2), motion=motion)
    s.tags.append("gate" if gate else "plate")


def paddle(s, length, width, dp, travel):
    """A wall over the whole height that moves into the tank from its far end, not farther than `travel`."""
    speed = min(s.dice.by_ratio(0.1, 2), travel / s.end)
    size = (6 * dp, 2 * width if width else 1.0, 2.2)
    s.box_wall(size, (length + 3 * dp, width / 2, 0.6),
               motion=f"[wall.motion]\nvelocity = {vector((-speed, 0, 0))}\n")
    s.tags.append("paddle")


def kind_of(seed):
    """dry, or wet in two or three dimensions."""
    choice = Dice(seed ^ 0x5DEECE66D).between(0, 1)
    return "dry" if choice < 0.7 else "wet2" if choice < 0.88 else "wet3"


def draw(seed, folder):
    kind = kind_of(seed)
    s = Scene(seed, folder, 2 if kind == "wet2" else 3)
    if kind == "dry":
        dry(s)
    else:
        s.tags.append("wet")
        wet(s, kind == "wet2")
    s.write()
    return s


if __name__ == "__main__":
    out = pathlib.Path(sys.argv[2])
    out.mkdir(parents=True, exist_ok=True)
    draw(int(sys.argv[1]), out)
