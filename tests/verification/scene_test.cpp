#include "tests/verification/scene_test.hpp"

#include <unistd.h>

#include <fstream>
#include <iterator>
#include <numbers>
#include <numeric>
#include <sstream>

#include "kernels/vector/vector_tables.hpp"
#include "triaxial/scene/run_scene.hpp"
#include "triaxial/scene/scene_setup.hpp"

namespace grainfield::verify {
namespace {

namespace fs = std::filesystem;

std::vector<std::vector<double>> read_rows(const fs::path& path) {
    std::ifstream stream(path);
    std::vector<std::vector<double>> rows;
    std::string line;
    std::getline(stream, line);
    while (std::getline(stream, line)) {
        rows.emplace_back();
        std::istringstream fields(line);
        for (std::string field; std::getline(fields, field, ',');)
            rows.back().push_back(std::stod(field));
    }
    return rows;
}

/// A folder of its own, removed with what is in it. In memory where the system has such a place:
/// results are synced to the disk, which takes longer than the runs.
struct Folder {
    Folder() {
        static int count = 0;
        const fs::path memory = "/dev/shm";
        path =
            (access(memory.c_str(), W_OK) == 0 ? memory : fs::temp_directory_path()) /
            ("grainfield_verification_" + std::to_string(getpid()) + "_" + std::to_string(count++));
    }
    ~Folder() { fs::remove_all(path); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    fs::path path;
};

}  // namespace

std::vector<SolverCase> solver_cases() {
    using core::Precision, kernels::InstructionSet;
    std::vector<SolverCase> cases{
        {"reference", {Precision::double_, InstructionSet::scalar}, true, 0x1p-52}};
    for (const InstructionSet set : kernels::instruction_sets) {
        const bool runs = kernels::runs_here(set);
        const std::string name = kernels::name(set);
        if (set != InstructionSet::scalar)
            cases.push_back({name + "_double",
                             {Precision::double_, set},
                             runs && kernels::double_table(set) != nullptr,
                             0x1p-52});
        cases.push_back({name + "_mixed",
                         {Precision::mixed, set},
                         runs && kernels::mixed_table(set) != nullptr,
                         0x1p-23});
    }
    return cases;
}

Motion SceneResult::first(std::size_t i) const {
    return {start.spheres.position[i], start.spheres.velocity[i], start.spheres.spin[i]};
}

double SceneResult::mass(std::size_t i) const {
    return file.particle.density * 4.0 / 3.0 * std::numbers::pi * std::pow(radius(i), 3);
}

double SceneResult::pair_stiffness(std::size_t i, std::size_t j) const {
    const auto& k = start.spheres.normal_stiffness;
    return 0.5 * (radius(i) + radius(j)) * k[i] * k[j] / (k[i] + k[j]);
}

double SceneResult::wall_stiffness(std::size_t i, std::size_t wall) const {
    const double k = start.spheres.normal_stiffness[i], k_wall = file.walls[wall].normal_stiffness;
    return radius(i) * k * k_wall / (k + k_wall);
}

double SceneResult::effective_mass(std::size_t i, std::size_t j) const {
    return mass(i) * mass(j) / (mass(i) + mass(j));
}

double SceneResult::energy_sum(std::size_t row) const {
    return std::accumulate(energy[row].begin() + 1, energy[row].end(), 0.0);
}

void SceneTest::SetUp() {
    if (!GetParam().here)
        GTEST_SKIP() << "not run: this machine lacks the instruction set of " << GetParam().name;
}

triaxial::SceneFile SceneTest::load(const std::string& scene) {
    return triaxial::load_scene(fs::path(GRAINFIELD_SOURCE_DIR "/tests/verification/scenes") /
                                scene / "scene.toml");
}

SceneResult SceneTest::run(triaxial::SceneFile file, const std::string& scene) const {
    file.solver = GetParam().options;
    SceneResult result{file, triaxial::set_up_scene(file), {}, {}, {}, {}, {}};
    const Folder folder;
    core::Monitor silent;
    triaxial::run_scene(file, scene, folder.path, 1, silent);

    for (const auto& row : read_rows(folder.path / "trajectory.csv")) {
        if (row[1] == 0) {
            result.time.push_back(row[0]);
            result.states.emplace_back();
        }
        result.states.back().push_back(
            {{row[2], row[3], row[4]}, {row[5], row[6], row[7]}, {row[8], row[9], row[10]}});
    }
    for (const auto& row : read_rows(folder.path / "contacts.csv"))
        result.contacts.push_back({static_cast<int>(row[0]),
                                   static_cast<int>(row[1]),
                                   row[2],
                                   row[3],
                                   row[7],
                                   {row[4], row[5], row[6]}});
    for (const auto& row : read_rows(folder.path / "energy.csv")) {
        result.energy.emplace_back();
        std::copy_n(row.begin(), 9, result.energy.back().begin());
    }
    std::ifstream(folder.path / "summary.json") >> result.summary;
    EXPECT_EQ(result.summary.at("precision"), is_mixed() ? "mixed" : "double");
    return result;
}

}  // namespace grainfield::verify
