// SPDX-License-Identifier: MIT
// Pictures of small synthetic runs, and our frames as VTK's own reader sees them.
#ifdef HYORYU_HAS_VTK
#include "hyoryu/core/error.hpp"
#include "hyoryu/view/render.hpp"
#include "io/results_fixture.hpp"
#include "synthetic_results.hpp"

#include <gtest/gtest.h>

#include <vtkFieldData.h>
#include <vtkHDFReader.h>
#include <vtkIdList.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>

#include <array>
#include <cmath>

namespace hyoryu::test_render {
namespace {

namespace fs = std::filesystem;

class Render : public test_help::ResultsTest {
protected:
    static RenderSettings small()
    {
        RenderSettings settings;
        settings.width = 320;
        settings.height = 180;
        return settings;
    }

    /// Renders, or skips the test where no off-screen context is to be had.
    RenderResult rendered(const RenderSettings& settings)
    {
        try {
            return render(folder, settings);
        } catch (const IoError& error) {
            if (std::string(error.what()).find("xvfb-run") == std::string::npos) {
                throw;
            }
            no_context = error.what();
            return {};
        }
    }

    std::string no_context;
};

/// Share of the pixels between the labels above and below that have another colour than the sky,
/// whose red and blue lie close together and change with the height alone.
double covered(const fs::path& picture)
{
    vtkNew<vtkPNGReader> reader;
    reader->SetFileName(picture.c_str());
    reader->Update();
    vtkImageData& image = *reader->GetOutput();
    const std::array<int, 2> size{image.GetDimensions()[0], image.GetDimensions()[1]};
    const auto value = [&](int x, int y, int colour) {
        return image.GetScalarComponentAsDouble(x, y, 0, colour);
    };
    int count = 0;
    for (int y = size[1] / 5; y < size[1] * 9 / 10; ++y) {
        for (int x = 0; x < size[0]; ++x) {
            constexpr double dither = 6;
            count += std::abs(value(x, y, 0) - value(0, y, 0)) > dither ? 1 : 0;
        }
    }
    return static_cast<double>(count) / (size[0] * size[1]);
}

void expect_picture(const fs::path& file)
{
    EXPECT_GT(covered(file), 0.03) << file;
    EXPECT_LT(covered(file), 0.70) << file;
}

TEST_F(Render, MakesAPictureOfEveryFrame)
{
    test_help::write_flood(folder, 0.08, 3);
    const RenderResult result = rendered(small());
    if (!no_context.empty()) {
        GTEST_SKIP() << no_context;
    }
    ASSERT_EQ(result.pictures.size(), 3U);
    for (const fs::path& picture : result.pictures) {
        expect_picture(picture);
    }
    EXPECT_EQ(result.pictures[1], folder / "pictures/frame_000001.png");
    EXPECT_NE(result.animation.has_value(), !result.note.empty());
}

TEST_F(Render, MakesThePicturesAskedFor)
{
    test_help::write_flood(folder, 0.1, 4);
    test_help::put_text_into(folder / "pictures/frame_000009.png", "of an earlier call");
    RenderSettings settings = small();
    settings.times = {0.21};
    const RenderResult result = rendered(settings);
    if (!no_context.empty()) {
        GTEST_SKIP() << no_context;
    }
    ASSERT_EQ(result.pictures.size(), 1U);
    EXPECT_EQ(test_help::content_of(folder / "pictures"),
              std::vector<std::string>{"frame_000002.png"});
    EXPECT_FALSE(result.animation.has_value());
    EXPECT_FALSE(result.note.empty());
}

// A run of bodies alone has neither fluid nor wall particles.
TEST_F(Render, ShowsBodiesAlone)
{
    FrameWriter writer(folder);
    writer.write(test_help::make_timbers(0, 4));
    writer.finish();
    const RenderResult result = rendered(small());
    if (!no_context.empty()) {
        GTEST_SKIP() << no_context;
    }
    ASSERT_EQ(result.pictures.size(), 1U);
    expect_picture(result.pictures[0]);
}

// Mean column of what covers the sky, as a part of the width.
double middle_of(const fs::path& picture)
{
    vtkNew<vtkPNGReader> reader;
    reader->SetFileName(picture.c_str());
    reader->Update();
    vtkImageData& image = *reader->GetOutput();
    const int width = image.GetDimensions()[0];
    double sum = 0;
    double count = 0;
    for (int y = image.GetDimensions()[1] / 5; y < image.GetDimensions()[1] * 9 / 10; ++y) {
        for (int x = 0; x < width; ++x) {
            constexpr double dither = 6;
            const double off = image.GetScalarComponentAsDouble(x, y, 0, 0) -
                               image.GetScalarComponentAsDouble(0, y, 0, 0);
            sum += std::abs(off) > dither ? x : 0;
            count += std::abs(off) > dither ? 1 : 0;
        }
    }
    return sum / count / width;
}

// A timber that stays where it is, and a wall that goes from one side of it to the other.
TEST_F(Render, ShowsWallsWhereTheyAre)
{
    FrameWriter writer(folder);
    const auto wall_at = [](double x, std::int64_t index) {
        Surface wall{.name = "structures",
                     .time = 0.1 * static_cast<double>(index),
                     .index = index,
                     .points = {},
                     .triangles = {},
                     .columns = {}};
        std::vector<std::int32_t> owner;
        test_help::add_box(wall, owner, {x, 0.2, 0.5}, {0.3, 0.3, 0.4}, Mat3::Identity(), 0, false);
        wall.columns = {{"Wall", "", 1, owner}};
        return wall;
    };
    writer.write(wall_at(0, 0), FramePlace::alone);
    for (std::int64_t index = 0; index < 2; ++index) {
        Surface timber = test_help::make_timbers(0, 1);
        timber.time = 0.1 * static_cast<double>(index);
        timber.index = index;
        writer.write(timber);
        writer.write(wall_at(index == 0 ? 0.0 : 2.0, index));
    }
    writer.finish();
    const RenderResult result = rendered(small());
    if (!no_context.empty()) {
        GTEST_SKIP() << no_context;
    }
    ASSERT_EQ(result.pictures.size(), 2U);
    EXPECT_GT(std::abs(middle_of(result.pictures[1]) - middle_of(result.pictures[0])), 0.1);
}

TEST_F(Render, ShowsAPlaneCaseFromItsSide)
{
    Cloud timber{.name = "bodies", .time = 0, .index = 0, .points = {}, .columns = {}};
    for (const float x : {1.0F, 1.05F, 1.1F}) {
        timber.points.insert(timber.points.end(), {x, 0.0F, 0.8F});
    }
    FrameWriter writer(folder);
    writer.write(test_help::make_plane_water(0, 0.05));
    writer.write(timber);
    writer.finish();
    const RenderResult result = rendered(small());
    if (!no_context.empty()) {
        GTEST_SKIP() << no_context;
    }
    ASSERT_EQ(result.pictures.size(), 1U);
    expect_picture(result.pictures[0]);
}

// What VTK reads from a file; null if it does not read such files.
vtkUnstructuredGrid* grid_of(vtkHDFReader* reader, const std::filesystem::path& file)
{
    if (reader->CanReadFile(file.c_str()) != 1) {
        return nullptr;
    }
    reader->SetFileName(file.c_str());
    reader->Update();
    return vtkUnstructuredGrid::SafeDownCast(reader->GetOutput());
}

// The same reader as in ParaView 5.10: chunks of our own compressor, vertices, arrays, the time.
TEST_F(Render, FramesAreWhatVtkReads)
{
    constexpr std::size_t points = 70000; // more than one chunk
    FrameWriter writer(folder);
    writer.write(test_help::make_cloud("fluid", 4, points));
    writer.write(test_help::make_surface(4));
    writer.finish();
    vtkNew<vtkHDFReader> reader;
    auto* const cloud = grid_of(reader, folder / "frames/fluid_000004.hdf");
    ASSERT_NE(cloud, nullptr);
    ASSERT_EQ(cloud->GetNumberOfPoints(), static_cast<vtkIdType>(points));
    ASSERT_EQ(cloud->GetNumberOfCells(), static_cast<vtkIdType>(points));
    EXPECT_EQ(cloud->GetCellType(points - 1), VTK_VERTEX);
    EXPECT_DOUBLE_EQ(cloud->GetPoint(69999)[0], 70003.0);
    EXPECT_DOUBLE_EQ(cloud->GetPointData()->GetArray("Velocity")->GetComponent(69999, 2),
                     -140006.0);
    EXPECT_DOUBLE_EQ(cloud->GetPointData()->GetArray("Pressure")->GetComponent(1, 0), 0.5);
    EXPECT_EQ(cloud->GetPointData()->GetNumberOfArrays(), 5);
    EXPECT_DOUBLE_EQ(cloud->GetFieldData()->GetArray("TimeValue")->GetComponent(0, 0), 0.4);
    auto* const surface = grid_of(reader, folder / "frames/surfaces_000004.hdf");
    ASSERT_NE(surface, nullptr);
    EXPECT_EQ(surface->GetNumberOfCells(), 2);
    EXPECT_EQ(surface->GetCellType(1), VTK_TRIANGLE);
}

// Parts of different sizes, one of them empty; VTK reads the frame over them as any other.
TEST_F(Render, FramesInPartsAreWhatVtkReads)
{
    FrameWriter writer(folder);
    CloudOfParts whole{.name = "fluid", .time = 0.4, .index = 4, .points = {}, .columns = {}};
    double last = 0;
    for (const std::size_t points : {70000U, 0U, 3U, 500U}) {
        Cloud part = test_help::make_cloud("fluid", 4, points);
        whole.columns = test_help::make_cloud("fluid", 4, 0).columns;
        last = points > 0 ? part.points[3 * points - 3] : last;
        writer.write(std::move(part), FramePlace::series, static_cast<int>(whole.points.size()));
        whole.points.push_back(static_cast<std::int64_t>(points));
    }
    writer.write(whole);
    writer.finish();
    vtkNew<vtkHDFReader> reader;
    auto* const cloud = grid_of(reader, folder / "frames/fluid_000004.hdf");
    ASSERT_NE(cloud, nullptr);
    ASSERT_EQ(cloud->GetNumberOfPoints(), 70503);
    ASSERT_EQ(cloud->GetNumberOfCells(), 70503);
    for (const vtkIdType cell : {0, 69999, 70000, 70002, 70003, 70502}) {
        EXPECT_EQ(cloud->GetCellType(cell), VTK_VERTEX);
        vtkNew<vtkIdList> of_cell;
        cloud->GetCellPoints(cell, of_cell);
        ASSERT_EQ(of_cell->GetNumberOfIds(), 1);
        EXPECT_EQ(of_cell->GetId(0), cell);
    }
    EXPECT_DOUBLE_EQ(cloud->GetPoint(70502)[0], last);
    const Cloud read = read_frame(folder / "frames/fluid_000004.hdf");
    auto* velocity = cloud->GetPointData()->GetArray("Velocity");
    ASSERT_EQ(velocity->GetNumberOfTuples(), 70503);
    for (const Column& column : read.columns) {
        if (column.name == "Velocity") {
            const auto& values = std::get<std::vector<float>>(column.values);
            for (const vtkIdType row : {0, 69999, 70000, 70002, 70003, 70502}) {
                EXPECT_EQ(values.at(static_cast<std::size_t>(3 * row + 2)),
                          static_cast<float>(velocity->GetComponent(row, 2)));
            }
        }
    }
    EXPECT_DOUBLE_EQ(cloud->GetFieldData()->GetArray("TimeValue")->GetComponent(0, 0), 0.4);
    std::filesystem::resize_file(folder / "frames/fluid_000004.0003.hdf", 100);
    EXPECT_THROW(read_frame(folder / "frames/fluid_000004.hdf"), IoError);
}

TEST_F(Render, OfNothingIsAnError)
{
    EXPECT_THROW(render(folder, small()), CaseError);
    EXPECT_THROW(render(folder / "none", small()), CaseError);
}

} // namespace
} // namespace hyoryu::test_render
#else
#include "hyoryu/core/error.hpp"
#include "hyoryu/view/render.hpp"

#include <gtest/gtest.h>

TEST(Render, SaysThatItWasBuiltWithoutVtk)
{
    EXPECT_THROW(hyoryu::render("anything", {}), hyoryu::IoError);
}
#endif
