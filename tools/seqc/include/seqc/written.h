#pragma once

#include <bitset>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "seqc/diagnostic.h"

namespace nplc::seqc {

/// Where in a program's source stands what its table does. Cases are those of `semantics/truth.h`.
struct Written {
    using Cases = std::bitset<1024>;

    struct Branch {
        Cases when;                             ///< what earlier branches take left out
        Span condition;                         ///< length 0: the program wrote none
        std::vector<Span> statements;           ///< without NEXT, in the order of the program
        std::optional<std::uint8_t> next;       ///< as the program says
        std::optional<std::uint8_t> by_helper;  ///< the step that the compiler made on the way there
    };
    struct Output {
        std::uint8_t outputs = 0;  ///< bits 3..0
        Cases when;
        Span condition;
    };
    /// Of the SEQUENCE that a step stands in, as it was called.
    struct Argument {
        std::string parameter;
        std::string text;
    };
    struct Step {
        std::uint8_t number = 0;
        bool is_helper = false;
        std::vector<Branch> branches;  ///< in the order in which they are judged
        std::vector<Span> entry;       ///< in step 0 the values of VAR_MOTOR: `Home AT P1 := 0 mm`
        std::vector<Output> outputs;   ///< those with a condition
        std::vector<Argument> arguments = {};
    };
    /// ON condition IN .. EXCEPT .. NEXT := Step;
    struct Everywhere {
        Span condition;
        Span where;  ///< IN and EXCEPT; length 0: neither
    };

    std::vector<Step> steps;
    std::vector<Everywhere> everywhere;
};

}  // namespace nplc::seqc
