// SPDX-License-Identifier: MIT
#include "friction_patches.hpp"

#include <cmath>
#include <utility>

namespace hyoryu {

namespace {

constexpr std::size_t most_contacts = 8;
// Contacts of one patch: normals closer than this (1 - cosine), heights closer than that [units].
constexpr double parallel_normals = 1e-9;
constexpr double same_height = 1e-6;
// A contact sticks if its friction is inside this part of the cone [1]; the margin is for
// round-off.
constexpr double inside_cone = 1 - 1e-6;
// The centre of pressure has not moved while it is within this part of the size of the patch.
constexpr double settled_centre = 0.02;

bool same_plane(const Touch& a, const Touch& b, double unit)
{
    return a.normal.dot(b.normal) > 1 - parallel_normals &&
           std::abs(a.normal.dot(b.point - a.point)) < same_height * unit;
}

// Moves the contacts that lie in one plane with the first of `left` out of this list.
std::vector<int> take_plane(const ContactMemory& memory, std::vector<int>& left)
{
    const Touch base = memory.persistent[left[0]].candidate.touch;
    const auto apart = std::ranges::stable_partition(left, [&](int k) {
        return !same_plane(base, memory.persistent[k].candidate.touch, memory.geometry.unit);
    });
    std::vector<int> taken(apart.begin(), apart.end());
    left.erase(apart.begin(), apart.end());
    return taken;
}

// Drops the lowest points of rims: on a flat rim their place is arbitrary, and the points fixed to
// the rim carry the load.
void leave_out_lowest(const ContactMemory& memory, std::vector<int>& contacts)
{
    if (contacts.size() > most_contacts) {
        std::erase_if(contacts, [&](int k) {
            const FeatureKind kind = memory.persistent[k].candidate.feature.kind;
            return kind == FeatureKind::rim_low;
        });
    }
}

// The patch of the outermost of the given contacts, in their original order.
FrictionPatch bounding(const ContactMemory& memory, std::vector<int> contacts)
{
    leave_out_lowest(memory, contacts);
    if (contacts.size() < 3) {
        return {.contacts = contacts};
    }
    std::vector<Vec3> points;
    for (const int k : contacts) {
        points.push_back(memory.persistent[k].candidate.touch.point);
    }
    const Candidate& c = memory.persistent[contacts[0]].candidate;
    const Vec3& n = c.touch.normal;
    // turns with a body, so that the choice is the same as long as the face rests
    const bool a_moves = c.feature.b < 0 || memory.rotors[c.feature.a].movable;
    const Mat3& R = memory.poses[a_moves ? c.feature.a : c.feature.b].R;
    int across = 0;
    (R.transpose() * n).cwiseAbs().minCoeff(&across);
    FrictionPatch patch{.hull = outermost(points, n, R.col(across), most_contacts)};
    for (int& corner : patch.hull) {
        corner = contacts[corner];
        patch.contacts.push_back(corner);
    }
    std::ranges::sort(patch.contacts);
    for (int& corner : patch.hull) {
        const auto place = std::ranges::lower_bound(patch.contacts, corner);
        corner = static_cast<int>(place - patch.contacts.begin());
    }
    return patch;
}

// A rod stands on the disc on whose rim its contacts lie, if they lie all around.
PatchForm form_of(const ContactMemory& memory, const std::vector<int>& contacts)
{
    const Candidate& c = memory.persistent[contacts[0]].candidate;
    const auto stands = [&](int k) {
        return k >= 0 && memory.geometry.solids[k].form == Form::rod &&
               std::abs(memory.poses[k].R.col(0).dot(c.touch.normal)) > 1 - parallel_normals;
    };
    const bool all_around = contacts.size() == most_contacts;
    return all_around && (stands(c.feature.a) || stands(c.feature.b)) ? PatchForm::disc
                                                                      : PatchForm::hull;
}

PatchRule rule_of(const ContactMemory& memory, const FrictionPatch& patch)
{
    std::vector<Vec3> points;
    for (const int k : patch.contacts) {
        points.push_back(memory.persistent[k].candidate.touch.point);
    }
    const Vec3& n = memory.persistent[patch.contacts[0]].candidate.touch.normal;
    return patch_rule(points, patch.hull, n, form_of(memory, patch.contacts));
}

// The largest distance of a contact from the first [m].
double size_of(const ContactMemory& memory, const FrictionPatch& patch)
{
    const Vec3& first = memory.persistent[patch.contacts[0]].candidate.touch.point;
    double size = 0;
    for (const int k : patch.contacts) {
        size = std::max(size, (memory.persistent[k].candidate.touch.point - first).norm());
    }
    return size;
}

// Removes the contacts that no patch kept and renumbers the others.
void keep(const std::vector<char>& kept, ContactMemory& memory)
{
    std::vector<int> number(kept.size());
    int next = 0;
    for (std::size_t k = 0; k < kept.size(); ++k) {
        number[k] = next;
        if (kept[k] == 0) {
            continue;
        }
        if (next != static_cast<int>(k)) {
            memory.persistent[next] = memory.persistent[k];
        }
        ++next;
    }
    memory.persistent.resize(next);
    for (FrictionPatch& patch : memory.patches) {
        for (int& k : patch.contacts) {
            k = number[k];
        }
    }
}

// Whether the patch is the one that stuck in the last sub-step, with the centre of its pressure
// about where it was when friction was placed.
bool rubs_where_it_did(const ContactMemory& memory, const FrictionPatch& patch, const Vec3& centre)
{
    const double shrunk = 1 - patch.rule.scale;
    const double moved = settled_centre * shrunk;
    return shrunk > 0 && std::ranges::all_of(patch.contacts, [&](int k) {
               const Persistent& p = memory.persistent[k];
               const Vec3 arm = centre - p.candidate.touch.point;
               return p.stuck == static_cast<int>(patch.contacts.size()) &&
                      (p.friction_offset - shrunk * arm).norm() <= moved * patch.size;
           });
}

bool patch_sticks(const StepContext& context, const FrictionPatch& patch)
{
    double load = 0;
    const bool inside = std::ranges::all_of(patch.contacts, [&](int k) {
        const Persistent& p = context.memory.persistent[k];
        const Feature& f = p.candidate.feature;
        const Vec3& n = p.candidate.touch.normal;
        const double pressed = n.dot(p.impulse);
        const double mu = law_of(context.rigid, f.a, f.b).friction;
        load += pressed;
        return (p.impulse - pressed * n).norm() <= inside_cone * mu * pressed;
    });
    return inside && load > 0;
}

} // namespace

void find_patches(const StepContext& context, const SubStep& sub)
{
    ContactMemory& memory = context.memory;
    const std::vector<Persistent>& contacts = memory.persistent;
    memory.patches.clear();
    std::vector<char> kept(contacts.size(), 0);
    std::vector<int> left;
    for (std::size_t k = 0; k < contacts.size(); ++k) {
        left.push_back(static_cast<int>(k));
        const Feature& f = contacts[k].candidate.feature;
        const Feature* next =
            k + 1 < contacts.size() ? &contacts[k + 1].candidate.feature : nullptr;
        if (next != nullptr && next->a == f.a && next->b == f.b) {
            continue;
        }
        // In the plane of a two-dimensional scene it does not matter where friction acts.
        const bool rubs = context.rigid.settings.dimensions == 3 && sub.arms == Arms::ahead &&
                          law_of(context.rigid, f.a, f.b).friction > 0;
        while (!left.empty()) {
            FrictionPatch patch = bounding(memory, take_plane(memory, left));
            for (const int m : patch.contacts) {
                kept[m] = 1;
            }
            if (rubs && patch.contacts.size() > 1) {
                memory.patches.push_back(std::move(patch));
            }
        }
    }
    keep(kept, memory);
    for (FrictionPatch& patch : memory.patches) {
        patch.rule = rule_of(memory, patch);
        patch.size = size_of(memory, patch);
    }
}

void set_rubs(ContactMemory& memory)
{
    for (const FrictionPatch& patch : memory.patches) {
        const Vec3 centre = centre_of(memory.persistent, patch,
                                      [](const Persistent& p) { return p.candidate.touch.point; });
        const bool stays = rubs_where_it_did(memory, patch, centre);
        for (const int k : patch.contacts) {
            Persistent& p = memory.persistent[k];
            if (!stays) {
                p.friction_offset = (1 - patch.rule.scale) * (centre - p.candidate.touch.point);
                p.stuck = 0;
            }
            p.touches.push_friction_offset = p.friction_offset;
            p.touches.see_friction_offset = p.friction_offset;
        }
    }
    for (Persistent& p : memory.persistent) { // of no patch: friction at the contact point
        p.friction_offset = p.touches.push_friction_offset;
    }
}

void note_sticking(const StepContext& context)
{
    for (const FrictionPatch& patch : context.memory.patches) {
        const int size = patch_sticks(context, patch) ? static_cast<int>(patch.contacts.size()) : 0;
        for (const int k : patch.contacts) {
            context.memory.persistent[k].stuck = size;
        }
    }
}

} // namespace hyoryu
