#pragma once
// Counter-based random numbers: every random stream of the program, in one place.
//
// A number is a pure function of (seed, stream, realization, index), so that a realization is the
// same whatever else runs, in whatever order and on however many threads. Philox4x32-10 (Salmon et
// al. 2011, "Parallel random numbers: as easy as 1, 2, 3", SC11): key = (seed, stream), counter =
// (realization, index). Only integer arithmetic, + - * /, sqrt and log are used, so that the
// numbers do not depend on the compiler.

#include <array>
#include <cstdint>
#include <span>

namespace grainfield::core {

/// Every random stream there is. The numbers are part of what a seed means: append, never renumber.
/// All below 256.
enum class Stream : std::uint32_t {
    field_friction = 1,        ///< Gaussian field behind the friction angle, Eq. (7) of Tran et al.
    field_stiffness = 2,       ///< Gaussian field behind the stiffness, Eqs. (8)-(9) of Tran et al.
    packing_grading = 3,       ///< diameters of the block's spheres, Eq. (2) of Tran et al.
    packing_position = 4,      ///< where the spheres are placed before settling
    packing_shaking = 5,       ///< phases and directions of the shaking
    solver_start = 6,          ///< start vector of the time step's eigenvalue iterations
    perturbation = 7,          ///< displacements that measure how chaotic a result is
    bootstrap = 8,             ///< which values a resample of a campaign's results holds
    parametric_bootstrap = 9,  ///< samples of a fitted distribution, for p values
    field_data = 10,           ///< errors of the values that a field is conditioned on
    repeated_start = 11,       ///< where the spheres of a repeated test stand, within 1e-12 m
};

/// Philox4x32 with ten rounds: the raw bijection of the counter under the key.
std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter,
                                    std::array<std::uint32_t, 2> key) noexcept;

/// Inverse of the standard normal distribution, Wichura's PPND16 (AS 241, Applied Statistics 37,
/// 1988), for p in (0, 1) [-]. Good to about 1e-15 relative (tested against Boost.Math).
double normal_quantile(double p) noexcept;

/// The numbers of one stream under one seed. Cheap to copy, safe to share between threads.
/// The seeds 0 ... 2^56 - 1 all give different streams; larger ones are folded to 56 bits.
class RandomStream {
  public:
    RandomStream(std::uint64_t seed, Stream stream) noexcept;

    /// The 128 bits at (realization, index).
    [[nodiscard]] std::array<std::uint32_t, 4> bits(std::uint64_t realization,
                                                    std::uint64_t index) const noexcept;

    /// Uniform in the open interval (0, 1): an odd multiple of 2^-53, so never 0 nor 1 [-].
    [[nodiscard]] double uniform(std::uint64_t realization, std::uint64_t index) const noexcept;

    /// Two independent uniforms in (0, 1) at one index; the first is uniform()'s [-].
    [[nodiscard]] std::array<double, 2> uniform_pair(std::uint64_t realization,
                                                     std::uint64_t index) const noexcept;

    /// Standard normal, the quantile of uniform(): at most 8.3 in magnitude [-].
    [[nodiscard]] double normal(std::uint64_t realization, std::uint64_t index) const noexcept;

    /// values[i] = normal(realization, first + i).
    void normals(std::uint64_t realization, std::uint64_t first,
                 std::span<double> values) const noexcept;

  private:
    std::array<std::uint32_t, 2> key_;
};

}  // namespace grainfield::core
