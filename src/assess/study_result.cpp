// SPDX-License-Identifier: MIT
#include "hyoryu/assess/study_result.hpp"

#include "hyoryu/core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace hyoryu {

namespace {

void set_error(const StudyQuantity& q, const Scope& scope, StudyValue& v)
{
    double scale = std::abs(v.expected);
    if (!q.scale.empty()) {
        scale = evaluate(q.scale, scope);
    } else if (is_error_measure(q.quantity.measure)) {
        scale = 1;
    }
    if (!(scale > 0)) {
        v.why = "the scale of the error is not positive: give `scale`";
        v.error = not_a_number;
        return;
    }
    v.error = std::abs(v.value - v.expected) / scale;
}

StudyValue value_in(const StudyQuantity& q, const std::string& error, MadeRun& made)
{
    StudyValue v{.value = not_a_number,
                 .expected = not_a_number,
                 .error = not_a_number,
                 .finest = {},
                 .why = error};
    if (!error.empty()) {
        return v;
    }
    const Compared found = compare(q.quantity, q.expected, made);
    v.value = found.got;
    v.expected = found.expected;
    v.why = found.why;
    if (v.why.empty() && !std::isfinite(q.against_finest ? v.value : v.value + v.expected)) {
        v.why = "the value or the expected value is not a finite number";
    }
    if (!q.against_finest && std::isfinite(v.value)) {
        set_error(q, made.scope, v);
    }
    return v;
}

// The columns of a run are known only when it is done: a name that is not among them is told now.
StudyValue value_in(const Study& study, std::size_t quantity, const std::string& error,
                    MadeRun& made)
{
    try {
        return value_in(study.quantities[quantity], error, made);
    } catch (const FormulaError& fault) {
        throw CaseError({Diagnostic{
            .file = study.file.string(),
            .key = fmt::format("quantity[{}]", quantity),
            .what = fmt::format("\"{}\" of the run {}: {}", study.quantities[quantity].name,
                                made.run.name, fault.what()),
            .hint =
                "the finished runs are kept: correct the expression and start the study again"}});
    }
}

double work_of(const std::string& expression, MadeRun& made)
{
    return evaluate(expression, made.scope, made.files.table("summary")).front();
}

std::size_t finest_value(const StudySweep& sweep)
{
    const auto [least, most] = std::ranges::minmax_element(sweep.values);
    const auto at = sweep.finest == StudySweep::Finest::smallest ? least : most;
    return static_cast<std::size_t>(at - sweep.values.begin());
}

// The run that is the finest in every number that is swept and has the texts of run k.
std::size_t finest_like(const StudyResult& result, std::size_t k)
{
    std::vector<int> wanted = result.runs[k].run.value_of;
    for (std::size_t s = 0; s < wanted.size(); ++s) {
        if (wanted[s] >= 0 && result.study.sweeps[s].ordered()) {
            wanted[s] = static_cast<int>(finest_value(result.study.sweeps[s]));
        }
    }
    const auto found = std::ranges::find_if(
        result.runs, [&](const StudyRunResult& run) { return run.run.value_of == wanted; });
    return static_cast<std::size_t>(found - result.runs.begin());
}

// Whether the run is part of a refinement: another run has the same texts and other numbers.
bool has_finer_and_coarser(const StudyResult& result, std::size_t k)
{
    const auto& own = result.runs[k].run.value_of;
    return std::ranges::any_of(result.runs, [&](const StudyRunResult& other) {
        bool differs = false;
        for (std::size_t s = 0; s < own.size(); ++s) {
            const int value = other.run.value_of[s];
            if (value != own[s] && (value < 0 || own[s] < 0 || !result.study.sweeps[s].ordered())) {
                return false;
            }
            differs = differs || value != own[s];
        }
        return differs;
    });
}

// Without an exact value, the finest run is the reference of the others.
void hold_against_finest(StudyResult& result, std::size_t quantity)
{
    const StudyQuantity& q = result.study.quantities[quantity];
    for (std::size_t k = 0; k < result.runs.size(); ++k) {
        StudyRunResult& run = result.runs[k];
        StudyValue& v = run.values[quantity];
        const std::size_t finest = finest_like(result, k);
        v.finest = finest;
        if (finest == k) {
            const char* const alone = has_finer_and_coarser(result, k)
                                          ? "the finest run"
                                          : "no finer run to compare with";
            v.why = v.why.empty() ? alone : v.why;
            continue;
        }
        v.expected = result.runs[finest].values[quantity].value;
        if (std::isfinite(v.value) && std::isfinite(v.expected)) {
            set_error(q, scope_of(result.study.definitions, run.run.run), v);
        }
    }
}

double number_of(const StudyResult& result, std::size_t sweep, std::size_t run)
{
    const double number = number_in(result.study, result.runs[run].run, sweep);
    return result.study.sweeps[sweep].finest == StudySweep::Finest::smallest ? number : 1 / number;
}

std::string others_of(const Study& study, const StudyRun& run, std::size_t sweep)
{
    std::string text;
    for (std::size_t k = 0; k < study.sweeps.size(); ++k) {
        if (k != sweep && run.value_of[k] >= 0) {
            const auto& value = study.sweeps[k].values[static_cast<std::size_t>(run.value_of[k])];
            text += fmt::format("{}{}={}", text.empty() ? "" : ", ", study.sweeps[k].name,
                                text_of(value));
        }
    }
    return text;
}

std::optional<Richardson> extrapolation(const StudyResult& result, const StudySeries& series,
                                        const std::vector<double>& h)
{
    if (h.size() < 3) {
        return std::nullopt;
    }
    std::array<double, 3> spacing{};
    std::array<double, 3> values{};
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t at = h.size() - 1 - k;
        spacing[k] = h[at];
        values[k] = result.runs[series.runs[at]].values[series.quantity].value;
    }
    return extrapolate(spacing, values);
}

