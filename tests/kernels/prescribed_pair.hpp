#pragma once
// A pair of spheres moved as told through the pair kernel: what the contact makes of it.

#include <array>

#include "tests/kernels/kernel_tables.hpp"

namespace grainfield::kernels {

class PrescribedPair {
  public:
    static constexpr double stiffness = 1e6;  // k_n of both [Pa]

    PrescribedPair(const KernelTable& table, double radius_i, double radius_j, const Vec3& xi,
                   const Vec3& xj, double friction)
        : kernel_(table.pairs({true, false, true})),
          radius_{radius_i, radius_j},
          friction_{friction, friction},
          position_{xi, xj} {
        evaluate({Vec3::Zero(), Vec3::Zero()}, {Vec3::Zero(), Vec3::Zero()}, 0.0);
    }

    /// Moves both to new places in one step, with the spins of that step.
    void move(const Vec3& xi, const Vec3& xj, const Vec3& spin_i, const Vec3& spin_j,
              double step = 1.0) {
        const std::array<Vec3, 2> velocity{(xi - position_[0]) / step, (xj - position_[1]) / step};
        position_ = {xi, xj};
        evaluate(velocity, {spin_i, spin_j}, step);
    }

    void set_shear(const Vec3& shear) { shear_ = shear; }
    const Vec3& shear() const { return shear_; }
    const Vec3& force() const { return force_; }
    const Vec3& moment_per_radius() const { return moment_; }
    bool touching() const { return touching_ != 0; }

  private:
    void evaluate(const std::array<Vec3, 2>& velocity, const std::array<Vec3, 2>& spin,
                  double step) {
        const auto column = [](const std::array<Vec3, 2>& v, int axis) {
            return std::array<double, 2>{v[0][axis], v[1][axis]};
        };
        const std::array<std::array<double, 2>, 9> c{
            column(position_, 0), column(position_, 1), column(position_, 2),
            column(velocity, 0),  column(velocity, 1),  column(velocity, 2),
            column(spin, 0),      column(spin, 1),      column(spin, 2)};
        const SphereColumns columns{c[0].data(),    c[1].data(),       c[2].data(),
                                    c[3].data(),    c[4].data(),       c[5].data(),
                                    c[6].data(),    c[7].data(),       c[8].data(),
                                    radius_.data(), stiffness_.data(), friction_.data()};
        const Pair pair{0, 1};
        kernel_(columns, &pair, {&shear_, &touching_, &force_, &moment_},
                {0.5, stiffness, friction_[0], step}, 0, 1);
    }

    PairKernel kernel_;
    std::array<double, 2> radius_, friction_, stiffness_{stiffness, stiffness};
    std::array<Vec3, 2> position_;
    Vec3 shear_ = Vec3::Zero(), force_ = Vec3::Zero(), moment_ = Vec3::Zero();
    std::uint8_t touching_ = 0;
};

}  // namespace grainfield::kernels
