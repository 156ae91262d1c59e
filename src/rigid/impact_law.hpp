// SPDX-License-Identifier: MIT
// One round of each impact law. A round fills `memory.rows` with the contacts that took part and
// their impulses, which the responses of the bodies know already; no rows: nothing approaches.
// Returns the largest speed by which a contact still wants to change [m/s].
#pragma once

#include "sub_step.hpp"

namespace hyoryu {

double coupled_round(const StepContext& context, double time);
double paper_round(const StepContext& context, double time);
double simultaneous_round(const StepContext& context, double time);

/// All touching contacts that separate more slowly than `slower` [m/s]; their targets are -e v_n
/// where they approach faster than the resting speed, else zero.
void collect(const StepContext& context, double time, double slower, std::vector<Row>& rows);

/// If the round gained energy, goes back towards the inelastic impulse, which never does (Kane and
/// Levinson 1985).
void clamp_energy(std::vector<Row>& rows, ContactMemory& memory);

} // namespace hyoryu
