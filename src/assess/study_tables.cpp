// SPDX-License-Identifier: MIT
// The tables of a study, and its CSV and JSON.
#include "hyoryu/assess/study_page.hpp"
#include "hyoryu/io/results.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

using Align = TextTable::Align;
using nlohmann::ordered_json;

std::string number(double value)
{
    return std::isfinite(value) ? fmt::format("{:.4g}", value) : "-";
}

// Counts in full as long as they can be read.
std::string count_text(double count)
{
    return count < 1e6 && count == std::floor(count) ? fmt::format("{:.0f}", count) : number(count);
}

std::string percent(double share)
{
    return std::isfinite(share) ? fmt::format("{:.3g} %", 100 * share) : "-";
}

std::string value_text(const StudySweep& sweep, int index)
{
    return cell(sweep.values[static_cast<std::size_t>(index)]);
}

std::string spread(const std::vector<double>& walls)
{
    if (walls.empty()) {
        return "-";
    }
    const auto [least, most] = std::ranges::minmax_element(walls);
    return walls.size() == 1
               ? number(walls[0])
               : fmt::format("{} ({} to {})", number(median(walls)), number(*least), number(*most));
}

// A column for each sweep of a grid; one at a time they would be empty but for one.
bool has_column_a_sweep(const Study& study)
{
    return study.mode == Study::Mode::grid || study.sweeps.size() == 1;
}

std::vector<TextTable::Head> heads_of_settings(const Study& study)
{
    if (!has_column_a_sweep(study)) {
        return {{"setting", Align::left}, {"value", Align::right}};
    }
    std::vector<TextTable::Head> heads;
    for (const StudySweep& sweep : study.sweeps) {
        heads.push_back({sweep.label(), Align::right});
    }
    return heads;
}

std::vector<std::string> settings_of(const Study& study, const StudyRun& run)
{
    std::vector<std::string> cells;
    for (std::size_t s = 0; s < study.sweeps.size(); ++s) {
        if (has_column_a_sweep(study)) {
            cells.push_back(value_text(study.sweeps[s], run.value_of[s]));
        } else if (run.value_of[s] >= 0) {
            cells = {study.sweeps[s].label(), value_text(study.sweeps[s], run.value_of[s])};
        }
    }
    return cells;
}

StudyTable table_of_runs(const StudyResult& result, std::size_t quantity)
{
    const StudyQuantity& q = result.study.quantities[quantity];
    StudyTable out{q.unit.empty() ? q.name : fmt::format("{} [{}]", q.name, q.unit), {}};
    out.table.heads = heads_of_settings(result.study);
    for (const char* head : {"measured", "expected", "error"}) {
        out.table.heads.push_back({head, Align::right});
    }
    out.table.heads.push_back({result.work_unit, Align::right});
    out.table.heads.push_back({"wall time [s]", Align::right});
    out.table.heads.push_back({"", Align::left});
    const std::vector<std::size_t> best = frontier(result, quantity);
    for (std::size_t k = 0; k < result.runs.size(); ++k) {
        const StudyRunResult& run = result.runs[k];
        const StudyValue& v = run.values[quantity];
        std::vector<std::string> row = settings_of(result.study, run.run);
        const bool on_frontier = std::ranges::find(best, k) != best.end();
        row.insert(row.end(), {number(v.value), number(v.expected), percent(v.error),
                               count_text(run.work), spread(run.walls),
                               !v.why.empty() ? v.why
                               : on_frontier  ? "on the staircase"
                                              : ""});
        out.table.rows.push_back(std::move(row));
    }
    return out;
}

std::string interval(const std::optional<Power>& power, double sign)
{
    if (!power) {
        return "-";
    }
    if (!std::isfinite(power->low)) {
        return number(sign * power->exponent);
    }
    const double a = sign * power->low;
    const double b = sign * power->high;
    return fmt::format("{} ({} to {})", number(sign * power->exponent), number(std::min(a, b)),
                       number(std::max(a, b)));
}

constexpr const char* no_fall = "does not fall";

