// SPDX-License-Identifier: MIT
// Contacts of rods: separating axes over faces and pairs of curved features, and the features near
// the best.
#include "rod_contact.hpp"
#include "rigid/shapes/compound.hpp"
#include "rod_touch.hpp"
#include "tolerances.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

// Features with a gap below twice the overlap of the solids, less this tolerance, do not face each
// other [units].
constexpr double no_overlap = -1e-9;
// The smallest gap of the contacts equals the distance of the solids to this accuracy [units].
constexpr double exact = 1e-10;

// The distance of two solids along a direction from b to a.
double distance_along(const PartPair& parts, const Vec3& n)
{
    const auto reach = [](const PlacedSolid& body, const Vec3& way) {
        return support(body.solid, body.pose.R.transpose() * way);
    };
    return n.dot(parts.a.pose.x - parts.b.pose.x) - reach(parts.a, -n) - reach(parts.b, n);
}

// A face and the distance of the other solid along its normal.
struct FaceAxis {
    int owner = 0; // of the face: 0 if a
    int face = 0;
    double distance = -infinity; // [m]
};

// A pair of features of which at least one is curved, or a rod and a corner.
struct RodMeeting {
    Feature feature;
    const Edge* edge = nullptr; // of the polytope, if it meets with an edge
    RodTouch at;
};

// Faces and pairs of features that may face each other, and the largest separation so far.
struct Look {
    const BodyPair& pair;
    const PartPair& parts;
    const Configuration& at;
    double tolerance = 0; // [m]
    std::vector<FaceAxis> faces;
    std::vector<RodMeeting> meetings;
    double distance = -infinity;
    FaceAxis best_face;
    int best_meeting = -1; // before the face, if there is one

    const PlacedSolid& part(int owner) const { return owner == 0 ? parts.a : parts.b; }
    bool is_rod(int owner) const { return part(owner).solid.form == Form::rod; }
    Feature feature(FeatureKind kind, int owner) const { return {pair.a, pair.b, kind, owner}; }
};

void add_faces(Look& look, int owner)
{
    const PlacedSolid& body = look.part(owner);
    for (int f = 0; f < static_cast<int>(body.solid.faces.size()); ++f) {
        const Vec3 n = (owner == 0 ? -1 : 1) * (body.pose.R * body.solid.faces[f].normal);
        look.faces.push_back({owner, f, distance_along(look.parts, n)});
        if (look.faces.back().distance > look.distance) {
            look.distance = look.faces.back().distance;
            look.best_face = look.faces.back();
        }
    }
}

void add_meeting(Look& look, const Feature& feature, const Edge* edge)
{
    look.meetings.push_back({feature, edge, rod_touch(feature, look.at)});
    const Touch& touch = look.meetings.back().at.touch;
    if (touch.gap <= look.distance) { // bounds the distance along the normal
        return;
    }
    const double distance = distance_along(look.parts, touch.normal);
    if (distance > look.distance) {
        look.distance = distance;
        // A normal that nearly equals that of a face belongs to the face: the lines cross
        // elsewhere.
        if (touch.gap <= distance + exact * look.at.geometry.unit) {
            look.best_meeting = static_cast<int>(look.meetings.size()) - 1;
        }
    }
}

// Adds the ends of the chord of a rim along a line: the end at which the line enters the cap, and
// the other one if the line is so nearly parallel to the cap that both may touch.
void add_rim_ends(Look& look, Feature rim, const Vec3& line, const Edge* edge, double enough)
{
    const PlacedSolid& rod = look.part(rim.owner);
    const double lean = (rim.i == 0 ? -1 : 1) * rod.pose.R.col(0).dot(line) / line.norm();
    for (rim.j = 0; rim.j < 2; ++rim.j) {
        const int end = rim.j == 0 ? -1 : 1;
        if (2 * rod.solid.radius * end * lean <= std::max(enough, 0.0)) {
            add_meeting(look, rim, edge);
        }
    }
}

// This and the next function stop at a normal that separates by more than `enough`.
void add_meetings_of_rods(Look& look, double enough)
{
    add_meeting(look, look.feature(FeatureKind::side_line, 0), nullptr);
    for (const int i : {0, 1}) {
        for (const int j : {0, 1}) {
            if (look.distance > enough) {
                return;
            }
            Feature rim = look.feature(FeatureKind::rim_line, i);
            rim.i = j;
            add_rim_ends(look, rim, look.part(1 - i).pose.R.col(0), nullptr, enough);
            Feature rims = look.feature(FeatureKind::rim_rim, 0);
            rims.i = i;
            rims.j = j;
            add_meeting(look, rims, nullptr);
        }
    }
}

