// SPDX-License-Identifier: MIT
// VTKHDF 1.0 files: points, cells, point data, the time as field data, and our units beside them.
#include "vtkhdf.hpp"

#include "atomic_file.hpp"
#include "hdf5.hpp"
#include "hyoryu/core/error.hpp"
#include "hyoryu/io/results.hpp"
#include "packed_array.hpp"
#include "virtual_array.hpp"

#include <fmt/format.h>

#include <array>
#include <numeric>
#include <span>
#include <sstream>

namespace hyoryu {

namespace {

// Cell types of VTK.
constexpr std::uint8_t vertex_cell = 1;
constexpr std::uint8_t triangle_cell = 5;

/// Which points make which cell, as VTK stores it.
struct Cells {
    std::vector<std::int64_t> connectivity; // points of all cells, cell after cell
    std::vector<std::int64_t> offsets;      // where each cell begins in it, and the end
    std::vector<std::uint8_t> types;
};

/// `cells` cells of `corners` points each whose connectivity is given.
Cells cells_of(std::vector<std::int64_t> connectivity, std::int64_t corners, std::uint8_t type)
{
    Cells cells{std::move(connectivity), {}, {}};
    const std::size_t count = cells.connectivity.size() / static_cast<std::size_t>(corners);
    cells.offsets.resize(count + 1);
    for (std::size_t i = 0; i <= count; ++i) {
        cells.offsets[i] = static_cast<std::int64_t>(i) * corners;
    }
    cells.types.assign(count, type);
    return cells;
}

Cells cells_of(const Cloud& cloud)
{
    std::vector<std::int64_t> connectivity(cloud.points.size() / 3);
    std::iota(connectivity.begin(), connectivity.end(), 0);
    return cells_of(std::move(connectivity), 1, vertex_cell);
}

Cells cells_of(const Surface& surface)
{
    return cells_of({surface.triangles.begin(), surface.triangles.end()}, 3, triangle_cell);
}

/// The arrays of one frame, compressed: the work that needs no HDF5.
struct Parts {
    PackedArray points;
    PackedArray connectivity;
    PackedArray offsets;
    PackedArray types;
    std::vector<PackedArray> columns;
};

template <class T>
PackedArray packed_list(const std::vector<T>& values, int components = 1)
{
    return packed(view_of(std::span<const T>(values), components));
}

template <class Frame>
Parts parts_of(const Frame& frame, const Cells& cells)
{
    Parts parts{packed_list(frame.points, 3),
                packed_list(cells.connectivity),
                packed_list(cells.offsets),
                packed_list(cells.types),
                {}};
    for (const Column& column : frame.columns) {
        parts.columns.push_back(packed(view_of(column)));
        expects(parts.columns.back().view.dims[0] == parts.points.view.dims[0]);
    }
    return parts;
}

void put_count(hid_t group, const std::string& name, std::size_t count)
{
    const std::vector<std::int64_t> one_part{static_cast<std::int64_t>(count)};
    put_array(group, name, raw(view_of(std::span(one_part), 1)), "");
}

void put_grid(hid_t file, const Cells& cells, const Parts& parts)
{
    const hdf5::Handle root = hdf5::create_group(file, "VTKHDF");
    hdf5::put_attribute(root, "Version", std::array<std::int64_t, 2>{1, 0});
    hdf5::put_fixed_attribute(root, "Type", "UnstructuredGrid");
    put_count(root, "NumberOfPoints", parts.points.view.dims[0]);
    put_count(root, "NumberOfCells", cells.types.size());
    put_count(root, "NumberOfConnectivityIds", cells.connectivity.size());
    put_array(root, "Points", parts.points, "m");
    put_array(root, "Connectivity", parts.connectivity, "");
    put_array(root, "Offsets", parts.offsets, "");
    put_array(root, "Types", parts.types, "");
}

/// The time that VTK shows, and our own attributes.
template <class Frame>
void put_time(hid_t file, const Frame& frame)
{
    const hdf5::Handle root = hdf5::open_group(file, "VTKHDF");
    const hdf5::Handle field_data = hdf5::create_group(root, "FieldData");
    const std::vector<double> time{frame.time};
    put_array(field_data, "TimeValue", raw(view_of(std::span(time), 1)), "s");
    const hdf5::Handle meta = hdf5::create_group(file, "meta");
    hdf5::put_attribute(meta, "program", std::string("hyoryu"));
    hdf5::put_attribute(meta, "name", frame.name);
    hdf5::put_attribute(meta, "time", frame.time);
    hdf5::put_attribute(meta, "index", std::array<std::int64_t, 1>{frame.index});
}

/// Point data, the time, and our own attributes.
template <class Frame>
void put_data(hid_t file, const Frame& frame, const Parts& parts)
{
    {
        const hdf5::Handle root = hdf5::open_group(file, "VTKHDF");
        const hdf5::Handle point_data = hdf5::create_group(root, "PointData");
        for (std::size_t k = 0; k < frame.columns.size(); ++k) {
            put_array(point_data, frame.columns[k].name, parts.columns[k], frame.columns[k].unit);
        }
    }
    put_time(file, frame);
}

std::size_t stored_bytes(const Parts& parts)
{
    std::size_t total = stored_bytes(parts.points) + stored_bytes(parts.connectivity) +
                        stored_bytes(parts.offsets) + stored_bytes(parts.types);
    for (const PackedArray& column : parts.columns) {
        total += stored_bytes(column);
    }
    return total;
}

template <class Frame>
void write_frame(const std::filesystem::path& file, const Frame& frame)
{
    expects(frame.points.size() % 3 == 0);
    AtomicFile atomic(file); // first: a folder that cannot be written is known before the work
    const Cells cells = cells_of(frame);
    const Parts parts = parts_of(frame, cells);
    const hdf5::Session session;
    hdf5::FileImage image(stored_bytes(parts));
    put_grid(image, cells, parts);
    put_data(image, frame, parts);
    atomic.write(image.bytes());
    atomic.commit();
}

/// The parts of a cloud as the file names them: "NAME BYTES" on a line each.
std::string text_of_parts(const std::filesystem::path& file, std::size_t parts)
{
    std::string text;
    for (std::size_t k = 0; k < parts; ++k) {
        const std::filesystem::path part = part_of_frame(file, static_cast<int>(k));
        text += fmt::format("{} {}\n", part.filename().string(), std::filesystem::file_size(part));
    }
    return text;
}

/// An array over those of all parts; `more`: rows of each part beside one for each of its points.
void put_virtual(hid_t parent, const std::string& path, const ArrayShape& shape,
                 const std::filesystem::path& file, const std::vector<std::int64_t>& points,
                 std::int64_t more)
{
    const auto rows = [&](std::size_t k) { return static_cast<hsize_t>(points[k] + more); };
    hsize_t all = 0;
    for (std::size_t k = 0; k < points.size(); ++k) {
        all += rows(k);
    }
    VirtualArray array(shape, all);
    for (std::size_t k = 0; k < points.size(); ++k) {
        array.append(part_of_frame(file, static_cast<int>(k)).filename().string(),
                     "/VTKHDF/" + path, rows(k));
    }
    array.put(parent, path);
}

void put_virtual_grid(hid_t image, const std::filesystem::path& file, const CloudOfParts& cloud)
{
    const hdf5::Handle root = hdf5::create_group(image, "VTKHDF");
    hdf5::put_attribute(root, "Version", std::array<std::int64_t, 2>{1, 0});
    hdf5::put_fixed_attribute(root, "Type", "UnstructuredGrid");
    const std::vector<std::int64_t>& points = cloud.points;
    for (const char* const count : {"NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds"}) {
        put_array(root, count, raw(view_of(std::span(points), 1)), "");
    }
    const auto put = [&](const std::string& path, ArrayShape shape, std::int64_t more) {
        put_virtual(root, path, shape, file, points, more);
    };
    put("Points", {0, 3, ElementType::float32, "m"}, 0);
    put("Connectivity", {0, 0, ElementType::int64, ""}, 0);
    put("Offsets", {0, 0, ElementType::int64, ""}, 1);
    put("Types", {0, 0, ElementType::uint8, ""}, 0);
    hdf5::create_group(root, "PointData");
    for (const Column& column : cloud.columns) {
        const ArrayView view = view_of(column);
        const hsize_t components = view.dims.size() > 1 ? view.dims[1] : 0;
        put("PointData/" + column.name, {0, components, view.type, column.unit}, 0);
    }
}

std::vector<float> points_of(hid_t root)
{
    Column column = get_column(root, "Points");
    auto* points = std::get_if<std::vector<float>>(&column.values);
    if (points == nullptr || column.components != 3) {
        throw IoError("its points are not rows of three single-precision numbers");
    }
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
        if (type != triangle_cell) {
            throw IoError("it contains cells that are not triangles");
        }
    }
    const Column connectivity = get_column(root, "Connectivity");
    const auto& corners = std::get<std::vector<std::int64_t>>(connectivity.values);
    std::vector<std::int32_t> triangles(corners.size());
    for (std::size_t i = 0; i < corners.size(); ++i) {
        if (corners[i] < 0 || corners[i] >= static_cast<std::int64_t>(points)) {
            throw IoError("a triangle has a corner that is not a point");
        }
        triangles[i] = static_cast<std::int32_t>(corners[i]);
    }
    if (triangles.size() % 3 != 0) {
        throw IoError("its last triangle is incomplete");
    }
    return triangles;
}

/// What a frame says of its parts; empty if its arrays are its own.
std::string parts_named_in(hid_t file)
{
    if (!hdf5::has_link(file, "meta")) {
        return {};
    }
    const hdf5::Handle meta = hdf5::open_group(file, "meta");
    return H5Aexists(meta, "parts") > 0 ? hdf5::text_attribute(meta, "parts") : std::string();
}

std::filesystem::path checked_part(const std::filesystem::path& frame, const std::string& line)
{
    std::istringstream words(line);
    std::string name;
    std::uintmax_t bytes = 0;
    words >> name >> bytes;
    const std::filesystem::path part = frame.parent_path() / name;
    if (!words || std::filesystem::path(name).filename() != name) {
        throw IoError(fmt::format("`{}` is damaged: it names the part `{}`", frame.string(), line));
    }
    std::error_code fault;
    const std::uintmax_t found = std::filesystem::file_size(part, fault);
    if (fault || found != bytes) {
        throw IoError(fmt::format("the part `{}` of `{}` {}", part.string(), frame.string(),
                                  fault ? "is missing"
                                        : fmt::format("has {} bytes, expected {}", found, bytes)));
    }
    return part;
}

std::vector<std::filesystem::path> checked_parts(hid_t file, const std::filesystem::path& frame)
{
    std::vector<std::filesystem::path> parts;
    std::istringstream lines(parts_named_in(file));
    for (std::string line; std::getline(lines, line);) {
        parts.push_back(checked_part(frame, line));
    }
    return parts;
}

/// Runs `read(file, root group)`; errors are reported with the name of the file.
template <class Read>
void read_vtkhdf(const std::filesystem::path& file, Read read)
{
    const hdf5::Session session;
    const hdf5::Handle open = hdf5::open_file(file);
    checked_parts(open, file);
    try {
        const hdf5::Handle root = hdf5::open_group(open, "VTKHDF");
        read(open, root);
    } catch (const std::exception& error) {
        throw IoError(fmt::format("`{}` is not a frame of Hyoryu, or is damaged: {}", file.string(),
                                  error.what()));
    }
}

} // namespace

