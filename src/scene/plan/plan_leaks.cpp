// SPDX-License-Identifier: MIT
#include "plan_leaks.hpp"

#include "hyoryu/scene/case_file.hpp"
#include "hyoryu/scene/fill.hpp"
#include "plan_columns.hpp"
#include "plan_warnings.hpp"
#include "scene/case/units.hpp"
#include "scene/surfaces/free_space.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <queue>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace hyoryu {

namespace {

// The ground of columns: the top of the lowest contiguous stack of wall particles. Wall particles
// farther above stand over a gap through which water passes, unless the gap is the inside of a
// wall, which has particles behind its surface only.
class Grounds {
public:
    // `walls`: ascending.
    Grounds(const Scene& scene, const Columns& columns, std::span<const WallStack> walls)
        : space_(scene), columns_(columns), spacing_(scene.spacing), walls_(walls)
    {
    }

    /// Ground of a column and its neighbours [m]; -infinity without walls, or if all walls stand
    /// over a gap above the ground `from` of the column beside it.
    double about(const Columns::Number& column, double from = infinity) const
    {
        const std::vector<Span> heights = heights_about(column);
        if (heights.empty() || has_gap(column, from, heights.front().lowest)) {
            return -infinity;
        }
        double top = heights.front().highest;
        for (const Span& next : heights) {
            if (has_gap(column, top, next.lowest)) {
                break;
            }
            top = std::max(top, next.highest);
        }
        return top;
    }

private:
    // Whether there is room for water between two particles.
    bool has_gap(const Columns::Number& column, double low, double high) const
    {
        Vec3 middle = columns_.middle_of(column);
        middle.z() = (low + high) / 2;
        return std::isfinite(low) && high - low > WallStack::gap * spacing_ &&
               !space_.is_in_wall(middle);
    }

    // From below.
    std::vector<Span> heights_about(const Columns::Number& column) const
    {
        std::vector<Span> all;
        for (const Columns::Number& beside : Columns::block_about(column)) {
            const auto stacks = std::ranges::equal_range(walls_, beside, {}, &WallStack::column);
            std::ranges::transform(stacks, std::back_inserter(all), [](const WallStack& stack) {
                return Span{stack.low, stack.high};
            });
        }
        std::ranges::sort(all, {}, &Span::lowest);
        return all;
    }

