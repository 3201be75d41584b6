#pragma once
// What reads files of others, for any bytes: it ends, or throws InputError or FileError. Anything
// else is a bug: another exception, a crash, or a file that is taken and not the same when it is
// written and read again.

#include <string_view>

namespace grainfield::fuzz {

// Each returns true if the input was taken, and aborts where one of these promises is broken.
bool config(std::string_view input);
bool scene(std::string_view input);
bool sphere_csv(std::string_view input);
bool sphere_h5(std::string_view input);

struct Target {
    const char* name;  ///< and folder of its corpus
    bool (*run)(std::string_view);
};
inline constexpr Target targets[] = {
    {"config", config}, {"scene", scene}, {"sphere_csv", sphere_csv}, {"sphere_h5", sphere_h5}};

}  // namespace grainfield::fuzz
