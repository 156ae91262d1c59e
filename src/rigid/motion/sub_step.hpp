// SPDX-License-Identifier: MIT
// The parts of a sub-step of one cluster, in the order in which they run.
#pragma once

#include "memory.hpp"

namespace hyoryu {

/// Work limit for locating the impacts of a cluster in a step [updates of rows]: a part for each
/// body and the cluster's share of the amount in the settings.
double located_work(const StepContext& context, const Cluster& cluster);
/// Cost of the collision query of a pair, and of a contact in a planned motion [updates of rows].
inline constexpr double look_work = 8;
inline constexpr double plan_work = 5;
/// Whether the work spent on the current cluster is below its limit.
inline bool is_worth_locating(const ContactMemory& memory)
{
    return memory.work < memory.worth;
}

/// Where persistent contacts take their arms and normals. `ahead`: at the middle and the end of the
/// planned motion, by two passes, or one if the path ends agree with the guess; second order.
/// `now`: at the start; first order, but the contact problem is symmetric, so that even a rough
/// solution gains no energy.
enum class Arms { ahead, now };

/// The slip that friction opposes. `end`: the slip at the end of the sub-step, correct for contacts
/// that may stick. `mean`: the mean of the slips at its start and end, for contacts that slide
/// throughout; second order when the direction of sliding turns.
enum class Slip { mean, end };

/// Below this speed the direction of sliding is not followed [m/s, with a unit of 1 m].
inline constexpr double no_slip = 1e-4;

/// How a sub-step treats a cluster.
struct SubStep {
    const Cluster& cluster;
    double time = 0;     // at its start [s]
    double h = 0;        // its length [s]
    double slow = 0;     // normal speed below which a contact rests and does not bounce [m/s]
    int most_rounds = 0; // of impacts, before the one that closes the event
    Effort impact_effort{};
    Effort contact_effort{.stuck = contacts_of_a_pile + 1};
    Arms arms = Arms::ahead;
    double no_gap = 1e-12; // left alone by the projection: the noise of positions [units]
    Slip slip = Slip::mean;
};

/// The sub-step in which no body of the cluster turns too far for the scheme, at most `rest` [s].
double sub_step_length(const StepContext& context, const Cluster& cluster, double rest);

/// The longest sub-step within `rest` for the contacts found: all of it, or up to a third of the
/// step if a body turns on its contacts [s].
double part_on_contacts(const StepContext& context, double rest);

/// Shortens the planned sub-step to that length if a body turns at its end only.
void end_with_part(const StepContext& context, SubStep& sub, double rest);

/// First guesses of the impulses of the persistent contacts: the force that the same feature had in
/// the last sub-step, or else the nearest one of the pair, because two faces in contact may be
/// described by other features a moment later.
void recall_forces(ContactMemory& memory, double h);
/// The forces of the persistent contacts of the last sub-step, for the warm start of what follows.
void remember(ContactMemory& memory, double h);

/// Number of events of a body in a step after which its contacts are inelastic and no longer
/// located, unless the cost of the cluster lowers the limit.
inline constexpr int event_limit = 50;
/// Whether one of the bodies has exceeded `memory.event_limit`.
bool exceeds_event_limit(const ContactMemory& memory, int a, int b);
/// Lowers that limit once the cluster has used half of its work limit, so that the bodies with most
/// events are excluded from location first; sets `memory.stepped` if any body exceeds the limit.
void lower_event_limit(ContactMemory& memory, const Cluster& cluster);

/// Finds all possible contacts of the cluster at the current poses.
void find_contacts(const StepContext& context, const Cluster& cluster, double time);

/// Like `find_contacts`, but bodies above their event limit get the contacts of an unlocated step:
/// those that touch, and those that close on the free paths within `sub.h`.
void find_contacts_with_unlocated(const StepContext& context, const SubStep& sub);

/// The features of a pair that touch, or that close on the free paths within the sub-step.
void find_closing(const StepContext& context, const BodyPair& pair, const SubStep& sub,
                  std::vector<Candidate>& found);

/// Impact rounds: all touching contacts that approach are solved together, each with the
/// restitution of its own approach, and rounds are repeated until none approaches. The clamp of the
/// energy (Kane and Levinson 1985) keeps every round dissipative. Returns the residual of the last
/// round [m/s].
double solve_impacts(const StepContext& context, const SubStep& sub, double time);

/// Plans the paths without contacts and sets the poses at their ends.
void predict_free_motion(const StepContext& context, const SubStep& sub);

/// The smooth motion over the sub-step with persistent contacts: fills the paths and `persistent`.
/// The velocity is constrained with the arm at the end, the impulse acts with the arm at the
/// middle; this makes the scheme second order.
void plan_motion(const StepContext& context, const SubStep& sub);

/// The smooth motion over the sub-step, whose length has changed, from the velocities at its start.
void plan_again(const StepContext& context, const SubStep& sub);

/// Shortens the planned sub-step until no contact between curves turns too far in it.
void end_with_turn(const StepContext& context, SubStep& sub);

/// Where a sliding contact stops or turns back within the planned sub-step, shortens it to that
/// time and plans it again.
void end_with_slip(const StepContext& context, SubStep& sub);

/// Whether a persistent contact overlaps at the end of the planned motion (poses `end`). A contact
/// point that moves along the solids faster than they turn, such as the low point of a nearly flat
/// cap, is not where it was predicted.
bool contacts_sink(const StepContext& context, const SubStep& sub);

/// The first time within the sub-step at which a contact not in `held` closes; h if none does.
double first_event(const StepContext& context, const SubStep& sub);

/// Whether a pair without event search overlaps more at the end of the planned motion (poses
/// `end`). A body that turns away from a contact on its free path and is pressed back by another
/// contact is not detected as closing.
bool ends_deep(const StepContext& context, const SubStep& sub);
/// Most halvings of such a sub-step.
inline constexpr int halvings = 8;

/// Whether contacts (without the work of moving walls) or the projection of the gaps add energy to
/// the cluster in the planned motion, which ends at the poses `end`: more than a millionth of its
/// kinetic energy.
bool gains_energy(const StepContext& context, const SubStep& sub);

/// Energy that contacts dissipated on the planned motion up to the time s, at which the bodies are
/// now; the work of moving walls is left out [J].
double taken_by_contacts(const StepContext& context, const SubStep& sub, double s);

/// Moves the bodies along their paths to s and records the share of the contact impulses.
void move_to(const StepContext& context, const SubStep& sub, double s);

/// After a located sub-step: brings the gaps of pressed contacts to zero, and pushes overlapping
/// ones apart, by changes of position only; updates the gaps of the contact candidates. For
/// contacts that overlapped at the start, the potential energy added is at most the energy that
/// contacts dissipated in this step.
void project_gaps(const StepContext& context, const SubStep& sub, double time);

/// After an unlocated sub-step: moves the bodies, by changes of position only, with the least
/// mass-weighted displacement that opens the contact candidates. The potential energy added is at
/// most the energy that contacts dissipated in this step.
void open_gaps(const StepContext& context, const SubStep& sub, double time);

/// Advances the cluster from `done` into the step to its end without locating impacts. A contact
/// that closes within the sub-step and approaches faster than gravity alone causes bounces at its
/// start, with the restitution of its approach; all others may close to zero and no further: v_n >=
/// -gap/h at its end. Momentum is exact, energy never grows, the time of an impact is off by less
/// than the sub-step. Source: collisions ahead of contacts, Guendelman, Bridson and Fedkiw (2003);
/// the constraint on the gap, Stewart and Trinkle (1996).
void advance_unlocated(const StepContext& context, const Cluster& cluster, double done);

/// The work of contacts as a function of the share s of their impulses that acts,
/// s (linear + s square) [J]. Measured relative to moving walls, it excludes their work.
struct WorkOfShare {
    double linear = 0, square = 0;
};
/// The largest share of the impulses, at most all, whose work is not positive.
double passive_share(const WorkOfShare& work);
/// The work of persistent contacts in a planned motion with the arms of its start: sum
/// P . (u0 + u1) / 2, u0 before the loads and u1 after them and the contacts.
WorkOfShare work_of_contacts(const ContactMemory& memory, std::span<const Row> rows);
/// Scales the impulses of each island, as solved last, by their passive share. The projection opens
/// contacts that still approach, and the next sub-step stops them.
void make_passive(ContactMemory& memory);

/// Solves the rows island by island; returns the worst residual.
double solve_islands(std::vector<Row>& rows, ContactMemory& memory, const Effort& effort);

} // namespace hyoryu
