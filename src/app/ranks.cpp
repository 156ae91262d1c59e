// SPDX-License-Identifier: MIT
#include "ranks.hpp"

#include "errors.hpp"
#include "options.hpp"

#include "hyoryu/core/error.hpp"
#include "mpi/module.hpp"

#include <fmt/format.h>

#include <dlfcn.h>
#include <unistd.h>

#include <array>
#include <charconv>
#include <chrono>
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

// What the launchers of OpenMPI, MPICH and Slurm tell their processes.
bool is_one_of_several()
{
    return number_of("OMPI_COMM_WORLD_SIZE") > 1 || number_of("PMI_SIZE") > 1 ||
           (number_of("PMIX_RANK") >= 0 && number_of("SLURM_NTASKS") > 1);
}

bool is_first()
{
    return std::max({number_of("OMPI_COMM_WORLD_RANK"), number_of("PMI_RANK"),
                     number_of("PMIX_RANK")}) <= 0;
}

// The module beside the program, or in ../lib/hyoryu.
void* open_module()
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
    if (!is_first()) { // the first process speaks for all
        std::_Exit(exit_code::io);
    }
    throw IoError(fmt::format("this is one of several processes that are to share a run, which "
                              "needs {}: on Debian it is in the package hyoryu-mpi; from source "
                              "it is built with -DHYORYU_MPI=ON",
                              mpi_module::file_name));
}

template <class Function>
Function function_of(void* module, const char* name)
{
    void* const found = dlsym(module, name);
    if (found == nullptr) {
        throw IoError(
            fmt::format("{} is of another version of the program", mpi_module::file_name));
    }
    return reinterpret_cast<Function>(found);
}

std::string host_name()
{
    std::array<char, 256> name{};
    return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown host";
}

// Whether every process meets an error, because all of them know what it follows from.
bool is_of_all(const std::exception_ptr& error)
{
    try {
        std::rethrow_exception(error);
    } catch (const CaseError&) {
        return true;
    } catch (const NumericalError&) {
        return true;
    } catch (...) {
        return false;
    }
}

} // namespace

Ranks::Ranks()
{
    if (is_one_of_several()) {
        module_ = open_module();
        comm_ = function_of<mpi_module::Begin>(module_, mpi_module::begin_name)();
    }
}

Ranks::~Ranks()
{
    if (comm_ != nullptr) {
        function_of<mpi_module::End>(module_, mpi_module::end_name)();
    }
}

void Ranks::end(const std::exception_ptr& error) const
{
    // What all processes meet, rank 0 tells: its MPI_Abort comes within seconds.
    constexpr auto patience = std::chrono::seconds(10);
    const bool first = comm_->rank() == 0;
    if (!first && is_of_all(error)) {
        std::this_thread::sleep_for(patience);
    }
    const int code =
        tell_error(error, first ? "" : fmt::format("rank {} on {}: ", comm_->rank(), host_name()));
    std::fflush(stdout);
    function_of<mpi_module::Abort>(module_, mpi_module::abort_name)(code);
    std::_Exit(code);
}

bool writes(const Comm* comm)
{
    return comm == nullptr || comm->rank() == 0;
}

void refuse_unshared(const Scene& scene)
{
    std::vector<Diagnostic> all;
    const auto refuse = [&](const char* key, const char* what, const char* hint) {
        all.push_back({.file = scene.file.string(), .key = key, .what = what, .hint = hint});
    };
    if (!scene.open.empty()) {
        refuse("open", "several processes cannot share a case with open sides yet",
               "run it in one process, with threads");
    }
    if (scene.time.recover) {
        refuse("time.recover", "several processes cannot recover from a failed step yet",
               "leave it out, or run the case in one process");
    }
    if (!all.empty()) {
        throw CaseError(all);
    }
}

} // namespace hyoryu
