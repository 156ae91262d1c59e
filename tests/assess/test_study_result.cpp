// SPDX-License-Identifier: MIT
// Errors, staircase and cheapest settings of runs whose numbers are made by hand.
#include "hyoryu/assess/study_page.hpp"
#include "hyoryu/assess/study_result.hpp"
#include "io/results_fixture.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace hyoryu::test_study_result {
namespace {

using test_help::put_text_into;
using Runs = std::vector<std::size_t>;

/// What a run wrote: x at the end, pair interactions, steps.
struct Wrote {
    double x = 0;
    double pairs = 0;
    int steps = 1;
};

class StudyResults : public test_help::ResultsTest {
protected:
    static StudySweep sweep(const std::vector<double>& values,
                            const std::string& key = "particles.spacing")
    {
        StudySweep s;
        s.key = key;
        s.name = key.substr(key.find('.') + 1);
        s.values.assign(values.begin(), values.end());
        return s;
    }

    static StudyQuantity last_x(const std::string& expected)
    {
        return {.name = "x",
                .unit = "m",
                .quantity = {.series = {.value = "x"}, .measure = Measure::last},
                .expected = {.formula = expected},
                .against_finest = expected.empty()};
    }

    static Study study(std::vector<StudySweep> sweeps, const StudyQuantity& quantity)
    {
        return {.title = "A | study",
                .case_file = "cases/drop/case.toml",
                .sweeps = std::move(sweeps),
                .quantities = {quantity}};
    }

    std::filesystem::path write(std::size_t k, const Wrote& wrote) const
    {
        const auto place = folder / fmt::format("{}", k);
        put_text_into(place / "bodies.csv", fmt::format("time,x\n0,0\n1,{}\n", wrote.x));
        put_text_into(place / "summary.json",
                      fmt::format(R"({{"steps": {}, "wall_seconds": 9, "simulated_seconds": 1,
                          "pair_interactions": {}, "stages": {{"bodies": 0.5}}}})",
                                  wrote.steps, wrote.pairs));
        return place;
    }

    StudyResult evaluated(const Study& s, const std::vector<Wrote>& all) const
    {
        std::vector<std::filesystem::path> folders;
        for (std::size_t k = 0; k < all.size(); ++k) {
            folders.push_back(write(k, all[k]));
        }
        const std::vector<std::vector<double>> walls(all.size(), {3.0, 1.0, 2.0});
        return evaluate_study(s, folders, std::vector<std::string>(all.size()), walls);
    }
};

TEST_F(StudyResults, ErrorsAreRelativeAndTheOrderIsThatOfTheNumbers)
{
    // 10 (1 + h^2) against 10: errors h^2; cost h^-3, so m = 2/3.
    const StudyResult result = evaluated(study({sweep({0.2, 0.1, 0.05})}, last_x("10")),
                                         {{10.4, 125}, {10.1, 1000}, {10.025, 8000}});
    EXPECT_EQ(result.work_unit, "pair_interactions");
    EXPECT_NEAR(result.runs[0].values[0].error, 0.04, 1e-12);
    EXPECT_NEAR(result.runs[2].values[0].error, 0.0025, 1e-12);
    ASSERT_EQ(result.series.size(), 1u);
    const StudySeries& s = result.series[0];
    ASSERT_TRUE(s.order && s.by_work);
    EXPECT_NEAR(s.order->exponent, 2, 1e-9);
    EXPECT_NEAR(s.by_work->exponent, -2.0 / 3, 1e-9);
    ASSERT_EQ(s.rungs.size(), 2u);
    EXPECT_NEAR(s.rungs[0], 2, 1e-9);
    EXPECT_NEAR(s.rungs[1], 2, 1e-9);
    EXPECT_FALSE(s.extrapolation) << "an exact answer is known";
}

TEST_F(StudyResults, TheOrderIsPositiveTowardsTheLargestToo)
{
    StudySweep n = sweep({5, 10, 20});
    n.finest = StudySweep::Finest::largest;
    const StudyResult result =
        evaluated(study({n}, last_x("10")), {{10.4, 1}, {10.1, 2}, {10.025, 4}});
    EXPECT_NEAR(result.series[0].order->exponent, 2, 1e-9);
}

