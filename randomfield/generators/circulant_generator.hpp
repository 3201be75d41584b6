#pragma once
// Exact fields on large grids by circulant embedding (Dietrich & Newsam 1997, SIAM J. Sci. Comput.
// 18(4), 1088-1107).

#include <memory>
#include <span>
#include <vector>

#include "randomfield/generators/generator.hpp"

namespace grainfield::randomfield {

/// The covariance of the grid's cells, continued periodically on a larger grid, is diagonal in
/// Fourier modes: one FFT a field, of independent amplitudes. Exact if no eigenvalue is negative.
/// The period starts at twice the grid and grows, up to twelve correlation
/// lengths, until that is so. Memory: 24 B a cell of the
/// period, of which there are at least 8 a cell of the grid. The same bits on any number of
/// threads; FFTW adapts its order of sums to the CPU, so between CPUs the last bits may differ.
class CirculantGenerator final : public Generator {
  public:
    /// Largest period unless another is given: 2^25 cells, 1.3 GB while it is set up.
    static constexpr double max_period_cells = 33554432.0;
    /// Negative eigenvalues that change no covariance by more than this, in units of gamma, are
    /// round-off of the FFT, and count as zero [-].
    static constexpr double round_off = 1e-11;

    /// InputError where the smallest period is too large, or where the eigenvalues of the largest
    /// that is allowed are still negative: it gives the most negative one in units of the largest,
    /// and the error of covariance that clipping them would make. They are never clipped.
    /// `most_cells`: of the period.
    CirculantGenerator(const GridSpec& grid, const CorrelationModel& correlation,
                       double most_cells = max_period_cells);
    ~CirculantGenerator() override;

    void apply(std::span<const double> normals, std::span<double> field) const override;
    /// Two for each mode of half the spectrum: more than 8 a cell.
    [[nodiscard]] std::size_t normals() const override { return 2 * amplitude_.size(); }
    [[nodiscard]] bool exact() const override { return true; }
    /// Largest |M M^T - C| in units of gamma, of all pairs of cells at once: both depend on the lag
    /// only [-].
    [[nodiscard]] std::optional<double> known_error() const override;
    /// Cells of the period in each direction.
    [[nodiscard]] const CellCount& period() const { return period_; }

  private:
    struct Plan;
    void set_amplitudes(std::span<const double> eigenvalues);

    CellCount period_{};
    std::vector<double> amplitude_;  ///< standard deviation of a mode, half the spectrum [-]
    std::unique_ptr<const Plan> plan_;
};

}  // namespace grainfield::randomfield
