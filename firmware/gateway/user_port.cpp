#include "gateway/user_port.h"

#include <algorithm>

namespace nplc::gateway {

namespace mactalk = protocol::mactalk;
using mactalk::Kind;
using mactalk::Request;

namespace {

constexpr int kReadsPerPoll = 16;
/// The motor's own line: no manual says how long it may take to answer.
constexpr base::Microseconds kMotorAnswers{1'000'000};

/// At a port that was full, and at the motor's own, of which it is not told when something comes.
constexpr base::Microseconds kLook{1'000};

constexpr std::uint32_t kMayWrite = 1;
constexpr std::uint32_t kMaySendAll = 2;

bool only_reads(Kind kind) {
    return kind == Kind::read || kind == Kind::read_block || kind == Kind::read_samples;
}

}  // namespace

/// By itself, so that its stack is not the board's loop's.
[[gnu::noinline]] void UserPort::poll(base::Instant now) {
    if (line_ == nullptr) return;
    decoder_.take_long_writes(static_cast<std::uint8_t>(settings_.at_start(store::Setting::gateway_address)));
    receive(now);
    go_on(now);
    transmit();
}

base::Instant UserPort::next_poll(base::Instant now) {
    base::Instant next = base::kNever;
    if (sent_ < out_.size) next = std::min(next, now + kLook);
    switch (serving_) {
        case Serving::nothing:
        case Serving::own_write:
            return next;
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
                decoder_.abandon();
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
    const bool own = request.address == settings_.at_start(store::Setting::gateway_address);
    if (!own && !is_for_motor(request.address)) return;
    drop();
    begun_ = now;
    own ? begin_own(request, now) : begin_motor(request, now);
}

void UserPort::drop() {
    if (serving_ == Serving::own_write) own_.drop_write();
    if (serving_ == Serving::motor) bridge_.drop();
    serving_ = Serving::nothing;
    out_.size = sent_ = 0;
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
            own_.begin_write(request.reg, std::span(data_).first(data_size_), now);
            serving_ = Serving::own_write;
            return;
        default:
            return refuse();
    }
}

void UserPort::begin_motor(const Request& request, base::Instant now) {
    if (!motor_allows(request)) return refuse();
    if (!only_reads(request.kind)) gateway_.forget_mode();
    if (!MotorBridge::carries(request.kind)) return pass_on(now);
    bridge_.begin(request, now);
    serving_ = Serving::motor;
}

/// A MAC800 takes longwords only. Reads are always allowed.
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
        case Serving::own_write: {
            const Progress outcome = own_.poll_write(std::span(data_).first(data_size_), now);
            if (!outcome) return;
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
            return answer(bridge_.answer());
        case MotorBridge::State::failed:
            return refuse();
    }
}

/// Bytes as they come: what the motor answers is its own affair.
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

void UserPort::answer(const mactalk::EncodedReply& reply) {
    out_ = reply;
    sent_ = 0;
    serving_ = Serving::nothing;
}

void UserPort::transmit() {
    if (sent_ < out_.size) sent_ += line_->write(out_.view().subspan(sent_));
}

}  // namespace nplc::gateway
