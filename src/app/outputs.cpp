// SPDX-License-Identifier: MIT
#include "outputs.hpp"

#include "hyoryu/core/error.hpp"
#include "hyoryu/core/state.hpp"
#include "hyoryu/sim/gauges.hpp"
#include "tables.hpp"

#include <algorithm>
#include <initializer_list>
#include <utility>

namespace hyoryu {

namespace {

// The state of the outputs that a restart needs.
struct OutputState {
    std::int64_t bodies = 0, contacts = 0, energy = 0, gauges = 0,
                 open = 0; // rows of the histories
    std::vector<RestingPair> resting;
    bool has_open = false; // whether there are open sides, which the case says
};

template <class State, class Output>
void describe_outputs(State& state, Output& output)
{
    state("rows/bodies", "", output.bodies);
    state("rows/contacts", "", output.contacts);
    state("rows/energy", "", output.energy);
    state("rows/gauges", "", output.gauges);
    if (output.has_open) {
        state("rows/open", "", output.open);
    }
    auto& resting = output.resting;
    const auto sum = [](auto member) {
        return [member](auto& rest) -> auto&
        {
            return rest.sum.*member;
        };
    };
    state.resize("resting/time", resting, &RestingPair::time);
    state.each("resting/time", "s", resting, &RestingPair::time);
    state.each("resting/weight", "", resting, &RestingPair::weight);
    state.each("resting/a", "", resting, sum(&Contact::a));
    state.each("resting/b", "", resting, sum(&Contact::b));
    state.each("resting/point", "m", resting, sum(&Contact::point));
    state.each("resting/normal", "", resting, sum(&Contact::normal));
    state.each("resting/approach_speed", "m/s", resting, sum(&Contact::approach_speed));
    state.each("resting/normal_impulse", "N s", resting, sum(&Contact::normal_impulse));
    state.each("resting/tangential_impulse", "N s", resting, sum(&Contact::tangential_impulse));
    state.each("resting/effective_mass", "kg", resting, sum(&Contact::effective_mass));
    state.each("resting/energy_lost", "J", resting, sum(&Contact::energy_lost));
    state.each("resting/located", "", resting, sum(&Contact::located));
}

// The numbers of a vector, or of a list in braces.
template <class Values = std::initializer_list<double>>
void append(std::vector<std::string>& row, const Values& values)
{
    for (const double value : values) {
        row.push_back(cell(value));
    }
}

// The two that touch are bodies, or a body and a wall, of this case.
bool is_of(const Simulation& sim, const Contact& contact)
{
    const auto bodies = static_cast<int>(sim.rigid.bodies.size());
    const auto walls = static_cast<int>(sim.rigid.boundaries.size());
    return contact.a >= 0 && contact.a < bodies && contact.b >= -walls && contact.b < bodies;
}

} // namespace

Outputs::Outputs(std::filesystem::path folder, const Simulation& sim, const Snapshot* resumed)
    : folder_(std::move(folder))
{
    const int d = sim.scene.dimensions;
    OutputState state;
    state.has_open = !sim.scene.open.empty();
    if (resumed != nullptr) {
        StateReader reader(*resumed);
        describe_outputs(reader, state);
    }
    const auto open = [&](std::optional<History>& history, const Table& table, std::int64_t rows) {
        if (resumed != nullptr) {
            history.emplace(folder_, table, sim.clock.time, rows);
        } else {
            history.emplace(folder_, table);
        }
    };
    if (!sim.scene.bodies.empty()) {
        open(bodies_, bodies_table(d), state.bodies);
    }
    if (sim.plan.contact) {
        open(contacts_, contacts_table(d), state.contacts);
    }
    open(energy_, energy_table(sim.scene), state.energy);
    if (!sim.scene.gauges.empty()) {
        open(gauges_, gauges_table(gauge_heads(sim.scene)), state.gauges);
    }
    if (!sim.scene.open.empty()) {
        open(open_, open_table(sim.scene), state.open);
    }
    for (RestingPair& rest : state.resting) {
        if (!is_of(sim, rest.sum)) {
            throw IoError("the checkpoint has a contact of an unknown body: it is damaged");
        }
        rest.sum.kind = Contact::Kind::resting;
        rest.sum.time = rest.time;
        resting_[{rest.sum.a, rest.sum.b}] = rest;
    }
}

void Outputs::write_histories(const Simulation& sim, const Totals& now)
{
    timer_.begin("histories");
    write_bodies(sim);
    write_energy(sim, now);
    write_open(sim);
    timer_.end();
}

void Outputs::write_gauges(const Simulation& sim, const std::vector<double>& readings)
{
    std::vector<std::string> row{cell(sim.clock.time)};
    append(row, readings);
    gauges_->append(row);
}

void Outputs::write_bodies(const Simulation& sim)
{
    for (std::size_t b = 0; b < sim.rigid.bodies.size(); ++b) {
        const Body& body = sim.rigid.bodies[b];
        if (body.left) {
            continue;
        }
        const Quat& q = body.orientation;
        std::vector<std::string> row{cell(sim.clock.time), cell(std::string_view(body.name))};
        append(row, body.position);
        append(row, {q.w(), q.x(), q.y(), q.z()});
        append(row, body.velocity);
        append(row, angular_velocity(body));
        append(row, sim.loads.bodies[b].force);
        append(row, sim.loads.bodies[b].torque);
        bodies_->append(row);
    }
}

void Outputs::write_energy(const Simulation& sim, const Totals& t)
{
    std::vector<std::string> row;
    append(row, {sim.clock.time, t.fluid_kinetic, t.fluid_potential, t.fluid_internal,
                 t.body_kinetic, t.body_potential, sim.conservation.contact_loss});
    append(row, t.momentum);
    append(row, sim.conservation.wall_impulse);
    append(row, sim.conservation.gravity_impulse);
    const LostParticles lost = sim.fluid ? sim.fluid->lost : LostParticles{};
    row.push_back(cell(lost.energy));
    append(row, lost.momentum);
    if (open_) {
        row.push_back(cell(sim.open.boundary.energy));
        append(row, sim.open.boundary.impulse);
    }
    energy_->append(row);
}

void Outputs::write_open(const Simulation& sim)
{
    if (!open_) {
        return;
    }
    std::vector<std::string> row{cell(sim.clock.time)};
    for (std::size_t k = 0; k < sim.open.boundary.carpets.size(); ++k) {
        const OpenReading r = reading_of(sim, k);
        append(row, {r.level, r.velocity, r.discharge, r.volume_in, r.volume_out, r.volume_asked});
    }
    open_->append(row);
}

void Outputs::write_contact(const Simulation& sim, const Contact& c)
{
    const std::string& other = c.b >= 0
                                   ? sim.rigid.bodies[static_cast<std::size_t>(c.b)].name
                                   : sim.rigid.boundaries[static_cast<std::size_t>(-1 - c.b)].name;
    std::vector<std::string> row{
        cell(c.time), cell(std::string_view(sim.rigid.bodies[static_cast<std::size_t>(c.a)].name)),
        cell(std::string_view(other))};
    append(row, c.point);
    append(row, c.normal);
    append(row, {c.approach_speed, c.normal_impulse});
    append(row, c.tangential_impulse);
    append(row, {c.energy_lost, c.effective_mass});
    row.push_back(c.kind == Contact::Kind::impact ? "impact" : "resting");
    row.push_back(c.located ? "1" : "0");
    contacts_->append(row);
}

void Outputs::log_contacts(const Simulation& sim)
{
    timer_.begin("histories");
    for (const Contact& contact : sim.contacts) {
        if (contact.kind == Contact::Kind::impact) {
            write_contact(sim, contact);
            continue;
        }
        // Impulses add up as vectors; place and normal are means weighted with the normal impulse.
        RestingPair& rest = resting_[{contact.a, contact.b}];
        const double before = rest.weight;
        rest.weight += contact.normal_impulse;
        rest.time = sim.clock.time;
        Contact sum = contact;
        if (before > 0 && rest.weight > 0) {
            const double share = contact.normal_impulse / rest.weight;
            sum.point = rest.sum.point + share * (contact.point - rest.sum.point);
            sum.normal =
                (rest.sum.normal + share * (contact.normal - rest.sum.normal)).normalized();
        }
        const Vec3 impulse = rest.sum.normal_impulse * rest.sum.normal +
                             rest.sum.tangential_impulse + contact.normal_impulse * contact.normal +
                             contact.tangential_impulse;
        sum.normal_impulse = impulse.dot(sum.normal);
        sum.tangential_impulse = impulse - sum.normal_impulse * sum.normal;
        sum.energy_lost += rest.sum.energy_lost;
        sum.located = sum.located && rest.sum.located;
        rest.sum = sum;
    }
    timer_.end();
}

void Outputs::write_resting(const Simulation& sim)
{
    for (auto& [key, rest] : resting_) {
        rest.sum.time = rest.time;
        write_contact(sim, rest.sum);
    }
    resting_.clear();
}

void Outputs::save(Snapshot& state) const
{
    const auto rows = [](const auto& history) { return history ? history->rows() : 0; };
    OutputState output{rows(bodies_),    rows(contacts_), rows(energy_),
                       rows(gauges_),    rows(open_),     {},
                       open_.has_value()};
    for (const auto& [key, rest] : resting_) {
        output.resting.push_back(rest);
    }
    StateWriter writer(state);
    describe_outputs(writer, output);
}

void Outputs::settle()
{
    for (auto* history : {&bodies_, &contacts_, &energy_, &gauges_, &open_}) {
        if (*history) {
            (*history)->flush();
        }
    }
}

} // namespace hyoryu
