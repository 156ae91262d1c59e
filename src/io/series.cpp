// SPDX-License-Identifier: MIT
// Reading and writing `.hdf.series` files.
#include "series.hpp"

#include "hyoryu/core/error.hpp"
#include "hyoryu/core/input_file.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace hyoryu {

void write_series(const std::filesystem::path& series, const std::vector<SeriesEntry>& entries)
{
    nlohmann::ordered_json files = nlohmann::ordered_json::array();
    for (const SeriesEntry& entry : entries) {
        files.push_back({{"name", entry.file.generic_string()}, {"time", entry.time}});
    }
    const nlohmann::ordered_json json{{"file-series-version", "1.0"}, {"files", files}};
    write_text(series, json.dump(1) + "\n");
}

std::vector<SeriesEntry> read_series(const std::filesystem::path& series)
{
    const std::string text = bytes_of_file(series);
    try {
        const nlohmann::json json = nlohmann::json::parse(text);
        std::vector<SeriesEntry> entries;
        for (const nlohmann::json& file : json.at("files")) {
            entries.push_back({file.at("name").get<std::string>(), file.at("time").get<double>()});
        }
        return entries;
    } catch (const nlohmann::json::exception& error) {
        throw IoError(fmt::format("`{}` is not a series file: {}", series.string(), error.what()));
    }
}

std::vector<std::string> series_names(const std::filesystem::path& folder)
{
    std::vector<std::string> names;
    std::error_code missing; // a folder that is not there holds no series
    for (const auto& entry : std::filesystem::directory_iterator(folder, missing)) {
        const std::string file = entry.path().filename().string();
        if (file.ends_with(series_suffix)) {
            names.push_back(file.substr(0, file.size() - series_suffix.size()));
        }
    }
    std::sort(names.begin(), names.end());
    return names;
}

std::filesystem::path series_file(const std::filesystem::path& folder, const std::string& name)
{
    return folder / (name + std::string(series_suffix));
}

} // namespace hyoryu