// The fit of the error over the cost. The error falls if the exponent is negative.
std::string floor_text(const std::optional<PowerWithFloor>& fit)
{
    if (!fit) {
        return "-";
    }
    return fit->exponent < 0 ? fmt::format("{} cost^-{} + {}", number(fit->factor),
                                           number(-fit->exponent), percent(fit->floor))
                             : no_fall;
}

// The fit of the error over the swept number. The error falls towards the finest number if the
// exponent is positive.
std::string order_and_floor(const std::optional<PowerWithFloor>& fit)
{
    if (!fit) {
        return "-";
    }
    return fit->exponent > 0 ? fmt::format("{:.3g} to {}", fit->exponent, percent(fit->floor))
                             : no_fall;
}

std::string rungs_text(const std::vector<double>& orders)
{
    std::string text;
    for (const double order : orders) {
        text += text.empty() ? "" : ", ";
        text += std::isfinite(order) ? fmt::format("{:.2f}", order) : "-";
    }
    return text.empty() ? "-" : text;
}

StudyTable table_of_orders(const StudyResult& result)
{
    StudyTable out{"Orders", {}};
    for (const char* head : {"quantity", "swept", "the others"}) {
        out.table.heads.push_back({head, Align::left});
    }
    for (const char* head :
         {"order (95 %)", "from rung to rung", "order and floor", "m of cost^-m (95 %)",
          "error = C cost^-m + floor", "extrapolated", "GCI of the finest"}) {
        out.table.heads.push_back({head, Align::right});
    }
    for (const StudySeries& s : result.series) {
        constexpr std::size_t fewest = 3; // two runs have a slope, but no order
        if (!result.study.sweeps[s.sweep].ordered() || s.runs.size() < fewest) {
            continue;
        }
        out.table.rows.push_back(
            {result.study.quantities[s.quantity].name, result.study.sweeps[s.sweep].label(),
             s.others.empty() ? "-" : s.others, interval(s.order, 1), rungs_text(s.rungs),
             order_and_floor(s.to_floor), interval(s.by_work, -1), floor_text(s.floor),
             s.extrapolation ? number(s.extrapolation->limit) : "-",
             s.extrapolation ? percent(s.extrapolation->gci) : "-"});
    }
    return out;
}

StudyTable table_of_cheapest(const StudyResult& result)
{
    StudyTable out{"Cheapest setting", {}};
    out.table.heads = {{"quantity", Align::left}};
    for (const double target : study_targets) {
        out.table.heads.push_back({fmt::format("error at most {}", percent(target)), Align::left});
    }
    for (std::size_t q = 0; q < result.study.quantities.size(); ++q) {
        std::vector<std::string> row{result.study.quantities[q].name};
        for (const double target : study_targets) {
            const auto k = cheapest(result, q, target);
            row.push_back(k ? fmt::format("{}: {} {}, {} s", result.runs[*k].run.run.name,
                                          count_text(result.runs[*k].work), result.work_unit,
                                          number(median(result.runs[*k].walls)))
                            : "none of these");
        }
        out.table.rows.push_back(std::move(row));
    }
    return out;
}

ordered_json json_of(const Power& power)
{
    return {{"exponent", power.exponent},
            {"low", power.low},
            {"high", power.high},
            {"points", power.points}};
}

ordered_json json_of(const PowerWithFloor& fit)
{
    return {{"factor", fit.factor},
            {"exponent", fit.exponent},
            {"floor", fit.floor},
            {"misfit", fit.misfit}};
}

ordered_json json_of(const StudyResult& result, const StudyRunResult& run)
{
    ordered_json json{{"name", run.run.run.name},
                      {"set", run.run.run.set},
                      {"error", run.error},
                      {"work", run.work},
                      {"wall_seconds", run.walls},
                      {"steps", run.cost.steps},
                      {"values", ordered_json::array()}};
    for (std::size_t q = 0; q < run.values.size(); ++q) {
        const StudyValue& v = run.values[q];
        json["values"].push_back({{"quantity", result.study.quantities[q].name},
                                  {"value", v.value},
                                  {"expected", v.expected},
                                  {"error", v.error},
                                  {"note", v.why}});
    }
    return json;
}

