// SPDX-License-Identifier: MIT
// Collisions of fluid particles, for splashes.
#pragma once

#include "hyoryu/fluid/slot.hpp"
#include "hyoryu/fluid/stage.hpp"
#include "hyoryu/fluid/wall.hpp"

#include <string>

namespace hyoryu {

/// Fluid particles closer than one spacing and still approaching exchange the impulse that stops
/// (part of) their approach: the term of `SolidBackstop` between two of them, times 1 + e.
/// Momentum is kept, energy falls. Source: Jandaghian, Krimi & Shakibaeinia (2021), dynamic
/// particle collision, without the repulsion of receding particles.
struct ParticleCollision {
    static constexpr std::string_view name = "particle_collision";
    using Writes = Fields<>;
    struct Sum {
        static void call(const auto& terms, const auto& f) { f(terms.collision); }
    };
    using Passes = PassList<Sum>;
    real restitution = 0; // e [1]

    /// For particles of this mass over a step.
    SolidBackstop term(real spacing, real mass, real dt) const
    {
        return {spacing, dt > 0 ? (1 + restitution) * mass / (2 * dt) : 0};
    }
};

/// Collisions, as the user chooses them.
struct DynamicCollision {
    static constexpr std::string_view name = ParticleCollision::name;
    using Makes = TermList<ParticleCollision>;
    static constexpr std::string_view model = "dynamic";
    static constexpr std::string_view says =
        "stops the approach of fluid particles that are closer than a spacing, which damps "
        "splashes and dissipates energy";
    double restitution = 0; // [1]

    static void keys(auto& keys, auto& chosen)
    {
        keys.fraction("restitution", chosen.restitution,
                      "Coefficient of restitution of the collisions.");
    }
    std::string why() const { return "`fluid.collision.model` is \"dynamic\": damps splashes"; }
    void fill(auto& slot, const FluidParameters& /*fluid*/) const
    {
        slot = ParticleCollision{restitution};
    }
};

/// With the pressure force.
struct CollisionSlot {
    using Models = std::variant<Off, DynamicCollision>;
    using Terms = TermsOf<Models>;
    static constexpr SlotTable table{
        "collision", "Collisions between fluid particles, for splashes.",
        "; \"none\" disables collisions.", "`fluid.collision.model` is \"none\""};
};

namespace slot {
inline constexpr CollisionSlot collision{};
}

} // namespace hyoryu
