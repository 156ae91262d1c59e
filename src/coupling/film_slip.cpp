// SPDX-License-Identifier: MIT
#include "film_slip.hpp"

#include "hyoryu/core/parallel.hpp"

#include <algorithm>
#include <utility>

namespace hyoryu {

namespace {

// A particle of a solid by its slot in the lists.
struct SolidParticle {
    Vec3 x{0, 0, 0};         // [m]
    double p = 0;            // [Pa]
    double V = 0;            // [m3]
    std::int32_t owner = -1; // a body, or -1 - (index of the wall)
};

SolidParticle particle_of(const Store& store, Index row)
{
    return {store[field::position][row], store[field::pressure][row], store[field::volume][row],
            store.owner()[row]};
}

SolidParticle solid_at(const Fluid& fluid, Index slot)
{
    const auto is_in = [slot](const Tiles& tiles) {
        return slot >= tiles.first_slot && slot < tiles.first_slot + tiles.count();
    };
    const FluidNeighbours& n = fluid.neighbours;
    if (is_in(n.wall)) {
        return particle_of(fluid.particles.wall, n.wall.row[at(slot - n.wall.first_slot)]);
    }
    if (is_in(n.body)) {
        return particle_of(fluid.particles.body, n.body.row[at(slot - n.body.first_slot)]);
    }
    const Ghosts& g = *fluid.ghosts; // whose row k is point k
    return is_in(g.wall.tiles) ? particle_of(g.particles.wall, slot - g.wall.tiles.first_slot)
                               : particle_of(g.particles.body, slot - g.body.tiles.first_slot);
}

// The part of a particle that lies opposite a joint: 1 under the face of the body, 0 beside it,
// with a spacing in between. It is that of a cell about the point half a spacing inside of the
// face.
class Opposite {
public:
    Opposite(const JointTables& tables, const std::vector<Pose>& poses, double spacing)
        : tables_(tables), poses_(poses), spacing_(spacing)
    {
    }

    double operator()(std::size_t body, const FilmCut& cut, const Vec3& x) const
    {
        const Pose& pose = poses_[body];
        const JointFace& face = tables_.bodies[body].faces.faces[at(cut.face)];
        const Vec3 own = pose.orientation.conjugate() * (x - pose.position);
        const double below = face.normal.dot(own - face.centre);
        const Vec3 inside = own - (below + spacing_ / 2) * face.normal;
        return std::clamp(0.5 - distance(tables_.solids[body], inside) / spacing_, 0.0, 1.0);
    }

private:
    const JointTables& tables_;
    const std::vector<Pose>& poses_;
    double spacing_; // [m]
};

// Whether one side of a joint stands on the other.
bool supports(const Fluid& fluid, const FilmCut& cut)
{
    constexpr double steep = 0.3; // cosine, as of the joints
    const Vec3& gravity = fluid.parameters.gravity;
    return std::abs(cut.normal.dot(gravity)) > steep * gravity.norm();
}

// The first cut of each row of bodies; -1 without any. Those of a row follow each other.
void find_cuts(const Fluid& fluid, std::vector<int>& first)
{
    first.assign(at(fluid.particles.body.size()), -1);
    for (std::size_t k = fluid.film_cuts.size(); k-- > 0;) {
        first[at(fluid.film_cuts[k].row)] = static_cast<int>(k);
    }
}

} // namespace

void cut_slip_of_films(JointTables& tables, const std::vector<Pose>& poses, Fluid& fluid)
{
    std::vector<FilmCut>& cuts = fluid.film_cuts;
    if (cuts.empty()) {
        return;
    }
    find_cuts(fluid, tables.first_cut);
    const FluidNeighbours& n = fluid.neighbours;
    Store& store = fluid.particles.body;
    const Opposite opposite(tables, poses, fluid.parameters.spacing);
    const auto pressure = std::as_const(store)[field::pressure];
    std::vector<Vec3> slip(cuts.size(), Vec3(0, 0, 0));
    const auto look = [&](Index i, Index j) {
        const Index row = n.body.row[at(i - n.body.first_slot)];
        const int first = tables.first_cut[at(row)];
        if (first < 0 || !(pressure[row] > 0)) {
            return;
        }
        const SolidParticle other = solid_at(fluid, j);
        const SolidParticle own = particle_of(store, row);
        const Vec3 r = own.x - other.x;
        if (!(other.p > 0) || r.norm() >= fluid.kernel.support) {
            return;
        }
        const Vec<double> way{r.x(), r.y(), r.z()};
        const Vec3 film = -own.V * other.V * (own.p + other.p) * fluid.kernel(way).f * r;
        for (auto k = at(first); k < cuts.size() && cuts[k].row == row; ++k) {
            const bool is_other =
                cuts[k].other < 0 ? other.owner < 0 : other.owner == cuts[k].other;
            if (is_other && !cuts[k].beside && cuts[k].part > 0 && supports(fluid, cuts[k])) {
                const Vec3& normal = cuts[k].normal;
                slip[k] += cuts[k].part * opposite(at(own.owner), cuts[k], other.x) *
                           (film - film.dot(normal) * normal);
            }
        }
    };
    const std::span<const ListBlock> blocks = n.body_solid.blocks();
    parallel_blocks(0, static_cast<Index>(blocks.size()),
                    [&](Index b) { n.body_solid.for_each_pair_of(blocks[at(b)], look); });
    const auto F = store[field::force];
    for (std::size_t k = 0; k < cuts.size(); ++k) {
        F[cuts[k].row] -= slip[k];
        cuts[k].removed += slip[k];
    }
}

} // namespace hyoryu
