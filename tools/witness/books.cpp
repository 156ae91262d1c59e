// SPDX-License-Identifier: MIT
// Energy and momentum of the bodies from their poses and velocities.
#include "judge.hpp"
#include "mass.hpp"

#include <algorithm>
#include <cmath>

namespace witness {

namespace {

struct Sums {
    double kinetic = 0;
    double potential = 0;
    Vec3 momentum = Vec3::Zero();
    double speed = 0; // sum of m |v|
};

class Books {
public:
    explicit Books(const Scene& scene) : scene_(scene)
    {
        for (const Solid& body : scene.bodies) {
            masses_.push_back(mass_of(body, scene.dimensions));
        }
    }

    Sums of(const Row& row) const
    {
        Sums sums;
        for (std::size_t b = 0; b < masses_.size(); ++b) {
            if (scene_.bodies[b].held || !row.bodies[b].there) {
                continue;
            }
            const State& s = row.bodies[b];
            const double m = masses_[b].mass;
            const Vec3 w = s.q.conjugate() * s.w;
            sums.kinetic += m * s.v.squaredNorm() / 2 + w.dot(masses_[b].inertia * w) / 2;
            sums.potential -= m * scene_.gravity.dot(s.x);
            sums.momentum += m * s.v;
            sums.speed += m * s.v.norm();
        }
        return sums;
    }

    /// What the bodies have at the start to move with: kinetic energy, and the potential energy
    /// over the lowest place that each reaches, at least that of falling by its own size.
    double energy_to_lose(const std::vector<Row>& rows) const
    {
        double energy = of(rows.front()).kinetic;
        for (std::size_t b = 0; b < masses_.size(); ++b) {
            if (scene_.bodies[b].held) {
                continue;
            }
            double fall =
                std::sqrt(masses_[b].inertia.trace() / masses_[b].mass) * scene_.gravity.norm();
            for (const Row& row : rows) {
                if (!row.bodies[b].there) {
                    break;
                }
                fall = std::max(fall, scene_.gravity.dot(row.bodies[b].x - rows[0].bodies[b].x));
            }
            energy += masses_[b].mass * fall;
        }
        return energy;
    }

private:
    const Scene& scene_;
    std::vector<MassProperties> masses_;
};

Vec3 vector_in(const Table& table, std::size_t row, const std::string& stem)
{
    const auto first = table.column(stem + "x");
    if (!first) {
        return Vec3::Zero();
    }
    const auto n = [&](std::size_t k) { return std::stod(table.rows[row][*first + k]); };
    return {n(0), n(1), n(2)};
}

void judge_energy(const std::vector<Row>& rows, const Books& books, BookFinding& found)
{
    found.scale = books.energy_to_lose(rows);
    const Sums start = books.of(rows.front());
    double least = start.kinetic + start.potential;
    const double first = least;
    for (const Row& row : rows) {
        const Sums sums = books.of(row);
        const double energy = sums.kinetic + sums.potential;
        found.growth = std::max(found.growth, (energy - first) / found.scale);
        if ((energy - least) / found.scale > found.rise) {
            found.rise = (energy - least) / found.scale;
            found.rise_time = row.time;
        }
        least = std::min(least, energy);
    }
}

void compare(const std::vector<Row>& rows, const Books& books, const Table& energy,
             BookFinding& found)
{
    const std::vector<double> kinetic = energy.numbers("body_kinetic");
    double largest = 0, speed = 0, impulse = 0, kinetic_error = 0, momentum_error = 0, open = 0;
    const std::size_t count = std::min(rows.size(), energy.rows.size());
    for (std::size_t k = 0; k < count; ++k) {
        const Sums sums = books.of(rows[k]);
        largest = std::max(largest, sums.kinetic);
        speed = std::max(speed, sums.speed);
        kinetic_error = std::max(kinetic_error, std::abs(sums.kinetic - kinetic[k]));
        const Vec3 told = vector_in(energy, k, "momentum_");
        momentum_error = std::max(momentum_error, (sums.momentum - told).norm());
        const Vec3 gravity = vector_in(energy, k, "gravity_impulse_");
        const Vec3 walls = vector_in(energy, k, "wall_impulse_");
        impulse = std::max(impulse, gravity.norm() + walls.norm());
        const Vec3 sides = vector_in(energy, k, "open_impulse_");
        const Vec3 rest = told - vector_in(energy, 0, "momentum_") - gravity - walls - sides;
        open = std::max(open, rest.norm());
    }
    found.kinetic_error = largest > 0 ? kinetic_error / largest : 0;
    found.momentum_error = !found.judged || speed == 0 ? 0 : momentum_error / speed;
    found.closure = impulse + speed > 0 ? open / (impulse + speed) : 0;
}

} // namespace

BookFinding find_books(const std::filesystem::path& folder, const Scene& scene,
                       const std::vector<Row>& rows)
{
    BookFinding found;
    if (rows.empty()) {
        return found;
    }
    const bool driven = std::any_of(scene.walls.begin(), scene.walls.end(),
                                    [](const Solid& wall) { return moves(wall.path); });
    found.judged = !scene.fluid && !driven;
    const Books books(scene);
    if (found.judged) {
        judge_energy(rows, books, found);
    }
    compare(rows, books, read_table(folder / "energy.csv"), found);
    return found;
}

} // namespace witness
