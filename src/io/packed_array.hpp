// SPDX-License-Identifier: MIT
// Arrays on their way into and out of HDF5: shuffled and deflated outside of the HDF5 lock, with a
// faster compressor than HDF5's own, to bytes that every HDF5 reads.
#pragma once

#include "hdf5.hpp"
#include "hyoryu/core/snapshot.hpp"
#include "hyoryu/core/types.hpp"

#include <cstddef>
#include <hdf5.h>
#include <span>
#include <string>
#include <vector>

namespace hyoryu {

using Bytes = std::vector<std::byte>;
using Values = decltype(Column::values);

enum class ElementType { float32, float64, int32, int64, uint8 };

/// The type in HDF5's memory.
hid_t hdf5_type(ElementType type);
/// Which of our element types the dataset `name` holds. Throws IoError if it is none of them.
ElementType stored_type(hid_t dataset, const std::string& name);

/// The properties of an array of a file.
struct ArrayShape {
    hsize_t rows = 0;
    hsize_t components = 0; // 0: the array has one dimension
    ElementType type = ElementType::float32;
    std::string unit;
};
/// Those of the dataset `name` of a group. Needs a Session. Throws IoError if it is missing, or is
/// no array of one or two dimensions of one of the element types.
ArrayShape shape_of(hid_t group, const std::string& name);

/// Rows of numbers that live elsewhere.
struct ArrayView {
    ElementType type = ElementType::float32;
    std::vector<hsize_t> dims; // rows, or rows and components
    std::span<const std::byte> bytes;
};

ArrayView view_of(const Column& column);
/// A plain array as rows of `components`; one component makes it one-dimensional.
template <class T>
ArrayView view_of(std::span<const T> values, int components);

/// An array ready to be stored: either one raw block or compressed chunks of `rows_per_chunk` rows.
struct PackedArray {
    ArrayView view;
    hsize_t rows_per_chunk = 0; // 0: contiguous and as it is
    std::vector<Bytes> chunks;
};

/// Compresses large arrays. Needs no HDF5 lock.
PackedArray packed(const ArrayView& view);
/// Never compressed.
PackedArray raw(const ArrayView& view);

/// Bytes of the array as it will be stored.
std::size_t stored_bytes(const PackedArray& array);

/// Stores the array as the dataset `name`, which it returns; a `unit` becomes an attribute. Both
/// need a Session.
hdf5::Handle put_array(hid_t parent, const std::string& name, const PackedArray& array,
                       const std::string& unit);
/// Reads the dataset `name` of any of the element types, as it is stored. Throws IoError.
Column get_column(hid_t parent, const std::string& name);

} // namespace hyoryu