TEST_F(StudyResults, WithoutAFinestEndThereIsNoOrder)
{
    StudySweep ratio = sweep({1.2, 1.5, 2});
    ratio.finest = StudySweep::Finest::none;
    const StudyResult result =
        evaluated(study({ratio}, last_x("10")), {{10.4, 1}, {10.1, 2}, {10.025, 4}});
    EXPECT_FALSE(result.series[0].order || result.series[0].by_work);
    EXPECT_NEAR(result.runs[2].values[0].error, 0.0025, 1e-12);
}

TEST_F(StudyResults, WithoutAnExactAnswerTheFinestRunStandsForItAndTheLimitIsTold)
{
    // 10 - h: against the finest, 9.95, the errors are 0.15/9.95 and 0.05/9.95; the limit is 10.
    const StudyResult result =
        evaluated(study({sweep({0.2, 0.1, 0.05})}, last_x("")), {{9.8, 1}, {9.9, 2}, {9.95, 4}});
    EXPECT_NEAR(result.runs[0].values[0].error, 0.15 / 9.95, 1e-12);
    EXPECT_NEAR(result.runs[1].values[0].error, 0.05 / 9.95, 1e-12);
    EXPECT_TRUE(std::isnan(result.runs[2].values[0].error));
    ASSERT_TRUE(result.series[0].extrapolation);
    EXPECT_NEAR(result.series[0].extrapolation->order, 1, 1e-9);
    EXPECT_NEAR(result.series[0].extrapolation->limit, 10, 1e-9);
    EXPECT_EQ(frontier(result, 0), (Runs{0, 1})) << "what is held against itself proves nothing";
}

TEST_F(StudyResults, ErrorsAgainstDifferentRunsAreNotRanked)
{
    // Spacing 2 and 1, then the factor 0.6 and 0.3 at a spacing whose error it does not see.
    const StudySweep factor = sweep({0.6, 0.3}, "time.cfl");
    const StudyResult result = evaluated(study({sweep({4, 2, 1}), factor}, last_x("")),
                                         {{80, 1}, {95, 8}, {100, 64}, {95, 8}, {95.1, 16}});
    EXPECT_NEAR(result.runs[3].values[0].error, 0.1 / 95.1, 1e-12);
    EXPECT_EQ(frontier(result, 0), (Runs{0, 1}));
    EXPECT_EQ(cheapest(result, 0, 0.01), std::nullopt) << "0.1 % is of the factor alone";
}

TEST_F(StudyResults, TheStaircaseLeavesOutWhatIsDearerAndNoBetter)
{
    // Errors 8, 2, 3, 0.8 and 0.8 % at costs 10, 20, 30, 40 and 50.
    const StudyResult result = evaluated(study({sweep({5, 4, 3, 2, 1})}, last_x("100")),
                                         {{108, 10}, {98, 20}, {103, 30}, {100.8, 40}, {99.2, 50}});
    EXPECT_EQ(frontier(result, 0), (Runs{0, 1, 3}));
    EXPECT_EQ(cheapest(result, 0, 0.10), 0u);
    EXPECT_EQ(cheapest(result, 0, 0.05), 1u);
    EXPECT_EQ(cheapest(result, 0, 0.01), 3u);
    EXPECT_EQ(cheapest(result, 0, 0.005), std::nullopt);
}

TEST_F(StudyResults, OfTwoRunsThatCostTheSameTheBetterOneCounts)
{
    const StudyResult result =
        evaluated(study({sweep({2, 1})}, last_x("100")), {{108, 10}, {104, 10}});
    EXPECT_EQ(frontier(result, 0), (Runs{1}));
}

TEST_F(StudyResults, BodiesAloneCostTheirSteps)
{
    const StudyResult result =
        evaluated(study({sweep({2, 1})}, last_x("100")), {{108, 0, 50}, {104, 0, 100}});
    EXPECT_EQ(result.work_unit, "steps");
    EXPECT_EQ(result.runs[1].work, 100);
}

TEST_F(StudyResults, ARunThatStoppedHasNoErrorAndSaysWhy)
{
    const Study s = study({sweep({2, 1})}, last_x("100"));
    const auto done = write(0, {108, 10});
    const StudyResult result = evaluate_study(s, {done, folder / "none"},
                                              {"", "the simulation became unstable"}, {{1.0}, {}});
    EXPECT_TRUE(std::isnan(result.runs[1].values[0].error));
    EXPECT_EQ(result.runs[1].values[0].why, "the simulation became unstable");
    EXPECT_EQ(frontier(result, 0), (Runs{0}));
    const std::string page = study_markdown(result, {}, {});
    EXPECT_NE(page.find("the simulation became unstable"), std::string::npos);
}

