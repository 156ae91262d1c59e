// SPDX-License-Identifier: MIT
#include "hyoryu/io/claim.hpp"

#include "hyoryu/core/error.hpp"
#include "hyoryu/io/results.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>

namespace hyoryu {

namespace {

namespace fs = std::filesystem;

void claim_unguarded(const fs::path& folder, const Claim& claim)
{
    expect_no_file(folder);
    const fs::path mark = folder / fmt::format(".hyoryu-{}", claim.command);
    if (fs::exists(mark)) {
        return;
    }
    if (fs::exists(folder)) {
        const std::vector<std::string> names = owned_names(folder, claim.owns);
        if (!names.empty()) {
            throw CaseError(
                fmt::format("`{}` contains files that were not written by {} and would be "
                            "replaced: {}",
                            folder.string(), claim.command, fmt::join(names, ", ")),
                "move them away, or choose another folder with -o");
        }
    }
    fs::create_directories(folder);
    write_text(mark,
               fmt::format("Results of `hyoryu {}`, which may replace them.\n", claim.command));
}

} // namespace

std::vector<std::string> owned_names(const fs::path& folder,
                                     const std::function<bool(const std::string&)>& owns)
{
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        if (owns(name)) {
            names.push_back(name);
        }
    }
    std::ranges::sort(names);
    return names;
}

void expect_own_file(const fs::path& file, const FileMark& mark)
{
    std::error_code fault;
    const fs::file_status status = fs::symlink_status(file, fault);
    if (status.type() == fs::file_type::not_found) {
        return;
    }
    if (status.type() != fs::file_type::regular) {
        throw CaseError(fmt::format("`{}` exists and is not a regular file", file.string()),
                        "choose another file");
    }
    constexpr std::streamsize most = 4096;
    std::string begin(most, '\0');
    std::ifstream stream(file, std::ios::binary);
    stream.read(begin.data(), most);
    begin.resize(static_cast<std::size_t>(stream.gcount()));
    const bool empty = stream.eof() && begin.empty();
    if (!empty && !(begin.starts_with(mark.start) && begin.find(mark.within) != begin.npos)) {
        throw CaseError(fmt::format("`{}` exists and was not written by `hyoryu {}`", file.string(),
                                    mark.command),
                        "choose another file, or move this one away");
    }
}

void claim_folder(const fs::path& folder, const Claim& claim)
{
    try {
        claim_unguarded(folder, claim);
    } catch (const fs::filesystem_error& error) {
        throw IoError(fmt::format("cannot prepare the folder `{}`: {}", folder.string(),
                                  error.code().message()));
    }
}

} // namespace hyoryu
