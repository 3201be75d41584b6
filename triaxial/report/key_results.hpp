#pragma once
// The tables of the page: what came out, of which sample, how exact, and how it was run.

#include <string>
#include <vector>

#include "triaxial/report/run_folder.hpp"

namespace grainfield::triaxial::report {

struct Row {
    std::string name;   ///< HTML
    std::string value;  ///< HTML, number and unit
    std::string note;   ///< HTML, what it means or how exact it is; may be empty
};

struct Table {
    std::string title;  ///< HTML
    std::vector<Row> rows;
};

/// Rows whose key the run did not record are left out.
std::vector<Table> key_tables(const RunFolder& run);

/// The outcome as one sentence, HTML.
std::string outcome(const RunFolder& run);

}  // namespace grainfield::triaxial::report
