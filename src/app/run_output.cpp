// SPDX-License-Identifier: MIT
// Output of a run in progress: histories, frames and checkpoints.
#include "job.hpp"

#include "ranks.hpp"

#include "hyoryu/core/state.hpp"
#include "hyoryu/sim/checkpoint.hpp"
#include "hyoryu/sim/gauges.hpp"
#include "hyoryu/sim/state_parts.hpp"

namespace hyoryu {

namespace {

// Times a stage of output for the summary, on the process that writes the histories.
class Stage {
public:
    Stage(Job& job, const char* name) : job_(job)
    {
        if (job_.outputs) {
            job_.outputs->timer().begin(name);
        }
    }
    ~Stage()
    {
        if (job_.outputs) {
            job_.outputs->timer().end();
        }
    }
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;

private:
    Job& job_;
};

// Data that the process that writes the histories adds to its state.
Snapshot beside_simulation(const Job& job)
{
    Snapshot more;
    if (job.outputs) {
        job.outputs->save(more);
        more.texts["case"] = job.case_text;
        more.texts.insert(job.given.begin(), job.given.end());
    }
    return more;
}

// Arrays of two states as those of one.
StateOnDemand merged(StateOnDemand one, StateOnDemand other)
{
    StateOnDemand both{.bytes = one.bytes, .array = {}, .texts = std::move(one.texts)};
    both.bytes.insert(other.bytes.begin(), other.bytes.end());
    both.texts.merge(other.texts);
    both.array = [one = std::move(one), other = std::move(other)](const std::string& name) {
        return one.bytes.contains(name) ? one.array(name) : other.array(name);
    };
    return both;
}

// The present state of this process.
StateOnDemand present_state(const Job& job)
{
    return merged(state_of(job.sim), on_demand(beside_simulation(job)));
}

Snapshot made(const StateOnDemand& state)
{
    Snapshot snapshot;
    for (const auto& [name, bytes] : state.bytes) {
        snapshot.arrays[name] = state.array(name);
    }
    return snapshot;
}

// Writes a frame and keeps the state as the one to return to. Behind the first frame a checkpoint
// is written at once.
void write_frame(Job& job)
{
    {
        const Stage stage(job, "frames");
        if (job.outputs) {
            job.outputs->write_resting(job.sim);
        }
        count_in_solids(job.sim);
        job.frames->write(job.sim);
    }
    job.sim.clock.frame += 1;
    if (job.sim.clock.step > 0 || job.sim.scene.time.recover) {
        keep_good_state(job);
    }
    job.good_step = job.sim.clock.step;
    if (job.ranks != nullptr) {
        job.ranks->write(job.sim);
    }
}

// The parts that a leader writes are complete before the checkpoint names them.
std::vector<CheckpointPart> write_parts(Job& job, const StateOnDemand& particles)
{
    Comm& comm = *job.comm;
    const int rank = comm.rank();
    const std::int64_t set =
        value_of_root(comm, rank == 0 ? next_part_set(job.folder) : std::int64_t{0});
    CheckpointPart own;
    if (job.groups.leads(rank)) {
        own = write_checkpoint_part(job.folder, set, job.groups.of(rank), particles);
    }
    std::vector<Parcel> out(static_cast<std::size_t>(comm.size()));
    put_text(out.front(), own.name);
    put(out.front(), own.bytes);
    put(out.front(), own.checksum);
    const std::vector<Parcel> in = comm.exchange(std::move(out));
    std::vector<CheckpointPart> parts;
    for (int group = 0; rank == 0 && group < job.groups.count; ++group) {
        Unpacking from(in[static_cast<std::size_t>(job.groups.leader(group))]);
        parts.push_back({take_text(from), from.take<std::uint64_t>(), from.take<std::uint32_t>()});
    }
    return parts;
}

} // namespace

void keep_good_state(Job& job)
{
    const Stage stage(job, "good state");
    if (job.last_good) {
        job.last_good->replace(present_state(job));
    } else {
        job.last_good.emplace(job.folder, present_state(job));
    }
}

void update_outputs(Job& job)
{
    Simulation& sim = job.sim;
    if (job.outputs) {
        job.outputs->log_contacts(sim);
    }
    if (history_due(sim.clock, sim.scene)) {
        const Totals now = totals(sim); // of all processes
        if (job.outputs) {
            job.outputs->write_histories(sim, now);
        }
        sim.clock.history += 1;
    }
    if (!sim.scene.gauges.empty() && gauge_due(sim.clock, sim.scene)) {
        sim.timer.begin("gauges");
        const std::vector<double> readings = next_gauge_row(sim);
        if (job.outputs) {
            job.outputs->write_gauges(sim, readings);
        }
        sim.timer.end();
        sim.clock.gauge += 1;
    }
    if (frame_due(sim.clock, sim.scene)) {
        write_frame(job);
    }
}

void settle(Job& job)
{
    if (job.outputs) {
        job.outputs->settle();
    }
    job.frames->finish();
}

void write_checkpoint(Job& job)
{
    const Stage stage(job, "checkpoints");
    if (!job.sim.scene.time.recover) {
        job.last_good.reset();
    }
    settle(job); // frames on their way are nearly as large as the state
    write_state(job, present_state(job));
    job.saved_step = job.sim.clock.step;
}

void write_state(Job& job, StateOnDemand state)
{
    settle(job); // rows that the checkpoint counts as written must be on disk before it
    std::vector<CheckpointPart> parts;
    if (job.comm != nullptr && job.sim.fluid) {
        StateOnDemand particles = take_particles(job.sim, state);
        if (job.groups.count < job.groups.ranks) {
            particles =
                on_demand(gather_particles(job.sim, *job.comm, job.groups, made(particles)));
        }
        if (job.groups.count == 1) {
            particles.bytes.erase(rows_of_fixed_walls);
            state = merged(std::move(state), std::move(particles));
        } else {
            parts = write_parts(job, particles);
        }
    }
    if (writes(job.comm)) {
        write_checkpoint(job.folder, std::move(state), parts);
    }
}

} // namespace hyoryu
