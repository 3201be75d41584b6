// The fast engine to and from the archives of checkpoints.

#include <cereal/archives/binary.hpp>
#include <cereal/types/vector.hpp>

#include "core/state/world_state.hpp"
#include "core/vector/vector_engine.hpp"

namespace grainfield::core {

template <class Archive>
void serialize(Archive& archive, Proposals& p) {
    archive(bytes(p.b), bytes(p.bin), bytes(p.count));
}

template <class Archive, class T>
void serialize(Archive& archive, CandidateList<T>& list) {
    archive(bytes(list.a), bytes(list.b), bytes(list.separation), bytes(list.history),
            bytes(list.touching), bytes(list.begin));
}

template <class Archive, class T>
void serialize(Archive& archive, WallList<T>& walls) {
    archive(walls.wall, walls.list);
}

/// Between two steps no outer list is newer than the inner ones, and no contact is on its way.
template <class Archive, class T>
void serialize(Archive& archive, DomainLists<T>& lists) {
    archive(lists.outer, bytes(lists.row_end), lists.inner, lists.walls);
}

/// Without what a step computes anew and where ghosts come from.
template <class Archive, class T>
void serialize(Archive& archive, Domain<T>& d) {
    archive(bytes(d.first), bytes(d.own), bytes(d.records), bytes(d.bodies), bytes(d.ghost_slots));
}

template <class T>
template <class Self, class Archive>
void VectorEngine<T>::list_state(Self& self, Archive& archive) {
    archive(bytes(self.sample_.order.sphere), bytes(self.sample_.order.first), self.sample_.domains,
            self.lists_, self.suspicious_, self.has_masses_);
}

template <class T>
void VectorEngine<T>::save(StateWriter& archive) const {
    list_state(*this, archive);
}

template <class T>
void VectorEngine<T>::load(StateReader& archive) {
    list_state(*this, archive);
    lists_.link_ghosts();
}

template void VectorEngine<float>::save(StateWriter&) const;
template void VectorEngine<double>::save(StateWriter&) const;
template void VectorEngine<float>::load(StateReader&);
template void VectorEngine<double>::load(StateReader&);

}  // namespace grainfield::core
