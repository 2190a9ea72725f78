#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace nplc::protocol::flexmac {

/// Addressing form of a message (001 §5.2.2).
enum class Level : std::uint8_t {
    index,    ///< 1..15 of the short table, in the header itself
    reg,      ///< register number 1..255
    address,  ///< 16-bit address, after a register number of 0
};

struct Message {
    bool read = false;
    bool longword = false;
    Level level = Level::index;
    std::uint16_t target = 0;  ///< index, register number or address
    std::uint32_t value = 0;   ///< writes: 16 bits, 32 with `longword`
    bool operator==(const Message&) const = default;
};

/// Read indices 14 and 15 are protocol commands (001 §5.2.2); they are words and have no reply. Their
/// longword headers FEh and FFh are not used as messages (R): a spike on an idle line looks like FFh.
inline constexpr std::uint8_t kReadIndexUseFastMac = 14;
inline constexpr std::uint8_t kReadIndexUseFlexMac = 15;
inline constexpr Message kUseFastMac{.read = true, .target = kReadIndexUseFastMac};
inline constexpr Message kUseFlexMac{.read = true, .target = kReadIndexUseFlexMac};

/// 7Eh x3 or 7Fh x3: a command to the link, not a read.
bool is_protocol_command(const Message& message);

/// Longest message: 3 header, 2 register, 4 address, 8 data bytes.
inline constexpr std::size_t kMaxBytes = 17;

struct Encoded {
    std::array<std::uint8_t, kMaxBytes> bytes{};
    std::size_t size = 0;
    std::span<const std::uint8_t> view() const { return {bytes.data(), size}; }
};

/// Header, register or address block, data; little-endian, each protected byte followed by its inverse. A
/// word write sends the low 16 bits of `value`. Empty for a message that no header can encode: index 0 or
/// over 15 (index 0 selects the register form), register 0 or over 255, a protocol command as longword.
Encoded encode(const Message& message);

/// A motor's answer to `request`: its header and block again, then the data with inverses (R: 001 §5.2.2 only
/// says that header bytes distinguish it from a status byte). Empty if the request has no answer: writes,
/// protocol commands.
Encoded encode_reply(const Message& request, std::uint32_t value);

/// Register of 001 §3.2 for a write or read index of §5.2.2's tables; 0 for an index without one (read 14,
/// 15, any index 0 or over 15). Those above 88 have other numbers on MAC800.
std::uint8_t register_of_write_index(std::uint8_t index);
std::uint8_t register_of_read_index(std::uint8_t index);

/// Address of register `reg`: 0408h + 2 x reg (R: from the two addresses in 001 §5.2.2). The inverse is empty
/// for an odd address and for one outside registers 1..255.
constexpr std::uint16_t address_of_register(std::uint8_t reg) {
    return static_cast<std::uint16_t>(0x0408 + 2 * reg);
}
std::optional<std::uint8_t> register_of_address(std::uint16_t address);

/// The motor's receiver, one byte at a time. A wrong header repeat or a wrong inverse drops the message; the
/// wrong byte may begin the next one (R). The caller calls `abandon` at a framing error and at a pause of two
/// characters; without such pauses a lost byte can turn two messages into a wrong one (see the folder's
/// README).
class RequestDecoder {
  public:
    /// The message completed by this byte.
    std::optional<Message> receive(std::uint8_t byte);
    void abandon() { count_ = 0; }
    bool in_message() const { return count_ != 0; }

  private:
    std::array<std::uint8_t, kMaxBytes> bytes_{};
    std::uint8_t count_ = 0;
};

/// The master's receiver. The motor sends status bytes, and replies to reads, distinguished by bits 6..5
/// (never both set in a status byte).
///
/// A byte with both bits set that is not part of a complete reply sets the state "in doubt": bytes of a
/// broken reply may look like status bytes, even two equal ones in a row (an inverse and the next data byte).
/// In doubt, status bytes are held back until the third equal one in a row, which data with inverses cannot
/// contain, or until a reply is complete. A stray byte thus costs the two status bytes after it.
class ReplyDecoder {
  public:
    struct Event {
        enum class Kind : std::uint8_t { none, status, reply } kind = Kind::none;
        std::uint8_t status = 0;
        Message reply{};  ///< read = true, value = data
    };
    Event receive(std::uint8_t byte);

    /// To be called at a framing error or an overrun. Not at a pause: a motor in slow transmission also
    /// pauses between the bytes of a reply.
    void abandon();

  private:
    Event outside_reply(std::uint8_t byte);

    std::array<std::uint8_t, kMaxBytes> bytes_;
    std::uint8_t count_ = 0;
    bool doubt_ = false;
    std::uint8_t run_ = 0;   // in doubt: equal status bytes in a row
    std::uint8_t last_ = 0;  // in doubt: value of these bytes
};

}  // namespace nplc::protocol::flexmac
