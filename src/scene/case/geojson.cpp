// SPDX-License-Identifier: MIT
#include "geojson.hpp"

#include "units.hpp"

#include "hyoryu/core/error.hpp"
#include "hyoryu/core/input_file.hpp"
#include "hyoryu/scene/reader_hint.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace hyoryu {

namespace {

using nlohmann::json;

constexpr std::size_t most_footprints = 100000;
constexpr std::size_t most_faults = 10; // reported for one file

// A fault of a file that is valid JSON.
struct Fault {
    std::string what;
};

// A polygon with its place in the file and its properties.
struct Found {
    const json* polygon = nullptr;    // a list of rings
    const json* properties = nullptr; // none outside of a feature
    std::size_t feature = 0;          // its number from 1 on; 0: none
    std::size_t part = 0;             // of a MultiPolygon of several, from 1 on; 0: the only one
};

// The beginning of a value, for messages.
std::string text_of(const json& value)
{
    constexpr std::size_t most = 40;
    return value.dump(-1, ' ', false, json::error_handler_t::replace).substr(0, most);
}

const json& member(const json& object, const char* name)
{
    const auto found = object.is_object() ? object.find(name) : object.end();
    if (!object.is_object() || found == object.end()) {
        throw Fault{fmt::format("an object without \"{}\"", name)};
    }
    return *found;
}

const json& list(const json& object, const char* name)
{
    const json& items = member(object, name);
    if (!items.is_array()) {
        throw Fault{fmt::format("\"{}\" = {}, expected a list", name, text_of(items))};
    }
    return items;
}

// The polygons of a geometry; other geometries have none.
void collect_geometry(const json& geometry, Found of, std::vector<Found>& found)
{
    const json& type = member(geometry, "type");
    if (type == "Polygon") {
        of.polygon = &list(geometry, "coordinates");
        found.push_back(of);
    } else if (type == "MultiPolygon") {
        const json& polygons = list(geometry, "coordinates");
        for (const json& polygon : polygons) {
            of.polygon = &polygon;
            of.part += polygons.size() > 1 ? 1 : 0;
            found.push_back(of);
        }
    }
}

void collect_feature(const json& feature, std::size_t number, std::vector<Found>& found)
{
    const json& geometry = member(feature, "geometry");
    const auto properties = feature.find("properties");
    if (geometry.is_object()) {
        collect_geometry(
            geometry,
            {.properties = properties == feature.end() ? nullptr : &*properties, .feature = number},
            found);
    }
}

std::vector<Found> collect(const json& document)
{
    std::vector<Found> found;
    const json& type = member(document, "type");
    if (type == "FeatureCollection") {
        std::size_t number = 0;
        for (const json& feature : list(document, "features")) {
            collect_feature(feature, ++number, found);
        }
    } else if (type == "Feature") {
        collect_feature(document, 1, found);
    } else {
        collect_geometry(document, {}, found);
    }
    return found;
}

// A ring of a polygon, without its first corner at the end again.
Ring ring_of(const json& corners)
{
    if (!corners.is_array() || corners.empty()) {
        throw Fault{"a polygon without corners"};
    }
    Ring ring;
    for (const json& point : corners) {
        if (!point.is_array() || point.size() < 2 || !point[0].is_number() ||
            !point[1].is_number()) {
            throw Fault{fmt::format("a corner that is not [x, y]: number {}", ring.size() + 1)};
        }
        ring.push_back({point[0].get<double>(), point[1].get<double>()});
    }
    if (ring.size() > 1 && ring.front() == ring.back()) {
        ring.pop_back();
    }
    return ring;
}

std::vector<Ring> rings_of(const json& polygon)
{
    if (!polygon.is_array() || polygon.empty()) {
        throw Fault{"a polygon without corners"};
    }
    std::vector<Ring> rings;
    for (const json& corners : polygon) {
        rings.push_back(ring_of(corners));
    }
    return rings;
}

// "line 3, column 7" of a byte of a text, from 1 on.
std::string place_in(const std::string& text, std::size_t byte)
{
    const std::size_t end = std::min(byte > 0 ? byte - 1 : 0, text.size());
    const auto before = std::string_view(text).substr(0, end);
    const std::size_t last = before.rfind('\n');
    const std::size_t column = last == std::string_view::npos ? end : end - last - 1;
    return fmt::format("line {}, column {}", std::ranges::count(before, '\n') + 1, column + 1);
}

json parse_file(const std::filesystem::path& file)
{
    const std::string text = bytes_of_file(file, largest_text);
    constexpr int deepest = 16; // a MultiPolygon in a FeatureCollection has eight levels
    bool too_deep = false;
    const auto is_shallow = [&](int depth, json::parse_event_t, json&) {
        too_deep = too_deep || depth > deepest;
        return depth <= deepest;
    };
    try {
        json document = json::parse(text, is_shallow);
        if (too_deep) {
            throw Fault{fmt::format("more than {} levels of nesting, expected polygons", deepest)};
        }
        return document;
    } catch (const json::parse_error& error) {
        throw IoError(fmt::format("{}: is not valid JSON, see {}", file.string(),
                                  place_in(text, error.byte)));
    } catch (const json::out_of_range&) {
        throw Fault{"a number that is too large"};
    }
}

// A property of a feature; a fault names those that there are.
const json& property_of(const Found& found, const std::string& name)
{
    const bool has_some = found.properties != nullptr && found.properties->is_object();
    if (has_some && found.properties->contains(name)) {
        return found.properties->at(name);
    }
    std::vector<std::string> names;
    for (auto at = has_some ? found.properties->begin() : json::const_iterator{};
         has_some && at != found.properties->end(); ++at) {
        names.push_back(at.key().substr(0, 40));
    }
    constexpr std::size_t most = 12;
    names.resize(std::min(names.size(), most));
    const std::vector<std::string_view> known(names.begin(), names.end());
    throw Fault{fmt::format("no property \"{}\"{}", name,
                            known.empty() ? "" : "; it has " + quoted_list(known))};
}

std::string_view without_blanks(std::string_view text)
{
    const auto is_blank = [](char c) { return c == ' ' || c == '\t'; };
    while (!text.empty() && is_blank(text.front())) {
        text.remove_prefix(1);
    }
    while (!text.empty() && is_blank(text.back())) {
        text.remove_suffix(1);
    }
    return text;
}

// The number of a text such as "12.5" or "12.5 m", as maps often have it; a fault is told in words
// that follow "expected a height in m".
double number_of_text(std::string_view text, std::string& fault)
{
    const std::string_view whole = without_blanks(text);
    double number = 0;
    const auto [end, error] = std::from_chars(whole.data(), whole.data() + whole.size(), number);
    const std::string_view rest =
        without_blanks(whole.substr(static_cast<std::size_t>(end - whole.data())));
    if (error != std::errc() || !std::isfinite(number)) {
        fault = ": the text does not begin with a finite number";
    } else if (!rest.empty() && rest != "m") {
        fault = rest.front() == ','
                    ? ": a decimal point is needed in place of the comma"
                    : fmt::format(": behind the number {}, only the unit m may follow", number);
    }
    return number;
}

// A number, or a text that is one.
double height_of(const json& value, const std::string& name)
{
    double height = not_a_number;
    std::string fault;
    if (value.is_number()) {
        height = value.get<double>();
    } else if (value.is_string()) {
        height = number_of_text(value.get_ref<const std::string&>(), fault);
    } else {
        fault = ": it is neither a number nor a text";
    }
    if (!fault.empty()) {
        throw Fault{
            fmt::format("\"{}\" = {}, expected a height in m{}", name, text_of(value), fault)};
    }
    if (!(height > 0) || height > largest_value("m")) {
        throw Fault{fmt::format("\"{}\" = {}, expected a height > 0 m and at most {} m", name,
                                text_of(value), largest_value("m"))};
    }
    return height;
}

std::string name_of(const json& value, const std::string& name)
{
    if (value.is_string()) {
        return value.get<std::string>();
    }
    if (!value.is_number()) {
        throw Fault{fmt::format("\"{}\" = {}, expected a text or a number", name, text_of(value))};
    }
    return text_of(value);
}

Footprint footprint_of(const Found& found, const FootprintKeys& keys)
{
    Footprint footprint{.rings = rings_of(*found.polygon)};
    if (!keys.name_property.empty()) {
        footprint.name = name_of(property_of(found, keys.name_property), keys.name_property);
        if (found.part > 0) {
            footprint.name += fmt::format(".{}", found.part);
        }
    }
    footprint.height =
        keys.height ? *keys.height
                    : height_of(property_of(found, keys.height_property), keys.height_property);
    return footprint;
}

std::string where_is(const Found& found)
{
    const std::string part = found.part > 0 ? fmt::format("polygon {}", found.part) : "";
    return found.feature == 0
               ? (part.empty() ? "polygon" : part)
               : fmt::format("feature {}{}{}", found.feature, part.empty() ? "" : ", ", part);
}

} // namespace

