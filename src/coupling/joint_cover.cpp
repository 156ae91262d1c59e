// SPDX-License-Identifier: MIT
#include "joint_cover.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace hyoryu {

namespace {

// The cells of one face, with the support beyond their edges.
class Cover {
public:
    Cover(JointTables& tables, const std::vector<Pose>& poses, int b, const JointFace& face,
          double spacing)
        : tables_(tables), poses_(poses), b_(b), face_(face), spacing_(spacing),
          body_(tables.bodies[at(b)])
    {
    }

    double share(int c) const
    {
        double along_u = 1;
        double along_v = 1;
        const int edges = face_.v == Vec3(0, 0, 0) ? 2 : 4;
        for (int edge = 0; edge < edges; ++edge) {
            double& along = edge < 2 ? along_u : along_v;
            along += beyond(c, edge);
        }
        return std::max(along_u, 0.0) * std::max(along_v, 0.0);
    }

private:
    bool joined(int c) const { return c >= 0 && body_.nodes[at(c)].other != JointNode::none; }
    double size(int edge) const { return edge < 2 ? face_.du : face_.dv; }

    // What the edge adds to the area of a cell, as a share of it.
    double beyond(int c, int edge) const
    {
        const int next = body_.faces.cells[at(c)].next[at(edge)];
        if (joined(next)) {
            return 0;
        }
        if (next >= 0) {
            const double end = end_of_support(c, edge, size(edge));
            const double rim = distance_to_rim(next, edge) - (end - size(edge) / 2);
            return (end - size(edge) / 2 - pushed(rim)) / size(edge);
        }
        const double rim = size(edge) / 2;
        const double end = end_of_support(c, edge, rim);
        const double open = end < rim ? pushed(rim - end) : pushed_past_ledge(c, edge);
        return (end - rim - open) / size(edge);
    }

    // Over what length the fluid beyond a rim pushes the body across it [m].
    double pushed(double apart) const
    {
        return spacing_ * tables_.sums.across_edge(apart / spacing_);
    }

    // From the near edge of a cell to the rim of the face, as far as it matters [m].
    double distance_to_rim(int c, int edge) const
    {
        double way = 0;
        for (; c >= 0 && way < 2 * spacing_; c = body_.faces.cells[at(c)].next[at(edge)]) {
            way += size(edge);
        }
        return way;
    }

    Vec3 outward(int edge) const
    {
        return poses_[at(b_)].orientation *
               ((edge % 2 == 0 ? -1 : 1) * (edge < 2 ? face_.u : face_.v));
    }

    // How far from the middle of a joined cell its support ends, at most `most` [m].
    double end_of_support(int c, int edge, double most) const
    {
        constexpr int halvings = 5; // to a thirtieth of a cell
        const JointNode& node = body_.nodes[at(c)];
        const Vec3 out = outward(edge);
        const auto supported = [&](double way) {
            return facing(tables_, poses_, b_, {node.place + way * out, node.normal}).other ==
                   node.other;
        };
        if (supported(most)) {
            return most;
        }
        double from = 0;
        double to = most;
        for (int k = 0; k < halvings; ++k) {
            const double middle = (from + to) / 2;
            (supported(middle) ? from : to) = middle;
        }
        return (from + to) / 2;
    }

    // `pushed` where the support goes on beyond the rim of the face, by strips of that ledge. Half
    // a spacing below the face the first row of fluid on it pushes as beside a flush seam.
    double pushed_past_ledge(int c, int edge) const
    {
        constexpr std::array ends{0.0, 0.25, 0.75, 2.0}; // spacings
        const JointNode& node = body_.nodes[at(c)];
        const Vec3 out = outward(edge);
        const RayPart part{-tables_.reach, spacing_ / 2};
        double length = 0;
        for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
            const double middle = size(edge) / 2 + (ends[k] + ends[k + 1]) / 2 * spacing_;
            // From half a spacing below the face: solids that end at it are not met.
            const Vec3 place = node.place + middle * out + spacing_ / 2 * node.normal;
            const double gap =
                own_body(place)
                    ? 0
                    : 0.5 + first_other(tables_, poses_, b_, {place, node.normal}, part).hit.enter /
                                spacing_;
            length += std::clamp(2 * gap, 0.0, 1.0) *
                      (pushed(ends[k] * spacing_) - pushed(ends[k + 1] * spacing_));
        }
        return length;
    }

    // Whether another part of the body is there.
    bool own_body(const Vec3& place) const
    {
        const RaySolid& solid = tables_.solids[at(b_)];
        const Pose& pose = poses_[at(b_)];
        return solid.pieces.size() > 1 &&
               distance(solid, pose.orientation.conjugate() * (place - pose.position)) < 0;
    }

    JointTables& tables_;
    const std::vector<Pose>& poses_;
    int b_;
    const JointFace& face_;
    double spacing_; // [m]
    const BodyJoints& body_;
};

} // namespace

void carry_on_support(JointTables& tables, const std::vector<Pose>& poses, int b, double spacing)
{
    BodyJoints& body = tables.bodies[at(b)];
    for (const JointFace& face : body.faces.faces) {
        const Cover cover(tables, poses, b, face, spacing);
        for (int c = face.first; c < face.last; ++c) {
            JointNode& node = body.nodes[at(c)];
            if (node.other != JointNode::none && node.weight * node.lacking > 0) {
                node.carried = cover.share(c) * node.weight * node.lacking;
            }
        }
    }
}

std::vector<int> films_of(const BodyJoints& body, const JointFace& face, double support)
{
    const int cells = face.last - face.first;
    std::vector<int> of(at(cells), -1);
    int joined = 0;
    for (int c = 0; c < cells; ++c) {
        if (body.nodes[at(face.first + c)].other != JointNode::none) {
            of[at(c)] = face.first + c;
            ++joined;
        }
    }
    if (joined == 0 || joined == cells) {
        return of;
    }
    const double step = face.v == Vec3(0, 0, 0) ? face.du : std::min(face.du, face.dv);
    const int rounds = static_cast<int>(std::ceil(support / step));
    for (int round = 0; round < rounds; ++round) {
        std::vector<int> grown = of;
        for (int c = 0; c < cells; ++c) {
            if (of[at(c)] >= 0 || !body.nodes[at(face.first + c)].open) {
                continue;
            }
            for (const int next : body.faces.cells[at(face.first + c)].next) {
                if (next >= 0 && of[at(next - face.first)] >= 0) {
                    grown[at(c)] = of[at(next - face.first)];
                }
            }
        }
        of = std::move(grown);
    }
    return of;
}

} // namespace hyoryu
