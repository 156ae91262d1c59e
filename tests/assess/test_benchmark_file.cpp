// SPDX-License-Identifier: MIT
// The benchmark file: runs, grids, and every mistake with its place.
#include "hyoryu/assess/benchmark.hpp"
#include "hyoryu/core/error.hpp"
#include "io/results_fixture.hpp"

#include <fmt/format.h>

namespace hyoryu::test_benchmark_file {
namespace {

using test_help::put_text_into;

const std::string head = "title = \"a test\"\ngroup = \"tests\"\nsource = \"none\"\n";
const std::string check = "[[check]]\nname = \"x\"\nvalue = \"x\"\nmeasure = \"last\"\n"
                          "expected = 1\ntolerance = 0.1\nbecause = \"a test\"\n";

class BenchmarkFiles : public test_help::ResultsTest {
protected:
    Benchmark read(const std::string& text) const
    {
        put_text_into(folder / "verify.toml", text);
        return read_benchmark(folder);
    }

    /// The first mistake that names the key, as `line:key: what (hint)`.
    std::string mistake(const std::string& text) const
    {
        try {
            read(text);
        } catch (const CaseError& error) {
            const Diagnostic& first = error.diagnostics().front();
            return fmt::format("{}:{}: {} ({})", first.line, first.key, first.what, first.hint);
        }
        return "";
    }
};

TEST_F(BenchmarkFiles, AGridMakesEveryCombinationInTheOrderOfTheFile)
{
    const Benchmark benchmark =
        read(head + "[constants]\nd = 0.01\nhalf = \"d/2\"\n[[run]]\nname = \"${law}-${n}\"\n"
                    "set = [\"contact.law=${law}\", \"body[0].spacing=${half*n}\"]\n"
                    "grid = { n = [1, 2], law = [\"coupled\", \"paper\"] }\n");
    ASSERT_EQ(benchmark.runs.size(), 4u);
    EXPECT_EQ(benchmark.runs[0].name, "coupled-1");
    EXPECT_EQ(benchmark.runs[1].name, "paper-1");
    EXPECT_EQ(benchmark.runs[2].name, "coupled-2");
    EXPECT_EQ(benchmark.runs[2].set,
              (std::vector<std::string>{"contact.law=coupled", "body[0].spacing=0.01"}));
    EXPECT_EQ(scope_of(benchmark.definitions, benchmark.runs[3]).numbers.at("n"), 2);
}

TEST_F(BenchmarkFiles, AMeanIsOverAParameterThatTellsRunsApart)
{
    const std::string runs = "[[run]]\nname = \"${s}-${c}\"\ngrid = { s = [1, 2], c = [3, 4] }\n"
                             "[[run]]\nname = \"one-${s}\"\ngrid = { s = [1], c = [5] }\n";
    const std::string over = "mean_over = \"c\"\n";
    const Benchmark good = read(head + runs + check + over + "runs = [\"*-3\", \"*-4\"]\n");
    EXPECT_EQ(good.checks[0].mean_over, "c");
    const std::string lonely = mistake(head + runs + check + over + "runs = [\"1-3\"]\n");
    EXPECT_NE(lonely.find("no two runs of the check differ in \"c\" alone"), std::string::npos)
        << lonely;
    EXPECT_NE(mistake(head + runs + check + "mean_over = \"d\"\n"), "");
    EXPECT_NE(mistake(head + check + over), "") << "without a grid";
    EXPECT_NE(mistake(head + runs +
                      "[[check]]\nname = \"y\"\nvalue = \"x\"\n"
                      "measure = \"last\"\nsame_as = \"1-3\"\ntolerance = 1\n"
                      "because = \"a test\"\nruns = [\"1-*\"]\n" +
                      over),
              "");
}

TEST_F(BenchmarkFiles, ACheckSaysWhatItIsHeldAgainst)
{
    const std::string other = "[[check]]\nname = \"y\"\nvalue = \"x\"\nmeasure = \"last\"\n"
                              "at_most = 1\nbecause = \"a test\"\nagainst = \"conservation\"\n";
    const Benchmark stated = read(head + "against = \"experiment\"\n" + check + other);
    EXPECT_EQ(stated.checks[0].against, Against::experiment);
    EXPECT_EQ(stated.checks[1].against, Against::conservation);
    EXPECT_EQ(read(head + check).checks[0].against, std::nullopt);
    EXPECT_EQ(mistake(head + check + "against = \"experimnt\"\n"),
              "11:check[0].against: unknown \"experimnt\" (did you mean \"experiment\"?)");
}

TEST_F(BenchmarkFiles, AKnownFailureNeedsABound)
{
    EXPECT_EQ(mistake(head + check + "xfail = \"why\"\n"),
              "4:check[0].xfail_within: is missing: the largest error of the known failure, beyond "
              "which it fails (give a distance in the unit of the value)");
    EXPECT_EQ(mistake(head + check + "xfail_within = 2\n"),
              "11:check[0].xfail_within: has no meaning without `xfail` ()");
    EXPECT_EQ(read(head + check + "xfail = \"why\"\nxfail_within = 2\n").checks[0].xfail_within,
              "2");
}

TEST_F(BenchmarkFiles, EachCheckOfTheShippedCasesSaysWhatItIsHeldAgainst)
{
    for (const Benchmark& benchmark : read_benchmarks(std::string(HYORYU_SOURCE_DIR) + "/cases")) {
        for (const Check& shipped : benchmark.checks) {
            EXPECT_TRUE(shipped.against) << benchmark.name << ": " << shipped.name;
        }
    }
}

TEST_F(BenchmarkFiles, AParameterReplacesAConstantAndWhatFollowsFromIt)
{
    const Benchmark benchmark = read(head + "[constants]\nh = 1\ndouble = \"2*h\"\n[[run]]\n"
                                            "name = \"high\"\ngrid = { h = 5 }\n");
    EXPECT_EQ(scope_of(benchmark.definitions, benchmark.runs[0]).numbers.at("double"), 10);
    EXPECT_EQ(scope_of(benchmark.definitions, {}).numbers.at("double"), 2);
}

TEST_F(BenchmarkFiles, WithoutRunsTheCaseRunsOnceAsItIs)
{
    const Benchmark benchmark = read(head + check);
    ASSERT_EQ(benchmark.runs.size(), 1u);
    EXPECT_TRUE(benchmark.runs[0].set.empty());
    EXPECT_EQ(benchmark.runs[0].tier, Tier::quick);
}

TEST_F(BenchmarkFiles, TheRunThatACheckIsHeldAgainstIsMadeBefore)
{
    const auto with = [&](const std::string& same_as, const std::string& tier) {
        return head + "[[run]]\nname = \"a-${n}\"\ngrid = { n = [1, 2] }\n" + tier +
               "[[check]]\nname = \"x\"\nvalue = \"x\"\nmeasure = \"last\"\ntolerance = 1\n"
               "because = \"a test\"\nsame_as = \"" +
               same_as + "\"\n";
    };
    EXPECT_EQ(read(with("a-${n > 1 ? 1 : n}", "")).checks[0].same_as, "a-${n > 1 ? 1 : n}");
    EXPECT_NE(mistake(with("b", "")).find("no run is named \"b\""), std::string::npos);
    EXPECT_NE(mistake(with("a-${m}", "")).find("check[0].same_as"), std::string::npos);
    EXPECT_NE(mistake(with("a-2", "")).find("the run \"a-2\" is not made before the run \"a-1\""),
              std::string::npos);
    const std::string later = "[[run]]\nname = \"c\"\ntier = \"quick\"\n";
    EXPECT_NE(mistake(with("a-1", "tier = \"nightly\"\n" + later)).find("not made before"),
              std::string::npos);
    EXPECT_NE(mistake(with("a-1", "") + "expected = 1\n").find("give one of"), std::string::npos);
}

TEST_F(BenchmarkFiles, MistakesHaveTheirPlaceAndAHint)
{
    EXPECT_EQ(mistake(head + "tiers = \"quick\"\n"),
              "4:tiers: unknown key (did you mean \"tier\"?)");
    EXPECT_EQ(mistake("title = \"t\"\ngroup = \"g\"\n").substr(2),
              "source: is missing (write source = followed by its value)");
    EXPECT_NE(mistake(head + "[[check]]\nname = \"x\"\nvalue = \"x +\"\nmeasure = \"last\"\n"
                             "expected = 1\ntolerance = 1\nbecause = \"b\"\n")
                  .find("6:check[0].value: \"x +\" is not an expression"),
              std::string::npos);
    EXPECT_NE(mistake(head + check + "judged = [\"rnu\"]\n").find("did you mean \"run\""),
              std::string::npos);
    EXPECT_NE(mistake(head + check + "xfail_runs = [\"run\"]\n").find("without `xfail`"),
              std::string::npos);
    EXPECT_NE(mistake(head + "[[run]]\nname = \"a\"\ngrid = { n = [1, 2] }\n").find("twice"),
              std::string::npos);
    EXPECT_NE(mistake("title = \n").find("1:"), std::string::npos);
}

TEST_F(BenchmarkFiles, WithoutAnyRunThereIsNothingToCheck)
{
    const std::string none = head + "run = []\n" + check;
    EXPECT_EQ(mistake(none), "4:run: defines no run (omit it to run the case unchanged)");
    // Patterns of runs that a mistake has left out.
    EXPECT_EQ(mistake(head + "[constants]\ng = nan\n[[run]]\ngrid = { k = [1] }\n" + check +
                      "runs = [\"a*\"]\n"),
              "5:constants.g: unknown name \"nan\"; no names are defined ()");
}

TEST_F(BenchmarkFiles, AToleranceNeedsAReason)
{
    std::string text = check;
    text.replace(text.find("because"), std::string::npos, "");
    EXPECT_NE(mistake(head + text).find("because: is missing"), std::string::npos);
    text.replace(text.find("tolerance"), std::string::npos, "because = \"b\"\n");
    EXPECT_NE(mistake(head + text).find("give either `tolerance` or `relative`"),
              std::string::npos);
}

TEST_F(BenchmarkFiles, ReflectionNeedsThreeGaugesWithTheirPlaces)
{
    const auto with = [&](const std::string& waves, const std::string& measure = "reflection") {
        return head + "[[check]]\nname = \"x\"\nvalue = \"a\"\nmeasure = \"" + measure +
               "\"\nat_most = 0.1\nbecause = \"a test\"\n" + waves;
    };
    const std::string waves =
        "waves = { beside = [\"b\", \"c - 1\"], distance = [0.5, 1], period = \"2*2\", "
        "wavenumber = 1.4 }\n";
    const Quantity quantity = read(with(waves)).checks.front().quantity;
    ASSERT_TRUE(quantity.waves);
    EXPECT_EQ(quantity.waves->beside, (std::vector<std::string>{"b", "c - 1"}));
    EXPECT_EQ(quantity.waves->distance, (std::vector<double>{0.5, 1}));
    EXPECT_EQ(quantity.waves->period, "2*2");
    EXPECT_NE(mistake(with("")).find("must be given with the measure \"reflection\""),
              std::string::npos);
    EXPECT_NE(mistake(with(waves, "last")).find("must be given with"), std::string::npos);
    EXPECT_NE(mistake(with("waves = { beside = [\"b\"], distance = [1], period = 2, "
                           "wavenumber = 1 }\n"))
                  .find("at least two gauges"),
              std::string::npos);
    EXPECT_NE(mistake(with("waves = { beside = [\"b\", \"c\"], distance = [1], period = 2, "
                           "wavenumber = 1 }\n"))
                  .find("1 numbers for 2 gauges"),
              std::string::npos);
    EXPECT_NE(mistake(with("waves = { beside = [\"b +\", \"c\"], distance = [1, 2], period = 2, "
                           "wavenumber = 1 }\n")),
              "");
    EXPECT_NE(mistake(with("waves = { beside = [\"b\", \"c\"], distance = [1, 2] }\n")), "");
    EXPECT_NE(mistake(with("since = \"b\"\n" + waves)).find("has no meaning"), std::string::npos);
    for (const char* expected :
         {"same_as = \"run\"\ntolerance = 1",
          "reference = { file = \"gauges\", value = \"a\" }\ntolerance = 1"}) {
        std::string text = with(waves);
        text.replace(text.find("at_most = 0.1"), std::string("at_most = 0.1").size(), expected);
        EXPECT_NE(mistake(text).find("has no meaning for the measure"), std::string::npos)
            << expected;
    }
}

TEST(Patterns, AStarStandsForAnyLetters)
{
    EXPECT_TRUE(matches({"*"}, "anything"));
    EXPECT_TRUE(matches({"a*c*"}, "abcd"));
    EXPECT_TRUE(matches({"x", "abc"}, "abc"));
    EXPECT_FALSE(matches({"a*c"}, "abcd"));
    EXPECT_FALSE(matches({"ab*"}, "a"));
}

class Selection : public ::testing::Test {
protected:
    static Benchmark benchmark(const std::string& name, Tier tier)
    {
        Benchmark result;
        result.name = name;
        result.group = "contact";
        result.runs = {{.name = "run", .set = {}, .tier = tier, .parameters = {}}};
        return result;
    }
    const std::vector<Benchmark> all{benchmark("drop", Tier::quick),
                                     benchmark("heap", Tier::nightly)};
};

TEST_F(Selection, TakesNamesGroupsAndTiersThatIncludeTheLowerOnes)
{
    EXPECT_EQ(select(all, {}, Tier::quick).size(), 1u);
    EXPECT_EQ(select(all, {}, Tier::nightly).size(), 2u);
    EXPECT_EQ(select(all, {"contact"}, Tier::release).size(), 2u);
    EXPECT_EQ(select(all, {"drop"}, Tier::nightly).front().name, "drop");
    std::vector<Benchmark> two = all;
    two[1].also = {"stability"};
    EXPECT_EQ(select(two, {"stability"}, Tier::nightly).front().name, "heap");
}

TEST_F(Selection, RefusesWhatItDoesNotKnowOrWhatTheTierLeavesOut)
{
    const auto fault = [&](const char* name) -> std::string {
        try {
            select(all, {name}, Tier::quick);
        } catch (const CaseError& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_NE(fault("dorp").find("did you mean \"drop\""), std::string::npos);
    EXPECT_NE(fault("heap").find("--tier nightly"), std::string::npos);
}

// The name of a run is that of its folder.
TEST_F(BenchmarkFiles, RunsCannotLeaveTheirFolder)
{
    for (const char* name : {"../x", "a/b", ".", "..", "", "a\\\\b", "a\\u0000"}) {
        EXPECT_NE(mistake(head + check + "[[run]]\nname = \"" + name + "\"\n")
                      .find("is not a valid folder name"),
                  std::string::npos)
            << name;
    }
}

TEST_F(BenchmarkFiles, AGridIsCountedBeforeItIsMade)
{
    std::string list = "[";
    for (int k = 0; k < 1000; ++k) {
        list += std::to_string(k) + ",";
    }
    EXPECT_NE(mistake(head + check + "[[run]]\nname = \"${a}-${b}-${c}\"\ngrid = { a = " + list +
                      "], b = " + list + "], c = " + list + "] }\n")
                  .find("defines 1000000000 runs"),
              std::string::npos);
}

} // namespace
} // namespace hyoryu::test_benchmark_file