std::vector<double> orders_between(const std::vector<double>& h, const std::vector<double>& error)
{
    std::vector<double> orders;
    for (std::size_t k = 1; k < h.size(); ++k) {
        orders.push_back(std::log(error[k - 1] / error[k]) / std::log(h[k - 1] / h[k]));
    }
    return orders;
}

StudySeries analyse(const StudyResult& result, std::size_t sweep, std::size_t quantity,
                    const std::vector<std::size_t>& list)
{
    const Study& study = result.study;
    StudySeries series{.sweep = sweep,
                       .quantity = quantity,
                       .others = others_of(study, result.runs[list.front()].run, sweep),
                       .runs = list};
    if (!study.sweeps[sweep].ordered()) {
        return series;
    }
    std::vector<double> h;
    std::vector<double> error;
    std::vector<double> work;
    for (const std::size_t k : list) {
        h.push_back(number_of(result, sweep, k));
        error.push_back(result.runs[k].values[quantity].error);
        work.push_back(result.runs[k].work);
    }
    series.order = fit_power(h, error);
    series.rungs = orders_between(h, error);
    series.to_floor = fit_power_with_floor(h, error);
    series.by_work = fit_power(work, error);
    series.floor = fit_power_with_floor(work, error);
    if (study.quantities[quantity].against_finest) {
        series.extrapolation = extrapolation(result, series, h);
    }
    return series;
}

} // namespace

StudyResult evaluate_study(const Study& study, const std::vector<std::filesystem::path>& folders,
                           const std::vector<std::string>& errors,
                           const std::vector<std::vector<double>>& walls)
{
    const std::vector<StudyRun> runs = runs_of(study);
    StudyResult result{study, study.cost.empty() ? "steps" : study.cost, {}, {}};
    std::vector<MadeRun> made;
    for (std::size_t k = 0; k < runs.size(); ++k) {
        made.push_back({runs[k].run,
                        scope_of(study.definitions, runs[k].run),
                        {folders[k], study.file.parent_path()}});
        if (study.cost.empty() && errors[k].empty() && work_of("pair_interactions", made[k]) > 0) {
            result.work_unit = "pair_interactions";
        }
    }
    for (std::size_t k = 0; k < runs.size(); ++k) {
        StudyRunResult run{.run = runs[k], .error = errors[k], .cost = {}, .walls = walls[k]};
        run.work = not_a_number;
        if (run.error.empty()) {
            run.cost = read_cost(made[k].files);
            run.work = work_of(result.work_unit, made[k]);
        }
        for (std::size_t q = 0; q < study.quantities.size(); ++q) {
            run.values.push_back(value_in(study, q, run.error, made[k]));
        }
        result.runs.push_back(std::move(run));
    }
    for (std::size_t q = 0; q < study.quantities.size(); ++q) {
        if (study.quantities[q].against_finest) {
            hold_against_finest(result, q);
        }
    }
    for (std::size_t sweep = 0; sweep < study.sweeps.size(); ++sweep) {
        for (const auto& list : series_of(study, runs, sweep)) {
            for (std::size_t q = 0; q < study.quantities.size(); ++q) {
                result.series.push_back(analyse(result, sweep, q, list));
            }
        }
    }
    return result;
}

std::vector<std::size_t> frontier(const StudyResult& result, std::size_t quantity)
{
    std::vector<std::size_t> order;
    for (std::size_t k = 0; k < result.runs.size(); ++k) {
        const StudyValue& v = result.runs[k].values[quantity];
        if (std::isfinite(v.error) && v.finest == result.runs[0].values[quantity].finest) {
            order.push_back(k);
        }
    }
    const auto error = [&](std::size_t k) { return result.runs[k].values[quantity].error; };
    std::ranges::sort(order, {},
                      [&](std::size_t k) { return std::tuple(result.runs[k].work, error(k), k); });
    std::vector<std::size_t> best;
    for (const std::size_t k : order) {
        if (best.empty() || error(k) < error(best.back())) {
            best.push_back(k);
        }
    }
    return best;
}

std::optional<std::size_t> cheapest(const StudyResult& result, std::size_t quantity, double target)
{
    for (const std::size_t k : frontier(result, quantity)) {
        if (result.runs[k].values[quantity].error <= target) {
            return k;
        }
    }
    return std::nullopt;
}

} // namespace hyoryu
