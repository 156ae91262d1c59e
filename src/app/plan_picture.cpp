// SPDX-License-Identifier: MIT
#include "plan_picture.hpp"

#include "small_letters.hpp"

#include "hyoryu/scene/shapes.hpp"
#include "hyoryu/scene/triangles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace hyoryu {

namespace {

constexpr int drawn = 1000; // of the longer side of the scene [pixels]
constexpr int left_margin = 90;
constexpr int bottom_margin = 70;
constexpr int other_margin = 20;
constexpr int least_width = 760; // for the line that explains the colours
constexpr Colour paper{255, 255, 255};
constexpr Colour ink{40, 40, 40};
constexpr Colour building{150, 146, 148};
constexpr Colour debris{214, 96, 40};
constexpr Colour water{30, 100, 190};
constexpr Colour north_red{190, 20, 30};

enum class Shown : std::uint8_t { nothing, ground, solid, body };

// The highest surface above each pixel, and the water on it.
struct Map {
    Bounds window;
    double pixel = 1; // edge [m]
    int width = 0, height = 0;
    std::vector<Shown> kind;
    std::vector<float> z;     // [m]
    std::vector<float> level; // of water [m]; -infinity: none

    // Of the water above a pixel [m].
    float depth(std::size_t k) const { return std::max(level[k] - z[k], 0.0F); }

    std::size_t at(int i, int j) const { return static_cast<std::size_t>(j * width + i); }
    // From above: row 0 is that of the greatest y.
    int column(double x) const { return static_cast<int>((x - window.min.x()) / pixel); }
    int row(double y) const { return static_cast<int>((window.max.y() - y) / pixel); }
};

Map empty_map(const Bounds& window)
{
    Map map{.window = window};
    const Vec3 size = window.max - window.min;
    map.pixel = std::max(size.x(), size.y()) / drawn;
    map.width = std::max(1, static_cast<int>(std::ceil(size.x() / map.pixel)));
    map.height = std::max(1, static_cast<int>(std::ceil(size.y() / map.pixel)));
    const auto pixels = static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height);
    map.kind.assign(pixels, Shown::nothing);
    map.z.assign(pixels, -std::numeric_limits<float>::infinity());
    map.level.assign(pixels, -std::numeric_limits<float>::infinity());
    return map;
}

// One triangle that looks up, where it is the highest.
void draw(Map& map, const std::array<Vec3, 3>& t, Shown kind)
{
    const double twice = (t[1].x() - t[0].x()) * (t[2].y() - t[0].y()) -
                         (t[1].y() - t[0].y()) * (t[2].x() - t[0].x());
    if (!(twice > 0)) {
        return;
    }
    const auto [low_x, high_x] = std::minmax({t[0].x(), t[1].x(), t[2].x()});
    const auto [low_y, high_y] = std::minmax({t[0].y(), t[1].y(), t[2].y()});
    const int last_row = std::min(map.row(low_y), map.height - 1);
    const int last_column = std::min(map.column(high_x), map.width - 1);
    for (int j = std::max(map.row(high_y), 0); j <= last_row; ++j) {
        for (int i = std::max(map.column(low_x), 0); i <= last_column; ++i) {
            const double x = map.window.min.x() + (i + 0.5) * map.pixel - t[0].x();
            const double y = map.window.max.y() - (j + 0.5) * map.pixel - t[0].y();
            const double s = (x * (t[2].y() - t[0].y()) - y * (t[2].x() - t[0].x())) / twice;
            const double r = (y * (t[1].x() - t[0].x()) - x * (t[1].y() - t[0].y())) / twice;
            if (s < 0 || r < 0 || s + r > 1) {
                continue;
            }
            const auto z = static_cast<float>(t[0].z() + s * (t[1].z() - t[0].z()) +
                                              r * (t[2].z() - t[0].z()));
            if (z > map.z[map.at(i, j)]) {
                map.z[map.at(i, j)] = z;
                map.kind[map.at(i, j)] = kind;
            }
        }
    }
}

void draw(Map& map, const TriangleSurface& surface, const Vec3& centre, const Quat& rotation,
          Shown kind)
{
    for (const auto& t : surface.triangles) {
        const auto corner = [&](std::size_t k) {
            return Vec3(centre + rotation * surface.corners[static_cast<std::size_t>(t[k])]);
        };
        draw(map, {corner(0), corner(1), corner(2)}, kind);
    }
}

// Terrain, planes and floors are ground; other walls stand on it.
Shown kind_of(const Wall& wall)
{
    const auto* solid = std::get_if<SolidWall>(&wall.geometry);
    const auto* mesh = solid != nullptr ? std::get_if<MeshShape>(&solid->shape) : nullptr;
    return solid == nullptr || (mesh != nullptr && mesh->terrain) ? Shown::ground : Shown::solid;
}

