// SPDX-License-Identifier: MIT
// The blows of a run, by the struck solid, and a design formula for their peak force. The solver
// logs an impact for each contact point; the rows of one pair that follow each other within the
// time that the materials take to give way and spring back are one blow.
#pragma once

#include "hyoryu/core/types.hpp"
#include "hyoryu/io/csv_table.hpp"

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hyoryu {

/// Contact parameters of two materials.
struct ContactLaw {
    double stiffness = 0;   // declared, for the formula of the peak force [N/m]; NaN if none is
    double restitution = 0; // [1]; NaN under the penalty method
};

/// One contact point: a row of contacts.csv. Per metre of width in two dimensions.
struct Impact {
    enum class Kind { impact, resting };
    Kind kind = Kind::impact;
    double time = 0; // [s]
    std::string body;
    std::string other; // wall or body that was hit
    Vec3 point{0, 0, 0};
    Vec3 normal{0, 0, 0};
    double speed = 0;         // of approach along the normal [m/s]
    double impulse = 0;       // along the normal [N s]
    Vec3 tangential{0, 0, 0}; // impulse across it [N s]
    double mass = 0;          // effective mass at the point along the normal [kg]
    double energy_lost = 0;   // [J]
    ContactLaw law;           // of the pair
};

/// All impacts of one pair within `blow_time` of the first of them. Per metre of width in two
/// dimensions.
struct Blow {
    double time = 0; // of the first impact [s]
    std::string body;
    std::string other;      // wall or body that was hit
    std::size_t points = 0; // rows of contacts.csv
    Vec3 place{0, 0, 0};    // mean of the points, weighted with their impulses [m]
    double impulse = 0;     // length of the sum of all impulses, friction included [N s]
    double speed = 0; // of approach, mean over the largest group of simultaneous impacts [m/s]
    double mass = 0;  // effective: normal impulse of that group over (1 + e) speed [kg]
    double energy_lost = 0; // [J]
    double stiffness = 0;   // of the pair [N/m]; NaN if none is declared
};

/// u sqrt(k m) [N]: peak of the undamped spring k [N/m] that stops the mass m [kg] from the speed
/// u [m/s]. NaN if k is. Source: Haehnel and Daly (2004), J. Hydraul. Eng. 130(2), 112-120; the
/// contact stiffness approach of ASCE 7.
double peak_force(const Blow& blow);

/// The laws of contact as the case declares them.
struct DeclaredContact {
    std::optional<double> stiffness;                                    // of every contact [N/m]
    std::map<std::pair<std::string, std::string>, ContactLaw> of_pairs; // of materials, both orders
    std::map<std::string, std::string> materials; // of bodies and walls by name
};
/// NaN where nothing is declared for the two.
ContactLaw law_of(const DeclaredContact& declared, const std::string& body,
                  const std::string& other);

/// The rows of contacts.csv, impacts and sums of resting contact. Throws IoError for a column that
/// is missing or holds texts for numbers.
std::vector<Impact> read_contacts(const CsvTable& contacts, const DeclaredContact& declared);

/// The time within which impacts of a pair are one blow [s]: 2 sqrt(m/k), about the time that a
/// spring k takes to stop the mass m and to throw it back, pi sqrt(m/k), in which the sum of the
/// impulses acts; 10 ms where no stiffness is declared.
double blow_time(const Impact& first);

/// The impacts among the rows as blows, in the order of time.
std::vector<Blow> blows_of(const std::vector<Impact>& rows);

/// Sums of resting and sliding contact, which acts all the time: normal impulses, pair after pair
/// and interval after interval, and the energy lost by friction.
struct RestingSum {
    double impulse = 0;     // [N s]
    double energy_lost = 0; // [J]
};

/// Impacts on one wall, or among bodies (`structure` is empty).
struct ContactGroup {
    std::string structure;
    std::vector<Blow> blows; // in the order of time
    RestingSum resting;
};
/// One group a wall, in their order and also where nothing hit it, then bodies among themselves.
std::vector<ContactGroup> by_structure(const std::vector<Impact>& rows,
                                       const std::vector<std::string>& walls);

/// The `at_most` blows with the largest impulses, in the order of time.
std::vector<Blow> largest(const std::vector<Blow>& blows, std::size_t at_most);

} // namespace hyoryu
