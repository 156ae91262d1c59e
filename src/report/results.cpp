// SPDX-License-Identifier: MIT
#include "results.hpp"

#include "hyoryu/core/error.hpp"
#include "hyoryu/core/input_file.hpp"
#include "hyoryu/io/results.hpp"
#include "hyoryu/scene/toml_document.hpp"

#include <fmt/format.h>

#include <limits>

namespace hyoryu {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

ordered_json read_json(const fs::path& file)
{
    ordered_json value = ordered_json::parse(bytes_of_file(file), nullptr, false);
    if (!value.is_object()) {
        throw IoError(fmt::format("`{}` is damaged: it is not a JSON object", file.string()));
    }
    return value;
}

void expect_ended_run(const fs::path& folder)
{
    expect_results(folder);
    if (!fs::exists(folder / "summary.json")) {
        throw CaseError(
            fmt::format("`{}` has no summary.json: the run is not finished, or was killed",
                        folder.string()),
            "`hyoryu run CASE.toml -o RESULTS --resume` continues from its checkpoint");
    }
}

std::string text_at(const TomlTable& table, std::string_view key)
{
    const TomlEntry* entry = find_entry(table, key);
    const auto* text = entry == nullptr ? nullptr : std::get_if<std::string>(&entry->node.value);
    return text == nullptr ? std::string() : *text;
}

/// The tables of an array of tables.
std::vector<const TomlTable*> tables_at(const TomlTable& root, std::string_view key)
{
    std::vector<const TomlTable*> tables;
    const TomlEntry* entry = find_entry(root, key);
    if (entry != nullptr && entry->node.array() != nullptr) {
        for (const TomlNode& node : *entry->node.array()) {
            if (node.table() != nullptr) {
                tables.push_back(node.table());
            }
        }
    }
    return tables;
}

double spacing_of(const TomlTable& root)
{
    const TomlEntry* particles = find_entry(root, "particles");
    const TomlTable* table = particles == nullptr ? nullptr : particles->node.table();
    const TomlEntry* spacing = table == nullptr ? nullptr : find_entry(*table, "spacing");
    const double* value = spacing == nullptr ? nullptr : std::get_if<double>(&spacing->node.value);
    return value == nullptr ? std::numeric_limits<double>::quiet_NaN() : *value;
}

/// The resolved case, which names everything; meshes need not be there any more.
void read_resolved_case(RunResults& run)
{
    const fs::path file = run.folder / "case.toml";
    run.case_text = bytes_of_file(file);
    try {
        const TomlNode root = parse_toml(run.case_text);
        run.spacing = spacing_of(*root.table());
        if (!(run.spacing > 0)) {
            throw IoError(
                fmt::format("`{}` is damaged: it has no particles.spacing", file.string()));
        }
        for (const TomlTable* wall : tables_at(*root.table(), "wall")) {
            run.walls.push_back(text_at(*wall, "name"));
            run.contact.materials[text_at(*wall, "name")] = text_at(*wall, "material");
        }
        for (const TomlTable* gauge : tables_at(*root.table(), "gauge")) {
            run.gauge_names.push_back(text_at(*gauge, "name"));
        }
        for (const TomlTable* body : tables_at(*root.table(), "body")) {
            run.contact.materials[text_at(*body, "name")] = text_at(*body, "material");
        }
    } catch (const TomlFault& fault) {
        throw IoError(fmt::format("`{}` is damaged: line {}: {}", file.string(), fault.place.line,
                                  fault.what));
    }
}

void read_contact_laws(RunResults& run)
{
    if (!run.plan.contains("contact")) {
        return;
    }
    const auto name = [](const ordered_json& material) {
        return material.is_null() ? std::string() : material.get<std::string>();
    };
    for (const ordered_json& pair : run.plan.at("contact").at("pairs")) {
        const std::string a = name(pair.at("materials").at(0));
        const std::string b = name(pair.at("materials").at(1));
        const ContactLaw law{number(pair.at("stiffness")), number(pair.at("restitution"))};
        run.contact.of_pairs[{a, b}] = law;
        run.contact.of_pairs[{b, a}] = law;
    }
}

// The last row of a history is at most an interval before the end of a run that is done.
void expect_complete(const RunResults& run, const char* name, const CsvTable& history)
{
    if (run.summary.at("exit_reason") != "done") {
        return;
    }
    constexpr double intervals = 2; // which differ by a time step
    const double end = number(run.summary.at("simulated_seconds"));
    const std::vector<double>& times = numbers_of(history, "time");
    const auto rows = static_cast<double>(times.size());
    const double last = times.empty() ? 0 : times.back();
    const double mean = rows > 1 ? (last - times.front()) / (rows - 1) : end;
    if (times.empty() || last + intervals * mean < end) {
        throw IoError(fmt::format("`{}` is damaged: {}, but the run ended at {:.6g} s",
                                  (run.folder / name).string(),
                                  times.empty() ? std::string("it has no rows")
                                                : fmt::format("it ends at {:.6g} s", last),
                                  end));
    }
}

void read_histories(RunResults& run)
{
    const ordered_json& counts = run.plan.at("counts");
    run.energy = read_csv(run.folder / "energy.csv");
    expect_complete(run, "energy.csv", run.energy);
    if (counts.at("bodies").get<int>() > 0) {
        run.bodies = read_csv(run.folder / "bodies.csv");
    }
    if (run.plan.contains("contact")) {
        run.contacts = read_csv(run.folder / "contacts.csv");
    }
    if (!run.gauge_names.empty()) {
        run.gauges = read_csv(run.folder / "gauges.csv");
        expect_complete(run, "gauges.csv", *run.gauges);
    }
    if (run.summary.contains("ranks")) {
        run.ranks = read_csv(run.folder / "ranks.csv");
    }
    if (counts.at("walls").get<int>() > 0) {
        run.structures = read_surface(run.folder / "structures.hdf");
    }
}

} // namespace

RunResults read_results(const fs::path& folder)
{
    expect_ended_run(folder);
    RunResults run;
    run.folder = folder;
    run.plan = read_json(folder / "plan.json");
    run.summary = read_json(folder / "summary.json");
    read_resolved_case(run);
    read_contact_laws(run);
    read_histories(run);
    return run;
}

double number(const ordered_json& value)
{
    return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}

} // namespace hyoryu
