// SPDX-License-Identifier: MIT
// Output of a run in progress: histories, frames and the checkpoint.
#pragma once

#include "hyoryu/io/results.hpp"
#include "hyoryu/sim/simulation.hpp"

#include <map>
#include <memory>
#include <optional>

namespace hyoryu {

/// What a pair has exchanged since the last history row.
struct RestingPair {
    double time = 0; // of the last contact [s]
    Contact sum;
    double weight = 0;
};

/// Whether output is due besides the contacts of a step, and its count in the clock.
bool any_due(const Simulation& sim);
void count_due(Clock& clock, const Scene& scene);

class Outputs {
public:
    /// Opens all files; a resumed run keeps the rows up to the present time of `sim`.
    Outputs(std::filesystem::path folder, const Simulation& sim, const Bounds& domain);
    Outputs(std::filesystem::path folder, const Simulation& sim, const Snapshot& resumed);

    /// Writes all due output; called after each step and once before the first.
    void update(Simulation& sim);
    /// The state for a restart: of the simulation and of the sums below.
    Snapshot snapshot(const Simulation& sim) const;
    /// Waits until all rows and frames so far are on disk.
    void settle();
    void write_checkpoint(Snapshot snapshot);
    /// At the end of a run: writes the resting contacts since the last frame.
    void close_interval(const Simulation& sim);
    /// Cost of the thread that writes frames.
    FrameWriter::Cost frame_cost() const { return frames_->cost(); }
    /// Time of the solver thread by kind of output.
    StageTimer& timer() { return timer_; }

private:
    // Sum of the resting contacts of one pair over the present output interval.
    using PairKey = std::pair<int, int>;

    void write_histories(const Simulation& sim);
    void write_bodies(const Simulation& sim);
    void write_energy(const Simulation& sim);
    void write_open(const Simulation& sim);
    void write_gauges(Simulation& sim);
    void log_contacts(const Simulation& sim);
    void write_contact(const Simulation& sim, const Contact& contact);
    void write_resting(const Simulation& sim);
    void write_frame(const Simulation& sim);

    std::filesystem::path folder_;
    std::unique_ptr<FrameWriter> frames_;
    std::optional<History> bodies_, contacts_, energy_, gauges_, open_;
    std::map<PairKey, RestingPair> resting_;
    StageTimer timer_;
};

} // namespace hyoryu