// Each particle is a square, a little wider than the spacing, so that none is between two of them.
void add_water(Map& map, const Scene& scene, const Filling& filling)
{
    const double half = 0.6 * scene.spacing;
    for (const Vec3& p : filling.fluid) {
        const auto level = static_cast<float>(p.z() + scene.spacing / 2);
        const int last_i = std::min(map.column(p.x() + half), map.width - 1);
        const int last_j = std::min(map.row(p.y() - half), map.height - 1);
        for (int j = std::max(map.row(p.y() + half), 0); j <= last_j; ++j) {
            for (int i = std::max(map.column(p.x() - half), 0); i <= last_i; ++i) {
                const std::size_t k = map.at(i, j);
                map.level[k] = std::max(map.level[k], level);
            }
        }
    }
}

Colour mixed(const Colour& a, const Colour& b, double part)
{
    Colour colour{};
    for (std::size_t k = 0; k < 3; ++k) {
        colour[k] = static_cast<std::uint8_t>(
            std::clamp(std::lround(a[k] + part * (b[k] - a[k])), 0L, 255L));
    }
    return colour;
}

// From green lowlands over sand to bare rock.
Colour ground_colour(double part)
{
    constexpr std::array<Colour, 4> tones{
        {{126, 160, 110}, {206, 206, 150}, {190, 152, 108}, {226, 220, 214}}};
    const double place = std::clamp(part, 0.0, 1.0) * (tones.size() - 1);
    const auto k = std::min<std::size_t>(static_cast<std::size_t>(place), tones.size() - 2);
    return mixed(tones[k], tones[k + 1], place - static_cast<double>(k));
}

struct Extremes {
    float low = std::numeric_limits<float>::infinity();
    float high = -std::numeric_limits<float>::infinity();
    void add(float value)
    {
        low = std::min(low, value);
        high = std::max(high, value);
    }
    bool empty() const { return !(low <= high); }
};

// Light from the upper left, by the slope of the ground to the next pixels.
double shade_of(const Map& map, int i, int j)
{
    const auto height = [&](int di, int dj) {
        const int ni = std::clamp(i + di, 0, map.width - 1);
        const int nj = std::clamp(j + dj, 0, map.height - 1);
        const std::size_t k = map.at(ni, nj);
        return map.kind[k] == Shown::ground ? map.z[k] : map.z[map.at(i, j)];
    };
    const double east = (height(1, 0) - height(-1, 0)) / (2 * map.pixel);
    const double north = (height(0, -1) - height(0, 1)) / (2 * map.pixel);
    return std::clamp(1 + 0.6 * (east - north) / std::sqrt(1 + east * east + north * north), 0.5,
                      1.25);
}

bool is_edge(const Map& map, int i, int j)
{
    const Shown own = map.kind[map.at(i, j)];
    const auto differs = [&](int ni, int nj) {
        return ni >= 0 && nj >= 0 && ni < map.width && nj < map.height &&
               map.kind[map.at(ni, nj)] != own;
    };
    return own > Shown::ground &&
           (differs(i - 1, j) || differs(i + 1, j) || differs(i, j - 1) || differs(i, j + 1));
}

Colour colour_of(const Map& map, int i, int j, const Extremes& ground, const Extremes& depth)
{
    const std::size_t k = map.at(i, j);
    if (is_edge(map, i, j)) {
        return ink;
    }
    Colour colour = paper;
    if (map.kind[k] == Shown::ground) {
        const double range = std::max(ground.high - ground.low, 1e-6F);
        const Colour plain = ground_colour((map.z[k] - ground.low) / range);
        colour = mixed({0, 0, 0}, plain, shade_of(map, i, j));
    } else if (map.kind[k] != Shown::nothing) {
        colour = map.kind[k] == Shown::body ? debris : building;
    }
    constexpr double shallow = 0.45; // share of blue
    constexpr double deep = 0.95;
    const double part = depth.empty() ? 0 : std::min(1.0F, map.depth(k) / depth.high);
    return map.depth(k) > 0 ? mixed(colour, water, shallow + (deep - shallow) * part) : colour;
}

// 1, 2 or 5 times a power of ten, about a sixth of a length.
double step_of(double length)
{
    const double wanted = length / 6;
    const double power = std::pow(10, std::floor(std::log10(wanted)));
    for (const double times : {1.0, 2.0, 5.0}) {
        if (times * power >= wanted) {
            return times * power;
        }
    }
    return 10 * power;
}

void draw_axes(Pixels& pixels, const Map& map)
{
    constexpr int tick = 6;
    const int floor_row = other_margin + map.height;
    const double step = step_of(
        std::max(map.window.max.x() - map.window.min.x(), map.window.max.y() - map.window.min.y()));
    const auto label = [](double value) { return fmt::format("{:.6g}", value == 0 ? 0 : value); };
    for (double x = std::ceil(map.window.min.x() / step) * step; x <= map.window.max.x();
         x += step) {
        const int i = left_margin + map.column(x);
        const std::string text = label(std::round(x / step) * step);
        fill_box(pixels, {i, floor_row}, {i + 1, floor_row + tick}, ink);
        write_letters(pixels, i - letter_width * static_cast<int>(text.size()) / 2,
                      floor_row + tick + 3, text, ink);
    }
    for (double y = std::ceil(map.window.min.y() / step) * step; y <= map.window.max.y();
         y += step) {
        const int j = other_margin + map.row(y);
        const std::string text = label(std::round(y / step) * step);
        fill_box(pixels, {left_margin - tick, j}, {left_margin, j + 1}, ink);
        write_letters(pixels, left_margin - tick - 3 - letter_width * static_cast<int>(text.size()),
                      j - letter_height / 2, text, ink);
    }
}

