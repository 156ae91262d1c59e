// SPDX-License-Identifier: MIT
// State that the rigid layer keeps between steps, and its scratch memory.
#pragma once

#include "rigid/collision/narrow_phase.hpp"
#include "rigid/contact/patch.hpp"
#include "rigid/contact/solver.hpp"

namespace hyoryu {

/// The path of a body over a smooth sub-step of length h: V and L change linearly, x is the
/// parabola, q the free rotor with the mean momentum up to the time asked for.
struct Path {
    SolidPose start;
    Vec3 v0{0, 0, 0}, v1{0, 0, 0}; // V [m/s]
    Vec3 L0{0, 0, 0}, L1{0, 0, 0}; // L [kg m2/s]
    double h = 0;                  // [s]
};
SolidPose pose_at(const Path& path, const Rotor& rotor, double s);

/// The force of a persistent contact: the warm start of the next step.
struct Remembered {
    Feature feature;
    Vec3 force{0, 0, 0}; // on a [N]
    Vec3 place{0, 0, 0}; // in the axes of a, from its centre of mass [m]
    Vec3 friction_offset{0, 0,
                         0}; // in the axes of a, from the contact point to the friction point [m]
    int stuck = 0;           // as of Persistent
};

void sort_by_feature(std::vector<Remembered>& forces);

/// Bodies that may meet within a step, with all their pairs.
struct Cluster {
    std::vector<int> bodies;
    std::vector<BodyPair> pairs;
};

/// The contact candidates of a pair from the last collision query, and the poses at that time.
struct CachedContacts {
    BodyPair pair;
    SolidPose a, b; // of a wall: x is the displacement [m], q the identity
    std::vector<Candidate> found;
    bool known = false;
};

/// Deviation of the motion of a body within a step from its free path.
struct Deviation {
    Vec3 start{0, 0, 0};              // x at the start of the step [m]
    Vec3 velocity{0, 0, 0};           // V then [m/s]
    Vec3 low{0, 0, 0}, high{0, 0, 0}; // bounds of x less the free path [m]
    double turn = 0;                  // bound on the angle from the start [rad]
};

/// The velocity and the angular momentum at the end of a path.
struct PathEnd {
    Vec3 velocity{0, 0, 0};         // [m/s]
    Vec3 angular_momentum{0, 0, 0}; // [kg m2/s]
};

/// A persistent contact of the current sub-step.
struct Persistent {
    Candidate candidate;
    Vec3 impulse{0, 0, 0};         // over the whole sub-step, on a [N s]
    Vec3 place{0, 0, 0};           // as of Remembered
    Vec3 friction_offset{0, 0, 0}; // from contact point to friction point, at the start [m]
    bool recalled = false;         // the first guess is a force of the last sub-step
    bool unsolved = false;         // its impulse does not resolve the contact
    int stuck = 0;                 // contacts of its patch, while none of them slides
    TwoTouches touches;            // at the middle and the end
    double effective_mass = 0;     // [kg]
    double dissipated = 0;         // [J]
    Vec3 before{0, 0, 0};          // relative velocity at the start, at the friction point [m/s]
    Vec3 slip_before{0, 0, 0};     // relative tangential velocity at the start [m/s]
    Vec3 slip_after{0, 0, 0};      // and at the end of the sub-step
};

/// Persistent contacts of one pair in one plane, by their indices.
struct FrictionPatch {
    std::vector<int> contacts;
    std::vector<int> hull; // indices into `contacts` if three or more, counter-clockwise
    PatchRule rule;
    double size = 0; // [m]
};

/// The log entry of a persistent contact over a sub-step.
struct Resting {
    Feature feature;
    Contact contact;
};

struct ContactMemory {
    std::vector<Remembered> forces; // sorted by feature
    std::vector<double> work_of; // part of each body in the cost of its cluster [updates of rows]

    // From the bodies and boundaries at the first step; shapes, masses and locks do not change.
    Geometry geometry;
    std::vector<Rotor> rotors;

