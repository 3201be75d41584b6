#include "triaxial/cli/state_keeper.hpp"

#include "triaxial/test/run_files.hpp"

namespace grainfield::triaxial {

void StateKeeper::ended_early(const core::Simulation& simulation) {
    write_state(path_, simulation);
    kept_ = true;
}

}  // namespace grainfield::triaxial
