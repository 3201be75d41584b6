#pragma once
// The time step of a run, and the masses it needs.

#include <cstdint>
#include <string>

#include "core/drive/frequency.hpp"
#include "core/simulation.hpp"
#include "core/solver_options.hpp"

namespace grainfield::core {

/// Chooses the step: fixed, or safety * 2/omega_max, estimated anew now and then as contacts form.
///
/// With mass scaling X, spheres whose own frequency is too high for a step X times larger get the
/// mass (and inertia) that it needs; gravity keeps acting on the real mass.
class StepControl {
  public:
    explicit StepControl(const TimeOptions& options) : options_(options) {}

    /// Step for the coming advance() [s]; forces must be current. May change the inertia of the
    /// spheres (mass scaling).
    double next(Simulation& simulation);

    /// True if next() will look at the contacts: forces must be current then.
    bool due(const Simulation& simulation) const {
        return next_estimate_ < 0 || simulation.steps() >= next_estimate_ ||
               other_contacts(simulation);
    }

    /// The present limit 2/omega_max with the inertia in use [s]; 0 before the first estimate.
    double limit() const { return omega_ > 0 ? 2.0 / omega_ : 0.0; }
    /// A fixed step is only watched: the lowest limit 2/omega_max found so far where it was longer
    /// than that [s]; 0: it never was. Of the contacts at the start, every 200 steps, and among few
    /// spheres whenever others touch.
    double exceeded_limit() const { return exceeded_; }
    /// "the time step of 1e-2 s is above the stability limit of 9.3e-3 s"; empty: it is not.
    std::string exceeded_text() const;
    /// Inertia of all spheres over their real mass, 1 without scaling [-].
    double inertia_ratio() const { return inertia_ratio_; }
    /// Forces a full estimate at the next step (properties or walls have changed).
    void reset() { next_estimate_ = -1; }
    /// Estimates the limit at every so many steps, not as the number of spheres asks for [-].
    void estimate_every(std::int64_t steps) { interval_ = steps; }

    template <class Archive>
    void serialize(Archive& archive) {
        archive(estimator_, network_, caged_governs_, searches_, omega_, omega_target_,
                inertia_ratio_, step_, next_estimate_, exceeded_, contacts_);
    }

  private:
    bool watches() const { return options_.step && options_.mass_scaling <= 1.0; }
    bool other_contacts(const Simulation& simulation) const;
    void watch_fixed_step(const Simulation& simulation);
    void scale_masses(Simulation& simulation);
    double frequency(const Simulation& simulation, int rounds);

    TimeOptions options_;
    FrequencyEstimator estimator_;
    double network_ = 0;          // highest frequency of the contacts there are [rad/s]
    bool caged_governs_ = false;  // a sphere caged between its neighbours could be faster still
    std::int64_t searches_ = 0;   // neighbour searches when that was found
    double omega_ = 0;            // with the inertia in use [rad/s]
    double omega_target_ = 0;     // mass scaling: what the scaled network may have [rad/s]
    double inertia_ratio_ = 1;
    double step_ = 0;
    double exceeded_ = 0;         // [s]
    std::int64_t contacts_ = -1;  // when a fixed step was last looked at [-]
    std::int64_t next_estimate_ = -1;
    std::int64_t interval_ = 0;  // 0: by the number of spheres [-]
};

}  // namespace grainfield::core
