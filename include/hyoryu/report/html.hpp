// SPDX-License-Identifier: MIT
// Pieces of a page that is both HTML and well-formed XML.
#pragma once

#include <string>
#include <string_view>

namespace hyoryu {

/// The text as allowed in an element or an attribute: & < > " ' become entities, and control
/// characters, which XML forbids, the replacement character U+FFFD.
std::string escaped(std::string_view text);

/// A paragraph of plain text.
std::string html_paragraph(std::string_view text);

} // namespace hyoryu
