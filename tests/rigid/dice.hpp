// SPDX-License-Identifier: MIT
// Scenes at random that follow from a number.
#pragma once

#include "hyoryu/rigid/rigid.hpp"

#include <cstdlib>
#include <random>

namespace hyoryu::test {

/// The same draws for the same seed, on any machine.
class Dice {
public:
    explicit Dice(int seed) : engine_(static_cast<unsigned>(seed)) {}

    double between(double low, double high)
    {
        return low + (high - low) * static_cast<double>(engine_()) * 0x1p-32;
    }
    Vec3 within(double size)
    {
        const double x = between(-size, size);
        const double y = between(-size, size);
        return {x, y, between(-size, size)};
    }
    Quat turn()
    {
        const Vec3 v = within(1);
        return Quat(between(-1, 1), v.x(), v.y(), v.z()).normalized();
    }

private:
    std::mt19937 engine_;
};

/// A number from the environment, for longer families than a test has time for.
inline int number_from(const char* variable, int otherwise)
{
    const char* text = std::getenv(variable);
    return text == nullptr ? otherwise : std::atoi(text);
}

/// The hull of twelve points within a cube of twice the size, about the mean of its corners.
inline Polytope random_hull(Dice& dice, double size)
{
    std::vector<Vec3> points;
    for (int k = 0; k < 12; ++k) {
        points.push_back(dice.within(size));
    }
    Polytope hull = convex_hull(points);
    Vec3 middle = Vec3::Zero();
    for (const Vec3& corner : hull.corners) {
        middle += corner / static_cast<double>(hull.corners.size());
    }
    for (Vec3& corner : hull.corners) {
        corner -= middle;
    }
    return hull;
}

} // namespace hyoryu::test
