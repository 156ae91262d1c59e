// SPDX-License-Identifier: MIT
// Named arrays in messages.
#pragma once

#include "hyoryu/core/columns.hpp"
#include "hyoryu/ranks/comm.hpp"

namespace hyoryu {

void put_column(Parcel& parcel, const Column& column);
Column take_column(Unpacking& from);

/// All arrays of a snapshot; its texts are not sent.
void put_arrays(Parcel& parcel, const Snapshot& snapshot);
Snapshot take_arrays(Unpacking& from);

} // namespace hyoryu
