// SPDX-License-Identifier: MIT
// Windows among the walls of a scene.
#pragma once

#include "hyoryu/scene/fill.hpp"

namespace hyoryu {

/// A point of the vertical at a distance from a window, in the middle of a lane; z is 0.
Vec3 point_of_window(const OpenSide& side, int lane, double distance);

/// Whether a wall stands right behind the window, where its carpet would lie.
bool is_walled(const Scene& scene, const OpenSide& side);

/// Whether the lower edge of the window is on the ground or below it.
bool stands_on_ground(const Scene& scene, const OpenSide& side);

/// Whether walls that emerge at a level bar every way from the window through its strip, to the far
/// end of it or to what lies beside it.
bool is_barred(const Scene& scene, const OpenSide& side, double level);

/// How far the ground goes on behind the window [m]: to the first place, in any lane, from which it
/// is more than one and a half spacings away; at most the length of the carpet.
double ground_behind(const Scene& scene, const OpenSide& side);

/// Continues the fixed walls outwards from the plane of a window, below and beside the carpet:
/// particles outside are dropped, and those of the first spacing inside are copied column by
/// column.
class CarriedWalls {
public:
    CarriedWalls(const Scene& scene, const OpenSettings& open);

    int columns() const { return columns_; }
    /// Whether a particle of a wall stays, and whether it is copied.
    bool stays(const Vec3& place, std::int32_t wall) const;
    bool is_copied(const Vec3& place, std::int32_t wall) const;
    /// From a particle to its copy in a column, 1, 2, ... [m].
    Vec3 shift(int column) const;

private:
    double distance(const Vec3& place) const;
    bool belongs(const Vec3& place, std::int32_t wall) const;

    const Scene& scene_;
    const OpenSettings& open_;
    int layers_, columns_;
};

/// Continues the fixed walls at all windows.
void carry_walls_out(const Scene& scene, Filling& filling);

} // namespace hyoryu
