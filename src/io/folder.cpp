// SPDX-License-Identifier: MIT
// Makes a results folder ready, and refuses to remove anything that a run did not write.
#include "atomic_file.hpp"
#include "hyoryu/core/error.hpp"
#include "hyoryu/io/claim.hpp"
#include "hyoryu/io/results.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <fcntl.h>
#include <regex>
#include <sys/file.h>
#include <unistd.h>
#include <utility>

namespace hyoryu {

namespace {

namespace fs = std::filesystem;

/// Files that runs, `render`, `report` and `convert` write, as patterns of paths relative to the
/// folder.
constexpr std::array our_files{
    R"(case\.toml|plan\.json|summary\.json|run\.log|stop|report\.html|results\.h5|all\.vtkhdf)",
    R"(checkpoint(\.previous|\.[0-9]{6,12}\.[0-9]{4})?\.h5)",
    R"((bodies|contacts|energy|gauges|open|ranks)(_[0-9]+)?\.csv)",
    R"((fluid|bodies|surfaces|walls|structures)\.(hdf|hdf\.series))",
    R"(walls\.[0-9]{4}\.hdf)",
    R"(frames/(fluid|bodies|surfaces|walls|structures)_[0-9]{6,}\.hdf)",
    R"(frames/(fluid|walls)_[0-9]{6,}\.[0-9]{4}\.hdf)",
    R"((vtp|csv)/([a-z]+_[0-9]{6,}\.(vtp|csv)|[a-z]+\.(pvd|csv)|\.hyoryu-convert))",
    R"(\.hyoryu-kept-[A-Za-z0-9]{6})", // of a run that was killed before it took the name away
    R"(pictures/(frame_[0-9]{6,}\.png|animation\.mp4))",
};
constexpr std::array our_folders{"frames", "pictures", "vtp", "csv"};

std::string without_temporary_suffix(std::string name)
{
    if (name.ends_with(temporary_suffix)) {
        name.resize(name.size() - temporary_suffix.size());
    }
    return name;
}

bool is_ours(const fs::directory_entry& entry, const fs::path& folder)
{
    const std::string name = entry.path().lexically_relative(folder).generic_string();
    const fs::file_status status = entry.symlink_status();
    if (fs::is_directory(status)) {
        return std::find(our_folders.begin(), our_folders.end(), name) != our_folders.end();
    }
    const std::string final_name = without_temporary_suffix(name);
    return fs::is_regular_file(status) &&
           std::any_of(our_files.begin(), our_files.end(), [&](const char* pattern) {
               return std::regex_match(final_name, std::regex(pattern));
           });
}

/// Everything in the folder: ours by name, or foreign.
struct Inventory {
    std::vector<fs::path> ours; // files before the folders that hold them
    std::vector<std::string> foreign;
};

Inventory inventory(const fs::path& folder)
{
    Inventory result;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (is_ours(entry, folder)) {
            result.ours.push_back(entry.path());
        } else {
            result.foreign.push_back(entry.path().lexically_relative(folder).generic_string());
        }
    }
    std::reverse(result.ours.begin(), result.ours.end());
    std::sort(result.foreign.begin(), result.foreign.end());
    return result;
}

/// The files of a run, in a folder that holds nothing else. Throws CaseError otherwise.
Inventory inventory_of_results(const fs::path& folder)
{
    if (!fs::is_directory(folder / "frames") && !fs::exists(folder / "plan.json")) {
        throw CaseError(fmt::format("`{}` is not empty and is not a results folder: it contains "
                                    "neither `frames/` nor `plan.json`",
                                    folder.string()),
                        "choose another folder with -o");
    }
    Inventory found = inventory(folder);
    if (!found.foreign.empty()) {
        constexpr std::size_t named_at_most = 5;
        const std::size_t count = found.foreign.size();
        found.foreign.resize(std::min(count, named_at_most));
        throw CaseError(
            fmt::format("`{}` contains {} not written by a run, so it is not replaced: {}{}",
                        folder.string(), count == 1 ? "a file" : "files",
                        fmt::join(found.foreign, ", "), count > named_at_most ? ", ..." : ""),
            "move them away, or choose another folder with -o");
    }
    return found;
}

void remove_our_files(const fs::path& folder)
{
    for (const fs::path& path : inventory_of_results(folder).ours) {
        fs::remove(path);
    }
}

/// Files that a killed run left half-written.
void remove_temporary_files(const fs::path& folder)
{
    for (const fs::path& path : inventory(folder).ours) {
        if (path.native().ends_with(temporary_suffix)) {
            fs::remove(path);
        }
    }
}

void clear_as_asked(const fs::path& folder, Existing existing)
{
    if (fs::is_empty(folder)) {
        return;
    }
    switch (existing) {
    case Existing::refuse:
        throw CaseError(fmt::format("the results folder `{}` is not empty", folder.string()),
                        "--force replaces it, --resume continues it, -o selects another");
    case Existing::replace:
        return remove_our_files(folder);
    case Existing::extend:
        return remove_temporary_files(folder);
    }
}

} // namespace

FolderLock::FolderLock(const fs::path& folder)
    : descriptor_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC))
{
    if (descriptor_ < 0) {
        throw_system_error("open", folder);
    }
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
        ::close(descriptor_);
        throw CaseError(
            fmt::format("another run is writing to the results folder `{}`", folder.string()),
            "wait for it or stop it, or choose another folder with -o");
    }
}

FolderLock::~FolderLock()
{
    if (descriptor_ >= 0) {
        ::close(descriptor_);
    }
}

FolderLock::FolderLock(FolderLock&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1))
{
}

void expect_no_file(const fs::path& folder)
{
    std::error_code fault;
    if (fs::exists(folder, fault) && !fs::is_directory(folder, fault)) {
        throw CaseError(fmt::format("`{}` is a file, not a folder", folder.string()),
                        "choose another folder with -o");
    }
}

void expect_replaceable(const fs::path& folder)
{
    expect_no_file(folder);
    std::error_code fault;
    if (fs::is_directory(folder, fault) && !fs::is_empty(folder, fault)) {
        inventory_of_results(folder);
    }
}

void remove_results_except(const fs::path& folder,
                           const std::function<bool(const std::string&)>& kept)
{
    for (const fs::path& path : inventory(folder).ours) {
        std::error_code not_empty; // a folder of ours that holds something foreign stays
        if (!kept(path.lexically_relative(folder).generic_string())) {
            fs::remove(path, not_empty);
        }
    }
}

void expect_results(const fs::path& folder)
{
    std::error_code fault;
    if (!fs::exists(folder, fault)) {
        throw CaseError(fmt::format("the folder `{}` does not exist", folder.string()),
                        "give a folder written by `hyoryu run`");
    }
    if (!fs::exists(folder / "plan.json", fault)) {
        throw CaseError(
            fmt::format("`{}` is not a results folder: it has no plan.json", folder.string()),
            "give a folder written by `hyoryu run`");
    }
}

FolderLock prepare_results(const fs::path& folder, Existing existing)
{
    try {
        expect_no_file(folder);
        fs::create_directories(folder);
        FolderLock lock(folder);
        clear_as_asked(folder, existing);
        fs::create_directories(folder / "frames");
        for (const fs::path& place : {folder, folder / "frames"}) {
            if (::access(place.c_str(), W_OK) != 0) {
                throw_system_error("write to", place);
            }
        }
        return lock;
    } catch (const fs::filesystem_error& error) {
        throw IoError(fmt::format("cannot prepare the results folder `{}`: {}", folder.string(),
                                  error.code().message()));
    }
}

} // namespace hyoryu
