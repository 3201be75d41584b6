#include "triaxial/realization/given_packing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/base/errors.hpp"
#include "core/files/json_text.hpp"
#include "triaxial/config/config_keys.hpp"
#include "triaxial/config/toml_text.hpp"

namespace grainfield::triaxial {
namespace {

/// Blocks fit a box where they are off by less than this share of one: the top of a sample is
/// rough.
constexpr double largest_misfit = 0.25;
/// Porosity of a sample that does not say what was asked of it: of the block, not of the sample.
constexpr double porosity_tolerance = 0.01;
/// Density of a file with few digits.
constexpr double density_tolerance = 1e-3;

bool is_ours(const core::SphereFile& file) {
    return file.kind == "packing" || file.kind == "start" || file.kind == "state";
}

class TrueConfig {
  public:
    TrueConfig(const core::SphereFile& file, const std::filesystem::path& path, Config& config,
               const std::set<std::string>& given)
        : file_(file), path_(path), config_(config), given_(given) {
        if (file.kind == "packing") made_ = nlohmann::json::parse(file.attributes, nullptr, false);
    }

    void find() {
        box_ = box_of_packing(file_);
        settle_made();
        settle_porosity();
        settle_density();
        settle_blocks();
        config_.validate();
    }

  private:
    bool given(const std::string& key) const { return given_.contains(key); }

    /// Complains in the words of the key's value as the user gave it.
    [[noreturn]] void contradicts(const std::string& key, const std::string& has) const {
        Config copy = config_;
        std::string value;
        for (const ConfigKey& one : config_keys(copy))
            if (one.path == key)
                if (const auto text = one.slot.get()) value = short_text(*text);
        throw InputError(fmt::format(
            "{} = {}: contradicts the packing {}, {}; leave the key out, or give another "
            "packing",
            key, value, path_.string(), has));
    }

    /// Sets `value` to what the packing was made with, where it says so.
    template <class T, class Equal>
    void made_with(const char* attribute, const std::string& key, T& value, const Equal& equal) {
        if (!made_.is_object() || !made_.contains(attribute)) return;
        T made;
        try {
            made = made_.at(attribute).get<T>();
        } catch (const nlohmann::json::exception&) {
            throw FileError(fmt::format("{}: attribute {} is damaged", path_.string(), attribute));
        }
        if (given(key) && !equal(made, value))
            contradicts(key, fmt::format("which was made with {}", made_.at(attribute).dump()));
        value = std::move(made);
    }
    template <class T>
    void made_with(const char* attribute, const std::string& key, T& value) {
        made_with(attribute, key, value, std::equal_to<>());
    }

    /// The same for what need not have been asked for; a number below 0 says that it was not.
    void made_with_or_without(const char* attribute, const std::string& key,
                              std::optional<double>& value) {
        double made = -1;
        made_with(attribute, "", made);
        if (given(key) && !(value && close(*value, made)))
            contradicts(key, made < 0 ? std::string("which was made without")
                                      : fmt::format("which was made with {}", made));
        value = made < 0 ? std::nullopt : std::optional(made);
    }

    static bool close(double a, double b) { return std::abs(a - b) <= 1e-9 * std::abs(b); }

    void settle_made() {
        const auto close_lists = [](const std::vector<double>& a, const std::vector<double>& b) {
            return std::ranges::equal(a, b, close);
        };
        auto& packing = config_.packing;
        made_with("seed", "packing.seed", packing.seed);
        made_with("gravity_m_s2", "packing.gravity", packing.gravity, close);
        made_with("sieve_diameter_m", "grading.sieve_diameter", config_.grading.sieve_diameter,
                  close_lists);
        made_with("passing_percent", "grading.passing", config_.grading.passing, close_lists);
        if (!made_.is_object()) return;
        if (given("packing.spheres") && made_.contains("block_spheres") && packing.spheres &&
            made_.at("block_spheres") != *packing.spheres)
            contradicts("packing.spheres",
                        fmt::format("whose blocks have {}", made_.at("block_spheres").dump()));
        std::int32_t spheres = 0;
        made_with("asked_spheres", "", spheres);
        if (made_.contains("asked_spheres") && !given("packing.spheres"))
            packing.spheres = spheres > 0 ? std::optional(spheres) : std::nullopt;
        if (!made_.contains("isotropic_stress_Pa")) return;
        double stress = 0;
        made_with("isotropic_stress_Pa", "", stress);
        const double asked = packing.isotropic_stress.value_or(0);
        if (given("packing.isotropic_stress") && !close(asked, stress))
            contradicts("packing.isotropic_stress",
                        stress > 0 ? fmt::format("which was brought to {} Pa", stress)
                                   : "which was brought to none");
        packing.isotropic_stress = stress > 0 ? std::optional(stress) : std::nullopt;
    }

