#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "seqc/sources.h"

/// What the conditions of a program's active step are now, as they are written.
namespace nplc::seqc {

/// A machine as the conditions of its active step see it.
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
    std::string file;        ///< the program, or one that it includes
    std::uint32_t line = 0;  ///< from 1
    std::string_view text;
    bool holds = false;
    std::vector<Part> parts;  ///< the signals that it names, once each
};

class Conditions {
  public:
    explicit Conditions(Sources sources);
    ~Conditions();
    Conditions(const Conditions&) = delete;
    Conditions& operator=(const Conditions&) = delete;

    /// Those of a step's IF, ELSIF and WHEN in source order, then the program's ON conditions that count for
    /// it. Not counted: that a condition without ERROR leads nowhere while there is an ERROR, and a time
    /// behind a condition. An edge never holds; its signal has its level. The texts live as long as this.
    std::vector<ConditionNow> of(std::string_view step, const Seen& seen) const;

  private:
    struct Text;
    std::unique_ptr<const Text> text_;
};

}  // namespace nplc::seqc
