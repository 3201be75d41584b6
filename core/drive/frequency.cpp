#include "core/drive/frequency.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/parallel.hpp"
#include "kernels/contact_law.hpp"

namespace grainfield::core {
namespace {

/// Contacts whose two spheres are both this much softer on their mass than the stiffest sphere have
/// no part in the highest mode, and are left out [-].
constexpr double softest_part = 0.3;

}  // namespace

std::vector<ContactSpring> contact_springs(const Simulation& simulation) {
    const Scene& scene = simulation.scene();
    const ParticleStore& s = scene.spheres;
    const bool friction =
        scene.stiffness_ratio > 0 && std::any_of(s.friction_angle.begin(), s.friction_angle.end(),
                                                 [](double f) { return f > 0; });
    const std::vector<TouchingContact> contacts = simulation.contacts().touching();
    std::vector<ContactSpring> springs(contacts.size());
    for_chunks(contacts.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c < end; ++c) {
            const auto [i, j] = std::pair(contacts[c].i, contacts[c].j);
            if (j >= 0) {
                const Vec3 branch = s.position[j] - s.position[i];
                const double kn =
                    kernels::contact_stiffness(0.5 * (s.radius[i] + s.radius[j]),
                                               s.normal_stiffness[i], s.normal_stiffness[j]);
                springs[c] = {i,
                              j,
                              branch.normalized(),
                              kn,
                              friction ? scene.stiffness_ratio * kn : 0.0,
                              s.radius[i],
                              s.radius[j]};
                continue;
            }
            const Wall& wall = scene.walls[static_cast<std::size_t>(-1 - j)];
            const double k = s.normal_stiffness[i];
            const double ks_sphere = scene.stiffness_ratio * k;
            const double ks_wall = wall.stiffness_ratio * wall.normal_stiffness;
            const bool sticks = friction && wall.friction_angle > 0 && ks_wall > 0;
            springs[c] = {i,
                          -1,
                          -wall.normal,
                          kernels::contact_stiffness(s.radius[i], k, wall.normal_stiffness),
                          sticks ? kernels::contact_stiffness(s.radius[i], ks_sphere, ks_wall) : 0,
                          s.radius[i],
                          0.0};
        }
    });
    return springs;
}

namespace {

/// Sum over contacts of stiffness on a sphere, relative to its mass and inertia; bounds its
/// frequencies with all neighbours held fixed, squared [rad2/s2].
std::vector<double> stiffness_on_mass(const Simulation& simulation,
                                      const std::vector<ContactSpring>& springs) {
    std::vector<double> sum(simulation.size(), 0.0);
    for (const ContactSpring& k : springs) {
        const double stiffness = k.kn + 2 * k.ks;
        sum[k.i] += stiffness * simulation.sphere(k.i).inverse_inertial_mass();
        if (k.j >= 0) sum[k.j] += stiffness * simulation.sphere(k.j).inverse_inertial_mass();
    }
    return sum;
}

}  // namespace

