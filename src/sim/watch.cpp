// SPDX-License-Identifier: MIT
#include "hyoryu/sim/watch.hpp"

#include "crush_check.hpp"
#include "diagnostics.hpp"

#include "hyoryu/core/error.hpp"
#include "hyoryu/scene/moving_walls.hpp"
#include "hyoryu/scene/plan_slips.hpp"
#include "hyoryu/sim/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

// Gain of energy, relative to the energy of motion and compression and to the scale of the scene,
// beyond which a run is unstable. The hard cases gain 1 % at most, also at twice the step; an
// unstable run exceeds a fifth within a few steps, and may be below it again at the next frame.
constexpr double gain_of_motion = 0.2;
constexpr double gain_of_scale = 0.01;

std::string probable_cause(const Simulation& sim)
{
    if (sim.scene.time.step) {
        return "probably the fixed `time.step` is too long";
    }
    if (sim.scene.time.cfl > 0.6) {
        return fmt::format("probably `time.cfl` = {} is too large; 0.6 is the default",
                           sim.scene.time.cfl);
    }
    if (const std::string cut = cut_by_domain(sim.scene); !cut.empty()) {
        return fmt::format("probably [domain] is too small: {} reaches beyond it", cut);
    }
    if (sim.scene.fluid && std::holds_alternative<Off>(sim.scene.fluid->effects[slot::viscosity])) {
        return "probably the fluid has no damping: `fluid.viscosity.model` is \"none\"";
    }
    if (sim.fluid && effective_viscosity(*sim.fluid) == 0) {
        return "probably the fluid has no damping: its coefficient in [fluid.viscosity] is 0";
    }
    if (sim.plan.fluid && sim.plan.expected_speed > 0.2 * sim.plan.fluid->eos.c0) {
        return "probably `fluid.sound_speed` is too low for the speeds of this flow";
    }
    return "probably an overlap at the start, a body thinner than 3 spacings, or fluid squeezed "
           "between solids";
}

[[noreturn]] void report(const Simulation& sim, std::string who, std::string field_name,
                         std::string cause)
{
    throw NumericalError(
        {sim.clock.step, sim.clock.time, std::move(who), std::move(field_name), std::move(cause)});
}

// The parts of an error message: the particle, its state and the cause.
using Complaint = std::array<std::string, 3>;

Complaint complaint_of(const Simulation& sim, std::size_t row)
{
    const Store& store = sim.fluid->particles.fluid;
    const Vec3& x = store[field::position][row];
    return {fmt::format("fluid particle {} at ({:.4g}, {:.4g}, {:.4g}) m", store.id()[row], x.x(),
                        x.y(), x.z()),
            fmt::format("density {:.4g} kg/m3, speed {:.4g} m/s", store[field::density][row],
                        store[field::velocity][row].norm()),
            probable_cause(sim) + "; " + nearby_particles(sim, row)};
}

// The complaint of the first rank that has one; every rank makes it its own.
Complaint first_complaint(Comm& comm, const std::optional<Complaint>& own)
{
    Parcel parcel;
    if (own) {
        for (const std::string& text : *own) {
            put_text(parcel, text);
        }
    }
    const auto ranks = at(comm.size());
    const std::vector<Parcel> in = comm.exchange(std::vector<Parcel>(ranks, parcel));
    const auto first = std::ranges::find_if(in, [](const Parcel& p) { return !p.empty(); });
    Complaint complaint;
    Unpacking from(*first);
    for (std::string& text : complaint) {
        text = take_text(from);
    }
    return complaint;
}

// Reports the first particle for which bad(row) holds; there is one on a rank at least.
[[noreturn]] void report_particle(Simulation& sim, const auto& bad)
{
    share_places(*sim.fluid); // as they are now, for what is near
    const Store& store = sim.fluid->particles.fluid;
    Index row = 0;
    while (row < store.size() && !bad(row)) {
        ++row;
    }
    std::optional<Complaint> own;
    if (row < store.size()) {
        own = complaint_of(sim, at(row));
    }
    const Ghosts* const g = sim.fluid->ghosts.get();
    const Complaint said = g != nullptr ? first_complaint(g->comm, own) : own.value();
    report(sim, said[0], said[1], said[2]);
}

