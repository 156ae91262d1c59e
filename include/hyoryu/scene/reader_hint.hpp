// SPDX-License-Identifier: MIT
// "Did you mean": the known word that is nearest to a mistyped one.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace hyoryu {

/// `did you mean "density"?`, or nothing if no candidate is near.
std::string did_you_mean(std::string_view word, std::span<const std::string_view> candidates);

/// The words in quotes with commas between them.
std::string quoted_list(std::span<const std::string_view> words);

} // namespace hyoryu
