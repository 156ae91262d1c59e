// SPDX-License-Identifier: MIT
// The keys of the whole case: time, resolution, domain and output.
#pragma once

#include "keys_bodies.hpp"
#include "keys_buildings.hpp"
#include "keys_contact.hpp"
#include "keys_debris.hpp"
#include "keys_fluid.hpp"
#include "keys_gauges.hpp"
#include "keys_open.hpp"
#include "keys_still_water.hpp"
#include "keys_walls.hpp"

namespace hyoryu {

// Spacings in the shortest period: 2.5 supports of the widest kernel, 2 h of 2 spacings.
inline constexpr int least_period = 10;

// A period holds a whole number of spacings, so that the lattice of the start goes on across it,
// and a tile of the neighbour search (see `tile_ratio`), below which a particle would meet its own
// image.
inline void check_period(TableReader& table, const Scene& scene, const DomainSettings& domain,
                         int axis, std::string_view name)
{
    const double length = domain.max[axis] - domain.min[axis];
    const double cells = length / scene.spacing;
    if (!(length > 0 && scene.spacing > 0)) {
        return; // already an error
    }
    if (std::abs(cells - std::round(cells)) > 1e-6 * cells || cells < least_period) {
        const double whole = std::max(std::round(cells), static_cast<double>(least_period));
        table.error(
            "periodic",
            fmt::format("along {} the domain is {:.6g} spacings long, expected a whole "
                        "number of at least {}",
                        name, cells, least_period),
            fmt::format("for instance {:.6g} m, {:.6g} spacings", whole * scene.spacing, whole));
    }
    if (scene.gravity[axis] != 0) {
        table.error("periodic", fmt::format("`gravity` points along {}", name),
                    "no hydrostatic state exists along a periodic direction; change one of them");
    }
}

inline void check_title(TableReader& root, const std::string& title)
{
    if (const std::string fault = label_fault(title); !fault.empty()) {
        root.error("title", "cannot be shown: " + fault, "one line of plain text");
    }
}

inline void set_dimensions(TableReader& root, int dimensions)
{
    root.reading().dimensions = dimensions;
    root.reading().dimensions_known = !root.mistaken({"dimensions"});
}

inline void note_spacing(TableReader& table, double spacing)
{
    table.reading().spacing = table.sound("spacing") ? spacing : 0;
}

/// Sets a mistaken gravity to zero, so that no other key is checked against its direction.
inline void forget_mistaken(TableReader& root, Vec3& gravity)
{
    if (root.has("gravity") && !root.sound("gravity")) {
        gravity = Vec3(0, 0, 0);
    }
}

inline void check_time(TableReader& table, const TimeSettings& time)
{
    if (time.recover && time.step) {
        table.error("recover", "has no meaning beside a fixed `time.step`",
                    "omit `time.step` for an adaptive step, which can be halved");
    }
    if (time.step && time.end > 0 && *time.step > time.end) {
        table.error("step",
                    fmt::format("{} s is longer than the run of {} s", *time.step, time.end),
                    "leave it out: the program finds the step");
    }
}

inline void find_periods(TableReader& table, const std::vector<std::string>& names,
                         const Scene& scene, DomainSettings& domain)
{
    constexpr std::array<std::string_view, 3> axes{"x", "y", "z"};
    for (const std::string& name : names) {
        const auto found = std::find(axes.begin(), axes.end(), name);
        const bool flat = scene.dimensions == 2 && name == "y";
        if (found == axes.end() || flat) {
            table.error("periodic", fmt::format("\"{}\" is not a direction of this case", name),
                        scene.dimensions == 2 ? "there are \"x\" and \"z\""
                                              : "there are \"x\", \"y\" and \"z\"");
            continue;
        }
        const auto axis = at(found - axes.begin());
        domain.periodic[axis] = true;
        check_period(table, scene, domain, static_cast<int>(axis), name);
    }
}

inline void expect_something(TableReader& root)
{
    if (!root.has("fluid") && !root.has("body") && !root.has("debris")) {
        root.error("", "the case has nothing to simulate",
                   "add [fluid] with [[fluid.block]], or [[body]]");
    }
}

void keys_of(auto& keys, Is<TimeSettings> auto& time)
{
    keys.positive("end", time.end, "s", "Simulated time at which the run ends.", required);
    keys.positive("step", time.step, "s",
                  "Fixed time step. Without it the time step is adaptive: the largest step within "
                  "the limits of sound speed, viscosity and force.");
    keys.positive(
        "cfl", time.cfl, "",
        "Factor on the limits of the adaptive time step; a smaller factor is safer and slower.");
    if (keys.shows(time.recover)) {
        keys.flag("recover", time.recover,
                  "Whether a run that becomes unstable returns to the last frame and continues "
                  "with half the time step, at most five times. Results written after that frame "
                  "are removed, and `run.log` reports this.");
    }
    keys.rule(check_time, time);
}

void keys_of(auto& keys, Is<DomainSettings> auto& domain, const Scene& scene)
{
    keys.planar("min", domain.min, "m", "Lower corner of the domain.", required);
    keys.planar("max", domain.max, "m", "Upper corner of the domain.", required);
    keys.rule(check_corners, domain.min, domain.max);
    std::vector<std::string> periods;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (domain.periodic[axis]) {
            periods.emplace_back(1, "xyz"[axis]);
        }
    }
    if (keys.shows(!periods.empty())) {
        keys.texts("periodic", periods, {},
                   "Directions (\"x\", \"y\", \"z\") in which the domain is periodic: particles "
                   "that leave on one side enter on the opposite side. For scenes without bodies "
                   "and without moving walls.");
    }
    keys.rule(find_periods, periods, scene, domain);
}

