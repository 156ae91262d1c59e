// SPDX-License-Identifier: MIT
// The contents of a results folder for rendering: the times of its frames, their extent, and the
// range of the coloured quantity.
#pragma once

#include "hyoryu/core/snapshot.hpp"
#include "hyoryu/core/types.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hyoryu {

/// The files of one frame.
struct Moment {
    double time = 0;             // [s]
    std::string number;          // as in the names of the files: "000012"
    std::filesystem::path fluid; // empty if the run has none; likewise below
    std::filesystem::path bodies;
    std::filesystem::path surfaces;
    std::filesystem::path structures; // empty if no wall moves
};

/// All moments in the order of time, or those next to the `times` asked for. Throws IoError.
std::vector<Moment> moments_of(const std::filesystem::path& results,
                               const std::vector<double>& times);

using Box = Eigen::AlignedBox3d;

/// Settings shared by all pictures of a run, so that an animation neither jumps nor flickers.
struct Survey {
    Box bounds;            // of everything [m]
    Box inner;             // of moving objects [m]
    double spacing = 0;    // of the particles [m]
    double colour_min = 0; // range of the array that is shown in colour
    double colour_max = 1;
    std::string unit;    // of that array
    int time_digits = 2; // behind the point, so that neighbouring times differ
    bool flat = false;   // a 2-D case: everything in one x-z plane
};

/// Looks at some frames spread over all of them. `structures`, those of the start, may be empty.
Survey survey_of(const std::vector<Moment>& moments, const Surface& structures,
                 const std::string& colour);

/// One number a point: the column itself or, for vectors, their lengths; empty without the column.
std::vector<float> magnitudes(const Cloud& cloud, const std::string& column);
/// The values of a column of 32-bit integers; empty if there is none of this name.
std::vector<std::int32_t> indices_in(const std::vector<Column>& columns, const std::string& name);

} // namespace hyoryu
