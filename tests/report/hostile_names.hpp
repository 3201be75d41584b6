#pragma once
// Names that a stranger could give to cases, keys and folders.

#include <string>
#include <vector>

namespace grainfield::triaxial::fixture {

/// Names that would make a file, were any part of them run or read as markup.
inline std::vector<std::string> hostile_names(const std::string& touch) {
    return {"`" + touch + "`",
            "a'b",
            "'; system('" + touch + "'); '",
            "\"; system('" + touch + "'); \"",
            "x\n!" + touch + "\nsystem('" + touch + "')",
            "@main @name $trends",
            "a_b^c {/:Bold d} &{e} ~f{g} \\h \\101",
            "EOD\n!" + touch + "\nEOD",
            "#{} } else { !" + touch,
            "<script>alert(1)</script> & <b>",
            "\\",
            "'",
            "%s %n %d",
            "x' . system('" + touch + "') . '"};
}

}  // namespace grainfield::triaxial::fixture
