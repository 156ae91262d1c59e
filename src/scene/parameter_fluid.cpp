// SPDX-License-Identifier: MIT
// The keys of the fluid.
#include "parameter_table.hpp"

namespace hyoryu {

namespace {

Parameter smoothing_row()
{
    Parameter row =
        positive("fluid.smoothing_ratio", "", "1.5",
                 "Smoothing length over particle spacing: more is smoother and slower.");
    row.bounds = "1.2 .. 2.0";
    row.minimum = 1.2;
    row.maximum = 2.0;
    row.minimum_excluded = false;
    return row;
}

Parameter void_pressure_row()
{
    Parameter row =
        any_number("fluid.cavitation.pressure", "Pa", "0",
                   "Pressure of the void over that of the air: 0 where there is no air, about "
                   "-99000 for water under the atmosphere.");
    row.bounds = "<= 0";
    row.maximum = 0;
    return row;
}

Parameter velocity_field_row()
{
    Parameter row =
        texts_row("fluid.block[].velocity_field", {}, "[]",
                  "Velocity at the start where it is not the same everywhere: three expressions of "
                  "x, y and z in metres that give m/s, for instance [\"-2*x\", \"0\", \"2*z\"].");
    row.shortest = row.longest = 3;
    return row;
}

std::vector<Parameter> model_parameters()
{
    return {
        table_row("fluid", "The water; without this table no fluid is simulated at all."),
        positive("fluid.density", "kg/m3", "1000", "Density of the fluid at rest."),
        choice_row("fluid.formulation", {"sph", "mps"}, "sph",
                   "How the fluid is solved: \"sph\" is weakly compressible SPH, \"mps\" weakly "
                   "compressible MPS."),
        positive(
            "fluid.sound_speed", "m/s", "",
            "Artificial speed of sound; without it ten times the largest speed that the scene lets "
            "expect, which keeps density within 1 % of that at rest."),
        smoothing_row(),
        table_row("fluid.viscosity", "Internal friction of the fluid."),
        choice_row("fluid.walls", {"free_slip", "no_slip"}, "free_slip",
                   "Along walls and bodies the fluid slips freely, or it sticks to them by its "
                   "viscosity."),
        vector_row("fluid.acceleration", "m/s2", "[0.0, 0.0, 0.0]",
                   "What drives the fluid besides gravity, for instance the pressure gradient of a "
                   "channel, over the density: walls and bodies do not feel it as a pressure."),
        choice_row("fluid.viscosity.model", {"artificial", "laminar", "sps", "none"}, "artificial",
                   "\"artificial\" damps with `alpha`, \"laminar\" takes a physical viscosity "
                   "(`kinematic`), \"sps\" adds an eddy viscosity to that, \"none\" is inviscid."),
        not_negative(
            "fluid.viscosity.alpha", "", "0.02",
            "Coefficient of the artificial viscosity; 0.01 to 0.1 for dam breaks and bores."),
        not_negative("fluid.viscosity.kinematic", "m2/s", "1e-6",
                     "Kinematic viscosity of the laminar model; 1e-6 m2/s is water at 20 degrees."),
        choice_row(
            "fluid.viscosity.form", {"central", "morris"}, "central",
            "Of the laminar model. \"central\" acts along the line between particles and is "
            "right at free surfaces; \"morris\" is exact in a shear along rows of particles, "
            "for flows between walls."),
        not_negative("fluid.viscosity.smagorinsky", "", "0.12",
                     "Cs of \"sps\": eddies have the length Cs times the particle spacing."),
        table_row("fluid.density_diffusion",
                  "Smoothing of density, which keeps pressure free of noise."),
        choice_row("fluid.density_diffusion.model", {"fourtakas", "molteni", "antuono", "none"},
                   "fourtakas",
                   "\"fourtakas\" corrects for the hydrostatic part and suits deep still water, "
                   "\"molteni\" does not, \"antuono\" corrects for any gradient by two sums more, "
                   "\"none\" switches it off."),
        not_negative("fluid.density_diffusion.delta", "", "0.1",
                     "Coefficient of the density diffusion."),
        table_row("fluid.shifting", "Evening out of the particles' places."),
        choice_row("fluid.shifting.model", {"none", "sun"}, "none",
                   "\"sun\" moves particles from where they are dense, for flows without a free "
                   "surface, which it would make swell; \"none\" switches it off."),
        not_negative("fluid.shifting.coefficient", "", "8",
                     "Strength of the shifting: C in -C h |v|max dt times the crowding."),
        table_row("fluid.collision", "Collisions of fluid particles, for splashes."),
        choice_row("fluid.collision.model", {"none", "dynamic"}, "none",
                   "\"dynamic\" stops fluid particles that approach each other closer than a "
                   "spacing, which calms splashes and takes energy; \"none\" switches it off."),
        fraction("fluid.collision.restitution", "0",
                 "Share of their approach that they fly apart with."),
        table_row("fluid.cavitation", "Voids that open where the fluid is pulled."),
        choice_row("fluid.cavitation.model", {"none", "void"}, "none",
                   "\"void\" lets a void open where the pressure would fall below that of the "
                   "void, as in a closed tank that is shaken; \"none\": the fluid bears tension."),
        void_pressure_row(),
    };
}

} // namespace

std::vector<Parameter> fluid_parameters()
{
    std::vector<Parameter> rows = model_parameters();
    const std::vector<Parameter> blocks = {
        tables_row("fluid.block", "A region filled with fluid at the start."),
        choice_row(
            "fluid.block[].shape", {"box", "sphere", "cylinder", "mesh"}, required,
            "box: min and max, or size and position; sphere: radius; cylinder: radius and length "
            "along x before rotation; mesh: a closed surface from a file."),
        vector_row("fluid.block[].min", "m", "", "Lower corner of a box."),
        vector_row("fluid.block[].max", "m", "", "Upper corner of a box."),
        vector_row("fluid.block[].size", "m", "", "Edge lengths of a box, instead of min and max."),
        vector_row("fluid.block[].position", "m", "",
                   "Centre of the shape; of a mesh where its file's origin goes."),
        positive("fluid.block[].radius", "m", "", "Radius of a sphere or cylinder."),
        positive("fluid.block[].length", "m", "", "Length of a cylinder."),
        text_row("fluid.block[].file", "", "STL or OBJ file of a mesh, relative to the case file."),
        positive("fluid.block[].scale", "", "1",
                 "Factor on the numbers of a mesh file, to metres."),
        table_row("fluid.block[].rotation_deg", "Rotation about the centre of the shape."),
        vector_row("fluid.block[].rotation_deg.axis", "", "[0.0, 1.0, 0.0] in 2-D, else required",
                   "Axis of rotation, of any length."),
        any_number("fluid.block[].rotation_deg.angle", "deg", required,
                   "Angle of rotation, by the right-hand rule."),
        {.key = "fluid.block[].rotation",
         .kind = ValueKind::vector,
         .meaning = "The rotation as a unit quaternion [w, x, y, z], instead of rotation_deg.",
         .shortest = 4,
         .longest = 4},
        {.key = "fluid.block[].layers",
         .kind = ValueKind::boolean,
         .fallback = "false",
         .meaning =
             "Whether the particles of a sphere or cylinder are in layers below its surface, "
             "as those of bodies, instead of on a lattice."},
        vector_row("fluid.block[].velocity", "m/s", "[0.0, 0.0, 0.0]", "Velocity at the start."),
        velocity_field_row(),
        text_row(
            "fluid.block[].pressure_field", "",
            "Pressure at the start above the hydrostatic one, in Pa: an expression of x, y and "
            "z in metres."),
    };
    rows.insert(rows.end(), blocks.begin(), blocks.end());
    return rows;
}

} // namespace hyoryu