void FrequencyEstimator::assemble(const Simulation& simulation) {
    springs_ = {};  // frees those of the last estimate first
    springs_ = contact_springs(simulation);
    const std::vector<double> sum = stiffness_on_mass(simulation, springs_);
    const double largest = sum.empty() ? 0.0 : *std::max_element(sum.begin(), sum.end());
    const double limit = softest_part * largest;
    std::erase_if(springs_, [&](const ContactSpring& k) {
        return sum[k.i] < limit && (k.j < 0 || sum[k.j] < limit);
    });
    springs_.shrink_to_fit();  // few are left
    // Only spheres that take part get a number.
    std::vector<std::int32_t> number(simulation.size(), -1);
    std::vector<std::int32_t> spheres;
    const auto numbered = [&](std::int32_t& i) {
        if (number[i] < 0) {
            number[i] = static_cast<std::int32_t>(spheres.size());
            spheres.push_back(i);
        }
        i = number[i];
    };
    for (ContactSpring& k : springs_) {
        numbered(k.i);
        if (k.j >= 0) numbered(k.j);
    }
    if (spheres != sphere_) carry_mode(simulation.size(), spheres);
    sphere_ = std::move(spheres);
    spheres_ = sphere_.size();
    offsets_.assign(spheres_ + 1, 0);
    for (const ContactSpring& spring : springs_) {
        ++offsets_[spring.i + 1];
        if (spring.j >= 0) ++offsets_[spring.j + 1];
    }
    for (std::size_t i = 0; i < spheres_; ++i) offsets_[i + 1] += offsets_[i];
    incidences_.resize(offsets_.back());
    std::vector<std::uint32_t> next(offsets_.begin(), offsets_.end() - 1);
    for (std::size_t c = 0; c < springs_.size(); ++c) {
        incidences_[next[springs_[c].i]++] = static_cast<std::uint32_t>(2 * c);
        if (springs_[c].j >= 0)
            incidences_[next[springs_[c].j]++] = static_cast<std::uint32_t>(2 * c + 1);
    }
    scale_.resize(2 * spheres_);
    for (std::size_t i = 0; i < spheres_; ++i) {
        scale_[2 * i] = std::sqrt(simulation.sphere(sphere_[i]).inverse_inertial_mass());
        scale_[2 * i + 1] = std::sqrt(simulation.sphere(sphere_[i]).inverse_inertia());
    }
}

/// Renumbers the mode found last; spheres that are new start at rest.
void FrequencyEstimator::carry_mode(std::size_t all, const std::vector<std::int32_t>& spheres) {
    if (mode_.empty()) return;
    std::vector<std::int32_t> old(all, -1);
    for (std::size_t k = 0; k < sphere_.size(); ++k) old[sphere_[k]] = static_cast<std::int32_t>(k);
    std::vector<double> mode(6 * spheres.size(), 0.0);
    for (std::size_t k = 0; k < spheres.size(); ++k)
        if (const std::int32_t from = old[spheres[k]]; from >= 0)
            std::copy_n(&mode_[6 * static_cast<std::size_t>(from)], 6, &mode[6 * k]);
    mode_ = std::move(mode);
}

void FrequencyEstimator::apply(const std::vector<double>& x, std::vector<double>& y) const {
    const auto part = [&x](std::size_t k) { return Eigen::Map<const Vec3>(&x[k]); };
    for_chunks(spheres_, [&](std::size_t, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
            for (std::uint32_t e = offsets_[i]; e < offsets_[i + 1]; ++e) {
                const ContactSpring& k = springs_[incidences_[e] >> 1];
                // Motion of the far body relative to the near one at the contact, seen from i.
                Vec3 u = -scale_[2 * k.i] * part(6 * k.i);
                Vec3 roll = k.radius_i * scale_[2 * k.i + 1] * part(6 * k.i + 3);
                if (k.j >= 0) {
                    u += scale_[2 * k.j] * part(6 * k.j);
                    roll += k.radius_j * scale_[2 * k.j + 1] * part(6 * k.j + 3);
                }
                const double normal = u.dot(k.normal);
                Vec3 shear = Vec3::Zero();
                if (k.ks > 0) shear = k.ks * (u - normal * k.normal - roll.cross(k.normal));
                const bool second = incidences_[e] & 1;
                const Vec3 on_first = k.kn * normal * k.normal + shear;
                force += second ? Vec3(-on_first) : on_first;
                moment += (second ? k.radius_j : k.radius_i) * k.normal.cross(shear);
            }
            // Stiffness times displacement is minus the restoring force.
            for (int a = 0; a < 3; ++a) {
                y[6 * i + a] = -scale_[2 * i] * force[a];
                y[6 * i + 3 + a] = -scale_[2 * i + 1] * moment[a];
            }
        }
    });
}

