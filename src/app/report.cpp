// SPDX-License-Identifier: MIT
// `hyoryu report`: one page about a run.
#include "commands.hpp"
#include "options.hpp"

#include "hyoryu/core/error.hpp"
#include "hyoryu/io/claim.hpp"
#include "hyoryu/io/results.hpp"
#include "hyoryu/report/report.hpp"

#include <fmt/format.h>

namespace hyoryu {

int write_report(const ReportOptions& options)
{
    if (options.stiffness && !(*options.stiffness > 0)) {
        throw CaseError(fmt::format("--stiffness: {} N/m is not positive", *options.stiffness));
    }
    const std::filesystem::path file =
        options.file.empty() ? options.folder / "report.html" : options.file;
    expect_own_file(
        file,
        {.command = "report", .start = "<!DOCTYPE html>", .within = "content=\"hyoryu report\""});
    const std::string page = report_page(options.folder, {.stiffness = options.stiffness});
    write_text(file, page);
    fmt::print("report: {}\n", file.string());
    return exit_code::done;
}

} // namespace hyoryu
