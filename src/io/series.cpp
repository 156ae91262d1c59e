// SPDX-License-Identifier: MIT
// Reading and writing `.hdf.series` files.
#include "series.hpp"

#include "hyoryu/core/error.hpp"
#include "hyoryu/core/input_file.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <regex>
#include <set>

namespace hyoryu {

namespace {

// Other names would lead out of the folder, and have no number.
void expect_frames(const std::filesystem::path& series, const std::vector<SeriesEntry>& entries)
{
    static const std::regex pattern("(frames/)?[A-Za-z]+_[0-9]{1,18}\\.hdf");
    std::set<std::string> names;
    for (const SeriesEntry& entry : entries) {
        const std::string name = entry.file.generic_string();
        if (!std::regex_match(name, pattern)) {
            throw IoError(fmt::format("`{}` is damaged: it names `{}`, expected "
                                      "`frames/fluid_000000.hdf` and so on",
                                      series.string(), name));
        }
        if (!names.insert(name).second) {
            throw IoError(
                fmt::format("`{}` is damaged: it names `{}` twice", series.string(), name));
        }
    }
}

} // namespace

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
        expect_frames(series, entries);
        return entries;
    } catch (const nlohmann::json::exception&) {
        throw IoError(
            fmt::format("`{}` is damaged: expected JSON with the name and the time of each "
                        "frame",
                        series.string()));
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
