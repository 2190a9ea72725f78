#include "motor/jvl_link.h"

#include <algorithm>
#include <utility>

namespace nplc::motor {
namespace {

using protocol::fastmac::Status;

constexpr base::Microseconds kLongestMessage{250'000};  ///< from its first byte to its echo, resends included
constexpr std::uint8_t kMostResends = 3;
/// Number of status bytes in a row, received after the whole message and after the echo timeout, that must
/// show the old toggle before the message is sent again. The first of them may have been in transit already,
/// so 2 is the minimum.
constexpr std::uint8_t kProofBytes = 3;
constexpr std::uint8_t kStrangeBytes = 4;
/// Number of status bytes in a row that show, before FlexMAC is left, that the last echo was none.
constexpr std::uint8_t kFalseEchoBytes = 2;
constexpr int kReadsPerPoll = 1024;  // more than any port buffers
constexpr base::Microseconds kTick{1};

constexpr std::uint8_t bump(std::uint8_t count) {
    return count == 0xFF ? count : static_cast<std::uint8_t>(count + 1);
}

base::Microseconds character_time(std::uint32_t baud) {
    return base::Microseconds((10'000'000U + baud - 1) / baud);
}

}  // namespace

JvlLink::JvlLink(ports::SerialPort& port, const Settings& settings)
    : port_(port), settings_(settings), character_(character_time(settings.baud)) {}

void JvlLink::send_command(std::uint8_t command, int copies, base::Instant now) {
    const std::uint8_t byte = protocol::fastmac::with_toggle(command, !toggle_);
    const std::array<std::uint8_t, 2> bytes{byte, byte};
    const bool enters = command == protocol::fastmac::command_byte(protocol::fastmac::Number::use_flexmac);
    start(std::span(bytes).first(copies == 2 ? 2 : 1), enters ? Expect::enter_flexmac : Expect::toggle, now);
}

void JvlLink::send_flexmac(const protocol::flexmac::Message& message, base::Instant now) {
    start(protocol::flexmac::encode(message).view(), Expect::toggle, now);
}

void JvlLink::send_read(const protocol::flexmac::Message& request, base::Instant now) {
    send_flexmac(request, now);
    request_ = request;
    reads_ = true;
}

std::optional<std::uint32_t> JvlLink::take_reply() {
    return std::exchange(reply_, std::nullopt);
}

void JvlLink::leave_flexmac(base::Instant now) {
    send_flexmac(protocol::flexmac::kUseFastMac, now);
    expect_ = Expect::leave_flexmac;
}

void JvlLink::send_blind(std::span<const std::uint8_t> bytes, base::Instant now) {
    start(bytes, Expect::nothing, now);
}

void JvlLink::start(std::span<const std::uint8_t> bytes, Expect expect, base::Instant now) {
    std::copy(bytes.begin(), bytes.end(), message_.begin());
    size_ = static_cast<std::uint8_t>(bytes.size());
    expect_ = expect;
    resends_ = 0;
    started_ = now;
    reads_ = false;
    reply_.reset();
    rewind(now);
}

void JvlLink::rewind(base::Instant now) {
    sent_ = 0;
    on_the_line_ = false;
    stale_count_ = 0;
    const bool is_flexmac = size_ > 2;
    // A pause of two characters ends a message for the motor.
    next_byte_ = is_flexmac ? std::max(now, left_at_ + 3 * character_) : now;
    transmit(now);
}

void JvlLink::synchronize() {
    toggle_ = status().toggle;
    flexmac_ = status().flexmac;
    synchronized_ = true;
    unexpected_count_ = 0;
}

void JvlLink::forget(base::Instant now) {
    filter_.forget();
    replies_.abandon();
    expect_ = Expect::nothing;
    accepted_ = synchronized_ = false;
    size_ = sent_ = 0;
    unexpected_count_ = 0;
    reads_ = false;
    reply_.reset();
    last_status_ = now;
    echo_.forget();
}

JvlLink::Result JvlLink::poll(base::Instant now) {
    receive(now);  // first: these bytes came before anything sent in this poll
    const Result result = judge(now);
    if (result == Result::none) transmit(now);
    return result;
}

base::Instant JvlLink::next_poll(base::Instant now) const {
    base::Instant next = base::kNever;
    const auto not_after = [&next](base::Instant time) { next = std::min(next, time); };
    const auto not_before = [&](base::Instant time) { not_after(time > now ? time : now + character_); };
    if (sent_ < size_) {
        not_before(next_byte_);
    } else if (size_ != 0 && !on_the_line_) {
        not_before(line_free_);
    }
    if (!synchronized_) return next;
    not_after(last_status_ + longest_silence() + kTick);
    if (!busy()) return next;
    not_after(started_ + kLongestMessage + kTick);
    return next;
}

void JvlLink::transmit(base::Instant now) {
    while (sent_ < size_ && now >= next_byte_) {
        const bool pauses = known() && status().framing_error;
        const std::size_t wanted = pauses ? 1 : size_ - sent_;
        const std::size_t taken = port_.write(std::span(message_).subspan(sent_, wanted));
        sent_ = static_cast<std::uint8_t>(sent_ + taken);
        line_free_ = std::max(line_free_, now + kTick) + static_cast<int>(taken) * character_;
        if (pauses) next_byte_ = now + 2 * character_;
        if (taken == 0) return;
    }
    if (!on_the_line_ && size_ != 0 && sent_ == size_ && now >= line_free_ && port_.transmitter_idle()) {
        on_the_line_ = true;
        left_at_ = now;
    }
}

[[gnu::noinline]] void JvlLink::receive(base::Instant now) {
    const base::Microseconds unwatched = now - listening_.polled;
    listening_.polled = now;
    listening_.heard = base::Microseconds(0);
    read_all(now);
    listening_.too_late = unwatched - listening_.heard > longest_silence();
}

void JvlLink::read_all(base::Instant now) {
    std::array<ports::ReceivedByte, 16> bytes;
    for (int i = 0; i < kReadsPerPoll; ++i) {
        const std::size_t count = port_.read(bytes);
        for (const auto& byte : std::span(bytes).first(count)) {
            listening_.heard += character_;
            if (byte.framing_error) {
                framing_seen_ = true;
                filter_.break_pair();
                replies_.abandon();
                continue;
            }
            on_byte(byte.value, now);
        }
        if (count < bytes.size()) return;
    }
}

void JvlLink::on_byte(std::uint8_t byte, base::Instant now) {
    using Kind = protocol::flexmac::ReplyDecoder::Event::Kind;
    const auto event = replies_.receive(byte);
    if (reads_) last_status_ = now;  // a slow motor's answer takes longer than `silence`
    if (event.kind == Kind::status) on_status(event.status, now);
    if (event.kind == Kind::reply) on_reply(event.reply);
}

/// An answer repeats its request, which tells it from the answer to an earlier, dropped read, unless that
/// read was the same.
void JvlLink::on_reply(const protocol::flexmac::Message& reply) {
    protocol::flexmac::Message request = reply;
    request.value = 0;
    if (!reads_ || request != request_) return;
    reads_ = false;
    reply_ = reply.value;
}

void JvlLink::on_status(std::uint8_t byte, base::Instant now) {
    if (synchronized_) echo_.pause(now - last_status_);
    last_status_ = now;
    filter_.receive(byte);
    const Status seen = protocol::fastmac::decode_status(byte);
    const bool is_old = busy() && on_the_line_ && now - left_at_ >= patience() && shows_old(seen);
    stale_count_ = is_old ? bump(stale_count_) : std::uint8_t{0};
    unexpected_count_ = in_step(seen) && !echo_was_false() ? std::uint8_t{0} : bump(unexpected_count_);
    if (is_done()) settle(now);
}

bool JvlLink::shows_old(const Status& seen) const {
    return expect_ == Expect::leave_flexmac ? seen.flexmac : seen.toggle == toggle_;
}

/// Until FlexMAC is left the status shows the toggle of the message before; another one denies that this was
/// accepted.
bool JvlLink::echo_was_false() const {
    return expect_ == Expect::leave_flexmac && unexpected_count_ >= kFalseEchoBytes;
}

bool JvlLink::is_done() const {
    if (!known() || sent_ == 0) return false;
    switch (expect_) {
        case Expect::nothing:
            return false;
        case Expect::toggle:
            return status().toggle != toggle_ && status().flexmac == flexmac_;
        case Expect::enter_flexmac:
            return status().toggle != toggle_ && status().flexmac;
        case Expect::leave_flexmac:
            return !status().flexmac && unexpected_count_ < kFalseEchoBytes;
    }
    return false;
}

void JvlLink::settle(base::Instant now) {
    // The echo time is not learned from longer messages: the motor may answer them before their end.
    if (resends_ == 0 && size_ <= 2)
        echo_.learn(now - (on_the_line_ ? left_at_ : line_free_) - kEchoCharacters * character_);
    synchronize();
    expect_ = Expect::nothing;
    if (!on_the_line_) left_at_ = now;
    accepted_ = true;
}

bool JvlLink::in_step(const Status& seen) const {
    switch (expect_) {
        case Expect::nothing:
            return seen.toggle == toggle_ && seen.flexmac == flexmac_;
        case Expect::toggle:
            return seen.flexmac == flexmac_;
        case Expect::enter_flexmac:
            break;
        case Expect::leave_flexmac:
            return !seen.flexmac || seen.toggle == toggle_;
    }
    return true;
}

JvlLink::Result JvlLink::judge(base::Instant now) {
    if (synchronized_ && listening_.too_late)
        return Result::silent;  // even if accepted: orders queued behind it would be late
    if (std::exchange(accepted_, false)) return echo_.is_too_late() ? Result::refused : Result::accepted;
    if (!synchronized_) return Result::none;
    if (now - last_status_ > longest_silence()) return Result::silent;
    if (echo_was_false() || unexpected_count_ >= kStrangeBytes) return Result::out_of_step;
    return busy() ? judge_message(now) : Result::none;
}

/// Echo timeout. Before the last repeat an early repeat does no harm.
base::Microseconds JvlLink::patience() const {
    if (repeat_is_harmless() && resends_ < kMostResends) return echo_.patience();
    return echo_.proof(settings_.proof_time, resends_ == kMostResends);
}

JvlLink::Result JvlLink::judge_message(base::Instant now) {
    if (now - started_ > kLongestMessage) return Result::refused;
    if (stale_count_ < kProofBytes) return Result::none;
    if (resends_ == kMostResends || !echo_.is_known()) return Result::refused;
    if (repeat_is_harmless()) echo_.doubt();
    ++resends_;
    ++resent_;
    rewind(now);
    return Result::none;
}

}  // namespace nplc::motor
