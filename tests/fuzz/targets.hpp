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
bool lammps_data(std::string_view input);
bool lammps_dump(std::string_view input);
bool yade_text(std::string_view input);
bool sphere_h5(std::string_view input);
bool sphere_h5_made(std::string_view recipe);  ///< the file that made_h5() makes of it

struct Target {
    const char* name;  ///< and folder of its corpus
    bool (*run)(std::string_view);
    int replays = 10000;  ///< spoilt inputs with every test run
};
inline constexpr Target targets[] = {{"config", config},
                                     {"scene", scene},
                                     {"sphere_csv", sphere_csv},
                                     {"lammps_data", lammps_data, 5000},
                                     {"lammps_dump", lammps_dump, 5000},
                                     {"yade_text", yade_text, 5000},
                                     {"sphere_h5", sphere_h5},
                                     {"sphere_h5_made", sphere_h5_made, 2000}};

}  // namespace grainfield::fuzz
