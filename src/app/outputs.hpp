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

class Outputs {
public:
    /// Opens all files; a resumed run keeps the rows up to the present time of `sim`.
    Outputs(std::filesystem::path folder, const Simulation& sim, const Bounds& domain);
    Outputs(std::filesystem::path folder, const Simulation& sim, const Snapshot& resumed);

    // What is due, in this order; called after each step and once before the first.
    /// The contacts of the step.
    void log_contacts(const Simulation& sim);
    /// A row of the histories; `now`: its sums.
    void write_histories(const Simulation& sim, const Totals& now);
    /// A row of the gauges: their readings.
    void write_gauges(const Simulation& sim, const std::vector<double>& readings);
    /// A frame, and the contacts that rest since the last one.
    void write_frame(Simulation& sim);
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

    void write_bodies(const Simulation& sim);
    void write_energy(const Simulation& sim, const Totals& now);
    void write_open(const Simulation& sim);
    void write_contact(const Simulation& sim, const Contact& contact);
    void write_resting(const Simulation& sim);
    void write_clouds(const Simulation& sim);

    std::filesystem::path folder_;
    std::unique_ptr<FrameWriter> frames_;
    std::optional<History> bodies_, contacts_, energy_, gauges_, open_;
    std::map<PairKey, RestingPair> resting_;
    StageTimer timer_;
};

} // namespace hyoryu
