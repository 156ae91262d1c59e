// SPDX-License-Identifier: MIT
// Any bytes are a table of numbers that a case names, of so many columns, or a list of mistakes,
// and so they are as the rows of a history.
#include "../../src/scene/case/number_table.hpp"
#include "hyoryu/core/error.hpp"
#include "hyoryu/io/csv_table.hpp"
#include "scratch.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace hyoryu;
    static const test_help::Scratch scratch;
    const auto file = scratch.put("table.csv", data, size);
    constexpr std::array<NumberColumn, 4> all{{{"time", "s"}, {"x", "m"}, {"y", "m"}, {"z", "m"}}};
    using Columns = std::span<const NumberColumn>;
    for (const Columns columns : {Columns(all), Columns(all).last(3)}) {
        const NumberTable table = read_number_table(file, columns);
        const bool whole = std::all_of(table.rows.begin(), table.rows.end(), [&](const auto& row) {
            return row.size() == columns.size();
        });
        if (table.lines.size() != table.rows.size() || (table.faults.empty() && !whole)) {
            std::abort();
        }
    }
    try {
        read_csv(file);
    } catch (const IoError&) {
        return 0;
    }
    return 0;
}
