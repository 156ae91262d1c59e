// SPDX-License-Identifier: MIT
#include "hyoryu/sim/gauges.hpp"

#include "gauge_readings.hpp"
#include "hyoryu/sim/simulation.hpp"

namespace hyoryu {

namespace {

void push(std::vector<double>& readings, const Vec3& v)
{
    readings.insert(readings.end(), v.begin(), v.end());
}

void read_force(const Simulation& sim, const GaugedForce& force, std::vector<double>& readings)
{
    const double span = sim.clock.time - sim.gauges.last_row;
    const Vec3 gained = force.contact_impulse - force.contact_at_row;
    push(readings, force.pressure + force.viscous);
    push(readings, force.pressure);
    push(readings, force.viscous);
    push(readings, span > 0 ? Vec3(gained / span) : Vec3(Vec3::Zero()));
    push(readings, force.fluid_impulse);
    push(readings, force.contact_impulse);
}

} // namespace

std::vector<Table::Head> gauge_heads(const Scene& scene)
{
    std::vector<Table::Head> heads;
    for (const Gauge& gauge : scene.gauges) {
        const std::vector<Table::Head> own = gauge_columns(gauge, scene.dimensions);
        heads.insert(heads.end(), own.begin(), own.end());
    }
    return heads;
}

namespace {

// Fronts are those of the fluid in the domain, without the carpets beyond its open sides.
void leave_out_carpets(const Simulation& sim, std::vector<GaugeTerms>& terms)
{
    const Fluid& fluid = *sim.fluid;
    const auto x = fluid.particles.fluid[field::position];
    for (std::size_t k = 0; k < terms.size() && sim.open.runs(); ++k) {
        const Gauge& gauge = sim.scene.gauges[k];
        if (gauge.type != GaugeType::front) {
            continue;
        }
        double& place = terms[k].farthest;
        place = -infinity;
        for (Index row = 0; row < fluid.particles.fluid.size(); ++row) {
            if (x[row][gauge.axis] > place && !is_behind(sim.open.boundary, x[row])) {
                place = x[row][gauge.axis];
            }
        }
    }
}

} // namespace

std::vector<double> read_gauges(const Simulation& sim)
{
    const std::vector<Gauge>& gauges = sim.scene.gauges;
    std::vector<std::vector<double>> of_fluid(gauges.size());
    if (sim.fluid) {
        const Fluid& fluid = *sim.fluid;
        // Gauges side by side, each by one thread.
        const auto for_gauges = [&](const auto& f) {
            parallel_blocks(0, static_cast<Index>(gauges.size()), f, 2);
        };
        std::vector<GaugeTerms> terms(gauges.size());
        const GaugeSearch search = make_gauge_search(fluid, gauges);
        for_gauges([&](Index k) { terms[at(k)] = terms_of(fluid, search, gauges[at(k)]); });
        leave_out_carpets(sim, terms);
        if (fluid.ghosts) {
            gather_terms(fluid.ghosts->comm, terms);
        }
        for_gauges(
            [&](Index k) { of_fluid[at(k)] = read_fluid(fluid, terms[at(k)], gauges[at(k)]); });
    }
    std::vector<double> readings;
    auto force = sim.gauges.forces.begin();
    for (std::size_t k = 0; k < gauges.size(); ++k) {
        if (gauges[k].type == GaugeType::force) {
            read_force(sim, *force++, readings);
        } else {
            readings.insert(readings.end(), of_fluid[k].begin(), of_fluid[k].end());
        }
    }
    return readings;
}

} // namespace hyoryu
