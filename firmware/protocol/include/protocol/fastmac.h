#pragma once

#include <cstdint>
#include <optional>

namespace nplc::protocol::fastmac {

/// Bits 6..5 of a command byte (001 §5.2.1.4).
enum class Mode : std::uint8_t { init = 0, velocity = 1, position = 2, command = 3 };

/// The register group selected by bits 4..0 in init, velocity and position mode.
enum class Group : std::uint8_t { p, v, a, t, l, z };

/// Command-mode numbers, bits 4..0 (001 §5.2.1.4). 17h - 1Ch are NOPs too.
enum class Number : std::uint8_t {
    nop = 0x00,
    reset_error = 0x01,
    clear_p_soll = 0x02,
    clear_p_ist = 0x03,
    clear_p_fnc = 0x04,
    clear_v_soll = 0x05,
    clear_t_soll = 0x06,
    clear_in_pos = 0x07,
    move_p7_by_p_fnc = 0x08,
    move_p8_by_p_fnc = 0x09,
    rapid_communication = 0x0A,
    safe_communication = 0x0B,
    use_set_1 = 0x0C,
    use_set_2 = 0x0D,
    use_set_3 = 0x0E,
    use_set_4 = 0x0F,
    home = 0x10,
    move_p7_by_p_soll = 0x11,
    move_p8_by_p_soll = 0x12,
    transmit_slowly = 0x13,
    positions_absolute = 0x14,
    positions_relative_p_soll = 0x15,
    positions_relative_p_fnc = 0x16,
    transmit_address = 0x1D,
    use_fastmac = 0x1E,
    use_flexmac = 0x1F,
};

/// A command without its toggle bit: bits 6..0 of the byte on the line, as in a sequence term.
struct Command {
    Mode mode = Mode::command;
    Group group = Group::p;   ///< init, velocity, position mode
    std::uint8_t index = 1;   ///< register of the group: P and V 1..8, the others 1..4
    std::uint8_t number = 0;  ///< command mode: 0..31
    bool operator==(const Command&) const = default;
};

/// Coding of a register in bits 4..0. The project follows the list of 001 §5.2.1.4. The bytes of the example
/// in §5.2.1.5 fit another, older code: A 000xx, V 10xxx, P 11xxx; it shows no T, L or Z (its one T byte fits
/// neither code), which are assumed at 001xx, 010xx and 011xx here.
enum class RegisterCode : std::uint8_t { format_list, older_example };

inline constexpr std::uint8_t kToggle = 0x80;
inline constexpr std::uint8_t kCommandBits = 0x7F;

/// All 128 values are valid. Bit 7 is ignored. Fields that the mode does not use keep their defaults.
Command decode_command(std::uint8_t byte, RegisterCode code = RegisterCode::format_list);

/// Bit 7 is 0. Out-of-range fields are truncated to their bits.
std::uint8_t encode_command(const Command& command, RegisterCode code = RegisterCode::format_list);

constexpr std::uint8_t command_byte(Number number) {
    return static_cast<std::uint8_t>(0x60 | static_cast<std::uint8_t>(number));
}

constexpr std::uint8_t with_toggle(std::uint8_t command, bool toggle) {
    return static_cast<std::uint8_t>((command & kCommandBits) | (toggle ? kToggle : 0));
}

/// The byte that the motor repeats without pause (001 §5.2.1.6).
struct Status {
    bool toggle = false;  ///< of the last accepted command
    bool decelerating = false;
    bool accelerating = false;
    bool in_position = false;
    bool flexmac = false;        ///< the motor receives FlexMAC
    bool framing_error = false;  ///< the motor saw a character with a framing error
    bool available = false;      ///< bit 1, unused by the manual, kept
    bool error = false;          ///< follow, function, I2T or UIT error: ERR_STAT bits 0..3
    bool operator==(const Status&) const = default;
};

Status decode_status(std::uint8_t byte);

/// A motor never sets `decelerating` and `accelerating` together: such a byte would look like a FlexMAC
/// header.
std::uint8_t encode_status(const Status& status);

/// The motor's receiver: toggle rule and safe communication (001 §5.2.1.3, §5.2.1.4).
///
/// At power-up the toggle is 0 and communication rapid. A byte is accepted only if its toggle bit differs
/// from that of the last accepted message, so a repeat has no effect. With safe communication the byte must
/// also equal the previous one. A third equal byte is a pair too, but its toggle is then the accepted one: it
/// has no effect.
class CommandReceiver {
  public:
    /// The command to execute, without its toggle bit, if this byte completes a new one.
    std::optional<std::uint8_t> receive(std::uint8_t byte);

    /// To be called at a framing error and at a pause of two characters: the previous byte no longer counts.
    /// (A master that slows down after status bit 2 leaves one character free between the two bytes; that is
    /// still a pair.)
    void break_pair() { previous_.reset(); }

    void set_safe(bool safe) {
        safe_ = safe;
        break_pair();
    }
    bool safe() const { return safe_; }
    bool toggle() const { return toggle_; }

    /// For each accepted FlexMAC message, which switches the same toggle (001 §5.2.2). Breaks the pair: a
    /// byte before the message is not the first half of one after it.
    void accept_other() {
        toggle_ = !toggle_;
        break_pair();
    }

  private:
    bool toggle_ = false;
    bool safe_ = false;
    std::optional<std::uint8_t> previous_;
};

}  // namespace nplc::protocol::fastmac
