// SPDX-License-Identifier: MIT
// A snapshot that does not fit its case, or holds what no run makes, is an error and no crash.
#include "hyoryu/core/error.hpp"
#include "runs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace hyoryu::test_checkpoint_faults {
namespace {

constexpr const char* flood = R"(
dimensions = 2
[time]
end = 0.1
[particles]
spacing = 0.05
[fluid]
[[fluid.block]]
shape = "box"
min = [0.0, 0.0, 0.0]
max = [0.5, 0.0, 0.5]
[[wall]]
name = "basin"
shape = "basin"
min = [0.0, 0.0, 0.0]
max = [1.5, 0.0, 1.0]
[[body]]
name = "crate"
shape = "box"
size = [0.2, 0.2, 0.2]
density = 400.0
position = [0.9, 0.0, 0.1]
[[gauge]]
name = "push"
type = "force"
on = "crate"
[[gauge]]
name = "level"
type = "elevation"
at = [0.2, 0.0, 0.0]
filter = "mean"
window = 0.02
)";

Snapshot some_state()
{
    Simulation sim = make(flood);
    advance(sim, 5);
    return save(sim);
}

std::string fault_of(const Snapshot& snapshot)
{
    Simulation sim = make(flood);
    try {
        restore(sim, snapshot);
    } catch (const IoError& error) {
        return error.what();
    }
    return "";
}

// The snapshot with another last number in one array, in the type of that array.
Snapshot with_last(Snapshot snapshot, const std::string& name, double number)
{
    std::visit(
        [&](auto& values) {
            using Number = typename std::decay_t<decltype(values)>::value_type;
            values.at(values.size() - 1) = static_cast<Number>(number);
        },
        snapshot.arrays.at(name).values);
    return snapshot;
}

TEST(CheckpointFaults, AStateFitsItsCase)
{
    EXPECT_EQ(fault_of(some_state()), "");
}

TEST(CheckpointFaults, EveryArrayIsNeededWithItsTypeAndLength)
{
    const Snapshot good = some_state();
    for (const auto& [name, column] : good.arrays) {
        Snapshot bad = good;
        bad.arrays.erase(name);
        if (!name.starts_with("work/")) { // which earlier versions did not keep
            EXPECT_NE(fault_of(bad), "") << name << " is missing";
        }
        bad.arrays[name] = {name, "", 1, std::vector<float>{1.0F}};
        EXPECT_NE(fault_of(bad), "") << name << " is of another type";
        bad.arrays[name] = column;
        std::visit(
            [&](auto& values) {
                if (!values.empty()) {
                    values.pop_back();
                    EXPECT_NE(fault_of(bad), "") << name << " is too short";
                    values.clear();
                    if (name != "joints") { // there may be none
                        EXPECT_NE(fault_of(bad), "") << name << " is empty";
                    }
                }
            },
            bad.arrays[name].values);
    }
}

TEST(CheckpointFaults, NumbersThatNoRunMakesAreNotFollowed)
{
    const Snapshot good = some_state();
    for (const double number : {-1.0, 1e18, std::numeric_limits<double>::quiet_NaN()}) {
        Snapshot bad = good;
        std::get<std::vector<std::int64_t>>(bad.arrays.at("gauges/samples").values)[0] =
            static_cast<std::int64_t>(std::isnan(number) ? 1e6 : number);
        EXPECT_NE(fault_of(bad), "") << number << " samples of a gauge";
    }
    for (const char* name : {"fluid/Position", "fluid/tiles/x"}) {
        EXPECT_NE(fault_of(with_last(good, name, infinity)), "") << name;
    }
    for (const char* name : {"fluid/tiles/row", "fluid/tiles/start"}) {
        EXPECT_NE(fault_of(with_last(good, name, 1e6)), "") << name;
        EXPECT_NE(fault_of(with_last(good, name, -1.0)), "") << name;
    }
}

} // namespace
} // namespace hyoryu::test_checkpoint_faults
