// SPDX-License-Identifier: MIT
// Time of impact: bracketing and root finding (Illinois method) for the smallest gap of each pair,
// without the features in `held`.
#include "sub_step.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

// A gap is an event when it is below this at the end of the sub-step [units].
constexpr double closed = -1e-10;
// Two polytopes in contact may describe the same contact by other features a moment later; only a
// gap below this bound is a new contact [units].
constexpr double closed_in_contact = -1e-6;
// A pair that is closed throughout the interval, for instance after a contact was released, is an
// event once it overlaps more by this [units].
constexpr double closed_again = -1e-7;
constexpr double located = 1e-11; // gap at the time found [units]
constexpr int root_steps = 60;
// Halvings of the time at which a contact that has just bounced off is found open.
constexpr int open_halvings = 40;
// Rotation above which the middle of the sub-step is sampled as well [rad].
constexpr double half_look = 0.1;
constexpr int most_looks = 1024;

class EventSearch {
public:
    EventSearch(const StepContext& context, const SubStep& sub)
        : memory_(context.memory), sub_(sub), unit_(context.rigid.settings.unit)
    {
    }

    double first()
    {
        const int looks = count_looks();
        for (int look = 1; look <= looks; ++look) {
            const double low = sub_.h * (look - 1) / looks;
            double high = sub_.h * look / looks;
            bool found = false;
            place_all(high);
            for (const BodyPair& pair : sub_.cluster.pairs) {
                if (exceeds_event_limit(memory_, pair.a, pair.b) || !closes(pair, high)) {
                    continue;
                }
                const double root = closing_time(pair, low, high);
                if (root < high || !found) {
                    high = root;
                    found = true;
                }
                place_all(high);
            }
            if (found) {
                return high;
            }
        }
        return sub_.h;
    }

private:
    void place(int body, double s)
    {
        if (body >= 0 && memory_.rotors[body].movable) {
            memory_.trial[body] = s < sub_.h ? pose_at(memory_.paths[body], memory_.rotors[body], s)
                                             : memory_.end[body];
        }
    }

    void place_all(double s)
    {
        for (const int body : sub_.cluster.bodies) {
            place(body, s);
        }
    }

    bool holds(const BodyPair& pair) const
    {
        const auto first = std::lower_bound(memory_.held.begin(), memory_.held.end(), pair,
                                            [](const Feature& f, const BodyPair& p) {
                                                return std::pair(f.a, f.b) < std::pair(p.a, p.b);
                                            });
        return first != memory_.held.end() && first->a == pair.a && first->b == pair.b;
    }

    bool held(const Feature& feature) const
    {
        return std::binary_search(memory_.held.begin(), memory_.held.end(), feature);
    }

    // Velocity of a point of a body, or of a wall, along its path.
    Vec3 velocity_at(int k, const Vec3& point, double s) const
    {
        if (k < 0) {
            return wall_velocity(memory_, k, sub_.time + s);
        }
        const Path& path = memory_.paths[k];
        const SolidPose& pose = memory_.trial[k];
        const double part = s / path.h;
        const Vec3 L = path.L0 + part * (path.L1 - path.L0);
        const Vec3 omega = inverse_inertia(memory_.rotors[k], pose.R) * L;
        return path.v0 + part * (path.v1 - path.v0) + omega.cross(point - pose.x);
    }

    double approach_speed(const Candidate& c, double s) const
    {
        return c.touch.normal.dot(velocity_at(c.feature.b, c.touch.point, s) -
                                  velocity_at(c.feature.a, c.touch.point, s));
    }

    // Whether the pair has closed at the trial poses. A feature that approaches fast enough to
    // bounce always counts as a new contact.
    bool closes(const BodyPair& pair, double s)
    {
        if (!has_axis(pair, memory_.geometry) || !holds(pair)) {
            return clearance(pair, s) < closed * unit_;
        }
        memory_.work += look_work;
        const Configuration at = configuration(memory_, memory_.trial, sub_.time + s);
        return std::ranges::any_of(look_at(memory_, pair, at), [&](const Candidate& c) {
            return c.touch.gap < closed * unit_ && !held(c.feature) &&
                   (c.touch.gap < closed_in_contact * unit_ || approach_speed(c, s) > sub_.slow);
        });
    }

    // The smallest gap of the pair at the trial poses, without the features in `held`.
    double clearance(const BodyPair& pair, double s)
    {
        const Configuration at = configuration(memory_, memory_.trial, sub_.time + s);
        memory_.work += look_work;
        if (has_axis(pair, memory_.geometry) && !holds(pair)) {
            return axis_distance(pair, at);
        }
        double smallest = infinity;
        for (const Candidate& c : look_at(memory_, pair, at)) {
            if (c.touch.gap < smallest && !held(c.feature)) {
                smallest = c.touch.gap;
            }
        }
        return smallest;
    }

