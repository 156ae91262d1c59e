// SPDX-License-Identifier: MIT
// A state on the disk: every bit comes back, any number of times, and no file is seen.
#include "results_fixture.hpp"

#include "hyoryu/core/error.hpp"
#include "hyoryu/core/state.hpp"
#include "hyoryu/io/kept_state.hpp"

#include <bit>
#include <csignal>
#include <limits>
#include <random>
#include <span>
#include <sys/resource.h>

namespace hyoryu::test_kept_state {
namespace {

using KeptStates = test_help::ResultsTest;

// Arrays of every type, of random lengths, with numbers that are easily spoiled.
Snapshot random_snapshot(unsigned seed)
{
    std::mt19937 random(seed);
    std::uniform_int_distribution<std::size_t> length(0, 3000);
    Snapshot snapshot;
    const auto add = [&](const std::string& name, auto value) {
        std::vector<decltype(value)> values(length(random));
        for (std::byte& b : std::as_writable_bytes(std::span(values))) {
            b = static_cast<std::byte>(random());
        }
        snapshot.arrays[name] = {name, "m", 1 + static_cast<int>(random() % 3), values};
    };
    for (int k = 0; k < 3; ++k) {
        const std::string number = std::to_string(k);
        add("a/double" + number, double{});
        add("float" + number, float{});
        add("z/int" + number, std::int32_t{});
        add("long" + number, std::int64_t{});
        add("byte" + number, std::uint8_t{});
    }
    snapshot.arrays["special"] = {
        "special", "", 1,
        std::vector<double>{-0.0, 5e-324, std::numeric_limits<double>::infinity(),
                            std::bit_cast<double>(std::uint64_t{0xfff8'dead'beef'0001U})}};
    snapshot.texts["case"] = std::string("a\0b", 3);
    return snapshot;
}

std::string bytes_of(const Column& column)
{
    return column.name + '|' + column.unit + '|' + std::to_string(column.components) + '|' +
           std::to_string(column.values.index()) + '|' +
           std::visit(
               [](const auto& values) {
                   return std::string(reinterpret_cast<const char*>(values.data()),
                                      values.size() * sizeof(values[0]));
               },
               column.values);
}

TEST_F(KeptStates, GiveBackEveryBitAnyNumberOfTimes)
{
    for (unsigned seed = 1; seed <= 5; ++seed) {
        const Snapshot given = random_snapshot(seed);
        KeptState first(folder, on_demand(random_snapshot(100 + seed)));
        first.replace(on_demand(given));
        const KeptState kept = std::move(first);
        const StateOnDemand state = kept.on_demand();
        EXPECT_EQ(state.texts, given.texts);
        ASSERT_EQ(state.bytes.size(), given.arrays.size());
        for (int time = 0; time < 2; ++time) {
            for (const auto& [name, column] : given.arrays) {
                EXPECT_EQ(bytes_of(state.array(name)), bytes_of(column)) << name;
            }
        }
        const Snapshot whole = kept.snapshot();
        EXPECT_EQ(whole.texts, given.texts);
        for (const auto& [name, column] : whole.arrays) {
            EXPECT_EQ(bytes_of(column), bytes_of(given.arrays.at(name))) << name;
        }
    }
}

TEST_F(KeptStates, LeaveNoFile)
{
    const KeptState kept(folder, on_demand(random_snapshot(7)));
    EXPECT_TRUE(std::filesystem::is_empty(folder));
}

TEST_F(KeptStates, ThatCannotBeWrittenSayWhy)
{
    EXPECT_THROW(KeptState(folder / "none", on_demand(random_snapshot(1))), IoError);

    rlimit limit{};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &limit), 0);
    const rlimit small{.rlim_cur = 1000, .rlim_max = limit.rlim_max};
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
    EXPECT_THROW(KeptState(folder, on_demand(random_snapshot(1))), IoError);
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &limit), 0);
    std::signal(SIGXFSZ, handler);
}

} // namespace
} // namespace hyoryu::test_kept_state
