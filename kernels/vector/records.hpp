#pragma once
// The working copy of spheres and contacts that the vector kernels read and write. T is float in
// mixed precision, double otherwise. Plain data; core/vector/ owns it.
//
// Spheres are packed into one record each, because a contact needs all of a record of two spheres
// that lie anywhere: loading whole records and transposing them in registers beats gathering
// twelve separate columns. Positions are displacements u since the lists were built, and every
// candidate knows the exact separation of its two spheres at that time: float resolves an overlap
// to better than 1 nm that way, however large the sample is.

#include <cstddef>
#include <cstdint>

namespace grainfield::kernels {

/// All that a contact needs. Of two spheres it needs differences (u, v) and sums (the rest). Both
/// are formed from whole records, and only the result is transposed.
template <class T>
struct alignas(16 * sizeof(T)) SphereRecord {
    T u[3];            ///< displacement since the lists were built [m]
    T radius;          ///< [m]
    T v[3];            ///< mid-step velocity [m/s]
    T compliance;      ///< 1/k_n [1/Pa]
    T w[3];            ///< mid-step spin [rad/s]
    T friction;        ///< tan(phi) [-]
    T radius_spin[3];  ///< radius times spin [m/s]
    T spare;           ///< unused [-]
};
static_assert(sizeof(SphereRecord<float>) == 64);
static_assert(sizeof(SphereRecord<double>) == 128);

/// What the contacts of a sphere add up to.
template <class T>
struct alignas(8 * sizeof(T)) SphereLoad {
    T force[3];              ///< resultant of the contacts [N]
    T spare;                 ///< unused [-]
    T moment_per_radius[3];  ///< [N]
    T spare_too;             ///< unused [-]
};
static_assert(sizeof(SphereLoad<float>) == 32);

/// Lists name a record by its number times this. The address of a record is then 8 times its entry
/// in a list, and x86 multiplies by 8 as part of a load.
template <class T>
inline constexpr std::int32_t record_stride = sizeof(SphereRecord<T>) / 8;
template <class T>
const SphereRecord<T>& record_of(const SphereRecord<T>* records, std::int32_t entry) {
    return *reinterpret_cast<const SphereRecord<T>*>(reinterpret_cast<const char*>(records) +
                                                     std::size_t{8} *
                                                         static_cast<std::uint32_t>(entry));
}
template <class T>
SphereLoad<T>& load_of(SphereLoad<T>* loads, std::int32_t entry) {
    static_assert(sizeof(SphereLoad<T>) == 4 * record_stride<T>);
    return *reinterpret_cast<SphereLoad<T>*>(reinterpret_cast<char*>(loads) +
                                             std::size_t{4} * static_cast<std::uint32_t>(entry));
}

/// What the motion of a domain's own spheres needs beside their records, a column each. The first
/// four are padded to multiples of most_lanes, the others are not.
template <class T>
struct BodyColumns {
    std::size_t own;          ///< how many spheres
    const T* inverse_mass;    ///< of the motion; differs from 1/mass if scaled [1/kg]
    const T* spin_response;   ///< radius over moment of inertia [1/(kg m)]
    const T* mass;            ///< gravitational [kg]
    const T* inverse_buffer;  ///< 1 over what it may move beyond the box's strain [1/m]
    const double *x, *y, *z;  ///< centre when the lists were built [m]
};

/// Where a sphere was when the lists were built: all that makes two of them neighbours.
struct alignas(64) BuiltPlace {
    double x[3];      ///< centre [m]
    double radius;    ///< [m]
    double buffer;    ///< what it may move beyond the box's strain [m]
    double spare[3];  ///< unused [-]
};

/// Lanes of the widest vectors. Lists are padded to multiples of it with candidates that never
/// touch.
inline constexpr std::size_t most_lanes = 16;

inline constexpr std::size_t padded(std::size_t n) {
    return (n + most_lanes - 1) / most_lanes * most_lanes;
}

/// Candidates are sorted into bins by the share of their buffers that two bodies must use up before
/// they can meet. Bin 0 is narrow: its pairs touch or nearly do. A step looks at the bins that
/// motion since the build has brought into play, and at no others.
inline constexpr std::size_t distance_bins = 8;
inline constexpr double first_bin = 0.01;  ///< its length, as a share of the buffers [-]

/// Candidates stand in blocks of most_lanes, component by component: x of all of a block, then y,
/// z and so on. Place of a component of candidate k in a column of `components`:
constexpr std::size_t in_block(std::size_t k, std::size_t component, std::size_t components) {
    return k / most_lanes * most_lanes * components + component * most_lanes + k % most_lanes;
}
/// Separation of the two bodies when the lists were built: second minus first, x, y, z (unused for
/// walls), and the gap: reach minus distance, negative if they were apart [m].
inline constexpr std::size_t separation_size = 4, gap_component = 3;
/// What a contact carries from step to step: the shear force on the first body; zero where it does
/// not touch [N].
inline constexpr std::size_t history_size = 3;

/// Pairs of the outer list, padded to multiples of most_lanes.
template <class T>
struct OuterPairs {
    std::size_t size;
    const std::int32_t *a, *b;  ///< places
    T* separation;              ///< in blocks
    std::uint8_t* bin;          ///< `distance_bins` if they cannot meet before the next build
};

/// The candidates that a step looks at: pairs of spheres, or a sphere and a wall (b is unused). The
/// kernels take the first `size` of the list. The first `close` of these are bin 0: most touch, and
/// all go through the contact law. Of the others only those that touch do. Both numbers are
/// multiples of most_lanes. The candidate `idle` is padding: it never touches, and the loads of its
/// records count nowhere.
template <class T>
struct Candidates {
    std::size_t size, close;
    std::size_t idle;
    const std::int32_t *a, *b;  ///< records, times record_stride
    const T* separation;        ///< in blocks
    T* history;                 ///< in blocks
    std::uint16_t* touching;    ///< a bit a candidate, most_lanes in a word
    std::int32_t* scratch;      ///< size + most_lanes entries to write to
    /// What the caller will read next, to be asked of memory meanwhile; may be empty.
    const char* coming = nullptr;
    std::size_t coming_bytes = 0;  ///< [B]
};

template <class T>
struct PairParameters {
    T stiffness_ratio;     ///< k_s/k_n of the spheres [-]
    T uniform_stiffness;   ///< k_n of all spheres where it is the same [Pa]
    T uniform_friction;    ///< tan(phi) of all spheres where it is the same [-]
    T smallest_radius;     ///< of all spheres [m]
    T step;                ///< time since the last force evaluation; 0 at the first [s]
    std::int32_t counted;  ///< contacts whose first entry is below count in the sums
};

/// A plane wall as one domain sees it.
template <class T>
struct WallPlane {
    T normal[3];        ///< unit, towards the spheres [-]
    T velocity[3];      ///< during the last step [m/s]
    T advance;          ///< of the plane along its normal since the lists were built [m]
    T friction;         ///< tan(phi) [-]
    T stiffness;        ///< k_n [Pa]
    T stiffness_ratio;  ///< k_s/k_n of the wall [-]
};

template <class T>
struct MoveParameters {
    T gravity[3];       ///< [m/s2]
    T force_damping;    ///< alpha [-]
    T moment_damping;   ///< alpha [-]
    T old_step;         ///< h_old [s]
    T new_step;         ///< h_new [s]
    double middle[3];   ///< of the sample; what follows is relative to it [m]
    T affine_shift[3];  ///< of the box since the lists were built, at the end of the step [m]
    T affine_scale[3];  ///< [-]
};

struct MoveResult {
    double used_buffer2 = 0;  ///< largest square of motion beyond affine over buffer [-]
    double damping_work = 0;  ///< with the ledger only [J]
    bool too_far = false;     ///< a sphere moved more than half its radius, or is not a number
};

}  // namespace grainfield::kernels