void write_vtkhdf(const std::filesystem::path& file, const Cloud& cloud)
{
    write_frame(file, cloud);
}

void write_vtkhdf(const std::filesystem::path& file, const Surface& surface)
{
    write_frame(file, surface);
}

void write_vtkhdf(const std::filesystem::path& file, const CloudOfParts& cloud)
{
    AtomicFile atomic(file);
    const std::string parts = text_of_parts(file, cloud.points.size());
    const hdf5::Session session;
    hdf5::FileImage image(0);
    put_virtual_grid(image, file, cloud);
    put_time(image, cloud);
    {
        const hdf5::Handle meta = hdf5::open_group(image, "meta");
        hdf5::put_attribute(meta, "parts", parts);
    }
    atomic.write(image.bytes());
    atomic.commit();
}

std::filesystem::path part_of_frame(const std::filesystem::path& file, int part)
{
    std::filesystem::path name = file;
    return name.replace_extension(fmt::format(".{:04}{}", part, file.extension().string()));
}

std::vector<std::filesystem::path> files_of_frame(const std::filesystem::path& file)
{
    const hdf5::Handle open = hdf5::open_file(file);
    std::vector<std::filesystem::path> parts = checked_parts(open, file);
    return parts.empty() ? std::vector{file} : parts;
}

Cloud read_frame(const std::filesystem::path& file)
{
    Cloud cloud;
    read_vtkhdf(file, [&](hid_t open, hid_t root) { get_data(open, root, cloud); });
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