std::string cause_of_overlap(const Simulation& sim)
{
    if (sim.clock.step <= 1) {
        return "they overlap at the start";
    }
    const std::string step =
        fmt::format("the step of {:.3g} s is too long for the thinnest body, whose inner radius is "
                    "{:.3g} m; {}",
                    sim.clock.dt, sim.thinnest,
                    sim.scene.time.step ? "shorten `time.step`"
                                        : "set `time.recover = true`, or a shorter `time.step`");
    return has_moving_walls(sim.scene) ? "probably a moving wall leaves them no space, or " + step
                                       : "probably " + step;
}

void watch_bodies(const Simulation& sim)
{
    for (const Body& body : sim.rigid.bodies) {
        const bool finite = body.position.allFinite() && body.velocity.allFinite() &&
                            body.angular_momentum.allFinite() &&
                            body.orientation.coeffs().allFinite();
        if (!finite) {
            report(sim, fmt::format("body \"{}\"", body.name), "pose or velocity is not finite",
                   "probably its mass or a load on it is extreme; compare them with those of other "
                   "bodies");
        }
    }
    if (const auto body = crushed(sim)) {
        report(sim, fmt::format("body \"{}\"", body->name),
               fmt::format("wall \"{}\" presses it against {}, {:.4g} m of space are missing",
                           body->from, body->against, body->missing),
               "over-constrained: the moving wall leaves no space for it");
    }
    if (sim.rigid.counters.worst_penetration > sim.thinnest) {
        const Overlap deepest = deepest_overlap(sim);
        report(sim, deepest.pair, fmt::format("they overlap by {:.4g} m", deepest.depth),
               cause_of_overlap(sim));
    }
}

bool driven(const Simulation& sim)
{
    const RigidSettings& contact = sim.rigid.settings;
    const bool streams = std::ranges::any_of(sim.scene.sponges, [](const Sponge& sponge) {
        return sponge.pressure || !sponge.velocity.isZero(0);
    });
    return has_moving_walls(sim.scene) || streams || sim.open.runs() ||
           (sim.fluid && !sim.fluid->parameters.drive.isZero(0)) || sim.rigid.penalty ||
           contact.law != ImpactLaw::coupled;
}

double energy(const Totals& t)
{
    return t.fluid_kinetic + t.fluid_potential + t.fluid_internal + t.body_kinetic +
           t.body_potential;
}

} // namespace

void watch(Simulation& sim, const StateSurvey& now)
{
    if (sim.fluid) {
        const double worst = now.compression;
        if (worst == infinity) {
            const Compression compression(*sim.fluid);
            report_particle(sim, [&](Index row) { return compression(row) == infinity; });
        }
        sim.conservation.worst_density_error =
            std::max(sim.conservation.worst_density_error, worst);
    }
    watch_bodies(sim);
}

void watch_energy(const Simulation& sim, const Totals& now)
{
    if (driven(sim)) {
        return;
    }
    const double lost = sim.fluid ? sim.fluid->lost.energy : 0;
    const double gain = energy(now) + lost - energy(sim.conservation.start);
    const double motion = now.fluid_kinetic + now.fluid_internal + now.body_kinetic;
    // False for sums that are not a number, as those with a term out of all range are.
    const bool bounded =
        gain <= gain_of_motion * motion || gain <= gain_of_scale * energy_scale(sim);
    if (!bounded) {
        report(sim, "the whole scene",
               fmt::format("energy has grown by {:.4g} J; its kinetic energy is {:.4g} J", gain,
                           motion),
               probable_cause(sim));
    }
}

double worst_penetration(const Simulation& sim)
{
    const double seen = sim.rigid.counters.worst_penetration;
    return sim.rigid.penalty ? seen : std::max(seen, deepest_overlap(sim).depth);
}

std::vector<int> bodies_outside(const Simulation& sim)
{
    std::vector<int> outside;
    for (std::size_t b = 0; sim.fluid && b < sim.rigid.bodies.size(); ++b) {
        const Body& body = sim.rigid.bodies[b];
        bool is_out = false;
        for (int axis = 0; axis < 3 && !body.left && !is_fixed(body); ++axis) {
            const Vec3 n = Vec3::Unit(axis);
            const double low = sim.fluid->domain_min[axis];
            const double high = sim.fluid->domain_max[axis];
            const bool below = body.position[axis] + reach_along(body, n) < low;
            const bool beyond = axis < 2 && body.position[axis] - reach_along(body, -n) > high;
            is_out = is_out || (!(axis == 1 && sim.scene.dimensions == 2) && (below || beyond));
        }
        if (is_out) {
            outside.push_back(static_cast<int>(b));
        }
    }
    return outside;
}

} // namespace hyoryu