    FreeSpace space_;
    const Columns& columns_;
    double spacing_;
    std::span<const WallStack> walls_;
};

// The scene, the facts of its plan and the columns of its walls at the start.
struct LeakContext {
    const Scene& scene;
    const PlanFacts& facts;
    Columns walls;
};

void warn_about_bottoms(const LeakContext& start, Plan& plan)
{
    if (start.facts.unsupported > 0) {
        warn(start.scene, {}, "wall",
             fmt::format(
                 "{} fluid particles have no wall below them and will fall out of the domain",
                 start.facts.unsupported),
             "add a floor: a wall of shape \"plane\" or \"basin\"", plan);
    }
}

// Where water leaves by design: beyond a period, or through the window of an open side.
bool lets_out(const Scene& scene, const Vec3& from, const Vec3& to)
{
    for (const int axis : {0, 1}) {
        // The middle of the last column of a period may lie beyond it: both may.
        if (scene.domain && scene.domain->periodic[at(axis)] &&
            (to[axis] < scene.domain->min[axis] || to[axis] > scene.domain->max[axis])) {
            return true;
        }
        const auto crosses = [&](double plane) {
            return (from[axis] < plane) != (to[axis] < plane);
        };
        const int along = 1 - axis;
        if (std::ranges::any_of(scene.open, [&](const OpenSettings& open) {
                return open.axis() == axis && crosses(open.plane()) &&
                       from[along] >= open.min[along] - scene.spacing &&
                       from[along] <= open.max[along] + scene.spacing;
            })) {
            return true;
        }
    }
    return false;
}

// Whether a place lies outside of an open side, in its buffer particles.
bool is_in_carpet(const Scene& scene, const Vec3& place)
{
    return std::ranges::any_of(scene.open, [&](const OpenSettings& open) {
        return (place[open.axis()] - open.plane()) * open.sign() < 0;
    });
}

// Columns that water reaches next to those without ground, by direction: -x, +x, -y, +y.
struct Drops {
    std::array<Vec3, 4> first{};
    std::array<Index, 4> columns{};
};

// Height to which the water of a column may rise elsewhere: its top less its initial fall.
double level_of(const Span& water, double ground, double spacing)
{
    const double fall = ground < water.lowest ? water.lowest - ground - 2 * spacing : 0;
    return water.highest - std::max(fall, 0.0);
}

// The level to which water may rise again on the ground below a step: it keeps its depth if it
// falls by more than that.
double after_fall(double level, double above, double below, double spacing)
{
    const double fall = above - below;
    return std::isfinite(fall) && fall > level - above + 2 * spacing ? level - fall : level;
}

// Spreads from each column of the fluid over walls that are lower than its water, and below walls
// over a gap, the highest first. Places that only waves reach are not found.
Drops drops_of(const Scene& scene, const Columns& fluid, const Grounds& grounds)
{
    std::set<Columns::Number> reached;
    std::priority_queue<std::pair<double, Columns::Number>> front;
    for (const auto& [column, span] : fluid.spans()) {
        reached.insert(column);
        if (is_in_carpet(scene, fluid.middle_of(column))) {
            continue;
        }
        front.emplace(level_of(span, grounds.about(column), scene.spacing), column);
    }
    Drops drops;
    const std::size_t ways = scene.dimensions == 2 ? 2 : 4;
    while (!front.empty()) {
        const auto [level, column] = front.top();
        front.pop();
        const double here = grounds.about(column);
        for (std::size_t way = 0; way < ways; ++way) {
            Columns::Number beside = column;
            beside[way / 2] += way % 2 == 0 ? -1 : 1;
            if (reached.contains(beside) ||
                lets_out(scene, fluid.middle_of(column), fluid.middle_of(beside))) {
                continue;
            }
            const double top = grounds.about(beside, here);
            if (top == -infinity) {
                drops.first[way] =
                    drops.columns[way] == 0 ? fluid.middle_of(column) : drops.first[way];
                drops.columns[way] += 1;
            } else if (top < level) {
                reached.insert(beside);
                front.emplace(after_fall(level, here, top, scene.spacing), beside);
            }
        }
    }
    return drops;
}

constexpr std::array directions{"-x", "+x", "-y", "+y"};

void warn_about_drops(const Scene& scene, const Place& place, const std::string& when,
                      const Drops& drops, Plan& plan)
{
    for (std::size_t way = 0; way < directions.size(); ++way) {
        if (drops.columns[way] > 0) {
            warn(scene, place, "wall",
                 fmt::format(
                     "{}water can reach the edge of the ground in direction {} and leave "
                     "the scene, first at x = {:.4g} m{}",
                     when, directions[way], drops.first[way].x(),
                     scene.dimensions == 2
                         ? ""
                         : fmt::format(", y = {:.4g} m, over a width of {:.3g} m",
                                       drops.first[way].y(),
                                       static_cast<double>(drops.columns[way]) * scene.spacing)),
                 "close that side, or add a floor beyond it; an `[[open]]` side lets water out and "
                 "records the outflow",
                 plan);
        }
    }
}

// How far a wall rises at most [m].
double rise_of(const Motion& motion, double end)
{
    double most = displacement(motion, end).z();
    for (std::size_t k = 0; k < motion.times.size() && motion.times[k] < end; ++k) {
        most = std::max(most, motion.places[k].z());
    }
    return most;
}

void raise(Wall& wall, double rise)
{
    if (auto* plane = std::get_if<PlaneWall>(&wall.geometry)) {
        plane->point.z() += rise;
    } else if (auto* basin = std::get_if<BasinWall>(&wall.geometry)) {
        basin->min.z() += rise;
        basin->max.z() += rise;
    } else if (auto* round = std::get_if<RoundWall>(&wall.geometry)) {
        round->centre.z() += rise;
    } else if (auto* solid = std::get_if<SolidWall>(&wall.geometry)) {
        solid->centre.z() += rise;
    }
}

// A scene with some of its walls where they are highest, and the particles of its walls.
struct Raised {
    Scene scene;
    std::vector<WallStack> walls;
};

Raised raised(const LeakContext& start, std::span<const std::size_t> gates)
{
    Raised result{start.scene, start.facts.walls};
    std::vector<double> rise(result.scene.walls.size(), 0);
    for (const std::size_t gate : gates) {
        rise[gate] = rise_of(result.scene.walls[gate].motion, result.scene.time.end);
        raise(result.scene.walls[gate], rise[gate]);
    }
    for (WallStack& stack : result.walls) {
        stack.low += rise[at(stack.wall)];
        stack.high += rise[at(stack.wall)];
    }
    std::ranges::sort(result.walls);
    return result;
}

std::string names_of(const Scene& scene, std::span<const std::size_t> gates)
{
    std::string names;
    for (const std::size_t gate : gates) {
        names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", scene.walls[gate].name);
    }
    return names + (gates.size() == 1 ? " has" : " have");
}

// The water that still has a wall below it when walls have risen. The rest is carried up by them,
// or falls.
Columns held_still(const LeakContext& start, const Columns& walls)
{
    Columns held(start.scene.spacing);
    for (const auto& [column, heights] : start.facts.water.spans()) {
        if (start.walls.about(column).lowest > heights.lowest ||
            walls.about(column).lowest <= heights.lowest) {
            held.add(column, heights);
        }
    }
    return held;
}

// Warns of drops that the water reaches once some walls are at their highest. Returns whether it
// warned.
bool warn_about_raised(const LeakContext& start, std::span<const std::size_t> gates,
                       const Drops& before, Plan& plan)
{
    const Scene& scene = start.scene;
    const Raised after = raised(start, gates);
    const Columns walls = columns_of(scene.spacing, after.walls);
    const Columns held = held_still(start, walls);
    Drops drops = drops_of(after.scene, held, Grounds(after.scene, walls, after.walls));
    for (std::size_t way = 0; way < directions.size(); ++way) {
        drops.columns[way] = before.columns[way] > 0 ? 0 : drops.columns[way]; // reported already
    }
    warn_about_drops(scene, scene.walls[gates.front()].place,
                     fmt::format("once {} risen, ", names_of(scene, gates)), drops, plan);
    return std::ranges::any_of(drops.columns, [](Index columns) { return columns > 0; });
}

// Gates that open: each alone, and all together where none alone lets water out. A wall that only
// moves aside, as a piston does, stays where it is at the start.
void warn_about_gates(const LeakContext& start, const Drops& before, Plan& plan)
{
    const Scene& scene = start.scene;
    std::vector<std::size_t> gates;
    bool told = false;
    for (std::size_t w = 0; w < scene.walls.size(); ++w) {
        if (rise_of(scene.walls[w].motion, scene.time.end) > 0) {
            gates.push_back(w);
            told |= warn_about_raised(start, std::array{w}, before, plan);
        }
    }
    if (gates.size() > 1 && !told) {
        warn_about_raised(start, gates, before, plan);
    }
}

void warn_about_sides(const LeakContext& start, Plan& plan)
{
    const Scene& scene = start.scene;
    const Drops drops =
        drops_of(scene, start.facts.water, Grounds(scene, start.walls, start.facts.walls));
    warn_about_drops(scene, {}, "", drops, plan);
    warn_about_gates(start, drops, plan);
}

// Whether the columns below a body hold water or a wall that it may float in or rest on.
bool has_support(const LeakContext& start, const BodySettings& body)
{
    const Bounds box = bounds(placed(body, start.scene.dimensions));
    const Columns::Number first = start.walls.number_of(box.min);
    const Columns::Number last = start.walls.number_of(box.max);
    for (Columns::Number column = first; column[1] <= last[1]; ++column[1]) {
        for (column[0] = first[0]; column[0] <= last[0]; ++column[0]) {
            if (start.facts.water.reaches(column, box.max.z()) ||
                start.walls.about(column).lowest <= box.max.z()) {
                return true;
            }
        }
    }
    return false;
}

bool may_fall(const BodySettings& body)
{
    const bool thrown = body.velocity != Vec3(0, 0, 0); // perhaps over the walls, or up from below
    return !body.fixed && !body.locks[2] && !thrown;
}

// A body below is as good as a wall: it has a warning of its own.
bool is_over_another(const Scene& scene, const BodySettings& body)
{
    const Bounds own = bounds(placed(body, scene.dimensions));
    return std::ranges::any_of(scene.bodies, [&](const BodySettings& other) {
        const Bounds box = bounds(placed(other, scene.dimensions));
        return other.position.z() < body.position.z() && own.min.x() < box.max.x() &&
               box.min.x() < own.max.x() && own.min.y() <= box.max.y() &&
               box.min.y() <= own.max.y();
    });
}

void warn_about_bodies(const LeakContext& start, Plan& plan)
{
    const Scene& scene = start.scene;
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
        const BodySettings& body = scene.bodies[b];
        const bool copy = b > 0 && body.place.line == scene.bodies[b - 1].place.line;
        if (!copy && may_fall(body) && !has_support(start, body) && !is_over_another(scene, body)) {
            warn(scene, body.place, table_of(body, b),
                 fmt::format("body \"{}\" has neither wall nor water below it and will fall out of "
                             "the domain",
                             body.name),
                 "check its `position`, or add a floor", plan);
        }
    }
}

} // namespace

void warn_about_leaks(const Scene& scene, const PlanFacts& facts, Plan& plan)
{
    if (!falls_along_z(scene)) {
        return;
    }
    const LeakContext start{scene, facts, columns_of(scene.spacing, facts.walls)};
    warn_about_bottoms(start, plan);
    if (facts.fluid > 0) {
        warn_about_sides(start, plan);
    }
    warn_about_bodies(start, plan);
}

} // namespace hyoryu
