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

namespace hyoryu {

namespace {

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

} // namespace

template <class Frame>
void write_vtkhdf(const std::filesystem::path& file, const Frame& frame)
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
template void write_vtkhdf(const std::filesystem::path&, const Cloud&);
template void write_vtkhdf(const std::filesystem::path&, const Surface&);

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

} // namespace hyoryu
