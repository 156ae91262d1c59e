// SPDX-License-Identifier: MIT
#include "hyoryu/sim/survey.hpp"

#include "hyoryu/fluid/sum_units.hpp"
#include "hyoryu/fluid/totals.hpp"
#include "hyoryu/sim/simulation.hpp"

#include <fmt/format.h>

#include <bit>
#include <cmath>

namespace hyoryu {

namespace {

constexpr double fastest_over_sound = 2;

const FixedUnit count_unit = fixed_unit(1);

// The fluid of this process; sums of velocities, speeds and particles apart.
StateSurvey own_survey(const Fluid& fluid)
{
    StateSurvey own;
    own.top_speed = top_speed(fluid);
    own.top_acceleration = top_acceleration(fluid);
    own.viscosity = effective_viscosity(fluid);
    own.compression = largest(0, fluid.particles.fluid.size(), 0, Compression(fluid));
    return own;
}

// A number of 52 bits for the bits of the state of a body (FNV-1a).
double fingerprint(const Body& body)
{
    std::uint64_t hash = 14695981039346656037U;
    const auto add = [&](const auto& vector) {
        for (const double number : vector) {
            hash = (hash ^ std::bit_cast<std::uint64_t>(number)) * 1099511628211U;
        }
    };
    add(body.position);
    add(body.orientation.coeffs());
    add(body.velocity);
    add(body.angular_momentum);
    return static_cast<double>(hash >> 12U);
}

// Whether all processes have the same bodies, by the largest of each fingerprint and of its
// negative, which are opposite if all are equal.
class SameBodies {
public:
    explicit SameBodies(const Simulation& sim)
    {
        constexpr long long steps_between_looks = 100;
        if (sim.comm != nullptr && sim.clock.step % steps_between_looks == 0) {
            for (const Body& body : sim.rigid.bodies) {
                extremes_.push_back(fingerprint(body));
                extremes_.push_back(-extremes_.back());
            }
        }
    }
    std::span<double> extremes() { return extremes_; }

    void expect(const Simulation& sim) const
    {
        for (std::size_t k = 0; k < extremes_.size(); k += 2) {
            if (extremes_[k] != -extremes_[k + 1]) {
                throw BodiesDiffer(fmt::format(
                    "after step {} the processes disagree on body \"{}\": probably their "
                    "processors or C libraries are of different types",
                    sim.clock.step, sim.rigid.bodies[k / 2].name));
            }
        }
    }

private:
    std::vector<double> extremes_;
};

void compare_bodies(const Simulation& sim)
{
    SameBodies same(sim);
    if (!same.extremes().empty()) {
        Reduction all(sim.comm);
        all.largest(same.extremes());
        all.run();
        same.expect(sim);
    }
}

void survey_fluid(Simulation& sim, StateSurvey& now)
{
    const Fluid& fluid = *sim.fluid;
    now = own_survey(fluid);
    now.request = sim.request;
    const auto v = fluid.particles.fluid[field::velocity];
    const FixedUnit unit = sum_units(fluid.parameters).velocity;
    const FixedUnits<4> units{unit, unit, unit, unit};
    FixedSums<4> motion = sums_by_tile<4>(fluid.neighbours.fluid, units, [&](Index i) {
        return std::array{v[i].x(), v[i].y(), v[i].z(), v[i].norm()};
    });
    FixedSum count;
    count.add(static_cast<double>(fluid.particles.fluid.size()), count_unit);

    SameBodies same(sim);
    // Loads for which no body waited are completed here. Bodies are fixed then and yield nothing,
    // so that no velocity changes.
    const bool loads = !sim.loads.complete;
    Reduction all(comm_of(fluid));
    all.largest(same.extremes());
    all.add(motion.each());
    all.add(std::span(&count, 1));
    for (double* const most :
         {&now.top_speed, &now.top_acceleration, &now.viscosity, &now.compression, &now.request}) {
        all.largest(std::span(most, 1));
    }
    if (loads) {
        end_loads(sim.loads, all);
    }
    all.run();
    same.expect(sim);
    if (loads) {
        complete_loads(sim);
    }
    const auto [x, y, z, speed] = motion.values(units);
    now.momentum = fluid.parameters.mass * Vec3(x, y, z);
    now.momentum_scale = fluid.parameters.mass * speed;
    now.particles = static_cast<Index>(count.value(count_unit));
}

} // namespace

Compression::Compression(const Fluid& fluid)
    : density_(fluid.particles.fluid[field::density]),
      velocity_(fluid.particles.fluid[field::velocity]), rest_density_(fluid.parameters.eos.rho0),
      top_squared_(sq(fastest_over_sound * fluid.parameters.eos.c0))
{
}

StateSurvey survey(Simulation& sim)
{
    StateSurvey now;
    if (sim.fluid) {
        survey_fluid(sim, now);
    } else {
        compare_bodies(sim);
    }
    for (const Body& body : sim.rigid.bodies) {
        now.momentum += body.mass.mass * body.velocity;
        now.momentum_scale += body.mass.mass * body.velocity.norm();
    }
    return now;
}

TimeLimit time_limit(const Simulation& sim, const StateSurvey& now)
{
    const std::span<const TimeLimit> limits = sim.plan.limits;
    if (!sim.fluid) {
        return shortest(limits);
    }
    // The limits of light bodies stay; those of the fluid, the first ones, follow its motion.
    const auto of_now =
        fluid_limits(sim.fluid->parameters, now.top_speed, now.top_acceleration, now.viscosity);
    const TimeLimit of_fluid = shortest(of_now);
    const TimeLimit of_bodies = shortest(limits.subspan(of_now.size()));
    return of_bodies.dt < of_fluid.dt ? of_bodies : of_fluid;
}

} // namespace hyoryu
