#include "tests/fuzz/made_h5.hpp"

#include <array>
#include <cstdint>
#include <cstring>
#include <vector>

#include "core/files/hdf5_handle.hpp"

namespace grainfield::fuzz {
namespace {

using core::Hdf5Handle;

/// Reads the recipe from its beginning to its end and zeros from there on.
class Recipe {
  public:
    explicit Recipe(std::string_view bytes) : bytes_(bytes) {}
    unsigned below(unsigned n) {
        if (bytes_.empty()) return 0;
        const auto byte = static_cast<unsigned char>(bytes_.front());
        bytes_.remove_prefix(1);
        return byte % n;
    }

  private:
    std::string_view bytes_;
};

/// What a value of any type is cut from: as long as the largest shape needs.
constexpr std::size_t most_bytes = std::size_t{1} << 16;
struct Values {
    std::vector<unsigned char> bytes = std::vector<unsigned char>(most_bytes);

    template <class T>
    void fill(const std::vector<T>& values) {
        std::memcpy(bytes.data(), values.data(), values.size() * sizeof(T));
    }
};

/// Another type than the one there should be; its values are whatever the bytes mean in it.
Hdf5Handle other_type(Recipe& recipe) {
    const std::array<hid_t, 8> numbers{H5T_NATIVE_DOUBLE, H5T_NATIVE_FLOAT, H5T_STD_I64LE,
                                       H5T_STD_U8LE,      H5T_IEEE_F64BE,   H5T_STD_I32BE,
                                       H5T_STD_B16LE,     H5T_STD_U64LE};
    constexpr auto close = H5Tclose;
    switch (recipe.below(5)) {
        case 0: {  // text of fixed length
            Hdf5Handle text(H5Tcopy(H5T_C_S1), close);
            H5Tset_size(text, 1 + recipe.below(200));
            return text;
        }
        case 1: {
            const hsize_t size = 1 + recipe.below(4);
            return {H5Tarray_create2(numbers[recipe.below(8)], 1, &size), close};
        }
        case 2: {
            Hdf5Handle compound(H5Tcreate(H5T_COMPOUND, 16), close);
            H5Tinsert(compound, "a", 0, numbers[recipe.below(8)]);
            H5Tinsert(compound, "b", 8, H5T_STD_U8LE);
            return compound;
        }
        case 3:
            return {H5Tcreate(H5T_OPAQUE, 1 + recipe.below(40)), close};
        default:
            return {H5Tcopy(numbers[recipe.below(8)]), close};
    }
}

Hdf5Handle other_space(Recipe& recipe) {
    const unsigned rank = recipe.below(5);
    if (rank == 4) return {H5Screate(H5S_NULL), H5Sclose};
    if (rank == 0) return {H5Screate(H5S_SCALAR), H5Sclose};
    std::vector<hsize_t> dims(rank);
    for (hsize_t& n : dims) n = recipe.below(7);
    return {H5Screate_simple(static_cast<int>(rank), dims.data(), nullptr), H5Sclose};
}

/// Puts numbers that mean trouble, or any, in place of some.
void other_values(Recipe& recipe, Values& values) {
    constexpr std::array<std::uint64_t, 8> trouble{0x7ff8000000000000,
                                                   0x7ff0000000000000,
                                                   0xfff0000000000000,
                                                   0xffffffffffffffff,
                                                   0x7fffffffffffffff,
                                                   0x8000000000000000,
                                                   1,
                                                   0x7fefffffffffffff};
    for (unsigned k = recipe.below(3);; --k) {
        const std::size_t at = 8 * static_cast<std::size_t>(recipe.below(8));
        const unsigned which = recipe.below(9);
        std::uint64_t word = which < 8 ? trouble[which] : 0;
        for (int b = 0; which == 8 && b < 8; ++b) word = word << 8 | recipe.below(256);
        std::memcpy(values.bytes.data() + at, &word, 8);
        if (k == 0) return;
    }
}

/// One thing of the file: how it should be, and how the recipe has it.
struct Thing {
    Hdf5Handle type, space;
    Values values;
    bool missing = false;

    void change(Recipe& recipe) {
        switch (recipe.below(8)) {
            case 1:
                missing = true;
                break;
            case 2:
                type = other_type(recipe);
                break;
            case 3:
                space = other_space(recipe);
                break;
            case 4:
                type = other_type(recipe);
                space = other_space(recipe);
                break;
            case 5:
                other_values(recipe, values);
                break;
            case 6:
                other_values(recipe, values);
                space = other_space(recipe);
                break;
            default:
                break;
        }
        const hssize_t points = H5Sget_simple_extent_npoints(space);
        const std::size_t room = most_bytes / H5Tget_size(type);
        if (points > 0 && static_cast<std::size_t>(points) > room) missing = true;
    }
};

class Kitchen {
  public:
    Kitchen(hid_t file, Recipe& recipe) : file_(file), recipe_(recipe) {}

