// LAMMPS dump files, https://docs.lammps.org/dump.html: snapshots of items, each a line
// "ITEM: NAME ..." and what belongs to it.
//   UNITS              name of the unit system (where dump_modify units yes)
//   TIMESTEP           number
//   NUMBER OF ATOMS    number
//   BOX BOUNDS ...     three lines "lower upper"
//   ATOMS id x y ...   one line an atom, columns as named

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

#include "core/files/lammps_units.hpp"
#include "core/files/sphere_formats.hpp"
#include "core/files/text_file.hpp"
#include "core/files/text_form.hpp"

namespace grainfield::core {
namespace {

/// One snapshot as it stands there, in the file's units.
struct Snapshot {
    std::int64_t step = 0, atoms = -1;
    std::optional<Box> box;
    std::vector<std::string_view> columns;
    std::vector<double> rows;  ///< as many as columns an atom; texts are 0
    std::vector<std::int32_t> lines;
    std::int32_t header_line = 0;
};

class DumpReader {
  public:
    DumpReader(std::string_view text, const std::filesystem::path& path)
        : lines_(text), path_(path) {}

    SphereFile read() {
        std::string_view line;
        while (lines_.next(line)) {
            if (trim(line).empty()) continue;
            if (!line.starts_with("ITEM:")) fail("a line 'ITEM: ...' must stand here");
            item(trim(line.substr(5)));
        }
        if (snapshots_ == 0) fail("ITEM: ATOMS is missing");
        return spheres();
    }

  private:
    [[noreturn]] void fail(const std::string& message) const {
        throw_at_line(path_, std::max(lines_.number(), 1), message);
    }

    std::string_view next_line(std::string_view item) {
        std::string_view line;
        if (!lines_.next(line) || line.starts_with("ITEM:"))
            fail(fmt::format("ITEM: {} ends too soon", item));
        return trim(line);
    }

    double number(std::string_view name, std::string_view word) const {
        double value = 0.0;
        if (!parse_number(word, value)) fail(bad_value(name, word, "must be a finite number"));
        return value;
    }

    std::int64_t whole(std::string_view name, std::string_view word) const {
        std::int64_t value = 0;
        if (!parse_number(word, value) || value < 0)
            fail(fmt::format("{} = {}: must be an integer >= 0", name, shortened(word)));
        return value;
    }

    void item(std::string_view name) {
        if (name == "UNITS") {
            units_ = next_line(name);
        } else if (name == "TIMESTEP") {
            now_ = {};
            now_.step = whole("TIMESTEP", next_line(name));
        } else if (name == "TIME") {
            (void)next_line(name);
        } else if (name == "NUMBER OF ATOMS") {
            now_.atoms = whole("NUMBER OF ATOMS", next_line(name));
        } else if (name.starts_with("BOX BOUNDS")) {
            box(name);
        } else if (name.starts_with("ATOMS")) {
            atoms(name.substr(5));
        } else {
            fail(
                fmt::format("ITEM: {}: not known; allowed: UNITS, TIMESTEP, TIME, NUMBER OF ATOMS, "
                            "BOX BOUNDS, ATOMS",
                            shortened(name)));
        }
    }

    void box(std::string_view name) {
        if (name.find("xy") != std::string_view::npos || name.find("abc") != std::string_view::npos)
            fail("BOX BOUNDS: the box is tilted: must be along x, y, z");
        Box box;
        for (int axis = 0; axis < 3; ++axis) {
            std::string_view line = next_line("BOX BOUNDS");
            box.lower[axis] = number("BOX BOUNDS", next_word(line));
            box.upper[axis] = number("BOX BOUNDS", next_word(line));
            if (box.upper[axis] <= box.lower[axis]) fail("BOX BOUNDS: the second must be larger");
        }
        now_.box = box;
    }

    void atoms(std::string_view names) {
        if (now_.atoms < 0) fail("ITEM: NUMBER OF ATOMS must come before ATOMS");
        now_.header_line = lines_.number();
        for (std::string_view w = next_word(names); !w.empty(); w = next_word(names))
            now_.columns.push_back(w);
        for (std::int64_t i = 0; i < now_.atoms; ++i) {
            std::string_view line = next_line("ATOMS");
            std::size_t count = 0;
            for (std::string_view w = next_word(line); !w.empty(); w = next_word(line), ++count) {
                const bool text = count < now_.columns.size() && now_.columns[count] == "element";
                now_.rows.push_back(text
                                        ? 0.0
                                        : number(count < now_.columns.size()
                                                     ? fmt::format("column {}", now_.columns[count])
                                                     : "column",
                                                 w));
            }
            if (count != now_.columns.size())
                fail(fmt::format("{} numbers, but ITEM: ATOMS names {} columns", count,
                                 now_.columns.size()));
            now_.lines.push_back(lines_.number());
        }
        ++snapshots_;
        last_ = std::move(now_);
        now_ = {};
    }

