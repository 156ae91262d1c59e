// SPDX-License-Identifier: MIT
// Shuffle and deflate by libdeflate, and the HDF5 datasets around the chunks.
#include "packed_array.hpp"

#include "hyoryu/core/error.hpp"

#include <fmt/format.h>
#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>

namespace hyoryu {

hid_t hdf5_type(ElementType type)
{
    const std::array types{H5T_NATIVE_FLOAT, H5T_NATIVE_DOUBLE, H5T_NATIVE_INT32, H5T_NATIVE_INT64,
                           H5T_NATIVE_UINT8};
    return types[static_cast<std::size_t>(type)];
}

ElementType stored_type(hid_t dataset, const std::string& name)
{
    const hdf5::Handle type(H5Dget_type(dataset), H5Tclose, "read a dataset");
    const H5T_class_t kind = H5Tget_class(type);
    const std::size_t size = H5Tget_size(type);
    if (kind == H5T_FLOAT && (size == 4 || size == 8)) {
        return size == 4 ? ElementType::float32 : ElementType::float64;
    }
    if (kind == H5T_INTEGER && (size == 4 || size == 8)) {
        return size == 4 ? ElementType::int32 : ElementType::int64;
    }
    if (kind == H5T_INTEGER && size == 1) {
        return ElementType::uint8;
    }
    throw IoError(fmt::format("cannot read the array `{}`: its type is unknown", name));
}

namespace {

constexpr hsize_t rows_of_a_chunk = 65536;
constexpr std::size_t worth_compressing =
    65536;                       // bytes; below it the chunk index outweighs the gain
constexpr int deflate_level = 1; // higher levels gain 2 % for twice the time

struct Deflater {
    void operator()(libdeflate_compressor* c) const { libdeflate_free_compressor(c); }
};
using Compressor = std::unique_ptr<libdeflate_compressor, Deflater>;

std::size_t size_of(ElementType type)
{
    constexpr std::array<std::size_t, 5> sizes{4, 8, 4, 8, 1};
    return sizes[static_cast<std::size_t>(type)];
}

/// The types stand in the order of the alternatives.
static_assert(std::variant_size_v<Values> == 5);
template <class T>
ElementType element_type()
{
    return static_cast<ElementType>(Values(std::vector<T>{}).index());
}

/// HDF5's shuffle: first bytes of all elements, then second bytes... Neighbouring particles agree
/// in their leading bytes, which are then contiguous.
template <std::size_t Size>
void shuffle(std::span<const std::byte> in, std::span<std::byte> out)
{
    const std::size_t count = in.size() / Size;
    for (std::size_t byte = 0; byte < Size; ++byte) {
        std::byte* const plane = out.data() + byte * count;
        for (std::size_t i = 0; i < count; ++i) {
            plane[i] = in[i * Size + byte];
        }
    }
}

void shuffle(std::size_t size, std::span<const std::byte> in, std::span<std::byte> out)
{
    switch (size) {
    case 4:
        return shuffle<4>(in, out);
    case 8:
        return shuffle<8>(in, out);
    default:
        return shuffle<1>(in, out);
    }
}

Bytes deflated(libdeflate_compressor* compressor, const Bytes& in, Bytes& scratch)
{
    scratch.resize(libdeflate_zlib_compress_bound(compressor, in.size()));
    const std::size_t size =
        libdeflate_zlib_compress(compressor, in.data(), in.size(), scratch.data(), scratch.size());
    return {scratch.begin(), scratch.begin() + static_cast<std::ptrdiff_t>(size)};
}

hsize_t components_of(const ArrayView& view)
{
    return view.dims.size() > 1 ? view.dims[1] : 1;
}

hdf5::Handle creation_of(const PackedArray& array, const std::string& action)
{
    hdf5::Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, action);
    // Without the hour of writing, equal runs give equal files.
    hdf5::check(H5Pset_obj_track_times(creation, false), action);
    if (array.rows_per_chunk > 0) {
        std::vector<hsize_t> chunk = array.view.dims;
        chunk[0] = array.rows_per_chunk;
        hdf5::check(H5Pset_chunk(creation, static_cast<int>(chunk.size()), chunk.data()), action);
        hdf5::check(H5Pset_shuffle(creation), action);
        hdf5::check(H5Pset_deflate(creation, deflate_level), action);
    }
    return creation;
}

void write_chunks(hid_t dataset, const PackedArray& array, const std::string& action)
{
    for (std::size_t k = 0; k < array.chunks.size(); ++k) {
        const std::array<hsize_t, 2> offset{k * array.rows_per_chunk, 0};
        const Bytes& chunk = array.chunks[k];
        constexpr unsigned every_filter_applied = 0;
        hdf5::check(H5Dwrite_chunk(dataset, H5P_DEFAULT, every_filter_applied, offset.data(),
                                   chunk.size(), chunk.data()),
                    action);
    }
}

Values read_values(hid_t dataset, ElementType type, std::size_t count, const std::string& action)
{
    const std::array<Values, 5> of_each_type{
        std::vector<float>{}, std::vector<double>{}, std::vector<std::int32_t>{},
        std::vector<std::int64_t>{}, std::vector<std::uint8_t>{}};
    Values values = of_each_type[static_cast<std::size_t>(type)];
    std::visit(
        [&](auto& numbers) {
            numbers.resize(count);
            hdf5::check(
                H5Dread(dataset, hdf5_type(type), H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data()),
                action);
        },
        values);
    return values;
}

/// Throws IoError if the file does not hold as much as the dataset claims: memory would be taken
/// for numbers that are nowhere.
void expect_stored(hid_t dataset, std::size_t bytes, const std::string& action)
{
    const hdf5::Handle creation(H5Dget_create_plist(dataset), H5Pclose, action);
    constexpr std::size_t most_of_deflate = 1032; // largest expansion of one byte
    constexpr std::size_t a_chunk = std::size_t{8} << 20;
    if (H5Pget_layout(creation) != H5D_VIRTUAL && bytes > a_chunk &&
        bytes / most_of_deflate > H5Dget_storage_size(dataset)) {
        throw IoError(
            fmt::format("cannot {}: the file contains less data than it declares", action));
    }
}

} // namespace

