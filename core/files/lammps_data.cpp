// LAMMPS data files of atom_style sphere. The layout is that of
// https://docs.lammps.org/read_data.html: a first line that is skipped, header lines
// "VALUES keyword", then sections, each a keyword line, a line that is skipped, and its rows:
//   Atoms      # sphere   atom-ID atom-type diameter density x y z [image flags nx ny nz]
//   Velocities            atom-ID vx vy vz wx wy wz

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <vector>

#include "core/files/sphere_formats.hpp"
#include "core/files/text_file.hpp"

namespace grainfield::core {
namespace {

constexpr double default_density = 2600.0;  ///< of a sphere without mass; Tran et al.'s [kg/m3]

double volume(double radius) {
    return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
}

struct Atom {
    std::int64_t id = 0;
    std::int32_t line = 0;
    double diameter = 0.0;  ///< [m]
    double density = 0.0;   ///< [kg/m3]
    std::array<double, 3> position{}, velocity{}, spin{};
};

class Parser {
  public:
    Parser(std::string_view text, const std::filesystem::path& path) : lines_(text), path_(path) {}

    SphereFile parse() {
        std::string_view line;
        if (!lines_.next(line)) fail("the file is empty");
        // The first line is a title, and skipped whatever it says.
        bool more = lines_.next_content(line);
        for (; more && !starts_with_letter(line); more = lines_.next_content(line)) header(line);
        if (count_ < 0) fail("header line 'N atoms' is missing");
        while (more) more = section(line);
        if (!seen_atoms_) fail("section Atoms is missing");
        return result();
    }

  private:
    [[noreturn]] void fail(const std::string& message) const {
        throw_at_line(path_, std::max(lines_.number(), 1), message);
    }

    static bool starts_with_letter(std::string_view line) {
        const char c = trim(line).front();
        return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
    }

    double number(std::string_view name, std::string_view word) const {
        double value = 0.0;
        if (!parse_number(word, value))
            fail(fmt::format("column {} = {}: must be a finite number", name,
                             word.empty() ? "(nothing)" : shortened(word)));
        return value;
    }

    void header(std::string_view line) {
        std::string_view rest = trim(line.substr(0, line.find('#')));
        const double first = number("header", next_word(rest));
        const std::string_view keyword = trim(rest);
        if (keyword == "atoms") {
            // 2e9: atom ids beyond are another build of LAMMPS, and more than fits our indices.
            if (first < 0 || first > 2e9 || first != static_cast<double>(std::int64_t(first)))
                fail(fmt::format("header atoms = {}: must be an integer >= 0", first));
            count_ = static_cast<std::int64_t>(first);
            return;
        }
        if (keyword == "atom types") return;
        constexpr std::array<std::string_view, 3> bounds{"xlo xhi", "ylo yhi", "zlo zhi"};
        for (int axis = 0; axis < 3; ++axis) {
            if (!keyword.ends_with(bounds[axis])) continue;
            const double upper = number("header", next_word(rest));
            if (trim(rest) != bounds[axis]) break;
            if (upper <= first) fail(fmt::format("{}: the second must be larger", bounds[axis]));
            box_.lower[axis] = first;
            box_.upper[axis] = upper;
            return;
        }
        // What LAMMPS knows beyond spheres (bonds, tilted boxes, ...) may stand there as zeros.
        bool zeros = first == 0.0;
        while (zeros && !rest.empty() && !starts_with_letter(rest))
            zeros = number("header", next_word(rest)) == 0.0;
        if (!zeros || trim(rest).empty())
            fail(
                fmt::format("header '{}': not supported; allowed: atoms, atom types, xlo xhi, "
                            "ylo yhi, zlo zhi",
                            shortened(trim(line))));
    }

    /// Reads the section that `line` names and leaves the next one's name there. False at the end.
    bool section(std::string_view& line) {
        const std::string_view name = trim(line.substr(0, line.find('#')));
        const std::size_t hash = line.find('#');
        const std::string_view style =
            hash == std::string_view::npos ? "" : trim(line.substr(hash + 1));
        if (name == "Atoms") {
            if (!style.empty() && style != "sphere")
                fail(fmt::format("atom style '{}': must be sphere", shortened(style)));
            atoms();
        } else if (name == "Velocities") {
            velocities();
        } else if (name == "Masses" || name == "Pair Coeffs" || name == "PairIJ Coeffs") {
            // LAMMPS writes these by itself; they say nothing about our spheres.
            bool more = lines_.next_content(line);
            while (more && !starts_with_letter(line)) more = lines_.next_content(line);
            return more;
        } else {
            fail(fmt::format("section '{}': not supported; allowed: Atoms, Velocities",
                             shortened(name)));
        }
        return lines_.next_content(line);
    }

    /// The next row of a section, cut into its words.
    std::vector<std::string_view> row(std::string_view section_name, std::int64_t done) {
        std::string_view line;
        if (!lines_.next_content(line) || starts_with_letter(line))
            fail(fmt::format("section {} ends after {} of {} lines", section_name, done, count_));
        std::string_view rest = line.substr(0, line.find('#'));
        std::vector<std::string_view> words;
        for (std::string_view w = next_word(rest); !w.empty(); w = next_word(rest))
            words.push_back(w);
        return words;
    }

