#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "compiler/truth.h"
#include "seqc/diagnostic.h"

namespace nplc::seqc {

/// The branches of a step processed so far, and the rule of each case.
class SeenBranches {
  public:
    struct Branch {
        Truth when;
        Span condition;
        std::size_t choice;
        std::size_t rule;  ///< index in the step's rules
    };
    std::vector<Branch> list;

    SeenBranches() { rule_of_.fill(kFree); }

    /// Assigns the cases to a rule; true if another one already has some of them.
    bool claim(const Truth& when, std::size_t rule) {
        bool contested = false;
        for (std::size_t c = when._Find_first(); c < kCases; c = when._Find_next(c)) {
            if (rule_of_[c] == rule) continue;
            contested = contested || rule_of_[c] != kFree;
            rule_of_[c] = rule_of_[c] == kFree ? rule : kContested;
        }
        return contested;
    }

  private:
    static constexpr std::size_t kFree = SIZE_MAX;
    static constexpr std::size_t kContested = SIZE_MAX - 1;
    std::array<std::size_t, kCases> rule_of_{};
};

}  // namespace nplc::seqc
