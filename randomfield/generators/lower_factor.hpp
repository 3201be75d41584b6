#pragma once
// Cholesky factor of a covariance matrix, the same to the last bit everywhere.

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace grainfield::randomfield {

/// Lower triangular L with L L^T = C, dense, column by column: L(i, j) at [i + j size].
///
/// Every entry is computed by the same operations in the same order whatever the number of threads
/// and the vector length (Eigen's blocking follows the cache sizes of the machine, so its last bits
/// do too, and a field must not).
class LowerFactor {
  public:
    /// Largest matrix: 16384 rows, 2 GiB and some minutes of work.
    static constexpr std::size_t max_size = 16384;

    /// Factors a symmetric size x size matrix (both triangles given), in its memory. Covariances
    /// of long correlation lengths are positive definite on paper and singular to round-off: then
    /// the diagonal is raised by as little as lets the factor exist, at most 3e-13 of `scale`, the
    /// size of the numbers that the entries were computed from (at least the largest diagonal
    /// entry is taken). Empty if that is not enough (no covariance) or an entry is not finite.
    static std::optional<LowerFactor> of(std::vector<double> matrix, std::size_t size,
                                         double scale = 0.0);

    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] double operator()(std::size_t i, std::size_t j) const {
        return entries_[i + j * size_];
    }
    /// What the diagonal was raised by, in units of the scale; mostly 0 [-].
    [[nodiscard]] double nugget() const { return nugget_; }

    /// product = L x. Both of length size().
    void multiply(std::span<const double> x, std::span<double> product) const;
    /// x <- L^-1 x.
    void solve_lower(std::span<double> x) const;
    /// x <- L^-T x.
    void solve_upper(std::span<double> x) const;

  private:
    LowerFactor(std::vector<double> entries, std::size_t size, double nugget)
        : entries_(std::move(entries)), size_(size), nugget_(nugget) {}

    std::vector<double> entries_;
    std::size_t size_;
    double nugget_;
};

}  // namespace grainfield::randomfield
