#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

/// MacTalk (001 §5.1; the quick guides in 002 §5.7 and 004 §1.3): three equal bytes identify the kind of
/// message, then an address and parameters, each byte followed by its inverse, little-endian, then AAh AAh.
namespace nplc::protocol::mactalk {

inline constexpr std::uint8_t kMasterAddress = 0;  ///< address in replies; no unit has it
inline constexpr std::uint8_t kEveryone = 255;     ///< every unit accepts it, and answers (field practice)

/// Requests of a master. The value is the message's first three bytes.
enum class Kind : std::uint8_t {
    read = 0x50,
    read_block = 0x51,
    write = 0x52,
    read_samples = 0x53,
    safe_mode = 0x54,
    init_mode = 0x55,
    write_flash = 0x56,
    reset = 0x57,
};

struct Request {
    Kind kind = Kind::read;
    std::uint8_t address = 0;
    std::uint8_t reg = 0;     ///< 1..255 for read, read_block and write, else 0
    std::uint8_t length = 0;  ///< bytes of a write, else 0: 2 or 4, more in a long write
    std::uint32_t value = 0;  ///< value to write, else 0; for a long write its first four bytes
    bool operator==(const Request&) const = default;
};

/// Three sync bytes; address, register and length; four data bytes; two end bytes.
inline constexpr std::size_t kMaxRequestBytes = 19;
inline constexpr std::size_t kBareRequestBytes = 7;  ///< without register and data
/// The gateway's table window accepts more in one write; motors do not. In whole longwords.
inline constexpr std::size_t kMaxLongWrite = 128;
inline constexpr std::size_t kMaxLongRequestBytes = 3 + 2 * (3 + kMaxLongWrite) + 2;
inline constexpr std::size_t kMaxReplyData = 64;
inline constexpr std::size_t kMaxReplyBytes = 3 + 2 * (3 + kMaxReplyData) + 2;

inline constexpr std::size_t kReadBytes = 4;           ///< a read always returns four (001 §5.1)
inline constexpr std::size_t kBlockBytes = 64;         ///< R: no manual describes the block read's answer
inline constexpr std::size_t kSampleBytes = 8;         ///< the four sampled words (R)
inline constexpr std::size_t kMac800SampleBytes = 16;  ///< the same as longwords (R)

template <std::size_t N>
struct Encoded {
    std::array<std::uint8_t, N> bytes;  ///< `size` of them
    std::size_t size = 0;
    std::span<const std::uint8_t> view() const { return {bytes.data(), size}; }
};
using EncodedRequest = Encoded<kMaxRequestBytes>;
using EncodedLongWrite = Encoded<kMaxLongRequestBytes>;
using EncodedReply = Encoded<kMaxReplyBytes>;

/// Empty for an invalid request: register 0 in a read or write, a write of another length than 2 or 4.
EncodedRequest encode(const Request& request);

/// A write of 4 to kMaxLongWrite bytes, a multiple of 4, for the gateway's table window. Empty for other
/// lengths and for register 0.
EncodedLongWrite encode_long_write(std::uint8_t address, std::uint8_t reg,
                                   std::span<const std::uint8_t> data);

/// 11h x3: after writes, 54h and 55h; 56h and 57h are not answered (001 §5.1).
EncodedReply encode_accept();
/// Answer to `read` with four bytes of data, to `read_block` with 64. Empty for register 0 or too much data.
EncodedReply encode_registers(std::uint8_t reg, std::span<const std::uint8_t> data);
/// Answer to `read_samples`: the same without a register (field practice).
EncodedReply encode_samples(std::span<const std::uint8_t> data);

/// A unit's receiver, one byte at a time. It reports each complete message on the line, for any address; the
/// caller selects its own. A wrong repeat, inverse, length or end drops the message, and the bytes after its
/// first may begin the next one, so that after noise the next complete message is received. A message always
/// consists of the last bytes received.
class RequestDecoder {
  public:
    /// The message completed by this byte.
    std::optional<Request> receive(std::uint8_t byte);
    /// Accepts long writes to this unit; 0: none.
    void take_long_writes(std::uint8_t address) { long_address_ = address; }
    /// Data of the write last returned by receive(), valid until the next call.
    std::span<const std::uint8_t> data() const { return {bytes_.data(), data_size_}; }
    /// Raw bytes of the request without a register last returned by receive(), valid until the next call.
    std::span<const std::uint8_t, kBareRequestBytes> bare() const {
        return std::span(bytes_).first<kBareRequestBytes>();
    }
    /// Sets the state as if receive() had returned this request, decoded elsewhere, with its data, at most
    /// kMaxLongWrite.
    void place(const Request& request, std::span<const std::uint8_t> data);
    /// To be called at a framing error or an overrun. A pause is no error: the manuals give no limit.
    void abandon() { count_ = 0; }
    bool in_message() const { return count_ != 0; }

  private:
    std::array<std::uint8_t, kMaxLongRequestBytes> bytes_;
    std::uint16_t count_ = 0;
    std::uint8_t data_size_ = 0;
    std::uint8_t long_address_ = 0;
};

struct Reply {
    std::uint8_t reg = 0;  ///< 0 for samples and accept
    std::uint8_t length = 0;
    std::array<std::uint8_t, kMaxReplyData> data{};
    std::span<const std::uint8_t> view() const { return {data.data(), length}; }
    bool operator==(const Reply&) const = default;
};

/// The answer that a master expects. Register replies and samples cannot be distinguished on the line.
enum class Answer : std::uint8_t { none, accept, registers, samples };

/// The answer to a request.
Answer answer_to(Kind kind);

/// The master's receiver. Only the expected kind of answer, with its number of data bytes, is reported;
/// otherwise the same rules as for RequestDecoder. The caller checks whether the register is the requested
/// one.
class ReplyDecoder {
  public:
    /// `data_bytes`: data length of the answer; 0 for accept and none.
    void expect(Answer answer, std::size_t data_bytes);
    std::optional<Reply> receive(std::uint8_t byte);
    void abandon() { count_ = 0; }

  private:
    Answer answer_ = Answer::none;
    std::uint8_t data_bytes_ = 0;
    std::array<std::uint8_t, kMaxReplyBytes> bytes_{};
    std::uint8_t count_ = 0;
};

}  // namespace nplc::protocol::mactalk
