// SPDX-License-Identifier: MIT
#include "hyoryu/fluid/gradient.hpp"

#include "moments.hpp"

namespace hyoryu {

namespace {

const CorrectionRange& range_of(const FluidParameters& fluid)
{
    return fluid.formulation == FormulationKind::mps ? mps_correction : sph_correction;
}

} // namespace

Mat3 correction(const Mat3& M, const CorrectionRange& range)
{
    const real share = range.part * share_between(M, range.surface, range.inside);
    return share > 0 ? Mat3(share * (M.inverse() - Mat3::Identity())) : Mat3(Mat3::Zero());
}

void update_corrections(const FluidParameters& fluid, Store& store)
{
    const CorrectionRange& range = range_of(fluid);
    const auto moments = store[field::moments];
    const auto mixed = store[field::mixed_moments];
    const auto diagonal = store[field::gradient_correction];
    const auto off = store[field::mixed_correction];
    parallel_for(0, store.size(), [&](Index i) {
        const Mat3 C = correction(moment_matrix(moments[i], mixed[i], fluid.dimensions), range);
        diagonal[i] = C.diagonal();
        off[i] = Vec3(C(1, 2), C(0, 2), C(0, 1));
    });
}

void add_corrections(const FluidParameters& fluid, Store& store)
{
    const real relaxation = fluid.gravity.norm() / (range_of(fluid).memory * fluid.eos.c0);
    const auto rho = store[field::density];
    const auto made = store[field::correction];
    const auto made_rate = store[field::correction_rate];
    const auto rate = store[field::density_rate];
    parallel_for(0, store.size(), [&](Index i) {
        made_rate[i] = rho[i] * made_rate[i] - relaxation * made[i];
        rate[i] += made_rate[i];
    });
}

} // namespace hyoryu
