// SPDX-License-Identifier: MIT
// The ground below a window, from the exact surfaces of the walls.
#include "open_side.hpp"
#include "hyoryu/scene/fill.hpp"
#include "hyoryu/scene/open_settings.hpp"
#include "hyoryu/scene/solid_surface.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace hyoryu {

namespace {

// Distance of a point from the nearest wall, negative inside of one.
double distance_to_walls(const std::vector<SolidSurface>& surfaces, const Vec3& point)
{
    double least = infinity;
    for (const SolidSurface& surface : surfaces) {
        least = std::min(least, nearest_from_centre(surface, point - surface.centre).distance);
    }
    return least;
}

// The lowest height from which on a vertical is free of walls, between two heights: by steps of
// half a spacing from below, then by halving. Infinity if none is. A vertical that begins below the
// underside of a wall rises to that wall first.
double ground_at(const std::vector<SolidSurface>& surfaces, Vec3 point, double low, double high,
                 double spacing)
{
    const double shallow = 1e-6 * spacing; // the surface itself is free
    const auto distance = [&](double z) {
        point.z() = z;
        return distance_to_walls(surfaces, point);
    };
    const auto is_free = [&](double z) { return distance(z) > -shallow; };
    double free = low;
    const bool hangs = is_free(low) && is_free(low - spacing / 2); // above no ground
    if (hangs || distance(low) > spacing / 2) {
        while (free <= high && is_free(free)) {
            free += spacing / 2;
        }
    } else if (is_free(low) && !is_free(low + 1e-3 * spacing)) {
        free += 1e-3 * spacing; // on an underside
    }
    double solid = free;
    while (free <= high && !is_free(free)) {
        solid = free;
        free += spacing / 2;
    }
    if (free > high) {
        return is_free(low) && solid > high ? low : infinity;
    }
    for (int k = 0; k < 40 && free > solid; ++k) {
        const double middle = (free + solid) / 2;
        (is_free(middle) ? free : solid) = middle;
    }
    return free;
}

// Whether in any lane with ground the distance from the walls passes a test, at a distance from the
// window and `above` the ground.
bool any_lane(const Scene& scene, const OpenSide& side, double distance, double above,
              const auto& test)
{
    const auto surfaces = surfaces_of(scene.walls, thickness_of_rows(scene), scene.dimensions);
    for (int lane = 0; lane < side.lanes(); ++lane) {
        const double bed = side.bed[at(lane)];
        Vec3 x = point_of_window(side, lane, distance);
        x.z() = bed + above;
        if (bed < infinity && test(distance_to_walls(surfaces, x))) {
            return true;
        }
    }
    return false;
}

} // namespace

Vec3 point_of_window(const OpenSide& side, int lane, double distance)
{
    Vec3 x = Vec3::Zero();
    x[side.axis] = side.plane + side.into * distance;
    x[1 - side.axis] = side.middle(lane);
    return x;
}

int carpet_columns(const Scene& scene, const OpenSettings& open)
{
    constexpr int ahead = 5; // columns before the front of a body, where the flow is given
    double longest = 0;
    for (const BodySettings& body : scene.bodies) {
        if (open.bodies == BodiesAtSide::leave && !body.fixed) {
            const Bounds box = bounds({.shape = &body.shape, .dimensions = scene.dimensions});
            Vec3 size = box.max - box.min;
            size.y() = scene.dimensions == 2 ? 0 : size.y();
            longest = std::max(longest, size.norm()); // however it turns
        }
    }
    const int least = least_carpet_columns(scene.fluid->smoothing_ratio);
    return longest > 0 ? least + ahead + static_cast<int>(std::ceil(longest / scene.spacing))
                       : least;
}

