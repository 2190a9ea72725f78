#include "fuzz.h"
#include "protocol/flexmac.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace {

using namespace nplc::protocol::flexmac;
using Bytes = std::span<const std::uint8_t>;
using Kind = ReplyDecoder::Event::Kind;

bool ends_with(Bytes bytes, Bytes tail) {
    if (bytes.size() < tail.size()) return false;
    return std::equal(tail.begin(), tail.end(), bytes.last(tail.size()).begin());
}

bool same(const ReplyDecoder::Event& a, const ReplyDecoder::Event& b) {
    return a.kind == b.kind && a.status == b.status && a.reply == b.reply;
}

/// A message is the bytes that came last, all of them after the last pause.
void check_requests(Bytes line, std::size_t pause, std::size_t split) {
    RequestDecoder decoder;
    RequestDecoder copy;
    std::size_t since = 0;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (i == pause) {
            decoder.abandon();
            copy.abandon();
            since = i;
        }
        if (i == split) copy = decoder;  // a copied decoder goes on like the first
        const auto message = decoder.receive(line[i]);
        if (i >= split) require(copy.receive(line[i]) == message);
        require(decoder.in_message() || message.has_value() || (line[i] & 0x60) != 0x60 || line[i] >= 0xFE);
        if (!message) continue;
        require(!decoder.in_message());
        require(!message->read || message->value == 0);
        require(ends_with(line.subspan(since, i + 1 - since), encode(*message).view()));
    }
    decoder.abandon();
    const Message good{.target = 3, .value = 0x0547};
    const Encoded encoded = encode(good);
    for (std::size_t i = 0; i < encoded.size; ++i) {
        const auto message = decoder.receive(encoded.bytes[i]);
        require(message.has_value() == (i + 1 == encoded.size));
        if (message) require(*message == good);
    }
}

/// A reply is the bytes that came last; a status byte is the last one and no header byte; a few equal status
/// bytes bring the decoder back in step from anywhere.
void check_replies(Bytes line, std::size_t error, std::size_t split) {
    ReplyDecoder decoder;
    ReplyDecoder copy;
    std::size_t since = 0;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (i == error) {
            decoder.abandon();
            copy.abandon();
            since = i;
        }
        if (i == split) copy = decoder;
        const auto event = decoder.receive(line[i]);
        if (i >= split) require(same(copy.receive(line[i]), event));
        if (event.kind == Kind::status) require(event.status == line[i] && (line[i] & 0x60) != 0x60);
        if (event.kind != Kind::reply) continue;
        require(event.reply.read && !is_protocol_command(event.reply));
        const Encoded encoded = encode_reply(event.reply, event.reply.value);
        require(encoded.size != 0 && ends_with(line.subspan(since, i + 1 - since), encoded.view()));
    }
    ReplyDecoder::Event event;
    for (int i = 0; i < 5; ++i) event = decoder.receive(0x18);
    require(event.kind == Kind::status && event.status == 0x18);
}

/// Whatever stands in a message, it either cannot be sent or comes back cut to its width.
void check_encode(Bytes bytes) {
    if (bytes.size() < 8) return;
    Message message{.read = (bytes[0] & 1) != 0, .longword = (bytes[0] & 2) != 0};
    message.level = static_cast<Level>(bytes[1] % 3);
    message.target = static_cast<std::uint16_t>(bytes[2] | (bytes[0] & 4 ? bytes[3] << 8 : 0));
    message.value = static_cast<std::uint32_t>(bytes[4] | bytes[5] << 8 | bytes[6] << 16) |
                    static_cast<std::uint32_t>(bytes[7]) << 24;
    const std::uint32_t cut = message.longword ? message.value : message.value & 0xFFFF;
    const Encoded encoded = encode(message);
    require(encoded.size <= kMaxBytes);
    RequestDecoder motor;
    for (std::size_t i = 0; i < encoded.size; ++i) {
        const auto got = motor.receive(encoded.bytes[i]);
        require(got.has_value() == (i + 1 == encoded.size));
        if (!got) continue;
        Message expected = message;
        expected.value = message.read ? 0 : cut;
        require(*got == expected);
    }
    const Encoded reply = encode_reply(message, message.value);
    require(reply.size == 0 || (message.read && encoded.size != 0));
    ReplyDecoder master;
    for (std::size_t i = 0; i < reply.size; ++i) {
        const auto got = master.receive(reply.bytes[i]);
        require((got.kind == Kind::reply) == (i + 1 == reply.size));
        if (got.kind == Kind::reply) require(got.reply.value == cut && got.reply.target == message.target);
    }
}

}  // namespace

// Byte 0: where the line pauses, byte 1: where a copy of the decoder takes over, the rest: the line.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < 2) return 0;
    const Bytes line(data + 2, size - 2);
    check_requests(line, data[0], data[1]);
    check_replies(line, data[0], data[1]);
    check_encode(line);
    return 0;
}
