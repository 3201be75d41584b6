#pragma once
// The fast engine: packed records, vector kernels, domains. T is float in mixed precision (forces
// and motion in float, positions exact at every list build, long sums in double), double otherwise.
//
// A step is one parallel region: every domain copies its ghosts; then, domain by domain while its
// data are in cache, forces of its contacts and the motion of its spheres. Results are the same,
// bit for bit, for any number of threads; they depend on when the lists are built, which follows
// from the state alone.

#include <omp.h>

#include "core/engine.hpp"
#include "core/vector/domain.hpp"
#include "core/vector/spatial_order.hpp"

namespace grainfield::core {

/// A thread's own memory.
template <class T>
struct Scratch {
    Aligned<kernels::SphereLoad<T>> loads;
    Aligned<std::int32_t> touching;
    std::vector<kernels::WallLoad> known_wall_loads;  ///< of a pass that finds loads again
    ListScratch<T> lists;
};

template <class T>
class VectorEngine : public Engine {
  public:
    VectorEngine(World& world, const kernels::VectorKernels<T>& kernels);

    void compute_forces(bool sums) override;
    void move(double step) override;
    bool fuses() const override { return true; }
    void compute_and_move(double step) override;
    void pull() override;
    void pull_resultants() override;
    void push() override;
    void scale_velocities(double factor) override;
    void forget_walls() override;
    void invalidate_lists() override { stale_ = true; }
    std::vector<TouchingContact> touching() const override;
    std::int64_t touching_count() const override;
    std::int64_t candidate_count() const override;
    std::vector<kernels::Pair> neighbours() const override;
    double resultant_sum() override;
    std::size_t restore(std::span<const ContactShear> contacts) override;
    void save(StateWriter& archive) const override;
    void load(StateReader& archive) override;
    bool suspicious() const override { return suspicious_; }
    void cleared() override { suspicious_ = false; }
    bool alarmed() const override { return suspicious_; }
    std::int64_t list_builds() const override { return builds_; }
    StepCost step_cost() const override;
    std::int64_t searches() const override { return searches_; }
    std::int64_t renewals() const override { return renewals_; }

  private:
    template <class Archive>
    void serialize(Archive& archive);

    // A pass over the domains. Loads live in a core's cache and nowhere else: who wants them later,
    // the motion of a step that somebody looked into or the resultants, finds them again.
    struct Pass {
        bool again;                         // forces that have been computed, from what that left
        bool sums;                          // over contacts
        enum { sum, columns, motion } use;  // of the loads
        double step;                        // of the motion [s]
    };
    void run(const Pass& pass);
    void make_scratch() { scratch_.resize(static_cast<std::size_t>(omp_get_max_threads())); }
    void weigh();
    void copy_ghosts(Domain<T>& domain);
    void find_forces(Domain<T>& domain, const Domain<T>* coming, const Pass& pass,
                     Scratch<T>& scratch);
    void use_loads(Domain<T>& domain, const Aligned<kernels::SphereLoad<T>>& loads,
                   const Pass& pass, const kernels::MoveParameters<T>& motion);
    void collect(const Pass& pass);
    kernels::PairParameters<T> pair_parameters() const;
    kernels::MoveParameters<T> move_parameters(double step) const;
    kernels::WallPlane<T> wall_plane(std::size_t wall) const;
    double mass_of(const Domain<T>& domain, std::size_t k) const {
        return world_.spheres().mass[static_cast<std::size_t>(order_.sphere[domain.first + k])];
    }

    struct ReserveRules {
        double base, most, least;         // of the lists [m]
        double search_base, search_most;  // of the search [m]
        kernels::AffineMotion rate;       // of the box [1/s]
        kernels::AffineMotion since;      // the search
        double strain = 0;                // the largest since the search [-]
    };
    enum class Left { nothing, little, enough };  // of the search's reserve
    struct Shortage {
        bool exhausted = false;            // some need other neighbours
        std::vector<std::int32_t> scarce;  // slots of these and of those that soon will, ascending
    };

    // Lists (vector_lists.inc).
    double used_reserves() const;
    void rebuild();
    void fix_positions();
    void build_lists();
    void name_lost_sphere(const Domain<T>& domain) const;
    ReserveRules reserve_rules() const;
    Left choose_reserve(Domain<T>& domain, std::size_t k, const ReserveRules& rules);
    Shortage choose_reserves(const ReserveRules& rules);
    double foreseen_way(const Domain<T>& domain, std::size_t k, double steps,
                        const kernels::AffineMotion& rate) const;
    kernels::AffineMotion affine_rate() const;
    kernels::AffineMotion affine_motion(double ahead) const;

    // The search (vector_search.inc).
    float search_reserve(const Domain<T>& domain, std::size_t k, const ReserveRules& rules) const;
    void find_neighbours();
    void find_homes();
    bool renew_neighbours(const Shortage& shortage);
    std::vector<kernels::Pair> pairs_of(std::int32_t slot) const;

    Vec3 present_position(std::size_t slot) const;
    Vec3 searched_position(std::size_t slot) const;
    SlotRadii radii() const { return {order_.sphere, world_.spheres().radius}; }
    std::size_t domain_of(std::int32_t slot) const;
    TouchingContact pair_contact(const Domain<T>& domain, std::size_t k) const;
    TouchingContact wall_contact(const Domain<T>& domain, const WallList<T>& list,
                                 std::size_t k) const;

    const kernels::VectorKernels<T>& kernels_;
    SpatialOrder order_;
    std::vector<Domain<T>> domains_;
    std::vector<Scratch<T>> scratch_;            // of each thread
    std::vector<kernels::WallPlane<T>> planes_;  // at the last force evaluation

    BuiltState built_;
    struct {
        Column<std::array<float, 3>> moved;  // since the last search, by slot [m]
        Column<float> reserve;               // by slot [m]
        std::vector<Box> boxes;              // of each domain: what its spheres could reach [m]
        std::vector<Vec3> walls;             // their points [m]
    } searched_;
    Vec3 middle_ = Vec3::Zero();     // of the spheres' centres [m]
    double smallest_radius_ = 0;     // [m]
    std::vector<Vec3> built_walls_;  // their points [m]
    kernels::AffineMotion affine_;   // of the box, as the last motion foresaw it
    double used_reserve_ = 0;        // largest share of a reserve that motion used [-]
    double reach_per_reserve_ = 0;   // largest (radius + reserve)/reserve [-]
    double most_used_ = 0;           // of any reserve since the build [-]
    bool stale_ = true, suspicious_ = false;
    bool weighed_ = false;         // the bodies know their masses
    bool ghosts_outdated_ = true;  // of what does not change by motion
    std::int64_t builds_ = 0, searches_ = 0, renewals_ = 0;
};

}  // namespace grainfield::core
