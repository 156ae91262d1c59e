// SPDX-License-Identifier: MIT
// The JSON file series that ParaView opens by a double click: which frame belongs to which time.
#pragma once

#include "hyoryu/io/results.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace hyoryu {

inline constexpr std::string_view series_suffix = ".hdf.series";

/// Writes the series file; the entries' files are relative to its folder.
void write_series(const std::filesystem::path& series, const std::vector<SeriesEntry>& entries);

/// Names of the series in a results folder ("fluid", "bodies"...), sorted.
std::vector<std::string> series_names(const std::filesystem::path& folder);

std::filesystem::path series_file(const std::filesystem::path& folder, const std::string& name);

} // namespace hyoryu
