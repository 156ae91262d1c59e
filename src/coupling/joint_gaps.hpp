// SPDX-License-Identifier: MIT
// Finds by ray casting which cells of a body's faces lie opposite another solid, and the gap there.
#pragma once

#include "joint_faces.hpp"
#include "joint_inflow.hpp"
#include "joint_surface.hpp"
#include "lattice_sums.hpp"

#include <functional>
#include <limits>

namespace hyoryu {

/// A cell of a face in this step.
struct JointNode {
    static constexpr int none = std::numeric_limits<int>::max();
    int other = none;     // opposite: a body, -1 - (index of the boundary), or none
    bool sealed = false;  // no water enters
    bool open = false;    // nothing faces it within reach
    double gap = 0;       // [m]
    double opening = 0;   // speed at which the two faces part [m/s]
    double mass = 0;      // that parts from the other side: reduced of two bodies [kg]
    double pressure = 0;  // of the seepage [Pa]
    double film = 1;      // share of its film forces that a particle behind the cell keeps
    double weight = 0;    // of the joint against the particles in it, 0 where the gap is wide
    double lacking = 0;   // pressure that the particles do not transmit [Pa]
    double carried = 0;   // pressure that the joint adds to that of the particles [Pa]
    Vec3 place{0, 0, 0};  // of its centre [m]
    Vec3 normal{0, 0, 1}; // of the face, outward
};

/// A body with its joints.
struct BodyJoints {
    bool has_faces = false;
    BodyFaces faces;
    std::vector<int> near;            // other solids that it may touch, walls first
    std::vector<JointNode> nodes;     // by cell; empty while no cell lies opposite anything
    std::vector<std::uint8_t> joined; // by face: it has touched the opposite surface
    std::vector<JointInflow> inflows; // by face
};

/// All surfaces of the scene.
struct JointTables {
    std::vector<RayWall> walls;
    std::vector<Vec3> displaced;  // walls, at the time of the step [m]
    std::vector<RaySolid> solids; // bodies
    std::vector<BodyJoints> bodies;
    std::vector<std::pair<double, int>> along_x; // bodies by the lower end of their spheres
    double largest_reach = 0;
    LatticeSums sums;           // of the fluid
    double reach = 0;           // widest gap that may belong to a joint [m]
    std::vector<int> first_cut; // memory of `cut_slip_of_films`, by row of bodies
};

/// The tables of a scene whose joints are at most `reach` wide.
JointTables joint_tables(const Rigid& rigid, double reach);

/// How far behind the origin of a ray the surface of another solid may lie: solids may overlap a
/// little [m].
double overlap_of(const JointTables& tables);

/// Moves the walls to a time and lists for every body which solids are near it.
void find_near(JointTables& tables, const Rigid& rigid, const std::vector<Pose>& poses,
               double time);

/// Where a ray from body b, in world axes, first enters another solid that is near, if it does so
/// within a part of the ray.
struct OtherHit {
    int other = JointNode::none;
    RayHit hit;
};
OtherHit first_other(const JointTables& tables, const std::vector<Pose>& poses, int b,
                     const Ray& ray, const RayPart& part);

/// What lies opposite a place of a face of body b, from which the ray goes along the normal: a
/// solid that faces it within reach.
struct Facing {
    int other = JointNode::none;
    double gap = 0;      // [m]
    bool nothing = true; // no solid faces it there
};
Facing facing(const JointTables& tables, const std::vector<Pose>& poses, int b, const Ray& ray);

/// The kind of the gap between two faces: no joint, sealed, or open to water.
enum class JointKind { none, sealed, open };

/// The joint of body b and another solid, if it belongs to the cells of b; `normal` is that of the
/// face, outward.
using Joins = std::function<JointKind(int b, int other, const Vec3& normal)>;

/// Finds the surface opposite each cell of body b; true if there is any.
bool find_gaps(JointTables& tables, const std::vector<Pose>& poses, int b, const Joins& joins);

} // namespace hyoryu
