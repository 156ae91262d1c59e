// SPDX-License-Identifier: MIT
#include "penalty_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hyoryu {

namespace {

// Number of layers of wall particles outside a basin.
constexpr Index basin_layers = 2;

/// The particles of a plane or basin, in the middle of the cells of a lattice.
struct Lattice {
    Vec3 origin{0, 0, 0};
    Mat3 axes = Mat3::Identity(); // columns: the directions of the lattice
    Vec3 cell = Vec3::Ones();     // edge lengths [m]
    bool flat = false;            // one layer along the second direction: the section of a 2-D run
    const Basin* basin = nullptr; // none: the half-space below the origin in the third direction
    std::array<Index, 3> cells{}; // within the basin

    bool filled(const std::array<Index, 3>& at) const
    {
        if (basin == nullptr) {
            return at[2] < 0;
        }
        bool outside = false;
        for (std::size_t k = 0; k < 3; ++k) {
            if (flat && k == 1) {
                continue;
            }
            const bool below = at[k] < 0;
            const bool above = at[k] >= cells[k];
            if ((below && basin->open[2 * k]) || (above && basin->open[2 * k + 1]) ||
                at[k] < -basin_layers || at[k] >= cells[k] + basin_layers) {
                return false;
            }
            outside = outside || below || above;
        }
        return outside;
    }
};

Lattice lattice_of(const Plane& plane, double spacing, int dimensions)
{
    const Vec3& n = plane.normal;
    Lattice lattice;
    lattice.origin = plane.point;
    lattice.flat = dimensions == 2;
    lattice.cell.setConstant(spacing);
    const Vec3 helper = std::abs(n.x()) < 0.9 ? Vec3::UnitX() : Vec3::UnitY();
    const Vec3 t = lattice.flat ? Vec3(Vec3::UnitY().cross(n))
                                : Vec3((helper - helper.dot(n) * n).normalized());
    lattice.axes << t, n.cross(t), n;
    return lattice;
}

Lattice lattice_of(const Basin& basin, double spacing, int dimensions)
{
    Lattice lattice;
    lattice.origin = basin.min;
    lattice.flat = dimensions == 2;
    lattice.basin = &basin;
    for (int m = 0; m < 3; ++m) {
        const auto k = static_cast<std::size_t>(m);
        const double size = basin.max[m] - basin.min[m];
        lattice.cells[k] = std::max<Index>(1, std::llround(size / spacing));
        lattice.cell[m] = size > 0 ? size / static_cast<double>(lattice.cells[k]) : spacing;
    }
    return lattice;
}

// Calls put(particle) for the particles of the lattice that are nearer than `range` to p.
void over_near(const Lattice& lattice, const Vec3& p, double range, const auto& put)
{
    Vec3 local = lattice.axes.transpose() * (p - lattice.origin);
    std::array<Index, 3> first{};
    std::array<Index, 3> last{};
    for (int m = 0; m < 3; ++m) {
        const auto k = static_cast<std::size_t>(m);
        const bool single = lattice.flat && m == 1;
        first[k] =
            single ? 0 : static_cast<Index>(std::floor((local[m] - range) / lattice.cell[m]));
        last[k] = single ? 0 : static_cast<Index>(std::floor((local[m] + range) / lattice.cell[m]));
    }
    for (Index i = first[0]; i <= last[0]; ++i) {
        for (Index j = first[1]; j <= last[1]; ++j) {
            for (Index k = first[2]; k <= last[2]; ++k) {
                if (!lattice.filled({i, j, k})) {
                    continue;
                }
                const auto middle = [](Index c) { return static_cast<double>(c) + 0.5; };
                Vec3 at = lattice.cell.cwiseProduct(Vec3(middle(i), middle(j), middle(k)));
                at.y() = lattice.flat ? local.y() : at.y();
                if ((at - local).squaredNorm() < sq(range)) {
                    put(Vec3(lattice.origin + lattice.axes * at));
                }
            }
        }
    }
}

// The same for the particles of a cloud; p in its axes.
void over_near(const ParticleCloud& cloud, const Vec3& p, double range, const auto& put)
{
    const CellGrid& grid = cloud.grid;
    const Vec3 reach = Vec3::Constant(range);
    for_points_in(grid, grid.cell_of(p - reach), grid.cell_of(p + reach), [&](std::size_t row) {
        const Vec3& at = cloud.points[row];
        if ((at - p).squaredNorm() < sq(range)) {
            put(at);
        }
    });
}

class Search {
public:
    Search(const StepContext& context, double skin, double time)
        : context_(context), penalty_(*context.rigid.penalty), skin_(skin), time_(time)
    {
    }

    std::vector<Meeting> all()
    {
        const auto bodies = static_cast<int>(context_.rigid.bodies.size());
        const auto walls = static_cast<int>(context_.rigid.boundaries.size());
        for (int a = 0; a < bodies; ++a) {
            for (int w = 0; w < walls && movable(a); ++w) {
                meet_wall(a, w);
            }
        }
        sweep();
        return std::move(found_);
    }

private:
    bool movable(int k) const { return context_.memory.rotors[k].movable; }
    bool left(int k) const { return context_.rigid.bodies[k].left; }
    const SolidPose& pose(int k) const { return context_.memory.poses[k]; }
    const ParticleCloud& cloud(int k) const { return penalty_.bodies[k]; }

