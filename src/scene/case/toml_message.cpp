// SPDX-License-Identifier: MIT
#include "toml_message.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <regex>

namespace hyoryu {

namespace {

std::string line_at(std::string_view text, int number)
{
    for (int k = 1; k < number; ++k) {
        const auto end = text.find('\n');
        if (end == std::string_view::npos) {
            return {};
        }
        text.remove_prefix(end + 1);
    }
    constexpr std::size_t longest = 500; // characters of a line that are searched for patterns
    return std::string(text.substr(0, std::min(text.find_first_of("\r\n"), longest)));
}

struct Words {
    std::string what;
    std::string hint;
};

// Slips that a line shows by itself.
std::optional<Words> slip_in(const std::string& line)
{
    static const std::regex comma(R"(^\s*([\w.-]+)\s*=\s*([-+]?\d+),(\d+)\s*(#.*)?$)");
    static const std::regex unit(
        R"(^\s*([\w.-]+)\s*=\s*([-+]?[\d.]+(?:[eE][-+]?\d+)?)\s*([A-Za-z][\w/^-]*(?: [\w/^-]+)*)\s*(#.*)?$)");
    static const std::regex power(R"(^\s*([\w.-]+)\s*=\s*([-+]?\d[\d.]*[eE]\+?\d+)\s*(#.*)?$)");
    static const std::regex word(R"(^\s*([\w.-]+)\s*=\s*([A-Za-z_][\w .-]*?)\s*(#.*)?$)");
    static const std::regex point(
        R"(^\s*([\w.-]+)\s*=\s*([-+]?)(\d*)\.(\d*)([eE][-+]?\d+)?\s*(#.*)?$)");
    std::smatch m;
    if (std::regex_match(line, m, comma)) {
        return Words{"a number has a decimal point, not a comma",
                     fmt::format("write {} = {}.{}", m.str(1), m.str(2), m.str(3))};
    }
    if (std::regex_match(line, m, power) &&
        !std::isfinite(std::strtod(m.str(2).c_str(), nullptr))) {
        return Words{"the number " + m.str(2) + " is too large", "at most 1.8e308"};
    }
    if (std::regex_match(line, m, unit)) {
        return Words{"a number with a unit must be in quotes",
                     fmt::format("write {} = \"{} {}\"", m.str(1), m.str(2), m.str(3))};
    }
    if (std::regex_match(line, m, point) && (m.length(3) == 0 || m.length(4) == 0)) {
        const auto digits = [](const std::string& part) { return part.empty() ? "0" : part; };
        return Words{"a decimal point needs a digit before and after it",
                     fmt::format("write {} = {}{}.{}{}", m.str(1), m.str(2), digits(m.str(3)),
                                 digits(m.str(4)), m.str(5))};
    }
    if (line.find("\xe2\x80\x9c") != std::string::npos ||
        line.find("\xe2\x80\x9d") != std::string::npos) {
        return Words{"a text cannot begin with typographic quotes", "use straight quotes: \""};
    }
    if (std::regex_match(line, m, word)) {
        const std::string value = m.str(2);
        if (value == "True" || value == "TRUE" || value == "False" || value == "FALSE") {
            return Words{
                "true and false are written in lower case",
                fmt::format("write {} = {}", m.str(1), value[0] == 'T' ? "true" : "false")};
        }
        if (value != "true" && value != "false" && value != "inf" && value != "nan") {
            return Words{"a text must be in quotes",
                         fmt::format("write {} = \"{}\"", m.str(1), value)};
        }
    }
    return std::nullopt;
}

// Messages for rare mistakes.
Words rare_meaning_of(const std::string& description)
{
    const auto says = [&](std::string_view part) {
        return description.find(part) != std::string::npos;
    };
    if (says("utf-8") || says("surrogates") || says("U+10FFFF")) {
        return {"the text is not encoded in UTF-8",
                "save the file as UTF-8 in the editor, or remove the character"};
    }
    if (says("after '\\r'")) {
        return {"a line ends with a carriage return only",
                "save the file with the line endings of Unix or Windows"};
    }
    if (says("nested value depth")) {
        return {"lists or tables in braces are nested too deeply", "at most 256 levels"};
    }
    if (says("too long to identify") || says("length limit")) {
        return {"the number is too long", "at most 17 digits are significant"};
    }
    if (says("comment or whitespace")) {
        return {"expected the end of the line", "write one key per line; a comment begins with #"};
    }
    if (says("date") || says("time")) {
        return {"the date or time is invalid", "no key has one; a text must be in quotes"};
    }
    return {};
}

// Messages by parts of the description of the library.
Words meaning_of(const std::string& description, bool at_end)
{
    const auto says = [&](std::string_view part) {
        return description.find(part) != std::string::npos;
    };
    static const std::regex twice("cannot redefine existing ([a-z -]+) '([^']*)'");
    std::smatch m;
    if (std::regex_search(description, m, twice)) {
        return {fmt::format("\"{}\" is defined twice", m.str(2)),
                "remove one of them; each table of a list is written [[name]]"};
    }
    const bool text = says("parsing string") || says("parsing literal string");
    if (text && (at_end || says("end-of-file"))) {
        return {"the text is not closed", "its closing quote is missing"};
    }
    if (says("escape")) {
        return {"a backslash begins an unknown escape", "write two of them, or the text in "
                                                        "single quotes"};
    }
    if (text || says("parsing comment")) {
        return {"a control character is not allowed here", "remove it"};
    }
    if (says("array") && (at_end || says("end-of-file"))) {
        return {"the list is not closed", "`]` is missing"};
    }
    if (says("inline table")) {
        return {"the table in braces is invalid or not closed",
                "write it in one line: { key = value, key = value }"};
    }
    if (says("table header")) {
        return {"the header of a table is invalid or not closed", "write [name] or [[name]]"};
    }
    if (says("expected '='")) {
        return {"expected `=` after the key", "write key = value"};
    }
    if (says("expected value")) {
        return {"the key has no value", "write key = value"};
    }
    if (says("leading zeroes")) {
        return {"a number has leading zeros", "write 5, not 05"};
    }
    if (says("not representable in 64 bits")) {
        return {"the whole number is too large", "write it as 1e20, with an exponent"};
    }
    if (says("floating-point") || says("integer")) {
        return {"the number is invalid", "for instance 12, 0.25 or 1e-3"};
    }
    if (says("value type")) {
        return {"the value is invalid", "a number, a text in quotes, true, false or a list"};
    }
    if (says("root table") || says("expected keys")) {
        return {"expected a key or the header of a table",
                "keys have letters a-z, digits, `_` and `-`; others must be in quotes"};
    }
    return rare_meaning_of(description);
}

} // namespace

TomlFault plain_fault(std::string_view text, const Place& place, const std::string& description)
{
    const std::string line = line_at(text, place.line);
    const bool doubled = description.find("redefine") != std::string::npos;
    if (const auto slip = doubled ? std::nullopt : slip_in(line)) {
        return {place, slip->what, slip->hint};
    }
    const bool at_end = at(std::max(place.column, 1)) > line.size();
    Words words = meaning_of(description, at_end);
    if (words.what.empty()) {
        constexpr std::string_view lead = "error while parsing ";
        const auto colon = description.find(": ");
        const bool known = description.starts_with(lead) && colon != std::string::npos;
        words.what = "is not understood: " + (known ? description.substr(colon + 2) : description);
    }
    return {place, words.what, words.hint};
}

} // namespace hyoryu
