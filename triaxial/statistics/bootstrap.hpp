#pragma once
// Intervals by resampling, for statistics whose distribution nobody wrote down: the bias-corrected
// and accelerated bootstrap, BCa (Efron & Tibshirani 1993, "An Introduction to the Bootstrap",
// section 14.3). It needs no normal values and keeps to the range of the statistic.
//
// How often its 95 % interval of the deviation holds the truth (in brackets the textbook's), from
// 1,000 lognormal samples each:
//
//     values   CoV 0.10        CoV 0.31        CoV 0.66
//     30       0.92 (0.95)     0.87 (0.88)     0.80 (0.66)
//     100      0.93 (0.94)     0.90 (0.86)     0.88 (0.66)
//     300      0.94 (0.94)     0.93 (0.85)     0.90 (0.60)
//
// It approaches what it states as values are added; the textbook's does not.

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "triaxial/statistics/sample.hpp"

namespace grainfield::triaxial::statistics {

/// A number computed from a sample, whatever its order.
using Statistic = std::function<double(std::span<const double>)>;

/// The statistic of `resampling.resamples` samples of the same size, drawn from `values` with
/// replacement; random numbers of Stream::bootstrap. Throws InputError without values.
std::vector<double> bootstrap_replicates(std::span<const double> values, const Statistic& statistic,
                                         const Resampling& resampling);

/// The statistic of the n samples that lack one value each. Throws InputError below two values.
std::vector<double> jackknife_replicates(std::span<const double> values,
                                         const Statistic& statistic);

/// BCa interval from an estimate, its bootstrap and its jackknife replicates. Empty where the
/// estimate lies below or above all bootstrap replicates, or where the correction breaks down
/// (Efron & Tibshirani's 1 - a (z0 + z) <= 0).
std::optional<Interval> bca_interval(double estimate, std::span<const double> bootstrap,
                                     std::span<const double> jackknife, double confidence);

/// BCa interval of the standard deviation. Empty below five values, which give too few different
/// resamples, and where all values are equal. Throws InputError for values that are not finite.
std::optional<Interval> bootstrap_interval_of_deviation(std::span<const double> values,
                                                        double confidence = 0.95,
                                                        const Resampling& resampling = {
                                                            .resamples = 10'000});

/// BCa interval of the coefficient of variation [-]. Empty as above. Throws InputError for values
/// that are not above zero: the ratio means nothing where a resample's mean can vanish.
std::optional<Interval> bootstrap_interval_of_variation(std::span<const double> values,
                                                        double confidence = 0.95,
                                                        const Resampling& resampling = {
                                                            .resamples = 10'000});

}  // namespace grainfield::triaxial::statistics
