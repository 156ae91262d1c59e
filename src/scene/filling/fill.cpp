// SPDX-License-Identifier: MIT
#include "hyoryu/scene/fill.hpp"

#include "displace.hpp"
#include "displace_near.hpp"
#include "fill_block.hpp"
#include "fill_region.hpp"
#include "fill_size.hpp"
#include "hyoryu/scene/case_file.hpp"
#include "hyoryu/scene/formula.hpp"
#include "open_side.hpp"
#include "relax_packing.hpp"
#include "scene/case/units.hpp"
#include "scene/surfaces/conform.hpp"
#include "stand_off.hpp"
#include "walls.hpp"
#include "walls_by_range.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

namespace hyoryu {

namespace {

struct BlockPoints {
    BlockParticles particles;
    Index before = 0, count = 0; // points of processes before this one, and of all
    double top = -infinity;      // highest height of the block's surface
    Bounds box;
};

BlockPoints points_of(const Scene& scene, std::size_t block, Comm* comm)
{
    BlockPoints result{fill_block(scene, block, comm)};
    result.count = static_cast<Index>(result.particles.points.size());
    if (comm != nullptr) {
        const std::vector<Index> counts =
            gather(*comm, std::span<const Index>(&result.count, 1)).all;
        result.before = std::accumulate(counts.begin(), counts.begin() + comm->rank(), Index(0));
        result.count = std::accumulate(counts.begin(), counts.end(), Index(0));
    }
    result.box = bounds(placed(scene.fluid->blocks[block], scene.dimensions));
    for (int corner = 0; corner < 8; ++corner) {
        const Bounds& b = result.box;
        const double h = height(scene, {(corner & 1) != 0 ? b.max.x() : b.min.x(),
                                        (corner & 2) != 0 ? b.max.y() : b.min.y(),
                                        (corner & 4) != 0 ? b.max.z() : b.min.z()});
        result.top = std::max(result.top, h);
    }
    return result;
}

// A block that carries another one on its top has no free surface below it.
double surface_above(const Scene& scene, const std::vector<BlockPoints>& blocks, std::size_t own,
                     const Vec3& p)
{
    double top = blocks[own].top;
    for (bool higher = true; higher;) {
        higher = false;
        for (const BlockPoints& other : blocks) {
            const Vec3 lifted =
                p - scene.gravity.normalized() * (top + scene.spacing / 2 - height(scene, p));
            const bool above = (lifted.array() >= other.box.min.array() - 1e-9).all() &&
                               (lifted.array() <= other.box.max.array() + 1e-9).all();
            if (above && other.top > top) {
                top = other.top;
                higher = true;
            }
        }
    }
    return top;
}

// Velocity and pressure of a block at the start.
class StartField {
public:
    StartField(const FluidBlock& block, int dimensions)
        : uniform_(block.velocity), dimensions_(dimensions)
    {
        for (const std::string& text : block.velocity_field) {
            velocity_.emplace_back(text);
        }
        if (!block.pressure_field.empty()) {
            pressure_.emplace(block.pressure_field);
        }
    }

    bool is_at_rest() const { return velocity_.empty() && uniform_ == Vec3(0, 0, 0); }
    bool has_pressure() const { return pressure_.has_value(); }
    Vec3 velocity(const Vec3& p) const
    {
        if (velocity_.empty()) {
            return uniform_;
        }
        return {at(velocity_[0], p), dimensions_ == 2 ? 0.0 : at(velocity_[1], p),
                at(velocity_[2], p)};
    }
    double pressure(const Vec3& p) const { return pressure_ ? at(*pressure_, p) : 0; }

private:
    static double at(const Formula& formula, const Vec3& p)
    {
        std::vector<double> numbers;
        for (const std::string& name : formula.names()) {
            numbers.push_back(name == "x" ? p.x() : (name == "y" ? p.y() : p.z()));
        }
        return formula.value(numbers);
    }
    Vec3 uniform_;
    int dimensions_;
    std::vector<Formula> velocity_;
    std::optional<Formula> pressure_;
};

void warn_about_walls(const Scene& scene, std::size_t block, const BlockParticles& particles,
                      Filling& filling)
{
    Diagnostic note = diagnostic_without_line(
        scene, scene.fluid->blocks[block].place, fmt::format("fluid.block[{}]", block),
        fmt::format("{} of its {} particles are inside walls and are omitted", particles.in_walls,
                    particles.all),
        "ignore this warning if the walls are meant to cut the block; otherwise make the block "
        "smaller");
    note.severity = Diagnostic::Severity::warning;
    filling.warnings.push_back(note);
}

void warn_about_cover(const Scene& scene, std::size_t block, Filling& filling)
{
    Diagnostic note = diagnostic_at(
        scene, scene.fluid->blocks[block].place, fmt::format("fluid.block[{}]", block),
        "it adds no particles: blocks before it and walls cover it, or it is thinner than a "
        "spacing",
        "where blocks overlap, the first one in the file has the particles; put the smaller one "
        "first");
    note.severity = Diagnostic::Severity::warning;
    filling.warnings.push_back(note);
}

// How a particle starts.
struct Start {
    std::int64_t number = 0;
    std::int64_t block = 0;
    Vec3 place{0, 0, 0};
    Vec3 velocity{0, 0, 0};
    double pressure = 0;

