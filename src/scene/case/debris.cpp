// SPDX-License-Identifier: MIT
#include "hyoryu/scene/debris.hpp"

#include "hyoryu/scene/shapes.hpp"
#include "hyoryu/scene/toml_document.hpp"

#include "hyoryu/core/error.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace hyoryu {

namespace {

using std::numbers::pi;

std::string text_of(const TomlTable& table, std::string_view key)
{
    const TomlEntry* entry = find_entry(table, key);
    expects(entry != nullptr);
    return std::get<std::string>(entry->node.value);
}

double number_of(const TomlNode& node)
{
    const auto* integer = std::get_if<std::int64_t>(&node.value);
    return integer != nullptr ? static_cast<double>(*integer) : std::get<double>(node.value);
}

DebrisNumber read_number(const TomlEntry& entry)
{
    const TomlTable& table = *entry.node.table();
    DebrisNumber number{entry.key, {}, text_of(table, "grade"), text_of(table, "source")};
    const TomlNode& value = find_entry(table, "value")->node;
    if (const TomlArray* list = value.array()) {
        for (const TomlNode& item : *list) {
            number.value.push_back(number_of(item));
        }
    } else {
        number.value.push_back(number_of(value));
    }
    return number;
}

std::vector<DebrisNumber> read_numbers(const TomlTable& table, std::string_view key)
{
    std::vector<DebrisNumber> numbers;
    if (const TomlEntry* entry = find_entry(table, key)) {
        for (const TomlEntry& one : *entry->node.table()) {
            numbers.push_back(read_number(one));
        }
    }
    // The parser has them by name: the empty piece comes first, others by their first number.
    std::ranges::sort(numbers, {}, [](const DebrisNumber& n) { return n.value.front(); });
    return numbers;
}

DebrisShape shape_named(std::string_view name)
{
    constexpr std::array<std::string_view, 4> names{"box", "hollow_box", "lying_cylinder",
                                                    "standing_cylinder"};
    const auto found = std::ranges::find(names, name);
    expects(found != names.end());
    return static_cast<DebrisShape>(found - names.begin());
}

DebrisKind read_kind(const TomlEntry& entry)
{
    const TomlTable& table = *entry.node.table();
    DebrisKind kind;
    kind.name = entry.key;
    kind.title = text_of(table, "title");
    kind.shape = shape_named(text_of(table, "shape"));
    kind.size = read_number(*find_entry(table, "size"));
    kind.per_area = find_entry(table, "mass_per_area") != nullptr;
    kind.masses = read_numbers(table, kind.per_area ? "mass_per_area" : "mass");
    kind.stiffness = read_numbers(table, "stiffness");
    return kind;
}

std::vector<DebrisKind> read_library()
{
    const TomlNode root = parse_toml(debris_library_text());
    std::vector<DebrisKind> kinds;
    for (const TomlEntry& entry : *root.table()) {
        kinds.push_back(read_kind(entry));
    }
    return kinds;
}

std::string listed(const DebrisNumber& number, std::string_view unit)
{
    std::string values;
    for (const double value : number.value) {
        values += fmt::format("{}{:.6g}", values.empty() ? "" : " x ", value);
    }
    return fmt::format("{} {} [{}: {}]", values, unit, number.grade, number.source);
}

// Second moments about the centre of mass along x, y, z: sums of m x^2, m y^2, m z^2.
// A thin shell on the six faces of a box, of one mass per area.
Vec3 second_of_shell(const Vec3& size, double mass)
{
    const Vec3 areas(size.y() * size.z(), size.x() * size.z(), size.x() * size.y());
    const double unit = mass / (2 * areas.sum());
    Vec3 second;
    for (int axis = 0; axis < 3; ++axis) {
        const double own = 2 * areas[axis] * sq(size[axis]) / 4;
        const double others = 2 * (areas.sum() - areas[axis]) * sq(size[axis]) / 12;
        second[axis] = unit * (own + others);
    }
    return second;
}

Vec3 second_of_box(const Vec3& size, double mass)
{
    return mass / 12 * size.cwiseAbs2();
}

// A closed cylinder of sheet along x.
Vec3 second_of_sheet(double radius, double length, double mass)
{
    const double side = 2 * pi * radius * length;
    const double caps = 2 * pi * sq(radius);
    const double unit = mass / (side + caps);
    const double across = unit * (side * sq(radius) / 2 + caps * sq(radius) / 4);
    return {unit * (side * sq(length) / 12 + caps * sq(length) / 4), across, across};
}

Vec3 second_of_cylinder(double radius, double length, double mass)
{
    return mass * Vec3(sq(length) / 12, sq(radius) / 4, sq(radius) / 4);
}

// Cargo fills a slab of the inside about its centre, as thick as the inside allows.
struct Cargo {
    double mass = 0;
    double above = 0; // its centre over the middle of the piece [m]
    double thick = 0; // [m]
};

// The piece and its cargo together; `up` is the axis of the body along which it stands.
void add_cargo(const Vec3& piece, const Vec3& slab, double own, const Cargo& cargo, int up,
               BodySettings& body)
{
    body.mass = own + cargo.mass;
    Vec3 second = piece + slab;
    Vec3 centre = Vec3::Zero();
    centre[up] = cargo.mass * cargo.above / body.mass;
    second[up] += own * sq(centre[up]) + cargo.mass * sq(cargo.above - centre[up]);
    if (cargo.mass > 0) {
        body.centre_of_mass = centre;
    }
    body.inertia = Vec3(Vec3::Constant(second.sum()) - second);
}

void fill_box(const DebrisKind& kind, double own, const Cargo& cargo, DebrisPiece& piece)
{
    const Vec3 size(kind.size.value[0], kind.size.value[1], kind.size.value[2]);
    piece.body.shape = BoxShape{size};
    piece.extent = size;
    const bool hollow = kind.shape == DebrisShape::hollow_box;
    const Vec3 slab(size.x(), size.y(), cargo.thick);
    add_cargo(hollow ? second_of_shell(size, own) : second_of_box(size, own),
              second_of_box(slab, cargo.mass), own, cargo, 2, piece.body);
}

void fill_tank(double radius, double height, double own, const Cargo& cargo, DebrisPiece& piece)
{
    piece.body.shape = CylinderShape{radius, height};
    piece.extent = {2 * radius, 2 * radius, height};
    piece.upright = Quat(Eigen::AngleAxisd(-pi / 2, Vec3::UnitY())); // x of the body points up
    add_cargo(second_of_sheet(radius, height, own),
              second_of_cylinder(radius, cargo.thick, cargo.mass), own, cargo, 0, piece.body);
}

// A section of the same density: its mass per width is that of the area over the volume.
void flatten(DebrisPiece& piece)
{
    BodySettings& body = piece.body;
    const double share = volume(body.shape, 2) / volume(body.shape, 3);
    body.mass *= share;
    piece.extent.y() = 0;
    if (auto* box = std::get_if<BoxShape>(&body.shape)) {
        box->size.y() = 1; // as the reader has it
    }
    if (body.inertia) {
        body.inertia = Vec3(*body.inertia * share);
    }
}

} // namespace

