// SPDX-License-Identifier: MIT
// Expected errors: the rungs are those of the kept studies, and lie on powers between them.
#include "hyoryu/assess/accuracy.hpp"
#include "hyoryu/scene/case_file.hpp"
#include "io/results_fixture.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>

namespace hyoryu::test_accuracy {
namespace {

using test_help::put_text_into;

const std::string pool =
    "dimensions = 2\n[time]\nend = 1.0\n[particles]\nspacing = 0.05\n[fluid]\n"
    "[[fluid.block]]\nshape = \"box\"\nmin = [0.0, 0.0, 0.0]\nmax = [1.0, 0.0, 1.0]\n"
    "[[wall]]\nname = \"basin\"\nshape = \"basin\"\nmin = [0.0, 0.0, 0.0]\n"
    "max = [1.0, 0.0, 1.3]\nopen = [\"+z\"]\n";
const std::string stone =
    "[time]\nend = 1.0\nstep = 0.01\n[particles]\nspacing = 0.05\n[[wall]]\nname = \"floor\"\n"
    "shape = \"plane\"\npoint = [0.0, 0.0, 0.0]\nnormal = [0.0, 0.0, 1.0]\n[[body]]\n"
    "name = \"stone\"\nshape = \"box\"\nsize = [1.0, 0.2, 0.2]\ndensity = 2500.0\n"
    "position = [0.0, 0.0, 0.5]\n";

class Accuracy : public test_help::ResultsTest {
protected:
    std::vector<ExpectedError> expected(const std::string& text,
                                        const std::vector<std::string>& set = {}) const
    {
        put_text_into(folder / "case.toml", text);
        const Scene scene = read_case(folder / "case.toml", set);
        const Filling filling = fill(scene);
        return expected_errors(scene, filling, make_plan(scene, filling));
    }

