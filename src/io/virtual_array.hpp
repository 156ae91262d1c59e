// SPDX-License-Identifier: MIT
// HDF5 virtual datasets: arrays whose parts are in other files, which the file that holds the
// virtual one refers to. Needs a Session; every function throws IoError.
#pragma once

#include "hdf5.hpp"
#include "packed_array.hpp"

#include <string>

namespace hyoryu {

/// One virtual dataset in the making. Rows that no file holds are NaN, -1, or 255 in bytes.
class VirtualArray {
public:
    /// `rows`: of all parts together.
    VirtualArray(ArrayShape shape, hsize_t rows);
    /// The next `rows` rows are those of the dataset of that file, a name relative to the folder of
    /// the file that will hold this array.
    void append(const std::string& file, const std::string& dataset, hsize_t rows);
    /// The next `rows` rows have no source.
    void skip(hsize_t rows) { filled_ += rows; }
    void put(hid_t parent, const std::string& name) const;

private:
    hdf5::Handle space_of(hsize_t rows) const;

    ArrayShape shape_;
    hsize_t rows_ = 0;
    hsize_t filled_ = 0;
    hdf5::Handle creation_;
};

} // namespace hyoryu
