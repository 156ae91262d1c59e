// SPDX-License-Identifier: MIT
// What the scenes read off a run.
#pragma once

#include "scene.hpp"

namespace hyoryu::bench {

/// Height of body 0 against an exact z(t), root mean square until `until` [mm].
Metric rms_height(const std::string& name, double until, std::function<double(double)> exact);
/// Height of the k-th (from 1) apex of body 0 [mm]. NaN if there are fewer.
Metric apex(int k, double exact);
/// Largest angle between the z axes of body 0 now and at the start [mrad].
Metric largest_tilt();
/// A number of body 0 at one time.
Metric at_time(const std::string& name, const std::string& unit, double time, double exact,
               std::function<double(const State&)> number);
/// Distance between body 0 and a given place at one time [mm].
Metric distance_at(double time, const Vec3& place);
/// Length of body 0's way over the run [mm].
Metric travel(const std::string& name, double exact);
/// Mean acceleration of body 0 along its way between two times [m/s2].
Metric mean_acceleration(double from, double to, double exact);
/// Way of the last body in the horizontal, and how far it sank [mm].
Metric top_drift();
Metric top_sink();
/// Mean kinetic energy of all bodies over the second half of the run [J].
Metric late_energy();
/// The deepest that any corner of a box, body 0, reached below z = 0 [mm], as a height: negative.
Metric deepest_corner();

} // namespace hyoryu::bench
