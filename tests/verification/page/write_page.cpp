// write_page RECORDS SCENES PAGE: the page from the records of a test run (see page.hpp).

#include <cstdio>
#include <exception>
#include <fstream>

#include "tests/verification/page/page.hpp"

int main(int argc, char** argv) {
    if (argc != 4) {
        std::fputs("usage: write_page RECORDS SCENES PAGE\n", stderr);
        return 2;
    }
    try {
        const std::string page = grainfield::verify::page_of(argv[1], argv[2]);
        std::ofstream stream(argv[3]);
        stream << page;
        if (!stream.flush()) throw std::runtime_error(std::string(argv[3]) + ": cannot be written");
    } catch (const std::exception& error) {
        std::fprintf(stderr, "write_page: %s\n", error.what());
        return 1;
    }
    return 0;
}
