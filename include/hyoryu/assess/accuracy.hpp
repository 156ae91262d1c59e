// SPDX-License-Identifier: MIT
// The expected error of a scene, interpolated from the studies in docs/studies (docs/accuracy.md).
#pragma once

#include "hyoryu/scene/plan.hpp"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hyoryu {

/// One quantity of a scene; `error` is NaN where the setting lies outside the studied range.
struct ExpectedError {
    std::string quantity;
    double error = 0;                     // relative [1]
    std::string why;                      // the number of the scene that it follows from
    std::string halving;                  // the setting that would halve it, and its cost
    std::string study;                    // folder below docs/studies
    std::vector<std::string> not_covered; // how the scene differs from the studied ones
};

/// A rung of a study: the value of the swept setting and the error there.
struct StudiedRung {
    double number = 0;
    double error = 0; // [1]
};

/// The properties that all runs of a study share: it does not apply to scenes without them.
struct StudyCoverage {
    std::string_view study; // folder below docs/studies, also that of the case below cases
    int dimensions = 3;
    Index most_bodies = 0;      // that move
    double fewest_spacings = 0; // over the depth of the water
    double most_spacings = infinity;
    std::span<const std::string_view> effects; // names in the plan of its case, but for gauges
    std::span<const std::string_view> models;  // those of them without which it says nothing
    std::span<const StudiedRung> rungs;        // the rungs in docs/studies, in ascending order
};
/// Pressure of still water against c0/sqrt(g H), SPH; arrival of a bore against spacings in the
/// depth; motion of the timber of 1 m against the step [s].
extern const StudyCoverage still_water_study, bore_study, timber_study;

/// How a scene differs from those of a study, in words; empty if the study covers it. `depth`: of
/// the water [m]; 0 without water.
std::vector<std::string> not_covered(const StudyCoverage& coverage, const Scene& scene,
                                     const Plan& plan, double depth);

/// The main quantities of the scene. Empty for a scene of which no study says anything.
std::vector<ExpectedError> expected_errors(const Scene& scene, const Filling& filling,
                                           const Plan& plan);

/// For a terminal.
std::string expected_errors_text(const std::vector<ExpectedError>& errors);

} // namespace hyoryu