    // Scratch, by body.
    std::vector<SolidPose> poses, trial, middle, end;
    std::vector<Path> paths;
    std::vector<Response> responses;
    std::vector<Twist> starts;          // velocities at the start of the sub-step
    std::vector<PathEnd> guesses;       // of the planned paths, with the known impulses
    std::vector<int> events;            // located events of this step
    std::vector<Deviation> deviations;  // while a cluster is advanced in groups
    std::vector<int> parents_of_groups; // of the bodies of that cluster
    bool in_groups = false;

    // Scratch of the cluster in hand.
    std::vector<Cluster> clusters;
    std::vector<CachedContacts> looks; // of all their pairs, sorted by pair
    std::vector<Candidate> candidates;
    std::vector<std::vector<Candidate>> found; // of each block of pairs
    std::vector<Persistent> persistent;
    std::vector<FrictionPatch> patches; // of more than one contact, with friction
    std::vector<Feature> held;          // sorted; ignored by the event search
    std::span<const Remembered> known;  // forces of the last sub-step
    std::vector<Remembered> recent, fresh;
    std::vector<char> taken; // of `known`
    std::vector<Resting> resting;
    std::vector<std::size_t> order; // of `resting`, by feature
    std::vector<Feature> pressed;
    std::vector<Row> rows, group;
    bool jammed = false;      // a cluster of this step went on without location
    bool stepped = false;     // contacts of the cluster in hand were not located
    int event_limit = 0;      // of a body of the cluster in this step
    double work = 0;          // spent on the cluster in this step, in updates of rows
    double lost = 0;          // dissipated by contacts in the step, less corrections [J]
    double worth = 0;         // work limit for locating its impacts
    std::vector<int> entries; // in the log, of each candidate; -1 if none
    std::vector<int> parents, island_of_root, island_of_row;
    std::vector<std::size_t> island_ends; // of the rows as solved last
    std::vector<SolverWork> solvers;      // of each island
    std::vector<double> left;             // residual of each island [m/s]
};

/// Arguments of a step.
struct StepContext {
    Rigid& rigid;
    ContactMemory& memory;
    std::span<const Wrench> loads;
    std::vector<Contact>& log;
    double start = 0; // [s]
    double dt = 0;    // [s]
};

/// Builds the tables if there are none for these bodies, and takes the poses of the bodies.
void prepare(Rigid& rigid);

/// Lists the pairs of the clusters; pairs of the last step keep their cached contacts.
void keep_cache(ContactMemory& memory);
/// The contact candidates of a pair as `find_candidates` returns them. The cached ones are returned
/// if neither pose has changed, bit for bit. The span is valid until the next query of the pair.
std::span<const Candidate> look_at(ContactMemory& memory, const BodyPair& pair,
                                   const Configuration& at);

Configuration configuration(const ContactMemory& memory, const std::vector<SolidPose>& poses,
                            double time);

/// Velocity of a boundary at a time, zero for a body.
Vec3 wall_velocity(const ContactMemory& memory, int b, double time);
/// Restitution and friction of a pair.
const ContactLaws::Law& law_of(const Rigid& rigid, int a, int b);
/// Acceleration of a body under gravity and its load, without locked axes.
Vec3 acceleration(const StepContext& context, int body);

/// Sets V, omega and the inverse inertia of a body, or of those of a cluster, as they are now.
void set_response(const StepContext& context, int body);
void set_responses(const StepContext& context, const Cluster& cluster);

/// Velocity of a point of a body, from its response and its pose [m/s].
inline Vec3 velocity_at(const ContactMemory& memory, int body, const Vec3& point)
{
    const Response& now = memory.responses[body];
    return now.v + now.omega.cross(point - memory.poses[body].x);
}

/// Normal velocity of separation of a contact, from the responses and poses of `time` [m/s].
double separation_speed(const ContactMemory& memory, const Candidate& contact, double time);

} // namespace hyoryu
