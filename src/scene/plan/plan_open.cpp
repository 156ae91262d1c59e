// SPDX-License-Identifier: MIT
#include "plan_open.hpp"

#include "plan_open_place.hpp"
#include "plan_warnings.hpp"
#include "scene/case/place_buildings.hpp"
#include "scene/filling/open_side.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace hyoryu {

namespace {

constexpr std::array<std::string_view, 3> kinds{"inflow", "outflow", "absorb"};
constexpr std::array<std::string_view, 4> directions_into{"+x", "-x", "+y", "-y"};
constexpr int samples = 400; // of a series over the run

// The water before a window at the start: its level, and its depth above the mean ground.
struct WaterAtStart {
    double level = -infinity, depth = 0;
    double deepest = 0; // above the lowest ground [m]
};

double mean_bed(const OpenSide& side)
{
    double total = 0;
    int count = 0;
    for (const double bed : side.bed) {
        total += bed < infinity ? bed : 0;
        count += bed < infinity ? 1 : 0;
    }
    return count > 0 ? total / count : infinity;
}

// `level`: of the highest particle.
WaterAtStart water_before(const OpenSide& side, double level)
{
    WaterAtStart water{.level = level};
    water.depth = std::max(water.level - mean_bed(side), 0.0);
    water.deepest = std::max(water.level - std::ranges::min(side.bed), 0.0);
    return water;
}

// The flow asked for in the middle of a window: depth, velocity and discharge of the whole width.
struct Inflow {
    double depth = 0, velocity = 0, discharge = 0;
};

Inflow inflow_at(const Scene& scene, const OpenSettings& open, const WaterAtStart& water,
                 double bed, double time)
{
    const double middle = open.min[1 - open.axis()] + open.width(scene.dimensions) / 2;
    const AskedFlow asked =
        asked_at(open, middle, time, {water.level, water.depth}, scene.dimensions);
    const double width = open.width(scene.dimensions);
    const double g = scene.gravity.norm();
    Inflow flow;
    if (asked.discharge) {
        flow.depth = std::max(water.depth, std::cbrt(sq(*asked.discharge) / g));
        flow.discharge = *asked.discharge * width;
    } else if (asked.level) {
        flow.depth = std::max(*asked.level - bed, 0.0);
        flow.velocity =
            asked.velocity.value_or(2 * std::sqrt(g * flow.depth) - 2 * std::sqrt(g * asked.still));
        flow.discharge = flow.depth * flow.velocity * width;
    }
    return flow;
}

double cube_of(const Scene& scene)
{
    return std::pow(scene.spacing, scene.dimensions);
}

std::string what_of(const Scene& scene, const OpenSettings& open)
{
    std::string text(kinds[static_cast<std::size_t>(open.kind)]);
    text += fmt::format(" along {} through {} = {:.6g} m",
                        directions_into[static_cast<std::size_t>(open.into)], "xyz"[open.axis()],
                        open.plane());
    if (!open.series.empty()) {
        const std::vector<double>& times = open.series.front().times;
        text += fmt::format(", {} series from {:.6g} to {:.6g} s", open.series.size(),
                            times.front(), times.back());
    } else if (open.discharge) {
        text +=
            fmt::format(", {:.6g} {}", *open.discharge, scene.dimensions == 2 ? "m2/s" : "m3/s");
    } else if (open.level) {
        text += fmt::format(", level {:.6g} m", *open.level);
    }
    return text;
}

// Particles that the domain holds below the highest level that is asked for or that water has.
double most_held(const Scene& scene, const PlanFacts& facts)
{
    double top = facts.z.highest + scene.spacing / 2;
    double low = facts.z.lowest - scene.spacing / 2;
    for (const OpenSettings& open : scene.open) {
        const double bed = mean_bed(open_side(scene, open));
        low = std::min(low, bed);
        top = std::max(top, highest_asked(open).value_or(open.max.z()));
    }
    const Vec3 size = facts.domain.max - facts.domain.min;
    const double area = size.x() * (scene.dimensions == 2 ? 1 : size.y());
    return area * std::max(top - low, 0.0) / cube_of(scene);
}

void check_ground(const Scene& scene, const OpenSettings& open, const OpenSide& side,
                  std::vector<Diagnostic>& errors)
{
    if (!(mean_bed(side) < infinity)) {
        errors.push_back(note_at(scene, open, "min", "the window is filled by walls",
                                 "move it to a place where water can pass"));
        return;
    }
    if (is_walled(scene, side)) {
        errors.push_back(note_at(scene, open, "min", "a wall closes the window from outside",
                                 "add that side to `open` of the basin, or end the wall at the "
                                 "window"));
    }
    if (!stands_on_ground(scene, side)) {
        errors.push_back(
            note_at(scene, open, "min",
                    fmt::format("the lower edge of the window, z = {:.4g} m, is above the "
                                "ground",
                                open.min.z()),
                    terrain_of(scene) != nullptr
                        ? "extend it down to the ground or below; `datum` moves the ground"
                        : "extend it down to the ground or below"));
    }
}

void check_water(const Scene& scene, const OpenSettings& open, const WaterAtStart& water,
                 double bed, std::vector<Diagnostic>& errors)
{
    const bool alone = open.kind == OpenKind::inflow && !open.discharge && !open.velocity &&
                       (open.series.empty() ? open.level.has_value()
                                            : !open.series.front().levels.empty() &&
                                                  open.series.front().velocities.empty());
    if (alone && water.deepest < scene.spacing) {
        errors.push_back(note_at(scene, open, "level",
                                 "a level without a velocity defines a wave into still water, but "
                                 "the window is dry at the start",
                                 "also give the velocity, or give a discharge"));
    }
    if (open.kind == OpenKind::absorb && !open.level && open.series.empty() &&
        water.deepest < scene.spacing) {
        errors.push_back(note_at(scene, open, "kind",
                                 "an absorbing side maintains the initial level, but the window is "
                                 "dry at the start",
                                 "give `level`, or use kind = \"outflow\""));
    }
    // A discharge enters at the critical depth or deeper.
    const std::optional<double> asked = highest_asked(open);
    double highest = asked.value_or(-infinity);
    for (int k = 0; k <= samples && !asked && bed < infinity; ++k) {
        const double time = scene.time.end * k / samples;
        highest = std::max(highest, bed + inflow_at(scene, open, {}, bed, time).depth);
    }
    if (highest > open.max.z() + 1e-9) {
        errors.push_back(note_at(scene, open, "max",
                                 fmt::format("the level rises to {:.6g} m, above the window, which "
                                             "ends at {:.6g} m",
                                             highest, open.max.z()),
                                 fmt::format("set z of `max` to {:.6g} or more", highest)));
    }
}

// Shifting drives particles out through a free surface, and an open side always has one.
void check_shifting(const Scene& scene, const Plan& plan, const OpenSettings& open,
                    std::vector<Diagnostic>& errors)
{
    if (plan.runs("shifting")) {
        errors.push_back(note_at(scene, open, "name",
                                 "an open side cannot be combined with `fluid.shifting`, with "
                                 "which fluid expands at its free surface",
                                 "set fluid.shifting.model = \"none\""));
    }
}

void check_pairs(const Scene& scene, std::vector<Diagnostic>& errors)
{
    for (std::size_t k = 1; k < scene.open.size(); ++k) {
        for (std::size_t m = 0; m < k; ++m) {
            const OpenSettings& a = scene.open[m];
            const OpenSettings& b = scene.open[k];
            const int across = 1 - a.axis();
            const bool meet = a.axis() == b.axis() && a.plane() == b.plane() &&
                              (scene.dimensions == 2 ||
                               (a.min[across] < b.max[across] && b.min[across] < a.max[across]));
            if (meet) {
                errors.push_back(note_at(scene, b, "min",
                                         fmt::format("the window overlaps that of \"{}\"", a.name),
                                         "windows of one side must not overlap"));
            }
        }
    }
}

// Below a body that leaves ground has to reach as far as the carpet does.
void warn_about_ground(const Scene& scene, const OpenSide& side, const auto& warn)
{
    if (side.columns == least_carpet_columns(scene.fluid->smoothing_ratio)) {
        return; // nothing leaves here
    }
    const double ends = ground_behind(scene, side);
    const double carpet = side.columns * scene.spacing;
    if (ends < carpet - scene.spacing) {
        warn(
            "bodies",
            fmt::format("the ground ends {:.3g} m behind the window, but the longest body needs "
                        "{:.3g} m of ground to pass completely: a body that touches the ground may "
                        "tip over its end",
                        ends, carpet),
            "extend the walls beyond the window; they may leave the domain");
    }
}

// The series of a map begins at the level of the water in it; a level of another zero does not.
void warn_about_start(const Scene& scene, const OpenSettings& open, const WaterAtStart& water,
                      double bed, const auto& warn)
{
    const bool by_level = !open.series.empty() && !open.series.front().levels.empty();
    if (!by_level || terrain_of(scene) == nullptr || !(water.level > -infinity)) {
        return;
    }
    const double asked = bed + inflow_at(scene, open, water, bed, 0).depth;
    const double off = asked - water.level;
    if (std::abs(off) > scene.spacing) {
        warn("series",
             fmt::format("prescribes a level of {:.4g} m at the start, but the water level in "
                         "front of the window is {:.4g} m: the difference enters as a wave "
                         "immediately",
                         asked, water.level),
             "check `datum`, `time_offset` and the level of the still water");
    }
}

void warn_about_walls(const Scene& scene, const OpenSettings& open, const OpenSide& side,
                      const WaterAtStart& water, const auto& warn)
{
    const double level = std::max(water.level, highest_asked(open).value_or(-infinity));
    if (level > -infinity && is_barred(scene, side, level)) {
        warn("min",
             fmt::format("walls that emerge close off the water behind the window: no way leads "
                         "past them {} spacings into the domain",
                         strip_columns),
             "leave a gap of several spacings between the walls, or move the window");
    }
}

// Measured in still water: levels are up to a spacing off.
void warn_about_width(const Scene& scene, const OpenSettings& open, const auto& warn)
{
    const Vec3 size = (open.max - open.min) / scene.spacing;
    if (const double width = size[1 - open.axis()]; scene.dimensions == 3 && width < 3) {
        warn("max", fmt::format("the level in a window {:.2g} spacings wide is inaccurate", width),
             "make it at least 3 spacings wide, or use a smaller `particles.spacing`");
    }
}

void warn_about(const Scene& scene, const OpenSettings& open, const OpenSide& side,
                const WaterAtStart& water, Plan& plan)
{
    const auto warn = [&](std::string_view key, std::string what, std::string hint) {
        hyoryu::warn(scene, open.place, fmt::format("open.{}.{}", open.name, key), std::move(what),
                     std::move(hint), plan);
    };
    if (!open.series.empty() && !open.hold) {
        const std::vector<double>& times = open.series.front().times;
        if (times.back() < scene.time.end) {
            warn("series",
                 fmt::format("ends at {:.6g} s, the run at {:.6g} s: the last values are held",
                             times.back(), scene.time.end),
                 "set `time.end`, or `hold = true`");
        }
        if (times.front() > 0) {
            warn("series",
                 fmt::format("begins at {:.6g} s: the first values are used before that time",
                             times.front()),
                 "set `time_offset`, or `hold = true`");
        }
    }
    warn_about_ground(scene, side, warn);
    warn_about_walls(scene, open, side, water, warn);
    warn_about_width(scene, open, warn);
    double deepest = 0;
    const double bed = mean_bed(side);
    warn_about_start(scene, open, water, bed, warn);
    for (int k = 0; k <= samples; ++k) {
        const double time = scene.time.end * k / samples;
        deepest = std::max(deepest, inflow_at(scene, open, water, bed, time).depth);
    }
    constexpr double least_rows = 4;
    const double rows = deepest / scene.spacing;
    if (open.kind == OpenKind::inflow && rows < least_rows) {
        warn("name",
             fmt::format("the inflow is {:.2g} spacings deep at its peak: at least {:.0f} are "
                         "needed to carry a body, and below 1.5 no fluid enters",
                         rows, least_rows),
             "use a smaller `particles.spacing`");
    }
}

} // namespace

