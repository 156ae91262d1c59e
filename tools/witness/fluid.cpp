// SPDX-License-Identifier: MIT
// Fluid particles against exact distances to solids, and the momentum of the frames.
#include "judge.hpp"
#include "mass.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace witness {

namespace {

constexpr double a_quarter = 0.25; // of a spacing: deeper is inside
constexpr double same_time = 1e-9; // of a row and a frame [s]

double box_distance(const Vec3& middle, const Vec3& half, Vec3 p, int dimensions)
{
    Vec3 q = (p - middle).cwiseAbs() - half;
    if (dimensions == 2) {
        q.y() = -INFINITY;
    }
    return q.maxCoeff() > 0 ? q.cwiseMax(0).norm() : q.maxCoeff();
}

double cylinder_distance(const Solid& solid, const Vec3& p)
{
    const double along = std::abs(p.x()) - solid.length / 2;
    const double across = std::hypot(p.y(), p.z()) - solid.radius;
    const double most = std::max(along, across);
    return most > 0 ? std::hypot(std::max(along, 0.0), std::max(across, 0.0)) : most;
}

// To the nearest of the sides that are closed; slabs with a thickness and a rim.
double basin_distance(const Solid& basin, const Vec3& p, int dimensions)
{
    double nearest = INFINITY;
    for (std::size_t side = 0; side < 6; ++side) {
        const auto axis = static_cast<Eigen::Index>(side / 2);
        if (basin.open[side] || (dimensions == 2 && axis == 1)) {
            continue;
        }
        Vec3 from = basin.low, to = basin.high;
        for (Eigen::Index k = 0; k < 3; ++k) {
            const auto m = static_cast<std::size_t>(k);
            from[k] -= basin.open[2 * m] ? 0 : basin.thickness;
            to[k] += basin.open[2 * m + 1] ? 0 : basin.thickness;
        }
        (side % 2 == 0 ? to : from)[axis] = (side % 2 == 0 ? basin.low : basin.high)[axis];
        nearest = std::min(nearest, box_distance((from + to) / 2, (to - from) / 2, p, dimensions));
    }
    return nearest;
}

double mesh_distance(const Mesh& mesh, const Vec3& p)
{
    // Outside of its box is far enough.
    return bounds_of(mesh).contains(p) && winding_number(mesh, p) > 0.5 ? -distance_to(mesh, p)
                                                                        : INFINITY;
}

double cubes_distance(const Solid& body, const Vec3& p)
{
    double nearest = INFINITY;
    for (const Vec3& centre : body.points) {
        nearest = std::min(nearest, box_distance(centre, Vec3::Constant(body.edge / 2), p, 3));
    }
    return nearest;
}

Vec3 momentum_of(const Frame& frame, const Scene& scene, double& scale)
{
    const double same = scene.particle_mass;
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = 0; k < frame.points.size(); ++k) {
        const double m = !frame.masses.empty()    ? frame.masses[k]
                         : !frame.volumes.empty() ? frame.volumes[k] * frame.densities[k]
                                                  : same;
        sum += m * frame.velocities[k];
        scale += m * frame.velocities[k].norm();
    }
    return sum;
}

// Planes and basins are given in space, all else in their own axes.
State pose_of(const Solid& wall, double time)
{
    State pose;
    pose.x = displacement(wall.path, time);
    if (wall.kind != Kind::plane && wall.kind != Kind::basin) {
        pose.x += wall.position;
        pose.q = wall.rotation;
    }
    return pose;
}

// Momentum in energy.csv at the time of a frame, if it has a row then.
std::optional<Vec3> momentum_at(const Table& energy, const std::vector<double>& times, double t)
{
    const auto at = std::lower_bound(times.begin(), times.end(), t - same_time);
    const auto first = energy.column("momentum_x");
    if (at == times.end() || *at > t + same_time || !first) {
        return std::nullopt;
    }
    const auto& row = energy.rows[static_cast<std::size_t>(at - times.begin())];
    return Vec3(std::stod(row[*first]), std::stod(row[*first + 1]), std::stod(row[*first + 2]));
}

class FluidFinder {
public:
    FluidFinder(const std::filesystem::path& folder, const Scene& scene,
                const std::vector<Row>& rows)
        : scene_(scene), rows_(rows), energy_(read_table(folder / "energy.csv")),
          times_(energy_.numbers("time"))
    {
    }

