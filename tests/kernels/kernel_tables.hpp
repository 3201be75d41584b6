#pragma once
// The kernel tables that the tests of physics run over, each with the round-off to expect.

#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

#include "kernels/contact_kernels.hpp"

namespace grainfield::kernels {

struct KernelCase {
    std::string name;
    const KernelTable* table;
    /// Relative round-off of one contact force or displacement [-]. Double: 2^-52, forces and
    /// state alike.
    double epsilon;
};

inline std::ostream& operator<<(std::ostream& out, const KernelCase& c) {
    return out << c.name;
}

inline std::vector<KernelCase> kernel_cases() {
    return {{"scalar_double", &reference_kernels(), 0x1p-52}};
}

/// Base of all tests that run on every table.
class KernelTest : public testing::TestWithParam<KernelCase> {
  protected:
    const KernelTable& table() const { return *GetParam().table; }
    /// Tolerance of a result that round-off reaches `operations` times over [-].
    double roundoff(double operations) const { return operations * GetParam().epsilon; }
};

}  // namespace grainfield::kernels

#define GRAINFIELD_FOR_ALL_KERNELS(suite)                                            \
    INSTANTIATE_TEST_SUITE_P(Kernels, suite,                                         \
                             testing::ValuesIn(grainfield::kernels::kernel_cases()), \
                             [](const auto& test_info) { return test_info.param.name; })
