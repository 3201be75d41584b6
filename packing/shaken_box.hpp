#pragma once
// The box that a block is packed in: spheres under gravity, shaken and pressed by a lid.

#include <cstdint>
#include <optional>

#include "core/base/monitor.hpp"
#include "core/base/random.hpp"
#include "core/drive/driver.hpp"
#include "packing/block.hpp"

namespace grainfield::packing {

/// Walls 0 and 1 at the ends in x, 4 and 5 in z, 2 the floor at y = 0, 3 the lid. The walls give
/// the force of a mirror image at the same overlap.
///
/// Springs may be softened: what falls and is shaken weighs so little that the true ones hardly
/// overlap, and a step is as long as they are soft.
class ShakenBox {
  public:
    /// `spheres` as they were placed below `lid_height` [m], of the material's density. Springs are
    /// the material's, friction is its friction.
    ShakenBox(const PackingOptions& options, const Material& material, core::ParticleStore spheres,
              double lid_height, const kernels::KernelTable& kernels, core::Monitor& monitor);

    /// How far springs can be softened: k_n stays above 2e4 times the block's own stress [-].
    double most_softening() const;
    /// Stiffnesses are the material's over this from now on [-].
    void soften(double factor);
    double softening() const { return softening_; }  ///< [-]
    void set_friction_angle(double angle);           ///< of all spheres [rad]

    /// Runs until the unbalanced force ratio is below `rest` [-] and the mean speed negligible; the
    /// lid stays where it is. With `reversed`, under gravity along +y. Throws SimulationError where
    /// it does not come to rest.
    void settle(double rest, bool reversed = false);
    /// The same under a lid that presses with `stress` [Pa] within 5 %.
    void press(double stress, double rest);
    /// A bout of shaking under the lid and the block's own stress; it ends early where the lid
    /// comes down to `lowest` [m]. With `varied`, strength and pace differ from bout to bout.
    void shake(bool varied, double lowest = 0);

    void set_lid_height(double height);                                       ///< [m]
    double lid_height() const { return simulation_.walls()[lid].point.y(); }  ///< [m]
    double porosity(double height) const;  ///< of the spheres in a box so high [-]
    double porosity() const { return porosity(lid_height()); }  ///< below the lid [-]
    double own_stress() const;   ///< at mid-height of a block, of its own weight [Pa]
    double mean_stress() const;  ///< a third of the trace, below the lid [Pa]
    double top_of_bed() const;   ///< [m]
    const core::ParticleStore& spheres() const { return simulation_.spheres(); }
    std::int64_t steps() const { return simulation_.steps(); }  ///< taken so far [-]
    const Material& material() const { return material_; }
    core::Monitor& monitor() { return monitor_; }

  private:
    static constexpr std::size_t lid = 3;  // y high, in the order of box_walls()

    /// Steps until the ratio is below `rest`; steer(step) is called in each, and at_rest() must
    /// agree.
    template <class Steer, class AtRest>
    void run_until_rest(double rest, const Steer& steer, const AtRest& at_rest);
    Vec3 gravity() const { return {0, -options_.gravity, 0}; }
    double mean_speed() const;

    const PackingOptions& options_;
    const Material& material_;
    core::Simulation simulation_;
    core::Monitor& monitor_;
    std::optional<core::Driver> driver_;  // another one for another stiffness
    core::RandomStream random_;
    std::uint64_t bouts_ = 0;
    double softening_ = 1;  // [-]
};

}  // namespace grainfield::packing
