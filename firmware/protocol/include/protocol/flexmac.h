#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace nplc::protocol::flexmac {

/// How a message names what it reads or writes (001 §5.2.2).
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

/// Read indices 14 and 15 command the protocol (001 §5.2.2).
inline constexpr std::uint8_t kReadIndexUseFastMac = 14;
inline constexpr std::uint8_t kReadIndexUseFlexMac = 15;

/// Longest message: 3 header, 2 register, 4 address, 8 data bytes.
inline constexpr std::size_t kMaxBytes = 17;

struct Encoded {
    std::array<std::uint8_t, kMaxBytes> bytes{};
    std::size_t size = 0;
    std::span<const std::uint8_t> view() const { return {bytes.data(), size}; }
};

/// Header, register or address block, data; low byte first, each protected byte followed by its inverse.
Encoded encode(const Message& message);

/// A motor's answer to `request` (a read): its header and block again, then the data with inverses.
Encoded encode_reply(const Message& request, std::uint32_t value);

/// Register behind a write or read index of 001 §5.2.2's tables; 0 for an index without one (read 14, 15, and
/// 0).
std::uint8_t register_of_write_index(std::uint8_t index);
std::uint8_t register_of_read_index(std::uint8_t index);

/// Address of register `reg`: 0408h + 2 x reg. The inverse answers nothing for an odd or too low address.
constexpr std::uint16_t address_of_register(std::uint8_t reg) {
    return static_cast<std::uint16_t>(0x0408 + 2 * reg);
}
std::optional<std::uint8_t> register_of_address(std::uint16_t address);

/// The motor's receiving end, a byte at a time. Wrong header repeats and wrong inverses drop the message; the
/// byte that broke it may begin the next. The caller calls `abandon` at a framing error and at a pause of two
/// characters.
class RequestDecoder {
  public:
    std::optional<Message> receive(std::uint8_t byte);
    void abandon();
    bool in_message() const;

  private:
    std::array<std::uint8_t, kMaxBytes> bytes_{};
    std::uint8_t count_ = 0;
};

/// The master's receiving end. The motor's bytes are status bytes, and replies to reads, told apart by
/// bits 6..5 (never both set in a status byte).
class ReplyDecoder {
  public:
    struct Event {
        enum class Kind : std::uint8_t { none, status, reply } kind = Kind::none;
        std::uint8_t status = 0;
        Message reply{};  ///< read = true, value = data
    };
    Event receive(std::uint8_t byte);
    void abandon();

  private:
    std::array<std::uint8_t, kMaxBytes> bytes_{};
    std::uint8_t count_ = 0;
};

}  // namespace nplc::protocol::flexmac
