// SPDX-License-Identifier: MIT
#include "hyoryu/report/impacts.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

/// Three columns that share a stem.
struct VectorColumns {
    const std::vector<double>& x;
    const std::vector<double>& y;
    const std::vector<double>& z;
    Vec3 at(std::size_t row) const { return {x[row], y[row], z[row]}; }
};

VectorColumns vectors_of(const CsvTable& table, const std::string& stem)
{
    return {numbers_of(table, stem + "x"), numbers_of(table, stem + "y"),
            numbers_of(table, stem + "z")};
}

using ImpactRows = std::vector<const Impact*>;

/// Vector sum of the normal impulses [N s].
Vec3 normal_sum(const ImpactRows& rows)
{
    Vec3 sum = Vec3::Zero();
    for (const Impact* row : rows) {
        sum += row->impulse * row->normal;
    }
    return sum;
}

/// The rows of one time with the largest normal impulse together.
ImpactRows largest_at_once(const ImpactRows& rows)
{
    ImpactRows best, now;
    for (const Impact* row : rows) {
        if (!now.empty() && now.front()->time != row->time) {
            now.clear();
        }
        now.push_back(row);
        if (best.empty() || normal_sum(now).norm() > normal_sum(best).norm()) {
            best = now;
        }
    }
    return best;
}

/// Mean approach speed of simultaneous impacts, weighted with their impulses [m/s].
double speed_of(const ImpactRows& rows)
{
    double weighted = 0, weight = 0;
    for (const Impact* row : rows) {
        weighted += row->impulse * row->speed;
        weight += row->impulse;
    }
    return weight > 0 ? weighted / weight : rows.front()->speed;
}

Blow blow_of(const ImpactRows& rows)
{
    const Impact& first = *rows.front();
    Blow blow{.time = first.time,
              .body = first.body,
              .other = first.other,
              .points = rows.size(),
              .stiffness = first.law.stiffness};
    Vec3 impulse = Vec3::Zero();
    double weight = 0;
    for (const Impact* row : rows) {
        impulse += row->impulse * row->normal + row->tangential;
        blow.place += row->impulse * row->point;
        weight += row->impulse;
        blow.energy_lost += row->energy_lost;
    }
    blow.place = weight > 0 ? Vec3(blow.place / weight) : first.point;
    blow.impulse = impulse.norm();
    const ImpactRows strongest = largest_at_once(rows);
    blow.speed = speed_of(strongest);
    const double both = (1 + first.law.restitution) * blow.speed;
    blow.mass = both > 0 ? normal_sum(strongest).norm() / both : not_a_number;
    return blow;
}

} // namespace

double peak_force(const Blow& blow)
{
    return blow.speed * std::sqrt(blow.stiffness * blow.mass);
}

ContactLaw law_of(const DeclaredContact& declared, const std::string& body,
                  const std::string& other)
{
    ContactLaw law{not_a_number, not_a_number};
    const auto a = declared.materials.find(body);
    const auto b = declared.materials.find(other);
    if (a != declared.materials.end() && b != declared.materials.end()) {
        const auto found = declared.of_pairs.find({a->second, b->second});
        law = found != declared.of_pairs.end() ? found->second : law;
    }
    law.stiffness = declared.stiffness.value_or(law.stiffness);
    return law;
}

std::vector<Impact> read_contacts(const CsvTable& contacts, const DeclaredContact& declared)
{
    const auto& time = numbers_of(contacts, "time");
    const auto& speed = numbers_of(contacts, "approach_speed");
    const auto& impulse = numbers_of(contacts, "normal_impulse");
    const auto& energy = numbers_of(contacts, "energy_lost");
    const auto& mass = numbers_of(contacts, "effective_mass");
    const VectorColumns point = vectors_of(contacts, "");
    const VectorColumns normal = vectors_of(contacts, "n");
    const VectorColumns tangential = vectors_of(contacts, "tangential_impulse_");
    const std::vector<std::string> a = texts_of(contacts, "a");
    const std::vector<std::string> b = texts_of(contacts, "b");
    const std::vector<std::string> kind = texts_of(contacts, "kind");
    std::vector<Impact> rows;
    for (std::size_t k = 0; k < contacts.rows; ++k) {
        rows.push_back({.kind = kind[k] == "impact" ? Impact::Kind::impact : Impact::Kind::resting,
                        .time = time[k],
                        .body = a[k],
                        .other = b[k],
                        .point = point.at(k),
                        .normal = normal.at(k),
                        .speed = speed[k],
                        .impulse = impulse[k],
                        .tangential = tangential.at(k),
                        .mass = mass[k],
                        .energy_lost = energy[k],
                        .law = law_of(declared, a[k], b[k])});
    }
    return rows;
}

double blow_time(const Impact& first)
{
    constexpr double without_stiffness = 0.01;
    return first.law.stiffness > 0 ? 2 * std::sqrt(first.mass / first.law.stiffness)
                                   : without_stiffness;
}

std::vector<Blow> blows_of(const std::vector<Impact>& rows)
{
    ImpactRows impacts;
    for (const Impact& row : rows) {
        if (row.kind == Impact::Kind::impact) {
            impacts.push_back(&row);
        }
    }
    std::ranges::stable_sort(impacts, {}, &Impact::time);
    std::vector<ImpactRows> blows;
    std::map<std::pair<std::string, std::string>, std::size_t> last; // blow of a pair
    for (const Impact* row : impacts) {
        const auto [place, is_new] = last.emplace(std::pair(row->body, row->other), blows.size());
        const bool goes_on = !is_new && row->time <= blows[place->second].front()->time +
                                                         blow_time(*blows[place->second].front());
        if (!goes_on) {
            place->second = blows.size();
            blows.emplace_back();
        }
        blows[place->second].push_back(row);
    }
    std::vector<Blow> found;
    for (const ImpactRows& blow : blows) {
        found.push_back(blow_of(blow));
    }
    return found;
}

std::vector<ContactGroup> by_structure(const std::vector<Impact>& rows,
                                       const std::vector<std::string>& walls)
{
    std::vector<ContactGroup> groups;
    std::map<std::string, std::size_t> place;
    for (const std::string& wall : walls) {
        place.emplace(wall, groups.size());
        groups.push_back({wall, {}, {}});
    }
    groups.emplace_back();
    const auto group_of = [&](const std::string& other) -> ContactGroup& {
        const auto found = place.find(other);
        return found == place.end() ? groups.back() : groups[found->second];
    };
    for (const Blow& blow : blows_of(rows)) {
        group_of(blow.other).blows.push_back(blow);
    }
    for (const Impact& row : rows) {
        if (row.kind == Impact::Kind::resting) {
            RestingSum& sum = group_of(row.other).resting;
            sum.impulse += row.impulse;
            sum.energy_lost += row.energy_lost;
        }
    }
    return groups;
}

std::vector<Blow> largest(const std::vector<Blow>& blows, std::size_t at_most)
{
    std::vector<Blow> sorted = blows;
    std::ranges::stable_sort(sorted, std::greater<>(), &Blow::impulse);
    sorted.resize(std::min(at_most, sorted.size()));
    std::ranges::stable_sort(sorted, {}, &Blow::time);
    return sorted;
}

} // namespace hyoryu
