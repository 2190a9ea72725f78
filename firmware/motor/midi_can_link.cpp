#include "motor/midi_can_link.h"

#include <algorithm>
#include <utility>

namespace nplc::motor {
namespace {

namespace can = protocol::midi_can;
using Kind = MidiOutcome::Kind;

constexpr int kReadsPerPoll = 64;
constexpr base::Microseconds kRestartPause{100'000};
constexpr std::uint32_t kWholeId = 0x7FF;
/// Retry interval while the port has no room: a frame of 8 bytes takes 0.9 ms at 125 kbit/s.
constexpr base::Microseconds kOfferAgain{1'000};

}  // namespace

MidiCanLink::MidiCanLink(ports::CanPort& port, const Settings& settings)
    : port_(port), address_(settings.address) {
    const unsigned address = address_;
    // The module at address 1 also answers requests to all modules (600h).
    const std::uint32_t mask = address == 1 ? kWholeId & ~1U : kWholeId;
    const ports::CanFilter filters[]{{.id = can::kFromModule + address, .mask = kWholeId},
                                     {.id = can::kBootUp + address, .mask = kWholeId},
                                     {.id = (can::kToModule + address) & mask, .mask = mask}};
    static_cast<void>(port_.filter(filters));  // without filters other frames arrive too and are ignored
}

void MidiCanLink::begin(const MidiMessage& message, base::Instant now) {
    static_cast<void>(receive());  // left over from an earlier message
    request_ = {.kind = message.is_query ? can::Request::Kind::query : can::Request::Kind::command,
                .address = address_,
                .index = static_cast<std::uint16_t>(can::kIndices + message.number),
                .sub_index = message.sub_index,
                .data = message.data};
    busy_ = true;
    written_ = false;
    deadline_ = now + kLongestAnswer;
    watch_bus(now);
    transmit(now);
}

MidiOutcome MidiCanLink::poll(base::Instant now) {
    MidiOutcome outcome = receive();
    watch_bus(now);
    if (!busy_) return {};
    if (outcome.kind == Kind::none && !written_ && now < deadline_) transmit(now);
    if (outcome.kind == Kind::none && (cut_ || now >= deadline_))
        outcome.kind = written_ ? Kind::unclear : Kind::not_taken;
    if (outcome.kind != Kind::none) busy_ = false;
    return outcome;
}

base::Instant MidiCanLink::next_poll(base::Instant now) const {
    if (!busy_) return base::kNever;
    return written_ ? deadline_ : std::min(deadline_, now + kOfferAgain);
}

MidiOutcome MidiCanLink::receive() {
    MidiOutcome outcome;
    ports::CanFrame frame;
    for (int i = 0; i < kReadsPerPoll && port_.read(frame); ++i) {
        if (frame.extended || frame.remote) continue;
        const can::Answer answer = can::decode_answer(frame);
        count(frame, answer);
        if (answer.kind == can::Answer::Kind::booted) booted_ = booted_ || answer.address == address_;
        if (!busy_ || !written_ || outcome.kind != Kind::none || !can::answers(answer, request_)) continue;
        switch (answer.kind) {
            case can::Answer::Kind::accepted:
                outcome.kind = Kind::accepted;
                break;
            case can::Answer::Kind::value:
                outcome = {Kind::value, answer.data};
                break;
            default:
                outcome.kind = Kind::refused;
                break;
        }
    }
    return outcome;
}

/// Other masters' requests are counted too, since they are answered.
void MidiCanLink::count(const ports::CanFrame& frame, const can::Answer& answer) {
    using AnswerKind = can::Answer::Kind;
    const bool answers = answer.kind == AnswerKind::accepted || answer.kind == AnswerKind::value ||
                         answer.kind == AnswerKind::refused;
    if (answers && answer.address == address_) return answers_.answered();
    const can::Request request = can::decode_request(frame);
    const bool asks = request.kind == can::Request::Kind::command ||
                      request.kind == can::Request::Kind::query || request.kind == can::Request::Kind::other;
    const bool to_it = request.address == address_ || (request.address == can::kGeneral && address_ == 1);
    if (asks && to_it) answers_.asked_by_other();
}

/// A boot-up must be reported before anything is sent.
void MidiCanLink::transmit(base::Instant now) {
    if (booted_ || cut_) {
        deadline_ = now;
    } else if (port_.write(can::encode(request_))) {
        written_ = true;
        answers_.asked();
        deadline_ = now + kLongestAnswer;
    }
}

void MidiCanLink::watch_bus(base::Instant now) {
    const ports::CanState state = port_.state();
    cut_ = state == ports::CanState::down || state == ports::CanState::bus_off;
    if (state != ports::CanState::bus_off || now < may_restart_) return;
    static_cast<void>(port_.restart());
    may_restart_ = now + kRestartPause;
}

BusFault MidiCanLink::trouble() const {
    if (cut_) return BusFault::no_bus;
    return answers_.several() ? BusFault::several : BusFault::none;
}

bool MidiCanLink::take_boot() {
    return std::exchange(booted_, false);
}

}  // namespace nplc::motor
