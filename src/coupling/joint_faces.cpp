// SPDX-License-Identifier: MIT
#include "joint_faces.hpp"

#include "joint_surface.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hyoryu {

namespace {

constexpr int most_cells = 24;      // along a face in space
constexpr int most_cells_flat = 64; // in two dimensions
constexpr int samples = 4;          // of a cell along each edge, for the part within the face
constexpr double narrow = 1.5;      // spacings; a narrower face takes part in no joint

struct Polygon {
    Vec3 normal{0, 0, 1};
    std::vector<Vec3> corners; // two in two dimensions
};

void add_faces(const Polytope& shape, int dimensions, std::vector<Polygon>& polygons)
{
    Vec3 inside = Vec3::Zero();
    for (const Vec3& corner : shape.corners) {
        inside += corner / static_cast<double>(shape.corners.size());
    }
    for (const auto& face : faces_of(shape, dimensions)) {
        if (const auto side = side_through(shape, face, inside)) {
            Polygon polygon{side->normal, {}};
            for (const int k : face) {
                polygon.corners.push_back(shape.corners[at(k)]);
            }
            polygons.push_back(std::move(polygon));
        }
    }
}

// Caps as polygons of the same area as the disc.
void add_caps(const Rod& rod, std::vector<Polygon>& polygons)
{
    constexpr int n = 32;
    const double turn = 2 * std::numbers::pi / n;
    const double radius = rod.radius * std::sqrt(turn / std::sin(turn));
    for (const double side : {-1.0, 1.0}) {
        Polygon cap{side * Vec3::UnitX(), {}};
        for (int k = 0; k < n; ++k) {
            const double angle = side * turn * k;
            cap.corners.emplace_back(rod.middle + Vec3(side * rod.length / 2,
                                                       radius * std::cos(angle),
                                                       radius * std::sin(angle)));
        }
        polygons.push_back(std::move(cap));
    }
}

std::vector<Polygon> polygons_of(const ContactShape& shape, int dimensions)
{
    std::vector<Polygon> polygons;
    if (const auto* polytope = std::get_if<Polytope>(&shape)) {
        add_faces(*polytope, dimensions, polygons);
    } else if (const auto* rod = std::get_if<Rod>(&shape)) {
        if (dimensions == 2) {
            const Vec3 section(rod->length, 0, 2 * rod->radius);
            const ContactShape box = moved(box_polytope(section, 2), rod->middle);
            add_faces(std::get<Polytope>(box), 2, polygons);
        } else {
            add_caps(*rod, polygons);
        }
    } else if (const auto* compound = std::get_if<Compound>(&shape)) {
        for (const Polytope& part : compound->parts) {
            add_faces(part, dimensions, polygons);
        }
    }
    return polygons;
}

// Whether a point of the plane of a convex polygon lies in it.
bool within(const Polygon& polygon, const Vec3& point)
{
    const auto& c = polygon.corners;
    int left = 0;
    int right = 0;
    for (std::size_t k = 0; k < c.size(); ++k) {
        const double side = polygon.normal.dot((c[(k + 1) % c.size()] - c[k]).cross(point - c[k]));
        left += side > 0 ? 1 : 0;
        right += side < 0 ? 1 : 0;
    }
    return left == 0 || right == 0;
}

double area_of(const Polygon& polygon)
{
    const auto& c = polygon.corners;
    if (c.size() == 2) {
        return (c[1] - c[0]).norm();
    }
    Vec3 twice = Vec3::Zero();
    for (std::size_t k = 2; k < c.size(); ++k) {
        twice += (c[k - 1] - c[0]).cross(c[k] - c[0]);
    }
    return twice.norm() / 2;
}

// A face with its extent along u and v.
struct Extent {
    JointFace face;
    double u = 0, v = 0; // lower ends [m]
    double length = 0, width = 0;
};

Extent extent_of(const Polygon& polygon)
{
    Extent e;
    const auto& c = polygon.corners;
    Vec3 longest = c[1] - c[0];
    for (std::size_t k = 0; k < c.size(); ++k) {
        const Vec3 edge = c[(k + 1) % c.size()] - c[k];
        longest = edge.norm() > longest.norm() * (1 + 1e-9) ? edge : longest;
        e.face.centre += c[k] / static_cast<double>(c.size());
    }
    e.face.normal = polygon.normal;
    e.face.u = longest.normalized();
    e.face.v = c.size() == 2 ? Vec3(Vec3::Zero()) : Vec3(polygon.normal.cross(e.face.u));
    e.u = e.v = infinity;
    double u_top = -infinity;
    double v_top = -infinity;
    for (const Vec3& corner : c) {
        e.u = std::min(e.u, e.face.u.dot(corner));
        e.v = std::min(e.v, e.face.v.dot(corner));
        u_top = std::max(u_top, e.face.u.dot(corner));
        v_top = std::max(v_top, e.face.v.dot(corner));
        e.face.reach = std::max(e.face.reach, (corner - e.face.centre).norm());
    }
    e.length = u_top - e.u;
    e.width = v_top - e.v;
    return e;
}

// Cuts faces into cells and finds the particles below them.
class Cutter {
public:
    Cutter(BodyFaces& body, const RaySolid& solid, std::span<const Vec3> points,
           const JointScale& scale)
        : body_(body), solid_(solid), points_(points), scale_(scale)
    {
    }