    bool group(const char* path) {
        if (recipe_.below(64) == 63) return false;
        return bool(
            Hdf5Handle(H5Gcreate2(file_, path, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose));
    }
    template <class T>
    void dataset(const std::string& path, const std::vector<hsize_t>& dims, hid_t type,
                 const std::vector<T>& values) {
        Thing thing{
            {H5Tcopy(type), H5Tclose},
            {H5Screate_simple(static_cast<int>(dims.size()), dims.data(), nullptr), H5Sclose},
            {}};
        thing.values.fill(values);
        thing.change(recipe_);
        if (thing.missing) {
            // Or a name that leads elsewhere.
            const unsigned instead = recipe_.below(3);
            if (instead == 1) group(path.c_str());
            if (instead == 2)
                H5Lcreate_soft("/VTKHDF/PointData/mass", file_, path.c_str(), H5P_DEFAULT,
                               H5P_DEFAULT);
            return;
        }
        const Hdf5Handle made(H5Dcreate2(file_, path.c_str(), thing.type, thing.space, H5P_DEFAULT,
                                         H5P_DEFAULT, H5P_DEFAULT),
                              H5Dclose);
        // Or one whose values were never written.
        if (made && recipe_.below(32) != 31)
            H5Dwrite(made, thing.type, H5S_ALL, H5S_ALL, H5P_DEFAULT, thing.values.bytes.data());
    }
    void text(const char* name, const std::string& value) {
        Thing thing{{H5Tcopy(H5T_C_S1), H5Tclose}, {H5Screate(H5S_SCALAR), H5Sclose}, {}};
        H5Tset_size(thing.type, value.size());
        thing.values.fill(std::vector<char>(value.begin(), value.end()));
        attribute(name, thing);
    }
    void integer(const char* name, std::int64_t value) {
        Thing thing{{H5Tcopy(H5T_STD_I64LE), H5Tclose}, {H5Screate(H5S_SCALAR), H5Sclose}, {}};
        thing.values.fill(std::vector<std::int64_t>{value});
        attribute(name, thing);
    }

  private:
    void attribute(const char* name, Thing& thing) {
        thing.change(recipe_);
        if (thing.missing) return;
        const Hdf5Handle made(H5Acreate_by_name(file_, "/grainfield", name, thing.type, thing.space,
                                                H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                              H5Aclose);
        if (made) H5Awrite(made, thing.type, thing.values.bytes.data());
    }

    hid_t file_;
    Recipe& recipe_;
};

}  // namespace

std::string made_h5(std::string_view bytes) {
    const core::Hdf5Session session;
    const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    H5Pset_fapl_core(access, std::size_t{1} << 16, false);
    const Hdf5Handle file(
        H5Fcreate(core::hdf5_in_memory_name().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access),
        H5Fclose);
    Recipe recipe(bytes);
    Kitchen kitchen(file, recipe);
    if (kitchen.group("/grainfield")) {
        kitchen.integer("format_version", 1);
        kitchen.text("producer", "grainfield");
        kitchen.text("kind", "packing");
        kitchen.text("attributes", "{\"porosity\": 0.4, \"seed\": [1, null]}");
        for (const char* flag :
             {"has_normal_stiffness", "has_friction_angle", "has_velocity", "has_block"})
            kitchen.integer(flag, 1);
        kitchen.dataset<double>("/grainfield/box", {2, 3}, H5T_NATIVE_DOUBLE, {0, 0, 0, 1, 1, 1});
        if (kitchen.group("/grainfield/extra"))
            kitchen.dataset<double>("/grainfield/extra/depth", {2}, H5T_NATIVE_DOUBLE, {1, 2});
    }
    if (kitchen.group("/VTKHDF") && kitchen.group("/VTKHDF/PointData")) {
        const std::string data = "/VTKHDF/PointData/";
        kitchen.dataset<std::int64_t>("/VTKHDF/NumberOfPoints", {1}, H5T_STD_I64LE, {2});
        kitchen.dataset<double>("/VTKHDF/Points", {2, 3}, H5T_NATIVE_DOUBLE,
                                {0.2, 0.2, 0.2, 0.4, 0.4, 0.4});
        for (const char* name : {"radius", "mass", "normal_stiffness", "friction_angle"})
            kitchen.dataset<double>(data + name, {2}, H5T_NATIVE_DOUBLE, {0.1, 0.1});
        for (const char* name : {"velocity", "spin"})
            kitchen.dataset<double>(data + name, {2, 3}, H5T_NATIVE_DOUBLE, {1, 2, 3, 4, 5, 6});
        kitchen.dataset<std::int32_t>(data + "block", {2, 3}, H5T_STD_I32LE, {0, 0, 0, 1, 1, 1});
    }
    // This layout has no checksums, and so H5Fget_file_image gives a sound copy.
    H5Fflush(file, H5F_SCOPE_GLOBAL);
    const ssize_t size = H5Fget_file_image(file, nullptr, 0);
    std::string image(size > 0 ? static_cast<std::size_t>(size) : 0, '\0');
    H5Fget_file_image(file, image.data(), image.size());
    return image;
}

}  // namespace grainfield::fuzz
