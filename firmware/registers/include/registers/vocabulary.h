#pragma once

#include <cstdint>
#include <initializer_list>
#include <string_view>

/// The values of the gateway's registers, each with the text that programs print for it. Used by firmware,
/// tools and simulator; described in firmware/gateway/REGISTERS.md.
namespace nplc::registers::gateway {

template <class Value>
struct Word {
    Value value;
    std::string_view text;
};

/// The value's text, or `otherwise` for an unknown number.
template <class Value>
constexpr std::string_view word_of(Value value, std::initializer_list<Word<Value>> words,
                                   std::string_view otherwise = "unknown") {
    for (const Word<Value>& word : words) {
        if (word.value == value) return word.text;
    }
    return otherwise;
}

/// Bits 2..0 of STATUS.
enum class RunState : std::uint8_t {
    stopped = 0,            ///< no table, not started, or in the safe state after a reason that needs a start
    waiting_for_motor = 1,  ///< started; the link is not up yet, or the stop order is not executed yet
    running = 2,
    holding = 3,  ///< its last orders are being executed, then the motor is being stopped, to be held
    held = 4,     ///< between two scans, until it is continued
};

constexpr std::string_view name_of(RunState state) {
    using enum RunState;
    return word_of<RunState>(state, {{stopped, "stopped"},
                                     {waiting_for_motor, "waiting for the motor"},
                                     {running, "running"},
                                     {holding, "stopping the motor to hold"},
                                     {held, "held"}});
}

/// SAFE_REASON: why the outputs have their safe values (and the motor was told to stop, if the line works).
/// Also in the log's entries, below the codes of Event.
enum class SafeReason : std::uint8_t {
    none = 0,
    not_started = 1,
    stop_command = 2,
    link_down = 3,    ///< ends when the link is up again and the sequence has sent "reset error"
    motor_stuck = 4,  ///< a scan waited longer than setting longest_wait
    bad_table = 5,
    watchdog = 6,
    enable_lost = 7,
    safe_command = 8,
    bad_settings = 9,   ///< the stored ones are damaged: nothing runs until settings are kept
    bad_run_mark = 10,  ///< the run marker is damaged, missing, or cannot be written
    no_lines = 11,      ///< 11 to 13: a required resource of the axis is missing and is retried
    no_store = 12,
    no_port = 13,         ///< the user port
    no_proof = 14,        ///< the table has no certificate, and setting require_proof requires one
    bad_set_points = 15,  ///< the stored values are damaged: older ones or defaults are used
};

constexpr std::string_view name_of(SafeReason reason) {
    using enum SafeReason;
    return word_of<SafeReason>(reason, {{none, "none"},
                                        {not_started, "not started"},
                                        {stop_command, "stop command"},
                                        {link_down, "link down"},
                                        {motor_stuck, "motor stuck"},
                                        {bad_table, "bad table"},
                                        {watchdog, "watchdog"},
                                        {enable_lost, "enable lost"},
                                        {safe_command, "safe command"},
                                        {bad_settings, "bad settings"},
                                        {bad_run_mark, "bad run mark"},
                                        {no_lines, "GPIO lines missing"},
                                        {no_store, "no store"},
                                        {no_port, "user's port missing"},
                                        {no_proof, "no certificate"},
                                        {bad_set_points, "bad set-points"}});
}

/// Bits 7..0 of a log entry's second register; below 16 they are a SafeReason.
enum class Event : std::uint8_t {
    started = 16,
    held = 17,
    breakpoint = 18,
    forced = 19,
    forces_ended = 20,
    link_up = 21,
    table_activated = 22,
    table_stored = 23,
    upload_failed = 24,
    settings_kept = 25,
    store_damaged = 26,
    upload_aborted = 27,
    crashed = 28,
    crashed_at = 29,
    polled_late = 30,     ///< later than setting poll_limit; detail: milliseconds
    stop_confirmed = 31,  ///< by the motor; detail: milliseconds since the stop was requested
    motor_fault = 32,
    set_points_changed = 33,  ///< detail: number in bits 7..0, origin (Origin) in bits 15..8
    set_points_taken = 34,    ///< now in force; detail: number
    set_points_dropped = 35,  ///< detail: bit mask of those with their default because no stored value fits
    recipe_loaded = 36,       ///< 36 to 38: detail: its number in bits 7..0, origin in bits 15..8
    recipe_saved = 37,
    recipe_deleted = 38,
    line_late = 39,  ///< the motor's answers come too late for the link; detail: milliseconds
};

constexpr std::string_view name_of(Event event) {
    using enum Event;
    return word_of<Event>(event, {{started, "started"},
                                  {held, "held"},
                                  {breakpoint, "breakpoint"},
                                  {forced, "forced"},
                                  {forces_ended, "forces ended"},
                                  {link_up, "link up"},
                                  {table_activated, "table activated"},
                                  {table_stored, "table stored"},
                                  {upload_failed, "upload failed"},
                                  {settings_kept, "settings kept"},
                                  {store_damaged, "stored table or settings damaged"},
                                  {upload_aborted, "upload aborted"},
                                  {crashed, "the firmware crashed before this start"},
                                  {crashed_at, "it was at this code address"},
                                  {polled_late, "polled too late"},
                                  {stop_confirmed, "stop confirmed by the motor"},
                                  {motor_fault, "the drive's fault"},
                                  {set_points_changed, "set-points changed"},
                                  {set_points_taken, "set-points taken"},
                                  {set_points_dropped, "set-points fell back to their defaults"},
                                  {recipe_loaded, "recipe loaded"},
                                  {recipe_saved, "recipe saved"},
                                  {recipe_deleted, "recipe deleted"},
                                  {line_late, "the motor's line is too late"}});
}

/// For bits 7..0 of a log entry's second register.
constexpr std::string_view name_of_log_code(std::uint8_t code) {
    constexpr std::uint8_t kFirstEvent = 16;
    return code < kFirstEvent ? name_of(static_cast<SafeReason>(code)) : name_of(static_cast<Event>(code));
}

/// The same as a stable lower_case key for programs. Empty: no such code.
constexpr std::string_view key_of_log_code(std::uint8_t code) {
    constexpr std::string_view kKeys[]{"runs",
                                       "not_started",
                                       "stop_command",
                                       "link_down",
                                       "motor_stuck",
                                       "bad_table",
                                       "watchdog",
                                       "enable_lost",
                                       "safe_command",
                                       "bad_settings",
                                       "bad_run_mark",
                                       "no_lines",
                                       "no_store",
                                       "no_port",
                                       "no_proof",
                                       "bad_set_points",
                                       "started",
                                       "held",
                                       "breakpoint",
                                       "forced",
                                       "forces_ended",
                                       "link_up",
                                       "table_activated",
                                       "table_stored",
                                       "upload_failed",
                                       "settings_kept",
                                       "store_damaged",
                                       "upload_aborted",
                                       "crashed",
                                       "crashed_at",
                                       "polled_late",
                                       "stop_confirmed",
                                       "motor_fault",
                                       "set_points_changed",
                                       "set_points_taken",
                                       "set_points_dropped",
                                       "recipe_loaded",
                                       "recipe_saved",
                                       "recipe_deleted",
                                       "line_late"};
    return code < sizeof kKeys / sizeof *kKeys ? kKeys[code] : "";
}

/// Origin of a change of set-points.
enum class Origin : std::uint8_t { user_port = 1, panel = 2, modbus = 3, mqtt = 4, scenario = 5 };

constexpr std::string_view name_of(Origin origin) {
    using enum Origin;
    return word_of<Origin>(origin, {{user_port, "the user's port"},
                                    {panel, "the panel"},
                                    {modbus, "Modbus"},
                                    {mqtt, "MQTT"},
                                    {scenario, "the scenario"}});
}

/// Kinds of requests to SET_POINT_WRITE.
enum class SetPointRequest : std::uint8_t {
    change = 1,
    save_recipe = 2,  ///< the wanted values
    put_recipe = 3,   ///< the values of the request
    load_recipe = 4,
    delete_recipe = 5,
};

/// LINK: the line between gateway and motor.
enum class Link : std::uint8_t {
    down = 0,            ///< no answer; orders are discarded
    starting = 1,        ///< the drive answers and is being synchronized; orders are discarded
    unacknowledged = 2,  ///< works again after it was down; ERROR stays until "reset error" (01h) has been
                         ///< executed
    up = 3,
};

constexpr std::string_view name_of(Link link) {
    using enum Link;
    return word_of<Link>(
        link, {{down, "down"}, {starting, "starting"}, {unacknowledged, "not acknowledged"}, {up, "up"}});
}

/// Bits 7..0 of UPLOAD_STATE: phase of a write into the store.
enum class StorePhase : std::uint8_t {
    idle = 0,
    erasing = 1,    ///< begun; pieces are accepted soon
    receiving = 2,  ///< accepts pieces
    closing = 3,    ///< programs the rest, reads everything back, checks it, makes it the current one
    done = 4,       ///< the written data are the current content
    failed = 5,     ///< nothing has changed
};

/// The detail of Event::motor_fault: why the driver of a MIDI drive reports ERROR.
enum class DriveFault : std::uint8_t {
    none = 0,
    link_lost = 1,    ///< no readable answer
    restarted = 2,    ///< the drive restarted by itself
    tripped = 3,      ///< the drive's own fault: its power is off until "reset error"
    end_stop = 4,     ///< stopped by an end-stop on its way
    not_arrived = 5,  ///< at standstill elsewhere than commanded; or a run has ended by itself
    refused = 6,      ///< the drive refused a command
    unclear = 7,      ///< unknown whether the drive executed a command; it was told to stop
    bad_value = 8,    ///< an order that proved impossible for the drive only at run time
    unreadable = 9,   ///< all answers were damaged
    several = 10,     ///< more than one drive answers to the address
    jumped = 11,      ///< the position changed in motion in a way that does not fit it
};

constexpr std::string_view name_of(DriveFault fault) {
    using enum DriveFault;
    return word_of<DriveFault>(
        fault,
        {{none, "none"},
         {link_lost, "it does not answer"},
         {restarted, "it started anew by itself"},
         {tripped, "tripped: its power is off until \"reset error\""},
         {end_stop, "an end-stop ended its motion"},
         {not_arrived, "it stands, and not where it was sent"},
         {refused, "it refused a command"},
         {unclear, "unknown whether it took a command"},
         {bad_value, "an order that it cannot do"},
         {unreadable, "its answers cannot be read"},
         {several, "several drives answer to its address"},
         {jumped,
          "its position jumped in mid-motion: a load that drags it, another master, or a hand; find the "
          "origin again"}});
}

/// Values of COMMAND.
enum class Command : std::uint8_t {
    run = 1,
    stop = 2,
    safe = 3,
    scan = 4,
    step = 5,
    hold = 6,
    reset = 7,
    keep_settings = 8,
    clear_log = 9,
    give_up_stop = 10,  ///< ends the repetition of an unconfirmed stop
    upload_begin = 16,
    upload_commit = 17,
    upload_abort = 18,
    activate = 19,
    firmware_begin = 24,
    firmware_commit = 25,
    firmware_abort = 26,
};

constexpr std::string_view name_of(Command command) {
    using enum Command;
    return word_of<Command>(command,
                            {{run, "run"},
                             {stop, "stop"},
                             {safe, "safe"},
                             {scan, "scan"},
                             {step, "step"},
                             {hold, "hold"},
                             {reset, "reset"},
                             {keep_settings, "keep_settings"},
                             {clear_log, "clear_log"},
                             {give_up_stop, "give_up_stop"},
                             {upload_begin, "upload_begin"},
                             {upload_commit, "upload_commit"},
                             {upload_abort, "upload_abort"},
                             {activate, "activate"},
                             {firmware_begin, "firmware_begin"},
                             {firmware_commit, "firmware_commit"},
                             {firmware_abort, "firmware_abort"}},
                            "unknown command");
}

/// Bits 7..0 of RESULT.
enum class Result : std::uint8_t {
    done = 0,
    no_register = 1,
    read_only = 2,
    bad_length = 3,
    bad_value = 4,
    not_stopped = 5,
    no_table = 6,
    moving = 7,
    not_allowed = 8,
    link_down = 9,
    busy = 10,
    no_upload = 11,
    bad_offset = 12,
    no_space = 13,
    wrong_check = 14,
    storage_failed = 15,
    nothing_stored = 16,
    not_running = 17,
    not_enabled = 18,
    too_late = 19,
    cannot_go_on = 20,
    no_proof = 21,
    seat_taken = 22,
    out_of_range = 23,
    wrong_unit = 24,
    other_table = 25,
    no_recipe = 26,
    other_recipe = 27,
    no_recipe_left = 28,
    interrupted = 29,
    no_password = 30,
    table_no_end = 32,
    table_ragged = 33,
    bad_next_step = 34,
    bad_register = 35,
    not_for_motor = 36,
    bad_set_points = 37,
    not_confirmed = 38,
    bad_firmware = 39,
    other_board = 40,
    not_newer = 41,
    not_in_service = 42,
    stop_unconfirmed = 43,
};

/// One-line message, "the sequence is not stopped; stop it first".
constexpr std::string_view describe(Result result) {
    using enum Result;
    return word_of<Result>(
        result,
        {{done, "done"},
         {no_register, "the gateway has no such register"},
         {read_only, "the register can only be read"},
         {bad_length, "a register takes 2 or 4 bytes, the table window 4 to 128"},
         {bad_value, "the value is not one of the register's"},
         {not_stopped, "the sequence is not stopped; stop it first"},
         {no_table, "there is no table; upload and activate one"},
         {moving, "the motor does not stand still; stop it first"},
         {not_allowed, "a setting does not allow this while the sequence runs"},
         {link_down, "the link to the motor is down; nobody knows whether it stands still"},
         {busy, "not now; try again"},
         {no_upload, "no upload was begun"},
         {bad_offset, "the piece does not follow what came before; look at UPLOAD_RECEIVED"},
         {no_space, "the table is too long"},
         {wrong_check, "length or check sum of the upload are not as announced"},
         {storage_failed, "the storage failed; what was stored before is unchanged"},
         {nothing_stored, "no table is stored, or it is damaged"},
         {not_running, "the sequence does not run"},
         {not_enabled,
          "the enable input is off (switch it on, then run), or the board was started for service, lacks "
          "something or has something damaged stored (see SAFE_REASON)"},
         {too_late,
          "it waited longer than 1 s to be read, or a stop came before it, and was not carried out"},
         {cannot_go_on,
          "the motor cannot take up again what it did before it was held (homing, gear, what somebody "
          "else told it), or the hold dropped orders that waited; stop, then run from the start"},
         {no_proof,
          "the table has no certificate, and setting require_proof asks for one; upload it with --proof"},
         {seat_taken,
          "another client operates, or operating is switched to where this one is not; only stop, safe and "
          "hold are taken"},
         {out_of_range, "a set-point is out of its range"},
         {wrong_unit, "a value has another unit than its set-point"},
         {other_table, "the set-points are not those of the table in use; read them anew"},
         {no_recipe, "there is no such recipe"},
         {other_recipe, "the recipe of this number has another name by now; read them anew"},
         {no_recipe_left, "all recipes are taken; delete one, or save under a name that is there"},
         {no_password,
          "this port takes changes only from who has given its password; give it with --password-file"},
         {interrupted, "the gateway restarted meanwhile; look whether it was stored"},
         {table_no_end, "the table has no end term"},
         {table_ragged, "the table ends inside a term"},
         {bad_next_step, "NEXT_STATE 3Fh in a term"},
         {bad_register, "register 0 in a term"},
         {not_for_motor, "the motor does not have an order of the table"},
         {bad_set_points, "the set-points that follow the table do not fit it; build and upload it anew"},
         {not_confirmed,
          "the firmware that runs is on trial, and the other slot is what it falls back to; wait until it is "
          "confirmed, or restart the board"},
         {bad_firmware, "that is no firmware for this slot, or a part of one"},
         {other_board, "the firmware is for another board"},
         {not_newer, "the firmware that runs is as new or newer"},
         {not_in_service, "only while the board is in service"},
         {stop_unconfirmed, "the motor has not confirmed the last stop; mend the line, or give it up"}},
        "unknown result");
}

/// FIRMWARE_STATE: the phase in bits 7..0, after a failure a Result in bits 15..8.
enum FirmwareBit : std::uint32_t {
    kFirmwareSlot = 1U << 16,       ///< the one that runs
    kFirmwareConfirmed = 1U << 17,  ///< the running one is confirmed
};

/// FIRMWARE_SLOT.
enum FirmwareSlotBit : std::uint32_t {
    kSlotComplete = 1U << 0,
    kSlotConfirmed = 1U << 1,
    kSlotTries = 0xFFU << 8,  ///< starts on trial
};

/// PASSWORD_STATE.
enum class PasswordState : std::uint8_t {
    none = 0,    ///< the port requires none
    wanted = 1,  ///< this client has not given it: only reads, stop, safe and hold are allowed
    given = 2,
};

/// Bits of OPERATOR.
enum OperatorBit : std::uint32_t {
    kOperatorWay = 0xFFU,            ///< an OperatorWay
    kOperatorIsYou = 1U << 8,        ///< this client, or another one of its user
    kOperatorTookFromYou = 1U << 9,  ///< it took over from this client
};
/// The operator's connection; it determines OPERATOR_PEER.
enum class OperatorWay : std::uint8_t {
    nobody = 0,
    unix_socket = 1,  ///< the user's number
    tcp = 2,          ///< the IPv4 address, its first number in bits 31..24
    terminal = 3,
    serial_line = 4,
    panel = 5,
    plant = 6,
    other = 7,
};
/// Details of seat_taken if a client has the seat.
constexpr std::uint16_t kSeatOfAnother = 0;
constexpr std::uint16_t kSeatTakenOver = 3;  ///< from this client
/// Values written to OPERATE.
enum class Operating : std::uint8_t { take = 1, take_over = 2, give_back = 3 };

/// Bits of STATUS.
enum StatusBit : std::uint32_t {
    kRunState = 7U << 0,  ///< a RunState
    kLinkDelivers = 1U << 3,
    kMotorError = 1U << 4,
    kInPosition = 1U << 5,
    kSafe = 1U << 6,
    kForcedInputs = 1U << 7,
    kForcedOutputs = 1U << 8,
    kBreakpoints = 1U << 9,
    kAtBreakpoint = 1U << 10,
    kTable = 1U << 11,
    kUpload = 1U << 12,
    kStoredDiffers = 1U << 13,
    kSettingsDiffer = 1U << 14,
    kEnabled = 1U << 15,
    kVirtualMotor = 1U << 16,
    kSingle = 1U << 17,
    kCannotGoOn = 1U << 18,
    kStopUnconfirmed = 1U << 19,  ///< the motor was told to stop and has not confirmed it: it may be moving
};

/// STORE_FLAGS. The last two only beside kFirstRunWanted, and on boards with files.
enum StoreFlag : std::uint32_t {
    kTableDamaged = 1U << 0,
    kSettingsDamaged = 1U << 1,
    kSetPointsDamaged = 1U << 2,
    kFirstRunWanted = 1U << 3,  ///< run was never commanded with this store
    kStoreLost = 1U << 4,       ///< the axis had another one
    kStoreOfAnother = 1U << 5,  ///< it is the store of another axis
};

constexpr RunState run_state_of(std::uint32_t status) {
    return static_cast<RunState>(status & kRunState);
}

/// FORCE_IN and FORCE_OUT: levels in bits 7..0, mask of forced signals in bits 15..8.
struct Force {
    std::uint8_t mask = 0;
    std::uint8_t levels = 0;

    static constexpr Force of_register(std::uint32_t value) {
        return {.mask = static_cast<std::uint8_t>(value >> 8), .levels = static_cast<std::uint8_t>(value)};
    }
    constexpr std::uint32_t in_register() const { return std::uint32_t{mask} << 8 | levels; }

    /// `real` with the forced levels applied.
    constexpr std::uint8_t over(std::uint8_t real) const {
        return static_cast<std::uint8_t>((real & ~unsigned{mask}) | (unsigned{levels} & mask));
    }
    bool operator==(const Force&) const = default;
};

}  // namespace nplc::registers::gateway
