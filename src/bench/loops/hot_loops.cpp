// SPDX-License-Identifier: MIT
// Compiled once for each instruction set.
#include "../hot_loops.hpp"

namespace hyoryu::bench {

namespace {

constexpr int bytes = HYORYU_REGISTER_BYTES;

template <class Real>
struct Loops {
    // Enough chains to hide the latency of two units of four or five cycles, and few enough for
    // sixteen registers with the two constants.
    static constexpr int chain_count = 12;

    static double chains(Index rounds, double a, double b)
    {
        using N = Pack<Real, bytes>;
        using Register = typename N::Register;
        const Register factor = N(a).value;
        const Register addend = N(b).value;
        Register x[chain_count];
        for (int k = 0; k < chain_count; ++k) {
            x[k] = N(k * 1e-3).value;
        }
        for (Index round = 0; round < rounds; ++round) {
#pragma GCC unroll 12
            for (int k = 0; k < chain_count; ++k) {
                x[k] = x[k] * factor + addend;
            }
        }
        double all = 0;
        for (int k = 0; k < chain_count; ++k) {
            all += lane_sum(N(x[k]));
        }
        return all;
    }

    static void all_terms(const typename PairLoops<Real>::View& view, Index block, std::byte* local,
                          const FluidTerms& terms)
    {
        sweep_block<bytes>(view, block, reinterpret_cast<RecordRow<Stored, Real>*>(local),
                           PressureForce{},
                           *std::get_if<DensityDiffusion>(&terms.effects[slot::diffusion]),
                           Continuity{}, *std::get_if<Viscosity>(&terms.effects[slot::viscosity]));
    }

    static constexpr HotLoops<Real> table{chains, 2.0 * chain_count* Pack<Real, bytes>::lanes,
                                          all_terms};
};

} // namespace

template <>
const HotLoopTable* hot_loops<bytes>()
{
    static constexpr HotLoopTable loops{Loops<float>::table, Loops<double>::table};
    return &loops;
}

} // namespace hyoryu::bench
