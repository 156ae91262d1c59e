// SPDX-License-Identifier: MIT
// A contact shape with the tables that the distance functions need.
#pragma once

#include "hyoryu/rigid/body.hpp"

#include <algorithm>
#include <vector>

namespace hyoryu {

enum class Form { ball, rod, polytope, compound };

/// A plane through an edge of a face, square to the face: n . x <= offset inside the face.
/// In two dimensions the edge is one corner (i == j).
struct Side {
    Vec3 normal{0, 0, 0};
    double offset = 0; // [m]
    int i = 0, j = 0;  // corners
};

/// A flat face; coplanar neighbours are merged, so that a contact sees the whole of it.
struct Face {
    Vec3 normal{0, 0, 1}; // outward unit
    double offset = 0;    // n . x of the face [m]
    std::vector<int> corners;
    std::vector<Side> sides;
};

/// How far the foot of a point on the plane of a face is past its sides; negative inside [m].
inline double past_sides(const Face& face, const Vec3& p)
{
    double past = -infinity;
    for (const Side& side : face.sides) {
        past = std::max(past, side.normal.dot(p) - side.offset);
    }
    return past;
}

/// An edge between two faces, with the cross product of their normals (the arc on the Gauss map).
struct Edge {
    int i = 0, j = 0;
    int left = 0, right = 0;
    Vec3 arc{0, 0, 0};
};

/// A shape in its body frame; a ball or rod in axes through its middle (`placed` puts it there). A
/// rod has its two caps as `faces`, at -x and +x: the planes are
/// exact, the corners are points of the rims that bound what a cap covers when it stands flat. A
/// compound has the corners and faces of all its parts, one part after another.
struct Solid {
    Form form = Form::ball;
    double radius = 0;      // ball, rod [m]
    double half_length = 0; // rod [m]
    Vec3 middle{0, 0, 0};   // of a ball or rod, from the centre of mass [m]
    std::vector<Vec3> corners;
    std::vector<Face> faces;
    std::vector<Edge> edges;
    std::vector<std::vector<int>> faces_of_corner;
    std::vector<int> extremes; // corners that can touch a plane: those of the convex hull
    std::vector<Solid> parts;  // of a compound, with their own numbers
    int first_corner = 0;      // of a part within its compound
    int first_face = 0;
    Vec3 inside{0, 0, 0};     // a point within a polytope: the mean of its corners [m]
    Vec3 box_centre{0, 0, 0}; // bounding box in the body frame [m]
    Vec3 box_half{0, 0, 0};
    double reach = 0;     // largest distance of a point from the centre of mass [m]
    double thickness = 0; // a length that motion must not jump over unseen: the inner radius [m]
};

/// A ball about its centre of mass: turning it changes no contact.
inline bool turns_unseen(const Solid& solid)
{
    return solid.form == Form::ball && solid.middle.isZero(0);
}

/// The tables of a shape. In two dimensions a rod is the rectangle of its lengthwise section.
Solid solid_of(const ContactShape& shape, int dimensions);

/// How far a solid reaches from the origin of its axes along the unit direction n [m].
double support(const Solid& solid, const Vec3& n);

} // namespace hyoryu
