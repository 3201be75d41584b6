// Config keys and their values as figures name them.

#include "triaxial/report/campaign/axis_name.hpp"

#include <gtest/gtest.h>

namespace grainfield::triaxial::report {
namespace {

TEST(AxisName, LegendsHaveTheUnitsOfTheAxes) {
    EXPECT_EQ(value_in_words("triaxial.confining_stress", "200e3"), "σ₃ = 200 kPa");
    EXPECT_EQ(value_in_words("particle.normal_stiffness", "9e8"), "normal stiffness = 900 MPa");
    EXPECT_EQ(value_in_words("field.stiffness.mean_gradient", "-1e8"),
              "stiffness mean gradient = -100 MPa/m");
    EXPECT_EQ(value_in_words("packing.isotropic_stress", "5e4"),
              "packing isotropic stress = 50 kPa");
    EXPECT_EQ(value_in_words("field.correlation_length", "[10, 1, 10]"), "θ = 10, 1, 10 m");
    EXPECT_EQ(value_in_words("field.stiffness.cov", "0.4"), "COV of kₙ = 0.4");
    EXPECT_EQ(value_in_words("field.variable", "\"friction\""), "variable = friction");
    EXPECT_EQ(value_in_words("triaxial.confining_stress", std::nullopt), "σ₃ = not set");
    EXPECT_EQ(value_in_words("time.step", "\"auto\""), "time step = auto");
}

TEST(AxisName, AxesHaveAUnitWhereTheConfigHasOne) {
    EXPECT_EQ(axis_name("triaxial.confining_stress").text, "Confining stress σ_3 (kPa)");
    EXPECT_EQ(axis_name("particle.normal_stiffness").text, "Normal stiffness (MPa)");
    EXPECT_DOUBLE_EQ(axis_name("particle.normal_stiffness").scale, 1e-6);
    EXPECT_EQ(axis_name("triaxial.strain_rate").text, "Strain rate (1/s)");
    EXPECT_EQ(axis_name("packing.porosity").text, "Packing porosity");
    EXPECT_EQ(axis_name("no.such_key").text, "No such key");
    EXPECT_EQ(axis_name("no.such_key").scale, 1);
}

}  // namespace
}  // namespace grainfield::triaxial::report
