// SPDX-License-Identifier: MIT
#include "place_buildings.hpp"

#include "scene/surfaces/ground.hpp"
#include "scene/surfaces/plan_polygon.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

constexpr std::size_t most_buildings = 5000;
constexpr std::size_t most_told = 10; // faults
// Corners nearer to each other or to the line of their neighbours are one, as of a survey [m].
constexpr double same_place = 1e-6;
// Neighbours whose footprints share less than this part of the smaller one only touch.
constexpr double touching = 0.01;

bool overlap(const Frame2& a, const Frame2& b)
{
    return a.low[0] < b.high[0] && b.low[0] < a.high[0] && a.low[1] < b.high[1] &&
           b.low[1] < a.high[1];
}

// Whether a corner stands in the line of its neighbours, between them, or in the place of the
// first.
bool is_idle(const Plan2& a, const Plan2& b, const Plan2& c)
{
    const double before = std::hypot(b[0] - a[0], b[1] - a[1]);
    const double length = std::hypot(c[0] - a[0], c[1] - a[1]);
    const double along = (b[0] - a[0]) * (c[0] - a[0]) + (b[1] - a[1]) * (c[1] - a[1]);
    return before < same_place || (length > 0 && std::abs(cross(a, c, b)) < same_place * length &&
                                   along > 0 && along < length * length);
}

Ring cleaned(const Ring& ring)
{
    Ring kept = ring;
    for (std::size_t k = 0; k < kept.size() && kept.size() > 3;) {
        const std::size_t n = kept.size();
        if (is_idle(kept[(k + n - 1) % n], kept[k], kept[(k + 1) % n])) {
            kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(k));
        } else {
            ++k;
        }
    }
    return kept;
}

double lowest_ground(const Ground& ground, const Ring& ring)
{
    double lowest = infinity;
    for (const auto& [i, j, k] : ear_triangles(ring)) {
        const auto corner = [&](int n) { return ring[at(n)]; };
        lowest = std::min(lowest, ground.lowest_under({corner(i), corner(j), corner(k)}));
    }
    return lowest;
}

// One wall of a prism between two heights.
Wall prism_wall(const std::string& name, PrismOutline outline)
{
    Mesh mesh = prism_mesh(outline);
    MeshShape shape;
    shape.corners = std::move(mesh.corners);
    shape.triangles = std::move(mesh.triangles);
    shape.prism = std::move(outline);
    Wall wall;
    wall.name = name;
    wall.geometry = SolidWall{.shape = std::move(shape)};
    return wall;
}

const MeshShape& mesh_of(const Wall& wall)
{
    return std::get<MeshShape>(std::get<SolidWall>(wall.geometry).shape);
}

// Adds a building; notes why it cannot stand.
void build(const Footprint& footprint, const std::string& name, const Ground& ground,
           const Scene& scene, Buildings& buildings)
{
    std::vector<Ring> rings;
    std::ranges::transform(footprint.rings, std::back_inserter(rings), cleaned);
    const std::string fault = outline_fault(rings);
    PrismOutline outline;
    outline.corners = fault.empty() ? cut_open(rings) : Ring{};
    const std::string where = footprint.name.empty()
                                  ? footprint.where
                                  : fmt::format("{} (\"{}\")", footprint.where, name);
    if (outline.corners.empty() || ear_triangles(outline.corners).empty()) {
        buildings.faults.push_back(
            {fmt::format("{} is not a valid outline of a building: {}", where,
                         fault.empty() ? "it cannot be divided into triangles" : fault),
             "repair it, for instance by `ogr2ogr -makevalid NEW.geojson FILE.geojson`"});
        return;
    }
    const double lowest = lowest_ground(ground, outline.corners);
    if (!(lowest < infinity)) {
        buildings.faults.push_back(
            {fmt::format("{} at ({:.6g}, {:.6g}) m has no ground under it", where,
                         outline.corners[0][0], outline.corners[0][1]),
             "without a terrain the coordinates are those of the case, in m"});
        return;
    }
    constexpr double below = 3; // spacings: the rows of particles of a wall reach into the ground
    outline.bottom = lowest - below * scene.spacing;
    outline.top = lowest + footprint.height;
    buildings.walls.push_back(prism_wall(name, std::move(outline)));
}

void look_for_overlaps(Buildings& buildings)
{
    const std::vector<Wall>& walls = buildings.walls;
    std::vector<Frame2> frames;
    for (const Wall& wall : walls) {
        frames.push_back(frame_of(mesh_of(wall).prism->corners));
    }
    std::size_t pairs = 0;
    std::string first;
    for (std::size_t a = 0; a < walls.size(); ++a) {
        const Ring& ring = mesh_of(walls[a]).prism->corners;
        for (std::size_t b = a + 1; b < walls.size(); ++b) {
            if (!overlap(frames[a], frames[b])) {
                continue;
            }
            const Ring& other = mesh_of(walls[b]).prism->corners;
            const double shared = shared_area(ring, other);
            const double least =
                std::min(std::abs(signed_area(ring)), std::abs(signed_area(other)));
            if (shared > touching * least) {
                first = pairs == 0 ? fmt::format("\"{}\" and \"{}\" by {:.3g} m2", walls[a].name,
                                                 walls[b].name, shared)
                                   : first;
                ++pairs;
            }
        }
    }
    if (pairs > 0) {
        buildings.warnings.push_back(
            {fmt::format("{} pairs of buildings overlap, first {}", pairs, first),
             "they act as one solid, but the force on each is that on its own part of the surface; "
             "merge them in the file if they are one building"});
    }
}

