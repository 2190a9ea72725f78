#include "gateway/modbus_slave.h"

#include <algorithm>
#include <bit>

#include "base/bytes.h"
#include "registers/layout.h"
#include "registers/modbus_map.h"

namespace nplc::gateway {

namespace map = registers::modbus;
using namespace registers::gateway;
using protocol::modbus::Exception;
using protocol::modbus::Space;

namespace {

/// A value of the gateway, as it is laid out in input registers.
struct Row {
    std::uint8_t address;
    std::uint8_t reg;
    std::uint8_t shift = 0;
    std::uint8_t mask = 0;  ///< 0: all of it
};
constexpr std::uint8_t kFirstOfTwo = 18;  ///< values from here on have two words
constexpr Row kRows[] = {
    {map::kRunState, STATUS, 0, 7},
    {3, STEP},
    {4, COUNTER},
    {5, INPUTS, 0, 0x3F},
    {6, INPUTS, 8, 0x3F},
    {7, OUTPUTS, 0, 0x0F},
    {8, OUTPUTS, 8, 0x0F},
    {9, SAFE_REASON},
    {14, LINK},
    {kFirstOfTwo, TIMER},
    {20, LOG_COUNT},
    {22, UPTIME},
    {24, SCANS},
    {26, SCAN_TIME},
    {28, SCAN_WORST},
    {30, LINK_LOSSES},
    {32, RESENT},
    {34, ORDERS},
    {36, DISCARDED},
    {38, TABLE_CRC},
    {46, POLL_WORST},
    {map::kLatePolls, LATE_POLLS},
};

constexpr std::uint8_t bit_number(std::uint32_t bit) {
    return static_cast<std::uint8_t>(std::countr_zero(bit));
}
/// Bits of STATUS that discrete inputs show, from kIsSafe on; of two forced ones the first.
constexpr std::uint8_t kStatusOfDiscrete[map::kDiscretes - map::kIsSafe] = {
    bit_number(kSafe),
    bit_number(kMotorError),
    bit_number(kInPosition),
    bit_number(kLinkDelivers),
    bit_number(kForcedInputs),
    bit_number(kAtBreakpoint),
    bit_number(kTable),
    bit_number(kEnabled),
    bit_number(StatusBit::kUpload),
    bit_number(kSettingsDiffer),
    bit_number(StatusBit::kCannotGoOn),
    bit_number(StatusBit::kStopUnconfirmed)};

constexpr std::uint8_t kCoilCommands[] = {1, 2, 3, 6, 5, 4};  ///< run, stop, safe, hold, step, scan

constexpr std::size_t kWriteHead = 5;  ///< of a write: function, address, count or value

constexpr bool is_stop(std::uint32_t command) {
    return command == static_cast<std::uint32_t>(Command::stop) ||
           command == static_cast<std::uint32_t>(Command::safe) ||
           command == static_cast<std::uint32_t>(Command::hold);
}

/// The stop, safe or hold that a request writes; 0: none.
std::uint8_t stop_in(const protocol::modbus::Request& request) {
    if (!request.writes || request.address > map::kHold) return 0;
    if (request.space == Space::holding_register) {
        const std::uint16_t value = request.word(0);
        return request.address == map::kCommand && is_stop(value) ? static_cast<std::uint8_t>(value) : 0;
    }
    for (unsigned coil = std::max<unsigned>(request.address, map::kStop); coil <= map::kHold; ++coil) {
        if (coil < request.address + request.count && request.bit(coil - request.address))
            return kCoilCommands[coil];
    }
    return 0;
}

Exception exception_of(Result result) {
    if (result == Result::busy) return Exception::busy;
    return result == Result::link_down ? Exception::target_failed : Exception::device_failure;
}

}  // namespace

bool StopFinder::take(std::uint8_t byte, std::uint8_t unit) {
    constexpr std::size_t kAround = 3;
    std::copy(last_.begin() + 1, last_.end(), last_.begin());
    last_.back() = byte;
    for (std::size_t size = kWriteHead + kAround; size <= last_.size(); ++size) {
        const auto frame = std::span(last_).last(size);
        if (frame[0] != unit && frame[0] != protocol::modbus::kBroadcast) continue;
        const auto [request, exception] = protocol::modbus::decode(frame.subspan(1, size - kAround));
        if (exception != Exception::none) continue;
        const std::uint8_t stop = stop_in(request);
        // The CRC of a frame with its CRC is 0.
        if (stop == 0 || protocol::modbus::crc16(frame) != 0) continue;
        command_ = stop;
        return true;
    }
    return false;
}

bool ModbusSlave::take(std::uint8_t byte, std::uint8_t unit, base::Instant now) {
    heard_ = now;
    if (reader_.take(byte)) {
        if (reader_.unit() == unit) return true;
        unit_ = protocol::modbus::kBroadcast;
        drop();
    }
    return finder_.take(byte, unit);
}

void ModbusSlave::damaged(base::Instant now) {
    heard_ = now;
    reader_.damaged();
}

bool ModbusSlave::poll(std::uint8_t unit, base::Instant now, std::uint32_t baud) {
    if (!reader_.is_under_way() || now - heard_ <= protocol::modbus::silence_between_frames(baud))
        return false;
    return reader_.silence() && reader_.unit() == unit;
}

std::span<const std::uint8_t> ModbusSlave::out(base::Instant now, std::uint32_t baud) const {
    if (sent_ == 0 && now - heard_ < protocol::modbus::silence_between_frames(baud)) return {};
    return std::span(out_).first(size_).subspan(sent_);
}

// An answer is built in the send buffer: a copy would take stack from the main loop.

void ModbusSlave::begin_answer(std::uint8_t function) {
    size_ = sent_ = 0;
    put(unit_);
    put(function);
}

void ModbusSlave::put_word(std::uint16_t word) {
    put(static_cast<std::uint8_t>(word >> 8));
    put(static_cast<std::uint8_t>(word));
}

ModbusSlave::Need ModbusSlave::end_answer() {
    const std::uint16_t crc = protocol::modbus::crc16(std::span(out_).first(size_));
    put(static_cast<std::uint8_t>(crc));
    put(static_cast<std::uint8_t>(crc >> 8));
    if (unit_ == protocol::modbus::kBroadcast) drop();
    return Need::nothing;
}

ModbusSlave::Need ModbusSlave::refuse_with(Exception exception) {
    begin_answer(static_cast<std::uint8_t>(request_.function | 0x80U));
    put(static_cast<std::uint8_t>(exception));
    return end_answer();
}

/// begin() has put the bytes there: the reader keeps them until the next character only.
ModbusSlave::Need ModbusSlave::echo() {
    size_ = 1 + kWriteHead;
    sent_ = 0;
    return end_answer();
}

ModbusSlave::Need ModbusSlave::begin(base::Instant now) {
    drop();
    kind_ = Kind::plain;
    if (const std::uint8_t stop = finder_.take_command(); stop != 0) {
        kind_ = Kind::found;
        return command(stop);
    }
    unit_ = out_[0] = reader_.unit();
    std::copy_n(reader_.pdu().data(), kWriteHead, out_.begin() + 1);
    const auto decoded = protocol::modbus::decode(reader_.pdu());
    request_ = decoded.request;
    if (decoded.exception != Exception::none) return refuse_with(decoded.exception);
    if (request_.space == Space::holding_register && request_.address >= map::kMotorWindow)
        return use_window();
    if (request_.space == Space::input_register && request_.address == map::kPositionCounts) {
        if (request_.count != 2) return refuse_with(Exception::illegal_address);
        return ask_motor(false, registers::P_IST, 0);
    }
    if (!request_.writes) return read(now);
    const std::uint8_t stop = stop_in(request_);
    return request_.space == Space::coil ? write_coils(stop) : write_holding(stop, now);
}

std::uint32_t ModbusSlave::own(std::uint8_t reg, base::Instant now) {
    std::array<std::uint8_t, 4> bytes;
    own_.read(reg, bytes, now);
    return base::load_u32(bytes.data());
}

std::uint16_t ModbusSlave::status_bits(base::Instant now) {
    const std::uint32_t status = own(STATUS, now);
    const RunState state = run_state_of(status);
    unsigned bits = 0;
    for (unsigned i = map::kIsSafe; i < map::kDiscretes; ++i) {
        bits |= (status >> kStatusOfDiscrete[i - map::kIsSafe] & 1U) << i;
    }
    if ((status & kForcedOutputs) != 0) bits |= 1U << map::kForced;
    constexpr std::uint32_t kNeeded = kTable | kEnabled | kLinkDelivers;
    if (state == RunState::stopped && (status & kNeeded) == kNeeded) bits |= 1U << map::kReady;
    if (state == RunState::running) bits |= 1U << map::kRunning;
    if (state == RunState::waiting_for_motor) bits |= 1U << map::kWaiting;
    if (state == RunState::held || state == RunState::holding) bits |= 1U << map::kHeld;
    return static_cast<std::uint16_t>(bits);
}

std::uint16_t ModbusSlave::event_word(std::uint16_t address, base::Instant now) {
    const std::uint32_t count = own(LOG_COUNT, now);
    if (count == 0) return 0;
    const std::uint32_t entry =
        own(static_cast<std::uint8_t>(LOG + 2 * ((count - 1) % kLogEntries) + 1), now);
    if (address == map::kLastEventDetail) return static_cast<std::uint16_t>(entry >> 16);
    return static_cast<std::uint16_t>((address == map::kLastEvent ? entry : entry >> 8) & 0xFF);
}

std::uint16_t ModbusSlave::input_word(std::uint16_t address, base::Instant now) {
    constexpr std::uint32_t kTenth = 100;
    switch (address) {
        case map::kMapVersion:
            return map::kMapNumber;
        case map::kStatusWord:
            return status_bits(now);
        case map::kLastEvent:
        case map::kLastEventStep:
        case map::kLastEventDetail:
            return event_word(address, now);
        case map::kHeartbeat:
            return static_cast<std::uint16_t>(own(UPTIME, now) / kTenth);
        case map::kSeat:
        case map::kControl:
        case map::kMySeat:
        case map::kImageAge:
            return 0;
        case map::kNewEvents:
            return static_cast<std::uint16_t>(
                std::min<std::uint32_t>(own(LOG_COUNT, now) - acknowledged_, 0xFFFF));
        case map::kDoneNumber:
            return done_number_;
        case map::kResult:
            return result_;
        case map::kResultDetail:
            return detail_;
        default:
            break;
    }
    for (const Row& row : kRows) {
        const bool has_two = row.address >= kFirstOfTwo;
        if (address != row.address && (!has_two || address != row.address + 1)) continue;
        std::uint32_t value = own(row.reg, now) >> row.shift;
        if (row.mask != 0) value &= row.mask;
        const bool is_high = has_two && address == row.address;
        return static_cast<std::uint16_t>(is_high ? value >> 16 : value);
    }
    return 0;
}

namespace {

/// Whether `place` lies between the two words of a value.
bool splits(unsigned place) {
    for (const Row& row : kRows) {
        if (row.address >= kFirstOfTwo && place == row.address + 1U) return true;
    }
    return false;
}

}  // namespace

ModbusSlave::Need ModbusSlave::read(base::Instant now) {
    static constexpr std::uint8_t kEnds[] = {map::kResetError, map::kDiscretes, map::kLatePolls + 2,
                                             map::kRecipe};
    constexpr std::uint16_t kNothing = map::kImageAge + 1;  // gap between two rows
    const unsigned end = request_.address + request_.count;
    const bool is_input = request_.space == Space::input_register;
    const bool has_gap = is_input && request_.address <= kNothing && end > kNothing;
    const bool has_half = is_input && (splits(request_.address) || splits(end));
    if (has_gap || has_half || end > kEnds[static_cast<std::size_t>(request_.space)])
        return refuse_with(Exception::illegal_address);
    begin_answer(request_.function);
    if (request_.space == Space::coil || request_.space == Space::discrete_input) {
        const unsigned all = request_.space == Space::coil ? coils_.on : status_bits(now);
        const unsigned bits = all >> request_.address & ((1U << request_.count) - 1U);
        put(static_cast<std::uint8_t>((request_.count + 7U) / 8U));
        put(static_cast<std::uint8_t>(bits));
        if (request_.count > 8) put(static_cast<std::uint8_t>(bits >> 8));
        return end_answer();
    }
    put(static_cast<std::uint8_t>(2 * request_.count));
    for (unsigned i = 0; i < request_.count; ++i) {
        const auto address = static_cast<std::uint16_t>(request_.address + i);
        put_word(request_.space == Space::holding_register ? holding_word(address, now)
                                                           : input_word(address, now));
    }
    return end_answer();
}

std::uint16_t ModbusSlave::holding_word(std::uint16_t address, base::Instant now) {
    if (address == map::kCommand) return command_;
    if (address == map::kCommandNumber) return number_;
    return static_cast<std::uint16_t>(own(address == map::kForceInputs ? FORCE_IN : FORCE_OUT, now));
}

ModbusSlave::Need ModbusSlave::write_own(std::uint8_t reg, std::uint32_t value) {
    reg_ = reg;
    value_ = value;
    return Need::own_write;
}

ModbusSlave::Need ModbusSlave::command(std::uint16_t value) {
    return write_own(COMMAND, value);
}

/// A stop acts on level 1; all other coils act on the change from 0 to 1. One command at a time.
ModbusSlave::Need ModbusSlave::write_coils(std::uint8_t stop) {
    if (request_.address + request_.count > map::kResetError) return refuse_with(Exception::illegal_address);
    std::uint8_t other = 0;
    for (unsigned i = 0; i < request_.count; ++i) {
        const unsigned coil = request_.address + i;
        const auto bit = static_cast<std::uint8_t>(1U << coil);
        const bool on = request_.bit(i);
        const bool rises = on && (coils_.on & bit) == 0 && (coils_.were_off & bit) != 0;
        if (!on) coils_.were_off |= bit;
        coils_.on = static_cast<std::uint8_t>(on ? coils_.on | bit : coils_.on & ~bit);
        if (coil == map::kAcknowledge) {
            if (on) acknowledged_ = gateway_.log().count();
            continue;
        }
        const std::uint8_t value = kCoilCommands[coil];
        if (rises && !is_stop(value)) other = value;
    }
    if (stop != 0) return command(stop);
    return other != 0 ? command(other) : echo();
}

ModbusSlave::Need ModbusSlave::write_holding(std::uint8_t stop, base::Instant now) {
    if (request_.address + request_.count > map::kRecipe) return refuse_with(Exception::illegal_address);
    const unsigned first = request_.address;
    const auto is_written = [&](unsigned at) { return at >= first && at < first + request_.count; };
    if (first == map::kCommand) command_ = request_.word(0);
    bool is_new = false;
    if (is_written(map::kCommandNumber)) {
        const std::uint16_t number = request_.word(map::kCommandNumber - first);
        is_new = number != number_ && number != 0;
        number_ = number;
        if (number == 0) {
            is_armed_ = true;
            done_number_ = 0;
        }
    }
    if (is_new) kind_ = Kind::handshake;
    if (stop != 0) {
        kind_ = Kind::handshake;
        return command(stop);
    }
    if (is_new) {
        const bool is_known = command_ >= static_cast<std::uint16_t>(Command::run) &&
                              command_ <= static_cast<std::uint16_t>(Command::hold);
        if (is_armed_ && is_known) return command(command_);
        const bool acknowledges = is_armed_ && command_ == map::kAcknowledgeEvents;
        if (acknowledges) acknowledged_ = gateway_.log().count();
        end_write(CommandResult{acknowledges ? Result::done
                                : is_armed_  ? Result::bad_value
                                             : Result::too_late});
        return Need::nothing;
    }
    for (unsigned at = map::kForceInputs; at <= map::kForceOutputs; ++at) {
        if (!is_written(at)) continue;
        const std::uint8_t reg = at == map::kForceInputs ? FORCE_IN : FORCE_OUT;
        const std::uint16_t value = request_.word(at - first);
        if (value != 0 || own(reg, now) != 0) return write_own(reg, value);
    }
    return echo();
}

/// Reads or writes one motor register per request.
ModbusSlave::Need ModbusSlave::use_window() {
    const unsigned place = request_.address - unsigned{map::kMotorWindow};
    if (place % 2 != 0 || place < 2 || place >= map::kMotorWindowEnd - unsigned{map::kMotorWindow})
        return refuse_with(Exception::illegal_address);
    if (request_.count != 2) return refuse_with(Exception::illegal_value);
    const auto number = static_cast<std::uint8_t>(place / 2);
    if (!request_.writes) return ask_motor(false, number, 0);
    return ask_motor(true, number, std::uint32_t{request_.word(0)} << 16 | request_.word(1));
}

ModbusSlave::Need ModbusSlave::ask_motor(bool writes, std::uint8_t number, std::uint32_t value) {
    const registers::Width width = registers::small_width_of(number);
    const bool longword = gateway_.motor().longwords_only() || width.bytes == 4;
    const auto sign = static_cast<std::int32_t>(value);
    const bool fits = width.is_signed ? sign >= INT16_MIN && sign <= INT16_MAX : value <= 0xFFFF;
    if (writes && !longword && !fits) return refuse_with(Exception::illegal_value);
    motor_ = {.kind = writes ? protocol::mactalk::Kind::write : protocol::mactalk::Kind::read,
              .address = protocol::mactalk::kEveryone,
              .reg = number,
              .length = static_cast<std::uint8_t>(longword ? 4 : 2),
              .value = longword ? value : value & 0xFFFF};
    return Need::motor;
}

void ModbusSlave::end_write(const PendingResult& outcome) {
    if (kind_ == Kind::found) return;
    const std::uint32_t word = outcome.word();
    result_ = static_cast<std::uint16_t>(word & 0xFF);
    detail_ = static_cast<std::uint16_t>(word >> 16);
    if (kind_ == Kind::handshake) {
        done_number_ = number_;
        echo();
        return;
    }
    if (outcome.is_done())
        echo();
    else
        refuse_with(exception_of(static_cast<Result>(result_)));
}

/// `data`: the register's bytes after a read; empty after a write.
void ModbusSlave::end_motor(std::span<const std::uint8_t> data) {
    if (request_.writes) {
        echo();
        return;
    }
    std::uint32_t value = base::load_u32(data.data());
    if (motor_.length == 2) {
        value &= 0xFFFF;
        if (registers::small_width_of(motor_.reg).is_signed && (value & 0x8000) != 0) value |= 0xFFFF'0000;
    }
    begin_answer(request_.function);
    put(sizeof value);
    put_word(static_cast<std::uint16_t>(value >> 16));
    put_word(static_cast<std::uint16_t>(value));
    end_answer();
}

void ModbusSlave::refuse(Result result) {
    result_ = static_cast<std::uint16_t>(result);
    detail_ = 0;
    refuse_with(exception_of(result));
}

}  // namespace nplc::gateway
