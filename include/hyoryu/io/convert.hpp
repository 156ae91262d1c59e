// SPDX-License-Identifier: MIT
// Conversion of the frames of a results folder for other programs: VTK XML files, tables, and one
// temporal VTKHDF 2 file. The frames are not changed.
#pragma once

#include "hyoryu/io/results.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace hyoryu {

enum class ExportFormat { vtp, csv, vtkhdf };

/// One kind of frames of a results folder.
struct FrameSet {
    std::string name;                // "fluid", "bodies", "walls", "surfaces", "structures"
    bool has_triangles = false;      // a Surface, else a Cloud
    bool moves = true;               // false: one frame that holds at every time
    std::vector<SeriesEntry> frames; // files relative to the results folder, sorted by time
};

/// The frame sets of the folder, in the order of `FrameSet::name` above. Throws IoError if a series
/// file is damaged, names a file that no run wrote, or is missing though there are frames.
std::vector<FrameSet> frame_sets(const std::filesystem::path& results);

/// `000012` of `frames/fluid_000012.hdf`; `000000` of a fixed set.
std::string frame_number(const SeriesEntry& entry);

/// Writes every frame of the set as `FOLDER/NAME_000000.vtp` (PolyData with inline base64) and then
/// `FOLDER/NAME.pvd`, with their times. Returns the number of frames. Throws IoError; the
/// frames before the fault stay.
std::size_t export_vtp(const std::filesystem::path& results, const FrameSet& set,
                       const std::filesystem::path& folder);

/// Writes every frame of a set of clouds as the table `FOLDER/NAME_000000.csv`, one row a particle,
/// and then `FOLDER/NAME.csv` with the columns `time,file`. Returns the number of frames. Throws
/// IoError; the frames before the fault stay.
std::size_t export_csv(const std::filesystem::path& results, const FrameSet& set,
                       const std::filesystem::path& folder);

/// Writes one temporal VTKHDF 2.0 UnstructuredGrid that refers to the frames as virtual datasets:
/// each frame of each set is a part of its time step, fixed sets are a part of every step. An array
/// that a set lacks is NaN, -1 or 255 there. Returns the number of steps. Throws IoError, also if
/// an array of one name differs in type from set to set.
std::size_t export_vtkhdf(const std::filesystem::path& results, const std::vector<FrameSet>& sets,
                          const std::filesystem::path& file);

/// Whether `export_vtkhdf` wrote the file.
bool is_exported_vtkhdf(const std::filesystem::path& file);

/// Whether exports of that format use this file name in a folder, for finished or partial files.
bool is_export_name(ExportFormat format, const std::string& name);

} // namespace hyoryu
