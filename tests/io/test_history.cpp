// SPDX-License-Identifier: MIT
// Histories: exact numbers, units, and going on after a kill that tore the last row.
#include "hyoryu/core/error.hpp"
#include "hyoryu/io/results.hpp"
#include "results_fixture.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

namespace hyoryu::test_history {
namespace {

using test_help::put_text_into;
using test_help::text_of;

class Histories : public test_help::ResultsTest {
protected:
    const Table table{"bodies", {{"time", "s"}, {"body", ""}, {"x", "m"}}};
};

TEST(Cell, ReadsBackAsTheSameDouble)
{
    for (const double value : {0.0, -0.0, 0.1, 1.0 / 3.0, 5e-324, 1e300, -123456.789}) {
        const double back = std::strtod(cell(value).c_str(), nullptr);
        EXPECT_EQ(std::bit_cast<std::uint64_t>(back), std::bit_cast<std::uint64_t>(value));
    }
    EXPECT_EQ(cell(0.1), "0.1");
    EXPECT_EQ(cell(std::numeric_limits<double>::quiet_NaN()), "nan");
    EXPECT_EQ(cell("timber.1"), "timber.1");
    EXPECT_EQ(cell("a,\"b\""), "\"a,\"\"b\"\"\"");
}

TEST_F(Histories, HaveUnitsHeaderAndRows)
{
    {
        History history(folder, table);
        history.append(std::array{cell(0.0), cell("timber"), cell(1.5)});
        history.append(std::array{cell(0.1), cell("house, old"), cell(-2.0)});
    }
    EXPECT_EQ(text_of(folder / "bodies.csv"),
              "# s,-,m\ntime,body,x\n0,timber,1.5\n0.1,\"house, old\",-2\n");
}

TEST_F(Histories, AreOnDiskAfterFlush)
{
    History history(folder, table);
    history.append(std::array{cell(0.0), cell("timber"), cell(1.5)});
    history.flush();
    EXPECT_TRUE(text_of(folder / "bodies.csv").ends_with("0,timber,1.5\n"));
}

TEST_F(Histories, GoOnBehindTheRowsThatAreKept)
{
    const std::string header = "# s,-,m\ntime,body,x\n";
    put_text_into(folder / "bodies.csv",
                  header + "0,a,1\n9e-1,a,2\n1,a,3\n1,\"b, c\",4\n1.0000001,a,5\n1.2,a,6\n0.5,a");
    {
        History history(folder, table, 1.0);
        history.append(std::array{cell(1.1), cell("a"), cell(7.0)});
    }
    EXPECT_EQ(text_of(folder / "bodies.csv"),
              header + "0,a,1\n9e-1,a,2\n1,a,3\n1,\"b, c\",4\n1.1,a,7\n");
}

TEST_F(Histories, GoOnBehindTheirFirstRowsWhateverTimesLaterOnesHave)
{
    // A sum that ended at 0.5 but was written at 1.5, after the checkpoint at 1.
    const std::string header = "# s,-,m\ntime,body,x\n";
    put_text_into(folder / "bodies.csv", header + "0,a,1\n1,a,2\n0.5,a,3\n1.5,a,4\n");
    {
        History history(folder, table, 1.0, 2);
        EXPECT_EQ(history.rows(), 2);
        history.append(std::array{cell(0.5), cell("a"), cell(3.0)});
        EXPECT_EQ(history.rows(), 3);
    }
    EXPECT_EQ(text_of(folder / "bodies.csv"), header + "0,a,1\n1,a,2\n0.5,a,3\n");
}

TEST_F(Histories, StartAnewWithoutAFileOrWithATornHeader)
{
    const std::string header = "# s,-,m\ntime,body,x\n";
    {
        const History history(folder, table, 1.0);
    }
    EXPECT_EQ(text_of(folder / "bodies.csv"), header);
    put_text_into(folder / "bodies.csv", "# s,-,m\ntime,bo");
    {
        const History history(folder, table, 1.0);
    }
    EXPECT_EQ(text_of(folder / "bodies.csv"), header);
}

TEST_F(Histories, OfOtherColumnsAreNotContinued)
{
    put_text_into(folder / "bodies.csv", "# s\ntime\n0\n");
    EXPECT_THROW(History(folder, table, 1.0), IoError);
    EXPECT_EQ(text_of(folder / "bodies.csv"), "# s\ntime\n0\n");
}

TEST_F(Histories, ThatWereCutShortAreNotContinued)
{
    const std::string text = "# s,-,m\ntime,body,x\n0,a,1\n1,a,2\n2,a,3\n";
    put_text_into(folder / "bodies.csv", text);
    EXPECT_THROW(History(folder, table, 2.0, 4), IoError);
    EXPECT_THROW(History(folder, table, 1.0, 3), IoError); // the third is of later than the state
    EXPECT_EQ(text_of(folder / "bodies.csv"), text);
    EXPECT_EQ(History(folder, table, 2.0, 3).rows(), 3);
    std::filesystem::remove(folder / "bodies.csv");
    EXPECT_THROW(History(folder, table, 2.0, 1), IoError);
    EXPECT_EQ(History(folder, table, 2.0, 0).rows(), 0);
}

TEST_F(Histories, ChangeTheirColumnsAndLoseNone)
{
    const std::string text = "# s,-,m\ntime,body,x\n0,\"a, b\",1\n1,c,2\n";
    const Table wider{"bodies", {{"time", "s"}, {"y", "Pa"}, {"x", "m"}, {"body", ""}}};
    put_text_into(folder / "bodies.csv", text);
    change_columns(folder, wider);
    EXPECT_EQ(text_of(folder / "bodies.csv"),
              "# s,Pa,m,-\ntime,y,x,body\n0,nan,1,\"a, b\"\n1,nan,2,c\n");
    EXPECT_FALSE(std::filesystem::exists(folder / "bodies_1.csv"));
    const std::string wide = text_of(folder / "bodies.csv");
    change_columns(folder, {"bodies", {{"time", "s"}, {"x", "m"}}});
    EXPECT_EQ(text_of(folder / "bodies.csv"), "# s,m\ntime,x\n0,1\n1,2\n");
    EXPECT_EQ(text_of(folder / "bodies_1.csv"), wide);
    change_columns(folder, {"bodies", {{"time", "s"}, {"x", "m"}}});
    EXPECT_FALSE(std::filesystem::exists(folder / "bodies_2.csv"));
    set_aside(folder, "bodies");
    EXPECT_TRUE(std::filesystem::exists(folder / "bodies_2.csv"));
    EXPECT_FALSE(std::filesystem::exists(folder / "bodies.csv"));
    EXPECT_NO_THROW(change_columns(folder, wider));
    put_text_into(folder / "bodies.csv", "garbage\nmore,garbage\n1,2\n");
    EXPECT_THROW(change_columns(folder, wider), IoError);
}

TEST_F(Histories, OfAMissingFolderAreErrors)
{
    EXPECT_THROW(History(folder / "none", table), IoError);
}

} // namespace
} // namespace hyoryu::test_history
