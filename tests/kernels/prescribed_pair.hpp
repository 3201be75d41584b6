#pragma once
// A pair of spheres moved as told through the pair kernel: what the contact makes of it.

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include "core/base/aligned.hpp"
#include "kernels/vector/vector_kernels.hpp"
#include "tests/kernels/kernel_tables.hpp"

namespace grainfield::kernels {

/// What the pair kernels get and give, in double.
struct PairState {
    std::array<double, 2> radius;
    double friction, stiffness;
    std::array<Vec3, 2> position, velocity, spin;
    double step = 0;
    Vec3 shear = Vec3::Zero(), force = Vec3::Zero(), moment_per_radius = Vec3::Zero();
    bool touching = false;
};

inline constexpr double pair_stiffness_ratio = 0.5;  // k_s/k_n [-]

class PairRunner {
  public:
    virtual ~PairRunner() = default;
    virtual void evaluate(PairState& state) = 0;
};

class ReferencePair : public PairRunner {
  public:
    explicit ReferencePair(const ReferenceKernels& kernels)
        : kernel_(kernels.pairs({true, false, true})) {}

    void evaluate(PairState& s) override {
        const auto column = [](const std::array<Vec3, 2>& v, int axis) {
            return std::array<double, 2>{v[0][axis], v[1][axis]};
        };
        const std::array<std::array<double, 2>, 9> c{
            column(s.position, 0), column(s.position, 1), column(s.position, 2),
            column(s.velocity, 0), column(s.velocity, 1), column(s.velocity, 2),
            column(s.spin, 0),     column(s.spin, 1),     column(s.spin, 2)};
        const std::array<double, 2> friction{s.friction, s.friction},
            stiffness{s.stiffness, s.stiffness};
        const SphereColumns columns{c[0].data(),     c[1].data(),      c[2].data(),
                                    c[3].data(),     c[4].data(),      c[5].data(),
                                    c[6].data(),     c[7].data(),      c[8].data(),
                                    s.radius.data(), stiffness.data(), friction.data()};
        const Pair pair{0, 1};
        std::uint8_t touching = s.touching;
        kernel_(columns, &pair, {&s.shear, &touching, &s.force, &s.moment_per_radius},
                {pair_stiffness_ratio, s.stiffness, s.friction, s.step}, 0, 1);
        s.touching = touching != 0;
    }

  private:
    PairKernel kernel_;
};

/// The first candidate of a list that is otherwise padding.
template <class T>
class VectorPair : public PairRunner {
  public:
    VectorPair(const VectorKernels<T>& kernels, const PairState& s)
        : kernels_(kernels),
          start_(s.position),
          records_(3),
          loads_(3),
          a_(most_lanes, 2 * record_stride<T>),
          b_(most_lanes, 2 * record_stride<T>),
          separation_(most_lanes * separation_size),
          history_(most_lanes * history_size),
          touching_(1),
          scratch_(2 * most_lanes) {
        const Vec3 branch = start_[1] - start_[0];
        for (std::size_t k = 0; k < most_lanes; ++k) {
            separation(k, 0) = 4;
            separation(k, gap_component) = -2;
        }
        for (std::size_t c = 0; c < 3; ++c)
            separation(0, c) = static_cast<T>(branch[static_cast<int>(c)]);
        separation(0, gap_component) = static_cast<T>(s.radius[0] + s.radius[1] - branch.norm());
        records_[2].radius = records_[2].compliance = 1;
        a_[0] = 0;
        b_[0] = record_stride<T>;
        radius_ = std::min(s.radius[0], s.radius[1]);
    }

    void evaluate(PairState& s) override {
        for (std::size_t i = 0; i < 2; ++i)
            for (int k = 0; k < 3; ++k) {
                records_[i].radius = static_cast<T>(s.radius[i]);
                records_[i].u[k] = static_cast<T>(s.position[i][k] - start_[i][k]);
                records_[i].v[k] = static_cast<T>(s.velocity[i][k]);
                records_[i].w[k] = static_cast<T>(s.spin[i][k]);
                records_[i].radius_spin[k] = records_[i].radius * records_[i].w[k];
            }
        for (int k = 0; k < 3; ++k) shear(k) = static_cast<T>(s.shear[k]);
        loads_.assign(3, {});
        const PairParameters<T> p{static_cast<T>(pair_stiffness_ratio),
                                  static_cast<T>(s.stiffness),
                                  static_cast<T>(s.friction),
                                  static_cast<T>(radius_),
                                  static_cast<T>(s.step),
                                  2 * record_stride<T>};
        kernels_.pairs.compute({true, false, true})(
            records_.data(),
            {most_lanes, most_lanes, most_lanes - 1, a_.data(), b_.data(), separation_.data(),
             history_.data(), touching_.data(), scratch_.data()},
            loads_.data(), p);
        const auto vec = [](const T(&v)[3]) { return Vec3(v[0], v[1], v[2]); };
        s.shear = Vec3(shear(0), shear(1), shear(2));
        s.force = vec(loads_[0].force);
        s.moment_per_radius = vec(loads_[0].moment_per_radius);
        s.touching = (touching_[0] & 1u) != 0;
    }

  private:
    T& separation(std::size_t k, std::size_t component) {
        return separation_[in_block(k, component, separation_size)];
    }
    T& shear(int axis) {
        return history_[in_block(0, static_cast<std::size_t>(axis), history_size)];
    }

    const VectorKernels<T>& kernels_;
    std::array<Vec3, 2> start_;
    double radius_ = 0;  // the smaller one [m]
    core::Aligned<SphereRecord<T>> records_;
    core::Aligned<SphereLoad<T>> loads_;
    core::Aligned<std::int32_t> a_, b_;
    core::Aligned<T> separation_, history_;
    core::Aligned<std::uint16_t> touching_;
    core::Aligned<std::int32_t> scratch_;
};

class PrescribedPair {
  public:
    static constexpr double stiffness = 1e6;  // k_n of both [Pa]

    PrescribedPair(const KernelTable& table, double radius_i, double radius_j, const Vec3& xi,
                   const Vec3& xj, double friction) {
        state_.radius = {radius_i, radius_j};
        state_.friction = friction;
        state_.stiffness = stiffness;
        state_.position = {xi, xj};
        state_.velocity = state_.spin = {Vec3::Zero(), Vec3::Zero()};
        if (table.reference) runner_ = std::make_unique<ReferencePair>(*table.reference);
        if (table.mixed) runner_ = std::make_unique<VectorPair<float>>(*table.mixed, state_);
        if (table.full) runner_ = std::make_unique<VectorPair<double>>(*table.full, state_);
        runner_->evaluate(state_);
    }

    /// Moves both to new places in one step, with the spins of that step.
    void move(const Vec3& xi, const Vec3& xj, const Vec3& spin_i, const Vec3& spin_j,
              double step = 1.0) {
        state_.velocity = {(xi - state_.position[0]) / step, (xj - state_.position[1]) / step};
        state_.position = {xi, xj};
        state_.spin = {spin_i, spin_j};
        state_.step = step;
        runner_->evaluate(state_);
    }

    void set_shear(const Vec3& shear) { state_.shear = shear; }
    const Vec3& shear() const { return state_.shear; }
    const Vec3& force() const { return state_.force; }
    const Vec3& moment_per_radius() const { return state_.moment_per_radius; }
    bool touching() const { return state_.touching; }

  private:
    PairState state_;
    std::unique_ptr<PairRunner> runner_;
};

}  // namespace grainfield::kernels
