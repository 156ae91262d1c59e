// SPDX-License-Identifier: MIT
#include "plan_facts.hpp"

#include "scene/filling/open_side.hpp"

#include "hyoryu/ranks/reduction.hpp"

#include <algorithm>
#include <tuple>

namespace hyoryu {

namespace {

// Whether columns are asked for: along them things fall.
bool has_columns(const Scene& scene)
{
    return scene.fluid && (falls_along_z(scene) || !scene.bodies.empty());
}

void look_at_fluid(const Scene& scene, const Filling& filling, PlanFacts& facts)
{
    const Vec3 up = -scene.gravity.normalized();
    for (const Vec3& p : filling.fluid) {
        facts.height.add(up.dot(p));
        facts.z.add(p.z());
    }
    for (const Vec3& v : filling.fluid_velocity) {
        facts.fastest = std::max(facts.fastest, v.norm());
    }
    for (const double depth : filling.fluid_depth) {
        facts.deepest = std::max(facts.deepest, depth);
    }
}

// The highest fluid in the strip before each window.
void look_before_sides(const Scene& scene, const Filling& filling, PlanFacts& facts)
{
    constexpr double strip = 8; // spacings
    for (const OpenSettings& open : scene.open) {
        const OpenSide side = open_side(scene, open);
        double& level = facts.level_before.emplace_back(-infinity);
        for (const Vec3& x : filling.fluid) {
            const double s = side.distance(x);
            const int lane = side.lane(x);
            if (s >= 0 && s < strip * scene.spacing && lane >= 0 && lane < side.lanes()) {
                level = std::max(level, x.z() + scene.spacing / 2);
            }
        }
    }
}

// The fluid before the face of a wall, along +x.
Span before_face(const Scene& scene, const Filling& filling, const SolidWall& solid)
{
    constexpr double before = 3; // spacings
    const Bounds box = bounds(placed(solid, scene.dimensions));
    Span heights;
    for (const Vec3& p : filling.fluid) {
        const double away = p.x() - box.max.x();
        const bool beside = scene.dimensions == 3 && (p.y() < box.min.y() || p.y() > box.max.y());
        if (away > 0 && away < before * scene.spacing && !beside) {
            heights.add(p.z());
        }
    }
    return heights;
}

void look_at_waves(const Scene& scene, const Filling& filling, PlanFacts& facts)
{
    for (const Wall& wall : scene.walls) {
        const auto* solid = std::get_if<SolidWall>(&wall.geometry);
        const bool asked = wall.wave.length > 0 || wall.motion.absorption.has_value();
        facts.before_paddle.push_back(
            solid != nullptr && asked ? before_face(scene, filling, *solid) : Span{});
    }
    for (const Sponge& sponge : scene.sponges) {
        const auto is_in = [&](const Vec3& p) { return holds(sponge, p, scene.dimensions); };
        facts.sponge_is_wet.push_back(std::ranges::any_of(filling.fluid, is_in) ? 1 : 0);
    }
}

void look_at_walls(const Scene& scene, const Filling& filling, PlanFacts& facts)
{
    facts.moving.resize(scene.walls.size());
    for (std::size_t k = 0; k < filling.wall.size(); ++k) {
        const std::size_t owner = at(filling.wall_owner[k]);
        const Wall& wall = scene.walls[owner];
        if (std::holds_alternative<SolidWall>(wall.geometry) && moves(wall.motion)) {
            facts.moving[owner].push_back(filling.wall[k]);
        }
    }
}

std::vector<WallStack> stacks_of(const Columns& columns, double spacing, const Filling& filling)
{
    std::vector<WallStack> single;
    for (std::size_t k = 0; k < filling.wall.size(); ++k) {
        const Vec3& p = filling.wall[k];
        single.push_back({columns.number_of(p), p.z(), p.z(), filling.wall_owner[k]});
    }
    std::ranges::sort(single, {},
                      [](const WallStack& s) { return std::tuple(s.wall, s.column, s.low); });
    std::vector<WallStack> stacks;
    for (const WallStack& next : single) {
        const bool goes_on = !stacks.empty() && stacks.back().wall == next.wall &&
                             stacks.back().column == next.column &&
                             next.low - stacks.back().high <= WallStack::gap * spacing;
        if (goes_on) {
            stacks.back().high = next.high;
        } else {
            stacks.push_back(next);
        }
    }
    return stacks;
}

struct ColumnSpan {
    Columns::Number column{};
    Span heights;
};

void look_at_columns(const Scene& scene, const Filling& filling, Comm* comm, PlanFacts& facts)
{
    facts.water = Columns(scene.spacing);
    for (const Vec3& p : filling.fluid) {
        facts.water.add(facts.water.number_of(p), {p.z(), p.z()});
    }
    facts.walls = of_all_ranks(comm, stacks_of(facts.water, scene.spacing, filling));
    if (comm != nullptr) {
        std::vector<ColumnSpan> own;
        for (const auto& [column, heights] : facts.water.spans()) {
            own.push_back({column, heights});
        }
        for (const ColumnSpan& span : of_all_ranks(comm, std::move(own))) {
            facts.water.add(span.column, span.heights);
        }
    }
    std::ranges::sort(facts.walls);
    std::map<Columns::Number, double> floor; // of the columns of the fluid [m]
    const Columns walls = columns_of(scene.spacing, facts.walls);
    for (const auto& [column, heights] : facts.water.spans()) {
        floor.emplace(column, walls.about(column).lowest);
    }
    facts.unsupported = std::ranges::count_if(
        filling.fluid, [&](const Vec3& p) { return floor.at(facts.water.number_of(p)) > p.z(); });
}

// Joins the numbers of all processes.
void join(Comm& comm, PlanFacts& facts)
{
    Reduction extremes(&comm);
    const auto join_spans = [&](std::span<Span> spans) {
        for (Span& span : spans) {
            span.lowest = -span.lowest;
            extremes.largest({&span.lowest, 1});
            extremes.largest({&span.highest, 1});
        }
    };
    std::array<std::span<Span>, 3> spans{std::span(&facts.height, 1), std::span(&facts.z, 1),
                                         facts.before_paddle};
    std::ranges::for_each(spans, join_spans);
    for (double* number : {&facts.fastest, &facts.deepest}) {
        extremes.largest({number, 1});
    }
    extremes.largest(facts.level_before);
    extremes.largest(facts.sponge_is_wet);
    extremes.run();
    for (const std::span<Span> some : spans) {
        for (Span& span : some) {
            span.lowest = -span.lowest;
        }
    }
    std::vector<std::int64_t> counts{facts.fluid, facts.wall, facts.unsupported};
    comm.add(counts);
    facts.fluid = counts[0];
    facts.wall = counts[1];
    facts.unsupported = counts[2];
    for (std::vector<Vec3>& points : facts.moving) {
        points = of_all_ranks(&comm, std::move(points));
    }
}

} // namespace

bool falls_along_z(const Scene& scene)
{
    constexpr double upright = 0.99; // cosine
    return scene.gravity.normalized().dot(-Vec3::UnitZ()) >= upright;
}

PlanFacts facts_of(const Scene& scene, const Filling& filling, Comm* comm)
{
    PlanFacts facts{.domain = filling.domain,
                    .warnings = filling.warnings,
                    .faults = filling.faults,
                    .fluid = static_cast<Index>(filling.fluid.size()),
                    .wall = static_cast<Index>(filling.wall.size())};
    for (const Aggregate& body : filling.bodies) {
        facts.body_points.push_back(static_cast<Index>(body.points.size()));
        facts.surface_points.push_back(body.surface_points);
    }
    if (scene.fluid) {
        facts.particle_volume = particle_volume(scene, filling);
        look_at_fluid(scene, filling, facts);
        look_before_sides(scene, filling, facts);
        look_at_walls(scene, filling, facts);
    }
    look_at_waves(scene, filling, facts);
    if (has_columns(scene)) {
        look_at_columns(scene, filling, comm, facts);
    }
    if (comm != nullptr) {
        join(*comm, facts);
    }
    return facts;
}

} // namespace hyoryu
