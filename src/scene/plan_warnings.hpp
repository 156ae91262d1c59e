// SPDX-License-Identifier: MIT
// Warnings of a plan, each with its place in the case file.
#pragma once

#include "hyoryu/scene/case_file.hpp"
#include "hyoryu/scene/plan.hpp"

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

/// Adds to the warnings of a plan.
class PlanWarnings {
public:
    PlanWarnings(const Scene& scene, Plan& plan) : scene_(scene), plan_(plan) {}

    /// `key` as a user writes it; `what` is wrong, and a hint.
    void add(const Place& place, std::string key, std::string what, std::string hint)
    {
        warn(scene_, place, std::move(key), std::move(what), std::move(hint), plan_);
    }

private:
    const Scene& scene_;
    Plan& plan_;
};

} // namespace hyoryu
