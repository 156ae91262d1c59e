// SPDX-License-Identifier: MIT
// Series of levels and velocities of the water in files that a case names.
#pragma once

#include "hyoryu/scene/open_settings.hpp"

#include <filesystem>

namespace hyoryu {

/// csv: a table of time and level, velocity or discharge. geoclaw: a gauge of GeoClaw, with the
/// columns refinement level, time, h, hu, hv and eta.
enum class SeriesFormat { csv, geoclaw };

/// How a file becomes a series of the scene.
struct SeriesSource {
    std::filesystem::path file;
    SeriesFormat format = SeriesFormat::csv;
    std::vector<std::string> columns; // quantity of each column of a CSV file, "-": none
    double azimuth = 0;               // of the direction into the domain, from north [rad]
    double datum = 0;                 // z of level 0 of the file [m]
    double time_offset = 0;           // time of the file at time 0 of the scene [s]
    double scale = 1;                 // of levels above the datum and of velocities [1]
};

/// The series of a file; mistakes are added to `faults` as "FILE:LINE: what is wrong".
OpenSeries read_series(const SeriesSource& source, std::vector<std::string>& faults);

} // namespace hyoryu
