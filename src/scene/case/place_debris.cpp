// SPDX-License-Identifier: MIT
#include "place_debris.hpp"

#include "place_buildings.hpp"

#include "hyoryu/scene/shapes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hyoryu {

namespace {

constexpr double clearance = 1e-3; // of a piece over the ground [m]
// Ground that differs by more than this share of the height of a piece carries it on an edge only.
constexpr double most_uneven = 0.5;
constexpr int looks = 5; // at the ground under a piece, each way
// Places that are tried for one piece before the yard counts as full.
constexpr int most_tries = 2000;

// Steele, Lea and Flood (2014): 64 bits of a counter, the same on every machine.
class Dice {
public:
    Dice(std::uint64_t seed, const std::string& name) : state_(seed)
    {
        for (const char c : name) { // FNV-1a
            state_ = (state_ ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
        }
    }
    /// From low to high, evenly.
    double between(double low, double high)
    {
        state_ += 0x9e3779b97f4a7c15U;
        std::uint64_t z = state_;
        z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
        z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
        z ^= z >> 31U;
        return low + (high - low) * std::ldexp(static_cast<double>(z >> 11U), -53);
    }

private:
    std::uint64_t state_;
};

// The rectangle that a piece covers, counter-clockwise.
std::vector<Plan2> footprint(const Vec3& extent, const Plan2& middle, double turn, double grown)
{
    const double c = std::cos(turn);
    const double s = std::sin(turn);
    const double a = extent.x() / 2 + grown;
    const double b = extent.y() / 2 + grown;
    std::vector<Plan2> corners;
    for (const auto& [x, y] : {Plan2{-a, -b}, Plan2{a, -b}, Plan2{a, b}, Plan2{-a, b}}) {
        corners.push_back({middle[0] + c * x - s * y, middle[1] + s * x + c * y});
    }
    return corners;
}

struct Rest {
    double height = 0; // of the ground that carries the piece [m]
    double uneven = 0; // highest less lowest ground under it [m]
    bool whole = true; // ground under all of it
};

Rest rest_on(const Ground& ground, const std::vector<Plan2>& corners)
{
    Rest rest;
    rest.height = ground.highest_under(corners);
    double lowest = rest.height;
    for (int i = 0; i < looks; ++i) {
        for (int j = 0; j < looks; ++j) {
            const double u = static_cast<double>(i) / (looks - 1);
            const double v = static_cast<double>(j) / (looks - 1);
            Plan2 p{};
            for (std::size_t k = 0; k < 2; ++k) {
                p[k] = corners[0][k] + u * (corners[1][k] - corners[0][k]) +
                       v * (corners[3][k] - corners[0][k]);
            }
            const double z = ground.height_at(p);
            rest.whole = rest.whole && z > -infinity;
            lowest = std::min(lowest, z);
        }
    }
    rest.uneven = rest.height - lowest;
    return rest;
}

// Why a piece cannot stand there; empty if it can.
std::string fault_of(const Rest& rest, double height, const Plan2& at)
{
    if (!rest.whole) {
        return fmt::format("has no ground under at least a part of it at ({:.4g}, {:.4g}) m", at[0],
                           at[1]);
    }
    if (rest.uneven > most_uneven * height) {
        return fmt::format("would stand on an edge at ({:.4g}, {:.4g}) m: the height of the ground "
                           "under it varies by {:.3g} m",
                           at[0], at[1], rest.uneven);
    }
    return {};
}

// Where the ground of a map lies; empty without one.
std::string hint_of_ground(const Scene& scene)
{
    const TerrainPatch* terrain = terrain_patch_of(scene);
    if (terrain == nullptr) {
        return {};
    }
    const auto& [x_min, y_min, x_max, y_max] = terrain->extent;
    return fmt::format("the terrain has x from {:.6g} to {:.6g} m and y from {:.6g} to {:.6g} m, "
                       "+y to the left of +x; `check --plan` draws it",
                       x_min, x_max, y_min, y_max);
}

class Placing {
public:
    Placing(DebrisKeys& debris, Scene& scene)
        : debris_(debris), scene_(scene), piece_(debris_piece(debris.load, scene.dimensions))
    {
        piece_.body.material = debris.material;
        piece_.body.spacing = scene.spacing;
        piece_.body.place = debris.place;
        piece_.body.table = debris.table;
    }

    const Vec3& extent() const { return piece_.extent; }