void FrequencyEstimator::start_vector() {
    std::vector<double> local(spheres_, 0.0);
    for (const ContactSpring& k : springs_) {
        local[k.i] += k.kn * scale_[2 * k.i] * scale_[2 * k.i];
        if (k.j >= 0) local[k.j] += k.kn * scale_[2 * k.j] * scale_[2 * k.j];
    }
    const double highest = *std::max_element(local.begin(), local.end());
    std::vector<double> start(6 * spheres_);
    double norm2 = 0;
    for (std::size_t i = 0; i < spheres_; ++i) {
        const double weight = std::pow(local[i] / highest, 4);
        for (std::size_t a = 0; a < 6; ++a) {
            // A fixed pattern without symmetry, so that no mode is orthogonal to it by design.
            const auto index = static_cast<std::size_t>(sphere_[i]) * 6 + a;
            const auto code = static_cast<double>(index * 2654435761u % 1000003u);
            start[6 * i + a] = weight * (code / 500001.5 - 1.0);
            norm2 += start[6 * i + a] * start[6 * i + a];
        }
    }
    const double fresh = mode_.size() == start.size() ? 0.3 : 1.0;
    for (std::size_t k = 0; k < start.size(); ++k)
        start[k] = fresh * start[k] / std::sqrt(norm2) + (fresh < 1.0 ? mode_[k] : 0.0);
    mode_ = std::move(start);
}

double FrequencyEstimator::lanczos_round(int iterations) {
    const std::size_t n = mode_.size();
    const auto dot = [n](const std::vector<double>& a, const std::vector<double>& b) {
        return sum_chunks<double>(n, [&](std::size_t begin, std::size_t end) {
            double sum = 0;
            for (std::size_t k = begin; k < end; ++k) sum += a[k] * b[k];
            return sum;
        });
    };
    const auto update = [n](std::vector<double>& a, double factor, const std::vector<double>& b) {
        for_chunks(n, [&](std::size_t, std::size_t begin, std::size_t end) {
            for (std::size_t k = begin; k < end; ++k) a[k] += factor * b[k];
        });
    };
    std::vector<std::vector<double>> basis;
    std::vector<double> diagonal, off_diagonal;
    std::vector<double> w(n);
    std::vector<double> v = mode_;
    double beta = std::sqrt(dot(v, v));
    for (int k = 0; k < iterations && beta > 0; ++k) {
        for (double& value : v) value /= beta;
        basis.push_back(v);
        apply(v, w);
        const double alpha = dot(w, v);
        diagonal.push_back(alpha);
        update(w, -alpha, v);
        if (k > 0) update(w, -off_diagonal.back(), basis[static_cast<std::size_t>(k) - 1]);
        beta = std::sqrt(dot(w, w));
        off_diagonal.push_back(beta);
        if (beta < 1e-12 * std::abs(alpha)) break;  // an invariant subspace
        v = w;
    }
    if (diagonal.empty()) return 0;
    const auto m = static_cast<Eigen::Index>(diagonal.size());
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
    solver.computeFromTridiagonal(Eigen::Map<const Eigen::VectorXd>(diagonal.data(), m),
                                  Eigen::Map<const Eigen::VectorXd>(off_diagonal.data(), m - 1));
    const Eigen::VectorXd ritz = solver.eigenvectors().col(m - 1);
    std::fill(mode_.begin(), mode_.end(), 0.0);
    for (Eigen::Index k = 0; k < m; ++k) update(mode_, ritz[k], basis[static_cast<std::size_t>(k)]);
    // Some eigenvalue lies within the residual of the Ritz value: err on the safe side.
    return solver.eigenvalues()[m - 1] + off_diagonal.back() * std::abs(ritz[m - 1]);
}

double FrequencyEstimator::estimate(const Simulation& simulation, int restarts, int iterations) {
    assemble(simulation);
    if (springs_.empty()) {
        mode_.clear();
        sphere_.clear();
        return 0;
    }
    start_vector();
    double square = 0;
    for (int round = 0; round < restarts; ++round) square = lanczos_round(iterations);
    return std::sqrt(std::max(0.0, square));
}

