// SPDX-License-Identifier: MIT
// Shapes whose middle is not the centre of mass.
#include "hyoryu/rigid/body.hpp"

namespace hyoryu {

namespace {

void move(Ball& ball, const Vec3& way)
{
    ball.middle += way;
}
void move(Rod& rod, const Vec3& way)
{
    rod.middle += way;
}
void move(Polytope& polytope, const Vec3& way)
{
    for (Vec3& corner : polytope.corners) {
        corner += way;
    }
}
void move(Compound& compound, const Vec3& way)
{
    for (Polytope& part : compound.parts) {
        move(part, way);
    }
}

} // namespace

ContactShape moved(ContactShape shape, const Vec3& way)
{
    std::visit([&](auto& form) { move(form, way); }, shape);
    return shape;
}

} // namespace hyoryu
