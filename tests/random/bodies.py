"""Bodies of a scene: what they are, how they stand, and how far they reach."""
import math

from pieces import about, prism, regular

UPRIGHT = (1.0, 0.0, 0.0, 0.0)
ON_END = about((0.0, 1.0, 0.0), 90)  # a cylinder, whose axis is x, on its cap


class Body:
    """Lines of its shape, the radius of the ball about its centre that holds it, its height of standing
    (centre over ground) in the turn `flat`, the radius of its footprint, and the height over its centre."""

    def __init__(self, lines, reach, stands, flat, foot, top):
        self.lines, self.reach, self.stands, self.flat, self.foot, self.top = lines, reach, stands, flat, foot, top


def box(dice, low, high):
    a, b, c = (dice.between(low, high) for _ in range(3))
    lines = f'shape = "box"\nsize = [{a!r}, {b!r}, {c!r}]\n'
    return Body(lines, math.hypot(a, b, c) / 2, c / 2, UPRIGHT, math.hypot(a, b) / 2, c / 2)


def flat_box(dice, low, high):
    a, c = dice.between(low, high), dice.between(low, high)
    lines = f'shape = "box"\nsize = [{a!r}, 1, {c!r}]\n'
    return Body(lines, math.hypot(a, c) / 2, c / 2, UPRIGHT, a / 2, c / 2)


def ball(dice, low, high):
    r = dice.between(low, high) / 2
    return Body(f'shape = "sphere"\nradius = {r!r}\n', r, r, UPRIGHT, r, r)


def cylinder(dice, low, high):
    r, length = dice.between(low, high) / 2, dice.between(low, 2 * high)
    lines = f'shape = "cylinder"\nradius = {r!r}\nlength = {length!r}\n'
    reach = math.hypot(r, length / 2)
    if dice.chance(0.5):
        return Body(lines, reach, length / 2, ON_END, r, length / 2)
    return Body(lines, reach, r, UPRIGHT, reach, r)


def mesh_body(mesh, folder, name, extra=""):
    """Stands on the side of least y of its file: turned so that y is up."""
    mesh.write(folder / name)
    centre = mesh.centroid()
    ys = [c[1] - centre[1] for c in mesh.corners]
    reach = max(math.dist(c, centre) for c in mesh.corners)
    lines = f'shape = "mesh"\nfile = "{name}"\n{extra}'
    return Body(lines, reach, -min(ys), about((1.0, 0.0, 0.0), 90), reach, max(ys))


def hull(dice, low, high, folder, name):
    count = 3 + dice.below(6)
    radius, height = dice.between(low, high) / 2, dice.between(low, high)
    section = regular(count, radius, dice.between(0, 6))
    return mesh_body(prism(section, 0.0, height, dice.between(0.3, 1.0)), folder, name)


def angle_piece(dice, low, high, folder, name):
    """An L of cells that its lattice of particles fills exactly."""
    cell = dice.between(low, high) / 4
    a, b, c = 2 + dice.below(3), 2 + dice.below(3), 1 + dice.below(3)
    section = [(1, 1), (b, 1), (b, 0), (0, 0), (0, a), (1, a)]  # from the corner that sees all others
    section = [(cell * x, cell * z) for x, z in section]
    return mesh_body(prism(section, 0.0, cell * c), folder, name, f"spacing = {cell!r}\n")


def cubes(dice, edge, folder, name):
    """A tower of cubes with an arm, given by its particles."""
    tower, arm = 2 + dice.below(3), 1 + dice.below(2)
    at = [(0, 0, k) for k in range(tower)] + [(1 + k, 0, 0) for k in range(arm)] + [(0, 1, 0)]
    points = [tuple(edge * x for x in p) for p in at]
    centre = tuple(sum(p[k] for p in points) / len(points) for k in range(3))
    (folder / name).write_text("".join(f"{x!r} {y!r} {z!r}\n" for x, y, z in points))
    reach = max(math.dist(p, centre) for p in points) + edge * math.sqrt(3) / 2
    lines = f'shape = "particles"\nfile = "{name}"\nspacing = {edge!r}\n'
    return Body(lines, reach, centre[2] + edge / 2, UPRIGHT, reach, edge * (tower - 0.5) - centre[2])


def any_body(dice, kinds, low, high, folder, number):
    kind = dice.one_of(kinds)
    if kind == "hull":
        return hull(dice, low, high, folder, f"hull{number}.stl")
    if kind == "angle":
        return angle_piece(dice, low, high, folder, f"angle{number}.stl")
    if kind == "cubes":
        return cubes(dice, dice.between(low, high) / 3, folder, f"cubes{number}.txt")
    return {"box": box, "flat_box": flat_box, "ball": ball, "cylinder": cylinder}[kind](dice, low, high)
