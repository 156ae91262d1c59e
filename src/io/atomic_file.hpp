// SPDX-License-Identifier: MIT
// A file that appears whole or not at all: written to a temporary name, then renamed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string_view>

namespace hyoryu {

/// Ends the name of every file that is still being written.
inline constexpr std::string_view temporary_suffix = ".tmp";

class AtomicFile {
public:
    /// Opens `<file>.tmp` for writing. Every function throws IoError with the reason of the system.
    explicit AtomicFile(std::filesystem::path file);
    /// Removes the temporary file unless it was committed.
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    void write(std::span<const std::byte> bytes);
    void write(std::string_view text);
    /// Reserves disk space for the file. Throws IoError if its size exceeds the limit of the
    /// process or the free space. Does nothing on a file system that cannot reserve space.
    void reserve(std::uintmax_t bytes) const;
    /// The temporary file, for a library that writes to a path.
    const std::filesystem::path& temporary() const { return temporary_; }
    /// Reads the file from an offset [B] to its end and calls f(block) for each block.
    void read_from(std::uintmax_t place,
                   const std::function<void(std::span<const std::byte>)>& f) const;
    /// Forces the bytes to the disk and gives the file its name.
    void commit();

private:
    std::filesystem::path file_;
    std::filesystem::path temporary_;
    int descriptor_ = -1;
};

/// Writes all bytes to an open file descriptor; `file` is for the message of an IoError.
void write_all(int descriptor, std::span<const std::byte> bytes, const std::filesystem::path& file);

/// Throws IoError: "cannot <verb> `file`: <reason of errno>".
[[noreturn]] void throw_system_error(std::string_view verb, const std::filesystem::path& file);

} // namespace hyoryu
