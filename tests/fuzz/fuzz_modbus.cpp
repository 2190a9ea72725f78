// Any bytes with silences on a Modbus line: what is taken for a frame is, byte for byte, what came last, with
// its CRC; a request's values lie in it; a whole frame after a silence is understood after anything.
#include <algorithm>
#include <cstdint>
#include <vector>

#include "fuzz.h"
#include "protocol/modbus_rtu.h"

namespace {

using namespace nplc::protocol::modbus;
using Bytes = std::vector<std::uint8_t>;

void request(std::span<const std::uint8_t> pdu) {
    if (pdu.empty()) return;
    const Decoded decoded = decode(pdu);
    if (decoded.exception != Exception::none) return;
    const Request& asked = decoded.request;
    require(asked.function == pdu[0] && asked.count != 0);
    require(asked.address + asked.count <= 0x10000);
    const auto values = asked.values;
    require(values.empty() ||
            (values.data() >= pdu.data() && values.data() + values.size() <= pdu.data() + pdu.size()));
    if (!asked.writes) {
        Answer answer(asked);
        const bool bits = asked.space == Space::coil || asked.space == Space::discrete_input;
        for (unsigned i = 0; i < asked.count; ++i) {
            if (bits) {
                answer.put_bit(i % 3 == 0);
            } else {
                answer.put_word(static_cast<std::uint16_t>(i));
            }
        }
        require(answer.bytes().size() == 2U + (bits ? (asked.count + 7U) / 8U : 2U * asked.count));
    }
}

void frame(const RtuReader& reader, const Bytes& heard) {
    const auto pdu = reader.pdu();
    const std::size_t size = pdu.size() + 3;
    require(heard.size() >= size);
    const std::span<const std::uint8_t> last(heard.data() + heard.size() - size, size);
    require(last[0] == reader.unit() && std::equal(pdu.begin(), pdu.end(), last.begin() + 1));
    const std::uint16_t crc = crc16(last.first(size - 2));
    require(last[size - 2] == (crc & 0xFFU) && last[size - 1] == crc >> 8U);
    request(pdu);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    request({data, std::min(size, kMostPdu)});
    RtuReader reader;
    Bytes heard;
    for (std::size_t i = 0; i < size; ++i) {
        // FDh is an escape: of a silence, a damaged character, or itself.
        if (data[i] == 0xFD && i + 1 < size && data[i + 1] < 2) {
            if (data[++i] == 1) {
                reader.damaged();
            } else {
                if (reader.silence()) frame(reader, heard);
                heard.clear();
            }
            continue;
        }
        heard.push_back(data[i]);
        if (reader.take(data[i])) frame(reader, heard);
    }
    if (reader.silence()) frame(reader, heard);
    const std::array<std::uint8_t, 5> read = {4, 0, 0, 0, 1};
    const RtuFrame whole(17, read);
    bool is_whole = false;
    for (const std::uint8_t byte : whole.bytes()) is_whole = reader.take(byte);
    require(is_whole && reader.unit() == 17 && std::equal(read.begin(), read.end(), reader.pdu().begin()));
    return 0;
}
