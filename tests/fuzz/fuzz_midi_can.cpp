// Any frame at either end of a MIDI module's bus: what is understood is sent the same again, and nothing is
// both a request and an answer.
#include <algorithm>
#include <cstdint>

#include "fuzz.h"
#include "protocol/midi_can.h"

namespace {

using namespace nplc::protocol::midi_can;

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < 3 || size > 11) return 0;
    nplc::base::CanFrame frame{.id = static_cast<std::uint16_t>((data[0] | data[1] << 8) & 0x7FF),
                               .length = static_cast<std::uint8_t>(size - 3)};
    std::copy(data + 3, data + size, frame.data.begin());
    const Request request = decode_request(frame);
    const Answer answer = decode_answer(frame);
    require(request.kind == Request::Kind::none || answer.kind == Answer::Kind::none);
    require(request.address <= kMaxAddress && answer.address <= kMaxAddress);
    if (request.kind != Request::Kind::none && request.kind != Request::Kind::other)
        require(decode_request(encode(request)) == request);
    if (request.kind == Request::Kind::command || request.kind == Request::Kind::query)
        require(encode(request) == frame);
    if (answer.kind != Answer::Kind::none) require(decode_answer(encode_answer(answer)) == answer);
    return 0;
}
