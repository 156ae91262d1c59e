// SPDX-License-Identifier: MIT
// The keys of the fluid.
#pragma once

#include "keys_shapes.hpp"

#include "hyoryu/scene/formula.hpp"

namespace hyoryu {

inline constexpr auto set_if = [](TableReader& /*table*/, bool on, double value,
                                  std::optional<double>& member) {
    if (on) {
        member = value;
    }
};
inline constexpr auto forget_if_mistaken = [](TableReader& table, std::string_view key,
                                              auto& member, auto none) {
    if (table.has(key) && !table.sound(key)) {
        member = none;
    }
};

// An expression of the place alone.
inline void check_field(TableReader& table, std::string_view key, const std::string& text)
{
    try {
        const Formula formula(text);
        for (const std::string& name : formula.names()) {
            if (name != "x" && name != "y" && name != "z") {
                table.error(key, fmt::format("nothing is named \"{}\" in \"{}\"", name, text),
                            "there are x, y and z, in metres");
            }
        }
    } catch (const FormulaError& fault) {
        table.error(key, fault.what());
    }
}

inline void check_slip(TableReader& table, const FluidSettings& fluid)
{
    if (fluid.sticks && fluid.viscosity == ViscosityModel::none) {
        table.error("walls", "has no meaning without viscosity",
                    "give `fluid.viscosity` another model than \"none\"");
    }
}

inline void check_shifting(TableReader& table, const FluidSettings& fluid)
{
    if (fluid.shifting && fluid.formulation == FormulationKind::mps) {
        table.error("model", "is written for the kernel of SPH",
                    "leave shifting out with formulation = \"mps\"");
    }
}

inline void check_fields(TableReader& table, const FluidBlock& block)
{
    for (const std::string& text : block.velocity_field) {
        check_field(table, "velocity_field", text);
    }
    if (!block.pressure_field.empty()) {
        check_field(table, "pressure_field", block.pressure_field);
    }
    if (table.has("velocity") && table.has("velocity_field")) {
        table.error("velocity", "stands beside `velocity_field`", "give one of them");
    }
}

inline void expect_block(TableReader& table)
{
    if (!table.has("block")) {
        table.error("block", "is missing: a fluid needs a region that it fills at the start",
                    "add [[fluid.block]], or leave [fluid] out for a case without fluid");
    }
}

void viscosity_keys(auto& keys, Is<FluidSettings> auto& fluid)
{
    keys.choice("model", fluid.viscosity, {"artificial", "laminar", "sps", "none"},
                "\"artificial\" damps with `alpha`, \"laminar\" takes a physical viscosity "
                "(`kinematic`), \"sps\" adds an eddy viscosity to that, \"none\" is inviscid.");
    keys.rule(forget_if_mistaken, "model", fluid.viscosity, ViscosityModel::none);
    const auto is = [&](ViscosityModel model) { return fluid.viscosity == model; };
    if (keys.applies(is(ViscosityModel::artificial))) {
        keys.not_negative(
            "alpha", fluid.alpha, "",
            "Coefficient of the artificial viscosity; 0.01 to 0.1 for dam breaks and bores.");
    }
    if (keys.applies(is(ViscosityModel::laminar) || is(ViscosityModel::sps))) {
        keys.not_negative(
            "kinematic", fluid.kinematic_viscosity, "m2/s",
            "Kinematic viscosity of the laminar model; 1e-6 m2/s is water at 20 degrees.");
    }
    if (keys.applies(is(ViscosityModel::laminar))) {
        keys.choice("form", fluid.morris, {"central", "morris"},
                    "Of the laminar model. \"central\" acts along the line between particles and "
                    "is right at free surfaces; \"morris\" is exact in a shear along rows of "
                    "particles, for flows between walls.");
    }
    if (keys.applies(is(ViscosityModel::sps))) {
        keys.not_negative("smagorinsky", fluid.smagorinsky, "",
                          "Cs of \"sps\": eddies have the length Cs times the particle spacing.");
    }
}

void diffusion_keys(auto& keys, Is<FluidSettings> auto& fluid)
{
    keys.choice("model", fluid.diffusion, {"fourtakas", "molteni", "antuono", "none"},
                "\"fourtakas\" corrects for the hydrostatic part and suits deep still water, "
                "\"molteni\" does not, \"antuono\" corrects for any gradient by two sums more, "
                "\"none\" switches it off.");
    keys.rule(forget_if_mistaken, "model", fluid.diffusion, DiffusionModel::none);
    if (keys.applies(fluid.diffusion != DiffusionModel::none)) {
        keys.not_negative("delta", fluid.delta, "", "Coefficient of the density diffusion.");
    }
}

void shifting_keys(auto& keys, Is<FluidSettings> auto& fluid)
{
    bool on = fluid.shifting.has_value();
    double coefficient = fluid.shifting.value_or(8);
    keys.choice("model", on, {"none", "sun"},
                "\"sun\" moves particles from where they are dense, for flows without a free "
                "surface, which it would make swell; \"none\" switches it off.");
    if (keys.applies(on)) {
        keys.not_negative("coefficient", coefficient, "",
                          "Strength of the shifting: C in -C h |v|max dt times the crowding.");
    }
    keys.rule(set_if, on, coefficient, fluid.shifting);
    keys.rule(check_shifting, fluid);
}

void collision_keys(auto& keys, Is<FluidSettings> auto& fluid)
{
    bool on = fluid.collision.has_value();
    double restitution = fluid.collision.value_or(0);
    keys.choice("model", on, {"none", "dynamic"},
                "\"dynamic\" stops fluid particles that approach each other closer than a "
                "spacing, which calms splashes and takes energy; \"none\" switches it off.");
    if (keys.applies(on)) {
        keys.fraction("restitution", restitution,
                      "Share of their approach that they fly apart with.");
    }
    keys.rule(set_if, on, restitution, fluid.collision);
}

void cavitation_keys(auto& keys, Is<FluidSettings> auto& fluid)
{
    bool on = fluid.cavitation.has_value();
    double pressure = fluid.cavitation.value_or(0);
    keys.choice("model", on, {"none", "void"},
                "\"void\" lets a void open where the pressure would fall below that of the void, "
                "as in a closed tank that is shaken; \"none\": the fluid bears tension.");
    if (keys.applies(on)) {
        keys.not_positive("pressure", pressure, "Pa",
                          "Pressure of the void over that of the air: 0 where there is no air, "
                          "about -99000 for water under the atmosphere.");
    }
    keys.rule(set_if, on, pressure, fluid.cavitation);
}

void effect_keys(auto& keys, Is<FluidSettings> auto& fluid)
{
    const auto table = [&](std::string_view name, std::string_view meaning, auto&& what) {
        keys.effect(name, meaning, [&](auto& inside) { what(inside, fluid); });
    };
    table("viscosity", "Internal friction of the fluid.",
          [](auto& inside, auto& f) { viscosity_keys(inside, f); });
    keys.rule(check_slip, fluid);
    table("density_diffusion", "Smoothing of density, which keeps pressure free of noise.",
          [](auto& inside, auto& f) { diffusion_keys(inside, f); });
    table("shifting", "Evening out of the particles' places.",
          [](auto& inside, auto& f) { shifting_keys(inside, f); });
    table("collision", "Collisions of fluid particles, for splashes.",
          [](auto& inside, auto& f) { collision_keys(inside, f); });
    table("cavitation", "Voids that open where the fluid is pulled.",
          [](auto& inside, auto& f) { cavitation_keys(inside, f); });
}

void keys_of(auto& keys, Is<FluidBlock> auto& block)
{
    std::size_t kind = block.shape.index();
    const bool known = keys.alternatives(
        "shape", kind, {"box", "sphere", "cylinder", "mesh"},
        "box: min and max, or size and position; sphere: radius; cylinder: radius and length "
        "along x before rotation; mesh: a closed surface from a file.",
        required, [&](std::size_t k) {
            keys.select(block.shape, k);
            placed_keys(keys, block.shape, block.centre,
                        {"Lower corner of a box.", "Upper corner of a box.",
                         "Edge lengths of a box, instead of min and max.",
                         "Radius of a sphere or cylinder.", "Length of a cylinder.",
                         "STL or OBJ file of a mesh, relative to the case file."});
        });
    if (known) {
        rotation_keys(keys, block.rotation, "Rotation about the centre of the shape.");
    }
    const bool round = std::holds_alternative<SphereShape>(block.shape) ||
                       std::holds_alternative<CylinderShape>(block.shape);
    if (keys.applies(known && round) && keys.shows(block.layers)) {
        keys.flag("layers", block.layers,
                  "Whether the particles of a sphere or cylinder are in layers below its surface, "
                  "as those of bodies, instead of on a lattice.");
    }
    if (keys.shows(block.velocity_field.empty())) {
        keys.planar("velocity", block.velocity, "m/s", "Velocity at the start.");
    }
    if (keys.shows(!block.velocity_field.empty())) {
        keys.text_list(
            "velocity_field", block.velocity_field, 3,
            "Velocity at the start where it is not the same everywhere: three expressions "
            "of x, y and z in metres that give m/s, for instance [\"-2*x\", \"0\", "
            "\"2*z\"].");
    }
    if (keys.shows(!block.pressure_field.empty())) {
        keys.text("pressure_field", block.pressure_field,
                  "Pressure at the start above the hydrostatic one, in Pa: an expression of x, y "
                  "and z in metres.");
    }
    keys.rule(check_fields, block);
}

void keys_of(auto& keys, Is<FluidSettings> auto& fluid)
{
    keys.positive("density", fluid.density, "kg/m3", "Density of the fluid at rest.");
    keys.choice("formulation", fluid.formulation, {"sph", "mps"},
                "How the fluid is solved: \"sph\" is weakly compressible SPH, \"mps\" weakly "
                "compressible MPS.");
    keys.positive("sound_speed", fluid.sound_speed, "m/s",
                  "Artificial speed of sound; without it ten times the largest speed that the "
                  "scene lets expect, which keeps density within 1 % of that at rest.");
    constexpr double least = 1.2;
    constexpr double most = 2.0;
    keys.between("smoothing_ratio", fluid.smoothing_ratio, least, most, "1.2 .. 2.0",
                 "Smoothing length over particle spacing: more is smoother and slower.");
    keys.heading("viscosity", "Internal friction of the fluid.");
    keys.choice("walls", fluid.sticks, {"free_slip", "no_slip"},
                "Along walls and bodies the fluid slips freely, or it sticks to them by its "
                "viscosity.");
    keys.planar("acceleration", fluid.acceleration, "m/s2",
                "What drives the fluid besides gravity, for instance the pressure gradient of a "
                "channel, over the density: walls and bodies do not feel it as a pressure.");
    effect_keys(keys, fluid);
    keys.tables("block", "A region filled with fluid at the start.", fluid.blocks);
    keys.rule(expect_block);
}

} // namespace hyoryu
