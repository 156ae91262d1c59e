// SPDX-License-Identifier: MIT
#include "hyoryu/scene/disk.hpp"

#include "disk_histories.hpp"
#include "hyoryu/scene/case_file.hpp"
#include "hyoryu/scene/gauge_columns.hpp"
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
// Of particles that follow a terrain, and of its surface, on 12 coasts.
constexpr Left left_of_terrain{0.45, 0.002, 0.09, 0.05, 0.005};
constexpr Left left_of_terrain_surface{0.55, 0.2, 0.1, 0.1, 0.027};
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
constexpr double around_results = 8.7e3;
constexpr double frame_in_results = 1.08e3; // links to its files
constexpr double chunk_index = 2.05e3;

// A checkpoint: overhead of a dataset, measured on 24 files [B]; and the numbers of datasets, of
// the state of any scene with its clock, sums, bodies, contacts, rows and texts; of fluid without
// its columns; of gauges; of moving walls; of open sides, and of each of them.
constexpr double of_dataset = 555;
constexpr double datasets_of_any = 59;
constexpr double datasets_of_fluid = 20;
constexpr double datasets_of_gauges = 9;
constexpr double datasets_of_moving_walls = 6;
constexpr double datasets_of_openings = 8;
constexpr double datasets_of_side = 12;

// Bytes of a row in a checkpoint: of the fluid beside its columns, number and tiles of the lists;
// of walls and bodies.
constexpr double checkpoint_fluid = 24;
constexpr double checkpoint_friction = 24;
constexpr double checkpoint_tile = 16;
constexpr double checkpoint_body = 152;       // its state and loads
constexpr double checkpoint_pair = 136 + 377; // a resting contact and its solver state
constexpr double checkpoint_sample = 16;      // of a filter

// Rows of a carpet behind an open side over those that it has room for, on 19 coasts [1].
constexpr double filled_of_carpet = 0.75;

// Texts [B]: plan.json with and without fluid, and what an entry takes beside its own words;
// summary.json, and for each effect and open side; run.log; the limit of the time step of a body.
constexpr double plan_of_fluid = 1.8e3;
constexpr double plan_of_bodies = 1.0e3;
constexpr double plan_of_body = 85;
constexpr double plan_of_effect = 45;
constexpr double plan_of_field = 175;
constexpr double plan_of_entry = 150;
constexpr double summary = 3.3e3;
constexpr double summary_of_effect = 265;
constexpr double summary_of_side = 250;
constexpr double run_log = 120;
constexpr double line_of_series = 68;

double array_bytes(double rows, double bytes, double left)
{
    return rows * bytes < worth_compressing ? rows * bytes : left * rows * bytes + chunk_index;
}

