// SPDX-License-Identifier: MIT
// The impacts of a run, by what was hit, and a design formula for their peak force.
#pragma once

#include "hyoryu/io/csv_table.hpp"

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hyoryu {

/// One contact point of an impact: a row of contacts.csv. Per metre of width in two dimensions.
struct Impact {
    double time = 0; // [s]
    std::string body;
    std::string other;      // wall or body that was hit
    double speed = 0;       // of approach along the normal [m/s]
    double impulse = 0;     // along the normal [N s]
    double mass = 0;        // effective mass at the point along the normal [kg]
    double energy_lost = 0; // [J]
    double stiffness = 0;   // declared for the pair [N/m]; NaN if none is
};

/// u sqrt(k m) [N]: peak of the undamped spring k [N/m] that stops the mass m [kg] from the speed
/// u [m/s]. NaN if k is. Source: Haehnel and Daly (2004), J. Hydraul. Eng. 130(2), 112-120; the
/// contact stiffness approach of ASCE 7.
double peak_force(const Impact& impact);

/// Contact stiffness as the user declared it [N/m].
struct DeclaredStiffness {
    std::optional<double> all;                                      // of every contact
    std::map<std::pair<std::string, std::string>, double> of_pairs; // of materials, both orders
    std::map<std::string, std::string> materials;                   // of bodies and walls by name
};
/// NaN if none is declared for the two.
double stiffness_of(const DeclaredStiffness& declared, const std::string& body,
                    const std::string& other);

/// The rows of contacts.csv that are impacts. Throws IoError for a column that is missing or holds
/// texts for numbers.
std::vector<Impact> read_impacts(const CsvTable& contacts, const DeclaredStiffness& declared);

/// Impacts on one wall, or between bodies (`structure` is empty).
struct ImpactGroup {
    std::string structure;
    std::vector<Impact> impacts; // in the order of time
};
/// One group a wall, in their order and also where nothing hit it, then the impacts between bodies.
std::vector<ImpactGroup> by_structure(const std::vector<Impact>& impacts,
                                      const std::vector<std::string>& walls);

/// The `at_most` impacts with the largest impulses, in the order of time.
std::vector<Impact> largest(const std::vector<Impact>& impacts, std::size_t at_most);

} // namespace hyoryu