    bool speed_fits() const { return velocity.norm() <= largest_value("m/s"); } // false for NaN
    bool fits() const { return speed_fits() && std::abs(pressure) <= largest_value("Pa"); }
};

// Fields are the user's formulas: a division by zero must not reach the first step. `faults`: those
// of this process; every process reports the first fault of all processes.
void check_starts(const Scene& scene, Comm* comm, std::vector<Start> faults)
{
    faults = of_all_ranks(comm, std::move(faults));
    const auto first = std::ranges::min_element(faults, {}, &Start::number);
    if (first == faults.end()) {
        return;
    }
    const Vec3& p = first->place;
    const Vec3& v = first->velocity;
    const bool speed_fits = first->speed_fits();
    const std::string value = speed_fits ? fmt::format("{} Pa", first->pressure)
                                         : fmt::format("({}, {}, {}) m/s", v.x(), v.y(), v.z());
    throw CaseError({diagnostic_at(
        scene, scene.fluid->blocks[at(first->block)].place,
        fmt::format("fluid.block[{}].{}", first->block,
                    speed_fits ? "pressure_field" : "velocity_field"),
        fmt::format("is {} at ({:.6g}, {:.6g}, {:.6g}) m, where there is fluid", value, p.x(),
                    p.y(), p.z()),
        fmt::format("the formula must give at most {:.0e} {} at every particle of the block",
                    largest_value(speed_fits ? "Pa" : "m/s"), speed_fits ? "Pa" : "m/s"))});
}

// The first basin outside of which a whole box lies; nullptr if there is none.
const Wall* basin_beside(const Scene& scene, const Bounds& box)
{
    constexpr double inset = 1e-3; // off the faces, which may lie in those of the basin
    const Vec3 middle = (box.min + box.max) / 2;
    const Vec3 half = (1 - inset) * (box.max - box.min) / 2;
    const auto beside = [&](const Wall& wall) {
        bool all = std::holds_alternative<BasinWall>(wall.geometry);
        for (int corner = 0; all && corner < 8; ++corner) {
            const Vec3 way((corner & 1) != 0 ? 1 : -1, (corner & 2) != 0 ? 1 : -1,
                           (corner & 4) != 0 ? 1 : -1);
            all = depth_behind(wall, middle + way.cwiseProduct(half), scene.dimensions) > 0;
        }
        return all;
    };
    const auto found = std::ranges::find_if(scene.walls, beside);
    return found == scene.walls.end() ? nullptr : &*found;
}

// Water of which no particle is left because it lies outside of a basin, as with a second basin.
void find_other_basins(const Scene& scene, const std::vector<BlockPoints>& blocks,
                       std::vector<Diagnostic>& faults)
{
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        const bool buried = blocks[b].particles.in_walls > 0 && !scene.fluid->blocks[b].seeded;
        if (const Wall* basin = buried ? basin_beside(scene, blocks[b].box) : nullptr) {
            faults.push_back(diagnostic_at(
                scene, scene.fluid->blocks[b].place, fmt::format("fluid.block[{}]", b),
                fmt::format("all particles of the blocks lie inside walls: this block lies outside "
                            "of the basin \"{}\", and everything outside of a basin is solid",
                            basin->name),
                "use one basin around all the water, with walls of shape \"box\" within it, or "
                "build a further basin from boxes"));
        }
    }
}

// Appends points, without a copy if they are the first.
void append(std::vector<Vec3>& all, std::vector<Vec3> points)
{
    if (all.empty()) {
        all = std::move(points);
    } else {
        all.insert(all.end(), points.begin(), points.end());
    }
}

// Fills all blocks; each of several processes fills a part of each block.
void fill_fluid(const Scene& scene, Comm* comm, Filling& filling)
{
    std::vector<BlockPoints> blocks;
    std::vector<StartField> starts;
    for (std::size_t b = 0; b < scene.fluid->blocks.size(); ++b) {
        blocks.push_back(points_of(scene, b, comm));
        starts.emplace_back(scene.fluid->blocks[b], scene.dimensions);
    }
    const bool moves = !std::ranges::all_of(starts, &StartField::is_at_rest);
    const bool presses = std::ranges::any_of(starts, &StartField::has_pressure);
    std::vector<Start> faults;
    Index first = 0; // number of the first particle of the block
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        BlockParticles& particles = blocks[b].particles;
        filling.fluid_volume += static_cast<double>(blocks[b].count) * particles.cell;
        for (Index k = 0; comm != nullptr && k < std::ssize(particles.points); ++k) {
            filling.fluid_number.push_back(first + blocks[b].before + k);
        }
        const std::size_t count = filling.fluid.size() + particles.points.size();
        filling.fluid_cut.resize(count, particles.cut ? 1 : 0);
        filling.fluid_depth.reserve(count);
        filling.fluid_velocity.reserve(moves ? count : 0);
        filling.fluid_pressure.reserve(presses ? count : 0);
        for (const Vec3& p : particles.points) {
            const Start start{first + blocks[b].before + (&p - particles.points.data()),
                              static_cast<std::int64_t>(b), p, starts[b].velocity(p),
                              starts[b].pressure(p)};
            if (faults.empty() && !start.fits()) {
                faults.push_back(start);
            }
            if (moves) {
                filling.fluid_velocity.push_back(start.velocity);
            }
            if (presses) {
                filling.fluid_pressure.push_back(start.pressure);
            }
            filling.fluid_depth.push_back(
                scene.gravity.norm() > 0 ? surface_above(scene, blocks, b, p) - height(scene, p)
                                         : 0);
        }
        append(filling.fluid, std::exchange(particles.points, {}));
        if (particles.in_walls > 0) {
            warn_about_walls(scene, b, particles, filling);
        }
        first += blocks[b].count;
    }
    check_starts(scene, comm, std::move(faults));
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        if (first > 0 && blocks[b].count == 0 && blocks[b].particles.in_walls == 0) {
            warn_about_cover(scene, b, filling);
        }
    }
    if (first == 0 && scene.open.empty()) {
        find_other_basins(scene, blocks, filling.faults);
    }
    filling.fluid_elsewhere = first - static_cast<Index>(filling.fluid.size());
}

} // namespace

