// SPDX-License-Identifier: MIT
// The keys of what is solid: walls, bodies and their contact.
#include "parameter_table.hpp"

namespace hyoryu {

namespace {

Parameter quaternion_row(std::string_view key)
{
    Parameter row = vector_row(
        key, "", "", "The rotation as a unit quaternion [w, x, y, z], instead of rotation_deg.");
    row.shortest = row.longest = 4;
    return row;
}

Parameter path_row(std::string_view key, ValueKind kind, std::string_view unit,
                   std::string_view meaning)
{
    constexpr int most_points = 1000000;
    Parameter row = vector_row(key, unit, "", meaning);
    row.kind = kind;
    row.shortest = 2;
    row.longest = most_points;
    return row;
}

std::vector<Parameter> copies_parameters()
{
    return {
        table_row("body[].copies", "A block of equal bodies named NAME.1, NAME.2 ..., x fastest."),
        {.key = "body[].copies.count",
         .kind = ValueKind::integers,
         .bounds = "1 .. 100000",
         .fallback = required,
         .meaning = "Number of bodies along x, y and z, the first one included.",
         .minimum = 1,
         .maximum = 100000,
         .shortest = 3,
         .longest = 3},
        vector_row("body[].copies.pitch", "m", required,
                   "Distance from one body to the next along x, y and z."),
    };
}

} // namespace

std::vector<Parameter> wall_parameters()
{
    return {
        tables_row("wall", "A fixed or moving boundary, for fluid and for bodies."),
        text_row("wall[].name", "wall.1, wall.2 ...",
                 "Name in results; unique among walls and bodies."),
        choice_row(
            "wall[].shape", {"plane", "basin", "round_basin", "box", "sphere", "cylinder", "mesh"},
            required,
            "plane: point and normal; basin: the inside of a box; round_basin: the inside of a "
            "sphere, of a circle in two dimensions; box: min and max, or size and "
            "position; sphere, cylinder and mesh as for bodies."),
        vector_row("wall[].point", "m", "[0.0, 0.0, 0.0]", "A point of a plane."),
        vector_row("wall[].normal", "", "[0.0, 0.0, 1.0]",
                   "Direction from a plane into the free space, of any length."),
        vector_row("wall[].min", "m", "", "Lower corner of a basin or box."),
        vector_row("wall[].max", "m", "", "Upper corner of a basin or box."),
        texts_row("wall[].open", {"-x", "+x", "-y", "+y", "-z", "+z"}, "[]",
                  "Sides of a basin without a wall."),
        positive("wall[].thickness", "m", "that of the rows of wall particles",
                 "Of the sides of a basin as bodies meet them, from outside and on their rims too; "
                 "by default 2 fluid.smoothing_ratio spacings rounded up to whole ones, without a "
                 "fluid three; the penalty method takes two spacings."),
        vector_row("wall[].size", "m", "", "Edge lengths of a box, instead of min and max."),
        vector_row("wall[].position", "m", "",
                   "Centre of the shape; of a mesh where its file's origin goes."),
        positive("wall[].radius", "m", "", "Radius of a sphere, cylinder or round basin."),
        positive("wall[].length", "m", "", "Length of a cylinder, along x before rotation."),
        text_row("wall[].file", "", "STL or OBJ file of a mesh, relative to the case file."),
        positive("wall[].scale", "", "1", "Factor on the numbers of a mesh file, to metres."),
        table_row("wall[].rotation_deg", "Rotation about the centre of the shape."),
        vector_row("wall[].rotation_deg.axis", "", "[0.0, 1.0, 0.0] in 2-D, else required",
                   "Axis of rotation, of any length."),
        any_number("wall[].rotation_deg.angle", "deg", required,
                   "Angle of rotation, by the right-hand rule."),
        quaternion_row("wall[].rotation"),
        text_row("wall[].material", "", "Name of its material, for contact.pair."),
        table_row("wall[].motion", "How the wall moves; without it the wall stands still."),
        vector_row("wall[].motion.velocity", "m/s", "[0.0, 0.0, 0.0]", "Constant velocity."),
        text_row("wall[].motion.table", "",
                 "CSV file of a path, relative to the case file: columns time, x, y, z in s and m, "
                 "a header line or none. The wall follows it by monotone cubics, starts where it "
                 "stands in the case whatever place the file has at time 0, and rests outside."),
        path_row("wall[].motion.times", ValueKind::vector, "s",
                 "Times of a path within the case file, ascending; with places."),
        path_row("wall[].motion.places", ValueKind::vectors, "m",
                 "Displacements at the times, [x, y, z] each, from where the wall stands at time "
                 "0."),
        table_row("wall[].motion.piston",
                  "The motion along +x of a paddle that makes a solitary wave (Goring 1978), from "
                  "time 0 on."),
        positive("wall[].motion.piston.solitary_height", "m", "", "Height of the wave."),
        positive("wall[].motion.piston.depth", "m", "", "Depth of the water at rest."),
    };
}

std::vector<Parameter> body_parameters()
{
    std::vector<Parameter> rows = {
        tables_row("body", "A rigid body, such as a timber, a container or a car."),
        text_row("body[].name", "body.1, body.2 ...",
                 "Name in results; unique among walls and bodies."),
        choice_row(
            "body[].shape", {"box", "sphere", "cylinder", "mesh", "particles"}, required,
            "box: size; sphere: radius, a disc in 2-D; cylinder: radius and length along its x "
            "axis, a rectangle in 2-D; mesh: a closed surface from a file; particles: an aggregate "
            "of cubes of body.spacing about the points of a file, in 3-D."),
        vector_row("body[].size", "m", "", "Edge lengths of a box."),
        positive("body[].radius", "m", "", "Radius of a sphere or cylinder."),
        positive("body[].length", "m", "", "Length of a cylinder."),
        text_row("body[].file", "",
                 "STL or OBJ file of a mesh, or text file of particle centres (x, y, z in m, one a "
                 "line), relative to the case file."),
        positive("body[].scale", "", "1", "Factor on the numbers of a mesh file, to metres."),
        positive("body[].density", "kg/m3", "", "Density; give it or the mass."),
        positive("body[].mass", "kg", "",
                 "Mass, per metre of width in 2-D; give it or the density."),
        vector_row("body[].position", "m", required, "Centre of mass at the start."),
        table_row("body[].rotation_deg", "Rotation about the centre of mass at the start."),
        vector_row("body[].rotation_deg.axis", "", "[0.0, 1.0, 0.0] in 2-D, else required",
                   "Axis of rotation, of any length."),
        any_number("body[].rotation_deg.angle", "deg", required,
                   "Angle of rotation, by the right-hand rule."),
        quaternion_row("body[].rotation"),
        vector_row("body[].velocity", "m/s", "[0.0, 0.0, 0.0]", "Velocity at the start."),
        vector_row("body[].angular_velocity", "rad/s", "[0.0, 0.0, 0.0]",
                   "Angular velocity at the start, about the axes of the world."),
        positive("body[].spacing", "m", "particles.spacing",
                 "Distance between the body's own particles, which feel the fluid."),
        text_row("body[].material", "", "Name of its material, for contact.pair."),
        {.key = "body[].fixed",
         .kind = ValueKind::boolean,
         .fallback = "false",
         .meaning = "Whether the body is held where it is."},
        choice_row("body[].stands", {"open", "sealed"}, "open",
                   "Whether water gets into the joint between the body and what it stands on. "
                   "\"open\": it seeps in from the rim and lifts the body; \"sealed\": the joint "
                   "stays dry, as under a body that is glued or sunk into the ground."),
        texts_row("body[].locks", {"x", "y", "z", "rx", "ry", "rz"}, "[]",
                  "Directions of the world in which the body cannot move (x, y, z) or turn (rx, "
                  "ry, rz)."),
    };
    for (Parameter& row : copies_parameters()) {
        rows.push_back(std::move(row));
    }
    return rows;
}

std::vector<Parameter> contact_parameters()
{
    Parameter materials = texts_row("contact.pair[].materials", {}, required,
                                    "The two materials, as walls and bodies name them.");
    materials.shortest = materials.longest = 2;
    return {
        table_row("contact", "How bodies hit each other and the walls."),
        choice_row("contact.method", {"impulse", "penalty"}, "impulse",
                   "\"impulse\" solves for the impulses that keep bodies apart, with friction; "
                   "\"penalty\" puts springs between particles, the baseline to compare with."),
        choice_row("contact.law", {"coupled", "paper", "simultaneous"}, "coupled",
                   "What an impact does, by the impulse method. \"coupled\": all contacts that "
                   "approach together, round after round, with the circular Coulomb cone; "
                   "\"paper\": the uncoupled equations (1)-(6) of the Iwate paper, which can gain "
                   "energy; \"simultaneous\": all touching contacts at once (Moreau)."),
        not_negative("contact.locating_share", "", "0.2",
                     "Part of the fluid's cost that locating impacts in time may take in a step, "
                     "by the impulse method, beside a small allowance for each body. Beyond it "
                     "the bodies with most impacts are advanced without location first; "
                     "contacts.csv says of each contact whether it was located."),
        fraction(
            "contact.restitution", "0.4",
            "Part of the approach speed that a pair keeps after an impact, unless contact.pair "
            "names the pair. The penalty method has no use for it: there it follows from stiffness "
            "and damping."),
        not_negative("contact.friction", "", "0.3",
                     "Dynamic friction coefficient, unless contact.pair names the pair."),
        table_row("contact.penalty", "The penalty method, with method = \"penalty\"."),
        positive("contact.penalty.stiffness", "N/m", "1000",
                 "Stiffness of a pair of particles; in 2-D per metre of width."),
        not_negative("contact.penalty.damping", "N s/m", "0.2171",
                     "Damping of a pair of particles along the line between them, and across it up "
                     "to the friction; in 2-D per metre of width."),
        positive("contact.penalty.step", "s", "1e-5",
                 "Longest sub-step of the explicit integration; a step of the bodies is split into "
                 "equal ones."),
        tables_row("contact.pair", "The contact of two materials."),
        std::move(materials),
        fraction("contact.pair[].restitution", "contact.restitution",
                 "Part of the approach speed that the pair keeps after an impact."),
        not_negative("contact.pair[].friction", "", "contact.friction",
                     "Dynamic friction coefficient of the pair."),
        positive("contact.pair[].stiffness", "N/m", "",
                 "Contact stiffness, used only by the impact force formulae of the report."),
    };
}

} // namespace hyoryu
