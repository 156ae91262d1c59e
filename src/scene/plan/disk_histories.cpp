// SPDX-License-Identifier: MIT
#include "disk_histories.hpp"

#include "hyoryu/core/error.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace hyoryu {

namespace {

// Letters of a cell with the comma behind it, on average over the histories of 70 shipped cases: a
// number of full length, a zero, and a time that is a sum of steps or a multiple of a round one.
constexpr double full_cell = 20.5;
constexpr double short_cell = 2;
constexpr double time_of_fluid = 19;
constexpr double time_of_bodies = 8;
constexpr double header_lines = 250;  // names and units of the columns
constexpr double letters_of_unit = 4; // of a column of a gauge or an open side

// Columns of a force gauge: pressure, viscous and contact parts, of which some are zero.
constexpr double active_of_force_2d = 0.45;
constexpr double active_of_force_3d = 0.6;

// Overhead of a column in results.h5; of the chunk index of a compressed one; and the compression
// ratios of columns that change and of constant ones, fitted to 68 files.
constexpr double of_column = 440;
constexpr double of_index = 2.1e3;
constexpr double left_of_active = 0.65;
constexpr double left_of_idle = 0.002;

// Impacts of spheres that stand in a row along one axis turn nothing out of it.
bool spheres_level_along(const Scene& scene, Eigen::Index axis)
{
    return scene.walls.empty() && std::ranges::all_of(scene.bodies, [&](const BodySettings& body) {
               return std::holds_alternative<SphereShape>(body.shape) &&
                      body.position[axis] == scene.bodies.front().position[axis];
           });
}

// Whether anything can ever move along an axis of the world. Without a force or velocity along it,
// everything stays at rest.
bool moves_along(const Scene& scene, const Plan& plan, Eigen::Index axis)
{
    if (scene.dimensions == 2 && axis == 1) {
        return false;
    }
    return plan.fluid || scene.gravity[axis] != 0 ||
           (plan.contact && !spheres_level_along(scene, axis)) ||
           std::ranges::any_of(scene.bodies,
                               [&](const BodySettings& b) { return b.velocity[axis] != 0; });
}

// How the bodies of a scene may move.
struct Freedom {
    std::array<bool, 3> moves{}; // along x, y, z
    bool turns = false;          // not in a row of spheres that hit each other head on

    double axes() const { return static_cast<double>(std::ranges::count(moves, true)); }
};

Freedom freedom_of(const Scene& scene, const Plan& plan)
{
    Freedom freedom;
    for (int axis = 0; axis < 3; ++axis) {
        freedom.moves[at(axis)] = moves_along(scene, plan, axis);
    }
    freedom.turns =
        plan.fluid || freedom.axes() > 1 ||
        std::ranges::any_of(scene.bodies, [](const BodySettings& b) {
            return !std::holds_alternative<SphereShape>(b.shape) || b.angular_velocity.norm() > 0;
        });
    return freedom;
}

double text_of(double active, double idle)
{
    return full_cell * active + short_cell * idle;
}

double time_cell(const Plan& plan)
{
    return plan.fluid ? time_of_fluid : time_of_bodies;
}

double history_rows(const Scene& scene, const Course& course)
{
    const double every = scene.output.history_every;
    return 1 + (every > 0 ? std::min(course.steps, scene.time.end / every) : course.steps);
}

HistorySize energy(const Scene& scene, const Plan& plan, const Course& course)
{
    const double of_openings = scene.open.empty() ? 0 : 4;
    const double columns = 19 + of_openings; // without the time; of lost particles 4
    const bool falls = scene.gravity.norm() > 0;
    const bool pushes = !scene.walls.empty() && (plan.fluid || plan.contact);
    const Vec3 drive =
        scene.gravity + (scene.fluid ? scene.fluid->acceleration : Vec3(Vec3::Zero()));
    double active = of_openings;
    active += plan.fluid ? (falls ? 3 : 2) : 0;
    active += plan.rigid ? (falls ? 2 : 1) : 0;
    active += plan.contact && !plan.fluid ? 1 : 0; // water keeps most bodies from each other
    // Momentum and the impulses of walls.
    active += (pushes ? 2 : 1) * freedom_of(scene, plan).axes();
    active += static_cast<double>((drive.array() != 0.0).count());
    const double text = time_cell(plan) + text_of(active, columns - active);
    return {history_rows(scene, course), text, active + 1, columns - active, 0, 0};
}

// Numbers of a body that change: position, orientation, both velocities, and loads of a fluid.
double active_of_body(const Scene& scene, const Plan& plan, const Freedom& freedom,
                      const BodySettings& body)
{
    const bool flat = scene.dimensions == 2;
    double active = plan.fluid ? (flat ? 3 : 6) : 0;
    if (body.fixed) {
        return active;
    }
    double rotations = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        active += freedom.moves[axis] && !body.locks[axis] ? 2 : 0;
        rotations += (flat && axis != 1) || body.locks[3 + axis] || !freedom.turns ? 0 : 1;
    }
    const double orientation = rotations > 1 ? 4 : 2 * rotations;
    return active + rotations + orientation;
}

