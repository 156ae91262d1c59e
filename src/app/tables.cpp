// SPDX-License-Identifier: MIT
#include "tables.hpp"

#include <string>

namespace hyoryu {

namespace {

void add_vector(Table& table, const std::string& stem, const std::string& unit)
{
    for (const char axis : {'x', 'y', 'z'}) {
        table.heads.push_back({stem + axis, unit});
    }
}

std::string per_width(const std::string& unit, int dimensions)
{
    return dimensions == 2 ? unit + "/m" : unit;
}

} // namespace

Table bodies_table(int dimensions)
{
    Table table{"bodies", {{"time", "s"}, {"body", ""}}};
    add_vector(table, "", "m");
    for (const char* name : {"qw", "qx", "qy", "qz"}) {
        table.heads.push_back({name, ""});
    }
    add_vector(table, "v", "m/s");
    add_vector(table, "w", "rad/s");
    add_vector(table, "f", per_width("N", dimensions));
    add_vector(table, "t", per_width("N m", dimensions));
    return table;
}

Table contacts_table(int dimensions)
{
    Table table{"contacts", {{"time", "s"}, {"a", ""}, {"b", ""}}};
    add_vector(table, "", "m");
    add_vector(table, "n", "");
    table.heads.push_back({"approach_speed", "m/s"});
    table.heads.push_back({"normal_impulse", per_width("N s", dimensions)});
    add_vector(table, "tangential_impulse_", per_width("N s", dimensions));
    table.heads.push_back({"energy_lost", per_width("J", dimensions)});
    table.heads.push_back({"effective_mass", per_width("kg", dimensions)});
    table.heads.push_back({"kind", ""});
    table.heads.push_back({"located", ""});
    return table;
}

Table energy_table(int dimensions)
{
    Table table{"energy", {{"time", "s"}}};
    for (const char* name : {"fluid_kinetic", "fluid_potential", "fluid_internal", "body_kinetic",
                             "body_potential", "contact_loss"}) {
        table.heads.push_back({name, per_width("J", dimensions)});
    }
    add_vector(table, "momentum_", per_width("kg m/s", dimensions));
    add_vector(table, "wall_impulse_", per_width("N s", dimensions));
    add_vector(table, "gravity_impulse_", per_width("N s", dimensions));
    table.heads.push_back({"lost_energy", per_width("J", dimensions)});
    add_vector(table, "lost_momentum_", per_width("kg m/s", dimensions));
    return table;
}

Table gauges_table(std::vector<Table::Head> gauges)
{
    Table table{"gauges", {{"time", "s"}}};
    table.heads.insert(table.heads.end(), gauges.begin(), gauges.end());
    return table;
}

std::vector<double> numbers_of(const Contact& c)
{
    std::vector<double> n{c.time, static_cast<double>(c.a), static_cast<double>(c.b)};
    for (const Vec3* v : {&c.point, &c.normal, &c.tangential_impulse}) {
        n.insert(n.end(), v->begin(), v->end());
    }
    n.insert(n.end(), {c.approach_speed, c.normal_impulse, c.effective_mass, c.energy_lost,
                       c.located ? 1.0 : 0.0});
    return n;
}

Contact contact_of(std::span<const double> n)
{
    const auto vector = [&](std::size_t k) { return Vec3(n[k], n[k + 1], n[k + 2]); };
    return {.kind = Contact::Kind::resting,
            .time = n[0],
            .a = static_cast<int>(n[1]),
            .b = static_cast<int>(n[2]),
            .point = vector(3),
            .normal = vector(6),
            .approach_speed = n[12],
            .normal_impulse = n[13],
            .tangential_impulse = vector(9),
            .effective_mass = n[14],
            .energy_lost = n[15],
            .located = n[16] != 0};
}

} // namespace hyoryu