    /// What was asked of a packing, or what its box holds.
    void settle_porosity() {
        if (made_.is_object() && made_.contains("asked_porosity")) {
            packing::PackingOptions& packing = config_.packing;
            made_with_or_without("asked_relative_density", "packing.relative_density",
                                 packing.relative_density);
            made_with_or_without("asked_compaction_friction", "packing.compaction_friction",
                                 packing.compaction_friction);
            // Where the porosity followed, that of a block so high as it came out has its spheres.
            const bool followed = packing.relative_density || packing.compaction_friction;
            double asked = packing.porosity;
            made_with("asked_porosity", "", asked);
            made_with(followed ? "block_porosity" : "asked_porosity", "packing.porosity",
                      packing.porosity,
                      [&](double a, double b) { return close(a, b) || close(asked, b); });
            return;
        }
        const double porosity = 1 - file_.spheres.solid_volume() / box_.volume();
        if (given("packing.porosity") && file_.kind != "start" &&
            std::abs(porosity - config_.packing.porosity) > porosity_tolerance)
            contradicts("packing.porosity", fmt::format("whose porosity is {:.4f}", porosity));
        if (!given("packing.porosity") && porosity > 0.2 && porosity < 0.9)
            config_.packing.porosity = porosity;
    }

    void settle_density() {
        const core::ParticleStore& s = file_.spheres;
        double mass = 0, volume = 0;
        for (std::size_t i = 0; i < s.size(); ++i) {
            if (!(s.mass[i] > 0)) return;  // those get the config's
            mass += s.mass[i];
            volume += core::sphere_volume(s.radius[i]);
        }
        const double density = mass / volume;
        if (given("particle.density") &&
            std::abs(density - config_.particle.density) > density_tolerance * density)
            contradicts("particle.density", fmt::format("whose spheres bring {}", density_text(s)));
        // The last digits of a mean are round-off.
        if (std::abs(density - config_.particle.density) > 1e-9 * density)
            config_.particle.density = density;
    }

    std::optional<std::array<std::int32_t, 3>> blocks_of_spheres() const {
        std::array<std::int32_t, 3> blocks{0, 0, 0};
        if (!file_.has_block) return std::nullopt;
        for (const core::BlockIndex& block : file_.spheres.block) {
            if (block == core::no_block) return std::nullopt;
            for (std::size_t axis = 0; axis < 3; ++axis)
                blocks[axis] = std::max(blocks[axis], block[axis] + 1);
        }
        return blocks;
    }

    void settle_blocks() {
        packing::PackingOptions& packing = config_.packing;
        const bool asked = given("packing.blocks") || given("packing.block");
        made_with("blocks", "packing.blocks", packing.blocks);
        if (made_.is_object() && made_.contains("block_m")) {
            using Block = std::array<double, 3>;
            const auto same = [](const Block& a, const Block& b) {
                return std::ranges::equal(a, b, close);
            };
            // Its height may not be what was asked for; who gives either is right.
            Block block{packing.block.x(), packing.block.y(), packing.block.z()};
            Block asked_block = block;
            made_with("asked_block_m", "", asked_block);
            made_with("block_m", "packing.block", block, [&](const Block& a, const Block& b) {
                return same(a, b) || same(asked_block, b);
            });
            packing.block = Vec3(block.data());
        }
        if (made_.is_object() && made_.contains("blocks")) return;
        const Vec3 size = box_.size();
        const auto blocks = blocks_of_spheres();
        if (blocks) {
            if (given("packing.blocks") && packing.blocks != *blocks)
                contradicts("packing.blocks",
                            fmt::format("whose spheres are in {} x {} x {} blocks", (*blocks)[0],
                                        (*blocks)[1], (*blocks)[2]));
            packing.blocks = *blocks;
        }
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            double& block = packing.block[axis];
            const double whole = std::clamp(std::round(size[axis] / block), 1.0, 1e6);
            if (!blocks && !given("packing.blocks"))
                packing.blocks[a] = static_cast<std::int32_t>(whole);
            const double length = packing.blocks[a] * block;
            // A start may have been compressed by more since its packing was held against them.
            if (asked && file_.kind != "start" &&
                std::abs(length - size[axis]) > largest_misfit * block)
                throw InputError(fmt::format(
                    "packing.blocks = [{}, {}, {}]: of {:g} x {:g} x {:g} m, do not fit the "
                    "packing "
                    "{}, which measures {:.4g} x {:.4g} x {:.4g} m; give packing.blocks and "
                    "packing.block that cover it, or neither",
                    packing.blocks[0], packing.blocks[1], packing.blocks[2], packing.block.x(),
                    packing.block.y(), packing.block.z(), path_.string(), size.x(), size.y(),
                    size.z()));
        }
        // A start's blocks are those of the packing that it was made from.
        if (file_.kind == "start" && asked) return;
        for (int axis = 0; axis < 3; ++axis)
            packing.block[axis] = size[axis] / packing.blocks[static_cast<std::size_t>(axis)];
    }

