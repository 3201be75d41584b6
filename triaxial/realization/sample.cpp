#include "triaxial/realization/sample.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "core/base/errors.hpp"
#include "core/files/sphere_checks.hpp"
#include "core/neighbour_search.hpp"
#include "randomfield/generators/generator.hpp"
#include "randomfield/verification/field_error.hpp"
#include "triaxial/realization/given_packing.hpp"

namespace grainfield::triaxial {
namespace {

// Spheres at rest under any load have less room, unless they stick to each other [-].
constexpr double loosest_porosity = 0.6;

}  // namespace

core::SphereFile read_packing(const std::filesystem::path& path, const Config& config) {
    return packing_for_test(core::read_spheres(path), path, config);
}

core::SphereFile packing_for_test(core::SphereFile file, const std::filesystem::path& path,
                                  const Config& config) {
    core::ParticleStore& s = file.spheres;
    core::check_spheres(s, path.string(), file.lines);
    std::vector<std::pair<std::int32_t, std::int32_t>> candidates;
    for (const auto [i, j] : core::find_pairs(s.position, s.radius, 0.0))
        candidates.emplace_back(i, j);
    core::check_overlaps(s, candidates, path.string(), file.lines);

    // The properties of our own files were those of how they were made.
    const bool ours = file.kind == "packing" || file.kind == "start";
    if (!file.has_normal_stiffness || ours)
        std::fill(s.normal_stiffness.begin(), s.normal_stiffness.end(),
                  config.particle.normal_stiffness);
    if (!file.has_friction_angle || ours)
        std::fill(s.friction_angle.begin(), s.friction_angle.end(), config.particle.friction_angle);
    if (ours) file.has_normal_stiffness = file.has_friction_angle = false;
    using randomfield::Variable;
    const Variable variable = config.field.variable;
    const bool friction = variable == Variable::friction || variable == Variable::both;
    const bool stiffness = variable == Variable::stiffness || variable == Variable::both;
    if ((friction && file.has_friction_angle) || (stiffness && file.has_normal_stiffness))
        throw InputError(
            fmt::format("{}: brings a column for the property that field.variable makes random; "
                        "leave out the one or the other",
                        path.string()));
    const core::Column<double> given = s.mass;
    s.set_density(config.particle.density);
    for (std::size_t i = 0; i < s.size(); ++i)
        if (given[i] > 0) s.mass[i] = given[i];
    std::string note;
    file.box = box_of_packing(file, &note);
    if (!note.empty()) file.notes.push_back(note);
    const double porosity = 1 - s.solid_volume() / file.box->volume();
    if (file.kind.empty() && porosity > loosest_porosity)
        file.notes.push_back(
            fmt::format("spheres fill only {:.1f} % of the box around them: this is no packing "
                        "yet, the isotropic stage makes one of it",
                        100 * (1 - porosity)));
    return file;
}

Sample sample_of(core::SphereFile file, const std::filesystem::path& path) {
    Sample sample{std::move(file.spheres), *file.box};
    const auto found = file.extra.find("contacts");
    if (file.kind != "start" || found == file.extra.end()) return sample;
    const auto damaged = [&] {
        return FileError(fmt::format("{}: its contacts are damaged", path.string()));
    };
    const core::ExtraArray& contacts = found->second;  // rows of i, j, shear force on i
    if (contacts.shape.size() != 2 || contacts.shape[1] != 5) throw damaged();
    const auto spheres = static_cast<double>(sample.spheres.size());
    for (std::size_t k = 0; k < contacts.shape[0]; ++k) {
        const double* row = contacts.values.data() + 5 * k;
        if (!(row[0] >= 0 && row[0] < spheres && row[1] >= -6 && row[1] < spheres)) throw damaged();
        sample.contacts.push_back({static_cast<std::int32_t>(row[0]),
                                   static_cast<std::int32_t>(row[1]),
                                   Vec3(row[2], row[3], row[4])});
    }
    return sample;
}

void check_field_data(const Config& config) {
    if (config.field.data.empty() || config.field.variable == randomfield::Variable::none) return;
    const randomfield::FieldGenerator reads({config.packing.blocks, config.packing.block},
                                            config.field);
}

std::optional<double> field_covariance_error(const Config& config) {
    if (config.field.variable == randomfield::Variable::none) return std::nullopt;
    const randomfield::GridSpec grid{config.packing.blocks, config.packing.block};
    // Only circulant embedding knows it of itself, at any size.
    if (grid.size() > randomfield::max_error_cells &&
        config.field.method != randomfield::Method::circulant)
        return std::nullopt;
    const auto generator = randomfield::make_generator(
        grid, {config.field.correlation_length, config.field.correlation}, config.field.method,
        config.field.stage0_cells);
    return randomfield::covariance_error(*generator).covariance;
}

namespace {

// More than any compression strains a sample [-].
constexpr double most_grid_strain = 1.0 / 3;

/// Of the grid over the sample along each axis [-]: it strains with the sample, which may have been
/// compressed since the packing was held against it (config_of_packing()). Throws InputError where
/// spheres have to be found by place and the grid is another sample's.
Vec3 grid_stretch(const randomfield::GridSpec& grid, const Sample& sample) {
    const auto& blocks = sample.spheres.block;
    const bool by_place = std::find(blocks.begin(), blocks.end(), core::no_block) != blocks.end();
    const Vec3 size = sample.box.size();
    Vec3 stretch;
    for (int axis = 0; axis < 3; ++axis) {
        const double length = grid.cells[static_cast<std::size_t>(axis)] * grid.cell_size[axis];
        stretch[axis] = length / size[axis];
        if (by_place && std::abs(stretch[axis] - 1) > most_grid_strain)
            throw InputError(fmt::format(
                "packing.blocks = [{}, {}, {}]: the field's grid measures {:g} m along {}, but the "
                "sample {:.4g} m",
                grid.cells[0], grid.cells[1], grid.cells[2], length, "xyz"[axis], size[axis]));
    }
    return stretch;
}

}  // namespace

FieldRecord map_field(const Config& config, std::int64_t realization, Sample& sample) {
    FieldRecord record;
    record.variable = config.field.variable;
    record.realization = realization;
    if (config.field.variable == randomfield::Variable::none) return record;
    const randomfield::FieldGenerator generator({config.packing.blocks, config.packing.block},
                                                config.field);
    record.field = generator.draw(static_cast<std::uint64_t>(realization));
    record.gamma = generator.gamma();

    core::ParticleStore& s = sample.spheres;
    std::vector<std::size_t> cell(s.size());
    const Vec3 stretch = grid_stretch(generator.grid(), sample);
    for (std::size_t i = 0; i < s.size(); ++i) {
        const core::BlockIndex& block = s.block[i];
        if (block == core::no_block) {
            cell[i] =
                generator.grid().index_at(stretch.cwiseProduct(s.position[i] - sample.box.lower));
            continue;
        }
        for (std::size_t a = 0; a < 3; ++a)
            if (block[a] < 0 || block[a] >= config.packing.blocks[a])
                throw InputError(
                    fmt::format("packing.blocks = [{}, {}, {}]: sphere {} of the packing is in "
                                "block ({}, {}, {}), outside the "
                                "field's grid; give the blocks of the packing",
                                config.packing.blocks[0], config.packing.blocks[1],
                                config.packing.blocks[2], i, block[0], block[1], block[2]));
        cell[i] = generator.grid().index_of_block(block);
    }
    randomfield::BlockField::map(record.field.friction_angle, cell, s.friction_angle);
    randomfield::BlockField::map(record.field.normal_stiffness, cell, s.normal_stiffness);
    if (const auto& k = record.field.normal_stiffness; !k.empty()) {
        record.mean_ratio_expected = generator.stiffness_mean_ratio();
        record.mean_ratio_cells =
            std::accumulate(k.begin(), k.end(), 0.0) / static_cast<double>(k.size()) /
            generator.marginals(randomfield::Property::normal_stiffness).point_mean();
    }
    return record;
}

}  // namespace grainfield::triaxial
