// SPDX-License-Identifier: MIT
// An effect that is one file and one line of the list of slots is in all that the program does:
// columns, plan, cost, reader, writer, schema, `describe` and restart. The scalar reference of its
// pair term and what holds for every model are in test_stages.cpp and test_effect_keys.cpp, which
// this program takes in.
#include "dice.hpp"
#include "pair_drag.hpp"
#include "runs.hpp"
#include "test_case_file_support.hpp"

#include "hyoryu/scene/parameter.hpp"
#include "hyoryu/sim/cost.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace hyoryu::test_added_effect {
namespace {

// A column of water that falls apart, at a spacing.
std::string tank(double spacing, const std::string& drag)
{
    return fmt::format("dimensions = 2\n[time]\nend = 1.0\n[particles]\nspacing = {}\n[fluid]\n{}"
                       "[[fluid.block]]\nshape = \"box\"\nmin = [0.0, 0.0, 0.0]\n"
                       "max = [0.2, 0.0, 0.3]\n[[wall]]\nname = \"basin\"\nshape = \"basin\"\n"
                       "min = [0.0, 0.0, 0.0]\nmax = [0.5, 0.0, 0.5]\nopen = [\"+z\"]\n",
                       spacing, drag);
}
std::string with_drag(double rate, double threshold)
{
    return fmt::format("drag = {{ model = \"pair\", rate = {}, threshold = {} }}\n", rate,
                       threshold);
}
constexpr double spacings[] = {0.05, 0.031};

Dice dice_of_test()
{
    return Dice(static_cast<std::uint64_t>(number_from("HYORYU_SEED", 11)));
}

real largest_power(const Store& fluid)
{
    real largest = 0;
    for (const real power : fluid[field::drag_power]) {
        largest = std::max(largest, std::abs(power));
    }
    return largest;
}

Plan plan_of(const std::string& text)
{
    const Scene scene = parse_case(text, "case.toml");
    return make_plan(scene, fill(scene));
}

// The columns of the effect, of those that a plan has.
std::vector<Plan::FieldUse> columns_of_drag(const Plan& plan)
{
    std::vector<Plan::FieldUse> found;
    std::ranges::copy_if(plan.fields, std::back_inserter(found), [](const Plan::FieldUse& use) {
        return use.name == DragPower::info.name;
    });
    return found;
}

TEST(Reader, ReadsTheKeysAndTheWriterWritesThem)
{
    Dice dice = dice_of_test();
    for (int k = 0; k < 20; ++k) {
        const double rate = dice.between(0, 50);
        const double threshold = dice.between(1e-3, 2);
        const Scene scene = parse_case(tank(0.05, with_drag(rate, threshold)), "case.toml");
        const auto& drag = std::get<ChosenDrag>(scene.fluid->effects[DragSlot{}]);
        EXPECT_EQ(drag.rate, rate);
        EXPECT_EQ(drag.threshold, threshold);
        const std::string text = to_toml(scene);
        EXPECT_NE(text.find(fmt::format("[fluid.drag]\nmodel = \"pair\"\nrate = {}\nthreshold = {}",
                                        rate, threshold)),
                  std::string::npos)
            << text;
        EXPECT_EQ(to_toml(parse_case(text, "case.toml")), text);
    }
    const Scene plain = parse_case(tank(0.05, ""), "case.toml");
    EXPECT_TRUE(std::holds_alternative<Off>(plain.fluid->effects[DragSlot{}]));
    EXPECT_EQ(std::get<ChosenDrag>(parse_case(tank(0.05, "drag.model = \"pair\"\n"), "case.toml")
                                       .fluid->effects[DragSlot{}])
                  .rate,
              3);
}

TEST(Reader, TellsTheLineOfEveryMistake)
{
    constexpr int line_of_drag = 7;
    struct Case {
        std::string drag, key, what;
    };
    for (const Case& c : {
             Case{"drag = { model = \"pair\", rate = -1 }\n", "fluid.drag.rate", "0"},
             Case{"drag = { model = \"pair\", threshold = 0 }\n", "fluid.drag.threshold", "0"},
             Case{"drag = { model = \"pair\", rate = \"soon\" }\n", "fluid.drag.rate", "soon"},
             Case{"drag = { model = \"pear\" }\n", "fluid.drag.model", "pear"},
             Case{"drag = { model = \"pair\", treshold = 1 }\n", "fluid.drag.treshold", "unknown"},
             Case{"drag = { rate = 1 }\n", "fluid.drag.rate", "has no meaning with model"},
         }) {
        const auto all = mistakes(tank(0.05, c.drag));
        const Diagnostic found = mistake_at(all, c.key);
        EXPECT_EQ(found.line, line_of_drag) << c.drag << (all.empty() ? "" : to_string(all[0]));
        EXPECT_NE(to_string(found).find(c.what), std::string::npos) << to_string(found);
    }
}

TEST(Manual, DescribesTheKeys)
{
    for (const std::string_view key : {"fluid.drag", "fluid.drag.model", "fluid.drag.rate"}) {
        EXPECT_NE(find_parameter(key), nullptr) << key;
    }
    const std::string text = describe("fluid.drag");
    for (const std::string_view part : {"rate", "1/s", "Rate at which relative motion decays.",
                                        "threshold", "m/s", "brakes particles"}) {
        EXPECT_NE(text.find(part), std::string::npos) << part << " in\n" << text;
    }
}

TEST(Manual, SchemaChecksTheKeys)
{
    const auto schema = nlohmann::json::parse(json_schema());
    const auto& drag = schema.at("properties").at("fluid").at("properties").at("drag");
    // A number of a unit, or a text with another.
    const auto number = [&](const char* key) {
        return drag.at("properties").at(key).at("anyOf").at(0);
    };
    EXPECT_EQ(number("rate").at("minimum"), 0);
    EXPECT_FALSE(number("rate").contains("exclusiveMinimum"));
    EXPECT_EQ(number("threshold").at("exclusiveMinimum"), true);
    const auto& models = drag.at("properties").at("model").at("enum");
    EXPECT_NE(std::ranges::find(models, "pair"), models.end());
}

TEST(ThePlan, NamesTheEffectAndItsColumn)
{
    for (const double spacing : spacings) {
        const Plan with = plan_of(tank(spacing, with_drag(3, 0.1)));
        const Plan without = plan_of(tank(spacing, ""));
        const auto said = std::ranges::find(with.on, PairDrag::name, &Plan::Effect::name);
        ASSERT_NE(said, with.on.end());
        EXPECT_EQ(said->why, "`fluid.drag.model` is \"pair\", rate = 3 1/s");
        const auto missing = std::ranges::find(without.off, PairDrag::name, &Plan::Effect::name);
        ASSERT_NE(missing, without.off.end());
        EXPECT_EQ(missing->why, "`fluid.drag.model` is \"none\"");
        EXPECT_TRUE(columns_of_drag(without).empty());
        const auto columns = columns_of_drag(with);
        ASSERT_EQ(columns.size(), 1U);
        EXPECT_EQ(columns[0].bytes_per_particle, sizeof(real));
        EXPECT_EQ(columns[0].rows, with.counts.fluid);
        EXPECT_GE(with.memory, without.memory + static_cast<double>(columns[0].bytes()));
    }
}

TEST(Allocation, MakesTheColumnIfTheEffectRuns)
{
    for (const double spacing : spacings) {
        EXPECT_FALSE(make(tank(spacing, "")).fluid->particles.fluid.has(field::drag_power));
        EXPECT_FALSE(
            make(tank(spacing, with_drag(0, 1))).fluid->particles.fluid.has(field::drag_power));
        const Simulation sim = make(tank(spacing, with_drag(3, 0.1)));
        EXPECT_TRUE(sim.fluid->particles.fluid.has(field::drag_power));
        EXPECT_FALSE(sim.fluid->particles.wall.has(field::drag_power));
    }
}

TEST(Cost, MeasuresTheEffect)
{
    const auto measured = [](const std::string& drag) {
        Simulation sim = make(tank(0.05, drag));
        std::vector<std::string> names;
        for (const StepCost::Share& share : measure_cost(sim, 4).effects) {
            names.push_back(share.effect);
        }
        return std::ranges::count(names, PairDrag::name);
    };
    EXPECT_EQ(measured(with_drag(3, 0.1)), 1);
    EXPECT_EQ(measured(""), 0);
}

TEST(Steps, TheDragTakesEnergyAndKeepsMomentum)
{
    for (const double spacing : spacings) {
        const auto fallen = [&](const std::string& drag) {
            Simulation sim = make(tank(spacing, drag));
            while (sim.clock.time < 0.1) {
                step_on(sim);
            }
            return sim;
        };
        const Simulation free = fallen("");
        const Simulation sim = fallen(with_drag(200, 0.01));
        EXPECT_LT(totals(sim).fluid_kinetic, 0.9 * totals(free).fluid_kinetic);
        EXPECT_GT(largest_power(sim.fluid->particles.fluid), 0);
        for (const real power : sim.fluid->particles.fluid[field::drag_power]) {
            EXPECT_LE(power, 0);
        }
        EXPECT_LT(sim.conservation.worst_closure, 1e-6);
    }
}

TEST(Restart, GoesOnWithTheSameBits)
{
    Dice dice = dice_of_test();
    for (const double spacing : spacings) {
        for (int k = 0; k < 3; ++k) {
            const std::array drag{dice.between(1, 100), dice.between(0.01, 1)};
            const std::string text = tank(spacing, with_drag(drag[0], drag[1]));
            const int before = 1 + dice.below(60);
            const int after = 1 + dice.below(40);
            SCOPED_TRACE(fmt::format("{} steps, then {}, of\n{}", before, after, text));
            Simulation whole = make(text);
            advance(whole, before);
            const Snapshot middle = save(whole);
            Simulation resumed = make(text);
            restore(resumed, middle);
            EXPECT_EQ(largest_power(resumed.fluid->particles.fluid),
                      largest_power(whole.fluid->particles.fluid));
            advance(whole, after);
            advance(resumed, after);
            EXPECT_GT(largest_power(whole.fluid->particles.fluid), 0);
            expect_same_bits(save(whole), save(resumed));
        }
    }
}

TEST(Steps, GiveTheSameBitsForAnyNumberOfThreads)
{
    const std::string text = tank(0.02, with_drag(50, 0.05));
    set_threads(1);
    Simulation one = make(text);
    advance(one, 60);
    set_threads(2);
    Simulation two = make(text);
    advance(two, 60);
    set_threads(0);
    expect_same_bits(save(one), save(two));
}

} // namespace
} // namespace hyoryu::test_added_effect
