// SPDX-License-Identifier: MIT
// What the Flexible Collision Library says: which bodies may meet, and how deep two parts overlap.
#pragma once

#include "convex.hpp"

#include <functional>
#include <memory>

namespace witness {

/// Depth of overlap by FCL's collide with the solver of libccd [m]; 0 if it sees none. In two
/// dimensions parts are prisms a thousand times as deep as they are wide.
double depth_by_fcl(const Placed& a, const Placed& b, int dimensions);

/// The pairs of bodies whose bounding boxes meet, by FCL's dynamic tree.
class BroadPhase {
public:
    /// Bodies as balls of these radii about their centres [m].
    explicit BroadPhase(const std::vector<double>& radii);
    ~BroadPhase();
    BroadPhase(const BroadPhase&) = delete;
    BroadPhase& operator=(const BroadPhase&) = delete;

    /// Calls visit(i, j), i < j, for each pair at these centres.
    void pairs(const std::vector<Vec3>& centres,
               const std::function<void(std::size_t, std::size_t)>& visit);

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace witness
