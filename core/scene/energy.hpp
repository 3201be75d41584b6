#pragma once
// The energy ledger of a simulation, and how well it closes.

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/state/bytes.hpp"

namespace grainfield::core {

/// Energies and works [J]. kinetic to gravity are of the present state; the works are sums since
/// the start. closing() is constant in exact arithmetic of the scheme.
struct Energy {
    double kinetic = 0, rotational = 0;            ///< at time n [J]
    double elastic_normal = 0, elastic_shear = 0;  ///< [J]
    double friction_work = 0;                      ///< dissipated by slip [J]
    double damping_work = 0;   ///< dissipated by local damping and by slowing all spheres [J]
    double external_work = 0;  ///< put in by moving walls, velocities given, masses scaled [J]
    double gravity = 0;        ///< potential, -m g.x [J]
    /// Part of external_work: of walls that push; others, that yield, take work out [J]
    double work_put_in = 0;

    double closing() const {
        return kinetic + rotational + elastic_normal + elastic_shear + friction_work +
               damping_work + gravity - external_work;
    }
};

/// Follows a ledger through a run.
class EnergyClosing {
  public:
    void add(const Energy& e) {
        if (!first_) first_ = e;
        for (const double value :
             {e.kinetic, e.rotational, e.elastic_normal, e.elastic_shear, e.friction_work,
              e.damping_work, e.external_work, e.gravity - first_->gravity, e.work_put_in})
            largest_ = std::max(largest_, std::abs(value));
        change_ = std::max(change_, std::abs(e.closing() - first_->closing()));
    }
    /// Largest change of closing() since the first entry over the largest energy or work; in a test
    /// driven by walls that is the work put in [-].
    double error() const { return largest_ > 0 ? change_ / largest_ : 0.0; }

    template <class Archive>
    void serialize(Archive& archive) {
        archive(bytes(first_), largest_, change_);
    }

  private:
    std::optional<Energy> first_;
    double largest_ = 0, change_ = 0;  // [J]
};

struct EnergyRow {
    double time = 0;  ///< [s]
    Energy energy;
};

}  // namespace grainfield::core
