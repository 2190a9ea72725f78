// Effects of writes to the gateway's own registers.
#include <algorithm>

#include "base/bytes.h"
#include "gateway/gateway_registers.h"

namespace nplc::gateway {

using namespace registers::gateway;

namespace {

/// For room in the store while it erases a block.
constexpr base::Microseconds kLongestWait{1'000'000};

CommandResult command_result_of(const base::Status& status) {
    return {status ? Result::done : result_of(status.error())};
}

struct Numbers {
    std::uint8_t first;
    std::uint8_t last;
};

/// The registers that there are, below the settings.
constexpr std::array<Numbers, 5> kKnown{{
    {IDENTITY, STOP_SINCE},
    {UPLOAD_STATE, PROOF + kProofWords - 1},
    {FIRED_SCAN, SetPointsPart::kIsThere ? SET_POINT_DATA : FIRED_KEY},
    {FIRED, SetPointsPart::kIsThere ? SET_POINT_WANTED + kSetPoints - 1 : LOG + 2 * kLogEntries - 1},
    {FIRMWARE_BOARD, FirmwarePart::kIsThere ? FIRMWARE_DATA - 1 : FIRMWARE_BOARD - 1},
}};

bool is_known(std::uint8_t number) {
    for (const Numbers& known : kKnown) {
        if (number >= known.first && number <= known.last) return true;
    }
    return false;
}

}  // namespace

void GatewayRegisters::poll() {
    tables_.poll();
    settings_.poll();
    set_points_.poll();
    if constexpr (kHasFirmware) firmware_.poll(gateway_.uptime(), port_.messages != 0);
}

base::Instant GatewayRegisters::next_poll(base::Instant now) {
    base::Instant next = std::min(tables_.next_poll(now), settings_.next_poll(now));
    if (kHasSetPoints) next = std::min(next, set_points_.next_poll(now));
    switch (waiting_) {
        case Waiting::nothing:
        case Waiting::saving:
            break;
        case Waiting::mark:
            return gateway_.wants_mark() ? next : now;
        case Waiting::room:
            return std::min(next, write_begun_ + kLongestWait + base::Microseconds(1));
        case Waiting::activation:
        case Waiting::reset:
            return std::min(next, tables_.next_activation(now));
    }
    return next;
}

void GatewayRegisters::begin_write(std::uint8_t reg, std::span<const std::uint8_t> bytes, base::Instant now) {
    drop_write();
    written_ = reg;
    ++writes_begun_;
    write_begun_ = now;
    outcome_ = write(reg, bytes, now);
}

void GatewayRegisters::drop_write() {
    if (waiting_ == Waiting::activation || waiting_ == Waiting::reset) tables_.drop_activation();
    waiting_ = Waiting::nothing;
}

PendingResult GatewayRegisters::poll_write(std::span<const std::uint8_t> bytes, base::Instant now) {
    if (!outcome_) outcome_ = continue_write(bytes, now);
    if (!outcome_) return std::nullopt;
    waiting_ = Waiting::nothing;
    result_ = outcome_.word() | (std::uint32_t{written_} << 8);
    return outcome_;
}

PendingResult GatewayRegisters::serve_set_points(SetPointsPart::Writer& writer,
                                                 std::span<const std::uint8_t> bytes, base::Instant now) {
    const PendingResult outcome = set_points_.serve(writer, bytes, now);
    if (outcome) result_ = outcome.word() | (std::uint32_t{SET_POINT_WRITE} << 8);
    return outcome;
}

PendingResult GatewayRegisters::continue_write(std::span<const std::uint8_t> bytes, base::Instant now) {
    switch (waiting_) {
        case Waiting::room:
            if (now - write_begun_ > kLongestWait) return CommandResult{Result::busy};
            return kHasFirmware && written_ == FIRMWARE_DATA ? write_firmware(bytes) : write_table(bytes);
        case Waiting::activation:
            return tables_.poll_activation(now);
        case Waiting::reset: {
            const PendingResult active = tables_.poll_activation(now);
            reset_asked_ = active.is_done();
            return active;
        }
        case Waiting::saving:
            return settings_.poll_save();
        case Waiting::mark:
            if (gateway_.wants_mark()) return std::nullopt;
            return CommandResult{gateway_.is_mark_refused() ? Result::storage_failed : Result::done};
        case Waiting::nothing:
            break;
    }
    return CommandResult{Result::busy};
}

PendingResult GatewayRegisters::write(std::uint8_t reg, std::span<const std::uint8_t> bytes,
                                      base::Instant now) {
    if (reg == TABLE_DATA) return bytes.size() < 4 ? CommandResult{Result::bad_length} : write_table(bytes);
    if (kHasFirmware && reg == FIRMWARE_DATA) return write_firmware(bytes);
    const bool is_request = kHasSetPoints && reg == SET_POINT_WRITE;
    if (is_request || (bytes.size() != 2 && bytes.size() != 4)) return CommandResult{Result::bad_length};
    const std::uint32_t value =
        bytes.size() == 2 ? base::load_u16(bytes.data()) : base::load_u32(bytes.data());
    return write_value(reg, value, now);
}

PendingResult GatewayRegisters::write_value(std::uint8_t reg, std::uint32_t value, base::Instant now) {
    constexpr std::uint64_t kLow = 0xFFFF'FFFF;
    switch (reg) {
        case SCAN_WORST:
            gateway_.clear_worst();
            return CommandResult{};
        case FORCE_LEFT:
            gateway_.renew_forces(now);
            return CommandResult{};
        case COMMAND:
            return command(value, now);
        case FORCE_IN:
        case FORCE_OUT:
            return CommandResult{force(reg, value, now)};
        case BREAK_LOW:
            gateway_.set_breakpoints((gateway_.breakpoints() & ~kLow) | value);
            return CommandResult{};
        case BREAK_HIGH:
            if ((value >> 31) != 0) return CommandResult{Result::bad_value};
            gateway_.set_breakpoints((gateway_.breakpoints() & kLow) | (std::uint64_t{value} << 32));
            return CommandResult{};
        case UPLOAD_BYTES:
            upload_bytes_ = value;
            return CommandResult{};
        case UPLOAD_CRC:
            upload_crc_ = value;
            return CommandResult{};
        case TABLE_POINTER:
            if (value > tables_.capacity()) return CommandResult{Result::bad_value};
            pointer_ = value;
            return CommandResult{};
        case SET_POINT_POINTER:
            if (!kHasSetPoints) break;
            set_points_.point_at(value);
            return CommandResult{};
        default:
            break;
    }
    if (reg >= SETTINGS)
        return CommandResult{settings_.set(static_cast<std::uint8_t>(reg - SETTINGS), value)};
    return CommandResult{is_known(reg) ? Result::read_only : Result::no_register};
}

Result GatewayRegisters::force(std::uint8_t reg, std::uint32_t value, base::Instant now) {
    const std::uint32_t pins = reg == FORCE_IN ? 0x3F : 0x0F;
    if ((value & ~(pins | (pins << 8))) != 0) return Result::bad_value;
    const Force forced = Force::of_register(value);
    if (reg == FORCE_IN) {
        gateway_.force_inputs(forced, now);
    } else {
        gateway_.force_outputs(forced, now);
    }
    return Result::done;
}

PendingResult GatewayRegisters::command(std::uint32_t value, base::Instant now) {
    last_command_ = value;
    if (value > 0xFF) return CommandResult{Result::bad_value};
    const auto command = static_cast<Command>(value);
    switch (command) {
        case Command::run:
            return started(gateway_.run());
        case Command::scan:
            return started(gateway_.scan_once());
        case Command::step:
            return started(gateway_.step_once());
        case Command::hold:
            return CommandResult{gateway_.hold() ? Result::done : Result::not_running};
        case Command::stop:
            gateway_.stop(now);
            return CommandResult{};
        case Command::safe:
            tables_.abandon_upload();
            gateway_.enter_safe_state_by_command(now);
            return CommandResult{};
        case Command::give_up_stop:
            gateway_.give_up_stop();
            return CommandResult{};
        case Command::clear_log:
            gateway_.clear_log();
            return CommandResult{};
        case Command::reset:
            return reset(now);
        case Command::keep_settings:
            if (gateway_.run_state() != gateway::RunState::stopped) return CommandResult{Result::not_stopped};
            settings_.begin_save();
            waiting_ = Waiting::saving;
            return std::nullopt;
        case Command::upload_begin:
        case Command::upload_commit:
        case Command::upload_abort:
        case Command::activate:
            return table_command(command, now);
        case Command::firmware_begin:
        case Command::firmware_commit:
        case Command::firmware_abort:
            if constexpr (kHasFirmware) return firmware_command(command);
            break;
    }
    return CommandResult{Result::bad_value};
}

/// In service, where it is refused, it is marked for the next start.
PendingResult GatewayRegisters::started(const base::Status& status) {
    if (!gateway_.needs_mark() || !(status.ok() || gateway_.is_in_service()))
        return command_result_of(status);
    settings_.begin_mark();
    if (!status) return command_result_of(status);
    waiting_ = Waiting::mark;
    return std::nullopt;
}

/// The board may halt during an erasure: only while nothing can run.
CommandResult GatewayRegisters::firmware_command(Command command) {
    if (command == Command::firmware_abort) return firmware_.abandon();
    if (command == Command::firmware_commit)
        return gateway_.is_in_service() ? firmware_.commit(upload_bytes_, upload_crc_)
                                        : Result::not_in_service;
    if (gateway_.run_state() != gateway::RunState::stopped) return Result::not_stopped;
    const Result begun = firmware_.begin(upload_bytes_);
    if (begun == Result::done) gateway_.begin_service();
    return begun;
}

PendingResult GatewayRegisters::write_firmware(std::span<const std::uint8_t> bytes) {
    const Result result = firmware_.write(bytes);
    if (result != Result::busy) return CommandResult{result};
    waiting_ = Waiting::room;
    return std::nullopt;
}

/// After a reset the stored table becomes the active one, which is allowed only while the motor stands still.
PendingResult GatewayRegisters::reset(base::Instant now) {
    if (gateway_.run_state() != gateway::RunState::stopped) return CommandResult{Result::not_stopped};
    if (tables_.stored().length != 0 && !tables_.stored_is_active()) {
        tables_.begin_activation(now);
        waiting_ = Waiting::reset;
        return std::nullopt;
    }
    reset_asked_ = true;
    return CommandResult{};
}

PendingResult GatewayRegisters::table_command(Command command, base::Instant now) {
    switch (command) {
        case Command::upload_begin:
            pointer_ = 0;
            return command_result_of(tables_.begin_upload());
        case Command::upload_commit:
            return command_result_of(tables_.commit(upload_bytes_, upload_crc_));
        case Command::upload_abort:
            tables_.abandon_upload();
            return CommandResult{};
        default:
            break;
    }
    if (gateway_.run_state() != gateway::RunState::stopped) return CommandResult{Result::not_stopped};
    tables_.begin_activation(now);
    waiting_ = Waiting::activation;
    return std::nullopt;
}

PendingResult GatewayRegisters::write_table(std::span<const std::uint8_t> bytes) {
    if (pointer_ + bytes.size() > tables_.capacity()) return CommandResult{Result::no_space};
    const base::Status status = tables_.upload(pointer_, bytes);
    if (!status && status.error() == base::Error::busy) {
        waiting_ = Waiting::room;
        return std::nullopt;
    }
    if (status) pointer_ += static_cast<std::uint32_t>(bytes.size());
    return command_result_of(status);
}

}  // namespace nplc::gateway