    void cut(const Polygon& polygon)
    {
        Extent e = extent_of(polygon);
        const bool flat = scale_.dimensions == 2;
        if (std::min(e.length, flat ? infinity : e.width) < narrow * scale_.spacing) {
            return;
        }
        const int nu = cells(e.length);
        const int nv = flat ? 1 : cells(e.width);
        e.face.du = e.length / nu;
        e.face.dv = flat ? 1 : e.width / nv;
        e.face.first = static_cast<int>(body_.cells.size());
        const std::vector<int> grid = add_cells(polygon, e, nu, nv);
        e.face.last = static_cast<int>(body_.cells.size());
        if (e.face.last > e.face.first) {
            link(grid, nu, nv, e.face);
            add_particles(grid, e, nu, nv);
            body_.faces.push_back(e.face);
        }
    }

private:
    int cells(double length) const
    {
        const int most = scale_.dimensions == 2 ? most_cells_flat : most_cells;
        return std::clamp(static_cast<int>(std::ceil(length / scale_.spacing - 1e-6)), 1, most);
    }

    // Whether another part of a compound covers the place.
    bool covered(const Vec3& place, const Vec3& normal) const
    {
        const Vec3 before = place + 1e-3 * scale_.spacing * normal;
        return solid_.pieces.size() > 1 &&
               std::ranges::any_of(solid_.pieces, [&](const ConvexPiece& piece) {
                   return holds(piece, before, 0);
               });
    }

    // The cells of a grid by their place in it; -1 where the face has none.
    std::vector<int> add_cells(const Polygon& polygon, const Extent& e, int nu, int nv)
    {
        std::vector<int> grid(at(nu * nv), -1);
        const double offset = polygon.normal.dot(polygon.corners[0]);
        double total = 0;
        for (int k = 0; k < nu * nv; ++k) {
            JointCell cell{.face = static_cast<int>(body_.faces.size())};
            int inside = 0;
            const int deep = scale_.dimensions == 2 ? 1 : samples;
            for (int s = 0; s < samples * deep; ++s) {
                const int row = k / nu;
                const int across = s / samples;
                const double su = e.u + e.face.du * (k % nu + (s % samples + 0.5) / samples);
                const double sv =
                    scale_.dimensions == 2 ? 0 : e.v + e.face.dv * (row + (across + 0.5) / samples);
                const Vec3 place = offset * polygon.normal + su * e.face.u + sv * e.face.v;
                if (scale_.dimensions == 2 || within(polygon, place)) {
                    cell.centre += place;
                    inside += 1;
                }
            }
            if (inside == 0) {
                continue;
            }
            cell.centre /= inside;
            cell.area = inside;
            total += inside;
            if (!covered(cell.centre, polygon.normal)) {
                grid[at(k)] = static_cast<int>(body_.cells.size());
                body_.cells.push_back(cell);
            }
        }
        for (std::size_t c = at(e.face.first); c < body_.cells.size(); ++c) {
            body_.cells[c].area *= area_of(polygon) / total; // exact in sum
        }
        return grid;
    }

