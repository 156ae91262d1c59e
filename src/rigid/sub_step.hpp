// SPDX-License-Identifier: MIT
// The parts of a sub-step of one cluster, in the order in which they run.
#pragma once

#include "memory.hpp"

namespace hyoryu {

/// What locating the impacts of a cluster may cost in a step, in updates of rows: something for
/// each body, and the cluster's part of what the settings add for all.
double located_work(const StepContext& context, const Cluster& cluster);
/// A look at a pair, and a contact in a plan of the motion, in updates of rows.
inline constexpr double look_work = 8;
inline constexpr double plan_work = 5;
/// Whether the cluster in hand has cost less than it may.
inline bool is_worth_locating(const ContactMemory& memory)
{
    return memory.work < memory.worth;
}

/// Where smooth contacts take their arms and normals: at the middle and the end of the planned
/// motion, in two passes, or one that ends where the known impulses led to, which is of second
/// order; or as they are at the start, which is of first order but keeps the contact problem
/// symmetric, so that no solution of it, however rough, gains energy.
enum class Arms { ahead, now };

/// The slip that friction opposes: that at the end of the sub-step, which holds wherever a contact
/// may stick; or, where contacts slide all through it, the mean of that at its start and its end,
/// which is of second order where the direction turns.
enum class Slip { mean, end };

/// Sliding slower than this has no direction that is worth following [m/s, with a unit of 1 m].
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

/// Short enough that no body of the cluster turns too far for the scheme, and not longer than
/// `rest` [s].
double sub_step_length(const StepContext& context, const Cluster& cluster, double rest);

/// Of the rest of the step the part that a sub-step may take with the contacts as found: all of it,
/// or up to a third of the step where a body turns on them [s].
double part_on_contacts(const StepContext& context, double rest);

/// Shortens the planned sub-step to that part if it is only at its end that a body turns.
void end_with_part(const StepContext& context, SubStep& sub, double rest);

/// First guesses of the impulses of the persistent contacts: the force that the same feature had in
/// the last sub-step, or else the nearest one of the pair, because two faces in contact may be
/// described by other features a moment later.
void recall_forces(ContactMemory& memory, double h);
/// The forces of the persistent contacts of the last sub-step, for the warm start of what follows.
void remember(ContactMemory& memory, double h);

/// Events of one body within a step after which its contacts are inelastic and no longer located,
/// as long as the cluster has not cost much.
inline constexpr int event_limit = 50;
/// Whether one of the bodies had more events than `memory.event_limit`.
bool tired(const ContactMemory& memory, int a, int b);
/// Lowers that limit while the cluster costs more than half of what it may, so that the part of it
/// that rattles most is let go first; sets `memory.stepped` if any body is tired.
void let_go_of_rattle(ContactMemory& memory, const Cluster& cluster);

/// Finds all possible contacts of the cluster at the current poses.
void find_contacts(const StepContext& context, const Cluster& cluster, double time);

/// Takes the contacts of tired bodies as an unlocated step does: those that touch, and those that
/// close within the sub-step on the free paths, of length `sub.h`.
void find_contacts_of_tired(const StepContext& context, const SubStep& sub);

/// The features of a pair that touch, or that close on the free paths within the sub-step.
void find_closing(const StepContext& context, const BodyPair& pair, const SubStep& sub,
                  std::vector<Candidate>& found);

/// Impact rounds: while any touching contacts approach, all of them are solved together, each with
/// the restitution of its own approach; then looked at again. The clamp of the energy (Kane and
/// Levinson 1985) keeps every round dissipative. Returns the speed by which a contact of the last
/// round still wants to change [m/s].
double solve_impacts(const StepContext& context, const SubStep& sub, double time);

/// Plans the paths without contacts and sets the poses at their ends.
void predict_free_motion(const StepContext& context, const SubStep& sub);

/// The smooth motion over the sub-step with persistent contacts: fills the paths and `persistent`.
/// The velocity is asked for with the arm at the end, the impulse acts with the arm at the middle,
/// which makes the scheme second order.
void plan_motion(const StepContext& context, const SubStep& sub);

/// The smooth motion over the sub-step, whose length has changed, from the velocities at its start.
void plan_again(const StepContext& context, const SubStep& sub);

/// Shortens the planned sub-step until no contact between curves turns too far in it.
void end_with_turn(const StepContext& context, SubStep& sub);

/// Where a sliding contact stops or turns back within the planned sub-step, shortens it to that
/// time and plans it again.
void end_with_slip(const StepContext& context, SubStep& sub);

/// Whether the planned motion, which ends at the poses `end`, leaves a contact that it was planned
/// with overlapping: one whose point runs along the solids faster than they turn, as the low point
/// of a cap that is nearly flat, is not where it was foreseen.
bool contacts_sink(const StepContext& context, const SubStep& sub);

/// The first time within the sub-step at which a contact that is not held closes; h if none does.
double first_event(const StepContext& context, const SubStep& sub);

/// Whether the planned motion, which ends at the poses `end`, leaves pairs whose events are not
/// looked for deeper in each other: what turns away from a contact on its free path, and is pressed
/// back by another, is not seen to close.
bool ends_deep(const StepContext& context, const SubStep& sub);
/// Such a sub-step is halved so often at most.
inline constexpr int halvings = 8;

/// Whether contacts, walls that move left out, give the cluster energy in the planned motion,
/// which ends at the poses `end`, or the projection of the gaps there would: more than a millionth
/// of what it moves with.
bool gains_energy(const StepContext& context, const SubStep& sub);

/// Energy that the contacts took on the planned motion up to s, where the bodies are; what walls
/// that move gave is left out [J].
double taken_by_contacts(const StepContext& context, const SubStep& sub, double s);

/// Moves the bodies along their paths to s and books the share of the contact impulses.
void move_to(const StepContext& context, const SubStep& sub, double s);

/// After a located sub-step: brings the gaps of pressed contacts to zero, and pushes overlapping
/// ones apart, by position alone; the possible contacts that were found move with the bodies. Where
/// they overlapped when it began, what is lifted gets no more energy than contacts took in this
/// step.
void project_gaps(const StepContext& context, const SubStep& sub, double time);

/// After an unlocated sub-step: moves the bodies, by position alone and as little as their masses
/// let them, until the possible contacts that were found are open. What is lifted for it gets no
/// more energy than contacts took in this step.
void open_gaps(const StepContext& context, const SubStep& sub, double time);

/// Advances the cluster from `done` into the step to its end without locating impacts. A contact
/// that closes within the sub-step and approaches faster than gravity explains bounces at its
/// start, with the restitution of its approach; all others may close to zero and no further: v_n >=
/// -gap/h at its end. Momentum is exact, energy never grows, the time of an impact is off by less
/// than the sub-step. Source: collisions ahead of contacts, Guendelman, Bridson and Fedkiw (2003);
/// the constraint on the gap, Stewart and Trinkle (1996).
void advance_unlocated(const StepContext& context, const Cluster& cluster, double done);

/// The work of contacts as a function of the share s of their impulses that acts,
/// s (linear + s square) [J]. Seen from walls that move it leaves out what those give.
struct WorkOfShare {
    double linear = 0, square = 0;
};
/// The largest share of the impulses, at most all, whose work is not positive.
double passive_share(const WorkOfShare& work);
/// The work of persistent contacts in a planned motion with the arms of its start: sum
/// P . (u0 + u1) / 2, u0 before the loads and u1 after them and the contacts.
WorkOfShare work_of_contacts(const ContactMemory& memory, std::span<const Row> rows);
/// Reduces the impulses of each island, as solved last, to their passive share. What that leaves
/// approaching, the projection opens and the next sub-step stops.
void make_passive(ContactMemory& memory);

/// Solves the rows island by island; returns the worst residual.
double solve_islands(std::vector<Row>& rows, ContactMemory& memory, const Effort& effort);

} // namespace hyoryu
