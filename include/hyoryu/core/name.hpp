// SPDX-License-Identifier: MIT
// Names and labels that a user types: checked once, where they enter, by one rule, because they
// become columns of CSV files, links of HDF5 files, names of files and lines on a terminal.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

namespace hyoryu {

/// Bytes of the longest name, and of the longest label.
inline constexpr std::size_t longest_name = 100;
inline constexpr std::size_t longest_label = 500;

/// The fault of the name of a wall, body, gauge or material, as it follows "is not a valid name: ".
/// Empty if nothing is. A name has 1 to 100 bytes and none of `" , ; # / \` and control characters;
/// it neither begins nor ends with a blank, does not begin with `= + - @`, by which programs of
/// tables know a formula, and is not `.` or `..`, which are folders.
std::string name_fault(std::string_view name);

/// The same for a line that is only shown, such as a title: at most 500 bytes, without control
/// characters, not beginning with `= + - @`. It may be empty.
std::string label_fault(std::string_view label);

/// Whether a byte of the text begins a control character (C0, DEL, or C1 in UTF-8).
bool has_control_characters(std::string_view text);

/// The text with every control character except line ends replaced by `\xNN`, since a terminal
/// would execute it.
std::string printable(std::string_view text);

/// The text with each of these characters replaced by its text, in one pass: what is put in is not
/// replaced again.
std::string replaced(std::string_view text,
                     std::initializer_list<std::pair<char, std::string_view>> by);

} // namespace hyoryu
