// SPDX-License-Identifier: MIT
// The whole case and its fluid.
#include "reader.hpp"

#include "hyoryu/core/name.hpp"
#include "hyoryu/scene/formula.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

// Spacings in the shortest period: 2.5 supports of the widest kernel, 2 h of 2 spacings.
constexpr int least_period = 10;

void read_viscosity(TableReader table, FluidSettings& fluid)
{
    const std::string model = table.choice("model");
    if (model == "artificial") {
        fluid.viscosity = ViscosityModel::artificial;
        fluid.alpha = table.number("alpha");
    } else if (model == "laminar") {
        fluid.viscosity = ViscosityModel::laminar;
        fluid.kinematic_viscosity = table.number("kinematic");
        fluid.morris = table.choice("form") == "morris";
    } else if (model == "sps") {
        fluid.viscosity = ViscosityModel::sps;
        fluid.kinematic_viscosity = table.number("kinematic");
        fluid.smagorinsky = table.number("smagorinsky");
    } else {
        fluid.viscosity = ViscosityModel::none;
    }
    table.finish();
}

// Friction comes from viscosity.
void read_slip(TableReader& table, FluidSettings& fluid)
{
    fluid.sticks = table.choice("walls") == "no_slip";
    if (fluid.sticks && fluid.viscosity == ViscosityModel::none) {
        table.error("walls", "has no meaning without viscosity",
                    "give `fluid.viscosity` another model than \"none\"");
    }
}

void read_collision(TableReader table, FluidSettings& fluid)
{
    if (table.choice("model") == "dynamic") {
        fluid.collision = table.number("restitution");
    }
    table.finish();
}

void read_cavitation(TableReader table, FluidSettings& fluid)
{
    if (table.choice("model") == "void") {
        fluid.cavitation = table.number("pressure");
    }
    table.finish();
}

void read_diffusion(TableReader table, FluidSettings& fluid)
{
    const std::string model = table.choice("model");
    fluid.diffusion = model == "fourtakas" ? DiffusionModel::fourtakas
                      : model == "molteni" ? DiffusionModel::molteni
                      : model == "antuono" ? DiffusionModel::antuono
                                           : DiffusionModel::none;
    if (fluid.diffusion != DiffusionModel::none) {
        fluid.delta = table.number("delta");
    }
    table.finish();
}

// An expression of the place alone.
void check_field(TableReader& table, std::string_view key, const std::string& text)
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

FluidBlock read_block(TableReader& table)
{
    FluidBlock block;
    block.place = table.place();
    const std::string kind = table.choice("shape");
    if (!kind.empty()) {
        const PlacedShape placed = read_placed_shape(table, kind);
        block.shape = placed.shape;
        block.centre = placed.centre;
        block.rotation = placed.rotation;
    }
    if (kind == "sphere" || kind == "cylinder") {
        block.layers = table.flag("layers");
    }
    block.velocity = table.planar("velocity");
    block.velocity_field = table.texts("velocity_field");
    block.pressure_field = table.text("pressure_field");
    for (const std::string& text : block.velocity_field) {
        check_field(table, "velocity_field", text);
    }
    if (!block.pressure_field.empty()) {
        check_field(table, "pressure_field", block.pressure_field);
    }
    if (table.has("velocity") && table.has("velocity_field")) {
        table.error("velocity", "stands beside `velocity_field`", "give one of them");
    }
    table.finish();
    return block;
}

void read_time(TableReader table, Scene& scene)
{
    scene.time.end = table.number("end");
    scene.time.step = table.find_number("step");
    scene.time.cfl = table.number("cfl");
    scene.time.recover = table.flag("recover");
    if (scene.time.recover && scene.time.step) {
        table.error("recover", "has no meaning beside a fixed `time.step`",
                    "leave `time.step` out for an adaptive step, which can be halved");
    }
    if (scene.time.step && scene.time.end > 0 && *scene.time.step > scene.time.end) {
        table.error("step", fmt::format("{} s is longer than the run of {} s", *scene.time.step,
                                        scene.time.end));
    }
    table.finish();
}

