// SPDX-License-Identifier: MIT
// What a process sees of others while it packs its fluid.
#pragma once

#include "fill_region.hpp"

namespace hyoryu {

/// Copies of the particles of other processes: of the fluid behind the own ones of a filling as
/// long as this lives, of the walls by themselves.
class FillNeighbours {
public:
    /// `reach`: to which particles look [m].
    FillNeighbours(const FillRegion& region, double reach, Filling& filling)
        : own_(filling.fluid.size()), filling_(filling), halo_(region, filling.fluid, reach)
    {
        append(filling.fluid);
        append(filling.fluid_depth);
        append(filling.fluid_cut);
        filling.fluid_number = joined(filling.fluid_number);
        const FillHalo of_walls(region, filling.wall, reach);
        walls_ = of_walls.fetch(std::span<const Vec3>(filling.wall));
    }
    ~FillNeighbours()
    {
        filling_.fluid.resize(own_);
        filling_.fluid_depth.resize(own_);
        filling_.fluid_cut.resize(own_);
        filling_.fluid_number.resize(own_);
    }
    FillNeighbours(const FillNeighbours&) = delete;
    FillNeighbours& operator=(const FillNeighbours&) = delete;

    std::size_t own() const { return own_; }
    const std::vector<Vec3>& walls() const { return walls_; }
    /// Own values, and behind them those of the copies.
    template <class T>
    std::vector<T> joined(std::vector<T> own) const
    {
        const std::vector<T> copies = halo_.fetch(std::span<const T>(own));
        own.insert(own.end(), copies.begin(), copies.end());
        return own;
    }
    /// From now on values of the marked ones alone.
    void keep(std::span<const std::uint8_t> marked) { halo_.keep(marked); }
    std::vector<Vec3> fetch(std::span<const Vec3> own) const { return halo_.fetch(own); }

private:
    template <class T>
    void append(std::vector<T>& column)
    {
        column = joined(std::move(column));
    }

    std::size_t own_;
    Filling& filling_;
    FillHalo halo_;
    std::vector<Vec3> walls_; // of other processes [m]
};

} // namespace hyoryu
