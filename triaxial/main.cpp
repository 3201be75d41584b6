// The program `grainfield`; see triaxial/cli/.

#include "triaxial/cli/command_line.hpp"

int main(int argc, char** argv) {
    return grainfield::triaxial::run_program(argc, argv);
}
