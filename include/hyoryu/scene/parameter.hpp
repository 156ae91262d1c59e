// SPDX-License-Identifier: MIT
// The table of every key that a case file may have: the one source of the reader, of `hyoryu
// describe` and of the JSON Schema.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hyoryu {

/// `number_or_name` is a number, or a text that names where numbers are found; `vector` is a list
/// of numbers, `vectors` of lists of three numbers, `integers` of whole numbers, `texts` of texts;
/// `tables` is written [[so]].
enum class ValueKind {
    number,
    number_or_name,
    integer,
    boolean,
    text,
    choice,
    vector,
    vectors,
    integers,
    texts,
    table,
    tables
};

/// One key of the case file.
struct Parameter {
    std::string key; // full path; arrays of tables as "body[]", for instance "body[].size"
    ValueKind kind;
    std::string_view unit = {};   // SI unit of a dimensional number, "" if it has none
    std::string_view bounds = {}; // in words a user reads: "> 0", "0 .. 1", "2 or 3"
    std::string fallback = {}; // the default as typed; "" if none, "required" if it must be there
    std::string_view meaning = {};              // one sentence
    std::vector<std::string_view> choices = {}; // of a choice or of the elements of `texts`
    double minimum = -1e300;                    // of each number
    double maximum = 1e300;
    bool minimum_excluded = false;
    int shortest = 0; // elements of a list
    int longest = 0;
};

/// All keys, in the order of the manual.
std::span<const Parameter> parameters();

/// The parameter of that key, or none.
const Parameter* find_parameter(std::string_view key);

/// The text that `hyoryu describe [KEY]` prints: one key, all keys below a table, or everything.
/// Throws CaseError with the nearest key when KEY is not known.
std::string describe(std::string_view key);

/// A JSON Schema (draft-04 subset) that editors such as Taplo use to check a case while it is
/// typed.
std::string json_schema();

} // namespace hyoryu
