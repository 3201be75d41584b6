// Simulations and engines to and from the archives of checkpoints.

#include <fmt/format.h>

#include <cereal/archives/binary.hpp>
#include <cereal/types/string.hpp>

#include "core/base/errors.hpp"
#include "core/reference/reference_engine.hpp"
#include "core/simulation.hpp"
#include "core/state/world_state.hpp"

namespace grainfield::core {
namespace {

std::string kind(const kernels::KernelTable& table) {
    return fmt::format("{}kernels for solver.isa = \"{}\", solver.precision = \"{}\"",
                       table.reference != nullptr ? "the reference " : "", kernels::name(table.isa),
                       table.precision);
}

}  // namespace

void Simulation::save(StateWriter& archive) const {
    scene();
    archive(kind(*kernels_), *world_);
    engine_->save(archive);
}

void Simulation::load(StateReader& archive) {
    std::string kernels;
    archive(kernels);
    if (kernels != kind(*kernels_))
        throw InputError(fmt::format("the state is of {}, here are {}: it goes on as it began only",
                                     kernels, kind(*kernels_)));
    world_ = std::make_unique<World>(Scene{}, SimulationOptions{});
    archive(*world_);
    // The planes keep the velocities of the last step, walls may have been given others.
    const std::vector<kernels::PlaneWall> planes = world_->planes;
    world_->refresh();
    world_->planes = planes;
    engine_ = make_engine(*world_, *kernels_);
    engine_->load(archive);
    store_current_ = true;
    resultants_current_ = false;
}

void ReferenceEngine::save(StateWriter& archive) const {
    archive(contacts_, max_square_displacement_);
}

void ReferenceEngine::load(StateReader& archive) {
    archive(contacts_, max_square_displacement_);
}

}  // namespace grainfield::core
