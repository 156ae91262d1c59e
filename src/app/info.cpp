// SPDX-License-Identifier: MIT
// `hyoryu info`: the contents of a results folder, as text or as JSON.
#include "commands.hpp"
#include "options.hpp"
#include "plan_report.hpp"

#include "hyoryu/core/error.hpp"
#include "hyoryu/core/input_file.hpp"
#include "hyoryu/io/convert.hpp"
#include "hyoryu/io/results.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <limits>
#include <utility>

namespace hyoryu {

namespace {

namespace fs = std::filesystem;
using json = nlohmann::ordered_json;

// A JSON file of a run. A value that is missing is empty or 0, one of another type is damage.
struct Record {
    std::string file;
    json values = json::object();

    std::string text(const std::string& key) const
    {
        return value(key, &json::is_string, "text", std::string());
    }
    double number(const std::string& key) const
    {
        if (values.contains(key) && values[key].is_null()) {
            return std::numeric_limits<double>::quiet_NaN(); // which JSON cannot write
        }
        return value(key, &json::is_number, "number", 0.0);
    }
    std::int64_t count(const std::string& key) const
    {
        return value(key, &json::is_number_integer, "whole number", std::int64_t{0});
    }
    Record part(const std::string& key) const
    {
        return {file, value(key, &json::is_object, "JSON object", json::object())};
    }

private:
    template <class T>
    T value(const std::string& key, bool (json::*is)() const noexcept, const char* expected,
            T missing) const
    {
        if (values.contains(key) && !(values[key].*is)()) {
            throw IoError(fmt::format("`{}` is damaged: `{}` is not a {}", file, key, expected));
        }
        return values.value(key, std::move(missing));
    }
};

Record read_record(const fs::path& file)
{
    Record record{file.string()};
    if (fs::exists(file)) {
        record.values = json::parse(bytes_of_file(file, largest_text), nullptr, false);
        if (!record.values.is_object()) {
            throw IoError(fmt::format("`{}` is damaged: it is not a JSON object", file.string()));
        }
    }
    return record;
}

json counts_of(const Record& plan)
{
    const Record counts = plan.part("counts");
    json result;
    for (const char* name : {"fluid", "wall", "body", "bodies"}) {
        result[name] = counts.count(name);
    }
    return result;
}

// null while the run goes on, or if it ended without a summary
json run_of(const fs::path& folder)
{
    const Record summary = read_record(folder / "summary.json");
    if (summary.values.empty()) {
        return nullptr;
    }
    return {{"version", summary.text("version")},
            {"exit_reason", summary.text("exit_reason")},
            {"steps", summary.count("steps")},
            {"simulated_seconds", summary.number("simulated_seconds")},
            {"wall_seconds", summary.number("wall_seconds")},
            {"threads", summary.count("threads")},
            {"particles_lost", summary.count("particles_lost")},
            {"worst_density_error", summary.number("worst_density_error")}};
}

json frames_of(const fs::path& folder)
{
    json all = json::array();
    for (const FrameSet& set : frame_sets(folder)) {
        json one{{"name", set.name},
                 {"file", set.name + (set.moves ? ".hdf.series" : ".hdf")},
                 {"frames", set.frames.size()},
                 {"first_time", nullptr},
                 {"last_time", nullptr}};
        if (set.moves && !set.frames.empty()) {
            one["first_time"] = set.frames.front().time;
            one["last_time"] = set.frames.back().time;
        }
        all.push_back(std::move(one));
    }
    return all;
}

json histories_of(const fs::path& folder)
{
    json names = json::array();
    for (const char* name :
         {"bodies.csv", "contacts.csv", "energy.csv", "gauges.csv", "open.csv"}) {
        if (fs::exists(folder / name)) {
            names.push_back(name);
        }
    }
    return names;
}

json info_of(const fs::path& folder)
{
    const Record plan = read_record(folder / "plan.json");
    const std::int64_t dimensions =
        plan.values.contains("dimensions") ? plan.count("dimensions") : 3;
    return {{"title", plan.text("title")},
            {"dimensions", dimensions},
            {"counts", counts_of(plan)},
            {"run", run_of(folder)},
            {"frames", frames_of(folder)},
            {"histories", histories_of(folder)},
            {"checkpoint", find_checkpoint(folder) != UsableCheckpoint::none}};
}

std::string run_lines(const json& run)
{
    if (run.is_null()) {
        return fmt::format("{:<12} running, or ended without a summary\n", "state");
    }
    return fmt::format("{:<12} {}: {} steps to t = {:.9g} s in {} on {} threads\n", "state",
                       run["exit_reason"].get<std::string>(), run["steps"].get<std::int64_t>(),
                       run["simulated_seconds"].get<double>(),
                       readable_seconds(run["wall_seconds"].get<double>()),
                       run["threads"].get<std::int64_t>()) +
           fmt::format("{:<12} {} lost, density error at most {:.2g}\n", "particles",
                       run["particles_lost"].get<std::int64_t>(),
                       run["worst_density_error"].get<double>());
}

std::string frames_line(const json& set)
{
    const std::string name = set["name"];
    const std::string file = set["file"];
    if (set["frames"] == 0) {
        return fmt::format("{:<12} no frames\n", name);
    }
    if (set["first_time"].is_null()) {
        return fmt::format("{:<12} at rest ({})\n", name, file);
    }
    return fmt::format("{:<12} {} frames, t = {:.9g} .. {:.9g} s ({})\n", name,
                       set["frames"].get<std::size_t>(), set["first_time"].get<double>(),
                       set["last_time"].get<double>(), file);
}

std::string info_text(const json& info)
{
    const json& counts = info["counts"];
    std::string text = fmt::format("{:<12} {}\n", "title", info["title"].get<std::string>());
    text += fmt::format("{:<12} {} fluid, {} wall, {} body particles; {} bodies; {}-D\n", "size",
                        counts["fluid"].get<std::int64_t>(), counts["wall"].get<std::int64_t>(),
                        counts["body"].get<std::int64_t>(), counts["bodies"].get<std::int64_t>(),
                        info["dimensions"].get<std::int64_t>());
    text += run_lines(info["run"]);
    for (const json& set : info["frames"]) {
        text += frames_line(set);
    }
    std::string names;
    for (const json& name : info["histories"]) {
        names += (names.empty() ? "" : ", ") + name.get<std::string>();
    }
    text += fmt::format("{:<12} {}\n", "histories", names);
    text +=
        fmt::format("{:<12} {}\n", "checkpoint", info["checkpoint"].get<bool>() ? "yes" : "none");
    return text;
}

} // namespace

int show_info(const InfoOptions& options)
{
    expect_results(options.folder);
    const json info = info_of(options.folder);
    if (options.json) {
        constexpr int indent = 2;
        fmt::print("{}\n", info.dump(indent, ' ', false, json::error_handler_t::replace));
    } else {
        fmt::print("{}", info_text(info));
    }
    return exit_code::done;
}

} // namespace hyoryu
