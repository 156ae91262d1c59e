// SPDX-License-Identifier: MIT
#include "crush_check.hpp"

#include "diagnostics.hpp"

#include "hyoryu/scene/moving_walls.hpp"
#include "hyoryu/sim/simulation.hpp"

#include <algorithm>
#include <functional>

namespace hyoryu {

namespace {

// A contact transmits the push if its normal is within acos of this of the direction of the push.
constexpr double straight_on = 0.5;

// The contacts of the last step with a normal impulse, by body.
using Pressing = std::vector<std::vector<Contact>>;

// Each seen from the body: the normal points towards it, the other one is b; the deepest first.
Pressing pressing_by_body(const Simulation& sim)
{
    Pressing all(sim.rigid.bodies.size());
    for (Contact c : sim.contacts) {
        if (c.normal_impulse > 0) {
            all[at(c.a)].push_back(c);
            if (c.b >= 0) {
                std::swap(c.a, c.b);
                c.normal = -c.normal;
                all[at(c.a)].push_back(c);
            }
        }
    }
    for (std::vector<Contact>& of_body : all) {
        std::ranges::stable_sort(of_body, std::greater<>(), &Contact::depth);
    }
    return all;
}

// The column of bodies through which a push acts, up to a solid that does not yield.
class PushedColumn {
public:
    PushedColumn(const Simulation& sim, const Pressing& pressing, const Contact& push)
        : sim_(sim), pressing_(pressing), push_(push), speed_(speed_of(push.b)),
          seen_(sim.rigid.bodies.size())
    {
    }

    // The solid at the end of a column, and the room that is missing there: the overlaps along it.
    struct End {
        int against = 0;
        double missing = 0; // [m]
    };
    End worst()
    {
        if (speed_ > 0) {
            follow(push_.a, push_.depth);
        }
        return worst_;
    }

private:
    // Along the push; zero for a body, which yields [m/s].
    double speed_of(int b) const
    {
        return b < 0 ? push_.normal.dot(
                           velocity(sim_.rigid.boundaries[at(-1 - b)].motion, sim_.clock.time))
                     : 0;
    }

    bool stands(int b) const
    {
        if (b < 0) {
            return speed_of(b) < speed_;
        }
        const auto& locks = sim_.rigid.bodies[at(b)].locks;
        return locks[0] && locks[1] && locks[2];
    }

    void follow(int body, double missing)
    {
        seen_[at(body)] = true;
        for (const Contact& c : pressing_[at(body)]) {
            const double so_far = missing + c.depth;
            if (c.normal.dot(push_.normal) > -straight_on) {
                continue;
            }
            if (stands(c.b)) {
                worst_ = so_far > worst_.missing ? End{c.b, so_far} : worst_;
            } else if (c.b >= 0 && !seen_[at(c.b)]) {
                follow(c.b, so_far);
            }
        }
    }

    const Simulation& sim_;
    const Pressing& pressing_;
    const Contact& push_;
    double speed_;           // of the pushing wall, along the push [m/s]
    std::vector<bool> seen_; // by body
    End worst_;
};

} // namespace

std::optional<Crushed> crushed(const Simulation& sim)
{
    const double deep = 0.25 * std::min(sim.scene.spacing, sim.thinnest);
    const auto& walls = sim.rigid.boundaries;
    if (!has_moving_walls(sim.scene)) {
        return std::nullopt;
    }
    double all = 0;
    for (const Contact& c : sim.contacts) {
        all += c.depth;
    }
    if (all <= deep) {
        return std::nullopt;
    }
    const Pressing pressing = pressing_by_body(sim);
    for (const Contact& c : sim.contacts) {
        if (c.b >= 0 || c.normal_impulse <= 0 || !moves(walls[at(-1 - c.b)].motion)) {
            continue;
        }
        const auto [against, missing] = PushedColumn(sim, pressing, c).worst();
        if (missing > deep) {
            return Crushed{sim.rigid.bodies[at(c.a)].name, walls[at(-1 - c.b)].name,
                           solid_name(sim, against), missing};
        }
    }
    return std::nullopt;
}

} // namespace hyoryu
