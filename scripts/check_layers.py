#!/usr/bin/env python3
"""Checks that dependencies between layers point one way: a layer includes only itself and the layers of
MAY_INCLUDE; the parts of a layer, its folders, those of PARTS, and a public header belongs to the part of
the source of its name. Also checks that no two files define types of the same name: the linker would merge their
destructors and their `std::vector`, which corrupts memory silently; and that no file is longer than
LONGEST_FILE lines and no function longer than LONGEST_FUNCTION.

Usage: scripts/check_layers.py [ROOT]; exit 1 and one line per offence.
"""
import pathlib
import re
import sys

MAY_INCLUDE = {
    "core": set(),
    "ranks": {"core"},
    "fluid": {"core", "ranks"},
    "rigid": {"core", "ranks"},
    "coupling": {"core", "ranks", "fluid", "rigid"},
    "geometry": {"core"},
    "scene": {"core", "ranks", "fluid", "rigid", "coupling", "geometry"},
    "sim": {"core", "ranks", "fluid", "rigid", "coupling", "scene"},
    "io": {"core"},
    "assess": {"core", "scene", "io", "report"},
    "report": {"core", "scene", "io"},
    "bench": {"core", "ranks", "fluid", "rigid", "coupling", "scene", "sim", "io"},
    "view": {"core", "io"},
    "gis": {"core", "geometry"},
    "mpi": {"core", "ranks"},
    "vtk": {"core", "io", "geometry", "view"},
    "app": {"core", "ranks", "fluid", "rigid", "coupling", "geometry", "scene", "sim", "io", "assess",
            "report", "bench", "view"},
}
# Parts in order: each may include those before it. Sources beside the folders may include all.
PARTS = {
    "rigid": ["shapes", "collision", "contact", "motion", "impact", "penalty"],
    "scene": ["surfaces", "case", "filling", "plan"],
}
LONGEST_FILE = 450
LONGEST_FUNCTION = 60
VTK_LAYERS = {"vtk", "view"}
INCLUDE = re.compile(r'#include\s+[<"]hyoryu/(\w+)/')
LOCAL = re.compile(r'#include "(?:(?:hyoryu/)?(\w+)/)?(?:\w+/)?(\w+)\.hpp"')
VTK = re.compile(r"#include\s+<vtk")
TYPE = re.compile(r"(?:struct|class|union|enum class) (\w+)(?![\w:<;])(?!.*;$)")


def offences(root):
    for base in (root / "include" / "hyoryu", root / "src"):
        for file in sorted(base.rglob("*.[hc]pp")):
            layer = file.relative_to(base).parts[0]
            for number, line in enumerate(file.read_text().splitlines(), 1):
                place = f"{file.relative_to(root)}:{number}"
                found = INCLUDE.match(line)
                if found and found[1] != layer and found[1] not in MAY_INCLUDE[layer]:
                    yield f"{place}: {layer} must not include {found[1]}"
                if VTK.match(line) and layer not in VTK_LAYERS:
                    yield f"{place}: only src/vtk and src/view may include VTK"


def offences_of_parts(root):
    for layer, parts in PARTS.items():
        sources = sorted((root / "src" / layer).rglob("*.[hc]pp"))
        part_of = {file.stem: file.parent.name for file in sources if file.parent.name in parts}
        for file in sources:
            if file.parent.name not in (*parts, layer):
                yield f"{file.relative_to(root)}: {file.parent.name} is not among the parts of {layer}: {', '.join(parts)}"
        for file in [*sources, *sorted((root / "include" / "hyoryu" / layer).rglob("*.hpp"))]:
            own = part_of.get(file.stem)
            for number, line in enumerate(file.read_text().splitlines(), 1):
                found = LOCAL.match(line)
                other = part_of.get(found[2]) if found and found[1] in (None, layer) else None
                if own and other and parts.index(other) > parts.index(own):
                    yield f"{file.relative_to(root)}:{number}: {own} must not include {other}"


def types_of(file):
    """Types of the file that other files share by name: those outside of unnamed namespaces."""
    unnamed = False
    for number, line in enumerate(file.read_text().splitlines(), 1):
        unnamed = line == "namespace {" or (unnamed and line != "} // namespace")
        found = TYPE.match(line)
        if found and not unnamed:
            yield found[1], number


def double_types(root):
    known = {}
    for base in (root / "include" / "hyoryu", root / "src"):
        for file in sorted(base.rglob("*.[hc]pp")):
            for name, number in types_of(file):
                place = f"{file.relative_to(root)}:{number}"
                if name in known:
                    yield f"{place}: {name} is also defined in {known[name]}"
                known.setdefault(name, place)


def too_long(root):
    """A function is what stands between a line `{` and a line `}`: those of .clang-format."""
    for base in (root / "include" / "hyoryu", root / "src"):
        for file in sorted(base.rglob("*.[hc]pp")):
            lines = file.read_text().splitlines()
            if len(lines) > LONGEST_FILE:
                yield f"{file.relative_to(root)}: {len(lines)} lines, at most {LONGEST_FILE}"
            start = 0
            for number, line in enumerate(lines, 1):
                if line == "{":
                    start = number
                elif line == "}" and start:
                    if number - start - 1 > LONGEST_FUNCTION:
                        yield (f"{file.relative_to(root)}:{start}: a function of {number - start - 1} lines, "
                               f"at most {LONGEST_FUNCTION}")
                    start = 0


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent)
    found = [*offences(root), *offences_of_parts(root), *double_types(root), *too_long(root)]
    print("\n".join(found) if found else "layers: every arrow points one way, every type has one definition, nothing is too long")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