std::span<const DebrisKind> debris_library()
{
    static const std::vector<DebrisKind> library = read_library();
    return library;
}

std::string describe_debris_library()
{
    std::string text = "The debris library, with the source and grade of each number:\n";
    for (const DebrisKind& kind : debris_library()) {
        text += fmt::format("\n{}\n    {}\n", kind.name, kind.title);
        text += fmt::format("    size       {}\n", listed(kind.size, "m"));
        for (const DebrisNumber& mass : kind.masses) {
            text += fmt::format("    mass       {}: {}\n", mass.name,
                                listed(mass, kind.per_area ? "kg/m2" : "kg"));
        }
        for (const DebrisNumber& stiffness : kind.stiffness) {
            text +=
                fmt::format("    stiffness  {}: {}\n", stiffness.name, listed(stiffness, "N/m"));
        }
    }
    return text + "\nEvery piece is closed to water; none fills and sinks. Drag and added mass "
                  "result from the flow.\nA stiffness is entered as `contact.pair.stiffness`, for "
                  "the peak forces of reports.\n\n";
}

DebrisPiece debris_piece(const DebrisLoad& load, int dimensions)
{
    const DebrisKind& kind = debris_library()[load.kind];
    const std::vector<double>& size = kind.size.value.empty() ? load.size : kind.size.value;
    const auto state = std::ranges::find(kind.masses, load.state, &DebrisNumber::name);
    const double empty = kind.masses.front().value.front();
    const double of_state = state == kind.masses.end() ? empty : state->value.front();
    const double height = kind.shape == DebrisShape::lying_cylinder ? size[0] : size.back();
    const double part = load.load_height;
    const Cargo cargo{of_state - empty + load.load, (part - 0.5) * height,
                      2 * std::min(part, 1 - part) * height};
    DebrisPiece piece;
    if (kind.shape == DebrisShape::standing_cylinder) {
        const double r = size[0] / 2;
        const double own = kind.per_area ? empty * 2 * pi * r * (size[1] + r) : empty;
        fill_tank(r, size[1], own, cargo, piece);
    } else if (kind.shape == DebrisShape::lying_cylinder) {
        piece.body.shape = CylinderShape{size[0] / 2, size[1]};
        piece.body.mass = empty + cargo.mass;
        piece.extent = {size[1], size[0], size[0]};
    } else {
        fill_box(kind, empty, cargo, piece);
    }
    if (dimensions == 2) {
        flatten(piece);
    }
    piece.body.density = piece.body.mass / volume(piece.body.shape, dimensions);
    return piece;
}

} // namespace hyoryu
