#pragma once
// The shear stage: the top wall moves down, four side walls hold the confining stress.

#include <cstdint>
#include <string>
#include <vector>

#include "core/drive/driver.hpp"
#include "core/drive/servo.hpp"
#include "triaxial/config/config.hpp"
#include "triaxial/realization/failure.hpp"

namespace grainfield::triaxial {

class ShearStage {
  public:
    /// The simulation must be at rest under the isotropic stress, its first six walls those of
    /// core::box_walls(). `density` is that of the spheres [kg/m3]; rule.transient_strain is the
    /// axial strain within one inertial time d sqrt(rho/sigma_3).
    ShearStage(core::Driver& driver, const TriaxialOptions& options, double density,
               const FailureRule& rule);

    /// Shears until max_axial_strain, or until the sample has surely failed.
    void run();

    const std::vector<CurvePoint>& curve() const { return curve_; }
    /// The name of what reached_failure() found, or ended_as_asked.
    const std::string& end_reason() const { return end_reason_; }
    std::int64_t steps() const { return steps_; }            ///< [-]
    double time() const { return time_; }                    ///< [s]
    double lateral_rms_error() const;                        ///< over all steps [-]
    double lateral_max_error() const { return max_error_; }  ///< at recorded points [-]

  private:
    template <class Archive>
    void archive_state(Archive& archive);
    void start_affine();
    void steer(double step);
    void watch_servos(double error, double step);
    bool record();
    bool may_end();
    double axial_strain() const;
    double own_weight_stress() const;

    core::Driver& driver_;
    TriaxialOptions options_;
    Vec3 start_size_;
    double weight_ = 0;  // of the spheres; 0 without gravity [N]
    std::vector<core::WallServo> servos_;
    std::vector<CurvePoint> curve_;
    FailureRule rule_;
    double highest_ = 0;  // deviator stress so far, for the progress line
    std::string end_reason_;
    std::int64_t steps_ = 0;
    double time_ = 0;
    // Since the last recorded point.
    Vec3 stress_sum_ = Vec3::Zero();
    std::int64_t stress_count_ = 0;
    double square_error_sum_ = 0;
    double next_strain_ = 0;
    // Servo quality.
    double inertial_time_;                          // [s]
    double all_square_errors_ = 0, max_error_ = 0;  // up to the last recorded point; at points
    double time_off_ = 0, strain_when_off_ = 0;     // in a row, and the strain when it began
};

}  // namespace grainfield::triaxial
