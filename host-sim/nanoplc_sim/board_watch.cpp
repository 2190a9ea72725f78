#include "board_watch.h"

#include <fmt/format.h>

#include <string_view>
#include <utility>

namespace nplc::sim {
namespace {

/// A connected motor has answered by then.
constexpr Time kLongestStart = std::chrono::seconds{1};

std::string_view outputs_by(gateway::SafeReason reason) {
    switch (reason) {
        case gateway::SafeReason::none:
            return "outputs follow the sequence";
        case gateway::SafeReason::not_started:
            return "outputs safe: not started";
        case gateway::SafeReason::stop_command:
            return "outputs safe: stop command";
        case gateway::SafeReason::link_down:
            return "outputs safe: link to the motor down";
        case gateway::SafeReason::motor_stuck:
            return "outputs safe: the motor does not finish its orders";
        case gateway::SafeReason::bad_table:
            return "outputs safe: bad table";
        case gateway::SafeReason::watchdog:
            return "outputs safe: watchdog reset";
        case gateway::SafeReason::enable_lost:
            return "outputs safe: enable lost";
        case gateway::SafeReason::bad_set_points:
            return "outputs safe: the stored set-points are damaged";
        case gateway::SafeReason::bad_settings:
            return "outputs safe: the stored settings are damaged";
        case gateway::SafeReason::bad_run_mark:
            return "outputs safe: the mark of the last run is damaged";
        case gateway::SafeReason::safe_command:
            return "outputs safe: the user's command";
        case gateway::SafeReason::no_lines:
        case gateway::SafeReason::no_store:
        case gateway::SafeReason::no_port:
            return "outputs safe: the board lacks something";
        case gateway::SafeReason::no_proof:
            return "outputs safe: the table has no certificate";
    }
    return "";
}

}  // namespace

void BoardWatch::look() {
    if (const auto reason = world_.gateway().safe_reason(); reason != reason_) {
        reason_ = reason;
        timeline_.remark(std::string(outputs_by(reason)));
    }
    if (const std::string note = world_.motor_note(); note != motor_note_) {
        motor_note_ = note;
        if (!note.empty()) timeline_.alarm(fmt::format("motor: {}", note));
    }
    const gateway::Gateway& gateway = world_.gateway();
    const bool waits = gateway.run_state() == gateway::RunState::waiting_for_motor && gateway.scans() == 0;
    if (!waits) {
        waiting_since_.reset();
    } else if (!waiting_since_) {
        waiting_since_ = world_.now();
    }
    const bool is_said = std::exchange(said_that_it_waits_, waits_for_motor());
    if (said_that_it_waits_ && !is_said) {
        timeline_.alarm(
            "the gateway waits for the motor, which does not answer: no step begins before it does");
    }
    if (const auto bites = world_.board().bites(); bites != bites_) {
        bites_ = bites;
        timeline_.alarm("the watchdog resets the gateway");
    }
}

bool BoardWatch::waits_for_motor() const {
    return waiting_since_ && world_.now() - *waiting_since_ >= kLongestStart;
}

}  // namespace nplc::sim
