#include "midi_client/can_link.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace nplc::midi_client {

namespace can = protocol::midi_can;

namespace {

/// Time in which a second module would have answered, too.
constexpr base::Microseconds kOthers{50'000};

std::string words_of(const ports::CanFrame& frame) {
    std::string text = fmt::format("{:03X}#", frame.id);
    for (std::size_t i = 0; i < frame.length; ++i) text += fmt::format("{:02X}", frame.data[i]);
    return text;
}

std::uint8_t answerer_of(std::uint8_t address) {
    return address == can::kGeneral ? std::uint8_t{1} : address;
}

can::Request message_of(const Request& request) {
    return {.kind = request.query ? can::Request::Kind::query : can::Request::Kind::command,
            .address = request.address,
            .index = static_cast<std::uint16_t>(can::kIndices + request.number),
            .sub_index = request.sub_index,
            .data = request.data};
}

}  // namespace

Answer CanLink::ask(const Request& request) {
    const can::Request message = message_of(request);
    drain();
    send(message);
    counter(answerer_of(request.address)).asked();
    const base::Instant end = can_.now() + options_.patience;
    for (base::Instant now = can_.now(); now < end; now = can_.now()) {
        const can::Answer answer = hear(end - now);
        if (!can::answers(answer, message)) continue;
        if (answer.kind == can::Answer::Kind::accepted) return {.kind = Answer::Kind::accepted};
        if (answer.kind == can::Answer::Kind::value)
            return {.kind = Answer::Kind::value, .value = answer.data};
        return {.kind = Answer::Kind::refused};
    }
    heard_.clear();
    return {};
}

Answer CanLink::synchronise() {
    drain();
    send({.kind = can::Request::Kind::sync});
    return {.kind = Answer::Kind::accepted};
}

void CanLink::pause(base::Microseconds time) {
    const base::Instant end = can_.now() + time;
    for (base::Instant now = can_.now(); now < end; now = can_.now()) hear(end - now);
}

CanLink::Programmed CanLink::program_address(std::uint8_t address) {
    using Say = can::Answer::Kind;
    drain();
    send({.kind = can::Request::Kind::configure});
    send({.kind = can::Request::Kind::set_address, .data = address});
    unsigned taken = 0;
    unsigned refused = 0;
    base::Instant end = can_.now() + options_.patience;
    while (can_.now() < end) {
        const Say kind = hear(end - can_.now()).kind;
        if (kind != Say::address_taken && kind != Say::address_refused) continue;
        ++(kind == Say::address_taken ? taken : refused);
        end = std::min(end, can_.now() + kOthers);
    }
    if (taken + refused > 1) return Programmed::several;
    // Whatever it answered, the module is in configuration state: it is always switched back to operation.
    send({.kind = can::Request::Kind::operate});
    if (taken == 0) return refused != 0 ? Programmed::refused : Programmed::silence;
    end = can_.now() + options_.longest_boot;
    while (can_.now() < end) {
        const can::Answer answer = hear(end - can_.now());
        if (answer.kind == Say::booted && answer.address == address) return Programmed::done;
    }
    return Programmed::silence;
}

bool CanLink::take_boot(std::uint8_t address) {
    drain();
    const bool booted = boots_.test(address);
    boots_.reset(address);
    return booted;
}

bool CanLink::take_foreign_sync() {
    drain();
    return std::exchange(foreign_sync_, false);
}

void CanLink::send(const can::Request& request) {
    const ports::CanFrame frame = can::encode(request);
    sent_ = words_of(frame);
    heard_.clear();
    if (can_.write(frame)) return;
    const ports::CanState state = can_.state();
    throw LineError(
        LineError::Kind::port_gone,
        name() + (can_.gone() ? ": the interface is gone; was the adapter unplugged?"
                  : state == ports::CanState::down
                      ? fmt::format(": the interface is down; as root: ip link set {} up", name().substr(4))
                  : state == ports::CanState::bus_off
                      ? std::string(
                            ": the controller went off the bus: are bit rate, wiring and terminators right?")
                      : std::string(": nobody takes the frames: is a module connected, switched on, and at "
                                    "this bit rate?")));
}

can::Answer CanLink::hear(base::Microseconds wait) {
    const auto frame = can_.read(wait);
    if (!frame) {
        if (can_.gone())
            throw LineError(LineError::Kind::port_gone,
                            name() + ": the interface is gone; was the adapter unplugged?");
        return {};
    }
    heard_any_ = heard_any_ || (!frame->extended && !frame->remote);
    return take(*frame);
}

/// Discards what was received before the request.
void CanLink::drain() {
    while (const auto frame = can_.read(base::Microseconds{0})) take(*frame);
}

/// Requests of other masters are answered too; a broadcast is answered by the module at address 1 (003 §V.8).
can::Answer CanLink::take(const ports::CanFrame& frame) {
    if (frame.extended || frame.remote) return {};
    const can::Request request = can::decode_request(frame);
    using Ask = can::Request::Kind;
    foreign_sync_ = foreign_sync_ || request.kind == Ask::sync;
    if (request.kind == Ask::command || request.kind == Ask::query || request.kind == Ask::other)
        counter(answerer_of(request.address)).asked_by_other();
    const can::Answer answer = can::decode_answer(frame);
    using Say = can::Answer::Kind;
    if (answer.kind == Say::booted) boots_.set(answer.address);
    if (answer.kind == Say::accepted || answer.kind == Say::value || answer.kind == Say::refused)
        counter(answer.address).answered();
    if (answer.kind != Say::none) heard_ = words_of(frame);
    return answer;
}

}  // namespace nplc::midi_client
