// SPDX-License-Identifier: MIT
#include "report.hpp"

#include <fmt/format.h>

#include <cmath>

namespace hyoryu::bench {

namespace {

using Json = nlohmann::ordered_json;

Json versions()
{
    Json list{{"hyoryu", HYORYU_VERSION}};
#ifdef HYORYU_BENCH_BULLET
    list["bullet"] = HYORYU_BENCH_BULLET;
#endif
#ifdef HYORYU_BENCH_ODE
    list["ode"] = HYORYU_BENCH_ODE;
#endif
#ifdef HYORYU_BENCH_MUJOCO
    list["mujoco"] = HYORYU_BENCH_MUJOCO;
#endif
    return list;
}

Json number(double value)
{
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json metric_json(const Metric& metric, double value)
{
    return {{"name", metric.name},
            {"unit", metric.unit},
            {"exact", metric.exact},
            {"value", number(value)},
            {"error", number(value - metric.exact)}};
}

Json result_json(const Scene& scene, const Result& result)
{
    Json metrics = Json::array();
    for (std::size_t k = 0; k < scene.metrics.size(); ++k) {
        metrics.push_back(metric_json(scene.metrics[k], result.metrics[k]));
    }
    constexpr double us = 1e6; // microseconds in a second
    return {{"engine", result.engine},
            {"dt_s", result.dt},
            {"steps", result.steps},
            {"stopped_by_budget", result.stopped},
            {"repeats", result.repeats},
            {"us_per_step", us * result.cost},
            {"us_per_step_early", us * result.early_cost},
            {"us_per_step_late", us * result.late_cost},
            {"contacts", result.contacts},
            {"metrics", metrics}};
}

} // namespace

Json to_json(const std::vector<Row>& rows, const std::vector<Engine>& engines, const Plan& plan)
{
    Json list = Json::array();
    for (const Engine& engine : engines) {
        list.push_back({{"name", engine.name}, {"settings", engine.settings}});
    }
    Json scenes = Json::array();
    for (const Row& row : rows) {
        Json results = Json::array();
        for (const Result& result : row.results) {
            results.push_back(result_json(row.scene, result));
        }
        scenes.push_back({{"name", row.scene.name},
                          {"what", row.scene.what},
                          {"kind", row.scene.kind == Scene::Kind::heap ? "heap" : "exact"},
                          {"bodies", row.scene.solids.size()},
                          {"duration_s", row.scene.duration},
                          {"results", results}});
    }
    return {{"benchmark", "contact"},
            {"extent", plan.extent == Extent::full ? "full" : "quick"},
            {"compiler", HYORYU_COMPILER},
            {"build_type", HYORYU_BUILD_TYPE},
            {"versions", versions()},
            {"engines", list},
            {"scenes", scenes}};
}

std::string table(const Row& row)
{
    std::string text = fmt::format("{}: {}\n{:<16} {:>7} {:>10} {:>8}", row.scene.name,
                                   row.scene.what, "engine", "dt [ms]", "us/step", "contacts");
    for (const Metric& metric : row.scene.metrics) {
        text += fmt::format("  {:>14}", metric.name.substr(0, 10) + " " + metric.unit);
    }
    text += '\n';
    for (const Result& result : row.results) {
        text += fmt::format("{:<16} {:>7g} {:>10.2f} {:>8}", result.engine, 1e3 * result.dt,
                            1e6 * result.cost, result.contacts);
        for (std::size_t k = 0; k < row.scene.metrics.size(); ++k) {
            text += fmt::format("  {:>14.3g}", result.metrics[k] - row.scene.metrics[k].exact);
        }
        text += result.stopped ? "  stopped by the budget\n" : "\n";
    }
    return text;
}

} // namespace hyoryu::bench
