#pragma once
// The checksum of files that must be known to be whole: XXH3, 128 bits.

#include <xxhash.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>

namespace grainfield::core {

class Checksum {
  public:
    using Digest = std::array<char, 16>;  ///< in the canonical order of XXH3

    Checksum() : state_(XXH3_createState(), XXH3_freeState) { XXH3_128bits_reset(state_.get()); }
    void add(const char* data, std::size_t size) {
        XXH3_128bits_update(state_.get(), data, size);
        length_ += size;
    }
    std::uint64_t length() const { return length_; }  ///< so far [B]
    Digest digest() const {
        XXH128_canonical_t canonical;
        XXH128_canonicalFromHash(&canonical, XXH3_128bits_digest(state_.get()));
        Digest digest;
        std::memcpy(digest.data(), canonical.digest, digest.size());
        return digest;
    }

  private:
    std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state_;
    std::uint64_t length_ = 0;
};

/// 32 digits.
std::string hex_text(const Checksum::Digest& digest);

/// The checksum of a file's content, as such a text. Throws FileError.
std::string checksum_of_file(const std::filesystem::path& file);

}  // namespace grainfield::core
