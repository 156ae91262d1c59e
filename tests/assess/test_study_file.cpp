// SPDX-License-Identifier: MIT
// The study file: runs in their order, and every mistake with its place.
#include "hyoryu/assess/study.hpp"
#include "hyoryu/core/error.hpp"
#include "hyoryu/scene/case_file.hpp"
#include "io/results_fixture.hpp"

#include <fmt/format.h>

namespace hyoryu::test_study_file {
namespace {

using test_help::put_text_into;
using Texts = std::vector<std::string>;

const std::string head = "title = \"a test\"\ncase = \"case.toml\"\n";
const std::string step = "[[sweep]]\nkey = \"time.step\"\nvalues = [0.02, 0.01]\n"; // three lines
const std::string law = "[[sweep]]\nkey = \"contact.law\"\nvalues = [\"coupled\", \"paper\"]\n";
const std::string place = "[[quantity]]\nname = \"x\"\nvalue = \"x\"\nmeasure = \"last\"\n"
                          "expected = 1\n";

class StudyFiles : public test_help::ResultsTest {
protected:
    void SetUp() override { put_text_into(folder / "case.toml", ""); }

    Study read(const std::string& text) const
    {
        put_text_into(folder / "study.toml", text);
        return read_study(folder / "study.toml");
    }

    /// Every mistake, as `line:column: key: what (hint)`.
    Texts mistakes(const std::string& text) const
    {
        Texts all;
        try {
            read(text);
        } catch (const CaseError& error) {
            for (const Diagnostic& d : error.diagnostics()) {
                all.push_back(
                    fmt::format("{}:{}: {}: {} ({})", d.line, d.column, d.key, d.what, d.hint));
            }
        }
        return all;
    }

    std::string mistake(const std::string& text) const
    {
        const Texts all = mistakes(text);
        return all.empty() ? "" : all.front();
    }

