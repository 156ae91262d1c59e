// SPDX-License-Identifier: MIT
// The keys of contact.
#pragma once

#include "keys_names.hpp"

#include "hyoryu/scene/reader_hint.hpp"

#include <set>

namespace hyoryu {

inline bool same_pair(const MaterialPair& a, const MaterialPair& b)
{
    return a.materials == b.materials ||
           (a.materials[0] == b.materials[1] && a.materials[1] == b.materials[0]);
}

inline void choose_method(TableReader& table, bool springs, const PenaltyParameters& penalty,
                          ContactSettings& contact)
{
    if (springs) {
        contact.penalty = penalty;
        if (table.has("law")) {
            table.error("law", "has no meaning with method = \"penalty\"",
                        "laws apply to the impulse method: omit `law`");
        }
        if (table.has("locating_share")) {
            table.error("locating_share", "has no meaning with method = \"penalty\"",
                        "the penalty method does not locate impacts: omit `locating_share`");
        }
    } else if (const TomlNode* node = table.find("penalty");
               node != nullptr && node->table() != nullptr &&
               table.sound("method") == table.has("method")) {
        table.error("penalty", "has no meaning with method = \"impulse\"",
                    "omit the table, or write method = \"penalty\"");
    }
}

inline void find_materials(TableReader& /*table*/, const Scene& scene,
                           std::set<std::string>& materials)
{
    for (const Wall& wall : scene.walls) {
        materials.insert(wall.material);
    }
    for (const BodySettings& body : scene.bodies) {
        materials.insert(body.material);
    }
    materials.erase("");
}

inline void check_pair(TableReader& table, const MaterialPair& pair, const ContactSettings& contact,
                       const std::set<std::string>& materials)
{
    if (!table.sound("materials")) {
        return;
    }
    const bool known_all = table.reading().names_known;
    const std::vector<std::string_view> known(materials.begin(), materials.end());
    for (std::size_t k = 0; k < pair.materials.size(); ++k) {
        if (known_all && materials.count(pair.materials[k]) == 0) {
            const std::string near = did_you_mean(pair.materials[k], known);
            table.error_at(
                "materials", k,
                fmt::format("no wall or body has the material \"{}\"", pair.materials[k]),
                known.empty()  ? "give `material` in [[wall]] and [[body]]"
                : near.empty() ? "known: " + quoted_list(known)
                               : near);
        }
    }
    const bool again = std::ranges::any_of(
        contact.pairs, [&](const MaterialPair& other) { return same_pair(pair, other); });
    if (again && !pair.materials[0].empty()) {
        table.error("materials", "this pair is already defined", "remove one of the two");
    }
}

void keys_of(auto& keys, Is<PenaltyParameters> auto& penalty)
{
    keys.positive("stiffness", penalty.stiffness, "N/m",
                  "Stiffness of a pair of particles; in 2-D per metre of width.");
    keys.not_negative("damping", penalty.damping, "N s/m",
                      "Damping coefficient of a pair of particles along the line between them, and "
                      "perpendicular to it up to the friction limit; in 2-D per metre of width.");
    keys.positive("step", penalty.step, "s",
                  "Maximum sub-step of the explicit integration; a time step of the bodies is "
                  "divided into equal sub-steps.");
}

void keys_of(auto& keys, Is<MaterialPair> auto& pair, const ContactSettings& contact,
             const std::set<std::string>& materials)
{
    keys.text_list("materials", pair.materials, 2,
                   "Names of the two materials, as given for walls and bodies.", required);
    keys.rule(check_pair, pair, contact, materials);
    keys.rule(inherit, pair.restitution, contact.restitution);
    keys.rule(inherit, pair.friction, contact.friction);
    keys.fraction("restitution", pair.restitution, "Coefficient of restitution of the pair.",
                  "contact.restitution");
    keys.not_negative("friction", pair.friction, "", "Dynamic friction coefficient of the pair.",
                      "contact.friction");
    keys.positive("stiffness", pair.stiffness, "N/m",
                  "Contact stiffness, used only by the impact force formulae of the report.");
}

void keys_of(auto& keys, Is<ContactSettings> auto& contact, const Scene& scene)
{
    bool springs = contact.penalty.has_value();
    keys.choice(
        "method", springs, {"impulse", "penalty"},
        "Contact method. \"impulse\" solves for the impulses that prevent penetration, with "
        "friction; \"penalty\" uses springs between particles and is a baseline for comparison.");
    if (keys.shows(!springs)) {
        keys.choice(
            "law", contact.law, {"coupled", "paper", "simultaneous"},
            "Impact law of the impulse method. \"coupled\": all approaching contacts are solved "
            "together, in repeated rounds, with the circular Coulomb cone; \"paper\": the "
            "uncoupled equations (1)-(6) of the Iwate paper, which can increase the energy; "
            "\"simultaneous\": all touching contacts are solved at once (Moreau).");
        keys.not_negative(
            "locating_share", contact.locating_share, "",
            "Work limit for locating impacts in time, as a fraction of the cost of the fluid in a "
            "step, in addition to a small allowance per body. Beyond the limit impacts are "
            "resolved by time stepping, beginning with the bodies that have the most impacts; "
            "contacts.csv marks each contact as located or not. Impulse method only.");
    }
    keys.fraction("restitution", contact.restitution,
                  "Coefficient of restitution of all pairs of materials without a contact.pair. In "
                  "the penalty method it follows from stiffness and damping.");
    keys.not_negative(
        "friction", contact.friction, "",
        "Dynamic friction coefficient of all pairs of materials without a contact.pair.");
    PenaltyParameters penalty = contact.penalty.value_or(PenaltyParameters{});
    if (keys.shows(springs)) {
        keys.table("penalty", "Parameters of the penalty method, for method = \"penalty\".",
                   penalty);
    }
    keys.rule(choose_method, springs, penalty, contact);
    std::set<std::string> materials;
    keys.rule(find_materials, scene, materials);
    keys.tables("pair", "Contact parameters of a pair of materials.", contact.pairs, contact,
                materials);
}

} // namespace hyoryu
