// SPDX-License-Identifier: MIT
// Entries of a plan: warnings, each with its place in the case file, and effects.
#pragma once

#include "hyoryu/scene/case_file.hpp"
#include "hyoryu/scene/plan.hpp"

#include <string>
#include <utility>

namespace hyoryu {

/// Adds a warning to a plan: `key` as a user writes it, what is wrong, and a hint.
inline void warn(const Scene& scene, const Place& place, std::string key, std::string what,
                 std::string hint, Plan& plan)
{
    Diagnostic note =
        diagnostic_without_line(scene, place, std::move(key), std::move(what), std::move(hint));
    note.severity = Diagnostic::Severity::warning;
    plan.warnings.push_back(std::move(note));
}

/// The table of the case file that a solid comes from, as a user writes it; its number in the scene
/// if it was not read from a file.
inline std::string table_of(const BodySettings& body, std::size_t number)
{
    return body.table.empty() ? "body[" + std::to_string(number) + "]" : body.table;
}
inline std::string table_of(const Wall& wall, std::size_t number)
{
    return wall.table.empty() ? "wall[" + std::to_string(number) + "]" : wall.table;
}

/// Lists an effect as on or off, with the reason for that.
inline void list_effect(Plan& plan, std::string name, bool runs, std::string why,
                        std::string why_not)
{
    auto& effects = runs ? plan.on : plan.off;
    effects.push_back({std::move(name), runs ? std::move(why) : std::move(why_not)});
}

} // namespace hyoryu
