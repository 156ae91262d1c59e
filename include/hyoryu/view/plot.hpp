// SPDX-License-Identifier: MIT
// Curves on axes, as a PNG.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hyoryu {

struct PlotCurve {
    enum class Style { line, dashed, points, marked, theory };
    std::string label; // in the legend; empty: not there
    std::vector<double> x, y;
    Style style = Style::line; // marked: a line with a point at each value; theory: black, no
                               // colour is used up
};

struct PlotPanel {
    enum class Axes {
        linear,
        logarithmic
    };                                    // both axes; the latter leaves out what is not positive
    std::string title, x_axis, y_axis;    // axes with their unit: "time [s]"
    std::vector<double> x_range, y_range; // lowest and highest; empty: those of the curves
    std::vector<PlotCurve> curves;
    Axes axes = Axes::linear;
};

struct Plot {
    std::string title;
    std::vector<PlotPanel> panels; // side by side
    int panel_width = 900;         // [pixels]
    int height = 640;
};

/// Draws without a screen and writes the PNG. Throws IoError if it cannot, also in a build without
/// VTK.
void draw(const Plot& plot, const std::filesystem::path& file);

} // namespace hyoryu
