// SPDX-License-Identifier: MIT
#include "resume.hpp"

#include "case_files.hpp"
#include "ranks.hpp"

#include "hyoryu/core/error.hpp"
#include "hyoryu/core/input_file.hpp"
#include "hyoryu/core/name.hpp"
#include "hyoryu/io/results.hpp"
#include "hyoryu/scene/case_difference.hpp"
#include "hyoryu/scene/case_file.hpp"
#include "hyoryu/sim/carry_over.hpp"
#include "hyoryu/sim/checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <sstream>

namespace hyoryu {

namespace {

namespace fs = std::filesystem;

// Most differences that a refusal lists.
constexpr std::size_t most_listed = 20;
// Between overrides in a checkpoint: none of them holds it.
constexpr char separator = '\0';

[[noreturn]] void refuse(const Scene& scene, const std::vector<KeyDifference>& differences,
                         const char* hint)
{
    std::vector<Diagnostic> mistakes;
    for (const KeyDifference& d : differences) {
        if (mistakes.size() == most_listed) {
            mistakes.push_back(
                {.file = scene.file.string(),
                 .what = fmt::format("and {} more keys", differences.size() - most_listed)});
            break;
        }
        const auto value = [](const std::string& text) {
            return text.empty() ? "no such key" : text;
        };
        mistakes.push_back(
            {.file = scene.file.string(),
             .key = d.key,
             .what = fmt::format("the checkpoint was written with {}, the case has {}: geometry "
                                 "and physics cannot change in a resumed run",
                                 value(d.before), value(d.after))});
    }
    mistakes.back().hint = hint;
    throw CaseError(mistakes);
}

// The case as the user gave it; empty if its file cannot be read.
GivenCase given_case(const RunOptions& options)
{
    return why_unreadable(options.case_file, largest_text).empty()
               ? GivenCase{bytes_of_file(options.case_file), options.overrides}
               : GivenCase{};
}

GivenCase given_case(const Snapshot& state)
{
    const auto text = [&](const std::string& name) {
        const auto found = state.texts.find(name);
        return found == state.texts.end() ? std::string() : found->second;
    };
    GivenCase given{text("given"), {}};
    std::istringstream overrides(text("overrides"));
    for (std::string line; std::getline(overrides, line, separator);) {
        given.overrides.push_back(line);
    }
    return given;
}

// Differences of [[debris]] in the place of those of their pieces, which follow from them.
void name_debris(const GivenCase& before, const GivenCase& after, const Scene& scene,
                 std::vector<KeyDifference>& differences)
{
    std::vector<KeyDifference> of_debris = debris_differences(before, after);
    if (before.text.empty() || of_debris.empty()) {
        return;
    }
    const std::vector<std::string> prefixes = piece_prefixes(after);
    const auto is_piece = [&](const BodySettings& b) {
        return std::ranges::any_of(prefixes,
                                   [&](const std::string& p) { return b.name.starts_with(p); });
    };
    std::erase_if(differences, [&](const KeyDifference& d) {
        constexpr std::string_view body = "body[";
        std::size_t k = 0;
        const bool of_body =
            d.key.starts_with(body) &&
            std::from_chars(d.key.data() + body.size(), d.key.data() + d.key.size(), k).ec ==
                std::errc();
        return of_body && (k >= scene.bodies.size() || is_piece(scene.bodies[k]));
    });
    differences.insert(differences.begin(), of_debris.begin(), of_debris.end());
}

// Before the case of the checkpoint is read, which reads the files again.
void refuse_changed_files(const Snapshot& state, const Scene& scene)
{
    const auto files = state.texts.find("files");
    if (files == state.texts.end()) {
        return; // the case named none
    }
    const std::vector<KeyDifference> changed =
        file_differences(files->second, hashes_of_files(scene));
    if (!changed.empty()) {
        refuse(scene, changed, "restore the file, or restart with --force");
    }
}

Scene case_of(const Snapshot& state)
{
    const auto stored = state.texts.find("case");
    if (stored == state.texts.end()) {
        throw IoError("the checkpoint does not contain its case: it is damaged");
    }
    try {
        return parse_case(stored->second, "checkpoint");
    } catch (const CaseError& error) {
        throw IoError(fmt::format("the case of the checkpoint cannot be read: it was written by "
                                  "another version, or a file that it names has changed\n"
                                  "{}",
                                  error.what()));
    }
}

bool leaves_frames_to_default(const Scene& scene)
{
    return scene.output.every == scene.time.end / 100;
}

// For a shell: a single quote ends the quotes, is escaped, and begins them again.
std::string quoted(const std::string& word)
{
    constexpr std::string_view harmless =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./:,+@%=";
    if (!word.empty() && word.find_first_not_of(harmless) == std::string::npos) {
        return word;
    }
    return "'" + replaced(word, {{'\'', "'\\''"}}) + "'";
}

// A column of a history is of one thing: gauges that keep their name keep what they read.
void refuse_other_gauges(const Scene& before, const Scene& scene)
{
    std::vector<Diagnostic> mistakes;
    for (std::size_t k = 0; k < scene.gauges.size(); ++k) {
        const Gauge& gauge = scene.gauges[k];
        const auto same = std::ranges::find(before.gauges, gauge.name, &Gauge::name);
        if (same != before.gauges.end() && (same->type != gauge.type || same->on != gauge.on)) {
            mistakes.push_back(diagnostic_without_line(
                scene, gauge.place,
                fmt::format("gauge[{}].{}", k, same->type != gauge.type ? "type" : "on"),
                fmt::format("\"{}\" read something else before the checkpoint", gauge.name),
                "give the gauge another name"));
        }
    }
    if (!mistakes.empty()) {
        show_places(scene, mistakes);
        throw CaseError(mistakes);
    }
}

Resumption resumption_of(const RunOptions& options, const fs::path& folder, const Scene& scene)
{
    auto [state, parts, passed_over] = read_newest_checkpoint(folder);
    refuse_changed_files(state, scene);
    const Scene before = case_of(state);
    Resumption found{.state = {}, .parts = parts, .scene = scene, .passed_over = passed_over};
    if (leaves_frames_to_default(before) && leaves_frames_to_default(scene)) {
        found.scene.output.every = before.output.every;
    }
    std::vector<KeyDifference> differences =
        case_differences(state.texts.at("case"), to_toml(found.scene));
    found.changed = !differences.empty();
    std::erase_if(differences, [](const KeyDifference& d) { return may_change_on_resume(d.key); });
    if (!differences.empty()) {
        name_debris(given_case(state), given_case(options), scene, differences);
        refuse(scene, differences,
               "run with the case.toml in the results folder, or restart with --force");
    }
    refuse_other_gauges(before, scene);
    const double time = time_of(state);
    if (scene.time.end < time * (1 - 1e-9)) {
        throw CaseError(
            {Diagnostic{.file = scene.file.string(),
                        .key = "time.end",
                        .what = fmt::format("{} s is before the checkpoint, which is at {} s",
                                            scene.time.end, time),
                        .hint = "set a later `time.end`, or restart with --force"}});
    }
    if (found.changed) {
        carry_over(state, before, found.scene);
    }
    found.state = std::move(state);
    return found;
}

} // namespace

std::map<std::string, std::string> texts_of_given_case(const RunOptions& options,
                                                       const Scene& scene)
{
    std::map<std::string, std::string> texts;
    if (std::string files = hashes_of_files(scene); !files.empty()) {
        texts.emplace("files", std::move(files));
    }
    const GivenCase given = given_case(options);
    if (piece_prefixes(given).empty()) {
        return texts;
    }
    std::string overrides;
    for (const std::string& text : given.overrides) {
        overrides += text + separator;
    }
    texts.emplace("given", given.text);
    texts.emplace("overrides", overrides);
    return texts;
}

Resumption resumption_for_all(const RunOptions& options, const fs::path& folder, const Scene& scene,
                              Comm* comm)
{
    Resumption found =
        writes(comm) ? resumption_of(options, folder, scene) : Resumption{.scene = scene};
    if (comm != nullptr) {
        std::vector<Parcel> out(static_cast<std::size_t>(comm->size()));
        if (writes(comm)) {
            Parcel parcel;
            put(parcel, found.scene.output.every);
            put(parcel, found.changed);
            put(parcel, found.parts.size());
            for (const CheckpointPart& part : found.parts) {
                put_text(parcel, part.name);
                put(parcel, part.bytes);
                put(parcel, part.checksum);
            }
            std::ranges::fill(out, parcel);
        }
        const std::vector<Parcel> in = comm->exchange(std::move(out));
        Unpacking from(in.front());
        found.scene.output.every = from.take<double>();
        found.changed = from.take<bool>();
        found.parts.resize(from.take<std::size_t>());
        for (CheckpointPart& part : found.parts) {
            part = {take_text(from), from.take<std::uint64_t>(), from.take<std::uint32_t>()};
        }
    }
    return found;
}

std::string command_to_go_on(const RunOptions& options, const fs::path& folder)
{
    std::string line = fmt::format("{} run {} -o {}", quoted(options.program),
                                   quoted(options.case_file.string()), quoted(folder.string()));
    for (const std::string& set : options.overrides) {
        line += " --set " + quoted(set);
    }
    if (options.threads > 0) {
        line += fmt::format(" --threads {}", options.threads);
    }
    return line + (options.quiet ? " --quiet --resume" : " --resume");
}

} // namespace hyoryu