Ring read_polygon(const std::filesystem::path& file)
{
    try {
        const json document = parse_file(file);
        const std::vector<Found> found = collect(document);
        if (found.size() != 1) {
            throw Fault{fmt::format("{} polygons, expected one", found.size())};
        }
        return rings_of(*found.front().polygon).front();
    } catch (const Fault& fault) {
        throw IoError(fmt::format("{}: has {}", file.string(), fault.what));
    }
}

Footprints read_footprints(const std::filesystem::path& file, const FootprintKeys& keys)
{
    Footprints footprints;
    try {
        const json document = parse_file(file);
        const std::vector<Found> found = collect(document);
        if (found.empty() || found.size() > most_footprints) {
            throw Fault{
                fmt::format("{} polygons, expected 1 to {}", found.size(), most_footprints)};
        }
        for (const Found& one : found) {
            try {
                footprints.list.push_back(footprint_of(one, keys));
                footprints.list.back().where = where_is(one);
                footprints.list.back().number = static_cast<std::size_t>(&one - found.data()) + 1;
            } catch (const Fault& fault) {
                footprints.faults.push_back(
                    fmt::format("{}: {} has {}", file.string(), where_is(one), fault.what));
                if (footprints.faults.size() == most_faults) {
                    break;
                }
            }
        }
    } catch (const Fault& fault) {
        throw IoError(fmt::format("{}: has {}", file.string(), fault.what));
    }
    return footprints;
}

} // namespace hyoryu
