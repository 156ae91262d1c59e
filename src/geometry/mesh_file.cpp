// SPDX-License-Identifier: MIT
#include "mesh_file.hpp"

#include "hyoryu/core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

namespace hyoryu {

namespace {

constexpr std::uintmax_t stl_header = 84;         // bytes: 80 of text and the number of triangles
constexpr std::uintmax_t stl_triangle = 50;       // bytes
constexpr std::uintmax_t largest_file = 2u << 30; // bytes
using Head = std::array<unsigned char, stl_header>;

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& why)
{
    throw IoError(fmt::format("the mesh {} {}", file.string(), why));
}

std::uint32_t little_endian(const Head& head)
{
    std::uint32_t value = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        value |= static_cast<std::uint32_t>(head[80 + k]) << (8 * k);
    }
    return value;
}

/// The three numbers of a corner are finite. VTK takes "nan" and "1e999" for zero, without a word.
bool finite_corner(std::istringstream& line)
{
    std::string word;
    for (int k = 0; k < 3; ++k) {
        double number = 0;
        if (!(line >> word)) {
            return false;
        }
        const char* const begin = word.data() + (word.starts_with('+') ? 1 : 0);
        const auto [stop, fault] = std::from_chars(begin, word.data() + word.size(), number);
        if (fault != std::errc{} || stop != word.data() + word.size() || !std::isfinite(number)) {
            return false;
        }
    }
    return true;
}

/// The corner, texture and normal numbers of one face exist ("3", "3/1", "3/1/2", "3//2"; negative
/// ones count back). VTK follows them wherever they lead, and looks for a number behind a slash in
/// the next word, too.
bool face_fits(std::istringstream& line, const std::array<long long, 3>& counts)
{
    for (std::string word; line >> word;) {
        std::size_t kind = 0;
        const char* at = word.data();
        const char* const end = at + word.size();
        for (; at < end && kind < counts.size(); ++kind) {
            long long number = 0;
            const auto [stop, fault] = std::from_chars(at, end, number);
            const bool left_out = stop == at && kind == 1;
            if (!left_out &&
                (fault != std::errc{} || number == 0 || std::abs(number) > counts[kind])) {
                return false;
            }
            if (stop != end && (*stop != '/' || stop + 1 == end)) {
                return false;
            }
            at = stop == end ? end : stop + 1;
        }
        if (at != end) {
            return false;
        }
    }
    return true;
}

/// Checks every face of an OBJ file.
void check_faces(const std::filesystem::path& file)
{
    std::ifstream stream(file);
    std::string text;
    std::array<long long, 3> counts{}; // of corners, texture points and normals so far
    for (long long number = 1; std::getline(stream, text); ++number) {
        std::istringstream line(text);
        std::string word;
        line >> word;
        counts[0] += word == "v" ? 1 : 0;
        counts[1] += word == "vt" ? 1 : 0;
        counts[2] += word == "vn" ? 1 : 0;
        if (word == "f" && !face_fits(line, counts)) {
            refuse(file,
                   fmt::format("has a face in line {} with corners that are not defined before it",
                               number));
        }
    }
}

/// Checks every corner of a text file; `keyword` begins the line of one.
void check_corners(const std::filesystem::path& file, const std::string& keyword)
{
    std::ifstream stream(file);
    std::string text;
    for (long long number = 1; std::getline(stream, text); ++number) {
        std::istringstream line(text);
        std::string word;
        if (line >> word && word == keyword && !finite_corner(line)) {
            refuse(file,
                   fmt::format("has a corner in line {} that is not three finite numbers", number));
        }
    }
}

MeshKind stl_kind(const std::filesystem::path& file, std::uintmax_t size)
{
    Head head{};
    std::ifstream stream(file, std::ios::binary);
    stream.read(reinterpret_cast<char*>(head.data()), static_cast<std::streamsize>(head.size()));
    const std::string start(head.begin(), head.begin() + 5);
    const std::uint32_t count = little_endian(head);
    if (size >= stl_header && size == stl_header + stl_triangle * count) {
        if (count > most_triangles) {
            refuse(file, fmt::format("has {} triangles, at most {} are supported", count,
                                     most_triangles));
        }
        return MeshKind::stl_binary;
    }
    const bool text = std::all_of(
        head.begin(),
        head.begin() + std::min<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(size),
                                                static_cast<std::ptrdiff_t>(head.size())),
        [](unsigned char c) { return c >= ' ' || std::isspace(c) != 0; });
    if (start == "solid" && text) {
        check_corners(file, "vertex");
        return MeshKind::stl_text;
    }
    if (size < stl_header) {
        refuse(file, "is not an STL file");
    }
    refuse(file, fmt::format("is not an STL file, or truncated: as a binary file it would have {} "
                             "triangles and {} bytes, it has {}",
                             count, stl_header + stl_triangle * count, size));
}

} // namespace

MeshKind mesh_kind(const std::filesystem::path& file)
{
    std::error_code fault;
    if (!std::filesystem::exists(file, fault)) {
        refuse(file, "does not exist");
    }
    if (!std::filesystem::is_regular_file(file, fault) || !std::ifstream(file)) {
        refuse(file, "cannot be read");
    }
    const std::uintmax_t size = std::filesystem::file_size(file, fault);
    if (size == 0 || size > largest_file) {
        refuse(file, size == 0 ? "is empty" : "is larger than 2 GiB");
    }
    std::string ending = file.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (ending == ".obj") {
        check_corners(file, "v");
        check_faces(file);
        return MeshKind::obj;
    }
    if (ending != ".stl") {
        refuse(file, "has an unknown file type, expected a name that ends in .stl or .obj");
    }
    return stl_kind(file, size);
}

} // namespace hyoryu
