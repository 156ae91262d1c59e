// SPDX-License-Identifier: MIT
// The resolved case, read with tomlplusplus.
#include "mass.hpp"
#include "prism.hpp"
#include "scene.hpp"
#include "terrain.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace witness {

namespace {

// The sides of a basin whose case names no thickness are as thick as the rows of wall particles
// that cover the support of the kernel, twice the smoothing length.
double thickness_of_rows(const Scene& scene)
{
    return std::ceil(2 * scene.smoothing_ratio - 1e-9) * scene.spacing;
}

Vec3 vector_of(const toml::node_view<const toml::node>& node, const Vec3& otherwise)
{
    const toml::array* list = node.as_array();
    if (list == nullptr || list->size() != 3) {
        return otherwise;
    }
    Vec3 v;
    for (std::size_t k = 0; k < 3; ++k) {
        v[static_cast<Eigen::Index>(k)] = (*list)[k].value_or(0.0);
    }
    return v;
}

Quat rotation_of(const toml::table& table)
{
    const toml::array* list = table["rotation"].as_array();
    if (list == nullptr || list->size() != 4) {
        return Quat::Identity();
    }
    const auto n = [&](std::size_t k) { return (*list)[k].value_or(0.0); };
    return Quat(n(0), n(1), n(2), n(3)).normalized();
}

Path path_of(const toml::node_view<const toml::node>& motion)
{
    Path path;
    path.velocity = vector_of(motion["velocity"], Vec3::Zero());
    const toml::array* times = motion["times"].as_array();
    const toml::array* places = motion["places"].as_array();
    for (std::size_t k = 0; times != nullptr && places != nullptr && k < times->size(); ++k) {
        path.times.push_back((*times)[k].value_or(0.0));
        const toml::array& place = *(*places)[k].as_array();
        path.places.emplace_back(place[0].value_or(0.0), place[1].value_or(0.0),
                                 place[2].value_or(0.0));
    }
    return path;
}

std::vector<Vec3> points_of(const std::filesystem::path& file)
{
    std::ifstream stream(file);
    std::vector<Vec3> points;
    for (std::string line; std::getline(stream, line);) {
        std::replace(line.begin(), line.end(), ',', ' ');
        std::istringstream numbers(line);
        Vec3 p;
        if (numbers >> p.x() >> p.y() >> p.z()) {
            points.push_back(p);
        }
    }
    if (points.empty()) {
        throw std::runtime_error(file.string() + ": no particle could be read");
    }
    return points;
}

Kind kind_of(const std::string& shape)
{
    constexpr std::array<std::pair<const char*, Kind>, 10> kinds{
        {{"box", Kind::box},
         {"sphere", Kind::ball},
         {"cylinder", Kind::cylinder},
         {"mesh", Kind::mesh},
         {"terrain", Kind::mesh},
         {"prism", Kind::mesh},
         {"particles", Kind::cubes},
         {"plane", Kind::plane},
         {"basin", Kind::basin},
         {"round_basin", Kind::round_basin}}};
    for (const auto& [name, kind] : kinds) {
        if (shape == name) {
            return kind;
        }
    }
    throw std::runtime_error("the witness knows no shape \"" + shape + "\"");
}

void read_basin(const toml::table& table, const Scene& scene, Solid& solid)
{
    solid.low = vector_of(table["min"], Vec3::Zero());
    solid.high = vector_of(table["max"], Vec3::Zero());
    solid.thickness = table["thickness"].value_or(thickness_of_rows(scene));
    constexpr std::array<const char*, 6> sides{"-x", "+x", "-y", "+y", "-z", "+z"};
    const toml::array* open = table["open"].as_array();
    for (std::size_t k = 0; open != nullptr && k < open->size(); ++k) {
        const std::string name = (*open)[k].value_or(std::string());
        solid.open[static_cast<std::size_t>(std::find(sides.begin(), sides.end(), name) -
                                            sides.begin())] = true;
    }
}

std::vector<Vec3> polygon_of(const toml::table& table)
{
    std::vector<Vec3> corners;
    const toml::array* list = table["corners"].as_array();
    for (std::size_t k = 0; list != nullptr && k < list->size(); ++k) {
        corners.push_back(vector_of(toml::node_view<const toml::node>((*list)[k]), Vec3::Zero()));
    }
    return corners;
}

std::vector<Level> levels_of(const toml::table& table)
{
    std::vector<Level> levels;
    const toml::array* list = table["level"].as_array();
    for (std::size_t k = 0; list != nullptr && k < list->size(); ++k) {
        const toml::table& level = *(*list)[k].as_table();
        levels.push_back({polygon_of(level), level["z"].value_or(std::nan(""))});
    }
    return levels;
}

Placement placement_of(const toml::table& table)
{
    const auto number = [&](const char* key, std::size_t k) {
        return table[key][k].value_or(std::nan(""));
    };
    return {.east = number("origin", 0),
            .north = number("origin", 1),
            .azimuth = table["azimuth_deg"].value_or(90.0),
            .datum = table["datum"].value_or(0.0),
            .bottom = table["bottom"].value_or(std::nan("")),
            .low_x = number("extent", 0),
            .low_y = number("extent", 1),
            .high_x = number("extent", 2),
            .high_y = number("extent", 3),
            .resolution = table["resolution"].value_or(std::nan("")),
            .nodata = table["nodata"].value_or(0.0),
            .levels = levels_of(table)};
}

Mesh read_prism(const toml::table& table)
{
    return prism_of(polygon_of(table), table["bottom"].value_or(std::nan("")),
                    table["top"].value_or(std::nan("")));
}

Solid read_solid(const toml::table& table, const Scene& scene)
{
    Solid solid;
    solid.name = table["name"].value_or(std::string());
    solid.kind = kind_of(table["shape"].value_or(std::string()));
    solid.spacing = table["spacing"].value_or(scene.spacing);
    solid.size = vector_of(table["size"], Vec3::Zero());
    solid.radius = table["radius"].value_or(0.0);
    solid.length = table["length"].value_or(0.0);
    solid.position = vector_of(table["position"], Vec3::Zero());
    solid.rotation = rotation_of(table);
    solid.point = vector_of(table["point"], Vec3::Zero());
    solid.normal = vector_of(table["normal"], Vec3::UnitZ()).normalized();
    solid.path = path_of(table["motion"]);
    solid.density = table["density"].value_or(0.0);
    solid.given = table["mass"].value<double>();
    solid.middle = -vector_of(table["center_of_mass"], {0, 0, 0});
    if (table.contains("inertia")) {
        solid.inertia = vector_of(table["inertia"], {0, 0, 0});
    }
    solid.held = table["fixed"].value_or(false);
    const std::filesystem::path file = table["file"].value_or(std::string());
    if (table["shape"].value_or(std::string()) == "terrain") {
        solid.mesh = ground_of(file, placement_of(table));
    } else if (table["shape"].value_or(std::string()) == "prism") {
        solid.mesh = read_prism(table);
    } else if (solid.kind == Kind::mesh) {
        solid.mesh = read_mesh(file, table["scale"].value_or(1.0));
    } else if (solid.kind == Kind::cubes) {
        solid.points = points_of(file);
        solid.edge = solid.spacing;
        Vec3 mean = Vec3::Zero();
        for (const Vec3& p : solid.points) {
            mean += p / static_cast<double>(solid.points.size());
        }
        for (Vec3& p : solid.points) {
            p -= mean;
        }
    } else if (solid.kind == Kind::basin) {
        read_basin(table, scene, solid);
    } else if (solid.kind == Kind::round_basin) {
        solid.thickness = thickness_of_rows(scene);
    }
    return solid;
}

} // namespace

