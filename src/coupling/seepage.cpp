// SPDX-License-Identifier: MIT
// Seepage forces: kind and life of the joints, their loads, and the film forces that they replace.
#include "hyoryu/coupling/seepage.hpp"

#include "film_slip.hpp"
#include "joint_cover.hpp"
#include "joint_pressure.hpp"

#include "hyoryu/core/error.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace hyoryu {

namespace {

constexpr double widest = 2; // largest width of a joint in spacings; wider gaps contain particles

// Decides the kind of each joint and the body whose cells represent it. No water enters below a
// sealed body; the sides of a sealed body have no joints.
class KindOfJoint {
public:
    KindOfJoint(const Seepage& seepage, const JointTables& tables, const std::vector<Pose>& poses,
                const Vec3& gravity)
        : open_(seepage.open), solids_(tables.solids), poses_(poses),
          down_(gravity.norm() > 0 ? Vec3(gravity.normalized()) : Vec3(Vec3::Zero()))
    {
    }

    JointKind operator()(int b, int other, const Vec3& normal) const
    {
        constexpr double steep = 0.3; // cosine below which neither body supports the other
        const double downward = normal.dot(down_);
        if (other < 0) {
            return downward > steep ? under(b) : beside(b, b);
        }
        const bool stacked = std::abs(downward) > steep;
        if (!carries(b, other, stacked)) {
            return JointKind::none;
        }
        if (stacked) {
            return under(downward > 0 ? b : other);
        }
        return beside(b, other);
    }

private:
    // The cells belong to the smaller body: its face more likely lies within that of the other, and
    // the joint replaces the film forces of all particles behind it. In a stack the narrower body
    // is chosen: with the cells on a wide, low base the films of its ledge would push on the body
    // above. Widths within 1 % count as equal, so that rounding does not move a joint from one body
    // to the other.
    bool carries(int b, int other, bool stacked) const
    {
        constexpr double equal = 1.01;
        if (stacked) {
            const double own = width(b);
            const double its = width(other);
            if (std::max(own, its) > equal * std::min(own, its)) {
                return own < its;
            }
        }
        return std::pair{solids_[at(b)].reach, b} <= std::pair{solids_[at(other)].reach, other};
    }
    double width(int b) const
    {
        return reach_across(solids_[at(b)], poses_[at(b)].orientation.conjugate() * down_);
    }
    JointKind under(int upper) const
    {
        return open_[at(upper)] != 0 ? JointKind::open : JointKind::sealed;
    }
    JointKind beside(int a, int b) const
    {
        return open_[at(a)] != 0 && open_[at(b)] != 0 ? JointKind::open : JointKind::none;
    }

