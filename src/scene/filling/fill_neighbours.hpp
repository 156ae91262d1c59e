// SPDX-License-Identifier: MIT
// Copies of particles of other processes that the packing of the fluid needs.
#pragma once

#include "fill_region.hpp"

namespace hyoryu {

/// Appends copies of the fluid particles of other processes to those of a filling, and removes them
/// in the destructor; keeps copies of wall particles apart.
class FillNeighbours {
public:
    /// `reach`: distance within which particles interact [m]. `cubes`: volumes of the cells of the
    /// walls.
    FillNeighbours(const FillRegion& region, double reach, std::span<const float> cubes,
                   Filling& filling)
        : own_(filling.fluid.size()), filling_(filling), halo_(region, filling.fluid, reach)
    {
        append(filling.fluid);
        append(filling.fluid_depth);
        append(filling.fluid_cut);
        filling.fluid_number = joined(filling.fluid_number);
        const FillHalo of_walls(region, filling.wall, reach);
        walls_ = of_walls.fetch(std::span<const Vec3>(filling.wall));
        wall_cubes_ = of_walls.fetch(cubes);
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
    const std::vector<float>& wall_cubes() const { return wall_cubes_; }
    /// The values of this process, followed by those of the copies.
    template <class T>
    std::vector<T> joined(std::vector<T> own) const
    {
        const std::vector<T> copies = halo_.fetch(std::span<const T>(own));
        own.insert(own.end(), copies.begin(), copies.end());
        return own;
    }
    /// As of FillHalo.
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
    std::vector<Vec3> walls_;       // of other processes [m]
    std::vector<float> wall_cubes_; // volumes of their cells [cubes of the spacing]
};

} // namespace hyoryu
