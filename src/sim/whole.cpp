// SPDX-License-Identifier: MIT
#include "hyoryu/sim/whole.hpp"

#include "hyoryu/fluid/whole.hpp"

namespace hyoryu {

namespace {

// Gives the simulation the particles of all ranks for as long as it lives.
class Assembly {
public:
    explicit Assembly(Fluid& fluid) : fluid_(fluid), whole_(gather_whole(fluid))
    {
        swap_parts(fluid_, whole_, ghosts_);
    }
    ~Assembly() { swap_parts(fluid_, whole_, ghosts_); }
    Assembly(const Assembly&) = delete;
    Assembly& operator=(const Assembly&) = delete;

private:
    Fluid& fluid_;
    WholeFluid whole_;
    std::unique_ptr<Ghosts> ghosts_;
};

} // namespace

void with_whole(Simulation& sim, Comm* comm, const std::function<void()>& look)
{
    if (comm == nullptr || !sim.fluid) {
        if (comm == nullptr || comm->rank() == 0) {
            look();
        }
        return;
    }
    const Assembly whole(*sim.fluid);
    if (comm->rank() == 0) {
        look();
    }
}

} // namespace hyoryu
