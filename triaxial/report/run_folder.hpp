#pragma once
// The folder of one triaxial run, read and checked as a whole.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/scene/energy.hpp"
#include "core/scene/particle_store.hpp"
#include "triaxial/realization/failure.hpp"
#include "triaxial/report/curve_file.hpp"
#include "triaxial/report/json_file.hpp"
#include "triaxial/report/mohr.hpp"

namespace grainfield::triaxial::report {

/// What the page shows first; the rest is looked up in `summary` where it is printed.
struct KeyResults {
    double confining_stress = 0;         ///< sigma_3 [Pa]
    double peak_deviator_stress = 0;     ///< [Pa]
    double axial_strain_at_peak = 0;     ///< [-]
    double E50 = 0;                      ///< secant modulus at half the peak [Pa]
    double friction_angle = 0;           ///< macroscopic [rad]
    std::optional<double> smoothed_E50;  ///< where the file has it [Pa]
    Failure failure = Failure::peak;     ///< what the largest deviator stress is
};

struct RunFolder {
    std::filesystem::path path;
    JsonFile summary;
    KeyResults results;
    Curve curve;
    std::string config;                     ///< config.toml as it stands
    std::vector<core::EnergyRow> energies;  ///< energy.csv; empty where there is none
    std::optional<JsonFile> packing;        ///< packing.json; none where the packing was a .csv
    core::ParticleStore spheres;            ///< the final sample
    core::Box box;                          ///< of the final sample
};

/// Throws FileError naming the file that is missing or corrupt, and how.
RunFolder read_run_folder(const std::filesystem::path& dir);

/// Of summary.json. Throws FileError naming the key that is missing or wrong.
KeyResults results_of(const JsonFile& summary);

/// Only what the Mohr circle of a run needs, from its summary.json.
MohrCircle read_mohr_circle(const std::filesystem::path& dir);

/// What a run's summary says of its soil (MohrCircle::soil).
std::map<std::string, std::string> soil_of(const JsonFile& summary);

/// "friction", "stiffness" and the like in words for the page's title.
std::string case_in_words(const JsonFile& summary);

}  // namespace grainfield::triaxial::report
