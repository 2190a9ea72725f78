#pragma once

#include <string>
#include <string_view>

namespace nplc::sim {

inline constexpr std::string_view kNoTimeline = "there is no timeline here";
inline constexpr std::string_view kHasPower = "it has its supply already";
inline constexpr std::string_view kHasNone = "it has no supply (motor power off)";

inline std::string power_note(bool powered, bool on) {
    if (powered != on) return {};
    return std::string(on ? kHasPower : kHasNone);
}

}  // namespace nplc::sim
