// SPDX-License-Identifier: MIT
// The commands, one function each; all return an exit code and throw the errors of core/error.hpp.
#pragma once

#include "hyoryu/view/render.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hyoryu {

struct RunOptions {
    std::filesystem::path case_file;
    std::filesystem::path folder; // empty: case stem + "-results" in the current folder
    std::vector<std::string> overrides;
    int threads = 0;             // 0: all
    long long rebalance = 50;    // steps between checks of the balance of processes; 0: never
    int parts = 64;              // of several processes: most files of a frame or checkpoint
    std::optional<double> until; // [s]
    bool resume = false;
    bool force = false;
    bool quiet = false;
    std::string program = "hyoryu"; // as it was called, for lines that a user may paste
};
int run_case(const RunOptions& options);

struct CheckOptions {
    std::filesystem::path case_file;
    std::vector<std::string> overrides;
    bool json = false;
    bool accuracy = false;      // also the expected error
    bool time = false;          // times steps of the case for the forecast
    std::filesystem::path plan; // where a picture of the scene from above goes; empty: nowhere
};
int check_case(const CheckOptions& options);

struct DescribeOptions {
    std::string key;
    bool json_schema = false;
};
int describe_keys(const DescribeOptions& options);

struct InfoOptions {
    std::filesystem::path folder;
    bool json = false; // as docs/info.schema.json describes it
};
int show_info(const InfoOptions& options);

struct StopOptions {
    std::filesystem::path folder;
};
/// Asks the run that writes to a results folder to stop as SIGUSR1 does.
int stop_run(const StopOptions& options);

struct NewOptions {
    std::string name;               // of a template
    std::filesystem::path file;     // the case file or its folder; empty: NAME.toml here
    std::string program = "hyoryu"; // as it was called, for lines that a user may paste
};
/// Writes a case to begin with; never replaces a file.
int write_new_case(const NewOptions& options);

struct ConvertOptions {
    std::filesystem::path folder;  // of results
    std::string format;            // vtp, csv or vtkhdf
    std::filesystem::path output;  // a folder, of vtkhdf a file; empty: within the results
    std::vector<std::string> only; // names of frame sets; empty: all that the format can hold
    std::vector<double> times;     // [s] only the frames nearest to these; empty: all
    bool force = false;            // replace an earlier conversion
};
/// Writes the frames in another format; replaces only files that it wrote itself.
int convert_results(const ConvertOptions& options);

struct RenderOptions {
    std::filesystem::path folder;
    RenderSettings settings;
};
int render_results(const RenderOptions& options);

struct ReportOptions {
    std::filesystem::path folder;
    std::filesystem::path file;      // empty: report.html in the folder
    std::optional<double> stiffness; // of every contact, for peak forces [N/m]
};
int write_report(const ReportOptions& options);

struct VerifyOptions {
    std::vector<std::string> names; // of benchmarks or groups; empty: all
    std::string tier = "quick";
    std::filesystem::path cases; // empty: found beside the user or the program
    std::filesystem::path folder = "verify-results";
    std::filesystem::path json; // where else `verify.json` goes; empty: nowhere
    bool list = false;
    int threads = 0; // of each run; 0: all, divided among parallel runs
    int jobs = 1;    // runs in parallel
    bool force = false;
};
int verify(const VerifyOptions& options);

struct StudyOptions {
    std::filesystem::path file;
    std::filesystem::path folder; // empty: study stem + "-results" in the current folder
    int threads = 1;              // of each run
    int jobs = 1;                 // runs side by side
    bool force = false;           // repeat finished runs
};
int run_study(const StudyOptions& options);

struct BenchOptions {
    bool quick = false;
    bool full = false;
    std::vector<double> sizes;   // numbers of fluid particles for cost against N; empty: as extent
    int threads = 0;             // 0: all
    std::filesystem::path json;  // where the results go as JSON; empty: nowhere
    std::filesystem::path state; // folder that keeps the developed state; empty: none
};
int run_bench(const BenchOptions& options);

/// Version, commit and build options.
std::string version_text();

} // namespace hyoryu
