#include "protocol/fastmac.h"

#include <array>

namespace nplc::protocol::fastmac {
namespace {

struct Range {
    Group group;
    std::uint8_t first;  // of bits 4..0
    std::uint8_t size;   // a power of two
};

using Code = std::array<Range, 6>;

// R: according to the list of 001 §5.2.1.4, not the bytes of §5.2.1.5.
constexpr Code kFormatList{{{Group::p, 0x00, 8},
                            {Group::v, 0x08, 8},
                            {Group::a, 0x10, 4},
                            {Group::t, 0x14, 4},
                            {Group::l, 0x18, 4},
                            {Group::z, 0x1C, 4}}};

// R: the positions of T, L and Z are assumed; §5.2.1.5 shows A, V and P only.
constexpr Code kOlderExample{{{Group::a, 0x00, 4},
                              {Group::t, 0x04, 4},
                              {Group::l, 0x08, 4},
                              {Group::z, 0x0C, 4},
                              {Group::v, 0x10, 8},
                              {Group::p, 0x18, 8}}};

constexpr const Code& ranges(RegisterCode code) {
    return code == RegisterCode::older_example ? kOlderExample : kFormatList;
}

constexpr std::uint8_t kNumberBits = 0x1F;

constexpr std::uint8_t bit(bool set, int position) {
    return static_cast<std::uint8_t>(set ? 1 << position : 0);
}

}  // namespace

Command decode_command(std::uint8_t byte, RegisterCode code) {
    Command command;
    command.mode = static_cast<Mode>((byte >> 5) & 3);
    const auto low = static_cast<std::uint8_t>(byte & kNumberBits);
    if (command.mode == Mode::command) {
        command.number = low;
        return command;
    }
    for (const Range& range : ranges(code)) {
        if (low < range.first || low >= range.first + range.size) continue;
        command.group = range.group;
        command.index = static_cast<std::uint8_t>(low - range.first + 1);
    }
    return command;
}

std::uint8_t encode_command(const Command& command, RegisterCode code) {
    const auto mode = static_cast<std::uint8_t>((static_cast<std::uint8_t>(command.mode) & 3) << 5);
    if (command.mode == Mode::command)
        return static_cast<std::uint8_t>(mode | (command.number & kNumberBits));
    for (const Range& range : ranges(code)) {
        if (range.group != command.group) continue;
        return static_cast<std::uint8_t>(mode | range.first | ((command.index - 1) & (range.size - 1)));
    }
    return mode;
}

Status decode_status(std::uint8_t byte) {
    return {.toggle = (byte & 0x80) != 0,
            .decelerating = (byte & 0x40) != 0,
            .accelerating = (byte & 0x20) != 0,
            .in_position = (byte & 0x10) != 0,
            .flexmac = (byte & 0x08) != 0,
            .framing_error = (byte & 0x04) != 0,
            .available = (byte & 0x02) != 0,
            .error = (byte & 0x01) != 0};
}

std::uint8_t encode_status(const Status& status) {
    return static_cast<std::uint8_t>(bit(status.toggle, 7) | bit(status.decelerating, 6) |
                                     bit(status.accelerating, 5) | bit(status.in_position, 4) |
                                     bit(status.flexmac, 3) | bit(status.framing_error, 2) |
                                     bit(status.available, 1) | bit(status.error, 0));
}

std::optional<std::uint8_t> CommandReceiver::receive(std::uint8_t byte) {
    const bool twice = previous_ == byte;
    previous_ = byte;
    if (safe_ && !twice) return std::nullopt;
    const bool toggle = (byte & kToggle) != 0;
    if (toggle == toggle_) return std::nullopt;  // R: a repeat has no effect
    toggle_ = toggle;
    return static_cast<std::uint8_t>(byte & kCommandBits);
}

}  // namespace nplc::protocol::fastmac
