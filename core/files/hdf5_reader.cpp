#include "core/files/hdf5_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/base/errors.hpp"

namespace grainfield::core {

Hdf5Reader::Hdf5Reader(std::string_view image, std::filesystem::path path)
    : path_(std::move(path)), image_size_(image.size()) {
    if (!image.starts_with("\x89HDF\r\n\x1a\n")) fail("not an HDF5 file");
    const Hdf5Handle access = hdf5_in_memory_access();
    // HDF5 copies the image before it looks at it, const is only missing in the signature.
    H5Pset_file_image(access, const_cast<char*>(image.data()), image.size());
    file_ = Hdf5Handle(H5Fopen(hdf5_in_memory_name().c_str(), H5F_ACC_RDONLY, access), H5Fclose);
    if (!file_) fail(fmt::format("damaged HDF5 file: {}", hdf5_error()));
}

void Hdf5Reader::fail(const std::string& message) const {
    throw FileError(fmt::format("{}: {}", path_.string(), message));
}

bool Hdf5Reader::has(const std::string& object) const {
    // H5Lexists wants every group on the way to exist.
    for (std::size_t end = object.find('/', 1);; end = object.find('/', end + 1)) {
        const std::string part = object.substr(0, end);
        if (H5Lexists(file_, part.c_str(), H5P_DEFAULT) <= 0) return false;
        H5L_info_t info;
        if (H5Lget_info(file_, part.c_str(), &info, H5P_DEFAULT) < 0 ||
            (info.type != H5L_TYPE_HARD && info.type != H5L_TYPE_SOFT))
            fail(fmt::format("{} is a link to another file", part));
        if (end == std::string::npos) return true;
    }
}

std::vector<std::string> Hdf5Reader::names(const std::string& group) const {
    if (!has(group)) fail(fmt::format("{} is missing", group));
    std::vector<std::string> found;
    const auto collect = [](hid_t, const char* name, const H5L_info_t*, void* out) -> herr_t {
        static_cast<std::vector<std::string>*>(out)->emplace_back(name);
        return 0;
    };
    if (H5Literate_by_name(file_, group.c_str(), H5_INDEX_NAME, H5_ITER_INC, nullptr, collect,
                           &found, H5P_DEFAULT) < 0)
        fail(fmt::format("{} is damaged: {}", group, hdf5_error()));
    return found;
}

Hdf5Handle Hdf5Reader::open(const std::string& dataset) const {
    if (!has(dataset)) fail(fmt::format("{} is missing", dataset));
    Hdf5Handle opened(H5Dopen2(file_, dataset.c_str(), H5P_DEFAULT), H5Dclose);
    if (!opened) fail(fmt::format("{} is damaged: {}", dataset, hdf5_error()));
    require_here(opened, dataset);
    return opened;
}

void Hdf5Reader::require_here(hid_t dataset, const std::string& name) const {
    const Hdf5Handle creation(H5Dget_create_plist(dataset), H5Pclose);
    const Hdf5Handle type(H5Dget_type(dataset), H5Tclose);
    const H5D_layout_t layout = H5Pget_layout(creation);
    if (layout == H5D_VIRTUAL || H5Pget_external_count(creation) != 0)
        fail(fmt::format("{} keeps its values in other files", name));
    H5O_info_t here, root;
    if (H5Oget_info2(dataset, &here, H5O_INFO_BASIC) < 0 ||
        H5Oget_info2(file_, &root, H5O_INFO_BASIC) < 0 || here.fileno != root.fileno)
        fail(fmt::format("{} is in another file", name));
    if (layout != H5D_CHUNKED) return;
    // A chunk is unpacked as a whole, however little of it is asked for.
    std::vector<hsize_t> chunk(H5S_MAX_RANK);
    const int rank = H5Pget_chunk(creation, H5S_MAX_RANK, chunk.data());
    auto bytes = static_cast<double>(H5Tget_size(type));
    for (int d = 0; d < rank; ++d) bytes *= static_cast<double>(chunk[static_cast<std::size_t>(d)]);
    require_room(bytes, name);
}

void Hdf5Reader::require_room(double bytes, const std::string& name) const {
    // Positions hardly pack: what is much larger than all of the file is no table of spheres.
    constexpr double small = 64e6, most_packing = 20;
    const double image = static_cast<double>(image_size_);
    if (bytes > small && bytes > most_packing * image)
        fail(fmt::format("{} wants {:.3g} MB of memory out of a file of {:.3g} MB", name,
                         1e-6 * bytes, 1e-6 * image));
}

std::vector<std::size_t> Hdf5Reader::shape(const std::string& dataset) const {
    const Hdf5Handle opened = open(dataset);
    const Hdf5Handle space(H5Dget_space(opened), H5Sclose);
    const int rank = H5Sget_simple_extent_ndims(space);
    if (rank < 0) fail(fmt::format("{} is damaged: {}", dataset, hdf5_error()));
    std::vector<hsize_t> dims(static_cast<std::size_t>(rank));
    H5Sget_simple_extent_dims(space, dims.data(), nullptr);
    return {dims.begin(), dims.end()};
}

std::size_t Hdf5Reader::readable_size(const std::string& dataset, Hdf5Type type) const {
    const Hdf5Handle opened = open(dataset);
    const Hdf5Handle stored(H5Dget_type(opened), H5Tclose);
    const hid_t wanted = hdf5_memory_type(type);
    if (H5Tget_class(stored) != H5Tget_class(wanted))
        fail(fmt::format("{} holds values of another type", dataset));
    // A dataset whose values were never written would read as zeros, and a damaged shape would ask
    // for all memory there is. 1100: more than deflate can ever squeeze.
    std::size_t count = 1;
    const std::size_t most = H5Dget_storage_size(opened) * 1100 / H5Tget_size(wanted);
    for (std::size_t n : shape(dataset)) {
        if (n != 0 && count > most / n) fail(fmt::format("{} is cut short", dataset));
        count *= n;
    }
    require_room(static_cast<double>(count) * static_cast<double>(H5Tget_size(wanted)), dataset);
    return count;
}

void Hdf5Reader::read_into(const std::string& dataset, Hdf5Type type, void* values) const {
    const Hdf5Handle opened = open(dataset);
    if (H5Dread(opened, hdf5_memory_type(type), H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0)
        fail(fmt::format("{} is damaged: {}", dataset, hdf5_error()));
}

Hdf5Handle Hdf5Reader::open_attribute(const std::string& object, const std::string& name) const {
    if (!has(object)) fail(fmt::format("{} is missing", object));
    Hdf5Handle opened(
        H5Aopen_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    if (!opened) fail(fmt::format("attribute {} of {} is missing", name, object));
    return opened;
}

std::string Hdf5Reader::text_attribute(const std::string& object, const std::string& name) const {
    const Hdf5Handle opened = open_attribute(object, name);
    const Hdf5Handle type(H5Aget_type(opened), H5Tclose);
    const Hdf5Handle space(H5Aget_space(opened), H5Sclose);
    // A list of texts would be read past the end of one.
    if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0 ||
        H5Sget_simple_extent_npoints(space) != 1)
        fail(fmt::format("attribute {} of {} is no text of fixed length", name, object));
    if (H5Tget_size(type) > image_size_)
        fail(fmt::format("attribute {} of {} is damaged: longer than the file", name, object));
    std::string value(H5Tget_size(type), '\0');
    if (H5Aread(opened, type, value.data()) < 0)
        fail(fmt::format("attribute {} of {} is damaged: {}", name, object, hdf5_error()));
    value.resize(std::min(value.find_last_not_of('\0') + 1, value.size()));  // npos + 1 is 0
    return value;
}

std::int64_t Hdf5Reader::integer_attribute(const std::string& object,
                                           const std::string& name) const {
    const Hdf5Handle opened = open_attribute(object, name);
    const Hdf5Handle space(H5Aget_space(opened), H5Sclose);
    std::int64_t value = 0;
    if (H5Sget_simple_extent_npoints(space) != 1 || H5Aread(opened, H5T_NATIVE_INT64, &value) < 0)
        fail(fmt::format("attribute {} of {} is no integer", name, object));
    return value;
}

std::string Hdf5Reader::list() const {
    std::vector<std::string> datasets;
    const auto collect = [](hid_t, const char* name, const H5O_info_t* info, void* out) -> herr_t {
        if (info->type == H5O_TYPE_DATASET)
            static_cast<std::vector<std::string>*>(out)->push_back(std::string("/") + name);
        return 0;
    };
    if (H5Ovisit2(file_, H5_INDEX_NAME, H5_ITER_INC, collect, &datasets, H5O_INFO_BASIC) < 0)
        fail(fmt::format("damaged HDF5 file: {}", hdf5_error()));
    std::string text;
    for (const std::string& name : datasets)
        text += fmt::format("  {}: {}\n", name, fmt::join(shape(name), " x "));
    return text;
}

}  // namespace grainfield::core
