// SPDX-License-Identifier: MIT
// All particles in one store: columns that exist only if an active effect needs them, rows ordered
// fluid | wall | body.
#pragma once

#include "hyoryu/core/error.hpp"
#include "hyoryu/core/fields.hpp"
#include "hyoryu/core/parallel.hpp"

#include <span>
#include <string>
#include <tuple>
#include <vector>

namespace hyoryu {

/// Every field that a column can be made of. A new field is one line here and one in fields.hpp.
using AllFields = Fields<Position, Velocity, Density, Pressure, Volume, DensityRate, DiffusionRate,
                         SolidRate, Gap, Cavity, Force, ViscousForce, ShepardSum, PressureGradient,
                         CrowdingGradient, Moments, MixedMoments, ShiftGradient, VelocitySum,
                         OffsetSum, Depth, Strain, MixedStrain, TurbulentViscosity>;

/// Consecutive rows [begin, end).
struct Rows {
    Index begin = 0;
    Index end = 0;
    Index size() const { return end - begin; }
};

/// What a row stands for; the values are those of the `Kind` array of frame files.
enum class Kind : std::uint8_t { fluid = 0, wall = 1, body = 2 };

/// The owner of a fluid particle.
inline constexpr std::int32_t no_owner = std::numeric_limits<std::int32_t>::min();

/// A column that exists, for plans and memory reports.
struct ColumnInfo {
    FieldInfo field;
    std::size_t bytes_per_particle = 0;
    bool of_fluid_alone = false; // solid particles have none
};

namespace detail {
template <class List>
struct ColumnsOf;
template <class... F>
struct ColumnsOf<Fields<F...>> {
    using type = std::tuple<std::vector<typename F::type>...>;
};
template <class F, class List>
inline constexpr std::size_t index_in = 0;
template <class F, class... G>
inline constexpr std::size_t index_in<F, Fields<G...>> = [] {
    std::size_t at = 0;
    std::size_t found = sizeof...(G);
    ((found = std::is_same_v<F, G> ? at : found, ++at), ...);
    return found;
}();
} // namespace detail

/// Addresses of the columns of a store as plain numbers, three to a vector; null if absent.
class ColumnPointers {
public:
    template <Field F>
    real*& operator[](F)
    {
        return column_[detail::index_in<F, AllFields>];
    }
    template <Field F>
    real* operator[](F) const
    {
        return column_[detail::index_in<F, AllFields>];
    }

private:
    real* column_[AllFields::count] = {};
};

class Particles {
public:
    /// Makes columns for the listed fields, zeroed, and rows of each kind. Any other field stays
    /// absent.
    template <class... F>
    void allocate(Fields<F...>, Index fluid, Index wall, Index body)
    {
        fluid_ = {0, fluid};
        wall_ = {fluid, fluid + wall};
        body_ = {fluid + wall, fluid + wall + body};
        (make_column<F>(), ...);
        id_.assign(static_cast<std::size_t>(size()), 0);
        owner_.assign(static_cast<std::size_t>(size()), no_owner);
    }

    /// Makes more columns, zeroed, for the rows there are.
    template <class... F>
    void add(Fields<F...>)
    {
        (make_column<F>(), ...);
    }

    Index size() const { return body_.end; }
    Rows fluid() const { return fluid_; }
    Rows wall() const { return wall_; }
    Rows body() const { return body_; }
    Rows solid() const { return {wall_.begin, body_.end}; }

    template <Field F>
    bool has(F) const
    {
        return active_[detail::index_in<F, AllFields>];
    }

    /// The column of a field, by row; a field of the fluid alone ends with the rows of the fluid.
    /// The field must be active.
    template <Field F>
    std::span<typename F::type> operator[](F)
    {
        expects(has(F{}));
        return std::get<detail::index_in<F, AllFields>>(columns_);
    }
    template <Field F>
    std::span<const typename F::type> operator[](F) const
    {
        expects(has(F{}));
        return std::get<detail::index_in<F, AllFields>>(columns_);
    }

    ColumnPointers pointers()
    {
        ColumnPointers all;
        for_each_column([&](auto field, auto column) {
            if constexpr (width<decltype(field)> == 3) {
                all[field] = column.empty() ? nullptr : column.front().data();
            } else {
                all[field] = column.data();
            }
        });
        return all;
    }

    /// Number of a particle for life, unique over all kinds.
    std::span<std::int64_t> id() { return id_; }
    std::span<const std::int64_t> id() const { return id_; }
    /// Whose particle it is: the index of a body, -1 - (index of a wall), or `no_owner` for fluid.
    std::span<std::int32_t> owner() { return owner_; }
    std::span<const std::int32_t> owner() const { return owner_; }

    /// Reorders the fluid rows: row k becomes what row `order[k]` was. Rows that `order` leaves out
    /// are gone, and everything behind moves up. `room` is memory that nobody needs meanwhile, 24 B
    /// a row; where it is too small, memory is taken.
    void permute_fluid(std::span<const std::int32_t> order, std::span<std::byte> room = {});

    std::vector<ColumnInfo> active_columns() const;
    /// Bytes held.
    std::size_t bytes() const;

    /// Calls `f(tag, span)` for each active column.
    void for_each_column(auto&& f)
    {
        for_each(AllFields{}, [&](auto field) {
            if (has(field)) {
                f(field, (*this)[field]);
            }
        });
    }

private:
    template <Field F>
    void make_column()
    {
        active_[detail::index_in<F, AllFields>] = true;
        auto& column = std::get<detail::index_in<F, AllFields>>(columns_);
        const auto rows = static_cast<std::size_t>(of_fluid_alone<F> ? fluid_.end : size());
        if constexpr (width<F> == 3) {
            column.assign(rows, Vec3::Zero());
        } else {
            column.assign(rows, 0);
        }
    }

    Rows fluid_, wall_, body_;
    std::array<bool, static_cast<std::size_t>(AllFields::count)> active_{};
    detail::ColumnsOf<AllFields>::type columns_;
    std::vector<std::int64_t> id_;
    std::vector<std::int32_t> owner_;
};

} // namespace hyoryu
