// SPDX-License-Identifier: MIT
// What the witness finds in a results folder.
#pragma once

#include "scene.hpp"

#include <nlohmann/json.hpp>

namespace witness {

struct OverlapFinding {
    double worst = 0; // [m]
    double time = 0;  // of the worst [s]
    std::string a, b; // the two
    double fcl = 0;   // what FCL says of that pair then [m]
    std::size_t rows = 0;
    std::size_t looked_at = 0;       // pairs of parts
    double first_row = 0;            // worst at the start [m]
    std::size_t rows_over_bound = 0; // rows in which a pair overlaps by more than the bound
};

/// True overlaps of all pairs of bodies, and of bodies and walls, at the rows of bodies.csv. Pairs
/// of which neither can move are left out.
OverlapFinding find_overlaps(const Scene& scene, const std::vector<Row>& rows, double bound);

struct FluidFinding {
    std::size_t frames = 0;
    std::size_t worst_count = 0; // particles deeper than a quarter of a spacing, in the worst frame
    double worst_time = 0;       // of that frame [s]
    std::size_t end_count = 0;   // in the last frame
    double deepest = 0;          // of any particle in any solid [m]
    double deepest_time = 0;
    std::string solid;         // that holds the deepest
    std::size_t lost = 0;      // ids of the first frame that the last has not
    double momentum_error = 0; // of fluid and bodies against energy.csv [kg m/s]
    double momentum_scale = 0; // largest sum of m |v| [kg m/s]
};

/// Fluid inside solids, and the momentum, of every frame.
FluidFinding find_fluid(const std::filesystem::path& folder, const Scene& scene,
                        const std::vector<Row>& rows);

/// Signed distance from a point to a solid in that pose, negative inside [m]; from a mesh outside
/// it: infinite. Planes and basins are posed by a displacement alone.
double signed_distance(const Solid& solid, const State& pose, const Vec3& point, int dimensions);

struct BookFinding {
    bool judged = false;      // neither fluid nor walls that move
    double growth = 0;        // of the mechanical energy above that of the start, over `scale` [1]
    double rise = 0;          // above any earlier row, over `scale` [1]
    double rise_time = 0;     // [s]
    double scale = 0;         // [J]
    double kinetic_error = 0; // against energy.csv, largest, over the largest kinetic energy [1]
    double momentum_error =
        0;              // without fluid: against energy.csv, over the largest sum of m|v| [1]
    double closure = 0; // momentum - start - impulses of walls and gravity, over the impulses [1]
};

/// Energy and momentum of the bodies, their masses and inertia by the witness.
BookFinding find_books(const std::filesystem::path& folder, const Scene& scene,
                       const std::vector<Row>& rows);

/// The pose of a body at time t between two rows.
State pose_at(const std::vector<Row>& rows, std::size_t body, double t);

/// Accuracy of the overlaps of random pairs of known depth; returns the number of failures.
int self_test(nlohmann::ordered_json& json);

} // namespace witness
