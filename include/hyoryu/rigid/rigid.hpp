// SPDX-License-Identifier: MIT
// The rigid-body system: bodies, boundaries, impulse contact, and its step. A step finds clusters
// of bodies that may meet and advances each by sub-steps, in which impacts are located in time and
// contact impulses are solved for with the circular Coulomb cone.
#pragma once

#include "hyoryu/rigid/body.hpp"
#include "hyoryu/rigid/law.hpp"
#include "hyoryu/rigid/penalty.hpp"

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace hyoryu {

/// One impact, or the sum of one resting contact over a step.
struct Contact {
    enum class Kind { impact, resting };
    Kind kind = Kind::impact;
    double time = 0;                  // of the impact, located within the step [s]
    int a = 0;                        // body
    int b = -1;                       // other body, or -1 - (index of the boundary)
    Vec3 point{0, 0, 0};              // [m]
    Vec3 normal{0, 0, 1};             // from b to a, unit
    double approach_speed = 0;        // normal speed of approach before the impact [m/s], >= 0
    double normal_impulse = 0;        // on a, along the normal [N s]
    Vec3 tangential_impulse{0, 0, 0}; // on a [N s]
    double effective_mass = 0;        // 1 / (n . K n) [kg]
    // [J]; >= 0 but for the law "paper", which can gain. Exact in sum: the impacts of one moment
    // lose together what the kinetic energy, seen from the walls, lost.
    double energy_lost = 0;
    double depth = 0; // by which the two overlap there, of a resting contact the largest [m], >= 0
    // Whether the time of the impact was found within the step; of a resting contact, whether all
    // impacts of the bodies that may meet in the step were.
    bool located = true;
};

/// Choices of the solver, with the defaults of the method.
struct RigidSettings {
    int dimensions = 3;
    Vec3 gravity{0, 0, -9.81};       // [m/s2]
    double contact_tolerance = 1e-7; // gap below which a point is in contact [m]
    double resting_speed = 1e-3;     // approach speed below which restitution is zero [m/s]
    // Unit of the length tolerances (such as a gap of 1e-10); speed tolerances scale with its
    // square root (Froude scaling). One metre suits bodies of centimetres to tens of metres [m].
    double unit = 1;
    ImpactLaw law = ImpactLaw::coupled;
    // Work limit for locating impacts in a step in addition to the part for each body, in updates
    // of contacts of about 0.1 us each. A count of operations rather than a time, so that all
    // machines give the same result.
    double located_work = 0;
};

/// Counters of the contact solver, for diagnostics.
struct RigidCounters {
    long long impacts = 0;
    long long rounds = 0;             // impact rounds
    long long events = 0;             // located sub-steps
    long long tangential_impacts = 0; // Painleve configurations met
    long long capped_steps = 0;       // steps in which not every impact was located in time
    double worst_residual = 0;        // largest remaining approach speed of a solve [m/s]
    double worst_penetration = 0;     // [m]
};

class Comm;

struct ContactMemory; // persistent contacts and their impulses (warm start); private to rigid

struct Rigid {
    RigidSettings settings;
    std::vector<Body> bodies;
    std::vector<Boundary> boundaries; // those that let water pass stand last
    ContactLaws laws;
    std::optional<Penalty> penalty; // the method of contact in place of impulses; none: impulses
    RigidCounters counters;
    std::unique_ptr<ContactMemory> memory;

    Rigid();
    ~Rigid();
    Rigid(Rigid&&) noexcept;
    Rigid& operator=(Rigid&&) noexcept;
};

/// Advances all bodies from `time` to `time + dt` under gravity and one constant wrench a body
/// (`loads[k]` acts on `bodies[k]`), with impacts located in time, and appends what happened to
/// `log`. The impulses in the log make up all that contact did to a body: M dV = sum of impulses +
/// M g dt + F dt to round-off. Torques act with the arms at the middle of a sub-step (`point`),
/// exact for impacts. Shapes, masses and locks must not change after the first step; a body may
/// leave between two steps, for good. Locked velocities are set to zero. With `penalty` set,
/// springs between particles take the place of impulses, and the log sums them over the step as
/// resting contacts. Source: the project's contact notes; Moreau (1988) for the time-discrete cone
/// law. `comm`: of ranks that all have the same bodies and call this together; they deal out the
/// clusters, and each has the motion and the log of one process. Null for one process.
void step(Rigid& rigid, double time, double dt, std::span<const Wrench> loads,
          std::vector<Contact>& log, Comm* comm = nullptr);

/// The contact forces of the last sub-step (warm start), with which a restarted run continues bit
/// for bit. One entry a contact.
struct ContactStart {
    std::vector<std::array<int, 9>> features; // the bodies, and which features of them touch
    std::vector<Vec3> forces;                 // on the first body [N]
    std::vector<Vec3> places;                 // in its axes, from its centre of mass [m]
    std::vector<Vec3> rubs;                   // in its axes, from there to the friction point [m]
    std::vector<int> stuck; // contacts of the patch that stuck together; 0: it slid
};
ContactStart contact_start(const Rigid& rigid);
/// Throws IoError if the lists differ in length.
void set_contact_start(Rigid& rigid, const ContactStart& start);

/// Largest distance of a point of the body from its centre of mass [m].
double bounding_radius(const Body& body, int dimensions);

/// Distance from the centre of a convex body, or of a part of one, to its nearest face: about half
/// of its thickness [m].
double inner_radius(const Body& body, int dimensions);

/// Depth by which two bodies, or a body and a boundary, overlap at `time` [m]; negative or zero if
/// they do not. `b` as in Contact.
double overlap(const Rigid& rigid, int a, int b, double time);

} // namespace hyoryu
