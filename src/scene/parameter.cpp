// SPDX-License-Identifier: MIT
// The table of keys as one list, and the search in it.
#include "hyoryu/scene/parameter.hpp"

#include "parameter_table.hpp"

#include <array>
#include <map>

namespace hyoryu {

namespace {

std::vector<Parameter> all_parameters()
{
    std::vector<Parameter> all;
    for (const auto part : {general_parameters, fluid_parameters, wall_parameters, body_parameters,
                            contact_parameters, output_parameters}) {
        for (Parameter& parameter : part()) {
            all.push_back(std::move(parameter));
        }
    }
    return all;
}

std::map<std::string_view, const Parameter*> by_key()
{
    std::map<std::string_view, const Parameter*> result;
    for (const Parameter& parameter : parameters()) {
        result.emplace(parameter.key, &parameter);
    }
    return result;
}

constexpr std::array planned = {
    PlannedKey{"fluid.block[].shape", "particles"},
    PlannedKey{"wall[].shape", "terrain"},
};

} // namespace

std::span<const Parameter> parameters()
{
    static const std::vector<Parameter> all = all_parameters();
    return all;
}

const Parameter* find_parameter(std::string_view key)
{
    static const std::map<std::string_view, const Parameter*> index = by_key();
    const auto at = index.find(key);
    return at == index.end() ? nullptr : at->second;
}

std::span<const PlannedKey> planned_keys()
{
    return planned;
}

} // namespace hyoryu
