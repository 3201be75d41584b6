// LAMMPS data files of spheres. The layout is that of
// https://docs.lammps.org/read_data.html: a first line that is skipped, header lines
// "VALUES keyword", then sections, each a keyword line, a line that is skipped, and its rows:
//   Atoms      # sphere   atom-ID atom-type diameter density x y z [image flags nx ny nz]
//   Velocities            atom-ID vx vy vz wx wy wz
// The first line may name the units, and the style as well; other styles: lammps_style.hpp.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "core/base/errors.hpp"
#include "core/files/lammps_style.hpp"
#include "core/files/lammps_units.hpp"
#include "core/files/sphere_checks.hpp"
#include "core/files/sphere_formats.hpp"
#include "core/files/text_file.hpp"
#include "core/files/text_form.hpp"
#include "core/neighbour_search.hpp"

namespace grainfield::core {
namespace {

constexpr double default_density = 2600.0;  ///< of a sphere without mass; Tran et al.'s [kg/m3]

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
        // The first line is a title. LAMMPS skips it; write_data names the units there.
        if (line.find('\r') != std::string_view::npos)
            fail("its lines end with CR alone (old Mac): must end with LF or CRLF");
        title_ = line;
        units_name_ = named_units(line);
        if (!units_name_.empty()) {
            const auto units = lammps_units(units_name_);
            if (!units || !units->scaled) fail(unusable_units(units_name_));
            units_ = *units;
        }
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
            fail("column " + bad_value(name, word, "must be a finite number"));
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
                            "ylo yhi, zlo zhi{}",
                            shortened(trim(line)),
                            keyword.ends_with("bonds") || keyword.ends_with("angles")
                                ? "; bonds are those of molecules: the atom style must be sphere"
                                : ""));
    }

    /// Reads the section that `line` names and leaves the next one's name there. False at the end.
    bool section(std::string_view& line) {
        const std::string_view name = trim(line.substr(0, line.find('#')));
        const std::size_t hash = line.find('#');
        const std::string_view style =
            hash == std::string_view::npos ? "" : trim(line.substr(hash + 1));
        if (name == "Atoms") {
            if (seen_atoms_) fail("section Atoms stands twice");
            atoms(style_of(style));
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

    /// Seven numbers a line may be those of several styles: the file has to say which.
    LammpsStyle style_of(std::string_view comment) const {
        const std::string_view name = comment.empty() ? named_style(title_) : comment;
        if (name.empty())
            fail(
                fmt::format("the atom style is not said: must stand behind the name of the "
                            "section, 'Atoms # sphere'; can be read: {}",
                            lammps_sphere_styles));
        const auto style = lammps_style(name);
        if (!style)
            fail(fmt::format("atom style '{}': must be {}, which have a diameter and a density",
                             shortened(name), lammps_sphere_styles));
        return *style;
    }

    void atoms(const LammpsStyle& style) {
        seen_atoms_ = true;
        hybrid_layout_ = style.hybrid ? style.layout : "";
        for (std::int64_t i = 0; i < count_; ++i) {
            const auto words = row("Atoms", i);
            // Behind them may stand three image flags.
            if (words.size() != style.columns && words.size() != style.columns + 3)
                fail(fmt::format("{} numbers; must be: {}", words.size(), style.layout));
            Atom a;
            a.id = atom_id(words[0]);
            a.line = lines_.number();
            const std::string_view diameter = words[style.diameter], density = words[style.density];
            a.diameter = units_.length * number("diameter", diameter);
            if (a.diameter <= 0) fail(fmt::format("column diameter = {}: must be > 0 m", diameter));
            a.density = units_.density * number("density", density);
            if (a.density <= 0)
                fail(fmt::format("column density = {}: must be > 0 kg/m3", density));
            for (std::size_t axis = 0; axis < 3; ++axis)
                a.position[axis] = units_.length * number(std::string_view("xyz").substr(axis, 1),
                                                          words[style.first_of_xyz + axis]);
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
            const double v = units_.velocity, w = units_.spin;
            found->velocity = {v * number("vx", words[1]), v * number("vy", words[2]),
                               v * number("vz", words[3])};
            found->spin = {w * number("wx", words[4]), w * number("wy", words[5]),
                           w * number("wz", words[6])};
        }
    }

    SphereFile result() const {
        SphereFile file;
        file.box = Box{units_.length * box_.lower, units_.length * box_.upper};
        file.has_velocity = seen_velocities_;
        ParticleStore& s = file.spheres;
        s.resize(atoms_.size());
        for (std::size_t i = 0; i < s.size(); ++i) {
            const Atom& a = atoms_[i];
            s.radius[i] = a.diameter / 2;
            s.mass[i] = a.density * sphere_volume(s.radius[i]);
            s.position.set(i, Vec3(a.position.data()));
            s.velocity.set(i, Vec3(a.velocity.data()));
            s.spin.set(i, Vec3(a.spin.data()));
            file.lines.push_back(a.line);
        }
        if (units_.name != "si")
            file.notes.push_back(fmt::format("units {}: converted to SI", units_.name));
        check_plausible(file);
        return file;
    }

    /// What no sample of spheres can be is a sign that the numbers mean something else.
    void check_plausible(const SphereFile& file) const {
        const std::string why = units_name_.empty() ? implausible_in_si(file) : "";
        if (!why.empty())
            throw_at_line(
                path_, 1,
                fmt::format("{} in the first line ('units = cgs', or 'units = si')", why));
        if (hybrid_layout_.empty()) return;
        // A hybrid has its positions first; files that only call themselves so do not.
        const ParticleStore& s = file.spheres;
        std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
        for (const auto [i, j] : find_pairs(s.position, s.radius, 0.0)) pairs.emplace_back(i, j);
        try {
            check_overlaps(s, pairs, path_.string(), file.lines);
        } catch (const InputError& error) {
            throw InputError(
                fmt::format("{}; the columns of this atom style are: {}; those of sphere: {}",
                            error.what(), hybrid_layout_, lammps_style("sphere")->layout));
        }
    }

    LineReader lines_;
    const std::filesystem::path& path_;
    std::int64_t count_ = -1;  ///< of atoms, as announced
    // LAMMPS' own default where the header says nothing.
    Box box_{Vec3::Constant(-0.5), Vec3::Constant(0.5)};
    std::vector<Atom> atoms_;  ///< by id once the section is read
    std::string_view title_, units_name_;
    LammpsUnits units_{"si"};
    std::string hybrid_layout_;  ///< empty: another style
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
        const double density = s.mass[i] > 0 ? s.mass[i] / sphere_volume(r) : default_density;
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
