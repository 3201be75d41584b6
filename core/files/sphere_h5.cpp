// Sphere files as HDF5 in the VTKHDF layout, https://docs.vtk.org/en/latest/vtk_file_formats/ :
// an UnstructuredGrid of one partition with one vertex cell a sphere. VTK 9.1 takes the positions
// in double precision, so what ParaView shows is what we read back. What VTK has no place for
// (box, flags, attributes, extra arrays) stands in the group /grainfield, which VTK ignores.

#include <array>
#include <numeric>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/files/hdf5_reader.hpp"
#include "core/files/hdf5_writer.hpp"
#include "core/files/json_text.hpp"
#include "core/files/sphere_formats.hpp"

#ifndef GRAINFIELD_VERSION
#define GRAINFIELD_VERSION "(version unknown)"
#endif

namespace grainfield::core {
namespace {

constexpr std::int64_t format_version = 1;
constexpr std::uint8_t vtk_vertex = 1;
const std::string ours = "/grainfield";
const std::string points = "/VTKHDF/Points";
const std::string point_data = "/VTKHDF/PointData";

struct Flag {
    const char* name;
    bool SphereFile::*member;
};
constexpr Flag flags[] = {{"has_normal_stiffness", &SphereFile::has_normal_stiffness},
                          {"has_friction_angle", &SphereFile::has_friction_angle},
                          {"has_velocity", &SphereFile::has_velocity},
                          {"has_block", &SphereFile::has_block}};

struct ScalarColumn {
    const char* name;
    Column<double> ParticleStore::*member;
};
constexpr ScalarColumn scalars[] = {{"radius", &ParticleStore::radius},
                                    {"mass", &ParticleStore::mass},
                                    {"normal_stiffness", &ParticleStore::normal_stiffness},
                                    {"friction_angle", &ParticleStore::friction_angle}};

struct VectorColumn {
    std::string path;
    Vec3Column ParticleStore::*member;
};
const VectorColumn vectors[] = {{points, &ParticleStore::position},
                                {point_data + "/velocity", &ParticleStore::velocity},
                                {point_data + "/spin", &ParticleStore::spin}};

std::vector<double> interleaved(const Vec3Column& v) {
    std::vector<double> values(3 * v.size());
    for (std::size_t i = 0; i < v.size(); ++i) {
        values[3 * i] = v.x[i];
        values[3 * i + 1] = v.y[i];
        values[3 * i + 2] = v.z[i];
    }
    return values;
}

void write_topology(Hdf5Writer& writer, std::size_t n) {
    const std::int64_t count = static_cast<std::int64_t>(n);
    for (const char* name : {"NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds"})
        writer.dataset<std::int64_t>(std::string("/VTKHDF/") + name, {1}, std::span(&count, 1));
    std::vector<std::int64_t> ids(n + 1);
    std::iota(ids.begin(), ids.end(), 0);
    const std::span<const std::int64_t> all(ids);
    writer.dataset<std::int64_t>("/VTKHDF/Connectivity", {n}, all.first(n));
    writer.dataset<std::int64_t>("/VTKHDF/Offsets", {n + 1}, all);
    const std::vector<std::uint8_t> types(n, vtk_vertex);
    writer.dataset<std::uint8_t>("/VTKHDF/Types", {n}, types);
}

void write_columns(Hdf5Writer& writer, const ParticleStore& s) {
    const std::size_t n = s.size();
    for (const ScalarColumn& c : scalars)
        writer.dataset<double>(point_data + "/" + c.name, {n}, s.*c.member);
    for (const VectorColumn& c : vectors)
        writer.dataset<double>(c.path, {n, 3}, interleaved(s.*c.member));
    static_assert(sizeof(BlockIndex) == 3 * sizeof(std::int32_t));
    const std::int32_t* first = n == 0 ? nullptr : s.block.front().data();
    writer.dataset<std::int32_t>(point_data + "/block", {n, 3}, std::span(first, 3 * n));
}

void write_ours(Hdf5Writer& writer, const SphereFile& file) {
    writer.group(ours);
    writer.attribute(ours, "format_version", std::span(&format_version, 1));
    writer.attribute(ours, "producer",
                     file.producer.empty() ? "grainfield " GRAINFIELD_VERSION : file.producer);
    writer.attribute(ours, "kind", file.kind);
    writer.attribute(ours, "attributes", file.attributes.empty() ? "{}" : file.attributes);
    for (const Flag& flag : flags) {
        const std::int64_t value = file.*flag.member ? 1 : 0;
        writer.attribute(ours, flag.name, std::span(&value, 1));
    }
    if (file.box) {
        std::array<double, 6> corners{};
        for (int axis = 0; axis < 3; ++axis) {
            corners[axis] = file.box->lower[axis];
            corners[axis + 3] = file.box->upper[axis];
        }
        writer.dataset<double>(ours + "/box", {2, 3}, corners);
    }
    if (file.extra.empty()) return;
    writer.group(ours + "/extra");
    for (const auto& [name, array] : file.extra)
        writer.dataset<double>(ours + "/extra/" + name, array.shape, array.values);
}

template <class T>
std::vector<T> read_shaped(const Hdf5Reader& reader, const std::string& dataset,
                           const std::vector<std::size_t>& shape) {
    if (reader.shape(dataset) != shape)
        reader.fail(fmt::format("{} has another shape than /VTKHDF/NumberOfPoints says", dataset));
    return reader.read<T>(dataset);
}

void read_columns(const Hdf5Reader& reader, ParticleStore& s) {
    const std::size_t n = s.size();
    for (const ScalarColumn& c : scalars) {
        const auto values = read_shaped<double>(reader, point_data + "/" + c.name, {n});
        (s.*c.member).assign(values.begin(), values.end());
    }
    for (const VectorColumn& c : vectors) {
        const auto values = read_shaped<double>(reader, c.path, {n, 3});
        Vec3Column& v = s.*c.member;
        for (std::size_t i = 0; i < n; ++i)
            v.set(i, {values[3 * i], values[3 * i + 1], values[3 * i + 2]});
    }
    const auto blocks = read_shaped<std::int32_t>(reader, point_data + "/block", {n, 3});
    for (std::size_t i = 0; i < n; ++i)
        s.block[i] = {blocks[3 * i], blocks[3 * i + 1], blocks[3 * i + 2]};
}

void read_ours(const Hdf5Reader& reader, SphereFile& file) {
    const std::int64_t version = reader.integer_attribute(ours, "format_version");
    if (version != format_version)
        reader.fail(
            fmt::format("format version {}; this program reads {}", version, format_version));
    file.producer = reader.text_attribute(ours, "producer");
    file.kind = reader.text_attribute(ours, "kind");
    const std::string text = reader.text_attribute(ours, "attributes");
    if (nested_too_deep(text)) reader.fail("attribute attributes of /grainfield: nested too deep");
    const auto attributes = nlohmann::json::parse(text, nullptr, /*allow_exceptions=*/false);
    if (attributes.is_discarded()) reader.fail("attribute attributes of /grainfield: not JSON");
    if (!attributes.empty()) file.attributes = json_text(attributes);
    for (const Flag& flag : flags)
        file.*flag.member = reader.integer_attribute(ours, flag.name) != 0;
    if (reader.has(ours + "/box")) {
        const auto c = read_shaped<double>(reader, ours + "/box", {2, 3});
        file.box = Box{{c[0], c[1], c[2]}, {c[3], c[4], c[5]}};
    }
    if (!reader.has(ours + "/extra")) return;
    for (const std::string& name : reader.names(ours + "/extra")) {
        const std::string dataset = ours + "/extra/" + name;
        file.extra[name] = {reader.shape(dataset), reader.read<double>(dataset)};
    }
}

/// Another program's VTKHDF: positions and sizes, where it has them.
SphereFile foreign_spheres(const Hdf5Reader& reader) {
    const std::string radius = point_data + "/radius", diameter = point_data + "/diameter";
    const bool by_radius = reader.has(radius);
    const std::string& size = by_radius ? radius : diameter;
    const auto lacks = [&](const std::string& what) {
        reader.fail(
            fmt::format("/grainfield is missing: not a sphere file of grainfield; of other "
                        "VTKHDF files {} and {} are read, and {} is missing",
                        points, radius, what));
    };
    if (!reader.has(points)) lacks(points);
    if (!reader.has(size)) lacks(radius);
    const std::vector<std::size_t> shape = reader.shape(points);
    if (shape.size() != 2 || shape[1] != 3) reader.fail(fmt::format("{}: must be N x 3", points));
    const auto centres = reader.read<double>(points);
    const auto sizes = read_shaped<double>(reader, size, {shape[0]});
    SphereFile file;
    file.spheres.resize(shape[0]);
    for (std::size_t i = 0; i < shape[0]; ++i) {
        file.spheres.position.set(i, Vec3(centres.data() + 3 * i));
        file.spheres.radius[i] = (by_radius ? 1.0 : 0.5) * sizes[i];
    }
    file.notes.emplace_back("VTKHDF of another program: its centres and radii are read, no more");
    return file;
}

}  // namespace

std::string format_sphere_h5(const SphereFile& file) {
    Hdf5Writer writer;
    writer.group("/VTKHDF");
    constexpr std::array<std::int64_t, 2> version{1, 0};
    writer.attribute("/VTKHDF", "Version", version);
    writer.attribute("/VTKHDF", "Type", "UnstructuredGrid");
    write_topology(writer, file.spheres.size());
    writer.group(point_data);
    write_columns(writer, file.spheres);
    write_ours(writer, file);
    return writer.finish();
}

SphereFile parse_sphere_h5(std::string_view image, const std::filesystem::path& path) {
    const Hdf5Reader reader(image, path);
    if (!reader.has(ours)) return foreign_spheres(reader);
    SphereFile file;
    read_ours(reader, file);
    const auto count = read_shaped<std::int64_t>(reader, "/VTKHDF/NumberOfPoints", {1});
    const std::vector<std::size_t> shape = reader.shape(points);
    if (count[0] < 0 || shape.empty() || shape[0] != static_cast<std::size_t>(count[0]))
        reader.fail(fmt::format("{} has another shape than /VTKHDF/NumberOfPoints says", points));
    // Proves that the file really holds that many, before memory is taken for all columns.
    (void)reader.read<double>(points);
    file.spheres.resize(shape[0]);
    read_columns(reader, file.spheres);
    return file;
}

}  // namespace grainfield::core
