// SPDX-License-Identifier: MIT
#include "frame_output.hpp"

#include "hyoryu/fluid/whole.hpp"
#include "hyoryu/ranks/columns.hpp"
#include "hyoryu/scene/moving_walls.hpp"
#include "hyoryu/sim/frames.hpp"

#include <optional>
#include <utility>

namespace hyoryu {

namespace {

void put_cloud(Parcel& parcel, const Cloud& cloud)
{
    put_column(parcel, {"", "", 3, cloud.points});
    put(parcel, cloud.columns.size());
    for (const Column& column : cloud.columns) {
        put_column(parcel, column);
    }
}

// Points of the same cloud, of another process.
Cloud take_cloud(Unpacking& from, const Cloud& like)
{
    Cloud cloud{like.name, like.time, like.index};
    cloud.points = std::get<std::vector<float>>(take_column(from).values);
    for (auto left = from.take<std::size_t>(); left > 0; --left) {
        cloud.columns.push_back(take_column(from));
    }
    return cloud;
}

std::int64_t points_in(const Cloud& cloud)
{
    return std::ssize(cloud.points) / 3;
}

// Wall particles whose numbers a group writes.
NumberRange share_of(const NumberRange& all, int group, int groups)
{
    const std::int64_t count = all.end - all.begin;
    return {all.begin + count * group / groups, all.begin + count * (group + 1) / groups};
}

} // namespace

FrameOutput::FrameOutput(const std::filesystem::path& folder, Comm* comm, const Groups& groups)
    : comm_(comm), groups_(groups)
{
    if (comm == nullptr || groups.leads(comm->rank())) {
        files_ = std::make_unique<FrameWriter>(folder);
    }
}

void FrameOutput::write_static(const Simulation& sim, const Bounds& domain)
{
    if (sim.fluid && sim.plan.counts.wall > 0) {
        write_walls(sim, FramePlace::alone);
    }
    if (!sim.scene.walls.empty() && is_first()) {
        files_->write(wall_surface(sim.scene, domain, {}), FramePlace::alone);
    }
}

void FrameOutput::write(const Simulation& sim)
{
    if (sim.fluid) {
        write_cloud(fluid_cloud(sim), FramePlace::series);
    }
    if (!sim.scene.bodies.empty()) {
        std::optional<Store> particles;
        if (sim.fluid && sim.fluid->ghosts) {
            particles.emplace(whole_bodies(*sim.fluid));
        }
        if (is_first()) {
            files_->write(particles ? body_cloud(sim, &*particles) : body_cloud(sim));
            files_->write(body_surface(sim));
        }
    }
    if (has_moving_walls(sim.scene)) {
        if (sim.fluid) {
            write_walls(sim, FramePlace::series);
        }
        if (is_first()) {
            files_->write(wall_surface(sim.scene, domain_of(sim.scene), sim.clock));
        }
    }
}

void FrameOutput::write_walls(const Simulation& sim, FramePlace place)
{
    write_cloud(comm_ == nullptr ? wall_cloud(sim) : share_of_walls(sim), place);
}

// A wall particle belongs to the process of its tile, but a file contains a range of particle
// numbers: each process sends its particles to the process that writes their range.
Cloud FrameOutput::share_of_walls(const Simulation& sim) const
{
    const Cloud own = wall_rows_cloud(sim);
    const NumberRange all = all_walls(sim);
    std::vector<std::vector<std::int32_t>> rows(at(groups_.count));
    const std::vector<std::int64_t> numbers = numbers_in(own);
    for (int group = 0; group < groups_.count; ++group) {
        const NumberRange range = share_of(all, group, groups_.count);
        for (std::size_t k = 0; k < numbers.size(); ++k) {
            if (numbers[k] >= range.begin && numbers[k] < range.end) {
                rows[at(group)].push_back(static_cast<std::int32_t>(k));
            }
        }
    }
    std::vector<Parcel> out(at(comm_->size()));
    for (int group = 0; group < groups_.count; ++group) {
        put_cloud(out[at(groups_.leader(group))], some_points(own, rows[at(group)]));
    }
    const std::vector<Parcel> in = comm_->exchange(std::move(out));
    Cloud gathered = some_points(own, {});
    if (!groups_.leads(comm_->rank())) {
        return gathered;
    }
    for (const Parcel& parcel : in) {
        Unpacking from(parcel);
        append_points(gathered, take_cloud(from, own));
    }
    return wall_cloud(sim, std::move(gathered),
                      share_of(all, groups_.of(comm_->rank()), groups_.count));
}

void FrameOutput::write_cloud(Cloud own, FramePlace place)
{
    if (comm_ != nullptr) {
        write_shared(std::move(own), place);
    } else {
        files_->write(std::move(own), place);
    }
}

// The points of a group, on its leader.
Cloud FrameOutput::gathered(Cloud own, const Cloud& head) const
{
    if (groups_.count == groups_.ranks) {
        return own;
    }
    Cloud all = head;
    const auto pack = [&] {
        Parcel parcel;
        put_cloud(parcel, std::exchange(own, {}));
        return parcel;
    };
    gather_in_groups(*comm_, groups_, pack,
                     [&](Unpacking from) { append_points(all, take_cloud(from, head)); });
    return all;
}

void FrameOutput::write_shared(Cloud own, FramePlace place)
{
    const Cloud head = some_points(own, {});
    Cloud all = gathered(std::move(own), head);
    const std::int64_t count = points_in(all);
    const std::vector<std::int64_t> counts =
        gather(*comm_, std::span<const std::int64_t>(&count, 1)).all;
    if (!files_) {
        return;
    }
    if (groups_.count == 1) {
        files_->write(std::move(all), place);
        return;
    }
    files_->write(std::move(all), place, groups_.of(comm_->rank()));
    if (is_first()) {
        CloudOfParts whole{head.name, head.time, head.index, {}, head.columns};
        for (int group = 0; group < groups_.count; ++group) {
            whole.points.push_back(counts[at(groups_.leader(group))]);
        }
        files_->write(std::move(whole), place);
    }
}

void FrameOutput::forget_after(double time)
{
    finish();
    if (comm_ != nullptr) { // all parts on their way are there
        value_of_root(*comm_, 0);
    }
    if (is_first()) {
        files_->forget_after(time);
    }
}

std::vector<std::filesystem::path> FrameOutput::missing()
{
    return is_first() ? files_->missing() : std::vector<std::filesystem::path>();
}

void FrameOutput::finish()
{
    if (files_) {
        files_->finish();
    }
}

FrameWriter::Cost FrameOutput::cost() const
{
    return files_ ? files_->cost() : FrameWriter::Cost{};
}

} // namespace hyoryu
