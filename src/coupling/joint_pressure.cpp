// SPDX-License-Identifier: MIT
// Seepage through a gap of uniform width: div grad (p - rho0 g . x) = 0 within the joint, with the
// pressure of the fluid at rims and where fluid particles lie between the faces, and no flow
// through rims that another solid closes. Finite volumes on the cells of a face; p >= 0 by
// projection, since the joint bears no tension (successive over-relaxation with projection: Cryer
// 1971).
#include "joint_pressure.hpp"

#include "joint_line.hpp"
#include "joint_mobility.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace hyoryu {

namespace {

// Sweeps end when the largest change is below this part of the largest pressure: round-off in two
// dimensions, where sweeps are cheap and mirrored scenes must stay symmetric; a looser value in
// space.
constexpr int most_sweeps = 2000;
constexpr double settled_flat = 1e-14;
constexpr double settled_in_space = 1e-8;

// A gap beside a rim narrower than this holds too few columns of particles for a reliable pressure
// (measured: up to three spacings of water too much at its bottom).
constexpr double widest_gap = 4; // spacings

// The share of its conductance that a rim keeps beside a gap of the given width in spacings. If the
// joint also has a rim in open water, that rim dominates; a joint between two gaps still fills.
double through_gap(double gap)
{
    constexpr double narrow = 3;
    constexpr double least = 1e-3; // small against a joint of a hundred cells in a row
    return std::pow(least, std::clamp((widest_gap - gap) / (widest_gap - narrow), 0.0, 1.0));
}

// Fluid particles between the two faces.
struct Filled {
    double taken = 0;    // share of the film forces that is kept, 0 to 1
    double pushes = 0;   // share of their pressure that they and these films transmit
    double pressure = 0; // of these particles, at the centre of the cell [Pa]
    double trapped = 0;  // share of a gap too narrow for a row of them that they fill, 0 to 1
};

// The joint of one face.
class FaceJoint {
public:
    FaceJoint(JointTables& tables, const Rigid& rigid, const std::vector<Pose>& poses, int b,
              const JointFace& face, const ParticlePressure& fluid)
        : tables_(tables), rigid_(rigid), poses_(poses), b_(b), face_(face), fluid_(fluid),
          body_(tables.bodies[at(b)]), edges_(face.v == Vec3(0, 0, 0) ? 2 : 4)
    {
    }

    void solve()
    {
        const Index cells = face_.last - face_.first;
        inside_.assign(at(cells), Filled{});
        ways_.assign(at(4 * cells), JointWay{});
        pressure_.assign(at(cells), 0);
        bool open = false;
        for (int c = face_.first; c < face_.last; ++c) {
            if (joined(c)) {
                open = find_ways(c) || open;
            }
        }
        for (int c = face_.first; c < face_.last; ++c) {
            if (joined(c)) {
                look_inside(c);
            }
        }
        if (!open && !has_rim()) { // closed on all sides: its film forces act unchanged
            body_.inflows[at(cell(face_.first).face)] = {};
            for (int c = face_.first; c < face_.last; ++c) {
                node(c).other = JointNode::none;
            }
            return;
        }
        if (open) { // a dry joint keeps the pressure 0, and its film forces are removed
            start();
            relax();
        }
        const double drop = inflow_drop(spread(measure_inflow()));
        for (int c = face_.first; c < face_.last; ++c) {
            if (joined(c)) {
                hand_over(c, drop);
            }
        }
    }

private:
    const JointCell& cell(int c) const { return body_.faces.cells[at(c)]; }
    JointNode& node(int c) { return body_.nodes[at(c)]; }
    bool joined(int c) { return c >= 0 && node(c).other != JointNode::none; }
    JointWay& way(int c, int edge) { return ways_[at(4 * (c - face_.first) + edge)]; }
    Filled& inside(int c) { return inside_[at(c - face_.first)]; }

    double conductance(int edge) const
    {
        return edge < 2 ? face_.dv / face_.du : face_.du / face_.dv;
    }

    // Sets the flow paths of a cell to its neighbours and rims; returns whether water enters
    // through a rim.
    bool find_ways(int c)
    {
        bool open = false;
        for (int edge = 0; edge < edges_; ++edge) {
            const int next = cell(c).next[at(edge)];
            if (joined(next) && node(next).sealed != node(c).sealed) {
                way(c, edge) = {};
            } else if (joined(next)) {
                const double rise = fluid_.weight.dot(node(c).place - node(next).place);
                way(c, edge) = {conductance(edge), 0, 0, next - face_.first, rise};
            } else {
                way(c, edge) = rim(c, edge);
                open = open || way(c, edge).enters > 0;
            }
        }
        return open;
    }