Scene read_scene(const std::filesystem::path& file)
{
    const toml::table root = toml::parse_file(file.string());
    Scene scene;
    scene.dimensions = root["dimensions"].value_or(3);
    scene.gravity = vector_of(root["gravity"], {0, 0, -9.81});
    scene.spacing = root["particles"]["spacing"].value_or(0.0);
    scene.fluid = root.contains("fluid");
    scene.smoothing_ratio = root["fluid"]["smoothing_ratio"].value_or(scene.smoothing_ratio);
    scene.rest_density = root["fluid"]["density"].value_or(1000.0);
    scene.penalty = root["contact"]["method"].value_or(std::string("impulse")) == "penalty";
    for (const char* what : {"wall", "body"}) {
        const toml::array* list = root[what].as_array();
        for (std::size_t k = 0; list != nullptr && k < list->size(); ++k) {
            Solid solid = read_solid(*(*list)[k].as_table(), scene);
            if (what == std::string("wall")) {
                scene.walls.push_back(std::move(solid));
                continue;
            }
            const Vec3 centre = solid.kind == Kind::mesh ? centroid(solid.mesh) : Vec3::Zero();
            for (Vec3& corner : solid.mesh.corners) {
                corner -= centre;
            }
            scene.bodies.push_back(std::move(solid));
        }
    }
    return scene;
}

} // namespace witness
