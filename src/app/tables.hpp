// SPDX-License-Identifier: MIT
// The columns of the histories, and contacts as plain numbers.
#pragma once

#include "hyoryu/core/snapshot.hpp"
#include "hyoryu/rigid/rigid.hpp"

#include <span>
#include <vector>

namespace hyoryu {

// Units say it where two dimensions mean per metre of width.
Table bodies_table(int dimensions);
Table contacts_table(int dimensions);
Table energy_table(int dimensions);
Table gauges_table(std::vector<Table::Head> gauges);

/// Numbers of one resting contact in a checkpoint: the contact and its weight.
inline constexpr std::size_t resting_numbers = 18;
std::vector<double> numbers_of(const Contact& contact);
Contact contact_of(std::span<const double> numbers);

} // namespace hyoryu
