// SPDX-License-Identifier: MIT
// Bullet, single precision as Debian packages it by default. The floor is a box: Bullet's plane
// gains only one contact point a step, so that a box landing on it tumbles.
#include "engine.hpp"

#include <btBulletDynamicsCommon.h>

#include <cmath>

namespace hyoryu::bench {

namespace {

btVector3 to_bullet(const Vec3& v)
{
    return {static_cast<btScalar>(v.x()), static_cast<btScalar>(v.y()),
            static_cast<btScalar>(v.z())};
}

Vec3 from_bullet(const btVector3& v)
{
    return {v.x(), v.y(), v.z()};
}

btTransform pose(const State& state)
{
    const Quat& q = state.orientation;
    return btTransform(btQuaternion(static_cast<btScalar>(q.x()), static_cast<btScalar>(q.y()),
                                    static_cast<btScalar>(q.z()), static_cast<btScalar>(q.w())),
                       to_bullet(state.position));
}

// Boxes that stand for the ground: centre and size.
std::vector<std::pair<Vec3, Vec3>> ground_boxes(const Ground& ground)
{
    constexpr double thick = 1; // [m]
    const Vec3& size = ground.size;
    switch (ground.form) {
    case Ground::Form::none:
        return {};
    case Ground::Form::floor:
        return {{{0, 0, -thick / 2}, {10, 10, thick}}};
    case Ground::Form::slab:
        return {{{0, 0, -size.z() / 2}, size}};
    case Ground::Form::basin: {
        const double x = (size.x() + thick) / 2;
        const double y = (size.y() + thick) / 2;
        const Vec3 across_x{thick, size.y() + 2 * thick, size.z()};
        const Vec3 across_y{size.x() + 2 * thick, thick, size.z()};
        return {{{0, 0, -thick / 2}, {size.x(), size.y(), thick}},
                {{-x, 0, size.z() / 2}, across_x},
                {{x, 0, size.z() / 2}, across_x},
                {{0, -y, size.z() / 2}, across_y},
                {{0, y, size.z() / 2}, across_y}};
    }
    }
    return {};
}

class BulletWorld : public World {
public:
    BulletWorld(const Scene& scene, double dt) : dt_(static_cast<btScalar>(dt))
    {
        world_.setGravity(to_bullet(scene.gravity));
        btContactSolverInfo& solver = world_.getSolverInfo();
        solver.m_numIterations = 100;
        // Restitution at any speed, as the scenes ask for it; the default is none below 0.2 m/s.
        solver.m_restitutionVelocityThreshold = 0;
        // The product of two materials is the scene's value.
        const auto e = static_cast<btScalar>(std::sqrt(scene.restitution));
        const auto mu = static_cast<btScalar>(std::sqrt(scene.friction));
        for (const auto& [centre, size] : ground_boxes(scene.ground)) {
            add({Solid::Form::box, size, 0, {centre}}, e, mu);
        }
        for (const Solid& solid : scene.solids) {
            bodies_.push_back(add(solid, e, mu));
        }
    }
    BulletWorld(const BulletWorld&) = delete;
    BulletWorld& operator=(const BulletWorld&) = delete;
    ~BulletWorld() override
    {
        for (const auto& body : owned_) {
            world_.removeRigidBody(body.get());
        }
    }

    void step() override { world_.stepSimulation(dt_, 0); }

    State state(int body) const override
    {
        const btRigidBody& b = *bodies_[static_cast<std::size_t>(body)];
        const btQuaternion q = b.getWorldTransform().getRotation();
        return {from_bullet(b.getWorldTransform().getOrigin()),
                Quat(q.w(), q.x(), q.y(), q.z()).normalized(), from_bullet(b.getLinearVelocity()),
                from_bullet(b.getAngularVelocity())};
    }

    int contacts() const override
    {
        int count = 0;
        for (int k = 0; k < dispatcher_.getNumManifolds(); ++k) {
            count += dispatcher_.getInternalManifoldPointer()[k]->getNumContacts();
        }
        return count;
    }

private:
    btRigidBody* add(const Solid& solid, btScalar e, btScalar mu)
    {
        if (solid.form == Solid::Form::ball) {
            shapes_.push_back(
                std::make_unique<btSphereShape>(static_cast<btScalar>(solid.size.x() / 2)));
        } else {
            shapes_.push_back(std::make_unique<btBoxShape>(to_bullet(solid.size / 2)));
        }
        btRigidBody::btRigidBodyConstructionInfo info(static_cast<btScalar>(solid.mass), nullptr,
                                                      shapes_.back().get(),
                                                      to_bullet(inertia(solid)));
        info.m_startWorldTransform = pose(solid.start);
        info.m_restitution = e;
        info.m_friction = mu;
        owned_.push_back(std::make_unique<btRigidBody>(info));
        btRigidBody* body = owned_.back().get();
        body->setLinearVelocity(to_bullet(solid.start.velocity));
        body->setAngularVelocity(to_bullet(solid.start.omega));
        if (solid.mass > 0) {
            body->setActivationState(DISABLE_DEACTIVATION);
            body->setFlags(BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_BODY);
        }
        world_.addRigidBody(body);
        return body;
    }

    btScalar dt_;
    btDefaultCollisionConfiguration configuration_;
    mutable btCollisionDispatcher dispatcher_{&configuration_};
    btDbvtBroadphase broadphase_;
    btSequentialImpulseConstraintSolver solver_;
    btDiscreteDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
    std::vector<std::unique_ptr<btCollisionShape>> shapes_;
    std::vector<std::unique_ptr<btRigidBody>> owned_;
    std::vector<btRigidBody*> bodies_;
};

} // namespace

std::vector<Engine> bullet_engines()
{
    return {
        {"bullet",
         "sequential impulses, 100 iterations, box floor, restitution at any speed",
         {1e-3, 1e-4},
         [](const Scene& scene, double dt) { return std::make_unique<BulletWorld>(scene, dt); }}};
}

} // namespace hyoryu::bench
