// SPDX-License-Identifier: MIT
// A results folder as the witness reads it: the resolved case and the histories, with readers of
// its own.
#pragma once

#include <Eigen/Dense>

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace witness {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Quat = Eigen::Quaterniond;

/// A closed surface of triangles that wind outwards [m].
struct Mesh {
    std::vector<Vec3> corners;
    std::vector<std::array<int, 3>> triangles;
};

enum class Kind { box, ball, cylinder, mesh, cubes, plane, basin, round_basin };

/// How a wall is displaced from where it stands at time 0.
struct Path {
    Vec3 velocity{0, 0, 0};    // [m/s], where `times` is empty
    std::vector<double> times; // [s]
    std::vector<Vec3> places;  // [m]
};

/// A body or a wall as the case says it. Lengths are in m; which are used follows from the kind.
struct Solid {
    std::string name;
    Kind kind = Kind::box;
    Vec3 size{0, 0, 0};         // box: edges
    double radius = 0;          // ball, cylinder, round basin
    double length = 0;          // cylinder: along its x axis
    Mesh mesh;                  // in its own axes; of a body about its centroid
    std::vector<Vec3> points;   // cubes: their centres, about their mean
    double edge = 0;            // cubes
    Vec3 low{0, 0, 0};          // basin
    Vec3 high{0, 0, 0};         // basin
    std::array<bool, 6> open{}; // basin: -x +x -y +y -z +z
    double thickness = 0;       // basin, round basin: of its closed sides
    Vec3 point{0, 0, 0};        // plane
    Vec3 normal{0, 0, 1};       // plane
    Vec3 position{0, 0, 0};     // at time 0
    Quat rotation = Quat::Identity();
    Path path; // of a wall
    std::optional<double>
        given;            // mass of a body, if the case gives it in place of the density [kg]
    double density = 0;   // of a body [kg/m3]
    Vec3 middle{0, 0, 0}; // of the shape of a body, from its centre of mass, in its axes [m]
    std::optional<Vec3>
        inertia;        // about the centre of mass, in its axes, if the case gives it [kg m2]
    double spacing = 0; // of the particles of a body
    bool held = false;  // a body that is fixed
};

struct Scene {
    int dimensions = 3;
    Vec3 gravity{0, 0, 0}; // [m/s2]
    double spacing = 0;    // of the fluid and of the walls [m]
    bool fluid = false;
    double rest_density = 0;      // [kg/m3]
    double particle_mass = 0;     // of the fluid; kg/m in two dimensions [kg]
    double smoothing_ratio = 1.5; // smoothing length over spacing
    bool penalty = false;         // the penalty method, whose contact lets bodies overlap
    std::vector<Solid> walls;
    std::vector<Solid> bodies;
};

struct State {
    Vec3 x{0, 0, 0}; // [m]
    Quat q = Quat::Identity();
    Vec3 v{0, 0, 0};   // [m/s]
    Vec3 w{0, 0, 0};   // [rad/s], world axes
    bool there = true; // it has not left the run through an open side
};

/// The bodies at one time, in the order of the case.
struct Row {
    double time = 0;
    std::vector<State> bodies;
};

/// A CSV file of the results: names of the columns and cells as text. Comments begin with #.
struct Table {
    std::vector<std::string> heads;
    std::vector<std::vector<std::string>> rows;
    /// Index of a column; none if it has none of that name.
    std::optional<std::size_t> column(const std::string& name) const;
    /// The numbers of a column; empty if there is none of that name.
    std::vector<double> numbers(const std::string& name) const;
};

/// One frame of the fluid, as far as the witness looks.
struct Frame {
    double time = 0;
    std::vector<Vec3> points;
    std::vector<Vec3> velocities;
    std::vector<double> densities;
    std::vector<double> volumes; // empty where the frame has none
    std::vector<double> masses;  // empty where the frame has none
    std::vector<std::int64_t> ids;
};

/// Reads `case.toml` as resolved. Throws std::runtime_error with the reason.
Scene read_scene(const std::filesystem::path& file);

/// Reads an STL or OBJ file, its numbers times `scale`; equal corners become one.
Mesh read_mesh(const std::filesystem::path& file, double scale);

/// Reads a CSV file; an empty table if it does not exist.
Table read_table(const std::filesystem::path& file);

/// The rows of bodies.csv. Throws std::runtime_error if a body of the scene is missing in a row.
std::vector<Row> read_rows(const std::filesystem::path& folder, const Scene& scene);

/// The files of the fluid's frames, ascending.
std::vector<std::filesystem::path> frame_files(const std::filesystem::path& folder);

/// Reads a frame with the HDF5 library.
Frame read_frame(const std::filesystem::path& file);

/// Where a wall stands at time t, from where it stood at time 0 [m]: along a path each component is
/// the monotone cubic of Fritsch and Butland (1984), which the case's documentation names.
Vec3 displacement(const Path& path, double t);

/// Whether it ever moves.
bool moves(const Path& path);

} // namespace witness
