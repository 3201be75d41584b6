#include "triaxial/realization/repeated_start.hpp"

#include "core/base/random.hpp"

namespace grainfield::triaxial {

Sample start_of_repeat(Sample sample, std::uint64_t seed, std::int32_t repeat) {
    if (repeat == 0) return sample;
    const core::RandomStream random(seed, core::Stream::repeated_start);
    core::Vec3Column& position = sample.spheres.position;
    for (std::size_t i = 0; i < position.size(); ++i) {
        Vec3 x = position[i];
        for (int axis = 0; axis < 3; ++axis)
            x[axis] += start_spread * (random.uniform(static_cast<std::uint64_t>(repeat),
                                                      3 * i + static_cast<std::uint64_t>(axis)) -
                                       0.5);
        position.set(i, x);
    }
    return sample;
}

}  // namespace grainfield::triaxial
