#include <fmt/format.h>
#include <xxhash.h>

#include "core/simulation.hpp"

namespace grainfield::core {
namespace {

/// Streaming XXH3 over plain values.
class Hasher {
  public:
    Hasher() : state_(XXH3_createState()) { XXH3_64bits_reset(state_); }
    ~Hasher() { XXH3_freeState(state_); }
    Hasher(const Hasher&) = delete;
    Hasher& operator=(const Hasher&) = delete;

    void add(const void* data, std::size_t bytes) { XXH3_64bits_update(state_, data, bytes); }
    void add(const Vec3Column& v) {
        for (const Column<double>* c : {&v.x, &v.y, &v.z})
            add(c->data(), c->size() * sizeof(double));
    }
    void add(const Vec3& v) { add(v.data(), 3 * sizeof(double)); }
    std::string digest() const { return fmt::format("{:016x}", XXH3_64bits_digest(state_)); }

  private:
    XXH3_state_t* state_;
};

}  // namespace

std::string Simulation::state_hash() const {
    Hasher hasher;
    hasher.add(spheres().position);
    hasher.add(spheres().velocity);
    hasher.add(spheres().spin);
    // The bodies identify a contact, not its place in a list: that depends on the skin.
    for (const TouchingContact& c : contacts().touching()) {
        const std::int32_t ids[2] = {c.i, c.j};
        hasher.add(ids, sizeof ids);
        hasher.add(c.shear);
    }
    for (const Wall& wall : walls()) {
        hasher.add(wall.point);
        hasher.add(wall.velocity);
    }
    hasher.add(&world_->time, sizeof world_->time);
    return hasher.digest();
}

}  // namespace grainfield::core
