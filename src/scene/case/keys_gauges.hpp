// SPDX-License-Identifier: MIT
// The keys of gauges.
#pragma once

#include "keys_names.hpp"

#include "hyoryu/scene/gauge_columns.hpp"
#include "hyoryu/scene/reader_hint.hpp"

#include <map>

namespace hyoryu {

/// The columns of gauges.csv so far, and the line of the gauge that has each.
using GaugeColumns = std::map<std::string, int>;

inline void check_place(TableReader& table, const Gauge& gauge)
{
    if (table.count("at") == 2 && gauge.type != GaugeType::elevation) {
        table.error("at", "expected 3 numbers, found 2");
    }
    if (gauge.type == GaugeType::elevation && gauge.at.z() != 0) {
        table.warn("at", "z has no effect: an elevation gauge is a vertical line", "write [x, y]");
    }
}

inline void find_target(TableReader& table, const Gauge& gauge, const Scene& scene)
{
    if (!table.reading().names_known) {
        return;
    }
    std::vector<std::string_view> names;
    for (const Wall& wall : scene.walls) {
        names.push_back(wall.name);
    }
    for (const BodySettings& body : scene.bodies) {
        names.push_back(body.name);
    }
    if (table.sound("on") && std::find(names.begin(), names.end(), gauge.on) == names.end()) {
        const std::string near = did_you_mean(gauge.on, names);
        constexpr std::size_t most_listed = 10;
        names.resize(std::min(names.size(), most_listed));
        table.error("on", fmt::format("no wall or body is named \"{}\"", gauge.on),
                    near.empty() && !names.empty() ? "known: " + quoted_list(names) : near);
    }
}

inline void check_gauge(TableReader& table, const Gauge& gauge, const Scene& scene,
                        GaugeColumns& columns)
{
    if (!scene.fluid && table.sound("type") && gauge.type != GaugeType::force) {
        const auto type = std::get<std::string>(table.find("type")->value);
        table.error("type", fmt::format("\"{}\" has no meaning in a case without fluid", type),
                    "only gauges of type \"force\" have");
    }
    constexpr int along_y = 1;
    if (gauge.type == GaugeType::front && gauge.axis == along_y && scene.dimensions == 2) {
        table.warn("axis", "nothing moves along y in two dimensions", "give \"x\" or \"z\"");
    }
    check_name(table, "name", gauge.name);
    for (const Table::Head& head : gauge_columns(gauge, scene.dimensions)) {
        const auto [earlier, is_new] = columns.emplace(head.name, gauge.place.line);
        if (!is_new) {
            table.error(
                "name",
                head.name == "time"
                    ? "is reserved: \"time\" is the first column of gauges.csv"
                    : fmt::format(
                          "the column \"{}\" is defined twice, first by the gauge in line {}",
                          head.name, earlier->second));
            break;
        }
    }
}

/// The filter of the readings of a gauge.
void filter_keys(auto& keys, Is<Gauge> auto& gauge)
{
    const auto filtered = [&] { return gauge.filter != GaugeFilter::none; };
    if (keys.shows(filtered())) {
        keys.choice("filter", gauge.filter, {"none", "mean", "median", "exponential"},
                    "Filter of the readings. The filtered readings are a column in addition to the "
                    "raw one, named NAME_mean and so on: mean or median of the last `window` "
                    "seconds, or the mean with the weights exp(-age/window).");
    }
    if (keys.applies(filtered())) {
        keys.positive("window", gauge.window, "s", "Time window of the filter.", needed);
    }
}

/// Where a gauge measures.
void gauge_place_keys(auto& keys, Is<Gauge> auto& gauge)
{
    keys.planar("at", gauge.at, "m",
                "Position of the gauge: a point, the x and y of the vertical line of an elevation "
                "gauge, or any point of the plane of a flux gauge.",
                needed, 2);
    keys.rule(check_place, gauge);
}

/// The face of a pressure gauge and the plane of a flux gauge.
void gauge_face_keys(auto& keys, Is<Gauge> auto& gauge)
{
    const bool face = gauge.area > 0 || keys.gives("area") || keys.gives("normal");
    const bool pressure = gauge.type == GaugeType::pressure;
    if (keys.applies(pressure) && keys.shows(face)) {
        keys.positive(
            "area", gauge.area, "m2",
            "Area of the face of a pressure sensor, over which the pressure is averaged; in "
            "2-D its length [m]. Without this key the pressure is measured at a point.",
            face ? needed : no_default);
    }
    const bool flux = gauge.type == GaugeType::flux;
    if (keys.applies(flux || (pressure && face))) {
        keys.direction("normal", gauge.normal,
                       "Outward normal of the face of a pressure sensor, or positive direction of "
                       "a flux, +x without this key; of any length.",
                       face ? needed : no_default);
    }
}

void keys_of(auto& keys, Is<Gauge> auto& gauge, const Scene& scene, GaugeColumns& columns)
{
    keys.rule(number_name, "gauge", gauge.name);
    keys.text("name", gauge.name, "Name of the column; unique.", "gauge.1, gauge.2 ...");
    const bool known = keys.choice(
        "type", gauge.type, {"elevation", "pressure", "velocity", "force", "front", "flux"},
        "Measured quantity: the water level over a point (at), pressure or velocity at a point "
        "(at), the force of the fluid on a wall or body with the impulses of fluid and contact "
        "(on), the position of the front along an axis (axis), or the volume flux through a plane "
        "(at, normal).",
        required);
    const bool force = gauge.type == GaugeType::force;
    const bool front = gauge.type == GaugeType::front;
    const bool placed = known && !force && !front;
    if (keys.writes) {
        filter_keys(keys, gauge);
    } else if (keys.applies(placed)) {
        gauge_place_keys(keys, gauge);
    }
    gauge_face_keys(keys, gauge);
    if (keys.writes && placed) {
        gauge_place_keys(keys, gauge);
    }
    if (keys.applies(known && force)) {
        keys.text("on", gauge.on, "Name of the wall or body on which forces are measured.", needed);
        keys.rule(find_target, gauge, scene);
    }
    if (keys.applies(known && front)) {
        keys.choice("axis", gauge.axis, {"x", "y", "z"},
                    "Axis along which the position of the front is measured.");
    }
    if (!keys.writes) {
        filter_keys(keys, gauge);
    }
    keys.rule(check_gauge, gauge, scene, columns);
}

} // namespace hyoryu
