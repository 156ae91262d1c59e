// SPDX-License-Identifier: MIT
// The simulation: the simulation state and its time step. The state holds the scene, the plan, the
// fluid, the bodies, their coupling, gauges and accumulated sums. `step` advances it by one time
// step, in the stages of a position-Verlet scheme; input and output are in other layers.
#pragma once

#include "hyoryu/core/timer.hpp"
#include "hyoryu/coupling/coupling.hpp"
#include "hyoryu/coupling/seepage.hpp"
#include "hyoryu/scene/plan.hpp"
#include "hyoryu/sim/bed_friction.hpp"
#include "hyoryu/sim/clock.hpp"
#include "hyoryu/sim/conservation.hpp"
#include "hyoryu/sim/covered_walls.hpp"
#include "hyoryu/sim/gauges.hpp"
#include "hyoryu/sim/loads.hpp"
#include "hyoryu/sim/open_flow.hpp"
#include "hyoryu/sim/survey.hpp"
#include "hyoryu/sim/wall_barrier.hpp"
#include "hyoryu/sim/waves.hpp"

#include <map>
#include <optional>

namespace hyoryu {

struct Simulation {
    Scene scene;
    Plan plan;
    std::optional<Fluid> fluid;         // none without `[fluid]`: no particles, grids or lists
    std::optional<WallBarrier> barrier; // none without fluid or without solids
    Rigid rigid;
    BodyParticles body_particles;
    std::vector<Vec3> wall_start; // of the particles of walls that move at time 0 [m]
    CoveredWalls covered;         // parts of them within fixed walls
    std::vector<Pose> poses;      // of the bodies when the loads were taken
    Loads loads;
    Seepage seepage; // of the joints of standing bodies
    Waves waves;
    BedFriction bed; // of one step
    Clock clock;
    std::optional<StateSurvey> last; // of the end of the last step; reset it after any other change
    double request = 0; // of the caller: the next survey has the largest of all processes
    Conservation conservation;
    GaugeMemory gauges;
    std::vector<Contact> contacts; // of the last step
    StageTimer timer;
    std::map<std::string, long long, std::less<>> steps_by_limit; // of all steps
    double pair_visits = 0;     // list entries that this process evaluated since the last restart
    double earlier_visits = 0;  // that all processes evaluated before it
    double thinnest = infinity; // least inner radius of the bodies [m]
    OpenFlow open;              // at the open sides
    Comm* comm = nullptr;       // of the processes that share the case; null for one
};

/// The scene at time 0 with the particles of `filling`. `comm`, null for one process, outlives the
/// simulation; of a case that several processes share, `filling` is that of rank 0, which deals out
/// its fluid, and is ignored on the others. `filling` is freed before the lists are built; pass it
/// with std::move unless the caller needs it afterwards, since it is as large as the state.
Simulation make_simulation(const Scene& scene, const Plan& plan, Filling filling,
                           Comm* comm = nullptr);

/// The same without lists, pressures and rates, for a state to be restored; not to be advanced
/// before that.
Simulation make_to_restore(const Scene& scene, const Plan& plan, Filling filling,
                           Comm* comm = nullptr);

/// Advances by one step, limited as the clock says. Throws NumericalError when the state after it
/// is not finite or out of bounds.
void step(Simulation& sim);

} // namespace hyoryu
