// SPDX-License-Identifier: MIT
// The persistent contacts of a sub-step as flat patches: thinned out, and with their friction.
#pragma once

#include "sub_step.hpp"

#include <algorithm>

namespace hyoryu {

/// Sorts the persistent contacts into patches, those of one pair in one plane. Of each patch the
/// contacts at the corners of its hull stay, eight at most: the others lie between them and cannot
/// approach on their own. Steps without location rub at the contact points: their sweeps settle
/// faster.
void find_patches(const StepContext& context, const SubStep& sub);

/// Sets where the contacts of each patch rub at the start of the sub-step (patch.hpp), by the
/// impulses that they have from the last one. A patch that sticks rubs where it did while the
/// centre of its pressure stays within a fiftieth of its size: where many contacts share a load, a
/// solution shares it anew if friction moves, which moves friction, without end.
void set_rubs(ContactMemory& memory);

/// Notes which patches stick: those that bear load, all of it inside the friction cones.
void note_sticking(const StepContext& context);

/// The centre of the pressure of a patch, by the impulses that its contacts have so far, through
/// which the friction of a slide goes; the centroid while they have none. `point` gives the place
/// of a contact [m].
Vec3 centre_of(std::span<const Persistent> contacts, const FrictionPatch& patch, const auto& point)
{
    Vec3 centroid = Vec3::Zero();
    Vec3 moment = Vec3::Zero();
    double sum = 0;
    for (std::size_t k = 0; k < patch.contacts.size(); ++k) {
        const Persistent& p = contacts[patch.contacts[k]];
        const double load = std::max(0.0, p.impulse.dot(p.candidate.touch.normal));
        centroid += patch.rule.weights[k] * point(p);
        moment += load * point(p);
        sum += load;
    }
    return sum > 0 ? Vec3(moment / sum) : centroid;
}

} // namespace hyoryu
