// SPDX-License-Identifier: MIT
// Frames in other formats: what is drawn at random comes back bit by bit from files that are read
// without the code that wrote them.
#include "hyoryu/core/error.hpp"
#include "hyoryu/io/convert.hpp"
#include "hyoryu/io/csv_table.hpp"
#include "io/hdf5.hpp"
#include "io/packed_array.hpp"

#include "dice.hpp"
#include "results_fixture.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <regex>

namespace hyoryu::test_convert {
namespace {

using test_help::text_of;

constexpr int runs_drawn = 25;

template <class T>
std::vector<T> random_numbers(Dice& dice, std::size_t count)
{
    std::vector<T> numbers(count);
    for (T& number : numbers) {
        if constexpr (std::is_floating_point_v<T>) {
            const double digits = dice.between(-1, 1);
            number = static_cast<T>(std::ldexp(digits, dice.below(60) - 30));
        } else if constexpr (sizeof(T) == 1) {
            number = static_cast<T>(dice.below(256));
        } else {
            number = static_cast<T>(dice.between(-2e9, 2e9));
        }
    }
    return numbers;
}

template <class T>
void add_column(std::vector<Column>& columns, Dice& dice, std::string name, std::string unit,
                int components, std::size_t rows)
{
    columns.push_back({std::move(name), std::move(unit), components,
                       random_numbers<T>(dice, rows * static_cast<std::size_t>(components))});
}

/// Arrays of every type, in the order of their names; some sets lack some of them.
Cloud random_cloud(Dice& dice, const std::string& name, std::int64_t index)
{
    const auto rows = static_cast<std::size_t>(dice.chance(0.1) ? 0 : dice.below(300));
    Cloud cloud{
        name, 0.1 * static_cast<double>(index), index, random_numbers<float>(dice, 3 * rows), {}};
    add_column<std::int32_t>(cloud.columns, dice, "Body", "", 1, rows);
    add_column<std::int64_t>(cloud.columns, dice, "Id", "", 1, rows);
    add_column<std::uint8_t>(cloud.columns, dice, "Kind", "", 1, rows);
    if (name != "walls") {
        add_column<double>(cloud.columns, dice, "Pressure <&", "Pa", 1, rows);
        add_column<float>(cloud.columns, dice, "Velocity", "m/s", 3, rows);
    }
    return cloud;
}

Surface random_surface(Dice& dice, std::int64_t index)
{
    const std::size_t points = 3 + static_cast<std::size_t>(dice.below(50));
    Surface surface{"surfaces", 0.1 * static_cast<double>(index),
                    index,      random_numbers<float>(dice, 3 * points),
                    {},         {}};
    for (int k = 3 * (1 + dice.below(40)); k > 0; --k) {
        surface.triangles.push_back(dice.below(static_cast<int>(points)));
    }
    add_column<std::int32_t>(surface.columns, dice, "Body", "", 1, points);
    return surface;
}

struct RandomRun {
    std::vector<Cloud> fluid;
    std::vector<Surface> surfaces;
    Cloud walls;
};

class Convert : public test_help::ResultsTest {
protected:
    RandomRun write_run(std::uint64_t seed) const
    {
        Dice dice(seed);
        RandomRun run;
        FrameWriter writer(folder);
        const int frames = 1 + dice.below(4);
        for (int k = 0; k < frames; ++k) {
            run.fluid.push_back(random_cloud(dice, "fluid", k));
            run.surfaces.push_back(random_surface(dice, k));
            writer.write(run.fluid.back());
            writer.write(run.surfaces.back());
        }
        run.walls = random_cloud(dice, "walls", 0);
        writer.write(run.walls, FramePlace::alone);
        writer.finish();
        return run;
    }

    FrameSet set_named(const std::string& name) const
    {
        for (const FrameSet& set : frame_sets(folder)) {
            if (set.name == name) {
                return set;
            }
        }
        throw std::runtime_error("no set " + name);
    }

    void empty_folder() const
    {
        std::filesystem::remove_all(folder);
        std::filesystem::create_directories(folder);
    }

