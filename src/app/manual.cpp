// SPDX-License-Identifier: MIT
// Manual pages as roff, from the same texts as `--help`.
#include "build_info.hpp"
#include "command_texts.hpp"

#include "hyoryu/core/error.hpp"
#include "hyoryu/core/name.hpp"
#include "hyoryu/scene/reader_hint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <sstream>
#include <string_view>

namespace hyoryu {

namespace {

// A text that roff takes as it is: a line that begins with a dot or a quote would be a request, and
// a plain hyphen would not come out as the one that is typed.
std::string roff(std::string_view text)
{
    const bool is_request = text.starts_with('.') || text.starts_with('\'');
    return (is_request ? "\\&" : "") + replaced(text, {{'-', "\\-"}, {'\\', "\\e"}});
}

std::string upper_case(std::string text)
{
    std::ranges::transform(text, text.begin(), [](unsigned char letter) {
        return static_cast<char>(std::toupper(letter));
    });
    return text;
}

std::string head_of_option(const OptionText& option)
{
    if (option.names.empty()) {
        return fmt::format("\\fI{}\\fR", roff(option.place));
    }
    std::string head;
    for (const std::string& name : option.names) {
        head += fmt::format("{}\\fB{}\\fR", head.empty() ? "" : ", ", roff(name));
    }
    return option.value.empty() ? head : fmt::format("{} \\fI{}\\fR", head, roff(option.value));
}

std::string options_section(const std::string& title, const std::vector<OptionText>& options)
{
    std::string text = options.empty() ? "" : fmt::format(".SH {}\n", title);
    for (const OptionText& option : options) {
        text += fmt::format(".TP\n{}\n{}\n", head_of_option(option), roff(option.description));
    }
    return text;
}

std::string synopsis_of(const CommandText& command)
{
    std::string text = fmt::format(".B hyoryu {}\n[\\fIOPTIONS\\fR]\n", roff(command.name));
    for (const OptionText& option : command.places) {
        const std::string name =
            fmt::format("\\fI{}\\fR{}", roff(option.place), option.repeats ? " ..." : "");
        text += option.required ? name + "\n" : fmt::format("[{}]\n", name);
    }
    return text;
}

// The text below the options of a help: a line that ends in a colon is the head of a section, what
// is indented stands as it was typed.
std::string footer_sections(const std::string& footer)
{
    std::string text;
    bool typed = false;
    std::istringstream stream(footer);
    for (std::string line; std::getline(stream, line);) {
        const bool indented = line.starts_with("  ");
        if (indented != typed) {
            text += indented ? ".nf\n" : ".fi\n";
            typed = indented;
        }
        if (line.ends_with(':')) {
            line.pop_back();
            text += fmt::format(".SH {}\n", roff(upper_case(line)));
        } else {
            text += line.empty() ? ".PP\n" : roff(line) + "\n";
        }
    }
    return typed ? text + ".fi\n" : text;
}

std::string head_of_page(const std::string& name, const std::string& what)
{
    return fmt::format(".TH {} 1 \"\" \"hyoryu {}\" \"Hyoryu\"\n"
                       ".SH NAME\n{} \\- {}\n.SH SYNOPSIS\n",
                       roff(upper_case(name)), build_info::version, roff(name), roff(what));
}

std::string page_of_program(const ProgramText& texts)
{
    std::string commands = ".SH COMMANDS\n";
    for (const CommandText& command : texts.commands) {
        commands += fmt::format(".TP\n\\fBhyoryu\\-{}\\fR(1)\n{}\n", roff(command.name),
                                roff(command.description));
    }
    return head_of_page("hyoryu", "floods that carry debris") +
           ".B hyoryu\n\\fICOMMAND\\fR\n[\\fIOPTIONS\\fR]\n.SH DESCRIPTION\n" +
           roff(texts.program.description) + "\n" + commands +
           options_section("OPTIONS", texts.program.options) +
           footer_sections(texts.program.footer);
}

std::string page_of_command(const CommandText& command)
{
    return head_of_page("hyoryu-" + command.name, command.description) + synopsis_of(command) +
           options_section("ARGUMENTS", command.places) +
           options_section("OPTIONS", command.options) + footer_sections(command.footer) +
           ".SH SEE ALSO\n.BR hyoryu (1)\n";
}

} // namespace

std::string manual_page(const ProgramText& texts, const std::string& command)
{
    if (command.empty()) {
        return page_of_program(texts);
    }
    std::vector<std::string_view> known;
    for (const CommandText& one : texts.commands) {
        if (one.name == command) {
            return page_of_command(one);
        }
        known.push_back(one.name);
    }
    throw CaseError(fmt::format("unknown command \"{}\"", command), did_you_mean(command, known));
}

} // namespace hyoryu
