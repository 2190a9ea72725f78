#include "motor/midi_can_link.h"

#include <utility>

namespace nplc::motor {
namespace {

namespace can = protocol::midi_can;
using Kind = MidiOutcome::Kind;

constexpr int kReadsPerPoll = 64;
constexpr std::uint32_t kWholeId = 0x7FF;

}  // namespace

MidiCanLink::MidiCanLink(ports::CanPort& port, const Settings& settings) : port_(port), settings_(settings) {
    const ports::CanFilter filters[]{{.id = unsigned{can::kFromModule} + settings.address, .mask = kWholeId},
                                     {.id = unsigned{can::kBootUp} + settings.address, .mask = kWholeId}};
    static_cast<void>(port_.filter(filters));  // without them more comes in, and is passed over
}

void MidiCanLink::begin(const MidiMessage& message, base::Instant now) {
    static_cast<void>(receive());  // of a message that is over
    request_ = {.kind = message.is_query ? can::Request::Kind::query : can::Request::Kind::command,
                .address = settings_.address,
                .index = static_cast<std::uint16_t>(can::kIndices + message.number),
                .sub_index = message.sub_index,
                .data = message.data};
    busy_ = true;
    written_ = !booted_ && write(can::encode(request_));  // who has booted is to be told of first
    deadline_ = written_ ? now + settings_.longest_answer : now;
    watch_bus(now);
}

MidiOutcome MidiCanLink::poll(base::Instant now) {
    MidiOutcome outcome = receive();
    if (!busy_) return {};
    if (outcome.kind == Kind::none && now >= deadline_)
        outcome.kind = written_ ? Kind::unclear : Kind::not_taken;
    if (outcome.kind != Kind::none) busy_ = false;
    watch_bus(now);
    return outcome;
}

MidiOutcome MidiCanLink::receive() {
    MidiOutcome outcome;
    ports::CanFrame frame;
    for (int i = 0; i < kReadsPerPoll && port_.read(frame); ++i) {
        if (frame.extended || frame.remote) continue;
        const can::Answer answer =
            can::decode_answer({static_cast<std::uint16_t>(frame.id), frame.length, frame.data});
        if (answer.kind == can::Answer::Kind::booted)
            booted_ = booted_ || answer.address == settings_.address;
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

bool MidiCanLink::write(const can::Frame& frame) {
    return port_.write({.id = frame.id, .length = frame.size, .data = frame.data});
}

void MidiCanLink::watch_bus(base::Instant now) {
    if (port_.state() != ports::CanState::bus_off || now < may_restart_) return;
    static_cast<void>(port_.restart());
    may_restart_ = now + settings_.restart_pause;
}

bool MidiCanLink::take_boot() {
    return std::exchange(booted_, false);
}

}  // namespace nplc::motor
