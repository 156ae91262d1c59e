// SPDX-License-Identifier: MIT
// Files that a user names, looked at before they are opened: a pipe without a writer would wait for
// ever, a device has no end.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace hyoryu {

/// Largest text that a user types or that a program writes in the place of a user [B].
inline constexpr std::uintmax_t largest_text = std::uintmax_t{64} << 20;
/// No limit but that of the disk [B].
inline constexpr std::uintmax_t any_size = UINTMAX_MAX;

/// Why the file cannot be read, as it would follow its name: "does not exist", "is a folder", "is a
/// pipe, expected a file", "is larger than 64 MiB", "cannot be read: Permission denied". Empty if
/// it can. Links are followed.
std::string why_unreadable(const std::filesystem::path& file, std::uintmax_t largest = any_size);

/// The bytes of the file. Throws IoError with the reason above.
std::string bytes_of_file(const std::filesystem::path& file, std::uintmax_t largest = any_size);

} // namespace hyoryu
