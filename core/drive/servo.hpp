#pragma once
// A wall that holds a stress: moved so that the force of the spheres on it meets its target.

#include <cstddef>

#include "core/simulation.hpp"
#include "core/state/bytes.hpp"

namespace grainfield::core {

/// Servo for one wall. In a step the wall moves outwards by
///   gain * e/K + integral part,   e = force on the wall - target stress * area.
/// K is the stiffness of the wall's contacts as measured, so that no gain depends on the material.
/// The integral part follows a wall that must keep moving (shear) without lag; it stops growing
/// while the speed is capped. In this the wall is a membrane of the mass K h^2/integral behind a
/// dashpot, h the step: where spheres fall away from it, it follows as fast as that mass gains
/// speed under the target stress. Until it has touched a sphere it moves in at the capped speed.
///
/// The gains are those at which one sphere under the wall comes to rest at 0.8 of the stability
/// limit, for damping from 0.1 to 0.4 and, with the shorter step of StepControl, above. A sphere
/// held by the wall alone is stable for (omega h)^2 < 4 - 2 gain.
class WallServo {
  public:
    struct Options {
        double stress = 0;       ///< target, compression positive [Pa]
        double max_speed = 0;    ///< cap of the wall's speed, > 0 [m/s]
        double gain = 0.3;       ///< share of e/K answered in a step; 1 would be all of it [-]
        double integral = 0.06;  ///< growth of the integral part in a step [-]
        /// K is at least its running mean, of which the present step is this share: a wall that
        /// has kept few contacts is not taken for a soft one. With 1, K is that of the step and a
        /// wall that touches nothing moves at max_speed [-].
        double present = 0.01;
    };

    WallServo(std::size_t wall, const Options& options) : wall_(wall), options_(options) {}

    /// Sets the velocity of the wall for the coming step [s] from the present wall load. `area`
    /// is the wall's [m2]. Returns the relative error of the stress before the step.
    double steer(Simulation& simulation, double area, double step);

    /// Starts with the wall already moving outwards at this speed [m/s].
    void set_speed(double outward) { steady_speed_ = outward; }
    void set_options(const Options& options) { options_ = options; }
    const Options& options() const { return options_; }
    std::size_t wall() const { return wall_; }
    double steady_speed() const { return steady_speed_; }  ///< integral part [m/s]

    template <class Archive>
    void serialize(Archive& archive) {
        archive(bytes(wall_), bytes(options_), steady_speed_, stiffness_);
    }

  private:
    std::size_t wall_;
    Options options_;
    double steady_speed_ = 0;
    double stiffness_ = 0;  // running mean; 0: nothing was touched [N/m]
};

/// Compressive force of the spheres on a wall [N].
double wall_compression(const Simulation& simulation, std::size_t wall);

}  // namespace grainfield::core
