"""A resolved case as a whole shifted, turned or mirrored, or with one body more."""
import math
import tomllib

from pieces import after, plus, turned


class Frame:
    """x goes to turn(x mirrored in the plane x = 0 if asked) + shift."""

    def __init__(self, shift=(0, 0, 0), turn=(1.0, 0.0, 0.0, 0.0), mirror=False):
        self.shift, self.turn, self.mirror = shift, turn, mirror

    def direction(self, v):
        return turned(self.turn, (-v[0], v[1], v[2]) if self.mirror else v)

    def place(self, x):
        return plus(self.direction(x), self.shift)

    def spin(self, w):
        """Of an axial vector."""
        return turned(self.turn, (w[0], -w[1], -w[2]) if self.mirror else w)

    def rotation(self, q):
        return after(self.turn, (q[0], q[1], -q[2], -q[3]) if self.mirror else q)


def moved_box(frame, low, high):
    """The corners of an axis-aligned box whose axes stay axes."""
    a, b = frame.place(low), frame.place(high)
    return ([round_off(min(p, q)) for p, q in zip(a, b)], [round_off(max(p, q)) for p, q in zip(a, b)])


def round_off(x):
    return 0.0 if abs(x) < 1e-15 else x


def moved_sides(frame, sides):
    names = []
    for side in sides:
        axis, sign = "xyz".index(side[1]), 1 if side[0] == "+" else -1
        n = frame.direction(tuple(sign * float(k == axis) for k in range(3)))
        axis = max(range(3), key=lambda k: abs(n[k]))
        names.append(("+" if n[axis] > 0 else "-") + "xyz"[axis])
    return names


def move(case, frame):
    """The case in that frame, in place. Meshes and particles cannot be mirrored."""
    case["gravity"] = list(frame.direction(case["gravity"]))
    if "domain" in case:
        case["domain"]["min"], case["domain"]["max"] = moved_box(frame, case["domain"]["min"], case["domain"]["max"])
    if "fluid" in case:
        case["fluid"]["acceleration"] = list(frame.direction(case["fluid"]["acceleration"]))
    for thing in case.get("wall", []) + case.get("body", []) + case.get("fluid", {}).get("block", []):
        move_thing(thing, frame)
    return case


def move_thing(thing, frame):
    if thing.get("shape") == "plane":
        thing["point"] = list(frame.place(thing["point"]))
        thing["normal"] = list(frame.direction(thing["normal"]))
    if thing.get("shape") == "basin":
        thing["min"], thing["max"] = moved_box(frame, thing["min"], thing["max"])
        thing["open"] = moved_sides(frame, thing["open"])
    if "velocity" in thing:
        thing["velocity"] = list(frame.direction(thing["velocity"]))
    if "position" in thing:
        thing["position"] = list(frame.place(thing["position"]))
    if "rotation" in thing:
        thing["rotation"] = list(frame.rotation(thing["rotation"]))
    if "angular_velocity" in thing:
        thing["angular_velocity"] = list(frame.spin(thing["angular_velocity"]))
    motion = thing.get("motion", {})
    if "velocity" in motion:
        motion["velocity"] = list(frame.direction(motion["velocity"]))
    if "places" in motion:
        motion["places"] = [list(frame.direction(p)) for p in motion["places"]]


def text_of(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return '"' + value.replace("\\", "\\\\").replace('"', '\\"') + '"'
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(text_of(v) for v in value) + "]"
    return repr(value)


def to_toml(table, path=""):
    plain = {k: v for k, v in table.items() if not isinstance(v, dict) and not is_tables(v)}
    text = "".join(f"{k} = {text_of(v)}\n" for k, v in plain.items())
    for key, value in table.items():
        name = f"{path}.{key}" if path else key
        if isinstance(value, dict):
            text += f"[{name}]\n" + to_toml(value, name)
        elif is_tables(value):
            text += "".join(f"[[{name}]]\n" + to_toml(v, name) for v in value)
    return text


def is_tables(value):
    return isinstance(value, list) and bool(value) and isinstance(value[0], dict)


def read(path):
    with open(path, "rb") as file:
        return tomllib.load(file)


def distance(a, b):
    return math.dist(a, b)
