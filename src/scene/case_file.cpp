// SPDX-License-Identifier: MIT
#include "hyoryu/scene/case_file.hpp"

#include "hyoryu/core/input_file.hpp"

#include "keys_scene.hpp"

#include <fmt/format.h>

namespace hyoryu {

namespace {

/// Throws the mistakes that were found.
void throw_if_any(const Reading& reading)
{
    if (!reading.diagnostics.empty()) {
        throw CaseError(reading.diagnostics);
    }
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
    Reading reading{.file = file, .lines = lines_to_show(text), .overrides = overrides};
    const TomlNode document = parse_document(text, reading);
    TableReader root(reading, &document, "", "");
    Scene scene;
    scene.file = file;
    keys_of(root, scene);
    root.finish();
    throw_if_any(reading);
    scene.notices = std::move(reading.notices);
    return scene;
}

Scene read_case(const std::filesystem::path& file, const std::vector<std::string>& overrides)
{
    const std::string why = why_unreadable(file, largest_text);
    if (!why.empty()) {
        const bool folder = why.starts_with("is a folder");
        throw CaseError({Diagnostic{.file = file.string(),
                                    .what = "the case file " + why,
                                    .hint = folder ? "name the .toml file in it"
                                                   : "`hyoryu new` writes a case to start from"}});
    }
    return parse_case(bytes_of_file(file), file, overrides);
}

Diagnostic diagnostic_at(const Scene& scene, const Place& place, std::string key, std::string what,
                         std::string hint)
{
    Reading reading{.file = scene.file};
    if (place.line > 0 && why_unreadable(scene.file, largest_text).empty()) {
        reading.lines = lines_to_show(bytes_of_file(scene.file));
    }
    reading.error(place, -1, std::move(key), std::move(what), std::move(hint));
    return reading.diagnostics.front();
}

} // namespace hyoryu
