// SPDX-License-Identifier: MIT
// A study as Markdown and as one page of HTML.
#include "hyoryu/assess/study_page.hpp"

#include "hyoryu/report/html.hpp"

#include <fmt/format.h>

#include <filesystem>

namespace hyoryu {

namespace {

constexpr std::string_view style =
    "body{font:15px/1.5 sans-serif;max-width:68em;margin:2em auto;padding:0 1em;color:#1a1a1a}"
    "table{border-collapse:collapse;margin:1em 0;font-size:14px}"
    "th,td{border:1px solid #ccc;padding:.25em .6em;text-align:left}"
    "th{background:#f2f2f2}.n{text-align:right}svg{max-width:100%;height:auto}";

// A file `case.toml` is known by its folder, also where it is named from within.
std::string name_of_case(const std::filesystem::path& file)
{
    return file.filename() == "case.toml" ? std::filesystem::absolute(file)
                                                .lexically_normal()
                                                .parent_path()
                                                .filename()
                                                .string()
                                          : file.filename().string();
}

std::string how_measured(const StudyResult& result, const StudyInfo& info)
{
    return fmt::format(
        "Case {}. Errors are relative. Cost: {}, the same on every machine of one instruction set; "
        "wall time: median of {} repeat(s) within the steps, rounds of all runs in turn, {} "
        "thread(s), {} run(s) side by "
        "side. Hyoryu {} ({}), {}.",
        name_of_case(result.study.case_file), result.work_unit, result.study.repeats, info.threads,
        info.jobs, info.version, info.commit, info.build);
}

} // namespace

std::string study_markdown(const StudyResult& result, const StudyInfo& info,
                           const std::vector<SvgFile>& pictures)
{
    std::string text =
        fmt::format("# {}\n\n{}\n\n", result.study.title, how_measured(result, info));
    for (const SvgFile& picture : pictures) {
        text += fmt::format("![{0}]({0})\n\n", picture.name);
    }
    for (const StudyTable& table : study_tables(result)) {
        text += fmt::format("## {}\n\n{}\n", table.title, markdown_table(table.table));
    }
    return text;
}

std::string study_page(const StudyResult& result, const StudyInfo& info,
                       const std::vector<SvgFile>& pictures)
{
    std::string text = fmt::format(
        "<!DOCTYPE html>\n<html xmlns=\"http://www.w3.org/1999/xhtml\" lang=\"en\">\n<head>\n"
        "<meta charset=\"utf-8\"/>\n<title>{0}</title>\n<style>{1}</style>\n</head>\n<body>\n"
        "<h1>{0}</h1>\n{2}",
        escaped(result.study.title), style, html_paragraph(how_measured(result, info)));
    for (const SvgFile& picture : pictures) {
        text += picture.text;
    }
    for (const StudyTable& table : study_tables(result)) {
        text += fmt::format("<h2>{}</h2>\n{}", escaped(table.title), html_table(table.table));
    }
    return text + "</body>\n</html>\n";
}

} // namespace hyoryu
