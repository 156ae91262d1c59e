// SPDX-License-Identifier: MIT
// `hyoryu new`: a commented case to begin with.
#include "commands.hpp"
#include "options.hpp"
#include "templates.hpp"

#include "hyoryu/core/error.hpp"
#include "hyoryu/io/results.hpp"
#include "hyoryu/scene/reader_hint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <vector>

namespace hyoryu {

namespace {

namespace fs = std::filesystem;

// "Dam break", "dam-break" and "DamBreak" are one name.
std::string letters_of(std::string_view name)
{
    std::string letters;
    for (const char letter : name) {
        if (letter != '_' && letter != '-' && letter != ' ') {
            letters += static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
        }
    }
    return letters;
}

const Template& template_named(const std::string& name)
{
    std::vector<std::string_view> known;
    for (const Template& one : templates()) {
        if (letters_of(one.name) == letters_of(name)) {
            return one;
        }
        known.push_back(one.name);
    }
    std::string spelled = name;
    std::ranges::replace(spelled, '-', '_');
    const std::string hint = did_you_mean(spelled, known);
    throw CaseError(fmt::format("unknown template \"{}\"", name),
                    (hint.empty() ? "" : hint + "; ") +
                        fmt::format("known: {}", quoted_list(known)));
}

// A name that ends in .toml is that of the case file, any other that of its folder.
fs::path case_file_of(const NewOptions& options, std::string_view name)
{
    const fs::path& asked = options.file;
    if (asked.empty()) {
        return std::string(name) + ".toml";
    }
    const bool is_file = asked.extension() == ".toml" && !fs::is_directory(asked);
    return is_file ? asked : asked / "case.toml";
}

void make_folder_of(const fs::path& file)
{
    const fs::path folder = file.parent_path();
    if (folder.empty()) {
        return;
    }
    std::error_code reason;
    fs::create_directories(folder, reason);
    if (fs::exists(folder) && !fs::is_directory(folder)) {
        throw CaseError(fmt::format("`{}` is a file, not a folder", folder.string()),
                        "give another name for the case");
    }
    if (reason) {
        throw IoError(
            fmt::format("cannot create the folder `{}`: {}", folder.string(), reason.message()));
    }
}

} // namespace

int write_new_case(const NewOptions& options)
{
    const Template& chosen = template_named(options.name);
    const fs::path file = case_file_of(options, chosen.name);
    make_folder_of(file);
    if (!write_new_text(file, chosen.text)) {
        throw CaseError(
            fmt::format("`{}` already exists", file.string()),
            "existing files are not overwritten: give another name, or remove the file");
    }
    fmt::print("case: {0}\ncheck it:  {1} check {0}\nrun it:    {1} run {0}\n", file.string(),
               options.program);
    return exit_code::done;
}

} // namespace hyoryu
