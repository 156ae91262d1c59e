// SPDX-License-Identifier: MIT
// Units: values, dimensions, and texts that are none.
#include "../../src/scene/case/units.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace hyoryu::test_units {

TEST(Units, ValuesAreExactWhereDecimalsAre)
{
    EXPECT_EQ(parse_quantity("10 cm", "m").value, 0.1);
    EXPECT_EQ(parse_quantity("35cm", "m").value, 0.35);
    EXPECT_EQ(parse_quantity("998 kg/m3", "kg/m3").value, 998);
    EXPECT_EQ(parse_quantity("0.998 g/cm^3", "kg/m3").value, 998);
    EXPECT_EQ(parse_quantity("2 h", "s").value, 7200);
    EXPECT_EQ(parse_quantity("1e-6 m2/s", "m2/s").value, 1e-6);
    EXPECT_EQ(parse_quantity("1 mm²/s", "m2/s").value, 1e-6);
    EXPECT_EQ(parse_quantity("9.81 m s^-2", "m/s2").value, 9.81);
    EXPECT_EQ(parse_quantity("+2.4 MN/m", "N/m").value, 2.4e6);
    EXPECT_EQ(parse_quantity("3 N s/m", "kg/s").value, 3);
    EXPECT_EQ(parse_quantity("36 km/h", "m/s").value, 10);
    EXPECT_EQ(parse_quantity("1 ft", "m").value, 0.3048);
    EXPECT_EQ(parse_quantity("30 deg", "deg").value, 30);
    EXPECT_NEAR(parse_quantity("1 rad", "deg").value, 180 / std::numbers::pi, 1e-13);
    EXPECT_NEAR(parse_quantity("90 deg/s", "rad/s").value, std::numbers::pi / 2, 1e-15);
    EXPECT_EQ(parse_quantity("1/s kg", "kg/s").fault.empty(), true);
}

TEST(Units, DimensionsAreChecked)
{
    EXPECT_NE(parse_quantity("3 s", "m").fault.find("has another dimension"), std::string::npos);
    EXPECT_NE(parse_quantity("3 m2", "m").fault.find("has another dimension"), std::string::npos);
    EXPECT_NE(parse_quantity("3 1/s", "rad/s").fault.find("has another dimension"),
              std::string::npos);
}

TEST(Units, NonsenseIsRefused)
{
    for (const char* text : {"", " ", "m", "abc", "nan m", "inf m", "1e999 m", "+-1 m", "- m"}) {
        EXPECT_NE(parse_quantity(text, "m").fault.find("expected a number"), std::string::npos)
            << text;
    }
    for (const char* text : {"1 xx", "1 m//s", "1 m^", "1 m^99", "1 m^-2147483648", "1 m^0", "1 m(",
                             "1 /s/", "1 5", "1 m..s"}) {
        EXPECT_NE(parse_quantity(text, "m").fault.find("unknown unit"), std::string::npos) << text;
    }
    EXPECT_NE(parse_quantity("12 ", "m").fault.find("no unit"), std::string::npos);
    EXPECT_FALSE(parse_quantity("1 " + std::string(100000, 'm'), "m").fault.empty());
}

} // namespace hyoryu::test_units
