#include "core/engine.hpp"

#include "core/reference/reference_engine.hpp"
#include "core/vector/vector_engine.hpp"

namespace grainfield::core {

std::unique_ptr<Engine> make_engine(World& world, const kernels::KernelTable& kernels) {
    if (kernels.mixed) return std::make_unique<VectorEngine<float>>(world, *kernels.mixed);
    if (kernels.full) return std::make_unique<VectorEngine<double>>(world, *kernels.full);
    return std::make_unique<ReferenceEngine>(world, *kernels.reference);
}

}  // namespace grainfield::core
