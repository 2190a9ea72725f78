// Any bytes or frames to a virtual MIDI module at any time: it answers the next whole question once it is
// awake.
#include <cstdint>
#include <span>
#include <vector>

#include "fuzz.h"
#include "sim/midi_ends.h"

namespace {

using namespace nplc;
namespace v24 = protocol::midi_v24;
namespace can = protocol::midi_can;
namespace midi = registers::midi;
using Bytes = std::span<const std::uint8_t>;

class Module {
  public:
    explicit Module(bool on_can) : module(midi::Model::mac34_1, {.can = on_can, .address = 1}) {}
    void pass(sim::Time time) {
        now += time;
        module.advance(now);
    }
    /// At rest, for three seconds at full speed take long.
    void wake() {
        require(module.execute(midi::EMERGENCY_STOP, 0, 0) && !module.moving());
        pass(std::chrono::seconds{3});
    }

    sim::MidiModule module;
    sim::Time now{0};
};

/// Frames, since random bytes rarely have the right checksum: index and four bytes of data, or raw bytes.
void speak_v24(Bytes six, sim::MidiV24End& end) {
    if (six[0] % 4 == 0) {
        for (const std::uint8_t byte : six) end.receive(byte, byte == 0x77);
        return;
    }
    const auto data = static_cast<std::uint32_t>(six[2] << 24 | six[3] << 16 | six[4] << 8 | six[5]);
    const auto index = static_cast<std::uint8_t>(six[1] % 0x30);
    for (const std::uint8_t byte : v24::encode({.address = 1, .index = index, .data = data}))
        end.receive(byte, false);
}

void check_v24(Bytes bytes) {
    Module one(false);
    sim::MidiV24End end(one.module);
    for (; bytes.size() >= 6; bytes = bytes.subspan(6)) {
        speak_v24(bytes, end);
        while (end.transmit()) continue;
        one.pass(std::chrono::microseconds{bytes[0] * 10});
    }
    one.wake();
    // 08h may have given it another address.
    for (const std::uint8_t byte : v24::encode({.address = one.module.memory().address, .index = 0x24}))
        end.receive(byte, false);
    std::size_t count = 0;
    while (end.transmit()) ++count;
    require(count == 21);
}

void check_can(Bytes bytes) {
    Module one(true);
    sim::MidiCanEnd end(one.module);
    for (; bytes.size() >= 6; bytes = bytes.subspan(6)) {
        const std::uint16_t ids[] = {0x601, 0x600, 0x7E5, 0x080};
        base::CanFrame frame{.id = ids[bytes[0] % 4], .length = static_cast<std::uint8_t>(bytes[0] / 4 % 9)};
        frame.data = {bytes[0] % 2 == 0 ? std::uint8_t{0x23} : bytes[2],
                      bytes[1],
                      0x20,
                      0,
                      bytes[2],
                      bytes[3],
                      bytes[4],
                      bytes[5]};
        end.receive(frame);
        while (end.transmit()) continue;
        one.pass(std::chrono::microseconds{bytes[0] * 10});
    }
    one.wake();
    while (end.transmit()) continue;
    const std::uint8_t address = one.module.memory().address;
    const can::Request question{.kind = can::Request::Kind::query, .address = address, .index = 0x2004};
    end.receive(can::encode(question));
    const auto answer = end.transmit();
    require(answer && can::answers(can::decode_answer(*answer), question) && !end.transmit());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size > 240) return 0;
    check_v24({data, size});
    check_can({data, size});
    return 0;
}
