// SPDX-License-Identifier: MIT
#include "plan_gauges.hpp"

#include "hyoryu/scene/fill.hpp"
#include "hyoryu/scene/gauge_columns.hpp"
#include "plan_warnings.hpp"
#include "scene/filling/walls.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace hyoryu {

namespace {

std::string text_of(const Vec3& v)
{
    return fmt::format("({:.4g}, {:.4g}, {:.4g})", v.x(), v.y(), v.z());
}

std::string what_of(const Scene& scene, const Plan& plan, const Gauge& gauge)
{
    switch (gauge.type) {
    case GaugeType::elevation:
        return fmt::format("water level over x = {:.4g}, y = {:.4g}", gauge.at.x(), gauge.at.y());
    case GaugeType::pressure: {
        const double reach = 2 * plan.fluid->h;
        return gauge.area > 0
                   ? fmt::format("pressure, mean over a face of {:.3g} {} at {}", gauge.area,
                                 scene.dimensions == 2 ? "m" : "m2", text_of(gauge.at))
                   : fmt::format("pressure at {}, kernel mean within {:.3g} m", text_of(gauge.at),
                                 reach);
    }
    case GaugeType::velocity:
        return fmt::format("velocity at {}", text_of(gauge.at));
    case GaugeType::force:
        return fmt::format("force of the fluid, impulses of fluid and contact on \"{}\"", gauge.on);
    case GaugeType::front:
        return fmt::format("largest coordinate of the fluid along {}", "xyz"[gauge.axis]);
    case GaugeType::flux:
        return fmt::format("volume flux through the plane at {} along {}", text_of(gauge.at),
                           text_of(gauge.normal));
    }
    return {};
}

// Particles that a gauge looks at for one row: those within the kernel about each of its points, of
// the levels of a vertical that are near the surface, or of the layer about a plane.
double looks_of(const Scene& scene, const Plan& plan, const Gauge& gauge)
{
    if (!plan.fluid) {
        return 0; // force gauges alone
    }
    const double reach = 2 * plan.fluid->h / scene.spacing; // of the kernel, in spacings
    const int d = scene.dimensions;
    const double about =
        d == 2 ? std::numbers::pi * sq(reach) : 4 * std::numbers::pi / 3 * reach * reach * reach;
    constexpr double levels_of_spacing = 4; // as the readings have it, and the next two
    constexpr double most_points = 64;
    constexpr double layer = 4;
    switch (gauge.type) {
    case GaugeType::elevation:
        return levels_of_spacing * 2 * reach * about;
    case GaugeType::pressure: {
        const double cell = std::pow(scene.spacing / 2, d - 1);
        return about *
               (gauge.area > 0 ? std::clamp(std::ceil(gauge.area / cell), 1.0, most_points) : 1);
    }
    case GaugeType::velocity:
        return about;
    case GaugeType::flux:
        return layer * std::pow(static_cast<double>(plan.counts.fluid), (d - 1.0) / d);
    case GaugeType::front:
    case GaugeType::force:
        break;
    }
    return 0;
}

// The bounds of the fluid are measured once for all gauges that search it; the cost equals that of
// visiting this number of particles.
double looks_of_search(const Scene& scene, const Plan& plan)
{
    constexpr double share = 0.05;
    const auto looks = [](const Gauge& gauge) { return gauge.type != GaugeType::force; };
    return std::ranges::any_of(scene.gauges, looks) ? share * static_cast<double>(plan.counts.fluid)
                                                    : 0;
}

// Whether all corners of the domain are on one side of the plane of a flux gauge.
bool misses(const Gauge& gauge, const Bounds& domain)
{
    double low = infinity;
    double high = -infinity;
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3 p((corner & 1) != 0 ? domain.max.x() : domain.min.x(),
                     (corner & 2) != 0 ? domain.max.y() : domain.min.y(),
                     (corner & 4) != 0 ? domain.max.z() : domain.min.z());
        const double side = (p - gauge.at).dot(gauge.normal);
        low = std::min(low, side);
        high = std::max(high, side);
    }
    return low > 0 || high < 0;
}

