// SPDX-License-Identifier: MIT
// MuJoCo, double precision, Newton solver, with its pyramidal and its elliptic friction cones.
#include "engine.hpp"

#include "hyoryu/core/error.hpp"

#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace hyoryu::bench {

namespace {

enum class Cone { pyramidal, elliptic };

// Restitution of a linear spring and dashpot that lets go when its force is zero:
// e = exp(-2 zeta / sqrt(1 - zeta^2) atan(sqrt(1 - zeta^2) / zeta)); here zeta of e, by bisection.
double damping_ratio(double restitution)
{
    double low = 0;
    double high = 1;
    for (int k = 0; k < 60; ++k) {
        const double zeta = (low + high) / 2;
        const double root = std::sqrt(1 - zeta * zeta);
        const double e = std::exp(-2 * zeta / root * std::atan2(root, zeta));
        (e > restitution ? low : high) = zeta;
    }
    return (low + high) / 2;
}

// MuJoCo has no coefficient of restitution: a contact is a spring and a dashpot, (-k, -b) per unit
// mass. Stiff enough to last ten steps, damped for e; without restitution critically damped with a
// time constant of five steps, since at the two steps that its manual allows the stacks burst.
std::string solref(double restitution, double dt)
{
    if (restitution <= 0) {
        return fmt::format("{} 1", 5 * dt);
    }
    const double zeta = damping_ratio(restitution);
    const double omega = 3.14159265358979323846 / (10 * dt * std::sqrt(1 - zeta * zeta));
    return fmt::format("{} {}", -omega * omega, -2 * zeta * omega);
}

// The impedance, constant: the nearer to one the more rigid. Rest takes it closer than impacts,
// where 0.9999 spoils the timber without friction.
double impedance(double restitution)
{
    return restitution > 0 ? 0.99 : 0.9999;
}

std::string text(const Vec3& v)
{
    return fmt::format("{} {} {}", v.x(), v.y(), v.z());
}

std::string ground_geoms(const Ground& ground)
{
    const Vec3& size = ground.size;
    const auto plane = [](const Vec3& point, const Vec3& normal) {
        return fmt::format("<geom type='plane' size='0 0 1' pos='{}' zaxis='{}'/>\n", text(point),
                           text(normal));
    };
    switch (ground.form) {
    case Ground::Form::none:
        return "";
    case Ground::Form::floor:
        return plane({0, 0, 0}, {0, 0, 1});
    case Ground::Form::slab:
        return fmt::format("<geom type='box' size='{}' pos='0 0 {}'/>\n", text(size / 2),
                           -size.z() / 2);
    case Ground::Form::basin:
        return plane({0, 0, 0}, {0, 0, 1}) + plane({-size.x() / 2, 0, 0}, {1, 0, 0}) +
               plane({size.x() / 2, 0, 0}, {-1, 0, 0}) + plane({0, -size.y() / 2, 0}, {0, 1, 0}) +
               plane({0, size.y() / 2, 0}, {0, -1, 0});
    }
    return "";
}

std::string solid_body(const Solid& solid)
{
    const Quat& q = solid.start.orientation;
    const bool ball = solid.form == Solid::Form::ball;
    const std::string form = ball ? fmt::format("type='sphere' size='{}'", solid.size.x() / 2)
                                  : fmt::format("type='box' size='{}'", text(solid.size / 2));
    return fmt::format("<body pos='{}' quat='{} {} {} {}'><freejoint/>"
                       "<inertial pos='0 0 0' mass='{}' diaginertia='{}'/><geom {}/></body>\n",
                       text(solid.start.position), q.w(), q.x(), q.y(), q.z(), solid.mass,
                       text(inertia(solid)), form);
}

std::string model_text(const Scene& scene, double dt, Cone cone)
{
    const std::size_t n = scene.solids.size();
    // Room for ten contacts a body, four rows each: twice what a heap needs, and no more, since
    // MuJoCo reserves the square of it. The sparse solver keeps large heaps affordable.
    const std::string room = fmt::format("<size nconmax='{}' njmax='{}' nstack='{}'/>", 50 + 10 * n,
                                         200 + 40 * n, 1000000 + 100000 * n);
    // The fourth-order integrator where nothing can touch: it is MuJoCo's best for a free rotor.
    const bool free = scene.ground.form == Ground::Form::none && n == 1;
    std::string bodies;
    for (const Solid& solid : scene.solids) {
        bodies += solid_body(solid);
    }
    return fmt::format(
        "<mujoco>{}<compiler angle='radian'/>"
        "<option timestep='{}' gravity='{}' cone='{}' integrator='{}' jacobian='{}'"
        " solver='Newton' iterations='100' tolerance='1e-12'/>\n"
        // Condim 3: sliding friction alone.
        "<default><geom condim='3' friction='{} 0 0' solref='{}' solimp='{} {} 0.001'/>"
        "</default>\n<worldbody>\n{}{}</worldbody></mujoco>\n",
        room, dt, text(scene.gravity), cone == Cone::elliptic ? "elliptic" : "pyramidal",
        free ? "RK4" : "Euler", n > 20 ? "sparse" : "dense", scene.friction,
        solref(scene.restitution, dt), impedance(scene.restitution), impedance(scene.restitution),
        ground_geoms(scene.ground), bodies);
}

mjModel* load(const std::string& xml)
{
    const auto files = std::make_unique<mjVFS>();
    mj_defaultVFS(files.get());
    mj_makeEmptyFileVFS(files.get(), "scene.xml", static_cast<int>(xml.size()));
    std::memcpy(files->filedata[0], xml.data(), xml.size());
    std::array<char, 500> error{};
    mjModel* model =
        mj_loadXML("scene.xml", files.get(), error.data(), static_cast<int>(error.size()));
    mj_deleteVFS(files.get());
    if (model == nullptr) {
        throw std::runtime_error(std::string("mujoco: ") + error.data());
    }
    return model;
}

class MujocoWorld : public World {
public:
    MujocoWorld(const Scene& scene, double dt, Cone cone)
        : model_(load(model_text(scene, dt, cone)))
    {
        data_.reset(mj_makeData(model_.get()));
        for (std::size_t k = 0; k < scene.solids.size(); ++k) {
            const State& s = scene.solids[k].start;
            const Vec3 local =
                s.orientation.conjugate() * s.omega; // as MuJoCo's free joints have it
            std::copy_n(s.velocity.data(), 3, data_->qvel + 6 * k);
            std::copy_n(local.data(), 3, data_->qvel + 6 * k + 3);
        }
    }

