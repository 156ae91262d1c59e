// SPDX-License-Identifier: MIT
// Expressions of numbers and of columns.
#include "hyoryu/assess/formula.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hyoryu::test_formula {
namespace {

std::string fault_of(const auto& call)
{
    try {
        call();
    } catch (const FormulaError& fault) {
        return fault.what();
    }
    return "";
}

TEST(Formula, KnowsArithmeticAndFunctions)
{
    const Scope scope{.numbers = {{"g", 9.81}, {"h", 0.1}}, .columns = {}};
    EXPECT_DOUBLE_EQ(evaluate("sqrt(2*g*h)", scope), std::sqrt(2 * 9.81 * 0.1));
    EXPECT_DOUBLE_EQ(evaluate("-2^2 + floor(-0.5)", {}), -5.0);
    EXPECT_DOUBLE_EQ(evaluate("h < 1 ? rad(180) : 0", scope), std::acos(-1.0));
    EXPECT_DOUBLE_EQ(evaluate("atan2(1, -1)", {}), std::atan2(1.0, -1.0));
    EXPECT_EQ(evaluate("1e-5", {}), 1e-5);
}

TEST(Formula, ColumnsAreEvaluatedRowByRowAndBuildOnEachOther)
{
    const CsvTable table{.columns = {{"time", {0, 1, 2}, {}}, {"x", {1, 2, 4}, {}}}, .rows = 3};
    const Scope scope{.numbers = {{"a", 10}}, .columns = {{"y", "a*x"}, {"z", "y + t"}}};
    EXPECT_EQ(evaluate("z", scope, table), (std::vector<double>{10, 21, 42}));
    EXPECT_EQ(evaluate("a", scope, table), (std::vector<double>{10, 10, 10}));
}

TEST(Formula, SaysWhatIsWrong)
{
    const CsvTable table{.columns = {{"velocity", {1}, {}}, {"body", {NAN}, {"timber"}}},
                         .rows = 1};
    const Scope circle{.numbers = {}, .columns = {{"p", "q"}, {"q", "p"}}};
    EXPECT_NE(fault_of([] { evaluate("1 +", {}); }).find("not an expression"), std::string::npos);
    EXPECT_NE(fault_of([&] { evaluate("velocty", {}, table); }).find("did you mean \"velocity\""),
              std::string::npos);
    EXPECT_NE(fault_of([&] { evaluate("body", {}, table); }).find("contains text"),
              std::string::npos);
    EXPECT_NE(fault_of([&] { evaluate("p", circle, table); }).find("itself"), std::string::npos);
}

} // namespace
} // namespace hyoryu::test_formula
