// Coordination numbers with and without rattlers, counted anew from the spheres of the file.

#include <gtest/gtest.h>

#include "tests/cases/sample.hpp"

namespace grainfield::case_tests {
namespace {

using program_tests::Outcome;
using program_tests::Workplace;

/// Contacts of every sphere, with the walls of the box too [-].
std::vector<int> contacts_of(const core::SphereFile& file) {
    const core::ParticleStore& s = file.spheres;
    std::vector<int> count(s.size(), 0);
    for (std::size_t i = 0; i < s.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j)
            if ((s.position[i] - s.position[j]).norm() < s.radius[i] + s.radius[j]) {
                ++count[i];
                ++count[j];
            }
        for (int axis = 0; axis < 3; ++axis) {
            const double at = s.position[i][axis];
            count[i] += at - s.radius[i] < file.box->lower[axis] ? 1 : 0;
            count[i] += at + s.radius[i] > file.box->upper[axis] ? 1 : 0;
        }
    }
    return count;
}

/// What P.json says of P.h5 is what the spheres say.
void expect_counted(const Workplace& place) {
    const std::vector<int> count = contacts_of(core::read_spheres(place.path("P.h5")));
    double all = 0, none = 0, one = 0;
    for (const int contacts : count) {
        all += contacts;
        none += contacts == 0 ? 1 : 0;
        one += contacts == 1 ? 1 : 0;
    }
    const auto n = static_cast<double>(count.size());
    const nlohmann::json json = place.json("P.json");
    // One contact more or less, whose overlap is round-off, is 2/n.
    const double contact = 2.5 / n;
    EXPECT_NEAR(json.at("coordination_number").get<double>(), all / n, contact);
    const double mechanical = json.at("mechanical_coordination_number");
    // Thornton (2000): (2C - N1)/(N - N0 - N1).
    EXPECT_NEAR(mechanical, (all - one) / (n - none - one), 1.5 * contact);
    EXPECT_NEAR(json.at("rattler_fraction").get<double>(), (none + one) / n, contact);
    // Spheres without contacts can only lower the plain number.
    EXPECT_GE(mechanical, json.at("coordination_number").get<double>());
}

TEST(Coordination, OfAPackingIsThatOfItsSpheres) {
    const Workplace place;
    std::vector<std::string> arguments{"pack", "--out", place.path("P.h5")};
    arguments.insert(arguments.end(), program_tests::small_packing.begin(),
                     program_tests::small_packing.end());
    // Six walls and no gravity: a fifth of the spheres carries nothing.
    arguments.insert(arguments.end(), {"--set", "packing.isotropic_stress=1e5"});
    const Outcome compressed = place.run(arguments);
    ASSERT_EQ(compressed.code, 0) << compressed.err;
    expect_counted(place);
    EXPECT_GT(place.json("P.json").at("rattler_fraction").get<double>(), 0.05);
}

}  // namespace
}  // namespace grainfield::case_tests
