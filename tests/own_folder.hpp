// SPDX-License-Identifier: MIT
// A folder of its own for a test that writes files, since tests run side by side.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace hyoryu {

/// A new empty folder, removed with all that it holds at the end of its life.
class OwnFolder {
public:
    explicit OwnFolder(const std::filesystem::path& parent = std::filesystem::temp_directory_path())
    {
        std::string pattern = (parent / "hyoryu-XXXXXX").string();
        path_ = ::mkdtemp(pattern.data()); // throws std::logic_error where there is none
    }
    ~OwnFolder()
    {
        std::error_code gone_already;
        std::filesystem::remove_all(path_, gone_already);
    }
    OwnFolder(const OwnFolder&) = delete;
    OwnFolder& operator=(const OwnFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }
    /// The place of the file of that name.
    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
    /// Writes the file of that name; its place.
    std::filesystem::path put(const std::string& name, std::string_view bytes) const
    {
        std::ofstream(path_ / name, std::ios::binary) << bytes;
        return path_ / name;
    }

private:
    std::filesystem::path path_;
};

} // namespace hyoryu
