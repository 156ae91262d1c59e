// SPDX-License-Identifier: MIT
// Names of arrays as names of links in an HDF5 file.
#pragma once

#include <string>
#include <string_view>

namespace hyoryu {

/// Names may hold any letter; a link of HDF5 may hold no `/` and must not be `.`.
std::string link_name(std::string_view name);

/// The name of a link. Throws IoError if link_name() gives no such link.
std::string name_of(std::string_view link);

} // namespace hyoryu