void draw_legend(Pixels& pixels, const Extremes& ground, const Extremes& depth)
{
    const int top = pixels.height - letter_height - 10;
    int left = left_margin;
    const auto entry = [&](const Colour& colour, const std::string& text) {
        fill_box(pixels, {left, top}, {left + letter_height, top + letter_height}, colour);
        write_letters(pixels, left + letter_height + 6, top, text, ink);
        left += letter_height + 6 + letter_width * (static_cast<int>(text.size()) + 1);
    };
    entry(ground_colour(0.3),
          ground.empty() ? "NO GROUND"
                         : fmt::format("GROUND {:.1f} TO {:.1f} M", ground.low, ground.high));
    entry(mixed(paper, water, 0.8),
          depth.empty() ? "NO WATER" : fmt::format("WATER UP TO {:.1f} M DEEP", depth.high));
    entry(building, "SOLID");
    entry(debris, "BODY");
}

// Direction of north in the picture, whose rows go down; none without terrain.
std::optional<std::array<double, 2>> north_of(const Scene& scene)
{
    const TerrainPatch* terrain = terrain_patch_of(scene);
    if (terrain == nullptr) {
        return std::nullopt;
    }
    const double x_axis = terrain->azimuth_deg * std::numbers::pi / 180;
    return std::array{std::cos(x_axis), -std::sin(x_axis)};
}

// An arrow with its letter on a disc, in the upper right corner of the map.
void draw_north(Pixels& pixels, const Map& map, const std::array<double, 2>& north)
{
    constexpr double largest = 34; // radius of the disc [pixels]
    constexpr double smallest = 20;
    const double radius = std::clamp(std::min(map.width, map.height) / 2.0 - 2, smallest, largest);
    const double centre_i = left_margin + map.width - radius - 4;
    const double centre_j = other_margin + radius + 4;
    const auto reach = static_cast<int>(std::ceil(radius));
    for (int dj = -reach; dj <= reach; ++dj) {
        for (int di = -reach; di <= reach; ++di) {
            const double along = (di * north[0] + dj * north[1]) / radius;
            const double across = std::abs(di * north[1] - dj * north[0]) / radius;
            const bool arrow = along > -0.7 && along < 0.3 && across < 0.35 * (0.3 - along);
            if (std::hypot(along, across) <= 1) {
                const int i = static_cast<int>(centre_i) + di;
                const int j = static_cast<int>(centre_j) + dj;
                fill_box(pixels, {i, j}, {i + 1, j + 1}, arrow ? north_red : paper);
            }
        }
    }
    constexpr double letter = 0.65; // place of its middle [radii]
    write_letters(
        pixels, static_cast<int>(centre_i + letter * radius * north[0]) - letter_width / 2 + 1,
        static_cast<int>(centre_j + letter * radius * north[1]) - letter_height / 2, "N", ink);
}

Map map_of(const Scene& scene, const Filling& filling)
{
    Map map = empty_map(filling.domain);
    for (const Wall& wall : scene.walls) {
        draw(map, triangles_of(wall, filling.domain, 3), Vec3::Zero(), Quat::Identity(),
             kind_of(wall));
    }
    for (const BodySettings& body : scene.bodies) {
        const Placed solid = placed(body, 3);
        draw(map, triangles_of(body.shape, 3), solid.centre, solid.rotation, Shown::body);
    }
    add_water(map, scene, filling);
    return map;
}

} // namespace

Pixels plan_picture(const Scene& scene, const Filling& filling)
{
    const Map map = map_of(scene, filling);
    Extremes ground;
    Extremes depth;
    for (std::size_t k = 0; k < map.kind.size(); ++k) {
        if (map.kind[k] == Shown::ground) {
            ground.add(map.z[k]);
        }
        if (map.kind[k] != Shown::nothing && map.depth(k) > 0) {
            depth.add(map.depth(k));
        }
    }
    Pixels pixels{std::max(left_margin + map.width + other_margin, least_width),
                  map.height + other_margin + bottom_margin};
    pixels.colour.assign(
        static_cast<std::size_t>(pixels.width) * static_cast<std::size_t>(pixels.height), paper);
    fill_box(pixels, {left_margin - 1, other_margin - 1},
             {left_margin + map.width + 1, other_margin + map.height + 1}, ink);
    for (int j = 0; j < map.height; ++j) {
        for (int i = 0; i < map.width; ++i) {
            pixels.colour[static_cast<std::size_t>((other_margin + j) * pixels.width + left_margin +
                                                   i)] = colour_of(map, i, j, ground, depth);
        }
    }
    draw_axes(pixels, map);
    draw_legend(pixels, ground, depth);
    if (const auto north = north_of(scene)) {
        draw_north(pixels, map, *north);
    }
    return pixels;
}

} // namespace hyoryu