template <class T>
ArrayView view_of(std::span<const T> values, int components)
{
    expects(components >= 1 && values.size() % static_cast<std::size_t>(components) == 0);
    const auto width = static_cast<hsize_t>(components);
    ArrayView view{element_type<T>(), {values.size() / width}, std::as_bytes(values)};
    if (components > 1) {
        view.dims.push_back(width);
    }
    return view;
}
template ArrayView view_of(std::span<const float>, int);
template ArrayView view_of(std::span<const double>, int);
template ArrayView view_of(std::span<const std::int32_t>, int);
template ArrayView view_of(std::span<const std::int64_t>, int);
template ArrayView view_of(std::span<const std::uint8_t>, int);

ArrayView view_of(const Column& column)
{
    return std::visit(
        [&](const auto& values) { return view_of(std::span(values), column.components); },
        column.values);
}

PackedArray raw(const ArrayView& view)
{
    return {view, 0, {}};
}

PackedArray packed(const ArrayView& view)
{
    if (view.bytes.size() < worth_compressing) {
        return raw(view);
    }
    PackedArray array{view, std::min(rows_of_a_chunk, view.dims[0]), {}};
    const std::size_t size = size_of(view.type);
    const std::size_t chunk_bytes = size * components_of(view) * array.rows_per_chunk;
    const Compressor compressor(libdeflate_alloc_compressor(deflate_level));
    Bytes shuffled(chunk_bytes);
    Bytes scratch;
    for (std::size_t begin = 0; begin < view.bytes.size(); begin += chunk_bytes) {
        std::span<const std::byte> part = view.bytes.subspan(begin);
        Bytes padded;
        if (part.size() < chunk_bytes) { // a stored chunk is always a whole one
            padded.assign(part.begin(), part.end());
            padded.resize(chunk_bytes);
            part = padded;
        }
        shuffle(size, part.first(chunk_bytes), shuffled);
        array.chunks.push_back(deflated(compressor.get(), shuffled, scratch));
    }
    return array;
}

