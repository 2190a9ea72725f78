#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

/// The serial line of MIDI Ingenierie's MAC23 and MAC34 (000 §II to §IV): 38400 baud, 8 bits, no parity, one
/// stop bit. Frames of fixed form in ASCII: Stx, three decimal digits of length, hexadecimal fields, two
/// digits of the sum of the fields' characters modulo 100h, Etx.
namespace nplc::protocol::midi_v24 {

inline constexpr std::uint8_t kStx = 0x02;
inline constexpr std::uint8_t kEtx = 0x03;
inline constexpr std::uint8_t kAck = 0x06;
inline constexpr std::uint8_t kXoff = 0x13;
inline constexpr std::uint8_t kNack = 0x15;
inline constexpr std::uint8_t kXonError = 0x17;
inline constexpr std::uint8_t kXonErrorInTheField = 0x18;  ///< variant of some modules for a refusal
inline constexpr std::uint8_t kXon = 0x1A;

inline constexpr std::uint8_t kGeneral =
    0xFF;  ///< every module executes it; R: only address 00 answers (000 §IV)
inline constexpr std::uint8_t kMaxAddress = 0x7F;
inline constexpr std::uint8_t kFirstQuery = 0x20;  ///< indices 00h..1Fh are commands, 20h..2Fh queries

struct Request {
    std::uint8_t address = 0;
    std::uint8_t index = 0;
    std::uint8_t sub_index = 0;
    std::uint32_t data = 0;
    bool operator==(const Request&) const = default;
};

/// The reply to a query, between Xoff and Xon.
struct Reply {
    std::uint8_t address = 0;
    std::uint8_t digit = 0;  ///< low digit of the query's index, 0..15
    std::uint32_t data = 0;
    bool operator==(const Reply&) const = default;
};

constexpr bool is_query(std::uint8_t index) {
    return index >= kFirstQuery;
}
constexpr std::uint8_t digit_of(std::uint8_t index) {
    return index & 0x0F;
}

inline constexpr std::size_t kRequestFields = 14;
inline constexpr std::size_t kReplyFields = 11;
/// Stx, three digits of length, two of the sum, Etx.
inline constexpr std::size_t kAround = 7;
using RequestBytes = std::array<std::uint8_t, kAround + kRequestFields>;
using ReplyBytes = std::array<std::uint8_t, kAround + kReplyFields>;

RequestBytes encode(const Request& request);
/// Only the low four bits of `digit` are sent.
ReplyBytes encode_reply(const Reply& reply);

/// Reads frames of one form, one byte at a time. Stx always begins a new one. Another length or a missing Etx
/// is an invalid frame.
class FrameReader {
  public:
    enum class State : std::uint8_t {
        outside,  ///< the byte belongs to no frame, or broke the one in progress
        inside,
        whole,
        damaged,  ///< complete, but the sum is wrong or a character is no digit 0-9, A-F
    };
    /// 14 or 11 characters between length and sum.
    explicit FrameReader(std::size_t fields) : fields_(static_cast<std::uint8_t>(fields)) {}
    State receive(std::uint8_t byte);
    void abandon() { count_ = 0; }
    bool in_frame() const { return count_ != 0; }

    /// Valid after `whole` and `damaged`, until the next byte. -1 if a character is no digit; at most 8 of
    /// them.
    std::int64_t number(std::size_t from, std::size_t digits) const;

  private:
    static constexpr std::size_t kLengthDigits = 3;
    bool sum_is_right() const;
    bool all_digits() const;

    std::uint8_t fields_;
    std::uint8_t count_ = 0;  ///< characters of the frame so far, including Stx
    std::array<std::uint8_t, kRequestFields + 2> bytes_;
};

/// A module's receiver. It reports each frame on the line, for any address; the caller selects its own. The
/// required answer is given at Event::Kind.
class RequestDecoder {
  public:
    struct Event {
        enum class Kind : std::uint8_t {
            none,
            request,  ///< answer: Ack, Xoff, the reply of a query, Xon; or Ack, Xoff, Xonerror
            damaged,  ///< answer: Nack; of `request` only the address is set, as received
        };
        Kind kind = Kind::none;
        Request request{};
    };
    Event receive(std::uint8_t byte);
    /// To be called at a framing error. The manual gives no limit for pauses.
    void abandon() { frame_.abandon(); }
    bool in_frame() const { return frame_.in_frame(); }

  private:
    FrameReader frame_{kRequestFields};
};

/// The answer to a master's request (000 §II, §III).
struct Answer {
    enum class Kind : std::uint8_t {
        none,            ///< not yet
        accepted,        ///< a command was carried out
        value,           ///< a query was answered
        refused,         ///< understood and not carried out
        not_understood,  ///< Nack: not carried out
        unclear,  ///< reply damaged, missing or from another module; a command may have been carried out
    };
    Kind kind = Kind::none;
    std::uint32_t value = 0;
    bool operator==(const Answer&) const = default;
};

/// The master's receiver: one answer to one request. Unexpected characters are ignored, also after the
/// answer.
class AnswerDecoder {
  public:
    void expect(const Request& request);
    Answer receive(std::uint8_t byte);
    bool waiting() const { return waiting_; }
    void abandon() { waiting_ = false; }

  private:
    Answer finish(Answer::Kind kind);
    Answer control(std::uint8_t byte);
    void take_reply(FrameReader::State state);

    bool waiting_ = false;
    bool acknowledged_ = false;
    bool busy_ = false;  ///< Ack and Xoff were received
    bool has_value_ = false;
    bool spoilt_ = false;
    FrameReader frame_{kReplyFields};
    std::uint32_t value_ = 0;
    Request request_{};
};

}  // namespace nplc::protocol::midi_v24
