#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>

#include "macreg/motor.h"

/// MIN_P_IST and MAX_P_IST, which act together (001 §3.2.28, §4.5.3), when they are about to be written.
namespace nplc::macreg {

/// Raw values by register number.
using RawValues = std::map<std::uint8_t, std::int64_t>;

/// What decides whether the shaft is inside: both limits, P_IST and ERR_STAT. Empty if `wanted` touches none
/// of it.
RawValues read_limits(Motor& motor, const RawValues& wanted);
/// What goes wrong with the limits as `wanted` leaves them, for a question: no place is inside any more, or
/// the shaft is not. Empty: nothing that was not wrong before.
std::string limits_danger(const RawValues& now, const RawValues& wanted);
/// Whether the shaft would be outside with MIN_P_IST alone written, and not with MAX_P_IST alone.
bool maximum_first(const RawValues& now, const RawValues& wanted);

/// Puts MAX_P_IST before MIN_P_IST, or behind it: the order in which the shaft is outside at no time.
template <class Write>
void order_limits(const RawValues& now, const RawValues& wanted, std::vector<Write>& all) {
    const auto at = [&](std::uint8_t number) {
        return std::find_if(all.begin(), all.end(),
                            [=](const Write& one) { return one.reg->number == number; });
    };
    const auto low = at(registers::MIN_P_IST), high = at(registers::MAX_P_IST);
    if (low == all.end() || high == all.end()) return;
    if ((high < low) != maximum_first(now, wanted)) std::iter_swap(low, high);
}

}  // namespace nplc::macreg
