// SPDX-License-Identifier: MIT
// Heights in lines and in GeoTIFF, written by hand: what is read is what was written.
#include "dice.hpp"
#include "hyoryu/core/error.hpp"
#include "hyoryu/geometry/height_grid.hpp"
#include "own_folder.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>

namespace hyoryu::test_grid_formats {
namespace {

namespace fs = std::filesystem;

class GridFormats : public testing::Test {
protected:
    HeightGrid read(const std::string& bytes, std::optional<double> substitute = {})
    {
        std::ofstream(file_, std::ios::binary) << bytes;
        return read_height_grid(file_, substitute);
    }
    std::string fault(const std::string& bytes)
    {
        try {
            read(bytes);
        } catch (const IoError& error) {
            return std::string(error.what()).substr(file_.string().size());
        }
        return "none";
    }

    OwnFolder folder_;
    fs::path file_ = folder_ / "heights.grid";
};

HeightGrid draw_grid(Dice& dice)
{
    HeightGrid grid;
    grid.columns = 2 + dice.below(30);
    grid.rows = 2 + dice.below(30);
    grid.first = {dice.between(3e5, 4e5), dice.between(4e6, 5e6)};
    grid.cell = {dice.between(0.5, 5), dice.between(0.5, 5)};
    for (Index k = 0; k < grid.columns * grid.rows; ++k) {
        grid.height.push_back(static_cast<float>(dice.between(-9, 9))); // TIFF below holds floats
    }
    return grid;
}

void expect_equal(const HeightGrid& found, const HeightGrid& grid)
{
    ASSERT_EQ(found.columns, grid.columns);
    ASSERT_EQ(found.rows, grid.rows);
    EXPECT_EQ(found.height, grid.height);
    for (std::size_t axis = 0; axis < 2; ++axis) {
        EXPECT_NEAR(found.first[axis], grid.first[axis], 1e-3); // millimetres in the file
        EXPECT_NEAR(found.cell[axis], grid.cell[axis], 1e-3);
    }
}

// One line a place, to the millimetre, in any order.
std::string lines_of(const HeightGrid& grid, Dice& dice, int dialect)
{
    std::vector<std::string> lines;
    const char* const between = dialect % 3 == 0 ? " " : dialect % 3 == 1 ? "," : ";\t";
    for (Index j = 0; j < grid.rows; ++j) {
        for (Index i = 0; i < grid.columns; ++i) {
            lines.push_back(fmt::format(
                "{:.3f}{}{:.3f}{}{}{}", grid.first[0] + static_cast<double>(i) * grid.cell[0],
                between, grid.first[1] + static_cast<double>(j) * grid.cell[1], between,
                grid.height[static_cast<std::size_t>(j * grid.columns + i)],
                dialect % 2 == 0 ? "\n" : "\r\n"));
        }
    }
    for (std::size_t k = lines.size(); dialect % 4 > 1 && k > 1; --k) {
        std::swap(lines[k - 1], lines[static_cast<std::size_t>(dice.below(static_cast<int>(k)))]);
    }
    return (dialect % 5 == 0 ? "# a survey\nX,Y,Z\n" : "") +
           fmt::format("{}", fmt::join(lines, ""));
}

TEST_F(GridFormats, LinesOnAGridAreReadInAnyOrder)
{
    Dice dice(41);
    for (int k = 0; k < 40; ++k) {
        const HeightGrid grid = draw_grid(dice);
        expect_equal(read(lines_of(grid, dice, k)), grid);
    }
}

TEST_F(GridFormats, PlacesWithoutALineAreMissing)
{
    const std::string text = "0 0 1\n1 0 2\n2 0 -9999\n0 1 4\n2 1 6\n0 2 nan\n1 2 8\n2 2 9\n";
    const HeightGrid grid = read(text);
    ASSERT_EQ(grid.height.size(), 9u);
    for (const std::size_t missing : {2u, 4u, 6u}) {
        EXPECT_TRUE(std::isnan(grid.height[missing])) << missing;
    }
    EXPECT_EQ(read(text, -3.0).height, (std::vector<double>{1, 2, -3, 4, -3, 6, -3, 8, 9}));
}

TEST_F(GridFormats, LinesThatAreNoGridAreRefusedWithTheirPlace)
{
    Dice dice(42);
    std::string scattered;
    for (int k = 0; k < 200; ++k) {
        const std::array place{dice.between(0, 100), dice.between(0, 100)};
        scattered += fmt::format("{} {} 1\n", place[0], place[1]);
    }
    EXPECT_NE(fault(scattered).find("are scattered, expected a regular grid"), std::string::npos);
    EXPECT_NE(fault(scattered).find("gdal_grid"), std::string::npos);
    EXPECT_NE(fault("0 0 1\n1 0 1\n0 1 1\n1 1 1\n0.4 0 1\n").find("scattered"), std::string::npos);
    EXPECT_EQ(fault("0 0 1\n1 0 x\n"),
              ":2: expected three numbers: easting, northing and height in m");
    EXPECT_EQ(fault("0 0 1\n1 0 1 5\n"),
              ":2: expected three numbers: easting, northing and height in m");
    EXPECT_EQ(fault("0 0 1\n1 inf 1\n"),
              ":2: expected three numbers: easting, northing and height in m");
    EXPECT_EQ(fault("0 0 1\n1 0 1\n0 1 1\n1 1 1\n1 0 2\n"), ":5: the point (1, 0) is given twice");
    EXPECT_EQ(fault("0 0 1\n1 0 1\n2 0 1\n"), ":3: the points lie on one line, expected a grid");
    EXPECT_NE(
        fault("x y z\n140.001 38.001 1\n140.002 38.001 1\n140.001 38.002 1\n140.002 38.002 1\n")
            .find("in degrees"),
        std::string::npos);
    EXPECT_EQ(
        fault("x,y,z\n"),
        ":1: no point follows the header, expected lines of easting, northing and height in m");
}

// A TIFF 6.0 file of one strip of floats with the tags of GeoTIFF 1.1, little-endian.
struct Tiff {
    std::string bytes = std::string("II*\0\0\0\0\0", 8);
    std::vector<std::string> entries;

