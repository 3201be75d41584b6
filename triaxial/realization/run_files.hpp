#pragma once
// The files of a triaxial run (docs/interface.md): summary.json, curve.csv, energy.csv, state.h5.

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "core/simulation.hpp"
#include "triaxial/realization/sample.hpp"
#include "triaxial/realization/triaxial_test.hpp"

namespace grainfield::triaxial {

struct RunTimes {
    double packing = 0;  ///< making or reading the sample [s]
    double field = 0;    ///< drawing and mapping the field [s]
};

/// summary.json of a finished run.
nlohmann::json run_summary(const TestResult& result, const FieldRecord& field, const Config& config,
                           const core::Simulation& simulation, const RunTimes& times, int threads);

/// curve.csv, header and units of the contract.
std::string curve_csv(const std::vector<CurvePoint>& curve);

/// energy.csv, as that of a scene; from the start of the isotropic stage.
std::string energy_csv(const std::vector<core::EnergyRow>& energies);

/// state.h5: the spheres as they are, with their box, properties and touching contacts. `kind`
/// says what the file is: "state", or "start" of other tests.
void write_state(const std::filesystem::path& path, const core::Simulation& simulation,
                 const std::string& kind = "state");

}  // namespace grainfield::triaxial
