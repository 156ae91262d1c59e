// SPDX-License-Identifier: MIT
// Rigid bodies and the surfaces they meet, as plain data. All in double, SI.
#pragma once

#include "hyoryu/core/motion.hpp"
#include "hyoryu/core/types.hpp"

#include <array>
#include <string>
#include <variant>
#include <vector>

namespace hyoryu {

// Contact geometry in the body frame, whose origin is the centre of mass.
// In two dimensions a ball is a disc and a polytope a polygon in the x-z plane (corners at y = 0).

/// A ball; contact is exact.
struct Ball {
    double radius = 0;    // [m]
    Vec3 middle{0, 0, 0}; // of the ball, from the centre of mass [m]
};
/// A circular cylinder along the body's x axis; contact is exact. In two dimensions it is the
/// rectangle of its lengthwise section.
struct Rod {
    double radius = 0;    // [m]
    double length = 0;    // [m]
    Vec3 middle{0, 0, 0}; // of the cylinder, from the centre of mass [m]
};
/// A convex polytope: a box, or the hull of a mesh or of a particle aggregate.
struct Polytope {
    std::vector<Vec3> corners;           // [m]
    std::vector<std::vector<int>> faces; // corners of each face, counter-clockwise from outside
};
/// A union of convex polytopes that touch or overlap, in three dimensions: bodies that are not
/// convex. Faces and edges that another part covers have no contact of their own.
struct Compound {
    std::vector<Polytope> parts;
};
using ContactShape = std::variant<Ball, Rod, Polytope, Compound>;

/// The polytope of a box of the given edge lengths; a rectangle in the x-z plane if `dimensions`
/// is 2.
Polytope box_polytope(const Vec3& size, int dimensions);

/// The faces of a polytope by their corners; in two dimensions the edges of the polygon in the x-z
/// plane, whose faces are its edges, or one is the polygon.
std::vector<std::vector<int>> faces_of(const Polytope& shape, int dimensions);

/// The mean of some points.
Vec3 mean_of(const std::vector<Vec3>& points);

/// The shape moved by `way` in body axes [m].
ContactShape moved(ContactShape shape, const Vec3& way);

/// The convex hull of the points; nearly coplanar triangles are merged into faces. The points must
/// span a volume. Source: incremental hull, de Berg et al. (2008), ch. 11.
Polytope convex_hull(const std::vector<Vec3>& points);

/// Mass, and inertia about the centre of mass in body axes.
struct MassProperties {
    double mass = 0;                 // [kg]; kg/m in two dimensions
    Mat3 inertia = Mat3::Identity(); // I_b [kg m2]; kg m in two dimensions
};

/// The exact mass properties of a shape of uniform density, about its own centre wherever the
/// origin is; the parts of a compound must not
/// overlap for that. Two dimensions: per metre of width, and the inertia about y is that of the
/// cross-section in the x-z plane.
MassProperties mass_properties(const ContactShape& shape, double density, int dimensions);

/// A rigid body. State: pose (x, q), V and the angular momentum L in world axes, so that
/// torque-free rotation keeps L exactly.
struct Body {
    std::string name;
    ContactShape shape;
    MassProperties mass;
    int material = 0;                    // index into ContactLaws
    std::array<bool, 6> locks{};         // x y z rx ry rz in world axes; all true: fixed
    Vec3 position{0, 0, 0};              // x_cg [m]
    Quat orientation = Quat::Identity(); // q, body to world
    Vec3 velocity{0, 0, 0};              // V [m/s]
    Vec3 angular_momentum{0, 0, 0};      // L [kg m2/s]
    bool left = false;                   // it left the run: no contacts, no motion
};

/// omega = R I_b^-1 R^T L; with locked axes, the inertia restricted to the free axes is inverted
/// [rad/s]. In two dimensions only L_y may differ from zero.
Vec3 angular_velocity(const Body& body);
/// L of a body that turns with omega.
Vec3 angular_momentum(const Body& body, const Vec3& omega);
/// 1/2 M V^2 + 1/2 omega . L [J]
double kinetic_energy(const Body& body);
/// Whether nothing can move the body: all its axes are locked.
bool is_fixed(const Body& body);
/// Support function about the centre of mass along a unit vector: the largest n . (x - x_cg) of its
/// points [m].
double reach_along(const Body& body, const Vec3& n);

/// Force and torque about the centre of mass, constant over a step.
struct Wrench {
    Vec3 force{0, 0, 0};  // [N]
    Vec3 torque{0, 0, 0}; // [N m]
};

/// The growth of the velocity [m/s2] and of the angular velocity [rad/s2] of a body.
struct Acceleration {
    Vec3 linear{0, 0, 0};
    Vec3 angular{0, 0, 0};
};
/// The acceleration of a body by a wrench, other loads and its rotation left aside. Locked axes,
/// and a body that has left, do not move.
Acceleration acceleration(const Body& body, const Wrench& wrench);

/// An infinite plane; bodies stay on the side the normal points to.
struct Plane {
    Vec3 point{0, 0, 0};  // [m]
    Vec3 normal{0, 0, 1}; // unit
};
/// The inside of a box with optional sides (-x +x -y +y -z +z). A closed side is a slab of that
/// thickness outside the box: it ends at the rim towards an open neighbour and goes on through the
/// corner towards a closed one, and bodies meet it from inside, from outside and on its rim.
struct Basin {
    Vec3 min{0, 0, 0}; // [m]
    Vec3 max{0, 0, 0}; // [m]
    std::array<bool, 6> open{};
    double thickness = 0.1; // of the sides [m]
};
/// A fixed or prescribed convex obstacle.
struct Obstacle {
    ContactShape shape;
    Vec3 position{0, 0, 0};
    Quat orientation = Quat::Identity();
};

/// A triangle surface, in three dimensions: bodies stay on the side from which the triangles wind
/// counter-clockwise. It need not be closed; at an open rim it is a thin plate.
struct MeshSurface {
    std::vector<Vec3> corners; // [m]
    std::vector<std::array<int, 3>> triangles;
    Vec3 position{0, 0, 0}; // of the origin of the corners
    Quat orientation = Quat::Identity();
};

/// A wall in contact with bodies: a surface, not particles.
struct Boundary {
    std::string name;
    std::variant<Plane, Basin, Obstacle, MeshSurface> surface; // where it is at time 0
    int material = 0;
    Motion motion;
    bool bodies_only = false; // it acts on bodies only, not on the fluid
};

/// Restitution and friction of every pair of materials.
struct ContactLaws {
    struct Law {
        double restitution = 0.4; // e [1]
        double friction = 0.3;    // mu [1]
    };
    Law otherwise;                                         // of pairs that are not listed
    std::vector<std::pair<std::array<int, 2>, Law>> pairs; // unordered pairs of material indices
    const Law& of(int a, int b) const;
};

} // namespace hyoryu
