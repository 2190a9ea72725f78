#include "motor/midi_v24_link.h"

#include <algorithm>

#include "motor/stop_pace.h"
#include "registers/midi.h"

namespace nplc::motor {
namespace {

namespace v24 = protocol::midi_v24;
using Kind = MidiOutcome::Kind;

constexpr int kReadsPerPoll = 64;
constexpr base::Microseconds kQuiet{5'000};
/// The longest answer: Ack, Xoff, a reply, Xon.
constexpr int kAnswerCharacters = 3 + v24::kAround + v24::kReplyFields;

base::Microseconds character_time(std::uint32_t baud) {
    return base::Microseconds((10'000'000U + baud - 1) / baud);
}

Kind kind_of(v24::Answer::Kind kind) {
    switch (kind) {
        case v24::Answer::Kind::none:
            return Kind::none;
        case v24::Answer::Kind::accepted:
            return Kind::accepted;
        case v24::Answer::Kind::value:
            return Kind::value;
        case v24::Answer::Kind::refused:
            return Kind::refused;
        case v24::Answer::Kind::not_understood:
            return Kind::not_taken;
        case v24::Answer::Kind::unclear:
            break;
    }
    return Kind::unclear;
}

}  // namespace

MidiV24Link::MidiV24Link(ports::SerialPort& port, const Settings& settings)
    : port_(port), address_(settings.address), character_(character_time(settings.baud)) {}

void MidiV24Link::begin(const MidiMessage& message, base::Instant now) {
    const unsigned index = message.is_query ? v24::kFirstQuery + message.number : message.number;
    const v24::Request request{.address = address_,
                               .index = static_cast<std::uint8_t>(index),
                               .sub_index = message.sub_index,
                               .data = message.data};
    is_urgent_ = message.number == registers::midi::EMERGENCY_STOP;  // no query has its number
    bytes_ = v24::encode(request);
    decoder_.expect(request);
    deadline_ = now + kLongestAnswer;
    state_ = State::waiting_for_quiet;
    static_cast<void>(poll(now));
}

MidiOutcome MidiV24Link::poll(base::Instant now) {
    const MidiOutcome outcome = receive(now);
    if (outcome.kind != Kind::none || state_ == State::idle) return outcome;
    if (state_ == State::waiting_for_quiet) {
        // A line that never falls silent carries no request: it has not been taken.
        if (noisy_ && !is_urgent_ && now - heard_ < kQuiet)
            return now < deadline_ ? MidiOutcome{} : finish(Kind::not_taken);
        noisy_ = spoilt_ = heard_any_ = false;
        answers_.asked();
        sent_ = 0;
        state_ = State::under_way;
        deadline_ = now + (static_cast<int>(bytes_.size()) + kAnswerCharacters) * character_ + kLongestAnswer;
    }
    if (now >= deadline_) {
        noisy_ = true;
        heard_ = now;
        return finish(sent_ == 0 ? Kind::not_taken : Kind::unclear);
    }
    transmit();
    return {};
}

void MidiV24Link::transmit() {
    if (sent_ == bytes_.size()) return;
    sent_ = static_cast<std::uint8_t>(sent_ + port_.write(std::span(bytes_).subspan(sent_)));
}

MidiOutcome MidiV24Link::receive(base::Instant now) {
    std::array<ports::ReceivedByte, 16> bytes;
    MidiOutcome outcome;
    for (int i = 0; i < kReadsPerPoll; ++i) {
        const std::size_t count = port_.read(bytes);
        for (const auto& byte : std::span(bytes).first(count)) {
            heard_ = now;
            heard_any_ = true;
            note_answer(byte);
            if (state_ != State::under_way || outcome.kind != Kind::none) {
                noisy_ = true;
                continue;
            }
            spoilt_ = spoilt_ || byte.framing_error;
            if (byte.framing_error) continue;
            const v24::Answer answer = decoder_.receive(byte.value);
            if (answer.kind == v24::Answer::Kind::none) continue;
            outcome = finish(spoilt_ ? Kind::unclear : kind_of(answer.kind), answer.value);
        }
        if (count < bytes.size()) break;
    }
    return outcome;
}

void MidiV24Link::withdraw() {
    if (state_ == State::waiting_for_quiet || sent_ == 0) state_ = State::idle;
}

/// Either character begins an answer, and no reply contains one.
void MidiV24Link::note_answer(const ports::ReceivedByte& byte) {
    if (!byte.framing_error && (byte.value == v24::kAck || byte.value == v24::kNack)) answers_.answered();
}

MidiOutcome MidiV24Link::finish(Kind kind, std::uint32_t value) {
    state_ = State::idle;
    decoder_.abandon();
    noisy_ = noisy_ || kind == Kind::unclear;
    return {kind, value, kind == Kind::unclear && heard_any_};
}

base::Instant MidiV24Link::next_poll(base::Instant now) const {
    if (state_ == State::idle) return base::kNever;
    base::Instant next = deadline_;
    if (state_ == State::waiting_for_quiet) next = std::min(next, heard_ + kQuiet);
    if (state_ == State::under_way && sent_ < bytes_.size()) next = std::min(next, now + character_);
    return next;
}

}  // namespace nplc::motor
