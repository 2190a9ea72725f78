#include "motor/mactalk_line.h"

#include <array>

#include "base/bytes.h"
#include "registers/mac.h"

namespace nplc::motor {
namespace {

namespace mactalk = protocol::mactalk;

constexpr base::Milliseconds kSilence{20};
/// A request and its answer at 19200 baud, and an adapter that holds characters back.
constexpr base::Milliseconds kAnswer{100};
constexpr base::Milliseconds kBetweenLooks{5};
/// A motor that turns goes from MODE_REG := 0 through mode 11, STOP, in which it brakes (001 §4.4.12).
constexpr std::uint32_t kPassive = 0;
constexpr std::uint32_t kBraking = 11;

}  // namespace

bool MactalkLine::stop(bool is_wanted, base::Instant now) {
    if (!is_wanted) {
        phase_ = Phase::passing;
        return false;
    }
    if (phase_ == Phase::passing) {
        phase_ = Phase::listening;
        pace_.begin_anew();
        due_ = heard_ = now;
    }
    if (receive(now)) {
        phase_ = Phase::passing;
        return true;
    }
    if (phase_ == Phase::listening) {
        const bool is_free = now - heard_ >= kSilence && port_.transmitter_idle();
        if (!is_free || now < due_) return false;
        due_ = now + pace_.next();
        begin(Phase::writing, mactalk::Kind::write, now);
    }
    sent_ += port_.write(out_.view().subspan(sent_));
    if (now >= until_) phase_ = Phase::listening;
    return false;
}

base::Instant MactalkLine::next_poll(base::Instant now) const {
    return phase_ == Phase::passing ? base::kNever : now + kBetweenLooks;
}

void MactalkLine::begin(Phase phase, mactalk::Kind kind, base::Instant now) {
    const bool writes = kind == mactalk::Kind::write;
    const std::uint8_t length = writes ? (longword_ ? 4 : 2) : 0;
    phase_ = phase;
    until_ = now + kAnswer;
    out_ = mactalk::encode({.kind = kind, .address = address_, .reg = registers::MODE_REG, .length = length});
    sent_ = 0;
    decoder_.expect(mactalk::answer_to(kind), writes ? 0 : mactalk::kReadBytes);
}

/// True if the motor has confirmed the stop.
bool MactalkLine::receive(base::Instant now) {
    std::array<ports::ReceivedByte, 32> bytes;
    for (;;) {
        const std::size_t count = port_.read(bytes);
        for (const ports::ReceivedByte& byte : std::span(bytes).first(count)) {
            heard_ = now;
            if (byte.framing_error) {
                decoder_.abandon();
                continue;
            }
            const auto reply = decoder_.receive(byte.value);
            if (reply && take(*reply, now)) return true;
        }
        if (count < bytes.size()) return false;
    }
}

/// The accept alone may be the answer to another master's write.
bool MactalkLine::take(const mactalk::Reply& reply, base::Instant now) {
    if (phase_ == Phase::writing) {
        begin(Phase::reading, mactalk::Kind::read, now);
        return false;
    }
    if (phase_ != Phase::reading || reply.reg != registers::MODE_REG) return false;
    phase_ = Phase::listening;
    const std::uint32_t mode = base::load_u32(reply.data.data()) & (longword_ ? UINT32_MAX : UINT16_MAX);
    return mode == kPassive || mode == kBraking;
}

std::size_t MactalkLine::write(std::span<const std::uint8_t> bytes) {
    return phase_ == Phase::passing ? port_.write(bytes) : bytes.size();
}

std::size_t MactalkLine::read(std::span<ports::ReceivedByte> out) {
    return phase_ == Phase::passing ? port_.read(out) : 0;
}

}  // namespace nplc::motor
