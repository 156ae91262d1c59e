// SPDX-License-Identifier: MIT
// The table of keys, the manual and the JSON Schema made of it.
#include "hyoryu/scene/parameter.hpp"

#include "hyoryu/core/error.hpp"
#include "test_case_file_support.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <set>

namespace hyoryu::test_parameter {

namespace {

/// The schema of a key of the table, by its path.
const nlohmann::json* schema_of(const nlohmann::json& root, std::string key)
{
    const nlohmann::json* at = &root;
    while (true) {
        const auto dot = key.find('.');
        std::string name = key.substr(0, dot);
        const bool list = name.ends_with("[]");
        name = list ? name.substr(0, name.size() - 2) : name;
        if (!at->contains("properties") || !(*at)["properties"].contains(name)) {
            return nullptr;
        }
        at = &(*at)["properties"][name];
        at = list ? &(*at)["items"] : at;
        if (dot == std::string::npos) {
            return at;
        }
        key = key.substr(dot + 1);
    }
}

} // namespace

TEST(Parameters, AreUniqueAndExplained)
{
    std::set<std::string_view> keys;
    for (const Parameter& p : parameters()) {
        EXPECT_TRUE(keys.insert(p.key).second) << p.key;
        EXPECT_TRUE(p.meaning.ends_with('.')) << p.key;
        EXPECT_EQ(find_parameter(p.key), &p);
        if (p.kind == ValueKind::choice) {
            EXPECT_FALSE(p.choices.empty()) << p.key;
        }
    }
    EXPECT_EQ(find_parameter("no.such.key"), nullptr);
    EXPECT_EQ(find_parameter("fluid.density")->unit, "kg/m3");
}

TEST(Parameters, SchemaIsJsonAndHoldsEveryKey)
{
    const nlohmann::json schema = nlohmann::json::parse(json_schema());
    for (const Parameter& p : parameters()) {
        const nlohmann::json* found = schema_of(schema, std::string(p.key));
        ASSERT_NE(found, nullptr) << p.key;
        EXPECT_EQ((*found)["description"], p.meaning);
    }
    EXPECT_EQ(schema["properties"]["dimensions"]["maximum"], 3);
    EXPECT_EQ(schema["properties"]["time"]["required"][0], "end");
    EXPECT_EQ(schema["properties"]["body"]["items"]["additionalProperties"], false);
}

TEST(Parameters, DescribeTellsAKeyATableOrEverything)
{
    const std::string key = describe("fluid.density");
    EXPECT_NE(key.find("number in kg/m3, > 0, default 1000"), std::string::npos) << key;
    EXPECT_EQ(key.find("sound_speed"), std::string::npos);
    EXPECT_EQ(describe("body[].size"), describe("body[3].size"));
    EXPECT_EQ(describe("body[].size"), describe("body.size"));
    const std::string table = describe("body");
    EXPECT_NE(table.find("body[].copies.pitch"), std::string::npos);
    EXPECT_EQ(table.find("gauge[]"), std::string::npos);
    const std::string everything = describe("");
    for (const Parameter& p : parameters()) {
        EXPECT_NE(everything.find(p.key), std::string::npos);
    }
}

TEST(Parameters, DescribeOfAnUnknownKeyNamesTheNearest)
{
    try {
        describe("fluid.densty");
        FAIL();
    } catch (const CaseError& error) {
        EXPECT_EQ(error.diagnostics()[0].hint, "did you mean \"fluid.density\"?");
    }
}

TEST(Parameters, DefaultsOfTheSceneAreThoseOfTheTable)
{
    const Scene scene = parse_case(short_case, "case.toml");
    const auto number = [](const char* key) {
        return std::stod(std::string(find_parameter(key)->fallback));
    };
    EXPECT_EQ(number("time.cfl"), TimeSettings{}.cfl);
    EXPECT_EQ(number("fluid.density"), FluidSettings{}.density);
    EXPECT_EQ(number("fluid.viscosity.alpha"), ArtificialViscosity{}.alpha);
    EXPECT_EQ(number("fluid.viscosity.kinematic"), LaminarViscosity{}.kinematic);
    EXPECT_EQ(number("fluid.density_diffusion.delta"), FourtakasDiffusion{}.delta);
    EXPECT_EQ(number("fluid.smoothing_ratio"), FluidSettings{}.smoothing_ratio);
    EXPECT_EQ(number("contact.restitution"), ContactSettings{}.restitution);
    EXPECT_EQ(number("contact.friction"), ContactSettings{}.friction);
    EXPECT_EQ(number("contact.penalty.stiffness"), PenaltyParameters{}.stiffness);
    EXPECT_EQ(number("contact.penalty.damping"), PenaltyParameters{}.damping);
    EXPECT_EQ(number("contact.penalty.step"), PenaltyParameters{}.step);
    EXPECT_EQ(number("output.checkpoint_every"), OutputSettings{}.checkpoint_every);
    EXPECT_EQ(scene.gravity, Scene{}.gravity);
    EXPECT_EQ(scene.seed, Scene{}.seed);
}

} // namespace hyoryu::test_parameter
