// SPDX-License-Identifier: MIT
// The debris library, and the bodies that a case makes of it.
#include "hyoryu/scene/case_file.hpp"
#include "hyoryu/scene/debris.hpp"
#include "hyoryu/scene/shapes.hpp"

#include "hyoryu/core/error.hpp"

#include "dice.hpp"
#include "own_folder.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numbers>

namespace hyoryu::test_debris {
namespace {

Scene read(const std::string& debris, int dimensions = 3, const std::string& ground = {})
{
    const std::string text =
        fmt::format("dimensions = {}\nseed = 7\n[time]\nend = 1\n[particles]\nspacing = 0.5\n"
                    "[[wall]]\nname = \"floor\"\nshape = \"plane\"\npoint = [0, 0, 1.5]\n"
                    "normal = [0, 0, 1]\n{}\n[[debris]]\n{}",
                    dimensions, ground, debris);
    return parse_case(text, "case.toml");
}

std::size_t kind_named(const std::string& name)
{
    const auto kinds = debris_library();
    return static_cast<std::size_t>(std::ranges::find(kinds, name, &DebrisKind::name) -
                                    kinds.begin());
}

std::string fault_of(const std::string& debris)
{
    try {
        read(debris);
    } catch (const CaseError& error) {
        return error.what();
    }
    return {};
}

TEST(Debris, EveryNumberOfTheLibraryHasASourceAndAGrade)
{
    EXPECT_EQ(debris_library().size(), 7U);
    const auto check = [](const DebrisNumber& number) {
        EXPECT_FALSE(number.source.empty()) << number.name;
        EXPECT_TRUE(number.grade == "read" || number.grade == "unverified" ||
                    number.grade == "assumption")
            << number.name;
    };
    for (const DebrisKind& kind : debris_library()) {
        check(kind.size);
        ASSERT_FALSE(kind.masses.empty()) << kind.name;
        std::ranges::for_each(kind.masses, check);
        std::ranges::for_each(kind.stiffness, check);
    }
    EXPECT_NE(describe_debris_library().find("container_20ft"), std::string::npos);
}

// 245 kip/in and the draft of an empty 20-ft box, as the design has them.
TEST(Debris, ContainersHaveTheNumbersOfTheirSources)
{
    const DebrisPiece piece = debris_piece({.kind = kind_named("container_20ft")}, 3);
    EXPECT_DOUBLE_EQ(piece.body.mass, 2270);
    EXPECT_NEAR(piece.body.mass / (1000 * 6.058 * 2.438), 0.1537, 1e-4);
    EXPECT_NEAR(debris_library()[kind_named("container_20ft")].stiffness.at(0).value.at(0),
                245 * 4448.22 / 0.0254, 0.05e6);
}

// Shell and slab by sums over small cells, which share no formula with the library.
TEST(Debris, CargoMovesTheCentreOfMassAndAddsToTheInertia)
{
    for (const double part : {0.2, 0.4, 0.5, 0.8}) {
        const double load = 12000;
        const DebrisPiece piece = debris_piece(
            {.kind = kind_named("container_20ft"), .load = load, .load_height = part}, 3);
        const Vec3 size(6.058, 2.438, 2.591);
        std::vector<std::pair<Vec3, double>> cells;
        constexpr int n = 40;
        const double area = 2 * (size.x() * size.y() + size.y() * size.z() + size.x() * size.z());
        const double thick = 2 * std::min(part, 1 - part) * size.z();
        for (int i = 0; i < n; ++i) {
            for (int j = 0; j < n; ++j) {
                const double u = (i + 0.5) / n - 0.5;
                const double v = (j + 0.5) / n - 0.5;
                for (int axis = 0; axis < 3; ++axis) {
                    const int a = (axis + 1) % 3;
                    const int b = (axis + 2) % 3;
                    Vec3 p = Vec3::Zero();
                    p[a] = u * size[a];
                    p[b] = v * size[b];
                    for (const double side : {-0.5, 0.5}) {
                        p[axis] = side * size[axis];
                        cells.emplace_back(p, 2270 * size[a] * size[b] / area / (n * n));
                    }
                }
                for (int k = 0; k < n; ++k) {
                    const double z = (part - 0.5) * size.z() + ((k + 0.5) / n - 0.5) * thick;
                    cells.emplace_back(Vec3(u * size.x(), v * size.y(), z), load / (n * n * n));
                }
            }
        }
        Vec3 centre = Vec3::Zero();
        for (const auto& [p, m] : cells) {
            centre += m / (2270 + load) * p;
        }
        Vec3 inertia = Vec3::Zero();
        for (const auto& [p, m] : cells) {
            const Vec3 r = p - centre;
            inertia += m * (Vec3::Constant(r.squaredNorm()) - r.cwiseAbs2());
        }
        ASSERT_TRUE(piece.body.centre_of_mass && piece.body.inertia);
        EXPECT_LT((*piece.body.centre_of_mass - centre).norm(), 1e-9);
        // midpoint sums of 40 cells are off by 1/1600
        EXPECT_LT((*piece.body.inertia - inertia).norm(), 2e-3 * inertia.norm());
    }
}

TEST(Debris, StacksRestOnTheGroundInOrderAndReadBackAsBodies)
{
    for (const int dimensions : {2, 3}) {
        const Scene scene =
            read("kind = \"container_20ft\"\nname = \"yard\"\narray = { count = [2, 3, 2], pitch = "
                 "[6.4, 2.8, 2.591], from = [40, 20], on = \"ground\" }\n",
                 dimensions);
        ASSERT_EQ(scene.bodies.size(), dimensions == 2 ? 4U : 12U);
        EXPECT_EQ(scene.bodies[0].name, "yard.1");
        EXPECT_NEAR(scene.bodies[0].position.z(), 1.5 + 1e-3 + 2.591 / 2, 1e-9);
        EXPECT_NEAR(scene.bodies[1].position.z() - scene.bodies[0].position.z(), 2.591, 1e-12);
        const std::string resolved = to_toml(scene);
        EXPECT_EQ(resolved.find("[[debris]]"), std::string::npos);
        EXPECT_EQ(to_toml(parse_case(resolved, "case.toml")), resolved);
    }
}

TEST(Debris, TanksStandUprightOnTheGround)
{
    const Scene scene = read("kind = \"tank\"\nsize = [4, 6]\nload = 20000\narray = { count = [1, "
                             "1, 1], pitch = [0, 0, 0], from = [0, 0], on = \"floor\" }\n");
    const BodySettings& tank = scene.bodies.at(0);
    const double area = 2 * std::numbers::pi * 2 * (6 + 2);
    EXPECT_NEAR(tank.mass, 60 * area + 20000, 1e-6);
    const Bounds box = bounds(placed(tank, 3));
    EXPECT_NEAR(box.min.z(), 1.501, 1e-9);
    EXPECT_NEAR(box.max.z(), 7.501, 1e-9);
    EXPECT_LT(tank.position.z(), 4.501); // the cargo is below the middle
}

TEST(Debris, YardsAreFilledWithoutOverlapTheSameWayForOneSeed)
{
    const std::string yard =
        "kind = \"container_20ft\"\nname = \"yard\"\n[debris.scatter]\ncorners = [[0, 0, 0], [60, "
        "0, 0], [60, 40, 0], [0, 40, 0]]\ncount = 30\ngap = 0.3\n";
    const Scene scene = read(yard);
    ASSERT_EQ(scene.bodies.size(), 30U);
    EXPECT_EQ(to_toml(scene), to_toml(read(yard)));
    // Points over each piece are 0.3 m away from all others.
    for (const BodySettings& body : scene.bodies) {
        const Bounds box = bounds(placed(body, 3));
        EXPECT_GE(box.min.x(), 0);
        EXPECT_LE(box.max.x(), 60);
        for (int i = 0; i <= 20; ++i) {
            for (int j = 0; j <= 8; ++j) {
                const Vec3 own((i / 20.0 - 0.5) * 6.058, (j / 8.0 - 0.5) * 2.438, 0);
                const Vec3 p = body.position + body.rotation * own;
                for (const BodySettings& other : scene.bodies) {
                    if (&other != &body) {
                        EXPECT_GE(signed_distance(placed(other, 3), p), 0.3 - 1e-9);
                    }
                }
            }
        }
    }
}

TEST(Debris, MistakesAreToldWithTheirReason)
{
    const std::string array = "array = { count = [1, 1, 1], pitch = [0, 0, 0], from = [0, 0, 5] }";
    EXPECT_NE(fault_of("kind = \"contaner_20ft\"\n" + array).find("container_20ft"),
              std::string::npos);
    EXPECT_NE(fault_of("kind = \"log\"\nload = 5\n" + array).find("has no interior"),
              std::string::npos);
    EXPECT_NE(fault_of("kind = \"car\"\nstate = \"full\"\n" + array).find("there is \"empty\""),
              std::string::npos);
    EXPECT_NE(fault_of("kind = \"tank\"\n" + array).find("size"), std::string::npos);
    EXPECT_NE(fault_of("kind = \"car\"\n").find("give `array` or `scatter`"), std::string::npos);
    EXPECT_NE(fault_of("kind = \"car\"\narray = { count = [1, 1, 2], pitch = [0, 0, 0.5], from = "
                       "[0, 0], on = \"ground\" }")
                  .find("overlaps"),
              std::string::npos);
    EXPECT_NE(fault_of("kind = \"container_40ft\"\n[debris.scatter]\ncorners = [[0, 0, 0], [20, 0, "
                       "0], [0, 20, 0]]\ncount = 50")
                  .find("has room for"),
              std::string::npos);
    EXPECT_NE(fault_of("kind = \"car\"\n[debris.scatter]\npolygon = \"none.geojson\"\ncount = 2")
                  .find("does not exist"),
              std::string::npos);
}

// The warnings and errors of a text of a case in a folder of its own, with one more file.
std::string fault_beside(const std::string& file, const std::string& content,
                         const std::string& debris, const std::string& ground = {})
{
    const OwnFolder folder;
    folder.put(file, content);
    std::string what;
    try {
        parse_case("[time]\nend = 1\n[particles]\nspacing = 0.5\n[[wall]]\nshape = \"plane\"\n" +
                       ground + "[[debris]]\n" + debris,
                   folder / "case.toml");
    } catch (const CaseError& error) {
        what = error.what();
    }
    return what;
}

TEST(Debris, YardsThatAreNoneAreRefusedInWordsOfOurs)
{
    const std::string yard =
        "kind = \"car\"\n[debris.scatter]\npolygon = \"yard.geojson\"\ncount = 2\n";
    const auto fault = [&](const std::string& polygon) {
        return fault_beside("yard.geojson", polygon, yard);
    };
    const auto of_ring = [](const std::string& ring) {
        return "{\"type\": \"Polygon\", \"coordinates\": " + ring + "}";
    };
    EXPECT_EQ(fault(of_ring("[[[0,0],[60,0],[60,60],[0,60],[0,0]]]")), "");
    const std::vector<std::pair<std::string, std::string>> mistakes = {
        {of_ring("[]"), "a polygon without corners"},
        {of_ring("[[]]"), "a polygon without corners"},
        {of_ring("7"), "\"coordinates\" = 7, expected a list"},
        {of_ring("[[[0,0],[\"a\",0],[1,1]]]"), "a corner that is not [x, y]: number 2"},
        {"{\"type\": \"Polygon\"}", "an object without \"coordinates\""},
        {"[1]", "an object without \"type\""},
        {"{\"type\": \"Polygon\",\n  \"coordinates\": [[[0,0],[NaN",
         "is not valid JSON, see line 2,"},
        {"", "is not valid JSON"},
        {of_ring("[[[0,0],[60,0],[0,0]]]"), "needs three corners"},
        {of_ring("[[[0,0],[60,60],[60,0],[0,60],[0,0]]]"), "crosses itself"}};
    for (const auto& [polygon, told] : mistakes) {
        const std::string found = fault(polygon);
        EXPECT_NE(found.find(told), std::string::npos) << polygon << "\n" << found;
        EXPECT_EQ(found.find("json.exception"), std::string::npos) << found;
        EXPECT_EQ(found.find("error:"), found.rfind("error:")) << "told once: " << found;
    }
}

TEST(Debris, YardsInDegreesAreRefused)
{
    const std::string yard =
        "kind = \"car\"\n[debris.scatter]\npolygon = \"yard.geojson\"\ncount = 2\n";
    const std::string square =
        "{\"type\": \"Polygon\", \"coordinates\": [[[140.1, 38.1], [140.1009, 38.1], [140.1009, "
        "38.1008], [140.1, 38.1]]]}";
    const std::string small = fault_beside("yard.geojson", square, yard);
    EXPECT_NE(small.find("too small for a piece"), std::string::npos) << small;
    EXPECT_NE(small.find("degrees have to be projected"), std::string::npos) << small;
    // A terrain tells that the map is in metres, however large the yard is.
    const std::string large = "{\"type\": \"Polygon\", \"coordinates\": [[[100, 10], [150, 10], "
                              "[150, 60], [100, 10]]]}";
    std::string heights = "ncols 3\nnrows 3\nxllcorner 378400\nyllcorner 4072300\ncellsize 100\n";
    for (int k = 0; k < 9; ++k) {
        heights += k % 3 == 2 ? "0\n" : "0 ";
    }
    const OwnFolder folder;
    const std::string terrain = fmt::format(
        "[[wall]]\nshape = \"terrain\"\nfile = \"{}\"\norigin = [378450.0, 4072310.0]\n",
        folder.put("ground.asc", heights).string());
    const std::string told = fault_beside("yard.geojson", large, yard, terrain);
    EXPECT_NE(told.find("look like degrees"), std::string::npos) << told;
}

TEST(Debris, RowsAlongYThatTwoDimensionsDoNotHaveAreTold)
{
    for (const int rows : {1, 2, 7}) {
        const std::string array = fmt::format(
            "kind = \"car\"\narray = {{ count = [2, {}, 1], pitch = [9, 9, 0], from = [0, 0, 5] }}",
            rows);
        EXPECT_EQ(read(array).bodies.size(), 2U * static_cast<std::size_t>(rows));
        const Scene flat = read(array, 2);
        EXPECT_EQ(flat.bodies.size(), 2U);
        ASSERT_EQ(flat.notices.size(), rows == 1 ? 0U : 1U);
        EXPECT_TRUE(rows == 1 || flat.notices[0].what.find("rows along y") != std::string::npos);
    }
}

TEST(Debris, KeysWithoutMeaningAreRefused)
{
    const std::string array = "array = { count = [1, 1, 1], pitch = [0, 0, 0], from = [0, 0, 5] }";
    EXPECT_NE(fault_of("kind = \"car\"\nload_height = 0.3\n" + array).find("without cargo"),
              std::string::npos);
    EXPECT_EQ(fault_of("kind = \"container_20ft\"\nload = 500\nload_height = 0.3\n" + array), "");
    EXPECT_NE(fault_of("kind = \"car\"\narray = { count = [1, 1, 1], pitch = [0, 0, 0], from = [0, "
                       "0, 5], on = \"ground\" }")
                  .find("has a height, which `on` sets"),
              std::string::npos);
    // A mistake at the table itself names the table and no empty key.
    const std::string none = fault_of("kind = \"car\"\n");
    EXPECT_NE(none.find("`debris[0]`: has no position"), std::string::npos) << none;
    const std::string body = "[[body]]\nshape = \"box\"\nsize = [1, 1, 1]\ndensity = 500\nposition "
                             "= [0, 0, 9]\nfixed = true\n";
    for (const std::string key : {"inertia = [80, 80, 80]", "center_of_mass = [0.1, 0, 0]"}) {
        try {
            read("kind = \"car\"\n" + array, 3, body + key);
            FAIL() << key;
        } catch (const CaseError& error) {
            EXPECT_NE(std::string(error.what()).find("no meaning for a fixed body"),
                      std::string::npos)
                << error.what();
        }
    }
}

// Bodies at random places, of the case or of debris before: no piece lies within the gap of any,
// but under one that hangs higher than a piece.
TEST(Debris, YardsAreFilledBesideTheBodiesThatAreThere)
{
    Dice dice(26);
    for (int n = 0; n < 6; ++n) {
        std::string bodies;
        for (int k = 0; k < 6; ++k) {
            const double size = dice.between(1, 6);
            const double breadth = dice.between(1, 3);
            const Vec3 place{dice.between(5, 35), dice.between(5, 35),
                             1.5 + (k % 2 == 0 ? 1.01 : size / 4)};
            bodies += fmt::format(
                "[[body]]\nname = \"b{}\"\nshape = \"{}\"\n{}\ndensity = 500\nposition = [{}, {}, "
                "{}]\nrotation_deg = {{ axis = [0, 0, 1], angle = {} }}\n",
                k, k % 2 == 0 ? "box" : "sphere",
                k % 2 == 0 ? fmt::format("size = [{}, {}, 2]", size, breadth)
                           : fmt::format("radius = {}", size / 4),
                place.x(), place.y(), place.z(), dice.between(0, 90));
        }
        const double gap = dice.between(0, 1);
        const Scene scene = read(
            fmt::format("kind = \"container_20ft\"\nname = \"yard\"\n[debris.scatter]\ncorners "
                        "= [[0, 0, 0], [40, 0, 0], [40, 40, 0], [0, 40, 0]]\ncount = 12\ngap = "
                        "{}\n[[debris]]\nkind = \"car\"\nname = \"cars\"\n[debris.scatter]\n"
                        "corners = [[0, 0, 0], [40, 0, 0], [40, 40, 0], [0, 40, 0]]\ncount = "
                        "8\ngap = {}\n",
                        gap, gap),
            3, bodies);
        ASSERT_EQ(scene.bodies.size(), 26U);
        for (std::size_t b = 6; b < scene.bodies.size(); ++b) {
            const BodySettings& piece = scene.bodies[b];
            const Bounds own = bounds({.shape = &piece.shape, .dimensions = 3});
            for (int k = 0; k < 9 * 9; ++k) {
                Vec3 p = own.min;
                p.x() += k % 9 / 8.0 * (own.max.x() - own.min.x());
                p.y() += k / 9 / 8.0 * (own.max.y() - own.min.y());
                p.z() = 0;
                const Vec3 place = placed(piece, 3).centre + piece.rotation * p;
                for (std::size_t other = 0; other < b; ++other) {
                    EXPECT_GE(signed_distance(placed(scene.bodies[other], 3), place), gap - 1e-9)
                        << "piece " << b << " and body " << other;
                }
            }
        }
    }
    const std::string bridge = "[[body]]\nshape = \"box\"\nsize = [39, 39, 1]\ndensity = 500\n"
                               "position = [20, 20, 9]\nfixed = true\n";
    EXPECT_EQ(read("kind = \"car\"\n[debris.scatter]\ncorners = [[0, 0, 0], [40, 0, 0], [40, 40, "
                   "0], [0, 40, 0]]\ncount = 20\n",
                   3, bridge)
                  .bodies.size(),
              21U);
}

} // namespace
} // namespace hyoryu::test_debris
