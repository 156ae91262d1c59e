// SPDX-License-Identifier: MIT
// Buildings from footprints: drawn at random on grounds drawn at random, in maps drawn at random.
#include "building_files.hpp"

#include "hyoryu/geometry/outline.hpp"
#include "hyoryu/scene/fill.hpp"
#include "hyoryu/scene/plan.hpp"

#include <algorithm>

#include <sys/stat.h>

namespace hyoryu::test_buildings {
namespace {

TEST_F(BuildingFiles, StandOnTheGroundInAnyMap)
{
    Dice dice(21);
    for (int k = 0; k < 40; ++k) {
        const SlopingGround plane = draw_plane(dice);
        const double spacing = k % 2 == 0 ? 0.5 : 0.3;
        const double height = dice.between(2, 30);
        const Complex middle = plane.origin + Complex{dice.between(-20, 20), dice.between(-20, 20)};
        const bool has_yard = k % 3 == 0;
        const auto outer = star(dice, middle, has_yard ? 9.8 : 4, 10);
        const auto inner = star(dice, middle, 0.5, 2);
        const bool wide = outer.size() > 6; // a triangle of that radius may cut the yard
        write("g.asc", grid_of(plane));
        write("b.geojson", feature(fmt::format("{{\"h\": {}, \"id\": {}}}", height, k),
                                   fmt::format("[{}{}]", text_of(outer),
                                               has_yard && wide ? ", " + text_of(inner) : "")));
        const Scene scene = read(case_of(terrain_of(plane),
                                         "height = \"h\"\nname = \"id\"\n"
                                         "material = \"concrete\"",
                                         spacing));
        ASSERT_EQ(scene.walls.size(), 2u);
        const Wall& wall = scene.walls[1];
        EXPECT_EQ(wall.name, std::to_string(k));
        EXPECT_EQ(wall.material, "concrete");
        const MeshShape& mesh = mesh_of(wall);
        ASSERT_TRUE(mesh.prism);
        double lowest = 1e300;
        double area = 0;
        for (std::size_t c = 0; c < outer.size(); ++c) {
            lowest = std::min(lowest, plane.height(outer[c]) + plane.datum);
            area +=
                (std::conj(outer[c] - middle) * (outer[(c + 1) % outer.size()] - middle)).imag() /
                2;
            const Complex at = plane.in_case(outer[c]);
            EXPECT_TRUE(std::ranges::any_of(mesh.corners, [&](const Vec3& p) {
                return std::abs(Complex(p.x(), p.y()) - at) < 1e-6; // UTM coordinates in doubles
            }));
        }
        for (std::size_t c = 0; has_yard && wide && c < inner.size(); ++c) {
            area -=
                (std::conj(inner[c] - middle) * (inner[(c + 1) % inner.size()] - middle)).imag() /
                2;
        }
        EXPECT_NEAR(mesh.prism->bottom, lowest - 3 * spacing, 1e-6) << k;
        EXPECT_NEAR(mesh.prism->top, lowest + height, 1e-6) << k;
        EXPECT_NEAR(solid_properties({mesh.corners, mesh.triangles}).volume,
                    area * (height + 3 * spacing), 1e-6 * area * height);
        EXPECT_TRUE(scene.notices.empty());
    }
}

TEST_F(BuildingFiles, AResolvedCaseHoldsThemWithoutTheirFile)
{
    Dice dice(22);
    for (int k = 0; k < 10; ++k) {
        const SlopingGround plane = draw_plane(dice);
        write("g.asc", grid_of(plane));
        const std::string outer = text_of(star(dice, plane.origin, 9.9, 10));
        const std::string inner = text_of(star(dice, plane.origin, 0.5, 2));
        const std::string other = text_of(star(dice, plane.origin + 30.0, 2, 9));
        write("b.geojson", collection({feature("{}", fmt::format("[{}, {}]", outer, inner)),
                                       feature("{}", listed(other))}));
        const Scene scene = read(case_of(terrain_of(plane), "height = 7.5"));
        const std::string resolved = to_toml(scene);
        fs::remove(folder_ / "b.geojson");
        const Scene again = read(resolved);
        EXPECT_EQ(to_toml(again), resolved);
        ASSERT_EQ(again.walls.size(), 3u);
        for (std::size_t w = 1; w < 3; ++w) {
            EXPECT_EQ(scene.walls[w].name, fmt::format("building.{}", w));
            EXPECT_EQ(mesh_of(again.walls[w]).triangles, mesh_of(scene.walls[w]).triangles);
            EXPECT_EQ(mesh_of(again.walls[w]).corners, mesh_of(scene.walls[w]).corners);
        }
    }
}

TEST_F(BuildingFiles, PartsOfAFeatureAreNumbered)
{
    const std::string two = "[[[[0, 0], [4, 0], [4, 4], [0, 4], [0, 0]]], [[[9, 0], [12, 0], [12, "
                            "4], [9, 0]]]]";
    write("b.geojson",
          collection({feature("{\"n\": \"Town hall\", \"h\": \"12.5\"}", two, "MultiPolygon"),
                      feature("{}", "[3, 4]", "Point"),
                      "{\"type\": \"Feature\", \"geometry\": null}"}));
    const Scene scene = read(case_of(flat, "height = \"h\"\nname = \"n\""));
    ASSERT_EQ(scene.walls.size(), 3u);
    EXPECT_EQ(scene.walls[1].name, "Town hall.1");
    EXPECT_EQ(scene.walls[2].name, "Town hall.2");
    EXPECT_EQ(mesh_of(scene.walls[1]).prism->top, 12.5);
    EXPECT_EQ(read(case_of(flat, "height = \"3 m\"")).walls[2].name, "building.2");
}

TEST_F(BuildingFiles, WhatIsLeftOutOrOverlapsIsTold)
{
    Dice dice(23);
    const SlopingGround plane{{4e5, 4e6}, 90, 0, 0, 0};
    const auto box = [&](double x, double y) {
        const Complex p = plane.origin + Complex(x, y);
        return feature("{}", listed(text_of({p, p + 4.0, p + Complex(4, 4), p + Complex(0, 4)})));
    };
    write("g.asc", grid_of(plane));
    write("b.geojson", collection({box(0, 0), box(400, 0), box(4, 0), box(2, 2), box(-30, -30)}));
    const Scene scene = read(case_of(terrain_of(plane), "height = 5"));
    ASSERT_EQ(scene.walls.size(), 5u);
    EXPECT_EQ(scene.walls[2].name, "building.3"); // numbers are those of the file
    ASSERT_EQ(scene.notices.size(), 2u);
    EXPECT_NE(scene.notices[0].what.find("1 of 5 footprints lie outside"), std::string::npos);
    EXPECT_NE(scene.notices[1].what.find("2 pairs of buildings overlap, first \"building.1\" and "
                                         "\"building.4\" by 4 m2"),
              std::string::npos)
        << scene.notices[1].what;
    const Plan plan = make_plan(scene, fill(scene));
    EXPECT_GE(plan.warnings.size(), 2u);
}

// The terrain ends 60 m from the origin.
TEST_F(BuildingFiles, ThoseAcrossTheEdgeOfTheTerrainAreToldOf)
{
    Dice dice(29);
    for (int k = 0; k < 8; ++k) {
        const SlopingGround plane = draw_plane(dice);
        const auto building = [&](double x) { // of a radius of 4 m
            const double turn = (90 - plane.azimuth_deg) * std::numbers::pi / 180;
            const Complex middle =
                plane.origin + Complex(x, dice.between(-20, 20)) * std::polar(1.0, turn);
            return feature("{}", listed(text_of({middle + 4.0, middle + Complex(0, 4), middle - 4.0,
                                                 middle - Complex(0, 4)})));
        };
        write("g.asc", grid_of(plane));
        write("b.geojson", collection({building(dice.between(-50, 50)), building(60)}));
        const Scene scene = read(case_of(terrain_of(plane), "height = 5"));
        ASSERT_EQ(scene.notices.size(), 1u);
        EXPECT_NE(scene.notices[0].what.find("\"building.2\" stands only partly on the terrain"),
                  std::string::npos);
    }
}

// Buildings of a model at a small scale are at places that could be degrees, and a few centimetres
// wide; what is narrower than a spacing would be degrees.
TEST_F(BuildingFiles, ModelsOfALaboratoryAreInMetres)
{
    Dice dice(23);
    for (int k = 0; k < 20; ++k) {
        const double spacing = std::pow(10, dice.between(-3, -0.5));
        const Complex middle{dice.between(-90, 90), dice.between(-60, 60)};
        const auto square_of = [&](double half) {
            const Complex low = middle - Complex(half, half);
            const Complex high = middle + Complex(half, half);
            return feature("{}", fmt::format("[[[{0}, {1}], [{2}, {1}], [{2}, {3}], [{0}, {3}]]]",
                                             low.real(), low.imag(), high.real(), high.imag()));
        };
        write("b.geojson", square_of(dice.between(1.1, 4) * spacing));
        EXPECT_EQ(fault(case_of(flat, "height = 5", spacing)), "none");
        write("b.geojson", square_of(std::min(spacing, 0.1) * dice.between(0.01, 0.49)));
        EXPECT_NE(fault(case_of(flat, "height = 5", spacing)).find("look like degrees"),
                  std::string::npos);
    }
}

TEST_F(BuildingFiles, MistakesAreToldWithTheirPlace)
{
    const auto told = [&](const std::string& file, const std::string& keys) {
        write("b.geojson", file);
        return fault(case_of(flat, keys));
    };
    const std::string one = feature("{\"h\": 5, \"id\": \"a\"}", square);
    EXPECT_EQ(told(one, "height = \"h\""), "none");
    const auto ring = [&](const std::string& corners) {
        return feature("{\"h\": 5}", listed(corners));
    };
    const std::vector<std::array<std::string, 3>> mistakes = {
        {one, "height = \"hight\"", "feature 1 has no property \"hight\"; it has \"h\", \"id\""},
        {one, "height = \"h\"\nname = \"nam\"", "no property \"nam\""},
        {one, "height = -3.0", "must be above 0 m"},
        {one, "height = nan", "not a finite number"},
        {one, "height = \"\"", "is empty, expected a number or a name"},
        {one, "height = \"3 kg\"", "kg"},
        {one, "height = true", "expected a number"},
        {one, "name = \"id\"", "height`: is missing"},
        {feature("{\"h\": \"tall\"}", square), "height = \"h\"",
         "\"h\" = \"tall\", expected a height"},
        {feature("{\"h\": null}", square), "height = \"h\"", "\"h\" = null"},
        {feature("{\"h\": 0}", square), "height = \"h\"", "expected a height > 0 m"},
        {feature("{\"h\": \"inf\"}", square), "height = \"h\"", "expected a height"},
        {feature("{\"h\": \"nan\"}", square), "height = \"h\"", "expected a height"},
        {feature("{\"h\": 1e9}", square), "height = \"h\"", "at most"},
        {feature("{\"h\": 1e999}", square), "height = \"h\"", "a number that is too large"},
        {feature("{\"h\": 5, \"id\": [1]}", square), "height = \"h\"\nname = \"id\"",
         "expected a text or a number"},
        {feature("{\"h\": 5, \"id\": \"a;b\"}", square), "height = \"h\"\nname = \"id\"",
         "is not valid"},
        {feature("{\"h\": 5, \"id\": \"ground\"}", square), "height = \"h\"\nname = \"id\"",
         "is used twice"},
        {ring("[[0, 0], [8, 6], [8, 0], [0, 6], [0, 0]]"), "height = \"h\"", "crosses itself"},
        {ring("[[0, 0], [8, 6], [0, 0]]"), "height = \"h\"", "has 2 corners, expected at least 3"},
        {ring("[[0, 0], [8, 0], [8, 6], [0, 6], [0, 0]], [[9, 1], [9, 2], [10, 2], [9, 1]]"),
         "height = \"h\"", "inner ring 1 lies outside"},
        {ring("[[0, 0], [\"x\", 0], [8, 6]]"), "height = \"h\"", "not [x, y]: number 2"},
        {ring("[[140.1, 38.1], [140.1002, 38.1], [140.1002, 38.1001]]"), "height = \"h\"",
         "look like degrees"},
        {ring(""), "height = \"h\"", "polygon without corners"},
        {collection({}), "height = \"h\"", "0 polygons"},
        {feature("{\"h\": 5}", "[3, 4]", "Point"), "height = \"h\"", "0 polygons"},
        {"[[1, 2", "height = \"h\"", "is not valid JSON, see line 1"},
        {std::string(40, '[') + std::string(40, ']'), "height = \"h\"", "levels"},
        {"", "height = \"h\"", "is not valid JSON"}};
    for (const auto& [file, keys, expected] : mistakes) {
        const std::string found = told(file, keys);
        EXPECT_NE(found.find(expected), std::string::npos) << file << "\n" << keys << "\n" << found;
        EXPECT_EQ(found.find("json.exception"), std::string::npos) << found;
        EXPECT_NE(found.find("buildings[0]"), std::string::npos) << found;
    }
    fs::remove(folder_ / "b.geojson");
    EXPECT_NE(fault(case_of(flat, "height = 5")).find("does not exist"), std::string::npos);
    fs::create_directory(folder_ / "b.geojson");
    EXPECT_NE(fault(case_of(flat, "height = 5")).find("is a folder"), std::string::npos);
    fs::remove(folder_ / "b.geojson");
    ASSERT_EQ(::mkfifo((folder_ / "b.geojson").c_str(), 0600), 0);
    EXPECT_NE(fault(case_of(flat, "height = 5")).find("is a pipe"), std::string::npos);
    fs::remove(folder_ / "b.geojson");
    write("b.geojson", one);
    EXPECT_NE(fault(case_of("", "height = 5")).find("has no ground under it"), std::string::npos);
    EXPECT_NE(fault("dimensions = 2\n" + case_of(flat, "height = 5")).find("three dimensions only"),
              std::string::npos);
}

TEST_F(BuildingFiles, HeightsMayBeTextsInMetres)
{
    for (const char* text : {"12.5", "12.5 m", " 12.5m", "1.25e1 m "}) {
        write("b.geojson", feature(fmt::format("{{\"h\": \"{}\"}}", text), square));
        const Scene scene = read(case_of(flat, "height = \"h\""));
        EXPECT_EQ(mesh_of(scene.walls[1]).prism->top, 12.5) << text;
    }
    for (const auto& [text, why] :
         {std::pair("40 ft", "only the unit m may follow"),
          std::pair("12-15", "only the unit m may follow"), std::pair("12,5 m", "decimal point"),
          std::pair("m", "does not begin with a finite number"),
          std::pair("", "does not begin with a finite number"),
          std::pair("-2 m", "expected a height > 0 m")}) {
        write("b.geojson", feature(fmt::format("{{\"h\": \"{}\"}}", text), square));
        const std::string told = fault(case_of(flat, "height = \"h\""));
        EXPECT_NE(told.find(fmt::format("feature 1 has \"h\" = \"{}\"", text)), std::string::npos)
            << told;
        EXPECT_NE(told.find(why), std::string::npos) << told;
    }
}

// Mistakes of a file hide neither each other, nor those of a further file, of debris and of gauges.
TEST_F(BuildingFiles, TheirMistakesAreToldTogether)
{
    const auto at = [](double x) {
        return fmt::format("[[[{0}, 0], [{1}, 0], [{1}, 6], [{0}, 6], [{0}, 0]]]", x, x + 8);
    };
    const std::string crossing = "[[[60, 0], [68, 6], [68, 0], [60, 6], [60, 0]]]";
    const std::string named = feature("{\"h\": 5, \"id\": \"a,b\"}", at(0));
    const std::string tall = feature("{\"h\": \"tall\", \"id\": \"c\"}", at(20));
    const std::string crossed = feature("{\"h\": 5, \"id\": \"d\"}", crossing);
    const std::string more =
        "[[buildings]]\nfile = \"c.geojson\"\nheight = \"h\"\nname = \"id\"\n"
        "[[debris]]\nname = \"box\"\nkind = \"container_20ft\"\narray = { count = [1, 1, 2], "
        "pitch = [9, 9, 0.5], from = [90, 90, 9] }\n[[gauge]]\ntype = \"force\"\non = "
        "\"nothing\"\n";
    const auto told = [&](const std::string& first, const std::string& second) {
        write("b.geojson", first);
        write("c.geojson", second);
        return fault(case_of(flat, "height = \"h\"\nname = \"id\"") + more);
    };
    const std::string all =
        told(collection({named, tall, crossed}), feature("{\"h\": 5, \"id\": \"e;f\"}", at(40)));
    for (const char* part :
         {"\"a,b\" of a building", "\"h\" = \"tall\"", "crosses itself", "\"e;f\" of a building"}) {
        EXPECT_NE(all.find(part), std::string::npos) << part << " is not in\n" << all;
    }
    // A lost building may be what the gauge means; a wrong name is known.
    EXPECT_EQ(all.find("nothing"), std::string::npos) << all;
    const std::string names = told(named, feature("{\"h\": 5, \"id\": \"e\"}", at(40)));
    for (const char* part : {"\"a,b\" of a building", "a stack with a pitch of 0.5 m", "nothing"}) {
        EXPECT_NE(names.find(part), std::string::npos) << part << " is not in\n" << names;
    }
}

TEST_F(BuildingFiles, OtherMapsThanThatOfTheTerrainAreRefused)
{
    const SlopingGround plane{{4e5, 4e6}, 90, 0, 0, 0};
    write("g.asc", grid_of(plane));
    const std::string text = case_of(terrain_of(plane), "height = 5");
    write("b.geojson", feature("{}", "[[[140, 38], [140.1, 38], [140, 38.1]]]"));
    EXPECT_NE(fault(text).find("look like degrees, those of the terrain"), std::string::npos);
    write("b.geojson", feature("{}", "[[[5e5, 4e6], [500010, 4e6], [5e5, 4000010]]]"));
    EXPECT_NE(fault(text).find("none of the 1 footprints lies on the terrain"), std::string::npos);
    EXPECT_NE(fault(text).find("easting 500000, northing 4000000"), std::string::npos);
}

TEST_F(BuildingFiles, PrismsOfTheCaseAreChecked)
{
    const auto told = [&](const std::string& keys) {
        return fault("[time]\nend = 1\n[particles]\nspacing = 0.5\n[[wall]]\nshape = \"prism\"\n" +
                     keys +
                     "\n[[body]]\nshape = \"sphere\"\nradius = 1\ndensity = 500\nposition = "
                     "[0, 0, 90]\n");
    };
    const std::string corners = "corners = [[0, 0, 0], [8, 0, 0], [8, 6, 0]]\n";
    EXPECT_EQ(told(corners + "bottom = -1.0\ntop = 5.0"), "none");
    EXPECT_NE(told(corners + "bottom = 1.0\ntop = 1.0").find("must be above `bottom`"),
              std::string::npos);
    EXPECT_NE(told(corners + "bottom = 1.0").find("wall[0].top`: is missing"), std::string::npos);
    EXPECT_NE(
        told("corners = [[0, 0, 0], [8, 6, 0], [8, 0, 0], [0, 6, 0]]\nbottom = 0.0\ntop = 1.0")
            .find("does not enclose an area"),
        std::string::npos);
    EXPECT_NE(told("corners = [[0, 0, 0], [8, 6, 0]]\nbottom = 0.0\ntop = 1.0").find("corners"),
              std::string::npos);
    EXPECT_NE(told(corners + "bottom = 0.0\ntop = 1.0\nradius = 3.0").find("radius"),
              std::string::npos);
}

// The water about a prism that is a box is the water about the box.
TEST_F(BuildingFiles, ABoxAndItsPrismDisplaceTheSameWater)
{
    Dice dice(24);
    for (const double spacing : {0.25, 0.2}) {
        const double x = dice.between(2, 4);
        const double y = dice.between(1, 2);
        const auto text = [&](const std::string& wall) {
            return fmt::format(
                "[time]\nend = 1\n[particles]\nspacing = {}\n[fluid]\n[[fluid.block]]\n"
                "shape = \"box\"\nmin = [0, 0, 0]\nmax = [6, 4, 1]\n[[wall]]\nshape = "
                "\"basin\"\nmin = [0, 0, 0]\nmax = [6, 4, 3]\nopen = [\"+z\"]\n"
                "[[wall]]\n{}",
                spacing, wall);
        };
        const Filling box = fill(read(text(fmt::format(
            "shape = \"box\"\nmin = [{}, {}, -1]\nmax = [{}, {}, 2]", x, y, x + 1, y + 1))));
        const Filling prism = fill(read(text(
            fmt::format("shape = \"prism\"\nbottom = -1\ntop = 2\ncorners = [[{0}, {1}, 0], [{2}, "
                        "{1}, 0], [{2}, {3}, 0], [{0}, {3}, 0]]",
                        x, y, x + 1, y + 1))));
        ASSERT_EQ(box.fluid.size(), prism.fluid.size());
        double farthest = 0;
        for (std::size_t k = 0; k < box.fluid.size(); ++k) {
            farthest = std::max(farthest, (box.fluid[k] - prism.fluid[k]).norm());
        }
        EXPECT_LT(farthest, 1e-6 * spacing); // the brackets of the filler close to 1e-10
    }
}

// Two footprints that overlap displace the water of their union, and no particles of their walls
// stand in one place.
TEST_F(BuildingFiles, OverlappingOnesAreOneSolidForTheWater)
{
    Dice dice(26);
    for (const double spacing : {0.25, 0.2}) {
        const double x = dice.between(1, 2);
        const double y = dice.between(1, 2);
        const double wide = dice.between(1, 1.5);
        const double shift = dice.between(0.4, 0.8) * wide;
        const auto rectangle = [&](double from, double to) {
            return feature("{}", listed(text_of({{from, y}, {to, y}, {to, y + 1}, {from, y + 1}})));
        };
        const auto filled = [&](const std::vector<std::string>& footprints) {
            write("b.geojson", collection(footprints));
            return fill(read(fmt::format(
                "[time]\nend = 1\n[particles]\nspacing = {}\n[fluid]\n[[fluid.block]]\n"
                "shape = \"box\"\nmin = [0, 0, 0]\nmax = [6, 4, 1]\n[[wall]]\nshape = "
                "\"basin\"\nmin = [0, 0, 0]\nmax = [6, 4, 3]\nopen = [\"+z\"]\n[[buildings]]\n"
                "file = \"b.geojson\"\nheight = 2\n",
                spacing)));
        };
        const Filling one = filled({rectangle(x, x + shift + wide)});
        const Filling two =
            filled({rectangle(x, x + wide), rectangle(x + shift, x + shift + wide)});
        ASSERT_EQ(one.fluid.size(), two.fluid.size());
        double farthest = 0;
        double sum = 0;
        for (std::size_t k = 0; k < one.fluid.size(); ++k) {
            const double distance = (one.fluid[k] - two.fluid[k]).norm();
            farthest = std::max(farthest, distance);
            sum += distance;
        }
        EXPECT_LT(sum, 0.05 * spacing * static_cast<double>(one.fluid.size()));
        EXPECT_LT(farthest, 0.7 * spacing); // where the cells of the two meet
        double nearest = infinity;
        for (std::size_t a = 0; a < two.wall.size(); ++a) {
            for (std::size_t b = 0; b < a; ++b) {
                nearest = std::min(nearest, (two.wall[a] - two.wall[b]).norm());
            }
        }
        EXPECT_GE(nearest, 0.6 * spacing); // below that they are thinned
    }
}

} // namespace
} // namespace hyoryu::test_buildings
