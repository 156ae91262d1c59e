// SPDX-License-Identifier: MIT
#include "hyoryu/scene/case_file.hpp"

#include "hyoryu/core/input_file.hpp"

#include "keys_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <tuple>

namespace hyoryu {

namespace {

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

/// Throws the mistakes that were found, in the order of the file, at most a hundred.
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
                         .what = fmt::format("and {} more errors", more)});
    }
    throw CaseError(found);
}

TomlNode parse_document(const std::string& text, Reading& reading)
{
    TomlNode root;
    try {
        root = parse_toml(text);
    } catch (const TomlFault& fault) {
        reading.error(fault.place, -1, "", fault.what, fault.hint);
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

} // namespace

Scene parse_case(const std::string& text, const std::filesystem::path& file,
                 const std::vector<std::string>& overrides)
{
    Reading reading{.file = file, .lines = lines_of(text), .overrides = overrides};
    const TomlNode document = parse_document(text, reading);
    TableReader root(reading, &document, "", "");
    Scene scene;
    scene.file = file;
    keys_of(root, scene);
    root.finish();
    throw_if_any(reading);
    return scene;
}

Scene read_case(const std::filesystem::path& file, const std::vector<std::string>& overrides)
{
    const std::string why = why_unreadable(file, largest_text);
    if (!why.empty()) {
        const bool folder = why.starts_with("is a folder");
        throw CaseError({Diagnostic{.file = file.string(),
                                    .what = "the case file " + why,
                                    .hint = folder ? "name the .toml file in it" : ""}});
    }
    return parse_case(bytes_of_file(file), file, overrides);
}

Diagnostic diagnostic_at(const Scene& scene, const Place& place, std::string key, std::string what,
                         std::string hint)
{
    Reading reading{.file = scene.file};
    if (place.line > 0 && why_unreadable(scene.file, largest_text).empty()) {
        reading.lines = lines_of(bytes_of_file(scene.file));
    }
    reading.error(place, -1, std::move(key), std::move(what), std::move(hint));
    return reading.diagnostics.front();
}

} // namespace hyoryu
