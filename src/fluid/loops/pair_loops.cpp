// SPDX-License-Identifier: MIT
// Compiled once for each instruction set.
#include "../loop_table.hpp"

namespace hyoryu {

namespace {

constexpr int bytes = HYORYU_REGISTER_BYTES;

template <class Real, class PairKernel>
struct Loops {
    using Table = PairLoops<Real, PairKernel>;

    template <class Pass>
    static void sweep(const typename Table::View& view, Index block, std::byte* local,
                      const FluidTerms& terms)
    {
        Pass::call(terms, [&]<class... Terms>(const Terms&... term) {
            using Row = RecordRow<RecordList<Stored, Terms...>, Real>;
            sweep_block<bytes>(view, block, reinterpret_cast<Row*>(local), term...);
        });
    }

    template <class Pass>
    static constexpr typename Table::Loop loop_of()
    {
        if constexpr (std::is_same_v<PairKernel, MpsKernel> &&
                      pass_index<Pass, SolidPasses> < SolidPasses::count) {
            return nullptr;
        } else {
            return sweep<Pass>;
        }
    }
    template <class... Pass>
    static constexpr Table table_of(PassList<Pass...>)
    {
        return {Pack<Real, bytes>::lanes, {loop_of<Pass>()...}};
    }
    static constexpr Table table = table_of(AllPasses{});
};

} // namespace

template <>
const FluidLoops* fluid_loops<bytes>()
{
    static constexpr FluidLoops loops{Loops<float, Kernel>::table, Loops<double, Kernel>::table,
                                      Loops<float, MpsKernel>::table,
                                      Loops<double, MpsKernel>::table};
    return &loops;
}

} // namespace hyoryu
