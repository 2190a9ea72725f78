#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

/// Modbus Application Protocol V1.1b3: the part that is common to all lines. No heap.
namespace nplc::protocol::modbus {

enum class Exception : std::uint8_t {
    none = 0,
    illegal_function = 1,
    illegal_address = 2,
    illegal_value = 3,
    device_failure = 4,  ///< refused; the result registers have the reason
    busy = 6,
    target_failed = 0x0B,  ///< the requested motor value or axis is unknown
};

/// The data that a request reads or writes.
enum class Space : std::uint8_t { coil, discrete_input, input_register, holding_register };

constexpr std::size_t kMostPdu = 253;
constexpr std::uint16_t kMostBitsRead = 2000;
constexpr std::uint16_t kMostBitsWritten = 1968;
constexpr std::uint16_t kMostWordsRead = 125;
constexpr std::uint16_t kMostWordsWritten = 123;

/// A decoded request; `values` points into the request's bytes.
struct Request {
    std::uint8_t function = 0;
    Space space{};
    bool writes = false;
    std::uint16_t address = 0;
    std::uint16_t count = 0;                 ///< bits or words
    std::span<const std::uint8_t> values{};  ///< of a write: bits, the first one lowest, or words, big-endian

    bool bit(std::size_t index) const;
    std::uint16_t word(std::size_t index) const;
};

struct Decoded {
    Request request{};
    Exception exception = Exception::none;  ///< if set, only `function` of the request is valid
};
/// Functions 1 to 6, 15 and 16. Needs at least one byte.
Decoded decode(std::span<const std::uint8_t> pdu);

/// Builder of an answer.
class Answer {
  public:
    static Answer refusal(std::uint8_t function, Exception exception);
    /// Answer to a write: its address and count, or its address and value.
    static Answer echo(std::span<const std::uint8_t> pdu);
    /// Answer to a read; bits or words follow, as many as requested.
    explicit Answer(const Request& request);
    void put_bit(bool value);
    void put_word(std::uint16_t value);

    std::span<const std::uint8_t> bytes() const { return std::span(bytes_).first(size_); }

  private:
    Answer() = default;

    std::array<std::uint8_t, kMostPdu> bytes_{};
    std::size_t size_ = 0;
    std::size_t bits_ = 0;
};

}  // namespace nplc::protocol::modbus
