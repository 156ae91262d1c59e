// SPDX-License-Identifier: MIT
// A case that several processes fill together, against what one fills: scenes drawn at random.
#include "hyoryu/scene/case_file.hpp"
#include "hyoryu/scene/fill.hpp"
#include "hyoryu/scene/plan.hpp"
#include "hyoryu/scene/wall_layers.hpp"

#include "dice.hpp"
#include "thread_ranks.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>

namespace hyoryu::test_fill_by_range {
namespace {

namespace fs = std::filesystem;

// All numbers of a particle.
using Numbers = std::vector<double>;

void add(Numbers& numbers, const Vec3& v)
{
    numbers.insert(numbers.end(), {v.x(), v.y(), v.z()});
}

std::map<std::int64_t, Numbers> fluid_of(const Filling& filling)
{
    std::map<std::int64_t, Numbers> all;
    for (std::size_t k = 0; k < filling.fluid.size(); ++k) {
        Numbers& of = all[filling.number_of_fluid(k)];
        add(of, filling.fluid[k]);
        of.push_back(filling.fluid_depth[k]);
        of.push_back(filling.fluid_cut[k]);
        if (!filling.fluid_velocity.empty()) {
            add(of, filling.fluid_velocity[k]);
        }
        if (!filling.fluid_pressure.empty()) {
            of.push_back(filling.fluid_pressure[k]);
        }
    }
    return all;
}

std::map<std::int64_t, Numbers> walls_of(const Filling& filling)
{
    std::map<std::int64_t, Numbers> all;
    for (std::size_t k = 0; k < filling.wall.size(); ++k) {
        Numbers& of = all[filling.number_of_wall(k)];
        add(of, filling.wall[k]);
        of.push_back(filling.wall_owner[k]);
        if (!filling.wall_depth.empty()) {
            of.push_back(filling.wall_depth[k]);
        }
    }
    return all;
}

// The walls that a run makes again from the runs of places.
std::vector<Numbers> made_again(const Scene& scene, const Filling& filling)
{
    std::vector<SolidSurface> surfaces;
    for (const Wall& wall : scene.walls) {
        surfaces.push_back(surface_of(
            wall, wall_layers(scene.fluid->smoothing_ratio) * scene.spacing, scene.dimensions));
    }
    const WallMaker make = wall_maker(scene, filling, surfaces, 2);
    std::vector<Numbers> all;
    for (Index k = 0; k < filling.wall_count(); ++k) {
        const WallPoint point = make(static_cast<std::int32_t>(k));
        add(all.emplace_back(), point.place);
        all.back().push_back(point.owner);
        all.back().push_back(point.depth);
        all.back().push_back(point.displaced_mass);
    }
    return all;
}

// What a plan says, without what is compared elsewhere.
std::string texts_of(const Plan& plan)
{
    std::string text =
        fmt::format("{} {} {} {} {} {}\n", plan.counts.fluid, plan.counts.wall, plan.counts.body,
                    plan.first_step, plan.expected_speed, plan.most_fluid);
    for (const Diagnostic& warning : plan.warnings) {
        text += to_string(warning) + "\n";
    }
    if (plan.scale) {
        text += fmt::format("{} {}", plan.scale->depth, plan.scale->reynolds);
    }
    return text;
}

// Of all processes, as each knows them.
std::vector<Index> counts_of(const Filling& filling)
{
    return {filling.fluid_count(), filling.wall_count()};
}

struct Whole {
    std::map<std::int64_t, Numbers> fluid, walls;
    std::vector<Numbers> made;
    std::string plan;
    std::size_t most = 0; // rows of the process that has most
    std::size_t rows = 0; // of all processes: a number that two have counts twice
    std::vector<Index> counts;
    double volume = 0;
};

// Adds what a process has; what all know must be the same on each.
void add(const Scene& scene, const Filling& filling, const Plan& plan, Whole& whole)
{
    whole.fluid.merge(fluid_of(filling));
    whole.walls.merge(walls_of(filling));
    const std::size_t rows = filling.fluid.size() + filling.wall.size();
    whole.rows += rows;
    whole.most = std::max(whole.most, rows);
    const std::vector<Numbers> made = made_again(scene, filling);
    EXPECT_TRUE(whole.made.empty() || whole.made == made);
    EXPECT_TRUE(whole.plan.empty() || whole.plan == texts_of(plan));
    EXPECT_TRUE(whole.counts.empty() || whole.counts == counts_of(filling));
    whole.made = made;
    whole.plan = texts_of(plan);
    whole.counts = counts_of(filling);
    whole.volume = particle_volume(scene, filling);
}

// By one process for 0 ranks.
Whole filled_by(const Scene& scene, int ranks)
{
    Whole whole;
    if (ranks == 0) {
        const Filling filling = fill(scene);
        add(scene, filling, make_plan(scene, filling), whole);
        return whole;
    }
    std::mutex one_at_a_time;
    test_help::on_ranks(ranks, [&](Comm& comm) {
        const Filling filling = fill(scene, {&comm});
        const Plan plan = make_plan(scene, filling, &comm);
        const std::lock_guard lock(one_at_a_time);
        add(scene, filling, plan, whole);
    });
    return whole;
}

void expect_the_same(const Scene& scene, std::span<const int> of_ranks)
{
    const Whole alone = filled_by(scene, 0);
    for (const int ranks : of_ranks) {
        SCOPED_TRACE(fmt::format("{} ranks", ranks));
        const Whole shared = filled_by(scene, ranks);
        EXPECT_TRUE(shared.fluid == alone.fluid)
            << shared.fluid.size() << " for " << alone.fluid.size();
        EXPECT_TRUE(shared.walls == alone.walls)
            << shared.walls.size() << " for " << alone.walls.size();
        EXPECT_TRUE(shared.made == alone.made);
        EXPECT_EQ(shared.plan, alone.plan);
        EXPECT_EQ(shared.rows, alone.rows);
        EXPECT_EQ(shared.counts, alone.counts);
        EXPECT_EQ(shared.volume, alone.volume);
    }
}

// A place, in two dimensions in the section.
std::string place(double x, double y, double z, int dimensions)
{
    return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", x, dimensions == 2 ? 0 : y, z);
}

// Walls that overlap each other, the water and the basin, at any angle.
std::string obstacle(Dice& dice, int dimensions, bool sinks)
{
    const double x = dice.between(0.1, 1.9);
    const double y = dice.between(0, 0.4);
    const double z = dice.between(0, 0.3);
    const double a = dice.between(0.05, 0.4);
    const double b = dice.between(0.05, 0.2);
    const double angle = dice.between(0, 90);
    const std::string turn =
        fmt::format("rotation_deg = {{ axis = [{}, 1, 0], angle = {:.17g} }}\n",
                    dimensions == 2 ? 0 : 1, angle);
    const std::string at =
        fmt::format("position = {}\n", place(x, y, sinks ? z - 0.2 : z, dimensions));
    switch (dice.below(dimensions)) {
    case 0:
        return fmt::format("[[wall]]\nshape = \"box\"\nsize = [{:.17g}, 0.3, {:.17g}]\n", a, b) +
               at + turn;
    case 1:
        return fmt::format("[[wall]]\nshape = \"sphere\"\nradius = {:.17g}\n", b) + at;
    default:
        return fmt::format("[[wall]]\nshape = \"cylinder\"\nradius = {:.17g}\nlength = {:.17g}\n",
                           b, 2 * a) +
               at + turn;
    }
}

// A group of bodies that touch, or one of any turn.
std::string bodies(Dice& dice, int dimensions, int k)
{
    const double x = dice.between(0.3, 1.6);
    const double y = dice.between(0.1, 0.3);
    const double z = dice.between(0.15, 0.55);
    const double a = dice.between(0.06, 0.2);
    const double angle = dice.between(0, 90);
    const bool stacked = dice.chance(0.5);
    std::string text;
    for (int n = 0; n < (stacked ? 3 : 1); ++n) {
        text += fmt::format("[[body]]\nname = \"b{}_{}\"\nshape = \"box\"\ndensity = 500\n"
                            "size = [{:.17g}, 0.12, 0.08]\nposition = {}\n",
                            k, n, a, place(x, y, z + 0.08 * n, dimensions));
        text += stacked ? ""
                        : fmt::format("rotation_deg = {{ axis = [0, 1, 0], angle = {:.17g} }}\n",
                                      angle);
    }
    return text;
}

// Ground that cuts the lattice, obstacles, bodies, blocks of unlike height, fields and windows.
std::string drawn_case(std::uint64_t seed)
{
    Dice dice(seed);
    const int dimensions = dice.chance(0.5) ? 2 : 3;
    constexpr double width = 0.4;
    const double drawn = dimensions == 2 ? dice.between(0.015, 0.04) : dice.between(0.035, 0.06);
    const bool open = dice.chance(0.3);
    const bool periodic = !open && dimensions == 3 && dice.chance(0.3);
    const double dp = periodic ? width / (10 + dice.below(3)) : drawn;
    const char* const walls = dice.chance(0.5) ? "no_slip" : "free_slip";
    const double level = dice.between(0.25, 0.5);
    const double lower = dice.chance(0.5) ? level : dice.between(0.2, level);
    std::string text = fmt::format(
        "title = \"seed {}\"\ndimensions = {}\n[time]\nend = 1\n[particles]\nspacing = {:.17g}\n"
        "[fluid]\nwalls = \"{}\"\n",
        seed, dimensions, dp, walls);
    text += fmt::format("[[fluid.block]]\nshape = \"box\"\nmin = {}\nmax = {}\n",
                        place(0, 0, 0, dimensions), place(1, width, level, dimensions));
    text += dice.chance(0.3) ? "velocity_field = [\"0.1*z\", \"0\", \"x\"]\n" : "";
    text += fmt::format("[[fluid.block]]\nshape = \"box\"\nmin = {}\nmax = {}\n",
                        place(1, 0, 0, dimensions), place(2, width, lower, dimensions));
    text += fmt::format("[domain]\nmin = {}\nmax = {}\n{}", place(0, 0, -0.1, dimensions),
                        place(2, width, 1.2, dimensions), periodic ? "periodic = [\"y\"]\n" : "");
    text += fmt::format("[[wall]]\nshape = \"basin\"\nmin = {}\nmax = {}\nopen = [\"+z\"{}{}]\n",
                        place(0, 0, -0.05, dimensions), place(2, width, 1.2, dimensions),
                        open ? ", \"-x\"" : "", periodic ? ", \"-y\", \"+y\"" : "");
    const int obstacles = dice.below(4);
    for (int k = 0; k < obstacles; ++k) {
        text += obstacle(dice, dimensions, k % 2 == 0);
    }
    if (open) {
        text += fmt::format("[[open]]\nname = \"in\"\nkind = \"absorb\"\nmin = {}\nmax = {}\n",
                            place(0, 0, -0.05, dimensions), place(0, width, 1, dimensions));
        text += "into = \"+x\"\n";
    }
    const int groups = periodic || open ? 0 : dice.below(4);
    for (int k = 0; k < groups; ++k) {
        text += bodies(dice, dimensions, k);
    }
    return text;
}

// HYORYU_DRAWS=200 is the nightly size. A case that the reader or the plan refuses is drawn again.
TEST(FillByRange, ScenesDrawnAtRandomAreFilledAsByOneProcess)
{
    const int draws = number_from("HYORYU_DRAWS", 12);
    const auto first = static_cast<std::uint64_t>(number_from("HYORYU_SEED", 1));
    int done = 0;
    for (std::uint64_t seed = first; done < draws && seed < first + 20 * draws; ++seed) {
        SCOPED_TRACE(fmt::format("seed {}", seed));
        std::optional<Scene> scene;
        try {
            scene = parse_case(drawn_case(seed), "drawn.toml");
            make_plan(*scene, fill(*scene));
        } catch (const CaseError& error) {
            if (std::getenv("HYORYU_TELL") != nullptr) {
                fmt::print("{}: {}\n", seed, error.what());
            }
            continue;
        }
        expect_the_same(*scene, std::array{2, 3, static_cast<int>(4 + seed % 10)});
        ++done;
    }
    EXPECT_EQ(done, draws);
}

// Shares of a large case: none has much more than its part, rank 0 neither. Parts are whole tiles,
// eight spacings wide: the largest holds up to 1.4 times the mean with so few of them.
TEST(FillByRange, NoProcessHasMuchMoreThanItsPart)
{
    for (const double dp : {0.02, 0.015}) {
        const Scene scene = parse_case(
            fmt::format("[time]\nend = 1\n[particles]\nspacing = {}\n[fluid]\n[[fluid.block]]\n"
                        "shape = \"box\"\nmin = [0, 0, 0]\nmax = [1, 0.5, 0.4]\n[[wall]]\n"
                        "shape = \"basin\"\nmin = [0, 0, 0]\nmax = [2, 0.5, 0.8]\n"
                        "open = [\"+z\"]\n",
                        dp),
            "dam.toml");
        const Whole alone = filled_by(scene, 0);
        for (const int ranks : {2, 4, 7}) {
            EXPECT_LT(static_cast<double>(filled_by(scene, ranks).most),
                      1.4 * static_cast<double>(alone.most) / ranks)
                << ranks;
        }
    }
}

// What one process says of a field that is no number somewhere, all say, and none waits for ever.
TEST(FillByRange, AFaultOfAFieldIsThatOfOneProcess)
{
    for (const char* const field : {"pressure_field = \"sqrt(0.7 - x)\"\n",
                                    "velocity_field = [\"1 / sqrt(z - 0.3)\", \"0\", \"0\"]\n"}) {
        const Scene scene =
            parse_case(fmt::format("[time]\nend = 1\n[particles]\nspacing = 0.05\n[fluid]\n"
                                   "[[fluid.block]]\nshape = \"box\"\nmin = [0, 0, 0]\n"
                                   "max = [1, 0.5, 0.4]\n{}",
                                   field),
                       "field.toml");
        const auto told = [&](int ranks) {
            try {
                filled_by(scene, ranks);
            } catch (const CaseError& error) {
                return std::string(error.what());
            }
            return std::string();
        };
        const std::string alone = told(0);
        EXPECT_NE(alone, "");
        for (const int ranks : {2, 3, 7}) {
            EXPECT_EQ(told(ranks), alone) << ranks;
        }
    }
}

// All cases that ship, but those that are too large for this.
TEST(FillByRange, ShippedCasesAreFilledAsByOneProcess)
{
    const bool all = number_from("HYORYU_ALL", 0) != 0;
    const double largest = all ? 1e6 : 2e4;
    int done = 0;
    for (const auto& entry : fs::directory_iterator(fs::path(HYORYU_SOURCE_DIR) / "cases")) {
        const fs::path file = entry.path() / "case.toml";
        if (!fs::exists(file)) {
            continue;
        }
        SCOPED_TRACE(entry.path().filename().string());
        const Scene scene = read_case(file);
        if (!scene.fluid) {
            continue;
        }
        const Filling filling = fill(scene);
        if (static_cast<double>(filling.fluid_count() + filling.wall_count()) > largest) {
            continue;
        }
        expect_the_same(scene, std::array{3, 5});
        ++done;
    }
    EXPECT_GT(done, 20);
}

} // namespace
} // namespace hyoryu::test_fill_by_range
