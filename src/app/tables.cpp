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

Table ranks_table()
{
    return {"ranks",
            {{"time", "s"},
             {"rank", ""},
             {"host", ""},
             {"particles", ""},
             {"ghosts", ""},
             {"busy", "s"},
             {"waited", "s"},
             {"messages", ""},
             {"sent", "B"},
             {"memory", "B"}}};
}

Table energy_table(const Scene& scene)
{
    const int dimensions = scene.dimensions;
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
    if (!scene.open.empty()) {
        table.heads.push_back({"open_energy", per_width("J", dimensions)});
        add_vector(table, "open_impulse_", per_width("N s", dimensions));
    }
    return table;
}

Table open_table(const Scene& scene)
{
    Table table{"open", {{"time", "s"}}};
    const bool flat = scene.dimensions == 2;
    for (const OpenSettings& open : scene.open) {
        table.heads.push_back({open.name + "_level", "m"});
        table.heads.push_back({open.name + "_velocity", "m/s"});
        table.heads.push_back({open.name + "_discharge", flat ? "m2/s" : "m3/s"});
        for (const char* name : {"_volume_in", "_volume_out", "_volume_asked"}) {
            table.heads.push_back({open.name + name, flat ? "m2" : "m3"});
        }
    }
    return table;
}

Table gauges_table(std::vector<Table::Head> gauges)
{
    Table table{"gauges", {{"time", "s"}}};
    table.heads.insert(table.heads.end(), gauges.begin(), gauges.end());
    return table;
}

} // namespace hyoryu
