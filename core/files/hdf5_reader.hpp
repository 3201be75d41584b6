#pragma once
// Reads an HDF5 file from memory. Every failure is a FileError that names the file and the part of
// it that is missing or damaged.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/files/hdf5_handle.hpp"

namespace grainfield::core {

class Hdf5Reader {
  public:
    /// Opens the bytes of a file; `path` is for messages. FileError if they are not HDF5 or cut.
    Hdf5Reader(std::string_view image, std::filesystem::path path);

    bool has(const std::string& object) const;
    /// Names in a group, sorted.
    std::vector<std::string> names(const std::string& group) const;
    std::vector<std::size_t> shape(const std::string& dataset) const;

    /// All values of a dataset, row by row. Its element type must be of T's class.
    template <class T>
    std::vector<T> read(const std::string& dataset) const {
        std::vector<T> values(readable_size(dataset, hdf5_type<T>));
        if (!values.empty()) read_into(dataset, hdf5_type<T>, values.data());
        return values;
    }

    std::string text_attribute(const std::string& object, const std::string& name) const;
    /// An integer attribute's only value.
    std::int64_t integer_attribute(const std::string& object, const std::string& name) const;

    /// A line for every dataset in the file: its path and shape.
    std::string list() const;

    /// FileError "path: message".
    [[noreturn]] void fail(const std::string& message) const;

  private:
    Hdf5Handle open(const std::string& dataset) const;
    Hdf5Handle open_attribute(const std::string& object, const std::string& name) const;
    /// Fails where a dataset's values stand in other files, or are more than this file can hold.
    void require_here(hid_t dataset, const std::string& name) const;
    void require_room(double bytes, const std::string& name) const;
    std::size_t readable_size(const std::string& dataset, Hdf5Type type) const;
    void read_into(const std::string& dataset, Hdf5Type type, void* values) const;

    Hdf5Session session_;
    std::filesystem::path path_;
    std::size_t image_size_;  // [B]
    Hdf5Handle file_;
};

}  // namespace grainfield::core
