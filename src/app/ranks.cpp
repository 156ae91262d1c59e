// SPDX-License-Identifier: MIT
#include "ranks.hpp"

#include "errors.hpp"
#include "options.hpp"

#include "hyoryu/core/error.hpp"
#include "hyoryu/core/instruction_set.hpp"
#include "hyoryu/sim/survey.hpp"
#include "mpi/module.hpp"

#include <fmt/format.h>

#include <dlfcn.h>
#include <unistd.h>

#include <array>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <thread>

namespace hyoryu {

namespace {

namespace fs = std::filesystem;

// An environment variable as a number; -1 without one.
int number_of(const char* variable)
{
    const char* const text = std::getenv(variable);
    int number = -1;
    if (text != nullptr) {
        const std::string_view digits(text);
        std::from_chars(digits.data(), digits.data() + digits.size(), number);
    }
    return number;
}

// The number of processes that the launcher announces (OpenMPI, MPICH, Slurm); 1 without one.
int processes_announced()
{
    const int of_slurm = number_of("PMIX_RANK") >= 0 ? number_of("SLURM_NTASKS") : 1;
    return std::max({1, number_of("OMPI_COMM_WORLD_SIZE"), number_of("PMI_SIZE"), of_slurm});
}

// Processes that do not belong together, or round differently, must not share a run.
void expect_alike(Comm& comm)
{
    if (comm.size() != processes_announced()) {
        throw IoError(fmt::format("the launcher has started {} processes, but MPI connects {} of "
                                  "them: {} and the launcher belong to different MPI "
                                  "implementations",
                                  processes_announced(), comm.size(), mpi_module::file_name));
    }
    const auto own = static_cast<int>(widest_instruction_set());
    const std::vector<int> sets = gather(comm, std::span<const int>(&own, 1)).all;
    if (std::ranges::count(sets, own) != std::ssize(sets)) {
        throw IoError("the processes run on processors with different instruction sets, which "
                      "round differently\n  hint: start the run on processors of the same type");
    }
}

// The module beside the program, or in ../lib/hyoryu.
void* open_mpi_module()
{
    const fs::path program = fs::read_symlink("/proc/self/exe").parent_path();
    for (const fs::path& folder : {program, program.parent_path() / "lib" / "hyoryu"}) {
        const fs::path file = folder / mpi_module::file_name;
        if (fs::exists(file)) {
            // What MPI loads by itself looks for its symbols among those of all libraries.
            void* const module = dlopen(file.c_str(), RTLD_NOW | RTLD_GLOBAL);
            if (module == nullptr) {
                throw IoError(fmt::format("cannot load {}: {}", mpi_module::file_name, dlerror()));
            }
            return module;
        }
    }
    throw IoError(fmt::format("a run with several processes needs {}: on Debian it is in the "
                              "package hyoryu-mpi; from source it is built with -DHYORYU_MPI=ON",
                              mpi_module::file_name));
}

template <class Function>
Function function_of(void* module, const char* name)
{
    void* const found = dlsym(module, name);
    if (found == nullptr) {
        throw IoError(
            fmt::format("{} belongs to another version of the program", mpi_module::file_name));
    }
    return reinterpret_cast<Function>(found);
}

// Time within which the process that reports an error ends the others.
constexpr auto patience = std::chrono::seconds(10);

// Whether an error occurs on every process, because all of them have the data that cause it.
bool is_of_all(const std::exception_ptr& error)
{
    try {
        std::rethrow_exception(error);
    } catch (const CaseError&) {
        return true;
    } catch (const NumericalError&) {
        return true;
    } catch (const BodiesDiffer&) {
        return true;
    } catch (...) {
        return false;
    }
}

} // namespace

bool is_first()
{
    return std::max({number_of("OMPI_COMM_WORLD_RANK"), number_of("PMI_RANK"),
                     number_of("PMIX_RANK")}) <= 0;
}

std::string host_name()
{
    std::array<char, 256> name{};
    return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown host";
}

Ranks::Ranks()
{
    if (processes_announced() > 1) {
        module_ = open_mpi_module();
        comm_.emplace(*function_of<mpi_module::Begin>(module_, mpi_module::begin_name)());
        expect_alike(*comm_);
    }
}

Ranks::~Ranks()
{
    if (comm_) {
        function_of<mpi_module::End>(module_, mpi_module::end_name)();
    }
}

void Ranks::together(const std::function<void()>& f)
{
    if (!comm_) {
        f();
        return;
    }
    std::exception_ptr fault;
    try {
        f();
    } catch (...) {
        fault = std::current_exception();
    }
    const int failed = fault ? 1 : 0;
    const std::vector<int> all = gather(*comm_, std::span<const int>(&failed, 1)).all;
    const auto first = std::ranges::find(all, 1);
    if (first == all.end()) {
        return;
    }
    if (first - all.begin() != comm_->rank()) {
        std::this_thread::sleep_for(patience);
        fault = std::make_exception_ptr(IoError("another process has failed"));
    }
    tell(fault);
}

void Ranks::end(const std::exception_ptr& error)
{
    // An error of all processes is reported by rank 0, which ends the others while they wait. An
    // error of some, such as a full disk, is reported by the first of these: each process waits
    // longer than those before it take to end the run.
    constexpr auto head_start = std::chrono::milliseconds(1000);
    constexpr auto each_later = std::chrono::milliseconds(200);
    if (const int rank = comm_->rank(); rank > 0) {
        std::signal(SIGTERM, SIG_DFL); // the launcher's when another one has told: nothing to save
        const auto turn =
            std::min<std::chrono::milliseconds>(head_start + (rank - 1) * each_later, patience);
        std::this_thread::sleep_for(is_of_all(error) ? patience : turn);
    }
    tell(error);
}

void Ranks::tell(const std::exception_ptr& error)
{
    if (!function_of<mpi_module::ClaimEnd>(module_, mpi_module::claim_end_name)()) {
        std::this_thread::sleep_for(patience); // the other one ends this process
    }
    const int rank = comm_->rank();
    const int code =
        tell_error(error, rank == 0 ? "" : fmt::format("rank {} on {}: ", rank, host_name()));
    std::fflush(stdout);
    function_of<mpi_module::Abort>(module_, mpi_module::abort_name)(code);
    std::_Exit(code);
}

void expect_common(Comm* comm, const std::vector<Common>& things)
{
    if (comm == nullptr) {
        return;
    }
    std::vector<std::size_t> own;
    for (const Common& thing : things) {
        own.push_back(std::hash<std::string>()(thing.text));
    }
    const std::vector<std::size_t> all = gather(*comm, std::span<const std::size_t>(own)).all;
    for (std::size_t k = 0; k < all.size(); ++k) {
        const std::size_t thing = k % things.size();
        if (all[k] != all[thing]) {
            throw CaseError(fmt::format("the processes do not have the same {}: ranks 0 and {} "
                                        "differ",
                                        things[thing].what, k / things.size()),
                            "start all processes with one command, with files that all machines "
                            "share");
        }
    }
}

Fillers fillers_of(Comm* comm)
{
    if (comm == nullptr) {
        return {};
    }
    const std::size_t own = std::hash<std::string>()(host_name());
    const std::vector<std::size_t> hosts = gather(*comm, std::span<const std::size_t>(&own, 1)).all;
    const auto here = static_cast<double>(std::ranges::count(hosts, own));
    return {comm, here / comm->size()};
}

bool writes(const Comm* comm)
{
    return comm == nullptr || comm->rank() == 0;
}

} // namespace hyoryu
