// SPDX-License-Identifier: MIT
// The models of the fluid's slots: whatever a model declares in its one file is read, written,
// listed in the table of keys, named in the plan and made into its term.
#include "dice.hpp"
#include "hyoryu/scene/plan.hpp"
#include "test_case_file_support.hpp"

#include "hyoryu/scene/parameter.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace hyoryu::test_effect_keys {

namespace {

/// Calls `look(table, model, slot)` for each model of each slot but "none".
template <class Look>
void each_model(Look&& look)
{
    for_each(ModelSlots<AllSlots>{}, [&](auto slot) {
        const auto each = [&]<class... Models>(const std::variant<Models...>& /*choice*/) {
            const auto one = [&]<class Model>() {
                if constexpr (!std::same_as<Model, Off>) {
                    look(slot.table, Model{}, slot);
                }
            };
            (one.template operator()<Models>(), ...);
        };
        each(FluidChoices{}[slot]);
    });
}

std::string model_key(const SlotTable& table)
{
    return fmt::format("fluid.{}.model", table.key);
}

/// The numbers that stand in the table of a slot.
std::vector<const Parameter*> numbers_of(const SlotTable& table)
{
    std::vector<const Parameter*> numbers;
    for (const Parameter& p : parameters()) {
        if (p.kind == ValueKind::number && p.key.starts_with(fmt::format("fluid.{}.", table.key))) {
            numbers.push_back(&p);
        }
    }
    return numbers;
}

} // namespace

TEST(EffectKeys, EveryModelIsListedReadAndWritten)
{
    each_model([](const SlotTable& table, const auto& model, auto /*slot*/) {
        const std::string key = model_key(table);
        const Parameter* row = find_parameter(key);
        ASSERT_NE(row, nullptr) << key;
        EXPECT_NE(std::ranges::find(row->choices, model.model), row->choices.end()) << key;
        EXPECT_NE(row->meaning.find(model.says), std::string_view::npos) << key;
        const std::string line = fmt::format("model = \"{}\"", model.model);
        const Scene scene =
            parse_case(short_case, "case.toml", {fmt::format("{}={}", key, model.model)});
        const std::string text = to_toml(scene);
        const auto at = text.find(fmt::format("[fluid.{}]\n{}\n", table.key, line));
        EXPECT_NE(at, std::string::npos) << text;
        EXPECT_EQ(to_toml(parse_case(text, "case.toml")), text);
    });
}

TEST(EffectKeys, NumbersBelongToTheModelsThatDeclareThem)
{
    Dice dice(7);
    each_model([&](const SlotTable& table, const auto& model, auto /*slot*/) {
        for (const Parameter* p : numbers_of(table)) {
            const double low = std::max(p->minimum, -1e3);
            const double value = dice.between(low, std::min(p->maximum, 1e3));
            const std::string name = p->key.substr(p->key.rfind('.') + 1);
            const std::string chosen = fmt::format("{}={}", model_key(table), model.model);
            const std::string set = fmt::format("{}={:.17g}", p->key, value);
            const auto all = mistakes(short_case, {chosen, set});
            // A model that declares a key writes it, by its default too.
            const std::string text = to_toml(parse_case(short_case, "case.toml", {chosen}));
            const auto from = text.find(fmt::format("[fluid.{}]", table.key));
            const std::string written = text.substr(from, text.find("\n\n", from) - from);
            if (written.find("\n" + name + " = ") != std::string::npos) {
                ASSERT_TRUE(all.empty()) << to_string(all[0]);
                const std::string with =
                    to_toml(parse_case(short_case, "case.toml", {chosen, set}));
                EXPECT_NE(with.find(fmt::format("{} = {}", name, value)), std::string::npos)
                    << set << "\n"
                    << with;
            } else {
                EXPECT_NE(mistake_at(all, p->key).what.find("has no meaning with model"),
                          std::string::npos)
                    << chosen << " " << set;
            }
        }
    });
}

TEST(EffectKeys, ThePlanNamesTheModelAndMakesItsTerm)
{
    const Scene plain = parse_case(short_case, "case.toml", {"particles.spacing=0.25"});
    const Filling filling = fill(plain);
    each_model([&](const SlotTable& table, const auto& model, auto slot) {
        const auto with = [&](const std::string& name) {
            return make_plan(parse_case(short_case, "case.toml",
                                        {"particles.spacing=0.25",
                                         fmt::format("{}={}", model_key(table), name)}),
                             filling);
        };
        const Plan on = with(std::string(model.model));
        EXPECT_TRUE(on.runs(model.name)) << model.name;
        EXPECT_FALSE(std::holds_alternative<Off>(on.effects[slot])) << model.name;
        const auto said = std::ranges::find(on.on, model.name, &Plan::Effect::name);
        EXPECT_EQ(said->why, model.why());
        each_model([&](const SlotTable& of, const auto& other, auto /*slot*/) {
            if (of.key == table.key && other.name != model.name) {
                EXPECT_FALSE(on.runs(other.name)) << other.name << " beside " << model.name;
            }
        });
        const Plan off = with("none");
        EXPECT_FALSE(off.runs(model.name)) << model.name;
        EXPECT_TRUE(std::holds_alternative<Off>(off.effects[slot])) << model.name;
        const auto missing = std::ranges::find(off.off, model.name, &Plan::Effect::name);
        ASSERT_NE(missing, off.off.end());
        EXPECT_EQ(missing->why, table.off);
    });
}

} // namespace hyoryu::test_effect_keys
