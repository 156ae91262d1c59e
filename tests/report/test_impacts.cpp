// SPDX-License-Identifier: MIT
#include "dice.hpp"
#include "hyoryu/core/error.hpp"
#include "hyoryu/report/impacts.hpp"
#include "io/results_fixture.hpp"

#include <cmath>
#include <limits>

namespace hyoryu::test_impacts {
namespace {

using test_help::put_text_into;

constexpr const char* contacts_text =
    "# s,-,-,m,m,m,-,-,-,m/s,N s,N s,N s,N s,J,kg,-\n"
    "time,a,b,x,y,z,nx,ny,nz,approach_speed,normal_impulse,tangential_impulse_x,"
    "tangential_impulse_y,tangential_impulse_z,energy_lost,effective_mass,kind\n"
    "0.5,log,house,0,0,0,1,0,0,3,12,0,0,0,7,4,impact\n"
    "0.6,log,floor,0,0,0,0,0,1,0,90,0,0,0,3,9,resting\n"
    "0.7,log,crate,0,0,0,1,0,0,2,6,0,0,0,1,4,impact\n"
    "0.8,crate,house,0,0,0,1,0,0,1,20,0,0,0,2,25,impact\n";

class Impacts : public test_help::ResultsTest {
protected:
    std::vector<Impact> read(const DeclaredContact& declared, const char* text = contacts_text)
    {
        put_text_into(folder / "contacts.csv", text);
        return read_contacts(read_csv(folder / "contacts.csv"), declared);
    }
};

// A case without materials, so that every pair has one law.
DeclaredContact one_law(double stiffness, double restitution)
{
    DeclaredContact declared{.of_pairs = {{{"", ""}, {stiffness, restitution}}}};
    for (const char* name : {"log", "crate", "house", "floor", "cube"}) {
        declared.materials[name] = "";
    }
    return declared;
}

constexpr double undeclared = std::numeric_limits<double>::quiet_NaN();

TEST_F(Impacts, RowsAreReadWithTheirKind)
{
    const std::vector<Impact> rows = read({});
    ASSERT_EQ(rows.size(), 4U);
    EXPECT_EQ(rows[0].body, "log");
    EXPECT_EQ(rows[0].other, "house");
    EXPECT_EQ(rows[0].time, 0.5);
    EXPECT_EQ(rows[0].speed, 3);
    EXPECT_EQ(rows[0].impulse, 12);
    EXPECT_EQ(rows[0].energy_lost, 7);
    EXPECT_EQ(rows[0].mass, 4);
    EXPECT_EQ(rows[1].kind, Impact::Kind::resting);
    EXPECT_TRUE(std::isnan(rows[0].law.stiffness));
}

TEST_F(Impacts, PeakForceIsThatOfASpring)
{
    // 12 N s at 3 m/s with e = 0 is 4 kg: 3 m/s sqrt(2.5e5 N/m * 4 kg) = 3000 N.
    const std::vector<Blow> blows = blows_of(read(one_law(2.5e5, 0)));
    ASSERT_EQ(blows.size(), 3U);
    EXPECT_DOUBLE_EQ(blows[0].mass, 4);
    EXPECT_DOUBLE_EQ(peak_force(blows[0]), 3000);
    EXPECT_TRUE(std::isnan(peak_force(blows_of(read({}))[0])));
}

TEST_F(Impacts, LawsAreThoseOfTheMaterials)
{
    const DeclaredContact declared{
        .of_pairs = {{{"pine", "concrete"}, {1e6, 0.4}}, {{"concrete", "pine"}, {1e6, 0.4}}},
        .materials = {{"log", "pine"}, {"crate", "steel"}, {"house", "concrete"}}};
    const std::vector<Impact> rows = read(declared);
    EXPECT_EQ(rows[0].law.stiffness, 1e6);
    EXPECT_EQ(rows[0].law.restitution, 0.4);
    EXPECT_TRUE(std::isnan(rows[2].law.stiffness));
    EXPECT_TRUE(std::isnan(rows[3].law.restitution));
}

TEST_F(Impacts, E12BlowsAndRestingContactAreGroupedByWhatWasHit)
{
    const std::vector<ContactGroup> groups = by_structure(read({}), {"floor", "house"});
    ASSERT_EQ(groups.size(), 3U);
    EXPECT_EQ(groups[0].structure, "floor");
    EXPECT_TRUE(groups[0].blows.empty());
    EXPECT_EQ(groups[0].resting.impulse, 90);
    EXPECT_EQ(groups[0].resting.energy_lost, 3);
    EXPECT_EQ(groups[1].blows.size(), 2U);
    EXPECT_EQ(groups[1].resting.impulse, 0);
    EXPECT_EQ(groups[2].structure, "");
    ASSERT_EQ(groups[2].blows.size(), 1U);
    EXPECT_EQ(groups[2].blows[0].other, "crate");
}

TEST_F(Impacts, TheLargestKeepTheOrderOfTime)
{
    const std::vector<Blow> two = largest(blows_of(read({})), 2);
    ASSERT_EQ(two.size(), 2U);
    EXPECT_EQ(two[0].impulse, 12);
    EXPECT_EQ(two[1].impulse, 20);
}

// A row of a cube of 8 kg on a flat floor.
Impact corner(double time, const Vec3& point, double speed, double impulse)
{
    return {.time = time,
            .body = "cube",
            .other = "floor",
            .point = point,
            .normal = Vec3::UnitZ(),
            .speed = speed,
            .impulse = impulse,
            .mass = 3.2,
            .law = {undeclared, 0.4}};
}

TEST_F(Impacts, E12FourCornersAreOneBlowOfTheWholeMass)
{
    // 8 kg at 0.6 m/s with e = 0.4: J = 1.4 * 8 * 0.6, a quarter a corner.
    const double J = 1.4 * 8 * 0.6;
    std::vector<Impact> rows;
    for (const double x : {-0.1, 0.1}) {
        for (const double y : {-0.1, 0.1}) {
            rows.push_back(corner(0.06, {x, y, 0}, 0.6, J / 4));
        }
    }
    const std::vector<Blow> blows = blows_of(rows);
    ASSERT_EQ(blows.size(), 1U);
    EXPECT_EQ(blows[0].points, 4U);
    EXPECT_NEAR(blows[0].impulse, J, 1e-12 * J);
    EXPECT_NEAR(blows[0].mass, 8, 1e-12 * 8);
    EXPECT_NEAR(blows[0].speed, 0.6, 1e-12);
    EXPECT_LT(blows[0].place.norm(), 1e-15);
}

TEST_F(Impacts, E12ImpulsesOfABlowAddUpAsVectors)
{
    // Against two faces of a corner at once: 3 N s along x and 4 N s along z are 5 N s; friction of
    // 12 N s along y makes them 13.
    std::vector<Impact> rows{corner(0, Vec3::Zero(), 1, 3), corner(0, Vec3::Zero(), 1, 4)};
    rows[0].normal = Vec3::UnitX();
    EXPECT_DOUBLE_EQ(blows_of(rows).at(0).impulse, 5);
    rows[1].tangential = {0, 12, 0};
    EXPECT_DOUBLE_EQ(blows_of(rows).at(0).impulse, 13);
    EXPECT_DOUBLE_EQ(blows_of(rows).at(0).mass, 5 / 1.4); // friction is no mass
}

TEST_F(Impacts, E12ABlowLastsAsLongAsItsSpring)
{
    // 3.2 kg on 3.2e6 N/m: 2 ms; without stiffness 10 ms.
    std::vector<Impact> rows;
    for (const double time : {0.0, 0.0019, 0.0021, 0.0099, 0.0101}) {
        rows.push_back(corner(time, Vec3::Zero(), 1, 1));
    }
    ASSERT_EQ(blows_of(rows).size(), 2U);
    EXPECT_EQ(blows_of(rows)[0].points, 4U);
    for (Impact& row : rows) {
        row.law.stiffness = 3.2e6;
    }
    const std::vector<Blow> blows = blows_of(rows);
    ASSERT_EQ(blows.size(), 3U);
    EXPECT_EQ(blows[0].points, 2U);
    EXPECT_EQ(blows[1].time, 0.0021);
    EXPECT_EQ(blows[2].points, 2U);
}

TEST_F(Impacts, E12TwoBodiesWithinOneBlowAreTwo)
{
    std::vector<Impact> rows{corner(0, Vec3::Zero(), 1, 1), corner(0.001, Vec3::Zero(), 1, 1)};
    rows[1].body = "crate";
    EXPECT_EQ(blows_of(rows).size(), 2U);
}

TEST_F(Impacts, E12ABlowOfAnyMassIsFoundAgainFromItsCorners)
{
    // J = (1 + e) m u, parted among points at random, in random order: the blow has J, u and m.
    Dice dice(12);
    for (int scene = 0; scene < 200; ++scene) {
        const double m = dice.between(0.1, 1e4), u = dice.between(0.01, 20);
        const double e = dice.between(0, 1), J = (1 + e) * m * u;
        std::vector<Impact> rows;
        double left = J;
        for (int k = 0; k < 16; ++k) {
            const double part = k == 15 ? left : dice.between(0, 0.3) * left;
            left -= part;
            rows.push_back(corner(1.0, {dice.between(-1, 1), 0, 0}, u, part));
            rows.back().law = {undeclared, e};
        }
        rows.push_back(corner(1.005, Vec3::Zero(), u / 100, 0)); // grazes once more
        const std::vector<Blow> blows = blows_of(rows);
        ASSERT_EQ(blows.size(), 1U);
        EXPECT_NEAR(blows[0].impulse, J, 1e-12 * J); // round-off of 16 sums
        EXPECT_NEAR(blows[0].mass, m, 1e-12 * m);
        EXPECT_NEAR(blows[0].speed, u, 1e-12 * u);
    }
}

TEST_F(Impacts, AMissingColumnIsTold)
{
    put_text_into(folder / "contacts.csv", "time,a,b\n0,log,house\n");
    EXPECT_THROW(read_contacts(read_csv(folder / "contacts.csv"), {}), IoError);
}

TEST_F(Impacts, UnitsAreReadFromTheLineAboveTheNames)
{
    put_text_into(folder / "a.csv", "# of hand\n# s,-\ntime,body\n0,log\n");
    const CsvTable table = read_csv(folder / "a.csv");
    EXPECT_EQ(table.columns[0].unit, "s");
    EXPECT_EQ(table.columns[1].unit, "");
}

} // namespace
} // namespace hyoryu::test_impacts
