// Any bytes at either end: what is reported is, byte for byte, what came last, and a whole message after
// anything is understood.
#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>

#include "fuzz.h"
#include "protocol/mactalk.h"

namespace {

using namespace nplc::protocol::mactalk;

bool ends_with(std::span<const std::uint8_t> bytes, std::span<const std::uint8_t> tail) {
    return bytes.size() >= tail.size() && std::equal(tail.rbegin(), tail.rend(), bytes.rbegin());
}

void feed_unit(std::span<const std::uint8_t> bytes) {
    RequestDecoder decoder;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        const auto request = decoder.receive(bytes[i]);
        if (request) require(ends_with(bytes.first(i + 1), encode(*request).view()));
    }
    const Request good{.kind = Kind::read, .address = 8, .reg = 5};
    std::optional<Request> last;
    const EncodedRequest encoded = encode(good);
    for (const std::uint8_t byte : encoded.view()) last = decoder.receive(byte);
    require(last && *last == good);
}

void feed_master(std::span<const std::uint8_t> bytes, Answer answer, std::size_t data_bytes) {
    ReplyDecoder decoder;
    decoder.expect(answer, data_bytes);
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        const auto reply = decoder.receive(bytes[i]);
        if (!reply) continue;
        require(reply->length == data_bytes);
        const EncodedReply again = answer == Answer::accept    ? encode_accept()
                                   : answer == Answer::samples ? encode_samples(reply->view())
                                                               : encode_registers(reply->reg, reply->view());
        require(ends_with(bytes.first(i + 1), again.view()));
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::span bytes(data, size);
    feed_unit(bytes);
    feed_master(bytes, Answer::none, 0);
    feed_master(bytes, Answer::accept, 0);
    feed_master(bytes, Answer::registers, kReadBytes);
    feed_master(bytes, Answer::registers, kBlockBytes);
    feed_master(bytes, Answer::samples, kSampleBytes);
    feed_master(bytes, Answer::samples, kMac800SampleBytes);
    return 0;
}