    // Whether any cell has a rim that no other solid closes.
    bool has_rim()
    {
        for (int c = face_.first; c < face_.last; ++c) {
            for (int edge = 0; edge < edges_; ++edge) {
                if (way(c, edge).conductance > 0 && way(c, edge).next < 0) {
                    return true;
                }
            }
        }
        return false;
    }

    // Evaluates the fluid particles between the faces; they fit from a gap of half a spacing on. A
    // cell may lie between two columns of particles of the body: then it takes the nearest ones.
    void look_inside(int c)
    {
        double wet = 0;
        double pressure = 0;
        const auto add = [&](int particle) {
            const std::size_t row = fluid_.first + at(particle);
            wet += fluid_.shepard[row];
            pressure += fluid_.shepard[row] * pressure_at(row, node(c).place);
        };
        int outer = cell(c).inner - cell(c).first;
        if (outer > 0) {
            const auto own = std::span(body_.faces.particles).subspan(at(cell(c).first), at(outer));
            std::ranges::for_each(own, add);
        } else if (cell(c).probe[0] >= 0) {
            outer = edges_;
            std::ranges::for_each(std::span(cell(c).probe).first(at(edges_)), add);
        }
        const double width = node(c).gap / fluid_.spacing;
        const auto [fluid, row] = beyond_rims(c, width);
        const double between = std::max(wet / std::max(outer, 1) - fluid, 0.0);
        // Under a face of one cell the corners beyond its rims count twice.
        constexpr double least = 0.2; // part of the row within a face one spacing long and wide
        const double full = tables_.sums.row(widest(c));
        const double rows = between / std::max(full - row, least * full);
        inside(c) = {std::min(rows, 1.0) * std::clamp(2 * width - 1, 0.0, 1.0),
                     std::min(rows, 1.0) * tables_.sums.transmitted(width),
                     wet > 0 ? pressure / wet : 0,
                     width < 1 ? std::min(rows / std::max(width, 1e-3), 1.0) : 0};
    }

    // The parts beyond the rims of the sums at a cell: of the fluid there, and of a row between the
    // faces if it went on [1/m^d].
    std::pair<double, double> beyond_rims(int c, double width)
    {
        const LatticeSums& sums = tables_.sums;
        double fluid = 0;
        double row = 0;
        for (int edge = 0; edge < edges_; ++edge) {
            const double size = (edge < 2 ? face_.du : face_.dv) / fluid_.spacing;
            int k = c;
            double inside = size / 2;
            for (; joined(cell(k).next[at(edge)]) && inside < 3; inside += size) {
                k = cell(k).next[at(edge)];
            }
            if (cell(k).next[at(edge)] >= 0) {
                continue; // the face goes on, and with it the row
            }
            fluid += way(k, edge).enters * LatticeSums::beyond(sums.fluid_beyond, inside, width);
            row += LatticeSums::beyond(sums.row_beyond, inside, width);
        }
        return {fluid, row};
    }

    // The width of the gap at a cell and at those beside it [spacings]: in a wedge the particles
    // are where it is wide.
    double widest(int c)
    {
        double gap = node(c).gap;
        for (int edge = 0; edge < edges_; ++edge) {
            const int next = cell(c).next[at(edge)];
            gap = joined(next) ? std::max(gap, node(next).gap) : gap;
        }
        return gap / fluid_.spacing;
    }

    // Whether the particles at a cell are farther than the support from every open rim.
    bool sheltered(int c)
    {
        for (int edge = 0; edge < edges_; ++edge) {
            const double size = edge < 2 ? face_.du : face_.dv;
            int k = c;
            for (double seen = 0; seen < fluid_.support; seen += size) {
                const int next = cell(k).next[at(edge)];
                if (!joined(next)) {
                    if (way(k, edge).conductance > 0) {
                        return false;
                    }
                    break;
                }
                k = next;
            }
        }
        return true;
    }

