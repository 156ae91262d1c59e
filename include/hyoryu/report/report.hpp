// SPDX-License-Identifier: MIT
// The report: one HTML page about a run, made from its results folder. Each section is a function
// from the read results to HTML with inline SVG; the page loads no other file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace hyoryu {

struct ReportSettings {
    /// Contact stiffness k of all impacts for F = u sqrt(k m) [N/m], instead of the values that the
    /// case declares for pairs of materials; per metre of width in two dimensions.
    std::optional<double> stiffness;
};

/// The results folder as one self-contained HTML page with inline SVG, also well-formed XML; it
/// needs neither network nor scripts. Throws CaseError if the folder is not that of a run that
/// ended, IoError if a file of it is missing, unreadable or damaged.
std::string report_page(const std::filesystem::path& results, const ReportSettings& settings);

} // namespace hyoryu
