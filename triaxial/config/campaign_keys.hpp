#pragma once
// The part of [montecarlo] that varies other keys: sweep and cases.

#include <string>
#include <vector>

#include "triaxial/config/config.hpp"
#include "triaxial/config/toml_reader.hpp"

namespace grainfield::triaxial {

/// One case of a campaign: its name and the values it sets, later ones over earlier. The values
/// stand in the document of the reader.
struct CaseKeys {
    std::string name;
    TomlLeaves values;
};

/// A case's name as part of the name of a file.
std::string case_file_name(std::string name);

/// Takes montecarlo.sweep and montecarlo.case and checks that every key in them is one of a config
/// and every value one that it may have. Returns the cases, each of [[montecarlo.case]] crossed
/// with the sweep: cases in the order of the file, swept keys by name, the last the fastest; one
/// case `base` where neither is given. Names are such that they and their case_file_name() differ.
/// Throws InputError.
std::vector<CaseKeys> read_campaign(TomlReader& reader);

/// Values of keys in a config as tables have them: 5x0.5x5 for [5, 0.5, 5], "" for one not set;
/// nothing in them separates columns or lines.
std::vector<std::string> table_texts(const Config& config, const std::vector<std::string>& keys);

}  // namespace grainfield::triaxial
