// SPDX-License-Identifier: MIT
// Reading of VTKHDF frames and their parts, with checks for damage.
#include "vtkhdf.hpp"

#include "hdf5.hpp"
#include "hyoryu/core/columns.hpp"
#include "hyoryu/core/error.hpp"
#include "hyoryu/io/results.hpp"
#include "packed_array.hpp"

#include <fmt/format.h>

#include <sstream>

namespace hyoryu {

namespace {

std::vector<float> points_of(hid_t root)
{
    Column column = get_column(root, "Points");
    auto* points = std::get_if<std::vector<float>>(&column.values);
    expect(points != nullptr && column.components == 3,
           "its points are not rows of three single-precision numbers");
    return std::move(*points);
}

std::size_t size_of(const Column& column)
{
    return std::visit([](const auto& values) { return values.size(); }, column.values);
}

/// Throws IoError if an array has not one row a point.
template <class Frame>
void expect_whole(const Frame& frame)
{
    for (const Column& column : frame.columns) {
        if (3 * size_of(column) !=
            frame.points.size() * static_cast<std::size_t>(column.components)) {
            throw IoError(
                fmt::format("its array `{}` does not have one row per point", column.name));
        }
    }
}

template <class Frame>
void get_data(hid_t file, hid_t root, Frame& frame)
{
    frame.points = points_of(root);
    const hdf5::Handle point_data = hdf5::open_group(root, "PointData");
    for (const std::string& name : hdf5::link_names(point_data)) {
        frame.columns.push_back(get_column(point_data, name));
    }
    expect_whole(frame);
    const hdf5::Handle meta = hdf5::open_group(file, "meta");
    frame.name = hdf5::text_attribute(meta, "name");
    frame.time = hdf5::number_attribute(meta, "time");
    frame.index = static_cast<std::int64_t>(hdf5::number_attribute(meta, "index"));
}

std::vector<std::int32_t> triangles_of(hid_t root, std::size_t points)
{
    const Column types = get_column(root, "Types");
    for (const std::uint8_t type : std::get<std::vector<std::uint8_t>>(types.values)) {
        expect(type == triangle_cell, "it contains cells that are not triangles");
    }
    const Column connectivity = get_column(root, "Connectivity");
    const auto& corners = std::get<std::vector<std::int64_t>>(connectivity.values);
    std::vector<std::int32_t> triangles(corners.size());
    for (std::size_t i = 0; i < corners.size(); ++i) {
        expect(corners[i] >= 0 && corners[i] < static_cast<std::int64_t>(points),
               "a triangle has a corner that is not a point");
        triangles[i] = static_cast<std::int32_t>(corners[i]);
    }
    expect(triangles.size() % 3 == 0, "its last triangle is incomplete");
    return triangles;
}

std::string damaged_frame(const std::filesystem::path& file, const std::string& why)
{
    return fmt::format("`{}` is not a frame of Hyoryu, or is damaged: {}", file.string(), why);
}

/// The list of parts in a frame; empty if the frame holds its arrays itself.
std::string parts_named_in(hid_t file)
{
    if (!hdf5::has_link(file, "meta")) {
        return {};
    }
    const hdf5::Handle meta = hdf5::open_group(file, "meta");
    return H5Aexists(meta, "parts") > 0 ? hdf5::text_attribute(meta, "parts") : std::string();
}

/// The cloud that a file belongs to, and its time and index.
struct Moment {
    std::string name;
    double time = 0;
    double index = 0;
    bool operator==(const Moment&) const = default;
};

Moment moment_of(hid_t file)
{
    const hdf5::Handle meta = hdf5::open_group(file, "meta");
    return {hdf5::text_attribute(meta, "name"), hdf5::number_attribute(meta, "time"),
            hdf5::number_attribute(meta, "index")};
}

/// How many points each part of a frame has; one number without parts.
std::vector<std::int64_t> points_of_parts(hid_t file)
{
    const hdf5::Handle root = hdf5::open_group(file, "VTKHDF");
    const Column column = get_column(root, "NumberOfPoints");
    const auto* counts = std::get_if<std::vector<std::int64_t>>(&column.values);
    expect(counts != nullptr, "its numbers of points are not whole numbers");
    return *counts;
}

/// A part as a line of the frame names it: its size, and whether it is of this frame.
std::filesystem::path checked_part(hid_t file, const std::filesystem::path& frame,
                                   const std::string& line, std::int64_t points)
{
    std::istringstream words(line);
    std::string name;
    std::uintmax_t bytes = 0;
    words >> name >> bytes;
    const std::filesystem::path part = frame.parent_path() / name;
    if (!words || std::filesystem::path(name).filename() != name) {
        throw IoError(fmt::format("it names the part `{}`", line));
    }
    std::error_code fault;
    const std::uintmax_t found = std::filesystem::file_size(part, fault);
    if (fault || found != bytes) {
        throw IoError(fmt::format("its part `{}` {}", part.string(),
                                  fault ? "is missing"
                                        : fmt::format("has {} bytes, expected {}", found, bytes)));
    }
    const hdf5::Handle open = hdf5::open_file(part);
    if (moment_of(open) != moment_of(file) || points_of_parts(open) != std::vector{points}) {
        throw IoError(fmt::format("its part `{}` belongs to another frame", part.string()));
    }
    return part;
}

std::vector<std::filesystem::path> checked_parts(hid_t file, const std::filesystem::path& frame)
{
    std::vector<std::filesystem::path> parts;
    std::istringstream lines(parts_named_in(file));
    const std::vector<std::int64_t> points = points_of_parts(file);
    for (std::string line; std::getline(lines, line);) {
        expect(parts.size() != points.size(), "it names more parts than it has");
        parts.push_back(checked_part(file, frame, line, points[parts.size()]));
    }
    expect(parts.size() == points.size() || (parts.empty() && points.size() == 1),
           "it does not name all of its parts");
    return parts;
}

/// Runs `read(file, root group)`; errors are reported with the name of the file.
template <class Read>
void read_vtkhdf(const std::filesystem::path& file, Read read)
{
    const hdf5::Session session;
    const hdf5::Handle open = hdf5::open_file(file);
    try {
        const hdf5::Handle root = hdf5::open_group(open, "VTKHDF");
        read(open, root);
    } catch (const std::exception& error) {
        throw IoError(damaged_frame(file, error.what()));
    }
}

/// Reads the arrays of a cloud from its parts. Through the virtual datasets HDF5 would return fill
/// values, without an error, where it cannot read a part.
void get_cloud(hid_t file, hid_t root, const std::filesystem::path& frame, Cloud& cloud)
{
    const std::vector<std::filesystem::path> parts = checked_parts(file, frame);
    if (parts.empty()) {
        get_data(file, root, cloud);
        return;
    }
    for (const std::filesystem::path& part : parts) {
        const hdf5::Handle open = hdf5::open_file(part);
        const hdf5::Handle own = hdf5::open_group(open, "VTKHDF");
        Cloud next;
        get_data(open, own, next);
        if (part == parts.front()) {
            cloud = std::move(next);
        } else {
            append_points(cloud, next);
        }
    }
}

} // namespace

std::vector<std::filesystem::path> files_of_frame(const std::filesystem::path& file)
{
    const hdf5::Handle open = hdf5::open_file(file);
    try {
        std::vector<std::filesystem::path> parts = checked_parts(open, file);
        return parts.empty() ? std::vector{file} : parts;
    } catch (const std::exception& error) {
        throw IoError(damaged_frame(file, error.what()));
    }
}

Cloud read_frame(const std::filesystem::path& file)
{
    Cloud cloud;
    read_vtkhdf(file, [&](hid_t open, hid_t root) { get_cloud(open, root, file, cloud); });
    return cloud;
}

Surface read_surface(const std::filesystem::path& file)
{
    Surface surface;
    read_vtkhdf(file, [&](hid_t open, hid_t root) {
        get_data(open, root, surface);
        surface.triangles = triangles_of(root, surface.points.size() / 3);
    });
    return surface;
}

} // namespace hyoryu