    // The flow path through a rim, to water or air; none if a solid nearer than a spacing closes
    // the rim. No water enters a sealed joint.
    JointWay rim(int c, int edge)
    {
        const Pose& pose = poses_[at(b_)];
        const Vec3 place = pose.position + pose.orientation * cell(c).rim[at(edge)];
        const Vec3 outward =
            pose.orientation * ((edge % 2 == 0 ? -1 : 1) * (edge < 2 ? face_.u : face_.v));
        const Ray ray{place - 0.5 * fluid_.spacing * node(c).normal, outward};
        const double room = 0.9; // least width for a particle
        const RayPart part{-overlap_of(tables_), widest_gap * fluid_.spacing};
        const double gap = first_other(tables_, poses_, b_, ray, part).hit.enter / fluid_.spacing;
        if (gap < room) {
            return {};
        }
        JointWay way{2 * through_gap(gap) * conductance(edge), 0, 0};
        if (node(c).sealed) {
            return way;
        }
        // If the face extends beyond its support, the water lies below the next cell. Beside the
        // support half of a row of particles is missing there, and more because of gaps in the
        // lattice: a quarter of the row counts as water.
        const int next = cell(c).next[at(edge)];
        const int probe = cell(next >= 0 ? next : c).probe[at(edge)];
        if (probe >= 0) {
            const std::size_t row = fluid_.first + at(probe);
            const LatticeSums& sums = tables_.sums;
            const double dry = next >= 0 ? sums.under : sums.below;
            const double enough = next >= 0 ? dry + sums.first / 4 : sums.rim / 2;
            const double wet = std::clamp((fluid_.shepard[row] - dry) / (enough - dry), 0.0, 1.0);
            way.pressure = wet * pressure_at(row, place);
            way.enters = wet;
        }
        way.pressure += fluid_.weight.dot(node(c).place - place);
        return way;
    }

    // The pressure that a solid particle extrapolated, moved to a place.
    double pressure_at(std::size_t row, const Vec3& place) const
    {
        return std::max(fluid_.p[row] + fluid_.weight.dot(place - fluid_.x[row]), 0.0);
    }

    // Starts from the hydrostatic pressure of the mean head at the rims through which water enters.
    void start()
    {
        double head = 0;
        double weight = 0;
        const auto add = [&](int c, const JointWay& w) {
            const double share = w.enters * w.conductance; // none of ways to other cells
            head += share * (w.pressure - fluid_.weight.dot(node(c).place));
            weight += share;
        };
        for (int c = face_.first; c < face_.last; ++c) {
            for (int edge = 0; edge < edges_; ++edge) {
                add(c, way(c, edge));
            }
        }
        // A pressure that is zero up to rounding counts as air in every frame of reference.
        const double least = 1e-9 * fluid_.weight.norm() * fluid_.spacing;
        for (int c = face_.first; c < face_.last; ++c) {
            const double p = weight > 0 ? head / weight + fluid_.weight.dot(node(c).place) : 0.0;
            pressure_[at(c - face_.first)] = joined(c) && p > least ? p : 0;
        }
    }

    Inflow measure_inflow()
    {
        Inflow in;
        for (int c = face_.first; c < face_.last; ++c) {
            if (!joined(c)) {
                continue;
            }
            const double area = cell(c).area;
            in.opening += area * node(c).opening;
            in.area += area;
            in.push += area * pressure_[at(c - face_.first)];
            in.mass = std::min(in.mass, node(c).mass);
            for (int edge = 0; edge < edges_; ++edge) {
                const double side = edge < 2 ? face_.dv : face_.du;
                const double length = way(c, edge).enters * side;
                in.open += way(c, edge).next < 0 && way(c, edge).conductance > 0 ? side : 0;
                in.rim += length;
                in.section += length * std::max(node(c).gap, fluid_.spacing);
            }
        }
        in.opening /= in.area;
        return in;
    }

    // A jump of the pressure at the rims spreads in the joint by sound.
    Inflow spread(Inflow in)
    {
        const JointInflow& last = body_.inflows[at(cell(face_.first).face)];
        if (last.known && in.open > 0) {
            const double push = spread_by_sound(last.pressure * in.area, in.push,
                                                fluid_.dt * 2 * fluid_.sound * in.open / in.area);
            if (push < in.push) {
                std::ranges::for_each(pressure_, [&](double& p) { p *= push / in.push; });
                in.push = push;
            }
        }
        return in;
    }

