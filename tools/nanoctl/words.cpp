#include "nanoctl/words.h"

#include <fmt/format.h>

#include <array>

namespace nplc::nanoctl {

using registers::gateway::Command;
using registers::gateway::RunState;

std::string_view name_of(Command command) {
    switch (command) {
        case Command::run:
            return "run";
        case Command::stop:
            return "stop";
        case Command::safe:
            return "safe";
        case Command::scan:
            return "scan";
        case Command::step:
            return "step";
        case Command::hold:
            return "hold";
        case Command::reset:
            return "reset";
        case Command::keep_settings:
            return "keep_settings";
        case Command::clear_log:
            return "clear_log";
        case Command::upload_begin:
            return "upload_begin";
        case Command::upload_commit:
            return "upload_commit";
        case Command::upload_abort:
            return "upload_abort";
        case Command::activate:
            return "activate";
    }
    return "unknown command";
}

std::string_view name_of(RunState state) {
    switch (state) {
        case RunState::stopped:
            return "stopped";
        case RunState::waiting:
            return "waiting for the motor";
        case RunState::running:
            return "running";
        case RunState::holding:
            return "stopping the motor to hold";
        case RunState::held:
            return "held";
    }
    return "unknown";
}

std::string_view name_of_event(std::uint8_t event) {
    constexpr std::array<std::string_view, 33> kNames{"none",
                                                      "not started",
                                                      "stop command",
                                                      "link down",
                                                      "motor stuck",
                                                      "bad table",
                                                      "watchdog",
                                                      "enable lost",
                                                      "safe command",
                                                      "bad settings",
                                                      "bad run mark",
                                                      "GPIO lines missing",
                                                      "no store",
                                                      "user's port missing",
                                                      "",
                                                      "",
                                                      "started",
                                                      "held",
                                                      "breakpoint",
                                                      "forced",
                                                      "forces ended",
                                                      "link up",
                                                      "table activated",
                                                      "table stored",
                                                      "upload failed",
                                                      "settings kept",
                                                      "stored table or settings damaged",
                                                      "upload given up",
                                                      "the firmware gave up before this start",
                                                      "it was at this code address",
                                                      "",
                                                      "",
                                                      "the drive's fault"};
    if (event >= kNames.size() || kNames[event].empty()) return "unknown";
    return kNames[event];
}

std::string_view name_of_motor_fault(std::uint16_t number) {
    constexpr std::array<std::string_view, 12> kNames{
        "none",
        "it does not answer",
        "it started anew by itself",
        "tripped: its power is off until \"reset error\"",
        "an end-stop ended its motion",
        "it stands, and not where it was sent",
        "it refused a command",
        "nobody knows whether it took a command",
        "an order that it cannot do",
        "its answers cannot be read",
        "several drives answer to its address",
        "its position jumped in mid-motion: another master, or a hand; find the origin again"};
    return number < kNames.size() ? kNames[number] : "unknown";
}

std::string_view held_remark(const Status& status) {
    if (!status.has(registers::gateway::kCannotGoOn)) return {};
    return ", cannot go on from here: the motor cannot take up again what it did; `nanoctl stop`, then "
           "`nanoctl run`";
}

std::string_view name_of_link(std::uint32_t link) {
    constexpr std::array<std::string_view, 4> kNames{"down", "starting", "not acknowledged", "up"};
    return link < kNames.size() ? kNames[link] : "unknown";
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