    static std::string raw(const auto& value)
    {
        std::string text(sizeof value, '\0');
        std::memcpy(text.data(), &value, sizeof value);
        return text;
    }
    void tag(int number, int type, std::size_t count, std::string data)
    {
        if (data.size() > 4) {
            const auto offset = static_cast<std::uint32_t>(bytes.size());
            bytes += data;
            data = raw(offset);
        }
        data.resize(4, '\0');
        entries.push_back(raw(static_cast<std::uint16_t>(number)) +
                          raw(static_cast<std::uint16_t>(type)) +
                          raw(static_cast<std::uint32_t>(count)) + data);
    }
    void whole(int number, std::uint32_t value) { tag(number, 4, 1, raw(value)); }
    void reals(int number, const std::vector<double>& values)
    {
        std::string data;
        for (const double value : values) {
            data += raw(value);
        }
        tag(number, 12, values.size(), data);
    }
    std::string finished()
    {
        const auto offset = static_cast<std::uint32_t>(bytes.size());
        std::memcpy(bytes.data() + 4, &offset, 4);
        bytes += raw(static_cast<std::uint16_t>(entries.size()));
        for (const std::string& entry : entries) {
            bytes += entry;
        }
        return bytes + std::string(4, '\0');
    }
};

// `map`: 1 projected, 2 geographic, 0 without keys.
std::string tiff_of(const HeightGrid& grid, int map, bool placed = true, std::uint32_t bands = 1)
{
    Tiff tiff;
    const auto strip = static_cast<std::uint32_t>(tiff.bytes.size());
    for (Index j = grid.rows - 1; j >= 0; --j) {
        for (Index i = 0; i < grid.columns; ++i) {
            const double z = grid.height[static_cast<std::size_t>(j * grid.columns + i)];
            for (std::uint32_t b = 0; b < bands; ++b) {
                tiff.bytes += Tiff::raw(static_cast<float>(std::isnan(z) ? -9999 : z));
            }
        }
    }
    const auto size = static_cast<std::uint32_t>(tiff.bytes.size()) - strip;
    tiff.whole(256, static_cast<std::uint32_t>(grid.columns));
    tiff.whole(257, static_cast<std::uint32_t>(grid.rows));
    tiff.tag(258, 3, 1, Tiff::raw(std::uint16_t{32}));
    tiff.whole(259, 1);
    tiff.whole(262, 1);
    tiff.whole(273, strip);
    tiff.whole(277, bands);
    tiff.whole(278, static_cast<std::uint32_t>(grid.rows));
    tiff.whole(279, size);
    tiff.tag(339, 3, 1, Tiff::raw(std::uint16_t{3}));
    if (placed) {
        tiff.reals(33550, {grid.cell[0], grid.cell[1], 0});
        const double north = grid.first[1] + (static_cast<double>(grid.rows) - 0.5) * grid.cell[1];
        tiff.reals(33922, {0, 0, 0, grid.first[0] - grid.cell[0] / 2, north, 0});
    }
    if (map > 0) { // GTModelType; the code of the map: UTM zone 54 N, or WGS 84
        std::string keys;
        for (const int key :
             {1, 1, 0, 2, 1024, 0, 1, map, map == 1 ? 3072 : 2048, 0, 1, map == 1 ? 32654 : 4326}) {
            keys += Tiff::raw(static_cast<std::uint16_t>(key));
        }
        tiff.tag(34735, 3, keys.size() / 2, keys);
    }
    tiff.tag(42113, 2, 6, std::string("-9999\0", 6));
    return tiff.finished();
}

#ifdef HYORYU_HAS_GDAL
TEST_F(GridFormats, GeoTiffIsReadAsItWasWritten)
{
    Dice dice(43);
    for (int k = 0; k < 20; ++k) {
        HeightGrid grid = draw_grid(dice);
        expect_equal(read(tiff_of(grid, k % 2)), grid);
        grid.height[0] = std::nan("");
        EXPECT_TRUE(std::isnan(read(tiff_of(grid, 1)).height[0]));
        EXPECT_EQ(read(tiff_of(grid, 1), 7.0).height[0], 7.0);
    }
}

TEST_F(GridFormats, RastersThatAreNoGroundAreRefused)
{
    Dice dice(44);
    HeightGrid grid = draw_grid(dice);
    EXPECT_NE(fault(tiff_of(grid, 0, false)).find("not georeferenced"), std::string::npos);
    EXPECT_NE(fault(tiff_of(grid, 1, true, 2)).find("it has 2 bands"), std::string::npos);
    EXPECT_NE(fault(tiff_of(grid, 1).substr(0, 60)).find("GDAL cannot read it"), std::string::npos);
    grid.first = {140.5, 38.2};
    grid.cell = {0.0001, 0.0001};
    EXPECT_NE(fault(tiff_of(grid, 2)).find("in degrees"), std::string::npos);
    EXPECT_NE(fault(tiff_of(grid, 0)).find("in degrees"), std::string::npos);
    EXPECT_NE(fault(std::string("PK\0\0 not a picture", 18)).find("GDAL cannot read it"),
              std::string::npos);
}
#else
TEST_F(GridFormats, WithoutGdalTheWayToAGridIsTold)
{
    Dice dice(45);
    EXPECT_NE(fault(tiff_of(draw_grid(dice), 1)).find("gdal_translate -of AAIGrid"),
              std::string::npos);
}
#endif

} // namespace
} // namespace hyoryu::test_grid_formats
