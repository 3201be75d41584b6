#pragma once
// Runs the real executable as a user would and captures what it says.

#include <csignal>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace grainfield::program_tests {

struct Outcome {
    int code = -1;  ///< exit code; 128 + signal where a signal ended it [-]
    std::string out, err;
};

/// A signal sent to the running program.
struct SignalAfter {
    int signal = SIGINT;
    std::function<bool()> when;  ///< sent once this is true; asked every few milliseconds
};

bool holds_a_file(const std::filesystem::path& folder);

/// Runs `grainfield ARGUMENTS`; `folder` is where outputs are captured.
Outcome run_program(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                    const std::optional<SignalAfter>& signal = std::nullopt);

/// A folder of its own for each test, with shorthands for what tests do in it.
class Workplace {
  public:
    Workplace();
    ~Workplace();
    Workplace(const Workplace&) = delete;
    Workplace& operator=(const Workplace&) = delete;

    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    /// Writes a file and returns its path.
    std::string write(const std::string& name, const std::string& text) const;
    std::string read(const std::string& name) const;
    bool has(const std::string& name) const { return std::filesystem::exists(folder_ / name); }
    nlohmann::json json(const std::string& name) const;
    Outcome run(const std::vector<std::string>& arguments,
                const std::optional<SignalAfter>& signal = std::nullopt) const;
    /// Runs the program in bash: after `before`, and with these redirections. Returns the program's
    /// exit code, 128 + signal where a signal ended it, also where a pipe follows.
    int run_in_shell(const std::vector<std::string>& arguments, const std::string& redirections,
                     const std::string& before = ":") const;
    /// Writes spheres.csv and scene.toml, runs `simulate` into "run" with `more` arguments.
    Outcome simulate(const std::string& spheres, const std::string& scene,
                     const std::vector<std::string>& more = {}) const;

  private:
    std::filesystem::path folder_;
};

/// How a scene begins whose spheres stand in spheres.csv.
inline const std::string scene_head = "[particles]\nfile = \"spheres.csv\"\n";

/// Further parts of scenes: gravity, and a floor with friction.
inline const std::string falling = "[gravity]\nacceleration = [0, -9.81, 0]\n";
inline const std::string floor_wall =
    "[[wall]]\npoint = [0, 0, 0]\nnormal = [0, 1, 0]\nfriction_angle = 0.3\n";

/// Arguments of `pack` for 120 spheres in two blocks on one thread, a second's work.
extern const std::vector<std::string> small_packing;

/// A table of numbers by the names of its header.
struct Table {
    std::string header;
    std::vector<std::vector<double>> rows;

    double at(std::size_t row, const std::string& column) const;
    std::vector<double> column(const std::string& name) const;
};
Table read_table(const std::string& text);

}  // namespace grainfield::program_tests
