// SPDX-License-Identifier: MIT
#include "terrain.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <istream>
#include <iterator>
#include <map>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>

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

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& why)
{
    throw std::runtime_error(file.string() + ": the witness cannot read this grid: " + why);
}

std::string bytes_of(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    std::string bytes((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
    if (bytes.empty() || bytes.find('\0') != std::string::npos) {
        refuse(file, "it is missing, empty, or not a text");
    }
    return bytes;
}

// The number that a whole word is; strtod knows nan and inf.
std::optional<double> number_in(const std::string& word)
{
    char* end = nullptr;
    const double number = std::strtod(word.c_str(), &end);
    return !word.empty() && *end == '\0' ? std::optional(number) : std::nullopt;
}

std::string in_small(std::string word)
{
    std::transform(word.begin(), word.end(), word.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return word;
}

// Marks of cells that have no height, besides that of the header.
bool is_missing(double z)
{
    return std::isnan(z) || z == -9999;
}

using Head = std::map<std::string, double>;

// Pairs of a key and a number up to the first height, in the order of ESRI.
Head head_of(const std::filesystem::path& file, std::istream& words)
{
    constexpr std::array<const char*, 10> keys{"ncols",     "nrows",       "xllcorner", "yllcorner",
                                               "xllcenter", "yllcenter",   "cellsize",  "dx",
                                               "dy",        "nodata_value"};
    Head head;
    for (std::string word; words >> std::ws, std::isalpha(words.peek()) != 0;) {
        const auto before = words.tellg();
        words >> word;
        if (number_in(word)) { // "nan", the first height
            words.seekg(before);
            break;
        }
        std::string value;
        words >> value;
        const auto number = number_in(value);
        if (std::find(keys.begin(), keys.end(), in_small(word)) == keys.end() || !number) {
            refuse(file, "its header has \"" + word + " " + value + "\"");
        }
        head[in_small(word)] = *number;
    }
    return head;
}

Raster grid_in(const std::filesystem::path& file, std::istream& words, double nodata)
{
    Head head = head_of(file, words);
    Raster raster;
    raster.columns = static_cast<int>(head["ncols"]);
    raster.rows = static_cast<int>(head["nrows"]);
    raster.dx = head.count("dx") != 0 ? head["dx"] : head["cellsize"];
    raster.dy = head.count("dy") != 0 ? head["dy"] : head["cellsize"];
    const bool placed = (head.count("xllcorner") != 0 || head.count("xllcenter") != 0) &&
                        (head.count("yllcorner") != 0 || head.count("yllcenter") != 0);
    if (raster.columns < 2 || raster.rows < 2 || !(raster.dx > 0) || !(raster.dy > 0) || !placed) {
        refuse(file, "its header lacks the number, size or place of its cells");
    }
    raster.west =
        head.count("xllcorner") != 0 ? head["xllcorner"] + raster.dx / 2 : head["xllcenter"];
    raster.south =
        head.count("yllcorner") != 0 ? head["yllcorner"] + raster.dy / 2 : head["yllcenter"];
    raster.row.assign(static_cast<std::size_t>(raster.rows),
                      std::vector<double>(static_cast<std::size_t>(raster.columns)));
    for (std::size_t j = raster.row.size(); j-- > 0;) {
        for (double& z : raster.row[j]) {
            std::string word;
            words >> word;
            const auto number = number_in(word);
            if (!number || std::isinf(*number)) {
                refuse(file, "a height is \"" + word + "\"");
            }
            const bool marked = head.count("nodata_value") != 0 && *number == head["nodata_value"];
            z = marked || is_missing(*number) ? nodata : *number;
        }
    }
    if (std::string word; words >> word) {
        refuse(file, "it has more heights than cells");
    }
    return raster;
}

// The places of grid lines among the coordinates of points, which files round: ascending, those
// nearer than a tenth of the widest gap are one.
std::vector<double> lines_of(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    double widest = 0;
    for (std::size_t k = 1; k < values.size(); ++k) {
        widest = std::max(widest, values[k] - values[k - 1]);
    }
    std::vector<double> lines;
    for (const double value : values) {
        if (lines.empty() || value - lines.back() > 0.1 * widest) {
            lines.push_back(value);
        }
    }
    return lines;
}

// Cells between the lines of one axis, if they are evenly spaced but for lines without points.
int steps_of(const std::filesystem::path& file, const std::vector<double>& lines)
{
    double least = lines.back() - lines.front();
    for (std::size_t k = 1; k < lines.size(); ++k) {
        least = std::min(least, lines[k] - lines[k - 1]);
    }
    const double steps = std::round((lines.back() - lines.front()) / least);
    const double cell = (lines.back() - lines.front()) / steps;
    for (const double line : lines) {
        const double place = (line - lines.front()) / cell;
        if (lines.size() < 2 || steps > 1e5 || std::abs(place - std::round(place)) > 0.1) {
            refuse(file, "its points are not those of a regular grid");
        }
    }
    return static_cast<int>(steps);
}

// Places and heights in lines: x y z, in any order; a first line may name them.
std::vector<Vec3> points_in(const std::filesystem::path& file, std::istream& lines)
{
    std::vector<Vec3> points;
    for (std::string line; std::getline(lines, line);) {
        line.resize(std::min(line.find('#'), line.size()));
        std::replace_if(
            line.begin(), line.end(), [](char c) { return c == ',' || c == ';'; }, ' ');
        std::istringstream words(line);
        std::vector<std::string> found;
        for (std::string word; words >> word;) {
            found.push_back(in_small(word));
        }
        if (found.empty() || (points.empty() && found.front() == "x")) {
            continue;
        }
        Vec3 p;
        for (std::size_t k = 0; k < 3; ++k) {
            const auto number = found.size() == 3 ? number_in(found[k]) : std::nullopt;
            if (!number || std::isinf(*number) || (k < 2 && std::isnan(*number))) {
                refuse(file, "expected a line x y z, found \"" + line + "\"");
            }
            p[static_cast<Eigen::Index>(k)] = *number;
        }
        points.push_back(p);
    }
    return points;
}

Raster raster_of(const std::filesystem::path& file, const std::vector<Vec3>& points, double nodata)
{
    std::array<std::vector<double>, 2> lines;
    for (std::size_t axis = 0; axis < 2; ++axis) {
        for (const Vec3& p : points) {
            lines[axis].push_back(p[static_cast<Eigen::Index>(axis)]);
        }
        lines[axis] = lines_of(std::move(lines[axis]));
        if (lines[axis].size() < 2) {
            refuse(file, "its points lie on one line");
        }
    }
    const int nx = steps_of(file, lines[0]), ny = steps_of(file, lines[1]);
    Raster raster{.west = lines[0].front(),
                  .south = lines[1].front(),
                  .dx = (lines[0].back() - lines[0].front()) / nx,
                  .dy = (lines[1].back() - lines[1].front()) / ny,
                  .columns = nx + 1,
                  .rows = ny + 1};
    if (raster.columns * 1.0 * raster.rows > 20.0 * static_cast<double>(points.size())) {
        refuse(file, "its points are not those of a regular grid");
    }
    raster.row.assign(static_cast<std::size_t>(ny) + 1,
                      std::vector<double>(static_cast<std::size_t>(nx) + 1, nodata));
    for (const Vec3& p : points) {
        const double u = (p.x() - raster.west) / raster.dx, v = (p.y() - raster.south) / raster.dy;
        const double i = std::round(u), j = std::round(v);
        if (std::abs(u - i) > 0.1 || std::abs(v - j) > 0.1) {
            refuse(file, "its points are not those of a regular grid");
        }
        raster.row.at(static_cast<std::size_t>(j)).at(static_cast<std::size_t>(i)) =
            is_missing(p.z()) ? nodata : p.z();
    }
    return raster;
}

// An ESRI ASCII grid, or points on a grid: their files begin with three numbers, or with x.
Raster read_raster(const std::filesystem::path& file, double nodata)
{
    const std::string bytes = bytes_of(file);
    std::istringstream words(bytes.starts_with("\xef\xbb\xbf") ? bytes.substr(3) : bytes);
    words >> std::ws;
    const auto begin = words.tellg();
    std::string first;
    while (words >> std::ws, words.peek() == '#') {
        std::getline(words, first);
    }
    words >> first;
    words.clear();
    words.seekg(begin);
    first.resize(std::min(first.find_first_of(",;"), first.size()));
    return number_in(first) || in_small(first) == "x"
               ? raster_of(file, points_in(file, words), nodata)
               : grid_in(file, words, nodata);
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
    for (const Vec3& corner : mesh.corners) {
        if (!corner.allFinite()) {
            throw std::runtime_error(grid.string() + ": the witness finds no height for a corner");
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
