// What is refused as the distribution of a property (marginals.hpp, validate()).

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/base/errors.hpp"
#include "randomfield/marginals/marginals.hpp"
#include "randomfield/marginals/property_limits.hpp"

namespace grainfield::randomfield {
namespace {

class Check {
  public:
    Check(const MarginalOptions& options, Property property, std::string key)
        : options_(options), limits_(limits_of(property)), key_(std::move(key)) {}

    void all() const {
        require(std::isfinite(options_.mean_gradient), "mean_gradient", options_.mean_gradient,
                fmt::format("must be finite ({}/m)", limits_.unit));
        const bool window = options_.kind == MarginalKind::bounded ||
                            options_.kind == MarginalKind::truncated_normal ||
                            options_.kind == MarginalKind::beta;
        if (window) bounds();
        if (options_.kind == MarginalKind::bounded)
            require(options_.s >= 1e-6 && options_.s <= 1e6, "s", options_.s,
                    "must be in [1e-6, 1e6]");
        else
            mean_and_cov();
        if (options_.kind == MarginalKind::truncated_normal) cut();
        if (options_.kind == MarginalKind::beta) shapes();
        if (options_.kind == MarginalKind::weibull)
            require(options_.cov >= Weibull::least_cov && options_.cov <= Weibull::largest_cov,
                    "cov", options_.cov,
                    fmt::format("must be in [{}, {}] for the Weibull distribution",
                                Weibull::least_cov, Weibull::largest_cov));
        if (!window) reach();
    }

  private:
    void require(bool ok, const char* name, double value, const std::string& allowed) const {
        if (!ok) throw InputError(fmt::format("{}.{} = {}: {}", key_, name, value, allowed));
    }

    void bounds() const {
        for (const auto& [name, value] :
             {std::pair{"minimum", options_.minimum}, std::pair{"maximum", options_.maximum}})
            if (!value)
                throw InputError(fmt::format("{}.marginal = \"{}\": needs {}.{}, which is not set",
                                             key_, name_of(options_.kind), key_, name));
        const double low = *options_.minimum, high = *options_.maximum;
        require(limits_.contains(low), "minimum", low,
                fmt::format("must be {} ({})", limits_.text, limits_.unit));
        if (low != 0.0) size("minimum", low);
        size("maximum", high);
        require(high - low >= 1e-6 * high && limits_.contains(high), "maximum", high,
                fmt::format("must be above {}.minimum = {} by 1e-6 of it, and {} ({})", key_, low,
                            limits_.text, limits_.unit));
    }

    /// So that neither a square nor a quotient leaves what a double can hold.
    void size(const char* name, double value) const {
        require(value >= 1e-100 && value <= 1e100, name, value,
                fmt::format("must be in [1e-100, 1e100] ({})", limits_.unit));
    }

    void mean_and_cov() const {
        size("mean", options_.mean);
        require(options_.cov >= 1e-6 && options_.cov <= 1e3, "cov", options_.cov,
                "must be in [1e-6, 1000]");
    }

    void cut() const {
        const double window = TruncatedNormal(options_).window;
        require(window >= 1e-6, "mean", options_.mean,
                fmt::format("of the normal distribution with {}.cov = {} only a share of {:.2g} "
                            "lies in [{}, {}]: at least 1e-6 is needed",
                            key_, options_.cov, window, *options_.minimum, *options_.maximum));
    }

    void shapes() const {
        const double low = *options_.minimum, high = *options_.maximum;
        require(options_.mean > low && options_.mean < high, "mean", options_.mean,
                fmt::format("must lie strictly between {}.minimum = {} and {}.maximum = {}", key_,
                            low, key_, high));
        const double largest =
            std::sqrt((options_.mean - low) * (high - options_.mean)) / options_.mean;
        require(options_.cov < 0.99 * largest, "cov", options_.cov,
                fmt::format("must be below {:.4g} for a beta distribution of this mean in [{}, {}]",
                            0.99 * largest, low, high));
    }

    /// How far a distribution without bounds reaches.
    void reach() const {
        const Marginal marginal(options_, 1.0);
        for (const double g : {-most_deviations, most_deviations}) {
            const double value = marginal(g);
            require(limits_.contains(value), "cov", options_.cov,
                    fmt::format("with {}.mean = {:.6g} the {} distribution reaches {:.4g} {} at "
                                "{:+g} standard deviations, allowed is {}: choose a smaller cov, "
                                "or \"truncated-normal\" or \"beta\"",
                                key_, options_.mean, name_of(options_.kind), value, limits_.unit, g,
                                limits_.text));
        }
    }

    const MarginalOptions& options_;
    PropertyLimits limits_;
    std::string key_;
};

}  // namespace

void validate(const MarginalOptions& options, Property property, const std::string& key) {
    Check(options, property, key).all();
}

}  // namespace grainfield::randomfield