    const std::vector<std::uint8_t>& open_;
    const std::vector<RaySolid>& solids_;
    const std::vector<Pose>& poses_;
    Vec3 down_;
};

ParticlePressure pressure_of(const Fluid& fluid)
{
    const Store& bodies = fluid.particles.body;
    return {.x = bodies[field::position],
            .p = bodies[field::pressure],
            .shepard = bodies[field::shepard_sum],
            .spacing = fluid.parameters.spacing,
            .support = fluid.kernel.support,
            .weight = fluid.parameters.eos.rho0 * fluid.parameters.gravity,
            .density = fluid.parameters.eos.rho0,
            .sound = fluid.parameters.eos.c0};
}

// Makes the faces from the particles in the order of their numbers, independent of the order of
// rows.
void make_faces(BodyJoints& body, const Body& rigid, std::span<const Vec3> points, Index first,
                const Fluid& fluid, double particle_mass)
{
    const FluidParameters& f = fluid.parameters;
    const double volume = particle_mass / f.eos.rho0;
    const auto id = fluid.particles.body.id();
    std::vector<int> row(points.size());
    std::iota(row.begin(), row.end(), 0);
    std::ranges::sort(row, {}, [&](int k) { return id[first + k]; });
    std::vector<Vec3> numbered;
    for (const int k : row) {
        numbered.push_back(points[at(k)]);
    }
    body.faces = joint_faces(
        rigid.shape, numbered,
        {f.spacing, std::pow(volume, 1.0 / f.dimensions), fluid.kernel.support, f.dimensions});
    const auto to_row = [&](int& particle) { particle = particle < 0 ? -1 : row[at(particle)]; };
    std::ranges::for_each(body.faces.particles, to_row);
    for (JointCell& cell : body.faces.cells) {
        std::ranges::for_each(cell.probe, to_row);
    }
    body.joined.assign(body.faces.faces.size(), 0);
    body.inflows.resize(body.faces.faces.size());
    body.has_faces = true;
}

void forget_joints(BodyJoints& body)
{
    std::ranges::fill(body.joined, 0);
    std::ranges::fill(body.inflows, JointInflow{});
}

// Continues the joints of a checkpoint.
void recall_joints(const Seepage& seepage, int b, BodyJoints& body)
{
    for (std::size_t k = 0; k < seepage.joined.size(); ++k) {
        const auto [of, face] = seepage.joined[k];
        if (of == b && at(face) < body.joined.size()) {
            body.joined[at(face)] = 1;
            body.inflows[at(face)] = {.known = true,
                                      .opening = seepage.opening[k],
                                      .pressure = seepage.pressure[k],
                                      .drop = seepage.inertia[k]};
        }
    }
}

// A joint begins when the faces touch, since particles between them keep them apart. It lasts while
// any cell lies opposite another solid. Returns whether the body has a joint.
bool keep_joined(BodyJoints& body, bool opposite, double spacing)
{
    constexpr double touching = 0.25; // spacings
    if (!opposite) {
        forget_joints(body);
        return false;
    }
    bool any = false;
    for (std::size_t f = 0; f < body.joined.size(); ++f) {
        const JointFace& face = body.faces.faces[f];
        const std::span nodes =
            std::span(body.nodes).subspan(at(face.first), at(face.last - face.first));
        double least = infinity;
        for (const JointNode& node : nodes) {
            least = std::min(least, node.other != JointNode::none ? node.gap : infinity);
        }
        const bool lasts = body.joined[f] != 0 && least < infinity;
        body.joined[f] = lasts || least < touching * spacing ? 1 : 0;
        if (body.joined[f] == 0) {
            body.inflows[f] = {};
        }
        for (JointNode& node : nodes) {
            node.other = body.joined[f] != 0 ? node.other : JointNode::none;
        }
        any = any || body.joined[f] != 0;
    }
    return any;
}

// The velocity of points of one body.
class PointSpeed {
public:
    PointSpeed(const Rigid& rigid, const std::vector<Pose>& poses, int b)
        : body_(b), velocity_(rigid.bodies[at(b)].velocity),
          spin_(angular_velocity(rigid.bodies[at(b)])), centre_(poses[at(b)].position)
    {
    }

