// SPDX-License-Identifier: MIT
// Case texts for tests, and the mistakes of a text.
#pragma once

#include "hyoryu/scene/case_file.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace hyoryu {

/// Every key of the case format that this version has, in one case.
inline const std::string full_case = R"(title = "Bore with \"timbers\" against a house"
dimensions = 3
gravity = [0.0, 0.0, -9.81]
seed = 7

[time]
end = 3.0
step = 0.001
cfl = 0.2
recover = false

[particles]
spacing = 0.02

[domain]
min = [0.0, 0.0, 0.0]
max = [8.0, 1.0, 1.5]
periodic = []

[fluid]
density = 1000.0
formulation = "sph"
sound_speed = 30.0
smoothing_ratio = 1.4
[fluid.viscosity]
model = "artificial"
alpha = 0.02
[fluid.density_diffusion]
model = "fourtakas"
delta = 0.1
[fluid.shifting]
model = "none"
[[fluid.block]]
shape = "box"
min = [0.0, 0.0, 0.0]
max = [1.5, 1.0, 0.8]
velocity = [0.1, 0.0, 0.0]
[[fluid.block]]
shape = "sphere"
position = [4.0, 0.5, 1.0]
radius = 0.1
[[fluid.block]]
shape = "cylinder"
position = [4.5, 0.5, 1.0]
radius = 0.1
length = "30 cm"
rotation_deg = { axis = [0, 0, 2], angle = 33.0 }

[[wall]]
name = "floor"
shape = "plane"
point = [0.0, 0.0, 0.0]
normal = [0.1, 0.2, 1.0]
[[wall]]
name = "basin"
shape = "basin"
min = [0.0, 0.0, 0.0]
max = [8.0, 1.0, 1.5]
open = ["+z"]
material = "concrete"
[[wall]]
name = "house"
shape = "box"
min = [6.0, 0.3, 0.0]
max = [6.4, 0.7, 0.8]
[wall.motion]
velocity = [0.0, 0.0, 0.0]
[[wall]]
shape = "box"
size = [0.1, 0.2, 0.3]
position = [7.0, 0.5, 0.2]
rotation_deg = { axis = [1, 1, 1], angle = "0.7 rad" }
[[wall]]
shape = "cylinder"
position = [7.5, 0.5, 0.2]
radius = 0.1
length = 0.3

[[body]]
name = "timber"
shape = "box"
size = [1.0, 0.1, 0.1]
density = 520.0
position = [3.0, 0.5, 0.45]
rotation_deg = { axis = [0, 1, 0], angle = 45.0 }
velocity = [0.0, 0.0, 0.0]
angular_velocity = [0.0, 0.1, 0.0]
spacing = 0.01
material = "pine"
fixed = false
locks = ["y", "rz"]
[body.copies]
count = [2, 3, 1]
pitch = [1.2, 0.3, 0.2]
[[body]]
shape = "sphere"
radius = 0.13
mass = 3.7
position = [5.0, 0.5, 0.7]
fixed = true
[[body]]
shape = "cylinder"
radius = 0.13
length = 0.71
mass = "37 kg"
position = [5.5, 0.5, 0.7]

[contact]
method = "impulse"
law = "simultaneous"
locating_share = 0.35
restitution = 0.4
friction = 0.3
[[contact.pair]]
materials = ["pine", "concrete"]
restitution = 0.5
friction = 0.6
stiffness = 2.4e6

[[gauge]]
name = "level"
type = "elevation"
at = [5.0, 0.5]
[[gauge]]
type = "pressure"
at = [5.0, 0.5, 0.1]
[[gauge]]
type = "velocity"
at = [5.0, 0.5, 0.1]
[[gauge]]
type = "force"
on = "timber.6"
[[gauge]]
type = "front"
axis = "x"

[output]
every = 0.02
history_every = 0.001
fields = ["velocity", "pressure"]
checkpoint_every = 600
)";

/// A short good case, to which tests add lines.
inline const std::string short_case = R"([time]
end = 1
[particles]
spacing = 0.1
[fluid]
[[fluid.block]]
shape = "box"
min = [0, 0, 0]
max = [1, 1, 1]
)";
inline constexpr int short_lines = 9;

/// What is wrong with a case; empty if nothing is.
inline std::vector<Diagnostic> mistakes(const std::string& text,
                                        const std::vector<std::string>& overrides = {})
{
    try {
        parse_case(text, "case.toml", overrides);
        return {};
    } catch (const CaseError& error) {
        return error.diagnostics();
    }
}

/// The mistake at that key, or an empty one.
inline Diagnostic mistake_at(const std::vector<Diagnostic>& all, const std::string& key)
{
    const auto at =
        std::find_if(all.begin(), all.end(), [&](const Diagnostic& d) { return d.key == key; });
    return at == all.end() ? Diagnostic{} : *at;
}

/// The text with one line in place of another.
inline std::string replaced(std::string text, const std::string& from, const std::string& to)
{
    const auto at = text.find(from);
    return at == std::string::npos ? "the text to replace is not there"
                                   : text.replace(at, from.size(), to);
}

} // namespace hyoryu
