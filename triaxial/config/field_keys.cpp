// The keys of the random field.

#include <string>

#include "triaxial/config/config_keys.hpp"

namespace grainfield::triaxial {
namespace {

constexpr Range correlation_range{
    -1, 1, true, true, "in [-1, 1], where the correlation matrix has no negative eigenvalue"};

// As randomfield/marginals/marginal_checks.cpp has them, here with file and line.
constexpr Range stiffness_range{1e-100, 1e100, true, true, "in [1e-100, 1e100]"};
constexpr Range variation{1e-6, 1e3, true, true, "in [1e-6, 1000]"};
constexpr Range variability{1e-6, 1e6, true, true, "in [1e-6, 1e6]"};

/// The distribution of one property, in the table `path`. The contract's keys come first, those of
/// Eq. (7) of Tran et al. for the friction angle and of their Eqs. (8)-(9) for the stiffness. A key
/// that its marginal has no use for has no effect; `field` says so.
void add_keys(Keys& keys, randomfield::MarginalOptions& marginal, const std::string& path,
              const std::string& unit, const Range& range, const Range& of_mean) {
    // A structured binding on purpose, see config_keys.cpp.
    auto& [kind, minimum, maximum, s, mean, cov, mean_gradient, preserve_mean] = marginal;
    const auto add = [&](const char* name, Slot slot, const std::string& note) {
        keys.push_back({path + "." + name, std::move(slot), note});
    };
    const std::string bounds = unit + ": of \"bounded\", \"truncated-normal\", \"beta\"";
    add("minimum", slot(minimum, range), bounds);
    add("maximum", slot(maximum, range), bounds);
    add("s", slot(s, variability), "of \"bounded\": variability factor");
    add("mean", slot(mean, of_mean), unit + ": at mid-height; of all but \"bounded\"");
    add("cov", slot(cov, variation), "coefficient of variation; of all but \"bounded\"");
    add("preserve_mean", slot(preserve_mean), "rescale so that cells have a point's mean");
    add("marginal", slot(kind, marginal_names),
        "\"bounded\", \"lognormal\", \"normal\", \"truncated-normal\", \"beta\", \"weibull\"");
    add("mean_gradient", slot(mean_gradient, any_number),
        unit + "/m: growth of the mean with height y; of \"bounded\" that of both bounds");
}

}  // namespace

void add_keys(Keys& keys, randomfield::FieldOptions& field) {
    auto& [variable, method, correlation, seed, correlation_length, stage0_cells, cross_correlation,
           data, data_deviations, friction, stiffness] = field;
    keys.push_back({"field.variable", slot(variable, variable_names),
                    "\"none\", \"friction\", \"stiffness\", \"both\""});
    keys.push_back({"field.method", slot(method, method_names),
                    "\"las\", \"las-classic\", \"cholesky\", \"circulant\""});
    keys.push_back({"field.correlation", slot(correlation, correlation_names),
                    "\"markov\", \"separable-markov\", \"gaussian\", \"spherical\", \"matern32\", "
                    "\"matern52\""});
    keys.push_back({"field.seed", slot(seed, 0), "of the field's normals"});
    keys.push_back(
        {"field.correlation_length", slot(correlation_length, positive), "m: theta x, y, z"});
    keys.push_back({"field.stage0_cells", slot(stage0_cells, 1),
                    "optional: largest stage 0 of the subdivision, in cells"});
    keys.push_back({"field.cross_correlation", slot(cross_correlation, correlation_range),
                    "of friction angle and stiffness, where both are random"});
    keys.push_back({"field.data", optional_text_slot(data, "the name of a CSV file"),
                    "optional: CSV of measured values to condition on"});
    keys.push_back({"field.data_deviations", slot(data_deviations, positive),
                    "measured values further from their distribution are refused"});
    add_keys(keys, friction, "field.friction", "rad", below_right_angle,
             {0, below_right_angle.high, false, false, "in (0, pi/2)"});
    add_keys(keys, stiffness, "field.stiffness", "Pa", stiffness_range, stiffness_range);
}

}  // namespace grainfield::triaxial
