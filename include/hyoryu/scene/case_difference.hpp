// SPDX-License-Identifier: MIT
// Differences of two cases, key by key: those that a restart allows, and those that it refuses.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace hyoryu {

/// A key whose value differs. Values as TOML; empty where the case does not have the key.
struct KeyDifference {
    std::string key; // full path: "body[2].density"
    std::string before;
    std::string after;
};

/// The differences of two cases as `to_toml` writes them, in the order of their keys. Throws
/// CaseError if one is not valid TOML.
std::vector<KeyDifference> case_differences(const std::string& before, const std::string& after);

/// A case as it was given: the text of its file, and overrides.
struct GivenCase {
    std::string text;
    std::vector<std::string> overrides;
};

/// The differences of the [[debris]] of two cases, which `to_toml` writes as bodies. Empty if a
/// text is not valid TOML.
std::vector<KeyDifference> debris_differences(const GivenCase& before, const GivenCase& after);

/// How the names of the pieces of each [[debris]] of a case begin: "yard.", "debris.2.". Empty
/// without debris, or if the text is not valid TOML.
std::vector<std::string> piece_prefixes(const GivenCase& given);

/// Whether a run may go on with another value of the key: title, end, output and its intervals,
/// gauges, and recovery. Geometry, physics and the time step are in the state already.
bool may_change_on_resume(std::string_view key);

} // namespace hyoryu
