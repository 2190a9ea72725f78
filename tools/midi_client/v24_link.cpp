#include "midi_client/v24_link.h"

#include <fmt/format.h>

#include "protocol/midi_v24.h"
#include "registers/midi.h"

namespace nplc::midi_client {

namespace v24 = protocol::midi_v24;

namespace {

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

V24Link::V24Link(host::ByteClient& wire, const V24Options& options)
    : line_(wire, {.baud = options.baud,
                   .patience = options.patience,
                   .full = "it serves one client at a time",
                   .perhaps_full = "it serves one client at a time, and another one probably holds it; end "
                                   "that one first",
                   .received = [this](std::span<const std::uint8_t> bytes) { count_answers(bytes); }}) {}

Answer V24Link::ask(const Request& request) {
    const auto first = static_cast<std::uint8_t>(request.query ? v24::kFirstQuery : 0);
    const v24::Request message{.address = request.address,
                               .index = static_cast<std::uint8_t>(first + request.number),
                               .sub_index = request.sub_index,
                               .data = request.data};
    const v24::RequestBytes bytes = v24::encode(message);
    line_.settle(true);
    asked_ = request.address;
    counter(asked_).asked();
    sent_.assign(bytes.begin(), bytes.end());
    heard_.clear();
    line_.send(bytes);
    v24::AnswerDecoder decoder;
    decoder.expect(message);
    Answer told;
    const auto take = [&](std::span<const std::uint8_t> received) {
        heard_.insert(heard_.end(), received.begin(), received.end());
        for (const std::uint8_t byte : received) {
            const v24::Answer answer = decoder.receive(byte);
            if (answer.kind == v24::Answer::Kind::none) continue;
            told = answer_of(answer);
            told.by_18h = told.kind == Answer::Kind::refused && byte == v24::kXonErrorInTheField;
            return true;
        }
        return false;
    };
    if (!line_.listen(bytes.size() + kValueBytes, take) && !heard_.empty()) told.kind = Answer::Kind::unclear;
    if (told.kind == Answer::Kind::unclear || told.kind == Answer::Kind::silence) line_.expect_late_answer();
    return told;
}

Answer V24Link::synchronise() {
    return ask({.address = v24::kGeneral, .number = registers::midi::SYNC});
}

base::Microseconds V24Link::exchange_time() const {
    return line_.time_of(v24::RequestBytes{}.size() + kAcceptedBytes);
}

std::string V24Link::last_sent() const {
    return fmt::format("{:02X}", fmt::join(sent_, " "));
}

std::string V24Link::last_heard() const {
    return fmt::format("{:02X}", fmt::join(heard_, " "));
}

/// Either character begins an answer, and no reply holds one. Whose it is it does not say.
void V24Link::count_answers(std::span<const std::uint8_t> bytes) {
    for (const std::uint8_t byte : bytes) {
        if (byte == v24::kAck || byte == v24::kNack) counter(asked_).answered();
    }
}

}  // namespace nplc::midi_client
