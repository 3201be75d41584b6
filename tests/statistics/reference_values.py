#!/usr/bin/env python3
"""Prints reference_values.hpp: what SciPy says of two made-up samples.

    python3 tests/statistics/reference_values.py > tests/statistics/reference_values.hpp

Reads nothing; the random numbers are those of a linear congruential generator and, for simulated
p values, of NumPy with a fixed seed. Takes some minutes, most of it for goodness_of_fit.
"""

import numpy as np
import scipy
from scipy import optimize, special, stats

SIMULATED = 2000  # samples behind a simulated p value


def lcg(start):
    """Numerical Recipes' generator of 32-bit words."""
    word = start
    while True:
        word = (1664525 * word + 1013904223) % 2**32
        yield word


def uniforms(start, n):
    words = lcg(start)
    return np.array([(next(words) + 0.5) / 2.0**32 for _ in range(n)])


def student_quantile(degrees):
    """At 0.975; scipy.stats.t.ppf itself is good to eight digits only."""
    return optimize.brentq(
        lambda t: special.stdtr(degrees, -t) - 0.025, 1, 13, xtol=1e-15, rtol=1e-15
    )


def weibull_shape(x):
    """Root of the profile likelihood's derivative."""
    z = np.log(x / x.max())

    def score(k):
        return np.sum(np.exp(k * z) * z) / np.sum(np.exp(k * z)) - 1 / k - z.mean()

    return optimize.brentq(score, 1e-2, 1e2, xtol=1e-15, rtol=1e-15)


def fitted(family, x):
    """SciPy's distribution with maximum-likelihood parameters, and ours for the same."""
    if family == "normal":
        mean, deviation = stats.norm.fit(x)
        return stats.norm(mean, deviation), (mean, deviation)
    if family == "lognormal":
        mean, deviation = stats.norm.fit(np.log(x))
        return stats.lognorm(deviation, scale=np.exp(mean)), (mean, deviation)
    if family == "gamma":
        s = np.log(x.mean()) - np.log(x).mean()
        shape = optimize.brentq(
            lambda k: np.log(k) - special.digamma(k) - s, 1e-2, 1e3, xtol=1e-15, rtol=1e-15
        )
        return stats.gamma(shape, scale=x.mean() / shape), (shape, x.mean() / shape)
    shape = weibull_shape(x)
    scale = np.mean(x**shape) ** (1 / shape)
    return stats.weibull_min(shape, scale=scale), (shape, scale)


def tested(family, x):
    """The distribution that D and A^2 are measured from: deviations over n - 1."""
    if family == "normal":
        return stats.norm(x.mean(), x.std(ddof=1))
    if family == "lognormal":
        return stats.lognorm(np.log(x).std(ddof=1), scale=np.exp(np.log(x).mean()))
    return fitted(family, x)[0]


def anderson(x, distribution):
    x = np.sort(x)
    n = len(x)
    i = np.arange(1, n + 1)
    return -n - np.mean((2 * i - 1) * (distribution.logcdf(x) + distribution.logsf(x[::-1])))


def lilliefors_p(z):
    """p of D for normal values of estimated mean and deviation, by simulation."""
    def distance(y):
        y = np.sort((y - y.mean(axis=-1, keepdims=True)) / y.std(axis=-1, ddof=1, keepdims=True))
        n, f = y.shape[-1], special.ndtr(y)
        i = np.arange(n)
        return np.maximum((i + 1) / n - f, f - i / n).max(axis=-1)

    simulated = distance(np.random.default_rng(1).standard_normal((SIMULATED, len(z))))
    return np.mean(simulated >= distance(z) - 1e-12)


def p_by_simulation(family, x, statistic):
    if family == "normal":
        return lilliefors_p(x) if statistic == "ks" else np.nan
    if family == "lognormal":
        return lilliefors_p(np.log(x)) if statistic == "ks" else np.nan
    known = {"gamma": stats.gamma, "weibull": stats.weibull_min}[family]
    result = stats.goodness_of_fit(known, x, known_params={"loc": 0}, statistic=statistic,
                                   n_mc_samples=SIMULATED, random_state=np.random.default_rng(1))
    return result.pvalue


def bca(x):
    """scipy.stats.bootstrap's BCa of the deviation, from replicates both programs can repeat."""
    words = lcg(12345)
    draws = [[next(words) * len(x) >> 32 for _ in x] for _ in range(999)]
    replicates = np.array([x[d].std(ddof=1) for d in draws])

    def deviation(sample, axis):
        return np.std(sample, ddof=1, axis=axis)

    started = stats.bootstrap((x,), deviation, n_resamples=2, method="basic")
    started.bootstrap_distribution = replicates
    interval = stats.bootstrap((x,), deviation, n_resamples=0, method="BCa",
                               bootstrap_result=started).confidence_interval
    return interval.low, interval.high


