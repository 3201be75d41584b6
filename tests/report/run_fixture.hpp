#pragma once
// A made-up folder of a triaxial run: a curve with a peak, a packing, a sample of mirrored blocks.

#include <array>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace grainfield::triaxial::fixture {

enum class Field { none, stiffness, friction };

struct FixtureOptions {
    double confining_stress = 100e3;              ///< [Pa]
    double friction_angle = 0.5;                  ///< macroscopic, of the peak [rad]
    std::array<std::int32_t, 3> blocks{3, 6, 3};  ///< of 0.25 m [-]
    int spheres_per_block = 120;                  ///< [-]
    Field field = Field::none;
    bool packing = true;  ///< with packing.json
};

/// Writes summary.json, curve.csv, energy.csv, config.toml, packing.json and state.h5 and gives
/// back the summary.
nlohmann::ordered_json write_run(const std::filesystem::path& dir, const FixtureOptions& options);

/// A folder of its own for the running test, removed at the end unless GRAINFIELD_KEEP is set.
class TestFolder {
  public:
    TestFolder();
    ~TestFolder();
    TestFolder(const TestFolder&) = delete;
    TestFolder& operator=(const TestFolder&) = delete;
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

void write_file(const std::filesystem::path& path, const std::string& text);
std::string read_file(const std::filesystem::path& path);

/// How often `what` stands in `text` [-].
std::size_t occurrences(const std::string& text, std::string_view what);

}  // namespace grainfield::triaxial::fixture