    static Texts names(const Study& study)
    {
        Texts all;
        for (const StudyRun& run : runs_of(study)) {
            all.push_back(run.run.name);
        }
        return all;
    }
};

TEST_F(StudyFiles, OneSweepAtATimeLeavesTheOthersAsInTheCase)
{
    const Study study = read(head + "set = [\"time.end=1\"]\n" + step + law + place);
    EXPECT_EQ(names(study), (Texts{"step=0.02", "step=0.01", "law=coupled", "law=paper"}));
    const std::vector<StudyRun> runs = runs_of(study);
    EXPECT_EQ(runs[1].run.set, (Texts{"time.end=1", "time.step=0.01"}));
    EXPECT_EQ(runs[3].run.set, (Texts{"time.end=1", "contact.law=\"paper\""}));
    EXPECT_EQ(runs[3].value_of, (std::vector<int>{-1, 1}));
    EXPECT_EQ(scope_of(study.definitions, runs[1].run).numbers.at("step"), 0.01);
}

TEST_F(StudyFiles, AGridMakesEveryCombinationTheLastSweepFastest)
{
    const Study study = read(head + "mode = \"grid\"\n" + step + law + place);
    EXPECT_EQ(names(study), (Texts{"step=0.02,law=coupled", "step=0.02,law=paper",
                                   "step=0.01,law=coupled", "step=0.01,law=paper"}));
}

TEST_F(StudyFiles, ASeriesGoesFromCoarseToFineWithTheOthersFixed)
{
    const std::string text =
        "mode = \"grid\"\n[[sweep]]\nname = \"n\"\nvalues = [20, 80, 40]\nfinest = \"largest\"\n"
        "set = [\"particles.spacing=${1/n}\"]\n";
    const Study study = read(head + text + law + place);
    const std::vector<StudyRun> runs = runs_of(study);
    using Lists = std::vector<std::vector<std::size_t>>;
    EXPECT_EQ(series_of(study, runs, 0), (Lists{{0, 4, 2}, {1, 5, 3}}));
    EXPECT_EQ(series_of(study, runs, 1), (Lists{{0, 1}, {2, 3}, {4, 5}}));
    EXPECT_EQ(runs[2].run.set, (Texts{"particles.spacing=0.0125", "contact.law=\"coupled\""}));
}

TEST_F(StudyFiles, ChoicesSetWhatTheySayFromTheValuesOfAllSweeps)
{
    const Study study =
        read(head + "mode = \"grid\"\n[constants]\nk = 100\n" + step +
             "[[sweep]]\nname = \"method\"\n[sweep.choices]\nimpulse = []\n"
             "penalty = [\"contact.method=penalty\", \"contact.penalty.step=${step/k}\"]\n" +
             place);
    const std::vector<StudyRun> runs = runs_of(study);
    ASSERT_EQ(runs.size(), 4u);
    EXPECT_EQ(runs[2].run.name, "step=0.01,method=impulse");
    EXPECT_EQ(runs[2].run.set, (Texts{"time.step=0.01"}));
    EXPECT_EQ(runs[3].run.set,
              (Texts{"time.step=0.01", "contact.method=penalty", "contact.penalty.step=1e-04"}));
}

TEST_F(StudyFiles, ThreadsAreSweptWithoutAKeyOfTheCase)
{
    const Study study = read(head + "[[sweep]]\nkey = \"threads\"\nvalues = [1, 2]\n" + place);
    const std::vector<StudyRun> runs = runs_of(study);
    EXPECT_EQ(runs[1].threads, 2);
    EXPECT_TRUE(runs[1].run.set.empty());
    EXPECT_NE(mistake(head + "[[sweep]]\nkey = \"threads\"\nvalues = [1, 1.5]\n" + place)
                  .find("whole numbers"),
              std::string::npos);
}

TEST_F(StudyFiles, AQuantityIsHeldAgainstOneThing)
{
    const std::string quantity = "[[quantity]]\nname = \"x\"\nvalue = \"x\"\nmeasure = \"last\"\n";
    EXPECT_TRUE(
        read(head + step + quantity + "against = \"finest\"\n").quantities[0].against_finest);
    put_text_into(folder / "a.csv", "x\n1\n");
    const auto with_reference =
        read(head + step + quantity + "reference = { file = \"a.csv\", value = \"x\" }\n");
    EXPECT_TRUE(with_reference.quantities[0].expected.reference);
    EXPECT_FALSE(with_reference.quantities[0].against_finest);
    EXPECT_NE(mistake(head + step + quantity).find("give one of `expected`"), std::string::npos);
    EXPECT_NE(mistake(head + step + quantity + "expected = 1\nagainst = \"finest\"\n")
                  .find("give one of `expected`"),
              std::string::npos);
}

// The errors of no run could be divided by it: told before the first run.
TEST_F(StudyFiles, AnExpectedZeroNeedsAScale)
{
    const std::string quantity = "[[quantity]]\nname = \"x\"\nvalue = \"x\"\nmeasure = \"last\"\n";
    const std::string start = head + "[constants]\ng = 9.81\n" + step + quantity;
    for (const char* zero : {"0", "0.0", "\"0\"", "\"g - 9.81\"", "\"step - 0.01\""}) {
        const std::string expected = fmt::format("expected = {}\n", zero);
        const std::string told = mistake(start + expected);
        EXPECT_NE(told.find("12:12: quantity[0].expected: is 0 in the run \"step=0.0"),
                  std::string::npos)
            << zero << ": " << told;
        EXPECT_NE(told.find("give `scale`"), std::string::npos) << told;
        EXPECT_EQ(mistake(start + expected + "scale = \"2*g\"\n"), "");
        EXPECT_NE(mistake(start + expected + "scale = \"step - 1\"\n").find("scale: is -0.98"),
                  std::string::npos);
    }
    EXPECT_EQ(mistake(start + "expected = \"-g\"\n"), "");
    EXPECT_EQ(mistake(start + "expected = \"stages.forces\"\n"), ""); // a name of results
    const std::string difference =
        "[[quantity]]\nname = \"y\"\nvalue = \"x\"\nmeasure = \"rms_error\"\n";
    EXPECT_EQ(mistake(head + step + difference + "expected = 0\n"), "");
}

TEST_F(StudyFiles, MistakesAreAllToldWithTheirPlace)
{
    const Texts all = mistakes(head + "mod = \"grid\"\nrepeats = 0\n" +
                               "[[sweep]]\nkey = \"time.step\"\nvalues = []\nfinest = \"least\"\n"
                               "[[quantity]]\nname = \"x\"\nvalue = \"x +\"\nmeasure = \"lst\"\n"
                               "expected = 1\n");
    const std::string told = fmt::format("{}", fmt::join(all, "\n"));
    EXPECT_EQ(all.size(), 6u) << told;
    for (const char* part :
         {"3:1: mod: unknown key (did you mean \"mode\"?)", "4:11: repeats: expected 1 to 1000",
          "7:10: sweep[0].values: is empty", "8:10: sweep[0].finest: unknown \"least\"",
          "11:9: quantity[0].value: \"x +\" is not an expression", "12:11: quantity[0].measure"}) {
        EXPECT_NE(told.find(part), std::string::npos) << part << " is not in\n" << told;
    }
}

TEST_F(StudyFiles, ASweepVariesOneThingInOneWay)
{
    const std::string both = "values = [1]\nchoices = { a = [] }\n";
    const Texts all = mistakes(head + "[[sweep]]\nname = \"n\"\n" + both + place);
    ASSERT_EQ(all.size(), 1u) << fmt::format("{}", fmt::join(all, "\n"));
    EXPECT_NE(all[0].find("3:1: sweep[0]: give one of `values` and `choices`"), std::string::npos);
    EXPECT_NE(mistake(head + "[[sweep]]\nname = \"n\"\nvalues = [1]\n" + place)
                  .find("3:1: sweep[0]: does not name a setting to vary"),
              std::string::npos);
    EXPECT_NE(mistake(head + "[[sweep]]\nname = \"n\"\nchoices = { a = [1] }\n" + place)
                  .find("sweep[0].choices.a: expected a list of texts"),
              std::string::npos);
}

TEST_F(StudyFiles, ShippedStudiesAreReadAndTheirCasesKnowEveryOverride)
{
    int studies = 0;
    const std::filesystem::path root = HYORYU_SOURCE_DIR;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / "cases")) {
        if (entry.path().filename().string().starts_with("study") &&
            entry.path().extension() == ".toml") {
            SCOPED_TRACE(entry.path().string());
            const Study study = read_study(entry.path());
            for (const StudyRun& run : runs_of(study)) {
                EXPECT_NO_THROW(read_case(study.case_file, run.run.set)) << run.run.name;
            }
            const auto kept = root / "docs" / "studies" / entry.path().parent_path().filename() /
                              entry.path().stem();
            EXPECT_TRUE(std::filesystem::exists(kept / "study.md")) << "no results are kept";
            ++studies;
        }
    }
    EXPECT_GE(studies, 10);
}

