// SPDX-License-Identifier: MIT
// Plots: curves appear where they belong, in the colours promised.
#ifdef HYORYU_HAS_VTK
#include "hyoryu/core/error.hpp"
#include "hyoryu/view/plot.hpp"
#include "io/results_fixture.hpp"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>
#include <vtkSmartPointer.h>

namespace hyoryu {
namespace {

class Plots : public testing::ResultsTest {
protected:
    /// Draws, or returns false where no off-screen context is to be had.
    bool drawn(const Plot& plot) const
    {
        try {
            draw(plot, folder / "plot.png");
        } catch (const IoError& error) {
            if (std::string(error.what()).find("xvfb-run") == std::string::npos) {
                throw;
            }
            return false;
        }
        return true;
    }

    vtkSmartPointer<vtkImageData> picture() const
    {
        vtkNew<vtkPNGReader> reader;
        reader->SetFileName((folder / "plot.png").c_str());
        reader->Update();
        return reader->GetOutput();
    }
};

/// Pixels of a column of the picture that have the colour, up to the blending of edges.
int pixels(vtkImageData& image, int x, int red, int green, int blue)
{
    constexpr double blended = 40;
    int count = 0;
    for (int y = 0; y < image.GetDimensions()[1]; ++y) {
        const auto differs = [&](int component, int value) {
            return std::abs(image.GetScalarComponentAsDouble(x, y, 0, component) - value) > blended;
        };
        count += differs(0, red) || differs(1, green) || differs(2, blue) ? 0 : 1;
    }
    return count;
}

TEST_F(Plots, ShowTheCurvesOfEachPanelInBlueOnWhite)
{
    PlotPanel level{.title = "",
                    .x_axis = "time [s]",
                    .y_axis = "height [m]",
                    .x_range = {0, 1},
                    .y_range = {0, 1},
                    .curves = {}};
    level.curves.push_back({.label = "", .x = {0, 1}, .y = {0.3, 0.3}});
    Plot plot{.title = "two panels", .panels = {level, level}, .panel_width = 400, .height = 300};
    plot.panels[1].curves[0].y = {5, 5}; // above the range: not to be seen
    if (!drawn(plot)) {
        GTEST_SKIP() << "no off-screen context";
    }
    const auto image = picture();
    ASSERT_EQ(image->GetDimensions()[0], 800);
    ASSERT_EQ(image->GetDimensions()[1], 300);
    EXPECT_GE(pixels(*image, 250, 0, 114, 178), 1);
    EXPECT_LE(pixels(*image, 250, 0, 114, 178), 5);
    EXPECT_EQ(pixels(*image, 650, 0, 114, 178), 0);
    EXPECT_GT(pixels(*image, 650, 255, 255, 255), 200);
}

TEST_F(Plots, LogarithmicAxesShowCurvesAndLonePoints)
{
    PlotPanel panel{.title = "",
                    .x_axis = "step [s]",
                    .y_axis = "error",
                    .x_range = {1, 100},
                    .y_range = {1, 1000},
                    .curves = {}};
    panel.axes = PlotPanel::Axes::logarithmic;
    // Through the middle of the decades, and a point that has no logarithm on the way.
    panel.curves.push_back({.label = "", .x = {1, 0, 100}, .y = {30, 30, 30}});
    const Plot plot{.title = "", .panels = {panel, panel}, .panel_width = 400, .height = 300};
    Plot lone = plot;
    lone.panels[1].curves[0] = {
        .label = "", .x = {10}, .y = {30}, .style = PlotCurve::Style::marked};
    if (!drawn(lone)) {
        GTEST_SKIP() << "no off-screen context";
    }
    const auto image = picture();
    EXPECT_GE(pixels(*image, 250, 0, 114, 178), 1) << "the line is not there";
    EXPECT_LE(pixels(*image, 250, 0, 114, 178), 5);
    int of_the_point = 0;
    for (int x = 400; x < 800; ++x) {
        of_the_point += pixels(*image, x, 0, 114, 178);
    }
    EXPECT_GE(of_the_point, 9) << "the point is not there";
    EXPECT_LE(of_the_point, 100);
}

} // namespace
} // namespace hyoryu
#endif
