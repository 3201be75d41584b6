#pragma once
// State as bytes, for the archives of checkpoints: what is read back is the same to the bit.
//
// A class lists what it carries from step to step once, for both directions:
//     template <class Archive> void serialize(Archive& archive) { archive(count_, bytes(columns_));
//     }

#include <cstdint>
#include <type_traits>
#include <vector>

namespace cereal {
class BinaryOutputArchive;
class BinaryInputArchive;
}  // namespace cereal

namespace grainfield::core {

using StateWriter = cereal::BinaryOutputArchive;
using StateReader = cereal::BinaryInputArchive;

/// One value whose bytes are all there is to it. Eigen's fixed vectors are, though their copies are
/// spelt out.
template <class T>
struct BytesOfValue {
    T& value;
    template <class Archive>
    void save(Archive& archive) const {
        archive.saveBinary(&value, sizeof(T));
    }
    template <class Archive>
    void load(Archive& archive) {
        archive.loadBinary(&value, sizeof(T));
    }
};

/// A vector of such values: their number, then their bytes.
template <class Vector>
struct BytesOfVector {
    Vector& vector;
    template <class Archive>
    void save(Archive& archive) const {
        const std::uint64_t size = vector.size();
        archive.saveBinary(&size, sizeof size);
        archive.saveBinary(vector.data(), sizeof(vector[0]) * vector.size());
    }
    template <class Archive>
    void load(Archive& archive) {
        std::uint64_t size = 0;
        archive.loadBinary(&size, sizeof size);
        vector.resize(size);
        archive.loadBinary(vector.data(), sizeof(vector[0]) * vector.size());
    }
};

template <class T>
BytesOfValue<T> bytes(T& value) {
    static_assert(std::is_trivially_destructible_v<T> && !std::is_pointer_v<T>);
    return {value};
}
template <class T, class Allocator>
BytesOfVector<std::vector<T, Allocator>> bytes(std::vector<T, Allocator>& vector) {
    static_assert(std::is_trivially_destructible_v<T> && !std::is_pointer_v<T>);
    return {vector};
}
template <class T, class Allocator>
BytesOfVector<const std::vector<T, Allocator>> bytes(const std::vector<T, Allocator>& vector) {
    return {vector};
}

}  // namespace grainfield::core