    // The pressure that accelerates the water that enters through the rim while the sides part. The
    // growth of the flow is that of the last step and what the change of the pressure since adds.
    // Slow growth is left to the weight of the water outside: a wide crate in rising water would
    // otherwise lift later by a good part of a spacing.
    double inflow_drop(const Inflow& in)
    {
        constexpr double slow = 0.02; // accelerations of gravity
        JointInflow& joint = body_.inflows[at(cell(face_.first).face)];
        const JointInflow last = std::exchange(
            joint, {.known = true, .opening = in.opening, .pressure = in.push / in.area});
        if (!(in.opening > 0) || !(in.section > 0)) {
            return 0;
        }
        const JointResponse response{joint_inertance(fluid_.density, in.area / in.rim, in.section),
                                     joint_mobility(body_, rigid_, poses_, b_, face_)};
        // A speed at most doubles in a step: what is at rest up to rounding draws no water.
        const double most = in.area * in.opening / fluid_.dt;
        double growth = 0;
        if (last.known && fluid_.dt_before > 0) {
            growth = in.area * (in.opening - last.opening) / fluid_.dt_before +
                     response.mobility * (joint.pressure - last.pressure);
            growth = std::min(growth, most);
        }
        const double fast = growth - slow * in.area * fluid_.weight.norm() / fluid_.density;
        joint.drop = inertia_drop(last.drop, response, fast,
                                  std::min(joint.pressure, response.inertance * most));
        return bernoulli_drop(in, fluid_.density, growth, fluid_.dt) + joint.drop;
    }

    // The joint adds the pressure that the particles in it do not transmit yet: the first particles
    // in an opening gap have no pressure. From two spacings on only the particles act. Water
    // trapped between closing faces at more than the seepage pressure keeps them apart, as it did
    // before they were near enough for a joint. In a gap of width w it fills w/dp of a row.
    void hand_over(int c, double drop)
    {
        JointNode& n = node(c);
        n.pressure = std::max(pressure_[at(c - face_.first)] - drop, 0.0);
        const Filled& in = inside(c);
        const bool trapped = in.trapped * in.pressure > n.pressure && sheltered(c);
        const double taken = trapped ? std::max(in.taken, in.trapped) : in.taken;
        const double pushes = trapped ? std::max(in.pushes, in.trapped) : in.pushes;
        n.weight = std::clamp(4 - 2 * n.gap / fluid_.spacing, 0.0, 1.0);
        n.film = 1 - n.weight * (1 - taken);
        n.lacking = std::max(n.pressure - pushes * in.pressure, 0.0);
    }

    void relax()
    {
        const JointWays ways{ways_, edges_};
        if (edges_ == 2 && solve_line(ways, pressure_)) {
            return;
        }
        const double along = std::sqrt(static_cast<double>(face_.last - face_.first));
        const double n = edges_ == 2 ? sq(along) : along;
        const double omega = 2 / (1 + std::sin(std::numbers::pi / (n + 1)));
        const double settled = edges_ == 2 ? settled_flat : settled_in_space;
        std::vector<int> cells;
        for (int c = face_.first; c < face_.last; ++c) {
            if (joined(c)) {
                cells.push_back(c - face_.first);
            }
        }
        for (int sweep = 0; sweep < most_sweeps; ++sweep) {
            double change = 0;
            double largest = 0;
            for (const int c : cells) {
                const double before = pressure_[at(c)];
                const double now =
                    std::max(before + omega * (balanced(ways, pressure_, c) - before), 0.0);
                pressure_[at(c)] = now;
                change = std::max(change, std::abs(now - before));
                largest = std::max(largest, now);
            }
            if (change <= settled * largest) {
                return;
            }
        }
    }

    JointTables& tables_;
    const Rigid& rigid_;
    const std::vector<Pose>& poses_;
    int b_;
    const JointFace& face_;
    const ParticlePressure& fluid_;
    BodyJoints& body_;
    int edges_;
    std::vector<Filled> inside_;   // by cell
    std::vector<JointWay> ways_;   // by cell and edge
    std::vector<double> pressure_; // by cell [Pa]
};

} // namespace

void solve_pressure(JointTables& tables, const Rigid& rigid, const std::vector<Pose>& poses, int b,
                    const ParticlePressure& fluid)
{
    for (const JointFace& face : tables.bodies[at(b)].faces.faces) {
        FaceJoint(tables, rigid, poses, b, face, fluid).solve();
    }
}

} // namespace hyoryu
