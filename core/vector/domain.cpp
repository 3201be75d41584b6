#include "core/vector/domain.hpp"

namespace grainfield::core {
namespace {

/// Most spheres of a domain: with their contacts they fill most of a 1 MB cache. A small sample has
/// four domains or more, so that threads share the work, but none so small that most is border.
std::size_t domain_size(std::size_t spheres) {
    return std::clamp<std::size_t>(spheres / 4, 1000, 5000);
}

}  // namespace

template <class T>
Decomposition<T> decompose(const World& world) {
    const Vec3Column& position = world.spheres().position;
    Decomposition<T> sample;
    sample.order = order_in_space(position, domain_size(position.size()));
    const std::vector<std::size_t>& first = sample.order.first;
    sample.domains.resize(first.size() - 1);
    for (std::size_t d = 0; d < sample.size(); ++d) {
        Domain<T>& domain = sample.domains[d];
        domain.first = first[d];
        domain.own = first[d + 1] - first[d];
        domain.records.resize(domain.ghost_begin() + 1);
        domain.bodies.resize(weightless_columns * domain.ghost_begin());
    }
    return sample;
}

template Decomposition<float> decompose(const World&);
template Decomposition<double> decompose(const World&);

}  // namespace grainfield::core