    int body() const { return body_; }
    Vec3 operator()(const Vec3& place) const { return velocity_ + spin_.cross(place - centre_); }

private:
    int body_;
    Vec3 velocity_, spin_, centre_;
};

// Sets the speed at which the faces separate, and the (reduced) mass that moves.
void find_speeds(BodyJoints& joints, const Rigid& rigid, const std::vector<Pose>& poses, int b,
                 double time)
{
    const PointSpeed own(rigid, poses, b);
    PointSpeed its = own; // of the body opposite the last node
    for (JointNode& node : joints.nodes) {
        if (node.other == JointNode::none) {
            continue;
        }
        Vec3 other;
        node.mass = rigid.bodies[at(b)].mass.mass;
        if (node.other >= 0) {
            its = node.other == its.body() ? its : PointSpeed(rigid, poses, node.other);
            other = its(node.place);
            const double mass = rigid.bodies[at(node.other)].mass.mass;
            node.mass *= mass / (node.mass + mass);
        } else {
            other = velocity(rigid.boundaries[at(-1 - node.other)].motion, time);
        }
        node.opening = (other - own(node.place)).dot(node.normal);
    }
}

void record_loads(const BodyJoints& body, std::vector<JointLoad>& loads)
{
    for (std::size_t c = 0; c < body.nodes.size(); ++c) {
        const JointNode& node = body.nodes[c];
        if (node.other != JointNode::none) {
            const double push = node.carried * body.faces.cells[c].area;
            loads.push_back({node.other, node.place, -push * node.normal, node.pressure, node.gap});
        }
    }
}

// Divides the film force of a particle behind two joints of a thin body between them by pressure,
// so that it is removed only once: a body on top must not feel the film below its support.
void share_between_opposite_faces(std::span<FilmCut> cuts)
{
    constexpr double opposite = -0.9; // cosine
    for (std::size_t k = 0; k < cuts.size(); ++k) {
        for (std::size_t m = k + 1; m < cuts.size() && cuts[m].row == cuts[k].row; ++m) {
            FilmCut& a = cuts[k];
            FilmCut& b = cuts[m];
            if (a.normal.dot(b.normal) < opposite && a.part + b.part > 1) {
                const real sum = a.pressure + b.pressure;
                a.part *= sum > 0 ? a.pressure / sum : 0;
                b.part *= sum > 0 ? b.pressure / sum : 0;
            }
        }
    }
}

// The first row of the particles of a body, and the numbers of all rows.
struct ParticleNumbers {
    Index first = 0;
    std::span<const std::int64_t> id;
};

// Lists for each particle behind a joint, or beside it where nothing lies opposite, the part of its
// film force that the joint replaces.
void cut_films(const BodyJoints& body, const ParticleNumbers& numbers, double support,
               std::vector<FilmCut>& cuts)
{
    const auto begin = static_cast<std::ptrdiff_t>(cuts.size());
    for (std::size_t f = 0; f < body.faces.faces.size(); ++f) {
        if (body.joined[f] == 0) {
            continue;
        }
        const JointFace& face = body.faces.faces[f];
        const std::vector<int> joint = films_of(body, face, support);
        for (int c = face.first; c < face.last; ++c) {
            if (joint[at(c - face.first)] < 0) {
                continue;
            }
            const JointNode& node = body.nodes[at(joint[at(c - face.first)])];
            const JointCell& cell = body.faces.cells[at(c)];
            for (int k = cell.first; k < cell.last; ++k) {
                cuts.push_back({.row = numbers.first + body.faces.particles[at(k)],
                                .face = cell.face,
                                .other = node.other,
                                .beside = joint[at(c - face.first)] != c,
                                .part = 1 - node.film,
                                .pressure = node.pressure,
                                .normal = node.normal});
            }
        }
    }
    // If a particle is behind several cells of a face, the largest part counts. Sorted by number,
    // so that the sums do not depend on the order of the rows.
    const auto by_particle = [&](const FilmCut& a, const FilmCut& b) {
        return std::tuple(numbers.id[at(a.row)], a.face, -a.part) <
               std::tuple(numbers.id[at(b.row)], b.face, -b.part);
    };
    const auto same = [](const FilmCut& a, const FilmCut& b) {
        return a.row == b.row && a.face == b.face;
    };
    std::stable_sort(cuts.begin() + begin, cuts.end(), by_particle);
    cuts.erase(std::unique(cuts.begin() + begin, cuts.end(), same), cuts.end());
    share_between_opposite_faces(std::span(cuts).subspan(static_cast<std::size_t>(begin)));
}

// Records the state of the joints for a restart.
void take_note_of_joints(Seepage& seepage)
{
    seepage.joined.clear();
    seepage.opening.clear();
    seepage.pressure.clear();
    seepage.inertia.clear();
    const std::vector<BodyJoints>& bodies = seepage.tables->bodies;
    for (std::size_t b = 0; b < bodies.size(); ++b) {
        for (std::size_t f = 0; f < bodies[b].joined.size(); ++f) {
            if (bodies[b].joined[f] != 0) {
                seepage.joined.push_back({static_cast<int>(b), static_cast<int>(f)});
                seepage.opening.push_back(bodies[b].inflows[f].opening);
                seepage.pressure.push_back(bodies[b].inflows[f].pressure);
                seepage.inertia.push_back(bodies[b].inflows[f].drop);
            }
        }
    }
}

} // namespace

Seepage::Seepage() = default;
Seepage::~Seepage() = default;
Seepage::Seepage(Seepage&&) noexcept = default;
Seepage& Seepage::operator=(Seepage&&) noexcept = default;

void restart_joints(Seepage& seepage)
{
    const auto bodies = static_cast<int>(seepage.open.size());
    const auto is_of_case = [&](const std::array<int, 2>& joint) {
        return joint[0] >= 0 && joint[0] < bodies && joint[1] >= 0;
    };
    seepage.tables.reset();
    const std::size_t joints = seepage.joined.size();
    if (seepage.opening.size() != joints || seepage.pressure.size() != joints ||
        seepage.inertia.size() != joints) {
        throw IoError(
            "the columns of the joints in the checkpoint differ in length: it is damaged");
    }
    if (!std::ranges::all_of(seepage.joined, is_of_case)) {
        throw IoError("the checkpoint has joints of other bodies: it belongs to another case");
    }
}

