// What libFuzzer calls: one of the targets, GRAINFIELD_FUZZ_TARGET.

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "tests/fuzz/targets.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    grainfield::fuzz::GRAINFIELD_FUZZ_TARGET({reinterpret_cast<const char*>(data), size});
    return 0;
}