    const core::SphereFile& file_;
    const std::filesystem::path& path_;
    Config& config_;
    const std::set<std::string>& given_;
    nlohmann::json made_;  ///< null: the file says nothing of how it was made
    core::Box box_;
};

}  // namespace

Config config_of_packing(const core::SphereFile& file, const std::filesystem::path& path,
                         Config config, const std::set<std::string>& given) {
    TrueConfig(file, path, config, given).find();
    return config;
}

core::Box box_of_packing(const core::SphereFile& file, std::string* note) {
    const core::Box spheres = core::bounding_box(file.spheres);
    if (!file.box) return spheres;
    const Vec3 gap = (spheres.lower - file.box->lower).cwiseMax(file.box->upper - spheres.upper);
    const auto& radius = file.spheres.radius;
    const double smallest = radius.empty() ? 0 : std::ranges::min(radius);
    if (is_ours(file) && gap.maxCoeff() <= smallest) return *file.box;
    // Spheres reach out of their own walls by overlaps; out of a periodic box by up to a radius.
    const double outside =
        -(spheres.lower - file.box->lower).cwiseMin(file.box->upper - spheres.upper).minCoeff();
    if (note == nullptr) return spheres;
    if (gap.maxCoeff() > 1e-3 * spheres.size().maxCoeff())
        *note = fmt::format(
            "the file's box is up to {:.4g} m wider than its spheres: walls start at the spheres",
            gap.maxCoeff());
    else if (outside > smallest / 10)
        *note = fmt::format(
            "spheres reach up to {:.4g} m out of the file's box, as in a periodic one: walls start "
            "at the spheres",
            outside);
    return spheres;
}

std::string packing_attributes(const packing::Packing& p) {
    return core::json_text(
        {{"porosity", p.porosity},
         {"seed", p.options.seed},
         {"blocks", p.options.blocks},
         {"block_m", {p.block.size.x(), p.block.size.y(), p.block.size.z()}},
         {"asked_block_m", {p.options.block.x(), p.options.block.y(), p.options.block.z()}},
         {"asked_porosity", p.options.porosity},
         {"asked_relative_density", p.options.relative_density.value_or(-1)},
         {"asked_compaction_friction", p.options.compaction_friction.value_or(-1)},
         {"block_porosity", p.block.porosity},
         {"asked_spheres", p.options.spheres.value_or(0)},
         {"block_spheres", p.block.spheres.size()},
         {"gravity_m_s2", p.options.gravity},
         {"isotropic_stress_Pa", p.options.isotropic_stress.value_or(0)},
         {"sieve_diameter_m", p.grading.sieve_diameter},
         {"passing_percent", p.grading.passing}});
}

std::string density_text(const core::ParticleStore& s) {
    double least = 0, most = 0;
    for (std::size_t i = 0; i < s.size(); ++i) {
        const double density = s.mass[i] / core::sphere_volume(s.radius[i]);
        least = i == 0 ? density : std::min(least, density);
        most = std::max(most, density);
    }
    return most - least > 1e-6 * most ? fmt::format("{:.6g} to {:.6g} kg/m3", least, most)
                                      : fmt::format("{:.6g} kg/m3", most);
}

}  // namespace grainfield::triaxial