    void take(const Frame& frame)
    {
        std::vector<State> poses;
        for (std::size_t b = 0; b < scene_.bodies.size(); ++b) {
            poses.push_back(pose_at(rows_, b, frame.time));
        }
        std::size_t count = 0;
        for (const Vec3& p : frame.points) {
            double deepest = 0;
            for (const Solid& wall : scene_.walls) {
                const double d =
                    signed_distance(wall, pose_of(wall, frame.time), p, scene_.dimensions);
                note(d, frame.time, wall.name, deepest);
            }
            for (std::size_t b = 0; b < poses.size(); ++b) {
                if (!poses[b].there) {
                    continue;
                }
                const double d = signed_distance(scene_.bodies[b], poses[b], p, scene_.dimensions);
                note(d, frame.time, scene_.bodies[b].name, deepest);
            }
            count += deepest < -a_quarter * scene_.spacing ? 1 : 0;
        }
        if (count > found.worst_count) {
            found.worst_count = count;
            found.worst_time = frame.time;
        }
        found.end_count = count;
        ++found.frames;
        take_momentum(frame);
    }

    FluidFinding found;

private:
    void note(double distance, double time, const std::string& name, double& deepest)
    {
        deepest = std::min(deepest, distance);
        if (-distance > found.deepest) {
            found.deepest = -distance;
            found.deepest_time = time;
            found.solid = name;
        }
    }

    void take_momentum(const Frame& frame)
    {
        const auto told = momentum_at(energy_, times_, frame.time);
        double scale = 0;
        Vec3 sum = momentum_of(frame, scene_, scale);
        for (std::size_t b = 0; b < scene_.bodies.size() && told; ++b) {
            if (!scene_.bodies[b].held && pose_at(rows_, b, frame.time).there) {
                const double m = mass_of(scene_.bodies[b], scene_.dimensions).mass;
                sum += m * pose_at(rows_, b, frame.time).v;
                scale += m * pose_at(rows_, b, frame.time).v.norm();
            }
        }
        found.momentum_scale = std::max(found.momentum_scale, scale);
        found.momentum_error =
            told ? std::max(found.momentum_error, (sum - *told).norm()) : found.momentum_error;
    }

    const Scene& scene_;
    const std::vector<Row>& rows_;
    Table energy_;
    std::vector<double> times_;
};

} // namespace

double signed_distance(const Solid& solid, const State& pose, const Vec3& point, int dimensions)
{
    Vec3 p = pose.q.conjugate() * (point - pose.x) - solid.middle;
    switch (solid.kind) {
    case Kind::plane:
        return solid.normal.dot(p - solid.point);
    case Kind::basin:
        return basin_distance(solid, p, dimensions);
    case Kind::ball:
        p.y() = dimensions == 2 ? 0 : p.y();
        return p.norm() - solid.radius;
    case Kind::round_basin:
        p.y() = dimensions == 2 ? 0 : p.y();
        return solid.radius - p.norm();
    case Kind::mesh:
        return mesh_distance(solid.mesh, p);
    case Kind::cubes:
        return cubes_distance(solid, p);
    case Kind::cylinder:
        if (dimensions == 3) {
            return cylinder_distance(solid, p);
        }
        return box_distance(Vec3::Zero(), {solid.length / 2, 0, solid.radius}, p, 2);
    default:
        return box_distance(Vec3::Zero(), solid.size / 2, p, dimensions);
    }
}

State pose_at(const std::vector<Row>& rows, std::size_t body, double t)
{
    const auto next = std::lower_bound(rows.begin(), rows.end(), t - same_time,
                                       [](const Row& row, double time) { return row.time < time; });
    if (next == rows.end()) {
        return rows.back().bodies[body];
    }
    const State& b = next->bodies[body];
    if (next == rows.begin() || next->time <= t + same_time) {
        return b;
    }
    const State& a = (next - 1)->bodies[body];
    if (!b.there) { // since some time between the rows
        return b;
    }
    const double h = next->time - (next - 1)->time;
    const double s = (t - (next - 1)->time) / h;
    State pose = b;
    pose.x = (1 + 2 * s) * (1 - s) * (1 - s) * a.x + s * s * (3 - 2 * s) * b.x +
             h * s * (1 - s) * (1 - s) * a.v + h * s * s * (s - 1) * b.v;
    pose.q = a.q.slerp(s, b.q);
    pose.v = (1 - s) * a.v + s * b.v;
    return pose;
}

FluidFinding find_fluid(const std::filesystem::path& folder, const Scene& scene,
                        const std::vector<Row>& rows)
{
    FluidFinder finder(folder, scene, rows);
    std::set<std::int64_t> first, last;
    for (const std::filesystem::path& file : frame_files(folder)) {
        const Frame frame = read_frame(file);
        last = {frame.ids.begin(), frame.ids.end()};
        first = first.empty() ? last : first;
        finder.take(frame);
    }
    for (const std::int64_t id : first) {
        finder.found.lost += last.contains(id) ? 0 : 1;
    }
    return finder.found;
}

} // namespace witness