    void step() override { mj_step(model_.get(), data_.get()); }

    State state(int body) const override
    {
        const double* x = data_->qpos + 7 * body;
        const double* v = data_->qvel + 6 * body;
        const Quat q = Quat(x[3], x[4], x[5], x[6]).normalized();
        return {{x[0], x[1], x[2]}, q, {v[0], v[1], v[2]}, q * Vec3(v[3], v[4], v[5])};
    }

    int contacts() const override { return data_->ncon; }

private:
    struct Delete {
        void operator()(mjModel* model) const { mj_deleteModel(model); }
        void operator()(mjData* data) const { mj_deleteData(data); }
    };
    std::unique_ptr<mjModel, Delete> model_;
    std::unique_ptr<mjData, Delete> data_;
};

} // namespace

std::vector<Engine> mujoco_engines()
{
    const auto make = [](Cone cone) {
        return [cone](const Scene& scene, double dt) {
            return std::make_unique<MujocoWorld>(scene, dt, cone);
        };
    };
    // It keeps the square of the rows in one buffer of at most 2 GB: too little for 1,000 boxes.
    constexpr std::size_t most = 300;
    const std::string common =
        " cone, Newton solver, solref for e over 10 steps and solimp 0.99, or "
        "for rest solref 5 steps and solimp 0.9999";
    return {{"mujoco", "pyramidal" + common, {1e-3, 1e-4}, make(Cone::pyramidal), most},
            {"mujoco_elliptic", "elliptic" + common, {1e-3, 1e-4}, make(Cone::elliptic), most}};
}

} // namespace hyoryu::bench
