#include "nanoctl/texts.h"

#include <fmt/format.h>

namespace nplc::nanoctl {

std::string_view held_remark(const Status& status) {
    if (!status.has(registers::gateway::kCannotGoOn)) return {};
    return ", cannot go on from here: the motor cannot take up again what it did, or orders that waited for "
           "it for longer than 500 ms were dropped; `nanoctl stop`, then `nanoctl run`";
}

std::string stop_remark(const Status& status) {
    const bool is_virtual = status.has(registers::gateway::kVirtualMotor);
    return std::string(held_remark(status)) + (is_virtual ? "; no motor is told: virtual_motor is on" : "");
}

std::string unconfirmed_text(std::uint32_t milliseconds) {
    return fmt::format("STOP NOT CONFIRMED by the motor{}: it may be moving (mend the line, or give-up-stop)",
                       milliseconds == 0 ? "" : fmt::format(" for {:.1f} s", milliseconds / 1000.0));
}

std::string terms_text(std::size_t bytes) {
    const std::size_t terms = bytes / 8 - 1;
    return fmt::format("{} term{} and the end term", terms, terms == 1 ? "" : "s");
}

std::string time_text(std::uint32_t milliseconds) {
    const std::uint32_t minutes = milliseconds / 60'000;
    const double seconds = (milliseconds % 60'000) / 1000.0;
    if (minutes == 0) return fmt::format("{:.3f} s", seconds);
    return fmt::format("{} min {:06.3f} s", minutes, seconds);
}

}  // namespace nplc::nanoctl
