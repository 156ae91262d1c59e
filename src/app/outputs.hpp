// SPDX-License-Identifier: MIT
// Histories of a run in progress.
#pragma once

#include "hyoryu/io/results.hpp"
#include "hyoryu/sim/simulation.hpp"

#include <map>
#include <optional>

namespace hyoryu {

/// Impulses that a pair in contact has exchanged since the last row for it.
struct RestingPair {
    double time = 0; // of the last contact [s]
    Contact sum;
    double weight = 0;
};

class Outputs {
public:
    /// Opens all files. `resumed`: the state of a run that goes on, which keeps the rows up to the
    /// present time of `sim`; null: a new one.
    Outputs(std::filesystem::path folder, const Simulation& sim, const Snapshot* resumed = nullptr);

    // Output that is due, in this order; called after each step and once before the first.
    /// The contacts of the step.
    void log_contacts(const Simulation& sim);
    /// A row of the histories; `now`: its sums.
    void write_histories(const Simulation& sim, const Totals& now);
    /// A row of the gauges: their readings.
    void write_gauges(const Simulation& sim, const std::vector<double>& readings);
    /// The contacts that rest since the last call: with a frame, and at the end of a run.
    void write_resting(const Simulation& sim);
    /// Adds the state of the histories that a restart needs.
    void save(Snapshot& state) const;
    /// Waits until all rows so far are on disk.
    void settle();
    /// Time of the solver thread by kind of output.
    StageTimer& timer() { return timer_; }

private:
    // Sum of the resting contacts of one pair over the present output interval.
    using PairKey = std::pair<int, int>;

    void write_bodies(const Simulation& sim);
    void write_energy(const Simulation& sim, const Totals& now);
    void write_open(const Simulation& sim);
    void write_contact(const Simulation& sim, const Contact& contact);

    std::filesystem::path folder_;
    std::optional<History> bodies_, contacts_, energy_, gauges_, open_;
    std::map<PairKey, RestingPair> resting_;
    StageTimer timer_;
};

} // namespace hyoryu
