// SPDX-License-Identifier: MIT
// Rows of a store in messages: all columns, numbers and owners.
#pragma once

#include "hyoryu/ranks/comm.hpp"

#include "hyoryu/core/particles.hpp"

namespace hyoryu {

/// Appends rows to a parcel.
void put_rows(Parcel& parcel, const Store& store, std::span<const std::int32_t> rows);
/// Takes as many rows out of a parcel, from a store with the same columns, into the given ones.
void take_rows(Unpacking& from, Store& store, std::span<const std::int32_t> rows);

/// first, first + 1, ...
std::vector<std::int32_t> rows_from(Index first, Index count);

} // namespace hyoryu
