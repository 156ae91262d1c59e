// SPDX-License-Identifier: MIT
// The data of a report, read from a results folder.
#pragma once

#include "hyoryu/core/snapshot.hpp"
#include "hyoryu/io/csv_table.hpp"
#include "hyoryu/report/impacts.hpp"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>

namespace hyoryu {

struct RunResults {
    std::filesystem::path folder;
    nlohmann::ordered_json plan, summary;
    std::string case_text;
    double spacing = 0;             // of fluid and walls [m]
    std::vector<std::string> walls; // names, in the order of the case
    std::vector<std::string> gauge_names;
    DeclaredContact contact; // as the case declares it
    CsvTable energy;
    std::optional<CsvTable> bodies, contacts, gauges; // none where the plan has none
    std::optional<CsvTable> ranks;                    // of several processes
    std::optional<Surface> structures;                // walls at the start

    int dimensions() const { return plan.at("dimensions").get<int>(); }
    /// "N" in three dimensions, "N/m" in two.
    std::string per_width(const std::string& unit) const
    {
        return dimensions() == 2 ? unit + "/m" : unit;
    }
};

/// Reads everything. Throws as `report_page`.
RunResults read_results(const std::filesystem::path& folder);

/// A number of a JSON file; NaN where it says null, as it does for numbers that are not finite.
double number(const nlohmann::ordered_json& value);

} // namespace hyoryu