    // Puts the middle of a piece somewhere, turned about z.
    void put(const Vec3& middle, double turn)
    {
        BodySettings body = piece_.body;
        body.rotation = Quat(Eigen::AngleAxisd(turn, Vec3::UnitZ())) * piece_.upright;
        body.position = middle;
        if (body.centre_of_mass) {
            body.position += body.rotation * *body.centre_of_mass;
        }
        if (scene_.dimensions == 2) {
            body.position.y() = 0;
        }
        ++debris_.placed;
        body.name = fmt::format("{}.{}", debris_.name, debris_.placed);
        scene_.bodies.push_back(std::move(body));
    }

private:
    DebrisKeys& debris_;
    Scene& scene_;
    DebrisPiece piece_;
};

double reach_of(const Scene& scene, double own)
{
    double far = own;
    for (const Wall& wall : scene.walls) {
        if (const auto* plane = std::get_if<PlaneWall>(&wall.geometry)) {
            far = std::max(far, plane->point.norm());
        }
    }
    return 10 * (far + 1);
}

Ground ground_for(const Scene& scene, const std::string& on, double far)
{
    return {scene.walls, on == "ground" ? "" : on, reach_of(scene, far), scene.dimensions};
}

std::string unknown_ground(const Scene& scene, const std::string& on)
{
    const bool known = on.empty() || on == "ground" ||
                       std::ranges::find(scene.walls, on, &Wall::name) != scene.walls.end();
    return known ? ""
                 : fmt::format("`on` is \"{}\", expected \"ground\" or the name of a wall", on);
}

std::vector<PlaceFault> place_array(DebrisKeys& debris, Scene& scene)
{
    std::vector<PlaceFault> faults;
    const DebrisArray& array = *debris.array;
    Placing placing(debris, scene);
    const Vec3& extent = placing.extent();
    auto count = array.count;
    count[1] = scene.dimensions == 2 ? 1 : count[1];
    const double storey = array.pitch.z() > 0 ? array.pitch.z() : extent.z();
    if (count[2] > 1 && storey < extent.z() * (1 - 1e-9)) {
        faults.push_back({fmt::format("a stack with a pitch of {:.4g} m overlaps: the pieces are "
                                      "{:.4g} m high",
                                      storey, extent.z())});
    }
    const double turn = scene.dimensions == 2 ? 0 : array.turn_deg * std::numbers::pi / 180;
    const double far = array.from.norm() +
                       static_cast<double>(count[0]) * std::abs(array.pitch.x()) +
                       static_cast<double>(count[1]) * std::abs(array.pitch.y()) + extent.norm();
    const Ground ground = ground_for(scene, array.on, far);
    for (std::int64_t n = 0; n < count[0] * count[1] && faults.empty(); ++n) {
        const double i = static_cast<double>(n % count[0]);
        const std::int64_t row = n / count[0];
        const double j = static_cast<double>(row);
        const Plan2 at{array.from.x() + i * array.pitch.x(), array.from.y() + j * array.pitch.y()};
        double z = array.from.z();
        if (!array.on.empty()) {
            const Rest rest = rest_on(ground, footprint(extent, at, turn, 0));
            const std::string fault = fault_of(rest, extent.z(), at);
            if (!fault.empty()) {
                return {{"a piece " + fault, hint_of_ground(scene)}};
            }
            z = rest.height + clearance + extent.z() / 2;
        }
        for (std::int64_t k = 0; k < count[2]; ++k) {
            placing.put({at[0], at[1], z + static_cast<double>(k) * storey}, turn);
        }
    }
    return faults;
}

struct Spot {
    Plan2 at{};
    double turn = 0;
    double ground = 0;
    std::vector<Plan2> covered; // with half of the gap around it
};

// A body that is there already, seen from above and along z.
struct Taken {
    std::vector<Plan2> covered;
    double low = 0, high = 0; // [m]
};

// The bodies of the scene that reach into a box seen from above.
std::vector<Taken> bodies_in(const Scene& scene, const Plan2& low, const Plan2& high)
{
    std::vector<Taken> found;
    for (const BodySettings& body : scene.bodies) {
        const Placed solid = placed(body, scene.dimensions);
        const Bounds box = bounds(solid);
        if (box.max.x() < low[0] || box.min.x() > high[0] || box.max.y() < low[1] ||
            box.min.y() > high[1]) {
            continue;
        }
        const Bounds own = bounds({.shape = solid.shape, .dimensions = scene.dimensions});
        std::vector<Plan2> corners;
        for (int k = 0; k < 8; ++k) {
            const Vec3 corner((k & 1) != 0 ? own.max.x() : own.min.x(),
                              (k & 2) != 0 ? own.max.y() : own.min.y(),
                              (k & 4) != 0 ? own.max.z() : own.min.z());
            const Vec3 p = solid.centre + solid.rotation * corner;
            corners.push_back({p.x(), p.y()});
        }
        found.push_back({hull_of(std::move(corners)), box.min.z(), box.max.z()});
    }
    return found;
}

// The pieces and bodies that a yard already holds.
struct Occupied {
    std::vector<Taken> bodies;
    std::vector<Spot> pieces;
};

// Whether a spot is clear of bodies at the heights of a piece there.
bool is_clear(const std::vector<Taken>& bodies, const Spot& spot, double height, double gap)
{
    const double low = spot.ground + clearance;
    return std::ranges::none_of(bodies, [&](const Taken& body) {
        return body.low < low + height && body.high > low &&
               apart(spot.covered, body.covered) < gap / 2;
    });
}

// A place in the yard that is free, by random sequential addition; false if none was found.
bool find_spot(const DebrisScatter& scatter, const Vec3& extent, const Ground& ground,
               const Occupied& occupied, Dice& dice, Spot& spot)
{
    const Frame2 frame = frame_of(scatter.polygon);
    for (int n = 0; n < most_tries; ++n) {
        spot.at = {dice.between(frame.low[0], frame.high[0]),
                   dice.between(frame.low[1], frame.high[1])};
        spot.turn = dice.between(scatter.turn_deg[0], scatter.turn_deg[1]) * std::numbers::pi / 180;
        const std::vector<Plan2> own = footprint(extent, spot.at, spot.turn, 0);
        if (!holds_all(scatter.polygon, own)) {
            continue;
        }
        spot.covered = footprint(extent, spot.at, spot.turn, scatter.gap / 2);
        const bool free = std::ranges::none_of(occupied.pieces, [&](const Spot& other) {
            return apart(spot.covered, other.covered) < 0;
        });
        if (!free) {
            continue;
        }
        const Rest rest = rest_on(ground, own);
        spot.ground = rest.height;
        if (fault_of(rest, extent.z(), spot.at).empty() &&
            is_clear(occupied.bodies, spot, extent.z(), scatter.gap)) {
            return true;
        }
    }
    return false;
}

std::vector<PlaceFault> scatter_over_yard(DebrisKeys& debris, Scene& scene)
{
    const DebrisScatter& scatter = *debris.scatter;
    if (scene.dimensions == 2) {
        return {{"a yard has a width, so it needs three dimensions", "use `array`"}};
    }
    if (scatter.turn_deg[1] < scatter.turn_deg[0]) {
        return {{"the maximum of `turn_deg` is below the minimum"}};
    }
    Placing placing(debris, scene);
    const Vec3& extent = placing.extent();
    const Frame2 frame = frame_of(scatter.polygon);
    const double least = std::min(extent.x(), extent.y());
    if (std::min(frame.high[0] - frame.low[0], frame.high[1] - frame.low[1]) < least) {
        return {{fmt::format("the yard is {:.3g} m by {:.3g} m, too small for a piece of {:.3g} m "
                             "by {:.3g} m",
                             frame.high[0] - frame.low[0], frame.high[1] - frame.low[1], extent.x(),
                             extent.y()),
                 "its coordinates must be in metres; degrees have to be projected, for instance "
                 "to UTM"}};
    }
    double far = 0;
    for (const Plan2& corner : scatter.polygon) {
        far = std::max(far, std::hypot(corner[0], corner[1]));
    }
    const Ground ground = ground_for(scene, scatter.on, far);
    Dice dice(scene.seed, debris.name);
    Occupied occupied{bodies_in(scene, frame.low, frame.high), {}};
    while (std::ssize(occupied.pieces) < scatter.count) {
        Spot spot;
        if (!find_spot(scatter, extent, ground, occupied, dice, spot)) {
            return {{fmt::format("the yard has room for {} of {} pieces on level ground, after {} "
                                 "attempts to place the next",
                                 occupied.pieces.size(), scatter.count, most_tries),
                     "use a larger yard, fewer pieces, or a smaller `gap`"}};
        }
        placing.put({spot.at[0], spot.at[1], spot.ground + clearance + extent.z() / 2}, spot.turn);
        occupied.pieces.push_back(std::move(spot));
    }
    return {};
}

} // namespace

std::vector<PlaceFault> place_debris(DebrisKeys& debris, Scene& scene)
{
    if (debris.size) {
        debris.load.size.assign(debris.size->begin(), debris.size->end());
    }
    const std::string unknown =
        unknown_ground(scene, debris.array ? debris.array->on : debris.scatter->on);
    if (!unknown.empty()) {
        return {{unknown}};
    }
    return debris.array ? place_array(debris, scene) : scatter_over_yard(debris, scene);
}

} // namespace hyoryu
