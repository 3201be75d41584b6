#include "core/drive/servo.hpp"

#include <algorithm>

namespace grainfield::core {

double wall_compression(const Simulation& simulation, std::size_t wall) {
    return -simulation.wall_loads()[wall].force.dot(simulation.walls()[wall].normal);
}

double WallServo::steer(Simulation& simulation, double area, double step) {
    const double target = options_.stress * area;
    const double error = wall_compression(simulation, wall_) - target;
    const double present = simulation.wall_loads()[wall_].stiffness;
    if (stiffness_ == 0)
        stiffness_ = present;
    else if (present > 0 || options_.present == 1)
        stiffness_ += options_.present * (present - stiffness_);
    double speed = -options_.max_speed;  // nothing touches: close the gap
    if (stiffness_ > 0) {
        const double answer = error / std::max(present, stiffness_) / step;
        const double grown = steady_speed_ + options_.integral * answer;
        const double wanted = options_.gain * answer + grown;
        speed = std::clamp(wanted, -options_.max_speed, options_.max_speed);
        if (speed == wanted) steady_speed_ = grown;
    }
    const Vec3& normal = simulation.walls()[wall_].normal;
    simulation.set_wall_velocity(wall_, -speed * normal);
    return error / target;
}

}  // namespace grainfield::core