bool outside(const Scene& scene, const Gauge& gauge, const Bounds& domain)
{
    if (gauge.type == GaugeType::flux) {
        return misses(gauge, domain);
    }
    const auto beyond = [&](int axis) {
        const bool counts = !(axis == 1 && scene.dimensions == 2) &&
                            !(axis == 2 && gauge.type == GaugeType::elevation);
        return counts && (gauge.at[axis] < domain.min[axis] || gauge.at[axis] > domain.max[axis]);
    };
    return beyond(0) || beyond(1) || beyond(2);
}

// The kernel of a point near a thin wall reaches the water on its other side; a face does not.
void warn_about_other_sides(const Scene& scene, const Gauge& gauge, const std::string& key,
                            Plan& plan)
{
    if (!scene.fluid || gauge.type == GaugeType::elevation || gauge.area > 0) {
        return;
    }
    const double support = 2 * scene.fluid->smoothing_ratio * scene.spacing;
    for (const Wall& wall : scene.walls) {
        const double distance = std::max(0.0, -depth_behind(wall, gauge.at, scene.dimensions));
        const double thin = box_thickness(wall, scene.dimensions);
        if (distance + thin < support * (1 - 1e-9)) {
            warn(
                scene, gauge.place, key,
                fmt::format(
                    "the gauge \"{}\" also reads water behind the wall \"{}\", which is {:.3g} "
                    "m thick and {:.3g} m away: the kernel reaches {:.3g} m",
                    gauge.name, wall.name, thin, distance, support),
                "move the gauge away from the wall; for the pressure on the wall give `normal` and "
                "`area`",
                plan);
        }
    }
}

} // namespace

void list_gauges(const Scene& scene, Plan& plan)
{
    for (const Gauge& gauge : scene.gauges) {
        std::string columns;
        for (const Table::Head& head : gauge_columns(gauge, scene.dimensions)) {
            columns += (columns.empty() ? "" : ", ") + head.name;
        }
        plan.gauges.push_back({gauge.name, what_of(scene, plan, gauge), columns});
        plan.gauge_looks += looks_of(scene, plan, gauge);
    }
    plan.gauge_looks += looks_of_search(scene, plan);
    const double every = std::max(scene.output.gauge_every, plan.first_step);
    plan.gauge_rows = scene.gauges.empty() ? 0 : std::floor(scene.time.end / every) + 1;
}

void check_gauges(const Scene& scene, const PlanFacts& facts, Plan& plan,
                  std::vector<Diagnostic>& errors)
{
    for (std::size_t k = 0; k < scene.gauges.size(); ++k) {
        const Gauge& gauge = scene.gauges[k];
        const std::string key = fmt::format("gauge[{}].at", k);
        if (gauge.type == GaugeType::force || gauge.type == GaugeType::front) {
            continue;
        }
        if (outside(scene, gauge, facts.domain)) {
            errors.push_back(diagnostic_without_line(
                scene, gauge.place, key,
                fmt::format("the gauge \"{}\" is outside the domain, {} to {} m, where no fluid "
                            "can reach it",
                            gauge.name, text_of(facts.domain.min), text_of(facts.domain.max)),
                "move it into the domain; positions are in metres"));
            continue;
        }
        if (gauge.type == GaugeType::flux) {
            continue;
        }
        warn_about_other_sides(scene, gauge, key, plan);
        // A sensor flush with a wall is placed correctly; one deeper inside than the kernel support
        // is not.
        for (const Wall& wall : scene.walls) {
            const double depth = gauge.type == GaugeType::elevation
                                     ? 0
                                     : depth_behind(wall, gauge.at, scene.dimensions);
            if (depth > scene.spacing / 2) {
                warn(scene, gauge.place, key,
                     fmt::format("the gauge \"{}\" is {:.3g} m inside the wall \"{}\"", gauge.name,
                                 depth, wall.name),
                     "move it to the surface or in front of it", plan);
            }
        }
    }
}

} // namespace hyoryu
