// SPDX-License-Identifier: MIT
// The scene: the case file as plain data, after reading, checking and filling in defaults. It has
// no state of the simulation. `fill` places the particles of a Scene, and `make_plan` selects the
// effects, fields and limits of the run.
#pragma once

#include "hyoryu/core/error.hpp"
#include "hyoryu/core/motion.hpp"
#include "hyoryu/core/types.hpp"
#include "hyoryu/fluid/effects.hpp"
#include "hyoryu/fluid/parameters.hpp"
#include "hyoryu/geometry/height_grid.hpp"
#include "hyoryu/geometry/outline.hpp"
#include "hyoryu/rigid/law.hpp"
#include "hyoryu/scene/open_settings.hpp"
#include "hyoryu/scene/place.hpp"

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace hyoryu {

// Shapes. A body's shape is given about its middle, the centre of its volume; a wall's or a fluid
// block's in space.

struct BoxShape {
    Vec3 size{0, 0, 0}; // edge lengths [m]; in two dimensions y is ignored
};
struct SphereShape {
    double radius = 0; // [m]; a disc in two dimensions
};
struct CylinderShape {
    double radius = 0; // [m]
    double length = 0; // [m], along the body's x axis; a rectangle in two dimensions
};
/// A closed triangle surface (STL, OBJ, a height grid or a prism), made and checked when the case
/// is read.
struct MeshShape {
    std::string file;
    double scale = 1;
    std::optional<TerrainPatch> terrain;       // if the file is a height grid
    std::optional<PrismOutline> prism;         // of a prism, which has no file
    std::vector<Vec3> corners;                 // [m], scaled
    std::vector<std::array<int, 3>> triangles; // outward orientation
};
/// A body given as its own particles, each a cube of the edge of their spacing; in three
/// dimensions.
struct ParticleShape {
    std::string file;
    double spacing = 0;       // [m]
    std::vector<Vec3> points; // about their mean [m]
    /// The union of the cubes as axis-aligned boxes {lower corner, upper corner} that do not
    /// overlap, where they lie on one lattice; else every cube by itself [m].
    std::vector<std::array<Vec3, 2>> boxes;
};
using Shape = std::variant<BoxShape, SphereShape, CylinderShape, MeshShape, ParticleShape>;

struct TimeSettings {
    double end = 0;             // [s]
    std::optional<double> step; // fixed time step [s]; none: adaptive
    double cfl = 0.6;           // scales the adaptive limits
    bool recover = false;       // when the numbers go wrong, go back and halve the step
};

struct DomainSettings {
    Vec3 min{0, 0, 0};              // [m]
    Vec3 max{0, 0, 0};              // [m]
    std::array<bool, 3> periodic{}; // x y z
};

/// Water at rest in all places that are connected with a seed, below a level and outside of walls.
struct SeededWater {
    double level = 0;   // z [m]
    Vec3 seed{0, 0, 0}; // [m]; z is not read
};

/// A region that is filled with fluid particles at the start.
struct FluidBlock {
    std::optional<SeededWater> seeded; // its shape is the box about it
    Shape shape;
    Vec3 centre{0, 0, 0}; // of the shape [m]
    Quat rotation = Quat::Identity();
    /// Filled in layers at half a spacing, one and a half, ... below its surface, as bodies are.
    bool layers = false;
    Vec3 velocity{0, 0, 0}; // [m/s]
    /// Expressions of x, y, z [m] for its components [m/s], in place of `velocity`; or none.
    std::vector<std::string> velocity_field;
    /// Expression of x, y, z [m] for the pressure above the hydrostatic one [Pa]; may be empty.
    std::string pressure_field;
    Place place;
};

struct FluidSettings {
    FormulationKind formulation = FormulationKind::sph;
    double density = 1000.0;           // rho_0 [kg/m3]
    std::optional<double> sound_speed; // c_0 [m/s]; none: 10 x the largest expected speed
    GradientSettings gradient;
    WallContinuitySettings continuity;
    SlipSettings walls;
    Vec3 acceleration{0, 0, 0}; // besides gravity [m/s2]
    FluidChoices effects;
    double smoothing_ratio = 1.5;               // h / spacing [1]
    KernelShape kernel = KernelShape::wendland; // of gradients
    std::vector<FluidBlock> blocks;
};

/// An infinite plane for bodies, clipped to the domain for the fluid.
struct PlaneWall {
    Vec3 point{0, 0, 0};  // [m]
    Vec3 normal{0, 0, 1}; // unit, into the free space
};
/// The inside of a box; the sides named open have no wall, the others are slabs outside it.
struct BasinWall {
    Vec3 min{0, 0, 0};               // [m]
    Vec3 max{0, 0, 0};               // [m]
    std::array<bool, 6> open{};      // -x +x -y +y -z +z
    std::optional<double> thickness; // of the sides [m]; none: that of the rows of wall particles
};
/// The inside of a sphere, of a circle in two dimensions, for the fluid; bodies meet the box about
/// it.
struct RoundWall {
    Vec3 centre{0, 0, 0}; // [m]
    double radius = 0;    // [m]
};
/// A solid obstacle.
struct SolidWall {
    Shape shape;
    Vec3 centre{0, 0, 0}; // of the shape [m]
    Quat rotation = Quat::Identity();
};

/// The wave that a piston is to make.
struct PistonTarget {
    double height = 0; // of the wave [m]
    double length = 0; // [m]; 0: no wave is asked for
    double depth = 0;  // of the water at rest [m]
    double period = 0; // of regular waves [s]; 0: a solitary wave
};

struct Wall {
    std::string name;
    std::variant<PlaneWall, BasinWall, RoundWall, SolidWall> geometry;
    std::string material; // empty: none named
    double manning = 0;   // roughness of its bed n [s/m^(1/3)]; 0: none
    Motion motion;        // of [wall.motion]
    PistonTarget wave;    // of its piston, which a resolved case has as a path
    Place place;
    std::string table; // of the case file: "wall[2]", counted from 0; may be empty
};

/// A box in which the fluid is brought to a velocity, more and more towards one side. It has a
/// depth or a rate.
struct Sponge {
    Vec3 min{0, 0, 0};              // [m]
    Vec3 max{0, 0, 0};              // [m]
    int side = 1;                   // of the strongest damping: 0 -x, 1 +x, 2 -y, 3 +y
    std::optional<double> depth;    // of the water at rest, which gives the rate [m]
    std::optional<double> rate;     // of damping at the side [1/s]
    Vec3 velocity{0, 0, 0};         // of the fluid when it leaves the sponge, mean over z [m/s]
    bool parabolic = false;         // over z, between two plates at its lower and upper side
    std::optional<double> pressure; // to which the fluid relaxes, at `min`, hydrostatic above [Pa]
    Place place;
};

struct BodySettings {
    std::string name;
    Shape shape;
    double density = 0;     // [kg/m3]; derived when a mass is given
    double mass = 0;        // [kg], kg/m in two dimensions; derived when a density is given
    Vec3 position{0, 0, 0}; // of the centre of mass [m]
    Quat rotation = Quat::Identity();   // body to world
    std::optional<Vec3> centre_of_mass; // from the middle of the shape, body axes [m]
    std::optional<Vec3> inertia;        // Ixx, Iyy, Izz about it, body axes [kg m2]
    Vec3 velocity{0, 0, 0};             // [m/s]
    Vec3 angular_velocity{0, 0, 0};     // world axes [rad/s]
    double spacing = 0;                 // of its particles [m]; the scene's unless the user set one
    std::string material;
    bool fixed = false;
    bool sealed = false;         // no water gets under it while it stands: `stands = "sealed"`
    std::array<bool, 6> locks{}; // x y z rx ry rz, in world axes
    Place place;
    std::string table; // of the case file, which copies share: "body[2]", "debris[0]"; may be empty
};

struct MaterialPair {
    std::array<std::string, 2> materials;
    double restitution = 0;          // [1]
    double friction = 0;             // [1]
    std::optional<double> stiffness; // [N/m], for the force formulae of reports only
};

struct ContactSettings {
    ImpactLaw law = ImpactLaw::coupled;       // of the impulse method
    std::optional<PenaltyParameters> penalty; // the penalty method; none: the impulse method
    // Of every pair that no entry of `pairs` names [1]; the penalty method does not read it.
    double restitution = 0.4;
    double friction = 0.3; // dynamic Coulomb coefficient [1]
    // Largest cost of locating impacts in time within a step, of the impulse method, relative to
    // the cost of the fluid [1].
    double locating_share = 0.2;
    std::vector<MaterialPair> pairs;
};

enum class GaugeType { elevation, pressure, velocity, force, front, flux };
/// The filter written beside the readings: their mean or median over the last `window` seconds, or
/// their mean with weights exp(-age/window).
enum class GaugeFilter { none, mean, median, exponential };

struct Gauge {
    std::string name;
    GaugeType type = GaugeType::elevation;
    Vec3 at{0, 0, 0};     // [m]; elevation uses x, y; flux: any point of its plane
    double area = 0;      // pressure: of the sensor's face [m2], m in two dimensions; 0: a point
    Vec3 normal{1, 0, 0}; // pressure: of that face; flux: of the plane, unit
    std::string on;       // force: the name of a wall or body
    int axis = 0;         // front: 0 x, 1 y, 2 z
    GaugeFilter filter = GaugeFilter::none;
    double window = 0; // of the filter [s]
    Place place;
};

struct OutputSettings {
    double every = 0;                // s between frames; 0: end / 100
    double history_every = 0;        // s between rows of the histories; 0: every step
    double gauge_every = 0;          // s between rows of the gauges; 0: every step
    std::vector<std::string> fields; // of the frames; empty: the default set
    double checkpoint_every = 600;   // s of wall time
};

struct Scene {
    std::filesystem::path file;         // as the user named it
    std::vector<std::string> overrides; // `--set` as the user gave them, for messages
    std::string title;
    int dimensions = 3;
    Vec3 gravity{0, 0, -9.81}; // [m/s2]
    std::uint64_t seed = 1;
    TimeSettings time;
    double spacing = 0; // [m], of fluid and walls
    Precision precision = Precision::single_precision;
    std::int64_t most_fluid = 0; // particles that open sides may bring it to; 0: as memory allows
    std::optional<DomainSettings> domain;
    std::optional<FluidSettings> fluid;
    std::vector<Wall> walls;
    std::vector<Sponge> sponges;
    std::vector<BodySettings> bodies; // copies written out
    ContactSettings contact;
    std::vector<Gauge> gauges;
    OutputSettings output;
    std::vector<OpenSettings> open;  // sides through which fluid enters and leaves
    std::vector<Diagnostic> notices; // of the reader: warnings of the plan
};

/// How the grid of the first wall that is terrain lies in the case; none without a terrain.
const TerrainPatch* terrain_patch_of(const Scene& scene);

} // namespace hyoryu
