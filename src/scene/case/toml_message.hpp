// SPDX-License-Identifier: MIT
// Messages of the TOML parser in our own words.
#pragma once

#include "hyoryu/scene/toml_document.hpp"

namespace hyoryu {

/// The fault that the library describes at a place of the text: what was expected there, and how to
/// mend it. Common slips (a decimal comma, a unit without quotes, a text that is not closed) are
/// known by the line itself; of others the description of the library is kept.
TomlFault plain_fault(std::string_view text, const Place& place, const std::string& description);

} // namespace hyoryu
