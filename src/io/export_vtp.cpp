// SPDX-License-Identifier: MIT
// Frames as VTK's XML PolyData. The bytes are inline base64: the form that every reader of
// VTK 6 and later takes, also with the XML parsers that fail on appended data (VTK issue 19258).
#include "atomic_file.hpp"
#include "hyoryu/core/name.hpp"
#include "hyoryu/io/convert.hpp"
#include "packed_array.hpp"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <span>

namespace hyoryu {

namespace {

namespace fs = std::filesystem;

// The numbers are declared in the byte order of this machine.
static_assert(std::endian::native == std::endian::little);

std::string base64(std::span<const std::byte> bytes)
{
    constexpr std::string_view letters =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t k = 0; k < bytes.size(); k += 3) {
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - k);
        std::uint32_t group = 0;
        for (std::size_t j = 0; j < 3; ++j) {
            const auto byte = j < count ? std::to_integer<std::uint32_t>(bytes[k + j]) : 0U;
            group = (group << 8U) | byte;
        }
        for (std::size_t j = 0; j < 4; ++j) {
            text += j <= count ? letters[(group >> (18U - 6U * j)) & 63U] : '=';
        }
    }
    return text;
}

/// The number of bytes and then the bytes, as one run of base64.
std::string inline_binary(std::span<const std::byte> bytes)
{
    const std::uint64_t size = bytes.size();
    Bytes all(sizeof size + bytes.size());
    std::memcpy(all.data(), &size, sizeof size);
    std::ranges::copy(bytes, all.begin() + sizeof size);
    return base64(all);
}

std::string xml_text(std::string_view text)
{
    return replaced(text, {{'&', "&amp;"}, {'<', "&lt;"}, {'"', "&quot;"}});
}

const char* vtk_type(ElementType type)
{
    constexpr std::array names{"Float32", "Float64", "Int32", "Int64", "UInt8"};
    return names[static_cast<std::size_t>(type)];
}

void write_array(AtomicFile& file, std::string_view name, const ArrayView& view)
{
    file.write(fmt::format("<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" "
                           "format=\"binary\">\n{}\n</DataArray>\n",
                           vtk_type(view.type), xml_text(name),
                           view.dims.size() > 1 ? view.dims[1] : 1, inline_binary(view.bytes)));
}

template <class T>
void write_array(AtomicFile& file, std::string_view name, const std::vector<T>& values,
                 int components = 1)
{
    write_array(file, name, view_of(std::span<const T>(values), components));
}

/// Cells of `corners` points each.
void write_cells(AtomicFile& file, const char* kind, const std::vector<std::int64_t>& connectivity,
                 std::size_t corners)
{
    std::vector<std::int64_t> ends(connectivity.size() / corners);
    for (std::size_t k = 0; k < ends.size(); ++k) {
        ends[k] = static_cast<std::int64_t>((k + 1) * corners);
    }
    file.write(fmt::format("<{}>\n", kind));
    write_array(file, "connectivity", connectivity);
    write_array(file, "offsets", ends);
    file.write(fmt::format("</{}>\n", kind));
}

void write_cells(AtomicFile& file, const Cloud& cloud)
{
    std::vector<std::int64_t> points(cloud.points.size() / 3);
    std::iota(points.begin(), points.end(), 0);
    write_cells(file, "Verts", points, 1);
}

void write_cells(AtomicFile& file, const Surface& surface)
{
    write_cells(file, "Polys", {surface.triangles.begin(), surface.triangles.end()}, 3);
}

std::string counts_of(const Cloud& cloud)
{
    const std::size_t points = cloud.points.size() / 3;
    return fmt::format("NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfPolys=\"0\"", points,
                       points);
}

std::string counts_of(const Surface& surface)
{
    return fmt::format("NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfPolys=\"{}\"",
                       surface.points.size() / 3, surface.triangles.size() / 3);
}

template <class Frame>
void write_polydata(const fs::path& name, const Frame& frame, double time)
{
    AtomicFile file(name);
    file.write("<?xml version=\"1.0\"?>\n"
               "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
               "header_type=\"UInt64\">\n<PolyData>\n");
    file.write(fmt::format("<FieldData>\n<DataArray type=\"Float64\" Name=\"TimeValue\" "
                           "NumberOfTuples=\"1\" format=\"ascii\">{}</DataArray>\n</FieldData>\n",
                           time));
    file.write(fmt::format("<Piece {} NumberOfLines=\"0\" NumberOfStrips=\"0\">\n<Points>\n",
                           counts_of(frame)));
    write_array(file, "Points", frame.points, 3);
    file.write("</Points>\n");
    write_cells(file, frame);
    file.write("<PointData>\n");
    for (const Column& column : frame.columns) {
        write_array(file, column.name, view_of(column));
    }
    file.write("</PointData>\n</Piece>\n</PolyData>\n</VTKFile>\n");
    file.commit();
}

} // namespace

std::size_t export_vtp(const fs::path& results, const FrameSet& set, const fs::path& folder)
{
    std::string entries;
    for (const SeriesEntry& entry : set.frames) {
        const std::string name = fmt::format("{}_{}.vtp", set.name, frame_number(entry));
        if (set.has_triangles) {
            write_polydata(folder / name, read_surface(results / entry.file), entry.time);
        } else {
            write_polydata(folder / name, read_frame(results / entry.file), entry.time);
        }
        entries +=
            fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", entry.time, name);
    }
    write_text(folder / (set.name + ".pvd"),
               fmt::format("<?xml version=\"1.0\"?>\n"
                           "<VTKFile type=\"Collection\" version=\"1.0\" "
                           "byte_order=\"LittleEndian\">\n<Collection>\n{}</Collection>\n"
                           "</VTKFile>\n",
                           entries));
    return set.frames.size();
}

} // namespace hyoryu
