// SPDX-License-Identifier: MIT
// Compiled once for each instruction set.
#include "../loop_table.hpp"

namespace hyoryu {

namespace {

constexpr int bytes = HYORYU_REGISTER_BYTES;

template <class Real, class Formulation>
struct Loops {
    using Table = PairLoops<Real, Formulation>;

    template <class Pass>
    static void sweep(const typename Table::View& view, Index block, std::byte* local,
                      const FluidTerms& terms)
    {
        Pass::call(Formulation{}, terms, [&]<class... Terms>(const Terms&... term) {
            using Row = RecordRow<RecordList<Stored, Terms...>, Real>;
            sweep_block<bytes>(view, block, reinterpret_cast<Row*>(local), term...);
        });
    }

    template <class... Pass>
    static constexpr Table table_of(PassList<Pass...>)
    {
        return {Pack<Real, bytes>::lanes, {sweep<Pass>...}};
    }
    static constexpr Table table = table_of(AllPasses{});
};

} // namespace

template <>
const FluidLoops* fluid_loops<bytes>()
{
    static constexpr FluidLoops loops{Loops<float, Sph>::table, Loops<double, Sph>::table,
                                      Loops<float, Mps>::table, Loops<double, Mps>::table};
    return &loops;
}

} // namespace hyoryu
