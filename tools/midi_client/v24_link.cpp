#include "midi_client/v24_link.h"

#include <fmt/format.h>

#include "protocol/midi_v24.h"
#include "registers/midi.h"

namespace nplc::midi_client {

namespace v24 = protocol::midi_v24;

namespace {

constexpr base::Microseconds kLongestDrain{2'000'000};
constexpr std::size_t kAcceptedBytes = 3;
constexpr std::size_t kValueBytes = kAcceptedBytes + v24::ReplyBytes{}.size();

Answer answer_of(const v24::Answer& heard) {
    using Kind = Answer::Kind;
    switch (heard.kind) {
        case v24::Answer::Kind::accepted:
            return {.kind = Kind::accepted};
        case v24::Answer::Kind::value:
            return {.kind = Kind::value, .value = heard.value};
        case v24::Answer::Kind::refused:
            return {.kind = Kind::refused};
        case v24::Answer::Kind::not_understood:
            return {.kind = Kind::not_taken};
        case v24::Answer::Kind::unclear:
            return {.kind = Kind::unclear};
        case v24::Answer::Kind::none:
            break;
    }
    return {};
}

}  // namespace

Answer V24Link::ask(const Request& request) {
    const auto first = static_cast<std::uint8_t>(request.query ? v24::kFirstQuery : 0);
    const v24::Request message{.address = request.address,
                               .index = static_cast<std::uint8_t>(first + request.number),
                               .sub_index = request.sub_index,
                               .data = request.data};
    const v24::RequestBytes bytes = v24::encode(message);
    settle();
    asked_ = request.address;
    counter(asked_).asked();
    sent_.assign(bytes.begin(), bytes.end());
    heard_.clear();
    if (!wire_.write(bytes)) gone();
    v24::AnswerDecoder decoder;
    decoder.expect(message);
    const base::Instant end = wire_.now() + options_.patience + on_line(bytes.size() + kValueBytes);
    std::array<std::uint8_t, 64> received{};
    for (base::Instant now = wire_.now(); now < end; now = wire_.now()) {
        const std::size_t count = receive(received, end - now);
        heard_.insert(heard_.end(), received.begin(), received.begin() + static_cast<std::ptrdiff_t>(count));
        for (std::size_t i = 0; i < count; ++i) {
            const v24::Answer answer = decoder.receive(received[i]);
            if (answer.kind == v24::Answer::Kind::none) continue;
            unsettled_ = answer.kind == v24::Answer::Kind::unclear;
            Answer told = answer_of(answer);
            told.by_18h = told.kind == Answer::Kind::refused && received[i] == v24::kXonErrorInTheField;
            return told;
        }
    }
    unsettled_ = true;
    return {.kind = heard_.empty() ? Answer::Kind::silence : Answer::Kind::unclear};
}

Answer V24Link::synchronise() {
    return ask({.address = v24::kGeneral, .number = registers::midi::SYNC});
}

base::Microseconds V24Link::exchange_time() const {
    return on_line(v24::RequestBytes{}.size() + kAcceptedBytes);
}

void V24Link::pause(base::Microseconds time) {
    const base::Instant end = wire_.now() + time;
    std::array<std::uint8_t, 64> bytes{};
    for (base::Instant now = wire_.now(); now < end; now = wire_.now()) receive(bytes, end - now);
}

std::string V24Link::last_sent() const {
    return fmt::format("{:02X}", fmt::join(sent_, " "));
}

std::string V24Link::last_heard() const {
    return fmt::format("{:02X}", fmt::join(heard_, " "));
}

/// Reads over what came before the request.
void V24Link::settle() {
    std::array<std::uint8_t, 64> bytes{};
    const base::Instant last = wire_.now() + kLongestDrain;
    const base::Microseconds wait = unsettled_ ? options_.patience : base::Microseconds{0};
    while (receive(bytes, wait) > 0 && wire_.now() < last) {
    }
    unsettled_ = false;
}

std::size_t V24Link::receive(std::span<std::uint8_t> out, base::Microseconds wait) {
    const auto count = wire_.read(out, wait);
    if (!count) gone();
    heard_any_ = heard_any_ || *count > 0;
    // Either character begins an answer, and no reply holds one. Whose it is it does not say.
    for (const std::uint8_t byte : out.first(*count)) {
        if (byte == v24::kAck || byte == v24::kNack) counter(asked_).answered();
    }
    return *count;
}

base::Microseconds V24Link::on_line(std::size_t bytes) const {
    return base::Microseconds{static_cast<std::int64_t>(bytes) * 10'000'000 / options_.baud};
}

void V24Link::gone() {
    const bool socket = name().starts_with("unix:") || name().starts_with("tcp:");
    const std::string other = socket && !heard_any_ ? wire_.other_client() : std::string();
    if (!other.empty())
        throw LineError(
            LineError::Kind::port_gone,
            fmt::format("{}: it serves one client at a time, and {} is connected; end that one first", name(),
                        other));
    throw LineError(
        LineError::Kind::port_gone,
        name() + (socket && !heard_any_
                      ? ": the other end closed the connection before anything came: it serves one client "
                        "at a time, and another one probably holds it; end that one first"
                  : socket ? ": the other end closed the connection; has its program ended?"
                           : ": the other end closed the connection; was the device unplugged, or its "
                             "program ended?"));
}

}  // namespace nplc::midi_client
