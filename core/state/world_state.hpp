#pragma once
// What a world carries from step to step, for the archives of checkpoints.

#include "core/scene/world.hpp"
#include "core/state/bytes.hpp"

namespace grainfield::core {

template <class Archive>
void serialize(Archive& archive, Vec3Column& column) {
    archive(bytes(column.x), bytes(column.y), bytes(column.z));
}

template <class Archive>
void serialize(Archive& archive, ParticleStore& s) {
    archive(s.position, s.velocity, s.spin, bytes(s.radius), bytes(s.mass),
            bytes(s.normal_stiffness), bytes(s.friction_angle), bytes(s.block));
}

template <class Archive>
void serialize(Archive& archive, Scene& scene) {
    archive(scene.spheres, bytes(scene.walls), bytes(scene.gravity), scene.stiffness_ratio,
            bytes(scene.damping));
}

/// Without resultants: the next force evaluation finds them. refresh() has to follow a load.
template <class Archive>
void serialize(Archive& archive, World& world) {
    archive(world.scene, world.options.skin, world.options.ledger, bytes(world.inertia_scale),
            bytes(world.planes), bytes(world.wall_loads), bytes(world.last_wall_loads),
            bytes(world.contact_sums), world.friction_work, world.damping_work, world.external_work,
            world.work_put_in, world.time, world.old_step, world.steps, world.forces_at);
}

}  // namespace grainfield::core