// A period holds a whole number of spacings, so that the lattice of the start goes on across it,
// and a tile of the neighbour search (see `tile_ratio`), below which a particle would meet its own
// image.
void check_period(TableReader& table, const Scene& scene, int axis, std::string_view name)
{
    const double length = scene.domain->max[axis] - scene.domain->min[axis];
    const double cells = length / scene.spacing;
    if (!(length > 0 && scene.spacing > 0)) {
        return; // already an error
    }
    if (std::abs(cells - std::round(cells)) > 1e-6 * cells) {
        table.error("periodic",
                    fmt::format("along {} the domain is {:.6g} spacings long", name, cells),
                    "a period must be a whole number of `particles.spacing`");
    }
    if (cells < least_period) {
        table.error("periodic",
                    fmt::format("along {} the domain is {:.6g} spacings long", name, cells),
                    fmt::format("a period must be at least {} spacings", least_period));
    }
    if (scene.gravity[axis] != 0) {
        table.error("periodic", fmt::format("`gravity` points along {}", name),
                    "what falls without end has no hydrostatic pressure; turn one of them");
    }
}

void read_periods(TableReader& table, Scene& scene)
{
    constexpr std::array<std::string_view, 3> axes{"x", "y", "z"};
    for (const std::string& name : table.texts("periodic")) {
        const auto found = std::find(axes.begin(), axes.end(), name);
        const bool flat = scene.dimensions == 2 && name == "y";
        if (found == axes.end() || flat) {
            table.error("periodic", fmt::format("\"{}\" is no direction of this case", name),
                        scene.dimensions == 2 ? "there are \"x\" and \"z\""
                                              : "there are \"x\", \"y\" and \"z\"");
            continue;
        }
        const auto axis = static_cast<std::size_t>(found - axes.begin());
        scene.domain->periodic[axis] = true;
        check_period(table, scene, static_cast<int>(axis), name);
    }
}

void read_domain(TableReader table, Scene& scene)
{
    if (!table.present()) {
        return;
    }
    const auto low = table.find_planar("min");
    const auto high = table.find_planar("max");
    scene.domain = DomainSettings{low.value_or(Vec3(0, 0, 0)), high.value_or(Vec3(0, 0, 0))};
    if (low && high) {
        const Vec3 size = *high - *low;
        const bool flat = scene.dimensions == 2;
        if (!(size.x() > 0 && size.z() > 0 && (flat || size.y() > 0))) {
            table.error("max", "must lie above `min` in every direction");
        }
    }
    read_periods(table, scene);
    table.finish();
}

} // namespace

void read_general(TableReader& root, Scene& scene)
{
    scene.title = root.text("title");
    if (const std::string fault = label_fault(scene.title); !fault.empty()) {
        root.error("title", "cannot be shown: " + fault, "one line of plain text");
    }
    scene.gravity = root.planar("gravity");
    scene.seed = static_cast<std::uint64_t>(root.integer("seed"));
    read_time(root.table("time"), scene);
    TableReader particles = root.table("particles");
    scene.spacing = particles.number("spacing");
    scene.precision = particles.choice("precision") == "double" ? Precision::double_precision
                                                                : Precision::single_precision;
    particles.finish();
    read_domain(root.table("domain"), scene);
}

void read_fluid(TableReader table, Scene& scene)
{
    if (!table.present()) {
        return;
    }
    FluidSettings fluid;
    fluid.density = table.number("density");
    fluid.formulation =
        table.choice("formulation") == "mps" ? FormulationKind::mps : FormulationKind::sph;
    fluid.sound_speed = table.find_number("sound_speed");
    fluid.smoothing_ratio = table.number("smoothing_ratio");
    read_viscosity(table.table("viscosity"), fluid);
    read_slip(table, fluid);
    fluid.acceleration = table.planar("acceleration");
    read_diffusion(table.table("density_diffusion"), fluid);
    read_collision(table.table("collision"), fluid);
    read_cavitation(table.table("cavitation"), fluid);
    TableReader shifting = table.table("shifting");
    if (shifting.choice("model") == "sun") {
        fluid.shifting = shifting.number("coefficient");
        if (fluid.formulation == FormulationKind::mps) {
            shifting.error("model", "is written for the kernel of SPH",
                           "leave shifting out with formulation = \"mps\"");
        }
    }
    shifting.finish();
    for (TableReader& block : table.tables("block")) {
        fluid.blocks.push_back(read_block(block));
    }
    if (!table.has("block")) {
        table.error("block", "is missing: a fluid needs a region that it fills at the start",
                    "add [[fluid.block]], or leave [fluid] out for a case without fluid");
    }
    table.finish();
    scene.fluid = std::move(fluid);
}

} // namespace hyoryu