def chi_square(x, distribution, bins):
    edges = distribution.ppf(np.arange(1, bins) / bins)
    observed = np.bincount(np.searchsorted(edges, x), minlength=bins)
    return stats.chisquare(observed, ddof=2)


def number(x):
    return "std::nan(\"\")" if np.isnan(x) else repr(float(x))


def row(*values):
    return "{" + ", ".join(number(v) for v in values) + "}"


def print_sample(name, x):
    n = len(x)
    mean, s = x.mean(), x.std(ddof=1)
    half = student_quantile(n - 1) * stats.sem(x)
    chi2 = stats.chi2(n - 1).ppf([0.975, 0.025])
    bins = min(round(2 * n**0.4), n // 5)
    counts, edges = np.histogram(x, bins="fd")
    ranks = [1, n // 3, n]
    print(f"inline const Reference {name}{{")
    print(f"    .values = {row(*x)},")
    print(f"    .mean = {number(mean)},")
    print(f"    .deviation = {number(s)},")
    print(f"    .variation = {number(stats.variation(x, ddof=1))},")
    print(f"    .skewness = {number(stats.skew(x, bias=False))},")
    print(f"    .mean_interval = {row(mean - half, mean + half)},")
    print(f"    .chi_square_interval = {row(*(s * np.sqrt((n - 1) / chi2)))},")
    print(f"    .bca_interval = {row(*bca(x))},")
    print("    .families = {{")
    for family in ["normal", "lognormal", "gamma", "weibull"]:
        d, parameters = fitted(family, x)
        likelihood = d.logpdf(x).sum()
        at = x[0]
        chi = chi_square(x, d, bins)
        distance = tested(family, x)
        print(f"        {{Family::{family},")
        print(f"         {row(*parameters)},")
        print(f"         {number(likelihood)}, {number(4 - 2 * likelihood)},")
        print(f"         {number(d.pdf(at))}, {number(d.cdf(at))},")
        print(f"         {number(d.sf(3 * at))}, {number(d.ppf(0.05))},")
        print(f"         {number(d.mean())}, {number(d.std())},")
        print(f"         {number(chi.statistic)}, {number(chi.pvalue)},")
        print(f"         {number(stats.kstest(x, distance.cdf).statistic)},")
        print(f"         {number(p_by_simulation(family, x, 'ks'))},")
        print(f"         {number(anderson(x, distance))},")
        print(f"         {number(p_by_simulation(family, x, 'ad'))}}},")
    print("    }},")
    print(f"    .chi_square_bins = {bins},")
    print(f"    .band_ranks = {{{', '.join(str(r) for r in ranks)}}},")
    print(f"    .band_lower = {row(*[stats.beta.ppf(0.025, r, n + 1 - r) for r in ranks])},")
    print(f"    .band_upper = {row(*[stats.beta.ppf(0.975, r, n + 1 - r) for r in ranks])},")
    print(f"    .histogram_edges = {row(*edges)},")
    print(f"    .histogram_counts = {{{', '.join(str(c) for c in counts)}}},")
    print("};\n")


HEADER = f"""#pragma once
// Printed by tests/statistics/reference_values.py with SciPy {scipy.__version__}, NumPy {np.__version__}.

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "triaxial/statistics/distributions.hpp"
#include "triaxial/statistics/sample.hpp"

namespace grainfield::triaxial::statistics {{

struct FamilyReference {{
    Family family = Family::normal;
    std::array<double, 2> parameters{{}};  // as Fit's
    double log_likelihood = 0, aic = 0;  // [-]
    double pdf = 0, cdf = 0;             // at the first value [1/unit], [-]
    double exceedance = 0;               // at three times the first value [-]
    double quantile = 0;                 // at 0.05 [as the values]
    double mean = 0, deviation = 0;      // of the fit [as the values]
    double chi_square = 0, chi_square_p = 0;
    double kolmogorov_smirnov = 0, kolmogorov_smirnov_p = 0;  // p simulated [-]
    double anderson_darling = 0, anderson_darling_p = 0;      // p simulated or NaN [-]
}};

struct Reference {{
    std::vector<double> values;
    double mean = 0, deviation = 0, variation = 0, skewness = 0;
    Interval mean_interval, chi_square_interval;  // 95 %
    Interval bca_interval;  // 95 %, of the deviation, from 999 resamples of the LCG
    std::array<FamilyReference, 4> families;
    std::size_t chi_square_bins = 0;
    std::vector<std::size_t> band_ranks;
    std::vector<double> band_lower, band_upper;
    std::vector<double> histogram_edges;
    std::vector<std::size_t> histogram_counts;
}};

inline constexpr double simulated_p_samples = {SIMULATED};

// clang-format off
"""

print(HEADER)
print_sample("strengths", np.exp(12.4 + 0.3 * special.ndtri(uniforms(7, 40))))
print_sample("stiffnesses", 3e7 * (-np.log(uniforms(11, 57))) ** (1 / 1.4))
print("// clang-format on\n")
print("}  // namespace grainfield::triaxial::statistics")
