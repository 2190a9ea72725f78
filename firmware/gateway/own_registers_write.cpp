// What a write to one of the gateway's own registers does.
#include <algorithm>

#include "base/bytes.h"
#include "gateway/own_registers.h"

namespace nplc::gateway {

using namespace registers::gateway;

namespace {

/// For room in the store while it erases a block, or for it to keep the settings.
constexpr base::Microseconds kLongestWait{1'000'000};

Outcome outcome_of(const base::Status& status) {
    return {status ? Result::done : result_of(status.error())};
}

}  // namespace

void OwnRegisters::poll() {
    tables_.poll();
    settings_.poll();
}

base::Instant OwnRegisters::next_poll(base::Instant now) {
    const base::Instant next = std::min(tables_.next_poll(now), settings_.next_poll(now));
    switch (waiting_) {
        case Waiting::nothing:
            break;
        case Waiting::room:
        case Waiting::saving:
            return std::min(next, write_begun_ + kLongestWait + base::Microseconds(1));
        case Waiting::activation:
        case Waiting::reset:
            return std::min(next, tables_.next_activation(now));
    }
    return next;
}

void OwnRegisters::begin_write(std::uint8_t reg, std::span<const std::uint8_t> bytes, base::Instant now) {
    drop_write();
    written_ = reg;
    write_begun_ = now;
    outcome_ = write(reg, bytes, now);
}

void OwnRegisters::drop_write() {
    if (waiting_ == Waiting::activation || waiting_ == Waiting::reset) tables_.drop_activation();
    waiting_ = Waiting::nothing;
}

Progress OwnRegisters::poll_write(std::span<const std::uint8_t> bytes, base::Instant now) {
    if (!outcome_) outcome_ = continue_write(bytes, now);
    if (!outcome_) return std::nullopt;
    waiting_ = Waiting::nothing;
    result_ = outcome_.word() | (std::uint32_t{written_} << 8);
    return outcome_;
}

Progress OwnRegisters::continue_write(std::span<const std::uint8_t> bytes, base::Instant now) {
    const bool late = now - write_begun_ > kLongestWait;
    switch (waiting_) {
        case Waiting::room:
            if (late) return Outcome{Result::busy};
            return write_table(bytes);
        case Waiting::activation:
            return tables_.poll_activation(now);
        case Waiting::reset: {
            const Progress active = tables_.poll_activation(now);
            reset_asked_ = active.is_done();
            return active;
        }
        case Waiting::saving:
            if (const Progress kept = settings_.poll_save()) return kept;
            if (late) return Outcome{Result::busy};
            return std::nullopt;
        case Waiting::nothing:
            break;
    }
    return Outcome{Result::busy};
}

Progress OwnRegisters::write(std::uint8_t reg, std::span<const std::uint8_t> bytes, base::Instant now) {
    if (reg == TABLE_DATA) return bytes.size() < 4 ? Outcome{Result::bad_length} : write_table(bytes);
    if (bytes.size() != 2 && bytes.size() != 4) return Outcome{Result::bad_length};
    const std::uint32_t value =
        bytes.size() == 2 ? base::load_u16(bytes.data()) : base::load_u32(bytes.data());
    return write_value(reg, value, now);
}

Progress OwnRegisters::write_value(std::uint8_t reg, std::uint32_t value, base::Instant now) {
    const auto is_known = [](std::uint8_t number) {
        return (number >= IDENTITY && number <= STORE_FLAGS) ||
               (number >= STATUS && number < LINE_FAULTS + kLines) ||
               (number >= UPLOAD_STATE && number < PROOF + kProofWords) ||
               (number >= FIRED_SCAN && number <= FIRED_KEY) ||
               (number >= FIRED && number < LOG + 2 * kLogEntries);
    };
    constexpr std::uint64_t kLow = 0xFFFF'FFFF;
    switch (reg) {
        case SCAN_WORST:
            gateway_.clear_worst_scan_time();
            return Outcome{};
        case FORCE_LEFT:
            gateway_.renew_forces(now);
            return Outcome{};
        case COMMAND:
            return command(value, now);
        case FORCE_IN:
        case FORCE_OUT:
            return Outcome{force(reg, value, now)};
        case BREAK_LOW:
            gateway_.set_breakpoints((gateway_.breakpoints() & ~kLow) | value);
            return Outcome{};
        case BREAK_HIGH:
            if ((value >> 31) != 0) return Outcome{Result::bad_value};
            gateway_.set_breakpoints((gateway_.breakpoints() & kLow) | (std::uint64_t{value} << 32));
            return Outcome{};
        case UPLOAD_BYTES:
            upload_bytes_ = value;
            return Outcome{};
        case UPLOAD_CRC:
            upload_crc_ = value;
            return Outcome{};
        case TABLE_POINTER:
            if (value > tables_.capacity()) return Outcome{Result::bad_value};
            pointer_ = value;
            return Outcome{};
        default:
            break;
    }
    if (reg >= SETTINGS) return Outcome{settings_.set(static_cast<std::uint8_t>(reg - SETTINGS), value)};
    return Outcome{is_known(reg) ? Result::read_only : Result::no_register};
}

Result OwnRegisters::force(std::uint8_t reg, std::uint32_t value, base::Instant now) {
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

Progress OwnRegisters::command(std::uint32_t value, base::Instant now) {
    last_command_ = value;
    if (value > 0xFF) return Outcome{Result::bad_value};
    const auto command = static_cast<Command>(value);
    switch (command) {
        case Command::run:
            return outcome_of(gateway_.run());
        case Command::scan:
            return outcome_of(gateway_.scan_once());
        case Command::step:
            return outcome_of(gateway_.step_once());
        case Command::hold:
            return Outcome{gateway_.hold() ? Result::done : Result::not_running};
        case Command::stop:
            gateway_.stop(now);
            return Outcome{};
        case Command::safe:
            tables_.abandon_upload();
            gateway_.make_safe(now);
            return Outcome{};
        case Command::clear_log:
            gateway_.clear_log();
            return Outcome{};
        case Command::reset:
            return reset(now);
        case Command::keep_settings:
            if (gateway_.run_state() != gateway::RunState::stopped) return Outcome{Result::not_stopped};
            settings_.begin_save();
            waiting_ = Waiting::saving;
            return std::nullopt;
        case Command::upload_begin:
        case Command::upload_commit:
        case Command::upload_abort:
        case Command::activate:
            return table_command(command, now);
    }
    return Outcome{Result::bad_value};
}

/// After it the stored table is the active one, which it becomes only while the motor stands still.
Progress OwnRegisters::reset(base::Instant now) {
    if (gateway_.run_state() != gateway::RunState::stopped) return Outcome{Result::not_stopped};
    if (tables_.stored().length != 0 && !tables_.stored_is_active()) {
        tables_.begin_activation(now);
        waiting_ = Waiting::reset;
        return std::nullopt;
    }
    reset_asked_ = true;
    return Outcome{};
}

Progress OwnRegisters::table_command(Command command, base::Instant now) {
    switch (command) {
        case Command::upload_begin:
            pointer_ = 0;
            return outcome_of(tables_.begin_upload());
        case Command::upload_commit:
            return outcome_of(tables_.commit(upload_bytes_, upload_crc_));
        case Command::upload_abort:
            tables_.abandon_upload();
            return Outcome{};
        default:
            break;
    }
    if (gateway_.run_state() != gateway::RunState::stopped) return Outcome{Result::not_stopped};
    tables_.begin_activation(now);
    waiting_ = Waiting::activation;
    return std::nullopt;
}

Progress OwnRegisters::write_table(std::span<const std::uint8_t> bytes) {
    if (pointer_ + bytes.size() > tables_.capacity()) return Outcome{Result::no_space};
    const base::Status status = tables_.upload(pointer_, bytes);
    if (!status && status.error() == base::Error::busy) {
        waiting_ = Waiting::room;
        return std::nullopt;
    }
    if (status) pointer_ += static_cast<std::uint32_t>(bytes.size());
    return outcome_of(status);
}

}  // namespace nplc::gateway
