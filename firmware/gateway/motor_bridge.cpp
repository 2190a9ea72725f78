#include "gateway/motor_bridge.h"

#include <algorithm>

#include "base/bytes.h"

namespace nplc::gateway {

namespace mactalk = protocol::mactalk;
using mactalk::Kind;

namespace {

constexpr std::size_t kLongword = 4;
constexpr std::uint8_t kMostFailures = 2;
/// A block of 16 while the sequence runs takes about 0.7 s.
constexpr base::Microseconds kLongest{3'000'000};

}  // namespace

bool MotorBridge::carries(Kind kind) {
    return kind == Kind::read || kind == Kind::read_block || kind == Kind::write;
}

void MotorBridge::begin(const mactalk::Request& request, base::Instant now) {
    drop();
    request_ = request;
    data_ = {};
    have_ = 0;
    failures_ = 0;
    begun_ = now;
}

void MotorBridge::drop() {
    if (asked_) motor_.drop_access();
    asked_ = false;
}

std::size_t MotorBridge::wanted_bytes() const {
    return request_.kind == Kind::read_block ? mactalk::kBlockBytes : mactalk::kReadBytes;
}

/// Empty beyond register 255.
std::optional<motor::Access> MotorBridge::next_access() const {
    if (!is_read()) {
        return motor::Access{.is_write = true,
                             .reg = request_.reg,
                             .longword = request_.length == kLongword,
                             .value = request_.value};
    }
    const std::size_t cell = motor_.longwords_only() ? 4 : 2;
    const std::size_t number = request_.reg + have_ / cell;
    if (number > 255) return std::nullopt;
    const bool is_last_word = cell == 2 && number == 255;
    return motor::Access{.reg = static_cast<std::uint8_t>(number), .longword = !is_last_word};
}

MotorBridge::State MotorBridge::poll(base::Instant now, base::Microseconds pause) {
    if (!motor::link_is_usable(motor_.link()) || now - begun_ > kLongest) {
        drop();
        return State::failed;
    }
    if (asked_) return take(now);
    const auto access = next_access();
    if (!access) return State::answered;
    if (now - ended_ >= pause) asked_ = motor_.begin_access(*access);
    return State::under_way;
}

base::Instant MotorBridge::next_poll(base::Instant now, base::Microseconds pause) const {
    const base::Instant patience = begun_ + kLongest + base::Microseconds(1);
    if (motor::is_open(motor_.access_state())) return patience;
    return std::min(patience, asked_ ? now : std::max(now, ended_ + pause));
}

MotorBridge::State MotorBridge::take(base::Instant now) {
    const motor::AccessState state = motor_.access_state();
    if (motor::is_open(state)) return State::under_way;
    asked_ = false;
    ended_ = now;
    if (state != motor::AccessState::done) {
        ++failures_;
        // A failed write may have been executed: it is not repeated.
        return is_read() && failures_ < kMostFailures ? State::under_way : State::failed;
    }
    if (!is_read()) return State::answered;
    base::store_u32(&data_[have_], motor_.access_value());
    have_ += kLongword;
    return have_ < wanted_bytes() ? State::under_way : State::answered;
}

mactalk::EncodedReply MotorBridge::answer() const {
    if (!is_read()) return mactalk::encode_accept();
    return mactalk::encode_registers(request_.reg, std::span(data_).first(wanted_bytes()));
}

}  // namespace nplc::gateway
