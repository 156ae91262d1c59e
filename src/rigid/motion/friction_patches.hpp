// SPDX-License-Identifier: MIT
// Groups the persistent contacts of a sub-step into flat patches, reduces their number, and sets
// where their friction acts.
#pragma once

#include "sub_step.hpp"

#include <algorithm>

namespace hyoryu {

/// Sorts the persistent contacts into patches, those of one pair in one plane. Of each patch the
/// contacts at the corners of its hull stay, eight at most: the others lie between them and cannot
/// approach on their own. In unlocated steps friction acts at the contact points, as their sweeps
/// then converge faster.
void find_patches(const StepContext& context, const SubStep& sub);

/// Sets the friction points of each patch at the start of the sub-step (patch.hpp) from the
/// impulses of the last one. A sticking patch keeps its friction points while its centre of
/// pressure moves by less than a fiftieth of its size: among redundant contacts, moving the
/// friction redistributes the load, which would move the friction again, without end.
void set_rubs(ContactMemory& memory);

/// Records which patches stick: those that carry load with all impulses inside the friction cones.
void note_sticking(const StepContext& context);

/// The centre of pressure of a patch from the present impulses of its contacts, through which
/// sliding friction acts; the centroid if there are no impulses. `point` gives the place of a
/// contact [m].
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