void update_joints(Seepage& seepage, const Rigid& rigid, const std::vector<Pose>& poses,
                   const BodyParticles& bodies, const JointTime& step, Fluid& fluid)
{
    if (!seepage.tables) {
        seepage.tables =
            std::make_unique<JointTables>(joint_tables(rigid, widest * fluid.parameters.spacing));
        seepage.tables->sums = lattice_sums(fluid);
        seepage.loads.resize(rigid.bodies.size());
    }
    JointTables& tables = *seepage.tables;
    find_near(tables, rigid, poses, step.time);
    if (std::ranges::any_of(tables.bodies, [](const BodyJoints& b) { return !b.near.empty(); })) {
        replicate_body_pressures(fluid);
    }
    ParticlePressure pressure = pressure_of(fluid);
    pressure.dt = step.dt;
    pressure.dt_before = step.before;
    const KindOfJoint joins(seepage, tables, poses, fluid.parameters.gravity);
    parallel_blocks(
        0, static_cast<Index>(poses.size()),
        [&](Index b) {
            BodyJoints& body = tables.bodies[at(b)];
            seepage.loads[at(b)].clear();
            if (body.near.empty()) {
                forget_joints(body);
                return;
            }
            const Rows rows = bodies.of[at(b)];
            if (!body.has_faces) {
                make_faces(body, rigid.bodies[at(b)],
                           std::span(bodies.points).subspan(at(rows.begin), at(rows.size())),
                           rows.begin, fluid, fluid.body_particle_mass[at(b)]);
                recall_joints(seepage, static_cast<int>(b), body);
            }
            const bool opposite = find_gaps(tables, poses, static_cast<int>(b), joins);
            if (keep_joined(body, opposite, fluid.parameters.spacing)) {
                find_speeds(body, rigid, poses, static_cast<int>(b), step.time);
                ParticlePressure own = pressure;
                own.first = at(rows.begin);
                solve_pressure(tables, rigid, poses, static_cast<int>(b), own);
                carry_on_support(tables, poses, static_cast<int>(b), own.spacing);
                record_loads(body, seepage.loads[at(b)]);
            }
        },
        2);
    take_note_of_joints(seepage);
    fluid.film_cuts.clear();
    for (std::size_t b = 0; b < poses.size(); ++b) {
        if (!seepage.loads[b].empty()) {
            cut_films(tables.bodies[b],
                      {bodies.of[b].begin, std::as_const(fluid.particles).body.id()},
                      fluid.kernel.support, fluid.film_cuts);
        }
    }
}

void cut_slip_of_films(Seepage& seepage, const std::vector<Pose>& poses, Fluid& fluid)
{
    if (seepage.tables) {
        cut_slip_of_films(*seepage.tables, poses, fluid);
    }
}

void add_joint_loads(const Seepage& seepage, const std::vector<Pose>& poses,
                     std::vector<Wrench>& bodies, std::span<Vec3> walls)
{
    const auto add = [&](int solid, const Vec3& force, const Vec3& point) {
        if (solid >= 0) {
            bodies[at(solid)].force += force;
            bodies[at(solid)].torque += (point - poses[at(solid)].position).cross(force);
        } else {
            walls[at(-1 - solid)] += force;
        }
    };
    for (std::size_t b = 0; b < seepage.loads.size(); ++b) {
        for (const JointLoad& load : seepage.loads[b]) {
            add(static_cast<int>(b), load.force, load.point);
            add(load.other, -load.force, load.point);
        }
    }
}

void return_film_cuts(const Fluid& fluid, const std::vector<Pose>& poses, OwnerSums<6>& bodies,
                      OwnerSums<3>& walls)
{
    const auto x = fluid.particles.body[field::position];
    for (const FilmCut& cut : fluid.film_cuts) {
        const Vec3& f = cut.removed;
        if (cut.other >= 0) {
            const Vec3 torque = (x[cut.row] - poses[at(cut.other)].position).cross(f);
            bodies.add(at(cut.other), {f.x(), f.y(), f.z(), torque.x(), torque.y(), torque.z()});
        } else {
            walls.add(at(-1 - cut.other), {f.x(), f.y(), f.z()});
        }
    }
}

} // namespace hyoryu
