// SPDX-License-Identifier: MIT
// The open sides of a case, and the flow prescribed there.
#pragma once

#include "hyoryu/core/types.hpp"
#include "hyoryu/fluid/open_boundary.hpp"
#include "hyoryu/scene/place.hpp"

#include <optional>
#include <string>
#include <vector>

namespace hyoryu {

struct Scene;

/// The condition at a window: a prescribed flow; none; the still water outside.
enum class OpenKind { inflow, outflow, absorb };
enum class FlowProfile { uniform, power };
/// The condition for bodies at a window: a smooth surface stops them without rebound, or they leave
/// the run.
enum class BodiesAtSide { stop, leave };

/// The flow at one place of a window: linear between its times, held before and after them. Each
/// list is as long as that of the times, or empty.
struct OpenSeries {
    double at = 0;                  // along the window [m]
    std::vector<double> times;      // [s]
    std::vector<double> levels;     // z of the free surface [m]
    std::vector<double> velocities; // into the domain [m/s]
    std::vector<double> discharges; // into the domain [m3/s]; m2/s in two dimensions
    Place place;
};

/// A window in a side of the domain through which fluid enters and leaves.
struct OpenSettings {
    std::string name;
    Vec3 min{0, 0, 0}, max{0, 0, 0}; // [m]; equal along the normal
    int into = 0;                    // +x -x +y -y: the direction into the domain
    OpenKind kind = OpenKind::inflow;
    std::optional<double> level;     // z of the free surface [m]
    std::optional<double> velocity;  // into the domain [m/s]
    std::optional<double> discharge; // [m3/s]; m2/s in two dimensions
    std::vector<OpenSeries> series;  // ascending in `at`
    FlowProfile profile = FlowProfile::uniform;
    BodiesAtSide bodies = BodiesAtSide::leave;
    bool hold = false; // the last values hold to the end of the run, knowingly
    Place place;

    int axis() const { return into / 2; }
    double sign() const { return into % 2 == 0 ? 1 : -1; }
    double plane() const { return min[axis()]; }
    /// Along the window; 1 in two dimensions [m].
    double width(int dimensions) const;
};

/// The flow prescribed at a place along the window; `still`: level and depth there at the start
/// [m].
struct StillWater {
    double level = 0, depth = 0;
};
AskedFlow asked_at(const OpenSettings& open, double along, double time, const StillWater& still,
                   int dimensions);

/// Largest prescribed sqrt(u^2 + 2 g h) above a ground at `bed` [m/s]. `still`: level of the water
/// before the window at the start, into which a level alone sends a wave; -infinity: dry [m].
double fastest_asked(const OpenSettings& open, double bed, double still, double gravity,
                     int dimensions);
/// Highest prescribed level [m]; none if no level is prescribed.
std::optional<double> highest_asked(const OpenSettings& open);

/// Columns of the carpet behind a window: below the longest body that leaves there it reaches so
/// far that water carries the body until all of it has passed.
int carpet_columns(const Scene& scene, const OpenSettings& open);

/// The plane of a window with its lanes and the ground there.
OpenSide open_side(const Scene& scene, const OpenSettings& open);

/// The water that the strip of each station of a window holds beside the walls that stand there;
/// empty if none stands in any.
std::vector<StripSpace> strip_spaces(const Scene& scene, const OpenSettings& open,
                                     const OpenSide& side);

} // namespace hyoryu
