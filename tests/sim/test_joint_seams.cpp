// SPDX-License-Identifier: MIT
// Where a seam between two solids meets the water: held boxes on supports that end before, at or
// beyond their rim, and stacks of boxes, all under water at rest, feel the force of Archimedes.
#include "hyoryu/sim/gauges.hpp"

#include "dice.hpp"
#include "runs.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace hyoryu::test_joint_seams {
namespace {

constexpr double weight = 9810; // of water [N/m3]

struct Box {
    Vec3 low{0, 0, 0}, high{0, 0, 0}; // [m]

    Vec3 size() const { return high - low; }
};

// Boxes under 3 to 5 spacings of water in a tank that leaves 8 spacings and more beside them; the
// lowest is a wall where `on_wall` says so.
struct Pile {
    double spacing = 0.02;
    std::vector<Box> boxes;
    bool on_wall = false;
    bool sealed = false;
    bool round = false; // the wall is the disc that touches the middle of the box above it
    double above = 4;   // spacings of water

    std::string text() const
    {
        Vec3 high(0, 0, 0);
        for (const Box& box : boxes) {
            high = high.cwiseMax(box.high);
        }
        const bool flat = boxes[0].size().y() == 0;
        const auto end = [&](double x) { return (std::ceil(x / spacing) + 8) * spacing; };
        const double width = end(high.x());
        const double depth = flat ? 0 : end(high.y());
        const double level = high.z() + above * spacing;
        std::string text =
            fmt::format("dimensions = {0}\n[time]\nend = 10\n[particles]\nspacing = {1}\n[fluid]\n"
                        "[[fluid.block]]\nshape = \"box\"\nmin = [0, 0, 0]\nmax = [{2}, {3}, {4}]\n"
                        "[[wall]]\nname = \"tank\"\nshape = \"basin\"\nmin = [0, 0, 0]\n"
                        "max = [{2}, {3}, {5}]\nopen = [\"+z\"]\n",
                        flat ? 2 : 3, spacing, width, depth, level, level + 0.2);
        for (std::size_t k = 0; k < boxes.size(); ++k) {
            text += k == 0 && on_wall ? wall(boxes[k]) : body(k);
        }
        return text;
    }

private:
    std::string wall(const Box& box) const
    {
        if (round) {
            const double radius = box.size().z() / 2;
            return fmt::format("[[wall]]\nname = \"support\"\nshape = \"sphere\"\nradius = {}\n"
                               "position = [{}, 0, {}]\n",
                               radius, (box.low.x() + box.high.x()) / 2, radius);
        }
        return fmt::format("[[wall]]\nname = \"support\"\nshape = \"box\"\nmin = [{}, {}, {}]\n"
                           "max = [{}, {}, {}]\n",
                           box.low.x(), box.low.y(), box.low.z(), box.high.x(), box.high.y(),
                           box.high.z());
    }
    std::string body(std::size_t k) const
    {
        const Vec3 middle = (boxes[k].low + boxes[k].high) / 2;
        const Vec3 size = boxes[k].size();
        return fmt::format("[[body]]\nname = \"box{0}\"\nshape = \"box\"\nsize = [{1}, {2}, {3}]\n"
                           "density = 2000\nposition = [{4}, {5}, {6}]\nfixed = true\n"
                           "stands = \"{7}\"\n"
                           "[[gauge]]\nname = \"on{0}\"\ntype = \"force\"\non = \"box{0}\"\n",
                           k, size.x(), size.y(), size.z(), middle.x(), middle.y(), middle.z(),
                           sealed ? "sealed" : "open");
    }
};

// What the mean force on each body between two times exceeds that of Archimedes by: upwards as a
// layer of water on its plan, along x as one on its side [spacings].
struct Excess {
    double up = 0, along = 0;
};

std::vector<Excess> excess(const Pile& pile, double from, double to)
{
    Simulation sim = make(pile.text());
    std::vector<Excess> sums(pile.boxes.size() - (pile.on_wall ? 1 : 0));
    int steps = 0;
    while (sim.clock.time < to) {
        step_on(sim);
        if (sim.clock.time > from) {
            const std::vector<double> read = read_gauges(sim);
            for (std::size_t k = 0; k < sums.size(); ++k) {
                const std::size_t gauge = k * read.size() / sums.size(); // one for each body
                sums[k].along += read.at(gauge);
                sums[k].up += read.at(gauge + 2);
            }
            ++steps;
        }
    }
    for (std::size_t k = 0; k < sums.size(); ++k) {
        const Vec3 size = pile.boxes[k + (pile.on_wall ? 1 : 0)].size();
        const double across = size.y() > 0 ? size.y() : 1;
        const double unit = weight * pile.spacing * steps * across;
        sums[k].up = sums[k].up / (unit * size.x()) - size.z() / pile.spacing;
        sums[k].along /= unit * size.z();
    }
    return sums;
}

// The bounds leave room over what 60 draws had, -0.09 to 0.11 upwards; the sides at a ledge of less
// than half a spacing have up to 0.27 along x.
void expect_archimedes(const Pile& pile, double from, double to, double bound)
{
    for (const Excess& layer : excess(pile, from, to)) {
        EXPECT_NEAR(layer.up, 0, bound) << pile.text();
        EXPECT_NEAR(layer.along, 0, 2 * bound) << pile.text();
    }
}

Pile pile_of_one_width(Dice& dice)
{
    Pile pile;
    pile.spacing = dice.between(0, 1) < 0.5 ? 0.02 : 0.0125;
    pile.above = dice.between(3, 5);
    const double left = dice.between(8, 9) * pile.spacing;
    const double right = left + dice.between(8, 14) * pile.spacing;
    const double middle = dice.between(5, 8) * pile.spacing;
    const double top = middle + dice.between(5, 8) * pile.spacing;
    pile.boxes = {{{left, 0, 0}, {right, 0, middle}}, {{left, 0, middle}, {right, 0, top}}};
    return pile;
}

// Two boxes of one width or not, one of which overhangs the other by up to a third of its width.
TEST(JointSeams, OverhangingBoxesAreLiftedAsArchimedesSays)
{
    Dice dice(17);
    for (int n = 0; n < 6; ++n) {
        Pile pile = pile_of_one_width(dice);
        const double third = pile.boxes[1].size().x() / 3;
        pile.boxes[1].low.x() += dice.between(-third, third / 2);
        pile.boxes[1].high.x() += dice.between(-third / 2, third);
        pile.on_wall = n % 2 == 0;
        expect_archimedes(pile, 1.0, 1.5, 0.15);
    }
}

// Sides that are flush, or nearly: the fluid beside the seam pushes across it.
TEST(JointSeams, FlushBoxesAreLiftedAsArchimedesSays)
{
    Dice dice(18);
    for (int n = 0; n < 6; ++n) {
        Pile pile = pile_of_one_width(dice);
        if (n >= 3) {
            pile.boxes[1].low.x() += dice.between(-1, 1) * pile.spacing;
            pile.boxes[1].high.x() += dice.between(-1, 1) * pile.spacing;
        }
        pile.on_wall = n % 2 == 0;
        expect_archimedes(pile, 1.0, 1.5, 0.15);
    }
}

// A slab on a pier: water in the seam lifts it, a sealed seam has no pressure.
TEST(JointSeams, ASlabOnAPierFeelsThePressureInItsSeam)
{
    Dice dice(20);
    for (int n = 0; n < 4; ++n) {
        Pile pile;
        pile.sealed = n % 2 == 1;
        pile.on_wall = true;
        const double pier = dice.between(3, 6) * pile.spacing;
        const double left = dice.between(8, 9) * pile.spacing;
        const double before = dice.between(5, 9) * pile.spacing;
        const double right = left + before + pier + dice.between(5, 9) * pile.spacing;
        const double middle = dice.between(6, 8) * pile.spacing;
        const double top = middle + dice.between(3, 5) * pile.spacing;
        pile.boxes = {{{left + before, 0, 0}, {left + before + pier, 0, middle}},
                      {{left, 0, middle}, {right, 0, top}}};
        const double depth = (top - middle) / pile.spacing + pile.above;
        const double missing = pile.sealed ? depth * pier / (right - left) : 0;
        EXPECT_NEAR(excess(pile, 1.0, 1.5)[0].up, -missing, 0.15) << pile.text();
    }
}

// The joint of a box on a disc is a wedge. Known to be off, see the limitations in
// docs/formulation.md: -0.1 to 0.9 spacings in four draws.
TEST(JointSeams, ABoxOnADiscIsLiftedNearlyAsArchimedesSays)
{
    Dice dice(21);
    for (int n = 0; n < 4; ++n) {
        Pile pile = pile_of_one_width(dice);
        pile.on_wall = pile.round = true;
        expect_archimedes(pile, 1.0, 1.5, 1.2);
    }
}

// In space: flush on four sides, and overhanging on some.
TEST(JointSeams, StacksInSpaceAreLiftedAsArchimedesSays)
{
    Dice dice(19);
    for (int n = 0; n < 2; ++n) {
        Pile pile = pile_of_one_width(dice);
        pile.spacing = 0.02;
        const double left = dice.between(8, 9) * pile.spacing;
        for (Box& box : pile.boxes) {
            box.low = {left, left, 0.8 * box.low.z()};
            box.high = {left + dice.between(5, 7) * pile.spacing,
                        left + dice.between(5, 7) * pile.spacing, 0.8 * box.high.z()};
        }
        if (n == 0) {
            pile.boxes[1].high.x() = pile.boxes[0].high.x();
            pile.boxes[1].high.y() = pile.boxes[0].high.y();
        }
        expect_archimedes(pile, 0.8, 1.2, 0.2);
    }
}

} // namespace
} // namespace hyoryu::test_joint_seams
