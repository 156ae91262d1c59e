// SPDX-License-Identifier: MIT
#include "hyoryu/core/name.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace hyoryu {

namespace {

constexpr std::string_view of_formulas = "=+-@";
constexpr std::string_view of_formats = "\",;#/\\";

/// Bytes of the control character that begins at `at`; 0 if none does. C1 is U+0080 .. U+009F.
std::size_t control_length(std::string_view text, std::size_t at)
{
    const auto byte = [&](std::size_t k) {
        return k < text.size() ? static_cast<unsigned char>(text[k]) : 0U;
    };
    if (byte(at) < 0x20 || byte(at) == 0x7f) {
        return 1;
    }
    return byte(at) == 0xc2 && byte(at + 1) >= 0x80 && byte(at + 1) < 0xa0 ? 2 : 0;
}

} // namespace

bool has_control_characters(std::string_view text)
{
    for (std::size_t k = 0; k < text.size(); ++k) {
        if (control_length(text, k) > 0) {
            return true;
        }
    }
    return false;
}

std::string label_fault(std::string_view label)
{
    if (has_control_characters(label)) {
        return "it contains control characters";
    }
    if (label.size() > longest_label) {
        return fmt::format("it has {} bytes, at most {} are allowed", label.size(), longest_label);
    }
    if (!label.empty() && of_formulas.find(label.front()) != std::string_view::npos) {
        return fmt::format("it begins with \"{}\", as formulas of tables do", label.front());
    }
    return {};
}

std::string name_fault(std::string_view name)
{
    if (name.empty()) {
        return "it is empty";
    }
    if (const std::string fault = label_fault(name); !fault.empty()) {
        return fault;
    }
    if (name.size() > longest_name) {
        return fmt::format("it has {} bytes, at most {} are allowed", name.size(), longest_name);
    }
    if (name.front() == ' ' || name.back() == ' ') {
        return "it begins or ends with a space";
    }
    if (name == "." || name == "..") {
        return "it is the name of a folder";
    }
    const auto at = name.find_first_of(of_formats);
    return at == std::string_view::npos ? std::string() : fmt::format("it contains `{}`", name[at]);
}

std::string printable(std::string_view text)
{
    std::string safe;
    for (std::size_t k = 0; k < text.size();) {
        const std::size_t length = text[k] == '\n' ? 0 : control_length(text, k);
        if (length == 0) {
            safe += text[k];
            ++k;
            continue;
        }
        for (const std::size_t end = k + length; k < end; ++k) {
            safe += fmt::format("\\x{:02x}", static_cast<unsigned char>(text[k]));
        }
    }
    return safe;
}

std::string replaced(std::string_view text,
                     std::initializer_list<std::pair<char, std::string_view>> by)
{
    std::string result;
    for (const char letter : text) {
        const auto* const found =
            std::ranges::find(by, letter, &std::pair<char, std::string_view>::first);
        result += found == by.end() ? std::string_view(&letter, 1) : found->second;
    }
    return result;
}

} // namespace hyoryu
