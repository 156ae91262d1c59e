// SPDX-License-Identifier: MIT
// The law of the Iwate paper (Sasaki, Sunagawa and Ogasawara), equations (1)-(6), taken literally.
#include "impact_law.hpp"

#include <algorithm>
#include <span>

namespace hyoryu {

namespace {

// Points of one pair whose normals agree to this belong to one face.
constexpr double same_normal = 1 - 1e-9;

bool same_face(const Row& one, const Row& other)
{
    return one.a == other.a && one.b == other.b && one.D.col(0).dot(other.D.col(0)) > same_normal;
}

// The mean point of the rows as one contact.
Row representative(std::span<Row* const> face, const StepContext& context)
{
    const ContactMemory& memory = context.memory;
    Touch mean = memory.candidates[face[0]->contact].touch;
    mean.point.setZero();
    for (const Row* row : face) {
        mean.point +=
            memory.candidates[row->contact].touch.point / static_cast<double>(face.size());
    }
    Row row;
    row.a = face[0]->a;
    row.b = face[0]->b;
    row.cone.mu = face[0]->cone.mu;
    row.wall_velocity = face[0]->wall_velocity;
    const Vec3 xa = memory.poses[row.a].x;
    const Vec3 xb = row.b >= 0 ? memory.poses[row.b].x : xa;
    complete(row, {mean, mean}, {xa, xb, xa, xb}, memory.responses,
             context.rigid.settings.dimensions);
    return row;
}

// The impulse of one contact, in the axes of the row.
Vec3 paper_impulse(const Row& row, const Vec3& u, double restitution)
{
    const double J = -(1 + restitution) * u[0] / row.cone.K(0, 0);
    Vec3 t = Vec3::Zero();
    for (int k = 1; k < row.cone.size; ++k) {
        t[k] = u[k];
    }
    const double slip = t.norm();
    if (slip == 0) {
        return {J, 0, 0};
    }
    t /= slip;
    const double b = slip / t.dot(row.cone.K * t);
    return Vec3(J, 0, 0) - std::min(row.cone.mu * J, b) * t;
}

// Strikes the rows of one face that still approach, at their mean point; each takes the same share,
// which is the same force and torque.
void strike(const std::vector<Row*>& face, const Round& round, const StepContext& context)
{
    std::vector<Response>& bodies = context.memory.responses;
    std::vector<Row*> approaching;
    for (Row* row : face) {
        if (velocity(*row, bodies)[0] < -round.slow) {
            approaching.push_back(row);
        }
    }
    if (approaching.empty()) {
        return;
    }
    const Row mean = representative(approaching, context);
    const double restitution = -approaching[0]->target / approaching[0]->before[0];
    const Vec3 P = mean.B * paper_impulse(mean, velocity(mean, bodies), restitution);
    const Vec3 share = P / static_cast<double>(approaching.size());
    for (Row* row : approaching) {
        push(*row, row->B.transpose() * share, bodies);
    }
}

} // namespace

double paper_round(const StepContext& context, Round& round)
{
    std::vector<Row>& rows = context.memory.rows;
    collect(context, round, -round.slow, rows);
    round.closing = rows.empty() || round.least == infinity;
    std::vector<bool> done(rows.size(), false);
    for (std::size_t k = 0; k < rows.size(); ++k) {
        std::vector<Row*> face;
        for (std::size_t m = k; m < rows.size() && !done[k]; ++m) {
            if (same_face(rows[k], rows[m])) {
                face.push_back(&rows[m]);
            }
        }
        for (const Row* row : face) {
            done[row - rows.data()] = true;
        }
        strike(face, round, context);
    }
    std::erase_if(rows, [](const Row& row) { return row.p.isZero(0); });
    return 0;
}

} // namespace hyoryu
