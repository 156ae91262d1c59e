// SPDX-License-Identifier: MIT
// The keys of the fluid.
#pragma once

#include "keys_shapes.hpp"

#include "hyoryu/scene/formula.hpp"

namespace hyoryu {

// An expression of the place alone.
inline void check_field(TableReader& table, std::string_view key, const std::string& text)
{
    try {
        const Formula formula(text);
        for (const std::string& name : formula.names()) {
            if (name != "x" && name != "y" && name != "z") {
                table.error(key, fmt::format("unknown name \"{}\" in \"{}\"", name, text),
                            "known: x, y and z, in metres");
            }
        }
    } catch (const FormulaError& fault) {
        table.error(key, fault.what());
    }
}

inline void check_slip(TableReader& table, const FluidSettings& fluid)
{
    if (fluid.walls.sticks && std::holds_alternative<Off>(fluid.effects[slot::viscosity])) {
        table.error("walls", "has no meaning without viscosity",
                    "give `fluid.viscosity` another model than \"none\"");
    }
}

// Of a key that is `used` with a value for SPH alone. `what` to leave out and `why`, for the hint.
inline void expect_sph(TableReader& table, std::string_view key, bool used,
                       FormulationKind formulation, std::string_view what, std::string_view why)
{
    if (used && formulation == FormulationKind::mps) {
        table.error(key, "is available for SPH only",
                    fmt::format("leave {} out with formulation = \"mps\"{}", what, why));
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
        table.error("velocity", "is given together with `velocity_field`", "give one of them");
    }
}

inline void expect_block(TableReader& table)
{
    if (!table.has("block")) {
        table.error("block", "is missing: a fluid needs an initial region",
                    "add [[fluid.block]], or omit [fluid] for a case without fluid");
    }
}

/// The models of a slot, by their names in the case.
template <class... Models>
std::vector<std::string_view> model_names(const std::variant<Models...>& /*choice*/)
{
    const auto name = []<class Model>() -> std::string_view {
        if constexpr (std::same_as<Model, Off>) {
            return "none";
        } else {
            return Model::model;
        }
    };
    return {name.template operator()<Models>()...};
}

/// The descriptions of the models of a slot, joined to one sentence.
template <class... Models>
std::string_view models_text(const SlotTable& table, const std::variant<Models...>& /*choice*/)
{
    static const std::string text = [&] {
        std::string all;
        const auto add = [&]<class Model>() {
            if constexpr (!std::same_as<Model, Off>) {
                all +=
                    fmt::format("{}\"{}\" {}", all.empty() ? "" : ", ", Model::model, Model::says);
            }
        };
        (add.template operator()<Models>(), ...);
        return all.append(table.none);
    }();
    return text;
}

/// The model of a slot with its keys.
void model_keys(auto& keys, const SlotTable& table, auto& choice, FormulationKind formulation)
{
    std::size_t index = choice.index();
    const auto declare = [&]<class Model>(Model& model) {
        if constexpr (!std::same_as<std::remove_const_t<Model>, Off>) {
            Model::keys(keys, model);
        }
        if constexpr (requires { Model::for_sph_alone; }) {
            keys.rule(expect_sph, "model", true, formulation, table.key, "");
        }
    };
    keys.alternatives("model", index, model_names(choice), models_text(table, choice), {},
                      [&](std::size_t k) {
                          keys.select(choice, k);
                          std::visit(declare, choice);
                      });
}

inline void set_seed(TableReader& table, const std::vector<double>& seed, SeededWater& water)
{
    const std::size_t count = table.reading().dimensions == 2 ? 1 : 2;
    if (table.sound("seed") && seed.size() != count) {
        table.error("seed",
                    fmt::format("expected {}, found {} numbers",
                                count == 1 ? "[x] in two dimensions" : "[x, y]", seed.size()));
    } else if (table.sound("seed")) {
        water.seed = {seed[0], count == 2 ? seed[1] : 0, 0};
    }
}

/// Water at rest about a seed; `block.seeded` is there.
void still_water_keys(auto& keys, Is<SeededWater> auto& water, int dimensions)
{
    std::vector<double> seed{water.seed.x()};
    if (dimensions == 3) {
        seed.push_back(water.seed.y());
    }
    keys.number("level", water.level, "m", "z of the free surface of still water.", needed);
    keys.plan_place("seed", seed,
                    "A point under still water, [x, y], or [x] in two dimensions. All space that "
                    "is connected with it below the level and outside of walls is filled.");
    keys.rule(set_seed, seed, water);
}

void keys_of(auto& keys, Is<FluidBlock> auto& block, const Scene& scene)
{
    constexpr std::size_t still_water = 4;
    std::size_t kind = block.seeded ? still_water : block.shape.index();
    const bool known = keys.alternatives(
        "shape", kind, {"box", "sphere", "cylinder", "mesh", "still_water"},
        "Shape of the region. \"box\": min and max, or size and position; \"sphere\": radius; "
        "\"cylinder\": radius and length along x before rotation; \"mesh\": a closed surface from "
        "a file; \"still_water\": level and seed.",
        required, [&](std::size_t k) {
            if (k == still_water) {
                if constexpr (!std::is_const_v<std::remove_reference_t<decltype(block)>>) {
                    block.seeded.emplace();
                }
                still_water_keys(keys, *block.seeded, scene.dimensions);
                return;
            }
            keys.select(block.shape, k);
            placed_keys(keys, block.shape, block.centre,
                        {"Lower corner of a box.", "Upper corner of a box.",
                         "Edge lengths of a box, instead of min and max.",
                         "Radius of a sphere or cylinder.", "Length of a cylinder.",
                         "STL or OBJ file of a mesh, relative to the case file."});
        });
    if (known && keys.applies(kind != still_water)) {
        rotation_keys(keys, block.rotation, "Rotation about the centre of the shape.");
    }
    const bool round = std::holds_alternative<SphereShape>(block.shape) ||
                       std::holds_alternative<CylinderShape>(block.shape);
    if (keys.applies(known && round) && keys.shows(block.layers)) {
        keys.flag("layers", block.layers,
                  "Whether the particles of a sphere or cylinder are arranged in layers below its "
                  "surface, as the particles of bodies are, instead of on a lattice.");
    }
    if (keys.shows(block.velocity_field.empty())) {
        keys.planar("velocity", block.velocity, "m/s", "Initial velocity.");
    }
    if (keys.shows(!block.velocity_field.empty())) {
        keys.text_list("velocity_field", block.velocity_field, 3,
                       "Initial velocity field: three expressions in x, y and z [m] for the "
                       "velocity components [m/s], for instance [\"-2*x\", \"0\", \"2*z\"].");
    }
    if (keys.shows(!block.pressure_field.empty())) {
        keys.text("pressure_field", block.pressure_field,
                  "Initial pressure in excess of the hydrostatic pressure [Pa]: an expression in "
                  "x, y and z [m].");
    }
    keys.rule(check_fields, block);
}

void keys_of(auto& keys, Is<FluidSettings> auto& fluid, const Scene& scene)
{
    keys.positive("density", fluid.density, "kg/m3", "Density of the fluid at rest.");
    keys.choice("formulation", fluid.formulation, {"sph", "mps"},
                "Discretisation of the fluid: \"sph\" is weakly compressible SPH, \"mps\" weakly "
                "compressible MPS.");
    keys.positive("sound_speed", fluid.sound_speed, "m/s",
                  "Artificial speed of sound. By default it is ten times the largest expected "
                  "speed of the scene, which keeps the density within 1 % of the density at rest.");
    constexpr double least = 1.2;
    constexpr double most = 2.0;
    keys.between(
        "smoothing_ratio", fluid.smoothing_ratio, least, most, "1.2 .. 2.0",
        "Ratio of smoothing length to particle spacing; a larger ratio is smoother and slower.");
    keys.choice("kernel", fluid.kernel, {"wendland", "isotropic"},
                "Kernel of the SPH gradients. \"isotropic\": the pressure remains isotropic when "
                "waves and flows strain the particle arrangement, so that wave propagation is more "
                "accurate; time steps are 6 % shorter.");
    keys.rule(expect_sph, "kernel", fluid.kernel != KernelShape::wendland, fluid.formulation,
              "kernel", ", which has a weight of its own");
    GradientSettings::keys(keys, fluid.gradient);
    keys.rule(expect_sph, "gradient", fluid.gradient.corrected, fluid.formulation, "gradient",
              ", which has the corrected gradient");
    WallContinuitySettings::keys(keys, fluid.continuity);
    // The first slot's table is listed before the other keys of walls.
    keys.heading("viscosity", "Viscosity of the fluid.");
    SlipSettings::keys(keys, fluid.walls);
    keys.planar("acceleration", fluid.acceleration, "m/s2",
                "Driving acceleration of the fluid in addition to gravity, for instance the "
                "pressure gradient of a channel flow divided by the density. It causes no "
                "hydrostatic pressure on walls and bodies.");
    for_each(ModelSlots<AllSlots>{}, [&](auto slot) {
        keys.effect(slot.table.key, slot.table.meaning, [&](auto& inside) {
            model_keys(inside, slot.table, fluid.effects[slot], fluid.formulation);
        });
    });
    keys.rule(check_slip, fluid);
    keys.tables("block", "A region filled with fluid at the start.", fluid.blocks, scene);
    keys.rule(expect_block);
}

} // namespace hyoryu
