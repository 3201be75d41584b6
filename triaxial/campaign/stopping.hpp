#pragma once
// When a case has enough realizations: where the config asks for narrow intervals instead of a
// number. The answer depends on the first realizations alone, in their order, and so is the same
// however and by whom they were computed.

#include <cstdint>
#include <optional>
#include <vector>

#include "triaxial/campaign/plan.hpp"
#include "triaxial/campaign/row.hpp"

namespace grainfield::triaxial {

class Stopping {
  public:
    explicit Stopping(const std::vector<CampaignCase>& cases);

    /// Takes a finished row into account; one that is known already changes nothing.
    void add(const RowPlace& place, const Row& row);
    /// Realizations that a case needs as far as is known: those asked for, or fewer once the 95 %
    /// intervals of peak and E50 over the first 20, 30, 40 ... are as narrow as asked [-].
    std::int64_t needed(std::size_t case_index) const { return cases_[case_index].needed; }
    bool wants(const RowPlace& place) const { return place.realization < needed(place.case_index); }

  private:
    struct Values {
        double peak, E50;  // [Pa]
    };
    struct CaseState {
        MonteCarloOptions options;
        std::int64_t needed = 0;
        std::vector<bool> known;                  // by realization
        std::vector<std::optional<Values>> rows;  // of those that did not fail
        std::int64_t whole = 0;                   // all below are known
        std::int64_t next_look = 0;
    };
    static bool narrow(const CaseState& state, std::int64_t realizations);

    std::vector<CaseState> cases_;
};

}  // namespace grainfield::triaxial