    /// Errors of a kept study by the name of the run; those of its first quantity.
    static std::map<std::string, double> kept(const std::string& study, const std::string& quantity)
    {
        std::ifstream file(std::string(HYORYU_SOURCE_DIR) + "/docs/studies/" + study +
                           "/study.csv");
        std::map<std::string, double> errors;
        for (std::string line; std::getline(file, line);) {
            const auto at = line.find("," + quantity + ",");
            if (at == std::string::npos) {
                continue;
            }
            std::istringstream rest(line.substr(at + quantity.size() + 2));
            std::string value;
            for (int column = 0; column < 3; ++column) { // value, expected, error
                std::getline(rest, value, ',');
            }
            const std::string run = line[0] == '"' ? line.substr(1, line.find('"', 1) - 1)
                                                   : line.substr(0, line.find(','));
            errors[run] = std::atof(value.c_str());
        }
        return errors;
    }
};

TEST_F(Accuracy, RungsAreThoseOfTheKeptStudies)
{
    const auto still = kept("hydrostatic_tank/study", "\"pressure, rms error\"");
    for (const StudiedRung& rung : still_water_study.rungs) {
        const std::string run = fmt::format("k={}", rung.number);
        ASSERT_TRUE(still.contains(run)) << run;
        EXPECT_NEAR(rung.error, still.at(run), 1e-3 * rung.error) << run;
    }
    const auto bore = kept("debris_flood/study", "bore reaches the house");
    for (const StudiedRung& rung : bore_study.rungs) {
        const std::string run = fmt::format("spacing={}", 2.5 / rung.number);
        ASSERT_TRUE(bore.contains(run)) << run;
        EXPECT_NEAR(rung.error, bore.at(run), 3e-3 * rung.error) << run;
    }
    const auto timber = kept("falling_timber/study", "C before the left end lands");
    for (const StudiedRung& rung : timber_study.rungs) {
        const std::string run = fmt::format("step={},method=impulse", rung.number);
        ASSERT_TRUE(timber.contains(run)) << run;
        EXPECT_NEAR(rung.error, timber.at(run), 1e-3 * rung.error) << run;
    }
    EXPECT_NEAR(timber.at("step=0.01,method=penalty"), 0.58, 0.005);
}

TEST_F(Accuracy, OfStillWaterFollowsFromTheSoundSpeed)
{
    const double speed = std::sqrt(9.81 * 1.0);
    const auto at = [&](double k) {
        return expected(pool, {fmt::format("fluid.sound_speed={}", k * speed)}).at(0);
    };
    EXPECT_EQ(at(14).quantity, "pressure at rest");
    EXPECT_NEAR(at(14).error, 0.004296, 1e-5);
    // Half way in logarithms between 10 and 14: the geometric mean of the errors.
    EXPECT_NEAR(at(std::sqrt(140)).error, std::sqrt(0.008609 * 0.004296), 1e-5);
    // From 10 the error is halved at 14 nearly: 0.0043045 at 13.99.
    EXPECT_NE(at(10).halving.find("1.4 times the cost"), std::string::npos) << at(10).halving;
    EXPECT_NE(at(40).halving.find("no studied setting"), std::string::npos);
    EXPECT_TRUE(std::isnan(at(60).error)) << "beyond the study";
}

TEST_F(Accuracy, OutsideOfWhatWasStudiedThereIsNone)
{
    EXPECT_TRUE(std::isnan(expected(pool, {"particles.spacing=0.125"}).at(0).error));
    EXPECT_TRUE(std::isnan(expected(pool, {"fluid.formulation=mps"}).at(0).error));
}

TEST_F(Accuracy, OfBodiesFollowsFromTheStepInUnitsOfTheirFall)
{
    // A stone of 1 m is the timber; one of 4 m falls half as fast.
    EXPECT_NEAR(expected(stone).at(0).error, 1.324e-5, 1e-8);
    EXPECT_NEAR(expected(stone, {"body[0].size=[4.0, 0.2, 0.2]"}).at(0).error, 3.319e-6, 1e-9);
    // 0.005 % at 20 ms.
    EXPECT_EQ(expected(stone, {"time.step=0.02"}).at(0).halving, "not needed");
    EXPECT_TRUE(std::isnan(expected(stone, {"time.step=0.04"}).at(0).error));
    const ExpectedError springs = expected(stone, {"contact.method=penalty"}).at(0);
    EXPECT_EQ(springs.error, 0.58);
    EXPECT_NE(springs.halving.find("impulse"), std::string::npos);
}

// The effects of the case of a study, but for gauges, which change nothing.
std::vector<std::string> effects_of(const StudyCoverage& coverage)
{
    const std::string study(coverage.study);
    const std::filesystem::path file = std::filesystem::path(HYORYU_SOURCE_DIR) / "cases" /
                                       study.substr(0, study.find('/')) / "case.toml";
    const Scene scene = read_case(file, {});
    std::vector<std::string> names;
    for (const Plan::Effect& effect : make_plan(scene, fill(scene)).on) {
        if (effect.name != "gauges") {
            names.push_back(effect.name);
        }
    }
    return names;
}

TEST_F(Accuracy, C8CoverageIsThatOfTheCaseOfTheStudy)
{
    for (const StudyCoverage& coverage : {still_water_study, bore_study, timber_study}) {
        EXPECT_EQ(effects_of(coverage),
                  std::vector<std::string>(coverage.effects.begin(), coverage.effects.end()))
            << coverage.study;
        for (const std::string_view model : coverage.models) {
            EXPECT_NE(std::ranges::find(coverage.effects, model), coverage.effects.end()) << model;
        }
    }
    EXPECT_EQ(bore_study.fewest_spacings, bore_study.rungs.front().number);
    EXPECT_EQ(bore_study.most_spacings, bore_study.rungs.back().number);
}

TEST_F(Accuracy, C8NothingIsPromisedOfWetContact)
{
    const std::string crate = "[[body]]\nname = \"crate\"\nshape = \"box\"\n"
                              "size = [0.2, 0.0, 0.2]\ndensity = 500.0\n"
                              "position = [0.5, 0.0, 1.11]\n";
    for (const ExpectedError& e : expected(pool + crate)) {
        EXPECT_TRUE(std::isnan(e.error)) << e.quantity;
        EXPECT_EQ(e.halving, "not studied") << e.quantity;
        EXPECT_FALSE(e.not_covered.empty()) << e.quantity;
    }
    const std::string text = expected_errors_text(expected(pool + crate));
    EXPECT_NE(text.find("motion of bodies in contact, in water: not studied"), std::string::npos)
        << text;
    EXPECT_NE(text.find("studied without body_load"), std::string::npos) << text;
    // The impulse that is named is that of the kept study.
    const auto impulse = kept("debris_flood/study", "impulse on the house");
    EXPECT_NEAR(impulse.at("spacing=0.2"), 0.35, 0.005);
    EXPECT_NE(text.find("changes by 35 %"), std::string::npos) << text;
}

TEST_F(Accuracy, C8EveryStepBesideWhatWasStudiedIsNotStudied)
{
    struct Step {
        const char* base;
        std::vector<std::string> set;
        const char* why;
    };
    const std::string second = stone + "[[body]]\nname = \"other\"\nshape = \"box\"\n"
                                       "size = [1.0, 0.2, 0.2]\ndensity = 2500.0\n"
                                       "position = [3.0, 0.0, 0.5]\n";
    const std::vector<Step> steps{
        {pool.c_str(),
         {"dimensions=3", "particles.spacing=0.1", "fluid.block[0].max=[1.0, 0.5, 1.0]",
          "wall[0].max=[1.0, 0.5, 1.3]"},
         "2 dimensions"},
        {pool.c_str(), {"particles.spacing=0.125"}, "10 to 40 spacings"},
        {pool.c_str(), {"particles.spacing=0.02"}, "10 to 40 spacings"},
        {pool.c_str(), {"fluid.viscosity.model=none"}, "with artificial_viscosity"},
        {pool.c_str(),
         {"fluid.viscosity.model=laminar", "fluid.viscosity.kinematic=1e-3"},
         "without laminar_viscosity"},
        {pool.c_str(), {"fluid.density_diffusion.model=none"}, "with density_diffusion"},
        {pool.c_str(), {"fluid.formulation=mps"}, "formulation sph"},
        {stone.c_str(), {"dimensions=2", "body[0].size=[0.25, 0.0, 0.2]"}, "3 dimensions"},
        {second.c_str(), {}, "one body at most"},
    };
    for (const Step& step : steps) {
        const ExpectedError e = expected(step.base, step.set).at(0);
        EXPECT_TRUE(std::isnan(e.error)) << step.why;
        const std::string text = expected_errors_text({e});
        EXPECT_NE(text.find(step.why), std::string::npos) << text;
        EXPECT_NE(text.find(": not studied"), std::string::npos) << text;
    }
    EXPECT_TRUE(expected(pool).at(0).not_covered.empty());
    EXPECT_TRUE(expected(stone).at(0).not_covered.empty());
}

TEST_F(Accuracy, ASceneWithoutAnyOfItSaysSo)
{
    const std::string text = expected_errors_text(expected(stone, {"gravity=[0.0, 0.0, 0.0]"}));
    EXPECT_NE(text.find("no study applies"), std::string::npos);
}

} // namespace
} // namespace hyoryu::test_accuracy
