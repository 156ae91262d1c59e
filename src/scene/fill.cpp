// SPDX-License-Identifier: MIT
#include "hyoryu/scene/fill.hpp"

#include "conform.hpp"
#include "fill_size.hpp"
#include "hyoryu/scene/case_file.hpp"
#include "hyoryu/scene/formula.hpp"
#include "walls.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

namespace hyoryu {

namespace {

Placed placed(const Scene& scene, const FluidBlock& block)
{
    return {&block.shape, block.centre, block.rotation, scene.dimensions};
}

Placed placed(const Scene& scene, const BodySettings& body)
{
    return {&body.shape, body.position, body.rotation, scene.dimensions};
}

// Height along -g, or along z without gravity.
double height(const Scene& scene, const Vec3& p)
{
    const double g = scene.gravity.norm();
    return g > 0 ? -scene.gravity.dot(p) / g : p.z();
}

struct BlockPoints {
    std::vector<Vec3> points;
    double top = -infinity; // highest height of the block's surface
    double bottom = infinity;
    Bounds box;
};

// A block on its own lattice, so that its faces are half a spacing from the outermost particles, or
// in layers that follow a round surface.
BlockPoints lattice_of(const Scene& scene, const FluidBlock& block)
{
    BlockPoints result;
    const Placed shape = placed(scene, block);
    result.box = bounds(shape);
    for (int corner = 0; corner < 8; ++corner) {
        const Bounds& b = result.box;
        const double h = height(scene, {(corner & 1) != 0 ? b.max.x() : b.min.x(),
                                        (corner & 2) != 0 ? b.max.y() : b.min.y(),
                                        (corner & 4) != 0 ? b.max.z() : b.min.z()});
        result.top = std::max(result.top, h);
        result.bottom = std::min(result.bottom, h);
    }
    if (block.layers) {
        for (const Vec3& p : aggregate(block.shape, scene.spacing, scene.dimensions).points) {
            result.points.push_back(block.centre + block.rotation * p);
        }
        return result;
    }
    const Aggregate filled = [&] {
        const Vec3 size = result.box.max - result.box.min;
        return aggregate(BoxShape{size}, scene.spacing, scene.dimensions);
    }();
    const Vec3 centre = (result.box.min + result.box.max) / 2;
    for (const Vec3& p : filled.points) {
        if (signed_distance(shape, centre + p) < 0) {
            result.points.push_back(centre + p);
        }
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

// Fraction of the lattice cell about p that lies inside the shape, by sub-cells.
double covered(const Placed& shape, const Vec3& p, double spacing)
{
    constexpr int n = 4;
    const int ny = shape.dimensions == 2 ? 1 : n;
    int inside = 0;
    for (int k = 0; k < n; ++k) {
        for (int j = 0; j < ny; ++j) {
            for (int i = 0; i < n; ++i) {
                const Vec3 offset{(i + 0.5) / n - 0.5, ny == 1 ? 0.0 : (j + 0.5) / n - 0.5,
                                  (k + 0.5) / n - 0.5};
                inside += signed_distance(shape, p + spacing * offset) < 0 ? 1 : 0;
            }
        }
    }
    return static_cast<double>(inside) / (n * n * ny);
}

// A particle whose cell the surface of a shape cuts.
struct CutCell {
    std::size_t row = 0;
    double distance = 0;     // of its centre from the surface, negative inside [m]
    double covered = 0;      // part of the cell that the shape displaces
    std::uint64_t place = 0; // along a curve on which neighbours are near (Morton 1966)
};

// The bits of the cell numbers in turns.
std::uint64_t morton(const Vec3& cells)
{
    constexpr int bits = 20;
    std::uint64_t place = 0;
    for (int bit = 0; bit < bits; ++bit) {
        for (int axis = 0; axis < 3; ++axis) {
            const auto number = static_cast<std::uint64_t>(cells[axis]);
            place |= ((number >> bit) & 1U) << (3 * bit + axis);
        }
    }
    return place;
}

// Marks as many cut cells as the shape displaces, group after group of neighbours, the deepest of
// each first; what a group is over or short of whole particles goes to the next one. One count for
// all of them could take its last particles from one side, which sets the body turning.
void choose(std::vector<CutCell>& cut, std::vector<bool>& gone)
{
    constexpr std::size_t group = 8;
    std::sort(cut.begin(), cut.end(), [](const CutCell& a, const CutCell& b) {
        return std::pair(a.place, a.row) < std::pair(b.place, b.row);
    });
    double displaced = 0;
    std::size_t taken = 0;
    for (std::size_t first = 0; first < cut.size(); first += group) {
        const auto begin = cut.begin() + static_cast<std::ptrdiff_t>(first);
        const auto end =
            cut.begin() + static_cast<std::ptrdiff_t>(std::min(first + group, cut.size()));
        std::sort(begin, end, [](const CutCell& a, const CutCell& b) {
            return std::pair(a.distance, a.row) < std::pair(b.distance, b.row);
        });
        for (auto cell = begin; cell != end; ++cell) {
            displaced += cell->covered;
        }
        const auto wanted = static_cast<std::size_t>(std::llround(displaced));
        for (auto cell = begin; cell != end && taken < wanted; ++cell) {
            gone[cell->row] = true;
            taken += 1;
        }
    }
}

// Takes out as many particles as the shape displaces, everywhere about its surface: an excess of a
// quarter of a layer would start the water with a jolt.
void take_out(const Placed& shape, double spacing, Filling& filling)
{
    Bounds box = bounds(shape);
    box.min -= Vec3::Constant(spacing);
    box.max += Vec3::Constant(spacing);
    std::vector<bool> gone(filling.fluid.size(), false);
    std::vector<CutCell> cut;
    for (std::size_t k = 0; k < filling.fluid.size(); ++k) {
        const Vec3& p = filling.fluid[k];
        if (((p - box.min).array() < 0).any() || ((box.max - p).array() < 0).any()) {
            continue;
        }
        const double distance = signed_distance(shape, p);
        if (distance >= spacing) {
            continue;
        }
        const double part = distance < -spacing ? 1.0 : covered(shape, p, spacing);
        gone[k] = part == 1;
        if (part > 0 && part < 1) {
            cut.push_back({k, distance, part, morton((p - box.min) / spacing)});
        }
    }
    choose(cut, gone);
    std::size_t kept = 0;
    for (std::size_t k = 0; k < filling.fluid.size(); ++k) {
        if (!gone[k]) {
            filling.fluid[kept] = filling.fluid[k];
            filling.fluid_velocity[kept] = filling.fluid_velocity[k];
            filling.fluid_depth[kept] = filling.fluid_depth[k];
            filling.fluid_pressure[kept] = filling.fluid_pressure[k];
            ++kept;
        }
    }
    filling.fluid.resize(kept);
    filling.fluid_velocity.resize(kept);
    filling.fluid_depth.resize(kept);
    filling.fluid_pressure.resize(kept);
}

bool behind_a_wall(const Scene& scene, const Vec3& p)
{
    return std::any_of(scene.walls.begin(), scene.walls.end(), [&](const Wall& wall) {
        return depth_behind(wall, p, scene.dimensions) > 0;
    });
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

void fill_fluid(const Scene& scene, Filling& filling)
{
    std::vector<BlockPoints> blocks;
    for (const FluidBlock& block : scene.fluid->blocks) {
        blocks.push_back(lattice_of(scene, block));
    }
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        const FluidBlock& block = scene.fluid->blocks[b];
        const StartField start(block, scene.dimensions);
        Index behind = 0;
        for (const Vec3& p : blocks[b].points) {
            const bool taken = std::any_of(
                blocks.begin(), blocks.begin() + static_cast<Index>(b),
                [&](const BlockPoints& earlier) {
                    const auto e = static_cast<std::size_t>(&earlier - blocks.data());
                    return signed_distance(placed(scene, scene.fluid->blocks[e]), p) < 0;
                });
            const bool walled = behind_a_wall(scene, p);
            behind += walled ? 1 : 0;
            if (taken || walled) {
                continue;
            }
            const double surface = surface_above(scene, blocks, b, p);
            filling.fluid.push_back(p);
            filling.fluid_velocity.push_back(start.velocity(p));
            filling.fluid_pressure.push_back(start.pressure(p));
            filling.fluid_depth.push_back(scene.gravity.norm() > 0 ? surface - height(scene, p)
                                                                   : 0);
        }
        if (behind > 0) {
            Diagnostic note = diagnostic_at(
                scene, block.place, fmt::format("fluid.block[{}]", b),
                fmt::format("{} of its {} particles lie behind a wall and are left out", behind,
                            blocks[b].points.size()));
            note.severity = Diagnostic::Severity::warning;
            filling.warnings.push_back(note);
        }
    }
}

// The box of a wall over its whole motion: a path does not overshoot its points.
Bounds swept(const Bounds& box, const Motion& motion, double end)
{
    Bounds all = box;
    const auto add = [&](const Vec3& d) { all.add(Bounds{box.min + d, box.max + d}); };
    add(displacement(motion, end));
    for (std::size_t k = 0; k < motion.times.size(); ++k) {
        if (motion.times[k] < end) {
            add(motion.places[k]);
        }
    }
    return all;
}

} // namespace

int wall_layers(double smoothing_ratio)
{
    return static_cast<int>(std::ceil(2 * smoothing_ratio - 1e-9));
}

Bounds domain_of(const Scene& scene)
{
    if (scene.domain) {
        return {scene.domain->min, scene.domain->max};
    }
    Bounds box;
    if (scene.fluid) {
        for (const FluidBlock& block : scene.fluid->blocks) {
            box.add(bounds(placed(scene, block)));
        }
    }
    for (const BodySettings& body : scene.bodies) {
        box.add(bounds(placed(scene, body)));
    }
    for (const Wall& wall : scene.walls) {
        if (const auto* basin = std::get_if<BasinWall>(&wall.geometry)) {
            box.add(swept({basin->min, basin->max}, wall.motion, scene.time.end));
        } else if (const auto* round = std::get_if<RoundWall>(&wall.geometry)) {
            box.add(swept({round->centre - Vec3::Constant(round->radius),
                           round->centre + Vec3::Constant(round->radius)},
                          wall.motion, scene.time.end));
        } else if (const auto* solid = std::get_if<SolidWall>(&wall.geometry)) {
            box.add(swept(bounds({&solid->shape, solid->centre, solid->rotation, scene.dimensions}),
                          wall.motion, scene.time.end));
        }
    }
    if (box.empty()) {
        box.add(Vec3::Zero());
    }
    for (const Wall& wall : scene.walls) {
        if (const auto* plane = std::get_if<PlaneWall>(&wall.geometry)) {
            // The foot of the scene's middle on the plane: the plane itself has no bounds.
            const Vec3 middle = (box.min + box.max) / 2;
            box.add(Vec3(middle - plane->normal.dot(middle - plane->point) * plane->normal));
        }
    }
    const double headroom = (box.max - box.min).maxCoeff() / 2 + scene.spacing;
    box.max.z() += headroom;
    if (scene.dimensions == 2) {
        box.min.y() = 0;
        box.max.y() = 0;
    }
    return box;
}

Filling fill(const Scene& scene)
{
    check_size(scene);
    Filling filling;
    filling.domain = domain_of(scene);
    if (scene.fluid) {
        fill_walls(scene, filling);
        fill_fluid(scene, filling);
    }
    for (const BodySettings& body : scene.bodies) {
        filling.bodies.push_back(aggregate(body.shape, body.spacing, scene.dimensions));
        if (const auto* mesh = std::get_if<MeshShape>(&body.shape);
            mesh != nullptr && scene.fluid) {
            Aggregate& filled = filling.bodies.back();
            conform_to_surface(*mesh, body.spacing, filled.points);
            filled.particle_volume =
                volume(body.shape, scene.dimensions) / static_cast<double>(filled.points.size());
        }
        if (scene.fluid) {
            take_out(placed(scene, body), scene.spacing, filling);
        }
    }
    return filling;
}

} // namespace hyoryu
