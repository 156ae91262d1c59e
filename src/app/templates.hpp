// SPDX-License-Identifier: MIT
// The cases that `hyoryu new` writes: the files of src/app/templates, which the build puts into the
// program.
#pragma once

#include <span>
#include <string_view>

namespace hyoryu {

struct Template {
    std::string_view name; // "dam_break"
    std::string_view text; // a case file
};

/// In the order of their names.
std::span<const Template> templates();

} // namespace hyoryu
