// SPDX-License-Identifier: MIT
// Gauges and output.
#include "reader.hpp"

#include "hyoryu/scene/gauge_columns.hpp"
#include "hyoryu/scene/reader_hint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace hyoryu {

namespace {

GaugeType gauge_type(const std::string& name)
{
    static const std::map<std::string, GaugeType, std::less<>> types = {
        {"elevation", GaugeType::elevation}, {"pressure", GaugeType::pressure},
        {"velocity", GaugeType::velocity},   {"force", GaugeType::force},
        {"front", GaugeType::front},         {"flux", GaugeType::flux},
    };
    const auto at = types.find(name);
    return at == types.end() ? GaugeType::elevation : at->second;
}

void read_force_gauge(TableReader& table, const Scene& scene, Gauge& gauge)
{
    table.require("on");
    gauge.on = table.text("on");
    std::vector<std::string_view> names;
    for (const Wall& wall : scene.walls) {
        names.push_back(wall.name);
    }
    for (const BodySettings& body : scene.bodies) {
        names.push_back(body.name);
    }
    if (table.has("on") && std::find(names.begin(), names.end(), gauge.on) == names.end()) {
        const std::string near = did_you_mean(gauge.on, names);
        constexpr std::size_t most_listed = 10;
        names.resize(std::min(names.size(), most_listed));
        table.error("on", fmt::format("no wall or body is named \"{}\"", gauge.on),
                    near.empty() && !names.empty() ? "there are: " + quoted_list(names) : near);
    }
}

void read_point_gauge(TableReader& table, Gauge& gauge)
{
    table.require("at");
    const std::vector<double> at = table.numbers("at");
    if (at.size() == 2 && gauge.type != GaugeType::elevation) {
        table.error("at", "expected 3 numbers, found 2");
    } else if (!at.empty()) {
        gauge.at = Vec3(at[0], at[1], at.size() > 2 ? at[2] : 0.0);
        gauge.at.y() = table.reading().dimensions == 2 ? 0.0 : gauge.at.y();
    }
}

void read_face(TableReader& table, Gauge& gauge)
{
    gauge.area = table.find_number("area").value_or(0);
    if (table.has("area") || table.has("normal")) {
        table.require("area");
        table.require("normal");
        gauge.normal = table.find_direction("normal").value_or(gauge.normal);
    }
}

void read_filter(TableReader& table, Gauge& gauge)
{
    const std::string name = table.choice("filter");
    gauge.filter = name == "mean"          ? GaugeFilter::mean
                   : name == "median"      ? GaugeFilter::median
                   : name == "exponential" ? GaugeFilter::exponential
                                           : GaugeFilter::none;
    if (gauge.filter != GaugeFilter::none) {
        table.require("window");
        gauge.window = table.number("window");
    }
}

Gauge read_gauge(TableReader& table, const Scene& scene, std::size_t number)
{
    Gauge gauge;
    gauge.place = table.place();
    const std::string name = table.text("name");
    gauge.name = table.has("name") ? name : fmt::format("gauge.{}", number);
    const std::string type = table.choice("type");
    gauge.type = gauge_type(type);
    if (type == "force") {
        read_force_gauge(table, scene, gauge);
    } else if (type == "front") {
        const std::string axis = table.choice("axis");
        gauge.axis = axis == "z" ? 2 : axis == "y" ? 1 : 0;
    } else if (!type.empty()) {
        read_point_gauge(table, gauge);
    }
    if (type == "pressure") {
        read_face(table, gauge);
    } else if (type == "flux") {
        gauge.normal = table.find_direction("normal").value_or(gauge.normal);
    }
    read_filter(table, gauge);
    if (!scene.fluid && !type.empty() && type != "force") {
        table.error("type", fmt::format("\"{}\" has no meaning in a case without fluid", type),
                    "only gauges of type \"force\" have");
    }
    table.finish();
    return gauge;
}

} // namespace

void read_gauges(TableReader& root, Scene& scene)
{
    std::size_t number = 0;
    std::map<std::string, int> columns{{"time", 0}};
    for (TableReader& table : root.tables("gauge")) {
        scene.gauges.push_back(read_gauge(table, scene, ++number));
        const Gauge& gauge = scene.gauges.back();
        check_name(table, "name", gauge.name);
        for (const Table::Head& head : gauge_columns(gauge, scene.dimensions)) {
            const auto [earlier, is_new] = columns.emplace(head.name, gauge.place.line);
            if (!is_new) {
                table.error("name", head.name == "time"
                                        ? "is taken: \"time\" is the first column of gauges.csv"
                                        : fmt::format("the column \"{}\" stands twice, first of "
                                                      "the gauge in line {}",
                                                      head.name, earlier->second));
                break;
            }
        }
    }
}

void read_output(TableReader table, Scene& scene)
{
    scene.output.every = table.find_number("every").value_or(scene.time.end / 100);
    scene.output.history_every = table.number("history_every");
    scene.output.gauge_every =
        table.find_number("gauge_every").value_or(scene.output.history_every);
    scene.output.fields = table.texts("fields");
    scene.output.checkpoint_every = table.number("checkpoint_every");
    table.finish();
}

} // namespace hyoryu
