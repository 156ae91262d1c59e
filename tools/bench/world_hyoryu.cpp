// SPDX-License-Identifier: MIT
// Hyoryu with its default settings.
#include "engine.hpp"

#include "hyoryu/rigid/rigid.hpp"

namespace hyoryu::bench {

namespace {

Body body_of(const Solid& solid)
{
    Body body;
    if (solid.form == Solid::Form::ball) {
        body.shape = Ball{solid.size.x() / 2};
    } else {
        body.shape = box_polytope(solid.size, 3);
    }
    body.mass = {solid.mass, inertia(solid).asDiagonal()};
    body.position = solid.start.position;
    body.orientation = solid.start.orientation;
    body.velocity = solid.start.velocity;
    body.angular_momentum = angular_momentum(solid, solid.start);
    return body;
}

std::vector<Boundary> boundaries_of(const Ground& ground)
{
    const Vec3& size = ground.size;
    switch (ground.form) {
    case Ground::Form::none:
        return {};
    case Ground::Form::floor:
        return {{"floor", Plane{}}};
    case Ground::Form::slab:
        return {{"slab", Obstacle{box_polytope(size, 3), {0, 0, -size.z() / 2}}}};
    case Ground::Form::basin:
        return {{"basin", Basin{{-size.x() / 2, -size.y() / 2, 0},
                                {size.x() / 2, size.y() / 2, size.z()},
                                {false, false, false, false, false, true}}}};
    }
    return {};
}

class HyoryuWorld : public World {
public:
    HyoryuWorld(const Scene& scene, double dt) : dt_(dt), loads_(scene.solids.size())
    {
        rigid_.settings.gravity = scene.gravity;
        rigid_.laws.otherwise = {scene.restitution, scene.friction};
        rigid_.boundaries = boundaries_of(scene.ground);
        for (const Solid& solid : scene.solids) {
            rigid_.bodies.push_back(body_of(solid));
        }
    }

    void step() override
    {
        log_.clear();
        hyoryu::step(rigid_, static_cast<double>(count_) * dt_, dt_, loads_, log_);
        ++count_;
    }

    State state(int body) const override
    {
        const Body& b = rigid_.bodies[static_cast<std::size_t>(body)];
        return {b.position, b.orientation, b.velocity, angular_velocity(b)};
    }

    int contacts() const override
    {
        int resting = 0;
        for (const Contact& contact : log_) {
            resting += contact.kind == Contact::Kind::resting ? 1 : 0;
        }
        return resting;
    }

private:
    double dt_;
    long long count_ = 0;
    std::vector<Wrench> loads_;
    Rigid rigid_;
    std::vector<Contact> log_;
};

} // namespace

std::vector<Engine> hyoryu_engines()
{
    return {{"hyoryu", "defaults", {1e-3, 1e-2}, [](const Scene& scene, double dt) {
                 return std::make_unique<HyoryuWorld>(scene, dt);
             }}};
}

} // namespace hyoryu::bench
