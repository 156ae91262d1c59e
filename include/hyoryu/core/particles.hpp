// SPDX-License-Identifier: MIT
// Particles in stores, one for each kind: fluid, wall and body. A store has a column for each field
// that an active effect needs on its kind, and no other; rows are numbered from 0 in each store, so
// that particles of one kind come and go without moving those of another.
#pragma once

#include "hyoryu/core/error.hpp"
#include "hyoryu/core/fields.hpp"
#include "hyoryu/core/first_touch.hpp"
#include "hyoryu/core/parallel.hpp"

#include <algorithm>
#include <concepts>
#include <span>
#include <variant>
#include <vector>

namespace hyoryu {

/// Consecutive rows [begin, end) of a store.
struct Rows {
    Index begin = 0;
    Index end = 0;
    Index size() const { return end - begin; }
};

/// The kind of a particle; the values are those of the `Kind` array of frame files.
enum class Kind : std::uint8_t { fluid = 0, wall = 1, body = 2 };

/// A column of a store by row, of either integer type.
template <class T>
class ColumnView : public std::span<T> {
public:
    using std::span<T>::span;
    constexpr ColumnView(std::span<T> column) : std::span<T>(column) {}
    constexpr T& operator[](std::integral auto row) const { return this->data()[row]; }
};

/// A column that exists, for plans and memory reports.
struct ColumnInfo {
    FieldInfo field;
    std::size_t bytes_per_particle = 0;
    bool of_fluid = false;
    bool of_solids = false;
};

/// Addresses of the columns of a store as plain numbers, three to a vector. The hot loops find the
/// columns that they write once for each block.
class ColumnPointers {
public:
    /// The column of a field; null if it is absent.
    template <Field F>
    real* operator[](F) const
    {
        for (int k = 0; k < count_; ++k) {
            if (column_[k].field == &F::info) {
                return column_[k].first;
            }
        }
        return nullptr;
    }
    void add(const FieldInfo* field, real* first)
    {
        expects(count_ < most);
        column_[count_++] = {field, first};
    }

private:
    static constexpr int most = 32;
    struct Entry {
        const FieldInfo* field;
        real* first;
    };
    Entry column_[most];
    int count_ = 0;
};

/// The particles of one kind. A field is known by the address of its `info`, so that an effect may
/// bring a field of its own.
class Store {
public:
    explicit Store(Kind kind) : kind_(kind) {}

    /// Sets the number of rows and removes all columns; numbers are 0.
    void reset(Index rows);
    /// Sets the number of rows and makes the columns of another store of this kind, zeroed; numbers
    /// are 0.
    void reset_like(const Store& other, Index rows);

    /// Makes columns for the listed fields that particles of this kind have, zeroed.
    template <class... F>
    void add(Fields<F...>)
    {
        (make_column<F>(), ...);
    }

    Index size() const { return static_cast<Index>(id_.size()); }
    Rows rows() const { return {0, size()}; }

    template <Field F>
    bool has(F) const
    {
        return find(columns_, &F::info) != nullptr;
    }
    /// Whether particles of this kind have the field where an effect needs it.
    template <Field F>
    bool may_have(F) const
    {
        return F::info.holders == Holders::all ||
               (F::info.holders == Holders::fluid) == (kind_ == Kind::fluid);
    }

    /// The column of a field, which must exist.
    template <Field F>
    ColumnView<typename F::type> operator[](F)
    {
        auto* const column = find(columns_, &F::info);
        expects(column != nullptr);
        return std::span(std::get<ColumnValues<typename F::type>>(column->values));
    }
    template <Field F>
    ColumnView<const typename F::type> operator[](F) const
    {
        const auto* const column = find(columns_, &F::info);
        expects(column != nullptr);
        return std::span(std::get<ColumnValues<typename F::type>>(column->values));
    }

    ColumnPointers pointers();

    /// Number of a particle for life, unique over all kinds.
    ColumnView<std::int64_t> id() { return std::span(id_); }
    ColumnView<const std::int64_t> id() const { return std::span(id_); }
    /// The owner of each solid particle: the index of a body, or -1 - (index of a wall). Fluid has
    /// no owner and no such column.
    ColumnView<std::int32_t> owner() { return std::span(owner_); }
    ColumnView<const std::int32_t> owner() const { return std::span(owner_); }

    /// Makes the store anew from rows of its own: row k becomes what row `from[k]` was, or a row of
    /// zeros where that is -1; rows that `from` leaves out are removed. `room` is memory that
    /// nobody needs meanwhile, 24 B a row; where it is too small, memory is taken.
    void gather(std::span<const std::int32_t> from, std::span<std::byte> room = {});

    /// Calls f(info, values) for each column, `values` of type ColumnValues<real> or
    /// ColumnValues<Vec3>.
    void for_each_column(auto&& f)
    {
        for (StoredColumn& column : columns_) {
            std::visit([&](auto& values) { f(*column.field, values); }, column.values);
        }
    }
    void for_each_column(auto&& f) const
    {
        for (const StoredColumn& column : columns_) {
            std::visit([&](const auto& values) { f(*column.field, values); }, column.values);
        }
    }
    /// Bytes held.
    std::size_t bytes() const;

private:
    struct StoredColumn {
        const FieldInfo* field;
        std::variant<ColumnValues<real>, ColumnValues<Vec3>> values;
    };

    template <Field F>
    void make_column()
    {
        using Values = ColumnValues<typename F::type>;
        if (!may_have(F{})) {
            return;
        }
        StoredColumn* column = find(columns_, &F::info);
        if (column == nullptr) {
            column = &columns_.emplace_back(StoredColumn{&F::info, Values()});
        }
        std::get<Values>(column->values).assign(id_.size(), uniform<typename F::type>(0));
    }

    // Null if the column is absent.
    static auto* find(auto& columns, const FieldInfo* field)
    {
        const auto found = std::ranges::find(columns, field, &StoredColumn::field);
        return found == columns.end() ? nullptr : &*found;
    }

    Kind kind_;
    std::vector<StoredColumn> columns_;
    ColumnValues<std::int64_t> id_;
    ColumnValues<std::int32_t> owner_;
};

/// All particles of a scene.
struct Particles {
    Store fluid{Kind::fluid};
    Store wall{Kind::wall};
    Store body{Kind::body};

    Index size() const { return fluid.size() + solids(); }
    Index solids() const { return wall.size() + body.size(); }
};

/// Sets the number of particles of each kind, numbered on from 0 in the order fluid, wall, body;
/// there are no columns yet.
void reset(Particles& particles, Index fluid, Index wall, Index body);

/// Calls f(store) for walls and bodies.
void for_solids(auto& particles, const auto& f)
{
    f(particles.wall);
    f(particles.body);
}

/// Makes columns in every store whose particles have the field.
template <class List>
void add_columns(Particles& particles, List fields)
{
    particles.fluid.add(fields);
    for_solids(particles, [&](Store& store) { store.add(fields); });
}

/// The columns of all stores, each field once.
std::vector<ColumnInfo> active_columns(const Particles& particles);
/// Bytes held.
std::size_t bytes_of(const Particles& particles);

} // namespace hyoryu
