#pragma once
// What every generator of Gaussian fields is: a linear map from independent standard normals to
// the local averages of the cells of a grid.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "core/base/random.hpp"
#include "randomfield/covariance/correlation.hpp"
#include "randomfield/field_options.hpp"
#include "randomfield/grid.hpp"

namespace grainfield::randomfield {

/// Set up once, then applied any number of times from any number of threads. Linear, Z = M U: the
/// covariance of its fields is M M^T, which field_error.hpp holds against the exact one.
class Generator {
  public:
    virtual ~Generator() = default;
    Generator(const Generator&) = delete;
    Generator& operator=(const Generator&) = delete;

    /// field = M normals, of normals() and of grid().size() numbers, cells at GridSpec::index().
    /// Safe from many threads; the same bits on any number of them.
    virtual void apply(std::span<const double> normals, std::span<double> field) const = 0;

    /// apply() of the normals of a stream at (realization, 0), (realization, 1), ...: the same
    /// bits, without all of them in memory where the method can do without.
    virtual void draw(const core::RandomStream& random, std::uint64_t realization,
                      std::span<double> field) const;

    /// Number of standard normals a field takes [-].
    [[nodiscard]] virtual std::size_t normals() const = 0;
    /// Whether M M^T is the exact covariance but for round-off.
    [[nodiscard]] virtual bool exact() const = 0;
    /// Largest covariance error that the method is documented to have, in units of gamma [-].
    [[nodiscard]] virtual double stated_error() const { return exact() ? 1e-10 : 0.05; }
    /// Number of subdivisions between stage 0 and the field; 0 where nothing is subdivided [-].
    [[nodiscard]] virtual std::size_t subdivisions() const { return 0; }
    /// Largest |M M^T - C| in units of gamma where the generator's own algebra gives it at little
    /// cost [-].
    [[nodiscard]] virtual std::optional<double> known_error() const { return {}; }

    [[nodiscard]] const GridSpec& grid() const { return grid_; }
    [[nodiscard]] const CorrelationModel& correlation() const { return correlation_; }
    /// Exact variance of a cell's local average, gamma(D) [-].
    [[nodiscard]] double gamma() const { return gamma_; }

  protected:
    /// InputError where grid or correlation lengths are not valid.
    Generator(const GridSpec& grid, const CorrelationModel& correlation);

  private:
    GridSpec grid_;
    CorrelationModel correlation_;
    double gamma_;
};

/// The generator of a method. `stage0_cells`: largest stage 0 of the subdivision, the default of
/// LasGenerator unless given. InputError where grid or correlation are not valid or no such field
/// can be computed.
std::unique_ptr<const Generator> make_generator(const GridSpec& grid,
                                                const CorrelationModel& correlation, Method method,
                                                std::optional<std::int64_t> stage0_cells = {});

}  // namespace grainfield::randomfield
