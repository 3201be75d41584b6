#pragma once
// A domain: a compact part of the sample that one thread works on at a time, with the working
// copies of its spheres, copies of the neighbours outside ("ghosts"), and its own lists. Contacts
// across a border are computed in both domains, from the same numbers to the same bits; each
// domain adds up the forces on its own spheres alone. So nothing depends on the threads.

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "core/scene/world.hpp"
#include "core/vector/candidate_list.hpp"
#include "kernels/vector/vector_kernels.hpp"

namespace grainfield::core {

/// Candidates of one wall.
template <class T>
struct WallList {
    std::int32_t wall = 0;
    CandidateList<T> list;
};

/// Columns of Domain::bodies; the mass only where there is gravity.
enum BodyColumn : std::size_t { inverse_mass, spin_response, inverse_reserve, mass };
inline constexpr std::size_t weightless_columns = 3, body_columns = 4;

template <class T>
struct Domain {
    std::size_t first = 0;  ///< slot of the first of its spheres
    std::size_t own = 0;    ///< how many it has

    // Records: own spheres, padding, ghosts, and one that is idle.
    Aligned<kernels::SphereRecord<T>> records;
    Aligned<T> bodies;                                         ///< of own spheres: columns()
    std::vector<std::int32_t> ghost_slots;                     ///< ascending
    std::vector<const kernels::SphereRecord<T>*> ghost_homes;  ///< where ghosts are copied from

    /// All that can become candidates before the next search, ascending by slots: row after row
    /// of the pairs that have one first record. Rows belong to the ghosts whose slots are below
    /// those of the domain, then to its own spheres.
    Proposals neighbours;
    Aligned<std::int32_t> row_end;  ///< of each row, among the neighbours
    CandidateList<T> pairs;
    std::vector<WallList<T>> walls;

    // Results of the last pass.
    kernels::PassResult pass;
    std::vector<kernels::WallLoad> wall_loads;  ///< one a wall of the scene
    double resultant_sum = 0;                   ///< of |resultant| of its own spheres [N]
    kernels::MoveResult motion;
    Box centres;                   ///< of its own spheres when the lists were built [m]
    double largest_reach = 0;      ///< of its own spheres: radius and reserve [m]
    double reach_per_reserve = 0;  ///< the largest (radius + reserve)/reserve [-]
    /// Contacts on their way to the next lists, where `neighbours` are newer than `pairs`.
    std::vector<KeptContact<T>> kept;
    bool neighbours_are_new = false;

    std::size_t ghost_begin() const { return kernels::padded(own); }
    /// Column of `bodies`.
    T* body(std::size_t column) { return bodies.data() + column * ghost_begin(); }
    /// For the kernel that moves them; places by slot.
    kernels::BodyColumns<T> columns(const Vec3Column& built) {
        return {own,
                body(inverse_mass),
                body(spin_response),
                body(mass),
                body(inverse_reserve),
                built.x.data() + first,
                built.y.data() + first,
                built.z.data() + first};
    }
    std::int32_t idle() const { return static_cast<std::int32_t>(records.size() - 1); }
    bool owns(std::int32_t slot) const {
        const auto s = static_cast<std::size_t>(slot);
        return s >= first && s < first + own;
    }
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
    std::int32_t record(std::int32_t slot) const;
    /// First record of the pairs of a row.
    std::int32_t row_record(std::size_t row) const {
        const std::size_t low = row_end.size() - own;
        return static_cast<std::int32_t>(row < low ? ghost_begin() + row : row - low);
    }
    /// Calls use(a, b) with the records of all neighbours.
    template <class Use>
    void for_neighbours(const Use& use) const {
        std::size_t p = 0;
        for (std::size_t row = 0; row < row_end.size(); ++row)
            for (; p < static_cast<std::size_t>(row_end[row]); ++p)
                use(row_record(row), neighbours.b[p]);
    }
};

/// What the lists of a domain are built from; all indexed by slot.
struct BuiltState {
    Vec3Column position;      ///< centres [m]
    Column<float> reserve;    ///< what a sphere may move beyond the box's strain [m]
    double wall_reserve = 0;  ///< what a wall may deviate from the box's strain [m]
};

/// Radii by slot [m], which the scene keeps by sphere.
struct SlotRadii {
    std::span<const std::int32_t> sphere;  ///< of each slot
    std::span<const double> radius;        ///< of each sphere [m]
    double operator[](std::size_t slot) const {
        return radius[static_cast<std::size_t>(sphere[slot])];
    }
};

/// Memory of a thread to build lists in.
template <class T>
struct ListScratch {
    Proposals near_wall;
    Aligned<std::int32_t> firsts;         ///< of proposals
    Aligned<kernels::BuiltPlace> places;  ///< of a domain, as its records
    Aligned<T> separation;                ///< of proposals, in blocks
    std::vector<KeptContact<T>> kept;
};

/// Gives the domain new neighbours: `pairs` as slots, ascending by (i, j), i < j, at least one of
/// the two its own. Contacts that touch keep their history. Ghosts' records are left to copy, and
/// the lists have to be built.
template <class T>
void set_neighbours(Domain<T>& domain, std::span<const kernels::Pair> pairs);

/// Replaces the pairs of the spheres `slots` (ascending) by those of `pairs`, which are theirs in
/// all domains, in the order of set_neighbours(). A domain that has nothing to do with these
/// spheres stays as it is.
template <class T>
void exchange_neighbours(Domain<T>& domain, std::span<const std::int32_t> slots,
                         std::span<const kernels::Pair> pairs);

/// Chooses the candidates among the neighbours; contacts that touch keep their history.
template <class T>
void build_pair_list(Domain<T>& domain, const BuiltState& state, const SlotRadii& radii,
                     const kernels::VectorKernels<T>& kernels, ListScratch<T>& scratch);

/// Chooses the candidates of every wall; contacts that touch keep their history.
template <class T>
void build_wall_lists(Domain<T>& domain, const BuiltState& state, const SlotRadii& radii,
                      std::span<const Wall> walls, ListScratch<T>& scratch);

}  // namespace grainfield::core
