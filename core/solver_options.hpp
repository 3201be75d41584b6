#pragma once
// Options of the solver proper: damping, time step, which kernels.

#include <optional>

#include "kernels/instruction_set.hpp"

namespace grainfield::core {

/// Local (non-viscous, Cundall) damping.
struct Damping {
    double force = 0.0;   ///< alpha on forces, 0 <= alpha < 1 [-]
    double moment = 0.0;  ///< alpha on moments, 0 <= alpha < 1 [-]
};

struct TimeOptions {
    std::optional<double> step;  ///< fixed step; unset: safety times the stability limit [s]
    double safety = 0.8;         ///< share of the stability limit 2/omega_max, 0 < safety < 1 [-]
    double mass_scaling =
        1.0;  ///< >= 1; light spheres get the mass that a step this many times larger needs [-]
};

enum class Precision { double_, mixed };

struct SolverOptions {
    Precision precision = Precision::mixed;
    std::optional<kernels::InstructionSet> isa = {};  ///< unset: the widest that runs here
};

}  // namespace grainfield::core
