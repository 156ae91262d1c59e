// SPDX-License-Identifier: MIT
// Histories, mesh files and paths of walls, by readers of few lines.
#include "scene.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

namespace witness {

namespace {

std::vector<std::string> cells_of(const std::string& line)
{
    std::vector<std::string> cells;
    std::string cell;
    bool quoted = false;
    for (const char c : line) {
        if (c == '"') {
            quoted = !quoted;
        } else if (c == ',' && !quoted) {
            cells.push_back(std::move(cell));
            cell.clear();
        } else if (c != '\r') {
            cell += c;
        }
    }
    cells.push_back(std::move(cell));
    return cells;
}

// Collects triangles; corners in one place become one.
class Welder {
public:
    explicit Welder(double scale) : scale_(scale) {}

    void add(const std::array<Vec3, 3>& corners)
    {
        std::array<int, 3> triangle{};
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 p = scale_ * corners[k];
            const auto [at, is_new] =
                known_.try_emplace({p.x(), p.y(), p.z()}, static_cast<int>(mesh.corners.size()));
            if (is_new) {
                mesh.corners.push_back(p);
            }
            triangle[k] = at->second;
        }
        if (triangle[0] != triangle[1] && triangle[1] != triangle[2] &&
            triangle[2] != triangle[0]) {
            mesh.triangles.push_back(triangle);
        }
    }

    Mesh mesh;

private:
    double scale_;
    std::map<std::array<double, 3>, int> known_;
};

Mesh read_obj(const std::string& text, double scale)
{
    Welder welder(scale);
    std::vector<Vec3> corners;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string first;
        words >> first;
        if (first == "v") {
            Vec3 p;
            words >> p.x() >> p.y() >> p.z();
            corners.push_back(p);
        } else if (first == "f") {
            std::vector<Vec3> polygon;
            for (std::string word; words >> word;) {
                const int k = std::stoi(word);
                polygon.push_back(corners.at(static_cast<std::size_t>(
                    k > 0 ? k - 1 : static_cast<int>(corners.size()) + k)));
            }
            for (std::size_t k = 2; k < polygon.size(); ++k) {
                welder.add({polygon[0], polygon[k - 1], polygon[k]});
            }
        }
    }
    return welder.mesh;
}

Mesh read_binary_stl(const std::string& bytes, double scale)
{
    constexpr std::size_t head = 84, record = 50;
    Welder welder(scale);
    for (std::size_t at = head; at + record <= bytes.size(); at += record) {
        std::array<float, 12> n{};
        std::memcpy(n.data(), bytes.data() + at, sizeof n);
        const auto corner = [&](std::size_t k) { return Vec3(n[k], n[k + 1], n[k + 2]); };
        welder.add({corner(3), corner(6), corner(9)});
    }
    return welder.mesh;
}

Mesh read_text_stl(const std::string& text, double scale)
{
    Welder welder(scale);
    std::vector<Vec3> corners;
    std::istringstream words(text);
    for (std::string word; words >> word;) {
        if (word == "vertex") {
            std::array<float, 3> n{}; // single precision, as STL is by definition
            words >> n[0] >> n[1] >> n[2];
            corners.emplace_back(n[0], n[1], n[2]);
            if (corners.size() % 3 == 0) {
                welder.add(
                    {corners[corners.size() - 3], corners[corners.size() - 2], corners.back()});
            }
        }
    }
    return welder.mesh;
}

double slope(const Path& path, std::size_t k, Eigen::Index axis)
{
    return (path.places[k + 1][axis] - path.places[k][axis]) / (path.times[k + 1] - path.times[k]);
}

double tangent(const Path& path, std::size_t k, Eigen::Index axis)
{
    if (k == 0 || k + 1 == path.times.size()) {
        return 0;
    }
    const double left = slope(path, k - 1, axis), right = slope(path, k, axis);
    const double h = path.times[k] - path.times[k - 1], g = path.times[k + 1] - path.times[k];
    return left * right <= 0 ? 0 : 3 * (h + g) / ((2 * g + h) / left + (g + 2 * h) / right);
}

// The bodies that left the run, and when.
std::map<std::string, double> left_bodies(const std::filesystem::path& folder)
{
    std::map<std::string, double> left;
    if (std::ifstream stream(folder / "summary.json"); stream) {
        const auto summary = nlohmann::json::parse(stream);
        if (summary.contains("open")) {
            for (const auto& body : summary["open"]["bodies_left"]) {
                left[body["name"]] = body["time"];
            }
        }
    }
    return left;
}

