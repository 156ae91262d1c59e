// SPDX-License-Identifier: MIT
#include "link_names.hpp"

#include "hyoryu/core/error.hpp"
#include "hyoryu/core/name.hpp"

#include <fmt/format.h>

#include <charconv>

namespace hyoryu {

std::string link_name(std::string_view name)
{
    return name == "." ? "%2E" : replaced(name, {{'/', "%2F"}, {'%', "%25"}});
}

std::string name_of(std::string_view link)
{
    std::string name;
    for (std::size_t i = 0; i < link.size(); ++i) {
        if (link[i] == '%' && i + 2 < link.size()) {
            int code = 0;
            const char* const end = link.data() + i + 3;
            if (std::from_chars(link.data() + i + 1, end, code, 16).ptr != end) {
                throw IoError(fmt::format("the checkpoint is damaged: it names `{}`", link));
            }
            name += static_cast<char>(code);
            i += 2;
        } else {
            name += link[i];
        }
    }
    return name;
}

} // namespace hyoryu
