#pragma once
// The touching contacts of the fast engine and what they carry from step to step. The kernels keep
// both in the inner lists; here is how others see and restore them.

#include "core/engine.hpp"
#include "core/vector/verlet_lists.hpp"

namespace grainfield::core {

template <class T>
class ContactHistory {
  public:
    ContactHistory(const World& world, const Decomposition<T>& sample, VerletLists<T>& lists)
        : world_(world), sample_(sample), lists_(lists) {}

    /// Engine::touching().
    std::vector<TouchingContact> touching() const;
    std::int64_t touching_count() const;
    /// Contacts with walls of one domain.
    std::int64_t wall_count(std::size_t domain) const;
    /// Engine::restore().
    std::size_t restore(std::span<const ContactShear> contacts);
    /// Takes all shear forces away.
    void clear_shear();

  private:
    Vec3 present_position(std::size_t slot) const;
    TouchingContact pair_contact(std::size_t d, std::size_t k) const;
    TouchingContact wall_contact(const Domain<T>& domain, const WallList<T>& walls,
                                 std::size_t k) const;

    const World& world_;
    const Decomposition<T>& sample_;
    VerletLists<T>& lists_;
};

}  // namespace grainfield::core