HistorySize bodies(const Scene& scene, const Plan& plan, const Course& course)
{
    constexpr double columns = 19; // beside time and name
    double active = 0;
    double letters = 0;
    double longest = 0;
    const Freedom freedom = freedom_of(scene, plan);
    for (const BodySettings& body : scene.bodies) {
        active += active_of_body(scene, plan, freedom, body);
        letters += static_cast<double>(body.name.size());
        longest = std::max(longest, static_cast<double>(body.name.size()));
    }
    const auto n = static_cast<double>(scene.bodies.size());
    active /= n;
    const double text = time_cell(plan) + letters / n + 1 + text_of(active, columns - active);
    return {n * history_rows(scene, course), text, active + 1, columns - active, longest, 1};
}

HistorySize contacts(const Scene& scene, const Plan& plan, const Course& course)
{
    constexpr double kind = 7; // "impact" or "resting"
    constexpr double name = 6; // of a body or a wall
    const double active = scene.dimensions == 2 ? 9 : 11;
    const double idle = 13 - active;
    const double rows = course.impacts + resting_pairs(scene, plan) * std::max(plan.frames - 1, 0.);
    const double text = time_cell(plan) + 2 * (name + 1) + kind + 1 + text_of(active, idle);
    return {rows, text, active + 1, idle, 2 * name + kind, 3};
}

HistorySize gauges(const Scene& scene, const Plan& plan, const Course& course)
{
    const double of_force = scene.dimensions == 2 ? active_of_force_2d : active_of_force_3d;
    double active = 0;
    double columns = 0;
    double names = 0;
    for (std::size_t k = 0; k < plan.gauges.size(); ++k) {
        names += static_cast<double>(plan.gauges[k].columns.size());
        const double own = 1 + static_cast<double>(std::ranges::count(plan.gauges[k].columns, ','));
        columns += own;
        active += own * (scene.gauges[k].type == GaugeType::force ? of_force : 1);
    }
    HistorySize table;
    table.rows = std::min(plan.gauge_rows, course.steps + 1);
    table.row_text = time_cell(plan) + text_of(active, columns - active);
    table.active = active + 1;
    table.idle = columns - active;
    table.header = names + letters_of_unit * columns;
    return table;
}

HistorySize openings(const Scene& scene, const Plan& plan, const Course& course)
{
    constexpr double columns = 6;
    constexpr double active = 5; // either nothing goes out or nothing comes in
    constexpr double names = 6 * 13;
    const double every = scene.output.gauge_every;
    HistorySize table;
    table.row_text = time_cell(plan);
    table.rows = 1 + (every > 0 ? std::min(course.steps, scene.time.end / every) : course.steps);
    table.active = 1;
    for (const OpenSettings& side : scene.open) {
        table.row_text += text_of(active, columns - active);
        table.active += active;
        table.idle += columns - active;
        table.header += names + columns * (static_cast<double>(side.name.size()) + letters_of_unit);
    }
    return table;
}

double column_bytes(double rows, double left)
{
    return 8 * rows < worth_compressing ? 8 * rows : left * 8 * rows + of_index;
}

double bytes_of(const HistorySize& table)
{
    return header_lines + table.header + table.rows * (table.row_text + table.names) +
           table.active * column_bytes(table.rows, left_of_active) +
           table.idle * column_bytes(table.rows, left_of_idle) +
           of_column * (table.active + table.idle + table.text_columns);
}

} // namespace

double resting_pairs(const Scene& scene, const Plan& plan)
{
    return plan.contact && scene.gravity.norm() > 0 && !plan.fluid
               ? static_cast<double>(std::ranges::count(scene.bodies, false, &BodySettings::fixed))
               : 0;
}

std::vector<HistorySize> histories(const Scene& scene, const Plan& plan, const Course& course)
{
    std::vector<HistorySize> tables{energy(scene, plan, course)};
    if (!scene.bodies.empty()) {
        tables.push_back(bodies(scene, plan, course));
    }
    if (plan.contact) {
        tables.push_back(contacts(scene, plan, course));
    }
    if (!plan.gauges.empty()) {
        tables.push_back(gauges(scene, plan, course));
    }
    if (!scene.open.empty()) {
        tables.push_back(openings(scene, plan, course));
    }
    return tables;
}

double history_bytes(const std::vector<HistorySize>& tables)
{
    double total = 0;
    for (const HistorySize& table : tables) {
        total += bytes_of(table);
    }
    return total;
}

} // namespace hyoryu
