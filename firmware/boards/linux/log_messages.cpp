#include "log_messages.h"

#include <fmt/format.h>

#include "gateway/outcome.h"

namespace nplc::boards {
namespace {

using gateway::Event;
using gateway::SafeReason;

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
        case SafeReason::bad_settings:
            return {
                LogLevel::error,
                "SAFE: the stored settings are damaged or gone; look at those in use with `nanoctl settings "
                "list`, set and keep them, then `nanoctl run`"};
        case SafeReason::bad_run_mark:
            return {
                LogLevel::error,
                "SAFE: nobody knows whether the last run ended in order: the file `running` in the axis's "
                "folder is damaged, missing, or cannot be written; look at the machine, then `nanoctl run`"};
        case SafeReason::safe_command:
            return {LogLevel::warning, fmt::format("SAFE: told to be, in step {}", step)};
        case SafeReason::no_lines:
            return {LogLevel::error, "SAFE: GPIO lines are missing; it cannot run without them"};
        case SafeReason::no_store:
            return {LogLevel::error, "SAFE: the store is missing; it does not run without its settings"};
        case SafeReason::no_port:
            return {LogLevel::error,
                    "SAFE: the user's port is missing; it does not run where nobody can stop it"};
        case SafeReason::no_proof:
            return {
                LogLevel::error,
                "SAFE: the table has no certificate, and setting require_proof asks for one; prove it with "
                "`seqc verify --proof`, then `nanoctl upload --proof`"};
    }
    return {LogLevel::error, "SAFE: for an unknown reason"};
}

}  // namespace

LogMessage in_words(const gateway::EventLog::Entry& entry) {
    if (entry.event < 16) return of_reason(static_cast<SafeReason>(entry.event), entry.step);
    const char* const remark =
        entry.detail == 1 ? "; the motor cannot take up again what it did: stop, then run from the start"
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
                    "a stored table or the stored settings are damaged; upload, or set and keep, again"};
        case Event::gave_up:
            return {LogLevel::error,
                    fmt::format("the firmware gave up before this start, cause {}", entry.detail)};
        case Event::gave_up_at:
            return {LogLevel::error, fmt::format("it gave up at code address {}", entry.detail)};
        case Event::motor_fault:
            return {LogLevel::debug, fmt::format("the driver's fault {}", entry.detail)};
        case Event::upload_given_up:
            return {LogLevel::warning, fmt::format("an upload was given up after {} bytes", entry.detail)};
    }
    return {LogLevel::warning, fmt::format("event {}", entry.event)};
}

}  // namespace nplc::boards
