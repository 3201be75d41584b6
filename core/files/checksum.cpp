#include "core/files/checksum.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <fstream>
#include <vector>

#include "core/base/errors.hpp"
#include "core/files/text_file.hpp"

namespace grainfield::core {

std::string hex_text(const Checksum::Digest& digest) {
    std::string hex;
    for (const char byte : digest) hex += fmt::format("{:02x}", static_cast<unsigned char>(byte));
    return hex;
}

std::string checksum_of_file(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    if (!in)
        throw FileError(fmt::format("{}: cannot be read: {}", file.string(), error_text(errno)));
    Checksum checksum;
    std::vector<char> chunk(std::size_t{1} << 20);
    while (in.read(chunk.data(), static_cast<std::streamsize>(chunk.size())), in.gcount() > 0)
        checksum.add(chunk.data(), static_cast<std::size_t>(in.gcount()));
    return hex_text(checksum.digest());
}

}  // namespace grainfield::core
