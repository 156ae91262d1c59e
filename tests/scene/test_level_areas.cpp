// SPDX-License-Identifier: MIT
// Level areas of a terrain: quays and yards that a grid smears.
#include "building_files.hpp"

#include <algorithm>

namespace hyoryu::test_level_areas {
namespace {

std::string quay_of(const SlopingGround& plane, const std::string& keys)
{
    const std::string ball = "[[body]]\nshape = \"sphere\"\nradius = 1\ndensity = 500\nposition = "
                             "[0, 0, 90]\n";
    return fmt::format("[time]\nend = 1\n[particles]\nspacing = 0.5\n{}[[wall.level]]\n{}\n{}",
                       terrain_of(plane), keys, ball);
}

// A quay in the map and the same one in the axes of the case are the same ground, also resolved.
TEST_F(BuildingFiles, AQuayIsLevelInAnyMap)
{
    Dice dice(25);
    for (int k = 0; k < 20; ++k) {
        const SlopingGround plane = draw_plane(dice);
        const double z = dice.between(-9, 9);
        const auto ring =
            star(dice, plane.origin + Complex{dice.between(-9, 9), dice.between(-9, 9)}, 12, 30);
        write("g.asc", grid_of(plane));
        write("quay.geojson", feature("{}", listed(text_of(ring))));
        const Scene scene =
            read(quay_of(plane, fmt::format("polygon = \"quay.geojson\"\nz = {}", z)));
        int level = 0;
        for (const Vec3& p : mesh_of(scene.walls[0]).corners) {
            const Complex map =
                plane.origin + Complex(p.x(), p.y()) * std::polar(1.0, (90 - plane.azimuth_deg) *
                                                                           std::numbers::pi / 180);
            double turns = 0; // the angle by which the ring goes round the place
            for (std::size_t c = 0; c < ring.size(); ++c) {
                turns += std::arg((ring[(c + 1) % ring.size()] - map) / (ring[c] - map));
            }
            const bool inside = std::abs(turns) > 3;
            if (inside && p.z() > mesh_of(scene.walls[0]).terrain->bottom) {
                EXPECT_EQ(p.z(), z);
                ++level;
            } else if (p.z() > mesh_of(scene.walls[0]).terrain->bottom) {
                EXPECT_NEAR(p.z(), plane.height(map) + plane.datum, 2) << "means at the rim";
            }
        }
        EXPECT_GT(level, 4) << k;
        fs::remove(folder_ / "quay.geojson");
        const std::string resolved = to_toml(scene);
        const Scene again = read(resolved);
        EXPECT_EQ(to_toml(again), resolved);
        EXPECT_EQ(mesh_of(again.walls[0]).corners, mesh_of(scene.walls[0]).corners);
    }
}

TEST_F(BuildingFiles, MistakesOfLevelAreasAreTold)
{
    const SlopingGround plane{{4e5, 4e6}, 90, 0, 0, 0};
    write("g.asc", grid_of(plane));
    const auto told = [&](const std::string& keys) { return fault(quay_of(plane, keys)); };
    const std::string corners = "corners = [[0, 0, 0], [20, 0, 0], [20, 20, 0], [0, 20, 0]]\n";
    EXPECT_EQ(told(corners + "z = 1.8"), "none");
    const std::vector<std::array<std::string, 2>> mistakes = {
        {corners, "z`: is missing"},
        {"z = 1.8", "give `polygon` or `corners`"},
        {corners + "polygon = \"quay.geojson\"\nz = 1.8", "not both"},
        {"polygon = \"none.geojson\"\nz = 1.8", "does not exist"},
        {"polygon = \"\"\nz = 1.8", "is empty"},
        {"polygon = \".\"\nz = 1.8", "is a folder"},
        {"corners = [[0, 0, 0], [20, 20, 0], [20, 0, 0], [0, 20, 0]]\nz = 1.8", "crosses itself"},
        {"corners = [[0, 0, 0], [20, 20, 0]]\nz = 1.8", "corners"},
        {"corners = [[1, 1, 0], [2, 1, 0], [2, 2, 0]]\nz = 1.8",
         "contains no point of the surface"},
        {corners + "z = nan", "not a finite number"}};
    for (const auto& [keys, expected] : mistakes) {
        EXPECT_NE(told(keys).find(expected), std::string::npos) << keys << "\n" << told(keys);
        EXPECT_EQ(told(keys).find("degrees"), std::string::npos) << told(keys);
    }
    write("quay.geojson", feature("{}", "[[[140, 38], [140.1, 38], [140, 38.1]]]"));
    EXPECT_NE(told("polygon = \"quay.geojson\"\nz = 1.8").find("look like degrees"),
              std::string::npos);
    EXPECT_NE(fault(case_of("[[wall]]\nshape = \"plane\"\n[[wall.level]]\nz = 1.0\n", "height = 5"))
                  .find("has no meaning with shape = \"plane\""),
              std::string::npos);
}

} // namespace
} // namespace hyoryu::test_level_areas
