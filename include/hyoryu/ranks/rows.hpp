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

/// Tiles and their points, as one rank has them, in a message and appended to those of the ranks
/// before it; the row of point k of them is `rows[k]`.
void put_tiles(Parcel& parcel, const Tiles& tiles);
void append_tiles(Unpacking& from, std::span<const std::int32_t> rows, Tiles& all);

} // namespace hyoryu
