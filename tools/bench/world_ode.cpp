// SPDX-License-Identifier: MIT
// ODE, double precision, with its direct step (Dantzig) and its iterative one (QuickStep).
#include "engine.hpp"

#include <ode/ode.h>

#include <array>
#include <cstdarg>

namespace hyoryu::bench {

namespace {

enum class Method { direct, quick };

// ODE counts its initialisations.
struct Library {
    Library()
    {
        dInitODE2(0);
        // ODE tells of every linear complementarity problem that it could not solve, thousands in a
        // run of the cradle; the errors of the metrics say it better.
        dSetMessageHandler([](int, const char*, va_list) {});
    }
    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;
    ~Library() { dCloseODE(); }
};

class OdeWorld : public World {
public:
    OdeWorld(const Scene& scene, double dt, Method method) : dt_(dt), method_(method)
    {
        dWorldSetGravity(world_, scene.gravity.x(), scene.gravity.y(), scene.gravity.z());
        // Rigid: no softness beyond rounding; ODE's default share of an error corrected a step.
        dWorldSetCFM(world_, 1e-10);
        dWorldSetERP(world_, 0.2);
        dWorldSetQuickStepNumIterations(world_, 100);
        // Mu as a coefficient times the normal force, not as a largest force.
        surface_.mode = dContactBounce | dContactApprox1;
        surface_.mu = scene.friction;
        surface_.bounce = scene.restitution;
        surface_.bounce_vel = 1e-4; // restitution at all but resting speeds [m/s]
        add_ground(scene.ground);
        for (const Solid& solid : scene.solids) {
            add(solid);
        }
    }
    OdeWorld(const OdeWorld&) = delete;
    OdeWorld& operator=(const OdeWorld&) = delete;
    ~OdeWorld() override
    {
        dJointGroupDestroy(joints_);
        dSpaceDestroy(space_);
        dWorldDestroy(world_);
    }

    void step() override
    {
        dJointGroupEmpty(joints_);
        count_ = 0;
        dSpaceCollide(space_, this, [](void* self, dGeomID a, dGeomID b) {
            static_cast<OdeWorld*>(self)->collide(a, b);
        });
        if (method_ == Method::direct) {
            dWorldStep(world_, dt_);
        } else {
            dWorldQuickStep(world_, dt_);
        }
    }

    State state(int body) const override
    {
        const dBodyID b = bodies_[static_cast<std::size_t>(body)];
        const dReal* x = dBodyGetPosition(b);
        const dReal* q = dBodyGetQuaternion(b);
        const dReal* v = dBodyGetLinearVel(b);
        const dReal* w = dBodyGetAngularVel(b);
        return {{x[0], x[1], x[2]},
                Quat(q[0], q[1], q[2], q[3]),
                {v[0], v[1], v[2]},
                {w[0], w[1], w[2]}};
    }

    int contacts() const override { return count_; }

private:
    void collide(dGeomID a, dGeomID b)
    {
        const dBodyID first = dGeomGetBody(a);
        const dBodyID second = dGeomGetBody(b);
        if (first == nullptr && second == nullptr) {
            return;
        }
        std::array<dContact, 8> found{};
        const int count = dCollide(a, b, static_cast<int>(found.size()), &found[0].geom,
                                   static_cast<int>(sizeof(dContact)));
        for (int k = 0; k < count; ++k) {
            dContact& contact = found[static_cast<std::size_t>(k)];
            contact.surface = surface_;
            dJointAttach(dJointCreateContact(world_, joints_, &contact), first, second);
        }
        count_ += count;
    }

    void add_ground(const Ground& ground)
    {
        const Vec3& size = ground.size;
        if (ground.form == Ground::Form::slab) {
            dGeomSetPosition(dCreateBox(space_, size.x(), size.y(), size.z()), 0, 0, -size.z() / 2);
        } else if (ground.form != Ground::Form::none) {
            dCreatePlane(space_, 0, 0, 1, 0);
        }
        if (ground.form == Ground::Form::basin) {
            dCreatePlane(space_, 1, 0, 0, -size.x() / 2);
            dCreatePlane(space_, -1, 0, 0, -size.x() / 2);
            dCreatePlane(space_, 0, 1, 0, -size.y() / 2);
            dCreatePlane(space_, 0, -1, 0, -size.y() / 2);
        }
    }

    void add(const Solid& solid)
    {
        const Vec3& size = solid.size;
        const bool ball = solid.form == Solid::Form::ball;
        const dBodyID body = dBodyCreate(world_);
        const dGeomID geom = ball ? dCreateSphere(space_, size.x() / 2)
                                  : dCreateBox(space_, size.x(), size.y(), size.z());
        const Vec3 I = inertia(solid);
        dMass mass;
        dMassSetParameters(&mass, solid.mass, 0, 0, 0, I.x(), I.y(), I.z(), 0, 0, 0);
        dBodySetMass(body, &mass);
        dGeomSetBody(geom, body);
        const State& s = solid.start;
        const std::array<dReal, 4> q{s.orientation.w(), s.orientation.x(), s.orientation.y(),
                                     s.orientation.z()};
        dBodySetPosition(body, s.position.x(), s.position.y(), s.position.z());
        dBodySetQuaternion(body, q.data());
        dBodySetLinearVel(body, s.velocity.x(), s.velocity.y(), s.velocity.z());
        dBodySetAngularVel(body, s.omega.x(), s.omega.y(), s.omega.z());
        bodies_.push_back(body);
    }

    Library library_;
    double dt_;
    Method method_;
    dWorldID world_ = dWorldCreate();
    dSpaceID space_ = dHashSpaceCreate(nullptr);
    dJointGroupID joints_ = dJointGroupCreate(0);
    dSurfaceParameters surface_{};
    int count_ = 0;
    std::vector<dBodyID> bodies_;
};

} // namespace

std::vector<Engine> ode_engines()
{
    const auto make = [](Method method) {
        return [method](const Scene& scene, double dt) {
            return std::make_unique<OdeWorld>(scene, dt, method);
        };
    };
    const std::string common = ", CFM 1e-10, ERP 0.2, at most 8 points a pair";
    return {{"ode", "dWorldStep" + common, {1e-3, 1e-4}, make(Method::direct)},
            {"ode_quick",
             "dWorldQuickStep, 100 iterations" + common,
             {1e-3, 1e-4},
             make(Method::quick)}};
}

} // namespace hyoryu::bench
