// SPDX-License-Identifier: MIT
#include "hyoryu/sim/frames.hpp"

#include "hyoryu/core/columns.hpp"
#include "hyoryu/scene/triangles.hpp"

#include <algorithm>
#include <numeric>

namespace hyoryu {

namespace {

void push(std::vector<float>& numbers, const Vec3& v)
{
    for (int axis = 0; axis < 3; ++axis) {
        numbers.push_back(static_cast<float>(v[axis]));
    }
}

std::vector<float> floats(std::span<const Vec3> column)
{
    std::vector<float> numbers;
    numbers.reserve(3 * column.size());
    for (const Vec3& v : column) {
        push(numbers, v);
    }
    return numbers;
}

std::vector<float> floats(std::span<const real> column)
{
    std::vector<float> numbers(column.size());
    std::transform(column.begin(), column.end(), numbers.begin(),
                   [](real v) { return static_cast<float>(v); });
    return numbers;
}

template <Field F>
Column column_of(const Store& store, F column)
{
    return {std::string(F::info.name), std::string(F::info.unit), width<F>,
            floats(std::span(store[column]))};
}

// Index of the body of each row; -1 for fluid and walls.
std::vector<std::int32_t> body_index(const Store& store, Kind kind)
{
    const auto owner = store.owner();
    return kind == Kind::body ? std::vector<std::int32_t>(owner.begin(), owner.end())
                              : std::vector<std::int32_t>(at(store.size()), -1);
}

Cloud cloud_of(const Simulation& sim, std::string name, const Store& store, Kind kind)
{
    Cloud cloud{std::move(name), sim.clock.time, sim.clock.frame};
    cloud.points = floats(std::span(store[field::position]));
    const auto ids = store.id();
    cloud.columns.push_back({"Id", "", 1, std::vector<std::int64_t>(ids.begin(), ids.end())});
    cloud.columns.push_back(column_of(store, field::velocity));
    cloud.columns.push_back(column_of(store, field::pressure));
    cloud.columns.push_back(column_of(store, field::density));
    cloud.columns.push_back(
        {"Kind", "", 1,
         std::vector<std::uint8_t>(at(store.size()), static_cast<std::uint8_t>(kind))});
    cloud.columns.push_back({"Body", "", 1, body_index(store, kind)});
    const auto& wanted = sim.scene.output.fields;
    if (std::find(wanted.begin(), wanted.end(), "volume") != wanted.end()) {
        cloud.columns.push_back(column_of(store, field::volume));
    }
    return cloud;
}

// Takes the rows behind open sides out of a frame: they are not part of the domain.
void leave_out_carpets(const Simulation& sim, Cloud& cloud)
{
    const auto x = sim.fluid->particles.fluid[field::position];
    std::vector<std::int32_t> inside;
    for (std::size_t row = 0; row < x.size(); ++row) {
        if (!is_behind(sim.open.boundary, x[row])) {
            inside.push_back(static_cast<std::int32_t>(row));
        }
    }
    cloud = some_points(cloud, inside);
}

// The value that a column has for a wall particle without a row, which no fluid is near; the volume
// follows from the wall.
double dry_value(const Fluid& fluid, const std::string& column)
{
    const real rho0 = fluid.parameters.eos.rho0;
    return column == field::density.info.name ? rho0
           : column == "Kind"                 ? static_cast<double>(Kind::wall)
           : column == "Body"                 ? -1
                                              : 0;
}

// Puts each row of a column at its place, and the value of dry walls at all others.
void spread(Column& column, std::span<const std::size_t> place, std::size_t count, double dry)
{
    const auto width = at(column.components);
    std::visit(
        [&]<class T>(std::vector<T>& values) {
            std::vector<T> all(count * width, static_cast<T>(dry));
            for (std::size_t row = 0; row < place.size(); ++row) {
                std::copy_n(&values[row * width], width, &all[place[row] * width]);
            }
            values = std::move(all);
        },
        column.values);
}

// Appends a surface and returns the number of corners it added.
std::size_t append(Surface& all, const TriangleSurface& part, const Pose& pose)
{
    const auto first = static_cast<std::int32_t>(all.points.size() / 3);
    for (const Vec3& corner : part.corners) {
        push(all.points, pose.position + pose.orientation * corner);
    }
    for (const auto& triangle : part.triangles) {
        for (const int corner : triangle) {
            all.triangles.push_back(first + corner);
        }
    }
    return part.corners.size();
}

} // namespace

Cloud fluid_cloud(const Simulation& sim)
{
    Cloud cloud = cloud_of(sim, "fluid", sim.fluid->particles.fluid, Kind::fluid);
    if (sim.open.runs()) {
        leave_out_carpets(sim, cloud);
    }
    return cloud;
}

Cloud wall_rows_cloud(const Simulation& sim)
{
    const Fluid& fluid = *sim.fluid;
    Cloud cloud = cloud_of(sim, "walls", fluid.particles.wall, Kind::wall);
    if (fluid.ghosts) { // every rank has the rows of walls that move
        std::vector<std::int32_t> own = fluid.neighbours.wall.row;
        std::ranges::sort(own);
        cloud = some_points(cloud, own);
    }
    return cloud;
}

NumberRange all_walls(const Simulation& sim)
{
    return {sim.plan.counts.fluid, sim.plan.counts.fluid + sim.plan.counts.wall};
}

std::vector<std::int64_t> numbers_in(const Cloud& cloud)
{
    return std::get<std::vector<std::int64_t>>(cloud.columns.front().values);
}

Cloud some_points(const Cloud& cloud, std::span<const std::int32_t> rows)
{
    Cloud some{cloud.name, cloud.time, cloud.index};
    const Column points = some_rows({"", "", 3, cloud.points}, rows);
    some.points = std::get<std::vector<float>>(points.values);
    for (const Column& column : cloud.columns) {
        some.columns.push_back(some_rows(column, rows));
    }
    return some;
}

// Those of fixed walls that have no row are made.
Cloud wall_cloud(const Simulation& sim, Cloud rows, const NumberRange& range)
{
    const Fluid& fluid = *sim.fluid;
    const auto count = at(range.end - range.begin);
    const std::vector<std::int64_t> numbers = numbers_in(rows);
    std::vector<std::size_t> place(numbers.size());
    std::ranges::transform(numbers, place.begin(),
                           [&](std::int64_t number) { return at(number - range.begin); });
    for (Column& column : rows.columns) {
        spread(column, place, count, dry_value(fluid, column.name));
    }
    std::vector<std::int64_t> all(count);
    std::iota(all.begin(), all.end(), range.begin);
    rows.columns.front().values = std::move(all);
    Column points{"", "", 3, std::move(rows.points)};
    spread(points, place, count, 0);
    rows.points = std::move(std::get<std::vector<float>>(points.values));
    const auto volume = std::ranges::find(rows.columns, field::volume.info.name, &Column::name);
    std::vector<float>* const volumes =
        volume != rows.columns.end() ? &std::get<std::vector<float>>(volume->values) : nullptr;
    const auto first = static_cast<std::int32_t>(range.begin - sim.plan.counts.fluid);
    for (const IndexRun& run : fluid.fixed_walls.run) {
        const std::int32_t begin = std::max(run.first, first);
        const std::int32_t end =
            std::min(run.first + run.count, first + static_cast<std::int32_t>(count));
        for (std::int32_t index = begin; index < end; ++index) {
            const WallPoint made = fluid.fixed_walls.make(index);
            for (Index axis = 0; axis < 3; ++axis) {
                rows.points[3 * at(index - first) + at(axis)] =
                    static_cast<float>(made.place[axis]);
            }
            if (volumes != nullptr && (*volumes)[at(index - first)] == 0) { // without a row
                (*volumes)[at(index - first)] =
                    static_cast<float>(made.displaced_mass / fluid.parameters.eos.rho0);
            }
        }
    }
    return rows;
}

Cloud wall_cloud(const Simulation& sim)
{
    return wall_cloud(sim, wall_rows_cloud(sim), all_walls(sim));
}

Cloud body_cloud(const Simulation& sim, const Store* particles)
{
    Cloud cloud{"bodies", sim.clock.time, sim.clock.frame};
    if (particles != nullptr) {
        cloud = cloud_of(sim, "bodies", *particles, Kind::body);
        cloud.points.clear(); // the rows stand where the loads were taken, half a step back
    }
    std::vector<float> velocities;
    std::vector<std::int32_t> bodies;
    for (std::size_t b = 0; b < sim.rigid.bodies.size(); ++b) {
        const Body& body = sim.rigid.bodies[b];
        const Vec3 omega = angular_velocity(body);
        for (Index k = sim.body_particles.of[b].begin; k < sim.body_particles.of[b].end; ++k) {
            const Vec3 r = body.orientation * sim.body_particles.points[at(k)];
            push(cloud.points, body.position + r);
            push(velocities, body.velocity + omega.cross(r));
            bodies.push_back(static_cast<std::int32_t>(b));
        }
    }
    const std::size_t count = bodies.size();
    if (particles != nullptr) {
        cloud.columns[1].values = std::move(velocities);
        return cloud;
    }
    std::vector<std::int64_t> ids(count);
    std::iota(ids.begin(), ids.end(), std::int64_t{0});
    cloud.columns = {
        {"Id", "", 1, std::move(ids)},
        {"Velocity", "m/s", 3, std::move(velocities)},
        {"Kind", "", 1, std::vector<std::uint8_t>(count, static_cast<std::uint8_t>(Kind::body))},
        {"Body", "", 1, std::move(bodies)}};
    return cloud;
}

Cloud body_cloud(const Simulation& sim)
{
    return body_cloud(sim, sim.fluid ? &sim.fluid->particles.body : nullptr);
}

Surface body_surface(const Simulation& sim)
{
    Surface all{"surfaces", sim.clock.time, sim.clock.frame};
    std::vector<std::int32_t> bodies;
    std::vector<float> velocities;
    for (std::size_t b = 0; b < sim.rigid.bodies.size(); ++b) {
        const Body& body = sim.rigid.bodies[b];
        if (body.left) {
            continue;
        }
        TriangleSurface own = triangles_of(sim.scene.bodies[b].shape, sim.scene.dimensions);
        move_to_middle(sim.scene.bodies[b], own.corners);
        const std::size_t added = append(all, own, {body.position, body.orientation});
        const Vec3 omega = angular_velocity(body);
        bodies.insert(bodies.end(), added, static_cast<std::int32_t>(b));
        for (const Vec3& corner : own.corners) {
            push(velocities, body.velocity + omega.cross(body.orientation * corner));
        }
    }
    all.columns = {{"Body", "", 1, std::move(bodies)},
                   {"Velocity", "m/s", 3, std::move(velocities)}};
    return all;
}

Surface wall_surface(const Scene& scene, const Bounds& domain, const Clock& clock)
{
    Surface all{"structures", clock.time, clock.frame};
    std::vector<std::int32_t> walls;
    for (std::size_t w = 0; w < scene.walls.size(); ++w) {
        const std::size_t added =
            append(all, triangles_of(scene.walls[w], domain, scene.dimensions),
                   {displacement(scene.walls[w].motion, clock.time), Quat::Identity()});
        walls.insert(walls.end(), added, static_cast<std::int32_t>(w));
    }
    all.columns = {{"Wall", "", 1, std::move(walls)}};
    return all;
}

} // namespace hyoryu
