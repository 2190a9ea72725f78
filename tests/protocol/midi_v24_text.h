#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

#include "protocol/midi_v24.h"

namespace nplc::protocol::midi_v24 {

using Kind = Answer::Kind;

/// Stx and Etx around the characters between them.
inline std::string framed(const std::string& inside) {
    return "\x02" + inside + "\x03";
}

template <std::size_t N>
std::string text(const std::array<std::uint8_t, N>& bytes) {
    return {bytes.begin(), bytes.end()};
}

inline std::vector<RequestDecoder::Event> feed(RequestDecoder& decoder, const std::string& bytes) {
    std::vector<RequestDecoder::Event> events;
    for (const char byte : bytes) {
        const auto event = decoder.receive(static_cast<std::uint8_t>(byte));
        if (event.kind != RequestDecoder::Event::Kind::none) events.push_back(event);
    }
    return events;
}

inline std::vector<RequestDecoder::Event> events_in(const std::string& bytes) {
    RequestDecoder decoder;
    return feed(decoder, bytes);
}

inline std::vector<Answer> feed(AnswerDecoder& decoder, const std::string& bytes) {
    std::vector<Answer> answers;
    for (const char byte : bytes) {
        const Answer answer = decoder.receive(static_cast<std::uint8_t>(byte));
        if (answer.kind != Kind::none) answers.push_back(answer);
    }
    return answers;
}

inline std::vector<Answer> answers_in(const Request& request, const std::string& bytes) {
    AnswerDecoder decoder;
    decoder.expect(request);
    return feed(decoder, bytes);
}

}  // namespace nplc::protocol::midi_v24
