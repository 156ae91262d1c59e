// SPDX-License-Identifier: MIT
// One frame as a VTKHDF 1.0 UnstructuredGrid: the oldest form that ParaView 5.10 and later opens.
#pragma once

#include "hyoryu/core/error.hpp"
#include "hyoryu/core/snapshot.hpp"

#include <cstdint>
#include <filesystem>
#include <vector>

namespace hyoryu {

/// Cell types of VTK.
inline constexpr std::uint8_t vertex_cell = 1;
inline constexpr std::uint8_t triangle_cell = 5;

/// Throws IoError with this text, which says what is wrong with a frame, unless `holds`.
inline void expect(bool holds, const char* what)
{
    if (!holds) {
        throw IoError(what);
    }
}

/// Writes a Cloud or a Surface whole (temporary name, then renamed). Throws IoError.
template <class Frame>
void write_vtkhdf(const std::filesystem::path& file, const Frame& frame);

/// Writes a file whose arrays are virtual datasets over those of its parts, which are on disk. HDF5
/// reads zeros where a part is missing: the file has the names and sizes of its parts, by which
/// `read_frame` notices. Throws IoError.
void write_vtkhdf(const std::filesystem::path& file, const CloudOfParts& cloud);

/// `fluid_000012.hdf` -> `fluid_000012.0003.hdf`
std::filesystem::path part_of_frame(const std::filesystem::path& file, int part);

/// The files with the arrays of a frame: its parts, or itself. Needs a Session. Throws IoError if a
/// part is missing or has another size.
std::vector<std::filesystem::path> files_of_frame(const std::filesystem::path& file);

} // namespace hyoryu
