// SPDX-License-Identifier: MIT
#include "hyoryu/scene/disk.hpp"

#include "hyoryu/core/motion.hpp"

#include <algorithm>

namespace hyoryu {

namespace {

// An array that is smaller is stored as it is (io/packed_array).
constexpr double worth_compressing = 65536; // [B]

// What compression leaves, measured in the frames of a dam break and of the debris flood.
constexpr double left_of_floats = 0.8;
constexpr double left_of_ids = 0.25;
constexpr double left_of_structure = 0.01; // connectivity, kinds, bodies: nearly constant

// HDF5's own share of a file, and that of one body in the file of their surfaces: a box, other
// shapes take more.
constexpr double header = 14.4e3;
constexpr double surface_of_body = 1e3;

// A row of fluid in a checkpoint and what all else in one takes; there are two.
constexpr double checkpoint_row = 150;
constexpr double checkpoint_rest = 24e3;

// A number in a history, as text and once more in results.h5.
constexpr double cell = 14 + 8;
constexpr double column_in_results = 2.5e3; // of a history, beside its numbers
constexpr double contact_columns = 12;
constexpr double energy_columns = 16;
constexpr double body_columns = 21;

double array_bytes(double rows, double bytes, double left)
{
    return rows * bytes < worth_compressing ? rows * bytes : left * rows * bytes;
}

// A frame file of so many particles.
double cloud_bytes(Index particles, int dimensions)
{
    const auto n = static_cast<double>(particles);
    const double vectors = left_of_floats * dimensions / 3; // what is always zero takes no room
    return n == 0
               ? 0
               : header + 2 * array_bytes(n, 12, vectors) + 2 * array_bytes(n, 4, left_of_floats) +
                     array_bytes(n, 8, left_of_ids) + 2 * array_bytes(n, 8, left_of_structure) +
                     array_bytes(n, 4, left_of_structure) +
                     2 * array_bytes(n, 1, left_of_structure);
}

double history_bytes(const Scene& scene, const Plan& plan, double steps)
{
    const double every = scene.output.history_every;
    const double rows = every > 0 ? scene.time.end / every : steps;
    const auto bodies = static_cast<double>(plan.counts.bodies);
    double gauges = 0; // columns
    for (const Plan::GaugeUse& gauge : plan.gauges) {
        gauges += 1 + static_cast<double>(std::ranges::count(gauge.columns, ','));
    }
    const double tables =
        energy_columns + gauges + (bodies > 0 ? body_columns + contact_columns : 0);
    return cell * (rows * (energy_columns + body_columns * bodies) + plan.gauge_rows * gauges) +
           column_in_results * tables;
}

} // namespace

double disk_bytes(const Scene& scene, const Plan& plan, double steps)
{
    const int d = scene.dimensions;
    const Plan::Counts& n = plan.counts;
    double frame = cloud_bytes(n.fluid, d) + cloud_bytes(n.drawn, d);
    if (n.bodies > 0) {
        frame += header + surface_of_body * static_cast<double>(n.bodies);
    }
    const double checkpoint = checkpoint_row * static_cast<double>(n.fluid) + checkpoint_rest;
    const bool moving =
        std::ranges::any_of(scene.walls, [](const Wall& wall) { return moves(wall.motion); });
    const double walls = cloud_bytes(n.wall, d) + header;
    return plan.frames * frame + (moving ? plan.frames : 1) * walls + 2 * checkpoint +
           history_bytes(scene, plan, steps);
}

} // namespace hyoryu