TEST_F(StudyFiles, WhatIsMissingIsTold)
{
    const std::string told = fmt::format("{}", fmt::join(mistakes("title = \"t\"\n"), "\n"));
    for (const char* part :
         {"case: is missing", "at least one [[sweep]]", "at least one [[quantity]]"}) {
        EXPECT_NE(told.find(part), std::string::npos) << part << " is not in\n" << told;
    }
    EXPECT_NE(mistake("title = \"t\"\ncase = \"other.toml\"\n" + step + place)
                  .find("other.toml` does not exist"),
              std::string::npos);
}

// E2, E8: names of files, and how many runs there may be.
TEST_F(StudyFiles, E2E8FilesThatCannotBeReadAreToldBeforeAnyRun)
{
    const auto with_case = [&](const std::string& file) {
        return mistake("title = \"t\"\ncase = \"" + file + "\"\n" + step + place);
    };
    EXPECT_NE(with_case("").find("case: the file"), std::string::npos);
    EXPECT_NE(with_case("").find("is a folder"), std::string::npos);
    EXPECT_NE(with_case("/dev/zero").find("is a device"), std::string::npos);
    const auto with_reference = [&](const std::string& file) {
        return mistake(head + step + "[[quantity]]\nname = \"x\"\nvalue = \"x\"\n" +
                       "measure = \"rms_error\"\n[quantity.reference]\nvalue = \"x\"\nfile = \"" +
                       file + "\"\n");
    };
    EXPECT_NE(with_reference("").find("is empty"), std::string::npos);
    EXPECT_NE(with_reference("none.csv").find("does not exist"), std::string::npos);
    EXPECT_THROW(read_study("/dev/zero"), CaseError);
    EXPECT_THROW(read_study(folder), CaseError);
}

