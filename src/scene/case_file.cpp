// SPDX-License-Identifier: MIT
#include "hyoryu/scene/case_file.hpp"

#include "reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <tuple>

namespace hyoryu {

namespace {

constexpr std::uintmax_t largest_file = 64u << 20;
constexpr std::size_t most_diagnostics = 100;

/// The lines of a text as messages show them: without tabs, which would shift the caret, and not
/// longer than a screen.
std::vector<std::string> lines_of(const std::string& text)
{
    constexpr std::size_t longest = 200;
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) {
        if (!line.empty() && line.back() == '\r') {
            line.pop_back();
        }
        std::replace_if(
            line.begin(), line.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; },
            ' ');
        lines.push_back(line.size() > longest ? std::string() : line);
    }
    return lines;
}

/// Throws what was found, in the order of the file, the first hundred.
void throw_if_any(Reading& reading)
{
    std::vector<Diagnostic>& found = reading.diagnostics;
    if (found.empty()) {
        return;
    }
    std::stable_sort(found.begin(), found.end(), [](const Diagnostic& a, const Diagnostic& b) {
        return std::tie(a.line, a.column) < std::tie(b.line, b.column);
    });
    if (found.size() > most_diagnostics) {
        const std::size_t more = found.size() - most_diagnostics;
        found.resize(most_diagnostics);
        found.push_back({.file = reading.file.string(),
                         .line = found.back().line,
                         .column = found.back().column,
                         .what = fmt::format("and {} more mistakes", more)});
    }
    throw CaseError(found);
}

TomlNode parse_document(const std::string& text, Reading& reading)
{
    TomlNode root;
    try {
        root = parse_toml(text);
    } catch (const TomlFault& fault) {
        reading.error(fault.place, -1, "", fault.what);
        throw_if_any(reading);
    }
    for (std::size_t k = 0; k < reading.overrides.size(); ++k) {
        const int number = static_cast<int>(k);
        const std::string fault = apply_override(root, reading.overrides[k], number);
        if (!fault.empty()) {
            reading.error(Place{}, number, "", fault);
        }
    }
    return root;
}

Scene read_scene(TableReader& root)
{
    Scene scene;
    scene.file = root.reading().file;
    scene.dimensions = static_cast<int>(root.integer("dimensions"));
    root.reading().dimensions = scene.dimensions;
    read_general(root, scene);
    read_fluid(root.table("fluid"), scene);
    read_walls(root, scene);
    read_bodies(root, scene);
    read_contact(root.table("contact"), scene);
    read_gauges(root, scene);
    read_output(root.table("output"), scene);
    if (!root.has("fluid") && !root.has("body")) {
        root.error("", "the case has nothing to simulate",
                   "add [fluid] with [[fluid.block]], or [[body]]");
    }
    root.finish();
    return scene;
}

} // namespace

Scene parse_case(const std::string& text, const std::filesystem::path& file,
                 const std::vector<std::string>& overrides)
{
    Reading reading{.file = file, .lines = lines_of(text), .overrides = overrides};
    const TomlNode document = parse_document(text, reading);
    TableReader root(reading, &document, "", "");
    Scene scene = read_scene(root);
    throw_if_any(reading);
    return scene;
}

Scene read_case(const std::filesystem::path& file, const std::vector<std::string>& overrides)
{
    std::error_code fault;
    const auto status = std::filesystem::status(file, fault);
    const auto refuse = [&file](std::string what, std::string hint) {
        throw CaseError(
            {Diagnostic{.file = file.string(), .what = std::move(what), .hint = std::move(hint)}});
    };
    if (!std::filesystem::exists(status)) {
        refuse("there is no such file", "`hyoryu new` writes a case to start from");
    }
    if (std::filesystem::is_directory(status)) {
        refuse("is a folder, expected a case file", "name the .toml file in it");
    }
    if (std::filesystem::is_regular_file(status) &&
        std::filesystem::file_size(file, fault) > largest_file) {
        refuse(fmt::format("is larger than {} MiB, which no case file is", largest_file >> 20), "");
    }
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    if (!stream) {
        refuse("cannot be read", "");
    }
    return parse_case(text.str(), file, overrides);
}

Diagnostic diagnostic_at(const Scene& scene, const Place& place, std::string key, std::string what,
                         std::string hint)
{
    Reading reading{.file = scene.file};
    if (place.line > 0) {
        std::ifstream stream(scene.file, std::ios::binary);
        std::ostringstream text;
        text << stream.rdbuf();
        reading.lines = lines_of(text.str());
    }
    reading.error(place, -1, std::move(key), std::move(what), std::move(hint));
    return reading.diagnostics.front();
}

} // namespace hyoryu
