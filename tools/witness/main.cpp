// SPDX-License-Identifier: MIT
// hyoryu-witness: what a results folder shows to one who shares no geometry with the program.
#include "judge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>

namespace witness {
namespace {

using nlohmann::ordered_json;

constexpr const char* usage =
    R"(usage: hyoryu-witness RESULTS [--json FILE] [--overlap M] [--inside N] [--lost N] [--energy X]
                      [--rise X] [--momentum X] [--agreement M]
       hyoryu-witness --self-test

Reads the folder that `hyoryu run -o RESULTS` wrote, builds every shape anew from its case.toml, and
tells what it finds. Exit code 0: within the bounds; 1: beyond one; 2: cannot be read.

  --overlap M     largest true overlap of two solids [m]
  --inside N      fluid particles deeper than a quarter of a spacing in a solid, in any frame
  --lost N        particles of the first frame that the last has not
  --energy X      growth of the mechanical energy over that of the start, of scenes without fluid
                  and without walls that move [1]
  --rise X        the same over any earlier row [1]
  --momentum X    momentum of frames and bodies against energy.csv, relative [1]
  --agreement M   how far true overlaps may exceed the program's own worst_penetration, with a tenth
                  of it, as it measures along the normals of contacts and not the least way out [m]
Bounds that are not given are not judged.
)";

struct Request {
    std::filesystem::path folder;
    std::filesystem::path json;
    std::map<std::string, double> bounds;
    bool self_test = false;
};

std::optional<Request> request_of(int count, char** words)
{
    Request request;
    for (int k = 1; k < count; ++k) {
        const std::string word = words[k];
        if (word == "--self-test") {
            request.self_test = true;
        } else if (word == "--json" && k + 1 < count) {
            request.json = words[++k];
        } else if (word.starts_with("--") && k + 1 < count &&
                   std::string(usage).find("[" + word + " ") != std::string::npos) {
            request.bounds[word.substr(2)] = std::stod(words[++k]);
        } else if (!word.starts_with("-") && request.folder.empty()) {
            request.folder = word;
        } else {
            return std::nullopt;
        }
    }
    if (request.folder.empty() && !request.self_test) {
        return std::nullopt;
    }
    return request;
}

class Verdict {
public:
    explicit Verdict(const Request& request) : request_(request) {}

    void hold(const std::string& what, double value, const std::string& text)
    {
        const auto bound = request_.bounds.find(what);
        if (bound != request_.bounds.end() && !(value <= bound->second)) {
            failures.push_back(
                fmt::format("{}: {:.4g}, allowed {:.4g}", text, value, bound->second));
        }
    }

