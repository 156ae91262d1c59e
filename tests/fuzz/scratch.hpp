// SPDX-License-Identifier: MIT
// A folder of its own for targets that read files: in memory where there is such a place, because
// what writes a checkpoint waits for the disk.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>

namespace hyoryu::test_help {

class Scratch {
public:
    Scratch()
        : folder_((std::filesystem::exists("/dev/shm") ? std::filesystem::path("/dev/shm")
                                                       : std::filesystem::temp_directory_path()) /
                  ("hyoryu-fuzz-" + std::to_string(::getpid())))
    {
        std::filesystem::create_directories(folder_);
    }
    ~Scratch()
    {
        std::error_code gone_already;
        std::filesystem::remove_all(folder_, gone_already);
    }
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;

    /// The file of that name, with these bytes.
    std::filesystem::path put(const std::string& name, const std::uint8_t* data,
                              std::size_t size) const
    {
        std::ofstream stream(folder_ / name, std::ios::binary);
        stream.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
        return folder_ / name;
    }

private:
    std::filesystem::path folder_;
};

} // namespace hyoryu::test_help