    std::filesystem::path out() const
    {
        std::filesystem::create_directories(folder / "out");
        return folder / "out";
    }
};

/// The bytes of a run of base64, less the eight that tell their number.
std::vector<std::byte> decoded(const std::string& text)
{
    const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::vector<std::byte> bytes;
    unsigned bits = 0;
    int count = 0;
    for (const char letter : text) {
        const std::size_t value = letters.find(letter);
        if (value == std::string::npos) {
            continue;
        }
        bits = (bits << 6U) | static_cast<unsigned>(value);
        count += 6;
        if (count >= 8) {
            count -= 8;
            bytes.push_back(static_cast<std::byte>((bits >> count) & 255U));
        }
    }
    std::uint64_t size = 0;
    EXPECT_GE(bytes.size(), sizeof size);
    std::memcpy(&size, bytes.data(), sizeof size);
    bytes.erase(bytes.begin(), bytes.begin() + sizeof size);
    EXPECT_EQ(size, bytes.size());
    return bytes;
}

/// Type, components and bytes of the array of that name.
struct XmlArray {
    std::string type;
    int components = 0;
    std::vector<std::byte> bytes;
};

XmlArray array_in(const std::string& xml, const std::string& name)
{
    const std::size_t at = xml.find(" Name=\"" + name + "\" NumberOfComponents=");
    EXPECT_NE(at, std::string::npos) << name;
    const std::size_t head = xml.rfind("<DataArray", at);
    const std::size_t body = xml.find('>', at) + 1;
    const std::string tag = xml.substr(head, body - head);
    std::smatch found;
    EXPECT_TRUE(std::regex_search(
        tag, found, std::regex("type=\"(\\w+)\".*NumberOfComponents=\"(\\d+)\" format=\"binary\"")))
        << tag;
    return {found[1], std::stoi(found[2]),
            decoded(xml.substr(body, xml.find("</DataArray>", body) - body))};
}

template <class T>
std::vector<std::byte> bytes_of(const std::vector<T>& values)
{
    const auto bytes = std::as_bytes(std::span(values));
    return {bytes.begin(), bytes.end()};
}

const char* name_in_xml(const Column& column)
{
    return column.name == "Pressure <&" ? "Pressure &lt;&amp;" : column.name.c_str();
}

template <class Frame>
void expect_same_points(const std::string& xml, const Frame& frame)
{
    EXPECT_NE(xml.find(fmt::format("NumberOfPoints=\"{}\"", frame.points.size() / 3)),
              std::string::npos);
    EXPECT_EQ(array_in(xml, "Points").bytes, bytes_of(frame.points));
    constexpr std::array types{"Float32", "Float64", "Int32", "Int64", "UInt8"};
    for (const Column& column : frame.columns) {
        const XmlArray array = array_in(xml, name_in_xml(column));
        EXPECT_EQ(array.type, types[column.values.index()]) << column.name;
        EXPECT_EQ(array.components, column.components);
        EXPECT_EQ(array.bytes,
                  std::visit([](const auto& values) { return bytes_of(values); }, column.values))
            << column.name;
    }
}

TEST_F(Convert, VtpHoldsEveryBit)
{
    for (std::uint64_t seed = 1; seed <= runs_drawn; ++seed) {
        const RandomRun run = write_run(seed);
        EXPECT_EQ(export_vtp(folder, set_named("fluid"), out()), run.fluid.size());
        export_vtp(folder, set_named("surfaces"), out());
        export_vtp(folder, set_named("walls"), out());
        const std::string times = text_of(out() / "fluid.pvd");
        for (std::size_t k = 0; k < run.fluid.size(); ++k) {
            expect_same_points(text_of(out() / fmt::format("fluid_{:06}.vtp", k)), run.fluid[k]);
            const std::string xml = text_of(out() / fmt::format("surfaces_{:06}.vtp", k));
            expect_same_points(xml, run.surfaces[k]);
            const auto& corners = run.surfaces[k].triangles;
            const std::vector<std::int64_t> wide(corners.begin(), corners.end());
            EXPECT_EQ(array_in(xml, "connectivity").bytes, bytes_of(wide));
            EXPECT_NE(times.find(fmt::format("timestep=\"{}\" part=\"0\" file=\"fluid_{:06}.vtp\"",
                                             run.fluid[k].time, k)),
                      std::string::npos);
        }
        expect_same_points(text_of(out() / "walls_000000.vtp"), run.walls);
        empty_folder();
    }
}

/// The numbers of a column in the table, as numbers of the column's own type.
void expect_same_cells(const CsvTable& table, const Column& column)
{
    for (int c = 0; c < column.components; ++c) {
        const std::string axis(1, "xyz"[c]);
        const std::string name = column.name.empty()      ? axis
                                 : column.components == 1 ? column.name
                                                          : column.name + "_" + axis;
        const CsvTable::Column* cells = table.find(name);
        ASSERT_NE(cells, nullptr) << name;
        EXPECT_EQ(cells->unit, column.unit);
        std::visit(
            [&](const auto& values) {
                using T = typename std::decay_t<decltype(values)>::value_type;
                for (std::size_t k = 0; k < table.rows; ++k) {
                    const auto at = k * static_cast<std::size_t>(column.components) +
                                    static_cast<std::size_t>(c);
                    ASSERT_EQ(static_cast<T>(cells->numbers[k]), values[at]) << name << " " << k;
                }
            },
            column.values);
    }
}

TEST_F(Convert, CsvHoldsEveryNumber)
{
    for (std::uint64_t seed = 1; seed <= runs_drawn; ++seed) {
        const RandomRun run = write_run(seed);
        EXPECT_EQ(export_csv(folder, set_named("fluid"), out()), run.fluid.size());
        const CsvTable times = read_csv(out() / "fluid.csv");
        ASSERT_EQ(times.rows, run.fluid.size());
        for (std::size_t k = 0; k < run.fluid.size(); ++k) {
            EXPECT_EQ(times.find("time")->numbers[k], run.fluid[k].time);
            const CsvTable table = read_csv(out() / times.find("file")->texts[k]);
            ASSERT_EQ(table.rows, run.fluid[k].points.size() / 3);
            expect_same_cells(table, {"", "m", 3, run.fluid[k].points});
            for (const Column& column : run.fluid[k].columns) {
                expect_same_cells(table, column);
            }
        }
        empty_folder();
    }
}

/// What a set without the array has in its place.
template <class T>
T nothing()
{
    if constexpr (std::is_floating_point_v<T>) {
        return std::numeric_limits<T>::quiet_NaN();
    } else {
        return static_cast<T>(-1); // of a byte: 255
    }
}

template <class T>
void append(std::vector<T>& all, const std::vector<Column>& columns, const std::string& name,
            std::size_t rows, int components)
{
    for (const Column& column : columns) {
        if (column.name == name) {
            const auto& values = std::get<std::vector<T>>(column.values);
            all.insert(all.end(), values.begin(), values.end());
            return;
        }
    }
    all.insert(all.end(), rows * static_cast<std::size_t>(components), nothing<T>());
}

/// The array over all parts in their order: fluid, surfaces and, as they stand still, walls of each
/// step.
template <class T>
std::vector<T> expected_array(const RandomRun& run, const std::string& name, int components)
{
    std::vector<T> all;
    for (std::size_t k = 0; k < run.fluid.size(); ++k) {
        append(all, run.fluid[k].columns, name, run.fluid[k].points.size() / 3, components);
        append(all, run.surfaces[k].columns, name, run.surfaces[k].points.size() / 3, components);
        append(all, run.walls.columns, name, run.walls.points.size() / 3, components);
    }
    return all;
}

template <class T>
std::vector<T> read_array(hid_t group, const std::string& name)
{
    return std::get<std::vector<T>>(get_column(group, name).values);
}

/// What a reader of temporal grids does: the points and the corners of one part of one step.
struct PartOfStep {
    std::vector<float> points;
    std::vector<std::int64_t> corners;
};

PartOfStep part_of_step(hid_t root, std::size_t step, std::size_t part)
{
    const auto one = [&](const char* name, std::size_t at) {
        const hdf5::Handle group = hdf5::open_group(root, "Steps");
        return static_cast<std::size_t>(read_array<std::int64_t>(group, name).at(at));
    };
    const auto counts = [&](const char* name) { return read_array<std::int64_t>(root, name); };
    std::size_t point = one("PointOffsets", step);
    std::size_t corner = one("ConnectivityIdOffsets", step);
    const std::size_t first = one("PartOffsets", step);
    EXPECT_LT(part, one("NumberOfParts", step));
    for (std::size_t k = first; k < first + part; ++k) {
        point += static_cast<std::size_t>(counts("NumberOfPoints").at(k));
        corner += static_cast<std::size_t>(counts("NumberOfConnectivityIds").at(k));
    }
    const auto points = read_array<float>(root, "Points");
    const auto corners = read_array<std::int64_t>(root, "Connectivity");
    const auto cut = [](const auto& all, std::size_t at, std::size_t count) {
        const auto begin = all.begin() + static_cast<std::ptrdiff_t>(at);
        return std::decay_t<decltype(all)>(begin, begin + static_cast<std::ptrdiff_t>(count));
    };
    const auto n = static_cast<std::size_t>(counts("NumberOfPoints").at(first + part));
    const auto c = static_cast<std::size_t>(counts("NumberOfConnectivityIds").at(first + part));
    return {cut(points, 3 * point, 3 * n), cut(corners, corner, c)};
}

void expect_same_parts(hid_t root, const RandomRun& run)
{
    for (std::size_t k = 0; k < run.fluid.size(); ++k) {
        EXPECT_EQ(part_of_step(root, k, 0).points, run.fluid[k].points);
        EXPECT_EQ(part_of_step(root, k, 2).points, run.walls.points);
        const PartOfStep surface = part_of_step(root, k, 1);
        EXPECT_EQ(surface.points, run.surfaces[k].points);
        const auto& corners = run.surfaces[k].triangles;
        EXPECT_EQ(surface.corners, std::vector<std::int64_t>(corners.begin(), corners.end()));
    }
}

TEST_F(Convert, VtkhdfRefersToEveryFrame)
{
    for (std::uint64_t seed = 1; seed <= runs_drawn; ++seed) {
        const RandomRun run = write_run(seed);
        const std::filesystem::path file = out() / "100 %d.vtkhdf"; // a name that patterns know
        EXPECT_EQ(export_vtkhdf(folder, frame_sets(folder), file), run.fluid.size());
        EXPECT_TRUE(is_exported_vtkhdf(file));
        {
            const hdf5::Session session;
            const hdf5::Handle open = hdf5::open_file(file);
            const hdf5::Handle root = hdf5::open_group(open, "VTKHDF");
            expect_same_parts(root, run);
            const hdf5::Handle data = hdf5::open_group(root, "PointData");
            EXPECT_EQ(read_array<std::int64_t>(data, "Id"),
                      expected_array<std::int64_t>(run, "Id", 1));
            EXPECT_EQ(read_array<std::int32_t>(data, "Body"),
                      expected_array<std::int32_t>(run, "Body", 1));
            EXPECT_EQ(read_array<std::uint8_t>(data, "Kind"),
                      expected_array<std::uint8_t>(run, "Kind", 1));
            // NaN equals nothing, so bytes are compared.
            EXPECT_EQ(bytes_of(read_array<double>(data, "Pressure <&")),
                      bytes_of(expected_array<double>(run, "Pressure <&", 1)));
            EXPECT_EQ(bytes_of(read_array<float>(data, "Velocity")),
                      bytes_of(expected_array<float>(run, "Velocity", 3)));
            const hdf5::Handle steps = hdf5::open_group(root, "Steps");
            EXPECT_EQ(hdf5::number_attribute(steps, "NSteps"), run.fluid.size());
            EXPECT_EQ(read_array<double>(steps, "Values").back(), run.fluid.back().time);
        }
        EXPECT_FALSE(is_exported_vtkhdf(folder / "walls.hdf"));
        empty_folder();
    }
}

TEST_F(Convert, NamesOfOthersAreNotOurs)
{
    for (const char* name :
         {"fluid_000000.vtp", "fluid_1000000.vtp", "walls.pvd", "fluid.pvd.tmp"}) {
        EXPECT_TRUE(is_export_name(ExportFormat::vtp, name)) << name;
        EXPECT_FALSE(is_export_name(ExportFormat::csv, name)) << name;
    }
    for (const char* name : {"notes.vtp", "fluid_1.vtp", "Fluid_000000.vtp", "fluid_000000.vtp.bak",
                             "my.pvd", "fluid_000000.vtu", ".hyoryu-convert"}) {
        EXPECT_FALSE(is_export_name(ExportFormat::vtp, name)) << name;
    }
    EXPECT_TRUE(is_export_name(ExportFormat::csv, "bodies_000012.csv"));
    EXPECT_FALSE(is_export_name(ExportFormat::csv, "surfaces_000012.csv"));
    EXPECT_FALSE(is_export_name(ExportFormat::csv, "bodies_1.csv"));
}

TEST_F(Convert, FramesBeforeAFaultStay)
{
    Cloud cloud = test_help::make_cloud("fluid", 0, 10);
    {
        FrameWriter writer(folder);
        writer.write(cloud);
        cloud.index = 1;
        cloud.time = 1;
        writer.write(cloud);
        writer.finish();
    }
    test_help::put_text_into(folder / "frames" / "fluid_000001.hdf", "no HDF5");
    EXPECT_THROW(export_vtp(folder, set_named("fluid"), out()), IoError);
    EXPECT_EQ(test_help::content_of(out()), std::vector<std::string>{"fluid_000000.vtp"});
    EXPECT_THROW(export_vtkhdf(folder, frame_sets(folder), folder / "all.vtkhdf"), IoError);
    EXPECT_FALSE(std::filesystem::exists(folder / "all.vtkhdf"));
}

} // namespace
} // namespace hyoryu::test_convert