int wall_layers(double smoothing_ratio)
{
    return static_cast<int>(std::ceil(2 * smoothing_ratio - 1e-9));
}

double thickness_of_rows(const Scene& scene)
{
    const double ratio =
        scene.fluid ? scene.fluid->smoothing_ratio : FluidSettings{}.smoothing_ratio;
    return wall_layers(ratio) * scene.spacing;
}

namespace {

void fill_bodies(const Scene& scene, Filling& filling)
{
    for (const BodySettings& body : scene.bodies) {
        filling.bodies.push_back(aggregate(body.shape, body.spacing, scene.dimensions));
        if (const auto* mesh = std::get_if<MeshShape>(&body.shape);
            mesh != nullptr && scene.fluid) {
            Aggregate& filled = filling.bodies.back();
            conform_to_surface(*mesh, body.spacing, filled.points);
            filled.particle_volume =
                volume(body.shape, scene.dimensions) / static_cast<double>(filled.points.size());
        }
        move_to_middle(body, filling.bodies.back().points);
    }
}

// Sets the volume of the fluid to that of cubes of the spacing if the two agree up to round-off,
// and always with open sides, whose carpets are made of such cubes.
void settle_volume(const Scene& scene, Filling& filling)
{
    constexpr double round_off = 1e-9;
    const double cubes =
        static_cast<double>(filling.fluid_count()) * std::pow(scene.spacing, scene.dimensions);
    const bool same = std::abs(filling.fluid_volume - cubes) <= round_off * cubes;
    filling.fluid_volume = same || !scene.open.empty() ? cubes : filling.fluid_volume;
}

} // namespace

double particle_volume(const Scene& scene, const Filling& filling)
{
    return filling.fluid_count() == 0
               ? std::pow(scene.spacing, scene.dimensions)
               : filling.fluid_volume / static_cast<double>(filling.fluid_count());
}

Filling fill(const Scene& scene, const Fillers& fillers)
{
    check_size(scene, fillers.part);
    Filling filling;
    filling.domain = domain_of(scene);
    fill_bodies(scene, filling);
    if (!scene.fluid) {
        return filling;
    }
    fill_fluid(scene, fillers.comm, filling);
    std::optional<FillRegion> region;
    if (fillers.comm == nullptr) {
        fill_walls(scene, filling);
        carry_walls_out(scene, filling);
    } else {
        region.emplace(fill_walls_by_range(scene, *fillers.comm, filling));
        give_fluid(
            *fillers.comm, [&](const Vec3& p) { return region->owner(p); }, filling);
    }
    if (!scene.bodies.empty()) {
        displace_by_bodies(scene, region ? &*region : nullptr, filling);
    }
    settle_volume(scene, filling);
    relax_packing(scene, region ? &*region : nullptr, filling);
    part_pairs(scene, region ? &*region : nullptr, filling);
    return filling;
}

} // namespace hyoryu
