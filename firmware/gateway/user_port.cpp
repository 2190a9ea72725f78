#include "gateway/user_port.h"

#include <algorithm>

#include "base/bytes.h"

namespace nplc::gateway {

namespace mactalk = protocol::mactalk;
using mactalk::Kind;
using mactalk::Request;

namespace {

constexpr int kReadsPerPoll = 16;
/// Timeout of the motor's own line. No manual gives the motor's longest answer time.
constexpr base::Microseconds kMotorAnswers{1'000'000};

/// Poll interval for a port that was full, and for the motor's own port, which does not signal received data.
constexpr base::Microseconds kLook{1'000};

constexpr std::uint32_t kMayWrite = 1;
constexpr std::uint32_t kMaySendAll = 2;

bool only_reads(Kind kind) {
    return kind == Kind::read || kind == Kind::read_block || kind == Kind::read_samples;
}

}  // namespace

/// Not inlined, so that its stack is not part of the board's main loop.
[[gnu::noinline]] void UserPort::poll(base::Instant now) {
    if (line_ == nullptr) return;
    decoder_.take_long_writes(static_cast<std::uint8_t>(settings_.at_start(store::Setting::gateway_address)));
    receive(now);
    const auto unit = static_cast<std::uint8_t>(settings_.at_start(store::Setting::gateway_address));
    if (modbus_.poll(unit, now, settings_.at_start(store::Setting::user_baud))) begin_modbus(now);
    go_on(now);
    transmit(now);
}

void UserPort::submit(const Request& request, std::span<const std::uint8_t> data, base::Instant now) {
    decoder_.place(request, data);
    begin(request, now);
}

std::span<const std::uint8_t> UserPort::take_reply() {
    const auto reply = out_.view().subspan(sent_);
    sent_ = out_.size;
    return reply;
}

base::Instant UserPort::next_poll(base::Instant now) {
    base::Instant next = base::kNever;
    if (sent_ < out_.size) next = std::min(next, now + kLook);
    switch (serving_) {
        case Serving::nothing:
        case Serving::own_write:
            return next;
        case Serving::set_points:
            if (!SetPointsPart::kIsThere) return next;
            return std::min(next, begun_ + SetPointsPart::kLongestWait + base::Microseconds(1));
        case Serving::motor:
            return std::min(next, bridge_.next_poll(now, read_pause()));
        case Serving::motor_line:
            return std::min(next, now + kLook);
    }
    return now;
}

void UserPort::receive(base::Instant now) {
    std::array<ports::ReceivedByte, 16> bytes;
    for (int i = 0; i < kReadsPerPoll; ++i) {
        const std::size_t count = line_->read(bytes);
        for (const auto& byte : std::span(bytes).first(count)) {
            if (byte.framing_error) {
                modbus_.damaged(now);
                decoder_.abandon();
                continue;
            }
            const auto unit = static_cast<std::uint8_t>(settings_.at_start(store::Setting::gateway_address));
            if (modbus_.take(byte.value, unit, now)) {
                begin_modbus(now);
            } else if (const auto request = decoder_.receive(byte.value)) {
                begin(*request, now);
            }
        }
        if (count < bytes.size()) return;
    }
}

bool UserPort::is_for_motor(std::uint8_t address) const {
    return address == mactalk::kEveryone || address == settings_.at_start(store::Setting::motor_address);
}

void UserPort::begin(const Request& request, base::Instant now) {
    ++own_.port().messages;
    modbus_.pass_over();
    const bool own = request.address == settings_.at_start(store::Setting::gateway_address);
    if (!own && !is_for_motor(request.address)) return;
    drop();
    is_modbus_ = false;
    begun_ = now;
    own ? begin_own(request, now) : begin_motor(request, now);
}

/// A Modbus request. Like any message it ends the wait for the answer to the one before.
[[gnu::noinline]] void UserPort::begin_modbus(base::Instant now) {
    ++own_.port().messages;
    drop();
    is_modbus_ = true;
    begun_ = now;
    switch (modbus_.begin(now)) {
        case ModbusPart::Need::nothing:
            return;
        case ModbusPart::Need::own_write:
            data_size_ = sizeof(std::uint32_t);
            base::store_u32(data_.data(), modbus_.value());
            own_.begin_write(modbus_.reg(), std::span(data_).first(data_size_), now);
            serving_ = Serving::own_write;
            return;
        case ModbusPart::Need::motor:
            return begin_motor(modbus_.motor_request(), now);
    }
}

void UserPort::drop() {
    modbus_.drop();
    if (serving_ == Serving::own_write) own_.drop_write();
    if (serving_ == Serving::motor) bridge_.drop();
    serving_ = Serving::nothing;
    out_.size = sent_ = 0;
}

/// A set-point request that is already being stored is not cancelled.
void UserPort::cancel_own_write() {
    const bool waits_to_set = serving_ == Serving::set_points && set_points_.request == 0;
    if (serving_ != Serving::own_write && !waits_to_set) return;
    if (!waits_to_set) own_.drop_write();
    const std::uint8_t reg =
        waits_to_set ? std::uint8_t{registers::gateway::SET_POINT_WRITE} : own_.written();
    own_.set_result(static_cast<std::uint32_t>(Result::too_late) | std::uint32_t{reg} << 8);
    refuse();
}

void UserPort::begin_own(const Request& request, base::Instant now) {
    std::array<std::uint8_t, mactalk::kBlockBytes> values;
    switch (request.kind) {
        case Kind::read:
        case Kind::read_block: {
            const std::size_t size = request.kind == Kind::read ? mactalk::kReadBytes : mactalk::kBlockBytes;
            own_.read(request.reg, std::span(values).first(size), now);
            return answer(mactalk::encode_registers(request.reg, std::span(values).first(size)));
        }
        case Kind::write:
            data_size_ = decoder_.data().size();
            std::copy(decoder_.data().begin(), decoder_.data().end(), data_.begin());
            if (SetPointsPart::kIsThere && request.reg == registers::gateway::SET_POINT_WRITE) {
                set_points_.begin(Origin::user_port, now);
                serving_ = Serving::set_points;
                return;
            }
            own_.begin_write(request.reg, std::span(data_).first(data_size_), now);
            serving_ = Serving::own_write;
            return;
        default:
            return refuse();
    }
}

void UserPort::begin_motor(const Request& request, base::Instant now) {
    if (is_stop(request)) gateway_.stop(now);
    if (!motor_allows(request)) {
        if (is_modbus_) modbus_.refuse(Result::not_allowed);
        return refuse();
    }
    if (!only_reads(request.kind)) gateway_.forget_mode();
    if (!MotorBridge::carries(request.kind)) return pass_on(now);
    bridge_.begin(request, now);
    serving_ = Serving::motor;
}

/// A MAC800 accepts longwords only. Reads are always allowed.
bool UserPort::motor_allows(const Request& request) const {
    if (only_reads(request.kind)) return true;
    if (request.kind == Kind::write && gateway_.motor().longwords_only() && request.length != 4) return false;
    if (gateway_.run_state() == RunState::stopped) return true;
    const std::uint32_t needed = request.kind == Kind::write ? kMayWrite : kMaySendAll;
    return settings_.get(store::Setting::motor_writes) >= needed;
}

void UserPort::pass_on(base::Instant now) {
    if (motor_line_ == nullptr) return refuse();
    std::array<ports::ReceivedByte, 16> stale;
    while (motor_line_->read(stale) == stale.size()) {
    }
    std::copy(decoder_.bare().begin(), decoder_.bare().end(), passed_.begin());
    passed_sent_ = 0;
    begun_ = now;
    serving_ = Serving::motor_line;
    transmit_to_motor();
}

void UserPort::transmit_to_motor() {
    if (passed_sent_ == passed_.size()) return;
    passed_sent_ += motor_line_->write(std::span(passed_).subspan(passed_sent_));
}

void UserPort::go_on(base::Instant now) {
    switch (serving_) {
        case Serving::nothing:
            return;
        case Serving::own_write:
        case Serving::set_points: {
            const auto bytes = std::span(data_).first(data_size_);
            const bool is_own = !SetPointsPart::kIsThere || serving_ == Serving::own_write;
            const PendingResult outcome =
                is_own ? own_.poll_write(bytes, now) : own_.serve_set_points(set_points_, bytes, now);
            if (!outcome) return;
            if (is_modbus_) {
                serving_ = Serving::nothing;
                return modbus_.end_write(outcome);
            }
            return outcome.is_done() ? answer(mactalk::encode_accept()) : refuse();
        }
        case Serving::motor:
            return serve_motor(now);
        case Serving::motor_line:
            return pass_back(now);
    }
}

base::Milliseconds UserPort::read_pause() const {
    const bool running = gateway_.run_state() != RunState::stopped;
    return base::Milliseconds(running ? settings_.get(store::Setting::read_pause) : 0);
}

void UserPort::serve_motor(base::Instant now) {
    switch (bridge_.poll(now, read_pause())) {
        case MotorBridge::State::under_way:
            return;
        case MotorBridge::State::answered:
            if (!is_modbus_) return answer(bridge_.answer());
            serving_ = Serving::nothing;
            return modbus_.end_motor(bridge_.data());
        case MotorBridge::State::failed:
            if (is_modbus_) modbus_.refuse(Result::link_down);
            return refuse();
    }
}

/// Passes the motor's bytes on unchecked.
void UserPort::pass_back(base::Instant now) {
    transmit_to_motor();
    if (now - begun_ > kMotorAnswers) return drop();
    if (sent_ < out_.size) return;
    std::array<ports::ReceivedByte, 16> bytes;
    const std::size_t count = motor_line_->read(bytes);
    out_.size = sent_ = 0;
    for (const auto& byte : std::span(bytes).first(count)) {
        if (!byte.framing_error) out_.bytes[out_.size++] = byte.value;
    }
    if (count != 0) begun_ = now;
}

void UserPort::refuse() {
    ++own_.port().refused;
    serving_ = Serving::nothing;
}

[[gnu::noinline]] void UserPort::answer(const mactalk::EncodedReply& reply) {
    out_ = reply;
    sent_ = 0;
    serving_ = Serving::nothing;
}

void UserPort::transmit(base::Instant now) {
    if (sent_ < out_.size) sent_ += line_->write(out_.view().subspan(sent_));
    if (modbus_.has_out())
        modbus_.note_sent(line_->write(modbus_.out(now, settings_.at_start(store::Setting::user_baud))));
}

}  // namespace nplc::gateway