TEST_F(StudyResults, AnErrorOfNothingNeedsAScale)
{
    StudyQuantity zero = last_x("0");
    const Study bare = study({sweep({2, 1})}, zero);
    EXPECT_NE(evaluated(bare, {{1, 1}, {2, 2}}).runs[0].values[0].why.find("scale"),
              std::string::npos);
    zero.scale = "4";
    const Study scaled = study({sweep({2, 1})}, zero);
    EXPECT_EQ(evaluated(scaled, {{1, 1}, {2, 2}}).runs[1].values[0].error, 0.5);
}

TEST_F(StudyResults, CsvAndJsonSayTheSame)
{
    const StudyResult result = evaluated(study({sweep({0.2, 0.1, 0.05})}, last_x("10")),
                                         {{10.4, 125}, {10.1, 1000}, {10.025, 8000}});
    const std::string csv = study_csv(result);
    EXPECT_NE(csv.find("\nspacing=0.1,0.1,x,10.1,10,"), std::string::npos) << csv;
    const auto json = nlohmann::json::parse(study_json(result, {}));
    ASSERT_EQ(json["runs"].size(), 3u);
    EXPECT_EQ(json["runs"][1]["work"], 1000);
    EXPECT_EQ(json["runs"][1]["wall_seconds"], (std::vector<double>{3, 1, 2}));
    EXPECT_NEAR(json["series"][0]["order"]["exponent"].get<double>(), 2, 1e-9);
    EXPECT_EQ(json["best"][0]["cheapest"][1]["run"], "spacing=0.1");
}

TEST_F(StudyResults, TablesStandOnThePageWithoutMarksOfMarkdownInThem)
{
    const StudyResult result = evaluated(study({sweep({0.2, 0.1, 0.05})}, last_x("10")),
                                         {{10.4, 125}, {10.1, 1000}, {10.025, 8000}});
    const std::string text = study_markdown(result, {}, {{"a.svg", ""}});
    EXPECT_NE(text.find("![a.svg](a.svg)"), std::string::npos);
    EXPECT_NE(text.find("| 0.1 | 10.1 | 10 | 1 % | 1000 | 2 (1 to 3) |"), std::string::npos)
        << text;
    const std::string page = study_page(result, {}, {{"a.svg", "<svg>a</svg>"}});
    EXPECT_NE(page.find("<svg>a</svg>"), std::string::npos);
    EXPECT_EQ(page.find("http://", page.find("<body>")), std::string::npos);
}

TEST_F(StudyResults, APictureShowsTheErrorsOfEveryRunAgainstCostAndNumbers)
{
    const StudySweep step = sweep({0.4, 0.2}, "time.step");
    const StudyResult result =
        evaluated(study({sweep({0.2, 0.1, 0.05}), step}, last_x("10")),
                  {{10.4, 125}, {10.1, 1000}, {10.025, 8000}, {10.3, 250}, {10.2, 500}});
    const StudyPictures pictures = draw_study(result);
    ASSERT_EQ(pictures.files.size(), 1U);
    EXPECT_EQ(pictures.files[0].name, "study_x.svg");
    const std::string& svg = pictures.files[0].text;
    for (const char* title : {"error against cost", "error against particles.spacing",
                              "error against time.step", "order 2.00", "best for the cost"}) {
        EXPECT_NE(svg.find(title), std::string::npos) << title;
    }
    // Five runs against the cost, three and two against their numbers, and an entry each of a
    // legend: of two sweeps, and of two orders.
    std::size_t dots = 0;
    for (auto at = svg.find("h0"); at != std::string::npos; at = svg.find("h0", at + 1)) {
        ++dots;
    }
    EXPECT_EQ(dots, 5U + 3 + 2 + 2 + 2);
    const StudyResult exact = evaluated(study({sweep({2, 1})}, last_x("10")), {{10, 1}, {10, 2}});
    EXPECT_TRUE(draw_study(exact).files.empty());
    EXPECT_EQ(draw_study(exact).notes.size(), 1U);
}

} // namespace
} // namespace hyoryu::test_study_result