    std::vector<std::string> failures;

private:
    const Request& request_;
};

ordered_json number(const ordered_json& summary, const char* key)
{
    return summary.contains(key) ? summary[key] : ordered_json();
}

void tell_overlap(const OverlapFinding& found, const Scene& scene, const ordered_json& summary,
                  ordered_json& json, Verdict& verdict)
{
    const ordered_json own = summary.value("contact", ordered_json::object());
    json["overlap"] = {{"worst", found.worst},
                       {"time", found.time},
                       {"a", found.a},
                       {"b", found.b},
                       {"fcl", found.fcl},
                       {"at_the_start", found.first_row},
                       {"rows", found.rows},
                       {"rows_over_bound", found.rows_over_bound},
                       {"pairs_looked_at", found.looked_at},
                       {"program", number(own, "worst_penetration")}};
    verdict.hold(
        "overlap", found.worst,
        fmt::format("overlap [m] of {} and {} at t = {:.6g}", found.a, found.b, found.time));
    if (own.contains("worst_penetration") && !scene.penalty) {
        const double told = own["worst_penetration"].get<double>();
        verdict.hold("agreement", found.worst - 1.1 * told,
                     "true overlap beyond the program's own worst_penetration [m]");
    }
}

void tell_fluid(const FluidFinding& found, const Scene& scene, const ordered_json& summary,
                ordered_json& json, Verdict& verdict)
{
    const double relative =
        found.momentum_scale > 0 ? found.momentum_error / found.momentum_scale : 0;
    json["fluid"] = {{"frames", found.frames},
                     {"in_solids_worst", found.worst_count},
                     {"time", found.worst_time},
                     {"in_solids_at_the_end", found.end_count},
                     {"deepest", found.deepest},
                     {"deepest_over_spacing", found.deepest / scene.spacing},
                     {"deepest_time", found.deepest_time},
                     {"solid", found.solid},
                     {"lost", found.lost},
                     {"momentum_error", relative},
                     {"program",
                      {{"particles_in_solids", number(summary, "particles_in_solids")},
                       {"worst_particles_in_solids", number(summary, "worst_particles_in_solids")},
                       {"particles_lost", number(summary, "particles_lost")}}}};
    verdict.hold("inside", static_cast<double>(found.worst_count),
                 fmt::format("fluid particles inside solids at t = {:.6g}, the deepest {:.3g} "
                             "spacings in {}",
                             found.worst_time, found.deepest / scene.spacing, found.solid));
    verdict.hold("lost", static_cast<double>(found.lost), "particles lost");
    verdict.hold("momentum", relative, "momentum of the frames against energy.csv");
    const ordered_json told = number(summary, "worst_particles_in_solids");
    if (told.is_number() && (found.worst_count > 0) != (told > 0)) {
        verdict.hold("inside", NAN, "summary.json says otherwise about particles inside solids");
    }
}

void tell_books(const BookFinding& found, ordered_json& json, Verdict& verdict)
{
    json["books"] = {{"energy_judged", found.judged},
                     {"energy_growth", found.growth},
                     {"energy_rise", found.rise},
                     {"rise_time", found.rise_time},
                     {"energy_of_the_start", found.scale},
                     {"kinetic_energy_error", found.kinetic_error},
                     {"momentum_error", found.momentum_error},
                     {"closure", found.closure}};
    if (found.judged) {
        verdict.hold("energy", found.growth, "energy above that of the start");
        verdict.hold("rise", found.rise,
                     fmt::format("energy from nothing at t = {:.6g}", found.rise_time));
        verdict.hold("momentum", found.momentum_error, "momentum of the bodies against energy.csv");
    }
    verdict.hold("momentum", found.kinetic_error,
                 "kinetic energy of the bodies against energy.csv");
}

// Rows of contacts.csv and steps whose impacts the program says it located in time.
void tell_contacts(const std::filesystem::path& folder, const ordered_json& summary,
                   ordered_json& json)
{
    const Table contacts = read_table(folder / "contacts.csv");
    const std::vector<double> located = contacts.numbers("located");
    const ordered_json own = summary.value("contact", ordered_json::object());
    json["contacts"] = {
        {"rows", contacts.rows.size()},
        {"rows_located", located.empty()
                             ? ordered_json()
                             : ordered_json(std::count(located.begin(), located.end(), 1.0))},
        {"steps", number(summary, "steps")},
        {"steps_located", number(own, "steps_located")}};
}

int finish(const Request& request, ordered_json& json, const std::vector<std::string>& failures)
{
    json["failures"] = failures;
    if (!request.json.empty()) {
        std::ofstream(request.json) << json.dump(1) << '\n';
    } else {
        fmt::print("{}\n", json.dump(1));
    }
    for (const std::string& failure : failures) {
        fmt::print(stderr, "witness: {}\n", failure);
    }
    return failures.empty() ? 0 : 1;
}

int judge(const Request& request)
{
    Scene scene = read_scene(request.folder / "case.toml");
    const std::vector<Row> rows = read_rows(request.folder, scene);
    ordered_json summary = ordered_json::object();
    if (std::ifstream stream(request.folder / "summary.json"); stream) {
        summary = ordered_json::parse(stream);
    }
    const double cube = scene.rest_density * std::pow(scene.spacing, scene.dimensions);
    scene.particle_mass = summary.value("fluid_particle_mass", cube);
    ordered_json json;
    Verdict verdict(request);
    json["results"] = request.folder.string();
    const auto bound = request.bounds.find("overlap");
    tell_overlap(find_overlaps(scene, rows, bound == request.bounds.end() ? 0 : bound->second),
                 scene, summary, json, verdict);
    if (scene.fluid) {
        tell_fluid(find_fluid(request.folder, scene, rows), scene, summary, json, verdict);
    }
    tell_books(find_books(request.folder, scene, rows), json, verdict);
    tell_contacts(request.folder, summary, json);
    return finish(request, json, verdict.failures);
}

int run(int count, char** words)
{
    const std::optional<Request> request = request_of(count, words);
    if (!request) {
        fmt::print(stderr, "{}", usage);
        return 2;
    }
    if (request->self_test) {
        ordered_json json;
        const int failures = self_test(json);
        return finish(*request, json,
                      failures > 0 ? std::vector<std::string>{fmt::format(
                                         "{} kinds of pairs are not told to 1e-9 m", failures)}
                                   : std::vector<std::string>{});
    }
    return judge(*request);
}

} // namespace
} // namespace witness

int main(int count, char** words)
{
    try {
        return witness::run(count, words);
    } catch (const std::exception& error) {
        fmt::print(stderr, "witness: {}\n", error.what());
        return 2;
    }
}
