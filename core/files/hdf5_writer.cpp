#include "core/files/hdf5_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "core/base/errors.hpp"

namespace grainfield::core {
namespace {

void require(bool good, const std::string& what) {
    if (!good) throw FileError(fmt::format("HDF5 cannot make {}: {}", what, hdf5_error()));
}

std::vector<hsize_t> extent(const std::vector<std::size_t>& shape) {
    return {shape.begin(), shape.end()};
}

// HDF5's core driver asks these for memory. When the file is closed it gives its image back, and
// that is where we take it. (H5Fget_file_image is no way: in 1.10 it alters the superblock without
// its checksum, and the copy cannot be opened.)

void* image_malloc(std::size_t size, H5FD_file_image_op_t, void*) {
    return std::malloc(size);
}

void* image_realloc(void* old, std::size_t size, H5FD_file_image_op_t, void*) {
    return std::realloc(old, size);
}

herr_t image_free(void* memory, H5FD_file_image_op_t operation, void* out) {
    if (operation == H5FD_FILE_IMAGE_OP_FILE_CLOSE && out != nullptr) {
        auto* image = static_cast<std::string*>(out);  // as long as the file is
        std::memcpy(image->data(), memory, image->size());
    }
    std::free(memory);
    return 0;
}

void* image_memcpy(void* to, const void* from, std::size_t size, H5FD_file_image_op_t, void*) {
    return std::memcpy(to, from, size);
}

void* same_owner(void* out) {
    return out;
}
herr_t keep_owner(void*) {
    return 0;
}

void collect_image(hid_t access, std::string& image) {
    H5FD_file_image_callbacks_t callbacks{image_malloc, image_memcpy, image_realloc, image_free,
                                          same_owner,   keep_owner,   &image};
    H5Pset_file_image_callbacks(access, &callbacks);
}

}  // namespace

Hdf5Writer::Hdf5Writer() : image_(std::make_unique<std::string>()) {
    const Hdf5Handle access = hdf5_in_memory_access();
    collect_image(access, *image_);
    const Hdf5Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
    H5Pset_obj_track_times(creation, false);
    // The name is only a name: nothing of it reaches the disk.
    file_ = Hdf5Handle(H5Fcreate(hdf5_in_memory_name().c_str(), H5F_ACC_TRUNC, creation, access),
                       H5Fclose);
    require(bool(file_), "a file");
}

void Hdf5Writer::group(const std::string& path) {
    const Hdf5Handle creation(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
    H5Pset_obj_track_times(creation, false);
    const Hdf5Handle made(H5Gcreate2(file_, path.c_str(), H5P_DEFAULT, creation, H5P_DEFAULT),
                          H5Gclose);
    require(bool(made), path);
}

void Hdf5Writer::write_dataset(const std::string& path, const std::vector<std::size_t>& shape,
                               Hdf5Type type, const void* values, std::size_t count) {
    std::size_t product = 1;
    for (std::size_t n : shape) product *= n;
    if (product != count)
        throw std::invalid_argument(
            fmt::format("{}: {} values for a shape of {}", path, count, product));
    const Hdf5Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_obj_track_times(creation, false);
    std::vector<hsize_t> dims = extent(shape);
    if (count > 0 && !dims.empty()) {  // HDF5 knows no chunks of size zero
        std::vector<hsize_t> chunk = dims;
        chunk[0] = std::min<hsize_t>(chunk[0], 32768);
        H5Pset_chunk(creation, static_cast<int>(chunk.size()), chunk.data());
        // Level 1 costs little and halves what is regular: topology, blocks, constant columns.
        H5Pset_shuffle(creation);
        H5Pset_deflate(creation, 1);
        H5Pset_fletcher32(creation);
    }
    const Hdf5Handle space(H5Screate_simple(static_cast<int>(dims.size()), dims.data(), nullptr),
                           H5Sclose);
    const Hdf5Handle made(H5Dcreate2(file_, path.c_str(), hdf5_disk_type(type), space, H5P_DEFAULT,
                                     creation, H5P_DEFAULT),
                          H5Dclose);
    require(bool(made), path);
    if (count == 0) return;
    require(H5Dwrite(made, hdf5_memory_type(type), H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0,
            path);
}

void Hdf5Writer::write_attribute(const std::string& path, const std::string& name, hid_t type,
                                 hid_t space, const void* value) {
    const Hdf5Handle made(H5Acreate_by_name(file_, path.c_str(), name.c_str(), type, space,
                                            H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                          H5Aclose);
    require(made && H5Awrite(made, type, value) >= 0, path + "@" + name);
}

void Hdf5Writer::attribute(const std::string& path, const std::string& name,
                           const std::string& value) {
    // Fixed length, because VTK 9.1 asks for that; at least one byte, because HDF5 does.
    const Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(type, std::max<std::size_t>(value.size(), 1));
    H5Tset_strpad(type, H5T_STR_NULLPAD);
    const bool ascii = std::all_of(value.begin(), value.end(), [](char c) { return c >= 0; });
    H5Tset_cset(type, ascii ? H5T_CSET_ASCII : H5T_CSET_UTF8);
    const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    write_attribute(path, name, type, space, value.c_str());
}

void Hdf5Writer::attribute(const std::string& path, const std::string& name,
                           std::span<const std::int64_t> values) {
    const hsize_t size = values.size();
    const Hdf5Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose);
    write_attribute(path, name, H5T_STD_I64LE, space, values.data());
}

std::string Hdf5Writer::finish() {
    require(H5Fflush(file_, H5F_SCOPE_GLOBAL) >= 0, "a file");
    const ssize_t size = H5Fget_file_image(file_, nullptr, 0);
    require(size > 0, "an image");
    image_->resize(static_cast<std::size_t>(size));
    file_ = Hdf5Handle();  // closes it and fills the image
    return std::move(*image_);
}

}  // namespace grainfield::core
