#pragma once
// How long a block is shaken: judged by the height of the lid after each bout.

namespace grainfield::packing {

/// Counts bouts without progress (docs/method.md, section 4.2). The lid over few or large grains
/// goes up and down from bout to bout for ever: so it is also compared with the lowest it has been,
/// and only a fall below that is progress.
class Patience {
  public:
    enum class Verdict { go_on, lower_friction, give_up };

    /// Heights of the block and of the lid before the first bout [m].
    Patience(double block_height, double lid_height);

    /// After a bout that left the lid at this height [m], above the block's. Whatever the heights,
    /// the friction is lowered or given up after a bounded number of calls.
    Verdict after_bout(double lid_height, bool friction);

    /// The lid came down to this height, the block's [m]: how long it takes to get there again is
    /// counted anew.
    void reached(double lid_height);

    double lowest() const { return lowest_; }  ///< that the lid has been [m]
    int bouts() const { return bouts_; }       ///< in all [-]

  private:
    double progress_;     // least change of the lid that counts [m]
    double last_;         // height of the lid [m]
    double lowest_;       // [m]
    double to_undercut_;  // height at the last progress [m]
    int bouts_ = 0;
    int stalled_ = 0;    // bouts in a row that lowered the lid little
    int fruitless_ = 0;  // bouts since the last progress
};

}  // namespace grainfield::packing