ordered_json json_of(const StudyResult& result, const StudySeries& s)
{
    ordered_json json{{"quantity", result.study.quantities[s.quantity].name},
                      {"sweep", result.study.sweeps[s.sweep].label()},
                      {"others", s.others}};
    for (const std::size_t k : s.runs) {
        json["runs"].push_back(result.runs[k].run.run.name);
    }
    json["order"] = s.order ? json_of(*s.order) : ordered_json();
    json["orders_between_rungs"] = s.rungs;
    json["order_and_floor"] = s.to_floor ? json_of(*s.to_floor) : ordered_json();
    json["error_by_work"] = s.by_work ? json_of(*s.by_work) : ordered_json();
    json["error_by_work_and_floor"] = s.floor ? json_of(*s.floor) : ordered_json();
    if (s.extrapolation) {
        json["extrapolation"] = {{"order", s.extrapolation->order},
                                 {"limit", s.extrapolation->limit},
                                 {"gci", s.extrapolation->gci}};
    }
    return json;
}

} // namespace

std::vector<StudyTable> study_tables(const StudyResult& result)
{
    std::vector<StudyTable> tables{table_of_cheapest(result), table_of_orders(result)};
    for (std::size_t q = 0; q < result.study.quantities.size(); ++q) {
        tables.push_back(table_of_runs(result, q));
    }
    return tables;
}

std::string study_csv(const StudyResult& result)
{
    std::string text = fmt::format(
        "# error: relative to its scale; work: {}; wall_seconds: median, within the steps\nrun",
        result.work_unit);
    for (const StudySweep& sweep : result.study.sweeps) {
        text += fmt::format(",{}", cell(std::string_view(sweep.name)));
    }
    text += ",quantity,value,expected,error,work,wall_seconds,wall_least,wall_most,steps,note\n";
    for (const StudyRunResult& run : result.runs) {
        const bool timed = !run.walls.empty();
        for (std::size_t q = 0; q < run.values.size(); ++q) {
            const StudyValue& v = run.values[q];
            text += cell(std::string_view(run.run.run.name));
            for (std::size_t s = 0; s < result.study.sweeps.size(); ++s) {
                const int index = run.run.value_of[s];
                text += ',';
                text += index < 0 ? "" : value_text(result.study.sweeps[s], index);
            }
            const double most = timed ? *std::ranges::max_element(run.walls) : NAN;
            const double least = timed ? *std::ranges::min_element(run.walls) : NAN;
            text += fmt::format(",{},{},{},{},{},{},{},{},{},{}\n",
                                cell(std::string_view(result.study.quantities[q].name)),
                                cell(v.value), cell(v.expected), cell(v.error), cell(run.work),
                                cell(median(run.walls)), cell(least), cell(most),
                                cell(run.cost.steps), cell(std::string_view(v.why)));
        }
    }
    return text;
}

std::string study_json(const StudyResult& result, const StudyInfo& info)
{
    ordered_json json{{"title", result.study.title}, {"case", result.study.case_file.string()},
                      {"version", info.version},     {"commit", info.commit},
                      {"build", info.build},         {"threads", info.threads},
                      {"jobs", info.jobs},           {"work_unit", result.work_unit}};
    for (const StudyRunResult& run : result.runs) {
        json["runs"].push_back(json_of(result, run));
    }
    for (const StudySeries& s : result.series) {
        json["series"].push_back(json_of(result, s));
    }
    for (std::size_t q = 0; q < result.study.quantities.size(); ++q) {
        ordered_json best{{"quantity", result.study.quantities[q].name},
                          {"frontier", ordered_json::array()},
                          {"cheapest", ordered_json::array()}};
        for (const std::size_t k : frontier(result, q)) {
            best["frontier"].push_back(result.runs[k].run.run.name);
        }
        for (const double target : study_targets) {
            const auto k = cheapest(result, q, target);
            best["cheapest"].push_back(
                {{"error", target},
                 {"run", k ? ordered_json(result.runs[*k].run.run.name) : ordered_json()}});
        }
        json["best"].push_back(best);
    }
    return json.dump(2) + "\n";
}

} // namespace hyoryu
