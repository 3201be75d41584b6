#include "tests/cases/sample.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <stdexcept>

namespace grainfield::case_tests {
namespace {

/// Puts a gnuplot that draws nothing in front of the real one, for as long as this process lives.
void blank_figures() {
    static const program_tests::Workplace place;
    static const bool done = [] {
        const std::string stub =
            place.write("gnuplot", "#!/bin/sh\necho '<svg></svg>' >\"${2%.gp}.out\"\n");
        std::filesystem::permissions(stub, std::filesystem::perms::owner_all);
        const char* path = std::getenv("PATH");
        const std::string folders = place.path("") + ":" + (path == nullptr ? "" : path);
        return ::setenv("PATH", folders.c_str(), 1) == 0;
    }();
    if (!done) throw std::runtime_error("PATH cannot be set");
}

}  // namespace

const core::SphereFile& packing() {
    static const core::SphereFile file =
        core::read_spheres(GRAINFIELD_SOURCE_DIR "/tests/cases/packing.txt");
    return file;
}

std::string lammps_text(const LammpsForm& form) {
    const core::ParticleStore& s = packing().spheres;
    const double metre = 1 / form.length_unit;
    std::string text = fmt::format(
        "LAMMPS data file, {}\n\n{} atoms\n1 atom types\n\n0 {} xlo xhi\n0 {} ylo yhi\n0 {} zlo "
        "zhi\n\nAtoms # {}\n\n",
        form.title, s.size() + form.more_rows.size(), 0.25 * metre, form.lid * metre, 0.25 * metre,
        form.style);
    const bool positions_first = form.style.starts_with("hybrid");
    for (std::size_t i = 0; i < s.size(); ++i) {
        const std::string sizes =
            fmt::format("{} {}", 2 * s.radius[i] * metre, form.density / form.density_unit);
        const std::string place = fmt::format("{} {} {}", s.position.x[i] * metre,
                                              s.position.y[i] * metre, s.position.z[i] * metre);
        text += fmt::format("{} 1 {} {}\n", i + 1, positions_first ? place : sizes,
                            positions_first ? sizes : place);
    }
    for (const std::string& row : form.more_rows) text += row + "\n";
    return text;
}

std::string csv_text(const CsvForm& form) {
    const core::ParticleStore& s = packing().spheres;
    std::string text;
    const auto row = [&](const std::vector<std::string>& fields) {
        for (std::size_t c = 0; c < fields.size(); ++c)
            text += (c == 0 ? "" : form.separator) + form.quote + fields[c] + form.quote;
        text += form.line_end;
    };
    const auto number = [&](double value) {
        std::string digits = fmt::format("{}", value);
        if (const auto point = digits.find('.'); point != std::string::npos)
            digits.replace(point, 1, form.decimal);
        return digits;
    };
    row({"x", "y", "z", "radius", "block_i", "block_j", "block_k"});
    for (std::size_t i = 0; i < s.size(); ++i)
        row({number(s.position.x[i]), number(s.position.y[i]), number(s.position.z[i]),
             number(s.radius[i]), "0", s.position.y[i] < 0.25 ? "0" : "1", "0"});
    return text;
}

program_tests::Outcome shear(const program_tests::Workplace& place, const std::string& packing,
                             const std::vector<std::string>& settings, const std::string& strain) {
    blank_figures();
    std::vector<std::string> arguments{"triaxial", "--packing", packing,          "--threads",
                                       "1",        "--out",     place.path("run")};
    arguments.insert(arguments.end(), {"--set", "triaxial.max_axial_strain=" + strain});
    for (const std::string& setting : settings)
        arguments.insert(arguments.end(), {"--set", setting});
    return place.run(arguments);
}

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace grainfield::case_tests