namespace {

// The ground from which walls rise: the highest that lies below that of no column by more than one
// spacing for each column between them, found by two passes along each direction.
std::vector<double> ground_below_walls(std::vector<double> ground, double spacing)
{
    const auto lanes = static_cast<int>(ground.size()) / strip_columns;
    const auto lower = [&](int to, int from) {
        ground[at(to)] = std::min(ground[at(to)], ground[at(from)] + spacing);
    };
    const auto sweep = [&](int begin, int step, int count) {
        for (int k = 1; k < count; ++k) {
            lower(begin + k * step, begin + (k - 1) * step);
        }
        for (int k = count - 1; k > 0; --k) {
            lower(begin + (k - 1) * step, begin + k * step);
        }
    };
    for (int lane = 0; lane < lanes; ++lane) {
        sweep(lane * strip_columns, 1, strip_columns);
    }
    for (int k = 0; k < strip_columns; ++k) {
        sweep(k, strip_columns, lanes);
    }
    return ground;
}

// Marks the columns that are walls on the ground of the strip.
void mark_walls(const std::vector<double>& grounds, double spacing, OpenSide& side)
{
    std::vector<double> below = ground_below_walls(grounds, spacing);
    std::vector<std::uint8_t> wall;
    for (std::size_t k = 0; k < grounds.size(); ++k) {
        const bool rises = !(grounds[k] < infinity) || grounds[k] > below[k] + 1e-6 * spacing;
        wall.push_back(rises ? 1 : 0);
    }
    if (std::ranges::find(wall, 1) != wall.end()) {
        side.wall = std::move(wall);
        side.below_wall = std::move(below);
    }
}

// The mean ground of the strip of a lane: where no wall stands, or of the walls if they fill it;
// infinity where there is no ground.
double strip_ground(const std::vector<double>& grounds, const OpenSide& side, int lane)
{
    double mean = 0;
    double walls = 0;
    double part = 0; // of the weight, on ground and on walls that end below the window
    double on_walls = 0;
    for (int k = 0; k < strip_columns; ++k) {
        const double s = k + 0.5;
        const double weight = (1 - std::abs(s - 4) / 4) / 4;
        const double ground = grounds[at(lane * strip_columns + k)];
        if (!side.has_wall(lane, k)) {
            mean += weight * ground;
            part += weight;
        } else if (ground < infinity) {
            walls += weight * ground;
            on_walls += weight;
        }
    }
    if (part > 0) {
        return side.wall.empty() ? mean : mean / part;
    }
    return on_walls > 0 ? walls / on_walls : infinity;
}

// The number of lanes whose width is nearest to a spacing, as a ratio.
int lanes_of(double width, double spacing)
{
    const double number = width / spacing;
    const double fewer = std::max(std::floor(number + 1e-6), 1.0);
    return static_cast<int>(sq(number) > fewer * (fewer + 1) ? fewer + 1 : fewer);
}

} // namespace

OpenSide open_side(const Scene& scene, const OpenSettings& open)
{
    const double dp = scene.spacing;
    const auto across = at(1 - open.axis());
    OpenSide side;
    side.axis = open.axis();
    side.plane = open.plane();
    side.into = open.sign();
    side.low = open.min.z();
    side.flat = scene.dimensions == 2;
    side.columns = carpet_columns(scene, open);
    side.repeats = scene.domain && scene.domain->periodic[across];
    const double width = open.width(scene.dimensions);
    const int lanes = scene.dimensions == 2 ? 1 : lanes_of(width, dp);
    const bool whole = std::abs(width - lanes * dp) < 1e-6 * dp; // up to rounding
    side.lane_width = scene.dimensions == 2 || whole ? dp : width / lanes;
    side.first = scene.dimensions == 2
                     ? 0
                     : open.min[1 - open.axis()] + (width - lanes * side.lane_width) / 2;
    const auto surfaces = surfaces_of(scene.walls, thickness_of_rows(scene), scene.dimensions);
    std::vector<double> grounds; // by lane and column
    for (int lane = 0; lane < lanes; ++lane) {
        for (int k = 0; k < strip_columns; ++k) {
            const Vec3 x = point_of_window(side, lane, (k + 0.5) * dp);
            grounds.push_back(ground_at(surfaces, x, open.min.z(), open.max.z(), dp));
        }
    }
    for (int lane = 0; lane < lanes; ++lane) {
        side.bed.push_back(grounds[at(lane * strip_columns)]);
    }
    mark_walls(grounds, dp, side);
    for (int lane = 0; lane < lanes; ++lane) {
        side.strip.push_back(strip_ground(grounds, side, lane));
    }
    return side;
}

