// SPDX-License-Identifier: MIT
// Counts the messages of a rank and the time that it spends in communication.
#pragma once

#include "hyoryu/ranks/comm.hpp"

#include <chrono>

namespace hyoryu {

/// Since the start.
struct Traffic {
    long long calls = 0;    // that all ranks make together
    long long messages = 0; // sent to other ranks, empty ones excluded
    long long bytes = 0;    // of them, and of numbers that are reduced
    double seconds = 0;     // in calls: waiting and sending
};

/// A connection that counts what goes through it.
class CountedComm : public Comm {
public:
    explicit CountedComm(Comm& comm) : comm_(comm) {}

    int rank() const override { return comm_.rank(); }
    int size() const override { return comm_.size(); }

    std::vector<Parcel> exchange(std::vector<Parcel> out) override
    {
        count(out);
        const Watch watch(traffic_);
        return comm_.exchange(std::move(out));
    }
    void exchange(const std::vector<Parcel>& out, std::vector<Parcel>& in) override
    {
        count(out);
        const Watch watch(traffic_);
        comm_.exchange(out, in);
    }
    void begin(const std::vector<Parcel>& out, std::vector<Parcel>& in) override
    {
        count(out);
        const Watch watch(traffic_);
        comm_.begin(out, in);
    }
    void finish() override
    {
        const Watch watch(traffic_);
        comm_.finish();
    }
    void join(std::span<Joined> numbers) override { reduce(numbers, &Comm::join); }
    void add(std::span<std::int64_t> numbers) override { reduce(numbers, &Comm::add); }

    const Traffic& traffic() const { return traffic_; }

private:
    using Clock = std::chrono::steady_clock;

    // Adds the time of a call, however it ends.
    class Watch {
    public:
        explicit Watch(Traffic& traffic) : traffic_(traffic) {}
        ~Watch()
        {
            traffic_.seconds += std::chrono::duration<double>(Clock::now() - begun_).count();
        }
        Watch(const Watch&) = delete;
        Watch& operator=(const Watch&) = delete;

    private:
        Traffic& traffic_;
        Clock::time_point begun_ = Clock::now();
    };

    void count(const std::vector<Parcel>& out)
    {
        traffic_.calls += 1;
        for (std::size_t r = 0; r < out.size(); ++r) {
            if (static_cast<int>(r) != rank() && !out[r].empty()) {
                traffic_.messages += 1;
                traffic_.bytes += static_cast<long long>(out[r].size());
            }
        }
    }
    template <class T>
    void reduce(std::span<T> values, void (Comm::*call)(std::span<T>))
    {
        traffic_.calls += 1;
        traffic_.bytes += static_cast<long long>(values.size_bytes());
        const Watch watch(traffic_);
        (comm_.*call)(values);
    }

    Comm& comm_;
    Traffic traffic_;
};

} // namespace hyoryu