    /// Column of the last snapshot; npos: none.
    std::size_t column(std::string_view name) const {
        const auto found = std::find(last_.columns.begin(), last_.columns.end(), name);
        return found == last_.columns.end() ? std::string_view::npos
                                            : std::size_t(found - last_.columns.begin());
    }
    static constexpr std::size_t none = std::string_view::npos;

    [[noreturn]] void missing(const std::string& what) const {
        throw_at_line(
            path_, last_.header_line,
            fmt::format("ITEM: ATOMS has no column {}; required: x y z (or xu yu zu, xs ys "
                        "zs) and radius or diameter",
                        what));
    }

    LammpsUnits units() const {
        if (units_.empty()) return {"si"};
        const auto known = lammps_units(units_);
        if (!known || !known->scaled) throw_at_line(path_, 1, unusable_units(units_));
        return *known;
    }

    /// Fills a column of vectors from three named ones, if the first is there.
    bool fill(const std::array<std::string_view, 3>& names, double factor, Vec3Column& out) const {
        if (column(names[0]) == none) return false;
        Column<double>* const to[] = {&out.x, &out.y, &out.z};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::size_t c = column(names[axis]);
            if (c == none) missing(std::string(names[axis]));
            for (std::size_t i = 0; i < order_.size(); ++i) (*to[axis])[i] = factor * value(i, c);
        }
        return true;
    }

    double value(std::size_t i, std::size_t column) const {
        return last_.rows[order_[i] * last_.columns.size() + column];
    }

    void fill_positions(const LammpsUnits& units, SphereFile& file) const {
        Vec3Column& x = file.spheres.position;
        if (fill({"x", "y", "z"}, units.length, x) || fill({"xu", "yu", "zu"}, units.length, x))
            return;
        const bool scaled = fill({"xs", "ys", "zs"}, 1, x) || fill({"xsu", "ysu", "zsu"}, 1, x);
        if (!scaled) missing("x");
        if (!file.box) throw_at_line(path_, last_.header_line, "xs needs ITEM: BOX BOUNDS");
        for (std::size_t i = 0; i < x.size(); ++i)
            x.set(i, file.box->lower + x[i].cwiseProduct(file.box->size()));
    }

    SphereFile spheres() {
        const LammpsUnits units = this->units();
        SphereFile file;
        ParticleStore& s = file.spheres;
        order_.resize(last_.lines.size());
        std::iota(order_.begin(), order_.end(), std::size_t{0});
        if (const std::size_t id = column("id"); id != none) {
            const std::size_t width = last_.columns.size();
            std::stable_sort(order_.begin(), order_.end(), [&](std::size_t a, std::size_t b) {
                return last_.rows[a * width + id] < last_.rows[b * width + id];
            });
        }
        s.resize(order_.size());
        if (last_.box)
            file.box = Box{units.length * last_.box->lower, units.length * last_.box->upper};
        fill_positions(units, file);
        fill_sizes(units, file);
        const bool moves = fill({"vx", "vy", "vz"}, units.velocity, s.velocity);
        file.has_velocity = fill({"omegax", "omegay", "omegaz"}, units.spin, s.spin) || moves;
        for (std::size_t i : order_) file.lines.push_back(last_.lines[i]);
        if (snapshots_ > 1)
            file.notes.push_back(
                fmt::format("the last of {} snapshots, time step {}", snapshots_, last_.step));
        if (units.name != "si")
            file.notes.push_back(fmt::format("units {}: converted to SI", units.name));
        if (units_.empty())
            if (const std::string why = implausible_in_si(file); !why.empty())
                throw_at_line(
                    path_, last_.header_line,
                    fmt::format("{} in the item 'ITEM: UNITS' (dump_modify units yes)", why));
        return file;
    }

    void fill_sizes(const LammpsUnits& units, SphereFile& file) const {
        ParticleStore& s = file.spheres;
        const bool by_radius = column("radius") != none;
        const std::size_t size = column(by_radius ? "radius" : "diameter");
        if (size == none) missing("radius");
        const std::size_t mass = column("mass"), density = column("density");
        for (std::size_t i = 0; i < s.size(); ++i) {
            const auto positive = [&](std::size_t c) {
                if (!(value(i, c) > 0))
                    throw_at_line(
                        path_, last_.lines[order_[i]],
                        fmt::format("column {} = {}: must be > 0", last_.columns[c], value(i, c)));
                return value(i, c);
            };
            s.radius[i] = units.length * positive(size) * (by_radius ? 1.0 : 0.5);
            if (mass != none)
                s.mass[i] = units.mass * positive(mass);
            else if (density != none)
                s.mass[i] = units.density * positive(density) * sphere_volume(s.radius[i]);
        }
    }

    LineReader lines_;
    const std::filesystem::path& path_;
    std::string_view units_;
    Snapshot now_, last_;
    std::int64_t snapshots_ = 0;
    std::vector<std::size_t> order_;  ///< rows of the last snapshot by id
};

}  // namespace

SphereFile parse_lammps_dump(std::string_view text, const std::filesystem::path& path) {
    return DumpReader(text, path).read();
}

}  // namespace grainfield::core