// The state in the last columns of a row, from x on.
State state_in(const std::vector<std::string>& cells, std::size_t first)
{
    const auto n = [&](std::size_t k) { return std::stod(cells.at(first + k)); };
    return {{n(0), n(1), n(2)},
            Quat(n(3), n(4), n(5), n(6)).normalized(),
            {n(7), n(8), n(9)},
            {n(10), n(11), n(12)}};
}

} // namespace

std::optional<std::size_t> Table::column(const std::string& name) const
{
    const auto at = std::find(heads.begin(), heads.end(), name);
    return at == heads.end() ? std::nullopt
                             : std::optional(static_cast<std::size_t>(at - heads.begin()));
}

std::vector<double> Table::numbers(const std::string& name) const
{
    std::vector<double> values;
    if (const auto k = column(name)) {
        for (const auto& row : rows) {
            values.push_back(std::stod(row.at(*k)));
        }
    }
    return values;
}

Table read_table(const std::filesystem::path& file)
{
    Table table;
    std::ifstream stream(file);
    for (std::string line; std::getline(stream, line);) {
        if (line.empty() || line[0] == '#') {
            continue;
        }
        if (table.heads.empty()) {
            table.heads = cells_of(line);
        } else {
            table.rows.push_back(cells_of(line));
        }
    }
    return table;
}

std::vector<Row> read_rows(const std::filesystem::path& folder, const Scene& scene)
{
    const Table table = read_table(folder / "bodies.csv");
    std::vector<Row> rows;
    if (scene.bodies.empty()) {
        return rows;
    }
    const auto first = table.column("x"), named = table.column("body");
    if (!first || !named) {
        throw std::runtime_error("bodies.csv is missing or has no columns `body` and `x`");
    }
    const auto left = left_bodies(folder);
    for (std::size_t line = 0; line < table.rows.size();) {
        Row row{.time = std::stod(table.rows[line][0])};
        for (const Solid& body : scene.bodies) {
            const auto gone = left.find(body.name);
            if (gone != left.end() && row.time > gone->second) {
                row.bodies.push_back({.there = false});
                continue;
            }
            if (line == table.rows.size()) {
                return rows; // a run that was cut off within these rows
            }
            const auto& cells = table.rows[line++];
            if (cells[*named] != body.name || std::stod(cells[0]) != row.time) {
                throw std::runtime_error("bodies.csv: expected " + body.name + ", found " +
                                         cells[*named]);
            }
            row.bodies.push_back(state_in(cells, *first));
        }
        rows.push_back(std::move(row));
    }
    return rows;
}

Mesh read_mesh(const std::filesystem::path& file, double scale)
{
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream all;
    all << stream.rdbuf();
    const std::string bytes = all.str();
    if (!stream || bytes.size() < 10) {
        throw std::runtime_error(file.string() + ": cannot be read");
    }
    if (file.extension() == ".obj") {
        return read_obj(bytes, scale);
    }
    std::uint32_t count = 0;
    if (bytes.size() >= 84) {
        std::memcpy(&count, bytes.data() + 80, sizeof count);
    }
    const bool binary = bytes.size() == 84 + 50 * static_cast<std::size_t>(count);
    return binary ? read_binary_stl(bytes, scale) : read_text_stl(bytes, scale);
}

Vec3 displacement(const Path& path, double t)
{
    if (path.times.empty()) {
        return t * path.velocity;
    }
    if (t <= path.times.front() || t >= path.times.back()) {
        return t <= path.times.front() ? path.places.front() : path.places.back();
    }
    const auto next = std::upper_bound(path.times.begin(), path.times.end(), t);
    const auto k = static_cast<std::size_t>(next - path.times.begin()) - 1;
    const double h = path.times[k + 1] - path.times[k];
    const double s = (t - path.times[k]) / h;
    Vec3 place;
    for (Eigen::Index axis = 0; axis < 3; ++axis) { // Hermite's basis
        place[axis] = (1 + 2 * s) * (1 - s) * (1 - s) * path.places[k][axis] +
                      s * s * (3 - 2 * s) * path.places[k + 1][axis] +
                      h * s * (1 - s) * (1 - s) * tangent(path, k, axis) +
                      h * s * s * (s - 1) * tangent(path, k + 1, axis);
    }
    return place;
}

bool moves(const Path& path)
{
    return path.times.empty() ? path.velocity.norm() > 0
                              : std::any_of(path.places.begin(), path.places.end(),
                                            [&](const Vec3& p) { return p != path.places[0]; });
}

} // namespace witness
