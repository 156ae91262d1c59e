// SPDX-License-Identifier: MIT
#include "outputs.hpp"

#include "hyoryu/core/error.hpp"
#include "hyoryu/scene/moving_walls.hpp"
#include "hyoryu/sim/checkpoint.hpp"
#include "hyoryu/sim/frames.hpp"
#include "hyoryu/sim/gauges.hpp"
#include "tables.hpp"

#include <algorithm>
#include <utility>

namespace hyoryu {

namespace {

constexpr const char* resting_array = "outputs/resting";
constexpr const char* rows_array = "outputs/rows"; // of bodies, contacts, energy, gauges

std::vector<std::string> cells(std::initializer_list<double> values)
{
    std::vector<std::string> row;
    for (const double value : values) {
        row.push_back(cell(value));
    }
    return row;
}

void append(std::vector<std::string>& row, const Vec3& v)
{
    for (const double value : v) {
        row.push_back(cell(value));
    }
}

const std::vector<std::int64_t>& rows_in(const Snapshot& snapshot)
{
    const auto found = snapshot.arrays.find(rows_array);
    const auto* rows = found == snapshot.arrays.end()
                           ? nullptr
                           : std::get_if<std::vector<std::int64_t>>(&found->second.values);
    if (rows == nullptr || rows->size() != 4) {
        throw IoError(
            "the checkpoint has no row counts of the histories: it was written by another version");
    }
    return *rows;
}

// The two that touch are bodies, or a body and a wall, of this case.
bool is_of(const Simulation& sim, const Contact& contact)
{
    const auto bodies = static_cast<int>(sim.rigid.bodies.size());
    const auto walls = static_cast<int>(sim.rigid.boundaries.size());
    return contact.a >= 0 && contact.a < bodies && contact.b >= -walls && contact.b < bodies;
}

} // namespace

Outputs::Outputs(std::filesystem::path folder, const Simulation& sim, const Bounds& domain)
    : folder_(std::move(folder)), frames_(std::make_unique<FrameWriter>(folder_))
{
    const int d = sim.scene.dimensions;
    if (!sim.scene.bodies.empty()) {
        bodies_.emplace(folder_, bodies_table(d));
    }
    if (sim.plan.contact) {
        contacts_.emplace(folder_, contacts_table(d));
    }
    energy_.emplace(folder_, energy_table(d));
    if (!sim.scene.gauges.empty()) {
        gauges_.emplace(folder_, gauges_table(gauge_heads(sim.scene)));
    }
    if (sim.fluid && sim.plan.counts.wall > 0) {
        frames_->write_static(wall_cloud(sim));
    }
    if (!sim.scene.walls.empty()) {
        frames_->write_static(wall_surface(sim.scene, domain, {}));
    }
}

Outputs::Outputs(std::filesystem::path folder, const Simulation& sim, const Snapshot& resumed)
    : folder_(std::move(folder)), frames_(std::make_unique<FrameWriter>(folder_))
{
    const int d = sim.scene.dimensions;
    const double now = sim.clock.time;
    const std::vector<std::int64_t>& rows = rows_in(resumed);
    if (!sim.scene.bodies.empty()) {
        bodies_.emplace(folder_, bodies_table(d), now, rows[0]);
    }
    if (sim.plan.contact) {
        contacts_.emplace(folder_, contacts_table(d), now, rows[1]);
    }
    energy_.emplace(folder_, energy_table(d), now, rows[2]);
    if (!sim.scene.gauges.empty()) {
        gauges_.emplace(folder_, gauges_table(gauge_heads(sim.scene)), now, rows[3]);
    }
    frames_->forget_after(now); // behind the histories, which may refuse
    const auto found = resumed.arrays.find(resting_array);
    if (found != resumed.arrays.end()) {
        if (!std::holds_alternative<std::vector<double>>(found->second.values)) {
            throw IoError("the contacts of the checkpoint are not numbers: it is damaged");
        }
        const auto& n = std::get<std::vector<double>>(found->second.values);
        for (std::size_t k = 0; k + resting_numbers <= n.size(); k += resting_numbers) {
            const Contact sum = contact_of(std::span(n).subspan(k, resting_numbers));
            if (!is_of(sim, sum)) {
                throw IoError("the checkpoint has a contact of an unknown body: it is damaged");
            }
            resting_[{sum.a, sum.b}] = {sum.time, sum, n[k + resting_numbers - 1]};
        }
    }
}

void Outputs::update(Simulation& sim)
{
    timer_.begin("histories");
    log_contacts(sim);
    if (history_due(sim.clock, sim.scene)) {
        write_histories(sim);
        sim.clock.history += 1;
    }
    timer_.end();
    if (gauges_ && gauge_due(sim.clock, sim.scene)) {
        write_gauges(sim);
        sim.clock.gauge += 1;
    }
    if (frame_due(sim.clock, sim.scene)) {
        timer_.begin("frames");
        write_resting(sim);
        count_in_solids(sim);
        write_frame(sim);
        sim.clock.frame += 1;
        timer_.end();
    }
}

void Outputs::write_histories(const Simulation& sim)
{
    write_bodies(sim);
    write_energy(sim);
}

void Outputs::write_gauges(Simulation& sim)
{
    sim.timer.begin("gauges");
    std::vector<std::string> row = cells({sim.clock.time});
    for (const double reading : next_gauge_row(sim)) {
        row.push_back(cell(reading));
    }
    gauges_->append(row);
    sim.timer.end();
}

void Outputs::write_bodies(const Simulation& sim)
{
    for (std::size_t b = 0; b < sim.rigid.bodies.size(); ++b) {
        const Body& body = sim.rigid.bodies[b];
        const Quat& q = body.orientation;
        std::vector<std::string> row{cell(sim.clock.time), cell(std::string_view(body.name))};
        append(row, body.position);
        for (const double value : {q.w(), q.x(), q.y(), q.z()}) {
            row.push_back(cell(value));
        }
        append(row, body.velocity);
        append(row, angular_velocity(body));
        append(row, sim.loads.bodies[b].force);
        append(row, sim.loads.bodies[b].torque);
        bodies_->append(row);
    }
}

void Outputs::write_energy(const Simulation& sim)
{
    const Totals t = totals(sim);
    std::vector<std::string> row =
        cells({sim.clock.time, t.fluid_kinetic, t.fluid_potential, t.fluid_internal, t.body_kinetic,
               t.body_potential, sim.conservation.contact_loss});
    append(row, t.momentum);
    append(row, sim.conservation.wall_impulse);
    append(row, sim.conservation.gravity_impulse);
    const LostParticles lost = sim.fluid ? sim.fluid->lost : LostParticles{};
    row.push_back(cell(lost.energy));
    append(row, lost.momentum);
    energy_->append(row);
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
    row.push_back(cell(c.approach_speed));
    row.push_back(cell(c.normal_impulse));
    append(row, c.tangential_impulse);
    row.push_back(cell(c.energy_lost));
    row.push_back(cell(c.effective_mass));
    row.push_back(c.kind == Contact::Kind::impact ? "impact" : "resting");
    row.push_back(c.located ? "1" : "0");
    contacts_->append(row);
}

void Outputs::log_contacts(const Simulation& sim)
{
    for (const Contact& contact : sim.contacts) {
        if (contact.kind == Contact::Kind::impact) {
            write_contact(sim, contact);
            continue;
        }
        // Impulses add up as vectors; place and normal are means weighted with the normal impulse.
        Resting& rest = resting_[{contact.a, contact.b}];
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
}

void Outputs::write_resting(const Simulation& sim)
{
    for (auto& [key, rest] : resting_) {
        rest.sum.time = rest.time;
        write_contact(sim, rest.sum);
    }
    resting_.clear();
}

void Outputs::write_frame(const Simulation& sim)
{
    if (sim.fluid) {
        frames_->write(fluid_cloud(sim));
    }
    if (!sim.scene.bodies.empty()) {
        frames_->write(body_cloud(sim));
        frames_->write(body_surface(sim));
    }
    if (has_moving_walls(sim.scene)) {
        if (sim.fluid) {
            frames_->write(wall_cloud(sim));
        }
        frames_->write(wall_surface(sim.scene, domain_of(sim.scene), sim.clock));
    }
}

Snapshot Outputs::snapshot(const Simulation& sim) const
{
    Snapshot snapshot = save(sim);
    std::vector<double> numbers;
    for (const auto& [key, rest] : resting_) {
        Contact sum = rest.sum;
        sum.time = rest.time;
        const std::vector<double> row = numbers_of(sum);
        numbers.insert(numbers.end(), row.begin(), row.end());
        numbers.push_back(rest.weight);
    }
    std::vector<std::int64_t> rows;
    for (const auto* history : {&bodies_, &contacts_, &energy_, &gauges_}) {
        rows.push_back(*history ? (*history)->rows() : 0);
    }
    snapshot.arrays[rows_array] = {rows_array, "", 1, std::move(rows)};
    snapshot.arrays[resting_array] = {resting_array, "", 1, std::move(numbers)};
    return snapshot;
}

void Outputs::settle()
{
    for (auto* history : {&bodies_, &contacts_, &energy_, &gauges_}) {
        if (*history) {
            (*history)->flush();
        }
    }
    frames_->finish();
}

void Outputs::write_checkpoint(Snapshot snapshot)
{
    settle(); // rows that the checkpoint counts as written must be on disk before it
    hyoryu::write_checkpoint(folder_, std::move(snapshot));
}

void Outputs::close_interval(const Simulation& sim)
{
    write_resting(sim);
}

} // namespace hyoryu