bool is_walled(const Scene& scene, const OpenSide& side)
{
    return any_lane(scene, side, -0.5 * scene.spacing, scene.spacing,
                    [&](double distance) { return distance < -1e-6 * scene.spacing; });
}

bool stands_on_ground(const Scene& scene, const OpenSide& side)
{
    return !any_lane(scene, side, 0.5 * scene.spacing, 0,
                     [&](double distance) { return distance > 0.5 * scene.spacing; });
}

bool is_barred(const Scene& scene, const OpenSide& side, double level)
{
    const double dp = scene.spacing;
    const auto surfaces = surfaces_of(scene.walls, thickness_of_rows(scene), scene.dimensions);
    const auto is_free = [&](int lane, int column) {
        Vec3 x = point_of_window(side, lane, (column + 0.5) * dp);
        x.z() = level - dp / 4;
        return distance_to_walls(surfaces, x) >= 0;
    };
    std::vector<std::uint8_t> reached(side.wall.size(), 0);
    std::vector<std::pair<int, int>> ways; // to go on from
    const auto reach = [&](int lane, int column) {
        const auto cell = at(lane * strip_columns + column);
        if (reached[cell] == 0 && (!side.has_wall(lane, column) || is_free(lane, column))) {
            reached[cell] = 1;
            ways.emplace_back(lane, column);
        }
    };
    for (int lane = 0; lane < side.lanes() && !side.wall.empty(); ++lane) {
        reach(lane, 0);
    }
    bool leads_out = side.wall.empty();
    while (!ways.empty() && !leads_out) {
        const auto [lane, column] = ways.back();
        ways.pop_back();
        leads_out = column == strip_columns - 1;
        for (const int k : {column - 1, column + 1}) {
            if (k >= 0 && k < strip_columns) {
                reach(lane, k);
            }
        }
        for (const int beside : {lane - 1, lane + 1}) {
            const int m = side.repeats ? (beside + side.lanes()) % side.lanes() : beside;
            if (m >= 0 && m < side.lanes()) {
                reach(m, column);
            } else {
                leads_out = leads_out || (scene.dimensions == 3 && is_free(m, column));
            }
        }
    }
    return !leads_out;
}

double ground_behind(const Scene& scene, const OpenSide& side)
{
    constexpr double near = 1.5;
    const double dp = scene.spacing;
    const auto surfaces = surfaces_of(scene.walls, thickness_of_rows(scene), scene.dimensions);
    double least = side.columns * dp;
    for (int lane = 0; lane < side.lanes(); ++lane) {
        double ground = side.bed[at(lane)];
        for (double s = dp / 2; ground < infinity && s < least + near * dp; s += dp) {
            Vec3 x = point_of_window(side, lane, -s);
            x.z() = ground;
            const double above = distance_to_walls(surfaces, x);
            if (above > near * dp) {
                least = std::min(least, std::max(s - near * dp, 0.0));
            }
            ground -= above; // follows a slope
        }
    }
    return least;
}

