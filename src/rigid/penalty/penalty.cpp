// SPDX-License-Identifier: MIT
#include "penalty.hpp"

#include "penalty_pairs.hpp"

#include "hyoryu/core/error.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace hyoryu {

namespace {

// Skin of the pair search in units of the smallest spacing: the pairs remain valid until bodies
// have moved by this distance.
constexpr double skin_spacings = 0.25;

/// Sums of the interaction of two bodies, or of a body and a boundary, over the step.
struct Sum {
    Vec3 normal{0, 0, 0};   // impulse along the lines of the pairs, on a [N s]
    Vec3 friction{0, 0, 0}; // impulse of their friction, on a [N s]
    Vec3 point{0, 0, 0};    // weighted by force [m N s]
    double weight = 0;      // [N s]
    double lost = 0;        // [J]
};

double smallest_spacing(const Penalty& penalty)
{
    double smallest = infinity;
    for (const auto* clouds : {&penalty.bodies, &penalty.obstacles}) {
        for (const ParticleCloud& cloud : *clouds) {
            smallest = cloud.points.empty() ? smallest : std::min(smallest, cloud.spacing);
        }
    }
    return penalty.wall_spacing > 0 ? std::min(smallest, penalty.wall_spacing) : smallest;
}

class PenaltyStep {
public:
    explicit PenaltyStep(const StepContext& context)
        : context_(context), memory_(context.memory),
          parameters_(context.rigid.penalty->parameters),
          skin_(skin_spacings * smallest_spacing(*context.rigid.penalty)),
          pushes_(context.rigid.bodies.size())
    {
        for (const Boundary& wall : context.rigid.boundaries) {
            places_.emplace_back(displacement(wall.motion, context.start));
        }
    }

    void run()
    {
        // A step that is a whole number of sub-steps but for round-off gets that number.
        constexpr double whole = 1 - 1e-9;
        const double count = std::max(1.0, std::ceil(context_.dt / parameters_.step * whole));
        const double h = context_.dt / count;
        for (int k = 0; k < static_cast<int>(context_.rigid.bodies.size()); ++k) {
            set_response(context_, k);
        }
        travelled_ = infinity;
        for (double n = 0; n < count; ++n) {
            sub_step(context_.start + n * h, h);
        }
        log();
    }

private:
    void sub_step(double time, double h)
    {
        move_walls(time);
        if (!(travelled_ < skin_)) {
            meetings_ = find_meetings(context_, skin_, time);
            travelled_ = 0;
        }
        pushes_.assign(context_.loads.begin(), context_.loads.end());
        for (const Meeting& meeting : meetings_) {
            push(meeting, time, h);
        }
        double fastest = 0;
        for (int k = 0; k < static_cast<int>(pushes_.size()); ++k) {
            move(k, h);
            const Response& body = memory_.responses[k];
            fastest = std::max(fastest, body.v.norm() + body.omega.norm() * reach(k));
        }
        travelled_ += 2 * h * fastest; // two bodies may approach each other
    }

    double reach(int k) const { return context_.rigid.penalty->bodies[k].reach; }

    // Walls go to where they are at this time.
    void move_walls(double time)
    {
        double farthest = 0;
        for (std::size_t w = 0; w < places_.size(); ++w) {
            const Vec3 place = displacement(context_.rigid.boundaries[w].motion, time);
            farthest = std::max(farthest, (place - places_[w]).norm());
            places_[w] = place;
        }
        travelled_ += farthest;
    }