void add_meetings_with_polytope(Look& look, int rod, double enough)
{
    const PlacedSolid& other = look.part(1 - rod);
    const Solid& polytope = other.solid;
    for (int k = 0; k < static_cast<int>(polytope.corners.size()); ++k) {
        if (look.distance > enough) {
            return;
        }
        Feature corner = look.feature(FeatureKind::rod_corner, rod);
        corner.k = polytope.first_corner + k;
        add_meeting(look, corner, nullptr);
    }
    for (const Edge& edge : polytope.edges) {
        if (look.distance > enough) {
            return;
        }
        Feature side = look.feature(FeatureKind::side_line, rod);
        side.k = polytope.first_corner + edge.i;
        side.l = polytope.first_corner + edge.j;
        add_meeting(look, side, &edge);
        const Vec3 line = other.pose.R * (polytope.corners[edge.j] - polytope.corners[edge.i]);
        for (const int i : {0, 1}) {
            Feature rim = side;
            rim.kind = FeatureKind::rim_line;
            rim.i = i;
            add_rim_ends(look, rim, line, &edge, enough);
        }
    }
}

Look look_at(const BodyPair& pair, const PartPair& parts, const Configuration& at, double enough)
{
    Look look{pair, parts, at, rim_tolerance * std::min(parts.a.solid.reach, parts.b.solid.reach)};
    add_faces(look, 0);
    add_faces(look, 1);
    const int owner = look.best_face.owner;
    if (look.distance > enough ||
        (!look.is_rod(owner) &&
         lies_over(look.part(1 - owner), look.part(owner), look.best_face.face))) {
        return look;
    }
    if (look.is_rod(0) && look.is_rod(1)) {
        add_meetings_of_rods(look, enough);
    } else {
        add_meetings_with_polytope(look, look.is_rod(0) ? 0 : 1, enough);
    }
    return look;
}

// Whether a point lies above a face, or past its rim by at most the tolerance.
bool is_over(const Look& look, const FaceAxis& axis, const Vec3& point)
{
    const PlacedSolid& body = look.part(axis.owner);
    const Vec3 p = in_frame(body.pose, point);
    if (body.solid.form == Form::rod) {
        return std::hypot(p.y(), p.z()) <= body.solid.radius + look.tolerance;
    }
    return past_sides(body.solid.faces[axis.face], p) <= look.tolerance;
}

// Whether the feature lies on the surface of the compound at the touch.
bool is_open(const Look& look, const RodMeeting& meeting)
{
    const int other = 1 - meeting.feature.owner;
    const Solid& whole = placed(look.at, other == 0 ? look.pair.a : look.pair.b).solid;
    if (whole.form != Form::compound) {
        return true;
    }
    const PlacedSolid& part = look.part(other);
    const Vec3 p = in_frame(part.pose, meeting.at.touch.point);
    return meeting.edge != nullptr ? edge_is_open(whole, part.solid, *meeting.edge, p)
                                   : rim_is_open(whole, part.solid, p);
}

bool is_open(const Look& look, const FaceAxis& axis, const Vec3& point)
{
    const PlacedSolid& part = look.part(axis.owner);
    const Solid& whole = placed(look.at, axis.owner == 0 ? look.pair.a : look.pair.b).solid;
    return face_is_open(whole, part.solid, axis.face, in_frame(part.pose, point));
}

Candidate rim_on_face(const Look& look, const FaceAxis& axis, int rim)
{
    Feature f = look.feature(FeatureKind::rim_face, 1 - axis.owner);
    f.i = rim;
    f.f = look.part(axis.owner).solid.first_face + axis.face;
    return {f, touch_of(f, look.at)};
}

// Where the rims of two caps cross.
void add_crossings(Look& look, const FaceAxis& axis)
{
    if (!look.is_rod(1 - axis.owner)) {
        return;
    }
    Feature f = look.feature(FeatureKind::cap_cap, axis.owner);
    f.i = axis.face;
    for (f.j = 0; f.j < 2; ++f.j) {
        for (f.k = 0; f.k < 2; ++f.k) {
            add_meeting(look, f, nullptr);
        }
    }
}

// Adds the points of the rim of a cap that stands on a face.
void add_cap(const Look& look, const FaceAxis& axis, int cap, std::vector<Candidate>& over)
{
    Feature f = look.feature(FeatureKind::corner_face, 1 - axis.owner);
    f.f = look.part(axis.owner).solid.first_face + axis.face;
    for (const int corner : look.part(1 - axis.owner).solid.faces[cap].corners) {
        f.i = corner;
        const Touch touch = touch_of(f, look.at);
        if (is_over(look, axis, touch.point)) {
            over.push_back({f, touch});
        }
    }
}

// The rim points of a rod above a face of the other solid.
std::vector<Candidate> over_face(const Look& look, const FaceAxis& axis)
{
    std::vector<Candidate> over;
    if (!look.is_rod(1 - axis.owner)) {
        return over;
    }
    for (const int i : {0, 1}) {
        const Candidate rim = rim_on_face(look, axis, i);
        if (is_over(look, axis, rim.touch.point)) {
            over.push_back(rim);
        }
    }
    const PlacedSolid& under = look.part(axis.owner);
    const double upright = look.part(1 - axis.owner)
                               .pose.R.col(0)
                               .dot(under.pose.R * under.solid.faces[axis.face].normal);
    if (std::abs(upright) > standing) {
        add_cap(look, axis, upright > 0 ? 0 : 1, over);
    }
    return over;
}

