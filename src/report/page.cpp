// SPDX-License-Identifier: MIT
#include "hyoryu/report/report.hpp"

#include "hyoryu/core/error.hpp"
#include "hyoryu/report/html.hpp"
#include "hyoryu/report/svg.hpp"
#include "sections.hpp"

#include <fmt/format.h>

namespace hyoryu {

namespace {

constexpr std::string_view style = R"(
body { font: 15px/1.45 system-ui, sans-serif; color: #1a1a1a; max-width: 900px; margin: 2em auto;
       padding: 0 1em; }
h1 { font-size: 1.6em; } h2 { font-size: 1.25em; border-bottom: 1px solid #bbb; margin-top: 2em; }
h3 { font-size: 1.05em; margin-bottom: 0.3em; }
table { border-collapse: collapse; font-size: 0.92em; margin: 0.5em 0; }
th, td { border: 1px solid #ccc; padding: 0.2em 0.6em; text-align: left; vertical-align: top; }
th { background: #f0f0f0; } .n { text-align: right; font-variant-numeric: tabular-nums; }
pre { font-size: 0.85em; background: #f6f6f6; padding: 0.8em; overflow-x: auto; }
.grid { display: flex; flex-wrap: wrap; gap: 8px; }
svg { max-width: 100%; height: auto; }
@media print { svg, tr { break-inside: avoid; } h2, h3 { break-after: avoid; } }
)";

std::string page_of(const RunResults& run, const ReportSettings& settings)
{
    const std::string title = escaped(run.plan.at("title").get<std::string>());
    return fmt::format("<!DOCTYPE html>\n<html xmlns=\"http://www.w3.org/1999/xhtml\" "
                       "lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
                       "<meta name=\"generator\" content=\"hyoryu report\"/>\n"
                       "<title>{0}</title>\n<style>{1}{2}</style>\n</head>\n<body>\n<h1>{0}</h1>\n",
                       title, style, chart_style) +
           case_section(run) + run_section(run) + picture_section(run) +
           impact_section(run, settings.stiffness) + trajectory_section(run) + gauge_section(run) +
           conservation_section(run) + plan_section(run) + cost_section(run) +
           process_section(run) + "</body>\n</html>\n";
}

} // namespace

std::string report_page(const std::filesystem::path& results, const ReportSettings& settings)
{
    try {
        return page_of(read_results(results), settings);
    } catch (const nlohmann::json::exception& error) {
        throw IoError(fmt::format("plan.json or summary.json in `{}` is damaged: {}",
                                  results.string(), error.what()));
    }
}

} // namespace hyoryu
