#pragma once
// The domain decomposition. A domain is a compact part of the sample that one thread works on at a
// time: working copies of its spheres, and copies of the neighbours outside ("ghosts"). A contact
// across a border is computed in both domains, from the same numbers to the same bits; each domain
// adds up the forces on its own spheres alone. So nothing depends on the threads.

#include <algorithm>
#include <span>
#include <vector>

#include "core/scene/world.hpp"
#include "core/vector/spatial_order.hpp"
#include "kernels/vector/vector_kernels.hpp"

namespace grainfield::core {

/// Columns of Domain::bodies; the mass only where there is gravity.
enum BodyColumn : std::size_t { inverse_mass, spin_response, inverse_buffer, mass };
inline constexpr std::size_t weightless_columns = 3, body_columns = 4;

template <class T>
struct Domain {
    std::size_t first = 0;  ///< slot of the first of its spheres
    std::size_t own = 0;    ///< how many it has

    // Records: own spheres, padding, ghosts, and one that is idle.
    Aligned<kernels::SphereRecord<T>> records;
    Aligned<T> bodies;                                           ///< of own spheres: columns()
    std::vector<std::int32_t> ghost_slots;                       ///< ascending
    std::vector<const kernels::SphereRecord<T>*> ghost_sources;  ///< where ghosts are copied from

    // Results of the last step.
    kernels::PassResult pass;
    std::vector<kernels::WallLoad> wall_loads;  ///< one a wall of the scene
    double resultant_sum = 0;                   ///< of |resultant| of its own spheres [N]
    kernels::MoveResult motion;

    std::size_t ghost_begin() const { return kernels::padded(own); }
    /// Column of `bodies`.
    T* body(std::size_t column) { return bodies.data() + column * ghost_begin(); }
    /// For the kernel that moves them; places by slot.
    kernels::BodyColumns<T> columns(const Vec3Column& built) {
        return {own,
                body(inverse_mass),
                body(spin_response),
                body(mass),
                body(inverse_buffer),
                built.x.data() + first,
                built.y.data() + first,
                built.z.data() + first};
    }
    std::int32_t idle() const { return static_cast<std::int32_t>(records.size() - 1); }
    bool owns(std::int32_t slot) const {
        const auto s = static_cast<std::size_t>(slot);
        return s >= first && s < first + own;
    }
    bool owns_record(std::int32_t record) const { return static_cast<std::size_t>(record) < own; }
    /// Whether a slot has a record here: it is own or a ghost.
    bool knows(std::int32_t slot) const {
        return owns(slot) || std::binary_search(ghost_slots.begin(), ghost_slots.end(), slot);
    }
    /// Slot of a record; ghosts too.
    std::int32_t slot(std::int32_t record) const {
        const auto r = static_cast<std::size_t>(record);
        return r < own ? static_cast<std::int32_t>(first + r) : ghost_slots[r - ghost_begin()];
    }
    /// Record of a slot that the domain knows.
    std::int32_t record(std::int32_t slot) const {
        if (owns(slot)) return slot - static_cast<std::int32_t>(first);
        const auto at = std::lower_bound(ghost_slots.begin(), ghost_slots.end(), slot);
        return static_cast<std::int32_t>(ghost_begin()) +
               static_cast<std::int32_t>(at - ghost_slots.begin());
    }
};

/// All domains of a sample.
template <class T>
struct Decomposition {
    SpatialOrder order;
    std::vector<Domain<T>> domains;

    std::size_t size() const { return domains.size(); }
    Domain<T>& domain_of(std::int32_t slot) { return domains[order.domain_of(slot)]; }
    const Domain<T>& domain_of(std::int32_t slot) const { return domains[order.domain_of(slot)]; }
    /// Sphere of the k-th own record of a domain.
    std::size_t sphere(const Domain<T>& domain, std::size_t k) const {
        return static_cast<std::size_t>(order.sphere[domain.first + k]);
    }
    const kernels::SphereRecord<T>& record(std::size_t slot) const {
        const Domain<T>& domain = domain_of(static_cast<std::int32_t>(slot));
        return domain.records[slot - domain.first];
    }
};

/// Cuts the spheres of a world into domains; records are left to fill.
template <class T>
Decomposition<T> decompose(const World& world);

/// Components of T as a vector in double, and back.
template <class T>
Vec3 vec3(const T (&v)[3]) {
    return {double{v[0]}, double{v[1]}, double{v[2]}};
}
template <class T>
void assign3(T (&to)[3], const Vec3& from) {
    for (int a = 0; a < 3; ++a) to[a] = static_cast<T>(from[a]);
}

/// Radii by slot [m], which the scene keeps by sphere.
struct SlotRadii {
    std::span<const std::int32_t> sphere;  ///< of each slot
    std::span<const double> radius;        ///< of each sphere [m]
    double operator[](std::size_t slot) const {
        return radius[static_cast<std::size_t>(sphere[slot])];
    }
};

}  // namespace grainfield::core