    double clearance_at(const BodyPair& pair, double s)
    {
        place(pair.a, s);
        place(pair.b, s);
        return clearance(pair, s);
    }

    // The time in the interval at which an open pair closes. For a pair that is closed throughout,
    // the time at which its overlap has grown by `closed_again`.
    double closing_time(const BodyPair& pair, double low, double high)
    {
        const double zero = located * unit_;
        const double f_high = clearance_at(pair, high);
        double f_low = clearance_at(pair, low);
        if (f_low > zero) {
            return root(pair, {low, high, f_low, f_high}, 0);
        }
        for (int k = 1; k <= open_halvings; ++k) {
            const double s = low + (high - low) * std::ldexp(1.0, -k);
            const double f = clearance_at(pair, s);
            if (f > zero) {
                return root(pair, {s, high, f, f_high}, 0);
            }
        }
        const double deeper = f_low + closed_again * unit_;
        return f_high < deeper ? root(pair, {low, high, f_low, f_high}, deeper) : high;
    }

    struct Bracket {
        double low = 0, high = 0;     // [s]
        double f_low = 0, f_high = 0; // clearance [m]
    };

    // Illinois method for the time at which the clearance is `level`; bisection when a feature
    // changes in between.
    double root(const BodyPair& pair, Bracket at, double level)
    {
        at.f_low -= level;
        at.f_high -= level;
        int side = 0;
        for (int k = 0; k < root_steps; ++k) {
            const bool finite = at.f_low < infinity && at.f_high > -infinity;
            const bool bisect = !finite || k % 3 == 2;
            double s = bisect ? 0.5 * (at.low + at.high)
                              : at.low + (at.high - at.low) * at.f_low / (at.f_low - at.f_high);
            s = std::clamp(s, at.low, at.high);
            const double f = clearance_at(pair, s) - level;
            if (std::abs(f) < located * unit_) {
                return s;
            }
            if (f > 0) {
                at.low = s;
                at.f_low = f;
                at.f_high *= side == 1 ? 0.5 : 1;
                side = 1;
            } else {
                at.high = s;
                at.f_high = f;
                at.f_low *= side == -1 ? 0.5 : 1;
                side = -1;
            }
        }
        return at.high;
    }

    // Number of samples such that no body turns or moves past another between two of them.
    int count_looks() const
    {
        double looks = 1;
        for (const int k : sub_.cluster.bodies) {
            const double turn = sub_.h * (memory_.rotors[k].inverse_moments.maxCoeff() *
                                          memory_.paths[k].L1.norm());
            looks = std::max(looks, turn > half_look ? 2.0 : 1.0);
        }
        for (const BodyPair& pair : sub_.cluster.pairs) {
            if (pair.b >= 0 || !memory_.geometry.walls[-1 - pair.b].plane) {
                looks = std::max(looks, std::ceil(relative_travel(pair) / thickness(pair)));
            }
        }
        return static_cast<int>(std::min<double>(looks, most_looks));
    }

    double relative_travel(const BodyPair& pair) const
    {
        const auto velocity = [&](int k) {
            return k < 0 ? wall_velocity(memory_, k, sub_.time)
                         : (memory_.rotors[k].movable ? memory_.paths[k].v1 : Vec3::Zero());
        };
        const double speed = (velocity(pair.a) - velocity(pair.b)).norm();
        // A triangle may be smaller than the path of the end of a turning body.
        const bool mesh = pair.b < 0 && !memory_.geometry.walls[-1 - pair.b].mesh.triangles.empty();
        return sub_.h * (speed + (mesh ? tip_speed(pair.a) : 0));
    }

    double tip_speed(int k) const
    {
        return memory_.rotors[k].inverse_moments.maxCoeff() * memory_.paths[k].L1.norm() *
               memory_.geometry.solids[k].reach;
    }

    double thickness(const BodyPair& pair) const
    {
        const Solid& b = pair.b >= 0 ? memory_.geometry.solids[pair.b]
                                     : memory_.geometry.walls[-1 - pair.b].solid;
        return memory_.geometry.solids[pair.a].thickness + b.thickness;
    }

    ContactMemory& memory_;
    const SubStep& sub_;
    double unit_; // of tolerances [m]
};

} // namespace

double first_event(const StepContext& context, const SubStep& sub)
{
    return EventSearch(context, sub).first();
}

} // namespace hyoryu
