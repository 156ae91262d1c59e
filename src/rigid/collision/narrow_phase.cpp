// SPDX-License-Identifier: MIT
#include "narrow_phase.hpp"
#include "covered.hpp"
#include "manifold.hpp"
#include "mesh_contact.hpp"
#include "rigid/shapes/compound.hpp"
#include "rod_contact.hpp"
#include "rod_touch.hpp"
#include "separation.hpp"

#include <algorithm>

namespace hyoryu {

namespace {

void add(const Feature& feature, const Configuration& at, std::vector<Candidate>& found)
{
    found.push_back({feature, touch_of(feature, at)});
}

void on_plane(const BodyPair& pair, const Configuration& at, std::vector<Candidate>& found)
{
    const Solid& solid = at.geometry.solids[pair.a];
    Feature feature{pair.a, pair.b};
    if (solid.form == Form::ball) {
        feature.kind = FeatureKind::ball_plane;
        add(feature, at, found);
    } else if (solid.form == Form::rod) {
        const Vec3& normal = at.geometry.walls[-1 - pair.b].plane->normal;
        for_low_features(feature, solid, at.poses[pair.a].R.col(0).dot(normal),
                         [&](const Feature& low) { add(low, at, found); });
    } else {
        for (const int corner : solid.extremes) {
            feature.i = corner;
            add(feature, at, found);
        }
    }
}

bool on_plane(const BodyPair& pair, const Geometry& geometry)
{
    return pair.b < 0 && geometry.walls[-1 - pair.b].plane;
}

bool on_mesh(const BodyPair& pair, const Geometry& geometry)
{
    return pair.b < 0 && !geometry.walls[-1 - pair.b].mesh.triangles.empty();
}

Form form_of(int index, const Geometry& geometry)
{
    return index >= 0 ? geometry.solids[index].form : geometry.walls[-1 - index].solid.form;
}

// Lower bound on the distance of two parts: bounding sphere of one from bounding box of the other.
double apart_at_least(const PartPair& parts)
{
    const auto apart = [&](const PlacedSolid& box, const PlacedSolid& ball) {
        const Vec3 centre = ball.pose.x + ball.pose.R * ball.solid.box_centre - box.pose.x;
        const Vec3 p = box.pose.R.transpose() * centre - box.solid.box_centre;
        const Vec3 out = (p.cwiseAbs() - box.solid.box_half).cwiseMax(0);
        return out.norm() - ball.solid.box_half.norm();
    };
    return std::max(apart(parts.b, parts.a), apart(parts.a, parts.b));
}

// Calls visit(parts) for all pairs of convex parts that may be nearer than `near`; returns a lower
// bound on the distance of the others.
double for_each_part_pair(const BodyPair& pair, const Configuration& at, double near,
                          const auto& visit)
{
    const PlacedSolid a = placed(at, pair.a);
    const PlacedSolid b = placed(at, pair.b);
    const double between = (a.pose.x - b.pose.x).norm() - a.solid.reach - b.solid.reach;
    if (between > near) {
        return between;
    }
    double others = infinity;
    for (const Solid& part_a : convex_parts(a.solid)) {
        for (const Solid& part_b : convex_parts(b.solid)) {
            const PartPair parts{{part_a, a.pose}, {part_b, b.pose}};
            const double apart = apart_at_least(parts);
            if (apart <= near) {
                visit(parts);
            } else {
                others = std::min(others, apart);
            }
        }
    }
    return others;
}

// Whether the face or edges that define the contact normal belong to the surface of the compound at
// the contact point.
bool is_open(const Candidate& c, const Separation& axis, const PartPair& parts,
             const Configuration& at)
{
    const Feature& f = c.feature;
    const auto whole = [&](int k) -> const Solid& { return placed(at, k).solid; };
    if (f.kind == FeatureKind::edge_edge) {
        return edge_is_open(whole(f.a), parts.a.solid, parts.a.solid.edges[axis.a],
                            in_frame(parts.a.pose, c.touch.point)) &&
               edge_is_open(whole(f.b), parts.b.solid, parts.b.solid.edges[axis.b],
                            in_frame(parts.b.pose, c.touch.point));
    }
    const PlacedSolid& face = f.owner == 0 ? parts.b : parts.a;
    return face_is_open(whole(f.owner == 0 ? f.b : f.a), face.solid, f.f - face.solid.first_face,
                        in_frame(face.pose, c.touch.point));
}

bool has_rod(const PartPair& parts)
{
    return parts.a.solid.form == Form::rod || parts.b.solid.form == Form::rod;
}

// Moves the candidates from `first` on that another part of a compound covers to `covered`.
void part_covered(const Separation& axis, const PartPair& parts, const Configuration& at,
                  std::size_t first, std::vector<Candidate>& found, std::vector<Candidate>& covered)
{
    const auto begin = found.begin() + static_cast<std::ptrdiff_t>(first);
    const auto closed = std::stable_partition(
        begin, found.end(), [&](const Candidate& c) { return is_open(c, axis, parts, at); });
    covered.insert(covered.end(), closed, found.end());
    found.erase(closed, found.end());
}

void between_parts(const BodyPair& pair, const Configuration& at, double near,
                   std::vector<Candidate>& found)
{
    const double depth = std::min(depth_of_cover(placed(at, pair.a).solid),
                                  depth_of_cover(placed(at, pair.b).solid));
    const std::size_t first = found.size();
    std::vector<Candidate> covered;
    for_each_part_pair(pair, at, near, [&](const PartPair& parts) {
        if (has_rod(parts)) {
            add_rod_contacts(pair, parts, at, near, found, covered);
            return;
        }
        const Separation axis = separation(parts.a, parts.b, near, at.geometry.unit);
        if (axis.distance > near) {
            return;
        }
        const std::size_t of_parts = found.size();
        add_manifold(pair, parts, axis, at, found);
        if (depth < infinity) {
            part_covered(axis, parts, at, of_parts, found, covered);
        }
    });
    add_covered(covered, depth, first, found);
}

// A ball and every convex part of the other solid. Only parts nearer than `near` are tested for
// cover by another part.
void of_ball(const BodyPair& pair, const Configuration& at, double near,
             std::vector<Candidate>& found)
{
    Feature feature{pair.a, pair.b, FeatureKind::round};
    feature.owner = form_of(pair.a, at.geometry) == Form::ball ? 0 : 1;
    const PlacedSolid other = placed(at, feature.owner == 0 ? pair.b : pair.a);
    const auto parts = convex_parts(other.solid);
    if (other.solid.form != Form::compound) {
        found.push_back({feature, touch_of(feature, at)});
        return;
    }
    for (const Solid& part : parts) {
        feature.k = 0;
        const Touch touch = touch_of(feature, at);
        if (touch.gap > near) {
            found.push_back({feature, touch});
            ++feature.f;
            continue;
        }
        const Vec3 out =
            other.pose.R.transpose() * (feature.owner == 0 ? touch.normal : Vec3(-touch.normal));
        const Vec3 point = in_frame(other.pose, touch.point);
        const int face = face_at(other.solid, part, point, out);
        feature.k = face + 1;
        if (face < 0 ? rim_is_open(other.solid, part, point)
                     : face_is_open(other.solid, part, face, point)) {
            found.push_back({feature, touch});
        }
        ++feature.f;
    }
}

} // namespace

bool has_axis(const BodyPair& pair, const Geometry& geometry)
{
    if (on_mesh(pair, geometry)) {
        const Form form = form_of(pair.a, geometry);
        return form == Form::polytope || form == Form::compound;
    }
    return !on_plane(pair, geometry) && form_of(pair.a, geometry) != Form::ball &&
           form_of(pair.b, geometry) != Form::ball;
}

double axis_distance(const BodyPair& pair, const Configuration& at)
{
    if (on_mesh(pair, at.geometry)) {
        return mesh_distance(pair, at);
    }
    double smallest = infinity;
    const double near = clearly_apart(at.geometry);
    const double others = for_each_part_pair(pair, at, near, [&](const PartPair& parts) {
        const double distance = has_rod(parts)
                                    ? rod_distance(pair, parts, at, near)
                                    : separation(parts.a, parts.b, near, at.geometry.unit).distance;
        smallest = std::min(smallest, distance);
    });
    return std::min(smallest, others);
}

void find_candidates(const BodyPair& pair, const Configuration& at, double near,
                     std::vector<Candidate>& found)
{
    if (on_plane(pair, at.geometry)) {
        on_plane(pair, at, found);
    } else if (on_mesh(pair, at.geometry)) {
        find_mesh_candidates(pair, at, found);
    } else if (has_axis(pair, at.geometry)) {
        between_parts(pair, at, near, found);
    } else {
        of_ball(pair, at, near, found);
    }
}

} // namespace hyoryu