    void keep(Meeting& meeting)
    {
        if (!meeting.pairs.empty()) {
            found_.push_back(std::move(meeting));
        }
    }

    void meet_wall(int a, int w)
    {
        const Boundary& wall = context_.rigid.boundaries[w];
        const int dimensions = context_.rigid.settings.dimensions;
        // Walls are searched at their place at time 0; the body is moved back instead.
        const Vec3 back = -displacement(wall.motion, time_);
        Meeting meeting{{a, -1 - w}, 0.5 * (cloud(a).spacing + penalty_.wall_spacing), {}};
        if (const auto* plane = std::get_if<Plane>(&wall.surface)) {
            const double height = plane->normal.dot(pose(a).x + back - plane->point);
            if (height - cloud(a).reach < meeting.range + skin_) {
                pair_up(meeting, lattice_of(*plane, penalty_.wall_spacing, dimensions), back);
            }
        } else if (const auto* basin = std::get_if<Basin>(&wall.surface)) {
            if (!clear_of(*basin, pose(a).x + back, cloud(a).reach + meeting.range + skin_)) {
                pair_up(meeting, lattice_of(*basin, penalty_.wall_spacing, dimensions), back);
            }
        } else {
            const ParticleCloud& obstacle = penalty_.obstacles[w];
            meeting.range = 0.5 * (cloud(a).spacing + obstacle.spacing);
            pair_up(meeting, obstacle, back);
        }
        keep(meeting);
    }

    // Whether a ball of this radius touches no closed side from within.
    bool clear_of(const Basin& basin, const Vec3& centre, double radius) const
    {
        for (int m = 0; m < 3; ++m) {
            const auto k = static_cast<std::size_t>(m);
            if ((!basin.open[2 * k] && centre[m] - radius < basin.min[m]) ||
                (!basin.open[2 * k + 1] && centre[m] + radius > basin.max[m])) {
                return false;
            }
        }
        return true;
    }

    void pair_up(Meeting& meeting, const auto& wall, const Vec3& back) const
    {
        const SolidPose& at = pose(meeting.who.a);
        for (const Vec3& own : cloud(meeting.who.a).points) {
            over_near(wall, Vec3(at.x + at.R * own + back), meeting.range + skin_,
                      [&](const Vec3& other) {
                          meeting.pairs.push_back({own, other});
                      });
        }
    }

    void meet_body(int a, int b)
    {
        const double range = 0.5 * (cloud(a).spacing + cloud(b).spacing);
        const double reach = cloud(a).reach + cloud(b).reach + range + skin_;
        if ((pose(a).x - pose(b).x).squaredNorm() >= sq(reach)) {
            return;
        }
        Meeting meeting{{a, b}, range, {}};
        const Mat3 turn = pose(b).R.transpose() * pose(a).R;
        const Vec3 shift = pose(b).R.transpose() * (pose(a).x - pose(b).x);
        for (const Vec3& own : cloud(a).points) {
            over_near(cloud(b), Vec3(shift + turn * own), range + skin_, [&](const Vec3& other) {
                meeting.pairs.push_back({own, other});
            });
        }
        keep(meeting);
    }

    // Pairs of bodies whose extents along x overlap.
    void sweep()
    {
        std::vector<int> order(context_.rigid.bodies.size());
        std::iota(order.begin(), order.end(), 0);
        const auto margin = [&](int k) {
            return cloud(k).reach + 0.5 * (cloud(k).spacing + skin_);
        };
        const auto low = [&](int k) { return pose(k).x.x() - margin(k); };
        std::sort(order.begin(), order.end(),
                  [&](int a, int b) { return std::pair(low(a), a) < std::pair(low(b), b); });
        for (std::size_t m = 0; m < order.size(); ++m) {
            const double high = pose(order[m]).x.x() + margin(order[m]);
            for (std::size_t n = m + 1; n < order.size() && low(order[n]) < high; ++n) {
                if ((movable(order[m]) || movable(order[n])) && !left(order[m]) &&
                    !left(order[n])) {
                    meet_body(std::min(order[m], order[n]), std::max(order[m], order[n]));
                }
            }
        }
    }

    const StepContext& context_;
    const Penalty& penalty_;
    double skin_;
    double time_;
    std::vector<Meeting> found_;
};

} // namespace

ParticleCloud particle_cloud(std::vector<Vec3> points, double spacing)
{
    ParticleCloud cloud;
    cloud.points = std::move(points);
    cloud.spacing = spacing;
    for (const Vec3& point : cloud.points) {
        cloud.reach = std::max(cloud.reach, point.norm());
    }
    build(cloud.grid, cloud.points, 0, spacing);
    return cloud;
}

std::vector<Meeting> find_meetings(const StepContext& context, double skin, double time)
{
    return Search(context, skin, time).all();
}

} // namespace hyoryu
