#include "packing/compaction.hpp"

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "packing/patience.hpp"

namespace grainfield::packing {
namespace {

constexpr double levelling = 3;           // stress of a lid that levels a bed, of own stress [-]
constexpr double light_lid = 0.3;         // stress of a lid at the end, of own stress [-]
constexpr int bouts_of_a_state = 30;      // of shaking with one friction
constexpr double friction_factor = 0.5;   // the friction angle goes down by this when stalled
constexpr double lowest_friction = 2e-3;  // below this: none [rad]
constexpr int most_looks_at_rest = 20;    // at a bed with too much stress, without friction
constexpr double deeper = 3e-4;           // of the height, after a bed had too much stress [-]
constexpr double rest_ratio = 1e-3;       // unbalanced force ratio of a settled state [-]
constexpr double nearly_rest = 1e-2;      // of a state that is shaken again [-]
constexpr double most_stress = 2;         // mean stress of a block over its own weight's [-]

/// Under a light lid, with true springs.
void come_to_rest(ShakenBox& box) {
    box.press(box.own_stress(), nearly_rest);
    box.soften(1);
    box.press(light_lid * box.own_stress(), nearly_rest);
}

/// A bed with softened springs grows by about so much of its height when it gets the true ones [-].
double growth_with_true_springs(const ShakenBox& box) {
    constexpr double of_stress = 20;  // strain over own stress over k_n [-]
    return of_stress * (box.softening() - 1) * box.own_stress() / box.material().normal_stiffness;
}

}  // namespace

void let_fall(ShakenBox& box) {
    box.monitor().begin("settling one block");
    box.soften(box.most_softening());
    box.settle(nearly_rest);
    box.set_lid_height(box.top_of_bed());
    // One high grain would hold the lid.
    box.press(levelling * box.own_stress(), nearly_rest);
    come_to_rest(box);
}

void shake_with(ShakenBox& box, double friction_angle) {
    box.monitor().begin(fmt::format("shaking the block with friction {:g} rad", friction_angle));
    box.soften(box.most_softening());
    box.set_friction_angle(friction_angle);
    for (int k = 0; k < bouts_of_a_state; ++k) {
        box.shake(true);
        box.monitor().progress(double(k + 1) / bouts_of_a_state, box.steps(),
                               fmt::format("porosity {:.4f}", box.porosity()));
    }
    come_to_rest(box);
}

void restore_friction(ShakenBox& box) {
    box.set_friction_angle(box.material().friction_angle);
    box.settle(rest_ratio);
}

double compact_to(ShakenBox& box, double height, const DensityRange& range,
                  const std::string& help) {
    box.monitor().begin("compacting the block");
    const double limit = most_stress * box.own_stress();
    double friction = box.material().friction_angle;
    const auto lower_friction = [&] {
        friction = friction * friction_factor < lowest_friction ? 0.0 : friction * friction_factor;
    };
    const double asked = box.porosity(height);
    if (box.lid_height() <= height) {  // loose enough as it fell
        box.set_lid_height(height);
        restore_friction(box);
        return friction;
    }
    box.soften(box.most_softening());
    Patience patience(height, box.lid_height());
    double lowest = height * (1 - growth_with_true_springs(box));
    int failed_at_rest = 0;
    for (;;) {
        box.set_friction_angle(friction);
        box.shake(friction == 0, lowest);
        const double now = box.lid_height();
        box.monitor().progress(
            -1, box.steps(),
            fmt::format("porosity {:.4f}, friction {:.3f} rad", box.porosity(now), friction));
        if (now > lowest) {
            const Patience::Verdict verdict = patience.after_bout(now, friction > 0.0);
            if (verdict == Patience::Verdict::lower_friction) lower_friction();
            if (verdict == Patience::Verdict::give_up)
                throw InputError(fmt::format(
                    "packing.porosity = {:g}: cannot be reached with this grading and block; "
                    "shaking, at last without friction, ended at {:.4f} after {} bouts ({}); {}",
                    asked, box.porosity(patience.lowest()), patience.bouts(), range.text(asked),
                    help));
            continue;
        }
        patience.reached(now);
        box.soften(1);
        box.set_lid_height(height);
        restore_friction(box);
        const double stress = box.mean_stress();
        if (stress <= limit) return friction;
        if (friction == 0.0 && ++failed_at_rest > most_looks_at_rest)
            throw InputError(fmt::format(
                "packing.porosity = {:g}: cannot be reached without stress with this grading and "
                "block; it holds {:.3g} Pa, allowed is {:.3g} Pa ({}); {}",
                asked, stress, limit, range.text(asked), help));
        lower_friction();
        box.soften(box.most_softening());
        lowest -= deeper * height;
    }
}

void stand_on_head(ShakenBox& box) {
    box.monitor().begin("settling the block on its head");
    box.settle(rest_ratio, true);
}

}  // namespace grainfield::packing
