// SPDX-License-Identifier: MIT
// Fields of a particle as tag types, lists of them, and records that hold exactly the listed ones.
//
// One bracket everywhere: `particles[field::velocity]` is a column, `i[field::velocity]` the value
// of one particle, `sum[field::force]` an accumulator. A record knows only the fields it was made
// for, so a term that touches an undeclared field does not compile.
#pragma once

#include "hyoryu/core/vec.hpp"

#include <string_view>
#include <type_traits>

namespace hyoryu {

/// The kinds of particles that have a field.
enum class Holders { all, fluid, solids };

/// A field as it stands in output files, plans and checkpoints.
struct FieldInfo {
    std::string_view name;
    std::string_view unit;
    Holders holders = Holders::all;
    /// Whether the value at the start of a step is part of the state of the fluid, which a
    /// checkpoint keeps; every other field is computed anew before it is read.
    bool state = false;
};

template <class F>
concept Field = requires
{
    typename F::type;
    {
        F::info
        } -> std::convertible_to<FieldInfo>;
};

/// A number, or a vector of three equal ones.
template <class T>
T uniform(real all)
{
    if constexpr (std::is_same_v<T, Vec3>) {
        return Vec3::Constant(all);
    } else {
        return all;
    }
}

// The number of scalars in a field: 1 or 3.
template <Field F>
inline constexpr int width = std::is_same_v<typename F::type, Vec3> ? 3 : 1;

// clang-format off
struct Position        { using type = Vec3; static constexpr FieldInfo info{"Position", "m", Holders::all, true}; };
struct Velocity        { using type = Vec3; static constexpr FieldInfo info{"Velocity", "m/s", Holders::all, true}; };
struct Density         { using type = real; static constexpr FieldInfo info{"Density", "kg/m3", Holders::all, true}; };
struct Pressure        { using type = real; static constexpr FieldInfo info{"Pressure", "Pa"}; };
/// Volume that the particle stands for; m2 in two dimensions.
struct Volume          { using type = real; static constexpr FieldInfo info{"Volume", "m3"}; };
/// Rate of density of the last continuity sum.
struct DensityRate     { using type = real; static constexpr FieldInfo info{"DensityRate", "kg/m3/s", Holders::fluid, true}; };
/// Part of the density rate that the density-diffusion effect adds.
struct DiffusionRate   { using type = real; static constexpr FieldInfo info{"DiffusionRate", "kg/m3/s", Holders::fluid}; };
/// Part of the density rate due to solids.
struct SolidRate       { using type = real; static constexpr FieldInfo info{"SolidRate", "kg/m3/s", Holders::fluid, true}; };
/// Density that fluid without pressure kept while it moved away from solids (the gap, [kg/m3]).
struct Gap             { using type = real; static constexpr FieldInfo info{"Gap", "kg/m3", Holders::fluid, true}; };
/// Density that fluid at the void pressure has lost to the cavity opening in it [kg/m3].
struct Cavity          { using type = real; static constexpr FieldInfo info{"Cavity", "kg/m3", Holders::fluid, true}; };
/// Sum of pair forces that depend on positions and densities; N/m in two dimensions.
struct Force           { using type = Vec3; static constexpr FieldInfo info{"Force", "N", Holders::all, true}; };
/// Sum of pair forces that depend on velocities.
struct ViscousForce    { using type = Vec3; static constexpr FieldInfo info{"ViscousForce", "N", Holders::all, true}; };
/// Sum for the gradient of the pressure, later replaced by the renormalised gradient.
struct PressureGradient { using type = Vec3; static constexpr FieldInfo info{"PressureGradient", "Pa/m", Holders::fluid}; };
/// Second moments of V grad W, by which a gradient is corrected: xx, yy, zz and yz, xz, xy.
struct Moments         { using type = Vec3; static constexpr FieldInfo info{"Moments", "1", Holders::fluid}; };
struct MixedMoments    { using type = Vec3; static constexpr FieldInfo info{"MixedMoments", "1", Holders::fluid}; };
/// B - 1 of the corrected gradient, B the inverse of those moments: xx, yy, zz and yz, xz, xy.
struct GradientCorrection { using type = Vec3; static constexpr FieldInfo info{"GradientCorrection", "1", Holders::fluid, true}; };
struct MixedCorrection { using type = Vec3; static constexpr FieldInfo info{"MixedCorrection", "1", Holders::fluid, true}; };
/// Density due to the correction of the divergence, less the relaxed part, and its rate.
struct Correction      { using type = real; static constexpr FieldInfo info{"Correction", "kg/m3", Holders::fluid, true}; };
struct CorrectionRate  { using type = real; static constexpr FieldInfo info{"CorrectionRate", "kg/m3/s", Holders::fluid, true}; };
/// Sum that points to where particles are dense, by which they are shifted.
struct ShiftGradient   { using type = Vec3; static constexpr FieldInfo info{"ShiftGradient", "1/m", Holders::fluid}; };
/// Twice the rate of strain, xx, yy, zz and yz, xz, xy, and the eddy viscosity that it makes.
struct Strain          { using type = Vec3; static constexpr FieldInfo info{"Strain", "1/s", Holders::fluid}; };
struct MixedStrain     { using type = Vec3; static constexpr FieldInfo info{"MixedStrain", "1/s", Holders::fluid}; };
struct TurbulentViscosity { using type = real; static constexpr FieldInfo info{"TurbulentViscosity", "m2/s", Holders::fluid}; };
/// Kernel sums over particles of the other kind, fluid or solid; by them a solid particle takes over
/// the state of the fluid before it.
struct ShepardSum      { using type = real; static constexpr FieldInfo info{"ShepardSum", "1/m3"}; };
struct VelocitySum     { using type = Vec3; static constexpr FieldInfo info{"VelocitySum", "1/m2/s", Holders::solids}; };
struct OffsetSum       { using type = Vec3; static constexpr FieldInfo info{"OffsetSum", "1/m2", Holders::solids}; };
/// Mass of the water at rest that fits into the cell of a solid particle; kg/m in two dimensions.
struct DisplacedMass   { using type = real; static constexpr FieldInfo info{"DisplacedMass", "kg", Holders::solids}; };
/// Depth of a solid particle behind the surface of its solid.
struct Depth           { using type = real; static constexpr FieldInfo info{"Depth", "m", Holders::solids}; };

/// The values by which columns and records are indexed: `particles[field::velocity]`.
namespace field {
inline constexpr Position        position{};
inline constexpr Velocity        velocity{};
inline constexpr Density         density{};
inline constexpr Pressure        pressure{};
inline constexpr Volume          volume{};
inline constexpr DensityRate     density_rate{};
inline constexpr DiffusionRate   diffusion_rate{};
inline constexpr SolidRate       solid_rate{};
inline constexpr Gap             gap{};
inline constexpr Cavity          cavity{};
inline constexpr Force           force{};
inline constexpr ViscousForce    viscous_force{};
inline constexpr PressureGradient pressure_gradient{};
inline constexpr Moments         moments{};
inline constexpr MixedMoments    mixed_moments{};
inline constexpr GradientCorrection gradient_correction{};
inline constexpr MixedCorrection mixed_correction{};
inline constexpr Correction      correction{};
inline constexpr CorrectionRate  correction_rate{};
inline constexpr ShiftGradient   shift_gradient{};
inline constexpr ShepardSum      shepard_sum{};
inline constexpr VelocitySum     velocity_sum{};
inline constexpr OffsetSum       offset_sum{};
inline constexpr DisplacedMass   displaced_mass{};
inline constexpr Depth           depth{};
inline constexpr Strain          strain{};
inline constexpr MixedStrain     mixed_strain{};
inline constexpr TurbulentViscosity turbulent_viscosity{};
} // namespace field
// clang-format on

/// A list of fields.
template <Field... F>
struct Fields {
    static constexpr int count = sizeof...(F);
    static constexpr int scalars = (0 + ... + width<F>);
};

template <class F, class List>
inline constexpr bool contains = false;
template <class F, class... G>
inline constexpr bool contains<F, Fields<G...>> = (std::is_same_v<F, G> || ...);

namespace detail {
template <class... Lists>
struct UnionOf;
template <class... F>
struct UnionOf<Fields<F...>> {
    using type = Fields<F...>;
};
template <class... F, class... Rest>
struct UnionOf<Fields<F...>, Fields<>, Rest...> : UnionOf<Fields<F...>, Rest...> {
};
template <class... F, class G, class... H, class... Rest>
struct UnionOf<Fields<F...>, Fields<G, H...>, Rest...>
    : std::conditional_t<contains<G, Fields<F...>>, UnionOf<Fields<F...>, Fields<H...>, Rest...>,
                         UnionOf<Fields<F..., G>, Fields<H...>, Rest...>> {
};
} // namespace detail

/// All fields of the lists, each once, in the order of first appearance.
template <class... Lists>
using Union = typename detail::UnionOf<Fields<>, Lists...>::type;

/// First scalar of field F in a flat row of the list.
template <class F, class List>
inline constexpr int offset = 0;
template <class F, class... G>
inline constexpr int offset<F, Fields<G...>> = [] {
    int at = 0;
    int found = -1;
    ((found = std::is_same_v<F, G> ? at : found, at += width<G>), ...);
    return found;
}();

/// One field of one particle (N = real) or of several side by side (N = Pack).
template <Field F, class N>
struct Slot {
    using type = std::conditional_t<width<F> == 3, Vec<N>, N>;
    type value{};
    constexpr type& operator[](F) { return value; }
    constexpr const type& operator[](F) const { return value; }
};

/// The listed fields and nothing else.
template <class List, class N>
struct Record;
template <class N>
struct Record<Fields<>, N> {
};
template <class... F, class N>
requires(sizeof...(F) > 0) struct Record<Fields<F...>, N> : Slot<F, N>... {
    using Slot<F, N>::operator[]...;
};

/// Calls `f(tag)` for each field of the list.
template <class... F>
constexpr void for_each(Fields<F...>, auto&& f)
{
    (f(F{}), ...);
}

} // namespace hyoryu
