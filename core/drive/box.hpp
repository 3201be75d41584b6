#pragma once
// The box of six plane walls around a sample: its dimensions, stresses, and what moves in it. A
// scene's first six walls must be those of box_walls().

#include "core/simulation.hpp"

namespace grainfield::core {

/// Dimensions between the opposite walls of a box made by box_walls() [m].
Vec3 box_dimensions(const Simulation& simulation);
/// Area of the walls that face an axis [m2].
double wall_area(const Vec3& dimensions, int axis);
/// Mean compressive stress on the two walls that face an axis [Pa].
double axis_stress(const Simulation& simulation, int axis);

/// What the kinetic energy of a sample that is strained at `rate` [1/s] under `stress` [Pa] never
/// reaches while its step is short enough: ten times that of the motion imposed, what a fall
/// through the box would give, and a hundredth of stress times volume, many times the energy in the
/// contacts [J].
double most_kinetic_energy(const Simulation& simulation, double rate, double stress);

}  // namespace grainfield::core