std::size_t stored_bytes(const PackedArray& array)
{
    if (array.rows_per_chunk == 0) {
        return array.view.bytes.size();
    }
    std::size_t total = 0;
    for (const Bytes& chunk : array.chunks) {
        total += chunk.size();
    }
    return total;
}

hdf5::Handle put_array(hid_t parent, const std::string& name, const PackedArray& array,
                       const std::string& unit)
{
    const std::string action = fmt::format("write the array `{}`", name);
    const ArrayView& view = array.view;
    const hdf5::Handle space(
        H5Screate_simple(static_cast<int>(view.dims.size()), view.dims.data(), nullptr), H5Sclose,
        action);
    const hdf5::Handle creation = creation_of(array, action);
    hdf5::Handle dataset(H5Dcreate2(parent, name.c_str(), hdf5_type(view.type), space, H5P_DEFAULT,
                                    creation, H5P_DEFAULT),
                         H5Dclose, action);
    if (array.rows_per_chunk > 0) {
        write_chunks(dataset, array, action);
    } else if (!view.bytes.empty()) {
        hdf5::check(H5Dwrite(dataset, hdf5_type(view.type), H5S_ALL, H5S_ALL, H5P_DEFAULT,
                             view.bytes.data()),
                    action);
    }
    if (!unit.empty()) {
        hdf5::put_attribute(dataset, "unit", unit);
    }
    return dataset;
}

ArrayShape shape_of(hid_t group, const std::string& name)
{
    const std::string action = fmt::format("read the array `{}`", name);
    const hdf5::Handle dataset(H5Dopen2(group, name.c_str(), H5P_DEFAULT), H5Dclose, action);
    const hdf5::Handle space(H5Dget_space(dataset), H5Sclose, action);
    const int rank = H5Sget_simple_extent_ndims(space);
    if (rank < 1 || rank > 2) {
        throw IoError(fmt::format("cannot {}: it has {} dimensions", action, rank));
    }
    std::array<hsize_t, 2> dims{0, 0};
    H5Sget_simple_extent_dims(space, dims.data(), nullptr);
    if (rank == 2 && dims[1] == 0) {
        throw IoError(fmt::format("cannot {}: it declares {} x 0 numbers", action, dims[0]));
    }
    ArrayShape shape{dims[0], dims[1], stored_type(dataset, name), {}};
    if (H5Aexists(dataset, "unit") > 0) {
        shape.unit = hdf5::text_attribute(dataset, "unit");
    }
    return shape;
}

Column get_column(hid_t parent, const std::string& name)
{
    const ArrayShape shape = shape_of(parent, name);
    const std::string action = fmt::format("read the array `{}`", name);
    const hsize_t components = std::max<hsize_t>(1, shape.components);
    constexpr hsize_t most_rows = hsize_t{1} << 40;
    constexpr hsize_t most_components = 1 << 10;
    if (shape.rows > most_rows || components > most_components) {
        throw IoError(
            fmt::format("cannot {}: it declares {} x {} numbers", action, shape.rows, components));
    }
    const hdf5::Handle dataset(H5Dopen2(parent, name.c_str(), H5P_DEFAULT), H5Dclose, action);
    expect_stored(dataset, size_of(shape.type) * shape.rows * components, action);
    return {.name = name,
            .unit = shape.unit,
            .components = static_cast<int>(components),
            .values = read_values(dataset, shape.type, shape.rows * components, action)};
}

} // namespace hyoryu