void keys_of(auto& keys, Is<OutputSettings> auto& output, const Scene& scene)
{
    keys.rule(inherit, output.every, scene.time.end / 100);
    keys.positive("every", output.every, "s", "Simulated time between two frames.",
                  "time.end / 100");
    keys.not_negative(
        "history_every", output.history_every, "s",
        "Simulated time between two rows of the CSV histories; 0: a row at every step.");
    keys.rule(inherit, output.gauge_every, output.history_every);
    keys.not_negative("gauge_every", output.gauge_every, "s",
                      "Simulated time between two rows of gauges.csv; 0: a row at every step.",
                      "output.history_every");
    keys.texts("fields", output.fields,
               {"velocity", "pressure", "density", "volume", "id", "kind", "body"},
               "Further fields of each particle in a frame: \"volume\" adds its volume. Place, "
               "velocity, pressure, density, id, kind and body are in every frame.");
    keys.positive("checkpoint_every", output.checkpoint_every, "s",
                  "Wall-clock time between two checkpoints, from which `run --resume` continues.");
}

/// Keys that hold for the whole case.
void general_keys(auto& keys, Is<Scene> auto& scene)
{
    keys.text("title", scene.title, "Title of the case in reports and pictures.");
    keys.rule(check_title, scene.title);
    keys.integer(
        "dimensions", scene.dimensions, 2, 3, "2 or 3",
        "Number of dimensions: 3, or 2 for a case in the x-z plane. In two dimensions, masses and "
        "forces are per metre of width, and y components are read and ignored.");
    keys.rule(set_dimensions, scene.dimensions);
    keys.planar("gravity", scene.gravity, "m/s2", "Acceleration of gravity; z points up.");
    keys.rule(forget_mistaken, scene.gravity);
    constexpr double unbounded = 1e300;
    keys.integer("seed", scene.seed, 0, unbounded, ">= 0",
                 "Seed of all random numbers; the same seed gives bitwise identical numbers.");
    keys.table("time", "Simulated time and time steps.", scene.time);
    keys.table(
        "particles", "Resolution, floating-point precision and maximum number of the particles.",
        [&](auto& particles) {
            particles.positive("spacing", scene.spacing, "m",
                               "Initial distance between the particles of fluid and walls: the "
                               "resolution of the run.",
                               required);
            particles.rule(note_spacing, scene.spacing);
            particles.choice("precision", scene.precision, {"single", "double"},
                             "Floating-point type of the pair interactions. The state and the "
                             "bodies use double precision in either case. \"double\" is for "
                             "verification and takes about the same time.");
            constexpr double no_bound = 1e15;
            particles.integer("most", scene.most_fluid, 0, no_bound, ">= 0",
                              "Maximum number of fluid particles in a run with open sides, "
                              "including the particles outside the windows. A run that exceeds it "
                              "ends with its last good state on disk. 0: the number that fits into "
                              "four fifths of the memory of the machine.");
        });
    keys.table("domain",
               "Box outside of which particles are removed; without this table it is the bounds of "
               "the scene.",
               scene.domain, scene);
}

void keys_of(auto& keys, Is<Scene> auto& scene)
{
    general_keys(keys, scene);
    keys.table("fluid", "The fluid; without this table no fluid is simulated.", scene.fluid, scene);
    keys.tables("wall", "A fixed or moving boundary of the fluid and the bodies.", scene.walls,
                scene.gravity.norm(), scene);
    std::vector<BuildingKeys> buildings; // walls when the case is resolved
    keys.tables("buildings", "Buildings from footprints; each building becomes a separate wall.",
                buildings, scene);
    keys.tables(
        "sponge",
        "A sponge layer: a box that damps waves before they reach its end, or restores a stream.",
        scene.sponges, scene.gravity.norm());
    keys.tables("open", "A window in a side of the domain through which fluid enters and leaves.",
                scene.open, scene);
    keys.tables("body", "A rigid body, such as a timber, a container or a car.", scene.bodies,
                scene);
    std::vector<DebrisKeys> debris; // bodies when the case is resolved
    keys.tables("debris", "Pieces of the debris library, such as containers, logs or cars.", debris,
                scene);
    keys.rule(find_still_water, scene);
    keys.rule(check_bodies, scene.bodies);
    keys.table("contact", "Contact of bodies with each other and with walls.", scene.contact,
               scene);
    GaugeColumns columns{{"time", 0}};
    keys.tables("gauge", "A measuring instrument, whose readings are columns of gauges.csv.",
                scene.gauges, scene, columns);
    keys.table("output", "Contents and frequency of the output.", scene.output, scene);
    keys.rule(expect_something);
}

} // namespace hyoryu
