// SPDX-License-Identifier: MIT
// Steady seepage between the cells of a joint, and its direct solution along a line of them.
#pragma once

#include <span>

namespace hyoryu {

/// A flow path between a cell and its surroundings or the next cell.
struct JointWay {
    double conductance = 0; // of a uniform gap, relative
    double pressure = 0;    // outside, moved to the centre of the cell [Pa]
    double enters = 0;      // share of the conductance for inflow; outflow uses all of it
    int next = -1;          // cell of the joint across the edge, counted from the first of the face
    double rise = 0;        // hydrostatic rise from there to the centre of the cell [Pa]
};

/// Flow paths by cell and edge; a cell has four, of which `edges` are used.
struct JointWays {
    std::span<const JointWay> of;
    int edges = 4;

    const JointWay& operator()(int cell, int edge) const { return of[4 * cell + edge]; }
};

/// The conductance of a flow path at the pressures of its cell and of all cells [Pa]. No water
/// flows out of a cell that holds air; a dry or half-wet rim conducts outflow better than inflow.
double open_conductance(const JointWay& way, double own, std::span<const double> pressure);

/// The pressure at which the flows into and out of a cell balance [Pa].
double balanced(const JointWays& ways, std::span<const double> pressure, int cell);

/// Solves for the pressures along a line of cells, each with its neighbours across edges 0 and 1,
/// if all cells are wet: for given directions of flow at the rims the equations are linear and have
/// one solution, which elimination finds in a few rounds. Returns false and keeps `pressure` if a
/// cell holds air, since the set of such cells depends on how they fell dry. `pressure`: a start,
/// then the result.
bool solve_line(const JointWays& ways, std::span<double> pressure);

} // namespace hyoryu
