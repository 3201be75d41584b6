#pragma once
// The highest natural frequency of the contact network: 2/omega_max bounds the time step.

#include <cstdint>
#include <vector>

#include "core/simulation.hpp"
#include "core/state/bytes.hpp"

namespace grainfield::core {

/// A touching contact as a spring; j < 0 for a wall.
struct ContactSpring {
    std::int32_t i, j;
    Vec3 normal;                ///< from i outwards [-]
    double kn, ks;              ///< [N/m]
    double radius_i, radius_j;  ///< [m]
};
/// All touching contacts of a simulation, each taken as sticking.
std::vector<ContactSpring> contact_springs(const Simulation& simulation);

/// Estimates omega_max of the present contacts: translations and rotations, walls included, every
/// contact taken as sticking (slip only softens). Lanczos iterations on M^-1/2 K M^-1/2, each the
/// cost of about one force pass; the start vector is weighted towards light and stiffly held
/// spheres, where the highest modes live, and the last mode found is kept for the next estimate.
/// Spheres too heavy or too softly held to take part in the highest mode are left out.
class FrequencyEstimator {
  public:
    /// Upper estimate of omega_max [rad/s]: the largest Ritz value plus its residual. `restarts`
    /// rounds of `iterations` each. 0 where nothing touches.
    double estimate(const Simulation& simulation, int restarts = 4, int iterations = 8);

    /// What one estimate leaves to the next.
    template <class Archive>
    void serialize(Archive& archive) {
        archive(bytes(sphere_), bytes(mode_));
    }

  private:
    void assemble(const Simulation& simulation);
    void apply(const std::vector<double>& x, std::vector<double>& y) const;
    void carry_mode(std::size_t all, const std::vector<std::int32_t>& spheres);
    void start_vector();
    double lanczos_round(int iterations);

    std::vector<ContactSpring> springs_;  // i, j: numbers of spheres that take part
    std::vector<std::int32_t> sphere_;    // of each number
    std::vector<std::uint32_t> offsets_;
    std::vector<std::uint32_t> incidences_;  // 2 * spring + side
    std::vector<double> scale_;              // sqrt of inverse mass, inverse inertia: two a sphere
    std::vector<double> mode_;               // six a sphere: translation, rotation
    std::size_t spheres_ = 0;
};

/// Frequency that each sphere could reach when it is caged, squared: between two spheres of its own
/// kind, or between its two stiffest neighbours where those allow less [rad2/s2].
std::vector<double> caged_square_frequencies(const Simulation& simulation);
/// An upper bound for caged spheres, before any contact exists, too [rad/s]. If two of its own kind
/// bring no sphere beyond `known` [rad/s], it is the largest frequency between two of its own kind.
/// Else it is the largest of caged_square_frequencies(), which costs more.
double caged_frequency(const Simulation& simulation, double known);

/// Highest frequency of each sphere with all its neighbours held fixed, squared; a lower bound of
/// its share in the network's modes [rad2/s2].
std::vector<double> local_square_frequencies(const Simulation& simulation);

}  // namespace grainfield::core
