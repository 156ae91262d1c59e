// SPDX-License-Identifier: MIT
// Cases with files of a map, for the tests of buildings and of level areas.
#pragma once

#include "dice.hpp"
#include "own_folder.hpp"

#include "hyoryu/scene/case_file.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <complex>
#include <numbers>

namespace hyoryu {

namespace fs = std::filesystem;

using Complex = std::complex<double>;

class BuildingFiles : public testing::Test {
protected:
    void write(const std::string& name, const std::string& text) const { folder_.put(name, text); }
    Scene read(const std::string& text) const { return parse_case(text, folder_ / "case.toml"); }
    std::string fault(const std::string& text) const
    {
        try {
            read(text);
        } catch (const CaseError& error) {
            return error.what();
        }
        return "none";
    }

    OwnFolder folder_;
};

// A ground that is a plane: its lowest place under a polygon is at a corner.
struct SlopingGround {
    Complex origin; // easting + i northing [m]
    double azimuth_deg = 0;
    double east = 0, north = 0; // slopes
    double datum = 0;

    double height(Complex map) const
    {
        return east * (map - origin).real() + north * (map - origin).imag();
    }
    // x + i y of the case: x points along the azimuth.
    Complex in_case(Complex map) const
    {
        return (map - origin) * std::polar(1.0, (azimuth_deg - 90) * std::numbers::pi / 180);
    }
};

inline SlopingGround draw_plane(Dice& dice)
{
    return {{dice.between(3e5, 4e5), dice.between(4e6, 5e6)},
            dice.between(-180, 360),
            dice.between(-0.3, 0.3),
            dice.between(-0.3, 0.3),
            dice.between(-5, 5)};
}

inline std::string grid_of(const SlopingGround& plane)
{
    constexpr int half = 20; // cells of 5 m each way
    constexpr double cell = 5;
    std::string text = fmt::format("ncols {}\nnrows {}\nxllcenter {}\nyllcenter {}\ncellsize {}\n",
                                   2 * half + 1, 2 * half + 1, plane.origin.real() - half * cell,
                                   plane.origin.imag() - half * cell, cell);
    for (int j = half; j >= -half; --j) {
        for (int i = -half; i <= half; ++i) {
            text += fmt::format("{} ", plane.height(plane.origin + Complex(i * cell, j * cell)));
        }
        text += '\n';
    }
    return text;
}

inline std::vector<Complex> star(Dice& dice, Complex middle, double least, double most)
{
    std::vector<Complex> ring;
    const int corners = 3 + dice.below(20);
    for (int k = 0; k < corners; ++k) {
        const double radius = dice.between(least, most);
        const double turns = (k + dice.between(0, 0.8)) / corners;
        ring.push_back(middle + std::polar(radius, 2 * std::numbers::pi * turns));
    }
    return ring;
}

inline std::string text_of(const std::vector<Complex>& ring)
{
    std::string text;
    for (std::size_t k = 0; k <= ring.size(); ++k) {
        const Complex p = ring[k % ring.size()];
        text += fmt::format("{}[{}, {}]", k > 0 ? ", " : "", p.real(), p.imag());
    }
    return fmt::format("[{}]", text);
}

inline std::string listed(const std::string& items)
{
    return fmt::format("[{}]", items);
}

inline std::string feature(const std::string& properties, const std::string& coordinates,
                           const std::string& type = "Polygon")
{
    return fmt::format("{{\"type\": \"Feature\", \"properties\": {}, \"geometry\": {{\"type\": "
                       "\"{}\", \"coordinates\": {}}}}}",
                       properties, type, coordinates);
}

inline std::string collection(const std::vector<std::string>& features)
{
    return fmt::format("{{\"type\": \"FeatureCollection\", \"features\": [{}]}}",
                       fmt::join(features, ",\n"));
}

inline std::string case_of(const std::string& ground, const std::string& keys, double spacing = 0.5)
{
    return fmt::format("[time]\nend = 1\n[particles]\nspacing = {}\n{}\n[[buildings]]\nfile = "
                       "\"b.geojson\"\n{}\n[[body]]\nshape = \"sphere\"\nradius = 1\ndensity = "
                       "500\nposition = [0, 0, 90]\n",
                       spacing, ground, keys);
}

inline std::string terrain_of(const SlopingGround& plane)
{
    return fmt::format(
        "[[wall]]\nname = \"ground\"\nshape = \"terrain\"\nfile = \"g.asc\"\norigin = "
        "[{}, {}]\nazimuth_deg = {}\ndatum = {}\nextent = [-60.0, -60.0, 60.0, "
        "60.0]\nresolution = 6.0\n",
        plane.origin.real(), plane.origin.imag(), plane.azimuth_deg, plane.datum);
}

inline const std::string flat = "[[wall]]\nname = \"ground\"\nshape = \"plane\"\n";
inline const std::string square = "[[[0, 0], [8, 0], [8, 6], [0, 6], [0, 0]]]";

inline const MeshShape& mesh_of(const Wall& wall)
{
    return std::get<MeshShape>(std::get<SolidWall>(wall.geometry).shape);
}

} // namespace hyoryu
