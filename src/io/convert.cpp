// SPDX-License-Identifier: MIT
// The frame sets of a results folder, and the names of their exports.
#include "hyoryu/io/convert.hpp"

#include "atomic_file.hpp"
#include "hyoryu/core/error.hpp"
#include "hyoryu/core/types.hpp"
#include "series.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <regex>

namespace hyoryu {

namespace {

namespace fs = std::filesystem;

struct Known {
    const char* name;
    bool has_triangles;
};
constexpr std::array known_sets{Known{"fluid", false}, Known{"bodies", false},
                                Known{"walls", false}, Known{"surfaces", true},
                                Known{"structures", true}};

/// The entries of a series. Throws IoError for a file name that no run writes: it could lead out of
/// the folder.
std::vector<SeriesEntry> checked_series(const fs::path& series, const std::string& name)
{
    const std::regex pattern("frames/" + name + "_[0-9]{6,18}\\.hdf");
    std::vector<SeriesEntry> entries = read_series(series);
    double before = -infinity;
    for (const SeriesEntry& entry : entries) {
        if (!std::regex_match(entry.file.generic_string(), pattern)) {
            throw IoError(fmt::format("`{}` is damaged: it names `{}`, expected "
                                      "`frames/{}_000000.hdf` and so on",
                                      series.string(), entry.file.string(), name));
        }
        if (!(entry.time >= before)) {
            throw IoError(
                fmt::format("`{}` is damaged: its times are not in order", series.string()));
        }
        before = entry.time;
    }
    return entries;
}

} // namespace

std::vector<FrameSet> frame_sets(const fs::path& results)
{
    std::vector<FrameSet> sets;
    for (const auto& [name, has_triangles] : known_sets) {
        const fs::path still = std::string(name) + ".hdf";
        if (const fs::path series = series_file(results, name); fs::exists(series)) {
            sets.push_back({name, has_triangles, true, checked_series(series, name)});
        } else if (fs::exists(results / "frames" / fmt::format("{}_000001.hdf", name))) {
            // The series is written after the first frame and before the second.
            throw IoError(fmt::format("`{}` is missing, which lists the frames of {}",
                                      series.string(), name));
        } else if (fs::exists(results / still)) {
            sets.push_back({name, has_triangles, false, {{still, 0.0}}});
        }
    }
    return sets;
}

std::string frame_number(const SeriesEntry& entry)
{
    const std::string stem = entry.file.stem().string();
    const std::size_t bar = stem.rfind('_');
    return bar == std::string::npos ? "000000" : stem.substr(bar + 1);
}

bool is_export_name(ExportFormat format, const std::string& name)
{
    static const std::regex vtp(
        R"((fluid|bodies|walls|surfaces|structures)(_[0-9]{6,}\.vtp|\.pvd)(\.tmp)?)");
    static const std::regex csv(R"((fluid|bodies|walls)(_[0-9]{6,})?\.csv(\.tmp)?)");
    return format == ExportFormat::vtp   ? std::regex_match(name, vtp)
           : format == ExportFormat::csv ? std::regex_match(name, csv)
                                         : false;
}

} // namespace hyoryu
