// SPDX-License-Identifier: MIT
// Parsing with toml++; the only file that includes it.
#include "hyoryu/scene/toml_document.hpp"

#include "toml_message.hpp"

#define TOML_HEADER_ONLY 0
#include <toml++/toml.h>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <sstream>

namespace hyoryu {

namespace {

// A dotted key makes one nested table a dot; the library bounds nesting in brackets but not here,
// and would overflow the stack on a key of a hundred thousand dots.
constexpr int most_dots_in_key = 64;

Place place_of(const toml::source_region& region)
{
    Place place;
    place.line = static_cast<int>(region.begin.line);
    place.column = static_cast<int>(region.begin.column);
    const bool one_line = region.end.line == region.begin.line;
    place.length = one_line && region.end.column > region.begin.column
                       ? static_cast<int>(region.end.column - region.begin.column)
                       : 1;
    return place;
}

TomlNode convert(const toml::node& node)
{
    TomlNode result;
    result.place = place_of(node.source());
    if (const auto* table = node.as_table()) {
        TomlTable entries;
        entries.reserve(table->size());
        for (const auto& [key, value] : *table) {
            entries.push_back({std::string(key.str()), place_of(key.source()), convert(value)});
        }
        result.value = std::move(entries);
    } else if (const auto* array = node.as_array()) {
        TomlArray items;
        items.reserve(array->size());
        for (const auto& item : *array) {
            items.push_back(convert(item));
        }
        result.value = std::move(items);
    } else if (const auto* text = node.as_string()) {
        result.value = text->get();
    } else if (const auto* integer = node.as_integer()) {
        result.value = integer->get();
    } else if (const auto* number = node.as_floating_point()) {
        result.value = number->get();
    } else if (const auto* flag = node.as_boolean()) {
        result.value = flag->get();
    } else {
        result.value = TomlDate{};
    }
    return result;
}

void refuse_endless_keys(std::string_view text)
{
    int dots = 0;
    int line = 1;
    char previous = '\0';
    for (const char c : text) {
        if (c == '.' && previous != '.') {
            ++dots;
        } else if (c == '\n' || c == '=' || c == ',' || c == '.') {
            dots = 0;
        }
        if (dots > most_dots_in_key) {
            throw TomlFault{
                {.line = line, .column = 1},
                fmt::format("a key has more than {} parts separated by dots", most_dots_in_key),
                "a text or a long number must be in quotes"};
        }
        line += c == '\n' ? 1 : 0;
        previous = c;
    }
}

std::string lower_first(std::string text)
{
    if (text.size() > 1 && std::islower(static_cast<unsigned char>(text[1])) != 0) {
        text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
    }
    return text;
}

} // namespace

bool operator==(const TomlNode& a, const TomlNode& b)
{
    return a.value == b.value;
}

bool operator==(const TomlEntry& a, const TomlEntry& b)
{
    return a.key == b.key && a.node == b.node;
}

const TomlEntry* find_entry(const TomlTable& table, std::string_view key)
{
    const auto at = std::find_if(table.begin(), table.end(),
                                 [key](const TomlEntry& entry) { return entry.key == key; });
    return at == table.end() ? nullptr : &*at;
}

TomlEntry* find_entry(TomlTable& table, std::string_view key)
{
    return const_cast<TomlEntry*>(find_entry(std::as_const(table), key));
}

TomlNode parse_toml(std::string_view text)
{
    refuse_endless_keys(text);
    try {
        return convert(toml::parse(text));
    } catch (const toml::parse_error& error) {
        throw plain_fault(text, place_of(error.source()),
                          lower_first(std::string(error.description())));
    }
}

std::vector<std::string> lines_to_show(const std::string& text)
{
    constexpr std::size_t longest = 200;
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) {
        if (!line.empty() && line.back() == '\r') {
            line.pop_back();
        }
        std::replace_if(
            line.begin(), line.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; },
            ' ');
        lines.push_back(line.size() > longest ? std::string() : line);
    }
    return lines;
}

std::string found(const TomlNode& node)
{
    struct Describe {
        std::string operator()(const std::string& text) const
        {
            constexpr std::size_t longest = 60;
            return text.size() > longest
                       ? fmt::format("the text \"{}...\"", text.substr(0, longest))
                       : fmt::format("the text \"{}\"", text);
        }
        std::string operator()(std::int64_t integer) const
        {
            return fmt::format("the number {}", integer);
        }
        std::string operator()(double number) const { return fmt::format("the number {}", number); }
        std::string operator()(bool flag) const { return flag ? "true" : "false"; }
        std::string operator()(const TomlDate&) const { return "a date or time"; }
        std::string operator()(const TomlArray& array) const
        {
            return fmt::format("a list of {}", array.size());
        }
        std::string operator()(const TomlTable&) const { return "a table"; }
    };
    return std::visit(Describe{}, node.value);
}

} // namespace hyoryu
