#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "registers/mac.h"

namespace nplc::macreg {

/// A register compared with a value: `V_IST>100 rpm`, `P_IST <= -4096`, `ERR_STAT & IN_POS`.
struct Comparison {
    enum class Relation : std::uint8_t { less, at_most, equal, unequal, at_least, more, any_bit };

    const registers::Register* reg = nullptr;
    Relation relation = Relation::equal;
    std::int64_t raw = 0;

    bool holds(std::int64_t value) const;
};

struct ConditionReading {
    Comparison condition{};
    std::string error{};  ///< one line; empty if it was understood
};

/// Values as `typed_value` takes them; `&` wants bits' names or a number.
ConditionReading read_condition(std::string_view text, registers::Model model);

/// "V_IST > 100 rpm"
std::string condition_words(const Comparison& condition, registers::Model model);

}  // namespace nplc::macreg
