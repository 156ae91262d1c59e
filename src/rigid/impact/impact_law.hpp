// SPDX-License-Identifier: MIT
// One round of each impact law.
#pragma once

#include "rigid/motion/sub_step.hpp"

namespace hyoryu {

struct Round {
    double time = 0; // [s]
    double slow = 0; // an approach below this is no impact [m/s]
    Effort effort{};
    double least = 0;     // if all approaches are below this, the round closes the event [m/s]
    bool closing = false; // no round after this one
};

// A round fills `memory.rows` with the contacts that took part and their impulses, which are
// already applied to the responses of the bodies. No rows: no contact approaches and the event
// ends. Returns the residual [m/s].

/// All contacts that approach together, each with its restitution. The closing round takes all
/// touching contacts, without restitution, so that none is left approaching.
double coupled_round(const StepContext& context, Round& round);
double paper_round(const StepContext& context, Round& round);
double simultaneous_round(const StepContext& context, Round& round);

/// All touching contacts that separate more slowly than `slower` [m/s]; their targets are -e v_n
/// where they are impacts, else zero.
void collect(const StepContext& context, const Round& round, double slower, std::vector<Row>& rows);

/// If the round gained energy, moves the impulses towards the inelastic ones, which never gain any
/// (Kane and Levinson 1985).
void clamp_energy(std::vector<Row>& rows, ContactMemory& memory, const Effort& effort);

} // namespace hyoryu
