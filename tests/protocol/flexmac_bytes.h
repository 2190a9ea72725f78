#pragma once

#include "protocol/flexmac.h"

#include <cstdint>
#include <initializer_list>
#include <iomanip>
#include <sstream>
#include <string>
#include <vector>

namespace nplc::protocol::flexmac {

using ByteList = std::vector<std::uint8_t>;

inline ByteList list(const Encoded& encoded) {
    return {encoded.view().begin(), encoded.view().end()};
}

inline std::string hex(const ByteList& bytes) {
    std::ostringstream text;
    text << std::hex << std::uppercase << std::setfill('0');
    for (const std::uint8_t byte : bytes) text << std::setw(2) << static_cast<int>(byte) << ' ';
    return text.str();
}

/// Every message that the bytes complete, in their order.
inline std::vector<Message> feed(RequestDecoder& decoder, const ByteList& bytes) {
    std::vector<Message> messages;
    for (const std::uint8_t byte : bytes) {
        if (const auto message = decoder.receive(byte)) messages.push_back(*message);
    }
    return messages;
}

/// The same from power-up, with a pause after the last byte.
inline std::vector<Message> messages_in(const ByteList& bytes) {
    RequestDecoder decoder;
    return feed(decoder, bytes);
}

struct Heard {
    ByteList status;
    std::vector<Message> replies;
};

inline Heard feed(ReplyDecoder& decoder, const ByteList& bytes) {
    Heard heard;
    for (const std::uint8_t byte : bytes) {
        const ReplyDecoder::Event event = decoder.receive(byte);
        if (event.kind == ReplyDecoder::Event::Kind::status) heard.status.push_back(event.status);
        if (event.kind == ReplyDecoder::Event::Kind::reply) heard.replies.push_back(event.reply);
    }
    return heard;
}

/// Messages of all twelve forms, with the targets and values that come nearest to confusing a decoder: bytes
/// equal to the header, to its inverse, 00h and FFh.
inline std::vector<Message> telling_messages() {
    const std::vector<std::uint16_t> registers{1, 5, 10, 0x60, 0x70, 0x9F, 0xE0, 0xF0, 0xFF};
    const std::vector<std::uint16_t> addresses{0x0000, 0x0412, 0x041C, 0x0500, 0x00FF, 0xFF00,
                                               0xFFFF, 0x6060, 0xE0E0, 0xF0F0, 0x7070};
    std::vector<Message> messages;
    const auto add = [&](bool read, bool longword, Level level, std::uint16_t target, std::uint8_t header) {
        const std::uint32_t h = header;
        const std::uint32_t n = static_cast<std::uint8_t>(~header);
        const std::vector<std::uint32_t> values{0,
                                                0xFFFFFFFF,
                                                0x00000547,
                                                0x12345678,
                                                0xFF00FF00,
                                                h | h << 8 | h << 16 | h << 24,
                                                n | n << 8 | n << 16 | n << 24,
                                                h | n << 8 | h << 16 | n << 24};
        for (const std::uint32_t value : values) {
            const std::uint32_t cut = longword ? value : value & 0xFFFF;
            messages.push_back({read, longword, level, target, read ? 0 : cut});
            if (read) break;
        }
    };
    for (const bool read : {false, true}) {
        for (const bool longword : {false, true}) {
            const int base = 0x60 | (longword ? 0x80 : 0) | (read ? 0x10 : 0);
            const int indices = read && longword ? 13 : 15;
            for (int i = 1; i <= indices; ++i) {
                add(read, longword, Level::index, static_cast<std::uint16_t>(i),
                    static_cast<std::uint8_t>(base + i));
            }
            for (const auto r : registers)
                add(read, longword, Level::reg, r, static_cast<std::uint8_t>(base));
            for (const auto a : addresses) {
                add(read, longword, Level::address, a, static_cast<std::uint8_t>(base));
            }
        }
    }
    return messages;
}

}  // namespace nplc::protocol::flexmac
