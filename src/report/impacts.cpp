// SPDX-License-Identifier: MIT
#include "hyoryu/report/impacts.hpp"

#include "columns.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hyoryu {

double peak_force(const Impact& impact)
{
    return impact.speed * std::sqrt(impact.stiffness * impact.mass);
}

double stiffness_of(const DeclaredStiffness& declared, const std::string& body,
                    const std::string& other)
{
    if (declared.all) {
        return *declared.all;
    }
    const auto a = declared.materials.find(body);
    const auto b = declared.materials.find(other);
    if (a != declared.materials.end() && b != declared.materials.end()) {
        const auto found = declared.of_pairs.find({a->second, b->second});
        if (found != declared.of_pairs.end()) {
            return found->second;
        }
    }
    return std::numeric_limits<double>::quiet_NaN();
}

std::vector<Impact> read_impacts(const CsvTable& contacts, const DeclaredStiffness& declared)
{
    const std::string file = "contacts.csv";
    const auto& time = numbers_of(contacts, "time", file);
    const auto& speed = numbers_of(contacts, "approach_speed", file);
    const auto& impulse = numbers_of(contacts, "normal_impulse", file);
    const auto& energy = numbers_of(contacts, "energy_lost", file);
    const auto& mass = numbers_of(contacts, "effective_mass", file);
    const std::vector<std::string> a = texts_of(contacts, "a", file);
    const std::vector<std::string> b = texts_of(contacts, "b", file);
    const std::vector<std::string> kind = texts_of(contacts, "kind", file);
    std::vector<Impact> impacts;
    for (std::size_t k = 0; k < contacts.rows; ++k) {
        if (kind[k] == "impact") {
            impacts.push_back({time[k], a[k], b[k], speed[k], impulse[k], mass[k], energy[k],
                               stiffness_of(declared, a[k], b[k])});
        }
    }
    return impacts;
}

std::vector<ImpactGroup> by_structure(const std::vector<Impact>& impacts,
                                      const std::vector<std::string>& walls)
{
    std::vector<ImpactGroup> groups;
    std::map<std::string, std::size_t> place;
    for (const std::string& wall : walls) {
        place.emplace(wall, groups.size());
        groups.push_back({wall, {}});
    }
    ImpactGroup between;
    for (const Impact& impact : impacts) {
        const auto found = place.find(impact.other);
        (found == place.end() ? between : groups[found->second]).impacts.push_back(impact);
    }
    groups.push_back(std::move(between));
    return groups;
}

std::vector<Impact> largest(const std::vector<Impact>& impacts, std::size_t at_most)
{
    std::vector<Impact> sorted = impacts;
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const Impact& a, const Impact& b) { return a.impulse > b.impulse; });
    sorted.resize(std::min(at_most, sorted.size()));
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const Impact& a, const Impact& b) { return a.time < b.time; });
    return sorted;
}

} // namespace hyoryu
