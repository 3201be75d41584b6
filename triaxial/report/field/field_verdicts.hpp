#pragma once
// What a verification found, check by check, in words.

#include <string>
#include <vector>

#include "randomfield/verification/verification.hpp"

namespace grainfield::triaxial::report {

struct Verdict {
    std::string check;    ///< "correlation, friction angle"
    std::string finding;  ///< "0 of 24 lags outside ..."
    bool inside = true;   ///< false: the field is not what it should be, or a false alarm (1 %)
};

std::vector<Verdict> verdicts(const randomfield::FieldGenerator& generator,
                              const randomfield::Verification& verification);

}  // namespace grainfield::triaxial::report
