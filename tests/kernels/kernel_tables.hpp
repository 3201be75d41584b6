#pragma once
// The kernel tables that the tests of physics run over, each with the round-off to expect. What
// the environment variable GRAINFIELD_TEST_KERNELS says:
//   (nothing)  the reference, and the widest vectors of this machine in double and mixed precision
//   all        every instruction set; `dev test --all`
//   sanitizers the reference and one mixed table

#include <gtest/gtest.h>

#include <cstdlib>
#include <iterator>
#include <ostream>
#include <string>
#include <vector>

#include "kernels/contact_kernels.hpp"
#include "kernels/vector/vector_tables.hpp"

namespace grainfield::kernels {

struct KernelCase {
    std::string name;
    const KernelTable* table;  ///< null where the machine cannot run it
    /// Relative round-off of one contact force or displacement [-]: 2^-52 in double; 2^-23 where
    /// forces and motion are in float.
    double epsilon;
};

inline std::ostream& operator<<(std::ostream& out, const KernelCase& c) {
    return out << c.name;
}

/// What GRAINFIELD_TEST_KERNELS says.
inline std::string chosen_kernels() {
    const char* chosen = std::getenv("GRAINFIELD_TEST_KERNELS");  // NOLINT(concurrency-mt-unsafe)
    return chosen == nullptr ? "" : chosen;
}

/// Instruction sets to test: all, or the widest of this build that runs here.
inline std::vector<InstructionSet> tested_sets() {
    if (chosen_kernels() == "all")
        return {std::begin(instruction_sets), std::end(instruction_sets)};
    InstructionSet widest = instruction_sets[0];
    for (const InstructionSet isa : instruction_sets)
        if (runs_here(isa) && mixed_table(isa) != nullptr) widest = isa;
    return {widest};
}

inline std::vector<KernelCase> kernel_cases() {
    std::vector<KernelCase> cases{{"reference", &reference_kernels(), 0x1p-52}};
    for (const InstructionSet isa : tested_sets()) {
        const bool here = runs_here(isa);
        const std::string set = kernels::name(isa);
        if (chosen_kernels() != "sanitizers")
            cases.push_back({set + "_double", here ? double_table(isa) : nullptr, 0x1p-52});
        cases.push_back({set + "_mixed", here ? mixed_table(isa) : nullptr, 0x1p-23});
    }
    return cases;
}

/// Base of all tests that run on every table.
class KernelTest : public ::testing::TestWithParam<KernelCase> {
  protected:
    void SetUp() override {
        if (GetParam().table == nullptr)
            GTEST_SKIP() << "not run: this machine lacks the instruction set of "
                         << GetParam().name;
    }
    bool is_reference() const { return GetParam().table->reference != nullptr; }
    bool is_mixed() const { return GetParam().table->mixed != nullptr; }
    /// A velocity or spin as the engine keeps it.
    Vec3 as_kept(const Vec3& v) const {
        if (!is_mixed()) return v;
        Vec3 kept;
        for (int a = 0; a < 3; ++a) {
            const volatile auto rounded = static_cast<float>(v[a]);  // really: in single precision
            kept[a] = static_cast<double>(rounded);
        }
        return kept;
    }
    const KernelTable& table() const { return *GetParam().table; }
    /// Tolerance of a result that round-off reaches `operations` times over [-].
    double roundoff(double operations) const { return operations * GetParam().epsilon; }
};

}  // namespace grainfield::kernels

#define GRAINFIELD_FOR_ALL_KERNELS(suite)                                              \
    INSTANTIATE_TEST_SUITE_P(Kernels, suite,                                           \
                             ::testing::ValuesIn(grainfield::kernels::kernel_cases()), \
                             [](const auto& test_info) { return test_info.param.name; })
