#include "fuzz.h"
#include "protocol/fastmac.h"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace {

using namespace nplc::protocol::fastmac;

void check_round_trips(std::uint8_t byte) {
    const auto command = static_cast<std::uint8_t>(byte & kCommandBits);
    for (const RegisterCode code : {RegisterCode::format_list, RegisterCode::older_example}) {
        const Command decoded = decode_command(byte, code);
        require(encode_command(decoded, code) == command);
        require(decoded.number < 32 && decoded.index >= 1 && decoded.index <= 8);
    }
    require(with_toggle(command, (byte & kToggle) != 0) == byte);
    require(encode_status(decode_status(byte)) == byte);
}

/// Any fields, in range or not, give a byte that decodes to the same command.
void check_any_fields(std::uint8_t a, std::uint8_t b, std::uint8_t c) {
    const Command command{static_cast<Mode>(a % 4), static_cast<Group>(a / 4 % 6), b, c};
    const std::uint8_t byte = encode_command(command);
    require((byte & kToggle) == 0);
    require(encode_command(decode_command(byte)) == byte);
}

}  // namespace

// Byte 0: bit 0 safe communication at the start, bit 1 the toggle at the start. The rest is the line, with a
// pause before each FDh. Accepted commands 0Ah, 0Bh and 1Fh have their effect, the last as one FlexMAC
// message.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    CommandReceiver receiver;
    receiver.set_safe((data[0] & 1) != 0);
    if ((data[0] & 2) != 0) receiver.accept_other();
    std::optional<std::uint8_t> before;  // the byte just before, unless something broke the pair
    for (std::size_t i = 1; i < size; ++i) {
        const std::uint8_t byte = data[i];
        check_round_trips(byte);
        if (i >= 3) check_any_fields(data[i - 2], data[i - 1], byte);
        if (byte == 0xFD) {
            receiver.break_pair();
            before.reset();
        }
        const bool toggle = receiver.toggle();
        const bool allowed = ((byte & kToggle) != 0) != toggle && (!receiver.safe() || before == byte);
        CommandReceiver copy = receiver;
        const auto command = receiver.receive(byte);
        require(copy.receive(byte) == command && copy.toggle() == receiver.toggle());
        require(command.has_value() == allowed);
        require(receiver.toggle() == (toggle != allowed));
        require(!command || !copy.receive(byte));  // a repeat does nothing
        before = byte;
        if (!command) continue;
        require(*command == (byte & kCommandBits));
        if (*command == command_byte(Number::safe_communication)) receiver.set_safe(true);
        if (*command == command_byte(Number::rapid_communication)) receiver.set_safe(false);
        if (*command == command_byte(Number::use_flexmac)) receiver.accept_other();
        if ((*command & 0x7E) == 0x6A || *command == command_byte(Number::use_flexmac)) before.reset();
    }
    return 0;
}
