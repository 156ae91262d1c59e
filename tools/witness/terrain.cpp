// SPDX-License-Identifier: MIT
#include "terrain.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <map>
#include <stdexcept>

namespace witness {

namespace {

// Grids of the tests are small: a map by (column from the west, row from the south) will do.
struct Raster {
    double west = 0, south = 0, dx = 0, dy = 0; // of the first centre, and between centres [m]
    int columns = 0, rows = 0;
    std::vector<std::vector<double>> row; // from south

    double value(int i, int j) const
    {
        return row[static_cast<std::size_t>(std::clamp(j, 0, rows - 1))]
                  [static_cast<std::size_t>(std::clamp(i, 0, columns - 1))];
    }
    double at(double easting, double northing) const
    {
        const double u = std::clamp((easting - west) / dx, 0.0, columns - 1.0);
        const double v = std::clamp((northing - south) / dy, 0.0, rows - 1.0);
        const int i = static_cast<int>(std::floor(u));
        const int j = static_cast<int>(std::floor(v));
        const double s = u - i;
        const double t = v - j;
        return value(i, j) * (1 - s) * (1 - t) + value(i + 1, j) * s * (1 - t) +
               value(i, j + 1) * (1 - s) * t + value(i + 1, j + 1) * s * t;
    }
};

Raster read_raster(const std::filesystem::path& file, double nodata)
{
    std::ifstream stream(file);
    std::map<std::string, double> head;
    std::string word;
    while (stream >> word && (std::isalpha(static_cast<unsigned char>(word[0])) != 0)) {
        std::transform(word.begin(), word.end(), word.begin(),
                       [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
        stream >> head[word];
    }
    Raster raster;
    raster.columns = static_cast<int>(head["ncols"]);
    raster.rows = static_cast<int>(head["nrows"]);
    raster.dx = head.count("dx") != 0 ? head["dx"] : head["cellsize"];
    raster.dy = head.count("dy") != 0 ? head["dy"] : head["cellsize"];
    const bool corner = head.count("xllcorner") != 0;
    raster.west = corner ? head["xllcorner"] + raster.dx / 2 : head["xllcenter"];
    raster.south = corner ? head["yllcorner"] + raster.dy / 2 : head["yllcenter"];
    raster.row.assign(static_cast<std::size_t>(raster.rows),
                      std::vector<double>(static_cast<std::size_t>(raster.columns)));
    bool first = true;
    for (std::size_t j = raster.row.size(); j-- > 0;) {
        for (double& z : raster.row[j]) {
            if (!first) {
                stream >> word;
            }
            first = false;
            z = std::stod(word);
            z = head.count("nodata_value") != 0 && z == head["nodata_value"] ? nodata : z;
        }
    }
    if (!stream) {
        throw std::runtime_error(file.string() + ": the witness cannot read this grid");
    }
    return raster;
}

// Height of the ground at a corner of the surface: a mean over the cell about it where that is
// larger than the cells of the grid.
double height(const Raster& raster, const Placement& p, double x, double y, double hx, double hy)
{
    const double fine = std::min(raster.dx, raster.dy);
    const double a = p.azimuth / 180 * std::acos(-1.0);
    const auto times = [&](double h) {
        return h > fine * (1 + 1e-9) ? static_cast<int>(std::ceil(h / fine - 1e-9)) : 1;
    };
    const auto shifted = [](double centre, double h, int k, int n, double low, double high) {
        return n == 1 ? centre : std::clamp(centre + h * ((k + 0.5) / n - 0.5), low, high);
    };
    const int nx = times(hx);
    const int ny = times(hy);
    double sum = 0;
    for (int j = 0; j < ny; ++j) {
        for (int i = 0; i < nx; ++i) {
            const double u = shifted(x, hx, i, nx, p.low_x, p.high_x);
            const double v = shifted(y, hy, j, ny, p.low_y, p.high_y);
            sum += raster.at(p.east + u * std::sin(a) - v * std::cos(a),
                             p.north + u * std::cos(a) + v * std::sin(a));
        }
    }
    return p.datum + sum / (nx * ny);
}

// Times that a polygon goes round a place (Sunday 2001). Of an edge in line with the axes, the
// lower and the left one belong to the area, the upper and the right one do not.
int winding(const std::vector<Vec3>& corners, double x, double y)
{
    int times = 0;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const Vec3& a = corners[k];
        const Vec3& b = corners[(k + 1) % corners.size()];
        const double left = (b.x() - a.x()) * (y - a.y()) - (x - a.x()) * (b.y() - a.y());
        if (a.y() <= y && y < b.y() && left > 0) {
            ++times;
        } else if (b.y() <= y && y < a.y() && left < 0) {
            --times;
        }
    }
    return times;
}

double height_with_levels(const Raster& raster, const Placement& p, double x, double y, double hx,
                          double hy)
{
    for (auto level = p.levels.rbegin(); level != p.levels.rend(); ++level) {
        if (winding(level->corners, x, y) != 0) {
            return level->z;
        }
    }
    return height(raster, p, x, y, hx, hy);
}

} // namespace

Mesh ground_of(const std::filesystem::path& grid, const Placement& p)
{
    const Raster raster = read_raster(grid, p.nodata);
    const auto edges = [&](double length) {
        return std::max(1, static_cast<int>(std::ceil(length / p.resolution - 1e-9)));
    };
    const int nx = edges(p.high_x - p.low_x);
    const int ny = edges(p.high_y - p.low_y);
    const double hx = (p.high_x - p.low_x) / nx;
    const double hy = (p.high_y - p.low_y) / ny;
    // The ground, the same lattice at the bottom, and four sides.
    Mesh mesh;
    for (int j = 0; j <= ny; ++j) {
        for (int i = 0; i <= nx; ++i) {
            const double x = p.low_x + hx * i;
            const double y = p.low_y + hy * j;
            mesh.corners.emplace_back(x, y, height_with_levels(raster, p, x, y, hx, hy));
            mesh.corners.emplace_back(x, y, p.bottom);
        }
    }
    const auto top = [&](int i, int j) { return 2 * (j * (nx + 1) + i); };
    const auto add = [&](int a, int b, int c) {
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({a + 1, c + 1, b + 1});
    };
    const auto side = [&](int a, int b) { // from a to b with the solid on the left
        mesh.triangles.push_back({a, a + 1, b + 1});
        mesh.triangles.push_back({a, b + 1, b});
    };
    for (int j = 0; j < ny; ++j) {
        for (int i = 0; i < nx; ++i) {
            const auto z = [&](int corner) {
                return mesh.corners[static_cast<std::size_t>(corner)].z();
            };
            const int a = top(i, j), b = top(i + 1, j), c = top(i + 1, j + 1), d = top(i, j + 1);
            if (std::abs(z(a) - z(c)) <= std::abs(z(b) - z(d))) {
                add(a, b, c);
                add(a, c, d);
            } else {
                add(a, b, d);
                add(b, c, d);
            }
        }
    }
    for (int i = 0; i < nx; ++i) {
        side(top(i, 0), top(i + 1, 0));
        side(top(i + 1, ny), top(i, ny));
    }
    for (int j = 0; j < ny; ++j) {
        side(top(nx, j), top(nx, j + 1));
        side(top(0, j + 1), top(0, j));
    }
    return mesh;
}

} // namespace witness
