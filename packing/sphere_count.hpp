#pragma once
// How many spheres a packing will have, known from its grading before any is drawn.

#include <string>

#include "packing/packing_options.hpp"

namespace grainfield::packing {

/// Spheres of one block, but for the scatter of a draw: packing.spheres, or what the grading's
/// number density gives for the block's solid volume (docs/method.md, section 4.1) [-].
double spheres_a_block(const PackingOptions& options, const Grading& grading);

/// The same in words, for the screen.
std::string sphere_count_text(const PackingOptions& options, const Grading& grading);

/// The grading without its grains below a diameter [m] within its sieves.
Grading without_finer(const Grading& grading, double diameter);

/// Throws InputError where a block has more than packing.max_spheres, naming the sieves between
/// which they are and the finest sieve that would do; or where the sample has more spheres than
/// there is memory for, or than can be numbered.
void require_countable(const PackingOptions& options, const Grading& grading);

}  // namespace grainfield::packing
