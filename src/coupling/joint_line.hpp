// SPDX-License-Identifier: MIT
// Steady seepage between the cells of a joint, and its direct solution along a line of them.
#pragma once

#include <span>

namespace hyoryu {

/// A way for water between a cell and its surroundings, or the next cell.
struct JointWay {
    double conductance = 0; // of a uniform gap, relative
    double pressure = 0;    // outside, moved to the centre of the cell [Pa]
    double enters = 0;      // share of the conductance by which water comes in; all lets it out
    int next = -1;          // cell of the joint across the edge, counted from the first of the face
    double rise = 0;        // by which a pressure there grows on the way to the centre [Pa]
};

/// Ways by cell and edge; a cell has four, of which `edges` count.
struct JointWays {
    std::span<const JointWay> of;
    int edges = 4;

    const JointWay& operator()(int cell, int edge) const
    {
        return of[static_cast<std::size_t>(4 * cell + edge)];
    }
};

/// The conductance of a way at a pressure of its cell and the pressures of all cells [Pa]: a cell
/// that holds air gives no water, a rim that is dry or half wet takes more than it gives.
double open_conductance(const JointWay& way, double own, std::span<const double> pressure);

/// The pressure that a cell would have between its neighbours and ways [Pa].
double balanced(const JointWays& ways, std::span<const double> pressure, int cell);

/// Solves for the pressures along a line of cells, each with its neighbours across edges 0 and 1,
/// if all of it is wet: then p = balanced is linear for given directions of flow at the rims, and
/// has one solution, which elimination finds in a few rounds. False, and `pressure` as it was,
/// where a cell holds air: which cells do depends on how they fell dry. `pressure`: a start, then
/// the result.
bool solve_line(const JointWays& ways, std::span<double> pressure);

} // namespace hyoryu
