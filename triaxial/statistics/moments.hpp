#pragma once
// Moments of a sample and the classical intervals of its mean and deviation.
//
// A campaign is looked at while it runs, so what needs more values than there are so far is
// empty, not an error. A value that is NaN or infinite is one: InputError, from every function.

#include <optional>
#include <span>

#include "triaxial/statistics/sample.hpp"

namespace grainfield::triaxial::statistics {

/// Arithmetic mean [as the values]; empty without values.
std::optional<double> mean(std::span<const double> values);

/// Sample standard deviation, the sum of squares over n - 1 [as the values]; empty below two
/// values, exactly zero where all are equal.
std::optional<double> standard_deviation(std::span<const double> values);

/// Standard deviation over mean [-]; empty below two values. Throws InputError where the mean is
/// zero.
std::optional<double> coefficient_of_variation(std::span<const double> values);

/// Sample skewness G1 = g1 sqrt(n (n-1))/(n-2), g1 = m3/m2^1.5 of the central moments (Joanes &
/// Gill 1998, The Statistician 47) [-]; empty below three values or where all are equal.
std::optional<double> skewness(std::span<const double> values);

/// Two-sided interval of the mean, Student's t with n - 1 degrees of freedom: exact for normal
/// values, near for others by the central limit theorem. Empty below two values.
std::optional<Interval> interval_of_mean(std::span<const double> values, double confidence = 0.95);

/// The textbook interval of the deviation, s sqrt((n-1)/chi2) at both tails of chi-square with
/// n - 1 degrees of freedom: for normal values only. Where tails are heavier it is too narrow
/// however many values there are; see bootstrap.hpp. Empty below two values.
std::optional<Interval> chi_square_interval_of_deviation(std::span<const double> values,
                                                         double confidence = 0.95);

/// The two intervals above from n values' mean and deviation [both as the values], n >= 2.
Interval interval_of_mean(double n, double mean, double deviation, double confidence);
Interval chi_square_interval_of_deviation(double n, double deviation, double confidence);

}  // namespace grainfield::triaxial::statistics
