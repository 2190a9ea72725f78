#pragma once

#include <cstdint>
#include <string_view>

namespace nplc::macreg {

/// Of what `why` has found.
enum class Severity : std::uint8_t {
    stops,    ///< it cannot move because of it
    hinders,  ///< it may soon, moves less than wanted, or not everywhere
    tells,    ///< good to know
};

/// For programs.
constexpr std::string_view name_of(Severity severity) {
    switch (severity) {
        case Severity::stops:
            return "stops";
        case Severity::hinders:
            return "hinders";
        case Severity::tells:
            break;
    }
    return "tells";
}

}  // namespace nplc::macreg
