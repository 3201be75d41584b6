#pragma once
// Builds an HDF5 file in memory. Equal content gives equal bytes: no time stamps.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/files/hdf5_handle.hpp"

namespace grainfield::core {

class Hdf5Writer {
  public:
    /// FileError if HDF5 refuses (so do all functions here); that is memory running out.
    Hdf5Writer();

    void group(const std::string& path);

    /// A dataset of this shape; values row by row, as many as the shape's product
    /// (std::invalid_argument otherwise). Checksummed and lightly compressed.
    template <class T>
    void dataset(const std::string& path, const std::vector<std::size_t>& shape,
                 std::span<const T> values) {
        write_dataset(path, shape, hdf5_type<T>, values.data(), values.size());
    }

    /// Attributes of the group or dataset at `path`.
    void attribute(const std::string& path, const std::string& name, const std::string& value);
    void attribute(const std::string& path, const std::string& name,
                   std::span<const std::int64_t> values);

    /// The file's bytes. The writer is done then.
    std::string finish();

  private:
    void write_dataset(const std::string& path, const std::vector<std::size_t>& shape,
                       Hdf5Type type, const void* values, std::size_t count);
    void write_attribute(const std::string& path, const std::string& name, hid_t type, hid_t space,
                         const void* value);

    Hdf5Session session_;
    std::unique_ptr<std::string> image_;  ///< filled when file_ closes; its address is with HDF5
    Hdf5Handle file_;
};

}  // namespace grainfield::core