void list_open(const Scene& scene, const PlanFacts& facts, Plan& plan)
{
    if (!scene.fluid || scene.open.empty()) {
        return;
    }
    double carpets = 0;
    double entering = 0;
    for (std::size_t k = 0; k < scene.open.size(); ++k) {
        const OpenSettings& open = scene.open[k];
        const OpenSide side = open_side(scene, open);
        const double bed = mean_bed(side);
        if (!(bed < infinity)) {
            continue;
        }
        const WaterAtStart water = water_before(side, facts.level_before[k]);
        double deepest = water.depth;
        double volume = 0;
        for (int n = 0; n < samples; ++n) {
            const Inflow flow =
                inflow_at(scene, open, water, bed, scene.time.end * (n + 0.5) / samples);
            volume += std::max(flow.discharge, 0.0) * scene.time.end / samples;
            deepest = std::max(deepest, flow.depth);
        }
        const double carpet =
            std::ceil(deepest / scene.spacing + 1) * side.lanes() * (side.columns + 1);
        plan.open.push_back({open.name, what_of(scene, open), static_cast<Index>(carpet)});
        carpets += carpet;
        entering += volume / cube_of(scene);
    }
    const auto start = static_cast<double>(facts.fluid);
    const double held = std::max(start, std::min(start + entering, most_held(scene, facts)));
    plan.most_fluid = static_cast<Index>(std::ceil(held + carpets));
}

void check_open(const Scene& scene, const PlanFacts& facts, Plan& plan,
                std::vector<Diagnostic>& errors)
{
    if (!scene.fluid) {
        return;
    }
    check_pairs(scene, errors);
    for (std::size_t k = 0; k < scene.open.size(); ++k) {
        const OpenSettings& open = scene.open[k];
        const OpenSide side = open_side(scene, open);
        const WaterAtStart water = water_before(side, facts.level_before[k]);
        if (points_out(scene, facts, open, errors)) {
            continue;
        }
        if (bodies_are_inside(scene, open, side, errors)) {
            check_side(scene, facts, open, errors);
        }
        check_ground(scene, open, side, errors);
        check_water(scene, open, water, mean_bed(side), errors);
        check_bodies_that_stop(scene, open, errors);
        check_shifting(scene, plan, open, errors);
        if (mean_bed(side) < infinity) {
            warn_about(scene, open, side, water, plan);
        }
    }
}

} // namespace hyoryu