// A frame file of this number of particles in a scene with fluid.
double cloud_bytes(double n, const Left& left, const Scene& scene)
{
    const double vectors = scene.dimensions / 3.0;
    const bool volumes = std::ranges::count(scene.output.fields, "volume") > 0;
    return n == 0 ? 0
                  : around_cloud + array_bytes(n, 12, left.points * vectors) +
                        (volumes ? array_bytes(n, 4, left.pressure) : 0) +
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

const Left& still_walls_of(const Scene& scene)
{
    return terrain_patch_of(scene) != nullptr ? left_of_terrain : left_of_still_walls;
}

const Left& left_of_shapes(const Scene& scene)
{
    return terrain_patch_of(scene) != nullptr ? left_of_terrain_surface : left_of_bodies;
}

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
double surface_bytes(const SurfaceSize& s, const Left& left, double bytes_of_velocity)
{
    return around_surface + array_bytes(s.corners, 12, left.points) +
           array_bytes(s.corners, bytes_of_velocity, left.velocity) +
           array_bytes(s.corners, 4, left_of_structure) + array_bytes(s.triangles, 24, left.ids) +
           array_bytes(s.triangles, 8, left_of_structure) +
           array_bytes(s.triangles, 1, left_of_structure);
}

// Frames, their walls, and the lists of them.
double frames_bytes(const Scene& scene, const Plan& plan, const Course& course)
{
    const Plan::Counts& n = plan.counts;
    const bool moving = has_moving_walls(scene);
    double frame = cloud_bytes(course.fluid * static_cast<double>(n.fluid), left_of_fluid, scene);
    double files = plan.fluid ? 1 : 0;
    if (n.bodies > 0) {
        const auto drawn = static_cast<double>(n.drawn);
        frame += plan.fluid ? cloud_bytes(drawn, left_of_bodies, scene)
                            : dry_cloud_bytes(drawn, scene.dimensions);
        frame += surface_bytes(surface_of_bodies(scene), left_of_bodies, 12);
        files += 2;
    }
    const auto wall = static_cast<double>(n.wall);
    const double shapes =
        scene.walls.empty() ? 0 : surface_bytes(surface_of_walls(scene), left_of_shapes(scene), 0);
    if (moving) {
        frame += cloud_bytes(wall, left_of_moving_walls, scene) + shapes;
        files += 2;
    }
    return plan.frames * (frame + files * line_of_series) +
           cloud_bytes(wall, still_walls_of(scene), scene) + shapes;
}

// Columns of a fluid particle that a checkpoint keeps.
struct KeptColumns {
    double count = 0;
    double bytes = 0;
};

KeptColumns kept_columns(const Plan& plan)
{
    Fluid probe; // has the columns of the run, as in the plan, but no rows of fluid
    probe.parameters = *plan.fluid;
    probe.effects = plan.effects;
    allocate(probe, 0, std::min<Index>(plan.counts.wall, 1), std::min<Index>(plan.counts.body, 1));
    KeptColumns kept;
    for (const ColumnInfo& column : active_columns(probe.particles)) {
        if (column.of_fluid && column.field.state) {
            kept.count += 1;
            kept.bytes += static_cast<double>(column.bytes_per_particle);
        }
    }
    return kept;
}

double fluid_in_checkpoints(const Scene& scene, const Plan& plan, const Course& course)
{
    const KeptColumns kept = kept_columns(plan);
    const bool moving = has_moving_walls(scene);
    double carpets = 0;
    for (const Plan::OpenUse& open : plan.open) {
        carpets += filled_of_carpet * static_cast<double>(open.carpet);
    }
    const auto wall = static_cast<double>(plan.counts.wall);
    const auto body = static_cast<double>(plan.counts.body);
    const double of_solids =
        (plan.runs("no_slip") ? checkpoint_friction : 0) * (wall + body) +
        checkpoint_tile * (body + (moving ? wall : 0)) +
        of_dataset * (datasets_of_fluid + kept.count + (moving ? datasets_of_moving_walls : 0));
    const double rows =
        (1 + course.fluid_end) * static_cast<double>(plan.counts.fluid) + 2 * carpets;
    return rows * (checkpoint_fluid + kept.bytes) + 2 * of_solids;
}

// Samples that the filters hold at the end.
double filter_samples(const Scene& scene, const Plan& plan)
{
    double samples = 0;
    for (const Gauge& gauge : scene.gauges) {
        const double share = std::min(1.0, gauge.window / scene.time.end);
        samples += static_cast<double>(filtered_columns(gauge)) * share * plan.gauge_rows;
    }
    return samples;
}

// Both checkpoints: of the start and of the end.
double checkpoints_bytes(const Scene& scene, const Plan& plan, const Course& course)
{
    const auto sides = static_cast<double>(plan.open.size());
    double numbers =
        datasets_of_any + (sides > 0 ? datasets_of_openings + datasets_of_side * sides : 0);
    numbers += plan.gauges.empty() ? 0 : datasets_of_gauges;
    const double bodies = checkpoint_body * static_cast<double>(plan.counts.bodies);
    return 2 * (of_dataset * numbers + bodies) +
           (plan.fluid ? fluid_in_checkpoints(scene, plan, course) : 0) +
           checkpoint_sample * filter_samples(scene, plan) +
           checkpoint_pair * resting_pairs(scene, plan);
}

// plan.json.
double plan_text(const Plan& plan)
{
    double text = plan.fluid ? plan_of_fluid : plan_of_bodies;
    for (const auto* effects : {&plan.on, &plan.off}) {
        for (const Plan::Effect& effect : *effects) {
            text += plan_of_effect + static_cast<double>(effect.name.size() + effect.why.size());
        }
    }
    for (const Plan::GaugeUse& gauge : plan.gauges) {
        text += plan_of_entry + static_cast<double>(gauge.what.size() + gauge.columns.size());
    }
    for (const Diagnostic& warning : plan.warnings) {
        text += plan_of_entry + static_cast<double>(warning.what.size() + warning.hint.size());
    }
    const std::size_t entries =
        plan.open.size() + plan.floating.size() + plan.materials.size() + plan.pair_kinds.size();
    return text + plan_of_field * static_cast<double>(plan.fields.size()) +
           plan_of_entry * static_cast<double>(entries) +
           plan_of_body * static_cast<double>(plan.counts.bodies);
}

double summary_text(const Plan& plan)
{
    return summary + summary_of_effect * static_cast<double>(plan.on.size()) +
           summary_of_side * static_cast<double>(plan.open.size());
}

} // namespace

double disk_bytes(const Scene& scene, const Plan& plan, const Course& course)
{
    const auto case_text = static_cast<double>(to_toml(scene).size());
    // The case stands in a file of its own, in the checkpoints and in results.h5.
    const double texts = 4 * case_text + 2 * (plan_text(plan) + summary_text(plan)) + run_log;
    return frames_bytes(scene, plan, course) + checkpoints_bytes(scene, plan, course) +
           history_bytes(histories(scene, plan, course)) + around_results +
           frame_in_results * plan.frames + texts;
}

} // namespace hyoryu