namespace {

/// Caged between two spheres of its own kind.
std::vector<double> square_between_alike(const Simulation& simulation) {
    const ParticleStore& s = simulation.spheres();
    const double ratio = simulation.scene().stiffness_ratio;
    std::vector<double> square(s.size());
    for (std::size_t i = 0; i < s.size(); ++i) {
        const double kn =
            kernels::contact_stiffness(s.radius[i], s.normal_stiffness[i], s.normal_stiffness[i]);
        const double m = simulation.sphere(i).inverse_inertial_mass();
        // Two contacts on opposite sides, neighbours moving against it: 4 K_n/m. Rolling and
        // sliding of one contact, both bodies turning: 7 K_s/m.
        square[i] = std::max(4.0, 7.0 * ratio) * kn * m;
    }
    return square;
}

/// K_n (1/m_i + 1/m_j) of the two stiffest contacts that each sphere may have [rad2/s2].
class StiffestTwo {
  public:
    explicit StiffestTwo(std::size_t spheres) : first_(spheres), second_(spheres) {}
    void add(std::size_t i, double value) {
        second_[i] = std::max(second_[i], std::min(first_[i], value));
        first_[i] = std::max(first_[i], value);
    }
    /// As above, of unlike spheres; infinite for a sphere without two.
    double square(std::size_t i, double ratio) const {
        if (second_[i] == 0) return std::numeric_limits<double>::infinity();
        return std::max(first_[i] + second_[i], 3.5 * ratio * first_[i]);
    }

  private:
    std::vector<double> first_, second_;
};

}  // namespace

std::vector<double> caged_square_frequencies(const Simulation& simulation) {
    const Scene& scene = simulation.scene();
    const ParticleStore& s = scene.spheres;
    StiffestTwo stiffest(s.size());
    for (const auto& [i, j] : simulation.contacts().neighbours()) {
        const double kn = kernels::contact_stiffness(0.5 * (s.radius[i] + s.radius[j]),
                                                     s.normal_stiffness[i], s.normal_stiffness[j]);
        const double value = kn * (simulation.sphere(i).inverse_inertial_mass() +
                                   simulation.sphere(j).inverse_inertial_mass());
        stiffest.add(static_cast<std::size_t>(i), value);
        stiffest.add(static_cast<std::size_t>(j), value);
    }
    for (const Wall& wall : scene.walls)
        for (std::size_t i = 0; i < s.size(); ++i) {
            // No wall comes a diameter nearer between two estimates.
            if (wall.normal.dot(s.position[i] - wall.point) > 3 * s.radius[i]) continue;
            const double kn = kernels::contact_stiffness(s.radius[i], s.normal_stiffness[i],
                                                         wall.normal_stiffness);
            stiffest.add(i, kn * simulation.sphere(i).inverse_inertial_mass());
        }
    std::vector<double> square = square_between_alike(simulation);
    for (std::size_t i = 0; i < s.size(); ++i)
        square[i] = std::min(square[i], stiffest.square(i, scene.stiffness_ratio));
    return square;
}

double caged_frequency(const Simulation& simulation, double known) {
    const auto largest = [](const std::vector<double>& square) {
        return square.empty() ? 0.0 : std::sqrt(*std::max_element(square.begin(), square.end()));
    };
    const double alike = largest(square_between_alike(simulation));
    return alike <= known ? alike : largest(caged_square_frequencies(simulation));
}

std::vector<double> local_square_frequencies(const Simulation& simulation) {
    const ParticleStore& s = simulation.spheres();
    std::vector<Eigen::Matrix3d> directions(s.size(), Eigen::Matrix3d::Zero());
    std::vector<double> shear(s.size(), 0.0);
    const auto add = [&](std::int32_t i, const ContactSpring& k) {
        directions[i] += (k.kn - k.ks) * k.normal * k.normal.transpose();
        directions[i].diagonal().array() += k.ks;
        shear[i] += k.ks;
    };
    for (const ContactSpring& k : contact_springs(simulation)) {
        add(k.i, k);
        if (k.j >= 0) add(k.j, k);
    }
    std::vector<double> local(s.size(), 0.0);
    for_chunks(s.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const double translation = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>()
                                           .computeDirect(directions[i], Eigen::EigenvaluesOnly)
                                           .eigenvalues()[2] *
                                       simulation.sphere(i).inverse_inertial_mass();
            const double rotation =
                shear[i] * s.radius[i] * s.radius[i] * simulation.sphere(i).inverse_inertia();
            local[i] = std::max(translation, rotation);
        }
    });
    return local;
}

}  // namespace grainfield::core
