// SPDX-License-Identifier: MIT
#include "scale_report.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace hyoryu {

std::string scale_lines(const Plan& plan)
{
    std::string text;
    if (!plan.floating.empty()) {
        text += "  floating bodies, in still water\n";
    }
    for (const Plan::FloatingBody& body : plan.floating) {
        const std::string more = body.count > 1 ? fmt::format(" and {} more", body.count - 1) : "";
        text += fmt::format("    {:<22} draft {:.3g} m, {:.2g} spacings; GM {:.3g} m; {}\n",
                            body.name + more, body.draft, body.spacings, body.metacentre,
                            body.comes_to);
    }
    if (!plan.scale) {
        return text;
    }
    const Plan::Scale& scale = *plan.scale;
    text += fmt::format("  scale\n    water                  {:.3g} m deep, {:.3g} spacings\n",
                        scale.depth, scale.layers);
    if (scale.thinnest > 0) {
        text += fmt::format("    thinnest body          {:.3g} m, {:.3g} spacings\n",
                            scale.thinnest, scale.thinnest * scale.layers / scale.depth);
    }
    text += fmt::format(
        "    shortest load          {:.3g} s: pressures that last less than 4 spacings / "
        "c0 are not resolved\n",
        scale.shortest_load);
    text += scale.viscosity > 0
                ? fmt::format("    viscosity              {:.3g} m2/s; effective Reynolds number u "
                              "d/nu {:.3g}\n",
                              scale.viscosity, scale.reynolds)
                : "    viscosity              none\n";
    for (const std::string& absent : scale.absent) {
        text += fmt::format("    not modelled           {}\n", absent);
    }
    return text;
}

void add_scale(const Plan& plan, nlohmann::ordered_json& json)
{
    for (const Plan::FloatingBody& body : plan.floating) {
        json["floating"].push_back({{"body", body.name},
                                    {"count", body.count},
                                    {"draft", body.draft},
                                    {"draft_in_spacings", body.spacings},
                                    {"metacentric_height", body.metacentre},
                                    {"comes_to", body.comes_to}});
    }
    if (plan.scale) {
        const Plan::Scale& scale = *plan.scale;
        json["scale"] = {{"depth", scale.depth},
                         {"depth_in_spacings", scale.layers},
                         {"thinnest_body", scale.thinnest},
                         {"speed", scale.speed},
                         {"shortest_load", scale.shortest_load},
                         {"viscosity", scale.viscosity},
                         {"reynolds", scale.viscosity > 0 ? nlohmann::ordered_json(scale.reynolds)
                                                          : nlohmann::ordered_json()},
                         {"absent", scale.absent}};
    }
}

} // namespace hyoryu