    void push(const Meeting& meeting, double time, double h)
    {
        const auto [a, b] = meeting.who;
        const Vec3 other_velocity = wall_velocity(memory_, b, time);
        const double mu = law_of(context_.rigid, a, b).friction;
        Sum& sum = sums_[meeting.who];
        for (const ParticlePair& pair : meeting.pairs) {
            const Vec3 xa = memory_.poses[a].x + memory_.poses[a].R * pair.a;
            const Vec3 xb = b >= 0 ? Vec3(memory_.poses[b].x + memory_.poses[b].R * pair.b)
                                   : Vec3(pair.b + places_[-1 - b]);
            const Vec3 line = xa - xb;
            const double r = line.norm();
            if (r >= meeting.range || r == 0) {
                continue;
            }
            const Vec3 n = line / r;
            const Vec3 middle = 0.5 * (xa + xb);
            const Vec3 u = velocity_at(memory_, a, middle) -
                           (b >= 0 ? velocity_at(memory_, b, middle) : other_velocity);
            const double spring = parameters_.stiffness * (meeting.range - r);
            const double separation = n.dot(u);
            const double F = std::max(0.0, spring - parameters_.damping * separation);
            const Vec3 slip = u - separation * n;
            const double slip_speed = slip.norm();
            const double drag = // friction by speed of sliding [N s/m]
                slip_speed > 0 ? std::min(parameters_.damping, mu * F / slip_speed) : 0;
            sum.normal += h * F * n;
            sum.friction -= h * drag * slip;
            sum.point += h * F * middle;
            sum.weight += h * F;
            sum.lost += h * ((spring - F) * separation + drag * sq(slip_speed));
            apply(a, middle, F * n - drag * slip);
            if (b >= 0) {
                apply(b, middle, drag * slip - F * n);
            }
            double& worst = context_.rigid.counters.worst_penetration;
            worst = std::max(worst, meeting.range - r);
        }
    }

    void apply(int k, const Vec3& point, const Vec3& force)
    {
        Wrench& push = pushes_[k];
        push.force += force;
        push.torque += (point - memory_.poses[k].x).cross(force);
    }

    // Symplectic Euler: velocities first, then places with the new velocities.
    void move(int k, double h)
    {
        const Rotor& rotor = memory_.rotors[k];
        if (!rotor.movable) {
            return;
        }
        Body& body = context_.rigid.bodies[k];
        const Wrench& push = pushes_[k];
        body.velocity += h * rotor.inverse_mass.cwiseProduct(
                                 body.mass.mass * context_.rigid.settings.gravity + push.force);
        for (int m = 0; m < 3; ++m) {
            body.angular_momentum[m] += rotor.turns[m] ? h * push.torque[m] : 0;
        }
        SolidPose& pose = memory_.poses[k];
        pose = pose_of(pose.x + h * body.velocity, turned(rotor, pose.q, body.angular_momentum, h));
        set_response(context_, k);
    }

    double effective_mass(const Contact& contact) const
    {
        double K = 0; // n . K n [1/kg]
        for (const int k : {contact.a, contact.b}) {
            if (k >= 0) {
                const Response& body = memory_.responses[k];
                const Vec3 turn = (contact.point - memory_.poses[k].x).cross(contact.normal);
                K += contact.normal.dot(body.inverse_mass.cwiseProduct(contact.normal)) +
                     turn.dot(body.inverse_inertia * turn);
            }
        }
        return K > 0 ? 1 / K : 0;
    }

    void log() const
    {
        for (const auto& [who, sum] : sums_) {
            if (sum.weight == 0) {
                continue; // near, but did not touch
            }
            Contact contact{Contact::Kind::resting, context_.start + context_.dt, who.a, who.b,
                            sum.point / sum.weight};
            contact.normal_impulse = sum.normal.norm();
            if (contact.normal_impulse > 0) { // pushes from two sides may cancel
                contact.normal = sum.normal / contact.normal_impulse;
            }
            contact.tangential_impulse = sum.friction;
            contact.effective_mass = effective_mass(contact);
            contact.energy_lost = sum.lost;
            context_.log.push_back(contact);
        }
    }

    const StepContext& context_;
    ContactMemory& memory_;
    const PenaltyParameters& parameters_;
    double skin_;
    double travelled_ = 0; // since the particles were paired up, at most [m]
    std::vector<Meeting> meetings_;
    std::map<BodyPair, Sum> sums_;
    std::vector<Wrench> pushes_; // on each body in this sub-step
    std::vector<Vec3> places_;   // displacement of each boundary
};

} // namespace

void step_by_penalty(const StepContext& context)
{
    const Penalty& penalty = *context.rigid.penalty;
    expects(penalty.bodies.size() == context.rigid.bodies.size());
    expects(penalty.obstacles.size() == context.rigid.boundaries.size());
    PenaltyStep(context).run();
}

} // namespace hyoryu
