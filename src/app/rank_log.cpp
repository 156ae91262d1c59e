// SPDX-License-Identifier: MIT
#include "rank_log.hpp"

#include "ranks.hpp"
#include "summary.hpp"
#include "tables.hpp"

#include <algorithm>
#include <array>

namespace hyoryu {

namespace {

// The state that each process reports for a row of ranks.csv.
struct RankState {
    std::array<char, 64> host{};
    double particles = 0, ghosts = 0; // of the fluid
    double busy = 0, waited = 0;      // [s]
    double messages = 0, bytes = 0, memory = 0;
};

} // namespace

RankLog::RankLog(CountedComm& comm, long long steps_between_balances)
    : comm_(comm), balance_{.every = steps_between_balances}, waited_before_(comm.traffic().seconds)
{
}

void RankLog::open(const std::filesystem::path& folder)
{
    table_.emplace(folder, ranks_table());
}

double RankLog::busy() const
{
    return steady_seconds() - begun_ - (comm_.traffic().seconds - waited_before_);
}

void RankLog::balance_work(Simulation& sim)
{
    in_steps_ += busy() - step_begun_;
    balance(sim, balance_, in_steps_);
}

void RankLog::write(const Simulation& sim)
{
    RankState own{.busy = busy(),
                  .waited = comm_.traffic().seconds - waited_before_,
                  .messages = static_cast<double>(comm_.traffic().messages),
                  .bytes = static_cast<double>(comm_.traffic().bytes),
                  .memory = peak_memory()};
    host_name().copy(own.host.data(), own.host.size() - 1);
    if (sim.fluid) {
        own.particles = static_cast<double>(sim.fluid->particles.fluid.size());
        own.ghosts = static_cast<double>(sim.fluid->ghosts->particles.fluid.size());
    }
    const std::vector<RankState> all = gather(comm_, std::span<const RankState>(&own, 1)).all;
    for (std::size_t r = 0; table_ && r < all.size(); ++r) {
        const RankState& rank = all[r];
        std::vector<std::string> row{cell(sim.clock.time), cell(static_cast<double>(r)),
                                     cell(std::string_view(rank.host.data()))};
        for (const double value : {rank.particles, rank.ghosts, rank.busy, rank.waited,
                                   rank.messages, rank.bytes, rank.memory}) {
            row.push_back(cell(value));
        }
        table_->append(row);
    }
}

RankSummary RankLog::summary() const
{
    const std::array own{busy(), comm_.traffic().seconds - waited_before_};
    const std::vector<double> all = gather(comm_, std::span<const double>(own)).all;
    RankSummary summary{.count = comm_.size(), .rebalances = balance_.moves};
    double most = 0;
    double busy_of_all = 0;
    double waited_of_all = 0;
    for (std::size_t r = 0; r < all.size(); r += 2) {
        most = std::max(most, all[r]);
        busy_of_all += all[r];
        waited_of_all += all[r + 1];
    }
    summary.imbalance = busy_of_all > 0 ? most * summary.count / busy_of_all : 1;
    summary.waited = waited_of_all / (busy_of_all + waited_of_all);
    return summary;
}

} // namespace hyoryu
