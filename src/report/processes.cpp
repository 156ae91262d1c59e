// SPDX-License-Identifier: MIT
// The section on processes: particles, work and waiting time of each, and the balance of the load.
#include "hyoryu/report/html.hpp"
#include "hyoryu/report/svg.hpp"
#include "hyoryu/report/table.hpp"
#include "sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace hyoryu {

namespace {

using Values = std::vector<double>;

// A quantity of each process, frame by frame, as least, mean and largest.
struct Spread {
    Values least, mean, most;

    void add(std::span<const double> of_ranks)
    {
        least.push_back(*std::ranges::min_element(of_ranks));
        most.push_back(*std::ranges::max_element(of_ranks));
        mean.push_back(std::accumulate(of_ranks.begin(), of_ranks.end(), 0.0) /
                       static_cast<double>(of_ranks.size()));
    }
};

// The share of the time since the row of the same process at the frame before that it waited.
double waited_share(const CsvTable& ranks, std::size_t row, std::size_t count)
{
    const auto since = [&](const char* column) {
        const Values& values = numbers_of(ranks, column);
        return values[row] - (row >= count ? values[row - count] : 0);
    };
    const double busy = since("busy");
    const double waited = since("waited");
    return busy + waited > 0 ? waited / (busy + waited) : 0;
}

Chart chart_of(std::string title, std::string axis, const Values& time, const Spread& of)
{
    return {
        .title = std::move(title),
        .x_axis = "time [s]",
        .y_axis = std::move(axis),
        .lines = {{"largest", time, of.most}, {"mean", time, of.mean}, {"least", time, of.least}}};
}

std::string charts(const CsvTable& ranks, std::size_t count)
{
    Values time;
    Spread particles;
    Spread waited;
    for (std::size_t row = 0; row + count <= ranks.rows; row += count) {
        time.push_back(numbers_of(ranks, "time")[row]);
        particles.add(std::span(numbers_of(ranks, "particles")).subspan(row, count));
        Values shares;
        for (std::size_t r = 0; r < count; ++r) {
            shares.push_back(waited_share(ranks, row + r, count));
        }
        waited.add(shares);
    }
    return "<div class=\"grid\">\n" +
           svg_chart(chart_of("fluid particles of a process", "particles", time, particles)) +
           svg_chart(chart_of("time spent waiting between frames", "share", time, waited)) +
           "</div>\n";
}

// The last rows, one a process; if there are many processes, of those that worked longest.
std::string table_of(const CsvTable& ranks, std::size_t count)
{
    constexpr std::size_t most_rows = 64;
    using Align = TextTable::Align;
    TextTable table{.heads = {{"process"},
                              {"machine"},
                              {"fluid particles", Align::right},
                              {"copies", Align::right},
                              {"worked [s]", Align::right},
                              {"waited [s]", Align::right},
                              {"messages", Align::right},
                              {"sent [MB]", Align::right},
                              {"memory [MB]", Align::right}},
                    .rows = {}};
    const Values& busy = numbers_of(ranks, "busy");
    std::vector<std::size_t> rows(count);
    std::iota(rows.begin(), rows.end(), ranks.rows - count);
    if (count > most_rows) {
        std::ranges::stable_sort(rows, std::greater<>(),
                                 [&](std::size_t row) { return busy[row]; });
        rows.resize(most_rows);
    }
    const std::vector<std::string> host = texts_of(ranks, "host");
    for (const std::size_t row : rows) {
        const auto of = [&](const char* column) { return numbers_of(ranks, column)[row]; };
        table.rows.push_back({fmt::format("{:.0f}", of("rank")), host[row],
                              fmt::format("{:.0f}", of("particles")),
                              fmt::format("{:.0f}", of("ghosts")), readable(of("busy")),
                              readable(of("waited")), fmt::format("{:.0f}", of("messages")),
                              readable(1e-6 * of("sent")), readable(1e-6 * of("memory"))});
    }
    return html_table(table) +
           (count > most_rows
                ? html_paragraph(
                      fmt::format("The {} of {} processes that worked longest.", most_rows, count))
                : std::string());
}

// The explanation of a large share of waiting.
std::string waiting_text(const nlohmann::ordered_json& shared)
{
    constexpr double noteworthy = 0.5;
    return number(shared.at("waited_share")) > noteworthy
               ? " Such a large share means that processes share cores, or that the case is too "
                 "small for them."
               : "";
}

} // namespace

std::string process_section(const RunResults& run)
{
    if (!run.ranks) {
        return {};
    }
    const auto& shared = run.summary.at("ranks");
    const auto count = shared.at("count").get<std::size_t>();
    std::string text =
        "<h2>Processes</h2>\n" +
        html_paragraph(fmt::format(
            "{} processes shared the run. Over the whole run the busiest process worked {} times "
            "as "
            "long as the mean. {:.1f} % of the time was spent sending and waiting.{} The domain "
            "was repartitioned {} times.",
            count, readable(number(shared.at("imbalance"))),
            100 * number(shared.at("waited_share")), waiting_text(shared),
            shared.at("rebalances").get<long long>()));
    if (count == 0 || run.ranks->rows < count) {
        return text + html_paragraph("ranks.csv contains no frame of all processes.");
    }
    return text + charts(*run.ranks, count) + html_paragraph("Until the last frame:") +
           table_of(*run.ranks, count);
}

} // namespace hyoryu
