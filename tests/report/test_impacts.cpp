// SPDX-License-Identifier: MIT
#include "hyoryu/core/error.hpp"
#include "hyoryu/report/impacts.hpp"
#include "io/results_fixture.hpp"

#include <cmath>

namespace hyoryu {
namespace {

using testing::put_text_into;

constexpr const char* contacts_text =
    "# s,-,-,m,m,m,-,-,-,m/s,N s,N s,N s,N s,J,kg,-\n"
    "time,a,b,x,y,z,nx,ny,nz,approach_speed,normal_impulse,tangential_impulse_x,"
    "tangential_impulse_y,tangential_impulse_z,energy_lost,effective_mass,kind\n"
    "0.5,log,house,0,0,0,1,0,0,3,12,0,0,0,7,4,impact\n"
    "0.6,log,floor,0,0,0,0,0,1,0,90,0,0,0,0,9,resting\n"
    "0.7,log,crate,0,0,0,1,0,0,2,6,0,0,0,1,4,impact\n"
    "0.8,crate,house,0,0,0,1,0,0,1,20,0,0,0,2,25,impact\n";

class Impacts : public testing::ResultsTest {
protected:
    std::vector<Impact> read(const DeclaredStiffness& declared)
    {
        put_text_into(folder / "contacts.csv", contacts_text);
        return read_impacts(read_csv(folder / "contacts.csv"), declared);
    }
};

TEST_F(Impacts, AreReadWithoutRestingContact)
{
    const std::vector<Impact> impacts = read({});
    ASSERT_EQ(impacts.size(), 3U);
    EXPECT_EQ(impacts[0].body, "log");
    EXPECT_EQ(impacts[0].other, "house");
    EXPECT_EQ(impacts[0].time, 0.5);
    EXPECT_EQ(impacts[0].speed, 3);
    EXPECT_EQ(impacts[0].impulse, 12);
    EXPECT_EQ(impacts[0].energy_lost, 7);
    EXPECT_EQ(impacts[0].mass, 4);
    EXPECT_TRUE(std::isnan(peak_force(impacts[0])));
}

TEST_F(Impacts, PeakForceIsThatOfASpring)
{
    // 3 m/s sqrt(2.5e5 N/m * 4 kg) = 3000 N
    const std::vector<Impact> impacts = read({.all = 2.5e5});
    EXPECT_DOUBLE_EQ(peak_force(impacts[0]), 3000);
    EXPECT_DOUBLE_EQ(peak_force(impacts[2]), 2500);
}

TEST_F(Impacts, StiffnessIsThatOfTheMaterials)
{
    const DeclaredStiffness declared{
        .of_pairs = {{{"pine", "concrete"}, 1e6}, {{"concrete", "pine"}, 1e6}},
        .materials = {{"log", "pine"}, {"crate", "steel"}, {"house", "concrete"}}};
    const std::vector<Impact> impacts = read(declared);
    EXPECT_DOUBLE_EQ(peak_force(impacts[0]), 6000);
    EXPECT_TRUE(std::isnan(peak_force(impacts[1])));
    EXPECT_TRUE(std::isnan(peak_force(impacts[2])));
}

TEST_F(Impacts, AreGroupedByWhatWasHit)
{
    const std::vector<ImpactGroup> groups = by_structure(read({}), {"floor", "house"});
    ASSERT_EQ(groups.size(), 3U);
    EXPECT_EQ(groups[0].structure, "floor");
    EXPECT_TRUE(groups[0].impacts.empty());
    EXPECT_EQ(groups[1].impacts.size(), 2U);
    EXPECT_EQ(groups[2].structure, "");
    ASSERT_EQ(groups[2].impacts.size(), 1U);
    EXPECT_EQ(groups[2].impacts[0].other, "crate");
}

TEST_F(Impacts, TheLargestKeepTheOrderOfTime)
{
    const std::vector<Impact> two = largest(read({}), 2);
    ASSERT_EQ(two.size(), 2U);
    EXPECT_EQ(two[0].impulse, 12);
    EXPECT_EQ(two[1].impulse, 20);
}

TEST_F(Impacts, AMissingColumnIsTold)
{
    put_text_into(folder / "contacts.csv", "time,a,b\n0,log,house\n");
    EXPECT_THROW(read_impacts(read_csv(folder / "contacts.csv"), {}), IoError);
}

TEST_F(Impacts, UnitsAreReadFromTheLineAboveTheNames)
{
    put_text_into(folder / "a.csv", "# of hand\n# s,-\ntime,body\n0,log\n");
    const CsvTable table = read_csv(folder / "a.csv");
    EXPECT_EQ(table.columns[0].unit, "s");
    EXPECT_EQ(table.columns[1].unit, "");
}

} // namespace
} // namespace hyoryu
