// SPDX-License-Identifier: MIT
// The work of each process of a shared run: `ranks.csv`, and the balance of the load.
#pragma once

#include "hyoryu/core/timer.hpp"
#include "hyoryu/io/results.hpp"
#include "hyoryu/ranks/counted.hpp"
#include "hyoryu/sim/balance.hpp"

#include <optional>

namespace hyoryu {

/// Of all processes since the start of the program.
struct RankSummary {
    int count = 1;
    double imbalance = 1; // most work of a process over the mean
    double waited = 0;    // share of the time that they waited for each other or sent
    long long rebalances = 0;
};

class RankLog {
public:
    RankLog(CountedComm& comm, long long steps_between_balances);

    /// Opens the table; of the process that writes.
    void open(const std::filesystem::path& folder);
    void begin_step() { step_begun_ = busy(); }
    /// After a step: moves particles to other processes where some work longer than others.
    void balance_work(Simulation& sim);
    /// A row for each process. Called by all.
    void write(const Simulation& sim);
    /// Called by all.
    RankSummary summary() const;

private:
    double busy() const;

    CountedComm& comm_;
    Balance balance_;
    std::optional<History> table_;
    double begun_ = steady_seconds();
    double waited_before_;
    double step_begun_ = 0; // [s] of work
    double in_steps_ = 0;   // work so far, without output
};

} // namespace hyoryu
