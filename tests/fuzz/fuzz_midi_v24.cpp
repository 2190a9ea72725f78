// Any bytes at either end of a MIDI module's serial line: what is reported is, byte for byte, what came last,
// and a whole frame after anything is understood.
#include <algorithm>
#include <cstdint>
#include <span>

#include "fuzz.h"
#include "protocol/midi_v24.h"

namespace {

using namespace nplc::protocol::midi_v24;
using Bytes = std::span<const std::uint8_t>;
using EventKind = RequestDecoder::Event::Kind;

bool ends_with(Bytes bytes, Bytes tail) {
    return bytes.size() >= tail.size() && std::equal(tail.rbegin(), tail.rend(), bytes.rbegin());
}

void feed_module(Bytes bytes) {
    RequestDecoder decoder;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        const auto event = decoder.receive(bytes[i]);
        if (event.kind == EventKind::request) require(ends_with(bytes.first(i + 1), encode(event.request)));
        if (event.kind == EventKind::damaged) require(bytes[i] == kEtx && !decoder.in_frame());
    }
    const Request good{.address = 1, .index = 0x13, .data = 0xABCDEF};
    RequestDecoder::Event last;
    for (const std::uint8_t byte : encode(good)) last = decoder.receive(byte);
    require(last.kind == EventKind::request && last.request == good);
}

void feed_master(Bytes bytes, const Request& request) {
    AnswerDecoder decoder;
    decoder.expect(request);
    bool ack = false;
    bool busy = false;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        ack = ack || bytes[i] == kAck;
        busy = busy || (ack && bytes[i] == kXoff);
        const Answer answer = decoder.receive(bytes[i]);
        if (answer.kind == Answer::Kind::none) continue;
        require(!decoder.waiting());
        if (answer.kind == Answer::Kind::accepted)
            require(busy && bytes[i] == kXon && !is_query(request.index));
        if (answer.kind == Answer::Kind::refused) require(busy);
        if (answer.kind == Answer::Kind::not_understood) require(bytes[i] == kNack);
        if (answer.kind == Answer::Kind::value) {
            require(busy && bytes[i] == kXon && is_query(request.index));
            const ReplyBytes reply = encode_reply(
                {.address = request.address, .digit = digit_of(request.index), .data = answer.value});
            require(std::search(bytes.begin(), bytes.end(), reply.begin(), reply.end()) != bytes.end());
        }
    }
    decoder.expect(request);
    decoder.receive(kAck);
    decoder.receive(kXoff);
    if (is_query(request.index)) {
        const Reply reply{.address = request.address, .digit = digit_of(request.index), .data = 7};
        for (const std::uint8_t byte : encode_reply(reply)) decoder.receive(byte);
    }
    const Answer last = decoder.receive(kXon);
    require(last.kind == (is_query(request.index) ? Answer::Kind::value : Answer::Kind::accepted));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const Bytes bytes(data, size);
    feed_module(bytes);
    feed_master(bytes, {.address = 1, .index = 0x13});
    feed_master(bytes, {.address = 1, .index = 0x20});
    return 0;
}
