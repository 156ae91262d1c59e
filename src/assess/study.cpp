// SPDX-License-Identifier: MIT
// Reading a study and listing its runs.
#include "hyoryu/assess/study.hpp"

#include "hyoryu/core/input_file.hpp"
#include "hyoryu/core/name.hpp"
#include "hyoryu/io/results.hpp"
#include "reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <set>

namespace hyoryu {

namespace {

namespace fs = std::filesystem;

// Each is planned before the first one starts, and is a process: more would take weeks.
constexpr int most_runs_of_study = 10000;

constexpr std::array<std::string_view, 2> modes{"one_at_a_time", "grid"};
constexpr std::array<std::string_view, 3> ends{"smallest", "largest", "none"};

bool is_count(const RunParameter& value)
{
    const auto* number = std::get_if<double>(&value);
    return number != nullptr && *number >= 1 && *number <= 4096 && std::floor(*number) == *number;
}

void check_label(Section& section, std::string_view key, const Place& place,
                 const std::string& text)
{
    const std::string fault = label_fault(text);
    if (!fault.empty()) {
        section.file().error(place, section.full(key), "cannot be shown: " + fault);
    }
}

void read_values(Section& section, StudySweep& sweep)
{
    const auto nodes = section.items("values");
    for (const TomlNode* node : nodes) {
        if (const auto value = read_parameter(section.file(), *node, section.full("values"))) {
            if (const auto* text = std::get_if<std::string>(&*value)) {
                check_label(section, "values", node->place, *text);
            }
            sweep.values.push_back(*value);
        }
    }
    if (nodes.empty() && section.has("values")) {
        section.error("values", "is empty: expected the values to try, numbers or texts",
                      "for instance [0.1, 0.05]");
    }
}

// `choices`: a name and a list of overrides for each.
void read_choices(Section& section, StudySweep& sweep)
{
    for (const TomlEntry* entry : section.entries("choices")) {
        check_label(section, "choices", entry->place, entry->key);
        sweep.values.emplace_back(entry->key);
        sweep.choices.emplace_back();
        const TomlArray* items = entry->node.array();
        const TomlArray none;
        for (const TomlNode& item : items != nullptr ? *items : none) {
            if (const auto* text = std::get_if<std::string>(&item.value)) {
                sweep.choices.back().push_back(*text);
            } else {
                items = nullptr;
                break;
            }
        }
        if (items == nullptr) {
            section.file().error(entry->node.place, section.full("choices." + entry->key),
                                 "expected a list of texts, overrides of the case as in `set`");
        }
    }
}

void check_name(Section& section, const StudySweep& sweep)
{
    const bool is_name =
        !sweep.name.empty() && std::isdigit(static_cast<unsigned char>(sweep.name[0])) == 0 &&
        std::ranges::all_of(sweep.name,
                            [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
    if (!is_name) {
        section.error("name",
                      fmt::format("\"{}\" cannot be used as a name in an expression", sweep.name),
                      "use letters, digits and _");
    }
}

StudySweep read_sweep(Section& section)
{
    StudySweep sweep;
    const bool has_choices = section.has("choices");
    if (has_choices == section.has("values")) {
        section.error("", "give one of `values` and `choices`");
    }
    if (!has_choices && !section.has("set") && !section.has("key")) {
        section.error("", "does not name a setting to vary", "give `key`, or `set` with a `name`");
    }
    sweep.key = section.text("key");
    if (section.has("key") && sweep.key.empty()) {
        section.error("key", "expected a key of the case", "for instance \"particles.spacing\"");
    }
    sweep.set = section.texts("set");
    const auto dot = sweep.key.find_last_of('.');
    sweep.name =
        section.text("name", dot == std::string::npos ? sweep.key : sweep.key.substr(dot + 1));
    if (has_choices) {
        read_choices(section, sweep);
    }
    if (!has_choices || section.has("values")) {
        read_values(section, sweep);
    }
    if (has_choices && !sweep.key.empty()) {
        section.error("key", "has no meaning with `choices`, which contain the keys that they set");
    }
    sweep.finest = static_cast<StudySweep::Finest>(section.choice("finest", ends).value_or(0));
    if (sweep.key == threads_key && !std::ranges::all_of(sweep.values, is_count)) {
        section.error("values", "expected whole numbers of threads, 1 to 4096");
    }
    if (!sweep.key.empty() || section.has("name")) {
        check_name(section, sweep);
    } else if (!section.has("key")) {
        section.require("name");
    }
    section.finish();
    return sweep;
}

// Exactly one of `expected`, `reference` and `against = "finest"`.
void read_expected(Section& section, StudyQuantity& quantity)
{
    constexpr std::array<std::string_view, 1> known{"finest"};
    quantity.against_finest = section.choice("against", known) || section.has("against");
    if (read_expectation(section, quantity.expected) + (quantity.against_finest ? 1 : 0) != 1) {
        section.error("", "give one of `expected`, `reference` and `against = \"finest\"`");
    }
    if (is_error_measure(quantity.quantity.measure) && quantity.against_finest) {
        section.error("measure", "is already a difference; give `expected` or `reference`");
    }
    if (quantity.quantity.measure == Measure::share_within) {
        section.error("measure", "is not a quantity with an error");
    }
}

StudyQuantity read_study_quantity(Section& section)
{
    StudyQuantity quantity;
    section.require("name");
    quantity.name = section.label("name");
    quantity.unit = section.label("unit");
    if (section.has("name") && quantity.name.empty()) {
        section.error("name", "is empty");
    }
    quantity.quantity = read_quantity(section);
    read_expected(section, quantity);
    quantity.scale = section.expression("scale");
    section.finish();
    return quantity;
}

template <class T, class Name>
void refuse_doubles(Section& root, std::string_view key, const std::vector<T>& all, Name name)
{
    std::set<std::string> seen;
    for (const T& one : all) {
        if (!seen.insert(name(one)).second) {
            root.error(key, fmt::format("\"{}\" is defined twice", name(one)));
        }
    }
    if (all.empty()) {
        root.error(key, fmt::format("is missing: a study needs at least one [[{}]]", key));
    }
}

Study read_root(Section& root, const fs::path& folder)
{
    Study study;
    for (const char* key : {"title", "case"}) {
        root.require(key);
    }
    study.title = root.label("title");
    study.case_file = (folder / root.text("case")).lexically_normal();
    study.mode = static_cast<Study::Mode>(root.choice("mode", modes).value_or(0));
    study.set = root.texts("set");
    study.repeats = static_cast<int>(root.integer("repeats", 1));
    study.cost = root.expression("cost");
    study.definitions = read_definitions(root);
    for (Section& section : root.tables("sweep")) {
        study.sweeps.push_back(read_sweep(section));
    }
    for (Section& section : root.tables("quantity")) {
        study.quantities.push_back(read_study_quantity(section));
    }
    if (study.repeats < 1 || study.repeats > 1000) {
        root.error("repeats", "expected 1 to 1000");
    }
    refuse_doubles(root, "sweep", study.sweeps, [](const StudySweep& s) { return s.name; });
    refuse_doubles(root, "quantity", study.quantities,
                   [](const StudyQuantity& q) { return q.name; });
    root.finish();
    return study;
}

// A text as TOML, so that no value is taken for something else.
std::string toml_of(const RunParameter& value)
{
    const auto* text = std::get_if<std::string>(&value);
    return text != nullptr ? fmt::format("\"{}\"", *text) : text_of(value);
}

std::string as_file_name(std::string name)
{
    std::ranges::replace_if(
        name,
        [](unsigned char c) {
            return std::isalnum(c) == 0 && c != '.' && c != '=' && c != '-' && c != '_' && c != ',';
        },
        '_');
    return name;
}

// The overrides of one sweep in a run whose parameters are complete.
void apply(const StudySweep& sweep, std::size_t value, const Scope& scope, StudyRun& run)
{
    const RunParameter& taken = sweep.values[value];
    if (sweep.key == threads_key) {
        run.threads = static_cast<int>(std::get<double>(taken));
    } else if (!sweep.key.empty()) {
        run.run.set.push_back(sweep.key + "=" + toml_of(taken));
    }
    for (const std::string& text : sweep.set) {
        run.run.set.push_back(expanded(text, run.run, scope));
    }
    if (!sweep.choices.empty()) {
        for (const std::string& text : sweep.choices[value]) {
            run.run.set.push_back(expanded(text, run.run, scope));
        }
    }
}

StudyRun run_with(const Study& study, const std::vector<int>& value_of)
{
    StudyRun run{.run = {.name = "", .set = {}}, .value_of = value_of};
    for (std::size_t k = 0; k < study.sweeps.size(); ++k) {
        if (value_of[k] >= 0) {
            const StudySweep& sweep = study.sweeps[k];
            const RunParameter& value = sweep.values[static_cast<std::size_t>(value_of[k])];
            run.run.name += (run.run.name.empty() ? "" : ",") + sweep.name + "=" + text_of(value);
            run.run.parameters.emplace_back(sweep.name, value);
        }
    }
    run.run.name = as_file_name(run.run.name);
    const Scope scope = scope_of(study.definitions, run.run);
    for (const std::string& text : study.set) {
        run.run.set.push_back(expanded(text, run.run, scope));
    }
    for (std::size_t k = 0; k < study.sweeps.size(); ++k) {
        if (value_of[k] >= 0) {
            apply(study.sweeps[k], static_cast<std::size_t>(value_of[k]), scope, run);
        }
    }
    return run;
}

// How many processes the study would start. Counted before they are listed.
double count_runs(const Study& study)
{
    const bool grid = study.mode == Study::Mode::grid;
    double count = grid ? 1 : 0;
    for (const StudySweep& sweep : study.sweeps) {
        const auto values = static_cast<double>(sweep.values.size());
        count = grid ? count * values : count + values;
    }
    return count * study.repeats;
}

void check_count(Section& root, const Study& study)
{
    const double count = count_runs(study);
    if (count > most_runs_of_study) {
        root.error(
            "sweep",
            fmt::format("defines {:.10g} runs, at most {} are allowed", count, most_runs_of_study),
            "use fewer values or repeats, or mode = \"one_at_a_time\"");
    }
}

// Overrides that cannot be evaluated, and values whose runs would share a folder.
void check_runs(Section& root, const Study& study)
{
    try {
        std::set<std::string> names;
        for (const StudyRun& run : runs_of(study)) {
            if (!names.insert(run.run.name).second) {
                root.error("sweep", fmt::format("the run \"{}\" is defined twice", run.run.name),
                           "give every value once");
            }
        }
    } catch (const FormulaError& fault) {
        root.error("sweep", fault.what());
    }
}

// The fault of the divisor of the errors in a run, if that is known before the run; else empty.
std::string fault_of_scale(const StudyQuantity& q, const Scope& scope)
{
    const bool given = !q.scale.empty();
    const std::string& text = given ? q.scale : q.expected.formula;
    if (text.empty() || (!given && is_error_measure(q.quantity.measure))) {
        return {};
    }
    try {
        const double number = evaluate(text, scope);
        return number > 0 || (!given && number < 0) || std::isnan(number)
                   ? ""
                   : fmt::format("is {:.6g}", number);
    } catch (const FormulaError&) {
        return {}; // it needs names that only results have
    }
}

// Quantities whose errors have no scale, of which no run would give an error.
void check_scales(Section& root, const Study& study)
{
    std::vector<Section> sections = root.tables("quantity");
    const std::vector<StudyRun> runs = runs_of(study);
    for (std::size_t k = 0; k < study.quantities.size(); ++k) {
        const StudyQuantity& q = study.quantities[k];
        const char* key = q.scale.empty() ? "expected" : "scale";
        for (const StudyRun& run : runs) {
            const std::string fault = fault_of_scale(q, scope_of(study.definitions, run.run));
            if (!fault.empty()) {
                sections[k].error(
                    key,
                    fmt::format("{} in the run \"{}\", by which its error would be divided", fault,
                                run.run.name),
                    "give `scale`, a number > 0 by which the errors are divided instead");
                break;
            }
        }
    }
}

} // namespace

std::string text_of(const RunParameter& value)
{
    const auto* number = std::get_if<double>(&value);
    return number != nullptr ? fmt::format("{}", *number) : std::get<std::string>(value);
}

bool StudySweep::numeric() const
{
    return std::ranges::all_of(
        values, [](const RunParameter& v) { return std::holds_alternative<double>(v); });
}

Study read_study(const fs::path& file)
{
    OpenedFile opened = open_toml(file);
    Section root(opened.file, opened.document, "");
    Study study = read_root(root, file.parent_path());
    const std::string why = why_unreadable(study.case_file, largest_text);
    if (root.has("case") && !why.empty()) {
        root.error("case", fmt::format("the file `{}` {}", study.case_file.string(), why),
                   "the path is relative to the study");
    }
    if (opened.file.mistakes.empty()) {
        check_count(root, study);
    }
    if (opened.file.mistakes.empty()) {
        check_runs(root, study);
    }
    if (opened.file.mistakes.empty()) {
        check_scales(root, study);
    }
    opened.file.expect_no_mistakes();
    study.file = file;
    return study;
}

std::vector<StudyRun> runs_of(const Study& study)
{
    std::vector<std::vector<int>> all;
    std::vector<int> counts;
    for (std::size_t k = 0; k < study.sweeps.size(); ++k) {
        counts.push_back(static_cast<int>(study.sweeps[k].values.size()));
        for (int value = 0; study.mode == Study::Mode::one_at_a_time && value < counts[k];
             ++value) {
            all.emplace_back(study.sweeps.size(), -1)[k] = value;
        }
    }
    if (study.mode == Study::Mode::grid) {
        all = grid_of(counts);
    }
    std::vector<StudyRun> runs;
    for (const std::vector<int>& values : all) {
        runs.push_back(run_with(study, values));
    }
    return runs;
}

double number_in(const Study& study, const StudyRun& run, std::size_t sweep)
{
    const auto index = static_cast<std::size_t>(run.value_of[sweep]);
    return std::get<double>(study.sweeps[sweep].values[index]);
}

std::vector<std::vector<std::size_t>>
series_of(const Study& study, const std::vector<StudyRun>& runs, std::size_t sweep)
{
    std::map<std::vector<int>, std::vector<std::size_t>> by_others;
    for (std::size_t k = 0; k < runs.size(); ++k) {
        if (runs[k].value_of[sweep] >= 0) {
            std::vector<int> others = runs[k].value_of;
            others[sweep] = -1;
            by_others[others].push_back(k);
        }
    }
    const StudySweep& s = study.sweeps[sweep];
    const auto value = [&](std::size_t k) {
        const double number = number_in(study, runs[k], sweep);
        return s.finest == StudySweep::Finest::smallest ? -number : number;
    };
    std::vector<std::vector<std::size_t>> all;
    for (auto& [others, list] : by_others) {
        if (s.numeric()) {
            std::ranges::sort(list, {}, value);
        }
        all.push_back(list);
    }
    return all;
}

} // namespace hyoryu
