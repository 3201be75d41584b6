#pragma once
// What the tests of files share: a sample with awkward numbers, a folder of their own, and
// bitwise comparison.

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <random>
#include <string>

#include "core/files/atomic_file.hpp"
#include "core/files/sphere_file.hpp"
#include "tests/message_of.hpp"

namespace grainfield::core {

/// A folder for one test, gone afterwards.
class FilesTest : public testing::Test {
  protected:
    FilesTest() { std::filesystem::create_directories(folder); }
    ~FilesTest() override { std::filesystem::remove_all(folder); }

    std::filesystem::path in_folder(const std::string& name) const { return folder / name; }

    /// Writes a text and gives its path back.
    std::filesystem::path text_file(const std::string& name, const std::string& content) const {
        write_file_atomically(in_folder(name), content);
        return in_folder(name);
    }

    std::size_t entries() const {
        return static_cast<std::size_t>(
            std::distance(std::filesystem::directory_iterator(folder), {}));
    }

    std::filesystem::path folder = std::filesystem::temp_directory_path() /
                                   ("grainfield_" + std::to_string(::getpid()) + "_" +
                                    testing::UnitTest::GetInstance()->current_test_info()->name());
};

/// Numbers with all their bits in use, of the sizes a real sample has, and the awkward ones.
inline SphereFile make_sample(std::size_t n) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    SphereFile file;
    ParticleStore& s = file.spheres;
    s.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
        s.position.set(i, {1.5 * unit(random), 3 * unit(random), 1.5 * unit(random)});
        s.velocity.set(i, {unit(random) - 0.5, 1e-9 * unit(random), -1e9 * unit(random)});
        s.spin.set(i, {-unit(random), 1e-300 * unit(random), unit(random)});
        s.radius[i] = 0.005 + 0.01 * unit(random);
        s.normal_stiffness[i] = 9e8 * (0.5 + unit(random));
        s.friction_angle[i] = 0.3 + 0.6 * unit(random);
        const auto b = static_cast<std::int32_t>(i);
        s.block[i] = {b % 6, b / 6 % 12, b / 72 % 6};
    }
    s.set_density(2600);
    if (n > 1) {
        s.velocity.set(0, {-0.0, std::numeric_limits<double>::denorm_min(), 0.1});
        s.block[1] = no_block;
    }
    file.box = Box{{-0.1, 0.0, 1.0 / 3.0}, {1.6, 3.1, 1.9}};
    file.has_normal_stiffness = file.has_friction_angle = true;
    file.has_velocity = file.has_block = true;
    return file;
}

template <class T>
bool same_bits(const Column<T>& a, const Column<T>& b) {
    return a.size() == b.size() &&
           (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

inline bool same_bits(const Vec3Column& a, const Vec3Column& b) {
    return same_bits(a.x, b.x) && same_bits(a.y, b.y) && same_bits(a.z, b.z);
}

/// All that a `.csv` can hold.
inline void expect_same_columns(const ParticleStore& a, const ParticleStore& b) {
    EXPECT_TRUE(same_bits(a.position, b.position));
    EXPECT_TRUE(same_bits(a.velocity, b.velocity));
    EXPECT_TRUE(same_bits(a.spin, b.spin));
    EXPECT_TRUE(same_bits(a.radius, b.radius));
    EXPECT_TRUE(same_bits(a.normal_stiffness, b.normal_stiffness));
    EXPECT_TRUE(same_bits(a.friction_angle, b.friction_angle));
    EXPECT_TRUE(same_bits(a.block, b.block));
}

}  // namespace grainfield::core
