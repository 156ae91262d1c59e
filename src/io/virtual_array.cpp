// SPDX-License-Identifier: MIT
#include "virtual_array.hpp"

#include "hyoryu/core/name.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace hyoryu {

namespace {

void set_fill_value(hid_t creation, ElementType type)
{
    const double nan = std::nan("");
    const std::int64_t minus_one = -1;
    const std::uint8_t largest = 255;
    herr_t status = 0;
    if (type == ElementType::float32 || type == ElementType::float64) {
        status = H5Pset_fill_value(creation, H5T_NATIVE_DOUBLE, &nan);
    } else if (type == ElementType::uint8) {
        status = H5Pset_fill_value(creation, H5T_NATIVE_UINT8, &largest);
    } else {
        status = H5Pset_fill_value(creation, H5T_NATIVE_INT64, &minus_one);
    }
    hdf5::check(status, "prepare a virtual dataset");
}

} // namespace

VirtualArray::VirtualArray(ArrayShape shape, hsize_t rows)
    : shape_(std::move(shape)), rows_(rows),
      creation_(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "prepare a virtual dataset")
{
    hdf5::check(H5Pset_layout(creation_, H5D_VIRTUAL), "prepare a virtual dataset");
    hdf5::check(H5Pset_obj_track_times(creation_, false), "prepare a virtual dataset");
    set_fill_value(creation_, shape_.type);
}

void VirtualArray::append(const std::string& file, const std::string& dataset, hsize_t rows)
{
    if (rows > 0) {
        const hdf5::Handle all = space_of(rows_);
        const hdf5::Handle source = space_of(rows);
        const std::array<hsize_t, 2> start{filled_, 0};
        const std::array<hsize_t, 2> count{rows, shape_.components};
        hdf5::check(
            H5Sselect_hyperslab(all, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr),
            "refer to a frame");
        // In the names of sources HDF5 takes % for the begin of a pattern.
        const std::string name = replaced(file, {{'%', "%%"}});
        hdf5::check(H5Pset_virtual(creation_, all, name.c_str(), dataset.c_str(), source),
                    "refer to a frame");
    }
    filled_ += rows;
}

void VirtualArray::put(hid_t parent, const std::string& name) const
{
    const std::string action = fmt::format("write the array `{}`", name);
    const hdf5::Handle all = space_of(rows_);
    const hdf5::Handle dataset(H5Dcreate2(parent, name.c_str(), hdf5_type(shape_.type), all,
                                          H5P_DEFAULT, creation_, H5P_DEFAULT),
                               H5Dclose, action);
    if (!shape_.unit.empty()) {
        hdf5::put_attribute(dataset, "unit", shape_.unit);
    }
}

hdf5::Handle VirtualArray::space_of(hsize_t rows) const
{
    const std::array<hsize_t, 2> dims{rows, shape_.components};
    return {H5Screate_simple(shape_.components == 0 ? 1 : 2, dims.data(), nullptr), H5Sclose,
            "size a virtual dataset"};
}

} // namespace hyoryu
