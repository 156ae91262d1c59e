// SPDX-License-Identifier: MIT
// The one file of an effect that a test adds to the program; see CMakeLists.txt for the one line.
#pragma once

#include "hyoryu/fluid/parameters.hpp"
#include "hyoryu/fluid/slot.hpp"
#include "hyoryu/fluid/stage.hpp"

#include <fmt/format.h>

namespace hyoryu {

/// The power that the drag does on a particle, half of that of each of its pairs.
struct DragPower {
    using type = real;
    static constexpr FieldInfo info{"DragPower", "W", Holders::fluid, true};
};
namespace field {
inline constexpr DragPower drag_power{};
}

/// F_i = -sum_j V_i V_j k rho0 W u u^2 / (u^2 + u0^2), u = v_i - v_j: a drag between particles that
/// fades below the relative speed u0. Made up for the test.
struct PairDrag {
    static constexpr std::string_view name = "pair_drag";
    using Stage = stage::Forces;
    using Reads = Fields<Velocity, Volume>;
    using Writes = Fields<Force, DragPower>;
    real strength = 0;  // k rho0 [kg/m3/s]
    real threshold = 1; // u0 [m/s]

    template <class N>
    void operator()(const Pair<N>& ij, const auto& i, const auto& j, auto& sum) const
    {
        const Vec<N> u = i[field::velocity] - j[field::velocity];
        const N squared = dot(u, u);
        const N share = squared / (squared + sq(threshold));
        const N weight = strength * (i[field::volume] * j[field::volume]) * ij.w * share;
        sum[field::force] += -weight * u;
        sum[field::drag_power] += -0.5 * weight * squared;
    }
};

/// The drag, as the user chooses it.
struct ChosenDrag {
    static constexpr std::string_view name = PairDrag::name;
    using Makes = TermList<PairDrag>;
    static constexpr std::string_view model = "pair";
    static constexpr std::string_view says = "brakes particles that pass each other";
    double rate = 3;        // k [1/s]
    double threshold = 0.1; // u0 [m/s]

    static void keys(auto& keys, auto& chosen)
    {
        keys.not_negative("rate", chosen.rate, "1/s", "Rate at which relative motion decays.");
        keys.positive("threshold", chosen.threshold, "m/s",
                      "Relative speed below which the drag fades.");
    }
    std::string why() const
    {
        return fmt::format("`fluid.drag.model` is \"pair\", rate = {} 1/s", rate);
    }
    void fill(auto& slot, const FluidParameters& f) const
    {
        if (rate > 0) {
            slot = PairDrag{f.eos.rho0 * rate, threshold};
        }
    }
};

/// With the pressure force.
struct DragSlot {
    using Models = std::variant<Off, ChosenDrag>;
    using Terms = TermsOf<Models>;
    static constexpr SlotTable table{"drag", "Drag between particles.", "; \"none\" is no drag.",
                                     "`fluid.drag.model` is \"none\""};
};

} // namespace hyoryu