    void link(const std::vector<int>& grid, int nu, int nv, const JointFace& face)
    {
        const Vec3 half_u = face.du / 2 * face.u;
        const Vec3 half_v = face.dv / 2 * face.v;
        for (int k = 0; k < nu * nv; ++k) {
            if (grid[at(k)] < 0) {
                continue;
            }
            JointCell& cell = body_.cells[at(grid[at(k)])];
            const int i = k % nu;
            const int j = k / nu;
            cell.next = {i > 0 ? grid[at(k - 1)] : -1, i + 1 < nu ? grid[at(k + 1)] : -1,
                         j > 0 ? grid[at(k - nu)] : -1, j + 1 < nv ? grid[at(k + nu)] : -1};
            cell.rim = {cell.centre - half_u, cell.centre + half_u, cell.centre - half_v,
                        cell.centre + half_v};
        }
    }

    // Particles belong to the nearer of two opposite faces, those in the middle to both: the films
    // on one side of a thin body do not affect the joint on the other side.
    double half_depth(const auto& depth) const
    {
        double least = infinity;
        double most = 0;
        for (int k = 0; k < static_cast<int>(points_.size()); ++k) {
            least = std::min(least, depth(k));
            most = std::max(most, depth(k));
        }
        const double rounded = 1e-6 * scale_.spacing;
        return std::min((least + most) / 2 + rounded, scale_.support);
    }

    void add_particles(const std::vector<int>& grid, const Extent& e, int nu, int nv)
    {
        const double offset = e.face.normal.dot(e.face.centre);
        const auto depth = [&](int k) { return offset - e.face.normal.dot(points_[at(k)]); };
        const double deepest = half_depth(depth);
        std::vector<std::vector<int>> below(body_.cells.size() - at(e.face.first));
        std::vector<int> outermost;
        double top = infinity;
        for (int k = 0; k < static_cast<int>(points_.size()); ++k) {
            const double u = (e.face.u.dot(points_[at(k)]) - e.u) / e.face.du;
            const double v =
                scale_.dimensions == 2 ? 0 : (e.face.v.dot(points_[at(k)]) - e.v) / e.face.dv;
            if (depth(k) < 0 || depth(k) > deepest || u < 0 || u >= nu || v < 0 || v >= nv) {
                continue;
            }
            top = std::min(top, depth(k));
            const int cell = grid[at(static_cast<int>(v) * nu + static_cast<int>(u))];
            if (cell >= 0) {
                below[at(cell - e.face.first)].push_back(k);
            }
        }
        const auto outer = [&](int k) { return depth(k) < top + 0.5 * scale_.body_spacing; };
        for (auto& list : below) {
            std::ranges::stable_partition(list, outer);
            std::ranges::copy_if(list, std::back_inserter(outermost), outer);
        }
        for (int c = e.face.first; c < e.face.last; ++c) {
            JointCell& cell = body_.cells[at(c)];
            const auto& list = below[at(c - e.face.first)];
            cell.first = static_cast<int>(body_.particles.size());
            cell.inner = cell.first + static_cast<int>(std::ranges::count_if(list, outer));
            body_.particles.insert(body_.particles.end(), list.begin(), list.end());
            cell.last = static_cast<int>(body_.particles.size());
            const std::vector<int> own(list.begin(), list.begin() + (cell.inner - cell.first));
            for (std::size_t edge = 0; edge < 4; ++edge) {
                cell.probe[edge] = nearest(own.empty() ? outermost : own, cell.rim[edge]);
            }
        }
    }

    // -1 if there is none.
    int nearest(const std::vector<int>& particles, const Vec3& place) const
    {
        const auto found = std::ranges::min_element(
            particles, {}, [&](int k) { return (points_[at(k)] - place).squaredNorm(); });
        return found == particles.end() ? -1 : *found;
    }

    BodyFaces& body_;
    const RaySolid& solid_;
    std::span<const Vec3> points_;
    JointScale scale_;
};

} // namespace

BodyFaces joint_faces(const ContactShape& shape, std::span<const Vec3> points,
                      const JointScale& scale)
{
    BodyFaces body;
    const RaySolid solid = ray_solid(shape, scale.dimensions);
    Cutter cutter(body, solid, points, scale);
    for (const Polygon& polygon : polygons_of(shape, scale.dimensions)) {
        cutter.cut(polygon);
    }
    return body;
}

} // namespace hyoryu
