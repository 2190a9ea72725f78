#include "macreg/limits.h"

#include <fmt/format.h>

namespace nplc::macreg {

using enum registers::Number;

namespace {

constexpr std::int64_t kDisPLim = 1 << 14;  // of ERR_STAT (001 §3.2.35, 004)

struct Limits {
    std::int64_t low, high, place;
    bool off;

    bool act() const { return !off && (low != 0 || high != 0); }
    bool leave_none() const { return low >= high && (low != 0 || high != 0); }
    bool shut_out() const { return act() && (place < low || place > high); }
};

Limits limits_of(const RawValues& now, const RawValues& wanted) {
    const auto at = [&](std::uint8_t number) {
        const auto found = wanted.find(number);
        return found != wanted.end() ? found->second : now.at(number);
    };
    return {at(MIN_P_IST), at(MAX_P_IST), at(P_IST), (at(ERR_STAT) & kDisPLim) != 0};
}

RawValues only(const RawValues& values, std::uint8_t number) {
    return {{number, values.at(number)}};
}

}  // namespace

RawValues read_limits(Motor& motor, const RawValues& wanted) {
    constexpr std::uint8_t kAll[] = {MIN_P_IST, MAX_P_IST, P_IST, ERR_STAT};
    RawValues now;
    const auto touched = [&](std::uint8_t number) { return wanted.count(number) != 0; };
    if (std::none_of(std::begin(kAll), std::end(kAll), touched)) return now;
    for (const std::uint8_t number : kAll) now[number] = motor.read(number);
    return now;
}

std::string limits_danger(const RawValues& now, const RawValues& wanted) {
    if (now.empty()) return {};
    const Limits before = limits_of(now, {}), after = limits_of(now, wanted);
    const bool one_alone = wanted.count(MIN_P_IST) != wanted.count(MAX_P_IST);
    const char* both =
        one_alone ? "; both can be set at once: `macreg set MIN_P_IST LOW MAX_P_IST HIGH`" : "";
    if (after.leave_none() &&
        !(before.leave_none() && wanted.count(MIN_P_IST) + wanted.count(MAX_P_IST) == 0))
        return fmt::format(
            "MIN_P_IST ({}) is then not below MAX_P_IST ({}): every position is outside, and the motor makes "
            "itself passive at once (PLIM_ERR){}",
            after.low, after.high, both);
    if (after.shut_out() && !before.shut_out())
        return fmt::format(
            "P_IST ({}) is then outside of {} to {}: the motor makes itself passive at once (PLIM_ERR){}",
            after.place, after.low, after.high, both);
    return {};
}

bool maximum_first(const RawValues& now, const RawValues& wanted) {
    return limits_of(now, only(wanted, MIN_P_IST)).shut_out() &&
           !limits_of(now, only(wanted, MAX_P_IST)).shut_out();
}

}  // namespace nplc::macreg