    std::int64_t atom_id(std::string_view word) const {
        std::int64_t id = 0;
        if (!parse_number(word, id) || id < 1)
            fail(fmt::format("column atom-ID = {}: must be an integer >= 1", shortened(word)));
        return id;
    }

    void atoms() {
        if (seen_atoms_) fail("section Atoms stands twice");
        seen_atoms_ = true;
        for (std::int64_t i = 0; i < count_; ++i) {
            const auto words = row("Atoms", i);
            if (words.size() != 7 && words.size() != 10)
                fail(fmt::format("{} numbers; must be: atom-ID atom-type diameter density x y z",
                                 words.size()));
            Atom a;
            a.id = atom_id(words[0]);
            a.line = lines_.number();
            a.diameter = number("diameter", words[2]);
            if (a.diameter <= 0) fail(fmt::format("column diameter = {}: must be > 0 m", words[2]));
            a.density = number("density", words[3]);
            if (a.density <= 0)
                fail(fmt::format("column density = {}: must be > 0 kg/m3", words[3]));
            a.position = {number("x", words[4]), number("y", words[5]), number("z", words[6])};
            atoms_.push_back(a);
        }
        std::sort(atoms_.begin(), atoms_.end(),
                  [](const Atom& a, const Atom& b) { return a.id < b.id; });
        for (std::size_t i = 1; i < atoms_.size(); ++i)
            if (atoms_[i].id == atoms_[i - 1].id)
                fail(fmt::format("section Atoms: atom-ID {} stands twice", atoms_[i].id));
    }

    void velocities() {
        if (!seen_atoms_) fail("section Velocities must come after Atoms");
        seen_velocities_ = true;
        for (std::int64_t i = 0; i < count_; ++i) {
            const auto words = row("Velocities", i);
            if (words.size() != 7)
                fail(fmt::format("{} numbers; must be: atom-ID vx vy vz wx wy wz", words.size()));
            const std::int64_t id = atom_id(words[0]);
            const auto found =
                std::lower_bound(atoms_.begin(), atoms_.end(), id,
                                 [](const Atom& a, std::int64_t value) { return a.id < value; });
            if (found == atoms_.end() || found->id != id)
                fail(fmt::format("column atom-ID = {}: no such atom", id));
            found->velocity = {number("vx", words[1]), number("vy", words[2]),
                               number("vz", words[3])};
            found->spin = {number("wx", words[4]), number("wy", words[5]), number("wz", words[6])};
        }
    }

    SphereFile result() const {
        SphereFile file;
        file.box = box_;
        file.has_velocity = seen_velocities_;
        ParticleStore& s = file.spheres;
        s.resize(atoms_.size());
        for (std::size_t i = 0; i < s.size(); ++i) {
            const Atom& a = atoms_[i];
            s.radius[i] = a.diameter / 2;
            s.mass[i] = a.density * volume(s.radius[i]);
            s.position.set(i, Vec3(a.position.data()));
            s.velocity.set(i, Vec3(a.velocity.data()));
            s.spin.set(i, Vec3(a.spin.data()));
            file.lines.push_back(a.line);
        }
        return file;
    }

    LineReader lines_;
    const std::filesystem::path& path_;
    std::int64_t count_ = -1;  ///< of atoms, as announced
    // LAMMPS' own default where the header says nothing.
    Box box_{Vec3::Constant(-0.5), Vec3::Constant(0.5)};
    std::vector<Atom> atoms_;  ///< by id once the section is read
    bool seen_atoms_ = false;
    bool seen_velocities_ = false;
};

void append_row(std::string& text, std::initializer_list<std::int64_t> ids,
                std::initializer_list<double> values) {
    for (std::int64_t id : ids) {
        append_number(text, id);
        text += ' ';
    }
    for (double value : values) {
        append_number(text, value);
        text += ' ';
    }
    text.back() = '\n';
}

}  // namespace

SphereFile parse_lammps_data(std::string_view text, const std::filesystem::path& path) {
    return Parser(text, path).parse();
}

std::string format_lammps_data(const SphereFile& file) {
    const ParticleStore& s = file.spheres;
    const Box box = file.box.value_or(bounding_box(s));
    std::string text = fmt::format(
        "LAMMPS data file of grainfield, atom_style sphere, units si\n\n{} atoms\n1 atom types\n\n",
        s.size());
    for (int axis = 0; axis < 3; ++axis) {
        append_row(text, {}, {box.lower[axis], box.upper[axis]});
        text.back() = ' ';
        text += fmt::format("{0}lo {0}hi\n", "xyz"[axis]);
    }
    text += "\nAtoms # sphere\n\n";
    for (std::size_t i = 0; i < s.size(); ++i) {
        const double r = s.radius[i];
        const double density = s.mass[i] > 0 ? s.mass[i] / volume(r) : default_density;
        append_row(text, {static_cast<std::int64_t>(i) + 1, 1},
                   {2 * r, density, s.position.x[i], s.position.y[i], s.position.z[i]});
    }
    if (!file.has_velocity) return text;
    text += "\nVelocities\n\n";
    for (std::size_t i = 0; i < s.size(); ++i)
        append_row(text, {static_cast<std::int64_t>(i) + 1},
                   {s.velocity.x[i], s.velocity.y[i], s.velocity.z[i], s.spin.x[i], s.spin.y[i],
                    s.spin.z[i]});
    return text;
}

}  // namespace grainfield::core
