// SPDX-License-Identifier: MIT
// Comm by MPI.
#include "module.hpp"

#include <mpi.h>

#include <algorithm>
#include <memory>

namespace {

using namespace hyoryu;

// Longest piece of a message: MPI counts in int.
constexpr std::size_t piece_bytes = std::size_t(1) << 30;

void join(void* in, void* inout, int* count, MPI_Datatype*)
{
    const auto* a = static_cast<const std::byte*>(in);
    auto* b = static_cast<std::byte*>(inout);
    for (int k = 0; k < *count; ++k, a += sizeof(Joined), b += sizeof(Joined)) {
        Joined one; // memory of MPI need not be aligned
        Joined other;
        std::memcpy(static_cast<void*>(&one), a, sizeof one);
        std::memcpy(static_cast<void*>(&other), b, sizeof other);
        other.join(one);
        std::memcpy(b, static_cast<const void*>(&other), sizeof other);
    }
}

// Tag of the message that a process sends to all others before it reports the end of the run.
// Pieces count from 0; the standard grants tags up to 32767.
constexpr int end_tag = 32767;

// Calls f(first byte, bytes, tag) for the pieces of a message.
void for_pieces(std::size_t bytes, const auto& f)
{
    int tag = 0;
    for (std::size_t first = 0; first < bytes; first += piece_bytes) {
        f(first, static_cast<int>(std::min(piece_bytes, bytes - first)), tag++);
    }
}

class MpiComm : public Comm {
public:
    MpiComm()
    {
        MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &thread_support_);
        MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
        MPI_Comm_size(MPI_COMM_WORLD, &size_);
        MPI_Op_create(::join, 1, &join_);
        MPI_Type_contiguous(sizeof(Joined), MPI_BYTE, &joined_);
        MPI_Type_commit(&joined_);
    }
    ~MpiComm() override
    {
        MPI_Type_free(&joined_);
        MPI_Op_free(&join_);
        MPI_Finalize();
    }
    MpiComm(const MpiComm&) = delete;
    MpiComm& operator=(const MpiComm&) = delete;

    bool claim_end()
    {
        constexpr int probes = 100; // each takes in what has arrived, for the next one to find
        int claimed = 0;
        for (int k = 0; k < probes && claimed == 0; ++k) {
            MPI_Iprobe(MPI_ANY_SOURCE, end_tag, MPI_COMM_WORLD, &claimed, MPI_STATUS_IGNORE);
        }
        for (int r = 0; r < size_ && claimed == 0; ++r) {
            if (r != rank_) {
                MPI_Request request = MPI_REQUEST_NULL;
                MPI_Isend(nullptr, 0, MPI_BYTE, r, end_tag, MPI_COMM_WORLD, &request);
                MPI_Request_free(&request);
            }
        }
        return claimed == 0;
    }

    int rank() const override { return rank_; }
    int size() const override { return size_; }

    std::vector<Parcel> exchange(std::vector<Parcel> out) override
    {
        std::vector<std::uint64_t> sent;
        for (const Parcel& parcel : out) {
            sent.push_back(parcel.size());
        }
        std::vector<std::uint64_t> received(out.size());
        MPI_Alltoall(sent.data(), 1, MPI_UINT64_T, received.data(), 1, MPI_UINT64_T,
                     MPI_COMM_WORLD);
        std::vector<Parcel> in(out.size());
        for (std::size_t r = 0; r < in.size(); ++r) {
            in[r].resize(received[r]);
        }
        exchange(out, in);
        return in;
    }

    void exchange(const std::vector<Parcel>& out, std::vector<Parcel>& in) override
    {
        post(out, in, requests_);
        wait(requests_);
    }
    // Of two ranks messages with one tag arrive in the order in which they were posted.
    void begin(const std::vector<Parcel>& out, std::vector<Parcel>& in) override
    {
        post(out, in, begun_);
    }
    void finish() override { wait(begun_); }

    void join(std::span<Joined> numbers) override { reduce(numbers, joined_, join_); }
    void add(std::span<std::int64_t> numbers) override { reduce(numbers, MPI_INT64_T, MPI_SUM); }

private:
    void post(const std::vector<Parcel>& out, std::vector<Parcel>& in,
              std::vector<MPI_Request>& requests) const
    {
        const auto self = static_cast<std::size_t>(rank_);
        const auto request = [&]() -> MPI_Request* { return &requests.emplace_back(); };
        for (std::size_t r = 0; r < in.size(); ++r) {
            if (r != self) {
                for_pieces(in[r].size(), [&](std::size_t first, int bytes, int tag) {
                    MPI_Irecv(in[r].data() + first, bytes, MPI_BYTE, static_cast<int>(r), tag,
                              MPI_COMM_WORLD, request());
                });
            }
        }
        for (std::size_t r = 0; r < out.size(); ++r) {
            if (r != self) {
                for_pieces(out[r].size(), [&](std::size_t first, int bytes, int tag) {
                    MPI_Isend(out[r].data() + first, bytes, MPI_BYTE, static_cast<int>(r), tag,
                              MPI_COMM_WORLD, request());
                });
            }
        }
        in[self] = out[self];
    }
    static void wait(std::vector<MPI_Request>& requests)
    {
        MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
        requests.clear();
    }
    template <class T>
    static void reduce(std::span<T> values, MPI_Datatype type, MPI_Op op)
    {
        MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), type, op,
                      MPI_COMM_WORLD);
    }

    int rank_ = 0;
    int size_ = 1;
    int thread_support_ = 0;
    MPI_Op join_ = MPI_OP_NULL;
    MPI_Datatype joined_ = MPI_DATATYPE_NULL;
    std::vector<MPI_Request> requests_, begun_;
};

std::unique_ptr<MpiComm> connection;

} // namespace

extern "C" {

[[gnu::visibility("default")]] hyoryu::Comm* hyoryu_module_begin_ranks()
{
    connection = std::make_unique<MpiComm>();
    return connection.get();
}

[[gnu::visibility("default")]] void hyoryu_module_end_ranks()
{
    connection.reset();
}

[[gnu::visibility("default")]] bool hyoryu_module_claim_end_of_ranks()
{
    return connection->claim_end();
}

[[gnu::visibility("default")]] void hyoryu_module_abort_ranks(int code)
{
    MPI_Abort(MPI_COMM_WORLD, code);
}

} // extern "C"