// The feature whose gap is the best separation.
Candidate nearest_feature(const Look& look)
{
    if (look.best_meeting >= 0) {
        const RodMeeting& best = look.meetings[look.best_meeting];
        return {best.feature, best.at.touch};
    }
    const FaceAxis& axis = look.best_face;
    if (look.is_rod(1 - axis.owner)) {
        const Candidate low = rim_on_face(look, axis, 0);
        const Candidate high = rim_on_face(look, axis, 1);
        return low.touch.gap < high.touch.gap ? low : high;
    }
    Candidate lowest;
    lowest.touch.gap = infinity;
    Feature f = look.feature(FeatureKind::corner_face, 1 - axis.owner);
    f.f = look.part(axis.owner).solid.first_face + axis.face;
    const Solid& body = look.part(1 - axis.owner).solid;
    for (int k = 0; k < static_cast<int>(body.corners.size()); ++k) {
        f.i = body.first_corner + k;
        const Touch touch = touch_of(f, look.at);
        lowest = touch.gap < lowest.touch.gap ? Candidate{f, touch} : lowest;
    }
    return lowest;
}

// Appends candidates whose gap is at least about twice the overlap of the solids and at most `near`
// above their distance, each point once.
class Collection {
public:
    Collection(const Look& look, double near, std::vector<Candidate>& found)
        : deepest_(2 * std::min(look.distance, 0.0) + no_overlap * look.at.geometry.unit),
          highest_(look.distance + near), tolerance_(2 * look.tolerance),
          first_(static_cast<std::ptrdiff_t>(found.size())), found_(found)
    {
    }

    void add(const Candidate& c)
    {
        const bool known =
            std::any_of(found_.begin() + first_, found_.end(), [&](const Candidate& k) {
                const Vec3 d = k.touch.point - c.touch.point;
                return (d - c.touch.normal * c.touch.normal.dot(d)).norm() < tolerance_;
            });
        if (!known && fits(c)) {
            lowest_ = std::min(lowest_, c.touch.gap);
            found_.push_back(c);
        }
    }

    bool fits(const Candidate& c) const
    {
        return c.touch.gap >= deepest_ && c.touch.gap <= highest_;
    }

    double lowest() const { return lowest_; }

private:
    double deepest_;
    double highest_;
    double tolerance_;
    std::ptrdiff_t first_;
    std::vector<Candidate>& found_;
    double lowest_ = infinity;
};

// Whether the polytope of an edge lies below it, seen from the rod along the normal.
bool lies_below(const Look& look, const RodMeeting& meeting)
{
    const PlacedSolid& polytope = look.part(1 - meeting.feature.owner);
    const Edge& edge = *meeting.edge;
    const Solid& solid = polytope.solid;
    const Vec3 out = (meeting.feature.owner == 0 ? 1 : -1) * meeting.at.touch.normal;
    const Vec3 n = polytope.pose.R.transpose() * out;
    const Vec3 d = (solid.corners[edge.j] - solid.corners[edge.i]).normalized();
    return n.dot(solid.faces[edge.left].normal.cross(d)) <= lying_flat &&
           n.dot(d.cross(solid.faces[edge.right].normal)) <= lying_flat;
}

// Whether the solids lie on opposite sides of the touch.
bool separates(const Look& look, const RodMeeting& meeting, double near)
{
    const Touch& touch = meeting.at.touch;
    return meeting.at.past <= look.tolerance && touch.gap <= look.distance + near &&
           (meeting.edge == nullptr || lies_below(look, meeting)) &&
           distance_along(look.parts, touch.normal) >= touch.gap - near;
}

} // namespace

double rod_distance(const BodyPair& pair, const PartPair& parts, const Configuration& at,
                    double enough)
{
    return look_at(pair, parts, at, enough).distance;
}

void add_rod_contacts(const BodyPair& pair, const PartPair& parts, const Configuration& at,
                      double near, std::vector<Candidate>& found, std::vector<Candidate>& covered)
{
    Look look = look_at(pair, parts, at, near);
    if (look.distance > near) {
        return;
    }
    Collection collection(look, near, found);
    bool any_covered = false;
    const auto add = [&](bool open, const Candidate& c) {
        any_covered = any_covered || !open;
        if (open) {
            collection.add(c);
        } else if (collection.fits(c)) {
            covered.push_back(c);
        }
    };
    std::erase_if(look.faces,
                  [&](const FaceAxis& axis) { return axis.distance < look.distance - near; });
    for (const FaceAxis& axis : look.faces) {
        for (const Candidate& c : over_face(look, axis)) {
            add(is_open(look, axis, c.touch.point), c);
        }
        if (look.is_rod(axis.owner)) {
            add_crossings(look, axis);
        }
    }
    for (const RodMeeting& meeting : look.meetings) {
        if (separates(look, meeting, near)) {
            add(is_open(look, meeting), {meeting.feature, meeting.at.touch});
        }
    }
    if (!any_covered && collection.lowest() > look.distance + exact * at.geometry.unit) {
        found.push_back(nearest_feature(look));
    }
}

} // namespace hyoryu
