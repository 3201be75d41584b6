// Forces of the candidates of one plane wall.

#if defined(GRAINFIELD_WALL_KERNEL_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINFIELD_WALL_KERNEL_INL
#undef GRAINFIELD_WALL_KERNEL_INL
#else
#define GRAINFIELD_WALL_KERNEL_INL
#endif

#include "kernels/vector/pair_kernel-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainfield::kernels::HWY_NAMESPACE {

/// Shear stiffness of a sphere on a wall: K_s by Eq. (4b) of Tran et al., from
/// k_s = (k_s/k_n) k_n of each body.
template <class T>
double wall_shear_stiffness(double radius, double k, const WallPlane<T>& wall,
                            const PairParameters<T>& p) {
    const double a = p.stiffness_ratio * k, b = double{wall.stiffness_ratio} * wall.stiffness;
    return a > 0 && b > 0 ? radius * a * b / (a + b) : 0.0;
}

template <class T, bool Friction, bool PerSphere, bool Sums, bool Replay>
PassResult wall_forces(const SphereRecord<T>* records, const WallPlane<T>& wall, Candidates<T> c,
                       SphereLoad<T>* loads, const PairParameters<T>& p, WallLoad& total) {
    constexpr std::size_t n = lanes<T>;
    const Tag<T> d;
    PassResult result;
    const auto half = set<T>(T(0.5)), one = set<T>(1), zero = hn::Zero(d);
    const auto step = set<T>(p.step);
    const Lane3<T> normal = set3<T>(wall.normal), outward = scaled(set<T>(-1), normal);
    const Lane3<T> wall_velocity = set3<T>(wall.velocity);
    const auto wall_compliance = set<T>(1 / wall.stiffness), advance = set<T>(wall.advance);
    const T ks_wall = wall.stiffness_ratio * wall.stiffness;
    const bool springs = p.stiffness_ratio > 0 && ks_wall > 0;
    // Eq. (4) of Tran et al., divided by the radius, where all spheres are the same.
    const auto over_radius = [](double a, double b) { return static_cast<T>(a * b / (a + b)); };
    const auto uniform_kn = set<T>(over_radius(p.uniform_stiffness, wall.stiffness));
    const auto uniform_ks = set<T>(
        springs ? over_radius(double{p.stiffness_ratio} * p.uniform_stiffness, ks_wall) : T(0));
    WideSum<T> sum_x, sum_y, sum_z, stiffness_sum;
    auto too_deep = hn::Lt(zero, zero);
    LaneSums<T> sums;
    for (std::size_t word = 0; word < c.size / most_lanes; ++word) {
        std::uint32_t now = 0;
        for (std::size_t part = 0; part < most_lanes; part += n) {
            const std::size_t k = word * most_lanes + part, slot = slot_of<T>(k);
            std::array<const T*, n> at;
            std::array<T*, n> load;
            for (std::size_t l = 0; l < n; ++l) {
                at[l] = record_of(records, c.a[k + l]).u;
                load[l] = load_of(loads, c.a[k + l]).force;
            }
            const Lane4<T> u = load4<T>(at, 0);
            const auto gap = load_component(c.separation, k, gap_component, separation_size);
            const auto reached = hn::Add(hn::Sub(gap, dot(normal, u.xyz())), advance);
            const auto touching = hn::Gt(reached, zero);
            const std::uint32_t bits = bits_of<T>(touching);
            now |= bits << part;
            if (bits == 0) continue;
            const auto overlap = hn::Max(reached, zero);
            too_deep = hn::Or(too_deep, hn::Gt(overlap, hn::Mul(half, u.w)));
            const auto w = load4<T>(at, 8), v = load4<T>(at, 4);
            const auto kn = hn::IfThenElseZero(
                touching, PerSphere ? contact_stiffness<T>(u.w, hn::Add(v.w, wall_compliance))
                                    : hn::Mul(u.w, uniform_kn));
            const auto fn = hn::Mul(kn, overlap);
            Lane3<T> force = scaled(fn, normal), shear{zero, zero, zero};
            if constexpr (Friction) {
                T* history = c.history + in_block(k, 0, history_size);
                shear = {hn::Load(d, history), hn::Load(d, history + most_lanes),
                         hn::Load(d, history + 2 * most_lanes)};
            }
            if constexpr (Friction && !Replay) {
                const Lane3<T> velocity = wall_velocity - v.xyz(), before = shear;
                const TangentialLanes<T> motion =
                    plane_motion<T>(outward, u.w, velocity, w.xyz(), before, step);
                const auto gap_before = hn::MulSub(step, dot(velocity, normal), overlap);
                auto ks = zero;
                if (springs)
                    ks = PerSphere
                             ? contact_stiffness<T>(u.w, hn::MulAdd(set<T>(1 / p.stiffness_ratio),
                                                                    v.w, set<T>(1 / ks_wall)))
                             : hn::Mul(u.w, uniform_ks);
                const auto friction =
                    hn::Min(PerSphere ? w.w : set<T>(p.uniform_friction), set<T>(wall.friction));
                const ShearLanes<T> spring =
                    load_shear<T, Sums>(motion, gap_before, overlap, ks, hn::Mul(friction, fn));
                // One that has just opened keeps its spring for the ledger, below.
                T* history = c.history + in_block(k, 0, history_size);
                hn::Store(hn::IfThenElse(touching, spring.shear.x, before.x), d, history);
                hn::Store(hn::IfThenElse(touching, spring.shear.y, before.y), d,
                          history + most_lanes);
                hn::Store(hn::IfThenElse(touching, spring.shear.z, before.z), d,
                          history + 2 * most_lanes);
                shear = spring.shear;
                if constexpr (Sums) sums.add_shear(slot, touching, spring);
            }
            if constexpr (Friction) {
                shear = {hn::IfThenElseZero(touching, shear.x),
                         hn::IfThenElseZero(touching, shear.y),
                         hn::IfThenElseZero(touching, shear.z)};
                force = force + shear;
                const Lane3<T> moment = cross(outward, shear);  // per radius
                add4<T>({moment.x, moment.y, moment.z, zero}, load, 4);
            }
            add4<T>({force.x, force.y, force.z, hn::IfThenElseZero(touching, one)}, load, 0);
            sum_x.add(slot, force.x);
            sum_y.add(slot, force.y);
            sum_z.add(slot, force.z);
            stiffness_sum.add(slot, kn);
            result.contacts += __builtin_popcount(bits);
            if constexpr (Sums) sums.add_normal(slot, touching, fn, overlap);
        }
        for (std::uint32_t opened = c.touching[word] & ~now; opened != 0; opened &= opened - 1) {
            const std::size_t k =
                word * most_lanes + static_cast<std::size_t>(__builtin_ctz(opened));
            const auto& sphere = record_of(records, c.a[k]);
            const double ks = wall_shear_stiffness<T>(
                sphere.radius, PerSphere ? 1 / sphere.compliance : p.uniform_stiffness, wall, p);
            double square = 0;
            for (std::size_t s = 0; s < history_size; ++s) {
                T& shear = c.history[in_block(k, s, history_size)];
                square += shear * shear;
                shear = 0;
            }
            if (ks > 0) result.sums.friction_work += 0.5 * square / ks;
        }
        c.touching[word] = static_cast<std::uint16_t>(now);
    }
    if constexpr (Sums) result.sums += sums.total();
    result.sums.contacts = result.contacts;
    result.too_deep = !hn::AllFalse(d, too_deep);
    total.force -= Vec3(sum_x.total(), sum_y.total(), sum_z.total());
    total.stiffness += stiffness_sum.total();
    total.contacts += result.contacts;
    return result;
}

}  // namespace grainfield::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
