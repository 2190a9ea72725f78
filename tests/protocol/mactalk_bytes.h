#pragma once

#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

#include "protocol/mactalk.h"

namespace nplc::protocol::mactalk {

using ByteList = std::vector<std::uint8_t>;

/// "52 52 52 08 F7": bytes as the manuals print them.
inline ByteList bytes(const std::string& text) {
    std::istringstream stream(text);
    ByteList result;
    for (unsigned value = 0; stream >> std::hex >> value;) result.push_back(static_cast<std::uint8_t>(value));
    return result;
}

template <std::size_t N>
ByteList list(const Encoded<N>& encoded) {
    return {encoded.view().begin(), encoded.view().end()};
}

inline std::vector<Request> feed(RequestDecoder& decoder, const ByteList& line) {
    std::vector<Request> requests;
    for (const std::uint8_t byte : line) {
        if (const auto request = decoder.receive(byte)) requests.push_back(*request);
    }
    return requests;
}

inline std::vector<Request> requests_in(const ByteList& line) {
    RequestDecoder decoder;
    return feed(decoder, line);
}

inline std::vector<Reply> replies_in(const ByteList& line, Answer answer, std::size_t data_bytes) {
    ReplyDecoder decoder;
    decoder.expect(answer, data_bytes);
    std::vector<Reply> replies;
    for (const std::uint8_t byte : line) {
        if (const auto reply = decoder.receive(byte)) replies.push_back(*reply);
    }
    return replies;
}

inline std::uint32_t value_of(const Reply& reply) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < reply.length && i < 4; ++i)
        value |= static_cast<std::uint32_t>(reply.data[i]) << (8 * i);
    return value;
}

inline ByteList operator+(ByteList a, const ByteList& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

}  // namespace nplc::protocol::mactalk
