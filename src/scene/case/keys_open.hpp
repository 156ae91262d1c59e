// SPDX-License-Identifier: MIT
// The keys of open sides.
#pragma once

#include "keys_names.hpp"
#include "place_buildings.hpp"
#include "series.hpp"

#include "hyoryu/scene/reader_hint.hpp"

#include <numbers>

namespace hyoryu {

/// How a case lies in its map: as its terrain does, else x is east and heights are those of the
/// map.
struct MapAxes {
    double azimuth_deg = 90; // of the x axis, clockwise from north
    double datum = 0;        // z of height 0 [m]
    bool of_terrain = false;
};

inline MapAxes map_of(const Scene& scene)
{
    const TerrainPatch* terrain = terrain_patch_of(scene);
    return terrain != nullptr ? MapAxes{terrain->azimuth_deg, terrain->datum, true} : MapAxes{};
}

/// Keys of a window that only the reader needs. The writer omits them: they have become series.
struct SeriesKeys {
    MapAxes map;
    std::optional<std::string> file;
    SeriesFormat format = SeriesFormat::csv;
    std::vector<std::string> columns;
    std::optional<double> azimuth_deg, datum;
    double time_offset = 0, scale = 1;
};

/// The direction into the domain, clockwise from north.
inline double azimuth_of(const OpenSettings& open, const MapAxes& map)
{
    constexpr std::array<double, 4> from_x{0, 180, -90, 90};
    return map.azimuth_deg + from_x[static_cast<std::size_t>(open.into)];
}

inline void check_open_name(TableReader& table, const OpenSettings& open, const Scene& scene)
{
    check_name(table, "name", open.name);
    for (const OpenSettings& other : scene.open) {
        if (other.name == open.name) {
            table.error("name",
                        fmt::format("the name \"{}\" is used twice, first in line {}", open.name,
                                    other.place.line),
                        "names of open sides must differ");
        }
    }
}

inline void check_window(TableReader& table, const OpenSettings& open, const Scene& scene)
{
    const int axis = open.axis();
    const bool flat = scene.dimensions == 2;
    if (table.mistaken({"into"}) || !table.reading().dimensions_known) {
        return;
    }
    if (!scene.fluid) {
        table.error("name", "an open side has no meaning in a case without fluid",
                    "add a [fluid], or remove [[open]]");
    }
    if (flat && axis == 1) {
        table.error("into", "a case in two dimensions has no sides along y",
                    "there are \"+x\" and \"-x\"");
        return;
    }
    if (!table.sound("min") || !table.sound("max")) {
        return;
    }
    for (int k = 0; k < 3; ++k) {
        const double size = open.max[k] - open.min[k];
        if (k == axis && size != 0) {
            table.error("max", fmt::format("the window is {:.6g} m thick along its normal", size),
                        fmt::format("`min` and `max` must have the same {}", "xyz"[k]));
        } else if (k != axis && !(flat && k == 1) && !(size > 0)) {
            table.error("max", fmt::format("must lie above `min` along {}", "xyz"[k]),
                        "`min` is the lower corner of the window, `max` the upper one");
        }
    }
    if (scene.domain && scene.domain->periodic[at(axis)]) {
        table.error("into", fmt::format("the domain is periodic along {}", "xyz"[axis]),
                    "a periodic side cannot be open");
    }
    const Vec3& g = scene.gravity;
    if (scene.fluid && !(g.z() < 0 && g.x() == 0 && g.y() == 0)) {
        table.error("into", "an open side needs gravity along -z",
                    "the level of the water gives the pressure outside");
    }
}

/// Checks that the prescribed flow is complete and consistent; notes the mistakes.
inline void check_asked(TableReader& table, const OpenSettings& open, const SeriesKeys& keys)
{
    const bool series = keys.file || !open.series.empty();
    const bool constant = open.level || open.velocity || open.discharge;
    if (table.mistaken({"kind", "level", "velocity", "discharge", "series", "station"})) {
        return;
    }
    const char* given = open.level ? "level" : open.velocity ? "velocity" : "discharge";
    if (open.kind == OpenKind::outflow && (series || constant)) {
        table.error(series ? "series" : given,
                    "has no effect with kind = \"outflow\", which prescribes no flow",
                    "kind = \"inflow\" follows a series; kind = \"absorb\" keeps a level");
        return;
    }
    if (series && constant) {
        table.error(given, "has no meaning beside a series", "give one of them");
    }
    if (keys.file && !open.series.empty()) {
        table.error("series", "has no meaning beside [[open.station]]", "give one of them");
    }
    if (open.kind == OpenKind::inflow && !series && !open.level && !open.discharge) {
        table.error("series", "is missing: an inflow needs a flow to follow",
                    "give `series`, or `level` with or without `velocity`, or `discharge`");
    }
    if (open.discharge && (open.level || open.velocity)) {
        table.error(
            "discharge", "has no meaning beside `level` or `velocity`",
            "a discharge enters at the depth that the water inside has, or at the critical one");
    }
    if (open.kind == OpenKind::inflow && open.velocity && !open.level && !open.discharge) {
        table.error("velocity", "needs a `level`", "or give `discharge`");
    }
    if (open.kind == OpenKind::absorb && open.discharge) {
        table.error("discharge", "has no meaning with kind = \"absorb\"", "use kind = \"inflow\"");
    }
}

/// Reports keys that describe the reading of a series file in a window without a series file.
inline void check_file_keys(TableReader& table, const OpenSettings& open, const SeriesKeys& keys)
{
    const bool file = table.has("series") || table.has("station");
    if (table.mistaken({"format"})) {
        return;
    }
    for (const std::string_view key :
         {"format", "columns", "azimuth_deg", "datum", "time_offset", "scale"}) {
        if (!file && table.has(key)) {
            table.error(key, "has no meaning without a series", "give `series`, or leave it out");
        }
    }
    if (file && table.has("azimuth_deg") && keys.format == SeriesFormat::csv) {
        table.error("azimuth_deg", "has no meaning with format = \"csv\"",
                    "the velocities of a table are those into the domain");
    } else if (keys.azimuth_deg && keys.map.of_terrain) {
        constexpr double rounded = 0.5; // [deg]
        const double by_terrain = azimuth_of(open, keys.map);
        if (std::abs(std::remainder(*keys.azimuth_deg - by_terrain, 360)) > rounded) {
            table.warn("azimuth_deg",
                       fmt::format("is {:.6g} deg, but by the terrain `into` points {:.6g} deg "
                                   "clockwise from north",
                                   *keys.azimuth_deg, std::fmod(by_terrain + 360, 360)),
                       "leave it out: it follows from `wall.azimuth_deg`");
        }
    }
    if (file && table.has("columns") && keys.format == SeriesFormat::geoclaw) {
        table.error("columns", "has no meaning with format = \"geoclaw\"",
                    "its columns are level, time, h, hu, hv and eta");
    }
    if (open.hold && !file) {
        table.error("hold", "has no meaning without a series", "leave it out");
    }
}

inline void check_columns(TableReader& table, const std::vector<std::string>& columns)
{
    for (std::size_t k = 0; k < columns.size(); ++k) {
        const bool twice =
            columns[k] != "-" && std::find(columns.begin(), columns.begin() + static_cast<Index>(k),
                                           columns[k]) != columns.begin() + static_cast<Index>(k);
        if (twice) {
            table.error_at("columns", k, fmt::format("\"{}\" is listed twice", columns[k]),
                           "a column that is not needed is \"-\"");
        }
    }
    if (!columns.empty() && std::ranges::find(columns, "time") == columns.end()) {
        table.error("columns", "contains no \"time\"", "each row of the table needs its time");
    }
}

inline void check_series(TableReader& table, std::string_view key, const OpenSeries& series)
{
    const bool level = !series.levels.empty();
    const bool velocity = !series.velocities.empty();
    const bool discharge = !series.discharges.empty();
    if (discharge ? level || velocity : !level) {
        table.error(key,
                    discharge ? "has a discharge and a level or velocity: the flow is given twice"
                              : "has neither levels nor a discharge",
                    "columns are time and level, time, level and velocity, or time and discharge");
    }
}

inline void load_series(TableReader& table, std::string_view key, const SeriesKeys& keys,
                        const OpenSettings& open, OpenSeries& series)
{
    const auto path = path_of_file(table, key, keys.file.value_or(""));
    if (!path) {
        return;
    }
    const double azimuth = keys.azimuth_deg.value_or(azimuth_of(open, keys.map));
    const SeriesSource source{*path,
                              keys.format,
                              keys.columns,
                              azimuth * std::numbers::pi / 180,
                              keys.datum.value_or(keys.map.datum),
                              keys.time_offset,
                              keys.scale};
    std::vector<std::string> faults;
    const double at = series.at;
    const Place place = series.place;
    series = read_series(source, faults);
    series.at = at;
    series.place = place;
    if (faults.empty() && series.levels.empty() && keys.datum) {
        table.error("datum", "has no meaning for a series without levels", "remove it");
    }
    for (const std::string& fault : faults) {
        table.error(key, fault,
                    keys.format == SeriesFormat::geoclaw
                        ? "a gauge of GeoClaw has rows of level, time, h, hu, hv and eta"
                        : "a table has rows of time, level and velocity, of time and level, or of "
                          "time and discharge, with times that ascend");
    }
    if (faults.empty()) {
        check_series(table, key, series);
    } else {
        series = {};
    }
}

/// A series in a file becomes one of the case.
inline void take_series(TableReader& table, const SeriesKeys& keys, OpenSettings& open)
{
    if (!keys.file || !open.series.empty() || table.mistaken()) {
        return;
    }
    OpenSeries series;
    series.place = open.place;
    load_series(table, "series", keys, open, series);
    if (!series.times.empty()) {
        open.series.push_back(std::move(series));
    }
}

inline void check_stations(TableReader& table, const OpenSettings& open)
{
    for (std::size_t k = 1; k < open.series.size(); ++k) {
        const OpenSeries& one = open.series[k - 1];
        const OpenSeries& next = open.series[k];
        if (!(next.at > one.at)) {
            table.error(
                "station",
                fmt::format("the station at {} m is not beyond that at {} m", next.at, one.at),
                "give the stations in ascending order of `at`, at different positions");
        }
        if (next.levels.empty() != one.levels.empty() ||
            next.velocities.empty() != one.velocities.empty() ||
            next.discharges.empty() != one.discharges.empty()) {
            table.error("station", "its stations give different quantities",
                        "each station must give the same ones");
        }
    }
}

inline void finish_station(TableReader& table, const SeriesKeys& keys, const OpenSettings& open,
                           OpenSeries& series)
{
    if (keys.file) {
        if (table.has("times")) {
            table.error("times", "cannot be combined with `file`", "give one of them");
        }
        load_series(table, "file", keys, open, series);
        return;
    }
    if (!table.has("times")) {
        table.error("file", "is missing: a station needs a series", "give `file`, or `times`");
        return;
    }
    if (keys.datum.value_or(0) != 0 || keys.time_offset != 0 || keys.scale != 1 ||
        !keys.columns.empty()) {
        table.error(
            "times",
            "cannot be combined with `datum`, `time_offset`, `scale` or `columns` of the window, "
            "which apply to files",
            "give times and values as they are in the scene");
    }
    for (const auto* values : {&series.levels, &series.velocities, &series.discharges}) {
        if (!values->empty() && values->size() != series.times.size()) {
            table.error(
                "times",
                fmt::format("has {} times for {} values", series.times.size(), values->size()),
                "each time needs one value");
            return;
        }
    }
    const auto unsorted =
        std::ranges::adjacent_find(series.times, [](double a, double b) { return b <= a; });
    if (unsorted != series.times.end()) {
        table.error_at("times", at(unsorted + 1 - series.times.begin()),
                       "is not later than the time before it", "times must ascend");
    }
    check_series(table, "times", series);
}

void keys_of(auto& keys, Is<OpenSeries> auto& series, const SeriesKeys& source,
             const OpenSettings& open)
{
    SeriesKeys own = source;
    own.file.reset(); // the window's
    keys.number(
        "at", series.at, "m",
        "Position of the station along the window: y, or x in a window that opens along y.");
    if (keys.shows(false)) {
        keys.text("file", own.file, "File of the time series, as for `series`.");
    }
    keys.path("times", series.times, "s",
              "Times of a series that is given in the case file, ascending.", no_default, 1);
    if (keys.shows(!series.levels.empty())) {
        keys.path("levels", series.levels, "m", "z of the free surface at each of the times.",
                  no_default, 1);
    }
    if (keys.shows(!series.velocities.empty())) {
        keys.path("velocities", series.velocities, "m/s",
                  "Velocity into the domain at each of the times.", no_default, 1);
    }
    if (keys.shows(!series.discharges.empty())) {
        keys.path("discharges", series.discharges, "",
                  "Discharge into the domain at each of the times [m3/s]; [m2/s] in 2-D.",
                  no_default, 1);
    }
    keys.rule(finish_station, own, open, series);
}

void series_keys(auto& keys, SeriesKeys& source)
{
    keys.text("series", source.file,
              "File of the prescribed time series of the flow, relative to the case file. Values "
              "are interpolated linearly in time, and held constant before the first and after the "
              "last row. [[open.station]] gives several series along a window.");
    keys.choice("format", source.format, {"csv", "geoclaw"},
                "Format of the series. \"csv\": columns time, level and velocity into the domain, "
                "or time and level, or time and discharge, with or without a header; \"geoclaw\": "
                "a gauge file of GeoClaw.");
    keys.texts("columns", source.columns, {"time", "level", "velocity", "discharge", "-"},
               "Quantity of each column of a CSV file; \"-\" skips a column. By default the header "
               "names the quantities.",
               no_default);
    keys.number("azimuth_deg", source.azimuth_deg, "deg",
                "Direction of `into`, clockwise from north, by which the velocities of a GeoClaw "
                "gauge are rotated. By default it follows from the orientation of the terrain; "
                "without a terrain x points east.");
    keys.number("datum", source.datum, "m",
                "z in the scene of level 0 of the file; by default the datum of the terrain.");
    keys.number("time_offset", source.time_offset, "s",
                "Time in the file that corresponds to time 0 of the scene.");
    keys.number("scale", source.scale, "",
                "Factor on the levels above the datum, the velocities "
                "and the discharges of the file.");
    keys.rule(check_columns, source.columns);
}

/// By default bodies stop at an inflow, so that they do not drift out against the entering water.
inline void default_bodies(TableReader& /*table*/, OpenSettings& open)
{
    open.bodies = open.kind == OpenKind::inflow ? BodiesAtSide::stop : BodiesAtSide::leave;
}

void keys_of(auto& keys, Is<OpenSettings> auto& open, const Scene& scene)
{
    SeriesKeys source{.map = map_of(scene)};
    keys.rule(number_name, "open", open.name);
    keys.text("name", open.name, "Name in results; unique among open sides.", "open.1, open.2 ...");
    keys.rule(check_open_name, open, scene);
    keys.planar("min", open.min, "m",
                "Lower corner of the window. The window is a box without thickness along its "
                "normal, on a side of the domain; its lower edge is on the ground or below it.",
                required);
    keys.planar("max", open.max, "m", "Upper corner of the window.", required);
    keys.choice("into", open.into, {"+x", "-x", "+y", "-y"},
                "Direction through the window into the domain.", required);
    keys.rule(check_window, open, scene);
    keys.choice("kind", open.kind, {"inflow", "outflow", "absorb"},
                "Type of the boundary. \"inflow\": prescribes a level, a level and a velocity, or "
                "a discharge, and lets waves from inside leave; \"outflow\": prescribes no flow, "
                "for water that only leaves; \"absorb\": maintains a level and a velocity outside, "
                "by default those of still water at the initial level, and lets waves leave.",
                required);
    keys.number("level", open.level, "m", "z of the free surface outside, if it is constant.");
    keys.number("velocity", open.velocity, "m/s",
                "Velocity into the domain, used with `level`. An inflow with a level but no "
                "velocity is a wave into water that is initially at rest.");
    keys.number("discharge", open.discharge, "m3/s",
                "Discharge into the domain, per metre of width [m2/s] in 2-D. A discharge reflects "
                "waves; it "
                "is intended for channels and basins.");
    if (keys.shows(false)) {
        series_keys(keys, source);
    }
    keys.choice("profile", open.profile, {"uniform", "power"},
                "Velocity profile over the depth: uniform, or proportional to the height above the "
                "ground to the power of 1/7.");
    keys.rule(default_bodies, open);
    keys.choice("bodies", open.bodies, {"stop", "leave"},
                "Treatment of bodies at the window. \"stop\": for bodies the window is a "
                "frictionless wall without rebound; \"leave\": a body that has passed the window "
                "completely is removed from the run and listed in `summary.json`.",
                "stop at an inflow, leave elsewhere");
    if (keys.shows(open.hold)) {
        keys.flag("hold", open.hold,
                  "Whether the last values of a series that ends before the run are held to the "
                  "end of the run without a warning.");
    }
    keys.tables("station",
                "A series at a position along the window; values between stations are interpolated "
                "linearly.",
                open.series, source, open);
    keys.rule(check_asked, open, source);
    keys.rule(check_file_keys, open, source);
    keys.rule(take_series, source, open);
    keys.rule(check_stations, open);
}

} // namespace hyoryu
