// SPDX-License-Identifier: MIT
#include "hyoryu/scene/gauge_columns.hpp"

#include <array>

namespace hyoryu {

namespace {

void add_vector(std::vector<Table::Head>& heads, const std::string& stem, const std::string& unit)
{
    for (const char axis : {'x', 'y', 'z'}) {
        heads.push_back({stem + '_' + axis, unit});
    }
}

} // namespace

std::vector<Table::Head> raw_columns(const Gauge& gauge, int dimensions)
{
    const bool flat = dimensions == 2;
    std::vector<Table::Head> heads;
    switch (gauge.type) {
    case GaugeType::elevation:
    case GaugeType::front:
        heads.push_back({gauge.name, "m"});
        break;
    case GaugeType::pressure:
        heads.push_back({gauge.name, "Pa"});
        break;
    case GaugeType::flux:
        heads.push_back({gauge.name, flat ? "m2/s" : "m3/s"});
        break;
    case GaugeType::velocity:
        add_vector(heads, gauge.name, "m/s");
        break;
    case GaugeType::force:
        for (const char* part : {"", "_pressure", "_viscous", "_contact"}) {
            add_vector(heads, gauge.name + part, flat ? "N/m" : "N");
        }
        for (const char* part : {"_fluid_impulse", "_contact_impulse"}) {
            add_vector(heads, gauge.name + part, flat ? "N s/m" : "N s");
        }
        break;
    }
    return heads;
}

std::size_t filtered_columns(const Gauge& gauge)
{
    if (gauge.filter == GaugeFilter::none) {
        return 0;
    }
    return gauge.type == GaugeType::velocity || gauge.type == GaugeType::force ? 3 : 1;
}

std::vector<Table::Head> gauge_columns(const Gauge& gauge, int dimensions)
{
    constexpr std::array<const char*, 4> names{"", "_mean", "_median", "_exponential"};
    std::vector<Table::Head> heads = raw_columns(gauge, dimensions);
    const std::size_t filtered = filtered_columns(gauge);
    for (std::size_t k = 0; k < filtered; ++k) {
        heads.push_back(
            {heads[k].name + names[static_cast<std::size_t>(gauge.filter)], heads[k].unit});
    }
    return heads;
}

} // namespace hyoryu
