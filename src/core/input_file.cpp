// SPDX-License-Identifier: MIT
#include "hyoryu/core/input_file.hpp"

#include "hyoryu/core/error.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

#include <unistd.h>

namespace hyoryu {

namespace fs = std::filesystem;

namespace {

std::string name_of(fs::file_type type)
{
    switch (type) {
    case fs::file_type::directory:
        return "folder";
    case fs::file_type::fifo:
        return "pipe";
    case fs::file_type::character:
    case fs::file_type::block:
        return "device";
    case fs::file_type::socket:
        return "socket";
    default:
        return "file of an unknown type";
    }
}

} // namespace

std::string why_unreadable(const fs::path& file, std::uintmax_t largest)
{
    std::error_code fault;
    const fs::file_status status = fs::status(file, fault);
    if (status.type() == fs::file_type::not_found) {
        return "does not exist";
    }
    if (fault) {
        return "cannot be read: " + fault.message();
    }
    if (!fs::is_regular_file(status)) {
        return fmt::format("is a {}, expected a file", name_of(status.type()));
    }
    if (::access(file.c_str(), R_OK) != 0) {
        return fmt::format("cannot be read: {}", std::strerror(errno));
    }
    const std::uintmax_t size = fs::file_size(file, fault);
    if (!fault && size > largest) {
        return fmt::format("is larger than {} MiB", largest >> 20);
    }
    return {};
}

std::string bytes_of_file(const fs::path& file, std::uintmax_t largest)
{
    const std::string why = why_unreadable(file, largest);
    if (!why.empty()) {
        throw IoError(fmt::format("`{}` {}", file.string(), why));
    }
    std::ifstream stream(file, std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    if (!stream.eof() && stream.fail()) {
        throw IoError(fmt::format("`{}` cannot be read", file.string()));
    }
    return bytes;
}

} // namespace hyoryu
