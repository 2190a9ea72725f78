#pragma once

#include <bitset>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "seqc/diagnostic.h"

namespace nplc::seqc {

/// Source positions of a table's effects. Cases are those of `compiler/truth.h`.
struct Written {
    using Cases = std::bitset<1024>;

    struct Branch {
        Cases when;                             ///< without the cases taken by earlier branches
        Cases own;                              ///< of the condition alone, whatever stands before it
        Span condition;                         ///< length 0: no condition in the program
        std::vector<Span> statements;           ///< without NEXT, in program order
        std::optional<std::uint8_t> next;       ///< as written in the program
        std::optional<std::uint8_t> by_helper;  ///< the step that the compiler inserted on the way there
        bool is_idle = false;                   ///< does nothing, but keeps those behind it from acting
    };
    struct Output {
        std::uint8_t outputs = 0;  ///< bits 3..0
        Cases when;
        Span condition;
    };
    /// An argument of the SEQUENCE call that a step belongs to.
    struct Argument {
        std::string parameter;
        std::string text;
    };
    struct Step {
        std::uint8_t number = 0;
        bool is_helper = false;
        std::vector<Branch> branches;  ///< in the order of evaluation
        std::vector<Span> entry;       ///< in step 0 the values of VAR_MOTOR: `Home AT P1 := 0 mm`
        std::vector<Output> outputs;   ///< those with a condition
        std::vector<Argument> arguments = {};
        std::uint8_t blinking = 0;  ///< outputs, bits 3..0
        Span blink_time = {};       ///< how long they are on, and off
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
