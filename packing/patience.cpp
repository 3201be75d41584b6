#include "packing/patience.hpp"

#include <algorithm>

namespace grainfield::packing {
namespace {

constexpr double progress = 2e-3;  // fall of the lid in a bout, of the block's height [-]
constexpr int patience = 3;        // stalled bouts in a row before the friction is lowered [-]
// Without friction a block that is jammed comes loose again if it is shaken otherwise: bouts of
// other strength and pace, many of them, before the porosity is given up.
constexpr int last_patience = 80;  // stalled bouts in a row [-]
// A lid that goes up and down does not stall. Blocks that come to their porosity undercut the
// lowest lid within 3 bouts with friction, and 80 without.
constexpr int fruitless_with_friction = 20;      // bouts since the last progress [-]
constexpr int fruitless_without_friction = 160;  // the same [-]

}  // namespace

Patience::Patience(double block_height, double lid_height)
    : progress_(progress * block_height),
      last_(lid_height),
      lowest_(lid_height),
      to_undercut_(lid_height) {}

Patience::Verdict Patience::after_bout(double lid_height, bool friction) {
    ++bouts_;
    stalled_ = last_ - lid_height < progress_ ? stalled_ + 1 : 0;
    last_ = lid_height;
    lowest_ = std::min(lowest_, lid_height);
    ++fruitless_;
    if (lid_height < to_undercut_ - progress_) {
        to_undercut_ = lid_height;
        fruitless_ = 0;
    }
    if (!friction)
        return stalled_ >= last_patience || fruitless_ >= fruitless_without_friction
                   ? Verdict::give_up
                   : Verdict::go_on;
    if (stalled_ < patience && fruitless_ < fruitless_with_friction) return Verdict::go_on;
    stalled_ = fruitless_ = 0;
    return Verdict::lower_friction;
}

void Patience::reached(double lid_height) {
    ++bouts_;
    last_ = lowest_ = to_undercut_ = lid_height;
    fruitless_ = 0;
}

}  // namespace grainfield::packing
