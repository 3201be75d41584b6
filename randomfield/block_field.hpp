#pragma once
// The module's front door: random fields of soil properties on the grid of blocks.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "randomfield/conditioning/conditioning.hpp"
#include "randomfield/field_options.hpp"
#include "randomfield/generators/generator.hpp"
#include "randomfield/grid.hpp"
#include "randomfield/marginals/marginals.hpp"
#include "randomfield/verification/field_error.hpp"

namespace grainfield::randomfield {

/// One realization. Every column has one value a cell, at GridSpec::index(), or is empty.
struct BlockField {
    GridSpec grid;
    std::vector<double> G;                 ///< cell averages before the marginal [-]
    std::vector<double> G_stiffness;       ///< Variable::both: those of the stiffness [-]
    std::vector<double> friction_angle;    ///< empty unless random [rad]
    std::vector<double> normal_stiffness;  ///< k_n, empty unless random [Pa]

    /// Mapping cell -> sphere: out[s] = column[cell[s]], cell from GridSpec::index_of_block() or
    /// index_at(). An empty column (property not random) leaves `out` as it is.
    static void map(std::span<const double> column, std::span<const std::size_t> cell,
                    std::span<double> out);
};

/// Set up once (milliseconds for Tran et al.'s 6 x 12 x 6 blocks), then any number of draws.
class FieldGenerator {
  public:
    /// Reads options.data where it is given. InputError where grid, options or data are not valid
    /// or no such field can be computed, FileError where the data cannot be read.
    FieldGenerator(const GridSpec& grid, const FieldOptions& options);

    /// Realization k: a pure function of (seed, k). Safe from many threads. With Variable::none
    /// only G is drawn, that of the friction angle. Where both properties are random,
    ///   G_stiffness = rho G_friction + sqrt(1 - rho^2) G',  rho = options.cross_correlation;
    /// friction, and at rho = 0 stiffness too, is the same whether drawn alone or with the other.
    /// Data change the field (conditioning.hpp), but not the random numbers behind it.
    /// InputError where a value is none that its property can have.
    [[nodiscard]] BlockField draw(std::uint64_t realization) const;
    /// The same as if there were no data.
    [[nodiscard]] BlockField draw_unconditional(std::uint64_t realization) const;

    [[nodiscard]] const GridSpec& grid() const { return generator_->grid(); }
    [[nodiscard]] const FieldOptions& options() const { return options_; }
    [[nodiscard]] const Generator& generator() const { return *generator_; }
    /// Variance of a cell's G: below 1, as cells are local averages [-].
    [[nodiscard]] double gamma() const { return generator_->gamma(); }
    /// How a property is distributed over the cells, before any data.
    [[nodiscard]] const RowMarginals& marginals(Property property) const {
        return property == Property::friction_angle ? friction_ : stiffness_;
    }
    /// The data in force, or nullptr.
    [[nodiscard]] const Conditioning* conditioning() const { return conditioning_.get(); }
    /// E[k_n of a cell], given the data, over that of a point [-].
    [[nodiscard]] double stiffness_mean_ratio() const;
    /// Largest error of the generator's covariances in units of gamma, without sampling: round-off
    /// where the method is exact. InputError above max_error_cells cells [-].
    [[nodiscard]] double covariance_error() const;

  private:
    BlockField gaussian(std::uint64_t realization) const;
    void condition(BlockField& field, std::uint64_t realization) const;
    void transform(BlockField& field) const;

    FieldOptions options_;
    std::shared_ptr<const Generator> generator_;
    RowMarginals friction_, stiffness_;
    std::shared_ptr<const Conditioning> conditioning_;
};

}  // namespace grainfield::randomfield
