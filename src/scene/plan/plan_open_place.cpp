// SPDX-License-Identifier: MIT
#include "plan_open_place.hpp"

#include "hyoryu/scene/case_file.hpp"
#include "hyoryu/scene/shapes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

// Where the domain begins in the direction in which the window opens, or ends against it [m].
double side_of(const PlanFacts& facts, const OpenSettings& open, double sign)
{
    return sign > 0 ? facts.domain.min[open.axis()] : facts.domain.max[open.axis()];
}

bool is_at(const Scene& scene, const OpenSettings& open, double place)
{
    return std::abs(open.plane() - place) <= 1e-6 * scene.spacing;
}

} // namespace

Diagnostic note_at(const Scene& scene, const OpenSettings& open, std::string_view key,
                   std::string what, std::string hint)
{
    return diagnostic_without_line(scene, open.place, fmt::format("open.{}.{}", open.name, key),
                                   std::move(what), std::move(hint));
}

bool points_out(const Scene& scene, const PlanFacts& facts, const OpenSettings& open,
                std::vector<Diagnostic>& errors)
{
    const double other = side_of(facts, open, -open.sign());
    if (is_at(scene, open, side_of(facts, open, open.sign())) || !is_at(scene, open, other)) {
        return false;
    }
    const char axis = "xyz"[open.axis()];
    errors.push_back(
        note_at(scene, open, "into",
                fmt::format("points out of the domain, which {} at the window, at {} = {:.6g} m",
                            open.sign() > 0 ? "ends" : "begins", axis, other),
                fmt::format("write into = \"{}{}\"", open.sign() > 0 ? '-' : '+', axis)));
    return true;
}

void check_side(const Scene& scene, const PlanFacts& facts, const OpenSettings& open,
                std::vector<Diagnostic>& errors)
{
    const double side = side_of(facts, open, open.sign());
    const char axis = "xyz"[open.axis()];
    if (!is_at(scene, open, side)) {
        errors.push_back(note_at(
            scene, open, "min",
            fmt::format("the window is at {} = {:.6g} m, but the domain {} at {:.6g} m there: it "
                        "must lie on that side",
                        axis, open.plane(), open.sign() > 0 ? "begins" : "ends", side),
            fmt::format("move the window to {} = {:.6g}, or set [domain] so that it ends there",
                        axis, side)));
    }
}

bool bodies_are_inside(const Scene& scene, const OpenSettings& open, const OpenSide& side,
                       std::vector<Diagnostic>& errors)
{
    const std::size_t before = errors.size();
    for (const BodySettings& body : scene.bodies) {
        const Bounds box = bounds(placed(body, scene.dimensions));
        const double nearest = std::min(side.distance(box.min), side.distance(box.max));
        if (nearest < 0) {
            errors.push_back(note_at(scene, open, "min",
                                     fmt::format("body \"{}\" stands across the window", body.name),
                                     "move the body into the domain"));
        }
    }
    return errors.size() == before;
}

void check_bodies_that_stop(const Scene& scene, const OpenSettings& open,
                            std::vector<Diagnostic>& errors)
{
    if (open.bodies != BodiesAtSide::stop || scene.bodies.empty()) {
        return;
    }
    if (scene.contact.penalty) {
        errors.push_back(note_at(scene, open, "bodies",
                                 "bodies do not stop at a window with contact.method = "
                                 "\"penalty\", which represents walls only by their particles",
                                 "set bodies = \"leave\", or contact.method = \"impulse\""));
    }
    const auto refuse_name = [&](std::string_view kind, const std::string& name) {
        if (name == open.name) {
            errors.push_back(note_at(scene, open, "name",
                                     fmt::format("the name \"{}\" is already used by a {}: their "
                                                 "contacts could not be distinguished in the "
                                                 "results",
                                                 name, kind),
                                     "give the window another name"));
        }
    };
    for (const Wall& wall : scene.walls) {
        refuse_name("wall", wall.name);
    }
    for (const BodySettings& body : scene.bodies) {
        refuse_name("body", body.name);
    }
}

} // namespace hyoryu
