// SPDX-License-Identifier: MIT
// Several ranks as threads of one process.
#pragma once

#include "hyoryu/core/parallel.hpp"
#include "hyoryu/ranks/counted.hpp"

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <utility>

namespace hyoryu::test_help {

/// Memory that the ranks share: the parcels that are sent, and a barrier. A rank that fails frees
/// those that wait at the barrier.
class Board {
public:
    explicit Board(int ranks)
        : ranks_(ranks), mail_(static_cast<std::size_t>(ranks),
                               std::vector<Parcel>(static_cast<std::size_t>(ranks)))
    {
    }
    int ranks() const { return ranks_; }
    Parcel& mail(std::size_t from, std::size_t to) { return mail_[from][to]; }

    void wait()
    {
        std::unique_lock lock(mutex_);
        const long long turn = turn_;
        if (++waiting_ == ranks_) {
            waiting_ = 0;
            turn_ += 1;
            all_here_.notify_all();
        }
        all_here_.wait(lock, [&] { return turn_ != turn || failed_; });
        if (failed_) {
            throw std::runtime_error("another rank failed");
        }
    }
    void fail()
    {
        const std::lock_guard lock(mutex_);
        failed_ = true;
        all_here_.notify_all();
    }

private:
    int ranks_;
    std::vector<std::vector<Parcel>> mail_;
    std::mutex mutex_;
    std::condition_variable all_here_;
    int waiting_ = 0;
    long long turn_ = 0;
    bool failed_ = false;
};

class ThreadComm : public Comm {
public:
    ThreadComm(Board& board, int rank) : board_(board), rank_(rank) {}

    int rank() const override { return rank_; }
    int size() const override { return board_.ranks(); }

    std::vector<Parcel> exchange(std::vector<Parcel> out) override
    {
        const auto self = static_cast<std::size_t>(rank_);
        for (std::size_t to = 0; to < out.size(); ++to) {
            board_.mail(self, to) = std::move(out[to]);
        }
        board_.wait();
        std::vector<Parcel> in;
        for (std::size_t from = 0; from < static_cast<std::size_t>(size()); ++from) {
            in.push_back(std::move(board_.mail(from, self)));
        }
        board_.wait();
        return in;
    }
    void exchange(const std::vector<Parcel>& out, std::vector<Parcel>& in) override
    {
        std::vector<Parcel> arrived = exchange(out);
        for (std::size_t from = 0; from < in.size(); ++from) {
            expects(arrived[from].size() == in[from].size());
        }
        in = std::move(arrived);
    }
    // What arrives is not to be seen before the end.
    void begin(const std::vector<Parcel>& out, std::vector<Parcel>& in) override
    {
        expects(to_ == nullptr);
        arrived_ = exchange(out);
        to_ = &in;
        for (Parcel& parcel : in) {
            std::ranges::fill(parcel, std::byte(0xff)); // not-a-number
        }
    }
    void finish() override
    {
        expects(to_ != nullptr);
        *std::exchange(to_, nullptr) = std::move(arrived_);
    }
    void join(std::span<Joined> numbers) override
    {
        combine(numbers, [](Joined& a, const Joined& b) { a.join(b); });
    }
    void add(std::span<std::int64_t> numbers) override
    {
        combine(numbers, [](std::int64_t& a, std::int64_t b) { a += b; });
    }

private:
    template <class T>
    void combine(std::span<T> values, const auto& join)
    {
        Parcel parcel;
        put(parcel, std::span<const T>(values));
        const std::vector<Parcel> in =
            exchange(std::vector<Parcel>(static_cast<std::size_t>(size()), parcel));
        std::vector<T> others(values.size());
        for (std::size_t from = 0; from < in.size(); ++from) {
            Unpacking(in[from]).take(from == 0 ? values : std::span<T>(others));
            for (std::size_t k = 0; from > 0 && k < values.size(); ++k) {
                join(values[k], others[k]);
            }
        }
    }

    Board& board_;
    int rank_;
    std::vector<Parcel> arrived_; // between begin and finish
    std::vector<Parcel>* to_ = nullptr;
};

/// Calls f(comm) on every rank, each in a thread of its own, and throws what the first rank that
/// failed by itself has thrown.
inline void on_ranks(int ranks, const std::function<void(CountedComm&)>& f)
{
    Board board(ranks);

    std::vector<std::thread> threads;
    std::mutex one_at_a_time;
    std::exception_ptr first;
    for (int rank = 0; rank < ranks; ++rank) {
        threads.emplace_back([&, rank] {
            ThreadComm direct(board, rank);
            CountedComm comm(direct);
            try {
                set_threads(1);
                f(comm);
            } catch (...) {
                const std::lock_guard lock(one_at_a_time);
                first = first ? first : std::current_exception();
                board.fail();
            }
        });
    }
    for (std::thread& thread : threads) {
        thread.join();
    }
    if (first) {
        std::rethrow_exception(first);
    }
}

} // namespace hyoryu::test_help
