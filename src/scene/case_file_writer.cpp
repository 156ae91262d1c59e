// SPDX-License-Identifier: MIT
// A scene as a case file with every default written out, in numbers that read back bit by bit.
#include "hyoryu/scene/case_file.hpp"

#include "hyoryu/scene/shapes.hpp"

#include <fmt/format.h>

namespace hyoryu {

namespace {

/// The shortest text that reads back as the same double, with a point or exponent so that TOML
/// takes it for a number with a sign of zero.
std::string toml(double value)
{
    std::string text = fmt::format("{}", value);
    return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

std::string toml(bool value)
{
    return value ? "true" : "false";
}

std::string toml(const std::string& text)
{
    std::string quoted = "\"";
    for (const char c : text) {
        const auto code = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\') {
            quoted += '\\';
            quoted += c;
        } else if (code < ' ' || code == 127) {
            quoted += fmt::format("\\u{:04X}", static_cast<int>(code));
        } else {
            quoted += c;
        }
    }
    return quoted + '"';
}

std::string toml(const Vec3& v)
{
    return fmt::format("[{}, {}, {}]", toml(v.x()), toml(v.y()), toml(v.z()));
}

std::string toml(const Quat& q)
{
    return fmt::format("[{}, {}, {}, {}]", toml(q.w()), toml(q.x()), toml(q.y()), toml(q.z()));
}

std::string toml(const std::vector<std::string>& texts)
{
    std::string list;
    for (const std::string& text : texts) {
        list += (list.empty() ? "" : ", ") + toml(text);
    }
    return "[" + list + "]";
}

template <class T>
std::string line(std::string_view key, const T& value)
{
    return fmt::format("{} = {}\n", key, toml(value));
}

template <class T>
std::string line(std::string_view key, const std::optional<T>& value)
{
    return value ? line(key, *value) : std::string();
}

/// The names whose flag is set.
std::vector<std::string> named(const std::array<bool, 6>& flags,
                               const std::array<const char*, 6>& names)
{
    std::vector<std::string> set;
    for (std::size_t k = 0; k < flags.size(); ++k) {
        if (flags[k]) {
            set.emplace_back(names[k]);
        }
    }
    return set;
}

std::string shape_lines(const Shape& shape)
{
    if (const auto* box = std::get_if<BoxShape>(&shape)) {
        return "shape = \"box\"\n" + line("size", box->size);
    }
    if (const auto* sphere = std::get_if<SphereShape>(&shape)) {
        return "shape = \"sphere\"\n" + line("radius", sphere->radius);
    }
    if (const auto* cylinder = std::get_if<CylinderShape>(&shape)) {
        return "shape = \"cylinder\"\n" + line("radius", cylinder->radius) +
               line("length", cylinder->length);
    }
    if (const auto* particles = std::get_if<ParticleShape>(&shape)) {
        return "shape = \"particles\"\n" + line("file", particles->file);
    }
    const auto& mesh = std::get<MeshShape>(shape);
    return "shape = \"mesh\"\n" + line("file", mesh.file) + line("scale", mesh.scale);
}

std::string general_text(const Scene& scene)
{
    std::string text = line("title", scene.title);
    text += fmt::format("dimensions = {}\n", scene.dimensions);
    text += line("gravity", scene.gravity);
    text += fmt::format("seed = {}\n", scene.seed);
    text += "\n[time]\n" + line("end", scene.time.end) + line("step", scene.time.step) +
            line("cfl", scene.time.cfl) + (scene.time.recover ? "recover = true\n" : "");
    text += "\n[particles]\n" + line("spacing", scene.spacing) +
            line("precision", std::string(name(scene.precision)));
    if (scene.domain) {
        text += "\n[domain]\n" + line("min", scene.domain->min) + line("max", scene.domain->max);
        std::vector<std::string> periodic;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (scene.domain->periodic[axis]) {
                periodic.emplace_back(1, "xyz"[axis]);
            }
        }
        text += periodic.empty() ? "" : line("periodic", periodic);
    }
    return text;
}

std::string fluid_text(const FluidSettings& fluid)
{
    std::string text = "\n[fluid]\n" + line("density", fluid.density) +
                       line("formulation", std::string(name(fluid.formulation))) +
                       line("sound_speed", fluid.sound_speed) +
                       line("smoothing_ratio", fluid.smoothing_ratio) +
                       line("walls", std::string(fluid.sticks ? "no_slip" : "free_slip")) +
                       line("acceleration", fluid.acceleration);
    text += "\n[fluid.viscosity]\n";
    if (fluid.viscosity == ViscosityModel::artificial) {
        text += "model = \"artificial\"\n" + line("alpha", fluid.alpha);
    } else if (fluid.viscosity == ViscosityModel::laminar) {
        text += "model = \"laminar\"\n" + line("kinematic", fluid.kinematic_viscosity) +
                line("form", std::string(fluid.morris ? "morris" : "central"));
    } else if (fluid.viscosity == ViscosityModel::sps) {
        text += "model = \"sps\"\n" + line("kinematic", fluid.kinematic_viscosity) +
                line("smagorinsky", fluid.smagorinsky);
    } else {
        text += "model = \"none\"\n";
    }
    text += "\n[fluid.density_diffusion]\n";
    if (fluid.diffusion == DiffusionModel::none) {
        text += "model = \"none\"\n";
    } else {
        constexpr std::array<const char*, 4> models{"none", "fourtakas", "molteni", "antuono"};
        text += line("model", std::string(models[static_cast<std::size_t>(fluid.diffusion)]));
        text += line("delta", fluid.delta);
    }
    text += "\n[fluid.shifting]\n";
    text += fluid.shifting ? "model = \"sun\"\n" + line("coefficient", *fluid.shifting)
                           : "model = \"none\"\n";
    text += "\n[fluid.collision]\n";
    text += fluid.collision ? "model = \"dynamic\"\n" + line("restitution", *fluid.collision)
                            : "model = \"none\"\n";
    text += "\n[fluid.cavitation]\n";
    text += fluid.cavitation ? "model = \"void\"\n" + line("pressure", *fluid.cavitation)
                             : "model = \"none\"\n";
    for (const FluidBlock& block : fluid.blocks) {
        text += "\n[[fluid.block]]\n" + shape_lines(block.shape) + line("position", block.centre) +
                line("rotation", block.rotation) + (block.layers ? "layers = true\n" : "");
        text += block.velocity_field.empty() ? line("velocity", block.velocity)
                                             : line("velocity_field", block.velocity_field);
        text += block.pressure_field.empty() ? "" : line("pressure_field", block.pressure_field);
    }
    return text;
}

std::string geometry_lines(const Wall& wall)
{
    if (const auto* plane = std::get_if<PlaneWall>(&wall.geometry)) {
        return "shape = \"plane\"\n" + line("point", plane->point) + line("normal", plane->normal);
    }
    if (const auto* basin = std::get_if<BasinWall>(&wall.geometry)) {
        return "shape = \"basin\"\n" + line("min", basin->min) + line("max", basin->max) +
               line("open", named(basin->open, {"-x", "+x", "-y", "+y", "-z", "+z"})) +
               (basin->thickness ? line("thickness", *basin->thickness) : "");
    }
    if (const auto* round = std::get_if<RoundWall>(&wall.geometry)) {
        return "shape = \"round_basin\"\n" + line("radius", round->radius) +
               line("position", round->centre);
    }
    const auto& solid = std::get<SolidWall>(wall.geometry);
    return shape_lines(solid.shape) + line("position", solid.centre) +
           line("rotation", solid.rotation);
}

// A path as its points, so that the case does not need the file or formula it came from.
std::string motion_lines(const Motion& motion)
{
    if (motion.times.empty()) {
        return line("velocity", motion.velocity);
    }
    std::string times;
    std::string places;
    for (std::size_t k = 0; k < motion.times.size(); ++k) {
        times += (k > 0 ? ", " : "") + toml(motion.times[k]);
        places += (k > 0 ? ",\n  " : "") + toml(motion.places[k]);
    }
    return fmt::format("times = [{}]\nplaces = [\n  {}]\n", times, places);
}

std::string wall_text(const Wall& wall)
{
    return "\n[[wall]]\n" + line("name", wall.name) + geometry_lines(wall) +
           line("material", wall.material) + "[wall.motion]\n" + motion_lines(wall.motion);
}

std::string body_text(const BodySettings& body, int dimensions)
{
    // Density or mass, whichever gives back the bits of the other.
    const bool by_density = body.density * volume(body.shape, dimensions) == body.mass;
    return "\n[[body]]\n" + line("name", body.name) + shape_lines(body.shape) +
           (by_density ? line("density", body.density) : line("mass", body.mass)) +
           line("position", body.position) + line("rotation", body.rotation) +
           line("velocity", body.velocity) + line("angular_velocity", body.angular_velocity) +
           line("spacing", body.spacing) + line("material", body.material) +
           line("fixed", body.fixed) +
           line("stands", std::string(body.sealed ? "sealed" : "open")) +
           line("locks", named(body.locks, {"x", "y", "z", "rx", "ry", "rz"}));
}

std::string contact_text(const ContactSettings& contact)
{
    constexpr std::array<const char*, 3> laws{"coupled", "paper", "simultaneous"};
    std::string text = "\n[contact]\n";
    text += line("method", std::string(contact.penalty ? "penalty" : "impulse"));
    if (!contact.penalty) {
        text += line("law", std::string(laws[static_cast<std::size_t>(contact.law)])) +
                line("locating_share", contact.locating_share);
    }
    text += line("restitution", contact.restitution) + line("friction", contact.friction);
    if (contact.penalty) {
        text += "[contact.penalty]\n" + line("stiffness", contact.penalty->stiffness) +
                line("damping", contact.penalty->damping) + line("step", contact.penalty->step);
    }
    for (const MaterialPair& pair : contact.pairs) {
        text += "\n[[contact.pair]]\n" +
                line("materials", std::vector<std::string>{pair.materials[0], pair.materials[1]}) +
                line("restitution", pair.restitution) + line("friction", pair.friction) +
                line("stiffness", pair.stiffness);
    }
    return text;
}

std::string gauge_text(const Gauge& gauge)
{
    constexpr std::array<const char*, 6> types{"elevation", "pressure", "velocity",
                                               "force",     "front",    "flux"};
    constexpr std::array<const char*, 4> filters{"none", "mean", "median", "exponential"};
    constexpr std::array<const char*, 3> axes{"x", "y", "z"};
    std::string text = "\n[[gauge]]\n" + line("name", gauge.name) +
                       line("type", std::string(types[static_cast<std::size_t>(gauge.type)]));
    if (gauge.filter != GaugeFilter::none) {
        text += line("filter", std::string(filters[static_cast<std::size_t>(gauge.filter)])) +
                line("window", gauge.window);
    }
    if (gauge.type == GaugeType::force) {
        return text + line("on", gauge.on);
    }
    if (gauge.type == GaugeType::front) {
        return text + line("axis", std::string(axes[static_cast<std::size_t>(gauge.axis)]));
    }
    if (gauge.area > 0) {
        text += line("area", gauge.area);
    }
    if (gauge.area > 0 || gauge.type == GaugeType::flux) {
        text += line("normal", gauge.normal);
    }
    return text + line("at", gauge.at);
}

std::string output_text(const OutputSettings& output)
{
    return "\n[output]\n" + line("every", output.every) +
           line("history_every", output.history_every) + line("gauge_every", output.gauge_every) +
           line("fields", output.fields) + line("checkpoint_every", output.checkpoint_every);
}

} // namespace

std::string to_toml(const Scene& scene)
{
    std::string text = general_text(scene);
    if (scene.fluid) {
        text += fluid_text(*scene.fluid);
    }
    for (const Wall& wall : scene.walls) {
        text += wall_text(wall);
    }
    for (const BodySettings& body : scene.bodies) {
        text += body_text(body, scene.dimensions);
    }
    text += contact_text(scene.contact);
    for (const Gauge& gauge : scene.gauges) {
        text += gauge_text(gauge);
    }
    return text + output_text(scene.output);
}

} // namespace hyoryu
