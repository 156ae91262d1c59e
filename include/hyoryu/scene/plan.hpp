// SPDX-License-Identifier: MIT
// The effects that will run, and why: inferred from the scene before anything is computed, never
// changed after.
#pragma once

#include "hyoryu/fluid/fluid.hpp"
#include "hyoryu/scene/fill.hpp"

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hyoryu {

struct Plan {
    /// An effect that runs, or does not, and the reason in the scene.
    struct Effect {
        std::string name;
        std::string why;
    };
    /// A column of the particle store.
    struct FieldUse {
        std::string name;
        std::string unit;
        std::size_t bytes_per_particle = 0;
        bool of_fluid_alone = false;  // solid particles have none
        bool of_solids_alone = false; // fluid particles have none
        Index rows = 0;               // particles that have it
        std::size_t bytes() const { return bytes_per_particle * at(rows); }
        /// "" for all particles.
        std::string_view holders() const
        {
            return of_fluid_alone ? "  fluid only" : of_solids_alone ? "  solids only" : "";
        }
    };
    struct PairKind {
        std::string name; // "fluid<-fluid": who gathers from whom
        std::string why;
    };
    struct GaugeUse {
        std::string name;
        std::string what;    // it reads, and where
        std::string columns; // of gauges.csv
    };
    struct Counts {
        Index fluid = 0, wall = 0, body = 0; // particles
        Index bodies = 0, walls = 0;
        Index drawn = 0; // points of bodies in frames, also where no fluid is
        Index particles() const { return fluid + wall + body; }
    };

    struct OpenUse {
        std::string name;
        std::string what; // it does, and where
        Index carpet = 0; // rows of its carpet at most
    };

    /// Two materials that can meet. The mixing rule: the entry of `contact.pair` that names both,
    /// else the values of `[contact]`; nothing is averaged.
    struct MaterialContact {
        std::array<std::string, 2> materials; // of a body and of its partner; "" if unnamed
        double restitution = 0;               // [1]
        double friction = 0;                  // [1]
        std::optional<double> stiffness;      // [N/m], for the force formulae of reports only
        bool listed = false;                  // by `contact.pair`
    };

    /// How a body floats, for `check`.
    struct FloatingBody {
        std::string name;      // of the first of equal bodies
        Index count = 1;       // of them
        double draft = 0;      // as it is placed [m]
        double spacings = 0;   // draft over spacing
        double metacentre = 0; // GM as it is placed, the least [m]; NaN where it sinks
        std::string comes_to;  // "floats upright", "turns by 58 deg: its +y side up" ...
    };
    /// Consequences of the resolution and the speed of sound at the scale of the scene.
    struct Scale {
        double depth = 0;         // of the water at the start, the greatest [m]
        double layers = 0;        // spacings in it
        double thinnest = 0;      // body [m]; 0: none
        double speed = 0;         // largest expected speed [m/s]
        double shortest_load = 0; // 4 dp / c0 [s]
        double viscosity = 0;     // of the scheme [m2/s]
        double reynolds = 0;      // speed depth / viscosity; infinity without viscosity
        std::vector<std::string> absent;
    };

    std::vector<Effect> on;
    std::vector<Effect> off;
    std::vector<FloatingBody> floating;
    std::optional<Scale> scale; // none without fluid
    std::vector<FieldUse> fields;
    std::vector<PairKind> pair_kinds;
    std::vector<MaterialContact> materials; // by name
    std::vector<GaugeUse> gauges;
    double gauge_rows = 0;  // of gauges.csv
    double gauge_looks = 0; // at particles, for one row
    Counts counts;
    std::vector<TimeLimit> limits; // of the first step
    double first_step = 0;         // [s]
    double expected_steps = 0;
    double expected_speed = 0; // largest, without bodies [m/s]; 0 without fluid
    double memory = 0;         // [B]
    double frame_bytes = 0;    // of all files of one frame, before compression [B]
    double frames = 0;
    std::vector<Diagnostic> warnings;

    // Input of the solver.
    std::optional<FluidParameters> fluid;
    FluidEffects effects;
    bool rigid = false;   // bodies move
    bool contact = false; // bodies may meet something

    std::vector<OpenUse> open;
    Index most_fluid = 0; // rows of fluid that open sides may bring at once; 0 without them

    bool runs(std::string_view effect) const;
};

/// Throws CaseError if an effect is on that this build lacks (`without`), so that no effect is left
/// out silently.
void expect_built(const Plan& plan, std::span<const std::string_view> without);

/// Infers the plan. Throws CaseError for faults that only the filled scene shows: bodies that
/// overlap each other or a wall, a fixed time step beyond the stability limit, a fluid without
/// particles; and for effects that are not part of this build.
/// Processes that share the filling call it together, each with its part of the filling, and get
/// the same plan; `comm` is null for one process.
Plan make_plan(const Scene& scene, const Filling& filling, Comm* comm = nullptr);

/// Bytes of neighbour lists a particle of full support: one for each of the lattice points within
/// the list radius (support and skin), and some for padding and list heads.
double list_bytes(const FluidParameters& fluid);

} // namespace hyoryu
