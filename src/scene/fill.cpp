// SPDX-License-Identifier: MIT
#include "hyoryu/scene/fill.hpp"

#include "conform.hpp"
#include "displace.hpp"
#include "fill_size.hpp"
#include "hyoryu/scene/case_file.hpp"
#include "hyoryu/scene/formula.hpp"
#include "walls.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
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
            take_out(scene, body, filling);
        }
    }
    return filling;
}

} // namespace hyoryu
