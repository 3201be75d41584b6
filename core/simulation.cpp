#include "core/simulation.hpp"

#include <cmath>
#include <limits>

#include "core/base/parallel.hpp"
#include "core/reference/reference_engine.hpp"

namespace grainfield::core {

Simulation::Simulation(Scene scene, const kernels::KernelTable& kernels, SimulationOptions options)
    : world_(std::make_unique<World>(std::move(scene), options)),
      kernels_(&kernels),
      engine_(make_engine(*world_, kernels)) {}

const Scene& Simulation::scene() const {
    if (!store_current_) engine_->download();
    store_current_ = true;
    return world_->scene;
}

// --- the step ------------------------------------------------------------------------------------

void Simulation::compute_forces(bool sums) {
    engine_->compute_forces(sums || world_->options.ledger);
    resultants_current_ = false;
}

void Simulation::advance(double step) {
    engine_->move(step);
    moved();
    move_walls(step);
}

void Simulation::moved() {
    store_current_ = resultants_current_ = false;
}

void Simulation::move_walls(double step) {
    for (std::size_t w = 0; w < world_->planes.size(); ++w) {
        Wall& wall = world_->scene.walls[w];
        wall.point += step * wall.velocity;
        world_->planes[w].point = wall.point;
        world_->planes[w].velocity = wall.velocity;
    }
    world_->time += step;
    world_->old_step = step;
    ++world_->steps;
}

// --- views ---------------------------------------------------------------------------------------

const Vec3Column& Simulation::resultants() const {
    if (!resultants_current_) engine_->download_resultants();
    resultants_current_ = true;
    return world_->force;
}

Vec3 SphereView::resultant() const {
    return simulation_.resultants()[i_];
}

kernels::OnStep SphereView::on_step() const {
    World& world = *simulation_.world_;
    simulation_.scene();
    simulation_.resultants();
    const Inertias inertia(world, i_, i_ + 1);
    return kernels::on_step_motion(motion_columns(world, i_, inertia),
                                   motion_parameters(world, 0.0), world.motion_features(), 0);
}

double Simulation::unbalanced_force_ratio() const {
    const double resultant = engine_->resultant_sum();
    if (resultant == 0.0) return 0.0;
    const kernels::ContactSums& sums = world_->contact_sums;
    if (sums.contacts == 0 || sums.normal_force == 0.0)
        return std::numeric_limits<double>::infinity();
    return (resultant / static_cast<double>(world_->size())) /
           (sums.normal_force / static_cast<double>(sums.contacts));
}

Energy Simulation::energy() const {
    scene();
    if (world_->size() > 0) resultants();
    const kernels::MotionParameters p = motion_parameters(*world_, 0.0);
    const kernels::StateSums state =
        sum_chunks<kernels::StateSums>(world_->size(), [&](std::size_t begin, std::size_t end) {
            const Inertias inertias(*world_, begin, end);
            return kernels::sum_state(motion_columns(*world_, begin, inertias), p,
                                      world_->motion_features(), 0, end - begin);
        });
    Energy e;
    e.kinetic = state.kinetic;
    e.rotational = state.rotational;
    e.gravity = state.potential;
    e.elastic_normal = world_->contact_sums.elastic_normal;
    e.elastic_shear = world_->contact_sums.elastic_shear;
    e.friction_work = world_->friction_work;
    e.damping_work = world_->damping_work + state.half_step_damping;
    e.external_work = world_->external_work;
    e.work_put_in = world_->work_put_in;
    return e;
}

}  // namespace grainfield::core
