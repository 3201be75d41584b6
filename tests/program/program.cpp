#include "tests/program/program.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

extern char** environ;

namespace grainfield::program_tests {
namespace {

namespace fs = std::filesystem;

std::string content(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

/// Waits for the program's end; one that hangs is killed, and the test then sees 128 + SIGKILL.
int wait_for(pid_t child, std::optional<SignalAfter> signal) {
    constexpr int tries = 120 * 200;  // two minutes
    int status = 0;
    for (int k = 0; ::waitpid(child, &status, WNOHANG) == 0; ++k) {
        if (k == tries) ::kill(child, SIGKILL);
        if (signal && signal->when()) {
            ::kill(child, signal->signal);
            signal.reset();
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

bool holds_a_file(const fs::path& folder) {
    std::error_code error;
    const fs::directory_iterator files(folder, error);
    return !error && files != fs::directory_iterator();
}

Outcome run_program(const std::vector<std::string>& arguments, const fs::path& folder,
                    const std::optional<SignalAfter>& signal) {
    const std::string out = (folder / "stdout.txt").string();
    const std::string err = (folder / "stderr.txt").string();
    std::vector<std::string> words{GRAINFIELD_PROGRAM};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);

    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    constexpr int flags = O_CREAT | O_TRUNC | O_WRONLY;
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out.c_str(), flags, 0644);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, err.c_str(), flags, 0644);
    pid_t child = 0;
    const int error =
        ::posix_spawn(&child, GRAINFIELD_PROGRAM, &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0) throw std::runtime_error("cannot start " GRAINFIELD_PROGRAM);
    Outcome outcome;
    outcome.code = wait_for(child, signal);
    outcome.out = content(out);
    outcome.err = content(err);
    return outcome;
}

Workplace::Workplace() {
    std::string name = (fs::temp_directory_path() / "grainfield-program-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    folder_ = name;
}

Workplace::~Workplace() {
    std::error_code error;
    fs::remove_all(folder_, error);
}

std::string Workplace::write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return path(name);
}

std::string Workplace::read(const std::string& name) const {
    return content(folder_ / name);
}

nlohmann::json Workplace::json(const std::string& name) const {
    return nlohmann::json::parse(read(name));
}

Outcome Workplace::run(const std::vector<std::string>& arguments,
                       const std::optional<SignalAfter>& signal) const {
    return run_program(arguments, folder_, signal);
}

int Workplace::run_in_shell(const std::vector<std::string>& arguments,
                            const std::string& redirections, const std::string& before) const {
    std::string command = before + "\n" GRAINFIELD_PROGRAM;
    for (const std::string& word : arguments) command += " '" + word + "'";
    command += " " + redirections + "\nexit ${PIPESTATUS[0]}\n";
    const int status = std::system(("bash '" + write("command.sh", command) + "'").c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

Outcome Workplace::simulate(const std::string& spheres, const std::string& scene,
                            const std::vector<std::string>& more) const {
    write("spheres.csv", spheres);
    std::vector<std::string> arguments{"simulate", write("scene.toml", scene), "--out",
                                       path("run")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
}

const std::vector<std::string> small_packing{"--threads", "1",
                                             "--set",     "packing.blocks=[1,2,1]",
                                             "--set",     "packing.spheres=60",
                                             "--set",     "packing.porosity=0.486",
                                             "--set",     "grading.sieve_diameter=[0.03,0.04,0.06]",
                                             "--set",     "grading.passing=[0,50,100]"};

double Table::at(std::size_t row, const std::string& name) const {
    std::istringstream names(header);
    std::size_t k = 0;
    for (std::string one; std::getline(names, one, ','); ++k)
        if (one == name) return rows.at(row).at(k);
    throw std::out_of_range("no column " + name);
}

std::vector<double> Table::column(const std::string& name) const {
    std::vector<double> values;
    for (std::size_t r = 0; r < rows.size(); ++r) values.push_back(at(r, name));
    return values;
}

Table read_table(const std::string& text) {
    Table table;
    std::istringstream lines(text);
    std::getline(lines, table.header);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream fields(line);
        table.rows.emplace_back();
        for (std::string field; std::getline(fields, field, ',');)
            table.rows.back().push_back(std::stod(field));
    }
    return table;
}

}  // namespace grainfield::program_tests
