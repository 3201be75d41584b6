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
    /// core::box_walls().
    ShearStage(core::Driver& driver, const TriaxialOptions& options, const FailureRule& rule = {});

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
    void watch_servos(double error);
    bool record();
    bool may_end();
    double axial_strain() const;

    core::Driver& driver_;
    TriaxialOptions options_;
    Vec3 start_size_;
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
    double next_strain_ = 0;
    // Servo quality.
    double square_error_sum_ = 0, max_error_ = 0;
    int steps_off_ = 0;  // in a row
};

}  // namespace grainfield::triaxial