// E11: as of a case, at most a hundred mistakes are told, and none with a line of a megabyte.
TEST_F(StudyFiles, E11MessagesAreNoLongerThanAScreen)
{
    std::string many = head + step + place;
    for (int k = 0; k < 500; ++k) {
        many = fmt::format("unknown{} = {}\n", k, k) + many;
    }
    const Texts all = mistakes(many);
    ASSERT_EQ(all.size(), 101U);
    EXPECT_NE(all.back().find("and 400 more errors"), std::string::npos) << all.back();
    put_text_into(folder / "study.toml",
                  "title = \"" + std::string(1'000'000, 'a') + "\"\n" + step + place);
    try {
        read_study(folder / "study.toml");
        ADD_FAILURE() << "nothing was told";
    } catch (const CaseError& error) {
        EXPECT_LT(std::string(error.what()).size(), 5000U);
    }
}

TEST_F(StudyFiles, E8RunsAreCountedBeforeTheyAreListed)
{
    std::string sweeps = "mode = \"grid\"\n";
    for (const char* key : {"time.step", "time.end", "particles.spacing"}) {
        sweeps += std::string("[[sweep]]\nkey = \"") + key + "\"\nvalues = [";
        for (int k = 1; k <= 1000; ++k) {
            sweeps += std::to_string(k) + ",";
        }
        sweeps += "]\n";
    }
    EXPECT_NE(mistake(head + sweeps + place).find("defines 1000000000 runs, at most 10000"),
              std::string::npos);
    EXPECT_NE(mistake(head + "repeats = 1000\n" + step + step.substr(0, 10) +
                      "key = \"time.end\"\nvalues = [1,2,3,4,5,6,7,8,9]\n" + place)
                  .find("defines 11000 runs"),
              std::string::npos);
}

TEST_F(StudyFiles, WhatIsShownHoldsNoControlCharacters)
{
    const std::string bad = "a\\u001b[31m";
    EXPECT_NE(mistake("title = \"" + bad + "\"\ncase = \"case.toml\"\n" + step + place)
                  .find("title: cannot be shown"),
              std::string::npos);
    EXPECT_NE(mistake(head + step + "[[quantity]]\nname = \"=1\"\n" + place.substr(24))
                  .find("name: cannot be shown"),
              std::string::npos);
    EXPECT_NE(mistake(head + "[[sweep]]\nkey = \"title\"\nvalues = [\"" + bad + "\"]\n" + place)
                  .find("values: cannot be shown"),
              std::string::npos);
}

TEST_F(StudyFiles, RunsThatCannotBeToldApartAreRefused)
{
    const std::string twice = "[[sweep]]\nkey = \"time.step\"\nvalues = [0.01, 0.01]\n";
    EXPECT_NE(mistake(head + twice + place).find("\"step=0.01\" is defined twice"),
              std::string::npos);
    EXPECT_NE(mistake(head + step + step + place).find("\"step\" is defined twice"),
              std::string::npos);
    EXPECT_NE(mistake(head + step + place + place).find("\"x\" is defined twice"),
              std::string::npos);
}

TEST_F(StudyFiles, AnOverrideThatCannotBeEvaluatedIsRefusedBeforeAnyRun)
{
    const std::string sweep =
        "[[sweep]]\nname = \"n\"\nvalues = [1, 2]\nset = [\"particles.spacing=${1/m}\"]\n";
    EXPECT_NE(mistake(head + sweep + place).find("m"), std::string::npos);
}

} // namespace
} // namespace hyoryu::test_study_file
