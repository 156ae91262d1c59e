// SPDX-License-Identifier: MIT
#include "hyoryu/scene/disk.hpp"

#include "disk_histories.hpp"
#include "hyoryu/scene/case_file.hpp"
#include "hyoryu/scene/moving_walls.hpp"
#include "hyoryu/scene/triangles.hpp"

#include <algorithm>

namespace hyoryu {

namespace {

// Compressed over raw size of the arrays of a frame [1]. Two-dimensional vectors take two thirds,
// since a component that is always zero compresses to nothing.
struct Left {
    double points;
    double velocity;
    double pressure;
    double density;
    double ids;
};
// Measured on the dam break of SPHERIC 2, the wedge and the debris flood.
constexpr Left left_of_fluid{0.75, 0.8, 0.75, 0.45, 0.2};
// Measured on the same cases and two more in three dimensions, with fixed walls on lattices.
constexpr Left left_of_still_walls{0.2, 0.002, 0.02, 0.01, 0.004};
// Measured on a wedge that is driven into water.
constexpr Left left_of_moving_walls{0.2, 0.002, 0.35, 0.2, 0.004};
// Measured on heaps of 2,000 boxes, part of which rests.
constexpr Left left_of_bodies{0.3, 0.2, 0.1, 0.1, 0.005};
// Connectivity, offsets, kinds, bodies: nearly constant.
constexpr double left_of_structure = 0.004;

// Overhead of HDF5: of a file, of an array, and of the chunk index of a compressed array [B].
constexpr double around_cloud = 15.8e3;
constexpr double around_dry_cloud = 14.2e3; // without pressure and density
constexpr double around_surface = 13.8e3;
constexpr double around_checkpoint = 11.4e3;
constexpr double around_fluid = 8.8e3; // of a checkpoint
constexpr double around_results = 8.7e3;
constexpr double frame_in_results = 1.08e3; // links to its files
constexpr double chunk_index = 2.05e3;

// Bytes of a row in a checkpoint: of the fluid 64 for state and number, 24 for each force, 20 for
// the tiles of the neighbour lists, 16 for the rates due to solids; then of walls and bodies.
constexpr double checkpoint_fluid = 112;
constexpr double checkpoint_friction = 24;
constexpr double checkpoint_at_solids = 16;
constexpr double checkpoint_tile = 16;
constexpr double checkpoint_body = 152;       // its state and loads
constexpr double checkpoint_pair = 136 + 377; // a resting contact and its solver state

// Texts [B].
constexpr double plan_of_fluid = 6e3;
constexpr double plan_of_bodies = 3e3;
constexpr double plan_of_body = 85; // its limit of the time step
constexpr double summary = 4.5e3;
constexpr double line_of_series = 68;

double array_bytes(double rows, double bytes, double left)
{
    return rows * bytes < worth_compressing ? rows * bytes : left * rows * bytes + chunk_index;
}

// A frame file of this number of particles in a scene with fluid.
double cloud_bytes(double n, const Left& left, int dimensions)
{
    const double vectors = dimensions / 3.0;
    return n == 0 ? 0
                  : around_cloud + array_bytes(n, 12, left.points * vectors) +
                        array_bytes(n, 12, left.velocity * vectors) +
                        array_bytes(n, 4, left.pressure) + array_bytes(n, 4, left.density) +
                        array_bytes(n, 8, left.ids) + 2 * array_bytes(n, 8, left_of_structure) +
                        array_bytes(n, 4, left_of_structure) +
                        2 * array_bytes(n, 1, left_of_structure);
}

// The same without fluid.
double dry_cloud_bytes(double n, int dimensions)
{
    const Left& left = left_of_bodies;
    const double vectors = dimensions / 3.0;
    return around_dry_cloud + array_bytes(n, 12, left.points * vectors) +
           array_bytes(n, 12, left.velocity * vectors) + array_bytes(n, 8, left.ids) +
           2 * array_bytes(n, 8, left_of_structure) + array_bytes(n, 4, left_of_structure) +
           2 * array_bytes(n, 1, left_of_structure);
}

struct SurfaceSize {
    double corners = 0;
    double triangles = 0;
};

void add(SurfaceSize& all, const TriangleSurface& part)
{
    all.corners += static_cast<double>(part.corners.size());
    all.triangles += static_cast<double>(part.triangles.size());
}

SurfaceSize surface_of_bodies(const Scene& scene)
{
    SurfaceSize all;
    for (const BodySettings& body : scene.bodies) {
        add(all, triangles_of(body.shape, scene.dimensions));
    }
    return all;
}

SurfaceSize surface_of_walls(const Scene& scene)
{
    SurfaceSize all;
    const Bounds domain = domain_of(scene);
    for (const Wall& wall : scene.walls) {
        add(all, triangles_of(wall, domain, scene.dimensions));
    }
    return all;
}

// Walls have no velocities.
double surface_bytes(const SurfaceSize& s, double bytes_of_velocity)
{
    const Left& left = left_of_bodies;
    return around_surface + array_bytes(s.corners, 12, left.points) +
           array_bytes(s.corners, bytes_of_velocity, left.velocity) +
           array_bytes(s.corners, 4, left_of_structure) +
           array_bytes(s.triangles, 24, left_of_structure) +
           array_bytes(s.triangles, 8, left_of_structure) +
           array_bytes(s.triangles, 1, left_of_structure);
}

// Frames, their walls, and the lists of them.
double frames_bytes(const Scene& scene, const Plan& plan, const Course& course)
{
    const int d = scene.dimensions;
    const Plan::Counts& n = plan.counts;
    const bool moving = has_moving_walls(scene);
    double frame = cloud_bytes(course.fluid * static_cast<double>(n.fluid), left_of_fluid, d);
    double files = plan.fluid ? 1 : 0;
    if (n.bodies > 0) {
        const auto drawn = static_cast<double>(n.drawn);
        frame += plan.fluid ? cloud_bytes(drawn, left_of_bodies, d) : dry_cloud_bytes(drawn, d);
        frame += surface_bytes(surface_of_bodies(scene), 12);
        files += 2;
    }
    const auto wall = static_cast<double>(n.wall);
    const double shapes = scene.walls.empty() ? 0 : surface_bytes(surface_of_walls(scene), 0);
    if (moving) {
        frame += cloud_bytes(wall, left_of_moving_walls, d) + shapes;
        files += 2;
    }
    return plan.frames * (frame + files * line_of_series) +
           cloud_bytes(wall, left_of_still_walls, d) + shapes;
}

// Both checkpoints: of the start and of the end.
double checkpoints_bytes(const Scene& scene, const Plan& plan, const Course& course)
{
    const auto column = [&](const char* name) {
        return std::ranges::find(plan.fields, name, &Plan::FieldUse::name) != plan.fields.end();
    };
    const Plan::Counts& n = plan.counts;
    const bool moving = has_moving_walls(scene);
    const bool sticks = column("ViscousForce") && plan.runs("no_slip");
    const double row = checkpoint_fluid + (column("ViscousForce") ? checkpoint_friction : 0) +
                       (column("SolidRate") ? checkpoint_at_solids : 0);
    const auto wall = static_cast<double>(n.wall);
    const auto body = static_cast<double>(n.body);
    const double solids = (sticks ? checkpoint_friction : 0) * (wall + body) +
                          checkpoint_tile * (body + (moving ? wall : 0));
    const double one = around_checkpoint + (plan.fluid ? around_fluid : 0) + solids +
                       checkpoint_body * static_cast<double>(n.bodies);
    return 2 * one + (1 + course.fluid_end) * row * static_cast<double>(n.fluid) +
           checkpoint_pair * resting_pairs(scene, plan);
}

} // namespace

double disk_bytes(const Scene& scene, const Plan& plan, const Course& course)
{
    const double report =
        plan.fluid ? plan_of_fluid + plan_of_body * static_cast<double>(plan.counts.bodies)
                   : plan_of_bodies;
    const auto case_text = static_cast<double>(to_toml(scene).size());
    // The case stands in a file of its own, in the checkpoints and in results.h5.
    const double texts = 4 * case_text + 2 * (report + summary);
    return frames_bytes(scene, plan, course) + checkpoints_bytes(scene, plan, course) +
           history_bytes(histories(scene, plan, course)) + around_results +
           frame_in_results * plan.frames + texts;
}

} // namespace hyoryu