namespace {

// A wall particle: its place in the layers of its wall, and how far it is carried from there.
struct WallParticle {
    Vec3 home{0, 0, 0};
    std::int32_t wall = 0;
    double depth = 0; // behind the surface, the same wherever it is carried [m]
    Index number = 0; // of the place in the layers
    Vec3 shift{0, 0, 0};
    Vec3 place() const { return home + shift; }
};

std::vector<WallParticle> wall_particles(const Filling& filling)
{
    std::vector<WallParticle> particles;
    std::size_t run = 0;
    for (std::size_t k = 0; k < filling.wall.size(); ++k) {
        const auto index = static_cast<Index>(k);
        while (run + 1 < filling.wall_runs.size() && filling.wall_runs[run + 1].first <= index) {
            ++run;
        }
        const WallRun& of = filling.wall_runs[run];
        particles.push_back({filling.wall[k], filling.wall_owner[k],
                             filling.wall_depth.empty() ? 0 : filling.wall_depth[k],
                             of.place + index - of.first, Vec3::Zero()});
    }
    return particles;
}

void set_wall_particles(std::span<const WallParticle> particles, Filling& filling)
{
    const bool sticks = !filling.wall_depth.empty();
    filling.wall.clear();
    filling.wall_owner.clear();
    filling.wall_depth.clear();
    filling.wall_runs.clear();
    std::vector<Vec3>& shifts = filling.wall_shifts;
    const WallParticle* before = nullptr;
    for (const WallParticle& p : particles) {
        const auto index = static_cast<Index>(filling.wall.size());
        if (before == nullptr || p.wall != before->wall || p.number != before->number + 1 ||
            p.shift != before->shift) {
            const auto found = std::ranges::find(shifts, p.shift) - shifts.begin();
            if (found == std::ssize(shifts)) {
                shifts.push_back(p.shift);
            }
            filling.wall_runs.push_back(
                {index, p.number, p.wall, static_cast<std::int32_t>(found)});
        }
        filling.wall.push_back(p.place());
        filling.wall_owner.push_back(p.wall);
        if (sticks) {
            filling.wall_depth.push_back(p.depth);
        }
        before = &p;
    }
}

// The walls of a scene with those at one window carried out.
std::vector<WallParticle> carried_out(const CarriedWalls& window,
                                      std::span<const WallParticle> walls)
{
    std::vector<WallParticle> all;
    std::ranges::copy_if(walls, std::back_inserter(all),
                         [&](const WallParticle& p) { return window.stays(p.place(), p.wall); });
    for (int column = 1; column <= window.columns(); ++column) { // by columns: their runs go on
        for (const WallParticle& p : walls) {
            if (window.is_copied(p.place(), p.wall)) {
                all.emplace_back(p).shift += window.shift(column);
            }
        }
    }
    return all;
}

} // namespace

CarriedWalls::CarriedWalls(const Scene& scene, const OpenSettings& open)
    : scene_(scene), open_(open), layers_(wall_layers(scene.fluid->smoothing_ratio)),
      columns_(carpet_columns(scene, open) + layers_)
{
}

bool CarriedWalls::stays(const Vec3& place, std::int32_t wall) const
{
    return distance(place) >= 0 || !belongs(place, wall);
}

bool CarriedWalls::is_copied(const Vec3& place, std::int32_t wall) const
{
    const double from = distance(place);
    return from >= 0 && from < scene_.spacing * (1 - 1e-6) && belongs(place, wall);
}

Vec3 CarriedWalls::shift(int column) const
{
    return -(open_.sign() * column * scene_.spacing * Vec3::Unit(open_.axis()));
}

double CarriedWalls::distance(const Vec3& place) const
{
    return open_.sign() * (place[open_.axis()] - open_.plane());
}

bool CarriedWalls::belongs(const Vec3& place, std::int32_t wall) const
{
    const Index across = 1 - open_.axis();
    const double margin = (layers_ + 0.5) * scene_.spacing;
    const bool beside = scene_.dimensions == 2 || (place[across] > open_.min[across] - margin &&
                                                   place[across] < open_.max[across] + margin);
    return beside && !moves(scene_.walls[at(wall)].motion);
}

void carry_walls_out(const Scene& scene, Filling& filling)
{
    if (scene.open.empty()) {
        return;
    }
    std::vector<WallParticle> walls = wall_particles(filling);
    for (const OpenSettings& open : scene.open) {
        walls = carried_out(CarriedWalls(scene, open), walls);
    }
    set_wall_particles(walls, filling);
}

} // namespace hyoryu
