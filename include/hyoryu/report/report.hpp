// SPDX-License-Identifier: MIT
// One page that shows what a run was and what came out of it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace hyoryu {

struct ReportSettings {
    /// Contact stiffness k of every impact for F = u sqrt(k m) [N/m], in place of what the case
    /// declares for pairs of materials; per metre of width in two dimensions.
    std::optional<double> stiffness;
};

/// The results folder as one self-contained HTML page with inline SVG, also well-formed XML; it
/// needs neither network nor scripts. Throws CaseError if the folder is not that of a run that
/// ended, IoError if a file of it is missing, unreadable or damaged.
std::string report_page(const std::filesystem::path& results, const ReportSettings& settings);

} // namespace hyoryu
