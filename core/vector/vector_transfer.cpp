// Between the store and the working copies of the fast engine.

#include "core/base/parallel.hpp"
#include "core/vector/vector_engine.hpp"

namespace grainfield::core {

template <class T>
void VectorEngine<T>::upload() {
    const ParticleStore& s = world_.spheres();
    for (Domain<T>& domain : sample_.domains)
        for (std::size_t k = 0; k < domain.own; ++k) {
            const std::size_t i = sample_.sphere(domain, k);
            kernels::SphereRecord<T>& r = domain.records[k];
            r.radius = static_cast<T>(s.radius[i]);
            assign3(r.v, s.velocity[i]);
            r.compliance = static_cast<T>(1 / s.normal_stiffness[i]);
            assign3(r.w, s.spin[i]);
            r.friction = static_cast<T>(world_.friction(i));
            for (int a = 0; a < 3; ++a) r.radius_spin[a] = r.radius * r.w[a];
            domain.body(inverse_mass)[k] = static_cast<T>(world_.inverse_inertial_mass(i));
            domain.body(spin_response)[k] = static_cast<T>(s.radius[i] * world_.inverse_inertia(i));
        }
    if (has_masses_) upload_masses();
    ghosts_outdated_ = true;
    if (!world_.has_friction) contacts_.clear_shear();
    suspicious_ = true;  // what was uploaded has not been looked at
}

/// Gives the bodies their masses.
template <class T>
void VectorEngine<T>::upload_masses() {
    for (Domain<T>& domain : sample_.domains) {
        domain.bodies.resize(body_columns * domain.ghost_begin());
        for (std::size_t k = 0; k < domain.own; ++k)
            domain.body(mass)[k] = static_cast<T>(mass_of(domain, k));
    }
    has_masses_ = true;
}

template <class T>
void VectorEngine<T>::scale_velocities(double factor) {
    const auto f = static_cast<T>(factor);
    for_many(sample_.size(), 1, [&](std::size_t d) {
        Domain<T>& domain = sample_.domains[d];
        for (std::size_t k = 0; k < domain.own; ++k)
            for (int a = 0; a < 3; ++a) {
                domain.records[k].v[a] *= f;
                domain.records[k].w[a] *= f;
                domain.records[k].radius_spin[a] *= f;
            }
    });
}

template <class T>
void VectorEngine<T>::download() {
    ParticleStore& s = world_.scene.spheres;
    for_many(sample_.size(), 1, [&](std::size_t d) {
        const Domain<T>& domain = sample_.domains[d];
        for (std::size_t k = 0; k < domain.own; ++k) {
            const std::size_t i = sample_.sphere(domain, k);
            const kernels::SphereRecord<T>& r = domain.records[k];
            s.position.set(i, lists_.built().position[domain.first + k] + vec3(r.u));
            s.velocity.set(i, vec3(r.v));
            s.spin.set(i, vec3(r.w));
        }
    });
}

template void VectorEngine<float>::upload();
template void VectorEngine<double>::upload();
template void VectorEngine<float>::upload_masses();
template void VectorEngine<double>::upload_masses();
template void VectorEngine<float>::scale_velocities(double);
template void VectorEngine<double>::scale_velocities(double);
template void VectorEngine<float>::download();
template void VectorEngine<double>::download();

}  // namespace grainfield::core
