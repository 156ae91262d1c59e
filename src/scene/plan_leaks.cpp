// SPDX-License-Identifier: MIT
#include "plan_leaks.hpp"

#include "hyoryu/scene/case_file.hpp"
#include "hyoryu/scene/fill.hpp"
#include "plan_warnings.hpp"
#include "units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

namespace hyoryu {

namespace {

// Columns of a spacing, by their numbers along x and y, with the lowest of some points in each.
class Columns {
public:
    using Number = std::array<long long, 2>;

    Columns(double spacing, const std::vector<Vec3>& points) : spacing_(spacing)
    {
        for (const Vec3& p : points) {
            const auto at = lowest_.try_emplace(number_of(p), p).first;
            at->second = p.z() < at->second.z() ? p : at->second;
        }
    }

    Number number_of(const Vec3& p) const
    {
        return {std::llround(std::floor(p.x() / spacing_)),
                std::llround(std::floor(p.y() / spacing_))};
    }
    const std::map<Number, Vec3>& lowest() const { return lowest_; }
    bool has(const Number& column) const { return lowest_.contains(column); }
    /// Whether a column or one of those about it has a point that is not above a height. Walls that
    /// do not follow the lattice leave columns out.
    bool has_about(const Number& column, double height) const
    {
        for (long long k = 0; k < 9; ++k) {
            const auto below = lowest_.find({column[0] + k % 3 - 1, column[1] + k / 3 - 1});
            if (below != lowest_.end() && below->second.z() <= height) {
                return true;
            }
        }
        return false;
    }

private:
    double spacing_;
    std::map<Number, Vec3> lowest_;
};

void warn_about_bottoms(const Scene& scene, const Filling& filling, const Columns& walls,
                        Plan& plan)
{
    const auto open = std::ranges::count_if(
        filling.fluid, [&](const Vec3& p) { return !walls.has_about(walls.number_of(p), p.z()); });
    if (open > 0) {
        warn(
            scene, {}, "wall",
            fmt::format(
                "{} fluid particles have no wall below them and will fall out of the domain", open),
            "add a floor: a wall of shape \"plane\" or \"basin\"", plan);
    }
}

// Whether water may leave along an axis by design.
bool lets_out(const Scene& scene, int axis)
{
    const bool repeats = scene.domain && scene.domain->periodic[static_cast<std::size_t>(axis)];
    return repeats || std::ranges::any_of(scene.open, [&](const OpenSettings& open) {
               return open.axis() == axis;
           });
}

// The lowest water of a side beside which nothing lies, neither water nor wall, at two and three
// spacings: on that side of it, how many columns.
struct Drop {
    Vec3 place{0, 0, 0};
    Index columns = 0;
};

std::optional<Drop> drop_beside(const Columns& fluid, const Columns& walls, int axis, int way)
{
    const auto a = static_cast<std::size_t>(axis);
    std::optional<Drop> drop;
    for (const auto& [column, place] : fluid.lowest()) {
        Columns::Number beside = column;
        bool empty = true;
        for (int step = 1; step <= 3; ++step) {
            beside[a] += way;
            empty =
                empty && !fluid.has(beside) && (step == 1 || !walls.has_about(beside, infinity));
        }
        if (empty) {
            drop = drop ? drop : Drop{place};
            drop->columns += 1;
        }
    }
    return drop;
}

void warn_about_sides(const Scene& scene, const Filling& filling, const Columns& walls, Plan& plan)
{
    const Columns fluid(scene.spacing, filling.fluid);
    for (const int axis : {0, 1}) {
        if ((scene.dimensions == 2 && axis == 1) || lets_out(scene, axis)) {
            continue;
        }
        for (const int way : {-1, 1}) {
            const std::optional<Drop> drop = drop_beside(fluid, walls, axis, way);
            if (!drop) {
                continue;
            }
            warn(
                scene, {}, "wall",
                fmt::format("water stands beside a drop: in direction {}{} of {} columns of fluid "
                            "particles, as at ({:.4g}, {:.4g}, {:.4g}) m, there is no wall at any "
                            "height, and it flows out of the domain",
                            way < 0 ? '-' : '+', "xy"[axis], drop -> columns, drop -> place.x(),
                            drop->place.y(), drop->place.z()),
                "close that side, or add a floor beyond it; an `[[open]]` side lets water out in a "
                "measured way",
                plan);
        }
    }
}

// Whether anything lies in the columns that a body covers that it may rest on or float in.
bool has_support(const Scene& scene, const BodySettings& body, const Columns& walls,
                 const Columns& fluid)
{
    const Bounds box = bounds(placed(body, scene.dimensions));
    const Columns::Number first = walls.number_of(box.min);
    const Columns::Number last = walls.number_of(box.max);
    for (Columns::Number column = first; column[1] <= last[1]; ++column[1]) {
        for (column[0] = first[0]; column[0] <= last[0]; ++column[0]) {
            if (fluid.has(column) || walls.has_about(column, box.max.z())) {
                return true;
            }
        }
    }
    return false;
}

bool may_fall(const BodySettings& body)
{
    return !body.fixed && !body.locks[2];
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

void warn_about_bodies(const Scene& scene, const Filling& filling, const Columns& walls, Plan& plan)
{
    const Columns fluid(scene.spacing, filling.fluid);
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
        const BodySettings& body = scene.bodies[b];
        const bool copy = b > 0 && body.place.line == scene.bodies[b - 1].place.line;
        if (!copy && may_fall(body) && !has_support(scene, body, walls, fluid) &&
            !is_over_another(scene, body)) {
            warn(scene, body.place, fmt::format("body[{}]", b),
                 fmt::format("body \"{}\" has neither wall nor water below it and will fall out of "
                             "the domain",
                             body.name),
                 "check its `position`, or add a floor", plan);
        }
    }
}

} // namespace

void warn_about_leaks(const Scene& scene, const Filling& filling, Plan& plan)
{
    if (scene.gravity.normalized().dot(-Vec3::UnitZ()) < 0.99) {
        return;
    }
    const Columns walls(scene.spacing, filling.wall);
    warn_about_bottoms(scene, filling, walls, plan);
    warn_about_sides(scene, filling, walls, plan);
    warn_about_bodies(scene, filling, walls, plan);
}

} // namespace hyoryu
