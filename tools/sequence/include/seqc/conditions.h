#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "seqc/sources.h"

/// The present values of the conditions in a program's active step, as written.
namespace nplc::seqc {

/// The state of a machine for evaluating the conditions of its active step.
struct Seen {
    std::uint8_t inputs = 0;  ///< bit n: IN n
    bool in_position = false;
    bool error = false;
    bool timer_ended = false;    ///< TIMER.Q
    bool counter_ended = false;  ///< COUNTER.Q
};

struct ConditionNow {
    struct Part {
        std::string_view text;
        bool holds = false;
    };
    std::string file;        ///< the program, or an included file
    std::uint32_t line = 0;  ///< from 1
    std::string_view text;
    bool holds = false;
    std::vector<Part> parts;  ///< the signals in it, each once
};

class Conditions {
  public:
    explicit Conditions(Sources sources);
    ~Conditions();
    Conditions(const Conditions&) = delete;
    Conditions& operator=(const Conditions&) = delete;

    /// The conditions of a step's IF, ELSIF and WHEN in source order, then the program's ON conditions that
    /// apply to it. Not considered: that a condition without ERROR has no effect during an ERROR, and a time
    /// after a condition. An edge is always false; its signal has its level. The texts are valid as long as
    /// this object.
    std::vector<ConditionNow> of(std::string_view step, const Seen& seen) const;

  private:
    struct Text;
    std::unique_ptr<const Text> text_;
};

}  // namespace nplc::seqc
