#include "log_messages.h"

#include <fmt/format.h>

#include "gateway/command_result.h"

namespace nplc::boards {
namespace {

using gateway::Event;
using gateway::SafeReason;

/// Message for a missing required resource.
LogMessage of_missing(SafeReason reason) {
    if (reason == SafeReason::no_lines)
        return {LogLevel::error, "SAFE: GPIO lines are missing; it cannot run without them"};
    if (reason == SafeReason::no_store)
        return {LogLevel::error,
                "SAFE: the store cannot be had, as said above; it does not run without its settings"};
    return {LogLevel::error,
            "SAFE: the user's port is missing; it does not run, since no client could stop it"};
}

LogMessage of_reason(SafeReason reason, unsigned step) {
    switch (reason) {
        case SafeReason::none:
            return {LogLevel::info, "runs"};
        case SafeReason::not_started:
            return {LogLevel::info, "outputs safe: the sequence has not been started"};
        case SafeReason::stop_command:
            return {LogLevel::notice, fmt::format("stopped by command in step {}; outputs safe", step)};
        case SafeReason::link_down:
            return {LogLevel::error,
                    fmt::format("SAFE: the motor does not answer (step {}); outputs are safe until the "
                                "link is back and the sequence has sent \"reset error\"; look at the "
                                "motor's supply and its line",
                                step)};
        case SafeReason::motor_stuck:
            return {LogLevel::error,
                    fmt::format("SAFE: a scan of step {} waited too long for the motor; start again with "
                                "`nanoctl run` when the motor is in order",
                                step)};
        case SafeReason::bad_table:
            return {LogLevel::error,
                    "SAFE: no table that is whole and for this motor; upload one with `nanoctl upload`"};
        case SafeReason::watchdog:
            return {LogLevel::error,
                    "SAFE: the last run did not end in order (killed, crashed, or reset by a watchdog); the "
                    "sequence waits for `nanoctl run`"};
        case SafeReason::enable_lost:
            return {
                LogLevel::warning,
                fmt::format("SAFE: the enable input is off (step {}); start again with `nanoctl run`", step)};
        case SafeReason::bad_set_points:
            return {LogLevel::error,
                    "SAFE: stored set-points are damaged; set them anew, then `nanoctl run`"};
        case SafeReason::bad_settings:
            return {
                LogLevel::error,
                "SAFE: the stored settings are damaged or gone; look at those in use with `nanoctl settings "
                "list`, set and keep them, then `nanoctl run`"};
        case SafeReason::bad_run_mark:
            return {LogLevel::error,
                    "SAFE: nobody knows whether the last run ended in order: the file `running` or "
                    "`store.bin` in the "
                    "axis's folder is damaged, was lost, or cannot be written; look at the machine, then "
                    "`nanoctl "
                    "run`"};
        case SafeReason::safe_command:
            return {LogLevel::warning, fmt::format("SAFE: told to be, in step {}", step)};
        case SafeReason::no_lines:
        case SafeReason::no_store:
        case SafeReason::no_port:
            return of_missing(reason);
        case SafeReason::no_proof:
            return {
                LogLevel::error,
                "SAFE: the table has no certificate, and setting require_proof asks for one; prove it with "
                "`seqc verify --proof`, then `nanoctl upload --proof`"};
    }
    return {LogLevel::error, "SAFE: for an unknown reason"};
}

std::string by_whom(std::uint16_t detail) {
    return std::string(registers::gateway::name_of(static_cast<registers::gateway::Origin>(detail >> 8)));
}

LogMessage of_late_poll(std::uint16_t milliseconds) {
    return {LogLevel::warning,
            fmt::format("polled {} ms late, beyond the setting poll_limit; give the service real-time "
                        "priority, or the machine less to do",
                        milliseconds)};
}

/// AxisReporter adds the names and the old and new values.
LogMessage of_set_points(Event event, std::uint16_t detail) {
    const unsigned number = detail & 0xFF;
    switch (event) {
        case Event::set_points_changed:
            return {LogLevel::notice, fmt::format("set-points: {} set over {}", number, by_whom(detail))};
        case Event::set_points_taken:
            return {LogLevel::notice, fmt::format("set-points: the sequence goes by {} changed one{} now",
                                                  detail, detail == 1 ? "" : "s")};
        case Event::set_points_dropped:
            return {LogLevel::warning,
                    "set-points: with their defaults, because what was kept has another name, unit or range"};
        case Event::recipe_loaded:
            return {LogLevel::notice, fmt::format("recipe {} loaded over {}", number, by_whom(detail))};
        case Event::recipe_saved:
            return {LogLevel::notice, fmt::format("recipe {} saved over {}", number, by_whom(detail))};
        case Event::recipe_deleted:
            return {LogLevel::notice, fmt::format("recipe {} deleted over {}", number, by_whom(detail))};
        default:
            return {LogLevel::warning, fmt::format("event {}", static_cast<unsigned>(event))};
    }
}

}  // namespace

EventKey event_of(const gateway::EventLog::Entry& entry) {
    const std::string key(registers::gateway::key_of_log_code(entry.event));
    return EventKey(key.empty() ? std::to_string(entry.event) : key);
}

JournalFields fields_of(const gateway::EventLog::Entry& entry) {
    constexpr std::uint8_t kFirstEvent = static_cast<std::uint8_t>(Event::started);
    JournalFields fields{{"STEP", std::to_string(entry.step)}};
    if (entry.event < kFirstEvent && entry.event != 0) fields.push_back({"CAUSE", event_of(entry).text});
    if (entry.detail != 0) fields.push_back({"DETAIL", std::to_string(entry.detail)});
    return fields;
}

LogMessage in_words(const gateway::EventLog::Entry& entry) {
    if (entry.event < 16) return of_reason(static_cast<SafeReason>(entry.event), entry.step);
    const char* const remark =
        entry.detail == 1
            ? "; it cannot go on from there: the motor cannot take up again what it did, or orders that "
              "waited for it for longer than 500 ms were dropped; stop, then run from the start"
            : "";
    switch (static_cast<Event>(entry.event)) {
        case Event::started:
            return {LogLevel::notice, "the sequence runs"};
        case Event::held:
            return {LogLevel::notice, fmt::format("held in step {}{}", entry.step, remark)};
        case Event::breakpoint:
            return {LogLevel::notice, fmt::format("held by a breakpoint at step {}{}", entry.step, remark)};
        case Event::forced:
            return {LogLevel::warning, "signals are forced over the user's port"};
        case Event::forces_ended:
            return {LogLevel::notice,
                    entry.detail == 1 ? "forcing has ended: its client is silent" : "forcing has ended"};
        case Event::stop_confirmed:
            return {LogLevel::notice, fmt::format("the motor confirmed the stop after {} ms", entry.detail)};
        case Event::link_up:
            return {LogLevel::notice, "the link is up and acknowledged; outputs are the sequence's again"};
        case Event::table_activated:
            return {LogLevel::notice, "the stored table is the active one"};
        case Event::table_stored:
            return {LogLevel::notice, "a new table is stored"};
        case Event::upload_failed:
            return {LogLevel::error,
                    fmt::format("an upload failed: {}",
                                registers::gateway::describe(static_cast<gateway::Result>(entry.detail)))};
        case Event::settings_kept:
            return {LogLevel::notice, "the settings are stored"};
        case Event::store_damaged:
            return {LogLevel::error,
                    "a stored table, the stored settings or set-points are damaged; upload, or set and keep, "
                    "again"};
        case Event::crashed:
            return {LogLevel::error,
                    fmt::format("the firmware crashed before this start, cause {}", entry.detail)};
        case Event::crashed_at:
            return {LogLevel::error, fmt::format("it crashed at code address {}", entry.detail)};
        case Event::polled_late:
            return of_late_poll(entry.detail);
        case Event::line_late:
            return {LogLevel::debug, fmt::format("the motor's line is {} ms late", entry.detail)};
        case Event::motor_fault:
            return {LogLevel::debug, fmt::format("the driver's fault {}", entry.detail)};
        case Event::set_points_changed:
        case Event::set_points_taken:
        case Event::set_points_dropped:
        case Event::recipe_loaded:
        case Event::recipe_saved:
        case Event::recipe_deleted:
            return of_set_points(static_cast<Event>(entry.event), entry.detail);
        case Event::upload_aborted:
            return {LogLevel::warning, fmt::format("an upload was aborted after {} bytes", entry.detail)};
    }
    return {LogLevel::warning, fmt::format("event {}", entry.event)};
}

}  // namespace nplc::boards
