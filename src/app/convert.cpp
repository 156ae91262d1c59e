// SPDX-License-Identifier: MIT
// `hyoryu convert`: the frames of a run for other programs.
#include "commands.hpp"
#include "options.hpp"

#include "hyoryu/core/error.hpp"
#include "hyoryu/io/claim.hpp"
#include "hyoryu/io/convert.hpp"
#include "hyoryu/io/results.hpp"
#include "hyoryu/scene/reader_hint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

namespace hyoryu {

namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 3> formats{"vtp", "csv", "vtkhdf"};

ExportFormat format_named(const std::string& name)
{
    const auto found = std::ranges::find(formats, name);
    if (found == formats.end()) {
        const std::string hint = did_you_mean(name, formats);
        throw CaseError(fmt::format("unknown format \"{}\"", name),
                        hint.empty() ? fmt::format("known: {}", quoted_list(formats)) : hint);
    }
    return static_cast<ExportFormat>(found - formats.begin());
}

// Tables hold particles alone. So does the one file with time, unless surfaces are asked for: its
// arrays are those of all that it holds.
bool is_default(const FrameSet& set, ExportFormat format)
{
    return format == ExportFormat::vtp || !set.has_triangles;
}

const FrameSet& set_named(const std::vector<FrameSet>& sets, const std::string& name)
{
    std::vector<std::string_view> known;
    for (const FrameSet& set : sets) {
        if (set.name == name) {
            return set;
        }
        known.push_back(set.name);
    }
    const std::string hint = did_you_mean(name, known);
    throw CaseError(fmt::format("--only: the results contain no \"{}\"", name),
                    hint.empty() ? fmt::format("known: {}", quoted_list(known)) : hint);
}

std::vector<FrameSet> chosen_sets(const ConvertOptions& options, ExportFormat format)
{
    const std::vector<FrameSet> sets = frame_sets(options.folder);
    std::vector<FrameSet> chosen;
    if (options.only.empty()) {
        std::ranges::copy_if(sets, std::back_inserter(chosen),
                             [&](const FrameSet& set) { return is_default(set, format); });
        return chosen;
    }
    const std::set<std::string> names(options.only.begin(), options.only.end());
    for (const std::string& name : names) {
        chosen.push_back(set_named(sets, name));
        if (format == ExportFormat::csv && chosen.back().has_triangles) {
            throw CaseError(
                fmt::format("--only: \"{}\" are triangles, which cannot be written to a table of "
                            "points",
                            name),
                "use --to vtp for triangles");
        }
    }
    return chosen;
}

// The frame nearest to each time, in the order of the times of the run.
void keep_nearest(FrameSet& set, const std::vector<double>& times)
{
    if (!set.moves || times.empty() || set.frames.empty()) {
        return;
    }
    std::set<std::size_t> kept;
    for (const double time : times) {
        kept.insert(nearest_in_time(set.frames, time));
    }
    std::vector<SeriesEntry> frames;
    for (const std::size_t k : kept) {
        frames.push_back(set.frames[k]);
    }
    set.frames = std::move(frames);
}

[[noreturn]] void refuse_conversion(const fs::path& place)
{
    throw CaseError(fmt::format("`{}` contains an earlier conversion", place.string()),
                    "--force replaces it, -o selects another location");
}

// A folder that has the mark of a conversion, and no files of an earlier one.
void prepare_folder(const fs::path& folder, ExportFormat format, const ConvertOptions& options)
{
    const auto is_ours = [format](const std::string& name) { return is_export_name(format, name); };
    claim_folder(folder, {.command = "convert", .owns = is_ours});
    try {
        std::vector<std::string> old = owned_names(folder, is_ours);
        std::erase_if(old,
                      [&](const std::string& name) { return !fs::is_regular_file(folder / name); });
        if (!old.empty() && !options.force) {
            refuse_conversion(folder);
        }
        for (const std::string& name : old) {
            fs::remove(folder / name);
        }
    } catch (const fs::filesystem_error& error) {
        throw IoError(
            fmt::format("cannot prepare `{}`: {}", folder.string(), error.code().message()));
    }
}

void expect_free_file(const fs::path& file, const ConvertOptions& options)
{
    if (!fs::exists(fs::symlink_status(file))) {
        return;
    }
    if (!is_exported_vtkhdf(file)) {
        throw CaseError(
            fmt::format("`{}` exists and was not written by a conversion", file.string()),
            "choose another file with -o");
    }
    if (!options.force) {
        refuse_conversion(file);
    }
}

std::size_t number_of_frames(const std::vector<FrameSet>& sets)
{
    std::size_t count = 0;
    for (const FrameSet& set : sets) {
        count += set.frames.size();
    }
    return count;
}

void convert_to_folder(const ConvertOptions& options, ExportFormat format,
                       const std::vector<FrameSet>& sets)
{
    const fs::path folder =
        options.output.empty() ? options.folder / options.format : options.output;
    prepare_folder(folder, format, options);
    for (const FrameSet& set : sets) {
        const std::size_t count = format == ExportFormat::vtp
                                      ? export_vtp(options.folder, set, folder)
                                      : export_csv(options.folder, set, folder);
        fmt::print(
            "{:<12} {} frames: {}\n", set.name, count,
            (folder / (set.name + (format == ExportFormat::vtp ? ".pvd" : ".csv"))).string());
    }
}

void convert_to_file(const ConvertOptions& options, const std::vector<FrameSet>& sets)
{
    const fs::path file = options.output.empty() ? options.folder / "all.vtkhdf" : options.output;
    expect_free_file(file, options);
    const std::size_t steps = export_vtkhdf(options.folder, sets, file);
    fmt::print("{} time steps: {}\n", steps, file.string());
}

} // namespace

int convert_results(const ConvertOptions& options)
{
    const ExportFormat format = format_named(options.format);
    expect_results(options.folder);
    std::vector<FrameSet> sets = chosen_sets(options, format);
    for (FrameSet& set : sets) {
        keep_nearest(set, options.times);
    }
    if (number_of_frames(sets) == 0) {
        throw CaseError(fmt::format("{} contains no frames yet", options.folder.string()),
                        "`hyoryu info` lists its contents");
    }
    if (format == ExportFormat::vtkhdf) {
        convert_to_file(options, sets);
    } else {
        convert_to_folder(options, format, sets);
    }
    return exit_code::done;
}

} // namespace hyoryu
