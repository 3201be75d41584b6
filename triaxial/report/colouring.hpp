#pragma once
// What a picture of the sample is coloured by, and the colour of each sphere.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/scene/particle_store.hpp"
#include "triaxial/report/gnuplot_variables.hpp"

namespace grainfield::triaxial::report {

enum class ColourBy { stiffness, friction, block, diameter };

struct Rgb {
    double r = 0, g = 0, b = 0;  ///< 0 to 1 [-]

    /// This colour with a share of another mixed in.
    Rgb mixed(const Rgb& other, double share) const;
    Rgb times(double light) const { return {r * light, g * light, b * light}; }
    std::uint32_t packed() const;  ///< 0xRRGGBB
};

/// What varies over the sample: stiffness, friction angle or both; where neither does, the blocks
/// of the flip technique, or the diameters where there are none.
std::vector<ColourBy> colourings(const core::ParticleStore& spheres);

/// The values of one colouring over a sample. Lighter is smaller, darker larger, as in Tran et al.
class Colouring {
  public:
    Colouring(const core::ParticleStore& spheres, ColourBy by);

    Rgb colour(std::size_t sphere) const;
    bool has_scale() const { return by_ != ColourBy::block; }
    bool logarithmic() const { return by_ == ColourBy::stiffness; }
    double lowest() const { return lowest_; }    ///< in the unit of label()
    double highest() const { return highest_; }  ///< in the unit of label()
    Markup label() const;                        ///< quantity and unit, gnuplot's enhanced text
    std::string in_words() const;                ///< for a caption
    static DataBlock palette();                  ///< share [-], red, green, blue of its stops

  private:
    double value(std::size_t sphere) const;

    const core::ParticleStore& spheres_;
    ColourBy by_;
    double lowest_ = 0, highest_ = 1;
};

}  // namespace grainfield::triaxial::report
