// SPDX-License-Identifier: MIT
// Continuity at solids that is the adjoint of the pressure of solids.
//
// A solid particle pushes with the mean pressure of the fluid before it. The plain continuity
// contains only the motion of the fluid relative to the solid, so that the water beside a wall is
// too soft: sound beside walls is too slow, and the pressure of a jet on a plate too low. Here each
// solid particle sums the compression of the fluid before it, and the fluid takes this compression
// over with the weights with which the solid takes over its pressure. With the plain gradient the
// work of that pressure is then the change of the compression energy.
//
// One part is left out. At a free surface, fluid that moves along a wall covers or uncovers solid
// particles, and the sum takes this for a compression. The velocity of the fluid is therefore split
// into its mean and the difference to the mean. Of the mean only the component normal to the
// surface counts; the difference counts in full. The normal is that of the fluid particles: kernel
// sums over solid particles, which continue above the free surface. In a thin body with fluid on
// both sides these normals cancel; the less they agree, the less is left out.
#pragma once

#include "hyoryu/fluid/continuity.hpp"
#include "hyoryu/fluid/slot.hpp"
#include "hyoryu/fluid/stage.hpp"

#include <algorithm>

namespace hyoryu {

struct Fluid;

/// sum_s V_s F r over the solids near a fluid particle, along the normal of their surface.
struct WallNormal {
    using type = Vec3;
    static constexpr FieldInfo info{"WallNormal", "1/m", Holders::fluid};
};
/// Sums over the fluid before a solid particle: W N and W N^2, N the normals of the fluid
/// particles, and V F r over the fluid under pressure.
struct NormalSum {
    using type = Vec3;
    static constexpr FieldInfo info{"NormalSum", "1/m4", Holders::solids};
};
struct NormalSquares {
    using type = real;
    static constexpr FieldInfo info{"NormalSquares", "1/m5", Holders::solids};
};
struct GradientSum {
    using type = Vec3;
    static constexpr FieldInfo info{"GradientSum", "1/m", Holders::solids};
};
/// The rate of compression of the fluid before a solid particle; after the sums divided by S = sum
/// W.
struct WallCompression {
    using type = real;
    static constexpr FieldInfo info{"WallCompression", "m3/s", Holders::solids};
};
/// Rate of compression that fluid takes over from solids, times its volume.
struct PairedRate {
    using type = real;
    static constexpr FieldInfo info{"PairedRate", "m3/s", Holders::fluid};
};
namespace field {
inline constexpr WallNormal wall_normal{};
inline constexpr NormalSum normal_sum{};
inline constexpr NormalSquares normal_squares{};
inline constexpr GradientSum gradient_sum{};
inline constexpr WallCompression wall_compression{};
inline constexpr PairedRate paired_rate{};
} // namespace field

/// Sums over the fluid before a solid particle, from which `compression_before` makes D. Pairs
/// count where the solid presses on the fluid: both under pressure, as in `WallPressureForce`.
/// Ours.
struct PairedWalls {
    static constexpr std::string_view name = "paired_walls";
    using Reads = Fields<Velocity, Volume, Pressure, WallNormal>;
    using Writes = Fields<VelocitySum, NormalSum, NormalSquares, GradientSum, WallCompression>;
    using Columns = Union<Writes, Fields<WallNormal, PairedRate, ShepardSum>>;
    static constexpr bool needs_solids = true;
    /// The compression of the fluid before a solid that approaches it, over that of the plain
    /// continuity [1].
    static constexpr real stiffness = 2;

    template <class N>
    void operator()(const Pair<N>& ij, const auto& i, const auto& j, auto& sum) const
    {
        const N both = positive(i[field::pressure]) * positive(j[field::pressure]);
        const N share = where_positive(both, N(j[field::volume] * ij.f));
        sum[field::wall_compression] += share * dot(i[field::velocity] - j[field::velocity], ij.r);
        sum[field::gradient_sum] += share * ij.r;
        sum[field::velocity_sum] += ij.w * j[field::velocity];
        sum[field::normal_sum] += ij.w * j[field::wall_normal];
        sum[field::normal_squares] += ij.w * dot(j[field::wall_normal], j[field::wall_normal]);
    }

    /// Along the normal of the solids near a fluid particle.
    struct Normal {
        static constexpr std::string_view name = "wall_normal";
        using Reads = Fields<Volume>;
        using Writes = Fields<WallNormal>;

        template <class N>
        void operator()(const Pair<N>& ij, const auto&, const auto& j, auto& sum) const
        {
            sum[field::wall_normal] += (j[field::volume] * ij.f) * ij.r;
        }
    };

    /// sum_s V_s D_s W/S_s, S_s = sum_f W; times rho_i/V_i a rate of density.
    struct Rate {
        static constexpr std::string_view name = "paired_rate";
        using Reads = Fields<Volume, WallCompression>;
        using Writes = Fields<PairedRate>;

        template <class N>
        void operator()(const Pair<N>& ij, const auto&, const auto& j, auto& sum) const
        {
            sum[field::paired_rate] += (j[field::volume] * ij.w) * j[field::wall_compression];
        }
    };

    struct Before; // sums this term
    struct Rates : PassOf<Rate> {};
    using Passes = PassList<Before, Rates>;
};

struct PairedWalls::Before : PassOf<PairedWalls> {};

/// The normal n before a solid particle: the sums of W N and W N^2 over the fluid, N its normals,
/// and S that of W. They agree if n^2 = (sum W N)^2/(S sum W N^2) is 1, and cancel if it is 0.
struct NormalsBefore {
    Vec3 sum;
    real squares = 0;
    real weight = 0;
};

/// D = sum_f V_f (u - v_f) . r F, less the part of the mean motion along the surface: `compression`
/// is that sum, `motion` u - <v> and `gradient` sum_f V_f r F. All of that part is left out if n^2
/// is at least a quarter, in proportion to n^2 below: at a plane wall with two rows of fluid within
/// reach n^2 is above 0.9, at a contact line, too.
inline real compression_before(real compression, const Vec3& motion, const Vec3& gradient,
                               const NormalsBefore& normals)
{
    const real all = normals.weight * normals.squares / 4;
    const real squared = normals.sum.squaredNorm();
    if (!(all > 0)) {
        return compression;
    }
    const real share = std::min(squared / all, real(1));
    const real along = gradient.dot(motion) * share -
                       gradient.dot(normals.sum) * normals.sum.dot(motion) / std::max(squared, all);
    return compression - along;
}

/// Adds what fluid takes over from solids to the part of its rate of density that is due to solids,
/// after the normals were summed: solids do not stretch fluid without pressure (fluid/parting).
void add_paired_rates(Fluid& fluid);

/// The continuity at solids, as the user chooses it.
struct WallContinuitySettings {
    bool paired = false;

    static void keys(auto& keys, auto& chosen)
    {
        keys.choice("wall_continuity", chosen.paired, {"plain", "paired"},
                    "Continuity equation at walls and bodies. \"plain\": from the motion of the "
                    "fluid relative to them; \"paired\": also from the compression in front of "
                    "each solid particle, with the weights of its pressure, which is more accurate "
                    "for sound near walls and for jets on walls.");
    }
};

/// Beside the plain continuity; `WallContinuitySettings` decide whether it holds its term.
struct WallContinuitySlot {
    using Terms = std::variant<Off, PairedWalls>;
};

namespace slot {
inline constexpr WallContinuitySlot wall_continuity{};
}

} // namespace hyoryu