// Notes how many footprints lie beside the terrain: a fault if all do.
void tell_of_those_beside(std::size_t beside, const std::vector<Footprint>& footprints,
                          const TerrainPatch* patch, Buildings& buildings)
{
    if (beside > 0 && beside == footprints.size()) {
        buildings.faults.push_back(
            {fmt::format("none of the {} footprints lies on the terrain, which has x from {:.6g} "
                         "to {:.6g} m and y from {:.6g} to {:.6g} m; the first footprint begins at "
                         "easting {:.9g}, northing {:.9g}",
                         beside, patch->extent[0], patch->extent[2], patch->extent[1],
                         patch->extent[3], footprints[0].rings[0][0][0],
                         footprints[0].rings[0][0][1]),
             "both files must use the same map projection"});
    } else if (beside > 0) {
        buildings.warnings.push_back({fmt::format("{} of {} footprints lie outside the terrain and "
                                                  "are omitted",
                                                  beside, footprints.size()),
                                      "enlarge `wall.extent` if they are needed"});
    }
}

// Why footprints cannot be in the coordinates of a terrain; empty if they can. Without a terrain
// buildings of a laboratory's model, of some spacings, may stand where degrees could be.
// `spacing`: of the particles [m].
std::string fault_of_map(const std::vector<Footprint>& footprints, const TerrainPatch* patch,
                         double spacing)
{
    const bool degrees = std::ranges::all_of(
        footprints, [](const Footprint& f) { return may_be_degrees(f.rings.front()); });
    if (patch != nullptr) {
        return degrees && !may_be_degrees({{patch->origin[0], patch->origin[1]}})
                   ? "the coordinates look like degrees, those of the terrain are in metres"
                   : "";
    }
    const double smallest = std::min(spacing, 0.1); // of a building, and a kilometre in degrees
    const bool tiny = std::ranges::all_of(footprints, [&](const Footprint& f) {
        const Frame2 frame = frame_of(f.rings.front());
        return std::max(frame.high[0] - frame.low[0], frame.high[1] - frame.low[1]) < smallest;
    });
    return degrees && tiny ? "the coordinates look like degrees" : "";
}

// Whether a ring is partly beside the terrain, if there is one.
bool reaches_beyond(const TerrainPatch* patch, const Ring& ring)
{
    const Frame2 frame = frame_of(ring);
    return patch != nullptr &&
           (frame.low[0] < patch->extent[0] || frame.low[1] < patch->extent[1] ||
            frame.high[0] > patch->extent[2] || frame.high[1] > patch->extent[3]);
}

} // namespace

const Wall* terrain_of(const Scene& scene)
{
    for (const Wall& wall : scene.walls) {
        const auto* solid = std::get_if<SolidWall>(&wall.geometry);
        const auto* mesh = solid != nullptr ? std::get_if<MeshShape>(&solid->shape) : nullptr;
        if (mesh != nullptr && mesh->terrain) {
            return &wall;
        }
    }
    return nullptr;
}

const TerrainPatch* terrain_patch_of(const Scene& scene)
{
    const Wall* wall = terrain_of(scene);
    return wall != nullptr ? &*mesh_of(*wall).terrain : nullptr;
}

Buildings place_buildings(const std::vector<Footprint>& footprints, const std::string& prefix,
                          const Scene& scene)
{
    Buildings buildings;
    const Wall* terrain = terrain_of(scene);
    const TerrainPatch* patch = terrain_patch_of(scene);
    if (const std::string fault = fault_of_map(footprints, patch, scene.spacing); !fault.empty()) {
        buildings.faults.push_back(
            {fault, "project them to the map of the terrain, for instance by `ogr2ogr -t_srs "
                    "EPSG:32654 NEW.geojson FILE.geojson`; in metres, a building must be at least "
                    "a spacing wide"});
        return buildings;
    }
    constexpr double far = 1e6; // planes reach there [m]
    const Ground ground(scene.walls, terrain != nullptr ? terrain->name : "", far, 3);
    std::size_t beside = 0;
    std::string partly; // the first footprint that reaches beyond the terrain
    for (std::size_t k = 0; k < footprints.size() && buildings.faults.size() < most_told; ++k) {
        Footprint footprint = footprints[k];
        for (Ring& ring : footprint.rings) {
            if (patch != nullptr) {
                into_axes_of(*patch, ring);
            }
        }
        if (patch != nullptr &&
            !overlap(frame_of(footprint.rings.front()), {{patch->extent[0], patch->extent[1]},
                                                         {patch->extent[2], patch->extent[3]}})) {
            ++beside;
            continue;
        }
        if (buildings.walls.size() == most_buildings) {
            buildings.faults.push_back({fmt::format("more than {} buildings", most_buildings),
                                        "reduce the file to the terrain, for instance by "
                                        "`ogr2ogr -clipsrc`"});
            break;
        }
        const std::string name = footprint.name.empty()
                                     ? fmt::format("{}.{}", prefix, footprint.number)
                                     : footprint.name;
        partly = partly.empty() && reaches_beyond(patch, footprint.rings.front()) ? name : partly;
        build(footprint, name, ground, scene, buildings);
    }
    if (!partly.empty()) {
        buildings.warnings.push_back(
            {fmt::format("\"{}\" stands only partly on the terrain", partly),
             "enlarge `wall.extent`, or cut the footprint there"});
    }
    tell_of_those_beside(beside, footprints, patch, buildings);
    look_for_overlaps(buildings);
    return buildings;
}

} // namespace hyoryu
