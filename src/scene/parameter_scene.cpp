// SPDX-License-Identifier: MIT
// The keys of the whole case: time, resolution, domain, output and gauges.
#include "parameter_table.hpp"

namespace hyoryu {

namespace {

Parameter dimensions_row()
{
    return {.key = "dimensions",
            .kind = ValueKind::integer,
            .bounds = "2 or 3",
            .fallback = "3",
            .meaning =
                "3, or 2 for a case in the x-z plane whose masses and forces are per metre of "
                "width and whose y components are read and ignored.",
            .minimum = 2,
            .maximum = 3};
}

Parameter seed_row()
{
    return {.key = "seed",
            .kind = ValueKind::integer,
            .bounds = ">= 0",
            .fallback = "1",
            .meaning = "Seed of everything random; the same seed gives the same bits.",
            .minimum = 0};
}

Parameter gauge_place_row()
{
    Parameter row = vector_row("gauge[].at", "m", "",
                               "Where it measures: a point, the x and y of the vertical line of an "
                               "elevation gauge, or any point of the plane of a flux gauge.");
    row.shortest = 2;
    return row;
}

std::vector<Parameter> gauge_parameters()
{
    return {
        tables_row("gauge", "An instrument: columns of gauges.csv."),
        text_row("gauge[].name", "gauge.1, gauge.2 ...", "Name of the column; unique."),
        choice_row(
            "gauge[].type", {"elevation", "pressure", "velocity", "force", "front", "flux"},
            required,
            "What is measured: the water level over a place (at), pressure or velocity at a "
            "point (at), the force of the fluid on a wall or body with the impulses of fluid and "
            "contact (on), how far the water has come along an axis (axis), or the volume that "
            "passes a plane in a second (at, normal)."),
        gauge_place_row(),
        positive("gauge[].area", "", "",
                 "Area of the face of a pressure sensor, over which it averages [m2]; its length "
                 "[m] in 2-D. Without it the pressure is that at a point."),
        vector_row("gauge[].normal", "", "",
                   "Direction that the face of a pressure sensor looks in, or in which a flux "
                   "counts as positive; of any length."),
        text_row("gauge[].on", "", "The wall or body on which forces are measured, by its name."),
        choice_row("gauge[].axis", {"x", "y", "z"}, "x",
                   "The axis along which the front is followed."),
        choice_row("gauge[].filter", {"none", "mean", "median", "exponential"}, "none",
                   "A column of filtered readings beside the raw ones, named NAME_mean and so on: "
                   "mean or median of the last `window` seconds, or the mean with weights that "
                   "fall as exp(-age/window)."),
        positive("gauge[].window", "s", "", "Window of the filter."),
    };
}

} // namespace

std::vector<Parameter> general_parameters()
{
    return {
        text_row("title", "", "A line that names the case in reports and pictures."),
        dimensions_row(),
        vector_row("gravity", "m/s2", "[0.0, 0.0, -9.81]", "Acceleration of gravity; z is up."),
        seed_row(),
        table_row("time", "How long is simulated, and in which steps."),
        positive("time.end", "s", required, "Simulated time at which the run ends."),
        positive(
            "time.step", "s", "",
            "A fixed time step; without it every step is as long as the limits of sound speed, "
            "viscosity and force allow."),
        positive("time.cfl", "", "0.6",
                 "Factor on the limits of the adaptive time step; smaller is safer and slower."),
        {.key = "time.recover",
         .kind = ValueKind::boolean,
         .fallback = "false",
         .meaning = "When the numbers go wrong, goes back to the last frame and on with half the "
                    "time step, at most five times. What was written since is taken back, and "
                    "`run.log` says so."},
        table_row("particles", "The resolution."),
        positive(
            "particles.spacing", "m", required,
            "Distance between the particles of fluid and walls at the start: the resolution of "
            "the run."),
        choice_row("particles.precision", {"single", "double"}, "single",
                   "The number of the arithmetic between pairs of particles; state and bodies are "
                   "double in either case. \"double\" is for verification and takes about twice "
                   "the time."),
        table_row("domain",
                  "The box outside which particles leave the run; without it the bounds of "
                  "the scene."),
        vector_row("domain.min", "m", required, "Lower corner of the domain."),
        vector_row("domain.max", "m", required, "Upper corner of the domain."),
        texts_row("domain.periodic", {}, "[]",
                  "Directions, of \"x\", \"y\", \"z\", in which the domain repeats itself: what "
                  "leaves on "
                  "one side enters on the other. For scenes without bodies and moving walls."),
    };
}

std::vector<Parameter> output_parameters()
{
    std::vector<Parameter> rows = gauge_parameters();
    const std::vector<Parameter> output = {
        table_row("output", "What is written, and how often."),
        positive("output.every", "s", "time.end / 100", "Simulated time between two frames."),
        not_negative("output.history_every", "s", "0",
                     "Simulated time between two rows of the CSV histories; 0 is every step."),
        not_negative("output.gauge_every", "s", "output.history_every",
                     "Simulated time between two rows of gauges.csv; 0 is every step."),
        texts_row("output.fields",
                  {"velocity", "pressure", "density", "volume", "id", "kind", "body"}, "[]",
                  "What each particle of a frame carries besides its place; an empty list is the "
                  "default set."),
        positive("output.checkpoint_every", "s", "600",
                 "Wall-clock time between two checkpoints, from which `run --resume` goes on."),
    };
    rows.insert(rows.end(), output.begin(), output.end());
    return rows;
}

} // namespace hyoryu
